//! Walls without thickness, moved to both sides, and the arcs around their tips.
use super::{
    Origin,
    moved::Moved,
    vertices::{Site, Vertices},
};
use crate::{Error, plane, shapes};
use nalgebra::Vector2;
use std::{collections::HashMap, sync::Arc};

/// The tips of such walls, each once however many walls end there.
#[derive(Debug, Default)]
pub(super) struct Tips {
    all: Vec<Tip>,
    /// The index of the tip at a point.
    at: HashMap<[u64; 2], usize>,
}

/// A tip, and where the moved faces begin and end on the circle around it.
#[derive(Debug)]
struct Tip {
    point: Vector2<f64>,
    /// The first wall that ends here.
    piece: usize,
    ends: Vec<(Vector2<f64>, Site)>,
}

/// Two faces whose ends on the circle around a tip are no farther apart than this fraction of its radius continue one
/// another.
const STRAIGHT: f64 = 2e-7;

impl Tips {
    /// Moves the two faces of the wall between two tips.
    pub(super) fn faces(
        &mut self,
        tips: [Vector2<f64>; 2],
        piece: usize,
        radius: f64,
        vertices: &mut Vertices,
        pieces: &mut Vec<Moved>,
    ) -> Result<(), Error> {
        let [a, b] = tips;
        let ([x, y], _) = plane::direction(a.into(), b.into()).ok_or(Error::ZeroLength)?;
        let normal = Vector2::new(-y, x);
        let left = normal * radius;
        for ([from, to], off) in [([a, b], left), ([b, a], -left)] {
            let mut end = |tip: Vector2<f64>| self.end(tip, tip + off, piece, radius, vertices);
            let [(p, start), (q, stop)] = [end(from), end(to)];
            pieces.push(Moved {
                piece: Arc::new(shapes::Segment::of_line(p, q, normal.into())?),
                origin: Origin::Piece(piece),
                ends: [Some(start), Some(stop)],
                part: None,
            });
        }
        Ok(())
    }

    /// The end of a moved face: an existing one, or a new one.
    fn end(
        &mut self,
        tip: Vector2<f64>,
        point: Vector2<f64>,
        piece: usize,
        radius: f64,
        vertices: &mut Vertices,
    ) -> (Vector2<f64>, Site) {
        let all = &mut self.all;
        let at = *self.at.entry(plane::key(tip)).or_insert_with(|| {
            all.push(Tip { point: tip, piece, ends: vec![] });
            all.len() - 1
        });
        let ends = &mut all[at].ends;
        let same = ends.iter().find(|(other, _)| (other - point).amax() <= STRAIGHT * radius);
        same.copied().unwrap_or_else(|| {
            let new = (point, vertices.add(point));
            ends.push(new);
            new
        })
    }

    /// The circles around the tips, cut into arcs from end to end.
    pub(super) fn arcs(self, radius: f64, pieces: &mut Vec<Moved>) -> Result<(), Error> {
        for Tip { point: tip, piece, mut ends } in self.all {
            // clockwise, with the table outside
            let angle = |(end, _): &(Vector2<f64>, Site)| libm::atan2(end.y - tip.y, end.x - tip.x);
            ends.sort_by(|a, b| angle(b).total_cmp(&angle(a)));
            for (k, &(from, start)) in ends.iter().enumerate() {
                let (to, stop) = ends[(k + 1) % ends.len()];
                pieces.push(Moved {
                    piece: Arc::new(shapes::Arc::with_radius(tip, radius, from, to, false)?),
                    origin: Origin::Corner { before: piece, after: piece },
                    ends: [Some(start), Some(stop)],
                    part: None,
                });
            }
        }
        Ok(())
    }
}
