//! The program of a question: its files, and how its path is divided and timed.

use super::words;
use super::{MachineChoice, named_control};
use std::path::PathBuf;
use trueaxis_input::{Diagnostics, Files};
use trueaxis_motion::{Densify, Job, Options, ProgramFiles, Stop, Timing};

/// An NC program and how it is simulated. Texts are as typed: plain numbers in mm and degrees.
#[derive(Debug, Clone)]
pub struct ProgramChoice {
    /// The program.
    pub program: PathBuf,
    /// Its text if it is not to be read from its file.
    pub text: Option<String>,
    /// Work offsets, tools, stock, fixtures.
    pub setup: Option<PathBuf>,
    /// The control of the program, by its name.
    pub control: Option<String>,
    /// Largest distance between path and chord.
    pub chord: String,
    /// Longest piece of a move.
    pub spacing: String,
    /// Largest rotation in a piece.
    pub angle: String,
    /// Whether moves are divided by spacing and angle alone.
    pub by_count: bool,
    /// Whether moves are not divided at all, except circles.
    pub no_densify: bool,
    /// Corner rounding tolerance where the program states none.
    pub rounding: String,
    /// The mean acceleration of blocks of three phases, mm/s², instead of looking ahead.
    pub three_phase: Option<String>,
    /// Whether the velocity changes smoothly then.
    pub smooth: bool,
    /// Backward jumps and calls after which the program counts as an endless loop.
    pub most_jumps: u64,
    /// Whether errors of the program are listed and the simulation goes on.
    pub keep_going: bool,
    /// Whether optional blocks, `/`, are left out, as the switch of the control does.
    pub without_optional: bool,
    /// Ends the simulation early on request.
    pub stop: Stop,
}

impl Default for ProgramChoice {
    fn default() -> Self {
        Self {
            program: PathBuf::new(),
            text: None,
            setup: None,
            control: None,
            chord: "0.005".into(),
            spacing: "10".into(),
            angle: "1".into(),
            by_count: false,
            no_densify: false,
            rounding: "0.01".into(),
            three_phase: None,
            smooth: false,
            most_jumps: Options::default().most_jumps,
            keep_going: false,
            without_optional: false,
            stop: Stop::default(),
        }
    }
}

impl ProgramChoice {
    /// Reads machine, set-up and program; what is wrong goes to `problems`.
    pub fn read(
        &self,
        machine: &MachineChoice,
        files: &Files,
        problems: &mut Diagnostics,
    ) -> Option<Job> {
        let place = machine.place();
        let (machine, temperatures) = machine.read_from(files, problems)?;
        let machine = machine.running("simulated", place, problems);
        let named = ProgramFiles {
            files,
            program: &self.program,
            text: self.text.as_ref().map(String::as_bytes),
            setup: self.setup.as_deref(),
            control: None,
        };
        let control = match &self.control {
            Some(name) => match named_control(name, problems) {
                Some(control) => Some(control),
                None => return named.setup(&machine, problems).and(None),
            },
            None => None,
        };
        let options = self.options(problems);
        let named = ProgramFiles { control, ..named };
        // With bad options all problems of the files are reported as well.
        let job = Job::read(machine, &named, options.clone().unwrap_or_default(), problems);
        let options = Options { temperatures, stop: self.stop.clone(), ..options? };
        job.map(|mut job| {
            job.setup.without_optional = self.without_optional;
            Job { options, ..job }
        })
    }

    fn options(&self, problems: &mut Diagnostics) -> Option<Options> {
        let mut read = |name: &str, text: &str| {
            words::plain(name, text, |v| *v > 0.0, ("a positive number", "such as 0.005"), problems)
        };
        let chord_mm = read("--chord", &self.chord);
        let spacing_mm = read("--spacing", &self.spacing);
        let angle_rad = read("--angle", &self.angle).map(f64::to_radians);
        let rounding_mm = read("--rounding", &self.rounding);
        let acceleration = self.three_phase.as_ref().map(|text| read("--three-phase", text));
        let (chord_mm, spacing_mm, angle_rad) = (chord_mm?, spacing_mm?, angle_rad?);
        let densify = match (self.no_densify, self.by_count) {
            (true, _) => Densify::Off,
            (_, true) => Densify::Count { spacing_mm, angle_rad },
            _ => Densify::Tolerance { chord_mm, angle_rad, spacing_mm },
        };
        let timing = match acceleration {
            None => Timing::LookAhead,
            Some(a) => Timing::ThreePhase { acceleration: a?, smooth: self.smooth },
        };
        let Self { most_jumps, keep_going, .. } = *self;
        let (rounding_mm, usual) = (rounding_mm?, Options::default());
        Some(Options { densify, rounding_mm, timing, most_jumps, keep_going, ..usual })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_typed_is_as_usual() {
        let mut problems = Diagnostics::new();
        let options = ProgramChoice::default().options(&mut problems);
        assert_eq!(format!("{options:?}"), format!("{:?}", Some(Options::default())));
    }
}
