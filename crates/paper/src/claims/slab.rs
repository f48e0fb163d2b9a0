//! Balls between two planes.
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    random::Stream,
    statistics::{Range, worst},
};
use billiards::{Clock, Collision, Collisions, Conserved, Observer, Orbit, Spatial, geometry::tables, laws::RoughBall};
use core::ops::ControlFlow;

pub(super) const CLAIM: Claim = Claim {
    name: "slab",
    place: "Proposition 2.2",
    statement: "Orbits of a no-slip ball between two parallel planes are bounded; with the spin coordinates as further axes the contact \
                points lie on lines of slope √(5/2).",
    verdict: Verdict::Holds,
    general_gamma: Some(
        "Slope 1/γ (γ² = 2/5 for a uniform ball). At unit speed and unit distance of the planes the contact points lie in a \
                         plane figure of diameter at most (√(1+γ²)/γ)·√((1−s²)/ẋ₃² − 1), s the spin about the normal: √(7/2) for the \
                         uniform ball. The bound is sharp. (Measured for the uniform ball, derived for others.)",
    ),
    measure,
};

/// `γ²` of a uniform ball.
const BALL: f64 = 0.4;

/// A contact: position along the planes, and the spin positions that go with it, `U = ∫ W dt`: `(x₁, U₂)` and `(x₂, −U₁)`.
struct Contact {
    pairs: [[f64; 2]; 2],
    plane: usize,
}

struct Contacts {
    height: f64,
    rise: f64,
    spin: [f64; 3],
    turned: [f64; 3],
    all: Vec<Contact>,
}

impl<K> Observer<3, 3, K, Clock> for Contacts {
    fn collision(&mut self, c: &Collision<'_, 3, 3, K, Clock>) -> ControlFlow<()> {
        // from the height and the rise: a difference of times rounds by an ulp of the time, 10⁻¹² after 2000 flights
        let flight = (c.orbit.position[2] - self.height) / self.rise;
        for (turned, spin) in self.turned.iter_mut().zip(self.spin) {
            *turned += spin * flight;
        }
        self.height = c.orbit.position[2];
        self.rise = c.orbit.velocity[2];
        self.spin = c.orbit.spin;
        let ([x1, x2, _], [u1, u2, _]) = (c.orbit.position, self.turned);
        self.all.push(Contact { pairs: [[u2, x1], [-u1, x2]], plane: c.piece() });
        ControlFlow::Continue(())
    }
}

fn contacts(velocity: [f64; 3], spin: [f64; 3], collisions: usize) -> Vec<Contact> {
    let slab = Spatial {
        table: tables::slab(1.0).expect("a slab"),
        law: RoughBall::no_slip(libm::sqrt(BALL)).expect("a γ in range"),
    };
    let mut orbit = Orbit::<_, 3, 3, Conserved<_, 3>, _>::new([0.0, 0.0, 0.5], velocity, spin, Clock::new(0.0));
    let all = Vec::with_capacity(collisions);
    let mut contacts = Contacts { height: orbit.position[2], rise: velocity[2], spin, turned: [0.0; 3], all };
    slab.run(&mut orbit, &Collisions(collisions as u64), &mut contacts);
    contacts.all
}

/// Spin position and place, along one axis, of the contacts with one plane.
fn touches(contacts: &[Contact], plane: usize, pair: usize) -> Vec<[f64; 2]> {
    contacts.iter().filter(|c| c.plane == plane).map(|c| c.pairs[pair]).collect()
}

/// The two ends of a line of contacts.
fn ends(touches: &[[f64; 2]]) -> [[f64; 2]; 2] {
    touches.iter().fold([touches[0]; 2], |[low, high], p| {
        [if p[0] < low[0] { *p } else { low }, if p[0] > high[0] { *p } else { high }]
    })
}

/// How far contacts are from a line through one end of them that rises or falls with this slope, measured along the plane.
fn off_line(touches: &[[f64; 2]], slope: f64) -> f64 {
    let [low, _] = ends(touches);
    let off = |slope: f64| worst(touches.iter().map(|p| ((p[1] - low[1]) - slope * (p[0] - low[0])).abs()));
    off(slope).min(off(-slope))
}

/// The greatest distance between two contact points along the planes.
fn diameter(contacts: &[Contact]) -> f64 {
    let point = |c: &Contact| [c.pairs[0][1], c.pairs[1][1]];
    let squares = contacts.iter().enumerate().flat_map(|(i, a)| {
        contacts[..i].iter().map(move |b| {
            let ([a1, a2], [b1, b2]) = (point(a), point(b));
            (a1 - b1) * (a1 - b1) + (a2 - b2) * (a2 - b2)
        })
    });
    libm::sqrt(worst(squares))
}

fn measure(effort: Effort) -> Measurement {
    let (orbits, collisions) = (effort.of(20, 200), effort.of(400_u32, 2000));
    let slope = 1.0 / libm::sqrt(BALL);
    let sharp = libm::sqrt(1.0 + BALL) * slope;
    let (mut off, mut slopes, mut relative, mut agreeing) = (vec![], Range::EMPTY, Range::EMPTY, Range::EMPTY);
    let (mut long, mut whole) = (0_usize, 0);
    for sample in 0..orbits {
        let mut stream = Stream::new(209, sample);
        let rise = stream.between(0.2, 0.8);
        // the rest of the unit speed: along the planes, and in the spin; half of the orbits with agreeing phases and s = 0
        let agree = sample % 2 == 0;
        let along = libm::sqrt((1.0 - rise) * (1.0 + rise));
        let (v1, v2, w) = if agree {
            let turn = stream.between(0.0, core::f64::consts::TAU);
            let (w, v) = libm::sincos(turn);
            let [a, b, _] = stream.on_sphere();
            let size = libm::hypot(a, b);
            (a / size * v, b / size * v, [-b / size * w, a / size * w, 0.0])
        } else {
            let ([a, b, c], [d, e, _]) = (stream.on_sphere(), stream.on_sphere());
            let size = libm::sqrt(a * a + b * b + c * c + d * d + e * e);
            (a / size, b / size, [d / size, e / size, c / size])
        };
        let spin = w[2] * along;
        let ell = libm::sqrt((1.0 - spin * spin) / (rise * rise) - 1.0);
        if ell < 0.3 {
            continue;
        }
        long += 1;
        let contacts = contacts([v1 * along, v2 * along, rise], w.map(|w| w * along), collisions as usize);
        whole += usize::from(contacts.len() == collisions as usize);
        for plane in [0, 1] {
            for pair in [0, 1] {
                let touches = touches(&contacts, plane, pair);
                let [low, high] = ends(&touches);
                slopes.add(((high[1] - low[1]) / (high[0] - low[0])).abs());
                off.push(off_line(&touches, slope) / ell);
            }
        }
        let width = diameter(&contacts) / ell;
        relative.add(width);
        if agree {
            agreeing.add(width);
        }
    }
    // as in a strip, with ℓ² between 0.1 and 24
    let rounding = 2.0 * super::strip_width::rounding(f64::from(collisions));
    let phase = super::strip_width::phase(f64::from(collisions));
    [
        // ℓ > 0.3 is a rise below 0.957 without spin; with it the spin may be most of the rest
        Quantity::at_least("orbits with ℓ > 0.3", long as f64, 0.75 * orbits as f64, 0.0),
        Quantity::count("of these, with all their collisions", whole, long),
        Quantity::equal("|slope| of the lines of contact, least", slopes.min, slope, slope * 16.0 * rounding),
        Quantity::equal("|slope| of the lines of contact, greatest", slopes.max, slope, slope * 16.0 * rounding),
        Quantity::equal("1/γ against √(5/2)", slope, libm::sqrt(2.5), 4.0 * f64::EPSILON),
        Quantity::residual("contact points off their lines, over ℓ", worst(off), rounding),
        Quantity::at_most("diameter / ℓ, widest of all orbits", relative.max, sharp, sharp * rounding),
        Quantity::equal("bound against √(7/2)", sharp, libm::sqrt(3.5), 4.0 * f64::EPSILON),
        Quantity::at_least(
            "diameter / ℓ where the phases agree, narrowest",
            agreeing.min,
            sharp,
            sharp * phase * phase,
        ),
    ]
    .into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contacts_stay_on_their_lines_for_thousands_of_collisions() {
        let contacts = contacts([0.3, 0.5, 0.4], [0.4, -0.3, 0.2], 4000);
        for (plane, pair) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            // some ten roundings of numbers near one per collision, most of them at random
            let off = off_line(&touches(&contacts, plane, pair), libm::sqrt(2.5));
            assert!(off < 1e-12, "{plane} {pair}: {off:e}");
        }
    }
}
