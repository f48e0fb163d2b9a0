//! A surface of triangles in space as lines on a page: where it turns away, where it ends, and where it bends.

use std::collections::HashMap;

use billiards::geometry::Vector3;
use billiards::geometry::edges::{chains, merged, sides};

use super::scale::to_unity;

/// Up to this many triangles are shown individually; of more, one sees the shape and not the triangles.
const FEW: usize = 1000;
/// Cosines of the angles between two triangles above which the edge between them is drawn: 1° for few triangles, 30° for many.
const BENT: [f64; 2] = [0.999_847_695_156_391_2, 0.866_025_403_784_438_6];

/// The visible part of a surface of triangles.
#[derive(Clone, Debug, Default)]
pub(super) struct Seen {
    /// Closed chains between which the surface is seen: those of all triangles that face the eye and, where the surface is open,
    /// those of the others.
    pub(super) areas: Vec<Vec<Vec<Vector3<f64>>>>,
    /// Its lines, as chains.
    pub(super) lines: Vec<Vec<Vector3<f64>>>,
}

/// The visible part of triangles seen from far away; `towards` points to the eye.
pub(super) fn seen(vertices: &[[f64; 3]], triangles: &[[usize; 3]], towards: &Vector3<f64>) -> Seen {
    let number = merged(vertices.iter().copied());
    let points: Vec<Vector3<f64>> = vertices.iter().map(|vertex| Vector3::from(*vertex)).collect();
    let known = triangles.iter().filter(|t| t.iter().all(|v| *v < number.len())).map(|t| t.map(|v| number[v]));
    // a triangle without an area has no side; of one of any size the fourth powers of lengths are within range in a unit of its own
    let normal = |t: &[usize; 3]| {
        let [a, b] = [1, 2].map(|k| points[t[k]] - points[t[0]]);
        let unit = to_unity(a.iter().chain(&b).copied());
        (a * unit).cross(&(b * unit)).try_normalize(0.0)
    };
    let faces: Vec<([usize; 3], Vector3<f64>)> = known.filter_map(|t| Some((t, normal(&t)?))).collect();
    let owner: HashMap<[usize; 2], usize> =
        faces.iter().enumerate().flat_map(|(k, face)| sides(face.0).map(|side| (side, k))).collect();
    let faces_eye = |k: usize| faces[k].1.dot(towards) > 0.0;
    let bent = BENT[usize::from(faces.len() > FEW)];
    let (mut lines, mut borders, mut is_open) = (vec![], [vec![], vec![]], false);
    for (k, face) in faces.iter().enumerate() {
        for [a, b] in sides(face.0) {
            let beyond = owner.get(&[b, a]).copied();
            is_open |= beyond.is_none();
            let is_border = beyond.is_none_or(|beyond| faces_eye(beyond) != faces_eye(k));
            if is_border {
                borders[usize::from(!faces_eye(k))].push([a, b]);
            }
            // for an edge between two triangles one side is enough: that of the triangle that faces the eye, so that the chains
            // go round it
            let is_drawn = match beyond {
                None => true,
                Some(_) if is_border => faces_eye(k),
                Some(beyond) => a < b && faces[beyond].1.dot(&face.1) < bent,
            };
            if is_drawn {
                lines.push([a, b]);
            }
        }
    }
    let drawn = |edges: &[[usize; 2]]| -> Vec<Vec<Vector3<f64>>> {
        chains(edges).iter().map(|chain| chain.iter().map(|point| points[*point]).collect()).collect()
    };
    let areas = borders.iter().take(if is_open { 2 } else { 1 }).filter(|border| !border.is_empty());
    Seen { areas: areas.map(|border| drawn(border)).collect(), lines: drawn(&lines) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const UP: Vector3<f64> = Vector3::new(0.0, 0.0, 1.0);

    /// A ball of `rings` rings of triangles.
    fn ball(rings: usize) -> (Vec<[f64; 3]>, Vec<[usize; 3]>) {
        let around = 2 * rings;
        let at = |i: usize, j: usize| {
            let (s, c) = libm::sincos(core::f64::consts::PI * i as f64 / rings as f64);
            let (t, d) = libm::sincos(core::f64::consts::TAU * j as f64 / around as f64);
            if i == 0 || i == rings { [0.0, 0.0, c] } else { [s * d, s * t, c] }
        };
        let vertices = (0..=rings).flat_map(|i| (0..around).map(move |j| at(i, j))).collect();
        let number = |i: usize, j: usize| i * around + j % around;
        let cell = |i: usize, j: usize| {
            let [a, b, c, d] = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)];
            [[a, b, c], [a, c, d]]
        };
        (vertices, (0..rings).flat_map(|i| (0..around).flat_map(move |j| cell(i, j))).collect())
    }

    fn area(chains: &[Vec<Vector3<f64>>]) -> f64 {
        chains.iter().flat_map(|chain| chain.windows(2)).map(|w| 0.5 * (w[0].x * w[1].y - w[0].y * w[1].x)).sum()
    }

    #[test]
    fn of_very_many_triangles_the_outline_is_drawn_and_the_inside_is_filled() {
        let (vertices, triangles) = ball(60);
        let seen = seen(&vertices, &triangles, &UP);
        let edges: usize = seen.lines.iter().map(|line| line.len() - 1).sum();
        assert!((100..400).contains(&edges), "{edges} edges of {} triangles", triangles.len());
        assert_eq!(seen.areas.len(), 1);
        assert!((area(&seen.areas[0]) - core::f64::consts::PI).abs() < 0.01, "{}", area(&seen.areas[0]));
    }

    #[test]
    fn triangles_of_any_size_are_seen() {
        let (vertices, triangles) = ball(4);
        let one = seen(&vertices, &triangles, &UP);
        for exponent in [-480, -250, 250, 480] {
            let unit = libm::ldexp(1.0, exponent);
            let scaled: Vec<[f64; 3]> = vertices.iter().map(|p| p.map(|x| x * unit)).collect();
            let seen = seen(&scaled, &triangles, &UP);
            let times = |chains: &[Vec<Vector3<f64>>]| -> Vec<Vec<_>> {
                chains.iter().map(|chain| chain.iter().map(|p| p * unit).collect()).collect()
            };
            assert_eq!(seen.lines, times(&one.lines), "2^{exponent}");
            assert_eq!(seen.areas, one.areas.iter().map(|area| times(area)).collect::<Vec<_>>(), "2^{exponent}");
        }
    }

    #[test]
    fn of_few_triangles_all_edges_that_bend_are_drawn() {
        let vertices = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.5, 0.5, 1.0]];
        // a pyramid with a floor of two triangles
        let triangles = [[0, 2, 1], [0, 3, 2], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
        let closed = seen(&vertices, &triangles, &UP);
        assert_eq!(closed.lines.iter().map(|line| line.len() - 1).sum::<usize>(), 8);
        assert_eq!((closed.areas.len(), area(&closed.areas[0])), (1, 1.0));
        // without the floor one sees into it from below
        let open = seen(&vertices, &triangles[2..], &-UP);
        assert_eq!(open.lines.iter().map(|line| line.len() - 1).sum::<usize>(), 8);
        assert_eq!((open.areas.len(), area(&open.areas[0])), (1, 1.0));
    }
}
