//! Boxes with sides parallel to the axes.
use crate::plane::is_finite;
use nalgebra::{ArrayStorage, SVector};

/// A box with sides parallel to the axes; sides may lie at infinity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent<const N: usize = 2> {
    /// Least coordinates.
    pub min: SVector<f64, N>,
    /// Greatest coordinates.
    pub max: SVector<f64, N>,
}

impl<const N: usize> Extent<N> {
    /// The empty box, neutral in [`Extent::union`].
    pub const EMPTY: Extent<N> = Extent {
        min: SVector::from_array_storage(ArrayStorage([[f64::INFINITY; N]; 1])),
        max: SVector::from_array_storage(ArrayStorage([[f64::NEG_INFINITY; N]; 1])),
    };

    /// The whole space.
    pub(crate) const WHOLE: Extent<N> = Extent { min: Extent::EMPTY.max, max: Extent::EMPTY.min };

    /// The smallest box around some points.
    pub fn of(points: impl IntoIterator<Item = SVector<f64, N>>) -> Extent<N> {
        points.into_iter().fold(Extent::EMPTY, |e, p| Extent { min: e.min.inf(&p), max: e.max.sup(&p) })
    }

    /// The smallest box around both.
    #[must_use]
    pub fn union(self, other: Extent<N>) -> Extent<N> {
        Extent { min: self.min.inf(&other.min), max: self.max.sup(&other.max) }
    }

    /// Whether no side lies at infinity and the box is not empty.
    pub fn is_finite(&self) -> bool {
        is_finite(&self.min) && is_finite(&self.max)
    }

    /// Its corners.
    pub(crate) fn corners(&self) -> impl Iterator<Item = SVector<f64, N>> {
        (0..1 << N).map(|k: usize| SVector::from_fn(|i, _| if (k >> i) & 1 == 0 { self.min[i] } else { self.max[i] }))
    }

    /// A box larger by this length on all sides.
    pub(crate) fn grown(&self, by: f64) -> Extent<N> {
        Extent { min: self.min.add_scalar(-by), max: self.max.add_scalar(by) }
    }

    /// A point on the same side of everything in the box, moved so that along each axis it lies no farther from the box
    /// than the box is long (where the box has a length).
    pub(crate) fn beside(&self, point: &SVector<f64, N>) -> SVector<f64, N> {
        let size = (self.max - self.min).map(|length| if length > 0.0 { length } else { f64::INFINITY });
        point.sup(&(self.min - size)).inf(&(self.max + size))
    }

    /// Distance of a point from the box, 0 inside.
    pub(crate) fn distance(&self, point: &SVector<f64, N>) -> f64 {
        let gap = |i: usize| (self.min[i] - point[i]).max(point[i] - self.max[i]).max(0.0);
        (0..N).fold(0.0, |sum, i| libm::hypot(sum, gap(i)))
    }

    /// Whether the boxes have a point in common, or are no farther apart than `reach` along each axis.
    pub(crate) fn meets(&self, other: &Extent<N>, reach: f64) -> bool {
        (0..N).all(|i| self.min[i] <= other.max[i] + reach && other.min[i] <= self.max[i] + reach)
    }

    /// Whether the whole box lies behind a point, looking in some direction.
    pub(crate) fn is_behind(&self, point: &SVector<f64, N>, direction: &SVector<f64, N>) -> bool {
        let ahead = |i: usize| if direction[i] > 0.0 { self.max[i] } else { self.min[i] };
        (0..N).map(|i| direction[i] * (point[i] - ahead(i))).sum::<f64>() > 0.0
    }

    /// Greatest absolute value of the finite coordinates.
    pub(crate) fn size(&self) -> f64 {
        self.min.iter().chain(self.max.iter()).filter(|x| x.is_finite()).fold(0.0, |m: f64, x| m.max(x.abs()))
    }
}
