//! How exact is one collision?
//!
//! Hit time, position, normal and outgoing velocity of every kind of piece and of composite walls, against an oracle that knows
//! each piece as a parametrised curve, each body in space as an intersection of convex functions, and brackets roots in 200 bits.
//! Errors are in units of rounding (ulp of the table's size). Expected: median ½, of velocities 1½, and worst 8 away from grazing;
//! at grazing no more than that times the conditioning, 1/sin of the angle to the wall; and never a wrong piece away from a
//! vertex.
//!
//! `cargo run --release --example exactness -- 3000` for three thousand rays of each kind at each piece; the default is twenty-five.
//! `-- 3000 cone` for those pieces only whose names contain `cone`.
#[path = "../tests/oracle/mod.rs"]
mod oracle;

use billiards::geometry::Error;
use oracle::errors::{Errors, QUANTITIES, STEEP, measure};
use oracle::rays::{Kind, Random};
use oracle::solids::{self, each_room};
use oracle::subjects::{FRAMES, each};

/// How many errors are at most ½, then 1, 2, 4, 8, and more than 8.
fn classes(values: &[f64]) -> [usize; 6] {
    let mut classes = [0; 6];
    for value in values {
        classes[[0.5, 1.0, 2.0, 4.0, 8.0].iter().filter(|bound| value > *bound).count()] += 1;
    }
    classes
}

/// Prints the errors of a subject.
fn print(name: &str, errors: &Errors) {
    println!("{name}");
    for (class, histograms) in [(">", &errors.steep), ("<", &errors.grazing)] {
        for (quantity, histogram) in QUANTITIES.iter().zip(histograms).filter(|(_, h)| h.count() > 0) {
            let (median, worst) = (histogram.median(), histogram.worst());
            let conditioned = if class == "<" { "× sin " } else { "" };
            let name = format!("{conditioned}{quantity}, sin {class} {STEEP}");
            println!("  {name:<42}{median:>7.2} {worst:>9.2}  | {:?}", classes(&histogram.values));
        }
    }
}

fn main() -> Result<(), Error> {
    let mut arguments = std::env::args().skip(1);
    let count = arguments.next().and_then(|count| count.parse().ok()).unwrap_or(25);
    let wanted = arguments.next().unwrap_or_default();
    let (mut rays, mut broken) = (0, vec![]);
    println!("ulp                                    median   worst  | rays with an error ≤ ½, 1, 2, 4, 8, more");
    for frame in &FRAMES {
        let kinds = if frame.name == "plain" { &[Kind::Any, Kind::Grazing, Kind::Vertex][..] } else { &[Kind::Any] };
        let mut look = |name: &str, measured: &mut dyn FnMut(Kind, &mut Random) -> Errors| {
            let name = format!("{name}, {}", frame.name);
            if !name.contains(&wanted) {
                return;
            }
            let (mut errors, mut random) = (Errors::default(), Random(4));
            for kind in kinds {
                errors.merge(measured(*kind, &mut random));
                rays += count;
            }
            print(&name, &errors);
            broken.extend(errors.broken().into_iter().map(|what| format!("{name}: {what}")));
        };
        each(frame, |subject| look(subject.name, &mut |kind, random| measure(subject, kind, count, random)))?;
        each_room(frame, |room| look(&room.name, &mut |kind, random| solids::measure(room, kind, count, random)))?;
    }
    println!("{rays} rays");
    assert!(broken.is_empty(), "{broken:#?}");
    Ok(())
}
