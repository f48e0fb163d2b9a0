//! Where a surface of triangles ends.
use super::SolidSpec;
use crate::{edges::merged, parry::mesh};

impl SolidSpec {
    /// How many sides of triangles have no other triangle beyond them: 0 where the surface is closed, as it is for all other
    /// shapes. Through an opening a path may leave the table, or come from behind.
    ///
    /// ```
    /// use geometry::parry::SolidSpec;
    /// let vertices = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    /// let mut triangles = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    /// let mesh = |triangles: &[[usize; 3]]| {
    ///     SolidSpec::TriMesh { vertices: vertices.clone(), triangles: triangles.into(), margin: 0.0 }
    /// };
    /// assert_eq!(mesh(&triangles).rims(), 0);
    /// triangles.pop();
    /// assert_eq!(mesh(&triangles).rims(), 3);
    /// ```
    pub fn rims(&self) -> usize {
        let (vertices, triangles) = match self {
            SolidSpec::TriMesh { vertices, triangles, .. } => (vertices, triangles),
            SolidSpec::Ball { .. }
            | SolidSpec::Cuboid { .. }
            | SolidSpec::Capsule { .. }
            | SolidSpec::Cylinder { .. }
            | SolidSpec::Cone { .. }
            | SolidSpec::ConvexHull { .. }
            | SolidSpec::HalfSpace { .. } => return 0,
        };
        let number = merged(vertices.iter().copied());
        let known = triangles.iter().filter(|t| t.iter().all(|v| *v < number.len()));
        mesh::rims(&known.map(|t| t.map(|v| number[v])).collect::<Vec<_>>())
    }
}
