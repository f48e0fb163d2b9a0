//! Polygons are not ergodic.
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::{ALL, UNIFORM},
    motion::{Bounce, State, bounces, no_slip},
    random::Stream,
    statistics::{Range, least, worst},
    wedge::{bounded_start, inradius},
};
use billiards::geometry::{Table, Vector2, tables};

pub(super) const CLAIM: Claim = Claim {
    name: "corner-components",
    place: "Section 1",
    statement: "No-slip billiards on polygons appear never to be ergodic.",
    verdict: Verdict::HoldsCorrected(
        "They never are, and this can be proved: every polygon has a corner of less than π, and near its tip the orbits with non-escape velocities never leave its \
         two sides. Because I = l (v·ν) is invariant, an orbit whose velocity is within r < ρ of the axis stays within the distance I/sin(ρ−r) of the \
         corner. Such orbits form an invariant set of positive measure near every such corner.",
    ),
    general_gamma: Some("For every γ > 0."),
    measure,
};

/// What orbits do that start where the invariant keeps them at a corner.
pub(super) struct Corner {
    /// How many leave its two sides.
    pub(super) left: usize,
    /// The greatest distance over the bound.
    pub(super) reach: f64,
    /// `sin(ρ − r)`
    sine: f64,
}

/// The sides of a corner, given by its vertex and its neighbours, table on the left from `before` to `vertex` to `after`. The orbits are kept within two
/// fifths of the shorter side. (The neighbours of a vertex between curved sides are points on the tangents; the bound holds in the limit of small sides.)
pub(super) fn corner(
    table: &Table,
    gamma_squared: f64,
    [before, vertex, after]: [Vector2<f64>; 3],
    orbits: usize,
    collisions: usize,
    seed: u64,
) -> Corner {
    let billiard = no_slip::<billiards::geometry::Error>(Ok(table.clone()), gamma_squared);
    let (a, b) = (after - vertex, before - vertex);
    let theta = libm::atan2(a.perp(&b), a.dot(&b));
    // the bisector is the wedge's second axis
    let up = (a / libm::hypot(a.x, a.y) + b / libm::hypot(b.x, b.y)) / (2.0 * libm::cos(0.5 * theta));
    let across = Vector2::new(up.y, -up.x);
    let rho = inradius(theta, gamma_squared);
    let part = 0.8;
    let sine = libm::sin((1.0 - part) * rho);
    let side = libm::hypot(a.x, a.y).min(libm::hypot(b.x, b.y));
    let (mut left, mut reach) = (0, Range::EMPTY);
    for sample in 0..orbits {
        let State { v: [v0, v1, v2], .. } = bounded_start(theta, gamma_squared, part, &mut Stream::new(seed, sample));
        // on the bisector at a height h the angular momentum about the corner is h v₁
        let height = 0.4 * side * sine / v1.abs();
        let (x, v) = (vertex + up * height, across * v1 + up * v2);
        let orbit = bounces(&billiard, State { x: [0.0, x.x, x.y], v: [v0, v.x, v.y] }, collisions);
        let sides = [orbit[0].piece, orbit[1].piece];
        left += usize::from(orbit.len() < collisions || orbit.iter().any(|hit| !sides.contains(&hit.piece)));
        let bound = height * v1.abs() / sine;
        let far = |hit: &Bounce| libm::hypot(hit.state.x[1] - vertex.x, hit.state.x[2] - vertex.y) / bound;
        reach.add(worst(orbit.iter().map(far)));
    }
    Corner { left, reach: reach.max, sine }
}

fn measure(effort: Effort) -> Measurement {
    let (polygons, orbits, collisions) = (effort.of(10, 100), effort.of(5, 20), effort.of(2000, 20_000));
    let mut corners = vec![];
    for sample in 0..polygons {
        let mut stream = Stream::new(180, sample);
        // triangles with no angle near 0 or π
        let vertices = loop {
            let mut vertex = || Vector2::new(stream.uniform(), stream.uniform());
            let triangle = [vertex(), vertex(), vertex()];
            let [a, b, c] = triangle;
            if (b - a).perp(&(c - a)) > 0.2 {
                break triangle;
            }
        };
        let table = tables::triangle(vertices).expect("a triangle");
        let gamma_squared = ALL[sample % 4];
        for k in 0..3 {
            let at = [vertices[(k + 2) % 3], vertices[k], vertices[(k + 1) % 3]];
            corners.push(corner(&table, gamma_squared, at, orbits, collisions, 181 + sample as u64));
        }
    }
    for sides in 4..=8 {
        let table = tables::polygon(sides, 1.0).expect("a polygon");
        let vertex = |k: usize| table.pieces()[k % sides].point_at(0.0);
        corners.push(corner(&table, UNIFORM, [vertex(0), vertex(1), vertex(2)], orbits, collisions, 182));
    }
    let all = corners.len();
    // a hit changes I by some ten roundings over v·ν, which is sin(ρ−r) or more
    let rounding = 16.0 * f64::EPSILON * collisions as f64 / least(corners.iter().map(|corner| corner.sine));
    let reach = worst(corners.iter().map(|corner| corner.reach));
    [
        Quantity::count(
            format!(
                "orbits of {} that leave their corner, {all} corners, four values of γ, {collisions} collisions",
                all * orbits
            ),
            corners.iter().map(|corner| corner.left).sum(),
            0,
        ),
        Quantity::at_most("greatest distance from the corner over the bound I/sin(ρ−r)", reach, 1.0, rounding),
    ]
    .into()
}
