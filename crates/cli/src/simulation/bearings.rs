//! Arc lengths of points on a piece, looked up by their directions from a point beside it.

use core::f64::consts::{PI, TAU};

use billiards::geometry::{Piece, Vector2};

/// Number of points of the piece whose directions are known.
const SAMPLES: usize = 1024;

/// Number of parts of a turn in which arc lengths are interpolated.
const PARTS: usize = 1024;

/// Arc length and distance of the points of a piece that is met at most once in each direction from a middle.
///
/// Accurate to a thousandth of a pixel where the piece is smooth, and much faster than a piece that has to search.
#[derive(Clone, Debug)]
pub(super) struct Bearings {
    middle: Vector2<f64>,
    /// Square of a distance from the middle beyond that of any point.
    reach: f64,
    length: f64,
    closed: bool,
    /// Arc length and distance from the middle in each part, as parabolas.
    parts: Vec<[[f64; 3]; 2]>,
}

/// The position of a direction along the sides of a square, from 0 to 4 over a turn.
fn along_square(d: Vector2<f64>) -> f64 {
    let along = d.x / (d.x.abs() + d.y.abs());
    if d.y < 0.0 { along + 3.0 } else { 1.0 - along }
}

/// The direction at which one of `parts` parts begins.
fn direction(part: usize, parts: usize) -> Vector2<f64> {
    let a = 4.0 * part as f64 / parts as f64;
    let along = if a < 2.0 { 1.0 - a } else { a - 3.0 };
    let across = 1.0 - along.abs();
    Vector2::new(along, if a < 2.0 { across } else { -across })
}

/// An angle between −π and π.
fn wrapped(angle: f64) -> f64 {
    angle - TAU * libm::rint(angle / TAU)
}

/// Points of a piece at equal arc lengths, the last at its end, as seen from a middle.
struct View {
    middle: Vector2<f64>,
    points: Vec<Vector2<f64>>,
    length: f64,
    closed: bool,
    /// The direction of the first point.
    first: f64,
    /// The sense in which the direction turns from one to the next, 1 or −1, and how far it has turned at each.
    sense: f64,
    turned: Vec<f64>,
}

impl View {
    /// `None` if some direction meets several points, or is nearly tangential to the piece.
    fn new(middle: Vector2<f64>, points: Vec<Vector2<f64>>, length: f64, closed: bool) -> Option<Self> {
        let angle = |p: &Vector2<f64>| libm::atan2(p.y - middle.y, p.x - middle.x);
        let step = |w: &[Vector2<f64>]| wrapped(angle(&w[1]) - angle(&w[0]));
        let sense = step(&points[..2]).signum();
        let mut turned = vec![0.0];
        for w in points.windows(2) {
            turned.push(turned[turned.len() - 1] + sense * step(w));
        }
        let whole = turned[SAMPLES];
        let once = if closed { (whole - TAU).abs() < 1e-6 } else { whole < 1.5 * PI };
        let steep = turned.windows(2).all(|w| w[1] - w[0] > whole * (0.01 / SAMPLES as f64));
        let first = angle(&points[0]);
        (once && steep).then_some(View { middle, points, length, closed, first, sense, turned })
    }

    /// How far one has turned at a direction, and whether the piece is seen in that direction or close to it.
    fn turn(&self, d: Vector2<f64>) -> (f64, bool) {
        let turn = self.sense * wrapped(libm::atan2(d.y, d.x) - self.first);
        let turn = if turn < 0.0 { turn + TAU } else { turn };
        // the greatest width of a part
        let (whole, width) = (self.turned[SAMPLES], 8.0 / PARTS as f64);
        if self.closed || turn <= whole + width { (turn, true) } else { (turn - TAU, turn > TAU - width) }
    }

    /// Arc length and distance at a given turn, by a polynomial through four points.
    fn known(&self, turn: f64) -> [f64; 2] {
        let above = self.turned.partition_point(|t| *t <= turn);
        // a closed piece continues beyond its ends
        let from = if self.closed { above } else { above.clamp(2, SAMPLES - 2) } + SAMPLES - 2;
        let four = [0, 1, 2, 3].map(|k| {
            let (j, laps) = ((from + k) % SAMPLES, ((from + k) / SAMPLES) as f64 - 1.0);
            let s = self.length * (laps + j as f64 / SAMPLES as f64);
            [self.turned[j] + laps * self.turned[SAMPLES], s, (self.points[j] - self.middle).norm()]
        });
        let mut sum = [0.0; 2];
        for (i, one) in four.iter().enumerate() {
            let others = four.iter().enumerate().filter(|(k, _)| *k != i);
            let weight = others.fold(1.0, |w, (_, other)| w * (turn - other[0]) / (one[0] - other[0]));
            sum = [sum[0] + weight * one[1], sum[1] + weight * one[2]];
        }
        sum
    }

    /// Arc length and distance in a part, as parabolas.
    fn part(&self, k: usize) -> [[f64; 3]; 2] {
        let [(begin, seen), (half, _), (end, still)] =
            [2 * k, 2 * k + 1, 2 * k + 2].map(|k| self.turn(direction(k, 2 * PARTS)));
        if !(seen && still) {
            return [[0.0; 3]; 2];
        }
        // forward, across the start of a closed piece
        let [here, between, there] = [0.0, half - begin, end - begin].map(|on| self.known(begin + wrapped(on)));
        [0, 1].map(|i| {
            let more = there[i] - here[i];
            [here[i], more, 4.0 * (between[i] - here[i] - 0.5 * more)]
        })
    }
}

impl Bearings {
    /// The bearings of a piece of finite length; `None` if it cannot be seen like this.
    pub(super) fn of(piece: &dyn Piece) -> Option<Self> {
        let length = piece.length();
        if !(length > 0.0 && length.is_finite()) {
            return None;
        }
        let point = |j: usize| piece.point_at(length * (j as f64 / SAMPLES as f64));
        let mut points: Vec<Vector2<f64>> = (0..SAMPLES).map(point).collect();
        let view = if let Some([a, b]) = piece.ends() {
            points.push(b);
            let (foot, beside) = ((a + b) * 0.5, Vector2::new(a.y - b.y, b.x - a.x));
            let middles = [foot + beside, foot - beside];
            middles.into_iter().find_map(|middle| View::new(middle, points.clone(), length, false))
        } else {
            let middle = points.iter().sum::<Vector2<f64>>() / SAMPLES as f64;
            points.push(points[0]);
            View::new(middle, points, length, true)
        }?;
        let parts = (0..PARTS).map(|k| view.part(k)).collect();
        let View { middle, points, closed, .. } = view;
        let reach = 1.0625 * points.iter().fold(0.0_f64, |reach, p| reach.max((p - middle).norm_squared()));
        Some(Bearings { middle, reach, length, closed, parts })
    }

    /// The arc length of a point, after moving it back by the one of these vectors that brings it closest to the
    /// piece.
    #[inline]
    pub(super) fn arc_length(&self, point: Vector2<f64>, shifts: &[Vector2<f64>]) -> f64 {
        let mut best = [0.0, f64::INFINITY];
        for shift in shifts {
            let d = point - shift - self.middle;
            if d.norm_squared() <= self.reach {
                let seen = self.seen(d);
                if seen[1] < best[1] {
                    best = seen;
                }
            }
        }
        best[0]
    }

    /// The arc length in a direction from the middle, and the distance of the point there from the piece.
    #[inline]
    fn seen(&self, d: Vector2<f64>) -> [f64; 2] {
        let a = along_square(d) * (PARTS as f64 / 4.0);
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a small number that is not negative"
        )]
        let part = (a as usize).min(PARTS - 1);
        let within = a - part as f64;
        let [s, distance] = self.parts[part].map(|[begin, more, bend]| begin + within * (more + (1.0 - within) * bend));
        let off = (d.x * d.x + d.y * d.y).sqrt() - distance;
        let s = if self.closed { s - self.length * libm::floor(s / self.length) } else { s.clamp(0.0, self.length) };
        [s, off.abs()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use billiards::geometry::tables;

    #[test]
    fn points_are_where_their_pieces_say_to_a_thousandth_of_a_pixel() {
        let tables = [
            tables::ellipse([2.0, 1.0]),
            tables::circle(0.5),
            tables::perturbed_polygon(5, 1.0, 0.0625),
            tables::mushroom(1.0, 0.5, 0.75),
            tables::sinai_torus(0.3, 1.0),
            tables::flower(4, 1.25, 2.0),
            tables::channel(1.0, 0.75, 0.125),
            tables::ellipse([2.0, 1.0]).and_then(|table| Ok(table.offset(0.05)?.table)),
        ];
        for table in tables.map(Result::unwrap) {
            for piece in table.pieces() {
                let bearings = Bearings::of(&**piece).unwrap();
                let length = piece.length();
                let pixel = table.perimeter() / 1000.0;
                for k in 0..=5000 {
                    let s = length * f64::from(k) / 5000.0;
                    let found = bearings.arc_length(piece.point_at(s), &[Vector2::zeros()]);
                    // a closed piece ends where it begins
                    let round = if piece.ends().is_none() { length } else { f64::INFINITY };
                    let off = (found - s).abs().min((round - (found - s).abs()).abs());
                    assert!(off < 1e-3 * pixel && (0.0..=length).contains(&found), "{piece:?}: {found} for {s}");
                }
            }
        }
    }

    #[test]
    fn on_a_lattice_the_copy_that_was_hit_is_found() {
        // the arcs of a channel are seen from so far away that copies come into reach
        for table in [tables::sinai_torus(0.3, 1.0).unwrap(), tables::channel(1.0, 0.75, 0.125).unwrap()] {
            for (number, piece) in table.pieces().iter().enumerate() {
                let shifts: Vec<_> = table.translations(number).collect();
                let bearings = Bearings::of(&**piece).unwrap();
                for (k, shift) in (1..100).zip(shifts.iter().cycle()) {
                    let s = piece.length() * f64::from(k) / 100.0;
                    let found = bearings.arc_length(piece.point_at(s) + shift, &shifts);
                    assert!((found - s).abs() < 1e-6, "{found} for {s}");
                }
            }
        }
    }

    #[test]
    fn lines_without_end_are_not_looked_up() {
        let strip = tables::strip(1.0).unwrap();
        assert!(strip.pieces().iter().all(|piece| Bearings::of(&**piece).is_none()));
    }
}
