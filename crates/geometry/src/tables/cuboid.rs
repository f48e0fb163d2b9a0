//! The box.
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

/// The box `0 < xᵢ < sizeᵢ` \[L\]; the lower and the upper wall of axis i = 0, 1, 2 are the pieces 2 i and 2 i + 1.
///
/// Volume `a b c`, surface `2 (a b + b c + c a)`.
///
/// # Errors
/// [`Error::Parameter`] unless the sizes are positive and finite.
pub fn cuboid(size: [f64; 3]) -> Result<SpatialTable, Error> {
    for length in size {
        positive("size", length)?;
    }
    Ok(SpatialTable::new(Cuboid { size, walls: walls::Cuboid::new([0.0; 3], size, [[0, 1], [2, 3], [4, 5]])? }))
}

pub(super) const ENTRY: Entry = Entry {
    name: "box",
    summary: "the inside of a box, 0 < x_i < size_i",
    parameters: &[Parameter::lengths("size", &[1.0, 1.0, 1.0])],
    build: Build::Spatial(|v| cuboid(v.list("size")?)),
};

#[derive(Debug)]
struct Cuboid {
    size: [f64; 3],
    walls: walls::Cuboid<3>,
}

impl Cuboid {
    /// Areas of the faces across each axis.
    fn areas(&self) -> [f64; 3] {
        let [a, b, c] = self.size;
        [b * c, c * a, a * b]
    }
}

impl Chamber for Cuboid {
    fn name(&self) -> &'static str {
        ENTRY.name
    }
    fn pieces(&self) -> &'static [&'static str] {
        &["x1 = 0", "x1 = size_1", "x2 = 0", "x2 = size_2", "x3 = 0", "x3 = size_3"]
    }
    fn walls(&self) -> WallsOf<'_> {
        WallsOf::Cuboid(&self.walls)
    }

    fn volume(&self) -> f64 {
        let [a, b, c] = self.size;
        a * b * c
    }
    fn surface_area(&self) -> f64 {
        let [bc, ca, ab] = self.areas();
        2.0 * (ab + bc + ca)
    }
    fn curvature(&self) -> f64 {
        0.0
    }
    fn inradius(&self) -> f64 {
        let [a, b, c] = self.size;
        0.5 * a.min(b).min(c)
    }
    fn extent(&self) -> Extent<3> {
        Extent { min: Vector3::zeros(), max: self.size.into() }
    }

    fn signed_distance(&self, point: &Vector3<f64>) -> f64 {
        // the distance beyond the walls, per axis; inside, all are negative
        let beyond = Vector3::from_fn(|i, _| (-point[i]).max(point[i] - self.size[i]));
        let outside = beyond.map(|d| d.max(0.0));
        let far = outside.amax();
        if far > 0.0 { -far * (outside / far).norm() } else { -beyond.max() }
    }
    fn walls_at(&self, point: &Vector3<f64>) -> Vec<WallAt> {
        (0..3).flat_map(|axis| across(axis, self.size[axis], 2 * axis, point)).collect()
    }
    fn solids(&self) -> Vec<(SolidSpec, [f64; 3], Side)> {
        let size = self.size;
        vec![(SolidSpec::Cuboid { size, rounding: 0.0 }, size.map(|length| 0.5 * length), Side::Inside)]
    }
    fn offset(&self, radius: f64) -> Result<(SpatialTable, Vector3<f64>), Error> {
        Ok((cuboid(self.size.map(|size| size - 2.0 * radius))?, Vector3::repeat(radius)))
    }

    fn random_point(&self, uniform: &mut dyn FnMut() -> f64) -> (Vector3<f64>, Vector3<f64>) {
        let areas = self.areas();
        let mut share = uniform() * (areas[0] + areas[1] + areas[2]);
        let mut axis = 0;
        while axis < 2 && share >= areas[axis] {
            share -= areas[axis];
            axis += 1;
        }
        let low = uniform() < 0.5;
        let mut point = Vector3::from_fn(|i, _| self.size[i] * uniform());
        point[axis] = if low { 0.0 } else { self.size[axis] };
        let mut normal = Vector3::zeros();
        normal[axis] = if low { 1.0 } else { -1.0 };
        (point, normal)
    }
}
