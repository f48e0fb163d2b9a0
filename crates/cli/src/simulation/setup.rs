//! What is simulated, as both the description of a scene and the summary of a run say it.

use serde::Serialize;

use crate::scene::Scene;

/// Table, law and particle.
#[derive(Clone, Debug, Serialize)]
pub struct Setup {
    /// Dimension of space.
    pub dimension: usize,
    /// The table by name, or `boundary`.
    pub table: String,
    /// The law of every piece without one of its own.
    pub law: String,
    /// γ² = I/(m R²).
    pub gamma_squared: f64,
    /// Radius of the particle.
    pub radius: f64,
}

impl Setup {
    /// That of a scene.
    pub(super) fn of(scene: &Scene) -> Setup {
        Setup {
            dimension: scene.dimension,
            table: scene.table.shape.name().into(),
            law: scene.law.kind.to_string(),
            gamma_squared: scene.particle.gamma_squared.value,
            radius: scene.particle.radius.value,
        }
    }
}
