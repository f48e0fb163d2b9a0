//! Curves cut into polynomial graphs: right to rounding, and only where they are smooth.
#![allow(clippy::unwrap_used, reason = "tests panic where they fail")]
mod formulas;
mod random;

use core::f64::consts::PI;
use formulas::Clover;
use geometry::{
    Hit, Line, Piece, Table, Vector2, WallHit, Walls, WithWalls,
    shapes::{
        Circle, Ellipse, Segment,
        curve::{Interval, Polar, PolarFormula},
    },
    walls::Graphs,
};
use lanes::{Lane, Twin};
use random::Random;

/// `r = 1 + |cos φ|³/10`, whose third derivative jumps.
#[derive(Clone, Copy, Debug)]
struct Kinked;

impl PolarFormula for Kinked {
    fn jet(&self, angle: f64) -> [f64; 3] {
        let (sin, cos) = libm::sincos(angle);
        let size = cos.abs();
        [1.0 + 0.1 * size * cos * cos, -0.3 * size * cos * sin, 0.3 * size * (2.0 * sin * sin - cos * cos)]
    }
    fn jet_over(&self, angle: Interval) -> [Interval; 3] {
        let [sin, cos] = angle.sin_cos();
        let size = cos.abs();
        let second = (sin.square() * 2.0 - cos.square()) * size * 0.3;
        [size * cos.square() * 0.1 + 1.0, size * cos * sin * -0.3, second]
    }
}

/// A circle with a spike far narrower than the distance between any points that are looked at.
#[derive(Clone, Copy, Debug)]
struct Spiked;

impl Spiked {
    const PLACE: f64 = 1.234_567;
    const WIDTH: f64 = 1e-7;
}

impl PolarFormula for Spiked {
    fn jet(&self, angle: f64) -> [f64; 3] {
        let u = (angle - Spiked::PLACE) / Spiked::WIDTH;
        let spike = 1e-4 * libm::exp(-u * u);
        let w = Spiked::WIDTH;
        [1.0 + spike, -2.0 * u * spike / w, (4.0 * u * u - 2.0) * spike / (w * w)]
    }
    fn jet_over(&self, angle: Interval) -> [Interval; 3] {
        let w = Spiked::WIDTH;
        let u = (angle + -Spiked::PLACE) * (1.0 / w);
        let spike = (-u.square()).exp() * 1e-4;
        let second = (u.square() * 4.0 + -2.0) * spike * (1.0 / (w * w));
        [spike + 1.0, u * spike * (-2.0 / w), second]
    }
}

/// `r = 1 + Σ a cos(kφ + p)`, some with the absolute value of the cosine.
#[derive(Clone, Debug)]
struct Sum(Vec<Wave>);

#[derive(Clone, Copy, Debug)]
struct Wave {
    amount: f64,
    count: f64,
    phase: f64,
    kinks: bool,
}

impl PolarFormula for Sum {
    fn jet(&self, angle: f64) -> [f64; 3] {
        let mut jet = [1.0, 0.0, 0.0];
        for &Wave { amount, count, phase, kinks } in &self.0 {
            let (sin, cos) = libm::sincos(count * angle + phase);
            let signed = if kinks { amount * cos.signum() } else { amount };
            jet[0] += signed * cos;
            jet[1] -= signed * count * sin;
            jet[2] -= signed * count * count * cos;
        }
        jet
    }
    fn jet_over(&self, angle: Interval) -> [Interval; 3] {
        let mut jet = [1.0, 0.0, 0.0].map(Interval::from);
        for &Wave { amount, count, phase, kinks } in &self.0 {
            let [sin, cos] = (angle * count + phase).sin_cos();
            if kinks && cos.contains(0.0) {
                let slope = sin.union(-sin) * (amount * count);
                jet = [jet[0] + cos.abs() * amount, jet[1] + slope, Interval::ENTIRE];
            } else {
                let signed = if kinks && cos.low < 0.0 { -amount } else { amount };
                let slopes = [sin * (-signed * count), cos * (-signed * count * count)];
                jet = [jet[0] + cos * signed, jet[1] + slopes[0], jet[2] + slopes[1]];
            }
        }
        jet
    }
}

/// The first hit of a path, with all pieces at once.
struct First(Line<2>);

impl WithWalls<2> for First {
    type Output = Option<Hit<2>>;
    fn run<W: Walls<2>>(self, walls: &W) -> Option<Hit<2>> {
        walls.hit(&self.0)
    }
}

/// Offsets that nearly reach the centres of curvature, of formulas in which rounding is multiplied by a dozen waves: asked as formulas,
/// they take a thousand times as long.
#[test]
fn parallels_of_many_waves_are_graphs_that_are_as_far_from_the_base_as_they_should() {
    let wave = |amount: f64, count: f64, phase: f64, kinks: bool| Wave { amount, count, phase, kinks };
    let cases = [
        (vec![wave(-0.0086, 11.0, 2.32, true), wave(0.067, 7.0, -0.25, false), wave(0.0126, 5.0, 2.52, true)], 0.0947),
        (vec![wave(0.062, 11.0, 0.68, true), wave(-0.111, 11.0, -0.81, false), wave(0.0234, 6.0, 2.24, true)], 0.0999),
        (vec![wave(-0.126, 12.0, 1.64, false), wave(0.0436, 7.0, -1.29, false), wave(-0.107, 2.0, 1.27, true)], 0.051),
    ];
    let mut random = Random(5);
    for (waves, distance) in cases {
        let base = Table::new(Polar::new(Vector2::zeros(), Sum(waves), true).unwrap().pieces()).unwrap();
        let table = base.offset(distance).unwrap().table;
        for piece in table.pieces() {
            assert!(piece.shape().is_some() || piece.graphs().is_some(), "{piece:?}");
        }
        let (mut farthest, mut askew) = (0.0_f64, 0.0_f64);
        for _ in 0..4000 {
            let point = Vector2::new(random.between(-0.4, 0.4), random.between(-0.4, 0.4));
            let (sin, cos) = libm::sincos(random.between(-PI, PI));
            let hit = table.with_walls(First(Line { point, velocity: Vector2::new(cos, sin) })).unwrap();
            let (_, foot) = base.closest(&hit.point);
            let off = hit.point - foot.point;
            farthest = farthest.max((off.norm() - distance).abs());
            // the points are rounded, over the distance from foot to hit and over the radius of curvature
            let rounding = f64::EPSILON * (1.0 / distance + table.curvature(hit.piece, &hit.point).abs());
            askew = askew.max((off / distance - hit.normal).norm() / rounding);
        }
        assert!(farthest <= 8.0 * f64::EPSILON && askew <= 16.0, "{farthest:e} {askew}");
    }
}

#[test]
fn every_kink_is_a_corner_wherever_the_turn_ends() {
    let mut random = Random(6);
    let mut wave = |count: f64, kinks: bool| Wave {
        amount: random.between(-0.15, 0.15),
        count,
        phase: random.between(0.0, 3.0),
        kinks,
    };
    let curves: Vec<_> = (0..200).map(|_| vec![wave(6.0, true), wave(5.0, false), wave(1.0, false)]).collect();
    let check = |waves: &Vec<Wave>| {
        let pieces = Polar::new(Vector2::zeros(), Sum(waves.clone()), true).unwrap().pieces();
        let table = Table::new(pieces).unwrap();
        assert_eq!((table.pieces().len(), table.corners().len()), (12, 12), "{waves:?}");
        // hundreds follow bends, thousands had followed the rounding of a formula
        let most = table.pieces().iter().map(|piece| piece.graphs().unwrap().len()).max();
        assert!(most <= Some(512), "{most:?} {waves:?}");
        // a normal from the other side of a kink had made pieces of negative length
        table.offset(0.27).unwrap();
    };
    // a hundred take half a minute
    std::thread::scope(|scope| curves.chunks(100).for_each(|some| _ = scope.spawn(|| some.iter().for_each(check))));
}

/// About an inflection, the waves that cancel are rounded each for itself; the arc had been given up, and with it all twelve.
#[test]
fn arcs_on_which_waves_cancel_are_graphs() {
    let wave = |amount: f64, count: f64, phase: f64, kinks: bool| Wave { amount, count, phase, kinks };
    let waves = vec![
        wave(-0.111_763_568_381_164_66, 6.0, 2.044_079_833_764_161_7, true),
        wave(-0.118_534_244_628_376_8, 5.0, 1.855_034_997_953_579_6, false),
        wave(0.141_943_361_409_374_27, 1.0, 1.231_795_386_045_701_2, false),
    ];
    let formula = Sum(waves);
    let table = Table::new(Polar::new(Vector2::zeros(), formula.clone(), true).unwrap().pieces()).unwrap();
    let counts: Vec<_> = table.pieces().iter().map(|piece| piece.graphs().unwrap().len()).collect();
    assert!(counts.len() == 12 && counts.iter().all(|count| *count <= 512), "{counts:?}");
    let mut random = Random(8);
    let (mut farthest, mut askew) = (0.0_f64, 0.0_f64);
    for _ in 0..20_000 {
        let point = Vector2::new(random.between(-0.4, 0.4), random.between(-0.4, 0.4));
        let (sin, cos) = libm::sincos(random.between(-PI, PI));
        let hit = table.with_walls(First(Line { point, velocity: Vector2::new(cos, sin) })).unwrap();
        let distance = hit.point.norm();
        let [r, slope] = exactly(&formula, libm::atan2(hit.point.y, hit.point.x));
        farthest = farthest.max((distance - r).abs());
        let radial = hit.point / distance;
        let normal = (Vector2::new(-radial.y, radial.x) * slope - radial * r).normalize();
        askew = askew.max((hit.normal - normal).norm());
    }
    // as far as the formula itself is off: sines and cosines of up to 40 radians, and their derivatives
    assert!(farthest <= 8.0 * f64::EPSILON && askew <= 48.0 * f64::EPSILON, "{farthest:e} {askew:e}");
}

/// `r` and `r′` without the rounding of `kφ + p`.
fn exactly(formula: &Sum, angle: f64) -> [f64; 2] {
    formula.0.iter().fold([1.0, 0.0], |[r, slope], &Wave { amount, count, phase, kinks }| {
        let turned = count * angle;
        let sum = turned + phase;
        let rest = libm::fma(count, angle, -turned)
            + if turned.abs() < phase.abs() { phase - sum + turned } else { turned - sum + phase };
        let (sin, cos) = libm::sincos(sum);
        let (sin, cos) = (sin + rest * cos, cos - rest * sin);
        let signed = if kinks { amount * cos.signum() } else { amount };
        [r + signed * cos, slope - signed * count * sin]
    })
}

fn clover() -> Clover {
    Clover { radius: 1.0, amount: 0.2, leaves: 5 }
}

/// From 20 pieces on, curves had been asked themselves: formulas ten times as slow, and their offsets a hundred times.
#[test]
fn a_smooth_curve_is_graphs_beside_any_number_of_other_pieces() {
    let mut random = Random(7);
    for sides in [4, 18, 19, 20, 200] {
        let vertex = |k: usize| {
            let (sin, cos) = libm::sincos(2.0 * PI * (k % sides) as f64 / sides as f64);
            Vector2::new(2.0 * cos, 2.0 * sin)
        };
        let curve = Polar::new(Vector2::zeros(), Clover { radius: 0.5, amount: 0.1, leaves: 3 }, false).unwrap();
        for distance in [0.0, 0.0625] {
            let mut pieces: Vec<Box<dyn Piece>> = vec![Box::new(curve.clone())];
            pieces.extend(
                (0..sides).map(|k| Box::new(Segment::new(vertex(k), vertex(k + 1)).unwrap()) as Box<dyn Piece>),
            );
            let mut table = Table::new(pieces).unwrap();
            if distance > 0.0 {
                table = table.offset(distance).unwrap().table;
            }
            let numbered = table.pieces().iter().enumerate().filter(|(_, piece)| piece.shape().is_none());
            let cut: Vec<_> =
                numbered.flat_map(|(k, p)| p.graphs().unwrap().into_iter().map(move |graph| (k, graph))).collect();
            let walls = Graphs::new(&cut, table.corners());
            for _ in 0..2000 {
                let (sin, cos) = libm::sincos(random.between(-PI, PI));
                let aim = Vector2::new(random.between(-0.28, 0.28), random.between(-0.28, 0.28));
                let point = Vector2::new(1.2 * cos, 1.2 * sin);
                let path = Line { point, velocity: aim - point };
                let hit = table.with_walls(First(path)).unwrap();
                // to the last bit
                assert_eq!(Some(hit), walls.hit(&path), "{sides} {distance} {path:?}");
            }
        }
    }
}

fn graphs(formula: impl PolarFormula + 'static, inside: bool) -> Option<usize> {
    Polar::new(Vector2::new(0.25, -0.5), formula, inside).unwrap().graphs().map(|graphs| graphs.len())
}

#[test]
fn a_smooth_curve_is_some_two_hundred_graphs_at_most_on_either_side() {
    for inside in [true, false] {
        let count = graphs(clover(), inside).unwrap();
        assert!((50..250).contains(&count), "{count}");
    }
}

#[test]
fn where_a_third_derivative_jumps_graphs_become_short() {
    let curve = Polar::new(Vector2::zeros(), Kinked, true).unwrap();
    let cut = curve.graphs().unwrap();
    assert!((100..400).contains(&cut.len()), "{}", cut.len());
    let walls = Graphs::new(&cut.into_iter().map(|graph| (0, graph)).collect::<Vec<_>>(), &[]);
    let mut random = Random(3);
    for k in 0..20_000 {
        // about the kinks, closer and closer, and elsewhere
        let side = if k % 2 == 0 { 0.5 } else { -0.5 };
        let near = libm::exp2(random.between(-50.0, 1.0)) * random.between(-1.0, 1.0);
        let (sin, cos) = libm::sincos(PI * side + near);
        let point = Vector2::new(random.between(-0.7, 0.7), random.between(-0.7, 0.7));
        let path = Line { point, velocity: Vector2::new(cos, sin) - point };
        let hit = walls.hit(&path).unwrap();
        let [x, y] = hit.point.into();
        let r = libm::hypot(x, y);
        let c = x / r;
        let off = r - (1.0 + 0.1 * c.abs() * c * c);
        assert!(off.abs() <= 2.0 * f64::EPSILON, "{path:?} {hit:?} {off:e}");
        // r(cos, sin) has the tangent r'(cos, sin) + r(−sin, cos)
        let rate = -0.3 * c.abs() * c * y / r;
        let normal = Vector2::new(-rate * y / r - x, rate * x / r - y).normalize();
        assert!((hit.normal - normal).norm() <= 4.0 * f64::EPSILON, "{path:?} {hit:?} {normal}");
    }
}

#[test]
fn nothing_hides_between_the_points_that_are_compared() {
    assert_eq!(graphs(Spiked, true), None);
}

/// `r = 1 + exp(−c (1 − cos φ))/8`, as it is written or with `2 sin²(φ/2)`, in which `c` does not multiply rounding.
#[derive(Clone, Copy, Debug)]
struct Peak {
    sharpness: f64,
    as_written: bool,
}

impl PolarFormula for Peak {
    fn jet(&self, angle: f64) -> [f64; 3] {
        let ((sin, cos), half, c) = (libm::sincos(angle), libm::sin(0.5 * angle), self.sharpness);
        let height = 0.125 * libm::exp(-c * if self.as_written { 1.0 - cos } else { 2.0 * half * half });
        [1.0 + height, -c * sin * height, c * (c * sin * sin - cos) * height]
    }
    fn jet_over(&self, angle: Interval) -> [Interval; 3] {
        let ([sin, cos], c) = (angle.sin_cos(), self.sharpness);
        let height = ((angle * 0.5).sin().square() * (-2.0 * c)).exp() * 0.125;
        [height + 1.0, sin * height * -c, (sin.square() * c - cos) * height * c]
    }
}

#[test]
fn a_peak_narrower_than_what_is_looked_at_first_is_graphs() {
    let mut random = Random(7);
    for (sharpness, as_written) in [(3e2, false), (3e3, false), (3e5, false), (3e2, true), (3e3, true), (5e3, true)] {
        let cut = Polar::new(Vector2::zeros(), Peak { sharpness, as_written }, true).unwrap().graphs();
        let walls = Graphs::new(&cut.unwrap().into_iter().map(|graph| (0, graph)).collect::<Vec<_>>(), &[]);
        let exact = Peak { sharpness, as_written: false };
        for k in 0..20_000 {
            let width = if k % 2 == 0 { PI } else { 4.0 / sharpness.sqrt() };
            let (sin, cos) = libm::sincos(random.between(-width, width));
            let point = Vector2::new(random.between(-0.3, 0.3), random.between(-0.3, 0.3));
            let path = Line { point, velocity: Vector2::new(cos, sin) - point };
            let hit = walls.hit(&path).unwrap();
            let radial = hit.point.normalize();
            let [r, slope, second] = exact.jet(libm::atan2(radial.y, radial.x));
            let normal = Vector2::new(-slope * radial.y - r * radial.x, slope * radial.x - r * radial.y).normalize();
            // a place is rounded, along the flank as well; a formula by as much as it multiplies rounding
            let rounding = f64::EPSILON * if as_written { 1.0 + 0.125 * sharpness } else { 1.0 };
            let off = (hit.point.norm() - r) / libm::hypot(1.0, slope);
            assert!(off.abs() <= 4.0 * rounding, "{sharpness} {as_written} {path:?} {off:e}");
            let turn = 4.0 * (1.0 + second.abs()) + if as_written { sharpness.sqrt() } else { 0.0 };
            let askew = (hit.normal - normal).norm();
            assert!(askew <= turn * rounding, "{sharpness} {as_written} {path:?} {askew:e}");
        }
    }
}

/// A peak with a kink on its flank: `|sin φ|/64` more, seen from `1/√c` beside its top.
#[derive(Clone, Copy, Debug)]
struct Bent(Peak);

const KINK: f64 = 1.0 / 64.0;

impl Bent {
    fn turned(&self) -> f64 {
        1.0 / self.0.sharpness.sqrt()
    }
}

impl PolarFormula for Bent {
    fn jet(&self, angle: f64) -> [f64; 3] {
        let [r, slope, second] = self.0.jet(angle - self.turned());
        let (sin, cos) = libm::sincos(angle);
        let sign = libm::copysign(KINK, sin);
        [r + sign * sin, slope + sign * cos, second - sign * sin]
    }
    fn jet_over(&self, angle: Interval) -> [Interval; 3] {
        let [r, slope, second] = self.0.jet_over(angle + -self.turned());
        let [sin, cos] = angle.sin_cos();
        if sin.contains(0.0) {
            return [r + sin.abs() * KINK, slope + cos.union(-cos) * KINK, Interval::ENTIRE];
        }
        let sign = libm::copysign(KINK, sin.low);
        [r + sin.abs() * KINK, slope + cos * sign, second + sin * -sign]
    }
}

#[test]
fn a_kink_on_a_steep_flank_is_where_a_curve_is_cut() {
    for sharpness in [300.0, 3e4] {
        let bent = Bent(Peak { sharpness, as_written: false });
        let arcs = Polar::new(Vector2::zeros(), bent, true).unwrap().pieces();
        assert_eq!(arcs.len(), 2, "{sharpness}");
        assert!(arcs.iter().all(|arc| arc.graphs().is_some()), "{sharpness}");
        let kinks: Vec<_> = arcs.iter().map(|arc| arc.ends().unwrap()[0].y.abs()).collect();
        assert!(kinks.iter().all(|y| *y < 1e-14), "{kinks:?}");
    }
}

/// The ellipse of semi-latus rectum 1 about its focus, `r = 1/(1 + e cos φ)`.
#[derive(Clone, Copy, Debug)]
struct Kepler {
    eccentricity: f64,
}

impl PolarFormula for Kepler {
    fn jet(&self, angle: f64) -> [f64; 3] {
        let ((sin, cos), e) = (libm::sincos(angle), self.eccentricity);
        let r = 1.0 / (1.0 + e * cos);
        [r, e * sin * r * r, (e * cos + 2.0 * e * e * sin * sin * r) * r * r]
    }
    fn jet_over(&self, angle: Interval) -> [Interval; 3] {
        let ([sin, cos], e) = (angle.sin_cos(), self.eccentricity);
        let r = Interval::from(1.0) / (cos * e + 1.0);
        [r, sin * e * r * r, (cos * e + sin.square() * r * (2.0 * e * e)) * r * r]
    }
}

/// At its far end a slim ellipse about a focus is rounded a thousand times as much as elsewhere; graphs take the mean of that.
#[test]
fn a_slim_ellipse_about_its_focus_is_graphs_that_know_it_better_than_the_formula() {
    let e: f64 = 0.999;
    let (a, b) = (1.0 / (1.0 - e * e), 1.0 / (1.0 - e * e).sqrt());
    let ellipse = Ellipse::new(Vector2::new(-e * a, 0.0), [a, b], 0.0, true).unwrap();
    let polar = Polar::new(Vector2::zeros(), Kepler { eccentricity: e }, true).unwrap();
    let walls = Graphs::new(&polar.graphs().unwrap().into_iter().map(|graph| (0, graph)).collect::<Vec<_>>(), &[]);
    let mut random = Random(11);
    let mut errors = [const { vec![] }; 4];
    for _ in 0..5000 {
        let (turn, share) = (random.between(-PI, PI), random.between(0.0, 0.9));
        let point = Vector2::new(-e * a + share * a * libm::cos(turn), share * b * libm::sin(turn));
        let (sin, cos) = libm::sincos(random.between(-PI, PI));
        let path = Line { point, velocity: Vector2::new(cos, sin) };
        let [exact, asked] =
            [&ellipse as &dyn Piece, &polar].map(|piece| piece.landing(&path, piece.crossing(&path).time()));
        let hit = walls.hit(&path).unwrap();
        let points = [hit.point, asked.point].map(|point| (point - exact.point).norm() / a);
        let normals = [hit.normal, asked.normal].map(|normal| (normal - exact.normal).norm());
        errors.iter_mut().zip(points.into_iter().chain(normals)).for_each(|(errors, error)| errors.push(error));
    }
    let [graphs, formula, normals, slopes] = errors.map(|mut errors| {
        errors.sort_by(f64::total_cmp);
        errors[errors.len() / 2] / f64::EPSILON
    });
    // directions have less to take the mean of; polynomials that left more than noise would be off twice as much
    assert!(graphs < 0.5 * formula && normals < 1.6 * slopes, "{graphs} {formula} {normals} {slopes}");
}

/// The circle as a polar curve about its centre.
#[derive(Clone, Copy, Debug)]
struct Round;

impl PolarFormula for Round {
    fn jet(&self, _: f64) -> [f64; 3] {
        [1.0, 0.0, 0.0]
    }
    fn jet_over(&self, _: Interval) -> [Interval; 3] {
        [1.0, 0.0, 0.0].map(Interval::from)
    }
}

#[test]
fn the_graphs_of_a_circle_are_hit_as_the_circle() {
    let circle = Circle::new(Vector2::zeros(), 1.0, true).unwrap();
    let cut = Polar::new(Vector2::zeros(), Round, true).unwrap().graphs().unwrap();
    let walls = Graphs::new(&cut.into_iter().map(|graph| (3, graph)).collect::<Vec<_>>(), &[]);
    let mut random = Random(1);
    for _ in 0..100_000 {
        let path = Line {
            point: Vector2::new(random.between(-0.7, 0.7), random.between(-0.7, 0.7)),
            velocity: Vector2::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0)),
        };
        let (hit, time) = (walls.hit(&path).unwrap(), circle.crossing(&path).time());
        assert_eq!((hit.piece, hit.corner), (3, false));
        // the distance from the centre of a path inside makes angles of at least 0.14 with the circle
        let ulp = f64::EPSILON;
        assert!((hit.time - time).abs() * path.velocity.norm() <= 16.0 * ulp / 0.14, "{path:?} {hit:?} {time}");
        assert!((hit.point.norm() - 1.0).abs() <= 2.0 * ulp, "{path:?} {hit:?}");
        assert!((hit.normal + hit.point).norm() <= 8.0 * ulp, "{path:?} {hit:?}");
    }
}

/// Paths that leave the curve within an angle of the tangent, and where they next meet it.
#[test]
fn grazing_paths_are_followed_from_hit_to_hit() {
    let curve = Polar::new(Vector2::zeros(), clover(), true).unwrap();
    let table = Table::new(vec![Box::new(curve.clone())]).unwrap();
    let list = table.list([0]);
    let walls = Graphs::new(&curve.graphs().unwrap().into_iter().map(|graph| (0, graph)).collect::<Vec<_>>(), &[]);
    let mut random = Random(2);
    let mut compared = 0;
    for _ in 0..20_000 {
        let point = curve.point_at(random.between(0.0, curve.length()));
        let landing = curve.closest(&point);
        let tangent =
            Vector2::new(landing.normal.y, -landing.normal.x) * if random.between(0.0, 1.0) < 0.5 { 1.0 } else { -1.0 };
        let angle = libm::exp2(random.between(-20.0, -1.0));
        let path = Line { point: landing.point, velocity: tangent + landing.normal * angle };
        let (a, b) = (list.hit(&path).unwrap(), walls.hit(&path).unwrap());
        // a path that all but touches the curve on its way is decided by rounding
        let cos = path.velocity.dot(&a.normal).abs().min(path.velocity.dot(&b.normal).abs());
        if cos < 1e-6 {
            continue;
        }
        compared += 1;
        // the start is off by an ulp, which a flat chord makes longer or shorter at both ends
        let bound = 64.0 * f64::EPSILON / cos.min(angle);
        assert!((a.point - b.point).norm() <= bound, "{path:?} {a:?} {b:?}");
    }
    assert!(compared > 19_000, "{compared}");
}

#[test]
fn paths_that_are_not_numbers_hit_nothing() {
    for leaves in [3, 30] {
        let cut = Polar::new(Vector2::zeros(), Clover { radius: 1.0, amount: 0.02, leaves }, true).unwrap();
        let cut = cut.graphs().unwrap();
        let walls = Graphs::new(&cut.into_iter().map(|graph| (0, graph)).collect::<Vec<_>>(), &[]);
        let nowhere = Vector2::repeat(f64::NAN);
        for (point, velocity) in [(nowhere, Vector2::x()), (Vector2::zeros(), nowhere)] {
            let hit: WallHit<f64, 2> = walls.first_hit(&point.into(), &velocity.into());
            assert_eq!(hit.time, f64::INFINITY);
        }
    }
}

/// A start so far away that the distance of its line had been rounded into any cell.
#[test]
fn a_path_hits_what_is_in_its_way_however_far_it_comes() {
    let curve = Polar::new(Vector2::zeros(), clover(), false).unwrap();
    let cut = curve.graphs().unwrap();
    let walls = Graphs::new(&cut.into_iter().map(|graph| (4, graph)).collect::<Vec<_>>(), &[]);
    let velocity = Vector2::new(3.0, 4.0);
    let (mut hits, mut misses) = (0, 0);
    for exponent in 4..=62 {
        let size = libm::ldexp(1.0, exponent);
        for k in -6..=6 {
            // all starts are exact
            let offset = Vector2::new(f64::from(k) * libm::ldexp(1.0, exponent - 50).max(0.125), 0.0);
            let [near, far] = [2.0, size].map(|times| Line { point: offset - velocity * times, velocity });
            assert!(far.point - offset == velocity * -size, "{far:?}");
            let wide = Twin::of(0.0);
            let hit: WallHit<f64, 2> = walls.first_hit(&far.point.into(), &far.velocity.into());
            let both = walls.first_hit(&[wide + far.point.x, wide + far.point.y], &[wide + 3.0, wide + 4.0]);
            assert_eq!([0, 1].map(|lane| both.time.lane(lane)), [hit.time; 2], "{far:?}");
            let Some(expected) = walls.hit(&near) else {
                assert_eq!(hit.time, f64::INFINITY, "{far:?}");
                misses += 1;
                continue;
            };
            let cos = -expected.normal.dot(&velocity) / velocity.norm();
            let off = (expected.point - Vector2::from(hit.point)).norm();
            // up to 2³² sizes the path's line is as far off as coordinates of its start are rounded
            let rounded = if exponent < 32 { 5.0 * size } else { 1.0 };
            assert!(off * cos <= 8.0 * f64::EPSILON * rounded, "{far:?} {expected:?} {hit:?}");
            let late = (hit.time - (expected.time + (size - 2.0))).abs() * cos;
            assert!(late <= 4.0 * f64::EPSILON * size, "{far:?} {expected:?} {hit:?}");
            for i in 0..2 {
                assert_eq!([0, 1].map(|lane| both.point[i].lane(lane)), [hit.point[i]; 2], "{far:?}");
                assert_eq!([0, 1].map(|lane| both.normal[i].lane(lane)), [hit.normal[i]; 2], "{far:?}");
            }
            hits += 1;
        }
    }
    assert!(hits > 500 && misses > 100, "{hits} {misses}");
    // away from it, past it, and from nowhere
    for (point, velocity) in [
        ([1e12, 1e12], [3.0, 4.0]),
        ([1e12, 0.0], [0.0, 1.0]),
        ([-1e14, 0.0], [1.0, 1e-13]),
        ([f64::INFINITY, 0.0], [-1.0, 0.0]),
        ([1e14, 0.0], [0.0; 2]),
    ] {
        let hit: WallHit<f64, 2> = walls.first_hit(&point, &velocity);
        assert_eq!(hit.time, f64::INFINITY, "{point:?}");
    }
}

/// The graphs of a parallel had been cut at inflections by steps that depended on the unit of length.
#[test]
fn a_parallel_scaled_by_a_power_of_two_is_hit_at_the_same_bits() {
    let mut random = Random(11);
    let paths: Vec<_> = (0..2000)
        .map(|_| {
            let [point, aim] = [0; 2].map(|_| Vector2::new(random.between(-0.4, 0.4), random.between(-0.4, 0.4)));
            Line { point, velocity: aim - point }
        })
        .collect();
    let hits = |exponent: i32, leaves: u32| -> Vec<_> {
        let unit = libm::ldexp(1.0, exponent);
        let waves = Clover { radius: unit, amount: 0.2, leaves };
        let curve: Box<dyn Piece> = Box::new(Polar::new(Vector2::zeros(), waves, true).unwrap());
        let table = Table::new(vec![curve]).unwrap().offset(0.03125 * unit).unwrap().table;
        let numbered = table.pieces().iter().enumerate();
        let cut: Vec<_> =
            numbered.flat_map(|(k, p)| p.graphs().unwrap().into_iter().map(move |graph| (k, graph))).collect();
        let walls = Graphs::new(&cut, table.corners());
        let hit = |path: &Line<2>| {
            let hit = walls.hit(&Line { point: path.point * unit, velocity: path.velocity }).unwrap();
            let scaled = [hit.time, hit.point.x, hit.point.y].map(|x| x / unit);
            (scaled.map(f64::to_bits), [hit.normal.x, hit.normal.y].map(f64::to_bits), hit.piece, hit.corner)
        };
        paths.iter().map(hit).collect()
    };
    for leaves in [3, 5] {
        let at_one = hits(0, leaves);
        for exponent in [-40, -3, 1, 2, 5, 60] {
            let differ = hits(exponent, leaves).iter().zip(&at_one).filter(|(a, b)| a != b).count();
            assert_eq!(differ, 0, "{leaves} leaves, 2^{exponent}");
        }
    }
}
