//! Keeping the energy of long orbits to the last digit.
//!
//! Rounding in a reflection changes the energy by about 10⁻¹⁶ per collision, always in the same direction for the
//! same constants: after 10⁹ collisions 10⁻⁷ would be gone. [`Conserved`] computes the energy of the outgoing velocity
//! with an error of about 2⁻⁷⁵, and hands what is missing to the **normal** component of the next incoming velocity
//! (to the velocity as a whole where it grazes the wall). The correction is one collision late so that it is computed beside the search for the next hit and not after it.
use crate::orbit::square_speed;
use geometry::WallHit;
use lanes::{Lane, Mask};

/// What happens to the energy of an orbit besides the law.
pub trait EnergyKeeper<F: Lane, const N: usize, const S: usize>: Copy {
    /// For an orbit that starts with this velocity and spin.
    fn new(velocity: &[F; N], spin: &[F; S]) -> Self;
    /// Corrects the velocity that arrives at a collision.
    fn arrive(&self, velocity: &mut [F; N]);
    /// Sees the velocity and the spin that leave it.
    fn leave(&mut self, velocity: &[F; N], spin: &[F; S], hit: &WallHit<F, N>);
    /// Takes over the lanes of another keeper where `mask` is true.
    fn replace(&mut self, mask: F::Mask, by: &Self);
}

/// Nothing: for laws that do not conserve energy, and for those who want the bare arithmetic.
pub type Free = ();

impl<F: Lane, const N: usize, const S: usize> EnergyKeeper<F, N, S> for Free {
    #[inline(always)]
    fn new(_: &[F; N], _: &[F; S]) -> Self {}
    #[inline(always)]
    fn arrive(&self, _: &mut [F; N]) {}
    #[inline(always)]
    fn leave(&mut self, _: &[F; N], _: &[F; S], _: &WallHit<F, N>) {}
    fn replace(&mut self, _: F::Mask, (): &Self) {}
}

/// The energy of the start, kept.
#[derive(Clone, Copy, Debug)]
pub struct Conserved<F, const N: usize> {
    /// `3·2²⁵` times a power of two not below the speed: adding and subtracting it rounds to 26 bits.
    grid: F,
    /// `|v|² + |w|²` at the start, as a sum.
    high: F,
    low: F,
    /// A normal speed whose square is below this grazes; a speed below it has next to no energy to correct.
    grazing: F,
    correction: [F; N],
}

/// `|v|² + |w|²` as an exact sum of rounded squares and a small rest.
///
/// Each component is split into a head on a grid of 26 bits, whose square is exact, as are the sums of such squares,
/// and a tail: `x² = head² + tail (x + head)`.
#[inline(always)]
fn precise_square<F: Lane, const N: usize, const S: usize>(grid: F, v: &[F; N], w: &[F; S]) -> (F, F) {
    let zero = grid.same(0.0);
    let (mut high, mut low) = (zero, zero);
    let mut add = |x: F| {
        let head = (x + grid) - grid;
        let tail = x - head;
        high = high + head * head;
        low = low + tail * (x + head);
    };
    for x in v {
        add(*x);
    }
    for x in w {
        add(*x);
    }
    (high, low)
}

impl<F: Lane, const N: usize, const S: usize> EnergyKeeper<F, N, S> for Conserved<F, N> {
    #[inline(always)]
    fn new(velocity: &[F; N], spin: &[F; S]) -> Self {
        let square = square_speed(velocity, spin);
        let grid = square.each(|k| {
            let (_, exponent) = libm::frexp(libm::sqrt(square.lane(k)));
            libm::ldexp(3.0, exponent + 25)
        });
        let (high, low) = precise_square(grid, velocity, spin);
        Conserved { grid, high, low, grazing: square * 1e-3, correction: [grid.same(0.0); N] }
    }
    #[inline(always)]
    fn arrive(&self, velocity: &mut [F; N]) {
        for i in 0..N {
            velocity[i] = velocity[i] + self.correction[i];
        }
    }
    #[inline(always)]
    fn leave(&mut self, velocity: &[F; N], spin: &[F; S], hit: &WallHit<F, N>) {
        let normal = &hit.normal;
        let (mut vn, mut square) = (velocity[0] * normal[0], velocity[0] * velocity[0]);
        for i in 1..N {
            vn = vn + velocity[i] * normal[i];
            square = square + velocity[i] * velocity[i];
        }
        // along the normal; along the velocity where it grazes; not at all where nearly all energy is spin
        let zero = vn.same(0.0);
        let steep = self.grazing.lt(vn * vn * hit.inverse_square);
        let moving = self.grazing.lt(square);
        let share = moving.select(zero.same(0.5), zero) / steep.select(vn, square);
        let (high, low) = precise_square(self.grid, velocity, spin);
        let add = ((self.high - high) + (self.low - low)) * share;
        for i in 0..N {
            self.correction[i] = add * steep.select(normal[i], velocity[i]);
        }
    }
    fn replace(&mut self, mask: F::Mask, by: &Self) {
        self.grid = mask.select(by.grid, self.grid);
        self.high = mask.select(by.high, self.high);
        self.low = mask.select(by.low, self.low);
        self.grazing = mask.select(by.grazing, self.grazing);
        for i in 0..N {
            self.correction[i] = mask.select(by.correction[i], self.correction[i]);
        }
    }
}
