//! Orbits of a disk, as the claims see them.
use billiards::{
    Angle, Canonical, Clock, Collision, Collisions, Conserved, Orbit, Planar, Start, Starts, Stop, Timed,
    collision_laws::{
        DiskLaw,
        laws::{NoSlip, Specular},
    },
    geometry::Table,
    laws::Disk,
    observe::Watch,
};
use core::ops::ControlFlow;

/// A disk on a table.
pub(crate) type Billiard = Planar<Disk>;

/// No-slip disks with the given `γ²` on a table.
pub(crate) fn no_slip<E: core::fmt::Debug>(table: Result<Table, E>, gamma_squared: f64) -> Billiard {
    with_law(table, &NoSlip, gamma_squared)
}

/// Smooth disks on a table.
pub(crate) fn specular<E: core::fmt::Debug>(table: Result<Table, E>) -> Billiard {
    with_law(table, &Specular, 1.0)
}

/// The tables of the claims have constant parameters within their ranges.
fn with_law<E: core::fmt::Debug>(table: Result<Table, E>, law: &impl DiskLaw, gamma_squared: f64) -> Billiard {
    Planar {
        table: table.expect("a table with parameters in range"),
        law: Disk::new(law, libm::sqrt(gamma_squared)).expect("a γ in range"),
    }
}

/// Where a disk is and how it moves: `(x₀, x₁, x₂)` and its derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct State {
    pub(crate) x: [f64; 3],
    pub(crate) v: [f64; 3],
}

impl State {
    /// The state with all motion reversed.
    pub(crate) fn reversed(self) -> State {
        State { x: self.x, v: self.v.map(|v| -v) }
    }
}

impl From<Start<2, 1>> for State {
    fn from(start: Start<2, 1>) -> State {
        let Start { position: [x1, x2], velocity: [v1, v2], spin: [v0] } = start;
        State { x: [0.0, x1, x2], v: [v0, v1, v2] }
    }
}

/// A collision: when and where, and the state right after it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounce {
    /// Its number, from 1.
    pub(crate) n: usize,
    pub(crate) piece: usize,
    /// Since the start.
    pub(crate) time: f64,
    pub(crate) state: State,
    /// Unit normal, into the table.
    pub(crate) normal: [f64; 2],
}

impl Bounce {
    fn of<K>(c: &Collision<'_, 2, 1, K, (Clock, Angle)>) -> Bounce {
        let o = c.orbit;
        Bounce {
            n: usize::try_from(c.n).unwrap_or(usize::MAX),
            piece: c.piece(),
            time: o.track.time(),
            state: State {
                x: [o.track.1.0.value(), o.position[0], o.position[1]],
                v: [o.spin[0], o.velocity[0], o.velocity[1]],
            },
            normal: c.hit.unit_normal(),
        }
    }

    /// `v·ν`
    pub(crate) fn normal_velocity(&self) -> f64 {
        self.state.v[1] * self.normal[0] + self.state.v[2] * self.normal[1]
    }

    /// `v·t`, `t = J ν`.
    pub(crate) fn tangential_velocity(&self) -> f64 {
        self.state.v[2] * self.normal[0] - self.state.v[1] * self.normal[1]
    }
}

/// How the orbit of a state ends: after `most` collisions, or before that because `watch` or the motion says so.
///
/// All claims pass closures of one type, so that the engine is compiled only once.
pub(crate) fn fly(
    billiard: &Billiard,
    start: State,
    most: usize,
    watch: &mut dyn FnMut(&Bounce) -> ControlFlow<()>,
) -> Stop {
    let State { x, v } = start;
    let track = (Clock::new(0.0), Angle::new(x[0]));
    let mut orbit = Orbit::<_, 2, 1, Conserved<_, 2>, _>::new([x[1], x[2]], [v[1], v[2]], [v[0]], track);
    let mut look = Watch::new(|c: &Collision<'_, 2, 1, _, _>| watch(&Bounce::of(c)));
    billiard.run(&mut orbit, &Collisions(most as u64), &mut look).stop
}

/// The first `most` collisions of an orbit, or as many as there are.
pub(crate) fn bounces(billiard: &Billiard, start: State, most: usize) -> Vec<Bounce> {
    let mut all = Vec::with_capacity(most);
    fly(billiard, start, most, &mut |bounce| {
        all.push(*bounce);
        ControlFlow::Continue(())
    });
    all
}

/// The starts of disks at unit speed drawn by the canonical measure, one for each number of a sample. Any table with a finite boundary has
/// them.
pub(crate) fn canonical(billiard: &Billiard, seed: u64) -> impl Fn(usize) -> State {
    let starts = Canonical::new(&billiard.table, 1.0, seed).expect("a finite boundary");
    move |sample| starts.start(sample as u64).into()
}

/// `|a − b|`
pub(crate) fn distance<const N: usize>(a: [f64; N], b: [f64; N]) -> f64 {
    libm::sqrt(a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum())
}
