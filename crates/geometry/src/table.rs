//! A table: its pieces, and how they are connected.
mod cell;
mod container;
mod cuts;
mod ends;
mod fastest;
mod joined;
mod parted;
mod sides;
mod succession;
mod two_sided;

use crate::{
    Error, Extent, Figure, Landing, Lattice, Piece,
    copies::Translate,
    enclosed_area,
    lattice::multiples,
    nearest::{Nearest, nearest_of},
    plane::{has_squares, is_finite, slack},
    walls::{Pieces, Polygon},
};
pub use cell::FundamentalCell;
use container::Enclosed;
pub(crate) use cuts::with_ends;
use nalgebra::Vector2;
pub(crate) use parted::Parted;
use std::sync::{Arc, OnceLock};
pub(crate) use succession::SMOOTH;
use succession::Succession;
pub(crate) use two_sided::side_by_side;

/// A planar table: numbered boundary pieces, each traversed with the table on its left.
///
/// Pieces that meet share a vertex exactly. A vertex where the direction of the boundary jumps is a corner.
#[derive(Clone, Debug)]
pub struct Table {
    pieces: Vec<Arc<dyn Piece>>,
    /// For each piece, the one that starts where it ends.
    next: Vec<Option<usize>>,
    corners: Vec<Vector2<f64>>,
    /// On a lattice, the cell in which paths are followed.
    cell: Option<Arc<FundamentalCell>>,
    /// Whether the plane around all pieces is meant to belong to the table.
    pub(crate) unbounded: bool,
    /// All pieces with their numbers; on a lattice, every translate that reaches within a cell of the cell where paths are followed.
    nearby: Vec<Translate>,
    /// The composite wall that answers for a chain of pieces, if there is one. This and the following fields are built when first needed:
    /// for many pieces or for curves that may take longer than a run.
    enclosed: OnceLock<Option<Arc<Enclosed>>>,
    /// All pieces as the sides of a polygon, where composite walls do not cover them and they are straight.
    polygon: OnceLock<Option<Arc<Polygon>>>,
    /// The pieces that no composite wall covers, on a lattice with all translates.
    parts: OnceLock<Arc<Pieces>>,
}

/// Most translates of pieces on a lattice. Ordinary tables need some tens; in a cell that is tiny compared with a piece, or almost
/// degenerate, there would be any number of them.
const MOST_TRANSLATES: f64 = 1e6;

/// Ends must not be NaN, and squares of lengths, and what is computed from them, must not over- or underflow: the greatest finite
/// coordinate decides that.
fn are_places(pieces: &[Box<dyn Piece>]) -> Result<(), Error> {
    let ends = || pieces.iter().filter_map(|piece| piece.ends()).flatten().flat_map(|end| [end.x, end.y]);
    if let Some(value) = ends().find(|x| x.is_nan()) {
        return Err(Error::Parameter { name: "a coordinate of the end of a piece", must: "a number", value });
    }
    has_squares(pieces.iter().map(|piece| piece.extent()))
}

impl Table {
    /// The table bounded by the given pieces. Where one ends within rounding of the start of another (16 ulp of the greatest coordinate of
    /// their ends), one of the two is moved to the vertex of the other.
    ///
    /// # Errors
    /// [`Error::Empty`] without pieces, [`Error::Length`] if the greatest coordinate is beyond 10¹⁵⁰ or less than 10⁻¹⁵⁰, since squares
    /// would over- or underflow, [`Error::Parameter`] where an end is not a point, [`Error::Open`] where a piece ends and no other starts,
    /// or the other way round.
    pub fn new(pieces: Vec<Box<dyn Piece>>) -> Result<Table, Error> {
        Table::periodic(pieces, None)
    }

    /// The same on the plane modulo a lattice. A piece may then end where a translate of another one starts. A wall along the only vector
    /// is best a segment as long as that vector: an infinite line along it is allowed, but then the wall has no length, and the table no
    /// area, per cell.
    ///
    /// # Errors
    /// As [`Table::new`], [`Error::ManyCells`] if the pieces reach over a million cells, and [`Error::FarFromCell`] for one some 10¹⁵
    /// cells away.
    pub fn periodic(pieces: Vec<Box<dyn Piece>>, lattice: Option<Lattice>) -> Result<Table, Error> {
        if pieces.is_empty() {
            return Err(Error::Empty);
        }
        are_places(&pieces)?;
        let mut pieces: Vec<Arc<dyn Piece>> = pieces.into_iter().map(Arc::from).collect();
        let cell = lattice.map(FundamentalCell::at_origin);
        let of = |pieces: &[Arc<dyn Piece>]| Succession::of(pieces, cell.as_ref().map(FundamentalCell::lattice));
        let succession = match of(&pieces) {
            Err(Error::Open { .. }) if ends::unite(&mut pieces) => of(&pieces),
            found => found,
        };
        let Succession { next, corners } = succession?;
        if let Some(cell) = &cell {
            few_cells(&pieces, cell)?;
        }
        let cell = cell.map(|cell| Arc::new(cell.around(&pieces)));
        let mut nearby = all_nearby(&pieces, cell.as_deref());
        let double = two_sided::two_sided(&nearby);
        if !double.is_empty() {
            for i in double {
                pieces[i] = two_sided::one_side(&pieces[i]);
            }
            nearby = all_nearby(&pieces, cell.as_deref());
        }
        let (enclosed, polygon, parts) = (OnceLock::new(), OnceLock::new(), OnceLock::new());
        Ok(Table { pieces, next, corners, cell, unbounded: false, nearby, enclosed, polygon, parts })
    }

    /// The same table, said to be the plane around its outermost loops: [`Table::validate`] then wants these to run clockwise.
    ///
    /// ```
    /// use geometry::{Outline, Table, Vector2};
    /// let v = Vector2::new;
    /// let triangle = Outline::from(v(0.0, 0.0)).line_to(v(0.0, 1.0))?.line_to(v(1.0, 0.0))?.line_to(v(0.0, 0.0))?;
    /// let table = Table::new(triangle.close()?)?;
    /// assert!(table.validate().is_err()); // more often than not, vertices in the wrong order
    /// table.unbounded().validate()?;
    /// # Ok::<(), geometry::Error>(())
    /// ```
    #[must_use]
    pub fn unbounded(self) -> Table {
        Table { unbounded: true, ..self }
    }

    /// The pieces, in the order of their numbers.
    pub fn pieces(&self) -> &[Arc<dyn Piece>] {
        &self.pieces
    }

    /// The vertices at which the normal jumps, so that orbits end there: one for each piece that ends in such a vertex, and two (the end
    /// and the start) where a lattice vector leads from it to the start of the next piece.
    /// ([`Description::corners`](crate::Description::corners) counts by the angle of turning, and each joint once.)
    pub fn corners(&self) -> &[Vector2<f64>] {
        &self.corners
    }

    /// The translations that identify points, where there are any, as they were given.
    pub fn lattice(&self) -> Option<&Lattice> {
        self.cell().map(FundamentalCell::given)
    }

    /// The same translations with the shortest basis vectors: the lattice used for all questions about the table.
    pub(crate) fn shortest(&self) -> Option<&Lattice> {
        self.cell().map(FundamentalCell::lattice)
    }

    /// On a lattice, the cell in which paths are followed: they start and hit walls there.
    ///
    /// ```
    /// use geometry::{Lattice, Table, Vector2, shapes::Circle};
    /// let v = Vector2::new;
    /// // the vectors of the unit square, in other words
    /// let lattice = Lattice::new(&[v(1.0, 0.0), v(20.0, 1.0)])?;
    /// let table = Table::periodic(vec![Box::new(Circle::new(v(0.5, 0.5), 0.25, false)?)], Some(lattice))?;
    /// let cell = table.cell().expect("a lattice");
    /// let (home, by) = cell.home(&v(10.5, 0.125));
    /// assert_eq!((home, by), (v(0.5, 0.125), [10.0, 0.0]));
    /// assert_eq!(cell.in_unit_cell(&v(0.5, 0.75)), (v(15.5, 0.75), [-15.0, 0.0]));
    /// # Ok::<(), geometry::Error>(())
    /// ```
    pub fn cell(&self) -> Option<&FundamentalCell> {
        self.cell.as_deref()
    }

    /// The copy of a point where paths are followed: on a lattice the one in the [cell](Table::cell).
    pub fn home(&self, point: &Vector2<f64>) -> Vector2<f64> {
        self.cell().map_or(*point, |cell| cell.home(point).0)
    }

    /// The closed loops and infinite chains of the boundary: piece numbers in the order of traversal.
    pub fn chains(&self) -> Vec<Vec<usize>> {
        let mut has_previous = vec![false; self.pieces.len()];
        for &j in self.next.iter().flatten() {
            has_previous[j] = true;
        }
        let mut seen = vec![false; self.pieces.len()];
        let heads = (0..self.pieces.len()).filter(|&i| !has_previous[i]).chain(0..self.pieces.len());
        let mut chains = vec![];
        for head in heads {
            let mut chain = vec![];
            let mut at = Some(head);
            while let Some(i) = at.filter(|&i| !seen[i]) {
                seen[i] = true;
                chain.push(i);
                at = self.next[i];
            }
            if !chain.is_empty() {
                chains.push(chain);
            }
        }
        chains
    }

    /// Whether a chain of [`Table::chains`] closes.
    pub fn is_closed(&self, chain: &[usize]) -> bool {
        chain.last().is_some_and(|&last| self.next[last] == chain.first().copied())
    }

    /// Area of the table \[L²\], per unit cell on a lattice; for obstacles in the open plane, minus their own area; infinite or NaN where
    /// walls are infinite.
    pub fn area(&self) -> f64 {
        let chains = self.chains();
        if self.shortest().is_some() { self.bounded_by(&chains) } else { self.enclosed_by(&chains) }
    }

    /// The area of a part of the table that some chains bound: what they enclose or, where that is zero within rounding or negative, as
    /// for obstacles and two-sided walls, the area around them.
    pub(crate) fn bounded_by<'a>(&self, chains: impl IntoIterator<Item = &'a Vec<usize>> + Clone) -> f64 {
        let pieces = || chains.clone().into_iter().flatten().map(|&i| &self.pieces[i]);
        let length: f64 = pieces().map(Piece::length).sum();
        if !length.is_finite() {
            return f64::INFINITY;
        }
        let steps = || pieces().filter_map(Piece::ends).map(|[a, b]| b - a).sum::<Vector2<f64>>();
        let is_open = |lattice: &Lattice| lattice.vectors().len() == 1 && lattice.rounded(&steps()) != [0.0; 2];
        if self.shortest().is_some_and(is_open) {
            return f64::INFINITY; // a channel of which more walls run one way than the other
        }
        let size = pieces().map(|piece| piece.extent().size()).fold(0.0, f64::max);
        let (enclosed, rounding) = (self.enclosed_by(chains), slack([size]) * length);
        let cell = self.shortest().map_or(f64::INFINITY, Lattice::cell_area);
        if cell.is_finite() {
            // which translates of the walls are drawn, those of this cell or of others, makes a difference of whole cells
            enclosed - cell * libm::floor((enclosed - rounding) / cell)
        } else if enclosed > rounding {
            enclosed
        } else {
            f64::INFINITY
        }
    }

    /// The area that chains contribute together. A chain that continues in a translate of itself is closed along edges of the cell, two of
    /// which differ by the vector from its start to its end.
    pub(crate) fn enclosed_by<'a>(&self, chains: impl IntoIterator<Item = &'a Vec<usize>>) -> f64 {
        // edges of the cell lead from all chains to one common point
        let mut corner = None;
        let (mut sum, mut open) = (0.0, vec![]);
        for chain in chains {
            let inside = enclosed_area(chain.iter().map(|&i| &*self.pieces[i]));
            sum += inside;
            if let [Some([a, _]), Some([_, b])] = [chain[0], chain[chain.len() - 1]].map(|i| self.pieces[i].ends())
                && !self.is_closed(chain)
            {
                open.push([a, b]);
            }
        }
        let continues = |start: &Vector2<f64>, end: &Vector2<f64>| {
            self.shortest().is_some_and(|lattice| lattice.between(start, end).is_some())
        };
        open.reverse();
        while let Some([a, mut at]) = open.pop() {
            // translates of other chains lead on to a translate of the start
            while !continues(&a, &at)
                && let Some(k) = open.iter().rposition(|[start, _]| continues(start, &at))
            {
                let [start, end] = open.remove(k);
                let to = at + (end - start);
                sum += 0.5 * (at - a).perp(&(to - a));
                at = to;
            }
            sum += (a - *corner.get_or_insert(a)).perp(&(at - a));
        }
        sum
    }

    /// Length of the boundary \[L\], per unit cell on a lattice.
    pub fn perimeter(&self) -> f64 {
        self.pieces.iter().map(Piece::length).sum()
    }

    /// A box around all pieces; infinite where they are.
    pub fn extent(&self) -> Extent {
        self.pieces.iter().map(Piece::extent).fold(Extent::EMPTY, Extent::union)
    }

    /// The piece closest to a point, the point of it that is closest, and its inward normal.
    pub fn closest(&self, point: &Vector2<f64>) -> (usize, Landing) {
        let Nearest { number, landing, .. } = self.nearest(point);
        (number, landing)
    }

    fn nearest(&self, point: &Vector2<f64>) -> Nearest {
        let (home, back) = self.cell().map_or((*point, None), |cell| {
            let (home, cells) = cell.home_in_shortest(point);
            (home, Some(cell.lattice().translation(cells)))
        });
        let landing = Landing { point: Vector2::zeros(), normal: Vector2::zeros() };
        let nowhere = Nearest { number: 0, landing, is_outside: true };
        let mut nearest = nearest_of(self.nearby(), &home).unwrap_or(nowhere); // a table has pieces
        if let Some(back) = back {
            nearest.landing.point += back;
        }
        nearest
    }

    /// The curvature \[L⁻¹\] of a piece at a point of it, or on a lattice of a translate of it; 0 for a number beyond the last.
    pub fn curvature(&self, piece: usize, point: &Vector2<f64>) -> f64 {
        let point = &self.near_home(point);
        self.copy_at(piece, point).map_or(0.0, |piece| piece.curvature(point))
    }

    /// The largest of the numbers \[L\] that define a piece at a point of it (on a lattice, of a translate of it): for part of a line or a
    /// circle, the points and lengths that define these; 0 for a number beyond the last.
    pub fn size_of(&self, piece: usize, point: &Vector2<f64>) -> f64 {
        self.copy_at(piece, &self.near_home(point)).map_or(0.0, |piece| match piece.figure() {
            Figure::Line { through, .. } => through.amax(),
            Figure::Arc { center, radius, .. } | Figure::Circle { center, radius, .. } => center.amax() + radius,
            _ => piece.extent().size(),
        })
    }

    /// The arc length \[L\] from the start of a piece to a landing on it, or on a lattice on a translate of it; 0 for a number
    /// beyond the last.
    pub fn arc_length(&self, piece: usize, landing: &Landing) -> f64 {
        let landing = Landing { point: self.near_home(&landing.point), ..*landing };
        self.copy_at(piece, &landing.point).map_or(0.0, |piece| piece.arc_length_of(&landing))
    }

    /// The translations of a piece whose translates reach within a cell of [the one](Table::cell) where paths are followed; without a
    /// lattice only the zero vector.
    pub fn translations(&self, piece: usize) -> impl Iterator<Item = Vector2<f64>> + '_ {
        self.copies(piece).iter().map(|copy| copy.by)
    }

    /// All pieces with their numbers; on a lattice, all translates that reach within a cell of [the one](Table::cell) where paths are
    /// followed.
    pub fn nearby(&self) -> impl Iterator<Item = (usize, &dyn Piece)> {
        self.nearby.iter().map(|copy| (copy.number, &*copy.piece))
    }

    /// The copy of a point around which the nearest translates are known: a point of the unit cell may be far from where paths are
    /// followed.
    fn near_home(&self, point: &Vector2<f64>) -> Vector2<f64> {
        if self.cell().is_none_or(FundamentalCell::is_unit_cell) { *point } else { self.home(point) }
    }

    /// The translates of one piece.
    fn copies(&self, piece: usize) -> &[Translate] {
        let from = self.nearby.partition_point(|copy| copy.number < piece);
        let many = self.nearby[from..].partition_point(|copy| copy.number == piece);
        &self.nearby[from..from + many]
    }

    /// The translate of a piece that is nearest to a point.
    fn copy_at(&self, piece: usize, point: &Vector2<f64>) -> Option<&dyn Piece> {
        let copies = self.copies(piece);
        let off = |copy: &&Translate| (copy.piece.closest(point).point - point).norm_squared();
        let nearest = match copies {
            [one] => Some(one),
            _ => copies.iter().min_by(|a, b| off(a).total_cmp(&off(b))),
        };
        nearest.map(|copy| &*copy.piece)
    }

    /// The distance from the boundary \[L\], negative outside the table.
    pub fn signed_distance(&self, point: &Vector2<f64>) -> f64 {
        let Nearest { landing, is_outside, .. } = self.nearest(point);
        let d = point - landing.point;
        let distance = libm::hypot(d.x, d.y);
        // from 10¹² table sizes away all walls are at the same distance up to rounding, and the side is the same as seen from nearer by
        let near = if self.cell().is_none() { self.extent().beside(point) } else { *point };
        let is_outside = if near == *point { is_outside } else { self.nearest(&near).is_outside };
        if is_outside { -distance } else { distance }
    }

    /// Whether a point lies in the table, off the boundary.
    pub fn contains(&self, point: &Vector2<f64>) -> bool {
        is_finite(point) && self.signed_distance(point) > 0.0
    }

    /// Arc length of the start of each piece, all pieces laid end to end in the order of their numbers.
    pub fn arc_length_offsets(&self) -> Vec<f64> {
        let mut sum = 0.0;
        let before = |p: &Arc<dyn Piece>| {
            let at = sum;
            sum += p.length();
            at
        };
        self.pieces.iter().map(before).collect()
    }

    /// The piece at an arc length \[L\] of the whole boundary, all pieces laid end to end in the order of their numbers, and the arc
    /// length along that piece. Values before the start belong to the first piece, those after the end to the last.
    ///
    /// ```
    /// let square = geometry::tables::square(1.0)?;
    /// assert_eq!([2.25, -0.5, 4.5].map(|s| square.piece_at(s)), [(2, 0.25), (0, -0.5), (3, 1.5)]);
    /// # Ok::<(), geometry::Error>(())
    /// ```
    pub fn piece_at(&self, s: f64) -> (usize, f64) {
        piece_at(&self.arc_length_offsets(), s)
    }

    /// The point at an arc length \[L\] of a piece of the table, on a lattice in the [cell](Table::cell) where paths are followed, and the
    /// inward normal there.
    pub fn landing_on(&self, piece: &dyn Piece, s: f64) -> Landing {
        let Landing { point, normal } = piece.landing_at(s);
        Landing { point: self.home(&point), normal }
    }
}

/// The last piece, by these starts, that starts at or before an arc length, and the distance of that from its start.
pub(crate) fn piece_at(starts: &[f64], s: f64) -> (usize, f64) {
    let piece = starts.partition_point(|&start| start <= s).max(1) - 1;
    (piece, s - starts[piece])
}

/// All pieces with their numbers; on a lattice, all translates that reach within a cell of the one where paths are followed.
fn all_nearby(pieces: &[Arc<dyn Piece>], cell: Option<&FundamentalCell>) -> Vec<Translate> {
    if let Some(cell) = cell {
        return translates(pieces, cell, 1.0);
    }
    pieces.iter().enumerate().map(|(number, piece)| Translate::home(number, piece)).collect()
}

/// Fails where the pieces reach over so many cells that their translates would fill the memory, or lie too far away for cells to be
/// counted.
fn few_cells(pieces: &[Arc<dyn Piece>], cell: &FundamentalCell) -> Result<(), Error> {
    let mut sum = 0.0;
    for (piece, p) in pieces.iter().enumerate() {
        let reach = cell.reach(&**p, 1.0);
        let away = reach.as_flattened().iter().fold(0.0, |m: f64, cell| m.max(cell.abs())) * cell.skew();
        let cells: f64 = reach.iter().map(|[first, last]| last - first + 1.0).product();
        if away > Lattice::FARTHEST_CELL && cells <= MOST_TRANSLATES {
            return Err(Error::FarFromCell { piece, cells: away });
        }
        sum += cells;
        if sum > MOST_TRANSLATES {
            return Err(Error::ManyCells { piece, cells });
        }
    }
    Ok(())
}

/// The translates of pieces that reach within `margin` cells of the one where paths are followed, in the order of their numbers.
fn translates(pieces: &[Arc<dyn Piece>], cell: &FundamentalCell, margin: f64) -> Vec<Translate> {
    let mut found = vec![];
    for (number, piece) in pieces.iter().enumerate() {
        let by = multiples(cell.reach(&**piece, margin));
        found.extend(by.map(|by| Translate::new(number, piece, cell.lattice(), by)));
    }
    found
}
