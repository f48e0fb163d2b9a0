//! A random strict law at each hit.

use crate::{Contact, Error, Roughness, StrictLaw, random::gaussian};
use nalgebra::SVector;
use rand_chacha::{ChaCha8Rng, rand_core::SeedableRng};

/// A point of `Gr(k, ν⊥)` drawn at each hit, uniformly: its distribution is the Haar measure.
///
/// The draw is a function of the seed and the contact (point and surface, to the last bit) and of nothing else. So runs
/// repeat exactly, in any order and on any number of threads, and an orbit that returns to the very same point meets the same
/// directions there: a frozen disorder of the boundary, hence a field of strict laws, which preserves the canonical measure.
/// The velocity has no part in it: directions that depend on the velocity do not preserve the measure.
///
/// ```
/// use collision_laws::{Contact, StrictLaw, laws::RandomGrassmannian};
/// use nalgebra::Vector3;
///
/// let law = RandomGrassmannian::<3>::new(1, 42)?;
/// let at = |x| Contact::new(Vector3::new(x, 0.0, 0.0), Vector3::z(), 0).map(|contact| law.roughness(&contact));
/// assert_eq!(at(0.5)?, at(0.5)?);
/// assert_ne!(at(0.5)?, at(0.25)?);
/// # Ok::<(), collision_laws::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RandomGrassmannian<const N: usize> {
    rank: usize,
    seed: u64,
}

impl<const N: usize> RandomGrassmannian<N> {
    /// The law of `rank` = k random rough directions.
    ///
    /// # Errors
    /// [`Error::TooManyRoughDirections`] if k > N−1.
    pub fn new(rank: usize, seed: u64) -> Result<Self, Error> {
        if rank >= N {
            return Err(Error::TooManyRoughDirections { given: rank, most: N - 1 });
        }
        Ok(Self { rank, seed })
    }

    /// The stream of random numbers of one contact.
    fn stream(&self, contact: &Contact<N>) -> ChaCha8Rng {
        let mut words = [self.seed, contact.surface as u64, 0, 0];
        for (i, x) in contact.point.iter().enumerate() {
            let x = x + 0.0; // −0 and 0 are one point
            words[2 + i % 2] = mix(words[2 + i % 2] ^ x.to_bits()).wrapping_add(i as u64);
        }
        let mut key = [0; 32];
        for (bytes, word) in key.chunks_exact_mut(8).zip(words) {
            bytes.copy_from_slice(&word.to_le_bytes());
        }
        ChaCha8Rng::from_seed(key)
    }
}

impl<const N: usize> StrictLaw<N> for RandomGrassmannian<N> {
    fn roughness(&self, contact: &Contact<N>) -> Roughness<N> {
        if self.rank == 0 || self.rank + 1 == N {
            return if self.rank == 0 { Roughness::Smooth } else { Roughness::Rough };
        }
        let mut stream = self.stream(contact);
        // normal coordinates: the distribution is invariant under rotations, hence Haar after projection and on the span
        let directions: [SVector<f64, N>; N] = std::array::from_fn(|_| SVector::from_fn(|_, _| gaussian(&mut stream)));
        Roughness::of_span(&contact.normal, &directions[..self.rank])
    }
}

/// The finaliser of `SplitMix64`: every input bit moves every output bit.
fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix4, Vector4};

    #[test]
    fn the_mean_projector_is_that_of_the_haar_measure() {
        // By invariance E P = k/(N−1) · (1 − ννᵀ). Entries of P lie in [−1, 1]; with 40 000 draws the standard error of each
        // mean is below 0.5/200 = 2.5e-3: 5 of them bound all 16 entries with a false alarm below 1e-5; the seed is fixed.
        let law = RandomGrassmannian::<4>::new(2, 7).unwrap();
        let normal = Vector4::new(1.0, -2.0, 0.5, 3.0);
        let mut mean = Matrix4::zeros();
        let mut contact = Contact::new(Vector4::zeros(), normal, 0).unwrap();
        let draws = 40_000;
        for i in 0..draws {
            contact.point.x = f64::from(i);
            mean += law.roughness(&contact).projector(&contact.normal) / f64::from(draws);
        }
        let expected = Roughness::Rough.projector(&contact.normal) * (2.0 / 3.0);
        approx::assert_abs_diff_eq!(mean, expected, epsilon = 1.25e-2);
    }

    #[test]
    fn seed_point_and_surface_all_count() {
        let draw = |seed, x: f64, surface| {
            let contact = Contact::new(Vector4::new(x, 0.0, 0.0, 1.0), Vector4::x(), surface).unwrap();
            RandomGrassmannian::<4>::new(1, seed).unwrap().roughness(&contact)
        };
        let base = draw(1, 0.5, 0);
        assert!(base != draw(2, 0.5, 0) && base != draw(1, 0.75, 0) && base != draw(1, 0.5, 1));
        assert_eq!(draw(1, 0.0, 0), draw(1, -0.0, 0));
    }

    #[test]
    fn no_direction_is_specular_and_all_of_them_are_no_slip() {
        let contact = Contact::new(Vector4::new(0.5, 0.0, 0.0, 1.0), Vector4::new(1.0, -2.0, 0.5, 3.0), 0).unwrap();
        let drawn = |rank| RandomGrassmannian::<4>::new(rank, 7).unwrap().roughness(&contact);
        assert_eq!([drawn(0), drawn(3)], [Roughness::Smooth, Roughness::Rough]);
        assert_eq!([drawn(1).rank(), drawn(2).rank()], [1, 2]);
    }

    #[test]
    fn every_input_bit_moves_every_output_bit() {
        for bit in 0..64 {
            let moved = (0..64_u64).map(|z| mix(mix(z)) ^ mix(mix(z) ^ (1 << bit))).fold(0, std::ops::BitOr::bitor);
            assert_eq!(moved, u64::MAX, "bit {bit}");
        }
    }

    #[test]
    fn no_more_directions_than_the_contact_plane_has_dimensions() {
        assert!(RandomGrassmannian::<4>::new(3, 0).is_ok());
        for rank in [4, usize::MAX] {
            let refused = RandomGrassmannian::<4>::new(rank, 0).unwrap_err();
            assert_eq!(refused, Error::TooManyRoughDirections { given: rank, most: 3 });
        }
    }
}
