//! Tables in space whose walls are hit in closed form.
use super::{ball, cuboid, slab};
use crate::{
    Error, Extent,
    parry::{Side, SolidSpec},
    plane::{is_finite, slack},
    surface::{Surface, direction},
    walls::{Cuboid, Slab, Sphere, WithWalls},
};
use core::f64::consts::PI;
use nalgebra::Vector3;

/// A named table in space.
#[derive(Clone, Debug)]
pub struct SpatialTable {
    figure: Figure,
}

#[derive(Clone, Debug)]
enum Figure {
    Slab { height: f64, walls: Slab<3, 2> },
    Cuboid { size: [f64; 3], walls: Cuboid<3> },
    Ball { radius: f64, walls: Sphere<3> },
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

impl SpatialTable {
    pub(super) fn slab(height: f64, walls: Slab<3, 2>) -> SpatialTable {
        SpatialTable { figure: Figure::Slab { height, walls } }
    }
    pub(super) fn cuboid(size: [f64; 3], walls: Cuboid<3>) -> SpatialTable {
        SpatialTable { figure: Figure::Cuboid { size, walls } }
    }
    pub(super) fn ball(radius: f64, walls: Sphere<3>) -> SpatialTable {
        SpatialTable { figure: Figure::Ball { radius, walls } }
    }

    /// Its name in scene files.
    pub fn name(&self) -> &'static str {
        match self.figure {
            Figure::Slab { .. } => slab::ENTRY.name,
            Figure::Cuboid { .. } => cuboid::ENTRY.name,
            Figure::Ball { .. } => ball::ENTRY.name,
        }
    }

    /// What its pieces are, in the order of their numbers.
    pub fn pieces(&self) -> &'static [&'static str] {
        match self.figure {
            Figure::Slab { .. } => &["floor", "ceiling"],
            Figure::Cuboid { .. } => &["x1 = 0", "x1 = size_1", "x2 = 0", "x2 = size_2", "x3 = 0", "x3 = size_3"],
            Figure::Ball { .. } => &["sphere"],
        }
    }

    /// Volume \[L³\]; infinite for a slab.
    pub fn volume(&self) -> f64 {
        match self.figure {
            Figure::Slab { .. } => f64::INFINITY,
            Figure::Cuboid { size: [a, b, c], .. } => a * b * c,
            Figure::Ball { radius, .. } => 4.0 / 3.0 * PI * radius * radius * radius,
        }
    }

    /// Area of the boundary \[L²\]; infinite for a slab.
    pub fn surface_area(&self) -> f64 {
        match self.figure {
            Figure::Slab { .. } => f64::INFINITY,
            Figure::Cuboid { size: [a, b, c], .. } => 2.0 * (a * b + b * c + c * a),
            Figure::Ball { radius, .. } => 4.0 * PI * radius * radius,
        }
    }

    /// The curvature of its walls \[L⁻¹\], the same everywhere and in every direction; positive where focusing.
    pub fn curvature(&self) -> f64 {
        match self.figure {
            Figure::Slab { .. } | Figure::Cuboid { .. } => 0.0,
            Figure::Ball { radius, .. } => 1.0 / radius,
        }
    }

    /// A box around the table \[L\]; infinite where the table is.
    pub fn extent(&self) -> Extent<3> {
        let inf = f64::INFINITY;
        let (min, max) = match self.figure {
            Figure::Slab { height, .. } => (Vector3::new(-inf, -inf, 0.0), Vector3::new(inf, inf, height)),
            Figure::Cuboid { size, .. } => (Vector3::zeros(), size.into()),
            Figure::Ball { radius, .. } => (Vector3::repeat(-radius), Vector3::repeat(radius)),
        };
        Extent { min, max }
    }

    /// The distance from the boundary \[L\], negative outside the table.
    pub fn signed_distance(&self, point: &Vector3<f64>) -> f64 {
        match self.figure {
            Figure::Slab { height, .. } => point.z.min(height - point.z),
            Figure::Cuboid { size, .. } => {
                // the distance beyond the walls, per axis; inside, all are negative
                let beyond = Vector3::from_fn(|i, _| (-point[i]).max(point[i] - size[i]));
                let outside = beyond.map(|d| d.max(0.0));
                let far = outside.amax();
                if far > 0.0 { -far * (outside / far).norm() } else { -beyond.max() }
            }
            Figure::Ball { radius, .. } => radius - libm::hypot(libm::hypot(point.x, point.y), point.z),
        }
    }

    /// Whether a point lies in the table, off the boundary.
    pub fn contains(&self, point: &Vector3<f64>) -> bool {
        is_finite(point) && self.signed_distance(point) > 0.0
    }

    /// Its walls as seen from a point \[L\].
    pub fn walls_at(&self, point: &Vector3<f64>) -> Vec<WallAt> {
        let slack = |size: f64| slack([size, point.amax()]);
        // the two walls across an axis, at 0 and at `size`
        let across = |axis: usize, piece: usize, size: f64| {
            let normal = Vector3::from_fn(|i, _| if i == axis { 1.0 } else { 0.0 });
            let slack = slack(size);
            [
                WallAt { piece, distance: point[axis], normal, slack },
                WallAt { piece: piece + 1, distance: size - point[axis], normal: -normal, slack },
            ]
        };
        match self.figure {
            Figure::Slab { height, .. } => across(2, 0, height).into(),
            Figure::Cuboid { size, .. } => (0..3).flat_map(|axis| across(axis, 2 * axis, size[axis])).collect(),
            Figure::Ball { radius, .. } => {
                let distance = self.signed_distance(point);
                vec![WallAt { piece: 0, distance, normal: -point, slack: slack(radius) }]
            }
        }
    }

    /// Radius of the largest ball in the table \[L\].
    fn inradius(&self) -> f64 {
        match self.figure {
            Figure::Slab { height, .. } => 0.5 * height,
            Figure::Cuboid { size: [a, b, c], .. } => 0.5 * a.min(b).min(c),
            Figure::Ball { radius, .. } => radius,
        }
    }

    /// Its walls as solids, each with its centre \[L\] and the side of it on which the table lies. The walls of a box are a single
    /// solid.
    pub fn solids(&self) -> Vec<(SolidSpec, [f64; 3], Side)> {
        let half_space =
            |up: f64, z: f64| (SolidSpec::HalfSpace { normal: [0.0, 0.0, up] }, [0.0, 0.0, z], Side::Outside);
        match self.figure {
            Figure::Slab { height, .. } => vec![half_space(1.0, 0.0), half_space(-1.0, height)],
            Figure::Cuboid { size, .. } => {
                vec![(SolidSpec::Cuboid { size, rounding: 0.0 }, size.map(|length| 0.5 * length), Side::Inside)]
            }
            Figure::Ball { radius, .. } => vec![(SolidSpec::Ball { radius }, [0.0; 3], Side::Inside)],
        }
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
        let largest = self.inradius();
        if radius >= largest {
            return Err(Error::NothingLeft { radius, largest });
        }
        let less = |size: f64| size - 2.0 * radius;
        Ok(match self.figure {
            Figure::Slab { height, .. } => (slab(less(height))?, Vector3::new(0.0, 0.0, radius)),
            Figure::Cuboid { size, .. } => (cuboid(size.map(less))?, Vector3::repeat(radius)),
            Figure::Ball { radius: whole, .. } => (ball(whole - radius)?, Vector3::zeros()),
        })
    }

    /// Runs a computation with the walls.
    pub fn with_walls<V: WithWalls<3>>(&self, visit: V) -> V::Output {
        match &self.figure {
            Figure::Slab { walls, .. } => visit.run(walls),
            Figure::Cuboid { walls, .. } => visit.run(walls),
            Figure::Ball { walls, .. } => visit.run(walls),
        }
    }
}

impl Surface for SpatialTable {
    /// The infinite slab looks the same everywhere, so points are drawn from the square 0 ≤ x₁, x₂ < height.
    fn random_point(&self, uniform: &mut dyn FnMut() -> f64) -> (Vector3<f64>, Vector3<f64>) {
        match self.figure {
            Figure::Slab { height, .. } => {
                let up = uniform() < 0.5;
                let point = Vector3::new(height * uniform(), height * uniform(), if up { 0.0 } else { height });
                (point, if up { Vector3::z() } else { -Vector3::z() })
            }
            Figure::Cuboid { size, .. } => {
                let [a, b, c] = size;
                let areas = [b * c, c * a, a * b];
                let mut share = uniform() * (areas[0] + areas[1] + areas[2]);
                let mut axis = 0;
                while axis < 2 && share >= areas[axis] {
                    share -= areas[axis];
                    axis += 1;
                }
                let low = uniform() < 0.5;
                let mut point = Vector3::from_fn(|i, _| size[i] * uniform());
                point[axis] = if low { 0.0 } else { size[axis] };
                let mut normal = Vector3::zeros();
                normal[axis] = if low { 1.0 } else { -1.0 };
                (point, normal)
            }
            Figure::Ball { radius, .. } => {
                let outward = direction(uniform);
                (outward * radius, -outward)
            }
        }
    }
}
