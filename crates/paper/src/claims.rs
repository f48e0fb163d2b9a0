//! The registry of claims: one per file, in the order of the paper.
mod arc_survival;
mod circle_caustics;
mod circle_one_caustic;
mod circle_polygons;
mod collision_formula;
mod contact_lines;
mod corner_components;
mod equilateral;
mod equilateral_tree;
mod finite_groups;
mod flower;
mod grassmannians;
mod matrix_t;
mod mean_free_path;
mod measure_of_fields;
mod moon;
mod niven;
mod non_escape_area;
mod optimal_width;
mod parallel_sides;
mod period_two;
mod perturbed_pentagon;
mod planar_measure;
mod same_direction;
mod sinai_torus;
mod slab;
mod sliding_ladder;
mod special_angle;
mod strip_aperiodic;
mod strip_of_period_six;
mod strip_rotation;
mod strip_width;
mod wave_fronts;
mod wedge_all_gamma;
mod wedge_angle;
mod wedge_axis;
mod wedge_dense;
mod wedge_periods;
mod wedge_polygon;
mod wedge_repeat;

use crate::Claim;

/// Every claim, in the order of the paper; what goes beyond it comes last.
pub fn all() -> &'static [Claim] {
    const ALL: &[Claim] = &[
        grassmannians::CLAIM,
        measure_of_fields::CLAIM,
        planar_measure::CLAIM,
        corner_components::CLAIM,
        parallel_sides::CLAIM,
        sinai_torus::CLAIM,
        special_angle::CLAIM,
        collision_formula::CLAIM,
        matrix_t::CLAIM,
        strip_width::CLAIM,
        contact_lines::CLAIM,
        sliding_ladder::CLAIM,
        same_direction::CLAIM,
        slab::CLAIM,
        strip_rotation::CLAIM,
        niven::CLAIM,
        strip_aperiodic::CLAIM,
        optimal_width::CLAIM,
        wedge_axis::CLAIM,
        wedge_angle::CLAIM,
        wedge_periods::CLAIM,
        wedge_dense::CLAIM,
        non_escape_area::CLAIM,
        wedge_polygon::CLAIM,
        wedge_repeat::CLAIM,
        circle_caustics::CLAIM,
        circle_one_caustic::CLAIM,
        circle_polygons::CLAIM,
        arc_survival::CLAIM,
        equilateral::CLAIM,
        equilateral_tree::CLAIM,
        wave_fronts::CLAIM,
        perturbed_pentagon::CLAIM,
        flower::CLAIM,
        moon::CLAIM,
        strip_of_period_six::CLAIM,
        wedge_all_gamma::CLAIM,
        period_two::CLAIM,
        finite_groups::CLAIM,
        mean_free_path::CLAIM,
    ];
    ALL
}

/// The claim with a name.
pub fn find(name: &str) -> Option<&'static Claim> {
    all().iter().find(|claim| claim.name == name)
}

/// A statement of the paper that no claim measures.
#[derive(Clone, Copy, Debug)]
pub struct Unmeasured {
    /// Where it stands.
    pub place: &'static str,
    /// What it says, in our words.
    pub statement: &'static str,
    /// Why it is left out.
    pub reason: &'static str,
}

/// The statements of the paper that are left out, and why.
pub const UNMEASURED: &[Unmeasured] = &[
    Unmeasured {
        place: "Section 1",
        statement: "Generic polygons, with angles that are irrational multiples of π, are ergodic for standard billiards.",
        reason: "Not about no-slip billiards, and stated loosely: Kerckhoff, Masur and Smillie prove it for a dense Gδ set of polygons, not for \
                 each with such angles. No finite orbit could decide it.",
    },
    Unmeasured {
        place: "Section 1",
        statement: "The field of no-slip maps of a disk in the plane is parallel.",
        reason: "Derived: the boundary of its configurations is flat, a curve times a circle, and the rough direction makes the same angle with both \
                 everywhere. Nothing depends on it: see the claim measure-of-fields.",
    },
    Unmeasured {
        place: "Section 1, Figure 3",
        statement: "The phase space is typically the product of a 2-torus and a disk, and the reduced one a solid torus.",
        reason: "By definition, for a boundary that is one closed curve. With an inner wall, as in Figure 5 on the right, there is one for each curve.",
    },
    Unmeasured {
        place: "Section 3.1",
        statement: "Standard billiards in a circle, or another smooth convex curve, have a countably infinite family of periodic orbits for each period.",
        reason: "Not about no-slip billiards. (Those of the circle are the n-gons and star polygons of the claim circle-polygons, turned at will.)",
    },
    Unmeasured {
        place: "Section 3.3, Figure 18",
        statement: "In isosceles triangles, as in polygons, most orbits appear as closed curves around periodic points, as many as the period; there \
                    may be no ergodic component of positive measure.",
        reason: "An impression from pictures: see the figure isosceles. That no polygon is ergodic is the claim corner-components.",
    },
    Unmeasured {
        place: "Section 3.3, Figure 20",
        statement: "Orbits of the mushroom and of the moon linger along segments before they enter apparently chaotic regions.",
        reason: "An impression without a number to compare: see the figure portraits. The bounded part in the mushroom's stem is in the claim \
                 parallel-sides, those at the moon's corners in the claim moon.",
    },
];
