//! Starts so far from the walls that rounding decides what they hit.

use billiards::geometry::{Extent, SVector};

/// A box around all bounded walls, given a box around each wall; `None` if there are none.
pub(crate) fn bounded<const N: usize>(walls: impl IntoIterator<Item = Extent<N>>) -> Option<Extent<N>> {
    walls.into_iter().filter(Extent::is_finite).reduce(Extent::union)
}

/// A start for which double precision leaves it open where, if at all, its path hits the bounded walls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Remote {
    /// The distance between numbers of the size of its coordinates \[L\].
    pub(crate) spacing: f64,
    /// The size of all bounded walls together \[L\], which is no larger.
    pub(crate) size: f64,
}

impl Remote {
    /// The path from `point` with a velocity, if it leads towards the `bounded` walls from so far away, and does not miss them by more
    /// than rounding.
    pub(crate) fn of<const N: usize>(
        point: &SVector<f64, N>,
        velocity: &SVector<f64, N>,
        bounded: &Extent<N>,
    ) -> Option<Remote> {
        // as many digits as a double has
        let spacing = libm::ldexp(1.0, libm::frexp(point.amax()).1 - 53);
        let size = (bounded.max - bounded.min).amax();
        if spacing < size {
            return None;
        }
        let away = point - (bounded.min * 0.5 + bounded.max * 0.5);
        let along = velocity / velocity.norm();
        let ahead = -away.dot(&along);
        let aside = away + along * ahead;
        // a direction is rounded, and so are these products
        (ahead > 0.0 && aside.amax() <= 8.0 * spacing).then_some(Remote { spacing, size })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use billiards::geometry::Vector2;

    #[test]
    fn a_start_is_remote_where_its_rounding_exceeds_the_walls_ahead_at_any_scale() {
        let unit = Extent { min: Vector2::new(-1.0, -1.0), max: Vector2::new(1.0, 1.0) };
        for scale in [1.0, libm::ldexp(1.0, -400), libm::ldexp(1.0, 400)] {
            let walls = Extent { min: unit.min * scale, max: unit.max * scale };
            let is_remote =
                |x: [f64; 2], v: [f64; 2]| Remote::of(&(Vector2::from(x) * scale), &v.into(), &walls).is_some();
            for far in [2e16, 1e17, 1e30, 1e120] {
                assert!(
                    is_remote([far, 0.25], [-1.0, 0.0]) && is_remote([-0.6 * far, 0.8 * far], [3.0, -4.0]),
                    "{far:e}"
                );
                // past the walls, and away from them
                assert!(!is_remote([far, 0.25], [-1.0, 1.0]) && !is_remote([far, 0.25], [1.0, 0.0]), "{far:e}");
            }
            assert!(!is_remote([9e15, 0.25], [-1.0, 0.0]) && !is_remote([0.0, 0.0], [1.0, 0.0]));
        }
    }
}
