//! Pieces that continue one another as one side.
use crate::{Figure, plane::slack, shapes::Segment, walls::Seam};
use nalgebra::Vector2;

/// One side of a chain: a piece, or several pieces of one straight line or circle.
#[derive(Debug)]
pub(super) struct Side {
    pub(super) figure: Figure,
    /// The same as a segment, if it is straight.
    pub(super) straight: Option<Segment>,
    /// The number of its first piece.
    pub(super) piece: usize,
}

/// The sides of a chain, starting with one that does not continue the one before it, and the seams between their pieces; `None` where
/// pieces are almost one side, but not quite.
pub(super) fn sides(chain: &[Side], is_corner: impl Fn(&Vector2<f64>) -> bool) -> Option<(Vec<Side>, Vec<Seam>)> {
    let count = chain.len();
    let goes_on = |i: usize| goes_on(&chain[i % count].figure, &chain[(i + 1) % count].figure, &is_corner);
    let from = (0..count).find(|&i| !goes_on(i + count - 1));
    let (mut sides, mut seams) = (vec![], vec![]);
    let mut i = from.unwrap_or(0);
    let end = i + count;
    while i < end {
        let next = (i + 1..end).find(|&k| !goes_on(k - 1)).unwrap_or(end);
        let pieces: Vec<&Side> = (i..next).map(|k| &chain[k % count]).collect();
        sides.push(joined(&pieces, from.is_none(), &mut seams)?);
        i = next;
    }
    Some((sides, seams))
}

/// Whether the second of two pieces may continue the first one as the same side.
fn goes_on(first: &Figure, second: &Figure, is_corner: impl Fn(&Vector2<f64>) -> bool) -> bool {
    match (first, second) {
        (Figure::Segment { ends: [_, b] }, Figure::Segment { ends: [c, _] }) => b == c && !is_corner(b),
        (
            Figure::Arc { center, radius, ends: [_, b], inside: true },
            Figure::Arc { center: c, radius: r, ends: [a, _], inside: true },
        ) => {
            let slack = slack([center.x, center.y, *radius]);
            b == a && !is_corner(b) && (center - c).amax() <= slack && (radius - r).abs() <= slack
        }
        _ => false,
    }
}

/// Pieces that continue one another, as one side, all around if it `closes`.
fn joined(pieces: &[&Side], closes: bool, seams: &mut Vec<Seam>) -> Option<Side> {
    let [first, others @ ..] = pieces else { return None };
    let last = others.last().unwrap_or(first);
    let piece = first.piece;
    if others.is_empty() {
        return Some(Side { figure: first.figure, straight: first.straight, piece });
    }
    match (first.figure, last.figure) {
        (Figure::Segment { ends: [a, _] }, Figure::Segment { ends: [_, b] }) => {
            let whole = Segment::new(a, b).ok()?;
            let normal = Vector2::from(whole.inward_normal());
            let slack = slack([a.x, a.y, b.x, b.y]);
            for pair in pieces.windows(2) {
                let [_, vertex] = pair[0].straight?.vertices().map(|p| Vector2::from(*p));
                if (vertex - a).dot(&normal).abs() > slack {
                    return None; // the side bends, if ever so little
                }
                let direction = Vector2::new(normal.y, -normal.x);
                seams.push(Seam::across(vertex, direction, [pair[0].piece, pair[1].piece]));
            }
            Some(Side { figure: Figure::Segment { ends: [a, b] }, straight: Some(whole), piece })
        }
        (Figure::Arc { center, radius, ends: [a, _], inside }, Figure::Arc { ends: [_, b], .. }) => {
            for other in others {
                if let Figure::Arc { ends, .. } = other.figure {
                    seams.push(Seam::around(ends, [piece, other.piece]));
                }
            }
            let figure = if closes {
                Figure::Circle { center, radius, inside }
            } else {
                Figure::Arc { center, radius, ends: [a, b], inside }
            };
            Some(Side { figure, straight: None, piece })
        }
        _ => None,
    }
}
