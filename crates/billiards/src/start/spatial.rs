//! The canonical measure of a table in space.
use super::{Start, Starts, checked, in_unit_ball, stream, uniform};
use crate::Error;
use geometry::{Surface, Vector3};

/// The canonical measure of a ball on a table in space: position uniform by area on the boundary, tangential velocities
/// `(vₜ, W)/speed` uniform in the unit ball of ℝ⁵, velocity into the table; for a point, which has no spin, `vₜ/speed` uniform in the
/// unit disk.
///
/// The infinite slab looks the same everywhere: there the positions fill a square as wide as the slab is high.
#[derive(Clone, Debug)]
pub struct CanonicalSpatial<B, const S: usize = 3> {
    boundary: B,
    speed: f64,
    seed: u64,
}

impl<B: Surface> CanonicalSpatial<B> {
    /// Starts on a `boundary`, such as a [named table](geometry::tables::SpatialTable) or the [surface](geometry::parry::Room::surface)
    /// of a room, at `speed` \[L T⁻¹\], spin included.
    ///
    /// # Errors
    /// [`Error::Speed`] unless the speed is positive and finite.
    pub fn new(boundary: B, speed: f64, seed: u64) -> Result<Self, Error> {
        Ok(CanonicalSpatial { boundary, speed: checked(speed)?, seed })
    }
}

impl<B: Surface> CanonicalSpatial<B, 0> {
    /// Starts of points, otherwise as [`new`](CanonicalSpatial::new).
    ///
    /// # Errors
    /// [`Error::Speed`] unless the speed is positive and finite.
    pub fn of_points(boundary: B, speed: f64, seed: u64) -> Result<Self, Error> {
        Ok(CanonicalSpatial { boundary, speed: checked(speed)?, seed })
    }
}

impl<B: Surface> Starts<3, 3> for CanonicalSpatial<B> {
    fn start(&self, i: u64) -> Start<3, 3> {
        let mut stream = stream(self.seed, i);
        let (point, normal) = self.boundary.random_point(&mut || uniform(&mut stream));
        let [a, b, w @ ..] = in_unit_ball::<5>(&mut stream);
        leaving(&point, &normal, [a, b], w, self.speed)
    }
}

impl<B: Surface> Starts<3, 0> for CanonicalSpatial<B, 0> {
    fn start(&self, i: u64) -> Start<3, 0> {
        let mut stream = stream(self.seed, i);
        let (point, normal) = self.boundary.random_point(&mut || uniform(&mut stream));
        leaving(&point, &normal, in_unit_ball(&mut stream), [], self.speed)
    }
}

/// The start right after a collision, with tangential velocity and spin as fractions of the speed.
fn leaving<const S: usize>(
    point: &Vector3<f64>,
    normal: &Vector3<f64>,
    [a, b]: [f64; 2],
    spin: [f64; S],
    speed: f64,
) -> Start<3, S> {
    let [t1, t2] = tangents(normal);
    let vn = (1.0 - [a, b].iter().chain(&spin).map(|x| x * x).sum::<f64>()).max(0.0).sqrt();
    let velocity = (normal * vn + t1 * a + t2 * b) * speed;
    Start { position: (*point).into(), velocity: velocity.into(), spin: spin.map(|w| w * speed) }
}

/// Two unit vectors that make an orthonormal frame with the unit vector `n`.
fn tangents(n: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let across = if n.x.abs() < 0.5 { Vector3::x() } else { Vector3::y() };
    let t = n.cross(&across);
    let t = t / t.norm();
    [t, n.cross(&t)]
}
