//! The order in which boxes are put into a tree.
use super::WIDTH;
use crate::Extent;

/// An order in which a tree over some boxes is searched faster than in their own order; `None` if their own is better.
///
/// The expected number of boxes that a random line meets is proportional to the sum of their perimeters (in space, surface
/// areas) by Cauchy and Crofton, so the order with the smaller sum over all nodes is better.
pub(crate) fn order<const N: usize>(boxes: &[Extent<N>]) -> Option<Vec<u32>> {
    let mut halved: Vec<Place<N>> = (0..).zip(boxes).map(|(number, e)| Place { middle: middle(e), number }).collect();
    halve(&mut halved);
    let sorted: Vec<Extent<N>> = halved.iter().map(|place| boxes[place.number as usize]).collect();
    (measure(sorted) < measure(boxes.to_vec())).then(|| halved.iter().map(|place| place.number).collect())
}

/// A box, represented by its middle.
#[derive(Clone, Copy)]
struct Place<const N: usize> {
    middle: [f64; N],
    number: u32,
}

fn middle<const N: usize>(extent: &Extent<N>) -> [f64; N] {
    let finite = |x: f64| x.clamp(-f64::MAX, f64::MAX) * 0.5;
    core::array::from_fn(|i| finite(extent.min[i]) + finite(extent.max[i]))
}

/// Recursively halves the places at the median of the coordinate in which they are spread most, keeping the members of one
/// node together.
fn halve<const N: usize>(places: &mut [Place<N>]) {
    if places.len() <= WIDTH {
        return;
    }
    let spread = |i: usize| {
        let (low, high) = places
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| (l.min(p.middle[i]), h.max(p.middle[i])));
        high - low
    };
    let axis = (1..N).fold((0, spread(0)), |best, i| if spread(i) > best.1 { (i, spread(i)) } else { best }).0;
    // split at whole nodes of the highest level that has more than one of them
    let mut node = WIDTH;
    while node * WIDTH < places.len() {
        node *= WIDTH;
    }
    let half = places.len().div_ceil(node).div_ceil(2) * node;
    places.select_nth_unstable_by(half, |a, b| a.middle[axis].total_cmp(&b.middle[axis]).then(a.number.cmp(&b.number)));
    let (below, above) = places.split_at_mut(half);
    halve(below);
    halve(above);
}

/// The sum over all nodes of a tree of half the perimeter of the box around them; in space, of the surface.
fn measure<const N: usize>(mut boxes: Vec<Extent<N>>) -> f64 {
    let mut sum = 0.0;
    while boxes.len() > 1 {
        boxes = boxes.chunks(WIDTH).map(|eight| eight.iter().copied().fold(Extent::EMPTY, Extent::union)).collect();
        for e in &boxes {
            let width = e.max - e.min;
            let face = |i: usize| (0..N).filter(|&j| j != i).map(|j| width[j]).product::<f64>();
            // infinite contributions are the same in any order
            sum += (0..N).map(face).filter(|face| face.is_finite()).sum::<f64>();
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector2;

    fn dots(places: impl Iterator<Item = [f64; 2]>) -> Vec<Extent> {
        places.map(|p| Extent { min: p.into(), max: Vector2::from(p) + Vector2::new(0.5, 0.5) }).collect()
    }

    #[test]
    fn pieces_along_a_line_stay_as_they_are() {
        assert_eq!(order(&dots((0..1000).map(|k| [f64::from(k), 0.0]))), None);
    }

    #[test]
    fn scattered_boxes_are_put_in_order() {
        let boxes = dots((0..1000).map(|k| [f64::from(k * 37 % 101), f64::from(k * 71 % 97)]));
        let order = order(&boxes).unwrap();
        let sorted: Vec<Extent> = order.iter().map(|&i| boxes[i as usize]).collect();
        assert!(measure(sorted) < 0.5 * measure(boxes));
        let mut numbers = order;
        numbers.sort_unstable();
        assert!((0..1000).eq(numbers));
    }
}
