//! What was measured, as a table and as JSON.

use std::io::{self, Write};

use serde_json::{Value, json};

use super::Effort;
use super::law::Law;
use super::method::METHODS;
use super::score::{STOPS, Score, Spread};
use super::stress::Report;

/// Everything as JSON.
pub fn json(scores: &[Score], law: Law, effort: Effort) -> Value {
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "host": crate::simulation::host(),
        "law": law.name(),
        "quick": effort == Effort::Quick,
        "orbits": effort.orbits(),
        "methods": METHODS.iter().map(|m| json!({ "name": m.name, "summary": m.summary })).collect::<Vec<_>>(),
        "scores": scores.iter().map(of_score).collect::<Vec<_>>(),
    })
}

/// A score as JSON; an infinite error is null.
fn of_score(score: &Score) -> Value {
    let spread =
        |(stop, spread): (&u64, &Spread)| json!({ "collisions": stop, "median": spread.median, "worst": spread.worst });
    let invariant = score.drift.invariant.map(|(name, drift)| json!({ "name": name, "drift": drift }));
    json!({
        "table": score.table,
        "method": score.method,
        "pieces": score.pieces,
        "build_seconds": score.build.as_secs_f64(),
        "ns_per_collision": score.nanoseconds,
        "errors": STOPS.iter().zip(&score.errors).map(spread).collect::<Vec<_>>(),
        "drift": {
            "collisions": score.drift.collisions,
            "energy": score.drift.energy,
            "invariant": invariant,
        },
        "lost": { "ordinary": score.lost.ordinary, "grazing": score.lost.grazing, "of": score.lost.of },
        "failures": score.failures(),
    })
}

/// What the columns mean, for people.
///
/// # Errors
/// The output cannot be written.
pub fn preamble(law: Law, effort: Effort, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "{}; {} collisions of a uniform disk or ball.", crate::simulation::host(), law.name())?;
    writeln!(
        out,
        "Errors of position, relative to half the table's width (for a strip or a slab, to the full width), and of velocity, relative to\n\
         the speed: medians of {} orbits after {}, {} and {} collisions, compared with a computation in 106 bits. Drifts of the energy\n\
         and of the table's other conserved quantity, if any: the largest in 1e5 collisions (1e4 or 1e3 if 1e5 would take too long).",
        effort.orbits(),
        STOPS[0],
        STOPS[1],
        STOPS[2]
    )
}

/// The scores of one table, for people.
///
/// # Errors
/// The output cannot be written.
pub fn table(scores: &[Score], out: &mut dyn Write) -> io::Result<()> {
    let Some(first) = scores.first() else { return Ok(()) };
    // a column for what this table conserves besides the energy
    let own = first.drift.invariant.map_or("", |(name, _)| name);
    let width = if own.is_empty() { 0 } else { own.len().max(8) + 1 };
    let [a, b, c] = STOPS.map(|n| n.to_string());
    writeln!(
        out,
        "\n{:<32} {:>6} {:>9} {:>8} {b:>8} {c:>8} {:>8}{own:>width$}  fails",
        first.table,
        "pieces",
        "ns",
        format!("after {a}"),
        "energy",
    )?;
    let mut last = "";
    for score in scores {
        let name = if score.method == last { "" } else { score.method };
        last = score.method;
        let pieces = score.pieces.map_or(String::new(), |p| format!("{:.0e}", p as f64));
        let [a, b, c] = score.errors.map(|e| short(e.median));
        let own = score.drift.invariant.map_or(String::new(), |(_, drift)| short(drift));
        writeln!(
            out,
            "  {name:<30} {pieces:>6} {:>9.1} {a:>8} {b:>8} {c:>8} {:>8}{own:>width$}  {}",
            score.nanoseconds,
            short(score.drift.energy),
            score.failures().join(", ")
        )?;
    }
    Ok(())
}

/// What happened under stress, as JSON.
pub fn stress_json(reports: &[Report], effort: Effort) -> Value {
    let case = |report: &Report| {
        let mut value = json!({
            "name": report.name,
            "summary": report.summary,
            "seconds": report.time.as_secs_f64(),
        });
        match &report.result {
            Ok(tally) => {
                value["orbits"] = json!(tally.orbits);
                value["collisions"] = json!(tally.collisions);
                value["stops"] = json!(tally.stops);
                value["known"] = json!(tally.known);
                value["worst_error"] = json!(tally.error);
                value["lost"] = json!(tally.lost);
            }
            Err(problem) => value["failed"] = json!(problem),
        }
        value
    };
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "host": crate::simulation::host(),
        "quick": effort == Effort::Quick,
        "cases": reports.iter().map(case).collect::<Vec<_>>(),
    })
}

/// One case under stress, for people.
///
/// # Errors
/// The output cannot be written.
pub fn stress(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "{}: {}", report.name, report.summary)?;
    let seconds = report.time.as_secs_f64();
    let tally = match &report.result {
        Ok(tally) => tally,
        Err(problem) => return writeln!(out, "  failed: {problem}; {seconds:.2} s"),
    };
    let stops: Vec<_> = tally.stops.iter().map(|(name, count)| format!("{count} {name}")).collect();
    let lost = if tally.lost == 0 { "nothing lost".into() } else { format!("{} LOST", tally.lost) };
    writeln!(
        out,
        "  {} collisions: {}; {lost}; worst error {} ({}); {seconds:.2} s",
        tally.collisions,
        stops.join(", "),
        short(tally.error),
        tally.known
    )
}

/// An error in two digits; "lost" if it is infinite, a dash if there is none.
fn short(error: f64) -> String {
    if error.is_nan() {
        "\u{2013}".into()
    } else if error == 0.0 {
        "0".into()
    } else if error.is_finite() {
        format!("{error:.1e}")
    } else {
        "lost".into()
    }
}
