//! Part of a polar curve, between two kinks.
use super::{Aimed, ArcLength, Graph, Interval, Polar, PolarFormula, spike::Spike};
use crate::{
    crossing::Crossing,
    path::Line,
    piece::{Extent, Landing, Piece},
    plane::slack,
};
use core::f64::consts::PI;
use nalgebra::Vector2;
use std::sync::Arc;

/// The part of a [`Polar`] curve between two angles, between which it is smooth; [`Polar::pieces`] makes them.
///
/// Traversed counter-clockwise with the table inside, clockwise with it outside. Paths meet its polynomial [`graphs`](super::graphs());
/// everything else uses the formula, at an end on the arc's side of the kink. It ends at the tip of a cusp, although no angle is that of the
/// tip.
#[derive(Clone, Debug)]
pub struct PolarArc<F> {
    curve: Arc<Polar<F>>,
    /// The angles of its ends, rising; the first in one turn.
    range: [f64; 2],
    /// The points at these angles, as its neighbours have them.
    vertices: [Vector2<f64>; 2],
    /// At an end that is the tip of a cusp, what lies beyond the angle of that end, which is rounded.
    spikes: [Option<Spike>; 2],
    graphs: Vec<Graph>,
    table: ArcLength,
    area: f64,
    extent: Extent,
    slack: f64,
}

/// Room for the rounding of angles up to 4π that are multiplied by a whole number and shifted: some ulp (radians).
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Parts of an arc from which its length is tabulated.
const PARTS: u32 = 32;

impl<F: PolarFormula + Clone + 'static> PolarArc<F> {
    /// The arcs between the kinks of a curve, of which there is at least one, in the order of traversal; or the whole curve, if some
    /// arc cannot be represented by polynomial graphs.
    pub(super) fn between(curve: Polar<F>, kinks: &[Interval]) -> Vec<Box<dyn Piece>> {
        let mut cuts = kinks.to_vec();
        if let [first, .., last] = kinks
            && first.low == 0.0
            && last.high == 2.0 * PI
        {
            // the same kink, seen from both sides
            cuts[0].low = last.low - 2.0 * PI;
            cuts.pop();
        }
        if let [kink] = cuts[..] {
            // an arc needs two distinct ends
            cuts.push(Interval::from(kink.low + PI));
        }
        let curve = Arc::new(curve);
        let vertices: Vec<_> = cuts.iter().map(|cut| Vertex::new(&curve, *cut)).collect();
        let arcs: Option<Vec<PolarArc<F>>> = (0..cuts.len())
            .map(|k| {
                let next = (k + 1) % cuts.len();
                let mut end = cuts[next].low;
                if next == 0 {
                    // a turn later the formula is the same up to rounding, which must not put it on the other side of the kink (slopes
                    // on one side differ by rounding times the square of the number of waves; across it, by the kink)
                    let slope = |angle: f64| curve.formula().jet(angle)[1];
                    let (there, turned) = (slope(end), slope(end + 2.0 * PI));
                    let same = (there - turned).abs() <= 1e-6 * there.abs().max(turned.abs());
                    end += if same { 2.0 * PI } else { 2.0 * PI - ROUNDING };
                }
                let range = [cuts[k].high, end];
                PolarArc::new(&curve, range, [vertices[k], vertices[next]])
            })
            .collect();
        let Some(mut arcs) = arcs else { return vec![Box::new(Polar::clone(&curve))] };
        if !curve.is_inside() {
            arcs.reverse();
        }
        arcs.into_iter().map(|arc| Box::new(arc) as _).collect()
    }

    /// The arc between two angles with these points; `None` if it cannot be represented by polynomial graphs.
    fn new(curve: &Arc<Polar<F>>, range: [f64; 2], ends: [Vertex; 2]) -> Option<PolarArc<F>> {
        if range[0] >= range[1] {
            return None;
        }
        let vertices = ends.map(|end| end.point);
        let points = curve.points();
        let spike = |k: usize| Spike::new(points.center, vertices[k], curve.at_angle(range[k]));
        let spikes = [0, 1].map(|k| ends[k].is_tip.then(|| spike(k)));
        let parameter = |k: u32| range[0] + (range[1] - range[0]) * (f64::from(k) / f64::from(PARTS));
        let table = ArcLength::new(&points, (0..PARTS).map(parameter).chain([range[1]]));
        let extent = table.extent(&points).union(Extent::of(vertices));
        // the area swept about an end is the area over the chord
        let swept = table.enclosed_area(&points, vertices[0]);
        let area = if curve.is_inside() { swept } else { -swept };
        let size = extent.size();
        let graphs = curve.graphs_between(range, vertices, size)?;
        let slack = slack([size]);
        Some(PolarArc { curve: Arc::clone(curve), range, vertices, spikes, graphs, table, area, extent, slack })
    }

    /// The angle of a point that is on the arc up to rounding, or else which end is closest.
    fn angle(&self, point: &Vector2<f64>) -> Result<f64, usize> {
        let angle = self.curve.angle(point);
        let [low, high] = self.range;
        let turns = [0.0, 2.0 * PI, 4.0 * PI].map(|turn| angle + turn);
        if turns.iter().any(|angle| (low..=high).contains(angle)) {
            return Ok(angle);
        }
        let [before, after] = [low, high].map(|end| turns.iter().fold(f64::INFINITY, |m, a| m.min((a - end).abs())));
        Err(usize::from(after < before))
    }

    /// Which end is at this angle, if one is.
    fn end_at(&self, angle: f64) -> Option<usize> {
        self.range.iter().position(|end| *end == angle)
    }

    /// The end at the lower or the higher angle, and the normal of the arc there.
    fn vertex(&self, which: usize) -> Landing {
        let Landing { normal, .. } = self.curve.at_angle(self.range[which]);
        self.spikes[which].map_or(Landing { point: self.vertices[which], normal }, |spike| spike.landing_at(0.0))
    }

    /// The closest point to one that is closer to the lower or the higher end than to any point at an angle, and the normal there.
    fn near_end(&self, which: usize, point: &Vector2<f64>) -> Landing {
        self.spikes[which].map_or_else(|| self.vertex(which), |spike| spike.landing_at(spike.closest(point)))
    }

    /// How far that point is from this end.
    fn distance_from_end(&self, which: usize, point: &Vector2<f64>) -> f64 {
        self.spikes[which].map_or(0.0, |spike| spike.closest(point))
    }

    /// The lengths beyond the angles of the ends.
    fn beyond(&self) -> [f64; 2] {
        self.spikes.map(|spike| spike.map_or(0.0, |spike| spike.length()))
    }

    /// From arc length counter-clockwise to arc length in the sense of traversal, and back.
    fn traversed(&self, s: f64) -> f64 {
        if self.curve.is_inside() { s } else { self.length() - s }
    }
}

/// An end of two arcs.
#[derive(Clone, Copy, Debug)]
struct Vertex {
    point: Vector2<f64>,
    /// Whether it is the tip of a cusp.
    is_tip: bool,
}

impl Vertex {
    /// The kink or cusp between two angles.
    fn new<F: PolarFormula>(curve: &Polar<F>, place: Interval) -> Vertex {
        match curve.tip(place) {
            Some(point) => Vertex { point, is_tip: true },
            None => Vertex { point: curve.at_angle(0.5 * (place.low + place.high)).point, is_tip: false },
        }
    }
}

impl<F: PolarFormula + Clone + 'static> Piece for PolarArc<F> {
    fn crossing(&self, path: &Line<2>) -> Crossing {
        let aimed = Aimed::new(path.point.into(), path.velocity.into());
        let times = self.graphs.iter().map(|graph| graph.time(&aimed, self.slack));
        Crossing { num: times.fold(f64::INFINITY, f64::min), den: 1.0 }
    }
    fn landing(&self, path: &Line<2>, time: f64) -> Landing {
        let point = path.at(time);
        match self.angle(&point) {
            Ok(_) => self.curve.landing(path, time),
            Err(end) => self.near_end(end, &point),
        }
    }
    fn curvature(&self, point: &Vector2<f64>) -> f64 {
        self.curve.curvature_at(self.angle(point).unwrap_or_else(|end| self.range[end]))
    }
    fn length(&self) -> f64 {
        let [before, after] = self.beyond();
        self.table.length() + before + after
    }
    fn point_at(&self, s: f64) -> Vector2<f64> {
        self.landing_at(s).point
    }
    fn landing_at(&self, s: f64) -> Landing {
        let s = self.traversed(s);
        let rest = self.length() - s;
        if s <= 0.0 {
            self.vertex(0)
        } else if rest <= 0.0 {
            self.vertex(1)
        } else {
            match self.spikes {
                [Some(spike), _] if s < spike.length() => spike.landing_at(s),
                [_, Some(spike)] if rest < spike.length() => spike.landing_at(rest),
                _ => self.curve.at_angle(self.table.parameter(&self.curve.points(), s - self.beyond()[0])),
            }
        }
    }
    fn arc_length_at(&self, point: &Vector2<f64>) -> f64 {
        let points = self.curve.points();
        let angle = self.table.closest(&points, point);
        let s = match self.end_at(angle) {
            Some(0) => self.distance_from_end(0, point),
            Some(_) => self.length() - self.distance_from_end(1, point),
            None => self.beyond()[0] + self.table.at_parameter(&points, angle),
        };
        self.traversed(s)
    }
    fn closest(&self, point: &Vector2<f64>) -> Landing {
        let angle = self.table.closest(&self.curve.points(), point);
        match self.end_at(angle) {
            Some(end) => self.near_end(end, point),
            None => self.curve.at_angle(angle),
        }
    }
    fn ends(&self) -> Option<[Vector2<f64>; 2]> {
        Some(self.curve.in_sense(self.vertices))
    }
    fn extent(&self) -> Extent {
        self.extent
    }
    fn graphs(&self) -> Option<Vec<Graph>> {
        Some(self.graphs.clone())
    }
    fn area(&self) -> f64 {
        self.area
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::enclosed_area;

    /// `r = 2 ∓ |cos(kφ/2)|`: `k` kinks that point out of the table or into it.
    #[derive(Clone, Debug)]
    struct Waves {
        count: f64,
        sign: f64,
    }

    impl PolarFormula for Waves {
        fn jet(&self, angle: f64) -> [f64; 3] {
            let k = 0.5 * self.count;
            let (sin, cos) = libm::sincos(k * angle);
            let sign = libm::copysign(self.sign, cos);
            [2.0 - sign * cos, k * sign * sin, k * k * sign * cos]
        }
        fn jet_over(&self, angle: Interval) -> [Interval; 3] {
            let k = 0.5 * self.count;
            let [sin, cos] = (angle * k).sin_cos();
            let r = cos.abs() * -self.sign + 2.0;
            if cos.contains(0.0) {
                return [r, sin.union(-sin) * k, Interval::ENTIRE];
            }
            let sign = libm::copysign(self.sign, cos.low);
            [r, sin * (k * sign), cos * (k * k * sign)]
        }
    }

    fn arcs(formula: Waves, inside: bool) -> Vec<Box<dyn Piece>> {
        Polar::new(Vector2::zeros(), formula, inside).unwrap().pieces()
    }

    #[test]
    fn a_curve_is_cut_at_its_kinks() {
        for inside in [true, false] {
            for count in [1.0, 2.0, 3.0, 8.0, 25.0, 50.0, 100.0, 200.0] {
                let arcs = arcs(Waves { count, sign: 1.0 }, inside);
                assert_eq!(arcs.len() as f64, count.max(2.0));
                let ends: Vec<_> = arcs.iter().map(|arc| arc.ends().unwrap()).collect();
                for (k, [_, end]) in ends.iter().enumerate() {
                    assert_eq!(*end, ends[(k + 1) % ends.len()][0]);
                }
                // ½∫(2 − |cos|)² = ½(8π − 16 + π)
                let area = enclosed_area(arcs.iter().map(|arc| &**arc));
                let expected = (4.5 * PI - 8.0) * if inside { 1.0 } else { -1.0 };
                assert!((area - expected).abs() < 1e-14 * (4.0 + count), "{count} {area} {expected}");
            }
        }
    }

    #[test]
    fn hundreds_of_kinks_have_the_same_area_whether_they_are_told_apart_or_not() {
        for count in [299.0, 601.0, 2000.0] {
            let area = enclosed_area(arcs(Waves { count, sign: 1.0 }, true).iter().map(|arc| &**arc));
            // the error of a rule over a kink is the square of the final interval's width, times the size of the kink
            assert!((area - (4.5 * PI - 8.0)).abs() < 1e-11 * count * count, "{count} {area}");
        }
    }

    /// `r = 2 − |sin(kφ/2)|`
    #[derive(Clone, Debug)]
    struct FromZero(Waves);

    impl PolarFormula for FromZero {
        fn jet(&self, angle: f64) -> [f64; 3] {
            self.0.jet(angle + PI / self.0.count)
        }
        fn jet_over(&self, angle: Interval) -> [Interval; 3] {
            self.0.jet_over(angle + PI / self.0.count)
        }
    }

    #[test]
    fn a_kink_where_the_turn_begins_is_one_kink() {
        for count in [1.0, 2.0, 4.0] {
            let curve = FromZero(Waves { count, sign: 1.0 });
            let arcs = Polar::new(Vector2::zeros(), curve, true).unwrap().pieces();
            assert_eq!(arcs.len() as f64, count.max(2.0));
            let area = enclosed_area(arcs.iter().map(|arc| &**arc));
            assert!((area - (4.5 * PI - 8.0)).abs() < 4e-14, "{count} {area}");
            assert!((arcs[0].point_at(0.0) - Vector2::new(2.0, 0.0)).norm() < 4e-15);
        }
    }

    #[test]
    fn a_path_meets_one_arc_where_the_formula_says() {
        for sign in [1.0, -1.0] {
            let formula = Waves { count: 3.0, sign };
            let arcs = arcs(formula.clone(), true);
            for k in 0..1000 {
                let (turn, away) = (f64::from(k) * 0.7, 0.9 * libm::sin(f64::from(k * k)));
                let start = Vector2::new(away * libm::cos(3.0 * turn), away * libm::sin(3.0 * turn));
                let path = Line { point: start, velocity: Vector2::new(libm::cos(turn), libm::sin(turn)) * 1.5 };
                let times: Vec<f64> = arcs.iter().map(|arc| arc.crossing(&path).time()).collect();
                let time = times.iter().copied().fold(f64::INFINITY, f64::min);
                let arc = &arcs[times.iter().position(|t| *t == time).unwrap()];
                let Landing { point, normal } = arc.landing(&path, time);
                // a few roundings for a table of size 3
                assert!((point - path.at(time)).norm() < 2e-15, "{k}");
                let [r, slope, _] = formula.jet(libm::atan2(point.y, point.x));
                assert!((point.norm() - r).abs() < 2e-15);
                // the normal is at right angles to r′ e_r + r e_φ
                let radial = point / point.norm();
                let tangent = radial * slope + Vector2::new(-radial.y, radial.x) * r;
                assert!(normal.dot(&tangent).abs() < 4e-15 && normal.dot(&radial) < 0.0);
                // nothing was crossed before
                for part in 1..64 {
                    let p = path.at(time * f64::from(part) / 64.0);
                    assert!(p.norm() < formula.jet(libm::atan2(p.y, p.x))[0] + 1e-14, "{k}");
                }
                let s = arc.arc_length_at(&point);
                assert!((arc.point_at(s) - point).norm() < 1e-14);
            }
        }
    }

    #[test]
    fn at_its_ends_an_arc_has_its_own_normals() {
        // at the kinks r′ = ±1 and r = 2
        let arcs = arcs(Waves { count: 2.0, sign: 1.0 }, true);
        let top = arcs[0].ends().unwrap()[0];
        // the angle π/2 is rounded
        assert!((top - Vector2::new(0.0, 2.0)).norm() <= 2.0 * f64::EPSILON);
        let [before, after] = [&arcs[1], &arcs[0]].map(|arc| arc.closest(&top));
        assert_eq!([before.point, after.point], [top; 2]);
        let expected = Vector2::new(1.0, -2.0) / 5f64.sqrt();
        // a kink is known to 4 ε
        assert!((after.normal - expected).norm() < 2e-15, "{after:?}");
        assert!((before.normal - Vector2::new(-expected.x, expected.y)).norm() < 2e-15, "{before:?}");
    }

    #[test]
    fn a_point_that_rounding_puts_beyond_an_end_lands_there() {
        let arcs = arcs(Waves { count: 2.0, sign: 1.0 }, true);
        // the first arc is the left half: beyond its ends is to the right
        for (arc, beyond) in arcs.iter().zip([1e-12, -1e-12]) {
            for end in arc.ends().unwrap() {
                let place = end + Vector2::new(beyond, 0.0);
                let path = Line { point: Vector2::zeros(), velocity: place };
                let Landing { point, normal } = arc.landing(&path, 1.0);
                assert_eq!((point, normal), (end, arc.closest(&end).normal));
            }
        }
    }
}
