//! `[particle]`: the disk or ball that moves.

use super::{absent, choice};
use crate::document::{Item, Problems, Section, Spanned, nonnegative};

/// The disk or ball that moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Particle {
    /// Its radius; 0: the table is the region of centres.
    pub radius: Spanned<f64>,
    /// γ² = I/(m R²), the moment of inertia about a diameter (in the plane: the centre) over mass and radius squared.
    pub gamma_squared: Spanned<f64>,
}

/// A mass distribution known by name.
#[derive(Clone, Copy, Debug)]
pub struct Inertia {
    /// Its name in a scene.
    pub name: &'static str,
    /// Dimension of space, 2 or 3.
    pub dimension: usize,
    /// γ² = I/(m R²).
    pub gamma_squared: f64,
}

/// Every mass distribution a scene can name; the first of each dimension is the default.
pub const INERTIAS: &[Inertia] = &[
    Inertia { name: "uniform-disk", dimension: 2, gamma_squared: 1.0 / 2.0 },
    Inertia { name: "hoop", dimension: 2, gamma_squared: 1.0 },
    Inertia { name: "point", dimension: 2, gamma_squared: 0.0 },
    Inertia { name: "uniform-ball", dimension: 3, gamma_squared: 2.0 / 5.0 },
    Inertia { name: "shell", dimension: 3, gamma_squared: 2.0 / 3.0 },
    Inertia { name: "point", dimension: 3, gamma_squared: 0.0 },
];

/// Reads the section; `spins` says whether some law uses γ², so that the section, if present, has to give it.
pub(super) fn read(item: Option<&Item>, dimension: usize, spins: bool, problems: &mut Problems) -> Option<Particle> {
    let known: Vec<_> =
        INERTIAS.iter().filter(|i| i.dimension == dimension).map(|i| (i.name, i.gamma_squared)).collect();
    let default = known.first().map_or(0.0, |k| k.1);
    let (spins, absent) = (spins && item.is_some(), absent());
    let item = item.unwrap_or(&absent);
    let mut section = Section::new(item, "[particle]", problems)?;
    let radius =
        section.optional("radius").map_or(Some(Spanned::new(0.0, item.span)), |item| nonnegative(item, problems));
    let example = format!("inertia = \"{}\"", known.first().map_or("point", |k| k.0));
    let pair = ["inertia", "gamma_squared"];
    let found = if spins { section.one_of(&pair, &example, problems) } else { section.at_most_one_of(&pair, problems) };
    let gamma_squared = match found {
        Some(("inertia", item)) => {
            choice(item, "inertia", &known, problems).map(|gamma_squared| Spanned::new(gamma_squared, item.span))
        }
        Some((_, item)) => nonnegative(item, problems),
        None => Some(Spanned::new(default, item.span)),
    };
    section.finish(problems);
    Some(Particle { radius: radius?, gamma_squared: gamma_squared? })
}
