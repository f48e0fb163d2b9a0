//! A piece with several owners: a piece taken from one table can be a piece of another.
use super::{Shape, curve::Graph};
use crate::{Crossing, Extent, Landing, Line, Piece};
use nalgebra::Vector2;
use std::sync::Arc;

/// A shared piece is itself a piece, so pieces of one table may be pieces of another.
///
/// ```
/// use geometry::{Piece, Table, Vector2, shapes::Circle, tables};
/// let stadium = tables::stadium(2.0, 1.0)?;
/// let pillar = Circle::new(Vector2::new(0.5, 0.25), 0.25, false)?;
/// let mut pieces: Vec<Box<dyn Piece>> = stadium.pieces().iter().map(|p| Box::new(p.clone()) as _).collect();
/// pieces.push(Box::new(pillar));
/// let table = Table::new(pieces)?;
/// assert!((table.area() - (stadium.area() + pillar.area())).abs() < 1e-14); // that of a hole is negative
/// # Ok::<(), geometry::Error>(())
/// ```
impl<P: Piece + ?Sized> Piece for Arc<P> {
    #[inline]
    fn crossing(&self, path: &Line<2>) -> Crossing {
        (**self).crossing(path)
    }
    #[inline]
    fn landing(&self, path: &Line<2>, time: f64) -> Landing {
        (**self).landing(path, time)
    }
    #[inline]
    fn curvature(&self, point: &Vector2<f64>) -> f64 {
        (**self).curvature(point)
    }
    #[inline]
    fn length(&self) -> f64 {
        (**self).length()
    }
    #[inline]
    fn point_at(&self, s: f64) -> Vector2<f64> {
        (**self).point_at(s)
    }
    #[inline]
    fn landing_at(&self, s: f64) -> Landing {
        (**self).landing_at(s)
    }
    #[inline]
    fn arc_length_at(&self, point: &Vector2<f64>) -> f64 {
        (**self).arc_length_at(point)
    }
    #[inline]
    fn arc_length_of(&self, landing: &Landing) -> f64 {
        (**self).arc_length_of(landing)
    }
    #[inline]
    fn closest(&self, point: &Vector2<f64>) -> Landing {
        (**self).closest(point)
    }
    #[inline]
    fn ends(&self) -> Option<[Vector2<f64>; 2]> {
        (**self).ends()
    }
    #[inline]
    fn extent(&self) -> Extent {
        (**self).extent()
    }
    #[inline]
    fn area(&self) -> f64 {
        (**self).area()
    }
    #[inline]
    fn has_two_sides(&self) -> bool {
        (**self).has_two_sides()
    }
    #[inline]
    fn shape(&self) -> Option<Shape> {
        (**self).shape()
    }
    #[inline]
    fn graphs(&self) -> Option<Vec<Graph>> {
        (**self).graphs()
    }
    #[inline]
    fn shift(&self) -> f64 {
        (**self).shift()
    }
    #[inline]
    fn tips(&self) -> Option<[Vector2<f64>; 2]> {
        (**self).tips()
    }
}
