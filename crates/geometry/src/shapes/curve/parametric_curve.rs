//! A curve given by its point as a function of a parameter.
use super::{
    Aimed, ArcLength, Graph, Interval, Parametric,
    cusp::Cusp,
    kinks::{Scale, Variation, kinks, places},
    rough_graphs,
};
use crate::{
    Error, ParametricRule,
    crossing::Crossing,
    path::Line,
    piece::{Extent, Landing, Piece},
    plane::{once_around, slack},
};
use core::f64::consts::PI;
use core::fmt::Debug;
use nalgebra::Vector2;
use std::sync::Arc;

/// A point `c(t)` as a function of a parameter: twice differentiable except at kinks.
///
/// At a kink `c′` may be either one-sided slope, and over an interval that contains a kink `c″` has no bound: [`Interval::ENTIRE`]. At a
/// cusp `c′` is 0, and `c″` is not.
pub trait ParametricFormula: Debug + Send + Sync {
    /// `c`, `c′` and `c″` \[L\] at a parameter of the range.
    fn jet(&self, t: f64) -> [[f64; 2]; 3];

    /// Intervals that contain the coordinates of `c`, `c′` and `c″` everywhere between two parameters of the range; the narrower, the
    /// better kinks are told from sharp bends.
    fn jet_over(&self, t: Interval) -> [[Interval; 2]; 3];
}

/// The curve `c(t)` for `t` from one parameter to another, smooth, with the table on one side: closed, or an arc between two ends.
///
/// Traversed with the table on the left. Paths meet its polynomial [`graphs`](super::graphs()); everything else uses the formula, except
/// next to cusps, where the formula's directions are dominated by rounding.
///
/// ```
/// use geometry::{Piece, shapes::curve::{Interval, ParametricCurve, ParametricFormula}};
///
/// /// The curve of constant width 2 with the support function `h = 1 + a cos 3t`: `c = h e + h′ e′`, `e = (cos t, sin t)`.
/// #[derive(Debug)]
/// struct ConstantWidth {
///     a: f64,
/// }
/// impl ParametricFormula for ConstantWidth {
///     fn jet(&self, t: f64) -> [[f64; 2]; 3] {
///         let ((sin, cos), (wave, crest)) = (libm::sincos(t), libm::sincos(3.0 * t));
///         let [h, slope] = [1.0 + self.a * crest, -3.0 * self.a * wave];
///         // the radius of curvature h + h″, and its derivative
///         let [rho, rate] = [1.0 - 8.0 * self.a * crest, 24.0 * self.a * wave];
///         [
///             [h * cos - slope * sin, h * sin + slope * cos],
///             [-rho * sin, rho * cos],
///             [-rate * sin - rho * cos, rate * cos - rho * sin],
///         ]
///     }
///     fn jet_over(&self, t: Interval) -> [[Interval; 2]; 3] {
///         let ([sin, cos], [wave, crest]) = (t.sin_cos(), (t * 3.0).sin_cos());
///         let [h, slope] = [crest * self.a + 1.0, wave * (-3.0 * self.a)];
///         let [rho, rate] = [crest * (-8.0 * self.a) + 1.0, wave * (24.0 * self.a)];
///         [
///             [h * cos - slope * sin, h * sin + slope * cos],
///             [-(rho * sin), rho * cos],
///             [-(rate * sin) - rho * cos, rate * cos - rho * sin],
///         ]
///     }
/// }
/// let turn = [0.0, 2.0 * core::f64::consts::PI];
/// let pieces = ParametricCurve::around(ConstantWidth { a: 0.1 }, turn, true)?;
/// assert_eq!(pieces.len(), 1);
/// // Barbier: the length is π times the width
/// assert!((pieces[0].length() - turn[1]).abs() < 1e-14);
/// # Ok::<(), geometry::Error>(())
/// ```
#[derive(Debug)]
pub struct ParametricCurve<F> {
    formula: Arc<InTurns<F>>,
    /// The parameters of its ends, rising, in units of the whole range over a turn.
    range: [f64; 2],
    /// The points there, as its neighbours have them; twice the same for a closed curve.
    vertices: [Vector2<f64>; 2],
    is_closed: bool,
    /// Whether it is traversed from the lower parameter to the higher one.
    rises: bool,
    graphs: Vec<Graph>,
    table: ArcLength,
    area: f64,
    extent: Extent,
    slack: f64,
}

impl<F> Clone for ParametricCurve<F> {
    fn clone(&self) -> Self {
        let (formula, graphs, table) = (Arc::clone(&self.formula), self.graphs.clone(), self.table.clone());
        ParametricCurve { formula, graphs, table, ..*self }
    }
}

/// Parts of the whole range in which the second derivative must be calm.
const PARTS: u32 = 4096;

/// Factors for more parts, where those do not suffice: for bends down to a thousandth of the range wide.
const FINER: [u32; 3] = [1, 4, 16];

/// Parts from which the length is tabulated: the formula is evaluated at thirty places of each, so that nothing is missed that is calm in
/// sixteen of the parts above.
const TABULATED: u32 = 256;

/// Number of points from which the size of a curve is estimated, to a factor.
const SIZED: u32 = 61;

/// Parts of the whole range beyond which no graph reaches: their 26 points are then as close together as five of the parts above.
const STRETCHES: f64 = 32.0;

/// Most parts of one width that kinks are looked for in: two about each of 2000 kinks.
const MOST_PARTS: usize = 4096;

/// The ends of a closed curve may be this far apart, relative to its size, and by the rounding of its coordinates: the end of the range is
/// rounded, and formulas multiply it.
const CLOSED: f64 = 1e-9;

/// Directions at the seam of a closed curve that differ by less than this (radians) count as a smooth continuation.
const SMOOTH: f64 = 2e-7;

/// Some ulp of a turn.
const NARROW: f64 = 16.0 * f64::EPSILON;

/// A formula whose range is rescaled to one turn.
#[derive(Debug)]
struct InTurns<F> {
    formula: F,
    start: f64,
    end: f64,
    /// Parameters per radian.
    rate: f64,
    /// Factor by which more parts are needed, as the curve bends more sharply than others.
    fineness: u32,
    cusps: Vec<Cusp>,
}

impl<F: ParametricFormula> InTurns<F> {
    fn parameter(&self, u: f64) -> f64 {
        // beyond its range a formula need not be defined, not even by rounding
        (self.start + self.rate * u).min(self.end)
    }

    /// The cusp beside which a parameter lies.
    fn cusp(&self, u: f64) -> Option<&Cusp> {
        self.cusps.iter().find(|cusp| cusp.around().contains(u))
    }

    fn jet(&self, u: f64) -> [Vector2<f64>; 3] {
        match self.cusp(u) {
            Some(cusp) => cusp.jet(&|u| self.as_written(u)[2], u),
            None => self.as_written(u),
        }
    }

    /// The values of the formula itself.
    fn as_written(&self, u: f64) -> [Vector2<f64>; 3] {
        let [c, first, second] = self.formula.jet(self.parameter(u)).map(Vector2::from);
        [c, first * self.rate, second * (self.rate * self.rate)]
    }

    fn jet_over(&self, u: Interval) -> [[Interval; 2]; 3] {
        // the ends are rounded like parameters, and none lies beyond the range
        let [low, high] = [u.low, u.high].map(|end| self.parameter(end));
        let [c, first, second] = self.formula.jet_over(Interval::new(low, high));
        [c, first.map(|x| x * self.rate), second.map(|x| x * (self.rate * self.rate))]
    }
}

impl<F: ParametricFormula> Parametric for InTurns<F> {
    fn at(&self, u: f64) -> [Vector2<f64>; 2] {
        let [c, first, _] = self.jet(u);
        [c, first]
    }
}

fn part(k: u32, of: u32) -> f64 {
    2.0 * PI * (f64::from(k) / f64::from(of))
}

fn sector(k: u32, of: u32) -> Interval {
    Interval::new(part(k, of), part(k + 1, of))
}

impl<F: ParametricFormula> ParametricCurve<F> {
    /// The closed curve of a range of parameters as pieces, in the order of traversal, with the table inside (`inside`) or outside: the
    /// curve itself if it is smooth, or else the arcs between its kinks and the start of the range.
    ///
    /// Whether it crosses itself is left to [`Table::validate`](crate::Table::validate).
    ///
    /// # Errors
    /// [`Error::Parameter`] for a range that is empty or not finite, [`Error::Parametrised`] unless the curve is finite, comes back to where it
    /// starts (to 10⁻⁹ of its size, and rounding), has a finite `c′`, has `c′ = 0` nowhere except at cusps, where `c″` is not 0 as well and
    /// which are some 10⁻⁵ of the range apart, and is smooth except for kinks that the bounds on `c″` reveal.
    pub fn around(formula: F, range: [f64; 2], inside: bool) -> Result<Vec<ParametricCurve<F>>, Error> {
        let (formula, kinks) = looked_at(formula, range)?;
        let [start, end] = [0.0, 2.0 * PI].map(|u| formula.at(u));
        let tabulated = TABULATED * formula.fineness;
        let whole = ArcLength::new(&*formula, (0..=tabulated).map(|k| part(k, tabulated)));
        let extent = whole.extent(&*formula);
        let near = CLOSED * (extent.max - extent.min).amax() + rounding(extent.size(), end[1]);
        if (end[0] - start[0]).amax() > near {
            return Err(failing(&formula, 2.0 * PI, ParametricRule::Closed));
        }
        let rises = (whole.enclosed_area(&*formula, start[0]) > 0.0) == inside;
        let turn = libm::atan2(start[1].perp(&end[1]), start[1].dot(&end[1]));
        if kinks.is_empty() && turn.abs() <= SMOOTH {
            return Ok(vec![ParametricCurve::new(&formula, [0.0, 2.0 * PI], [start[0]; 2], true, rises)?]);
        }
        ParametricCurve::cut(&formula, &kinks, [start[0]; 2], rises)
    }

    /// The arcs between the kinks of a curve that has ends, in the order of traversal, with the table on the left as `t` runs from the first
    /// parameter to the second, which may be less; `ends` are its points there as its neighbours have them.
    ///
    /// # Errors
    /// As [`around`](Self::around).
    pub fn along(
        formula: F,
        [start, end]: [f64; 2],
        ends: [Vector2<f64>; 2],
    ) -> Result<Vec<ParametricCurve<F>>, Error> {
        let rises = start < end;
        let (range, ends) = if rises { ([start, end], ends) } else { ([end, start], [ends[1], ends[0]]) };
        let (formula, kinks) = looked_at(formula, range)?;
        ParametricCurve::cut(&formula, &kinks, ends, rises)
    }

    /// The arcs between kinks.
    fn cut(
        formula: &Arc<InTurns<F>>,
        kinks: &[Interval],
        vertices: [Vector2<f64>; 2],
        rises: bool,
    ) -> Result<Vec<ParametricCurve<F>>, Error> {
        // a kink at an end is not seen from the other side
        let first = kinks.first().filter(|kink| kink.low <= NARROW).map_or(0.0, |kink| kink.high);
        let last = kinks.last().filter(|kink| kink.high >= 2.0 * PI - NARROW).map_or(2.0 * PI, |kink| kink.low);
        let inner = kinks.iter().filter(|kink| kink.low > NARROW && kink.high < 2.0 * PI - NARROW);
        // where each arc ends and the next one begins
        let mut cuts = vec![(0.0, first, vertices[0])];
        for (kink, vertex) in inner.clone().zip(inner_vertices(formula, inner, vertices)) {
            cuts.push((kink.low, kink.high, vertex));
        }
        cuts.push((last, 2.0 * PI, vertices[1]));
        let mut arcs = vec![];
        let mut add = |range: [f64; 2], ends: [Vector2<f64>; 2]| {
            arcs.push(ParametricCurve::new(formula, range, ends, false, rises)?);
            Ok(())
        };
        for ends in cuts.windows(2) {
            let [(_, low, a), (high, _, b)] = [ends[0], ends[1]];
            if a == b {
                // an arc needs two distinct ends
                let middle = 0.5 * (low + high);
                let [between, _] = formula.at(middle);
                add([low, middle], [a, between])?;
                add([middle, high], [between, b])?;
            } else {
                add([low, high], [a, b])?;
            }
        }
        if !rises {
            arcs.reverse();
        }
        Ok(arcs)
    }

    fn new(
        formula: &Arc<InTurns<F>>,
        range: [f64; 2],
        vertices: [Vector2<f64>; 2],
        is_closed: bool,
        rises: bool,
    ) -> Result<ParametricCurve<F>, Error> {
        let between = |share: f64| range[0] + (range[1] - range[0]) * share;
        let fineness = (range[1] - range[0]) / (2.0 * PI) * f64::from(formula.fineness);
        let count = libm::ceil(fineness * f64::from(TABULATED)).max(2.0);
        let seeds = (0..).map(f64::from).take_while(|k| *k < count).map(|k| between(k / count)).chain([range[1]]);
        let table = ArcLength::new(&**formula, seeds);
        if table.is_full() {
            return Err(Error::Winding);
        }
        if let Some(u) = table.endless() {
            return Err(failing(formula, u, ParametricRule::Finite));
        }
        let extent = table.extent(&**formula).union(Extent::of(vertices));
        let size = extent.size();
        let mut cuts: Vec<(f64, Vector2<f64>)> = vec![(range[0], vertices[0])];
        let stretches = libm::ceil(fineness * STRETCHES);
        let inner = (1..).map(f64::from).take_while(|k| *k < stretches).map(|k| between(k / stretches));
        // beyond these the formula itself is used
        let beside = formula.cusps.iter().flat_map(|cusp| [cusp.around().low, cusp.around().high]);
        let mut inner: Vec<f64> = inner.chain(beside.filter(|u| range[0] < *u && *u < range[1])).collect();
        inner.sort_by(f64::total_cmp);
        cuts.extend(inner.into_iter().map(|u| (u, formula.at(u)[0])));
        cuts.push((range[1], vertices[1]));
        if !rises {
            cuts.reverse();
        }
        let mut graphs = vec![];
        for ends in cuts.windows(2) {
            let parameters = [ends[0].0, ends[1].0];
            let vertices = [ends[0].1, ends[1].1];
            let middle = 0.5 * (parameters[0] + parameters[1]);
            let some = match formula.cusp(middle) {
                Some(cusp) => cusp.graphs(&|u| formula.as_written(u)[2], parameters, vertices, size),
                None => rough_graphs(&**formula, parameters, vertices, size),
            };
            graphs.extend(some.ok_or_else(|| failing(formula, parameters[0], ParametricRule::Smooth))?);
        }
        let swept = table.enclosed_area(&**formula, vertices[0]);
        let area = if rises { swept } else { -swept };
        let formula = Arc::clone(formula);
        Ok(ParametricCurve {
            formula,
            range,
            vertices,
            is_closed,
            rises,
            graphs,
            table,
            area,
            extent,
            slack: slack([size]),
        })
    }

    /// The formula.
    pub fn formula(&self) -> &F {
        &self.formula.formula
    }

    /// The point at a parameter in turns, and the normal there.
    fn at_parameter(&self, u: f64) -> Landing {
        let [point, along] = self.formula.at(u);
        let speed = libm::hypot(along.x, along.y) * if self.rises { 1.0 } else { -1.0 };
        let end = self.range.iter().position(|end| *end == u);
        Landing { point: end.map_or(point, |end| self.vertices[end]), normal: Vector2::new(-along.y, along.x) / speed }
    }

    fn parameter_of(&self, point: &Vector2<f64>) -> f64 {
        self.table.closest(&*self.formula, point)
    }

    /// From arc length along rising parameters to arc length in the sense of traversal, and back.
    fn traversed(&self, s: f64) -> f64 {
        if self.rises { s } else { self.table.length() - s }
    }
}

/// The points at kinks; where the curve comes back to one of them, or to an end, it is exactly the same point, and not one next to it.
fn inner_vertices<'a, F: ParametricFormula>(
    formula: &InTurns<F>,
    kinks: impl Iterator<Item = &'a Interval>,
    ends: [Vector2<f64>; 2],
) -> Vec<Vector2<f64>> {
    let size = (0..SIZED).map(|k| formula.at(part(k, SIZED))[0].amax()).fold(0.0, f64::max);
    let mut known = ends.to_vec();
    kinks
        .map(|kink| {
            let [vertex, rate] = formula.at(0.5 * (kink.low + kink.high));
            let near = rounding(size, rate);
            let vertex = known.iter().copied().find(|p| (p - vertex).amax() <= near).unwrap_or(vertex);
            known.push(vertex);
            vertex
        })
        .collect()
}

/// How far rounding moves a point of a curve with coordinates up to `size`, where its derivative is `rate` \[L\].
fn rounding(size: f64, rate: Vector2<f64>) -> f64 {
    4.0 * slack([size]) + NARROW * rate.amax()
}

/// A formula with its range rescaled to one turn, and its kinks.
fn looked_at<F: ParametricFormula>(
    formula: F,
    [start, end]: [f64; 2],
) -> Result<(Arc<InTurns<F>>, Vec<Interval>), Error> {
    let length = end - start;
    if !(length > 0.0 && length.is_finite()) {
        return Err(Error::Parameter { name: "range", must: "of positive and finite length", value: length });
    }
    // if the range is one turn, parameters stay exactly as they are
    let rate = if length == 2.0 * PI { 1.0 } else { length / (2.0 * PI) };
    let mut formula = InTurns { formula, start, end, rate, fineness: 1, cusps: vec![] };
    let mut size = 0.0_f64;
    for u in (0..=PARTS).map(|k| part(k, PARTS)) {
        let [c, ..] = formula.jet(u);
        if !c.iter().all(|x| x.is_finite()) {
            return Err(failing(&formula, u, ParametricRule::Finite));
        }
        size = size.max(c.amax());
    }
    let told = FINER.into_iter().map(|fineness| (fineness, kinks_of(&formula, fineness, size)));
    let mut kinks = Err(0.0);
    for (fineness, found) in told {
        kinks = found;
        if kinks.is_ok() {
            formula.fineness = fineness;
            break;
        }
    }
    let mut kinks = kinks.map_err(|u| match endless_rate(&formula, size) {
        Some(u) => failing(&formula, u, ParametricRule::FiniteRate),
        None => failing(&formula, u, ParametricRule::FewKinks),
    })?;
    // near a kink the bounds are those of both sides
    let at_kink = |u: Interval| kinks.iter().any(|kink| u.low <= kink.high + NARROW && kink.low - NARROW <= u.high);
    let moves = |u: Interval| {
        let [_, first, _] = formula.jet_over(u);
        (u.width() <= NARROW && at_kink(u)) || !first.iter().all(|x| x.contains(0.0))
    };
    let standing = places((0..PARTS).map(|k| sector(k, PARTS)), moves, MOST_PARTS);
    let standing = standing.ok_or_else(|| failing(&formula, 0.0, ParametricRule::Moving))?;
    // the ends of a range are rounded, and it may stand still just beyond them
    let stands_at = |u: &f64| {
        let [_, first, second] = formula.jet(*u);
        first.norm() <= NARROW * second.norm()
    };
    let within = standing.into_iter().map(|place| 0.5 * (place.low + place.high));
    let [start, end] = [0.0, 2.0 * PI].map(|end| Some(end).filter(stands_at));
    let mut cusps: Vec<Cusp> = vec![];
    for at in start.into_iter().chain(within).chain(end) {
        // a place close to the last cusp belongs to it
        if cusps.last().is_some_and(|last| last.around().contains(at)) {
            continue;
        }
        let cusp = Cusp::of(|u| formula.jet(u), |u| formula.jet_over(u)[2], at, size);
        cusps.push(cusp.ok_or_else(|| failing(&formula, at, ParametricRule::Moving))?);
    }
    kinks.extend(cusps.iter().map(Cusp::place));
    kinks.sort_by(|a, b| a.low.total_cmp(&b.low));
    formula.cusps = cusps;
    Ok((Arc::new(formula), kinks))
}

/// The kinks found with `fineness` times [`PARTS`] parts, given the size of the curve; or else about where something else is rough.
fn kinks_of<F: ParametricFormula>(formula: &InTurns<F>, fineness: u32, size: f64) -> Result<Vec<Interval>, f64> {
    let parts = PARTS * fineness;
    let jets: Vec<_> = (0..parts).map(|k| formula.jet_over(sector(k, parts))).collect();
    // except at kinks, the second derivative may not vary much within a part
    let most = |x: &[Interval; 2]| x[0].magnitude().max(x[1].magnitude());
    let bends = jets.iter().map(|[_, first, second]| most(second).max(most(first)));
    let scale = Scale { calm: 0.25 * bends.filter(|bend| bend.is_finite()).fold(0.0, f64::max), size };
    let widest = |x: &[Interval; 2]| x[0].width().max(x[1].width());
    let variation =
        |[_, first, second]: &[[Interval; 2]; 3]| Variation { first: widest(first), second: widest(second) };
    let is_calm = |jet: &[[Interval; 2]; 3]| variation(jet).second <= scale.calm;
    let rough = (0..parts).zip(&jets).filter(|(_, jet)| !is_calm(jet)).map(|(k, _)| sector(k, parts));
    kinks(rough, |over| variation(&formula.jet_over(over)), scale, MOST_PARTS)
}

/// Rates of this many times the size per turn, next to a place where no bound on them is known, are taken as unbounded: that of a square
/// root, [`NARROW`] beside its end, is 10⁷ times the size; slopes beside kinks, and those of formulas that bend as sharply as allowed, are
/// less than 10⁴ times.
const ENDLESS: f64 = 65_536.0;

/// About where the first derivative has no bound.
fn endless_rate<F: ParametricFormula>(formula: &InTurns<F>, size: f64) -> Option<f64> {
    let is_open = |part: &Interval| formula.jet_over(*part)[1].iter().any(|x| !x.magnitude().is_finite());
    let place = |mut part: Interval| {
        while part.width() > NARROW {
            part = part.halves().into_iter().find(is_open)?;
        }
        // not at the place itself, but beside it
        let rates = [part.low - NARROW, part.high + NARROW].map(|u| formula.jet(u.clamp(0.0, 2.0 * PI))[1].amax());
        rates.iter().any(|rate| *rate > ENDLESS * size).then_some(part.low)
    };
    (0..PARTS).map(|k| sector(k, PARTS)).filter(is_open).find_map(place)
}

fn failing<F: ParametricFormula>(formula: &InTurns<F>, u: f64, must: ParametricRule) -> Error {
    Error::Parametrised { must, parameter: formula.parameter(u) }
}

impl<F: ParametricFormula + 'static> Piece for ParametricCurve<F> {
    fn crossing(&self, path: &Line<2>) -> Crossing {
        let aimed = Aimed::new(path.point.into(), path.velocity.into());
        let times = self.graphs.iter().map(|graph| graph.time(&aimed, self.slack));
        Crossing { num: times.fold(f64::INFINITY, f64::min), den: 1.0 }
    }
    fn landing(&self, path: &Line<2>, time: f64) -> Landing {
        self.closest(&path.at(time))
    }
    fn curvature(&self, point: &Vector2<f64>) -> f64 {
        let [_, first, second] = self.formula.jet(self.parameter_of(point));
        let speed = libm::hypot(first.x, first.y);
        let curvature = (first / speed).perp(&(second / speed)) / speed;
        if self.rises { curvature } else { -curvature }
    }
    fn length(&self) -> f64 {
        self.table.length()
    }
    fn point_at(&self, s: f64) -> Vector2<f64> {
        self.landing_at(s).point
    }
    fn landing_at(&self, s: f64) -> Landing {
        let length = self.length();
        let s = if self.is_closed { once_around(s, length) } else { s };
        self.at_parameter(self.table.parameter(&*self.formula, self.traversed(s)))
    }
    fn arc_length_at(&self, point: &Vector2<f64>) -> f64 {
        self.traversed(self.table.at_parameter(&*self.formula, self.parameter_of(point)))
    }
    fn closest(&self, point: &Vector2<f64>) -> Landing {
        self.at_parameter(self.parameter_of(point))
    }
    fn ends(&self) -> Option<[Vector2<f64>; 2]> {
        let [low, high] = self.vertices;
        let ends = if self.rises { [low, high] } else { [high, low] };
        (!self.is_closed).then_some(ends)
    }
    fn extent(&self) -> Extent {
        self.extent
    }
    fn graphs(&self) -> Option<Vec<Graph>> {
        Some(self.graphs.clone())
    }
    fn shift(&self) -> f64 {
        // ε/2 for the rounding of the parameter, and as much for that of its first product in the formula
        let farthest = self.range.map(|u| self.formula.parameter(u).abs()).into_iter().fold(0.0, f64::max);
        f64::EPSILON * farthest * (self.table.fastest() / self.formula.rate)
    }
    fn area(&self) -> f64 {
        self.area
    }
}
