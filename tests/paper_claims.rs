//! Every claim of the paper, one test each: our verdict agrees with what is measured.
//!
//! The sample sizes are the quick ones of the crate `paper`; the seeds are fixed. Sampled numbers agree within five standard errors, a false alarm of
//! 6·10⁻⁷ each if the seeds were drawn anew; rounding has its bound and its reason beside each measurement.
use paper::{Effort, Verdict, claims};

/// A test that a claim's measurement is consistent with its verdict, which is this one.
macro_rules! claims {
    ($($test:ident: $name:literal => $verdict:pat,)*) => {
        $(
            #[test]
            fn $test() {
                let claim = claims::find($name).expect("a claim of that name");
                let measurement = claim.measure(Effort::Quick);
                assert!(measurement.is_consistent(), "{} ({}):\n{measurement}", claim.name, claim.place);
                assert!(matches!(claim.verdict, $verdict), "{} is {}", claim.name, claim.verdict.name());
            }
        )*

        #[test]
        fn every_claim_has_its_test() {
            let tested = [$($name),*];
            let untested: Vec<_> = claims::all().iter().map(|claim| claim.name).filter(|name| !tested.contains(name)).collect();
            assert!(untested.is_empty(), "{untested:?}");
        }
    };
}

claims! {
    strict_collision_maps_are_the_grassmannians_and_two_in_the_plane: "grassmannians" => Verdict::Holds,
    every_field_of_strict_laws_preserves_the_measure_and_nonlinear_laws_do_not: "measure-of-fields" => Verdict::HoldsCorrected(_),
    planar_no_slip_billiards_preserve_the_canonical_measure: "planar-measure" => Verdict::Holds,
    no_polygon_is_ergodic_because_its_corners_hold_orbits: "corner-components" => Verdict::HoldsCorrected(_),
    orbits_between_parallel_sides_stay_if_and_only_if_their_width_fits: "parallel-sides" => Verdict::Holds,
    sinai_torus_has_a_bounded_component_however_small_its_disk: "sinai-torus" => Verdict::Holds,
    the_special_angle_has_cosine_one_third: "special-angle" => Verdict::Holds,
    the_collision_formula_is_the_rigid_body_law: "collision-formula" => Verdict::HoldsCorrected(_),
    matrix_t_belongs_to_the_downward_normal: "matrix-t" => Verdict::HoldsCorrected(_),
    strip_orbits_are_sqrt3_ell_wide_not_the_papers_constant: "strip-width" => Verdict::HoldsCorrected(_),
    contact_points_of_a_strip_lie_on_lines_of_slope_sqrt2: "contact-lines" => Verdict::HoldsCorrected(_),
    flights_of_a_strip_touch_a_parallel_curve_of_an_astroid: "sliding-ladder" => Verdict::HoldsCorrected(_),
    at_most_three_flights_of_a_strip_in_a_row_go_the_same_way: "same-direction" => Verdict::Holds,
    balls_between_planes_are_bounded_with_contact_lines_of_slope_sqrt_five_halves: "slab" => Verdict::Holds,
    two_collisions_in_a_strip_turn_the_velocity_by_two_beta: "strip-rotation" => Verdict::Holds,
    rational_cosines_of_rational_angles_are_five: "niven" => Verdict::Holds,
    strip_angle_is_arccos_of_minus_seven_ninths_and_no_orbit_returns: "strip-aperiodic" => Verdict::HoldsCorrected(_),
    strip_width_is_reached_on_one_side_only: "optimal-width" => Verdict::HoldsCorrected(_),
    wedge_axis_spins_with_sine_of_half_the_angle_over_gamma: "wedge-axis" => Verdict::HoldsCorrected(_),
    wedge_angle_and_turn_are_related_by_the_papers_quartic: "wedge-angle" => Verdict::HoldsCorrected(_),
    period_two_n_of_a_wedge_needs_a_turn_by_two_pi_m_over_n: "wedge-periods" => Verdict::HoldsCorrected(_),
    periodic_wedge_angles_are_dense: "wedge-dense" => Verdict::HoldsCorrected(_),
    velocities_that_never_escape_vanish_at_pi_and_are_0_842_at_half_pi: "non-escape-area" => Verdict::HoldsCorrected(_),
    non_escape_velocities_form_a_polygon_with_q_sides: "wedge-polygon" => Verdict::HoldsCorrected(_),
    repeated_velocities_in_a_wedge_repeat_the_place_but_not_the_spin_position: "wedge-repeat" => Verdict::HoldsCorrected(_),
    circles_have_two_alternating_caustics: "circle-caustics" => Verdict::HoldsCorrected(_),
    orbits_of_a_circle_with_one_caustic_are_two_families: "circle-one-caustic" => Verdict::HoldsCorrected(_),
    regular_polygons_are_orbits_of_the_circle: "circle-polygons" => Verdict::HoldsCorrected(_),
    orbits_leave_every_arc_with_survival_of_one_over_n: "arc-survival" => Verdict::False(_),
    equilateral_triangle_has_periods_four_and_six_and_its_spin_position_drifts: "equilateral" => Verdict::HoldsCorrected(_),
    equilateral_triangle_has_three_cycles_of_sides: "equilateral-tree" => Verdict::Holds,
    no_slip_fronts_grow_less_than_smooth_ones: "wave-fronts" => Verdict::Holds,
    perturbed_pentagons_keep_regular_motion: "perturbed-pentagon" => Verdict::Holds,
    petals_of_a_flower_hold_no_orbits: "flower" => Verdict::False(_),
    corners_of_a_moon_hold_orbits: "moon" => Verdict::Holds,
    strips_are_periodic_for_rational_beta: "strip-of-period-six" => Verdict::Holds,
    the_wedge_is_solved_for_every_gamma: "wedge-all-gamma" => Verdict::Holds,
    period_two_orbits_are_elliptic_below_a_gap_that_grows_with_their_angle: "period-two-stability" => Verdict::Holds,
    finite_velocity_groups_give_finitely_many_velocities: "finite-groups" => Verdict::Holds,
    mean_free_paths_are_four_a_over_p_for_both_laws: "mean-free-path" => Verdict::Holds,
}

#[test]
fn measurements_have_the_same_bits_every_time() {
    for name in ["equilateral", "mean-free-path", "wedge-polygon"] {
        let claim = claims::find(name).expect("a claim of that name");
        let bits =
            || -> Vec<u64> { claim.measure(Effort::Quick).quantities.iter().map(|q| q.measured.to_bits()).collect() };
        assert_eq!(bits(), bits(), "{name}");
    }
}
