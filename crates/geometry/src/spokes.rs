//! The boundaries around a point at which they touch.
use crate::{
    Error, Extent,
    copies::Copies,
    intersect::direction_at,
    nearest::ALIKE,
    plane::{SAME_DIRECTION, slack},
};
use core::{cmp::Ordering, f64::consts::TAU};
use nalgebra::Vector2;

/// A boundary that comes into the point or goes out of it, as seen from the point.
struct Spoke {
    /// The angle of its direction; directions that cannot be told apart share the angle of the first.
    angle: f64,
    /// How much it bends to the left on its way from the point.
    curvature: f64,
    /// Whether it goes out of the point: then the table lies to the left of it.
    out: bool,
    /// The number of its piece.
    number: usize,
}

impl Spoke {
    /// Counter-clockwise order around the point; those with the same direction are ordered by how they bend away from
    /// each other.
    fn order(&self, other: &Spoke) -> Ordering {
        self.angle.total_cmp(&other.angle).then(self.curvature.total_cmp(&other.curvature))
    }

    /// Whether both are sides of one wall, within rounding.
    fn coincides_with(&self, other: &Spoke) -> bool {
        let both = self.curvature.abs() + other.curvature.abs();
        self.angle == other.angle && (self.curvature - other.curvature).abs() <= ALIKE * both
    }
}

/// Fails unless boundaries that come into a point and go out of it alternate around it, as they do around every point
/// where tables touch. Otherwise two of them cross there, or a spike (a stretch there and back) lies outside the
/// table.
pub(crate) fn alternate(copies: &Copies, point: &Vector2<f64>) -> Result<(), Error> {
    // two sides of one wall: there is no room for a table between them
    let (mut walls, mut spokes): (Vec<[Spoke; 2]>, Vec<Spoke>) = (vec![], vec![]);
    for spoke in in_order(around(copies, point)) {
        match spokes.pop() {
            Some(last) if last.coincides_with(&spoke) && last.out == spoke.out => return Ok(()),
            Some(last) if last.coincides_with(&spoke) => walls.push([last, spoke]),
            last => spokes.extend(last.into_iter().chain([spoke])),
        }
    }
    for (k, a) in spokes.iter().enumerate() {
        let b = &spokes[(k + 1) % spokes.len()];
        if a.out == b.out {
            return Err(Error::Crossing { first: a.number, second: b.number, at: (*point).into() });
        }
    }
    for [a, b] in walls {
        let before = spokes.iter().rev().find(|spoke| (spoke.angle, spoke.curvature) < (a.angle, a.curvature));
        if before.or(spokes.last()).is_some_and(|before| !before.out) {
            return Err(Error::Spike { piece: a.number.max(b.number), at: (*point).into() });
        }
    }
    Ok(())
}

/// All boundaries that come into a point or go out of it; a piece on whose interior the point lies does both.
fn around(copies: &Copies, point: &Vector2<f64>) -> Vec<Spoke> {
    let mut spokes: Vec<Spoke> = vec![];
    let here = Extent { min: *point, max: *point };
    let tolerance = 4.0 * slack(point.iter().copied());
    copies.search(
        |e| e.meets(&here, tolerance),
        |index| {
            let (copy, extent) = copies.get(index);
            let piece = &copy.piece;
            let near = tolerance.max(slack([extent.size()]));
            let [starts, ends] = piece.ends().map_or([false; 2], |e| e.map(|end| (end - point).amax() <= near));
            // an end belongs to its piece, though the formula of a steep curve may lead farther past it
            if !starts && !ends && (piece.closest(point).point - point).amax() > near {
                return;
            }
            let direction = direction_at(&**piece, point);
            let curvature = piece.curvature(point);
            let mut add = |out: bool| {
                let (d, curvature) = if out { (direction, curvature) } else { (-direction, -curvature) };
                spokes.push(Spoke { angle: libm::atan2(d.y, d.x), curvature, out, number: copy.number });
            };
            if !ends {
                add(true);
            }
            if !starts {
                add(false);
            }
        },
    );
    spokes
}

/// The same in order around the point, starting after the widest gap, so that equal directions stay together.
fn in_order(mut spokes: Vec<Spoke>) -> Vec<Spoke> {
    spokes.sort_by(|a, b| a.angle.total_cmp(&b.angle));
    let gap = |k: usize| {
        let last = if k == 0 { spokes[spokes.len() - 1].angle - TAU } else { spokes[k - 1].angle };
        spokes[k].angle - last
    };
    let Some(first) = (0..spokes.len()).max_by(|&i, &j| gap(i).total_cmp(&gap(j))) else { return spokes };
    let start = spokes[first].angle;
    for spoke in &mut spokes {
        spoke.angle -= start;
        if spoke.angle < 0.0 {
            spoke.angle += TAU;
        }
    }
    spokes.sort_by(|a, b| a.angle.total_cmp(&b.angle));
    let (mut last, mut bundle) = (0.0, 0.0);
    for spoke in &mut spokes {
        if spoke.angle - last > SAME_DIRECTION {
            bundle = spoke.angle;
        }
        (last, spoke.angle) = (spoke.angle, bundle);
    }
    spokes.sort_by(Spoke::order);
    spokes
}
