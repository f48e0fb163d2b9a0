//! Errors of a boundary, in the user's words and units.

use billiards::geometry::{
    Error, ImplicitRule, MUST_HAVE_SQUARE, Meeting, MeetingKind, ParametricRule, Table, Vector2, meetings, tables,
};

use super::{Drawn, PieceSource};
use crate::document::{Diagnostic, spell};
use crate::scene::{Arguments, Border, Scene, TableShape};
use crate::simulation::words::point;

/// An error of a scene whose lengths were all multiplied by a factor, with lengths and names as in the user's file.
pub(crate) fn in_user_units(error: &Error, factor: f64) -> Error {
    let back = |x: f64| x / factor;
    let what = |must| if must == MUST_HAVE_SQUARE && factor != 1.0 { BESIDE_THE_LARGEST } else { must };
    match error.clone() {
        Error::Radius { radius } => Error::Radius { radius: back(radius) },
        Error::Length { name, must, value } => Error::Length { name, must: what(must), value: back(value) },
        Error::Unclosed { start, end } => Error::Unclosed { start: back(start), end: back(end) },
        Error::PolarJump { angle, before, after } => {
            Error::PolarJump { angle, before: back(before), after: back(after) }
        }
        Error::PolarRadius { angle, radius, certain } => Error::PolarRadius { angle, radius: back(radius), certain },
        Error::OffCircle { start, end } => Error::OffCircle { start: back(start), end: back(end) },
        Error::OffRadius { distance, radius } => Error::OffRadius { distance: back(distance), radius: back(radius) },
        Error::Open { piece, starts, gap } => Error::Open { piece, starts, gap: back(gap) },
        Error::Crossing { first, second, at } => Error::Crossing { first, second, at: at.map(back) },
        Error::Faces { first, second, at } => Error::Faces { first, second, at: at.map(back) },
        Error::Spike { piece, at } => Error::Spike { piece, at: at.map(back) },
        Error::Collapsed { piece, area } => Error::Collapsed { piece, area: back(back(area)) },
        Error::SelfCrossing { piece, at } => Error::SelfCrossing { piece, at: at.map(back) },
        Error::CrossedOutline { at } => Error::CrossedOutline { at: at.map(back) },
        Error::TouchingOutline { at } => Error::TouchingOutline { at: at.map(back) },
        Error::Bend { distance, at } => Error::Bend { distance: back(distance), at: at.map(back) },
        Error::RoughPiece { piece, at } => Error::RoughPiece { piece, at: at.map(back) },
        Error::Curve { must, at } => Error::Curve { must, at: at.map(back) },
        Error::TooShort { piece, length } => Error::TooShort { piece, length: back(length) },
        Error::Flat { piece, radius, size } => Error::Flat { piece, radius: back(radius), size: back(size) },
        Error::Small { piece, width, least } => Error::Small { piece, width: back(width), least: back(least) },
        Error::Thin { piece, width, least } => Error::Thin { piece, width: back(width), least: back(least) },
        Error::Field { field, must } => Error::Field { field: key(&field), must: what(must) },
        Error::SamePoint { field, other } => Error::SamePoint { field: key(&field), other: key(&other) },
        Error::NothingLeft { radius, largest } => Error::NothingLeft { radius: back(radius), largest: back(largest) },
        Error::Undecided { radius, at } => Error::Undecided { radius: back(radius), at: at.map(back) },
        other => other,
    }
}

/// [`MUST_HAVE_SQUARE`] where the largest length of the scene has been brought to between 1 and 2.
const BESIDE_THE_LARGEST: &str = "between 1e-150 and 1e150 times the largest length of the scene";

/// The path of keys in a scene to a field of a shape.
fn key(field: &str) -> String {
    let parts = field.split('.').filter(|part| *part != "shape");
    let keys = parts.map(|part| {
        let (name, number) = part.split_at(part.find('[').unwrap_or(part.len()));
        let name = match name {
            "a" => "from",
            "b" => "to",
            "vertices" => "points",
            "half_extents" | "scale" => "size",
            "border_radius" => "rounding",
            "compound" => "shapes",
            other => other,
        };
        format!("{name}{number}")
    });
    keys.collect::<Vec<_>>().join(".")
}

/// An error of the geometry, expressed as one about the scene, given where its pieces come from.
pub(super) fn about(scene: &Scene, sources: &[PieceSource], factor: f64, error: &Error) -> Diagnostic {
    let what = in_user_units(error, factor).to_string();
    let diagnostic = located(scene, sources, error, what);
    match turning(scene, sources, error) {
        Some(advice) => diagnostic.with_help(advice),
        None => with_advice(diagnostic, error, &scene.table.shape),
    }
}

/// Advice about a line or ray that has the table on the wrong side.
fn turning(scene: &Scene, sources: &[PieceSource], error: &Error) -> Option<&'static str> {
    let (Error::Orientation { piece }, TableShape::Boundary(entries)) = (error, &scene.table.shape) else {
        return None;
    };
    let span = sources.get(*piece)?.span;
    match entries.iter().find(|entry| entry.span == span)?.border {
        Border::Line { .. } => Some("reverse its `direction`: the table lies on the left of a line"),
        Border::Ray { .. } => Some(
            "exchange \"left\" and \"right\" in the `domain` of this ray and of the one at the other end of its wall, and turn what lies \
             between them",
        ),
        _ => None,
    }
}

/// An error of a table that has been drawn.
pub(super) fn of_table(scene: &Scene, drawn: &Drawn, error: &Error) -> Diagnostic {
    let Drawn { table, sources, factor, .. } = drawn;
    let spelled = |p: [f64; 2]| p.map(|x| spell(x / factor)).join(", ");
    match *error {
        Error::Crossing { first, second, at } if is_twice(table, [first, second], at) => {
            let what = format!("pieces {first} and {second} coincide near {}", point(&at.map(|x| x / factor), 0.0));
            // outlines of a drawing are turned the right way, whichever way they are drawn
            let is_from_file = [first, second].iter().all(|k| sources.get(*k).is_some_and(|s| s.place.is_some()));
            let help = if is_from_file {
                "the same wall is drawn twice: leave one out"
            } else {
                "the same wall is drawn twice: leave one out; or, if two loops share it, let the table lie on the other side of one of \
                 them: list its vertices in the opposite order, or exchange inside and outside"
            };
            located(scene, sources, error, what).with_help(help)
        }
        Error::TooShort { piece, .. } if sources.get(piece).is_some_and(|source| source.place.is_some()) => {
            let from = table.pieces()[piece].point_at(0.0);
            let what = format!("{}, near ({})", in_user_units(error, *factor), spelled(from.into()));
            with_advice(located(scene, sources, error, what), error, &scene.table.shape)
        }
        _ => about(scene, sources, *factor, error),
    }
}

/// Whether two pieces coincide, with the table on the same side, where they meet at a point.
fn is_twice(table: &Table, numbers: [usize; 2], at: [f64; 2]) -> bool {
    let [a, b] = numbers.map(|k| &*table.pieces()[k]);
    let is_there = |m: &Meeting| m.kind == MeetingKind::Overlap && [m.point.x, m.point.y] == at;
    numbers[0] != numbers[1] && meetings(a, b).iter().any(is_there)
}

/// A diagnostic at the place in the scene of the piece that the error is about; where pieces are from a file, their places in it are
/// added.
fn located(scene: &Scene, sources: &[PieceSource], error: &Error, what: String) -> Diagnostic {
    let first = match error {
        Error::Crossing { first, second, .. } | Error::Faces { first, second, .. } => {
            Some(*first).filter(|k| k != second)
        }
        _ => None,
    };
    let numbers: Vec<usize> = first.into_iter().chain(piece_of(error)).collect();
    let place = |k: &usize| Some(format!("piece {k} is from {}", sources.get(*k)?.place.as_ref()?));
    let places: Vec<String> = numbers.iter().filter_map(place).collect();
    let what = if places.is_empty() { what } else { format!("{what}; {}", places.join(", ")) };
    let span = piece_of(error).and_then(|piece| sources.get(piece)).map_or(scene.table.span, |source| source.span);
    scene.source.diagnostic(span, what)
}

/// The piece that an error is about.
fn piece_of(error: &Error) -> Option<usize> {
    match error {
        Error::Open { piece, .. }
        | Error::Orientation { piece }
        | Error::OneSided { piece }
        | Error::Spike { piece, .. }
        | Error::Collapsed { piece, .. }
        | Error::TooShort { piece, .. }
        | Error::Flat { piece, .. }
        | Error::Small { piece, .. }
        | Error::Thin { piece, .. }
        | Error::ManyCells { piece, .. }
        | Error::FarFromCell { piece, .. }
        | Error::InfiniteOnLattice { piece }
        | Error::SelfCrossing { piece, .. } => Some(*piece),
        Error::Crossing { second, .. } | Error::Faces { second, .. } => Some(*second),
        _ => None,
    }
}

/// Adds advice on how to fix an error of the geometry, where the message does not say so.
pub(crate) fn with_advice(diagnostic: Diagnostic, error: &Error, shape: &TableShape) -> Diagnostic {
    let advice = match shape {
        TableShape::Named { .. } => about_parameters(error),
        TableShape::Boundary(_) => about_pieces(error),
    };
    match advice {
        Some(advice) => diagnostic.with_help(advice),
        None => diagnostic,
    }
}

/// Advice where the scene lists the pieces.
fn about_pieces(error: &Error) -> Option<&'static str> {
    Some(match error {
        Error::ZeroLength => "leave it out, or move one of its ends",
        Error::TooShort { .. } => "leave it out, make it longer, or move it nearer to the origin",
        Error::Small { .. } => "make it larger, or leave it out",
        Error::Flat { .. } => "put a straight piece there (line_to), or move the center nearer",
        Error::Thin { .. } => {
            "make it less flat, or move it nearer to the origin; a wall without thickness is a shape = { name = \"segment\", from = ..., to \
             = ... }"
        }
        Error::ManyCells { .. } => "make the piece smaller, or the vectors longer and less nearly parallel",
        Error::FarFromCell { .. } => "write the copy of it that lies next to the origin: all copies are equivalent",
        Error::OffCircle { .. } => "put the center on the perpendicular bisector of the two ends",
        Error::Crossing { first, second, .. } if first == second => {
            "it crosses its own translate in the next cell of the lattice: make it smaller, or the cell larger"
        }
        Error::Crossing { .. } => "pieces may touch but not cross: move one of them, or make one loop of both",
        Error::SelfCrossing { .. } => "a piece of wall is a simple curve: change its formula or split the loop there",
        Error::CrossedOutline { .. } => "list its corners in order around it: sides may touch but not cross",
        Error::TouchingOutline { .. } => "write it as a loop, in which parts may touch, or move the vertex a little",
        Error::Unclosed { .. } => "a formula of period 2π closes: cos(t) or sin(3*t), not cos(t/2) or t alone",
        Error::PolarRadius { .. } => {
            "put its center where the whole curve can be seen from; a curve may pass through its center only in a cusp, as \
             1 + cos(t) does, or between petals, as abs(cos(2*t)) does"
        }
        Error::Winding => "take fewer waves, as in cos(500*t) instead of cos(50000*t)",
        Error::PolarJump { .. } => {
            "take a formula without jumps: atan(tan(t)), atan2 and quotients whose divisor becomes 0 have some"
        }
        Error::Inverted => "change the sign of the formula, whichever side of the curve the table is on",
        Error::Open { .. } => {
            "close the loop, or continue it to infinity with a ray; a straight wall without ends is a line"
        }
        Error::OneSided { .. } => {
            "add the other side of the wall, a chain that leads back; or give one lattice vector only, so that the table is unbounded there"
        }
        Error::Faces { .. } => {
            "cut both sides at the same places and describe them alike, by the same formula or as the same line or arc; or draw them farther apart"
        }
        Error::Spike { .. } => {
            "leave the stretch out, or let it lead into the table, where it is a wall without thickness; two entries may share it, but a \
             curve given by a formula is not cut: let the stretch be an edge of its own in both"
        }
        Error::Collapsed { .. } => {
            "move its vertices apart; a wall without thickness in the open plane is a \
             shape = { name = \"polyline\", points = ... }"
        }
        Error::NoCurve { .. } => "`within` must contain the curve; if it does, draw that box closer around it",
        Error::Curve { must: ImplicitRule::InItsBox, .. } => "make the box `within` larger: the whole curve lies in it",
        Error::Curve { must: ImplicitRule::Alone, .. } => "draw the box `within` closer around one of them",
        Error::Curve { .. } => "an implicit formula has no kinks; a formula of t may have them, written with abs",
        Error::Parametrised { must: ParametricRule::Closed, .. } => {
            "let \"over\" run once around the curve; without it, t runs from 0 to 2*pi"
        }
        Error::Parametrised { must: ParametricRule::Moving, .. } => {
            "take a parameter that does not stand still on the way, as t instead of t^3"
        }
        Error::Parametrised { must: ParametricRule::FiniteRate, .. } => {
            "where it is vertical, let both x and y depend on t, as cos(t) and sin(t) do for y = sqrt(1-x^2), or \
             t^2 and t for y = sqrt(x)"
        }
        Error::Parametrised { .. } => {
            "write kinks with abs, as in abs(cos(t)) for sqrt(1-sin(t)^2), 2000 of them at most, and keep the curvature bounded"
        }
        Error::RoughPiece { .. } => {
            "take radius = 0: no disk is followed here around cusps or where the curvature is unbounded, as for powers of \
             abs(...) below 2; only where an implicit formula has a kink is there another way, a formula of t with abs"
        }
        Error::Bend { .. } => "take another radius, or a formula with bounded curvature",
        Error::PolarKink { .. } => {
            "write kinks with abs, as in abs(cos(t)) for sqrt(1-sin(t)^2), 2000 of them at most, and let the curve be \
             smooth otherwise"
        }
        Error::PolarSlope { .. } => "write kinks with abs, as in abs(sin(t)) for sqrt(1-cos(t)^2)",
        Error::Orientation { .. } => {
            "list the vertices in the opposite order, or exchange inside and outside; in the open plane an obstacle is a shape or a \
             loop = { domain = \"outside\", from = ..., edges = ... }"
        }
        _ => return None,
    })
}

/// Advice where the pieces follow from the parameters of a built-in table.
fn about_parameters(error: &Error) -> Option<&'static str> {
    Some(match error {
        Error::TooShort { .. } => {
            "change the parameters of the table so that this piece is longer, or take a table without it"
        }
        Error::Small { .. } => "change the parameters of the table so that this piece is larger",
        Error::Flat { .. } => "change the parameters of the table so that this arc is less flat",
        Error::Collapsed { .. } => "change the parameters of the table so that it is wider",
        Error::Thin { .. } | Error::Faces { .. } => "change the parameters of the table so that it is less thin",
        Error::Crossing { .. } | Error::SelfCrossing { .. } => {
            "change the parameters of the table so that no piece crosses another or itself"
        }
        _ => return None,
    })
}

/// What is wrong with the parameters of a built-in table, at the parameter's place.
#[allow(clippy::unnecessary_box_returns, reason = "it goes into a Result, where a large error costs every success")]
pub(crate) fn wrong_argument(scene: &Scene, arguments: &Arguments, error: &Error, factor: f64) -> Box<Diagnostic> {
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
        Error::Orientation { .. } if !arguments.points("vertices").is_empty() => {
            let vertex = |i: usize| arguments.points("vertices").get(i).map(|p| Vector2::new(p.value[0], p.value[1]));
            let turned = [0, 2, 1].map(|i| vertex(i).unwrap_or_default());
            let (what, help) = if tables::triangle(turned).is_ok() {
                ("the vertices run clockwise", "list them counter-clockwise: exchange two of them")
            } else {
                ("the vertices lie on one line", "move one of them off it")
            };
            scene.source.diagnostic(arguments.span("vertices"), what).with_help(help)
        }
        Error::Form { name, .. } | Error::Count { name, .. } => {
            scene.source.diagnostic(arguments.span(name), error.to_string())
        }
        other => scene.source.diagnostic(*span, in_user_units(other, factor).to_string()),
    })
}
