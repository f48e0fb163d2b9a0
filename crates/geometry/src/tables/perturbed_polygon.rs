//! Regular polygons with smoothly bent sides.
use super::registry::{Build, Entry, Parameter};
use super::vertices::{number_of, on_circumcircle, positive, root_of_unity, within};
use crate::{Error, Piece, Table, shapes::Bump};

/// The regular polygon with `n` sides of length `a` \[L\] about the origin, every side bent by a C² bump of height
/// `amount · a`: outwards where `amount > 0`, into the table where it is negative; piece i starts at vertex i, vertex 0
/// on the +x₁ axis. Area `n a² (1/(4 tan(π/n)) + 16/35 amount)`.
///
/// Vertices and angles stay as they are, and the curvature vanishes at the vertices ([`Bump`]).
///
/// # Errors
/// [`Error::Count`] unless there are 3 to 1 000 000 sides, [`Error::Parameter`] unless their length is positive and
/// finite, and neighbouring bumps do not meet: `amount > −3125/(6912 tan(π/n))`.
pub fn perturbed_polygon(n: usize, side: f64, amount: f64) -> Result<Table, Error> {
    number_of("sides", n, 3)?;
    positive("side", side)?;
    // each bump stays on its own side of the lines from the centre to the vertices: u / p(u) ≥ 3125/6912
    let [cos, sin] = root_of_unity(1, 2 * n);
    let apart = amount > -(3125.0 / 6912.0) * (cos / sin);
    within(
        "amount",
        amount,
        apart && amount.is_finite(),
        "finite and more than -0.452/tan(pi/sides) (so that bumps stay apart)",
    )?;
    let vertex = |k: usize| on_circumcircle(2 * k, n, side);
    let bent = |k: usize| -> Result<Box<dyn Piece>, Error> {
        Ok(Box::new(Bump::new(vertex(k), vertex((k + 1) % n), amount * side)?))
    };
    Table::new((0..n).map(bent).collect::<Result<_, _>>()?)
}

pub(super) const ENTRY: Entry = Entry {
    name: "perturbed-polygon",
    summary: "a regular polygon whose sides are bent by smooth bumps, whose height is amount times the side",
    parameters: &[
        Parameter::count("sides", 3, 5.0),
        Parameter::length("side", 1.0),
        Parameter::number("amount", 0.05).required(),
    ],
    build: Build::Planar(|v| perturbed_polygon(v.count("sides")?, v.number("side")?, v.number("amount")?)),
};
