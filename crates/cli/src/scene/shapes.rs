//! Shapes beyond segments, arcs and ellipses: `shape = { name = "capsule", … }` in a boundary entry.

use std::borrow::Cow;
use std::collections::HashSet;

use billiards::geometry::parry::{Placed, ShapeSpec, SolidSpec};

use super::list;
use super::parameters::{self, Arguments, Kind, Model, Parameter};
use crate::document::{Item, Problems, Section, Spanned};

const CENTER2: Parameter = Parameter::with_default("center", Kind::Point, &[0.0, 0.0]);
const CENTER3: Parameter = Parameter::with_default("center", Kind::Point, &[0.0, 0.0, 0.0]);
const ANGLE: Parameter = Parameter::with_default("angle", Kind::Real, &[0.0]);
const ROUNDING: Parameter = Parameter::with_default("rounding", Kind::Distance, &[0.0]);
const RADIUS: Parameter = Parameter::required("radius", Kind::Length);
const FROM: Parameter = Parameter::required("from", Kind::Point);
const TO: Parameter = Parameter::required("to", Kind::Point);
const HEIGHT: Parameter = Parameter::required("height", Kind::Length);
const NORMAL: Parameter = Parameter::required("normal", Kind::Direction);
const TRIANGLES: Parameter = Parameter::required("triangles", Kind::Triples);
const CORNERS: Parameter = Parameter::required("points", Kind::Points { least: 3, most: 3 });

const fn points(least: usize) -> Parameter {
    Parameter::required("points", Kind::Points { least, most: usize::MAX })
}

const fn shape(name: &'static str, dimension: usize, summary: &'static str, parameters: &'static [Parameter]) -> Model {
    Model { name, dimension, summary, parameters: Cow::Borrowed(parameters) }
}

/// Every shape a boundary entry can name. Planar shapes are turned by `angle` and then moved by `center`; `rounding` is
/// the radius of a disk or ball that is added around the shape.
pub const SHAPES: &[Model] = &[
    shape("ball", 2, "a disk", &[CENTER2, ANGLE, RADIUS]),
    shape("cuboid", 2, "a rectangle", &[CENTER2, ANGLE, Parameter::required("size", Kind::Lengths(2)), ROUNDING]),
    shape("capsule", 2, "all points within a radius of a segment", &[CENTER2, ANGLE, FROM, TO, RADIUS]),
    shape("segment", 2, "a straight wall with two sides", &[CENTER2, ANGLE, FROM, TO]),
    shape("triangle", 2, "a triangle", &[CENTER2, ANGLE, CORNERS, ROUNDING]),
    shape("convex-polygon", 2, "a convex polygon, by its corners in order", &[CENTER2, ANGLE, points(3), ROUNDING]),
    shape("polygon", 2, "any simple polygon, by its corners in order", &[CENTER2, ANGLE, points(3), ROUNDING]),
    shape("polyline", 2, "an open chain of segments, a wall with two sides", &[CENTER2, ANGLE, points(2), ROUNDING]),
    shape("half-space", 2, "all points behind a line; the normal points out of it", &[CENTER2, ANGLE, NORMAL]),
    shape(
        "trimesh",
        2,
        "triangles; its walls are the edges that belong to one triangle only",
        &[CENTER2, ANGLE, points(3), TRIANGLES],
    ),
    shape(
        "heightfield",
        2,
        "a graph over -size_1/2 < x < size_1/2, heights in units of size_2; at its ends it must be continued by rays, other pieces or a lattice",
        &[
            CENTER2,
            ANGLE,
            Parameter::required("heights", Kind::Reals(2)),
            Parameter::with_default("size", Kind::Lengths(2), &[1.0, 1.0]),
        ],
    ),
    shape("compound", 2, "the union of the shapes in the list \"shapes\"", &[CENTER2, ANGLE]),
    shape("ball", 3, "a ball", &[CENTER3, RADIUS]),
    shape(
        "cuboid",
        3,
        "a box with edges along the axes",
        &[CENTER3, Parameter::required("size", Kind::Lengths(3)), ROUNDING],
    ),
    shape("capsule", 3, "all points within a radius of a segment", &[CENTER3, FROM, TO, RADIUS]),
    shape("cylinder", 3, "a cylinder with its axis along x3", &[CENTER3, RADIUS, HEIGHT, ROUNDING]),
    shape("cone", 3, "a cone with its axis along x3, apex up", &[CENTER3, RADIUS, HEIGHT, ROUNDING]),
    shape("convex-hull", 3, "the convex hull of points", &[CENTER3, points(4), ROUNDING]),
    shape("half-space", 3, "all points behind a plane; the normal points out of it", &[CENTER3, NORMAL]),
    shape("trimesh", 3, "bounded by triangles, counter-clockwise from outside", &[CENTER3, points(4), TRIANGLES]),
];

/// A shape, ready to bound a table.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// In the plane.
    Planar {
        /// Its name.
        name: &'static str,
        /// The shape in its place.
        placed: Placed,
    },
    /// In space.
    Spatial {
        /// Its name.
        name: &'static str,
        /// The shape.
        spec: SolidSpec,
        /// Where it is.
        center: [f64; 3],
    },
}

/// Reads a shape and the lengths that define it; the section's keys that belong to it are then known.
pub(super) fn read(
    section: &mut Section<'_>,
    item: &Item,
    n: usize,
    problems: &mut Problems,
) -> Option<(Shape, Vec<f64>)> {
    let model = parameters::model(item, "shape", SHAPES, n, problems)?;
    let members = if model.name == "compound" {
        let item = section.required("shapes", "shapes = [{ name = \"ball\", radius = 1 }, ...]")?;
        compound(item, problems)
    } else {
        Some((vec![], vec![]))
    };
    let arguments = parameters::arguments(section, item.span, model, problems)?;
    let (members, mut lengths) = members?;
    if let Some(end) = ring(model.name, n, &arguments) {
        problems.add(
            end.span,
            "this polyline ends where it begins and would be solid inside: take \"polygon\" for that, or two polylines for a wall with two sides all around",
        );
        return None;
    }
    for parameter in model.parameters.iter().filter(|p| p.is_length()) {
        lengths.extend(arguments.numbers(parameter.name));
        lengths.extend(arguments.points(parameter.name).iter().flat_map(|p| &p.value));
    }
    let name = model.name;
    let shape = if n == 2 {
        let spec = if name == "compound" { ShapeSpec::Compound(members) } else { planar(name, &arguments) };
        let placed =
            Placed { shape: spec, translation: pair(arguments.numbers("center")), rotation: arguments.number("angle") };
        Shape::Planar { name, placed }
    } else {
        Shape::Spatial { name, spec: spatial(name, &arguments), center: triple(arguments.numbers("center")) }
    };
    Some((shape, lengths))
}

/// The last point of a planar chain without thickness, if it repeats the first one after others that each occur once.
fn ring<'a>(name: &str, n: usize, arguments: &'a Arguments) -> Option<&'a Spanned<Vec<f64>>> {
    if name != "polyline" || n != 2 || arguments.numbers("rounding").first().is_some_and(|r| *r > 0.0) {
        return None;
    }
    let [first, inner @ .., last] = arguments.points("points") else { return None };
    let is_once = || {
        let mut known = HashSet::from([pair(&first.value).map(f64::to_bits)]);
        inner.iter().all(|point| known.insert(pair(&point.value).map(f64::to_bits)))
    };
    (inner.len() > 1 && first.value == last.value && is_once()).then_some(last)
}

fn compound(item: &Item, problems: &mut Problems) -> Option<(Vec<Placed>, Vec<f64>)> {
    let (mut members, mut lengths) = (vec![], vec![]);
    for member in list(item, "shapes", problems)? {
        let mut section = Section::inline(member, "a shape", "{ name = \"ball\", radius = 1 }", problems)?;
        let name = section.required("name", "name = \"ball\"")?;
        let (shape, of_member) = read(&mut section, name, 2, problems)?;
        section.finish(problems);
        lengths.extend(of_member);
        if let Shape::Planar { placed, .. } = shape {
            members.push(placed);
        }
    }
    if members.is_empty() {
        problems.add(item.span, "a compound has at least one shape");
        return None;
    }
    Some((members, lengths))
}

fn pair(numbers: &[f64]) -> [f64; 2] {
    [0, 1].map(|i| numbers.get(i).copied().unwrap_or(0.0))
}

fn triple(numbers: &[f64]) -> [f64; 3] {
    [0, 1, 2].map(|i| numbers.get(i).copied().unwrap_or(0.0))
}

fn triples(arguments: &Arguments) -> Vec<[usize; 3]> {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked when it was read")]
    arguments.numbers("triangles").chunks_exact(3).map(|t| [t[0] as usize, t[1] as usize, t[2] as usize]).collect()
}

fn planar(name: &str, arguments: &Arguments) -> ShapeSpec {
    let points = |name: &str| arguments.points(name).iter().map(|p: &Spanned<Vec<f64>>| pair(&p.value));
    let corners: Vec<_> = points("points").collect();
    let rounding = arguments.numbers("rounding").first().copied().unwrap_or(0.0);
    let (from, to) = (pair(arguments.numbers("from")), pair(arguments.numbers("to")));
    match (name, rounding > 0.0) {
        ("ball", _) => ShapeSpec::Ball { radius: arguments.number("radius") },
        ("cuboid", round) => {
            let half_extents = pair(arguments.numbers("size")).map(|x| 0.5 * x);
            if round {
                ShapeSpec::RoundCuboid { half_extents, border_radius: rounding }
            } else {
                ShapeSpec::Cuboid { half_extents }
            }
        }
        ("capsule", _) => ShapeSpec::Capsule { a: from, b: to, radius: arguments.number("radius") },
        ("segment", _) => ShapeSpec::Segment { a: from, b: to },
        ("triangle", round) => {
            let vertices = [0, 1, 2].map(|i| corners.get(i).copied().unwrap_or_default());
            if round {
                ShapeSpec::RoundTriangle { vertices, border_radius: rounding }
            } else {
                ShapeSpec::Triangle { vertices }
            }
        }
        ("convex-polygon", false) => ShapeSpec::ConvexPolygon { vertices: corners },
        ("convex-polygon", true) => ShapeSpec::RoundConvexPolygon { vertices: corners, border_radius: rounding },
        ("polygon" | "polyline", round) => {
            let closed = name == "polygon";
            if round { rounded(corners, closed, rounding) } else { ShapeSpec::Polyline { vertices: corners, closed } }
        }
        ("half-space", _) => ShapeSpec::HalfSpace { normal: pair(arguments.numbers("normal")) },
        ("trimesh", _) => ShapeSpec::TriMesh { vertices: corners, triangles: triples(arguments) },
        _ => ShapeSpec::HeightField {
            heights: arguments.numbers("heights").to_vec(),
            scale: pair(arguments.numbers("size")),
        },
    }
}

/// All points within a radius of a chain of segments, or of the polygon that it bounds.
fn rounded(corners: Vec<[f64; 2]>, closed: bool, radius: f64) -> ShapeSpec {
    let n = corners.len();
    let edges = (0..if closed { n } else { n - 1 }).map(|i| [corners[i], corners[(i + 1) % n]]);
    let capsules = edges.map(|[a, b]| ShapeSpec::Capsule { a, b, radius });
    let mut members: Vec<Placed> = capsules.map(Placed::from).collect();
    if closed {
        members.push(ShapeSpec::Polyline { vertices: corners, closed }.into());
    }
    ShapeSpec::Compound(members)
}

fn spatial(name: &str, arguments: &Arguments) -> SolidSpec {
    let points: Vec<_> = arguments.points("points").iter().map(|p| triple(&p.value)).collect();
    let rounding = arguments.numbers("rounding").first().copied().unwrap_or(0.0);
    let (radius, height) = (arguments.number("radius"), arguments.number("height"));
    match name {
        "ball" => SolidSpec::Ball { radius },
        "cuboid" => SolidSpec::Cuboid { size: triple(arguments.numbers("size")), rounding },
        "capsule" => {
            let (from, to) = (triple(arguments.numbers("from")), triple(arguments.numbers("to")));
            SolidSpec::Capsule { from, to, radius }
        }
        "cylinder" => SolidSpec::Cylinder { radius, height, rounding },
        "cone" => SolidSpec::Cone { radius, height, rounding },
        "convex-hull" => SolidSpec::ConvexHull { points, rounding },
        "trimesh" => SolidSpec::TriMesh { vertices: points, triangles: triples(arguments), margin: 0.0 },
        _ => SolidSpec::HalfSpace { normal: triple(arguments.numbers("normal")) },
    }
}
