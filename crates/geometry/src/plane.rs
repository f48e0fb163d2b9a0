//! Products of plane vectors, in lanes.
use crate::{Error, Extent};
use core::ops::RangeInclusive;
use lanes::{Double, Lane, two_sum};
use nalgebra::SVector;

/// Directions that differ by less than this (radians) count as equal: rounding of vertices turns short pieces by more than an ulp, and no
/// intended angle is this small.
pub(crate) const SAME_DIRECTION: f64 = 1e-9;

/// `(3 − √5)/2`, the smaller part of 1 in the golden section: a place at which little that is drawn begins or ends, since vertices lie at
/// halves, thirds and quarters.
pub(crate) const GOLDEN_SECTION: f64 = 0.381_966_011_250_105;

/// `1/ρ` and `1/ρ²` with `ρ³ = ρ + 1`: the fractional parts of their multiples fill the square evenly, as those of the golden ratio,
/// [`GOLDEN_RATIO`], fill an interval [Roberts 2018].
pub(crate) const PLASTIC_RATIOS: [f64; 2] = [0.754_877_666_246_693, 0.569_840_290_998_053_2];

/// `(√5 − 1)/2`: no fraction with a denominator `q` is nearer to it than some `1/(√5 q²)`.
pub const GOLDEN_RATIO: f64 = 0.618_033_988_749_894_9;

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

/// A key that distinguishes points that differ in any bit; −0 is 0.
pub(crate) fn key<const N: usize>(point: impl Into<[f64; N]>) -> [u64; N] {
    point.into().map(|x| (x + 0.0).to_bits())
}

/// Whether all coordinates are finite.
pub(crate) fn is_finite<const N: usize>(point: &SVector<f64, N>) -> bool {
    point.iter().all(|x| x.is_finite())
}

/// Refuses a point with a coordinate that is not finite, naming it in the error.
pub(crate) fn finite<const N: usize>(name: &'static str, point: &SVector<f64, N>) -> Result<(), Error> {
    match point.iter().find(|x| !x.is_finite()) {
        Some(&value) => Err(Error::Parameter { name, must: "finite", value }),
        None => Ok(()),
    }
}

/// The lengths \[L\] whose squares, and what is computed from them, neither over- nor underflow.
pub(crate) const LENGTHS: RangeInclusive<f64> = 1e-150..=1e150;

/// What a length \[L\] must be for its square, and what is computed from it, neither to over- nor to underflow, in the words of
/// [`Error::Length`] and [`Error::Field`].
pub const MUST_HAVE_SQUARE: &str = "between 1e-150 and 1e150";

/// Refuses a length that is not one of [`LENGTHS`].
pub(crate) fn has_square(name: &'static str, value: f64) -> Result<(), Error> {
    if LENGTHS.contains(&value) { Ok(()) } else { Err(Error::Length { name, must: MUST_HAVE_SQUARE, value }) }
}

/// Refuses a radius that is not positive and finite, or not one of [`LENGTHS`].
pub(crate) fn is_radius(radius: f64) -> Result<(), Error> {
    if !(radius > 0.0 && radius.is_finite()) {
        return Err(Error::Radius { radius });
    }
    has_square("the radius", radius)
}

/// Refuses a boundary whose greatest finite coordinate is not one of [`LENGTHS`], given the boxes around its parts; 0 is the size of lines
/// and planes through the origin.
pub(crate) fn has_squares<const N: usize>(boxes: impl IntoIterator<Item = Extent<N>>) -> Result<(), Error> {
    let size = boxes.into_iter().map(|extent| extent.size()).fold(0.0, f64::max);
    if size == 0.0 { Ok(()) } else { has_square("the greatest coordinate of the boundary", size) }
}

/// The unit vector from `a` to `b`, each component correct to its last digit, and the distance; `None` where there is no direction.
pub(crate) fn direction(a: [f64; 2], b: [f64; 2]) -> Option<([f64; 2], f64)> {
    let d = [0, 1].map(|i| two_sum(b[i], -a[i]));
    let size = d[0].0.abs().max(d[1].0.abs());
    if !(size > 0.0 && d.iter().all(|d| d.0.is_finite())) {
        return None;
    }
    // of size 1, so that no square over- or underflows
    let (_, exponent) = libm::frexp(size);
    let one = |x: f64| libm::ldexp(x, -exponent);
    let d = d.map(|(high, low)| Double { high: one(high), low: one(low) });
    let length = d[0].times(d[0]).plus(d[1].times(d[1])).root();
    let distance = libm::ldexp(length.value(), exponent);
    distance.is_finite().then(|| (d.map(|d| d.over(length).value()), distance))
}

/// The arc length of the same point of a closed curve that lies between 0 and its length, up to rounding.
pub(crate) fn once_around(s: f64, length: f64) -> f64 {
    s - libm::floor(s / length) * length
}

/// How far outside a start may lie and still count as on the boundary: rounding of coordinates of this size.
///
/// A projected point is off by at most 2 ulp per coordinate, and evaluating its distance adds as much again; 16 leaves
/// a factor of two on each. Relative, so a scene scaled by a power of two behaves alike to the last bit.
pub(crate) fn slack(coordinates: impl IntoIterator<Item = f64>) -> f64 {
    16.0 * f64::EPSILON * coordinates.into_iter().fold(0.0, |m: f64, c| m.max(c.abs()))
}

/// The signed distance below which a start counts as beyond an infinite straight wall: minus the rounding of coordinates, which grows along
/// the wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Behind {
    /// Factor of `|x₁| + |x₂|` of the start.
    relative: f64,
    constant: f64,
}

impl Behind {
    /// For a wall through a point whose coordinates have this [`slack`].
    pub(crate) fn of(slack: f64) -> Behind {
        Behind { relative: -16.0 * f64::EPSILON, constant: -slack }
    }
    /// For one side of a two-sided wall: a start must lie inside by half of that.
    pub(crate) fn two_sided(self) -> Behind {
        Behind { relative: 0.5 * self.relative.abs(), constant: 0.5 * self.constant.abs() }
    }
    pub(crate) fn is_two_sided(self) -> bool {
        self.relative > 0.0
    }
    /// The least distance on the table's side at which a path from `x` meets the wall.
    #[inline(always)]
    pub(crate) fn at<F: Lane>(self, x: [F; 2]) -> F {
        (x[0].abs() + x[1].abs()) * self.relative + self.constant
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_radius_is_positive_finite_and_has_a_square() {
        for radius in [1e-150, 1.0, 1e150] {
            assert_eq!(is_radius(radius), Ok(()));
        }
        for radius in [0.0, -1.0, f64::INFINITY] {
            assert_eq!(is_radius(radius), Err(Error::Radius { radius }));
        }
        assert!(matches!(is_radius(f64::NAN), Err(Error::Radius { .. })));
        for value in [1e-151, 1e151] {
            assert_eq!(is_radius(value), Err(Error::Length { name: "the radius", must: MUST_HAVE_SQUARE, value }));
        }
    }

    #[test]
    fn a_direction_has_the_nearest_numbers_at_any_scale() {
        // of 5, 12 and 13: exact except for the division
        for scale in [1.0, libm::ldexp(1.0, 1000), libm::ldexp(1.0, -1060)] {
            let far = [7.0 * scale, -3.0 * scale];
            let (unit, length) = direction(far, moved(far, [5.0 * scale, -12.0 * scale])).unwrap();
            assert_eq!((unit, length), ([5.0 / 13.0, -12.0 / 13.0], 13.0 * scale));
        }
        // the difference of the first coordinates, 1 − 2⁻⁶⁰, is no f64
        let (unit, _) = direction([libm::ldexp(1.0, -60), 0.0], [1.0, libm::ldexp(1.0, -30)]).unwrap();
        assert_eq!(unit, [1.0, libm::ldexp(1.0, -30)]);
    }

    #[test]
    fn zeros_of_either_sign_have_one_key() {
        assert_eq!(key([-0.0, 1.0]), key([0.0, 1.0]));
        assert_ne!(key([5e-324, 1.0]), key([0.0, 1.0]));
    }

    #[test]
    fn equal_points_and_infinite_ones_have_no_direction() {
        for b in [[0.5, -0.25], [f64::INFINITY, 0.0], [f64::NAN, 0.0], [f64::MAX, f64::MAX]] {
            assert_eq!(direction([0.5, -0.25], b), None);
        }
    }
}
