//! A smooth curve cut into polynomial graphs that are accurate to rounding.
use super::{
    Graph, Parametric,
    graph::{BEYOND, DEGREE, Local},
    rising_root,
};
use core::f64::consts::PI;
use nalgebra::{SMatrix, SVector, Vector2};

/// Points at which a graph is compared with its curve, and from which it is made.
const SAMPLES: usize = 2 * DEGREE + 4;

/// Tolerance within which points must agree (relative to the curve's size), inclines (relative to 1) and parameters: the error of formulas
/// of a few functions.
const AGREE: f64 = 8.0 * f64::EPSILON;

/// Factors by which the error of a rough curve may be larger; the least that suffices is taken.
const ROUGH: [f64; 5] = [4.0, 8.0, 16.0, 64.0, 256.0];

/// Greatest factor by which the residual of the polynomials may be larger, apart from noise.
const LEFT: f64 = 16.0;

/// Size that terms of higher degree may have where the residual of the inclines is all noise, in units of its root mean square.
const NOISE: f64 = 0.6;

/// Greatest incline of a graph over its chord.
const STEEP: f64 = 0.5;

/// A stretch that is too long is shortened by this factor; after one that is not, the next may be longer by its inverse.
const PART: f64 = 0.8;

/// Least length of a stretch as a fraction of the greatest parameter: shorter ones are within rounding, and a curve that needs them has a
/// kink. Where only a higher derivative is unbounded, as for |x|^2.5, stretches become shorter towards that place and longer again beyond
/// it.
const LEAST: f64 = 1.0 / 70_368_744_177_664.0; // 2⁻⁴⁶

/// More graphs of one curve than this are suspicious: a hundred are usual. If a quarter of them suffices with a larger tolerance, they
/// follow the rounding of the formula, and not its bends.
const MANY: usize = 512;

/// Most graphs of one curve; one that needs more is rough.
const MOST: usize = 8192;

/// Where the bend changes its sign: the fraction of the greatest bend that does not matter, and the one that is rounding. The depth of
/// what is neglected is its third power.
const FLAT: [f64; 2] = [1e-6, 1e-11];

/// Cuts a curve between two parameters into graphs; `vertices` are its first and its last point as its neighbours have them, and `size`
/// \[L\] is that of its coordinates. The parameter rises or falls, such that the table lies on the left.
///
/// A smooth piece of your own runs as fast as the curves here if its [`Piece::graphs`](crate::Piece::graphs) returns these:
///
/// ```
/// use geometry::{Vector2, shapes::curve::{Parametric, graphs}};
///
/// /// A parabola, `y = x²`.
/// struct Parabola;
/// impl Parametric for Parabola {
///     fn at(&self, x: f64) -> [Vector2<f64>; 2] {
///         [Vector2::new(x, x * x), Vector2::new(1.0, 2.0 * x)]
///     }
/// }
/// let ends = [Vector2::new(-1.0, 1.0), Vector2::new(1.0, 1.0)];
/// assert!(graphs(&Parabola, [-1.0, 1.0], ends, 1.0).is_some_and(|graphs| graphs.len() < 64));
/// ```
///
/// The incline of the graph is fitted to the direction of the curve, and its integral to the points, by least squares in Chebyshev
/// polynomials. That keeps normals accurate to rounding, and averages the errors of the points.
///
/// `None` where no polynomial is accurate to rounding: on curves with kinks or endless oscillations. What lies between the points that are
/// compared, 26 on each graph, is the caller's responsibility: bounds on the second derivative can prove that nothing hides there.
pub fn graphs(
    curve: &impl Parametric,
    [start, end]: [f64; 2],
    vertices: [Vector2<f64>; 2],
    size: f64,
) -> Option<Vec<Graph>> {
    Cut { curve, size, rounding: 1.0, noise: 0.0 }.all([start, end], vertices)
}

/// The same, or else rough graphs, for formulas with a larger error than usual, such as those with a dozen waves, which multiply the
/// rounding of the parameter, or with differences that cancel. On average the graphs are nearer to the curve than a single value of the
/// formula.
pub(crate) fn rough_graphs(
    curve: &impl Parametric,
    [start, end]: [f64; 2],
    vertices: [Vector2<f64>; 2],
    size: f64,
) -> Option<Vec<Graph>> {
    let cut = |rounding: f64| Cut { curve, size, rounding, noise: NOISE }.all([start, end], vertices);
    match graphs(curve, [start, end], vertices, size) {
        Some(many) if many.len() > MANY => Some(cut(ROUGH[0]).filter(|few| few.len() < many.len() / 4).unwrap_or(many)),
        graphs => graphs.or_else(|| ROUGH.into_iter().find_map(cut)),
    }
}

#[derive(Clone, Copy)]
struct Place {
    u: f64,
    vertex: Vector2<f64>,
}

struct Cut<'a, C> {
    curve: &'a C,
    size: f64,
    /// Factor by which the usual rounding may be exceeded.
    rounding: f64,
    /// [`NOISE`], if the last terms may be noise like the next ones: near inflections of a rough curve, where waves cancel that are
    /// rounded one by one.
    noise: f64,
}

/// Why a stretch cannot be one graph.
enum Refused {
    /// The bend changes its sign at this parameter.
    Inflection(f64),
    /// It is too long.
    Long,
}

impl<C: Parametric> Cut<'_, C> {
    /// The whole curve as graphs.
    fn all(&self, [start, end]: [f64; 2], vertices: [Vector2<f64>; 2]) -> Option<Vec<Graph>> {
        let mut graphs = vec![];
        let mut from = Place { u: start, vertex: vertices[0] };
        let (mut length, mut stop) = (0.125 * (end - start), end);
        // not relative to the range, which may be short: lengths of a few units of rounding do not get shorter
        let least = LEAST * start.abs().max(end.abs());
        while from.u != end {
            // no slivers before the end or an inflection
            let rest = stop - from.u;
            let whole = rest.abs() <= length.abs();
            let u =
                if whole { stop } else { from.u + if rest.abs() < 2.0 * length.abs() { 0.5 * rest } else { length } };
            let to = Place { u, vertex: if u == end { vertices[1] } else { self.curve.at(u)[0] } };
            match self.fit([from, to]) {
                Ok(_) if graphs.len() == MOST => return None,
                Ok(graph) => {
                    graphs.push(graph);
                    if whole {
                        stop = end;
                    } else if u == from.u + length {
                        length *= 1.0 / PART;
                    }
                    from = to;
                }
                Err(Refused::Inflection(at)) if (at - from.u).abs() < (u - from.u).abs() => stop = at,
                Err(_) => length = PART * (u - from.u),
            }
            if length.abs() < least || length.is_nan() {
                return None;
            }
        }
        Some(graphs)
    }

    fn fit(&self, [from, to]: [Place; 2]) -> Result<Graph, Refused> {
        let chord = to.vertex - from.vertex;
        let half = 0.5 * libm::hypot(chord.x, chord.y);
        let origin = from.vertex + chord * 0.5;
        let outward = Vector2::new(chord.y, -chord.x) / (2.0 * half);
        let along = Vector2::new(-outward.y, outward.x);
        // in units of half the chord
        let local = |y: Vector2<f64>| [along.dot(&y) / half, outward.dot(&y) / half];
        let sense = if from.u < to.u { 1.0 } else { -1.0 };
        let sample = |u: f64| {
            let [p, d] = self.curve.at(u);
            let ([a, b], [run, rise]) = (local(p - origin), local(d * sense));
            [a, b, rise / run, run]
        };
        let (middle, width) = (0.5 * (from.u + to.u), 0.5 * (to.u - from.u));
        let samples: [[f64; 4]; SAMPLES] =
            core::array::from_fn(|k| sample(middle - width * libm::cos(PI * ((k as f64 + 0.5) / SAMPLES as f64))));
        let within = |[a, _, slope, run]: &[f64; 4]| a.abs() < 1.0 + AGREE && slope.abs() < STEEP && *run > 0.0;
        let forwards = samples.windows(2).all(|w| w[0][0] < w[1][0]);
        if !(half > 0.0 && half.is_finite() && forwards && samples.iter().all(within)) {
            return Err(Refused::Long);
        }
        let (inclines, rest) = incline(&samples).ok_or(Refused::Long)?;
        let mut heights = [0.0; DEGREE + 1];
        for (k, c) in inclines.iter().enumerate() {
            heights[k + 1] = c / (k as f64 + 1.0);
        }
        heights[0] = samples.iter().map(|[a, b, ..]| b - horner(&heights, *a)[0]).sum::<f64>() / SAMPLES as f64;
        // the rounding of parameters rotates directions relative to the points, and so does that of points
        let [first, last] = [samples[0][2], samples[SAMPLES - 1][2]];
        let of_parameters =
            if self.curve.is_consistent() { 0.0 } else { from.u.abs().max(to.u.abs()) / (to.u - from.u).abs() };
        let far = of_parameters.max(self.size / (2.0 * half));
        let turning = (last - first).abs() * far;
        let agrees = |[a, b, slope, _]: &[f64; 4]| {
            let [height, incline, _] = horner(&heights, *a);
            (height - b).abs() * half <= self.rounding * AGREE * self.size
                && (incline - slope).abs() <= self.rounding * (AGREE + f64::EPSILON * turning)
        };
        let [left, noise] = left_out(&samples, &heights);
        let small = self.rounding.min(LEFT) * f64::EPSILON * (0.5 + 0.25 * turning);
        if !(samples.iter().all(agrees) && rest <= small + self.noise * noise && left <= small + NOISE * noise) {
            return Err(Refused::Long);
        }
        if let Some(a) = inflection(&heights) {
            // the parameter at which the curve is at this place
            let part = rising_root(
                |s| {
                    let [at, _, _, run] = sample(from.u + (to.u - from.u) * s);
                    [at - a, run * (to.u - from.u).abs()]
                },
                [0.0, 1.0],
            );
            return Err(Refused::Inflection(from.u + (to.u - from.u) * part));
        }
        // lines that cross the graph twice lie between the chord and a tangent, whose height over the middle is half the sum of its
        // heights over the ends
        let middle = samples.iter().fold(0.0_f64, |m, [a, b, slope, _]| m.max((b - a * slope).abs()));
        let near = 2.125 * middle * half + AGREE * self.size;
        let local = Local {
            origin: origin.into(),
            outward: outward.into(),
            inverse: 1.0 / half,
            heights: heights.map(|c| c * half),
            third: third(&heights) * half,
        };
        Ok(Graph { ends: [from.vertex.into(), to.vertex.into()], near, local })
    }
}

/// A polynomial and its first two derivatives.
fn horner(c: &[f64; DEGREE + 1], a: f64) -> [f64; 3] {
    let mut jet = [0.0; 3];
    for &c in c.iter().rev() {
        jet = [jet[0] * a + c, jet[1] * a + jet[0], jet[2] * a + jet[1]];
    }
    [jet[0], jet[1], 2.0 * jet[2]]
}

/// An upper bound of a sixth of the third derivative wherever the graph is evaluated.
fn third(c: &[f64; DEGREE + 1]) -> f64 {
    let (mut sum, mut power) = (0.0, 1.0);
    for k in 3..=DEGREE {
        sum += (k * (k - 1) * (k - 2)) as f64 / 6.0 * c[k].abs() * power;
        power *= BEYOND;
    }
    sum
}

/// The polynomial closest to the inclines of the samples, and the size of the terms cut off, extrapolated from the last ones.
fn incline(samples: &[[f64; 4]; SAMPLES]) -> Option<([f64; DEGREE], f64)> {
    let mut normal = SMatrix::<f64, DEGREE, DEGREE>::zeros();
    let mut right = SVector::<f64, DEGREE>::zeros();
    for [a, _, slope, _] in samples {
        // Chebyshev polynomials
        let mut t = SVector::<f64, DEGREE>::repeat(1.0);
        t[1] = *a;
        for k in 2..DEGREE {
            t[k] = 2.0 * a * t[k - 1] - t[k - 2];
        }
        normal += t * t.transpose();
        right += t * *slope;
    }
    let chebyshev = normal.cholesky()?.solve(&right);
    // in powers: T₀ = 1, T₁ = a, T_k = 2a T_{k−1} − T_{k−2}
    let [mut before, mut last] = [[0.0; DEGREE]; 2];
    (before[0], last[1]) = (1.0, 1.0);
    let mut powers = [0.0; DEGREE];
    for k in 0..DEGREE {
        for (power, c) in powers.iter_mut().zip(before) {
            *power += chebyshev[k] * c;
        }
        let mut next = before.map(|c| -c);
        for i in 1..DEGREE {
            next[i] += 2.0 * last[i - 1];
        }
        (before, last) = (last, next);
    }
    // in pairs, since even or odd ones may be absent
    let size = |k: usize| chebyshev[k].abs().max(chebyshev[k - 1].abs());
    let (last, before) = (size(DEGREE - 1), size(DEGREE - 3));
    Some((powers, if last < before { last * (last / before) } else { last }))
}

/// The size of the next two terms in the residual of the inclines, and the root mean square of the whole residual: for a smooth curve both
/// are noise, and the former is a little less than half of the latter.
fn left_out(samples: &[[f64; 4]; SAMPLES], heights: &[f64; DEGREE + 1]) -> [f64; 2] {
    let (mut terms, mut squares) = ([[0.0; 2]; 2], 0.0);
    for [a, _, slope, _] in samples {
        let (mut t, mut next) = (1.0, *a);
        for _ in 0..DEGREE {
            (t, next) = (next, 2.0 * a * next - t);
        }
        let rest = slope - horner(heights, *a)[1];
        squares += rest * rest;
        for (term, t) in terms.iter_mut().zip([t, next]) {
            *term = [term[0] + rest * t, term[1] + t * t];
        }
    }
    let left = terms.iter().map(|[sum, weight]| (sum / weight).abs()).sum();
    [left, libm::sqrt(squares / SAMPLES as f64)]
}

/// Where the second derivative changes its sign, if it does.
fn inflection(heights: &[f64; DEGREE + 1]) -> Option<f64> {
    const GRID: usize = 64;
    let bend = |k: usize| {
        let a = (2 * k) as f64 / GRID as f64 - 1.0;
        (a, horner(heights, a)[2])
    };
    let greatest = (0..=GRID).map(|k| bend(k).1.abs()).fold(0.0, f64::max);
    let least = (FLAT[0] * greatest).max(FLAT[1]);
    let signs = || (0..=GRID).map(bend).filter(|(_, b)| b.abs() > least);
    let (first, sign) = signs().next()?;
    let (after, _) = signs().find(|(_, b)| b * sign < 0.0)?;
    let before = signs().take_while(|(_, b)| b * sign > 0.0).map(|(a, _)| a).fold(first, f64::max);
    Some(rising_root(|a| [-sign * horner(heights, a)[2], 0.0], [before, after]))
}
