//! Translations that identify points of the plane: channels and flat tori.
use crate::Error;
use nalgebra::{Matrix2, Vector2};

/// One or two independent translations. The unit cell is `{a ℓ₁ + b ℓ₂ : 0 ≤ a < 1, 0 ≤ b < 1}`, or the band
/// `0 ≤ a < 1` where there is only one.
#[derive(Clone, Debug, PartialEq)]
pub struct Lattice {
    vectors: Vec<Vector2<f64>>,
    /// Rows: the functionals `a` and `b`.
    coordinates: Matrix2<f64>,
}

impl Lattice {
    /// The lattice spanned by one or two vectors \[L\].
    ///
    /// # Errors
    /// [`Error::Lattice`] unless they are finite and independent.
    pub fn new(vectors: &[Vector2<f64>]) -> Result<Lattice, Error> {
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

    /// The point of the unit cell that is the same as `point`, and the translation from the one to the other, in
    /// multiples of the vectors.
    pub fn reduce(&self, point: &Vector2<f64>) -> (Vector2<f64>, [f64; 2]) {
        let (mut p, mut cell) = (*point, [0.0; 2]);
        for (i, vector) in self.vectors.iter().enumerate() {
            let [f, g] = self.functional(i);
            cell[i] = libm::floor(f * p.x + g * p.y);
            p -= vector * cell[i];
        }
        (p, cell)
    }

    /// The lattice vector nearest to a displacement, in multiples of the vectors.
    pub fn nearest(&self, displacement: &Vector2<f64>) -> [f64; 2] {
        let mut cell = [0.0; 2];
        for (i, c) in cell.iter_mut().enumerate().take(self.vectors.len()) {
            let [f, g] = self.functional(i);
            *c = libm::round(f * displacement.x + g * displacement.y);
        }
        cell
    }

    /// The translation that is `cell` multiples of the vectors.
    pub fn translation(&self, cell: [f64; 2]) -> Vector2<f64> {
        self.vectors.iter().zip(cell).map(|(v, c)| v * c).sum()
    }
}
