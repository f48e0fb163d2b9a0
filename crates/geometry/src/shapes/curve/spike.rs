//! Next to the tip of a cusp.
use crate::piece::Landing;
use nalgebra::Vector2;

/// The end of an arc between the tip of a cusp and the point at the nearest angle: between these there are points, but no angles.
///
/// It is straight within rounding, and its normal turns evenly, to a right angle with the radius at the tip.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spike {
    tip: Vector2<f64>,
    /// From the tip to the point at the nearest angle.
    chord: Vector2<f64>,
    length: f64,
    /// At the tip and at the other end.
    normals: [Vector2<f64>; 2],
}

impl Spike {
    /// The spike of a curve about `center`, from its tip to the point at the nearest angle.
    pub(super) fn new(center: Vector2<f64>, tip: Vector2<f64>, nearest: Landing) -> Spike {
        let (out, chord) = (tip - center, nearest.point - tip);
        let across = nearest.normal - out * (out.dot(&nearest.normal) / out.norm_squared());
        Spike {
            tip,
            chord,
            length: libm::hypot(chord.x, chord.y),
            normals: [across / libm::hypot(across.x, across.y), nearest.normal],
        }
    }

    pub(super) fn length(&self) -> f64 {
        self.length
    }

    /// The point at a distance from the tip, and the normal there.
    pub(super) fn landing_at(&self, distance: f64) -> Landing {
        let part = distance / self.length;
        let normal = self.normals[0] + (self.normals[1] - self.normals[0]) * part;
        Landing { point: self.tip + self.chord * part, normal: normal / libm::hypot(normal.x, normal.y) }
    }

    /// The distance from the tip of the point that is closest to one next to the spike.
    pub(super) fn closest(&self, point: &Vector2<f64>) -> f64 {
        let off = point - self.tip;
        let [tangent, other] = self.normals.map(|normal| Vector2::new(-normal.y, normal.x));
        // (off − part·chord)·(tangent + part·(other − tangent)) = 0, but for rounding, if `tangent` points along the chord
        let along = if tangent.dot(&self.chord) < 0.0 { -1.0 } else { 1.0 };
        let rate = along * (self.chord.dot(&tangent) - off.dot(&(other - tangent)));
        if rate > 0.0 {
            return self.length * (along * off.dot(&tangent) / rate).clamp(0.0, 1.0);
        }
        // beyond the centre of curvature only an end can be closest
        if off.dot(&self.chord) > 0.5 * self.length * self.length { self.length } else { 0.0 }
    }
}
