//! The command line.

use std::io;
use std::num::NonZeroUsize;
use std::path::{Component, Path, PathBuf};

use clap::error::{ContextKind, ContextValue};
use clap::{Args, CommandFactory, Parser, Subcommand};

use crate::bench::law::Law;
use crate::document::STANDARD_INPUT;
use crate::scene::LawKind;
use crate::spelling::closest;

/// Largest number of collisions per orbit.
const MOST_COLLISIONS: u64 = 1_000_000_000_000;

/// Billiards with any collision law: specular, no-slip, and everything between.
#[derive(Clone, Debug, Parser)]
#[command(
    name = "billiards",
    version,
    max_term_width = 100,
    after_help = "Exit status: 0 success, 1 failure, 2 bad input."
)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

impl Cli {
    /// The arguments of the process; none where they ask for help or the version, which is printed. Ends the process with a message
    /// where they make no sense.
    ///
    /// # Errors
    /// Help cannot be written.
    pub fn read() -> io::Result<Option<Self>> {
        match Cli::try_parse().map_err(with_nearest) {
            Ok(cli) => Ok(Some(cli)),
            Err(error) if error.use_stderr() => error.exit(),
            Err(help) => help.print().map(|()| None),
        }
    }
}

/// The same error, with the command that a mistyped one comes closest to: short words need another measure than clap's.
fn with_nearest(mut error: clap::Error) -> clap::Error {
    if let (Some(ContextValue::String(word)), None) =
        (error.get(ContextKind::InvalidSubcommand), error.get(ContextKind::SuggestedSubcommand))
    {
        let command = Cli::command();
        if let Some(near) = closest(word, command.get_subcommands().map(clap::Command::get_name)) {
            error.insert(ContextKind::SuggestedSubcommand, ContextValue::Strings(vec![near.into()]));
        }
    }
    error
}

/// What to do.
#[derive(Clone, Debug, Subcommand)]
pub enum Command {
    /// Run a scene: its orbits, their record, pictures and a summary
    Run(Run),
    /// Check a scene and describe it: pieces, area, perimeter, where the particle fits, its starts
    Check(Check),
    /// Print a guide to scene files, contact files and output files, in Markdown
    Guide,
    /// List the tables a scene can name, with their parameters
    Tables(Listing),
    /// List the collision laws a scene can name
    Laws(Listing),
    /// Compute one collision of two rigid bodies, in dimension 2 to 5
    Collide(Collide),
    /// Recompute every figure and every claim of the paper, on one page
    Reproduce(Reproduce),
    /// Measure what accuracy costs on this machine: run time against error, per table and method
    Bench(Bench),
}

/// Arguments of `billiards run`.
#[derive(Clone, Debug, Args)]
#[command(after_help = "\
Writes DIR/summary.json and whatever the scene's [output] asks for. Ctrl-C ends a run cleanly: what is done
is kept, the summary counts the other orbits as \"interrupted\", and the exit status is 0. A second Ctrl-C, at least half
a second later, ends it at once with status 130, and nothing is kept. SIGTERM and SIGHUP do the same, but those that
were ignored when the command started, as under nohup, still are (on Linux).

Examples:
  billiards run scenes/hexagon.toml
  billiards run scenes/hexagon.toml --law specular --out out/hexagon-specular
  billiards run scenes/stadium.toml -n 1e6")]
pub struct Run {
    /// Scene file (TOML), or - for standard input
    #[arg(value_name = "SCENE")]
    pub scene: PathBuf,
    /// Collision law that replaces the scene's; pieces with a law of their own keep it
    #[arg(long, value_name = "LAW")]
    pub law: Option<LawKind>,
    /// Collisions per orbit; replaces the scene's limit
    #[arg(short = 'n', long, value_name = "N", value_parser = collisions, allow_negative_numbers = true)]
    pub collisions: Option<u64>,
    /// Output folder [default: out/ followed by the scene file's name without its extension]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Number of threads that share the orbits [default: one per processor]
    #[arg(long, value_name = "T", value_parser = threads, allow_negative_numbers = true)]
    pub threads: Option<NonZeroUsize>,
}

impl Run {
    /// The folder for everything that is written; none where the scene has no name, or not one for a folder.
    pub fn folder(&self) -> Option<PathBuf> {
        let named = || {
            let stem = self.scene.file_stem().filter(|_| self.scene != Path::new(STANDARD_INPUT))?;
            // `..toml` and `...toml`: the stems are this folder and the one above
            let is_name = matches!(Path::new(stem).components().next(), Some(Component::Normal(_)));
            is_name.then(|| Path::new("out").join(stem))
        };
        self.out.clone().or_else(named)
    }
}

/// Arguments of `billiards check`.
#[derive(Clone, Debug, Args)]
#[command(after_help = "\
Examples:
  billiards check scenes/mushroom.toml
  billiards check scenes/mushroom.toml --same-bits")]
pub struct Check {
    /// Scene file (TOML), or - for standard input
    #[arg(value_name = "SCENE")]
    pub scene: PathBuf,
    /// Collision law that replaces the scene's; pieces with a law of their own keep it
    #[arg(long, value_name = "LAW")]
    pub law: Option<LawKind>,
    /// Also run some orbits both side by side and one by one, and check that they agree to the last bit
    #[arg(long)]
    pub same_bits: bool,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `billiards tables` and `billiards laws`.
#[derive(Clone, Copy, Debug, Args)]
pub struct Listing {
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `billiards collide`.
#[derive(Clone, Debug, Args)]
#[command(after_help = "\
Example of a contact file (TOML or JSON), for a spinning disk that drops onto a floor:

  dim = 2
  law = \"no-slip\"                     # or rough = [[1, 0]], the rough directions, or as in scenes
  contact_point = [0, 0]
  normal = [0, 1]                     # from body 2 towards body 1, of any length up to 1e150
  bodies = [{ mass = 1, position = [0, 1], inertia = \"1/2\" }, { mass = \"inf\" }]
  pre = [{ v = [0, -1], w = 3 }, { v = [0, 0], w = 0 }]

In dimension 3 an inertia is a 3 x 3 tensor and a spin w a vector; in dimension 4 and 5 a body has
second moments S per unit mass instead of an inertia, and a spin is a skew matrix.")]
pub struct Collide {
    /// Contact file (TOML or JSON), or - for standard input
    #[arg(value_name = "CONTACT")]
    pub contact: PathBuf,
    /// Print JSON, with every number in full
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `billiards reproduce`.
#[derive(Clone, Debug, Args)]
#[command(after_help = "\
Writes DIR/index.html with the pictures beside it, and DIR/claims.json; with --only NAME, DIR/NAME.html instead, with
NAME.svg for a figure and NAME.json for a claim. The output is the same to the last bit every time. The exit status is 1
if a measurement disagrees with its verdict, or after Ctrl-C: then the page says what is left out.

Examples:
  billiards reproduce --out report
  billiards reproduce --quick
  billiards reproduce --only hexagon
  billiards reproduce --list")]
pub struct Reproduce {
    /// Folder for the page, the pictures and claims.json
    #[arg(long, value_name = "DIR", default_value = "report")]
    pub out: PathBuf,
    /// Use smaller samples; takes less than a minute
    #[arg(long)]
    pub quick: bool,
    /// Only the figure and the claim of this name, in files of this name
    #[arg(long, value_name = "NAME")]
    pub only: Option<String>,
    /// List the names of figures and claims, and do nothing else
    #[arg(long, conflicts_with_all = ["only", "quick"])]
    pub list: bool,
}

/// Arguments of `billiards bench`.
#[derive(Clone, Debug, Args)]
#[command(after_help = "\
With --out, writes DIR/bench.json and DIR/work-precision.svg, or DIR/stress.json with --stress.

Examples:
  billiards bench
  billiards bench --quick --only stadium
  billiards bench --out bench --json
  billiards bench --stress")]
pub struct Bench {
    /// Print JSON
    #[arg(long)]
    pub json: bool,
    /// Fewer orbits and pieces, shorter rounds; takes about ten seconds
    #[arg(long)]
    pub quick: bool,
    /// Only the table, or with --stress the case, of this name
    #[arg(long, value_name = "NAME")]
    pub only: Option<String>,
    /// Collision law
    #[arg(long, value_name = "LAW", value_enum, default_value = "no-slip", conflicts_with = "stress")]
    pub law: Law,
    /// Folder for the numbers and the chart
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Run the stress cases instead: thin wedges, cusps, extreme units and masses, a million pieces
    #[arg(long)]
    pub stress: bool,
}

/// A number of collisions: a whole number, perhaps written as 1e6.
fn collisions(text: &str) -> Result<u64, String> {
    let whole = text.parse().ok().or_else(|| {
        let x: f64 = text.parse().ok()?;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within range: just checked")]
        (x % 1.0 == 0.0 && (1.0..=MOST_COLLISIONS as f64).contains(&x)).then_some(x as u64)
    });
    whole.filter(|n| (1..=MOST_COLLISIONS).contains(n)).ok_or_else(|| "not a whole number from 1 to 1e12".into())
}

/// A number of threads: more than the largest machines have processors would only be in each other's way.
fn threads(text: &str) -> Result<NonZeroUsize, String> {
    let threads = text.parse().ok().filter(|threads: &NonZeroUsize| threads.get() <= 1024);
    threads.ok_or_else(|| "not a whole number from 1 to 1024".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn a_mistyped_command_is_told_the_nearest_one() {
        let told =
            |word: &str| with_nearest(Cli::try_parse_from(["billiards", word]).expect_err("not a command")).to_string();
        for (word, near) in [("rnu", "run"), ("ru", "run"), ("benhc", "bench"), ("table", "tables"), ("law", "laws")] {
            assert!(told(word).contains(&format!("'{near}'")), "{}", told(word));
        }
        assert!(told("zebra").contains("unrecognized subcommand 'zebra'"));
        assert!(!told("zebra").contains("similar"));
    }

    #[test]
    fn collisions_are_whole_numbers() {
        assert_eq!([collisions("7"), collisions("1e6")], [Ok(7), Ok(1_000_000)]);
        for text in ["0", "-1", "1.5", "1e13", "nan", "many", ""] {
            assert!(collisions(text).is_err(), "{text}");
        }
    }

    #[test]
    fn threads_are_as_many_as_a_machine_may_have() {
        assert_eq!(threads("1024").map(NonZeroUsize::get), Ok(1024));
        for text in ["0", "1025", "18446744073709551615", "-1", "two", ""] {
            assert!(threads(text).is_err(), "{text}");
        }
    }

    #[test]
    fn a_negative_number_is_told_what_the_option_takes() {
        for (option, number, takes) in [
            ("-n", "-5", "from 1 to 1e12"),
            ("--collisions", "-1e3", "from 1 to 1e12"),
            ("--threads", "-2", "from 1 to 1024"),
        ] {
            let error = Cli::try_parse_from(["billiards", "run", "x.toml", option, number]).expect_err(number);
            let told = error.to_string();
            assert!(told.contains(&format!("invalid value '{number}'")) && told.contains(takes), "{told}");
        }
    }

    #[test]
    fn the_folder_defaults_to_the_name_of_the_scene() {
        #[derive(Parser)]
        struct Line {
            #[command(flatten)]
            run: Run,
        }
        let run = |words: &[&str]| Line::parse_from([&["billiards"], words].concat()).run;
        assert_eq!(run(&["scenes/hexagon.toml"]).folder(), Some(PathBuf::from("out/hexagon")));
        let run = run(&["x.toml", "--law", "no-slip", "-n", "1e3", "--out", "y", "--threads", "2"]);
        assert_eq!(
            (run.folder(), run.law, run.collisions),
            (Some(PathBuf::from("y")), Some(LawKind::NoSlip), Some(1000))
        );
    }

    #[test]
    fn a_scene_without_a_name_or_named_as_the_folder_above_has_no_folder() {
        for (scene, folder) in [
            ("-", None),
            ("...toml", None),
            ("..toml", None),
            (".toml", Some("out/.toml")),
            ("....toml", Some("out/...")),
        ] {
            let run = Cli::parse_from(["billiards", "run", scene]);
            let Command::Run(run) = run.command else { panic!("{run:?}") };
            assert_eq!(run.folder(), folder.map(PathBuf::from), "{scene}");
        }
    }
}
