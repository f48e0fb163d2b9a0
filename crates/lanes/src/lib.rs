//! One kernel, written once, for one orbit or for many side by side.
//!
//! A [`Lane`] behaves like a real number. It is either an `f64`, one orbit, or a [`Wide`], as many orbits as the
//! vector registers of this CPU hold. A kernel that is generic over `F: Lane` reads like the formula it computes,
//! has no branches on its data (it [`select`](Mask::select)s), and gives the **same bits** in every lane width:
//! + − × ÷ √ are correctly rounded everywhere and nothing here fuses a multiplication with an addition.
//!
//! ```
//! use lanes::{Lane, Mask};
//! /// The time at which a point at height `y` with velocity `v` is at height 0, or infinity if it moves upwards.
//! fn fall<F: Lane>(y: F, v: F) -> F {
//!     v.lt(y.same(0.0)).select(-y / v, y.same(f64::INFINITY))
//! }
//! assert_eq!(fall(3.0, -2.0), 1.5);
//! assert_eq!(fall(3.0, 2.0), f64::INFINITY);
//! ```
//!
//! The instruction set is chosen at run time ([`dispatch`]): AVX-512, AVX2, NEON and so on, or plain `f64`s where none is known.
#![cfg_attr(not(test), warn(clippy::unwrap_used, clippy::print_stdout))]

mod double;
mod rows;
mod scalar;
mod twin;
mod wide;

pub use double::{Double, two_prod, two_sum};
pub use rows::Rows;
pub use twin::{Twin, TwinMask};
pub use wide::{Wide, WideMask, dispatch, instruction_set, vectorized};

use core::fmt::Debug;
use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// The largest number of lanes of any kernel: two vectors of the widest instruction set.
pub const MOST_LANES: usize = 16;

/// `3·2⁵¹`, whose last bit is worth 1: `x + WHOLE − WHOLE` is the whole number nearest to `x`, for `|x| < 2⁵¹`.
///
/// ```
/// assert_eq!([2.5, 3.5, -1.2].map(|x| x + lanes::WHOLE - lanes::WHOLE), [2.0, 4.0, -1.0]);
/// ```
pub const WHOLE: f64 = 6_755_399_441_055_744.0;

/// The lanes of several numbers: what is computed one lane after another reads here, and its results are loaded from there.
#[must_use]
#[inline(always)]
pub fn stored<F: Lane, const K: usize>(numbers: &[F; K]) -> [[f64; MOST_LANES]; K] {
    let mut lanes = [[0.0; MOST_LANES]; K];
    for (to, number) in lanes.iter_mut().zip(numbers) {
        number.store(to);
    }
    lanes
}

/// `a · b`, summed in order.
#[inline(always)]
pub fn dot<F: Lane, const N: usize>(a: &[F; N], b: &[F; N]) -> F {
    let mut sum = a[0] * b[0];
    for i in 1..N {
        sum = sum + a[i] * b[i];
    }
    sum
}

/// A real number per lane, rounded to `f64` after every operation.
pub trait Lane:
    Copy
    + Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
{
    /// A truth value per lane.
    type Mask: Mask<Self>;
    /// How many numbers stand side by side.
    const LANES: usize;

    /// The constant `a` in as many lanes as `self` has.
    #[must_use]
    fn same(self, a: f64) -> Self;
    /// `√self`, correctly rounded; NaN below zero.
    #[must_use]
    fn sqrt(self) -> Self;
    /// `|self|`
    #[must_use]
    fn abs(self) -> Self;
    /// `|self|` with the sign bit of `sign`.
    #[must_use]
    fn copysign(self, sign: Self) -> Self;
    /// These numbers where `self` is above 0, their opposites where it is below, either where it is 0.
    ///
    /// With one lane this is a branch, as in [`choose`](Mask::choose).
    #[must_use]
    fn towards<const K: usize>(self, numbers: [Self; K]) -> [Self; K];
    /// `self < other`; false where either is NaN.
    fn lt(self, other: Self) -> Self::Mask;
    /// The number in one lane. `lane` must be below [`Lane::LANES`].
    fn lane(self, lane: usize) -> f64;
    /// Puts a number into one lane. `lane` must be below [`Lane::LANES`].
    fn put(&mut self, lane: usize, number: f64);
    /// The lanes `f(0), f(1), …`, as many as `self` has.
    #[must_use]
    fn each(self, f: impl FnMut(usize) -> f64) -> Self;
    /// Four columns of rows, one row per lane: lane `k` of number `i` is `row(k)[i]`.
    ///
    /// This looks up adjacent numbers in fewer steps than [`each`](Lane::each), which takes one after another.
    #[must_use]
    fn columns<'a>(self, row: impl Fn(usize) -> &'a [f64; 4]) -> [Self; 4];
    /// The rows of a table at places to which [`WHOLE`] was added; see [`Rows::at`].
    #[must_use]
    #[inline(always)]
    fn row_of(self, rows: &Rows) -> [Self; 4] {
        rows.one_by_one(self)
    }
    /// The first lanes of `from`, which must hold at least [`Lane::LANES`] numbers.
    #[must_use]
    fn load(self, from: &[f64]) -> Self;
    /// Writes the lanes to the front of `to`, which must hold at least [`Lane::LANES`] numbers.
    fn store(self, to: &mut [f64]);

    /// False in every lane.
    #[must_use]
    #[inline(always)]
    fn never(self) -> Self::Mask {
        // a compiler sees that this is a constant; of a comparison it does not
        let any = self.lt(self);
        any & !any
    }
    /// The larger of two numbers; where one is NaN, either one, as the processor has it.
    #[must_use]
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        other.lt(self).select(self, other)
    }
    /// The number itself, or 0 where it is not above 0 or NaN.
    ///
    /// With one lane this is a branch, for numbers that are hardly ever below 0: what follows does not wait for the comparison.
    #[must_use]
    #[inline(always)]
    fn above_zero(self) -> Self {
        self.max(self.same(0.0))
    }
    /// The smaller of two numbers; where one is NaN, either one, as the processor has it.
    #[must_use]
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.lt(other).select(self, other)
    }
}

/// A truth value per lane of `F`.
pub trait Mask<F>: Copy + Debug + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self> {
    /// `yes` where true, `no` where false.
    fn select(self, yes: F, no: F) -> F;
    /// `yes` where true, `no` where false, for several numbers that belong together.
    ///
    /// With one lane this is a branch, which the CPU predicts so that it goes on without waiting for the numbers; select one number at a
    /// time where a prediction would mostly fail.
    #[must_use]
    #[inline(always)]
    fn choose<const K: usize>(self, yes: [F; K], mut no: [F; K]) -> [F; K]
    where
        F: Copy,
    {
        // no closure: a compiler may leave it as a function of its own, which is not compiled for the instruction set
        for i in 0..K {
            no[i] = self.select(yes[i], no[i]);
        }
        no
    }
    /// `yes` where true, `no` where false, for truth values that belong to numbers [chosen](Mask::choose) alike.
    #[must_use]
    #[inline(always)]
    fn either(self, yes: Self, no: Self) -> Self {
        (self & yes) | (!self & no)
    }
    /// Whether any lane is true.
    fn any(self) -> bool;
    /// Whether one lane is true. `lane` must be below [`Lane::LANES`].
    fn at(self, lane: usize) -> bool;
    /// The lanes as bits, the first one lowest.
    fn bits(self) -> u64;
}

/// A computation for lanes of any width; see [`dispatch`].
///
/// ```
/// use lanes::{Kernel, Lane, MOST_LANES, dispatch};
///
/// /// The lengths of vectors of the plane, as many at a time as there are lanes.
/// struct Lengths<'a>(&'a [f64], &'a [f64]);
/// impl Kernel for Lengths<'_> {
///     type Output = Vec<f64>;
///     #[inline(always)]
///     fn run<F: Lane>(self, zero: F) -> Vec<f64> {
///         let mut lengths = vec![];
///         for (x, y) in self.0.chunks(F::LANES).zip(self.1.chunks(F::LANES)) {
///             // the last chunk may be shorter than a vector
///             let [x, y] = [x, y].map(|a| zero.each(|lane| a.get(lane).copied().unwrap_or(0.0)));
///             let mut found = [0.0; MOST_LANES];
///             (x * x + y * y).sqrt().store(&mut found);
///             lengths.extend(found.into_iter().take(F::LANES));
///         }
///         lengths.truncate(self.0.len());
///         lengths
///     }
/// }
/// let (x, y) = ([3.0, 0.3, -5.0, 0.7, 0.1], [4.0, 0.1, 12.0, 0.9, 0.2]);
/// let one_by_one: Vec<f64> = x.iter().zip(&y).map(|(x, y)| (x * x + y * y).sqrt()).collect();
/// assert_eq!(dispatch(Lengths(&x, &y)), one_by_one); // to the last bit, whatever the CPU
/// ```
pub trait Kernel {
    /// What it returns.
    type Output;
    /// Runs it. `zero` is 0 in every lane: the seed of all other lanes ([`Lane::same`], [`Lane::load`]).
    fn run<F: Lane>(self, zero: F) -> Self::Output;
}

/// A computation with one lane; see [`vectorized`].
///
/// A trait and not a closure, so that an implementation can be marked `#[inline(always)]`: only then does its code
/// end up inside the function that is compiled for the instruction set.
///
/// ```
/// use lanes::{Task, vectorized};
///
/// /// `1 + x + x² + …`, so many terms.
/// struct Geometric(f64, u32);
/// impl Task for Geometric {
///     type Output = f64;
///     #[inline(always)]
///     fn run(self) -> f64 {
///         (0..self.1).fold(0.0, |sum, _| sum * self.0 + 1.0)
///     }
/// }
/// assert_eq!(vectorized(Geometric(0.7, 50)), Geometric(0.7, 50).run()); // not a bit differs
/// ```
pub trait Task {
    /// What it returns.
    type Output;
    /// Runs it.
    fn run(self) -> Self::Output;
}
