//! Straight sides and nothing else, however many.
use super::{ByLane, CORNER, Few, Junctions, WallHit, Walls, corners::Corners};
use crate::{
    Boundary, BoxTree, Extent, Hit, Line,
    boxes::{First, Inside, WIDTH, order},
    plane::slack,
    shapes::{Segment, Shape, segment},
};
use lanes::{Kernel, Lane, MOST_LANES, Mask};
use nalgebra::Vector2;
use std::sync::Arc;

/// The straight sides of a table of any form, with holes or without: eight are tested at once, and where there are many, only
/// those near the path.
#[derive(Clone, Debug)]
pub struct Polygon {
    sides: ByLane<Sides>,
    /// The sides for all lanes at once, where they are not too many for that.
    few: Option<Few>,
    /// Where vertices stand on sides, if any do.
    junctions: Option<Arc<Junctions>>,
}

/// From this many blocks of eight sides on, a tree of boxes is faster than testing each. Orbits in polygons inscribed in a
/// flower take equally long either way at 192 sides (64: 55 and 68 ns, 128: 71 and 91, 256: 99 and 95, 512: 159 and 96). The
/// first hits alone: `cargo bench -p geometry -- "each or tree"`.
const MANY: usize = 24;

/// Up to this many sides per lane, each side is tested for all lanes at once: 0.8 ns per side in eight lanes, whereas testing
/// eight sides at a time, one lane after another, takes 60 ns at 64 sides.
const PER_LANE: usize = 4;

/// Eight sides, coordinate by coordinate; missing ones are NaN, and never hit.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Eight {
    a: [[f64; WIDTH]; 2],
    b: [[f64; WIDTH]; 2],
}

#[derive(Clone, Debug)]
struct Sides {
    blocks: Vec<Eight>,
    /// Unit normals into the table.
    normals: Vec<[f64; 2]>,
    /// The number of each side's piece.
    numbers: Vec<u32>,
    /// Whether there are corners at the start and at the end of each side.
    corners: Vec<[bool; 2]>,
    /// Which blocks a path can meet; `None` where testing each is as fast.
    tree: Option<BoxTree>,
    /// Size of the coordinates of corners, to which rounding is relative.
    size: f64,
}

impl Polygon {
    /// Sides with the numbers of their pieces, and the corners of the boundary.
    pub fn new(sides: &[(usize, Segment)], corners: &[Vector2<f64>]) -> Polygon {
        let ends = |side: &Segment| side.vertices().map(|p| Vector2::from(*p));
        let extents: Vec<Extent> = sides.iter().map(|(_, side)| Extent::of(ends(side))).collect();
        let order = order(&extents);
        let place = |k: usize| order.as_ref().map_or(k, |order| order[k] as usize);
        let known = Corners::new(corners);
        // neighbours share a vertex
        let mut last = ([Vector2::repeat(f64::NAN); 2], [false; 2]);
        let mut are_corners = |ends: [Vector2<f64>; 2]| {
            let start = if ends[0] == last.0[1] { last.1[1] } else { known.contains(&ends[0]) };
            last = (ends, [start, known.contains(&ends[1])]);
            last.1
        };
        let mut all = Sides {
            blocks: Vec::with_capacity(sides.len().div_ceil(WIDTH)),
            normals: Vec::with_capacity(sides.len()),
            numbers: Vec::with_capacity(sides.len()),
            corners: Vec::with_capacity(sides.len()),
            tree: None,
            size: known.size(),
        };
        for k in 0..sides.len() {
            let (number, side) = sides[place(k)];
            let [a, b] = ends(&side);
            if k % WIDTH == 0 {
                let none = [[f64::NAN; WIDTH]; 2];
                all.blocks.push(Eight { a: none, b: none });
            }
            let block = &mut all.blocks[k / WIDTH];
            for i in 0..2 {
                (block.a[i][k % WIDTH], block.b[i][k % WIDTH]) = (a[i], b[i]);
            }
            all.normals.push(side.inward_normal());
            #[allow(clippy::cast_possible_truncation, reason = "pieces are numbered by 32 bits in all trees")]
            all.numbers.push(number as u32);
            all.corners.push(are_corners([a, b]));
        }
        if all.blocks.len() >= MANY {
            let around = |block: usize| {
                (WIDTH * block..sides.len().min(WIDTH * (block + 1)))
                    .map(|k| extents[place(k)])
                    .fold(Extent::EMPTY, Extent::union)
            };
            all.tree = Some(BoxTree::in_order(&(0..all.blocks.len()).map(around).collect::<Vec<_>>()));
        }
        let few = (sides.len() < PER_LANE * MOST_LANES).then(|| {
            let shapes: Vec<_> = sides.iter().map(|(number, side)| (*number, Shape::Segment(*side))).collect();
            Few::new(&shapes, corners)
        });
        Polygon { sides: ByLane(all), few, junctions: None }
    }

    /// The same sides, with places on them where orbits end.
    pub(crate) fn with_junctions(self, junctions: Option<Junctions>) -> Polygon {
        Polygon { junctions: junctions.map(Arc::new), ..self }
    }

    /// The same sides, each of them tested, with the same answers: for tests, and for measuring where a tree pays.
    #[doc(hidden)]
    #[must_use]
    pub fn without_tree(mut self) -> Polygon {
        self.sides.0.tree = None;
        self
    }
}

/// The search for the first side that a path crosses.
struct Search<'a> {
    sides: &'a Sides,
    path: &'a Line<2>,
}

impl Inside for Search<'_> {
    /// Offers to `first` those of eight sides that the path crosses.
    #[inline(always)]
    fn offer<F: Lane>(&self, zero: F, block: usize, first: &mut First) {
        let (x, v): ([f64; 2], [f64; 2]) = (self.path.point.into(), self.path.velocity.into());
        let Eight { a, b } = &self.sides.blocks[block];
        let mut passed = 0;
        let mut k = 0;
        while k < WIDTH {
            let to_a = [zero.load(&a[0][k..]) - zero.same(x[0]), zero.load(&a[1][k..]) - zero.same(x[1])];
            let to_b = [zero.load(&b[0][k..]) - zero.same(x[0]), zero.load(&b[1][k..]) - zero.same(x[1])];
            passed |= segment::passes(to_a, to_b, [zero.same(v[0]), zero.same(v[1])]).bits() << k;
            k += F::LANES;
        }
        while passed != 0 {
            let k = passed.trailing_zeros() as usize;
            passed &= passed - 1;
            let side = WIDTH * block + k;
            let to_a = [a[0][k] - x[0], a[1][k] - x[1]];
            let slack = slack([a[0][k], a[1][k], b[0][k], b[1][k]]);
            let crossing = segment::meet(true, to_a, v, self.sides.normals[side], -slack).into();
            first.offer(side, crossing, |side| self.sides.numbers[side] as usize);
        }
    }
}

impl Kernel for Search<'_> {
    type Output = First;
    #[inline(always)]
    fn run<F: Lane>(self, zero: F) -> First {
        let Some(tree) = &self.sides.tree else {
            let mut first = First::NONE;
            for block in 0..self.sides.blocks.len() {
                self.offer(zero, block, &mut first);
            }
            return first;
        };
        tree.walk(zero, self.path, &self)
    }
}

impl Boundary<2> for Sides {
    fn first_hit(&self, path: &Line<2>) -> Option<Hit<2>> {
        let (side, time) = lanes::dispatch(Search { sides: self, path }).found()?;
        let (Eight { a, b }, k) = (&self.blocks[side / WIDTH], side % WIDTH);
        let [a, b] = [a, b].map(|end| [end[0][k], end[1][k]]);
        let normal = self.normals[side];
        let point = segment::landing(path.point.into(), path.velocity.into(), time, a, normal);
        // a path may come from far beyond the vertices
        let near = CORNER * self.size.max(path.point.amax());
        let at = |end: [f64; 2]| (point[0] - end[0]).abs() <= near && (point[1] - end[1]).abs() <= near;
        let corner = (at(a) && self.corners[side][0]) || (at(b) && self.corners[side][1]);
        Some(Hit { time, point: point.into(), normal: normal.into(), piece: self.numbers[side] as usize, corner })
    }
}

impl Walls<2> for Polygon {
    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; 2], v: &[F; 2]) -> WallHit<F, 2> {
        let mut first = match &self.few {
            Some(few) if F::LANES > 1 && few.len() < PER_LANE * F::LANES => few.first_hit(x, v),
            _ => self.sides.first_hit(x, v),
        };
        if let Some(junctions) = &self.junctions {
            first.corner = first.corner | junctions.near(*x, first.point);
        }
        first
    }
}
