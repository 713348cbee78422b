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
//! HEIDENHAIN: see [`heidenhain`].

pub(crate) mod heidenhain;

use super::program::ProgramError;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_nc::Control;

/// A position nearer to the end than this is the end: nothing was touched, mm.
pub(crate) const AT_THE_END_MM: f64 = 0.005;
/// The first line of the log of a surface or of poses.
pub const LOG_HEADING: &str = "TRUEAXIS HITS MM MACHINE";

/// A log: its first line and the stem of its file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct LogName {
    pub heading: &'static str,
    /// Small letters and hyphens.
    pub stem: &'static str,
}

/// The log of touches on a surface or a ball.
pub(super) const SURFACE_LOG: LogName = LogName { heading: LOG_HEADING, stem: "surface-hits" };

impl LogName {
    /// What comes before the first touch: the file is opened, and what must be zero is checked.
    pub fn open(self, control: Control) -> String {
        let heading = self.heading;
        match control {
            Control::Fanuc => format!("POPEN\nDPRNT[{}]", heading.replace(' ', "*")),
            Control::Haas => format!("DPRNT[{}]", heading.replace(' ', "*")),
            Control::LinuxCnc => {
                // G38.2 goes and counts in the work offset that is on: it must be zero.
                let zero: Vec<String> = (5381..=5390).map(|n| format!("ABS[#{n}]")).collect();
                format!(
                    "G92.2\nG59.3\no1 if [[{}] GT 0.00001]\n(ABORT, the work offset G59.3 must be 0)\no1 endif\n\
                     (LOGOPEN,{}.log)\n(LOG,{heading})",
                    zero.join(" + "),
                    self.stem
                )
            }
            Control::Sinumerik840d => self.write(&format!("\"{heading}\"")),
            Control::Heidenhain => heidenhain::open(self),
        }
    }

    /// SINUMERIK: a line of the log.
    pub fn write(self, text: &str) -> String {
        let file = self.stem.to_ascii_uppercase().replace('-', "_");
        format!("WRITE(TOUCH_ERROR,\"/_N_MPF_DIR/_N_{file}_MPF\",{text})")
    }

    /// The end of the log.
    pub fn close(self, control: Control, hits: usize) -> String {
        match control {
            Control::Fanuc => format!("DPRNT[END*{hits}]\nPCLOS"),
            Control::Haas => format!("DPRNT[END*{hits}]"),
            Control::LinuxCnc => format!("(LOG,END {hits})\n(LOGCLOSE)"),
            Control::Sinumerik840d => self.write(&format!("\"END {hits}\"")),
            Control::Heidenhain => heidenhain::close(self),
        }
    }
}

/// What must stand before everything else.
pub(crate) fn declare(control: Control) -> Option<&'static str> {
    (control == Control::Sinumerik840d).then_some("DEF INT TOUCH_ERROR")
}

/// Writes touches with what is kept of them.
#[derive(Debug, Clone, Copy)]
pub(super) struct TouchLog<'a> {
    pub machine: &'a Machine,
    pub control: Control,
    /// Written to be read back, not for the control: where no interpreter has the words of a touch (HEIDENHAIN),
    /// a motion to its end stands for it.
    pub is_stand_in: bool,
}

/// A touch by linear axes only.
#[derive(Debug, Clone, Copy)]
pub(super) struct Touch<'a> {
    /// Where it begins.
    pub from: &'a Command,
    /// Where it ends at the latest.
    pub target: &'a Command,
    pub mm_per_min: f64,
    /// For the log.
    pub hit: usize,
    pub pose: usize,
}

impl TouchLog<'_> {
    /// Towards a place until the probe triggers.
    ///
    /// # Errors
    /// The axes of the touch have no words on this control.
    pub fn touch(&self, touch: &Touch<'_>) -> Result<String, ProgramError> {
        let &Touch { target, mm_per_min, hit, pose, .. } = touch;
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
                SURFACE_LOG.write(&format!(
                    "\"H{hit} K{pose} T\"<<$P_TOOLNO<<\"{}\"",
                    self.kept(target, ' ', |name, _| format!("{name}\"<<$AA_MM[{name}]<<\""))
                ))
            ),
            Control::Heidenhain => self.heidenhain(touch)?,
        })
    }

    fn heidenhain(&self, touch: &Touch<'_>) -> Result<String, ProgramError> {
        let place = |command: &Command| {
            let mut place = [0.0; 3];
            for (name, q) in self.axes(command, AxisKind::Linear) {
                *place.get_mut("XYZ".find(name)?)? = q;
            }
            Some(place)
        };
        let (Some(from), Some(to)) = (place(touch.from), place(touch.target)) else {
            return Err(ProgramError::NoProbing("HEIDENHAIN"));
        };
        let probe = heidenhain::Probing {
            from_mm: from,
            to_mm: to,
            way_mm: None,
            mm_per_min: touch.mm_per_min,
            back_mm: 0.0,
            is_stand_in: self.is_stand_in,
        };
        let kept: Vec<(u32, f64)> = [touch.hit, touch.pose]
            .into_iter()
            .map(|n| n as f64)
            .chain(self.axes(touch.target, AxisKind::Rotary).map(|(_, q)| q.to_degrees() + 0.0))
            .zip(heidenhain::KEPT)
            .map(|(value, q)| (q, value))
            .collect();
        Ok(format!("{}\n{}", heidenhain::probe(&probe), heidenhain::keep(SURFACE_LOG, &kept)))
    }

    /// The files that the program needs beside itself.
    pub fn files(&self) -> Vec<(String, String)> {
        if self.control != Control::Heidenhain {
            return Vec::new();
        }
        let rotary = self.machine.axes().iter().filter(|a| a.kind == AxisKind::Rotary);
        let words = ["H".to_owned(), "K".to_owned()]
            .into_iter()
            .chain(rotary.map(|a| a.name.letter().to_string()));
        let mut columns: Vec<heidenhain::Column> = words
            .zip(heidenhain::KEPT)
            .enumerate()
            .map(|(i, (word, q))| heidenhain::Column {
                word,
                q,
                decimals: if i < 2 { 0 } else { 5 },
            })
            .collect();
        let result = heidenhain::RESULT;
        let place = [("X", result), ("Y", result + 1), ("Z", result + 2)];
        let place = place.map(|(word, q)| heidenhain::Column { word: word.into(), q, decimals: 4 });
        columns.splice(2..2, place);
        heidenhain::masks(SURFACE_LOG, &columns)
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
