//! Conversions between nalgebra, used everywhere else, and glam, used by parry.
use lanes::Double;
use nalgebra::{Isometry2, Isometry3, Matrix3, SMatrix, SVector, Vector2, Vector3};
use parry2d_f64::math::{Pose as Pose2, Vector as Glam2};
use parry3d_f64::math::{Pose as Pose3, Vector as Glam3};

pub(crate) fn to_glam2(v: &Vector2<f64>) -> Glam2 {
    Glam2::new(v.x, v.y)
}
pub(crate) fn from_glam2(v: Glam2) -> Vector2<f64> {
    Vector2::new(v.x, v.y)
}
pub(crate) fn to_glam3(v: &Vector3<f64>) -> Glam3 {
    Glam3::new(v.x, v.y, v.z)
}
pub(crate) fn from_glam3(v: Glam3) -> Vector3<f64> {
    Vector3::new(v.x, v.y, v.z)
}

/// Where a shape's own coordinates lie in space: `x = rotation · y + translation`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Frame<const N: usize> {
    pub(crate) rotation: SMatrix<f64, N, N>,
    pub(crate) translation: SVector<f64, N>,
}

impl<const N: usize> Frame<N> {
    /// The point of space at the shape's coordinates `y`.
    pub(crate) fn point(&self, y: &SVector<f64, N>) -> SVector<f64, N> {
        self.rotation * y + self.translation
    }
    /// The direction in space of the shape's direction `d`.
    pub(crate) fn direction(&self, d: &SVector<f64, N>) -> SVector<f64, N> {
        self.rotation * d
    }
    /// The shape's coordinates of a point of space.
    pub(crate) fn point_back(&self, x: &SVector<f64, N>) -> SVector<f64, N> {
        self.rotation.tr_mul(&(x - self.translation))
    }
    /// The shape's components of a direction in space.
    pub(crate) fn direction_back(&self, d: &SVector<f64, N>) -> SVector<f64, N> {
        self.rotation.tr_mul(d)
    }
    /// `other` first, then `self`.
    pub(crate) fn after(&self, other: &Frame<N>) -> Frame<N> {
        Frame { rotation: self.rotation * other.rotation, translation: self.point(&other.translation) }
    }
}

impl From<&Isometry2<f64>> for Frame<2> {
    fn from(pose: &Isometry2<f64>) -> Self {
        Frame { rotation: pose.rotation.to_rotation_matrix().into_inner(), translation: pose.translation.vector }
    }
}
/// `((w² − |q|²) 1 + 2 q qᵀ + 2 w [q×]) / (w² + |q|²)`, each entry accurate to half an ulp: a unit quaternion is off by some
/// roundings, which would turn an axis and so affect every hit.
impl From<&Isometry3<f64>> for Frame<3> {
    fn from(pose: &Isometry3<f64>) -> Self {
        let quaternion = pose.rotation.quaternion();
        let (w, q) = (quaternion.w, quaternion.imag());
        let part = Double::product(q.x, q.x).plus(Double::product(q.y, q.y)).plus(Double::product(q.z, q.z));
        let real = Double::product(w, w);
        let square = real.plus(part);
        let cross = q.cross_matrix();
        let rotation = Matrix3::from_fn(|i, k| {
            let pair = Double::product(q[i], q[k]).plus(Double::product(w, cross[(i, k)]));
            let twice = pair.plus(pair);
            let entry = if i == k { real.plus(-part).plus(twice) } else { twice };
            entry.over(square).value()
        });
        Frame { rotation, translation: pose.translation.vector }
    }
}
impl From<&Pose2> for Frame<2> {
    fn from(pose: &Pose2) -> Self {
        let columns = [Glam2::X, Glam2::Y].map(|e| from_glam2(pose.transform_vector(e)));
        Frame { rotation: SMatrix::from_columns(&columns), translation: from_glam2(pose.translation) }
    }
}
impl From<&Pose3> for Frame<3> {
    fn from(pose: &Pose3) -> Self {
        let columns = [Glam3::X, Glam3::Y, Glam3::Z].map(|e| from_glam3(pose.transform_vector(e)));
        Frame { rotation: SMatrix::from_columns(&columns), translation: from_glam3(pose.translation) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vectors_survive_the_round_trip_bit_for_bit() {
        let v = Vector3::new(0.1, -1e-300, f64::MAX);
        assert_eq!(from_glam3(to_glam3(&v)), v);
        assert_eq!(from_glam2(to_glam2(&v.xy())), v.xy());
    }

    #[test]
    fn frames_agree_with_parry_poses() {
        // one rotation each way: products of three numbers below 2, so errors of a few ulp of 1
        let pose = Pose3::new(Glam3::new(1.0, -2.0, 0.5), Glam3::new(0.3, 0.2, -0.7));
        let frame = Frame::from(&pose);
        let y = Vector3::new(0.25, 0.5, -1.0);
        let parry = from_glam3(pose.transform_point(to_glam3(&y)));
        assert!((frame.point(&y) - parry).norm() < 4.0 * f64::EPSILON);
        assert!((frame.point_back(&frame.point(&y)) - y).norm() < 8.0 * f64::EPSILON);
    }

    #[test]
    fn the_identity_changes_no_bit() {
        let y = Vector2::new(0.1, 1.0 / 3.0);
        assert_eq!(Frame::from(&Isometry2::identity()).point(&y), y);
        let z = Vector3::new(0.1, 1.0 / 3.0, 1e-20);
        assert_eq!(Frame::from(&Isometry3::identity()).point(&z), z);
    }
}
