//! How near the flights of an orbit come to a point: the radius of a caustic.
use super::{Collision, Observer, flight::Flight};
use crate::{merge::Merge, orbit::Orbit};
use core::ops::ControlFlow;

/// The smallest distance \[L\] between the path of the centre and a point.
///
/// In a circle the flights of one orbit touch one concentric circle (specular) or alternately two (no-slip), their
/// caustics: about the centre this is the radius of the smaller one.
///
/// On a lattice each flight is the straight path that ends at the hit in the table's cell, and the point is a single one: copies of it
/// that the flight passes in earlier cells are not considered.
///
/// ```
/// use billiards::{Collisions, Orbit, Planar, geometry::tables, laws::Specular, observe::Nearest};
///
/// let circle = Planar { table: tables::circle(1.0)?, law: Specular };
/// let mut orbit = Orbit::<f64, 2, 1>::new([-0.5, 0.25], [1.0, 0.0], [0.0], ());
/// let mut nearest = Nearest::to([0.0, 0.0], &orbit);
/// circle.run(&mut orbit, &Collisions(100), &mut nearest);
/// assert!((nearest.distance() - 0.25).abs() < 1e-14);
/// # Ok::<(), billiards::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Nearest<const N: usize, const S: usize> {
    point: [f64; N],
    flight: Option<Flight<N, S>>,
    square: f64,
}

impl<const N: usize, const S: usize> Nearest<N, S> {
    /// How near the flights come to `point`, the first of which begins where `orbit` is.
    pub fn to<K, T>(point: [f64; N], orbit: &Orbit<f64, N, S, K, T>) -> Self {
        Nearest { point, flight: Some(Flight::from(orbit)), square: f64::INFINITY }
    }

    /// Goes on with another orbit, from where that is now.
    pub fn follow<K, T>(&mut self, orbit: &Orbit<f64, N, S, K, T>) {
        self.flight = Some(Flight::from(orbit));
    }

    /// The smallest distance so far; infinite before the first collision.
    pub fn distance(&self) -> f64 {
        self.square.sqrt()
    }
}

impl<K, T, const N: usize, const S: usize> Observer<N, S, K, T> for Nearest<N, S> {
    #[inline]
    fn collision(&mut self, c: &Collision<'_, N, S, K, T>) -> ControlFlow<()> {
        // a flight whose start was not seen does not count
        let Some(Flight { velocity: v, .. }) = self.flight.replace(Flight::from(c.orbit)) else {
            return ControlFlow::Continue(());
        };
        // going back from the hit along −v for a time τ, at most that of the flight
        let (mut ahead, mut square) = (0.0, 0.0);
        for i in 0..N {
            ahead += (c.hit.point[i] - self.point[i]) * v[i];
            square += v[i] * v[i];
        }
        let back = if square > 0.0 { (ahead / square).min(c.hit.time).max(0.0) } else { 0.0 };
        let distance = |i: usize| c.hit.point[i] - self.point[i] - back * v[i];
        self.square = self.square.min((0..N).map(|i| distance(i) * distance(i)).sum());
        ControlFlow::Continue(())
    }
}

impl<const N: usize, const S: usize> Merge for Nearest<N, S> {
    fn merge(self, other: Self) -> Self {
        Nearest { square: self.square.min(other.square), ..self }
    }
    fn next_orbit(&mut self) {
        self.flight = None;
    }
}
