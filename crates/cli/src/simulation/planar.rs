//! A disk on a planar table.

use std::sync::Arc;

use billiards::geometry::{Table, Vector2, Walls, WithWalls};
use billiards::{Angle, Billiard, Cell, Clock, Orbit};

use super::boundary::{self, Drawn};
use super::engine::{Engine, Keeper, PlanarTrail, Watched};
use super::law::{PlanarLaw, is_strict};
use super::start::{self, Start};
use crate::document::Diagnostic;
use crate::scene::{LawKind, Scene, Starts};

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
    strict: bool,
    starts: Vec<Start<2, 1>>,
}

impl Planar {
    /// Builds everything and checks every start.
    pub(crate) fn new(scene: &Scene) -> Result<Planar, Vec<Diagnostic>> {
        let drawn = boundary::draw(scene)?;
        let centres = drawn.table.clone();
        let pieces: Vec<u64> = (0..centres.pieces().len() as u64).collect();
        let kind = |piece: u64| -> &LawKind {
            let own = usize::try_from(piece).ok().and_then(|i| drawn.laws.get(i)).and_then(Option::as_ref);
            own.unwrap_or(&scene.law.kind)
        };
        let strict = pieces.iter().all(|piece| is_strict(kind(*piece)));
        let gamma = libm::sqrt(scene.particle.gamma_squared.value);
        let law = PlanarLaw::new(pieces.iter().zip(centres.pieces()).map(|(n, piece)| (kind(*n), &**piece)), gamma);
        let starts = match &scene.starts {
            Starts::Orbits(orbits) => {
                let checked = orbits.iter().map(|orbit| start::planar(scene, &centres, orbit, drawn.factor));
                let (good, bad): (Vec<_>, Vec<_>) = checked.partition(Result::is_ok);
                if !bad.is_empty() {
                    return Err(bad.into_iter().filter_map(Result::err).map(|e| *e).collect());
                }
                good.into_iter().filter_map(Result::ok).collect()
            }
            Starts::Ensemble(ensemble) => {
                return Err(vec![scene.source.diagnostic(ensemble.span, "ensembles are not supported")]);
            }
        };
        Ok(Planar { drawn, centres, pieces, law, strict, starts })
    }

    /// How many orbits there are.
    pub(crate) fn orbits(&self) -> u64 {
        self.starts.len() as u64
    }

    /// The start of an orbit.
    pub(crate) fn start(&self, index: u64) -> Start<2, 1> {
        self.starts[usize::try_from(index).unwrap_or(usize::MAX) % self.starts.len()]
    }

    /// Where an orbit starts, in the user's units and not folded into the unit cell of a lattice.
    pub(crate) fn lifted_start(&self, index: u64) -> [f64; 2] {
        let start = self.start(index);
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
        Orbit {
            position: start.position,
            velocity: start.velocity,
            spin: start.spin,
            keeper: Keeper::for_law(self.strict, &start.velocity, &start.spin),
            track: (Clock::new(0.0), trail),
        }
    }

    /// Runs something with the engine for this table and law.
    pub(crate) fn with_engine<R>(&self, then: impl FnOnce(&dyn Engine<2, 1, PlanarTrail>) -> R) -> R {
        self.centres.with_walls(On { law: &self.law, then })
    }
}

struct On<'a, A> {
    law: &'a PlanarLaw,
    then: A,
}

impl<R, A: FnOnce(&dyn Engine<2, 1, PlanarTrail>) -> R> WithWalls<2> for On<'_, A> {
    type Output = R;
    fn run<W: Walls<2>>(self, walls: &W) -> R {
        (self.then)(&Billiard { walls, law: self.law })
    }
}
