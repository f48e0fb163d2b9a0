//! The billiard map in the frame of the wall, where the walls look the same from everywhere.
use crate::{
    billiard::{BallLaw, Motion},
    energy::EnergyKeeper,
    orbit::Orbit,
    track::Track,
};
use geometry::{Chord, Homogeneous, WallHit};
use lanes::{Lane, Mask};

/// Homogeneous walls and a law: the frame of the last hit rolls along the wall with the orbit.
///
/// In a circle and in a strip the normal and the tangential velocity at a collision depend on those at the last one and
/// on nothing else. Carried on as they are, they are not rounded to the directions of the plane and back, and they wait
/// for no search: faster, and without the drift of the phase that a rounded chord has.
#[derive(Clone, Copy, Debug)]
pub struct Rolling<'a, W, L> {
    /// What can be hit.
    pub walls: &'a W,
    /// What a hit does.
    pub law: &'a L,
}

/// The frame of the last hit.
#[derive(Clone, Copy, Debug)]
pub struct Frame<F: Lane> {
    place: [F; 2],
    /// Normal and tangential velocity.
    velocity: [F; 2],
    /// Whether there has been a hit yet.
    on_wall: F::Mask,
}

impl<W: Homogeneous, L: BallLaw<2, 1>> Motion<2, 1> for Rolling<'_, W, L> {
    type Carried<F: Lane> = Frame<F>;
    /// The frame of the hit, with the velocity of the arrival.
    type Arrival<F: Lane> = Frame<F>;

    fn start<F: Lane>(&self, zero: F) -> Frame<F> {
        Frame { place: [zero; 2], velocity: [zero; 2], on_wall: zero.lt(zero) }
    }
    fn restart<F: Lane>(&self, carried: &mut Frame<F>, new: F::Mask) {
        carried.on_wall = carried.on_wall & !new;
    }
    #[inline(always)]
    fn flight<F: Lane, K, T>(&self, orbit: &Orbit<F, 2, 1, K, T>, carried: &Frame<F>) -> (WallHit<F, 2>, Frame<F>) {
        let [vn, vt] = carried.velocity;
        let on = carried.on_wall;
        let mut chord = self.walls.chord(&carried.place, vn, vt);
        let mut hit = self.walls.landing(&chord);
        let mut normal = -vn;
        if (!on).any() {
            let first = self.walls.first_hit(&orbit.position, &orbit.velocity);
            let [vn, vt] = self.walls.arrival(&orbit.position, &orbit.velocity, &first);
            let place = self.walls.place(&first);
            chord = Chord {
                time: on.select(chord.time, first.time),
                place: [on.select(chord.place[0], place[0]), on.select(chord.place[1], place[1])],
                tangential: on.select(chord.tangential, vt),
            };
            normal = on.select(normal, vn);
            hit = self.walls.landing(&chord);
        }
        (hit, Frame { place: chord.place, velocity: [normal, chord.tangential], on_wall: on | !on })
    }
    #[inline(always)]
    fn collide<F: Lane, K: EnergyKeeper<F, 2, 1>, T: Track<F, 2, 1>>(
        &self,
        orbit: &mut Orbit<F, 2, 1, K, T>,
        carried: &mut Frame<F>,
        hit: &WallHit<F, 2>,
        arrival: &Frame<F>,
    ) -> F {
        orbit.track.fly(&orbit.position, &orbit.velocity, &orbit.spin, hit);
        *carried = *arrival;
        self.law.collide_in_frame(hit, &mut carried.velocity, &mut orbit.spin);
        orbit.keeper.leave_in_frame(&mut carried.velocity, &mut orbit.spin, self.beat());
        let [vn, vt] = carried.velocity;
        let [n1, n2] = hit.normal;
        orbit.position = hit.point;
        orbit.velocity = [vn * n1 - vt * n2, vn * n2 + vt * n1];
        arrival.velocity[0] * arrival.velocity[0]
    }
}
