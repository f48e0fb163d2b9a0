//! Errors of hits and collisions, in units of rounding.
use super::curve::{Crossing, Truth};
use super::number::{Big, Vector, add, big, cross, dot, left, norm, scale, small, sub, vector};
use super::rays::{Kind, Random, aimed};
use billiards::BallLaw;
use billiards::collision_laws::laws::NoSlip;
use billiards::geometry::{Line, Piece, Vector2, WallHit};
use billiards::laws::{Disk, Specular};
use std::sync::LazyLock;

/// γ² of the disk whose no-slip collisions are checked.
pub(crate) const GAMMA_SQUARED: f64 = 0.5;
/// Made once: its coefficients are searched for.
static NO_SLIP: LazyLock<Disk> = LazyLock::new(|| Disk::new(&NoSlip, libm::sqrt(GAMMA_SQUARED)).unwrap());
/// A hit steeper than this is away from grazing.
pub(crate) const STEEP: f64 = 0.25;
/// Within so many ulp of the size two answers are right: twice what counts as a corner.
pub(crate) const NEAR: f64 = 16.0;

/// Whose hits are measured.
pub(crate) struct Subject<'a> {
    pub(crate) name: &'a str,
    /// How large it is, its distance from the origin included: coordinates are rounded to this times ε.
    pub(crate) size: f64,
    /// How large it is without: rays start so far away.
    pub(crate) extent: f64,
    /// The pieces at which rays are aimed, in the order of their numbers.
    pub(crate) pieces: Vec<&'a dyn Piece>,
    pub(crate) truth: Vec<Box<dyn Truth>>,
    /// Whether a point is in the table, off the boundary.
    pub(crate) inside: &'a dyn Fn(&Vector2<f64>) -> bool,
    /// As far from its start as that the truth about a path is known.
    pub(crate) reach: f64,
    /// The answer; infinite time for none.
    pub(crate) hit: &'a dyn Fn(&Line<2>) -> WallHit<f64, 2>,
}

/// Errors of one quantity.
#[derive(Clone, Debug, Default)]
pub(crate) struct Histogram {
    pub(crate) values: Vec<f64>,
}

impl Histogram {
    fn add(&mut self, value: f64) {
        self.values.push(value);
    }
    pub(crate) fn count(&self) -> usize {
        self.values.len()
    }
    pub(crate) fn worst(&self) -> f64 {
        self.values.iter().fold(0.0, |m: f64, v| if v.is_nan() { f64::INFINITY } else { m.max(*v) })
    }
    pub(crate) fn median(&self) -> f64 {
        let mut sorted = self.values.clone();
        sorted.sort_by(f64::total_cmp);
        sorted.get(sorted.len() / 2).copied().unwrap_or(0.0)
    }
}

/// The errors of a subject.
#[derive(Clone, Debug, Default)]
pub(crate) struct Errors {
    /// Time × speed and position, in ulp of the size; normal, in ulp of 1, or where that is more in the angle by which a curved
    /// wall turns along an ulp of the size; velocity and spin after the collisions of some laws, in the same times the speed.
    pub(crate) steep: [Histogram; QUANTITIES.len()],
    /// The same times the sine of the angle to the wall: what is left when the conditioning is taken off.
    pub(crate) grazing: [Histogram; QUANTITIES.len()],
    /// Hits on another piece than the true one, away from vertices; hits that are none; misses; with the path.
    pub(crate) wrong: Vec<String>,
    /// Rays that end so near a vertex, in space an edge, that both neighbours are right.
    pub(crate) at_vertices: usize,
    /// Rays that start within rounding of a wall, or pass it within rounding: two answers are right.
    pub(crate) undecided: usize,
}

/// The last one in space only.
pub(crate) const QUANTITIES: [&str; 6] =
    ["time", "position", "normal", "specular velocity", "no-slip velocity", "velocity, rough one way"];

/// The promise, in ulp, for each kind of piece; over all kinds the medians of time, position and normal are below ½.
///
/// Those of velocities cannot be, in plain doubles. A reflection `v − 2 (v·n) n` turns the velocity by twice the error of the
/// normal, and rounds. Of 20 000 random directions and angles steeper than [`STEEP`]:
///
/// | | median | worst |
/// |---|---|---|
/// | the exact velocity, rounded | 0.18 | 0.5 |
/// | reflected exactly in the nearest unit normal that doubles have | 0.34 | 1.4 |
/// | the same in doubles | 0.51 | 3.1 |
/// | the same with what the length of the normal lacks taken back | 0.49 | 3.0 |
/// | in doubles, in an exact normal of another length with the inverse of that rounded | 0.64 | 4.5 |
///
/// To that comes twice what the normal is off because the place is, which is 0.3 to 0.5 in the median where the wall's radius of
/// curvature is the size of the table, and up to 3 at sin = ¼.
pub(crate) const MEDIAN: [f64; QUANTITIES.len()] = [0.75, 0.75, 0.75, 1.5, 1.5, 1.5];
pub(crate) const WORST: [f64; QUANTITIES.len()] = [8.0; QUANTITIES.len()];

/// Measures a subject with so many rays of a kind.
pub(crate) fn measure(subject: &Subject<'_>, kind: Kind, count: usize, random: &mut Random) -> Errors {
    let mut errors = Errors::default();
    let mut aimed_at = 0;
    while aimed_at < count {
        let piece = subject.pieces[random.below(subject.pieces.len())];
        let path = aimed(piece, subject.extent, kind, random);
        aimed_at += 1;
        // only paths that start in the table ask something
        if (subject.inside)(&path.point) {
            errors.look(subject, &path);
        } else {
            errors.undecided += 1;
        }
    }
    errors
}

impl Errors {
    fn look(&mut self, subject: &Subject<'_>, path: &Line<2>) {
        let (x, v) = (vector(path.point.into()), vector(path.velocity.into()));
        let speed = small(&norm(&v));
        let ulp = f64::EPSILON * subject.size.max(path.point.amax());
        let (mut all, mut inward, mut touched): (Vec<(usize, Crossing)>, Vec<f64>, bool) = (vec![], vec![], false);
        let mut vertices = vec![];
        for (number, truth) in subject.truth.iter().enumerate() {
            let meeting = truth.meet(&x, &v);
            all.extend(meeting.crossings.into_iter().map(|c| (number, c)));
            inward.extend(meeting.inward);
            touched |= meeting.touches.iter().any(|distance| distance.abs() <= NEAR * ulp);
            vertices.extend(truth.vertices());
        }
        // along a wall, within rounding
        if touched {
            self.undecided += 1;
            return;
        }
        // through a vertex, within rounding
        let near = |vertex: &Vector| {
            let off = sub(vertex, &x);
            small(&cross(&off, &v)).abs() <= NEAR * ulp * speed && small(&dot(&off, &v)) > -NEAR * ulp * speed
        };
        let hit = (subject.hit)(path);
        if hit.corner || vertices.iter().any(near) {
            self.at_vertices += 1;
            if !(hit.time < f64::INFINITY) && subject.pieces.len() > 1 {
                self.wrong(path, "lost at a vertex");
            }
            return;
        }
        let sine = |c: &Crossing| -small(&dot(&v, &c.normal)) / speed;
        all.retain(|(_, c)| small(&c.time) * speed * sine(c) > -NEAR * ulp);
        all.sort_by(|(_, a), (_, b)| a.time.cmp(&b.time));
        let Some((number, truth)) = all.into_iter().next() else {
            if !(hit.time < f64::INFINITY) {
                return;
            }
            if hit.time * speed > subject.reach || along_the_wall(subject, path, [0.0, hit.time], ulp) {
                self.undecided += 1;
            } else {
                self.wrong(path, &format!("hits at {}, but there is nothing", hit.time));
            }
            return;
        };
        let time = small(&truth.time);
        if time * speed > subject.reach {
            self.undecided += 1;
            return;
        }
        let on_the_wall = time * speed * sine(&truth) <= NEAR * ulp;
        // a path may start beyond the vertices of a single piece, and behind it
        if on_the_wall || inward.iter().any(|&t| 0.0 < t && t < time) {
            self.undecided += 1;
            return;
        }
        if !(hit.time < f64::INFINITY) {
            self.wrong(path, &format!("missed: hit at {time}, sine {:e}", sine(&truth)));
            return;
        }
        if sine(&truth) < STEEP && along_the_wall(subject, path, [time, hit.time], ulp) {
            self.undecided += 1;
            return;
        }
        if hit.piece != number as f64 {
            self.wrong(path, &format!("hits piece {}, not {number}", hit.piece));
            return;
        }
        let normal = hit.unit_normal();
        let off = small(&norm(&sub(&vector(hit.point), &truth.point)));
        let turned = small(&norm(&sub(&vector(normal), &truth.normal)));
        let late = small(&(big(hit.time) - &truth.time)).abs() * speed;
        let mut velocities = [([path.velocity.x, path.velocity.y], [0.0]); 2];
        let spin = 0.375 * speed;
        let gamma = libm::sqrt(GAMMA_SQUARED);
        velocities[0].1 = [spin];
        velocities[1].1 = [spin];
        Specular.collide(&hit, &mut velocities[0].0, &mut velocities[0].1);
        NO_SLIP.collide(&hit, &mut velocities[1].0, &mut velocities[1].1);
        // the normal of a curved wall turns by κ times the error of the position, that of a straight one with its vertices
        let piece = subject.pieces[number];
        let unit = f64::EPSILON.max(piece.curvature(&hit.point.into()).abs() * ulp).max(ulp / piece.length());
        let exact = [reflected(&v, spin, &truth.normal, None), reflected(&v, spin, &truth.normal, Some(gamma))];
        let missed = |law: usize| {
            let (got, want) = (&velocities[law], &exact[law]);
            let dv = norm(&sub(&vector(got.0), &want.0));
            let dw = big(got.1[0]) - &want.1;
            small(&norm(&[dv, dw])) / (unit * speed)
        };
        let all = [late / ulp, off / ulp, turned / unit, missed(0), missed(1)];
        let sine = sine(&truth);
        self.add(sine, all);
    }

    /// Adds the errors of a hit, of which there may be fewer than quantities.
    pub(crate) fn add<const K: usize>(&mut self, sine: f64, errors: [f64; K]) {
        for (i, error) in errors.into_iter().enumerate() {
            if sine >= STEEP {
                self.steep[i].add(error);
            } else {
                self.grazing[i].add(error * sine);
            }
        }
    }

    /// Notes an answer that is none.
    pub(crate) fn wrong<const N: usize>(&mut self, path: &Line<N>, what: &str) {
        self.wrong.push(format!("{what}: {path:?}"));
    }

    /// What of the promise is not kept.
    ///
    /// Medians need some hundred rays to mean anything.
    pub(crate) fn broken(&self) -> Vec<String> {
        let mut broken = self.wrong.clone();
        for (i, quantity) in QUANTITIES.iter().enumerate() {
            for (class, histogram) in [("steep", &self.steep[i]), ("grazing", &self.grazing[i])] {
                if histogram.worst() > WORST[i] {
                    broken.push(format!("{class} {quantity}: {} ulp", histogram.worst()));
                }
                if histogram.count() > 300 && histogram.median() > MEDIAN[i] {
                    broken.push(format!("{class} {quantity}: median {} ulp", histogram.median()));
                }
            }
        }
        broken
    }

    pub(crate) fn merge(&mut self, other: Errors) {
        for i in 0..QUANTITIES.len() {
            self.steep[i].values.extend(&other.steep[i].values);
            self.grazing[i].values.extend(&other.grazing[i].values);
        }
        self.wrong.extend(other.wrong);
        self.at_vertices += other.at_vertices;
        self.undecided += other.undecided;
    }
}

/// Whether a path runs along walls within rounding between two times that differ by more than rounding: either is right.
fn along_the_wall(subject: &Subject<'_>, path: &Line<2>, [from, to]: [f64; 2], ulp: f64) -> bool {
    let near = |k: i32| {
        let p = path.at(from + (to - from) * f64::from(k) / 16.0);
        let distance = |piece: &&dyn Piece| (piece.closest(&p).point - p).amax();
        subject.pieces.iter().map(distance).fold(f64::INFINITY, f64::min) <= NEAR * ulp
    };
    (to - from).abs() * path.velocity.amax() > NEAR * ulp && (0..=16).all(near)
}

/// Velocity and spin after a collision: specular, or no-slip with γ.
fn reflected(v: &Vector, spin: f64, n: &Vector, gamma: Option<f64>) -> (Vector, Big) {
    let (vn, w) = (dot(v, n), big(spin));
    let Some(gamma) = gamma.map(big) else { return (sub(v, &scale(n, &(big(2.0) * vn))), w) };
    let t = left(n);
    let vt = dot(v, &t);
    let square = &gamma * &gamma;
    let [c, s] = [(big(1.0) - &square) / (big(1.0) + &square), big(2.0) * &gamma / (big(1.0) + &square)];
    let along = &s * &w + &c * &vt;
    (add(&scale(n, &-vn), &scale(&t, &along)), &s * &vt - &c * &w)
}
