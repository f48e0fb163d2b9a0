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

/// How a shape is built from its parameters.
#[derive(Clone, Copy, Debug)]
pub enum Build {
    /// A shape of the plane.
    Planar(fn(&Arguments) -> ShapeSpec),
    /// The union of the shapes in its list `shapes`.
    Union,
    /// A solid.
    Spatial(fn(&Arguments) -> SolidSpec),
}

type Parameters = &'static [Parameter];

const fn planar(
    name: &'static str,
    summary: &'static str,
    parameters: Parameters,
    build: fn(&Arguments) -> ShapeSpec,
) -> Model<Build> {
    Model { name, dimension: 2, summary, parameters: Cow::Borrowed(parameters), build: Build::Planar(build) }
}

const fn spatial(
    name: &'static str,
    summary: &'static str,
    parameters: Parameters,
    build: fn(&Arguments) -> SolidSpec,
) -> Model<Build> {
    Model { name, dimension: 3, summary, parameters: Cow::Borrowed(parameters), build: Build::Spatial(build) }
}

/// Every shape a boundary entry can name. Planar shapes are turned by `angle` and then moved by `center`; `rounding` is
/// the radius of a disk or ball that is added around the shape.
pub const SHAPES: &[Model<Build>] = &[
    planar("ball", "a disk", &[CENTER2, ANGLE, RADIUS], |a| ShapeSpec::Ball { radius: a.number("radius") }),
    planar("cuboid", "a rectangle", &[CENTER2, ANGLE, Parameter::required("size", Kind::Lengths(2)), ROUNDING], |a| {
        let half_extents = pair(a.numbers("size")).map(|x| 0.5 * x);
        match rounding(a) {
            0.0 => ShapeSpec::Cuboid { half_extents },
            border_radius => ShapeSpec::RoundCuboid { half_extents, border_radius },
        }
    }),
    planar("capsule", "all points within a radius of a segment", &[CENTER2, ANGLE, FROM, TO, RADIUS], |a| {
        let (from, to) = (pair(a.numbers("from")), pair(a.numbers("to")));
        ShapeSpec::Capsule { a: from, b: to, radius: a.number("radius") }
    }),
    planar("segment", "a straight wall with two sides", &[CENTER2, ANGLE, FROM, TO], |a| ShapeSpec::Segment {
        a: pair(a.numbers("from")),
        b: pair(a.numbers("to")),
    }),
    planar("triangle", "a triangle", &[CENTER2, ANGLE, CORNERS, ROUNDING], |a| {
        let corners = corners(a);
        let vertices = [0, 1, 2].map(|i| corners.get(i).copied().unwrap_or_default());
        match rounding(a) {
            0.0 => ShapeSpec::Triangle { vertices },
            border_radius => ShapeSpec::RoundTriangle { vertices, border_radius },
        }
    }),
    planar(
        "convex-polygon",
        "a convex polygon, by its corners in order",
        &[CENTER2, ANGLE, points(3), ROUNDING],
        |a| match rounding(a) {
            0.0 => ShapeSpec::ConvexPolygon { vertices: corners(a) },
            border_radius => ShapeSpec::RoundConvexPolygon { vertices: corners(a), border_radius },
        },
    ),
    planar("polygon", "any simple polygon, by its corners in order", &[CENTER2, ANGLE, points(3), ROUNDING], |a| {
        chain(a, true)
    }),
    planar(
        "polyline",
        "an open chain of segments, a wall with two sides",
        &[CENTER2, ANGLE, points(2), ROUNDING],
        |a| chain(a, false),
    ),
    planar("half-space", "all points behind a line; the normal points out of it", &[CENTER2, ANGLE, NORMAL], |a| {
        ShapeSpec::HalfSpace { normal: pair(a.numbers("normal")) }
    }),
    planar(
        "trimesh",
        "triangles; its walls are the edges that belong to one triangle only",
        &[CENTER2, ANGLE, points(3), TRIANGLES],
        |a| ShapeSpec::TriMesh { vertices: corners(a), triangles: triples(a) },
    ),
    planar(
        "heightfield",
        "a graph over -size_1/2 < x < size_1/2, heights in units of size_2; at its ends it must be continued by rays, other pieces or a lattice",
        &[
            CENTER2,
            ANGLE,
            Parameter::required("heights", Kind::Reals(2)),
            Parameter::with_default("size", Kind::Lengths(2), &[1.0, 1.0]),
        ],
        |a| ShapeSpec::HeightField { heights: a.numbers("heights").to_vec(), scale: pair(a.numbers("size")) },
    ),
    Model {
        name: "compound",
        dimension: 2,
        summary: "the union of the shapes in the list \"shapes\"",
        parameters: Cow::Borrowed(&[CENTER2, ANGLE]),
        build: Build::Union,
    },
    spatial("ball", "a ball", &[CENTER3, RADIUS], |a| SolidSpec::Ball { radius: a.number("radius") }),
    spatial(
        "cuboid",
        "a box with edges along the axes",
        &[CENTER3, Parameter::required("size", Kind::Lengths(3)), ROUNDING],
        |a| SolidSpec::Cuboid { size: triple(a.numbers("size")), rounding: rounding(a) },
    ),
    spatial("capsule", "all points within a radius of a segment", &[CENTER3, FROM, TO, RADIUS], |a| {
        let (from, to) = (triple(a.numbers("from")), triple(a.numbers("to")));
        SolidSpec::Capsule { from, to, radius: a.number("radius") }
    }),
    spatial("cylinder", "a cylinder with its axis along x3", &[CENTER3, RADIUS, HEIGHT, ROUNDING], |a| {
        SolidSpec::Cylinder { radius: a.number("radius"), height: a.number("height"), rounding: rounding(a) }
    }),
    spatial("cone", "a cone with its axis along x3, apex up", &[CENTER3, RADIUS, HEIGHT, ROUNDING], |a| {
        SolidSpec::Cone { radius: a.number("radius"), height: a.number("height"), rounding: rounding(a) }
    }),
    spatial("convex-hull", "the convex hull of points", &[CENTER3, points(4), ROUNDING], |a| SolidSpec::ConvexHull {
        points: vertices(a),
        rounding: rounding(a),
    }),
    spatial("half-space", "all points behind a plane; the normal points out of it", &[CENTER3, NORMAL], |a| {
        SolidSpec::HalfSpace { normal: triple(a.numbers("normal")) }
    }),
    spatial("trimesh", "bounded by triangles, counter-clockwise from outside", &[CENTER3, points(4), TRIANGLES], |a| {
        SolidSpec::TriMesh { vertices: vertices(a), triangles: triples(a), margin: 0.0 }
    }),
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
    let members = if let Build::Union = model.build {
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
    let placed = |shape: ShapeSpec| Shape::Planar {
        name,
        placed: Placed { shape, translation: pair(arguments.numbers("center")), rotation: arguments.number("angle") },
    };
    let shape = match model.build {
        Build::Planar(build) => placed(build(&arguments)),
        Build::Union => placed(ShapeSpec::Compound(members)),
        Build::Spatial(build) => {
            Shape::Spatial { name, spec: build(&arguments), center: triple(arguments.numbers("center")) }
        }
    };
    Some((shape, lengths))
}

/// The last point of a planar chain without thickness, if it repeats the first one after others that each occur once.
fn ring<'a>(name: &str, n: usize, arguments: &'a Arguments) -> Option<&'a Spanned<Vec<f64>>> {
    if name != "polyline" || n != 2 || rounding(arguments) > 0.0 {
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
    for member in list(item, "shapes", "[{ name = \"ball\", radius = 1 }]", problems)? {
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

/// The radius of the disk or ball that is added around a shape \[L\].
fn rounding(arguments: &Arguments) -> f64 {
    arguments.numbers("rounding").first().copied().unwrap_or(0.0)
}

/// The points of a planar shape.
fn corners(arguments: &Arguments) -> Vec<[f64; 2]> {
    arguments.points("points").iter().map(|p| pair(&p.value)).collect()
}

/// The points of a solid.
fn vertices(arguments: &Arguments) -> Vec<[f64; 3]> {
    arguments.points("points").iter().map(|p| triple(&p.value)).collect()
}

/// A chain of segments, open or closed.
fn chain(arguments: &Arguments, closed: bool) -> ShapeSpec {
    match rounding(arguments) {
        0.0 => ShapeSpec::Polyline { vertices: corners(arguments), closed },
        radius => rounded(corners(arguments), closed, radius),
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
