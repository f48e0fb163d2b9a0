//! The walls of a room in lanes, where a simple container surrounds everything else.
use super::Room;
use crate::{
    Boundary, BoxTree, Error, Extent, Hit, Line,
    afar::NEWTON,
    parry::{Side, Solid, first::first_in, solid::Figure},
    plane::slack,
    walls::{
        Around, AtFoot, ByLane, Cuboid, Cylinder, Member, OneByOne, Scatterers, Slab, Solids, Sphere, Vessel, WithWalls,
    },
};
use nalgebra::Vector3;

/// A container of everything else.
#[derive(Clone, Copy, Debug)]
enum Container {
    /// The inside of a ball, with its number.
    Ball { center: Vector3<f64>, radius: f64, piece: usize },
    /// The inside of a cylinder about a unit vector, with its number.
    Cylinder { center: Vector3<f64>, axis: Vector3<f64>, radius: f64, half_height: f64, piece: usize },
    /// All points between two corners, with the numbers of the lower and the upper wall across each axis.
    Box { low: Vector3<f64>, high: Vector3<f64>, pieces: [[usize; 2]; 3] },
    /// All points between two planes perpendicular to an axis, with the numbers of the lower and the upper one.
    Slab { axis: usize, low: f64, high: f64, pieces: [usize; 2] },
}

impl Room {
    /// Runs a computation with the walls of the room in the fastest available form.
    ///
    /// The inside of a ball, of a cylinder, of a cuboid with its sides along the axes (one solid or six planes), and the slab between two
    /// planes perpendicular to an axis answer in one go, alone or around disjoint balls. Any other convex solids, except cones from
    /// outside, are tested one after another in lanes, if they are not too many; all else is tested for one path after another.
    pub fn with_walls<V: WithWalls<3>>(&self, visit: V) -> V::Output {
        let single = self.solids.iter().enumerate().filter_map(|(number, solid)| Container::single(number, solid));
        let mut containers = self.between_planes().into_iter().chain(single);
        if let Some(container) = containers.find(|container| container.holds_the_rest_of(self)) {
            let rest = Obstacles::of(self, |number| !container.has(number));
            if rest.solids.is_empty() {
                return container.alone(visit).unwrap_or_else(|visit| visit.run(&ByLane(self)));
            }
            if let Some(balls) = rest.balls()
                && let (Ok(container), Ok(obstacles)) = (container.vessel(), Scatterers::new(balls))
            {
                return visit.run(&Around { container, obstacles });
            }
        }
        match self.in_lanes() {
            Some((members, rest)) => {
                let size = self.solids.iter().map(Solid::size).fold(0.0, f64::max);
                let others = (!rest.solids.is_empty()).then_some(&rest as OneByOne);
                let is_at_foot = |point: &Vector3<f64>, piece, near| self.is_at_foot(point, piece, near);
                let feet = (others.is_some() && !self.feet.is_empty()).then_some(&is_at_foot as AtFoot);
                visit.run(&Solids::new(&members, others, self, size).with_feet(feet))
            }
            None => visit.run(&ByLane(self)),
        }
    }

    /// The convex bodies that are tested in lanes, and all other solids: obstacles only up to a limited number of surfaces.
    fn in_lanes(&self) -> Option<(Vec<Member>, Obstacles<'_>)> {
        /// In 16 lanes 48 faces of obstacles take 18 ns and a tree 42, but for a single orbit 100 and 78. More would not pay: 162 faces
        /// take 50 and 90 ns in lanes, but for a single orbit, which would then test each of them, 500 and 180.
        const MOST: usize = 64;
        if self.sheets {
            return None;
        }
        let known = self.solids.iter().enumerate().filter_map(|(number, solid)| {
            Some(Member { body: solid.body()?, extent: solid.extent(), inside: solid.side() == Side::Inside, number })
        });
        let (mut members, obstacles): (Vec<_>, Vec<_>) = known.partition(|member| member.inside);
        if obstacles.iter().map(|member| member.body.surfaces()).sum::<usize>() <= MOST {
            members.extend(obstacles);
        }
        let others = Obstacles::of(self, |number| members.iter().all(|member| number != member.number));
        (!members.is_empty()).then_some((members, others))
    }

    /// The box or the slab between all planes perpendicular to axes.
    fn between_planes(&self) -> Option<Container> {
        let mut ends = [[None; 2]; 3];
        for (number, solid) in self.solids.iter().enumerate() {
            let Some(Figure::HalfSpace { axis, upwards, at }) = solid.figure() else { continue };
            // a table above the half-space begins at its plane
            let end = &mut ends[axis][usize::from(upwards != (solid.side() == Side::Outside))];
            if end.replace((at, number)).is_some() {
                return None;
            }
        }
        let mut slabs = vec![];
        for (axis, ends) in ends.into_iter().enumerate() {
            match ends {
                [None, None] => {}
                [Some((low, below)), Some((high, above))] if low < high => {
                    slabs.push((axis, [low, high], [below, above]));
                }
                _ => return None,
            }
        }
        match slabs[..] {
            [(axis, [low, high], pieces)] => Some(Container::Slab { axis, low, high, pieces }),
            [(_, x, of_x), (_, y, of_y), (_, z, of_z)] => {
                let [low, high] = [0, 1].map(|end| Vector3::new(x[end], y[end], z[end]));
                Some(Container::Box { low, high, pieces: [of_x, of_y, of_z] })
            }
            // an infinite channel has no walls in lanes
            _ => None,
        }
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

    /// Runs a computation with its walls alone; returns the computation where they cannot be made.
    fn alone<V: WithWalls<3>>(&self, visit: V) -> Result<V::Output, V> {
        match self.vessel() {
            Ok(Vessel::Ball(walls)) => Ok(visit.run(&walls)),
            Ok(Vessel::Cylinder(walls)) => Ok(visit.run(&walls)),
            Ok(Vessel::Box(walls)) => Ok(visit.run(&walls)),
            Ok(Vessel::Slab1(walls)) => Ok(visit.run(&walls)),
            Ok(Vessel::Slab2(walls)) => Ok(visit.run(&walls)),
            Ok(Vessel::Slab3(walls)) => Ok(visit.run(&walls)),
            Err(_) => Err(visit),
        }
    }

    /// Its walls.
    fn vessel(&self) -> Result<Vessel, Error> {
        Ok(match *self {
            Container::Ball { center, radius, piece } => Vessel::Ball(Sphere::new(center, radius, piece)?),
            Container::Cylinder { center, axis, radius, half_height, piece } => {
                Vessel::Cylinder(Cylinder::new(center, axis, radius, half_height, piece)?)
            }
            Container::Box { low, high, pieces } => Vessel::Box(Cuboid::new(low.into(), high.into(), pieces)?),
            Container::Slab { axis: 0, low, high, pieces } => Vessel::Slab1(Slab::new(low, high, pieces)?),
            Container::Slab { axis: 1, low, high, pieces } => Vessel::Slab2(Slab::new(low, high, pieces)?),
            Container::Slab { low, high, pieces, .. } => Vessel::Slab3(Slab::new(low, high, pieces)?),
        })
    }

    /// Whether a solid is one of its walls.
    fn has(&self, number: usize) -> bool {
        match self {
            Container::Ball { piece, .. } | Container::Cylinder { piece, .. } => number == *piece,
            Container::Box { pieces, .. } => pieces.as_flattened().contains(&number),
            Container::Slab { pieces, .. } => pieces.contains(&number),
        }
    }

    /// Whether all other solids of the room lie inside, so far from its walls that both are never hit at once.
    fn holds_the_rest_of(&self, room: &Room) -> bool {
        let (own, others): (Vec<_>, Vec<_>) = room.solids.iter().enumerate().partition(|(number, _)| self.has(*number));
        let off = own.iter().map(|(_, solid)| off(solid)).fold(0.0, f64::max);
        others.iter().map(|(_, solid)| solid.extent()).all(|extent @ Extent { min, max }| match self {
            Container::Ball { center, radius, .. } => {
                (center - min).abs().sup(&(max - center).abs()).norm() < radius - off
            }
            Container::Cylinder { center, axis, radius, half_height, .. } => extent.corners().all(|corner| {
                let away = corner - center;
                let height = axis.dot(&away);
                height.abs() < half_height - off && (away - axis * height).norm() < radius - off
            }),
            Container::Box { low, high, .. } => low.add_scalar(off) < min && max < high.add_scalar(-off),
            Container::Slab { axis, low, high, .. } => low + off < min[*axis] && max[*axis] < high - off,
        })
    }
}

/// Twice the rounding error \[L\] of positions in a solid or beside it.
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
    /// Some solids of a room.
    fn of(room: &'a Room, which: impl Fn(usize) -> bool) -> Self {
        let solids: Vec<_> = room.solids.iter().enumerate().filter(|(number, _)| which(*number)).collect();
        let tree = BoxTree::new(solids.iter().map(|(_, solid)| solid.extent()));
        Obstacles { room, solids, tree }
    }

    /// Centres, radii and numbers, if all are disjoint balls, none of them tiny compared with the room.
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
            let (own, mut apart) = (self.solids[a].1.extent(), true);
            self.tree.search(
                |other| own.meets(other, reach),
                |b| apart &= a == b || (balls[b].0 - center).norm() > radius + balls[b].1 + reach,
            );
            apart
        };
        balls.iter().enumerate().all(is_apart).then_some(balls)
    }
}
