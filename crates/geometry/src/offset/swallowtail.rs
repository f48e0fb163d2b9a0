//! Where a parallel crosses itself behind two cusps that are close to one another.
//!
//! At a distance `R` slightly greater than the least radius of curvature, the parallel `x(s) = c(s) + R n(s)` runs backwards between two
//! cusps, at `s₀ ± h`, and the branches that lead to them cross: a swallowtail. Its derivative is `x′ = σ t` with `σ = 1 − κ R`, to leading
//! order `a ((s − s₀)² − h²)`, so that along the tangent at `s₀` it runs as `a ((s − s₀)³/3 − h² (s − s₀))`, and the branches cross at
//! `s₀ ± √3 h`. The tail behind the crossing is of length `a h³` and of width `κ a h⁴`; while the one is far above rounding, the other is
//! below, so that points of the parallel do not tell where its branches cross. The arc lengths of the base do.
use crate::{Piece, intersect::along};
use nalgebra::Vector2;

/// Cusps no farther apart than this fraction of the curve are close: by subdivision, crossings that close to cusps cannot be told from
/// touches.
const CLOSE: f64 = 1.0 / 33_554_432.0; // 2⁻²⁵

/// Most steps of Newton's method.
const STEPS: usize = 8;

/// The parallel of a curve at a distance.
#[derive(Clone, Copy)]
pub(super) struct ParallelOf<'a> {
    pub(super) base: &'a dyn Piece,
    pub(super) distance: f64,
}

/// Where it crosses itself.
pub(super) struct SelfCrossing {
    /// Arc lengths of the base, before the first cusp and behind the second one.
    pub(super) at: [f64; 2],
    pub(super) point: Vector2<f64>,
}

impl ParallelOf<'_> {
    /// Its point at an arc length of the base, and the unit tangent there.
    fn place(&self, s: f64) -> (Vector2<f64>, Vector2<f64>) {
        let foot = self.base.point_at(s);
        let normal = self.base.closest(&foot).normal;
        (foot + normal * self.distance, along(&normal))
    }

    /// Its point at an arc length of the base.
    pub(super) fn point(&self, s: f64) -> Vector2<f64> {
        self.place(s).0
    }

    /// `1 − κ R`: positive where it runs like the base.
    pub(super) fn stretch(&self, s: f64) -> f64 {
        1.0 - self.base.curvature(&self.base.point_at(s)) * self.distance
    }

    /// How far ahead of its point at `s` another point lies, in arc length of the base.
    pub(super) fn ahead(&self, s: f64, other: Vector2<f64>) -> f64 {
        let (point, tangent) = self.place(s);
        (other - point).dot(&tangent) / self.stretch(s)
    }

    /// Where it crosses itself behind two cusps between which it runs backwards, if these are close and not one point; given are the arc
    /// lengths of the base there. The second one is less than the first where the seam of a closed base lies between them.
    pub(super) fn tail(&self, [first, second]: [f64; 2], tolerance: f64) -> Option<SelfCrossing> {
        let length = self.base.length();
        let apart = (self.point(first) - self.point(second)).norm();
        if apart <= tolerance || apart > CLOSE * length {
            return None;
        }
        let backwards = if first < second { second - first } else { second + length - first };
        let reach = 0.5 * (libm::sqrt(3.0) - 1.0) * backwards;
        let mut at = [first - reach, second + reach];
        for _ in 0..STEPS {
            let [(p, t), (q, u)] = at.map(|s| self.place(s));
            let gap = q - p;
            if gap.norm() <= 0.25 * tolerance {
                return Some(SelfCrossing { at, point: (p + q) * 0.5 });
            }
            let sine = t.perp(&u);
            at[0] += gap.perp(&u) / (sine * self.stretch(at[0]));
            at[1] += gap.perp(&t) / (sine * self.stretch(at[1]));
        }
        None
    }
}
