//! Every hit and every collision is right to a few units of rounding; `examples/exactness.rs` prints the histograms.
mod oracle;

use oracle::errors::{Errors, measure};
use oracle::rays::{Kind, Random};
use oracle::solids::{self, each_room};
use oracle::subjects::{FRAMES, Frame, each};

/// Rays per kind at each piece: enough to find what is wrong in one case of a hundred.
const RAYS: usize = 25;

fn check(frames: &[Frame], mut random: Random) {
    let mut broken = vec![];
    for frame in frames {
        let kinds = if frame.name == "plain" { &[Kind::Any, Kind::Grazing, Kind::Vertex][..] } else { &[Kind::Any] };
        each(frame, |subject| {
            let mut errors = Errors::default();
            for kind in kinds {
                errors.merge(measure(subject, *kind, RAYS, &mut random));
            }
            let measured = errors.steep[0].count() + errors.grazing[0].count();
            assert!(
                measured + errors.at_vertices + errors.undecided > 0,
                "{}, {}: nothing was measured",
                subject.name,
                frame.name
            );
            broken.extend(errors.broken().into_iter().map(|what| format!("{}, {}: {what}", subject.name, frame.name)));
        })
        .unwrap();
    }
    assert!(broken.is_empty(), "{broken:#?}");
}

#[test]
fn hits_and_collisions_are_right_to_a_few_ulp_on_every_piece_and_every_wall() {
    check(&FRAMES[..1], Random(20));
}

#[test]
fn they_are_so_on_huge_and_tiny_tables_and_far_from_the_origin() {
    check(&FRAMES[1..], Random(22));
}

fn check_in_space(frames: &[Frame], mut random: Random) {
    let mut broken = vec![];
    for frame in frames {
        let kinds = if frame.name == "plain" { &[Kind::Any, Kind::Grazing, Kind::Vertex][..] } else { &[Kind::Any] };
        each_room(frame, |room| {
            let mut errors = Errors::default();
            for kind in kinds {
                errors.merge(solids::measure(room, *kind, RAYS, &mut random));
            }
            let measured = errors.steep[0].count();
            assert!(4 * measured >= RAYS, "{}, {}: {measured} rays were measured", room.name, frame.name);
            broken.extend(errors.broken().into_iter().map(|what| format!("{}, {}: {what}", room.name, frame.name)));
        })
        .unwrap();
    }
    assert!(broken.is_empty(), "{broken:#?}");
}

#[test]
fn hits_and_collisions_in_space_are_right_to_a_few_ulp_on_every_wall() {
    check_in_space(&FRAMES[..1], Random(21));
}

#[test]
fn those_in_space_are_so_in_huge_and_tiny_rooms_and_far_from_the_origin() {
    check_in_space(&FRAMES[1..], Random(23));
}
