//! Circles, ellipses and arcs of them that coincide.
use super::stretch::{Stretch, doubles as doubles_of};
use crate::{
    plane::slack,
    shapes::{Circle, Ellipse, Shape},
};
use core::f64::consts::PI;
use nalgebra::Vector2;

/// A circle or an ellipse, or an arc of one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Oval {
    number: usize,
    inside: bool,
    /// The coordinates of its centre, and how far it reaches from there along x₁, x₂ and x₁ + x₂, which determines its
    /// form.
    place: [f64; 5],
    /// Rounding of its coordinates.
    slack: f64,
    /// Polar angles about the centre, counter-clockwise.
    from: f64,
    to: f64,
}

impl Oval {
    pub(super) fn of(number: usize, shape: &Shape) -> Option<Oval> {
        let (center, reach, inside) = match shape {
            Shape::Circle(circle) => of_circle(circle),
            Shape::Arc(arc) => of_circle(arc.circle()),
            Shape::Ellipse(ellipse) => of_ellipse(ellipse),
            Shape::EllipticArc(arc) => of_ellipse(arc.ellipse()),
            Shape::Segment(_) | Shape::Screen(_) | Shape::Ray(_) | Shape::Line(_) => return None,
        };
        let (from, to) = match shape.as_piece().ends() {
            None => (-PI, PI),
            Some(ends) => {
                let angle = |p: Vector2<f64>| libm::atan2(p.y - center[1], p.x - center[0]);
                let [a, b] = if inside { ends } else { [ends[1], ends[0]] }.map(angle);
                (a, if b <= a { b + 2.0 * PI } else { b })
            }
        };
        let ([x, y], [a, b, c]) = (center, reach);
        let place = [x, y, a, b, c];
        Some(Oval { number, inside, place, slack: slack(place), from, to })
    }

    /// The same with its angles less a turn.
    fn turned(self) -> Oval {
        Oval { from: self.from - 2.0 * PI, to: self.to - 2.0 * PI, ..self }
    }

    fn coincides(&self, other: &Oval, overlap: f64) -> bool {
        let rounding = 0.25 * self.slack.max(other.slack);
        let size = self.place[2].max(self.place[3]);
        overlap * size > self.slack.max(other.slack)
            && self.place.iter().zip(&other.place).all(|(a, b)| (a - b).abs() <= rounding)
    }
}

/// Centre, reach, and whether the table is inside.
type Form = ([f64; 2], [f64; 3], bool);

fn of_circle(circle: &Circle) -> Form {
    let r = circle.radius;
    (circle.center, [r, r, libm::hypot(r, r)], circle.inside)
}

fn of_ellipse(ellipse: &Ellipse) -> Form {
    (ellipse.center(), [[1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(|d| ellipse.reach(d)), ellipse.unit().inside)
}

/// The numbers of the ovals that coincide, at least in part, with another one that has the table on the other side.
pub(super) fn doubles(mut ovals: Vec<Oval>) -> Vec<usize> {
    let across: Vec<Oval> = ovals.iter().filter(|oval| oval.to > PI).map(|oval| oval.turned()).collect();
    ovals.extend(across);
    let mut found = vec![];
    let mut groups = vec![ovals];
    for i in 0..5 {
        groups = groups.into_iter().flat_map(|group| alike(group, i)).collect();
    }
    for group in groups {
        let stretch =
            |(place, oval): (usize, &Oval)| (Stretch::new(oval.number, oval.inside, [oval.from, oval.to]), place);
        let stretches = group.iter().enumerate().map(stretch).collect();
        found.extend(doubles_of(stretches, |i, j, overlap| group[i].coincides(&group[j], overlap)));
    }
    found
}

/// Splits a group so that coordinate `i` of `place` agrees up to rounding within each part; returns only groups of two
/// or more.
fn alike(mut group: Vec<Oval>, i: usize) -> Vec<Vec<Oval>> {
    group.sort_by(|a, b| a.place[i].total_cmp(&b.place[i]));
    let same = |a: &Oval, b: &Oval| b.place[i] - a.place[i] <= 0.25 * a.slack.max(b.slack);
    group.chunk_by(same).filter(|chunk| chunk.len() > 1).map(<[Oval]>::to_vec).collect()
}
