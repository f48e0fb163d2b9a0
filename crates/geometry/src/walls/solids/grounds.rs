//! The data that a landing needs of the surface that is hit.
use super::{
    block::Plane,
    cone::Nappe,
    round::{Round, seen},
    sum_of_sizes,
};
use crate::{afar::NEWTON, plane::slack, walls::WallHit};
use lanes::{Lane, Mask, Rows, dot};

/// A surface with the table on one side; for a cone, the inner side.
#[derive(Clone, Copy, Debug)]
pub(super) enum Ground {
    Flat(Plane),
    Round(Round),
    Cone(Nappe),
}

/// The landing data of all surfaces by their indices, in three tables of four columns.
#[derive(Clone, Debug)]
pub(super) struct Grounds {
    /// For a plane, the unit normal into the table and its height; for a round surface, its middle and squared radius; for a cone, its apex
    /// and the tangent of its angle.
    anchors: Rows,
    /// For a round surface or a cone, a unit vector along its axis (zero for a ball); for a round one also `±1/r`, negative where the table
    /// is inside. Zero for a plane.
    axes: Rows,
    /// The number of the piece; for a cone, also the cosine of its angle.
    numbers: Rows,
    /// Each plane once, whichever side the table is on.
    planes: Vec<Plane>,
    rounds: Vec<Round>,
    cones: Vec<Nappe>,
}

impl Grounds {
    /// Surfaces of bodies, with the table inside or outside and the number of the piece.
    pub(super) fn new(all: &[(Ground, bool, usize)]) -> Grounds {
        let (mut anchors, mut axes, mut numbers) = (vec![], vec![], vec![]);
        let (mut planes, mut rounds): (Vec<Plane>, Vec<Round>) = (vec![], vec![]);
        let mut cones = vec![];
        for (ground, inside, number) in all {
            let sign = if *inside { -1.0 } else { 1.0 };
            let mut cosine = 0.0;
            match ground {
                Ground::Flat(plane) => {
                    let [n0, n1, n2] = plane.normal.map(|n| sign * n);
                    anchors.push([n0, n1, n2, sign * plane.distance]);
                    axes.push([0.0; 4]);
                    if !planes.iter().any(|other| other.is(plane)) {
                        planes.push(*plane);
                    }
                }
                Ground::Round(round) => {
                    let ([c0, c1, c2], [a0, a1, a2]) = (round.center, round.axis.unwrap_or_default());
                    anchors.push([c0, c1, c2, round.radius * round.radius]);
                    axes.push([a0, a1, a2, sign / round.radius]);
                    rounds.push(*round);
                }
                Ground::Cone(nappe) => {
                    let Nappe { apex: [c0, c1, c2], axis: [a0, a1, a2], slope, .. } = *nappe;
                    anchors.push([c0, c1, c2, slope]);
                    axes.push([a0, a1, a2, 0.0]);
                    cosine = nappe.cosine;
                    cones.push(*nappe);
                }
            }
            numbers.push([*number as f64, cosine, 0.0, 0.0]);
        }
        Grounds {
            anchors: Rows::new(anchors),
            axes: Rows::new(axes),
            numbers: Rows::new(numbers),
            planes,
            rounds,
            cones,
        }
    }

    /// The hit at a time on the surface with index `place`, and the lanes in which this is not accurate enough: the surface is round and
    /// tiny compared with the flight, or the hit is an apex.
    #[inline(always)]
    pub(super) fn land<F: Lane>(&self, x: &[F; 3], v: &[F; 3], time: F, place: F) -> (WallHit<F, 3>, F::Mask) {
        let zero = time.same(0.0);
        let [a0, a1, a2, height] = self.anchors.at(place);
        let [e0, e1, e2, to_normal] = self.axes.at(place);
        let [piece, cosine, ..] = self.numbers.at(place);
        let (anchor, axis) = ([a0, a1, a2], [e0, e1, e2]);
        let p = [x[0] + time * v[0], x[1] + time * v[1], x[2] + time * v[2]];
        // projection onto the plane
        let off = height - dot(&p, &anchor);
        let flat = [p[0] + off * a0, p[1] + off * a1, p[2] + off * a2];
        let (mut point, mut normal) = (flat, anchor);
        let mut tiny = zero.never();
        let round = zero.lt(to_normal.abs());
        if round.any() {
            let y = [p[0] - a0, p[1] - a1, p[2] - a2];
            let along = dot(&y, &axis);
            let w = [y[0] - along * e0, y[1] - along * e1, y[2] - along * e2];
            // |w|² is r² up to rounding: one Newton step
            let change = (height - dot(&w, &w)) * (to_normal * to_normal * 0.5);
            tiny = round & zero.same(NEWTON).lt(change.abs());
            for i in 0..3 {
                let grow = w[i] * change;
                point[i] = round.select((y[i] + grow) + anchor[i], flat[i]);
                normal[i] = round.select((w[i] + grow) * to_normal, anchor[i]);
            }
        }
        let cone = zero.lt(cosine);
        if !self.cones.is_empty() && cone.any() {
            let y = [p[0] - a0, p[1] - a1, p[2] - a2];
            let down = dot(&y, &axis);
            let w = [y[0] - down * e0, y[1] - down * e1, y[2] - down * e2];
            let distance = dot(&w, &w).sqrt();
            // the apex itself
            tiny = tiny | (cone & !zero.lt(distance));
            let (per_distance, off) = (zero.same(1.0) / distance, (distance - down * height) * cosine);
            for i in 0..3 {
                let inwards = (axis[i] * height - w[i] * per_distance) * cosine;
                normal[i] = cone.select(inwards, normal[i]);
                point[i] = cone.select(p[i] + off * inwards, point[i]);
            }
        }
        let hit = WallHit { time, point, normal, inverse: zero.same(1.0), piece, corner: zero.never() };
        (hit, tiny)
    }

    /// Whether several surfaces pass within a distance \[L\] of a point.
    #[inline(always)]
    pub(super) fn several_at<F: Lane>(&self, point: &[F; 3], near: F) -> F::Mask {
        let (mut one, mut two) = (near.never(), near.never());
        for plane in &self.planes {
            let here = plane.off(point).abs().lt(near);
            two = two | (one & here);
            one = one | here;
        }
        for round in &self.rounds {
            let here = round.off(point).abs().lt(near);
            two = two | (one & here);
            one = one | here;
        }
        for cone in &self.cones {
            let here = cone.off(point).abs().lt(near);
            // at the apex a cone meets itself
            let apex = sum_of_sizes(&seen(point, &cone.apex)).lt(near * 2.0);
            two = two | (one & here) | apex;
            one = one | here;
        }
        two
    }
}

impl Plane {
    /// Whether another plane is the same within rounding, facing either way.
    fn is(&self, other: &Plane) -> bool {
        let same = |sign: f64| {
            let turned = (0..3).all(|i| (self.normal[i] - sign * other.normal[i]).abs() <= 4.0 * f64::EPSILON);
            turned && (self.distance - sign * other.distance).abs() <= 0.5 * slack([self.distance])
        };
        same(1.0) || same(-1.0)
    }
}
