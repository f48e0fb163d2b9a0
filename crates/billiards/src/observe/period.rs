//! Whether an orbit is periodic.
use super::{Collision, Observer, flight::Flight};
use core::ops::ControlFlow;
use geometry::{Lattice, Vector2};
use lanes::Double;

/// Finds the smallest number of collisions after which an orbit returns to where its first collision left it, in the
/// reduced phase space: the piece, the position and the velocities, but not the spin position `x₀`. Then it stops the run.
/// It counts collisions itself, so an orbit may come to it in several runs; an orbit that goes on after that is stopped at each further
/// return. In an [`Ensemble`](crate::Ensemble) give each orbit its own, and merge the list of what they have [found](Period::found).
///
/// Many no-slip orbits have a period there and yet turn a little further each time: [`Return::drift`] tells whether `x₀` returns too.
///
/// ```
/// use billiards::{Collisions, Conserved, Orbit, Planar, Stop, laws::Disk};
/// use billiards::{collision_laws::laws::NoSlip, geometry::tables, observe::Period};
///
/// // in an equilateral triangle every orbit of a uniform disk has period 4 or 6, or a divisor of them
/// let triangle = Planar { table: tables::equilateral(1.0)?, law: Disk::new(&NoSlip, 0.5_f64.sqrt())? };
/// let mut orbit = Orbit::<_, 2, 1, Conserved<_, 2>>::new([0.45, 0.2], [0.6, 0.3], [0.4], ());
/// let mut period = Period::new(1e-12, 1.0);
/// assert_eq!(triangle.run(&mut orbit, &Collisions(100), &mut period).stop, Stop::Observer);
/// let found = period.found().expect("the run was stopped");
/// assert!(found.period == 4 || found.period == 6);
/// # Ok::<(), billiards::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Period {
    tolerance: f64,
    length: f64,
    lattice: Option<Lattice>,
    reference: Option<Reference>,
    found: Option<Return>,
}

#[derive(Clone, Copy, Debug)]
struct Reference {
    piece: usize,
    position: [f64; 2],
    start: Flight<2, 1>,
    speed: f64,
    flight: Flight<2, 1>,
    turned: Double,
    /// Collisions since.
    collisions: u64,
}

/// A return to the start in the reduced phase space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Return {
    /// After this many collisions.
    pub period: u64,
    /// How far from it: the larger of the distance over the length and the change of velocity over the speed.
    pub error: f64,
    /// How far the spin position `x₀ = γ R θ` moves in one period \[L\].
    pub drift: f64,
    /// Whether that is 0 within the tolerance too: the orbit is periodic in the full phase space.
    pub drift_free: bool,
}

impl Period {
    /// Returns within `tolerance`, relative to the speed and to `length` \[L\], the size of the table.
    pub fn new(tolerance: f64, length: f64) -> Self {
        Period { tolerance, length, lattice: None, reference: None, found: None }
    }

    /// The same on the plane modulo a lattice, where a position on the edge of a cell has more than one name.
    #[must_use]
    pub fn modulo(self, lattice: Lattice) -> Self {
        Period { lattice: Some(lattice), ..self }
    }

    /// The return, once there was one.
    pub fn found(&self) -> Option<Return> {
        self.found
    }

    /// The distance of two points, modulo the lattice.
    fn distance(&self, a: [f64; 2], b: [f64; 2]) -> f64 {
        let mut d = Vector2::from(a) - Vector2::from(b);
        if let Some(lattice) = &self.lattice {
            d -= lattice.translation(lattice.rounded(&d));
        }
        libm::hypot(d.x, d.y)
    }
}

impl<K, T> Observer<2, 1, K, T> for Period {
    #[inline]
    fn collision(&mut self, c: &Collision<'_, 2, 1, K, T>) -> ControlFlow<()> {
        let (o, now) = (c.orbit, Flight::from(c.orbit));
        let Some(mut reference) = self.reference else {
            let speed = norm3(o.spin[0], o.velocity);
            let (position, turned) = (o.position, Double::new(0.0));
            let piece = c.piece();
            self.reference = Some(Reference { piece, position, start: now, speed, flight: now, turned, collisions: 0 });
            return ControlFlow::Continue(());
        };
        reference.turned.add(reference.flight.spin[0] * c.hit.time);
        reference.flight = now;
        reference.collisions += 1;
        self.reference = Some(reference);
        if c.piece() != reference.piece {
            return ControlFlow::Continue(());
        }
        let start = reference.start;
        let change = [now.velocity[0] - start.velocity[0], now.velocity[1] - start.velocity[1]];
        let velocity = norm3(now.spin[0] - start.spin[0], change) / reference.speed;
        let error = velocity.max(self.distance(o.position, reference.position) / self.length);
        if error <= self.tolerance {
            let drift = reference.turned.value();
            let drift_free = drift.abs() <= self.tolerance * self.length;
            // an orbit that goes on returns again, after twice as many
            self.found.get_or_insert(Return { period: reference.collisions, error, drift, drift_free });
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }
}

fn norm3(a: f64, [b, c]: [f64; 2]) -> f64 {
    libm::hypot(a, libm::hypot(b, c))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_a_lattice_vector_apart_are_one() {
        let lattice = Lattice::new(&[Vector2::new(2.0, 0.0), Vector2::new(1.0, 4.0)]).unwrap();
        let period = Period::new(1e-12, 1.0).modulo(lattice);
        for [i, j] in [[0.0, 0.0], [1.0, 0.0], [0.0, -1.0], [-3.0, 2.0]] {
            let moved = [0.5 + 2.0 * i + j, 0.25 + 4.0 * j];
            assert_eq!(period.distance(moved, [0.5, 0.25]), 0.0);
            assert_eq!(period.distance(moved, [0.5, 0.5]), 0.25);
        }
    }
}
