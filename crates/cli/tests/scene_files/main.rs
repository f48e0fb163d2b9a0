//! Scene files: what is accepted, and what each mistake is called.
#![allow(clippy::float_cmp, clippy::unwrap_used, reason = "tests claim exact values")]

mod drawn;
mod mends;
mod mistakes;
mod nonsense;
mod read;

use billiards_cli::document::Source;
use billiards_cli::scene::{Request, Scene};

const NAMED: &str = r#"
title = "No-slip stadium"
law   = "no-slip"

[table]
name = "stadium"
half_length = 1
radius = "2/2"

[particle]
radius  = 0
inertia = "uniform-disk"

[[orbit]]
position = [0.1, "sqrt(2)/4"]
velocity = [0.6, 0.8]
spin     = 0.25
angle    = 0

[run]
collisions = 1000

[output]
collisions = "csv"
pictures   = ["orbit", "velocity-portrait"]
"#;

/// A scene with no more sections than it needs.
const SQUARE: &str = r#"
law = "specular"
table = { name = "square" }
orbit = [{ position = [0.25, 0.5], velocity = [1, 0.5] }]
run = { collisions = 1 }
"#;

const BOUNDARY: &str = r#"
law = "no-slip"
[table]
lattice = [[10, 0], [0, 10]]
[[table.boundary]]
loop = { from = [-1, -1], edges = [
  { line_to = [1, -1] },
  { arc_to = [1, 1], center = [1, 0], turn = "ccw" },
  { line_to = [-1, 1], law = "specular" },
  { arc_to = [-1, -1], center = [-1, 0], turn = "ccw" },
] }
[[table.boundary]]
circle = { center = [0, 0], radius = 0.25, domain = "outside" }
[[table.boundary]]
ellipse = { center = [0, 0], semi_axes = [2, 1], angle = 0, domain = "inside" }
[[table.boundary]]
line = { through = [0, 0], direction = [1, 0] }
[[table.boundary]]
ray = { from = [0, 0], direction = ["sin(pi/6)", "cos(pi/6)"], domain = "left" }
[[table.boundary]]
curve = { polar = "1+0.2*cos(5*t)" }
law = { name = "restitution", normal = 0.9, tangential = 0 }
[[table.boundary]]
curve = { implicit = "x^2/4+y^2-1", within = [[-3, -2], [3, 2]], domain = "outside" }
[[table.boundary]]
shape = { name = "capsule", from = [0, 0], to = [1, 0], radius = 0.1 }
[[table.boundary]]
outline = "island.svg"
[ensemble]
count = 1e5
seed = 18446744073709551615
sample = "canonical"
[run]
time = 250.0
"#;

const SPATIAL: &str = r#"
rough = [[1, 2, -3]]
[table]
dimension = 3
name = "box"
laws = { 4 = "specular", 5 = { name = "random", rank = 1 } }
[particle]
gamma_squared = "2/5"
[[orbit]]
position = [0.5, 0.5, 0.5]
velocity = [0.6, 0, 0.8]
spin = [0, 0.25, 0]
[run]
collisions = 10
"#;

fn parse(text: &str) -> Result<Scene, Vec<String>> {
    Scene::parse(&Source::new("x.toml", text), &Request::default()).map_err(|errors| {
        errors
            .iter()
            .map(|e| {
                let (line, column) = e.place().map_or((0, 0), |p| (p.line, p.column));
                format!("{line}:{column}: {}", e.what)
            })
            .collect()
    })
}

/// The valid scene with one replacement, and the errors of that.
fn errors_of(valid: &str, old: &str, new: &str) -> Vec<String> {
    assert!(valid.contains(old), "{old}");
    parse(&valid.replacen(old, new, 1)).expect_err(new)
}
