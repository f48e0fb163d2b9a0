//! Where a path in space enters or leaves a convex body, found in another way than the library's and in 200 bits.
//!
//! A body is where some functions are negative that are convex along every line. Each is followed down to its least value
//! along the path by a bracket of the sign of its slope, and from there to its roots by brackets of its own sign.
use super::convex::{Core, unit};
use super::number::{
    Big, Vector, add, big, dot, is_positive, norm, root, scale, sign_change, small, sub, vector, vector_product,
};
use super::rays::{Foot, Random};
use billiards::geometry::Vector3;
use core::cmp::Ordering;

/// A surface with a convex side, in the body's own coordinates.
#[derive(Clone, Debug)]
pub(crate) enum Face {
    /// A plane and its outward normal, of any length.
    Plane { through: [f64; 3], normal: Vector<3> },
    /// All that is as far from something.
    Round { core: Core, radius: f64 },
    /// A cone about the second axis with its apex on top: the height of the apex, the tangent of half its angle.
    Cone { apex: f64, slope: Big },
}

/// A place at the distance `time` along a path.
fn at([x, v]: &[Vector<3>; 2], time: &Big) -> Vector<3> {
    add(x, &scale(v, time))
}

/// The part of a line on the convex side of a face, without ends where it has none.
struct Chord {
    ends: [Option<Big>; 2],
}

impl Face {
    /// The plane through three points, counter-clockwise as seen from outside.
    pub(crate) fn through(points: [[f64; 3]; 3]) -> Face {
        let [a, b, c] = points.map(vector);
        Face::Plane { through: points[0], normal: vector_product(&sub(&b, &a), &sub(&c, &a)) }
    }
    /// The plane through a point with an outward normal.
    pub(crate) fn plane(through: [f64; 3], normal: [f64; 3]) -> Face {
        Face::Plane { through, normal: vector(normal) }
    }

    /// How far a point lies outside; negative on the convex side.
    fn off(&self, p: &Vector<3>) -> Big {
        match self {
            Face::Plane { through, normal } => dot(&sub(p, &vector(*through)), normal) / norm(normal),
            Face::Round { core, radius } => norm(&sub(p, &core.closest(p))) - big(*radius),
            Face::Cone { apex, slope } => {
                let across = norm(&[p[0].clone(), p[2].clone()]);
                (across - slope * (big(*apex) - &p[1])) / root(&(big(1.0) + slope * slope))
            }
        }
    }

    /// The outward unit normal at a point: how [`Face::off`] changes.
    fn outward(&self, p: &Vector<3>) -> Vector<3> {
        match self {
            Face::Plane { normal, .. } => unit(normal),
            Face::Round { core, .. } => unit(&sub(p, &core.closest(p))),
            Face::Cone { slope, .. } => {
                let mut across = unit(&[p[0].clone(), big(0.0), p[2].clone()]);
                across[1].clone_from(slope);
                unit(&across)
            }
        }
    }

    /// The greatest curvature at a point.
    fn curvature(&self, p: &Vector<3>) -> f64 {
        match self {
            Face::Plane { .. } => 0.0,
            Face::Round { core: Core::Point(_) | Core::Segment(_) | Core::Axis, radius } => 1.0 / radius,
            Face::Round { core, .. } => core.turn(p),
            Face::Cone { slope, .. } => {
                let slope = small(slope);
                1.0 / (small(&norm(&[p[0].clone(), p[2].clone()])) * libm::sqrt(1.0 + slope * slope))
            }
        }
    }

    /// The part of a line on the convex side, looked for within a time; and the least distance off the face if there is none.
    fn chord(&self, path: &[Vector<3>; 2], within: &Big) -> Result<Chord, Big> {
        let v = &path[1];
        let off = |time: &Big| self.off(&at(path, time));
        let slope = |time: &Big| dot(&self.outward(&at(path, time)), v);
        if let Face::Plane { .. } = self {
            let (start, speed) = (off(&big(0.0)), slope(&big(0.0)));
            let end = || Some(-start.clone() / &speed);
            return match speed.cmp(&Big::ZERO) {
                Ordering::Greater => Ok(Chord { ends: [None, end()] }),
                Ordering::Less => Ok(Chord { ends: [end(), None] }),
                Ordering::Equal if is_positive(&start) => Err(start),
                Ordering::Equal => Ok(Chord { ends: [None, None] }),
            };
        }
        let far = [-within.clone(), within.clone()];
        let slopes = far.each_ref().map(slope);
        let lowest = match slopes.each_ref().map(is_positive) {
            [false, true] => sign_change(slope, far.clone(), slopes),
            [true, _] => far[0].clone(),
            [false, false] => far[1].clone(),
        };
        let least = off(&lowest);
        if is_positive(&least) {
            return Err(least);
        }
        let [begin, end] = far.each_ref().map(|far| {
            let value = off(far);
            is_positive(&value).then(|| (far.clone(), value))
        });
        let enter = begin.map(|(far, value)| sign_change(off, [far, lowest.clone()], [value, least.clone()]));
        let exit = end.map(|(far, value)| sign_change(off, [lowest.clone(), far], [least.clone(), value]));
        Ok(Chord { ends: [enter, exit] })
    }
}

/// A convex body, turned and moved, with the table inside or outside.
#[derive(Clone, Debug)]
pub(crate) struct Body {
    pub(crate) faces: Vec<Face>,
    /// The body's own axes.
    axes: [Vector<3>; 3],
    center: [f64; 3],
    inside: bool,
}

/// How a path meets a body.
#[derive(Clone, Debug)]
pub(crate) struct Crossing {
    pub(crate) time: Big,
    pub(crate) point: Vector<3>,
    /// Unit normal, into the table.
    pub(crate) normal: Vector<3>,
    pub(crate) face: usize,
    /// The greatest curvature there.
    pub(crate) curvature: f64,
    /// Distance from the next face.
    pub(crate) from_edge: f64,
    /// How deep the path goes into the body, at least half of it.
    pub(crate) depth: f64,
}

/// What a path does.
#[derive(Clone, Debug)]
pub(crate) enum Meeting {
    Crosses(Box<Crossing>),
    /// Passes by at a distance.
    Misses(f64),
}

impl Body {
    /// The body with its own coordinates turned by a quaternion `w + i x + j y + k z` of any length, and moved.
    pub(crate) fn new(faces: Vec<Face>, [w, x, y, z]: [f64; 4], center: [f64; 3], inside: bool) -> Body {
        let q = vector([x, y, z]);
        let square = dot(&q, &q) + big(w) * big(w);
        // e + 2 (w q × e + q × (q × e)) / |w + q|²
        let axes = core::array::from_fn(|i| {
            let e: Vector<3> = core::array::from_fn(|k| big(if i == k { 1.0 } else { 0.0 }));
            let once = vector_product(&q, &e);
            let twice = vector_product(&q, &once);
            let turn = scale(&add(&scale(&once, &big(w)), &twice), &(big(2.0) / &square));
            add(&e, &turn)
        });
        Body { faces, axes, center, inside }
    }

    /// A point of space in the body's own coordinates.
    fn own(&self, x: &Vector<3>) -> Vector<3> {
        self.own_direction(&sub(x, &vector(self.center)))
    }
    fn own_direction(&self, v: &Vector<3>) -> Vector<3> {
        core::array::from_fn(|i| dot(v, &self.axes[i]))
    }
    fn back(&self, d: &Vector<3>) -> Vector<3> {
        let part = |i: usize| scale(&self.axes[i], &d[i]);
        add(&add(&part(0), &part(1)), &part(2))
    }

    /// How far into the table a point lies.
    pub(crate) fn clearance(&self, x: &Vector<3>) -> f64 {
        let x = self.own(x);
        let off = self.faces.iter().map(|face| small(&face.off(&x))).fold(f64::NEG_INFINITY, f64::max);
        if self.inside { -off } else { off }
    }

    /// The first crossing after the start, looked for as far as `reach`.
    pub(crate) fn meet(&self, x: &Vector<3>, v: &Vector<3>, reach: f64) -> Meeting {
        let path = [self.own(x), self.own_direction(v)];
        let within = big(reach) / norm(v);
        let mut ends: [Option<(Big, usize)>; 2] = [None, None];
        let mut beside: Option<f64> = None;
        for (i, face) in self.faces.iter().enumerate() {
            let Chord { ends: [enter, exit] } = match face.chord(&path, &within) {
                Ok(chord) => chord,
                Err(least) => {
                    beside = Some(beside.unwrap_or(0.0).max(small(&least)));
                    continue;
                }
            };
            if let Some(enter) = enter.filter(|t| ends[0].as_ref().is_none_or(|end| *t > end.0)) {
                ends[0] = Some((enter, i));
            }
            if let Some(exit) = exit.filter(|t| ends[1].as_ref().is_none_or(|end| *t < end.0)) {
                ends[1] = Some((exit, i));
            }
        }
        let worst = |p: &Vector<3>| self.faces.iter().map(|f| small(&f.off(p))).fold(f64::NEG_INFINITY, f64::max);
        if let Some(distance) = beside {
            return Meeting::Misses(distance);
        }
        let mut depth = f64::INFINITY;
        if let [Some((enter, _)), Some((exit, _))] = &ends {
            depth = -worst(&at(&path, &((enter + exit) * big(0.5))));
            if depth <= 0.0 {
                return Meeting::Misses(-depth);
            }
        }
        let [enter, exit] = ends;
        let Some((time, face)) = (if self.inside { exit } else { enter }) else {
            return Meeting::Misses(f64::INFINITY);
        };
        if !is_positive(&time) {
            return Meeting::Misses(f64::INFINITY);
        }
        let own = at(&path, &time);
        let outward = self.faces[face].outward(&own);
        let sign = big(if self.inside { -1.0 } else { 1.0 });
        let others = self.faces.iter().enumerate().filter(|(i, _)| *i != face);
        let mut from_edge = others.map(|(_, f)| small(&f.off(&own)).abs()).fold(f64::INFINITY, f64::min);
        if let Face::Cone { apex, .. } = &self.faces[face] {
            from_edge = from_edge.min(small(&norm(&sub(&own, &vector([0.0, *apex, 0.0])))));
        }
        Meeting::Crosses(Box::new(Crossing {
            point: add(&self.back(&own), &vector(self.center)),
            normal: scale(&self.back(&outward), &sign),
            face,
            curvature: self.faces[face].curvature(&own) * if self.inside { 1.0 } else { -1.0 },
            from_edge,
            depth,
            time,
        }))
    }

    /// The place of the boundary where a point of it (in the body's own coordinates) is, or next to it.
    pub(crate) fn foot(&self, own: [f64; 3]) -> Foot {
        let p = vector(own);
        let nearest = self.faces.iter().max_by(|f, g| f.off(&p).cmp(&g.off(&p))).expect("a body has faces");
        let sign = if self.inside { -1.0 } else { 1.0 };
        Foot {
            point: Vector3::from(add(&self.back(&p), &vector(self.center)).map(|x| small(&x))),
            normal: Vector3::from(self.back(&nearest.outward(&p)).map(|x| sign * small(&x))),
            curvature: -sign * nearest.curvature(&p),
        }
    }

    /// A random place of the boundary, in the body's own coordinates: as seen from the middle in any direction.
    pub(crate) fn any_place(&self, middle: [f64; 3], extent: f64, random: &mut Random) -> [f64; 3] {
        loop {
            let v = core::array::from_fn(|_| random.between(-1.0, 1.0));
            let path = [vector(middle), vector(v)];
            let exits = self.faces.iter().filter_map(|f| f.chord(&path, &big(64.0 * extent)).ok()?.ends[1].clone());
            let Some(time) = exits.min() else { continue };
            let place = at(&path, &time).map(|x| small(&x));
            // of something infinite only the part nearby
            if place.iter().all(|x| x.abs() <= 4.0 * extent) {
                return place;
            }
        }
    }
}
