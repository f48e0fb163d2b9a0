//! Landings on round walls that are tiny beside the flight.
//!
//! A place on a round wall is brought onto it, and the length of its normal found, by one step of Newton's method each. What these leave
//! is the square of what the place is off, as part of the radius. Rounding puts it off by that of the flight's length, so walls with a
//! radius of 10⁻⁸ of that and less need more.
use lanes::{Lane, Mask, dot};

/// By how much, as part of the radius, a place may be off for Newton's method to leave next to nothing: `√ε/2`.
pub(crate) const NEWTON: f64 = 1.0 / (1 << 27) as f64;

/// The point of a circle and the normal where a path lands whose place `y` is off it by more than [`NEWTON`]; of the circle, its centre,
/// `±1/r`, from there to the normal, and `r²`.
#[cold]
#[inline(never)]
pub(crate) fn on_circle<F: Lane>(
    y: &[F; 2],
    v: &[F; 2],
    center: [F; 2],
    [to_normal, square]: [F; 2],
) -> ([F; 2], [F; 2]) {
    let (zero, one) = (v[0].same(0.0), v[0].same(1.0));
    // against the path where the place is the centre itself
    let distance = dot(y, y);
    let somewhere = zero.lt(distance);
    let to = [somewhere.select(y[0], -v[0]), somewhere.select(y[1], -v[1])];
    let inverse = one / somewhere.select(distance, dot(v, v)).sqrt();
    let side = to_normal.same(1.0).copysign(to_normal);
    let unit = [to[0] * inverse, to[1] * inverse];
    let radius = square * to_normal.abs();
    ([unit[0] * radius + center[0], unit[1] * radius + center[1]], [unit[0] * side, unit[1] * side])
}
