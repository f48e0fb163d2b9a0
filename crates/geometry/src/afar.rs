//! Landings on round walls that are tiny beside the flight.
//!
//! A landing point is projected onto a round wall, and its normal normalised, by one step of Newton's method each. These leave a
//! relative error that is the square of the point's distance from the wall, in units of the radius. Rounding puts the point off by the
//! rounding error of the flight's length, so walls with a radius of 10⁻⁸ of that length or less need more.
use lanes::{Lane, Mask, dot};

/// How far off the wall, as a fraction of the radius, a point may lie for Newton's method to leave next to no error: `√ε/2`.
pub(crate) const NEWTON: f64 = 1.0 / (1 << 27) as f64;

/// The point and the normal where a path lands on a circle, if its position `y` relative to the centre is off the circle by more than
/// [`NEWTON`]. The circle is given by its centre, the factor `±1/r` from relative position to normal, and `r²`.
#[cold]
#[inline(never)]
pub(crate) fn on_circle<F: Lane>(
    y: &[F; 2],
    v: &[F; 2],
    center: [F; 2],
    [to_normal, square]: [F; 2],
) -> ([F; 2], [F; 2]) {
    let (zero, one) = (v[0].same(0.0), v[0].same(1.0));
    // opposite to the path where the position is the centre itself
    let distance = dot(y, y);
    let somewhere = zero.lt(distance);
    let to = [somewhere.select(y[0], -v[0]), somewhere.select(y[1], -v[1])];
    let inverse = one / somewhere.select(distance, dot(v, v)).sqrt();
    let side = to_normal.same(1.0).copysign(to_normal);
    let unit = [to[0] * inverse, to[1] * inverse];
    let radius = square * to_normal.abs();
    ([unit[0] * radius + center[0], unit[1] * radius + center[1]], [unit[0] * side, unit[1] * side])
}
