//! What the named tables share: checks of their parameters, and vertices with the exact symmetry of the figure.
use crate::{Error, Piece, shapes::Segment};
use core::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_4};
use nalgebra::Vector2;

/// A parameter that must be positive (and finite).
pub(super) fn positive(name: &'static str, value: f64) -> Result<f64, Error> {
    within(name, value, value > 0.0 && value.is_finite(), "positive and finite")
}

/// A parameter that must satisfy some condition.
pub(super) fn within(name: &'static str, value: f64, holds: bool, must: &'static str) -> Result<f64, Error> {
    if holds { Ok(value) } else { Err(Error::Parameter { name, must, value }) }
}

/// The sides of a polygon, counter-clockwise: side `i` from vertex `i` to the next.
pub(super) fn sides(vertices: &[Vector2<f64>]) -> Result<Vec<Box<dyn Piece>>, Error> {
    let side = |i: usize| -> Result<Box<dyn Piece>, Error> {
        Ok(Box::new(Segment::new(vertices[i], vertices[(i + 1) % vertices.len()])?))
    };
    (0..vertices.len()).map(side).collect()
}

/// The sides of the regular `n`-gon of the given side about the origin, counter-clockwise, vertex 0 on the positive x₁ axis.
pub(super) fn regular(n: usize, side: f64) -> Result<Vec<Box<dyn Piece>>, Error> {
    let vertex = |k: usize| on_circumcircle(2 * k, n, side);
    let piece = |k: usize| -> Result<Box<dyn Piece>, Error> {
        Ok(Box::new(Segment::of_line(vertex(k), vertex(k + 1), root_of_unity(2 * k + 1, 2 * n))?))
    };
    (0..n).map(piece).collect()
}

/// Most sides of a regular figure.
pub const MOST_VERTICES: usize = 1_000_000;

/// A number of sides or petals.
pub(super) fn number_of(name: &'static str, n: usize, least: usize) -> Result<usize, Error> {
    if (least..=MOST_VERTICES).contains(&n) {
        Ok(n)
    } else {
        Err(Error::Count { name, least, most: MOST_VERTICES, value: n })
    }
}

/// `(cos 2πk/n, sin 2πk/n)` to within 1 ulp of 1, with the exact mirror symmetries of the n-gon.
pub(super) fn root_of_unity(k: usize, n: usize) -> [f64; 2] {
    // the angle in units of 1/n of an octant, folded into the first octant
    let mut at = 8 * (k % n);
    let below = at > 4 * n;
    if below {
        at = 8 * n - at;
    }
    let behind = at > 2 * n;
    if behind {
        at = 4 * n - at;
    }
    let steep = at > n;
    if steep {
        at = 2 * n - at;
    }
    let (cos, sin) = if at == 0 {
        (1.0, 0.0)
    } else if 3 * at == 2 * n {
        (0.5 * 3.0_f64.sqrt(), 0.5)
    } else if at == n {
        (FRAC_1_SQRT_2, FRAC_1_SQRT_2)
    } else {
        let angle = at as f64 / n as f64 * FRAC_PI_4;
        (libm::cos(angle), libm::sin(angle))
    };
    let (x, y) = if steep { (sin, cos) } else { (cos, sin) };
    [if behind { -x } else { x }, if below { -y } else { y }]
}

/// The point at polar angle `k π/n` on the circle through the vertices of the regular `n`-gon of the given side about
/// the origin; even `k` are its vertices, if vertex 0 lies on the positive x₁ axis.
pub(super) fn on_circumcircle(k: usize, n: usize, side: f64) -> Vector2<f64> {
    let [_, sin] = root_of_unity(1, 2 * n);
    // a single division, so that the square with vertices (±1, ±1) is exact
    Vector2::from(root_of_unity(k, 2 * n)).map(|c| side * (0.5 * c / sin))
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::PI;

    #[test]
    fn roots_of_unity_are_right_and_exactly_symmetric() {
        for n in 1..=48 {
            for k in 0..n {
                let [x, y] = root_of_unity(k, n);
                let angle = 2.0 * PI * k as f64 / n as f64;
                // the angle of the comparison, up to 2π, carries two roundings: 2π ulp of 1
                assert!((x - libm::cos(angle)).abs() <= 7.0 * f64::EPSILON, "{k}/{n}");
                assert!((y - libm::sin(angle)).abs() <= 7.0 * f64::EPSILON, "{k}/{n}");
                let [xm, ym] = root_of_unity(n - k, n);
                assert_eq!([x, y + 0.0], [xm, 0.0 - ym]);
                if n % 4 == 0 {
                    let [xq, yq] = root_of_unity(k + n / 4, n);
                    assert_eq!([xq + 0.0, yq + 0.0], [0.0 - y, x + 0.0]);
                }
            }
        }
    }
}
