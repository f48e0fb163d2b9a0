//! The canonical measure under fields of strict laws that are not parallel, and under laws that are not strict.
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    random::Stream,
    statistics::{Range, worst},
};
use billiards::collision_laws::{
    CollisionLaw, Contact, Fixed, Pair, Twist,
    bodies::Ball,
    check::{
        LawOfOrientation, Slab, SlabState, axioms,
        controls::{Chasing, ReversiblyChasing, slip_angle},
    },
    laws::{Grooved, NoSlip, RandomGrassmannian, RoughPlane, Specular},
};
use core::f64::consts::PI;
use nalgebra::{DVector, Quaternion, UnitQuaternion, Vector2, Vector3};

pub(super) const CLAIM: Claim = Claim {
    name: "measure-of-fields",
    place: "Section 1, before Theorem 1.2",
    statement: "A field of strict collision maps that is parallel preserves the Liouville measure; it is not clear whether this holds for more general \
                boundary conditions.",
    verdict: Verdict::HoldsCorrected(
        "It holds for every measurable field of strict maps, parallel or not, in every dimension: on each fibre C is a linear isometry that keeps \
         |⟨v, N⟩|, so its determinant is ±1, and it covers the identity of the boundary. What it needs is linearity: rough directions that depend on the \
         velocity break it, even if energy is conserved and the law is reversible.",
    ),
    general_gamma: Some("Holds for all bodies."),
    measure,
};

/// Central differences of order 6. The fields vary on the scale of 0.1, in units of speed and of the ball's radius: (STEP/0.1)⁶ = 1e-12 times
/// constants of order ten, and rounding 1e-16/STEP times as much.
const STEP: f64 = 1e-3;
const TOLERANCE: f64 = 1e-9;

fn ball() -> Ball<3> {
    Ball::uniform(2.0, 0.7).expect("a ball")
}

/// How a ball meets the ceiling: how it has turned, and its contact velocity.
struct Meeting {
    turned: UnitQuaternion<f64>,
    slip: Vector3<f64>,
}

/// The determinant of the step at a random state; `None` where the meeting is not `fit` for difference quotients.
fn determinant(field: LawOfOrientation<'_>, sample: usize, fit: fn(&Meeting) -> bool) -> Option<f64> {
    let mut stream = Stream::new(130, sample);
    let (axis, angle) = (stream.on_sphere(), stream.between(0.0, PI));
    let (sin, cos) = libm::sincos(0.5 * angle);
    let orientation = UnitQuaternion::new_unchecked(Quaternion::from_parts(cos, Vector3::from(axis) * sin));
    // half of the energy along the normal or more
    let [v1, v2, w1, w2, w3]: [f64; 5] = core::array::from_fn(|_| stream.between(-0.3, 0.3));
    let place = Vector2::new(stream.between(-1.0, 1.0), stream.between(-1.0, 1.0));
    let state = SlabState::new(place, orientation, Vector2::new(v1, v2), Vector3::new(w1, w2, w3));
    let slab = Slab { ball: ball(), height: 1.5 };
    let (turned, slip) = slab.meeting(&state);
    fit(&Meeting { turned, slip }).then(|| slab.determinant(field, &state, STEP))
}

/// A velocity of approach whose slip has the angle ψ, against a wall.
fn approach(psi: f64) -> (Pair<Ball<3>, Fixed, 3>, DVector<f64>) {
    let arm = Vector3::new(0.0, 0.0, -ball().radius());
    let contact = Contact::new(Vector3::zeros(), Vector3::z(), 0).expect("a normal");
    let pair = Pair::new(contact, (ball(), arm), (Fixed, Vector3::zeros()));
    let zero = slip_angle(&contact, &Vector3::x());
    let v = Vector3::new(libm::cos(psi - zero), libm::sin(psi - zero), -0.8);
    let coordinates = pair.coordinates(&(Twist::spatial(v, Vector3::zeros()), ()));
    (pair, coordinates)
}

/// A law that knows nothing of the orientation.
fn always<L: CollisionLaw<3> + Clone + 'static>(law: L) -> impl Fn(&UnitQuaternion<f64>) -> Box<dyn CollisionLaw<3>> {
    move |_| Box::new(law.clone())
}

fn measure(effort: Effort) -> Measurement {
    let samples = effort.of(10, 300);
    let mut quantities = vec![];
    let defects = |field: LawOfOrientation<'_>, fit: fn(&Meeting) -> bool, expected: f64| {
        let fit = (0..samples).filter_map(|sample| determinant(field, sample, fit));
        fit.map(|det| (det.abs() - expected).abs()).collect::<Vec<_>>()
    };
    let mut fewest = Range::EMPTY;
    let mut keeps = |name: &str, field: LawOfOrientation<'_>, fit: fn(&Meeting) -> bool| {
        let defects = defects(field, fit, 1.0);
        fewest.add(defects.len() as f64);
        let label = format!("{name}: | |det| − 1 |, ten coordinates, {} states", defects.len());
        quantities.push(Quantity::residual(label, worst(defects), TOLERANCE));
    };
    let along = Vector3::new(1.0, 2.0, -3.0);
    let turning = |contact: &Contact<3>| {
        let angle = 2.0 * contact.point.x - 1.5 * contact.point.y * contact.point.y;
        Vector3::new(libm::cos(angle), libm::sin(angle), 0.0)
    };
    let glued = |turned: &UnitQuaternion<f64>| -> Box<dyn CollisionLaw<3>> {
        Box::new(RoughPlane::new(&[turned * Vector3::new(1.0, 0.2, 0.0)]).expect("a direction"))
    };
    keeps("ball in a slab, specular (k = 0)", &always(Specular), |_| true);
    keeps("ball in a slab, no-slip (k = 2, not parallel)", &always(NoSlip), |_| true);
    keeps("one rough direction, constant", &always(RoughPlane::new(&[along]).expect("a direction")), |_| true);
    keeps("one rough direction that turns from place to place", &always(Grooved::new(turning)), |_| true);
    // its part along the wall turns the faster the shorter it is
    keeps("one rough direction glued to the ball", &glued, |m| (m.turned * Vector3::new(1.0, 0.2, 0.0)).z.abs() < 0.7);

    // a frozen random field is nowhere smooth: in the velocities alone, where the measure is |⟨v, N⟩| dv
    let (pair, v) = approach(0.7);
    let random = RandomGrassmannian::<3>::new(1, 5).expect("one of two directions");
    let step = |x: &DVector<f64>| pair.coordinates(&pair.collide(&random, &pair.velocities(x.as_slice())).velocities);
    let ratio = axioms::measure_ratio(&pair.tangent_space(), step, &v);
    quantities.push(Quantity::equal("random rough direction: factor of the measure", ratio, 1.0, TOLERANCE));

    // ψ has a cut, and turns fast where the slip is small
    let fit = |m: &Meeting| m.slip.x.abs().min(m.slip.y.abs()) > 0.2;
    let chasing = defects(&always(Chasing), fit, 0.3);
    fewest.add(chasing.len() as f64);
    quantities.push(Quantity::residual(
        "control, direction 0.35ψ + 0.2 of the slip: | |det| − 0.3 |",
        worst(chasing),
        TOLERANCE,
    ));
    quantities.push(Quantity::at_least("states of a field, fewest", fewest.min, 0.3 * samples as f64, 0.0));
    for psi in [0.3, -1.2, 0.9] {
        let (pair, v) = approach(psi);
        let space = pair.tangent_space();
        let step = |x: &DVector<f64>| {
            pair.coordinates(&pair.collide(&ReversiblyChasing, &pair.velocities(x.as_slice())).velocities)
        };
        let label = |what: &str| format!("control, reversible but not linear, ψ = {psi}: {what}");
        quantities.push(Quantity::residual(label("change of energy"), axioms::energy(&space, &v, &step(&v)), 1e-14));
        quantities.push(Quantity::residual(label("|CCv − v|"), axioms::involution(&space, step, &v), 1e-14));
        let (ratio, expected) = (axioms::measure_ratio(&space, step, &v), ReversiblyChasing::measure_ratio(psi));
        quantities.push(Quantity::equal(label("factor of the measure"), ratio, expected, TOLERANCE));
        quantities.push(Quantity::differs(label("factor of the measure, against 1"), ratio, 1.0, 0.05));
    }
    quantities.into()
}
