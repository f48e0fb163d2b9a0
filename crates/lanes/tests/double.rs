//! Error-free sums and products and double-doubles, against numbers that are never rounded.
use dashu_float::{FBig, round::mode::HalfEven};
use lanes::{Double, two_prod, two_sum};
use proptest::prelude::*;

/// A number with as many digits as it needs; sums and products are exact.
type Exact = FBig<HalfEven, 2>;

fn exact(x: f64) -> Exact {
    Exact::try_from(x).expect("a finite number").with_precision(0).value()
}

fn number(x: Double) -> Exact {
    exact(x.high) + exact(x.low)
}

fn size(x: &Exact) -> Exact {
    if *x < Exact::ZERO { -x.clone() } else { x.clone() }
}

/// Whether `|a − b| ≤ 2ᵏ |scale|`.
fn within(k: i32, a: &Exact, b: &Exact, scale: &Exact) -> bool {
    size(&(a - b)) <= size(scale) * exact(libm::ldexp(1.0, k))
}

/// Numbers between 1 and 2, and their opposites: with random digits, with few, and with long runs of equal ones.
fn significand() -> impl Strategy<Value = f64> {
    let few = (any::<u64>(), 0..53_u32).prop_map(|(digits, from)| digits & (u64::MAX << from));
    let runs = (any::<u64>(), 0..53_u32).prop_map(|(digits, from)| digits | ((1 << from) - 1));
    let digits = prop_oneof![any::<u64>(), few, runs];
    (digits, any::<bool>()).prop_map(|(digits, minus)| {
        let size = 1.0 + (digits & ((1 << 52) - 1)) as f64 * f64::EPSILON;
        if minus { -size } else { size }
    })
}

/// Numbers with exponents in a range.
fn of_size(exponents: core::ops::Range<i32>) -> impl Strategy<Value = f64> {
    (significand(), exponents).prop_map(|(x, exponent)| libm::ldexp(x, exponent))
}

/// A double-double with about this high part; the low one is up to half an ulp of it, or much smaller.
fn double(high: f64) -> impl Strategy<Value = Double> {
    let half_ulp = {
        let (_, exponent) = libm::frexp(high);
        libm::ldexp(1.0, exponent - 54)
    };
    prop_oneof![
        4 => of_size(-1..0),
        4 => of_size(-60..0),
        1 => Just(0.0),
        1 => Just(1.0),
    ]
    .prop_map(move |part| {
        let (high, low) = two_sum(high, half_ulp * part);
        Double { high, low }
    })
}

fn double_of_size(exponents: core::ops::Range<i32>) -> impl Strategy<Value = Double> {
    of_size(exponents).prop_flat_map(double)
}

/// Two factors below 2⁹⁹⁶ whose product is between 2⁻⁹⁶⁹ and 2¹⁰²³.
fn factors() -> impl Strategy<Value = [f64; 2]> {
    let sizes = (-969..1021_i32).prop_flat_map(|both| {
        let first = (both - 995).max(-995)..(both + 996).min(996);
        (first, Just(both)).prop_map(|(first, both)| [first, both - first])
    });
    (sizes, significand(), significand()).prop_map(|(sizes, a, b)| [libm::ldexp(a, sizes[0]), libm::ldexp(b, sizes[1])])
}

fn double_factors() -> impl Strategy<Value = [Double; 2]> {
    factors().prop_flat_map(|[a, b]| (double(a), double(b)).prop_map(|(a, b)| [a, b]))
}

/// Two terms: of all sizes, of similar size, and almost opposite ones.
fn terms() -> impl Strategy<Value = [Double; 2]> {
    let similar = (of_size(-1000..1000), significand(), -110..110_i32)
        .prop_map(|(a, b, apart)| [a, libm::ldexp(b, (libm::ilogb(a) + apart).clamp(-1000, 1000))]);
    let opposite = (of_size(-900..1000), -4..5_i32, 0..53_i32)
        .prop_map(|(a, k, digit)| [a, -a * (1.0 + f64::from(k) * libm::ldexp(f64::EPSILON, digit.min(48)))]);
    prop_oneof![[of_size(-1000..1000), of_size(-1000..1000)], similar, opposite]
        .prop_flat_map(|[a, b]| (double(a), double(b)).prop_map(|(a, b)| [a, b]))
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(10_000) })]

    #[test]
    fn a_sum_and_its_error_are_exact(a in of_size(-1074..1023), b in of_size(-1074..1023)) {
        let (sum, error) = two_sum(a, b);
        prop_assert_eq!(exact(sum) + exact(error), exact(a) + exact(b));
    }

    #[test]
    fn a_product_and_its_error_are_exact_in_all_of_the_range([a, b] in factors()) {
        prop_assert!(a.abs().max(b.abs()) < libm::ldexp(1.0, 996));
        let (product, error) = two_prod(a, b);
        prop_assert_eq!(exact(product) + exact(error), exact(a) * exact(b));
        prop_assert_eq!(Double::product(a, b), Double { high: product, low: error });
    }

    #[test]
    fn an_addition_is_right_to_105_bits([a, b] in terms()) {
        let mut sum = a;
        sum.add(b.high);
        let expected = number(a) + exact(b.high);
        prop_assert!(within(-105, &number(sum), &expected, &expected), "{a:?} + {b:?} = {sum:?}");
    }

    #[test]
    fn sums_are_right_to_103_bits_however_much_cancels([a, b] in terms()) {
        let sum = a.plus(b);
        let expected = number(a) + number(b);
        prop_assert!(within(-103, &number(sum), &expected, &expected), "{a:?} + {b:?} = {sum:?}");
    }

    #[test]
    fn products_are_right_to_103_bits([a, b] in double_factors()) {
        let product = a.times(b);
        let expected = number(a) * number(b);
        prop_assert!(within(-103, &number(product), &expected, &expected), "{a:?} · {b:?} = {product:?}");
    }

    #[test]
    fn quotients_are_right_to_102_bits([a, b] in double_factors()) {
        let [quotient, divisor] = if a.high.abs() < libm::ldexp(1.0, -968) { [b, a] } else { [a, b] };
        let dividend = quotient.times(divisor);
        let quotient = dividend.over(divisor);
        // q = (1 + e) x/y where q y − x = e x
        let (back, whole) = (number(quotient) * number(divisor), number(dividend));
        prop_assert!(within(-102, &back, &whole, &whole), "{dividend:?} / {divisor:?} = {quotient:?}");
    }

    #[test]
    fn roots_are_right_to_103_bits(x in double_of_size(-968..1022)) {
        let square = if x.high < 0.0 { -x } else { x };
        let root = square.root();
        // r = (1 + e) √x where r² − x = (2 e + e²) x
        let (back, whole) = (number(root) * number(root), number(square));
        prop_assert!(within(-102, &back, &whole, &whole), "√{square:?} = {root:?}");
    }
}

#[test]
fn beyond_the_range_of_products_their_error_is_lost() {
    let power = |k: i32| libm::ldexp(1.0, k);
    assert!(two_prod(power(1000), power(-1000)).1.is_nan());
    // of the smallest product in the range, and of the next one below it, ulp times ulp
    let (a, b) = (1.0 + f64::EPSILON, power(-970) * (1.0 + f64::EPSILON));
    assert_eq!(two_prod(a, b).1, power(-1074));
    assert_eq!(two_prod(a, 0.5 * b).1, 0.0);
    assert_eq!(two_prod(0.0, power(900)), (0.0, 0.0));
}
