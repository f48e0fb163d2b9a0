//! Motion along a wall, and past its end, within rounding.
use crate::energy::taxicab;
use geometry::{WallHit, Walls};
use lanes::{Lane, Mask, dot};

/// A chord of a round wall at up to this angle (normal speed as a fraction of the speed) rises above the wall by no more than the rounding
/// of positions, if the radius is as large as these.
const FLAT: f64 = 1.0 / 33_554_432.0; // 2⁻²⁵

/// A particle may follow a focusing wall at up to this angle: chords at larger ones rise by more than rounding, unless the origin is a
/// billion radii of curvature away.
const ALONG: f64 = 1.0 / 1024.0;

/// A particle may be on a wall if it is no farther from it than this fraction of its coordinates.
const NEAR: f64 = 4.0 * f64::EPSILON;

/// A chord below rounding may follow one that rises this many times as high: a law that leaves 2⁻¹⁰ of the normal speed reduces the rise
/// by the square of that. Flights from other walls rise by more, except next to vertices.
const REDUCED: f64 = 1_048_576.0; // 2²⁰

/// A velocity is turned by these to find the wall that it is along: the least turn is far more than [`FLAT`], and where it is less than
/// rounding, since the wall is far from the origin, another one is not. Short pieces of wall are left by larger turns.
const TURNS: [f64; 3] = [1.0 / 1_048_576.0, 1.0 / 32_768.0, ALONG]; // 2⁻²⁰, 2⁻¹⁵, 2⁻¹⁰

/// Whether a particle that a law has slowed down creeps along a focusing wall: it came along that wall, and its next chord rises above it by
/// no more than rounding, judged by the normal speeds of arrival and departure and the [`taxicab`] norms of the velocities, its `sizes`. From
/// then on rounding determines the lengths of chords, and whether they are found.
#[inline(always)]
pub(crate) fn creeps<F: Lane, const N: usize>(
    hit: &WallHit<F, N>,
    [arrival, leaving]: [F; 2],
    sizes: [F; 2],
) -> F::Mask {
    // how far it rose is a fourth of this
    let rise = hit.time * arrival.abs();
    let near = taxicab(&hit.point) * NEAR;
    let along = leaving.lt(sizes[1] * ALONG) & rise.lt(near * REDUCED);
    if !along.any() {
        return along;
    }
    let [came, leaves] = [arrival.abs() / sizes[0], leaving / sizes[1]];
    // chords rise as the squares of their angles, and the point from which the next one starts may lie as far behind the wall
    let rises = (near * 2.0 * (came * came)).lt(rise * (leaves * leaves));
    along & came.lt(came.same(ALONG)) & !rises
}

/// The same on a round wall, in whose own frame chords are found at any angle: both rise by no more than rounding.
#[inline(always)]
pub(crate) fn creeps_around<F: Lane, const N: usize>(
    hit: &WallHit<F, N>,
    [arrival, leaving]: [F; 2],
    size: F,
) -> F::Mask {
    let rise = hit.time * arrival.abs();
    leaving.lt(size * FLAT) & rise.lt(taxicab(&hit.point) * NEAR)
}

/// Whether a path that meets no wall starts on a focusing one and runs along it, within rounding: paths that are turned a little out of
/// the table cross that wall at once, and those that are turned a little inwards come back to it.
#[cold]
#[inline(never)]
pub(crate) fn follows<W: Walls<N>, const N: usize>(walls: &W, position: &[f64; N], velocity: &[f64; N]) -> bool {
    TURNS.into_iter().any(|turn| {
        let mut beside = axes().filter_map(|axis| wall_there(walls, position, &turned(velocity, &axis, turn)));
        beside.any(|(normal, piece)| {
            let inwards = turned(velocity, &normal, turn);
            let again = walls.first_hit(position, &inwards);
            again.time < f64::INFINITY
                && again.piece == piece
                && is_along(&again, [velocity, &inwards].map(|v| dot(v, &normal).abs()), velocity)
        })
    })
}

/// Whether a path of this velocity is along the wall to which another one comes back, given the normal speeds of both: its chord rises by no
/// more than rounding. One that starts up to [`NEAR`] behind a wall misses it if a fourth of `rise` is less than that.
fn is_along<const N: usize>(again: &WallHit<f64, N>, [leaving, turned]: [f64; 2], velocity: &[f64; N]) -> bool {
    let rise = again.time * leaving * (leaving / turned);
    leaving <= taxicab(velocity) * FLAT || rise <= taxicab(&again.point) * (4.0 * NEAR)
}

/// Whether a path that meets no wall starts on one, within rounding, and would meet another had it started a little farther inside: it ends
/// where these two meet.
#[cold]
#[inline(never)]
pub(crate) fn meets_a_vertex<W: Walls<N>, const N: usize>(walls: &W, position: &[f64; N], velocity: &[f64; N]) -> bool {
    let step = taxicab(position) * NEAR;
    axes().filter_map(|axis| wall_there(walls, position, &axis)).any(|(normal, _)| {
        let inside = core::array::from_fn(|i| position[i] + step * normal[i]);
        walls.first_hit(&inside, velocity).time < f64::INFINITY
    })
}

/// The unit vectors along the axes, both ways.
fn axes<const N: usize>() -> impl Iterator<Item = [f64; N]> {
    (0..2 * N).map(|k| {
        let mut axis = [0.0; N];
        axis[k / 2] = if k % 2 == 0 { 1.0 } else { -1.0 };
        axis
    })
}

/// Normal and number of the wall that a path in this direction meets where it starts, within rounding.
fn wall_there<W: Walls<N>, const N: usize>(
    walls: &W,
    position: &[f64; N],
    direction: &[f64; N],
) -> Option<([f64; N], f64)> {
    let hit: WallHit<f64, N> = walls.first_hit(position, direction);
    let normal = hit.unit_normal();
    (hit.time * dot(direction, &normal).abs() <= taxicab(position) * NEAR).then_some((normal, hit.piece))
}

/// A velocity turned by about this angle towards a unit vector.
fn turned<const N: usize>(velocity: &[f64; N], by: &[f64; N], angle: f64) -> [f64; N] {
    let turn = taxicab(velocity) * angle;
    core::array::from_fn(|i| velocity[i] + turn * by[i])
}
