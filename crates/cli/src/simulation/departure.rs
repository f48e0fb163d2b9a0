//! How paths leave a corner in which they start.

use billiards::Track;
use billiards::geometry::{Line, Table, Vector2, WallHit, Walls, WithWalls};

use super::engine::Watched;

/// The time after which a path that leads from a corner into the table is away from the walls that meet there: 0 unless it would hit one
/// of them at once, as rounding hides that it leaves the end of that wall. `None` if the path runs along one of them, within rounding.
///
/// Points that differ by less than `rounding` \[L\] cannot be told apart.
pub(super) fn time_to_leave(table: &Table, path: Line<2>, rounding: f64) -> Option<f64> {
    table.with_walls(Departure { path, rounding })
}

/// An orbit from its start, where the engine takes over after this time.
pub(super) fn departed<T: Track<f64, N, S>, const N: usize, const S: usize>(
    mut orbit: Watched<N, S, T>,
    departure: f64,
) -> Watched<N, S, T> {
    if departure > 0.0 {
        let point = core::array::from_fn(|i| orbit.position[i] + departure * orbit.velocity[i]);
        let away = WallHit { time: departure, ..WallHit::never(point) };
        orbit.track.fly(&orbit.position, &orbit.velocity, &orbit.spin, &away);
        orbit.position = point;
    }
    orbit
}

struct Departure {
    path: Line<2>,
    rounding: f64,
}

/// In units of the rounding: a path from a corner has left it after this distance, and a path on the free side of a corner passes it at
/// half this distance.
const AWAY: f64 = 8.0;

impl WithWalls<2> for Departure {
    type Output = Option<f64>;
    fn run<W: Walls<2>>(self, walls: &W) -> Option<f64> {
        let Line { point, velocity } = self.path;
        let soon = AWAY * self.rounding / libm::hypot(velocity.x, velocity.y);
        let flight = |point: Vector2<f64>| walls.hit(&Line { point, velocity }).map_or(f64::INFINITY, |hit| hit.time);
        if soon < flight(point) {
            return Some(0.0);
        }
        // all walls of the corner lie on one side of the path: on its other side, it is free up to the first hit
        let aside = Vector2::new(-velocity.y, velocity.x) * (0.5 * soon);
        let free = flight(point + aside).max(flight(point - aside));
        // a power of two, so that coordinates with few digits keep these
        let mut time = libm::ldexp(1.0, libm::frexp(soon).1);
        while time < 0.5 * free {
            if soon < flight(point + velocity * time) {
                return Some(time);
            }
            time *= 2.0;
        }
        None
    }
}
