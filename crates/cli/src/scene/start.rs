//! `[[orbit]]` or `[ensemble]`: where orbits start.

use super::{INERTIAS, Particle, choice, direction, list, point};
use crate::document::{Item, Problems, Section, Span, Spanned, Value, count, positive, real, seed};

/// Largest ratio of a spin to the speed of the centre: even with the square of this, the energy of the centre does not underflow
/// beside that of the spin.
const MOST_SPIN: f64 = 1e100;

/// Where orbits start.
#[derive(Clone, Debug)]
pub enum Starts {
    /// One by one.
    Orbits(Vec<Orbit>),
    /// Drawn or laid out by rule.
    Ensemble(Ensemble),
}

/// One start.
#[derive(Clone, Debug, PartialEq)]
pub struct Orbit {
    /// Where the orbit stands in the file.
    pub span: Span,
    /// Centre of the particle.
    pub position: Spanned<Vec<f64>>,
    /// Its velocity, not zero.
    pub velocity: Spanned<Vec<f64>>,
    /// In the plane v0 = γ R θ̇ (one number), in space W = γ R ω (three).
    pub spin: Spanned<Vec<f64>>,
    /// In the plane x0 = γ R θ; 0 in space.
    pub angle: Spanned<f64>,
}

/// Many starts by rule. Start `i` of a canonical sample depends only on `seed` and `i`, that of a grid only on `count` and `i`.
#[derive(Clone, Debug, PartialEq)]
pub struct Ensemble {
    /// Where `[ensemble]` stands.
    pub span: Span,
    /// How many.
    pub count: Spanned<u64>,
    /// Seed of the random choices.
    pub seed: u64,
    /// How they are chosen.
    pub sample: Spanned<Sample>,
    /// Length of the whole velocity, spin included.
    pub speed: Spanned<f64>,
}

/// A way to choose the starts of an ensemble.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sample {
    /// The invariant measure: points uniform along the walls, tangential velocity and spin uniform in a ball.
    Canonical,
    /// One start in each of so many cells of equal measure.
    Grid,
}

/// The name of every sample.
pub const SAMPLES: &[(&str, Sample)] = &[("canonical", Sample::Canonical), ("grid", Sample::Grid)];

/// Reads where orbits start; the particle, if it could be read, decides whether they can have a spin.
pub(super) fn read(
    root: &mut Section<'_>,
    dimension: usize,
    particle: Option<&Particle>,
    problems: &mut Problems,
) -> Option<Starts> {
    problems.learn("under [[orbit]]", &["position", "velocity", "spin"]);
    problems.learn("under [ensemble]", &["count", "seed", "sample", "speed"]);
    let example =
        if dimension == 2 { "[0, 0] and velocity = [0.6, 0.8]" } else { "[0, 0, 0] and velocity = [0.6, 0, 0.8]" };
    match root.one_of(&["orbit", "ensemble"], &format!("[[orbit]] with position = {example}"), problems)? {
        ("orbit", item) => {
            let orbits = orbits(item, dimension, problems)?;
            if particle.is_some_and(|particle| particle.gamma_squared.value == 0.0) {
                for orbit in &orbits {
                    of_point(orbit, dimension, problems);
                }
            }
            Some(Starts::Orbits(orbits))
        }
        (_, item) => ensemble(item, problems).map(Starts::Ensemble),
    }
}

fn orbits(item: &Item, dimension: usize, problems: &mut Problems) -> Option<Vec<Orbit>> {
    if let Value::Table(_) = item.value {
        // An [orbit] can only mean a single [[orbit]].
        return orbit(item, dimension, problems).map(|orbit| vec![orbit]);
    }
    let items = list(item, "[[orbit]]", "[{ ... }]", problems)?;
    if items.is_empty() {
        problems.add(item.span, "there are no orbits");
    }
    let orbits: Vec<_> = items.iter().map(|item| orbit(item, dimension, problems)).collect();
    orbits.into_iter().collect()
}

fn orbit(item: &Item, n: usize, problems: &mut Problems) -> Option<Orbit> {
    let mut section = Section::new(item, "[[orbit]]", problems)?;
    let position = section
        .required("position", if n == 2 { "position = [0, 0]" } else { "position = [0, 0, 0]" })
        .and_then(|item| point(item, n, problems));
    let velocity = section
        .required("velocity", if n == 2 { "velocity = [0.6, 0.8]" } else { "velocity = [0.6, 0, 0.8]" })
        .and_then(|item| direction(item, n, problems));
    let spin = match (section.optional("spin"), n) {
        (Some(item), 2) => real(item, problems).map(|spin| spin.map(|spin| vec![spin])),
        (Some(item), _) => point(item, 3, problems),
        (None, _) => Some(Spanned::new(vec![0.0; if n == 2 { 1 } else { 3 }], item.span)),
    };
    let angle = match if n == 2 { section.optional("angle") } else { None } {
        Some(item) => real(item, problems),
        None => Some(Spanned::new(0.0, item.span)),
    };
    if let (Some(velocity), Some(spin)) = (&velocity, &spin) {
        slow_enough(velocity, spin, problems);
    }
    section.finish(problems);
    Some(Orbit { span: item.span, position: position?, velocity: velocity?, spin: spin?, angle: angle? })
}

/// Records a spin so fast that the velocity would be negligible beside it.
fn slow_enough(velocity: &Spanned<Vec<f64>>, spin: &Spanned<Vec<f64>>, problems: &mut Problems) {
    let [speed, fast] = [velocity, spin].map(|v| v.value.iter().fold(0.0, |norm, x| libm::hypot(norm, *x)));
    if fast / MOST_SPIN > speed {
        let what = format!("the spin, {fast:e}, is more than {MOST_SPIN:e} times the speed of the centre, {speed:e}");
        problems.add_with_help(spin.span, what, "make the spin smaller, or the velocity larger");
    }
}

/// Records as an error a spin or an angle of a point: these are γ R times the physical ones, and γ = 0 for a point, so they must
/// be 0.
fn of_point(orbit: &Orbit, dimension: usize, problems: &mut Problems) {
    let example =
        INERTIAS.iter().find(|inertia| inertia.dimension == dimension).map_or("point", |inertia| inertia.name);
    let spins = orbit.spin.value.iter().any(|spin| *spin != 0.0);
    for (key, is_there, span) in
        [("spin", spins, orbit.spin.span), ("angle", orbit.angle.value != 0.0, orbit.angle.span)]
    {
        if is_there {
            let help = format!("leave \"{key}\" out, or give [particle] for instance inertia = \"{example}\"");
            problems.add_with_help(span, format!("a point has no {key}: its \u{3b3}\u{b2} is 0"), help);
        }
    }
}

fn ensemble(item: &Item, problems: &mut Problems) -> Option<Ensemble> {
    let mut section = Section::new(item, "[ensemble]", problems)?;
    let number = section.required("count", "count = 1000").and_then(|item| count(item, 1, problems));
    let seed = section.optional("seed").map_or(Some(0), |item| seed(item, problems));
    let sample = match section.optional("sample") {
        Some(item) => choice(item, "sample", SAMPLES, problems).map(|sample| Spanned::new(sample, item.span)),
        None => Some(Spanned::new(Sample::Canonical, item.span)),
    };
    let speed = section.optional("speed").map_or(Some(Spanned::new(1.0, item.span)), |item| positive(item, problems));
    section.finish(problems);
    Some(Ensemble { span: item.span, count: number?, seed: seed?, sample: sample?, speed: speed? })
}
