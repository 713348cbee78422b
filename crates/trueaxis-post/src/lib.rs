//! Cutter locations into an NC program for one machine.
//!
//! ```text
//!     ClFile ──path──> strokes (line or arc, tip and tool axis)      cycles and circles as strokes
//!            ──axes──> legs: axis positions, best branch and turn     a leg ends where an axis must
//!                                                                     rewind or the tool changes
//!            ──cut───> pieces within chord and angle tolerance
//!            ──circles, holes──> arcs and cycles of the control where it has them
//!            ──feed, write──> text                                    Writer of trueaxis-nc
//!     text ──simulate──> the largest difference from the strokes      verify
//! ```

mod ahead;
mod axes;
mod circles;
mod cut;
mod drilled;
mod feed;
mod holes;
mod path;
mod places;
mod strokes;
mod tapped;
mod verify;
mod write;

pub use verify::{Largest, Verification, verify, verify_in_place};

pub(crate) use places::{BlockPlace, HolePlace, Places};

use cut::Cutter;
use path::Path;
use trueaxis_cl::{ClFile, ClPath};
use trueaxis_input::{Diagnostics, Place};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Command;
use trueaxis_machine::tcp::TipControl;
use trueaxis_nc::Control;
use trueaxis_writer::{Decimals, Templates, TipWords};
use write::{Post, Written};

/// Lengths of tools nearer than this are the same, mm.
const SAME_LENGTH_MM: f64 = 1e-3;

/// How feeds are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FeedRule {
    /// In mm/min, so that the tip moves as the file says. Without tool-centre point the number is
    /// that of the linear axes of each block, and no axis is asked for more than it can.
    #[default]
    Tip,
    /// Inverse time (G93); no axis is asked for more than it can.
    InverseTime,
    /// As [`Self::Tip`], but no axis is asked for more than its greatest velocity.
    AxisLimit,
}

/// What program is wanted.
#[derive(Debug, Clone)]
pub struct PostOptions {
    /// For which control.
    pub control: Control,
    /// How the tool axis is written with tool-centre point; `None`: the control has none, axis
    /// positions are written.
    pub tip_words: Option<TipWords>,
    /// Arcs and drilling cycles are written as lines, too.
    pub lines_only: bool,
    /// Between path and chord, mm.
    pub tolerance_mm: f64,
    /// Of the tool axis between blocks, rad.
    pub axis_tolerance_rad: f64,
    /// A tool axis nearer to a pole than this passes through it, rad.
    pub pole_rad: f64,
    /// How feeds are written.
    pub feed: FeedRule,
    /// The feed where the file has none, mm/min.
    pub usual_feed_mm_per_min: Option<f64>,
    /// How far the tool goes back along its axis before it is turned elsewhere, mm.
    pub retract_mm: f64,
    /// Digits.
    pub decimals: Decimals,
    /// Start, tool call and end; `None` for those of the control.
    pub templates: Option<Templates>,
    /// The name of the program.
    pub name: String,
    /// Its number.
    pub number: u32,
}

impl PostOptions {
    /// The usual ones for a control, with tool-centre point by angles.
    pub fn of(control: Control) -> Self {
        Self {
            control,
            tip_words: Some(TipWords::Angles),
            lines_only: false,
            tolerance_mm: 0.01,
            axis_tolerance_rad: 0.05_f64.to_radians(),
            pole_rad: 0.0,
            feed: FeedRule::Tip,
            usual_feed_mm_per_min: None,
            retract_mm: 50.0,
            decimals: Decimals::default(),
            templates: None,
            name: "PROGRAM".to_owned(),
            number: 1,
        }
    }
}

/// A program and where it comes from.
#[derive(Debug, Clone)]
pub struct Posted {
    /// The text.
    pub text: Vec<u8>,
    /// How many lines it has.
    pub lines: usize,
    /// Strokes of the tool in the file.
    pub strokes: usize,
    /// Blocks that move the tool along them.
    pub blocks: usize,
    /// How often the tool goes back so that an axis can rewind or change its branch.
    pub rewinds: usize,
    /// How far tool axes were turned to pass through a pole, rad; 0 if none was.
    pub pole_deviation_rad: f64,
    /// Blocks that are arcs.
    pub arcs: usize,
    places: Places,
    drilled: Vec<HolePlace>,
    path: Path,
}

impl Posted {
    /// How many holes are drilled by cycles of the control.
    pub fn holes(&self) -> usize {
        self.drilled.len()
    }

    /// How many of them are threads.
    pub fn threads(&self) -> usize {
        self.drilled.iter().filter(|place| self.path.holes[place.hole].thread.is_some()).count()
    }
}

/// Writes the program of a cutter-location file.
///
/// The points are taken in the workpiece frame of the machine file, the tool is the machine's. No
/// text comes back where a number of the program would leave the travel of an axis.
///
/// ```
/// use trueaxis_post::{PostOptions, post};
/// use trueaxis_machine::{Machine, file::NoTables};
/// use trueaxis_cl::{ClFile, Reading};
/// use trueaxis_nc::Control;
/// let text = "[machine]\nname = \"ac\"\nchain = \"w C' A' b X Y Z t\"";
/// let machine = Machine::check("ac.toml", text, &NoTables).0.unwrap();
/// let cl = b"UNITS/MM\nFEDRAT/500\nGOTO/10,0,0,0,0,1\nGOTO/10,5,0,0,-0.5,0.8660254\n".to_vec();
/// let (cl, _) = ClFile::read("a.cls", cl, &Reading::default());
/// let mut options = PostOptions::of(Control::Fanuc);
/// options.tip_words = None;
/// let (posted, problems) = post(&machine, &cl, &options);
/// let text = String::from_utf8(posted.unwrap().text).unwrap();
/// // A = 30°: Y = 5 cos 30°, Z = −5 sin 30° (Zhang et al. 2023, eq 2 and 3).
/// assert!(text.contains("Y4.3301 Z-2.5 A30."), "{text}");
/// ```
pub fn post(
    machine: &Machine,
    file: &ClFile,
    options: &PostOptions,
) -> (Option<Posted>, Diagnostics) {
    post_path(machine, ClPath::from(file), options)
}

/// The same for a path without its text: its memory is given back as it is read.
pub fn post_path(
    machine: &Machine,
    file: ClPath,
    options: &PostOptions,
) -> (Option<Posted>, Diagnostics) {
    let mut problems = Diagnostics::new();
    let Some(control) = TipControl::of(machine) else {
        let message = "the machine has fewer than three linear axes".to_owned();
        let hint = "the tip cannot follow a path; describe another machine";
        problems.error("no-linear-axes", Place::whole(machine.name()), message, hint);
        return (None, problems);
    };
    let name = file.name().to_owned();
    let mut path = Path::of(file, options, &mut problems);
    if problems.has_errors() {
        return (None, problems);
    }
    check_lengths(machine, (&path, &name), options, &mut problems);
    let pole_deviation_rad = axes::pass_poles(&mut path, &control, options.pole_rad);
    match write(machine, &control, &path, options) {
        Ok((Written { text, lines, places, drilled, blocks, arcs }, rewinds)) => {
            let strokes = path.strokes.len();
            let posted = Posted {
                lines,
                text,
                strokes,
                blocks,
                rewinds,
                pole_deviation_rad,
                arcs,
                places,
                drilled,
                path,
            };
            (Some(posted), problems)
        }
        Err(fault) => {
            let place = Place { file: name, line: fault.line as usize, column: 1 };
            problems.error(fault.code, place, fault.message, fault.hint);
            (None, problems)
        }
    }
}

/// Positions of axes contain the length of the tool: another one in the file is said, and so is a tool that it does
/// not name.
fn check_lengths(
    machine: &Machine,
    (path, file): (&Path, &str),
    options: &PostOptions,
    problems: &mut Diagnostics,
) {
    let is_mm = -machine.tip_mm().z;
    let tools = path.events.iter().filter_map(|(_, event)| match event {
        path::Event::Tool(tool, line) => Some((tool, *line)),
        _ => None,
    });
    let mut is_named = false;
    for (tool, line) in tools {
        is_named = true;
        let other = tool.length_mm.filter(|length| (length - is_mm).abs() > SAME_LENGTH_MM);
        if let Some(length) = other.filter(|_| options.tip_words.is_none()) {
            let message = format!(
                "the file states a tool of {length} mm, the axis positions are those of one of {is_mm:.4} mm"
            );
            let place = Place { file: file.to_owned(), line: line as usize, column: 1 };
            problems.warn("stated-tool-length", place, message, "give --tool-length");
        }
    }
    if !is_named {
        let message = "the file names no tool: the program calls tool 1".to_owned();
        let hint = "write LOADTL/number before the first motion, or put tool 1 into the spindle";
        problems.note("no-tool", Place::whole(file), message, hint);
    }
}

/// Leg after leg. Where a place cannot be reached, that is reported before what cannot be written.
fn write(
    machine: &Machine,
    control: &TipControl,
    path: &Path,
    options: &PostOptions,
) -> Result<(Written, usize), Fault> {
    let cutter = Cutter::new(machine, control, options);
    let mut post = Post::begin(machine, path, &cutter, options);
    let (mut rewinds, mut is_turned, mut from) = (0, false, Command::default());
    let upright = options.tip_words == Some(TipWords::Length);
    for stretch in axes::stretches(path) {
        axes::legs(machine, path, stretch, &mut from, &mut |leg| {
            rewinds += usize::from(!leg.cuts_first);
            is_turned |= upright && axes::is_turned(machine, path, leg);
            if let Ok(writing) = &mut post
                && let Err(fault) = writing.leg(leg)
            {
                post = Err(fault);
            }
        })?;
    }
    if upright {
        axes::check_upright(machine, control, path, is_turned)?;
    }
    Ok((post?.end()?, rewinds))
}

/// Why there is no program, and the line of the file.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Fault {
    line: u32,
    code: &'static str,
    message: String,
    hint: &'static str,
}
