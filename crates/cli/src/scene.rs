//! Scene files: what moves, where, under which law, for how long, and what is kept of it.
//!
//! A scene is read into plain data in which every value remembers its place, so that later stages, which build the
//! table and run the orbits, can still point at the line at fault ([`Source::diagnostic`]).

mod boundary;
mod law;
mod output;
mod parameters;
mod particle;
mod run;
mod shapes;
mod start;
mod table;
mod tables;

use crate::document::{self, Diagnostic, Item, Problems, Section, Source, Span, Spanned, Value};

pub use boundary::{Border, Curve, Domain, Edge, EdgePath, Entry, Side, Turn};
pub use law::{LAWS, Law, LawKind, LawModel};
pub(crate) use law::{is_one_vector, named as read_law};
pub use output::Output;
pub use parameters::{Argument, Arguments, Constant, IfAbsent, Kind, Model, Parameter};
pub use particle::{INERTIAS, Inertia, Particle};
pub use run::Limit;
pub use shapes::{Build, SHAPES, Shape};
pub use start::{Ensemble, Orbit, SAMPLES, Sample, Starts};
pub use table::{PieceLaw, Table, TableShape};
pub use tables::TABLES;

/// A scene file, read and checked as far as that is possible without geometry.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The file.
    pub source: Source,
    /// The title, if it has one.
    pub title: Option<String>,
    /// Dimension of space, 2 or 3.
    pub dimension: usize,
    /// The law of every piece without one of its own.
    pub law: Law,
    /// The table.
    pub table: Table,
    /// What moves.
    pub particle: Particle,
    /// Where it starts.
    pub starts: Starts,
    /// When an orbit ends; absent only if [`Request::needs_limit`] was false.
    pub limit: Option<Limit>,
    /// What is kept.
    pub output: Output,
}

/// What the command line says beside the scene file.
#[derive(Clone, Debug)]
pub struct Request {
    /// A law that takes the place of the scene's; pieces with a law of their own keep it.
    pub law: Option<LawKind>,
    /// A number of collisions per orbit that takes the place of the scene's limit.
    pub collisions: Option<u64>,
    /// Whether a scene without a limit is an error.
    pub needs_limit: bool,
}

impl Default for Request {
    fn default() -> Self {
        Self { law: None, collisions: None, needs_limit: true }
    }
}

impl Scene {
    /// Reads a scene.
    ///
    /// # Errors
    /// Everything that is wrong with it, in the order of the file.
    ///
    /// ```
    /// use billiards_cli::{document::Source, scene::{Request, Scene}};
    ///
    /// let text = r#"
    /// law = "no-slip"
    /// table = { name = "circle" }
    /// orbit = [{ position = [0, 0], velocty = [1, 0] }]
    /// run = { collisions = 10 }
    /// "#;
    /// let errors = Scene::parse(&Source::new("x.toml", text), &Request::default()).unwrap_err();
    /// assert_eq!(errors[0].help.as_deref(), Some("did you mean \"velocity\"?"));
    /// ```
    pub fn parse(source: &Source, request: &Request) -> Result<Self, Vec<Diagnostic>> {
        let mut problems = Problems::new(source);
        let scene = document::parse_toml(&mut problems).and_then(|item| {
            let root = Section::new(&item, "the scene", &mut problems)?;
            read(root, request, &mut problems)
        });
        match scene {
            Some(scene) if problems.is_empty() => Ok(scene),
            _ => Err(problems.into_diagnostics()),
        }
    }
}

fn read(mut root: Section<'_>, request: &Request, problems: &mut Problems) -> Option<Scene> {
    if let Some((key, _)) = root.others().find(|(key, _)| key.value == "contact_point") {
        let what = "a scene has no contact point: this file describes a single collision";
        problems.add_with_help(key.span, what, "compute it: billiards collide CONTACT");
        return None;
    }
    // reported alone, before vectors of another dimension are taken for mistakes
    if let Some((key, _)) = root.others().find(|(key, _)| key.value == "dimension") {
        let what = "unknown key \"dimension\" in the scene";
        problems.add_with_help(key.span, what, "\"dimension\" goes under [table]");
        return None;
    }
    let title = root
        .optional("title")
        .and_then(|item| text(item, "write for instance \"Stadium\"", problems))
        .map(|title| title.value);
    let table_item = root.required("table", "[table] with name = \"stadium\"");
    let dimension = table_item.map_or(Some(2), |item| table::dimension(item, problems));
    // Hardly anything can be checked in a scene of unknown dimension.
    let n = dimension?;
    let table = table_item.and_then(|item| table::read(item, n, problems));
    let law = match &request.law {
        Some(kind) => {
            law::at_most_one(&mut root, n, problems);
            Some(Law { kind: kind.clone(), span: Span::default() })
        }
        None => law::exactly_one(&mut root, n, problems),
    };
    let laws = law.iter().map(|law| &law.kind).chain(table.iter().flat_map(Table::own_laws));
    let spins = laws.into_iter().any(|law| *law != LawKind::Specular);
    let particle = particle::read(root.optional("particle"), n, spins, problems);
    let starts = start::read(&mut root, n, particle.as_ref(), problems);
    let limit = run::read(&mut root, request, problems);
    let output = output::read(root.optional("output"), problems);
    root.finish(problems);
    problems.learn("at the top of the file, before all sections", &["title", "law", "rough"]);
    Some(Scene {
        source: problems.source().clone(),
        title,
        dimension: n,
        law: law?,
        table: table?,
        particle: particle?,
        starts: starts?,
        limit,
        output: output?,
    })
}

/// A missing section, read as one without keys, so that its possible keys are known.
fn absent() -> Item {
    Item::new(Value::Table(vec![]), Span::default())
}

/// A string; `help` says what it should be.
fn text(item: &document::Item, help: &str, problems: &mut Problems) -> Option<Spanned<String>> {
    match &item.value {
        Value::Text(text) => Some(Spanned::new(text.clone(), item.span)),
        other => {
            problems.add_with_help(item.span, format!("expected a string, found {}", other.kind()), help);
            None
        }
    }
}

/// One of a few words; `what` says what they name, for messages.
fn choice<T: Clone>(item: &document::Item, what: &str, choices: &[(&str, T)], problems: &mut Problems) -> Option<T> {
    let word = text(item, &known(choices.iter().map(|c| c.0)), problems)?.value;
    if let Some((_, value)) = choices.iter().find(|(name, _)| *name == word) {
        return Some(value.clone());
    }
    let names = choices.iter().map(|c| c.0);
    unknown(item.span, what, &word, names, problems);
    None
}

/// Help that lists the known words.
fn known<'a>(words: impl Iterator<Item = &'a str>) -> String {
    format!("known: {}", words.collect::<Vec<_>>().join(", "))
}

/// Records that a word is none of the known ones.
fn unknown<'a>(
    span: Span,
    what: &str,
    word: &str,
    words: impl Iterator<Item = &'a str> + Clone,
    problems: &mut Problems,
) {
    let help = match crate::spelling::closest(word, words.clone()) {
        Some(near) => format!("did you mean \"{near}\"?"),
        None => known(words),
    };
    problems.add_with_help(span, format!("unknown {what} \"{word}\""), help);
}

/// The items of an array; `example` shows one.
fn list<'a>(
    item: &'a document::Item,
    what: &str,
    example: &str,
    problems: &mut Problems,
) -> Option<&'a [document::Item]> {
    match &item.value {
        Value::List(items) => Some(items),
        other => {
            let written = problems.source().slice(item.span);
            let is_short = written.chars().count() <= 60 && !written.contains('\n');
            let is_section = what.starts_with("[[") && !matches!(other, Value::Table(_));
            let is_item = match other {
                Value::Text(_) => example.starts_with("[\""),
                Value::Table(_) => example.starts_with("[{"),
                _ => false,
            };
            let help = match what {
                section if is_section => format!("write {section}, and its keys on the lines below"),
                _ if !is_item => format!("write for instance {example}"),
                _ if is_short => format!("write [{written}]"),
                _ => "put it in brackets, [ and ]".into(),
            };
            problems.add_with_help(item.span, format!("{what} must be an array, found {}", other.kind()), help);
            None
        }
    }
}

/// A point: coordinates of at most 10¹⁵⁰ in absolute value.
fn point(item: &document::Item, dimension: usize, problems: &mut Problems) -> Option<Spanned<Vec<f64>>> {
    document::vector(item, dimension, problems)
}

/// A vector with a direction: not zero, and of a length that squares to a normal number.
fn direction(item: &document::Item, dimension: usize, problems: &mut Problems) -> Option<Spanned<Vec<f64>>> {
    let vector = point(item, dimension, problems)?;
    let length = vector.value.iter().fold(0.0, |length, x| libm::hypot(length, *x));
    if length == 0.0 {
        let help = if dimension == 2 { "write for instance [1, 0]" } else { "write for instance [1, 0, 0]" };
        problems.add_with_help(item.span, "the zero vector has no direction", help);
    } else if !(document::SMALLEST..=document::LARGEST).contains(&length) {
        problems.add_with_help(
            item.span,
            format!("its length {length:?} is not between {:?} and {:?}", document::SMALLEST, document::LARGEST),
            if length > 1.0 { "make it shorter" } else { "make it longer" },
        );
    } else {
        return Some(vector);
    }
    None
}
