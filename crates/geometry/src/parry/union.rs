//! The outline of a union of shapes.
//!
//! Every figure is cut where it meets another shape's figures; a part survives if its outer side is nobody's inside.
//! Parts that lie on one another survive once if their interiors are on the same side, and not at all if the shapes
//! touch back to back.
use super::contour::{Contour, piece_of};
use crate::{Error, Extent, Figure, Piece, plane::cross};
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
        let figures = contour.figures.iter().map(|f| (*f, true));
        let screens = contour.screens.iter().map(|&ends| (Figure::Segment { ends }, false));
        for (figure, solid) in figures.chain(screens) {
            let piece = piece_of(&figure)?;
            let extent = piece.extent();
            parts.push(Part { figure, piece, extent, member, solid });
        }
    }
    let coordinates = parts.iter().flat_map(|p| [p.extent.min, p.extent.max]);
    let size = coordinates.flat_map(|v| [v.x, v.y]).filter(|x| x.is_finite()).fold(0.0, |m: f64, x| m.max(x.abs()));
    let same = SAME * size;
    let mut vertices = Vertices { points: vec![], same };
    let (mut figures, mut screens) = (vec![], vec![]);
    for part in &parts {
        let mut cuts = vec![];
        for other in parts.iter().filter(|o| o.member != part.member && near(&part.extent, &o.extent, same)) {
            cuts.extend(meetings(part, other, same));
        }
        for figure in split(part, &cuts, &mut vertices, size)? {
            let middle = middle(&figure, size)?;
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

fn near(a: &Extent, b: &Extent, same: f64) -> bool {
    (0..2).all(|i| a.min[i] <= b.max[i] + same && b.min[i] <= a.max[i] + same)
}

/// The straight line or the circle that carries a figure.
enum Carrier {
    Line { through: Vector2<f64>, direction: Vector2<f64> },
    Circle { center: Vector2<f64>, radius: f64 },
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

    /// Where two carriers meet; none if they coincide.
    fn meet(&self, other: &Carrier) -> Vec<Vector2<f64>> {
        match (self, other) {
            (Carrier::Line { through: p, direction: d }, Carrier::Line { through: q, direction: e }) => {
                let sine = cross((*d).into(), (*e).into());
                if sine.abs() <= SAME { vec![] } else { vec![p + d * (cross((q - p).into(), (*e).into()) / sine)] }
            }
            (Carrier::Line { through, direction }, Carrier::Circle { center, radius })
            | (Carrier::Circle { center, radius }, Carrier::Line { through, direction }) => {
                let to_center = center - through;
                let foot = through + direction * to_center.dot(direction);
                let away = cross((*direction).into(), to_center.into()).abs();
                if away > radius * (1.0 + SAME) {
                    return vec![];
                }
                let half = libm::sqrt(((radius - away) * (radius + away)).max(0.0));
                vec![foot - direction * half, foot + direction * half]
            }
            (Carrier::Circle { center: c, radius: r }, Carrier::Circle { center: k, radius: q }) => {
                let between = k - c;
                let distance = libm::hypot(between.x, between.y);
                let size = r + q;
                if distance <= SAME * size || distance > size * (1.0 + SAME) || distance < (r - q).abs() - SAME * size {
                    return vec![];
                }
                let along = between / distance;
                // from c towards k to the common chord
                let to_chord = 0.5 * (distance + (r - q) * (r + q) / distance);
                let half = libm::sqrt(((r - to_chord) * (r + to_chord)).max(0.0));
                let (foot, across) = (c + along * to_chord, Vector2::new(-along.y, along.x) * half);
                vec![foot - across, foot + across]
            }
        }
    }
}

/// The points of `part` at which it must be cut because of `other`: where they cross, and where `other` ends on it.
fn meetings(part: &Part, other: &Part, same: f64) -> Vec<Vector2<f64>> {
    let (Some(own), Some(its)) = (Carrier::of(&part.figure), Carrier::of(&other.figure)) else { return vec![] };
    let on = |p: &Vector2<f64>, piece: &dyn Piece| (piece.closest(p).point - p).amax() <= same;
    let mut points = own.meet(&its);
    points.retain(|p| on(p, &*other.piece));
    points.extend(other.piece.ends().into_iter().flatten().filter(|p| p.iter().all(|x| x.is_finite())));
    points.retain(|p| on(p, &*part.piece));
    points
}

/// The parts between the cuts.
fn split(part: &Part, cuts: &[Vector2<f64>], vertices: &mut Vertices, size: f64) -> Result<Vec<Figure>, Error> {
    let s_of = |p: &Vector2<f64>| part.piece.arc_length_at(p);
    let mut along: Vec<(f64, Vector2<f64>)> = cuts.iter().map(|p| (s_of(p), vertices.snap(*p))).collect();
    let closed = matches!(part.figure, Figure::Circle { .. });
    let mut ends = vec![];
    for end in part.piece.ends().into_iter().flatten() {
        ends.push(if end.iter().all(|x| x.is_finite()) { vertices.snap(end) } else { end });
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
            Figure::Ray { direction, .. } | Figure::Line { direction, .. } => {
                let finite = |p: &Vector2<f64>| p.iter().all(|x| x.is_finite());
                match (finite(&a), finite(&b)) {
                    (true, true) => Figure::Segment { ends: [a, b] },
                    (true, false) => Figure::Ray { from: a, direction: outgoing(&part.figure, direction), left: true },
                    (false, true) => {
                        Figure::Ray { from: b, direction: -outgoing(&part.figure, direction), left: false }
                    }
                    (false, false) => part.figure,
                }
            }
            Figure::Other => return Err(Error::Empty),
        });
    }
    // an arc must not be shorter than what its ends were moved by
    let most = part.piece.length() + size;
    figures.retain(|f| piece_of(f).is_ok_and(|p| p.length() > SAME * size && p.length() <= most));
    Ok(figures)
}

/// The direction of traversal of a line or a ray.
fn outgoing(figure: &Figure, direction: Vector2<f64>) -> Vector2<f64> {
    if let Figure::Ray { left: false, .. } = figure { -direction } else { direction }
}

/// A point well inside a part.
fn middle(figure: &Figure, size: f64) -> Result<Vector2<f64>, Error> {
    let piece = piece_of(figure)?;
    Ok(match figure {
        Figure::Ray { from, direction, .. } => from + direction * size,
        Figure::Circle { radius, .. } => piece.point_at(PI * radius),
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
        let Some(&(distance, first)) = closest.clone().next() else { return true };
        // at a vertex the sum of the normals decides
        let same_point = closest.filter(|(_, l)| (l.point - first.point).amax() <= 2.0 * same);
        let normal = same_point.fold(Vector2::zeros(), |sum, (_, l)| sum + l.normal);
        if distance > same {
            return (middle - first.point).dot(&normal) < 0.0;
        }
        // they lie on one another
        part.solid && own.dot(&normal) > 0.0 && part.member < m
    })
}
