//! Walls of which one side is several pieces.
use super::{WallHit, Walls};
use lanes::{Lane, Mask};
use nalgebra::Vector2;

/// Where on one side of a composite wall a piece ends and another one goes on: the boundary is smooth there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seam {
    /// What lies beyond `normal · p = at` belongs to the second piece.
    normal: [f64; 2],
    at: f64,
    pieces: [f64; 2],
}

impl Seam {
    /// The seam between two pieces of the line through `vertex` that goes on along `direction`, by their numbers.
    pub(crate) fn across(vertex: Vector2<f64>, direction: Vector2<f64>, pieces: [usize; 2]) -> Seam {
        Seam { normal: direction.into(), at: direction.dot(&vertex), pieces: pieces.map(|p| p as f64) }
    }

    /// The seams around an arc from `a` to `b`, counter-clockwise, of a circle that is another piece elsewhere: what lies on the right of
    /// its chord.
    pub(crate) fn around([a, b]: [Vector2<f64>; 2], pieces: [usize; 2]) -> Seam {
        Seam::across(a, Vector2::new(b.y - a.y, a.x - b.x), pieces)
    }
}

/// Walls that know whole sides, and the seams of those that are several pieces: which one was hit is told of the point.
#[derive(Clone, Copy, Debug)]
pub struct Seamed<'a, W> {
    /// Of each side, these walls name the first piece.
    pub walls: W,
    /// Along a line from one piece to the next, in this order.
    pub seams: &'a [Seam],
}

impl<W: Walls<2>> Walls<2> for Seamed<'_, W> {
    fn rounds_normals(&self) -> bool {
        self.walls.rounds_normals()
    }

    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; 2], v: &[F; 2]) -> WallHit<F, 2> {
        let mut hit = self.walls.first_hit(x, v);
        let half = x[0].same(0.5);
        for seam in self.seams {
            let [before, after] = seam.pieces;
            let beyond = half.same(seam.at).lt(hit.point[0] * seam.normal[0] + hit.point[1] * seam.normal[1]);
            let here = (hit.piece - before).abs().lt(half);
            hit.piece = (here & beyond).select(half.same(after), hit.piece);
        }
        hit
    }
}
