//! Pictures of orbits and phase space.

/// A picture a scene can ask for.
#[derive(Clone, Copy, Debug)]
pub struct Picture {
    /// Its name in a scene.
    pub name: &'static str,
    /// What it shows, in one line.
    pub summary: &'static str,
}

/// Every picture a scene can ask for.
pub const PICTURES: &[Picture] = &[
    Picture { name: "orbit", summary: "the table and the orbits in it" },
    Picture { name: "velocity-portrait", summary: "velocities after each collision, spin against tangential part" },
];
