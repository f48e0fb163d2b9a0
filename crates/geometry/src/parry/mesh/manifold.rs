//! Why triangles do not form a two-sided surface.
use crate::{Error, edges::sides};
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
        for [a, b] in sides(*t) {
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
    match wrong_way(triangles, &on_edge, number) {
        None => named(number, "belongs to a surface that has only one side"),
        Some(wrong) => named(
            wrong,
            "runs along an edge in the same direction as its neighbour: list its corners in the opposite order",
        ),
    }
}

/// The first of the triangles to reverse so that all neighbours run along their edge in opposite directions: of two connected by edges
/// that differ in their orientation, one with the rarer of the two; the one `met` where there is none. `None` where the surface has only
/// one side, so that no reversal helps.
fn wrong_way(triangles: &[[usize; 3]], on_edge: &HashMap<[usize; 2], Vec<usize>>, met: usize) -> Option<usize> {
    let mut turned: Vec<Option<bool>> = vec![None; triangles.len()];
    let mut wrong = None;
    for first in 0..triangles.len() {
        if turned[first].is_some() {
            continue;
        }
        turned[first] = Some(false);
        let (mut part, mut next) = (vec![first], 0);
        while let Some(&k) = part.get(next) {
            next += 1;
            for side in sides(triangles[k]) {
                let [a, b] = side;
                for &other in on_edge[&[a.min(b), a.max(b)]].iter().filter(|&&other| other != k) {
                    let same = sides(triangles[other]).contains(&side);
                    let turn = turned[k].map(|turn| turn != same);
                    match turned[other] {
                        None => {
                            turned[other] = turn;
                            part.push(other);
                        }
                        known if known != turn => return None,
                        _ => {}
                    }
                }
            }
        }
        let is_turned = |k: &usize| turned[*k] == Some(true);
        let rarer = 2 * part.iter().filter(|k| is_turned(k)).count() <= part.len();
        wrong = wrong.or_else(|| part.iter().copied().filter(|k| is_turned(k) == rarer).min());
    }
    wrong.or(Some(met))
}
