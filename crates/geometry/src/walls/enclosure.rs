//! A composite wall of any kind, whose sides may be several pieces, around obstacles of any kind.
use super::{Hull, Pieces, Scatterer, WallHit, Walls};
use lanes::{Lane, Mask};
use nalgebra::Vector2;

/// A table within a composite wall that has more than this wall: seams or obstacles.
///
/// Which parts it has costs a few branches that always go the same way, and the same code serves all.
#[derive(Clone, Debug)]
pub struct Enclosure<'a> {
    /// The walls around all. For a side that consists of several pieces they report the first.
    pub hull: &'a Hull,
    /// Where one piece of a side ends and the next begins, in order along each side or around a circle.
    pub seams: &'a [Seam],
    /// What lies inside.
    pub obstacles: Obstacles<'a>,
}

/// What lies within a composite wall.
#[derive(Clone, Debug)]
pub enum Obstacles<'a> {
    /// Nothing.
    None,
    /// A disk.
    Disk(Scatterer<2>),
    /// Any pieces.
    Pieces(&'a Pieces),
}

/// Where on one side of a composite wall a piece ends and another one continues it; the boundary is smooth there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seam {
    /// Points with `normal · p > at` belong to the second piece.
    normal: [f64; 2],
    at: f64,
    pieces: [f64; 2],
}

impl Seam {
    /// The seam at `vertex` between two pieces, given by their numbers, of a line that runs along `direction` (of any length).
    pub fn across(vertex: Vector2<f64>, direction: Vector2<f64>, pieces: [usize; 2]) -> Seam {
        Seam { normal: direction.into(), at: direction.dot(&vertex), pieces: pieces.map(|p| p as f64) }
    }

    /// The seam that separates an arc from `a` to `b`, counter-clockwise, from the rest of its circle, which is another piece: the arc
    /// lies on the right of its chord.
    pub fn around([a, b]: [Vector2<f64>; 2], pieces: [usize; 2]) -> Seam {
        Seam::across(a, Vector2::new(b.y - a.y, a.x - b.x), pieces)
    }
}

impl Walls<2> for Enclosure<'_> {
    fn rounds_normals(&self) -> bool {
        matches!(self.obstacles, Obstacles::Pieces(pieces) if pieces.rounds_normals())
    }

    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; 2], v: &[F; 2]) -> WallHit<F, 2> {
        let inner = match &self.obstacles {
            Obstacles::None => None,
            Obstacles::Disk(disk) => Some(disk.first_hit(x, v)),
            Obstacles::Pieces(pieces) => Some(pieces.first_hit(x, v)),
        };
        if let Some(inner) = &inner
            && !inner.missed().any()
        {
            return *inner;
        }
        let mut outer = self.hull.first_hit(x, v);
        let half = x[0].same(0.5);
        for seam in self.seams {
            let [before, after] = seam.pieces;
            let beyond = half.same(seam.at).lt(outer.point[0] * seam.normal[0] + outer.point[1] * seam.normal[1]);
            let here = (outer.piece - before).abs().lt(half);
            outer.piece = (here & beyond).select(half.same(after), outer.piece);
        }
        match &inner {
            None => outer,
            Some(inner) => inner.or(inner.missed(), &outer),
        }
    }
}
