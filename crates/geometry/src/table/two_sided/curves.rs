//! Curves given by formulas that coincide with other pieces of any kind.
use crate::{
    BoxTree, Extent, Figure, Piece,
    copies::Translate,
    piece::rounding,
    plane::{is_finite, slack},
};
use nalgebra::Vector2;

/// Fractions of a stretch at which two pieces are compared: not simple ones, since those may be special points of both.
const PLACES: [f64; 5] = [0.0917, 0.2839, 0.4613, 0.6427, 0.8871];

/// A stretch shorter than this times the distance that counts as none says nothing: on either side of a corner pieces are as near.
const SHORT: f64 = 1024.0;

/// The numbers of the pieces that coincide, at least in part, with another one that has the table on the other side, where one of the two
/// is given by a formula.
pub(super) fn doubles(pieces: &[Translate]) -> Vec<usize> {
    let is_formula = |copy: &Translate| copy.piece.shape().is_none() && copy.piece.figure() == Figure::Other;
    let formulas: Vec<usize> = (0..pieces.len()).filter(|&i| is_formula(&pieces[i])).collect();
    if formulas.is_empty() {
        return vec![];
    }
    let extents: Vec<Extent> = pieces.iter().map(|copy| copy.piece.extent()).collect();
    let slack_of = |i: usize| slack([extents[i].size()]);
    let tree = BoxTree::new(extents.iter().copied());
    let mut found = vec![];
    for i in formulas {
        let is_near = |extent: &Extent| extent.meets(&extents[i], slack_of(i));
        tree.search(is_near, |j| {
            let (a, b) = (&pieces[i], &pieces[j]);
            let each_once = j != i && (j > i || !is_formula(b));
            // a path that starts on the one must count as on the other: within half its slack, with as much left for rounding
            let within = 0.25 * slack_of(i).min(slack_of(j));
            let is_whole = |(_, in_common): (f64, InCommon)| in_common == InCommon::Whole;
            if each_once && stretches(&*a.piece, &*b.piece, within).into_iter().any(is_whole) {
                found.extend([a.number, b.number]);
            }
        });
    }
    found
}

/// How much of a stretch of a piece lies on another piece that has the table on the other side.
#[derive(Clone, Copy, Debug, PartialEq)]
enum InCommon {
    Nothing,
    Part,
    Whole,
}

/// Where two pieces, the first of which is of finite length, run along each other, at least in part, with the table on different sides:
/// within the accuracy to which curves given by formulas are [intersected](crate::meetings).
pub(super) fn coincide(a: &dyn Piece, b: &dyn Piece) -> Option<Vector2<f64>> {
    let size = a.extent().size().max(b.extent().size());
    let within = (4.0 * slack([size])).max(rounding(b));
    let found = stretches(a, b, within).into_iter().find(|(_, in_common)| *in_common != InCommon::Nothing);
    found.map(|(place, _)| a.point_at(place))
}

/// The stretches of `a` on which neither piece ends, each as the arc length of a place on it, and how much of it lies on `b`.
fn stretches(a: &dyn Piece, b: &dyn Piece, within: f64) -> Vec<(f64, InCommon)> {
    let length = a.length();
    if !length.is_finite() {
        return vec![];
    }
    let around = |place: f64| if place > length { place - length } else { place };
    let lies_on_b = |place: f64| {
        let at = a.landing_at(place);
        let foot = b.closest(&at.point);
        (foot.point - at.point).norm() <= within && foot.normal.dot(&at.normal) < 0.0
    };
    let of_stretch = |[from, to]: [f64; 2]| {
        let places = PLACES.map(|place| around(from + place * (to - from)));
        let middle = places[2];
        if to - from <= SHORT * within {
            return (middle, InCommon::Nothing);
        }
        let common = places.map(lies_on_b);
        // one place alone may be where they cross or touch
        match common.windows(2).position(|two| two == [true, true]) {
            _ if common == [true; 5] => (middle, InCommon::Whole),
            Some(first) => (places[first], InCommon::Part),
            None => (middle, InCommon::Nothing),
        }
    };
    let stops = stops(a, b, within);
    stops.windows(2).map(|w| of_stretch([w[0], w[1]])).collect()
}

/// The arc lengths along `a` at which either piece ends, in order; a closed curve goes on to the first of them once more.
fn stops(a: &dyn Piece, b: &dyn Piece, within: f64) -> Vec<f64> {
    let length = a.length();
    let lies_on_a = |end: &Vector2<f64>| is_finite(end) && (a.closest(end).point - end).norm() <= within;
    let ends = b.ends().into_iter().flatten().filter(lies_on_a);
    let mut stops: Vec<f64> = ends.map(|end| a.arc_length_at(&end)).collect();
    stops.sort_by(f64::total_cmp);
    if let (None, Some(&first)) = (a.ends(), stops.first()) {
        stops.push(first + length);
    } else {
        stops.insert(0, 0.0);
        stops.push(length);
    }
    stops
}
