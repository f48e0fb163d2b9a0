//! `law = "no-slip"`, `law = { name = "restitution", … }` or `rough = [[1, 2, -3]]`, the last also as `law = { rough = … }`.

use billiards::collision_laws::LOST_DIRECTION;

use super::{choice, direction, list};
use crate::document::{Item, Problems, Section, Span, Value, number, seed, spell, whole};

/// A collision law and where it was chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct Law {
    /// The law.
    pub kind: LawKind,
    /// Its place in the scene; empty if it comes from the command line.
    pub span: Span,
}

/// The laws a scene can name.
#[derive(Clone, Debug, PartialEq)]
pub enum LawKind {
    /// Only the normal velocity reverses.
    Specular,
    /// The whole contact velocity reverses.
    NoSlip,
    /// The contact velocity reverses along the normal and these directions, projected into the contact plane.
    Rough(Vec<Vec<f64>>),
    /// Rough directions spread uniformly over the subspaces of this dimension; at each collision the seed and the contact
    /// point, to the last digit, determine them.
    Random {
        /// Number of rough directions.
        rank: usize,
        /// Seed of the choice.
        seed: u64,
    },
    /// Not strict: the share of the contact velocity that comes back.
    Restitution {
        /// Along the normal, 0 … 1.
        normal: f64,
        /// Along the contact plane, −1 (no effect) … 1 (all of it reverses).
        tangential: f64,
    },
}

/// A law that scenes can name, as `billiards laws` describes it.
#[derive(Clone, Debug)]
pub struct LawModel {
    /// Its name in a scene.
    pub name: &'static str,
    /// How a scene writes it.
    pub example: &'static str,
    /// What it does, in one line.
    pub summary: &'static str,
    form: Form,
}

/// What stands in a scene for a law.
#[derive(Clone, Debug)]
enum Form {
    /// Its name alone.
    Name(LawKind),
    /// Its name with parameters, which this function reads.
    Table(fn(&mut Section<'_>, usize, &mut Problems) -> Option<LawKind>),
    /// A list of rough directions in place of the name.
    Directions,
}

/// Every law a scene can name.
pub const LAWS: &[LawModel] = &[
    LawModel {
        name: "specular",
        example: "law = \"specular\"",
        summary: "the normal velocity reverses, spin and tangential velocity do not change (k = 0)",
        form: Form::Name(LawKind::Specular),
    },
    LawModel {
        name: "no-slip",
        example: "law = \"no-slip\"",
        summary: "the whole velocity of the contact point reverses (k = N-1)",
        form: Form::Name(LawKind::NoSlip),
    },
    LawModel {
        name: "rough",
        example: "rough = [[1, 2, -3]]",
        summary: "the contact velocity reverses along the normal and the given directions (k = their number)",
        form: Form::Directions,
    },
    LawModel {
        name: "random",
        example: "law = { name = \"random\", rank = 1, seed = 0 }",
        summary: "k = rank rough directions, uniformly random, as a function of the seed, the contact point and the piece",
        form: Form::Table(random),
    },
    LawModel {
        name: "restitution",
        example: "law = { name = \"restitution\", normal = 0.9, tangential = 0 }",
        summary: "loses energy: -normal and -tangential times the normal and tangential contact velocity (of a ball; see the guide)",
        form: Form::Table(restitution),
    },
];

impl std::fmt::Display for LawKind {
    /// In the form used in the summary of a run.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Specular => f.write_str("specular"),
            Self::NoSlip => f.write_str("no-slip"),
            Self::Rough(directions) => {
                let one = |d: &Vec<f64>| format!("[{}]", d.iter().map(|x| spell(*x)).collect::<Vec<_>>().join(", "));
                write!(f, "rough [{}]", directions.iter().map(one).collect::<Vec<_>>().join(", "))
            }
            Self::Random { rank, seed } => write!(f, "random rank {rank} seed {seed}"),
            Self::Restitution { normal, tangential } => {
                write!(f, "restitution normal {} tangential {}", spell(*normal), spell(*tangential))
            }
        }
    }
}

impl std::str::FromStr for LawKind {
    type Err = String;

    /// A law without parameters, by its name.
    fn from_str(name: &str) -> Result<Self, String> {
        let Some(law) = LAWS.iter().find(|law| law.name == name) else {
            return Err(match crate::spelling::closest(name, LAWS.iter().map(|law| law.name)) {
                Some(near) => format!("unknown law; did you mean \"{near}\"?"),
                None => "unknown law; write specular or no-slip, which have no parameters; `billiards laws` lists all laws that a \
                         scene can name"
                    .into(),
            });
        };
        let in_the_plane = match &law.form {
            Form::Name(kind) => return Ok(kind.clone()),
            Form::Table(_) => "",
            Form::Directions => " (in the plane rough = [[1, 0]])",
        };
        Err(format!(
            "this law has parameters: write {}{in_the_plane} in place of the scene's law; see `billiards guide`",
            law.example
        ))
    }
}

/// The law of a table that must have one.
pub(super) fn exactly_one(section: &mut Section<'_>, dimension: usize, problems: &mut Problems) -> Option<Law> {
    let found = section.one_of(&["law", "rough"], "law = \"no-slip\"", problems)?;
    read(found, dimension, problems)
}

/// The law of a table that may have one; `None` also if it is wrong, which is then recorded.
pub(super) fn at_most_one(section: &mut Section<'_>, dimension: usize, problems: &mut Problems) -> Option<Law> {
    let found = section.at_most_one_of(&["law", "rough"], problems)?;
    read(found, dimension, problems)
}

fn read((key, item): (&str, &Item), dimension: usize, problems: &mut Problems) -> Option<Law> {
    let kind = if key == "rough" { rough(item, dimension, problems) } else { named(item, dimension, problems) };
    kind.map(|kind| Law { kind, span: item.span })
}

/// A law by name, by name with parameters, or by its rough directions: a value that stands wherever a law may.
pub(crate) fn named(item: &Item, dimension: usize, problems: &mut Problems) -> Option<LawKind> {
    let names: Vec<_> = LAWS.iter().map(|law| (law.name, law)).collect();
    if let Value::Text(_) = &item.value {
        let model = choice(item, "law", &names, problems)?;
        if let Form::Name(kind) = &model.form {
            return Some(kind.clone());
        }
        problems.add_with_help(
            item.span,
            format!("the law \"{}\" has parameters", model.name),
            format!("write {} in place of \"{}\"", table(model, dimension), model.name),
        );
        return None;
    }
    let Value::Table(_) = item.value else {
        let help = "write for instance \"no-slip\", or { name = \"restitution\", normal = 0.9, tangential = 0 }";
        problems.add_with_help(item.span, format!("a law is a string or a table, not {}", item.value.kind()), help);
        return None;
    };
    let mut section = Section::inline(item, "law", "{ name = \"no-slip\" }", problems)?;
    if let Some(("rough", directions)) = section.at_most_one_of(&["name", "rough"], problems) {
        let kind = rough(directions, dimension, problems);
        section.finish(problems);
        return kind;
    }
    let named =
        section.required("name", "name = \"restitution\"").and_then(|item| choice(item, "law", &names, problems));
    let kind = match named.map(|model| &model.form) {
        Some(Form::Directions) => {
            let what = "the law \"rough\" is given by its directions alone";
            problems.add_with_help(item.span, what, format!("write {}", rough_example(dimension)));
            section.finish_leniently(problems);
            return None;
        }
        Some(Form::Name(kind)) => Some(kind.clone()),
        Some(Form::Table(read)) => read(&mut section, dimension, problems),
        // The keys of an unknown law are unknown, too.
        None => {
            section.finish_leniently(problems);
            return None;
        }
    };
    section.finish(problems);
    kind
}

fn random(section: &mut Section<'_>, dimension: usize, problems: &mut Problems) -> Option<LawKind> {
    let most = dimension as u64 - 1;
    let rank = section.required("rank", "rank = 1").and_then(|item| whole(item, 0..=most, problems));
    let rank = rank.and_then(|rank| usize::try_from(rank.value).ok());
    let seed = section.optional("seed").map_or(Some(0), |item| seed(item, problems));
    Some(LawKind::Random { rank: rank?, seed: seed? })
}

fn restitution(section: &mut Section<'_>, _: usize, problems: &mut Problems) -> Option<LawKind> {
    let normal = section.required("normal", "normal = 0.9").and_then(|item| coefficient(item, 0.0, problems));
    let tangential =
        section.required("tangential", "tangential = 0").and_then(|item| coefficient(item, -1.0, problems));
    Some(LawKind::Restitution { normal: normal?, tangential: tangential? })
}

/// How to write a law with parameters as a value.
fn table(model: &LawModel, dimension: usize) -> String {
    match model.example.strip_prefix("law = ") {
        Some(table) => table.into(),
        None => rough_example(dimension),
    }
}

/// A law that is rough along the first axis.
fn rough_example(dimension: usize) -> String {
    format!("{{ rough = {} }}", first_axis(dimension))
}

/// The direction of the first axis, as the only one of a list.
fn first_axis(dimension: usize) -> String {
    format!("[[1{}]]", ", 0".repeat(dimension - 1))
}

fn coefficient(item: &Item, least: f64, problems: &mut Problems) -> Option<f64> {
    let x = number(item, problems)?.value;
    if (least..=1.0).contains(&x) {
        return Some(x);
    }
    problems.add(item.span, format!("{} is not between {least} and 1", spell(x)));
    None
}

/// Records that a list of vectors is a list of numbers, apparently a single vector; `vector` is the word for one.
pub(crate) fn is_one_vector(item: &Item, key: &str, vector: &str, problems: &mut Problems) -> bool {
    let is_number = |item: &Item| matches!(item.value, Value::Integer(_) | Value::Float(_) | Value::Text(_));
    let is_one = matches!(&item.value, Value::List(items) if !items.is_empty() && items.iter().all(is_number));
    if is_one {
        let written = problems.source().slice(item.span).split_whitespace().collect::<Vec<_>>().join(" ");
        problems.add_with_help(
            item.span,
            format!("{key} is a list of {vector}s, not one {vector}"),
            format!("write [{written}]"),
        );
    }
    is_one
}

fn rough(item: &Item, dimension: usize, problems: &mut Problems) -> Option<LawKind> {
    if is_one_vector(item, "rough", "direction", problems) {
        return None;
    }
    let items = list(item, "rough", &first_axis(dimension), problems)?;
    let read: Vec<_> = items.iter().map(|item| direction(item, dimension, problems)).collect();
    if items.len() >= dimension {
        problems.add(
            item.span,
            format!("{} rough directions, but the contact plane has dimension {}", items.len(), dimension - 1),
        );
        return None;
    }
    let directions: Vec<Vec<f64>> = read.into_iter().map(|d| d.map(|d| d.value)).collect::<Option<_>>()?;
    if let [a, b] = &directions[..]
        && parallel(a, b)
    {
        problems.add(items[1].span, "this rough direction is parallel to the first");
        return None;
    }
    Some(LawKind::Rough(directions))
}

/// Whether so little of one nonzero vector is across the other that no contact pushes in the directions of both.
fn parallel(a: &[f64], b: &[f64]) -> bool {
    let scaled = |v: &[f64]| -> Vec<f64> {
        let size = v.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        v.iter().map(|x| x / size).collect()
    };
    let (a, b) = (scaled(a), scaled(b));
    let square = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>();
    let minors = (0..a.len()).flat_map(|i| (0..i).map(move |j| [i, j])).map(|[i, j]| a[i] * b[j] - a[j] * b[i]);
    // |a ∧ b|² = (|a| |b| sin)²
    let across = minors.map(|minor| minor * minor).sum::<f64>();
    across <= LOST_DIRECTION * LOST_DIRECTION * square(&a) * square(&b)
}
