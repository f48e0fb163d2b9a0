//! Arc length of an ellipse: the incomplete elliptic integral of the second kind, without cancellation.

/// `∫₀^φ √(cos²θ + q sin²θ) dθ` for `0 ≤ φ ≤ π/2`, given `sin φ` and `cos φ` (both ≥ 0) and `q > 0`.
///
/// This is Legendre's `E(φ | m)` with `m = 1 − q`. All terms are positive in the form used on either side of `q = 1`,
/// so that the relative error stays at a few units of rounding for every `q` between 10⁻¹⁰⁰ and 10¹⁰⁰.
/// Reference: [DLMF, 19.25.9 and 19.25.10].
pub(crate) fn second_kind(sin: f64, cos: f64, q: f64) -> f64 {
    let (s2, c2, m) = (sin * sin, cos * cos, 1.0 - q);
    let delta2 = c2 + q * s2;
    if sin <= 0.0 {
        0.0
    } else if m < 0.0 {
        let [f, d] = carlson(c2, delta2, 1.0);
        sin * (f - m / 3.0 * s2 * d)
    } else {
        let last = cos / delta2.sqrt();
        let [f, d] = carlson(c2, 1.0, delta2);
        sin * (q * f + m * (q / 3.0 * s2 * d + last))
    }
}

/// Carlson's `R_F = ½ ∫₀^∞ dt / √((t+x)(t+y)(t+z))` and `R_D = (3/2) ∫₀^∞ dt / ((t+z) √((t+x)(t+y)(t+z)))`, by duplication; `z > 0`,
/// at most one of the other two may be 0.
fn carlson(mut x: f64, mut y: f64, mut z: f64) -> [f64; 2] {
    let (mut sum, mut factor) = (0.0, 1.0);
    loop {
        let [even, weighted] = [(x + y + z) / 3.0, (x + y + 3.0 * z) / 5.0];
        // the series are cut at the sixth order: 3 · 0.0015⁶ is a tenth of rounding
        // (the loop also ends where something is NaN)
        if !(x.max(y).max(z) - x.min(y).min(z) >= 0.0015 * even.min(weighted)) {
            let [dx, dy, dz] = [x, y, z].map(|a| 1.0 - a / even);
            let (e2, e3) = (dx * dy - dz * dz, dx * dy * dz);
            let f = (1.0 + (e2 / 24.0 - 0.1 - 3.0 / 44.0 * e3) * e2 + e3 / 14.0) / even.sqrt();
            let [dx, dy, dz] = [x, y, z].map(|a| 1.0 - a / weighted);
            let (a, b) = (dx * dy, dz * dz);
            let (c, d) = (a - b, a - 6.0 * b);
            let e = d + 2.0 * c;
            let series = 1.0
                + d * (-3.0 / 14.0 + 9.0 / 88.0 * d - 9.0 / 52.0 * dz * e)
                + dz * (e / 6.0 + dz * (-9.0 / 22.0 * c + dz * (3.0 / 26.0 * a)));
            return [f, 3.0 * sum + factor * series / (weighted * weighted.sqrt())];
        }
        let [rx, ry, rz] = [x.sqrt(), y.sqrt(), z.sqrt()];
        let lambda = rx * ry + rx * rz + ry * rz;
        sum += factor / (rz * (z + lambda));
        factor *= 0.25;
        [x, y, z] = [x, y, z].map(|a| 0.25 * (a + lambda));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, FRAC_PI_4};

    fn close(a: f64, b: f64) {
        assert!((a - b).abs() <= 8.0 * f64::EPSILON * b.abs(), "{a} {b}"); // ~25 rounded operations in all
    }

    #[test]
    fn a_circle_has_arc_length_equal_to_the_angle() {
        close(second_kind(1.0, 0.0, 1.0), FRAC_PI_2);
        close(second_kind(FRAC_1_SQRT_2, FRAC_1_SQRT_2, 1.0), FRAC_PI_4);
    }

    #[test]
    fn the_complete_integral_has_its_tabulated_values() {
        // E(m) for m = 1/2 and 3/4, and E(−1) = √2 E(1/2) [Abramowitz–Stegun, table 17.1]
        close(second_kind(1.0, 0.0, 0.5), 1.350_643_881_047_675_5);
        close(second_kind(1.0, 0.0, 0.25), 1.211_056_027_568_459_5);
        close(second_kind(1.0, 0.0, 2.0), core::f64::consts::SQRT_2 * 1.350_643_881_047_675_5);
    }

    #[test]
    fn a_needle_has_the_length_of_its_axis() {
        // E(m) = 1 + (q/2)(ln(4/√q) − ½) + O(q² ln q), q = 1 − m
        let q: f64 = 1e-12;
        close(second_kind(1.0, 0.0, q), 1.0 + 0.5 * q * (libm::log(4.0 / q.sqrt()) - 0.5));
    }
}
