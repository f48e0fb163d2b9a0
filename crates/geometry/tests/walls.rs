//! Composite walls against the plain list of pieces, lanes against single numbers, and long orbits against leaks.
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

mod formulas;

use geometry::shapes::{Arc, Bump, Circle, Ellipse, EllipticArc, FullLine, Ray, Segment, Translated};
use geometry::{
    Interior, Line, Outline, Piece, SVector, Table, Turn, Vector2, WallHit, Walls, WithWalls, tables,
    tables::{Build, Entry},
    walls::{Few, List},
};
use lanes::{Kernel, Lane, Mask};

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
        if k < 4 {
            for (name, table) in formulas::tables(by, size) {
                add(name, table);
            }
        }
    }
    all
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
        let vertices: Vec<Vector2<f64>> = self.table.pieces().iter().filter_map(|p| p.ends()).flatten().collect();
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

/// The bits of a hit.
fn bits<F: Lane, const N: usize>(hit: &WallHit<F, N>, lane: usize) -> Vec<u64> {
    let time = hit.time.lane(lane);
    if time == f64::INFINITY {
        return vec![time.to_bits()]; // nothing else means anything
    }
    let corner = f64::from(u8::from(hit.corner.at(lane)));
    let rest = hit.point.iter().chain(&hit.unit_normal()).map(|c| c.lane(lane)).collect::<Vec<_>>();
    [time, hit.piece.lane(lane), corner].into_iter().chain(rest).map(f64::to_bits).collect()
}

/// First hits in lanes.
struct InLanes<'a, W, const N: usize> {
    walls: &'a W,
    paths: &'a [Line<N>],
}

impl<W: Walls<N>, const N: usize> Kernel for InLanes<'_, W, N> {
    type Output = Vec<Vec<u64>>;
    fn run<F: Lane>(self, zero: F) -> Vec<Vec<u64>> {
        let mut all = vec![];
        for block in self.paths.chunks_exact(F::LANES) {
            let x = core::array::from_fn(|i| zero.each(|lane| block[lane].point[i]));
            let v = core::array::from_fn(|i| zero.each(|lane| block[lane].velocity[i]));
            let hit = self.walls.first_hit(&x, &v);
            all.extend((0..F::LANES).map(|lane| bits(&hit, lane)));
        }
        all
    }
}

/// Lanes and single numbers, path by path.
struct SameBits<'a, const N: usize> {
    name: &'a str,
    paths: &'a [Line<N>],
}

impl<const N: usize> WithWalls<N> for SameBits<'_, N> {
    type Output = ();
    fn run<W: Walls<N>>(self, walls: &W) {
        let in_lanes = lanes::dispatch(InLanes { walls, paths: self.paths });
        assert!(in_lanes.len() + 64 > self.paths.len());
        for (path, in_lanes) in self.paths.iter().zip(in_lanes) {
            let single = walls.first_hit::<f64>(&path.point.into(), &path.velocity.into());
            assert_eq!(bits(&single, 0), in_lanes, "{}: {path:?}", self.name);
        }
    }
}

#[test]
fn lanes_have_the_bits_of_single_numbers() {
    let mut random = Random(3);
    for (name, table) in &planar() {
        let paths = paths(table, 512, &mut random);
        table.with_walls(SameBits { name, paths: &paths });
        SameBits { name, paths: &paths }.run(&table.list(0..table.pieces().len()));
    }
    for entry in tables::all() {
        match entry.build {
            Build::Planar(_) => {
                let table = entry.planar(&entry.typical()).unwrap();
                if table.lattice().is_some() {
                    let paths = orbit_starts(&table, 512, &mut random);
                    table.with_walls(SameBits { name: entry.name, paths: &paths });
                }
            }
            Build::Spatial(_) => {
                let paths = spatial_paths(entry, 512, &mut random);
                let table = entry.spatial(&entry.typical()).unwrap();
                table.with_walls(SameBits { name: entry.name, paths: &paths });
            }
        }
    }
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

/// A specular orbit from hit to hit, started anew where it runs into a corner.
struct Bounce<'a, const N: usize, S, D> {
    name: &'a str,
    bounces: usize,
    start: S,
    /// Distance from the boundary of a point.
    distance: D,
    /// Size of the coordinates.
    size: f64,
}

impl<const N: usize, S, D> WithWalls<N> for Bounce<'_, N, S, D>
where
    S: FnMut() -> Line<N>,
    D: Fn(&SVector<f64, N>) -> f64,
{
    type Output = ();
    fn run<W: Walls<N>>(mut self, walls: &W) {
        let mut path = (self.start)();
        let mut instant = 0;
        for n in 0..self.bounces {
            let Some(hit) = walls.hit(&path) else { panic!("{}: lost at bounce {n}: {path:?}", self.name) };
            assert!(hit.time.is_finite() && hit.time >= 0.0, "{}: {path:?} {hit:?}", self.name);
            instant += usize::from(hit.time == 0.0);
            if n % 16 == 0 {
                // the landing point and the distance are each right to 4 ulp of the size
                let off = (self.distance)(&hit.point).abs();
                assert!(off <= 8.0 * f64::EPSILON * self.size, "{}: {off:e} off at {hit:?}", self.name);
            }
            if hit.corner {
                path = (self.start)();
                continue;
            }
            let v = path.velocity;
            path = Line { point: hit.point, velocity: v - hit.normal * (2.0 * v.dot(&hit.normal)) };
        }
        // a second hit at once happens next to corners and in grazing, both rare
        assert!(instant * 100 <= self.bounces, "{}: {instant} hits at once", self.name);
    }
}

#[test]
fn nothing_leaks_from_planar_tables() {
    let mut random = Random(4);
    for (name, table) in planar() {
        let Ok(interior) = Interior::of(&table) else { continue };
        let bounces = if tables::find(&name).is_some() { 100_000 } else { 20_000 };
        table.with_walls(Bounce {
            name: &name,
            bounces,
            start: || Line { point: interior.point(&mut || random.uniform()).unwrap(), velocity: random.velocity() },
            distance: |p: &Vector2<f64>| table.signed_distance(p),
            size: size(&table),
        });
    }
}

#[test]
fn nothing_leaks_from_lattice_tables() {
    let mut random = Random(5);
    for name in ["sinai-torus", "lorentz", "channel"] {
        let entry = tables::find(name).unwrap();
        let table = entry.planar(&entry.typical()).unwrap();
        let interior = Interior::of(&table).unwrap();
        table.with_walls(Bounce {
            name,
            bounces: 100_000,
            // an axis may lie along a corridor, in which nothing is ever hit
            start: || {
                let v = Vector2::new(random.between(0.5, 1.0), random.between(0.3, 0.7));
                Line { point: interior.point(&mut || random.uniform()).unwrap(), velocity: v }
            },
            distance: |p: &Vector2<f64>| table.signed_distance(p),
            size: 2.0,
        });
    }
}

#[test]
fn nothing_leaks_from_tables_in_space() {
    let mut random = Random(6);
    for entry in tables::all().iter().filter(|e| e.dimension() == 3) {
        let table = entry.spatial(&entry.typical()).unwrap();
        let starts = spatial_paths(entry, 1000, &mut random);
        let mut k = 0;
        table.with_walls(Bounce {
            name: entry.name,
            bounces: 100_000,
            start: || {
                k += 1;
                // off the axes, so that the slab is hit
                let path = starts[k % starts.len()];
                Line { point: path.point, velocity: SVector::from([0.3, 0.5, 0.7]) + path.velocity.normalize() * 0.1 }
            },
            distance: |p: &SVector<f64, 3>| table.signed_distance(p),
            size: 1.0,
        });
    }
}

/// Paths aimed at vertices, and one ulp beside them.
fn aimed(table: &Table, random: &mut Random) -> Vec<Line<2>> {
    let vertices: Vec<Vector2<f64>> = table.pieces().iter().filter_map(|p| p.ends()).map(|[a, _]| a).collect();
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

/// That every path hits something, and before it is outside.
struct AllHit<'a> {
    name: &'a str,
    table: &'a Table,
    paths: &'a [Line<2>],
}

impl WithWalls<2> for AllHit<'_> {
    type Output = ();
    fn run<W: Walls<2>>(self, walls: &W) {
        for path in self.paths {
            let hit = walls.hit(path).unwrap_or_else(|| panic!("{}: {path:?} slips through", self.name));
            // the vertex is reached at time 1; at a re-entrant one the path may just pass
            let beyond = 1.0 + 1e-6;
            assert!(hit.time < beyond || self.table.contains(&path.at(beyond)), "{}: {path:?} {hit:?}", self.name);
        }
    }
}

#[test]
fn nothing_slips_through_between_neighbours() {
    let mut random = Random(7);
    for (name, table) in &planar() {
        let paths = aimed(table, &mut random);
        table.with_walls(AllHit { name, table, paths: &paths });
        AllHit { name, table, paths: &paths }.run(&table.list(0..table.pieces().len()));
    }
}

/// The same pieces as shapes that are asked in lanes, and asked one by one.
fn few_and_list(pieces: &[(usize, std::sync::Arc<dyn Piece>)], corners: &[Vector2<f64>]) -> (Few, List) {
    let shapes: Vec<_> = pieces.iter().map(|(number, piece)| (*number, piece.shape().unwrap())).collect();
    (Few::new(&shapes, corners), List::new(pieces.to_vec(), corners))
}

fn assert_same_hits(name: &str, few: &Few, list: &List, paths: &[Line<2>]) {
    for path in paths {
        assert_eq!(few.hit(path), list.hit(path), "{name}: {path:?}");
    }
    SameBits { name, paths }.run(few);
}

#[test]
fn a_few_shapes_are_hit_as_their_list_to_the_last_bit() {
    let mut random = Random(9);
    for (name, table) in &planar() {
        let pieces: Vec<_> = table.pieces().iter().cloned().enumerate().collect();
        if pieces.iter().any(|(_, piece)| piece.shape().is_none()) {
            continue;
        }
        let (few, list) = few_and_list(&pieces, table.corners());
        let mut paths = paths(table, 500, &mut random);
        paths.extend(aimed(table, &mut random));
        assert_same_hits(name, &few, &list, &paths);
    }
}

/// Some shapes of each kind, a chain of segments and arcs among them; and the vertices of that.
fn jumble(random: &mut Random, scale: f64) -> (Vec<Box<dyn Piece>>, Vec<Vector2<f64>>) {
    let mut vertex = || Vector2::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0)) * scale;
    let vertices: Vec<Vector2<f64>> = (0..6).map(|_| vertex()).collect();
    let [a, b, c] = [vertex(), vertex(), vertex()];
    let mut pieces: Vec<Box<dyn Piece>> = vec![];
    for k in 0..vertices.len() {
        let (from, to) = (vertices[k], vertices[(k + 1) % vertices.len()]);
        let (chord, inside) = (to - from, random.uniform() < 0.5);
        let across = Vector2::new(-chord.y, chord.x) * random.between(-1.5, 1.5);
        pieces.push(if random.uniform() < 0.4 {
            Box::new(Segment::new(from, to).unwrap())
        } else {
            Box::new(Arc::new((from + to) * 0.5 + across, from, to, inside).unwrap())
        });
    }
    for inside in [true, false] {
        let [r, s] = [random.between(0.1, 0.7), random.between(0.1, 0.7)];
        let ellipse = Ellipse::new(b, [r * scale, s * scale], random.between(0.0, 6.3), inside).unwrap();
        let [from, to] = [random.uniform(), random.uniform()].map(|u| ellipse.point_at(u * ellipse.length()));
        pieces.push(Box::new(Circle::new(a, r * scale, inside).unwrap()));
        pieces.push(Box::new(ellipse));
        pieces.push(Box::new(EllipticArc::new(ellipse, from, to).unwrap()));
        pieces.push(Box::new(Ray::new(c, a - c, inside).unwrap()));
    }
    pieces.push(Box::new(FullLine::new(c * 2.0, b).unwrap()));
    (pieces, vertices)
}

#[test]
fn random_lists_of_shapes_are_hit_as_asked_one_by_one_to_the_last_bit() {
    let mut random = Random(10);
    let (mut hits, mut corners) = (0, 0);
    for k in 0..60 {
        let scale = libm::exp2(random.between(-40.0, 40.0));
        let (all, vertices) = jumble(&mut random, scale);
        // not all kinds at once, or the nearest hide the others
        let keep = [1.0, 0.5, 0.2][k % 3];
        let pieces: Vec<_> = all.into_iter().filter(|_| random.uniform() < keep).map(std::sync::Arc::from).collect();
        let pieces: Vec<_> = pieces.into_iter().enumerate().collect();
        let (few, list) = few_and_list(&pieces, &vertices);
        let mut paths: Vec<Line<2>> = vec![];
        for _ in 0..200 {
            let point = Vector2::new(random.between(-1.5, 1.5), random.between(-1.5, 1.5)) * scale;
            let velocity = random.velocity() * scale;
            paths.push(Line { point, velocity });
            paths.push(Line { point, velocity: vertices[k % vertices.len()] - point });
            // from where it ends, and from far away
            if let Some(hit) = list.hit(&Line { point, velocity }) {
                paths.push(Line { point: hit.point, velocity });
                paths.push(Line { point: hit.point, velocity: random.velocity() });
            }
            paths.push(Line { point: point - velocity * 1e3, velocity });
        }
        let found: Vec<_> = paths.iter().filter_map(|path| list.hit(path)).collect();
        (hits, corners) = (hits + found.len(), corners + found.iter().filter(|hit| hit.corner).count());
        assert_same_hits(&format!("jumble {k}"), &few, &list, &paths);
    }
    assert!(hits > 20_000 && corners > 300, "{hits} {corners}");
}

#[test]
fn shapes_beside_other_pieces_are_hit_in_the_right_order() {
    // a square with one side that is no shape: it has a bump
    let v = Vector2::new;
    let corners = [v(0.0, 0.0), v(1.0, 0.0), v(1.0, 1.0), v(0.0, 1.0)];
    let side = |i: usize| -> Box<dyn Piece> {
        let (a, b) = (corners[i], corners[(i + 1) % 4]);
        if i == 1 { Box::new(Bump::new(a, b, -0.25).unwrap()) } else { Box::new(Segment::new(a, b).unwrap()) }
    };
    let table = Table::new((0..4).map(side).collect()).unwrap();
    let mut random = Random(11);
    let (mut paths, aimed) = (paths(&table, 2000, &mut random), aimed(&table, &mut random));
    table.with_walls(AllHit { name: "bump", table: &table, paths: &aimed });
    paths.extend(aimed);
    table.with_walls(Compare { name: "bump", table: &table, paths: &paths });
    table.with_walls(SameBits { name: "bump", paths: &paths });
    let list = table.list(0..4);
    assert!(paths.iter().filter(|path| list.hit(path).is_some_and(|hit| hit.piece == 1)).count() > 500);
}

/// Lattice walls against all translates of the pieces around the origin.
struct CompareLifted<'a> {
    name: &'a str,
    table: &'a Table,
    paths: &'a [Line<2>],
}

impl WithWalls<2> for CompareLifted<'_> {
    type Output = ();
    fn run<W: Walls<2>>(self, walls: &W) {
        let lattice = self.table.lattice().unwrap();
        let mut pieces: Vec<(usize, std::sync::Arc<dyn Piece>)> = vec![];
        let second = if lattice.vectors().len() == 2 { -9..=9 } else { 0..=0 };
        for (i, piece) in self.table.pieces().iter().enumerate() {
            for (a, b) in (-9..=9).flat_map(|a| second.clone().map(move |b| (a, b))) {
                let by = lattice.translation([f64::from(a), f64::from(b)]);
                pieces.push((i, std::sync::Arc::new(Translated::new(piece.clone(), by))));
            }
        }
        let lifted = List::new(pieces, &[]);
        let mut compared = 0;
        for path in self.paths {
            let speed = path.velocity.norm();
            let Some(a) = lifted.hit(path).filter(|a| a.time * speed < 5.0) else { continue };
            let b = walls.hit(path).unwrap();
            let cos = path.velocity.dot(&a.normal).abs() / speed;
            // as for composite walls, and at each of at most 12 crossings of a cell's edge 2 ulp more
            let bound = (16.0 + 24.0) * f64::EPSILON * 5.0 / cos;
            let context = || format!("{}: {path:?} {a:?} {b:?}", self.name);
            assert_eq!(a.piece, b.piece, "{}", context());
            assert!((a.time - b.time).abs() * speed <= bound, "{}", context());
            let apart = a.point - b.point;
            assert!((apart - lattice.translation(lattice.nearest(&apart))).norm() <= bound, "{}", context());
            compared += 1;
        }
        assert!(compared * 2 > self.paths.len());
    }
}

#[test]
fn lattice_walls_agree_with_all_translates() {
    let mut random = Random(8);
    for name in ["sinai-torus", "lorentz", "channel"] {
        let entry = tables::find(name).unwrap();
        let table = entry.planar(&entry.typical()).unwrap();
        let paths = orbit_starts(&table, 1000, &mut random);
        table.with_walls(CompareLifted { name, table: &table, paths: &paths });
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

#[test]
fn a_hit_at_a_joint_of_the_lattice_is_a_corner() {
    // the cusps of a channel with dispersing walls, where one cell meets the next
    let table = tables::channel(1.0, 1.0, 0.25).unwrap();
    assert_eq!(table.corners().len(), 4);
    let hit =
        table.with_walls(Ask(Line { point: Vector2::new(0.75, 0.5), velocity: Vector2::new(0.25, -0.5) })).unwrap();
    assert!(hit.corner, "{hit:?}");
    // and where an arc meets an arc of its own circle there is none
    let circle = Outline::from(Vector2::new(1.0, 0.0))
        .arc_to(Vector2::new(-1.0, 0.0), Vector2::zeros(), Turn::CounterClockwise)
        .and_then(|o| o.arc_to(Vector2::new(1.0, 0.0), Vector2::zeros(), Turn::CounterClockwise));
    assert!(Table::new(circle.unwrap().close().unwrap()).unwrap().corners().is_empty());
    assert!(Arc::new(Vector2::zeros(), Vector2::new(1.0, 0.0), Vector2::new(1.0, 0.0), true).is_err());
}
