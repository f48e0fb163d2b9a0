//! The inside of a sphere.
use super::{
    registry::{Build, Entry, Parameter},
    spatial::{Chamber, SpatialTable, WallAt, WallsOf},
    vertices::positive,
};
use crate::{
    Error, Extent,
    parry::{Side, SolidSpec},
    plane::slack,
    surface::direction,
    walls,
};
use core::f64::consts::PI;
use nalgebra::Vector3;

/// The ball of the given radius \[L\] about the origin; one piece. Volume `4π r³/3`, surface `4π r²`.
///
/// # Errors
/// [`Error::Parameter`] unless the radius is positive and finite, [`Error::Length`] unless it is between 10⁻¹⁵⁰ and 10¹⁵⁰.
pub fn ball(radius: f64) -> Result<SpatialTable, Error> {
    positive("radius", radius)?;
    Ok(SpatialTable::new(Ball { radius, walls: walls::Sphere::new(Vector3::zeros(), radius, 0)? }))
}

pub(super) const ENTRY: Entry = Entry {
    name: "ball",
    summary: "the inside of a sphere about the origin",
    parameters: &[Parameter::length("radius", 1.0)],
    build: Build::Spatial(|v| ball(v.number("radius")?)),
};

#[derive(Debug)]
struct Ball {
    radius: f64,
    walls: walls::Sphere<3>,
}

impl Chamber for Ball {
    fn name(&self) -> &'static str {
        ENTRY.name
    }
    fn pieces(&self) -> &'static [&'static str] {
        &["sphere"]
    }
    fn walls(&self) -> WallsOf<'_> {
        WallsOf::Sphere(&self.walls)
    }

    fn volume(&self) -> f64 {
        4.0 / 3.0 * PI * self.radius * self.radius * self.radius
    }
    fn surface_area(&self) -> f64 {
        4.0 * PI * self.radius * self.radius
    }
    fn curvature(&self) -> f64 {
        1.0 / self.radius
    }
    fn inradius(&self) -> f64 {
        self.radius
    }
    fn extent(&self) -> Extent<3> {
        Extent { min: Vector3::repeat(-self.radius), max: Vector3::repeat(self.radius) }
    }

    fn signed_distance(&self, point: &Vector3<f64>) -> f64 {
        self.radius - libm::hypot(libm::hypot(point.x, point.y), point.z)
    }
    fn walls_at(&self, point: &Vector3<f64>) -> Vec<WallAt> {
        let distance = self.signed_distance(point);
        vec![WallAt { piece: 0, distance, normal: -point, slack: slack([self.radius, point.amax()]) }]
    }
    fn solids(&self) -> Vec<(SolidSpec, [f64; 3], Side)> {
        vec![(SolidSpec::Ball { radius: self.radius }, [0.0; 3], Side::Inside)]
    }
    fn offset(&self, radius: f64) -> Result<(SpatialTable, Vector3<f64>), Error> {
        Ok((ball(self.radius - radius)?, Vector3::zeros()))
    }

    fn random_point(&self, uniform: &mut dyn FnMut() -> f64) -> (Vector3<f64>, Vector3<f64>) {
        let outward = direction(uniform);
        (outward * self.radius, -outward)
    }
}
