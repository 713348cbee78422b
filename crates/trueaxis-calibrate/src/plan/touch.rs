//! A touch in the words of each control: until the probe triggers, an alarm where it does not, and a line of the
//! log with tool, pose, rotary axes and the place where it triggered.
//!
//! ```text
//!     TRUEAXIS HITS MM MACHINE               unit and frame
//!     H1 K1 T1 X12.3456 Y-3.0000 Z80.1234 A-30.00000 C45.00000
//!     END 71                                 how many hits there were
//! ```
//!
//! H counts the hits, K is the point or pose, T the tool of the control.
//!
//! # Source
//! FANUC and HAAS: skip position #5061 ff., `#3000` and `DPRNT` as in the Haas manual 96-8000 (macros, formatted
//! output); `POPEN`, `PCLOS` of custom macro B. LinuxCNC: G38.2 (an alarm of its own where nothing is touched),
//! #5061 ff., `(LOGOPEN,…)`, `(LOG,…)`, `(LOGCLOSE)` as in its documentation; G53 stands with G0 and G1 only there.
//! SINUMERIK: `MEAS`, `$AC_MEA`, `$AA_MM`, `WRITE`, `SETAL` as in the programming manual "Job planning".

use super::program::ProgramError;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_nc::Control;

/// A position nearer to the end than this is the end: nothing was touched, mm.
const AT_THE_END_MM: f64 = 0.005;
/// The first line of every log.
pub const LOG_HEADING: &str = "TRUEAXIS HITS MM MACHINE";
/// The file of the log of SINUMERIK.
const SINUMERIK_FILE: &str = "/_N_MPF_DIR/_N_SURFACE_HITS_MPF";

/// Writes touches with what is kept of them.
#[derive(Debug, Clone, Copy)]
pub(super) struct TouchLog<'a> {
    pub machine: &'a Machine,
    pub control: Control,
}

/// What comes before the first touch: the file is opened, and what must be zero is checked.
pub(super) fn touch_start(log: &TouchLog<'_>) -> Result<String, ProgramError> {
    Ok(match log.control {
        Control::Fanuc => format!("POPEN\nDPRNT[{}]", LOG_HEADING.replace(' ', "*")),
        Control::Haas => format!("DPRNT[{}]", LOG_HEADING.replace(' ', "*")),
        Control::LinuxCnc => {
            // G38.2 goes and counts in the work offset that is on: it must be zero.
            let zero: Vec<String> = (5381..=5390).map(|n| format!("ABS[#{n}]")).collect();
            format!(
                "G92.2\nG59.3\no1 if [[{}] GT 0.00001]\n(ABORT, the work offset G59.3 must be 0)\no1 endif\n\
                 (LOGOPEN,surface-hits.log)\n(LOG,{LOG_HEADING})",
                zero.join(" + ")
            )
        }
        Control::Sinumerik840d => write_line(&format!("\"{LOG_HEADING}\"")),
        Control::Heidenhain => return Err(ProgramError::NoProbing("HEIDENHAIN")),
    })
}

fn write_line(text: &str) -> String {
    format!("WRITE(TOUCH_ERROR,\"{SINUMERIK_FILE}\",{text})")
}

impl TouchLog<'_> {
    /// What must stand before everything else.
    pub fn declare(&self) -> Option<&'static str> {
        (self.control == Control::Sinumerik840d).then_some("DEF INT TOUCH_ERROR")
    }

    /// Towards a place until the probe triggers, by linear axes only; `hit` and `pose` go into the log.
    pub fn touch(
        &self,
        target: &Command,
        mm_per_min: f64,
        hit: usize,
        pose: usize,
    ) -> Result<String, ProgramError> {
        let mut words = String::new();
        for (name, q) in self.axes(target, AxisKind::Linear) {
            let equals = matches!(self.control, Control::Sinumerik840d) && name > 'Z';
            let sign = if equals { "=" } else { "" };
            words += &format!(" {name}{sign}{q:.4}");
        }
        let feed = format!("{mm_per_min:.1}");
        let alarm = format!("NO TOUCH AT HIT {hit}");
        Ok(match self.control {
            Control::Fanuc | Control::Haas => {
                let off: Vec<String> = self
                    .axes(target, AxisKind::Linear)
                    .map(|(name, q)| match variable(name) {
                        Some(number) => format!("ABS[#{number}-[{q:.4}]]"),
                        None => "0".to_owned(),
                    })
                    .collect();
                format!(
                    "G31{words} F{feed}\nIF[[{}]GT{AT_THE_END_MM}]GOTO{hit}\n#3000=1({alarm})\nN{hit}\n\
                     DPRNT[H{hit}*K{pose}*T#4120[40]{}]",
                    off.join("+"),
                    self.kept(target, '*', |name, q| match variable(name) {
                        Some(number) => format!("{name}#{number}[44]"),
                        None => format!("{name}{q:.4}"),
                    })
                )
            }
            Control::LinuxCnc => format!(
                "G38.2{words} F{feed}\n(LOG,H{hit} K{pose} T#5400{})",
                self.kept(target, ' ', |name, q| match variable(name) {
                    Some(number) => format!("{name}#{number}"),
                    None => format!("{name}{q:.4}"),
                })
            ),
            Control::Sinumerik840d => format!(
                "MEAS=1 G1{words} F{feed}\nSTOPRE\nIF $AC_MEA[1]==0\nSETAL(65001,\"{alarm}\")\nM0\nENDIF\n{}",
                write_line(&format!(
                    "\"H{hit} K{pose} T\"<<$P_TOOLNO<<\"{}\"",
                    self.kept(target, ' ', |name, _| format!("{name}\"<<$AA_MM[{name}]<<\""))
                ))
            ),
            Control::Heidenhain => return Err(ProgramError::NoProbing("HEIDENHAIN")),
        })
    }

    /// The end of the log.
    pub fn close(&self, hits: usize) -> String {
        match self.control {
            Control::Fanuc => format!("DPRNT[END*{hits}]\nPCLOS"),
            Control::Haas => format!("DPRNT[END*{hits}]"),
            Control::LinuxCnc => format!("(LOG,END {hits})\n(LOGCLOSE)"),
            Control::Sinumerik840d => write_line(&format!("\"END {hits}\"")),
            Control::Heidenhain => String::new(),
        }
    }

    /// The words of a line: linear axes where it triggered, rotary axes where they were commanded.
    fn kept(&self, target: &Command, gap: char, linear: impl Fn(char, f64) -> String) -> String {
        let mut words = String::new();
        for (name, q) in self.axes(target, AxisKind::Linear) {
            words += &format!("{gap}{}", linear(name, q));
        }
        for (name, q) in self.axes(target, AxisKind::Rotary) {
            words += &format!("{gap}{name}{:.5}", q.to_degrees() + 0.0);
        }
        words
    }

    fn axes<'c>(
        &'c self,
        target: &'c Command,
        kind: AxisKind,
    ) -> impl Iterator<Item = (char, f64)> + 'c {
        let all = self.machine.axes().iter().zip(target);
        all.filter(move |(axis, _)| axis.kind == kind)
            .map(|(axis, q)| (axis.name.letter(), q + 0.0))
    }
}

/// The variable of the position where the probe triggered; those of other axes are numbered by the builder.
fn variable(name: char) -> Option<u32> {
    "XYZ".find(name).map(|i| 5061 + i as u32)
}
