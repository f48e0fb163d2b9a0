//! Random points of boundaries in space.
use nalgebra::Vector3;

/// A boundary in space from which points can be drawn, uniform by area.
///
/// ```
/// use geometry::{Surface, Vector3};
///
/// /// The lateral wall of the cylinder of radius 2 about the third axis, of height 1, with the table inside.
/// struct Pipe;
/// impl Surface for Pipe {
///     fn random_point(&self, uniform: &mut dyn FnMut() -> f64) -> (Vector3<f64>, Vector3<f64>) {
///         let (sin, cos) = libm::sincos(core::f64::consts::TAU * uniform());
///         let height = uniform();
///         (Vector3::new(2.0 * cos, 2.0 * sin, height), Vector3::new(-cos, -sin, 0.0))
///     }
/// }
/// let mut numbers = [0.25, 0.75].into_iter();
/// let (point, normal) = Pipe.random_point(&mut || numbers.next().unwrap_or_default());
/// assert!((point - Vector3::new(0.0, 2.0, 0.75)).norm() < 1e-15);
/// assert!((normal.norm() - 1.0).abs() < 1e-15 && normal.dot(&point) < 0.0); // towards the axis
/// ```
pub trait Surface: Sync {
    /// A random point of the boundary \[L\], uniform by area, and the unit normal there, into the table.
    ///
    /// `uniform` draws numbers uniform on [0, 1).
    fn random_point(&self, uniform: &mut dyn FnMut() -> f64) -> (Vector3<f64>, Vector3<f64>);
}

impl<S: Surface + ?Sized> Surface for &S {
    fn random_point(&self, uniform: &mut dyn FnMut() -> f64) -> (Vector3<f64>, Vector3<f64>) {
        (**self).random_point(uniform)
    }
}

impl<S: Surface + ?Sized> Surface for Box<S> {
    fn random_point(&self, uniform: &mut dyn FnMut() -> f64) -> (Vector3<f64>, Vector3<f64>) {
        (**self).random_point(uniform)
    }
}

/// A random direction: a unit vector, uniform on the sphere.
pub(crate) fn direction(uniform: &mut dyn FnMut() -> f64) -> Vector3<f64> {
    loop {
        // a point of the ball, far enough from its centre that its direction has full accuracy
        let x = Vector3::from_fn(|_, _| 2.0 * uniform() - 1.0);
        let square = x.norm_squared();
        if (0.0625..1.0).contains(&square) {
            return x / square.sqrt();
        }
    }
}

/// Some unit vector perpendicular to another.
pub(crate) fn any_across(axis: &Vector3<f64>) -> Vector3<f64> {
    let least = Vector3::from_fn(|i, _| if i == axis.iamin() { 1.0 } else { 0.0 });
    let w = least - axis * least.dot(axis);
    w / w.norm()
}

/// A random point of the unit disk across a unit vector, uniform by area.
pub(crate) fn in_disk(normal: &Vector3<f64>, uniform: &mut dyn FnMut() -> f64) -> Vector3<f64> {
    let first = any_across(normal);
    let second = normal.cross(&first);
    loop {
        let [a, b] = [0; 2].map(|_| 2.0 * uniform() - 1.0);
        if a * a + b * b < 1.0 {
            return first * a + second * b;
        }
    }
}
