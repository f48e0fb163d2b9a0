//! Nothing leaks: every path from inside a table hits a wall.

use super::*;

/// A specular orbit from hit to hit, started anew where it runs into a corner.
pub(super) struct Bounce<'a, const N: usize, S, D> {
    pub(super) name: &'a str,
    pub(super) bounces: usize,
    pub(super) start: S,
    /// Distance from the boundary of a point.
    pub(super) distance: D,
    /// Size of the coordinates.
    pub(super) size: f64,
}

impl<const N: usize, S, D> WithWalls<N> for Bounce<'_, N, S, D>
where
    S: FnMut() -> Line<N>,
    D: Fn(&SVector<f64, N>) -> f64,
{
    type Output = ();
    fn run<W: Walls<N>>(mut self, walls: &W) {
        let mut path = (self.start)();
        let mut instant = 0;
        for n in 0..self.bounces {
            let Some(hit) = walls.hit(&path) else { panic!("{}: lost at bounce {n}: {path:?}", self.name) };
            assert!(hit.time.is_finite() && hit.time >= 0.0, "{}: {path:?} {hit:?}", self.name);
            instant += usize::from(hit.time == 0.0);
            if n % 16 == 0 {
                // the landing point and the distance are each right to 4 ulp of the size
                let off = (self.distance)(&hit.point).abs();
                assert!(off <= 8.0 * f64::EPSILON * self.size, "{}: {off:e} off at {hit:?}", self.name);
            }
            if hit.corner {
                path = (self.start)();
                continue;
            }
            let v = path.velocity;
            path = Line { point: hit.point, velocity: v - hit.normal * (2.0 * v.dot(&hit.normal)) };
        }
        // a second hit at once happens next to corners and in grazing, both rare
        assert!(instant * 100 <= self.bounces, "{}: {instant} hits at once", self.name);
    }
}

#[test]
fn nothing_leaks_from_planar_tables() {
    let mut random = Random(4);
    for (name, table) in planar() {
        let Ok(interior) = Interior::of(&table) else { continue };
        let bounces = if tables::find(&name).is_some() { 100_000 } else { 20_000 };
        table.with_walls(Bounce {
            name: &name,
            bounces,
            start: || Line { point: interior.point(&mut || random.uniform()).unwrap(), velocity: random.velocity() },
            distance: |p: &Vector2<f64>| table.signed_distance(p),
            size: size(&table),
        });
    }
}

#[test]
fn nothing_leaks_from_lattice_tables() {
    let mut random = Random(5);
    for name in ["sinai-torus", "lorentz", "channel"] {
        let entry = tables::find(name).unwrap();
        let table = entry.planar(&entry.typical()).unwrap();
        let interior = Interior::of(&table).unwrap();
        table.with_walls(Bounce {
            name,
            bounces: 100_000,
            // an axis may lie along a corridor, in which nothing is ever hit
            start: || {
                let v = Vector2::new(random.between(0.5, 1.0), random.between(0.3, 0.7));
                Line { point: interior.point(&mut || random.uniform()).unwrap(), velocity: v }
            },
            distance: |p: &Vector2<f64>| table.signed_distance(p),
            size: 2.0,
        });
    }
}

#[test]
fn nothing_leaks_from_tables_in_space() {
    let mut random = Random(6);
    for entry in tables::all().iter().filter(|e| e.dimension() == 3) {
        let table = entry.spatial(&entry.typical()).unwrap();
        let starts = spatial_paths(entry, 1000, &mut random);
        let mut k = 0;
        table.with_walls(Bounce {
            name: entry.name,
            bounces: 100_000,
            start: || {
                k += 1;
                // off the axes, so that the slab is hit
                let path = starts[k % starts.len()];
                Line { point: path.point, velocity: SVector::from([0.3, 0.5, 0.7]) + path.velocity.normalize() * 0.1 }
            },
            distance: |p: &SVector<f64, 3>| table.signed_distance(p),
            size: 1.0,
        });
    }
}

/// That every path hits something, and before it is outside.
pub(super) struct AllHit<'a> {
    pub(super) name: &'a str,
    pub(super) table: &'a Table,
    pub(super) paths: &'a [Line<2>],
}

impl WithWalls<2> for AllHit<'_> {
    type Output = ();
    fn run<W: Walls<2>>(self, walls: &W) {
        for path in self.paths {
            let hit = walls.hit(path).unwrap_or_else(|| panic!("{}: {path:?} slips through", self.name));
            // the vertex is reached at time 1; at a re-entrant one the path may just pass
            let beyond = 1.0 + 1e-6;
            assert!(hit.time < beyond || self.table.contains(&path.at(beyond)), "{}: {path:?} {hit:?}", self.name);
        }
    }
}

#[test]
fn nothing_slips_through_between_neighbours() {
    let mut random = Random(7);
    for (name, table) in &planar() {
        let paths = aimed(table, &mut random);
        table.with_walls(AllHit { name, table, paths: &paths });
        AllHit { name, table, paths: &paths }.run(&table.list(0..table.pieces().len()));
    }
}
