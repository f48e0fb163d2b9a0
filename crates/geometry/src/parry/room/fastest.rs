//! The walls of a room in lanes, where a simple container is around everything else.
use super::{Room, boxed};
use crate::{
    Boundary, BoxTree, Error, Extent, Hit, Line,
    afar::NEWTON,
    parry::{Side, Solid, first::first_in, solid::Figure},
    plane::slack,
    walls::{Around, ByLane, Cuboid, Cylinder, Scatterers, Slab, Sphere, Walls, WithWalls},
};
use nalgebra::Vector3;

/// What may be around everything else.
#[derive(Clone, Copy, Debug)]
enum Container {
    /// The inside of a ball, with its number.
    Ball { center: Vector3<f64>, radius: f64, piece: usize },
    /// The inside of a cylinder about a unit vector, with its number.
    Cylinder { center: Vector3<f64>, axis: Vector3<f64>, radius: f64, half_height: f64, piece: usize },
    /// All between two corners, which may lie at infinity, with the numbers of the lower and the upper wall across each axis.
    Box { low: Vector3<f64>, high: Vector3<f64>, pieces: [[usize; 2]; 3] },
}

impl Room {
    /// Runs a computation with the walls of the room in the fastest form there is.
    ///
    /// The inside of a ball, of a cylinder, of a cuboid with its sides along the axes (one solid or six planes), and the slab between two
    /// planes across an axis answer in lanes where all else lies within, and so do balls in there that lie apart. All other solids are
    /// asked for one path after another.
    pub fn with_walls<V: WithWalls<3>>(&self, visit: V) -> V::Output {
        let single = self.solids.iter().enumerate().filter_map(|(number, solid)| Container::single(number, solid));
        let mut containers = self.between_planes().into_iter().chain(single);
        let Some(container) = containers.find(|container| container.holds_the_rest_of(self)) else {
            return visit.run(&ByLane(self));
        };
        let rest = Obstacles::beside(&container, self);
        match container {
            Container::Ball { center, radius, piece } => rest.within(Sphere::new(center, radius, piece), visit),
            Container::Cylinder { center, axis, radius, half_height, piece } => {
                rest.within(Cylinder::new(center, axis, radius, half_height, piece), visit)
            }
            Container::Box { low, high, pieces } => match [0, 1, 2].map(|axis| high[axis] < f64::INFINITY) {
                [true, true, true] => rest.within(Cuboid::new(low.into(), high.into(), pieces), visit),
                [true, _, _] => rest.within(Slab::<3, 0>::new(low.x, high.x, pieces[0]), visit),
                [_, true, _] => rest.within(Slab::<3, 1>::new(low.y, high.y, pieces[1]), visit),
                _ => rest.within(Slab::<3, 2>::new(low.z, high.z, pieces[2]), visit),
            },
        }
    }

    /// The box or the slab between all planes across axes.
    fn between_planes(&self) -> Option<Container> {
        let mut ends = [[None; 2]; 3];
        for (number, solid) in self.solids.iter().enumerate() {
            let Some(Figure::HalfSpace { axis, upwards, at }) = solid.figure() else { continue };
            // a table above the half-space begins there
            let end = &mut ends[axis][usize::from(upwards != (solid.side() == Side::Outside))];
            if end.replace((at, number)).is_some() {
                return None;
            }
        }
        let [mut low, mut high] = [f64::NEG_INFINITY, f64::INFINITY].map(Vector3::repeat);
        let mut pieces = [[usize::MAX; 2]; 3];
        for axis in 0..3 {
            match ends[axis] {
                [None, None] => {}
                [Some(a), Some(b)] if a.0 < b.0 => {
                    (low[axis], high[axis], pieces[axis]) = (a.0, b.0, [a.1, b.1]);
                }
                _ => return None,
            }
        }
        // a channel without end has no walls in lanes
        let walls = high.iter().filter(|end| end.is_finite()).count();
        (walls == 1 || walls == 3).then_some(Container::Box { low, high, pieces })
    }
}

impl Container {
    /// A solid as a container.
    fn single(number: usize, solid: &Solid) -> Option<Container> {
        match solid.figure().filter(|_| solid.side() == Side::Inside)? {
            Figure::Ball { center, radius } => Some(Container::Ball { center, radius, piece: number }),
            Figure::Cylinder { center, axis, radius, half_height } if radius > half_height * NEWTON => {
                Some(Container::Cylinder { center, axis, radius, half_height, piece: number })
            }
            Figure::Cuboid { low, high } if low < high => Some(Container::Box { low, high, pieces: [[number; 2]; 3] }),
            _ => None,
        }
    }

    /// Whether a solid is one of its walls.
    fn has(&self, number: usize) -> bool {
        match self {
            Container::Ball { piece, .. } | Container::Cylinder { piece, .. } => number == *piece,
            Container::Box { pieces, .. } => pieces.as_flattened().contains(&number),
        }
    }

    /// Whether all solids of a room but its own lie within, so far off its walls that both are never hit at once.
    fn holds_the_rest_of(&self, room: &Room) -> bool {
        let (own, others): (Vec<_>, Vec<_>) = room.solids.iter().enumerate().partition(|(number, _)| self.has(*number));
        let off = own.iter().map(|(_, solid)| off(solid)).fold(0.0, f64::max);
        others.iter().map(|(_, solid)| boxed(solid)).all(|Extent { min, max }| match self {
            Container::Ball { center, radius, .. } => {
                (center - min).abs().sup(&(max - center).abs()).norm() < radius - off
            }
            Container::Cylinder { center, axis, radius, half_height, .. } => (0..8).all(|corner| {
                let away = Vector3::from_fn(|i, _| if corner >> i & 1 == 0 { min[i] } else { max[i] }) - center;
                let height = axis.dot(&away);
                height.abs() < half_height - off && (away - axis * height).norm() < radius - off
            }),
            Container::Box { low, high, .. } => low.add_scalar(off) < min && max < high.add_scalar(-off),
        })
    }
}

/// By how much what is in a solid, or beside it, may be off a place through rounding \[L\], and twice that.
fn off(solid: &Solid) -> f64 {
    2.0 * slack([solid.size()])
}

/// Solids with their numbers in a room, and a tree of their boxes.
#[derive(Debug)]
struct Obstacles<'a> {
    room: &'a Room,
    solids: Vec<(usize, &'a Solid)>,
    tree: BoxTree<3>,
}

impl Boundary<3> for Obstacles<'_> {
    fn first_hit(&self, path: &Line<3>) -> Option<Hit<3>> {
        first_in(&self.tree, self.room.sheets, path, |k| self.solids[k])
    }
}

impl<'a> Obstacles<'a> {
    /// All solids of a room that are no walls of its container.
    fn beside(container: &Container, room: &'a Room) -> Self {
        let solids: Vec<_> = room.solids.iter().enumerate().filter(|(number, _)| !container.has(*number)).collect();
        let tree = BoxTree::new(solids.iter().map(|(_, solid)| boxed(solid)));
        Obstacles { room, solids, tree }
    }

    /// Runs a computation with these in a container.
    fn within<W: Walls<3>, V: WithWalls<3>>(self, container: Result<W, Error>, visit: V) -> V::Output {
        let Ok(container) = container else { return visit.run(&ByLane(self.room)) };
        if self.solids.is_empty() {
            return visit.run(&container);
        }
        match self.balls().map(Scatterers::new) {
            Some(Ok(obstacles)) => visit.run(&Around { container, obstacles }),
            _ => visit.run(&Around { container, obstacles: ByLane(self) }),
        }
    }

    /// Centres, radii and numbers, if all of them are balls that lie apart, none of them tiny beside the room.
    fn balls(&self) -> Option<Vec<(Vector3<f64>, f64, usize)>> {
        let ball = |(number, solid): &(usize, &Solid)| match solid.figure()? {
            Figure::Ball { center, radius } if solid.side() == Side::Outside => Some((center, radius, *number)),
            _ => None,
        };
        let balls: Vec<_> = self.solids.iter().map(ball).collect::<Option<_>>()?;
        let size = self.room.solids.iter().map(Solid::size).fold(0.0, f64::max);
        if balls.iter().any(|(_, radius, _)| *radius <= NEWTON * size) {
            return None;
        }
        let reach = self.solids.iter().map(|(_, solid)| off(solid)).fold(0.0, f64::max);
        let is_apart = |(a, (center, radius, _)): (usize, &(Vector3<f64>, f64, usize))| {
            let (own, mut apart) = (boxed(self.solids[a].1), true);
            self.tree.search(
                |other| own.meets(other, reach),
                |b| apart &= a == b || (balls[b].0 - center).norm() > radius + balls[b].1 + reach,
            );
            apart
        };
        balls.iter().enumerate().all(is_apart).then_some(balls)
    }
}
