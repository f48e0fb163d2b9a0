//! Chords of round walls.
use lanes::Lane;

/// The squared distance of a start from the centre may differ from the squared radius by this share of it for the start to count as on the
/// wall: a distance of 8 ulp of the radius, where the rounding of a landing is one or two.
const ON: f64 = 16.0 * f64::EPSILON;
/// The square of the sine of the angle to the wall below which a path from it is a chord.
const FLAT: f64 = 1.0 / 16.0;

/// Whether a path from inside starts on a round wall of this squared radius, within rounding, and leaves it at a small angle: with
/// `a = |v|²`, `b = y·v` and `c = |y|² − r²`, for a start `y` and a velocity `v` relative to the centre.
///
/// Such a path is a chord, and meets the wall at the time `−2b/a`. As a root of `a t² + 2 b t + c` it would arrive with the squared normal
/// velocity `(b² − a c)/r²`: rounding of `c`, which is 0, changes the normal velocity by 10⁻¹⁶/vₙ in every collision, always in the same
/// direction, and that of a particle which creeps along the wall would soon be wrong altogether. Where the angle is not small, a root is
/// exact for the start as it is rounded.
#[inline(always)]
pub(crate) fn is_chord<F: Lane>([a, b, c]: [F; 3], square: f64) -> F::Mask {
    let zero = a.same(0.0);
    b.lt(zero) & c.abs().lt(zero.same(ON * square)) & (b * b).lt(a * (FLAT * square))
}
