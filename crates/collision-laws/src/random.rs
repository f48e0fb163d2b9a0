//! Normal random numbers, the same on every machine.

use rand_chacha::{ChaCha8Rng, rand_core::Rng};

/// A standard normal number (polar method of Marsaglia).
pub(crate) fn gaussian(stream: &mut ChaCha8Rng) -> f64 {
    loop {
        let (x, y) = (symmetric_uniform(stream), symmetric_uniform(stream));
        let square = x * x + y * y;
        if square > 0.0 && square < 1.0 {
            return x * (-2.0 * libm::log(square) / square).sqrt();
        }
    }
}

/// Uniform on [−1, 1), in steps of 2⁻⁵².
fn symmetric_uniform(stream: &mut ChaCha8Rng) -> f64 {
    (stream.next_u64() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}
