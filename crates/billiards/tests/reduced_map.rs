//! The billiard map on the reduced phase space: it has an inverse, by time reversal, and keeps the canonical measure.
use billiards::{
    BallLaw, Canonical, Error, Orbit, Planar, ReducedState, Starts,
    laws::{Custom, Disk, Specular},
    reverse,
};
use collision_laws::{
    check::jacobian_determinant,
    laws::{NoSlip, Restitution},
};
use core::f64::consts::FRAC_1_SQRT_2;
use geometry::{Table, WallHit, tables};
use nalgebra::DVector;

fn tables() -> Vec<(&'static str, Table)> {
    [
        ("square", tables::square(1.0)),
        ("equilateral", tables::equilateral(1.0)),
        ("circle", tables::circle(1.0)),
        ("ellipse", tables::ellipse([2.0, 1.0])),
        ("stadium", tables::stadium(1.0, 1.0)),
        ("mushroom", tables::mushroom(1.0, 0.5, 0.75)),
        ("moon", tables::moon(1.0, 0.75, 1.0)),
        ("sinai", tables::sinai(1.0, 0.25)),
        ("sinai-torus", tables::sinai_torus(0.25, 1.0)),
        ("lorentz", tables::lorentz(0.4, 1.0)),
    ]
    .map(|(name, table)| (name, table.unwrap()))
    .into()
}

/// States drawn from the canonical measure at unit speed.
fn states(table: &Table, count: u64) -> Vec<ReducedState> {
    let canonical = Canonical::new(table, 1.0, 3).unwrap();
    let state = |i| {
        let start = canonical.start(i);
        let orbit = Orbit::<_, 2, 1>::new(start.position, start.velocity, start.spin, ());
        let (piece, landing) = table.closest(&orbit.position.into());
        let at = WallHit::never(orbit.position);
        ReducedState::after(table, &WallHit { piece: piece as f64, normal: landing.normal.into(), ..at }, &orbit)
    };
    (0..count).map(state).collect()
}

fn coordinates(state: &ReducedState) -> DVector<f64> {
    DVector::from_vec(vec![state.s, state.v0, state.vt])
}

fn moved(state: &ReducedState, x: &DVector<f64>) -> ReducedState {
    ReducedState { s: x[0], v0: x[1], vt: x[2], ..*state }
}

/// The distance of two states on one piece, arc length modulo the length of a closed curve.
fn distance(table: &Table, a: &ReducedState, b: &ReducedState) -> f64 {
    assert_eq!(a.piece, b.piece);
    let length = table.pieces()[a.piece].length();
    let s = (a.s - b.s).abs();
    s.min(length - s).max((a.v0 - b.v0).abs()).max((a.vt - b.vt).abs())
}

/// How much the inverse map stretches a small change at `state`; infinite where it is cut.
fn stretch<L: BallLaw<2, 1>>(billiard: &Planar<L>, state: &ReducedState, image: &ReducedState) -> f64 {
    let delta = libm::exp2(-26.0);
    let mut most = 1.0_f64;
    for i in 0..3 {
        for sign in [-1.0, 1.0] {
            let mut x = coordinates(state);
            x[i] += sign * delta;
            match billiard.inverse(&moved(state, &x)) {
                Ok(near) if near.piece == image.piece => {
                    most = most.max(distance(&billiard.table, &near, image) / delta);
                }
                _ => return f64::INFINITY,
            }
        }
    }
    most
}

fn inverts<L: BallLaw<2, 1>>(name: &str, billiard: &Planar<L>) {
    let states = states(&billiard.table, 300);
    let mut checked = 0;
    for state in &states {
        let next = billiard.map(state).unwrap();
        let back = billiard.inverse(&next).unwrap();
        let stretch = stretch(billiard, &next, state);
        if stretch > 1e6 {
            continue; // next to a corner or a grazing flight, where the map is cut
        }
        // some ten operations each way, and sizes up to that of the table
        let size = billiard.table.perimeter().max(1.0);
        let (error, bound) = (distance(&billiard.table, &back, state), 64.0 * f64::EPSILON * size * stretch);
        assert!(error <= bound, "{name}: {state:?} came back as {back:?}: {error:e} for {bound:e}");
        checked += 1;
    }
    assert!(checked * 10 >= states.len() * 9, "{name}: {checked}");
}

#[test]
fn time_reversal_inverts_the_billiard_map() {
    for (name, table) in tables() {
        inverts(name, &Planar { table: table.clone(), law: Specular });
        inverts(name, &Planar { table, law: Disk::new(&NoSlip, FRAC_1_SQRT_2).unwrap() });
    }
}

#[test]
fn time_reversal_is_an_involution() {
    let billiard =
        Planar { table: tables::stadium(1.0, 1.0).unwrap(), law: Disk::new(&NoSlip, FRAC_1_SQRT_2).unwrap() };
    for state in states(&billiard.table, 100) {
        let twice = billiard.reverse(&billiard.reverse(&state).unwrap()).unwrap();
        // vₙ = √(1 − v₀² − vₜ²) is lost near grazing, but v₀ and vₜ are not
        assert!(distance(&billiard.table, &twice, &state) < 16.0 * f64::EPSILON);
    }
}

/// Width of the differences of order 6: where the map varies on scales above 1/200, they leave (200/4096)⁶ ≈ 1e-8; rounding
/// leaves 1e-11.
const STEP: f64 = 1.0 / 4096.0;

/// `|det D(s, v₀, vₜ)| = 1` at every state where the map is smooth on the scale of the differences.
fn keeps_measure<L: BallLaw<2, 1>>(name: &str, billiard: &Planar<L>) {
    let mut checked = 0;
    for state in states(&billiard.table, 4000) {
        if checked == 60 {
            return;
        }
        let Ok(image) = billiard.map(&state) else { continue };
        // away from grazing, where vₙ is not smooth
        let steep = |s: &ReducedState| s.v0 * s.v0 + s.vt * s.vt < 0.84;
        let length = billiard.table.pieces()[state.piece].length();
        let inside = |s: f64, length: f64| s > 4.0 * STEP && s < length - 4.0 * STEP;
        if !(steep(&state) && steep(&image) && inside(state.s, length)) {
            continue;
        }
        // a long flight to a small disk varies on the scale of the inverse of its stretch
        let stretched = [0, 1, 2].iter().any(|&i| {
            let mut x = coordinates(&state);
            x[i] += STEP / 64.0;
            !billiard.map(&moved(&state, &x)).is_ok_and(|next| {
                next.piece == image.piece && distance(&billiard.table, &next, &image) < 12.0 * STEP / 64.0
            })
        });
        if stretched {
            continue;
        }
        let cut = core::cell::Cell::new(false);
        let closed = billiard.table.pieces()[image.piece].ends().is_none();
        let around = billiard.table.pieces()[image.piece].length();
        let map = |x: &DVector<f64>| match billiard.map(&moved(&state, x)) {
            Ok(next) if next.piece == image.piece => {
                let turns = if closed { libm::round((next.s - image.s) / around) * around } else { 0.0 };
                coordinates(&ReducedState { s: next.s - turns, ..next })
            }
            _ => {
                cut.set(true);
                coordinates(&image)
            }
        };
        let determinant = jacobian_determinant(map, &coordinates(&state), STEP).abs();
        if cut.get() {
            continue;
        }
        assert!((determinant - 1.0).abs() < 1e-7, "{name}: {determinant} at {state:?}");
        checked += 1;
    }
    assert!(checked >= 40, "{name}: only {checked} states");
}

#[test]
fn specular_and_no_slip_keep_the_canonical_measure_on_every_table() {
    for (name, table) in tables() {
        keeps_measure(name, &Planar { table: table.clone(), law: Specular });
        keeps_measure(name, &Planar { table, law: Disk::new(&NoSlip, FRAC_1_SQRT_2).unwrap() });
    }
}

#[test]
fn a_state_and_its_orbit_are_the_same_point() {
    for (name, table) in tables() {
        for state in states(&table, 100) {
            let orbit = state.orbit::<(), ()>(&table, ()).unwrap();
            let start = state.start(&table).unwrap();
            assert_eq!((start.position, start.velocity, start.spin), (orbit.position, orbit.velocity, orbit.spin));
            let landing = table.closest(&orbit.position.into()).1;
            let at = WallHit::never(orbit.position);
            let hit = WallHit { piece: state.piece as f64, normal: landing.normal.into(), ..at };
            let again = ReducedState::after(&table, &hit, &orbit);
            assert!(distance(&table, &again, &state) < 64.0 * f64::EPSILON * table.perimeter().max(1.0), "{name}");
        }
    }
}

#[test]
fn a_reversed_orbit_retraces_its_path() {
    use billiards::{Collision, Collisions, Conserved, observe::Watch};
    let billiard = Planar { table: tables::sinai(1.0, 0.25).unwrap(), law: Disk::new(&NoSlip, FRAC_1_SQRT_2).unwrap() };
    let mut orbit = Orbit::<_, 2, 1, Conserved<_, 2>>::new([0.1, 0.2], [0.6, 0.5], [-0.3], ());
    let (mut path, mut last) = (vec![], None::<WallHit<f64, 2>>);
    let mut watch = Watch::new(|c: &Collision<'_, 2, 1, _, _>| {
        path.push(c.orbit.position);
        last = Some(*c.hit);
        core::ops::ControlFlow::Continue(())
    });
    billiard.run(&mut orbit, &Collisions(8), &mut watch);
    reverse(&billiard.law, &mut orbit, &last.unwrap());
    let mut back = vec![];
    let mut watch = Watch::new(|c: &Collision<'_, 2, 1, _, _>| {
        back.push(c.orbit.position);
        core::ops::ControlFlow::Continue(())
    });
    billiard.run(&mut orbit, &Collisions(7), &mut watch);
    // a dispersing disk stretches changes less than tenfold per collision: 1e-16 · 10⁷
    for (there, back) in path.iter().rev().skip(1).zip(&back) {
        assert!((there[0] - back[0]).abs() + (there[1] - back[1]).abs() < 1e-9);
    }
}

#[test]
fn a_state_of_any_speed_is_a_start() {
    let table = tables::square(1.0).unwrap();
    let at = |power: i32| {
        let [v0, vt, speed] = [0.6, 0.3, 1.0].map(|x| libm::ldexp(x, power));
        let start = ReducedState { piece: 0, s: 0.5, v0, vt, speed }.start(&table).unwrap();
        start.velocity.map(|v| libm::ldexp(v, -power))
    };
    let expected = at(0);
    assert!(expected[1] > 0.7, "{expected:?}");
    for power in [-1000, -540, -500, 500, 515, 670, 1023] {
        assert_eq!(at(power), expected, "{power}");
    }
}

#[test]
fn impossible_states_are_refused() {
    let billiard = Planar { table: tables::square(1.0).unwrap(), law: Specular };
    let state = ReducedState { piece: 0, s: 0.5, v0: 0.8, vt: 0.6, speed: 1.0 };
    assert!(matches!(billiard.map(&state), Err(Error::Tangential { .. })));
    let nowhere = ReducedState { piece: 4, v0: 0.0, ..state };
    assert_eq!(billiard.map(&nowhere), Err(Error::Piece { piece: 4, pieces: 4 }));
    let said = |pieces| Error::Piece { piece: 4, pieces }.to_string();
    assert_eq!([4, 0].map(said), [4, 0].map(|n| format!("the table has no piece 4; it has {n}, counted from 0")));
    assert!(billiard.map(&ReducedState { speed: f64::NAN, ..state }).is_err());
    for s in [1.7, -0.1, f64::NAN, f64::INFINITY] {
        let beside = billiard.map(&ReducedState { s, v0: 0.0, ..state });
        assert!(matches!(beside, Err(Error::ArcLength { piece: 0, from: 0.0, to: 1.0, .. })), "{s}: {beside:?}");
        assert!(s == 1.7 || ReducedState::from_coordinates(&billiard.table, [s, 0.0, 0.0], 1.0).is_err());
    }
    assert!(matches!(
        ReducedState::from_coordinates(&billiard.table, [4.5, 0.0, 0.0], 1.0),
        Err(Error::ArcLength { piece: 3, s: 1.5, .. })
    ));
    // a boundary has an end where the curve that it ends with has none
    for table in [tables::circle(1.0).unwrap(), tables::ellipse([2.0, 1.0]).unwrap(), tables::sinai(1.0, 0.25).unwrap()]
    {
        let perimeter = table.perimeter();
        for (s, is_there) in
            [(-0.3, false), (0.0, true), (perimeter - 0.3, true), (perimeter, true), (perimeter + 0.3, false)]
        {
            let state = ReducedState::from_coordinates(&table, [s, 0.0, 0.0], 1.0);
            assert_eq!(state.is_ok(), is_there, "{s}: {state:?}");
            assert!(is_there || matches!(state, Err(Error::ArcLength { .. })), "{s}: {state:?}");
        }
    }
    let wedge = Planar { table: tables::wedge(1.0).unwrap(), law: Specular };
    let away = ReducedState { piece: 0, s: 1.0, v0: 0.0, vt: 0.9, speed: 1.0 };
    let ends = [wedge.map(&away), wedge.map(&ReducedState { vt: -0.9, ..away })];
    assert!(ends.contains(&Err(Error::Ended { stop: billiards::Stop::Escaped })), "{ends:?}");
    let walls: Vec<_> = (0..2)
        .map(|piece| [1.0, -1.0].map(|s| wedge.map(&ReducedState { piece, s, v0: 0.0, vt: 0.0, speed: 1.0 })))
        .collect();
    // one ray begins at the apex, the other ends there
    assert!(
        walls.iter().all(|[a, b]| matches!(
            (a, b),
            (Err(Error::ArcLength { .. }), Ok(_)) | (Ok(_), Err(Error::ArcLength { .. }))
        ))
    );
    assert!(walls[0][0].is_ok() != walls[1][0].is_ok(), "{walls:?}");
}

#[test]
fn arc_length_on_a_closed_curve_is_taken_modulo_its_length() {
    for table in [tables::circle(1.0).unwrap(), tables::ellipse([2.0, 1.0]).unwrap()] {
        let billiard = Planar { table, law: Specular };
        let state = ReducedState { piece: 0, s: 0.5, v0: 0.0, vt: 0.3, speed: 1.0 };
        let image = |turns: f64| {
            let s = state.s + turns * billiard.table.perimeter();
            billiard.map(&ReducedState { s, ..state }).unwrap().s
        };
        assert!([-1.0, 1.0, 3.0].iter().all(|turns| (image(*turns) - image(0.0)).abs() < 1e-12));
    }
}

#[test]
fn a_law_that_does_not_undo_itself_has_no_inverse() {
    let table = tables::stadium(1.0, 1.0).unwrap();
    let state = states(&table, 1)[0];
    let lossy = Disk::new(&Restitution::new(0.9, 0.5).unwrap(), FRAC_1_SQRT_2).unwrap();
    let billiard = Planar { table: table.clone(), law: lossy };
    let next = billiard.map(&state).unwrap();
    assert!(matches!(billiard.inverse(&next), Err(Error::Irreversible { defect }) if defect > 0.01));
    // one of which nothing is known beforehand has, if it does undo itself
    let billiard = Planar { table: table.clone(), law: Custom::disk(NoSlip, FRAC_1_SQRT_2).unwrap() };
    let back = billiard.inverse(&billiard.map(&state).unwrap()).unwrap();
    assert!(distance(&table, &back, &state) < 1e-12);
}
