//! `[table]`: a built-in table by name, or a boundary piece by piece; perhaps repeated on a lattice.

use super::boundary::{self, Border, Entry};
use super::law::{self, LawKind};
use super::parameters::{self, Arguments, Model};
use super::{direction, list};
use crate::document::{Item, Problems, Section, Span, Spanned, Value, number};

/// The table of a scene.
#[derive(Clone, Debug)]
pub struct Table {
    /// Where `[table]` stands.
    pub span: Span,
    /// What bounds it.
    pub shape: TableShape,
    /// Translations that identify points of space: none, one (a channel) or two (a flat torus).
    pub lattice: Vec<Spanned<Vec<f64>>>,
    /// `laws = { 0 = "specular" }`: laws of single pieces, by their numbers.
    pub laws: Vec<PieceLaw>,
}

impl Table {
    /// The laws of pieces that have one of their own.
    pub(super) fn own_laws(&self) -> impl Iterator<Item = &LawKind> {
        let entries: &[Entry] = if let TableShape::Boundary(entries) = &self.shape { entries } else { &[] };
        let of_entries = entries.iter().filter_map(|entry| entry.law.as_ref());
        let of_edges = entries.iter().flat_map(|entry| entry.border.edges()).filter_map(|edge| edge.law.as_ref());
        self.laws.iter().map(|piece| &piece.law).chain(of_entries.chain(of_edges).map(|law| &law.kind))
    }

    /// The names of the drawings and meshes beside the scene file.
    pub fn files(&self) -> impl Iterator<Item = &Spanned<String>> {
        let entries: &[Entry] = if let TableShape::Boundary(entries) = &self.shape { entries } else { &[] };
        entries.iter().filter_map(|entry| match &entry.border {
            Border::Outline { file, .. } | Border::Mesh { file, .. } => Some(file),
            _ => None,
        })
    }
}

/// The law of one piece of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct PieceLaw {
    /// Number of the piece and its place.
    pub piece: Spanned<usize>,
    /// Its law.
    pub law: LawKind,
}

/// What bounds a table.
#[derive(Clone, Debug)]
pub enum TableShape {
    /// A built-in table.
    Named {
        /// Which one.
        model: &'static Model,
        /// Its parameters.
        arguments: Arguments,
        /// Where it is named.
        span: Span,
    },
    /// `[[table.boundary]]`, in the order of the file.
    Boundary(Vec<Entry>),
}

impl TableShape {
    /// The name of a built-in table, or else `boundary`.
    pub fn name(&self) -> &'static str {
        match self {
            TableShape::Named { model, .. } => model.name,
            TableShape::Boundary(_) => "boundary",
        }
    }
}

/// The dimension a table declares: 2 unless it says otherwise. A misspelt key is reported at once, before vectors of another
/// dimension are taken for mistakes.
pub(super) fn dimension(item: &Item, problems: &mut Problems) -> Option<usize> {
    let Value::Table(entries) = &item.value else { return Some(2) };
    let Some((_, item)) = entries.iter().find(|(key, _)| key.value == "dimension") else {
        let misspelt = |key: &str| crate::spelling::closest(key, ["dimension"]).is_some();
        let Some((key, _)) = entries.iter().find(|(key, _)| misspelt(&key.value)) else { return Some(2) };
        let what = format!("unknown key \"{}\" in [table]", key.value);
        problems.add_with_help(key.span, what, "did you mean \"dimension\"?");
        return None;
    };
    let dimension = number(item, problems)?.value;
    let found = [2, 3].into_iter().find(|n| *n as f64 == dimension);
    if found.is_none() {
        problems.add(item.span, "the dimension must be 2 or 3");
    }
    found
}

pub(super) fn read(item: &Item, dimension: usize, problems: &mut Problems) -> Option<Table> {
    let mut section = Section::new(item, "[table]", problems)?;
    section.optional("dimension");
    let lattice = section.optional("lattice").map_or(Some(Vec::new()), |item| lattice(item, dimension, problems));
    let laws = section.optional("laws").map_or(Some(Vec::new()), |item| laws(item, dimension, problems));
    let kinds = boundary::kinds(dimension);
    problems.learn("under [[table.boundary]]", kinds);
    let keys: Vec<_> = section.others().map(|(key, _)| key).collect();
    let (walls, others): (Vec<_>, Vec<_>) = keys.into_iter().partition(|key| kinds.contains(&&key.value[..]));
    // single walls given in place of their list
    if !walls.is_empty() && !others.iter().any(|key| ["name", "boundary"].contains(&&key.value[..])) {
        for key in walls {
            problems.add_stray(key.span, &key.value, format!("unknown key \"{}\" in [table]", key.value), "");
        }
        return None;
    }
    let example = if dimension == 2 { "name = \"stadium\"" } else { "name = \"box\"" };
    let found = section.one_of(&["name", "boundary"], example, problems);
    let shape = match found {
        Some(("name", item)) => {
            // The keys of an unknown table are unknown, too.
            let model = parameters::model(item, "table", &super::TABLES, dimension, problems)?;
            parameters::arguments(&mut section, item.span, model, problems).map(|arguments| TableShape::Named {
                model,
                arguments,
                span: item.span,
            })
        }
        Some((_, item)) => entries(item, dimension, problems).map(TableShape::Boundary),
        None => {
            section.finish_leniently(problems);
            return None;
        }
    };
    section.finish(problems);
    Some(Table { span: item.span, shape: shape?, lattice: lattice?, laws: laws? })
}

fn entries(item: &Item, dimension: usize, problems: &mut Problems) -> Option<Vec<Entry>> {
    let items = list(item, "[[table.boundary]]", "[{ ... }]", problems)?;
    if items.is_empty() {
        problems.add(item.span, "the boundary has no entries");
    }
    let read: Vec<_> = items.iter().map(|item| boundary::read(item, dimension, problems)).collect();
    read.into_iter().collect()
}

fn lattice(item: &Item, dimension: usize, problems: &mut Problems) -> Option<Vec<Spanned<Vec<f64>>>> {
    if dimension != 2 {
        problems.add_with_help(item.span, "tables in space have no lattice", "leave it out");
        return None;
    }
    if law::is_one_vector(item, "lattice", "vector", problems) {
        return None;
    }
    let items = list(item, "lattice", "[[1, 0], [0, 1]]", problems)?;
    let vectors: Vec<_> = items.iter().map(|item| direction(item, dimension, problems)).collect();
    if !(1..=2).contains(&vectors.len()) {
        problems.add(item.span, format!("a lattice has 1 or 2 translations, not {}", vectors.len()));
        return None;
    }
    vectors.into_iter().collect()
}

/// A key that is the number of a piece. Each number has one spelling, so that a second law for a piece is a key given twice.
fn piece_number(key: &Spanned<String>, problems: &mut Problems) -> Option<usize> {
    let number: Option<usize> = key.value.parse().ok();
    if number.is_some_and(|n| n.to_string() == key.value) {
        return number;
    }
    let help = match number {
        Some(n) => format!("write {n}"),
        None => "write for instance laws = { 0 = \"specular\" }".into(),
    };
    problems.add_with_help(key.span, format!("\"{}\" is not the number of a piece", key.value), help);
    None
}

fn laws(item: &Item, dimension: usize, problems: &mut Problems) -> Option<Vec<PieceLaw>> {
    let section = Section::inline(item, "laws", "laws = { 0 = \"specular\" }", problems)?;
    let read: Vec<_> = section
        .others()
        .map(|(key, item)| {
            let piece = piece_number(key, problems);
            let law = law::named(item, dimension, problems);
            Some(PieceLaw { piece: Spanned::new(piece?, key.span), law: law? })
        })
        .collect();
    read.into_iter().collect()
}
