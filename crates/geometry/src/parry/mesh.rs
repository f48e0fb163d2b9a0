//! Triangle meshes in space: watertight, one-sided, through a tree of boxes.
mod convex;
mod corner;
mod crossings;
mod exposed;
mod manifold;
mod rim;
mod shells;
mod side;
mod slivers;
mod two_sided;
mod winding;

use super::{convert::Frame, distance::to_unit};
use crate::{
    BoxTree, Crossing, Error, Extent, Line,
    edges::{merged, sides},
    plane::{is_finite, slack},
    walls::CORNER,
};
use corner::Meetings;
use lanes::{Double, two_sum};
use nalgebra::Vector3;
pub(crate) use rim::OnRim;
pub(crate) use side::Nearest;
use std::collections::{HashMap, HashSet};
use two_sided::Sheets;

/// Triangles seen from the table.
#[derive(Clone)]
pub(crate) struct Mesh {
    pub(crate) vertices: Vec<Vector3<f64>>,
    /// Counter-clockwise as seen from the table.
    pub(crate) triangles: Vec<[usize; 3]>,
    /// Unit normals into the table.
    pub(crate) normals: Vec<Vector3<f64>>,
    /// Whether the side from corner `k` to corner `k + 1` is an edge: another normal or nothing on its other side.
    edges: Vec<[bool; 3]>,
    /// Where it may meet other edges.
    meetings: Vec<Meetings>,
    tree: BoxTree<3>,
    /// Minus the distance by which a start may lie behind through rounding. For two-sided triangles, the distance by which it must lie
    /// in front.
    behind: Vec<f64>,
    /// The two-sided triangles.
    sheets: Option<Sheets>,
    slack: f64,
    /// Whether the surface is closed (every side of a triangle has another triangle beyond it), and whether the table is outside.
    closed: bool,
    outside: bool,
    /// The largest coordinate.
    size: f64,
    /// A point within this distance of an edge lies on it.
    near: f64,
}

impl core::fmt::Debug for Mesh {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "Mesh of {} triangles", self.triangles.len())
    }
}

/// A path prepared for triangle tests: coordinates in which it runs along the third axis.
struct Shear {
    axes: [usize; 3],
    slopes: [f64; 2],
}

impl Shear {
    fn new(path: &Line<3>) -> Shear {
        let k = path.velocity.iamax();
        let v = &path.velocity;
        let (i, j) = if v[k] > 0.0 { ((k + 1) % 3, (k + 2) % 3) } else { ((k + 2) % 3, (k + 1) % 3) };
        Shear { axes: [i, j, k], slopes: [v[i] / v[k], v[j] / v[k]] }
    }
    /// The position of a vertex as seen along the path. It is the same for every triangle that shares the vertex, so nothing leaks
    /// through.
    #[inline(always)]
    fn see(&self, from: &Vector3<f64>, vertex: &Vector3<f64>) -> [f64; 2] {
        let [i, j, k] = self.axes;
        let w = vertex - from;
        [w[i] - self.slopes[0] * w[k], w[j] - self.slopes[1] * w[k]]
    }
}

/// How many sides of triangles have no other triangle beyond them: 0 where the surface is closed. Triangles without area count, since
/// they may lie between a long side and the two short ones beyond it; one with a corner twice is a single side with nothing beyond it.
pub(crate) fn rims(triangles: &[[usize; 3]]) -> usize {
    let real = triangles.iter().filter(|[a, b, c]| a != b && b != c && c != a);
    let known: HashSet<[usize; 2]> = real.copied().flat_map(sides).collect();
    known.iter().filter(|[a, b]| !known.contains(&[*b, *a])).count()
}

/// `(b − a) × (c − a)` in units of the longest edge rounded up to a power of two, and that unit, so that no product over- or
/// underflows; accurate to an ulp however thin the triangle is.
pub(crate) fn across([a, b, c]: [Vector3<f64>; 3]) -> (Vector3<f64>, f64) {
    let unit = to_unit((b - a).amax().max((c - a).amax()));
    (cross([a, b, c].map(|corner| corner * unit)), 1.0 / unit)
}

/// `(b − a) × (c − a)`, to an ulp: the differences are exact, and the products have twice as many digits as a number.
pub(crate) fn cross([a, b, c]: [Vector3<f64>; 3]) -> Vector3<f64> {
    let way = |to: Vector3<f64>| {
        [0, 1, 2].map(|i| {
            let (high, low) = two_sum(to[i], -a[i]);
            Double { high, low }
        })
    };
    let (u, v) = (way(b), way(c));
    Vector3::from_fn(|i, _| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        u[j].times(v[k]).plus(-u[k].times(v[j])).value()
    })
}

impl Mesh {
    /// Triangles with their counter-clockwise sides outwards; a closed mesh inside out is turned round.
    ///
    /// `own`: the vertices in the shape's coordinates, whose place in space is given by `frame`. Normals are those of the shape: far away,
    /// rounding moves vertices, and would turn the normals of small triangles. `outside`: the table lies on the outer side. `loose`: edges
    /// may belong to more than two triangles.
    pub(crate) fn new(
        own: &[Vector3<f64>],
        frame: &Frame<3>,
        triangles: &[[usize; 3]],
        outside: bool,
        loose: bool,
    ) -> Result<Mesh, Error> {
        let error = |why| Err(Error::Shape { shape: "triangle mesh", why });
        let vertices: Vec<Vector3<f64>> = own.iter().map(|y| frame.point(y)).collect();
        if vertices.iter().any(|v| !is_finite(v)) {
            return error("a vertex is not finite");
        }
        let id = merged(vertices.iter().copied());
        let placed = |t: &[usize; 3]| across(t.map(|v| vertices[v]));
        let mut triangles: Vec<[usize; 3]> = triangles.iter().map(|t| t.map(|v| id[v])).collect();
        let closed = rims(&triangles) == 0;
        let numbers: Vec<usize>;
        (triangles, numbers) = if loose {
            triangles.retain(|t| !slivers::is_flat(t.map(|v| vertices[v])));
            (triangles, vec![])
        } else {
            slivers::split(&vertices, triangles)?
        };
        if triangles.is_empty() {
            return error("it has no triangle of positive area");
        }
        let mut at: HashMap<[usize; 2], usize> = HashMap::new();
        for (k, t) in triangles.iter().enumerate() {
            for side in sides(*t) {
                if at.insert(side, k).is_some() && !loose {
                    return Err(manifold::problem(&triangles, k, &numbers));
                }
            }
        }
        let origin = vertices[triangles[0][0]];
        let size = triangles.iter().flatten().map(|&v| vertices[v].amax()).fold(0.0, f64::max);
        let volume = |t: &[usize; 3]| {
            let (n, edge) = placed(t);
            let part = edge / size;
            ((vertices[t[0]] - origin) / size).dot(&n) * part * part
        };
        let volume: f64 = triangles.iter().map(volume).sum();
        let turned = (closed && volume < 0.0) == outside;
        let normals: Vec<Vector3<f64>> = triangles
            .iter()
            .map(|t| {
                let (there, _) = placed(t);
                let of_shape = frame.direction(&across(t.map(|v| own[v])).0);
                // what rounding has turned over is taken as it lies
                let n = if of_shape.dot(&there) > 0.0 { of_shape } else { there };
                n / if turned { -n.norm() } else { n.norm() }
            })
            .collect();
        // neighbours whose normals agree to rounding continue one another: rounding of vertices turns short sides by more than an ulp,
        // and no intended angle is this small
        let smooth = |k: usize, j: usize| (normals[k] - normals[j]).norm() <= 1e-9;
        let edge = |k: usize, [a, b]: [usize; 2]| !at.get(&[b, a]).is_some_and(|&j| smooth(k, j));
        let shell = if closed && !loose { shells::shells(&triangles, &at) } else { vec![] };
        let mut edges: Vec<[bool; 3]> =
            triangles.iter().enumerate().map(|(k, t)| sides(*t).map(|side| edge(k, side))).collect();
        if turned {
            for t in &mut triangles {
                t.swap(1, 2);
            }
            for e in &mut edges {
                e.swap(0, 2);
            }
        }
        let tree = BoxTree::new(triangles.iter().map(|t| Extent::of(t.map(|v| vertices[v]))));
        let (slack, near) = (slack([size]), CORNER * size);
        let behind = vec![-slack; triangles.len()];
        let (meetings, sheets) = (vec![], None);
        let mut mesh = Mesh {
            vertices,
            triangles,
            normals,
            edges,
            meetings,
            tree,
            behind,
            sheets,
            slack,
            closed,
            outside,
            size,
            near,
        };
        mesh.check_shells(&shell, &numbers)?;
        mesh.mark_meetings();
        mesh.mark_two_sided();
        if closed && !loose {
            mesh.check_crossings(&numbers)?;
        }
        Ok(mesh)
    }

    /// The boxes around its triangles.
    pub(crate) fn tree(&self) -> &BoxTree<3> {
        &self.tree
    }

    /// When the path crosses one triangle away from the table, as [`crate::Piece::crossing`] has it.
    fn crossing(&self, path: &Line<3>, shear: &Shear, k: usize) -> Crossing {
        let [a, b, c] = self.triangles[k].map(|v| shear.see(&path.point, &self.vertices[v]));
        let turn = |p: [f64; 2], q: [f64; 2]| p[0] * q[1] - p[1] * q[0];
        // seen from the table the corners go round counter-clockwise; seen along the path, clockwise
        let meets = turn(a, b) <= 0.0 && turn(b, c) <= 0.0 && turn(c, a) <= 0.0;
        let normal = &self.normals[k];
        let distance = normal.dot(&(path.point - self.vertices[self.triangles[k][0]]));
        let speed = -normal.dot(&path.velocity);
        Crossing::when(meets && speed > 0.0 && distance > self.behind[k], distance, speed)
    }

    /// The first triangle crossed away from the table, and when.
    pub(crate) fn first(&self, path: &Line<3>) -> Option<(usize, f64)> {
        if path.velocity.amax() == 0.0 {
            return None;
        }
        let shear = Shear::new(path);
        self.tree.first(path, |k| self.crossing(path, &shear, k))
    }

    /// The area of a triangle, where `unit` is the inverse of the unit of length.
    pub(crate) fn area(&self, k: usize, unit: f64) -> f64 {
        let (twice, edge) = across(self.triangles[k].map(|v| self.vertices[v]));
        0.5 * twice.norm() * (edge * unit) * (edge * unit)
    }

    /// A random point of a triangle, uniform by area.
    pub(crate) fn random_point(&self, k: usize, uniform: &mut dyn FnMut() -> f64) -> Vector3<f64> {
        let [a, b, c] = self.triangles[k].map(|v| self.vertices[v]);
        let [s, t] = [uniform(), uniform()];
        // the half of the parallelogram beyond the diagonal is reflected
        let [s, t] = if s + t > 1.0 { [1.0 - s, 1.0 - t] } else { [s, t] };
        a + (b - a) * s + (c - a) * t
    }

    /// A point projected onto a triangle's plane, and whether it lies on an edge of the surface, within rounding, or where another,
    /// two-sided triangle meets it.
    pub(crate) fn land(&self, k: usize, point: &Vector3<f64>) -> (Vector3<f64>, bool) {
        let normal = &self.normals[k];
        let point = point - normal * normal.dot(&(point - self.vertices[self.triangles[k][0]]));
        (point, self.is_corner(k, &point) || self.meets_a_sheet(&point, normal))
    }
}
