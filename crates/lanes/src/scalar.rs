//! One lane: `f64` itself.
use crate::{Lane, Mask};

impl Lane for f64 {
    type Mask = bool;
    const LANES: usize = 1;
    #[inline(always)]
    fn same(self, a: f64) -> f64 {
        a
    }
    #[inline(always)]
    fn sqrt(self) -> f64 {
        self.sqrt()
    }
    #[inline(always)]
    fn abs(self) -> f64 {
        self.abs()
    }
    #[inline(always)]
    fn copysign(self, sign: f64) -> f64 {
        self.copysign(sign)
    }
    #[inline(always)]
    fn towards<const K: usize>(self, numbers: [f64; K]) -> [f64; K] {
        (0.0 < self).choose(numbers, numbers.map(|number| -number))
    }
    #[inline(always)]
    fn above_zero(self) -> f64 {
        let [number] = (0.0 < self).choose([self], [0.0]);
        number
    }
    #[inline(always)]
    fn lt(self, other: f64) -> bool {
        self < other
    }
    #[inline(always)]
    fn lane(self, _: usize) -> f64 {
        self
    }
    #[inline(always)]
    fn put(&mut self, _: usize, number: f64) {
        *self = number;
    }
    #[inline(always)]
    fn each(self, mut f: impl FnMut(usize) -> f64) -> f64 {
        f(0)
    }
    #[inline(always)]
    fn columns<'a>(self, row: impl Fn(usize) -> &'a [f64; 4]) -> [f64; 4] {
        *row(0)
    }
    #[inline(always)]
    fn load(self, from: &[f64]) -> f64 {
        from[0]
    }
    #[inline(always)]
    fn store(self, to: &mut [f64]) {
        to[0] = self;
    }
}

impl Mask<f64> for bool {
    #[inline(always)]
    fn select(self, yes: f64, no: f64) -> f64 {
        if self { yes } else { no }
    }
    #[inline(always)]
    fn choose<const K: usize>(self, yes: [f64; K], no: [f64; K]) -> [f64; K] {
        if self {
            // keeps the compiler from turning the branch into a selection
            core::hint::black_box(());
            yes
        } else {
            no
        }
    }
    #[inline(always)]
    fn either(self, yes: bool, no: bool) -> bool {
        if self {
            core::hint::black_box(());
            yes
        } else {
            no
        }
    }
    #[inline(always)]
    fn any(self) -> bool {
        self
    }
    #[inline(always)]
    fn at(self, _: usize) -> bool {
        self
    }
    #[inline(always)]
    fn bits(self) -> u64 {
        u64::from(self)
    }
}
