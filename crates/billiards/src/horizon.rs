//! For how many collisions the digits of an orbit are right.
//!
//! Rounding moves an orbit by an ulp at each collision, and the billiard map amplifies that: like a power of the number of collisions on
//! integrable tables, exponentially on chaotic ones, where no digit is left after some forty collisions. The covariance `P` of the error
//! of (position, velocity, spin) at the collisions is propagated by the derivative `M` of the billiard map, and the n-th collision adds
//! its own rounding `Q`. Rounded constants of a law or of a table cause the same error again and again, so errors are assumed to add up,
//! not to cancel: `P ← (1 + 1/n) M P Mᵀ + (1 + n) Q`, the least bound for the sum of errors with arbitrary correlation, from
//! `(a + b)(a + b)ᵀ ≤ (1 + c) a aᵀ + (1 + 1/c) b bᵀ`. Twins of the orbit (`twins`) detect what a derivative cannot: vertices and
//! obstacles that are passed at a distance below the error.
use crate::{billiard::Motion, bounce::Bounce, start::Start, with_motion::WithMotion};
use geometry::{Table, Vector2, WallHit, tables::SpatialTable};
use lanes::Double;
use spread::Spread;
use twins::{Beside, Twins};

mod spread;
mod twins;

/// Walls that know how their normal turns, and how large their numbers are.
///
/// ```
/// use billiards::{Bend, Billiard, Horizon, Start, laws::Specular};
/// use billiards::geometry::{Vector2, WallHit, walls::Sphere};
///
/// /// A circle of radius 4, seen from inside: the unit normal is `−x/4`.
/// struct Round;
/// impl Bend<2> for Round {
///     fn bend(&self, _: &WallHit<f64, 2>, _: f64, along: &[f64; 2]) -> [f64; 2] {
///         along.map(|t| -t / 4.0)
///     }
/// }
/// let circle = Sphere::new(Vector2::zeros(), 4.0, 0)?;
/// let start = Start { position: [0.1, 0.2], velocity: [0.6, 0.8], spin: [] };
/// let horizon = Horizon::of(&Billiard { walls: &circle, law: &Specular }, &Round, start, 4.0, [1000.0, f64::INFINITY]);
/// assert!(!horizon.lost && horizon.error < 1e-8); // with +t/4, all would be lost after some forty collisions
/// # Ok::<(), billiards::Error>(())
/// ```
pub trait Bend<const N: usize> {
    /// The derivative of the unit normal at a hit, after a `flight` of some length \[L\], along a unit vector in the wall
    /// \[L⁻¹\].
    fn bend(&self, hit: &WallHit<f64, N>, flight: f64, along: &[f64; N]) -> [f64; N];

    /// The largest of the numbers that define the wall at a hit \[L\], such as the radius of a flat arc: their rounding moves the place
    /// of the hit. 0 where none is larger than the coordinates of the wall's points.
    fn size(&self, _hit: &WallHit<f64, N>) -> f64 {
        0.0
    }
}

/// `−κ t`: the table is on the concave side where `κ > 0`.
impl Bend<2> for Table {
    fn bend(&self, hit: &WallHit<f64, 2>, _: f64, along: &[f64; 2]) -> [f64; 2] {
        let curvature = self.curvature(hit.number(), &Vector2::from(hit.point));
        along.map(|t| -curvature * t)
    }
    fn size(&self, hit: &WallHit<f64, 2>) -> f64 {
        self.size_of(hit.number(), &Vector2::from(hit.point))
    }
}

impl Bend<3> for SpatialTable {
    fn bend(&self, _: &WallHit<f64, 3>, _: f64, along: &[f64; 3]) -> [f64; 3] {
        along.map(|t| -self.curvature() * t)
    }
}

/// Any walls, whose curvature is felt by two shots straight at the wall on either side of the hit.
///
/// Where one of them finds another piece, another face of the same solid or nothing, as beside a vertex, the other one is compared with
/// the hit itself; where both do, the wall counts as flat. A face is another one if the normal turns abruptly, that is, not by half as
/// much halfway there. A difference quotient is accurate to 10⁻⁴ or better; that is enough for chaotic orbits, and for others up to about
/// a thousand collisions.
#[derive(Clone, Copy)]
pub struct Felt<'a, const N: usize, const S: usize>(pub &'a dyn Bounce<N, S>);

impl<const N: usize, const S: usize> core::fmt::Debug for Felt<'_, N, S> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Felt").finish_non_exhaustive()
    }
}

/// How far a computed orbit is the one that was asked for, and not one of the many that rounding makes of it.
///
/// ```
/// use billiards::{Billiard, Felt, Horizon, Start, laws::Specular};
/// use billiards::geometry::{Vector2, walls::{Around, Cuboid, Scatterer, Sphere}};
///
/// let start = Start { position: [0.1, 0.2], velocity: [0.6, 0.8], spin: [] };
/// // in a circle, most of the digits are left after a thousand collisions
/// let circle = Sphere::new(Vector2::zeros(), 1.0, 0)?;
/// let billiard = Billiard { walls: &circle, law: &Specular };
/// let horizon = Horizon::of(&billiard, &Felt::<2, 0>(&billiard), start, 1.0, [1000.0, f64::INFINITY]);
/// assert!(!horizon.lost && horizon.error < 1e-8);
/// // between a square and a disk in its middle, none is left after thirty
/// let container = Cuboid::new([0.0; 2], [1.0; 2], [[3, 1], [0, 2]])?;
/// let sinai = Around { container, obstacles: Scatterer::new(Vector2::repeat(0.5), 0.25, 4)? };
/// let billiard = Billiard { walls: &sinai, law: &Specular };
/// let horizon = Horizon::of(&billiard, &Felt::<2, 0>(&billiard), start, 1.0, [1000.0, f64::INFINITY]);
/// assert!(horizon.lost && horizon.collisions < 100);
/// # Ok::<(), billiards::geometry::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Horizon {
    /// Collisions whose place is known: those before the error was as large as the table, or all that were examined.
    pub collisions: u64,
    /// The time of the last of them \[T\].
    pub time: f64,
    /// A bound for the error of the last of them, to first order: of the position in units of the size (for a table without a size: of
    /// the farthest distance of the orbit from a wall that it hit next), or of the velocity in units of the speed, whichever is larger.
    pub error: f64,
    /// Whether the next collision is lost.
    pub lost: bool,
}

/// The relative step of difference quotients of laws.
///
/// Strict laws are linear in the velocities and of the second degree in the normal ([`weights`]), so that symmetric quotients are exact up to
/// rounding, 10⁻¹³ here: neutral orbits stay neutral. For any other law the derivative is accurate to 10⁻⁶.
const STEP: f64 = 1.0 / 1024.0;

/// Tangents of the angles through which normals are turned.
const TURNS: [f64; 2] = [STEP, 2.0 * STEP];

/// The same for the place of a hit, where the rounding of coordinates is the limit. Most laws are the same next to it, and then this
/// derivative is exactly 0; for a field that is smooth over a flight it is accurate to 10⁻⁸. A field that is drawn anew at each place
/// already changes as much as it can over this step, so that after two collisions with it no digit is left.
const PLACE: f64 = 1.0 / 67_108_864.0; // 2⁻²⁶

/// How far from a hit the wall is felt for its curvature, as a fraction of the flight; never less than the second fraction of the
/// distance from the origin, since normals are rounded by ε of that distance: both leave an error of 10⁻⁴ of the curvature at most.
const NEARBY: [f64; 2] = [1.0 / 65_536.0, 1.0 / 1_099_511_627_776.0]; // 2⁻¹⁶, 2⁻⁴⁰

/// The fraction of the normal's turn near a hit that may be uneven; if the curvature changes over some length, this is the step as a
/// fraction of that length.
const UNEVEN: f64 = 0.25;

impl Horizon {
    /// Follows an orbit on a table of the given `size` \[L\], at most up to the limit `[collisions, time]`.
    ///
    /// For a table without a size (a strip, a wedge) give infinity: then the size is the farthest distance of the orbit from a wall that
    /// it hit next, which is the width of a strip however it lies. Where a path displaced by the error would hit something else, and not
    /// be beside the orbit again soon after, the orbit is lost.
    ///
    /// Lengths and speeds should be between 10⁻⁴⁵ and 10⁴⁵: beyond, squares of errors over- or underflow, and the bound is wrong. A scene
    /// scaled by powers of two to a size and a speed near 1 has the same horizon.
    ///
    /// Any law will do, even one that varies from place to place: it is differentiated with respect to velocity, spin, normal and place.
    /// If the curvature of the walls is not known, `walls` is [`Felt`].
    ///
    /// An orbit that [`run`](crate::run()) ends sooner, as [grazing](crate::Stop::Grazing) or [stalled](crate::Stop::Stalled), is followed
    /// beyond its end: where that may be, give as the limit the number of collisions that it makes.
    pub fn of<const N: usize, const S: usize>(
        billiard: &dyn Bounce<N, S>,
        walls: &dyn Bend<N>,
        start: Start<N, S>,
        size: f64,
        limit: [f64; 2],
    ) -> Horizon {
        let mut at = start;
        let mut spread = Spread::new(&at);
        let mut horizon = Horizon { collisions: 0, time: 0.0, error: 0.0, lost: false };
        let mut twins = Twins::new();
        let mut farthest = 0.0_f64;
        let mut clock = Double::new(0.0);
        loop {
            let hit = billiard.first_hit(&at.position, &at.velocity);
            clock.add(hit.time);
            let time = clock.value();
            // NaN ends it at once
            let within = (horizon.collisions as f64) < limit[0] && time <= limit[1];
            if !within || !(hit.time < f64::INFINITY) || hit.corner {
                return horizon;
            }
            let n = (horizon.collisions + 1) as f64;
            farthest = farthest.max(dot(&hit.unit_normal(), &plus(&at.position, -1.0, &hit.point)));
            let is_known = size < f64::INFINITY || farthest == 0.0;
            let size = if is_known { size } else { farthest };
            let derivative = Derivative::new(billiard, walls, &at, &hit);
            let next = derivative.after();
            let across = spread.across(&at.velocity, hit.time);
            derivative.carry(&mut spread, &next, n);
            twins.look(&Beside { walls, derivative: &derivative, next: &next, size }, &across, &mut spread);
            let error = spread.error(&next, size);
            // NaN counts as an error, too
            if !(error < 1.0) {
                return Horizon { lost: true, ..horizon };
            }
            at = next;
            horizon = Horizon { collisions: horizon.collisions + 1, time, error, lost: false };
        }
    }
}

/// [`Horizon::of`], for any motion.
pub(crate) struct HorizonOn<'a, const N: usize, const S: usize> {
    pub(crate) walls: &'a dyn Bend<N>,
    pub(crate) start: Start<N, S>,
    pub(crate) size: f64,
    pub(crate) limit: [f64; 2],
}

impl<const N: usize, const S: usize> WithMotion<N, S> for HorizonOn<'_, N, S> {
    type Output = Horizon;
    fn run<B: Motion<N, S> + Bounce<N, S>>(self, motion: &B) -> Horizon {
        Horizon::of(motion, self.walls, self.start, self.size, self.limit)
    }
}

fn dot<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    (0..N).map(|i| a[i] * b[i]).sum()
}
fn plus<const N: usize>(a: &[f64; N], factor: f64, b: &[f64; N]) -> [f64; N] {
    core::array::from_fn(|i| a[i] + factor * b[i])
}
fn norm<const N: usize>(a: &[f64; N]) -> f64 {
    libm::sqrt(dot(a, a))
}

impl<const N: usize, const S: usize> Start<N, S> {
    const ZERO: Self = Start { position: [0.0; N], velocity: [0.0; N], spin: [0.0; S] };
    /// The number of coordinates.
    const COORDINATES: usize = N + N + S;

    /// The sum with a multiple of another one.
    fn plus(&self, factor: f64, other: &Self) -> Self {
        Start {
            position: plus(&self.position, factor, &other.position),
            velocity: plus(&self.velocity, factor, &other.velocity),
            spin: plus(&self.spin, factor, &other.spin),
        }
    }
    fn speed(&self) -> f64 {
        libm::sqrt(dot(&self.velocity, &self.velocity) + dot(&self.spin, &self.spin))
    }
    fn get(&self, i: usize) -> f64 {
        if i < N {
            self.position[i]
        } else if i < N + N {
            self.velocity[i - N]
        } else {
            self.spin[i - N - N]
        }
    }
    fn set(&mut self, i: usize, value: f64) {
        if i < N {
            self.position[i] = value;
        } else if i < N + N {
            self.velocity[i - N] = value;
        } else {
            self.spin[i - N - N] = value;
        }
    }
}

/// The derivative of flight and collision at a hit.
struct Derivative<'a, const N: usize, const S: usize> {
    billiard: &'a dyn Bounce<N, S>,
    before: Start<N, S>,
    hit: WallHit<f64, N>,
    normal: [f64; N],
    /// The largest of the numbers that define the place of the hit \[L\].
    length: f64,
    /// Times [`PLACE`], how far the place of the hit is moved \[L\].
    nearby: f64,
    /// Unit vectors along the wall, and the derivatives of the normal along them \[L⁻¹\].
    bends: Vec<[[f64; N]; 2]>,
}

impl<'a, const N: usize, const S: usize> Derivative<'a, N, S> {
    fn new(billiard: &'a dyn Bounce<N, S>, walls: &dyn Bend<N>, at: &Start<N, S>, hit: &WallHit<f64, N>) -> Self {
        let flight = hit.time * norm(&at.velocity);
        let length = norm(&at.position).max(norm(&hit.point)).max(flight);
        let normal = hit.unit_normal();
        let bends = along(&normal).into_iter().map(|t| [t, walls.bend(hit, flight, &t)]).collect();
        // times `PLACE`, a length between the flight, over which a law may change, and the rounding of the coordinates
        let nearby = libm::sqrt(length * flight.max(f64::EPSILON * length));
        Derivative { billiard, before: *at, hit: *hit, normal, length: length.max(walls.size(hit)), nearby, bends }
    }

    /// The state after the hit.
    fn after(&self) -> Start<N, S> {
        let mut next = Start { position: self.hit.point, ..self.before };
        self.billiard.collide(&self.hit, &mut next.velocity, &mut next.spin);
        next
    }

    /// The sizes to which the rounding of velocity and spin is relative: for both that of the whole motion, unless the law neither
    /// changes nor reads the spin.
    fn sizes(&self, next: &Start<N, S>) -> [f64; 2] {
        let Start { velocity, spin, .. } = self.before;
        let (other, _) = self.collide(&self.hit.point, &self.normal, velocity, spin.map(|w| -w));
        let (same, _) = self.collide(&self.hit.point, &self.normal, velocity, spin);
        let is_inert = next.spin == spin && other == same;
        if is_inert { [norm(&next.velocity), norm(&spin)] } else { [next.speed(); 2] }
    }

    /// Carries the errors to the state after the hit, the n-th one.
    fn carry(&self, spread: &mut Spread<N, S>, next: &Start<N, S>, n: f64) {
        spread.widen(n);
        spread.round(self.length, [0.0; 2], 1.0 + n);
        spread.carry(|d| self.apply(d));
        spread.round(0.0, self.sizes(next), 1.0 + n);
    }

    /// `M d`: `dq = dx + t dv` is moved along the path back to the wall, where the normal differs, and the law depends on it.
    fn apply(&self, d: &Start<N, S>) -> Start<N, S> {
        let Derivative { before: Start { velocity: v, spin: w, .. }, hit, normal: n, nearby, .. } = self;
        let moved = plus(&d.position, hit.time, &d.velocity);
        let position = plus(&moved, -dot(&moved, n) / dot(v, n), v);
        let mut turned = [0.0; N];
        for [along, bend] in &self.bends {
            turned = plus(&turned, dot(&position, along), bend);
        }
        let speed = self.before.speed();
        // symmetric difference quotients along (dv, dw), dn and dq
        let change = libm::sqrt(dot(&d.velocity, &d.velocity) + dot(&d.spin, &d.spin)) / speed;
        let there = &hit.point;
        let by_motion =
            quotient(STEP / change, |step| self.collide(there, n, plus(v, step, &d.velocity), plus(w, step, &d.spin)));
        let by_normal = TURNS
            .map(|turn| quotient(turn / norm(&turned), |step| self.collide(there, &plus(n, step, &turned), *v, *w)));
        let by_place =
            quotient(PLACE * nearby / norm(&position), |step| self.collide(&plus(there, step, &position), n, *v, *w));
        let (mut velocity, mut spin) = (plus(&by_motion.0, 1.0, &by_place.0), plus(&by_motion.1, 1.0, &by_place.1));
        for ((dv, dw), weight) in by_normal.iter().zip(weights()) {
            (velocity, spin) = (plus(&velocity, weight, dv), plus(&spin, weight, dw));
        }
        Start { position, velocity, spin }
    }

    /// What the hit does to a velocity and a spin if it is at another point, with another normal, of any length.
    fn collide(
        &self,
        point: &[f64; N],
        normal: &[f64; N],
        mut velocity: [f64; N],
        mut spin: [f64; S],
    ) -> ([f64; N], [f64; S]) {
        let hit = WallHit { point: *point, normal: *normal, inverse: 1.0 / norm(normal), ..self.hit };
        self.billiard.collide(&hit, &mut velocity, &mut spin);
        (velocity, spin)
    }
}

/// The derivative at 0 by a symmetric difference over this step; 0 if the step is infinite, because nothing ever changes, or 0, because
/// nothing has a length.
fn quotient<const N: usize, const S: usize>(
    step: f64,
    f: impl Fn(f64) -> ([f64; N], [f64; S]),
) -> ([f64; N], [f64; S]) {
    if !(0.0 < step && step < f64::INFINITY) {
        return ([0.0; N], [0.0; S]);
    }
    let (low, high) = (f(-step), f(step));
    let rate = 0.5 / step;
    (plus(&high.0, -1.0, &low.0).map(|x| x * rate), plus(&high.1, -1.0, &low.1).map(|x| x * rate))
}

/// The weights of quotients by normals turned through [`TURNS`] that make a derivative: exact for terms of the first and of the second degree in
/// the unit normal, of which strict laws along it or in all of the contact plane consist, and of fourth order for others.
///
/// Where `n ± s t` is as long as `r = √(1 + s²)`, the quotient of such terms is `a/r + b/r²` in place of `a + b`.
fn weights() -> [f64; 2] {
    let lengths = TURNS.map(|s| (1.0 + s * s).sqrt());
    // 1 − 1/r
    let [near, far] = [0, 1].map(|i| TURNS[i] * TURNS[i] / (lengths[i] * (1.0 + lengths[i])));
    [far / (far - near) * lengths[0], near / (near - far) * lengths[1]]
}

/// `N − 1` orthogonal unit vectors at right angles to a unit vector.
fn along<const N: usize>(normal: &[f64; N]) -> Vec<[f64; N]> {
    let mut found: Vec<[f64; N]> = vec![*normal];
    // the axes, those that are least parallel to the normal first
    let mut axes: Vec<usize> = (0..N).collect();
    axes.sort_by(|i, j| normal[*i].abs().total_cmp(&normal[*j].abs()));
    for axis in axes.into_iter().take(N - 1) {
        let mut e = [0.0; N];
        e[axis] = 1.0;
        for f in &found {
            e = plus(&e, -dot(&e, f), f);
        }
        let length = norm(&e);
        found.push(e.map(|x| x / length));
    }
    found.split_off(1)
}

impl<const N: usize, const S: usize> Bend<N> for Felt<'_, N, S> {
    fn bend(&self, hit: &WallHit<f64, N>, flight: f64, along: &[f64; N]) -> [f64; N] {
        let normal = hit.unit_normal();
        let inwards = normal.map(|n| -n);
        let nearby = (NEARBY[0] * flight).max(NEARBY[1] * norm(&hit.point));
        let seen = |side: f64| {
            let from = plus(&plus(&hit.point, side * nearby, along), nearby, &normal);
            let other = self.0.first_hit(&from, &inwards);
            let same = other.time < 4.0 * nearby && other.piece == hit.piece && !other.corner;
            same.then(|| other.unit_normal())
        };
        let felt = |side: f64| {
            let (far, halfway) = (seen(side)?, seen(0.5 * side)?);
            let turn = plus(&far, -1.0, &normal);
            // on an evenly curved wall none of it, beside an edge all of it
            let uneven = plus(&turn, -2.0, &plus(&halfway, -1.0, &normal));
            (norm(&uneven) <= UNEVEN * norm(&turn) + 8.0 * f64::EPSILON).then_some(far)
        };
        let rate = |to: &[f64; N], from: &[f64; N], way: f64| plus(to, -1.0, from).map(|x| x / way);
        match (felt(-1.0), felt(1.0)) {
            (Some(low), Some(high)) => rate(&high, &low, 2.0 * nearby),
            (None, Some(high)) => rate(&high, &normal, nearby),
            (Some(low), None) => rate(&normal, &low, nearby),
            (None, None) => [0.0; N],
        }
    }
}
