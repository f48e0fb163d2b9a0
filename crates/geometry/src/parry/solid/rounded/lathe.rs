//! Solids of revolution.
use super::{Core, View};
use crate::{Error, Extent, parry::convert::Frame, plane::has_square};
use nalgebra::{Vector2, Vector3};
use parry3d_f64::shape::{Cone, Cylinder};

/// The solid swept by a convex polygon that turns about an axis.
#[derive(Debug)]
pub(super) struct Lathe {
    center: Vector3<f64>,
    /// Of length 1.
    axis: Vector3<f64>,
    /// The sides that do not lie on the axis, from below upwards.
    sides: Vec<Side>,
}

/// A side of the polygon; its first coordinate is the distance from the axis, its second the height.
#[derive(Clone, Copy, Debug)]
struct Side {
    ends: [Vector2<f64>; 2],
    length: f64,
    /// Unit vector from the first end to the second.
    along: Vector2<f64>,
}

impl Side {
    /// How far a point lies beyond the side, to its right.
    fn beyond(&self, p: &Vector2<f64>) -> f64 {
        self.outward().dot(&(p - self.ends[0]))
    }
    fn outward(&self) -> Vector2<f64> {
        Vector2::new(self.along.y, -self.along.x)
    }
}

impl Lathe {
    pub(super) fn cylinder(cylinder: &Cylinder, frame: &Frame<3>) -> Result<Lathe, Error> {
        let (half, radius) = (cylinder.half_height, cylinder.radius);
        Lathe::new(half, radius, &[[0.0, -half], [radius, -half], [radius, half], [0.0, half]], frame)
    }
    pub(super) fn cone(cone: &Cone, frame: &Frame<3>) -> Result<Lathe, Error> {
        let (half, radius) = (cone.half_height, cone.radius);
        Lathe::new(half, radius, &[[0.0, -half], [radius, -half], [0.0, half]], frame)
    }

    fn new(half: f64, radius: f64, corners: &[[f64; 2]], frame: &Frame<3>) -> Result<Lathe, Error> {
        has_square("the height", 2.0 * half)?;
        has_square("the radius", radius)?;
        let side = |pair: &[[f64; 2]]| {
            let ends = [pair[0], pair[1]].map(Vector2::from);
            let along = ends[1] - ends[0];
            let length = libm::hypot(along.x, along.y);
            Side { ends, length, along: along / length }
        };
        let sides = corners.windows(2).map(side).collect();
        Ok(Lathe { center: frame.translation, axis: frame.direction(&Vector3::y()), sides })
    }

    /// A point's distance from the axis and its height, and the unit vector that leads to it from the axis.
    fn section(&self, x: &Vector3<f64>) -> (Vector2<f64>, Vector3<f64>) {
        let w = x - self.center;
        let height = w.dot(&self.axis);
        let across = w - self.axis * height;
        let distance = across.norm();
        let out = if distance > 0.0 { across / distance } else { crate::surface::any_across(&self.axis) };
        (Vector2::new(distance, height), out)
    }

    fn in_space(&self, height: f64, normal: Vector2<f64>, out: &Vector3<f64>) -> View {
        View { height, normal: out * normal.x + self.axis * normal.y }
    }
}

impl Core for Lathe {
    fn outer(&self, x: &Vector3<f64>) -> View {
        let (p, out) = self.section(x);
        let above = |side: &&Side| {
            let s = side.along.dot(&(p - side.ends[0]));
            0.0 <= s && s <= side.length && side.beyond(&p) > 0.0
        };
        if let Some(side) = self.sides.iter().find(above) {
            return self.in_space(side.beyond(&p), side.outward(), &out);
        }
        let away = self.sides.iter().flat_map(|side| side.ends).map(|corner| p - corner);
        let away = away.min_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared())).unwrap_or(p);
        let distance = away.norm();
        if distance > 0.0 {
            self.in_space(distance, away / distance, &out)
        } else {
            self.in_space(0.0, Vector2::x(), &out)
        }
    }

    fn inner(&self, x: &Vector3<f64>) -> Option<View> {
        let (p, out) = self.section(x);
        let outmost = self.sides.iter().max_by(|a, b| a.beyond(&p).total_cmp(&b.beyond(&p)))?;
        let height = outmost.beyond(&p);
        (height <= 0.0).then(|| self.in_space(height, outmost.outward(), &out))
    }

    fn extent(&self) -> Extent<3> {
        let corners = self.sides.iter().flat_map(|side| side.ends);
        let reach = corners.fold(Vector3::zeros(), |reach: Vector3<f64>, corner| {
            // a circle's reach along a coordinate axis is its radius times the length of that axis
            // projected onto its plane
            let of_circle = self.axis.map(|a| corner.x * libm::sqrt((1.0 - a * a).max(0.0)));
            reach.sup(&(self.axis.abs() * corner.y.abs() + of_circle))
        });
        Extent { min: self.center - reach, max: self.center + reach }
    }
}
