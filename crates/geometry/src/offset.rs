//! Where the centre of a disk can be: the inward offset of a table.
//!
//! Every piece is moved inwards by the radius: straight walls shift, focusing arcs shrink, dispersing arcs grow, other curves become
//! [`Parallel`](crate::shapes::Parallel)s, and arcs about the re-entrant corners close the gaps that open there. What is moved too far,
//! over corners or through necks, crosses the rest. So all crossings are found, the moved pieces are cut there, and only those parts are
//! kept that are as far from the boundary as they should be; they bound the region of centres.
mod arrangement;
mod moved;
mod raw;
mod swallowtail;
mod tips;
mod tolerances;
mod vertices;

use crate::{Error, Extent, Figure, Piece, Table, plane::is_finite, shapes::kink};
use arrangement::Arrangement;
use nalgebra::Vector2;

/// Number of parts of a curve in which a kink is looked for.
const PLACES: u32 = 256;

/// A region between parallels of curves that is no wider than this many times the rounding of the table's coordinates is refused: points of
/// the curves are known only to a few times that rounding, so orbits would leave such a thin region at its vertices, about one flight in a
/// million.
const THIN: f64 = 262_144.0; // 2¹⁸

/// Where a piece of an offset comes from on the drawn boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Origin {
    /// The parallel of the piece of that number.
    Piece(usize),
    /// The arc about the re-entrant corner where one piece ends and another starts; at the tip of a wall without thickness both are that
    /// wall.
    Corner {
        /// The piece that ends at the corner.
        before: usize,
        /// The piece that starts there.
        after: usize,
    },
}

impl Origin {
    /// The number of the drawn piece that is touched; at a corner, of the one before it.
    ///
    /// ```
    /// use geometry::Origin;
    /// assert_eq!(Origin::Corner { before: 3, after: 0 }.piece(), 3);
    /// ```
    pub fn piece(self) -> usize {
        match self {
            Origin::Piece(piece) => piece,
            Origin::Corner { before, .. } => before,
        }
    }
}

/// The region of centres of a disk on a table.
#[derive(Clone, Debug)]
pub struct Offset {
    /// The region, itself a table.
    pub table: Table,
    /// For each of its pieces, where it comes from.
    pub origins: Vec<Origin>,
}

impl Table {
    /// The points at distance at least `radius` \[L\] from everything outside the table: where the centre of a disk of
    /// that radius can be.
    ///
    /// Pieces are numbered loop by loop, each loop from its piece of lowest origin. A neck narrower than the disk cuts the
    /// region into several parts; a neck exactly as wide counts as closed, or is refused as [`Error::Undecided`] where rounding would
    /// decide about it.
    ///
    /// ```
    /// use geometry::{Origin, tables};
    /// // a disk in an equilateral triangle: its centre moves in a smaller one
    /// let triangle = tables::equilateral(1.0)?;
    /// let centres = triangle.offset(0.125)?;
    /// let side = 1.0 - 2.0 * 3.0_f64.sqrt() * 0.125;
    /// assert!((centres.table.perimeter() - 3.0 * side).abs() < 1e-15);
    /// assert_eq!(centres.origins, [Origin::Piece(0), Origin::Piece(1), Origin::Piece(2)]);
    /// assert!(triangle.offset(0.3).is_err()); // the inscribed circle has radius √3/6 = 0.2887
    /// # Ok::<(), geometry::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Radius`] for a radius that is negative or not finite, [`Error::NothingLeft`] where no such disk fits,
    /// [`Error::Undecided`] where rounding would decide whether it does, [`Error::RoughPiece`] for a kink within a piece. The table should
    /// satisfy [`Table::validate`].
    pub fn offset(&self, radius: f64) -> Result<Offset, Error> {
        if radius == 0.0 {
            let origins = (0..self.pieces().len()).map(Origin::Piece).collect();
            return Ok(Offset { table: self.clone(), origins });
        }
        if !(radius > 0.0 && radius.is_finite()) {
            return Err(Error::Radius { radius });
        }
        let loops = if self.is_less_than(radius) {
            vec![]
        } else {
            let loops = raw::raw(self, radius).and_then(|raw| Arrangement::new(self, radius, raw).loops());
            loops.map_err(|error| self.rough_piece(radius, &error).unwrap_or(error))?
        };
        if loops.is_empty() {
            let largest = self.largest_disk();
            // a disk that all but fits
            let fits = largest.radius > radius;
            return Err(if fits {
                undecided(radius, largest.center)
            } else {
                Error::NothingLeft { radius, largest: largest.radius }
            });
        }
        let size = self.extent().size();
        for around in &loops {
            let extent = around.iter().map(|(piece, _)| piece.extent()).fold(Extent::EMPTY, Extent::union);
            let width = (extent.max - extent.min).min();
            // a chain that goes on in the next cell has no width of its own
            let ends = |k: usize| around[k].0.ends();
            let closes = ends(0).map(|[start, _]| start) == ends(around.len() - 1).map(|[_, end]| end);
            let are_curves = around.iter().any(|(piece, _)| piece.figure() == Figure::Other);
            if are_curves && closes && width <= THIN * f64::EPSILON * size {
                return Err(undecided(radius, 0.5 * (extent.min + extent.max)));
            }
        }
        let (mut pieces, mut origins): (Vec<Box<dyn Piece>>, Vec<Origin>) = (vec![], vec![]);
        for (piece, origin) in loops.into_iter().flatten() {
            pieces.push(piece);
            origins.push(origin);
        }
        let table = Table::periodic(pieces, self.lattice().cloned())?;
        Ok(Offset { table: if self.unbounded { table.unbounded() } else { table }, origins })
    }

    /// Whether certainly no disk of this radius fits. (Radii that almost fit are left to the parallels of the pieces; for much larger ones
    /// every parallel would cross every other.)
    fn is_less_than(&self, radius: f64) -> bool {
        if let Some(lattice) = self.shortest() {
            // on a flat torus a copy of any point lies within half the sum of two shortest vectors, and so does a wall
            return matches!(lattice.vectors(), [a, b] if radius > 0.5 * (a.norm() + b.norm()));
        }
        let extent = self.extent();
        let size = extent.max - extent.min;
        extent.is_finite() && radius > size.min() && !self.contains(&(extent.max + size))
    }

    /// An error for a kink or cusp within a piece, where the offset fails because of it, for every radius.
    fn rough_piece(&self, radius: f64, error: &Error) -> Option<Error> {
        let at = match error {
            Error::Undecided { at, .. } | Error::Bend { at, .. } => Vector2::from(*at),
            // somewhere
            Error::ZeroLength => Vector2::repeat(f64::NAN),
            _ => return None,
        };
        // on a lattice it may be the kink of a copy
        let is_anywhere = self.lattice().is_some() || !is_finite(&at);
        let is_there = |p: &Vector2<f64>, reach: f64| is_anywhere || (p - at).norm() <= 1.5 * radius + reach;
        let is_curve = |p: &dyn Piece| p.figure() == Figure::Other && p.tips().is_none();
        self.pieces().iter().enumerate().filter(|(_, curve)| is_curve(&***curve)).find_map(|(piece, curve)| {
            let part = curve.length() / f64::from(PLACES);
            let place = |k: u32| part * f64::from(k);
            // the first kink that is found may be elsewhere
            let is_near = |k: &u32| is_there(&curve.point_at(place(*k) + 0.5 * part), 0.5 * part);
            let s = kink(&**curve, (0..PLACES).filter(is_near).map(|k| [place(k), place(k + 1)]))?;
            Some(curve.point_at(s)).filter(|p| is_there(p, 0.0)).map(|at| Error::RoughPiece { piece, at: at.into() })
        })
    }
}

fn undecided(radius: f64, at: Vector2<f64>) -> Error {
    Error::Undecided { radius, at: at.into() }
}
