//! Reproducible pseudo-random numbers, for trials and tests.

/// Numbers in [0, 1), in steps of 2⁻⁵³: the upper bits of a linear congruential generator.
pub(crate) fn uniform(mut state: u64) -> impl FnMut() -> f64 {
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Numbers in [−1, 1).
#[cfg(test)]
pub(crate) fn signed(seed: u64) -> impl FnMut() -> f64 {
    let mut uniform = uniform(seed);
    move || 2.0 * uniform() - 1.0
}
