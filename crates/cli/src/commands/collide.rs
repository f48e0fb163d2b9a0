//! `billiards collide`: one collision of two rigid bodies.

use std::io::{self, Write};

use billiards::collision_laws::bodies::{Inertia, RigidBody};
use billiards::collision_laws::check::{self, Axiom, Samples};
use billiards::collision_laws::laws::RoughPlane;
use billiards::collision_laws::{AnyLaw, Contact, Error, Pair, TangentVector, Twist};
use nalgebra::{SMatrix, SVector};
use serde_json::{Value, json};

use super::Failure;
use crate::contact_file::{BodyEntry, ContactFile, InertiaEntry, LawEntry, Motion};
use crate::document::{Diagnostic, Problems, Source, Span, spell};
use crate::scene::LawKind;
use crate::simulation::any_law;

/// Greatest width of a table, in characters; a wider one is printed line by line.
const WIDEST: usize = 110;

/// A collision, computed. Vectors have N entries; spins have the form of the contact file.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Dimension of space.
    pub dimension: usize,
    /// The law, in words, and its number k of rough directions, if it is strict.
    pub law: (String, Option<usize>),
    /// Whether each body is fixed.
    pub fixed: [bool; 2],
    /// Impulse on body 1; body 2 received its opposite.
    pub impulse: Vec<f64>,
    /// Everything before and after.
    pub states: [State; 2],
    /// How far the law is from each axiom at this contact; axioms that do not apply here are left out.
    pub defects: Vec<(String, f64)>,
    /// The axioms it breaks.
    pub broken: Vec<(String, f64)>,
}

/// Velocities at one moment, and what follows from them.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Velocity and spin of each body.
    pub motions: [(Vec<f64>, Vec<f64>); 2],
    /// Velocity of the touching point of body 1 minus that of body 2.
    pub contact_velocity: Vec<f64>,
    /// Its component along the unit normal.
    pub normal_velocity: f64,
    /// Kinetic energy.
    pub energy: f64,
    /// Total linear momentum.
    pub momentum: Vec<f64>,
    /// Total angular momentum about the contact point: one number in the plane, three in space, else one per plane of
    /// axes (2,1), (3,1), (3,2), (4,1), …
    pub angular_momentum: Vec<f64>,
}

/// Reads a contact file, computes the collision and prints it.
///
/// # Errors
/// The file is wrong, the bodies do not collide, or the output cannot be written.
pub fn run(source: &Source, json: bool, out: &mut impl Write) -> Result<(), Failure> {
    let outcome = outcome(&ContactFile::parse(source)?)?;
    if json {
        writeln!(out, "{:#}", outcome.to_json())?;
    } else {
        outcome.describe(out)?;
    }
    Ok(())
}

/// Computes the collision of a contact file.
///
/// # Errors
/// The bodies, their velocities or the law are not as they must be, or the bodies do not collide.
pub fn outcome(file: &ContactFile) -> Result<Outcome, Vec<Diagnostic>> {
    match file.dimension {
        2 => collide::<2>(file),
        3 => collide::<3>(file),
        4 => collide::<4>(file),
        _ => collide::<5>(file),
    }
}

type Free<const N: usize> = Option<RigidBody<N>>;

/// What is wrong, and where.
type Fault = (Span, Error);

fn collide<const N: usize>(file: &ContactFile) -> Result<Outcome, Vec<Diagnostic>> {
    let mut problems = Problems::new(&file.source);
    let contact = Contact::<N>::new(vector(&file.point.value), vector(&file.normal.value), 0)
        .map_err(|error| (file.normal.span, error));
    let contact = kept(contact, &mut problems);
    let [first, second] = [0, 1].map(|i| kept(body::<N>(&file.bodies.value[i]), &mut problems));
    let [v1, v2] = [0, 1].map(|i| kept(twist::<N>(&file.before.value[i]), &mut problems));
    let law = contact.and_then(|contact| kept(law(file, &contact), &mut problems));
    let (Some(contact), Some(first), Some(second), Some(v1), Some(v2), Some((law, name, rank))) =
        (contact, first, second, v1, v2, law)
    else {
        return Err(problems.into_diagnostics());
    };

    let [x1, x2] = [0, 1].map(|i| vector(&file.bodies.value[i].position));
    let pair = Pair::from_centres(contact, (first, x1), (second, x2));
    let before = (v1, v2);
    let collision = match pair.try_collide(&law, &before) {
        Ok(collision) => collision,
        Err(error) => return Err(vec![refusal(file, &error)]),
    };
    let report = check::law(&pair, &law, Samples::default());
    let named = |(axiom, defect): (Axiom, f64)| (axiom.to_string(), defect);
    let outcome = Outcome {
        dimension: N,
        law: (name, rank),
        fixed: [pair.first.is_none(), pair.second.is_none()],
        impulse: list(&collision.impulse),
        states: [state(&pair, &before), state(&pair, &collision.velocities)],
        defects: Axiom::ALL.into_iter().filter_map(|axiom| Some((axiom, report.defect(axiom)?))).map(named).collect(),
        broken: report.broken(check::tolerance(&pair)).map(named).collect(),
    };
    if outcome.is_finite() {
        return Ok(outcome);
    }
    let what = "masses, lengths and speeds differ so much in size that the result is not a finite number";
    Err(vec![file.source.diagnostic(file.bodies.span, what)])
}

/// Why there is no collision, with advice.
fn refusal(file: &ContactFile, error: &Error) -> Diagnostic {
    let at = |span| file.source.diagnostic(span, error.to_string());
    match error {
        Error::NotApproaching { .. } => {
            at(file.before.span).with_help("the normal points from body 2 towards body 1; is it the other way round?")
        }
        Error::SingularDelassus { body } => {
            let free = body.checked_sub(1).and_then(|i| file.bodies.value.get(i)?.free.as_ref());
            at(free.map_or(file.bodies.span, |(_, inertia)| inertia.span))
                .with_help(format!("give body {body} more inertia, or a position nearer to the contact point"))
        }
        _ => at(file.bodies.span),
    }
}

fn kept<T>(found: Result<T, Fault>, problems: &mut Problems) -> Option<T> {
    let record = |(span, error): Fault| match mend(&error) {
        Some(help) => problems.add_with_help(span, error.to_string(), help),
        None => problems.add(span, error.to_string()),
    };
    found.map_err(record).ok()
}

/// How to fix a body, a contact or a law; `None` where the error message says so itself.
fn mend(error: &Error) -> Option<&'static str> {
    Some(match error {
        Error::NotPositive { .. } => "write a number above 0",
        Error::NoNormal => "write the direction from body 2 towards body 1",
        Error::InertiaNotSymmetric { .. } => "write the same number in row i, column j as in row j, column i",
        Error::InertiaNotPositive { .. } | Error::SecondMomentsOfLowRank => {
            "a body must resist turning in every plane: a rod in space needs some thickness"
        }
        Error::SecondMomentsNotPositive { .. } => {
            "all eigenvalues of S must be 0 or more: are its off-diagonal entries too large?"
        }
        Error::SpinNotSkew { .. } => {
            "write 0 on the diagonal, and in row j, column i the negative of the entry in row i, column j"
        }
        Error::RoughDirectionAlongNormal { .. } => "leave it out, or write one that is not along the normal",
        Error::DependentRoughDirections { .. } => "leave it out: it adds nothing to the others",
        _ => return None,
    })
}

fn vector<const N: usize>(numbers: &[f64]) -> SVector<f64, N> {
    SVector::from_iterator(numbers.iter().copied().chain(std::iter::repeat(0.0)))
}

fn matrix<const N: usize>(rows: &[f64]) -> SMatrix<f64, N, N> {
    SMatrix::from_fn(|i, j| rows.get(i * N + j).copied().unwrap_or(0.0))
}

fn list<const N: usize>(vector: &SVector<f64, N>) -> Vec<f64> {
    vector.iter().copied().collect()
}

fn body<const N: usize>(entry: &BodyEntry) -> Result<Free<N>, Fault> {
    let Some((mass, inertia)) = &entry.free else { return Ok(None) };
    let form = match &inertia.value {
        InertiaEntry::Moment(moment) => Inertia::Moment(*moment),
        InertiaEntry::Tensor(rows) => Inertia::Tensor(matrix(rows)),
        InertiaEntry::SecondMoments(rows) => Inertia::SecondMoments(matrix(rows)),
    };
    RigidBody::new(mass.value, form).map(Some).map_err(|error| (inertia.span, error))
}

fn twist<const N: usize>(motion: &Motion) -> Result<Twist<N>, Fault> {
    let (v, w) = (vector(&motion.v.value), &motion.w.value);
    let twist = if N <= 3 { Twist::with_spin_coordinates(v, w) } else { Twist::new(v, matrix(w)) };
    twist.map_err(|error| (motion.w.span, error))
}

/// A law, what to call it, and its number of rough directions if it is strict.
type NamedLaw<const N: usize> = (AnyLaw<N>, String, Option<usize>);

fn law<const N: usize>(file: &ContactFile, contact: &Contact<N>) -> Result<NamedLaw<N>, Fault> {
    let (kind, span) = match &file.law {
        LawEntry::Named(law) => (&law.value, law.span),
        LawEntry::Rough(directions) => {
            let vectors: Vec<_> = directions.iter().map(|direction| vector(&direction.value)).collect();
            return rough(contact, &vectors).map_err(|error| {
                let index = match error {
                    Error::RoughDirectionAlongNormal { index } | Error::DependentRoughDirections { index } => index,
                    _ => 0,
                };
                (directions.get(index).map_or(file.normal.span, |direction| direction.span), error)
            });
        }
    };
    let at = |error| (span, error);
    let (name, rank) = match kind {
        LawKind::Specular => ("specular".into(), Some(0)),
        LawKind::NoSlip => ("no-slip".into(), Some(N - 1)),
        LawKind::Random { rank, .. } => ("random rough directions".into(), Some(*rank)),
        LawKind::Restitution { normal, tangential } => {
            (format!("restitution {} and {}", spell(*normal), spell(*tangential)), None)
        }
        LawKind::Rough(directions) => {
            let vectors: Vec<_> = directions.iter().map(|direction| vector(direction)).collect();
            return rough(contact, &vectors).map_err(at);
        }
    };
    Ok((any_law(kind).map_err(at)?, name, rank))
}

fn rough<const N: usize>(contact: &Contact<N>, directions: &[SVector<f64, N>]) -> Result<NamedLaw<N>, Error> {
    let law = RoughPlane::new(directions)?;
    let rank = law.at(contact)?.rank();
    Ok((AnyLaw::new(law), "given rough directions".into(), Some(rank)))
}

fn state<const N: usize>(pair: &Pair<Free<N>, Free<N>, N>, velocities: &(Twist<N>, Twist<N>)) -> State {
    let u = pair.contact_velocity(velocities);
    // Momenta are the products, in the metric, with the rigid motions of the whole space, about the contact point.
    let product = |a: SVector<f64, N>, spin: SMatrix<f64, N, N>| {
        let motion = [0, 1].map(|i| Twist::of_rigid_motion(&pair.arms[i], &a, &spin));
        pair.inner_product(velocities, &(motion[0], motion[1]))
    };
    let unit = |i: usize| SVector::from_fn(|j, _| if i == j { 1.0 } else { 0.0 });
    let turn = |i: usize, j: usize| {
        let mut spin = SMatrix::zeros();
        spin[(i, j)] = 1.0;
        spin[(j, i)] = -1.0;
        spin
    };
    let planes: Vec<(usize, usize)> = match N {
        3 => vec![(2, 1), (0, 2), (1, 0)],
        _ => (0..N).flat_map(|i| (0..i).map(move |j| (i, j))).collect(),
    };
    let motion = |twist: &Twist<N>| {
        let w = if N <= 3 { twist.spin_coordinates() } else { twist.spin().transpose().iter().copied().collect() };
        (list(&twist.linear), w)
    };
    State {
        motions: [motion(&velocities.0), motion(&velocities.1)],
        contact_velocity: list(&u),
        normal_velocity: pair.contact.normal.dot(&u),
        energy: pair.kinetic_energy(velocities),
        momentum: (0..N).map(|i| product(unit(i), SMatrix::zeros())).collect(),
        angular_momentum: planes.into_iter().map(|(i, j)| product(SVector::zeros(), turn(i, j))).collect(),
    }
}

impl State {
    /// The kinetic energy, if it is in the range of numbers with full precision; for moving bodies it is never 0.
    fn shown_energy(&self) -> String {
        let moves = self.motions.iter().any(|(v, w)| v.iter().chain(w).any(|x| *x != 0.0));
        if moves && self.energy < f64::MIN_POSITIVE { "below 2.3e-308".into() } else { shown(&[self.energy]) }
    }
}

impl Outcome {
    fn is_finite(&self) -> bool {
        let finite = |numbers: &[f64]| numbers.iter().all(|x| x.is_finite());
        finite(&self.impulse)
            && self.states.iter().all(|state| {
                let State { motions, contact_velocity, normal_velocity, energy, momentum, angular_momentum } = state;
                motions.iter().all(|(v, w)| finite(v) && finite(w))
                    && [contact_velocity, momentum, angular_momentum].iter().all(|numbers| finite(numbers))
                    && finite(&[*normal_velocity, *energy])
            })
    }

    /// The outcome as JSON: `impulse_on_body_1`, `u_minus`, `u_plus`, `post`, `energy_before`, `energy_after`, and more.
    pub fn to_json(&self) -> Value {
        let [before, after] = &self.states;
        let n = self.dimension;
        let spin = |w: &[f64]| match n {
            2 => json!(w[0]),
            3 => json!(w),
            _ => json!(w.chunks(n).collect::<Vec<_>>()),
        };
        let post: Vec<_> = after.motions.iter().map(|(v, w)| json!({ "v": v, "w": spin(w) })).collect();
        let momenta = |state: &State| json!({ "linear": state.momentum, "angular": state.angular_momentum });
        let defects: serde_json::Map<_, _> = self.defects.iter().map(|(name, x)| (name.clone(), json!(x))).collect();
        json!({
            "dim": n,
            "law": self.law.0,
            "k": self.law.1,
            "impulse_on_body_1": self.impulse,
            "u_minus": before.contact_velocity,
            "u_plus": after.contact_velocity,
            "post": post,
            "energy_before": before.energy,
            "energy_after": after.energy,
            "momenta_before": momenta(before),
            "momenta_after": momenta(after),
            "strict": self.broken.is_empty(),
            "defects": defects,
        })
    }

    /// Prints the outcome as an aligned table, numbers to twelve digits.
    ///
    /// # Errors
    /// The output cannot be written.
    pub fn describe(&self, out: &mut impl Write) -> io::Result<()> {
        let rank = self.law.1.map_or(String::new(), |k| format!(" (k = {k})"));
        writeln!(out, "Collision in dimension {}, law: {}{rank}\n", self.dimension, self.law.0)?;
        let [before, after] = &self.states;
        let mut rows = vec![[String::new(), "before".into(), "after".into()]];
        let mut row = |name: &str, of: &dyn Fn(&State) -> String| rows.push([name.into(), of(before), of(after)]);
        for (i, name) in ["body 1", "body 2"].into_iter().enumerate() {
            if !self.fixed[i] {
                row(&format!("{name}, velocity"), &|state| shown(&state.motions[i].0));
                row(&format!("{name}, spin"), &|state| shown(&self.spin(&state.motions[i].1)));
            }
        }
        row("contact velocity", &|state| shown(&state.contact_velocity));
        row("  along the normal", &|state| shown(&[state.normal_velocity]));
        row("kinetic energy", &State::shown_energy);
        row("linear momentum", &|state| shown(&state.momentum));
        row("angular momentum *", &|state| shown(&state.angular_momentum));
        let widths = [0, 1, 2].map(|i| rows.iter().map(|row| row[i].chars().count()).max().unwrap_or(0) + 3);
        let wide = widths.iter().sum::<usize>() > WIDEST;
        for [name, before, after] in rows.iter().skip(usize::from(wide)) {
            if wide {
                writeln!(out, "{name}\n    before {before}\n    after  {after}")?;
            } else {
                writeln!(out, "{name:<a$}{before:<b$}{after}", a = widths[0], b = widths[1])?;
            }
        }
        writeln!(out, "\n{:<width$}{}", "impulse on body 1", shown(&self.impulse), width = widths[0])?;
        let worst = self.defects.iter().max_by(|(_, a), (_, b)| a.total_cmp(b)).filter(|(_, x)| *x > 0.0);
        let verdict = if self.broken.is_empty() {
            let largest = worst.map(|(name, x)| format!("; the largest defect is {x:.1e} ({name})"));
            format!("yes, every axiom holds{}", largest.unwrap_or_default())
        } else {
            let broken: Vec<_> = self.broken.iter().map(|(name, x)| format!("{name} (by {x:.1e})")).collect();
            format!("no, it breaks: {}", broken.join(", "))
        };
        writeln!(out, "{:<width$}{verdict}", "strict law", width = widths[0])?;
        writeln!(out, "\n* about the contact point{}", self.entries())?;
        match self.fixed {
            [true, _] => writeln!(out, "Body 1 is fixed: it takes up momentum and does not move."),
            [_, true] => writeln!(out, "Body 2 is fixed: it takes up momentum and does not move."),
            _ => Ok(()),
        }
    }

    /// The independent numbers of a spin.
    fn spin(&self, w: &[f64]) -> Vec<f64> {
        let n = self.dimension;
        if n <= 3 { w.to_vec() } else { (0..n).flat_map(|i| (0..i).map(move |j| w[i * n + j])).collect() }
    }

    /// Names the matrix entries that the numbers of a spin are.
    fn entries(&self) -> String {
        if self.dimension <= 3 {
            return String::new();
        }
        let entries: Vec<_> = (1..=self.dimension).flat_map(|i| (1..i).map(move |j| format!("{i}{j}"))).collect();
        let entries = entries.join(", ");
        format!(
            "\n  spins and angular momenta: entries {entries} (row, column) of the matrix; 21 turns axis 1 towards axis 2"
        )
    }
}

/// Numbers to twelve digits, in parentheses unless there is only one.
fn shown(numbers: &[f64]) -> String {
    // −0 is 0
    let short = |x: &f64| format!("{:.11e}", x + 0.0).parse().map_or_else(|_| x.to_string(), spell);
    match numbers {
        [x] => short(x),
        _ => format!("({})", numbers.iter().map(short).collect::<Vec<_>>().join(", ")),
    }
}
