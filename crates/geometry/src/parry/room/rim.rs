//! Open surfaces that end inside a room.
use super::Room;
use crate::parry::Solid;
use nalgebra::Vector3;

impl Room {
    /// The first solid that is an open surface with a rim inside the room, if the other walls enclose that room: orbits come back from
    /// them and round the rim, to where there is no table by its side, but no wall either.
    pub(super) fn open_inside(&self) -> Option<usize> {
        (0..self.solids.len()).find(|&k| {
            let others =
                || self.solids.iter().enumerate().filter(move |(other, _)| *other != k).map(|(_, solid)| solid);
            let is_inside = |x: &Vector3<f64>| others().all(|solid: &Solid| solid.closest(x).distance > solid.slack(x));
            self.solids[k].ways_round().any(|way| way.iter().all(is_inside)) && super::container(others()).is_finite()
        })
    }
}
