//! Every claim of the paper, or those named, measured: `cargo run --release -p no-slip-paper --example claims [--full] [NAME…]`.
use paper::{Effort, claims};
use std::time::Instant;

fn main() {
    let mut names: Vec<String> = std::env::args().skip(1).collect();
    let full = names.iter().any(|name| name == "--full");
    names.retain(|name| name != "--full");
    let effort = if full { Effort::Full } else { Effort::Quick };
    for claim in claims::all().iter().filter(|claim| names.is_empty() || names.iter().any(|name| name == claim.name)) {
        let start = Instant::now();
        let measurement = claim.measure(effort);
        let agrees = if measurement.is_consistent() { "" } else { ", BUT THE MEASUREMENT DISAGREES" };
        println!("{} ({}): {}{agrees} [{:.1?}]", claim.name, claim.place, claim.verdict.name(), start.elapsed());
        for quantity in &measurement.quantities {
            println!("    {quantity}");
        }
    }
}
