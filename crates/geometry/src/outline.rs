//! Drawing a closed loop of the boundary edge by edge.
use crate::{
    Error, Piece,
    shapes::{Arc, Segment},
};
use nalgebra::Vector2;

/// The sense in which an arc turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turn {
    /// Counter-clockwise: the table lies inside the circle.
    CounterClockwise,
    /// Clockwise: the table lies outside the circle.
    Clockwise,
}

/// A loop being drawn, table on the left. Consecutive edges share their vertex by construction.
///
/// ```
/// use geometry::{Outline, Table, Turn, Vector2};
/// let v = Vector2::new;
/// let stadium = Outline::from(v(-1.0, -1.0))
///     .line_to(v(1.0, -1.0))?
///     .arc_to(v(1.0, 1.0), v(1.0, 0.0), Turn::CounterClockwise)?
///     .line_to(v(-1.0, 1.0))?
///     .arc_to(v(-1.0, -1.0), v(-1.0, 0.0), Turn::CounterClockwise)?;
/// let table = Table::new(stadium.close()?)?;
/// assert!((table.area() - (4.0 + core::f64::consts::PI)).abs() < 1e-15);
/// # Ok::<(), geometry::Error>(())
/// ```
#[derive(Debug)]
pub struct Outline {
    start: Vector2<f64>,
    at: Vector2<f64>,
    pieces: Vec<Box<dyn Piece>>,
}

impl Outline {
    /// A loop that starts at a vertex.
    pub fn from(start: Vector2<f64>) -> Outline {
        Outline { start, at: start, pieces: vec![] }
    }

    /// A straight edge to the next vertex.
    ///
    /// # Errors
    /// As [`Segment::new`].
    pub fn line_to(mut self, to: Vector2<f64>) -> Result<Outline, Error> {
        self.pieces.push(Box::new(Segment::new(self.at, to)?));
        self.at = to;
        Ok(self)
    }

    /// A circular arc to the next vertex.
    ///
    /// # Errors
    /// As [`Arc::new`].
    pub fn arc_to(mut self, to: Vector2<f64>, center: Vector2<f64>, turn: Turn) -> Result<Outline, Error> {
        self.pieces.push(Box::new(Arc::new(center, self.at, to, turn == Turn::CounterClockwise)?));
        self.at = to;
        Ok(self)
    }

    /// Any piece that starts where the loop is now.
    ///
    /// # Errors
    /// [`Error::Open`] if it starts elsewhere or does not end.
    pub fn piece(mut self, piece: Box<dyn Piece>) -> Result<Outline, Error> {
        let gap = |at: Vector2<f64>| (at - self.at).norm();
        match piece.ends() {
            Some([a, b]) if a == self.at => {
                self.at = b;
                self.pieces.push(piece);
                Ok(self)
            }
            Some([a, _]) => Err(Error::Open { piece: self.pieces.len(), starts: true, gap: gap(a) }),
            None => Err(Error::Open { piece: self.pieces.len(), starts: false, gap: f64::INFINITY }),
        }
    }

    /// The pieces of the closed loop, whose last vertex must be the first one.
    ///
    /// # Errors
    /// [`Error::Open`] if it is not.
    pub fn close(self) -> Result<Vec<Box<dyn Piece>>, Error> {
        if self.pieces.is_empty() {
            return Err(Error::Empty);
        }
        if self.at != self.start {
            let gap = (self.at - self.start).norm();
            return Err(Error::Open { piece: self.pieces.len() - 1, starts: false, gap });
        }
        Ok(self.pieces)
    }
}
