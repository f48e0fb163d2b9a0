//! Velocity portraits: points `(v₀, vₜ)` of the unit disk, by the million.

use billiards::geometry::Table;
use billiards::laws::Disk;
use billiards::observe::Watch;
use billiards::{Canonical, Collision, Collisions, Conserved, Orbit, Planar, Starts};

use super::sheet::Sheet;
use crate::picture::{Colour, Grid, ORBITS, Shading, Style, View, Window};

/// Counts velocities after the collisions of many orbits, each orbit in its colour.
#[derive(Clone, Debug)]
pub(super) struct Portrait(Grid);

/// White around the disk.
const AROUND: f64 = 0.03;

impl Portrait {
    /// An empty portrait this many cells wide.
    pub(super) fn new(cells: usize) -> Self {
        let colours: Vec<Colour> = ORBITS.into_iter().chain([SEA]).collect();
        Portrait(Grid::new(Window::unit_disk(AROUND), cells, &colours))
    }

    /// Adds an orbit, in its colour.
    pub(super) fn orbit(&mut self, billiard: &Planar<Disk>, start: &Start, collisions: u64, colour: Colour) {
        for point in velocities(billiard, start, collisions) {
            self.0.add(point, colour);
        }
    }

    /// Adds orbits, each in a colour; those that spread over an area are pale grey.
    pub(super) fn orbits(&mut self, billiard: &Planar<Disk>, starts: &[Start], collisions: u64) {
        let mut coloured = 0;
        for start in starts {
            let points = velocities(billiard, start, collisions);
            let ink = if spreads(&points) {
                SEA
            } else {
                coloured += 1;
                colour(coloured)
            };
            for point in points {
                self.0.add(point, ink);
            }
        }
    }

    /// Adds a point.
    pub(super) fn add(&mut self, point: [f64; 2], colour: Colour) {
        self.0.add(point, colour);
    }

    /// Draws the portrait into a square of the page, with its axes named.
    pub(super) fn draw(&self, sheet: &mut Sheet, corner: [f64; 2], side: f64) {
        let view = disk(sheet, corner, side, |sheet, view| {
            sheet.svg.image(&self.0.shade(Shading::Tinted).reduced().png(), view.corner(), view.size());
        });
        names(sheet, &view);
    }
}

/// The colour of orbits that spread over an area.
pub(super) const SEA: Colour = Colour(0xc4, 0xc4, 0xc4);

/// Whether points fill an area rather than curves: on a grid of 100² cells they occupy more than 40 % of the cells that as
/// many points spread evenly over the unit disk would.
fn spreads(points: &[[f64; 2]]) -> bool {
    const N: usize = 100;
    let mut cells = vec![false; N * N];
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "inside the unit disk")]
    for p in points {
        let [i, j] = p.map(|x| (((x + 1.0) * 0.5 * N as f64) as usize).min(N - 1));
        cells[j * N + i] = true;
    }
    let met = cells.iter().filter(|cell| **cell).count() as f64;
    let all = core::f64::consts::FRAC_PI_4 * (N * N) as f64;
    met > 0.4 * all * (1.0 - libm::exp(-(points.len() as f64) / all))
}

/// The frame of a velocity disk: what `content` draws, between the cross of the axes and the circle.
pub(super) fn disk(sheet: &mut Sheet, corner: [f64; 2], side: f64, content: impl FnOnce(&mut Sheet, &View)) -> View {
    let view = View::fit(Window::unit_disk(AROUND), corner, side, side);
    content(sheet, &view);
    let guide = Style::line(Colour::BLACK, 0.25).with_opacity(0.35);
    sheet.svg.line(view.place([-1.0, 0.0]), view.place([1.0, 0.0]), guide);
    sheet.svg.line(view.place([0.0, -1.0]), view.place([0.0, 1.0]), guide);
    sheet.svg.circle(view.place([0.0, 0.0]), view.scale(), Style::line(Colour::BLACK, 0.5));
    view
}

/// Writes v₀ and vₜ at the ends of the axes.
pub(super) fn names(sheet: &mut Sheet, view: &View) {
    let [x, y] = view.place([0.74, -0.83]);
    sheet.label([x, y + 4.0], "→ v_0");
    let [x, y] = view.place([-0.98, 0.83]);
    sheet.label([x, y], "↑ v_t");
}

/// Where an orbit starts.
pub(super) type Start = billiards::Start<2, 1>;

/// Starts spread by the canonical measure, at unit speed.
pub(super) fn starts(table: &Table, seed: u64, count: u64) -> Result<Vec<Start>, billiards::Error> {
    let canonical = Canonical::new(table, 1.0, seed)?;
    Ok((0..count).map(|i| canonical.start(i)).collect())
}

/// The pairs `(v₀, vₜ)` after each collision.
pub(super) fn velocities(billiard: &Planar<Disk>, start: &Start, collisions: u64) -> Vec<[f64; 2]> {
    let mut points = Vec::new();
    let mut orbit = Orbit::<_, 2, 1, Conserved<_, 2>, _>::new(start.position, start.velocity, start.spin, ());
    let look = |c: &Collision<'_, 2, 1, Conserved<f64, 2>, ()>| {
        let ([n1, n2], [v1, v2]) = (c.hit.unit_normal(), c.orbit.velocity);
        points.push([c.orbit.spin[0], v2 * n1 - v1 * n2]);
        core::ops::ControlFlow::Continue(())
    };
    billiard.run(&mut orbit, &Collisions(collisions), &mut Watch::new(look));
    points
}

/// The colour of orbit number `i`.
pub(super) fn colour(i: usize) -> Colour {
    ORBITS[i % ORBITS.len()]
}
