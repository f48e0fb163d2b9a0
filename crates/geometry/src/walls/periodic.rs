//! Walls repeated by a lattice of translations.
use super::{WallHit, Walls};
use crate::{FundamentalCell, extent::Extent, lattice::Lattice, plane::slack};
use lanes::{Double, Lane, Mask};

/// Walls on a channel or a flat torus: the particle is followed from cell to cell.
///
/// The walls inside must contain, besides those of the cell, every translate that reaches into it. A path starts in the cell (see
/// [`Lattice::reduce`] and [`FundamentalCell::home`]), and a hit is reported there.
#[derive(Clone, Debug)]
pub struct Periodic<W> {
    walls: W,
    /// No path crosses the edges of a channel's second translation.
    translations: [Translation; 2],
    /// A vector perpendicular to the vector of a channel, and the range of the walls in that direction; 0 and infinite for other
    /// lattices.
    across: [f64; 2],
    range: [f64; 2],
}

/// A flight through this many cells without a hit is taken never to end: the particle escapes along a corridor.
///
/// A path that leaves a corridor at some angle does so within about 1/angle cells; directions that need more than this are a fraction
/// below 10⁻⁶ of all.
const MOST_CELLS: usize = 10_000_000;

/// After this many cells, a power of two, a flight begins anew from where it is.
///
/// Until then its entry into a cell is computed from the time and the number of cells, which waits neither for the preceding cell nor
/// for a division. The error of that grows with the number of cells, but over many stretches only with its square root.
const STRETCH: usize = 8;

/// How late a hit on an edge may seem: this fraction of the time of flight, and of the time through a cell times the ratio of the
/// cell's coordinates to its width. The coordinates of an edge and a wall are computed to 2 ulp each, the times of both to 2 ulp of
/// their own and one for each cell of a stretch.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// After this many cells, a power of two and no less than a stretch, a flight is tested for being one along a corridor.
const PATIENCE: usize = 16;

impl<W> Periodic<W> {
    /// The walls in the unit cell of a lattice.
    pub fn new(walls: W, lattice: &Lattice) -> Self {
        Periodic::from_corner(walls, lattice, [0.0; 2])
    }

    /// The walls in a cell of a table.
    pub fn in_cell(walls: W, cell: &FundamentalCell) -> Self {
        Periodic::from_corner(walls, cell.lattice(), cell.corner())
    }

    /// The walls in the cell of a lattice with its corner at these lattice coordinates.
    fn from_corner(walls: W, lattice: &Lattice, corner: [f64; 2]) -> Self {
        let nowhere = Translation { functional: [0.0; 2], vector: [0.0; 2], edges: [0.0; 2], rounding: 0.0 };
        let mut translations = [nowhere; 2];
        let edges = corner.map(|c| [c, c + 1.0]);
        let farthest = |k: usize| edges[k].iter().fold(0.0, |m: f64, edge| m.max(edge.abs()));
        let reach = |i: usize| lattice.vectors().iter().enumerate().map(|(k, v)| v[i].abs() * farthest(k)).sum::<f64>();
        for (i, (translation, vector)) in translations.iter_mut().zip(lattice.vectors()).enumerate() {
            let [f, g] = lattice.functional(i);
            let rounding = ROUNDING * (1.0 + f.abs() * reach(0) + g.abs() * reach(1));
            *translation = Translation { functional: [f, g], vector: (*vector).into(), edges: edges[i], rounding };
        }
        Periodic { walls, translations, across: [0.0; 2], range: [-f64::INFINITY, f64::INFINITY] }
    }

    /// The same walls, known to lie in these boxes: on a channel, a flight beyond the boxes that moves away from them ends at once.
    #[must_use]
    pub fn within(self, lattice: &Lattice, boxes: impl IntoIterator<Item = Extent>) -> Self {
        let [along] = lattice.vectors() else { return self };
        let size = along.amax();
        let across = [-along.y / size, along.x / size];
        let mut range = [f64::INFINITY, -f64::INFINITY];
        for Extent { min, max } in boxes {
            for corner in [[min.x, min.y], [max.x, min.y], [max.x, max.y], [min.x, max.y]] {
                // an infinite extent of a box along the channel does not count
                let parts = [0, 1].map(|i| across[i] * corner[i]);
                let at: f64 = parts.iter().filter(|part| !part.is_nan()).sum();
                let rounding = slack(parts.into_iter().filter(|part| part.is_finite()));
                // ∞ − ∞, for an infinite box in a slanted channel
                let at = if at.is_nan() { [-f64::INFINITY, f64::INFINITY] } else { [at - rounding, at + rounding] };
                range = [range[0].min(at[0]), range[1].max(at[1])];
            }
        }
        Periodic { across, range, ..self }
    }
}

/// A vector of the lattice.
#[derive(Clone, Copy, Debug)]
struct Translation {
    /// The lattice coordinate that this vector increases by 1, and its range in the cell: 0 to 1 in the unit cell.
    functional: [f64; 2],
    edges: [f64; 2],
    vector: [f64; 2],
    /// The rounding of coordinates in the cell, as a fraction of its width.
    rounding: f64,
}

/// How a path crosses the cell edges that one translation maps to each other.
struct Crossings<F: Lane> {
    functional: [f64; 2],
    /// The value of the coordinate where the path leaves the cell, and the time per unit of the coordinate, negative where it
    /// decreases.
    edge: F,
    inverse: F,
    /// The translation from a cell to the next one along the path.
    step: [F; 2],
    /// The time from one crossing to the next; infinite along the edges.
    period: F,
    /// How late a hit on the edge may seem.
    late: F,
}

impl<F: Lane> Crossings<F> {
    #[inline(always)]
    fn new(translation: &Translation, v: &[F; 2]) -> Self {
        let Translation { functional: [f, g], edges: [low, high], vector: [x, y], rounding } = *translation;
        let speed = v[0] * f + v[1] * g;
        let (zero, one) = (speed.same(0.0), speed.same(1.0));
        let up = zero.lt(speed);
        let step = [up.select(zero.same(x), zero.same(-x)), up.select(zero.same(y), zero.same(-y))];
        let edge = up.select(zero.same(high), zero.same(low));
        let inverse = one / speed;
        let period = inverse.abs();
        Crossings { functional: [f, g], edge, inverse, step, period, late: period * rounding }
    }

    /// The time until the first crossing of a path from `x` in the cell.
    #[inline(always)]
    fn first(&self, x: &[F; 2]) -> F {
        let [f, g] = self.functional;
        let at = x[0] * f + x[1] * g;
        let (zero, never) = (at.same(0.0), at.same(f64::INFINITY));
        // a start that rounding has taken beyond the edge counts as on it
        let time = ((self.edge - at) * self.inverse).max(zero);
        self.period.lt(never).select(time, never)
    }
}

impl<W: Walls<2>> Walls<2> for Periodic<W> {
    fn rounds_normals(&self) -> bool {
        self.walls.rounds_normals()
    }

    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; 2], v: &[F; 2]) -> WallHit<F, 2> {
        let zero = v[0].same(0.0);
        let (first, second) = (Crossings::new(&self.translations[0], v), Crossings::new(&self.translations[1], v));
        // where and when the stretch began, the time since then, the translation since then, and the next crossings
        let (mut start, mut begun) = (*x, Double::new(zero));
        let (mut flown, mut moved) = (zero, [zero; 2]);
        let mut at = start;
        let mut next = [first.first(x), second.first(x)];
        let mut best = WallHit::never(start);
        let mut flying = !zero.never();
        let mut mark = start;
        for cells in 1..MOST_CELLS {
            let hit = self.walls.first_hit(&at, v);
            let other = next[1].lt(next[0]);
            let exit = other.select(next[1], next[0]);
            // a hit within this cell or, up to rounding, on its edge; or any result for a direction that leaves no cell
            let late = exit * ROUNDING + other.select(second.late, first.late);
            let here = flying & !(exit + late).lt(flown + hit.time);
            let hit = WallHit { time: begun.high + (begun.low + (flown + hit.time)), ..hit };
            if F::LANES == 1 && here.any() {
                // without a selection between this and an earlier result
                return hit;
            }
            best = best.or(here, &hit);
            flying = flying & !here;
            if !flying.any() {
                break;
            }
            // lanes that have hit fly on as well, since finding out which they are would mean waiting for the hit
            flown = exit;
            next[0] = other.select(next[0], next[0] + first.period);
            next[1] = other.select(next[1] + second.period, next[1]);
            for i in 0..2 {
                moved[i] = moved[i] + other.select(second.step[i], first.step[i]);
                at[i] = start[i] + flown * v[i] - moved[i];
            }
            if cells % STRETCH == 0 {
                start = at;
                // stretches take equal times, which a plain sum would round alike
                begun.gather(flown);
                (flown, moved) = (zero, [zero; 2]);
                next = [first.first(&start), second.first(&start)];
                // a path that is back at an earlier place, to the last bit, or no longer at a finite one, never hits (Brent's cycle
                // detection)
                if cells > PATIENCE {
                    let moved =
                        [start[0].lt(mark[0]) | mark[0].lt(start[0]), start[1].lt(mark[1]) | mark[1].lt(start[1])];
                    let never = zero.same(f64::INFINITY);
                    let is_somewhere = start[0].abs().lt(never) & start[1].abs().lt(never);
                    flying = flying & (moved[0] | moved[1]) & is_somewhere;
                }
                if cells >= PATIENCE && cells.is_power_of_two() {
                    mark = start;
                }
                let [n0, n1] = self.across;
                let (place, speed) = (start[0] * n0 + start[1] * n1, v[0] * n0 + v[1] * n1);
                let [low, high] = self.range.map(|end| zero.same(end));
                let beyond = (high.lt(place) & !speed.lt(zero)) | (place.lt(low) & !zero.lt(speed));
                flying = flying & !beyond;
            }
        }
        best
    }
}
