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

#[cfg(test)]
mod tests {
    use super::*;
    use rand_chacha::rand_core::SeedableRng;

    #[test]
    fn a_normal_number_has_the_moments_of_one() {
        let mut stream = ChaCha8Rng::seed_from_u64(1);
        let draws = 40_000_u32;
        let mut moments = [0.0; 4];
        for _ in 0..draws {
            let x = gaussian(&mut stream);
            for (k, moment) in (1..=4).zip(&mut moments) {
                *moment += libm::pow(x, f64::from(k)) / f64::from(draws);
            }
        }
        // the variances of x, x², x³, x⁴ are 1, 2, 15, 96; five standard errors bound each mean; the seed is fixed
        for ((found, expected), variance) in
            moments.into_iter().zip([0.0, 1.0, 0.0, 3.0]).zip([1.0, 2.0, 15.0, 96.0_f64])
        {
            assert!((found - expected).abs() <= 5.0 * (variance / f64::from(draws)).sqrt(), "{moments:?}");
        }
    }
}
