//! What every piece promises, as functions that check it: for the shapes here and for your own.
mod whole;

use crate::{
    path::Line,
    piece::{Extent, Piece},
    plane::{GOLDEN_RATIO, PLASTIC_RATIOS, is_finite},
};
use core::f64::consts::PI;
use nalgebra::Vector2;

/// How well a piece keeps its promises: the greatest deviation seen, of each kind.
///
/// Lengths are relative to the size of the region (or of the coordinates, where a path leaves it), areas to its square. Rounding alone
/// accounts for about 10⁻¹⁵; the last four compare with difference quotients and with a polygon, which are themselves accurate to about
/// 10⁻⁹, 10⁻⁶, 10⁻¹⁰ and 10⁻¹⁰ for a curve whose radius of curvature is of the order of its size.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PieceReport {
    /// Paths that met the piece.
    pub hits: usize,
    /// Paths for which sampling found a crossing from the table's side before the one that was reported, if any was.
    pub missed: usize,
    /// Distance of the landing point from the point of the piece closest to it.
    pub off_boundary: f64,
    /// Distance of the landing point from where the path is at the time of the crossing.
    pub off_path: f64,
    /// `| |ν| − 1 |` for the normal.
    pub normal_length: f64,
    /// `ν·v/|v|` at a crossing, where it is positive: a crossing must lead out of the table.
    pub inward: f64,
    /// For a path that starts on the piece and returns to it, run backwards: the distance by which it misses its start, times the sine of
    /// the angle there.
    pub reversal: f64,
    /// `arc_length_of(landing_at(s)) − s`, and the distance between `point_at(arc_length_of(p))` and the point of the landing `p`.
    pub arc_length: f64,
    /// Distance of the piece from its extent, where it lies outside.
    pub extent: f64,
    /// Distance of the ends from `point_at(0)` and `point_at(length)`; of these two, for a closed curve.
    pub ends: f64,
    /// Distance of the graphs, if there are any, from the piece, and of each from where the one before it ends (from the piece's ends, for
    /// the first and the last). Rough graphs, of formulas with large errors, are farther from it than rounding.
    pub graphs: f64,
    /// The normals of the graphs against those of `closest`.
    pub graph_normals: f64,
    /// The normals of `landing_at`, and of `closest` for a point beside the piece, against the difference quotient of `point_at`.
    pub normal_direction: f64,
    /// The curvature against the difference quotient of the normal, times the size of the region.
    pub curvature: f64,
    /// The length against that of a polygon of points at equal arc lengths, extrapolated.
    pub length: f64,
    /// The area against that of the same polygon, extrapolated. That of an infinite piece must be NaN.
    pub area: f64,
}

impl PieceReport {
    /// The greatest of the deviations that should be rounding errors: all but those of graphs and the last four.
    pub fn rounding(&self) -> f64 {
        let lengths = [self.off_boundary, self.off_path, self.reversal, self.arc_length, self.extent, self.ends];
        lengths.into_iter().chain([self.normal_length, self.inward]).fold(0.0, worse)
    }

    fn note(field: &mut f64, deviation: f64) {
        *field = worse(*field, deviation);
    }
}

/// The greater one; NaN is the worst.
fn worse(a: f64, b: f64) -> f64 {
    if b > a || b.is_nan() { b } else { a }
}

/// Steps in which a path is followed to look for crossings that were missed.
const SAMPLES: u32 = 256;

/// Sends `paths` paths through a region and measures a piece against its promises (see [`Piece`]).
///
/// The starts fill the region evenly, and the directions the circle. For a piece of finite size `piece.extent()` is a good region. A
/// crossing counts as missed if the signed distance to the piece changes from the table's side to the other side before the reported time;
/// excursions shorter than 1/256 of the path escape this test.
///
/// ```
/// use geometry::{Piece, Vector2, check, shapes::Ellipse};
/// let ellipse = Ellipse::new(Vector2::zeros(), [2.0, 1.0], 0.3, true)?;
/// let report = check::piece(&ellipse, ellipse.extent(), 100);
/// assert_eq!(report.missed, 0);
/// assert!(report.rounding() < 1e-14);
/// # Ok::<(), geometry::Error>(())
/// ```
pub fn piece(piece: &dyn Piece, region: Extent, paths: u32) -> PieceReport {
    let span = region.max - region.min;
    let size = span.amax();
    let divides = piece.ends().is_none_or(|ends| ends.iter().all(|end| !end.amax().is_finite()));
    let mut report = PieceReport::default();
    for k in 0..paths {
        let k = f64::from(k) + 0.5;
        let part = PLASTIC_RATIOS.map(|a| k * a - libm::floor(k * a));
        let angle = 2.0 * PI * (k * GOLDEN_RATIO);
        let path = Line {
            point: region.min + span.component_mul(&Vector2::from(part)),
            velocity: Vector2::new(libm::cos(angle), libm::sin(angle)) * (0.5 + part[0]),
        };
        // a curve that divides the plane is the whole boundary: nothing is promised about paths that start behind it
        let at = piece.closest(&path.point);
        if !(divides && (path.point - at.point).dot(&at.normal) < 0.0) {
            follow(piece, &path, size, &mut report);
        }
    }
    parametrisation(piece, size, paths, &mut report);
    whole::whole(piece, size, &mut report);
    whole::graphs(piece, size, &mut report);
    report
}

/// The arc lengths \[L\] from the first of which the piece is sampled to the second: all of it, or a stretch of this size of an infinite
/// one.
fn stretch(piece: &dyn Piece, size: f64) -> [f64; 2] {
    let runs_to_its_end = piece.ends().is_some_and(|[_, end]| is_finite(&end));
    match (piece.length().is_finite(), runs_to_its_end) {
        (true, _) => [0.0, piece.length()],
        (false, true) => [-size, 0.0],
        (false, false) => [0.0, size],
    }
}

/// One path: its crossing, and the way on from there.
fn follow(piece: &dyn Piece, path: &Line<2>, size: f64, report: &mut PieceReport) {
    let time = piece.crossing(path).time();
    let until = time.min(2.0 * size / path.velocity.norm());
    if missed(piece, path, until, size) {
        report.missed += 1;
    }
    if time == f64::INFINITY {
        return;
    }
    report.hits += 1;
    let at = piece.landing(path, time);
    let size = size.max(at.point.amax());
    PieceReport::note(&mut report.off_path, (at.point - path.at(time)).norm() / size);
    PieceReport::note(&mut report.off_boundary, (at.point - piece.closest(&at.point).point).norm() / size);
    PieceReport::note(&mut report.normal_length, (at.normal.norm() - 1.0).abs());
    PieceReport::note(&mut report.inward, at.normal.dot(&path.velocity) / path.velocity.norm());
    // the specular way on, to the piece again, and back
    let velocity = path.velocity - at.normal * (2.0 * at.normal.dot(&path.velocity));
    let on = Line { point: at.point, velocity };
    let next = piece.crossing(&on).time();
    if next < f64::INFINITY && next > 0.0 {
        let there = piece.landing(&on, next).point;
        let back = Line { point: there, velocity: -velocity };
        let home = piece.landing(&back, piece.crossing(&back).time()).point;
        let sine = (at.normal.dot(&velocity) / velocity.norm()).abs();
        PieceReport::note(&mut report.reversal, sine * (home - at.point).norm() / size);
    }
}

/// Whether the path passes from the table's side to the other side before `until`.
fn missed(piece: &dyn Piece, path: &Line<2>, until: f64, size: f64) -> bool {
    let side = |t: f64| {
        let at = piece.closest(&path.at(t));
        (path.at(t) - at.point).dot(&at.normal)
    };
    // closer to the reported time than this, both are the same crossing
    let until = until * (1.0 - 1e-6);
    let (mut last, mut before) = (0.0, side(0.0));
    for k in 1..=SAMPLES {
        let t = until * (f64::from(k) / f64::from(SAMPLES));
        let after = side(t);
        if before > 1e-12 * size && after < -1e-12 * size {
            let (mut low, mut high) = (last, t);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if side(middle) > 0.0 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            // the sign also changes beside the piece, but at a distance from it, or at its ends
            let p = path.at(high);
            let at = piece.closest(&p).point;
            let ends = piece.ends().into_iter().flatten();
            if (p - at).norm() < 1e-9 * size && ends.into_iter().all(|end| (end - at).norm() > 1e-9 * size) {
                return true;
            }
        }
        (last, before) = (t, after);
    }
    false
}

/// Arc length, and the derivatives with respect to it.
fn parametrisation(piece: &dyn Piece, size: f64, points: u32, report: &mut PieceReport) {
    let [from, to] = stretch(piece, size);
    let length = to - from;
    let closed = piece.ends().is_none() && piece.length().is_finite();
    for k in 0..points {
        let s = from + length * ((f64::from(k) + 0.5) / f64::from(points));
        let at = piece.landing_at(s);
        let found = piece.arc_length_of(&at);
        let off = (found - s).abs();
        let off = if closed { off.min((length - off).abs()) } else { off };
        let again = (piece.point_at(found) - at.point).norm();
        PieceReport::note(&mut report.arc_length, off.max(again) / size);
        // a step of the cube root of the rounding error balances the two errors of a difference quotient
        let step = (1e-5 * size).min(0.25 * length / f64::from(points));
        let [before, after] = [s - step, s + step].map(|s| piece.landing_at(s));
        let tangent = (after.point - before.point) / (2.0 * step);
        let normal = Vector2::new(-tangent.y, tangent.x);
        // a point beside a wall, on the table's side, determines the face just as the arc length does
        let foot = piece.closest(&(at.point + at.normal * step));
        for told in [at, foot] {
            PieceReport::note(&mut report.normal_direction, (normal - told.normal).norm());
        }
        let turn = (after.normal - before.normal) / (2.0 * step);
        PieceReport::note(&mut report.curvature, size * (turn.dot(&tangent) + piece.curvature(&at.point)).abs());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        crossing::Crossing,
        piece::Landing,
        shapes::{
            Circle, Segment,
            curve::{self, Graph, Parametric},
        },
    };

    /// The unit circle.
    struct Round;

    impl Parametric for Round {
        fn at(&self, t: f64) -> [Vector2<f64>; 2] {
            let (sin, cos) = libm::sincos(t);
            [Vector2::new(cos, sin), Vector2::new(-sin, cos)]
        }
    }

    /// A circle with one promise broken.
    #[derive(Debug)]
    struct Broken(Circle, &'static str);

    impl Piece for Broken {
        fn crossing(&self, path: &Line<2>) -> Crossing {
            match self.1 {
                "misses" => Crossing::NEVER,
                "late" => Crossing { num: 1.001 * self.0.crossing(path).time(), den: 1.0 },
                _ => self.0.crossing(path),
            }
        }
        fn landing(&self, path: &Line<2>, time: f64) -> Landing {
            let Landing { point, normal } = self.0.landing(path, time);
            match self.1 {
                "long normal" => Landing { point, normal: normal * 1.001 },
                "outward normal" => Landing { point, normal: -normal },
                "off" => Landing { point: point * 1.001, normal },
                _ => Landing { point, normal },
            }
        }
        fn curvature(&self, point: &Vector2<f64>) -> f64 {
            if self.1 == "curvature" { -1.0 } else { self.0.curvature(point) }
        }
        fn length(&self) -> f64 {
            if matches!(self.1, "short" | "stretched") { 0.99 * self.0.length() } else { self.0.length() }
        }
        fn point_at(&self, s: f64) -> Vector2<f64> {
            self.0.point_at(match self.1 {
                "clockwise" => -s,
                "stretched" => s / 0.99,
                _ => s,
            })
        }
        fn arc_length_at(&self, point: &Vector2<f64>) -> f64 {
            let s = self.0.arc_length_at(point);
            match self.1 {
                "seam" if s < 0.25 * self.length() => s + self.length(),
                "half a turn" => s + 0.5 * self.length(),
                _ => s,
            }
        }
        fn closest(&self, point: &Vector2<f64>) -> Landing {
            self.0.closest(point)
        }
        fn ends(&self) -> Option<[Vector2<f64>; 2]> {
            (self.1 == "ends").then(|| [0.0, 1.001].map(|turns| self.0.point_at(turns * self.0.length())))
        }
        fn extent(&self) -> Extent {
            let Extent { min, max } = self.0.extent();
            Extent { min, max: if self.1 == "extent" { 0.999 * max } else { max } }
        }
        fn area(&self) -> f64 {
            if self.1 == "area" { 0.999 * self.0.area() } else { self.0.area() }
        }
        fn graphs(&self) -> Option<Vec<Graph>> {
            let range = if self.1 == "graphs back" { [2.0 * PI, 0.0] } else { [0.0, 2.0 * PI] };
            let mut graphs = curve::graphs(&Round, range, [Vector2::x(); 2], 1.0)?;
            match self.1 {
                "graphs beside" => graphs = graphs.iter().map(|graph| graph.translated([1e-3, 0.0])).collect(),
                "a graph missing" => {
                    graphs.remove(1);
                }
                "no graphs" => graphs.clear(),
                _ => {}
            }
            Some(graphs)
        }
    }

    fn report(promise: &'static str) -> PieceReport {
        let circle = Circle::new(Vector2::zeros(), 1.0, true).unwrap();
        piece(&Broken(circle, promise), circle.extent(), 50)
    }

    #[test]
    fn every_broken_promise_shows() {
        let whole = report("none");
        assert!(whole.missed == 0 && whole.rounding() < 1e-14, "{whole:?}");
        assert!(whole.normal_direction < 1e-9 && whole.curvature < 1e-5, "{whole:?}");
        assert!(whole.length < 1e-11 && whole.area < 1e-11, "{whole:?}");
        assert!(whole.graphs < 1e-15 && whole.graph_normals < 1e-14, "{whole:?}");
        assert!(report("misses").missed > 30);
        assert!(report("late").missed > 30 && report("late").off_path > 1e-4);
        assert!(report("long normal").normal_length > 5e-4);
        assert!(report("outward normal").inward > 0.5);
        assert!(report("off").off_boundary > 4e-4);
        assert!(report("curvature").curvature > 1.0);
        assert!(report("extent").extent > 4e-4 && report("ends").ends > 1e-3);
        assert!(report("short").ends > 0.01 && report("short").length < 1e-11);
        assert!(report("stretched").ends < 1e-15 && report("stretched").length > 0.01);
        assert!(report("area").area > 5e-4);
        assert!(report("graphs beside").graphs > 4e-4 && report("a graph missing").graphs > 0.01);
        assert_eq!(report("no graphs").graphs, f64::INFINITY);
        assert!(report("graphs back").graphs < 1e-15 && report("graphs back").graph_normals > 1.0);
        assert!(report("clockwise").arc_length > 0.1 && report("clockwise").normal_direction > 1.0);
    }

    #[test]
    fn a_closed_curve_may_tell_the_arc_length_of_a_place_from_either_side_of_its_seam() {
        // a circle whose arc lengths run from a quarter of it to five quarters
        let report = report("seam");
        assert!(report.rounding() < 1e-14, "{report:?}");
        // but not half a turn off
        assert!(self::report("half a turn").arc_length > 1.0);
    }

    #[test]
    fn paths_beside_a_segment_are_not_missed_by_it() {
        let segment = Segment::new(Vector2::new(-0.3, 0.0), Vector2::new(0.3, 0.1)).unwrap();
        let region = Extent::of([Vector2::new(-1.0, -1.0), Vector2::new(1.0, 1.0)]);
        let report = piece(&segment, region, 200);
        assert!(report.missed == 0 && report.hits > 5 && report.rounding() < 1e-14, "{report:?}");
    }
}
