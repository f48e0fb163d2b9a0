//! The question a billiard asks of its table: where does this path hit the boundary first?
use crate::path::Line;
use nalgebra::SVector;

/// The first meeting of a path with a boundary.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit<const N: usize> {
    /// Time from the start of the path \[T\].
    pub time: f64,
    /// The point of the boundary that is hit \[L\].
    pub point: SVector<f64, N>,
    /// Unit normal of the boundary there, pointing into the table.
    pub normal: SVector<f64, N>,
    /// Number of the piece that is hit.
    pub piece: usize,
    /// The path ends in a corner, within rounding: no normal is defined there.
    pub corner: bool,
}

/// A piece of boundary, or a whole table, that a path can meet.
///
/// Only crossings from the table's side count: a path that starts on the boundary and points into the table does not
/// meet the place where it starts, and one that starts beyond it by rounding meets it at once.
///
/// [`ByLane`](crate::walls::ByLane) makes [`Walls`](crate::Walls) of it, which take one path after another.
///
/// ```
/// use geometry::{Boundary, Hit, Line, Vector2, Walls, walls::ByLane};
///
/// /// The quadrant `x, y > 0`: two walls that meet in a corner.
/// struct Quadrant;
/// impl Boundary<2> for Quadrant {
///     fn first_hit(&self, path: &Line<2>) -> Option<Hit<2>> {
///         let (x, v) = (path.point, path.velocity);
///         let time = |i: usize| if v[i] < 0.0 { x[i].max(0.0) / -v[i] } else { f64::INFINITY };
///         let (piece, normal) = if time(0) < time(1) { (0, Vector2::x()) } else { (1, Vector2::y()) };
///         let time = Some(time(piece)).filter(|time| *time < f64::INFINITY)?;
///         let mut point = path.at(time);
///         point[piece] = 0.0; // on the wall, whatever the rounding
///         let corner = point[1 - piece].abs() <= 8.0 * f64::EPSILON * x.amax();
///         Some(Hit { time, point, normal, piece, corner })
///     }
/// }
/// let path = |point: [f64; 2], velocity: [f64; 2]| Line { point: point.into(), velocity: velocity.into() };
/// let hit = |point, velocity| ByLane(Quadrant).hit(&path(point, velocity));
/// assert!(hit([1.0, 3.0], [-1.0, -2.0]).is_some_and(|hit| hit.time == 1.0 && hit.piece == 0 && !hit.corner));
/// assert!(hit([0.1, 0.3], [-0.1, -0.3]).is_some_and(|hit| hit.corner));
/// assert_eq!(hit([0.0, 1.0], [1.0, 0.0]), None); // leaves the wall on which it starts
/// ```
pub trait Boundary<const N: usize, Path = Line<N>> {
    /// The first hit, or `None` where the path never meets the boundary.
    fn first_hit(&self, path: &Path) -> Option<Hit<N>>;
}

impl<B: Boundary<N, P> + ?Sized, const N: usize, P> Boundary<N, P> for &B {
    fn first_hit(&self, path: &P) -> Option<Hit<N>> {
        (**self).first_hit(path)
    }
}
