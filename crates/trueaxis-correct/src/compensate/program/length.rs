//! Corrections count on the length of the tool: where it matters, it has to be stated.

use super::walk::Walk;
use trueaxis_geometry::Vec3;
use trueaxis_input::{Diagnostics, Place};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, Command};
use trueaxis_motion::SetUp;

/// Tools are taken to differ by so much whose length is not stated, mm.
const LENGTH_MM: f64 = 100.0;

/// The tool length that the program has switched on, and the tool that is in the spindle.
#[derive(Debug, Default)]
pub(super) struct Lengths {
    on: Vec3,
    tool: Option<u32>,
    /// The program or the set-up gave the control a tool length.
    pub is_stated: bool,
}

impl Lengths {
    pub fn switch_on(&mut self, length: Vec3) {
        self.on = length;
        self.is_stated |= length != Vec3::zeros();
    }

    pub fn change_tool(&mut self, number: u32) {
        self.tool = Some(number);
    }

    /// What the control counts with in a cut of this line, where a tool of the set-up is in the spindle that has another length.
    pub fn other(&self, mounted: &Machine, residual_mm: f64, line: u32) -> Option<OtherLength> {
        let tool = self.tool?;
        let length = -mounted.tip_mm();
        let differs = (self.on - length).norm() > residual_mm;
        differs.then_some(OtherLength { line, tool, on_mm: self.on.z, length_mm: length.z })
    }
}

/// A cut in which the control counts with another length than that of the tool.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct OtherLength {
    line: u32,
    tool: u32,
    on_mm: f64,
    length_mm: f64,
}

impl OtherLength {
    /// Where the proof fails: the tip cannot be where the program says.
    pub fn tell(&self, file: &str, found: &mut Diagnostics) {
        let Self { line, tool, on_mm, length_mm } = self;
        let message = match *on_mm == 0.0 {
            true => {
                format!("T{tool} is {length_mm} mm long in the set-up; no tool length is on here")
            }
            false => format!(
                "T{tool} is {length_mm} mm long in the set-up; the length that is on here is {on_mm} mm"
            ),
        };
        let hint = "switch its length on (G43 H); if the work offset contains the length, leave [tool.N] out of the \
                    set-up: the tool of the machine file is taken";
        let place = Place { file: file.to_owned(), line: *line as usize, column: 1 };
        found.warn("tool-length-differs", place, message, hint);
    }
}

/// The control's warning of a tool that it does not know.
const UNLISTED: &str = "unknown-tool-length";

/// An error where a tool has no stated length, and either the program counts with it
/// (tool-centre-point control) or the errors at the tip depend on it by more than the residual.
pub(super) fn require(
    mounted: &Machine,
    walk: &Walk<'_>,
    (file, setup, residual_mm): (&str, &SetUp, f64),
    problems: &mut Diagnostics,
) {
    // Without tools in the set-up the one of the machine file is in the spindle.
    if mounted.is_tip_stated() && setup.tools.is_empty() {
        return;
    }
    let unlisted = problems.iter().find(|d| d.code == UNLISTED).map(|d| d.place.clone());
    let followed = walk.tip_followed.filter(|_| setup.tools.is_empty() && !walk.lengths.is_stated);
    let at_line = |line: u32| Place { file: file.to_owned(), line: line as usize, column: 1 };
    let Some(place) = unlisted.or(followed.map(at_line)) else { return };
    let why = match walk.tip_followed {
        Some(_) => "with tool-centre-point control the axes depend on it".to_owned(),
        None => {
            let changed_mm = dependence_mm(mounted, &walk.found.places);
            if changed_mm <= residual_mm {
                return;
            }
            let changed_um = changed_mm * 1e3;
            format!("{LENGTH_MM} mm more change the error of the tip by up to {changed_um:.1} µm")
        }
    };
    let message = format!("the length of the tool is not stated, and {why}");
    let hint = "state it: [tool.NUMBER] with length in the set-up file (--setup), --tool-length, or length in [tool] \
                of the machine file, which is taken where the set-up lists no tools";
    problems.error("tool-length-needed", place, message, hint);
}

/// By how much a longer tool changes the error of the tip at most, mm.
fn dependence_mm(machine: &Machine, places: &[Command]) -> f64 {
    let longer = machine.clone().with_tip(machine.tip_mm() - Vec3::new(0.0, 0.0, LENGTH_MM));
    let error = |machine: &Machine, at: &Command| {
        let errors = machine.errors_at(at, &Approach::default()).ok()?;
        Some(machine.deviation(at, &errors).tip_mm)
    };
    let change = |at: &Command| Some((error(&longer, at)? - error(machine, at)?).norm());
    places.iter().filter_map(change).fold(0.0, f64::max)
}
