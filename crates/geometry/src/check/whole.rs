//! What a piece tells of itself as a whole: its ends, its extent, its length and area, and its graphs.
use super::{PieceReport, stretch};
use crate::{piece::Piece, plane::is_finite};
use nalgebra::Vector2;

/// Sides of the polygon of points at equal arc lengths; the errors of its length and area fall with the square of this number.
const SIDES: u32 = 2048;

/// Points of a graph that are compared with the piece.
const POINTS: u32 = 8;

/// Extent, ends, length and area.
pub(super) fn whole(piece: &dyn Piece, size: f64, report: &mut PieceReport) {
    let [from, to] = stretch(piece, size);
    let at = |k: u32| piece.point_at(from + (to - from) * (f64::from(k) / f64::from(SIDES)));
    let points: Vec<Vector2<f64>> = (0..=SIDES).map(at).collect();
    let (first, last) = (points[0], points[points.len() - 1]);
    let extent = piece.extent();
    for point in &points {
        PieceReport::note(&mut report.extent, extent.distance(point) / size);
    }
    match piece.ends() {
        Some([start, end]) => {
            for (told, point) in [(start, first), (end, last)].into_iter().filter(|(told, _)| is_finite(told)) {
                PieceReport::note(&mut report.ends, (told - point).norm() / size);
            }
        }
        None => PieceReport::note(&mut report.ends, (last - first).norm() / size),
    }
    if piece.length() == f64::INFINITY {
        PieceReport::note(&mut report.area, if piece.area().is_nan() { 0.0 } else { f64::INFINITY });
        return;
    }
    let [(coarse_length, coarse_area), (length, area)] = [2, 1].map(|step| polygon(&points, step));
    // the error falls to a quarter with twice as many sides
    let limit = |coarse: f64, fine: f64| fine + (fine - coarse) / 3.0;
    PieceReport::note(&mut report.length, (piece.length() - limit(coarse_length, length)).abs() / size);
    PieceReport::note(&mut report.area, (piece.area() - limit(coarse_area, area)).abs() / (size * size));
}

/// The length of a chain of points, of which every `step`-th is taken, and the area between it and its chord.
fn polygon(points: &[Vector2<f64>], step: usize) -> (f64, f64) {
    let chain: Vec<_> = points.iter().step_by(step).map(|point| point - points[0]).collect();
    let sides = || chain.iter().zip(&chain[1..]);
    (sides().map(|(a, b)| (b - a).norm()).sum(), sides().map(|(a, b)| 0.5 * a.perp(b)).sum())
}

/// The graphs: where they begin and end, their points and their normals.
pub(super) fn graphs(piece: &dyn Piece, size: f64, report: &mut PieceReport) {
    let Some(graphs) = piece.graphs() else { return };
    let Some(first) = graphs.first() else {
        PieceReport::note(&mut report.graphs, f64::INFINITY);
        return;
    };
    let of_graphs = graphs.iter().map(|graph| graph.ends.map(Vector2::from));
    let [start, end] = piece.ends().unwrap_or_else(|| [first.ends[0].into(); 2]);
    let mut before = start;
    for [from, to] in of_graphs {
        PieceReport::note(&mut report.graphs, (from - before).norm() / size);
        before = to;
    }
    PieceReport::note(&mut report.graphs, (end - before).norm() / size);
    for graph in &graphs {
        for k in 0..POINTS {
            let place = (2.0 * f64::from(k) + 1.0) / f64::from(POINTS) - 1.0;
            let on_graph = graph.at(place);
            let on_piece = piece.closest(&on_graph.point);
            PieceReport::note(&mut report.graphs, (on_graph.point - on_piece.point).norm() / size);
            PieceReport::note(&mut report.graph_normals, (on_graph.normal - on_piece.normal).norm());
        }
    }
}
