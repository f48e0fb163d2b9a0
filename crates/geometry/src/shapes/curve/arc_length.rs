//! Arc length along a parametrised curve.
use super::{nearest::Blocks, rising_root, rising_root_near};
use crate::piece::Extent;
use core::cell::Cell;
use nalgebra::Vector2;

/// A curve with a parameter.
pub trait Parametric {
    /// The point \[L\] and its derivative with respect to the parameter, which does not vanish.
    fn at(&self, u: f64) -> [Vector2<f64>; 2];

    /// Whether point and derivative at a parameter belong together to the last digits, even where rounding shifts both along the curve.
    /// Not so for oscillating formulas, which round multiples of their parameter.
    fn is_consistent(&self) -> bool {
        false
    }
}

/// Abscissas > 0 and weights of the Gauss–Legendre rule with ten nodes on [−1, 1].
pub(super) const GAUSS: [[f64; 2]; 5] = [
    [0.148_874_338_981_631_21, 0.295_524_224_714_752_87],
    [0.433_395_394_129_247_2, 0.269_266_719_309_996_35],
    [0.679_409_568_299_024_4, 0.219_086_362_515_982_04],
    [0.865_063_366_688_984_5, 0.149_451_349_150_580_6],
    [0.973_906_528_517_171_7, 0.066_671_344_308_688_14],
];

/// `∫ f du` from `a` to `b`, exact for polynomials up to degree 19.
pub(super) fn integral(f: impl Fn(f64) -> f64, a: f64, b: f64) -> f64 {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    half * GAUSS.iter().map(|[x, w]| w * (f(middle - half * x) + f(middle + half * x))).sum::<f64>()
}

/// Abscissas and weights of the rule with three nodes.
const FEW: [[f64; 2]; 3] =
    [[-0.774_596_669_241_483_4, 5.0 / 9.0], [0.0, 8.0 / 9.0], [0.774_596_669_241_483_4, 5.0 / 9.0]];

/// Over this fraction of an interval between nodes the three-node rule is exact to rounding if the ten-node rule is so over the whole.
const NEAR: f64 = 1.0 / 256.0;

/// After a step of Newton's method by this fraction of such an interval, the remaining error is below rounding.
const CLOSE: f64 = 1e-9;

fn speed(curve: &impl Parametric, u: f64) -> f64 {
    let [_, d] = curve.at(u);
    libm::hypot(d.x, d.y)
}

/// A point of the table.
#[derive(Clone, Copy, Debug)]
struct Node {
    u: f64,
    /// Arc length from the start.
    s: f64,
    at: [Vector2<f64>; 2],
}

/// Arc length as a function of the parameter, tabulated so densely that one Gauss rule between neighbours is exact to
/// rounding.
#[derive(Clone, Debug)]
pub(crate) struct ArcLength {
    nodes: Vec<Node>,
    blocks: Blocks,
    is_full: bool,
}

/// Intervals shorter than this fraction of the parameter's range are not halved: on a curve that is steep on that scale, the rounding of
/// the parameter shows.
const FINEST: f64 = 1.0 / 536_870_912.0;

/// Most successive halvings that do not help, where the rules differ by more than rounding can explain: this many until an interval with
/// 64 waves has one.
const IN_VAIN: u32 = 6;

/// A halving helps if it reduces the relative difference to this fraction or less: less than `√½`, to which it falls next to a place
/// where the speed is unbounded like `1/√u`.
const FALLING: f64 = 0.7;

/// Halving should reduce the difference per width to this fraction or less; where a derivative jumps, it becomes half. Rounding
/// differences stay as they are.
const LESS: f64 = 0.6;

/// A difference may be smaller than others by this factor by chance.
const BY_CHANCE: f64 = 16.0;

/// Rules whose relative difference is less than this, and does not decrease on halving, differ by the rounding of the formula.
const NOISE: f64 = 1e-9;

/// If the difference of one half is less than this fraction of that of the other, it belongs to one place, as the tip of a cusp.
const ONE_SIDED: f64 = 1.0 / 1024.0;

/// Beside such a place, intervals are halved down to this multiple of the rounding of the parameter, which then still knows the distance
/// from the tip to six digits.
const ROUNDED: f64 = 1_048_576.0 * f64::EPSILON;

/// Most points of a table: a curve that needs more winds so often that computing with it would take too long.
const MOST: usize = 1 << 18;

impl ArcLength {
    /// Tabulates a curve from parameter values in rising order, at least two.
    pub(crate) fn new(curve: &impl Parametric, parameters: impl IntoIterator<Item = f64>) -> ArcLength {
        let mut nodes: Vec<Node> = Vec::new();
        let parameters: Vec<f64> = parameters.into_iter().collect();
        let most = MOST.max(8 * parameters.len());
        let finest = FINEST * parameters.last().zip(parameters.first()).map_or(0.0, |(last, first)| last - first);
        for u in parameters {
            if let Some(last) = nodes.last().copied() {
                let start = Progress { difference: f64::INFINITY, in_vain: 0, finest, most };
                extend(curve, &mut nodes, [last.u, u], start);
            } else {
                nodes.push(Node { u, s: 0.0, at: curve.at(u) });
            }
        }
        let blocks = Blocks::new(nodes.iter().map(|node| node.at[0]));
        let is_full = nodes.len() >= most;
        ArcLength { nodes, blocks, is_full }
    }

    pub(crate) fn length(&self) -> f64 {
        self.nodes.last().map_or(0.0, |node| node.s)
    }

    /// Whether the curve winds more often than the table can resolve.
    pub(crate) fn is_full(&self) -> bool {
        self.is_full
    }

    /// The first parameter of the table up to which the length is not finite, if there is one.
    pub(crate) fn endless(&self) -> Option<f64> {
        self.nodes.iter().find(|node| !node.s.is_finite()).map(|node| node.u)
    }

    /// The greatest speed in the table, per unit of the parameter.
    pub(crate) fn fastest(&self) -> f64 {
        self.nodes.iter().map(|node| node.at[1].norm()).fold(0.0, f64::max)
    }

    /// The parameters of the table.
    pub(crate) fn parameters(&self) -> impl Iterator<Item = f64> + '_ {
        self.nodes.iter().map(|node| node.u)
    }

    /// `½ ∮ (x dy − y dx)` of a closed curve, positive if it is traversed counter-clockwise, by one rule between neighbours of the table;
    /// `about` is a point not far from it.
    pub(crate) fn enclosed_area(&self, curve: &impl Parametric, about: Vector2<f64>) -> f64 {
        let form = sector(curve, about);
        self.nodes.windows(2).map(|w| integral(&form, w[0].u, w[1].u)).sum()
    }

    /// The same, with more rules where the curve is so rough that one is not enough: at the points of `|x|^2.5 + |y|^2.5 = 1` on the axes
    /// the speed has one derivative more than the height. Takes three times as long where the curve is smooth.
    pub(crate) fn refined_area(&self, curve: &impl Parametric, about: Vector2<f64>) -> f64 {
        let form = sector(curve, about);
        let reach = self.points().map(|p| (p - about).norm()).fold(0.0, f64::max);
        let finest = FINEST * self.nodes.last().zip(self.nodes.first()).map_or(0.0, |(last, first)| last.u - first.u);
        let of_part = |w: &[Node]| {
            let value = integral(&form, w[0].u, w[1].u);
            let enough = 2.0 * f64::EPSILON * reach * (w[1].s - w[0].s);
            refined(&form, [w[0].u, w[1].u], Rule { value, enough, most: f64::INFINITY, finest })
        };
        self.nodes.windows(2).map(of_part).sum()
    }

    /// The box around the curve, from its ends and the points where it runs parallel to an axis.
    pub(crate) fn extent(&self, curve: &impl Parametric) -> Extent {
        let mut extent = Extent::of(self.points());
        for w in self.nodes.windows(2) {
            for i in 0..2 {
                let [before, after] = [w[0].at[1][i], w[1].at[1][i]];
                if before * after < 0.0 {
                    let rise = |u: f64| [curve.at(u)[1][i] * after.signum(), 0.0];
                    extent = extent.union(Extent::of([curve.at(rising_root(rise, [w[0].u, w[1].u]))[0]]));
                }
            }
        }
        extent
    }

    /// Arc length up to the parameter `u` of the table's range.
    pub(crate) fn at_parameter(&self, curve: &impl Parametric, u: f64) -> f64 {
        let below = self.nodes.partition_point(|node| node.u <= u).clamp(1, self.nodes.len()) - 1;
        let node = self.nodes[below];
        node.s + integral(|u| speed(curve, u), node.u, u)
    }

    /// The parameter at arc length `s`, clamped to the table's range.
    pub(crate) fn parameter(&self, curve: &impl Parametric, s: f64) -> f64 {
        let above = self.nodes.partition_point(|node| node.s <= s).clamp(1, self.nodes.len() - 1);
        let [low, high] = [self.nodes[above - 1], self.nodes[above]];
        if s <= low.s {
            return low.u;
        }
        if s >= high.s {
            return high.u;
        }
        let width = high.u - low.u;
        let rate = |u: f64| speed(curve, u);
        // the parameter up to which the length is known, and by how much that length exceeds `s`
        let known = Cell::new((low.u, low.s - s));
        let rest = |u: f64| {
            let (from, excess) = known.get();
            let excess = if (u - from).abs() < NEAR * width {
                let (middle, half) = (0.5 * (from + u), 0.5 * (u - from));
                excess + half * FEW.iter().map(|[x, w]| w * rate(middle + half * x)).sum::<f64>()
            } else {
                low.s - s + integral(rate, low.u, u)
            };
            known.set((u, excess));
            [excess, rate(u)]
        };
        rising_root_near(between(low, high, s), rest, [low.u, high.u], CLOSE * width)
    }

    /// The parameter of the point of the curve that is closest to `point`.
    pub(crate) fn closest(&self, curve: &impl Parametric, point: &Vector2<f64>) -> f64 {
        self.blocks.closest(curve, |k| (self.nodes[k].u, self.nodes[k].at), point)
    }

    /// The tabulated points.
    pub(crate) fn points(&self) -> impl Iterator<Item = Vector2<f64>> + '_ {
        self.nodes.iter().map(|node| node.at[0])
    }
}

/// An estimate of the parameter at arc length `s`, from two nodes and their speeds.
fn between(low: Node, high: Node, s: f64) -> f64 {
    let (width, length) = (high.u - low.u, high.s - low.s);
    let share = (s - low.s) / length;
    let [start, end] = [low, high].map(|node| length / (width * node.at[1].norm()));
    // the cubic with these slopes
    let rest = 1.0 - share;
    let part = share * (share * (1.0 + 2.0 * rest) + rest * (rest * start - share * end));
    if 0.0 < part && part < 1.0 { low.u + part * width } else { 0.5 * (low.u + high.u) }
}

/// The area between `about` and a curve, per unit of the parameter.
fn sector(curve: &impl Parametric, about: Vector2<f64>) -> impl Fn(f64) -> f64 {
    move |u| {
        let [p, d] = curve.at(u);
        0.5 * (p - about).perp(&d)
    }
}

/// An integral by one rule on the whole interval.
#[derive(Clone, Copy, Debug)]
struct Rule {
    value: f64,
    /// The difference from the rule on the halves that is small enough.
    enough: f64,
    /// If the difference per width is more than this, halving does not help.
    most: f64,
    /// Intervals of this width are not halved any more.
    finest: f64,
}

/// `∫ f du`, from halves where the rule on the whole differs from the rule on them, and does so less and less.
fn refined(f: &impl Fn(f64) -> f64, [a, b]: [f64; 2], rule: Rule) -> f64 {
    let middle = 0.5 * (a + b);
    let halves = [[a, middle], [middle, b]];
    let values = halves.map(|[a, b]| integral(f, a, b));
    let difference = (rule.value - (values[0] + values[1])).abs();
    let per_width = difference / (b - a);
    let mends = difference > rule.enough && per_width <= rule.most && b - a > rule.finest;
    if !mends {
        return values[0] + values[1];
    }
    let most = LESS * rule.most.min(BY_CHANCE * per_width);
    let next = Rule { enough: 0.5 * rule.enough, most, ..rule };
    refined(f, halves[0], Rule { value: values[0], ..next }) + refined(f, halves[1], Rule { value: values[1], ..next })
}

/// What halving an interval has brought so far.
#[derive(Clone, Copy, Debug)]
struct Progress {
    /// The relative difference of the rule on the whole from that on the halves, for the preceding interval.
    difference: f64,
    /// Successive halvings that have not reduced it.
    in_vain: u32,
    /// Intervals of this width are not halved any more.
    finest: f64,
    /// Number of nodes from which on nothing is halved.
    most: usize,
}

/// Adds nodes up to `u`, halving until the rule on the whole agrees with the rule on the halves, or until the formula
/// is so rough that halving does not help.
fn extend(curve: &impl Parametric, nodes: &mut Vec<Node>, [from, u]: [f64; 2], last: Progress) {
    let middle = 0.5 * (from + u);
    let rate = |u: f64| speed(curve, u);
    let (left, right) = (integral(rate, from, middle), integral(rate, middle, u));
    let difference = (integral(rate, from, u) / (left + right) - 1.0).abs();
    let in_vain = if difference <= FALLING * last.difference { 0 } else { last.in_vain + 1 };
    let patience = if difference > NOISE { IN_VAIN } else { 1 };
    // halving does not help where the difference is NaN
    let is_singular = difference > NOISE && in_vain >= patience && is_one_sided(rate, [from, middle, u]);
    let finest = if is_singular { (ROUNDED * from.abs().max(u.abs())).max(FINEST * last.finest) } else { last.finest };
    let may_halve = u - from > finest && nodes.len() < last.most;
    let mends = difference > 8.0 * f64::EPSILON && (in_vain < patience || is_singular) && may_halve;
    if mends {
        let progress = Progress { difference, in_vain, ..last };
        extend(curve, nodes, [from, middle], progress);
        extend(curve, nodes, [middle, u], progress);
    } else {
        let s = nodes.last().map_or(0.0, |node| node.s);
        // the middle is known anyway, and makes the search for closest points safer
        let [before, between, after] = [from, middle, u].map(|u| curve.at(u));
        let way = |a: [Vector2<f64>; 2], b: [Vector2<f64>; 2]| (b[0] - a[0]).norm();
        // towards a tip the curve becomes straight, and its speed infinite
        let (left, right) = if is_singular { (way(before, between), way(between, after)) } else { (left, right) };
        nodes.push(Node { u: middle, s: s + left, at: between });
        nodes.push(Node { u, s: s + (left + right), at: after });
    }
}

/// Whether the rule is wrong in one half of an interval and right in the other, as beside the tip of a cusp.
fn is_one_sided(rate: impl Fn(f64) -> f64, [from, middle, u]: [f64; 3]) -> bool {
    let difference = |a: f64, b: f64| {
        let between = 0.5 * (a + b);
        (integral(&rate, a, between) + integral(&rate, between, b) - integral(&rate, a, b)).abs()
    };
    let (left, right) = (difference(from, middle), difference(middle, u));
    left.min(right) < ONE_SIDED * left.max(right)
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::PI;

    /// A cycloid arch: length 8, area 3π.
    struct Cycloid;
    impl Parametric for Cycloid {
        fn at(&self, u: f64) -> [Vector2<f64>; 2] {
            let (sin, cos) = (libm::sin(u), libm::cos(u));
            [Vector2::new(sin - u, 1.0 - cos), Vector2::new(cos - 1.0, sin)]
        }
    }

    #[test]
    fn a_cycloid_arch_is_four_diameters_long() {
        let table = ArcLength::new(&Cycloid, [0.0, PI, 2.0 * PI]);
        assert!((table.length() - 8.0).abs() < 1e-14);
        assert!((table.enclosed_area(&Cycloid, Vector2::zeros()) - 3.0 * PI).abs() < 2e-14);
        for k in 1..40 {
            let s = 0.2 * f64::from(k);
            let u = table.parameter(&Cycloid, s);
            assert!((4.0 * (1.0 - libm::cos(0.5 * u)) - s).abs() < 1e-14); // its closed form
            assert!((table.at_parameter(&Cycloid, u) - s).abs() < 1e-14);
        }
    }

    /// `y = −cos(2πku)/(2πk)`: `k` waves on `0 ≤ u ≤ 1`, alike except for their size.
    struct Waves(f64);
    impl Parametric for Waves {
        fn at(&self, u: f64) -> [Vector2<f64>; 2] {
            let (sin, cos) = libm::sincos(2.0 * PI * self.0 * u);
            [Vector2::new(u, -cos / (2.0 * PI * self.0)), Vector2::new(1.0, sin)]
        }
    }

    #[test]
    fn a_parameter_takes_one_rule_over_the_way_there_and_some_places() {
        struct Counted<C>(C, Cell<usize>);
        impl<C: Parametric> Parametric for Counted<C> {
            fn at(&self, u: f64) -> [Vector2<f64>; 2] {
                self.1.set(self.1.get() + 1);
                self.0.at(u)
            }
        }
        let curve = Counted(Waves(3.0), Cell::new(0));
        let table = ArcLength::new(&curve, (0..=32).map(|k| f64::from(k) / 32.0));
        curve.1.set(0);
        for k in 0..1000 {
            let s = table.length() * (f64::from(k) + 0.5) / 1000.0;
            let u = table.parameter(&curve, s);
            let there = table.at_parameter(&Waves(3.0), u);
            assert!((there - s).abs() < 4e-16 * table.length(), "{s} {there}");
        }
        assert!(curve.1.get() < 1000 * 18, "{}", curve.1.get());
    }

    #[test]
    fn many_waves_are_as_long_as_one_times_their_number() {
        let expected = ArcLength::new(&Waves(1.0), [0.0, 0.5, 1.0]).length();
        for k in 1..100 {
            let length = ArcLength::new(&Waves(f64::from(k)), [0.0, 1.0]).length();
            assert!((length / expected - 1.0).abs() < 1e-14, "{k}: {length} {expected}");
        }
    }

    #[test]
    fn a_tip_at_which_the_speed_is_infinite_is_as_long_as_it_is() {
        /// `y = |u − at|^p`
        struct Tip {
            at: f64,
            power: f64,
        }
        impl Parametric for Tip {
            fn at(&self, u: f64) -> [Vector2<f64>; 2] {
                let Tip { at, power } = *self;
                let x = u - at;
                let slope = libm::copysign(power * libm::pow(x.abs(), power - 1.0), x);
                [Vector2::new(u, libm::pow(x.abs(), power)), Vector2::new(1.0, slope)]
            }
        }
        // ∫₀¹ √(1 + y′²) du: for y = √u, √5/2 + arsinh(2)/4; for y = ∛u, u = y³, ∫₀¹ √(1 + 9 y⁴) dy, with 40 digits
        let root = 0.5 * libm::sqrt(5.0) + 0.25 * libm::asinh(2.0);
        // the parameter knows the distance from a tip at 1 to six digits, of a length of 10⁻⁴
        for (power, expected) in [(0.5, root), (1.0 / 3.0, 1.547_865_654_683_61)] {
            for at in [0.0, 1.0] {
                let curve = Tip { at, power };
                let table = ArcLength::new(&curve, [at, at + 0.5, at + 1.0]);
                assert!((table.length() - expected).abs() < 1e-12, "{power} at {at}: {}", table.length() - expected);
                let table = ArcLength::new(&curve, [at - 1.0, at]);
                assert!((table.length() - expected).abs() < 1e-12, "{power} at {at}: {}", table.length() - expected);
                assert!(table.points().count() < 1000);
            }
        }
    }

    #[test]
    fn a_hundred_thousand_waves_fill_the_table_and_not_the_memory() {
        let table = ArcLength::new(&Waves(1e5), (0..=32).map(|k| f64::from(k) / 32.0));
        assert!(table.is_full() && table.points().count() < MOST + 200, "{}", table.points().count());
    }

    #[test]
    fn a_speed_that_is_no_number_is_not_halved_without_end() {
        struct Nowhere;
        impl Parametric for Nowhere {
            fn at(&self, _: f64) -> [Vector2<f64>; 2] {
                [Vector2::repeat(f64::NAN); 2]
            }
        }
        let table = ArcLength::new(&Nowhere, [0.0, 1.0]);
        assert!(table.length().is_nan() && table.points().count() == 3);
    }

    #[test]
    fn the_top_of_a_cycloid_is_closest_to_points_above_it() {
        let table = ArcLength::new(&Cycloid, [0.0, PI, 2.0 * PI]);
        assert!((table.closest(&Cycloid, &Vector2::new(-PI, 5.0)) - PI).abs() < 1e-15);
    }
}
