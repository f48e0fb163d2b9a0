//! A disk on a planar table.

use std::sync::Arc;

use billiards::geometry::{Error, Piece, Table, Vector2};
use billiards::{Angle, BallLaw, Canonical, Cell, Clock, Grid, OnWalls, Orbit};

use super::Control;
use super::boundary::{self, Drawn};
use super::departure::departed;
use super::engine::{Engine, Watched, WithEngine, conserved};
use super::frame::Frame;
use super::horizon::{self, Horizons};
use super::law::{PlanarLaw, keeps_spin};
use super::portraits::{Clouds, PlanarPortraits};
use super::remote;
use super::scale::{Scale, to_unity};
use super::start::{self, ByNumber, Spins, Start, Starts, Still};
use super::trail::PlanarTrail;
use super::unrolled::Unrolled;
use crate::document::{Diagnostic, spell};
use crate::scene::{self, LawKind, Sample, Scene};

/// A planar scene, ready to run.
#[derive(Clone, Debug)]
pub(crate) struct Planar {
    /// The walls as drawn.
    pub(crate) drawn: Drawn,
    /// Where centres move.
    pub(crate) centres: Table,
    /// The drawn piece that each piece of `centres` stands for.
    pub(crate) pieces: Vec<u64>,
    law: PlanarLaw,
    /// Whether every collision conserves the energy.
    pub(crate) strict: bool,
    starts: Starts<2, 1>,
}

impl Planar {
    /// Builds everything and checks every start.
    pub(crate) fn new(scene: &Scene) -> Result<Planar, Vec<Diagnostic>> {
        let drawn = boundary::draw(scene)?;
        let (centres, pieces) = centres(scene, &drawn)?;
        let kind = |piece: u64| -> &LawKind {
            let own = usize::try_from(piece).ok().and_then(|i| drawn.laws.get(i)).and_then(Option::as_ref);
            own.unwrap_or(&scene.law.kind)
        };
        let gamma = libm::sqrt(scene.particle.gamma_squared.value);
        let law = PlanarLaw::new(pieces.iter().zip(centres.pieces()).map(|(n, piece)| (kind(*n), &**piece)), gamma)
            .map_err(|what| vec![scene.source.diagnostic(scene.law.span, what)])?;
        let bounded = remote::bounded(centres.pieces().iter().map(Piece::extent));
        let starts = match &scene.starts {
            scene::Starts::Orbits(orbits) => Starts::Given(start::all(orbits, |orbit| {
                start::planar(scene, (&centres, &pieces), bounded.as_ref(), orbit, drawn.factor)
            })?),
            scene::Starts::Ensemble(ensemble) => Starts::Ensemble(ensemble.clone(), Spins::of(&scene.particle)),
        };
        let strict = law.is_strict();
        let planar = Planar { drawn, centres, pieces, law, strict, starts };
        // an ensemble that cannot be drawn is detected before anything is written
        let problem = planar.starts().err();
        match (problem, &planar.starts) {
            (Some(billiards::Error::Table(error)), Starts::Ensemble(ensemble, _)) => {
                Err(vec![start::undrawable(scene, ensemble, &error)])
            }
            (Some(error), Starts::Ensemble(ensemble, _)) => {
                Err(vec![scene.source.diagnostic(ensemble.span, error.to_string())])
            }
            _ => Ok(planar),
        }
    }

    /// How many orbits there are.
    pub(crate) fn orbits(&self) -> u64 {
        self.starts.count()
    }

    /// The start of an orbit, by its number.
    pub(crate) fn starts(&self) -> Result<ByNumber<'_, 2, 1>, billiards::Error> {
        let (ensemble, spins) = match self.starts.given() {
            Ok(starts) => return Ok(starts),
            Err(ensemble) => ensemble,
        };
        let scale = Scale { length: self.drawn.factor, speed: to_unity([ensemble.speed.value]) };
        let speed = ensemble.speed.value * scale.speed;
        let (table, count, seed) = (&self.centres, ensemble.count.value, ensemble.seed);
        let drawn: Box<dyn billiards::Starts<2, 1>> = match (ensemble.sample.value, spins) {
            (Sample::Grid, Spins::Spinning) => Box::new(Grid::with_count(table, speed, count)?),
            (Sample::Grid, Spins::Still) => Box::new(Still(Grid::of_points(table, speed, count)?)),
            (Sample::Canonical, Spins::Spinning) => Box::new(Canonical::new(table, speed, seed)?),
            (Sample::Canonical, Spins::Still) => Box::new(Still(Canonical::of_points(table, speed, seed)?)),
        };
        Ok(Box::new(move |i| {
            let start = drawn.start(i);
            let home = start::folded(&self.centres, &start.position);
            let (position, cell) = home;
            Start { position, velocity: start.velocity, spin: start.spin, angle: 0.0, cell, departure: 0.0, scale }
        }))
    }

    /// The map from the engine's coordinates to the user's.
    pub(crate) fn frame(&self) -> Frame<'_> {
        Frame { shift: [0.0; 3], cell: self.centres.cell().filter(|cell| !cell.is_unit_cell()) }
    }

    /// Where an orbit starts, in the user's units and not folded into the unit cell of a lattice.
    pub(crate) fn lifted(&self, start: &Start<2, 1>) -> [f64; 2] {
        let shift = self.centres.lattice().map_or(Vector2::zeros(), |lattice| lattice.translation(start.cell));
        (Vector2::from(start.position) + shift).map(|x| start.scale.length_out(x)).into()
    }

    /// An orbit at its start.
    pub(crate) fn launch(&self, start: &Start<2, 1>) -> Watched<2, 1, PlanarTrail> {
        let cell = self.centres.lattice().map(|lattice| {
            let mut cell = Cell::new(Arc::new(lattice.clone()), 0.0);
            cell.cell = start.cell;
            cell
        });
        let trail = PlanarTrail { angle: Angle::new(start.angle), cell };
        let orbit = Orbit {
            position: start.position,
            velocity: start.velocity,
            spin: start.spin,
            keeper: conserved(self.strict, &start.velocity, &start.spin),
            track: (Clock::new(0.0), trail),
        };
        departed(orbit, start.departure)
    }

    /// A maker of counters of at most `points` points for these clouds, if there are any.
    #[allow(clippy::type_complexity, reason = "a function, boxed")]
    pub(crate) fn portraits(&self, clouds: &Clouds, points: f64) -> Option<Box<dyn Fn() -> PlanarPortraits + Sync>> {
        let unrolled = clouds.reduced.is_some().then(|| Arc::new(Unrolled::of(&self.centres, points)));
        let (clouds, strict) = (clouds.clone(), self.strict);
        clouds.any().then(|| -> Box<dyn Fn() -> PlanarPortraits + Sync> {
            Box::new(move || PlanarPortraits::new(&clouds, unrolled.as_ref(), strict))
        })
    }

    /// How long the digits of the first orbits last, within a number of collisions and a time.
    pub(crate) fn horizons(&self, limit: [f64; 2], control: &Control) -> Result<Horizons, billiards::Error> {
        let starts = self.starts()?;
        let extent = self.centres.extent();
        let size = self
            .centres
            .cell()
            .map_or_else(|| horizon::size(extent.min.as_slice(), extent.max.as_slice()), horizon::cell_size);
        Ok(self.with_engine(|engine| {
            let launch = |orbit| {
                let start = starts(orbit);
                (start, self.launch(&start))
            };
            Horizons::of(engine, &self.centres, size, self.orbits(), &launch, limit, control)
        }))
    }

    /// Whether no collision under a strict law turns velocity into spin.
    pub(crate) fn keeps_spin(&self) -> bool {
        keeps_spin(&self.law, self.pieces.len())
    }

    /// Runs something with the engine for this table and law.
    pub(crate) fn with_engine<R>(&self, then: impl FnOnce(&dyn Engine<2, 1, PlanarTrail>) -> R) -> R {
        self.centres.with_walls(OnWalls { law: &self.law, then: WithEngine(then) })
    }
}

/// Where the centre of the particle can be, and the drawn piece that each piece of that region stands for.
fn centres(scene: &Scene, drawn: &Drawn) -> Result<(Table, Vec<u64>), Vec<Diagnostic>> {
    let radius = scene.particle.radius;
    if radius.value == 0.0 {
        return Ok((drawn.table.clone(), (0..drawn.table.pieces().len() as u64).collect()));
    }
    match drawn.table.offset(radius.value * drawn.factor) {
        Ok(offset) => Ok((offset.table, offset.origins.iter().map(|origin| origin.piece() as u64).collect())),
        Err(error) => {
            let error = drawn.in_user_units(&error);
            let what = match &error {
                Error::NothingLeft { .. } | Error::Undecided { .. } => error.to_string(),
                other => format!("a disk of radius {}: {other}", spell(radius.value)),
            };
            let diagnostic = scene.source.diagnostic(radius.span, what);
            Err(vec![match error {
                Error::Bend { .. } | Error::RoughPiece { .. } => {
                    boundary::with_advice(diagnostic, &error, &scene.table.shape)
                }
                _ => diagnostic,
            }])
        }
    }
}
