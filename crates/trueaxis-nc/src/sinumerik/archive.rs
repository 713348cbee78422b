//! Reads dumps of tools and work offsets that the control writes (INITIAL.INI).

use std::collections::BTreeMap;

use trueaxis_input::Diagnostics;

use super::Run;
use super::values::Value;
use crate::dialect::Control;
use crate::execution::{Alone, Core, Language, NoLibrary, Settings};
use crate::moves::{Frame, Position};
use crate::text::program::{Fault, Program};

/// A tool of a dump.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ArchivedTool {
    /// Its name: $TC_TP2.
    pub name: String,
    /// Lengths 1, 2 and 3 along Z, Y and X, as they lie in G17: $TC_DP3 to $TC_DP5, mm.
    pub length_mm: Position,
    /// The radius: $TC_DP6, mm.
    pub radius_mm: f64,
    /// The corner radius: $TC_DP7, mm.
    pub corner_radius_mm: f64,
    /// The kind by Siemens' number, such as 120 for an end mill: $TC_DP1.
    pub kind: u32,
}

/// What a dump tells about the set-up.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Archive {
    /// The settable frames by number, from 1 for G54, 5 for G505.
    pub work_offsets: BTreeMap<u32, Frame>,
    /// The tools by number, with their first cutting edge.
    pub tools: BTreeMap<u32, ArchivedTool>,
}

impl Archive {
    /// Takes the tools and work offsets over into the settings of a run.
    ///
    /// ```
    /// use trueaxis_nc::{Settings, sinumerik::read_archive};
    /// let (archive, _) = read_archive("setup.ini", b"$TC_TP2[3]=\"MILL 10\"\n$TC_DP3[3,1]=150.5\n");
    /// let mut settings = Settings::default();
    /// archive.apply_to(&mut settings);
    /// assert_eq!(settings.tool_names["MILL 10"], 3);
    /// assert_eq!(settings.tools[&3].0[2], 150.5);
    /// ```
    pub fn apply_to(&self, settings: &mut Settings) {
        settings.work_offsets.extend(self.work_offsets.iter().map(|(n, frame)| (*n, *frame)));
        for (number, tool) in &self.tools {
            settings.tools.insert(*number, tool.length_mm);
            settings.radii.insert(*number, tool.radius_mm);
            if !tool.name.is_empty() {
                settings.tool_names.insert(tool.name.clone(), *number);
            }
        }
    }
}

/// Reads `$P_UIFR` and `$TC_…` of a dump; everything else in it has no effect.
///
/// ```
/// let text = b"CHANDATA(1)\n$TC_TP2[3]=\"MILL 10\"\n$TC_DP3[3,1]=150.5\n$P_UIFR[1]=CTRANS(X,10)\nM30\n";
/// let (archive, problems) = trueaxis_nc::sinumerik::read_archive("setup.ini", text);
/// assert!(!problems.has_errors());
/// assert_eq!(archive.tools[&3].name, "MILL 10");
/// assert_eq!(archive.tools[&3].length_mm.0[2], 150.5);
/// assert_eq!(archive.work_offsets[&1].shift.0[0], 10.0);
/// ```
pub fn read_archive(file: &str, text: &[u8]) -> (Archive, Diagnostics) {
    let program = Program::new(file, text.to_vec(), Control::Sinumerik840d);
    // A dump has no loops.
    let settings = Settings { keep_going: true, most_jumps: 1000, ..Settings::default() };
    let mut ignore = |_| {};
    let mut alone = Alone { take: &mut ignore, steps: 0 };
    let core = Core::new(&program, &NoLibrary, &settings, &mut alone);
    let mut run = Run::new(&program, core);
    run.archive = Some(Box::default());
    let problems = run.outcome().problems;
    (run.archive.map(|a| *a).unwrap_or_default(), problems)
}

/// Keeps one datum of a tool; `place` is the tool and its cutting edge.
pub(super) fn write_tool(
    archive: &mut Archive,
    name: &str,
    place: [u32; 2],
    value: &Value,
    at: usize,
) -> Result<(), Fault> {
    let [tool, edge] = place;
    if edge > 1 || archive.tools.len() >= 100_000 {
        return Ok(());
    }
    let entry = || -> ArchivedTool { archive.tools.get(&tool).cloned().unwrap_or_default() };
    let mut kept = entry();
    match name {
        "TC_TP2" => kept.name = value.text(at)?,
        "TC_DP1" => kept.kind = value.number(at)?.clamp(0.0, 1e6) as u32,
        "TC_DP3" => kept.length_mm.0[2] = value.number(at)?,
        "TC_DP4" => kept.length_mm.0[1] = value.number(at)?,
        "TC_DP5" => kept.length_mm.0[0] = value.number(at)?,
        "TC_DP6" => kept.radius_mm = value.number(at)?,
        "TC_DP7" => kept.corner_radius_mm = value.number(at)?,
        _ => return Ok(()),
    }
    archive.tools.insert(tool, kept);
    Ok(())
}
