//! Tables in space whose walls are hit in closed form.
use crate::{
    Error, Extent,
    parry::{Side, SolidSpec},
    plane::{is_finite, slack},
    surface::Surface,
    walls::{Cuboid, Slab, Sphere, WithWalls},
};
use nalgebra::Vector3;
use std::{fmt::Debug, sync::Arc};

/// A named table in space.
#[derive(Clone, Debug)]
pub struct SpatialTable {
    chamber: Arc<dyn Chamber>,
}

/// What each named table in space tells of itself; [`SpatialTable`] has the descriptions.
pub(super) trait Chamber: Debug + Send + Sync {
    fn name(&self) -> &'static str;
    fn pieces(&self) -> &'static [&'static str];
    fn walls(&self) -> WallsOf<'_>;
    fn volume(&self) -> f64;
    fn surface_area(&self) -> f64;
    fn curvature(&self) -> f64;
    /// Radius of the largest ball in the table \[L\].
    fn inradius(&self) -> f64;
    fn extent(&self) -> Extent<3>;
    fn signed_distance(&self, point: &Vector3<f64>) -> f64;
    fn walls_at(&self, point: &Vector3<f64>) -> Vec<WallAt>;
    fn solids(&self) -> Vec<(SolidSpec, [f64; 3], Side)>;
    /// See [`SpatialTable::offset`]; for a radius that is positive and less than that of the largest ball.
    fn offset(&self, radius: f64) -> Result<(SpatialTable, Vector3<f64>), Error>;
    fn random_point(&self, uniform: &mut dyn FnMut() -> f64) -> (Vector3<f64>, Vector3<f64>);
}

/// The kinds of walls that named tables in space have. For each, runs are compiled.
pub(super) enum WallsOf<'a> {
    Slab(&'a Slab<3, 2>),
    Cuboid(&'a Cuboid<3>),
    Sphere(&'a Sphere<3>),
}

/// A wall of a table in space as seen from a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallAt {
    /// Its number.
    pub piece: usize,
    /// Distance from it \[L\], negative beyond it.
    pub distance: f64,
    /// Its normal there, into the table, not normalised.
    pub normal: Vector3<f64>,
    /// How far off it \[L\] the point may lie and still count as on it: the rounding of its coordinates and of the wall's.
    pub slack: f64,
}

/// The two walls across an axis, at 0 and at `size`, as seen from a point. Their numbers are `first` and the next.
pub(super) fn across(axis: usize, size: f64, first: usize, point: &Vector3<f64>) -> [WallAt; 2] {
    let normal = Vector3::from_fn(|i, _| if i == axis { 1.0 } else { 0.0 });
    let slack = slack([size, point.amax()]);
    [
        WallAt { piece: first, distance: point[axis], normal, slack },
        WallAt { piece: first + 1, distance: size - point[axis], normal: -normal, slack },
    ]
}

impl SpatialTable {
    pub(super) fn new(chamber: impl Chamber + 'static) -> SpatialTable {
        SpatialTable { chamber: Arc::new(chamber) }
    }

    /// Its name in scene files.
    pub fn name(&self) -> &'static str {
        self.chamber.name()
    }

    /// What its pieces are, in the order of their numbers.
    pub fn pieces(&self) -> &'static [&'static str] {
        self.chamber.pieces()
    }

    /// Volume \[L³\]; infinite for a slab.
    pub fn volume(&self) -> f64 {
        self.chamber.volume()
    }

    /// Area of the boundary \[L²\]; infinite for a slab.
    pub fn surface_area(&self) -> f64 {
        self.chamber.surface_area()
    }

    /// The curvature of its walls \[L⁻¹\], the same everywhere and in every direction; positive where focusing.
    pub fn curvature(&self) -> f64 {
        self.chamber.curvature()
    }

    /// A box around the table \[L\]; infinite where the table is.
    pub fn extent(&self) -> Extent<3> {
        self.chamber.extent()
    }

    /// The distance from the boundary \[L\], negative outside the table.
    pub fn signed_distance(&self, point: &Vector3<f64>) -> f64 {
        self.chamber.signed_distance(point)
    }

    /// Whether a point lies in the table, off the boundary.
    pub fn contains(&self, point: &Vector3<f64>) -> bool {
        is_finite(point) && self.signed_distance(point) > 0.0
    }

    /// Its walls as seen from a point \[L\].
    pub fn walls_at(&self, point: &Vector3<f64>) -> Vec<WallAt> {
        self.chamber.walls_at(point)
    }

    /// Its walls as solids, each with its centre \[L\] and the side of it on which the table lies. The walls of a box are a single
    /// solid.
    pub fn solids(&self) -> Vec<(SolidSpec, [f64; 3], Side)> {
        self.chamber.solids()
    }

    /// Where the centre of a ball that moves in the table can be: a table of the same kind with all walls moved inwards by the radius
    /// \[L\], and the position of its origin in this table.
    ///
    /// ```
    /// use geometry::{Vector3, tables};
    /// let (centres, origin) = tables::cuboid([1.0, 2.0, 3.0])?.offset(0.25)?;
    /// assert_eq!(centres.extent().max, Vector3::new(0.5, 1.5, 2.5));
    /// assert_eq!(origin, Vector3::repeat(0.25));
    /// # Ok::<(), geometry::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Radius`] for a radius that is negative or not finite, [`Error::NothingLeft`] where no such ball fits.
    pub fn offset(&self, radius: f64) -> Result<(SpatialTable, Vector3<f64>), Error> {
        if radius == 0.0 {
            return Ok((self.clone(), Vector3::zeros()));
        }
        if !(radius > 0.0 && radius.is_finite()) {
            return Err(Error::Radius { radius });
        }
        let largest = self.chamber.inradius();
        if radius >= largest {
            return Err(Error::NothingLeft { radius, largest });
        }
        self.chamber.offset(radius)
    }

    /// Runs a computation with the walls.
    pub fn with_walls<V: WithWalls<3>>(&self, visit: V) -> V::Output {
        match self.chamber.walls() {
            WallsOf::Slab(walls) => visit.run(walls),
            WallsOf::Cuboid(walls) => visit.run(walls),
            WallsOf::Sphere(walls) => visit.run(walls),
        }
    }
}

impl Surface for SpatialTable {
    /// The infinite slab looks the same everywhere, so points are drawn from the square 0 ≤ x₁, x₂ < height.
    fn random_point(&self, uniform: &mut dyn FnMut() -> f64) -> (Vector3<f64>, Vector3<f64>) {
        self.chamber.random_point(uniform)
    }
}
