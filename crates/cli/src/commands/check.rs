//! `billiards check`: checks whether a scene can run, and describes it.

use std::fmt::Write as _;
use std::io::{self, Write};

use serde::Serialize;

use super::{Failure, patience};
use crate::args;
use crate::document::{Source, plain, spell};
use crate::scene::{Request, Scene};
use crate::simulation::{Description, Region, SameBits, Simulation, Volume, plural, point, short};

/// Checks a scene and describes it.
///
/// # Errors
/// The scene is wrong, orbits differ that should be the same, or the output cannot be written.
pub fn run(arguments: &args::Check, out: &mut impl Write) -> Result<(), Failure> {
    let request = Request { law: arguments.law.clone(), collisions: None, needs_limit: false };
    let source = Source::read(&arguments.scene)?;
    let (description, same_bits) = patience::with_spinner("reading and checking the scene", || {
        let simulation = Simulation::new(Scene::parse(&source, &request)?)?;
        let same_bits = arguments.same_bits.then(|| simulation.same_bits()).transpose();
        let same_bits = same_bits.map_err(|error| Failure::Work(error.to_string()))?;
        Ok::<_, Failure>((simulation.describe(), same_bits))
    })?;
    if arguments.json {
        let report = Report { description: &description, same_bits };
        let json = serde_json::to_string_pretty(&report).map_err(|error| Failure::Work(error.to_string()))?;
        writeln!(out, "{json}")?;
        return Ok(());
    }
    describe(&description, out)?;
    if let Some(SameBits { orbits, each, collisions }) = same_bits {
        writeln!(
            out,
            "  same bits   of {orbits} orbits run side by side and one by one: {collisions} collisions in all, at most {each} per orbit"
        )?;
    }
    Ok(())
}

/// What is printed as JSON.
#[derive(Serialize)]
struct Report<'a> {
    #[serde(flatten)]
    description: &'a Description,
    #[serde(skip_serializing_if = "Option::is_none")]
    same_bits: Option<SameBits>,
}

/// A number to six digits, or infinity.
fn measure(x: Option<f64>) -> String {
    x.map_or("infinite".into(), short)
}

fn volume(x: Option<Volume>) -> String {
    match x {
        Some(Volume::TooLarge) => "too large to be represented by a number".into(),
        Some(Volume::TooSmall) => "too small to be represented by a number".into(),
        Some(Volume::Of(x)) => measure(Some(x)),
        None => measure(None),
    }
}

fn describe(scene: &Description, out: &mut impl Write) -> io::Result<()> {
    if let Some(title) = &scene.title {
        writeln!(out, "{}", plain(title))?;
    }
    let plane = scene.setup.dimension == 2;
    writeln!(out, "  table       {}", scene.setup.table)?;
    writeln!(out, "  law         {}, gamma^2 = {}", scene.setup.law, spell(scene.setup.gamma_squared))?;
    let centres = scene.centres.as_ref();
    let measured = centres.filter(|_| !plane).unwrap_or(&scene.walls);
    let measures = if plane {
        [("area", measure(measured.area)), ("perimeter", measure(measured.perimeter))]
    } else {
        [("volume", volume(measured.volume)), ("surface", measure(measured.surface))]
    };
    if !measured.parts.is_empty() {
        for (name, x) in measures {
            writeln!(out, "  {name:<12}{x}")?;
        }
    }
    if !plane && centres.is_some() && !measured.parts.is_empty() {
        writeln!(
            out,
            "  particle    a ball of radius {}; volume and surface are of the region in which its centre moves",
            spell(scene.setup.radius)
        )?;
    }
    if let Some([corners, inwards]) = scene.walls.corners {
        let inwards = if inwards == 0 { String::new() } else { format!(", {inwards} of them re-entrant") };
        writeln!(out, "  corners     {corners}{inwards}")?;
    }
    parts(&scene.walls, "table", out)?;
    if let Some((radius, center)) = scene.largest_disk {
        writeln!(
            out,
            "  fits        a disk of radius up to {}, centred near {}",
            measure(Some(radius)),
            point(&center, radius)
        )?;
    }
    if let Some(centres) = centres.filter(|_| plane) {
        writeln!(out, "  particle    a disk of radius {}; its centre moves in a region of", spell(scene.setup.radius))?;
        let corners = centres.corners.map_or(0, |corners| corners[0]);
        writeln!(
            out,
            "              area {}, perimeter {}, {}, {}",
            measure(centres.area),
            measure(centres.perimeter),
            plural(centres.pieces as u64, "piece"),
            plural(corners as u64, "corner")
        )?;
        parts(centres, "region", out)?;
    }
    if let Some(time) = scene.mean_free_time_without_spin {
        let formula = if plane { "pi area/perimeter" } else { "4 volume/surface" };
        writeln!(out, "  mean free   time {} = {formula}, at unit speed of the centre", measure(Some(time)))?;
        in_parts(scene, time, out)?;
    }
    if let Some(time) = scene.mean_free_time {
        let formula = if plane { "4 area/perimeter" } else { "(15 pi/8) volume/surface" };
        writeln!(out, "  mean free   time {} = {formula}, at unit speed, spin included", measure(Some(time)))?;
        in_parts(scene, time, out)?;
    }
    writeln!(out, "  engine      {}", scene.engine)?;
    writeln!(out, "  pieces      {}", scene.pieces.len())?;
    pieces(scene, out)?;
    starts(scene, out)
}

/// The mean free times in each part of a region that falls apart: an orbit stays in one of them.
fn in_parts(scene: &Description, time: f64, out: &mut impl Write) -> io::Result<()> {
    let factors = scene.centres.as_ref().unwrap_or(&scene.walls).factors();
    if !factors.is_empty() {
        let times: Vec<_> = factors.iter().map(|factor| measure(factor.map(|factor| time * factor))).collect();
        writeln!(out, "              in its parts {}", times.join(", "))?;
    }
    Ok(())
}

/// Reports it if a region is not connected.
fn parts(region: &Region, what: &str, out: &mut impl Write) -> io::Result<()> {
    if region.parts.len() > 1 {
        let areas: Vec<_> = region.parts.iter().map(|area| measure(*area)).collect();
        writeln!(
            out,
            "              the {what} falls apart into {}, of area {}",
            plural(areas.len() as u64, "part"),
            areas.join(", ")
        )?;
    }
    Ok(())
}

/// Most pieces that are listed.
const MOST_PIECES: usize = 100;

fn pieces(scene: &Description, out: &mut impl Write) -> io::Result<()> {
    for (i, piece) in scene.pieces.iter().enumerate().take(MOST_PIECES) {
        let mut line = format!("    {i:>3}  {:<17} {}", piece.kind, piece.place);
        if scene.setup.dimension == 2 {
            let _ = write!(line, ", length {}", measure(piece.length));
        }
        if let Some(normal) = piece.normal {
            let _ = write!(line, ", normal half-way {}", point(&normal, 0.0));
        }
        if piece.law != scene.setup.law {
            let _ = write!(line, ", law {}", piece.law);
        }
        writeln!(out, "{}", line.trim_end())?;
    }
    if scene.pieces.len() > MOST_PIECES {
        writeln!(out, "    and {} more", scene.pieces.len() - MOST_PIECES)?;
    }
    Ok(())
}

fn starts(scene: &Description, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "  orbits      {}", scene.orbits)?;
    for (i, start) in scene.starts.iter().enumerate() {
        let distance = measure(Some(start.distance));
        writeln!(
            out,
            "    {i:>3}  starts at {}, {distance} from a wall; {}",
            point(&start.position, 0.0),
            start.first
        )?;
    }
    if scene.orbits > scene.starts.len() as u64 {
        writeln!(out, "    and {} more", scene.orbits - scene.starts.len() as u64)?;
    }
    Ok(())
}
