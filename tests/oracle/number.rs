//! Numbers with 200 bits, and vectors of two or three of them.
use dashu_float::{FBig, round::mode::HalfEven};

/// A number rounded to 200 bits after every operation.
pub(crate) type Big = FBig<HalfEven, 2>;
/// A vector of the plane, or of space.
pub(crate) type Vector<const N: usize = 2> = [Big; N];

const BITS: usize = 200;

/// The number `x`, exactly.
pub(crate) fn big(x: f64) -> Big {
    Big::try_from(x).expect("a finite number").with_precision(BITS).value()
}

/// The nearest `f64`.
pub(crate) fn small(x: &Big) -> f64 {
    x.to_f64().value()
}

pub(crate) fn vector<const N: usize>(x: [f64; N]) -> Vector<N> {
    x.map(big)
}
pub(crate) fn add<const N: usize>(a: &Vector<N>, b: &Vector<N>) -> Vector<N> {
    core::array::from_fn(|i| &a[i] + &b[i])
}
pub(crate) fn sub<const N: usize>(a: &Vector<N>, b: &Vector<N>) -> Vector<N> {
    core::array::from_fn(|i| &a[i] - &b[i])
}
pub(crate) fn scale<const N: usize>(a: &Vector<N>, by: &Big) -> Vector<N> {
    core::array::from_fn(|i| &a[i] * by)
}
pub(crate) fn dot<const N: usize>(a: &Vector<N>, b: &Vector<N>) -> Big {
    (1..N).fold(&a[0] * &b[0], |sum, i| sum + &a[i] * &b[i])
}
/// `a₁ b₂ − a₂ b₁`
pub(crate) fn cross(a: &Vector, b: &Vector) -> Big {
    &a[0] * &b[1] - &a[1] * &b[0]
}
/// `J a`, a quarter turn to the left.
pub(crate) fn left(a: &Vector) -> Vector {
    [-a[1].clone(), a[0].clone()]
}
/// `a × b` in space
pub(crate) fn vector_product(a: &Vector<3>, b: &Vector<3>) -> Vector<3> {
    core::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        &a[j] * &b[k] - &a[k] * &b[j]
    })
}
pub(crate) fn norm<const N: usize>(a: &Vector<N>) -> Big {
    root(&dot(a, a))
}
pub(crate) fn root(x: &Big) -> Big {
    if is_positive(x) { x.sqrt() } else { big(0.0) }
}
pub(crate) fn is_positive(x: &Big) -> bool {
    *x > Big::ZERO
}

/// `[cos x, sin x]`, by Taylor's series of an angle below 2⁻⁸ and eight doublings.
pub(crate) fn direction(x: f64) -> Vector {
    let part = big(x) / big(65536.0);
    let (mut term, mut sums) = (big(1.0), [big(0.0), big(0.0)]);
    for k in 0..60 {
        let sign = if k % 4 < 2 { big(1.0) } else { big(-1.0) };
        sums[k % 2] += &term * sign;
        term = term * &part / big(k as f64 + 1.0);
    }
    let [mut cos, mut sin] = sums;
    for _ in 0..16 {
        (cos, sin) = (&cos * &cos - &sin * &sin, big(2.0) * &sin * &cos);
    }
    [cos, sin]
}

/// Where a function that rises (or falls) from `a` to `b` changes its sign, to about 2⁻¹⁵⁰ of the bracket.
///
/// Regula falsi with the Illinois rule, and a bisection after every eighth step: the bracket shrinks for certain.
pub(crate) fn sign_change(f: impl Fn(&Big) -> Big, [mut a, mut b]: [Big; 2], [mut fa, mut fb]: [Big; 2]) -> Big {
    let rising = is_positive(&fb);
    let half = big(0.5);
    let enough = (&b - &a) * big(libm::ldexp(1.0, -150));
    let mut moved = None;
    for step in 1..2000 {
        if &b - &a <= enough {
            break;
        }
        let mut middle = (&a * &fb - &b * &fa) / (&fb - &fa);
        // a root that one end has nearly reached: step a little beyond it
        if step % 8 == 0 || !(middle > a && middle < b) {
            middle = (&a + &b) * &half;
        } else if &middle - &a < enough {
            middle = &a + &enough * &half;
        } else if &b - &middle < enough {
            middle = &b - &enough * &half;
        }
        let value = f(&middle);
        let right = is_positive(&value) == rising;
        if right {
            (b, fb) = (middle, value);
            if moved == Some(right) {
                fa *= &half;
            }
        } else {
            (a, fa) = (middle, value);
            if moved == Some(right) {
                fb *= &half;
            }
        }
        moved = Some(right);
    }
    (a + b) * half
}
