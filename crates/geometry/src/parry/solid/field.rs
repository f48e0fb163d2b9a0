//! parry's shapes in space as distance fields, and as triangles.
use super::super::{
    Side,
    convert::{Frame, from_glam3, to_glam3},
    distance::{Distance, Field},
    mesh::Mesh,
    outer::projected,
    polytope::Polytope,
};
use super::unsupported;
use crate::{Error, Extent};
use core::fmt;
use nalgebra::{Matrix3, Vector3};
use parry3d_f64::{
    math::Vector as Glam,
    shape::{HeightField, Shape, TriMesh, TriMeshFlags, TypedShape, Voxels},
};
use std::collections::{HashMap, HashSet};

/// A parry shape that projects points accurately by itself.
pub(super) struct Spatial {
    shape: Box<dyn Shape>,
}

impl fmt::Debug for Spatial {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.shape.shape_type())
    }
}

impl Field<3> for Spatial {
    fn project(&self, x: &Vector3<f64>) -> (Vector3<f64>, bool) {
        let projection = self.shape.project_local_point(to_glam3(x), false);
        // parry's own shapes project by formula
        let is_users = matches!(self.shape.as_typed_shape(), TypedShape::Custom(_));
        let support = self
            .shape
            .as_support_map()
            .filter(|_| is_users)
            .map(|s| move |n: &Vector3<f64>| from_glam3(s.local_support_point(to_glam3(n))));
        projected(x, (from_glam3(projection.point), projection.is_inside), support)
    }
    fn extent(&self) -> Extent<3> {
        let extent = self.shape.compute_local_aabb();
        Extent { min: from_glam3(extent.mins), max: from_glam3(extent.maxs) }
    }
    fn is_convex(&self) -> bool {
        self.shape.is_convex() || self.shape.as_support_map().is_some()
    }
}

/// A shape and the power of two by which it has been multiplied.
pub(super) struct Scaled {
    field: Box<dyn Field<3>>,
    scale: f64,
}

impl Scaled {
    /// The shape scaled to size 1, where possible: parry's own shapes fail below size 1e-8.
    fn new(shape: &dyn Shape) -> Scaled {
        let own = Spatial { shape: shape.clone_dyn() };
        let scale = Distance::unit(&own.extent());
        match shape.scale_dyn(Glam::splat(scale), 20) {
            Some(shape) => Scaled { field: Box::new(Spatial { shape }), scale },
            None => Scaled { field: Box::new(own), scale: 1.0 },
        }
    }

    pub(super) fn placed(self, frame: &Frame<3>, side: Side) -> Distance<3> {
        Distance::new(self.field, *frame, self.scale, side)
    }
}

/// The distance from a shape.
pub(super) fn distance(shape: &dyn Shape, frame: &Frame<3>, side: Side) -> Distance<3> {
    Scaled::new(shape).placed(frame, side)
}

impl Spatial {
    pub(super) fn distance(shape: &dyn Shape, frame: &Frame<3>, side: Side) -> Distance<3> {
        distance(shape, frame, side)
    }
}

fn oriented(vertices: Vec<Glam>, triangles: Vec<[u32; 3]>) -> Result<TriMesh, Error> {
    let flags = TriMeshFlags::ORIENTED | TriMeshFlags::MERGE_DUPLICATE_VERTICES;
    TriMesh::with_flags(vertices, triangles, flags).map_err(|_| unsupported("triangle mesh", "it has no triangles"))
}

impl Scaled {
    /// Triangles scaled to size 1 before parry computes its normals from them.
    fn of_triangles(points: &[Glam], triangles: &[[u32; 3]]) -> Result<Scaled, Error> {
        let scale = Distance::unit(&Extent::of(points.iter().map(|p| from_glam3(*p))));
        let points = points.iter().map(|p| *p * scale).collect();
        Ok(Scaled { field: Box::new(Spatial { shape: Box::new(oriented(points, triangles.to_vec())?) }), scale })
    }
}

/// The distance from a convex polyhedron through its faces: parry's own uses an iteration accurate to 10⁻⁸.
pub(super) fn polytope(polytope: &Polytope) -> Result<Scaled, Error> {
    let corners: Vec<Glam> = polytope.corners.iter().map(to_glam3).collect();
    Scaled::of_triangles(&corners, &numbered(&polytope.triangles())?)
}

/// Triangles in parry's form.
fn numbered(triangles: &[[usize; 3]]) -> Result<Vec<[u32; 3]>, Error> {
    let number = |v: usize| u32::try_from(v).map_err(|_| unsupported("triangle mesh", "it has too many vertices"));
    triangles.iter().map(|[a, b, c]| Ok([number(*a)?, number(*b)?, number(*c)?])).collect()
}

/// The distance from a mesh in its own coordinates.
pub(super) fn mesh_distance(mesh: &Mesh, side: Side) -> Result<Distance<3>, Error> {
    let vertices: Vec<Glam> = mesh.vertices.iter().map(to_glam3).collect();
    // parry wants them counter-clockwise from outside; ours are counter-clockwise from the table
    let outwards = |[a, b, c]: [usize; 3]| if side == Side::Outside { [a, b, c] } else { [a, c, b] };
    let triangles = numbered(&mesh.triangles.iter().map(|t| outwards(*t)).collect::<Vec<_>>())?;
    let whole = Frame { rotation: Matrix3::identity(), translation: Vector3::zeros() };
    Ok(Scaled::of_triangles(&vertices, &triangles)?.placed(&whole, side))
}

/// Vertices and triangles of a height field, counter-clockwise as seen from above (+y).
pub(super) fn height_field(field: &HeightField) -> (Vec<Vector3<f64>>, Vec<[usize; 3]>) {
    let (rows, columns) = (field.nrows(), field.ncols()); // cells
    let scale = from_glam3(field.scale());
    // each vertex once: neighbouring cells share it to the last bit
    let vertex = |i: usize, j: usize| {
        let (x, z) = (j as f64 / columns as f64 - 0.5, i as f64 / rows as f64 - 0.5);
        Vector3::new(x, field.heights()[(i, j)], z).component_mul(&scale)
    };
    let vertices = (0..=columns).flat_map(|j| (0..=rows).map(move |i| (i, j))).map(|(i, j)| vertex(i, j)).collect();
    let triangles = (0..rows)
        .flat_map(|i| (0..columns).map(move |j| (i, j)))
        .flat_map(|(i, j)| {
            let (first, second) = field.triangles_vids_at(i, j);
            [first, second]
        })
        .flatten()
        .map(|t| t.map(|v| v as usize));
    let vertices: Vec<Vector3<f64>> = vertices;
    let up = |t: [usize; 3]| {
        let [a, b, c] = t.map(|v| vertices[v]);
        if (b - a).cross(&(c - a)).y < 0.0 { [t[0], t[2], t[1]] } else { t }
    };
    let triangles = triangles.map(up).collect();
    (vertices, triangles)
}

/// The faces of full cells that adjoin empty ones, as triangles counter-clockwise as seen from outside.
pub(super) fn voxels(voxels: &Voxels) -> (Vec<Vector3<f64>>, Vec<[usize; 3]>) {
    let full: Vec<[i64; 3]> = voxels.voxels().map(|v| [v.grid_coords.x, v.grid_coords.y, v.grid_coords.z]).collect();
    let is_full: HashSet<[i64; 3]> = full.iter().copied().collect();
    let size = from_glam3(voxels.voxel_size());
    let mut vertices = vec![];
    let mut number: HashMap<[i64; 3], usize> = HashMap::new();
    let mut triangles = vec![];
    for cell in full {
        for axis in 0..3 {
            for side in [0, 1] {
                let mut neighbour = cell;
                neighbour[axis] += 2 * side - 1;
                if is_full.contains(&neighbour) {
                    continue;
                }
                let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
                let mut corner = |a: i64, b: i64| {
                    let mut at = cell;
                    at[axis] += side;
                    at[i] += a;
                    at[j] += b;
                    *number.entry(at).or_insert_with(|| {
                        vertices.push(Vector3::from_fn(|k, _| at[k] as f64 * size[k]));
                        vertices.len() - 1
                    })
                };
                let mut ring = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                if side == 0 {
                    ring.reverse();
                }
                triangles.extend([[ring[0], ring[1], ring[2]], [ring[0], ring[2], ring[3]]]);
            }
        }
    }
    (vertices, triangles)
}
