//! A tree of boxes: which of many pieces are near a place, without asking all of them.
use crate::Extent;
use nalgebra::Vector2;

/// Boxes in a leaf: fewer cost more memory, more cost more tests.
const LEAF: usize = 4;

/// A binary tree over boxes, halved at the median of their middles.
#[derive(Clone, Debug)]
pub(crate) struct BoxTree {
    /// Node `k` covers all boxes below its two children, which are its successor and `second`; a leaf has none.
    nodes: Vec<Node>,
    order: Vec<usize>,
    boxes: Vec<Extent>,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    extent: Extent,
    /// Range in `order`.
    from: usize,
    to: usize,
    second: Option<usize>,
}

impl BoxTree {
    pub(crate) fn new(boxes: Vec<Extent>) -> BoxTree {
        let mut tree = BoxTree { nodes: vec![], order: (0..boxes.len()).collect(), boxes };
        if !tree.boxes.is_empty() {
            let to = tree.boxes.len();
            tree.grow(0, to);
        }
        tree
    }

    fn grow(&mut self, from: usize, to: usize) -> usize {
        let boxes = &self.boxes;
        let order = &mut self.order[from..to];
        let extent = order.iter().map(|&i| boxes[i]).fold(Extent::EMPTY, Extent::union);
        let at = self.nodes.len();
        self.nodes.push(Node { extent, from, to, second: None });
        if order.len() > LEAF {
            let middles = Extent::of(order.iter().map(|&i| middle(&boxes[i])));
            let spread = middles.max - middles.min;
            let axis = usize::from(spread.y > spread.x);
            let half = order.len() / 2;
            order.select_nth_unstable_by(half, |&i, &j| {
                middle(&boxes[i])[axis].total_cmp(&middle(&boxes[j])[axis]).then(i.cmp(&j))
            });
            self.grow(from, from + half);
            self.nodes[at].second = Some(self.grow(from + half, to));
        }
        at
    }

    /// The numbers of the boxes in an order in which neighbours are near each other.
    pub(crate) fn order(&self) -> &[usize] {
        &self.order
    }

    /// Visits every box that is `wanted`, and so lies in boxes that are.
    pub(crate) fn search(&self, wanted: impl Fn(&Extent) -> bool, mut visit: impl FnMut(usize)) {
        let mut at = 0;
        let mut open: Vec<usize> = Vec::new();
        loop {
            if let Some(node) = self.nodes.get(at)
                && wanted(&node.extent)
            {
                if let Some(second) = node.second {
                    open.push(second);
                    at += 1;
                    continue;
                }
                for &i in self.order[node.from..node.to].iter().filter(|&&i| wanted(&self.boxes[i])) {
                    visit(i);
                }
            }
            match open.pop() {
                Some(next) => at = next,
                None => return,
            }
        }
    }

    /// The least value of a function that is at least the distance of `point` from the box, and whose it is; `None`
    /// where nothing is below `bound`.
    pub(crate) fn nearest(
        &self,
        point: &Vector2<f64>,
        bound: f64,
        mut distance: impl FnMut(usize) -> f64,
    ) -> Option<(f64, usize)> {
        let mut best = (bound, None);
        let mut open = vec![];
        if let Some(root) = self.nodes.first() {
            open.push((root.extent.distance(point), 0));
        }
        while let Some((lower, at)) = open.pop() {
            if lower > best.0 {
                continue;
            }
            let node = &self.nodes[at];
            if let Some(second) = node.second {
                let [a, b] = [at + 1, second].map(|k| (self.nodes[k].extent.distance(point), k));
                // the nearer child is asked first
                open.extend(if a.0 < b.0 { [b, a] } else { [a, b] });
            } else {
                for &i in &self.order[node.from..node.to] {
                    if self.boxes[i].distance(point) <= best.0 {
                        let d = distance(i);
                        if d < best.0 || (d == best.0 && best.1.is_some_and(|k| i < k)) {
                            best = (d, Some(i));
                        }
                    }
                }
            }
        }
        best.1.map(|i| (best.0, i))
    }
}

fn middle(extent: &Extent) -> Vector2<f64> {
    let finite = |x: f64| x.clamp(-f64::MAX, f64::MAX) * 0.5;
    extent.min.zip_map(&extent.max, |a, b| finite(a) + finite(b))
}

impl Extent {
    /// Distance of a point from the box, 0 inside.
    pub(crate) fn distance(&self, point: &Vector2<f64>) -> f64 {
        let gap = |i: usize| (self.min[i] - point[i]).max(point[i] - self.max[i]).max(0.0);
        libm::hypot(gap(0), gap(1))
    }

    /// Whether the boxes have a point in common, or are no farther apart than `reach` along each axis.
    pub(crate) fn meets(&self, other: &Extent, reach: f64) -> bool {
        (0..2).all(|i| self.min[i] <= other.max[i] + reach && other.min[i] <= self.max[i] + reach)
    }

    /// Greatest finite coordinate, without sign.
    pub(crate) fn size(&self) -> f64 {
        self.min.iter().chain(self.max.iter()).filter(|x| x.is_finite()).fold(0.0, |m: f64, x| m.max(x.abs()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
