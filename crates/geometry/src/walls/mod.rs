//! Walls: what the engine's loop asks for the first hit, in SIMD lanes of any width.
//!
//! A [`Table`](crate::Table) describes a boundary; walls compute the first hit. The best walls for a table are found by
//! [`Table::with_walls`](crate::Table::with_walls): composite convex walls that answer in one go (slab, strip, cuboid, zonogon, convex
//! polygon, wedge, capsule, sphere, cylinder), also where their sides consist of several pieces; one scatterer or many; pairs of those;
//! straight sides eight at a time; straight, circular and elliptic pieces as a list in lanes; smooth curves as graphs of polynomials;
//! convex solids in space as a list in lanes; or a list of any pieces.
mod around;
mod by_lane;
mod capsule;
mod center;
mod convex;
mod corners;
mod cuboid;
mod cylinder;
mod enclosure;
mod few;
mod first;
mod graphs;
mod homogeneous;
mod hull;
mod junctions;
mod lines;
mod list;
mod normal;
mod periodic;
mod pieces;
mod polygon;
mod posts;
mod rotated;
mod scatterer;
mod scatterers;
mod slab;
mod solids;
mod sphere;
mod standing;
mod strip;
mod vessel;
mod wedge;
mod zonogon;

pub use around::Around;
pub use by_lane::ByLane;
pub use capsule::Capsule;
pub use convex::ConvexPolygon;
pub(crate) use corners::Corners;
pub use cuboid::Cuboid;
pub use cylinder::Cylinder;
pub use enclosure::{Enclosure, Obstacles, Seam};
pub use few::Few;
pub use graphs::Graphs;
pub use homogeneous::{Chord, Homogeneous, Swing};
pub use hull::Hull;
pub(crate) use junctions::Junctions;
pub use list::List;
pub use periodic::Periodic;
pub use pieces::Pieces;
pub use polygon::Polygon;
pub use rotated::Rotated;
pub use scatterer::Scatterer;
pub use scatterers::Scatterers;
pub use slab::Slab;
pub(crate) use solids::{AtFoot, ConvexBody, Member, OneByOne, Solids};
pub use sphere::Sphere;
pub use strip::Strip;
pub use vessel::Vessel;
pub use wedge::Wedge;
pub use zonogon::Zonogon;

use crate::{Hit, Line};
use lanes::{Lane, Mask};

/// The first hit, in lanes.
#[derive(Clone, Copy, Debug)]
pub struct WallHit<F: Lane, const N: usize> {
    /// Time of flight \[T\]; infinite where there is no hit, and then the other fields are meaningless. For a path that starts beyond a
    /// wall, as only rounding can cause, it may be negative by as much.
    pub time: F,
    /// The point hit, on the wall \[L\].
    pub point: [F; N],
    /// A normal into the table. Its length is whatever the wall can provide cheaply.
    pub normal: [F; N],
    /// `1/|normal|`, to about 2 ulp, with which reflection is correct for a normal of any length.
    pub inverse: F,
    /// Number of the piece.
    pub piece: F,
    /// Whether the hit is a corner, within rounding.
    pub corner: F::Mask,
}

/// The number of a piece, which lanes carry as a floating-point number.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a piece number is a small integer")]
#[inline(always)]
pub fn number(piece: f64) -> usize {
    piece as usize
}

impl<const N: usize> WallHit<f64, N> {
    /// The number of the piece hit.
    #[inline(always)]
    pub fn number(&self) -> usize {
        number(self.piece)
    }
}

impl<F: Lane, const N: usize> WallHit<F, N> {
    /// The hit in one lane. `lane` must be below [`Lane::LANES`].
    #[inline(always)]
    pub fn one(&self, lane: usize) -> WallHit<f64, N> {
        WallHit {
            time: self.time.lane(lane),
            point: self.point.map(|x| x.lane(lane)),
            normal: self.normal.map(|x| x.lane(lane)),
            inverse: self.inverse.lane(lane),
            piece: self.piece.lane(lane),
            corner: self.corner.at(lane),
        }
    }

    /// The unit normal into the table.
    #[inline(always)]
    pub fn unit_normal(&self) -> [F; N] {
        let mut unit = self.normal;
        for n in &mut unit {
            *n = *n * self.inverse;
        }
        unit
    }

    /// No hit, in lanes like those of `x`.
    #[inline(always)]
    pub fn never(x: [F; N]) -> Self {
        let one = x[0].same(1.0);
        WallHit {
            time: x[0].same(f64::INFINITY),
            point: x,
            normal: x,
            inverse: one,
            piece: x[0].same(0.0),
            corner: one.never(),
        }
    }

    /// The lanes without a hit.
    #[inline(always)]
    pub fn missed(&self) -> F::Mask {
        !self.time.lt(self.time.same(f64::INFINITY))
    }

    /// This hit, or `other` in the lanes where `second` is set.
    #[inline(always)]
    #[must_use]
    pub fn or(mut self, second: F::Mask, other: &Self) -> Self {
        self.time = second.select(other.time, self.time);
        for i in 0..N {
            self.point[i] = second.select(other.point[i], self.point[i]);
            self.normal[i] = second.select(other.normal[i], self.normal[i]);
        }
        self.inverse = second.select(other.inverse, self.inverse);
        self.piece = second.select(other.piece, self.piece);
        self.corner = (second & other.corner) | (!second & self.corner);
        self
    }
}

/// What a billiard's particle can hit, as the engine's loop asks it: for one orbit or for many side by side.
///
/// The same code runs in every lane width, so each orbit of an ensemble agrees bit for bit with the same orbit run singly.
///
/// ```
/// use geometry::{Line, SVector, WallHit, Walls};
/// use lanes::{Lane, Mask, dot};
///
/// /// The half-space `n·x > 0`, in any dimension.
/// struct HalfSpace<const N: usize> {
///     normal: [f64; N],
/// }
/// impl<const N: usize> Walls<N> for HalfSpace<N> {
///     #[inline(always)]
///     fn first_hit<F: Lane>(&self, x: &[F; N], v: &[F; N]) -> WallHit<F, N> {
///         let [zero, one] = [0.0, 1.0].map(|a| x[0].same(a));
///         let normal = self.normal.map(|n| one.same(n));
///         let (height, speed) = (dot(x, &normal).max(zero), -dot(v, &normal)); // beyond the wall by rounding: on it
///         let time = zero.lt(speed).select(height / speed, one.same(f64::INFINITY)); // no branches on data
///         let point = core::array::from_fn(|i| x[i] + time * v[i]);
///         let inverse = one / dot(&normal, &normal).sqrt();
///         WallHit { time, point, normal, inverse, piece: zero, corner: one.never() }
///     }
/// }
/// let walls = HalfSpace { normal: [0.0, 3.0, 4.0] };
/// let hit = |velocity| walls.hit(&Line { point: SVector::from([0.5, 1.0, 0.5]), velocity: SVector::from(velocity) });
/// let below = hit([1.0, -3.0, -4.0]).expect("it falls");
/// assert_eq!(below.time, 0.2);
/// assert!((below.normal - SVector::from([0.0, 0.6, 0.8])).amax() < 1e-15); // of length 1
/// assert_eq!(hit([1.0, 4.0, -3.0]), None); // along the wall
/// ```
pub trait Walls<const N: usize>: Sync {
    /// The first hit of the paths `x + t v`, `t ≥ 0` \[T\], `x` \[L\], `v` [L T⁻¹]: [`time`](WallHit::time) is infinite where there is
    /// none. A path that starts on a wall and points into the table does not hit it there.
    fn first_hit<F: Lane>(&self, x: &[F; N], v: &[F; N]) -> WallHit<F, N>;

    /// Whether normals have length 1 up to a rounding error that is worth correcting: on an ellipse, where the product of the momenta
    /// about the foci is conserved as well as the energy, and where a hit takes so long that the correction costs nothing noticeable.
    fn rounds_normals(&self) -> bool {
        false
    }

    /// Whether every normal is a unit vector along an axis, so that a law needs fewer operations.
    fn is_along_axes(&self) -> bool {
        false
    }

    /// Whether every normal is a unit vector along the same axis: components of velocity and spin along the normal that a strict law
    /// preserves or reverses are then never rounded.
    fn are_parallel(&self) -> bool {
        false
    }

    /// The first hit of one path, with a unit normal; `None` where there is none.
    fn hit(&self, path: &Line<N>) -> Option<Hit<N>> {
        let hit = self.first_hit::<f64>(&path.point.into(), &path.velocity.into());
        (hit.time < f64::INFINITY).then(|| Hit {
            time: hit.time,
            point: hit.point.into(),
            normal: hit.unit_normal().into(),
            piece: hit.number(),
            corner: hit.corner,
        })
    }
}

impl<W: Walls<N>, const N: usize> Walls<N> for &W {
    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; N], v: &[F; N]) -> WallHit<F, N> {
        (**self).first_hit(x, v)
    }

    fn rounds_normals(&self) -> bool {
        (**self).rounds_normals()
    }

    fn is_along_axes(&self) -> bool {
        (**self).is_along_axes()
    }

    fn are_parallel(&self) -> bool {
        (**self).are_parallel()
    }
}

/// A computation for walls of any type; see [`Table::with_walls`](crate::Table::with_walls).
///
/// ```
/// use geometry::{Line, Table, Vector2, Walls, WithWalls, tables};
///
/// /// The number of the piece that a path from the origin hits first, if any.
/// struct First(Vector2<f64>);
/// impl WithWalls<2> for First {
///     type Output = Option<usize>;
///     fn run<W: Walls<2>>(self, walls: &W) -> Option<usize> {
///         walls.hit(&Line { point: Vector2::zeros(), velocity: self.0 }).map(|hit| hit.piece)
///     }
/// }
/// let first = |table: &Table, x, y| table.with_walls(First(Vector2::new(x, y)));
/// let stadium = tables::stadium(2.0, 1.0)?;
/// assert_eq!([first(&stadium, 0.1, -1.0), first(&stadium, 1.0, 0.1)], [Some(0), Some(1)]); // lower side, right cap
/// assert_eq!(first(&tables::ellipse([2.0, 1.0])?, 1.0, 0.1), Some(0));
/// # Ok::<(), geometry::Error>(())
/// ```
pub trait WithWalls<const N: usize> {
    /// What it returns.
    type Output;
    /// Runs it.
    fn run<W: Walls<N>>(self, walls: &W) -> Self::Output;
    /// Runs it on walls in the plane that can compute the next hit by a shorter way.
    fn run_homogeneous<W: Homogeneous + Walls<N>>(self, walls: &W) -> Self::Output
    where
        Self: Sized,
    {
        self.run(walls)
    }
}

/// Within how many units of rounding of the table's size a point counts as a corner.
///
/// A landing point is accurate to about 2 ulp of the size along the wall; 8 leaves a factor of four.
pub(crate) const CORNER: f64 = 8.0 * f64::EPSILON;

/// Whether a wall at this distance, which is not negative, is reached with this speed before another one.
///
/// A wall that is not approached is never reached, even from the wall itself, since no number is less than 0 or than ∞·0.
#[inline(always)]
fn sooner<F: Lane>([distance, speed]: [F; 2], [other_distance, other_speed]: [F; 2]) -> F::Mask {
    (distance * other_speed).lt(other_distance * speed)
}
