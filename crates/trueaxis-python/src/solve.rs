//! The inverse: where the axes must stand for tips and tool axes of arrays.

use crate::arrays::{Wanted, not_finite};
use crate::machine::NativeMachine;
use crate::poses::refuse_number;
use crate::problems::{listed, refused};
use crate::threads;
use numpy::ndarray::{Array2, ArrayView2};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyList;
use rayon::prelude::*;
use trueaxis::describe::{to_inner, to_shown};
use trueaxis::geometry::Vec3;
use trueaxis::geometry::frame::{Direction, Point};
use trueaxis::input::Diagnostics;
use trueaxis::machine::axis::Command;
use trueaxis::machine::{FollowFault, SolveError, Target};

/// Bad rows that are named.
const MOST_NAMED: usize = 20;

/// Commands (mm and deg), whether they are within the travel, whether an axis is idle; what was found.
type Solved<'py> = (
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<bool>>,
    Bound<'py, PyArray1<bool>>,
    Bound<'py, PyList>,
);

/// One row: the best command, within the travel, singular.
type Row = (Command, bool, bool);

/// Tips, tool axes and where the machine stands before.
struct Asked<'py> {
    tips: PyReadonlyArray2<'py, f64>,
    axes: PyReadonlyArray2<'py, f64>,
    near: PyReadonlyArray2<'py, f64>,
}

impl NativeMachine {
    fn asked<'py>(
        &self,
        tips: &Bound<'py, PyAny>,
        axes: &Bound<'py, PyAny>,
        near: &Bound<'py, PyAny>,
    ) -> PyResult<Asked<'py>> {
        let py = tips.py();
        let [tip, axis] = [["x mm", "y mm", "z mm"], ["i", "j", "k"]].map(|c| c.map(str::to_owned));
        let columns = self.columns();
        let wanted = [
            Wanted { name: "tips", columns: &tip },
            Wanted { name: "axes", columns: &axis },
            Wanted { name: "near", columns: &columns },
        ];
        let tips = wanted[0].array(tips)?;
        let axes = wanted[1].array(axes)?;
        let near = wanted[2].array(near)?;
        let mut problems = Diagnostics::new();
        for (wanted, array) in wanted.iter().zip([&tips, &axes, &near]) {
            let array = array.as_array();
            let bad = (0..array.nrows()).find_map(|r| Some((r, not_finite(&array, r)?)));
            if let Some((row, column)) = bad {
                refuse_number(wanted, &array, row, column, &mut problems);
            }
        }
        let (rows, given, before) =
            (tips.as_array().nrows(), axes.as_array().nrows(), near.as_array().nrows());
        if given != rows || (before != rows && before != 1) {
            let message = format!(
                "`tips` has {rows} rows, `axes` {given} and `near` {before}: they belong together row by row"
            );
            let hint = "give as many tool axes as tips; of `near` as many, or one row";
            let place = trueaxis::input::Place::whole("axes");
            problems.error("array-shape", place, message, hint);
        }
        match problems.has_errors() {
            true => Err(refused(py, &problems)),
            false => Ok(Asked { tips, axes, near }),
        }
    }

    fn before(&self, near: &ArrayView2<'_, f64>, row: usize) -> Command {
        let row = if near.nrows() == 1 { 0 } else { row };
        let mut command = Command::default();
        for (axis, value) in near.row(row).iter().enumerate() {
            command[axis] = to_inner(self.machine(), axis, *value);
        }
        command
    }

    fn given<'py>(
        &self,
        py: Python<'py>,
        rows: &[Row],
        problems: &Diagnostics,
    ) -> PyResult<Solved<'py>> {
        let count = self.machine().axes().len();
        let mut commands = Array2::zeros((rows.len(), count));
        for (mut out, (command, ..)) in commands.rows_mut().into_iter().zip(rows) {
            for axis in 0..count {
                out[axis] = to_shown(self.machine(), axis, command[axis]);
            }
        }
        let flags = |of: fn(&Row) -> bool| rows.iter().map(of).collect::<Vec<_>>();
        let (within, singular) = (flags(|row| row.1), flags(|row| row.2));
        Ok((
            commands.into_pyarray(py),
            within.into_pyarray(py),
            singular.into_pyarray(py),
            listed(py, problems)?,
        ))
    }
}

fn target(tips: &ArrayView2<'_, f64>, axes: &ArrayView2<'_, f64>, row: usize) -> Option<Target> {
    let vector = |a: &ArrayView2<'_, f64>| Vec3::new(a[[row, 0]], a[[row, 1]], a[[row, 2]]);
    let axis = Direction::of(vector(axes))?;
    Some(Target { tip: Point::from_vector(vector(tips)), axis })
}

/// The place and the code of a pose that has no solution, as the command names it.
fn refuse(row: usize, error: Option<&SolveError>, problems: &mut Diagnostics) {
    let (array, code, hint) = match error {
        None => ("axes", "zero-axis", "write \"0 0 1\" for upright"),
        Some(SolveError::Unreachable { .. }) => {
            ("axes", "unreachable-direction", "tilt the part, or ask for the closest direction")
        }
        Some(SolveError::TipUnreachable { .. }) => {
            ("tips", "unreachable-tip", "the linear axes of this machine do not span space here")
        }
        Some(SolveError::NotFinite) => ("tips", "not-finite", "write finite numbers"),
    };
    let message =
        error.map_or_else(|| "the tool axis has no length".to_owned(), ToString::to_string);
    problems.error(code, trueaxis::input::Place::whole(&format!("{array}[{row}]")), message, hint);
}

fn warn(rows: &[Row], problems: &mut Diagnostics) {
    let first = |of: fn(&Row) -> bool| {
        let mut found = rows.iter().enumerate().filter(|(_, row)| of(row)).map(|(i, _)| i);
        found.next().map(|first| (first, found.count() + 1))
    };
    let place = |row: usize| trueaxis::input::Place::whole(&format!("axes[{row}]"));
    if let Some((row, count)) = first(|row| row.2) {
        let message = format!("a rotary axis has no effect on the tool axis in {count} rows");
        let hint = "every angle of that axis points the tool the same way; choose it with `near`";
        problems.warn("singular-pose", place(row), message, hint);
    }
    if let Some((row, count)) = first(|row| !row.1) {
        let message = format!("no solution lies within the travel of all axes in {count} rows");
        let hint = "move or tilt the part, or take another tool";
        problems.warn("outside-travel", place(row), message, hint);
    }
}

/// The best solution of each row for itnative.
#[pyfunction]
#[pyo3(signature = (machine, tips, axes, near, threads))]
pub fn solve<'py>(
    machine: &Bound<'py, NativeMachine>,
    tips: &Bound<'py, PyAny>,
    axes: &Bound<'py, PyAny>,
    near: &Bound<'py, PyAny>,
    threads: Option<usize>,
) -> PyResult<Solved<'py>> {
    let (py, native) = (tips.py(), machine.get());
    let asked = native.asked(tips, axes, near)?;
    let [tips, axes, near] = [&asked.tips, &asked.axes, &asked.near].map(|a| a.as_array());
    let machine = native.machine();
    let one = |row: usize| -> Result<Row, (usize, Option<SolveError>)> {
        let target = target(&tips, &axes, row).ok_or((row, None))?;
        let solved = machine.solve(&target, &native.before(&near, row));
        let solved = solved.map_err(|error| (row, Some(error)))?;
        let best = solved.solutions.first().ok_or((row, None))?;
        Ok((best.command, best.within_travel, solved.singular.is_some()))
    };
    let rows: Vec<_> =
        threads::work(py, threads, || (0..tips.nrows()).into_par_iter().map(one).collect())?;
    let mut problems = Diagnostics::new();
    for error in rows.iter().filter_map(|r| r.as_ref().err()).take(MOST_NAMED) {
        refuse(error.0, error.1.as_ref(), &mut problems);
    }
    if problems.has_errors() {
        return Err(refused(py, &problems));
    }
    let rows: Vec<Row> = rows.into_iter().flatten().collect();
    warn(&rows, &mut problems);
    native.given(py, &rows, &problems)
}

/// One continuous motion through all rows.
#[pyfunction]
pub fn follow<'py>(
    machine: &Bound<'py, NativeMachine>,
    tips: &Bound<'py, PyAny>,
    axes: &Bound<'py, PyAny>,
    near: &Bound<'py, PyAny>,
) -> PyResult<Solved<'py>> {
    let (py, native) = (tips.py(), machine.get());
    let asked = native.asked(tips, axes, near)?;
    let [tips, axes, near] = [&asked.tips, &asked.axes, &asked.near].map(|a| a.as_array());
    let mut problems = Diagnostics::new();
    let mut targets = Vec::with_capacity(tips.nrows());
    for row in 0..tips.nrows() {
        match target(&tips, &axes, row) {
            Some(target) => targets.push(target),
            None => refuse(row, None, &mut problems),
        }
    }
    let from = native.before(&near, 0);
    let machine = native.machine();
    let done = match problems.has_errors() {
        true => None,
        false => Some(py.detach(|| machine.follow(&targets, &from))),
    };
    let commands = match done {
        Some(Ok(commands)) => commands,
        Some(Err(error)) => {
            let (code, hint) = match &error.fault {
                FollowFault::Solve(fault) => {
                    refuse(error.index, Some(fault), &mut problems);
                    return Err(refused(py, &problems));
                }
                FollowFault::LeavesTravel { .. } => ("path-leaves-travel", "move the part"),
                FollowFault::Jump { .. } => {
                    ("path-jumps", "split the path where the rotary axes may turn back")
                }
            };
            let place = trueaxis::input::Place::whole(&format!("axes[{}]", error.index));
            problems.error(code, place, error.fault.to_string(), hint);
            return Err(refused(py, &problems));
        }
        None => return Err(refused(py, &problems)),
    };
    let is_singular = |target: &Target, command: &Command| {
        machine.solve(target, command).is_ok_and(|solved| solved.singular.is_some())
    };
    let rows: Vec<Row> = targets
        .iter()
        .zip(&commands)
        .map(|(target, command)| (*command, true, is_singular(target, command)))
        .collect();
    warn(&rows, &mut problems);
    native.given(py, &rows, &problems)
}
