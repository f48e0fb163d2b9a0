//! The boundary cut where walls touch, which shows what falls apart there.
use super::{
    Table,
    cuts::{Place, Vertices, part, stops},
};
use crate::{
    Figure, Lattice, Piece,
    copies::{Copies, Translate, finite_extent},
    joints::{Joint, joints_around_parts},
    meetings,
    parry::piece_of,
    plane::{is_finite, once_around, slack},
    shapes::Translated,
};
use nalgebra::Vector2;
use std::sync::Arc;

/// A piece, and the number of the piece that it is, or is part of.
type Part = (Arc<dyn Piece>, usize);

/// A table of pieces that end wherever another one touches them, and follow one another around each of its parts.
pub(crate) struct Parted {
    pub(crate) table: Table,
    /// For each piece the number of the piece that it is part of.
    pub(crate) numbers: Vec<usize>,
    /// The angles by which the boundary turns where one piece follows another.
    pub(crate) turns: Vec<f64>,
}

impl Table {
    /// The same table, parted; `None` where nothing touches except pieces that follow one another. Ellipses and other curves are not
    /// cut, since their contacts are not always found.
    pub(crate) fn parted(&self) -> Option<Parted> {
        let size = self.pieces.iter().map(|piece| piece.extent().size()).fold(0.0, f64::max);
        let size = if size > 0.0 { size } else { 1.0 };
        let near = 4.0 * slack([size]);
        let faces: Vec<Part> = self.pieces.iter().enumerate().flat_map(|(i, piece)| faces(piece, i)).collect();
        let (pieces, origins): (Vec<Arc<dyn Piece>>, Vec<usize>) = faces.into_iter().unzip();
        let (cuts, touches) = self.cuts(&pieces, near);
        if !touches {
            return None;
        }
        let ends = pieces.iter().filter_map(Piece::ends).flatten();
        let vertices = Vertices::new(ends.chain(cuts.iter().flatten().map(|(_, point)| *point)), near);
        let (mut parts, mut numbers): (Vec<Box<dyn Piece>>, Vec<usize>) = (vec![], vec![]);
        for ((piece, cuts), origin) in pieces.iter().zip(cuts).zip(origins) {
            let cut = if let (Figure::Line { .. }, Some(lattice)) = (piece.figure(), self.shortest()) {
                cut_line(piece, cuts, lattice, near)
            } else {
                cut(piece, cuts, &vertices, near)
            };
            for part in cut? {
                parts.push(part);
                numbers.push(origin);
            }
        }
        let table = Table::periodic(parts, self.lattice().cloned()).ok()?;
        let joints = joints_around_parts(&table);
        let turns = joints.iter().map(|joint| joint.turn(&table)).collect();
        let Around { next, cells } = around_each_part(&table, joints)?;
        let moved = |(piece, cell): (&Arc<dyn Piece>, [f64; 2])| {
            let by = table.shortest().map_or_else(Vector2::zeros, |lattice| lattice.translation(cell));
            Box::new(Translated::new(Arc::clone(piece), by)) as Box<dyn Piece>
        };
        let moved = table.pieces.iter().zip(cells).map(moved).collect();
        let table = Table::periodic(moved, self.lattice().cloned()).ok()?;
        Some(Parted { table: Table { next, unbounded: self.unbounded, ..table }, numbers, turns })
    }

    /// The places where each of some pieces meets another one, and whether any two meet that do not follow one another.
    fn cuts(&self, pieces: &[Arc<dyn Piece>], near: f64) -> (Vec<Vec<Place>>, bool) {
        let copies = Copies::new(pieces, self.shortest(), &finite_extent(pieces), near);
        let follows = |a: &dyn Piece, b: &dyn Piece, at: &Vector2<f64>| {
            let [ends, others] = [a.ends(), b.ends()];
            let is_vertex = |p: Vector2<f64>, q: Vector2<f64>| [p, q].iter().all(|end| (end - at).amax() <= near);
            ends.zip(others).is_some_and(|([a, b], [c, d])| is_vertex(b, c) || is_vertex(a, d))
        };
        let mut touches = false;
        let mut cuts: Vec<Vec<Place>> = vec![vec![]; pieces.len()];
        for (i, piece) in pieces.iter().enumerate() {
            let own = piece.extent();
            let visit = |index: usize| {
                let Translate { number, cell, by, piece: other } = copies.get(index).0;
                // each pair once
                if *number < i || (*number == i && *cell <= [0.0; 2]) {
                    return;
                }
                for meeting in meetings(&**piece, &**other) {
                    touches |= !follows(&**piece, &**other, &meeting.point);
                    cuts[i].push((meeting.at[0], meeting.point));
                    cuts[*number].push((meeting.at[1], meeting.point - by));
                }
            };
            copies.search(|e| e.meets(&own, near), visit);
        }
        (cuts, touches)
    }
}

/// The two faces of a straight wall without thickness; otherwise the piece itself.
fn faces(piece: &Arc<dyn Piece>, number: usize) -> Vec<Part> {
    let face = |ends| piece_of(&Figure::Segment { ends }).map(|face| (Arc::from(face), number));
    let both = piece.tips().and_then(|[a, b]| Some(vec![face([a, b]).ok()?, face([b, a]).ok()?]));
    both.unwrap_or_else(|| vec![(Arc::clone(piece), number)])
}

/// The parts of a piece between places; the piece itself if it is not cut. `None` where a part cannot be made.
fn cut(piece: &Arc<dyn Piece>, mut cuts: Vec<Place>, vertices: &Vertices, near: f64) -> Option<Vec<Box<dyn Piece>>> {
    if let (None, Some(&(s, point))) = (piece.ends(), cuts.first())
        && cuts.iter().all(|(_, other)| (other - point).amax() <= near)
    {
        // an arc needs two distinct ends, even if a circle is cut at a single place
        let opposite = s + 0.5 * piece.length();
        cuts.push((opposite, piece.point_at(opposite)));
    }
    let stops = stops(&**piece, cuts, near);
    let same = |p: &Vector2<f64>| !is_finite(p) || vertices.snap(*p) == *p;
    let whole = stops.len() <= 2 && stops.iter().all(|(_, p)| same(p));
    if whole || piece.figure() == Figure::Other {
        return Some(vec![Box::new(Arc::clone(piece))]);
    }
    let ends = stops.windows(2).map(|pair| [pair[0].1, pair[1].1].map(|point| vertices.snap(point)));
    ends.filter(|[a, b]| a != b).map(|ends| part(&**piece, ends).ok()).collect()
}

/// The parts of a line along the only lattice vector, which repeats after the length of that vector.
fn cut_line(line: &Arc<dyn Piece>, cuts: Vec<Place>, lattice: &Lattice, near: f64) -> Option<Vec<Box<dyn Piece>>> {
    let vector = lattice.vectors()[0];
    let round = libm::hypot(vector.x, vector.y);
    let mut places: Vec<f64> = cuts.into_iter().map(|(s, _)| once_around(s, round)).collect();
    places.sort_by(f64::total_cmp);
    places.dedup_by(|later, earlier| *later - *earlier <= near);
    let Some(&first) = places.first() else { return Some(vec![Box::new(Arc::clone(line))]) };
    let again = first + round;
    places.retain(|s| *s < again - near);
    places.push(again);
    let ends = places.windows(2).map(|pair| [pair[0], pair[1]].map(|s| line.point_at(s)));
    ends.map(|ends| piece_of(&Figure::Segment { ends }).ok()).collect()
}

/// How pieces follow one another around each part of a table.
struct Around {
    /// For each piece the next one.
    next: Vec<Option<usize>>,
    /// By how many lattice vectors each piece is moved to follow those before it.
    cells: Vec<[f64; 2]>,
}

/// `None` where rounding hides which piece follows which.
fn around_each_part(table: &Table, joints: Vec<Joint>) -> Option<Around> {
    let count = table.pieces.len();
    let mut after: Vec<Option<Joint>> = vec![None; count];
    let mut is_followed = vec![false; count];
    for joint in joints {
        if std::mem::replace(&mut is_followed[joint.after], true) {
            return None;
        }
        after[joint.before] = Some(joint);
    }
    let mut next: Vec<Option<usize>> = (0..count).map(|i| table.pieces[i].ends().is_none().then_some(i)).collect();
    let mut cells: Vec<Option<[f64; 2]>> = vec![None; count];
    for head in (0..count).filter(|&i| !is_followed[i]).chain(0..count) {
        let (mut at, mut cell) = (head, [0.0; 2]);
        while cells[at].is_none() {
            cells[at] = Some(cell);
            let Some(joint) = after[at] else { break };
            cell = [0, 1].map(|k| cell[k] + joint.cell[k]);
            // a chain that comes back to a translate of itself goes on for ever
            next[at] = Some(joint.after).filter(|_| joint.after != head || cell == [0.0; 2]);
            at = joint.after;
        }
    }
    Some(Around { next, cells: cells.into_iter().flatten().collect() })
}
