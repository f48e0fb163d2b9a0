//! The tables that are timed, and what is known about each beforehand.

use billiards::geometry::tables::{self, SpatialTable};
use billiards::geometry::{Error, Line, SVector, Table, Vector2, Vector3};
use billiards::{Canonical, CanonicalSpatial, Starts};

use super::law::Law;
use super::real::Real;
use super::state::{State, first};
use super::textbook::Textbook;

/// A table to be timed.
#[derive(Debug)]
pub struct Case {
    /// Its name in scenes.
    pub name: &'static str,
    /// Where the particle moves.
    pub space: Space,
    /// Half the larger side of a box around the table, the whole width of a strip or slab \[L\]: errors of positions are relative to it.
    pub size: f64,
    /// The boundary as one formula, if there is one.
    pub formulas: Option<Formulas>,
    /// Its semi-axes, if it is an ellipse \[L\].
    semi_axes: Option<[f64; 2]>,
    invariant: fn(Law) -> Option<Invariant>,
}

/// A table in the plane or in space.
#[derive(Debug)]
pub enum Space {
    /// In the plane.
    Plane(Table),
    /// In space.
    Room(SpatialTable),
}

/// One closed curve, as a scene may write it.
#[derive(Clone, Copy, Debug)]
pub struct Formulas {
    /// Zero on the curve, in `x` and `y`.
    pub implicit: &'static str,
    /// The radius, in `t`.
    pub polar: &'static str,
    /// A box around it, as half its sides.
    pub within: [f64; 2],
}

/// A quantity conserved by the motion on this table besides the energy, at unit speed.
#[derive(Clone, Copy, Debug)]
pub struct Invariant {
    /// What it is.
    pub name: &'static str,
    /// Its value right after a collision.
    pub of: fn(&State<f64>) -> f64,
}

/// An entry of the registry.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Its name.
    pub name: &'static str,
    build: fn() -> Result<Case, Error>,
}

impl Entry {
    /// Builds the table.
    ///
    /// # Errors
    /// Those of the table's constructor.
    pub fn build(&self) -> Result<Case, Error> {
        (self.build)()
    }
}

/// Every table, in the order of the report.
pub const CASES: &[Entry] = &[
    Entry { name: "circle", build: circle },
    Entry { name: "ellipse", build: ellipse },
    Entry { name: "square", build: square },
    Entry { name: "hexagon", build: || Ok(planar("hexagon", tables::hexagon(1.0)?)) },
    Entry { name: "stadium", build: || Ok(planar("stadium", tables::stadium(1.0, 1.0)?)) },
    Entry { name: "sinai", build: || Ok(planar("sinai", tables::sinai(1.0, 0.25)?)) },
    Entry { name: "mushroom", build: || Ok(planar("mushroom", tables::mushroom(1.0, 0.5, 0.75)?)) },
    Entry { name: "flower", build: || Ok(planar("flower", tables::flower(4, 1.25, 2.0)?)) },
    Entry { name: "strip", build: strip },
    Entry { name: "slab", build: slab },
];

/// Semi-axes of the ellipse.
const SEMI_AXES: [f64; 2] = [2.0, 1.0];

fn planar(name: &'static str, table: Table) -> Case {
    let extent = table.extent();
    let size = 0.5 * (extent.max - extent.min).amax();
    let size = if size.is_finite() { size } else { 1.0 };
    Case { name, space: Space::Plane(table), size, formulas: None, semi_axes: None, invariant: |_| None }
}

fn circle() -> Result<Case, Error> {
    Ok(Case {
        formulas: Some(Formulas { implicit: "x^2 + y^2 - 1", polar: "1", within: [1.25, 1.25] }),
        // both laws conserve it, and mix only the tangential part with the spin
        invariant: |_| {
            let of = |s: &State<f64>| {
                let [x, y, _] = s.position;
                -(x * s.velocity[0] + y * s.velocity[1]) / libm::hypot(x, y)
            };
            Some(Invariant { name: "normal speed", of })
        },
        ..planar("circle", tables::circle(1.0)?)
    })
}

fn ellipse() -> Result<Case, Error> {
    let implicit = "x^2/4 + y^2 - 1";
    let polar = "2/sqrt(cos(t)^2 + 4*sin(t)^2)";
    Ok(Case {
        formulas: Some(Formulas { implicit, polar, within: [2.25, 1.25] }),
        semi_axes: Some(SEMI_AXES),
        invariant: |law| {
            let of = |s: &State<f64>| {
                let focus = libm::sqrt(SEMI_AXES[0] * SEMI_AXES[0] - SEMI_AXES[1] * SEMI_AXES[1]);
                let about = |f: f64| (s.position[0] - f) * s.velocity[1] - s.position[1] * s.velocity[0];
                about(focus) * about(-focus)
            };
            (law == Law::Specular).then_some(Invariant { name: "momenta about the foci", of })
        },
        ..planar("ellipse", tables::ellipse(SEMI_AXES)?)
    })
}

fn square() -> Result<Case, Error> {
    Ok(Case {
        invariant: |law| {
            let of = |s: &State<f64>| s.velocity[0].abs();
            (law == Law::Specular).then_some(Invariant { name: "|v1|", of })
        },
        ..planar("square", tables::square(1.0)?)
    })
}

fn strip() -> Result<Case, Error> {
    Ok(Case {
        invariant: |law| {
            (law == Law::NoSlip).then_some(Invariant { name: "middle of the orbit", of: middle_of_strip_orbit })
        },
        ..planar("strip", tables::strip(1.0)?)
    })
}

/// Where, along a strip of width 1, the two lines through the contact points of a no-slip disk with γ² = 1/2 cross.
///
/// Between two hits on the lower wall the pair `w = (v₀, v₁)` is turned by `R = T₋ T₊` (the angle 2β) while the disk advances
/// by `τ (v₁ + (T₊ w)₁)`, where `τ = 1/|v₂|`. So `x₁ − τ c·w` is conserved, with `(Rᵀ − 1) c = (s, 1 + cos β)`; on the upper
/// wall `R` turns the other way and `s` changes its sign.
fn middle_of_strip_orbit(state: &State<f64>) -> f64 {
    let (cos, sin) = (1.0 / 3.0, libm::sqrt(8.0) / 3.0);
    let side = if state.velocity[1] > 0.0 { 1.0 } else { -1.0 };
    let (cos_2, sin_2) = (cos * cos - sin * sin, side * 2.0 * cos * sin);
    let (a, b) = (side * sin, 1.0 + cos);
    // Rᵀ − 1 = [[cos 2β − 1, sin 2β], [−sin 2β, cos 2β − 1]]
    let determinant = 2.0 * (1.0 - cos_2);
    let c = [((cos_2 - 1.0) * a - sin_2 * b) / determinant, (sin_2 * a + (cos_2 - 1.0) * b) / determinant];
    state.position[0] - (c[0] * state.spin[0] + c[1] * state.velocity[0]) / state.velocity[1].abs()
}

fn slab() -> Result<Case, Error> {
    Ok(Case {
        name: "slab",
        space: Space::Room(tables::slab(1.0)?),
        size: 1.0,
        formulas: None,
        semi_axes: None,
        invariant: |_| Some(Invariant { name: "spin about the normal", of: |s| s.spin[2] }),
    })
}

/// Grazing starts have angles of 10⁻¹ … 10⁻⁷ to the wall: a chord of a circle at 10⁻⁸ is within the rounding of its ends from
/// the circle.
const ANGLES: i32 = 7;

impl Case {
    /// What the motion conserves besides the energy.
    pub fn invariant(&self, law: Law) -> Option<Invariant> {
        (self.invariant)(law)
    }

    /// The same motion in the precision of `R`, by the textbook program.
    pub fn textbook<R: Real>(&self, law: Law) -> Option<Textbook<R>> {
        match (&self.space, self.semi_axes) {
            (_, Some(semi_axes)) => Some(Textbook::ellipse(semi_axes, law)),
            (Space::Plane(table), None) => Textbook::new(table, law),
            (Space::Room(table), None) => Some(Textbook::slab(table.extent().max.z, law)),
        }
    }

    /// `many` starts at unit speed, half-way to the first wall from points of the canonical measure.
    ///
    /// # Errors
    /// The canonical measure does not exist.
    pub fn starts(&self, many: u64) -> Result<Vec<State<f64>>, billiards::Error> {
        Ok(self.on_walls(many)?.into_iter().map(|start| self.half_way(start)).collect())
    }

    /// `many` starts on the walls, nearly along them.
    ///
    /// # Errors
    /// The canonical measure does not exist.
    pub fn grazing_starts(&self, many: u64) -> Result<Vec<State<f64>>, billiards::Error> {
        let flat = |(i, start): (usize, State<f64>)| {
            let normal = self.normal(&start.position);
            let angle = libm::pow(10.0, -f64::from(1 + i32::try_from(i).unwrap_or(0) % ANGLES));
            let v = SVector::from(start.velocity);
            let along = v - normal * v.dot(&normal);
            let velocity = along / along.norm() * libm::cos(angle) + normal * libm::sin(angle);
            State { velocity: velocity.into(), ..start }
        };
        Ok(self.on_walls(many)?.into_iter().enumerate().map(flat).collect())
    }

    /// Starts of the canonical measure, on the walls.
    fn on_walls(&self, many: u64) -> Result<Vec<State<f64>>, billiards::Error> {
        let plane = |table: &Table| {
            let canonical = Canonical::new(table, 1.0, SEED)?;
            let start = |i| canonical.start(i);
            Ok((0..many).map(start).map(|s| State::from_parts(&s.position, &s.velocity, &s.spin)).collect())
        };
        match &self.space {
            Space::Plane(table) if table.perimeter().is_finite() => plane(table),
            // an infinite strip: a square part of it
            Space::Plane(_) => {
                let mut starts = plane(&tables::square(1.0).map_err(billiards::Error::from)?)?;
                for start in &mut starts {
                    start.position[1] = if start.velocity[1] > 0.0 { 0.0 } else { 1.0 };
                }
                Ok(starts)
            }
            Space::Room(table) => {
                let canonical = CanonicalSpatial::new(table, 1.0, SEED)?;
                let start = |i| canonical.start(i);
                Ok((0..many).map(start).map(|s| State::from_parts(&s.position, &s.velocity, &s.spin)).collect())
            }
        }
    }

    fn half_way(&self, start: State<f64>) -> State<f64> {
        let time = match &self.space {
            Space::Plane(table) => {
                let path = Line { point: first(&start.position).into(), velocity: first(&start.velocity).into() };
                let walls = table.list(0..table.pieces().len());
                billiards::geometry::Walls::hit(&walls, &path).map_or(1.0, |hit| hit.time)
            }
            Space::Room(_) => self.size / start.velocity[2].abs(),
        };
        let position = core::array::from_fn(|i| start.position[i] + 0.5 * time * start.velocity[i]);
        State { position, ..start }
    }

    /// The normal at a point of the walls, into the table.
    fn normal(&self, at: &[f64; 3]) -> Vector3<f64> {
        match &self.space {
            Space::Plane(table) => {
                let [a, b] = table.closest(&Vector2::new(at[0], at[1])).1.normal.into();
                Vector3::new(a, b, 0.0)
            }
            Space::Room(_) if at[2] > 0.5 * self.size => -Vector3::z(),
            Space::Room(_) => Vector3::z(),
        }
    }

    /// How far outside the table a point is, relative to the table's size; 0 inside.
    pub fn outside(&self, state: &State<f64>) -> f64 {
        let [x, y, z] = state.position;
        let distance = match &self.space {
            Space::Plane(table) => table.signed_distance(&Vector2::new(x, y)),
            Space::Room(table) => table.signed_distance(&Vector3::new(x, y, z)),
        };
        if distance.is_nan() { f64::INFINITY } else { (-distance / self.size).max(0.0) }
    }
}

/// Seed of the starts.
const SEED: u64 = 1;
