//! Lanes have the bits of single numbers.

use super::*;
use geometry::shapes::curve::Polar;

/// The bits of a hit.
fn bits<F: Lane, const N: usize>(hit: &WallHit<F, N>, lane: usize) -> Vec<u64> {
    let time = hit.time.lane(lane);
    if time == f64::INFINITY {
        return vec![time.to_bits()]; // nothing else means anything
    }
    let corner = f64::from(u8::from(hit.corner.at(lane)));
    let rest = hit.point.iter().chain(&hit.unit_normal()).map(|c| c.lane(lane)).collect::<Vec<_>>();
    [time, hit.piece.lane(lane), corner].into_iter().chain(rest).map(f64::to_bits).collect()
}

/// First hits in lanes.
struct InLanes<'a, W, const N: usize> {
    walls: &'a W,
    paths: &'a [Line<N>],
}

/// Lanes and single numbers, path by path.
pub(super) struct SameBits<'a, const N: usize> {
    pub(super) name: &'a str,
    pub(super) paths: &'a [Line<N>],
}

impl<const N: usize> WithWalls<N> for SameBits<'_, N> {
    type Output = ();
    fn run<W: Walls<N>>(self, walls: &W) {
        let in_lanes = lanes::dispatch(InLanes { walls, paths: self.paths });
        assert!(in_lanes.len() + 64 > self.paths.len());
        for (path, in_lanes) in self.paths.iter().zip(in_lanes) {
            let single = walls.first_hit::<f64>(&path.point.into(), &path.velocity.into());
            assert_eq!(bits(&single, 0), in_lanes, "{}: {path:?}", self.name);
        }
    }
}

impl<W: Walls<N>, const N: usize> Kernel for InLanes<'_, W, N> {
    type Output = Vec<Vec<u64>>;
    fn run<F: Lane>(self, zero: F) -> Vec<Vec<u64>> {
        let mut all = vec![];
        for block in self.paths.chunks_exact(F::LANES) {
            let x = core::array::from_fn(|i| zero.each(|lane| block[lane].point[i]));
            let v = core::array::from_fn(|i| zero.each(|lane| block[lane].velocity[i]));
            let hit = self.walls.first_hit(&x, &v);
            all.extend((0..F::LANES).map(|lane| bits(&hit, lane)));
        }
        all
    }
}

#[test]
fn lanes_have_the_bits_of_single_numbers() {
    let mut random = Random(3);
    for (name, table) in &planar() {
        let paths = paths(table, 512, &mut random);
        table.with_walls(SameBits { name, paths: &paths });
        SameBits { name, paths: &paths }.run(&table.list(0..table.pieces().len()));
    }
    for entry in tables::all() {
        match entry.build {
            Build::Planar(_) => {
                let table = entry.planar(&entry.typical()).unwrap();
                if table.lattice().is_some() {
                    let paths = orbit_starts(&table, 512, &mut random);
                    table.with_walls(SameBits { name: entry.name, paths: &paths });
                }
            }
            Build::Spatial(_) => {
                let paths = spatial_paths(entry, 512, &mut random);
                let table = entry.spatial(&entry.typical()).unwrap();
                table.with_walls(SameBits { name: entry.name, paths: &paths });
            }
        }
    }
}

#[test]
fn corners_of_graphs_are_told_in_lanes_too_from_near_and_far() {
    let table = tables::perturbed_polygon(5, 1.0, 0.0625).unwrap();
    let mut random = Random(11);
    let mut paths = vec![];
    for k in 0..4096 {
        let corner = table.corners()[k % 5];
        let turn = 6.3 * random.uniform();
        // within the table, or from as far as 2⁴⁰ sizes, some of them straight at a corner and others beside it
        let way = libm::exp2(if k % 2 == 0 { -3.0 * random.uniform() } else { 40.0 * random.uniform() });
        let beside = f64::EPSILON * libm::exp2(8.0 * random.uniform() - 3.0) * way.max(1.0);
        let direction =
            if k % 2 == 0 { corner / corner.norm() } else { Vector2::new(libm::cos(turn), libm::sin(turn)) };
        let across = Vector2::new(-direction.y, direction.x) * beside;
        paths.push(Line { point: corner - direction * way + across, velocity: direction });
    }
    let single = |path: &Line<2>| table.with_walls(Ask(*path));
    let corners = paths.iter().filter_map(single).map(|hit| hit.corner);
    let (told, not) =
        corners.fold((0, 0), |(told, not), corner| if corner { (told + 1, not) } else { (told, not + 1) });
    assert!(told > 400 && not > 400, "{told} {not}");
    table.with_walls(SameBits { name: "pentagon", paths: &paths });
}

#[test]
fn graphs_of_a_hundred_waves_are_looked_up_in_lanes_as_alone() {
    let formula = formulas::Clover { radius: 1.0, amount: 0.005, leaves: 100 };
    let curve = Polar::new(Vector2::zeros(), formula, true).unwrap();
    let table = Table::new(vec![Box::new(curve) as _]).unwrap();
    let mut random = Random(12);
    let paths = orbit_starts(&table, 4096, &mut random);
    table.with_walls(SameBits { name: "a hundred waves", paths: &paths });
}
