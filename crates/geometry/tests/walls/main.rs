//! Composite walls against the plain list of pieces, lanes against single numbers, and long orbits against leaks.
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

mod along;
mod feet;
mod few;
#[path = "../formulas/mod.rs"]
mod formulas;
mod leaks;
mod obstacles;
mod periodic;
mod reused;
mod rooms;
mod side_by_side;
mod solids;
mod spirals;
mod touching;
mod whole_sides;

use geometry::shapes::curve::{Implicit, ImplicitFormula};
use geometry::shapes::{Arc, Bump, Circle, Ellipse, EllipticArc, FullLine, Ray, Screen, Segment, Translated};
use geometry::{
    Error, Interior, Lattice, Line, Outline, Piece, SVector, Table, Turn, Vector2, WallHit, Walls, WithWalls, tables,
    tables::{Build, Entry},
    walls::{Few, List},
};
use lanes::{Kernel, Lane, Mask};

#[test]
fn circles_that_are_tiny_beside_the_flights_reflect_as_well_as_others() {
    struct Head(Line<2>);
    impl WithWalls<2> for Head {
        type Output = geometry::Hit<2>;
        fn run<W: Walls<2>>(self, walls: &W) -> geometry::Hit<2> {
            walls.hit(&self.0).unwrap()
        }
    }
    let v = Vector2::new;
    let sides = |corners: [Vector2<f64>; 4]| {
        (0..4).map(move |i| Box::new(Segment::new(corners[i], corners[(i + 1) % 4]).unwrap()) as Box<dyn Piece>)
    };
    // head on, where the place is off by more than the radius
    for radius in [1e-9, 1e-12, 1e-15] {
        let disk = || Box::new(Circle::new(v(0.1, 0.2), radius, false).unwrap()) as Box<dyn Piece>;
        let others = [v(0.5, 0.5), v(0.6, 0.5), v(0.6, 0.6), v(0.5, 0.6)];
        let square = [v(-1.0, -1.0), v(1.0, -1.0), v(1.0, 1.0), v(-1.0, 1.0)];
        let alone = Table::new(sides(square).chain([disk()]).collect()).unwrap();
        let mut hole = others;
        hole.reverse();
        let among = Table::new(sides(square).chain(sides(hole)).chain([disk()]).collect()).unwrap();
        for table in [alone, among] {
            for from in [v(0.1, 0.9), v(0.9, 0.2)] {
                let towards = v(0.1, 0.2) - from;
                let hit = table.with_walls(Head(Line { point: from, velocity: towards }));
                assert!((hit.normal + towards.normalize()).norm() <= 4.0 * f64::EPSILON, "{radius}: {hit:?}");
                assert!((hit.time - 1.0).abs() <= 2.0 * radius + 8.0 * f64::EPSILON, "{radius}: {hit:?}");
            }
            let paths = paths(&table, 64, &mut Random(5));
            table.with_walls(side_by_side::SameBits { name: "a tiny disk", paths: &paths });
        }
    }
}

#[test]
fn the_smallest_pieces_that_a_table_may_have_are_hit_in_the_order_of_times() {
    struct First(Line<2>);
    impl WithWalls<2> for First {
        type Output = (usize, f64);
        fn run<W: Walls<2>>(self, walls: &W) -> (usize, f64) {
            let hit = walls.hit(&self.0).unwrap();
            (hit.piece, hit.time)
        }
    }
    let v = Vector2::new;
    let room = || Box::new(Circle::new(v(0.0, 0.0), 1.0, true).unwrap()) as Box<dyn Piece>;
    for width in [1e-3, 1.1e-60, 0.9e-60] {
        let disk = |x: f64| Box::new(Circle::new(v(x * width, 0.0), 0.5 * width, false).unwrap()) as Box<dyn Piece>;
        let oval = |x: f64| {
            let semi_axes = [3e-10, 0.5].map(|a| a * width);
            Box::new(Ellipse::new(v(x * width, 0.0), semi_axes, 0.0, false).unwrap()) as Box<dyn Piece>
        };
        let tables =
            [[disk(1.0), disk(-1.0)], [oval(1.0), oval(-1.0)], [disk(1.0), oval(-1.0)], [oval(1.0), disk(-1.0)]];
        for (k, [right, left]) in tables.into_iter().enumerate() {
            let table = Table::new(vec![room(), right, left]).unwrap();
            if width < 1e-60 {
                let checked = table.validate();
                assert!(matches!(checked, Err(Error::Small { piece: 1, .. })), "{checked:?}");
                continue;
            }
            assert_eq!(table.validate(), Ok(()));
            // where the left one begins
            let begins = [-1.5, -1.0, -1.0, -1.5][k];
            let path = |from: f64, toward: f64| First(Line { point: v(from, 0.0), velocity: v(toward, 0.0) });
            let (piece, time) = table.with_walls(path(-3.0 * width, 1.0));
            let expected = (begins + 3.0) * width;
            assert_eq!(piece, 2, "{k}: {width:e}");
            assert!((time - expected).abs() <= 1e-9 * expected, "{k}: {width:e}: {time:e}, not {expected:e}");
            assert_eq!(table.with_walls(path(3.0 * width, -1.0)).0, 1, "{k}: {width:e}");
            // from afar either comes first, within rounding, but not the wall beyond
            let (piece, time) = table.with_walls(path(-0.5, 1.0));
            assert_ne!(piece, 0, "{k}: {width:e}");
            assert!((time - 0.5).abs() <= 2.0 * width, "{k}: {width:e}: {time}");
        }
    }
}

/// Random numbers, uniform in [0, 1): a linear congruential generator with its upper bits.
struct Random(u64);

impl Random {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / 9_007_199_254_740_992.0 // 2⁵³
    }
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.uniform()
    }
    /// Any direction, one in eight of them along an axis; any speed of a wide range.
    fn velocity<const N: usize>(&mut self) -> SVector<f64, N> {
        if self.uniform() < 0.125 {
            let (axis, sign) = (self.uniform(), self.uniform());
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below N")]
            let axis = (axis * N as f64) as usize;
            let other = if self.uniform() < 0.5 { 0.0 } else { -0.0 };
            return SVector::from_fn(|i, _| {
                if i != axis {
                    other
                } else if sign < 0.5 {
                    -1.0
                } else {
                    1.0
                }
            });
        }
        loop {
            let v = SVector::<f64, N>::from_fn(|_, _| self.between(-1.0, 1.0));
            if v.norm_squared() > 0.01 {
                return v * libm::exp2(self.between(-8.0, 8.0));
            }
        }
    }
}

/// Planar tables without a lattice: every named one, and variations of those that have composite walls.
fn planar() -> Vec<(String, Table)> {
    let mut all: Vec<(String, Table)> = tables::all()
        .iter()
        .filter(|e| e.dimension() == 2)
        .map(|e| (e.name.to_string(), e.planar(&e.typical()).unwrap()))
        .filter(|(_, table)| table.lattice().is_none())
        .collect();
    let mut random = Random(1);
    let r = &mut random;
    let v = Vector2::new;
    for k in 0..12 {
        let size = libm::exp2(r.between(-30.0, 30.0));
        let mut add = |name: &str, table: Table| all.push((format!("{name} {k}"), table));
        add("stadium", tables::stadium(size * r.uniform(), size).unwrap());
        add("hexagon", tables::hexagon(size).unwrap());
        add("rectangle", tables::rectangle([size, size * r.uniform()]).unwrap());
        add("polygon", tables::polygon(5 + k, size).unwrap());
        add("sinai", tables::sinai(size, size * r.between(0.01, 0.49)).unwrap());
        add("wedge", tables::wedge(r.between(0.05, 3.1)).unwrap());
        add("flower", tables::flower(3 + k, size * r.between(0.5, 1.5), size).unwrap());
        add("moon", tables::moon(size, size * r.between(0.6, 0.9), size).unwrap());
        let apex = v(size * r.between(-2.0, 3.0), size * r.between(0.1, 2.0));
        add("triangle", tables::triangle([v(0.0, 0.0), v(size, 0.0), apex]).unwrap());
        // away from the origin, and turned
        let (by, angle) = (v(size * r.between(-3.0, 3.0), size * r.between(-3.0, 3.0)), r.between(0.0, 6.3));
        let turned = |x: f64, y: f64| {
            let (c, s) = (libm::cos(angle), libm::sin(angle));
            by + v(c * x - s * y, s * x + c * y) * size
        };
        let stadium = Outline::from(turned(-0.5, -1.0))
            .line_to(turned(0.5, -1.0))
            .and_then(|o| o.arc_to(turned(0.5, 1.0), turned(0.5, 0.0), Turn::CounterClockwise))
            .and_then(|o| o.line_to(turned(-0.5, 1.0)))
            .and_then(|o| o.arc_to(turned(-0.5, -1.0), turned(-0.5, 0.0), Turn::CounterClockwise));
        add("turned stadium", Table::new(stadium.unwrap().close().unwrap()).unwrap());
        let corners = [turned(1.0, 0.0), turned(0.4, 0.9), turned(-1.0, 0.0), turned(-0.4, -0.9)];
        let side = |i: usize| Box::new(Segment::new(corners[i], corners[(i + 1) % 4]).unwrap()) as _;
        add("turned parallelogram", Table::new((0..4).map(side).collect()).unwrap());
        let along = v(libm::cos(angle), libm::sin(angle));
        let line = |from: f64, to: f64| {
            let through = v(0.0, 1.5) + along * from + v(along.y, -along.x) * to;
            Box::new(FullLine::new(through, along * to).unwrap()) as Box<dyn Piece>
        };
        add("turned strip", Table::new(vec![line(0.3, 0.7), line(-0.4, -0.5)]).unwrap());
        // rooms with rectangular pillars, before and after the walls around, and beside other rooms
        let pillar = polygon([[1.0, 1.0], [1.0, 2.0], [2.0, 2.0], [2.0, 1.0]].map(|[x, y]| v(x, y) * size));
        let bent = [[0.0, 0.0], [6.0, 0.0], [6.0, 3.0], [3.0, 3.0], [3.0, 6.0], [0.0, 6.0]];
        let square = [[0.0, 0.0], [6.0, 0.0], [6.0, 6.0], [0.0, 6.0]];
        let (bent, square) = (polygon(bent.map(|[x, y]| v(x, y) * size)), polygon(square.map(|[x, y]| v(x, y) * size)));
        let round = |x: f64, r: f64| Box::new(Circle::new(v(x, 1.5) * size, r * size, true).unwrap()) as Box<dyn Piece>;
        let both = |a: &[Segment], b: &[Segment]| a.iter().chain(b).map(|s| Box::new(*s) as Box<dyn Piece>).collect();
        add("bent room with a pillar", Table::new(both(&bent, &pillar)).unwrap());
        add("pillar in a square", Table::new(both(&pillar, &square)).unwrap());
        add(
            "pillar in a disk",
            Table::new(pillar.iter().map(|s| Box::new(*s) as _).chain([round(1.5, 3.0)]).collect()).unwrap(),
        );
        add(
            "square beside a disk",
            Table::new(square.iter().map(|s| Box::new(*s) as _).chain([round(8.0, 1.0)]).collect()).unwrap(),
        );
        if k < 4 {
            for (name, table) in whole_sides::seamed(by, size).into_iter().chain(obstacles::containers(by, size)) {
                add(name, table);
            }
            for (name, table) in formulas::tables(by, size) {
                add(name, table);
            }
        }
    }
    all.extend(obstacles::endless().map(|(name, table)| (name.to_string(), table)));
    all
}

/// The sides of the polygon with these vertices.
fn polygon<const K: usize>(vertices: [Vector2<f64>; K]) -> Vec<Segment> {
    (0..K).map(|i| Segment::new(vertices[i], vertices[(i + 1) % K]).unwrap()).collect()
}

/// The size of a table's coordinates, infinite directions left out.
fn size(table: &Table) -> f64 {
    let extent = table.extent();
    let finite = extent.min.iter().chain(extent.max.iter()).filter(|x| x.is_finite());
    finite.fold(0.0, |m: f64, x| m.max(x.abs()))
}

/// Paths from inside the table and from its boundary, none of them parallel to where it starts.
fn paths(table: &Table, count: usize, random: &mut Random) -> Vec<Line<2>> {
    let list = table.list(0..table.pieces().len());
    let interior = Interior::of(table).ok();
    let inside = |random: &mut Random| match &interior {
        Some(interior) => interior.point(&mut || random.uniform()).unwrap(),
        // strip and wedge: somewhere near the origin
        None => loop {
            let p = Vector2::new(random.between(-3.0, 3.0), random.between(0.0, 3.0));
            if table.contains(&p) {
                return p;
            }
        },
    };
    let mut paths = vec![];
    while paths.len() < count {
        let start = Line { point: inside(random), velocity: random.velocity() };
        paths.push(start);
        // and on from where it ends, in some direction into the table
        if let Some(hit) = list.hit(&start).filter(|hit| !hit.corner) {
            let v = random.velocity::<2>();
            let normal = v.dot(&hit.normal);
            if normal.abs() > 1e-3 * v.norm() {
                let velocity = if normal > 0.0 { v } else { -v };
                paths.push(Line { point: hit.point, velocity });
            }
        }
    }
    paths
}

/// Composite walls and list, path by path.
struct Compare<'a> {
    name: &'a str,
    table: &'a Table,
    paths: &'a [Line<2>],
}

impl WithWalls<2> for Compare<'_> {
    type Output = ();
    fn run<W: Walls<2>>(self, walls: &W) {
        let list = self.table.list(0..self.table.pieces().len());
        let vertices: Vec<Vector2<f64>> = self.table.pieces().iter().filter_map(Piece::ends).flatten().collect();
        for path in self.paths {
            let context = || format!("{}: {path:?}", self.name);
            let (Some(a), Some(b)) = (list.hit(path), walls.hit(path)) else {
                assert_eq!(list.hit(path), walls.hit(path), "{}", context());
                continue;
            };
            let speed = path.velocity.norm();
            let reach = size(self.table).max(path.point.amax()) + speed * a.time;
            // within 64 ulp of a vertex rounding decides which neighbour is hit
            let near = |v: &Vector2<f64>| (v - a.point).norm().min((v - b.point).norm()) < 64.0 * f64::EPSILON * reach;
            if vertices.iter().any(near) {
                continue;
            }
            // Both evaluate a distance to a wall with a handful of roundings of numbers of size `reach`; to the time
            // that passes on with 1/cos of the angle of incidence, 16 being the number of roundings. A hit of a circle
            // that grazes it is the root of a number as small as cos², right to the same 16 ulp over cos.
            let cos = path.velocity.dot(&a.normal).abs() / speed;
            let bound = 16.0 * f64::EPSILON * reach / cos;
            assert_eq!(a.piece, b.piece, "{}", context());
            assert!((a.time - b.time).abs() * speed <= bound, "{}: {a:?} {b:?}, cos {cos}", context());
            assert!((a.point - b.point).norm() <= bound, "{}: {a:?} {b:?}", context());
            // the normal turns with the point, by its distance over the radius of curvature
            let curvature = self.table.pieces()[a.piece].curvature(&a.point).abs();
            assert!(
                (a.normal - b.normal).norm() <= 8.0 * f64::EPSILON + 2.0 * bound * curvature,
                "{}: {a:?} {b:?}",
                context()
            );
            assert_eq!(a.corner, b.corner, "{}: {a:?} {b:?}", context());
        }
    }
}

#[test]
fn composite_walls_agree_with_the_list_of_pieces() {
    let mut random = Random(2);
    for (name, table) in &planar() {
        let paths = paths(table, 4000, &mut random);
        table.with_walls(Compare { name, table, paths: &paths });
    }
}

/// One path.
struct Ask(Line<2>);

impl WithWalls<2> for Ask {
    type Output = Option<geometry::Hit<2>>;
    fn run<W: Walls<2>>(self, walls: &W) -> Self::Output {
        walls.hit(&self.0)
    }
}

/// What the walls of a table are.
struct NameOf;

impl WithWalls<2> for NameOf {
    type Output = &'static str;
    fn run<W: Walls<2>>(self, _: &W) -> &'static str {
        core::any::type_name::<W>()
    }
}

#[test]
fn a_vertex_flatter_than_any_corner_is_none() {
    let v = Vector2::new;
    let corner = |depth: f64| {
        let sides = polygon([v(0.0, 0.0), v(0.5, -depth), v(1.0, 0.0), v(1.0, 1.0), v(0.0, 1.0)]);
        let table = Table::new(sides.into_iter().map(|s| Box::new(s) as _).collect()).unwrap();
        table.with_walls(Ask(Line { point: v(0.5, 0.5), velocity: v(0.0, -1.0) })).unwrap().corner
    };
    assert!(corner(1e-3) && !corner(1e-11) && !corner(1e-17) && !corner(0.0));
}

#[test]
fn what_starts_on_a_wall_between_two_rooms_does_not_hit_its_other_side() {
    let v = Vector2::new;
    let square = |x: f64, y: f64| polygon([v(x, y), v(x + 1.0, y), v(x + 1.0, y + 1.0), v(x, y + 1.0)]);
    let table = |sides: Vec<Segment>| Table::new(sides.into_iter().map(|s| Box::new(s) as _).collect()).unwrap();
    // rooms that share a wall, or half of one; a slit; a wall of its own, askew; each with a few more pillars than fit one list
    let pillars = |k: u32| {
        let at = |i: u32| v(0.1 + 0.05 * f64::from(i), 0.05);
        (0..k).flat_map(|i| polygon([at(i), at(i) + v(0.0, 0.01), at(i) + v(0.01, 0.01)])).collect::<Vec<_>>()
    };
    let slit = polygon([v(0.0, 0.0), v(1.0, 0.0), v(1.0, 1.0), v(0.5, 1.0), v(0.5, 0.4), v(0.5, 1.0), v(0.0, 1.0)]);
    let own = [square(0.0, 0.0), polygon([v(0.3, 0.3), v(0.7, 0.41)])].concat();
    // a small room on a long slanted wall
    let at = |s: f64, off: f64| v(0.55, -0.75) + v(0.6, 0.8) * s + v(-0.8, 0.6) * off;
    let large = polygon([at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)]);
    let small = polygon([at(0.37, 0.0), at(0.37, -0.5), at(0.47, -0.5), at(0.47, 0.0)]);
    let slanted = [large, small].concat();
    let rooms = [
        slanted,
        [square(0.0, 0.0), square(1.0, 0.0)].concat(),
        [square(0.0, 0.0), square(1.0, 0.5)].concat(),
        slit,
        own,
    ];
    let mut random = Random(14);
    for (room, many) in rooms.iter().flat_map(|room| [(room, 0), (room, 10)]) {
        let table = table([room.clone(), pillars(many)].concat());
        table.validate().unwrap();
        let paths = paths(&table, 2000, &mut random);
        let next = |path: &Line<2>| {
            let hit = table.with_walls(Ask(*path)).unwrap();
            let v = path.velocity;
            let on = Line { point: hit.point, velocity: v - hit.normal * (2.0 * v.dot(&hit.normal)) };
            (hit, on)
        };
        let mut of_walls = vec![];
        for path in &paths {
            let (first, on) = next(path);
            let (second, _) = next(&on);
            if !first.corner && first.normal.dot(&path.velocity).abs() > 1e-6 * path.velocity.norm() {
                // from one wall to another, and no time there and back
                assert!(first.piece != second.piece && second.time > 0.0, "{path:?} {first:?} {second:?}");
                of_walls.push(first.piece);
            }
        }
        assert!((0..room.len()).all(|piece| of_walls.contains(&piece)), "some wall is never hit");
        table.with_walls(side_by_side::SameBits { name: "two sides", paths: &paths });
    }
}

/// Pieces, the room of a point, and the pieces of each room.
type Rooms<'a> = (&'a str, Vec<Box<dyn Piece>>, &'a dyn Fn(&Vector2<f64>) -> usize, [&'a [usize]; 2]);

#[test]
fn nothing_passes_a_curved_or_infinite_wall_with_the_table_on_both_sides() {
    let v = Vector2::new;
    let circle = |r: f64, inside: bool| Box::new(Circle::new(v(0.1, -0.2), r, inside).unwrap()) as Box<dyn Piece>;
    let oval = |angle: f64, axes: [f64; 2], inside: bool| Ellipse::new(v(0.1, -0.2), axes, angle, inside).unwrap();
    let line = |y: f64, x: f64| Box::new(FullLine::new(v(0.7, y), v(x, 0.3 * x)).unwrap()) as Box<dyn Piece>;
    let ray = |x: f64, left: bool| Box::new(Ray::new(v(0.0, 0.0), v(x, 0.4), left).unwrap()) as Box<dyn Piece>;
    let quartic = formulas::Quartic { semi_axes: [2.0, 1.0], twist: 0.3 };
    let formula = |inside: bool| Box::new(Implicit::new(quartic, inside).unwrap()) as Box<dyn Piece>;
    // the upper half of a disk from outside and inside, with a diameter of its own, in a room
    let (a, b, middle) = (v(1.0, 0.0), v(-1.0, 0.0), v(0.0, 0.0));
    let arc = |from, to, inside| Box::new(Arc::new(middle, from, to, inside).unwrap()) as Box<dyn Piece>;
    let side = |from, to| Box::new(Segment::new(from, to).unwrap()) as Box<dyn Piece>;
    let half = [arc(a, b, true), side(b, a), arc(b, a, false), side(a, b), circle(5.0, true)];
    // the same with the arc cut elsewhere on its other side
    let cut = v(0.6, 0.8);
    let parts = [arc(a, b, true), side(b, a), arc(b, cut, false), arc(cut, a, false), side(a, b), circle(5.0, true)];
    // half an ellipse, told by its axes either way
    let [p, q] = [[2.0, 1.0], [1.0, 2.0]];
    let half_oval = |turn: bool, from, to, inside| {
        let whole = if turn { oval(core::f64::consts::FRAC_PI_2, q, inside) } else { oval(0.0, p, inside) };
        Box::new(EllipticArc::new(whole, from, to).unwrap()) as Box<dyn Piece>
    };
    let (c, d) = (v(2.1, -0.2), v(-1.9, -0.2));
    let half_ovals =
        [half_oval(false, c, d, true), side(d, c), half_oval(true, d, c, false), side(c, d), circle(5.0, true)];
    let ellipses = [true, false].map(|inside| Box::new(oval(0.3, p, inside)) as Box<dyn Piece>);

    let in_circle = |p: &Vector2<f64>| usize::from((p - v(0.1, -0.2)).norm() > 1.0);
    let in_half = |p: &Vector2<f64>| usize::from(!(p.norm() < 1.0 && p.y > 0.0));
    let in_oval = |p: &Vector2<f64>| {
        usize::from(!(libm::pow(p.x - 0.1, 2.0) / 4.0 + libm::pow(p.y + 0.2, 2.0) < 1.0 && p.y > -0.2))
    };
    let in_ellipse = |p: &Vector2<f64>| {
        let (along, y) = (v(libm::cos(0.3), libm::sin(0.3)), p - v(0.1, -0.2));
        usize::from(libm::pow(y.dot(&along) / 2.0, 2.0) + libm::pow(along.perp(&y), 2.0) > 1.0)
    };
    let above = |p: &Vector2<f64>| usize::from(p.y < 0.5 + 0.3 * (p.x - 0.7));
    let between = |p: &Vector2<f64>| usize::from(0.6 * p.y < 0.4 * p.x.abs());
    let in_quartic = |p: &Vector2<f64>| usize::from(quartic.value((*p).into()) > 0.0);
    let cases: [Rooms<'_>; 9] = [
        ("circle", vec![circle(1.0, true), circle(1.0, false), circle(5.0, true)], &in_circle, [&[0], &[1, 2]]),
        ("circle in the plane", vec![circle(1.0, true), circle(1.0, false)], &in_circle, [&[0], &[1]]),
        ("half a disk", half.into(), &in_half, [&[0, 1], &[2, 3, 4]]),
        ("its arc in two", parts.into(), &in_half, [&[0, 1], &[2, 3, 4, 5]]),
        ("half an ellipse", half_ovals.into(), &in_oval, [&[0, 1], &[2, 3, 4]]),
        ("ellipse", ellipses.into_iter().chain([circle(5.0, true)]).collect(), &in_ellipse, [&[0], &[1, 2]]),
        ("lines", vec![line(0.5, 1.0), line(0.5, -2.0), line(2.0, -1.0), line(-2.0, 3.0)], &above, [&[0, 2], &[1, 3]]),
        (
            "rays",
            vec![ray(0.6, true), ray(-0.6, false), ray(-0.6, true), ray(0.6, false)],
            &between,
            [&[0, 1], &[2, 3]],
        ),
        ("formula", vec![formula(true), formula(false), circle(5.0, true)], &in_quartic, [&[0], &[1, 2]]),
    ];
    let mut random = Random(5);
    for (name, pieces, room, of_rooms) in cases {
        let table = Table::new(pieces).unwrap();
        let (mut paths, mut seen) = (vec![], vec![0; table.pieces().len()]);
        for _ in 0..200 {
            let point = v(random.between(-2.5, 2.5), random.between(-2.5, 2.5));
            let mut path = Line { point, velocity: random.velocity() };
            for n in 0..40 {
                paths.push(path);
                let Some(hit) = table.with_walls(Ask(path)).filter(|hit| !hit.corner) else { break };
                let speed = path.velocity.norm();
                if hit.normal.dot(&path.velocity).abs() < 1e-6 * speed {
                    break;
                }
                assert!(of_rooms[room(&point)].contains(&hit.piece), "{name}: {point:?} {n} {path:?} {hit:?}");
                seen[hit.piece] += 1;
                let v = path.velocity;
                path = Line { point: hit.point, velocity: v - hit.normal * (2.0 * v.dot(&hit.normal)) };
            }
        }
        assert!(seen.iter().all(|&n| n > 10), "{name}: {seen:?}");
        table.with_walls(side_by_side::SameBits { name, paths: &paths });
    }
}

#[test]
fn rooms_apart_are_one_table() {
    // two unit squares, and a disk in the second one
    let v = Vector2::new;
    let square = |x: f64| {
        let corners = [v(x, 0.0), v(x + 1.0, 0.0), v(x + 1.0, 1.0), v(x, 1.0)];
        (0..4).map(move |i| Box::new(Segment::new(corners[i], corners[(i + 1) % 4]).unwrap()) as Box<dyn Piece>)
    };
    let table = Table::new(square(0.0).chain(square(2.0)).collect()).unwrap();
    let hit = table.with_walls(Ask(Line { point: v(2.5, 0.5), velocity: v(-1.0, 0.0) })).unwrap();
    assert_eq!((hit.piece, hit.time, hit.point), (7, 0.5, v(2.0, 0.5)));
    let hit = table.with_walls(Ask(Line { point: v(0.5, 0.5), velocity: v(1.0, 0.0) })).unwrap();
    assert_eq!((hit.piece, hit.time, hit.point), (1, 0.5, v(1.0, 0.5)));
}

fn orbit_starts(table: &Table, count: usize, random: &mut Random) -> Vec<Line<2>> {
    let interior = Interior::of(table).unwrap();
    let mut start = || Line { point: interior.point(&mut || random.uniform()).unwrap(), velocity: random.velocity() };
    (0..count).map(|_| start()).collect()
}

fn spatial_paths(entry: &Entry, count: usize, random: &mut Random) -> Vec<Line<3>> {
    let table = entry.spatial(&entry.typical()).unwrap();
    let mut paths = vec![];
    while paths.len() < count {
        let point = SVector::from_fn(|_, _| random.between(-1.0, 1.0));
        if table.contains(&point) {
            paths.push(Line { point, velocity: random.velocity() });
        }
    }
    paths
}

/// Paths aimed at vertices, and one ulp beside them.
fn aimed(table: &Table, random: &mut Random) -> Vec<Line<2>> {
    let vertices: Vec<Vector2<f64>> = table.pieces().iter().filter_map(Piece::ends).map(|[a, _]| a).collect();
    let Ok(interior) = Interior::of(table) else { return vec![] };
    let mut paths = vec![];
    for vertex in vertices {
        for _ in 0..50 {
            let point = interior.point(&mut || random.uniform()).unwrap();
            for turn in [-1.0, 0.0, 1.0] {
                let v = vertex - point;
                let aside = Vector2::new(-v.y, v.x) * (turn * f64::EPSILON);
                paths.push(Line { point, velocity: v + aside });
            }
        }
    }
    paths
}
