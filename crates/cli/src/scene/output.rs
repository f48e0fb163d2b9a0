//! `[output]`: what is kept of a run.

use super::{absent, choice, known, list, text, unknown};
use crate::document::{Item, Problems, Section, Span};
use crate::picture;
use crate::record::{FORMATS, RecordFormat};

/// What is kept of a run.
#[derive(Clone, Debug, Default)]
pub struct Output {
    /// The format of the collision record, if one is kept.
    pub collisions: Option<&'static RecordFormat>,
    /// The pictures to draw: names from [`picture::PICTURES`] and their places.
    pub pictures: Vec<(&'static str, Span)>,
}

pub(super) fn read(item: Option<&Item>, problems: &mut Problems) -> Option<Output> {
    let absent = absent();
    let mut section = Section::new(item.unwrap_or(&absent), "[output]", problems)?;
    let formats: Vec<_> = FORMATS.iter().map(|format| (format.name, format)).collect();
    let collisions = match section.optional("collisions") {
        Some(item) => choice(item, "format", &formats, problems).map(Some),
        None => Some(None),
    };
    let pictures = section.optional("pictures").map_or(Some(Vec::new()), |item| pictures(item, problems));
    section.finish(problems);
    Some(Output { collisions: collisions?, pictures: pictures? })
}

fn pictures(item: &Item, problems: &mut Problems) -> Option<Vec<(&'static str, Span)>> {
    let mut pictures: Vec<(&'static str, Span)> = Vec::new();
    for item in list(item, "pictures", "[\"orbit\"]", problems)? {
        let Some(word) = text(item, &known(picture::PICTURES.iter().map(|p| p.name)), problems) else { continue };
        match picture::PICTURES.iter().find(|picture| picture.name == word.value) {
            Some(known) if pictures.iter().any(|p| p.0 == known.name) => {
                problems.add(item.span, format!("the picture \"{}\" is listed twice", known.name));
            }
            Some(known) => pictures.push((known.name, item.span)),
            None => unknown(item.span, "picture", &word.value, picture::PICTURES.iter().map(|p| p.name), problems),
        }
    }
    Some(pictures)
}
