//! Velocities that escape from a wedge, on the sphere.
use super::super::camera::{Camera, dot, turn};
use super::super::sheet::{LABEL, Sheet};
use super::super::{Drawing, Effort, Figure};
use super::wedges::{HALF, bounded};
use crate::picture::{Anchor, Colour, ORBITS, Raster, Style};
use core::f64::consts::PI;
use paper::wedge;

pub(super) const FIGURE: Figure = Figure {
    name: "velocity-spheres",
    title: "Which velocities escape from a wedge",
    place: "Figure 13",
    caption: "The sphere of velocities (v₀, v₁, v₂). First: velocities that leave the wedge at once, or have come from outside (brown), a \
              double sector. Each collision turns the folded velocity by 2δ about the axis b. What the sector never covers (blue) never \
              escapes: a regular polygon with q sides if δ/π = p/q, here a square and a triangle, otherwise a disk bounded by a \
              caustic circle. Dots: the folded velocities of one orbit.",
    parameters: "θ = π/3 (twice: δ = π/4, q = 4), θ = 1.8235 (δ = π/3, q = 3) and θ = 1.3; uniform disk, γ² = 1/2. Each pixel is turned up to \
                 400 times (--quick 100).",
    draw,
};

/// Whether a flight with this velocity leaves the wedge, or came from outside.
fn is_free(v: [f64; 3], tan: f64) -> bool {
    v[1].abs() < v[2].abs() * tan
}

fn draw(effort: Effort) -> Drawing {
    let (turns, pixels, fine) = if effort == Effort::Quick { (100, 160, 2) } else { (400, 300, 3) };
    let triangle = wedge::opening_of_turn(2.0 * PI / 3.0).ok_or("no such wedge")?;
    let panels = [
        (PI / 3.0, "θ = π/3", false),
        (PI / 3.0, "θ = π/3", true),
        (triangle, "θ = 1.8235", true),
        (1.3, "θ = 1.3", true),
    ];
    let side = 80.0;
    let mut sheet = Sheet::new(4.0 * (side + 4.0) + 2.0, side + 20.0);
    for (i, (theta, name, all)) in panels.into_iter().enumerate() {
        let corner = [3.0 + (side + 4.0) * i as f64, 3.0];
        let axis = wedge::axis(theta, HALF);
        let towards = libm::atan2(axis[1], axis[0]) * 180.0 / PI;
        let camera = Camera::at(towards - 22.0, 18.0);
        let delta = wedge::delta(theta, HALF);
        let tan = libm::tan(0.5 * theta);
        let [brown, blue, pale] = [Colour(0xd9, 0xa0, 0x66), Colour(0x6f, 0x9a, 0xc8), Colour(0xf2, 0xef, 0xea)];
        let (sin, cos) = libm::sincos(2.0 * delta);
        let class = |v: [f64; 3]| {
            if is_free(v, tan) {
                return brown;
            }
            // the part along b is kept, the part perpendicular to it turns
            let height = dot(v, axis);
            let along_b = axis.map(|x| x * height);
            let mut p: [f64; 3] = core::array::from_fn(|k| v[k] - along_b[k]);
            let mut q = super::super::camera::cross(axis, p);
            for _ in 0..turns {
                let (a, b) = (p, q);
                p = core::array::from_fn(|k| cos * a[k] + sin * b[k]);
                q = core::array::from_fn(|k| cos * b[k] - sin * a[k]);
                if all && is_free(core::array::from_fn(|k| along_b[k] + p[k]), tan) {
                    return pale;
                }
            }
            if all { blue } else { pale }
        };
        // the mean of fine × fine points per pixel; white outside the sphere
        let many = pixels * fine;
        let at = |k: usize| (2 * k + 1) as f64 / many as f64 - 1.0;
        let sums = (0..pixels * pixels).map(|pixel| {
            let (row, column) = (pixel / pixels, pixel % pixels);
            let mut sum = [0_u32; 3];
            for k in 0..fine * fine {
                let point = [at(column * fine + k % fine), -at(row * fine + k / fine)];
                let c = camera
                    .on_sphere(point)
                    .map_or(Colour::WHITE, |v| class(v).mix(Colour::BLACK, 0.22 * (1.0 - camera.depth(v))));
                for (s, part) in sum.iter_mut().zip([c.0, c.1, c.2]) {
                    *s += u32::from(part);
                }
            }
            #[allow(clippy::cast_possible_truncation, reason = "a mean of bytes")]
            let [r, g, b] = sum.map(|s| (s / (fine * fine) as u32) as u8);
            Colour(r, g, b)
        });
        sheet.svg.image(&Raster::new(pixels, sums).png(), corner, [side, side]);
        let middle = [corner[0] + 0.5 * side, corner[1] + 0.5 * side];
        let place = |v: [f64; 3]| {
            let [a, b] = camera.see(v);
            [middle[0] + 0.5 * side * a, middle[1] - 0.5 * side * b]
        };
        sheet.svg.circle(middle, 0.5 * side, Style::line(Colour::BLACK, 0.5));
        if all {
            let path = bounded(theta, 0.75, 0.3, 200)?;
            let seen =
                path.hits.iter().map(|hit| if hit.piece == 1 { hit.v } else { turn(hit.v, [0.0, 0.0, 1.0], PI) });
            let front: Vec<_> = seen.filter(|v| camera.depth(*v) > 0.0).map(place).collect();
            sheet.svg.dots(front, 1.0, Colour::BLACK, 0.8);
        }
        sheet.svg.circle(place(axis), 1.4, Style::line(Colour::WHITE, 0.4).filled(ORBITS[1]));
        let [x, y] = place(axis);
        sheet.label([x - 6.0, y - 4.0], "b");
        sheet.label_as([middle[0], corner[1] + side + 10.0], LABEL, Anchor::Middle, name);
    }
    Ok(sheet.svg)
}
