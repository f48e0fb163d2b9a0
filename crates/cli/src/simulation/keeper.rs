//! The energy, kept where the law keeps it.

use billiards::geometry::WallHit;
use billiards::{Arrived, Conserved, EnergyKeeper, InLanes, Keeping, Recurring};
use lanes::{Double, Lane};

/// Keeps the energy where the law does, in lanes of `F`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Keeper<const N: usize, F = f64> {
    conserved: Conserved<F, N>,
    strict: bool,
}

impl<const N: usize> Keeper<N> {
    /// For an orbit that starts like this, under a law that is `strict` or not.
    pub(crate) fn for_law<const S: usize>(strict: bool, velocity: &[f64; N], spin: &[f64; S]) -> Self {
        Keeper { strict, ..EnergyKeeper::<f64, N, S>::new(velocity, spin) }
    }
}

impl<F: Lane, const N: usize, const S: usize> EnergyKeeper<F, N, S> for Keeper<N, F> {
    #[inline(always)]
    fn new(velocity: &[F; N], spin: &[F; S]) -> Self {
        Keeper { conserved: EnergyKeeper::<F, N, S>::new(velocity, spin), strict: true }
    }
    #[inline(always)]
    fn owed(&self, velocity: &[F; N], spin: &[F; S]) -> F {
        if self.strict { self.conserved.owed(velocity, spin) } else { velocity[0].same(0.0) }
    }
    #[inline(always)]
    fn rounded_off(&self, owed: F) -> F {
        EnergyKeeper::<F, N, S>::rounded_off(&self.conserved, owed)
    }
    #[inline(always)]
    fn leave(&mut self, velocity: &mut [F; N], hit: &WallHit<F, N>, arrived: &Arrived<F>) {
        if self.strict {
            EnergyKeeper::<F, N, S>::leave(&mut self.conserved, velocity, hit, arrived);
        }
    }
    #[inline(always)]
    fn leave_along(&mut self, velocity: &mut [F; N], spin: &mut [F; S], hit: &WallHit<F, N>, arrived: &Arrived<F>) {
        if self.strict {
            self.conserved.leave_along(velocity, spin, hit, arrived);
        }
    }
    #[inline(always)]
    fn straighten(&mut self, velocity: &mut [F; N], hit: &WallHit<F, N>, arrived: &Arrived<F>) {
        if self.strict {
            EnergyKeeper::<F, N, S>::straighten(&mut self.conserved, velocity, hit, arrived);
        }
    }
    #[inline(always)]
    fn leave_in_frame(&mut self, velocity: &mut [F; N], spin: &mut [F; S], owed: F) {
        if self.strict {
            self.conserved.leave_in_frame(velocity, spin, owed);
        }
    }
    #[inline(always)]
    fn lack(&self, velocity: &[F; N], spin: &[F; S]) -> F {
        if self.strict { self.conserved.lack(velocity, spin) } else { velocity[0].same(0.0) }
    }
    fn square(&self, lane: usize) -> Option<Double> {
        if self.strict { EnergyKeeper::<F, N, S>::square(&self.conserved, lane) } else { None }
    }
    #[inline(always)]
    fn pass(&mut self) {
        if self.strict {
            EnergyKeeper::<F, N, S>::pass(&mut self.conserved);
        }
    }
    fn recurring(&mut self) -> Option<&mut Recurring<F>> {
        if self.strict { EnergyKeeper::<F, N, S>::recurring(&mut self.conserved) } else { None }
    }
}

impl<F: Lane, const N: usize> InLanes<F> for Keeper<N, F> {
    type One = Keeper<N>;
    fn one(&self, lane: usize) -> Keeper<N> {
        Keeper { conserved: self.conserved.one(lane), strict: self.strict }
    }
    fn all(one: &Keeper<N>, zero: F) -> Self {
        Keeper { conserved: Conserved::all(&one.conserved, zero), strict: one.strict }
    }
    fn put(&mut self, lane: usize, one: &Keeper<N>) {
        self.conserved.put(lane, &one.conserved);
    }
    fn wait(&self, one: &Keeper<N>) -> u64 {
        self.conserved.wait(&one.conserved)
    }
}

impl<const N: usize, const S: usize> Keeping<N, S> for Keeper<N> {
    type In<F: Lane> = Keeper<N, F>;
}
