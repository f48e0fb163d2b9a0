//! Atoms and galaxies: the same scene in units of 10^±150.

use std::error::Error;
use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, Ordering};

use super::super::Effort;
use super::super::state::worse;
use super::{Entry, Tally};
use crate::document::Source;
use crate::scene::{Request, Scene};
use crate::simulation::{Control, Simulation};

pub(super) const LENGTHS: Entry = Entry {
    name: "tables of size 1e+-150",
    summary: "a stadium 2^498 times as large or small: the same record, scaled, bit by bit",
    run: |effort| scaled(effort, |factor| [factor, 1.0]),
};

pub(super) const SPEEDS: Entry = Entry {
    name: "speeds of 1e+-150",
    summary: "a stadium 2^498 times as fast or slow: the same record, scaled, bit by bit",
    run: |effort| scaled(effort, |factor| [1.0, factor]),
};

/// 2⁴⁹⁸ is 8·10¹⁴⁹.
const POWER: i32 = 498;

/// Columns of a record of collisions: those that are lengths, and those that are speeds.
const COLUMNS: [std::ops::Range<usize>; 2] = [4..7, 7..10];
/// The column of the time.
const TIME: usize = 2;

fn scaled(effort: Effort, of: fn(f64) -> [f64; 2]) -> Result<Tally, Box<dyn Error>> {
    let collisions = if effort == Effort::Quick { 100 } else { 10_000 };
    let usual = record([1.0, 1.0], collisions)?;
    let mut tally = Tally { known: "the record in usual units", ..Tally::default() };
    for power in [POWER, -POWER] {
        let [length, speed] = of(libm::ldexp(1.0, power));
        let rows = record([length, speed], collisions)?;
        let mut factors = [1.0; 10];
        factors[TIME] = length / speed;
        COLUMNS[0].clone().for_each(|i| factors[i] = length);
        COLUMNS[1].clone().for_each(|i| factors[i] = speed);
        for (row, right) in rows.iter().zip(&usual) {
            for i in 0..10 {
                let off = if right[i] == 0.0 { row[i].abs() } else { (row[i] / factors[i] / right[i] - 1.0).abs() };
                tally.error = worse(tally.error, off);
            }
        }
        tally.orbits += 1;
        tally.collisions += rows.len() as u64;
        tally.lost += u64::from(rows.len() != usual.len());
        *tally.stops.entry("finished").or_default() += 1;
    }
    Ok(tally)
}

/// A folder that is removed afterwards.
struct Folder(PathBuf);

impl Folder {
    fn new() -> Folder {
        static COUNT: AtomicU64 = AtomicU64::new(0);
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        Folder(std::env::temp_dir().join(format!("billiards-bench-{}-{number}", std::process::id())))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // a folder left behind does no harm
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Runs a scene with all lengths and all speeds multiplied by factors, as `billiards run` does, and reads
/// its record.
fn record([length, speed]: [f64; 2], collisions: u64) -> Result<Vec<[f64; 10]>, Box<dyn Error>> {
    let (l, v) = (|x: f64| length * x, |x: f64| speed * x);
    let text = format!(
        "law = \"no-slip\"\n\
         [table]\nname = \"stadium\"\nhalf_length = {:e}\nradius = {:e}\n\
         [[orbit]]\nposition = [{:e}, {:e}]\nvelocity = [{:e}, {:e}]\nspin = {:e}\n\
         [run]\ncollisions = {collisions}\n[output]\ncollisions = \"csv\"\n",
        l(1.0),
        l(1.0),
        l(0.125),
        l(0.25),
        v(0.625),
        v(0.75),
        v(0.25),
    );
    let all = |wrong: Vec<_>| crate::commands::Failure::Input(wrong);
    let scene = Scene::parse(&Source::new("stress.toml", &text), &Request::default()).map_err(all)?;
    let folder = Folder::new();
    Simulation::new(scene).map_err(all)?.run(&folder.0, &Control::new(1))?;
    let csv = std::fs::read_to_string(folder.0.join("collisions.csv"))?;
    let row = |line: &str| {
        let mut row = [0.0; 10];
        for (cell, text) in row.iter_mut().zip(line.split(',')) {
            *cell = text.parse()?;
        }
        Ok(row)
    };
    csv.lines().skip(1).map(row).collect()
}
