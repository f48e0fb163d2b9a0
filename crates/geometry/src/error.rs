//! What can be wrong with a table.
mod rules;

pub use rules::{ImplicitRule, ParametricRule};
use thiserror::Error;

/// Why a piece or a table cannot be built.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// A piece without length or a direction that is zero.
    #[error("the piece has no length: its ends coincide, or its direction is zero")]
    ZeroLength,
    /// A radius that is not positive and finite.
    #[error("the radius must be positive and finite, not {}", short(*radius))]
    Radius {
        /// The radius given.
        radius: f64,
    },
    /// An arc whose ends are not equally far from its centre.
    #[error("the ends of the arc lie {} and {} from its centre; they must be equally far", short(*start), short(*end))]
    OffCircle {
        /// Distance of the start.
        start: f64,
        /// Distance of the end.
        end: f64,
    },
    /// An end of an arc that does not lie on the circle of the given radius.
    #[error("an end of the arc lies {} from its centre; its radius is {}", short(*distance), short(*radius))]
    OffRadius {
        /// Distance of the end.
        distance: f64,
        /// The radius.
        radius: f64,
    },
    /// An end of an elliptic arc that does not lie on the ellipse.
    #[error("an end of the arc does not lie on its ellipse, but on one {} times as large", short(*ratio))]
    OffEllipse {
        /// The size of the ellipse about the same centre through the end, in units of the given one.
        ratio: f64,
    },
    /// A parameter outside its range.
    #[error("{name} must be {must}, not {}", short(*value))]
    Parameter {
        /// Its name.
        name: &'static str,
        /// What it must be.
        must: &'static str,
        /// What it is.
        value: f64,
    },
    /// A number of sides or petals outside its range.
    #[error("{name} must be between {least} and {most}, not {value}")]
    Count {
        /// The parameter.
        name: &'static str,
        /// The smallest number that is possible.
        least: usize,
        /// The largest.
        most: usize,
        /// What it is.
        value: usize,
    },
    /// A length \[L\] outside its range.
    #[error("{name} must be {must}, not {}", short(*value))]
    Length {
        /// Its name.
        name: &'static str,
        /// What it must be.
        must: &'static str,
        /// What it is.
        value: f64,
    },
    /// A radius as a function of the angle that has another value after a whole turn.
    #[error("the curve does not close: r(2π) must be r(0) = {}, not {}", short(*start), short(*end))]
    Unclosed {
        /// The radius at angle 0.
        start: f64,
        /// The radius at angle 2π.
        end: f64,
    },
    /// A radius as a function of the angle that jumps.
    #[error("the curve is open: r(φ) jumps from {} to {} at φ = {angle:.4}", short(*before), short(*after))]
    PolarJump {
        /// The angle of the jump, in radians.
        angle: f64,
        /// The radius before the jump.
        before: f64,
        /// The radius after the jump.
        after: f64,
    },
    /// A formula that is positive inside its curve.
    #[error("the formula must be negative inside its curve; it is positive there")]
    Inverted,
    /// A formula for a radius that is not positive and finite in some direction, or cannot be shown to be.
    #[error("r(φ) must be positive and finite at every angle; near φ = {angle:.4} {}", comes_to(*radius, *certain))]
    PolarRadius {
        /// About where, in radians.
        angle: f64,
        /// The value of the formula there, or a value that its bounds allow.
        radius: f64,
        /// Whether this is the value of the formula itself.
        certain: bool,
    },
    /// A formula for a radius without a derivative in some direction.
    #[error(
        "r(φ) has no derivative near φ = {angle:.4}: at a kink, its derivative must be one of the two one-sided slopes"
    )]
    PolarSlope {
        /// About where, in radians.
        angle: f64,
    },
    /// A formula for a radius with a kink that the bounds on its second derivative cannot separate from its surroundings.
    #[error("r(φ) has a kink near φ = {angle:.4} that cannot be separated from its surroundings")]
    PolarKink {
        /// About where, in radians.
        angle: f64,
    },
    /// A formula with too many oscillations for the first hit to be found in reasonable time.
    #[error("the curve oscillates thousands of times, more often than can be tabulated")]
    Winding,
    /// A formula for which no zero was found in its box.
    #[error(
        "no curve was found in the box of the formula: the formula changes sign on none of the lines searched, and in the middle of the box it is {:?}", six_digits(*value)
    )]
    NoCurve {
        /// The value of the formula in the middle of its box.
        value: f64,
    },
    /// A curve whose parallel would turn back: its radius of curvature is smaller than the distance.
    #[error(
        "the curve bends too much for a parallel at distance {}: near {} its radius of curvature is smaller",
        short(*distance),
        about(at)
    )]
    Bend {
        /// The distance of the parallel.
        distance: f64,
        /// Approximate location.
        at: [f64; 2],
    },
    /// A curve with a kink that points into the table, around which its parallel would have a gap, or with the tip of a cusp, where its
    /// parallel would cross itself.
    #[error("the curve has a kink near {}", about(at))]
    Kink {
        /// Approximate location.
        at: [f64; 2],
    },
    /// A piece with such a kink or cusp, or with unbounded curvature: where a disk can go around it is not known.
    #[error("piece {piece} has a cusp or a kink near {} around which the path of a disk cannot be computed", about(at))]
    RoughPiece {
        /// The piece.
        piece: usize,
        /// Approximate location.
        at: [f64; 2],
    },
    /// A formula that does not bound a table.
    #[error("the curve of the formula must {must}; this fails near {}", about(at))]
    Curve {
        /// What the curve must do.
        must: ImplicitRule,
        /// About where it does not.
        at: [f64; 2],
    },
    /// Formulas of a parameter that do not give a curve.
    #[error("the curve of the formulas must {must}; this fails near t = {:?}", six_digits(*parameter))]
    Parametrised {
        /// What the curve must do.
        must: ParametricRule,
        /// About the parameter at which it does not.
        parameter: f64,
    },
    /// Sides that do not bound a convex (and, where required, centrally symmetric) polygon.
    #[error("the sides do not bound a convex polygon of the required kind")]
    NotConvex,
    /// A boundary that starts or ends at a point where nothing joins it.
    #[error("the boundary is open: piece {piece} {}", into_nowhere(*starts, *gap))]
    Open {
        /// The piece.
        piece: usize,
        /// Whether the piece starts where no other one ends; otherwise it ends where no other one starts.
        starts: bool,
        /// Distance to the nearest end (or start) of another piece; infinite where there is none.
        gap: f64,
    },
    /// Two pieces that cross.
    #[error("pieces {first} and {second} cross near {}", about(at))]
    Crossing {
        /// The one.
        first: usize,
        /// The other.
        second: usize,
        /// Approximate location.
        at: [f64; 2],
    },
    /// Two pieces that run along each other with the table on different sides, and differ by more than rounding of their points may.
    #[error(
        "pieces {first} and {second} run along each other near {}, as the two sides of one wall, but not to the last digits: a path would be caught between them",
        about(at)
    )]
    Faces {
        /// The one.
        first: usize,
        /// The other.
        second: usize,
        /// Approximate location.
        at: [f64; 2],
    },
    /// A boundary traversed with the table on its right.
    #[error(
        "piece {piece} has the table on its right: the boundary must be traversed with the table on its left (counter-clockwise around the table, clockwise around holes)"
    )]
    Orientation {
        /// A piece of the loop at fault.
        piece: usize,
    },
    /// A wall around a flat torus without another one that leads back.
    #[error(
        "the wall that begins with piece {piece} leads around the torus with the table on its left, but since no other wall leads back, the table also lies on its right"
    )]
    OneSided {
        /// The piece.
        piece: usize,
    },
    /// A stretch traversed there and back with the table on neither side.
    #[error("piece {piece} runs there and back near {}, where the table lies on neither side of it", about(at))]
    Spike {
        /// The piece.
        piece: usize,
        /// Approximate location.
        at: [f64; 2],
    },
    /// A loop that rounding has made flat.
    #[error(
        "the loop of piece {piece} encloses nothing: its area is {area:e}, and it is no wider than the rounding of its coordinates"
    )]
    Collapsed {
        /// A piece of the loop.
        piece: usize,
        /// Its area.
        area: f64,
    },
    /// A piece that is no longer than the rounding of its coordinates.
    #[error(
        "piece {piece} has a length of only {length:?}: its points coincide within the rounding of their coordinates"
    )]
    TooShort {
        /// The piece.
        piece: usize,
        /// Its length.
        length: f64,
    },
    /// A piece so small in its table that the times of hits on it cannot be compared.
    #[error(
        "piece {piece} is only {} wide, and must be at least {} wide in this table: times at which it is hit could not be compared with others",
        short(*width), short(six_digits(*least))
    )]
    Small {
        /// The piece.
        piece: usize,
        /// Its width: the longer side of the box around it.
        width: f64,
        /// The least that it may have.
        least: f64,
    },
    /// The closed outline of a shape of which several parts meet in a vertex, or that runs there and back from one.
    #[error("the closed outline of the shape touches itself at {}", about(at))]
    TouchingOutline {
        /// The vertex.
        at: [f64; 2],
    },
    /// A curve that crosses itself.
    #[error("piece {piece} crosses itself near {}", about(at))]
    SelfCrossing {
        /// The piece.
        piece: usize,
        /// Approximate location.
        at: [f64; 2],
    },
    /// The outline of a shape that crosses itself, so that it has no well-defined inside to unite with others.
    #[error("the outline of the shape crosses itself near {}", about(at))]
    CrossedOutline {
        /// Approximate location.
        at: [f64; 2],
    },
    /// An infinite piece on a lattice, where its translates would fill the plane.
    #[error(
        "piece {piece} is infinite: this is possible only for a line along the vector of a lattice with a single vector"
    )]
    InfiniteOnLattice {
        /// The piece.
        piece: usize,
    },
    /// Pieces so large compared with the cell of a lattice that there would be millions of translates.
    #[error(
        "piece {piece} extends over {cells:e} cells of the lattice: the lattice vectors are short compared with the piece, or nearly parallel"
    )]
    ManyCells {
        /// The piece.
        piece: usize,
        /// Approximate number of cells.
        cells: f64,
    },
    /// A piece so far from the unit cell of a lattice that rounded coordinates there cannot tell one cell from the next.
    #[error(
        "piece {piece} lies {cells:.0e} cells of the lattice away from the unit cell, where coordinates are rounded to fractions of a cell"
    )]
    FarFromCell {
        /// The piece.
        piece: usize,
        /// Approximate number of cells.
        cells: f64,
    },
    /// An arc so flat that rounding decides where it is.
    #[error(
        "piece {piece} is an arc of radius {radius:?} in a table that reaches only {size:?} from the origin: rounding decides where it lies"
    )]
    Flat {
        /// The piece.
        piece: usize,
        /// Its radius.
        radius: f64,
        /// The largest coordinate of a vertex.
        size: f64,
    },
    /// An ellipse so flat that its two sides cannot be told apart near its ends.
    #[error(
        "piece {piece} is an ellipse too flat for its two sides to be told apart: its shorter semi-axis is {}, and must be at least {}",
        short(*width), short(six_digits(*least))
    )]
    Thin {
        /// The piece.
        piece: usize,
        /// Its shorter semi-axis.
        width: f64,
        /// The shortest one that it may have.
        least: f64,
    },
    /// A disk that fits nowhere in the table.
    #[error("a disk of radius {} has no room to move in the table; its radius must be less than {}", short(*radius), short(*largest))]
    NothingLeft {
        /// The requested radius.
        radius: f64,
        /// Radius of the largest disk in the table.
        largest: f64,
    },
    /// A radius at which the topology of the region of centres changes, so that rounding would decide about it.
    #[error(
        "a disk of radius {} just touches several walls at once near {}: rounding would decide whether it passes; choose a slightly smaller or larger radius",
        short(*radius),
        about(at)
    )]
    Undecided {
        /// The requested radius.
        radius: f64,
        /// Approximate location.
        at: [f64; 2],
    },
    /// A file that holds no outline or surface, or not one that can be read.
    #[error("{place}: {problem}")]
    Import {
        /// Line and element, or the path of keys.
        place: String,
        /// What is wrong there.
        problem: String,
    },
    /// No piece at all.
    #[error("the table has no boundary")]
    Empty,
    /// Lattice vectors that are dependent or too many.
    #[error("the lattice vectors must be one or two, finite and independent")]
    Lattice,
    /// A shape that cannot bound a table in the requested way.
    #[error("{shape}: {why}")]
    Shape {
        /// The kind of shape.
        shape: &'static str,
        /// What stands in the way.
        why: &'static str,
    },
    /// A triangle of a mesh that cannot bound a table together with the others.
    #[error("triangle mesh: triangle {triangle}, counted from 0, {problem}")]
    Triangle {
        /// Its number.
        triangle: usize,
        /// What is wrong with it, and what to do.
        problem: &'static str,
    },
    /// A field of the description of a shape that is wrong.
    #[error("{field} must be {must}")]
    Field {
        /// Its name, with the numbers of entries: `vertices[3]`, `compound[1].shape.radius`.
        field: String,
        /// What it must be.
        must: &'static str,
    },
    /// Two fields of the description of a shape that are one point.
    #[error("{field} must be another point than {other}")]
    SamePoint {
        /// The name of the one, as in [`Error::Field`].
        field: String,
        /// The field of the same shape that it must differ from.
        other: String,
    },
    /// An open surface in space that ends inside the room that other walls enclose.
    #[error(
        "piece {piece} is an open surface that ends inside the room: orbits come round its rim to the space behind it, where none starts, so the distribution of their starts does not last"
    )]
    Rim {
        /// The piece.
        piece: usize,
    },
    /// Infinite walls or an infinite table on which something is to be distributed uniformly.
    #[error("{what} is infinite: there is no uniform distribution on it")]
    Unbounded {
        /// The length or area, in words.
        what: &'static str,
    },
    /// Walls that together do not bound a table.
    #[error(
        "nothing is left of the walls, or too little to draw points from: no point of a wall was found that lies on the table's side of all others"
    )]
    Vanished,
    /// A parameter that a named table does not have.
    #[error("{table} has no parameter {name}; it has {known}")]
    Unknown {
        /// The parameter given.
        name: String,
        /// The table.
        table: &'static str,
        /// The parameters that there are.
        known: String,
    },
    /// A parameter that a named table needs.
    #[error("{name} is required")]
    Missing {
        /// The parameter.
        name: &'static str,
    },
    /// A parameter of the wrong form.
    #[error("{name} must be {must}, not {found}")]
    Form {
        /// The parameter.
        name: &'static str,
        /// What it must be.
        must: String,
        /// What it is.
        found: String,
    },
    /// A named table of another dimension.
    #[error("{table} is a table in {dimension} dimensions")]
    Dimension {
        /// The table.
        table: &'static str,
        /// Its dimension.
        dimension: usize,
    },
}

/// Where a boundary is open.
fn into_nowhere(starts: bool, gap: f64) -> String {
    match (starts, gap.is_finite()) {
        (true, true) => format!("starts {gap:?} away from the nearest end of another piece"),
        (true, false) => "starts where no other piece ends".into(),
        (false, true) => format!("ends {gap:?} away from the nearest start of another piece"),
        (false, false) => "ends where no other piece starts".into(),
    }
}

/// A point to six digits; a coordinate that is negligible beside the other one is shown as 0.
fn about(at: &[f64; 2]) -> String {
    let size = at[0].abs().max(at[1].abs());
    let [x, y] = at.map(|x| if x.abs() < 1e-12 * size { 0.0 } else { six_digits(x) }).map(|x| format!("{x:?}"));
    format!("({}, {})", x.trim_end_matches(".0"), y.trim_end_matches(".0"))
}

fn six_digits(x: f64) -> f64 {
    format!("{x:.5e}").parse().unwrap_or(x)
}

/// A number, with an exponent where there would otherwise be a row of zeros.
fn short(x: f64) -> String {
    format!("{x:?}").trim_end_matches(".0").into()
}

/// What is wrong with a radius.
fn comes_to(radius: f64, certain: bool) -> String {
    if radius.is_nan() {
        "it has no real value".into()
    } else {
        format!("it {} {}", if certain { "is" } else { "may be" }, short(radius))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Errors about lengths of this size, the one of them greater than the other in the last digit.
    fn about_lengths(size: f64) -> [Error; 6] {
        let other = size.next_up();
        [
            Error::OffCircle { start: size, end: other },
            Error::OffRadius { distance: other, radius: size },
            Error::OffEllipse { ratio: size },
            Error::Unclosed { start: size, end: other },
            Error::PolarJump { angle: 0.5, before: size, after: other },
            Error::Bend { distance: size, at: [size, 0.0] },
        ]
    }

    #[test]
    fn lengths_are_told_to_the_last_digit_without_rows_of_zeros() {
        for (size, spelled, other) in [
            (0.5, "0.5", "0.5000000000000001"),
            (2.0, "2", "2.0000000000000004"),
            (1e-120, "1e-120", "1.0000000000000002e-120"),
            (1e120, "1e120", "1.0000000000000001e120"),
        ] {
            for error in about_lengths(size) {
                let told = error.to_string();
                let names = |number: &str| told.split([' ', ',', ';', ':']).any(|word| word == number);
                assert!(names(spelled), "{told}");
                let of_two = !matches!(error, Error::OffEllipse { .. } | Error::Bend { .. });
                assert_eq!(names(other), of_two, "{told}");
                assert!(!told.contains("0000000000000000"), "{told}");
            }
        }
    }
}
