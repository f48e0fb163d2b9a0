//! Many lanes: the vector registers of the CPU, through `pulp`.
use crate::{Kernel, Lane, MOST_LANES, Mask, Rows, Task};
#[cfg(target_arch = "x86_64")]
use core::any::Any;
#[cfg(target_arch = "x86_64")]
use core::arch::x86_64::{__m512d, __m512i};
use core::fmt::Debug;
use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};
#[cfg(target_arch = "x86_64")]
use pulp::NullaryFnOnce;
use pulp::{Arch, Simd, WithSimd};

/// As many numbers as a vector register of the instruction set `S` holds, aligned like `A`.
///
/// Aligned to their size, they never straddle two cache lines, which would take twice as long to read and to write; and there is no
/// padding between them that would be copied with them.
#[derive(Clone, Copy, Debug)]
pub struct Wide<S: Simd, A> {
    simd: S,
    _aligned: [A; 0],
    value: S::f64s,
}

/// Aligned like registers of 512 bits: to a cache line.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Line;

/// Aligned like registers of 256 bits or fewer.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
struct HalfLine;

/// As many truth values as [`Wide`] has numbers.
#[derive(Clone, Copy, Debug)]
pub struct WideMask<S: Simd> {
    simd: S,
    value: S::m64s,
}

impl<S: Simd, A: Copy> Wide<S, A> {
    #[inline(always)]
    fn zero(simd: S) -> Self {
        Wide { simd, _aligned: [], value: simd.splat_f64s(0.0) }
    }
    #[inline(always)]
    fn of(self, value: S::f64s) -> Self {
        Wide { value, ..self }
    }
}

macro_rules! binary {
    ($($trait:ident $method:ident $op:ident),*) => { $(
        impl<S: Simd, A: Copy> $trait for Wide<S, A> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                self.of(self.simd.$op(self.value, other.value))
            }
        }
    )* };
}
binary!(Add add add_f64s, Sub sub sub_f64s, Mul mul mul_f64s, Div div div_f64s);

macro_rules! binary_with_constant {
    ($($trait:ident $method:ident),*) => { $(
        impl<S: Simd, A: Copy + Debug> $trait<f64> for Wide<S, A> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: f64) -> Self {
                self.$method(self.same(other))
            }
        }
    )* };
}
binary_with_constant!(Add add, Sub sub, Mul mul);

impl<S: Simd, A: Copy> Neg for Wide<S, A> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.of(self.simd.neg_f64s(self.value))
    }
}

impl<S: Simd, A: Copy + Debug> Lane for Wide<S, A> {
    type Mask = WideMask<S>;
    const LANES: usize = S::F64_LANES;
    #[inline(always)]
    fn same(self, a: f64) -> Self {
        self.of(self.simd.splat_f64s(a))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.of(self.simd.sqrt_f64s(self.value))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.of(self.simd.abs_f64s(self.value))
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        let s = self.simd;
        let bit = s.splat_f64s(-0.0);
        self.of(s.or_f64s(s.abs_f64s(self.value), s.and_f64s(bit, sign.value)))
    }
    #[inline(always)]
    fn towards<const K: usize>(self, mut numbers: [Self; K]) -> [Self; K] {
        let s = self.simd;
        let sign = s.and_f64s(self.value, s.splat_f64s(-0.0));
        for number in &mut numbers {
            number.value = s.xor_f64s(number.value, sign);
        }
        numbers
    }
    // except on x86 these would return NaN, and not the second number, if one of the two is NaN
    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.of(self.simd.max_f64s(self.value, other.value))
    }
    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.of(self.simd.min_f64s(self.value, other.value))
    }
    #[inline(always)]
    fn lt(self, other: Self) -> WideMask<S> {
        WideMask { simd: self.simd, value: self.simd.less_than_f64s(self.value, other.value) }
    }
    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        bytemuck::cast_slice::<S::f64s, f64>(core::slice::from_ref(&self.value))[lane]
    }
    #[inline(always)]
    fn put(&mut self, lane: usize, number: f64) {
        bytemuck::cast_slice_mut::<S::f64s, f64>(core::slice::from_mut(&mut self.value))[lane] = number;
    }
    #[inline(always)]
    fn each(self, mut f: impl FnMut(usize) -> f64) -> Self {
        let mut to = self;
        let lanes = bytemuck::cast_slice_mut::<S::f64s, f64>(core::slice::from_mut(&mut to.value));
        for (i, lane) in lanes.iter_mut().enumerate() {
            *lane = f(i);
        }
        to
    }
    #[inline(always)]
    fn columns<'a>(self, row: impl Fn(usize) -> &'a [f64; 4]) -> [Self; 4] {
        let mut rows = [self.value; 4];
        let places = bytemuck::cast_slice_mut::<S::f64s, f64>(&mut rows);
        for (k, place) in places.chunks_exact_mut(4).enumerate() {
            // shuffled into columns, of eight lanes the middle ones of each half change places
            let lane = if S::F64_LANES == 8 && (k % 4 == 1 || k % 4 == 2) { k ^ 3 } else { k };
            place.copy_from_slice(row(lane));
        }
        let [a, b, c, d] = self.simd.deinterleave_shfl_f64s(rows);
        [self.of(a), self.of(b), self.of(c), self.of(d)]
    }
    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    fn row_of(self, rows: &Rows) -> [Self; 4] {
        // one instruction for each column in place of one for each lane and the shuffles
        if let Some(avx512) = (&self.simd as &dyn Any).downcast_ref::<pulp::x86::V4>()
            && rows.len() <= MOST_LANES
        {
            let picks = bytemuck::cast::<S::f64s, __m512i>(self.value);
            let mut numbers = [self; 4];
            // no closure, which would not be compiled for AVX-512
            for (number, column) in numbers.iter_mut().zip(rows.columns()) {
                let [low, high] = *bytemuck::cast_ref::<[f64; MOST_LANES], [[f64; 8]; 2]>(column);
                let (low, high) = (bytemuck::cast::<[f64; 8], __m512d>(low), bytemuck::cast::<[f64; 8], __m512d>(high));
                number.value = bytemuck::cast(avx512.avx512f._mm512_permutex2var_pd(low, picks, high));
            }
            return numbers;
        }
        rows.one_by_one(self)
    }
    #[inline(always)]
    fn load(self, from: &[f64]) -> Self {
        self.of(S::as_simd_f64s(&from[..Self::LANES]).0[0])
    }
    #[inline(always)]
    fn store(self, to: &mut [f64]) {
        S::as_mut_simd_f64s(&mut to[..Self::LANES]).0[0] = self.value;
    }
}

impl<S: Simd> WideMask<S> {
    /// The lanes as bits, the first one lowest.
    #[inline(always)]
    fn to_bits(self) -> u64 {
        // one instruction, where going lane by lane would take three for each
        #[cfg(target_arch = "x86_64")]
        if let Some(avx2) = (&self.simd as &dyn Any).downcast_ref::<pulp::x86::V3>() {
            return u64::from(avx2.avx._mm256_movemask_pd(bytemuck::cast(self.value)).cast_unsigned());
        }
        // a truth value is a bit, or a whole number of ones or of zeros
        if const { size_of::<S::m64s>() == size_of::<S::u64s>() } {
            let lanes = bytemuck::cast::<S::m64s, S::u64s>(self.value);
            let lanes = bytemuck::cast_slice::<S::u64s, u64>(core::slice::from_ref(&lanes));
            lanes.iter().enumerate().fold(0, |all, (k, lane)| all | (lane & (1 << k)))
        } else {
            u64::from(bytemuck::cast::<S::m64s, u8>(self.value))
        }
    }
}

impl<S: Simd> BitAnd for WideMask<S> {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        WideMask { simd: self.simd, value: self.simd.and_m64s(self.value, other.value) }
    }
}
impl<S: Simd> BitOr for WideMask<S> {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        WideMask { simd: self.simd, value: self.simd.or_m64s(self.value, other.value) }
    }
}
impl<S: Simd> Not for WideMask<S> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        WideMask { simd: self.simd, value: self.simd.not_m64s(self.value) }
    }
}

impl<S: Simd, A: Copy + Debug> Mask<Wide<S, A>> for WideMask<S> {
    #[inline(always)]
    fn select(self, yes: Wide<S, A>, no: Wide<S, A>) -> Wide<S, A> {
        yes.of(self.simd.select_f64s(self.value, yes.value, no.value))
    }
    #[inline(always)]
    fn any(self) -> bool {
        self.to_bits() != 0
    }
    #[inline(always)]
    fn at(self, lane: usize) -> bool {
        self.to_bits() >> lane & 1 == 1
    }
    #[inline(always)]
    fn bits(self) -> u64 {
        self.to_bits()
    }
}

/// Performs an operation with the widest vectors of this CPU. In 32-bit programs on x86, where vectors of 512 bits have given wrong
/// results, it is done number by number.
#[inline(always)]
fn widest<O: WithSimd>(operation: O) -> O::Output {
    if cfg!(target_arch = "x86") { operation.with_simd(pulp::Scalar) } else { Arch::new().dispatch(operation) }
}

/// Runs a kernel in the widest lanes this CPU has.
pub fn dispatch<K: Kernel>(kernel: K) -> K::Output {
    struct Run<K>(K);
    impl<K: Kernel> WithSimd for Run<K> {
        type Output = K::Output;
        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) -> K::Output {
            if const { size_of::<S::f64s>() > size_of::<[f64; 4]>() } {
                self.0.run(Wide::<S, Line>::zero(simd))
            } else {
                self.0.run(Wide::<S, HalfLine>::zero(simd))
            }
        }
    }
    widest(Run(kernel))
}

/// Runs a task compiled for the best instruction set of this CPU, still one number at a time: the three-operand
/// instructions of AVX save moves, and no bit of a result changes.
pub fn vectorized<T: Task>(task: T) -> T::Output {
    #[cfg(target_arch = "x86_64")]
    struct Run<T>(T);
    #[cfg(target_arch = "x86_64")]
    impl<T: Task> NullaryFnOnce for Run<T> {
        type Output = T::Output;
        #[inline(always)]
        fn call(self) -> T::Output {
            self.0.run()
        }
    }
    // AVX-512 keeps truth values in registers of their own, which makes a single chain of operations slower
    #[cfg(target_arch = "x86_64")]
    if let Some(avx2) = pulp::x86::V3::try_new() {
        return avx2.vectorize(Run(task));
    }
    // elsewhere the instructions for one number are those that every CPU has
    task.run()
}

/// The name of the instruction set that [`dispatch`] uses on this CPU, and its number of lanes.
pub fn instruction_set() -> (&'static str, usize) {
    struct Name;
    impl WithSimd for Name {
        type Output = (&'static str, usize);
        fn with_simd<S: Simd>(self, _: S) -> Self::Output {
            let path = core::any::type_name::<S>();
            (path.rsplit("::").next().unwrap_or(path), S::F64_LANES)
        }
    }
    widest(Name)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What every instruction set of this CPU must satisfy, and a single number too.
    struct Holds;

    impl Kernel for Holds {
        type Output = ();
        fn run<F: Lane>(self, zero: F) {
            let numbers: Vec<f64> = (0..3 * F::LANES).map(|k| f64::from(u32::try_from(k * k % 7).unwrap())).collect();
            for k in 0..2 * F::LANES {
                let lanes = zero.load(&numbers[k..]);
                let mut stored = vec![-1.0; F::LANES + 1];
                lanes.store(&mut stored);
                assert_eq!(stored[..F::LANES], numbers[k..k + F::LANES]);
                assert_eq!(stored[F::LANES], -1.0);
                let rows: Vec<[f64; 4]> =
                    (0..F::LANES).map(|i| [0, 1, 2, 3].map(|j| numbers[k + i] + f64::from(10 * j))).collect();
                let columns = zero.columns(|i| &rows[i]);
                for (j, column) in columns.iter().enumerate() {
                    assert!((0..F::LANES).all(|i| column.lane(i) == rows[i][j]), "{column:?}");
                }
                // of so few rows, of as many as one instruction knows, of more
                for count in [1, 8, 9, 16, 17, 40] {
                    let row = |place: usize| [0, 1, 2, 3].map(|j| f64::from(u32::try_from(100 * j + place).unwrap()));
                    let place = |i: usize| (7 * k + 3 * i) % count;
                    let table = Rows::new((0..count).map(row).collect());
                    let columns = table.at(zero.each(|i| f64::from(u32::try_from(place(i)).unwrap())));
                    for (j, column) in columns.iter().enumerate() {
                        assert!((0..F::LANES).all(|i| column.lane(i) == row(place(i))[j]), "{count} rows: {column:?}");
                    }
                }
                let mut same = zero.each(|i| numbers[k + i]);
                assert!((0..F::LANES).all(|i| same.lane(i) == lanes.lane(i)));
                same.put(F::LANES - 1, 9.0);
                assert_eq!(
                    (same.lane(0), same.lane(F::LANES - 1)),
                    (if F::LANES == 1 { 9.0 } else { numbers[k] }, 9.0)
                );
                let [towards] = (lanes - 2.5).towards([lanes]);
                for number in [-2.0, -0.0, 0.0, 2.0, f64::NAN] {
                    let above = zero.same(number).above_zero();
                    let expected: f64 = if number == 2.0 { 2.0 } else { 0.0 };
                    assert!((0..F::LANES).all(|i| above.lane(i).to_bits() == expected.to_bits()), "{number} {above:?}");
                }
                let below = lanes.lt(zero.same(3.0));
                for i in 0..F::LANES {
                    let number = numbers[k + i];
                    assert_eq!(towards.lane(i), if number < 3.0 { -number } else { number });
                    assert_eq!(below.at(i), number < 3.0);
                    assert!(!zero.never().at(i));
                }
                let bits = (0..F::LANES).filter(|&i| numbers[k + i] < 3.0).fold(0, |bits, i| bits | (1 << i));
                assert_eq!(below.bits(), bits);
                assert_eq!((!below).bits(), bits ^ ((1 << F::LANES) - 1));
            }
        }
    }

    #[test]
    fn lanes_go_to_memory_and_back_and_masks_have_a_bit_per_lane() {
        struct Twice;
        impl Kernel for Twice {
            type Output = ();
            fn run<F: Lane>(self, zero: F) {
                Holds.run(crate::Twin::of(zero));
            }
        }
        dispatch(Holds);
        dispatch(Twice);
        Holds.run(0.0);
        Twice.run(0.0);
        #[cfg(target_arch = "x86_64")]
        if let Some(avx2) = pulp::x86::V3::try_new() {
            Holds.run(Wide::<_, HalfLine>::zero(avx2));
        }
        Holds.run(Wide::<_, HalfLine>::zero(pulp::Scalar));
    }
}
