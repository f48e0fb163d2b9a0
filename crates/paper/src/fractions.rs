//! Fractions in lowest terms.

/// The `p` with `0 ≤ p/q ≤ 1/2` in lowest terms, in rising order.
pub fn reduced_numerators(q: u32) -> impl Iterator<Item = u32> {
    (0..=q / 2).filter(move |p| gcd(*p, q) == 1)
}

fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}
