//! Starts of orbits, checked against the table.

use billiards::geometry::{self, Extent, Lattice, Line, Table, Vector2};

use crate::document::{Diagnostic, Span, spell};
use crate::scene::{Ensemble, Orbit, Particle, Scene};

use super::departure::time_to_leave;
use super::remote::Remote;
use super::scale::{Scale, to_unity};
use super::sectors::{self, Ray};
use super::words::short;

/// A start, scaled to the size of the engine.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Start<const N: usize, const S: usize> {
    /// Centre; on a lattice, in the cell where paths are followed.
    pub(crate) position: [f64; N],
    /// Velocity.
    pub(crate) velocity: [f64; N],
    /// Scaled spin.
    pub(crate) spin: [f64; S],
    /// Scaled spin position x0.
    pub(crate) angle: f64,
    /// The cell of the start.
    pub(crate) cell: [f64; 2],
    /// When the engine takes over \[T\]: in a corner, once the path has left it; otherwise at once, at time 0.
    pub(crate) departure: f64,
    /// How it is scaled.
    pub(crate) scale: Scale,
}

/// Where orbits start.
#[derive(Clone, Debug)]
pub(crate) enum Starts<const N: usize, const S: usize> {
    /// Each start is given.
    Given(Vec<Start<N, S>>),
    /// Starts drawn at random, with spin or, for points, without.
    Ensemble(Ensemble, Spins),
}

/// Whether what moves can spin: a point cannot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Spins {
    Spinning,
    Still,
}

impl Spins {
    /// The spins of a particle.
    pub(crate) fn of(particle: &Particle) -> Spins {
        if particle.gamma_squared.value > 0.0 { Spins::Spinning } else { Spins::Still }
    }
}

/// Starts of points, as those of disks or balls that do not spin.
pub(crate) struct Still<T>(pub(crate) T);

impl<T: billiards::Starts<N, 0>, const N: usize, const S: usize> billiards::Starts<N, S> for Still<T> {
    fn start(&self, i: u64) -> billiards::Start<N, S> {
        let billiards::Start { position, velocity, .. } = self.0.start(i);
        billiards::Start { position, velocity, spin: [0.0; S] }
    }
}

impl<const N: usize, const S: usize> Starts<N, S> {
    /// How many there are.
    pub(crate) fn count(&self) -> u64 {
        match self {
            Starts::Given(starts) => starts.len() as u64,
            Starts::Ensemble(ensemble, _) => ensemble.count.value,
        }
    }

    /// The function from an orbit's number to its start, where starts are given; otherwise the ensemble.
    pub(crate) fn given(&self) -> Result<ByNumber<'_, N, S>, (&Ensemble, Spins)> {
        match self {
            // the numbers of orbits are less than the number of starts
            Starts::Given(starts) => Ok(Box::new(|i| starts[usize::try_from(i).unwrap_or(usize::MAX) % starts.len()])),
            Starts::Ensemble(ensemble, spins) => Err((ensemble, *spins)),
        }
    }
}

/// The start of an orbit, by its number.
pub(crate) type ByNumber<'a, const N: usize, const S: usize> = Box<dyn Fn(u64) -> Start<N, S> + Sync + 'a>;

/// The error that an ensemble cannot be drawn from the walls, with advice where they are infinite.
pub(crate) fn undrawable(scene: &Scene, ensemble: &Ensemble, error: &geometry::Error) -> Diagnostic {
    let diagnostic = scene.source.diagnostic(ensemble.span, error.to_string());
    match error {
        geometry::Error::Unbounded { .. } => {
            diagnostic.with_help("give the starts one by one: [[orbit]] with position and velocity")
        }
        geometry::Error::Rim { .. } => diagnostic.with_help(
            "let it reach the other walls, give it a thickness (a flat one may instead be drawn from both sides, with other diagonals on \
             its back), or give the starts one by one: [[orbit]] with position and velocity",
        ),
        _ => diagnostic,
    }
}

/// Scales a start given by its numbers.
pub(crate) fn scaled<const N: usize, const S: usize>(orbit: &Orbit, length: f64) -> Start<N, S> {
    let of = |values: &[f64], i: usize| values.get(i).copied().unwrap_or(0.0);
    let speed = to_unity(orbit.velocity.value.iter().chain(&orbit.spin.value).copied());
    Start {
        position: core::array::from_fn(|i| of(&orbit.position.value, i) * length),
        velocity: core::array::from_fn(|i| of(&orbit.velocity.value, i) * speed),
        spin: core::array::from_fn(|i| of(&orbit.spin.value, i) * speed),
        angle: orbit.angle.value * length,
        cell: [0.0; 2],
        departure: 0.0,
        scale: Scale { length, speed },
    }
}

/// The copy of a point where paths are followed on a lattice, and how many of the lattice vectors it has been moved by.
pub(crate) fn folded(table: &Table, point: &[f64; 2]) -> ([f64; 2], [f64; 2]) {
    table.cell().map_or((*point, [0.0; 2]), |cell| {
        let (home, by) = cell.home(&Vector2::from(*point));
        (home.into(), by)
    })
}

/// All starts, or everything that is wrong with them.
pub(crate) fn all<T>(
    orbits: &[Orbit],
    start: impl Fn(&Orbit) -> Result<T, Box<Diagnostic>>,
) -> Result<Vec<T>, Vec<Diagnostic>> {
    let (mut good, mut bad) = (vec![], vec![]);
    for orbit in orbits {
        match start(orbit) {
            Ok(start) => good.push(start),
            Err(diagnostic) => bad.push(*diagnostic),
        }
    }
    if bad.is_empty() { Ok(good) } else { Err(bad) }
}

/// A start in a table of centres, each piece of which stands for one of the drawn `pieces`, with a box around the bounded ones; or what
/// is wrong with it.
pub(crate) fn planar(
    scene: &Scene,
    (table, pieces): (&Table, &[u64]),
    bounded: Option<&Extent>,
    orbit: &Orbit,
    length: f64,
) -> Result<Start<2, 1>, Box<Diagnostic>> {
    let mut start: Start<2, 1> = scaled(orbit, length);
    let given = Vector2::from(start.position);
    (start.position, start.cell) = folded(table, &start.position);
    if let Some(away) = start.cell.into_iter().find(|cell| cell.abs() > Lattice::FARTHEST_CELL) {
        let what =
            format!("the start lies {:.0e} cells of the lattice away, too far for cells to be counted", away.abs());
        let diagnostic = scene.source.diagnostic(orbit.position.span, what);
        return Err(Box::new(
            diagnostic.with_help("start at the copy of that point next to the origin: all copies are equivalent"),
        ));
    }
    let home = Vector2::from(start.position);
    if let Some(remote) = bounded.and_then(|walls| Remote::of(&home, &Vector2::from(start.velocity), walls)) {
        return Err(Box::new(too_far(scene, orbit, &remote, length)));
    }
    let (nearest, landing) = table.closest(&home);
    let signed = table.signed_distance(&home);
    let distance = signed.abs();
    // a point given on a wall is on it within the rounding of its coordinates and of the numbers that define the wall; in the unit cell of
    // a lattice, from which it was brought home, coordinates may be larger
    let unit_cell = table.lattice().map_or(0.0, |lattice| lattice.vectors().iter().map(Vector2::amax).sum());
    let as_given = given.amax().min(unit_cell);
    let sizes = [as_given, home.amax(), landing.point.amax(), table.size_of(nearest, &landing.point)];
    let slack = 16.0 * f64::EPSILON * sizes.into_iter().fold(0.0, f64::max);
    let at = orbit.position.span;
    if distance > slack {
        if signed > 0.0 {
            return Ok(start);
        }
        return Err(Box::new(outside(scene, at, distance / length, pieces[nearest])));
    }
    let touch = if scene.particle.radius.value > 0.0 { "the disk touches" } else { "the start lies on" };
    let refused = |what: String, help: &str| Err(Box::new(scene.source.diagnostic(at, what).with_help(help)));
    let path = Line { point: home, velocity: Vector2::from(start.velocity) };
    let rays = rays(table, &path, 2.0 * slack);
    if let Some(piece) = sectors::in_the_way(&rays) {
        let what = format!("{touch} piece {} and does not move into the table", pieces[piece]);
        return refused(what, "turn the velocity, or start farther from the wall");
    }
    if !sectors::may_be_hit_at_once(&rays) {
        return Ok(start);
    }
    let Some(departure) = time_to_leave(table, path, slack) else {
        let what = format!("{touch} piece {}, and rounding hides whether it gets away from there", pieces[nearest]);
        return refused(what, "move the start a little along its velocity, or turn the velocity");
    };
    Ok(departing(table, start, departure))
}

/// The same start, from which the engine takes over at this time; on a lattice in the cell where the path is then.
fn departing(table: &Table, start: Start<2, 1>, departure: f64) -> Start<2, 1> {
    let (position, velocity) = (Vector2::from(start.position), Vector2::from(start.velocity));
    let (_, by) = folded(table, &(position + velocity * departure).into());
    let shift = table.lattice().map_or(Vector2::zeros(), |lattice| lattice.translation(by));
    Start { position: (position - shift).into(), cell: [0, 1].map(|i| start.cell[i] + by[i]), departure, ..start }
}

/// The error that rounding decides what a start so far away hits.
pub(crate) fn too_far(scene: &Scene, orbit: &Orbit, remote: &Remote, length: f64) -> Diagnostic {
    let [spacing, size] = [remote.spacing, remote.size].map(|x| short(x / length));
    let what = format!(
        "the start is so far away that rounding decides what it hits: its coordinates are rounded to multiples of {spacing}, and all \
         bounded walls together are {size} in size"
    );
    scene.source.diagnostic(orbit.position.span, what).with_help(
        "move the start along its velocity, to a place no farther away than some thousand times the size of the walls",
    )
}

/// The error that a start lies this far beyond a drawn piece.
pub(crate) fn outside(scene: &Scene, at: Span, distance: f64, piece: u64) -> Diagnostic {
    let distance = short(distance);
    let radius = scene.particle.radius.value;
    let particle = if scene.dimension == 2 { "disk" } else { "ball" };
    let what = if radius > 0.0 {
        format!(
            "a {particle} of radius {} does not fit there: its centre would be {distance} beyond the limit set by piece {piece}",
            spell(radius)
        )
    } else {
        format!("the start lies outside the table, {distance} beyond piece {piece}")
    };
    scene
        .source
        .diagnostic(at, what)
        .with_help("move the start into the table, at least the particle's radius from all walls")
}

/// The walls at the start of a path; points that are no farther apart than `rounding` \[L\] are the same.
fn rays(table: &Table, path: &Line<2>, rounding: f64) -> Vec<Ray> {
    let is_there = |other: &Vector2<f64>| libm::hypot(other.x - path.point.x, other.y - path.point.y) <= rounding;
    let here = table.nearby().filter(|(_, piece)| is_there(&piece.closest(&path.point).point));
    here.flat_map(|piece| sectors::rays(piece, &path.point, &path.velocity, is_there)).collect()
}
