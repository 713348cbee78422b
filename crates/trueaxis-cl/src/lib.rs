//! Cutter-location files: the tool positions computed by a CAM system.
//!
//! APT CLDATA as text in the dialects of Creo (GPOST, Pro/CL), NCL, CATIA aptsource and SolidWorks
//! CAM, and plain tables of `x y z i j k`. Every line of a file belongs to a [`Record`]: words
//! without effect are kept as such, and unknown words are reported with their line.
//!
//! Lengths are in mm in the workpiece frame of the CAM system, feeds in mm/min or mm per revolution.
//!
//! ```
//! use trueaxis_cl::{ClFile, Reading, Word};
//! let text = b"UNITS/INCHES\nMULTAX/ON\nFEDRAT/10,IPM\nGOTO/1,2,4, $\n 0,0.6,0.8\nFINI\n".to_vec();
//! let (file, problems) = ClFile::read("demo.cls", text, &Reading::default());
//! assert!(!problems.has_errors());
//! let Word::Goto(point) = &file.records()[3].word else { panic!() };
//! assert_eq!(point.tip_mm, [25.4, 50.8, 101.6]);
//! assert_eq!(point.axis, [0.0, 0.6, 0.8]);
//! assert_eq!(point.feed.map(|f| f.value), Some(254.0));
//! ```
//!
//! `examples/extent.rs` reads a file and prints the range of its points.

// On top of the list of the workspace, as this crate has no hits.
#![warn(clippy::needless_pass_by_value, clippy::redundant_closure_for_method_calls)]

mod numbers;
mod path;
mod plain;
mod reader;
mod rewrite;
mod scan;
mod words;

pub use path::ClPath;
pub use reader::SAME_PITCH;

use std::ops::Range;
use trueaxis_input::Diagnostics;
use trueaxis_nc::moves::{Coolant, Feed, SpindleDirection};

/// One position of the tool.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClPoint {
    /// The tip in the workpiece frame, mm.
    pub tip_mm: [f64; 3],
    /// The tool axis: unit vector from the tip to the spindle. Unit: 1.
    pub axis: [f64; 3],
    /// Whether it is reached in rapid traverse.
    pub rapid: bool,
    /// The feed otherwise; `None` before the first FEDRAT.
    pub feed: Option<Feed>,
}

/// A circle on which the next point is reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClCircle {
    /// Its centre, mm.
    pub center_mm: [f64; 3],
    /// Unit vector of the axis; the tool moves counter-clockwise about it. Unit: 1.
    pub normal: [f64; 3],
    /// How far it moves, where the file states it, rad.
    pub turn_rad: Option<f64>,
}

/// A drilling or tapping cycle; lengths along the tool axis from the point, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClCycle {
    /// Depth below the point.
    pub depth_mm: f64,
    /// Height above the point down to which the tool moves in rapid traverse.
    pub clearance_mm: f64,
    /// Height above the point to which the tool retracts at the end, and at which it goes to the next
    /// hole.
    pub retract_mm: f64,
    /// The tool goes back to the height from which it came to the hole, if that is higher: RTRCTO,AUTO.
    pub to_begin: bool,
    /// The depth of the first peck and of each further one; the tool leaves the hole after each.
    pub pecks_mm: Option<[f64; 2]>,
    /// Dwell at the bottom, s.
    pub dwell_s: f64,
    /// The tool leaves the hole with feed: a reamer.
    pub feeds_out: bool,
    /// The feed of drilling, if the cycle states one.
    pub feed: Option<Feed>,
    /// A thread is tapped.
    pub tap: Option<ClTap>,
}

/// What a tapping cycle states of its thread; the spindle says on which side it turns.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ClTap {
    /// The pitch, mm; without it that of the feed in the place where the hole is.
    pub pitch_mm: Option<f64>,
}

/// A tool that is loaded.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ClTool {
    /// Its number.
    pub number: u32,
    /// The number under which the control keeps its length, where it is stated.
    pub offset: Option<u32>,
    /// Its length, where it is stated, mm.
    pub length_mm: Option<f64>,
}

/// The content of a record.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Word {
    /// GOTO, GODLTA, or a row of a table.
    Goto(ClPoint),
    /// FROM: the first position of the tool, without motion.
    From(ClPoint),
    /// CIRCLE: the next GOTO is reached along it.
    Circle(ClCircle),
    /// TLON,GOFWD: a circle with the point that it leads to.
    Arc(ClCircle, ClPoint),
    /// RAPID: rapid traverse for the next motion.
    Rapid,
    /// FEDRAT.
    Feed(Feed),
    /// SPINDL: direction, and speed in 1/min if given; 0 where a surface speed is stated, with which it is not known.
    Spindle(SpindleDirection, Option<f64>),
    /// COOLNT.
    Coolant(Coolant),
    /// LOADTL, LOAD/TOOL, TURRET.
    Tool(ClTool),
    /// CUTTER: the cutter.
    Cutter {
        /// Cutting diameter, mm.
        diameter_mm: f64,
        /// Radius of the corner, if it is stated, mm.
        corner_radius_mm: Option<f64>,
    },
    /// TLAXIS: the tool axis of the following points without vector.
    ToolAxis([f64; 3]),
    /// MULTAX ON or OFF.
    MultiAxis(bool),
    /// UNITS: `true` for inches.
    Inches(bool),
    /// CYCLE: executed at each following point.
    Cycle(ClCycle),
    /// TRANS: how far the following points are displaced; theirs contain it. Unit: mm.
    Translation([f64; 3]),
    /// CYCLE/OFF.
    CycleOff,
    /// DELAY: dwell time, s.
    Delay(f64),
    /// STOP or OPSTOP.
    Stop {
        /// Whether it is OPSTOP.
        optional: bool,
    },
    /// INSERT: a line that is passed to the control unchanged.
    Insert(String),
    /// PARTNO, REMARK, PPRINT, TPRINT, `$$`: a comment.
    Comment(String),
    /// FINI, END.
    End,
    /// A known word without effect on the path.
    Noted,
    /// An unknown word.
    Unknown,
}

/// One statement of the file.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// The line on which it begins, from 1.
    pub line: u32,
    /// Its bytes, continuation lines and comments included.
    pub span: Range<usize>,
    /// Its content; lengths in mm, modal words resolved.
    pub word: Word,
}

/// Settings for reading that replace statements of the file.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Reading {
    /// `true`: lengths are in inches, `false`: in mm; `None`: as UNITS states.
    pub inches: Option<bool>,
}

/// A cutter-location file.
#[derive(Debug, Clone, PartialEq)]
pub struct ClFile {
    name: String,
    source: Vec<u8>,
    records: Vec<Record>,
}

/// The range of the points of a file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// Number of points.
    pub points: usize,
    /// The smallest coordinates, mm.
    pub min_mm: [f64; 3],
    /// The largest coordinates, mm.
    pub max_mm: [f64; 3],
    /// The largest angle between the tool axis and Z of the workpiece frame, rad.
    pub tilt_rad: f64,
}

impl ClFile {
    /// Reads a file and reports all problems. With errors the records must not be machined.
    pub fn read(name: &str, source: Vec<u8>, reading: &Reading) -> (Self, Diagnostics) {
        let mut records = Vec::new();
        let problems = reader::read(name, &source, reading, &mut |line, span, word| {
            records.push(Record { line, span, word });
        });
        (Self { name: name.to_owned(), source, records }, problems)
    }

    /// The file as the user named it.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The text.
    pub fn source(&self) -> &[u8] {
        &self.source
    }

    /// All statements, in order.
    pub fn records(&self) -> &[Record] {
        &self.records
    }

    /// All points of GOTO and GODLTA, and of tables, each with its line.
    pub fn points(&self) -> impl Iterator<Item = (u32, &ClPoint)> {
        self.records.iter().filter_map(|r| match &r.word {
            Word::Goto(point) => Some((r.line, point)),
            _ => None,
        })
    }

    /// The range of the points; `None` without points.
    pub fn extent(&self) -> Option<Extent> {
        let mut points = self.points().map(|(_, p)| p);
        let first = points.next()?;
        let tilt = |p: &ClPoint| p.axis[0].hypot(p.axis[1]).atan2(p.axis[2]);
        let start =
            Extent { points: 1, min_mm: first.tip_mm, max_mm: first.tip_mm, tilt_rad: tilt(first) };
        Some(points.fold(start, |e, p| Extent {
            points: e.points + 1,
            min_mm: std::array::from_fn(|i| e.min_mm[i].min(p.tip_mm[i])),
            max_mm: std::array::from_fn(|i| e.max_mm[i].max(p.tip_mm[i])),
            tilt_rad: e.tilt_rad.max(tilt(p)),
        }))
    }
}
