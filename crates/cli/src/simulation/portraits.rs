//! Density portraits: every thread counts the points that it computes, on grids of its own.
//!
//! As long as there are few points, they are passed on one by one, to be drawn as dots; beyond that they are counted.
//! Counts are whole numbers, so the portrait does not depend on which thread counted what.

use std::sync::Arc;

use billiards::geometry::WallHit;
use billiards::observe::LaneObserver;
use billiards::{Clock, Conserved, Merge, Orbit};
use lanes::{Lane, Mask};

use super::counter::Counter;
use super::places::Places;
use super::unrolled::Unrolled;
use crate::picture::{self, Cloud, Reduced};

/// A collision as a point of the portraits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Point {
    /// Number of the orbit.
    pub(crate) orbit: u64,
    /// `(v0, v·t)` of the velocity scaled to length one, where `t = J ν`.
    pub(crate) velocity: [f64; 2],
    /// `(s, v·t)`, the arc length in the unit of the picture.
    pub(crate) reduced: [f64; 2],
}

/// The portraits of a disk in the plane.
#[derive(Clone, Debug)]
pub(crate) struct PlanarPortraits {
    velocities: Option<Counter>,
    reduced: Option<Places>,
    /// Whether no collision changes the speed.
    strict: bool,
    /// The orbits that run side by side.
    orbits: Vec<u64>,
}

/// The data of the orbits in the lanes of a vector.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View<F: Lane> {
    /// Whether there is an orbit.
    here: F::Mask,
    /// The factor by which velocities are scaled.
    unit: F,
    /// The layers in which they are counted.
    layers: [F; 2],
}

/// What portraits need to know of a collision.
#[derive(Clone, Copy, Debug)]
struct Seen<F> {
    /// `v0` and `v·t`, where `t = J ν`.
    spin: F,
    tangential: F,
    /// `|(v, w)|²`
    square: F,
}

impl<F: Lane> Seen<F> {
    #[inline(always)]
    fn of(hit: &WallHit<F, 2>, velocity: &[F; 2], spin: &[F; 1]) -> Self {
        let ([n1, n2], [v1, v2], [spin]) = (hit.normal, *velocity, *spin);
        let tangential = (v2 * n1 - v1 * n2) * hit.inverse;
        Seen { spin, tangential, square: v1 * v1 + v2 * v2 + spin * spin }
    }
}

/// `1/√x`
fn inverse_root<F: Lane>(x: F) -> F {
    x.same(1.0) / x.sqrt()
}

/// `1/|(v, w)|`
fn inverse_speed([v1, v2]: &[f64; 2], w: f64) -> f64 {
    inverse_root(v1 * v1 + v2 * v2 + w * w)
}

impl PlanarPortraits {
    /// Portraits for these clouds, without points.
    pub(crate) fn new(clouds: &Clouds, unrolled: Option<&Arc<Unrolled>>, strict: bool) -> Self {
        let reduced = clouds.reduced.as_ref().map(|reduced| Counter::of(reduced.cloud()));
        PlanarPortraits {
            velocities: clouds.velocities.as_ref().map(Counter::of),
            reduced: reduced.zip(unrolled.cloned()).map(|(counter, unrolled)| Places::new(counter, unrolled)),
            strict,
            orbits: vec![],
        }
    }

    /// `(v0, v·t)` of collisions, velocities scaled by `unit`.
    #[inline(always)]
    fn velocity<F: Lane>(&self, unit: F, seen: &Seen<F>) -> [F; 2] {
        let unit = if self.strict { unit } else { inverse_root(seen.square) };
        [seen.spin * unit, seen.tangential * unit]
    }

    /// Begins counting for an orbit, and returns its layers.
    fn layers(&mut self, orbit: u64) -> [f64; 2] {
        let layer = picture::layer(orbit);
        let of = |counter: &mut Counter| counter.begin(layer);
        [self.velocities.as_mut().map_or(0.0, of), self.reduced.as_mut().map_or(0.0, |places| of(&mut places.counter))]
    }
}

impl Merge for PlanarPortraits {
    fn merge(mut self, other: Self) -> Self {
        let add = |mine: Option<&mut Counter>, other: Option<Counter>| {
            if let (Some(mine), Some(other)) = (mine, other.and_then(Counter::counted)) {
                mine.add(&other);
            }
        };
        add(self.velocities.as_mut(), other.velocities);
        add(self.reduced.as_mut().map(|mine| &mut mine.counter), other.reduced.map(Places::counted));
        self
    }
}

/// Counts collisions for density portraits.
pub(crate) trait Portraits<const N: usize, const S: usize>:
    LaneObserver<N, S, Conserved<f64, N>, Clock> + Merge + Send
{
    /// The scale factor of an orbit with this velocity and spin.
    fn unit(&self, velocity: &[f64; N], spin: &[f64; S]) -> f64;
    /// The point for a collision of an orbit with this scale factor.
    fn point(&self, orbit: u64, unit: f64, hit: &WallHit<f64, N>, velocity: &[f64; N], spin: &[f64; S]) -> Point;
    /// Counts a collision.
    fn count(&mut self, point: &Point);
    /// Announces the orbits that are about to run side by side.
    fn side_by_side(&mut self, orbits: impl Iterator<Item = u64>);
}

/// There are none in space.
impl<const N: usize, const S: usize> Portraits<N, S> for () {
    fn unit(&self, _: &[f64; N], _: &[f64; S]) -> f64 {
        1.0
    }
    fn point(&self, orbit: u64, _: f64, _: &WallHit<f64, N>, _: &[f64; N], _: &[f64; S]) -> Point {
        Point { orbit, velocity: [0.0; 2], reduced: [0.0; 2] }
    }
    fn count(&mut self, _: &Point) {}
    fn side_by_side(&mut self, _: impl Iterator<Item = u64>) {}
}

impl Portraits<2, 1> for PlanarPortraits {
    fn unit(&self, velocity: &[f64; 2], spin: &[f64; 1]) -> f64 {
        inverse_speed(velocity, spin[0])
    }
    #[inline(always)]
    fn point(&self, orbit: u64, unit: f64, hit: &WallHit<f64, 2>, velocity: &[f64; 2], spin: &[f64; 1]) -> Point {
        let velocity = self.velocity(unit, &Seen::of(hit, velocity, spin));
        let place = |places: &Places| places.unrolled.arc_length(hit.point, || hit.unit_normal(), hit.piece);
        Point { orbit, velocity, reduced: [self.reduced.as_ref().map_or(0.0, place), velocity[1]] }
    }
    #[inline(always)]
    fn count(&mut self, point: &Point) {
        let layers = self.layers(point.orbit);
        if let Some(counter) = &mut self.velocities {
            counter.note(point.velocity, layers[0], true);
        }
        if let Some(Places { counter, .. }) = &mut self.reduced {
            counter.note(counter.near(point.reduced), layers[1], true);
        }
    }
    fn side_by_side(&mut self, orbits: impl Iterator<Item = u64>) {
        self.orbits.clear();
        self.orbits.extend(orbits);
    }
}

impl LaneObserver<2, 1, Conserved<f64, 2>, Clock> for PlanarPortraits {
    type View<F: Lane> = View<F>;

    fn nobody<F: Lane>(&self, zero: F) -> View<F> {
        View { here: zero.never(), unit: zero, layers: [zero; 2] }
    }
    fn begin<F: Lane>(
        &mut self,
        view: &mut View<F>,
        here: F::Mask,
        index: u64,
        orbit: &Orbit<f64, 2, 1, Conserved<f64, 2>, Clock>,
    ) {
        #[allow(clippy::cast_possible_truncation, reason = "the number of one of the orbits side by side")]
        let layers = self.layers(self.orbits[index as usize]);
        let put = |to: F, from: f64| here.select(to.same(from), to);
        view.here = view.here | here;
        view.unit = put(view.unit, inverse_speed(&orbit.velocity, orbit.spin[0]));
        view.layers = [0, 1].map(|i| put(view.layers[i], layers[i]));
    }
    fn end<F: Lane>(&mut self, view: &mut View<F>, here: F::Mask) {
        view.here = view.here & !here;
    }
    #[inline(always)]
    fn collision<F: Lane>(
        &mut self,
        view: &mut View<F>,
        hit: &WallHit<F, 2>,
        orbit: &Orbit<F, 2, 1, Conserved<F, 2>, Clock<F>>,
    ) {
        let velocity = self.velocity(view.unit, &Seen::of(hit, &orbit.velocity, &orbit.spin));
        if let Some(counter) = &mut self.velocities {
            counter.note(velocity, view.layers[0], view.here);
        }
        if let Some(places) = &mut self.reduced {
            places.note(hit, velocity[1], view.layers[1], view.here);
        }
    }
}

/// The requested portraits: they show points one by one as long as these are few.
#[derive(Clone, Debug, Default)]
pub(crate) struct Clouds {
    pub(crate) velocities: Option<Cloud>,
    pub(crate) reduced: Option<Reduced>,
}

impl Clouds {
    /// Whether there are any.
    pub(crate) fn any(&self) -> bool {
        self.velocities.is_some() || self.reduced.is_some()
    }

    /// Adds a point.
    pub(crate) fn add(&mut self, point: &Point) {
        if let Some(velocities) = &mut self.velocities {
            velocities.add(point.orbit, point.velocity);
        }
        if let Some(reduced) = &mut self.reduced {
            reduced.cloud_mut().add(point.orbit, point.reduced);
        }
    }

    /// Adds points that were counted.
    pub(crate) fn merge(&mut self, counted: Option<PlanarPortraits>) {
        let add = |counter: Option<Counter>, cloud: Option<&mut Cloud>| {
            if let (Some(counts), Some(cloud)) = (counter.and_then(Counter::counted), cloud) {
                cloud.merge(&counts);
            }
        };
        if let Some(PlanarPortraits { velocities, reduced, .. }) = counted {
            add(velocities, self.velocities.as_mut());
            add(reduced.map(Places::counted), self.reduced.as_mut().map(Reduced::cloud_mut));
        }
    }

    /// Whether further points need no longer be passed on one by one.
    pub(crate) fn are_crowded(&self) -> bool {
        let reduced = self.reduced.as_ref().map(Reduced::cloud);
        self.velocities.iter().chain(reduced).all(Cloud::is_crowded)
    }
}
