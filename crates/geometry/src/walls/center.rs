//! The centre from which walls are seen.
use lanes::Lane;

/// The coordinates of a centre \[L\], often the origin.
///
/// For the origin nothing is subtracted: a single orbit would wait for that twice a flight, 4 cycles each, and for orbits side by side
/// every vector would take four operations in place of two predicted branches.
#[derive(Clone, Copy, Debug)]
pub(super) struct Center<const N: usize> {
    there: [f64; N],
    back: [f64; N],
    is_origin: bool,
}

impl<const N: usize> Center<N> {
    pub(super) fn new(at: [f64; N]) -> Self {
        Center { there: at.map(|c| -c), back: at, is_origin: at == [0.0; N] }
    }

    /// A point relative to the centre.
    #[inline(always)]
    pub(super) fn sees<F: Lane>(&self, x: &[F; N]) -> [F; N] {
        self.moved(x, &self.there)
    }

    /// The point with these coordinates relative to the centre.
    #[inline(always)]
    pub(super) fn seen<F: Lane>(&self, y: &[F; N]) -> [F; N] {
        self.moved(y, &self.back)
    }

    #[inline(always)]
    fn moved<F: Lane>(&self, x: &[F; N], by: &[f64; N]) -> [F; N] {
        let mut y = *x;
        if self.is_origin {
            // keeps the compiler from turning the branch into a selection
            core::hint::black_box(());
        } else {
            for i in 0..N {
                y[i] = y[i] + by[i];
            }
        }
        y
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_origin_changes_no_bit_and_another_centre_is_subtracted_and_added() {
        for at in [[0.0, 0.0], [-0.0, 0.0], [0.0, 0.3], [1.7, -0.3]] {
            let center = Center::new(at);
            for x in [[0.0, -0.0], [-0.0, -0.0], [0.1, 0.3], [-5e-324, 1e300], [f64::INFINITY, 2.0]] {
                let (seen, back) = (center.sees(&x), center.seen(&x));
                for i in 0..2 {
                    let expected = if at == [0.0; 2] { [x[i]; 2] } else { [x[i] - at[i], x[i] + at[i]] };
                    assert_eq!([seen[i], back[i]].map(f64::to_bits), expected.map(f64::to_bits), "{at:?} {x:?}");
                }
            }
        }
    }
}
