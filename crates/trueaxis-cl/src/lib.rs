//! Cutter-location files: where the CAM system wants the tool.
//!
//! APT CLDATA as text in the dialects of Creo (GPOST, Pro/CL), NCL, CATIA aptsource and SolidWorks
//! CAM, and plain tables of `x y z i j k`. Nothing of a file is lost: every line belongs to a
//! [`Record`], words without effect are kept as such, unknown ones are told with their line.
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

mod reader;
mod rewrite;
mod scan;
mod words;

use std::ops::Range;
use trueaxis_input::Diagnostics;
use trueaxis_nc::moves::{Coolant, Feed, Turning};

/// One place of the tool.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClPoint {
    /// The tip in the part, mm.
    pub tip_mm: [f64; 3],
    /// From the tip to the spindle, length 1.
    pub axis: [f64; 3],
    /// As fast as the machine can.
    pub rapid: bool,
    /// How fast else; `None` before the first FEDRAT.
    pub feed: Option<Feed>,
}

/// A circle on which the next point is reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClCircle {
    /// Its centre, mm.
    pub center_mm: [f64; 3],
    /// The tool turns counter-clockwise about it; length 1.
    pub normal: [f64; 3],
}

/// A drilling cycle; lengths along the tool axis from the point, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClCycle {
    /// How deep.
    pub depth_mm: f64,
    /// Above the point, down to where it goes in rapid.
    pub clearance_mm: f64,
    /// Above the point, up to where it goes at the end.
    pub retract_mm: f64,
    /// The feed downwards, if the cycle has one.
    pub feed: Option<Feed>,
}

/// What a record says.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Word {
    /// GOTO, GODLTA, or a row of a table.
    Goto(ClPoint),
    /// FROM: where the tool stands first; nothing moves.
    From(ClPoint),
    /// CIRCLE: the next GOTO is reached along it.
    Circle(ClCircle),
    /// RAPID: for the next motion.
    Rapid,
    /// FEDRAT.
    Feed(Feed),
    /// SPINDL: which way, and revolutions per minute where given.
    Spindle(Turning, Option<f64>),
    /// COOLNT.
    Coolant(Coolant),
    /// LOADTL, LOAD/TOOL: the number.
    Tool(u32),
    /// CUTTER: diameter and radius of the corner, mm.
    Cutter {
        /// Across.
        diameter_mm: f64,
        /// Of the corner.
        corner_radius_mm: f64,
    },
    /// TLAXIS: for the points without vector that follow.
    ToolAxis([f64; 3]),
    /// MULTAX ON or OFF.
    MultiAxis(bool),
    /// UNITS: `true` for inches.
    Inches(bool),
    /// CYCLE: at each point that follows.
    Cycle(ClCycle),
    /// CYCLE/OFF.
    CycleOff,
    /// DELAY, s.
    Delay(f64),
    /// STOP or OPSTOP.
    Stop {
        /// OPSTOP.
        optional: bool,
    },
    /// INSERT: a line for the control as it is.
    Insert(String),
    /// PARTNO, REMARK, PPRINT, TPRINT, `$$`: for people.
    Comment(String),
    /// FINI, END.
    End,
    /// A word of the language without effect on the path here.
    Noted,
    /// A word that nobody knows here.
    Unknown,
}

/// One statement of the file.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// Where it begins, from 1.
    pub line: u32,
    /// Its bytes, continuation lines and comments included.
    pub span: Range<usize>,
    /// What it says; lengths in mm, modal words resolved.
    pub word: Word,
}

/// What is taken where the file is silent, or instead of what it says.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Reading {
    /// Lengths are inches (or not), whatever UNITS says.
    pub inches: Option<bool>,
}

/// A cutter-location file.
#[derive(Debug, Clone, PartialEq)]
pub struct ClFile {
    name: String,
    source: Vec<u8>,
    records: Vec<Record>,
}

/// How much a file moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// How many points.
    pub points: usize,
    /// The smallest coordinates, mm.
    pub min_mm: [f64; 3],
    /// The largest.
    pub max_mm: [f64; 3],
    /// The largest angle of the tool axis against Z of the part, rad.
    pub tilt_rad: f64,
}

impl ClFile {
    /// Reads a file; all problems at once. With errors the records are there, but not to be cut.
    pub fn read(name: &str, source: Vec<u8>, reading: &Reading) -> (Self, Diagnostics) {
        let (records, problems) = reader::read(name, &source, reading);
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

    /// All points that the tool goes to, each with its line.
    pub fn points(&self) -> impl Iterator<Item = (u32, &ClPoint)> {
        self.records.iter().filter_map(|r| match &r.word {
            Word::Goto(point) => Some((r.line, point)),
            _ => None,
        })
    }

    /// How far the points reach; `None` without points.
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
