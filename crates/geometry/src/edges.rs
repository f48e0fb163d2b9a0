//! Directed edges between numbered points.
use crate::plane::key;
use std::collections::HashMap;

/// Numbers points so that equal ones (bit for bit, with −0 = 0) have equal numbers: that of the first of them.
pub fn merged<const N: usize>(points: impl IntoIterator<Item = impl Into<[f64; N]>>) -> Vec<usize> {
    let mut known = HashMap::new();
    points.into_iter().enumerate().map(|(i, p)| *known.entry(key(p)).or_insert(i)).collect()
}

/// The sides of a triangle, each from one corner to the next.
pub fn sides([a, b, c]: [usize; 3]) -> [[usize; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

/// Edges as chains, each of which continues as long as an edge begins where the last one ends.
///
/// ```
/// use geometry::edges::chains;
/// assert_eq!(chains(&[[0, 1], [5, 6], [1, 2], [2, 0]]), [vec![0, 1, 2, 0], vec![5, 6]]);
/// ```
pub fn chains(edges: &[[usize; 2]]) -> Vec<Vec<usize>> {
    let mut from: HashMap<usize, Vec<usize>> = HashMap::new();
    for (k, edge) in edges.iter().enumerate().rev() {
        from.entry(edge[0]).or_default().push(k);
    }
    let mut is_gone = vec![false; edges.len()];
    let mut chains = vec![];
    for first in 0..edges.len() {
        let mut next = Some(first).filter(|first| !is_gone[*first]);
        let mut chain = vec![edges[first][0]];
        while let Some(k) = next {
            is_gone[k] = true;
            let end = edges[k][1];
            chain.push(end);
            let mut later = from.get_mut(&end);
            next = core::iter::from_fn(|| later.as_mut()?.pop()).find(|k| !is_gone[*k]);
        }
        if chain.len() > 1 {
            chains.push(chain);
        }
    }
    chains
}
