//! Convex polyhedra: the hull of points, exactly.
//!
//! The triangles that bound it are found with exact predicates, whatever the points: many may lie on one face or edge, or nearly
//! coincide. Triangles of one plane are then joined into faces: there, and only there, a rounding tolerance is used.
mod faces;
mod quickhull;

use super::distance::to_unit;
use crate::plane::slack;
use nalgebra::Vector3;

/// A convex polyhedron.
#[derive(Clone, Debug)]
pub(crate) struct Polytope {
    /// Its corners \[L\], in the order in which they were given.
    pub(crate) corners: Vec<Vector3<f64>>,
    /// Its faces, in the order of their rings.
    pub(crate) faces: Vec<Face>,
}

/// A face of a convex polyhedron.
#[derive(Clone, Debug)]
pub(crate) struct Face {
    /// Numbers of its corners, counter-clockwise as seen from outside, the least first.
    pub(crate) ring: Vec<usize>,
    /// Unit normal, outwards.
    pub(crate) normal: Vector3<f64>,
    /// The number of the corner that is farthest out within rounding: all others lie behind the plane through it.
    pub(crate) top: usize,
}

impl Polytope {
    /// The convex hull of finite points; None where these lie in a plane, within the rounding of their coordinates.
    pub(crate) fn hull(points: &[Vector3<f64>]) -> Option<Polytope> {
        let size = points.iter().map(Vector3::amax).fold(0.0, f64::max);
        // a power of two: products neither over- nor underflow, and the scaling is exact
        let unit = to_unit(size);
        let scaled: Vec<Vector3<f64>> = points.iter().map(|p| p * unit).collect();
        let tolerance = slack([size * unit]);
        let mut faces = faces::joined(&scaled, &quickhull::triangles(&scaled)?, tolerance);
        let mut used: Vec<usize> = faces.iter().flat_map(|face| face.ring.iter().copied()).collect();
        used.sort_unstable();
        used.dedup();
        let is_flat =
            |face: &Face| used.iter().all(|&k| face.normal.dot(&(scaled[k] - scaled[face.top])) >= -4.0 * tolerance);
        if faces.len() < 4 || faces.iter().any(is_flat) {
            return None;
        }
        for face in &mut faces {
            for k in face.ring.iter_mut().chain([&mut face.top]) {
                *k = used.partition_point(|u| u < k);
            }
        }
        Some(Polytope { corners: used.iter().map(|&k| points[k]).collect(), faces })
    }

    /// The corners of a face.
    pub(crate) fn ring(&self, face: &Face) -> Vec<Vector3<f64>> {
        face.ring.iter().map(|&k| self.corners[k]).collect()
    }

    /// Its faces in triangles of its corners, counter-clockwise as seen from outside.
    pub(crate) fn triangles(&self) -> Vec<[usize; 3]> {
        self.faces.iter().flat_map(Face::fan).collect()
    }
}

impl Face {
    /// Its sides, from corner to corner.
    pub(crate) fn sides(&self) -> impl Iterator<Item = [usize; 2]> {
        let next = self.ring.iter().cycle().skip(1);
        self.ring.iter().zip(next).map(|(a, b)| [*a, *b])
    }

    /// Triangles with these corners.
    pub(crate) fn fan(&self) -> impl Iterator<Item = [usize; 3]> {
        self.ring[1..].windows(2).map(|side| [self.ring[0], side[0], side[1]])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random;
    use core::f64::consts::TAU;

    fn turned(p: &Vector3<f64>, axis: &Vector3<f64>, angle: f64) -> Vector3<f64> {
        let (sin, cos) = libm::sincos(angle);
        let axis = axis / axis.norm();
        p * cos + axis.cross(p) * sin + axis * (axis.dot(p) * (1.0 - cos))
    }

    /// Checks that the hull is closed, convex, and around all points.
    fn hull(points: &[Vector3<f64>]) -> Polytope {
        let hull = Polytope::hull(points).unwrap();
        let tolerance = slack([points.iter().map(Vector3::amax).fold(0.0, f64::max)]);
        let mut sides = vec![];
        for face in &hull.faces {
            assert!((face.normal.norm() - 1.0).abs() < 1e-15);
            for p in points {
                let out = face.normal.dot(&(p - hull.corners[face.top]));
                assert!(out <= 2.0 * tolerance, "{out:e} in front of {face:?}");
            }
            for corner in hull.ring(face) {
                let off = face.normal.dot(&(corner - hull.corners[face.top]));
                assert!(off.abs() <= 4.0 * tolerance, "{off:e} off {face:?}");
            }
            sides.extend(face.sides());
        }
        let count = sides.len();
        sides.sort_unstable();
        sides.dedup();
        assert_eq!(sides.len(), count, "a side twice");
        assert!(sides.iter().all(|[a, b]| sides.binary_search(&[*b, *a]).is_ok()), "an open side");
        assert_eq!(hull.corners.len() + hull.faces.len(), count / 2 + 2, "Euler");
        assert!(hull.corners.iter().all(|corner| points.contains(corner)));
        hull
    }

    fn cube() -> Vec<Vector3<f64>> {
        (0..8).map(|k| Vector3::from_fn(|i, _| if k >> i & 1 == 1 { 1.0 } else { -1.0 })).collect()
    }

    #[test]
    fn points_on_faces_and_edges_are_no_corners() {
        let lattice = |n: i32| {
            let at = |k: i32, i: usize| f64::from(k / n.pow(u32::try_from(i).unwrap()) % n) / f64::from(n - 1) - 0.5;
            (0..n * n * n).map(|k| Vector3::from_fn(|i, _| at(k, i))).collect::<Vec<_>>()
        };
        let mut random = random::signed(5);
        for n in [3, 4, 7] {
            for k in 0..40 {
                let axis = Vector3::from_fn(|_, _| random());
                let angle = if k == 0 { 0.0 } else { TAU * random() };
                let points: Vec<_> = lattice(n).iter().map(|p| turned(p, &axis, angle)).collect();
                let hull = hull(&points);
                assert_eq!((hull.corners.len(), hull.faces.len()), (8, 6), "{n} {k}");
            }
        }
    }

    #[test]
    fn points_nearly_on_one_another_have_a_hull() {
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Vector3::from);
        let mut random = random::signed(6);
        for exponent in (-17..=-6).chain([-30]) {
            let little = libm::pow(10.0, f64::from(exponent));
            for count in [8, 12, 16, 20, 40] {
                let mut near = |k: usize| corners[k % 4] + Vector3::from_fn(|_, _| little * random());
                let beside: Vec<_> = (0..count).map(&mut near).collect();
                hull(&[&corners[..], &beside].concat());
            }
        }
    }

    #[test]
    fn random_points_on_spheres_disks_lines_and_all_together_have_a_hull() {
        let mut random = random::signed(7);
        for n in [4, 5, 8, 20, 100, 400] {
            for kind in 0..8 {
                let points: Vec<_> = (0..n)
                    .map(|k| {
                        let p = Vector3::from_fn(|_, _| random());
                        match (kind, k % 4) {
                            (0, _) => p,
                            (1, _) => p / p.norm(),
                            // drums, double cones, rods of points on lines
                            (2, _) => Vector3::new(p.x, p.y, p.z.signum()) / libm::hypot(p.x, p.y),
                            (3 | 4, 0) => Vector3::z() * p.z,
                            (3, _) => Vector3::new(p.x, p.y, 0.0) / libm::hypot(p.x, p.y),
                            (4, _) => Vector3::new(p.x.signum(), 0.3 * p.y.signum(), p.z),
                            // coarse coordinates, far away, long
                            (5, _) => p.map(|x| (3.0 * x).round() / 7.0),
                            (6, _) => p + Vector3::new(1e6, 2e6, -1e6),
                            _ => Vector3::new(1e-4 * p.x, 1e-4 * p.y, p.z),
                        }
                    })
                    .collect();
                // few points in a drum, on rods or of coarse coordinates may all lie in a plane
                if n > 8 || !matches!(kind, 2 | 4 | 5) {
                    let axis = Vector3::from_fn(|_, _| random());
                    hull(&points);
                    hull(&points.iter().map(|p| turned(p, &axis, 1.0)).collect::<Vec<_>>());
                }
            }
        }
    }

    #[test]
    fn faces_that_meet_at_a_small_angle_are_two() {
        let mut roof = cube();
        for height in [1e-4, 1e-8, 1e-12] {
            roof.push(Vector3::new(0.0, 0.0, 1.0 + height));
            assert_eq!(hull(&roof).faces.len(), 9, "{height:e}");
            roof.pop();
        }
    }

    #[test]
    fn thin_and_long_hulls_are_what_they_are_and_flat_ones_are_none() {
        for thickness in [5e-4, 1e-8, 1e-12] {
            let plate: Vec<_> = cube().iter().map(|p| p.component_mul(&Vector3::new(1.0, 1.0, thickness))).collect();
            let rod: Vec<_> =
                cube().iter().map(|p| p.component_mul(&Vector3::new(thickness, thickness, 1.0))).collect();
            for points in [plate, rod] {
                for angle in [0.0, 0.7] {
                    let points: Vec<_> =
                        points.iter().map(|p| turned(p, &Vector3::new(1.0, 2.0, 3.0), angle)).collect();
                    let hull = hull(&points);
                    assert!(hull.corners.len() == 8 && (angle > 0.0 || hull.faces.len() == 6), "{thickness:e} {angle}");
                }
            }
        }
        let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]].map(Vector3::from);
        for angle in [0.0, 0.3, 0.7] {
            assert!(Polytope::hull(&square.map(|p| turned(&p, &Vector3::new(1.0, 2.0, 3.0), angle))).is_none());
        }
        assert!(Polytope::hull(&square.map(|p| Vector3::x() * p.x)).is_none());
        assert!(Polytope::hull(&[Vector3::zeros(); 5]).is_none() && Polytope::hull(&[]).is_none());
    }

    #[test]
    fn a_hull_of_any_size_is_the_same() {
        let mut random = random::signed(8);
        let points: Vec<_> = (0..50).map(|_| Vector3::from_fn(|_, _| random())).collect();
        let one = hull(&points);
        for exponent in [-400, 400] {
            let factor = libm::ldexp(1.0, exponent);
            let other = Polytope::hull(&points.iter().map(|p| p * factor).collect::<Vec<_>>()).unwrap();
            for (a, b) in one.faces.iter().zip(&other.faces) {
                assert!(a.ring == b.ring && a.normal == b.normal);
            }
        }
    }
}
