//! The axioms one by one: the defect at one velocity, or of one map at one velocity.
//!
//! Velocities are in the coordinates of [`Pair::coordinates`](crate::Pair::coordinates). [`Axiom`](super::Axiom) says what each number
//! means.

use crate::TangentSpace;
use nalgebra::{DMatrix, DVector};

use super::jacobian_determinant;

/// Both velocities in unit coordinates, divided by the length of the first.
fn scaled<const N: usize>(
    space: &TangentSpace<N>,
    before: &DVector<f64>,
    after: &DVector<f64>,
) -> (DVector<f64>, DVector<f64>) {
    let (before, after) = (space.to_unit(before), space.to_unit(after));
    let size = before.norm();
    (before / size, after / size)
}

/// Energy: `| |v⁺|² − |v|² | / |v|²`.
pub fn energy<const N: usize>(space: &TangentSpace<N>, before: &DVector<f64>, after: &DVector<f64>) -> f64 {
    let (_, after) = scaled(space, before, after);
    (after.norm_squared() - 1.0).abs()
}

/// Linear momentum: its change, measured in the kinetic-energy metric, over `|v|`; `None` if a body is not free.
pub fn linear_momentum<const N: usize>(
    space: &TangentSpace<N>,
    before: &DVector<f64>,
    after: &DVector<f64>,
) -> Option<f64> {
    space.translations().map(|motions| along(motions, space, before, after))
}

/// Angular momentum: its change, measured in the kinetic-energy metric, over `|v|`; `None` if a body is not free.
pub fn angular_momentum<const N: usize>(
    space: &TangentSpace<N>,
    before: &DVector<f64>,
    after: &DVector<f64>,
) -> Option<f64> {
    space.rotations().map(|motions| along(motions, space, before, after))
}

fn along<const N: usize>(
    motions: &DMatrix<f64>,
    space: &TangentSpace<N>,
    before: &DVector<f64>,
    after: &DVector<f64>,
) -> f64 {
    let (before, after) = scaled(space, before, after);
    motions.tr_mul(&(after - before)).norm()
}

/// Outgoing to ingoing: how far the image of an approaching velocity, or minus that of a receding one, still approaches.
pub fn outgoing_to_ingoing<const N: usize>(
    space: &TangentSpace<N>,
    before: &DVector<f64>,
    after: &DVector<f64>,
) -> f64 {
    let (before, after) = scaled(space, before, after);
    let apart = space.normal().dot(&after) * -space.normal().dot(&before).signum();
    if apart > 0.0 { 0.0 } else { -apart }
}

/// Impulse only at the contact: the part of `v⁺ − v` outside the impulse space, over `|v|`.
pub fn contact_impulse<const N: usize>(space: &TangentSpace<N>, before: &DVector<f64>, after: &DVector<f64>) -> f64 {
    let (before, after) = scaled(space, before, after);
    let change = after - before;
    (&change - space.impulse_space() * space.impulse_space().tr_mul(&change)).norm()
}

/// Involution: `|C C v − v| / |v|`.
pub fn involution<const N: usize>(
    space: &TangentSpace<N>,
    map: impl Fn(&DVector<f64>) -> DVector<f64>,
    v: &DVector<f64>,
) -> f64 {
    let (v, twice) = scaled(space, v, &map(&map(v)));
    (twice - v).norm()
}

/// Linearity: `|C(v + w) − C v − C w| / (|v| + |w|)`.
pub fn linearity<const N: usize>(
    space: &TangentSpace<N>,
    map: impl Fn(&DVector<f64>) -> DVector<f64>,
    v: &DVector<f64>,
    w: &DVector<f64>,
) -> f64 {
    let gap = space.to_unit(&(map(&(v + w)) - map(v) - map(w))).norm();
    gap / (space.to_unit(v).norm() + space.to_unit(w).norm())
}

/// Measure: the factor `|det DC(v)| · |⟨C v, N̂⟩| / |⟨v, N̂⟩|` by which `C` multiplies the canonical measure near `v`.
///
/// The derivative is a difference quotient; see [`jacobian_determinant`].
pub fn measure_ratio<const N: usize>(
    space: &TangentSpace<N>,
    map: impl Fn(&DVector<f64>) -> DVector<f64>,
    v: &DVector<f64>,
) -> f64 {
    let unit = |y: &DVector<f64>| space.to_unit(&map(&space.from_unit(y)));
    let y = space.to_unit(v);
    // a step that is not too short: truncation and rounding are both below 1e-12 for maps as smooth as sine
    let step = y.norm() / 512.0;
    let determinant = jacobian_determinant(unit, &y, step);
    (determinant * space.normal().dot(&unit(&y)) / space.normal().dot(&y)).abs()
}
