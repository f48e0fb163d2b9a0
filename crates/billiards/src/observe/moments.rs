//! The mean of a sample and its standard error.
use crate::merge::Merge;

/// A sample of independent numbers, of which the mean and the scatter about it are kept.
///
/// Each number `x` moves the mean `m` of the `n` so far by `(x − m)/n`, and the sum of squares about it grows by
/// `(x − m)(x − m′)`; two samples merge by `m = m₁ + d n₂/n`, `s = s₁ + s₂ + d² n₁n₂/n` with `d = m₂ − m₁`. Nothing large
/// cancels, however small the scatter is beside the mean. Source: Welford, Technometrics 4 (1962) 419; Chan et al.,
/// Stanford report STAN-CS-79-773 (1979).
///
/// ```
/// use billiards::observe::Moments;
///
/// let near: Moments = [1e9, 1e9 + 1.0, 1e9 + 2.0].into_iter().collect();
/// assert_eq!((near.mean().mean, near.mean().standard_error), (1e9 + 1.0, (1.0_f64 / 3.0).sqrt()));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moments {
    count: u64,
    mean: f64,
    /// Sum of squares about the mean.
    squares: f64,
    /// Whether any number was off the mean, however small the square of that is.
    scattered: bool,
}

/// A mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mean {
    /// Of how many numbers.
    pub count: u64,
    /// The mean; NaN for an empty sample.
    pub mean: f64,
    /// Its standard error, if the numbers are independent of one another; NaN for fewer than two numbers, and if the squares of all their
    /// deviations are too small for a number.
    pub standard_error: f64,
}

impl Moments {
    /// Adds a number.
    #[inline]
    pub fn add(&mut self, x: f64) {
        self.count += 1;
        let off = x - self.mean;
        self.mean += off / self.count as f64;
        self.squares += off * (x - self.mean);
        self.scattered |= self.count > 1 && off != 0.0;
    }

    /// The mean.
    pub fn mean(&self) -> Mean {
        let n = self.count as f64;
        let mean = if self.count == 0 { f64::NAN } else { self.mean };
        let lost = self.scattered && self.squares < f64::MIN_POSITIVE;
        let squares = if lost { f64::NAN } else { self.squares };
        Mean { count: self.count, mean, standard_error: libm::sqrt(squares / (n - 1.0) / n) }
    }
}

impl FromIterator<f64> for Moments {
    fn from_iter<I: IntoIterator<Item = f64>>(sample: I) -> Self {
        let mut moments = Moments::default();
        sample.into_iter().for_each(|x| moments.add(x));
        moments
    }
}

impl Merge for Moments {
    fn merge(self, other: Self) -> Self {
        // an empty sample has no mean, from which the others could be far off
        if self.count == 0 || other.count == 0 {
            return if self.count == 0 { other } else { self };
        }
        let count = self.count + other.count;
        let share = other.count as f64 / count as f64;
        let off = other.mean - self.mean;
        Moments {
            count,
            mean: self.mean + off * share,
            squares: self.squares + other.squares + off * off * (self.count as f64 * share),
            scattered: self.scattered || other.scattered || off != 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scatter_small_beside_the_mean_is_not_lost() {
        // ±2⁻²⁸ about 2: the square of the mean has no digit of the variance
        let off = 1.0 / f64::from(1 << 28);
        let sample = |n: u32| (0..n).map(|k| 2.0 + if k % 2 == 0 { off } else { -off }).collect::<Moments>();
        let whole = sample(1000).mean();
        assert!((whole.mean - 2.0).abs() < 1e-15);
        let exact = off / 999.0_f64.sqrt();
        assert!((whole.standard_error / exact - 1.0).abs() < 1e-6, "{whole:?}");
        let merged = sample(300).merge(sample(700)).mean();
        assert_eq!(merged.count, 1000);
        assert!((merged.standard_error / exact - 1.0).abs() < 1e-6, "{merged:?}");
    }

    #[test]
    fn samples_apart_from_one_another_merge_as_if_they_were_one() {
        let [a, b, all] = [vec![1.0, 2.0, 4.0], vec![10.0, 13.0], vec![1.0, 2.0, 4.0, 10.0, 13.0]]
            .map(|sample| sample.into_iter().collect::<Moments>());
        for (merged, whole) in [(a.merge(b), all), (Moments::default().merge(a), a), (a.merge(Moments::default()), a)] {
            let (merged, whole) = (merged.mean(), whole.mean());
            assert_eq!(merged.count, whole.count);
            assert!((merged.mean - whole.mean).abs() < 1e-14);
            assert!((merged.standard_error - whole.standard_error).abs() < 1e-14);
        }
    }

    #[test]
    fn what_underflows_is_no_error_of_zero() {
        let near: Moments = [1e-200, 3e-200].into_iter().collect();
        let apart = Moments::from_iter([1e-200]).merge(Moments::from_iter([3e-200]));
        for lost in [near, apart, near.merge(near), Moments::default().merge(near)] {
            assert!(lost.mean().standard_error.is_nan(), "{lost:?}");
        }
        for same in [Moments::from_iter([1e-200; 3]), Moments::from_iter([0.1; 2]).merge(Moments::from_iter([0.1]))] {
            assert_eq!(same.mean().standard_error, 0.0, "{same:?}");
        }
    }

    #[test]
    fn an_empty_sample_changes_nothing_however_large_the_numbers_are() {
        let large = Moments::from_iter([1e200; 2]); // off a mean of 0 by more than squares go
        for merged in [large.merge(Moments::default()), Moments::default().merge(large)] {
            assert_eq!(merged.mean(), large.mean());
        }
    }

    #[test]
    fn what_overflows_is_no_error_of_zero() {
        let wild: Moments = [1e200, -1e200].into_iter().collect();
        assert!(!wild.mean().standard_error.is_finite());
        let nothing = Moments::default().mean();
        assert!(nothing.mean.is_nan() && nothing.standard_error.is_nan());
    }
}
