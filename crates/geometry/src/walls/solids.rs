//! Convex solids in space, tested in lanes.
mod block;
mod cone;
mod grounds;
mod pill;
mod round;

use super::{ByLane, CORNER, WallHit, Walls, center::Center, first::First, number};
use crate::{Boundary, Extent, plane::slack};
use block::{Block, Plane};
use cone::Nappe;
use grounds::{Ground, Grounds};
use lanes::{Lane, Mask};
use nalgebra::Vector3;
use pill::Pill;
use round::Round;

/// The surface of a convex solid.
#[derive(Clone, Debug)]
pub(crate) enum ConvexBody {
    /// The intersection of half-spaces, and of a ball or a tube where there is one.
    Intersection {
        /// A point of each plane \[L\], and its unit normal, outwards.
        planes: Vec<[Vector3<f64>; 2]>,
        /// A centre \[L\], a unit vector along the axis of a tube, and the radius \[L\].
        round: Option<(Vector3<f64>, Option<Vector3<f64>>, f64)>,
    },
    /// The inside of a cone.
    Cone {
        /// Its apex \[L\].
        apex: Vector3<f64>,
        /// A unit vector from there into it.
        axis: Vector3<f64>,
        /// The tangent of half the angle at the apex.
        slope: f64,
        /// A point of its base \[L\], the plane across the axis.
        base: Vector3<f64>,
    },
    /// All points within a radius \[L\] of the segment between two different points \[L\].
    Capsule {
        /// The points.
        ends: [Vector3<f64>; 2],
        /// The radius.
        radius: f64,
    },
}

/// One of several convex solids.
#[derive(Clone, Debug)]
pub(crate) struct Member {
    /// Its surface.
    pub(crate) body: ConvexBody,
    /// A box around that; infinite where the solid is.
    pub(crate) extent: Extent<3>,
    /// Whether the table is inside.
    pub(crate) inside: bool,
    /// The number of the piece.
    pub(crate) number: usize,
}

/// A boundary in space that answers for one path at a time.
pub(crate) type OneByOne<'a> = &'a (dyn Boundary<3> + Sync);

/// Whether a point lies within a length \[L\] of an obstacle that stands on other walls, and that is not the piece with this number.
pub(crate) type AtFoot<'a> = &'a (dyn Fn(&Vector3<f64>, usize, f64) -> bool + Sync);

/// Convex solids with the table inside or outside of each, tested one after another, each for all lanes at once.
///
/// Times are compared as fractions, and the data for the landing on the surface that is hit are looked up at the end. The result is
/// trusted where the point of the hit lies on this surface and on no other one. Wherever a path comes within rounding of an edge, or of
/// a wall on the way, the exact boundary is asked; so nothing here decides what a corner is.
pub(crate) struct Solids<'a> {
    center: Center<3>,
    /// The solids, in coordinates relative to the centre, as are their surfaces.
    bodies: Vec<Body>,
    grounds: Grounds,
    /// The rest of the boundary, if any.
    others: Option<ByLane<OneByOne<'a>>>,
    /// Obstacles that stand on walls, if these or those are among the rest.
    feet: Option<AtFoot<'a>>,
    /// The whole boundary.
    exact: ByLane<OneByOne<'a>>,
    /// Size of the coordinates \[L\], to which rounding is relative.
    size: f64,
}

/// A solid to be tested, and the index of its first surface.
#[derive(Clone, Debug)]
enum Body {
    Wall(Plane, f64),
    Hollow(Round, f64),
    Ball(Round, f64),
    Block(Block, f64, Round),
    HollowCone(Nappe, f64),
    HollowPill(Pill, f64),
    Pill(Pill, f64),
}

impl<'a> Solids<'a> {
    /// The solids, the rest of the boundary if there is more, the whole of it, and its size \[L\].
    pub(crate) fn new(solids: &[Member], others: Option<OneByOne<'a>>, exact: OneByOne<'a>, size: f64) -> Self {
        let (mut bodies, mut grounds) = (vec![], vec![]);
        let center = center_of(solids);
        for member in solids {
            member.add_to(&center, &mut bodies, &mut grounds);
        }
        Solids {
            center: Center::new(center.into()),
            bodies,
            grounds: Grounds::new(&grounds),
            others: others.map(ByLane),
            feet: None,
            exact: ByLane(exact),
            size,
        }
    }

    /// The same walls, with obstacles that stand on the rest of the boundary or are part of it.
    pub(crate) fn with_feet(self, feet: Option<AtFoot<'a>>) -> Self {
        Solids { feet, ..self }
    }
}

/// The point to which coordinates are relative: a centre for solids far from the origin compared with their size, otherwise the origin.
fn center_of(solids: &[Member]) -> Vector3<f64> {
    let points = solids.iter().flat_map(|member| match &member.body {
        ConvexBody::Capsule { ends, .. } => ends.to_vec(),
        ConvexBody::Cone { apex, base, .. } => vec![*apex, *base],
        ConvexBody::Intersection { planes, round } => {
            planes.iter().map(|[through, _]| *through).chain(round.map(|(center, ..)| center)).collect()
        }
    });
    let Extent { min, max } = Extent::of(points);
    let (center, half) = (min * 0.5 + max * 0.5, max * 0.5 - min * 0.5);
    if center.amax() > 4.0 * half.amax() { center } else { Vector3::zeros() }
}

impl Member {
    /// Adds the bodies to be tested and their surfaces, in coordinates relative to a point.
    fn add_to(&self, from: &Vector3<f64>, bodies: &mut Vec<Body>, grounds: &mut Vec<(Ground, bool, usize)>) {
        let first = grounds.len() as f64;
        let mut add = |ground, inside| grounds.push((ground, inside, self.number));
        match &self.body {
            ConvexBody::Capsule { ends, radius } => {
                let pill = Pill::new(ends.map(|end| end - from), *radius);
                pill.parts.into_iter().for_each(|part| add(Ground::Round(part), self.inside));
                bodies.push(if self.inside { Body::HollowPill(pill, first) } else { Body::Pill(pill, first) });
            }
            ConvexBody::Cone { apex, axis, slope, base } => {
                let (nappe, base) = (Nappe::new(apex - from, *axis, *slope), Plane::new(&(base - from), axis));
                add(Ground::Cone(nappe), self.inside);
                add(Ground::Flat(base), self.inside);
                bodies.extend([Body::HollowCone(nappe, first), Body::Wall(base, first + 1.0)]);
            }
            ConvexBody::Intersection { planes, round } => {
                let mut planes: Vec<Plane> =
                    planes.iter().map(|[through, n]| Plane::new(&(through - from), n)).collect();
                let round = round.map(|(center, axis, radius)| Round::new(center - from, axis, radius));
                let mut inside = self.inside;
                if let ([plane], None, false) = (&mut planes[..], round, inside) {
                    // the outside of a half-space is another half-space
                    (*plane, inside) = (plane.turned(), true);
                }
                let surfaces = planes.iter().map(|plane| Ground::Flat(*plane)).chain(round.map(Ground::Round));
                surfaces.for_each(|ground| add(ground, inside));
                match round {
                    _ if inside => {
                        let walls = planes.iter().zip(0..);
                        bodies.extend(walls.map(|(plane, k)| Body::Wall(*plane, first + f64::from(k))));
                        bodies.extend(round.map(|round| Body::Hollow(round, first + planes.len() as f64)));
                    }
                    Some(ball) if planes.is_empty() => bodies.push(Body::Ball(ball, first)),
                    _ => bodies.push(Body::Block(Block { planes, round }, first, around(&self.extent, from))),
                }
            }
        }
    }
}

/// The lanes in which another piece stands where one is hit, to within `near`.
#[inline(never)]
fn at_feet<F: Lane>(feet: AtFoot<'_>, hit: &WallHit<F, 3>, near: F) -> F::Mask {
    let stands = |lane: usize| {
        let point = Vector3::from(hit.point.map(|p| p.lane(lane)));
        hit.time.lane(lane) < f64::INFINITY && feet(&point, number(hit.piece.lane(lane)), near.lane(lane))
    };
    near.same(0.0).lt(near.each(|lane| if stands(lane) { 1.0 } else { 0.0 }))
}

/// An upper bound of the largest coordinate.
#[inline(always)]
fn sum_of_sizes<F: Lane>(x: &[F; 3]) -> F {
    x[0].abs() + x[1].abs() + x[2].abs()
}

/// A ball around a box, relative to a point, larger than the box by more than any rounding.
fn around(Extent { min, max }: &Extent<3>, from: &Vector3<f64>) -> Round {
    let (center, half) = (min * 0.5 + max * 0.5, max * 0.5 - min * 0.5);
    Round::new(center - from, None, half.norm() + 1e-6 * (half.norm() + center.amax()))
}

impl ConvexBody {
    /// How many surfaces it has.
    pub(crate) fn surfaces(&self) -> usize {
        match self {
            ConvexBody::Intersection { planes, round } => planes.len() + usize::from(round.is_some()),
            ConvexBody::Cone { .. } => 2,
            ConvexBody::Capsule { .. } => 3,
        }
    }
}

impl Walls<3> for Solids<'_> {
    fn rounds_normals(&self) -> bool {
        true
    }

    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; 3], v: &[F; 3]) -> WallHit<F, 3> {
        let zero = v[0].same(0.0);
        // a path may come from far beyond the walls
        let reach = sum_of_sizes(x) + self.size;
        let y = self.center.sees(x);
        let within = reach * slack([1.0]);
        let mut first = First::none(zero);
        for body in &self.bodies {
            match body {
                Body::Wall(plane, place) => first.look(plane.leaves(&y, v), *place),
                Body::Hollow(round, place) => first.look(round.pass(&y, v).leaves(), *place),
                Body::Ball(round, place) => {
                    first.look(round.pass(&y, v).enters(within * (-2.0 * round.radius)), *place);
                }
                // a single path misses most of them by far
                Body::Block(_, _, ball) if F::LANES == 1 && !ball.pass(&y, v).meets().any() => {}
                Body::Block(block, place, _) => {
                    let (candidate, face) = block.enters(&y, v, within);
                    first.look_at(candidate, face + *place);
                }
                Body::HollowCone(nappe, place) => first.look(nappe.leaves(&y, v), *place),
                Body::HollowPill(pill, place) => {
                    let (candidate, part) = pill.leaves(&y, v);
                    first.look_at(candidate, part + *place);
                }
                Body::Pill(pill, place) => {
                    let (candidate, part) = pill.enters(&y, v, within);
                    first.look_at(candidate, part + *place);
                }
            }
        }
        let never = zero.same(f64::INFINITY);
        let time = first.num / first.den;
        let (mut hit, tiny) = self.grounds.land(&y, v, time, first.place);
        let at = hit.point;
        hit.point = self.center.seen(&at);
        let near = (reach + sum_of_sizes(&hit.point)) * (2.0 * CORNER);
        let mut doubt = (tiny | self.grounds.several_at(&at, near)) & time.lt(never);
        if let Some(others) = &self.others {
            let other = others.first_hit(x, v);
            let sooner = other.time.lt(hit.time);
            // how far in front of the second wall the path meets the first
            let mut speed = zero;
            for i in 0..3 {
                speed = speed + v[i] * sooner.select(hit.normal[i], other.normal[i]);
            }
            let apart = ((other.time - hit.time) * speed).abs();
            doubt = (doubt & !sooner) | (apart.lt(near) & other.time.lt(never) & hit.time.lt(never));
            hit = hit.or(sooner, &other);
            if let Some(feet) = self.feet {
                doubt = doubt | at_feet(feet, &hit, near);
            }
        }
        if doubt.any() { self.asked(*x, *v, doubt, hit) } else { hit }
    }
}

impl Solids<'_> {
    /// The hit, replaced in doubtful lanes by the answer of the exact boundary.
    #[cold]
    #[inline(never)]
    fn asked<F: Lane>(&self, x: [F; 3], v: [F; 3], doubt: F::Mask, hit: WallHit<F, 3>) -> WallHit<F, 3> {
        hit.or(doubt, &self.exact.first_hit(&x, &v))
    }
}
