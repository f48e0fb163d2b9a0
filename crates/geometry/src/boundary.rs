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
/// meet the place where it starts.
pub trait Boundary<const N: usize, Path = Line<N>> {
    /// The first hit, or `None` where the path never meets the boundary.
    fn first_hit(&self, path: &Path) -> Option<Hit<N>>;
}

impl<B: Boundary<N, P> + ?Sized, const N: usize, P> Boundary<N, P> for &B {
    fn first_hit(&self, path: &P) -> Option<Hit<N>> {
        (**self).first_hit(path)
    }
}
