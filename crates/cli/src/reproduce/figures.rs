//! The registry of figures, one per file, in the order of the paper.
mod astroid;
mod circle_caustics;
mod circle_velocities;
mod collision_cone;
mod dispersing_torus;
mod equilateral;
mod equilateral_tree;
mod free_paths;
mod hexagon;
mod isosceles;
mod period_two;
mod perturbed_pentagon;
mod portraits;
mod solid_torus;
mod spin_exchange;
mod stadium;
mod strip;
mod strip_periodic;
mod strip_rotation;
mod velocity_spheres;
mod wave_fronts;
mod wedge_angle;
mod wedge_axis;
mod wedge_chart;
mod wedge_period_eight;
mod wedges;

use super::Figure;

/// Every figure, in the order of the paper; what goes beyond it comes last.
pub fn all() -> &'static [Figure] {
    const ALL: &[Figure] = &[
        spin_exchange::FIGURE,
        collision_cone::FIGURE,
        solid_torus::FIGURE,
        hexagon::FIGURE,
        stadium::FIGURE,
        dispersing_torus::FIGURE,
        strip::FIGURE,
        strip_rotation::FIGURE,
        astroid::FIGURE,
        wedges::FIGURE,
        wedge_axis::FIGURE,
        wedge_angle::FIGURE,
        wedge_period_eight::FIGURE,
        velocity_spheres::FIGURE,
        circle_caustics::FIGURE,
        circle_velocities::FIGURE,
        equilateral::FIGURE,
        equilateral_tree::FIGURE,
        isosceles::FIGURE,
        wave_fronts::FIGURE,
        portraits::FIGURE,
        perturbed_pentagon::FIGURE,
        strip_periodic::FIGURE,
        period_two::FIGURE,
        wedge_chart::FIGURE,
        free_paths::FIGURE,
    ];
    ALL
}
