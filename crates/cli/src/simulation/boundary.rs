//! From the boundary that a scene describes to a table.

mod complaint;
mod pieces;
mod scaled;

use core::f64::consts::TAU;

use billiards::geometry::tables::{self, Kind, Values};
use billiards::geometry::{Error, Table, import};

use crate::document::{Diagnostic, Span};
use crate::scene::{Arguments, Border, Curve, EdgePath, LawKind, Scene, Starts, TableShape};

use super::scale;

pub(super) use complaint::{in_user_units, with_advice, wrong_argument};
use pieces::{Outline, explicit, outlines};

/// Where a piece comes from.
#[derive(Clone, Debug)]
pub(crate) struct PieceSource {
    /// Where it stands in the scene.
    span: Span,
    /// Where it is in a file that the scene names.
    place: Option<import::Place>,
}

/// A planar table as drawn, all lengths multiplied by a factor.
#[derive(Clone, Debug)]
pub(crate) struct Drawn {
    /// The table.
    pub(crate) table: Table,
    /// Where each piece comes from.
    pub(crate) sources: Vec<PieceSource>,
    /// The laws of pieces that have their own.
    pub(crate) laws: Vec<Option<LawKind>>,
    /// The factor: a power of two.
    pub(crate) factor: f64,
}

/// Draws the table of a planar scene.
pub(crate) fn draw(scene: &Scene) -> Result<Drawn, Vec<Diagnostic>> {
    let mut drawn = match &scene.table.shape {
        TableShape::Named { model, arguments, span } => {
            named(scene, model.name, arguments, *span, scale::to_unity(lengths(scene, [])))?
        }
        TableShape::Boundary(entries) => {
            let outlines = outlines(scene, entries);
            let sizes = outlines.iter().flatten().flatten().map(Outline::size);
            let factor = scale::to_unity(lengths(scene, sizes));
            explicit(scene, entries, outlines, factor)?
        }
    };
    let mut checked = drawn.table.validate();
    if matches!(checked, Err(Error::Spike { .. }))
        && let Some(joined) = drawn.joined()
    {
        drawn = joined;
        checked = drawn.table.validate();
    }
    if let Err(error) = checked {
        return Err(vec![drawn.complaint(scene, &error)]);
    }
    own_laws(scene, &mut drawn.laws).map_err(|diagnostic| vec![*diagnostic])?;
    Ok(drawn)
}

/// Gives pieces the laws that `laws = { 0 = "specular" }` names; those that have one already are an error.
pub(super) fn own_laws(scene: &Scene, laws: &mut [Option<LawKind>]) -> Result<(), Box<Diagnostic>> {
    let count = laws.len();
    for law in &scene.table.laws {
        let Some(of_piece) = laws.get_mut(law.piece.value) else {
            let what = format!("there is no piece {}: the table has {count}, numbered from 0", law.piece.value);
            return Err(Box::new(scene.source.diagnostic(law.piece.span, what)));
        };
        if of_piece.replace(law.law.clone()).is_some() {
            let what = format!("piece {} has a law of its own where it is drawn", law.piece.value);
            return Err(Box::new(
                scene.source.diagnostic(law.piece.span, what).with_help("leave out one of the two laws"),
            ));
        }
    }
    Ok(())
}

impl Drawn {
    /// The same without stretches that entries have in common and that bound nothing.
    fn joined(&self) -> Option<Drawn> {
        let (table, origins) = self.table.joined()?;
        let sources = origins.iter().map(|&piece| self.sources[piece].clone()).collect();
        let laws = origins.iter().map(|&piece| self.laws[piece].clone()).collect();
        Some(Drawn { table, sources, laws, factor: self.factor })
    }

    /// An error of the geometry, expressed as one about the scene.
    pub(crate) fn complaint(&self, scene: &Scene, error: &Error) -> Diagnostic {
        complaint::of_table(scene, self, error)
    }

    /// The error with lengths in the user's unit.
    pub(crate) fn in_user_units(&self, error: &Error) -> Error {
        in_user_units(error, self.factor)
    }
}

/// Every length that determines the size of a scene, with the sizes of what is drawn in files.
pub(super) fn lengths(scene: &Scene, of_files: impl IntoIterator<Item = f64>) -> Vec<f64> {
    let mut all = vec![scene.particle.radius.value];
    all.extend(of_files);
    all.extend(scene.table.lattice.iter().flat_map(|vector| vector.value.iter().copied()));
    match &scene.table.shape {
        TableShape::Named { model, arguments, .. } => {
            let entry = tables::find(model.name);
            let parameters = entry.map_or(&[][..], |entry| entry.parameters);
            for parameter in parameters.iter().filter(|p| p.kind.is_length()) {
                all.extend(arguments.numbers(parameter.name));
                all.extend(arguments.points(parameter.name).iter().flat_map(|point| point.value.iter().copied()));
            }
        }
        TableShape::Boundary(entries) => entries.iter().for_each(|entry| of_border(&entry.border, &mut all)),
    }
    if all.iter().all(|x| *x == 0.0)
        && let Starts::Orbits(orbits) = &scene.starts
    {
        // a table without any length of its own, such as a wedge
        all.extend(orbits.iter().flat_map(|orbit| orbit.position.value.iter().copied()));
    }
    all
}

/// Number of parameters at which the size of formulas is sampled.
const PLACES: u32 = 16;

fn of_border(border: &Border, all: &mut Vec<f64>) {
    match border {
        Border::Loop { from, edges, .. } => {
            all.extend(&from.value);
            for edge in edges {
                all.extend(&edge.path.end().value);
                if let EdgePath::Arc { center, .. } = &edge.path {
                    all.extend(&center.value);
                }
            }
        }
        Border::Circle { center, radius, .. } => all.extend(center.value.iter().chain([&radius.value])),
        Border::Ellipse { center, semi_axes, .. } => all.extend(center.value.iter().chain(&semi_axes.value)),
        Border::Line { through, .. } | Border::Plane { through, .. } => all.extend(&through.value),
        Border::Ray { from, .. } => all.extend(&from.value),
        Border::Curve { curve: Curve::Polar { radius, center }, .. } => {
            all.extend(&center.value);
            // the size of a formula is that of its values
            all.extend((0..PLACES).map(|k| radius.evaluate(&[TAU * f64::from(k) / f64::from(PLACES)])));
        }
        Border::Curve { curve: Curve::Parametric { point, over }, .. } => {
            let [start, end] = over.value;
            let places = (0..PLACES).map(|k| start + (end - start) * f64::from(k) / f64::from(PLACES));
            all.extend(places.flat_map(|t| point.iter().map(move |x| x.evaluate(&[t]))));
        }
        Border::Curve { curve: Curve::Implicit { within, .. }, .. } => all.extend(within.value.as_flattened()),
        Border::Shape { lengths, .. } => all.extend(lengths),
        Border::Mesh { center, .. } => all.extend(&center.value),
        Border::Outline { .. } => {}
    }
}

fn named(scene: &Scene, name: &str, arguments: &Arguments, span: Span, factor: f64) -> Result<Drawn, Vec<Diagnostic>> {
    let one = |span: Span, what: String| vec![scene.source.diagnostic(span, what)];
    let entry = tables::find(name).ok_or_else(|| one(span, format!("there is no table \"{name}\"")))?;
    if let Some(vector) = scene.table.lattice.first() {
        let what = format!("the built-in table \"{name}\" cannot be repeated on a lattice");
        return Err(vec![
            scene.source.diagnostic(vector.span, what).with_help("write its boundary with [[table.boundary]]"),
        ]);
    }
    let values = values(entry, arguments);
    let table = entry
        .planar(&entry.scaled(&values, factor))
        .map_err(|error| vec![*wrong_argument(scene, arguments, &error, factor)])?;
    let count = table.pieces().len();
    let source = PieceSource { span, place: None };
    Ok(Drawn { table, sources: vec![source; count], laws: vec![None; count], factor })
}

/// The values of a built-in table's parameters, in the geometry crate's form.
pub(super) fn values(entry: &tables::Entry, arguments: &Arguments) -> Values {
    let mut values = Values::new();
    for parameter in entry.parameters {
        let numbers = arguments.numbers(parameter.name);
        values = match parameter.kind {
            Kind::Points(_) => {
                let point = |p: &crate::document::Spanned<Vec<f64>>| [p.value[0], p.value[1]];
                values.with(parameter.name, arguments.points(parameter.name).iter().map(point).collect::<Vec<_>>())
            }
            Kind::Lengths(_) => values.with(parameter.name, numbers.to_vec()),
            Kind::Length | Kind::Displacement | Kind::Angle | Kind::Number | Kind::Count { .. } => {
                values.with(parameter.name, arguments.number(parameter.name))
            }
        };
    }
    values
}
