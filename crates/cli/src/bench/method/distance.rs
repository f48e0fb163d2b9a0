//! A table of which only the distance is known, as for any parry `Shape`.

use billiards::geometry::parry::parry2d_f64::{
    bounding_volume::{Aabb, BoundingSphere},
    mass_properties::MassProperties,
    math::Vector,
    query::{PointProjection, PointQuery, Ray, RayCast, RayIntersection},
    shape::{FeatureId, Shape, ShapeType, TypedShape},
};
use billiards::geometry::parry::{Side, pieces};
use billiards::geometry::{Table, Vector2};
use nalgebra::Isometry2;

use super::super::Effort;
use super::super::case::{Case, Space};
use super::super::chart::Mark;
use super::Entry;
use super::exact::Plane;

pub(super) const ENTRY: Entry = Entry {
    name: "parry distance",
    summary: "a certified march by distance queries alone, as for any parry Shape",
    mark: Mark::Star,
    sizes: |case: &Case, _: Effort| match &case.space {
        Space::Plane(table) if table.extent().is_finite() => vec![None],
        _ => vec![],
    },
    build: |case, law, _| {
        let Space::Plane(table) = &case.space else { return Err("the table is not planar".into()) };
        let pieces = pieces(&ByDistance(table.clone()), &Isometry2::identity(), Side::Inside)?;
        Ok(Box::new(Plane { table: Table::new(pieces)?, law: law.planar() }))
    },
};

/// A table of which parry sees only the closest point.
#[derive(Clone)]
struct ByDistance(Table);

impl PointQuery for ByDistance {
    fn project_local_point(&self, point: Vector, solid: bool) -> PointProjection {
        let at = Vector2::new(point.x, point.y);
        let (_, landing) = self.0.closest(&at);
        let inside = (at - landing.point).dot(&landing.normal) > 0.0;
        let foot = Vector::new(landing.point.x, landing.point.y);
        PointProjection::new(inside, if solid && inside { point } else { foot })
    }
    fn project_local_point_and_get_feature(&self, point: Vector) -> (PointProjection, FeatureId) {
        (self.project_local_point(point, false), FeatureId::Unknown)
    }
}

impl RayCast for ByDistance {
    /// Never called: rays are computed by our own code.
    fn cast_local_ray_and_get_normal(&self, _: &Ray, _: f64, _: bool) -> Option<RayIntersection> {
        None
    }
}

impl Shape for ByDistance {
    fn compute_local_aabb(&self) -> Aabb {
        let extent = self.0.extent();
        Aabb::new(Vector::new(extent.min.x, extent.min.y), Vector::new(extent.max.x, extent.max.y))
    }
    fn compute_local_bounding_sphere(&self) -> BoundingSphere {
        self.compute_local_aabb().bounding_sphere()
    }
    fn clone_dyn(&self) -> Box<dyn Shape> {
        Box::new(self.clone())
    }
    fn scale_dyn(&self, _: Vector, _: u32) -> Option<Box<dyn Shape>> {
        None
    }
    fn mass_properties(&self, _: f64) -> MassProperties {
        MassProperties::new(Vector::ZERO, 0.0, 0.0)
    }
    fn shape_type(&self) -> ShapeType {
        ShapeType::Custom
    }
    fn as_typed_shape(&self) -> TypedShape<'_> {
        TypedShape::Custom(self)
    }
    fn ccd_thickness(&self) -> f64 {
        0.0
    }
    fn ccd_angular_thickness(&self) -> f64 {
        0.0
    }
}
