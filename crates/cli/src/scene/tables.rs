//! The built-in tables, by name.

use super::parameters::{Kind, Model, Parameter};

const fn required(name: &'static str, kind: Kind) -> Parameter {
    Parameter::required(name, kind)
}

const fn default(name: &'static str, kind: Kind, numbers: &'static [f64]) -> Parameter {
    Parameter::with_default(name, kind, numbers)
}

const fn planar(
    name: &'static str,
    summary: &'static str,
    placement: &'static str,
    parameters: &'static [Parameter],
) -> Model {
    Model { name, dimension: 2, summary, placement, parameters }
}

const fn spatial(
    name: &'static str,
    summary: &'static str,
    placement: &'static str,
    parameters: &'static [Parameter],
) -> Model {
    Model { name, dimension: 3, summary, placement, parameters }
}

/// Every built-in table.
pub const TABLES: &[Model] = &[
    planar(
        "strip",
        "two parallel lines",
        "0 < x2 < width; pieces: 0 lower, 1 upper",
        &[default("width", Kind::Length, &[1.0])],
    ),
    planar(
        "wedge",
        "the infinite wedge between two rays",
        "apex at the origin, bisector +x2; pieces: 0 right wall (x1 > 0), 1 left",
        &[required("angle", Kind::Real)],
    ),
    planar("circle", "a disk", "centre at the origin", &[default("radius", Kind::Length, &[1.0])]),
    planar("ellipse", "an ellipse", "centre at the origin", &[default("semi_axes", Kind::Lengths(2), &[2.0, 1.0])]),
    planar(
        "square",
        "a square",
        "corner at the origin; pieces: 0 bottom, then counter-clockwise",
        &[default("side", Kind::Length, &[1.0])],
    ),
    planar(
        "rectangle",
        "a rectangle",
        "corner at the origin; pieces: 0 bottom, then counter-clockwise",
        &[default("size", Kind::Lengths(2), &[2.0, 1.0])],
    ),
    planar(
        "equilateral",
        "an equilateral triangle",
        "vertices (0, 0), (side, 0), apex above; piece i from vertex i to i+1",
        &[default("side", Kind::Length, &[1.0])],
    ),
    planar(
        "isosceles",
        "an isosceles triangle",
        "vertices (-base/2, 0), (base/2, 0), (0, height); piece i from vertex i to i+1",
        &[default("base", Kind::Length, &[1.0]), default("height", Kind::Length, &[1.25])],
    ),
    planar("triangle", "any triangle", "piece i from vertex i to i+1", &[required("vertices", Kind::Points(3))]),
    planar(
        "hexagon",
        "a regular hexagon",
        "centre at the origin, vertex 0 on the +x1 axis; piece i from vertex i to i+1",
        &[default("side", Kind::Length, &[1.0])],
    ),
    planar(
        "polygon",
        "a regular polygon",
        "centre at the origin, vertex 0 on the +x1 axis; piece i from vertex i to i+1",
        &[required("sides", Kind::Count(3)), default("side", Kind::Length, &[1.0])],
    ),
    planar(
        "perturbed-polygon",
        "a regular polygon whose sides are bent smoothly (C2) by a relative amount",
        "centre at the origin, vertex 0 on the +x1 axis; piece i from vertex i to i+1",
        &[
            default("sides", Kind::Count(3), &[5.0]),
            default("side", Kind::Length, &[1.0]),
            required("amount", Kind::Real),
        ],
    ),
    planar(
        "stadium",
        "two half circles joined by straight sides",
        "centre at the origin; pieces: 0 bottom side, 1 right cap, 2 top, 3 left",
        &[default("half_length", Kind::Length, &[1.0]), default("radius", Kind::Length, &[1.0])],
    ),
    planar(
        "mushroom",
        "a half disk on a rectangular stem",
        "cap's centre at the origin, stem below; pieces: 0 stem bottom, 1 stem right, 2 floor right, 3 cap, 4 floor left, 5 stem left",
        &[
            default("cap_radius", Kind::Length, &[1.0]),
            default("stem_width", Kind::Length, &[0.5]),
            default("stem_height", Kind::Length, &[0.75]),
        ],
    ),
    planar(
        "pocket",
        "a rectangle with a circular pocket; pocket_depth: how far the pocket's centre lies above the top side",
        "corner at the origin, pocket in the middle of the top side; pieces: 0 bottom, 1 right, 2 top right, 3 pocket, 4 top left, 5 left",
        &[
            default("size", Kind::Lengths(2), &[2.0, 1.0]),
            default("pocket_radius", Kind::Length, &[0.3125]),
            default("pocket_depth", Kind::Real, &[0.25]),
        ],
    ),
    planar(
        "moon",
        "a disk with a disk bitten out of its edge",
        "outer centre at the origin, bite's on the +x1 axis; pieces: 0 outer arc, 1 bite",
        &[
            default("radius", Kind::Length, &[1.0]),
            default("bite_radius", Kind::Length, &[0.75]),
            default("bite_distance", Kind::Length, &[1.0]),
        ],
    ),
    planar(
        "flower",
        "petals: circular arcs between corners on a circle",
        "corners on a circle about the origin; pieces: 0 the petal about the +x1 axis, then counter-clockwise",
        &[default("petals", Kind::Count(3), &[4.0]), default("petal_radius", Kind::Length, &[1.25])],
    ),
    planar(
        "sinai",
        "a square with a disk in its middle",
        "corner at the origin; pieces: 0 bottom, then counter-clockwise, 4 the disk",
        &[default("side", Kind::Length, &[1.0]), default("radius", Kind::Length, &[0.25])],
    ),
    planar(
        "sinai-torus",
        "a disk on the flat torus",
        "unit cell [0, 1) x [0, 1), disk at (1/2, 1/2)",
        &[default("radius", Kind::Length, &[0.25])],
    ),
    planar(
        "lorentz",
        "disks on the hexagonal lattice (Lorentz gas)",
        "a disk at every lattice point",
        &[required("radius", Kind::Length), default("spacing", Kind::Length, &[1.0])],
    ),
    planar(
        "channel",
        "a periodic channel between arcs, concave (sagitta > 0) or convex (< 0)",
        "upper and lower arcs, ends identified",
        &[
            default("length", Kind::Length, &[1.0]),
            default("height", Kind::Length, &[1.0]),
            required("sagitta", Kind::Real),
        ],
    ),
    spatial(
        "slab",
        "the space between two parallel planes",
        "0 < x3 < height; pieces: 0 floor, 1 ceiling",
        &[default("height", Kind::Length, &[1.0])],
    ),
    spatial(
        "box",
        "a rectangular box",
        "0 < xi < size_i; piece 2*axis + side",
        &[default("size", Kind::Lengths(3), &[1.0, 1.0, 1.0])],
    ),
    spatial("ball", "the inside of a sphere", "centre at the origin", &[default("radius", Kind::Length, &[1.0])]),
];
