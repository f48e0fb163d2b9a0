//! Why triangles do not form a two-sided surface.
use super::sides;
use crate::Error;
use std::collections::{HashMap, HashSet};

/// The error where two triangles run along one edge in the same direction, of which `number` is the latter; `numbers`
/// are the given numbers of all triangles.
pub(super) fn problem(triangles: &[[usize; 3]], number: usize, numbers: &[usize]) -> Error {
    let named = |k: usize, problem| Error::Triangle { triangle: numbers[k], problem };
    let mut found = HashSet::new();
    let least_first = |t: &[usize; 3]| {
        let first = (0..3).fold(0, |best, i| if t[i] < t[best] { i } else { best });
        [0, 1, 2].map(|i| t[(first + i) % 3])
    };
    if let Some(k) = triangles.iter().position(|t| !found.insert(least_first(t))) {
        return named(k, "occurs twice: remove one of the two");
    }
    let mut on_edge: HashMap<[usize; 2], Vec<usize>> = HashMap::new();
    for (k, t) in triangles.iter().enumerate() {
        for [a, b] in sides(t) {
            on_edge.entry([a.min(b), a.max(b)]).or_default().push(k);
        }
    }
    let crowded = on_edge.values().filter(|there| there.len() > 2).filter_map(|there| there.last());
    if let Some(&k) = crowded.min() {
        return named(
            k,
            "has an edge that belongs to more than two triangles: unite the parts that touch there, or move them apart; \
             a wall drawn from both sides needs a different diagonal on its back",
        );
    }
    if has_one_side(triangles, &on_edge) {
        return named(number, "belongs to a surface that has only one side");
    }
    Error::Shape {
        shape: "triangle mesh",
        why: "two triangles run along one edge in the same direction: reverse one of them",
    }
}

/// Whether the surface has only one side: no reversal of triangles makes all neighbours run along their edge in
/// opposite directions.
fn has_one_side(triangles: &[[usize; 3]], on_edge: &HashMap<[usize; 2], Vec<usize>>) -> bool {
    let mut turned: Vec<Option<bool>> = vec![None; triangles.len()];
    let mut open = vec![];
    for first in 0..triangles.len() {
        if turned[first].is_none() {
            turned[first] = Some(false);
            open.push(first);
        }
        while let Some(k) = open.pop() {
            for side in sides(&triangles[k]) {
                let [a, b] = side;
                let beyond = on_edge[&[a.min(b), a.max(b)]].iter().filter(|&&other| other != k);
                for &other in beyond {
                    let same = sides(&triangles[other]).contains(&side);
                    let turn = turned[k].map(|turn| turn != same);
                    match turned[other] {
                        None => {
                            turned[other] = turn;
                            open.push(other);
                        }
                        known if known != turn => return true,
                        _ => {}
                    }
                }
            }
        }
    }
    false
}
