//! Boundaries that stand on one another, like a box on a floor, joined into one.
use super::{
    Table,
    cuts::{Place, Vertices, has_parts, part, stops},
};
use crate::{
    Landing, MeetingKind, Piece,
    copies::{Copies, Translate, finite_extent},
    intersect::direction_at,
    meetings,
    plane::{GOLDEN_SECTION, is_finite, key, slack},
};
use nalgebra::Vector2;
use std::{
    collections::{BTreeMap, HashSet},
    sync::Arc,
};

/// Part of a piece, from one place along it to another, between which it meets no other piece.
struct Part {
    from: Vector2<f64>,
    to: Vector2<f64>,
    /// A point inside the part, and the normal there.
    within: Landing,
    /// Whether it lies on a piece of another loop that has the table on the other side.
    is_double: bool,
    /// Whether it bounds nothing.
    is_idle: bool,
}

/// The parts of the pieces that coincide with others, by piece number.
type Parts = BTreeMap<usize, Vec<Part>>;

impl Table {
    /// The same table without the stretches that loops have in common with the table on neither side, and for each of its pieces the number
    /// of the piece of this table that it is, or is part of; `None` where there are no such stretches.
    ///
    /// A box that stands on a floor shares a stretch with it that bounds nothing: no path comes there. [`Table::validate`] calls it a
    /// [spike](crate::Error::Spike). Without it both form one boundary, of pieces that end where the stretch does. A single loop that runs
    /// there and back is left as it is. Curves given by formulas are not cut: two of them are left out where they have both ends in common.
    ///
    /// ```
    /// use geometry::{Outline, Table, Vector2};
    /// let v = Vector2::new;
    /// let room = Outline::from(v(0.0, 0.0)).line_to(v(4.0, 0.0))?.line_to(v(4.0, 4.0))?.line_to(v(0.0, 4.0))?.line_to(v(0.0, 0.0))?;
    /// let desk = Outline::from(v(1.0, 0.0)).line_to(v(1.0, 1.0))?.line_to(v(3.0, 1.0))?.line_to(v(3.0, 0.0))?.line_to(v(1.0, 0.0))?;
    /// let both = Table::new(room.close()?.into_iter().chain(desk.close()?).collect())?;
    /// assert!(both.validate().is_err());
    /// let (joined, origins) = both.joined().expect("a stretch in common");
    /// joined.validate()?;
    /// assert_eq!((joined.area(), origins), (14.0, vec![0, 0, 1, 2, 3, 4, 5, 6]));
    /// # Ok::<(), geometry::Error>(())
    /// ```
    pub fn joined(&self) -> Option<(Table, Vec<usize>)> {
        let size = self.pieces.iter().map(|piece| piece.extent().size()).fold(0.0, f64::max);
        let size = if size > 0.0 { size } else { 1.0 };
        let near = 4.0 * slack([size]);
        let mut parts = self.parts_in_common(size, near);
        // all other walls determine on which side the table lies there
        let (others, _) = self.without(&parts, near, |part| part.is_double)?;
        let others = Copies::new(others.pieces(), others.shortest(), &finite_extent(&self.pieces), near);
        for part in parts.values_mut().flatten().filter(|part| part.is_double) {
            let Landing { point, normal } = part.within;
            // a point not straight ahead of the tip of a cusp, both sides of which would be seen edge on
            let aside = point + normal * (0.5 * others.signed_distance(&point).abs());
            part.is_idle = others.signed_distance(&aside) < 0.0;
        }
        if !parts.values().flatten().any(|part| part.is_idle) {
            return None;
        }
        self.without(&parts, near, |part| part.is_idle)
    }

    /// The parts of all pieces that run along a piece of another loop; of a curve given by a formula, all of it where it runs along all of
    /// another one.
    fn parts_in_common(&self, size: f64, near: f64) -> Parts {
        let loops = drawn_loops(&self.pieces);
        let copies = Copies::new(&self.pieces, self.shortest(), &finite_extent(&self.pieces), near);
        let mut parts = Parts::new();
        for (i, piece) in self.pieces.iter().enumerate() {
            let (mut cuts, mut others): (Vec<Place>, Vec<&Arc<dyn Piece>>) = (vec![], vec![]);
            let own = piece.extent();
            let visit = |index: usize| {
                let (Translate { number, cell, piece: other, .. }, _) = copies.get(index);
                let is_home = *cell == [0.0; 2];
                let are_cut = has_parts(&**piece) && has_parts(&**other);
                if (*number == i && is_home) || !(are_cut || is_way_back(&**piece, &**other, near)) {
                    return;
                }
                let found = meetings(&**piece, &**other);
                cuts.extend(found.iter().map(|m| (m.at[0], m.point)));
                let against = |p: &Vector2<f64>| direction_at(&**piece, p).dot(&direction_at(&**other, p)) < 0.0;
                let is_another = loops[i] != loops[*number] || !is_home;
                if is_another && found.iter().any(|m| m.kind == MeetingKind::Overlap && against(&m.point)) {
                    others.push(other);
                }
            };
            copies.search(|e| e.meets(&own, near), visit);
            if others.is_empty() {
                continue;
            }
            let between = |w: &[Place]| {
                let within = piece.landing_at(well_between([w[0].0, w[1].0], size));
                let off = |other: &Arc<dyn Piece>| (other.closest(&within.point).point - within.point).amax();
                let is_double = others.iter().any(|other| off(other) <= near);
                Part { from: w[0].1, to: w[1].1, within, is_double, is_idle: false }
            };
            parts.insert(i, stops(&**piece, cuts, near).windows(2).map(between).collect());
        }
        parts
    }

    /// The table without some of the parts, and for each of its pieces the number of the piece here that it comes from; `None` where that
    /// is no table.
    fn without(&self, parts: &Parts, near: f64, left_out: impl Fn(&Part) -> bool) -> Option<(Table, Vec<usize>)> {
        let removed = parts.values().flatten().filter(|part| left_out(part));
        let vertices = Vertices::new(removed.flat_map(|part| [part.from, part.to]), near);
        let (mut pieces, mut origins): (Vec<Box<dyn Piece>>, Vec<usize>) = (vec![], vec![]);
        for (i, piece) in self.pieces.iter().enumerate() {
            let shortened = parts.get(&i).filter(|parts| parts.iter().any(&left_out));
            let kept = match shortened {
                Some(parts) => runs(parts, piece.ends().is_none(), &left_out).into_iter().map(Some).collect(),
                None => vec![piece.ends()],
            };
            for ends in kept {
                let snapped = ends.map(|ends| ends.map(|end| vertices.snap(end)));
                if shortened.is_none() && snapped == ends {
                    pieces.push(Box::new(piece.clone()));
                    origins.push(i);
                } else if let Some(ends) = snapped.filter(|[a, b]| a != b) {
                    pieces.push(part(&**piece, ends).ok()?);
                    origins.push(i);
                }
            }
        }
        let table = Table::periodic(pieces, self.lattice().cloned()).ok()?;
        Some((Table { unbounded: self.unbounded, ..table }, origins))
    }
}

/// For each piece the number of the loop in which it was drawn: pieces follow one another until one ends where a loop began. (A box in the
/// corner of a room is not taken as a continuation of the walls, even if both loops begin at that corner.)
fn drawn_loops(pieces: &[Arc<dyn Piece>]) -> Vec<usize> {
    let ends: Vec<_> = pieces.iter().map(Piece::ends).collect();
    let mut begun = HashSet::new();
    let mut head = 0;
    let number = |i: usize| {
        let own = head;
        if own == i {
            begun.extend(ends[i].map(|[a, _]| key(a)));
        }
        let next = ends.get(i + 1).copied().flatten();
        let goes_on =
            ends[i].zip(next).is_some_and(|([_, b], [a, _])| a == b && is_finite(&b) && !begun.contains(&key(b)));
        if !goes_on {
            head = i + 1;
        }
        own
    };
    (0..pieces.len()).map(number).collect()
}

/// Whether one piece begins where the other one ends, and ends where that one begins.
fn is_way_back(piece: &dyn Piece, other: &dyn Piece, near: f64) -> bool {
    let same = |p: Vector2<f64>, q: Vector2<f64>| (p - q).amax() <= near;
    piece.ends().zip(other.ends()).is_some_and(|([a, b], [c, d])| same(a, d) && same(b, c))
}

/// An arc length between two others, at no special fraction; where one is infinite, at a distance of about the table's size from the other.
fn well_between([from, to]: [f64; 2], size: f64) -> f64 {
    match (from.is_finite(), to.is_finite()) {
        (true, true) => from + GOLDEN_SECTION * (to - from),
        (true, false) => from + GOLDEN_SECTION * size,
        (false, true) => to - GOLDEN_SECTION * size,
        (false, false) => GOLDEN_SECTION * size,
    }
}

/// The ends of the stretches that are kept between parts that are left out; a closed piece continues where it began.
fn runs(parts: &[Part], is_closed: bool, left_out: impl Fn(&Part) -> bool) -> Vec<[Vector2<f64>; 2]> {
    let first = if is_closed { parts.iter().position(&left_out).unwrap_or(0) } else { 0 };
    let mut runs: Vec<[Vector2<f64>; 2]> = vec![];
    let mut goes_on = false;
    for part in parts[first..].iter().chain(&parts[..first]) {
        match runs.last_mut().filter(|_| goes_on) {
            _ if left_out(part) => {}
            Some(run) => run[1] = part.to,
            None => runs.push([part.from, part.to]),
        }
        goes_on = !left_out(part);
    }
    runs
}
