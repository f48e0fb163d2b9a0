//! Planar parry shapes as exact pieces.
#![allow(clippy::float_cmp, clippy::unwrap_used, reason = "tests panic where they fail, and claim exact values")]
#[path = "../random/mod.rs"]
mod random;
mod unions;

use core::f64::consts::PI;
use geometry::{
    Crossing, Error, Figure, Landing, Lattice, Line, Perimeter, Piece, Table, Vector2, Walls, WithWalls,
    parry::{
        Placed, ShapeSpec, Side,
        parry2d_f64::{
            math::{IVector, Pose, Vector},
            shape::{
                Ball, Capsule, Compound, ConvexPolygon, Cuboid, HalfSpace, HeightField, Polyline, RoundShape, Segment,
                Shape, SharedShape, TriMesh, Triangle, Voxels,
            },
        },
        pieces,
    },
    shapes::Screen,
};
use nalgebra::Isometry2;
use random::Random;

fn glam(points: &[[f64; 2]]) -> Vec<Vector> {
    points.iter().map(|p| Vector::new(p[0], p[1])).collect()
}

fn here() -> Isometry2<f64> {
    Isometry2::identity()
}

fn table(shape: &dyn Shape, side: Side) -> Table {
    Table::new(pieces(shape, &here(), side).unwrap()).unwrap()
}

fn first(pieces: &[Box<dyn Piece>], path: &Line<2>) -> Option<(usize, f64)> {
    let mut best = (Crossing::NEVER, None);
    for (i, piece) in pieces.iter().enumerate() {
        let crossing = piece.crossing(path);
        if crossing.before(&best.0) {
            best = (crossing, Some(i));
        }
    }
    best.1.map(|i| (i, best.0.time()))
}

/// Bounces a point about, and returns how far it came off the boundary and outwards.
fn fly(pieces: &[Box<dyn Piece>], start: [f64; 2], velocity: [f64; 2], bounces: usize) -> Result<f64, String> {
    let mut path = Line { point: start.into(), velocity: velocity.into() };
    let mut worst: f64 = 0.0;
    for n in 0..bounces {
        let Some((i, time)) = first(pieces, &path) else { return Err(format!("lost after {n} bounces at {path:?}")) };
        let landing = pieces[i].landing(&path, time);
        worst = worst.max((landing.point - pieces[i].closest(&landing.point).point).norm());
        let out = path.velocity.dot(&landing.normal);
        if out >= 0.0 {
            return Err(format!("normal the wrong way after {n} bounces"));
        }
        path = Line { point: landing.point, velocity: path.velocity - landing.normal * (2.0 * out) };
    }
    Ok(worst)
}

/// Every shape that is made of segments and arcs and has an inside, with its area and perimeter.
fn shapes() -> Vec<(&'static str, Box<dyn Shape>, f64, f64)> {
    let l = glam(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]]);
    let clockwise: Vec<Vector> = l.iter().rev().copied().collect();
    let around: Vec<[u32; 2]> = (0..6).map(|i| [i, (i + 1) % 6]).collect();
    let hexagon: Vec<Vector> =
        (0..6).map(|k| PI / 3.0 * f64::from(k)).map(|a| Vector::new(libm::cos(a), libm::sin(a))).collect();
    let r = 0.25;
    let hex_area = 1.5 * libm::sqrt(3.0);
    let mesh_vertices = glam(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [0.0, 1.0], [1.0, 1.0], [2.0, 1.0]]);
    // triangles in both senses: their inner edges must vanish all the same
    let mesh = vec![[0, 1, 4], [0, 3, 4], [1, 2, 5], [1, 4, 5]];
    vec![
        ("ball", Box::new(Ball::new(2.0)), 4.0 * PI, 4.0 * PI),
        ("cuboid", Box::new(Cuboid::new(Vector::new(1.0, 0.5))), 2.0, 6.0),
        (
            "capsule",
            Box::new(Capsule::new(Vector::new(0.0, -1.0), Vector::new(0.0, 1.0), 0.5)),
            2.0 + PI / 4.0,
            4.0 + PI,
        ),
        (
            "triangle",
            Box::new(Triangle::new(Vector::new(0.0, 0.0), Vector::new(0.0, 3.0), Vector::new(4.0, 0.0))),
            6.0,
            12.0,
        ),
        ("polyline", Box::new(Polyline::new(l.clone(), Some(around.clone()))), 3.0, 8.0),
        ("clockwise polyline", Box::new(Polyline::new(clockwise, Some(around))), 3.0, 8.0),
        ("hexagon", Box::new(ConvexPolygon::from_convex_polyline(hexagon.clone()).unwrap()), hex_area, 6.0),
        (
            "round cuboid",
            Box::new(RoundShape { inner_shape: Cuboid::new(Vector::new(1.0, 0.5)), border_radius: r }),
            2.0 + 6.0 * r + PI * r * r,
            6.0 + 2.0 * PI * r,
        ),
        (
            "round triangle",
            Box::new(RoundShape {
                inner_shape: Triangle::new(Vector::new(0.0, 0.0), Vector::new(4.0, 0.0), Vector::new(0.0, 3.0)),
                border_radius: r,
            }),
            6.0 + 12.0 * r + PI * r * r,
            12.0 + 2.0 * PI * r,
        ),
        (
            "round hexagon",
            Box::new(RoundShape {
                inner_shape: ConvexPolygon::from_convex_polyline(hexagon).unwrap(),
                border_radius: r,
            }),
            hex_area + 6.0 * r + PI * r * r,
            6.0 + 2.0 * PI * r,
        ),
        ("triangle mesh", Box::new(TriMesh::new(mesh_vertices, mesh).unwrap()), 2.0, 6.0),
        (
            "voxels",
            Box::new(Voxels::new(
                Vector::new(0.5, 0.5),
                &[IVector::new(0, 0), IVector::new(1, 0), IVector::new(1, 1), IVector::new(-1, 0)],
            )),
            1.0,
            5.0,
        ),
    ]
}

#[test]
fn shapes_of_segments_and_arcs_have_their_area_and_perimeter_on_either_side() {
    for (name, shape, area, perimeter) in shapes() {
        for (side, sign) in [(Side::Inside, 1.0), (Side::Outside, -1.0)] {
            let table = table(&*shape, side);
            // sums of a dozen terms of order 10
            assert!((table.area() - sign * area).abs() < 1e-13, "{name}: {}", table.area());
            assert!((table.perimeter() - perimeter).abs() < 1e-13, "{name}: {}", table.perimeter());
        }
    }
}

#[test]
fn a_pose_turns_and_moves_the_table() {
    for (name, shape, area, _) in shapes() {
        let pose = Isometry2::new(Vector2::new(3.0, -7.0), 0.7);
        let table = Table::new(pieces(&*shape, &pose, Side::Inside).unwrap()).unwrap();
        let there = Table::new(pieces(&*shape, &here(), Side::Inside).unwrap()).unwrap();
        // area by Green's theorem about an origin at distance 8: rounding of 8² in each of some ten terms
        assert!((table.area() - area).abs() < 1e-12, "{name}: {}", table.area());
        for k in 0..20 {
            let p = table.pieces()[0].point_at(table.pieces()[0].length() * (0.5 + f64::from(k)) / 20.0);
            let own = pose.inverse_transform_point(&p.into());
            let off = there.signed_distance(&own.coords);
            assert!(off.abs() < 1e-14, "{name}: {off:e}");
        }
    }
}

#[test]
fn no_path_is_lost_inside_any_shape_and_none_restarts_on_its_own_wall() {
    for (name, shape, ..) in shapes() {
        let pieces = pieces(&*shape, &here(), Side::Inside).unwrap();
        let table = Table::new(pieces_again(&*shape)).unwrap();
        let mut random = Random(1);
        for _ in 0..20 {
            let start = loop {
                let e = table.extent();
                let p = [random.between(e.min.x, e.max.x), random.between(e.min.y, e.max.y)];
                if table.signed_distance(&p.into()) > 1e-3 {
                    break p;
                }
            };
            let angle = random.between(0.0, 2.0 * PI);
            let worst = fly(&pieces, start, [libm::cos(angle), libm::sin(angle)], 500).unwrap();
            // landing points are projected: a few ulp of coordinates of order 4
            assert!(worst < 1e-14, "{name}: {worst:e}");
        }
    }
}

fn pieces_again(shape: &dyn Shape) -> Vec<Box<dyn Piece>> {
    pieces(shape, &here(), Side::Inside).unwrap()
}

#[test]
fn paths_aimed_at_vertices_do_not_leak() {
    for (name, shape, ..) in shapes() {
        let pieces = pieces(&*shape, &here(), Side::Inside).unwrap();
        let table = Table::new(pieces_again(&*shape)).unwrap();
        let vertices: Vec<_> = table.pieces().iter().filter_map(Piece::ends).map(|e| e[0]).collect();
        let mut random = Random(2);
        let (mut lost, mut asked) = (0, 0);
        while asked < 20_000 && !vertices.is_empty() {
            let e = table.extent();
            let p = Vector2::new(random.between(e.min.x, e.max.x), random.between(e.min.y, e.max.y));
            if table.signed_distance(&p) < 1e-3 {
                continue;
            }
            for v in &vertices {
                asked += 1;
                lost += usize::from(first(&pieces, &Line { point: p, velocity: v - p }).is_none());
            }
        }
        assert_eq!(lost, 0, "{name}: of {asked}");
    }
}

#[test]
fn tiny_shapes_behave_like_large_ones_to_the_last_bit() {
    // parry's rays fail below 1e-8; 2^−100 is 8e-31
    let scale = libm::ldexp(1.0, -100);
    let placed = |s: f64| Placed::from(ShapeSpec::RoundCuboid { half_extents: [s, 0.5 * s], border_radius: 0.25 * s });
    let (large, small) = (placed(1.0).pieces(Side::Inside).unwrap(), placed(scale).pieces(Side::Inside).unwrap());
    let mut path = Line { point: Vector2::new(0.1, 0.2), velocity: Vector2::new(0.6, 0.8) };
    for _ in 0..1000 {
        let tiny = Line { point: path.point * scale, velocity: path.velocity * scale };
        let (a, b) = (first(&large, &path).unwrap(), first(&small, &tiny).unwrap());
        assert_eq!(a, b);
        let landing = large[a.0].landing(&path, a.1);
        assert_eq!(small[b.0].landing(&tiny, b.1).point, landing.point * scale);
        let velocity = path.velocity - landing.normal * (2.0 * path.velocity.dot(&landing.normal));
        path = Line { point: landing.point, velocity };
    }
}

#[test]
fn grazing_paths_hit_a_polygon_within_conditioning() {
    let pieces = pieces(&Cuboid::new(Vector::new(1.0, 1.0)), &here(), Side::Inside).unwrap();
    for k in 1..15 {
        // from the middle of the left side just above the floor, down at angle θ: hits after height/θ
        let theta = libm::pow(10.0, -f64::from(k));
        let height = 0.5 * theta;
        let start = Vector2::new(-0.75, -1.0 + height);
        let exact = (start.y + 1.0) / theta; // with the height as rounded
        let (_, time) = first(&pieces, &Line { point: start, velocity: Vector2::new(1.0, -theta) }).unwrap();
        assert!((time - exact).abs() <= 4.0 * f64::EPSILON / theta, "θ = {theta:e}: {:e}", time - exact);
    }
}

#[test]
fn nested_loops_of_a_polyline_alternate() {
    let square = |h: f64| [[-h, -h], [h, -h], [h, h], [-h, h]];
    let all: Vec<[f64; 2]> = [3.0, 2.0, 1.0].into_iter().flat_map(square).collect();
    let edges = (0..12_u32).map(|i| [i, i / 4 * 4 + (i + 1) % 4]).collect();
    let table = table(&Polyline::new(glam(&all), Some(edges)), Side::Inside);
    assert_eq!(table.area(), 36.0 - 16.0 + 4.0);
    for (x, inside) in [(0.0, true), (1.5, false), (2.5, true), (3.5, false)] {
        assert_eq!(table.contains(&Vector2::new(x, 0.0)), inside, "at {x}");
    }
}

#[test]
fn open_polylines_and_segments_are_walls_on_both_sides() {
    let zigzag = Polyline::new(glam(&[[-1.0, 0.0], [0.0, 0.5], [1.0, 0.0]]), None);
    let walls = pieces(&zigzag, &here(), Side::Outside).unwrap();
    assert_eq!(walls.len(), 2);
    for (y, vy) in [(2.0, -1.0), (-2.0, 1.0)] {
        for x in [-0.5, 0.0, 0.3] {
            let path = Line { point: Vector2::new(x, y), velocity: Vector2::new(0.0, vy) };
            let (i, time) = first(&walls, &path).unwrap();
            assert!((time - (2.0 + vy.signum() * (0.5 - 0.5 * x.abs()))).abs() < 1e-15);
            assert!(walls[i].landing(&path, time).normal.y * vy < 0.0);
        }
    }
    assert!(matches!(pieces(&zigzag, &here(), Side::Inside), Err(Error::Shape { shape: "polyline", .. })));
    let wall = Segment::new(Vector::new(0.0, 0.0), Vector::new(1.0, 0.0));
    assert_eq!(pieces(&wall, &here(), Side::Outside).unwrap().len(), 1);
    assert!(Screen::new(Vector2::zeros(), Vector2::zeros()).is_err());
    // there is room for every disk beside them
    assert!(Table::new(walls).unwrap().largest_disk().radius.is_infinite());

    // they may meet at their tips, or a tip may touch another wall, but they may not cross
    let valid = |points: &[[f64; 2]]| {
        let mut walls = pieces(&Ball::new(4.0), &here(), Side::Inside).unwrap();
        walls.extend(pieces(&Polyline::new(glam(points), None), &here(), Side::Outside).unwrap());
        Table::new(walls).unwrap().validate()
    };
    assert_eq!(valid(&[[-1.0, 0.0], [0.0, 0.25], [1.0, 0.0]]), Ok(()));
    assert_eq!(valid(&[[-1.0, 0.0], [0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.5, 0.0]]), Ok(()));
    assert!(valid(&[[-1.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.5, -1.0]]).is_err());
}

/// The normal of the left face of a wall without thickness.
fn left(wall: &dyn Piece) -> Vector2<f64> {
    let [a, b] = wall.tips().unwrap();
    Vector2::new(a.y - b.y, b.x - a.x).normalize()
}

#[test]
fn an_arc_length_tells_the_face_of_a_thin_wall_and_a_normal_tells_the_arc_length() {
    for [a, b] in [[[-0.5, 0.0], [0.5, 0.0]], [[0.02, 0.9], [-0.1, 0.16]], [[-0.3, 0.1], [0.7, -0.4]]] {
        let screen = Screen::new(a.into(), b.into()).unwrap();
        let length = screen.length();
        for k in 0..2000 {
            let s = length * (f64::from(k) + 0.5) / 2000.0;
            let at = screen.landing_at(s);
            assert_eq!(at.point, screen.point_at(s));
            let along_left = at.normal.dot(&left(&screen));
            // a unit vector, and a length, after a few operations
            assert!((along_left - if k < 1000 { 1.0 } else { -1.0 }).abs() < 4.0 * f64::EPSILON);
            assert!((screen.arc_length_of(&at) - s).abs() < 4.0 * f64::EPSILON, "{a:?} {b:?} {s}");
        }
    }
}

#[test]
fn points_of_a_boundary_are_spread_over_both_faces_of_thin_walls() {
    let zigzag = Polyline::new(glam(&[[0.05, 0.3], [0.75, 0.45], [1.25, 0.1]]), None);
    let mut walls = pieces(&Ball::new(2.0), &here(), Side::Inside).unwrap();
    let thin = || pieces(&zigzag, &here(), Side::Outside).unwrap();
    walls.extend(thin());
    let torus = Lattice::new(&[Vector2::new(1.0, 0.0), Vector2::new(0.0, 1.0)]).unwrap();
    for table in [Table::new(walls).unwrap(), Table::periodic(thin(), Some(torus)).unwrap()] {
        let perimeter = Perimeter::of(&table).unwrap();
        let n = 10_000;
        let mut counts = vec![[0.0; 2]; table.pieces().len()];
        for k in 0..n {
            let at = perimeter.point((f64::from(k) + 0.5) / f64::from(n));
            let piece = &table.pieces()[at.piece];
            let s = table.arc_length(at.piece, &Landing { point: at.point, normal: at.normal });
            assert!((s - at.arc_length).abs() < 64.0 * f64::EPSILON, "{at:?}: {s}"); // lengths of up to 4π
            if piece.tips().is_some() {
                counts[at.piece][usize::from(at.normal.dot(&left(&**piece)) < 0.0)] += 1.0;
            }
        }
        for (piece, counts) in table.pieces().iter().zip(counts).filter(|(piece, _)| piece.tips().is_some()) {
            let each = f64::from(n) * 0.5 * piece.length() / table.perimeter();
            assert!(counts.iter().all(|count: &f64| (count - each).abs() <= 1.0), "{counts:?}, {each} each");
        }
    }
}

#[test]
fn height_fields_face_upwards_and_do_not_leak_between_cells() {
    // parry flips the normals of 88 % of the hits
    let n = 49; // cell widths that are not representable
    let heights: Vec<f64> = (0..=n).map(|i| libm::sin(f64::from(i))).collect();
    let field = HeightField::new(heights, Vector::new(3.0, 0.2));
    let above = pieces(&field, &here(), Side::Outside).unwrap();
    let below = pieces(&field, &here(), Side::Inside).unwrap();
    for k in 0..10_000 {
        let x = -1.499 + 2.98 * f64::from(k) / 10_000.0;
        let down = Line { point: Vector2::new(x, 1.0), velocity: Vector2::new(0.01, -1.0) };
        let (i, time) = first(&above, &down).unwrap();
        assert!(above[i].landing(&down, time).normal.y > 0.0);
        assert!(first(&below, &down).is_none());
        let up = Line { point: Vector2::new(x, -1.0), velocity: Vector2::new(0.01, 1.0) };
        let (i, time) = first(&below, &up).unwrap();
        assert!(below[i].landing(&up, time).normal.y < 0.0);
        assert!(first(&above, &up).is_none());
    }
    for pair in above.windows(2) {
        let [a, b] = [pair[0].ends().unwrap(), pair[1].ends().unwrap()];
        assert_eq!(a[1], b[0]);
    }
}

#[test]
fn the_table_of_a_half_space_lies_on_the_side_asked_for() {
    let half = HalfSpace::new(Vector::new(0.6, 0.8));
    let out = Vector2::new(0.6, 0.8);
    for (side, sign) in [(Side::Outside, 1.0), (Side::Inside, -1.0)] {
        let walls = pieces(&half, &here(), side).unwrap();
        let path = Line { point: out * sign, velocity: -out * sign };
        let (i, time) = first(&walls, &path).unwrap();
        assert!((time - 1.0).abs() < 4.0 * f64::EPSILON);
        assert!((walls[i].landing(&path, time).normal - out * sign).norm() < 4.0 * f64::EPSILON);
    }
}

#[test]
fn a_mesh_without_area_is_refused() {
    let corners = vec![Vector::new(0.0, 0.0), Vector::new(1.0, 0.0), Vector::new(0.0, 1.0)];
    let mesh = |triangles: &[[u32; 3]]| {
        let mesh = TriMesh::new(corners.clone(), triangles.to_vec()).unwrap();
        pieces(&mesh, &Isometry2::identity(), Side::Outside)
    };
    assert!(matches!(mesh(&[[0, 1, 1]]), Err(Error::Shape { .. })));
    assert_eq!(mesh(&[[0, 1, 1], [0, 1, 2]]).unwrap().len(), 3);
}

#[test]
fn a_polyline_there_and_back_is_one_wall_and_one_without_area_none() {
    let line = |points: &[[f64; 2]]| {
        let points: Vec<_> = points.iter().map(|&[x, y]| Vector::new(x, y)).collect();
        pieces(&Polyline::new(points, None), &Isometry2::identity(), Side::Outside)
    };
    assert_eq!(line(&[[0.0, 0.0], [1.0, 0.0], [0.0, 0.0]]).unwrap().len(), 1);
    assert_eq!(line(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]]).unwrap().len(), 2);
    for x in [2.0, 0.5] {
        let flat = line(&[[0.0, 0.0], [1.0, 0.0], [x, 1e-17], [0.0, 0.0]]);
        assert!(matches!(flat, Err(Error::Shape { shape: "polyline", .. })), "{x}");
    }
}

#[test]
fn a_polyline_whose_parts_cancel_crosses_itself() {
    let around = [[0, 1], [1, 2], [2, 3], [3, 0]];
    let bow = Polyline::new(glam(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]), Some(around.to_vec()));
    for side in [Side::Inside, Side::Outside] {
        let error = Table::new(pieces(&bow, &here(), side).unwrap()).unwrap().validate();
        assert!(matches!(error, Err(Error::Crossing { at: [0.5, 0.5], .. })), "{error:?}");
    }
}

struct Count;
impl WithWalls<2> for Count {
    type Output = usize;
    fn run<W: Walls<2>>(self, walls: &W) -> usize {
        let mut path = Line { point: Vector2::new(0.1, 0.2), velocity: Vector2::new(0.6, 0.8) };
        let mut count = 0;
        while let Some(hit) = walls.hit(&path).filter(|_| count < 1000) {
            let velocity = path.velocity - hit.normal * (2.0 * path.velocity.dot(&hit.normal));
            path = Line { point: hit.point, velocity };
            count += 1;
        }
        count
    }
}

#[test]
fn the_pieces_serve_the_fast_walls_of_a_table() {
    let capsule = table(&Capsule::new(Vector::new(-1.0, 0.0), Vector::new(1.0, 0.0), 1.0), Side::Inside);
    assert_eq!(capsule.with_walls(Count), 1000);
}
