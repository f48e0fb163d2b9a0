//! Does a collision law preserve the billiard measure?
//!
//! Expected: yes for every strict law, at each contact; no for a law whose rough direction follows the velocity, although it
//! keeps energy and momenta and its impulse acts only at the contact. It multiplies the measure by 0.3 at each collision.
//!
//! Why: a strict law is at each contact a linear isometry that reverses the normal component, so it keeps Lebesgue measure on
//! the velocities and `|⟨v, N̂⟩|` with it; and since a collision leaves the place as it is, the differential is block triangular
//! and the rest of it does not count. So the rough directions may be any measurable function of the contact. (Theorem 2.2 of
//! Cox, Feres and Ward, arXiv:1501.06536, has this for parallel fields of directions.)
use billiards::collision_laws::{
    CollisionLaw, Contact, Error, Fixed, Pair,
    bodies::Ball,
    check::{self, Axiom, Samples, controls::Chasing},
    laws::{Grooved, NoSlip, RandomGrassmannian, Specular},
};
use billiards::geometry::Vector3;

fn main() -> Result<(), Error> {
    let ball = Ball::<3>::uniform(1.0, 1.0)?;
    let at = |point: [f64; 3], normal: [f64; 3]| {
        let contact = Contact::new(point.into(), normal.into(), 0)?;
        Ok(Pair::new(contact, (ball, -contact.normal.into_inner()), (Fixed, Vector3::zeros())))
    };
    let places = [
        at([0.3, -0.4, 0.0], [0.0, 0.0, 1.0])?,
        at([0.3, -0.4 + 1e-9, 0.0], [0.0, 0.0, 1.0])?,
        at([-2.0, 0.7, 1.1], [0.6, 0.0, 0.8])?,
        at([5.0, 0.0, -3.0], [-2.0, 1.0, 0.5])?,
    ];

    let record = Grooved::new(|contact: &Contact<3>| contact.point); // rough along the radius
    let random = RandomGrassmannian::new(1, 42)?;
    let strict: [(&str, &dyn CollisionLaw<3>); 4] =
        [("specular", &Specular), ("no-slip", &NoSlip), ("grooved", &record), ("random", &random)];
    for (name, law) in strict {
        for (place, pair) in places.iter().enumerate() {
            let report = check::law(pair, law, Samples::default());
            println!("{name:<10} multiplies the measure by {:.12} at place {place}", report.measure_ratio());
            assert!(report.is_strict(check::TOLERANCE));
        }
    }

    let report = check::law(&places[0], &Chasing, Samples::default());
    println!("chasing    multiplies the measure by {:.5}:\n{report}", report.measure_ratio());
    let broken: Vec<Axiom> = report.broken(check::TOLERANCE).map(|(axiom, _)| axiom).collect();
    assert_eq!(broken, [Axiom::Involution, Axiom::Linearity, Axiom::Measure]);
    assert!((report.measure_ratio() - 0.3).abs() < 1e-5); // a difference quotient of a steep map
    Ok(())
}
