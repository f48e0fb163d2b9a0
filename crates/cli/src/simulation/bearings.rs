//! Arc lengths of points on a piece, looked up by their directions from points beside it.

use core::f64::consts::{PI, TAU};

use billiards::geometry::{Piece, Vector2};

/// Numbers of steps between points whose directions are known, along a whole piece and along one of its arcs: what smooth curves need to
/// be known as well as `Bearings` are asked to, with cubic polynomials between the points.
const STEPS: usize = 1024;
const STEPS_OF_ARC: usize = 512;

/// Number of parts of a turn in which arc lengths are interpolated, by parabolas.
const PARTS: usize = 1024;

/// Arc length and distance of the points of arcs that are met at most once in each direction from a middle.
///
/// As accurate as is asked for, and much faster than a piece that has to search. A piece is one arc where that is possible, and is else cut
/// into halves, and these again.
#[derive(Clone, Debug)]
pub(super) struct Bearings {
    arcs: Vec<Arc>,
    length: f64,
    closed: bool,
}

/// An arc of a piece, as seen from a middle.
#[derive(Clone, Debug)]
struct Arc {
    middle: Vector2<f64>,
    /// Square of a distance from the middle beyond that of any point.
    reach: f64,
    /// Arc lengths at its ends; without bounds for a whole closed piece.
    ends: [f64; 2],
    /// Arc length and distance from the middle in each part, as parabolas; an infinite distance where the arc is not seen.
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

/// Points of an arc at equal arc lengths, the last at its end, as seen from a middle.
struct View {
    middle: Vector2<f64>,
    points: Vec<Vector2<f64>>,
    /// Arc length of the first point, and from each to the next.
    from: f64,
    step: f64,
    closed: bool,
    /// The direction of the first point.
    first: f64,
    /// The sense in which the direction turns from one to the next, 1 or −1, and how far it has turned at each.
    sense: f64,
    turned: Vec<f64>,
}

/// Points of an arc or of a whole piece at equal arc lengths, an odd number: from every other one the rest is interpolated.
struct Sampled {
    points: Vec<Vector2<f64>>,
    from: f64,
    half_step: f64,
    closed: bool,
    /// How far interpolated arc lengths may be off.
    most: f64,
}

impl Sampled {
    /// Steps between every other point.
    fn steps(&self) -> usize {
        self.points.len() / 2
    }

    /// All of them as one arc.
    fn arc(&self) -> Option<Arc> {
        self.middles().into_iter().find_map(|middle| Some(View::new(middle, self)?.arc()).filter(|arc| arc.knows(self)))
    }

    /// Points from which the arc may be seen: from beside it, or from near its chord, where it ends in a cusp or bends back.
    fn middles(&self) -> Vec<Vector2<f64>> {
        if self.closed {
            return vec![self.points[1..].iter().sum::<Vector2<f64>>() / (self.points.len() - 1) as f64];
        }
        let (a, b) = (self.points[0], self.points[self.points.len() - 1]);
        let (foot, beside) = ((a + b) * 0.5, Vector2::new(a.y - b.y, b.x - a.x));
        [1.0, -1.0, 0.25, -0.25, 0.0].map(|share| foot + beside * share).into()
    }
}

/// A piece that is cut into arcs.
struct Cut<'a> {
    piece: &'a dyn Piece,
    length: f64,
    end: Vector2<f64>,
    most: f64,
    /// How many arcs there may be.
    arcs: usize,
}

impl Cut<'_> {
    /// Its points between two arc lengths, all of them if it is closed.
    fn points(&self, [from, to]: [f64; 2], steps: usize, closed: bool) -> Sampled {
        let half_step = (to - from) / (2 * steps) as f64;
        let point = |j: usize| self.piece.point_at(from + half_step * j as f64);
        let mut points: Vec<_> = (0..2 * steps).map(point).collect();
        points.push(if to < self.length { self.piece.point_at(to) } else { self.end });
        Sampled { points, from, half_step, closed, most: self.most }
    }

    /// The arcs that can be seen between two arc lengths; `None` if there would be too many.
    fn arcs(&self, [from, to]: [f64; 2], arcs: &mut Vec<Arc>) -> Option<()> {
        if arcs.len() >= self.arcs || !(to - from > self.length / (64 * self.arcs) as f64) {
            return None;
        }
        if let Some(arc) = self.points([from, to], STEPS_OF_ARC, false).arc() {
            arcs.push(arc);
            return Some(());
        }
        let middle = 0.5 * (from + to);
        self.arcs([from, middle], arcs)?;
        self.arcs([middle, to], arcs)
    }
}

impl View {
    /// `None` if some direction meets several points, or is nearly tangential to the arc.
    fn new(middle: Vector2<f64>, of: &Sampled) -> Option<Self> {
        let closed = of.closed;
        let points: Vec<Vector2<f64>> = of.points.iter().step_by(2).copied().collect();
        let angle = |p: &Vector2<f64>| libm::atan2(p.y - middle.y, p.x - middle.x);
        let turn = |w: &[Vector2<f64>]| wrapped(angle(&w[1]) - angle(&w[0]));
        let sense = turn(&points[..2]).signum();
        let mut turned = vec![0.0];
        for w in points.windows(2) {
            turned.push(turned[turned.len() - 1] + sense * turn(w));
        }
        let steps = of.steps();
        let whole = turned[steps];
        // around the middle, and not beside it or twice around, but for rounding; or open, with a gap where one is past the ends
        let once = if closed { (whole - TAU).abs() < 1e-6 } else { whole < 1.5 * PI };
        // no tangent goes through the middle, or close to it: there a direction would not tell the place
        let steep = turned.windows(2).all(|w| w[1] - w[0] > whole * 0.01 / steps as f64);
        let (first, from, step) = (angle(&points[0]), of.from, 2.0 * of.half_step);
        (once && steep).then_some(View { middle, points, from, step, closed, first, sense, turned })
    }

    /// Number of steps.
    fn steps(&self) -> usize {
        self.points.len() - 1
    }

    /// How far one has turned at a direction, and whether the piece is seen in that direction or close to it.
    fn turn(&self, d: Vector2<f64>) -> (f64, bool) {
        let turn = self.sense * wrapped(libm::atan2(d.y, d.x) - self.first);
        let turn = if turn < 0.0 { turn + TAU } else { turn };
        // the greatest width of a part
        let (whole, width) = (self.turned[self.steps()], 8.0 / PARTS as f64);
        if self.closed || turn <= whole + width { (turn, true) } else { (turn - TAU, turn > TAU - width) }
    }

    /// Arc length and distance at a given turn, by a polynomial through four points.
    fn known(&self, turn: f64) -> [f64; 2] {
        let above = self.turned.partition_point(|t| *t <= turn);
        let steps = self.steps();
        // a closed piece continues beyond its ends
        let before = if self.closed { above } else { above.clamp(2, steps - 2) } + steps - 2;
        let four = [0, 1, 2, 3].map(|k| {
            let (j, laps) = ((before + k) % steps, ((before + k) / steps) as f64 - 1.0);
            let s = self.from + self.step * (laps * steps as f64 + j as f64);
            [self.turned[j] + laps * self.turned[steps], s, (self.points[j] - self.middle).norm()]
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
            return [[0.0; 3], [f64::INFINITY, 0.0, 0.0]];
        }
        // forward, across the start of a closed piece
        let [here, between, there] = [0.0, half - begin, end - begin].map(|on| self.known(begin + wrapped(on)));
        [0, 1].map(|i| {
            let more = there[i] - here[i];
            [here[i], more, 4.0 * (between[i] - here[i] - 0.5 * more)]
        })
    }

    fn arc(&self) -> Arc {
        let parts = (0..PARTS).map(|k| self.part(k)).collect();
        let farthest = self.points.iter().fold(0.0_f64, |reach, p| reach.max((p - self.middle).norm_squared()));
        let end = self.from + self.step * self.steps() as f64;
        let ends = if self.closed { [f64::NEG_INFINITY, f64::INFINITY] } else { [self.from, end] };
        // between these points a curve may be a little farther away
        Arc { middle: self.middle, reach: 1.0625 * farthest, ends, parts }
    }
}

impl Arc {
    /// Whether it finds the points of which it is made, and those between.
    fn knows(&self, Sampled { points, from, half_step, closed, most }: &Sampled) -> bool {
        let length = half_step * (points.len() - 1) as f64;
        let is_known = |(j, point): (usize, &Vector2<f64>)| {
            let off = (self.seen(point - self.middle)[0] - from - half_step * j as f64).abs();
            off <= *most || (*closed && (off - length).abs() <= *most)
        };
        points.iter().enumerate().all(is_known)
    }

    /// The arc length in a direction from the middle, and the distance of the point there from the arc: along it, beyond its ends.
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
        let [from, to] = self.ends;
        [s, off.abs() + (from - s).max(s - to).max(0.0)]
    }
}

impl Bearings {
    /// The bearings of a piece of finite length, accurate to `most` \[L\], in at most this many arcs; `None` if it cannot be seen like
    /// this.
    pub(super) fn of(piece: &dyn Piece, most: f64, arcs: usize) -> Option<Self> {
        let length = piece.length();
        if !(length > 0.0 && length.is_finite()) {
            return None;
        }
        let ends = piece.ends();
        let (closed, end) = (ends.is_none(), ends.map_or_else(|| piece.point_at(0.0), |[_, end]| end));
        let cut = Cut { piece, length, end, most, arcs };
        let all = cut.points([0.0, length], STEPS, closed);
        let mut arcs = Vec::from_iter(all.arc());
        if arcs.is_empty() {
            cut.arcs([0.0, length], &mut arcs)?;
        }
        let bearings = Bearings { arcs, length, closed };
        // not where two arcs lie on each other
        let is_known = |(j, point): (usize, &Vector2<f64>)| {
            let off = (bearings.arc_length(*point, &[Vector2::zeros()]) - all.half_step * j as f64).abs();
            off <= 2.0 * most || (closed && (off - length).abs() <= 2.0 * most)
        };
        all.points.iter().enumerate().all(is_known).then_some(bearings)
    }

    /// The arc length of a point, after moving it back by the one of these vectors that brings it closest to the
    /// piece.
    #[inline]
    pub(super) fn arc_length(&self, point: Vector2<f64>, shifts: &[Vector2<f64>]) -> f64 {
        let mut best = [0.0, f64::INFINITY];
        for shift in shifts {
            for arc in &self.arcs {
                let d = point - shift - arc.middle;
                if d.norm_squared() <= arc.reach {
                    let seen = arc.seen(d);
                    if seen[1] < best[1] {
                        best = seen;
                    }
                }
            }
        }
        let [s, _] = best;
        if self.closed { s - self.length * libm::floor(s / self.length) } else { s.clamp(0.0, self.length) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Source;
    use crate::scene::{Request, Scene};
    use crate::simulation::{Body, Simulation};
    use billiards::geometry::{Table, tables};

    /// Arc lengths of points are right to a thousandth of a pixel.
    fn judge(table: &Table) {
        let pixel = table.perimeter() / 1000.0;
        for piece in table.pieces() {
            let bearings = Bearings::of(&**piece, 5e-4 * pixel, 64).unwrap();
            let length = piece.length();
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
        for table in tables {
            judge(&table.unwrap());
        }
    }

    /// The region of centres of a table, from its lines in a scene.
    fn of_scene(table: &str) -> Table {
        let text = format!(
            "law = \"specular\"\n[[orbit]]\nposition = [0.2, 0.125]\nvelocity = [1, 0.5]\n[run]\ncollisions = 1\n{table}\n"
        );
        let scene = Scene::parse(&Source::new("table.toml", &text), &Request::default()).unwrap();
        let Body::Plane(planar) = Simulation::new(scene).unwrap().body else { panic!("{table}") };
        planar.centres
    }

    #[test]
    fn curves_with_cusps_dents_and_waves_are_looked_up_in_arcs() {
        for curve in [
            // a cardioid, a nephroid, an epicycloid, a hypocycloid, a rose, a crescent, a banana, a snake, a spike, a needle
            "polar = \"1 + cos(t)\"",
            "x = \"3*cos(t) - cos(3*t)\", y = \"3*sin(t) - sin(3*t)\"",
            "x = \"6*cos(t) - cos(6*t)\", y = \"6*sin(t) - sin(6*t)\"",
            "x = \"4*cos(t) + cos(4*t)\", y = \"4*sin(t) - sin(4*t)\"",
            "polar = \"abs(cos(2*t))\", center = [-0.3, 0]",
            "x = \"0.1 - (1 + 0.2*sin(t))*cos(2.5*cos(t)) + 1.1\", y = \"(1 + 0.2*sin(t))*sin(2.5*cos(t))\"",
            "x = \"cos(t)\", y = \"0.5*sin(t) + 0.9*cos(t)^2\"",
            "x = \"2*cos(t)\", y = \"0.4*sin(t) + sin(2*cos(t)) - 0.2\"",
            "polar = \"1 + 0.3*exp(-((t-pi)/0.004)^2)\"",
            "x = \"60*cos(t)\", y = \"sin(t)\"",
        ] {
            let table = of_scene(&format!("[table]\nboundary = [{{ curve = {{ {curve} }} }}]"));
            judge(&table);
        }
    }

    #[test]
    fn on_a_lattice_the_copy_that_was_hit_is_found() {
        // the arcs of a channel are seen from so far away that copies come into reach; where the floor ends, its copy goes on
        let chain = "chain = { from = [0, 0], edges = [{ line_to = [2, 0] }] }";
        let ceiling = "chain = { from = [2, 1], edges = [{ line_to = [0, 1] }] }";
        let channel = format!("[table]\nlattice = [[2, 0]]\nboundary = [{{ {chain} }}, {{ {ceiling} }}]");
        for table in
            [tables::sinai_torus(0.3, 1.0).unwrap(), tables::channel(1.0, 0.75, 0.125).unwrap(), of_scene(&channel)]
        {
            for (number, piece) in table.pieces().iter().enumerate() {
                let shifts: Vec<_> = table.translations(number).collect();
                let most = 1e-6 * piece.length();
                let bearings = Bearings::of(&**piece, most, 1).unwrap();
                for (k, shift) in (1..1000).zip(shifts.iter().cycle()) {
                    for share in [1e-3 * f64::from(k), 1e-5 * f64::from(k), 1.0 - 1e-5 * f64::from(k)] {
                        let s = piece.length() * share;
                        let found = bearings.arc_length(piece.point_at(s) + shift, &shifts);
                        assert!((found - s).abs() < 2.0 * most, "{found} for {s}");
                    }
                }
            }
        }
    }

    #[test]
    fn lines_without_end_are_not_looked_up() {
        let strip = tables::strip(1.0).unwrap();
        assert!(strip.pieces().iter().all(|piece| Bearings::of(&**piece, 1e-6, 64).is_none()));
    }
}
