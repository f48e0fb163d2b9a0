//! Corners at which walls turn by next to nothing.
use super::*;
use geometry::shapes::curve::{Interval, ParametricCurve, ParametricFormula};

/// Turns from one that is smooth for every disk to one that is a corner for each of those below.
const TURNS: [f64; 8] = [1e-7, 3e-7, 5e-7, 1e-6, 3e-6, 1e-5, 3e-5, 1e-4];
const RADII: [f64; 8] = [1e-9, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.3];

/// A unit square whose floor turns in the middle, which lies here, upwards or downwards.
fn room(turn: f64, middle: Vector2<f64>, first: usize) -> Table {
    let mut corners = [[-0.5, 0.0], [0.0, -0.25 * turn], [0.5, 0.0], [0.5, 1.0], [-0.5, 1.0]];
    corners.rotate_left(first);
    table(polygon(&corners.map(|[x, y]| [middle.x + x, middle.y + y])))
}

#[test]
fn disks_move_along_walls_that_are_all_but_straight() {
    for turn in TURNS.iter().flat_map(|turn| [*turn, -turn]) {
        for radius in RADII {
            let area = (1.0 - 2.0 * radius) * (1.0 - 2.0 * radius);
            // where coordinates at the corner are as large as those of the walls, and where they are much smaller
            for middle in [v(0.5, 0.0), v(0.0, 0.0), v(0.0, 0.25 * turn)] {
                // whichever corner comes first
                for first in 0..5 {
                    let drawn = room(turn, middle, first);
                    let offset =
                        drawn.offset(radius).unwrap_or_else(|e| panic!("turn {turn}, radius {radius}, {middle}: {e}"));
                    let found = offset.table.area();
                    assert!((found - area).abs() <= turn.abs(), "turn {turn}, radius {radius}: {found}");
                }
            }
        }
    }
}

#[test]
fn where_walls_turn_by_next_to_nothing_centres_are_where_they_should_be() {
    for turn in TURNS.iter().flat_map(|turn| [*turn, -turn]) {
        for radius in RADII {
            check("all but straight", &room(turn, v(0.0, 0.0), 0), radius);
        }
    }
}

#[test]
fn a_disk_moves_in_a_needle_with_an_obtuse_corner() {
    // three corners all but in a line, the middle one nearest to the origin
    let drawn = table(polygon(&[
        [0.967_364_250_246_607_8, 0.936_335_400_888_472_7],
        [0.063_749_160_978_207_44, 0.061_761_726_836_500_36],
        [-0.565_609_907_673_370_8, -0.547_397_463_838_182_3],
    ]));
    let largest = drawn.largest_disk().radius;
    for share in [0.1, 0.5, 0.7, 0.8, 0.9, 0.99] {
        check("needle", &drawn, share * largest);
    }
    let too_large = 1.5 * largest;
    assert_eq!(drawn.offset(too_large).unwrap_err(), Error::NothingLeft { radius: too_large, largest });
}

/// `x = t`, `y = y₀ + a sin(3 (t − x₀))`
#[derive(Clone, Copy, Debug)]
struct Wave {
    middle: Vector2<f64>,
    size: f64,
}

impl ParametricFormula for Wave {
    fn jet(&self, t: f64) -> [[f64; 2]; 3] {
        let (sin, cos) = libm::sincos(3.0 * (t - self.middle.x));
        let a = self.size;
        [[t, self.middle.y + a * sin], [1.0, 3.0 * a * cos], [0.0, -9.0 * a * sin]]
    }
    fn jet_over(&self, t: Interval) -> [[Interval; 2]; 3] {
        let [sin, cos] = ((t + -self.middle.x) * 3.0).sin_cos();
        let a = self.size;
        [[t, sin * a + self.middle.y], [1.0.into(), cos * (3.0 * a)], [0.0.into(), sin * (-9.0 * a)]]
    }
}

#[test]
fn disks_move_along_curves_that_go_on_in_walls_with_next_to_no_turn() {
    // a unit square, the middle of whose floor is a wave that begins and ends at a small angle to the rest
    for turn in TURNS.iter().flat_map(|turn| [*turn, -turn]) {
        for middle in [v(0.0, 0.0), v(0.0, 1.0), v(100.0, 0.0)] {
            let wave = Wave { middle, size: turn / 3.0 };
            let range = [middle.x - 0.25, middle.x + 0.25];
            let [start, end] = range.map(|t| Vector2::from(wave.jet(t)[0]));
            let top = middle.y + 1.0;
            let corners = [
                v(middle.x - 0.5, start.y),
                start,
                end,
                v(middle.x + 0.5, end.y),
                v(middle.x + 0.5, top),
                v(middle.x - 0.5, top),
            ];
            let mut pieces = vec![];
            for (k, &from) in corners.iter().enumerate() {
                let to = corners[(k + 1) % corners.len()];
                if k == 1 {
                    let arcs = ParametricCurve::along(wave, range, [from, to]).unwrap();
                    pieces.extend(arcs.into_iter().map(|arc| Box::new(arc) as Box<dyn Piece>));
                } else {
                    pieces.push(Box::new(Segment::new(from, to).unwrap()));
                }
            }
            let drawn = table(pieces);
            for radius in RADII {
                check("a wave in a floor", &drawn, radius);
            }
        }
    }
}
