//! The test piece on the machine: commands once, deviations for any set of errors.

use super::program::{CutProgram, Passing};
use super::temperatures::{CuttingClock, RunningTemperatures};
use super::{Error, Setting};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Direction, Point};
use trueaxis_machine::axis::{Approach, Command, MAX_AXES};
use trueaxis_machine::errors::{ErrorValues, Uncertainties};
use trueaxis_machine::variations::{DRAWN, DrawnCommand, Factors, FixedCommand};
use trueaxis_machine::{Machine, Target};
use trueaxis_part::testpiece::{Datum, TestPiece, ToolPosition};

/// Which axis of the part coaxiality and angularity are judged against.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum DatumAxis {
    /// The ideal z axis of the workpiece through the set zero (Wu et al. 2022).
    #[default]
    Ideal,
    /// A reference hole bored along that axis on the same machine, to this depth below the zero.
    ReferenceHole {
        /// Length of the hole, mm.
        depth_mm: f64,
    },
    /// The frame in which the part agrees best with its nominal shape.
    BestFit,
}

impl std::fmt::Display for DatumAxis {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Ideal => write!(f, "ideal axis through the set zero"),
            Self::ReferenceHole { depth_mm } => write!(f, "reference hole, {depth_mm} mm deep"),
            Self::BestFit => write!(f, "best fit to the nominal shape"),
        }
    }
}

/// How the part zero was found and against what the part is judged.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Reference {
    /// The pose of the tool when the part zero was touched.
    pub setting: Setting,
    /// The datum of coaxiality and angularity.
    pub datum: DatumAxis,
}

/// One command with the errors that the machine has there and how well they are known.
#[derive(Debug, Clone)]
struct Stop {
    command: Command,
    /// The machine there.
    there: FixedCommand,
    approach: Approach,
    errors: ErrorValues,
    u: Uncertainties,
    /// How far the nominal tip (mm) and tool axis are from where they ideally are: a program may say
    /// something else than the test piece, and a compensation moves them.
    off: [Vec3; 2],
}

/// The nominal errors at a stop, and how well they are known, become the errors to cut with.
pub type Change<'a> = dyn Fn(&ErrorValues, &Uncertainties) -> ErrorValues + Sync + 'a;

/// The cut of a test piece: everything that does not depend on the values of the errors.
pub struct Cutting<'a> {
    machine: &'a Machine,
    positions: Vec<ToolPosition>,
    stops: Vec<Stop>,
    setting: Option<Stop>,
    setting_command: Command,
    /// Top and bottom of the reference hole.
    hole: Option<([Stop; 2], f64)>,
    best_fit: bool,
}

impl<'a> Cutting<'a> {
    /// Finds the commands of the path and of the setting point on the nominal machine.
    ///
    /// # Errors
    /// A tool direction that the machine cannot reach, a path that leaves the travel or an error
    /// table, each with the tool position.
    pub fn new(
        machine: &'a Machine,
        piece: &dyn TestPiece,
        reference: &Reference,
    ) -> Result<Self, Error> {
        Self::over(machine, piece, reference, None)
    }

    /// The same while the temperatures follow a log: the errors of each tool position are those of
    /// its time. The zero was touched, and the reference hole bored, at the start.
    ///
    /// # Errors
    /// As [`Cutting::new`]; a log that ends too early.
    pub fn over(
        machine: &'a Machine,
        piece: &dyn TestPiece,
        reference: &Reference,
        temperatures: Option<&RunningTemperatures>,
    ) -> Result<Self, Error> {
        Self::along(machine, piece, reference, temperatures, None)
    }

    /// The same along a program, if there is one, instead of the ideal path.
    ///
    /// # Errors
    /// As [`Cutting::over`]; a program that does not come near a tool position.
    pub fn along(
        machine: &'a Machine,
        piece: &dyn TestPiece,
        reference: &Reference,
        temperatures: Option<&RunningTemperatures>,
        program: Option<&CutProgram>,
    ) -> Result<Self, Error> {
        let positions = piece.tool_positions();
        let setting_command = setting_command(machine, &reference.setting)?;
        let passings = match program {
            Some(program) => program.passings(machine, &positions)?,
            None => ideal_passings(machine, &positions, &setting_command)?,
        };
        let mut clock = CuttingClock::of(machine, temperatures, &positions);
        let quantities = machine.uncertain_quantities();
        let mut stops = Vec::with_capacity(passings.len());
        for (i, (passing, ideal)) in passings.iter().zip(&positions).enumerate() {
            let at = clock.machine_at(i)?;
            let place = (&quantities[..], Some(i));
            let mut stop = stop(at.unwrap_or(machine), passing.command, &passing.approach, place)?;
            if program.is_some() {
                stop.off = off(machine, &stop, ideal);
            }
            stops.push(stop);
        }
        let setting = match reference.setting {
            Setting::Perfect => None,
            Setting::Touched { .. } => {
                let place = (&quantities[..], None);
                Some(stop(machine, setting_command, &Approach::default(), place)?)
            }
        };
        let hole = match reference.datum {
            DatumAxis::Ideal | DatumAxis::BestFit => None,
            DatumAxis::ReferenceHole { depth_mm } => {
                let ends = bore(machine, &setting_command, depth_mm, &quantities)?;
                Some((ends, depth_mm))
            }
        };
        let best_fit = reference.datum == DatumAxis::BestFit;
        Ok(Self { machine, positions, stops, setting, setting_command, hole, best_fit })
    }

    /// The same cut with a compensation in the control: what it adds to each command, by the command
    /// and the direction of travel. The zero is touched, and the hole bored, with it.
    pub fn compensated(mut self, added: &dyn Fn(&Command, &Approach) -> Command) -> Self {
        let machine = self.machine;
        let quantities = machine.uncertain_quantities();
        let nominal = |command: &Command| machine.deviation(command, &ErrorValues::default());
        let compensate = |old: &mut Stop| {
            let mut command = old.command;
            for (q, c) in command.iter_mut().zip(added(&old.command, &old.approach)) {
                *q += c;
            }
            let (from, to) = (nominal(&old.command), nominal(&command));
            let [tip, axis] = old.off;
            // Only the sum may lie outside a table, at the end of the travel: then the errors stay.
            if let Ok(there) = stop(machine, command, &old.approach, (&quantities, None)) {
                *old = there;
            }
            (old.command, old.there) = (command, machine.fixed_command(&command));
            old.off = [
                tip + (to.nominal_tip.vector() - from.nominal_tip.vector()),
                axis + (to.nominal_axis.vector() - from.nominal_axis.vector()),
            ];
        };
        let hole = self.hole.iter_mut().flat_map(|(ends, _)| ends);
        self.stops.iter_mut().chain(&mut self.setting).chain(hole).for_each(compensate);
        self
    }

    /// The same cut with the axes elsewhere when each tool position is passed.
    ///
    /// # Errors
    /// Positions for which a table says nothing.
    pub(super) fn passed(mut self, commands: &[Command]) -> Result<Self, Error> {
        let machine = self.machine;
        let quantities = machine.uncertain_quantities();
        let stops = self.stops.iter_mut().zip(&self.positions).zip(commands).enumerate();
        for (i, ((old, ideal), command)) in stops {
            let place = (&quantities[..], Some(i));
            // The place on the path is the same, and so is the side from which each axis comes.
            let mut stop = stop(machine, *command, &old.approach, place)?;
            stop.off = off(machine, &stop, ideal);
            *old = stop;
        }
        Ok(self)
    }

    /// The ideal tool positions.
    pub fn positions(&self) -> &[ToolPosition] {
        &self.positions
    }

    /// The commands of the path.
    pub fn commands(&self) -> impl ExactSizeIterator<Item = &Command> {
        self.stops.iter().map(|s| &s.command)
    }

    /// The command at the tool-setting point.
    pub fn setting_command(&self) -> &Command {
        &self.setting_command
    }

    /// Whether the part is judged in the frame in which it agrees best with its nominal shape.
    pub fn in_best_fit(&self) -> bool {
        self.best_fit
    }

    /// How many contact points there are.
    pub fn contacts(&self) -> usize {
        self.positions.iter().map(|p| p.contacts.len()).sum()
    }

    /// Cuts the part with changed errors: the deviation of the tool axis at every contact point, in
    /// the workpiece frame, in mm, position after position; and the datum that the machine bored.
    ///
    /// ```text
    ///     E_v = d_tip(q) + s · d_axis(q) − d_tip(q₀)                        docs/model.md eq. 20
    /// ```
    ///
    /// s is the distance of the contact from the tip along the tool axis, q₀ the setting command:
    /// the zero was set with the same wrong machine, so its error there is subtracted once.
    pub fn cut(&self, change: &Change<'_>, deviations_mm: &mut Vec<Vec3>) -> Datum {
        let at = |_: usize, stop: &Stop| {
            let off = stop.there.deviation(&change(&stop.errors, &stop.u));
            [off.tip_mm, off.axis]
        };
        self.cut_where(&at, deviations_mm)
    }

    /// The same where each stop, by its number in [`Cutting::stops`], has this deviation of tip, mm, and axis.
    fn cut_where(
        &self,
        deviation: &dyn Fn(usize, &Stop) -> [Vec3; 2],
        deviations_mm: &mut Vec<Vec3>,
    ) -> Datum {
        let at = |k: usize, stop: &Stop| {
            let [tip, axis] = deviation(k, stop);
            [tip + stop.off[0], axis + stop.off[1]]
        };
        let first = self.stops.len();
        let zero = self.setting.as_ref().map_or(Vec3::zeros(), |s| at(first, s)[0]);
        deviations_mm.clear();
        for (k, (position, stop)) in self.positions.iter().zip(&self.stops).enumerate() {
            let [tip, axis] = at(k, stop);
            for contact in &position.contacts {
                deviations_mm.push(tip + axis * contact.along_axis_mm - zero);
            }
        }
        let Some((ends, depth_mm)) = &self.hole else { return Datum::IDEAL };
        let first = first + usize::from(self.setting.is_some());
        let [top, bottom] = [0, 1].map(|k| at(first + k, &ends[k])[0] - zero);
        bored_datum(top, bottom, *depth_mm)
    }

    /// All stops: those of the path, where the zero was touched, and the ends of the hole.
    fn stops(&self) -> impl Iterator<Item = &Stop> {
        let ends = self.hole.iter().flat_map(|(ends, _)| ends);
        self.stops.iter().chain(&self.setting).chain(ends)
    }

    /// The same cut, ready for many machines whose errors are drawn.
    pub(super) fn drawn(&self) -> DrawnCutting<'_> {
        let ready = |stop: &Stop| DrawnCommand::of(&stop.there, &stop.errors, &stop.u);
        DrawnCutting { cutting: self, commands: self.stops().map(ready).collect() }
    }
}

/// A cut on eight machines at a time, whose errors are drawn within their uncertainties.
pub(super) struct DrawnCutting<'a> {
    cutting: &'a Cutting<'a>,
    /// In the order of [`Cutting::stops`].
    commands: Vec<DrawnCommand>,
}

impl DrawnCutting<'_> {
    /// Tip, mm, and axis at each stop, in rows of three, a column for each machine.
    pub fn deviations(&self, factors: &Factors, found: &mut Vec<[[f64; DRAWN]; 6]>) {
        found.resize(self.commands.len(), [[0.0; DRAWN]; 6]);
        for (command, found) in self.commands.iter().zip(found) {
            command.deviations(factors, found);
        }
    }

    /// The part that one of these machines cuts; as [`Cutting::cut`].
    pub fn cut(
        &self,
        found: &[[[f64; DRAWN]; 6]],
        machine: usize,
        deviations_mm: &mut Vec<Vec3>,
    ) -> Datum {
        let at = |k: usize, _: &Stop| {
            let [x, y, z, i, j, k] = found[k].each_ref().map(|row| row[machine]);
            [Vec3::new(x, y, z), Vec3::new(i, j, k)]
        };
        self.cutting.cut_where(&at, deviations_mm)
    }
}

/// The datum of a hole whose axis passes through two displaced points, `depth_mm` apart.
///
/// Its height stays that of the set zero: a hole has none. docs/model.md eq. 29.
fn bored_datum(top: Vec3, bottom: Vec3, depth_mm: f64) -> Datum {
    let lean = (top - bottom) / depth_mm;
    Datum { shift_mm: Vec3::new(top.x, top.y, 0.0), tilt_rad: Vec3::new(-lean.y, lean.x, 0.0) }
}

fn stop(
    machine: &Machine,
    command: Command,
    approach: &Approach,
    (quantities, position): (&[String], Option<usize>),
) -> Result<Stop, Error> {
    let errors = machine
        .errors_at(&command, approach)
        .map_err(|source| Error::Table { position, source })?;
    let u = machine.uncertainties_at(&command, quantities);
    let there = machine.fixed_command(&command);
    Ok(Stop { command, there, approach: *approach, errors, u, off: [Vec3::zeros(); 2] })
}

/// How far the nominal tool at a stop is from a tool position.
fn off(machine: &Machine, stop: &Stop, ideal: &ToolPosition) -> [Vec3; 2] {
    let there = machine.deviation(&stop.command, &stop.errors);
    [there.nominal_tip - ideal.tip, there.nominal_axis.vector() - ideal.axis.vector()]
}

/// The commands of the ideal path.
fn ideal_passings(
    machine: &Machine,
    positions: &[ToolPosition],
    from: &Command,
) -> Result<Vec<Passing>, Error> {
    let path: Vec<Target> = positions.iter().map(|p| Target { tip: p.tip, axis: p.axis }).collect();
    let commands = machine.follow(&path, from).map_err(Error::Path)?;
    let (mut last, mut approach) = (*from, Approach::default());
    let passing = |command: Command| {
        update_approach(&mut approach, &last, &command);
        last = command;
        Passing { command, approach }
    };
    Ok(commands.into_iter().map(passing).collect())
}

/// An axis keeps its side until it reverses.
fn update_approach(approach: &mut Approach, last: &Command, next: &Command) {
    for i in 0..MAX_AXES {
        let step = next[i] - last[i];
        if step.abs() > 1e-12 {
            approach[i] = step.signum();
        }
    }
}

/// The command that brings the nominal tip to the part zero with the rotary axes as asked.
pub(super) fn setting_command(machine: &Machine, setting: &Setting) -> Result<Command, Error> {
    let rotary = match setting {
        Setting::Perfect => Command::default(),
        Setting::Touched { rotary } => *rotary,
    };
    let axis = machine.pose(&rotary, &ErrorValues::default()) * Direction::Z;
    let target = Target { tip: Point::ORIGIN, axis };
    let solved = machine.solve(&target, &rotary).map_err(Error::Setting)?;
    // The branch with the rotary axes where they were asked to be travels nothing, so it is first
    // among those within the travel.
    let best = solved.solutions.first().filter(|s| s.within_travel && s.rotary_travel_rad < 1e-6);
    best.map(|s| s.command).ok_or(Error::SettingOutOfTravel)
}

fn bore(
    machine: &Machine,
    from: &Command,
    depth_mm: f64,
    quantities: &[String],
) -> Result<[Stop; 2], Error> {
    let path =
        [0.0, -depth_mm].map(|z| Target { tip: Point::new(0.0, 0.0, z), axis: Direction::Z });
    let commands = machine.follow(&path, from).map_err(Error::Hole)?;
    let at = |i: usize| stop(machine, commands[i], &Approach::default(), (quantities, None));
    Ok([at(0)?, at(1)?])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A hole 40 mm deep whose mouth is 8 µm in X and −4 µm in Y from its end leans by 200 µrad about Y and 100 µrad about X.
    #[test]
    fn the_datum_of_a_bore_by_hand() {
        let datum = bored_datum(Vec3::new(5e-3, 1e-3, 7.0), Vec3::new(-3e-3, 5e-3, 9.0), 40.0);
        assert_eq!(datum.shift_mm, Vec3::new(5e-3, 1e-3, 0.0));
        assert!((datum.tilt_rad - Vec3::new(100e-6, 200e-6, 0.0)).norm() < 1e-15);
        // Moving the ideal axis by shift and tilt brings it to both ends.
        let at = |z: f64| datum.shift_mm + datum.tilt_rad.cross(&Vec3::new(0.0, 0.0, z));
        assert!((at(-40.0).xy() - Vec3::new(-3e-3, 5e-3, 0.0).xy()).norm() < 1e-15);
    }
}
