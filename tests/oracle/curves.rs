//! Curves that are no common figures.
use super::curve::{Curve, round};
use super::number::{Big, Vector, add, big, dot, is_positive, left, norm, root, scale, sub, vector};

/// `x⁴ + y⁴ = 1`, table inside: in the direction `d` it is `d / (d₁⁴ + d₂⁴)^¼`.
#[derive(Clone, Debug)]
pub(crate) struct Quartic;

impl Curve for Quartic {
    fn parts(&self) -> usize {
        2
    }
    fn steps(&self) -> u32 {
        4
    }
    fn at(&self, part: usize, u: &Big) -> [Vector; 2] {
        let [d, _] = round(part, u);
        let square = [&d[0] * &d[0], &d[1] * &d[1]];
        let p = scale(&d, &(big(1.0) / root(&root(&dot(&square, &square)))));
        let cubes = [&p[0] * &p[0] * &p[0], &p[1] * &p[1] * &p[1]];
        [p, left(&cubes)]
    }
}

/// `r = 1 + a cos 2φ`, table inside.
#[derive(Clone, Debug)]
pub(crate) struct Peanut(pub f64);

impl Curve for Peanut {
    fn parts(&self) -> usize {
        2
    }
    fn steps(&self) -> u32 {
        16
    }
    fn at(&self, part: usize, u: &Big) -> [Vector; 2] {
        let [d, t] = round(part, u);
        let a = big(self.0);
        let r = big(1.0) + &a * (&d[0] * &d[0] - &d[1] * &d[1]);
        let rate = big(-4.0) * a * &d[0] * &d[1];
        [scale(&d, &r), add(&scale(&d, &rate), &scale(&t, &r))]
    }
}

/// `(cos t + b cos 2t, sin t + b sin 2t)`, table inside.
#[derive(Clone, Debug)]
pub(crate) struct Limacon(pub f64);

impl Curve for Limacon {
    fn parts(&self) -> usize {
        2
    }
    fn steps(&self) -> u32 {
        16
    }
    fn at(&self, part: usize, u: &Big) -> [Vector; 2] {
        limacon(&round(part, u), self.0)
    }
}

/// `e(t) + b e(2t)` and its derivative, from those of `e`.
fn limacon([d, t]: &[Vector; 2], b: f64) -> [Vector; 2] {
    let twice = [&d[0] * &d[0] - &d[1] * &d[1], big(2.0) * &d[0] * &d[1]];
    [add(d, &scale(&twice, &big(b))), add(t, &scale(&left(&twice), &big(2.0 * b)))]
}

/// The upper (part 0) or lower half of the cardioid `(cos t + ½ cos 2t, sin t + ½ sin 2t)`, which has a cusp at `t = π`, table inside.
#[derive(Clone, Debug)]
pub(crate) struct Cardioid(pub usize);

impl Curve for Cardioid {
    fn parts(&self) -> usize {
        1
    }
    fn steps(&self) -> u32 {
        16
    }
    fn at(&self, _: usize, u: &Big) -> [Vector; 2] {
        let [d, t] = round(self.0, u);
        limacon(&[left(&d), left(&t)], 0.5)
    }
    fn vertices(&self) -> Vec<Vector> {
        [[1.5, 0.0], [-0.5, 0.0]].map(vector).into()
    }
}

/// `r = 1 + a |cos φ|^(5/2)`, whose third derivative has no bound at the ends of the parts, table inside.
#[derive(Clone, Debug)]
pub(crate) struct Softened(pub f64);

impl Curve for Softened {
    fn parts(&self) -> usize {
        2
    }
    fn steps(&self) -> u32 {
        16
    }
    fn at(&self, part: usize, u: &Big) -> [Vector; 2] {
        let [d, t] = round(part, u);
        let size = norm(&[d[0].clone(), big(0.0)]);
        let power = big(self.0) * &size * root(&size);
        let r = big(1.0) + &power * &size;
        let side = big(if is_positive(&d[0]) { -2.5 } else { 2.5 });
        let rate = side * power * &d[1];
        [scale(&d, &r), add(&scale(&d, &rate), &scale(&t, &r))]
    }
}

/// The side from `a` to `b` displaced outwards by `64 A w³ (1−w)³`, `w = (1+u)/2`.
#[derive(Clone, Debug)]
pub(crate) struct Bulge {
    pub(crate) a: Vector,
    pub(crate) b: Vector,
    pub(crate) height: f64,
}

impl Curve for Bulge {
    fn parts(&self) -> usize {
        1
    }
    fn steps(&self) -> u32 {
        8
    }
    fn at(&self, _: usize, u: &Big) -> [Vector; 2] {
        let along = sub(&self.b, &self.a);
        let outward = scale(&left(&along), &(big(-self.height) / norm(&along)));
        let w = (big(1.0) + u) * big(0.5);
        let q = &w * (big(1.0) - &w);
        let shape = big(64.0) * &q * &q * &q;
        let rate = big(192.0) * &q * &q * (big(1.0) - big(2.0) * &w);
        let point = add(&add(&self.a, &scale(&along, &w)), &scale(&outward, &shape));
        [point, add(&along, &scale(&outward, &rate))]
    }
    fn vertices(&self) -> Vec<Vector> {
        vec![self.a.clone(), self.b.clone()]
    }
}

/// `r = 1 + a |cos φ|` on the right (part 0) or on the left of its kinks, table inside.
#[derive(Clone, Debug)]
pub(crate) struct Kinked {
    pub(crate) amount: f64,
    pub(crate) half: usize,
}

impl Curve for Kinked {
    fn parts(&self) -> usize {
        1
    }
    fn steps(&self) -> u32 {
        8
    }
    fn at(&self, _: usize, u: &Big) -> [Vector; 2] {
        let [d, t] = round(self.half, u);
        let a = big(if self.half == 0 { self.amount } else { -self.amount });
        let (r, rate) = (big(1.0) + &a * &d[0], -a * &d[1]);
        [scale(&d, &r), add(&scale(&d, &rate), &scale(&t, &r))]
    }
    fn vertices(&self) -> Vec<Vector> {
        [[0.0, -1.0], [0.0, 1.0]].map(vector).into()
    }
}

/// The curve at a distance from another one, on its table side; regular.
#[derive(Clone, Debug)]
pub(crate) struct Offset<C> {
    pub(crate) base: C,
    pub(crate) distance: f64,
}

impl<C: Curve> Curve for Offset<C> {
    fn parts(&self) -> usize {
        self.base.parts()
    }
    fn steps(&self) -> u32 {
        self.base.steps()
    }
    fn at(&self, part: usize, u: &Big) -> [Vector; 2] {
        let [point, tangent] = self.base.at(part, u);
        let by = big(self.distance) / norm(&tangent);
        [add(&point, &scale(&left(&tangent), &by)), tangent]
    }
    fn vertices(&self) -> Vec<Vector> {
        if self.base.vertices().is_empty() {
            return vec![];
        }
        [(0, -1.0), (self.parts() - 1, 1.0)].map(|(part, u)| self.at(part, &big(u))[0].clone()).into()
    }
}
