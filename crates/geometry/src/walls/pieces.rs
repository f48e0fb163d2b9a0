//! Pieces of any kind: those that answer in lanes beside those that do not.
use super::{
    Few, Graphs, Junctions, List, WallHit, Walls,
    posts::{Post, posts},
};
use crate::{
    Piece,
    shapes::{Shape, curve::Graph},
};
use lanes::{Lane, MOST_LANES};
use nalgebra::Vector2;
use std::sync::Arc;

/// A list of pieces, each tested in the best way.
#[derive(Clone, Debug)]
pub struct Pieces {
    /// The pieces that answer in lanes.
    few: Few,
    /// Smooth curves, if any.
    graphs: Option<Graphs>,
    /// The others, if any; or all but the smooth curves, where they are many.
    list: Option<List>,
    /// Whether the list also holds the pieces that answer in lanes.
    all: bool,
    /// Where two-sided walls end, and where round ones touch, if there are any.
    junctions: Option<Arc<Junctions>>,
}

impl Pieces {
    /// The pieces with their numbers, and the corners of the boundary. A point where circles or ellipses with the table outside touch
    /// is a corner, too.
    pub fn new(mut pieces: Vec<(usize, Arc<dyn Piece>)>, corners: &[Vector2<f64>]) -> Pieces {
        let mut junctions = Junctions::of(&pieces);
        let posts = posts(&pieces);
        if !posts.is_empty() {
            junctions = Some(junctions.unwrap_or_default().with(posts.iter().map(|post| (post.place, post.reach()))));
            pieces.extend(posts.iter().flat_map(Post::faces));
        }
        let junctions = junctions.map(Arc::new);
        let mut graphs: Vec<(usize, Graph)> = vec![];
        let others = pieces.into_iter().filter(|(number, piece)| {
            let cut = if piece.shape().is_some() { None } else { piece.graphs() };
            graphs.extend(cut.iter().flatten().map(|graph| (*number, *graph)));
            cut.is_none()
        });
        let mut others: Vec<_> = others.collect();
        let all = others.len() >= List::MANY;
        let in_lanes = others.len() < Few::PER_LANE * MOST_LANES;
        let known = others.iter().filter_map(|(number, piece)| Some((*number, piece.shape()?)));
        let mut shapes: Vec<(usize, Shape)> = if in_lanes { known.collect() } else { vec![] };
        if all && shapes.len() < others.len() {
            shapes.clear();
        }
        if !all {
            others.retain(|(_, piece)| piece.shape().is_none());
        }
        Pieces {
            few: Few::new(&shapes, corners),
            graphs: (!graphs.is_empty()).then(|| Graphs::new(&graphs, corners)),
            list: (!others.is_empty()).then(|| List::new(others, corners)),
            all,
            junctions,
        }
    }
}

impl Walls<2> for Pieces {
    fn rounds_normals(&self) -> bool {
        self.list.is_some() || self.graphs.is_some() || self.few.rounds_normals()
    }

    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; 2], v: &[F; 2]) -> WallHit<F, 2> {
        let few = self.few.len();
        let known = 0 < few && (!self.all || self.list.is_none() || few < Few::PER_LANE * F::LANES);
        let mut first = WallHit::never(*x);
        if known {
            first = self.few.first_hit(x, v);
        }
        if let Some(graphs) = &self.graphs {
            let other = graphs.first_hit(x, v);
            first = first.or(other.time.lt(first.time), &other);
        }
        if let Some(list) = self.list.as_ref().filter(|_| !(self.all && known)) {
            let other = list.first_hit(x, v);
            first = first.or(other.time.lt(first.time), &other);
        }
        if let Some(junctions) = &self.junctions {
            // passed by value: references would keep position and hit in memory even where there are no junctions
            first.corner = first.corner | junctions.near(*x, first.point);
        }
        first
    }
}
