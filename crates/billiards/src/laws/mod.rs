//! Collision laws as the engine's loop applies them to a ball, one per file.
mod coefficients;
mod custom;
mod disk;
mod lent;
mod mirror;
mod per_piece;
mod rough_ball;
mod slip;
mod specular;

use crate::Error;

pub use collision_laws::laws::Specular;
pub use custom::Custom;
pub use disk::Disk;
pub use mirror::Mirror;
pub use per_piece::PerPiece;
pub use rough_ball::RoughBall;

/// The mass distribution parameter γ, if it is one.
fn checked_gamma(gamma: f64) -> Result<f64, Error> {
    if gamma.is_finite() && gamma >= 0.0 {
        return Ok(gamma);
    }
    Err(Error::Ball { quantity: "γ", must: "finite and not negative", value: gamma })
}
