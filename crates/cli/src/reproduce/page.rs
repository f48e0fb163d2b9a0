//! The page: figures, claims and what goes beyond the paper, in one self-contained HTML file with embedded pictures.

use std::fmt::{self, Write as _};

use paper::claims::{UNMEASURED, Unmeasured};
use paper::{Claim, Measurement, Quantity, Relation, Verdict};
use serde_json::{Value, json};

use super::{BEYOND, Effort, Figure};
use crate::picture::{COLUMN, escape};

/// How the page looks: for screens in light and dark, and for print.
const STYLE: &str = "\
:root{color-scheme:light dark;--paper:#fdfdfb;--ink:#1a1a1a;--soft:#5a5a5a;--rule:#d8d8d2;--good:#1a6a4c;--mend:#8a5d00;--bad:#9a2a1a}
@media(prefers-color-scheme:dark){:root{--paper:#16181b;--ink:#e4e4df;--soft:#a3a39c;--rule:#3a3d42;--good:#6cc7a1;--mend:#dcb05a;--bad:#ec8a78}}
*{box-sizing:border-box}
body{margin:0 auto;padding:2.5rem 1.25rem 5rem;max-width:60rem;background:var(--paper);color:var(--ink);
font:1.03rem/1.55 'Latin Modern Roman','STIX Two Text','Libertinus Serif',Charter,Georgia,serif}
h1{font-size:1.9rem;font-weight:normal;line-height:1.2;margin:0 0 .5rem}
h2{font-size:1.4rem;font-weight:normal;margin:3.2rem 0 1rem;border-bottom:1px solid var(--rule);padding-bottom:.3rem}
h3{font-size:1.05rem;margin:0 0 .3rem}
a{color:inherit}
code{font:.85em ui-monospace,'DejaVu Sans Mono',monospace}
.soft{color:var(--soft)}
figure{margin:2rem 0;padding:0;break-inside:avoid;display:grid;grid-template-columns:minmax(0,26rem) minmax(0,1fr);gap:1.5rem;align-items:start}
figure.wide{grid-template-columns:1fr}
figure img{width:100%;height:auto;background:#fff;border-radius:3px;display:block}
figure.wide img{margin:0 auto}
sup{line-height:0}
figcaption p{margin:.25rem 0 .5rem}
figcaption .soft{font-size:.88rem}
@media(max-width:46rem){figure{grid-template-columns:1fr}}
table{border-collapse:collapse;width:100%;font-size:.92rem}
th,td{text-align:left;vertical-align:top;padding:.5rem .6rem;border-bottom:1px solid var(--rule)}
th{font-weight:normal;color:var(--soft)}
td.numbers{font-size:.8rem;line-height:1.35}
td.numbers div{display:flex;justify-content:space-between;gap:.8em;margin-bottom:.15rem}
td.numbers .number{text-align:right}
.number{font-variant-numeric:tabular-nums;white-space:nowrap}
.holds{color:var(--good)}.mended{color:var(--mend)}.false{color:var(--bad)}
tr{break-inside:avoid}
nav{font-size:.92rem}
nav a{margin-right:.9em;white-space:nowrap}
@media print{body{max-width:none;padding:0;font-size:10pt}nav{display:none}figure{grid-template-columns:8cm 1fr}
:root{--paper:#fff;--ink:#000;--soft:#444;--rule:#bbb;--good:#000;--mend:#000;--bad:#000}}
";

/// A claim with what was measured.
#[derive(Clone, Debug)]
pub struct Measured {
    /// The claim.
    pub claim: &'static Claim,
    /// The numbers.
    pub measurement: Measurement,
}

/// A figure with its picture.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// The figure.
    pub figure: Figure,
    /// The picture, also written to a file of the figure's name beside the page.
    pub svg: String,
    /// Its width and height on paper, in points.
    pub size: [f64; 2],
}

/// The page, from the figures and the claims, with the names of those that an interruption has left out.
pub fn html(figures: &[Drawn], claims: &[Measured], left_out: &[&str], effort: Effort) -> String {
    let mut page = String::new();
    // Writing to a string cannot fail.
    let _ = write(&mut page, figures, claims, left_out, effort);
    page
}

fn write(page: &mut String, figures: &[Drawn], claims: &[Measured], left_out: &[&str], effort: Effort) -> fmt::Result {
    writeln!(page, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">")?;
    writeln!(page, "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">")?;
    writeln!(
        page,
        "<title>No-slip billiards in dimension two, recomputed</title>\n<style>\n{STYLE}</style>\n</head>\n<body>"
    )?;
    introduction(page, figures, claims, effort)?;
    if !left_out.is_empty() {
        writeln!(page, "<p><b>The computation was interrupted.</b> Not on this page: {}.</p>", left_out.join(", "))?;
    }
    let (beyond, paper): (Vec<_>, Vec<_>) =
        figures.iter().partition::<Vec<&Drawn>, _>(|drawn| drawn.figure.place == BEYOND);
    let (more, stated): (Vec<_>, Vec<_>) =
        claims.iter().partition::<Vec<&Measured>, _>(|m| m.claim.place.contains(BEYOND));
    if !paper.is_empty() {
        writeln!(page, "<h2 id=\"figures\">Figures</h2>")?;
        for figure in paper {
            drawn(page, figure, effort)?;
        }
    }
    if !stated.is_empty() {
        writeln!(page, "<h2 id=\"claims\">The claims of the paper, measured</h2>")?;
        table(page, &stated)?;
    }
    if claims.len() == paper::claims::all().len() {
        writeln!(page, "<p>Not measured:</p>\n<ul>")?;
        for Unmeasured { place, statement, reason } in UNMEASURED {
            let [place, statement, reason] = [place, statement, reason].map(|text| escape(text));
            writeln!(
                page,
                "<li><span class=\"soft\">{place}</span>: {statement} <span class=\"soft\">{reason}</span></li>"
            )?;
        }
        writeln!(page, "</ul>")?;
    }
    if !(beyond.is_empty() && more.is_empty()) {
        writeln!(page, "<h2 id=\"beyond\">Beyond the paper</h2>")?;
        for figure in beyond {
            drawn(page, figure, effort)?;
        }
        if !more.is_empty() {
            table(page, &more)?;
        }
    }
    writeln!(page, "</body>\n</html>")
}

fn introduction(page: &mut String, figures: &[Drawn], claims: &[Measured], effort: Effort) -> fmt::Result {
    let count = |f: fn(&Verdict) -> bool| claims.iter().filter(|m| f(&m.claim.verdict)).count();
    let holds = count(|v| matches!(v, Verdict::Holds));
    let mended = count(|v| matches!(v, Verdict::HoldsCorrected(_)));
    let wrong = count(|v| matches!(v, Verdict::False(_)));
    let off = claims.iter().filter(|m| !m.measurement.is_consistent()).count();
    let quick = quick(effort);
    writeln!(
        page,
        "<h1>No-slip billiards in dimension two, recomputed</h1>\n\
         <p class=\"soft\">C. Cox and R. Feres, <i>No-Slip Billiards in Dimension Two</i>, figure by figure and claim by claim, \
         by <code>billiards reproduce{quick}</code>, version {}.</p>\n\
         <p>A disk that does not slip when it meets a wall exchanges linear and angular velocity there, and loses no energy. \
         Write x₀ = γRθ for its scaled angle, γ² = I/(mR²), and (x₁, x₂) for its centre: then its kinetic energy is (m/2)|ẋ|², and a \
         collision is a half-turn of the velocity. Rotation is counted counter-clockwise, ν is the unit normal into the table, \
         t = Jν with J(x, y) = (−y, x), and v₀, vₜ, vₙ are the components of the velocity after a collision. Unless said otherwise the \
         disk is uniform, γ² = 1/2, and |ẋ| = 1.</p>\n\
         <p>Every picture and every number here was computed when this page was made; they are the same to the last bit every time.",
        env!("CARGO_PKG_VERSION")
    )?;
    if !claims.is_empty() {
        write!(
            page,
            " Of {} claims {holds} hold, {mended} hold with a correction and {wrong} are false",
            claims.len()
        )?;
        if off == 0 {
            write!(page, "; every measurement agrees with our verdict.")?;
        } else {
            write!(page, "; <b>for {off} of them a measurement disagrees with our verdict</b>.")?;
        }
    }
    writeln!(page, "</p>\n<nav>")?;
    for Drawn { figure, .. } in figures {
        writeln!(page, "<a href=\"#{}\">{}</a>", figure.name, escape(figure.title))?;
    }
    if claims.iter().any(|m| !m.claim.place.contains(BEYOND)) {
        writeln!(page, "<a href=\"#claims\">The claims</a>")?;
    }
    if claims.iter().any(|m| m.claim.place.contains(BEYOND)) {
        writeln!(page, "<a href=\"#beyond\">Beyond the paper</a>")?;
    }
    writeln!(page, "</nav>")
}

/// The option for an effort.
fn quick(effort: Effort) -> &'static str {
    if effort == Effort::Quick { " --quick" } else { "" }
}

fn drawn(page: &mut String, Drawn { figure, svg, size: [width, height] }: &Drawn, effort: Effort) -> fmt::Result {
    let quick = quick(effort);
    let Figure { name, title, place, caption, parameters, .. } = figure;
    let class = if *width > 1.1 * COLUMN || *width > 1.6 * height { " class=\"wide\"" } else { "" };
    writeln!(
        page,
        "<figure id=\"{name}\"{class}>\n<a href=\"{name}.svg\"><img src=\"{}\" width=\"{width:.0}\" height=\"{height:.0}\" style=\"width:min(100%,{:.1}rem)\" alt=\"{title}\"></a>\n\
         <figcaption>\n<h3>{title} <span class=\"soft\">({place})</span></h3>\n<p>{}</p>\n<p class=\"soft\">{}</p>\n\
         <p class=\"soft\"><code>billiards reproduce{quick} --only {name}</code></p>\n</figcaption>\n</figure>",
        data_uri(svg),
        46.0 * width / height,
        escape(caption),
        escape(parameters),
        title = escape(title),
    )
}

/// A picture as a data URI.
fn data_uri(svg: &str) -> String {
    let mut uri = String::from("data:image/svg+xml,");
    for c in svg.chars() {
        match c {
            '%' => uri.push_str("%25"),
            '#' => uri.push_str("%23"),
            '"' => uri.push_str("%22"),
            '<' => uri.push_str("%3C"),
            '>' => uri.push_str("%3E"),
            '&' => uri.push_str("%26"),
            '\n' => uri.push_str("%0A"),
            c => uri.push(c),
        }
    }
    uri
}

fn table(page: &mut String, claims: &[&Measured]) -> fmt::Result {
    writeln!(
        page,
        "<table>\n<colgroup><col style=\"width:26%\"><col style=\"width:47%\"><col></colgroup>\n<thead><tr><th>Statement</th><th>Measured</th><th>Verdict</th></tr></thead>\n<tbody>"
    )?;
    for Measured { claim, measurement } in claims {
        let class = match claim.verdict {
            Verdict::Holds => "holds",
            Verdict::HoldsCorrected(_) => "mended",
            Verdict::False(_) => "false",
        };
        writeln!(
            page,
            "<tr id=\"claim-{name}\"><td><span class=\"soft\">{place}</span><br>{statement}<br><code class=\"soft\">{name}</code></td>\n<td class=\"numbers\">",
            name = claim.name,
            place = escape(claim.place),
            statement = escape(claim.statement),
        )?;
        for quantity in &measurement.quantities {
            let mark = if quantity.agrees() { "" } else { " <b class=\"false\">disagrees</b>" };
            writeln!(
                page,
                "<div><span>{}</span> <span class=\"number\">{}</span>{mark}</div>",
                escape(&quantity.label),
                numbers(quantity)
            )?;
        }
        write!(page, "</td>\n<td><span class=\"{class}\">{}</span>", claim.verdict.name())?;
        if let Some(corrected) = claim.verdict.corrected() {
            write!(page, "<br>{}", escape(corrected))?;
        }
        if let Some(general) = claim.general_gamma {
            write!(page, "<br><span class=\"soft\">Any γ: {}</span>", escape(general))?;
        }
        writeln!(page, "</td></tr>")?;
    }
    writeln!(page, "</tbody>\n</table>")
}

/// A measured number beside the expected one, with the tolerance for agreement.
fn numbers(q: &Quantity) -> String {
    let (measured, expected, off) = (short(q.measured), short(q.expected), q.deviation());
    match q.relation {
        Relation::Equal if q.measured == q.expected => format!("{measured}, exactly"),
        Relation::Equal if q.expected == 0.0 => format!("{} ≤ {}", small(off), small(q.bound)),
        Relation::Equal => format!("{measured}, expected {expected}, off by {}", small(off)),
        Relation::Sampled { standard_error, systematic } => {
            let known = if systematic > 0.0 { format!(", known to {}", small(systematic)) } else { String::new() };
            format!("{measured} ± {}, expected {expected}{known}", small(standard_error))
        }
        Relation::AtMost => format!("{measured} ≤ {}", short(q.expected + q.bound)),
        Relation::AtLeast => format!("{measured} ≥ {}", short(q.expected - q.bound)),
        Relation::Differs => format!("{measured} differs from {expected} by more than {}", small(q.bound)),
    }
}

/// A number to ten digits, without zeros at the end.
fn short(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    if !(1e-4..1e7).contains(&x.abs()) {
        return small(x);
    }
    let text = format!("{x:.8}");
    text.trim_end_matches('0').trim_end_matches('.').replace('-', "−")
}

/// A number to two digits.
fn small(x: f64) -> String {
    let text = format!("{x:.1e}");
    let (lead, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    match exponent {
        "0" | "-1" | "-2" | "-3" => format!("{x:.4}").trim_end_matches('0').trim_end_matches('.').replace('-', "−"),
        _ => format!("{}·10<sup>{}</sup>", lead.replace('-', "−"), exponent.replace('-', "−")),
    }
}

/// The claims as JSON, for programs, with the names of what an interruption has left out.
pub fn claims_json(claims: &[Measured], left_out: &[&str]) -> Value {
    let relation = |q: &Quantity| match q.relation {
        Relation::Equal => "equal",
        Relation::Sampled { .. } => "sampled",
        Relation::AtMost => "at most",
        Relation::AtLeast => "at least",
        Relation::Differs => "differs",
    };
    let quantity = |q: &Quantity| {
        let (error, known) = match q.relation {
            Relation::Sampled { standard_error, systematic } => (Some(standard_error), Some(systematic)),
            _ => (None, None),
        };
        json!({
            "label": q.label, "measured": q.measured, "expected": q.expected, "relation": relation(q),
            "bound": q.bound, "standard_error": error, "systematic": known, "agrees": q.agrees(),
        })
    };
    let all: Vec<_> = claims
        .iter()
        .map(|Measured { claim, measurement }| {
            json!({
                "name": claim.name, "place": claim.place, "statement": claim.statement,
                "verdict": claim.verdict.name(), "corrected": claim.verdict.corrected(),
                "general_gamma": claim.general_gamma, "consistent": measurement.is_consistent(),
                "measured": measurement.quantities.iter().map(quantity).collect::<Vec<_>>(),
            })
        })
        .collect();
    let mut json = json!({ "claims": all });
    if !left_out.is_empty() {
        json["left_out"] = json!(left_out);
    }
    json
}
