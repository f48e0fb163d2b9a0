//! Convex shapes, seen from outside only.
//!
//! parry projects points onto a convex shape of your own through its support map, by an iteration that is accurate for
//! points somewhat outside the shape, to 10⁻⁷ of the distance, but not at the surface (a third of the points on the
//! sides of a hexagon are projected to somewhere else) nor inside. So all queries are made from a stand-off outside,
//! and the answers are improved with the support map itself.
//!
//! A foot with its normal is a supporting plane: the shape lies behind it. A path that comes from outside is free up to
//! the plane, and one that starts inside leaves the shape before it; cutting with planes, each found from where the
//! last was crossed, converges quadratically to the first hit, from the safe side.
use super::distance::{Distance, Probe};
use nalgebra::{SMatrix, SVector};

/// A supporting plane: a point of the surface and the outward normal there.
#[derive(Clone, Copy, Debug)]
struct Plane<const N: usize> {
    foot: SVector<f64, N>,
    normal: SVector<f64, N>,
}

impl<const N: usize> Plane<N> {
    fn height(&self, y: &SVector<f64, N>) -> f64 {
        self.normal.dot(&(y - self.foot))
    }
}

/// The point of a smooth convex shape closest to `x`, from a rough normal there and the support map.
///
/// The foot is where the support point in direction `n` lies straight below `x`: the part of `x − s(n)` across `n`
/// vanishes. This is solved by Broyden's method, since the radii of curvature that determine the derivative are not
/// known. Over flat parts there is no such solution, and `None` is returned.
fn improved<const N: usize>(
    x: &SVector<f64, N>,
    normal: &SVector<f64, N>,
    support: impl Fn(&SVector<f64, N>) -> SVector<f64, N>,
) -> Option<SVector<f64, N>> {
    let off = |n: &SVector<f64, N>| {
        let s = support(n);
        let w = x - s;
        (w - n * n.dot(&w), s)
    };
    let mut n = *normal;
    let (mut residual, s) = off(&n);
    let size = x.norm() + s.norm();
    // on a sphere of radius |s| this would be exact without the factor of a half: a step that is too long is better
    // than a slow start
    let mut inverse = SMatrix::<f64, N, N>::identity() / ((x - s).norm() + 0.5 * s.norm());
    let mut best = (residual.norm(), s);
    for _ in 0..40 {
        let next = n + inverse * residual;
        let next = next / next.norm();
        let (there, point) = off(&next);
        if there.norm() < best.0 {
            best = (there.norm(), point);
        } else if best.0 <= 4.0 * f64::EPSILON * size {
            break;
        }
        let (step, change) = (next - n, residual - there);
        let image = inverse * change;
        let weight = step.dot(&image);
        if weight == 0.0 {
            break;
        }
        inverse += (step - image) * (step.transpose() * inverse) / weight;
        (n, residual) = (next, there);
    }
    (best.0 <= 16.0 * f64::EPSILON * size).then_some(best.1)
}

impl<const N: usize> Distance<N> {
    /// The supporting plane below a point outside.
    fn below(&self, above: &SVector<f64, N>) -> Option<Plane<N>> {
        let (foot, inside) = self.field.project(above);
        let w = above - foot;
        let distance = w.norm();
        (!inside && distance > 0.0).then(|| Plane { foot, normal: w / distance })
    }

    /// The greatest stand-off.
    fn off(&self) -> f64 {
        self.size / 8.0
    }

    /// The least stand-off from which a support-map projection can be trusted and a normal has nine digits.
    fn least_off(&self) -> f64 {
        1e-6 * self.size
    }

    /// The supporting plane nearest to a point on the surface or not far from it.
    fn plane(&self, y: &SVector<f64, N>) -> Option<Plane<N>> {
        let mut views = vec![];
        for i in 0..N {
            for sign in [-1.0, 1.0] {
                // not along an axis: flat walls often lie along one, and a point on the surface itself is useless as a
                // stand-off
                let mut direction = SVector::<f64, N>::zeros();
                direction[i] = sign;
                direction[(i + 1) % N] += 0.377 * sign;
                views.extend(self.below(&(y + direction * (2.0 * self.off()))));
            }
        }
        views.sort_by(|a, b| b.height(y).total_cmp(&a.height(y)));
        let mut best: Option<Plane<N>> = None;
        for view in views {
            if let Some(plane) = self.straight_below(y, view)
                && best.is_none_or(|b| plane.height(y) > b.height(y))
            {
                best = Some(plane);
            }
            // a plane that the point is not below is the highest; inside, each side of the shape may have one
            if best.is_some_and(|b| b.height(y) >= -4.0 * self.rounding) {
                break;
            }
        }
        best
    }

    /// The supporting plane whose foot lies straight below a point, found from another plane.
    fn straight_below(&self, y: &SVector<f64, N>, mut plane: Plane<N>) -> Option<Plane<N>> {
        let straight = |plane: &Plane<N>| {
            let below = y - plane.normal * plane.height(y);
            (below - plane.foot).norm() <= 4.0 * self.rounding
        };
        // approach, since from afar an edge hides its neighbourhood, until the foot lies straight below …
        let mut h = self.off();
        'nearer: while h > self.least_off() {
            for _ in 0..8 {
                plane = self.below(&(y + plane.normal * h))?;
                if straight(&plane) {
                    break 'nearer;
                }
            }
            h /= 8.0;
        }
        // … and move away again, since a normal is more accurate the longer it is
        while h < self.off() {
            h *= 8.0;
            match self.below(&(y + plane.normal * h)) {
                Some(better) if straight(&better) => plane = better,
                _ => break,
            }
        }
        Some(plane)
    }

    /// Distance, foot and outward normal, even where the field cannot be trusted at the surface.
    pub(crate) fn outer(&self, y: &SVector<f64, N>) -> (Probe<N>, SVector<f64, N>) {
        let (foot, inside) = self.field.project(y);
        let w = y - foot;
        let distance = w.norm();
        // from this distance on the difference of point and foot has lost no more than three digits
        let sure = 1e-3 * self.size;
        let signed = if inside { -distance } else { distance };
        let raw = (Probe { distance: signed, foot }, w / signed);
        if !inside && distance > sure {
            return raw;
        }
        match self.plane(y) {
            // the signed distance from a convex shape is the greatest height above any of its supporting planes
            Some(plane) if !inside || plane.height(y) >= -distance - 8.0 * self.rounding => {
                let height = plane.height(y);
                (Probe { distance: height, foot: y - plane.normal * height }, plane.normal)
            }
            _ => raw,
        }
    }

    /// The stand-off for the next cut, after a step of this length: about the distance of the next foot.
    fn cut_off(&self, step: f64) -> f64 {
        step.clamp(self.least_off(), self.off())
    }

    /// Where the path first meets the shape from outside.
    pub(crate) fn enters(
        &self,
        start: &SVector<f64, N>,
        along: &SVector<f64, N>,
        [from, to]: [f64; 2],
        rounding: f64,
    ) -> Option<f64> {
        let mut s = from;
        let (probe, normal) = self.outer(&(start + along * s));
        let mut plane = Plane { foot: probe.foot, normal };
        if probe.distance <= rounding {
            return (normal.dot(along) < 0.0).then_some(s);
        }
        for _ in 0..200 {
            let y = start + along * s;
            let slope = plane.normal.dot(along);
            let height = plane.height(&y);
            // above the plane and not descending: free for ever
            if slope >= 0.0 {
                return None;
            }
            let next = s - height / slope;
            if next > to {
                return None;
            }
            if next - s <= f64::EPSILON * (s + self.size) {
                return Some(next.max(s));
            }
            let h = self.cut_off(next - s);
            s = next;
            plane = self.below(&(start + along * s + plane.normal * h))?;
        }
        Some(s)
    }

    /// Where the path leaves the shape.
    pub(crate) fn leaves(&self, start: &SVector<f64, N>, along: &SVector<f64, N>, to: f64) -> Option<f64> {
        let mut s = to + self.size;
        let mut plane = self.below(&(start + along * s))?;
        for _ in 0..200 {
            let slope = plane.normal.dot(along);
            if slope <= 0.0 {
                break; // beside the shape
            }
            let next = s - plane.height(&(start + along * s)) / slope;
            if s - next <= f64::EPSILON * (s.abs() + self.size) {
                break;
            }
            let h = self.cut_off(s - next);
            s = next;
            plane = self.below(&(start + along * s + plane.normal * h))?;
        }
        Some(s.max(0.0))
    }
}

/// The foot and the inside test of parry's projection, improved where a support map is at hand.
pub(crate) fn projected<const N: usize>(
    x: &SVector<f64, N>,
    (foot, inside): (SVector<f64, N>, bool),
    support: Option<impl Fn(&SVector<f64, N>) -> SVector<f64, N>>,
) -> (SVector<f64, N>, bool) {
    let w = x - foot;
    let distance = w.norm();
    let better = match support {
        Some(support) if !inside && distance > 0.0 => improved(x, &(w / distance), support),
        _ => None,
    };
    // the method may end at the far side, where the support point also lies on the normal
    let better = better.filter(|s| (x - s).norm() <= distance * (1.0 + 1e-9));
    (better.unwrap_or(foot), inside)
}
