//! Twins of an orbit, which detect what the derivative of the billiard map cannot.
//!
//! On the two sides of a vertex the map is differentiable, but a different map on each; so is it beside a grazed obstacle. An
//! orbit that passes there at a distance below its error may be on the wrong side. So twins of the orbit, displaced sideways by [`REACH`]
//! times the error, both ways, make the same collision: `f(x + d) − f(x) − M d` is the part of the error's image that the derivative
//! misses. Where the map is smooth, that is of second order. Where a wall ends or turns, it is an error in its own right, and enters the
//! covariance as one: `P ← (1 + c) P + (1 + 1/c) j jᵀ` for a jump `j` of `c` times the error. If the collision is another one, nothing is
//! known.
//!
//! A twin collides twice. It starts from the place of the orbit, aimed beside the next hit, so that it lands on a wall of any shape; from
//! there its second flight is displaced over its whole length. Where the error is too large for new twins to be aimed, the old ones go
//! on, also those that have shown a jump, as long as they are beside the orbit: so each flight has twins up to the last. If a twin hits
//! something else, it and the orbit are followed further: after the right angle of a square, a specular twin is beside the orbit again two
//! collisions later, whichever side comes first, and after a specular disk that it grazes, one collision later.
use super::{
    Bend, Bounce, Derivative, dot, norm, plus,
    spread::{Spread, relative},
};
use crate::start::Start;

/// How far the twins are from the orbit, in units of the root of the covariance, which bounds only mean squares.
const REACH: f64 = 2.0;

/// A deviation up to this fraction of the error counts as none: the derivative is no more accurate where walls are felt and laws are
/// differentiated numerically, and the error is given to one digit.
const LINEAR: f64 = 1.0 / 64.0;

/// So does one up to this many times the rms rounding of one collision: that is 8 ulp, for the flights and hits of orbit and twin
/// together.
const NOISE: f64 = 16.0;

/// Orbit and twin are followed for this many collisions each until they meet again: specular paths on either side of a corner of π/n do
/// so after n collisions, and this shows at the next hit.
const MEETING: usize = 8;

/// They have met if they are apart, in time as well, by no more than two fractions of the jump: the first of these, and the second times
/// the root of the relative error. A specular twin that grazes a disk of radius R where the orbit does not is turned by `2 √(2 e/R)`. A
/// larger distance is no proof: in polygons with rational angles there are few directions, and one place in 64 is nearer than the first
/// limit by chance.
const NEARER: [f64; 2] = [1.0 / 64.0, 32.0];

/// A larger jump, in units of the table's size or of the speed, means another collision, of which nothing is known: less than a digit is
/// left.
const ANOTHER: f64 = 0.125;

/// A flight shorter than this times the displacement is too short to aim along, as between the sides of a vertex at a distance below the
/// error: a twin would be turned there, not displaced, by a sixteenth or more. Those that have landed before go on.
const AIM: f64 = 16.0;

/// A path beside the orbit.
#[derive(Clone, Copy, Debug)]
struct Twin<const N: usize, const S: usize> {
    at: Start<N, S>,
    /// Its state minus that of the orbit, followed along both paths: on a lattice the two may be in different cells.
    apart: Start<N, S>,
    /// How much later than the orbit it has come here.
    late: f64,
    /// Which of the displacements sideways it began with, the largest first: 0 … N − 2.
    axis: usize,
}

impl<const N: usize, const S: usize> Twin<N, S> {
    /// Its path from where it has landed.
    fn path(&self) -> Path<N, S> {
        Path {
            from: self.at,
            direction: self.at.velocity,
            displaced: self.apart,
            begins: self.apart.position,
            axis: self.axis,
        }
    }
}

/// The path of a twin to its next hit.
struct Path<const N: usize, const S: usize> {
    from: Start<N, S>,
    direction: [f64; N],
    /// Its displacement from the orbit, as a state.
    displaced: Start<N, S>,
    /// The displacement of the place where it begins.
    begins: [f64; N],
    /// That of the twin ([`Twin`]).
    axis: usize,
}

/// Where a path comes to.
enum Landing<const N: usize, const S: usize> {
    /// On a wall, after so much time.
    Wall(Start<N, S>, f64),
    /// On a vertex, within rounding: it tells nothing.
    Vertex,
    Nowhere,
}

/// The part of the error that the derivative misses, some collisions later.
#[derive(Clone, Copy, Debug)]
struct Jump<const N: usize, const S: usize> {
    later: usize,
    by: Start<N, S>,
    /// Its relative size.
    size: f64,
    /// The twin that shows it, then.
    twin: Option<Twin<N, S>>,
}

/// The twins of an orbit.
#[derive(Clone, Debug)]
pub(super) struct Twins<const N: usize, const S: usize> {
    /// Those that have landed beside the orbit.
    landed: Vec<Twin<N, S>>,
    /// A jump to come: the twins are known to be beside the orbit again only then.
    coming: Option<Jump<N, S>>,
}

/// One collision of the orbit, to which twins compare themselves.
pub(super) struct Beside<'a, const N: usize, const S: usize> {
    pub(super) walls: &'a dyn Bend<N>,
    pub(super) derivative: &'a Derivative<'a, N, S>,
    /// The orbit after it.
    pub(super) next: &'a Start<N, S>,
    /// The size of the table.
    pub(super) size: f64,
}

impl<const N: usize, const S: usize> Twins<N, S> {
    pub(super) fn new() -> Self {
        Twins { landed: Vec::new(), coming: None }
    }

    /// Lets twins make a collision of the orbit, those that have landed and new ones displaced by `across` ([`Spread::across`]), and adds
    /// what they detect to the error after it.
    pub(super) fn look(&mut self, beside: &Beside<'_, N, S>, across: &[Start<N, S>], spread: &mut Spread<N, S>) {
        if let Some(jump) = &mut self.coming {
            jump.later -= 1;
        } else {
            let second: Vec<_> = self.landed.iter().map(Twin::path).collect();
            let both_ways = |(axis, d)| [REACH, -REACH].map(|reach| (axis, Start::ZERO.plus(reach, d)));
            let first: Vec<_> =
                across.iter().enumerate().flat_map(both_ways).filter_map(|(axis, d)| beside.aimed(axis, d)).collect();
            let [second, first] = [second, first]
                .map(|paths| -> Vec<_> { paths.iter().filter_map(|path| beside.jump(path, spread)).collect() });
            let both = || second.iter().chain(&first);
            // at once if nothing is left
            let largest = both().copied().reduce(|a, b| if b.size > a.size { b } else { a });
            let later = match largest {
                Some(jump) if jump.size < f64::INFINITY => both().map(|jump| jump.later).max().unwrap_or(0),
                _ => 0,
            };
            self.coming = largest.map(|jump| Jump { later, ..jump });
            let then = |jumps: &[Jump<N, S>]| -> Vec<_> {
                jumps.iter().filter(|jump| jump.later == later).filter_map(|jump| jump.twin).collect()
            };
            // where none could be aimed, the earlier ones go on
            self.landed = then(&second);
            let new = then(&first);
            self.landed.retain(|old| !new.iter().any(|new| new.axis == old.axis));
            self.landed.extend(new);
        }
        if let Some(jump) = self.coming.take_if(|jump| jump.later == 0) {
            spread.jump(&jump.by, jump.size / spread.error(beside.next, beside.size));
        }
    }
}

impl<const N: usize, const S: usize> Beside<'_, N, S> {
    /// The path of a twin from the place of the orbit, aimed at where one displaced by `d` would arrive, with the velocity that it would
    /// have there; `None` where that is too far beside the orbit.
    fn aimed(&self, axis: usize, d: Start<N, S>) -> Option<Path<N, S>> {
        let Derivative { before, hit, .. } = self.derivative;
        let v = &before.velocity;
        let moved = plus(&d.position, hit.time, &d.velocity);
        let across = plus(&moved, -dot(&moved, v) / dot(v, v), v);
        if !(AIM * norm(&across) < hit.time * norm(v)) {
            return None;
        }
        let from = Start { position: before.position, ..before.plus(1.0, &d) };
        Some(Path { from, direction: plus(v, 1.0 / hit.time, &across), displaced: d, begins: [0.0; N], axis })
    }

    /// The twin that has come to `at` on a path, after so much time.
    fn twin(&self, path: &Path<N, S>, at: Start<N, S>, time: f64) -> Twin<N, S> {
        let Derivative { before, hit, .. } = self.derivative;
        let farther = plus(&path.direction.map(|v| time * v), -hit.time, &before.velocity);
        let position = plus(&path.begins, 1.0, &farther);
        Twin { at, apart: Start { position, ..at.plus(-1.0, self.next) }, late: time - hit.time, axis: path.axis }
    }

    /// The jump of the error after the collision that a twin on a path shows, of size 0 if the derivative misses nothing; if the twin hits
    /// nothing, the orbit is lost. `None` if it tells nothing.
    fn jump(&self, path: &Path<N, S>, spread: &Spread<N, S>) -> Option<Jump<N, S>> {
        let lost = Jump { later: 0, by: Start::ZERO, size: f64::INFINITY, twin: None };
        let twin = match fly(self.derivative.billiard, &path.from, &path.direction) {
            Landing::Wall(at, time) => self.twin(path, at, time),
            Landing::Vertex => return None,
            Landing::Nowhere => return Some(lost),
        };
        let expected = self.derivative.apply(&path.displaced);
        let error = spread.error(self.next, self.size);
        let here = self.jump_by(0, twin.apart.plus(-1.0, &expected), twin);
        let nothing = LINEAR * error + NOISE * self.rounding(LINEAR * error < here.size);
        if here.size <= nothing {
            return Some(Jump { size: 0.0, ..here });
        }
        let (met, at_vertex) = if here.size > error {
            let near = NEARER[0].min(NEARER[1] * libm::sqrt(error)) * here.size;
            self.meeting(&twin, expected, [near, nothing])
        } else {
            (None, false)
        };
        match met {
            None if at_vertex => None,
            None if here.size > error.max(ANOTHER) => Some(lost),
            met => met.or(Some(here)),
        }
    }

    fn jump_by(&self, later: usize, by: Start<N, S>, twin: Twin<N, S>) -> Jump<N, S> {
        let size = relative(norm(&by.position), by.speed(), self.next, self.size);
        Jump { later, by, size, twin: Some(twin) }
    }

    /// The relative rounding of this collision; 0 if not `asked`.
    fn rounding(&self, asked: bool) -> f64 {
        let mut spread = Spread::none();
        if asked {
            spread.round(self.derivative.length, [0.0; 2], 1.0);
            spread.carry(|d| self.derivative.apply(d));
            spread.round(0.0, self.derivative.sizes(self.next), 1.0);
        }
        spread.error(self.next, self.size)
    }

    /// How near the next collisions of twin and orbit, one of each, come to the linear displacement of the orbit: the nearest of those that
    /// are `near`, up to the first collision of the orbit where that is `nothing`. And whether one of them ends on a vertex, within
    /// rounding.
    fn meeting(
        &self,
        twin: &Twin<N, S>,
        expected: Start<N, S>,
        [near, nothing]: [f64; 2],
    ) -> (Option<Jump<N, S>>, bool) {
        let billiard = self.derivative.billiard;
        // places and times are relative to those of the orbit's hit
        let placed = |at: &Start<N, S>, position| Start { position, ..*at };
        let axis = twin.axis;
        let (mut at, mut place, mut time) = (twin.at, twin.apart.position, twin.late);
        let mut twins = vec![(at, place, time)];
        let mut at_vertex = false;
        for _ in 1..MEETING {
            let landing = fly(billiard, &at, &at.velocity);
            at_vertex |= matches!(landing, Landing::Vertex);
            let Landing::Wall(next, flight) = landing else { break };
            place = plus(&place, flight, &at.velocity);
            time += flight;
            at = next;
            twins.push((at, place, time));
        }
        let (mut at, mut place, mut time, mut apart) = (*self.next, [0.0; N], 0.0, expected);
        let mut nearest: Option<Jump<N, S>> = None;
        for later in 0..MEETING {
            let here = placed(&at, place);
            for (there, its_place, when) in &twins {
                let apart_from = placed(there, *its_place).plus(-1.0, &here);
                let twin = Twin { at: *there, apart: apart_from, late: when - time, axis };
                let jump = self.jump_by(later, apart_from.plus(-1.0, &apart), twin);
                let late = twin.late * norm(&at.velocity) / self.size;
                if jump.size.max(late.abs()) <= near && !nearest.is_some_and(|nearest| nearest.size <= jump.size) {
                    nearest = Some(jump);
                }
            }
            let hit = billiard.first_hit(&at.position, &at.velocity);
            if nearest.is_some_and(|nearest| nearest.size <= nothing) || !(hit.time < f64::INFINITY) {
                break;
            }
            if hit.corner {
                at_vertex = true;
                break;
            }
            place = plus(&place, hit.time, &at.velocity);
            time += hit.time;
            let derivative = Derivative::new(billiard, self.walls, &at, &hit);
            apart = derivative.apply(&apart);
            at = derivative.after();
        }
        (nearest, at_vertex)
    }
}

/// The next collision of a path in some direction from a place; the collision itself uses the velocity of `from`.
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
    Landing::Wall(at, hit.time)
}
