//! Poses and errors of a machine at the commands of an array, in blocks on all threads.

use crate::arrays::{Wanted, not_finite};
use crate::machine::{NativeMachine, approach};
use crate::problems::{listed, refused};
use crate::threads;
use numpy::ndarray::{ArrayView2, s};
use numpy::{PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyList;
use rayon::prelude::*;
use trueaxis::describe::to_inner;
use trueaxis::input::{Diagnostics, Place};
use trueaxis::machine::axis::{Approach, Command, MAX_AXES, Travel};
use trueaxis::machine::batch::{Commands, CompiledMachine, DeviationColumns};
use trueaxis::report::PoseReport;

/// Rows of a block: its columns stay in the second-level cache.
const BLOCK: usize = 2048;
/// Bad rows that are named.
const MOST_NAMED: usize = 20;
/// Numbers of a deviation: of the tip, of the axis. With the nominal tip and the nominal axis before them they are twice as many.
const NUMBERS: usize = 6;
/// What the array of commands is called in messages.
const NAME: &str = "commands";

/// A table of numbers and what was found.
type Found<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyList>);

/// The commands of a block as columns in mm and rad, and where its axes stand outside their travel.
struct Block {
    columns: Vec<Vec<f64>>,
    /// Nominal tip and axis where they are not asked for: they stay in the cache.
    nominal: [Vec<f64>; NUMBERS],
    /// First row and number of rows of each axis.
    outside: [(usize, usize); MAX_AXES],
}

impl Block {
    fn new(axes: usize) -> Self {
        let column = || vec![0.0; BLOCK];
        let nominal = std::array::from_fn(|_| column());
        Self { columns: vec![column(); axes], nominal, outside: [(0, 0); MAX_AXES] }
    }

    /// Reads some rows, whatever the strides of the array.
    fn gather(
        &mut self,
        compiled: &CompiledMachine,
        commands: &ArrayView2<'_, f64>,
        from: usize,
        count: usize,
    ) {
        let machine = compiled.machine();
        for (axis, column) in self.columns.iter_mut().enumerate() {
            // What 1 becomes is the factor: 1, or that of degrees.
            let factor = to_inner(machine, axis, 1.0);
            let given = commands.slice(s![from..from + count, axis]);
            let column = &mut column[..count];
            column.iter_mut().zip(given).for_each(|(inner, value)| *inner = value * factor);
            let outside = outside(&machine.axes()[axis].travel, column, from);
            self.outside[axis] = outside;
        }
    }
}

/// The first row and the number of rows outside the travel; the extremes of most blocks say that there are none.
fn outside(travel: &Travel, column: &[f64], from: usize) -> (usize, usize) {
    let extremes = column.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
        [if *value < low { *value } else { low }, if *value > high { *value } else { high }]
    });
    if column.is_empty() || extremes.iter().all(|value| travel.contains(*value)) {
        return (0, 0);
    }
    let mut rows = column.iter().enumerate().filter(|(_, value)| !travel.contains(**value));
    rows.next().map_or((0, 0), |(first, _)| (from + first, rows.count() + 1))
}

/// What came of a block: rows outside the travel, and the first row without a pose.
struct Outcome {
    outside: [(usize, usize); MAX_AXES],
    bad: Option<usize>,
}

/// The rows of a table that is written in parallel, divided into blocks.
fn blocks(table: &mut [f64], count: usize) -> Vec<Vec<&mut [f64]>> {
    let mut all: Vec<Vec<&mut [f64]>> = Vec::new();
    all.resize_with(count.div_ceil(BLOCK), Vec::new);
    if count > 0 {
        for row in table.chunks_mut(count) {
            row.chunks_mut(BLOCK).zip(&mut all).for_each(|(piece, block)| block.push(piece));
        }
    }
    all
}

/// Where a block is written: six columns of deviations, the nominal pose before them or in `nominal`.
fn columns<'a>(
    out: &'a mut [&mut [f64]],
    nominal: &'a mut [Vec<f64>; NUMBERS],
    count: usize,
) -> Option<DeviationColumns<'a>> {
    let (before, deviations) = out.split_at_mut(out.len().checked_sub(NUMBERS)?);
    let kept: [&mut [f64]; NUMBERS] = match before.is_empty() {
        true => nominal.each_mut().map(|column| &mut column[..count]),
        false => {
            let before: &mut [&mut [f64]; NUMBERS] = before.try_into().ok()?;
            before.each_mut().map(|column| &mut **column)
        }
    };
    let deviations: &mut [&mut [f64]; NUMBERS] = deviations.try_into().ok()?;
    let [tx, ty, tz, ax, ay, az] = kept;
    let [dx, dy, dz, ex, ey, ez] = deviations.each_mut().map(|column| &mut **column);
    Some(DeviationColumns {
        nominal_tip_mm: [tx, ty, tz],
        nominal_axis: [ax, ay, az],
        tip_mm: [dx, dy, dz],
        axis: [ex, ey, ez],
    })
}

fn computed(
    compiled: &CompiledMachine,
    commands: &ArrayView2<'_, f64>,
    sides: &Approach,
    table: &mut [f64],
) -> Vec<Outcome> {
    let axes = compiled.machine().axes().len();
    let work = |block: &mut Block, (number, out): (usize, &mut Vec<&mut [f64]>)| {
        let from = number * BLOCK;
        let count = BLOCK.min(commands.nrows() - from);
        block.gather(compiled, commands, from, count);
        let Block { columns: positions, nominal, outside } = block;
        let positions: Vec<&[f64]> = positions.iter().map(|column| &column[..count]).collect();
        let known: Vec<Vec<f64>> = match sides.iter().any(|side| *side != 0.0) {
            true => sides[..axes].iter().map(|side| vec![*side; count]).collect(),
            false => Vec::new(),
        };
        let known: Vec<&[f64]> = known.iter().map(Vec::as_slice).collect();
        let asked = Commands::new(&positions).approached(&known);
        let done =
            columns(out, nominal, count).map(|mut out| compiled.deviations(&asked, &mut out));
        let bad = match done {
            Some(Ok(())) => None,
            Some(Err(error)) => Some(from + error.index().unwrap_or(0)),
            None => Some(from),
        };
        Outcome { outside: *outside, bad }
    };
    let mut out = blocks(table, commands.nrows());
    out.par_iter_mut().enumerate().map_init(|| Block::new(axes), work).collect()
}

/// The row of an array as a command, mm and rad.
fn command(compiled: &CompiledMachine, commands: &ArrayView2<'_, f64>, row: usize) -> Command {
    let mut command = Command::default();
    for (axis, value) in commands.row(row).iter().enumerate() {
        command[axis] = to_inner(compiled.machine(), axis, *value);
    }
    command
}

/// Names what is wrong: axes outside their travel are warnings, rows without a pose are errors.
fn judge(
    native: &NativeMachine,
    wanted: &Wanted<'_>,
    commands: &ArrayView2<'_, f64>,
    sides: &Approach,
    outcomes: &[Outcome],
) -> Diagnostics {
    let mut problems = Diagnostics::new();
    let machine = native.machine();
    for (index, axis) in machine.axes().iter().enumerate() {
        let of_axis = || outcomes.iter().map(|o| o.outside[index]).filter(|(_, count)| *count > 0);
        let count: usize = of_axis().map(|(_, count)| count).sum();
        let Some((first, _)) = of_axis().next() else { continue };
        // Not a number is outside, too, and an error.
        if commands[[first, index]].is_finite() {
            let rows = commands.nrows();
            let message =
                format!("{} stands outside its travel in {count} of {rows} rows", axis.name);
            let hint = "the machine cannot go there; this is the first such row";
            problems.warn("outside-travel", wanted.place(first, index), message, hint);
        }
    }
    for row in outcomes.iter().filter_map(|o| o.bad).take(MOST_NAMED) {
        if let Some(column) = not_finite(commands, row) {
            refuse_number(wanted, commands, row, column, &mut problems);
            continue;
        }
        let place: Place = wanted.row(row);
        let at = command(&native.compiled, commands, row);
        if PoseReport::at(machine, &at, sides, &place, &mut problems).is_some() {
            let message = format!("row {row} has no pose");
            problems.error("not-finite", place, message, "write smaller numbers");
        }
    }
    problems
}

/// A number of an array that is none.
pub fn refuse_number(
    wanted: &Wanted<'_>,
    array: &ArrayView2<'_, f64>,
    row: usize,
    column: usize,
    problems: &mut Diagnostics,
) {
    let what = &wanted.columns[column];
    let message = format!("row {row}, column {column} ({what}) is {}", array[[row, column]]);
    let hint = "every number must be finite: leave out the row, or correct it";
    problems.error("not-finite", wanted.place(row, column), message, hint);
}

/// Diagnostics of a finished table, or the exception.
fn close<'py>(
    py: Python<'py>,
    table: Bound<'py, PyArray2<f64>>,
    problems: &Diagnostics,
) -> PyResult<Found<'py>> {
    match problems.has_errors() {
        true => Err(refused(py, problems)),
        false => Ok((table, listed(py, problems)?)),
    }
}

/// Rows of n numbers: nominal tip (mm) and nominal axis (1) if `with_nominal`, deviation of the tip (mm), of the axis (1).
/// Written into `out` where it is given.
#[pyfunction]
#[pyo3(signature = (machine, commands, sides, threads, with_nominal, out))]
pub fn deviations<'py>(
    machine: &Bound<'py, NativeMachine>,
    commands: &Bound<'py, PyAny>,
    sides: Vec<f64>,
    threads: Option<usize>,
    with_nominal: bool,
    out: Option<Bound<'py, PyArray2<f64>>>,
) -> PyResult<Found<'py>> {
    let (py, native) = (commands.py(), machine.get());
    let wanted_columns = native.columns();
    let wanted = Wanted { name: NAME, columns: &wanted_columns };
    let given = wanted.array(commands)?;
    let commands = given.as_array();
    let sides = approach(&sides);
    // numpy asks for large pages, which cost far fewer page faults than those of a vector.
    let table = match out {
        Some(table) => table,
        None => {
            let rows = if with_nominal { 2 * NUMBERS } else { NUMBERS };
            PyArray2::zeros(py, [rows, commands.nrows()], false)
        }
    };
    let outcomes = {
        let mut writable = table.try_readwrite()?;
        let numbers = writable.as_slice_mut()?;
        threads::work(py, threads, || computed(&native.compiled, &commands, &sides, numbers))?
    };
    close(py, table, &judge(native, &wanted, &commands, &sides, &outcomes))
}

/// One row of n numbers for each of `error_names`, um or urad, then three for the growth of the workpiece, um.
#[pyfunction]
#[pyo3(signature = (machine, commands, sides, threads))]
pub fn errors_at<'py>(
    machine: &Bound<'py, NativeMachine>,
    commands: &Bound<'py, PyAny>,
    sides: Vec<f64>,
    threads: Option<usize>,
) -> PyResult<Found<'py>> {
    let (py, native) = (commands.py(), machine.get());
    let wanted_columns = native.columns();
    let wanted = Wanted { name: NAME, columns: &wanted_columns };
    let given = wanted.array(commands)?;
    let commands = given.as_array();
    let sides = approach(&sides);
    let rows = native.errors().len() + 3;
    let table = PyArray2::zeros(py, [rows, commands.nrows()], false);
    let outcomes = {
        let mut writable = table.try_readwrite()?;
        let numbers = writable.as_slice_mut()?;
        threads::work(py, threads, || native.errors_of(&commands, &sides, numbers))?
    };
    close(py, table, &judge(native, &wanted, &commands, &sides, &outcomes))
}

impl NativeMachine {
    fn errors_of(
        &self,
        commands: &ArrayView2<'_, f64>,
        sides: &Approach,
        table: &mut [f64],
    ) -> Vec<Outcome> {
        let errors = self.errors();
        let axes = self.machine().axes();
        let work = |(number, mut out): (usize, Vec<&mut [f64]>)| {
            let from = number * BLOCK;
            let mut outcome = Outcome { outside: [(0, 0); MAX_AXES], bad: None };
            for row in from..commands.nrows().min(from + BLOCK) {
                let at = command(&self.compiled, commands, row);
                for (axis, (seen, value)) in axes.iter().zip(outcome.outside.iter_mut().zip(at)) {
                    if !axis.travel.contains(value) {
                        *seen = (if seen.1 == 0 { row } else { seen.0 }, seen.1 + 1);
                    }
                }
                let Ok(values) = self.machine().errors_at(&at, sides) else {
                    outcome.bad = Some(row);
                    return outcome;
                };
                let shares = errors.iter().map(|(index, _)| {
                    values.get(*index) * if index.component.is_rotation() { 1e6 } else { 1e3 }
                });
                let all = shares.chain(values.workpiece_mm.iter().map(|mm| mm * 1e3));
                out.iter_mut().zip(all).for_each(|(column, value)| column[row - from] = value);
            }
            outcome
        };
        blocks(table, commands.nrows()).into_par_iter().enumerate().map(work).collect()
    }
}
