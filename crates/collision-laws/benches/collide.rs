//! Nanoseconds per collision, body by body.

use collision_laws::{
    Body, CollisionLaw, Contact, Fixed, Pair, Twist,
    bodies::{Ball, Inertia, Planar, RigidBody, Spatial},
    laws::{NoSlip, RoughPlane, Specular},
};
use criterion::{Criterion, criterion_group, criterion_main};
use nalgebra::{Matrix3, SVector, Vector2, Vector3};
use std::hint::black_box;

fn against_wall<B: Body<N>, L: CollisionLaw<N>, const N: usize>(
    criterion: &mut Criterion,
    name: &str,
    law: &L,
    (body, arm): (B, SVector<f64, N>),
    v: B::Velocity,
) {
    let contact = Contact::new(SVector::zeros(), -arm, 0).expect("the arms below have a direction");
    criterion.bench_function(name, |b| {
        b.iter(|| {
            let pair = Pair::new(black_box(contact), (black_box(&body), arm), (Fixed, SVector::zeros()));
            pair.collide(law, &(black_box(v), ())).velocities.0
        });
    });
}

fn collide(criterion: &mut Criterion) {
    let plane = (Vector2::new(0.3, -0.4), Twist::planar(Vector2::new(0.1, -1.0), 0.7));
    let space =
        (Vector3::new(0.3, 0.0, -0.4), Twist::spatial(Vector3::new(0.1, 0.2, -1.0), Vector3::new(0.5, 0.6, 0.7)));
    let disk = Ball::<2>::uniform(1.0, 0.5).expect("a mass and a radius");
    let ball = Ball::<3>::uniform(1.0, 0.5).expect("a mass and a radius");
    let planar = Planar::new(1.0, 0.1).expect("a mass and a moment");
    let tensor = Matrix3::new(0.3, 0.02, 0.0, 0.02, 0.25, 0.01, 0.0, 0.01, 0.2);
    let spatial = Spatial::new(1.0, tensor).expect("a mass and a tensor");
    let rigid = RigidBody::<3>::new(1.0, Inertia::Tensor(tensor)).expect("a mass and a tensor");
    let combed = RoughPlane::new(&[Vector3::y()]).expect("one direction");

    against_wall(criterion, "disk, specular", &Specular, (disk, plane.0), plane.1);
    against_wall(criterion, "disk, no-slip", &NoSlip, (disk, plane.0), plane.1);
    against_wall(criterion, "ball, no-slip", &NoSlip, (ball, space.0), space.1);
    against_wall(criterion, "ball, one rough direction", &combed, (ball, space.0), space.1);
    against_wall(criterion, "planar body, no-slip", &NoSlip, (planar, plane.0), plane.1);
    against_wall(criterion, "spatial body, no-slip", &NoSlip, (spatial, space.0), space.1);
    against_wall(criterion, "body by second moments in 3D, no-slip", &NoSlip, (rigid, space.0), space.1);
}

criterion_group!(benches, collide);
criterion_main!(benches);
