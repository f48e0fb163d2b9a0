//! Where a wall with the table on both sides meets another wall, and other places on walls where orbits end.
use super::{CORNER, standing::standing};
use crate::{BoxTree, Extent, Piece, plane::slack};
use lanes::Lane;
use nalgebra::Vector2;
use std::sync::Arc;

/// Places on walls, and not at their ends, where orbits end.
///
/// They are places where [vertices stand](standing), and places near which rounding hides on which side of a two-sided wall a path is. A
/// path that starts on such a wall, within rounding, counts as having just left it and does not cross it. Where that wall ends at another
/// wall, or two such walls end in one vertex, a path that has just left the other one starts as near to it, and would slip through. So
/// orbits end there, as in a corner: up to `B/sin α` from a place where walls meet at the angle `α`, with `B` the rounding; and at free
/// tips, as at any corner.
#[derive(Clone, Debug, Default)]
pub(crate) struct Junctions {
    /// Places and how far from them orbits end, sorted by the first coordinate.
    places: Vec<(Vector2<f64>, f64)>,
    /// The greatest of these distances.
    reach: f64,
    /// Whether a one-sided wall is met.
    on_others: bool,
}

/// In units of the [`slack`]. A start within half the slack of a two-sided wall counts as on it, and rounding puts it off by another
/// half: this leaves more than a factor of two on both.
const BAND: f64 = 2.5;

/// In the same units. A free tip is a corner within half the slack, like any vertex: [`CORNER`].
const TIP: f64 = 0.5;

/// Directions that differ by less than this (radians) are those of walls that touch or coincide. Touching walls separate as the square of
/// the distance: with the radius of curvature `r` they are a rounding error apart at some 10⁻⁷ `r`.
const TOUCHING: f64 = 1e-8;

/// A wall, and the unit directions in which it leaves a place.
struct Arm {
    number: usize,
    double: bool,
    directions: Vec<Vector2<f64>>,
}

impl Junctions {
    /// The junctions of pieces with these numbers, if there are any.
    pub(crate) fn of(pieces: &[(usize, Arc<dyn Piece>)]) -> Option<Junctions> {
        let (standing, mut found) = (standing(pieces), Junctions::of_two_sided(pieces));
        found.on_others |= !standing.is_empty();
        found = found.with(standing.into_iter());
        if found.places.is_empty() { None } else { Some(found) }
    }

    /// Those near two-sided walls.
    fn of_two_sided(pieces: &[(usize, Arc<dyn Piece>)]) -> Junctions {
        let double: Vec<usize> = (0..pieces.len()).filter(|&i| pieces[i].1.has_two_sides()).collect();
        let mut found = Junctions::default();
        if double.is_empty() {
            return found;
        }
        let tree = BoxTree::new(pieces.iter().map(|(_, piece)| piece.extent()));
        let extents = pieces.iter().map(|(_, piece)| piece.extent()).filter(Extent::is_finite);
        let size = extents.fold(0.0, |size: f64, e| size.max(e.size()));
        let within = |p: &Vector2<f64>| slack([size, p.x, p.y]);
        // ends of two-sided walls, on whatever they lie, and ends of other walls on them
        let others = BoxTree::new(double.iter().map(|&i| pieces[i].1.extent()));
        let is_near = |tree: &BoxTree<2>, p: &Vector2<f64>| {
            let mut near = vec![];
            tree.search(|e| e.distance(p) <= within(p), |i| near.push(i));
            near
        };
        let mut ends: Vec<Vector2<f64>> = vec![];
        for (_, piece) in pieces {
            let of_piece = piece.ends().or(piece.tips()).into_iter().flatten();
            let finite = of_piece.filter(|p| p.iter().all(|x| x.is_finite()));
            ends.extend(finite.filter(|p| piece.has_two_sides() || !is_near(&others, p).is_empty()));
        }
        ends.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        ends.dedup();
        for place in ends {
            let near = is_near(&tree, &place);
            let arms: Vec<Arm> =
                near.iter().filter_map(|&i| Arm::of(i, &*pieces[i].1, &place, within(&place))).collect();
            found.add(place, &arms, within(&place));
        }
        found
    }

    fn add(&mut self, place: Vector2<f64>, arms: &[Arm], rounding: f64) {
        let mut reach: Option<f64> = None;
        for a in arms.iter().filter(|arm| arm.double) {
            if arms.len() == 1 {
                reach = Some(TIP * rounding);
            }
            for b in arms.iter().filter(|b| b.number != a.number) {
                let pairs = a.directions.iter().flat_map(|d| b.directions.iter().map(move |e| (d, e)));
                for (d, e) in pairs {
                    let (sine, cosine) = (d.perp(e).abs(), d.dot(e));
                    let goes_on = a.directions.len() == 1 && b.directions.len() == 1 && cosine < 0.0;
                    let same = b.double && cosine > 0.0;
                    if sine < TOUCHING && (goes_on || same) {
                        continue; // one wall, or its other side
                    }
                    let apart = if cosine > 0.0 { sine.max(TOUCHING) } else { 1.0 };
                    reach = Some(reach.unwrap_or(0.0).max(BAND * rounding / apart));
                    self.on_others |= !b.double;
                }
            }
        }
        if let Some(reach) = reach {
            self.places.push((place, reach));
            self.reach = self.reach.max(reach);
        }
    }

    /// These and other places, with how far from them orbits end \[L\].
    pub(super) fn with(mut self, places: impl Iterator<Item = (Vector2<f64>, f64)>) -> Junctions {
        self.places.extend(places);
        self.places.sort_by(|(a, _), (b, _)| a.x.total_cmp(&b.x));
        self.reach = self.places.iter().fold(0.0, |most, (_, reach)| most.max(*reach));
        self
    }

    /// Whether a one-sided wall is met.
    pub(crate) fn on_others(&self) -> bool {
        self.on_others
    }

    /// The lanes in which orbits end because the hit is near enough to such a place; the paths start at `x`.
    #[cold]
    #[inline(never)]
    pub(crate) fn near<F: Lane>(&self, x: [F; 2], point: [F; 2]) -> F::Mask {
        let is_near = |lane: usize| {
            let [x, point] = [x, point].map(|p| Vector2::from(p.map(|p| p.lane(lane))));
            // a path may come from far beyond the walls
            let rounding = CORNER * x.amax();
            let farthest = self.reach.max(rounding);
            let from = self.places.partition_point(|(place, _)| place.x < point.x - farthest);
            let mut near = self.places[from..].iter().take_while(|(place, _)| place.x <= point.x + farthest);
            near.any(|(place, reach)| (point - place).amax() <= reach.max(rounding))
        };
        let zero = x[0].same(0.0);
        zero.lt(zero.each(|lane| if is_near(lane) { 1.0 } else { 0.0 }))
    }
}

impl Arm {
    /// How a piece leaves a place that lies on it, within rounding.
    fn of(number: usize, piece: &dyn Piece, place: &Vector2<f64>, rounding: f64) -> Option<Arm> {
        let foot = piece.closest(place);
        if (foot.point - place).amax() > rounding {
            return None;
        }
        let along = Vector2::new(foot.normal.y, -foot.normal.x);
        let ends = piece.ends().or(piece.tips());
        // a wall without thickness may report either side's normal, and leads from each tip towards the other
        let chord = piece.tips().map(|[a, b]| (b - a).normalize());
        let along = chord.unwrap_or(along);
        let is_end = |end: &Vector2<f64>| (end - place).amax() <= rounding;
        let directions = match ends {
            Some([a, _]) if is_end(&a) => vec![along],
            Some([_, b]) if is_end(&b) => vec![-along],
            _ => vec![along, -along],
        };
        Some(Arm { number, double: piece.has_two_sides(), directions })
    }
}
