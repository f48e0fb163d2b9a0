//! A place where a curve given by its points turns back.
use super::{Graph, Interval, Parametric, arc_length::GAUSS, rough_graphs};
use core::f64::consts::PI;
use nalgebra::Vector2;

/// A cusp must be the only one within this many times the distance on which its points coincide up to rounding.
const ALONE: f64 = 256.0;

/// Greatest distance over which `c″` is integrated: there the rounding of directions has decreased to that of ordinary formulas.
const WIDEST: f64 = 0.0625;

/// Rules whose relative difference is less than this are exact up to the rounding of the formula.
const AGREE: f64 = 64.0 * f64::EPSILON;

/// A cusp: `c′ = 0` and `c″ ≠ 0`, as for `(t², t³)` at 0.
///
/// Near it the terms of a formula's derivative cancel, so that directions have a rounding error of `ε/τ` at a parameter distance `τ`. There
/// `c′ = τ ∫₀¹ c″(sτ) ds` and `c = p + τ² ∫₀¹ (1−s) c″(sτ) ds`, where nothing cancels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cusp {
    at: f64,
    point: Vector2<f64>,
    /// `c″` at the tip.
    second: Vector2<f64>,
    /// Parameter distance from the tip up to which points coincide with the tip within rounding.
    tip: f64,
    /// Parameter distance up to which `c″` is integrated.
    reach: f64,
}

impl Cusp {
    /// The cusp at a parameter from 0 to 2π at which `c′` vanishes up to rounding, given the curve and bounds on its second derivative;
    /// `size` \[L\] is that of its coordinates. `None` if it is no cusp, or if the bounds do not show that there is only one here.
    pub(super) fn of(
        jet: impl Fn(f64) -> [Vector2<f64>; 3],
        second_over: impl Fn(Interval) -> [Interval; 2],
        at: f64,
        size: f64,
    ) -> Option<Cusp> {
        let within = |u: f64| u.clamp(0.0, 2.0 * PI);
        // the middle of where it vanishes
        let [_, first, second] = jet(at);
        let at = within(at - first.dot(&second) / second.norm_squared());
        let [point, _, second] = jet(at);
        let tip = libm::sqrt(f64::EPSILON * size / second.norm());
        // if a coordinate's second derivative keeps its sign, its first vanishes only once
        let is_alone = |reach: f64| {
            let bend = second_over(Interval::new(within(at - reach), within(at + reach)));
            !bend.iter().all(|x| x.contains(0.0))
        };
        let is_smooth = |reach: f64| {
            [-reach, reach].into_iter().map(|tau| within(at + tau) - at).all(|tau| {
                let mean = |from: f64, tau: f64| means(&|u| jet(u)[2], from, tau)[0];
                let (whole, halves) = (mean(at, tau), 0.5 * (mean(at, 0.5 * tau) + mean(at + 0.5 * tau, 0.5 * tau)));
                (whole - halves).norm() <= AGREE * whole.norm()
            })
        };
        let reaches = (0..).map(|k| libm::ldexp(WIDEST, -k)).take_while(|reach| ALONE * tip < *reach);
        let reach = reaches.take(64).find(|reach| is_alone(*reach) && is_smooth(*reach))?;
        Some(Cusp { at, point, second, tip, reach })
    }

    /// The tip as an interval, whose ends are the end of the arc before it and the start of the arc after it.
    pub(super) fn place(&self) -> Interval {
        Interval::new(self.at - self.tip, self.at + self.tip)
    }

    /// Where `c″` is integrated.
    pub(super) fn around(&self) -> Interval {
        Interval::new(self.at - self.reach, self.at + self.reach)
    }

    /// `c`, `c′` and `c″` at a parameter, from `c″`; at the tip `c′` has the direction that it comes from.
    pub(super) fn jet(&self, second: &impl Fn(f64) -> Vector2<f64>, u: f64) -> [Vector2<f64>; 3] {
        let tau = u - self.at;
        if tau.abs() <= self.tip {
            // c′ × c″ is the same as below
            return [self.point, self.second * tau, 0.5 * (self.second + second(u))];
        }
        let [mean, height] = means(second, self.at, tau);
        [self.point + height * (tau * tau), mean * tau, second(u)]
    }

    /// The graphs between two parameters where `c″` is integrated, and two points there; `size` \[L\] is that of the whole curve.
    pub(super) fn graphs(
        &self,
        second: &impl Fn(f64) -> Vector2<f64>,
        parameters: [f64; 2],
        vertices: [Vector2<f64>; 2],
        size: f64,
    ) -> Option<Vec<Graph>> {
        let ends = vertices.map(|vertex| vertex - self.point);
        let from_tip = FromTip { cusp: Cusp { point: Vector2::zeros(), ..*self }, second };
        let graphs = rough_graphs(&from_tip, parameters, ends, size)?;
        let mut graphs: Vec<_> = graphs.into_iter().map(|graph| graph.translated(self.point.into())).collect();
        // the given ends, to the last digit
        let last = graphs.len() - 1;
        graphs[0].ends[0] = vertices[0].into();
        graphs[last].ends[1] = vertices[1].into();
        Some(graphs)
    }
}

/// `∫₀¹ c″(u + sτ) ds` and `∫₀¹ (1−s) c″(u + sτ) ds`, exact for polynomials up to degree 18.
fn means(second: &impl Fn(f64) -> Vector2<f64>, u: f64, tau: f64) -> [Vector2<f64>; 2] {
    let mut means = [Vector2::zeros(); 2];
    for [x, weight] in GAUSS {
        for s in [0.5 - 0.5 * x, 0.5 + 0.5 * x] {
            let part = second(u + s * tau) * (0.5 * weight);
            means = [means[0] + part, means[1] + part * (1.0 - s)];
        }
    }
    means
}

/// The curve relative to the tip, free of the rounding of coordinates.
struct FromTip<'a, S> {
    cusp: Cusp,
    second: &'a S,
}

impl<S: Fn(f64) -> Vector2<f64>> Parametric for FromTip<'_, S> {
    fn at(&self, u: f64) -> [Vector2<f64>; 2] {
        let [c, first, _] = self.cusp.jet(self.second, u);
        [c, first]
    }
}
