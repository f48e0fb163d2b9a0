//! Curves of any kind, by subdivision over their arc length.
//!
//! An arc of length `ℓ` from `p` to `q` lies in the ellipse with foci `p`, `q` and sum of focal distances `ℓ`; two arcs whose ellipses are
//! disjoint do not meet. Arcs that turn less than their chords differ in direction meet at most once, and Newton's method decides, unless it
//! leads out of them.
use super::{Meeting, MeetingKind, along};
use crate::{
    Landing, Piece,
    piece::rounding,
    plane::{is_finite, slack},
};
use nalgebra::Vector2;

/// Most pairs of arcs examined before the pieces are taken to run along each other.
const PATIENCE: usize = 50_000;

/// Arcs shorter than this fraction of the whole that cannot be told apart touch: their distance, quadratic in their length, is below
/// rounding.
const TOUCHING: f64 = 1.0 / 33_554_432.0; // 2⁻²⁵

/// Arcs shorter than this fraction of the whole are so nearly straight that only their curvature tells how they bend: a sagitta of the size
/// of rounding `ε` corresponds to a length of `√ε` to `ε^{1/3}`.
const SHORT: f64 = 1.0 / 8192.0;

/// A short arc that seems to turn by more than this (radians), and is longer than its chord by more than rounding, really does so, whatever
/// the curvature at its ends: there is a sharp bend between them.
const HIDDEN: f64 = 1e-2;

/// Newton's method has come down to the rounding of the points if eight times its last step is shorter than this fraction of the stretches.
/// Where it is held at the limits of its search, beyond an end, its steps are a larger fraction of them, however short they are.
const SETTLED: f64 = 1.0 / 16.0;

/// A point of a piece.
#[derive(Clone, Copy, Debug)]
struct Mark {
    s: f64,
    point: Vector2<f64>,
    normal: Vector2<f64>,
    curvature: f64,
}

impl Mark {
    fn new(piece: &dyn Piece, s: f64) -> Mark {
        let Landing { point, normal } = piece.landing_at(s);
        Mark { s, point, normal, curvature: piece.curvature(&point).abs() }
    }
}

/// Part of a piece.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    from: Mark,
    to: Mark,
}

/// The ellipse around a stretch.
struct Hull {
    middle: Vector2<f64>,
    /// Unit vector along the chord.
    along: Vector2<f64>,
    semi_axes: [f64; 2],
    /// A bound, with some margin, on the deviation of the direction from the chord's (radians).
    turning: f64,
}

impl Stretch {
    fn length(&self) -> f64 {
        self.to.s - self.from.s
    }

    /// The ellipse; `short` is the length below which the rounding of `ℓ − c` hides how the stretch bends, and its
    /// curvature does not vary much.
    fn hull(&self, rounding: f64, short: f64) -> Hull {
        let length = self.length();
        let chord = self.to.point - self.from.point;
        let distance = libm::hypot(chord.x, chord.y);
        // the arc is longer than its chord by at most this much: where rounding makes it seem shorter, it may still bend by more than that
        let longer = (length - distance).max(0.0) + rounding;
        let excess = (longer * (length + distance)).sqrt();
        let along = if distance > 0.0 { chord / distance } else { Vector2::new(1.0, 0.0) };
        // c/ℓ = 1 − φ²/24 for an arc that turns by φ
        let spread = (24.0 * longer / length).sqrt();
        // where it turns next to one end, it is hardly longer than its chord, but that end shows it
        let turned = [self.from, self.to].map(|mark| mark.normal.dot(&along).abs());
        let bend = 2.0 * self.from.curvature.max(self.to.curvature) * length;
        let seems_flat = spread < HIDDEN || length - distance <= 8.0 * rounding;
        let (height, turning) = if length <= short && bend < 0.1 && seems_flat {
            // nor is the direction of so short a chord known any better
            let unknown = 0.25 * rounding / length;
            ((0.125 * bend * length).min(0.5 * excess), bend.min(spread).max(unknown))
        } else {
            let turning = spread.max(turned[0]).max(turned[1]);
            (0.5 * excess, if spread < 0.3 { turning } else { f64::INFINITY })
        };
        Hull {
            middle: (self.from.point + self.to.point) * 0.5,
            along,
            semi_axes: [0.5 * length.max(distance) + rounding, height + rounding],
            turning,
        }
    }

    fn halves(&self, piece: &dyn Piece) -> [Stretch; 2] {
        let middle = Mark::new(piece, 0.5 * (self.from.s + self.to.s));
        [Stretch { from: self.from, to: middle }, Stretch { from: middle, to: self.to }]
    }
}

impl Hull {
    fn half_width(&self, u: &Vector2<f64>) -> f64 {
        libm::hypot(self.semi_axes[0] * u.dot(&self.along), self.semi_axes[1] * u.perp(&self.along))
    }

    fn apart(&self, other: &Hull) -> bool {
        let across = |u: &Vector2<f64>| Vector2::new(-u.y, u.x);
        let between = other.middle - self.middle;
        [self.along, across(&self.along), other.along, across(&other.along)]
            .iter()
            .any(|u| between.dot(u).abs() > self.half_width(u) + other.half_width(u))
    }
}

/// The range of arc length of `piece` that can meet something in the box around `other`.
fn range(piece: &dyn Piece, other: &dyn Piece) -> Option<[f64; 2]> {
    let length = piece.length();
    if length.is_finite() {
        return Some([0.0, length]);
    }
    let extent = other.extent();
    if !extent.is_finite() {
        return None;
    }
    let middle = (extent.min + extent.max) * 0.5;
    let reach = libm::hypot(extent.max.x - extent.min.x, extent.max.y - extent.min.y);
    let s = piece.arc_length_at(&middle);
    let off = libm::hypot(piece.point_at(s).x - middle.x, piece.point_at(s).y - middle.y);
    if off > reach {
        return None;
    }
    // at the end of a half-infinite piece the parameter is 0
    let ends = piece.ends().map_or([false; 2], |e| e.map(|p| is_finite(&p)));
    let low = if ends[0] { (s - reach).max(0.0) } else { s - reach };
    let high = if ends[1] { (s + reach).min(0.0) } else { s + reach };
    (low < high).then_some([low, high])
}

pub(super) fn meetings(a: &dyn Piece, b: &dyn Piece) -> Vec<Meeting> {
    let (Some(p), Some(q)) = (range(a, b), range(b, a)) else { return vec![] };
    let size = a.extent().size().max(b.extent().size());
    // curves given by formulas are solved to a few ulp more than coordinates; the points of a flat arc are known only as well as its centre
    let tolerance = 4.0 * slack([size]).max(rounding(a)).max(rounding(b));
    let mut found = vec![];
    ends_on(a, b, tolerance, |point, s, t| Meeting { point, at: [s, t], kind: MeetingKind::End }, &mut found);
    ends_on(b, a, tolerance, |point, t, s| Meeting { point, at: [s, t], kind: MeetingKind::End }, &mut found);
    search([a, b], [p, q], tolerance, &mut found);
    found
}

/// The finite ends of `a` that lie on `b`.
fn ends_on(
    a: &dyn Piece,
    b: &dyn Piece,
    tolerance: f64,
    meeting: impl Fn(Vector2<f64>, f64, f64) -> Meeting,
    found: &mut Vec<Meeting>,
) {
    let Some([start, end]) = a.ends() else { return };
    let last = if is_finite(&start) { a.length() } else { 0.0 };
    for (point, s) in [(start, 0.0), (end, last)] {
        if !is_finite(&point) {
            continue;
        }
        let lies = |b: &dyn Piece| (b.closest(&point).point - point).norm() <= tolerance;
        let near = |m: &Meeting| (m.point - point).norm() <= 4.0 * tolerance;
        if (b.ends().is_some_and(|ends| ends.contains(&point)) || lies(b)) && !found.iter().any(near) {
            found.push(meeting(point, s, b.arc_length_at(&point)));
        }
    }
}

/// Adds the meetings of two ranges of arc length of two pieces, apart from those at ends.
pub(super) fn search(pieces: [&dyn Piece; 2], ranges: [[f64; 2]; 2], tolerance: f64, found: &mut Vec<Meeting>) {
    let whole =
        [0, 1].map(|k| Stretch { from: Mark::new(pieces[k], ranges[k][0]), to: Mark::new(pieces[k], ranges[k][1]) });
    let rounding = 0.25 * tolerance;
    let longest = whole[0].length().max(whole[1].length());
    let (least, short) = (TOUCHING * longest, SHORT * longest);
    // a closed curve is halved first, since its chord has no direction
    let mut open = vec![];
    for a in whole[0].halves(pieces[0]) {
        for b in whole[1].halves(pieces[1]) {
            open.push([a, b]);
        }
    }
    let mut touching: Vec<[f64; 2]> = vec![];
    let mut steps = 0;
    while let Some(pair) = open.pop() {
        let hulls = pair.map(|s| s.hull(rounding, short));
        if hulls[0].apart(&hulls[1]) {
            continue;
        }
        steps += 1;
        let sine = hulls[0].along.perp(&hulls[1].along).abs();
        if sine > 2.0 * (hulls[0].turning + hulls[1].turning) {
            let answer = newton(pieces, pair, &hulls, tolerance);
            if let Answer::Crossing(m, known) = answer {
                let touch = touching_at(pieces, &m, tolerance);
                let near = touch.unwrap_or(8.0 * known / sine);
                if !found.iter().any(|n| (n.point - m.point).norm() <= near) {
                    found.push(if touch.is_some() { Meeting { kind: MeetingKind::Tangency, ..m } } else { m });
                }
            }
            if !matches!(answer, Answer::Undecided) {
                continue;
            }
        }
        if steps > PATIENCE {
            overlap(pieces, ranges, tolerance, found);
            return;
        }
        let longer = usize::from(pair[1].length() > pair[0].length());
        if pair[longer].length() <= least {
            touching.push(pair.map(|s| 0.5 * (s.from.s + s.to.s)));
            continue;
        }
        for half in pair[longer].halves(pieces[longer]) {
            let mut next = pair;
            next[longer] = half;
            open.push(next);
        }
    }
    for at in touching {
        let point = pieces[0].point_at(at[0]);
        // neighbouring stretches that touch are one meeting
        if !found.iter().any(|m| (m.point - point).norm() <= 64.0 * least) {
            found.push(Meeting { point, at, kind: MeetingKind::Tangency });
        }
    }
}

/// If the curves touch at a crossing, that is, if they may cross again with no more than rounding between them on the way: the distance
/// within which that other crossing lies.
///
/// Curves that cross at an angle with the sine `σ` and bend apart by `κ` cross again after `2σ/κ`, and are up to `σ²/2κ` apart in between.
/// Twice that distance is allowed for, since curvatures vary.
fn touching_at(pieces: [&dyn Piece; 2], crossing: &Meeting, tolerance: f64) -> Option<f64> {
    let normals = [0, 1].map(|k| pieces[k].landing_at(crossing.at[k]).normal);
    let bends = pieces.map(|piece| piece.curvature(&crossing.point));
    let apart = (bends[0] - bends[1].copysign(bends[1] * normals[0].dot(&normals[1]))).abs();
    let sine = normals[0].perp(&normals[1]).abs();
    // where curves touch, Newton steps only halve, and stop within four tolerances
    (sine * sine <= 2.0 * apart * (8.0 * tolerance)).then(|| 4.0 * sine / apart)
}

/// The range of arc lengths of a piece; beyond it `point_at` may stay at the end.
fn domain(piece: &dyn Piece) -> [f64; 2] {
    let Some([start, end]) = piece.ends() else { return [f64::NEG_INFINITY, f64::INFINITY] };
    match [start, end].map(|p| is_finite(&p)) {
        [true, true] => [0.0, piece.length()],
        [true, false] => [0.0, f64::INFINITY],
        [false, true] => [f64::NEG_INFINITY, 0.0],
        [false, false] => [f64::NEG_INFINITY, f64::INFINITY],
    }
}

/// Whether two nearly straight stretches cross.
enum Answer {
    /// They do, and the position is this accurate.
    Crossing(Meeting, f64),
    /// They do not.
    Apart,
    /// Newton's method leads out of the stretches, or does not converge: they are to be halved further.
    Undecided,
}

/// The crossing of two nearly straight stretches.
fn newton(pieces: [&dyn Piece; 2], pair: [Stretch; 2], hulls: &[Hull; 2], tolerance: f64) -> Answer {
    let mut at = pair.map(|s| 0.5 * (s.from.s + s.to.s));
    let (mut last, mut rest) = (f64::INFINITY, f64::INFINITY);
    let mut point = hulls[0].middle;
    // the accuracy of a position given by its arc length or its parameter: on a winding or steep piece, less than that of its coordinates
    let known = |k: usize| (4.0 * f64::EPSILON * pair[k].from.s.abs().max(pair[k].to.s.abs())).max(pieces[k].shift());
    let tolerance = tolerance.max(known(0)).max(known(1));
    let domains = pieces.map(domain);
    // point and direction; beyond its ends a piece is continued straight, so that a step too far is followed by one back
    let place = |k: usize, s: f64| {
        let inner = s.clamp(domains[k][0], domains[k][1]);
        let landing = pieces[k].landing_at(inner);
        let direction = along(&landing.normal);
        (if s == inner { landing.point } else { landing.point + direction * (s - inner) }, direction)
    };
    let mut places = [0, 1].map(|k| (place(k, at[k]).0, hulls[k].along));
    for _ in 0..32 {
        let [(first, along), (second, other)] = places;
        point = (first + second) * 0.5;
        let gap = second - first;
        let sine = along.perp(&other);
        let step = [gap.perp(&other) / sine, gap.perp(&along) / sine];
        let size = step[0].abs().max(step[1].abs());
        rest = size;
        if size.is_nan() || size >= 0.5 * last {
            break;
        }
        last = size;
        for k in 0..2 {
            // a little beyond the ends: the crossing may be the vertex itself
            let room = 0.5 * pair[k].length();
            at[k] = (at[k] + step[k]).clamp(pair[k].from.s - room, pair[k].to.s + room);
        }
        if size <= f64::EPSILON * (at[0].abs() + at[1].abs()) {
            break;
        }
        places = [0, 1].map(|k| place(k, at[k]));
    }
    let [(_, along), (_, other)] = places;
    let converged = last <= 4.0 * tolerance / along.perp(&other).abs();
    // points of a steep formula are less accurate than all others, since they move by the slope times the rounding of the angle: there
    // steps stop shrinking early, and whether the pieces cross is decided a little before and behind
    let way = 8.0 * rest.max(last);
    if !converged && pair.iter().any(|s| way > SETTLED * s.length()) {
        return Answer::Undecided;
    }
    let crosses = || {
        let passes = |k: usize| {
            let (through, along) = places[1 - k];
            let [before, behind] = [-way, way].map(|step| along.perp(&(place(k, at[k] + step).0 - through)));
            before * behind < 0.0
        };
        passes(0) && passes(1)
    };
    let known = if converged { tolerance } else { tolerance.max(way) };
    let inside = (0..2).all(|k| pair[k].from.s - known <= at[k] && at[k] <= pair[k].to.s + known);
    if inside && (converged || crosses()) {
        Answer::Crossing(Meeting { point, at, kind: MeetingKind::Crossing }, known)
    } else {
        Answer::Apart
    }
}

/// For pieces that run along each other: the common stretch begins and ends at ends of the pieces.
fn overlap(pieces: [&dyn Piece; 2], ranges: [[f64; 2]; 2], tolerance: f64, found: &mut Vec<Meeting>) {
    found.retain(|m| m.kind == MeetingKind::End);
    for m in found.iter_mut() {
        m.kind = MeetingKind::Overlap;
    }
    for s in ranges[0] {
        if found.len() < 2 {
            let point = pieces[0].point_at(s);
            let t = pieces[1].arc_length_at(&point);
            if (pieces[1].point_at(t) - point).norm() <= tolerance {
                found.push(Meeting { point, at: [s, t], kind: MeetingKind::Overlap });
            }
        }
    }
}
