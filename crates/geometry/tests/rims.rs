//! Rooms with open surfaces of triangles.
#![allow(clippy::unwrap_used, reason = "tests panic where they fail")]
use geometry::{
    Error,
    parry::{Room, Side, Solid, SolidSpec},
};

const RADII: [f64; 2] = [0.0, 0.125];

/// Polygons in fans of triangles, which share vertices that are equal.
fn mesh(polygons: &[&[[f64; 3]]]) -> SolidSpec {
    let (mut vertices, mut triangles) = (vec![], vec![]);
    for polygon in polygons {
        let first = vertices.len();
        vertices.extend(*polygon);
        triangles.extend((2..polygon.len()).map(|k| [first, first + k - 1, first + k]));
    }
    SolidSpec::TriMesh { vertices, triangles, margin: 0.0 }
}
/// The sides of a cube of edge 2, counter-clockwise from outside; the last one is the lid.
const CUBE: [[[f64; 3]; 4]; 6] = {
    const fn v(k: usize) -> [f64; 3] {
        [if k & 1 == 1 { 1.0 } else { -1.0 }, if k & 2 == 2 { 1.0 } else { -1.0 }, if k & 4 == 4 { 1.0 } else { -1.0 }]
    }
    [
        [v(0), v(2), v(3), v(1)],
        [v(0), v(1), v(5), v(4)],
        [v(2), v(6), v(7), v(3)],
        [v(0), v(4), v(6), v(2)],
        [v(1), v(3), v(7), v(5)],
        [v(4), v(5), v(7), v(6)],
    ]
};
/// A square across the third axis, seen from above, with half of this edge.
fn square(half: f64) -> [[f64; 3]; 4] {
    [[-half, -half, 0.0], [half, -half, 0.0], [half, half, 0.0], [-half, half, 0.0]]
}

/// The room for the centre of a particle between walls as drawn.
fn room(walls: &[(SolidSpec, Side)], radius: f64) -> Room {
    let solid = |(spec, side): &(SolidSpec, Side)| -> Solid {
        let spec = if radius == 0.0 { spec.clone() } else { spec.parallel(*side, radius).unwrap().0 };
        spec.solid([0.0; 3], *side).unwrap()
    };
    Room::new(walls.iter().map(solid).collect())
}
fn ball(radius: f64) -> SolidSpec {
    SolidSpec::Ball { radius }
}
fn cuboid(size: [f64; 3]) -> SolidSpec {
    SolidSpec::Cuboid { size, rounding: 0.0 }
}

/// Whether starts can be drawn, for a point and for a ball.
fn is_drawn(walls: &[(SolidSpec, Side)]) -> [bool; 2] {
    RADII.map(|radius| match room(walls, radius).surface() {
        Ok(_) => true,
        Err(Error::Rim { .. }) => false,
        Err(other) => panic!("{other}"),
    })
}

#[test]
fn where_orbits_come_round_the_rim_of_an_open_surface_no_starts_are_drawn() {
    let plate = mesh(&[&square(1.0)]);
    for radius in RADII {
        let walls = [(ball(2.0), Side::Inside), (plate.clone(), Side::Outside)];
        assert_eq!(room(&walls, radius).surface().unwrap_err(), Error::Rim { piece: 1 });
    }
    let [a, b, c, d, e, _] = &CUBE;
    let crate_ = mesh(&[a, b, c, d, e]);
    assert_eq!(is_drawn(&[(crate_, Side::Outside), (ball(3.0), Side::Inside)]), [false; 2]);
}

#[test]
fn the_mends_work_a_surface_up_to_the_walls_drawn_from_both_sides_or_with_a_thickness() {
    let within = |wall: SolidSpec| [(cuboid([2.0, 2.0, 3.0]), Side::Inside), (wall, Side::Outside)];
    let [a, b, c, d] = square(0.75);
    let [low, high] = [[0.0, 0.0, -0.5], [0.0, 0.0, 0.5]];
    let double = mesh(&[&square(0.75), &[d, c, b, a]]);
    let hull = SolidSpec::ConvexHull { points: vec![a, b, c, d, low, high], rounding: 0.0 };
    for wall in [mesh(&[&square(1.0)]), mesh(&[&square(1.5)]), double, hull] {
        assert_eq!(is_drawn(&within(wall)), [true; 2]);
    }
}

#[test]
fn a_gap_matters_to_what_passes_through_it() {
    let within = |half: f64| [(cuboid([2.0, 2.0, 3.0]), Side::Inside), (mesh(&[&square(half)]), Side::Outside)];
    assert_eq!(is_drawn(&within(0.9)), [false, true]);
    assert_eq!(is_drawn(&within(0.6)), [false, false]);
    // a crate that is narrower than the ball is wide
    let narrow = |width: f64| {
        let sides = CUBE.map(|side| side.map(|[x, y, z]| [x, 0.5 * width * y, z]));
        let [a, b, c, d, e, _] = &sides;
        [(ball(3.0), Side::Inside), (mesh(&[a, b, c, d, e]), Side::Outside)]
    };
    assert_eq!(is_drawn(&narrow(0.2)), [false, true]);
    assert_eq!(is_drawn(&narrow(0.3)), [false, false]);
}

#[test]
fn from_a_room_without_end_nothing_comes_back_round_a_rim() {
    let [a, b, c, d, e, _] = &CUBE;
    let crate_ = || (mesh(&[a, b, c, d, e]), Side::Outside);
    assert_eq!(is_drawn(&[crate_()]), [true; 2]);
    assert_eq!(is_drawn(&[crate_(), (ball(0.5), Side::Outside)]), [true; 2]);
}

#[test]
fn a_crack_is_no_rim() {
    // a vertex in the middle of an edge of one side only, in its place or rounded to single precision
    for off in [0.0, 5e-8] {
        let [a, b, c, d, [p, q, r, s], lid] = &CUBE;
        let middle = [1.0 + off, off, 1.0];
        for (side, within) in [(Side::Outside, Some((ball(3.0), Side::Inside))), (Side::Inside, None)] {
            let cracked = (mesh(&[a, b, c, d, &[*p, *q, *r, middle, *s], lid]), side);
            assert!(cracked.0.rims() > 0);
            let walls: Vec<_> = [cracked].into_iter().chain(within).collect();
            assert_eq!(is_drawn(&walls), [true; 2], "{off}");
        }
    }
    // a square drawn from both sides with one more vertex on the back
    let [a, b, c, d] = square(1.0);
    let double = mesh(&[&[a, b, c, d], &[[0.0, -1.0, 0.0], a, d, c, b]]);
    assert!(double.rims() > 0);
    assert_eq!(is_drawn(&[(ball(2.0), Side::Inside), (double, Side::Outside)]), [true; 2]);
}
