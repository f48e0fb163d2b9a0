//! Closed meshes of several parts: which lie outside of one another, and which bound cavities.
use super::{Mesh, across};
use crate::{BoxTree, Error, Extent, edges::sides};
use nalgebra::Vector3;
use std::collections::HashMap;

/// For each triangle the number of one that represents its part of the surface; `at` gives the triangle of each side.
pub(super) fn shells(triangles: &[[usize; 3]], at: &HashMap<[usize; 2], usize>) -> Vec<usize> {
    let mut shell = vec![usize::MAX; triangles.len()];
    let mut open = vec![];
    for first in 0..triangles.len() {
        if shell[first] != usize::MAX {
            continue;
        }
        shell[first] = first;
        open.push(first);
        while let Some(k) = open.pop() {
            for [a, b] in sides(triangles[k]) {
                if let Some(&other) = at.get(&[b, a]).filter(|&&other| shell[other] == usize::MAX) {
                    shell[other] = first;
                    open.push(other);
                }
            }
        }
    }
    shell
}

/// A part of the surface.
struct Shell {
    /// Its number, that of one of its triangles.
    first: usize,
    members: Vec<usize>,
    extent: Extent<3>,
}

impl Mesh {
    /// Refuses a closed mesh with a part whose orientation contradicts the others: a part that lies in no other one
    /// must be oriented like the whole, a part that lies in another one bounds a cavity, and a part in a cavity is a
    /// body again.
    ///
    /// So around the points of a part the others wind 0 times if it is a body and once if it is a cavity. Points that
    /// lie on others decide nothing, nor do parts that enclose nothing. Where no triangle of another part is near, one
    /// point speaks for all.
    ///
    /// # Errors
    /// [`Error::Triangle`] with one of these `numbers`.
    pub(super) fn check_shells(&self, shell: &[usize], numbers: &[usize]) -> Result<(), Error> {
        let mut parts: HashMap<usize, Shell> = HashMap::new();
        for (k, &first) in shell.iter().enumerate() {
            let part = parts.entry(first).or_insert(Shell { first, members: vec![], extent: Extent::EMPTY });
            part.members.push(k);
            part.extent = part.extent.union(Extent::of(self.corners(k)));
        }
        if parts.len() < 2 {
            return Ok(());
        }
        let mut parts: Vec<Shell> = parts.into_values().collect();
        parts.sort_by_key(|part| part.first);
        let boxes = BoxTree::new(parts.iter().map(|part| part.extent));
        let outwards = if self.outside { 1 } else { -1 };
        for part in &parts {
            let volume = f64::from(outwards) * self.volume(&part.members);
            if volume == 0.0 {
                continue;
            }
            let mut is_decided = false;
            for &k in &part.members {
                if is_decided && !self.is_near_others(k, shell) {
                    continue;
                }
                let [a, b, c] = self.corners(k);
                for point in [a, b, c, (a + b + c) / 3.0] {
                    let Some(around) = self.winding_of_others(&parts, &boxes, part.first, shell, &point) else {
                        continue;
                    };
                    let problem = match (volume > 0.0, outwards * around) {
                        (true, 0) | (false, 1) => {
                            is_decided = true;
                            continue;
                        }
                        (false, 0) => {
                            "belongs to a part of the surface that is inside out: reverse all triangles of that part"
                        }
                        _ => {
                            "belongs to a part of the surface that reaches into another one: unite the two, or, where it bounds a \
                             cavity, reverse its triangles"
                        }
                    };
                    return Err(Error::Triangle { triangle: numbers[k], problem });
                }
            }
        }
        Ok(())
    }

    /// Whether the box around a triangle meets that around a triangle of another part.
    fn is_near_others(&self, k: usize, shell: &[usize]) -> bool {
        let (extent, mut found) = (Extent::of(self.corners(k)), false);
        self.tree.search(|e| e.meets(&extent, self.slack), |other| found |= shell[other] != shell[k]);
        found
    }

    /// How often all parts except one wind around a point; `None` if it lies on one of them, within rounding.
    fn winding_of_others(
        &self,
        parts: &[Shell],
        boxes: &BoxTree<3>,
        own: usize,
        shell: &[usize],
        point: &Vector3<f64>,
    ) -> Option<i32> {
        let mut is_in_a_box = false;
        boxes.search(|e| e.distance(point) <= self.slack, |i| is_in_a_box |= parts[i].first != own);
        if !is_in_a_box {
            return Some(0);
        }
        let mut is_on_one = false;
        self.tree.search(
            |e| e.distance(point) <= 2.0 * self.slack,
            |k| is_on_one = is_on_one || (shell[k] != own && self.has_on_it(k, point, self.slack)),
        );
        (!is_on_one).then(|| self.surface().winding(point, 0, |k| shell[k] != own))
    }

    /// Six times the volume that triangles enclose, counter-clockwise from outside, in units of the cube of the size;
    /// zero where what they enclose is no thicker than rounding.
    fn volume(&self, triangles: &[usize]) -> f64 {
        let origin = self.vertices[self.triangles[triangles[0]][0]];
        let (mut volume, mut area) = (0.0, 0.0);
        for &k in triangles {
            let corners = self.corners(k);
            let (n, edge) = across(corners);
            let part = (edge / self.size) * (edge / self.size);
            volume += ((corners[0] - origin) / self.size).dot(&n) * part;
            area += n.norm() * part;
        }
        if volume.abs() > self.slack / self.size * area { volume } else { 0.0 }
    }
}
