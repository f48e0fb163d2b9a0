//! Ranges, worst cases and errors of shares.

/// The standard error of a share `p` of `n` independent samples.
pub(crate) fn standard_error_of_share(p: f64, n: usize) -> f64 {
    libm::sqrt(p * (1.0 - p) / n as f64)
}

/// The least and the greatest of some numbers, as they come in; NaN if one is, or if there is none.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Range {
    pub(crate) min: f64,
    pub(crate) max: f64,
    empty: bool,
}

impl Range {
    pub(crate) const EMPTY: Range = Range { min: f64::NAN, max: f64::NAN, empty: true };

    pub(crate) fn add(&mut self, x: f64) {
        if self.empty || x.is_nan() {
            *self = Range { min: x, max: x, empty: false };
        } else if x < self.min {
            self.min = x;
        } else if x > self.max {
            self.max = x;
        }
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

/// The largest of some numbers; NaN if one is, or if there is none.
pub(crate) fn worst(numbers: impl IntoIterator<Item = f64>) -> f64 {
    numbers.into_iter().collect::<Range>().max
}

/// The least of some numbers; NaN if one is, or if there is none.
pub(crate) fn least(numbers: impl IntoIterator<Item = f64>) -> f64 {
    numbers.into_iter().collect::<Range>().min
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extremes_are_those_of_all_numbers() {
        assert_eq!((least([2.0, -1.0, 0.5]), worst([2.0, -1.0, 0.5])), (-1.0, 2.0));
    }

    #[test]
    fn nothing_and_nan_have_no_extremes() {
        for numbers in [&[][..], &[f64::NAN, 1.0, 2.0], &[1.0, f64::NAN, 2.0], &[1.0, 2.0, f64::NAN]] {
            let numbers = || numbers.iter().copied();
            assert!(least(numbers()).is_nan() && worst(numbers()).is_nan());
            assert!(numbers().collect::<Range>().width().is_nan());
        }
    }
}
