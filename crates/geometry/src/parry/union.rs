//! The outline of a union of shapes.
//!
//! Every figure is cut where it meets another shape's figures; a part survives if its outer side is inside no other
//! shape. Parts that lie on one another survive once if their interiors are on the same side, and not at all if the
//! shapes touch back to back.
use super::contour::{Contour, piece_of};
use crate::{
    Error, Extent, Figure, Piece,
    plane::{cross, is_finite},
    validate::crosses_itself,
};
use core::f64::consts::PI;
use nalgebra::Vector2;

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

/// All vertices, so that parts which meet share theirs bit for bit.
struct Vertices {
    points: Vec<Vector2<f64>>,
    same: f64,
}

impl Vertices {
    fn snap(&mut self, point: Vector2<f64>) -> Vector2<f64> {
        if let Some(known) = self.points.iter().find(|p| (*p - point).amax() <= self.same) {
            return *known;
        }
        self.points.push(point);
        point
    }
}

/// The outline of the union.
pub(crate) fn outline(members: &[Contour]) -> Result<Contour, Error> {
    let mut parts = vec![];
    for (member, contour) in members.iter().enumerate() {
        is_simple(contour)?;
        let figures = contour.figures.iter().map(|f| (*f, true));
        let screens = contour.screens.iter().map(|&ends| (Figure::Segment { ends }, false));
        for (figure, solid) in figures.chain(screens) {
            let piece = piece_of(&figure)?;
            let extent = piece.extent();
            parts.push(Part { figure, piece, extent, member, solid });
        }
    }
    let size = parts.iter().map(|p| p.extent.size()).fold(0.0, f64::max);
    let same = SAME * size;
    let mut vertices = Vertices { points: vec![], same };
    // the ends are exact: a crossing computed near one is replaced by it
    parts.iter().flat_map(Part::finite_ends).for_each(|end| _ = vertices.snap(end));
    let (mut figures, mut screens) = (vec![], vec![]);
    for part in &parts {
        let mut cuts = vec![];
        for other in parts.iter().filter(|o| o.member != part.member && part.extent.meets(&o.extent, same)) {
            cuts.extend(meetings(part, other, same));
        }
        for figure in split(part, &cuts, &mut vertices, size)? {
            let middle = middle(&figure, &cuts, size)?;
            if survives(part, &middle, &parts, members.len(), same) {
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
fn split(part: &Part, cuts: &[Vector2<f64>], vertices: &mut Vertices, size: f64) -> Result<Vec<Figure>, Error> {
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

/// Whether a part with this middle belongs to the outline.
fn survives(part: &Part, middle: &Vector2<f64>, parts: &[Part], members: usize, same: f64) -> bool {
    let own = part.piece.closest(middle).normal;
    (0..members).filter(|&m| m != part.member).all(|m| {
        let of_member = parts.iter().filter(|p| p.member == m);
        let solids = of_member.filter(|p| p.solid).map(|p| p.piece.closest(middle));
        let landings: Vec<_> = solids.map(|l| ((l.point - middle).norm(), l)).collect();
        let least = landings.iter().map(|(d, _)| *d).fold(f64::INFINITY, f64::min);
        let closest = landings.iter().filter(|(d, _)| *d <= least + same);
        if least > same {
            // of several equally near pieces, as at a vertex, the one seen least obliquely determines the side
            let heights = closest.map(|(_, l)| (middle - l.point).dot(&l.normal));
            return heights.reduce(|a, b| if b.abs() > a.abs() { b } else { a }).is_none_or(|height| height < 0.0);
        }
        let normal = closest.fold(Vector2::zeros(), |sum, (_, l)| sum + l.normal);
        // they lie on one another
        part.solid && own.dot(&normal) > 0.0 && part.member < m
    })
}
