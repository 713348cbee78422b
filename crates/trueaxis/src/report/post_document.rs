//! The document `trueaxis/post/1`.

use super::post::PostReport;
use serde::Serialize;
use trueaxis_post::{Largest, PostOptions, Verification};
use trueaxis_report::JsonSchema;

/// An NC program from cutter locations.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PostDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/post/1"))]
    pub schema: &'static str,
    /// The name of the machine.
    pub machine: &'a str,
    /// The file of the cutter locations.
    pub file: &'a str,
    /// The file of the program.
    pub program: String,
    /// Whether the program was written: not where the verification found it out of tolerance.
    pub written: bool,
    /// Points of the cutter-location file.
    pub points: usize,
    /// Strokes of the tool in the file.
    pub strokes: usize,
    /// Blocks that move the tool along them.
    pub blocks: usize,
    /// Lines of the program.
    pub lines: usize,
    /// Blocks that are arcs.
    pub arcs: usize,
    /// Holes that the control drills by its own cycle.
    pub holes: usize,
    /// How many of them are tapped threads.
    pub threads: usize,
    /// How often the tool retracts so that an axis can rewind.
    pub rewinds: usize,
    /// How far the tool axis was turned to pass through a pole, degrees.
    pub pole_deviation_deg: f64,
    /// The tolerance of the tip, mm.
    pub tolerance_mm: f64,
    /// The tolerance of the tool axis, degrees.
    pub axis_tolerance_deg: f64,
    /// Words of the file that can change motion, spindle or coolant and are not applied; the exit status is then 1.
    pub not_applied: usize,
    /// The program read back and simulated; null if that was not asked for.
    pub verify: Option<VerificationEntry>,
}

/// A program read back and simulated on the nominal machine.
#[derive(Debug, Serialize, JsonSchema)]
pub struct VerificationEntry {
    /// Whether it is within the tolerances and every axis within its travel.
    pub within_tolerance: bool,
    /// How many blocks were compared at their ends.
    pub blocks_compared: usize,
    /// Largest deviation of the tip at the ends of blocks, µm.
    pub tip_at_blocks_um: LargestEntry,
    /// Largest deviation of the tool axis at the ends of blocks, µrad.
    pub axis_at_blocks_urad: LargestEntry,
    /// Largest distance of the tip from the path, µm.
    pub tip_on_path_um: LargestEntry,
    /// Largest angle of the tool axis from the path, degrees.
    pub axis_on_path_deg: LargestEntry,
    /// Largest error of the lead of tapped threads over their depth, µm; 0 without threads, null where one is not tapped.
    pub lead_um: LargestEntry,
    /// Whether an axis leaves its travel.
    pub axes_beyond_travel: bool,
}

/// The largest deviation and where it is.
#[derive(Debug, Serialize, JsonSchema)]
pub struct LargestEntry {
    /// The value. Unit: that of the key.
    pub value: f64,
    /// The line of the program.
    pub program_line: u32,
    /// The line of the cutter-location file.
    pub file_line: u32,
}

impl<'a> From<&PostReport<'a>> for PostDocument<'a> {
    fn from(report: &PostReport<'a>) -> Self {
        let PostReport { machine, file, points, options, posted, verification, .. } = report;
        Self {
            schema: "trueaxis/post/1",
            machine: machine.name(),
            file,
            program: report.output.display().to_string(),
            written: report.is_sound(),
            points: *points,
            strokes: posted.strokes,
            blocks: posted.blocks,
            lines: posted.lines,
            arcs: posted.arcs,
            holes: posted.holes(),
            threads: posted.threads(),
            rewinds: posted.rewinds,
            pole_deviation_deg: posted.pole_deviation_rad.to_degrees(),
            tolerance_mm: options.tolerance_mm,
            axis_tolerance_deg: options.axis_tolerance_rad.to_degrees(),
            not_applied: report.not_applied,
            verify: verification.map(|v| VerificationEntry::of(v, options)),
        }
    }
}

impl VerificationEntry {
    fn of(v: &Verification, options: &PostOptions) -> Self {
        let largest = |l: &Largest, scale: f64| LargestEntry {
            value: l.value * scale,
            program_line: l.program_line,
            file_line: l.file_line,
        };
        Self {
            within_tolerance: v.is_within(options),
            blocks_compared: v.compared,
            tip_at_blocks_um: largest(&v.tip_at_ends, 1e3),
            axis_at_blocks_urad: largest(&v.axis_at_ends, 1e6),
            tip_on_path_um: largest(&v.tip_between, 1e3),
            axis_on_path_deg: largest(&v.axis_between, 1_f64.to_degrees()),
            lead_um: largest(&v.lead, 1e3),
            axes_beyond_travel: v.issues.is_critical(),
        }
    }
}
