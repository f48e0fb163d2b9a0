//! Random starts: one `ChaCha` stream per sample.
use core::f64::consts::TAU;
use rand_chacha::{
    ChaCha8Rng,
    rand_core::{Rng, SeedableRng},
};

/// The random numbers of one sample: a function of the claim's seed and the sample's number.
#[derive(Clone, Debug)]
pub(crate) struct Stream(ChaCha8Rng);

impl Stream {
    pub(crate) fn new(seed: u64, sample: usize) -> Stream {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(sample as u64);
        Stream(rng)
    }

    /// Uniform on [0, 1), in steps of 2⁻⁵³.
    pub(crate) fn uniform(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform on [a, b).
    pub(crate) fn between(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * self.uniform()
    }

    /// Uniform in the unit disk: the velocities `(v₀, vₜ)` of the canonical measure, at unit speed.
    pub(crate) fn in_disk(&mut self) -> [f64; 2] {
        loop {
            let [x, y] = [self.between(-1.0, 1.0), self.between(-1.0, 1.0)];
            if x * x + y * y < 1.0 {
                return [x, y];
            }
        }
    }

    /// Uniform on the unit sphere.
    pub(crate) fn on_sphere(&mut self) -> [f64; 3] {
        let z = self.between(-1.0, 1.0); // Archimedes
        let (angle, r) = (self.between(0.0, TAU), libm::sqrt((1.0 - z) * (1.0 + z)));
        [z, r * libm::cos(angle), r * libm::sin(angle)]
    }
}
