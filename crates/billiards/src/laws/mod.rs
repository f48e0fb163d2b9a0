//! Collision laws as the engine's loop applies them to a ball, one per file.
mod coefficients;
mod custom;
mod disk;
mod mirror;
mod per_piece;
mod rough_ball;
mod slip;
mod specular;

pub use collision_laws::laws::Specular;
pub use custom::Custom;
pub use disk::Disk;
pub use mirror::Mirror;
pub use per_piece::PerPiece;
pub use rough_ball::RoughBall;

/// The mass distribution parameter γ, if it is one. Otherwise NaN, and the velocities become that too: an orbit escapes after its first
/// collision in which the slip counts, instead of going on under another law.
fn gamma_or_nan(gamma: f64) -> f64 {
    if gamma.is_finite() && gamma >= 0.0 { gamma } else { f64::NAN }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_gamma_is_not_taken_for_one() {
        for gamma in [0.0, 5e-324, 0.5, 1e200] {
            assert_eq!(gamma_or_nan(gamma), gamma);
        }
        for none in [-0.5, f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
            assert!(gamma_or_nan(none).is_nan());
        }
    }
}
