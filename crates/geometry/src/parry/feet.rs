//! Where convex solids with edges stand on other walls.
//!
//! A path into the line along which such a solid meets the wall that is hit may pass by its edge there: the chord through the solid is
//! shorter than rounding. So what stands at the point of the hit is looked for.
use crate::{BoxTree, Extent};
use nalgebra::Vector3;

/// The solids among several walls that may touch another one, with a tree of their boxes.
#[derive(Debug)]
pub(super) struct Feet {
    numbers: Vec<usize>,
    tree: BoxTree<3>,
}

impl Feet {
    /// Of walls in the boxes of a tree: numbers and boxes of the solids with edges, and whether the surface of another wall (the first
    /// number) stays out of the box of one of them.
    pub(super) fn new(
        walls: &BoxTree<3>,
        solids: impl Iterator<Item = (usize, Extent<3>)>,
        is_apart: impl Fn(usize, &Extent<3>) -> bool,
    ) -> Feet {
        let touches = |(number, extent): &(usize, Extent<3>)| {
            let mut touches = false;
            walls.search(
                |other| other.meets(extent, 0.0),
                |k| touches = touches || (k != *number && !is_apart(k, extent)),
            );
            touches
        };
        let (numbers, boxes): (Vec<_>, Vec<_>) = solids.filter(touches).unzip();
        Feet { numbers, tree: BoxTree::new(boxes) }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.numbers.is_empty()
    }

    /// Whether any of the solids stands at a point, for those in whose boxes this lies, to within `near`.
    pub(super) fn any_at(&self, point: &Vector3<f64>, near: f64, stands: impl Fn(usize) -> bool) -> bool {
        if self.is_empty() {
            return false;
        }
        let (at, mut found) = (Extent { min: *point, max: *point }, false);
        self.tree.search(|e| e.meets(&at, near), |place| found = found || stands(self.numbers[place]));
        found
    }
}
