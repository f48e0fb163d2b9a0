//! Two vectors side by side: each hides the latency of the other.
use crate::{Lane, Mask, Rows};
use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// Twice as many lanes as `F` has, as two numbers of `F`.
///
/// An operation on one of them does not wait for the other, and both stand next to each other in the code: a CPU looks ahead
/// some hundred instructions, too few to find the next vector behind a whole step of a kernel.
#[derive(Clone, Copy, Debug)]
pub struct Twin<F>([F; 2]);

/// A truth value per lane of a [`Twin`].
#[derive(Clone, Copy, Debug)]
pub struct TwinMask<M>([M; 2]);

impl<F: Copy> Twin<F> {
    /// Twice the lanes of `zero`.
    #[inline(always)]
    pub fn of(zero: F) -> Self {
        Twin([zero; 2])
    }
}

macro_rules! binary {
    ($($trait:ident $method:ident),*) => { $(
        impl<F: Lane> $trait for Twin<F> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, Twin([c, d]): Self) -> Self {
                let Twin([a, b]) = self;
                Twin([a.$method(c), b.$method(d)])
            }
        }
    )* };
}
binary!(Add add, Sub sub, Mul mul, Div div);

macro_rules! binary_with_constant {
    ($($trait:ident $method:ident),*) => { $(
        impl<F: Lane> $trait<f64> for Twin<F> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: f64) -> Self {
                let Twin([a, b]) = self;
                Twin([a.$method(other), b.$method(other)])
            }
        }
    )* };
}
binary_with_constant!(Add add, Sub sub, Mul mul);

impl<F: Lane> Neg for Twin<F> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        let Twin([a, b]) = self;
        Twin([-a, -b])
    }
}

impl<F: Lane> Lane for Twin<F> {
    type Mask = TwinMask<F::Mask>;
    const LANES: usize = 2 * F::LANES;
    #[inline(always)]
    fn same(self, a: f64) -> Self {
        Twin([self.0[0].same(a); 2])
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        let Twin([a, b]) = self;
        Twin([a.sqrt(), b.sqrt()])
    }
    #[inline(always)]
    fn abs(self) -> Self {
        let Twin([a, b]) = self;
        Twin([a.abs(), b.abs()])
    }
    #[inline(always)]
    fn copysign(self, Twin([c, d]): Self) -> Self {
        let Twin([a, b]) = self;
        Twin([a.copysign(c), b.copysign(d)])
    }
    #[inline(always)]
    fn towards<const K: usize>(self, mut numbers: [Self; K]) -> [Self; K] {
        let Twin([a, b]) = self;
        for Twin([c, d]) in &mut numbers {
            ([*c], [*d]) = (a.towards([*c]), b.towards([*d]));
        }
        numbers
    }
    #[inline(always)]
    fn max(self, Twin([c, d]): Self) -> Self {
        let Twin([a, b]) = self;
        Twin([a.max(c), b.max(d)])
    }
    #[inline(always)]
    fn min(self, Twin([c, d]): Self) -> Self {
        let Twin([a, b]) = self;
        Twin([a.min(c), b.min(d)])
    }
    #[inline(always)]
    fn lt(self, Twin([c, d]): Self) -> TwinMask<F::Mask> {
        let Twin([a, b]) = self;
        TwinMask([a.lt(c), b.lt(d)])
    }
    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        self.0[lane / F::LANES].lane(lane % F::LANES)
    }
    #[inline(always)]
    fn put(&mut self, lane: usize, number: f64) {
        self.0[lane / F::LANES].put(lane % F::LANES, number);
    }
    #[inline(always)]
    fn each(self, mut f: impl FnMut(usize) -> f64) -> Self {
        let Twin([a, b]) = self;
        Twin([a.each(&mut f), b.each(|lane| f(F::LANES + lane))])
    }
    #[inline(always)]
    fn columns<'a>(self, row: impl Fn(usize) -> &'a [f64; 4]) -> [Self; 4] {
        let ([a, b, c, d], [e, f, g, h]) = (self.0[0].columns(&row), self.0[1].columns(|lane| row(F::LANES + lane)));
        [Twin([a, e]), Twin([b, f]), Twin([c, g]), Twin([d, h])]
    }
    #[inline(always)]
    fn row_of(self, rows: &Rows) -> [Self; 4] {
        let ([a, b, c, d], [e, f, g, h]) = (self.0[0].row_of(rows), self.0[1].row_of(rows));
        [Twin([a, e]), Twin([b, f]), Twin([c, g]), Twin([d, h])]
    }
    #[inline(always)]
    fn load(self, from: &[f64]) -> Self {
        let Twin([a, b]) = self;
        Twin([a.load(from), b.load(&from[F::LANES..])])
    }
    #[inline(always)]
    fn store(self, to: &mut [f64]) {
        let (front, back) = to.split_at_mut(F::LANES);
        self.0[0].store(front);
        self.0[1].store(back);
    }
}

impl<M: BitAnd<Output = M>> BitAnd for TwinMask<M> {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, TwinMask([c, d]): Self) -> Self {
        let TwinMask([a, b]) = self;
        TwinMask([a & c, b & d])
    }
}
impl<M: BitOr<Output = M>> BitOr for TwinMask<M> {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, TwinMask([c, d]): Self) -> Self {
        let TwinMask([a, b]) = self;
        TwinMask([a | c, b | d])
    }
}
impl<M: Not<Output = M>> Not for TwinMask<M> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        let TwinMask([a, b]) = self;
        TwinMask([!a, !b])
    }
}

impl<F: Lane> Mask<Twin<F>> for TwinMask<F::Mask> {
    #[inline(always)]
    fn select(self, Twin([a, b]): Twin<F>, Twin([c, d]): Twin<F>) -> Twin<F> {
        let TwinMask([first, second]) = self;
        Twin([first.select(a, c), second.select(b, d)])
    }
    #[inline(always)]
    fn any(self) -> bool {
        let TwinMask([first, second]) = self;
        (first | second).any()
    }
    #[inline(always)]
    fn at(self, lane: usize) -> bool {
        self.0[lane / F::LANES].at(lane % F::LANES)
    }
    #[inline(always)]
    fn bits(self) -> u64 {
        let TwinMask([first, second]) = self;
        first.bits() | (second.bits() << F::LANES)
    }
}
