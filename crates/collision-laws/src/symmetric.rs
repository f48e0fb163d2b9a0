//! Symmetric matrices of any fixed size, and their eigenvectors, by Jacobi's rotations.
//!
//! nalgebra's own decomposition does not compile for a generic N; this one also computes small eigenvalues of positive
//! matrices to more digits, and uses only + − × ÷ √.

use nalgebra::{SMatrix, SVector};

/// Sweeps converge quadratically: 5 or 6 suffice for random matrices of N = 5; the bound only guards against NaN.
const MOST_SWEEPS: usize = 40;

/// `(a + aᵀ)/2`, exactly symmetric; halved first: the sum may overflow.
pub(crate) fn symmetric_part<const N: usize>(a: &SMatrix<f64, N, N>) -> SMatrix<f64, N, N> {
    a * 0.5 + a.transpose() * 0.5
}

/// The eigenvalues of a symmetric matrix, and its eigenvectors as the columns of an orthogonal matrix.
pub(crate) fn eigenframe<const N: usize>(mut a: SMatrix<f64, N, N>) -> (SVector<f64, N>, SMatrix<f64, N, N>) {
    let mut frame = SMatrix::identity();
    for _ in 0..MOST_SWEEPS {
        let mut rotated = false;
        for p in 0..N {
            for q in p + 1..N {
                let off = a[(p, q)];
                if off.abs() <= 0.25 * f64::EPSILON * a[(p, p)].abs().sqrt() * a[(q, q)].abs().sqrt() {
                    a[(p, q)] = 0.0;
                    a[(q, p)] = 0.0;
                    continue;
                }
                rotated = true;
                rotate(&mut a, &mut frame, p, q);
            }
        }
        if !rotated {
            break;
        }
    }
    (a.diagonal(), frame)
}

/// The rotation in the plane of axes p and q that makes `a[(p, q)]` zero.
fn rotate<const N: usize>(a: &mut SMatrix<f64, N, N>, frame: &mut SMatrix<f64, N, N>, p: usize, q: usize) {
    let off = a[(p, q)];
    let cot = (a[(q, q)] - a[(p, p)]) / (2.0 * off); // of twice the angle
    let t = 1.0_f64.copysign(cot) / (cot.abs() + (cot * cot + 1.0).sqrt());
    let c = 1.0 / (t * t + 1.0).sqrt();
    let s = t * c;
    a[(p, p)] -= t * off;
    a[(q, q)] += t * off;
    a[(p, q)] = 0.0;
    a[(q, p)] = 0.0;
    for i in 0..N {
        if i != p && i != q {
            let (x, y) = (a[(i, p)], a[(i, q)]);
            (a[(i, p)], a[(i, q)]) = (c * x - s * y, s * x + c * y);
            (a[(p, i)], a[(q, i)]) = (a[(i, p)], a[(i, q)]);
        }
        let (x, y) = (frame[(i, p)], frame[(i, q)]);
        (frame[(i, p)], frame[(i, q)]) = (c * x - s * y, s * x + c * y);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    #[test]
    fn the_frame_diagonalises_and_is_orthogonal() {
        let b = SMatrix::<f64, 5, 5>::from_fn(|i, j| ((3 * i * i + 5 * j) % 7) as f64 - 2.5);
        let a = b * b.transpose();
        let (values, frame) = eigenframe(a);
        // a few roundings per entry and sweep
        assert_abs_diff_eq!(frame.transpose() * frame, SMatrix::identity(), epsilon = 1e-14);
        assert_abs_diff_eq!(frame * SMatrix::from_diagonal(&values) * frame.transpose(), a, epsilon = 1e-14 * a.amax());
    }
}
