//! What formulas must do to bound a table.
use std::fmt;

/// What the zeros of a formula `f(x, y)` must do ([`Error::Curve`](super::Error::Curve)).
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
#[non_exhaustive]
pub enum ImplicitRule {
    /// To be smooth: `∇f ≠ 0` on them, and they can be traced by chords.
    Smooth,
    /// To bend nowhere within some billionths of the box that is searched: they are traced by chords of its size.
    Wide,
    /// To lie in the box that is searched.
    InItsBox,
    /// To be one closed curve and nothing else.
    Alone,
}

impl fmt::Display for ImplicitRule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            ImplicitRule::Smooth => "be smooth, with a gradient that is not 0",
            ImplicitRule::Wide => {
                "be smooth, with no bend as narrow as 1e-8 of its box, which should end close to the curve"
            }
            ImplicitRule::InItsBox => "stay in its box",
            ImplicitRule::Alone => "be the only one in its box",
        })
    }
}

/// What the points `c(t)` of a curve must do ([`Error::Parametrised`](super::Error::Parametrised)).
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
#[non_exhaustive]
pub enum ParametricRule {
    /// To end where they start.
    Closed,
    /// To be finite.
    Finite,
    /// To have a bounded derivative `c′`.
    FiniteRate,
    /// To have `c′ ≠ 0`, except at simple cusps.
    Moving,
    /// To be smooth except for kinks that are not too many and can be separated from their
    /// surroundings.
    FewKinks,
    /// To be smooth between kinks and cusps, with no bend as narrow as the rounding of their coordinates.
    Smooth,
}

impl fmt::Display for ParametricRule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            ParametricRule::Closed => "come back to where it starts",
            ParametricRule::Finite => "be finite",
            ParametricRule::FiniteRate => "have finite derivatives x' and y'",
            ParametricRule::Moving => {
                "not stand still, with x' and y' both 0, except at the tip of a cusp like that of (t^2, t^3)"
            }
            ParametricRule::FewKinks => {
                "be smooth except at some kinks, with no bend confined to less than a thousandth of its range"
            }
            ParametricRule::Smooth => {
                "be smooth, with no bend as narrow as rounding, like the tips of an ellipse with semi-axes 1 and 1e-8; a wall \
                 without thickness is a loop there and back"
            }
        })
    }
}
