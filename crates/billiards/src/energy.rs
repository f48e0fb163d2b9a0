//! Keeping the energy of long orbits to the last digit.
//!
//! Rounding in a reflection changes the energy by about 10⁻¹⁶ per collision, always in the same direction for the
//! same constants: after 10⁹ collisions 10⁻⁷ would be gone. Every [`BEAT`] collisions [`Conserved`] computes the energy with an error of
//! about 2⁻⁷⁵ and adds what is missing to the **normal** component of the outgoing velocity, from which the law took it (to the velocity
//! as a whole where it grazes the wall; between parallel planes to velocity and spin along them). It uses the energy with which the orbit
//! arrived, which is known before the law is applied, so that the next flight need not wait for the sum. The error of the energy is then
//! at most that of [`BEAT`] + 1 collisions, and the cost a fraction of that of one collision.
mod bits;

use crate::{in_lanes::InLanes, recurring::Recurring};
use geometry::WallHit;
use lanes::{Double, Lane, Mask};

/// The energy is restored after this many collisions.
///
/// A collision changes it by about 1.5·10⁻¹⁶, mostly at random, so that between two beats the error is about √16 times that. The
/// branch taken then is hardly ever predicted: at every 64th collision one orbit would take 2 to 11 % less time, but the invariant of
/// an ellipse would wander farther than 10⁻¹² in 10⁷ collisions.
pub const BEAT: u32 = 16;

/// A component with less than this share of the energy receives no correction of the energy: so no relative correction of a velocity is
/// more than ½/√10⁻³ = 16 times the relative error of the energy.
pub(crate) const LITTLE: f64 = 1e-3;

/// Rounding never loses this share of the energy between two beats; a law that does is left alone.
pub(crate) const MOST: f64 = 1e-6;

/// What is done about the energy of an orbit besides the law.
pub trait EnergyKeeper<F: Lane, const N: usize, const S: usize>: Copy {
    /// For an orbit that starts with this velocity and spin.
    fn new(velocity: &[F; N], spin: &[F; S]) -> Self;
    /// What an orbit in flight lacks of `|v|² + |w|²`, if the collision ahead is to make up for it, otherwise 0.
    ///
    /// It is called before the hit is sought, so that nothing waits for it.
    fn owed(&self, velocity: &[F; N], spin: &[F; S]) -> F;
    /// The part of `owed` that rounding can have lost: nothing where a law has taken it, and nothing from then on. For laws that may take
    /// energy.
    #[inline(always)]
    fn rounded_off(&mut self, owed: F) -> F {
        owed
    }
    /// Sees what `arrived` at a collision, and may correct the velocity that leaves it.
    fn leave(&mut self, velocity: &mut [F; N], hit: &WallHit<F, N>, arrived: &Arrived<F>);
    /// Like [`leave`](EnergyKeeper::leave) under a strict law [between parallel walls](geometry::Walls::are_parallel), where the normal
    /// component is never rounded: corrects velocity and spin along the walls.
    fn leave_along(&mut self, velocity: &mut [F; N], spin: &mut [F; S], hit: &WallHit<F, N>, arrived: &Arrived<F>);
    /// Removes the effect of the rounded length of the normal, which should be 1, on the velocity that leaves a collision.
    fn straighten(&mut self, _velocity: &mut [F; N], _hit: &WallHit<F, N>, _arrived: &Arrived<F>) {}
    /// Like [`leave`](EnergyKeeper::leave) in the frame of the wall, with the normal component of the velocity first, then the tangential
    /// ones, and the spin: corrects velocity and spin as a whole, where a strict law leaves the size of the normal component as it is.
    fn leave_in_frame(&mut self, velocity: &mut [F; N], spin: &mut [F; S], owed: F);
    /// The relative deficit of a velocity and a spin in `|v|² + |w|²`, to 2⁻⁷⁵; 0 where no energy is kept.
    #[inline(always)]
    fn lack(&self, velocity: &[F; N], _spin: &[F; S]) -> F {
        velocity[0].same(0.0)
    }
    /// The shares of the deficit that velocity and spin make up for, relative to those if both grew by the same factor: 1 and 1; or the
    /// velocity makes up for all of it and the spin for nothing, if the spin is as it was at the start and no law has touched it.
    #[inline(always)]
    fn shares(&self, velocity: &[F; N], _spin: &[F; S]) -> [F; 2] {
        [velocity[0].same(1.0); 2]
    }
    /// `|v|² + |w|²` as it should be, in one lane; `None` where no energy is kept.
    fn square(&self, _lane: usize) -> Option<Double> {
        None
    }
    /// Counts a collision that rounds nothing.
    #[inline(always)]
    fn pass(&mut self) {}
    /// What is known of the velocity between round walls besides its energy.
    fn recurring(&mut self) -> Option<&mut Recurring<F>> {
        None
    }
}

/// What arrives at a collision.
#[derive(Clone, Copy, Debug)]
pub struct Arrived<F> {
    /// What was [owed](EnergyKeeper::owed) before.
    pub owed: F,
    /// The component of the velocity along the normal of the hit, times its length.
    pub normal_speed: F,
    /// Whether the law reverses that, as [strict](crate::BallLaw::is_strict) ones do.
    pub reverses: bool,
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

/// `|of|²`
#[inline(always)]
fn square<F: Lane, const N: usize>(zero: F, of: &[F; N]) -> F {
    of.iter().fold(zero, |sum, x| sum + *x * *x)
}

/// The taxicab norm of velocity and spin together.
#[inline(always)]
pub(crate) fn taxicab_with_spin<F: Lane, const N: usize, const S: usize>(velocity: &[F; N], spin: &[F; S]) -> F {
    let mut all = taxicab(velocity);
    for w in spin {
        all = all + w.abs();
    }
    all
}

/// The taxicab norm: the sum of the absolute values of the components. It lies between the length and that length times the root of
/// their number, and needs no squares, which may over- or underflow.
#[inline(always)]
pub(crate) fn taxicab<F: Lane, const N: usize>(of: &[F; N]) -> F {
    let mut sum = of[0].abs();
    for x in &of[1..] {
        sum = sum + x.abs();
    }
    sum
}

/// Keeps nothing: for laws that do not conserve energy, and for the bare arithmetic.
pub type Free = ();

impl<F: Lane, const N: usize, const S: usize> EnergyKeeper<F, N, S> for Free {
    #[inline(always)]
    fn new(_: &[F; N], _: &[F; S]) -> Self {}
    #[inline(always)]
    fn owed(&self, velocity: &[F; N], _: &[F; S]) -> F {
        velocity[0].same(0.0)
    }
    #[inline(always)]
    fn leave(&mut self, _: &mut [F; N], _: &WallHit<F, N>, _: &Arrived<F>) {}
    #[inline(always)]
    fn leave_along(&mut self, _: &mut [F; N], _: &mut [F; S], _: &WallHit<F, N>, _: &Arrived<F>) {}
    #[inline(always)]
    fn leave_in_frame(&mut self, _: &mut [F; N], _: &mut [F; S], _: F) {}
}

impl<const N: usize, const S: usize> Keeping<N, S> for Free {
    type In<F: Lane> = ();
}

/// Keeps the energy of the start: for laws that conserve it.
///
/// Once an orbit lacks more than 10⁻⁶ of that energy, nothing is restored any more: then the law takes it, and the orbit goes on as with
/// [`Free`]. A law that takes less than that in [`BEAT`] collisions cannot be told from rounding: use [`Free`] from the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conserved<F, const N: usize> {
    /// `3·2²⁵` times a power of two not below the speed: adding and subtracting it rounds to 26 bits.
    grid: F,
    /// `|v|² + |w|²` at the start, as a sum.
    high: F,
    low: F,
    /// `|w|²` at the start, as [`square`] rounds it.
    spin: F,
    /// A component whose square is below this has next to no energy to correct.
    little: F,
    /// `½/(|v|² + |w|²)`, or 0 where nothing is kept.
    share: F,
    /// 2, or 0 where nothing is kept.
    twice: F,
    /// Collisions since the energy was restored, the same in all lanes.
    beat: u32,
    /// Between round walls, what each run after the first continues from.
    recurring: Recurring<F>,
}

/// `|v|² + |w|²` as an exact sum of rounded squares and a small rest.
///
/// Each component is split into a head on a grid of 26 bits, whose square is exact, as are the sums of such squares,
/// and a tail: `x² = head² + tail (x + head)`.
#[inline(always)]
fn precise_square<F: Lane, const N: usize, const S: usize>(grid: F, v: &[F; N], w: &[F; S]) -> (F, F) {
    let (mut high, mut low) = square_in_parts(grid, v[0]);
    for i in 1..N {
        let (h, l) = square_in_parts(grid, v[i]);
        (high, low) = (high + h, low + l);
    }
    for i in 0..S {
        let (h, l) = square_in_parts(grid, w[i]);
        (high, low) = (high + h, low + l);
    }
    (high, low)
}

/// `x²` as the exact square of its leading digits, those on the grid, and the rest, rounded.
#[inline(always)]
fn square_in_parts<F: Lane>(grid: F, x: F) -> (F, F) {
    let head = (x + grid) - grid;
    (head * head, (x - head) * (x + head))
}

impl<F: Lane, const N: usize, const S: usize> EnergyKeeper<F, N, S> for Conserved<F, N> {
    #[inline(always)]
    fn new(velocity: &[F; N], spin: &[F; S]) -> Self {
        let all = square_speed(velocity, spin);
        let grid = all.each(|k| {
            let (_, exponent) = libm::frexp(libm::sqrt(all.lane(k)));
            libm::ldexp(3.0, exponent + 25)
        });
        let (high, low) = precise_square(grid, velocity, spin);
        let zero = all.same(0.0);
        // for speeds so small that their squares vanish nothing is missing, and no share is infinite
        let share = all.same(0.5) / all.max(all.same(f64::MIN_POSITIVE));
        Conserved {
            grid,
            high,
            low,
            spin: square(zero, spin),
            little: all * LITTLE,
            share,
            twice: all.same(2.0),
            beat: 0,
            recurring: Recurring::nothing(zero),
        }
    }
    #[inline(always)]
    fn owed(&self, velocity: &[F; N], spin: &[F; S]) -> F {
        if self.beat + 1 < BEAT {
            return velocity[0].same(0.0);
        }
        if F::LANES == 1 {
            seldom();
        }
        self.missing(velocity, spin)
    }
    #[inline(always)]
    fn rounded_off(&mut self, owed: F) -> F {
        if self.beat + 1 < BEAT {
            return owed;
        }
        let (kept, zero) = (self.is_rounding(owed), owed.same(0.0));
        self.little = kept.select(self.little, owed.same(f64::INFINITY));
        self.share = kept.select(self.share, zero);
        self.twice = kept.select(self.twice, zero);
        kept.select(owed, zero)
    }
    #[inline(always)]
    fn leave(&mut self, velocity: &mut [F; N], hit: &WallHit<F, N>, arrived: &Arrived<F>) {
        if self.is_due() {
            self.restore(velocity, hit, arrived);
        }
    }
    /// The spin has the axes of the velocity, or else all of it is along the walls.
    #[inline(always)]
    fn leave_along(&mut self, velocity: &mut [F; N], spin: &mut [F; S], hit: &WallHit<F, N>, arrived: &Arrived<F>) {
        if self.is_due() {
            let [zero, one] = [arrived.owed.same(0.0), arrived.owed.same(1.0)];
            let along = |i: usize| one - hit.normal[i] * hit.normal[i];
            let of_spin = |i: usize| if S == N { along(i) } else { one };
            let mut square = zero;
            for i in 0..N {
                square = square + velocity[i] * velocity[i] * along(i);
            }
            for i in 0..S {
                square = square + spin[i] * spin[i] * of_spin(i);
            }
            let much = self.little.lt(square);
            let growth = much.select(arrived.owed * 0.5 / much.select(square, one), zero);
            // if almost nothing moves along the walls, energy can only be lost across them, by a law that does round there
            self.restore(velocity, hit, &Arrived { owed: much.select(zero, arrived.owed), ..*arrived });
            for i in 0..N {
                velocity[i] = velocity[i] + velocity[i] * (growth * along(i));
            }
            for i in 0..S {
                spin[i] = spin[i] + spin[i] * (growth * of_spin(i));
            }
        }
    }
    /// With the unit vector `u = ι n`, `v − 2 (v·u) u/|u|²` is `v − 2 (v·u) u` less `2 (v·u) (1 − |u|²) u`.
    #[inline(always)]
    fn straighten(&mut self, velocity: &mut [F; N], hit: &WallHit<F, N>, arrived: &Arrived<F>) {
        let (n, arrival) = (hit.unit_normal(), arrived.normal_speed * hit.inverse);
        // not from a sum near 1, which rounds to even numbers and so on one side more often than on the other
        let lacks = n.iter().fold(arrival.same(1.0), |rest, n| rest - *n * *n);
        let turned = (arrival * self.twice) * lacks;
        for i in 0..N {
            velocity[i] = velocity[i] - turned * n[i];
        }
    }
    #[inline(always)]
    fn leave_in_frame(&mut self, velocity: &mut [F; N], spin: &mut [F; S], owed: F) {
        if self.is_due() {
            // their share of the energy: as much as they have lost, on average
            let growth = owed * self.share;
            for i in 0..N {
                velocity[i] = velocity[i] + velocity[i] * growth;
            }
            for i in 0..S {
                spin[i] = spin[i] + spin[i] * growth;
            }
        }
    }
    #[inline(always)]
    fn lack(&self, velocity: &[F; N], spin: &[F; S]) -> F {
        let missing = self.missing(velocity, spin);
        self.is_rounding(missing).select(missing, missing.same(0.0)) * (self.share + self.share)
    }
    #[inline(always)]
    fn shares(&self, velocity: &[F; N], spin: &[F; S]) -> [F; 2] {
        let [zero, one] = [velocity[0].same(0.0), velocity[0].same(1.0)];
        let [of_velocity, of_spin] = [square(zero, velocity), square(zero, spin)];
        let all = of_velocity + of_spin;
        let untouched = !(of_spin.lt(self.spin) | self.spin.lt(of_spin));
        let alone = untouched & (all * LITTLE).lt(of_velocity);
        [alone.select(all / of_velocity, one), alone.select(zero, one)]
    }
    fn square(&self, lane: usize) -> Option<Double> {
        (self.twice.lane(lane) > 0.0).then(|| Double { high: self.high.lane(lane), low: self.low.lane(lane) })
    }
    #[inline(always)]
    fn pass(&mut self) {
        self.is_due();
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
            spin: self.spin.lane(lane),
            little: self.little.lane(lane),
            share: self.share.lane(lane),
            twice: self.twice.lane(lane),
            beat: self.beat,
            recurring: self.recurring.one(lane),
        }
    }
    fn all(one: &Conserved<f64, N>, zero: F) -> Self {
        Conserved {
            grid: zero.same(one.grid),
            high: zero.same(one.high),
            low: zero.same(one.low),
            spin: zero.same(one.spin),
            little: zero.same(one.little),
            share: zero.same(one.share),
            twice: zero.same(one.twice),
            beat: one.beat,
            recurring: Recurring::all(&one.recurring, zero),
        }
    }
    fn put(&mut self, lane: usize, one: &Conserved<f64, N>) {
        self.grid.put(lane, one.grid);
        self.high.put(lane, one.high);
        self.low.put(lane, one.low);
        self.spin.put(lane, one.spin);
        self.little.put(lane, one.little);
        self.share.put(lane, one.share);
        self.twice.put(lane, one.twice);
        self.recurring.put(lane, &one.recurring);
    }
    fn wait(&self, one: &Conserved<f64, N>) -> u64 {
        u64::from((one.beat + BEAT - self.beat) % BEAT)
    }
}

impl<const N: usize, const S: usize> Keeping<N, S> for Conserved<f64, N> {
    type In<F: Lane> = Conserved<F, N>;
}

impl<F: Lane, const N: usize> Conserved<F, N> {
    /// This keeper, or one that changes nothing, like [`Free`]: for a law whose type does not tell whether it conserves energy.
    ///
    /// ```
    /// use billiards::{Collisions, Conserved, EnergyKeeper, Orbit, Planar, laws::Disk};
    /// use billiards::{collision_laws::laws::Restitution, geometry::tables};
    ///
    /// let law = Disk::new(&Restitution::new(0.999_999_9, 1.0)?, 0.7)?;
    /// let mut orbit: Orbit<f64, 2, 1, Conserved<f64, 2>> = Orbit::new([0.1, 0.2], [0.6, 0.8], [0.0], ());
    /// orbit.keeper = orbit.keeper.only_if(false);
    /// let mut free: Orbit<f64, 2, 1> = Orbit::new([0.1, 0.2], [0.6, 0.8], [0.0], ());
    /// let billiard = Planar { table: tables::square(1.0)?, law };
    /// billiard.run(&mut orbit, &Collisions(1000), &mut ());
    /// billiard.run(&mut free, &Collisions(1000), &mut ());
    /// assert_eq!((orbit.position, orbit.velocity), (free.position, free.velocity));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn only_if(self, conserves: bool) -> Self {
        if conserves {
            return self;
        }
        let zero = self.share.same(0.0);
        Conserved { little: zero.same(f64::INFINITY), share: zero, twice: zero, ..self }
    }

    /// Counts a collision; whether it is time to restore the energy.
    #[inline(always)]
    fn is_due(&mut self) -> bool {
        self.beat += 1;
        let due = self.beat >= BEAT;
        if F::LANES > 1 {
            self.beat = if due { 0 } else { self.beat };
        } else if due {
            seldom();
            self.beat = 0;
        }
        due
    }

    /// Whether rounding alone can have lost this much of the energy.
    #[inline(always)]
    fn is_rounding(&self, missing: F) -> F::Mask {
        missing.abs().lt(self.high * MOST)
    }

    /// The amount of `|v|² + |w|²` that a velocity and a spin lack.
    #[inline(always)]
    fn missing<const S: usize>(&self, velocity: &[F; N], spin: &[F; S]) -> F {
        let (high, low) = precise_square(self.grid, velocity, spin);
        (self.high - high) + (self.low - low)
    }

    /// Adds the energy that was missing on arrival to the outgoing velocity: to its normal component, whose size is known before the law
    /// is applied; or, where that is almost zero or not reversed, to the velocity as a whole, without the share that belongs to the spin.
    #[inline(always)]
    fn restore(&self, velocity: &mut [F; N], hit: &WallHit<F, N>, arrived: &Arrived<F>) {
        let (vn, normal) = (arrived.normal_speed, &hit.normal);
        let speed = vn * hit.inverse;
        let steep = self.little.lt(speed * speed);
        let steep = if arrived.reverses { steep } else { vn.never() };
        let add = arrived.owed * steep.select(vn.same(-0.5) / vn, self.share);
        for i in 0..N {
            velocity[i] = velocity[i] + add * steep.select(normal[i], velocity[i]);
        }
    }
}

/// Tells the compiler that a branch is seldom taken, so that it does not take registers from the others. (Of the many registers that
/// lanes need, the compiler would otherwise spill some around it.)
#[cold]
fn seldom() {}

#[cfg(test)]
mod tests {
    use super::*;
    use lanes::dot;

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
            let arrived = Arrived { owed: 0.0, normal_speed: arrival, reverses: true };
            EnergyKeeper::<f64, 2, 0>::straighten(&mut { keeper }, &mut velocity, &hit, &arrived);
            let off = (square(velocity) - square(before)).abs();
            assert!(off < 1e-15, "{off:e}");
        }
    }

    /// The error of the energy after the collision that restores it, for an error of 10⁻⁹ on arrival.
    fn off(arrived: [f64; 2], normal: [f64; 2], leaves: [f64; 2], reverses: bool) -> f64 {
        let mut keeper = <Conserved<f64, 2> as EnergyKeeper<f64, 2, 0>>::new(&arrived, &[]);
        let lacking = |v: [f64; 2]| v.map(|v| v * (1.0 - 0.5e-9));
        let (velocity, mut leaves) = (lacking(arrived), lacking(leaves));
        let hit = WallHit { normal, ..WallHit::never([0.0; 2]) };
        for _ in 0..BEAT {
            let owed = keeper.owed(&velocity, &[]);
            let arrived = Arrived { owed, normal_speed: dot(&velocity, &normal), reverses };
            EnergyKeeper::<f64, 2, 0>::leave(&mut keeper, &mut leaves, &hit, &arrived);
        }
        keeper.lack(&leaves, &[])
    }

    #[test]
    fn speeds_whose_squares_vanish_are_left_as_they_are() {
        for speed in [1e-155, 1e-160, 1e-200] {
            let [arrives, leaves] = [[0.6 * speed, -0.8 * speed], [0.6 * speed, 0.8 * speed]];
            let mut keeper = <Conserved<f64, 2> as EnergyKeeper<f64, 2, 0>>::new(&arrives, &[]);
            let hit = WallHit { normal: [0.0, 1.0], ..WallHit::never([0.0; 2]) };
            let mut velocity = leaves;
            for _ in 0..BEAT {
                let owed = keeper.owed(&arrives, &[]);
                let arrived = Arrived { owed, normal_speed: arrives[1], reverses: false };
                EnergyKeeper::<f64, 2, 0>::leave(&mut keeper, &mut velocity, &hit, &arrived);
            }
            assert_eq!(velocity, leaves);
        }
    }

    #[test]
    fn what_is_missing_is_made_up_for_at_once() {
        // in the normal component, or as a whole if that is almost zero or has changed
        assert!(off([0.6, -0.8], [0.0, 1.0], [0.6, 0.8], true).abs() < 1e-16);
        assert!(off([1.0, -0.01], [0.0, 1.0], [1.0, 0.01], true).abs() < 1e-16);
        assert!(off([0.6, -0.8], [0.0, 1.0], [0.6, 0.8], false).abs() < 1e-16);
        // handed to a component of 0.28, it would be four times too much in one of 1
        assert!(off([0.96, -0.28], [0.0, 1.0], [0.0, 1.0], false).abs() < 1e-16);
    }
}
