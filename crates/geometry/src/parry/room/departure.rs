//! How paths leave edges on which they start.
use super::Room;
use crate::{Boundary, Line};

/// In units of the rounding: a path from an edge has left it after this distance.
const AWAY: f64 = 8.0;

/// How often this distance is doubled: a path that is not away then leaves at an angle below a thousandth, or runs along a wall.
const DOUBLINGS: i32 = 10;

impl Room {
    /// The time after which a path that starts on walls is away from them, where one of them could be hit at once although the path leads
    /// past its edge; `None` if the path leads out of the room, or along a wall within rounding.
    ///
    /// ```
    /// use geometry::{Line, Vector3, parry::{Room, Side, SolidSpec}};
    /// let cube = SolidSpec::Cuboid { size: [2.0; 3], rounding: 0.0 }.solid([0.0; 3], Side::Outside)?;
    /// let room = Room::new(vec![cube]);
    /// let from_edge = |velocity: [f64; 3]| Line { point: Vector3::new(1.0, 1.0, 0.0), velocity: velocity.into() };
    /// assert!(room.time_to_leave(&from_edge([-1.0, 2.0, 0.5])).is_some_and(|time| time < 1e-12));
    /// assert_eq!(room.time_to_leave(&from_edge([-1.0, -2.0, 0.5])), None);
    /// # Ok::<(), geometry::Error>(())
    /// ```
    pub fn time_to_leave(&self, path: &Line<3>) -> Option<f64> {
        let speed = path.velocity.norm();
        let rounding = self.solids.iter().map(|solid| solid.slack(&path.point)).fold(0.0, f64::max);
        // a power of two, so that coordinates with few digits keep these
        let first = libm::ldexp(1.0, libm::frexp(AWAY * rounding / speed).1);
        for k in 0..=DOUBLINGS {
            let time = first * libm::ldexp(1.0, k);
            let point = path.at(time);
            let distance = self.distance(&point);
            if distance < -rounding {
                return None;
            }
            let next = self.first_hit(&Line { point, ..*path }).map_or(f64::INFINITY, |hit| hit.time);
            if distance > rounding && next * speed > AWAY * rounding {
                return Some(time);
            }
        }
        None
    }
}
