//! A point from which walls are seen.
use lanes::Lane;

/// Coordinates from a point \[L\], as often as not the origin itself.
///
/// There, nothing is subtracted: an orbit would wait for it twice a flight, 4 cycles each, and of orbits side by side every vector would
/// take four operations in place of two predicted branches. The bits are the same.
#[derive(Clone, Copy, Debug)]
pub(super) struct Origin<const N: usize> {
    at: [f64; N],
    /// What is added on the way back: adding −0 changes no number, while 0 would make 0 of −0.
    back: [f64; N],
    is_zero: bool,
}

impl<const N: usize> Origin<N> {
    pub(super) fn new(at: [f64; N]) -> Self {
        let unsigned = at.map(|c| c + 0.0);
        let back = unsigned.map(|c| if c == 0.0 { -0.0 } else { c });
        Origin { at: unsigned, back, is_zero: unsigned == [0.0; N] }
    }

    /// A point as it is seen from there.
    #[inline(always)]
    pub(super) fn sees<F: Lane>(&self, x: &[F; N]) -> [F; N] {
        let mut y = *x;
        if self.is_zero {
            // keeps the compiler from turning the branch into a selection
            core::hint::black_box(());
        } else {
            for i in 0..N {
                y[i] = y[i] - self.at[i];
            }
        }
        y
    }

    /// The point that is seen so from there.
    #[inline(always)]
    pub(super) fn seen<F: Lane>(&self, y: &[F; N]) -> [F; N] {
        let mut x = *y;
        if self.is_zero {
            core::hint::black_box(());
        } else {
            for i in 0..N {
                x[i] = x[i] + self.back[i];
            }
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lanes::Twin;

    #[test]
    fn one_lane_and_several_see_the_same_bits() {
        let zero = Twin::of(0.0_f64);
        for at in [[0.0, 0.0], [-0.0, 0.0], [0.0, 0.3], [1.7, -0.3]] {
            let origin = Origin::new(at);
            for x in [[0.0, -0.0], [-0.0, -0.0], [0.1, 0.3], [-5e-324, 1e300], [f64::INFINITY, 2.0]] {
                let alone = origin.sees(&x);
                let back = origin.seen(&alone);
                let many = x.map(|x| zero.same(x));
                let seen = origin.sees(&many);
                let returned = origin.seen(&seen);
                for i in 0..2 {
                    assert_eq!(alone[i].to_bits(), seen[i].lane(1).to_bits(), "{at:?} {x:?}");
                    assert_eq!(back[i].to_bits(), returned[i].lane(1).to_bits(), "{at:?} {x:?}");
                    assert!(at[i] != 0.0 || alone[i].to_bits() == x[i].to_bits());
                }
            }
        }
    }
}
