//! The machine at this moment: its tool, and its temperatures while they follow a log.

use super::Stamp;
use trueaxis_geometry::Vec3;
use trueaxis_input::Diagnostics;
use trueaxis_machine::Machine;
use trueaxis_machine::batch::CompiledMachine;
use trueaxis_machine::heat::{TemperatureRun, WarmingMachine};

/// The machine of the present stretch of the path.
pub(super) struct Present {
    machine: Machine,
    warming: Option<WarmingMachine>,
    /// Since when it holds, s.
    since_s: f64,
    /// Until when, s.
    until_s: f64,
}

impl Present {
    /// At the start of the program; what is wrong with the log goes to `problems`.
    pub fn of(
        machine: &Machine,
        run: Option<&TemperatureRun>,
        problems: &mut Diagnostics,
    ) -> Option<Self> {
        let Some(run) = run else {
            let machine = machine.clone();
            return Some(Self { machine, warming: None, since_s: 0.0, until_s: f64::INFINITY });
        };
        let warming = WarmingMachine::new(machine, run, problems)?;
        let (machine, until_s) = warming.at(0.0)?;
        Some(Self { machine, warming: Some(warming), since_s: 0.0, until_s })
    }

    pub fn compiled(&self) -> CompiledMachine {
        CompiledMachine::new(&self.machine)
    }

    /// The time of the program whose temperatures the machine has, s.
    pub fn since_s(&self) -> f64 {
        self.since_s
    }

    pub fn change_tip(&mut self, tip_mm: Vec3) {
        self.machine = self.machine.clone().with_tip(tip_mm);
    }

    /// On to a time; true if the machine is another one there, a sentence where the log has ended:
    /// once, since then the last machine holds.
    pub fn advance(&mut self, time_s: f64) -> Result<bool, String> {
        let Some(warming) = self.warming.as_ref().filter(|_| time_s >= self.until_s()) else {
            return Ok(false);
        };
        match warming.at(time_s) {
            Some((machine, until_s)) => {
                self.machine = machine.with_tip(self.machine.tip_mm());
                (self.since_s, self.until_s) = (time_s, until_s);
                Ok(true)
            }
            None => {
                let run = warming.run();
                let message = format!(
                    "the log of temperatures ends here, {:.1} s after the start of the program \
                     (at {} s of {})",
                    run.lasts_s(),
                    run.start_s + run.lasts_s(),
                    run.log.file()
                );
                (self.warming, self.until_s) = (None, f64::INFINITY);
                Err(message)
            }
        }
    }

    /// How many of these stamps pass while this machine holds.
    pub fn holds(&self, stamps: &[Stamp]) -> usize {
        let until_s = self.until_s();
        stamps.iter().position(|s| s.time_s >= until_s).unwrap_or(stamps.len())
    }

    /// Until when the machine is valid; after the end of its log it is not, even if no sensor moves any more.
    fn until_s(&self) -> f64 {
        let end_s = self.warming.as_ref().map_or(f64::INFINITY, |w| w.run().lasts_s().next_up());
        self.until_s.min(end_s)
    }
}
