//! The outline of a union of shapes.
//!
//! Every figure is cut where it meets another shape's figures; a part survives if its outer side is inside no other
//! shape. Parts that lie on one another survive once if their interiors are on the same side, and not at all if the
//! shapes touch back to back.
use super::contour::{Contour, piece_of};
use crate::{
    BoxTree, Error, Extent, Figure, Landing, Piece,
    plane::{cross, is_finite, key},
    table::Vertices,
    validate::crosses_itself,
};
use core::f64::consts::PI;
use nalgebra::Vector2;
use std::collections::HashMap;

/// Points closer than this times the size of the whole are one point: cuts are computed to a few ulp, divided by the
/// sine of the angle at which the figures meet.
const SAME: f64 = 1e-12;

struct Part {
    figure: Figure,
    piece: Box<dyn Piece>,
    extent: Extent,
    member: usize,
    /// Bounds an interior; a screen does not.
    solid: bool,
}

impl Part {
    fn finite_ends(&self) -> impl Iterator<Item = Vector2<f64>> {
        self.piece.ends().into_iter().flatten().filter(is_finite)
    }
}

/// A member, whose parts can be searched by the boxes around them.
struct Member {
    /// The number of the first of its parts that bound its interior.
    first: usize,
    /// The boxes around these parts.
    tree: BoxTree,
    /// Everything farther from this than rounding is outside the member.
    reach: Extent,
}

impl Member {
    fn new(first: usize, parts: &[Part]) -> Member {
        let extents = parts.iter().map(|p| p.extent);
        let reach = if is_bounded(parts) { extents.clone().fold(Extent::EMPTY, Extent::union) } else { Extent::WHOLE };
        Member { first, tree: BoxTree::new(extents), reach }
    }

    /// The feet on its boundary that are nearest to a point within rounding, each with its distance, in the order of its parts.
    fn nearest(&self, point: &Vector2<f64>, parts: &[Part], same: f64) -> Vec<(f64, Landing)> {
        let foot = |k: usize| {
            let landing = parts[self.first + k].piece.closest(point);
            ((landing.point - point).norm(), landing)
        };
        let Some((distance, _)) = self.tree.nearest(point, f64::INFINITY, |k| foot(k).0) else { return vec![] };
        // the distance from a box is rounded, too
        let mut near = vec![];
        self.tree.search(|e| e.distance(point) <= distance + 2.0 * same, |k| near.push(k));
        near.sort_unstable();
        let mut feet: Vec<_> = near.into_iter().map(foot).collect();
        let least = feet.iter().map(|(d, _)| *d).fold(f64::INFINITY, f64::min);
        feet.retain(|(d, _)| *d <= least + same);
        feet
    }
}

/// Whether a boundary consists of closed loops. (A half-space or a height field reaches beyond the box around its boundary.)
fn is_bounded(parts: &[Part]) -> bool {
    let mut balance: HashMap<[u64; 2], i32> = HashMap::new();
    for [start, end] in parts.iter().filter_map(|p| p.piece.ends()) {
        *balance.entry(key(start)).or_default() += 1;
        *balance.entry(key(end)).or_default() -= 1;
    }
    parts.iter().all(|p| p.extent.is_finite()) && balance.values().all(|&b| b == 0)
}

/// The outline of the union.
pub(crate) fn outline(contours: &[Contour]) -> Result<Contour, Error> {
    let (mut parts, mut members) = (vec![], vec![]);
    for (member, contour) in contours.iter().enumerate() {
        is_simple(contour)?;
        let first = parts.len();
        let mut add = |figure: Figure, solid: bool| {
            let piece = piece_of(&figure)?;
            let extent = piece.extent();
            parts.push(Part { figure, piece, extent, member, solid });
            Ok(())
        };
        contour.figures.iter().try_for_each(|figure| add(*figure, true))?;
        contour.screens.iter().try_for_each(|&ends| add(Figure::Segment { ends }, false))?;
        members.push(Member::new(first, &parts[first..first + contour.figures.len()]));
    }
    let size = parts.iter().map(|p| p.extent.size()).fold(0.0, f64::max);
    let same = SAME * size;
    let cuts = cuts(&parts, same);
    // the ends are exact: a crossing computed near one is replaced by it
    let vertices = Vertices::new(parts.iter().flat_map(Part::finite_ends).chain(cuts.iter().flatten().copied()), same);
    let reaches = BoxTree::new(members.iter().map(|m| m.reach));
    let (mut figures, mut screens) = (vec![], vec![]);
    for (part, cuts) in parts.iter().zip(&cuts) {
        for figure in split(part, cuts, &vertices, size)? {
            let middle = middle(&figure, cuts, size)?;
            let mut survives = true;
            reaches.search(
                |e| e.distance(&middle) <= same,
                |m| survives = survives && (m == part.member || !hides(&members[m], m, part, &middle, &parts, same)),
            );
            if survives {
                match (part.solid, figure) {
                    (true, figure) => figures.push(figure),
                    (false, Figure::Segment { ends }) => screens.push(ends),
                    (false, _) => {}
                }
            }
        }
    }
    Ok(Contour { name: "compound", figures, screens })
}

/// For each part the points at which it must be cut because of other members.
fn cuts(parts: &[Part], same: f64) -> Vec<Vec<Vector2<f64>>> {
    let tree = BoxTree::new(parts.iter().map(|p| p.extent));
    let of_part = |part: &Part| {
        let mut near = vec![];
        tree.search(|e| e.meets(&part.extent, same), |k| near.push(k));
        near.sort_unstable();
        let others = near.into_iter().map(|k| &parts[k]).filter(|other| other.member != part.member);
        others.flat_map(|other| meetings(part, other, same)).collect()
    };
    parts.iter().map(of_part).collect()
}

/// Fails where an outline crosses itself: its inside would then change sides along it.
fn is_simple(contour: &Contour) -> Result<(), Error> {
    // an outline with arcs is that of a shape with a border, which is convex
    if !contour.figures.iter().all(|figure| matches!(figure, Figure::Segment { .. })) {
        return Ok(());
    }
    let outline = contour.figures.iter().map(piece_of).collect::<Result<_, _>>()?;
    crosses_itself(outline).map_or(Ok(()), |at| Err(Error::CrossedOutline { at }))
}

/// The straight line or the circle that carries a figure.
enum Carrier {
    Line { through: Vector2<f64>, direction: Vector2<f64> },
    Circle { center: Vector2<f64>, radius: f64 },
}

/// How two carriers meet.
enum Contact {
    /// At these points, if at all; nowhere if they coincide.
    Crossing(Vec<Vector2<f64>>),
    /// Tangentially. The two crossings found there by rounding would lie √ε off, not ε.
    Touching(Vector2<f64>),
}

impl Carrier {
    fn of(figure: &Figure) -> Option<Carrier> {
        let unit = |d: Vector2<f64>| d / libm::hypot(d.x, d.y);
        Some(match *figure {
            Figure::Segment { ends: [a, b] } => Carrier::Line { through: a, direction: unit(b - a) },
            Figure::Ray { from, direction, .. } => Carrier::Line { through: from, direction },
            Figure::Line { through, direction } => Carrier::Line { through, direction },
            Figure::Arc { center, radius, .. } | Figure::Circle { center, radius, .. } => {
                Carrier::Circle { center, radius }
            }
            Figure::Other => return None,
        })
    }

    /// Where two carriers meet; they touch if their distance there is at most `same`.
    fn meet(&self, other: &Carrier, same: f64) -> Contact {
        match (self, other) {
            (Carrier::Line { through: p, direction: d }, Carrier::Line { through: q, direction: e }) => {
                let sine = cross((*d).into(), (*e).into());
                let meets = sine.abs() > SAME;
                Contact::Crossing(
                    meets.then(|| p + d * (cross((q - p).into(), (*e).into()) / sine)).into_iter().collect(),
                )
            }
            (Carrier::Line { through, direction }, Carrier::Circle { center, radius })
            | (Carrier::Circle { center, radius }, Carrier::Line { through, direction }) => {
                let to_center = center - through;
                let foot = through + direction * to_center.dot(direction);
                let away = cross((*direction).into(), to_center.into()).abs();
                if (away - radius).abs() <= same {
                    return Contact::Touching(foot);
                }
                if away > *radius {
                    return Contact::Crossing(vec![]);
                }
                let half = libm::sqrt((radius - away) * (radius + away));
                Contact::Crossing(vec![foot - direction * half, foot + direction * half])
            }
            (Carrier::Circle { center: c, radius: r }, Carrier::Circle { center: k, radius: q }) => {
                let between = k - c;
                let distance = libm::hypot(between.x, between.y);
                if distance <= same {
                    return Contact::Crossing(vec![]);
                }
                let along = between / distance;
                // from outside, from inside, from around
                let tangent = [(r + q, *r), (q - r, -r), (r - q, *r)];
                if let Some((_, r)) = tangent.into_iter().find(|(at, _)| (distance - at).abs() <= same) {
                    return Contact::Touching(c + along * r);
                }
                if distance > r + q || distance < (r - q).abs() {
                    return Contact::Crossing(vec![]);
                }
                // from c towards k to the common chord
                let to_chord = 0.5 * (distance + (r - q) * (r + q) / distance);
                let half = libm::sqrt(((r - to_chord) * (r + to_chord)).max(0.0));
                let (foot, across) = (c + along * to_chord, Vector2::new(-along.y, along.x) * half);
                Contact::Crossing(vec![foot - across, foot + across])
            }
        }
    }
}

/// The points of `part` at which it must be cut because of `other`: where they cross, and where `other` ends on it.
fn meetings(part: &Part, other: &Part, same: f64) -> Vec<Vector2<f64>> {
    let (Some(own), Some(its)) = (Carrier::of(&part.figure), Carrier::of(&other.figure)) else { return vec![] };
    let on = |p: &Vector2<f64>, part: &Part| (part.piece.closest(p).point - p).amax() <= same;
    let on_both = |p: &Vector2<f64>| on(p, part) && on(p, other);
    let mut points: Vec<_> = other.finite_ends().filter(|p| on(p, part)).collect();
    // in the same order for both, so that both are cut at exactly the same points
    match if part.member < other.member { own.meet(&its, same) } else { its.meet(&own, same) } {
        Contact::Crossing(at) => points.extend(at.into_iter().filter(on_both)),
        // where one ends on the other, they touch at that end
        Contact::Touching(at) => {
            if points.is_empty() && !part.finite_ends().any(|p| on(&p, other)) && on_both(&at) {
                points.push(at);
            }
        }
    }
    points
}

/// The parts between the cuts.
fn split(part: &Part, cuts: &[Vector2<f64>], vertices: &Vertices, size: f64) -> Result<Vec<Figure>, Error> {
    let s_of = |p: &Vector2<f64>| part.piece.arc_length_at(p);
    let mut along: Vec<(f64, Vector2<f64>)> = cuts.iter().map(|p| (s_of(p), vertices.snap(*p))).collect();
    let closed = matches!(part.figure, Figure::Circle { .. });
    let mut ends = vec![];
    for end in part.piece.ends().into_iter().flatten() {
        ends.push(if is_finite(&end) { vertices.snap(end) } else { end });
    }
    along.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut stops: Vec<Vector2<f64>> = vec![];
    stops.extend(ends.first());
    for (_, p) in along {
        if stops.last() != Some(&p) && ends.last() != Some(&p) {
            stops.push(p);
        }
    }
    stops.extend(ends.last());
    if closed {
        if stops.len() > 1 && stops.first() == stops.last() {
            stops.pop();
        }
        match stops[..] {
            [] | [_] => return Ok(vec![part.figure]),
            [first, ..] => stops.push(first),
        }
    }
    let mut figures = vec![];
    for pair in stops.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        if a == b {
            continue;
        }
        figures.push(match part.figure {
            Figure::Arc { center, radius, inside, .. } | Figure::Circle { center, radius, inside } => {
                Figure::Arc { center, radius, ends: [a, b], inside }
            }
            Figure::Segment { .. } => Figure::Segment { ends: [a, b] },
            Figure::Ray { direction, .. } | Figure::Line { direction, .. } => match (is_finite(&a), is_finite(&b)) {
                (true, true) => Figure::Segment { ends: [a, b] },
                (true, false) => Figure::Ray { from: a, direction: outgoing(&part.figure, direction), left: true },
                (false, true) => Figure::Ray { from: b, direction: -outgoing(&part.figure, direction), left: false },
                (false, false) => part.figure,
            },
            Figure::Other => return Err(Error::Empty),
        });
    }
    // an arc must not be shorter than the distance by which its ends were moved
    let most = part.piece.length() + size;
    figures.retain(|f| piece_of(f).is_ok_and(|p| p.length() > SAME * size && p.length() <= most));
    Ok(figures)
}

/// The direction of traversal of a line or a ray.
fn outgoing(figure: &Figure, direction: Vector2<f64>) -> Vector2<f64> {
    if let Figure::Ray { left: false, .. } = figure { -direction } else { direction }
}

/// A point well inside a part that was cut at `cuts`.
fn middle(figure: &Figure, cuts: &[Vector2<f64>], size: f64) -> Result<Vector2<f64>, Error> {
    let piece = piece_of(figure)?;
    Ok(match figure {
        Figure::Ray { from, direction, .. } => from + direction * size,
        // a whole circle is cut only where another shape touches it, if at all
        Figure::Circle { center, radius, .. } => {
            cuts.first().map_or_else(|| piece.point_at(PI * radius), |touched| center * 2.0 - touched)
        }
        Figure::Line { through, .. } => *through,
        _ => piece.point_at(0.5 * piece.length()),
    })
}

/// Whether a member hides a part with this middle.
fn hides(member: &Member, number: usize, part: &Part, middle: &Vector2<f64>, parts: &[Part], same: f64) -> bool {
    let feet = member.nearest(middle, parts, same);
    if feet.iter().all(|(distance, _)| *distance > same) {
        // of several equally near pieces, as at a vertex, the one seen least obliquely determines the side
        let heights = feet.iter().map(|(_, foot)| (middle - foot.point).dot(&foot.normal));
        return heights.reduce(|a, b| if b.abs() > a.abs() { b } else { a }).is_some_and(|height| height >= 0.0);
    }
    let normal = feet.iter().fold(Vector2::zeros(), |sum, (_, foot)| sum + foot.normal);
    // they lie on one another
    !(part.solid && part.piece.closest(middle).normal.dot(&normal) > 0.0 && part.member < number)
}
