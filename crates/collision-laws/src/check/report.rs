//! What a check found: one number per axiom.

use std::fmt;

/// A defect larger than rounding can explain, for bodies of comparable size; for others, see [`tolerance`](super::tolerance).
///
/// A law that breaks an axiom by less than this, such as a restitution of 1 − 10⁻¹⁰, cannot be told from a strict one.
pub const TOLERANCE: f64 = 1e-9;

/// The properties of a strict collision map, and two that follow from them.
///
/// Defects are measured in the kinetic-energy metric, in which a velocity `v` has the length `|v|`. For a law they are the largest over
/// the sampled velocities; for a matrix they are Frobenius norms in unit coordinates, which bound these. The exception is
/// [`Measure`](Self::Measure), whose ratio at a velocity almost along the wall may be anything.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Axiom {
    /// Energy is conserved: `| |v⁺|² − |v|² | / |v|²`; of a matrix `‖CᵀC − 1‖`.
    Energy,
    /// Linear momentum is conserved: the part of `v⁺ − v` along the translations of the pair. Vacuous if a body is not [free](crate::Body::is_free).
    LinearMomentum,
    /// Angular momentum is conserved: the part of `v⁺ − v` along the rotations of the pair. Vacuous if a body is not [free](crate::Body::is_free).
    AngularMomentum,
    /// Reversibility: `|C C v − v| / |v|`; of a matrix `‖C² − 1‖`.
    Involution,
    /// Velocities that point out of configuration space come back into it: how far `v⁺` points out, over `|v|`; of a matrix
    /// `‖CᵀN̂ + c N̂‖` with the best `c ≥ 0`, zero exactly if C maps the one half space onto the other.
    OutgoingToIngoing,
    /// The impulse acts only at the contact: the part of `v⁺ − v` outside the impulse space `C_q = G⁻¹Jᵀℝᴺ`.
    ContactImpulse,
    /// `C(v + w) = C v + C w`. Always true of a matrix.
    Linearity,
    /// The canonical measure `|⟨v, N̂⟩| dq dv` is preserved: see [`Report::measure_ratio`]; of a matrix `‖ |det C| CᵀN̂ ± N̂ ‖` with the
    /// better sign, zero exactly if the ratio is 1 at every velocity.
    Measure,
}

impl Axiom {
    /// All of them, in the order of a report.
    pub const ALL: [Self; 8] = [
        Self::Energy,
        Self::LinearMomentum,
        Self::AngularMomentum,
        Self::Involution,
        Self::OutgoingToIngoing,
        Self::ContactImpulse,
        Self::Linearity,
        Self::Measure,
    ];
}

impl fmt::Display for Axiom {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Energy => "energy",
            Self::LinearMomentum => "linear momentum",
            Self::AngularMomentum => "angular momentum",
            Self::Involution => "involution",
            Self::OutgoingToIngoing => "outgoing to ingoing",
            Self::ContactImpulse => "impulse only at the contact",
            Self::Linearity => "linear in the velocity",
            Self::Measure => "invariant measure",
        })
    }
}

/// How far a law or a map is from each axiom, and a law from what it tells of itself.
///
/// `Display` writes a table with one line per axiom, and one for what the law tells of itself, if it does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Report {
    defects: [Option<f64>; Axiom::ALL.len()],
    measure_ratio: f64,
    told: Option<f64>,
}

/// Whether a defect is larger than another one; NaN is larger than any.
pub(super) fn worse(defect: f64, than: f64) -> bool {
    defect > than || defect.is_nan()
}

impl Report {
    pub(crate) const EMPTY: Self = Self { defects: [None; Axiom::ALL.len()], measure_ratio: 1.0, told: None };

    /// Records a defect, keeping the largest.
    pub(crate) fn note(&mut self, axiom: Axiom, defect: f64) {
        let kept = &mut self.defects[axiom as usize];
        if kept.is_none_or(|old| worse(defect, old)) {
            *kept = Some(defect);
        }
    }

    /// Records a measure ratio, keeping the one farthest from 1, and how far from 1 the ratios at other velocities are.
    pub(crate) fn note_measure_ratio(&mut self, ratio: f64, elsewhere: f64) {
        let defect = ((ratio - 1.0) * (ratio - 1.0) + elsewhere * elsewhere).sqrt();
        if self.defect(Axiom::Measure).is_none_or(|old| worse(defect, old)) {
            self.measure_ratio = ratio;
        }
        self.note(Axiom::Measure, defect);
    }

    /// Records how far an impulse is from what the law tells of it, keeping the largest.
    pub(super) fn note_told(&mut self, defect: f64) {
        if self.told.is_none_or(|old| worse(defect, old)) {
            self.told = Some(defect);
        }
    }

    /// How far the impulse is from the sum of the law's [reflections](crate::CollisionLaw::reflections), if it names any, and from the
    /// directions in which it [pushes](crate::CollisionLaw::pushes), relative to its length; `None` for a map, which tells nothing of
    /// itself.
    pub fn told(&self) -> Option<f64> {
        self.told
    }

    /// The defect of one axiom, or `None` if the axiom says nothing here.
    pub fn defect(&self, axiom: Axiom) -> Option<f64> {
        self.defects[axiom as usize]
    }

    /// The factor by which the collision multiplies the canonical measure: `|det DC(v)| · |⟨C v, N̂⟩| / |⟨v, N̂⟩|`, 1 for a strict law.
    /// For a law it is the sampled value farthest from 1, for a matrix the value at `v = N̂`.
    ///
    /// The whole differential of `(q, v) ↦ (q, C_q v)` is block triangular with blocks 1 and `DC`, so however the law varies over
    /// the boundary this is its determinant.
    pub fn measure_ratio(&self) -> f64 {
        self.measure_ratio
    }

    /// The axioms whose defect is not known to be within `tolerance`, each with its defect: all of them if `tolerance` is NaN. What the
    /// law tells of itself ([`Report::told`]) is no axiom.
    pub fn broken(&self, tolerance: f64) -> impl Iterator<Item = (Axiom, f64)> {
        let found = Axiom::ALL.into_iter().filter_map(|axiom| Some((axiom, self.defect(axiom)?)));
        found.filter(move |(_, defect)| !(*defect <= tolerance))
    }

    /// Whether every applicable axiom was tested, no defect exceeds `tolerance`, and a law is within it of what it tells of itself.
    /// Without any [sample](super::Samples) nothing was tested.
    pub fn is_strict(&self, tolerance: f64) -> bool {
        // the energy axiom applies to all bodies, walls and maps
        let kept = self.defect(Axiom::Energy).is_some() && self.broken(tolerance).next().is_none();
        kept && self.told.is_none_or(|defect| defect <= tolerance)
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for axiom in Axiom::ALL {
            match self.defect(axiom) {
                Some(defect) => writeln!(f, "{axiom:<28}{defect:.1e}")?,
                None => writeln!(f, "{axiom:<28}vacuous")?,
            }
        }
        self.told.map_or(Ok(()), |defect| writeln!(f, "{:<28}{defect:.1e}", "what it tells of itself"))
    }
}
