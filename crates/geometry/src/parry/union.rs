//! The outline of a union of shapes.
//!
//! Every figure is cut where it meets another shape's figures; a part survives if its outer side is inside no other
//! shape. Parts that lie on one another survive once if their interiors are on the same side, and not at all if the
//! shapes touch back to back.
mod member;
mod vertices;

use super::contour::{Contour, piece_of};
use crate::{
    BoxTree, Error, Extent, Figure, Piece,
    plane::{is_finite, slack},
    table::with_ends,
    validate::crosses_itself,
};
use core::f64::consts::PI;
use member::Member;
use nalgebra::Vector2;
use vertices::Vertices;

/// A figure of a member.
struct Part {
    figure: Figure,
    piece: Box<dyn Piece>,
    extent: Extent,
    member: usize,
    /// Bounds an interior; a screen does not.
    solid: bool,
}

/// The outline of the union.
pub(crate) fn outline(contours: &[Contour]) -> Result<Contour, Error> {
    let (mut parts, mut ranges) = (vec![], vec![]);
    for (member, contour) in contours.iter().enumerate() {
        is_simple(contour)?;
        ranges.push(parts.len()..parts.len() + contour.figures.len());
        let figures = contour.figures.iter().map(|f| (*f, true));
        let screens = contour.screens.iter().map(|&ends| (Figure::Segment { ends }, false));
        for (figure, solid) in figures.chain(screens) {
            let piece = piece_of(&figure)?;
            let extent = piece.extent();
            parts.push(Part { figure, piece, extent, member, solid });
        }
    }
    // the extent of a line at an angle is infinite in all directions
    let of_part = |p: &Part| p.extent.size().max(p.piece.point_at(0.0).amax());
    let size = parts.iter().map(of_part).fold(0.0, f64::max);
    let near = 4.0 * slack([size]);
    let members: Vec<Member> = ranges.into_iter().enumerate().map(|(m, range)| Member::new(m, &parts[range])).collect();
    let reaches = BoxTree::new(members.iter().map(|m| m.reach));
    let (mut figures, mut screens) = (vec![], vec![]);
    for (part, points) in parts.iter().zip(Vertices::new(&parts, near).of_parts()) {
        for figure in split(part, &points) {
            let middle = middle(&figure, &points, size)?;
            let mut survives = true;
            reaches.search(
                |e| e.distance(&middle) <= near,
                |m| survives = survives && (m == part.member || !members[m].hides(part, &middle, near)),
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

/// Fails where an outline crosses itself: its inside would then change sides along it.
fn is_simple(contour: &Contour) -> Result<(), Error> {
    // an outline with arcs is that of a shape with a border, which is convex
    if !contour.figures.iter().all(|figure| matches!(figure, Figure::Segment { .. })) {
        return Ok(());
    }
    let outline = contour.figures.iter().map(piece_of).collect::<Result<_, _>>()?;
    crosses_itself(outline).map_or(Ok(()), |at| Err(Error::CrossedOutline { at }))
}

/// What lies between the points of a part at which it is cut. Its finite ends are the first of these points.
fn split(part: &Part, points: &[Vector2<f64>]) -> Vec<Figure> {
    let mut points = points.iter().copied();
    let mut place = |end: Vector2<f64>| if is_finite(&end) { points.next().unwrap_or(end) } else { end };
    let ends = part.piece.ends().map(|[a, b]| [place(a), place(b)]);
    let cuts = points.filter(|p| ends.is_none_or(|ends| !ends.contains(p)));
    let mut along: Vec<(f64, Vector2<f64>)> = cuts.map(|p| (part.piece.arc_length_at(&p), p)).collect();
    along.sort_by(|(s, _), (t, _)| s.total_cmp(t));
    along.dedup();
    let mut stops: Vec<Vector2<f64>> = along.into_iter().map(|(_, p)| p).collect();
    if let Some([a, b]) = ends {
        stops.insert(0, a);
        stops.push(b);
    } else if stops.len() < 2 {
        // a circle that is only touched is cut nowhere
        return vec![part.figure];
    } else {
        stops.push(stops[0]);
    }
    let pairs = stops.windows(2).map(|pair| [pair[0], pair[1]]);
    pairs.filter(|[a, b]| a != b).map(|ends| with_ends(part.figure, ends)).collect()
}

/// A point well inside a part that was cut at these points.
fn middle(figure: &Figure, points: &[Vector2<f64>], size: f64) -> Result<Vector2<f64>, Error> {
    let piece = piece_of(figure)?;
    Ok(match figure {
        Figure::Ray { from, direction, .. } => from + direction * if size > 0.0 { size } else { 1.0 },
        // a whole circle is cut only where another shape touches it, if at all
        Figure::Circle { center, radius, .. } => {
            points.first().map_or_else(|| piece.point_at(PI * radius), |touched| center * 2.0 - touched)
        }
        Figure::Line { through, .. } => *through,
        _ => piece.point_at(0.5 * piece.length()),
    })
}
