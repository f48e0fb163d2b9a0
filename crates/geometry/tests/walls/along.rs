//! Paths that start along round walls, where rounding decides whether they come in or go out.

use super::*;
use geometry::{
    Vector3,
    walls::{Capsule, Cylinder, Sphere},
};

/// Slopes of paths from 1 rounding outwards to 10⁴ inwards.
const SLOPES: [f64; 9] = [0.0, 1e-17, -1e-17, 1e-16, -1e-16, 1e-15, -1e-15, 1e-12, -1e-12];

/// A path starts on a round wall about a centre, this angle along it, almost along the wall: it hits where its time says,
/// within a chord that rises above the wall by two roundings of its radius.
fn lands_on_its_way<const N: usize>(walls: &impl Walls<N>, center: SVector<f64, N>, radius: f64) {
    let chord = 4.0 * (f64::EPSILON).sqrt() * radius;
    for k in 0..400 {
        let angle = 0.015_7 * f64::from(k) - 1.5;
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        let [out, along] = [[cos, sin], [-sin, cos]].map(|[x, y]| {
            let mut of = SVector::zeros();
            (of[0], of[1]) = (x, y);
            of
        });
        for slope in SLOPES {
            for turn in [-1.0, 1.0] {
                let path = Line { point: center + out * radius, velocity: along * turn + out * slope };
                let hit = walls.hit(&path).unwrap();
                let off = (path.at(hit.time) - hit.point).norm();
                assert!(off < chord, "{path:?}: {off:e} off after {:e}", hit.time);
            }
        }
    }
}

#[test]
fn a_path_along_a_round_wall_hits_where_its_time_says() {
    let sphere = Sphere::<2>::new(Vector2::new(0.1, -0.2), 0.7, 0).unwrap();
    lands_on_its_way(&sphere, Vector2::new(0.1, -0.2), 0.7);
    let capsule = Capsule::new(Vector2::zeros(), 1.0, 0.7, [0, 1, 2, 3]).unwrap();
    lands_on_its_way(&capsule, Vector2::new(1.0, 0.0), 0.7);
    let cylinder = Cylinder::new(Vector3::zeros(), Vector3::z(), 0.7, 1.0, 0).unwrap();
    lands_on_its_way(&cylinder, Vector3::zeros(), 0.7);
}
