//! Description of a table: its parts, sizes and corners.
use crate::{Component, LargestDisk, Piece, Table, components::components_of, joints::joints, table::SMOOTH};

/// The measures of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Description {
    /// Number of pieces.
    pub pieces: usize,
    /// Length of the boundary \[L\], per unit cell on a lattice.
    pub perimeter: f64,
    /// Number of corners: joints of two pieces at which the boundary turns (once each), tips of walls without thickness, and points where
    /// walls touch (once for each part of the table around them). Corners where something touches an ellipse or a curve given by a formula
    /// are not counted. ([`Table::corners`] are vertices at which the normal jumps, two for a joint across cells of a lattice.)
    pub corners: usize,
    /// Those of them where the table's angle is greater than π.
    pub re_entrant_corners: usize,
    /// The connected parts of the table.
    pub components: Vec<Component>,
    /// The largest disk that fits in.
    pub largest_disk: LargestDisk,
}

impl Description {
    /// Area of the table \[L²\], per unit cell on a lattice; infinite where it is unbounded.
    pub fn area(&self) -> f64 {
        self.components.iter().map(|c| c.area).sum()
    }
}

impl Table {
    /// Describes the table, which should satisfy [`Table::validate`].
    ///
    /// ```
    /// use geometry::tables;
    /// let mushroom = tables::mushroom(1.0, 0.5, 0.75)?.describe();
    /// assert_eq!((mushroom.corners, mushroom.re_entrant_corners), (6, 2));
    /// assert!((mushroom.area() - (core::f64::consts::FRAC_PI_2 + 0.375)).abs() < 1e-14);
    /// # Ok::<(), geometry::Error>(())
    /// ```
    pub fn describe(&self) -> Description {
        let parted = self.parted();
        let turns = if let Some(parted) = &parted {
            parted.turns.clone()
        } else {
            // and about the tips of walls without thickness
            let tips = self.pieces().iter().filter_map(Piece::tips).flatten().map(|_| -core::f64::consts::PI);
            joints(self).iter().map(|joint| joint.turn(self)).chain(tips).collect()
        };
        Description {
            pieces: self.pieces().len(),
            perimeter: self.perimeter(),
            corners: turns.iter().filter(|t| t.abs() > SMOOTH).count(),
            re_entrant_corners: turns.iter().filter(|&&t| t < -SMOOTH).count(),
            components: components_of(self, parted),
            largest_disk: self.largest_disk(),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::tables;

    #[test]
    fn descriptions_count_corners() {
        let stadium = tables::stadium(1.0, 1.0).unwrap().describe();
        assert_eq!((stadium.pieces, stadium.corners, stadium.components.len()), (4, 0, 1));
        assert!((stadium.largest_disk.radius - 1.0).abs() < 1e-15);
        let moon = tables::moon(1.0, 0.75, 1.0).unwrap().describe();
        assert_eq!((moon.corners, moon.re_entrant_corners), (2, 0));
        let wedge = tables::wedge(1.0).unwrap().describe();
        assert_eq!((wedge.corners, wedge.area()), (1, f64::INFINITY));
        assert!(wedge.largest_disk.radius.is_infinite());
    }
}
