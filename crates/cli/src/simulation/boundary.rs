//! From the boundary that a scene describes to a table.

use std::path::Path;

use billiards::geometry::parry;
use billiards::geometry::shapes::curve::{Implicit, ImplicitFormula, Interval, Polar, PolarFormula};
use billiards::geometry::shapes::{Arc, Circle, Ellipse, FullLine, Ray, Segment};
use billiards::geometry::tables::{self, Kind, Values};
use billiards::geometry::{Error, Extent, Lattice, Piece, Table, Vector2, import};

use crate::document::{Diagnostic, Span, Spanned};
use crate::expression::{ImplicitCurve, PolarCurve};
use crate::scene::{
    self, Arguments, Border, Curve, Domain, Edge, EdgePath, Entry, LawKind, Scene, Side, TableShape, Turn,
};

use super::scale;
use super::words::short;

/// A planar table as drawn, all lengths multiplied by a factor.
#[derive(Clone, Debug)]
pub(crate) struct Drawn {
    /// The table.
    pub(crate) table: Table,
    /// Where each piece stands in the scene.
    pub(crate) spans: Vec<Span>,
    /// The laws that pieces have of their own.
    pub(crate) laws: Vec<Option<LawKind>>,
    /// The factor: a power of two.
    pub(crate) factor: f64,
}

/// Draws the table of a planar scene.
pub(crate) fn draw(scene: &Scene) -> Result<Drawn, Vec<Diagnostic>> {
    let factor = scale::to_unity(lengths(scene));
    let mut drawn = match &scene.table.shape {
        TableShape::Named { model, arguments, span } => named(scene, model.name, arguments, *span, factor)?,
        TableShape::Boundary(entries) => explicit(scene, entries, factor)?,
    };
    if let Err(error) = drawn.table.validate() {
        return Err(vec![drawn.complaint(scene, &error)]);
    }
    own_laws(scene, &mut drawn.laws).map_err(|diagnostic| vec![*diagnostic])?;
    Ok(drawn)
}

/// Gives pieces the laws that `laws = { 0 = "specular" }` names.
pub(super) fn own_laws(scene: &Scene, laws: &mut [Option<LawKind>]) -> Result<(), Box<Diagnostic>> {
    let count = laws.len();
    for law in &scene.table.laws {
        let Some(of_piece) = laws.get_mut(law.piece.value) else {
            let what = format!("there is no piece {}: the table has {count}, numbered from 0", law.piece.value);
            return Err(Box::new(scene.source.diagnostic(law.piece.span, what)));
        };
        *of_piece = Some(law.law.clone());
    }
    Ok(())
}

impl Drawn {
    /// An error of the geometry as one about the scene.
    pub(crate) fn complaint(&self, scene: &Scene, error: &Error) -> Diagnostic {
        let at = |piece: usize| self.spans.get(piece).copied().unwrap_or(scene.table.span);
        let span = match error {
            Error::Open { piece, .. }
            | Error::Orientation { piece }
            | Error::TooShort { piece, .. }
            | Error::SelfCrossing { piece, .. } => at(*piece),
            Error::Crossing { second, .. } => at(*second),
            _ => scene.table.span,
        };
        with_advice(scene.source.diagnostic(span, self.in_user_units(error).to_string()), error)
    }

    /// An error whose lengths are those of the user.
    pub(crate) fn in_user_units(&self, error: &Error) -> Error {
        in_user_units(error, self.factor)
    }
}

/// An error whose lengths are those of the user.
fn in_user_units(error: &Error, factor: f64) -> Error {
    let back = |x: f64| x / factor;
    match error.clone() {
        Error::Radius { radius } => Error::Radius { radius: back(radius) },
        Error::OffCircle { start, end } => Error::OffCircle { start: back(start), end: back(end) },
        Error::Open { piece, gap } => Error::Open { piece, gap: back(gap) },
        Error::Crossing { first, second, at } => Error::Crossing { first, second, at: at.map(back) },
        Error::SelfCrossing { piece, at } => Error::SelfCrossing { piece, at: at.map(back) },
        Error::Curve { must, at } => Error::Curve { must, at: at.map(back) },
        Error::TooShort { piece, length } => Error::TooShort { piece, length: back(length) },
        Error::NothingLeft { radius, largest } => Error::NothingLeft { radius: back(radius), largest: back(largest) },
        Error::Undecided { radius, at } => Error::Undecided { radius: back(radius), at: at.map(back) },
        other => other,
    }
}

/// Adds how to mend an error of the geometry, where its words do not say so.
fn with_advice(diagnostic: Diagnostic, error: &Error) -> Diagnostic {
    let advice = match error {
        Error::ZeroLength => "leave it out, or move one of its ends",
        Error::TooShort { .. } => "leave it out, or move its ends apart",
        Error::OffCircle { .. } => "put the center on the perpendicular bisector of the two ends",
        Error::Crossing { first, second, .. } if first == second => {
            "it crosses its own translate in the next cell of the lattice: make it smaller, or the cell larger"
        }
        Error::Crossing { .. } => "pieces may touch but not cross: move one of them, or make one loop of both",
        Error::SelfCrossing { .. } => "a piece of wall is a simple curve: change its formula or split the loop there",
        Error::Open { .. } => "close the loop, or continue it to infinity with a ray",
        Error::Orientation { .. } => "list the vertices in the opposite order, or exchange inside and outside",
        _ => return diagnostic,
    };
    diagnostic.with_help(advice)
}

/// Every length that says how large a scene is; none, and so no scaling, if part of it is drawn in a file.
pub(super) fn lengths(scene: &Scene) -> Vec<f64> {
    if let TableShape::Boundary(entries) = &scene.table.shape
        && entries.iter().any(|entry| matches!(entry.border, Border::Outline { .. }))
    {
        return vec![];
    }
    let mut all = vec![scene.particle.radius.value];
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
        && let scene::Starts::Orbits(orbits) = &scene.starts
    {
        // a table without any length of its own, such as a wedge
        all.extend(orbits.iter().flat_map(|orbit| orbit.position.value.iter().copied()));
    }
    all
}

fn of_border(border: &Border, all: &mut Vec<f64>) {
    match border {
        Border::Loop { from, edges, .. } => {
            all.extend(&from.value);
            for edge in edges {
                match &edge.path {
                    EdgePath::Line { to } => all.extend(&to.value),
                    EdgePath::Arc { to, center, .. } => all.extend(to.value.iter().chain(&center.value)),
                }
            }
        }
        Border::Circle { center, radius, .. } => all.extend(center.value.iter().chain([&radius.value])),
        Border::Ellipse { center, semi_axes, .. } => all.extend(center.value.iter().chain(&semi_axes.value)),
        Border::Line { through, .. } | Border::Plane { through, .. } => all.extend(&through.value),
        Border::Ray { from, .. } => all.extend(&from.value),
        Border::Curve { curve: Curve::Polar { center, .. }, .. } => all.extend(&center.value),
        Border::Curve { curve: Curve::Implicit { within, .. }, .. } => all.extend(within.value.as_flattened()),
        Border::Shape { lengths, .. } => all.extend(lengths),
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
    Ok(Drawn { table, spans: vec![span; count], laws: vec![None; count], factor })
}

/// What is wrong with the parameters of a built-in table, at the parameter's place.
#[allow(clippy::unnecessary_box_returns, reason = "it goes into a Result, where a large error costs every success")]
pub(super) fn wrong_argument(scene: &Scene, arguments: &Arguments, error: &Error, factor: f64) -> Box<Diagnostic> {
    let TableShape::Named { model, span, .. } = &scene.table.shape else {
        return Box::new(scene.source.diagnostic(scene.table.span, error.to_string()));
    };
    Box::new(match error {
        Error::Parameter { name, must, value } => {
            let entry = tables::find(model.name);
            let is_length =
                entry.is_some_and(|entry| entry.parameters.iter().any(|p| p.name == *name && p.kind.is_length()));
            let value = if is_length { value / factor } else { *value };
            scene.source.diagnostic(arguments.span(name), Error::Parameter { name, must, value }.to_string())
        }
        other => scene.source.diagnostic(*span, in_user_units(other, factor).to_string()),
    })
}

/// The values of a built-in table's parameters, as the geometry has them.
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
            _ => values.with(parameter.name, arguments.number(parameter.name)),
        };
    }
    values
}

/// Pieces of an explicit boundary, as they come.
struct Collected<'a> {
    scene: &'a Scene,
    factor: f64,
    pieces: Vec<Box<dyn Piece>>,
    spans: Vec<Span>,
    laws: Vec<Option<LawKind>>,
}

fn explicit(scene: &Scene, entries: &[Entry], factor: f64) -> Result<Drawn, Vec<Diagnostic>> {
    let mut all = Collected { scene, factor, pieces: vec![], spans: vec![], laws: vec![] };
    let mut wrong = vec![];
    for entry in entries {
        if let Err(diagnostic) = all.entry(entry) {
            wrong.push(*diagnostic);
        }
    }
    if !wrong.is_empty() {
        return Err(wrong);
    }
    let lattice = lattice(scene, factor)?;
    let Collected { pieces, spans, laws, .. } = all;
    let table = Table::periodic(pieces, lattice).map_err(|error| {
        let span = match &error {
            Error::Open { piece, .. } => spans.get(*piece).copied(),
            _ => None,
        };
        let what = in_user_units(&error, factor).to_string();
        vec![with_advice(scene.source.diagnostic(span.unwrap_or(scene.table.span), what), &error)]
    })?;
    Ok(Drawn { table, spans, laws, factor })
}

fn lattice(scene: &Scene, factor: f64) -> Result<Option<Lattice>, Vec<Diagnostic>> {
    let vectors: Vec<_> = scene.table.lattice.iter().map(|v| plane(&v.value) * factor).collect();
    let Some(first) = scene.table.lattice.first() else { return Ok(None) };
    Lattice::new(&vectors).map(Some).map_err(|error| vec![scene.source.diagnostic(first.span, error.to_string())])
}

fn plane(coordinates: &[f64]) -> Vector2<f64> {
    Vector2::new(coordinates[0], coordinates[1])
}

impl Collected<'_> {
    fn at(&self, point: &[f64]) -> Vector2<f64> {
        plane(point) * self.factor
    }

    fn push(&mut self, piece: Box<dyn Piece>, span: Span, law: Option<&scene::Law>) {
        self.pieces.push(piece);
        self.spans.push(span);
        self.laws.push(law.map(|law| law.kind.clone()));
    }

    #[allow(clippy::unnecessary_box_returns, reason = "it goes into a Result, where a large error costs every success")]
    fn wrong(&self, span: Span, error: &Error) -> Box<Diagnostic> {
        let diagnostic = self.scene.source.diagnostic(span, in_user_units(error, self.factor).to_string());
        Box::new(with_advice(diagnostic, error))
    }

    fn entry(&mut self, entry: &Entry) -> Result<(), Box<Diagnostic>> {
        let law = entry.law.as_ref();
        let inside = |domain: &Domain| *domain == Domain::Inside;
        let piece: Result<Box<dyn Piece>, Error> = match &entry.border {
            Border::Loop { from, edges, closed } => return self.edges(&from.value, edges, *closed, law),
            Border::Circle { center, radius, domain } => {
                Circle::new(self.at(&center.value), radius.value * self.factor, inside(domain))
                    .map(|c| Box::new(c) as _)
            }
            Border::Ellipse { center, semi_axes, angle, domain } => {
                let [a, b] = [0, 1].map(|i| semi_axes.value[i] * self.factor);
                Ellipse::new(self.at(&center.value), [a, b], angle.value, inside(domain)).map(|e| Box::new(e) as _)
            }
            Border::Line { through, direction } => {
                FullLine::new(self.at(&through.value), unit(&direction.value)).map(|l| Box::new(l) as _)
            }
            Border::Ray { from, direction, domain } => {
                Ray::new(self.at(&from.value), unit(&direction.value), *domain == Side::Left).map(|r| Box::new(r) as _)
            }
            Border::Curve { curve, formula, domain } => {
                let pieces = self.curve(curve, *domain == Domain::Inside);
                for piece in pieces.map_err(|error| self.wrong(formula.span, &error))? {
                    self.push(piece, entry.span, law);
                }
                return Ok(());
            }
            Border::Shape { shape: scene::Shape::Planar { placed, .. }, domain, .. } => {
                let side = if *domain == Domain::Inside { parry::Side::Inside } else { parry::Side::Outside };
                let pieces = placed.scaled(self.factor).pieces(side);
                for piece in pieces.map_err(|error| self.wrong(entry.span, &error))? {
                    self.push(piece, entry.span, law);
                }
                return Ok(());
            }
            Border::Outline { file } => {
                for piece in self.outline(file)? {
                    self.push(piece, file.span, law);
                }
                return Ok(());
            }
            // the scene's reader lets these stand in space only
            Border::Plane { .. } | Border::Shape { .. } => {
                return Err(Box::new(self.scene.source.diagnostic(entry.span, "this is no planar boundary")));
            }
        };
        let piece = piece.map_err(|error| self.wrong(entry.span, &error))?;
        self.push(piece, entry.span, law);
        Ok(())
    }

    fn curve(&self, curve: &Curve, inside: bool) -> Result<Vec<Box<dyn Piece>>, Error> {
        Ok(match curve {
            Curve::Polar { radius, center } => {
                let formula = Scaled { formula: PolarCurve::new(radius), factor: self.factor };
                Polar::new(self.at(&center.value), formula, inside)?.pieces()
            }
            Curve::Implicit { function, within } => {
                let formula = Scaled { formula: ImplicitCurve::new(function, within.value), factor: self.factor };
                vec![Box::new(Implicit::new(formula, inside)?)]
            }
        })
    }

    fn edges(
        &mut self,
        from: &[f64],
        edges: &[Edge],
        closed: bool,
        law: Option<&scene::Law>,
    ) -> Result<(), Box<Diagnostic>> {
        let start = self.at(from);
        let size = edges
            .iter()
            .flat_map(|edge| match &edge.path {
                EdgePath::Line { to } | EdgePath::Arc { to, .. } => self.at(&to.value).data.0[0],
            })
            .chain([start.x, start.y])
            .fold(0.0, |m: f64, x| m.max(x.abs()));
        let mut at = start;
        for (i, edge) in edges.iter().enumerate() {
            let (EdgePath::Line { to } | EdgePath::Arc { to, .. }) = &edge.path;
            let mut end = self.at(&to.value);
            let last = closed && i + 1 == edges.len();
            // a first vertex written as another formula, such as sin(pi/3) for sqrt(3)/2, is still the first vertex
            if last && (end - start).amax() <= 16.0 * f64::EPSILON * size {
                end = start;
            }
            if last && end != start {
                let gap = (end - start).norm() / self.factor;
                let what = format!("the loop is open: its last edge ends {} away from its first vertex", short(gap));
                return Err(Box::new(
                    self.scene.source.diagnostic(to.span, what).with_help("let the last edge end where \"from\" is"),
                ));
            }
            let piece: Result<Box<dyn Piece>, Error> = match &edge.path {
                EdgePath::Line { .. } => Segment::new(at, end).map(|segment| Box::new(segment) as _),
                EdgePath::Arc { center, turn, .. } => {
                    let inside = *turn == Turn::CounterClockwise;
                    Arc::new(self.at(&center.value), at, end, inside).map(|arc| Box::new(arc) as _)
                }
            };
            let piece = piece.map_err(|error| self.wrong(edge.span, &error))?;
            self.push(piece, edge.span, edge.law.as_ref().or(law));
            at = end;
        }
        Ok(())
    }

    /// Loops from a drawing or a map, beside the scene file.
    fn outline(&self, file: &Spanned<String>) -> Result<Vec<Box<dyn Piece>>, Box<Diagnostic>> {
        let complain = |what: String| Box::new(self.scene.source.diagnostic(file.span, what));
        let path = Path::new(self.scene.source.name()).with_file_name(&file.value);
        let text =
            std::fs::read_to_string(&path).map_err(|e| complain(format!("cannot read {}: {e}", path.display())))?;
        let extension = path.extension().map(std::ffi::OsStr::to_ascii_lowercase).unwrap_or_default();
        let pieces = match extension.to_str() {
            Some("svg") => import::svg(&text, import::TOLERANCE),
            Some("json" | "geojson") => import::geojson(&text),
            _ => return Err(complain("an outline is read from a file .svg, .json or .geojson".into())),
        };
        pieces.map_err(|error| complain(format!("{}: {error}", path.display())))
    }
}

/// A direction of a length near one.
fn unit(direction: &[f64]) -> Vector2<f64> {
    let factor = scale::to_unity(direction.iter().copied());
    plane(direction) * factor
}

/// A curve whose formula is in the user's units, all lengths multiplied by a power of two.
#[derive(Clone, Debug)]
struct Scaled<F> {
    formula: F,
    factor: f64,
}

impl<F: PolarFormula> PolarFormula for Scaled<F> {
    fn jet(&self, angle: f64) -> [f64; 3] {
        self.formula.jet(angle).map(|r| r * self.factor)
    }
    fn jet_over(&self, angle: Interval) -> [Interval; 3] {
        self.formula.jet_over(angle).map(|r| scaled(r, self.factor))
    }
}

impl<F: ImplicitFormula> ImplicitFormula for Scaled<F> {
    fn value(&self, point: [f64; 2]) -> f64 {
        self.formula.value(point.map(|x| x / self.factor))
    }
    fn gradient(&self, point: [f64; 2]) -> [f64; 2] {
        self.formula.gradient(point.map(|x| x / self.factor)).map(|g| g / self.factor)
    }
    fn hessian(&self, point: [f64; 2]) -> [f64; 3] {
        self.formula.hessian(point.map(|x| x / self.factor)).map(|h| h / self.factor / self.factor)
    }
    fn hessian_over(&self, region: [Interval; 2]) -> [Interval; 3] {
        let back = |x: Interval| scaled(x, 1.0 / self.factor);
        self.formula.hessian_over(region.map(back)).map(|h| back(back(h)))
    }
    fn gradient_over(&self, region: [Interval; 2]) -> [Interval; 2] {
        let back = |x: Interval| scaled(x, 1.0 / self.factor);
        self.formula.gradient_over(region.map(back)).map(back)
    }
    fn extent(&self) -> Extent {
        let Extent { min, max } = self.formula.extent();
        Extent { min: min * self.factor, max: max * self.factor }
    }
}

/// An interval times a power of two: exact.
fn scaled(of: Interval, factor: f64) -> Interval {
    Interval { low: of.low * factor, high: of.high * factor }
}
