//! The slab between two planes.
use super::{
    registry::{Build, Entry, Parameter},
    spatial::{Chamber, SpatialTable, WallAt, WallsOf, across},
    vertices::positive,
};
use crate::{
    Error, Extent,
    parry::{Side, SolidSpec},
    walls,
};
use nalgebra::Vector3;

/// The slab `0 < x₃ < height` \[L\]; pieces: 0 floor, 1 ceiling. Volume and surface are infinite.
///
/// A no-slip ball in it stays within a bounded part, unless it moves parallel to the planes.
///
/// # Errors
/// [`Error::Parameter`] unless the height is positive and finite.
pub fn slab(height: f64) -> Result<SpatialTable, Error> {
    positive("height", height)?;
    Ok(SpatialTable::new(Slab { height, walls: walls::Slab::new(0.0, height, [0, 1])? }))
}

pub(super) const ENTRY: Entry = Entry {
    name: "slab",
    summary: "the space between two parallel planes, 0 < x3 < height",
    parameters: &[Parameter::length("height", 1.0)],
    build: Build::Spatial(|v| slab(v.number("height")?)),
};

#[derive(Debug)]
struct Slab {
    height: f64,
    walls: walls::Slab<3, 2>,
}

impl Chamber for Slab {
    fn name(&self) -> &'static str {
        ENTRY.name
    }
    fn pieces(&self) -> &'static [&'static str] {
        &["floor", "ceiling"]
    }
    fn walls(&self) -> WallsOf<'_> {
        WallsOf::Slab(&self.walls)
    }

    fn volume(&self) -> f64 {
        f64::INFINITY
    }
    fn surface_area(&self) -> f64 {
        f64::INFINITY
    }
    fn curvature(&self) -> f64 {
        0.0
    }
    fn inradius(&self) -> f64 {
        0.5 * self.height
    }
    fn extent(&self) -> Extent<3> {
        let inf = f64::INFINITY;
        Extent { min: Vector3::new(-inf, -inf, 0.0), max: Vector3::new(inf, inf, self.height) }
    }

    fn signed_distance(&self, point: &Vector3<f64>) -> f64 {
        point.z.min(self.height - point.z)
    }
    fn walls_at(&self, point: &Vector3<f64>) -> Vec<WallAt> {
        across(2, self.height, 0, point).into()
    }
    fn solids(&self) -> Vec<(SolidSpec, [f64; 3], Side)> {
        let half_space =
            |up: f64, z: f64| (SolidSpec::HalfSpace { normal: [0.0, 0.0, up] }, [0.0, 0.0, z], Side::Outside);
        vec![half_space(1.0, 0.0), half_space(-1.0, self.height)]
    }
    fn offset(&self, radius: f64) -> Result<(SpatialTable, Vector3<f64>), Error> {
        Ok((slab(self.height - 2.0 * radius)?, Vector3::new(0.0, 0.0, radius)))
    }

    /// It looks the same everywhere, so points are drawn from the square 0 ≤ x₁, x₂ < height.
    fn random_point(&self, uniform: &mut dyn FnMut() -> f64) -> (Vector3<f64>, Vector3<f64>) {
        let height = self.height;
        let up = uniform() < 0.5;
        let point = Vector3::new(height * uniform(), height * uniform(), if up { 0.0 } else { height });
        (point, if up { Vector3::z() } else { -Vector3::z() })
    }
}
