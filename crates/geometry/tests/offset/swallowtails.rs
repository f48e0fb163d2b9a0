//! Disks slightly larger than the least radius of curvature, whose centres' path turns at a corner behind two cusps.
use super::*;
use geometry::shapes::curve::{Interval, Polar, PolarFormula};

/// `r = 1 + 0.08 cos 2φ + 0.05 sin 3φ`, whose curvature falls at different rates to both sides of its maxima.
#[derive(Clone, Copy, Debug)]
struct Pear;

impl PolarFormula for Pear {
    fn jet(&self, angle: f64) -> [f64; 3] {
        let [(sin, cos), (sin3, cos3)] = [libm::sincos(2.0 * angle), libm::sincos(3.0 * angle)];
        [1.0 + 0.08 * cos + 0.05 * sin3, -0.16 * sin + 0.15 * cos3, -0.32 * cos - 0.45 * sin3]
    }
    fn jet_over(&self, angle: Interval) -> [Interval; 3] {
        let [[sin, cos], [sin3, cos3]] = [(angle * 2.0).sin_cos(), (angle * 3.0).sin_cos()];
        [cos * 0.08 + sin3 * 0.05 + 1.0, sin * -0.16 + cos3 * 0.15, cos * -0.32 + sin3 * -0.45]
    }
}

/// The least radius of curvature.
fn least_radius(drawn: &Table) -> f64 {
    let mut greatest: f64 = 0.0;
    for piece in drawn.pieces() {
        let curvature = |s: f64| piece.curvature(&piece.point_at(s));
        let parts = 4096;
        let at = |k: i32| piece.length() * f64::from(k) / f64::from(parts);
        let top = (0..parts).max_by(|&j, &k| curvature(at(j)).total_cmp(&curvature(at(k)))).unwrap();
        let [mut low, mut high] = [at(top - 1), at(top + 1)];
        for _ in 0..80 {
            let [a, b] = [low + (high - low) / 3.0, high - (high - low) / 3.0];
            [low, high] = if curvature(a) < curvature(b) { [a, high] } else { [low, b] };
        }
        greatest = greatest.max(curvature(0.5 * (low + high)));
    }
    1.0 / greatest
}

#[test]
fn a_disk_may_be_larger_than_the_least_radius_of_curvature_by_however_little() {
    let ellipse = |x: f64, axes: [f64; 2], turn: f64| {
        table(vec![Box::new(Ellipse::new(v(x, -0.2), axes, turn, true).unwrap()) as Box<dyn Piece>])
    };
    let pear = |x: f64| table(Polar::new(v(x, 0.1), Pear, true).unwrap().pieces());
    for (name, drawn) in [
        ("ellipse", ellipse(0.3, [2.0, 1.0], 0.7)),
        // its arc lengths begin at a vertex, between the cusps
        ("along", ellipse(0.0, [2.0, 1.0], 0.0)),
        ("across", ellipse(0.3, [1.0, 1.5], 0.0)),
        ("flat", ellipse(0.3, [4.0, 1.0], -0.4)),
        ("far", ellipse(1000.0, [2.0, 1.0], 0.7)),
        ("pear", pear(0.0)),
        ("pear afar", pear(50.0)),
    ] {
        let least = least_radius(&drawn);
        let mut counts = vec![];
        for k in (14..50).step_by(4) {
            let radius = least * (1.0 + libm::ldexp(1.3, -k));
            counts.push(check(name, &drawn, radius).table.pieces().len());
        }
        assert!(counts.iter().all(|count| *count == counts[0]), "{name}: {counts:?}");
    }
}
