//! Meshes with triangles as narrow as rounding, as programs leave them where a corner of one face lies on an edge of another.
#![allow(clippy::unwrap_used, reason = "tests panic where they fail")]
mod random;

use geometry::{
    Boundary, Line, Vector3,
    parry::{Side, Solid, SolidSpec},
};
use random::Random;

/// Triangles, counter-clockwise from outside.
#[derive(Clone)]
struct Mesh {
    vertices: Vec<Vector3<f64>>,
    triangles: Vec<[usize; 3]>,
}

impl Mesh {
    fn solid(&self, side: Side) -> Solid {
        let vertices = self.vertices.iter().map(|v| [v.x, v.y, v.z]).collect();
        SolidSpec::TriMesh { vertices, triangles: self.triangles.clone(), margin: 0.0 }.solid([0.0; 3], side).unwrap()
    }

    /// A corner on some edge, for the triangle on one side of it only: between the two is a triangle that is as wide as rounding.
    fn add_corner(&mut self, random: &mut Random) {
        let (k, s) = (random.below(self.triangles.len()), random.below(3));
        let [a, b] = [self.triangles[k][s], self.triangles[k][(s + 1) % 3]];
        let third = |t: &[usize; 3]| (0..3).find(|&i| t[i] == b && t[(i + 1) % 3] == a).map(|i| t[(i + 2) % 3]);
        let (beyond, apex) = self.triangles.iter().enumerate().find_map(|(j, t)| Some((j, third(t)?))).unwrap();
        let corner = self.vertices.len();
        let [from, to] = [a, b].map(|v| self.vertices[v]);
        self.vertices.push(from + (to - from) * random.between(0.1, 0.9));
        self.triangles[beyond] = [b, corner, apex];
        self.triangles.extend([[corner, a, apex], [b, a, corner]]);
    }
}

/// `|x| + |y| + |z| ≤ 1`
fn octahedron() -> Mesh {
    let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    let upper = [[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2]];
    let lower = [[1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]];
    Mesh { vertices: vec![x, y, z, -x, -y, -z], triangles: [upper, lower].concat() }
}

#[test]
fn narrow_triangles_have_no_say_in_where_the_inside_is() {
    for seed in 0..40 {
        let mut random = Random(seed);
        let mut mesh = octahedron();
        for _ in 0..6 {
            mesh.add_corner(&mut random);
        }
        let [inside, outside] = [Side::Inside, Side::Outside].map(|side| mesh.solid(side));
        for _ in 0..200 {
            let point = Vector3::from_fn(|_, _| random.between(-1.2, 1.2));
            let height = point.abs().sum() - 1.0;
            let [within, without] = [&inside, &outside].map(|solid| solid.closest(&point));
            assert_eq!([within.distance > 0.0, without.distance > 0.0], [height < 0.0, height > 0.0], "{seed} {point}");
            for seen in [within, without] {
                assert!(seen.normal.dot(&(point - seen.point)) * seen.distance > 0.0, "{seed} {point} {seen:?}");
            }
            // the distance is that from a plane, if the foot lies in a face
            if height < 0.0 {
                assert!((within.distance - height.abs() / 3.0_f64.sqrt()).abs() < 1e-15, "{seed} {point} {within:?}");
            }
        }
    }
}

#[test]
fn paths_meet_faces_that_narrow_triangles_divide_where_the_faces_are() {
    for seed in 0..40 {
        let mut random = Random(seed);
        let mut mesh = octahedron();
        for _ in 0..6 {
            mesh.add_corner(&mut random);
        }
        let inside = mesh.solid(Side::Inside);
        for _ in 0..200 {
            let [point, velocity] = [0.3, 1.0].map(|size| Vector3::from_fn(|_, _| random.between(-size, size)));
            let hit = inside.first_hit(&Line { point, velocity }).unwrap();
            let leaves = |k: usize| {
                let outwards = Vector3::from_fn(|i, _| if k >> i & 1 == 1 { 1.0 } else { -1.0 });
                (1.0 - outwards.dot(&point)) / outwards.dot(&velocity)
            };
            let time = (0..8).map(leaves).filter(|time| *time > 0.0).fold(f64::INFINITY, f64::min);
            assert!((hit.time - time).abs() < 1e-13 * time, "{seed} {point} {velocity} {hit:?} {time}");
        }
    }
}
