//! A piece moved by a vector: the translates of a lattice.
use crate::{
    Crossing, Extent, Landing, Line, Piece,
    shapes::{Shape, curve::Graph},
};
use nalgebra::Vector2;
use std::sync::Arc;

/// Another piece, translated.
#[derive(Clone, Debug)]
pub struct Translated {
    piece: Arc<dyn Piece>,
    by: Vector2<f64>,
    /// The moved shape, where the piece has one: both walls in lanes and single paths use it, so they round alike.
    shape: Option<Shape>,
}

impl Translated {
    /// `piece` moved by the vector `by` \[L\].
    pub fn new(piece: Arc<dyn Piece>, by: Vector2<f64>) -> Translated {
        let shape = piece.shape().map(|shape| shape.translated(by));
        Translated { piece, by, shape }
    }
    fn back(&self, path: &Line<2>) -> Line<2> {
        Line { point: path.point - self.by, velocity: path.velocity }
    }
    fn forth(&self, landing: Landing) -> Landing {
        Landing { point: landing.point + self.by, normal: landing.normal }
    }
}

impl Piece for Translated {
    fn crossing(&self, path: &Line<2>) -> Crossing {
        match &self.shape {
            Some(shape) => shape.as_piece().crossing(path),
            None => self.piece.crossing(&self.back(path)),
        }
    }
    fn landing(&self, path: &Line<2>, time: f64) -> Landing {
        match &self.shape {
            Some(shape) => shape.as_piece().landing(path, time),
            None => self.forth(self.piece.landing(&self.back(path), time)),
        }
    }
    fn curvature(&self, point: &Vector2<f64>) -> f64 {
        self.piece.curvature(&(point - self.by))
    }
    fn length(&self) -> f64 {
        self.piece.length()
    }
    fn point_at(&self, s: f64) -> Vector2<f64> {
        self.piece.point_at(s) + self.by
    }
    fn landing_at(&self, s: f64) -> Landing {
        self.forth(self.piece.landing_at(s))
    }
    fn arc_length_at(&self, point: &Vector2<f64>) -> f64 {
        self.piece.arc_length_at(&(point - self.by))
    }
    fn arc_length_of(&self, landing: &Landing) -> f64 {
        self.piece.arc_length_of(&Landing { point: landing.point - self.by, ..*landing })
    }
    fn closest(&self, point: &Vector2<f64>) -> Landing {
        self.forth(self.piece.closest(&(point - self.by)))
    }
    fn ends(&self) -> Option<[Vector2<f64>; 2]> {
        self.piece.ends().map(|e| e.map(|p| p + self.by))
    }
    fn extent(&self) -> Extent {
        let e = self.piece.extent();
        Extent { min: e.min + self.by, max: e.max + self.by }
    }
    fn area(&self) -> f64 {
        self.piece.area()
    }
    fn shift(&self) -> f64 {
        self.piece.shift()
    }
    fn tips(&self) -> Option<[Vector2<f64>; 2]> {
        self.piece.tips().map(|tips| tips.map(|p| p + self.by))
    }
    fn has_two_sides(&self) -> bool {
        self.piece.has_two_sides()
    }
    fn shape(&self) -> Option<Shape> {
        self.shape
    }
    fn graphs(&self) -> Option<Vec<Graph>> {
        let moved = |graph: Graph| graph.translated(self.by.into());
        Some(self.piece.graphs()?.into_iter().map(moved).collect())
    }
}
