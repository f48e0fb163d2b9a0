//! An energy keeper as plain numbers, so that an orbit can be stored in a file and continued later.
use super::{BEAT, Conserved};
use crate::recurring::Recurring;
use lanes::Double;

impl<const N: usize> Conserved<f64, N> {
    /// Its whole state, as the bits of its numbers; see [`f64::to_bits`]. One of the numbers may be infinite, which not every file format
    /// can represent. Their order is specific to this version.
    ///
    /// Position, velocity, spin and tracks of an orbit are numbers that anyone can read and write. With these bits the orbit goes on as
    /// if it had never been stored, bit for bit. (A [new](crate::EnergyKeeper::new) keeper would take the rounded energy of that moment,
    /// and the last digits of the orbit would differ.)
    ///
    /// ```
    /// use billiards::{Collisions, Conserved, Orbit, Planar, laws::Disk};
    /// use billiards::{collision_laws::laws::NoSlip, geometry::tables};
    ///
    /// let circle = Planar { table: tables::circle(1.0)?, law: Disk::new(&NoSlip, 0.7)? };
    /// let mut orbit: Orbit<f64, 2, 1, Conserved<f64, 2>> = Orbit::new([0.1, 0.2], [0.6, 0.3], [0.4], ());
    /// circle.run(&mut orbit, &Collisions(1000), &mut ());
    ///
    /// let (numbers, keeper) = (orbit.position.map(f64::to_bits), orbit.keeper.to_bits()); // and so velocity and spin
    /// let mut kept = Orbit {
    ///     position: numbers.map(f64::from_bits),
    ///     keeper: Conserved::from_bits(keeper).expect("as they were written"),
    ///     ..orbit
    /// };
    /// circle.run(&mut orbit, &Collisions(1000), &mut ());
    /// circle.run(&mut kept, &Collisions(1000), &mut ());
    /// assert_eq!(orbit, kept);
    /// # Ok::<(), billiards::Error>(())
    /// ```
    pub fn to_bits(&self) -> [u64; 14] {
        let Conserved { grid, high, low, spin, little, share, twice, beat, recurring } = *self;
        let Recurring { normal, spin: recurring_spin, tangential } = recurring;
        let [a, b, c] = [normal, recurring_spin, tangential].map(|x| [x.high.to_bits(), x.low.to_bits()]);
        let [grid, high, low, spin, little, share, twice] =
            [grid, high, low, spin, little, share, twice].map(f64::to_bits);
        [grid, high, low, spin, little, share, twice, u64::from(beat), a[0], a[1], b[0], b[1], c[0], c[1]]
    }

    /// The keeper with these [bits](Self::to_bits); `None` if they count more collisions since the energy was restored than possible, so
    /// that they cannot be those of a keeper.
    pub fn from_bits(bits: [u64; 14]) -> Option<Self> {
        let beat = u32::try_from(bits[7]).ok().filter(|beat| *beat < BEAT)?;
        let number = |i: usize| f64::from_bits(bits[i]);
        let digits = |i: usize| Double { high: number(i), low: number(i + 1) };
        Some(Conserved {
            grid: number(0),
            high: number(1),
            low: number(2),
            spin: number(3),
            little: number(4),
            share: number(5),
            twice: number(6),
            beat,
            recurring: Recurring { normal: digits(8), spin: digits(10), tangential: digits(12) },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Angle, Clock, Collisions, Free, Orbit, Planar, laws::Disk};
    use collision_laws::laws::{NoSlip, Restitution};
    use geometry::{Table, tables};
    use serde_json::{Value, json};

    type Tracked = Orbit<f64, 2, 1, Conserved<f64, 2>, (Clock, Angle)>;

    /// An orbit as text.
    fn written(orbit: &Tracked) -> String {
        let sums = [orbit.track.0.0, orbit.track.1.0].map(|x| [x.high, x.low]);
        let numbers: Vec<f64> = orbit
            .position
            .iter()
            .chain(&orbit.velocity)
            .chain(&orbit.spin)
            .chain(sums.as_flattened())
            .copied()
            .collect();
        json!({ "numbers": numbers, "keeper": orbit.keeper.to_bits() }).to_string()
    }

    fn read(text: &str) -> Tracked {
        let value: Value = serde_json::from_str(text).unwrap();
        let x = |i: usize| value["numbers"][i].as_f64().unwrap();
        let sum = |i: usize| Double { high: x(i), low: x(i + 1) };
        Orbit {
            position: [x(0), x(1)],
            velocity: [x(2), x(3)],
            spin: [x(4)],
            keeper: Conserved::from_bits(core::array::from_fn(|i| value["keeper"][i].as_u64().unwrap())).unwrap(),
            track: (Clock(sum(5)), Angle(sum(7))),
        }
    }

    fn started(spin: f64) -> Tracked {
        Orbit::new([0.1, 0.2], [0.6, 0.3], [spin], (Clock::new(0.0), Angle::new(0.5)))
    }

    /// The bits of a state: −0 is not 0.
    fn bits(orbit: &Tracked) -> String {
        format!("{orbit:?}")
    }

    /// Continues an orbit from its state after `collisions`: without being written and read, and with.
    fn on(table: Table, law: Disk, spin: f64, collisions: u64) -> [Tracked; 2] {
        let billiard = Planar { table, law };
        let mut orbit = started(spin);
        billiard.run(&mut orbit, &Collisions(collisions), &mut ());
        let mut kept = read(&written(&orbit));
        assert_eq!(bits(&orbit), bits(&kept));
        for orbit in [&mut orbit, &mut kept] {
            billiard.run(orbit, &Collisions(1000), &mut ());
        }
        [orbit, kept]
    }

    #[test]
    fn an_orbit_kept_as_text_goes_on_with_the_bits_that_it_would_have_had() {
        let rough = Disk::new(&NoSlip, 0.7).unwrap();
        for collisions in [0, 1, 15, 16, 1003] {
            for table in [tables::stadium(1.0, 1.0), tables::circle(1.0), tables::strip(1.0), tables::square(1.0)] {
                let [orbit, kept] = on(table.unwrap(), rough, 0.4, collisions);
                assert_eq!(bits(&orbit), bits(&kept), "after {collisions}");
            }
        }
    }

    #[test]
    fn a_keeper_that_has_given_up_comes_back_as_one_that_has() {
        let lossy = Disk::new(&Restitution::new(0.99, 0.99).unwrap(), 0.7).unwrap();
        let [orbit, kept] = on(tables::stadium(1.0, 1.0).unwrap(), lossy, 0.4, 100);
        assert!(kept.keeper.little.is_infinite());
        assert_eq!(bits(&orbit), bits(&kept));
        // as one that never kept anything
        let mut free: Orbit<f64, 2, 1, Free, (Clock, Angle)> =
            Orbit::new(kept.position, kept.velocity, kept.spin, kept.track);
        let billiard = Planar { table: tables::stadium(1.0, 1.0).unwrap(), law: lossy };
        let mut kept = read(&written(&kept));
        billiard.run(&mut kept, &Collisions(20), &mut ());
        billiard.run(&mut free, &Collisions(20), &mut ());
        assert_eq!((kept.position, kept.velocity), (free.position, free.velocity));
    }

    #[test]
    fn what_no_speed_or_an_infinite_one_makes_of_a_keeper_comes_back() {
        for velocity in [[0.0, -0.0], [f64::INFINITY, 1.0], [f64::NAN, 1.0], [1e200, 1.0], [5e-324, 0.0]] {
            let orbit = Tracked::new([0.1, 0.2], velocity, [0.4], (Clock::new(0.0), Angle::new(0.0)));
            let bits = orbit.keeper.to_bits();
            assert_eq!(Conserved::<f64, 2>::from_bits(bits).unwrap().to_bits(), bits, "{velocity:?}");
        }
    }

    #[test]
    fn bits_that_count_too_many_collisions_are_none_of_a_keeper() {
        let mut bits = started(0.0).keeper.to_bits();
        for (beat, is_one) in [(0, true), (u64::from(BEAT) - 1, true), (u64::from(BEAT), false), (u64::MAX, false)] {
            bits[7] = beat;
            assert_eq!(Conserved::<f64, 2>::from_bits(bits).is_some(), is_one, "{beat}");
        }
    }
}
