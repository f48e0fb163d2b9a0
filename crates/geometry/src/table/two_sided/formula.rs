//! Curves of other kinds that coincide from end to end.
use crate::{Piece, plane::slack};

/// Fractions of the length at which two curves are compared: not simple ones, since those may be special points of
/// both.
const PLACES: [f64; 5] = [0.0917, 0.2839, 0.4613, 0.6427, 0.8871];

/// The numbers of the curves that run along the whole of another one that has the table on the other side.
pub(super) fn doubles<'a>(pieces: impl Iterator<Item = (usize, &'a dyn Piece)>) -> Vec<usize> {
    let mut pieces: Vec<_> = pieces.map(|(number, piece)| (piece.extent(), number, piece)).collect();
    pieces.sort_by(|(a, ..), (b, ..)| a.min.x.total_cmp(&b.min.x));
    let mut found = vec![];
    for (k, (extent, i, a)) in pieces.iter().enumerate() {
        let rounding = slack([extent.size()]);
        let near = pieces[k + 1..].iter().take_while(|(other, ..)| other.min.x - extent.min.x <= rounding);
        for (other, j, b) in near {
            let apart = (other.min - extent.min).amax().max((other.max - extent.max).amax());
            if apart <= rounding && coincide(*a, *b, rounding) {
                found.extend([*i, *j]);
            }
        }
    }
    found
}

fn coincide(a: &dyn Piece, b: &dyn Piece, rounding: f64) -> bool {
    PLACES.iter().all(|place| {
        let at = a.landing_at(place * a.length());
        let foot = b.closest(&at.point);
        (foot.point - at.point).norm() <= rounding && foot.normal.dot(&at.normal) < 0.0
    })
}
