//! The first of very many pieces, through parry's tree of boxes.
use super::slab::{First, Slab, distance_squared, to_unit};
use crate::{Crossing, Extent, Line};
use nalgebra::Vector2;
use parry2d_f64::{
    bounding_volume::Aabb,
    math::Vector as Glam,
    partitioning::{Bvh, BvhBuildStrategy, BvhNode},
};

/// A tree of boxes over numbered pieces: which of them can a path cross first, which can be closest to a point?
///
/// The tree only leaves out pieces that cannot matter; the pieces themselves decide. The answers are those of asking
/// every piece in turn, bit for bit, in logarithmic time.
#[derive(Clone)]
pub struct Index {
    bvh: Bvh,
    /// Numbers of the pieces in the tree, and of those without a finite box, which are asked one by one.
    bounded: Vec<usize>,
    unbounded: Vec<usize>,
    /// Power of two that brings coordinates to about 1, and the largest coordinate then.
    scale: f64,
    size: f64,
}

impl core::fmt::Debug for Index {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "Index of {} pieces", self.bounded.len() + self.unbounded.len())
    }
}

impl Index {
    /// The tree over pieces with these extents, numbered from 0.
    pub fn new(extents: impl IntoIterator<Item = Extent>) -> Index {
        let extents: Vec<Extent> = extents.into_iter().collect();
        let (bounded, unbounded): (Vec<usize>, Vec<usize>) = (0..extents.len()).partition(|&i| extents[i].is_finite());
        let largest = |e: &Extent| e.min.amax().max(e.max.amax());
        let size = bounded.iter().map(|&i| largest(&extents[i])).fold(0.0, f64::max);
        let scale = to_unit(size);
        let glam = |v: Vector2<f64>| Glam::new(v.x * scale, v.y * scale);
        let boxes: Vec<Aabb> = bounded.iter().map(|&i| Aabb::new(glam(extents[i].min), glam(extents[i].max))).collect();
        Index { bvh: Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes), bounded, unbounded, scale, size: size * scale }
    }

    /// The first piece that the path crosses, given the crossing of each; of equal times the lowest number.
    pub fn first(&self, path: &Line<2>, crossing: impl Fn(usize) -> Crossing) -> Option<(usize, Crossing)> {
        let first = First::new();
        for &i in &self.unbounded {
            first.offer(i, crossing(i));
        }
        let slab = Slab::new(&Line { point: path.point * self.scale, velocity: path.velocity * self.scale }, self.size);
        self.bvh.find_best(
            first.limit(),
            |node: &BvhNode, _| {
                let (min, max) = (node.mins(), node.maxs());
                slab.enters(&[min.x, min.y], &[max.x, max.y])
            },
            |leaf, _| {
                let i = self.bounded[leaf as usize];
                first.offer(i, crossing(i))
            },
        );
        first.found()
    }

    /// The pieces closest to a point, given the closest point of each: all whose distances rounding may have made
    /// equal (10⁻¹² relative), in the order of their numbers.
    pub fn closest(&self, point: &Vector2<f64>, closest: impl Fn(usize) -> Vector2<f64>) -> Vec<usize> {
        const EQUAL: f64 = 1.0 + 1e-12;
        let at = point * self.scale;
        let to = |i: usize| (closest(i) * self.scale - at).norm_squared();
        let to_box = |node: &BvhNode| {
            let (min, max) = (node.mins(), node.maxs());
            distance_squared(&at, &[min.x, min.y], &[max.x, max.y])
        };
        let open = self.unbounded.iter().map(|&i| to(i)).fold(f64::MAX, f64::min);
        let least = self
            .bvh
            .find_best(open, |node: &BvhNode, _| to_box(node), |leaf, _| Some(to(self.bounded[leaf as usize])))
            .map_or(open, |(_, d)| d);
        let within = least * EQUAL * EQUAL;
        let mut near: Vec<usize> = self
            .bvh
            .leaves(|node: &BvhNode| to_box(node) <= within)
            .map(|leaf| self.bounded[leaf as usize])
            .chain(self.unbounded.iter().copied())
            .filter(|&i| to(i) <= within)
            .collect();
        near.sort_unstable();
        near
    }
}
