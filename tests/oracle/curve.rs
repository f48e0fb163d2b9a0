//! Where a path crosses a boundary, found in another way than the library's and in 200 bits.
//!
//! A piece is a parametrised curve `γ(u)` here, never an equation. The path's line meets it where `h(u) = v × (γ(u) − x)`
//! changes its sign. Between two points where the tangent is parallel to the path `h` is monotone; so the parameter is cut
//! there, each part has at most one root, and a bracket that is never left closes in on it.
use super::number::{
    Big, Vector, add, big, cross, direction, dot, is_positive, left, norm, scale, sign_change, small, sub, vector,
};
use billiards::geometry::{Figure, Piece, Vector2};

/// A place where the path's line crosses a piece from the table's side.
#[derive(Clone, Debug)]
pub(crate) struct Crossing {
    /// When \[T\]; negative behind the start.
    pub(crate) time: Big,
    /// Where.
    pub(crate) point: Vector,
    /// Unit normal there, into the table.
    pub(crate) normal: Vector,
}

/// How the line of a path meets a piece.
#[derive(Clone, Debug, Default)]
pub(crate) struct Meeting {
    /// Where it crosses outwards.
    pub(crate) crossings: Vec<Crossing>,
    /// When it crosses inwards.
    pub(crate) inward: Vec<f64>,
    /// Where the curve is parallel to the line: the distance between them \[L\].
    pub(crate) touches: Vec<f64>,
}

/// A piece of boundary that knows the truth.
pub(crate) trait Truth {
    /// How the line of the path meets it.
    fn meet(&self, x: &Vector, v: &Vector) -> Meeting;
    /// Its vertices.
    fn vertices(&self) -> Vec<Vector>;
}

/// A parametrised curve.
pub(crate) trait Curve {
    /// In how many parts it comes, each for `u` from −1 to 1.
    fn parts(&self) -> usize;
    /// The point, and a tangent with the table on its left.
    fn at(&self, part: usize, u: &Big) -> [Vector; 2];
    /// Into how many steps a part is cut, so that the tangent turns by less than half a turn, and back at most once, in each.
    fn steps(&self) -> u32 {
        2
    }
    /// Its vertices, if it is not closed.
    fn vertices(&self) -> Vec<Vector> {
        vec![]
    }
    /// Whether a point of the curve belongs to the piece.
    fn holds(&self, _: &Vector) -> bool {
        true
    }
}

/// A curve, and its points at the cuts.
pub(crate) struct Cut<C> {
    curve: C,
    /// Per part: parameter, point and tangent.
    nodes: Vec<Vec<(Big, [Vector; 2])>>,
}

impl<C: Curve> Cut<C> {
    pub(crate) fn new(curve: C) -> Cut<C> {
        let steps = f64::from(curve.steps());
        let step = big(libm::ldexp(1.0, -60));
        let nodes = |part| {
            // which way the tangent turns
            let turning = |u: &Big| cross(&curve.at(part, u)[1], &curve.at(part, &(u + &step))[1]);
            let mut cuts = vec![big(-1.0)];
            for k in 1..=curve.steps() {
                let (from, to) = (cuts[cuts.len() - 1].clone(), big(f64::from(2 * k) / steps - 1.0));
                let turns = [turning(&from), turning(&to)];
                if is_positive(&turns[0]) != is_positive(&turns[1]) {
                    cuts.push(sign_change(turning, [from, to.clone()], turns));
                }
                cuts.push(to);
            }
            cuts.into_iter().map(|u| (u.clone(), curve.at(part, &u))).collect()
        };
        Cut { nodes: (0..curve.parts()).map(nodes).collect(), curve }
    }
}

impl<C: Curve> Truth for Cut<C> {
    fn meet(&self, x: &Vector, v: &Vector) -> Meeting {
        let mut meeting = Meeting::default();
        let (square, speed) = (dot(v, v), norm(v));
        for (part, nodes) in self.nodes.iter().enumerate() {
            let height_of = |point: &Vector| cross(v, &sub(point, x));
            let height = |u: &Big| height_of(&self.curve.at(part, u)[0]);
            let slope = |u: &Big| cross(v, &self.curve.at(part, u)[1]);
            let mut root = |from: &(Big, Big), to: &(Big, Big)| {
                if is_positive(&from.1) == is_positive(&to.1) {
                    return;
                }
                let u = sign_change(height, [from.0.clone(), to.0.clone()], [from.1.clone(), to.1.clone()]);
                let [point, tangent] = self.curve.at(part, &u);
                if !self.curve.holds(&point) {
                    return;
                }
                let time = dot(v, &sub(&point, x)) / &square;
                if is_positive(&cross(v, &tangent)) {
                    let normal = scale(&left(&tangent), &(big(1.0) / norm(&tangent)));
                    meeting.crossings.push(Crossing { time, point, normal });
                } else {
                    meeting.inward.push(small(&time));
                }
            };
            let with_height = |node: &(Big, [Vector; 2])| (node.0.clone(), height_of(&node.1[0]));
            for pair in nodes.windows(2) {
                let [from, to] = [&pair[0], &pair[1]];
                let slopes = [from, to].map(|node| cross(v, &node.1[1]));
                if is_positive(&slopes[0]) == is_positive(&slopes[1]) {
                    root(&with_height(from), &with_height(to));
                } else {
                    let u = sign_change(slope, [from.0.clone(), to.0.clone()], slopes);
                    let point = &self.curve.at(part, &u)[0];
                    let top = (u, height_of(point));
                    root(&with_height(from), &top);
                    root(&top, &with_height(to));
                    meeting.touches.push(small(&(top.1 / &speed)));
                }
            }
        }
        meeting
    }
    fn vertices(&self) -> Vec<Vector> {
        self.curve.vertices()
    }
}

/// The straight line `a + u along`, table on its left, or what of it lies between two `u`.
#[derive(Clone, Debug)]
pub(crate) struct Straight {
    a: Vector,
    along: Vector,
    begin: Option<f64>,
    end: Option<f64>,
}

impl Straight {
    pub(super) fn segment(a: [f64; 2], b: [f64; 2]) -> Straight {
        let a = vector(a);
        Straight { along: sub(&vector(b), &a), a, begin: Some(0.0), end: Some(1.0) }
    }
}

impl Truth for Straight {
    fn meet(&self, x: &Vector, v: &Vector) -> Meeting {
        let mut meeting = Meeting::default();
        let rate = cross(v, &self.along);
        if rate == Big::ZERO {
            return meeting;
        }
        // v × (a + u along − x) = 0
        let u = cross(v, &sub(x, &self.a)) / &rate;
        let point = add(&self.a, &scale(&self.along, &u));
        if self.begin.is_some_and(|begin| u < big(begin)) || self.end.is_some_and(|end| u >= big(end)) {
            return meeting;
        }
        let time = dot(v, &sub(&point, x)) / dot(v, v);
        if is_positive(&rate) {
            let normal = scale(&left(&self.along), &(big(1.0) / norm(&self.along)));
            meeting.crossings.push(Crossing { time, point, normal });
        } else {
            meeting.inward.push(small(&time));
        }
        meeting
    }
    fn vertices(&self) -> Vec<Vector> {
        let vertex = |u: f64| add(&self.a, &scale(&self.along, &big(u)));
        self.begin.into_iter().chain(self.end).map(vertex).collect()
    }
}

/// A straight wall with two sides.
#[derive(Clone, Debug)]
pub(crate) struct Both(pub [Straight; 2]);

impl Both {
    pub(crate) fn new(a: [f64; 2], b: [f64; 2]) -> Both {
        Both([Straight::segment(a, b), Straight::segment(b, a)])
    }
}

impl Truth for Both {
    fn meet(&self, x: &Vector, v: &Vector) -> Meeting {
        let crossings = self.0.iter().flat_map(|side| side.meet(x, v).crossings).collect();
        Meeting { crossings, ..Meeting::default() }
    }
    fn vertices(&self) -> Vec<Vector> {
        self.0[0].vertices()
    }
}

/// A point of the unit circle on its right (part 0) or left half, and its derivative.
pub(super) fn round(part: usize, u: &Big) -> [Vector; 2] {
    let side = big(if part == 0 { 1.0 } else { -1.0 });
    let one = big(1.0);
    let square = u * u;
    let share = &side / (&one + &square);
    let y = [(&one - &square) * &share, u * big(2.0) * &share];
    [y.clone(), left(&y)]
}

/// An ellipse, or the arc of one from one vertex to another; circles too.
#[derive(Clone, Debug)]
pub(crate) struct Oval {
    center: Vector,
    axes: [Vector; 2],
    /// +1 with the table inside.
    turn: f64,
    arc: Option<[Vector; 2]>,
}

impl Oval {
    pub(crate) fn new(
        center: [f64; 2],
        semi_axes: [f64; 2],
        angle: f64,
        inside: bool,
        arc: Option<[[f64; 2]; 2]>,
    ) -> Oval {
        let axis = direction(angle);
        Oval {
            center: vector(center),
            axes: [scale(&axis, &big(semi_axes[0])), scale(&left(&axis), &big(semi_axes[1]))],
            turn: if inside { 1.0 } else { -1.0 },
            arc: arc.map(|ends| ends.map(vector)),
        }
    }
    /// `A y`, with the semi-axes as columns.
    fn stretch(&self, y: &Vector) -> Vector {
        add(&scale(&self.axes[0], &y[0]), &scale(&self.axes[1], &y[1]))
    }
}

impl Curve for Oval {
    fn parts(&self) -> usize {
        2
    }
    fn at(&self, part: usize, u: &Big) -> [Vector; 2] {
        let [y, t] = round(part, u);
        [add(&self.center, &self.stretch(&y)), self.stretch(&scale(&t, &big(self.turn)))]
    }
    fn vertices(&self) -> Vec<Vector> {
        self.arc.clone().map_or(vec![], Vec::from)
    }
    fn holds(&self, p: &Vector) -> bool {
        // an arc lies on one side of its chord
        self.arc.as_ref().is_none_or(|[a, b]| {
            let side = cross(&sub(b, a), &sub(p, a)) * big(self.turn);
            !is_positive(&side)
        })
    }
}

/// The truth about a piece of one of the common figures.
pub(crate) fn truth_of(piece: &dyn Piece) -> Box<dyn Truth> {
    match piece.figure() {
        Figure::Segment { ends: [a, b] } => Box::new(Straight::segment(a.into(), b.into())),
        Figure::Ray { from, direction, left } => {
            let a = vector(from.into());
            let straight = |along: Vector2<f64>, begin, end| Straight { a, along: vector(along.into()), begin, end };
            // with the table on its right it is traversed towards its end
            Box::new(if left { straight(direction, Some(0.0), None) } else { straight(-direction, None, Some(0.0)) })
        }
        Figure::Line { through, direction } => {
            let (a, along) = (vector(through.into()), vector(direction.into()));
            Box::new(Straight { a, along, begin: None, end: None })
        }
        Figure::Arc { center, radius, ends, inside } => {
            Box::new(Cut::new(Oval::new(center.into(), [radius; 2], 0.0, inside, Some(ends.map(Into::into)))))
        }
        Figure::Circle { center, radius, inside } => {
            Box::new(Cut::new(Oval::new(center.into(), [radius; 2], 0.0, inside, None)))
        }
        Figure::Other => panic!("{piece:?} has no common figure"),
    }
}
