//! Compensation tables of controls: compiled from one machine, read back, applied as the control does, and
//! what is left.
//!
//! ```text
//!     Machine ──lever──> f_io(q_i) ──place──> nodes ──control──> files ──read──> emulation ──> what is left
//! ```
//!
//! - `lever`: what every axis should add, and what of it is a function of one axis;
//! - [`place`]: the fewest nodes below a bound of the loss;
//! - `csv`, `linuxcnc`, `sinumerik`: files, their parsers, their interpolation;
//! - [`proof`](mod@proof): what the written files leave over the volume, of each error, of a test piece.

mod choose;
pub mod control;
mod csv;
mod fault;
mod lever;
mod linuxcnc;
pub mod place;
pub mod proof;
mod sinumerik;
pub mod table;

pub use fault::TablesError;

use choose::{Candidate, choose};
use control::{Control, File};
use lever::Lever;
use place::{PlaceFault, Placed};
use proof::{ErrorLoss, Leaves, Left, error_losses, left_over};
use table::{PER_UNIT, Table, count_of, counts};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, Axis, AxisKind, Command, Travel};
use trueaxis_machine::chain::CommandFault;

/// Which control the tables are for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Target {
    /// Plain CSV, every axis on every linear axis.
    Csv,
    /// `COMP_FILE`; with trims it is type 1, without type 0.
    LinuxCnc {
        /// Type 1.
        trims: bool,
    },
    /// `$AA_ENC_COMP` and `$AN_CEC`.
    Sinumerik,
}

impl Target {
    /// The control.
    pub fn control(self) -> Box<dyn Control + Sync> {
        match self {
            Self::Csv => Box::new(csv::Csv),
            Self::LinuxCnc { trims } => Box::new(linuxcnc::LinuxCnc { trims }),
            Self::Sinumerik => Box::new(sinumerik::Sinumerik { increment: 100.0 }),
        }
    }
}

/// What tables are wanted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Order {
    /// For which control.
    pub target: Target,
    /// Where the other axes stand; without it in the middle of linear travels, rotary axes at 0.
    pub reference: Option<Command>,
    /// The most that the interpolation of one table may lose: mm of linear axes.
    pub bound_mm: f64,
    /// The same of rotary axes, rad.
    pub bound_rad: f64,
    /// A larger correction is refused: mm.
    pub limit_mm: f64,
    /// The same, rad.
    pub limit_rad: f64,
}

impl Order {
    /// 1 µm and 5 µrad lost at most; nothing above 1 mm and 1 mrad.
    pub fn of(target: Target) -> Self {
        let (bound_mm, bound_rad) = (1e-3, 5e-6);
        Self { target, reference: None, bound_mm, bound_rad, limit_mm: 1.0, limit_rad: 1e-3 }
    }

    fn bound(&self, kind: AxisKind) -> f64 {
        match kind {
            AxisKind::Linear => self.bound_mm,
            AxisKind::Rotary => self.bound_rad,
        }
    }

    fn limit(&self, kind: AxisKind) -> f64 {
        match kind {
            AxisKind::Linear => self.limit_mm,
            AxisKind::Rotary => self.limit_rad,
        }
    }
}

/// A table that is written.
#[derive(Debug, Clone, PartialEq)]
pub struct Made {
    /// The table.
    pub table: Table,
    /// The most that interpolation and rounding lose, mm or rad.
    pub loss: f64,
    /// The largest correction in it, mm or rad.
    pub largest: f64,
}

/// A table that is not written.
#[derive(Debug, Clone, PartialEq)]
pub struct LeftOut {
    /// The axis that would be looked up.
    pub input: usize,
    /// The axis that would be moved.
    pub output: usize,
    /// The largest correction, mm or rad.
    pub largest: f64,
    /// Why.
    pub reason: &'static str,
}

/// The tables of a control and what they do.
#[derive(Debug, Clone, PartialEq)]
pub struct Compiled {
    /// What was asked.
    pub order: Order,
    /// Where the other axes stood.
    pub reference: Command,
    /// What to load.
    pub files: Vec<File>,
    /// The tables in them.
    pub tables: Vec<Made>,
    /// Tables that were not written.
    pub left_out: Vec<LeftOut>,
    /// Over the volume, as the machine is.
    pub before: Left,
    /// The same with the tables as they were read back.
    pub after: Left,
    /// The convention check: the same if the control took every value with the other sign.
    pub wrong_sign: Left,
    /// Each error of the machine alone.
    pub errors: Vec<ErrorLoss>,
    /// What the control needs besides the files.
    pub advice: &'static [&'static str],
}

/// Compiles the tables of a control, reads them back and says what they leave.
///
/// # Errors
/// [`TablesError`]; then there is no file.
pub fn compile(machine: &Machine, order: &Order) -> Result<Compiled, TablesError> {
    let control = order.target.control();
    for axis in machine.axes() {
        if !control.letters().contains(axis.name.letter()) {
            return Err(TablesError::UnknownAxis { axis: axis.name, target: control.key() });
        }
    }
    let reference = order.reference.unwrap_or_else(|| middle(machine));
    let lever = Lever::new(machine, reference)?;
    let mut candidates = Vec::new();
    let mut left_out = Vec::new();
    for (input, output) in pairs(machine, control.as_ref()) {
        match candidate(machine, order, control.as_ref(), &lever, (input, output))? {
            Ok(made) => candidates.push(made),
            Err(Some(out)) => left_out.push(out),
            Err(None) => {}
        }
    }
    let (tables, worse) = choose(machine, control.as_ref(), candidates);
    left_out.extend(worse);
    if tables.len() > control.most_tables() {
        let (needed, most) = (tables.len(), control.most_tables());
        return Err(TablesError::TooManyTables { target: control.key(), needed, most });
    }
    let written: Vec<Table> = tables.iter().map(|t| t.table.clone()).collect();
    let files = control.write(machine, &written);
    let read = recovered(machine, control.as_ref(), &written, &files)?;
    let emulation = Leaves { machine, control: control.as_ref(), tables: &read };
    let before = left_over(&Leaves { tables: &[], ..emulation })?;
    let after = left_over(&emulation)?;
    let wrong: Vec<Table> = read.iter().map(Table::negated).collect();
    let wrong_sign = left_over(&Leaves { tables: &wrong, ..emulation })?;
    let cross = control.has_cross_tables();
    let errors = error_losses(machine, &reference, &read, order.bound_mm, cross);
    let advice = control.advice();
    Ok(Compiled {
        order: *order,
        reference,
        files,
        tables,
        left_out,
        before,
        after,
        wrong_sign,
        errors,
        advice,
    })
}

fn recovered(
    machine: &Machine,
    control: &dyn Control,
    written: &[Table],
    files: &[File],
) -> Result<Vec<Table>, TablesError> {
    let mut read = control.read(machine, files)?;
    let mut meant = written.to_vec();
    let place = |t: &Table| (t.input, t.output);
    read.sort_by_key(place);
    meant.sort_by_key(place);
    match read == meant {
        true => Ok(read),
        false => Err(TablesError::NotRecovered("another meaning".to_owned())),
    }
}

/// Which axis may move which: each itself; linear axes also by the position of every other.
fn pairs(machine: &Machine, control: &dyn Control) -> Vec<(usize, usize)> {
    let axes = 0..machine.axes().len();
    let own = axes.clone().map(|i| (i, i));
    let cross = axes.clone().flat_map(|input| axes.clone().map(move |output| (input, output)));
    let cross = cross.filter(|(input, output)| {
        input != output && machine.axes()[*output].kind == AxisKind::Linear
    });
    match control.has_cross_tables() {
        true => own.chain(cross).collect(),
        false => own.collect(),
    }
}

fn middle(machine: &Machine) -> Command {
    let mut reference = Command::default();
    for (q, axis) in reference.iter_mut().zip(machine.axes()) {
        *q = match (axis.kind, axis.travel) {
            (AxisKind::Linear, Travel::Between(from, to)) => 0.5 * (from + to),
            (AxisKind::Rotary, Travel::Between(from, to)) => 0.0_f64.clamp(from, to),
            _ => 0.0,
        };
    }
    reference
}

/// The ends of a table in counts, inwards to whole counts; whether it repeats itself.
fn range(axis: &Axis, control: &dyn Control) -> Result<((i64, i64), bool), TablesError> {
    let turn = (360.0 * PER_UNIT) as i64;
    let unit = |q: f64| PER_UNIT * if axis.kind == AxisKind::Linear { q } else { q.to_degrees() };
    match (axis.travel, control.has_modulo()) {
        (Travel::Between(from, to), _) => {
            // A count that the rounding of a file's numbers has moved over the end still counts.
            let (from, to) = ((unit(from) - 1e-3).ceil() as i64, (unit(to) + 1e-3).floor() as i64);
            if from < to {
                Ok(((from, to), false))
            } else {
                Err(TablesError::UnknownTravel(axis.name))
            }
        }
        (Travel::Unlimited, true) => Ok(((0, turn), true)),
        (Travel::Unlimited, false) => Ok(((-turn, turn), false)),
        (Travel::Unknown, _) => Err(TablesError::UnknownTravel(axis.name)),
    }
}

/// The function is first looked at here: size and uncertainty.
const GLANCES: i64 = 32;

/// A table for a pair of axes; or why there should be none, without a reason if there is nothing to do.
fn candidate(
    machine: &Machine,
    order: &Order,
    control: &dyn Control,
    lever: &Lever<'_>,
    (input, output): (usize, usize),
) -> Result<Result<Candidate, Option<LeftOut>>, TablesError> {
    let (axis, moved) = (&machine.axes()[input], &machine.axes()[output]);
    let ((from, to), modulo) = range(axis, control)?;
    let (count_in, count_out) = (count_of(machine, input), count_of(machine, output));
    let function = |at: i64| {
        let q = at as f64 * count_in;
        let of = |side| Ok::<_, CommandFault>(lever.functions(input, q, side)?[output]);
        Ok([counts(machine, output, of(1.0)?), counts(machine, output, of(-1.0)?)])
    };
    let (mut largest, mut certain) = (0.0_f64, false);
    for i in 0..=GLANCES {
        let at = from + ((to - from) as i128 * i as i128 / GLANCES as i128) as i64;
        let size = function(at)?.map(f64::abs).into_iter().fold(0.0, f64::max) * count_out;
        if size > order.limit(moved.kind) {
            return Err(TablesError::TooLarge {
                output: moved.name,
                input: axis.name,
                value: shown(moved, size),
                at: shown_place(axis, at as f64 * count_in),
                limit: shown(moved, order.limit(moved.kind)),
            });
        }
        largest = largest.max(size);
        certain |= size > lever.u(input, at as f64 * count_in)?[output];
    }
    if largest < 0.5 * control.rule().increment * count_out {
        return Ok(Err(None));
    }
    if !certain {
        let reason = "nowhere larger than its own standard uncertainty";
        return Ok(Err(Some(LeftOut { input, output, largest, reason })));
    }
    let bound = order.bound(moved.kind);
    let placed = place::place(&function, (from, to), (control.rule(), modulo), bound / count_out);
    let Placed { nodes, loss } = placed.map_err(|fault| match fault {
        PlaceFault::Machine(fault) => TablesError::Position(fault),
        PlaceFault::Increment => TablesError::Increment {
            target: control.key(),
            output: moved.name,
            bound: shown(moved, bound),
        },
        PlaceFault::TooMany(loss) => TablesError::TooManyNodes {
            input: axis.name,
            output: moved.name,
            most: control.rule().most_nodes,
            loss: shown(moved, loss * count_out),
            bound: shown(moved, bound),
        },
    })?;
    let table = Table { input, output, modulo, nodes };
    Ok(Ok(Made { table, loss: loss * count_out, largest }))
}

/// A correction as people write it.
pub fn shown(axis: &Axis, value: f64) -> String {
    match axis.kind {
        AxisKind::Linear => format!("{:.2} µm", value * 1e3),
        AxisKind::Rotary => format!("{:.2} µrad", value * 1e6),
    }
}

fn shown_place(axis: &Axis, q: f64) -> String {
    match axis.kind {
        AxisKind::Linear => format!("{q:.3} mm"),
        AxisKind::Rotary => format!("{:.4} deg", q.to_degrees()),
    }
}

/// What tables add to a command, as a control interpolates them, mm and rad.
pub fn added(
    machine: &Machine,
    control: &dyn Control,
    tables: &[Table],
    command: &Command,
    approach: &Approach,
) -> Command {
    let mut added = Command::default();
    for table in tables {
        let position = counts(machine, table.input, command[table.input]);
        let value = control.value(table, position, approach[table.input]);
        added[table.output] += value * count_of(machine, table.output);
    }
    added
}
