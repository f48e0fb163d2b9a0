//! The converse of the classification theorem: from a matrix to the law.

use crate::{
    Error, Roughness, TangentSpace,
    check::{Axiom, Report},
    symmetric::eigenframe,
};
use nalgebra::{DMatrix, SMatrix, SVector};

/// What a linear map of `T_qM` is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Classification<const N: usize> {
    /// How far the map is from each axiom.
    pub report: Report,
    /// If it is a strict collision map, its point of `Gr(k, ν⊥)`, with k its [`rank`](Roughness::rank).
    pub strict: Option<Roughness<N>>,
}

/// Whether a linear map of `T_qM` is a strict collision map, and which one.
///
/// `map` is a square matrix in the coordinates of [`Pair::coordinates`](crate::Pair::coordinates); it is strict if no axiom's
/// defect exceeds `tolerance` ([`check::TOLERANCE`](crate::check::TOLERANCE) suits bodies of comparable size,
/// [`check::tolerance`](crate::check::tolerance) any).
///
/// A strict map is `C = 1 − 2P`, `P` the projector, orthogonal for the kinetic-energy metric, onto `W = G⁻¹Jᵀ span(ν, R)`; here `W` is
/// read off `C` on the impulse space and `R` off `W`. Two immovable bodies have no velocities, so no axiom is broken and no map is
/// strict. Source: Cox, Feres and Ward, arXiv:1501.06536; in Cox and Feres, *No-slip billiards in dimension two*, Theorem 1.1.
///
/// # Errors
/// [`Error::WrongLength`] unless the matrix has as many rows and columns as `T_qM` has dimensions, [`Error::NotFinite`].
///
/// ```
/// use collision_laws::{Contact, Fixed, Pair, bodies::Ball, check::{Axiom, TOLERANCE}, classify, laws::NoSlip};
/// use nalgebra::{DMatrix, Vector2};
///
/// let contact = Contact::new(Vector2::zeros(), Vector2::new(0.0, 1.0), 0)?;
/// let disk = Ball::<2>::uniform(1.0, 1.0)?;
/// let pair = Pair::new(contact, (disk, Vector2::new(0.0, -1.0)), (Fixed, Vector2::zeros()));
///
/// let no_slip = classify(&pair.tangent_space(), &pair.collision_map(&NoSlip), TOLERANCE)?;
/// assert_eq!(no_slip.strict.map(|roughness| roughness.rank()), Some(1));
///
/// // Reversing the velocity of the centre, but not the spin, is a push that no contact can give.
/// let bounce_back = DMatrix::from_diagonal(&[-1.0, -1.0, 1.0].to_vec().into());
/// let found = classify(&pair.tangent_space(), &bounce_back, TOLERANCE)?;
/// let broken: Vec<Axiom> = found.report.broken(TOLERANCE).map(|(axiom, _)| axiom).collect();
/// assert_eq!((found.strict, broken), (None, vec![Axiom::ContactImpulse]));
/// # Ok::<(), collision_laws::Error>(())
/// ```
pub fn classify<const N: usize>(
    space: &TangentSpace<N>,
    map: &DMatrix<f64>,
    tolerance: f64,
) -> Result<Classification<N>, Error> {
    for given in [map.nrows(), map.ncols()] {
        if given != space.dimension() {
            return Err(Error::WrongLength { quantity: "a side of the matrix", given, expected: space.dimension() });
        }
    }
    if map.iter().any(|x| !x.is_finite()) {
        return Err(Error::NotFinite { quantity: "the matrix" });
    }
    if space.dimension() == 0 {
        return Ok(Classification { report: Report::EMPTY, strict: None });
    }
    let c = space.map_to_unit(map);
    let report = defects(space, &c);
    let strict = if report.is_strict(tolerance) { Some(rough_directions(space, &c)) } else { None };
    Ok(Classification { report, strict })
}

/// The defects of a matrix in unit coordinates, as Frobenius norms.
fn defects<const N: usize>(space: &TangentSpace<N>, c: &DMatrix<f64>) -> Report {
    let one = DMatrix::identity(c.nrows(), c.ncols());
    let change = c - &one;
    let mut report = Report::EMPTY;
    report.note(Axiom::Energy, (c.tr_mul(c) - &one).norm());
    if let Some(motions) = space.translations() {
        report.note(Axiom::LinearMomentum, motions.tr_mul(&change).norm());
    }
    if let Some(motions) = space.rotations() {
        report.note(Axiom::AngularMomentum, motions.tr_mul(&change).norm());
    }
    report.note(Axiom::Involution, (c * c - &one).norm());
    // C maps {⟨v, N̂⟩ ≤ 0} into {⟨v, N̂⟩ ≥ 0} exactly if CᵀN̂ = −c N̂ with c ≥ 0 (Farkas)
    let image = c.tr_mul(space.normal());
    let factor = (-space.normal().dot(&image)).max(0.0);
    report.note(Axiom::OutgoingToIngoing, (&image + space.normal() * factor).norm());
    let inside = space.impulse_space() * space.impulse_space().tr_mul(&change);
    report.note(Axiom::ContactImpulse, (change - inside).norm());
    let (determinant, along) = (c.determinant(), space.normal().dot(&image));
    let aslant = (&image - space.normal() * along).norm();
    report.note_measure_ratio((determinant * along).abs(), determinant.abs() * aslant);
    report
}

/// The rough directions of a strict map in unit coordinates.
fn rough_directions<const N: usize>(space: &TangentSpace<N>, c: &DMatrix<f64>) -> Roughness<N> {
    let basis = space.impulse_space();
    let size = basis.ncols(); // fewer than N if the bodies have fewer degrees of freedom
    // on C_q, and without the normal: an orthogonal projector of rank k
    let on_impulses = basis.tr_mul(&(c * basis));
    let normal = basis.tr_mul(space.normal());
    let projector = SMatrix::<f64, N, N>::from_fn(|i, j| {
        if i.max(j) >= size {
            return 0.0;
        }
        let identity = if i == j { 1.0 } else { 0.0 };
        0.5 * identity - 0.25 * (on_impulses[(i, j)] + on_impulses[(j, i)]) - normal[i] * normal[j]
    });
    let (values, frame) = eigenframe(projector);
    let reversed: Vec<usize> = (0..N).filter(|i| values[*i] > 0.5).collect();
    let changes = DMatrix::from_fn(size, reversed.len(), |i, j| frame[(i, reversed[j])]);
    let directions: Vec<SVector<f64, N>> = space.impulses_of(&changes).map_or_else(Vec::new, |impulses| {
        impulses.column_iter().map(|p| SVector::from_iterator(p.iter().copied())).collect()
    });
    Roughness::of_span(&space.contact().normal, &directions)
}
