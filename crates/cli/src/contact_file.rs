//! Contact files: two bodies, where they touch, how they move, and the law.
//!
//! TOML or JSON, in the form of the certified cases in `tests/data/collisions`: such a case, with a law added, is a
//! contact file; its metadata and results (`id`, `kind`, `K`, `energy`, `results`) are ignored.

mod examples;

use crate::document::{
    self, Diagnostic, Item, LARGEST, Problems, SMALLEST, Section, Source, Span, Spanned, Value, vector,
};
use crate::scene::{self, LawKind};

/// Dimensions of space a contact may have.
pub const DIMENSIONS: std::ops::RangeInclusive<usize> = 2..=5;

/// A contact file, read and checked as far as that is possible without mechanics.
#[derive(Clone, Debug)]
pub struct ContactFile {
    /// The file.
    pub source: Source,
    /// Dimension N of space, 2 to 5.
    pub dimension: usize,
    /// Both bodies.
    pub bodies: Spanned<[BodyEntry; 2]>,
    /// The contact point.
    pub point: Spanned<Vec<f64>>,
    /// The normal, from body 2 towards body 1, of any length.
    pub normal: Spanned<Vec<f64>>,
    /// Velocities before the collision.
    pub before: Spanned<[Motion; 2]>,
    /// The law.
    pub law: LawEntry,
}

/// A body of a contact file.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyEntry {
    /// Centre of mass.
    pub position: Vec<f64>,
    /// Mass and inertia; `None` for a fixed body.
    pub free: Option<(Spanned<f64>, Spanned<InertiaEntry>)>,
}

/// How a body resists turning; matrices row by row.
#[derive(Clone, Debug, PartialEq)]
pub enum InertiaEntry {
    /// `inertia` in the plane: the moment about the centre of mass.
    Moment(f64),
    /// `inertia` in space: the 3 × 3 tensor in the space frame.
    Tensor(Vec<f64>),
    /// `S`: second moments per unit mass, in the space frame.
    SecondMoments(Vec<f64>),
}

/// A velocity of a contact file.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// Velocity of the centre of mass.
    pub v: Spanned<Vec<f64>>,
    /// Spin: one number in the plane, three in space, else a skew N × N matrix row by row.
    pub w: Spanned<Vec<f64>>,
}

/// The law of a contact file.
#[derive(Clone, Debug, PartialEq)]
pub enum LawEntry {
    /// By name.
    Named(Spanned<LawKind>),
    /// `rough`: directions that the contact velocity reverses along, each with its place.
    Rough(Vec<Spanned<Vec<f64>>>),
}

impl ContactFile {
    /// Reads a contact file, in whichever of the two forms it is.
    ///
    /// # Errors
    /// Everything that is wrong with it.
    pub fn parse(source: &Source) -> Result<Self, Vec<Diagnostic>> {
        let mut problems = Problems::new(source);
        // No TOML document starts with a brace, and one that starts with a bracket has another one or a name after it.
        let text = source.text().trim_start_matches(['\u{feff}', ' ', '\t', '\r', '\n']);
        let is_header = |rest: &str| rest.starts_with(|c: char| c == '[' || c.is_ascii_alphabetic());
        let json = text.starts_with('{') || text.strip_prefix('[').is_some_and(|rest| !is_header(rest));
        let item = if json { document::parse_json(&mut problems) } else { document::parse_toml(&mut problems) };
        let file = item.and_then(|item| {
            // only JSON can be anything but a table
            let root = Section::inline(&item, "the contact file", &examples::file(2), &mut problems)?;
            read(root, &mut problems)
        });
        match file {
            Some(file) if problems.is_empty() => Ok(file),
            _ => {
                let mut wrong = problems.into_diagnostics();
                for help in wrong.iter_mut().filter_map(|wrong| wrong.help.as_mut()).filter(|_| json) {
                    *help = document::in_json(help);
                }
                Err(wrong)
            }
        }
    }
}

fn read(mut root: Section<'_>, problems: &mut Problems) -> Option<ContactFile> {
    if let Some((key, _)) = root.others().find(|(key, _)| key.value == "table") {
        problems.add_with_help(key.span, "a contact has no table: this file is a scene", "run it: billiards run SCENE");
        return None;
    }
    for passed_over in ["id", "kind", "title", "K", "energy", "results"] {
        root.optional(passed_over);
    }
    let dimension = root.required("dim", "dim = 2").and_then(|item| dimension(item, problems));
    let Some(n) = dimension else {
        // Without the dimension no other length can be checked.
        root.finish_leniently(problems);
        return None;
    };
    let bodies = root.required("bodies", &format!("bodies = {}", examples::bodies(n)));
    let bodies = bodies.and_then(|item| pair(item, "bodies", problems, |item, problems| body(item, n, problems)));
    let point = root.required("contact_point", &format!("contact_point = {}", examples::vector(n, "0")));
    let point = point.and_then(|item| vector(item, n, problems));
    let normal = root.required("normal", &format!("normal = {}", examples::vector(n, "1")));
    let normal = normal.and_then(|item| vector(item, n, problems));
    let [first, second] = ["-1", "0"].map(|x| examples::motion(n, x));
    let before = root.required("pre", &format!("pre = [{first}, {second}]"));
    let before = before.and_then(|item| pair(item, "pre", problems, |item, problems| motion(item, n, problems)));
    let law = match root.one_of(&["law", "rough"], "law = \"no-slip\"", problems) {
        Some(("law", item)) => spanned(item, scene::read_law(item, n, problems)).map(LawEntry::Named),
        Some((_, item)) => rough(item, n, problems),
        None => None,
    };
    root.finish(problems);
    let (bodies, before) = (bodies?, before?);
    for (body, motion) in bodies.value.iter().zip(&before.value) {
        if body.free.is_none() {
            stays(motion, n, problems);
        }
    }
    Some(ContactFile {
        source: problems.source().clone(),
        dimension: n,
        bodies,
        point: point?,
        normal: normal?,
        before,
        law: law?,
    })
}

/// Records a velocity or a spin of a fixed body.
fn stays(motion: &Motion, n: usize, problems: &mut Problems) {
    let is_zero = |of: &[f64]| of.iter().all(|x| *x == 0.0);
    if !is_zero(&motion.v.value) {
        let help = format!("write v = {}", examples::vector(n, "0"));
        problems.add_with_help(motion.v.span, "a fixed body (mass = \"inf\") must have velocity zero", help);
    }
    if !is_zero(&motion.w.value) {
        let inertia = if n <= 3 { "a finite inertia" } else { "an S of 1e-150 times its second moments" };
        let help = format!(
            "write w = {}; what turns about a fixed center has mass = 1e150, a position and {inertia}",
            examples::no_spin(n)
        );
        problems.add_with_help(motion.w.span, "a fixed body (mass = \"inf\") must have spin zero", help);
    }
}

fn dimension(item: &Item, problems: &mut Problems) -> Option<usize> {
    let range = *DIMENSIONS.start() as u64..=*DIMENSIONS.end() as u64;
    document::whole(item, range, problems).and_then(|n| usize::try_from(n.value).ok())
}

fn pair<T>(
    item: &Item,
    what: &str,
    problems: &mut Problems,
    read: impl Fn(&Item, &mut Problems) -> Option<T>,
) -> Option<Spanned<[T; 2]>> {
    match &item.value {
        Value::List(items) if items.len() == 2 => {
            let (first, second) = (read(&items[0], problems), read(&items[1], problems));
            Some(Spanned::new([first?, second?], item.span))
        }
        Value::List(items) => {
            let help = "write one for body 1 and one for body 2, be it fixed or not";
            problems.add_with_help(item.span, format!("{what} must have two entries, not {}", items.len()), help);
            None
        }
        other => {
            let help = "write two entries in brackets, one for body 1 and one for body 2";
            problems.add_with_help(item.span, format!("{what} must be an array, found {}", other.kind()), help);
            None
        }
    }
}

/// An n × n matrix, row by row.
fn matrix(item: &Item, n: usize, problems: &mut Problems) -> Option<Vec<f64>> {
    let Value::List(rows) = &item.value else {
        let what = format!("expected a {n} x {n} matrix, found {}", item.value.kind());
        problems.add_with_help(
            item.span,
            what,
            format!("write {n} rows of {n} numbers, each in brackets, and brackets around all"),
        );
        return None;
    };
    let read: Vec<_> = rows.iter().map(|row| vector(row, n, problems)).collect();
    if rows.len() != n {
        problems.add(item.span, format!("expected {n} rows, found {}", rows.len()));
        return None;
    }
    let rows: Option<Vec<Vec<f64>>> = read.into_iter().map(|row| row.map(|row| row.value)).collect();
    rows.map(|rows| rows.concat())
}

fn body(item: &Item, n: usize, problems: &mut Problems) -> Option<BodyEntry> {
    let mut section = Section::inline(item, "a body", "{ mass = \"inf\" }", problems)?;
    let mass = section.required("mass", "mass = 1, or mass = \"inf\"");
    if mass.is_some_and(|item| is_infinite(item, problems.source())) {
        // A fixed body has no inertia, and where its centre of mass lies does not matter.
        section.optional("inertia");
        section.optional("S");
        let position = section
            .optional("position")
            .map_or(Some(vec![0.0; n]), |item| vector(item, n, problems).map(|position| position.value));
        section.finish(problems);
        return Some(BodyEntry { position: position?, free: None });
    }
    let mass = mass.and_then(|item| finite_mass(item, problems));
    let position = section.required("position", &format!("position = {}", examples::vector(n, "1")));
    let position = position.and_then(|item| vector(item, n, problems));
    let keys: &[&str] = if n <= 3 { &["inertia", "S"] } else { &["S"] };
    let inertia = match section.one_of(keys, &examples::inertia(n), problems) {
        Some(("inertia", item)) if n == 2 => {
            spanned(item, document::real(item, problems).map(|x| InertiaEntry::Moment(x.value)))
        }
        Some(("inertia", item)) => spanned(item, matrix(item, n, problems).map(InertiaEntry::Tensor)),
        Some((_, item)) => spanned(item, matrix(item, n, problems).map(InertiaEntry::SecondMoments)),
        None => None,
    };
    section.finish(problems);
    Some(BodyEntry { position: position?.value, free: Some((mass?, inertia?)) })
}

fn spanned<T>(item: &Item, value: Option<T>) -> Option<Spanned<T>> {
    value.map(|value| Spanned::new(value, item.span))
}

/// Whether a mass is written as infinite; a number with digits is finite, however large.
fn is_infinite(mass: &Item, source: &Source) -> bool {
    match &mass.value {
        Value::Float(x) => *x == f64::INFINITY && !source.slice(mass.span).contains(|c: char| c.is_ascii_digit()),
        Value::Text(text) => text == "inf" || text == "infinity",
        _ => false,
    }
}

/// Whether a text means infinity.
fn is_infinity(text: &str) -> bool {
    ["inf", "infinity", "\u{221e}"].contains(&&text.trim_start_matches('+').to_lowercase()[..])
}

fn finite_mass(item: &Item, problems: &mut Problems) -> Option<Spanned<f64>> {
    match &item.value {
        Value::Float(x) if *x == f64::INFINITY => {
            let what = format!("the number is not between {SMALLEST:e} and {LARGEST:e}");
            problems.add_with_help(item.span, what, "write a smaller number, or for a fixed body mass = \"inf\"");
            None
        }
        Value::Text(text) if is_infinity(text) => {
            problems.add_with_help(item.span, format!("unknown mass \"{text}\""), "write mass = \"inf\"");
            None
        }
        _ => document::positive(item, problems),
    }
}

fn motion(item: &Item, n: usize, problems: &mut Problems) -> Option<Motion> {
    let mut section = Section::inline(item, "a velocity", &examples::motion(n, "-1"), problems)?;
    let v = section.required("v", &format!("v = {}", examples::vector(n, "-1")));
    let v = v.and_then(|item| vector(item, n, problems));
    let w = section.required("w", &format!("w = {}", examples::no_spin(n))).and_then(|item| {
        let w = match n {
            2 => document::real(item, problems).map(|w| vec![w.value]),
            3 => vector(item, 3, problems).map(|w| w.value),
            _ => matrix(item, n, problems),
        };
        spanned(item, w)
    });
    section.finish(problems);
    Some(Motion { v: v?, w: w? })
}

fn rough(item: &Item, n: usize, problems: &mut Problems) -> Option<LawEntry> {
    if scene::is_one_vector(item, "rough", "direction", problems) {
        return None;
    }
    let Value::List(items) = &item.value else {
        problems.add_with_help(
            item.span,
            format!("rough must be an array of directions, found {}", item.value.kind()),
            format!("write directions in brackets, and brackets around all, as in [[1{}]]", ", 0".repeat(n - 1)),
        );
        return None;
    };
    let directions: Vec<_> = items.iter().map(|item| vector(item, n, problems)).collect();
    if items.len() >= n {
        let span = items[n - 1..].iter().fold(items[n - 1].span, |span: Span, item| span.join(item.span));
        let what = format!("{} rough directions are too many: the contact plane has dimension {}", items.len(), n - 1);
        problems.add(span, what);
    }
    directions.into_iter().collect::<Option<_>>().map(LawEntry::Rough)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(name: &str, text: &str) -> Result<ContactFile, (String, String)> {
        ContactFile::parse(&Source::new(name, text)).map_err(|mut wrong| {
            let first = wrong.swap_remove(0);
            (first.what, first.help.unwrap_or_default())
        })
    }

    /// A contact whose second body has this mass.
    fn with_mass(mass: &str) -> Result<ContactFile, (String, String)> {
        let bodies = format!(
            "[{{ mass = 1, position = [0, 1], inertia = 1 }}, {{ mass = {mass}, position = [0, -1], inertia = 1 }}]"
        );
        let pre = "[{ v = [0, -1], w = 0 }, { v = [0, 0], w = 0 }]";
        let contact = "dim = 2\nlaw = \"no-slip\"\ncontact_point = [0, 0]\nnormal = [0, 1]";
        read("x.toml", &format!("{contact}\npre = {pre}\nbodies = {bodies}"))
    }

    #[test]
    fn a_mass_with_digits_is_finite_however_large() {
        for mass in ["1e400", "1_0e999", "+1e309"] {
            let (what, help) = with_mass(mass).unwrap_err();
            assert_eq!(what, "the number is not between 1e-150 and 1e150", "{mass}");
            assert_eq!(help, "write a smaller number, or for a fixed body mass = \"inf\"");
        }
        let (what, _) = with_mass("1e200").unwrap_err();
        assert_eq!(what, "1e200 is not between 1e-150 and 1e150");
    }

    #[test]
    fn an_infinite_mass_is_told_how_it_is_written() {
        for mass in ["inf", "+inf", "\"inf\"", "\"infinity\""] {
            assert!(with_mass(mass).unwrap().bodies.value[1].free.is_none(), "{mass}");
        }
        for mass in ["Infinity", "Inf", "INF", "+inf", "\u{221e}"] {
            let expected = (format!("unknown mass \"{mass}\""), "write mass = \"inf\"".into());
            assert_eq!(with_mass(&format!("\"{mass}\"")).unwrap_err(), expected);
        }
        assert_eq!(with_mass("-inf").unwrap_err().0, "the number is infinite");
    }

    #[test]
    fn what_is_no_table_is_shown_a_contact_file_that_can_be_read() {
        for json in ["[1, 2]", "[]"] {
            let (what, help) = read("x.json", json).unwrap_err();
            assert_eq!(what, "the contact file must be a table, found an array");
            read("x.json", help.strip_prefix("write for instance ").unwrap()).unwrap();
        }
    }
}
