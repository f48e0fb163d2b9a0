//! Points on a solid, uniform by area.
use super::{super::Side, Body, Closest, Solid, bound::Bound, parallel::Parallel, strata::Stratum, unsupported};
use crate::{
    Error, Extent, Line,
    parry::{distance::to_unit, mesh::Mesh},
    plane::slack,
    surface::in_disk,
};
use core::f64::consts::PI;
use nalgebra::Vector3;

/// Draws points of one member of a solid: each trial finds one or none, with uniform density by area.
#[derive(Debug)]
pub(in crate::parry) struct Trials<'a> {
    solid: &'a Solid,
    member: usize,
    kind: Kind<'a>,
}

#[derive(Debug)]
enum Kind<'a> {
    /// Isotropic random lines through a box, which enter a convex body through each part of its surface in proportion to its area
    /// (Cauchy, Crofton). With a box around a thin body fewer lines miss than with a ball.
    Lines { body: &'a Body, extent: Extent<3> },
    /// The part of a plane in a disk about a point of it.
    Disk { about: Closest, radius: f64 },
    /// Triangles, with their cumulative areas.
    Triangles { mesh: &'a Mesh, unit: f64, sums: Vec<f64> },
    /// The parts of a parallel surface with what lies around them, with their cumulative areas.
    Strata { parallel: &'a Parallel, strata: Vec<Stratum>, unit: f64, sums: Vec<f64> },
}

impl Solid {
    /// Trials for all members. On planes, points are drawn within `bound`, which contains the table.
    ///
    /// # Errors
    /// [`Error::Unbounded`] for planes without a bound, [`Error::Shape`] for shapes known by their distance only.
    pub(in crate::parry) fn trials(&self, bound: Option<Bound>) -> Result<Vec<Trials<'_>>, Error> {
        let trials = self.members.iter().enumerate().map(|(member, body)| {
            let kind = match body {
                Body::Convex(..) | Body::Rounded(_) => match (body.extent(), bound) {
                    (extent, _) if extent.is_finite() => Kind::Lines { body, extent },
                    (_, Some(bound)) => {
                        let about = self.closest(&bound.center);
                        Kind::Disk { about, radius: bound.radius }
                    }
                    (_, None) => return Err(Error::Unbounded { what: "the area of the walls" }),
                },
                Body::Parallel(parallel) => {
                    let Extent { min, max } = parallel.extent();
                    let unit = to_unit((max - min).amax());
                    let strata = parallel.strata();
                    let sums = sums(strata.iter().map(|stratum| parallel.area(stratum, unit)));
                    Kind::Strata { parallel, strata, unit, sums }
                }
                Body::Mesh(mesh, _) => {
                    let unit = to_unit(mesh.vertices.iter().map(Vector3::amax).fold(0.0, f64::max));
                    Kind::Triangles { mesh, unit, sums: sums((0..mesh.triangles.len()).map(|k| mesh.area(k, unit))) }
                }
                Body::Distance(_) => {
                    return Err(unsupported("shape", "points of its surface are not known, only distances from it"));
                }
            };
            Ok(Trials { solid: self, member, kind })
        });
        trials.collect()
    }

    /// Whether a point of one member, with the outward normal there, is on the boundary of the whole: not inside any other member.
    fn exposes(&self, member: usize, point: &Vector3<f64>, outward: &Vector3<f64>, slack: f64) -> bool {
        let others = self.members.iter().enumerate().filter(|(k, _)| *k != member);
        // seen from outside, whichever side the table is on
        let seen = |body: &Body| match (body.closest(point, self.side), self.side) {
            (seen, Side::Outside) => seen,
            (Closest { distance, point, normal }, _) => Closest { distance: -distance, point, normal: -normal },
        };
        others.into_iter().all(|(k, body)| seen(body).leaves(outward, member < k, slack))
    }
}

impl Closest {
    /// Whether a point of another wall, with this normal there, is on the table's side of this one. Where the two walls coincide, there
    /// is nothing between them if they face each other; otherwise they are one wall, which belongs to the `first` of them.
    pub(in crate::parry) fn leaves(&self, normal: &Vector3<f64>, first: bool, slack: f64) -> bool {
        self.distance > slack || (self.distance >= -slack && first && self.normal.dot(normal) > 0.0)
    }
}

impl Trials<'_> {
    /// The area that would correspond to every trial finding a point, in units of a length whose inverse is `unit`.
    pub(in crate::parry) fn area(&self, unit: f64) -> f64 {
        match &self.kind {
            Kind::Lines { extent: Extent { min, max }, .. } => 2.0 * sides(&((max - min) * unit)).sum(),
            Kind::Disk { radius, .. } => PI * (radius * unit) * (radius * unit),
            Kind::Triangles { unit: own, sums, .. } | Kind::Strata { unit: own, sums, .. } => {
                sums[sums.len() - 1] * (unit / own) * (unit / own)
            }
        }
    }

    /// The greatest length in it.
    pub(in crate::parry) fn size(&self) -> f64 {
        match &self.kind {
            Kind::Lines { extent: Extent { min, max }, .. } => (max - min).amax(),
            Kind::Disk { radius, .. } => *radius,
            Kind::Triangles { unit, .. } | Kind::Strata { unit, .. } => 1.0 / unit,
        }
    }

    /// One trial: a point \[L\] and the unit normal there, into the table.
    pub(in crate::parry) fn draw(&self, uniform: &mut dyn FnMut() -> f64) -> Option<(Vector3<f64>, Vector3<f64>)> {
        let (point, normal) = match &self.kind {
            Kind::Lines { body, extent } => {
                let (point, outward) = body.entered(&line_into(extent, uniform))?;
                (point, if self.solid.side == Side::Outside { outward } else { -outward })
            }
            Kind::Disk { about, radius } => (about.point + in_disk(&about.normal, uniform) * *radius, about.normal),
            Kind::Triangles { mesh, sums, .. } => {
                let k = pick(sums, uniform);
                let (point, _) = mesh.land(k, &mesh.random_point(k, uniform));
                if !mesh.is_exposed(k, &point) {
                    return None;
                }
                (point, mesh.normals[k])
            }
            Kind::Strata { parallel, strata, sums, .. } => parallel.draw(&strata[pick(sums, uniform)], uniform)?,
        };
        let outward = if self.solid.side == Side::Outside { normal } else { -normal };
        let slack = slack([self.size(), point.amax()]);
        self.solid.exposes(self.member, &point, &outward, slack).then_some((point, normal))
    }
}

/// The areas of the sides of a box across each axis.
fn sides(size: &Vector3<f64>) -> Vector3<f64> {
    Vector3::new(size.y * size.z, size.z * size.x, size.x * size.y)
}

/// A random line that meets a box, starting outside: it enters each part of the surface in proportion to its area, with directions
/// distributed by the cosine of the angle of incidence.
fn line_into(Extent { min, max }: &Extent<3>, uniform: &mut dyn FnMut() -> f64) -> Line<3> {
    let size = max - min;
    let areas = sides(&(size * to_unit(size.amax())));
    let axis = pick(&sums(areas.iter().copied()), uniform);
    let mut inwards = Vector3::zeros();
    inwards[axis] = if uniform() < 0.5 { 1.0 } else { -1.0 };
    let mut point = min + Vector3::from_fn(|i, _| uniform() * size[i]);
    point[axis] = if inwards[axis] > 0.0 { min[axis] } else { max[axis] };
    let across = in_disk(&inwards, uniform);
    let velocity = across + inwards * libm::sqrt((1.0 - across.norm_squared()).max(0.0));
    Line { point: point - velocity * size.norm(), velocity }
}

/// The cumulative sums of some numbers.
fn sums(numbers: impl Iterator<Item = f64>) -> Vec<f64> {
    let add = |sum: &mut f64, number: f64| {
        *sum += number;
        Some(*sum)
    };
    numbers.scan(0.0, add).collect()
}

/// A random index, with probabilities proportional to the numbers that have these cumulative sums.
fn pick(sums: &[f64], uniform: &mut dyn FnMut() -> f64) -> usize {
    let share = uniform() * sums[sums.len() - 1];
    sums.partition_point(|sum| *sum <= share).min(sums.len() - 1)
}

impl Body {
    /// Where a line that starts outside a convex body enters it, and the outward normal there.
    fn entered(&self, path: &Line<3>) -> Option<(Vector3<f64>, Vector3<f64>)> {
        match self {
            Body::Convex(convex, _) => convex.entry(path).map(|(time, face)| convex.land(face, &path.at(time))),
            Body::Rounded(rounded) => rounded.first(path, Side::Outside).map(|time| rounded.land(&path.at(time))),
            Body::Mesh(..) | Body::Parallel(_) | Body::Distance(_) => None,
        }
    }
}
