//! What is near a point, or in boxes selected by a predicate.
use super::{BoxTree, WIDTH, stack::Stack};
use crate::Extent;
use nalgebra::SVector;

impl<const N: usize> BoxTree<N> {
    /// Visits every box that is `wanted`, in the order of the tree; every box around a wanted box must be wanted,
    /// too.
    pub(crate) fn search(&self, wanted: impl Fn(&Extent<N>) -> bool, mut visit: impl FnMut(usize)) {
        let Some(root) = self.levels.len().checked_sub(1) else { return };
        let mut open = Stack::of((root, 0));
        while let Some((level, place)) = open.pop(0) {
            let node = &self.nodes[self.levels[level].start + place];
            let last = WIDTH.min(self.levels[level].boxes - WIDTH * place);
            if level == 0 {
                for k in (0..last).filter(|&k| wanted(&node.extent(k))) {
                    visit(self.number(WIDTH * place + k));
                }
            } else {
                for k in (0..last).rev().filter(|&k| wanted(&node.extent(k))) {
                    open.push((level - 1, WIDTH * place + k));
                }
            }
        }
    }

    /// The least value of a function that is at least the distance of `point` from the box, and the place where it
    /// is attained; `None` where nothing is below `bound`.
    pub(crate) fn nearest(
        &self,
        point: &SVector<f64, N>,
        bound: f64,
        mut distance: impl FnMut(usize) -> f64,
    ) -> Option<(f64, usize)> {
        let mut best = (bound, None);
        let root = self.levels.len().checked_sub(1)?;
        let mut open = Stack::of((0.0, root + 1, 0));
        while let Some((lower, above, place)) = open.pop(0) {
            if lower > best.0 {
                continue;
            }
            let Some(level) = above.checked_sub(1) else {
                let number = self.number(place);
                let d = distance(number);
                if d < best.0 || (d == best.0 && best.1.is_some_and(|k| number < k)) {
                    best = (d, Some(number));
                }
                continue;
            };
            let node = &self.nodes[self.levels[level].start + place];
            // the nearest goes on top
            let bottom = open.count();
            for k in 0..WIDTH.min(self.levels[level].boxes - WIDTH * place) {
                let child = (node.extent(k).distance(point), level, WIDTH * place + k);
                if child.0 <= best.0 {
                    open.insert(bottom, child, |other| other.0 < child.0);
                }
            }
        }
        best.1.map(|number| (best.0, number))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector2;

    fn grid() -> Vec<Extent> {
        let corner = |k: i32| Vector2::new(f64::from(k * k % 97), f64::from(k * 31 % 89));
        (0..500).map(|k| Extent { min: corner(k), max: corner(k) + Vector2::new(1.0, 2.0) }).collect()
    }

    #[test]
    fn a_search_finds_what_asking_every_box_finds() {
        let boxes = grid();
        let tree = BoxTree::new(boxes.clone());
        for q in grid().iter().step_by(7) {
            let mut found = vec![];
            tree.search(|e| e.meets(q, 0.0), |i| found.push(i));
            found.sort_unstable();
            let all: Vec<usize> = (0..boxes.len()).filter(|&i| boxes[i].meets(q, 0.0)).collect();
            assert_eq!(found, all);
        }
    }

    #[test]
    fn the_nearest_box_is_the_nearest_of_all() {
        let boxes = grid();
        let tree = BoxTree::new(boxes.clone());
        for k in 0..100 {
            let p = Vector2::new(f64::from(k * 13 % 120) - 10.5, f64::from(k * 29 % 110) - 10.25);
            let all = boxes.iter().map(|b| b.distance(&p)).fold(f64::INFINITY, f64::min);
            let found = tree.nearest(&p, f64::INFINITY, |i| boxes[i].distance(&p)).unwrap();
            assert_eq!(found.0, all);
        }
    }
}
