//! What can be wrong with a body, a contact or a law when it is built.

/// Bad input to this crate, found at construction.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A mass, radius, inertia or `γ²` that is zero, negative, infinite or NaN.
    #[error("{quantity} must be positive and finite, not {value:?}")]
    NotPositive {
        /// What was given, in words.
        quantity: &'static str,
        /// Its value.
        value: f64,
    },
    /// A quantity below 2.3e-308, where numbers have fewer digits.
    #[error(
        "{quantity} is {value:?}, so small that it loses digits: choose units of mass or length in which it is larger"
    )]
    TooSmall {
        /// Which quantity, in words.
        quantity: &'static str,
        /// Its value.
        value: f64,
    },
    /// A quantity beyond 1.8e308, the largest number.
    #[error(
        "{quantity} is beyond the range of floating-point numbers: choose units of mass or length in which it is smaller"
    )]
    TooLarge {
        /// Which quantity, in words.
        quantity: &'static str,
    },
    /// A vector or matrix with an infinite or NaN entry.
    #[error("{quantity} has an entry that is not a finite number")]
    NotFinite {
        /// What was given, in words.
        quantity: &'static str,
    },
    /// A normal of length zero.
    #[error("the normal of the contact plane has no direction: its length is zero")]
    NoNormal,
    /// An inertia tensor or second-moment matrix that differs from its transpose.
    #[error("{quantity} is not symmetric: an entry differs from its mirror image by {defect:?}")]
    InertiaNotSymmetric {
        /// Which of the two, in words.
        quantity: &'static str,
        /// Largest `|Aᵢⱼ − Aⱼᵢ|`.
        defect: f64,
    },
    /// An inertia that lets the body spin for free in some plane.
    #[error("the inertia is not positive: the moment in one plane of rotation is {smallest:?}")]
    InertiaNotPositive {
        /// The smallest principal moment of inertia about a 2-plane.
        smallest: f64,
    },
    /// Second moments of a rank below N−1, with which the body spins for free in some plane.
    #[error(
        "S, the second moments, has too low a rank: it is zero along two axes, so the body has no inertia for rotation in their plane"
    )]
    SecondMomentsOfLowRank,
    /// An inertia that lets the body spin all but for free in some plane: to working precision its moment there is zero.
    #[error(
        "the principal moments of inertia range from {smallest:?} to {largest:?}: the smallest is lost in rounding unless it is more \
         than 2.2e-16 times the largest; make the body thicker"
    )]
    InertiaLost {
        /// The smallest principal moment of inertia about a 2-plane.
        smallest: f64,
        /// The largest.
        largest: f64,
    },
    /// Second moments that no distribution of mass has.
    #[error(
        "the second moments are not positive: {smallest:?} along one axis, though each is an integral of squares over the body"
    )]
    SecondMomentsNotPositive {
        /// The smallest eigenvalue.
        smallest: f64,
    },
    /// An inertia given in a form meant for another dimension.
    #[error("{form} describes a body in dimension {expected}, not {dimension}")]
    InertiaForm {
        /// The form that was given, in words.
        form: &'static str,
        /// The dimension that form belongs to.
        expected: usize,
        /// The dimension of the body.
        dimension: usize,
    },
    /// An angular velocity matrix that is not skew.
    #[error("the spin is not skew-symmetric: an entry and its mirror image add up to {defect:?}")]
    SpinNotSkew {
        /// Largest `|Ωᵢⱼ + Ωⱼᵢ|`.
        defect: f64,
    },
    /// The wrong number of coordinates or of rows and columns.
    #[error("{quantity} has {given} entries where {expected} are needed")]
    WrongLength {
        /// What was given, in words.
        quantity: &'static str,
        /// How many entries it has.
        given: usize,
        /// How many it must have.
        expected: usize,
    },
    /// More rough directions than the contact plane has dimensions.
    #[error("{given} rough directions are too many: the contact plane has dimension {most}")]
    TooManyRoughDirections {
        /// How many were given.
        given: usize,
        /// The dimension N−1 of the contact plane.
        most: usize,
    },
    /// A rough direction that is the normal, or zero, up to rounding.
    #[error("rough direction {index} is along the normal or zero: it has no component in the contact plane")]
    RoughDirectionAlongNormal {
        /// Its position in the list, from 0.
        index: usize,
    },
    /// A rough direction that the others and the normal span already.
    #[error("rough direction {index} depends linearly on the normal and the others")]
    DependentRoughDirections {
        /// Its position in the list, from 0.
        index: usize,
    },
    /// A coefficient of restitution outside its range.
    #[error("the {which} restitution must lie in [{least}, 1], not {value:?}")]
    RestitutionOutOfRange {
        /// `"normal"` or `"tangential"`.
        which: &'static str,
        /// The lower end of its range: 0 (normal) or −1 (tangential).
        least: f64,
        /// The value given.
        value: f64,
    },
    /// Two fixed bodies: nothing can move.
    #[error("both bodies are fixed: there is nothing to collide")]
    BothFixed,
    /// Two bodies that move apart, or slide, at the contact.
    #[error("the bodies are not approaching: the normal contact velocity is {normal_velocity:?}")]
    NotApproaching {
        /// `u·ν`, negative for bodies that approach.
        normal_velocity: f64,
    },
    /// A Delassus operator that rounding has made singular, on the directions in which the law pushes.
    #[error(
        "the inverse contact mass is singular to working precision: body {body} has too little inertia for its lever arm, or is \
         too heavy to move, or cannot move in a direction in which the law pushes"
    )]
    SingularDelassus {
        /// Whose inverse contact mass is the larger: 1 or 2.
        body: usize,
    },
}
