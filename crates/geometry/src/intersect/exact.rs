//! Straight and circular curves in closed form.
use super::{Meeting, MeetingKind};
use crate::{Figure, plane::slack};
use core::f64::consts::PI;
use nalgebra::Vector2;

/// A curve that can be intersected in closed form, parametrised by arc length like its piece.
#[derive(Clone, Copy, Debug)]
pub(super) enum Curve {
    Straight(Straight),
    Circular(Circular),
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Straight {
    origin: Vector2<f64>,
    /// Unit direction of traversal.
    direction: Vector2<f64>,
    range: [f64; 2],
    ends: [Option<Vector2<f64>>; 2],
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Circular {
    center: Vector2<f64>,
    radius: f64,
    /// +1 where traversed counter-clockwise.
    turn: f64,
    /// Polar angle of the start.
    start: f64,
    length: f64,
    /// `None` for a whole circle.
    ends: Option<[Vector2<f64>; 2]>,
}

fn length(v: Vector2<f64>) -> f64 {
    libm::hypot(v.x, v.y)
}

impl Curve {
    pub(super) fn of(figure: &Figure) -> Option<Curve> {
        let turn = |inside: bool| if inside { 1.0 } else { -1.0 };
        Some(match *figure {
            Figure::Segment { ends: [a, b] } => {
                let d = length(b - a);
                Curve::Straight(Straight {
                    origin: a,
                    direction: (b - a) / d,
                    range: [0.0, d],
                    ends: [Some(a), Some(b)],
                })
            }
            Figure::Ray { from, direction, left: true } => Curve::Straight(Straight {
                origin: from,
                direction,
                range: [0.0, f64::INFINITY],
                ends: [Some(from), None],
            }),
            Figure::Ray { from, direction, left: false } => Curve::Straight(Straight {
                origin: from,
                direction: -direction,
                range: [f64::NEG_INFINITY, 0.0],
                ends: [None, Some(from)],
            }),
            Figure::Line { through, direction } => Curve::Straight(Straight {
                origin: through,
                direction,
                range: [f64::NEG_INFINITY, f64::INFINITY],
                ends: [None, None],
            }),
            Figure::Arc { center, radius, ends: [a, b], inside } => {
                let [start, end] = [a, b].map(|p| angle(p - center));
                let sweep = turn(inside) * (end - start);
                let sweep = if sweep <= 0.0 { sweep + 2.0 * PI } else { sweep };
                let length = radius * sweep;
                Curve::Circular(Circular { center, radius, turn: turn(inside), start, length, ends: Some([a, b]) })
            }
            Figure::Circle { center, radius, inside } => Curve::Circular(Circular {
                center,
                radius,
                turn: turn(inside),
                start: 0.0,
                length: 2.0 * PI * radius,
                ends: None,
            }),
            Figure::Other => return None,
        })
    }

    /// The ends with their arc lengths.
    fn ends(&self) -> impl Iterator<Item = (Vector2<f64>, f64)> {
        let [a, b] = match self {
            Curve::Straight(s) => [s.ends[0].map(|p| (p, s.range[0])), s.ends[1].map(|p| (p, s.range[1]))],
            Curve::Circular(c) => [c.ends.map(|e| (e[0], 0.0)), c.ends.map(|e| (e[1], c.length))],
        };
        a.into_iter().chain(b)
    }

    /// Rounding of the coordinates that went into the curve.
    fn rounding(&self) -> f64 {
        match self {
            Curve::Straight(Straight { origin, ends, .. }) => {
                slack([origin].into_iter().chain(ends.iter().flatten()).flat_map(|p| p.iter().copied()))
            }
            Curve::Circular(c) => slack([c.center.x, c.center.y, c.radius]),
        }
    }

    /// The arc length of a point that lies on the curve within `tolerance`; exactly that of an end if the point is as
    /// near to it.
    fn locate(&self, point: &Vector2<f64>, tolerance: f64) -> Option<f64> {
        if let Some((_, s)) = self.ends().find(|(e, _)| length(e - point) <= tolerance) {
            return Some(s);
        }
        match self {
            Curve::Straight(line) => {
                let d = point - line.origin;
                let s = d.dot(&line.direction);
                let on = line.direction.perp(&d).abs() <= tolerance && line.range[0] <= s && s <= line.range[1];
                on.then_some(s)
            }
            Curve::Circular(circle) => {
                let d = point - circle.center;
                if (length(d) - circle.radius).abs() > tolerance {
                    return None;
                }
                let along = circle.turn * (angle(d) - circle.start);
                let s = circle.radius * if along < 0.0 { along + 2.0 * PI } else { along };
                (s <= circle.length).then_some(s)
            }
        }
    }

    /// A nearby point, projected onto the curve if it is straight.
    fn straightened(&self, point: &Vector2<f64>) -> Vector2<f64> {
        match self {
            Curve::Straight(line) => line.origin + line.direction * (point - line.origin).dot(&line.direction),
            Curve::Circular(_) => *point,
        }
    }

    /// Whether an arc length is that of an end.
    fn is_end(&self, s: f64) -> bool {
        self.ends().any(|(_, end)| end == s)
    }
}

fn angle(d: Vector2<f64>) -> f64 {
    libm::atan2(d.y, d.x)
}

/// The points that two curves have in common.
pub(super) fn meetings(a: &Curve, b: &Curve) -> Vec<Meeting> {
    let tolerance = a.rounding().max(b.rounding());
    let mut found: Vec<Meeting> = vec![];
    for (point, s) in a.ends() {
        if let Some(t) = b.locate(&point, tolerance) {
            push(&mut found, Meeting { point, at: [s, t], kind: MeetingKind::End }, tolerance);
        }
    }
    for (point, t) in b.ends() {
        if let Some(s) = a.locate(&point, tolerance) {
            push(&mut found, Meeting { point, at: [s, t], kind: MeetingKind::End }, tolerance);
        }
    }
    match (a, b) {
        (Curve::Straight(p), Curve::Straight(q)) => lines(p, q, tolerance, &mut found),
        (Curve::Circular(p), Curve::Circular(q)) if coincide(p, q, tolerance) => {
            same_circle(a, b, tolerance, &mut found);
        }
        _ => {
            let Some(pair) = Pair::of(a, b, tolerance) else { return found };
            pair.complete(a, b, tolerance, &mut found);
        }
    }
    found
}

fn push(found: &mut Vec<Meeting>, meeting: Meeting, tolerance: f64) {
    if found.iter().all(|m| length(m.point - meeting.point) > 2.0 * tolerance) {
        found.push(meeting);
    }
}

fn lines(p: &Straight, q: &Straight, tolerance: f64, found: &mut Vec<Meeting>) {
    // two common points make a common stretch
    if found.len() > 1 {
        for m in found {
            m.kind = MeetingKind::Overlap;
        }
        return;
    }
    let sine = p.direction.perp(&q.direction);
    let between = q.origin - p.origin;
    // each direction is rounded to half an ulp per component, and so is the product
    if sine.abs() <= 4.0 * f64::EPSILON {
        // parallel: an infinite stretch in common, if any, reaches from one end (or from anywhere) to infinity
        if p.direction.perp(&between).abs() > tolerance {
            return;
        }
        let same = p.direction.dot(&q.direction) > 0.0;
        let offset = between.dot(&p.direction);
        let [low, high] = q.range.map(|t| if same { t + offset } else { offset - t });
        let (low, high) = (p.range[0].max(low.min(high)), p.range[1].min(low.max(high)));
        if high == f64::INFINITY || low == f64::NEG_INFINITY {
            let unit = tolerance / f64::EPSILON;
            let near = if low.is_finite() { low } else { high.min(0.0) };
            let far = if high == f64::INFINITY { near + unit } else { near - unit };
            found.clear();
            for s in [near, far] {
                let t = if same { s - offset } else { offset - s };
                found.push(Meeting { point: p.origin + p.direction * s, at: [s, t], kind: MeetingKind::Overlap });
            }
        }
        return;
    }
    if !found.is_empty() {
        return;
    }
    let (s, t) = (between.perp(&q.direction) / sine, between.perp(&p.direction) / sine);
    let within = |x: f64, range: [f64; 2]| range[0] < x && x < range[1];
    if within(s, p.range) && within(t, q.range) {
        let mut point = p.origin + p.direction * s;
        for line in [q, p] {
            // a wall along an axis has one coordinate exactly
            for i in 0..2 {
                if line.direction[i] == 0.0 {
                    point[i] = line.origin[i];
                }
            }
        }
        found.push(Meeting { point, at: [s, t], kind: MeetingKind::Crossing });
    }
}

fn coincide(p: &Circular, q: &Circular, tolerance: f64) -> bool {
    (p.center - q.center).amax() <= tolerance && (p.radius - q.radius).abs() <= tolerance
}

/// Arcs of one circle: stretches between points in common are in common too if their middles are.
fn same_circle(a: &Curve, b: &Curve, tolerance: f64, found: &mut Vec<Meeting>) {
    let (Curve::Circular(p), Curve::Circular(_)) = (a, b) else { return };
    let at = |s: f64| {
        let angle = p.start + p.turn * s / p.radius;
        p.center + Vector2::new(libm::cos(angle), libm::sin(angle)) * p.radius
    };
    let mut marks: Vec<f64> = found.iter().map(|m| m.at[0]).collect();
    marks.extend([0.0, p.length]);
    marks.sort_by(f64::total_cmp);
    for w in marks.windows(2) {
        let middle = at(0.5 * (w[0] + w[1]));
        if w[1] - w[0] <= 2.0 * tolerance || b.locate(&middle, 2.0 * tolerance).is_none() {
            continue;
        }
        let mut missing = vec![];
        for s in [w[0], w[1]] {
            let mut known = false;
            for m in found.iter_mut().filter(|m| m.at[0] == s) {
                m.kind = MeetingKind::Overlap;
                known = true;
            }
            let point = at(s);
            if !known && let Some(t) = b.locate(&point, 2.0 * tolerance) {
                missing.push(Meeting { point, at: [s, t], kind: MeetingKind::Overlap });
            }
        }
        found.extend(missing);
    }
}

/// The two points in which a line or a circle meets a circle, which are mirror images of each other.
struct Pair {
    /// The point of the mirror axis halfway between them.
    foot: Vector2<f64>,
    /// Unit vector across the axis.
    across: Vector2<f64>,
    /// Half the distance between the points; 0 where the curves touch.
    half: f64,
    /// How far the one curve reaches through the other.
    depth: f64,
}

impl Pair {
    /// `None` where the whole line or circle passes by.
    fn of(a: &Curve, b: &Curve, tolerance: f64) -> Option<Pair> {
        let pair = match (a, b) {
            (Curve::Straight(line), Curve::Circular(circle)) | (Curve::Circular(circle), Curve::Straight(line)) => {
                let to = circle.center - line.origin;
                let foot = line.origin + line.direction * to.dot(&line.direction);
                let distance = line.direction.perp(&to).abs();
                let depth = circle.radius - distance;
                let half = (depth * (circle.radius + distance)).max(0.0).sqrt();
                Pair { foot, across: line.direction, half, depth }
            }
            (Curve::Circular(p), Curve::Circular(q)) => {
                let between = q.center - p.center;
                let d = length(between);
                let u = between / d;
                let (sum, difference) = (p.radius + q.radius, p.radius - q.radius);
                let (outer, inner) = (sum - d, d - difference.abs());
                // Heron's formula for the triangle of the centres and one of the points
                let heron = (sum + d) * outer * (d + difference) * (d - difference);
                let half = heron.max(0.0).sqrt() / (2.0 * d);
                let along = if outer <= tolerance {
                    p.radius - 0.5 * outer
                } else if inner <= tolerance {
                    libm::copysign(p.radius, difference)
                } else {
                    0.5 * (d + difference * (sum / d))
                };
                Pair { foot: p.center + u * along, across: Vector2::new(-u.y, u.x), half, depth: outer.min(inner) }
            }
            (Curve::Straight(_), Curve::Straight(_)) => return None,
        };
        (pair.depth >= -tolerance).then_some(pair)
    }

    /// Adds the points not yet found.
    fn complete(&self, a: &Curve, b: &Curve, tolerance: f64, found: &mut Vec<Meeting>) {
        let ends: Vec<Vector2<f64>> = found.iter().map(|m| m.point).collect();
        // an end may itself be off by the tolerance; up to four times that, the two points differ only by rounding
        if self.depth <= if ends.is_empty() { tolerance } else { 4.0 * tolerance } {
            if ends.is_empty()
                && let (Some(s), Some(t)) =
                    (a.locate(&self.foot, 2.0 * tolerance), b.locate(&self.foot, 2.0 * tolerance))
            {
                found.push(Meeting { point: self.foot, at: [s, t], kind: MeetingKind::Tangency });
            }
            return;
        }
        let side = |p: &Vector2<f64>| (p - self.foot).dot(&self.across);
        for sign in [-1.0, 1.0] {
            if ends.iter().any(|e| sign * side(e) > 0.0) {
                continue;
            }
            let point = match ends.first() {
                Some(other) => other - self.across * (2.0 * side(other)),
                None => self.foot + self.across * (sign * self.half),
            };
            if ends.iter().any(|e| length(e - point) <= 4.0 * tolerance) {
                continue;
            }
            // the centre of a flat arc is far away, and so is the foot: the straight curve is known more accurately
            let point = a.straightened(&b.straightened(&point));
            if let (Some(s), Some(t)) = (a.locate(&point, 2.0 * tolerance), b.locate(&point, 2.0 * tolerance)) {
                let end = a.is_end(s) || b.is_end(t);
                let kind = if end { MeetingKind::End } else { MeetingKind::Crossing };
                found.push(Meeting { point, at: [s, t], kind });
            }
        }
    }
}
