//! Twins of an orbit, which see what the derivative of the billiard map is blind to.
//!
//! Beside a vertex the map has a derivative on either side, and is another one; so it is beside an obstacle that is grazed. An orbit that
//! passes there at less than its error may be on the wrong side. So twins of the orbit, displaced across the path by [`REACH`] times
//! the error, both ways, make the same collision: `f(x + d) − f(x) − M d` is what the error makes of itself besides `M d`. In the smooth
//! it is of second order and nothing; where a wall ends, or bends that was flat, it is an error of its own, and enters the covariance as
//! one: `P ← (1 + c) P + (1 + 1/c) j jᵀ` for a jump `j` of `c` times the error.
//!
//! A twin collides twice. It starts from the place of the orbit, aimed beside the next hit, so that it lands on a wall whatever that is; from
//! there its second flight is displaced over all its length. One that hits something else is followed on: past the right angle of a
//! square, two collisions later, specular twins are beside the orbit again, which both of them leave as if from one wall.
use super::{Bend, Bounce, Derivative, Spread, dot, norm, plus, relative};
use crate::start::Start;

/// How far the twins are from the orbit, in units of the root of the covariance, which is a bound, but of mean squares.
const REACH: f64 = 2.0;

/// A deviation up to this part of the error is none: the derivative is no better where walls are felt and laws are differentiated, and the
/// error is told to one digit.
const LINEAR: f64 = 1.0 / 64.0;

/// Nor is one up to so many times what one collision rounds, rms: that is 8 ulp, for orbit and twin together.
const NOISE: f64 = 16.0;

/// For so many collisions of each the two are followed until they meet again: specular paths on either side of a corner of π/n do after
/// n of them, and are seen to on the next hit.
const MEETING: usize = 8;

/// By how much less than at the hit they then are apart. By chance, one in 64 pairs is so near in three coordinates in 4000 cases.
const NEARER: f64 = 1.0 / 64.0;

/// A flight shorter than this times the displacement is no path to aim along.
const AIM: f64 = 2.0;

/// A path beside the orbit.
#[derive(Clone, Copy, Debug)]
struct Twin<const N: usize, const S: usize> {
    at: Start<N, S>,
    /// Less the orbit, along both paths: on a lattice the two may be told in different cells.
    apart: Start<N, S>,
}

/// Where a path comes to.
enum Landing<const N: usize, const S: usize> {
    /// On a wall, so far from where it was.
    Wall(Start<N, S>, [f64; N]),
    /// On a vertex, within rounding: it tells nothing.
    Vertex,
    Nowhere,
}

/// What the error makes of itself besides what the derivative says, so many collisions later.
#[derive(Clone, Copy, Debug)]
struct Jump<const N: usize, const S: usize> {
    later: usize,
    by: Start<N, S>,
    /// Of what size that is, relative.
    size: f64,
}

/// The twins of an orbit.
#[derive(Clone, Debug)]
pub(super) struct Twins<const N: usize, const S: usize> {
    /// Those that have landed beside the orbit.
    landed: Vec<Twin<N, S>>,
    /// A jump to come, where twins are known to be beside the orbit again only then.
    coming: Option<Jump<N, S>>,
}

/// One collision of the orbit, to which twins compare themselves.
pub(super) struct Beside<'a, const N: usize, const S: usize> {
    pub(super) walls: &'a dyn Bend<N>,
    pub(super) derivative: &'a Derivative<'a, N, S>,
    /// The orbit after it.
    pub(super) next: &'a Start<N, S>,
    /// Of the table.
    pub(super) size: f64,
}

impl<const N: usize, const S: usize> Twins<N, S> {
    pub(super) fn new() -> Self {
        Twins { landed: Vec::new(), coming: None }
    }

    /// Has twins make a collision of the orbit, those that have landed and new ones displaced by `across` ([`Spread::across`]), and adds
    /// to the error after it what they see.
    pub(super) fn look(&mut self, beside: &Beside<'_, N, S>, across: &[Start<N, S>], spread: &mut Spread<N, S>) {
        if let Some(jump) = &mut self.coming {
            jump.later -= 1;
        } else {
            let landed = core::mem::take(&mut self.landed);
            let second = landed.iter().map(|twin| (beside.flight(twin), twin.apart));
            let both_ways = across.iter().flat_map(|d| [REACH, -REACH].map(|reach| Start::ZERO.plus(reach, d)));
            let first = both_ways.filter_map(|d| Some((beside.aimed(&d)?, d)));
            let mut worst: Option<Jump<N, S>> = None;
            let mut beside_it = [Vec::new(), Vec::new()];
            for (i, (landing, d)) in second.map(|of| (0, of)).chain(first.map(|of| (1, of))) {
                let twin = match landing {
                    Landing::Wall(at, moved) => Some(beside.twin(at, &moved, &d, i == 1)),
                    Landing::Vertex => continue,
                    Landing::Nowhere => None,
                };
                let jump = beside.jump(twin.as_ref(), &d, spread);
                if jump.is_none() {
                    beside_it[i].extend(twin);
                }
                if jump.is_some_and(|jump| !worst.is_some_and(|worst| worst.size >= jump.size)) {
                    worst = jump;
                }
            }
            self.coming = worst;
            // where none could be aimed, those before go on
            let [second, first] = beside_it;
            self.landed = if first.is_empty() { second } else { first };
        }
        if let Some(jump) = self.coming.take_if(|jump| jump.later == 0) {
            spread.jump(&jump.by, jump.size / spread.error(beside.next, beside.size));
        }
    }
}

impl<const N: usize, const S: usize> Beside<'_, N, S> {
    /// A twin that flies on.
    fn flight(&self, twin: &Twin<N, S>) -> Landing<N, S> {
        fly(self.derivative.billiard, &twin.at, &twin.at.velocity)
    }

    /// A twin from the place of the orbit, aimed at where one displaced by `d` would arrive; nothing where that is too far beside it.
    fn aimed(&self, d: &Start<N, S>) -> Option<Landing<N, S>> {
        let Derivative { before, hit, .. } = self.derivative;
        let v = &before.velocity;
        let moved = plus(&d.position, hit.time, &d.velocity);
        let across = plus(&moved, -dot(&moved, v) / dot(v, v), v);
        if !(AIM * norm(&across) < hit.time * norm(v)) {
            return None;
        }
        let displaced = Start { position: before.position, ..before.plus(1.0, d) };
        Some(fly(self.derivative.billiard, &displaced, &plus(v, 1.0 / hit.time, &across)))
    }

    /// The twin that has come to `at` on a flight by `moved`, from the place of the orbit or beside it.
    fn twin(&self, at: Start<N, S>, moved: &[f64; N], d: &Start<N, S>, aimed: bool) -> Twin<N, S> {
        let Derivative { before, hit, .. } = self.derivative;
        let farther = plus(moved, -hit.time, &before.velocity);
        let position = if aimed { farther } else { plus(&d.position, 1.0, &farther) };
        Twin { at, apart: Start { position, ..at.plus(-1.0, self.next) } }
    }

    /// What a twin that was displaced by `d` before the collision tells of the error after it, if anything; one that hits nothing, all.
    fn jump(&self, twin: Option<&Twin<N, S>>, d: &Start<N, S>, spread: &Spread<N, S>) -> Option<Jump<N, S>> {
        let expected = self.derivative.apply(d);
        let lost = Start { position: [f64::INFINITY; N], ..Start::ZERO };
        let by = twin.map_or(lost, |twin| twin.apart.plus(-1.0, &expected));
        let error = spread.error(self.next, self.size);
        let here = self.jump_by(0, by);
        if here.size <= LINEAR * error + NOISE * self.rounding(LINEAR * error < here.size) {
            return None;
        }
        let meets = twin.filter(|_| !(here.size <= error)).and_then(|twin| self.meeting(twin, expected));
        Some(meets.filter(|meets| !(meets.size > NEARER * here.size)).unwrap_or(here))
    }

    fn jump_by(&self, later: usize, by: Start<N, S>) -> Jump<N, S> {
        let size = relative(norm(&by.position), by.speed(), self.next, self.size);
        Jump { later, by, size }
    }

    /// What this collision rounds, relative; 0 where nobody asks.
    fn rounding(&self, asked: bool) -> f64 {
        let mut spread = Spread(vec![Start::ZERO; Start::<N, S>::COORDINATES]);
        if asked {
            spread.round(self.derivative.length, 0.0, 1.0);
            spread.carry(|d| self.derivative.apply(d));
            spread.round(0.0, self.next.speed(), 1.0);
        }
        spread.error(self.next, self.size)
    }

    /// How near the next collisions of twin and orbit, in whatever order, come to the linear displacement of the orbit: the nearest.
    fn meeting(&self, twin: &Twin<N, S>, expected: Start<N, S>) -> Option<Jump<N, S>> {
        let billiard = self.derivative.billiard;
        // places are told from that of this hit
        let displaced = |at: &Start<N, S>, from: &[f64; N]| Start { position: *from, ..*at };
        let mut twins = vec![displaced(&twin.at, &twin.apart.position)];
        let (mut at, mut from) = (twin.at, twin.apart.position);
        while let Landing::Wall(next, moved) = fly(billiard, &at, &at.velocity) {
            if twins.len() == MEETING {
                break;
            }
            from = plus(&from, 1.0, &moved);
            at = next;
            twins.push(displaced(&at, &from));
        }
        let (mut at, mut from, mut apart) = (*self.next, [0.0; N], expected);
        let mut nearest: Option<Jump<N, S>> = None;
        for later in 0..MEETING {
            let there = displaced(&at, &from).plus(1.0, &apart);
            for twin in &twins {
                let jump = self.jump_by(later, twin.plus(-1.0, &there));
                if !nearest.is_some_and(|nearest| nearest.size <= jump.size) {
                    nearest = Some(jump);
                }
            }
            let hit = billiard.first_hit(&at.position, &at.velocity);
            if hit.corner || !(hit.time < f64::INFINITY) {
                break;
            }
            from = plus(&from, hit.time, &at.velocity);
            let derivative = Derivative::new(billiard, self.walls, &at, &hit);
            apart = derivative.apply(&apart);
            at = derivative.after();
        }
        nearest
    }
}

/// The next collision of a path in some direction from a place; what it hits, it hits with the velocity that is told.
fn fly<const N: usize, const S: usize>(
    billiard: &dyn Bounce<N, S>,
    from: &Start<N, S>,
    direction: &[f64; N],
) -> Landing<N, S> {
    let hit = billiard.first_hit(&from.position, direction);
    if !(hit.time < f64::INFINITY) {
        return Landing::Nowhere;
    }
    if hit.corner {
        return Landing::Vertex;
    }
    let mut at = Start { position: hit.point, ..*from };
    billiard.collide(&hit, &mut at.velocity, &mut at.spin);
    Landing::Wall(at, direction.map(|v| hit.time * v))
}
