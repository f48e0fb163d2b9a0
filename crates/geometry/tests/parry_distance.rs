//! Planar shapes known by their distance only.
#![allow(clippy::float_cmp, clippy::unwrap_used, reason = "tests panic where they fail, and claim exact values")]
mod random;

use core::f64::consts::PI;
use geometry::{
    Crossing, Figure, Line, Piece, Vector2,
    parry::{
        Side,
        parry2d_f64::{
            bounding_volume::{Aabb, BoundingSphere},
            mass_properties::MassProperties,
            math::Vector,
            query::{
                PointProjection, PointQuery, Ray, RayCast, RayIntersection,
                details::local_point_projection_on_support_map, gjk::VoronoiSimplex,
            },
            shape::{Ball, ConvexPolygon, Cuboid, FeatureId, Shape, ShapeType, SupportMap, TypedShape},
        },
        pieces,
    },
};
use nalgebra::Isometry2;
use random::Random;

/// Another shape of which nothing but its projection is known.
struct Opaque<P: Project>(P);

trait Project: Clone + Send + Sync + 'static {
    fn project(&self, point: Vector) -> (Vector, bool);
    fn half_extents(&self) -> Vector;
    fn support(&self) -> Option<&dyn SupportMap> {
        None
    }
}
impl Project for Ball {
    fn project(&self, point: Vector) -> (Vector, bool) {
        let p = self.project_local_point(point, false);
        (p.point, p.is_inside)
    }
    fn half_extents(&self) -> Vector {
        Vector::splat(self.radius)
    }
}
impl Project for Cuboid {
    fn project(&self, point: Vector) -> (Vector, bool) {
        let p = self.project_local_point(point, false);
        (p.point, p.is_inside)
    }
    fn half_extents(&self) -> Vector {
        self.half_extents
    }
}

/// The ellipse x²/a² + y²/b² ≤ 1.
#[derive(Clone, Copy)]
struct Ellipse {
    a: f64,
    b: f64,
}
impl Project for Ellipse {
    /// Bisection on the multiplier (Eberly, *Distance from a point to an ellipse*).
    fn project(&self, p: Vector) -> (Vector, bool) {
        let (a2, b2) = (self.a * self.a, self.b * self.b);
        let (x, y) = (p.x.abs(), p.y.abs());
        let inside = (p.x / self.a) * (p.x / self.a) + (p.y / self.b) * (p.y / self.b) < 1.0;
        let f = |t: f64| {
            let (u, v) = (self.a * x / (t + a2), self.b * y / (t + b2));
            u * u + v * v - 1.0
        };
        let (mut low, mut high) = (-b2 + self.b * y, -b2 + libm::hypot(self.a * x, self.b * y) + a2);
        for _ in 0..200 {
            let t = 0.5 * (low + high);
            if f(t) > 0.0 { low = t } else { high = t }
        }
        let t = 0.5 * (low + high);
        let (qx, qy) = (a2 * x / (t + a2), b2 * y / (t + b2));
        (Vector::new(qx.copysign(p.x), qy.copysign(p.y)), inside)
    }
    fn half_extents(&self) -> Vector {
        Vector::new(self.a, self.b)
    }
}

/// A convex shape of which nothing but its support map is known, projected as parry does it.
#[derive(Clone)]
struct Convex<S>(S, Vector);

impl<S: SupportMap + Clone + Send + Sync + 'static> Project for Convex<S> {
    fn project(&self, point: Vector) -> (Vector, bool) {
        let p = local_point_projection_on_support_map(&self.0, &mut VoronoiSimplex::new(), point, false);
        (p.point, p.is_inside)
    }
    fn half_extents(&self) -> Vector {
        self.1
    }
    fn support(&self) -> Option<&dyn SupportMap> {
        Some(&self.0)
    }
}
impl SupportMap for Ellipse {
    fn local_support_point(&self, d: Vector) -> Vector {
        let (x, y) = (self.a * d.x, self.b * d.y);
        let length = libm::sqrt(x * x + y * y);
        Vector::new(self.a * x / length, self.b * y / length)
    }
}
fn hexagon() -> ConvexPolygon {
    let corners = (0..6).map(|k| PI / 3.0 * f64::from(k)).map(|a| Vector::new(libm::cos(a), libm::sin(a)));
    ConvexPolygon::from_convex_polyline(corners.collect()).unwrap()
}

impl<P: Project> PointQuery for Opaque<P> {
    fn project_local_point(&self, point: Vector, solid: bool) -> PointProjection {
        let (foot, inside) = self.0.project(point);
        PointProjection::new(inside, if solid && inside { point } else { foot })
    }
    fn project_local_point_and_get_feature(&self, point: Vector) -> (PointProjection, FeatureId) {
        (self.project_local_point(point, false), FeatureId::Unknown)
    }
}
impl<P: Project> RayCast for Opaque<P> {
    fn cast_local_ray_and_get_normal(&self, _: &Ray, _: f64, _: bool) -> Option<RayIntersection> {
        unimplemented!("rays are not parry's business here")
    }
}
impl<P: Project> Shape for Opaque<P> {
    fn compute_local_aabb(&self) -> Aabb {
        Aabb::new(-self.0.half_extents(), self.0.half_extents())
    }
    fn compute_local_bounding_sphere(&self) -> BoundingSphere {
        BoundingSphere::new(Vector::ZERO, self.0.half_extents().length())
    }
    fn clone_dyn(&self) -> Box<dyn Shape> {
        Box::new(Opaque(self.0.clone()))
    }
    fn scale_dyn(&self, _: Vector, _: u32) -> Option<Box<dyn Shape>> {
        None
    }
    fn mass_properties(&self, _: f64) -> MassProperties {
        MassProperties::new(Vector::ZERO, 0.0, 0.0)
    }
    fn as_support_map(&self) -> Option<&dyn SupportMap> {
        self.0.support()
    }
    fn shape_type(&self) -> ShapeType {
        ShapeType::Custom
    }
    fn as_typed_shape(&self) -> TypedShape<'_> {
        TypedShape::Custom(self)
    }
    fn ccd_thickness(&self) -> f64 {
        0.0
    }
    fn ccd_angular_thickness(&self) -> f64 {
        0.0
    }
}

fn one(shape: &dyn Shape, side: Side) -> Box<dyn Piece> {
    let mut pieces = pieces(shape, &Isometry2::identity(), side).unwrap();
    assert_eq!(pieces.len(), 1);
    pieces.swap_remove(0)
}
/// The first crossing of exact pieces.
fn exact(pieces: &[Box<dyn Piece>], path: &Line<2>) -> f64 {
    let crossings = pieces.iter().map(|p| p.crossing(path));
    crossings.reduce(|a, b| if b.before(&a) { b } else { a }).unwrap_or(Crossing::NEVER).time()
}

#[test]
fn a_shape_of_ones_own_becomes_a_piece() {
    assert_eq!(one(&Opaque(Ball::new(1.0)), Side::Inside).figure(), Figure::Other);
}

#[test]
fn first_hits_agree_with_the_exact_pieces() {
    let shapes: [(Box<dyn Shape>, Box<dyn Shape>); 4] = [
        (Box::new(Opaque(Convex(Ball::new(1.5), Vector::splat(1.5)))), Box::new(Ball::new(1.5))),
        (Box::new(Opaque(Convex(hexagon(), Vector::splat(1.0)))), Box::new(hexagon())),
        (Box::new(Opaque(Ball::new(1.5))), Box::new(Ball::new(1.5))),
        (Box::new(Opaque(Cuboid::new(Vector::new(1.5, 0.5)))), Box::new(Cuboid::new(Vector::new(1.5, 0.5)))),
    ];
    let mut random = Random(7);
    for (opaque, plain) in &shapes {
        for side in [Side::Inside, Side::Outside] {
            let piece = one(&**opaque, side);
            let reference = pieces(&**plain, &Isometry2::identity(), side).unwrap();
            let (mut hits, mut misses) = (0, 0);
            for _ in 0..2000 {
                let p = Vector2::new(random.between(-3.0, 3.0), random.between(-3.0, 3.0));
                if (plain.distance_to_local_point(Vector::new(p.x, p.y), false) > 0.0) != (side == Side::Outside) {
                    continue;
                }
                let angle = random.between(0.0, 2.0 * PI);
                let path = Line { point: p, velocity: Vector2::new(libm::cos(angle), libm::sin(angle)) * 3.0 };
                let (found, expected) = (piece.crossing(&path).time(), exact(&reference, &path));
                if expected == f64::INFINITY {
                    assert_eq!(found, expected);
                    misses += 1;
                    continue;
                }
                let landing = piece.landing(&path, found);
                // the error of the distance, a few ulp of 3, over the sine of the angle of incidence
                let sine = -path.velocity.dot(&landing.normal) / 3.0;
                assert!((found - expected).abs() < 4e-15 / sine, "{:e} at sine {sine}", found - expected);
                hits += 1;
            }
            assert!(hits > 100 && (misses > 100 || side == Side::Inside));
        }
    }
}

#[test]
fn a_billiard_in_an_ellipse_keeps_its_invariant() {
    // the product of the angular momenta about the foci is conserved between two foci
    let (a, b) = (2.0, 1.0);
    keeps_its_invariant(&*one(&Opaque(Ellipse { a, b }), Side::Inside), a, b);
}

#[test]
fn so_does_one_of_which_only_the_support_map_is_known() {
    // parry's own projection onto it errs by 1e-6 on the boundary and 1e-5 inside
    let (a, b) = (2.0, 1.0);
    let shape = Opaque(Convex(Ellipse { a, b }, Vector::new(a, b)));
    keeps_its_invariant(&*one(&shape, Side::Inside), a, b);
}

fn keeps_its_invariant(piece: &dyn Piece, a: f64, b: f64) {
    let c = libm::sqrt(a * a - b * b);
    let invariant = |path: &Line<2>| {
        let about = |x: f64| (path.point.x - x) * path.velocity.y - path.point.y * path.velocity.x;
        about(c) * about(-c)
    };
    for angle in [0.3, 1.0, 1.4, 2.9] {
        let mut path =
            Line { point: Vector2::new(0.3, 0.2), velocity: Vector2::new(libm::cos(angle), libm::sin(angle)) };
        let start = invariant(&path);
        for _ in 0..300 {
            let time = piece.crossing(&path).time();
            assert!(time > 1e-3 && time < 4.5, "{time} {path:?}");
            let landing = piece.landing(&path, time);
            let off = libm::pow(landing.point.x / a, 2.0) + libm::pow(landing.point.y / b, 2.0) - 1.0;
            assert!(off.abs() < 1e-14, "{off:e}");
            let gradient = Vector2::new(landing.point.x / (a * a), landing.point.y / (b * b));
            let normal = -gradient / gradient.norm();
            assert!((landing.normal - normal).norm() < 1e-12, "{:e}", (landing.normal - normal).norm());
            let velocity = path.velocity - landing.normal * (2.0 * path.velocity.dot(&landing.normal));
            path = Line { point: landing.point, velocity };
        }
        // 300 normals good to 1e-13
        assert!((invariant(&path) - start).abs() < 1e-11, "{:e}", invariant(&path) - start);
    }
}

#[test]
fn a_path_from_a_wall_gets_away_next_to_a_corner() {
    let shape = Cuboid::new(Vector::new(1.5, 0.5));
    let piece = one(&Opaque(shape), Side::Inside);
    let reference = pieces(&shape, &Isometry2::identity(), Side::Inside).unwrap();
    // normals are known down to 10⁻⁵ of the size from a corner
    for k in 1..=9 {
        let point = Vector2::new(-1.5, 0.5 - 0.9 * libm::pow(10.0, -0.5 * f64::from(k)));
        for j in 1..16 {
            let angle = PI * (f64::from(j) / 16.0 - 0.5);
            let path = Line { point, velocity: Vector2::new(libm::cos(angle), libm::sin(angle)) };
            let (found, expected) = (piece.crossing(&path).time(), exact(&reference, &path));
            let sine = -path.velocity.dot(&piece.landing(&path, expected).normal);
            // the error of the distance, a few ulp of 1.5, over the sine of the angle of incidence
            assert!((found - expected).abs() < 4e-15 / sine, "{point:?} {angle}: {found:e} for {expected:e}");
        }
    }
}

#[test]
fn grazing_chords_of_a_circle_come_back_within_conditioning() {
    let piece = one(&Opaque(Ball::new(1.0)), Side::Inside);
    for k in 0..8 {
        let theta = libm::pow(10.0, -f64::from(k));
        for turn in [0.0, 0.4, 1.9] {
            let (p, tangent) =
                (Vector2::new(libm::cos(turn), libm::sin(turn)), Vector2::new(-libm::sin(turn), libm::cos(turn)));
            let path = Line { point: p, velocity: tangent * libm::cos(theta) - p * libm::sin(theta) };
            let time = piece.crossing(&path).time();
            // the chord 2 sin θ; the start is off the circle by an ulp, which moves both roots by ulp/θ
            let error = (time - 2.0 * libm::sin(theta)).abs();
            assert!(error < 16.0 * f64::EPSILON / theta, "θ = {theta:e}: {error:e}");
        }
    }
}

#[test]
fn grazing_a_flat_wall_needs_few_projections() {
    use std::sync::{
        Arc,
        atomic::{AtomicUsize, Ordering},
    };
    #[derive(Clone)]
    struct Counted(Cuboid, Arc<AtomicUsize>);
    impl Project for Counted {
        fn project(&self, point: Vector) -> (Vector, bool) {
            self.1.fetch_add(1, Ordering::Relaxed);
            self.0.project(point)
        }
        fn half_extents(&self) -> Vector {
            self.0.half_extents
        }
    }
    let count = Arc::new(AtomicUsize::new(0));
    let piece = one(&Opaque(Counted(Cuboid::new(Vector::new(1.0, 1.0)), count.clone())), Side::Inside);
    for (theta, most) in [(0.5, 100), (1e-2, 200), (1e-4, 1000), (1e-6, 10_000)] {
        count.store(0, Ordering::Relaxed);
        let start = Vector2::new(-0.75, -1.0 + 0.5 * theta);
        let time = piece.crossing(&Line { point: start, velocity: Vector2::new(1.0, -theta) }).time();
        assert!((time - (start.y + 1.0) / theta).abs() < 8.0 * f64::EPSILON / theta);
        // √(2/θ) balls; a march along the path itself would need 36/θ
        let used = count.load(Ordering::Relaxed);
        assert!(used < most, "θ = {theta:e}: {used}");
    }
}

#[test]
fn a_start_on_the_boundary_is_no_hit_unless_it_moves_out() {
    let mut random = Random(8);
    for (side, sign) in [(Side::Inside, 1.0), (Side::Outside, -1.0)] {
        let piece = one(&Opaque(Ball::new(1.0)), side);
        for _ in 0..500 {
            let angle = random.between(0.0, 2.0 * PI);
            let p = Vector2::new(libm::cos(angle), libm::sin(angle));
            let out = p * sign;
            let along = Vector2::new(-p.y, p.x) * random.between(-1.0, 1.0);
            let inwards = Line { point: p, velocity: along - out * 0.2 };
            let time = piece.crossing(&inwards).time();
            assert!(time > 0.1, "{time:e}"); // infinite outside
            let outwards = Line { point: p, velocity: along + out * 0.2 };
            assert!(piece.crossing(&outwards).time() < 1e-14);
        }
    }
}

#[test]
fn arc_length_and_curvature_are_traced() {
    let (a, b) = (2.0, 1.0);
    for (side, sign) in [(Side::Inside, 1.0), (Side::Outside, -1.0)] {
        let piece = one(&Opaque(Ellipse { a, b }), side);
        // perimeter 4 a E(√3/2), by the arithmetic-geometric mean
        assert!((piece.length() - 9.688_448_220_547_675).abs() < 1e-11, "{}", piece.length());
        assert!((piece.area() - sign * 2.0 * PI).abs() < 1e-11, "{}", piece.area());
        for k in 0..50 {
            let s = piece.length() * (f64::from(k) + 0.3) / 50.0;
            let p = piece.point_at(s);
            assert!((piece.arc_length_at(&p) - s).abs() < 1e-11, "{:e}", piece.arc_length_at(&p) - s);
            let q = piece.point_at(s + 1e-4);
            let d = q - p;
            let normal = piece.closest(&p).normal;
            // traversed with the table on the left
            assert!(d.x * normal.y - d.y * normal.x > 0.99e-4);
            let t = libm::atan2(p.y / b, p.x / a);
            let w = libm::hypot(a * libm::sin(t), b * libm::cos(t));
            let curvature = sign * a * b / (w * w * w);
            assert!((piece.curvature(&p) - curvature).abs() < 1e-7, "{:e}", piece.curvature(&p) - curvature);
        }
    }
    let cuboid = one(&Opaque(Cuboid::new(Vector::new(1.5, 0.5))), Side::Inside);
    // four corners at 10⁻⁸ of the size each
    assert!((cuboid.length() - 8.0).abs() < 1e-7, "{:e}", cuboid.length() - 8.0);
    assert!((cuboid.area() - 3.0).abs() < 1e-11);
}
