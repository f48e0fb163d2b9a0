//! The horizon is where an orbit's digits really end.
use billiards::{
    Billiard, Bounce, Clock, Collisions, Conserved, Felt, Horizon, Orbit, Planar, Spatial, Start,
    laws::{Custom, Disk, PerPiece, RoughBall},
    reverse, run,
};
use collision_laws::{
    CollisionLaw, Contact, Delassus,
    laws::{NoSlip, RandomGrassmannian, RoughPlane, Specular},
};
use core::f64::consts::{FRAC_1_SQRT_2, TAU};
use geometry::{
    Piece, Table, Vector2, Vector3, Walls, WithWalls,
    parry::{Room, Side, SolidSpec},
    shapes::{Circle, Segment},
    tables,
    tables::SpatialTable,
    walls::ByLane,
};

fn horizon(table: &Table, law: &Disk, start: Start<2, 1>, size: f64, collisions: u32) -> Horizon {
    let billiard = Planar { table: table.clone(), law: *law };
    billiard.horizon(start, size, [f64::from(collisions), f64::INFINITY])
}

fn laws() -> [Disk; 2] {
    [Disk::new(&NoSlip, FRAC_1_SQRT_2).unwrap(), Disk::new(&Specular, FRAC_1_SQRT_2).unwrap()]
}

/// Starts in every table used here, off the scatterer.
fn starts() -> impl Iterator<Item = Start<2, 1>> {
    (0..24).map(|k| {
        let k = f64::from(k);
        Start {
            position: [0.11 + 0.003 * k, 0.13],
            velocity: [libm::cos(0.7 + 1.7 * k), libm::sin(0.7 + 1.7 * k)],
            spin: [0.4 * libm::sin(k)],
        }
    })
}

fn orbit(m: &Start<2, 1>) -> Orbit<f64, 2, 1, Conserved<f64, 2>, Clock> {
    Orbit::new(m.position, m.velocity, m.spin, Clock::new(0.0))
}

/// The collision at which two orbits are an eighth of a table apart that start an ulp of the table from each other (a fourth would be
/// reached by chance only where all collisions are with one disk of that radius).
fn parting(billiard: &Planar<Disk>, start: &Start<2, 1>, size: f64) -> Option<u64> {
    let mut other = *start;
    other.position[0] += 2.0 * f64::EPSILON;
    let (mut a, mut b) = (orbit(start), orbit(&other));
    for n in 1..=400 {
        let made = [&mut a, &mut b].map(|o| billiard.run(o, &Collisions(1), &mut ()).collisions);
        if made != [1, 1] {
            return None;
        }
        let [dx, dy] = [0, 1].map(|i| a.position[i] - b.position[i]);
        if libm::hypot(dx, dy) > 0.125 * size {
            return Some(n);
        }
    }
    None
}

#[test]
fn on_chaotic_tables_twins_part_at_the_horizon() {
    for (name, table, size) in [
        ("stadium", tables::stadium(1.0, 1.0).unwrap(), 2.0),
        ("sinai", tables::sinai(1.0, 0.25).unwrap(), 1.0),
        ("sinai torus", tables::sinai_torus(0.25, 1.0).unwrap(), 1.0),
    ] {
        // no-slip orbits are often regular: specular ones part
        let billiard = Planar { table, law: laws()[1] };
        let (mut ratios, mut compared) = (0.0, 0);
        for start in starts() {
            let Some(parted) = parting(&billiard, &start, size) else { continue };
            let horizon = horizon(&billiard.table, &billiard.law, start, size, 400);
            assert!(horizon.lost, "{name}: {horizon:?}");
            let ratio = horizon.collisions as f64 / parted as f64;
            // a bound for all errors is some hundred times the one ulp of the twins, which is six of forty collisions, and the
            // growth near the end depends on where they happen to be
            assert!((0.6..1.6).contains(&ratio), "{name}: parted at {parted}, {horizon:?}");
            ratios += ratio;
            compared += 1;
        }
        assert!(compared > 12, "{name}: {compared}");
        let mean = ratios / f64::from(compared);
        // a bound that is a thousand times the one ulp of the twins comes ln(10³) of ln(2⁵²) too early: 0.8
        assert!((0.75..1.1).contains(&mean), "{name}: {mean}");
    }
}

#[test]
fn on_integrable_tables_the_error_grows_like_a_power() {
    for (law, third) in laws().into_iter().zip(["strip", "square"]) {
        for (name, table) in [
            ("circle", tables::circle(1.0).unwrap()),
            ("equilateral", tables::equilateral(1.0).unwrap()),
            (third, if third == "strip" { tables::strip(1.0).unwrap() } else { tables::square(1.0).unwrap() }),
        ] {
            for start in starts().take(4) {
                let [few, many] = [100, 10_000].map(|n| horizon(&table, &law, start, 1.0, n));
                if few.collisions < 100 || many.collisions < 10_000 {
                    continue; // a corner
                }
                assert!(!many.lost);
                // errors of the velocity that add up grow like N, and so do those of the places that each of them leads to; the
                // last wall may be met at another angle than the hundredth, which counts a factor of two
                let exponent = 0.5 * libm::log10(many.error / few.error);
                assert!(exponent < 2.2, "{name}: N^{exponent:.2}");
            }
        }
    }
}

/// Goes forward and back again; the distance from the first collision, and the horizon's error of an orbit of that length.
fn there_and_back(billiard: &Planar<Disk>, start: &Start<2, 1>, collisions: u32) -> Option<[f64; 2]> {
    let mut o = orbit(start);
    let mut last = None;
    let mut first = None;
    for n in 0..collisions {
        let mut watch = billiards::observe::Watch::new(|c: &billiards::Collision<'_, 2, 1, _, _>| {
            last = Some(*c.hit);
            core::ops::ControlFlow::Continue(())
        });
        if billiard.run(&mut o, &Collisions(1), &mut watch).collisions == 0 {
            return None;
        }
        if n == 0 {
            first = Some(o.position);
        }
    }
    reverse(&billiard.law, &mut o, &last?);
    if billiard.run(&mut o, &Collisions(u64::from(collisions) - 1), &mut ()).collisions + 1 < u64::from(collisions) {
        return None;
    }
    let first = first?;
    let error = libm::hypot(o.position[0] - first[0], o.position[1] - first[1]);
    let horizon = horizon(&billiard.table, &billiard.law, *start, 1.0, 2 * collisions);
    (!horizon.lost).then_some([error, horizon.error])
}

#[test]
fn orbits_that_turn_around_come_back_within_the_horizon() {
    let chaotic: &[u32] = &[4, 8, 12, 16];
    let regular: &[u32] = &[10, 100, 1000];
    for (name, table, lengths) in [
        ("circle", tables::circle(1.0).unwrap(), regular),
        ("strip", tables::strip(1.0).unwrap(), regular),
        ("square", tables::square(1.0).unwrap(), regular),
        ("ellipse", tables::ellipse([2.0, 1.0]).unwrap(), regular),
        ("stadium", tables::stadium(1.0, 1.0).unwrap(), chaotic),
        ("sinai", tables::sinai(1.0, 0.25).unwrap(), chaotic),
    ] {
        for (law, slip) in laws().into_iter().zip(["no-slip", "specular"]) {
            let billiard = Planar { table: table.clone(), law };
            let mut worst: f64 = 0.0;
            for start in starts() {
                for &n in lengths {
                    let Some([error, estimate]) = there_and_back(&billiard, &start, n) else { continue };
                    worst = worst.max(error / estimate);
                }
            }
            // a bound, but for flat orbits, in which the energy's rounding goes into a normal velocity that is next to nothing
            assert!(worst < 8.0, "{name}, {slip}: {worst} times the bound");
            // and no idle one, though errors that cancel stay far below it
            assert!(worst > 1e-3, "{name}, {slip}: only {worst} of the bound");
        }
    }
}

#[test]
fn orbits_that_pass_foci_of_an_ellipse_are_not_lost() {
    let (table, [_, specular]) = (tables::ellipse([2.0, 1.0]).unwrap(), laws());
    for k in 0..16 {
        let (sin, cos) = libm::sincos(0.3 + 0.37 * f64::from(k));
        // the errors are focused again and again: their variances across and along the path differ by more than 10¹⁶
        let start = Start { position: [libm::sqrt(3.0), 1e-6], velocity: [cos, sin], spin: [0.0] };
        let horizon = horizon(&table, &specular, start, 2.0, 300);
        assert!(!horizon.lost && (1e-12..1e-3).contains(&horizon.error), "{k}: {horizon:?}");
    }
}

#[test]
fn a_strip_that_lies_askew_has_the_horizon_of_an_upright_one() {
    use geometry::shapes::FullLine;
    let turned = |[x, y]: [f64; 2]| Vector2::new(0.6 * x - 0.8 * y, 0.8 * x + 0.6 * y);
    let wall = |y: f64, along: f64| {
        let line = FullLine::new(turned([0.0, y]), turned([along, 0.0])).unwrap();
        Box::new(line) as Box<dyn Piece>
    };
    let askew = Table::new(vec![wall(0.0, 1.0), wall(1.0, -1.0)]).unwrap();
    let upright = tables::strip(1.0).unwrap();
    for law in laws() {
        let start = |turned: &dyn Fn([f64; 2]) -> Vector2<f64>| Start {
            position: turned([0.0, 0.5]).into(),
            velocity: turned([1.0, 0.0037]).into(),
            spin: [0.1],
        };
        let of_upright = horizon(&upright, &law, start(&Vector2::from), 1.0, 5000);
        // of no size, as far as anybody knows
        let of_askew = horizon(&askew, &law, start(&turned), f64::INFINITY, 5000);
        let share = of_askew.error / of_upright.error;
        assert!((0.3..3.0).contains(&share), "{of_askew:?} {of_upright:?}");
        assert_eq!(of_upright.lost, of_askew.lost);
    }
}

#[test]
fn the_rounding_of_a_large_radius_or_a_far_centre_counts() {
    use geometry::shapes::Arc;
    let law = Disk::new(&Specular, FRAC_1_SQRT_2).unwrap();
    let error = |radius: f64| {
        // a unit square whose floor is a flat arc
        let [a, b, c, d] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(Vector2::from);
        let floor = Arc::new(Vector2::new(0.5, libm::sqrt(radius * radius - 0.25)), a, b, true).unwrap();
        let side = |from, to| Box::new(Segment::new(from, to).unwrap()) as Box<dyn Piece>;
        let table = Table::new(vec![Box::new(floor), side(b, c), side(c, d), side(d, a)]).unwrap();
        let start = Start { position: [0.3, 0.4], velocity: [0.31, -0.95], spin: [0.0] };
        horizon(&table, &law, start, 1.0, 2).error
    };
    for radius in [1e3, 1e5, 1e7] {
        // an ulp of the radius
        let ulps = error(radius) / (f64::EPSILON * radius);
        assert!((0.5..10.0).contains(&ulps), "{radius:e}: {ulps}");
    }
}

#[test]
fn a_limit_that_is_no_number_is_over_at_once() {
    let table = tables::square(1.0).unwrap();
    let start = Start { position: [0.1, 0.2], velocity: [0.6, 0.8], spin: [0.0] };
    let billiard = Planar { table, law: Specular };
    for limit in [[f64::NAN, f64::INFINITY], [f64::INFINITY, f64::NAN], [f64::NAN; 2], [0.0, 1.0], [9.0, -1.0]] {
        assert_eq!(billiard.horizon(start, 1.0, limit).collisions, 0, "{limit:?}");
    }
    assert_eq!(billiard.horizon(start, 1.0, [9.0, f64::INFINITY]).collisions, 9);
}

#[test]
fn in_space_the_curvature_of_walls_counts() {
    struct Look<'a>(&'a RoughBall, &'a SpatialTable, Start<3, 3>);
    impl WithWalls<3> for Look<'_> {
        type Output = Horizon;
        fn run<W: Walls<3>>(self, walls: &W) -> Horizon {
            let billiard = Billiard { walls, law: self.0 };
            let limit = [200.0, f64::INFINITY];
            let [exact, felt] = [
                Horizon::of(&billiard, self.1, self.2, 1.0, limit),
                Horizon::of(&billiard, &Felt(&billiard), self.2, 1.0, limit),
            ];
            assert!((exact.error / felt.error - 1.0).abs() < 1e-3, "{exact:?} {felt:?}");
            exact
        }
    }
    let law = RoughBall::no_slip(0.4_f64.sqrt()).unwrap();
    let start = Start { position: [0.1, 0.2, 0.3], velocity: [0.5, 0.4, 0.6], spin: [0.1, 0.2, 0.3] };
    for table in [tables::slab(1.0).unwrap(), tables::ball(1.0).unwrap()] {
        let billiard = Spatial { table, law };
        let horizon = billiard.table.with_walls(Look(&law, &billiard.table, start));
        assert!(!horizon.lost && horizon.error < 1e-11, "{:?}: {horizon:?}", billiard.table);
        assert_eq!(billiard.horizon(start, 1.0, [200.0, f64::INFINITY]), horizon);
    }
    // the same ball outside: a scatterer in a box
    let walls = geometry::walls::Around {
        container: geometry::walls::Cuboid::new([-1.0; 3], [1.0; 3], [[0, 1], [2, 3], [4, 5]]).unwrap(),
        obstacles: geometry::walls::Scatterer::new(geometry::Vector3::zeros(), 0.5, 6).unwrap(),
    };
    let start = Start { position: [0.9, 0.8, 0.3], ..start };
    let billiard = Billiard { walls: &walls, law: &Specular };
    let chaotic = Horizon::of(&billiard, &Felt::<3, 3>(&billiard), start, 1.0, [400.0, f64::INFINITY]);
    assert!(chaotic.lost && chaotic.collisions < 200, "{chaotic:?}");
}

/// A floor that pushes along itself by the sine of the place: between two of them, the standard map.
struct Kicks;

impl CollisionLaw<2> for Kicks {
    fn impulse(&self, contact: &Contact<2>, _: &Delassus<2>, u: &geometry::Vector2<f64>) -> geometry::Vector2<f64> {
        let nu = contact.normal.as_ref();
        nu * (-2.0 * nu.dot(u)) + geometry::Vector2::new(libm::sin(TAU * contact.point.x), 0.0)
    }
}

#[test]
fn a_law_that_projects_its_rough_directions_has_the_horizon_of_the_ball_that_rolls_along_one() {
    let ball = || tables::ball(1.0).unwrap();
    let (direction, gamma) = (Vector3::new(1.0, 0.5, 0.25), libm::sqrt(0.4));
    let start = Start { position: [0.25, 0.125, -0.25], velocity: [0.5, 0.75, 0.25], spin: [0.25, -0.5, 0.375] };
    let named = Spatial { table: ball(), law: RoughBall::along(gamma, direction).unwrap() };
    let custom = Spatial { table: ball(), law: Custom::ball(RoughPlane::new(&[direction]).unwrap(), gamma).unwrap() };
    for collisions in [4.0, 20.0, 60.0] {
        let limit = [collisions, f64::INFINITY];
        let (a, b) = (named.horizon(start, 1.0, limit), custom.horizon(start, 1.0, limit));
        assert!(!a.lost && !b.lost, "{a:?} {b:?}");
        assert!((a.error / b.error - 1.0).abs() < 1e-6, "{a:?} {b:?}");
    }
}

#[test]
fn where_the_law_depends_on_the_place_twins_part_at_the_horizon() {
    let strip = geometry::walls::Slab::<2, 1>::new(0.0, 1.0, [0, 1]).unwrap();
    let law = Custom::disk(Kicks, 1.0).unwrap();
    let billiard = Billiard { walls: &strip, law: &law };
    for k in 0..8 {
        let start = Start { position: [0.1 + 0.07 * f64::from(k), 0.5], velocity: [0.3, 1.0], spin: [0.0] };
        let horizon = Horizon::of(&billiard, &Felt(&billiard), start, 1.0, [400.0, f64::INFINITY]);
        let mut twin = start;
        twin.position[0] += f64::EPSILON;
        let [mut a, mut b] = [start, twin].map(|start| start.orbit::<(), ()>(()));
        let mut parted = 0;
        while (a.position[0] - b.position[0]).abs() < 0.25 {
            for orbit in [&mut a, &mut b] {
                run(&billiard, orbit, &Collisions(1), &mut ());
            }
            parted += 1;
            assert!(parted < 200, "{k}");
        }
        assert!(horizon.lost, "{k}: {horizon:?}");
        // the bound is for many more errors than the one of the twin
        let ratio = horizon.collisions as f64 / f64::from(parted);
        assert!((0.5..1.1).contains(&ratio), "{k}: {horizon:?}, parted at {parted}");
    }
}

#[test]
fn of_an_orbit_that_meets_another_law_at_each_ulp_nothing_is_left_after_two_collisions() {
    let cube = geometry::walls::Cuboid::new([0.0; 3], [1.0; 3], [[0, 1], [2, 3], [4, 5]]).unwrap();
    let start = Start { position: [0.3, 0.4, 0.2], velocity: [0.5, 0.4, 0.6], spin: [0.1, 0.2, 0.3] };
    let horizon = |law: &dyn Bounce<3, 3>| Horizon::of(law, &Felt(law), start, 1.0, [200.0, f64::INFINITY]);
    let drawn = Custom::ball(RandomGrassmannian::new(1, 5).unwrap(), 0.6).unwrap();
    let found = horizon(&Billiard { walls: &cube, law: &drawn });
    assert!(found.lost && found.collisions <= 2, "{found:?}");
    // a law that is the same everywhere keeps its digits
    let rough = Custom::ball(NoSlip, 0.6).unwrap();
    let found = horizon(&Billiard { walls: &cube, law: &rough });
    assert!(!found.lost && found.error < 1e-4, "{found:?}");
}

#[test]
fn spin_that_the_law_does_not_ask_for_costs_no_digits() {
    let table = tables::square(1.0).unwrap();
    let of = |law: &Disk, spin: f64| {
        let start = Start { position: [0.3, 0.2], velocity: [0.6, 0.77], spin: [spin] };
        horizon(&table, law, start, 1.0, 1000)
    };
    let [_, specular] = laws();
    let still = of(&specular, 0.0);
    for spin in [1.0, 1e6, 1e12] {
        let spinning = of(&specular, spin);
        // the error of the motion is told in units of the whole speed, that of the place is the same
        assert!(
            !spinning.lost && spinning.error < 1.001 * still.error && spinning.error > 0.1 * still.error,
            "{spin}: {spinning:?} {still:?}"
        );
    }
}

#[test]
fn an_orbit_that_starts_on_a_wall_on_its_way_out_is_not_lost() {
    let start = Start { position: [0.41, 0.0], velocity: [0.6, -0.8], spin: [0.1] };
    for law in laws() {
        let seen = horizon(&tables::square(1.0).unwrap(), &law, start, 1.0, 100);
        assert_eq!((seen.collisions, seen.lost), (100, false), "{seen:?}");
    }
}

#[test]
fn the_edges_of_an_obstacle_bend_no_orbit_that_hits_beside_them() {
    // all faces of a solid are one piece of a room, and flat
    let cube = SolidSpec::Cuboid { size: [1.0; 3], rounding: 0.0 }.solid([0.0; 3], Side::Inside).unwrap();
    let tips = [0, 1, 2].map(|i| [-0.45, 0.45].map(|x| core::array::from_fn(|k| if k == i { x } else { 0.0 })));
    let octahedron = SolidSpec::ConvexHull { points: tips.concat(), rounding: 0.0 };
    let room = Room::new(vec![cube, octahedron.solid([0.0; 3], Side::Outside).unwrap()]);
    let billiard = Billiard { walls: &ByLane(&room), law: &Specular };
    let velocity = [-0.850_097_322_059_256_9, 0.463_196_842_175_627_84, -1.232_620_903_193_262_5];
    let start = Start { position: [0.45, -0.45, 0.45], velocity, spin: [] };
    let horizon = Horizon::of(&billiard, &Felt::<3, 0>(&billiard), start, 1.0, [12_500.0, f64::INFINITY]);
    assert!(!horizon.lost && horizon.error < 1e-6, "{horizon:?}");
}

#[test]
fn the_horizon_on_a_lattice_is_the_same_from_every_cell() {
    let table = tables::sinai_torus(0.25, 1.0).unwrap();
    for law in laws() {
        let [here, there] = [0.125, 1024.125].map(|x| {
            let start = Start { position: [x, 0.125], velocity: [0.6, 0.8], spin: [0.25] };
            horizon(&table, &law, start, 1.0, 200)
        });
        assert_eq!(here, there);
        assert!(here.collisions > 5);
    }
}

fn polygon(vertices: &[[f64; 2]]) -> Vec<Box<dyn Piece>> {
    let to = vertices.iter().cycle().skip(1);
    let side = |(a, b): (&[f64; 2], &[f64; 2])| Segment::new(Vector2::from(*a), Vector2::from(*b)).unwrap();
    vertices.iter().zip(to).map(|of| Box::new(side(of)) as Box<dyn Piece>).collect()
}

#[test]
fn an_orbit_that_passes_a_vertex_at_less_than_its_error_is_lost_there() {
    let room = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    let table = Table::new(polygon(&room)).unwrap();
    // the collision from which on the orbit in 200 bits is another one
    for (position, velocity, wrong) in [
        ([0.7, 0.9], [0.749, 0.303], 492),
        ([0.9, 0.6], [0.413, 0.832], 1412),
        ([0.9, 0.2], [0.749, 0.372], 2168),
        ([0.6, 0.2], [0.973, 0.671], 5248),
    ] {
        let start = Start { position, velocity, spin: [0.0] };
        let seen = horizon(&table, &laws()[1], start, 2.0, 6000);
        assert!(seen.lost && seen.collisions < wrong && seen.error < 1e-9, "{seen:?}");
        // a bound that is a hundred times the error is as early in a vertex's reach
        assert!(100 * seen.collisions > wrong, "{seen:?}");
    }
}

#[test]
fn what_an_orbit_passes_within_its_error_is_seen_where_that_is_large_for_its_flights() {
    let [no_slip, specular] = laws();
    let mut long = polygon(&[[0.0, 0.0], [20.0, 0.3], [19.7, 1.3], [-0.2, 0.9]]);
    long.push(Box::new(Circle::new(Vector2::new(2.0, 0.5), 0.2, false).unwrap()));
    let (long, sinai) = (Table::new(long).unwrap(), tables::sinai(1.0, 0.25).unwrap());
    let start = |position, velocity, spin| Start { position, velocity, spin: [spin] };
    // the collision from which on the orbit in 60 digits is another one
    for (table, law, size, start, wrong) in [
        (
            &sinai,
            &no_slip,
            1.0,
            start(
                [0.509_870_481_358_985_6, 0.093_689_168_952_630_8],
                [0.693_927_022_845_07, 0.720_045_336_743_026],
                0.359_951_399_047_408_86,
            ),
            87,
        ),
        (
            &long,
            &specular,
            20.2,
            start(
                [1.350_470_012_284_152_4, 0.646_211_582_257_185],
                [0.473_425_895_213_100_86, 0.880_833_651_572_006],
                0.0,
            ),
            213,
        ),
    ] {
        let seen = horizon(table, law, start, size, 400);
        assert!(seen.lost && seen.collisions < wrong, "{wrong}: {seen:?}");
        // and not much sooner
        assert!(seen.collisions + 8 > wrong, "{wrong}: {seen:?}");
    }
}

/// The unit square, specular, around a disk of radius 1/20 under some law.
fn pillar(law: Disk) -> Planar<PerPiece> {
    let mut pieces = polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    pieces.push(Box::new(Circle::new(Vector2::repeat(0.5), 0.05, false).unwrap()));
    let [_, specular] = laws();
    Planar { table: Table::new(pieces).unwrap(), law: PerPiece::new(specular, [specular, specular, specular, law]) }
}

#[test]
fn an_orbit_that_may_graze_a_disk_is_lost_where_that_turns_it_and_keeps_the_root_of_its_error_where_not() {
    // misses the disk by 10⁻¹⁶ at collision 151, and by not much more every 14 collisions before
    let position = [0.650_000_000_000_015_1, 0.05];
    let start = Start { position, velocity: [0.04, 0.030_000_000_000_000_006], spin: [0.3] };
    let [no_slip, specular] = laws().map(|law| {
        let seen = |n| pillar(law).horizon(start, 1.0, [n, f64::INFINITY]);
        [seen(13.0), seen(200.0)]
    });
    assert!(no_slip[1].lost && no_slip[1].collisions <= 151 && no_slip[1].error < 1e-9, "{no_slip:?}");
    // a specular disk turns what grazes it by no more than the root of what is between
    assert!(!specular[0].lost && (1e-9..1e-4).contains(&specular[0].error), "{specular:?}");
    // an orbit that passes the disk at more than its error knows nothing of it
    let past = Start { position: [0.650_000_000_1, 0.05], ..start };
    for law in laws() {
        let seen = pillar(law).horizon(past, 1.0, [100.0, f64::INFINITY]);
        assert!(!seen.lost && seen.error < 1e-11, "{seen:?}");
    }
}

/// A start whose path, were it not reflected, would pass a place by so much.
fn past(place: [f64; 2], by: f64) -> Start<2, 1> {
    let position = [0.31, 0.24];
    let way = [place[0] - position[0], place[1] - position[1]];
    let length = libm::hypot(way[0], way[1]);
    let velocity = [way[0] - by * way[1] / length, way[1] + by * way[0] / length];
    Start { position, velocity, spin: [0.2] }
}

#[test]
fn specular_orbits_are_not_lost_at_corners_of_an_integer_part_of_a_half_turn() {
    let root = 3.0_f64.sqrt();
    for (name, vertices, images) in [
        // images of vertices in the tiling of the plane by reflections
        ("square", vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], [[1.0, 1.0], [4.0, 3.0], [6.0, 7.0]]),
        (
            "equilateral",
            vec![[0.0, 0.0], [1.0, 0.0], [0.5, 0.5 * root]],
            [[0.5, 0.5 * root], [3.5, 1.5 * root], [5.0, 3.0 * root]],
        ),
        ("isosceles", vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], [[1.0, 0.0], [4.0, 3.0], [6.0, 7.0]]),
        (
            "half an equilateral",
            vec![[0.0, 0.0], [1.0, 0.0], [0.0, root]],
            [[0.0, root], [4.0, 2.0 * root], [1.0, 6.0 * root]],
        ),
    ] {
        let table = Table::new(polygon(&vertices)).unwrap();
        let mut followed = 0;
        for image in images {
            for by in [-3e-14, -1e-14, -5e-15, 5e-15, 1e-14, 3e-14] {
                let seen = horizon(&table, &laws()[1], past(image, by), 1.0, 1000);
                assert!(!seen.lost && seen.error < 1e-8, "{name}, {image:?} {by:e}: {seen:?}");
                followed += u32::from(seen.collisions == 1000);
            }
        }
        // the others end in a corner, as the orbits do
        assert!(followed > 9, "{name}: {followed}");
    }
}

#[test]
fn where_walls_turn_a_little_the_error_is_as_large_as_the_turn() {
    let law = laws()[1];
    for sides in [1000_u32, 100_000] {
        let angle = TAU / f64::from(sides);
        let vertices: Vec<_> = (0..sides).map(|i| angle * f64::from(i)).map(|t| [libm::cos(t), libm::sin(t)]).collect();
        let table = Table::new(polygon(&vertices)).unwrap();
        let billiard = Planar { table, law };
        // starts from where the path past a vertex comes to the other way, so that it passes there at collision 30
        let turned = |by| {
            let Start { position, velocity, spin } = past(vertices[77], by);
            let mut o = orbit(&Start { position, velocity: velocity.map(|v| -v), spin });
            billiard.run(&mut o, &Collisions(29), &mut ());
            let (position, velocity) = (o.position, o.velocity);
            billiard.run(&mut o, &Collisions(1), &mut ());
            let middle = [0, 1].map(|i| 0.5 * (position[i] + o.position[i]));
            let start = Start { position: middle, velocity: velocity.map(|v| -v), spin };
            let seen = horizon(&billiard.table, &law, start, 2.0, 30);
            assert_eq!((seen.collisions, seen.lost), (30, false), "{sides}, {by:e}: {seen:?}");
            seen.error / (2.0 * angle)
        };
        // at less than its error, and at more
        assert!((0.5..2.0).contains(&turned(1e-14)), "{sides}: {}", turned(1e-14));
        assert!(turned(1e-11) < 1e-8, "{sides}: {}", turned(1e-11));
    }
    // from a straight wall to an arc only the curvature changes
    let stadium = tables::stadium(1.0, 1.0).unwrap();
    for joint in [[1.0, 1.0], [-1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]] {
        for by in [-1e-15, 0.0, 1e-15] {
            let seen = horizon(&stadium, &law, past(joint, by), 4.0, 3);
            assert_eq!((seen.collisions, seen.lost), (3, false));
            assert!(seen.error < 1e-13, "{seen:?}");
        }
    }
}

#[test]
fn in_space_too_an_orbit_that_may_graze_is_lost_where_that_turns_it() {
    let walls = geometry::walls::Around {
        container: geometry::walls::Cuboid::new([-1.0; 3], [1.0; 3], [[0, 1], [2, 3], [4, 5]]).unwrap(),
        obstacles: geometry::walls::Scatterer::new(geometry::Vector3::zeros(), 0.5, 6).unwrap(),
    };
    let rough = RoughBall::no_slip(0.4_f64.sqrt()).unwrap();
    for [y, z] in [[0.5, 0.0], [0.0, 0.5], [0.3, 0.4], [-0.4, 0.3], [0.3, -0.4]] {
        let seen = |farther: f64| {
            let position = [-0.9, y * farther, z * farther];
            let start = Start { position, velocity: [1.0, 0.0, 0.0], spin: [0.1, 0.2, 0.3] };
            let of = |law: &dyn Bounce<3, 3>| Horizon::of(law, &Felt(law), start, 2.0, [1.0, f64::INFINITY]);
            [of(&Billiard { walls: &walls, law: &rough }), of(&Billiard { walls: &walls, law: &Specular })]
        };
        let [rough, specular] = seen(1.0 + f64::EPSILON);
        assert!(rough.lost && rough.collisions == 0, "{y} {z}: {rough:?}");
        assert!(!specular.lost && (1e-9..1e-6).contains(&specular.error), "{y} {z}: {specular:?}");
        // at more than the error, nothing happens
        for seen in seen(1.0 + 1e-14) {
            assert!(!seen.lost && seen.error < 1e-15, "{y} {z}: {seen:?}");
        }
    }
}
