//! Where the centre of a ball can be that moves inside or around a shape: the shape's parallel body, again a shape.
use super::SolidSpec;
use crate::{Error, parry::Side};

impl SolidSpec {
    /// The shape whose surface lies at a distance \[L\] from this one's, on the given side, and by what it is to be moved: the table of
    /// the centre of a ball with that radius, where this is the table of the ball.
    ///
    /// Around a shape it is rounded by so much more. Inside, the rounding is used up first, and then the core shrinks.
    ///
    /// # Errors
    /// [`Error::NothingLeft`] where no such ball fits in, [`Error::Shape`] for meshes and for the inside of convex hulls with less
    /// rounding: their parallel bodies are none of these shapes.
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
                // the same cone, smaller about that ball's centre
                let left = (largest - by) / largest;
                (*radius, *height) = (r * left, h * left);
                shift[2] = by * (1.0 - 0.5 * h / largest);
            }
            SolidSpec::ConvexHull { rounding, .. } if distance < *rounding => *rounding -= distance,
            SolidSpec::ConvexHull { .. } => {
                let why = "a ball moves inside of a convex hull only where that is rounded by more than its radius";
                return Err(Error::Shape { shape: "convex hull", why });
            }
            SolidSpec::TriMesh { .. } => {
                let why =
                    "for balls of positive radius there are no triangle meshes, since what is parallel to one is none";
                return Err(Error::Shape { shape: "triangle mesh", why });
            }
        }
        Ok((spec, shift))
    }
}

/// What is left of a radius.
fn less(radius: f64, distance: f64) -> Result<f64, Error> {
    if distance < radius {
        Ok(radius - distance)
    } else {
        Err(Error::NothingLeft { radius: distance, largest: radius })
    }
}

/// Takes a distance off a rounding; by what the core in which a ball of radius `largest` fits has to shrink besides.
fn eroded(rounding: &mut f64, largest: f64, distance: f64) -> Result<f64, Error> {
    less(*rounding + largest, distance)?;
    let by = (distance - *rounding).max(0.0);
    *rounding = (*rounding - distance).max(0.0);
    Ok(by)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    /// Numbers between −1 and 1.
    fn random(mut seed: u64) -> impl FnMut() -> f64 {
        move || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        }
    }

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
        all
    }

    #[test]
    fn every_point_is_nearer_to_the_parallel_surface_by_the_distance() {
        let distance = 0.2;
        let mut random = random(3);
        for spec in shapes() {
            for side in [Side::Inside, Side::Outside] {
                let Ok((parallel, shift)) = spec.parallel(side, distance) else {
                    assert!(matches!(spec, SolidSpec::ConvexHull { rounding, .. } if rounding < distance), "{spec:?}");
                    assert_eq!(side, Side::Inside);
                    continue;
                };
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
