//! A wall with the table on both sides that a path meets again after it has left it.

use super::*;
use geometry::{
    MeetingKind, meetings,
    shapes::curve::{Interval, ParametricCurve, ParametricFormula},
};

/// `(1 + p t) (cos t, sin t)`
#[derive(Clone, Copy, Debug)]
struct Spiral(f64);

impl Spiral {
    /// Two turns, there and back, in a circle.
    fn table(self, around: f64) -> Table {
        let face = |range: [f64; 2]| {
            let ends = range.map(|t| self.jet(t)[0].into());
            ParametricCurve::along(self, range, ends)
                .unwrap()
                .into_iter()
                .map(|piece| Box::new(piece) as Box<dyn Piece>)
        };
        let turns = 4.0 * core::f64::consts::PI;
        let circle = Circle::new(Vector2::zeros(), around, true).unwrap();
        let pieces = face([0.0, turns]).chain(face([turns, 0.0])).chain([Box::new(circle) as Box<dyn Piece>]);
        Table::new(pieces.collect()).unwrap()
    }
}

impl ParametricFormula for Spiral {
    fn jet(&self, t: f64) -> [[f64; 2]; 3] {
        let ((sin, cos), p) = (libm::sincos(t), self.0);
        let r = 1.0 + p * t;
        [
            [r * cos, r * sin],
            [p * cos - r * sin, p * sin + r * cos],
            [-2.0 * p * sin - r * cos, 2.0 * p * cos - r * sin],
        ]
    }
    fn jet_over(&self, t: Interval) -> [[Interval; 2]; 3] {
        let ([sin, cos], p) = (t.sin_cos(), self.0);
        let r = t * p + 1.0;
        [
            [r * cos, r * sin],
            [cos * p - r * sin, sin * p + r * cos],
            [sin * (-2.0 * p) - r * cos, cos * (2.0 * p) - r * sin],
        ]
    }
}

/// The flights of a specular orbit: from where, which way, and how long.
struct Flights {
    start: Line<2>,
    count: usize,
}

impl WithWalls<2> for Flights {
    type Output = Vec<(Line<2>, f64)>;
    fn run<W: Walls<2>>(self, walls: &W) -> Self::Output {
        let mut path = self.start;
        let mut flights = vec![];
        for _ in 0..self.count {
            let hit = walls.hit(&path).unwrap();
            flights.push((path, hit.time));
            if hit.corner {
                break;
            }
            let v = path.velocity;
            path = Line { point: hit.point, velocity: v - hit.normal * (2.0 * v.dot(&hit.normal)) };
        }
        flights
    }
}

#[test]
fn a_path_behind_one_turn_of_a_spiral_meets_the_next() {
    let path = Line {
        point: Vector2::new(2.849_648_332_445_168_5, -0.240_062_709_153_691_2),
        velocity: Vector2::new(0.033_533_311_335_941_715, -0.999_437_600_368_750_8),
    };
    let hit = Spiral(0.3).table(6.0).with_walls(Ask(path)).unwrap();
    assert!((hit.time - 3.171_787_607).abs() < 1e-9, "{hit:?}");
}

/// That a flight crosses no piece on the way.
#[track_caller]
fn passes_through_nothing(name: &str, table: &Table, path: &Line<2>, time: f64) {
    let flight = Segment::new(path.point, path.at(time)).unwrap();
    let length = flight.length();
    let is_inner = |at: f64| at.min(length - at) > 1e-7 * length.max(1e-3);
    for piece in table.pieces() {
        let met = meetings(&flight, &**piece);
        let met = met.iter().find(|m| m.kind == MeetingKind::Crossing && is_inner(m.at[0]));
        assert!(met.is_none(), "{name}: {path:?} {time} {met:?}");
    }
}

#[test]
fn no_flight_about_a_spiral_passes_through_it() {
    let mut random = Random(21);
    // whose turns are 1.9, 0.09 and 0.0006 apart; and the parallels of one
    let tables = [
        ("wide", 0.3, Spiral(0.3).table(6.0)),
        ("narrow", 1.0 / 64.0, Spiral(1.0 / 64.0).table(1.5)),
        ("very narrow", 1e-4, Spiral(1e-4).table(1.25)),
        ("parallels", 0.3, Spiral(0.3).table(6.0).offset(0.125).unwrap().table),
    ];
    for (name, growth, table) in tables {
        let mut paths = vec![];
        let mut starts = orbit_starts(&table, 8, &mut random);
        let between = 1.0 + growth * core::f64::consts::PI;
        starts.extend((0..4).map(|_| Line { point: Vector2::new(between, 0.0), velocity: random.velocity() }));
        for start in starts {
            let flights = table.with_walls(Flights { start, count: 64 });
            for (path, time) in &flights {
                passes_through_nothing(name, &table, path, *time);
            }
            paths.extend(flights.into_iter().map(|(path, _)| path));
        }
        assert!(paths.len() > 400, "{name}: {}", paths.len());
        table.with_walls(side_by_side::SameBits { name, paths: &paths });
    }
}

#[test]
fn a_path_that_hardly_leaves_a_spiral_is_on_the_side_to_which_it_goes() {
    for growth in [0.3, 1.0 / 64.0] {
        let table = Spiral(growth).table(6.0);
        let mut paths = vec![];
        for (k, piece) in (0..40).flat_map(|k| table.pieces()[..2].iter().map(move |piece| (k, piece))) {
            let here = piece.landing_at(piece.length() * (0.011 + 0.021 * f64::from(k)));
            let along = Vector2::new(here.normal.y, -here.normal.x);
            let curvature = piece.curvature(&here.point);
            for exponent in 6..40 {
                let slope = libm::ldexp(0.75, -exponent);
                for forward in [along, -along] {
                    let path = Line { point: here.point, velocity: forward + here.normal * slope };
                    let hit = table.with_walls(Ask(path)).unwrap();
                    // on the hollow side after a chord, if that is one; on the other only at another turn
                    let way = hit.time * path.velocity.norm();
                    let least = if curvature > 0.0 { slope / curvature } else { 0.25 * growth };
                    if curvature < 0.0 || slope > 1e-6 {
                        assert!(way > least, "{path:?} {hit:?} {curvature}");
                        passes_through_nothing("flat", &table, &path, hit.time);
                    }
                    paths.push(path);
                }
            }
        }
        table.with_walls(side_by_side::SameBits { name: "flat", paths: &paths });
    }
}
