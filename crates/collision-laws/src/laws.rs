//! Laws, one per file.

mod field;
mod grooved;
mod no_slip;
mod per_surface;
mod random_grassmannian;
mod restitution;
mod rough_plane;
mod specular;

pub use field::Field;
pub use grooved::Grooved;
pub use no_slip::NoSlip;
pub use per_surface::PerSurface;
pub use random_grassmannian::RandomGrassmannian;
pub use restitution::Restitution;
pub use rough_plane::RoughPlane;
pub use specular::Specular;
