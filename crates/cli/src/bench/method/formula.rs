//! The boundary as one formula, as a scene may write it: cut into polynomial graphs.

use billiards::geometry::shapes::curve::{Implicit, Polar};
use billiards::geometry::{Piece, Table, Vector2};

use super::super::Effort;
use super::super::case::{Case, Formulas};
use super::super::chart::Mark;
use super::super::law::Law;
use super::exact::Plane;
use super::{Built, Entry};
use crate::expression::{Expression, ImplicitCurve, PolarCurve};

pub(super) const IMPLICIT: Entry = Entry {
    name: "formula f(x, y) = 0",
    summary: "the boundary as one equation, cut into polynomial graphs accurate to rounding",
    mark: Mark::Square,
    sizes,
    build: |case, law, _| {
        build(case, law, |formulas| {
            let [a, b] = formulas.within;
            let f = Expression::parse(formulas.implicit, &["x", "y"])?;
            Ok(Box::new(Implicit::new(ImplicitCurve::new(&f, [[-a, -b], [a, b]]), true)?))
        })
    },
};

pub(super) const POLAR: Entry = Entry {
    name: "formula r(t)",
    summary: "the boundary as a radius for every direction, cut into polynomial graphs accurate to rounding",
    mark: Mark::Triangle,
    sizes,
    build: |case, law, _| {
        build(case, law, |formulas| {
            let r = Expression::parse(formulas.polar, &["t"])?;
            Ok(Box::new(Polar::new(Vector2::zeros(), PolarCurve::new(&r), true)?))
        })
    },
};

fn sizes(case: &Case, _: Effort) -> Vec<Option<usize>> {
    if case.formulas.is_some() { vec![None] } else { vec![] }
}

fn build(
    case: &Case,
    law: Law,
    piece: impl Fn(&Formulas) -> Result<Box<dyn Piece>, Box<dyn std::error::Error>>,
) -> Built {
    let formulas = case.formulas.as_ref().ok_or("the boundary is not given by a single formula")?;
    Ok(Box::new(Plane { table: Table::new(vec![piece(formulas)?])?, law: law.planar() }))
}
