//! The isosceles triangle: a sampled portrait, and one orbit near a periodic point of high order.
use super::super::portrait::{Portrait, colour, starts, velocities};
use super::super::sheet::{Sheet, fit};
use super::super::{Drawing, Effort, Figure};
use crate::picture::Window;
use billiards::geometry::tables;

pub(super) const FIGURE: Figure = Figure {
    name: "isosceles",
    title: "An isosceles triangle",
    place: "Figure 18",
    caption: "Left: the velocity portrait of many orbits. The axes of periodicity of its corners are surrounded by closed curves (upper left and lower \
              right; in the paper, which counts rotation clockwise, upper right and lower left); so are many periodic points of higher order. Right: a single orbit around one of high order, a closed curve around each of its points. \
              (Curves may cross, since the place on the boundary is left out.)",
    parameters: "Base 1, height 1.25, uniform disk, γ² = 1/2. Orbits start by the canonical measure (seed 10): 300 × 3000 collisions (--quick \
                 120 × 1000). Right: of the 300 starts, the orbit whose portrait has at least 20 components of which the smallest is as large as \
                 possible, 30 000 collisions.",
    draw,
};

/// The fewest components of the portrait of a single orbit.
const FEWEST: usize = 20;

fn draw(effort: Effort) -> Drawing {
    let billiard = super::super::motion::no_slip(tables::isosceles(1.0, 1.25)?);
    let starts = starts(&billiard.table, 10, 300)?;
    let (many, collisions) = if effort == Effort::Quick { (&starts[..120], 1000) } else { (&starts[..], 3000) };
    let mut portrait = Portrait::new(760);
    portrait.orbits(&billiard, many, collisions);
    let mut best = (0, 0);
    for (i, start) in starts.iter().enumerate() {
        let sizes = components(&velocities(&billiard, start, 6000));
        let smallest = sizes.iter().copied().min().filter(|_| sizes.len() >= FEWEST).unwrap_or(0);
        if smallest > best.0 {
            best = (smallest, i);
        }
    }
    let mut single = Portrait::new(760);
    single.orbit(&billiard, &starts[best.1], 30_000, colour(0));
    let side = 158.0;
    let mut sheet = Sheet::new(2.0 * side + 9.0, side + 6.0);
    portrait.draw(&mut sheet, [3.0, 3.0], side);
    single.draw(&mut sheet, [side + 6.0, 3.0], side);
    let view = fit(Window { low: [-0.5, 0.0], high: [0.5, 1.25] }, [side - 19.0, 3.0], 24.0, 24.0);
    sheet.walls(&view, &billiard.table);
    Ok(sheet.svg)
}

/// The connected components of points on a grid of 240²: how many cells each has.
fn components(points: &[[f64; 2]]) -> Vec<usize> {
    const N: usize = 240;
    let mut cells = vec![false; N * N];
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "inside the unit disk")]
    for p in points {
        let [i, j] = p.map(|x| (((x + 1.0) * 0.5 * N as f64) as usize).min(N - 1));
        cells[j * N + i] = true;
    }
    let mut sizes = vec![];
    for cell in 0..N * N {
        let (mut stack, mut size) = (vec![cell], 0);
        while let Some(at) = stack.pop() {
            if core::mem::replace(&mut cells[at], false) {
                size += 1;
                let (i, j) = (at % N, at / N);
                for (i, j) in [-1, 0, 1]
                    .into_iter()
                    .flat_map(|a| [-1, 0, 1].map(|b| (i.wrapping_add_signed(a), j.wrapping_add_signed(b))))
                {
                    if i < N && j < N {
                        stack.push(j * N + i);
                    }
                }
            }
        }
        if size > 0 {
            sizes.push(size);
        }
    }
    sizes
}
