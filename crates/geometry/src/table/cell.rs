//! The cell in which paths on a lattice are followed.
use crate::{Extent, Figure, Lattice, Piece, plane::slack};
use nalgebra::Vector2;
use std::sync::Arc;

/// A cell that holds each point of a channel or a flat torus once: `{Σ (cₖ + aₖ) ℓₖ : 0 ≤ aₖ < 1}` with the shortest vectors `ℓₖ` of
/// the lattice and a corner `c`.
///
/// Any such cell is possible. In a long and thin one a path would cross edges all the time, so the vectors are those of the
/// [`Lattice`]'s shortest basis; and a piece that is cut by an edge would have to be tested twice, so the corner lies where the fewest
/// are cut. Where nothing is gained, it is the unit cell of the lattice as given.
#[derive(Clone, Debug)]
pub struct FundamentalCell {
    given: Lattice,
    lattice: Lattice,
    /// Each of the shortest vectors in multiples of the given ones.
    of_given: [[f64; 2]; 2],
    /// The lattice coordinates of the corner.
    corner: [f64; 2],
}

impl FundamentalCell {
    /// The cell with its corner at the origin.
    pub(super) fn at_origin(given: Lattice) -> FundamentalCell {
        let (lattice, of_given) = given.reduced();
        FundamentalCell { given, lattice, of_given, corner: [0.0; 2] }
    }

    /// The cell with its corner placed so that the fewest translates of these pieces reach in.
    pub(super) fn around(self, pieces: &[Arc<dyn Piece>]) -> FundamentalCell {
        let count = self.lattice.vectors().len();
        let of_piece = |piece: &Arc<dyn Piece>| {
            let mut spans = [None; 2];
            for (k, span) in spans.iter_mut().enumerate().take(count) {
                *span = span_of(&**piece, self.lattice.functional(k));
            }
            spans
        };
        let spans: Vec<[Option<[f64; 2]>; 2]> = pieces.iter().map(of_piece).collect();
        let gap = [0, 1].map(|k| widest_gap(spans.iter().filter_map(|spans| spans[k])));
        let copies = |corner: [f64; 2]| -> f64 {
            let of_one = |spans: &[Option<[f64; 2]>; 2]| {
                let along = |k: usize| spans[k].map_or(1.0, |span| many(reaching(span, corner[k], 0.0)));
                along(0) * along(1)
            };
            spans.iter().map(of_one).sum()
        };
        let candidates = [[0.0; 2], [gap[0], 0.0], [0.0, gap[1]], gap];
        let fewest = candidates.map(|corner| (corner, copies(corner))).into_iter().reduce(|best, other| {
            // where no other is better, the corner stays
            if other.1 < best.1 { other } else { best }
        });
        FundamentalCell { corner: fewest.map_or([0.0; 2], |(corner, _)| corner), ..self }
    }

    /// The lattice as given.
    pub fn given(&self) -> &Lattice {
        &self.given
    }

    /// The same lattice with vectors as short as possible: the edges of the cell.
    pub fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    /// The lattice coordinates of the corner, each in [−1/2, 1/2).
    pub fn corner(&self) -> [f64; 2] {
        self.corner
    }

    /// Whether it is the unit cell of the lattice as given.
    pub fn is_unit_cell(&self) -> bool {
        self.corner == [0.0; 2] && self.is_as_given()
    }

    /// Whether the shortest vectors are the given ones.
    fn is_as_given(&self) -> bool {
        self.of_given == [[1.0, 0.0], [0.0, 1.0]]
    }

    /// The point of the cell that is equivalent to `point`, and the translation from the one to the other, in multiples of the given
    /// vectors.
    pub fn home(&self, point: &Vector2<f64>) -> (Vector2<f64>, [f64; 2]) {
        let (home, cell) = self.home_in_shortest(point);
        if self.is_as_given() {
            return (home, cell);
        }
        (home, [0, 1].map(|i| cell[0] * self.of_given[0][i] + cell[1] * self.of_given[1][i]))
    }

    /// The same in multiples of the shortest vectors.
    pub(super) fn home_in_shortest(&self, point: &Vector2<f64>) -> (Vector2<f64>, [f64; 2]) {
        let (mut p, mut cell) = (*point, [0.0; 2]);
        for (k, vector) in self.lattice.vectors().iter().enumerate() {
            let [f, g] = self.lattice.functional(k);
            cell[k] = libm::floor(f * p.x + g * p.y - self.corner[k]);
            p -= vector * cell[k];
        }
        (p, cell)
    }

    /// Whether a point lies in the cell or, up to rounding, on its edge.
    pub fn holds(&self, point: &Vector2<f64>) -> bool {
        (0..self.lattice.vectors().len()).all(|k| {
            let [f, g] = self.lattice.functional(k);
            let (parts, corner) = ([f * point.x, g * point.y], self.corner[k]);
            let (at, rounding) = (parts[0] + parts[1] - corner, slack([1.0, corner].into_iter().chain(parts)));
            -rounding <= at && at <= 1.0 + rounding
        })
    }

    /// The same in the unit cell of the lattice as given. A point of the unit cell stays where it is, even if rounding has taken it
    /// across the edge while paths are followed in that cell.
    pub fn in_unit_cell(&self, point: &Vector2<f64>) -> (Vector2<f64>, [f64; 2]) {
        if self.is_unit_cell() { (*point, [0.0; 2]) } else { self.given.reduce(point) }
    }

    /// The largest multiple of a given vector in one of the shortest ones.
    pub(super) fn skew(&self) -> f64 {
        self.of_given.as_flattened().iter().fold(0.0, |most, count| most.max(count.abs()))
    }

    /// For each of the shortest vectors, the least and the largest multiple by which a piece can be moved to reach within `margin`
    /// cells of this one.
    pub(super) fn reach(&self, piece: &dyn Piece, margin: f64) -> [[f64; 2]; 2] {
        let mut range = [[0.0; 2]; 2];
        for (k, range) in range.iter_mut().enumerate().take(self.lattice.vectors().len()) {
            if let Some(span) = span_of(piece, self.lattice.functional(k)) {
                *range = reaching(span, self.corner[k], margin);
            }
        }
        range
    }

    /// Whether a disk lies in the cell, so that no translate of it reaches in.
    pub(super) fn contains_disk(&self, center: Vector2<f64>, radius: f64) -> bool {
        (0..self.lattice.vectors().len()).all(|k| {
            let [low, high] = span_of_disk(center, radius, self.lattice.functional(k));
            low - self.corner[k] >= 0.0 && high - self.corner[k] <= 1.0
        })
    }
}

/// The range of a lattice coordinate over a piece; `None` for one that goes on for ever.
fn span_of(piece: &dyn Piece, functional @ [f, g]: [f64; 2]) -> Option<[f64; 2]> {
    if let Figure::Circle { center, radius, .. } = piece.figure() {
        return Some(span_of_disk(center, radius, functional));
    }
    let Extent { min, max } = piece.extent();
    let corners_of = [min, Vector2::new(max.x, min.y), max, Vector2::new(min.x, max.y)];
    // an infinite extent at right angles to the functional does not count
    let at = corners_of.map(|c| [f * c.x, g * c.y].iter().filter(|a| !a.is_nan()).sum::<f64>());
    let (low, high) = at.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &a| (l.min(a), h.max(a)));
    (low.is_finite() && high.is_finite()).then_some([low, high])
}

/// The same for a disk, which has no corners.
fn span_of_disk(center: Vector2<f64>, radius: f64, [f, g]: [f64; 2]) -> [f64; 2] {
    let (at, reach) = (f * center.x + g * center.y, radius * libm::hypot(f, g));
    [at - reach, at + reach]
}

/// The least and the largest number of cells by which a span can be moved to reach within `margin` cells of the cell that starts at
/// `corner`.
fn reaching([low, high]: [f64; 2], corner: f64, margin: f64) -> [f64; 2] {
    // a wall along an edge of cells bounds those on both sides of it; and of two walls that meet in a vertex on an edge, both must be there
    // to decide which of them a path through it hits
    let rounding = slack([1.0, low, high]);
    let margin = margin + rounding;
    // translates by t reach that far where low + t < corner + 1 + margin and high + t ≥ corner − margin
    [-libm::floor(high + margin - corner), libm::ceil(1.0 + margin + corner - low) - 1.0]
}

/// How many numbers there are from the least to the largest.
fn many([least, largest]: [f64; 2]) -> f64 {
    largest - least + 1.0
}

/// The middle of the widest stretch, modulo 1, where the fewest spans are cut; in [−1/2, 1/2), and 0 without spans.
fn widest_gap(spans: impl Iterator<Item = [f64; 2]>) -> f64 {
    // how many are cut at 0, and the places where the number changes by one
    let (mut cut, mut ends) = (0.0, vec![]);
    for span in spans {
        let [from, to] = span.map(|at| at - libm::floor(at));
        if to < from {
            cut += 1.0;
        }
        ends.extend([(from, 1.0), (to, -1.0)]);
    }
    ends.sort_by(|(a, _), (b, _)| f64::total_cmp(a, b));
    let Some(&(first, _)) = ends.first() else { return 0.0 };
    let (mut fewest, mut widest, mut middle) = (f64::INFINITY, 0.0, 0.0);
    for (k, (at, more)) in ends.iter().enumerate() {
        cut += more;
        let next = ends.get(k + 1).map_or(first + 1.0, |(next, _)| *next);
        let width = next - at;
        if width > 0.0 && (cut < fewest || (cut == fewest && width > widest)) {
            (fewest, widest, middle) = (cut, width, 0.5 * (at + next));
        }
    }
    middle - libm::floor(middle + 0.5)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Table, shapes::Circle};

    fn v(x: f64, y: f64) -> Vector2<f64> {
        Vector2::new(x, y)
    }
    fn cell(vectors: &[Vector2<f64>], disks: &[(Vector2<f64>, f64)]) -> FundamentalCell {
        let disk = |(center, radius): &(Vector2<f64>, f64)| {
            Box::new(Circle::new(*center, *radius, false).unwrap()) as Box<dyn Piece>
        };
        let lattice = Lattice::new(vectors).unwrap();
        Table::periodic(disks.iter().map(disk).collect(), Some(lattice)).unwrap().cell().unwrap().clone()
    }

    #[test]
    fn a_disk_that_the_unit_cell_cuts_lies_in_the_middle_of_the_cell() {
        let square = [v(1.0, 0.0), v(0.0, 1.0)];
        assert_eq!(cell(&square, &[(v(0.0, 0.0), 0.25)]).corner(), [-0.5, -0.5]);
        assert_eq!(cell(&square, &[(v(0.5, 0.0), 0.25)]).corner(), [0.0, -0.5]);
        // the same disk is cut wherever it lies, and if none is cut the corner stays
        assert_eq!(cell(&square, &[(v(1e6, -1e6), 0.25)]).corner(), [-0.5, -0.5]);
        assert!(cell(&square, &[(v(0.375, 0.6), 0.25)]).is_unit_cell());
        let hexagonal = cell(&[v(1.0, 0.0), v(0.5, 0.75_f64.sqrt())], &[(v(0.0, 0.0), 0.4)]);
        assert!(hexagonal.contains_disk(v(0.0, 0.0), 0.4) && !hexagonal.contains_disk(v(0.1, 0.0), 0.4));
        // scaled by a power of two it is the same
        let scaled = cell(&[v(0.125, 0.0), v(0.0625, 0.125 * 0.75_f64.sqrt())], &[(v(0.0, 0.0), 0.05)]);
        assert_eq!(hexagonal.corner(), scaled.corner());
    }

    #[test]
    fn the_corner_lies_where_the_fewest_disks_are_cut() {
        let square = [v(1.0, 0.0), v(0.0, 1.0)];
        // between 0.1 and 0.3 none is cut, above 0.6 both are
        let corner = cell(&square, &[(v(0.55, 0.5), 0.25), (v(0.9, 0.5), 0.2)]).corner();
        assert!((corner[0] - 0.2).abs() < 1e-15 && corner[1] == 0.0, "{corner:?}");
        // nothing is gained where some disk is always cut
        let all_over = [(v(0.0, 0.5), 0.2), (v(1.0 / 3.0, 0.5), 0.2), (v(2.0 / 3.0, 0.5), 0.2)];
        assert_eq!(cell(&square, &all_over).corner(), [0.0; 2]);
    }

    #[test]
    fn a_cell_holds_what_lies_between_its_edges_and_on_them() {
        for corner in [[0.0, 0.0], [-0.5, -0.5], [0.2, 0.0]] {
            let square = FundamentalCell {
                corner,
                ..FundamentalCell::at_origin(Lattice::new(&[v(1.0, 0.0), v(0.25, 1.0)]).unwrap())
            };
            for (i, j) in (-9..=9).flat_map(|i| (-9..=9).map(move |j| (i, j))) {
                let parts = [i, j].map(|k| 0.125 * f64::from(k));
                let point = v(corner[0] + parts[0] + 0.25 * (corner[1] + parts[1]), corner[1] + parts[1]);
                let within = parts.iter().all(|part| (0.0..=1.0).contains(part));
                assert_eq!(square.holds(&point), within, "{corner:?} {parts:?}");
                // rounding does not matter, more than that does
                for off in [1e-15, -1e-15] {
                    assert_eq!(square.holds(&(point + v(off, off))), within, "{corner:?} {parts:?} {off}");
                }
                let clear = parts.iter().all(|part| (1e-9..=1.0 - 1e-9).contains(part));
                for off in [v(1e-9, 0.0), v(-1e-9, 0.0), v(0.25e-9, 1e-9), v(-0.25e-9, -1e-9)] {
                    assert!(!clear || square.holds(&(point + off)), "{corner:?} {parts:?}");
                }
                if within && parts[0] == 1.0 {
                    assert!(!square.holds(&(point + v(1e-9, 0.0))), "{corner:?} {parts:?}");
                }
                if within && parts[1] == 0.0 {
                    assert!(!square.holds(&(point - v(0.25e-9, 1e-9))), "{corner:?} {parts:?}");
                }
            }
        }
    }

    #[test]
    fn points_come_home_and_back_by_the_vectors_as_they_were_given() {
        let skew = [v(1.0, 0.0), v(20.0, 1.0)];
        let cell = cell(&skew, &[(v(0.0, 0.0), 0.25)]);
        assert_eq!((cell.lattice().vectors()[1].amax(), cell.corner()), (1.0, [-0.5, -0.5]));
        for point in [v(0.3, 0.4), v(-7.25, 12.5), v(10.0, 0.75)] {
            let (home, by) = cell.home(&point);
            assert!(home.amax() <= 0.5 && cell.holds(&home) && !cell.holds(&(home + v(1.0, 0.0))), "{home}");
            assert_eq!(home + cell.given().translation(by), point);
            let (unit, by) = cell.in_unit_cell(&home);
            assert_eq!(cell.given().reduce(&unit), (unit, [0.0; 2]));
            assert!((unit + cell.given().translation(by) - home).amax() < 1e-14);
        }
    }
}
