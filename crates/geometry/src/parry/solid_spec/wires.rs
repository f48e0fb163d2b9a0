//! What drawings need to know of a shape: its sharp edges, and the point farthest in a direction.
use super::SolidSpec;
use core::f64::consts::TAU;
use nalgebra::Vector3;

/// Points of a circle, the first of which is also the last.
const POINTS: u32 = 256;

impl SolidSpec {
    /// The point \[L\] farthest in a direction, given by a unit vector: for a convex shape, a point of its outline as seen
    /// perpendicular to that direction. `None` for a half-space.
    ///
    /// ```
    /// use geometry::{Vector3, parry::SolidSpec};
    /// let can = SolidSpec::Cylinder { radius: 2.0, height: 1.0, rounding: 0.5 };
    /// assert_eq!(can.farthest(&Vector3::x()).unwrap().x, 2.5);
    /// ```
    pub fn farthest(&self, direction: &Vector3<f64>) -> Option<Vector3<f64>> {
        let d = *direction;
        let among = |points: &[[f64; 3]]| {
            let points = points.iter().map(|p| Vector3::from(*p));
            points.max_by(|a, b| a.dot(&d).total_cmp(&b.dot(&d)))
        };
        let rim = |radius: f64| {
            let across = libm::hypot(d.x, d.y);
            if across > 0.0 { Vector3::new(d.x, d.y, 0.0) * (radius / across) } else { Vector3::zeros() }
        };
        Some(match self {
            SolidSpec::Ball { radius } => d * *radius,
            SolidSpec::Cuboid { size, rounding } => {
                Vector3::from_fn(|i, _| (0.5 * size[i]).copysign(d[i])) + d * *rounding
            }
            SolidSpec::Capsule { from, to, radius } => among(&[*from, *to])? + d * *radius,
            SolidSpec::Cylinder { radius, height, rounding } => {
                rim(*radius) + Vector3::z() * (0.5 * height).copysign(d.z) + d * *rounding
            }
            SolidSpec::Cone { radius, height, rounding } => {
                let (apex, base) = (Vector3::z() * (0.5 * height), rim(*radius) - Vector3::z() * (0.5 * height));
                (if apex.dot(&d) > base.dot(&d) { apex } else { base }) + d * *rounding
            }
            SolidSpec::ConvexHull { points, rounding } => among(points)? + d * *rounding,
            SolidSpec::TriMesh { vertices, margin, .. } => among(vertices)? + d * *margin,
            SolidSpec::HalfSpace { .. } => return None,
        })
    }

    /// Its edges \[L\], as closed chains of points: none for a rounded shape, the sides of all triangles for a mesh
    /// without margin.
    pub fn edges(&self) -> Vec<Vec<Vector3<f64>>> {
        let circle = |radius: f64, z: f64| {
            let at = |k: u32| {
                let (sin, cos) = libm::sincos(TAU * f64::from(k % POINTS) / f64::from(POINTS));
                Vector3::new(radius * cos, radius * sin, z)
            };
            (0..=POINTS).map(at).collect()
        };
        let closed = |mut ring: Vec<Vector3<f64>>| {
            ring.extend(ring.first().copied());
            ring
        };
        match self {
            SolidSpec::Cuboid { size, rounding: 0.0 } => {
                let corner = |k: usize| Vector3::from_fn(|i, _| if k >> i & 1 == 1 { 0.5 } else { -0.5 } * size[i]);
                // floor and ceiling, and two sides
                let rings = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6]];
                rings.map(|ring| closed(ring.map(corner).into())).into()
            }
            SolidSpec::Cylinder { radius, height, rounding: 0.0 } => {
                vec![circle(*radius, -0.5 * height), circle(*radius, 0.5 * height)]
            }
            SolidSpec::Cone { radius, height, rounding: 0.0 } => vec![circle(*radius, -0.5 * height)],
            SolidSpec::ConvexHull { points, rounding: 0.0 } => {
                let hull = super::hull(points);
                hull.map_or_else(|_| vec![], |hull| hull.faces.iter().map(|face| closed(hull.ring(face))).collect())
            }
            SolidSpec::TriMesh { vertices, triangles, margin: 0.0 } => {
                let triangles = triangles.iter().filter(|t| t.iter().all(|v| *v < vertices.len()));
                triangles.map(|t| closed(t.map(|v| vertices[v].into()).into())).collect()
            }
            SolidSpec::Ball { .. }
            | SolidSpec::Capsule { .. }
            | SolidSpec::HalfSpace { .. }
            // rounded
            | SolidSpec::Cuboid { .. }
            | SolidSpec::Cylinder { .. }
            | SolidSpec::Cone { .. }
            | SolidSpec::ConvexHull { .. }
            | SolidSpec::TriMesh { .. } => vec![],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parry::Side;

    /// The lengths of the parts of closed chains, each part once.
    fn lengths(spec: &SolidSpec) -> Vec<f64> {
        let mut seen = std::collections::HashSet::new();
        let mut all = vec![];
        for chain in spec.edges() {
            assert_eq!(chain.first(), chain.last(), "{spec:?}");
            for w in chain.windows(2) {
                let mut ends = [w[0], w[1]].map(crate::plane::key::<3>);
                ends.sort_unstable();
                if seen.insert(ends) {
                    all.push((w[1] - w[0]).norm());
                }
            }
        }
        all.sort_by(f64::total_cmp);
        all
    }

    #[test]
    fn the_edges_of_a_box_are_four_along_each_axis() {
        let size = [1.25, 1.75, 0.5];
        let found = lengths(&SolidSpec::Cuboid { size, rounding: 0.0 });
        assert_eq!(found, [[0.5; 4], [1.25; 4], [1.75; 4]].concat());
        assert!(SolidSpec::Cuboid { size, rounding: 0.1 }.edges().is_empty());
    }

    #[test]
    fn the_edges_of_cylinders_and_cones_are_circles() {
        let (radius, height) = (0.8, 1.1);
        let around = |spec: SolidSpec, circles: usize| {
            let found = lengths(&spec);
            assert_eq!((spec.edges().len(), found.len()), (circles, circles * POINTS as usize), "{spec:?}");
            // all as long as the sides of a regular polygon
            let side = 2.0 * radius * libm::sin(0.5 * TAU / f64::from(POINTS));
            assert!(found.iter().all(|length| (length - side).abs() < 1e-15), "{spec:?}");
        };
        around(SolidSpec::Cylinder { radius, height, rounding: 0.0 }, 2);
        around(SolidSpec::Cone { radius, height, rounding: 0.0 }, 1);
        let base = SolidSpec::Cone { radius, height, rounding: 0.0 }.edges();
        assert!(base.iter().flatten().all(|p| p.z == -0.5 * height));
    }

    #[test]
    fn what_is_farthest_is_on_the_surface_and_no_other_point_is_farther() {
        let points = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.1], [0.0, 1.1, 0.0], [0.1, 0.0, 1.2]];
        let capsule = SolidSpec::Capsule { from: [-0.2, 0.1, 0.0], to: [0.4, 0.3, 0.2], radius: 0.7 };
        let mut all = vec![SolidSpec::Ball { radius: 0.9 }, capsule];
        for rounding in [0.0, 0.25] {
            all.push(SolidSpec::Cuboid { size: [1.2, 1.7, 0.9], rounding });
            all.push(SolidSpec::Cylinder { radius: 0.8, height: 1.1, rounding });
            all.push(SolidSpec::Cone { radius: 1.3, height: 1.9, rounding });
            all.push(SolidSpec::ConvexHull { points: points.clone(), rounding });
        }
        for spec in all {
            let solid = spec.solid([0.0; 3], Side::Outside).unwrap();
            for k in 0..60 {
                let (sin, cos) = libm::sincos(0.1 + TAU * f64::from(k) / 60.0);
                let d = Vector3::new(0.6 * cos, sin, 0.8 * cos);
                let farthest = spec.farthest(&d).unwrap();
                assert!(solid.distance(&farthest).abs() < 1e-12, "{spec:?} {d:?}");
                // the plane through it leaves the shape on one side
                assert!((solid.distance(&(farthest + d)) - 1.0).abs() < 1e-12, "{spec:?} {d:?}");
            }
            for point in spec.edges().iter().flatten() {
                assert!(solid.distance(point).abs() < 1e-12, "{spec:?} {point:?}");
            }
        }
    }
}
