//! Products in the plane, in lanes.
use lanes::Lane;

/// `a · b`
#[inline(always)]
pub(crate) fn dot<F: Lane>(a: [F; 2], b: [F; 2]) -> F {
    a[0] * b[0] + a[1] * b[1]
}

/// `a × b = a₁ b₂ − a₂ b₁`: positive where `b` points to the left of `a`.
#[inline(always)]
pub(crate) fn cross<F: Lane>(a: [F; 2], b: [F; 2]) -> F {
    a[0] * b[1] - a[1] * b[0]
}

/// `p − x` for a constant point `p`.
#[inline(always)]
pub(crate) fn from<F: Lane>(x: [F; 2], p: [f64; 2]) -> [F; 2] {
    [x[0].same(p[0]) - x[0], x[1].same(p[1]) - x[1]]
}

/// `x + t v`
#[inline(always)]
pub(crate) fn along<F: Lane>(x: [F; 2], v: [F; 2], t: F) -> [F; 2] {
    [x[0] + t * v[0], x[1] + t * v[1]]
}

/// `p + b`
pub(crate) fn moved(p: [f64; 2], by: [f64; 2]) -> [f64; 2] {
    [p[0] + by[0], p[1] + by[1]]
}

/// How far outside a start may lie and still count as on the boundary: rounding of coordinates of this size.
///
/// A projected point is off by at most 2 ulp per coordinate, and evaluating its distance adds as much again; 16 leaves
/// a factor of two on each. Relative, so a scene scaled by a power of two behaves alike to the last bit.
pub(crate) fn slack(coordinates: impl IntoIterator<Item = f64>) -> f64 {
    16.0 * f64::EPSILON * coordinates.into_iter().fold(0.0, |m: f64, c| m.max(c.abs()))
}
