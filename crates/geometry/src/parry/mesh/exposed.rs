//! Which of several triangles that coincide bounds the table.
use super::{Mesh, side::FOUND, two_sided::SAME};
use nalgebra::Vector3;

impl Mesh {
    /// Whether the boundary of the table at a point of a triangle belongs to it: the table lies in front of it there, and no earlier
    /// triangle faces the same way.
    ///
    /// Where parts of a closed surface touch, there is no table between them, nor beside a sheet inside of a body. How often the surface
    /// winds around points just in front decides: a ray from the point counts all triangles except those on which the point lies, and,
    /// where it starts at their back, passes these as well.
    pub(crate) fn is_exposed(&self, k: usize, point: &Vector3<f64>) -> bool {
        let normal = &self.normals[k];
        let mut here = vec![];
        self.on_sheets(point, FOUND * self.size, |other| {
            if normal.cross(&self.normals[other]).norm() <= SAME {
                here.push(other);
            }
        });
        if !here.contains(&k) {
            return true;
        }
        if here.iter().any(|&other| other < k && normal.dot(&self.normals[other]) > 0.0) {
            return false;
        }
        if !self.closed {
            return true;
        }
        let axis = normal.iamax();
        let mut around = self.surface().winding(point, axis, |other| !here.contains(&other));
        if normal[axis] < 0.0 {
            let mut before = *point;
            before[axis] = -2.0 * self.size;
            around += self.surface().winding(&before, axis, |other| here.contains(&other));
        }
        (around == 0) == self.outside
    }
}
