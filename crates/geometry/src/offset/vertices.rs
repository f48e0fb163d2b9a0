//! Points that are equal up to rounding and, on a lattice, up to a translation.
use crate::{BoxTree, Extent, Lattice};
use nalgebra::Vector2;

/// A vertex moved by a lattice vector.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Site {
    pub(super) vertex: usize,
    /// How many of each lattice vector it is moved by.
    pub(super) cell: [f64; 2],
}

impl Site {
    /// The site moved by a lattice vector.
    pub(super) fn moved(self, by: [f64; 2]) -> Site {
        Site { vertex: self.vertex, cell: [self.cell[0] + by[0], self.cell[1] + by[1]] }
    }
}

pub(super) fn minus(a: [f64; 2]) -> [f64; 2] {
    // 0 − 0 is +0
    [0.0 - a[0], 0.0 - a[1]]
}

/// Vertices, and which of them are the same (a union–find forest with translations).
#[derive(Debug)]
pub(super) struct Vertices {
    lattice: Option<Lattice>,
    points: Vec<Vector2<f64>>,
    /// Each vertex is a translate of its parent.
    parents: Vec<Site>,
}

impl Vertices {
    pub(super) fn new(lattice: Option<&Lattice>) -> Vertices {
        Vertices { lattice: lattice.cloned(), points: vec![], parents: vec![] }
    }

    /// A new vertex.
    pub(super) fn add(&mut self, point: Vector2<f64>) -> Site {
        let site = Site { vertex: self.points.len(), cell: [0.0; 2] };
        self.points.push(point);
        self.parents.push(site);
        site
    }

    pub(super) fn translation(&self, cell: [f64; 2]) -> Vector2<f64> {
        self.lattice.as_ref().map_or_else(Vector2::zeros, |l| l.translation(cell))
    }

    /// The same place as a translate of the vertex that stands for all of its class.
    pub(super) fn find(&self, mut site: Site) -> Site {
        loop {
            let parent = self.parents[site.vertex];
            if parent.vertex == site.vertex {
                return site;
            }
            site = parent.moved(site.cell);
        }
    }

    /// Where a site lies.
    pub(super) fn at(&self, site: Site) -> Vector2<f64> {
        let root = self.find(site);
        self.points[root.vertex] + self.translation(root.cell)
    }

    /// Declares two sites to be one place.
    pub(super) fn unite(&mut self, a: Site, b: Site) {
        let (a, b) = (self.find(a), self.find(b));
        if a.vertex == b.vertex {
            return;
        }
        // the older vertex stands for both: vertices of the drawn boundary come before crossings
        let (old, new) = if a.vertex < b.vertex { (a, b) } else { (b, a) };
        self.parents[new.vertex] = old.moved(minus(new.cell));
    }

    pub(super) fn len(&self) -> usize {
        self.points.len()
    }

    /// Unites all vertices that are no farther apart in each coordinate than the tolerance of one of them.
    pub(super) fn unite_near(&mut self, tolerances: &[f64]) {
        let home: Vec<(Vector2<f64>, [f64; 2])> =
            self.points.iter().map(|p| self.lattice.as_ref().map_or((*p, [0.0; 2]), |l| l.reduce(p))).collect();
        let tree = BoxTree::new(home.iter().map(|(p, _)| Extent { min: *p, max: *p }));
        let steps: &[f64] = &[0.0, 1.0, -1.0];
        let count = self.lattice.as_ref().map_or(0, |l| l.vectors().len());
        let range = |k: usize| if k < count { steps } else { &steps[..1] };
        for (i, ((p, cell), &tolerance)) in home.iter().zip(tolerances).enumerate() {
            for &first in range(0) {
                for &second in range(1) {
                    let by = [first, second];
                    let moved = p + self.translation(by);
                    let here = Extent { min: moved, max: moved };
                    let mut near = vec![];
                    tree.search(|e| e.meets(&here, tolerance), |j| near.push(j));
                    for j in near.into_iter().filter(|&j| j != i) {
                        // i − cell(i) + by is j − cell(j)
                        let a = Site { vertex: i, cell: [by[0] - cell[0], by[1] - cell[1]] };
                        let b = Site { vertex: j, cell: minus(home[j].1) };
                        self.unite(a, b);
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn v(x: f64, y: f64) -> Vector2<f64> {
        Vector2::new(x, y)
    }

    #[test]
    fn one_place_of_a_lattice_is_one_vertex_whichever_way_rounding_goes() {
        let lattice = Lattice::new(&[v(1.0, 0.0), v(0.0, 2.0)]).unwrap();
        // at a corner of cells, on an edge, and inside
        for place in [v(0.0, 0.0), v(0.0, 0.75), v(0.5, 2.0), v(0.25, 0.5)] {
            let off = [-1e-15, 1e-15];
            for (i, j, k, l) in (0..16).map(|n| (n & 1, n >> 1 & 1, n >> 2 & 1, n >> 3)) {
                let mut vertices = Vertices::new(Some(&lattice));
                let a = vertices.add(place + v(off[i], off[j]));
                let b = vertices.add(place + v(off[k], off[l]) + v(3.0, -4.0));
                let other = vertices.add(place + v(0.125, 0.0));
                vertices.unite_near(&[4e-15; 3]);
                assert_eq!(vertices.find(a).vertex, vertices.find(b).vertex, "{place} {i} {j} {k} {l}");
                assert_ne!(vertices.find(a).vertex, vertices.find(other).vertex);
                // the one is the other, moved by three cells forwards and two down
                assert_eq!(vertices.at(b), vertices.at(a) + v(3.0, -4.0), "{place} {i} {j} {k} {l}");
            }
        }
    }

    #[test]
    fn vertices_of_the_plane_are_united_where_they_are_near_and_nowhere_else() {
        let mut vertices = Vertices::new(None);
        let near = [v(0.0, 0.0), v(1e-15, -1e-15), v(-1e-15, 1e-15)].map(|p| vertices.add(p));
        let far = [v(1e-12, 0.0), v(1.0, 0.0), v(0.0, -1.0)].map(|p| vertices.add(p));
        vertices.unite_near(&[4e-15; 6]);
        assert!(near.iter().all(|site| vertices.at(*site) == v(0.0, 0.0)));
        assert_eq!(far.map(|site| vertices.at(site)), [v(1e-12, 0.0), v(1.0, 0.0), v(0.0, -1.0)]);
    }
}
