//! The billiard program of a textbook, in any precision.
//!
//! The crossing time outwards is computed for each wall, the first one wins, the particle is put there and its velocity
//! is changed: the formulas as one would write them down, without the engine's care for rounding. In about 106 bits it
//! is the reference for the other methods; in `f64` and `f32` it is a method itself.

use super::law::Law;
use super::real::Real;
use super::state::State;
use billiards::geometry::{Figure, Table, Vector2};

/// A wall, with a unit normal into the table.
#[derive(Clone, Debug)]
enum Wall<R> {
    /// A straight line, or the part of it up to `along` from `from`.
    Straight { from: [R; 2], along: [R; 2], normal: [R; 2], whole: bool },
    /// A circle, or the part of it that lies on the right of the line between two points (on the left if the table is
    /// outside).
    Circle { center: [R; 2], radius: R, inside: bool, ends: Option<[[R; 2]; 2]> },
    /// The inside of an ellipse about the origin, with semi-axes along the axes.
    Ellipse { semi_axes: [R; 2] },
    /// The plane x₃ = height.
    Level { height: R, up: bool },
}

/// A table and a law.
#[derive(Clone, Debug)]
pub struct Textbook<R> {
    walls: Vec<Wall<R>>,
    law: Turn<R>,
    /// Size of the coordinates.
    size: R,
}

/// The effect of a collision.
#[derive(Clone, Debug)]
enum Turn<R> {
    /// `(v₀, v·t) ↦ (−c v₀ + s v·t, s v₀ + c v·t)`, the normal part reversed.
    Disk { c: R, s: R },
    /// `v − 2 (v·ν) ν − (2γ/(1+γ²)) q`, `W + (2/(1+γ²)) ν × q` with `q` the tangential part of `γ v − W × ν`.
    Ball { gamma: R, factor: R },
    /// Only the normal part of the velocity is reversed.
    Smooth,
}

/// The particle met no further wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Escaped;

fn dot<R: Real, const N: usize>(a: [R; N], b: [R; N]) -> R {
    (0..N).fold(R::of(0.0), |sum, i| sum + a[i] * b[i])
}

fn cross<R: Real>(a: [R; 2], b: [R; 2]) -> R {
    a[0] * b[1] - a[1] * b[0]
}

fn minus<R: Real>(a: [R; 2], b: [R; 2]) -> [R; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn point<R: Real>(p: Vector2<f64>) -> [R; 2] {
    [R::of(p.x), R::of(p.y)]
}

fn straight<R: Real>(from: [R; 2], along: [R; 2], whole: bool) -> Wall<R> {
    let length = dot(along, along).sqrt();
    let normal = [-along[1] / length, along[0] / length];
    Wall::Straight { from, along, normal, whole }
}

impl<R: Real> Wall<R> {
    fn of(figure: &Figure) -> Option<Wall<R>> {
        Some(match *figure {
            Figure::Segment { ends: [a, b] } => straight(point(a), minus(point(b), point(a)), false),
            Figure::Line { through, direction } => straight(point(through), point(direction), true),
            Figure::Circle { center, radius, inside } => {
                Wall::Circle { center: point(center), radius: R::of(radius), inside, ends: None }
            }
            Figure::Arc { center, radius, ends, inside } => {
                Wall::Circle { center: point(center), radius: R::of(radius), inside, ends: Some(ends.map(point)) }
            }
            Figure::Ray { .. } | Figure::Other => return None,
        })
    }

    /// When the path crosses it outwards.
    fn time(&self, x: [R; 3], v: [R; 3]) -> Option<R> {
        let (zero, one) = (R::of(0.0), R::of(1.0));
        let (x2, v2) = ([x[0], x[1]], [v[0], v[1]]);
        let at = |t: R| [x2[0] + v2[0] * t, x2[1] + v2[1] * t];
        match self {
            Wall::Straight { from, along, normal, whole } => {
                let speed = dot(v2, *normal);
                if speed >= zero {
                    return None;
                }
                let t = dot(minus(*from, x2), *normal) / speed;
                let share = dot(minus(at(t), *from), *along) / dot(*along, *along);
                (*whole || (share >= zero && share <= one)).then_some(t)
            }
            Wall::Circle { center, radius, inside, ends } => {
                let t = crossing(minus(x2, *center), v2, *radius * *radius, *inside)?;
                let on = |[a, b]: &[[R; 2]; 2]| {
                    let left = cross(minus(*b, *a), minus(at(t), *a));
                    if *inside { left <= zero } else { left >= zero }
                };
                ends.as_ref().is_none_or(on).then_some(t)
            }
            Wall::Ellipse { semi_axes: [a, b] } => crossing([x[0] / *a, x[1] / *b], [v[0] / *a, v[1] / *b], one, true),
            Wall::Level { height, up } => {
                let outwards = if *up { v[2] < zero } else { v[2] > zero };
                outwards.then(|| (*height - x[2]) / v[2])
            }
        }
    }

    /// The unit normal into the table at a point of it.
    fn normal(&self, x: [R; 3]) -> [R; 3] {
        let (zero, one) = (R::of(0.0), R::of(1.0));
        let unit = |n: [R; 2]| {
            let length = dot(n, n).sqrt();
            [n[0] / length, n[1] / length, zero]
        };
        match self {
            Wall::Straight { normal: [a, b], .. } => [*a, *b, zero],
            Wall::Circle { center, inside, .. } => {
                let n = minus([x[0], x[1]], *center);
                unit(if *inside { n.map(|n| -n) } else { n })
            }
            Wall::Ellipse { semi_axes: [a, b] } => unit([-x[0] / (*a * *a), -x[1] / (*b * *b)]),
            Wall::Level { up, .. } => [zero, zero, if *up { one } else { -one }],
        }
    }
}

/// When the point `q + t v` leaves (`inside`) or enters the disk of that radius about 0.
fn crossing<R: Real>(q: [R; 2], v: [R; 2], square: R, inside: bool) -> Option<R> {
    let (a, b, c) = (dot(v, v), dot(q, v), dot(q, q) - square);
    let discriminant = b * b - a * c;
    let zero = R::of(0.0);
    if discriminant < zero || (!inside && b >= zero) {
        return None;
    }
    let root = discriminant.sqrt();
    Some(if inside { (root - b) / a } else { (-b - root) / a })
}

impl<R: Real> Textbook<R> {
    /// A planar table of segments, lines, circles and arcs; `None` for anything else.
    pub fn new(table: &Table, law: Law) -> Option<Self> {
        let walls = table.pieces().iter().map(|piece| Wall::of(&piece.figure())).collect::<Option<_>>()?;
        let extent = table.extent();
        let far = [extent.min.x, extent.min.y, extent.max.x, extent.max.y].into_iter().filter(|x| x.is_finite());
        let size = far.fold(0.0, |m: f64, x| m.max(x.abs()));
        Some(Textbook { walls, law: Turn::disk(law), size: R::of(size) })
    }

    /// The inside of an ellipse about the origin.
    pub fn ellipse(semi_axes: [f64; 2], law: Law) -> Self {
        let walls = vec![Wall::Ellipse { semi_axes: semi_axes.map(R::of) }];
        Textbook { walls, law: Turn::disk(law), size: R::of(semi_axes[0].max(semi_axes[1])) }
    }

    /// The slab `0 < x₃ < height`.
    pub fn slab(height: f64, law: Law) -> Self {
        let levels = [(0.0, true), (height, false)];
        let walls = levels.map(|(height, up)| Wall::Level { height: R::of(height), up }).into();
        Textbook { walls, law: Turn::ball(law), size: R::of(height) }
    }

    /// Flies to the next wall and collides there.
    ///
    /// # Errors
    /// No further wall is met.
    pub fn step(&self, at: &mut State<R>) -> Result<(), Escaped> {
        let State { position: x, velocity: v, spin: w } = at;
        // a wall that is behind by no more than rounding is crossed now
        let speed = dot(*v, *v).sqrt();
        let back = -(R::of(64.0 * R::EPSILON) * self.size / speed);
        let mut first: Option<(R, &Wall<R>)> = None;
        for wall in &self.walls {
            if let Some(t) = wall.time(*x, *v)
                && t >= back
                && first.as_ref().is_none_or(|(best, _)| t < *best)
            {
                first = Some((t, wall));
            }
        }
        let (t, wall) = first.ok_or(Escaped)?;
        for i in 0..3 {
            x[i] = x[i] + v[i] * t;
        }
        self.law.apply(wall.normal(*x), v, w);
        Ok(())
    }
}

impl<R: Real> Turn<R> {
    fn disk(law: Law) -> Self {
        let [one, two, three] = [1.0, 2.0, 3.0].map(R::of);
        match law {
            // γ² = 1/2: c = 1/3, s = √8/3
            Law::NoSlip => Turn::Disk { c: one / three, s: two * two.sqrt() / three },
            Law::Specular => Turn::Smooth,
        }
    }

    fn ball(law: Law) -> Self {
        let [one, two, five] = [1.0, 2.0, 5.0].map(R::of);
        match law {
            // γ² = 2/5
            Law::NoSlip => Turn::Ball { gamma: (two / five).sqrt(), factor: two / (one + two / five) },
            Law::Specular => Turn::Smooth,
        }
    }

    fn apply(&self, n: [R; 3], v: &mut [R; 3], w: &mut [R; 3]) {
        let vn = dot(*v, n);
        match self {
            Turn::Smooth => {
                for i in 0..3 {
                    v[i] = v[i] - (vn + vn) * n[i];
                }
            }
            Turn::Disk { c, s } => {
                let (vt, spin) = (v[1] * n[0] - v[0] * n[1], w[0]);
                let after = *s * spin + *c * vt;
                w[0] = *s * vt - *c * spin;
                (v[0], v[1]) = (-vn * n[0] - after * n[1], -vn * n[1] + after * n[0]);
            }
            Turn::Ball { gamma, factor } => {
                let around = |a: [R; 3], b: [R; 3]| {
                    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
                };
                let twist = around(*w, n);
                let slip: [R; 3] = core::array::from_fn(|i| *gamma * (v[i] - vn * n[i]) - twist[i]);
                let turn = around(n, slip);
                for i in 0..3 {
                    v[i] = v[i] - (vn + vn) * n[i] - *gamma * *factor * slip[i];
                    w[i] = w[i] + *factor * turn[i];
                }
            }
        }
    }
}
