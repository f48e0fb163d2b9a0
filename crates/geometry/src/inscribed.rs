//! The largest disk in a table.
use crate::{
    Extent, Figure, Landing, Lattice, Table,
    copies::{Copies, finite_extent},
    plane::{GOLDEN_SECTION, slack},
    shapes::curve::rising_root_near,
};
use core::f64::consts::TAU;
use nalgebra::{Matrix3, Vector2, Vector3};
use std::{cell::OnceCell, collections::BinaryHeap};

/// Where the largest disk in a table lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LargestDisk {
    /// Its centre \[L\].
    pub center: Vector2<f64>,
    /// Its radius \[L\]; infinite where a disk of any size fits.
    pub radius: f64,
}

/// The search for the best place goes on until no place can be better by more than this relative amount; from there an ascent finds the
/// maximum.
const COARSE: f64 = 1.0 / 1024.0;

/// Most squares examined: a ridge of equally good places would need ever more.
const MOST_SQUARES: usize = 40_000;

/// Most places at which walls are touched to find more corridors than the search had squares for, and most on one piece.
const MOST_TOUCHED: [usize; 2] = [4096, 16];

/// A direction that walls hardly ever have.
const ASIDE: Vector2<f64> = Vector2::new(0.61, 0.79);

/// Directions of walls without end that differ by no more than this (radians) are parallel: each is rounded to half an ulp per
/// component.
const PARALLEL: f64 = 8.0 * f64::EPSILON;

/// A fraction of a curve's length whose square is below rounding.
const NEARLY: f64 = 1e-9;

/// A square of the search.
#[derive(Clone, Copy, Debug)]
struct Square {
    middle: Vector2<f64>,
    half: f64,
    distance: f64,
    /// No point of the square is farther than this from the boundary.
    bound: f64,
}

impl PartialEq for Square {
    fn eq(&self, other: &Square) -> bool {
        self.cmp(other).is_eq()
    }
}
impl Eq for Square {}
impl PartialOrd for Square {
    fn partial_cmp(&self, other: &Square) -> Option<core::cmp::Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Square {
    fn cmp(&self, other: &Square) -> core::cmp::Ordering {
        self.bound.total_cmp(&other.bound)
    }
}

/// Places along a curve between which the distance from a point has one minimum at most.
const PLACES: u32 = 256;

/// Signed distances from a table's boundary, found with a tree.
struct Field {
    copies: Copies,
    /// On a lattice, the lattice and a corner of a cell around which all translates are known.
    cell: Option<(Lattice, Vector2<f64>)>,
    /// Arc lengths along curves that may be touched in several places, and the landings there, computed when first needed.
    places: Vec<OnceCell<Vec<(f64, Landing)>>>,
}

impl Field {
    /// The field of a table; `home` is the box of the table or of its unit cell.
    fn new(table: &Table, home: &Extent) -> Field {
        let copies = Copies::new(table.pieces(), table.shortest(), home, (home.max - home.min).amax());
        let places = copies.order().map(|_| OnceCell::new()).collect();
        let finite = finite_extent(table.pieces());
        let corner = if finite.is_finite() { (finite.min + finite.max) * 0.5 } else { Vector2::zeros() };
        Field { copies, cell: table.shortest().map(|lattice| (lattice.clone(), corner)), places }
    }

    /// The equivalent point in the cell.
    fn home(&self, point: Vector2<f64>) -> Vector2<f64> {
        let Some((lattice, corner)) = &self.cell else { return point };
        point - lattice.translation(lattice.coordinates(&(point - corner)).map(libm::floor))
    }

    /// The closest points of all pieces that may come as near as `reach`.
    fn feet(&self, point: &Vector2<f64>, reach: f64) -> Vec<Landing> {
        let mut feet = vec![];
        self.copies.search(|e| e.distance(point) <= reach, |i| feet.push(self.copies.get(i).0.piece.closest(point)));
        feet
    }

    /// The points of all pieces within about `reach` at which the distance has a local minimum along the piece.
    fn local_feet(&self, point: &Vector2<f64>, reach: f64) -> Vec<Landing> {
        let mut feet = self.feet(point, reach);
        // how far a foot lies ahead of the point, along the curve
        let ahead = |l: &Landing| (l.point - point).dot(&Vector2::new(l.normal.y, -l.normal.x));
        let visit = |i: usize| {
            let piece = &self.copies.get(i).0.piece;
            let length = piece.length();
            if piece.figure() != Figure::Other || piece.tips().is_some() || !length.is_finite() {
                return;
            }
            let at = |k: u32| length * (f64::from(k) / f64::from(PLACES));
            let places =
                self.places[i].get_or_init(|| (0..=PLACES).map(at).map(|s| (s, piece.landing_at(s))).collect());
            for w in places.windows(2) {
                let [(low, before), (high, after)] = [w[0], w[1]];
                let [behind, beyond] = [ahead(&before), ahead(&after)];
                if behind < 0.0 && beyond >= 0.0 {
                    let rise = |s: f64| {
                        let here = piece.landing_at(s);
                        let rate = 1.0 + piece.curvature(&here.point) * (here.point - point).dot(&here.normal);
                        [ahead(&here), rate]
                    };
                    // a step of Newton's method leaves the square of the error; each needs an arc length, which may be an integral
                    let guess = low + (high - low) * (behind / (behind - beyond));
                    feet.push(piece.landing_at(rising_root_near(guess, rise, [low, high], NEARLY * length)));
                }
            }
        };
        self.copies.search(|e| e.distance(point) <= reach, visit);
        feet
    }

    /// The largest disk that touches a wall at a point `p` of it, to a thousandth: each next one is smaller, through the point `q` of the
    /// boundary nearest to the centre of the one before, of radius `|q − p|² / 2n·(q − p)`.
    fn touching(&self, at: &Landing, largest: f64) -> LargestDisk {
        let mut radius = largest;
        loop {
            let center = at.point + at.normal * radius;
            let home = self.home(center);
            let inside = self.copies.nearest(&home, radius * (1.0 - COARSE));
            let smaller = inside.and_then(|(_, index)| {
                let off = self.copies.get(index).0.piece.closest(&home).point + (center - home) - at.point;
                let (square, ahead) = (off.norm_squared(), off.dot(&at.normal));
                Some(0.5 * square / ahead).filter(|smaller| 0.0 < *smaller && *smaller < radius)
            });
            let Some(smaller) = smaller else { return LargestDisk { center: home, radius } };
            radius = smaller;
        }
    }

    /// The largest of the disks that touch walls at places spread over the boundary.
    fn largest_touching(&self, table: &Table, largest: f64) -> Option<LargestDisk> {
        let pieces: Vec<_> = table.pieces().iter().filter(|piece| piece.length().is_finite()).collect();
        let [most, most_on_one] = MOST_TOUCHED;
        let count = (most / pieces.len().max(1)).clamp(1, most_on_one);
        let touching = pieces.iter().step_by(pieces.len().div_ceil(most).max(1)).flat_map(|piece| {
            let places = (0..count).map(move |k| piece.length() * ((k as f64 + GOLDEN_SECTION) / count as f64));
            places.map(|s| self.touching(&piece.landing_at(s), largest))
        });
        touching.max_by(|a, b| a.radius.total_cmp(&b.radius))
    }

    /// Where the best step of at most this size along each axis leads from a place at some distance from the boundary, and the distance
    /// there if all walls were straight.
    fn stepped(&self, from: Vector2<f64>, distance: f64, limit: f64) -> (Vector2<f64>, f64) {
        let reach = distance + 2.0 * limit;
        let wall = |foot: &Landing| {
            let off = from - foot.point;
            let d = libm::hypot(off.x, off.y);
            (d > 0.0 && d <= reach).then(|| Vector3::new(off.x / d, off.y / d, d))
        };
        let walls: Vec<Vector3<f64>> = self.local_feet(&from, reach).iter().filter_map(wall).collect();
        let (value, step) = best_step(&walls, limit);
        (self.home(from + step), value)
    }

    /// Climbs from a point to the nearest local maximum of the distance, where three walls, or two opposite ones, are equally far.
    fn climb(&self, mut center: Vector2<f64>, start: f64) -> LargestDisk {
        let mut radius = self.copies.signed_distance(&center);
        let mut step = start;
        // each failure halves the step twice; quadratic convergence needs far fewer than this
        for _ in 0..200 {
            if step <= f64::EPSILON * (radius + center.amax()) {
                break;
            }
            let (mut next, expected) = self.stepped(center, radius, step);
            let mut better = self.copies.signed_distance(&next);
            // a step along a curved ridge leads off it: back onto it, by about as much as the distance fell short
            let missing = expected - better;
            if better <= radius && missing < step {
                (next, _) = self.stepped(next, better, missing);
                better = self.copies.signed_distance(&next);
            }
            if better > radius {
                (center, radius) = (next, better);
                step *= 2.0;
            } else {
                step *= 0.25;
            }
        }
        LargestDisk { center, radius }
    }
}

/// The step `δ`, `|δᵢ| ≤ limit`, that maximises the least of `d + n·δ` over walls `(n, d)`, after that maximum.
fn best_step(walls: &[Vector3<f64>], limit: f64) -> (f64, Vector2<f64>) {
    // the nearest dozen decide: all combinations of three bounds are tried
    let mut walls = walls.to_vec();
    walls.sort_by(|a, b| a.z.total_cmp(&b.z));
    walls.truncate(12);
    let value = |d: &Vector2<f64>| walls.iter().map(|w| w.z + w.x * d.x + w.y * d.y).fold(f64::INFINITY, f64::min);
    // bounds n·δ − w t ≥ −d as rows: walls with w = 1, the sides of the square with w = 0
    let mut rows: Vec<(Vector3<f64>, f64)> = walls.iter().map(|w| (Vector3::new(w.x, w.y, -1.0), -w.z)).collect();
    for (x, y) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
        rows.push((Vector3::new(x, y, 0.0), -limit));
    }
    let mut best = (value(&Vector2::zeros()), Vector2::zeros());
    for i in 0..rows.len() {
        for j in i + 1..rows.len() {
            for k in j + 1..rows.len() {
                let matrix = Matrix3::from_rows(&[rows[i].0.transpose(), rows[j].0.transpose(), rows[k].0.transpose()]);
                let Some(inverse) = matrix.try_inverse() else { continue };
                let found = inverse * Vector3::new(rows[i].1, rows[j].1, rows[k].1);
                let step = Vector2::new(found.x, found.y);
                // the solution of three equations is on the limit to rounding where one of them is that limit
                if step.amax() <= limit * (1.0 + 1e-12) && value(&step) > best.0 {
                    best = (value(&step), step);
                }
            }
        }
    }
    best
}

impl Table {
    /// The largest disk that fits in the table; on a lattice it may overlap its own translates.
    ///
    /// The radius is correct to rounding unless the best radii at two places far apart differ by less than a thousandth: then it is that
    /// of one of them. In a table of very many rooms or very long corridors, for which 40 000 squares are too coarse, it is the greatest
    /// to which an ascent leads from the best of those squares, or from the largest of the disks that touch a wall at one of 4096 places.
    pub fn largest_disk(&self) -> LargestDisk {
        let finite = self.pieces().iter().all(|p| p.extent().is_finite());
        let home = self.search_box();
        if finite {
            // the table around nothing but holes and two-sided walls is unbounded
            let width = (home.max - home.min).norm();
            if self.shortest().is_none() && self.enclosed_by(&self.chains()) <= slack([width * width]) {
                return LargestDisk { center: home.max * 2.0 - home.min, radius: f64::INFINITY };
            }
            if let Some(center) = self.far_across(&home) {
                return LargestDisk { center, radius: f64::INFINITY };
            }
            return self.largest_disk_in(&home);
        }
        if let Some(direction) = self.widening() {
            return LargestDisk {
                center: (home.min + home.max) * 0.5 + direction * home.size(),
                radius: f64::INFINITY,
            };
        }
        // two boxes, the second 16 times as large: where the disk keeps growing with the box, it has no largest size
        let (middle, half) = ((home.min + home.max) * 0.5, (home.max - home.min) * 0.5);
        let in_box = |k: f64| self.largest_disk_in(&Extent { min: middle - half * k, max: middle + half * k });
        let [small, large] = [in_box(4.0), in_box(64.0)];
        let best = if large.radius > small.radius { large } else { small };
        // out there are only straight walls, and an ascent that goes beyond finds no maximum
        let beyond = (0..2).any(|i| (best.center[i] - middle[i]).abs() > 1024.0 * half.amax());
        if large.radius > 8.0 * small.radius || beyond {
            return LargestDisk { center: large.center, radius: f64::INFINITY };
        }
        best
    }

    /// A direction in which the table is, far away, a sector (however narrow) between infinite straight walls: any disk fits in there.
    fn widening(&self) -> Option<Vector2<f64>> {
        struct Far {
            angle: f64,
            /// How far to the left of the origin the wall lies, seen along it.
            left: f64,
            direction: Vector2<f64>,
            /// Whether the table is on the left of it.
            is_right_wall: bool,
        }
        let far = |from: &Vector2<f64>, direction: Vector2<f64>, is_right_wall: bool| Far {
            angle: libm::atan2(direction.y, direction.x),
            left: direction.perp(from),
            direction,
            is_right_wall,
        };
        let mut walls: Vec<Far> = vec![];
        for piece in self.pieces() {
            match piece.figure() {
                Figure::Line { through, direction } => {
                    walls.extend([far(&through, direction, true), far(&through, -direction, false)]);
                }
                Figure::Ray { from, direction, left } => walls.push(far(&from, direction, left)),
                _ if piece.length().is_finite() => {}
                _ => return None,
            }
        }
        walls.sort_by(|a, b| a.angle.total_cmp(&b.angle));
        (0..walls.len()).find_map(|k| {
            // parallel walls lie side by side for ever
            let turn = |wall: &Far| {
                let angle = wall.angle - walls[k].angle;
                if angle < 0.0 { angle + TAU } else { angle }
            };
            let is_parallel = |wall: &&Far| {
                let turn = turn(wall);
                turn.min(TAU - turn) <= PARALLEL
            };
            let next = walls.iter().filter(|wall| !is_parallel(wall)).map(turn).fold(TAU, f64::min);
            let last = walls.iter().filter(is_parallel).max_by(|a, b| a.left.total_cmp(&b.left))?;
            let (sin, cos) = libm::sincos(0.5 * next);
            let [x, y] = walls[k].direction.data.0[0];
            last.is_right_wall.then(|| Vector2::new(x * cos - y * sin, x * sin + y * cos))
        })
    }

    /// A box that contains the table, or its unit cell, or all its finite parts.
    fn search_box(&self) -> Extent {
        let corners = |p: &std::sync::Arc<dyn crate::Piece>| match p.figure() {
            Figure::Line { through, .. } => vec![through],
            Figure::Ray { from, .. } => vec![from],
            _ => vec![],
        };
        let mut home = finite_extent(self.pieces()).union(Extent::of(self.pieces().iter().flat_map(corners)));
        let cell = self.shortest().map_or(&[][..], |l| l.vectors());
        for v in cell {
            home = home.union(Extent { min: home.min + v, max: home.max + v });
        }
        // a wedge or a half-plane has no size of its own
        let size = (home.max - home.min).amax();
        let margin = if size > 0.0 { size } else { home.size().max(1.0) };
        let all_finite = self.pieces().iter().all(|p| p.extent().is_finite());
        let least = if all_finite { 0.0 } else { margin };
        Extent { min: home.min.add_scalar(-least), max: home.max.add_scalar(least) }
    }

    fn largest_disk_in(&self, home: &Extent) -> LargestDisk {
        let sides = home.max - home.min;
        let field = Field::new(self, home);
        let square = |middle: Vector2<f64>, half: f64| {
            // squares reach beyond the box, where not all translates are known
            let distance = field.copies.signed_distance(&field.home(middle));
            Square { middle, half, distance, bound: distance + half * core::f64::consts::SQRT_2 }
        };
        // squares as wide as the narrow side of the box, but not too many
        let side = sides.min().max(sides.max() / 256.0);
        let mut open = BinaryHeap::new();
        let count = sides.map(|s| libm::ceil(s / side).max(1.0));
        let mut y = 0.5;
        while y < count.y {
            let mut x = 0.5;
            while x < count.x {
                open.push(square(home.min + Vector2::new(x, y) * side, 0.5 * side));
                x += 1.0;
            }
            y += 1.0;
        }
        let mut best = square((home.min + home.max) * 0.5, 0.0);
        let mut looked_at = 0;
        while let Some(top) = open.pop() {
            if top.distance > best.distance {
                best = top;
            }
            looked_at += 1;
            if top.bound <= best.distance * (1.0 + COARSE) || looked_at > MOST_SQUARES {
                break;
            }
            for (x, y) in [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)] {
                let half = 0.5 * top.half;
                let next = square(top.middle + Vector2::new(x, y) * half, half);
                if next.distance > best.distance {
                    best = next;
                }
                if next.bound > best.distance * (1.0 + COARSE) {
                    open.push(next);
                }
            }
        }
        // exactly midway between walls the slope may vanish although the distance rises to both sides: a second ascent begins beside that
        // point
        let step = best.half.max(best.distance.abs() * COARSE);
        let [here, beside] =
            [Vector2::zeros(), ASIDE * step].map(|aside| field.climb(field.home(best.middle + aside), step));
        let best = if beside.radius > here.radius { beside } else { here };
        if looked_at <= MOST_SQUARES {
            return best;
        }
        let elsewhere = field.largest_touching(self, sides.norm());
        let elsewhere = elsewhere.map(|disk| field.climb(disk.center, disk.radius * COARSE));
        elsewhere.filter(|disk| disk.radius > best.radius).unwrap_or(best)
    }

    /// A place far from all walls, on a lattice of one vector with finite pieces only: to either side of these the table either ends or
    /// is unbounded.
    fn far_across(&self, home: &Extent) -> Option<Vector2<f64>> {
        let &[along] = self.shortest()?.vectors() else { return None };
        let across = Vector2::new(-along.y, along.x) * (2.0 * (home.max - home.min).norm() / along.norm());
        let field = Field::new(self, home);
        let middle = (home.min + home.max) * 0.5;
        [middle + across, middle - across].into_iter().find(|far| field.copies.signed_distance(&field.home(*far)) > 0.0)
    }
}

#[cfg(test)]
mod tests {
    use crate::{
        Lattice, Outline, Piece, Table, Turn, Vector2,
        shapes::{
            Circle, Ellipse, FullLine, Ray, Segment,
            curve::{Interval, Polar, PolarFormula},
        },
    };

    fn v(x: f64, y: f64) -> Vector2<f64> {
        Vector2::new(x, y)
    }
    fn polygon(vertices: &[[f64; 2]]) -> Table {
        let mut o = Outline::from(vertices[0].into());
        for &p in vertices[1..].iter().chain([&vertices[0]]) {
            o = o.line_to(p.into()).unwrap();
        }
        Table::new(o.close().unwrap()).unwrap()
    }
    fn of(pieces: Vec<Box<dyn Piece>>) -> Table {
        Table::new(pieces).unwrap()
    }

    #[test]
    fn the_largest_disk_touches_three_walls_or_two() {
        let triangle = polygon(&[[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]]).largest_disk();
        assert!((triangle.radius - 1.0).abs() < 1e-15);
        assert!((triangle.center - v(1.0, 1.0)).norm() < 1e-14);
        // a ridge of equally good places
        let rectangle = polygon(&[[0.0, 0.0], [7.0, 0.0], [7.0, 1.0], [0.0, 1.0]]).largest_disk();
        assert!((rectangle.radius - 0.5).abs() < 1e-15);
        let disk = of(vec![Box::new(Circle::new(v(3.0, 1.0), 2.0, true).unwrap())]).largest_disk();
        assert!((disk.radius - 2.0).abs() < 1e-14, "{disk:?}");
        let ellipse = of(vec![Box::new(Ellipse::new(v(0.0, 0.0), [2.0, 1.0], 0.3, true).unwrap())]).largest_disk();
        assert!((ellipse.radius - 1.0).abs() < 1e-13, "{ellipse:?}");
    }

    /// `r = 2 − 0.3 cos 3φ`
    #[derive(Clone, Debug)]
    struct Clover;

    impl PolarFormula for Clover {
        fn jet(&self, angle: f64) -> [f64; 3] {
            let (sin, cos) = libm::sincos(3.0 * angle);
            [2.0 - 0.3 * cos, 0.9 * sin, 2.7 * cos]
        }
        fn jet_over(&self, angle: Interval) -> [Interval; 3] {
            let [sin, cos] = (angle * 3.0).sin_cos();
            [cos * -0.3 + 2.0, sin * 0.9, cos * 2.7]
        }
    }

    #[test]
    fn the_largest_disk_may_touch_one_curve_in_several_places() {
        let clover = || Polar::new(v(0.5, -0.25), Clover, true).unwrap();
        let disk = of(vec![Box::new(clover())]).largest_disk();
        assert!((disk.radius - 1.7).abs() < 1e-14 && (disk.center - v(0.5, -0.25)).norm() < 1e-14, "{disk:?}");
    }

    #[test]
    fn the_largest_disk_of_a_bent_corridor_is_where_it_is_widest() {
        // between a circle and an eccentric one inside: g wide on average, and 3/2 g at most
        for g in [0.5, 0.1, 0.01, 1e-3, 1e-5] {
            for angle in [0.0, 0.7, 2.0, 4.0] {
                let (sin, cos) = libm::sincos(angle);
                let off = 0.5 * g;
                let circle = |at: f64, radius: f64, inside: bool| {
                    Box::new(Circle::new(v(at * cos, at * sin), radius, inside).unwrap()) as Box<dyn Piece>
                };
                let disk = of(vec![circle(0.0, 1.0, true), circle(off, 1.0 - g, false)]).largest_disk();
                assert!((disk.radius - 0.75 * g).abs() < 1e-15, "{g} {angle}: {disk:?}");
            }
        }
    }

    #[test]
    fn the_largest_disk_is_in_the_widest_of_hundreds_of_rooms() {
        for (count, wider) in [(100, 1.03), (100, 1.004), (300, 1.03), (300, 1.01)] {
            let width = 1.0 / f64::from(count);
            let mut pieces = vec![];
            let mut x = 0.0137 * width;
            for k in 0..count {
                let end = x + if k == count / 3 { wider * width } else { width };
                let corners = [v(x, 0.0), v(end, 0.0), v(end, 1.0), v(x, 1.0)];
                let around = corners.into_iter().chain([corners[0]]).skip(1);
                pieces.extend(around.fold(Outline::from(corners[0]), |o, p| o.line_to(p).unwrap()).close().unwrap());
                x = end + 0.3 * width;
            }
            let disk = of(pieces).largest_disk();
            assert!((disk.radius - 0.5 * wider * width).abs() < 1e-15, "{count} {wider}: {disk:?}");
        }
    }

    #[test]
    fn the_largest_disk_beside_a_scatterer_is_in_a_corner() {
        let disk = Box::new(Circle::new(v(1.0, 1.0), 0.5, false).unwrap()) as Box<dyn Piece>;
        let o = Outline::from(v(0.0, 0.0)).line_to(v(2.0, 0.0)).unwrap().line_to(v(2.0, 2.0)).unwrap();
        let mut pieces = o.line_to(v(0.0, 2.0)).unwrap().line_to(v(0.0, 0.0)).unwrap().close().unwrap();
        pieces.push(disk);
        // r (1 + √2) = √2 − 1/2
        let radius = (2.0_f64.sqrt() - 0.5) / (1.0 + 2.0_f64.sqrt());
        assert!((of(pieces).largest_disk().radius - radius).abs() < 1e-15);
    }

    #[test]
    fn the_largest_disk_between_scatterers_on_a_lattice_is_about_its_deepest_hole() {
        let radius = 0.15;
        for [[a, b], [c, d]] in [
            [[1.0, 0.3], [-0.3, 1.0]],
            [[1.16, 0.36], [-0.33, 1.05]],
            [[1.1, 0.3], [-0.3, 1.1]],
            [[1.0, 0.0], [0.5, 0.75_f64.sqrt()]],
            [[1.0, 0.0], [7.3, 1.0]],
        ] {
            for at in [v(0.0, 1.0), v(0.2, 1.0), v(0.0, 0.0), v(-7.0, 3.0), v(1e3, -1e4)] {
                let scatterer: Vec<Box<dyn Piece>> = vec![Box::new(Circle::new(at, radius, false).unwrap())];
                let table = Table::periodic(scatterer, Some(Lattice::new(&[v(a, b), v(c, d)]).unwrap())).unwrap();
                // the circumradius of an acute triangle of shortest vectors
                let [[u, w], _] = [table.shortest().unwrap().vectors(); 2].map(|vectors| [vectors[0], vectors[1]]);
                let w = if u.dot(&w) < 0.0 { -w } else { w };
                let hole = u.norm() * w.norm() * (u - w).norm() / (2.0 * u.perp(&w).abs());
                let disk = table.largest_disk();
                assert!(
                    (disk.radius - (hole - radius)).abs() < 1e-12 * at.amax().max(1.0),
                    "{a} {b} {c} {d} {at}: {disk:?}, {hole}"
                );
                assert!(
                    (table.signed_distance(&disk.center) - disk.radius).abs() < 1e-12 * at.amax().max(1.0),
                    "{disk:?}"
                );
            }
        }
    }

    #[test]
    fn above_a_row_of_walls_there_is_room_for_every_disk() {
        let row = |piece: Box<dyn Piece>| {
            Table::periodic(vec![piece], Some(Lattice::new(&[v(2.0, 0.0)]).unwrap())).unwrap().largest_disk()
        };
        let floor = Segment::new(v(0.0, 0.0), v(2.0, 0.0)).unwrap();
        let posts = Circle::new(v(1.0, 3.0), 0.5, false).unwrap();
        for disk in [row(Box::new(floor)), row(Box::new(posts))] {
            assert!(disk.radius.is_infinite(), "{disk:?}");
        }
    }

    #[test]
    fn infinite_tables_may_have_room_for_every_disk() {
        let line = |y: f64, x: f64| Box::new(FullLine::new(v(0.0, y), v(x, 0.0)).unwrap()) as Box<dyn Piece>;
        let open = of(vec![Box::new(Circle::new(v(1.0, 1.0), 0.5, false).unwrap())]).largest_disk();
        assert!(open.radius.is_infinite());
        let strip = of(vec![line(0.25, 1.0), line(1.25, -1.0)]).largest_disk();
        assert!((strip.radius - 0.5).abs() < 1e-15);
        assert!(of(vec![line(0.0, 1.0)]).largest_disk().radius.is_infinite());
        let ray = |x: f64, left: bool| Box::new(Ray::new(v(0.0, 0.0), v(x, 4.0), left).unwrap()) as Box<dyn Piece>;
        assert!(of(vec![ray(1.0, true), ray(-1.0, false)]).largest_disk().radius.is_infinite());
        // however narrow; the plane around it has room as well, and a half-infinite strip has no more room than an infinite one
        for angle in [1e-3, 1e-9, 1e-14, 3.0] {
            assert!(crate::tables::wedge(angle).unwrap().largest_disk().radius.is_infinite(), "{angle}");
        }
        assert!(of(vec![ray(1e9, false), ray(-1e9, true)]).largest_disk().radius.is_infinite());
        let end = Segment::new(v(0.3, 1.0), v(0.0, 0.0)).unwrap();
        let [low, high] = [(v(0.0, 0.0), true), (v(0.3, 1.0), false)]
            .map(|(from, left)| Box::new(Ray::new(from, v(0.7, 0.1), left).unwrap()) as Box<dyn Piece>);
        let half_strip = of(vec![Box::new(end), low, high]).largest_disk();
        assert!((half_strip.radius - 0.5 * 0.67 / 0.5_f64.sqrt()).abs() < 1e-14, "{half_strip:?}");
        // walls that open slowly
        let end = Segment::new(v(0.0, 1.0), v(0.0, 0.0)).unwrap();
        let [low, high] = [(0.0, 0.0, true), (1.0, 0.01, false)]
            .map(|(y, slope, left)| Box::new(Ray::new(v(0.0, y), v(1.0, slope), left).unwrap()) as Box<dyn Piece>);
        assert!(of(vec![Box::new(end), low, high]).largest_disk().radius.is_infinite());
    }

    #[test]
    fn the_largest_disk_of_a_stadium_with_a_cap_is_its_cap() {
        let o = Outline::from(v(-1.0, -1.0)).line_to(v(1.0, -1.0)).unwrap();
        let o = o.arc_to(v(1.0, 1.0), v(1.0, 0.0), Turn::CounterClockwise).unwrap().line_to(v(-1.0, 1.0)).unwrap();
        let o = o.arc_to(v(-1.0, -1.0), v(-1.0, 0.0), Turn::CounterClockwise).unwrap();
        assert!((Table::new(o.close().unwrap()).unwrap().largest_disk().radius - 1.0).abs() < 1e-15);
    }
}
