//! `[run]`: when an orbit ends.

use super::{Request, absent};
use crate::document::{Item, Problems, Section, Spanned, count, positive};

/// When an orbit ends, if nothing else ends it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limit {
    /// After this many collisions.
    Collisions(Spanned<u64>),
    /// After this time.
    Time(Spanned<f64>),
}

/// The limit of the scene or the command line; `None` also if it is wrong, which is then recorded.
pub(super) fn read(root: &mut Section<'_>, request: &Request, problems: &mut Problems) -> Option<Limit> {
    let given = request.collisions.map(|n| Limit::Collisions(Spanned { value: n, ..Spanned::default() }));
    let needed = request.needs_limit && given.is_none();
    let item = if needed {
        root.required("run", "[run] with collisions = 1000, or give -n 1000")
    } else {
        root.optional("run")
    };
    let written = written(item.unwrap_or(&absent()), needed && item.is_some(), problems);
    given.or(written)
}

fn written(item: &Item, needed: bool, problems: &mut Problems) -> Option<Limit> {
    let mut section = Section::new(item, "[run]", problems)?;
    let keys = ["collisions", "time"];
    let found = if needed {
        section.one_of(&keys, "collisions = 1000", problems)
    } else {
        section.at_most_one_of(&keys, problems)
    };
    section.finish(problems);
    match found? {
        ("collisions", item) => count(item, 1, problems).map(Limit::Collisions),
        (_, item) => positive(item, problems).map(Limit::Time),
    }
}
