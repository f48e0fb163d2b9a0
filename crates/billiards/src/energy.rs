//! Keeping the energy of long orbits to the last digit.
//!
//! Rounding in a reflection changes the energy by about 10⁻¹⁶ per collision, always in the same direction for the
//! same constants: after 10⁹ collisions 10⁻⁷ would be gone. Every [`BEAT`] collisions, and at each one where walls are
//! [delicate](Walls::is_delicate), [`Conserved`] computes the energy with an error of about 2⁻⁷⁵ and hands what is missing to the
//! **normal** component of the outgoing velocity, from where the law took it (to the velocity as a whole where it grazes
//! the wall). The error of the energy is then that of at most [`BEAT`] collisions, and the work that of a fraction of one.
use crate::{in_lanes::InLanes, recurring::Recurring};
use geometry::WallHit;
#[cfg(doc)]
use geometry::Walls;
use lanes::{Double, Lane, Mask};

/// The energy is restored after so many collisions, but where walls are [delicate](Walls::is_delicate).
///
/// A collision changes it by about 1.5·10⁻¹⁶ at random, so that it is right to about √16 times that, whatever the number
/// of collisions.
pub const BEAT: u32 = 16;

/// What has less than this part of the energy is not corrected by what the energy lacks. So no correction of a velocity is more
/// than ½/√10⁻³ = 16 times the lack.
pub(crate) const LITTLE: f64 = 1e-3;

/// What happens to the energy of an orbit besides the law.
pub trait EnergyKeeper<F: Lane, const N: usize, const S: usize>: Copy {
    /// For an orbit that starts with this velocity and spin.
    fn new(velocity: &[F; N], spin: &[F; S]) -> Self;
    /// Sees the velocity and the spin that leave a collision, and may correct the velocity at every `beat`th.
    fn leave(&mut self, velocity: &mut [F; N], spin: &[F; S], hit: &WallHit<F, N>, beat: u32);
    /// Takes back what the rounded length of the normal, which should be 1, does to the velocity that leaves a collision; before it
    /// the component along the normal was `arrival`.
    fn straighten(&mut self, _velocity: &mut [F; N], _arrival: F, _hit: &WallHit<F, N>) {}
    /// The same as [`leave`](EnergyKeeper::leave) for the components of the velocity along the normal, which comes first, and the tangents. In this frame a
    /// law changes the normal component without rounding, so the others are corrected, and the spin with them.
    fn leave_in_frame(&mut self, velocity: &mut [F; N], spin: &mut [F; S], beat: u32);
    /// What a velocity and a spin lack of `|v|² + |w|²` as it should be, as part of it, to 2⁻⁷⁵; nothing where no energy is kept.
    fn lack(&self, velocity: &[F; N], spin: &[F; S]) -> F;
    /// `|v|² + |w|²` as it should be, in one lane.
    fn square(&self, lane: usize) -> Option<Double>;
    /// Counts a collision that rounds nothing.
    fn pass(&mut self, beat: u32);
    /// What is known of the velocity between round walls besides its energy.
    fn recurring(&mut self) -> Option<&mut Recurring<F>> {
        None
    }
}

/// How the energy of an orbit is kept, with a type for every lane width: [`Conserved`] or [`Free`].
pub trait Keeping<const N: usize, const S: usize>: EnergyKeeper<f64, N, S> {
    /// The keeper in lanes of `F`.
    type In<F: Lane>: EnergyKeeper<F, N, S> + InLanes<F, One = Self>;
}

/// `|velocity|² + |spin|²`: twice the energy per mass [L² T⁻²].
#[inline(always)]
pub(crate) fn square_speed<F: Lane, const N: usize, const S: usize>(velocity: &[F; N], spin: &[F; S]) -> F {
    let mut sum = velocity[0] * velocity[0];
    for v in &velocity[1..] {
        sum = sum + *v * *v;
    }
    for w in spin {
        sum = sum + *w * *w;
    }
    sum
}

/// Nothing: for laws that do not conserve energy, and for those who want the bare arithmetic.
pub type Free = ();

impl<F: Lane, const N: usize, const S: usize> EnergyKeeper<F, N, S> for Free {
    #[inline(always)]
    fn new(_: &[F; N], _: &[F; S]) -> Self {}
    #[inline(always)]
    fn leave(&mut self, _: &mut [F; N], _: &[F; S], _: &WallHit<F, N>, _: u32) {}
    #[inline(always)]
    fn leave_in_frame(&mut self, _: &mut [F; N], _: &mut [F; S], _: u32) {}
    #[inline(always)]
    fn lack(&self, velocity: &[F; N], _: &[F; S]) -> F {
        velocity[0].same(0.0)
    }
    fn square(&self, _: usize) -> Option<Double> {
        None
    }
    #[inline(always)]
    fn pass(&mut self, _: u32) {}
}

impl<const N: usize, const S: usize> Keeping<N, S> for Free {
    type In<F: Lane> = ();
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
    /// Collisions since the energy was restored, in all lanes alike.
    beat: u32,
    /// Between round walls, what each run after the first goes on with.
    recurring: Recurring<F>,
}

/// `|v|² + |w|²` as an exact sum of rounded squares and a small rest.
///
/// Each component is split into a head on a grid of 26 bits, whose square is exact, as are the sums of such squares,
/// and a tail: `x² = head² + tail (x + head)`.
#[inline(always)]
fn precise_square<F: Lane, const N: usize, const S: usize>(grid: F, v: &[F; N], w: &[F; S]) -> (F, F) {
    let parts = |x: F| {
        let head = (x + grid) - grid;
        (head * head, (x - head) * (x + head))
    };
    let (mut high, mut low) = parts(v[0]);
    for i in 1..N {
        let (h, l) = parts(v[i]);
        (high, low) = (high + h, low + l);
    }
    for i in 0..S {
        let (h, l) = parts(w[i]);
        (high, low) = (high + h, low + l);
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
        let recurring = Recurring::nothing(square.same(0.0));
        Conserved { grid, high, low, grazing: square * LITTLE, beat: 0, recurring }
    }
    #[inline(always)]
    fn leave(&mut self, velocity: &mut [F; N], spin: &[F; S], hit: &WallHit<F, N>, beat: u32) {
        self.beat += 1;
        if self.beat >= beat {
            self.beat = 0;
            self.restore(velocity, spin, hit);
        }
    }
    /// `v − 2 (v·n) n/|n|²` is `v − 2 (v·n) n` less `2 (v·n) (1 − |n|²) n`.
    #[inline(always)]
    fn straighten(&mut self, velocity: &mut [F; N], arrival: F, hit: &WallHit<F, N>) {
        let n = &hit.normal;
        // not from a sum near 1, which rounds to even numbers and so on one side more often than on the other
        let lacks = n.iter().fold(arrival.same(1.0), |rest, n| rest - *n * *n);
        let twice = (arrival + arrival) * lacks;
        for i in 0..N {
            velocity[i] = velocity[i] - twice * n[i];
        }
    }
    #[inline(always)]
    fn leave_in_frame(&mut self, velocity: &mut [F; N], spin: &mut [F; S], beat: u32) {
        self.beat += 1;
        if self.beat >= beat {
            self.beat = 0;
            self.restore_in_frame(velocity, spin);
        }
    }
    #[inline(always)]
    fn lack(&self, velocity: &[F; N], spin: &[F; S]) -> F {
        let (high, low) = precise_square(self.grid, velocity, spin);
        ((self.high - high) + (self.low - low)) / self.high
    }
    fn square(&self, lane: usize) -> Option<Double> {
        Some(Double { high: self.high.lane(lane), low: self.low.lane(lane) })
    }
    #[inline(always)]
    fn pass(&mut self, beat: u32) {
        self.beat += 1;
        if self.beat >= beat {
            self.beat = 0;
        }
    }
    fn recurring(&mut self) -> Option<&mut Recurring<F>> {
        Some(&mut self.recurring)
    }
}

impl<F: Lane, const N: usize> InLanes<F> for Conserved<F, N> {
    type One = Conserved<f64, N>;
    fn one(&self, lane: usize) -> Conserved<f64, N> {
        Conserved {
            grid: self.grid.lane(lane),
            high: self.high.lane(lane),
            low: self.low.lane(lane),
            grazing: self.grazing.lane(lane),
            beat: self.beat,
            recurring: self.recurring.one(lane),
        }
    }
    fn all(one: &Conserved<f64, N>, zero: F) -> Self {
        Conserved {
            grid: zero.same(one.grid),
            high: zero.same(one.high),
            low: zero.same(one.low),
            grazing: zero.same(one.grazing),
            beat: one.beat,
            recurring: Recurring::all(&one.recurring, zero),
        }
    }
    fn put(&mut self, lane: usize, one: &Conserved<f64, N>) {
        self.grid.put(lane, one.grid);
        self.high.put(lane, one.high);
        self.low.put(lane, one.low);
        self.grazing.put(lane, one.grazing);
        self.recurring.put(lane, &one.recurring);
    }
    fn wait(&self, one: &Conserved<f64, N>, beat: u32) -> u64 {
        // an orbit that comes from slower walls may have counted further
        let counted = |beats: u32| beats.min(beat - 1);
        u64::from((counted(one.beat) + beat - counted(self.beat)) % beat)
    }
}

impl<const N: usize, const S: usize> Keeping<N, S> for Conserved<f64, N> {
    type In<F: Lane> = Conserved<F, N>;
}

impl<F: Lane, const N: usize> Conserved<F, N> {
    /// Hands what the energy lacks to the velocity.
    #[inline(always)]
    fn restore<const S: usize>(&self, velocity: &mut [F; N], spin: &[F; S], hit: &WallHit<F, N>) {
        let normal = &hit.normal;
        let (mut vn, mut square) = (velocity[0] * normal[0], velocity[0] * velocity[0]);
        for i in 1..N {
            vn = vn + velocity[i] * normal[i];
            square = square + velocity[i] * velocity[i];
        }
        // along the normal; along the velocity where it grazes; not at all where nearly all energy is spin
        let zero = vn.same(0.0);
        let steep = self.grazing.lt((vn * hit.inverse) * (vn * hit.inverse));
        let moving = self.grazing.lt(square);
        let share = moving.select(zero.same(0.5), zero) / steep.select(vn, square);
        let (high, low) = precise_square(self.grid, velocity, spin);
        let add = ((self.high - high) + (self.low - low)) * share;
        for i in 0..N {
            velocity[i] = velocity[i] + add * steep.select(normal[i], velocity[i]);
        }
    }

    /// Hands what the energy lacks to the tangential velocity and the spin.
    #[inline(always)]
    fn restore_in_frame<const S: usize>(&self, velocity: &mut [F; N], spin: &mut [F; S]) {
        let mut square = velocity[1] * velocity[1];
        for x in &velocity[2..] {
            square = square + *x * *x;
        }
        for w in &*spin {
            square = square + *w * *w;
        }
        let zero = square.same(0.0);
        let (high, low) = precise_square(self.grid, velocity, spin);
        let share = self.grazing.lt(square).select(zero.same(0.5), zero) / square.max(self.grazing);
        let add = ((self.high - high) + (self.low - low)) * share;
        for x in &mut velocity[1..] {
            *x = *x + *x * add;
        }
        for w in spin {
            *w = *w + *w * add;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_normal_too_long_does_to_the_energy_is_taken_back() {
        for stretch in [1e-9, -1e-9, 3e-12] {
            let normal = [0.6 * (1.0 + stretch), -0.8 * (1.0 + stretch)];
            let before = [-0.3, 0.9];
            let keeper = <Conserved<f64, 2> as EnergyKeeper<f64, 2, 0>>::new(&before, &[]);
            let arrival = before[0] * normal[0] + before[1] * normal[1];
            let mut velocity = [0, 1].map(|i| before[i] - 2.0 * arrival * normal[i]);
            let square = |v: [f64; 2]| v[0] * v[0] + v[1] * v[1];
            let off = (square(velocity) - square(before)).abs();
            assert!(off > 2.0 * stretch.abs(), "{off:e}");
            let hit = WallHit { normal, ..WallHit::never([0.0; 2]) };
            EnergyKeeper::<f64, 2, 0>::straighten(&mut { keeper }, &mut velocity, arrival, &hit);
            let off = (square(velocity) - square(before)).abs();
            assert!(off < 1e-15, "{off:e}");
        }
    }
}
