//! A body of one's own with fewer degrees of freedom than space has dimensions: a door on its hinge.

use collision_laws::{
    Body, Contact, Delassus, Error, Fixed, Pair, Roughness, TangentVector,
    bodies::Ball,
    check::{self, Axiom, Samples, TOLERANCE},
    classify,
    laws::{NoSlip, Specular},
};
use nalgebra::{DMatrix, SMatrix, Unit, Vector2};

/// The angular velocity of a door.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Turning(f64);

impl TangentVector<2> for Turning {
    const DIMENSION: usize = 1;

    fn coordinates(&self) -> Vec<f64> {
        vec![self.0]
    }

    fn from_coordinates(coordinates: &[f64]) -> Self {
        Self(coordinates.first().copied().unwrap_or(0.0))
    }

    fn of_rigid_motion(_: &Vector2<f64>, _: &Vector2<f64>, _: &SMatrix<f64, 2, 2>) -> Self {
        unreachable!("only free bodies are asked")
    }

    fn at(&self, arm: &Vector2<f64>) -> Vector2<f64> {
        Vector2::new(-arm.y, arm.x) * self.0
    }
}

/// A door by its moment of inertia about the hinge, from which arms are measured.
#[derive(Clone, Copy, Debug)]
struct Door(f64);

impl Body<2> for Door {
    type Velocity = Turning;

    fn inner_product(&self, v: &Turning, w: &Turning) -> f64 {
        self.0 * v.0 * w.0
    }

    fn apply_impulse(&self, arm: &Vector2<f64>, p: &Vector2<f64>, v: &Turning) -> Turning {
        Turning(v.0 + arm.perp(p) / self.0)
    }

    fn delassus(&self, arm: &Vector2<f64>, _: &Unit<Vector2<f64>>) -> Delassus<2> {
        let along = Vector2::new(-arm.y, arm.x);
        Delassus::Dense(along * along.transpose() / self.0)
    }

    fn is_free(&self) -> bool {
        false
    }
}

fn contact() -> Contact<2> {
    Contact::new(Vector2::zeros(), Vector2::y(), 0).unwrap()
}

/// Where the door is hit, seen from its hinge.
const ARM: Vector2<f64> = Vector2::new(1.0, -0.3);

#[test]
fn a_door_that_meets_a_stop_is_classified() {
    let pair = Pair::new(contact(), (Door(2.0), ARM), (Fixed, Vector2::zeros()));
    let found = classify(&pair.tangent_space(), &pair.collision_map(&Specular), TOLERANCE).unwrap();
    assert_eq!(found.strict, Some(Roughness::Smooth), "{}", found.report);
    let still = classify(&pair.tangent_space(), &DMatrix::identity(1, 1), TOLERANCE).unwrap();
    assert_eq!(still.report.broken(TOLERANCE).map(|(axiom, _)| axiom).collect::<Vec<_>>(), [Axiom::OutgoingToIngoing]);
    assert!(check::law(&pair, &Specular, Samples::default()).is_strict(TOLERANCE));
    assert!(check::body(&Door(2.0), &contact(), &ARM, Samples::default()).worst() < 1e-14);
}

#[test]
fn two_doors_that_move_along_one_line_are_classified() {
    let pair = Pair::new(contact(), (Door(2.0), ARM), (Door(3.0), -2.0 * ARM));
    let found = classify(&pair.tangent_space(), &pair.collision_map(&Specular), TOLERANCE).unwrap();
    assert_eq!(found.strict, Some(Roughness::Smooth), "{}", found.report);
}

#[test]
fn the_hinge_takes_up_momentum_when_a_disk_meets_a_door() {
    let disk = Ball::<2>::uniform(1.0, 1.0).unwrap();
    let pair = Pair::new(contact(), (disk, Vector2::new(0.0, -1.0)), (Door(2.0), ARM));
    let report = check::law(&pair, &NoSlip, Samples::default());
    assert!(report.is_strict(TOLERANCE), "{report}");
    assert_eq!((report.defect(Axiom::LinearMomentum), report.defect(Axiom::AngularMomentum)), (None, None));
    let found = classify(&pair.tangent_space(), &pair.collision_map(&NoSlip), TOLERANCE).unwrap();
    assert_eq!(found.strict.map(|roughness| roughness.rank()), Some(1), "{}", found.report);
}

#[test]
fn a_push_along_which_a_door_cannot_move_is_refused_as_such() {
    let pair = Pair::new(contact(), (Door(2.0), ARM), (Fixed, Vector2::zeros()));
    let refused = pair.try_collide(&NoSlip, &(Turning(-1.0), ())).unwrap_err();
    assert_eq!(refused, Error::SingularDelassus { body: 1 });
    assert!(refused.to_string().ends_with("or cannot move in a direction in which the law pushes"), "{refused}");
}
