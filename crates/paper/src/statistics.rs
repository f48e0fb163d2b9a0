//! Ranges, worst cases and errors of shares.

/// The standard error of a share `p` of `n` independent samples.
pub(crate) fn standard_error_of_share(p: f64, n: usize) -> f64 {
    libm::sqrt(p * (1.0 - p) / n as f64)
}

/// `max − min`, growing as numbers come in.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Range {
    pub(crate) min: f64,
    pub(crate) max: f64,
}

impl Range {
    pub(crate) const EMPTY: Range = Range { min: f64::INFINITY, max: f64::NEG_INFINITY };

    pub(crate) fn add(&mut self, x: f64) {
        self.min = self.min.min(x);
        self.max = self.max.max(x);
    }

    pub(crate) fn width(&self) -> f64 {
        self.max - self.min
    }
}

impl FromIterator<f64> for Range {
    fn from_iter<I: IntoIterator<Item = f64>>(numbers: I) -> Range {
        let mut range = Range::EMPTY;
        numbers.into_iter().for_each(|x| range.add(x));
        range
    }
}

/// The largest of some numbers that are not negative; NaN if one is.
pub(crate) fn worst(numbers: impl IntoIterator<Item = f64>) -> f64 {
    numbers.into_iter().fold(0.0, |m: f64, x| if x > m || x.is_nan() { x } else { m })
}
