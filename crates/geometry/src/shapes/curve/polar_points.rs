//! A curve about a centre, given by its points.
use super::{Interval, Parametric, ParametricFormula, PolarFormula};
use nalgebra::Vector2;

/// The points `c(φ) = m + r(φ) (cos φ, sin φ)` of a formula for the radius about `m`, which may reach 0, unlike that of a
/// [`Polar`](super::Polar): cardioids and roses are [`ParametricCurve`](super::ParametricCurve)s of this kind.
///
/// ```
/// use geometry::{Piece, Vector2, shapes::curve::{Interval, ParametricCurve, PolarFormula, PolarPoints}};
///
/// /// `r = 1 + cos φ`
/// #[derive(Debug)]
/// struct Cardioid;
/// impl PolarFormula for Cardioid {
///     fn jet(&self, angle: f64) -> [f64; 3] {
///         let (sin, cos) = libm::sincos(angle);
///         [1.0 + cos, -sin, -cos]
///     }
///     fn jet_over(&self, angle: Interval) -> [Interval; 3] {
///         let [sin, cos] = angle.sin_cos();
///         [cos + 1.0, -sin, -cos]
///     }
/// }
/// let points = PolarPoints { center: Vector2::new(0.5, 0.0), formula: Cardioid };
/// let pieces = ParametricCurve::around(points, [0.0, 2.0 * core::f64::consts::PI], true)?;
/// assert!((pieces.iter().map(|piece| piece.length()).sum::<f64>() - 8.0).abs() < 1e-14);
/// # Ok::<(), geometry::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct PolarPoints<F> {
    /// The centre `m` \[L\].
    pub center: Vector2<f64>,
    /// The radius `r(φ)`.
    pub formula: F,
}

impl<F: PolarFormula> Parametric for PolarPoints<F> {
    fn at(&self, angle: f64) -> [Vector2<f64>; 2] {
        let [c, first, _] = ParametricFormula::jet(self, angle);
        [c.into(), first.into()]
    }
}

impl<F: PolarFormula> ParametricFormula for PolarPoints<F> {
    fn jet(&self, angle: f64) -> [[f64; 2]; 3] {
        let [r, slope, second] = self.formula.jet(angle);
        let (sin, cos) = libm::sincos(angle);
        // c″ = (r″ − r) e + 2 r′ e′
        let (along, across) = (second - r, 2.0 * slope);
        [
            [self.center.x + r * cos, self.center.y + r * sin],
            [slope * cos - r * sin, slope * sin + r * cos],
            [along * cos - across * sin, along * sin + across * cos],
        ]
    }

    fn jet_over(&self, angle: Interval) -> [[Interval; 2]; 3] {
        let [r, slope, second] = self.formula.jet_over(angle);
        let [sin, cos] = angle.sin_cos();
        let (along, across) = (second - r, slope * 2.0);
        [
            [r * cos + self.center.x, r * sin + self.center.y],
            [slope * cos - r * sin, slope * sin + r * cos],
            [along * cos - across * sin, along * sin + across * cos],
        ]
    }
}
