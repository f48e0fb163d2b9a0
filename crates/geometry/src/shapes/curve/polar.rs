//! A closed curve given by a radius for every direction.
use super::{
    ArcLength, Graph, Interval, Parametric, PolarArc, PolarPoints, Smooth,
    bends::{Bends, cut},
    first_rise, hidden,
    jump::jump,
    ranges::Ranges,
    rough_graphs,
    seeds::seeds,
};
use crate::{
    Error,
    crossing::Crossing,
    path::Line,
    piece::{Extent, Landing, Piece},
    plane::{finite, once_around, slack},
};
use core::f64::consts::{FRAC_PI_2, PI};
use core::fmt::Debug;
use nalgebra::Vector2;
use std::sync::OnceLock;

/// A radius `r(φ) > 0` as a function of the polar angle: twice differentiable except at kinks, with period 2π.
///
/// At a kink `r′` may be either one-sided slope, and over an interval that contains a kink `r″` has no bound: [`Interval::ENTIRE`].
///
/// Both functions are required. `jet_over` is what makes the first hit certain: write the same three formulas with
/// [`Interval`]s.
///
/// ```
/// use geometry::{Piece, Vector2, shapes::curve::{Interval, Polar, PolarFormula}};
///
/// /// `r = 1 + a cos 3φ`
/// #[derive(Debug)]
/// struct Clover {
///     a: f64,
/// }
/// impl PolarFormula for Clover {
///     fn jet(&self, angle: f64) -> [f64; 3] {
///         let (sin, cos) = (libm::sin(3.0 * angle), libm::cos(3.0 * angle));
///         [1.0 + self.a * cos, -3.0 * self.a * sin, -9.0 * self.a * cos]
///     }
///     fn jet_over(&self, angle: Interval) -> [Interval; 3] {
///         let (sin, cos) = ((angle * 3.0).sin(), (angle * 3.0).cos());
///         [cos * self.a + 1.0, sin * (-3.0 * self.a), cos * (-9.0 * self.a)]
///     }
/// }
/// let table = Polar::new(Vector2::zeros(), Clover { a: 0.1 }, true)?;
/// assert!((table.area() - core::f64::consts::PI * (1.0 + 0.005)).abs() < 1e-14); // π (1 + a²/2)
/// # Ok::<(), geometry::Error>(())
/// ```
pub trait PolarFormula: Debug + Send + Sync {
    /// `r`, `r′` and `r″` \[L\] at any angle (radians, not reduced to one turn).
    fn jet(&self, angle: f64) -> [f64; 3];

    /// Intervals that contain `r`, `r′` and `r″` everywhere between two angles; the narrower, the faster.
    fn jet_over(&self, angle: Interval) -> [Interval; 3];
}

impl<F: PolarFormula> PolarFormula for &F {
    fn jet(&self, angle: f64) -> [f64; 3] {
        (**self).jet(angle)
    }
    fn jet_over(&self, angle: Interval) -> [Interval; 3] {
        (**self).jet_over(angle)
    }
}

/// The curve `c + r(φ) (cos φ, sin φ)`, with the table inside or outside.
///
/// A path at distance `d` from the centre has `ρ cos ψ = d`, where `ψ` is the angle from the foot of the perpendicular,
/// so it is inside where `d − r(φ) cos ψ < 0`: a smooth function of an angle that runs over less than a turn, whatever
/// the path. [`first_rise`] finds its first root.
///
/// Traversed from `φ = 0`: counter-clockwise with the table inside, clockwise with it outside.
#[derive(Clone, Debug)]
pub struct Polar<F> {
    center: Vector2<f64>,
    formula: F,
    inside: bool,
    slack: f64,
    ranges: Ranges,
    /// The kinks of the curve, if nothing else can hide between its points.
    kinks: Option<Vec<Interval>>,
    /// Factor by which more points of an arc are needed, as its waves are shorter than others.
    fineness: u32,
    table: ArcLength,
    area: f64,
    extent: Extent,
    /// Computed when first needed.
    graphs: OnceLock<Option<Vec<Graph>>>,
}

/// Sectors in which `r > 0` must be provable.
const SECTORS: u32 = 4096;

/// Most parts of one width that kinks are looked for in: two about each of 2000 kinks. A formula with more varies everywhere, and its parts
/// would be halved without end.
const MOST_PARTS: usize = 4096;

/// Most parts of a sector for each of which that must be provable, where it is not provable for the whole.
const FINEST: u32 = 1024;

/// Parts of a sector in which kinks are looked for where sectors are too wide for what lies between kinks: 16 for the waves of 2000 kinks,
/// 64 for narrow features.
const FINER: [u32; 3] = [4, 16, 64];

/// Most parts in that case: in waves so short the rounding of angles makes eight parts around each of 2000 kinks doubtful.
const FINER_PARTS: usize = 16_384;

/// The point where a path meets the curve is off it by no more than this many times the rounding of coordinates: its own rounding, and that
/// of the time, which comes from a formula.
const BESIDE: f64 = 64.0;

/// The normal of a curve turns by less than this (radians) over the distance that rounding shifts a point along it; its square is below
/// rounding.
const NEAR: f64 = 1e-8;

/// No graph of a curve with a fineness above 1 is wider than this divided by the fineness (radians); few graphs are wider even where
/// sectors are fine enough.
const WIDEST: f64 = 0.5;

/// A radius has an extremum between two angles if it rises, or falls, to them from this many times their distance on both sides.
const AROUND: f64 = 64.0;

/// The error that the angle 2π may have in a formula (radians): some ulp.
const SEAM: f64 = 16.0 * f64::EPSILON;

impl<F: PolarFormula> Polar<F> {
    /// The curve about `center`, with the table inside (`inside`) or outside.
    ///
    /// # Errors
    /// [`Error::PolarRadius`] unless `r` is finite and provably positive (where it reaches 0 use [`PolarPoints`]), [`Error::Unclosed`]
    /// unless it is the same after a whole turn (to 10⁻⁹), [`Error::PolarJump`] where it jumps within one, [`Error::PolarSlope`] where `r′`
    /// is not a number, so that the curve has no length or no normal, [`Error::PolarKink`] at a kink that the bounds on `r″` do not reveal,
    /// [`Error::Winding`] for thousands of waves, and [`Error::Parameter`] for a centre that is not finite.
    pub fn new(center: Vector2<f64>, formula: F, inside: bool) -> Result<Polar<F>, Error> {
        finite("center", &center)?;
        let whole = |k: u32| 2.0 * PI * (f64::from(k) / f64::from(SECTORS));
        let sector = |k: u32| Interval::new(whole(k), whole(k + 1));
        let jets: Vec<_> = (0..SECTORS).map(|k| enclosures(&formula, sector(k))).collect();
        let doubtful = (0..SECTORS).zip(&jets).filter(|(_, jet)| !are_radii(jet));
        let middles = doubtful.map(|(k, [bounds, ..])| (0.5 * (whole(k) + whole(k + 1)), bounds));
        let values = middles.map(|(angle, bounds)| (angle, bounds, formula.jet(angle)[0]));
        // report an angle at which r is not a radius rather than one near which it might not be
        if let Some((angle, bounds, r)) = values.min_by_key(|(.., r)| is_radius(*r)) {
            let bound = if bounds.low > 0.0 { bounds.high } else { bounds.low };
            let certain = !is_radius(r);
            return Err(Error::PolarRadius { angle, radius: if certain { r } else { bound }, certain });
        }
        let greatest = jets.iter().fold(0.0_f64, |m, [r, ..]| m.max(r.high));
        let [start, end] = [0.0, 2.0 * PI].map(|angle| formula.jet(angle)[0]);
        // the angle 2π is rounded, and formulas may multiply it; not rounding is a jump that is visible and, where the slope is unbounded,
        // also larger than the effect of a rounded angle
        let rounding = 1e-9 * greatest;
        let [before, _, _] = formula.jet(2.0 * PI - SEAM);
        if (start - end).abs() > rounding.max(2.0 * (end - before).abs()) || end.is_nan() {
            return Err(Error::Unclosed { start, end });
        }
        let sectors: Vec<_> = (0..SECTORS).map(sector).zip(jets.iter().copied()).collect();
        if let Some(Interval { low, high }) = jump(&formula, &sectors, rounding) {
            let [before, after] = [low, high].map(|angle| formula.jet(angle)[0]);
            return Err(Error::PolarJump { angle: low, before, after });
        }
        let slack = slack([center.x, center.y, greatest]);
        let points = PolarPoints { center, formula: &formula };
        let table = ArcLength::new(&points, seeds(&sectors, |part| formula.jet_over(part), greatest));
        if table.is_full() {
            return Err(Error::Winding);
        }
        // ½ ∮ r² dφ: about another point the integrand would jump at kinks
        let area = table.enclosed_area(&points, center);
        let extent = table.extent(&points);
        let mut bends = Bends::new(&formula, sectors.clone());
        let told = bends.kinks(MOST_PARTS).map(|kinks| (kinks, 1));
        // for a curve that is cut at its kinks no normals are needed there
        let undirected = || table.parameters().find(|angle| formula.jet(*angle)[1].is_nan());
        if let Some(angle) = table.endless().or_else(|| if told.is_none() { undirected() } else { None }) {
            return Err(Error::PolarSlope { angle });
        }
        let hidden = if told.is_none() { hidden::kink(&formula, &sectors) } else { None };
        let told = told.or_else(|| {
            FINER.into_iter().find_map(|n| {
                let found =
                    if hidden.is_some() { bends.hidden_kinks(n, FINER_PARTS) } else { bends.closer(FINER_PARTS) };
                found.map(|kinks| (kinks, n))
            })
        });
        if let (None, Some(angle)) = (&told, hidden) {
            return Err(Error::PolarKink { angle });
        }
        let fineness = told.as_ref().map_or(1, |(_, n)| *n);
        let kinks = told.map(|(kinks, _)| kinks);
        let (ranges, graphs) = (Ranges::new(&jets), OnceLock::new());
        Ok(Polar { center, formula, inside, slack, ranges, kinks, fineness, table, area, extent, graphs })
    }

    /// The curve as pieces of a table: the curve itself if it is smooth, or else the arcs between its kinks, in the order of traversal.
    ///
    /// ```
    /// use geometry::{Piece, Vector2, shapes::curve::{Interval, Polar, PolarFormula}};
    ///
    /// /// `r = 2 − |cos φ|`, two arcs of limaçons
    /// #[derive(Clone, Debug)]
    /// struct Limacons;
    /// impl PolarFormula for Limacons {
    ///     fn jet(&self, angle: f64) -> [f64; 3] {
    ///         let (sin, cos) = libm::sincos(angle);
    ///         [2.0 - cos.abs(), sin.copysign(sin * cos), cos.abs()]
    ///     }
    ///     fn jet_over(&self, angle: Interval) -> [Interval; 3] {
    ///         let [sin, cos] = angle.sin_cos();
    ///         if cos.contains(0.0) {
    ///             // the slope jumps: of its derivative there is no bound
    ///             return [-cos.abs() + 2.0, sin.union(-sin), Interval::ENTIRE];
    ///         }
    ///         let sign = libm::copysign(1.0, cos.low);
    ///         [-cos.abs() + 2.0, sin * sign, cos.abs()]
    ///     }
    /// }
    /// let arcs = Polar::new(Vector2::zeros(), Limacons, true)?.pieces();
    /// assert_eq!(arcs.len(), 2);
    /// assert!((arcs[0].point_at(0.0) - Vector2::new(0.0, 2.0)).norm() < 1e-15);
    /// # Ok::<(), geometry::Error>(())
    /// ```
    pub fn pieces(self) -> Vec<Box<dyn Piece>>
    where
        F: Clone + 'static,
    {
        match self.kinks.as_deref() {
            Some(kinks) if !kinks.is_empty() => {
                let kinks = kinks.to_vec();
                PolarArc::between(self, &kinks)
            }
            _ => vec![Box::new(self)],
        }
    }

    /// The formula.
    pub fn formula(&self) -> &F {
        &self.formula
    }

    /// Whether the table lies inside.
    pub(super) fn is_inside(&self) -> bool {
        self.inside
    }

    /// A pair for two angles, given with the lower angle first, in the order of traversal.
    pub(super) fn in_sense<T>(&self, [low, high]: [T; 2]) -> [T; 2] {
        if self.inside { [low, high] } else { [high, low] }
    }

    pub(super) fn points(&self) -> PolarPoints<&F> {
        PolarPoints { center: self.center, formula: &self.formula }
    }

    /// The graphs between two angles, so short that nothing hides between the points from which they are made.
    pub(super) fn graphs_between(
        &self,
        [low, high]: [f64; 2],
        vertices: [Vector2<f64>; 2],
        size: f64,
    ) -> Option<Vec<Graph>> {
        let points = self.points();
        let stretches =
            if self.fineness == 1 { 1.0 } else { libm::ceil((high - low) * f64::from(self.fineness) / WIDEST) };
        let mut cuts = vec![(low, vertices[0])];
        let mut k = 1.0;
        while k < stretches {
            let angle = low + (high - low) * (k / stretches);
            cuts.push((angle, self.at_angle(angle).point));
            k += 1.0;
        }
        cuts.push((high, vertices[1]));
        if !self.inside {
            cuts.reverse();
        }
        let mut graphs = vec![];
        for ends in cuts.windows(2) {
            graphs.extend(rough_graphs(&points, [ends[0].0, ends[1].0], [ends[0].1, ends[1].1], size)?);
        }
        Some(graphs)
    }

    /// The polar angle of a point.
    pub(super) fn angle(&self, point: &Vector2<f64>) -> f64 {
        let y = point - self.center;
        libm::atan2(y.y, y.x)
    }

    /// The point at an angle, and the normal there.
    pub(super) fn at_angle(&self, angle: f64) -> Landing {
        let (sin, cos) = libm::sincos(angle);
        self.towards(angle, Vector2::new(cos, sin))
    }

    /// The point at an angle, that of the unit vector `radial`, and the normal there.
    fn towards(&self, angle: f64, radial: Vector2<f64>) -> Landing {
        let [r, slope, _] = self.formula.jet(angle);
        // the tangent is r′ e_r + r e_φ, counter-clockwise; the table lies on the left of it if it lies inside
        let tangent = radial * slope + Vector2::new(-radial.y, radial.x) * r;
        let speed = libm::hypot(slope, r) * if self.inside { 1.0 } else { -1.0 };
        Landing { point: self.center + radial * r, normal: Vector2::new(-tangent.y, tangent.x) / speed }
    }

    /// The tip of a cusp that lies between two angles some ulp apart; `None` for anything else.
    ///
    /// At a rounded angle `|sin φ|ᵖ` is not 0 but `ε^p`. At the tip `r` is extreme, and bounds on it over an interval around the tip contain
    /// that value. (So may bounds that are too wide, beyond a kink; but the radius does not rise towards those.)
    pub(super) fn tip(&self, place: Interval) -> Option<Vector2<f64>> {
        let [r, slope, _] = self.formula.jet_over(place);
        let Interval { low, high } = place;
        let room = AROUND * place.width();
        let [far_before, before, after, far_after] =
            [low - room, low, high, high + room].map(|angle| self.formula.jet(angle)[0]);
        let radius = if far_before < before && far_after < after { r.high } else { r.low };
        let beyond = (radius - before).abs().min((radius - after).abs());
        let is_extreme = (far_before - before) * (far_after - after) > 0.0;
        let is_tip = !slope.magnitude().is_finite() && is_extreme && is_radius(radius) && beyond > slack([radius]);
        let (sin, cos) = libm::sincos(0.5 * (low + high));
        is_tip.then(|| self.center + Vector2::new(cos, sin) * radius)
    }

    /// The curvature at an angle, as [`Piece::curvature`].
    pub(super) fn curvature_at(&self, angle: f64) -> f64 {
        let [r, slope, second] = self.formula.jet(angle);
        let speed = libm::hypot(r, slope);
        // (r² + 2 r′² − r r″) / (r² + r′²)^{3/2}
        let curvature = ((r / speed) * ((r - second) / speed) + 2.0 * (slope / speed) * (slope / speed)) / speed;
        if self.inside { curvature } else { -curvature }
    }

    /// From arc length counter-clockwise to arc length in the sense of traversal, and back.
    fn traversed(&self, s: f64) -> f64 {
        if self.inside || s == 0.0 { s } else { self.table.length() - s }
    }
}

fn is_radius(r: f64) -> bool {
    r > 0.0 && r.is_finite()
}

fn are_radii([r, ..]: &[Interval; 3]) -> bool {
    r.low > 0.0 && r.high.is_finite()
}

/// Enclosures of `r`, `r′` and `r″` in a sector, from as many parts of it as are needed to prove `r > 0`, where it seems to hold.
fn enclosures<F: PolarFormula>(formula: &F, sector: Interval) -> [Interval; 3] {
    let mut jet = formula.jet_over(sector);
    let middle = 0.5 * (sector.low + sector.high);
    let mut parts = 4;
    while !are_radii(&jet) && parts <= FINEST && is_radius(formula.jet(middle)[0]) {
        let jets = cut(sector, parts).map(|part| formula.jet_over(part));
        jet = jets.reduce(|a, b| [0, 1, 2].map(|i| a[i].union(b[i]))).unwrap_or(jet);
        parts *= 4;
    }
    jet
}

/// `±(d − r(φ) cos ψ) |v|` along a path, as a function of `ψ`, with `φ = φᵥ + σ (ψ − π/2)`.
struct Sweep<'a, F> {
    formula: &'a F,
    ranges: &'a Ranges,
    /// `d |v|`
    moment: f64,
    speed: f64,
    /// The direction of the velocity.
    heading: f64,
    /// +1 where the path passes the centre counter-clockwise, −1 clockwise.
    sense: f64,
    /// +1 with the table inside, −1 outside.
    side: f64,
}

impl<F: PolarFormula> Sweep<'_, F> {
    fn angle(&self, psi: f64) -> f64 {
        self.heading + self.sense * (psi - FRAC_PI_2)
    }

    /// Enclosures of `r`, `r′` and `r″`.
    fn over(&self, psi: Interval) -> [Interval; 3] {
        self.ranges.of(self.formula, Interval::new(self.angle(psi.low), self.angle(psi.high)))
    }
}

impl<F: PolarFormula> Smooth for Sweep<'_, F> {
    fn jet(&self, psi: f64) -> [f64; 2] {
        let [r, slope, _] = self.formula.jet(self.angle(psi));
        let (sin, cos) = libm::sincos(psi);
        let rate = r * sin - self.sense * slope * cos;
        [self.side * (self.moment - r * cos * self.speed), self.side * rate * self.speed]
    }

    fn first_derivative(&self, over: Interval) -> Interval {
        let [r, slope, _] = self.over(over);
        let [sin, cos] = over.sin_cos();
        (r * sin - slope * cos * self.sense) * (self.side * self.speed)
    }

    fn value(&self, over: Interval) -> Interval {
        let [r, ..] = self.over(over);
        (r * over.cos() * -self.speed + self.moment) * self.side
    }

    fn second_derivative(&self, over: Interval) -> Interval {
        let [r, slope, second] = self.over(over);
        let [sin, cos] = over.sin_cos();
        let bend = (r - second) * cos + slope * sin * (2.0 * self.sense);
        bend * (self.side * self.speed)
    }
}

impl<F: PolarFormula> Piece for Polar<F> {
    fn crossing(&self, path: &Line<2>) -> Crossing {
        let (y, v) = (path.point - self.center, path.velocity);
        let speed = v.norm();
        if speed == 0.0 {
            return Crossing::NEVER;
        }
        let (moment, ahead) = (y.perp(&v), y.dot(&v));
        let sweep = Sweep {
            formula: &self.formula,
            ranges: &self.ranges,
            moment: moment.abs(),
            speed,
            heading: libm::atan2(v.y, v.x),
            sense: if moment < 0.0 { -1.0 } else { 1.0 },
            side: if self.inside { 1.0 } else { -1.0 },
        };
        // a little more than a right angle: a path through the centre meets the curve at π/2 exactly
        let over = Interval { low: libm::atan2(ahead, moment.abs()), high: FRAC_PI_2 + 0.125 };
        let Some(psi) = first_rise(&sweep, over, self.slack * speed) else { return Crossing::NEVER };
        let [r, ..] = self.formula.jet(sweep.angle(psi));
        let way = r * libm::sin(psi) * speed - ahead;
        if way < -self.slack * speed {
            return Crossing::NEVER;
        }
        // the angles have rounded the position: one step of Newton's method for ρ = r(φ), if it is no larger than rounding
        let square = v.norm_squared();
        let p = y + v * (way / square);
        let [r, slope, _] = self.formula.jet(libm::atan2(p.y, p.x));
        let distance = libm::hypot(p.x, p.y);
        let rate = (p.dot(&v) - slope * p.perp(&v) / distance) / distance;
        let step = (distance - r) / rate * square;
        let way = if step.abs() <= self.slack * speed { way - step } else { way };
        Crossing { num: way.max(0.0), den: square }
    }
    /// The rounding error of the path's point off the curve is corrected along the normal; moving straight to the centre would shift the
    /// point along a flank by the error times `r′/r`. The normal is turned accordingly.
    fn landing(&self, path: &Line<2>, time: f64) -> Landing {
        let y = path.at(time) - self.center;
        let distance = libm::hypot(y.x, y.y);
        let angle = libm::atan2(y.y, y.x);
        let straight = self.towards(angle, if distance > 0.0 { y / distance } else { Vector2::x() });
        let off = self.center + y - straight.point;
        let normal = straight.normal;
        let across = off.dot(&normal);
        let along = off - normal * across;
        let turn = self.curvature_at(angle) * Vector2::new(normal.y, -normal.x).dot(&along);
        // only next to the curve, and not at the tip of a cusp
        let is_near = across.abs() <= BESIDE * self.slack && turn.abs() <= NEAR;
        if !is_near {
            return straight;
        }
        Landing { point: straight.point + along, normal: normal - Vector2::new(normal.y, -normal.x) * turn }
    }
    fn curvature(&self, point: &Vector2<f64>) -> f64 {
        self.curvature_at(self.angle(point))
    }
    fn length(&self) -> f64 {
        self.table.length()
    }
    fn point_at(&self, s: f64) -> Vector2<f64> {
        self.landing_at(s).point
    }
    fn landing_at(&self, s: f64) -> Landing {
        let s = once_around(s, self.length());
        self.at_angle(self.table.parameter(&self.points(), self.traversed(s)))
    }
    fn arc_length_at(&self, point: &Vector2<f64>) -> f64 {
        let angle = self.table.closest(&self.points(), point);
        self.traversed(self.table.at_parameter(&self.points(), angle))
    }
    fn closest(&self, point: &Vector2<f64>) -> Landing {
        let landing = self.at_angle(self.table.closest(&self.points(), point));
        let off = point - landing.point;
        let distance = libm::hypot(off.x, off.y);
        let y = point - self.center;
        let [r, ..] = self.formula.jet(libm::atan2(y.y, y.x));
        let side = if (libm::hypot(y.x, y.y) < r) == self.inside { 1.0 } else { -1.0 };
        // at the tip of a cusp the normal does not determine the side, but the radius does
        let misled = distance > self.slack && landing.normal.dot(&off) * side < 0.0;
        if misled { Landing { normal: off * (side / distance), ..landing } } else { landing }
    }
    fn ends(&self) -> Option<[Vector2<f64>; 2]> {
        None
    }
    fn extent(&self) -> Extent {
        self.extent
    }
    fn graphs(&self) -> Option<Vec<Graph>> {
        if self.kinks.as_ref().is_none_or(|kinks| !kinks.is_empty()) {
            return None;
        }
        let start = self.points().at(0.0)[0];
        let cut = || self.graphs_between([0.0, 2.0 * PI], [start; 2], self.extent.size());
        self.graphs.get_or_init(cut).clone()
    }
    fn area(&self) -> f64 {
        if self.inside { self.area } else { -self.area }
    }
}
