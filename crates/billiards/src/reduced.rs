//! The reduced phase space of a planar table, and the billiard map on it, both ways.
use crate::{
    Error,
    billiard::BallLaw,
    energy::{EnergyKeeper, square_speed},
    limit::Collisions,
    observe::ReducedPortrait,
    orbit::Orbit,
    planar::Planar,
    reverse::reverse,
    start::Start,
    track::Track,
};
use geometry::{Landing, Piece, Table, Vector2, WallHit};

/// A point of the boundary with the velocities right after a collision there, whatever the angle of the disk.
///
/// The reduced phase space is the solid torus (boundary) × (disk `v₀² + vₜ² < speed²`); the normal velocity is what the
/// speed leaves, `vₙ = √(speed² − v₀² − vₜ²)`. In `(s, v₀, vₜ)` at unit speed the canonical measure is Lebesgue measure, and
/// the billiard map of every strict law preserves it. Reference: Cox and Feres, *No-slip billiards in dimension two*, §1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReducedState {
    /// Number of the piece.
    pub piece: usize,
    /// Arc length along the piece \[L\], with the table on the left: from 0 to its length, on a closed curve modulo that. Lines and rays
    /// count from one of their points, lines in both directions and rays in one ([`Piece`]).
    pub s: f64,
    /// Scaled spin `v₀ = γ R θ̇` [L T⁻¹].
    pub v0: f64,
    /// Tangential velocity `vₜ = v·t`, `t = J ν` [L T⁻¹].
    pub vt: f64,
    /// The length of `(v₀, v)` [L T⁻¹], which strict laws conserve.
    pub speed: f64,
}

impl ReducedState {
    /// The state of an orbit right after the collision at `hit`.
    pub fn after<K, T>(table: &Table, hit: &WallHit<f64, 2>, orbit: &Orbit<f64, 2, 1, K, T>) -> ReducedState {
        let piece = hit.number();
        let (normal @ [n1, n2], [v1, v2]) = (hit.unit_normal(), orbit.velocity);
        ReducedState {
            piece,
            s: table.arc_length(piece, &Landing { point: hit.point.into(), normal: normal.into() }),
            v0: orbit.spin[0],
            vt: v2 * n1 - v1 * n2,
            speed: square_speed(&orbit.velocity, &orbit.spin).sqrt(),
        }
    }

    /// The same at unit speed: the point of the paper's solid torus.
    #[must_use]
    pub fn at_unit_speed(self) -> ReducedState {
        ReducedState { v0: self.v0 / self.speed, vt: self.vt / self.speed, speed: 1.0, ..self }
    }

    /// Arc length along the whole boundary, from the start of piece 0, all pieces laid end to end; then `v₀` and `vₜ`. Beyond a piece of
    /// infinite length, such as the first wall of a strip, it is infinite and identifies no place: there `piece` and `s` do.
    pub fn coordinates(&self, table: &Table) -> [f64; 3] {
        let before: f64 = table.pieces().iter().take(self.piece).map(geometry::Piece::length).sum();
        [before + self.s, self.v0, self.vt]
    }

    /// The state with these [coordinates](Self::coordinates), at a speed.
    ///
    /// ```
    /// use billiards::{ReducedState, geometry::tables};
    ///
    /// let square = tables::square(1.0)?;
    /// let state = ReducedState::from_coordinates(&square, [2.25, 0.5, -0.25], 1.0)?;
    /// assert_eq!((state.piece, state.s), (2, 0.25));
    /// assert_eq!(state.coordinates(&square), [2.25, 0.5, -0.25]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::ArcLength`] before the start or beyond the end of the boundary.
    pub fn from_coordinates(table: &Table, [s, v0, vt]: [f64; 3], speed: f64) -> Result<ReducedState, Error> {
        let (piece, s) = table.piece_at(s);
        let state = ReducedState { piece, s, v0, vt, speed };
        state.arc_length_along(&*table.pieces()[piece])?;
        Ok(state)
    }

    /// The orbit that starts in this state.
    ///
    /// # Errors
    /// Those of [`ReducedState::start`].
    pub fn orbit<K, T>(&self, table: &Table, track: T) -> Result<Orbit<f64, 2, 1, K, T>, Error>
    where
        K: EnergyKeeper<f64, 2, 1>,
        T: Track<f64, 2, 1>,
    {
        Ok(self.start(table)?.orbit(track))
    }

    /// The state as a start, for an ensemble.
    ///
    /// # Errors
    /// [`Error::Piece`] if the table has no such piece, [`Error::ArcLength`] if `s` is beyond its ends, [`Error::Tangential`] unless
    /// `v₀² + vₜ² < speed²`.
    pub fn start(&self, table: &Table) -> Result<Start<2, 1>, Error> {
        let Landing { point, normal } = self.landing(table)?;
        let &ReducedState { v0, vt, speed, .. } = self;
        let tangential = libm::hypot(v0, vt);
        if !(tangential < speed && speed.is_finite()) {
            return Err(Error::Tangential { v0, vt, speed });
        }
        // in a power of two next to the speed, so that the product stays in the range of numbers
        let (_, exponent) = libm::frexp(speed);
        let [all, along] = [speed, tangential].map(|x| libm::ldexp(x, -exponent));
        let vn = libm::ldexp(((all - along) * (all + along)).sqrt(), exponent);
        let velocity = normal * vn + Vector2::new(-normal.y, normal.x) * vt;
        Ok(Start { position: point.into(), velocity: velocity.into(), spin: [v0] })
    }

    /// The point of the boundary and the normal there; on a lattice in its cell.
    fn landing(&self, table: &Table) -> Result<Landing, Error> {
        let pieces = table.pieces();
        let piece = pieces.get(self.piece).ok_or(Error::Piece { piece: self.piece, pieces: pieces.len() })?;
        Ok(table.landing_on(&**piece, self.arc_length_on(&**piece)?))
    }

    /// `s`, if the piece has such an arc length; that of a closed curve is reduced to its length.
    fn arc_length_on(&self, piece: &dyn Piece) -> Result<f64, Error> {
        let (s, length) = (self.s, piece.length());
        if piece.ends().is_none() && s.is_finite() && length.is_finite() {
            return Ok(if (0.0..=length).contains(&s) { s } else { s - libm::floor(s / length) * length });
        }
        self.arc_length_along(piece)
    }

    /// `s`, if it is between the ends of the piece or, along a closed curve, between 0 and its length.
    fn arc_length_along(&self, piece: &dyn Piece) -> Result<f64, Error> {
        let (s, length) = (self.s, piece.length());
        let [from, to] = match piece.ends() {
            None => [0.0, length],
            Some(ends) => {
                let [starts, stops] = ends.map(|end| end.iter().all(|x| x.is_finite()));
                [if starts { 0.0 } else { -f64::INFINITY }, if starts || !stops { length } else { 0.0 }]
            }
        };
        let slack = if length.is_finite() { LENGTHS * length } else { 0.0 };
        if s.is_finite() && from - slack <= s && s <= to + slack {
            Ok(s)
        } else {
            Err(Error::ArcLength { piece: self.piece, s, from, to })
        }
    }

    /// What an orbit in this state has just hit.
    fn hit(&self, table: &Table) -> Result<WallHit<f64, 2>, Error> {
        let Landing { point, normal } = self.landing(table)?;
        Ok(WallHit { time: 0.0, normal: normal.into(), piece: self.piece as f64, ..WallHit::never(point.into()) })
    }
}

/// Arc lengths are known to this part of the length of a piece.
const LENGTHS: f64 = 1e-12;

/// What rounding may leave of `R R − 1`, as a fraction of the speed: a law of a point that spins loses half of its digits.
const REVERSIBLE: f64 = 1e-6;

impl<L: BallLaw<2, 1>> Planar<L> {
    /// The billiard map `T`: from right after one collision to right after the next.
    ///
    /// ```
    /// use billiards::{Planar, ReducedState, laws::Disk};
    /// use billiards::{collision_laws::laws::NoSlip, geometry::tables};
    ///
    /// let square = Planar { table: tables::square(1.0)?, law: Disk::new(&NoSlip, 1.0)? };
    /// let start = ReducedState { piece: 0, s: 0.5, v0: 0.0, vt: -0.25, speed: 1.0 }; // to the right
    /// let next = square.map(&start)?;
    /// assert_eq!((next.piece, next.v0, next.vt), (2, 0.25, 0.0)); // straight back, spinning
    /// let back = square.inverse(&next)?;
    /// assert!((back.s - start.s).abs() < 1e-15 && (back.vt - start.vt).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Ended`] where there is no next collision, and those of [`ReducedState::start`].
    pub fn map(&self, state: &ReducedState) -> Result<ReducedState, Error> {
        let mut orbit = state.orbit::<(), ()>(&self.table, ())?;
        let mut portrait = ReducedPortrait::new(&self.table, vec![]);
        let outcome = self.run(&mut orbit, &Collisions(1), &mut portrait);
        portrait.into_states().pop().ok_or(Error::Ended { stop: outcome.stop })
    }

    /// The inverse billiard map `T⁻¹ = R T R` of a law that is an involution, as strict laws are; see [`reverse()`].
    ///
    /// # Errors
    /// Those of [`Planar::map`] and [`Planar::reverse`].
    pub fn inverse(&self, state: &ReducedState) -> Result<ReducedState, Error> {
        self.reverse(&self.map(&self.reverse(state)?)?)
    }

    /// The time reversal `R(x, v⁺) = (x, −C v⁺)`.
    ///
    /// # Errors
    /// Those of [`ReducedState::start`], and [`Error::Irreversible`] unless `R R` leads back to this state within 10⁻⁶ of the speed.
    pub fn reverse(&self, state: &ReducedState) -> Result<ReducedState, Error> {
        let hit = state.hit(&self.table)?;
        let mut orbit = state.orbit::<(), ()>(&self.table, ())?;
        let before = orbit;
        reverse(&self.law, &mut orbit, &hit);
        let mut again = orbit;
        reverse(&self.law, &mut again, &hit);
        let off = [0, 1].map(|i| again.velocity[i] - before.velocity[i]);
        let defect = libm::hypot(again.spin[0] - before.spin[0], libm::hypot(off[0], off[1])) / state.speed;
        if !(defect <= REVERSIBLE) {
            return Err(Error::Irreversible { defect });
        }
        Ok(ReducedState { s: state.s, ..ReducedState::after(&self.table, &hit, &orbit) })
    }
}
