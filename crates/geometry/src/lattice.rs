//! Translations that identify points of the plane: channels and flat tori.
use crate::{
    Error,
    plane::{has_square, is_finite, slack},
};
use core::iter::successors;
use nalgebra::{Matrix2, Vector2};

/// One or two independent translations. The unit cell is `{a ℓ₁ + b ℓ₂ : 0 ≤ a < 1, 0 ≤ b < 1}`, or the band
/// `0 ≤ a < 1` where there is only one.
///
/// ```
/// use geometry::{Lattice, Vector2};
///
/// let lattice = Lattice::new(&[Vector2::new(2.0, 0.0), Vector2::new(1.0, 2.0)])?;
/// let far = Vector2::new(7.5, -2.5);
/// let (home, cell) = lattice.reduce(&far);
/// assert_eq!((home, cell), (Vector2::new(1.5, 1.5), [4.0, -2.0]));
/// assert_eq!(home + lattice.translation(cell), far);
/// # Ok::<(), geometry::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Lattice {
    vectors: Vec<Vector2<f64>>,
    /// Rows: the functionals `a` and `b`.
    coordinates: Matrix2<f64>,
}

impl Lattice {
    /// Beyond this many cells, coordinates are rounded to an eighth of a cell or more, and a little farther cells can no longer be
    /// counted.
    pub const FARTHEST_CELL: f64 = 1_125_899_906_842_624.0; // 2⁵⁰

    /// The lattice spanned by one or two vectors \[L\].
    ///
    /// # Errors
    /// [`Error::Lattice`] unless they are finite and independent, [`Error::Length`] unless the greatest coordinate of each is between
    /// 10⁻¹⁵⁰ and 10¹⁵⁰.
    pub fn new(vectors: &[Vector2<f64>]) -> Result<Lattice, Error> {
        let mut sizes = vectors.iter().filter(|vector| is_finite(vector)).map(Vector2::amax).filter(|size| *size > 0.0);
        sizes.try_for_each(|size| has_square("the greatest coordinate of a lattice vector", size))?;
        Lattice::spanned_by(vectors)
    }

    /// The same for vectors of any size.
    fn spanned_by(vectors: &[Vector2<f64>]) -> Result<Lattice, Error> {
        let full = match vectors {
            [a] => Matrix2::from_columns(&[*a, Vector2::new(-a.y, a.x)]),
            [a, b] => Matrix2::from_columns(&[*a, *b]),
            _ => return Err(Error::Lattice),
        };
        let coordinates = full.try_inverse().filter(|m| m.iter().all(|x| x.is_finite())).ok_or(Error::Lattice)?;
        Ok(Lattice { vectors: vectors.to_vec(), coordinates })
    }

    /// The translations.
    pub fn vectors(&self) -> &[Vector2<f64>] {
        &self.vectors
    }

    /// The same lattice with vectors as short as possible (Lagrange–Gauss reduction), and each new vector in multiples of the old ones.
    pub(crate) fn reduced(&self) -> (Lattice, [[f64; 2]; 2]) {
        let mut of_old = [[1.0, 0.0], [0.0, 1.0]];
        let &[mut a, mut b] = self.vectors.as_slice() else { return (self.clone(), of_old) };
        let size = a.amax().max(b.amax());
        (a, b) = (a / size, b / size);
        let mut shorter = false;
        loop {
            if b.norm_squared() < a.norm_squared() {
                (a, b) = (b, a);
                of_old.swap(0, 1);
            }
            let share = a.dot(&b) / a.norm_squared();
            // rounding may make a half appear as more
            if share.is_nan() || share.abs() <= 0.5 + 1e-9 {
                break;
            }
            let times = libm::round(share);
            b -= a * times;
            of_old[1] = [0, 1].map(|i| of_old[1][i] - times * of_old[0][i]);
            shorter = true;
        }
        if !shorter {
            return (self.clone(), [[1.0, 0.0], [0.0, 1.0]]);
        }
        // computed from the old vectors, to agree with these to the last digit
        let vectors = of_old.map(|[i, j]| self.translation([i, j]));
        Lattice::spanned_by(&vectors)
            .map_or_else(|_| (self.clone(), [[1.0, 0.0], [0.0, 1.0]]), |lattice| (lattice, of_old))
    }

    /// The functionals that give a point's lattice coordinates.
    pub(crate) fn functional(&self, i: usize) -> [f64; 2] {
        [self.coordinates[(i, 0)], self.coordinates[(i, 1)]]
    }

    /// The lattice coordinates `a` and `b` of a point: the second is 0 where there is only one vector.
    pub fn coordinates(&self, point: &Vector2<f64>) -> [f64; 2] {
        let mut all = [0.0; 2];
        for (i, coordinate) in all.iter_mut().enumerate().take(self.vectors.len()) {
            let [f, g] = self.functional(i);
            *coordinate = f * point.x + g * point.y;
        }
        all
    }

    /// Area of the unit cell \[L²\]; infinite for a channel's band.
    pub fn cell_area(&self) -> f64 {
        match self.vectors.as_slice() {
            [a, b] => (a.x * b.y - a.y * b.x).abs(),
            _ => f64::INFINITY,
        }
    }

    /// The point of the unit cell that is equivalent to `point`, and the translation from the one to the other, in multiples of the
    /// vectors.
    pub fn reduce(&self, point: &Vector2<f64>) -> (Vector2<f64>, [f64; 2]) {
        let (mut p, mut cell) = (*point, [0.0; 2]);
        for (i, vector) in self.vectors.iter().enumerate() {
            let [f, g] = self.functional(i);
            cell[i] = libm::floor(f * p.x + g * p.y);
            p -= vector * cell[i];
        }
        (p, cell)
    }

    /// The lattice vector that a displacement equals up to something small, in multiples of the vectors: its lattice coordinates, rounded.
    ///
    /// It is the nearest lattice vector if the displacement is within half the distance of neighbouring rows of the lattice from it.
    /// Farther away, or where a short vector is a sum of long ones, another may be nearer.
    pub fn rounded(&self, displacement: &Vector2<f64>) -> [f64; 2] {
        self.coordinates(displacement).map(libm::round)
    }

    /// How many of each vector lead from `a` to `b`, where within rounding they differ by a lattice vector.
    pub(crate) fn between(&self, a: &Vector2<f64>, b: &Vector2<f64>) -> Option<[f64; 2]> {
        let cell = self.rounded(&(b - a));
        let off = b - a - self.translation(cell);
        (is_finite(a) && is_finite(b) && off.amax() <= slack(a.iter().chain(b.iter()).copied())).then_some(cell)
    }

    /// The translation by the multiples `cell` of the vectors.
    pub fn translation(&self, cell: [f64; 2]) -> Vector2<f64> {
        self.vectors.iter().zip(cell).map(|(v, c)| v * c).sum()
    }
}

/// All pairs of multiples, each from its least to its largest value.
pub(crate) fn multiples([first, second]: [[f64; 2]; 2]) -> impl Iterator<Item = [f64; 2]> {
    let up = |[least, largest]: [f64; 2]| successors(Some(least), |k| Some(k + 1.0)).take_while(move |k| *k <= largest);
    up(first).flat_map(move |i| up(second).map(move |j| [i, j]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(vectors: [[f64; 2]; 2]) -> Lattice {
        Lattice::new(&vectors.map(Vector2::from)).unwrap()
    }

    #[test]
    fn the_shortest_vectors_of_a_lattice_are_found() {
        for (vectors, lengths) in [
            ([[1.0, 0.0], [0.5, 0.866]], [libm::hypot(0.5, 0.866); 2]),
            ([[1.0, 0.0], [1.0, 1e-5]], [1e-5, 1.0]),
            ([[1.0, 0.0], [1e-9, 1e-5]], [1e-5, 1.0]),
            ([[3.0, 1.0], [10.0, 3.0]], [1.0, 1.0]),
            ([[3e149, 1e149], [10e149, 3e149]], [1e149, 1e149]),
            ([[3e-150, 1e-150], [10e-150, 3e-150]], [1e-150, 1e-150]),
        ] {
            let (short, of_old) = of(vectors).reduced();
            let mut found = [0, 1].map(|i| short.vectors()[i].norm());
            found.sort_by(f64::total_cmp);
            let close = |i: usize| (found[i] - lengths[i]).abs() <= 1e-7 * lengths[i];
            assert!(close(0) && close(1), "{vectors:?} {found:?}");
            assert_eq!((of_old[0][0] * of_old[1][1] - of_old[0][1] * of_old[1][0]).abs(), 1.0, "{of_old:?}");
        }
    }

    #[test]
    fn points_that_differ_by_a_lattice_vector_but_for_rounding_are_told() {
        let lattice = of([[1.0, 0.0], [0.1, 0.7]]);
        let a = Vector2::new(0.3, 1e3);
        let b = a + lattice.translation([-2.0, 5.0]);
        assert_eq!(lattice.between(&a, &b), Some([-2.0, 5.0]));
        assert_eq!(lattice.between(&a, &(b + Vector2::new(0.0, 1e-11))), None); // slack: 4·10⁻¹² at 10³
        assert_eq!(lattice.between(&a, &Vector2::new(f64::INFINITY, 0.0)), None);
    }

    #[test]
    fn multiples_are_gone_through_row_by_row() {
        let all = |range| multiples(range).collect::<Vec<_>>();
        assert_eq!(all([[-1.0, 0.0], [2.0, 3.0]]), [[-1.0, 2.0], [-1.0, 3.0], [0.0, 2.0], [0.0, 3.0]]);
        assert_eq!(all([[0.0, 0.0]; 2]), [[0.0; 2]]);
        assert!(all([[0.0, 5.0], [1.0, 0.0]]).is_empty());
    }

    #[test]
    fn vectors_that_are_short_stay_as_they_are() {
        for vectors in [[[1.0, 0.0], [0.0, 1.0]], [[1.0, 0.0], [0.5, 0.75_f64.sqrt()]], [[0.0, -1.0], [1.25, 0.125]]] {
            let (short, of_old) = of(vectors).reduced();
            assert_eq!((short, of_old), (of(vectors), [[1.0, 0.0], [0.0, 1.0]]));
        }
    }
}
