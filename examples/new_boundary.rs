//! How do I add a boundary of my own?
//!
//! A parabolic mirror, x2 = x1²/4: one type, one function that says where a path first leaves it. Expected: a ray along
//! the axis goes through the focus (0, 1) after one reflection and along the axis again after two.
//! Reference: Diocles, *On burning mirrors*.
use billiards::{
    Billiard, Collisions, Orbit,
    geometry::{Boundary, Hit, Line, Vector2, walls::ByLane},
    laws::Specular,
    observe::Nearest,
    run,
};

/// The table is the region above the parabola x2 = x1²/4.
struct Parabola;

impl Boundary<2> for Parabola {
    fn first_hit(&self, path: &Line<2>) -> Option<Hit<2>> {
        let (x, v) = (path.point, path.velocity);
        // the height above the parabola is h + b t − a t²; it falls through 0 at the larger root
        let (a, b, h) = (v.x * v.x / 4.0, v.y - x.x * v.x / 2.0, (x.y - x.x * x.x / 4.0).max(0.0));
        let root = (b * b + 4.0 * a * h).sqrt();
        let time = if b > 0.0 { (b + root) / (2.0 * a) } else { 2.0 * h / (root - b) };
        if !time.is_finite() {
            return None; // along the axis to infinity
        }
        let x1 = x.x + time * v.x;
        let point = Vector2::new(x1, x1 * x1 / 4.0);
        Some(Hit { time, point, normal: Vector2::new(-x1 / 2.0, 1.0).normalize(), piece: 0, corner: false })
    }
}

fn main() {
    let billiard = Billiard { walls: &ByLane(Parabola), law: &Specular };
    let mut orbit = Orbit::<f64, 2, 0>::new([1.5, 5.0], [0.0, -1.0], [], ());
    run(&billiard, &mut orbit, &Collisions(1), &mut ());
    let mut focus = Nearest::to([0.0, 1.0], &orbit);
    run(&billiard, &mut orbit, &Collisions(1), &mut focus);

    println!("passes the focus at a distance of {:.1e}", focus.distance());
    println!("leaves at {:?} with velocity {:?}", orbit.position, orbit.velocity);
    assert!(focus.distance() < 1e-14);
    assert!(orbit.velocity[0].abs() < 1e-14 && (orbit.velocity[1] - 1.0).abs() < 1e-14);
    assert!((orbit.position[0] + 4.0 / 1.5).abs() < 1e-14); // x1 x1' = −4 for the ends of a chord through the focus
}
