//! Points drawn where the centre of a ball lies that touches a mesh: uniform by area on planes, cylinders and spheres.
#![allow(clippy::unwrap_used, reason = "tests panic where they fail")]
mod random;

use core::f64::consts::FRAC_PI_2;
use geometry::{
    Surface, Vector3,
    parry::{Room, Side, SolidSpec},
};
use random::Random;
use std::collections::BTreeMap;

/// A box with these half sizes about the origin, counter-clockwise from outside; one of no height is a wall without thickness. The
/// diagonals of opposite sides cross.
fn cuboid(half: [f64; 3]) -> (Vec<[f64; 3]>, Vec<[usize; 3]>) {
    let vertices = (0..8).map(|k| [0, 1, 2].map(|i| if k >> i & 1 == 1 { half[i] } else { -half[i] })).collect();
    let sides = [[4, 5, 7, 6], [0, 2, 3, 1], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    (vertices, sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect())
}

/// Random positions of the centre of a ball of this radius that touches a mesh on one side.
fn drawn((vertices, triangles): (Vec<[f64; 3]>, Vec<[usize; 3]>), side: Side, radius: f64) -> Vec<Vector3<f64>> {
    let mesh = SolidSpec::TriMesh { vertices, triangles, margin: radius };
    let room = Room::new(vec![mesh.solid([0.0; 3], side).unwrap()]);
    let (surface, mut random) = (room.surface().unwrap(), Random(23));
    (0..40_000).map(|_| surface.random_point(&mut || random.unit()).0).collect()
}

/// Asserts that numbers are those expected for the shares of areas, by chi-square: six standard deviations above its mean are the limit.
fn are_shared_by_area(cells: &[(f64, f64)], scene: &str) {
    let all: f64 = cells.iter().map(|(area, _)| area).sum();
    let number: f64 = cells.iter().map(|(_, count)| count).sum();
    let square = |(area, count): &(f64, f64)| {
        let expected = number * area / all;
        assert!(expected > 5.0, "{scene}: {expected}");
        (count - expected) * (count - expected) / expected
    };
    let (found, free) = (cells.iter().map(square).sum::<f64>(), cells.len() as f64 - 1.0);
    assert!(found < free + 6.0 * libm::sqrt(2.0 * free), "{scene}: chi-square {found} of {free}, {cells:?}");
}

/// In how many parts faces and edges are cut along each axis.
const PARTS: usize = 4;

/// Where a point lies along an axis of a box.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Along {
    Part(usize),
    BeyondLow,
    BeyondHigh,
}

/// A part of the surface around a box: where it lies along each axis, and whether it lies farther beyond the box along the first axis
/// than along the next, of those along which it lies beyond.
type Place = ([Along; 3], bool);

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small and not negative")]
fn place(point: &Vector3<f64>, half: [f64; 3]) -> Place {
    let along = [0, 1, 2].map(|i| match point[i] / half[i] {
        share if share <= -1.0 => Along::BeyondLow,
        share if share >= 1.0 => Along::BeyondHigh,
        share => Along::Part((0.5 * (share + 1.0) * PARTS as f64) as usize),
    });
    let mut beyond = (0..3).filter(|i| !matches!(along[*i], Along::Part(_))).map(|i| point[i].abs() - half[i]);
    let farther = matches!([beyond.next(), beyond.next()], [Some(first), Some(next)] if first > next);
    (along, farther)
}

/// All parts of the surface around a box, with their areas.
fn places(half: [f64; 3], radius: f64) -> BTreeMap<Place, f64> {
    let ways = half.map(|half| {
        let parts = (0..if half > 0.0 { PARTS } else { 0 }).map(Along::Part);
        parts.chain([Along::BeyondLow, Along::BeyondHigh]).collect::<Vec<_>>()
    });
    let mut places = BTreeMap::new();
    for along in ways[0].iter().flat_map(|x| ways[1].iter().flat_map(|y| ways[2].iter().map(|z| [*x, *y, *z]))) {
        let inside = (0..3).filter(|i| matches!(along[*i], Along::Part(_)));
        let (count, length) = inside.fold((0, 1.0), |(n, l), i| (n + 1, l * 2.0 * half[i] / PARTS as f64));
        // rectangles, and halves of quarters of cylinders and of eighths of spheres
        let (area, farther): (f64, &[bool]) = match count {
            0 => (FRAC_PI_2 * radius * radius / 2.0, &[false, true]),
            1 => (length * FRAC_PI_2 * radius / 2.0, &[false, true]),
            2 => (length, &[false]),
            _ => continue,
        };
        places.extend(farther.iter().map(|farther| ((along, *farther), area)));
    }
    places
}

/// Asserts that points are uniform on the part of the surface around a box that lies there along the third axis.
fn are_uniform(points: &[Vector3<f64>], half: [f64; 3], radius: f64, is_there: impl Fn(Along) -> bool, scene: &str) {
    let all = places(half, radius).into_iter().filter(|((along, _), _)| is_there(along[2]));
    let mut cells: BTreeMap<Place, (f64, f64)> = all.map(|(place, area)| (place, (area, 0.0))).collect();
    for point in points {
        let place = place(point, half);
        cells.get_mut(&place).unwrap_or_else(|| panic!("{scene}: {point:?} in {place:?}")).1 += 1.0;
    }
    are_shared_by_area(&cells.into_values().collect::<Vec<_>>(), scene);
}

#[test]
fn around_a_box_faces_edges_and_corners_are_drawn_by_their_areas() {
    for (half, radius) in [([1.0; 3], 0.5), ([1.0, 0.5, 0.25], 2.0), ([2.0, 0.125, 0.125], 0.25)] {
        are_uniform(&drawn(cuboid(half), Side::Outside, radius), half, radius, |_| true, &format!("{half:?}"));
    }
}

#[test]
fn around_a_wall_without_thickness_both_faces_and_the_rim_are_drawn_by_their_areas() {
    let half = [1.0, 1.0, 0.0];
    // the back has the other diagonal, or a vertex in its middle
    let corners = vec![[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0], [0.0; 3]];
    let backs = [vec![[3, 2, 1], [3, 1, 0]], vec![[1, 0, 4], [2, 1, 4], [3, 2, 4], [0, 3, 4]]];
    for back in backs {
        for back_first in [false, true] {
            let mut triangles = vec![[0, 1, 2], [0, 2, 3]];
            triangles.extend(&back);
            triangles.rotate_left(if back_first { 2 } else { 0 });
            for radius in [0.125, 0.5, 2.0] {
                let points = drawn((corners.clone(), triangles.clone()), Side::Outside, radius);
                are_uniform(&points, half, radius, |_| true, &format!("{triangles:?} {radius}"));
            }
        }
    }
}

#[test]
fn of_an_open_mesh_the_front_is_drawn_by_its_areas() {
    let corners = vec![[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]];
    let points = drawn((corners, vec![[0, 1, 2], [0, 2, 3]]), Side::Outside, 0.5);
    are_uniform(&points, [1.0, 1.0, 0.0], 0.5, |along| along == Along::BeyondHigh, "open");
}

#[test]
fn in_a_box_the_faces_are_drawn_as_far_as_the_ball_reaches() {
    let half = [1.0, 0.75, 0.5];
    let points = drawn(cuboid(half), Side::Inside, 0.25);
    let mut cells = vec![];
    for axis in 0..3 {
        let [i, j] = [(axis + 1) % 3, (axis + 2) % 3];
        let [a, b] = [i, j].map(|k| half[k] - 0.25);
        for end in [-1.0, 1.0] {
            let at = end * (half[axis] - 0.25);
            for signs in [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]] {
                let is_there = |p: &&Vector3<f64>| {
                    (p[axis] - at).abs() < 1e-14
                        && p[i] * signs[0] > 0.0
                        && p[j] * signs[1] > 0.0
                        && p[i].abs() < a
                        && p[j].abs() < b
                };
                cells.push((a * b, points.iter().filter(is_there).count() as f64));
            }
        }
    }
    assert!((cells.iter().map(|(_, count)| count).sum::<f64>() - points.len() as f64).abs() < 0.5);
    are_shared_by_area(&cells, "inside");
}

#[test]
fn around_an_edge_bent_inwards_what_the_ball_cannot_reach_is_not_drawn() {
    // a square prism of height 1 without a quarter
    let around = [[-1.0, -1.0], [1.0, -1.0], [1.0, 0.0], [0.0, 0.0], [0.0, 1.0], [-1.0, 1.0]];
    let vertices = [-0.5, 0.5].iter().flat_map(|z| around.map(|[x, y]| [x, y, *z])).collect();
    let mut triangles: Vec<[usize; 3]> = (0..6).map(|k| [k, (k + 1) % 6, (k + 1) % 6 + 6]).collect();
    triangles.extend((0..6).map(|k| [k, (k + 1) % 6 + 6, k + 6]));
    for [a, b, c] in [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]] {
        triangles.extend([[a, c, b], [a + 6, b + 6, c + 6]]);
    }
    let radius = 0.25;
    let mut counts = [0.0; 3];
    for point in drawn((vertices, triangles), Side::Outside, radius) {
        let foot = |[low, high]: [[f64; 3]; 2]| Vector3::from_fn(|i, _| point[i].clamp(low[i], high[i]));
        let feet = [[[-1.0, -1.0, -0.5], [1.0, 0.0, 0.5]], [[-1.0, -1.0, -0.5], [0.0, 1.0, 0.5]]].map(foot);
        let away = feet.map(|foot| point - foot);
        let away = if away[0].norm() < away[1].norm() { away[0] } else { away[1] };
        assert!((away.norm() - radius).abs() < 1e-14, "{point:?}");
        counts[away.iter().filter(|x| x.abs() > 1e-12).count() - 1] += 1.0;
    }
    // above an edge that ends at the inner edge, the surface ends where it meets its neighbour: along a curve
    let faces = 2.0 * 3.0 + 6.0 + 2.0 * (1.0 - radius);
    let edges = FRAC_PI_2 * radius * (5.0 + 2.0 * 8.0) - 4.0 * radius * radius;
    let corners = 10.0 * FRAC_PI_2 * radius * radius;
    are_shared_by_area(&[(faces, counts[0]), (edges, counts[1]), (corners, counts[2])], "bent inwards");
}
