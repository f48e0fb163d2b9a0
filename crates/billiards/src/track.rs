//! What grows along a path: time, spin position, the cell of a lattice. Where nothing is tracked, the track is `()`.
use crate::in_lanes::InLanes;
use geometry::{Lattice, Vector2, WallHit};
use lanes::{Double, Lane, MOST_LANES, Mask};
use std::sync::Arc;

/// Something that each flight from one collision to the next adds to.
///
/// ```
/// use billiards::{Collisions, Orbit, Planar, Track, geometry::{WallHit, tables}, lanes::{Lane, dot}, laws::Specular};
///
/// /// The length of the path [L].
/// #[derive(Clone)]
/// struct Path<F>(F);
/// impl<F: Lane, const N: usize, const S: usize> Track<F, N, S> for Path<F> {
///     fn fly(&mut self, _: &[F; N], velocity: &[F; N], _: &[F; S], hit: &WallHit<F, N>) {
///         self.0 = self.0 + dot(velocity, velocity).sqrt() * hit.time;
///     }
/// }
/// let strip = Planar { table: tables::strip(1.0)?, law: Specular };
/// let mut orbit = Orbit::<_, 2, 1, (), _>::new([0.0, 0.5], [3.0, 4.0], [0.0], Path(0.0));
/// strip.run(&mut orbit, &Collisions(5), &mut ());
/// assert_eq!(orbit.track.0, 5.0 * (0.125 + 4.0 * 0.25)); // half a width at speed 5, and four whole ones
/// # Ok::<(), billiards::Error>(())
/// ```
pub trait Track<F: Lane, const N: usize, const S: usize> {
    /// A flight from `from` \[L\] to the hit, with this velocity and scaled spin [L T⁻¹], that took the time of the hit \[T\]. On a lattice
    /// the point of the hit is that in the table's cell, a lattice vector away from `from + time · velocity`.
    fn fly(&mut self, from: &[F; N], velocity: &[F; N], spin: &[F; S], hit: &WallHit<F, N>);
    /// In these lanes a run begins: what was tracked so far may be put in order, so that its value stays.
    #[inline(always)]
    fn begin(&mut self, _lanes: F::Mask) {}
    /// Whether it looks at position, velocity and spin: if it says no, these may be those of an earlier flight.
    #[inline(always)]
    fn looks(&self) -> bool {
        true
    }
}

/// What is tracked along the path of an orbit, with a type for every lane width.
///
/// ```
/// use billiards::{Billiard, Collisions, InLanes, Orbit, Track, Tracking, run, run_side_by_side};
/// use billiards::{geometry::{Vector2, WallHit, walls::Sphere}, lanes::Lane, laws::Specular};
///
/// /// The greatest `|x₁|` [L] of all collisions.
/// #[derive(Clone, Debug, PartialEq)]
/// struct Farthest<F = f64>(F);
/// impl<F: Lane, const N: usize, const S: usize> Track<F, N, S> for Farthest<F> {
///     fn fly(&mut self, _: &[F; N], _: &[F; N], _: &[F; S], hit: &WallHit<F, N>) {
///         self.0 = self.0.max(hit.point[0].abs());
///     }
/// }
/// impl<F: Lane> InLanes<F> for Farthest<F> {
///     type One = Farthest;
///     fn one(&self, lane: usize) -> Farthest {
///         Farthest(self.0.lane(lane))
///     }
///     fn all(one: &Farthest, zero: F) -> Self {
///         Farthest(zero.same(one.0))
///     }
///     fn put(&mut self, lane: usize, one: &Farthest) {
///         self.0.put(lane, one.0);
///     }
/// }
/// impl<const N: usize, const S: usize> Tracking<N, S> for Farthest {
///     type In<F: Lane> = Farthest<F>;
/// }
/// let circle = Sphere::new(Vector2::zeros(), 1.0, 0)?;
/// let billiard = Billiard { walls: &circle, law: &Specular };
/// let start = |i: u64| Orbit::<_, 2, 0, (), _>::new([0.0, 0.009 * i as f64], [0.6, 0.8], [], Farthest(0.0));
/// run_side_by_side(&billiard, &mut (0..100).map(start), &Collisions(10), &mut (), &mut |finished| {
///     let mut alone = start(finished.index);
///     run(&billiard, &mut alone, &Collisions(10), &mut ());
///     assert_eq!(finished.orbit.track, alone.track);
/// });
/// # Ok::<(), billiards::Error>(())
/// ```
pub trait Tracking<const N: usize, const S: usize>: Clone {
    /// The track in lanes of `F`.
    type In<F: Lane>: Track<F, N, S> + InLanes<F, One = Self>;
}

/// A track that knows the time: a [`Clock`], or a pair that begins with one.
pub trait Timed {
    /// The time since the start \[T\].
    fn time(&self) -> f64;
    /// The time after a flight of this time, infinite or not: to the last bit as [`time`](Self::time) will have it then.
    fn time_after(&self, flight: f64) -> f64;
}

/// The same for many orbits side by side.
pub trait Timing<const N: usize, const S: usize>: Tracking<N, S> + Timed {
    /// The time since the start \[T\] in each lane: to the last bit as [`Timed::time`] has it.
    fn time_in<F: Lane>(track: &Self::In<F>) -> F;
}

/// A track that knows the scaled spin position.
pub trait Turned {
    /// The scaled spin position `x₀ = γ R θ` \[L\], not reduced modulo a turn.
    fn angle(&self) -> f64;
}

/// A track that may know the cell of the lattice.
pub trait InCell {
    /// The accumulated translation in multiples of the lattice vectors; `None` where it is not counted, as in most tracks.
    #[inline(always)]
    fn cell(&self) -> Option<[f64; 2]> {
        None
    }
}

impl<F: Lane, const N: usize, const S: usize> Track<F, N, S> for () {
    #[inline(always)]
    fn fly(&mut self, _: &[F; N], _: &[F; N], _: &[F; S], _: &WallHit<F, N>) {}
    #[inline(always)]
    fn looks(&self) -> bool {
        false
    }
}

impl InCell for () {}

impl<const N: usize, const S: usize> Tracking<N, S> for () {
    type In<F: Lane> = ();
}

impl<F: Lane, const N: usize, const S: usize, A: Track<F, N, S>, B: Track<F, N, S>> Track<F, N, S> for (A, B) {
    #[inline(always)]
    fn fly(&mut self, from: &[F; N], velocity: &[F; N], spin: &[F; S], hit: &WallHit<F, N>) {
        self.0.fly(from, velocity, spin, hit);
        self.1.fly(from, velocity, spin, hit);
    }
    #[inline(always)]
    fn begin(&mut self, lanes: F::Mask) {
        self.0.begin(lanes);
        self.1.begin(lanes);
    }
    #[inline(always)]
    fn looks(&self) -> bool {
        self.0.looks() || self.1.looks()
    }
}

impl<A: InCell, B: InCell> InCell for (A, B) {
    #[inline(always)]
    fn cell(&self) -> Option<[f64; 2]> {
        self.0.cell().or_else(|| self.1.cell())
    }
}

impl<const N: usize, const S: usize, A: Tracking<N, S>, B: Tracking<N, S>> Tracking<N, S> for (A, B) {
    type In<F: Lane> = (A::In<F>, B::In<F>);
}

/// The time since the start \[T\], as a compensated sum. After `n` flights in runs of `m` each its error is at most `½ + 2⁻⁵⁵ n m` units in
/// the last place: `2⁻⁵³ m²/4` from each run. Flights that are all alike, whose roundings add up, reach a thirtieth of that.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clock<F = f64>(pub Double<F>);

impl<F: Lane> Clock<F> {
    /// A clock at 0, in as many lanes as `zero`.
    pub fn new(zero: F) -> Self {
        Clock(Double::new(zero))
    }
}

impl<F: Lane, const N: usize, const S: usize> Track<F, N, S> for Clock<F> {
    #[inline(always)]
    fn fly(&mut self, _: &[F; N], _: &[F; N], _: &[F; S], hit: &WallHit<F, N>) {
        self.0.gather(hit.time);
    }
    #[inline(always)]
    fn begin(&mut self, lanes: F::Mask) {
        // the same sum in parts that do not overlap: what rounding takes from the small one depends on its size
        let mut sum = self.0;
        sum.add(sum.low.same(0.0));
        self.0 = Double { high: lanes.select(sum.high, self.0.high), low: lanes.select(sum.low, self.0.low) };
    }
    #[inline(always)]
    fn looks(&self) -> bool {
        false
    }
}

impl Timed for Clock {
    #[inline(always)]
    fn time(&self) -> f64 {
        self.0.value()
    }
    #[inline(always)]
    fn time_after(&self, flight: f64) -> f64 {
        if !(flight < f64::INFINITY) {
            return flight;
        }
        let mut sum = self.0;
        sum.gather(flight);
        sum.value()
    }
}

impl<const N: usize, const S: usize> Timing<N, S> for Clock {
    #[inline(always)]
    fn time_in<F: Lane>(track: &Clock<F>) -> F {
        track.0.value()
    }
}

impl<B> Timed for (Clock, B) {
    #[inline(always)]
    fn time(&self) -> f64 {
        self.0.time()
    }
    #[inline(always)]
    fn time_after(&self, flight: f64) -> f64 {
        self.0.time_after(flight)
    }
}

impl<const N: usize, const S: usize, B: Tracking<N, S>> Timing<N, S> for (Clock, B) {
    #[inline(always)]
    fn time_in<F: Lane>(track: &(Clock<F>, B::In<F>)) -> F {
        track.0.0.value()
    }
}

impl InCell for Clock {}

impl<F: Lane> InLanes<F> for Clock<F> {
    type One = Clock;
    fn one(&self, lane: usize) -> Clock {
        Clock(self.0.one(lane))
    }
    fn all(one: &Clock, zero: F) -> Self {
        Clock(Double::all(&one.0, zero))
    }
    fn put(&mut self, lane: usize, one: &Clock) {
        self.0.put(lane, &one.0);
    }
}

impl<const N: usize, const S: usize> Tracking<N, S> for Clock {
    type In<F: Lane> = Clock<F>;
}

/// The scaled spin position `x₀ = γ R θ` of a disk \[L\], not reduced modulo a turn, as a compensated sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Angle<F = f64>(pub Double<F>);

impl<F: Lane> Angle<F> {
    /// The spin position at the start.
    pub fn new(start: F) -> Self {
        Angle(Double::new(start))
    }
}

impl<F: Lane, const N: usize> Track<F, N, 1> for Angle<F> {
    #[inline(always)]
    fn fly(&mut self, _: &[F; N], _: &[F; N], spin: &[F; 1], hit: &WallHit<F, N>) {
        self.0.add(spin[0] * hit.time);
    }
}

impl Turned for Angle {
    #[inline(always)]
    fn angle(&self) -> f64 {
        self.0.value()
    }
}

impl<B> Turned for (Angle, B) {
    #[inline(always)]
    fn angle(&self) -> f64 {
        self.0.angle()
    }
}

impl<B: Turned> Turned for (Clock, B) {
    #[inline(always)]
    fn angle(&self) -> f64 {
        self.1.angle()
    }
}

impl InCell for Angle {}

impl<F: Lane> InLanes<F> for Angle<F> {
    type One = Angle;
    fn one(&self, lane: usize) -> Angle {
        Angle(self.0.one(lane))
    }
    fn all(one: &Angle, zero: F) -> Self {
        Angle(Double::all(&one.0, zero))
    }
    fn put(&mut self, lane: usize, one: &Angle) {
        self.0.put(lane, &one.0);
    }
}

impl<const N: usize> Tracking<N, 1> for Angle {
    type In<F: Lane> = Angle<F>;
}

/// The translation accumulated on a lattice, in multiples of its vectors.
///
/// ```
/// use billiards::{Cell, Clock, Collisions, Orbit, Planar, Timed, geometry::{Vector2, tables}, laws::Specular};
/// use std::sync::Arc;
///
/// let torus = Planar { table: tables::sinai_torus(0.25, 1.0)?, law: Specular };
/// let lattice = Arc::new(torus.table.lattice().expect("a torus has one").clone());
/// let track = (Clock::new(0.0), Cell::new(lattice.clone(), 0.0));
/// let mut orbit = Orbit::<_, 2, 1, (), _>::new([0.125, 0.125], [1.0, 0.125], [0.0], track);
/// torus.run(&mut orbit, &Collisions(1), &mut ());
/// let (time, cell) = (orbit.track.time(), orbit.track.1.cell);
/// assert_eq!(cell, [1.0, 0.0]); // past the disk of the first cell to that of the next
/// let in_the_plane = Vector2::from(orbit.position) + lattice.translation(cell);
/// assert!((in_the_plane - Vector2::new(0.125 + time, 0.125 + 0.125 * time)).amax() < 1e-15);
/// # Ok::<(), billiards::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Cell<F = f64> {
    lattice: Arc<Lattice>,
    /// Position in the plane = position in the table's cell + `cell` · lattice vectors.
    pub cell: [F; 2],
}

impl<F: Lane> Cell<F> {
    /// Not yet moved, in as many lanes as `zero`.
    pub fn new(lattice: Arc<Lattice>, zero: F) -> Self {
        Cell { lattice, cell: [zero; 2] }
    }
}

impl<F: Lane, const S: usize> Track<F, 2, S> for Cell<F> {
    #[inline(always)]
    fn fly(&mut self, from: &[F; 2], velocity: &[F; 2], _: &[F; S], hit: &WallHit<F, 2>) {
        let mut steps = [[0.0; MOST_LANES]; 2];
        for lane in 0..F::LANES {
            let lifted = |i: usize| from[i].lane(lane) + velocity[i].lane(lane) * hit.time.lane(lane);
            let moved = Vector2::new(lifted(0) - hit.point[0].lane(lane), lifted(1) - hit.point[1].lane(lane));
            let step = self.lattice.rounded(&moved);
            [steps[0][lane], steps[1][lane]] = step;
        }
        for (cell, steps) in self.cell.iter_mut().zip(&steps) {
            *cell = *cell + cell.load(steps);
        }
    }
}

impl InCell for Cell {
    #[inline(always)]
    fn cell(&self) -> Option<[f64; 2]> {
        Some(self.cell)
    }
}

impl<F: Lane> InLanes<F> for Cell<F> {
    type One = Cell;
    fn one(&self, lane: usize) -> Cell {
        Cell { lattice: self.lattice.clone(), cell: self.cell.map(|x| x.lane(lane)) }
    }
    fn all(one: &Cell, zero: F) -> Self {
        Cell { lattice: one.lattice.clone(), cell: one.cell.map(|x| zero.same(x)) }
    }
    fn put(&mut self, lane: usize, one: &Cell) {
        for (to, from) in self.cell.iter_mut().zip(one.cell) {
            to.put(lane, from);
        }
    }
}

impl<const S: usize> Tracking<2, S> for Cell {
    type In<F: Lane> = Cell<F>;
}
