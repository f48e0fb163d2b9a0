//! The billiard map in the frame of the wall, where the walls look the same from everywhere.
use crate::{
    billiard::{BallLaw, Motion, slow},
    creep::creeps_around,
    energy::{EnergyKeeper, LITTLE, MOST},
    laws::Mirror,
    orbit::Orbit,
    recurring::Recurring,
    stop::{LEAST, ROUNDED},
    track::Track,
};
use geometry::{Chord, Homogeneous, Swing, WallHit};
use lanes::{Double, Lane, Mask};

/// Homogeneous walls and a law: the frame of the last hit rolls along the wall with the orbit.
///
/// In a circle and in a strip the normal and the tangential velocity at a collision depend only on those at the last one. Carried along
/// in this frame, they are not rounded to the coordinates of the plane and back, and need not wait for a search: this is faster, and
/// avoids the drift of the phase that a rounded chord has.
///
/// Under a law that is an involution, the velocity in the frame returns after every two collisions in a circle. Both velocities are found
/// before the first collision, to twice the digits, and alternate: nothing but the place is rounded any more. A keeper of the energy
/// keeps these digits too, so that an orbit may be run in parts. Each run finds the frame anew, from place and velocity in the plane: so
/// a run in parts agrees with a single run up to rounding here, and to the last bit on all other walls.
#[derive(Clone, Copy, Debug)]
pub struct Rolling<'a, W, L> {
    /// What can be hit.
    pub walls: &'a W,
    /// What a hit does.
    pub law: &'a L,
    /// The law, if it is an involution and the walls are round.
    mirror: Option<Mirror>,
    /// Whether the law is the specular one.
    specular: bool,
}

/// The frame of the last hit; before the first, that of the first.
#[derive(Clone, Copy, Debug)]
pub struct Frame<F: Lane> {
    place: [F; 2],
    /// Normal velocity.
    normal: F,
    /// The motion along the wall; where it recurs, that of every second flight.
    even: Along<F>,
    odd: Along<F>,
    /// Which of the two comes now, in all lanes alike.
    is_odd: bool,
    /// Whether there has been a hit yet, and the time of the first.
    on_wall: F::Mask,
    first: F,
}

/// Motion along the wall.
#[derive(Clone, Copy, Debug)]
struct Along<F> {
    /// Tangential velocity.
    tangential: F,
    /// Time of a flight, where that recurs.
    time: F,
    /// Scaled spin and turn of a flight, where these recur.
    spin: F,
    swing: Swing<F>,
}

impl<F: Lane> Along<F> {
    fn at_rest(zero: F) -> Self {
        Along { tangential: zero, spin: zero, time: zero, swing: Swing { direction: [zero; 2], inverse: zero } }
    }

    /// With `other` in some lanes.
    fn with(&self, lanes: F::Mask, other: &Along<f64>) -> Self {
        let put = |to: F, from: f64| lanes.select(to.same(from), to);
        let ([u1, u2], [v1, v2]) = (self.swing.direction, other.swing.direction);
        Along {
            tangential: put(self.tangential, other.tangential),
            spin: put(self.spin, other.spin),
            time: put(self.time, other.time),
            swing: Swing {
                direction: [put(u1, v1), put(u2, v2)],
                inverse: put(self.swing.inverse, other.swing.inverse),
            },
        }
    }
}

impl<'a, W: Homogeneous, L: BallLaw<2, 1>> Rolling<'a, W, L> {
    /// `law` between `walls`.
    pub fn new(walls: &'a W, law: &'a L) -> Self {
        let mirror = law.mirror();
        let specular = mirror.is_some_and(Mirror::is_specular);
        Rolling { walls, law, mirror: mirror.filter(|_| W::ROUND), specular }
    }

    /// Whether a collision changes nothing but signs: between straight walls, under the specular law.
    #[inline(always)]
    fn slides(&self) -> bool {
        !W::ROUND && self.specular
    }

    /// Whether the velocity in the frame comes back at every second hit: for straight walls known to the compiler.
    #[inline(always)]
    fn recurs(&self) -> bool {
        W::ROUND && self.mirror.is_some()
    }

    /// Whether every flight takes as long as the last one: between straight walls, where the normal velocity stays.
    #[inline(always)]
    fn keeps_time(&self) -> bool {
        !W::ROUND && self.law.is_strict()
    }

    /// The frame of the first hit, with the velocity in the frame that an orbit on this path would have had after an earlier hit.
    fn before<K: EnergyKeeper<f64, 2, 1>, T>(&self, orbit: &mut Orbit<f64, 2, 1, K, T>) -> Frame<f64> {
        let hit = self.walls.first_hit(&orbit.position, &orbit.velocity);
        let velocity = self.walls.arrival(&orbit.position, &orbit.velocity, &hit.normal);
        let square = orbit.keeper.square(0);
        // between straight walls the normal component is exact, and the keeper restores the energy in flight
        let [normal, tangential] = if W::ROUND { with_energy(velocity, orbit.spin[0], square) } else { velocity };
        let tangential = if W::ROUND { tangential } else { -tangential };
        let mut now = Recurring { normal: -normal, spin: Double::new(orbit.spin[0]), tangential };
        if let (Some(mirror), Some(known)) = (&self.mirror, orbit.keeper.recurring()) {
            now = known.recall(now, mirror);
            *known = now;
        }
        let Recurring { normal, spin, tangential } = now;
        let place = self.walls.place(&hit);
        let along = |along: [Double; 2]| {
            let swing = Swing::recurring(normal, along[1]);
            let [spin, tangential] = rounded(normal.high, along, square, self.specular);
            let time = self.walls.chord(&place, normal.high, tangential).time;
            Along { tangential, time, spin, swing }
        };
        let now = [spin, tangential];
        let [even, odd] = if let Some(mirror) = &self.mirror {
            [along(now), along(mirror.apply(now))]
        } else {
            let tangential = tangential.high;
            let time = self.walls.chord(&place, normal.high, tangential).time;
            [Along { tangential, time, ..Along::at_rest(0.0) }; 2]
        };
        Frame { place, normal: normal.high, even, odd, is_odd: false, on_wall: false, first: hit.time }
    }
}

/// The velocity scaled, in the same direction, so that with the spin it has the energy that it should have; unchanged if nearly all
/// energy is spin, or if a law has taken it.
fn with_energy(velocity: [Double; 2], spin: f64, square: Option<Double>) -> [Double; 2] {
    let own = velocity[0].times(velocity[0]).plus(velocity[1].times(velocity[1]));
    match square {
        Some(all) if own.high > LITTLE * all.high => {
            let lacks = all.plus(-own).plus(-Double::product(spin, spin)).value();
            let lacks = if lacks.abs() < MOST * all.high { lacks } else { 0.0 };
            velocity.map(|x| x.plus(Double::new(x.high * (0.5 * lacks / own.high))))
        }
        _ => velocity,
    }
}

/// Spin and tangential velocity, each rounded up or down so that with the normal velocity they have the energy nearest to what it
/// should be; the spin stays as it is under a law that leaves it alone.
fn rounded(normal: f64, [spin, tangential]: [Double; 2], square: Option<Double>, leaves_spin: bool) -> [f64; 2] {
    let [w, t] = [spin.high, tangential.high];
    let Some(all) = square else { return [w, t] };
    let lacks = [normal, w, t].iter().fold(all, |all, x| all.plus(-Double::product(*x, *x))).value();
    // what is 0 stays 0
    let steps = [(w, leaves_spin), (t, false)];
    let steps = steps.map(|(x, stays)| if stays || x == 0.0 { 0.0 } else { x.abs().next_up() - x.abs() });
    let mut best = (lacks.abs(), [w, t]);
    for (i, j) in [(-1, -1), (-1, 0), (-1, 1), (0, -1), (0, 1), (1, -1), (1, 0), (1, 1)] {
        let [by_w, by_t] = [f64::from(i) * steps[0], f64::from(j) * steps[1]];
        let left = (lacks - 2.0 * (w * by_w + t * by_t)).abs();
        if left < best.0 {
            best = (left, [w + by_w, t + by_t]);
        }
    }
    best.1
}

impl<W: Homogeneous, L: BallLaw<2, 1>> Motion<2, 1> for Rolling<'_, W, L> {
    // between round walls more is carried along
    const IS_SHORT: bool = !W::ROUND;
    type Carried<F: Lane> = Frame<F>;
    type Arrival<F: Lane> = Chord<F>;

    fn start<F: Lane>(&self, zero: F) -> Frame<F> {
        let along = Along::at_rest(zero);
        let (place, on_wall) = ([zero; 2], zero.never());
        Frame { place, normal: zero, even: along, odd: along, is_odd: false, on_wall, first: zero }
    }
    #[cold]
    #[inline(never)]
    fn restart<F: Lane, K: EnergyKeeper<f64, 2, 1>, T>(
        &self,
        carried: &mut Frame<F>,
        new: F::Mask,
        orbit: &mut Orbit<f64, 2, 1, K, T>,
    ) {
        let from = self.before(orbit);
        let put = |to: F, from: f64| new.select(to.same(from), to);
        carried.place = [put(carried.place[0], from.place[0]), put(carried.place[1], from.place[1])];
        carried.normal = put(carried.normal, from.normal);
        carried.on_wall = carried.on_wall & !new;
        carried.first = put(carried.first, from.first);
        if self.recurs() {
            let [even, odd] = if carried.is_odd { [from.odd, from.even] } else { [from.even, from.odd] };
            carried.even = carried.even.with(new, &even);
            carried.odd = carried.odd.with(new, &odd);
        } else {
            carried.even.tangential = put(carried.even.tangential, from.even.tangential);
            carried.even.time = put(carried.even.time, from.even.time);
        }
    }
    #[inline(always)]
    fn flight<F: Lane, K: EnergyKeeper<F, 2, 1>, T>(
        &self,
        _: &Orbit<F, 2, 1, K, T>,
        carried: &Frame<F>,
    ) -> (WallHit<F, 2>, Chord<F>) {
        let on = carried.on_wall;
        let mut chord = if self.recurs() {
            let now = if carried.is_odd { &carried.odd } else { &carried.even };
            Chord { time: now.time, place: now.swing.apply(&carried.place), tangential: now.tangential }
        } else {
            let Frame { place, normal, even, .. } = carried;
            if self.keeps_time() {
                self.walls.chord_of(even.time, place, *normal, even.tangential)
            } else {
                self.walls.chord(place, *normal, even.tangential)
            }
        };
        if (!on).any() {
            chord.time = on.select(chord.time, carried.first);
            let [p1, p2] = carried.place;
            chord.place = [on.select(chord.place[0], p1), on.select(chord.place[1], p2)];
        }
        (self.walls.landing(&chord), chord)
    }
    #[inline(always)]
    fn collide<F: Lane, K: EnergyKeeper<F, 2, 1>, T: Track<F, 2, 1>>(
        &self,
        orbit: &mut Orbit<F, 2, 1, K, T>,
        carried: &mut Frame<F>,
        hit: &WallHit<F, 2>,
        chord: &Chord<F>,
        slow: F,
    ) -> F::Mask {
        orbit.track.fly(&orbit.position, &orbit.velocity, &orbit.spin, hit);
        let arrival = carried.normal;
        carried.place = chord.place;
        carried.on_wall = carried.on_wall | !carried.on_wall;
        if self.recurs() {
            carried.is_odd = !carried.is_odd;
            orbit.keeper.pass();
        } else if self.slides() {
            carried.even.tangential = chord.tangential;
            orbit.keeper.pass();
        } else {
            let mut velocity = [-arrival, chord.tangential];
            let mut owed = orbit.keeper.owed(&velocity, &orbit.spin);
            if !self.law.is_strict() {
                owed = orbit.keeper.rounded_off(owed);
            }
            self.law.collide_in_frame(hit, &mut velocity, &mut orbit.spin);
            orbit.keeper.leave_in_frame(&mut velocity, &mut orbit.spin, owed);
            if self.law.is_strict() {
                // exact, also where the law was applied in the coordinates of the plane
                velocity[0] = arrival;
            }
            [carried.normal, carried.even.tangential] = velocity;
        }
        if self.law.is_strict() {
            return !slow.lt(arrival.abs());
        }
        let (leaving, tangential) = (carried.normal, carried.even.tangential);
        let after = leaving.abs() + tangential.abs();
        let before = arrival.abs() + chord.tangential.abs();
        let flat = !(after.max(before) * ROUNDED).max(after.same(LEAST)).lt(leaving);
        if W::ROUND { flat | creeps_around(hit, [arrival, leaving], after) } else { flat }
    }
    fn slow(&self, velocity: &[f64; 2], spin: &[f64; 1]) -> f64 {
        slow(self.law, velocity, spin)
    }
    fn leaving<F: Lane>(&self, carried: &Frame<F>) -> F {
        carried.normal
    }
    #[inline(always)]
    fn settle<F: Lane, K, T>(&self, orbit: &mut Orbit<F, 2, 1, K, T>, carried: &Frame<F>) {
        let on = carried.on_wall;
        let now = if self.recurs() && carried.is_odd { &carried.odd } else { &carried.even };
        let (vn, vt) = (carried.normal, now.tangential);
        let WallHit { point, normal: [n1, n2], .. } =
            self.walls.landing(&Chord { time: vn, place: carried.place, tangential: vt });
        let velocity = [vn * n1 - vt * n2, vn * n2 + vt * n1];
        for i in 0..2 {
            orbit.position[i] = on.select(point[i], orbit.position[i]);
            orbit.velocity[i] = on.select(velocity[i], orbit.velocity[i]);
        }
        if self.recurs() {
            orbit.spin = [on.select(now.spin, orbit.spin[0])];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Clock, Collisions, Conserved, Planar, Timed,
        laws::{Custom, Disk},
        run,
    };
    use collision_laws::laws::{NoSlip, Restitution, Specular};
    use geometry::{
        Figure, Vector2, tables,
        walls::{Slab, Sphere, Strip},
    };
    use lanes::dot;

    type Disks = Orbit<f64, 2, 1, Conserved<f64, 2>, Clock>;

    #[test]
    fn flights_grow_longer_where_a_law_takes_from_the_normal_velocity() {
        let law = Disk::new(&Restitution::new(0.5, -1.0).unwrap(), 1.0).expect("a γ in range");
        let strip = Planar { table: tables::strip(1.0).unwrap(), law };
        let mut orbit = Orbit::<_, 2, 1, (), _>::new([0.0, 0.5], [0.25, -1.0], [0.0], Clock::new(0.0));
        strip.run(&mut orbit, &Collisions(4), &mut ());
        // half a width at speed 1, then whole ones at ½, ¼ and ⅛
        assert_eq!(orbit.track.time(), 0.5 + 2.0 + 4.0 + 8.0);
    }

    /// The normal velocity after 10⁵ collisions, each in a run of its own, relative to that at the start.
    fn normal_in_parts(billiard: &impl Motion<2, 1>, normal: impl Fn(&Disks) -> f64) -> f64 {
        let mut orbit = Disks::new([0.7, 0.31], [0.6, 0.5], [-0.4], Clock::new(0.0));
        run(billiard, &mut orbit, &Collisions(1), &mut ());
        let start = normal(&orbit);
        for _ in 0..100_000 {
            run(billiard, &mut orbit, &Collisions(1), &mut ());
        }
        normal(&orbit) / start - 1.0
    }

    #[test]
    fn the_normal_velocity_of_an_orbit_run_in_parts_does_not_drift() {
        let strip = Slab::<2, 1>::new(0.0, 1.0, [0, 1]).unwrap();
        let circle = Sphere::new(Vector2::zeros(), 1.0, 0).unwrap();
        let disk = Disk::new(&NoSlip, libm::sqrt(0.5)).unwrap();
        let custom = Custom::disk(NoSlip, libm::sqrt(0.5)).unwrap();
        let across = |orbit: &Disks| orbit.velocity[1].abs();
        let inwards =
            |orbit: &Disks| -dot(&orbit.position, &orbit.velocity) / libm::sqrt(dot(&orbit.position, &orbit.position));
        assert_eq!(normal_in_parts(&Rolling::new(&strip, &disk), across), 0.0);
        assert_eq!(normal_in_parts(&Rolling::new(&strip, &custom), across), 0.0);
        let along = Vector2::new(libm::cos(0.3), libm::sin(0.3));
        let line = |x: f64, by: f64| Figure::Line { through: Vector2::new(x, 0.0), direction: along * by };
        let askew = Strip::new([line(1.0, 1.0), line(-1.0, -1.0)], [0, 1]).unwrap();
        let slanting = |orbit: &Disks| along.perp(&Vector2::from(orbit.velocity)).abs();
        let off = normal_in_parts(&Rolling::new(&askew, &disk), slanting);
        // each velocity in the plane is rounded
        assert!(off.abs() < libm::sqrt(1e5) * f64::EPSILON, "{off:e}");
        let off = normal_in_parts(&Rolling::new(&circle, &disk), inwards);
        // the last place and velocity are rounded to the coordinates of the plane
        assert!(off.abs() < 4.0 * f64::EPSILON, "{off:e}");
    }

    #[test]
    fn a_spin_of_nothing_stays_nothing_where_the_energy_is_rounded() {
        for (position, velocity) in [([0.0, 0.5], [1.0, 0.0]), ([0.1, -0.3], [0.6, 0.8])] {
            let circle =
                Planar { table: tables::circle(1.0).unwrap(), law: Disk::new(&Specular, 0.5).expect("a γ in range") };
            let mut orbit = Orbit::<_, 2, 1, Conserved<_, 2>, _>::new(position, velocity, [0.0], Clock::new(0.0));
            for _ in 0..20 {
                circle.run(&mut orbit, &Collisions(1), &mut ());
                assert_eq!(orbit.spin, [0.0], "{orbit:?}");
            }
        }
    }

    #[test]
    fn under_the_specular_law_a_disk_slides_along_a_strip_and_keeps_its_spin() {
        let strip =
            Planar { table: tables::strip(1.0).unwrap(), law: Disk::new(&Specular, 0.5).expect("a γ in range") };
        let mut orbit = Orbit::<_, 2, 1, Conserved<_, 2>, _>::new([0.0, 0.5], [0.25, -1.0], [0.3], Clock::new(0.0));
        strip.run(&mut orbit, &Collisions(4), &mut ());
        assert_eq!((orbit.position, orbit.velocity, orbit.spin), ([0.875, 1.0], [0.25, -1.0], [0.3]));
        assert_eq!(orbit.track.time(), 3.5);
    }
}
