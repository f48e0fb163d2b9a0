//! The parts of the surface parallel to a mesh: parts of planes above triangles, of cylinders around edges, of spheres around
//! corners.
//!
//! Points are drawn from each part together with some surroundings that are not exposed. These are small, even where triangles are
//! much smaller than the margin; of whole plates (all points within the margin of a triangle), nearly everything would then be
//! inside others.
use crate::{parry::mesh::Mesh, surface::in_disk};
use core::f64::consts::PI;
use nalgebra::Vector3;
use std::collections::HashMap;

/// Angles with a sine below this count as zero.
const ALIKE: f64 = 1e-6;

/// A part of a parallel surface, perhaps with a little more.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stratum {
    /// The first of the triangles that it surrounds.
    pub(super) triangle: usize,
    form: Form,
}

#[derive(Clone, Copy, Debug)]
enum Form {
    /// The plane above a triangle.
    Plane,
    /// A sector around the edge that starts at this corner of the triangle: its middle direction, and half its angle.
    Cylinder { start: usize, middle: Vector3<f64>, half: f64 },
    /// A cap around this corner of the triangle: its middle direction, and its height as a fraction of the radius.
    Sphere { corner: usize, middle: Vector3<f64>, height: f64 },
}

/// The triangles at an edge.
struct Edge {
    triangle: usize,
    start: usize,
    /// Unit vectors across it, into the triangles.
    inward: Vec<Vector3<f64>>,
    /// The sum of their normals, which points into the table.
    front: Vector3<f64>,
}

/// The edges at a vertex.
#[derive(Clone, Default)]
struct Star {
    /// The first triangle, and which of its corners it is.
    corner: Option<(usize, usize)>,
    /// Unit vectors along the edges.
    along: Vec<Vector3<f64>>,
    /// The sum of the triangles' normals weighted by their angles, which points into the table.
    front: Vector3<f64>,
}

/// All parts, those of the first triangle first.
pub(super) fn strata(mesh: &Mesh) -> Vec<Stratum> {
    let mut known: HashMap<[usize; 2], usize> = HashMap::new();
    let mut edges: Vec<Edge> = vec![];
    let mut stars = vec![Star::default(); mesh.vertices.len()];
    let mut strata = vec![];
    for (triangle, (corners, normal)) in mesh.triangles.iter().zip(&mesh.normals).enumerate() {
        strata.push(Stratum { triangle, form: Form::Plane });
        for start in 0..3 {
            let (a, b) = (corners[start], corners[(start + 1) % 3]);
            let [along, back] = [b, corners[(start + 2) % 3]].map(|to| mesh.vertices[to] - mesh.vertices[a]);
            let (along, back) = (along / along.norm(), back / back.norm());
            stars[a].corner.get_or_insert((triangle, start));
            stars[a].front += normal * libm::atan2(along.cross(&back).norm(), along.dot(&back));
            let edge = *known.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                stars[a].along.push(along);
                stars[b].along.push(-along);
                edges.push(Edge { triangle, start, inward: vec![], front: Vector3::zeros() });
                edges.len() - 1
            });
            edges[edge].inward.push(normal.cross(&along));
            edges[edge].front += normal;
        }
    }
    strata.extend(edges.iter().filter_map(Edge::stratum));
    strata.extend(stars.iter().filter_map(Star::stratum));
    strata
}

impl Edge {
    /// Around an edge the surface lies in directions that lead away from its triangles, if those lead into the table.
    fn stratum(&self) -> Option<Stratum> {
        let (middle, half) = match self.inward[..] {
            [] => return None,
            [a] => (-a, 0.5 * PI),
            // for more than two triangles, two exclude enough
            [a, b, ..] => {
                let between = -(a + b);
                let length = between.norm();
                let angle = libm::atan2(a.cross(&b).norm(), -a.dot(&b));
                (if length > 0.0 { between / length } else { between }, 0.5 * angle)
            }
        };
        let form = Form::Cylinder { start: self.start, middle, half };
        // at a rim the two are perpendicular
        (half > 0.0 && middle.dot(&self.front) >= -ALIKE).then_some(Stratum { triangle: self.triangle, form })
    }
}

impl Star {
    /// Around a vertex the surface lies in directions that lead away from its edges, if those lead into the table. They form a cone;
    /// the stratum is a cap around it.
    fn stratum(&self) -> Option<Stratum> {
        /// For more edges than this, a selection excludes enough.
        const MOST: usize = 16;
        /// The component along an edge that a direction may have and still count as leading away from it.
        const LITTLE: f64 = 1e-8;
        let (triangle, corner) = self.corner?;
        let along: Vec<_> = self.along.iter().step_by(self.along.len().div_ceil(MOST)).collect();
        // on a straight side the remaining directions lie in a plane, and are covered by the edges' cylinders
        if along.iter().enumerate().any(|(i, a)| along[..i].iter().any(|b| (*a + *b).norm() <= ALIKE)) {
            return None;
        }
        let away = |u: &Vector3<f64>| along.iter().all(|a| u.dot(a) <= LITTLE);
        let both = |across: Vector3<f64>| {
            let length = across.norm();
            let side = (length > ALIKE).then(|| across / length);
            side.into_iter().flat_map(|side| [side, -side]).filter(away)
        };
        // the cone is spanned by the intersection lines of its sides that belong to it
        let pairs = along.iter().enumerate().flat_map(|(i, a)| along[..i].iter().map(move |b| a.cross(b)));
        let rays: Vec<Vector3<f64>> = pairs.flat_map(both).collect();
        let line = *rays.first()?;
        let sum: Vector3<f64> = rays.iter().sum();
        let length = sum.norm();
        let form = if length > ALIKE {
            let middle = sum / length;
            if middle.dot(&self.front) < -ALIKE {
                return None;
            }
            let height = rays.iter().map(|ray| 0.5 * (ray - middle).norm_squared()).fold(0.0, f64::max);
            // for rays that are farther apart, directions between them need not be near the middle
            Form::Sphere { corner, middle, height: if height < 1.0 { height } else { 2.0 } }
        } else {
            // around a vertex inside a plane only a line is left, unless the vertex is on a rim
            let flat = rays.iter().all(|ray| ray.cross(&line).norm() <= ALIKE);
            if flat && !along.iter().any(|a| both(line.cross(a)).next().is_some()) {
                return None;
            }
            Form::Sphere { corner, middle: line, height: 2.0 }
        };
        Some(Stratum { triangle, form })
    }
}

impl Stratum {
    /// Its area, where `unit` is the inverse of the unit of length.
    pub(super) fn area(&self, mesh: &Mesh, margin: f64, unit: f64) -> f64 {
        let corners = mesh.triangles[self.triangle].map(|v| mesh.vertices[v]);
        let margin = margin * unit;
        match self.form {
            Form::Plane => mesh.area(self.triangle, unit),
            Form::Cylinder { start, half, .. } => {
                2.0 * half * margin * ((corners[(start + 1) % 3] - corners[start]) * unit).norm()
            }
            Form::Sphere { height, .. } => 2.0 * PI * margin * margin * height,
        }
    }

    /// A random point of it; none where the cap around a corner is larger than what leads away from the triangle: projected onto the
    /// triangle's surroundings, such a point would be one too many on another of their parts.
    pub(super) fn draw(&self, mesh: &Mesh, margin: f64, uniform: &mut dyn FnMut() -> f64) -> Option<Vector3<f64>> {
        let corners = mesh.triangles[self.triangle].map(|v| mesh.vertices[v]);
        Some(match self.form {
            Form::Plane => mesh.random_point(self.triangle, uniform) + mesh.normals[self.triangle] * margin,
            Form::Cylinder { start, middle, half } => {
                let along = corners[(start + 1) % 3] - corners[start];
                let (sin, cos) = libm::sincos(half * (2.0 * uniform() - 1.0));
                let side = along.cross(&middle) / along.norm();
                corners[start] + along * uniform() + (middle * cos + side * sin) * margin
            }
            Form::Sphere { corner, middle, height } => {
                let disk = in_disk(&middle, uniform);
                // heights are distributed uniformly, and so are the squared radii of points of a disk
                let below = height * disk.norm_squared();
                let outward = middle * (1.0 - below) + disk * (height * (2.0 - below)).sqrt();
                let sides = [1, 2].map(|next| corners[(corner + next) % 3] - corners[corner]);
                if sides.iter().any(|side| outward.dot(side) > 0.0) {
                    return None;
                }
                corners[corner] + outward * margin
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{parry::convert::Frame, random};
    use core::f64::consts::FRAC_PI_2;
    use nalgebra::Isometry3;

    fn mesh(vertices: &[Vector3<f64>], triangles: &[[usize; 3]]) -> Mesh {
        Mesh::new(vertices, &Frame::from(&Isometry3::identity()), triangles, true, false).unwrap()
    }

    /// The strata of triangles as seen from outside: how many planes, cylinders and spheres.
    fn count(vertices: &[Vector3<f64>], triangles: &[[usize; 3]]) -> [usize; 3] {
        let mut found = [0; 3];
        for stratum in strata(&mesh(vertices, triangles)) {
            match stratum.form {
                Form::Plane => found[0] += 1,
                Form::Cylinder { .. } => found[1] += 1,
                Form::Sphere { .. } => found[2] += 1,
            }
        }
        found
    }

    #[test]
    fn a_triangle_alone_has_a_cylinder_at_each_edge_however_it_lies() {
        let mut random = random::uniform(1);
        for _ in 0..1000 {
            let corners =
                vec![Vector3::from_fn(|_, _| random()), Vector3::from_fn(|_, _| random()), Vector3::x() * 3.0];
            assert_eq!(count(&corners, &[[0, 1, 2]]), [1, 3, 3]);
        }
    }

    #[test]
    fn along_straight_edges_vertices_have_nothing() {
        // a square in four triangles about its middle, and a vertex in the middle of one of its sides
        let v = |x: f64, y: f64| Vector3::new(x, y, 0.0);
        let vertices = vec![v(0.0, 0.0), v(2.0, 0.0), v(2.0, 2.0), v(0.0, 2.0), v(1.0, 1.0), v(1.0, 0.0)];
        let triangles = [[0, 5, 4], [5, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
        // flat edges have no cylinders
        assert_eq!(count(&vertices, &triangles), [5, 5, 4]);
    }

    #[test]
    fn a_cube_has_a_quarter_of_a_cylinder_at_each_edge_and_an_eighth_of_a_sphere_within_each_cap() {
        let vertices: Vec<_> = (0..8).map(|k| Vector3::from([0, 1, 2].map(|i| f64::from(k >> i & 1)))).collect();
        let sides = [[0, 2, 3, 1], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5], [4, 5, 7, 6]];
        let triangles: Vec<_> = sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
        let mesh = mesh(&vertices, &triangles);
        let [mut edges, mut corners] = [0, 0];
        for stratum in strata(&mesh) {
            match stratum.form {
                Form::Plane => {}
                Form::Cylinder { half, .. } => {
                    edges += 1;
                    assert!((2.0 * half - FRAC_PI_2).abs() < 1e-15);
                }
                // at least from the diagonal to the axes; the diagonals of sides pull the middle away from it
                Form::Sphere { height, .. } => {
                    corners += 1;
                    assert!((1.0 - 1.0 / 3.0_f64.sqrt()..0.75).contains(&(height + 1e-15)), "{height}");
                }
            }
        }
        assert_eq!([edges, corners], [12, 8]);
    }
}
