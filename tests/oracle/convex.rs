//! What round faces are about: convex sets, by their closest points.
use super::number::{Vector, add, big, dot, is_positive, norm, scale, small, sub, vector, vector_product};

/// What a round face is about, in the body's own coordinates.
#[derive(Clone, Debug)]
pub(crate) enum Core {
    Point([f64; 3]),
    Segment([[f64; 3]; 2]),
    /// The second axis.
    Axis,
    /// The box with these half edges.
    Brick([f64; 3]),
    /// What a polygon becomes that turns about the second axis: its corners as distances from the axis and heights, the first
    /// and the last on the axis.
    Turned(Vec<[f64; 2]>),
    /// Some triangles, counter-clockwise as seen from outside, and all that lies behind each of them.
    Hull(Vec<[[f64; 3]; 3]>),
}

/// `a` with length 1; 0 remains 0.
pub(super) fn unit(a: &Vector<3>) -> Vector<3> {
    let length = norm(a);
    if is_positive(&length) { scale(a, &(big(1.0) / length)) } else { a.clone() }
}

/// The point of the segment from `a` to `b` that is closest to `p`.
fn on_segment<const N: usize>(p: &Vector<N>, [a, b]: [[f64; N]; 2]) -> Vector<N> {
    let [a, b] = [a, b].map(vector);
    let along = sub(&b, &a);
    let s = dot(&sub(p, &a), &along) / dot(&along, &along);
    if !is_positive(&s) {
        a
    } else if s > big(1.0) {
        b
    } else {
        add(&a, &scale(&along, &s))
    }
}

/// Of some points the one closest to `p`.
fn nearest<const N: usize>(p: &Vector<N>, points: impl Iterator<Item = Vector<N>>) -> Vector<N> {
    let off = |q: &Vector<N>| {
        let w = sub(p, q);
        dot(&w, &w)
    };
    points.min_by(|a, b| off(a).cmp(&off(b))).expect("one point")
}

/// The sides of a ring of three.
fn sides<T: Copy>([a, b, c]: [T; 3]) -> [[T; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

impl Core {
    /// Its point closest to `p`.
    pub(super) fn closest(&self, p: &Vector<3>) -> Vector<3> {
        match self {
            Core::Point(c) => vector(*c),
            Core::Segment(ends) => on_segment(p, *ends),
            Core::Axis => [big(0.0), p[1].clone(), big(0.0)],
            Core::Brick(half) => core::array::from_fn(|i| p[i].clone().clamp(big(-half[i]), big(half[i]))),
            Core::Turned(corners) => {
                let across = norm(&[p[0].clone(), p[2].clone()]);
                let q = [across.clone(), p[1].clone()];
                // counter-clockwise as seen with the distance to the right and the height upwards
                let pairs: Vec<[[f64; 2]; 2]> = corners.windows(2).map(|ends| [ends[0], ends[1]]).collect();
                let beyond = |[a, b]: &[[f64; 2]; 2]| {
                    let (a, b) = (vector(*a), vector(*b));
                    let (along, w) = (sub(&b, &a), sub(&q, &a));
                    is_positive(&(&along[1] * &w[0] - &along[0] * &w[1]))
                };
                if !pairs.iter().any(beyond) {
                    return p.clone();
                }
                let [r, y] = nearest(&q, pairs.into_iter().map(|ends| on_segment(&q, ends)));
                let share = if is_positive(&across) { r / across } else { big(0.0) };
                [&p[0] * &share, y, &p[2] * &share]
            }
            Core::Hull(triangles) => {
                let mut feet = vec![];
                let mut beyond = false;
                for &triangle in triangles {
                    let [a, b, c] = triangle.map(vector);
                    let n = vector_product(&sub(&b, &a), &sub(&c, &a));
                    let height = dot(&sub(p, &a), &n) / dot(&n, &n);
                    if !is_positive(&height) {
                        continue;
                    }
                    beyond = true;
                    let foot = sub(p, &scale(&n, &height));
                    let left = |[a, b]: [[f64; 3]; 2]| {
                        let [a, b] = [a, b].map(vector);
                        is_positive(&dot(&vector_product(&sub(&b, &a), &sub(&foot, &a)), &n))
                    };
                    if sides(triangle).into_iter().all(left) {
                        return foot;
                    }
                    feet.extend(sides(triangle).map(|side| on_segment(p, side)));
                }
                if beyond { nearest(p, feet.into_iter()) } else { p.clone() }
            }
        }
    }

    /// How much the direction from here to `p` turns at most where `p` moves across it, there or within rounding of it: the greatest
    /// curvature of the surface at this distance, which jumps where a border begins.
    pub(super) fn turn(&self, p: &Vector<3>) -> f64 {
        let [n, first, second] = self.frame(p);
        let rounding = norm(p) * big(8.0 * f64::EPSILON);
        let beside = [&first, &second].map(|t| [1.0, -1.0].map(|sign| add(p, &scale(t, &(&rounding * big(sign))))));
        let there = self.turn_at(p, &[n, first, second]);
        beside.iter().flatten().map(|p| self.turn_at(p, &self.frame(p))).fold(there, f64::max)
    }

    fn outward(&self, p: &Vector<3>) -> Vector<3> {
        unit(&sub(p, &self.closest(p)))
    }

    /// The direction from here to `p`, and two across it.
    fn frame(&self, p: &Vector<3>) -> [Vector<3>; 3] {
        let n = self.outward(p);
        let first = unit(&vector_product(&n, &vector([0.36, 0.48, 0.8])));
        let second = vector_product(&n, &first);
        [n, first, second]
    }

    /// The same at `p` alone: the difference quotient of a step so small that 200 bits are enough.
    fn turn_at(&self, p: &Vector<3>, [n, first, second]: &[Vector<3>; 3]) -> f64 {
        let outward = |p: &Vector<3>| self.outward(p);
        let step = norm(&sub(p, &self.closest(p))) * big(libm::ldexp(1.0, -60));
        let [along, across] = [first, second].map(|t| {
            let change = scale(&sub(&outward(&add(p, &scale(t, &step))), n), &(big(1.0) / &step));
            [first, second].map(|t| small(&dot(&change, t)))
        });
        // the greater eigenvalue
        0.5 * (along[0] + across[1] + libm::hypot(along[0] - across[1], 2.0 * along[1]))
    }
}
