//! Where the centre of a ball that moves inside or around a shape can be: bounded by the shape's parallel body, again a shape.
use super::SolidSpec;
use crate::{Error, parry::Side};

impl SolidSpec {
    /// The shape whose surface lies at a distance \[L\] from this one's, on the given side, and the translation to apply to it: it
    /// bounds the table for the centre of a ball of that radius, where this shape bounds the table of the ball.
    ///
    /// Outside, the rounding grows by the distance. Inside, the rounding is used up first, and then the core shrinks; the core of
    /// a convex hull becomes a mesh, and meshes get a margin ([`Solid::kept_off`](crate::parry::Solid::kept_off)).
    ///
    /// # Errors
    /// [`Error::NothingLeft`] where no such ball fits in, except for meshes and hulls, for which that is not known;
    /// [`Error::Field`] for points that do not span a hull.
    ///
    /// ```
    /// use geometry::parry::{Side, SolidSpec};
    /// let brick = SolidSpec::Cuboid { size: [4.0, 3.0, 2.0], rounding: 0.25 };
    /// let around = SolidSpec::Cuboid { size: [4.0, 3.0, 2.0], rounding: 0.75 };
    /// let inside = SolidSpec::Cuboid { size: [3.5, 2.5, 1.5], rounding: 0.0 };
    /// assert_eq!(brick.parallel(Side::Outside, 0.5)?, (around, [0.0; 3]));
    /// assert_eq!(brick.parallel(Side::Inside, 0.5)?, (inside, [0.0; 3]));
    /// # Ok::<(), geometry::Error>(())
    /// ```
    pub fn parallel(&self, side: Side, distance: f64) -> Result<(SolidSpec, [f64; 3]), Error> {
        let outside = side == Side::Outside;
        let mut shift = [0.0; 3];
        let mut spec = self.clone();
        match &mut spec {
            _ if distance == 0.0 => {}
            SolidSpec::Ball { radius } | SolidSpec::Capsule { radius, .. } => {
                *radius = if outside { *radius + distance } else { less(*radius, distance)? };
            }
            SolidSpec::HalfSpace { normal } => {
                let length = libm::hypot(libm::hypot(normal[0], normal[1]), normal[2]);
                shift = normal.map(|n| if outside { distance } else { -distance } * (n / length));
            }
            SolidSpec::Cuboid { rounding, .. }
            | SolidSpec::Cylinder { rounding, .. }
            | SolidSpec::Cone { rounding, .. }
            | SolidSpec::ConvexHull { rounding, .. }
                if outside =>
            {
                *rounding += distance;
            }
            SolidSpec::Cuboid { size, rounding } => {
                let least = size.iter().copied().fold(f64::INFINITY, f64::min);
                let by = eroded(rounding, 0.5 * least, distance)?;
                *size = size.map(|size| size - 2.0 * by);
            }
            SolidSpec::Cylinder { radius, height, rounding } => {
                let by = eroded(rounding, radius.min(0.5 * *height), distance)?;
                (*radius, *height) = (*radius - by, *height - 2.0 * by);
            }
            SolidSpec::Cone { radius, height, rounding } => {
                let (r, h) = (*radius, *height);
                let slope = libm::hypot(r, h);
                // the ball that touches base and lateral surface
                let largest = r * h / (r + slope);
                let by = eroded(rounding, largest, distance)?;
                // the same cone, scaled down about that ball's centre
                let left = (largest - by) / largest;
                (*radius, *height) = (r * left, h * left);
                shift[2] = by * (1.0 - 0.5 * h / largest);
            }
            SolidSpec::ConvexHull { rounding, .. } if distance <= *rounding => *rounding -= distance,
            SolidSpec::ConvexHull { points, rounding } => {
                let hull = super::hull(points)?;
                spec = SolidSpec::TriMesh {
                    vertices: hull.corners.iter().map(|p| (*p).into()).collect(),
                    triangles: hull.triangles(),
                    margin: distance - *rounding,
                };
            }
            SolidSpec::TriMesh { margin, .. } => *margin += distance,
        }
        Ok((spec, shift))
    }
}

/// A radius reduced by a distance.
fn less(radius: f64, distance: f64) -> Result<f64, Error> {
    if distance < radius {
        Ok(radius - distance)
    } else {
        Err(Error::NothingLeft { radius: distance, largest: radius })
    }
}

/// Reduces a rounding by a distance; returns the rest, by which the core, in which a ball of radius `largest` fits, has to shrink.
fn eroded(rounding: &mut f64, largest: f64, distance: f64) -> Result<f64, Error> {
    less(*rounding + largest, distance)?;
    let by = (distance - *rounding).max(0.0);
    *rounding = (*rounding - distance).max(0.0);
    Ok(by)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Boundary, Line, random};
    use nalgebra::Vector3;

    fn shapes() -> Vec<SolidSpec> {
        let hull = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.1], [0.0, 1.1, 0.0], [0.1, 0.0, 1.2], [0.9, 0.8, 0.7]];
        let mut all = vec![
            SolidSpec::Ball { radius: 0.9 },
            SolidSpec::Capsule { from: [-0.2, 0.1, 0.0], to: [0.4, 0.3, 0.2], radius: 0.7 },
            SolidSpec::HalfSpace { normal: [0.2, -0.7, 3.0] },
        ];
        for rounding in [0.0, 0.1, 0.3] {
            all.push(SolidSpec::Cuboid { size: [1.2, 1.7, 0.9], rounding });
            all.push(SolidSpec::Cylinder { radius: 0.8, height: 1.1, rounding });
            all.push(SolidSpec::Cone { radius: 1.3, height: 1.9, rounding });
            all.push(SolidSpec::ConvexHull { points: hull.clone(), rounding });
        }
        // a cube with a pyramid cut out of its top
        let vertices = (0..8).map(|k| [0, 1, 2].map(|i| if k >> i & 1 == 1 { 0.8 } else { -0.8 }));
        let vertices = vertices.chain([[0.1, 0.0, -0.2]]).collect();
        let sides = [[0, 2, 3, 1], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let dent = [[4, 5, 8], [5, 7, 8], [7, 6, 8], [6, 4, 8]];
        let triangles = sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).chain(dent).collect();
        all.push(SolidSpec::TriMesh { vertices, triangles, margin: 0.0 });
        all
    }

    #[test]
    fn every_point_is_nearer_to_the_parallel_surface_by_the_distance() {
        let distance = 0.1;
        let mut random = random::signed(3);
        for spec in shapes() {
            for side in [Side::Inside, Side::Outside] {
                let (parallel, shift) = spec.parallel(side, distance).unwrap();
                let (table, centres) = (spec.solid([0.0; 3], side).unwrap(), parallel.solid(shift, side).unwrap());
                let mut inside = 0;
                for _ in 0..20_000 {
                    let point = Vector3::from_fn(|_, _| 1.5 * random());
                    let [far, near] = [&table, &centres].map(|solid| solid.distance(&point));
                    assert_eq!(far > distance, near > 0.0, "{spec:?} {side:?} {point:?}");
                    if near > 0.0 {
                        inside += 1;
                        // parry's own projections
                        assert!((far - distance - near).abs() < 1e-12, "{spec:?} {side:?} {point:?}");
                    }
                }
                assert!(inside > 100, "{spec:?} {side:?} {inside}");
            }
        }
    }

    #[test]
    fn a_path_ends_where_the_ball_first_touches() {
        let distance = 0.1;
        let mut random = random::signed(7);
        for spec in shapes() {
            for side in [Side::Inside, Side::Outside] {
                let (parallel, shift) = spec.parallel(side, distance).unwrap();
                let (table, centres) = (spec.solid([0.0; 3], side).unwrap(), parallel.solid(shift, side).unwrap());
                let (mut hits, mut corners) = (0, 0);
                for _ in 0..6000 {
                    let point = Vector3::from_fn(|_, _| 1.5 * random());
                    let velocity = Vector3::from_fn(|_, _| random());
                    let path = Line { point, velocity };
                    if table.distance(&point) <= distance {
                        continue;
                    }
                    let hit = centres.first_hit(&path);
                    let end = hit.map_or(8.0, |hit| hit.time);
                    for k in 0..50 {
                        let before = path.at(end * f64::from(k) / 50.0);
                        assert!(table.distance(&before) > distance - 1e-12, "{spec:?} {side:?} {path:?}");
                    }
                    let Some(hit) = hit else { continue };
                    let touched = table.closest(&hit.point);
                    assert!((touched.distance - distance).abs() < 1e-12, "{spec:?} {side:?} {path:?}");
                    assert!((touched.normal - hit.normal).norm() < 1e-11, "{spec:?} {side:?} {path:?}");
                    assert!((path.at(hit.time) - hit.point).norm() < 1e-12, "{spec:?} {side:?} {path:?}");
                    hits += 1;
                    corners += usize::from(hit.corner);
                }
                assert!(hits > 20 && corners == 0, "{spec:?} {side:?} {hits} {corners}");
            }
        }
    }

    #[test]
    fn a_ball_that_touches_two_triangles_at_once_is_in_a_corner() {
        let box_ = vec![[0.0; 3], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0], [2.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let box_ = SolidSpec::ConvexHull { points: box_, rounding: 0.0 };
        let (parallel, shift) = box_.parallel(Side::Inside, 0.125).unwrap();
        let centres = parallel.solid(shift, Side::Inside).unwrap();
        let aim = |at: [f64; 3]| {
            let point = Vector3::new(0.3, 0.25, 0.2);
            centres.first_hit(&Line { point, velocity: Vector3::from(at) - point }).unwrap()
        };
        assert!(aim([0.125, 0.125, 0.2]).corner);
        assert!(aim([0.3, 0.125, 0.125]).corner);
        assert!(!aim([0.3, 0.125, 0.1251]).corner);
        // next to the diagonal of a face with four corners there is no corner
        assert!(!aim([0.8, 0.4, 0.125]).corner);
    }

    #[test]
    fn a_ball_rolls_from_a_face_over_an_edge_without_a_corner() {
        let points: Vec<_> = (0..8).map(|k| [0, 1, 2].map(|i| f64::from(k >> i & 1))).collect();
        let (parallel, _) = SolidSpec::ConvexHull { points, rounding: 0.0 }.parallel(Side::Inside, 0.125).unwrap();
        // the same triangles from outside
        let around = parallel.solid([0.0; 3], Side::Outside).unwrap();
        for exponent in 0..60 {
            for sign in [-1.0, 1.0] {
                let beside = sign * libm::ldexp(0.5, -exponent);
                let path = Line { point: Vector3::new(1.0 + beside, 0.3, 2.0), velocity: -Vector3::z() };
                let Some(hit) = around.first_hit(&path) else { continue };
                assert!(!hit.corner, "{beside}");
                let lean = beside.max(0.0) / 0.125;
                assert!((hit.normal.x - lean).abs() < 1e-15, "{beside} {hit:?}");
            }
        }
    }

    #[test]
    fn a_ball_that_does_not_fit_is_told_what_does() {
        let largest = |spec: SolidSpec| match spec.parallel(Side::Inside, 2.0) {
            Err(Error::NothingLeft { radius: 2.0, largest }) => largest,
            other => panic!("{other:?}"),
        };
        assert_eq!(largest(SolidSpec::Ball { radius: 2.0 }), 2.0);
        assert_eq!(largest(SolidSpec::Cuboid { size: [9.0, 2.0, 4.0], rounding: 0.5 }), 1.5);
        assert_eq!(largest(SolidSpec::Cylinder { radius: 1.5, height: 4.0, rounding: 0.0 }), 1.5);
        // 3-4-5
        assert_eq!(largest(SolidSpec::Cone { radius: 3.0, height: 4.0, rounding: 0.25 }), 1.75);
    }
}
