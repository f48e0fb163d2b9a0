//! Where the centre of a disk can be.
mod all_but_straight;
mod closed;
mod cusps;
mod flat_arcs;
mod lattices;
mod near_curves;
mod nearly_largest;
mod normals;
mod swallowtails;
mod thin_walls;

use core::f64::consts::PI;
use geometry::{
    Error, Figure, Lattice, Line, Origin, Outline, Piece, Table, Turn, Vector2, Walls, WithWalls,
    shapes::{Arc, Circle, Ellipse, FullLine, Ray, Screen, Segment},
    tables,
};

fn v(x: f64, y: f64) -> Vector2<f64> {
    Vector2::new(x, y)
}
fn polygon(vertices: &[[f64; 2]]) -> Vec<Box<dyn Piece>> {
    let mut o = Outline::from(vertices[0].into());
    for &p in vertices[1..].iter().chain([&vertices[0]]) {
        o = o.line_to(p.into()).unwrap();
    }
    o.close().unwrap()
}
fn table(pieces: Vec<Box<dyn Piece>>) -> Table {
    Table::new(pieces).unwrap()
}
fn circle(x: f64, y: f64, r: f64, inside: bool) -> Box<dyn Piece> {
    Box::new(Circle::new(v(x, y), r, inside).unwrap())
}
/// Numbers in [0, 1), well spread.
fn spread(seed: u32) -> impl FnMut() -> f64 {
    let mut state = u64::from(seed) * 2 + 1;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(state >> 33).unwrap()) / f64::from(1_u32 << 31)
    }
}
struct NameOf;
impl WithWalls<2> for NameOf {
    type Output = &'static str;
    fn run<W: Walls<2>>(self, _: &W) -> &'static str {
        core::any::type_name::<W>()
    }
}
fn size(t: &Table) -> f64 {
    let e = t.extent();
    let finite = e.min.iter().chain(e.max.iter()).filter(|x| x.is_finite());
    let size = finite.fold(0.0, |m: f64, x| m.max(x.abs()));
    if size > 0.0 { size } else { 1.0 }
}
/// Whether a point lies in a table: by the winding number where the table is finite.
fn contains(t: &Table, p: &Vector2<f64>) -> bool {
    if t.lattice().is_some() || !t.extent().is_finite() {
        return t.contains(p);
    }
    let ray = Ray::new(*p, v(0.8112, 0.5847), true).unwrap();
    // behind a wall without thickness the table goes on
    let walls = t.pieces().iter().filter(|piece| piece.tips().is_none());
    let sides = walls.flat_map(|piece| {
        let outwards = |m: geometry::Meeting| piece.closest(&m.point).normal.dot(&v(0.8112, 0.5847)) < 0.0;
        geometry::meetings(&ray, &**piece).into_iter().map(outwards)
    });
    sides.map(|outwards| if outwards { 1 } else { -1 }).sum::<i32>() == 1
}
fn signed_distance(t: &Table, p: &Vector2<f64>) -> f64 {
    let d = t.signed_distance(p).abs();
    if contains(t, p) { d } else { -d }
}

/// The definition: points of the new boundary are at distance R from the old one, and a point of the plane lies in the
/// new table if and only if it is farther than R from the outside of the old one.
fn check(name: &str, drawn: &Table, radius: f64) -> geometry::Offset {
    check_of_size(name, drawn, radius, size(drawn).max(radius))
}
/// The same where coordinates are as large as `size`, which rounding is a part of.
fn check_of_size(name: &str, drawn: &Table, radius: f64, size: f64) -> geometry::Offset {
    let offset = drawn.offset(radius).unwrap_or_else(|e| panic!("{name}, radius {radius}: {e}"));
    assert_eq!(offset.table.validate(), Ok(()), "{name} {radius}");
    assert_eq!(offset.origins.len(), offset.table.pieces().len());
    let mut random = spread(7);
    for (piece, origin) in offset.table.pieces().iter().zip(&offset.origins) {
        let length = piece.length();
        for _ in 0..20 {
            let s = if length.is_finite() { length * random() } else { size * (random() - 0.5) };
            let at = piece.point_at(s);
            let at = piece.closest(&at).point;
            let d = signed_distance(drawn, &at);
            // a few roundings of coordinates in the offset, as many in the distance
            assert!((d - radius).abs() < 1e-14 * size, "{name} {radius}: {at} is {d} from the wall, {piece:?}");
            // and the piece it is said to come from is one that is touched there
            let foot = drawn.pieces()[origin.piece()].closest(&at).point;
            let lattice = drawn.lattice().is_some();
            assert!(lattice || ((foot - at).norm() - radius).abs() < 1e-14 * size, "{name} {radius}: {origin:?}");
        }
    }
    let e = drawn.extent();
    let clip = |x: f64| x.clamp(-4.0 * size, 4.0 * size);
    let (low, high) = (e.min.map(clip), e.max.map(clip));
    for _ in 0..400 {
        let p = low + (high - low).component_mul(&v(random(), random()));
        let d = signed_distance(drawn, &p);
        if (d - radius).abs() > 1e-12 * size {
            assert_eq!(contains(&offset.table, &p), d > radius, "{name} {radius}: {p}, at distance {d}");
        }
    }
    offset
}

#[test]
fn every_named_table_has_offsets_by_the_definition() {
    for entry in tables::all().iter().filter(|e| e.dimension() == 2) {
        let drawn = entry.planar(&entry.typical()).unwrap();
        let largest = drawn.largest_disk().radius.min(size(&drawn));
        for part in [1e-9, 0.01, 0.25, 0.5, 0.75, 0.9, 0.99] {
            check(entry.name, &drawn, part * largest);
        }
        if drawn.largest_disk().radius.is_finite() {
            let largest = drawn.largest_disk().radius;
            match drawn.offset(largest * (1.0 + 1e-9)) {
                Err(Error::NothingLeft { largest: l, .. }) => assert_eq!(l, largest),
                other => panic!("{}: {other:?}", entry.name),
            }
        }
    }
}

#[test]
fn a_convex_polygon_loses_its_rim() {
    // A − P R + R² Σ tan(θ/2), θ the turns at the vertices
    let mut random = spread(3);
    for n in 3..12_u8 {
        let mut angles: Vec<f64> = (0..n).map(|k| (f64::from(k) + 0.8 * random()) * 2.0 * PI / f64::from(n)).collect();
        angles.sort_by(f64::total_cmp);
        let vertices: Vec<[f64; 2]> =
            angles.iter().map(|&a| [2.0 + 3.0 * libm::cos(a), 3.0 * libm::sin(a) - 1.0]).collect();
        let drawn = table(polygon(&vertices));
        let radius = 0.02; // small enough for every side to survive
        let offset = check("polygon", &drawn, radius);
        assert_eq!(offset.table.pieces().len(), usize::from(n));
        let normals: Vec<Vector2<f64>> = drawn.pieces().iter().map(|p| p.closest(&v(0.0, 0.0)).normal).collect();
        let tangents: f64 = (0..normals.len())
            .map(|i| {
                let (a, b) = (normals[i], normals[(i + 1) % normals.len()]);
                libm::tan(0.5 * libm::atan2(a.perp(&b), a.dot(&b)))
            })
            .sum();
        let area = drawn.area() - drawn.perimeter() * radius + radius * radius * tangents;
        assert!((offset.table.area() - area).abs() < 1e-13 * area);
    }
}

#[test]
fn offsets_of_composite_walls_are_composite() {
    let walls = |t: &Table, r: f64| t.offset(r).unwrap().table.with_walls(NameOf);
    let line = |x: f64, along: f64| Box::new(FullLine::new(v(x, 0.0), v(2.0, 1.0) * along).unwrap()) as Box<dyn Piece>;
    let slanting = Table::new(vec![line(1.0, 1.0), line(-1.0, -1.0)]).unwrap();
    let drawn = [
        (tables::stadium(1.0, 1.0).unwrap(), "Capsule"),
        (tables::square(1.0).unwrap(), "Cuboid"),
        (tables::hexagon(1.0).unwrap(), "Zonogon"),
        (tables::equilateral(1.0).unwrap(), "ConvexPolygon"),
        (tables::strip(1.0).unwrap(), "Slab"),
        (slanting, "Strip"),
        (tables::circle(1.0).unwrap(), "Sphere"),
        (tables::sinai(1.0, 0.25).unwrap(), "Around"),
    ];
    for (t, name) in drawn {
        for radius in [1e-6, 0.1, 0.111_111, 0.123_456_789] {
            let found = walls(&t, radius);
            assert!(found.contains(name), "{found}, not {name}");
            assert_eq!(found, t.with_walls(NameOf));
        }
    }
}

#[test]
fn a_tiny_disk_has_the_table_itself() {
    for entry in tables::all().iter().filter(|e| e.dimension() == 2) {
        let drawn = entry.planar(&entry.typical()).unwrap();
        assert_eq!(drawn.offset(0.0).unwrap().origins.len(), drawn.pieces().len());
        let radius = libm::ldexp(1.0, -30);
        let offset = drawn.offset(radius).unwrap();
        let walls = offset.origins.iter().filter(|o| matches!(o, Origin::Piece(_)));
        let expected: Vec<Origin> = (0..drawn.pieces().len()).map(Origin::Piece).collect();
        assert_eq!(walls.copied().collect::<Vec<_>>(), expected, "{}", entry.name);
        let gap = offset.table.area() - drawn.area();
        if gap.is_finite() && drawn.area().is_finite() {
            let rim = drawn.perimeter() * radius;
            assert!((gap + rim).abs() < 1e-6 * rim + 1e-14 * drawn.area().abs(), "{}: {gap} {rim}", entry.name);
        }
    }
}

#[test]
fn re_entrant_corners_become_arcs() {
    let l = table(polygon(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]]));
    let offset = check("L", &l, 0.25);
    assert_eq!(offset.origins[3], Origin::Corner { before: 2, after: 3 });
    assert_eq!(offset.origins[3].piece(), 2);
    let arc = offset.table.pieces()[3].figure();
    let Figure::Arc { center, radius, inside, .. } = arc else { panic!("{arc:?}") };
    assert_eq!((center, radius, inside), (v(1.0, 1.0), 0.25, false));
    // 3 − 8·R + (5 R² from the convex corners) − π R²/4 + … : the L minus its rim
    let area = 3.0 - 8.0 * 0.25 + 5.0 * 0.0625 - 0.0625 * PI / 4.0;
    assert!((offset.table.area() - area).abs() < 1e-15);
    // arcs wander from the corner with the radius
    check("L", &l, 0.45);
}

#[test]
fn a_neck_cuts_the_region_in_two() {
    // two rooms of side 2 joined by a corridor of width 0.5
    let rooms = [
        [0.0, 0.0],
        [2.0, 0.0],
        [2.0, 0.75],
        [3.0, 0.75],
        [3.0, 0.0],
        [5.0, 0.0],
        [5.0, 2.0],
        [3.0, 2.0],
        [3.0, 1.25],
        [2.0, 1.25],
        [2.0, 2.0],
        [0.0, 2.0],
    ];
    let t = table(polygon(&rooms));
    assert_eq!(check("rooms", &t, 0.2).table.chains().len(), 1);
    let two = check("rooms", &t, 0.3);
    assert_eq!(two.table.chains().len(), 2);
    // exactly as wide as the disk: closed
    let closed = t.offset(0.25).unwrap();
    assert_eq!(closed.table.chains().len(), 2);
    for r in [0.249_999_999, 0.25 - 1e-15, 0.25 + 1e-15, 0.250_000_001, 0.6, 0.9, 0.999_999] {
        let chains = check("rooms", &t, r).table.chains().len();
        assert!(if r < 0.2499 { chains == 1 } else { chains <= 2 });
    }
    let largest = t.offset(1.5).unwrap_err();
    assert_eq!(largest, Error::NothingLeft { radius: 1.5, largest: 1.0 });
}

#[test]
fn pieces_that_shrink_to_nothing_vanish() {
    // a square with rounded corners: the disk may be larger than they are, or exactly as large
    let r = 0.25;
    let rounded = |at: [f64; 2], to: [f64; 2], c: [f64; 2], o: Outline| {
        o.line_to(at.into()).unwrap().arc_to(to.into(), c.into(), Turn::CounterClockwise).unwrap()
    };
    let o = Outline::from(v(r, 0.0));
    let o = rounded([2.0 - r, 0.0], [2.0, r], [2.0 - r, r], o);
    let o = rounded([2.0, 2.0 - r], [2.0 - r, 2.0], [2.0 - r, 2.0 - r], o);
    let o = rounded([r, 2.0], [0.0, 2.0 - r], [r, 2.0 - r], o);
    let o = rounded([0.0, r], [r, 0.0], [r, r], o);
    let t = table(o.close().unwrap());
    assert_eq!(check("rounded", &t, 0.125).table.pieces().len(), 8);
    for radius in [0.25, 0.25 - 1e-16, 0.25 + 1e-16, 0.5, 0.999] {
        let offset = check("rounded", &t, radius);
        assert_eq!(offset.table.pieces().len(), 4, "{radius}");
        let side = 2.0 - 2.0 * radius;
        assert!((offset.table.area() - side * side).abs() < 1e-14);
    }
}

#[test]
fn scatterers_grow_until_they_close_the_way() {
    let drawn = |r: f64| {
        let mut pieces = polygon(&[[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]);
        pieces.push(circle(1.0, 1.0, r, false));
        table(pieces)
    };
    assert_eq!(check("sinai", &drawn(0.5), 0.2).table.chains().len(), 2);
    // the ring breaks into four corners
    let corners = check("sinai", &drawn(0.5), 0.3);
    assert_eq!((corners.table.chains().len(), corners.table.pieces().len()), (4, 12));
    assert_eq!(check("sinai", &drawn(0.5), 0.25).table.chains().len(), 4);
    // a disk against the wall, and two that touch
    let mut pieces = polygon(&[[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [0.0, 2.0]]);
    pieces.push(circle(1.0, 0.5, 0.5, false));
    pieces.push(circle(2.0, 0.5, 0.5, false));
    check("touching", &table(pieces), 0.1);
}

#[test]
fn what_is_left_of_a_closed_curve_may_run_over_its_seam() {
    // an ellipse and, where it does not begin, a disk so near that their parallels cross
    let center = v(0.846_323_981_444_753_8, 0.378_443_565_090_533_7);
    let ellipse =
        Ellipse::new(center, [0.183_081_544_828_529, 0.058_338_317_095_888_624], 1.275_660_283_848_197_6, false);
    let disk =
        Circle::new(v(0.621_909_010_857_099, 0.309_190_761_147_818_96), 0.075_438_929_950_015_78, false).unwrap();
    let lattice =
        [v(0.789_890_449_680_334_7, -0.112_797_528_632_536_56), v(-0.177_177_589_411_797_95, 0.687_637_568_538_786_3)];
    let lattice = Lattice::new(&lattice).unwrap();
    let table = Table::periodic(vec![Box::new(ellipse.unwrap()), Box::new(disk)], Some(lattice)).unwrap();
    let [(area, _), (_, middle), (less, _)] = [0.1215, 0.122, 0.1225].map(|radius| {
        let offset = table.offset(radius).unwrap();
        // the disk, and the ellipse in two parts
        assert_eq!((offset.table.pieces().len(), offset.table.corners().len()), (3, 2));
        (offset.table.area(), offset.table.perimeter())
    });
    assert!((area - less - 0.001 * middle).abs() < 1e-7, "{area} {less} {middle}");
}

#[test]
fn infinite_tables_have_offsets() {
    let ray = |x: f64, y: f64, left: bool| Box::new(Ray::new(v(0.0, 0.0), v(x, y), left).unwrap()) as Box<dyn Piece>;
    let wedge = check("wedge", &table(vec![ray(1.0, 2.0, true), ray(-1.0, 2.0, false)]), 0.5);
    let ends: Vec<_> = wedge.table.pieces().iter().map(|p| p.figure()).collect();
    let apex = v(0.0, 0.5 * 5.0_f64.sqrt());
    assert!(ends.iter().all(|f| matches!(f, Figure::Ray { from, .. } if (from - apex).norm() < 1e-15)), "{ends:?}");
    // outside of a wedge
    let outside = check("outside", &table(vec![ray(1.0, 2.0, false), ray(-1.0, 2.0, true)]), 0.5);
    assert_eq!(outside.table.pieces().len(), 3);
    // a half-plane with a disk in it, near the wall
    let line = Box::new(FullLine::new(v(0.0, 0.0), v(1.0, 0.0)).unwrap()) as Box<dyn Piece>;
    let t = table(vec![line, circle(0.0, 2.0, 1.0, false)]);
    assert_eq!(check("half-plane", &t, 0.25).table.chains().len(), 2);
    let cut = check("half-plane", &t, 0.75);
    assert_eq!((cut.table.chains().len(), cut.table.pieces().len()), (1, 3));
}

#[test]
fn curves_have_parallels() {
    let ellipse =
        |inside: bool| Box::new(Ellipse::new(v(0.1, 0.2), [2.0, 1.0], 0.3, inside).unwrap()) as Box<dyn Piece>;
    let t = table(vec![ellipse(true)]);
    let inner = check("ellipse", &t, 0.25);
    assert_eq!(inner.table.pieces().len(), 1);
    let area = t.area() - 0.25 * t.perimeter() + PI * 0.0625; // Steiner
    assert!((inner.table.area() - area).abs() < 1e-13);
    // beyond the least radius of curvature 1/2 the parallel has corners on the major axis
    let lens = check("ellipse", &t, 0.75);
    assert_eq!((lens.table.pieces().len(), lens.table.corners().len()), (2, 2));
    assert!(matches!(t.offset(1.01), Err(Error::NothingLeft { .. })));
    // an ellipse in a square, free and against the walls
    let mut pieces = polygon(&[[-3.0, -3.0], [3.0, -3.0], [3.0, 3.0], [-3.0, 3.0]]);
    pieces.push(ellipse(false));
    let t = table(pieces);
    assert_eq!(check("ring", &t, 0.4).table.chains().len(), 2);
    check("broken ring", &t, 0.55);
}

#[test]
fn rays_meet_parallels_near_their_ends() {
    // where the offset of an ellipse has lost its tips, a parallel curve bends most near its ends
    let centres = tables::ellipse([2.0, 1.0]).unwrap().offset(0.9).unwrap().table;
    let direction = v(0.8, 0.6);
    for piece in centres.pieces() {
        for part in [1e-8, 1e-5, 1e-4, 5e-4, 1e-3, 2e-3, 5e-3, 1e-2] {
            for s in [part * piece.length(), (1.0 - part) * piece.length()] {
                let aim = piece.point_at(s);
                let ray = Ray::new(aim - direction * 0.625, direction, true).unwrap();
                let near = |m: &geometry::Meeting| (m.point - aim).norm() < 1e-13; // a few roundings of coordinates of size 1
                assert!(geometry::meetings(&ray, &**piece).iter().any(near), "{piece:?} at {s}");
            }
        }
    }
}

#[test]
fn offsets_scale_bit_by_bit() {
    let drawn = |k: f64| {
        let o = Outline::from(v(-1.0, -1.0) * k).line_to(v(0.3, -1.1) * k).unwrap();
        let o = o.line_to(v(0.2, -0.3) * k).unwrap().line_to(v(1.0, -1.0) * k).unwrap();
        let o = o.arc_to(v(1.0, 1.0) * k, v(1.0, 0.0) * k, Turn::CounterClockwise).unwrap();
        let o = o.arc_to(v(-1.0, 1.0) * k, v(0.0, 2.0) * k, Turn::Clockwise).unwrap();
        let mut pieces = o.line_to(v(-1.0, -1.0) * k).unwrap().close().unwrap();
        pieces.push(Box::new(Circle::new(v(0.9, 0.2) * k, 0.3 * k, false).unwrap()));
        table(pieces)
    };
    let one = check("scaled", &drawn(1.0), 0.11);
    for power in [-200, -3, 5, 200] {
        let k = libm::ldexp(1.0, power);
        let other = drawn(k).offset(0.11 * k).unwrap();
        assert_eq!(one.origins, other.origins);
        for (p, q) in one.table.pieces().iter().zip(other.table.pieces()) {
            assert_eq!(p.ends().map(|e| e.map(|x| x * k)), q.ends());
            if let (Figure::Arc { radius: r, .. }, Figure::Arc { radius: s, .. }) = (p.figure(), q.figure()) {
                assert_eq!(r * k, s);
            }
        }
    }
}

#[test]
fn any_polygon_has_offsets_by_the_definition() {
    // star-shaped polygons with random radii, full of re-entrant corners and narrow places
    for seed in 0..40 {
        let mut random = spread(seed);
        let n = 5 + seed % 17;
        let vertex = |k: u32, r: f64| {
            let a = 2.0 * PI * f64::from(k) / f64::from(n);
            [r * libm::cos(a), r * libm::sin(a)]
        };
        let vertices: Vec<[f64; 2]> = (0..n).map(|k| vertex(k, 0.4 + random())).collect();
        let t = table(polygon(&vertices));
        let largest = t.largest_disk().radius;
        for part in [0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 0.999_99] {
            check("star", &t, part * largest);
        }
    }
}

#[test]
fn radii_at_which_everything_meets_are_no_obstacle() {
    // a grid of square pillars: gaps, corners and diagonals all coincide
    let mut pieces = polygon(&[[0.0, 0.0], [5.0, 0.0], [5.0, 5.0], [0.0, 5.0]]);
    for i in 0..2 {
        for j in 0..2 {
            let (x, y) = (1.0 + 2.0 * f64::from(i), 1.0 + 2.0 * f64::from(j));
            pieces.extend(polygon(&[[x, y], [x, y + 1.0], [x + 1.0, y + 1.0], [x + 1.0, y]]));
        }
    }
    let t = table(pieces);
    for radius in [0.25, 0.5 - 1e-15, 0.5, 0.5 + 1e-15, 0.6, 0.5_f64.sqrt() - 1e-9] {
        check("pillars", &t, radius);
    }
}

#[test]
fn cusps_and_tangent_arcs_have_offsets() {
    // three disks that touch: the table between them has three cusps
    let c = [v(0.0, 0.0), v(2.0, 0.0), v(1.0, 3.0_f64.sqrt())];
    let touch = |i: usize, j: usize| (c[i] + c[j]) * 0.5;
    let arc = |i: usize, from: Vector2<f64>, to: Vector2<f64>| {
        Box::new(Arc::with_radius(c[i], 1.0, from, to, false).unwrap()) as Box<dyn Piece>
    };
    let t = table(vec![
        arc(0, touch(0, 2), touch(0, 1)),
        arc(1, touch(0, 1), touch(1, 2)),
        arc(2, touch(1, 2), touch(0, 2)),
    ]);
    let largest = 2.0 / 3.0_f64.sqrt() - 1.0;
    assert!((t.largest_disk().radius - largest).abs() < 1e-15);
    for part in [1e-6, 0.1, 0.9, 0.999] {
        assert_eq!(check("cusps", &t, part * largest).table.pieces().len(), 3);
    }
}

#[test]
fn radii_must_be_radii() {
    let t = tables::square(1.0).unwrap();
    for radius in [-0.1, f64::NAN, f64::INFINITY] {
        assert!(matches!(t.offset(radius), Err(Error::Radius { .. })));
    }
}

#[test]
fn no_disk_moves_inside_obstacles_that_touch() {
    let torus = |vectors: [Vector2<f64>; 2]| {
        let lattice = Lattice::new(&vectors).unwrap();
        Table::periodic(vec![circle(0.0, 0.0, 0.5, false)], Some(lattice)).unwrap()
    };
    let square = torus([v(1.0, 0.0), v(0.0, 1.0)]);
    let hexagons = torus([v(1.0, 0.0), v(0.5, 0.75_f64.sqrt())]);
    let mut pieces = polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    pieces.push(circle(0.5, 0.5, 0.5, false));
    let corners = table(pieces);
    let root = 2.0_f64.sqrt();
    let cases: [(&Table, f64, &[f64], f64); 3] = [
        (&square, 0.5 * root - 0.5, &[0.21, 0.3, 0.45], 0.2),
        (&hexagons, 1.0 / 3.0_f64.sqrt() - 0.5, &[0.08, 0.1, 0.3], 0.07),
        (&corners, 0.5 * (root - 1.0) / (root + 1.0), &[0.09, 0.1, 0.3], 0.08),
    ];
    for (table, limit, too_large, small) in cases {
        for &radius in too_large {
            let Err(Error::NothingLeft { largest, .. }) = table.offset(radius) else { panic!("{radius} has room") };
            assert!((largest - limit).abs() < 1e-15, "{radius}: {largest}");
        }
        assert!(check("obstacles that touch", table, small).table.largest_disk().radius > 0.0);
    }
}

#[test]
fn a_disk_far_larger_than_the_table_is_told_at_once_that_nothing_is_left() {
    // each of fifty parallels, a million times as long as the table, crosses all others
    let polygon = tables::perturbed_polygon(50, 1.0, 0.05).unwrap();
    let largest = polygon.largest_disk().radius;
    for radius in [1e6, 1e10, 1e100] {
        assert_eq!(polygon.offset(radius).unwrap_err(), Error::NothingLeft { radius, largest });
    }
    // around the outside of a wall, or above one, is room for any disk
    let around = Table::new(vec![Box::new(Circle::new(v(0.0, 0.0), 1.0, false).unwrap())]).unwrap().unbounded();
    assert!(around.offset(1e6).is_ok());
    let above = Table::new(vec![Box::new(FullLine::new(v(0.0, 0.0), v(1.0, 0.0)).unwrap())]).unwrap();
    assert!(above.offset(1e6).is_ok());
}
