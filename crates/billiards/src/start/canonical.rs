//! The canonical measure of a planar table.
use super::{Start, Starts, checked, in_unit_ball, leaving, stream, uniform};
use crate::Error;
use geometry::{Perimeter, Table};

/// The canonical measure of a planar table, which the billiard map of every strict law preserves: position uniform by arc length on the
/// boundary, `(v₀, vₜ)/speed` uniform in the unit disk, velocity into the table; for a point, which has no spin, `vₜ/speed` uniform
/// between −1 and 1.
///
/// ```
/// use billiards::{Canonical, Starts, geometry::tables};
///
/// let table = tables::stadium(1.0, 1.0)?;
/// let canonical = Canonical::new(&table, 1.0, 7)?;
/// let start = canonical.start(1_000_000);
/// assert_eq!(start, canonical.start(1_000_000));
/// let ([v1, v2], [v0]) = (start.velocity, start.spin);
/// assert!((v0 * v0 + v1 * v1 + v2 * v2 - 1.0).abs() < 1e-15);
///
/// let [v1, v2] = Canonical::of_points(&table, 1.0, 7)?.start(0).velocity;
/// assert!((v1 * v1 + v2 * v2 - 1.0).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Canonical<'a, const S: usize = 1> {
    perimeter: Perimeter<'a>,
    speed: f64,
    seed: u64,
}

impl<'a> Canonical<'a> {
    /// Starts of disks at `speed` \[L T⁻¹\], spin included.
    ///
    /// # Errors
    /// [`Error::Table`] for a boundary of infinite length, [`Error::Speed`] unless the speed is positive and finite.
    pub fn new(table: &'a Table, speed: f64, seed: u64) -> Result<Self, Error> {
        Ok(Canonical { perimeter: Perimeter::of(table)?, speed: checked(speed)?, seed })
    }
}

impl<'a> Canonical<'a, 0> {
    /// Starts of points at `speed` \[L T⁻¹\].
    ///
    /// # Errors
    /// Those of [`Canonical::new`].
    pub fn of_points(table: &'a Table, speed: f64, seed: u64) -> Result<Self, Error> {
        Ok(Canonical { perimeter: Perimeter::of(table)?, speed: checked(speed)?, seed })
    }
}

impl Starts<2, 1> for Canonical<'_> {
    fn start(&self, i: u64) -> Start<2, 1> {
        let mut stream = stream(self.seed, i);
        let at = self.perimeter.point(uniform(&mut stream));
        let [v0, vt] = in_unit_ball(&mut stream);
        leaving(at.point, at.normal, [v0], vt, self.speed)
    }
}

impl Starts<2, 0> for Canonical<'_, 0> {
    fn start(&self, i: u64) -> Start<2, 0> {
        let mut stream = stream(self.seed, i);
        let at = self.perimeter.point(uniform(&mut stream));
        let [vt] = in_unit_ball(&mut stream);
        leaving(at.point, at.normal, [], vt, self.speed)
    }
}
