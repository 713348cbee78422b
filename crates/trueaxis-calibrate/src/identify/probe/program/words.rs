//! A touch in two stages, what is kept of it and what is computed of it, in the words of each control.
//!
//! ```text
//!     fast until it triggers ─ back from there ─ slow until it triggers ─ (correction) ─ line of the log
//! ```
//!
//! The variables are common ones that any program may use: #101 to #139 (FANUC, HAAS), R81 to R99 (SINUMERIK), Q30
//! to Q59 (HEIDENHAIN), `#<_ta_…>` (LinuxCNC).

use crate::plan::touch::{AT_THE_END_MM, LogName, heidenhain};
use trueaxis_nc::Control;

/// The log of hits in a ring.
pub(super) const RING_LOG: LogName =
    LogName { heading: "TRUEAXIS RING MM MACHINE", stem: "ring-hits" };
/// The same where the control has corrected each hit.
pub(super) const CORRECTED_LOG: LogName =
    LogName { heading: "TRUEAXIS RING MM MACHINE CORRECTED", stem: "ring-corrected" };
/// The log of four hits in a ring.
pub(super) const FOUR_LOG: LogName =
    LogName { heading: "TRUEAXIS RING MM MACHINE", stem: "four-hits" };
/// The same, corrected.
pub(super) const FOUR_CORRECTED_LOG: LogName =
    LogName { heading: "TRUEAXIS RING MM MACHINE CORRECTED", stem: "four-hits-corrected" };
/// The log of hits on a plane face.
pub(super) const PLANE_LOG: LogName =
    LogName { heading: "TRUEAXIS PLANE MM MACHINE", stem: "z-datum" };
/// The same, with the length of the probe subtracted.
pub(super) const PLANE_CORRECTED_LOG: LogName =
    LogName { heading: "TRUEAXIS PLANE MM MACHINE CORRECTED", stem: "z-datum-corrected" };

/// A value that the control computes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Value {
    /// Place of the hit.
    HitX,
    HitY,
    /// Way of the touch, from where it began to the hit.
    WayX,
    WayY,
    /// Corrected place.
    X,
    Y,
    /// What was subtracted.
    Dr,
    /// Kept hits: X+, X−, Y+, Y−.
    Kept(u32),
    /// Results.
    FirstResult,
    SecondResult,
    ThirdResult,
    FourthResult,
}

impl Value {
    fn index(self) -> u32 {
        match self {
            Self::HitX => 1,
            Self::HitY => 2,
            Self::WayX => 3,
            Self::WayY => 4,
            Self::X => 5,
            Self::Y => 6,
            Self::Dr => 7,
            Self::Kept(i) => 8 + i.min(3),
            Self::FirstResult => 12,
            Self::SecondResult => 13,
            Self::ThirdResult => 14,
            Self::FourthResult => 15,
        }
    }

    /// Its name in a program.
    pub fn name(self, control: Control) -> String {
        let i = self.index();
        match control {
            Control::Fanuc | Control::Haas => format!("#{}", 100 + i),
            Control::LinuxCnc => {
                const NAMES: [&str; 16] = [
                    "", "hit_x", "hit_y", "way_x", "way_y", "x", "y", "dr", "a", "b", "c", "d",
                    "result_1", "result_2", "result_3", "result_4",
                ];
                format!("#<_ta_{}>", NAMES.get(i as usize).unwrap_or(&""))
            }
            Control::Sinumerik840d => format!("R{}", 80 + i),
            Control::Heidenhain => format!("Q{}", 30 + i),
        }
    }
}

/// The place of the last trigger, by axis (0 to 2).
pub(super) fn trigger(control: Control, axis: u32) -> String {
    match control {
        Control::Fanuc | Control::Haas | Control::LinuxCnc => format!("#{}", 5061 + axis),
        Control::Sinumerik840d => {
            format!("$AA_MM[{}]", ["X", "Y", "Z"].get(axis as usize).unwrap_or(&"Z"))
        }
        Control::Heidenhain => format!("Q{}", heidenhain::RESULT + axis),
    }
}

/// `value = expression`, with round brackets in the expression.
pub(super) fn assign(control: Control, value: Value, expression: &str) -> String {
    let name = value.name(control);
    match control {
        Control::Fanuc | Control::Haas => format!("{name}={}", square(expression)),
        Control::LinuxCnc => format!("{name} = [{}]", square(expression)),
        Control::Sinumerik840d => format!("{name}={expression}"),
        // Blanks keep numbers and signs apart.
        Control::Heidenhain => format!("{name} = {expression}"),
    }
}

fn square(expression: &str) -> String {
    expression.replace('(', "[").replace(')', "]")
}

/// A number of a program in brackets, so that its sign stands with it alone.
pub(super) fn number(value: f64) -> String {
    format!("( {:.4} )", value + 0.0)
}

/// A touch, machine coordinates of the spindle.
#[derive(Debug, Clone, Copy)]
pub(super) struct TwoStage {
    pub hit: usize,
    pub from_mm: [f64; 3],
    pub to_mm: [f64; 3],
    pub back_mm: f64,
    pub fast_mm_per_min: f64,
    pub slow_mm_per_min: f64,
    /// See [`heidenhain::Probing::is_stand_in`].
    pub is_stand_in: bool,
}

impl TwoStage {
    fn direction(&self) -> [f64; 3] {
        let way = [0, 1, 2].map(|i| self.to_mm[i] - self.from_mm[i]);
        let length = way.iter().map(|d| d * d).sum::<f64>().sqrt();
        way.map(|d| d / length)
    }

    /// The axes that move.
    fn words(&self, place: [f64; 3]) -> String {
        let moves = |i: &usize| (self.to_mm[*i] - self.from_mm[*i]).abs() > 1e-9;
        let word = |i: usize| format!(" {}{:.4}", ["X", "Y", "Z"][i], place[i] + 0.0);
        (0..3).filter(moves).map(word).collect()
    }
}

/// Both stages with their alarms; the last trigger is what counts.
pub(super) fn two_stage(control: Control, t: &TwoStage) -> String {
    let back: Vec<f64> = t.direction().iter().map(|u| -u * t.back_mm).collect();
    let back = t.words([back[0], back[1], back[2]]);
    let to = t.words(t.to_mm);
    let feeds = [t.fast_mm_per_min, t.slow_mm_per_min].map(|f| format!("{f:.1}"));
    let alarm = format!("NO TOUCH AT HIT {}", t.hit);
    match control {
        Control::Fanuc | Control::Haas => {
            let off: Vec<String> = (0..3)
                .filter(|i| (t.to_mm[*i] - t.from_mm[*i]).abs() > 1e-9)
                .map(|i| format!("ABS[#{}-[{:.4}]]", 5061 + i, t.to_mm[i] + 0.0))
                .collect();
            let stage = |feed: &str, label: usize| {
                format!(
                    "G31{to} F{feed}\nIF[[{}]GT{AT_THE_END_MM}]GOTO{label}\n#3000=1({alarm})\nN{label}\n",
                    off.join("+")
                )
            };
            format!(
                "{}G91 G1{back} F{}\nG90\n{}",
                stage(&feeds[0], 2 * t.hit - 1),
                feeds[0],
                stage(&feeds[1], 2 * t.hit)
            )
        }
        Control::LinuxCnc => format!(
            "G38.2{to} F{}\nG91 G1{back} F{}\nG90\nG38.2{to} F{}\n",
            feeds[0], feeds[0], feeds[1]
        ),
        Control::Sinumerik840d => {
            let stage = |feed: &str| {
                format!(
                    "MEAS=1 G1{to} F{feed}\nSTOPRE\nIF $AC_MEA[1]==0\nSETAL(65001,\"{alarm}\")\nM0\nENDIF\n"
                )
            };
            format!("{}G91 G1{back} F{}\nG90\n{}", stage(&feeds[0]), feeds[0], stage(&feeds[1]))
        }
        Control::Heidenhain => {
            let stage = |mm_per_min: f64, back_mm: f64, way_mm: Option<f64>| {
                heidenhain::probe(&heidenhain::Probing {
                    from_mm: t.from_mm,
                    to_mm: t.to_mm,
                    way_mm,
                    mm_per_min,
                    back_mm,
                    is_stand_in: t.is_stand_in,
                })
            };
            // The second touch begins where the first has triggered, less the way back, and goes as far beyond it.
            format!(
                "{}\n{}\n",
                stage(t.fast_mm_per_min, t.back_mm, None),
                stage(t.slow_mm_per_min, 0.0, Some(2.0 * t.back_mm))
            )
        }
    }
}
