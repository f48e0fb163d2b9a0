//! Shapes beyond segments, arcs and ellipses: `shape = { name = "capsule", … }` in a boundary entry.

use std::borrow::Cow;

use super::parameters::{Kind, Model, Parameter};

const CENTER2: Parameter = Parameter::with_default("center", Kind::Point, &[0.0, 0.0]);
const CENTER3: Parameter = Parameter::with_default("center", Kind::Point, &[0.0, 0.0, 0.0]);
const ANGLE: Parameter = Parameter::with_default("angle", Kind::Real, &[0.0]);
const ROUNDING: Parameter = Parameter::with_default("rounding", Kind::Distance, &[0.0]);
const RADIUS: Parameter = Parameter::required("radius", Kind::Length);
const FROM: Parameter = Parameter::required("from", Kind::Point);
const TO: Parameter = Parameter::required("to", Kind::Point);
const HEIGHT: Parameter = Parameter::required("height", Kind::Length);

const fn shape(name: &'static str, dimension: usize, summary: &'static str, parameters: &'static [Parameter]) -> Model {
    Model { name, dimension, summary, parameters: Cow::Borrowed(parameters) }
}

/// Every shape a boundary entry can name. `rounding` is the radius of a disk or ball that rolls around the shape.
pub const SHAPES: &[Model] = &[
    shape(
        "cuboid",
        2,
        "a rectangle of the given size about its centre, turned by an angle",
        &[CENTER2, Parameter::required("size", Kind::Lengths(2)), ANGLE, ROUNDING],
    ),
    shape("capsule", 2, "all points within a radius of a segment", &[FROM, TO, RADIUS]),
    shape("convex-hull", 2, "the convex hull of points", &[Parameter::required("points", Kind::Points(3)), ROUNDING]),
    shape("polygon", 2, "a simple polygon", &[Parameter::required("points", Kind::Points(3)), ROUNDING]),
    shape(
        "polyline",
        2,
        "an open chain of segments, a wall on both sides",
        &[Parameter::required("points", Kind::Points(2)), ROUNDING],
    ),
    shape(
        "cuboid",
        3,
        "a box of the given size about its centre",
        &[CENTER3, Parameter::required("size", Kind::Lengths(3)), ROUNDING],
    ),
    shape("capsule", 3, "all points within a radius of a segment", &[FROM, TO, RADIUS]),
    shape("cylinder", 3, "a cylinder with its axis along x3", &[CENTER3, RADIUS, HEIGHT, ROUNDING]),
    shape("cone", 3, "a cone with its axis along x3, apex up", &[CENTER3, RADIUS, HEIGHT, ROUNDING]),
    shape("convex-hull", 3, "the convex hull of points", &[Parameter::required("points", Kind::Points(4)), ROUNDING]),
];
