//! The pieces of an explicit boundary.

use core::f64::consts::TAU;

use billiards::geometry::shapes::curve::{self, Implicit, Polar, PolarPoints};
use billiards::geometry::shapes::{Arc, Circle, Ellipse, FullLine, Ray, Segment};
use billiards::geometry::{Error, Extent, Lattice, Piece, Table, Vector2, enclosed_area, import, parry};

use super::complaint::{about, in_user_units, with_advice};
use super::scaled::Scaled;
use super::{Drawn, PieceSource};
use crate::document::{Diagnostic, Span};
use crate::expression::{Expression, ImplicitCurve, ParametricCurve, PolarCurve};
use crate::scene::{self, Border, Curve, Domain, Edge, EdgePath, Entry, LawKind, Scene, Side, Turn};
use crate::simulation::drawing::{self, Reader};
use crate::simulation::scale;
use crate::simulation::words::short;

/// A drawing or a map.
pub(super) struct Outline {
    /// Where the scene names its file.
    span: Span,
    drawing: import::Drawing,
}

impl Outline {
    /// Its greatest length, in the scene's unit.
    pub(super) fn size(&self) -> f64 {
        self.drawing.size()
    }
}

/// The outline of an entry, or why it cannot be read; `None` if it is none.
type Read = Option<Result<Outline, Box<Diagnostic>>>;

/// The outlines of entries, read from their files.
pub(super) fn outlines(scene: &Scene, entries: &[Entry]) -> Vec<Read> {
    let kinds = "an outline is read from a .svg, .json or .geojson file";
    let svg: Reader<import::Drawing> = |bytes| import::svg(&String::from_utf8_lossy(bytes), import::TOLERANCE);
    let geojson: Reader<import::Drawing> = |bytes| import::geojson(&String::from_utf8_lossy(bytes));
    let readers = [("svg", svg), ("json", geojson), ("geojson", geojson)];
    let outline = |entry: &Entry| {
        let Border::Outline { file } = &entry.border else { return None };
        let read = drawing::read(scene, file, kinds, &readers);
        Some(read.map(|drawing| Outline { span: file.span, drawing }))
    };
    entries.iter().map(outline).collect()
}

/// The pieces of an explicit boundary, collected in order.
struct Collected<'a> {
    scene: &'a Scene,
    factor: f64,
    pieces: Vec<Box<dyn Piece>>,
    sources: Vec<PieceSource>,
    laws: Vec<Option<LawKind>>,
}

/// The table of entries and their outlines, all lengths multiplied by a factor.
pub(super) fn explicit(
    scene: &Scene,
    entries: &[Entry],
    outlines: Vec<Read>,
    factor: f64,
) -> Result<Drawn, Vec<Diagnostic>> {
    let mut all = Collected { scene, factor, pieces: vec![], sources: vec![], laws: vec![] };
    let mut wrong = vec![];
    // two-sided walls aside, which enclose nothing
    let mut others = vec![];
    for (entry, outline) in entries.iter().zip(outlines) {
        let first = all.pieces.len();
        let entered = match outline {
            Some(read) => read.and_then(|outline| all.outline(&outline, entry.law.as_ref())),
            None => all.entry(entry),
        };
        match entered {
            Ok(()) if matches!(entry.border, Border::Loop { closed: true, .. }) && all.area_of_loop(first) == 0.0 => {}
            Ok(()) => others.push(entry),
            Err(diagnostic) => wrong.push(*diagnostic),
        }
    }
    if !wrong.is_empty() {
        return Err(wrong);
    }
    let lattice = lattice(scene, factor)?;
    let Collected { pieces, sources, laws, .. } = all;
    let unbounded = !others.is_empty() && others.iter().all(|entry| entry.border.is_obstacle());
    let table = Table::periodic(pieces, lattice).map_err(|error| vec![about(scene, &sources, factor, &error)])?;
    let table = if unbounded { table.unbounded() } else { table };
    Ok(Drawn { table, sources, laws, factor })
}

fn lattice(scene: &Scene, factor: f64) -> Result<Option<Lattice>, Vec<Diagnostic>> {
    let vectors: Vec<_> = scene.table.lattice.iter().map(|v| plane(&v.value) * factor).collect();
    let Some(first) = scene.table.lattice.first() else { return Ok(None) };
    let wrong = |error| vec![scene.source.diagnostic(first.span, in_user_units(&error, factor).to_string())];
    Lattice::new(&vectors).map(Some).map_err(wrong)
}

fn plane(coordinates: &[f64]) -> Vector2<f64> {
    Vector2::new(coordinates[0], coordinates[1])
}

impl Collected<'_> {
    fn at(&self, point: &[f64]) -> Vector2<f64> {
        plane(point) * self.factor
    }

    fn push(&mut self, piece: Box<dyn Piece>, span: Span, law: Option<&scene::Law>) {
        self.push_from(piece, PieceSource { span, place: None }, law);
    }

    fn push_from(&mut self, piece: Box<dyn Piece>, source: PieceSource, law: Option<&scene::Law>) {
        self.pieces.push(piece);
        self.sources.push(source);
        self.laws.push(law.map(|law| law.kind.clone()));
    }

    #[allow(clippy::unnecessary_box_returns, reason = "it goes into a Result, where a large error costs every success")]
    fn wrong(&self, span: Span, error: &Error) -> Box<Diagnostic> {
        let diagnostic = self.scene.source.diagnostic(span, in_user_units(error, self.factor).to_string());
        Box::new(with_advice(diagnostic, error, &self.scene.table.shape))
    }

    fn entry(&mut self, entry: &Entry) -> Result<(), Box<Diagnostic>> {
        let law = entry.law.as_ref();
        let inside = |domain: &Domain| *domain == Domain::Inside;
        let piece: Result<Box<dyn Piece>, Error> = match &entry.border {
            Border::Loop { from, edges, closed, domain } => {
                let first = self.pieces.len();
                self.edges(&from.value, edges, *closed, law)?;
                return domain.map_or(Ok(()), |domain| self.runs_around(first, domain, entry.span));
            }
            Border::Circle { center, radius, domain } => {
                Circle::new(self.at(&center.value), radius.value * self.factor, inside(domain))
                    .map(|c| Box::new(c) as _)
            }
            Border::Ellipse { center, semi_axes, angle, domain } => {
                let [a, b] = [0, 1].map(|i| semi_axes.value[i] * self.factor);
                Ellipse::new(self.at(&center.value), [a, b], angle.value, inside(domain)).map(|e| Box::new(e) as _)
            }
            Border::Line { through, direction } => {
                let (through, direction) = (self.at(&through.value), unit(&direction.value));
                match self.once_around(&direction) {
                    Some(along) => Segment::new(through, through + along).map(|s| Box::new(s) as _),
                    None => FullLine::new(through, direction).map(|l| Box::new(l) as _),
                }
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
            // outlines are read before, and the scene's reader accepts the others only in space
            Border::Outline { .. } | Border::Plane { .. } | Border::Shape { .. } | Border::Mesh { .. } => {
                return Err(Box::new(self.scene.source.diagnostic(entry.span, "this is no planar boundary")));
            }
        };
        let piece = piece.map_err(|error| self.wrong(entry.span, &error))?;
        self.push(piece, entry.span, law);
        Ok(())
    }

    /// The segment that replaces a line of this direction where the plane is identified along it: the single vector of
    /// the lattice.
    fn once_around(&self, direction: &Vector2<f64>) -> Option<Vector2<f64>> {
        let [vector] = &self.scene.table.lattice[..] else { return None };
        let vector = plane(&vector.value) * self.factor;
        let is_along = direction.perp(&vector).abs() <= 4.0 * f64::EPSILON * direction.norm() * vector.norm();
        is_along.then(|| vector * direction.dot(&vector).signum())
    }

    fn curve(&self, curve: &Curve, inside: bool) -> Result<Vec<Box<dyn Piece>>, Error> {
        Ok(match curve {
            Curve::Polar { radius, center } => {
                let formula = Scaled { formula: PolarCurve::new(radius), factor: self.factor };
                let center = self.at(&center.value);
                match Polar::new(center, formula.clone(), inside) {
                    // the radius reaches 0, as for a cardioid, but is not negative anywhere
                    Err(error @ Error::PolarRadius { certain: false, .. }) => {
                        let points = PolarPoints { center, formula };
                        boxed(curve::ParametricCurve::around(points, [0.0, TAU], inside).map_err(|_| error)?)
                    }
                    found => found?.pieces(),
                }
            }
            Curve::Parametric { point, over } => {
                boxed(curve::ParametricCurve::around(self.points(point), over.value, inside)?)
            }
            Curve::Implicit { function, within } => {
                let formula = Scaled { formula: ImplicitCurve::new(function, within.value), factor: self.factor };
                vec![Box::new(Implicit::new(formula, inside)?)]
            }
        })
    }

    fn points(&self, [x, y]: &[Expression; 2]) -> Scaled<ParametricCurve> {
        Scaled { formula: ParametricCurve::new([x, y]), factor: self.factor }
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
            .flat_map(|edge| self.at(&edge.path.end().value).data.0[0])
            .chain([start.x, start.y])
            .fold(0.0, |m: f64, x| m.max(x.abs()));
        let rounding = 16.0 * f64::EPSILON * size;
        let mut at = start;
        for (i, edge) in edges.iter().enumerate() {
            let to = edge.path.end();
            let mut end = self.at(&to.value);
            let last = closed && i + 1 == edges.len();
            // a first vertex written as another formula, such as sin(pi/3) for sqrt(3)/2, is still the first vertex
            if last && (end - start).amax() <= rounding {
                end = start;
            }
            if last && end != start {
                let gap = (end - start).norm() / self.factor;
                let what = format!("the loop is open: its last edge ends {} away from its first vertex", short(gap));
                return Err(Box::new(
                    self.scene.source.diagnostic(to.span, what).with_help("let the last edge end at \"from\""),
                ));
            }
            let pieces: Result<Vec<Box<dyn Piece>>, Error> = match &edge.path {
                EdgePath::Line { .. } => Segment::new(at, end).map(|segment| vec![Box::new(segment) as _]),
                EdgePath::Arc { center, turn, .. } => {
                    let inside = *turn == Turn::CounterClockwise;
                    Arc::new(self.at(&center.value), at, end, inside).map(|arc| vec![Box::new(arc) as _])
                }
                EdgePath::Curve { from, point, over, .. } => {
                    let gap = (self.at(from) - at).norm();
                    if gap > rounding {
                        let what = format!("the curve starts {} away from where it should", short(gap / self.factor));
                        let help = "let it start at the vertex where the edge before it ends";
                        return Err(Box::new(self.scene.source.diagnostic(to.span, what).with_help(help)));
                    }
                    curve::ParametricCurve::along(self.points(point), *over, [at, end]).map(boxed)
                }
            };
            for piece in pieces.map_err(|error| self.wrong(edge.span, &error))? {
                self.push(piece, edge.span, edge.law.as_ref().or(law));
            }
            at = end;
        }
        Ok(())
    }

    /// The area inside the loop of the pieces from this one on, negative where it runs clockwise. A two-sided wall has neither inside nor
    /// outside: its area, 0 up to rounding, is 0.
    fn area_of_loop(&self, first: usize) -> f64 {
        let pieces = || self.pieces[first..].iter().map(|piece| &**piece);
        let area = enclosed_area(pieces());
        let around = pieces().map(Piece::extent).fold(Extent::EMPTY, Extent::union);
        let rounding = 16.0 * f64::EPSILON * (around.max - around.min).norm_squared();
        if area.abs() <= rounding { 0.0 } else { area }
    }

    /// Fails where the loop of the pieces from this one on has the domain on the other side than the scene says.
    fn runs_around(&self, first: usize, domain: Domain, span: Span) -> Result<(), Box<Diagnostic>> {
        let area = self.area_of_loop(first);
        let (way, other) = match domain {
            Domain::Inside if area < 0.0 => ("clockwise, so that the domain is outside", "inside"),
            Domain::Outside if area > 0.0 => ("counter-clockwise, so that the domain is inside", "outside"),
            _ => return Ok(()),
        };
        let what = format!("the loop runs {way}, and not {other}");
        Err(Box::new(self.scene.source.diagnostic(span, what).with_help("list its vertices in the opposite order")))
    }

    /// Loops from a drawing or a map.
    fn outline(&mut self, outline: &Outline, law: Option<&scene::Law>) -> Result<(), Box<Diagnostic>> {
        let Outline { span, drawing } = outline;
        let import::Imported { walls, places } =
            drawing.pieces(self.factor).map_err(|error| self.wrong(*span, &error))?;
        for (piece, place) in walls.into_iter().zip(places) {
            self.push_from(piece, PieceSource { span: *span, place: Some(place) }, law);
        }
        Ok(())
    }
}

fn boxed<P: Piece + 'static>(pieces: Vec<P>) -> Vec<Box<dyn Piece>> {
    pieces.into_iter().map(|piece| Box::new(piece) as _).collect()
}

/// A direction of a length near one.
fn unit(direction: &[f64]) -> Vector2<f64> {
    let factor = scale::to_unity(direction.iter().copied());
    plane(direction) * factor
}
