//! Which vertices are corners.
use crate::plane::key;
use nalgebra::Vector2;

/// The corners of a boundary, looked up by position.
pub(crate) struct Corners {
    /// Their coordinates as bits, sorted.
    places: Vec<[u64; 2]>,
    size: f64,
}

impl Corners {
    pub(crate) fn new(corners: &[Vector2<f64>]) -> Corners {
        let mut places: Vec<[u64; 2]> = corners.iter().map(|p| key(*p)).collect();
        places.sort_unstable();
        Corners { places, size: corners.iter().map(Vector2::amax).fold(0.0, f64::max) }
    }

    pub(crate) fn contains(&self, vertex: &Vector2<f64>) -> bool {
        self.places.binary_search(&key(*vertex)).is_ok()
    }

    /// Size of their coordinates, to which rounding is relative.
    pub(crate) fn size(&self) -> f64 {
        self.size
    }
}
