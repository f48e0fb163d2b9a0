//! Every claim of the paper, or those named, measured: `cargo run --release -p no-slip-paper --example claims [--full] [NAME…]`. Fails if a
//! measurement disagrees, or a name is unknown.
use paper::{Claim, Effort, claims};
use std::{process::ExitCode, time::Instant};

fn main() -> ExitCode {
    let mut names: Vec<String> = std::env::args().skip(1).collect();
    let full = names.iter().any(|name| name == "--full");
    names.retain(|name| name != "--full");
    let effort = if full { Effort::Full } else { Effort::Quick };
    let unknown: Vec<_> = names.iter().filter(|name| claims::find(name).is_none()).collect();
    if !unknown.is_empty() {
        eprintln!("there is no claim named {unknown:?}");
        return ExitCode::from(2);
    }
    let asked = |claim: &&Claim| names.is_empty() || names.iter().any(|name| name == claim.name);
    let mut disagree = 0;
    for claim in claims::all().iter().filter(asked) {
        let start = Instant::now();
        let measurement = claim.measure(effort);
        let agrees = if measurement.is_consistent() { "" } else { ", BUT THE MEASUREMENT DISAGREES" };
        disagree += usize::from(!measurement.is_consistent());
        println!("{} ({}): {}{agrees} [{:.1?}]", claim.name, claim.place, claim.verdict.name(), start.elapsed());
        for quantity in &measurement.quantities {
            println!("    {quantity}");
        }
    }
    if disagree == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
