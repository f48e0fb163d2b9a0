//! Outlines of straight sides, and the paths on which programs lose them.
use crate::random::Random;
use core::f64::consts::TAU;
use geometry::{Line, Piece, Vector2, shapes::Segment};

/// A star-shaped polygon of `n` corners with a rough edge.
pub(crate) fn rough(n: usize, size: f64, random: &mut Random) -> Vec<Segment> {
    let corners: Vec<Vector2<f64>> = (0..n)
        .map(|k| {
            let angle = TAU * k as f64 / n as f64;
            let radius = size * (1.0 + 0.2 * libm::sin(5.0 * angle) + 0.5 / n as f64 * random.unit());
            Vector2::new(libm::cos(angle), libm::sin(angle)) * radius
        })
        .collect();
    (0..n).map(|k| Segment::new(corners[k], corners[(k + 1) % n]).unwrap()).collect()
}

/// Paths inside an outline around the origin, from side to side, and all kinds of others: along the axes (with zeros of either
/// sign), to and from vertices, along sides and almost along them, from far away, at hardly any and at every speed.
pub(crate) fn paths(sides: &[Segment], count: usize, random: &mut Random) -> Vec<Line<2>> {
    let size = sides.iter().map(|s| s.point_at(0.0).amax()).fold(0.0, f64::max);
    let mut from = Vector2::zeros();
    let mut all = vec![];
    for k in 0..count {
        let side = &sides[random.below(sides.len())];
        let [a, b] = side.ends().unwrap();
        let angle = random.between(0.0, TAU);
        let anywhere = Vector2::new(libm::cos(angle), libm::sin(angle)) * size;
        let (point, velocity) = match k % 16 {
            0 => (from, Vector2::new(0.0, size)),
            1 => (from, Vector2::new(-size, -0.0)),
            2 => (from, Vector2::new(-0.0, -size)),
            3 => (from, a - from),
            4 => (a, anywhere),
            5 => (a - (b - a), b - a),
            6 => (b + (b - a) * 3.0, a - b),
            7 => (a - (b - a) * 2.0, b - a + anywhere * 1e-12),
            8 => (anywhere * -1e5, anywhere),
            9 => (from, anywhere / size * 1e-140),
            10 => (from, anywhere / size * 1e140),
            11 => (from, Vector2::zeros()),
            // one unit in the last place off a vertex, on a side, off a side
            12 => (a.map(f64::next_up), anywhere),
            13 => (side.point_at(random.unit() * side.length()), anywhere),
            14 => (side.point_at(random.unit() * side.length()).map(f64::next_down), b - a),
            _ => (from, anywhere),
        };
        let path = Line { point, velocity };
        all.push(path);
        // on from the first side there
        let times = sides.iter().map(|side| side.crossing(&path).time()).enumerate();
        from = match times.filter(|(_, t)| *t < f64::INFINITY).min_by(|a, b| a.1.total_cmp(&b.1)) {
            Some((i, time)) => sides[i].landing(&path, time).point,
            None => Vector2::zeros(),
        };
    }
    all
}
