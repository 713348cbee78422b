//! From the machine to the files, and back from the files to what they leave.

use super::choose::{Candidate, choose};
use super::content::Content;
use super::control::{Control, File, range};
use super::emulation::Emulation;
use super::grid_of::gridded;
use super::held::nothing_overwritten;
use super::joints::Joints;
use super::lever::Lever;
use super::place::{PlaceFault, Placed};
use super::proof::{Left, error_losses, left_after_zero_set, left_over};
use super::table::{Table, count_of, counts};
use super::{
    Compiled, LeftOut, Made, Order, TablesError, What, known, place, shown, shown_place,
    temperature,
};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command, Travel};
use trueaxis_machine::chain::CommandFault;
use trueaxis_machine::errors::ErrorName;

/// Compiles the tables of a control, reads them back and says what they leave. Errors that the machine file calls active
/// are in force and stay so: they are not compensated again, and nothing is written in their place.
///
/// # Errors
/// [`TablesError`]; then there is no file.
pub fn compile(machine: &Machine, order: &Order) -> Result<Compiled, TablesError> {
    let compiled = compiled(&machine.with_active_compensation(), order)?;
    nothing_overwritten(machine, order, &compiled)?;
    Ok(compiled)
}

fn compiled(machine: &Machine, order: &Order) -> Result<Compiled, TablesError> {
    let with = Draft::of(machine, order)?;
    let control = order.target.control();
    let joints = with.compiled.joints.as_ref();
    if joints.and_then(|j| control.carrier_chain(machine, j)).is_none() {
        return with.judged(machine);
    }
    // Vectors that close leave what is constant and what the tool or the workpiece is tilted by: tables may do more.
    let without = Draft::of(machine, &Order { kinematics: false, ..*order })?;
    if with.compiled.after_zero_set.rms_mm <= without.compiled.after_zero_set.rms_mm {
        return with.judged(machine);
    }
    let mut without = without.judged(machine)?;
    without.order = *order;
    for (index, name) in machine.stated_errors() {
        if control.knows_location(machine, name) {
            let stated = machine.bodies()[index.body].stated(name.kind, name.component);
            let largest = stated.map_or(0.0, |s| s.at(0.0, 0.0).map_or(0.0, f64::abs));
            let what = What::Error(name);
            without.left_out.push(LeftOut { what, largest, reason: BETTER_BY_TABLES });
        }
    }
    Ok(without)
}

/// Why the vectors of the rotary axes are not written.
const BETTER_BY_TABLES: &str =
    "not by the control's vectors, which add nothing at zero angles: tables alone leave less";

/// What could be written, before all is known of what it leaves.
struct Draft {
    compiled: Compiled,
    read: Content,
}

impl Draft {
    /// What it leaves over the volume, and of each error alone.
    fn judged(self, machine: &Machine) -> Result<Compiled, TablesError> {
        let Self { mut compiled, read } = self;
        let order = compiled.order;
        let control = order.target.control();
        let left =
            |content: &Content| left_over(&Emulation::new(machine, control.as_ref(), content));
        compiled.before = left(&Content::default())?;
        compiled.wrong_sign = left(&read.negated(machine))?;
        compiled.after = left(&read)?;
        let (reference, control) = (compiled.reference, control.as_ref());
        let beside = functions_elsewhere(&read, &compiled.left_out);
        compiled.errors = error_losses(machine, &reference, (control, &read, &beside), &order);
        Ok(compiled)
    }

    fn of(machine: &Machine, order: &Order) -> Result<Self, TablesError> {
        let control = order.target.control();
        for axis in machine.axes() {
            if !control.letters().contains(axis.name.letter()) {
                return Err(TablesError::UnknownAxis { axis: axis.name, target: control.key() });
            }
        }
        let reference = order.reference.unwrap_or_else(|| middle(machine));
        let (chain, rest) = known::split(machine, control.as_ref(), order.kinematics);
        let knowledge = known::compile(&chain, order, control.as_ref())?;
        let written: Vec<_> = knowledge.made.iter().map(|k| k.known.clone()).collect();
        let (joints, uncertain_joints) = joints_of(chain, control.as_ref());
        let mut content = Content { known: written, joints, ..Content::default() };
        let rest = match machine.is_at_temperatures() && control.has_temperature_lines() {
            true => {
                let cold = rest.without_heat();
                content.lines = temperature::lines((&rest, &cold), &reference, control.as_ref())?;
                cold
            }
            false => rest,
        };
        let (tables, mut left_out) = tables(machine, &rest, order, (control.as_ref(), &content))?;
        let uncertain = knowledge.left_out.into_iter().chain(uncertain_joints);
        left_out.extend(uncertain.map(|(error, largest)| LeftOut {
            what: What::Error(error),
            largest,
            reason: UNCERTAIN,
        }));
        content.tables = tables.iter().map(|t| t.table.clone()).collect();
        let beside = functions_elsewhere(&content, &left_out);
        let (gridded, not_in_grid) =
            gridded(&rest, order, &reference, (control.as_ref(), &beside))?;
        left_out.extend(not_in_grid);
        content.grid = gridded.as_ref().map(|g| g.grid.clone());
        let files = control.write(machine, &content);
        let read = recovered(machine, control.as_ref(), &content, &files)?;
        let with_tables = Emulation::new(machine, control.as_ref(), &read);
        let compiled = Compiled {
            order: *order,
            reference,
            after_zero_set: left_after_zero_set(&with_tables, &reference)?,
            before: Left::default(),
            wrong_sign: Left::default(),
            after: Left::default(),
            errors: Vec::new(),
            files,
            tables,
            known: knowledge.made,
            lines: content.lines,
            joints: content.joints,
            grid: gridded,
            left_out,
            advice: control.advice(),
        };
        Ok(Self { compiled, read })
    }
}

/// The functions that are not for the grid: those of the tables, and of tables that are not known well enough.
fn functions_elsewhere(content: &Content, left_out: &[LeftOut]) -> Vec<(usize, usize)> {
    let written = content.tables.iter().map(|t| (t.input, t.output));
    let uncertain = left_out.iter().filter(|out| out.reason == UNCERTAIN);
    let uncertain = uncertain.filter_map(|out| match out.what {
        What::Table { input, output } => Some((input, output)),
        What::Error(_) => None,
    });
    written.chain(uncertain).collect()
}

/// The rotary axes as the control's parameters have them, if it knows an error of them; and the errors that are not
/// known well enough.
fn joints_of(mut chain: Machine, control: &dyn Control) -> (Option<Joints>, Vec<(ErrorName, f64)>) {
    let mut uncertain = Vec::new();
    if control.knows_links() {
        return (None, uncertain);
    }
    for (index, name) in chain.stated_errors() {
        let stated = chain.bodies()[index.body].stated(index.kind, index.component);
        let size = stated.map_or(0.0, |s| s.at(0.0, 0.0).map_or(0.0, f64::abs));
        let together = chain.joint().is_some_and(|joint| joint.has(index));
        if !together && stated.is_some_and(|s| size <= s.u_at(0.0)) {
            uncertain.extend((size > 0.0).then_some((name, size)));
            chain = chain.with_error(index, None);
        }
    }
    let actual = Joints::actual(&chain);
    ((actual != Joints::nominal(&chain)).then_some(actual), uncertain)
}

/// Why something stays out that is not known well enough.
const UNCERTAIN: &str = "nowhere larger than its own standard uncertainty";

/// The tables of what the control's chain does not know.
fn tables(
    machine: &Machine,
    rest: &Machine,
    order: &Order,
    (control, content): (&dyn Control, &Content),
) -> Result<(Vec<Made>, Vec<LeftOut>), TablesError> {
    let lever = Lever::new(rest, order.reference.unwrap_or_else(|| middle(machine)))?;
    let (mut candidates, mut left_out) = (Vec::new(), Vec::new());
    for (input, output) in control.pairs(machine) {
        match candidate(rest, order, control, &lever, (input, output))? {
            Ok(made) => candidates.push(made),
            Err(Some(out)) => left_out.push(out),
            Err(None) => {}
        }
    }
    let already = Emulation::new(machine, control, content);
    let (tables, worse) = choose(machine, control, &already, candidates);
    left_out.extend(worse);
    let (needed, most) = (tables.len(), control.most_tables());
    match needed > most {
        true => Err(TablesError::TooManyTables { target: control.key(), needed, most }),
        false => Ok((tables, left_out)),
    }
}

fn recovered(
    machine: &Machine,
    control: &dyn Control,
    written: &Content,
    files: &[File],
) -> Result<Content, TablesError> {
    let read = control.read(machine, files)?.sorted();
    match read == written.clone().sorted() {
        true => Ok(read),
        false => Err(TablesError::NotRecovered("another meaning".to_owned())),
    }
}

/// The middle of linear travels, rotary axes at 0.
pub fn middle(machine: &Machine) -> Command {
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

/// The function is examined here first: size and uncertainty.
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
    let modulo = modulo || control.has_whole_turns() && axis.kind == AxisKind::Rotary;
    let (count_in, count_out) = (count_of(machine, input), count_of(machine, output));
    let function = |at: i64| {
        let q = at as f64 * count_in;
        let of = |side| Ok::<_, CommandFault>(lever.functions(input, q, side)?[output]);
        Ok([counts(machine, output, of(1.0)?), counts(machine, output, of(-1.0)?)])
    };
    // Of errors that are known together the u of one function says nothing.
    let (mut largest, mut certain) = (0.0_f64, machine.joint().is_some());
    let half = 0.5 * control.rule().increment * count_out;
    for i in 0..=GLANCES {
        let at = from + (i128::from(to - from) * i128::from(i) / i128::from(GLANCES)) as i64;
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
        // What is less than half an increment shows nothing.
        certain = certain || size > half && size > lever.u(input, at as f64 * count_in)?[output];
    }
    if largest < half {
        return Ok(Err(None));
    }
    if !certain {
        let what = What::Table { input, output };
        return Ok(Err(Some(LeftOut { what, largest, reason: UNCERTAIN })));
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
        PlaceFault::Turns(loss) => TablesError::Turns {
            target: control.key(),
            axis: axis.name,
            loss: shown(moved, loss * count_out),
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
