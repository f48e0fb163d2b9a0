//! Rays that a billiard meets, and rays that are meant to break it.
use billiards::geometry::{Line, Piece, Vector2, Vector3};
use core::f64::consts::PI;

/// `SplitMix64` [Steele, Lea, Flood 2014]: the same rays on every machine.
#[derive(Clone, Debug)]
pub(crate) struct Random(pub u64);

impl Random {
    /// Uniform on [0, 1).
    pub(crate) fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
    pub(crate) fn between(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * self.uniform()
    }
    pub(crate) fn sign(&mut self) -> f64 {
        if self.uniform() < 0.5 { -1.0 } else { 1.0 }
    }
    /// `10^[a, b)`, uniform in the exponent.
    pub(crate) fn decade(&mut self, a: f64, b: f64) -> f64 {
        libm::pow(10.0, self.between(a, b))
    }
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small index")]
    pub(crate) fn below(&mut self, count: usize) -> usize {
        ((self.uniform() * count as f64) as usize).min(count - 1)
    }
}

/// What makes a ray nasty.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Nothing: any point of the boundary is hit at any angle.
    Any,
    /// The angle to the wall is 10⁻¹² … 10⁻¹.
    Grazing,
    /// The path ends within 10⁻¹⁶ … 10⁻³ of a vertex, in space of an edge.
    Vertex,
}

/// A ray aimed at a piece of a boundary from its table's side; `size` is that of the table.
pub(crate) fn aimed(piece: &dyn Piece, size: f64, kind: Kind, random: &mut Random) -> Line<2> {
    let reach = if piece.length().is_finite() { piece.length() } else { 10.0 * size };
    let mut s = reach * random.uniform();
    if kind == Kind::Vertex
        && let Some(ends) = piece.ends()
    {
        // of a ray only one end is near
        let near: Vec<Vector2<f64>> = ends.into_iter().filter(|end| end.iter().all(|x| x.is_finite())).collect();
        if !near.is_empty() {
            s = piece.arc_length_at(&near[random.below(near.len())])
                + random.sign() * size * random.decade(-16.0, -3.0);
        }
    }
    // infinite pieces are measured from an end or from any point, with either sign
    if !piece.length().is_finite() && piece.arc_length_at(&piece.point_at(s)) == 0.0 {
        s = -s;
    }
    let foot = piece.point_at(s);
    let normal = piece.closest(&foot).normal;
    let tangent = Vector2::new(normal.y, -normal.x);
    let angle = match kind {
        Kind::Grazing => random.decade(-12.0, -1.0),
        _ => random.between(0.01, PI - 0.01),
    };
    let direction = tangent * (libm::cos(angle) * random.sign()) - normal * libm::sin(angle);
    // towards the wall for not longer than a chord
    let curvature = piece.curvature(&foot);
    let chord = if curvature > 0.0 { 2.0 * libm::sin(angle) / curvature } else { size };
    let way = chord.min(size) * random.uniform();
    Line { point: foot - direction * way, velocity: direction * random.decade(-1.0, 1.0) }
}

/// A ray aimed at a place of a wall in space, `size` being that of the table.
pub(crate) fn aimed_in_space(foot: &Foot, size: f64, kind: Kind, random: &mut Random) -> Line<3> {
    let normal = foot.normal;
    // any direction along the wall
    let any = Vector3::from_fn(|_, _| random.between(-1.0, 1.0));
    let tangent = normal.cross(&any).normalize();
    let angle = match kind {
        Kind::Grazing => random.decade(-12.0, -1.0),
        _ => random.between(0.01, PI - 0.01),
    };
    let direction = tangent * libm::cos(angle) - normal * libm::sin(angle);
    let chord = if foot.curvature > 0.0 { 2.0 * libm::sin(angle) / foot.curvature } else { size };
    let way = chord.min(size) * random.uniform();
    Line { point: foot.point - direction * way, velocity: direction * random.decade(-1.0, 1.0) }
}

/// A place of a wall in space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Foot {
    pub(crate) point: Vector3<f64>,
    /// Unit normal into the table.
    pub(crate) normal: Vector3<f64>,
    /// The greatest curvature, positive where focusing.
    pub(crate) curvature: f64,
}
