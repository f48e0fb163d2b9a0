//! No length and no speed is special: scaled scenes have the same bits, moved and turned ones the same orbits.
use billiards::collision_laws::laws::{NoSlip, Specular};
use billiards::geometry::{
    Error, Figure, Piece, Table, Vector2, Walls, WithWalls,
    shapes::{Arc, Circle, FullLine, Ray, Segment},
    tables,
};
use billiards::laws::{Disk, RoughBall};
use billiards::{
    Billiard, Clock, Collisions, Conserved, Horizon, Orbit, Outcome, Planar, Spatial, Start, Starts, Timed,
};
use billiards::{Canonical, CanonicalSpatial};

const GAMMA: f64 = core::f64::consts::FRAC_1_SQRT_2;

fn laws() -> [Disk; 2] {
    [Disk::new(&NoSlip, GAMMA).unwrap(), Disk::new(&Specular, GAMMA).unwrap()]
}

/// The place, velocity, spin and time after so many collisions, and how the run ended.
fn play(table: &Table, law: Disk, start: &Start<2, 1>, collisions: u64) -> (Start<2, 1>, f64, Outcome) {
    let planar = Planar { table: table.clone(), law };
    let mut orbit: Orbit<f64, 2, 1, Conserved<f64, 2>, Clock> =
        Orbit::new(start.position, start.velocity, start.spin, Clock::new(0.0));
    let outcome = planar.run(&mut orbit, &Collisions(collisions), &mut ());
    (Start { position: orbit.position, velocity: orbit.velocity, spin: orbit.spin }, orbit.track.time(), outcome)
}

/// Powers of two by which lengths and speeds are multiplied: near one, and as large as squares of squares allow.
const SCALES: [(i32, i32); 4] = [(3, 0), (-7, 2), (150, -40), (-150, 90)];

#[test]
fn every_planar_table_scaled_by_a_power_of_two_gives_the_same_bits() {
    for entry in tables::all().iter().filter(|entry| entry.dimension() == 2) {
        let values = entry.typical();
        let table = entry.planar(&values).unwrap();
        // inside every table, in different directions; infinite tables have no canonical measure
        let starts: Vec<Start<2, 1>> = match Canonical::new(&table, 1.0, 7) {
            Ok(canonical) => (0..5).map(|i| canonical.start(i)).collect(),
            Err(_) => [[0.3, -0.8], [-0.6, -0.5], [0.9, 0.7]]
                .map(|velocity| Start { position: [0.03, 0.5], velocity, spin: [0.25] })
                .to_vec(),
        };
        for (length, speed) in SCALES.map(|(l, s)| (libm::ldexp(1.0, l), libm::ldexp(1.0, s))) {
            let large = entry.planar(&entry.scaled(&values, length)).unwrap();
            for (law, start) in laws().into_iter().flat_map(|law| starts.iter().map(move |start| (law, start))) {
                let (at, time, outcome) = play(&table, law, start, 60);
                let scaled = |m: &Start<2, 1>| Start {
                    position: m.position.map(|x| x * length),
                    velocity: m.velocity.map(|v| v * speed),
                    spin: m.spin.map(|w| w * speed),
                };
                let (there, later, same) = play(&large, law, &scaled(start), 60);
                assert_eq!(there, scaled(&at), "{} times {length:e}", entry.name);
                assert_eq!((later, same), (time * length / speed, outcome), "{} times {length:e}", entry.name);
            }
        }
    }
}

#[test]
fn every_table_in_space_scaled_by_a_power_of_two_gives_the_same_bits() {
    let law = RoughBall::no_slip(0.4_f64.sqrt()).unwrap();
    for entry in tables::all().iter().filter(|entry| entry.dimension() == 3) {
        let values = entry.typical();
        let table = entry.spatial(&values).unwrap();
        let canonical = CanonicalSpatial::new(&table, 1.0, 7).unwrap();
        for (length, speed) in SCALES.map(|(l, s)| (libm::ldexp(1.0, l), libm::ldexp(1.0, s))) {
            let large = entry.spatial(&entry.scaled(&values, length)).unwrap();
            for start in (0..5).map(|i| canonical.start(i)) {
                let run = |table: &tables::SpatialTable, [length, speed]: [f64; 2]| {
                    let spatial = Spatial { table: table.clone(), law };
                    let [v, w] = [start.velocity, start.spin].map(|a| a.map(|x| x * speed));
                    let x = start.position.map(|x| x * length);
                    let mut orbit: Orbit<f64, 3, 3, Conserved<f64, 3>> = Orbit::new(x, v, w, ());
                    spatial.run(&mut orbit, &Collisions(60), &mut ());
                    (orbit.position.map(|x| x / length), orbit.velocity.map(|v| v / speed))
                };
                assert_eq!(run(&table, [1.0; 2]), run(&large, [length, speed]), "{} times {length:e}", entry.name);
            }
        }
    }
}

/// Turned by the angle of the triangle 3, 4, 5, and moved.
fn moved(p: &Vector2<f64>) -> Vector2<f64> {
    turned(p) + Vector2::new(3.0, -2.0)
}
fn turned(p: &Vector2<f64>) -> Vector2<f64> {
    Vector2::new(0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y)
}

fn moved_piece(figure: &Figure) -> Result<Box<dyn Piece>, Error> {
    Ok(match figure {
        Figure::Segment { ends: [a, b] } => Box::new(Segment::new(moved(a), moved(b))?),
        Figure::Ray { from, direction, left } => Box::new(Ray::new(moved(from), turned(direction), *left)?),
        Figure::Line { through, direction } => Box::new(FullLine::new(moved(through), turned(direction))?),
        Figure::Arc { center, radius, ends: [a, b], inside } => {
            Box::new(Arc::with_radius(moved(center), *radius, moved(a), moved(b), *inside)?)
        }
        Figure::Circle { center, radius, inside } => Box::new(Circle::new(moved(center), *radius, *inside)?),
        Figure::Other => return Err(Error::Empty),
    })
}

struct Look<'a>(&'a Table, Disk, Start<2, 1>, u64);

impl WithWalls<2> for Look<'_> {
    type Output = Horizon;
    fn run<W: Walls<2>>(self, walls: &W) -> Horizon {
        let billiard = Billiard { walls, law: &self.1 };
        Horizon::of(&billiard, self.0, self.2, 1.0, [self.3 as f64, f64::INFINITY])
    }
}

#[test]
fn moved_and_turned_tables_have_the_same_orbits_within_their_horizon() {
    for name in ["circle", "square", "equilateral", "hexagon", "stadium", "mushroom", "sinai", "moon", "flower"] {
        let table = tables::find(name).unwrap().planar(&tables::Values::new()).unwrap();
        let pieces = table.pieces().iter().map(|piece| moved_piece(&piece.figure())).collect::<Result<_, _>>().unwrap();
        let other = Table::new(pieces).unwrap();
        let canonical = Canonical::new(&table, 1.0, 3).unwrap();
        let mut compared = 0;
        for start in (0..20).map(|i| canonical.start(i)) {
            // from the middle of the first flight: a start on a wall might be moved out of it
            let (first, ..) = play(&table, laws()[0], &start, 1);
            let middle = [0, 1].map(|i| 0.5 * (start.position[i] + first.position[i]));
            let start = Start { position: middle, ..start };
            let [x, v] = [start.position, start.velocity].map(Vector2::from);
            let there = Start { position: moved(&x).into(), velocity: turned(&v).into(), ..start };
            for law in laws() {
                let horizon = other.with_walls(Look(&other, law, there, 20));
                if horizon.collisions < 20 {
                    continue; // lost, or in a corner
                }
                let [(at, ..), (far, ..)] = [play(&table, law, &start, 20), play(&other, law, &there, 20)];
                let off = moved(&Vector2::from(at.position)) - Vector2::from(far.position);
                // a bound to first order for each of the two, and for the rounding of the table's vertices
                assert!(off.norm() <= 4.0 * horizon.error, "{name}: off by {:e}, {horizon:?}", off.norm());
                compared += 1;
            }
        }
        assert!(compared >= 10, "{name}: {compared}");
    }
}
