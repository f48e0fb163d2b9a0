//! The registry of claims: one per file, in the order of the paper.
mod special_angle;
mod strip_width;

use crate::Claim;

/// Every claim, in the order of the paper; what goes beyond it comes last.
pub fn all() -> &'static [Claim] {
    const ALL: &[Claim] = &[special_angle::CLAIM, strip_width::CLAIM];
    ALL
}

/// The claim with a name.
pub fn find(name: &str) -> Option<&'static Claim> {
    all().iter().find(|claim| claim.name == name)
}
