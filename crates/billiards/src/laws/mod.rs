//! Collision laws as the engine's loop applies them to a ball, one per file.
mod coefficients;
mod custom;
mod disk;
mod mirror;
mod per_piece;
mod rough_ball;
mod slip;
mod specular;

pub use custom::Custom;
pub use disk::Disk;
pub use mirror::Mirror;
pub use per_piece::PerPiece;
pub use rough_ball::RoughBall;
pub use specular::Specular;
