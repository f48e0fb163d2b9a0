//! Where the orbits of an ensemble start: each by its number alone.
use crate::{EnergyKeeper, Error, Orbit, Track};
use geometry::{Perimeter, Surface, Table, Vector2, Vector3};
use rand_chacha::{
    ChaCha8Rng,
    rand_core::{Rng, SeedableRng},
};

/// Where an orbit starts, or has come to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start<const N: usize, const S: usize> {
    /// Position of the centre \[L\].
    pub position: [f64; N],
    /// Velocity of the centre [L T⁻¹].
    pub velocity: [f64; N],
    /// Scaled spin [L T⁻¹].
    pub spin: [f64; S],
}

impl<const N: usize, const S: usize> Start<N, S> {
    /// The orbit that starts here.
    pub fn orbit<K: EnergyKeeper<f64, N, S>, T: Track<f64, N, S>>(self, track: T) -> Orbit<f64, N, S, K, T> {
        Orbit::new(self.position, self.velocity, self.spin, track)
    }
}

/// The starts of an ensemble: that of an orbit depends on its number and on nothing else, not on who runs it or when.
pub trait Starts<const N: usize, const S: usize>: Sync {
    /// The start of orbit number `i`.
    fn start(&self, i: u64) -> Start<N, S>;
}

/// The random numbers of one orbit: a stream of its own.
fn stream(seed: u64, i: u64) -> ChaCha8Rng {
    let mut stream = ChaCha8Rng::seed_from_u64(seed);
    stream.set_stream(i);
    stream
}

/// Uniform on [0, 1), in steps of 2⁻⁵³.
fn uniform(stream: &mut ChaCha8Rng) -> f64 {
    (stream.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

/// Uniform in the open unit ball of ℝᴺ: points of the cube until one lies in it.
fn in_unit_ball<const N: usize>(stream: &mut ChaCha8Rng) -> [f64; N] {
    loop {
        let point = [0.0; N].map(|_| 2.0 * uniform(stream) - 1.0);
        if point.iter().map(|x| x * x).sum::<f64>() < 1.0 {
            return point;
        }
    }
}

fn checked(speed: f64) -> Result<f64, Error> {
    if speed > 0.0 && speed.is_finite() { Ok(speed) } else { Err(Error::Speed { speed }) }
}

/// The start right after a collision, with `tangential` the velocities `(v₀, vₜ)` as fractions of the speed.
fn leaving(point: Vector2<f64>, normal: Vector2<f64>, [v0, vt]: [f64; 2], speed: f64) -> Start<2, 1> {
    let vn = (1.0 - (v0 * v0 + vt * vt)).max(0.0).sqrt();
    let velocity = (normal * vn + Vector2::new(-normal.y, normal.x) * vt) * speed;
    Start { position: point.into(), velocity: velocity.into(), spin: [v0 * speed] }
}

/// The canonical measure of a planar table, which the billiard map of every strict law preserves: position uniform by arc
/// length on the boundary, `(v₀, vₜ)/speed` uniform in the unit disk, velocity into the table.
///
/// ```
/// use billiards::{Canonical, Starts, geometry::tables};
///
/// let table = tables::stadium(1.0, 1.0)?;
/// let canonical = Canonical::new(&table, 1.0, 7)?;
/// let start = canonical.start(1_000_000);
/// assert_eq!(start, canonical.start(1_000_000));
/// let ([v1, v2], [v0]) = (start.velocity, start.spin);
/// assert!((v0 * v0 + v1 * v1 + v2 * v2 - 1.0).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Canonical<'a> {
    perimeter: Perimeter<'a>,
    speed: f64,
    seed: u64,
}

impl<'a> Canonical<'a> {
    /// Starts at `speed` \[L T⁻¹\], spin included.
    ///
    /// # Errors
    /// [`Error::Table`] for a boundary of infinite length, [`Error::Speed`] unless the speed is positive and finite.
    pub fn new(table: &'a Table, speed: f64, seed: u64) -> Result<Self, Error> {
        Ok(Canonical { perimeter: Perimeter::of(table)?, speed: checked(speed)?, seed })
    }
}

impl Starts<2, 1> for Canonical<'_> {
    fn start(&self, i: u64) -> Start<2, 1> {
        let mut stream = stream(self.seed, i);
        let at = self.perimeter.point(uniform(&mut stream));
        leaving(at.point, at.normal, in_unit_ball(&mut stream), self.speed)
    }
}

/// A regular grid over the reduced phase space of a planar table: one start in each cell, all cells of equal canonical measure.
///
/// `(s, v₀, vₜ)` are taken in arc length and polar coordinates `(v₀, vₜ) = speed · r (cos φ, sin φ)`, with `r²` and `φ` in equal
/// steps. Starts lie in the middle of `r²` and `φ`, and at the golden section of `s`: the middle of an arc would often be a vertex
/// where sides have lengths in simple ratios. Numbers from [`Grid::count`] on begin again.
#[derive(Clone, Debug)]
pub struct Grid<'a> {
    perimeter: Perimeter<'a>,
    speed: f64,
    /// Cells in arc length, `r²` and `φ`.
    cells: [u64; 3],
    /// Starts.
    count: u64,
}

/// `(√5 − 1)/2`: no fraction with a denominator `q` is nearer to it than some `1/(√5 q²)`.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

impl<'a> Grid<'a> {
    /// A grid of so many positions, radii and angles.
    ///
    /// # Errors
    /// Those of [`Canonical::new`], and [`Error::Grid`] without cells or with too many to count.
    pub fn new(table: &'a Table, speed: f64, cells: [u64; 3]) -> Result<Self, Error> {
        let [a, b, c] = cells;
        let count = a.checked_mul(b).and_then(|ab| ab.checked_mul(c));
        if count.is_none_or(|count| count == 0 || count >= 1 << 63) {
            return Err(Error::Grid);
        }
        Ok(Grid { perimeter: Perimeter::of(table)?, speed: checked(speed)?, cells, count: a * b * c })
    }

    /// `count` starts in a grid with at least as many cells, about as many each way; the cells that have none are far apart.
    ///
    /// # Errors
    /// Those of [`Grid::new`].
    pub fn with_count(table: &'a Table, speed: f64, count: u64) -> Result<Self, Error> {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below 2²²")]
        let side = libm::cbrt(count as f64) as u64;
        let mut cells = [side; 3];
        for i in 0..3 {
            if cells.iter().product::<u64>() < count {
                cells[i] += 1;
            }
        }
        Ok(Grid { count, ..Grid::new(table, speed, cells)? })
    }

    /// The number of starts.
    pub fn count(&self) -> u64 {
        self.count
    }
}

impl Starts<2, 1> for Grid<'_> {
    fn start(&self, i: u64) -> Start<2, 1> {
        let [arcs, radii, angles] = self.cells;
        #[allow(clippy::cast_possible_truncation, reason = "less than the number of cells")]
        let i = (u128::from(i % self.count) * u128::from(arcs * radii * angles) / u128::from(self.count)) as u64;
        let middle = |k: u64, of: u64| (k as f64 + 0.5) / of as f64;
        let at = self.perimeter.point(((i / (radii * angles)) as f64 + GOLDEN) / arcs as f64);
        let r = middle(i / angles % radii, radii).sqrt();
        let (sin, cos) = libm::sincos(core::f64::consts::TAU * middle(i % angles, angles));
        leaving(at.point, at.normal, [r * cos, r * sin], self.speed)
    }
}

/// The canonical measure of a ball on a table in space: position uniform by area on the boundary, tangential velocities
/// `(vₜ, W)/speed` uniform in the unit ball of ℝ⁵, velocity into the table.
///
/// The infinite slab looks the same everywhere: there the positions fill a square as wide as the slab is high.
#[derive(Clone, Debug)]
pub struct CanonicalSpatial<B> {
    boundary: B,
    speed: f64,
    seed: u64,
}

impl<B: Surface> CanonicalSpatial<B> {
    /// Starts on a `boundary`, such as a [named table](geometry::tables::SpatialTable) or the [surface](geometry::parry::Room::surface)
    /// of a room, at `speed` \[L T⁻¹\], spin included.
    ///
    /// # Errors
    /// [`Error::Speed`] unless the speed is positive and finite.
    pub fn new(boundary: B, speed: f64, seed: u64) -> Result<Self, Error> {
        Ok(CanonicalSpatial { boundary, speed: checked(speed)?, seed })
    }
}

impl<B: Surface> Starts<3, 3> for CanonicalSpatial<B> {
    fn start(&self, i: u64) -> Start<3, 3> {
        let mut stream = stream(self.seed, i);
        let (point, normal) = self.boundary.random_point(&mut || uniform(&mut stream));
        let [a, b, w @ ..] = in_unit_ball::<5>(&mut stream);
        let [t1, t2] = tangents(&normal);
        let vn = (1.0 - [a, b].iter().chain(&w).map(|x| x * x).sum::<f64>()).max(0.0).sqrt();
        let velocity = (normal * vn + t1 * a + t2 * b) * self.speed;
        Start { position: point.into(), velocity: velocity.into(), spin: w.map(|w| w * self.speed) }
    }
}

/// Two unit vectors that make an orthonormal frame with the unit vector `n`.
fn tangents(n: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let across = if n.x.abs() < 0.5 { Vector3::x() } else { Vector3::y() };
    let t = n.cross(&across);
    let t = t / t.norm();
    [t, n.cross(&t)]
}
