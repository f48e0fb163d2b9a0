//! The tangent space `T_qM` in coordinates: where the axioms of a collision map are statements about matrices.

use crate::{Body, Contact, Pair, TangentVector, Velocities};
use nalgebra::{DMatrix, DVector, SMatrix, SVector};

/// The tangent space `T_qM` of two bodies at a contact.
///
/// A velocity has the coordinates of [`Pair::coordinates`]. The *unit* coordinates used inside are orthonormal for the
/// kinetic-energy metric: `y = Lᵀ x` with `G = L Lᵀ`, so that `|y|² = 2·energy` whatever the masses. In unit coordinates
/// the contact map is `J̃ = J L⁻ᵀ`, the impulse space `C_q` is the range of `J̃ᵀ`, and the non-slip space its complement.
#[derive(Debug, Clone, PartialEq)]
pub struct TangentSpace<const N: usize> {
    contact: Contact<N>,
    metric: DMatrix<f64>,
    /// `Lᵀ` and its inverse, block by block for the two bodies.
    to_unit: DMatrix<f64>,
    from_unit: DMatrix<f64>,
    /// Orthonormal columns that span `C_q`, in unit coordinates.
    impulses: DMatrix<f64>,
    /// The upper triangle or trapezium `R` with `J̃ᵀ = impulses · R`.
    triangle: DMatrix<f64>,
    /// The unit normal `N̂ = G⁻¹Jᵀν / |·|` of the boundary of configuration space, in unit coordinates.
    normal: DVector<f64>,
    /// Orthonormal columns that span the translations of the whole pair; none if a body is not free.
    translations: DMatrix<f64>,
    /// Orthonormal columns that span the rotations of the whole pair about the contact, off the translations.
    rotations: DMatrix<f64>,
}

impl<const N: usize> TangentSpace<N> {
    pub(crate) fn new<A: Body<N>, B: Body<N>>(pair: &Pair<A, B, N>) -> Self {
        let size = pair.degrees_of_freedom();
        let basis: Vec<_> = pair.basis().collect();
        let metric = gram(pair, &basis);
        let (rough_to, rough_from) = unit_coordinates(&metric);
        // a second time: inner products along the axes of space have lost what is small beside the largest moment of a slender body
        let nearly: Vec<_> = rough_from.column_iter().map(|x| pair.velocities(x.clone_owned().as_slice())).collect();
        let (to_last, from_last) = unit_coordinates(&gram(pair, &nearly));
        let (to_unit, from_unit) = (to_last * rough_to, rough_from * from_last);

        let mut contact_map = DMatrix::zeros(N, size);
        for (j, v) in basis.iter().enumerate() {
            contact_map.set_column(j, &DVector::from_column_slice(pair.contact_velocity(v).as_slice()));
        }
        let qr = (contact_map * &from_unit).transpose().qr();
        let (impulses, triangle) = (qr.q(), qr.r());
        let nu = DVector::from_column_slice(pair.contact.normal.as_slice());
        let normal = (&impulses * (&triangle * nu)).normalize();

        let mut space = Self {
            contact: pair.contact,
            metric,
            to_unit,
            from_unit,
            impulses,
            triangle,
            normal,
            translations: DMatrix::zeros(size, 0),
            rotations: DMatrix::zeros(size, 0),
        };
        if pair.first.is_free() && pair.second.is_free() {
            space.add_rigid_motions(pair);
        }
        space
    }

    fn add_rigid_motions<A: Body<N>, B: Body<N>>(&mut self, pair: &Pair<A, B, N>) {
        let motion = |a: &SVector<f64, N>, spin: &SMatrix<f64, N, N>| {
            let v = (
                A::Velocity::of_rigid_motion(&pair.arms[0], a, spin),
                B::Velocity::of_rigid_motion(&pair.arms[1], a, spin),
            );
            &self.to_unit * pair.coordinates(&v)
        };
        let mut translations = Vec::new();
        let mut rotations = Vec::new();
        for i in 0..N {
            let mut a = SVector::zeros();
            a[i] = 1.0;
            push_orthonormal(&mut translations, &[], motion(&a, &SMatrix::zeros()));
        }
        for i in 0..N {
            for j in 0..i {
                let mut spin = SMatrix::zeros();
                spin[(i, j)] = 1.0;
                spin[(j, i)] = -1.0;
                push_orthonormal(&mut rotations, &translations, motion(&SVector::zeros(), &spin));
            }
        }
        let columns = |v: &[DVector<f64>]| {
            if v.is_empty() { DMatrix::zeros(self.metric.nrows(), 0) } else { DMatrix::from_columns(v) }
        };
        (self.translations, self.rotations) = (columns(&translations), columns(&rotations));
    }

    /// The dimension of `T_qM`.
    pub fn dimension(&self) -> usize {
        self.metric.nrows()
    }

    /// The contact.
    pub fn contact(&self) -> &Contact<N> {
        &self.contact
    }

    /// The kinetic-energy metric `G` in the coordinates of [`Pair::coordinates`].
    pub fn metric(&self) -> &DMatrix<f64> {
        &self.metric
    }

    /// Coordinates to unit coordinates.
    pub fn to_unit(&self, coordinates: &DVector<f64>) -> DVector<f64> {
        &self.to_unit * coordinates
    }

    /// Unit coordinates to coordinates.
    pub fn from_unit(&self, unit: &DVector<f64>) -> DVector<f64> {
        &self.from_unit * unit
    }

    /// The matrix of a linear map of `T_qM`, given in coordinates, in unit coordinates.
    pub fn map_to_unit(&self, map: &DMatrix<f64>) -> DMatrix<f64> {
        &self.to_unit * map * &self.from_unit
    }

    /// The unit normal `N̂` of the boundary of configuration space, pointing away from contact, in unit coordinates.
    pub fn normal(&self) -> &DVector<f64> {
        &self.normal
    }

    /// The factor by which the rounding of single coordinates may grow in the length of the metric: `‖ |Lᵀ| |L⁻ᵀ| ‖∞`. It is 1 for balls
    /// and bodies in the plane, about the root of the ratio of the principal moments for a needle that lies askew, and independent of
    /// units.
    pub(crate) fn rounding(&self) -> f64 {
        let rows = self.to_unit.abs() * self.from_unit.abs();
        rows.row_iter().map(|row| row.sum()).fold(0.0, f64::max)
    }

    /// An orthonormal basis of the impulse space `C_q`, as columns in unit coordinates.
    pub fn impulse_space(&self) -> &DMatrix<f64> {
        &self.impulses
    }

    /// The smallest impulses `p ∈ ℝᴺ` at the contact that make the given changes of velocity, columns in the basis
    /// [`impulse_space`](Self::impulse_space). They are not the only ones if the bodies have fewer than N degrees of freedom.
    pub(crate) fn impulses_of(&self, changes: &DMatrix<f64>) -> Option<DMatrix<f64>> {
        let across = self.triangle.transpose().qr();
        Some(across.q() * across.r().tr_solve_upper_triangular(changes)?)
    }

    /// Orthonormal columns spanning the translations of the pair: the change of velocity has no part along them exactly if
    /// linear momentum is conserved (Noether). `None` if a body is not [free](Body::is_free) and the axiom is vacuous.
    pub fn translations(&self) -> Option<&DMatrix<f64>> {
        (self.translations.ncols() > 0).then_some(&self.translations)
    }

    /// Orthonormal columns spanning the rotations of the pair, as [`translations`](Self::translations) for angular momentum.
    pub fn rotations(&self) -> Option<&DMatrix<f64>> {
        (self.rotations.ncols() > 0).then_some(&self.rotations)
    }
}

/// The inner products of the given velocities.
fn gram<A: Body<N>, B: Body<N>, const N: usize>(pair: &Pair<A, B, N>, of: &[Velocities<A, B, N>]) -> DMatrix<f64> {
    DMatrix::from_fn(of.len(), of.len(), |i, j| pair.inner_product(&of[i], &of[j]))
}

/// `Lᵀ` and its inverse, with `G = L Lᵀ`.
fn unit_coordinates(metric: &DMatrix<f64>) -> (DMatrix<f64>, DMatrix<f64>) {
    let size = metric.nrows();
    let undefined = || DMatrix::repeat(size, size, f64::NAN); // a body that breaks its contract: all defects are NaN
    let to_unit = metric.clone().cholesky().map_or_else(undefined, |factor| factor.l().transpose());
    let from_unit = to_unit.solve_upper_triangular(&DMatrix::identity(size, size)).unwrap_or_else(undefined);
    (to_unit, from_unit)
}

/// Adds the part of `x` that is orthogonal to `basis` and `others`, unless rounding is all that is left of it.
fn push_orthonormal(basis: &mut Vec<DVector<f64>>, others: &[DVector<f64>], x: DVector<f64>) {
    let size = x.norm();
    if size == 0.0 {
        return;
    }
    let mut x = x / size;
    for _ in 0..2 {
        for b in others.iter().chain(basis.iter()) {
            x -= b * b.dot(&x);
        }
        // a rounding for each coordinate of each of the others, of which there are some dozens
        if x.norm() <= 1e3 * f64::EPSILON {
            return; // a turn that moves nothing, such as that of two points about their contact
        }
        x /= x.norm();
    }
    basis.push(x);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_of_matrices_have_the_same_bits_on_every_cpu() {
        // (1 + 2⁻³⁰)² − (1 + 2⁻²⁹) is 2⁻⁶⁰, or 0 where the square is rounded before it is added
        let (one, size) = (1.0 + f64::from(1 << 30).recip(), 12);
        let row = DMatrix::from_fn(size, size, |_, j| [-(2.0 * one - 1.0), one].get(j).copied().unwrap_or(0.0));
        let column = DMatrix::from_fn(size, size, |i, _| [1.0, one].get(i).copied().unwrap_or(0.0));
        assert_eq!(row * column, DMatrix::zeros(size, size));
    }
}
