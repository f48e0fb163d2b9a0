//! Does a collision law preserve the billiard measure?
//!
//! Expected: yes for every strict law, whose rough directions may depend on the contact in any way; no for a law whose rough
//! direction follows the velocity, although it keeps energy and momenta and its impulse acts only at the contact. It
//! multiplies the measure by 0.3 at each collision. Reference: Cox, Feres and Ward, arXiv:1501.06536, Theorem 2.2: what is
//! needed is that the law is linear in the velocity.
use billiards::collision_laws::{
    CollisionLaw, Contact, Error, Fixed, Pair,
    bodies::Ball,
    check::{self, Axiom, Samples, controls::Chasing},
    laws::{Grooved, NoSlip, RandomGrassmannian, Specular},
};
use billiards::geometry::Vector3;

fn main() -> Result<(), Error> {
    let contact = Contact::new(Vector3::new(0.3, -0.4, 0.0), Vector3::new(0.0, 0.0, 1.0), 0)?;
    let ball = Ball::<3>::uniform(1.0, 1.0)?;
    let pair = Pair::new(contact, (ball, Vector3::new(0.0, 0.0, -1.0)), (Fixed, Vector3::zeros()));

    let record = Grooved::new(|contact: &Contact<3>| contact.point); // rough along the radius
    let random = RandomGrassmannian::new(1, 42)?;
    let strict: [(&str, &dyn CollisionLaw<3>); 4] =
        [("specular", &Specular), ("no-slip", &NoSlip), ("grooved", &record), ("random", &random)];
    for (name, law) in strict {
        let report = check::law(&pair, law, Samples::default());
        println!("{name:<10} multiplies the measure by {:.12}", report.measure_ratio());
        assert!(report.is_strict(check::TOLERANCE));
    }

    let report = check::law(&pair, &Chasing, Samples::default());
    println!("chasing    multiplies the measure by {:.5}:\n{report}", report.measure_ratio());
    let broken: Vec<Axiom> = report.broken(check::TOLERANCE).map(|(axiom, _)| axiom).collect();
    assert_eq!(broken, [Axiom::Involution, Axiom::Linearity, Axiom::Measure]);
    assert!((report.measure_ratio() - 0.3).abs() < 1e-5); // a difference quotient of a steep map
    Ok(())
}
