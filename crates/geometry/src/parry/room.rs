//! A region of space bounded by several solids.
mod departure;
mod fastest;
mod rim;

use super::{
    Side, Solid,
    distance::to_unit,
    feet::Feet,
    first::first_in,
    solid::{area::Trials, bound::Bound},
};
use crate::{Boundary, BoxTree, Error, Extent, Hit, Line, plane::slack, random, surface::Surface, walls::CORNER};
use nalgebra::{Matrix3, Vector3};

/// The points on the table's side of all of some solids: inside a container and around obstacles, between planes, ...
///
/// Solid `i` is piece `i`.
///
/// ```
/// use geometry::{Boundary, Line, Vector3, parry::{Room, Side, SolidSpec}};
/// let can = SolidSpec::Cylinder { radius: 1.0, height: 2.0, rounding: 0.0 }.solid([0.0; 3], Side::Inside)?;
/// let ball = SolidSpec::Ball { radius: 0.5 }.solid([0.0; 3], Side::Outside)?;
/// let room = Room::new(vec![can, ball]);
/// let path = Line { point: Vector3::new(-1.0, 0.0, 0.0), velocity: Vector3::new(1.0, 0.0, 0.0) };
/// let hit = room.first_hit(&path).unwrap();
/// assert_eq!((hit.time, hit.piece), (0.5, 1));
/// # Ok::<(), geometry::Error>(())
/// ```
#[derive(Debug)]
pub struct Room {
    solids: Vec<Solid>,
    tree: BoxTree<3>,
    /// Whether any solid has triangles with the table on both sides.
    sheets: bool,
    feet: Feet,
}

impl Room {
    /// The room between solids.
    pub fn new(solids: Vec<Solid>) -> Room {
        let tree = BoxTree::new(solids.iter().map(Solid::extent));
        let sheets = solids.iter().any(Solid::has_two_sides);
        let reach = 2.0 * slack([tree.size()]);
        let standing = solids.iter().enumerate().filter(|(_, solid)| solid.may_stand());
        let boxes = standing.map(|(number, solid)| (number, solid.extent().grown(reach)));
        let feet = Feet::new(&tree, boxes, |other, extent| solids[other].stays_out_of(extent));
        Room { solids, tree, sheets, feet }
    }

    /// Whether a point lies on an obstacle that may touch other walls, to within `near`, and not only on the piece with this number.
    fn is_at_foot(&self, point: &Vector3<f64>, piece: usize, near: f64) -> bool {
        self.feet.any_at(point, near, |k| k != piece && self.solids[k].has_on_it(point, near))
    }

    /// Whether another solid stands where a path hits one.
    fn is_foot(&self, path: &Line<3>, hit: &Hit<3>) -> bool {
        let near = |solid: &Solid| CORNER * solid.size().max(path.point.amax()).max(hit.point.amax());
        let stands = |k: usize| self.solids[k].stands_at(&hit.point, &hit.normal, near(&self.solids[k]));
        let reach = CORNER * self.tree.size().max(path.point.amax());
        self.feet.any_at(&hit.point, reach, |k| k != hit.piece && stands(k))
    }

    /// Its solids, in the order of their numbers.
    pub fn solids(&self) -> &[Solid] {
        &self.solids
    }

    /// Distance from the boundary \[L\], negative outside the room, where its absolute value is a lower bound.
    pub fn distance(&self, point: &Vector3<f64>) -> f64 {
        self.solids.iter().map(|solid| solid.distance(point)).fold(f64::INFINITY, f64::min)
    }

    /// A box around the room. A box around the boundary where the room is not known to be bounded; infinite where the boundary is.
    pub fn extent(&self) -> Extent<3> {
        let room = container(self.solids.iter());
        if room.is_finite() {
            return room;
        }
        let boundary = self.solids.iter().map(Solid::extent).fold(Extent::EMPTY, Extent::union);
        let known = |room: f64, wall: f64| if room.is_finite() { room } else { wall };
        Extent { min: room.min.zip_map(&boundary.min, known), max: room.max.zip_map(&boundary.max, known) }
    }

    /// Random points of the boundary.
    ///
    /// # Errors
    /// [`Error::Unbounded`] where the boundary has an infinite area, [`Error::Empty`] where there is none, [`Error::Vanished`] where
    /// none of it is found, [`Error::Rim`] where orbits in an enclosed room come round the rim of an open surface, [`Error::Shape`] for
    /// shapes known by their distance only.
    pub fn surface(&self) -> Result<RoomSurface<'_>, Error> {
        let bound = Bound::of(container(self.solids.iter()));
        let mut parts = vec![];
        for (number, solid) in self.solids.iter().enumerate() {
            parts.extend(solid.trials(bound)?.into_iter().map(|trials| Part { number, trials, up_to: 0.0 }));
        }
        let size = parts.iter().map(|part| part.trials.size()).fold(0.0, f64::max);
        let mut sum = 0.0;
        for part in &mut parts {
            sum += part.trials.area(to_unit(size));
            part.up_to = sum;
        }
        if parts.is_empty() {
            return Err(Error::Empty);
        }
        if let Some(piece) = self.open_inside() {
            return Err(Error::Rim { piece });
        }
        let surface = RoomSurface { room: self, parts };
        // where this many trials find nothing, a start would take milliseconds, or forever
        let mut uniform = random::uniform(1);
        let found = sum > 0.0 && (0..MOST_TRIALS).any(|_| surface.trial(&mut uniform).is_some());
        if found { Ok(surface) } else { Err(Error::Vanished) }
    }
}

/// A box around the room between solids; infinite where the room is not known to be bounded.
fn container<'a>(solids: impl Iterator<Item = &'a Solid> + Clone) -> Extent<3> {
    let inner = solids.clone().filter(|solid| solid.side() == Side::Inside).map(Solid::extent);
    let common = inner.fold(Extent::<3>::WHOLE, |a, b| Extent { min: a.min.sup(&b.min), max: a.max.inf(&b.max) });
    if common.is_finite() { common } else { between(&planes(solids)) }
}

/// The sides of the planes among solids.
fn planes<'a>(solids: impl Iterator<Item = &'a Solid>) -> Vec<Half> {
    let planes = solids.filter(|solid| !solid.extent().is_finite());
    let foot = planes.map(|solid| solid.closest(&Vector3::zeros()));
    foot.map(|foot| (foot.normal, foot.normal.dot(&foot.point))).collect()
}

/// Trials after which nothing is expected to be found.
const MOST_TRIALS: u32 = 100_000;

/// All points with `n·x ≥ d`, for a unit vector `n`.
type Half = (Vector3<f64>, f64);

/// A box around the intersection of half-spaces. Where that is unbounded, only walls perpendicular to an axis bound the box.
fn between(halves: &[Half]) -> Extent<3> {
    // normals that are parallel to within this count as parallel
    let little = 1e-9;
    let size = halves.iter().map(|(_, d)| d.abs()).fold(0.0, f64::max);
    let Extent { mut min, mut max } = Extent::<3>::EMPTY;
    // if there is a way to infinity, then there is one along two of the planes, or all planes have a direction in common
    let mut spanned = false;
    for (i, a) in halves.iter().enumerate() {
        for b in &halves[..i] {
            let along = a.0.cross(&b.0);
            let length = along.norm();
            spanned = spanned || halves[..i].iter().any(|(k, _)| k.dot(&along).abs() > little);
            if length <= little {
                continue;
            }
            match ends(halves, [a, b], little, size) {
                None => {}
                Some([Some(start), Some(end)]) => {
                    for third in [start, end] {
                        let normals = Matrix3::from_rows(&[a.0, b.0, halves[third].0].map(|n| n.transpose()));
                        if let Some(inverse) = normals.try_inverse() {
                            let vertex = inverse * Vector3::new(a.1, b.1, halves[third].1);
                            (min, max) = (min.inf(&vertex), max.sup(&vertex));
                        }
                    }
                }
                Some(_) => return across_axes(halves),
            }
        }
    }
    if !spanned {
        return across_axes(halves);
    }
    // half-spaces without a common point have no vertex
    if min <= max { Extent { min, max } } else { Extent { min: Vector3::zeros(), max: Vector3::zeros() } }
}

/// The box bounded by those half-spaces whose planes are perpendicular to an axis, within rounding.
fn across_axes(halves: &[Half]) -> Extent<3> {
    let Extent { mut min, mut max } = Extent::WHOLE;
    for (n, d) in halves {
        let axis = n.iamax();
        if n[axis].abs() < 1.0 - f64::EPSILON {
            continue;
        }
        if n[axis] > 0.0 {
            min[axis] = min[axis].max(*d);
        } else {
            max[axis] = max[axis].min(-d);
        }
    }
    Extent { min, max }
}

/// Which half-spaces bound the line along which two of them meet, from behind and from ahead; `None` where nothing is left of it.
fn ends(halves: &[Half], [a, b]: [&Half; 2], little: f64, size: f64) -> Option<[Option<usize>; 2]> {
    let along = a.0.cross(&b.0);
    let point = (b.0 * a.1 - a.0 * b.1).cross(&along) / along.norm_squared();
    let along = along / along.norm();
    let slack = little * size.max(point.amax());
    let [mut start, mut end] = [(f64::NEG_INFINITY, None), (f64::INFINITY, None)];
    for (k, (n, d)) in halves.iter().enumerate() {
        let (rise, height) = (n.dot(&along), n.dot(&point) - d);
        let at = -height / rise;
        if rise > little {
            if at > start.0 {
                start = (at, Some(k));
            }
        } else if rise < -little {
            if at < end.0 {
                end = (at, Some(k));
            }
        } else if height < -slack {
            return None;
        }
        if start.0 > end.0 + slack {
            return None;
        }
    }
    Some([start.1, end.1])
}

impl Boundary<3> for Room {
    fn first_hit(&self, path: &Line<3>) -> Option<Hit<3>> {
        let hit = first_in(&self.tree, self.sheets, path, |k| (k, &self.solids[k]))?;
        Some(Hit { corner: hit.corner || self.is_foot(path, &hit), ..hit })
    }
}

/// Points of a room's boundary, uniform by area: of each of its solids, those on the room's side of all others.
///
/// Convex solids are met by random lines, which enter each part of a convex surface in proportion to its area (Cauchy, Crofton);
/// points of planes are drawn in a disk, and those of meshes on the triangles.
#[derive(Debug)]
pub struct RoomSurface<'a> {
    room: &'a Room,
    parts: Vec<Part<'a>>,
}

/// One body of one solid, with the cumulative area of the trials up to and including it.
#[derive(Debug)]
struct Part<'a> {
    number: usize,
    trials: Trials<'a>,
    up_to: f64,
}

impl RoomSurface<'_> {
    /// Tries to find a point.
    fn trial(&self, uniform: &mut dyn FnMut() -> f64) -> Option<(Vector3<f64>, Vector3<f64>)> {
        let last = self.parts.last()?;
        let share = uniform() * last.up_to;
        let part = self.parts.iter().find(|part| share < part.up_to).unwrap_or(last);
        let (point, normal) = part.trials.draw(uniform)?;
        let slack = slack([part.trials.size(), point.amax()]);
        let mut others = self.room.solids.iter().enumerate().filter(|(k, _)| *k != part.number);
        let leaves = |k: usize, solid: &Solid| solid.closest(&point).leaves(&normal, part.number < k, slack);
        others.all(|(k, solid)| leaves(k, solid)).then_some((point, normal))
    }
}

impl Surface for RoomSurface<'_> {
    fn random_point(&self, uniform: &mut dyn FnMut() -> f64) -> (Vector3<f64>, Vector3<f64>) {
        loop {
            if let Some(found) = self.trial(uniform) {
                return found;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{super::SolidSpec, *};

    fn plane(normal: [f64; 3], through: [f64; 3]) -> Solid {
        SolidSpec::HalfSpace { normal }.solid(through, Side::Outside).unwrap()
    }
    fn ball(radius: f64, center: [f64; 3], side: Side) -> Solid {
        SolidSpec::Ball { radius }.solid(center, side).unwrap()
    }
    fn refused(solids: Vec<Solid>) -> Error {
        Room::new(solids).surface().unwrap_err()
    }

    #[test]
    fn a_boundary_without_end_has_no_points_to_draw() {
        let unbounded = Error::Unbounded { what: "the area of the walls" };
        let slab = || vec![plane([0.0, 0.0, 1.0], [0.0; 3]), plane([0.0, 0.0, -1.0], [0.0, 0.0, 1.0])];
        assert_eq!(refused(slab()), unbounded);
        // a prism without end faces, and a pyramid without a base
        let mut prism = slab();
        prism.push(plane([1.0, 0.0, 0.0], [0.0; 3]));
        prism.push(plane([-1.0, 0.0, 0.1], [1.0, 0.0, 0.0]));
        assert_eq!(refused(prism), unbounded);
        let pyramid = [[1.0, 0.0, 1.0], [-1.0, 1.0, 1.0], [-1.0, -1.0, 1.0]].map(|n| plane(n, [0.0; 3]));
        assert_eq!(refused(pyramid.into()), unbounded);
        // a ball in front of a plane is bounded, but the plane is not
        let in_front = vec![ball(1.0, [0.0, 0.0, 2.0], Side::Outside), plane([0.0, 0.0, 1.0], [0.0; 3])];
        assert_eq!(refused(in_front), unbounded);
    }

    #[test]
    fn walls_that_bound_nothing_together_are_refused() {
        let apart = [[0.0; 3], [3.0, 0.0, 0.0]].map(|center| ball(1.0, center, Side::Inside));
        assert_eq!(refused(apart.into()), Error::Vanished);
        let axes =
            [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
        assert_eq!(refused(axes.map(|n| plane(n, n)).into()), Error::Vanished);
        assert_eq!(refused(vec![]), Error::Empty);
    }

    #[test]
    fn points_lie_on_the_boundary_and_not_between_walls_that_touch() {
        // a drum that stands on the floor of a cube
        let cube = SolidSpec::Cuboid { size: [2.0; 3], rounding: 0.0 }.solid([0.3, 0.0, 1.0], Side::Inside).unwrap();
        let drum = SolidSpec::Cylinder { radius: 0.5, height: 1.0, rounding: 0.0 };
        let room = Room::new(vec![cube, drum.solid([0.3, 0.0, 0.5], Side::Outside).unwrap()]);
        let surface = room.surface().unwrap();
        let mut uniform = random::uniform(1);
        for _ in 0..10_000 {
            let (point, normal) = surface.random_point(&mut uniform);
            assert!(room.distance(&point).abs() < 1e-14, "{point:?}");
            assert!((normal.norm() - 1.0).abs() < 1e-15);
            assert!((room.distance(&(point + normal * 1e-6)) - 1e-6).abs() < 1e-9, "{point:?}");
            let axis = libm::hypot(point.x - 0.3, point.y);
            assert!(point.z > 1e-9 || axis > 0.5, "{point:?}");
        }
    }

    /// The fraction of points of the boundary for which something holds.
    fn share(room: &Room, of: impl Fn(&Vector3<f64>) -> bool) -> f64 {
        let surface = room.surface().unwrap();
        let mut uniform = random::uniform(1);
        let trials = 20_000;
        (0..trials).filter(|_| of(&surface.random_point(&mut uniform).0)).count() as f64 / f64::from(trials)
    }

    #[test]
    fn a_floor_has_its_share_of_a_hemisphere() {
        for radius in [0.3, 5.0] {
            let room = Room::new(vec![plane([0.0, 0.0, 1.0], [0.0; 3]), ball(radius, [0.0; 3], Side::Inside)]);
            let floor = share(&room, |p| p.z.abs() < 1e-12);
            // one standard deviation is 0.0033
            assert!((floor - 1.0 / 3.0).abs() < 0.015, "{radius}: {floor}");
        }
    }

    #[test]
    fn thin_rooms_are_drawn_from() {
        for (radius, height) in [(1e-5, 1.0), (1.0, 1e-9)] {
            let can = SolidSpec::Cylinder { radius, height, rounding: 0.0 }.solid([0.0; 3], Side::Inside).unwrap();
            let ends = radius / (radius + height);
            let found = share(&Room::new(vec![can]), |p| p.z.abs() > (0.5 - 1e-14) * height);
            // five times the standard deviation
            assert!((found - ends).abs() <= 5.0 * libm::sqrt(ends * (1.0 - ends) / 20_000.0) + 1e-4, "{found} {ends}");
        }
    }

    #[test]
    fn where_walls_lie_on_one_another_points_are_drawn_once() {
        // a drum within a cube of its height: all of the boundary is the drum's
        let cube = || SolidSpec::Cuboid { size: [2.0; 3], rounding: 0.0 }.solid([0.0; 3], Side::Inside).unwrap();
        let drum =
            || SolidSpec::Cylinder { radius: 0.8, height: 2.0, rounding: 0.0 }.solid([0.0; 3], Side::Inside).unwrap();
        let ends = 0.8 / (0.8 + 2.0);
        for solids in [vec![cube(), drum()], vec![drum(), cube()]] {
            let found = share(&Room::new(solids), |p| p.z.abs() > 1.0 - 1e-9);
            // five times the standard deviation
            assert!((found - ends).abs() < 0.016, "{found} {ends}");
        }
        // and the same wall twice
        let found = share(&Room::new(vec![cube(), cube()]), |p| p.z > 1.0 - 1e-9);
        assert!((found - 1.0 / 6.0).abs() < 0.014, "{found}");
    }

    #[test]
    fn where_members_of_a_union_lie_on_one_another_points_are_drawn_once() {
        use crate::parry::parry3d_f64::{
            math::Pose,
            shape::{Compound, SharedShape},
        };
        // two cubes that overlap by half
        let cubes = [0.0, 1.0].map(|x| (Pose::translation(x, 0.0, 0.0), SharedShape::cuboid(1.0, 1.0, 1.0)));
        let union = Compound::new(cubes.into());
        for side in [Side::Inside, Side::Outside] {
            let mut solids = vec![Solid::new(&union, &nalgebra::Isometry3::identity(), side).unwrap()];
            if side == Side::Outside {
                solids.push(ball(9.0, [0.0; 3], Side::Inside));
            }
            let room = Room::new(solids);
            let on_it = |p: &Vector3<f64>| p.norm() < 5.0;
            let found = share(&room, |p| on_it(p) && p.z > 1.0 - 1e-9) / share(&room, on_it);
            // three by two, out of four of these and two ends
            assert!((found - 6.0 / 32.0).abs() < 0.05, "{side:?} {found}");
        }
    }

    #[test]
    fn a_path_into_an_edge_between_walls_ends_in_a_corner() {
        let mut walls =
            [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]
                .map(|n| (n, if n.iter().sum::<f64>() > 0.0 { [0.0; 3] } else { [1.0; 3] }));
        let hit =
            |room: &Room, velocity| room.first_hit(&Line { point: Vector3::new(0.5, 0.25, 0.375), velocity }).unwrap();
        let aim = |x: f64, y: f64, z: f64| Vector3::new(x - 0.5, y - 0.25, z - 0.375);
        let mut cube = Room::new(vec![]);
        for _ in 0..2 {
            // whichever comes first in the list
            walls.reverse();
            cube = Room::new(walls.map(|(n, through)| plane(n, through)).into());
            for at in [aim(1.0, 1.0, 0.375), aim(0.0, 0.5, 1.0), aim(1.0, 1.0, 1.0), aim(0.0, 0.0, 0.0)] {
                assert!(hit(&cube, at).corner, "{at:?}");
            }
        }
        for at in [aim(1.0, 1.0 - 1e-14, 0.375), aim(1.0, 0.9, 0.0 + 1e-13), aim(1.0, 0.5, 0.5)] {
            assert!(!hit(&cube, at).corner, "{at:?}");
        }
        // the same wall twice is one wall
        let twice = Room::new(vec![plane([0.0, 0.0, 1.0], [0.0; 3]), plane([0.0, 0.0, 2.0], [1.0, 0.0, 0.0])]);
        assert!(!hit(&twice, Vector3::new(0.1, 0.2, -1.0)).corner);
        // no corner is reported beside a line where walls are tangent to each other
        let tile = SolidSpec::Cuboid { size: [1.0, 1.0, 0.5], rounding: 0.25 };
        let tile = tile.solid([0.0, 0.0, -0.5], Side::Outside).unwrap();
        let tiles = Room::new(vec![tile, plane([0.0, 0.0, 1.0], [0.0; 3])]);
        for exponent in 2..52 {
            let x = 0.5 + libm::ldexp(1.0, -exponent);
            let path = Line { point: Vector3::new(x, 0.0, 2.0), velocity: -Vector3::z() };
            assert!(!tiles.first_hit(&path).unwrap().corner, "{x}");
        }
        // nor where another wall is touched far behind
        let floor = plane([0.0, 0.0, 1.0], [0.0; 3]);
        let behind =
            Room::new(vec![plane([1.0, 0.0, 0.0], [0.0; 3]), ball(1.0, [-3.0, 0.0, 0.5], Side::Outside), floor]);
        for z in [1.5_f64.next_down(), 1.5, 1.5_f64.next_up()] {
            let path = Line { point: Vector3::new(2.0, 0.0, z), velocity: -Vector3::x() };
            assert!(!behind.first_hit(&path).unwrap().corner, "{z}");
        }
        // a notch between two balls that overlap
        let balls = [-0.5, 0.5].map(|x| ball(1.0, [x, 0.0, -1.0], Side::Outside));
        let down = Line { point: Vector3::new(0.0, 0.0, 2.0), velocity: -Vector3::z() };
        assert!(Room::new(balls.into()).first_hit(&down).unwrap().corner);
    }

    #[test]
    fn a_room_without_end_ends_at_the_walls_across_an_axis() {
        let slab = || vec![plane([0.0, 0.0, 1.0], [3.0, 0.0, -1.0]), plane([0.0, 0.0, -2.0], [0.0, 5.0, 1.0])];
        let around = Room::new(slab()).extent();
        let free = f64::INFINITY;
        assert_eq!(around, Extent { min: Vector3::new(-free, -free, -1.0), max: Vector3::new(free, free, 1.0) });
        let with_balls = slab().into_iter().chain([[0.0; 3], [9.0, 0.0, 0.0]].map(|at| ball(0.9, at, Side::Outside)));
        assert_eq!(Room::new(with_balls.collect()).extent(), around);
        let tube =
            slab().into_iter().chain([plane([0.0, 1.0, 0.0], [0.0; 3]), plane([0.0, -1.0, 0.0], [0.0, 4.0, 0.0])]);
        let around = Room::new(tube.collect()).extent();
        assert_eq!(around, Extent { min: Vector3::new(-free, 0.0, -1.0), max: Vector3::new(free, 4.0, 1.0) });
    }

    #[test]
    fn a_box_around_a_room_between_planes_is_known() {
        let n = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, -1.0, -1.0]];
        let corner = Room::new(n.map(|n| plane(n, if n[0] < 0.0 { [1.0, 0.0, 0.0] } else { [0.0; 3] })).into());
        let Extent { min, max } = corner.extent();
        assert!(min.amax() < 1e-15 && (max - Vector3::repeat(1.0)).amax() < 1e-15);
    }
}
