//! Where the orbits of an ensemble start: each start depends on its number alone.
mod canonical;
mod grid;
mod spatial;

use crate::{EnergyKeeper, Error, Orbit, Track};
pub use canonical::Canonical;
use geometry::Vector2;
pub use grid::Grid;
use rand_chacha::{
    ChaCha8Rng,
    rand_core::{Rng, SeedableRng},
};
pub use spatial::CanonicalSpatial;

/// Where an orbit starts, or has come to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start<const N: usize, const S: usize> {
    /// Position of the centre \[L\].
    pub position: [f64; N],
    /// Velocity of the centre [L T⁻¹].
    pub velocity: [f64; N],
    /// Scaled spin [L T⁻¹].
    pub spin: [f64; S],
}

impl<const N: usize, const S: usize> Start<N, S> {
    /// The orbit that starts here.
    pub fn orbit<K: EnergyKeeper<f64, N, S>, T: Track<f64, N, S>>(self, track: T) -> Orbit<f64, N, S, K, T> {
        Orbit::new(self.position, self.velocity, self.spin, track)
    }
}

/// The starts of an ensemble: each depends on the number of the orbit and on nothing else, not on who runs it or when.
///
/// ```
/// use billiards::{Collisions, Orbit, Planar, Start, Starts, geometry::tables, laws::Specular, observe::Nearest};
///
/// /// Disks from the left focus of the ellipse `x₁²/25 + x₂²/9 = 1`, to all sides.
/// struct Fan;
/// impl Starts<2, 1> for Fan {
///     fn start(&self, i: u64) -> Start<2, 1> {
///         let (sin, cos) = libm::sincos(i as f64); // no direction twice
///         Start { position: [-4.0, 0.0], velocity: [cos, sin], spin: [0.0] }
///     }
/// }
/// let ellipse = Planar { table: tables::ellipse([5.0, 3.0])?, law: Specular };
/// for i in 0..100 {
///     let mut orbit: Orbit<f64, 2, 1> = Fan.start(i).orbit(());
///     ellipse.run(&mut orbit, &Collisions(1), &mut ());
///     let mut focus = Nearest::to([4.0, 0.0], &orbit);
///     ellipse.run(&mut orbit, &Collisions(1), &mut focus);
///     assert!(focus.distance() < 1e-13); // through the right one
/// }
/// # Ok::<(), billiards::Error>(())
/// ```
pub trait Starts<const N: usize, const S: usize>: Sync {
    /// The start of orbit number `i`: the same whenever it is asked for, in any order.
    fn start(&self, i: u64) -> Start<N, S>;
}

/// The random numbers of one orbit: a stream of its own.
fn stream(seed: u64, i: u64) -> ChaCha8Rng {
    let mut stream = ChaCha8Rng::seed_from_u64(seed);
    stream.set_stream(i);
    stream
}

/// Uniform on [0, 1), in steps of 2⁻⁵³.
fn uniform(stream: &mut ChaCha8Rng) -> f64 {
    (stream.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

/// Uniform in the open unit ball of ℝᴺ: points of the cube until one lies in it.
fn in_unit_ball<const N: usize>(stream: &mut ChaCha8Rng) -> [f64; N] {
    loop {
        let point = [0.0; N].map(|_| 2.0 * uniform(stream) - 1.0);
        if point.iter().map(|x| x * x).sum::<f64>() < 1.0 {
            return point;
        }
    }
}

fn checked(speed: f64) -> Result<f64, Error> {
    if speed > 0.0 && speed.is_finite() { Ok(speed) } else { Err(Error::Speed { speed }) }
}

/// The start right after a collision, with `spin` and tangential velocity `vₜ` as fractions of the speed.
fn leaving<const S: usize>(
    point: Vector2<f64>,
    normal: Vector2<f64>,
    spin: [f64; S],
    vt: f64,
    speed: f64,
) -> Start<2, S> {
    let vn = (1.0 - (spin.iter().map(|v0| v0 * v0).sum::<f64>() + vt * vt)).max(0.0).sqrt();
    let velocity = (normal * vn + Vector2::new(-normal.y, normal.x) * vt) * speed;
    Start { position: point.into(), velocity: velocity.into(), spin: spin.map(|v0| v0 * speed) }
}
