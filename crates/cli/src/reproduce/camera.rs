//! Space on a page: parallel projection.

use core::f64::consts::PI;

/// Looks at the origin from far away; the third coordinate is up on the page.
#[derive(Clone, Copy, Debug)]
pub(super) struct Camera {
    right: [f64; 3],
    up: [f64; 3],
    towards: [f64; 3],
}

impl Camera {
    /// From this azimuth (about the third axis, from the first) and elevation, in degrees.
    pub(super) fn at(azimuth: f64, elevation: f64) -> Self {
        let (a, e) = (azimuth * PI / 180.0, elevation * PI / 180.0);
        let ((sa, ca), (se, ce)) = (libm::sincos(a), libm::sincos(e));
        Camera { right: [-sa, ca, 0.0], up: [-se * ca, -se * sa, ce], towards: [ce * ca, ce * sa, se] }
    }

    /// The image of a point on the page.
    pub(super) fn see(&self, x: [f64; 3]) -> [f64; 2] {
        [dot(self.right, x), dot(self.up, x)]
    }

    /// How near a point is to the camera: larger is nearer.
    pub(super) fn depth(&self, x: [f64; 3]) -> f64 {
        dot(self.towards, x)
    }

    /// The point of the unit sphere that is seen at a point of the unit disk.
    pub(super) fn on_sphere(&self, [a, b]: [f64; 2]) -> Option<[f64; 3]> {
        let square = 1.0 - a * a - b * b;
        let c = (square >= 0.0).then(|| square.sqrt())?;
        Some(core::array::from_fn(|i| a * self.right[i] + b * self.up[i] + c * self.towards[i]))
    }
}

/// The scalar product.
pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The vector product.
pub(super) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The vector of length one in the same direction.
pub(super) fn unit(a: [f64; 3]) -> [f64; 3] {
    let length = dot(a, a).sqrt();
    a.map(|x| x / length)
}

/// `p + t d`
pub(super) fn along(p: [f64; 3], t: f64, d: [f64; 3]) -> [f64; 3] {
    core::array::from_fn(|i| p[i] + t * d[i])
}

/// Turns `v` by an angle about the unit vector `axis`, counter-clockwise seen from its tip.
pub(super) fn turn(v: [f64; 3], axis: [f64; 3], angle: f64) -> [f64; 3] {
    let (s, c) = libm::sincos(angle);
    let (across, height) = (cross(axis, v), dot(axis, v));
    core::array::from_fn(|i| c * v[i] + s * across[i] + (1.0 - c) * height * axis[i])
}
