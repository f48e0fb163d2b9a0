//! Lanes and single orbits agree to the last bit, early ends included.
use billiards::observe::{Density, EachOrbit, LaneObserver, VelocityPortrait, Watch};
use billiards::{
    Angle, BallLaw, Billiard, Canonical, Cell, Clock, Collision, Collisions, Conserved, Finished, Motion, Orbit,
    Planar, Rolling, Start, Starts, Stop, Time, Timed, Turned,
    laws::{Disk, PerPiece},
    run, run_side_by_side,
};

type Disks = Orbit<f64, 2, 1, Conserved<f64, 2>, Clock>;
type Ended = Finished<2, 1, Conserved<f64, 2>, Clock>;
use collision_laws::laws::{NoSlip, Restitution, Specular};
use core::ops::ControlFlow;
use geometry::{
    Lattice, Outline, Piece, Table, Vector2, WallHit, Walls,
    shapes::{Circle, FullLine},
    tables,
    walls::{Cuboid, Pieces, Slab, Sphere},
};
use lanes::{Lane, MOST_LANES, Mask};
use std::sync::{
    Arc,
    atomic::{AtomicUsize, Ordering},
};

fn starts(table: &Table, count: u64) -> Vec<Start<2, 1>> {
    // a multiplicative sequence of points and directions; points outside the table are skipped
    let mut seed = 0x9E37_79B9_7F4A_7C15_u64;
    let mut uniform = move || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut made = vec![];
    while (made.len() as u64) < count {
        let p = [4.0 * uniform() - 2.0, 4.0 * uniform() - 2.0];
        let (w, a) = (2.0 * uniform() - 1.0, 7.0 * uniform());
        if table.signed_distance(&p.into()) > 1e-3 {
            made.push(Start { position: p, velocity: [libm::cos(a), libm::sin(a)], spin: [w] });
        }
    }
    // and two that end early: into a corner or along the middle, and one that stays for ever
    made.push(Start { position: made[0].position, velocity: [1.0, 0.0], spin: [0.0] });
    made
}

fn agree<L: BallLaw<2, 1>>(name: &str, table: Result<Table, geometry::Error>, law: L) -> Vec<Ended> {
    let billiard = Planar { table: table.unwrap(), law };
    // more than there are seats, in strips too
    let starts = starts(&billiard.table, 150);
    let orbits: Vec<Disks> = starts.iter().map(|start| start.orbit(Clock::new(0.0))).collect();
    let ended = agree_from(name, &billiard, &orbits);
    // and when they go on
    agree_from(name, &billiard, &ended.iter().map(|ended| ended.orbit).collect::<Vec<_>>());
    ended
}

fn agree_from<L: BallLaw<2, 1>>(name: &str, billiard: &Planar<L>, orbits: &[Disks]) -> Vec<Ended> {
    let mut ended: Vec<Ended> = vec![];
    billiard.run_side_by_side(&mut orbits.iter().copied(), &Collisions(300), &mut (), &mut |f| ended.push(f));
    ended.sort_by_key(|f| f.index);
    assert_eq!(ended.len(), orbits.len(), "{name}");
    for (k, (orbit, lane)) in orbits.iter().zip(&ended).enumerate() {
        let mut orbit = *orbit;
        let outcome = billiard.run(&mut orbit, &Collisions(300), &mut ());
        assert_eq!(lane.index, k as u64);
        assert_eq!(lane.outcome, outcome, "{name} {k}");
        let bits = |p: [f64; 2], v: [f64; 2], s: [f64; 1], t: f64| [p[0], p[1], v[0], v[1], s[0], t].map(f64::to_bits);
        let one = bits(orbit.position, orbit.velocity, orbit.spin, orbit.track.time());
        let o = &lane.orbit;
        assert_eq!(bits(o.position, o.velocity, o.spin, o.track.time()), one, "{name} {k}");
    }
    ended
}

#[test]
fn orbits_on_a_circle_that_go_on_are_where_they_would_be_at_once() {
    let billiard = Planar { table: tables::circle(1.0).unwrap(), law: Disk::new(&NoSlip, libm::sqrt(0.5)).unwrap() };
    let at_once: Vec<Disks> = starts(&billiard.table, 20).iter().map(|start| start.orbit(Clock::new(0.0))).collect();
    let mut in_parts = at_once.clone();
    for _ in 0..1000 {
        let mut ended: Vec<Ended> = vec![];
        billiard.run_side_by_side(&mut in_parts.iter().copied(), &Collisions(20), &mut (), &mut |f| ended.push(f));
        ended.sort_by_key(|f| f.index);
        in_parts = ended.into_iter().map(|ended| ended.orbit).collect();
    }
    for (mut orbit, parts) in at_once.into_iter().zip(in_parts) {
        billiard.run(&mut orbit, &Collisions(20_000), &mut ());
        for i in 0..2 {
            let off = (orbit.position[i] - parts.position[i]).abs();
            // a thousand roundings of the place; of the velocity they would turn each chord, and add up to 10⁻¹⁰
            assert!(off < 1e-12, "{off:e}");
        }
    }
}

#[test]
fn lanes_have_the_bits_of_single_orbits() {
    let no_slip = || Disk::new(&NoSlip, libm::sqrt(0.5)).unwrap();
    agree("stadium", tables::stadium(1.0, 1.0), no_slip());
    agree("square", tables::square(1.0), no_slip());
    agree("hexagon", tables::hexagon(1.0), no_slip());
    agree("triangle", tables::equilateral(1.0), no_slip());
    agree("circle", tables::circle(1.0), no_slip());
    agree("strip", tables::strip(1.0), no_slip());
    let line = |x: f64, along: f64| FullLine::new(Vector2::new(x, 0.0), Vector2::new(2.0, 1.0) * along);
    let askew = Table::new(vec![Box::new(line(1.0, 1.0).unwrap()), Box::new(line(-1.0, -1.0).unwrap())]);
    agree("strip askew", askew, no_slip());
    agree("sinai", tables::sinai(1.0, 0.25), no_slip());
    agree("sinai torus", tables::sinai_torus(0.25, 1.0), no_slip());
    agree("mushroom", tables::mushroom(1.0, 0.5, 0.75), no_slip());
    agree("ellipse", tables::ellipse([2.0, 1.0]), no_slip());
    agree("moon", tables::moon(1.0, 0.75, 1.0), no_slip());
    agree("flower", tables::flower(4, 1.25, 2.0), no_slip());
    agree("pocket", tables::pocket([2.0, 1.0], 0.3125, 0.5625), no_slip());
    // asked in lanes side by side, and through a tree of boxes alone
    agree("many sides", tables::polygon(100, 1.0), no_slip());
    // a side of two pieces, alone and with something inside; a container that lies askew
    agree("a side in two", in_square([1.0, 0.0], 0.0, 0), no_slip());
    agree("a side in two about a disk", in_square([1.0, 0.0], 0.0, 1), no_slip());
    agree("a side in two about two disks", in_square([1.0, 0.0], 0.0, 2), no_slip());
    agree("a disk in a square askew", in_square([0.6, 0.8], 0.5, 1), no_slip());
    agree("two disks in a square askew", in_square([0.6, 0.8], 0.5, 2), no_slip());
}

#[test]
fn where_each_piece_has_a_law_of_its_own_each_lane_has_that_of_its_piece() {
    let gamma = libm::sqrt(0.5);
    let (rough, smooth) = (Disk::new(&NoSlip, gamma).unwrap(), Disk::new(&Specular, gamma).unwrap());
    let lossy = Disk::new(&Restitution::new(0.9, 0.5).unwrap(), gamma).unwrap();
    agree("stadium", tables::stadium(1.0, 1.0), PerPiece::new(rough, [smooth]));
    agree("square", tables::square(1.0), PerPiece::new(smooth, [rough, smooth, lossy]));
    agree("strip", tables::strip(1.0), PerPiece::new(smooth, [rough]));
    agree("mushroom", tables::mushroom(1.0, 0.5, 0.75), PerPiece::new(smooth, [smooth, rough, lossy, rough, smooth]));
}

/// The square (−1, 1)², turned, around some disks; in the lower side there is a vertex, `corner` below it.
fn in_square([c, s]: [f64; 2], corner: f64, disks: usize) -> Result<Table, geometry::Error> {
    let at = |x: f64, y: f64| Vector2::new(c * x - s * y, s * x + c * y);
    let mut square = Outline::from(at(-1.0, -1.0));
    for (x, y) in [(0.0, -1.0 - corner), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        square = square.line_to(at(x, y))?;
    }
    let mut pieces = square.close()?;
    for x in [-0.5, 0.5].into_iter().take(disks) {
        pieces.push(Box::new(Circle::new(at(x, 0.125), 0.25, false)?));
    }
    Table::new(pieces)
}

/// A disk table, as a user would write it for lanes.
struct Round {
    radius: f64,
}

impl Walls<2> for Round {
    fn first_hit<F: Lane>(&self, x: &[F; 2], v: &[F; 2]) -> WallHit<F, 2> {
        let dot = |a: &[F; 2], b: &[F; 2]| a[0] * b[0] + a[1] * b[1];
        let (a, b, c) = (dot(v, v), dot(x, v), dot(x, x) - self.radius * self.radius);
        let zero = a.same(0.0);
        let root = (b * b - a * c).max(zero).sqrt();
        let leaving = zero.lt(b);
        let time = leaving.select(-c, b.abs() + root).max(zero) / leaving.select(b + root, a);
        let p = [x[0] + time * v[0], x[1] + time * v[1]];
        let inverse = zero.same(1.0) / dot(&p, &p).sqrt();
        let point = p.map(|p| p * inverse * self.radius);
        let normal = p.map(|p| -p);
        let corner = zero.never();
        WallHit { time, point, normal, inverse, piece: zero, corner }
    }
}

/// The specular law, as a user would write it for lanes; the spin changes sides.
struct Mirror;

impl BallLaw<2, 1> for Mirror {
    fn collide<F: Lane>(&self, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; 1]) {
        let [n1, n2] = hit.unit_normal();
        let twice = (velocity[0] * n1 + velocity[1] * n2) * 2.0;
        *velocity = [velocity[0] - twice * n1, velocity[1] - twice * n2];
        spin[0] = -spin[0];
    }
}

/// What counts the lanes that it is asked in.
struct Lanes<'a>(&'a Round, &'a AtomicUsize);

impl Walls<2> for Lanes<'_> {
    fn first_hit<F: Lane>(&self, x: &[F; 2], v: &[F; 2]) -> WallHit<F, 2> {
        self.1.fetch_max(F::LANES, Ordering::Relaxed);
        self.0.first_hit(x, v)
    }
}

#[test]
fn walls_and_laws_of_your_own_run_in_two_vectors_of_as_many_lanes_as_there_are() {
    let lanes = AtomicUsize::new(0);
    let billiard = Billiard { walls: &Lanes(&Round { radius: 2.0 }, &lanes), law: &Mirror };
    let orbit = |k: u32| -> Disks {
        let (sin, cos) = libm::sincos(f64::from(k));
        Start { position: [0.5 * sin, 0.25], velocity: [cos, sin], spin: [0.5] }.orbit(Clock::new(0.0))
    };
    let mut ended: Vec<Ended> = vec![];
    run_side_by_side(&billiard, &mut (0..50).map(orbit), &Collisions(101), &mut (), &mut |f| ended.push(f));
    assert_eq!(lanes.load(Ordering::Relaxed), 2 * lanes::instruction_set().1);
    ended.sort_by_key(|f| f.index);
    for (k, f) in (0..50).zip(&ended) {
        let mut alone = orbit(k);
        let outcome = run(&billiard, &mut alone, &Collisions(101), &mut ());
        assert_eq!((f.outcome, f.orbit.spin), (outcome, [-0.5]));
        assert_eq!(f.orbit.position.map(f64::to_bits), alone.position.map(f64::to_bits), "{k}");
        assert_eq!(f.orbit.velocity.map(f64::to_bits), alone.velocity.map(f64::to_bits), "{k}");
        // the angular momentum of a specular orbit in a disk
        let moment = |o: &Disks| o.position[0] * o.velocity[1] - o.position[1] * o.velocity[0];
        assert!((moment(&alone) - moment(&orbit(k))).abs() < 1e-13);
    }
}

#[test]
fn orbits_that_end_early_leave_their_lane() {
    let ended = agree("wedge", tables::wedge(1.0), Disk::new(&Specular, 1.0).unwrap());
    assert!(ended.iter().all(|f| f.outcome.stop == Stop::Escaped)); // specular wedges are left after finitely many hits
}

#[test]
fn orbits_go_on_where_they_stopped_whatever_they_are_run_with() {
    let billiard =
        Planar { table: tables::stadium(1.0, 1.0).unwrap(), law: Disk::new(&NoSlip, libm::sqrt(0.5)).unwrap() };
    let starts = starts(&billiard.table, 70);
    // some have gone ahead on their own, by numbers of collisions that are no beats of the energy keeper
    let mut orbits: Vec<Disks> = starts.iter().map(|start| start.orbit(Clock::new(0.0))).collect();
    for (k, orbit) in orbits.iter_mut().enumerate() {
        billiard.run(orbit, &Collisions(k as u64 % 11), &mut ());
    }
    let mut ended: Vec<Ended> = vec![];
    billiard.run_side_by_side(&mut orbits.iter().copied(), &Collisions(100), &mut (), &mut |f| ended.push(f));
    assert_eq!(ended.len(), orbits.len());
    ended.sort_by_key(|f| f.index);
    for (f, start) in ended.iter().zip(&starts) {
        let mut alone: Disks = start.orbit(Clock::new(0.0));
        billiard.run(&mut alone, &Collisions(f.index % 11 + 100), &mut ());
        assert_eq!(f.orbit.position.map(f64::to_bits), alone.position.map(f64::to_bits), "{}", f.index);
        assert_eq!(f.orbit.velocity.map(f64::to_bits), alone.velocity.map(f64::to_bits), "{}", f.index);
    }
}

#[test]
fn a_first_orbit_without_a_future_holds_nobody_up() {
    let billiard = Planar { table: tables::wedge(1.0).unwrap(), law: Disk::new(&Specular, 1.0).unwrap() };
    let away: Disks = Start { position: [0.0, 2.0], velocity: [0.1, 1.0], spin: [0.0] }.orbit(Clock::new(0.0));
    let mut ended: Vec<Ended> = vec![];
    billiard.run_side_by_side(&mut core::iter::repeat_n(away, 5), &Collisions(100), &mut (), &mut |f| ended.push(f));
    assert_eq!(ended.iter().map(|f| f.outcome.stop).collect::<Vec<_>>(), [Stop::Escaped; 5]);
}

#[test]
fn under_laws_that_lose_energy_an_orbit_is_as_flat_as_it_leaves() {
    fn ends_alike(x: f64, velocity: [f64; 2], expected: (Stop, u64), billiard: &impl Motion<2, 1>) {
        let orbit = Orbit::<_, 2, 1, (), _>::new([x, 0.5], velocity, [0.0], Clock::new(0.0));
        let mut alone = orbit;
        let outcome = run(billiard, &mut alone, &Collisions(400), &mut ());
        assert_eq!((outcome.stop, outcome.collisions), expected);
        let mut ended = vec![];
        let orbits = &mut core::iter::repeat_n(orbit, 40);
        run_side_by_side(billiard, orbits, &Collisions(400), &mut (), &mut |f| ended.push(f));
        assert_eq!(ended.len(), 40);
        assert!(ended.iter().all(|f| f.outcome == outcome && f.orbit.position == alone.position));
    }
    // straight at a wall, slower and slower; and along it from the first collision on
    let ways = [((0.5, 0.0), [0.0, 1.0], (Stop::Finished, 400)), ((0.0, -1.0), [0.6, 0.8], (Stop::Grazing, 1))];
    let square = Cuboid::new([0.0; 2], [1.0; 2], [[0, 1], [2, 3]]).unwrap();
    let strip = Slab::<2, 1>::new(0.0, 1.0, [0, 1]).unwrap();
    let circle = Sphere::new(Vector2::zeros(), 1.0, 0).unwrap();
    for ((normal, tangential), velocity, expected) in ways {
        let law = &Disk::new(&Restitution::new(normal, tangential).unwrap(), 0.7).unwrap();
        ends_alike(0.5, velocity, expected, &Billiard { walls: &square, law });
        ends_alike(0.5, velocity, expected, &Rolling::new(&strip, law));
        ends_alike(0.0, velocity, expected, &Rolling::new(&circle, law));
    }
}

#[test]
fn between_straight_walls_speeds_whose_squares_are_no_numbers_are_as_good_as_others() {
    let billiard = Planar { table: tables::hexagon(1.0).unwrap(), law: Disk::new(&NoSlip, libm::sqrt(0.5)).unwrap() };
    let start = |unit: f64| Orbit::<_, 2, 1, (), ()>::new([0.1, 0.2], [0.6 * unit, 0.3 * unit], [0.4 * unit], ());
    let mut expected = start(1.0);
    billiard.run(&mut expected, &Collisions(500), &mut ());
    for exponent in [-700, 700] {
        let mut orbit = start(libm::ldexp(1.0, exponent));
        let outcome = billiard.run(&mut orbit, &Collisions(500), &mut ());
        assert_eq!((outcome.stop, outcome.collisions), (Stop::Finished, 500));
        assert_eq!(orbit.velocity, expected.velocity.map(|v| libm::ldexp(v, exponent)));
    }
}

#[test]
fn an_orbit_that_ends_between_beats_leaves_its_lane_to_another() {
    let square = Planar { table: tables::square(1.0).unwrap(), law: Disk::new(&Specular, 1.0).unwrap() };
    // after one collision in a corner
    let short = Start { position: [0.5, 0.5], velocity: [0.75, 0.25], spin: [0.0] };
    for at in [0, 1, 7, 40, 69] {
        let mut starts = starts(&square.table, 70);
        starts[at] = short;
        let mut ended: Vec<Ended> = vec![];
        let mut orbits = starts.iter().map(|start| start.orbit(Clock::new(0.0)));
        square.run_side_by_side(&mut orbits, &Collisions(300), &mut (), &mut |f| ended.push(f));
        assert_eq!(ended.len(), starts.len());
        for f in ended {
            let expected = if f.index == at as u64 { (Stop::Corner, 1) } else { (Stop::Finished, 300) };
            assert_eq!((f.outcome.stop, f.outcome.collisions), expected, "{}", f.index);
        }
    }
    // disks in the open plane, between which most orbits stay for a few collisions and some for many
    let disk = |x: f64, y: f64| Box::new(Circle::new([x, y].into(), 1.0, false).unwrap()) as Box<dyn Piece>;
    let table = Table::new(vec![disk(0.0, 0.0), disk(2.1, 0.0), disk(1.05, 1.8187)]).unwrap();
    let billiard = Planar { law: Disk::new(&Specular, 1.0).unwrap(), table };
    let canonical = Canonical::new(&billiard.table, 1.0, 3).unwrap();
    let mut ended: Vec<Ended> = vec![];
    let mut orbits = (0..2000).map(|i| canonical.start(i).orbit(Clock::new(0.0)));
    billiard.run_side_by_side(&mut orbits, &Collisions(18), &mut (), &mut |f| ended.push(f));
    ended.sort_by_key(|f| f.index);
    assert_eq!(ended.len(), 2000);
    for f in ended {
        let mut alone: Disks = canonical.start(f.index).orbit(Clock::new(0.0));
        let outcome = billiard.run(&mut alone, &Collisions(18), &mut ());
        assert_eq!((f.outcome, f.orbit.position), (outcome, alone.position), "{}", f.index);
    }
}

#[test]
fn orbits_without_a_last_collision_run_until_they_end() {
    let billiard = Planar { table: tables::wedge(1.0).unwrap(), law: Disk::new(&Specular, 1.0).unwrap() };
    let inwards = |k: u32| Start { position: [0.1, 1.0 + 0.01 * f64::from(k)], velocity: [0.3, -1.0], spin: [0.0] };
    for most in [u64::MAX, u64::MAX - 1, u64::MAX - 5] {
        let mut orbits = (0..70).map(|k| inwards(k).orbit(Clock::new(0.0)));
        let mut ended: Vec<Ended> = vec![];
        billiard.run_side_by_side(&mut orbits, &Collisions(most), &mut (), &mut |f| ended.push(f));
        assert_eq!(ended.len(), 70);
        assert!(ended.iter().all(|f| f.outcome.stop == Stop::Escaped && f.outcome.collisions > 0));
    }
}

/// Everything that happens to each orbit, bit by bit.
#[derive(Default)]
struct Diary {
    /// Number of the orbit, place, piece, velocity and spin.
    pages: Vec<(u64, [u64; 6])>,
}

impl LaneObserver<2, 1, Conserved<f64, 2>, Clock> for Diary {
    /// Who sits in each lane.
    type View<F: Lane> = [Option<u64>; MOST_LANES];

    fn nobody<F: Lane>(&self, _: F) -> [Option<u64>; MOST_LANES] {
        [None; MOST_LANES]
    }
    fn begin<F: Lane>(&mut self, view: &mut [Option<u64>; MOST_LANES], here: F::Mask, index: u64, _: &Disks) {
        let lane = (0..F::LANES).find(|&lane| here.at(lane)).unwrap();
        assert!((0..F::LANES).all(|other| here.at(other) == (other == lane)), "one orbit, one lane");
        view[lane] = Some(index);
    }
    fn end<F: Lane>(&mut self, view: &mut [Option<u64>; MOST_LANES], here: F::Mask) {
        (0..F::LANES).filter(|&lane| here.at(lane)).for_each(|lane| view[lane] = None);
    }
    fn collision<F: Lane>(
        &mut self,
        view: &mut [Option<u64>; MOST_LANES],
        hit: &WallHit<F, 2>,
        orbit: &Orbit<F, 2, 1, Conserved<F, 2>, Clock<F>>,
    ) {
        for lane in 0..F::LANES {
            if let Some(index) = view[lane] {
                let ([x, y], [v1, v2], [w]) = (orbit.position, orbit.velocity, orbit.spin);
                let numbers = [x, y, hit.piece, v1, v2, w];
                self.pages.push((index, numbers.map(|number| number.lane(lane).to_bits())));
            }
        }
    }
}

fn portrait(_: u64, _: &Disks) -> VelocityPortrait<Vec<[f64; 2]>> {
    VelocityPortrait::new(vec![])
}

/// All pieces of a table, asked in lanes: one kind of walls, whatever the table.
fn pieces(table: &Table) -> Pieces {
    Pieces::new(table.pieces().iter().cloned().enumerate().collect(), table.corners())
}

#[test]
fn an_observer_in_lanes_sees_all_collisions_of_all_orbits_in_order() {
    fn sees_all(table: &Table, billiard: &impl Motion<2, 1>) {
        let starts = starts(table, 70);
        let orbit = |start: &Start<2, 1>| -> Disks { start.orbit(Clock::new(0.0)) };
        let mut counts = VelocityPortrait::new(Density::disk(20));
        let mut all = ((Diary::default(), EachOrbit::new(portrait)), &mut counts);
        run_side_by_side(billiard, &mut starts.iter().map(orbit), &Collisions(50), &mut all, &mut |_| {});
        let ((mut diary, portraits), _) = all;
        diary.pages.sort_by_key(|page| page.0); // a stable sort
        let mut alone = vec![];
        let mut portrait = VelocityPortrait::new(vec![]);
        let mut counts_alone = VelocityPortrait::new(Density::disk(20));
        for (k, start) in starts.iter().enumerate() {
            let look = |c: &Collision<'_, 2, 1, Conserved<f64, 2>, Clock>| {
                let ([x, y], [v1, v2], [w]) = (c.orbit.position, c.orbit.velocity, c.orbit.spin);
                alone.push((k as u64, [x, y, c.hit.piece, v1, v2, w].map(f64::to_bits)));
                ControlFlow::Continue(())
            };
            run(
                billiard,
                &mut orbit(start),
                &Collisions(50),
                &mut (Watch::new(look), (&mut portrait, &mut counts_alone)),
            );
        }
        assert_eq!(counts.points().total(), diary.pages.len() as u64);
        assert_eq!(counts.points().counts(0), counts_alone.points().counts(0));
        assert_eq!(diary.pages.len(), alone.len());
        assert!(diary.pages == alone);
        assert!(portraits.merged().unwrap().points() == portrait.points(), "in the order of the starts");
    }
    let law = &Disk::new(&Specular, 1.0).unwrap();
    // where orbits finish, hit corners, graze, escape and stay for ever
    for table in [tables::stadium(1.0, 1.0), tables::square(1.0), tables::wedge(1.0), tables::mushroom(1.0, 0.5, 0.75)]
    {
        let table = table.unwrap();
        sees_all(&table, &Billiard { walls: &pieces(&table), law });
    }
    // in the frame of the wall
    let circle = Sphere::new(Vector2::zeros(), 1.0, 0).unwrap();
    sees_all(&tables::circle(1.0).unwrap(), &Rolling::new(&circle, law));
    let strip = Slab::<2, 1>::new(0.0, 1.0, [0, 1]).unwrap();
    sees_all(&tables::strip(1.0).unwrap(), &Rolling::new(&strip, law));
}

#[test]
fn what_is_seen_of_each_orbit_in_two_runs_is_merged_in_their_order() {
    let table = tables::stadium(1.0, 1.0).unwrap();
    let billiard = Billiard { walls: &pieces(&table), law: &Disk::new(&Specular, 1.0).unwrap() };
    let starts = starts(&table, 50);
    let orbit = |start: &Start<2, 1>| -> Disks { start.orbit(Clock::new(0.0)) };
    let seen = || (Diary::default(), EachOrbit::new(portrait));
    let (mut once, mut twice) = (seen(), seen());
    run_side_by_side(&billiard, &mut starts.iter().map(orbit), &Collisions(20), &mut once, &mut |_| {});
    for part in [&starts[..20], &starts[20..20], &starts[20..]] {
        run_side_by_side(&billiard, &mut part.iter().map(orbit), &Collisions(20), &mut twice, &mut |_| {});
    }
    let [once, twice] = [once, twice].map(|(_, seen)| seen.merged().unwrap());
    assert_eq!(once.points().len(), starts.len() * 20);
    assert!(once.points() == twice.points());
}

#[test]
fn each_orbit_is_asked_at_its_end_by_its_number_in_the_run() {
    let table = tables::mushroom(1.0, 0.5, 0.75).unwrap();
    let billiard = Billiard { walls: &pieces(&table), law: &Disk::new(&Specular, 1.0).unwrap() };
    let starts = starts(&table, 50);
    let orbit = |start: &Start<2, 1>| -> Disks { start.orbit(Clock::new(0.0)) };
    let mut asked =
        EachOrbit::asked(portrait, |index, seen: VelocityPortrait<Vec<_>>| vec![(index, seen.points().len() as u64)]);
    for part in [&starts[..20], &starts[20..]] {
        // up to a time: the orbits take unlike numbers of collisions, and end in another order than they began
        run_side_by_side(&billiard, &mut part.iter().map(orbit), &Time(30.0), &mut asked, &mut |_| {});
    }
    let asked = asked.merged().unwrap();
    let alone = starts.iter().map(|start| run(&billiard, &mut orbit(start), &Time(30.0), &mut ()).collisions);
    let numbers = (0..20).chain(0..starts.len() as u64 - 20);
    assert_eq!(asked, numbers.zip(alone).collect::<Vec<_>>());
    assert!(asked.iter().any(|(_, collisions)| *collisions != asked[0].1));
}

type Tracks = (Clock, (Angle, Cell));

#[test]
fn orbits_may_start_in_any_cell_of_a_lattice_and_are_followed_from_there() {
    let torus = |center: f64, second: [f64; 2]| {
        let disk = Circle::new(Vector2::new(center, center), 0.25, false).unwrap();
        let lattice = Lattice::new(&[Vector2::new(1.0, 0.0), second.into()]).unwrap();
        let table = Table::periodic(vec![Box::new(disk)], Some(lattice.clone())).unwrap();
        (Planar { table, law: Disk::new(&NoSlip, 0.7).unwrap() }, Arc::new(lattice))
    };
    // exact translations of places in the middle of a cell
    let places = [[0.0, 0.0], [0.0, 1.0], [7.0, -2.0]];
    let orbit = |place: [f64; 2], lattice: &Arc<Lattice>| -> Orbit<f64, 2, 1, Conserved<f64, 2>, Tracks> {
        let track = (Clock::new(0.0), (Angle::new(0.0), Cell::new(lattice.clone(), 0.0)));
        Orbit::new([place[0] - 0.375, place[1] + 0.375], [0.6, 0.8], [0.1], track)
    };
    let known = |o: &Orbit<f64, 2, 1, Conserved<f64, 2>, Tracks>, lattice: &Lattice, place: [f64; 2]| {
        let (time, (angle, cell)) = &o.track;
        let lifted = Vector2::from(o.position) + lattice.translation(cell.cell) - Vector2::from(place);
        (o.velocity, o.spin, time.time(), angle.angle(), lifted.map(|x| (x * 1e9).round()))
    };
    // about a disk in the middle of its cell paths are followed in the unit cell
    for center in [0.0, 0.5] {
        let from = |place: [f64; 2]| place.map(|x| x + center);
        let (upright, lattice) = torus(center, [0.0, 1.0]);
        assert_eq!(upright.table.cell().unwrap().is_unit_cell(), center == 0.5);
        let mut first = orbit(from([0.0; 2]), &lattice);
        upright.run(&mut first, &Collisions(30), &mut ());
        let first = known(&first, &lattice, from([0.0; 2]));
        for (billiard, lattice) in [torus(center, [0.0, 1.0]), torus(center, [20.0, 1.0])] {
            for place in places {
                let mut alone = orbit(from(place), &lattice);
                billiard.run(&mut alone, &Collisions(30), &mut ());
                assert_eq!(known(&alone, &lattice, from(place)), first, "{center} {place:?}");
            }
            let mut starts = places.iter().map(|place| orbit(from(*place), &lattice));
            billiard.run_side_by_side(&mut starts, &Collisions(30), &mut (), &mut |ended| {
                let place = places[usize::try_from(ended.index).unwrap()];
                assert_eq!(known(&ended.orbit, &lattice, from(place)), first, "{center} {place:?}");
            });
        }
    }
}

#[test]
fn every_track_grows_side_by_side_as_it_does_alone() {
    let table = tables::sinai_torus(0.25, 1.0).unwrap();
    let lattice = Arc::new(table.lattice().unwrap().clone());
    let billiard = Planar { table, law: Disk::new(&NoSlip, 0.7).unwrap() };
    let canonical = Canonical::new(&billiard.table, 1.0, 3).unwrap();
    let track = || (Clock::new(0.0), (Angle::new(0.5), Cell::new(lattice.clone(), 0.0)));
    let orbit = |i| -> Orbit<f64, 2, 1, Conserved<f64, 2>, Tracks> { canonical.start(i).orbit(track()) };
    let mut ended = vec![];
    billiard
        .run_side_by_side(&mut (0..40).map(orbit), &Collisions(100), &mut (), &mut |f| ended.push((f.index, f.orbit)));
    let mut far = 0.0_f64;
    for (index, together) in ended {
        let mut alone = orbit(index);
        billiard.run(&mut alone, &Collisions(100), &mut ());
        let tracked = |(time, (angle, cell)): &Tracks| [time.time(), angle.angle(), cell.cell[0], cell.cell[1]];
        assert_eq!(tracked(&together.track).map(f64::to_bits), tracked(&alone.track).map(f64::to_bits), "{index}");
        far = far.max(alone.track.1.1.cell[0].abs());
    }
    assert!(far > 3.0, "they leave the cell");
}
