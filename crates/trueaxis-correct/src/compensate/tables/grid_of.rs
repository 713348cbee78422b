//! The grid of what tables leave, where the rotary axes stand at the reference.

use super::control::{Control, range};
use super::grid::{self, GridFault, Gridded};
use super::lever::{Lever, correction};
use super::table::{PER_UNIT, count_of, counts};
use super::{LeftOut, Order, TablesError, What};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, AxisKind, Command};
use trueaxis_machine::chain::CommandFault;

/// Along each axis so many places show the size and the uncertainty of what remains.
const GLANCES: i64 = 4;
/// Why an axis gets nothing from the grid.
const UNCERTAIN: &str = "in the grid: nowhere larger than its own standard uncertainty";

/// What remains beside functions of one axis each.
struct Rest<'a> {
    machine: &'a Machine,
    lever: Lever<'a>,
    reference: Command,
    axes: [usize; 3],
    ends: [(usize, i64, i64); 3],
    /// The functions that are not for the grid, by input and output.
    elsewhere: &'a [(usize, usize)],
}

impl Rest<'_> {
    fn command(&self, place: [i64; 3]) -> Command {
        let mut command = self.reference;
        for ((axis, from, to), at) in self.ends.iter().zip(place) {
            // The last point may lie beyond the travel, where nothing is known.
            command[*axis] = at.clamp(*from, *to) as f64 * count_of(self.machine, *axis);
        }
        command
    }

    /// mm.
    fn at(&self, command: &Command) -> Result<[f64; 3], CommandFault> {
        // The functions, not the tables: what a table loses between its nodes is not for the grid to make up.
        let mut rest = correction(self.machine, command, &Approach::default())?;
        for (input, output) in self.elsewhere {
            rest[*output] -= self.lever.functions(*input, command[*input], 0.0)?[*output];
        }
        Ok(self.axes.map(|axis| rest[axis]))
    }

    /// The largest value of each of the three axes, mm, and whether it is somewhere larger than its own standard
    /// uncertainty; less than `half_mm` shows nothing.
    fn certain(&self, half_mm: f64) -> Result<[(f64, bool); 3], CommandFault> {
        // Of errors that are known together the u of one function says nothing.
        let mut found = [(0.0_f64, self.machine.joint().is_some()); 3];
        let at = |side: usize, i: i64| {
            let (_, from, to) = self.ends[side];
            from + (to - from) / GLANCES * i
        };
        for n in 0..(GLANCES + 1).pow(3) {
            let each = GLANCES + 1;
            let place = [at(0, n % each), at(1, n / each % each), at(2, n / each / each)];
            let command = self.command(place);
            let sizes = self.at(&command)?.map(f64::abs);
            let open = |(size, (_, certain)): (&f64, &(f64, bool))| *size > half_mm && !certain;
            let u = match sizes.iter().zip(&found).any(open) {
                true => self.lever.u_of_rest(&command, self.elsewhere)?,
                false => Command::default(),
            };
            for ((axis, size), (largest, certain)) in self.axes.iter().zip(sizes).zip(&mut found) {
                *largest = largest.max(size);
                *certain = *certain || size > half_mm && size > u[*axis];
            }
        }
        Ok(found)
    }
}

/// The grid of what remains beside these functions, by input and output, where the rotary axes stand at the reference; and
/// what it leaves out.
///
/// # Errors
/// [`TablesError`]
pub fn gridded(
    rest: &Machine,
    order: &Order,
    reference: &Command,
    (control, elsewhere): (&dyn Control, &[(usize, usize)]),
) -> Result<(Option<Gridded>, Vec<LeftOut>), TablesError> {
    let Some(rule) = control.grid() else { return Ok((None, Vec::new())) };
    let linear = rest.axes().iter().enumerate().filter(|(_, a)| a.kind == AxisKind::Linear);
    let axes: Vec<usize> = linear.map(|(i, _)| i).collect();
    let Some(axes) = axes.first_chunk::<3>() else { return Ok((None, Vec::new())) };
    let mut ends = [(0, 0, 0); 3];
    for (end, axis) in ends.iter_mut().zip(axes) {
        let ((from, to), _) = range(&rest.axes()[*axis], control)?;
        *end = (*axis, from, to);
    }
    let lever = Lever::new(rest, *reference)?;
    let (axes, reference) = (*axes, *reference);
    let remains = Rest { machine: rest, lever, reference, axes, ends, elsewhere };
    let half_mm = 0.5 * rule.increment as f64 / PER_UNIT;
    let certain = remains.certain(half_mm)?;
    let out = axes.iter().zip(certain).filter(|(_, (size, certain))| *size > half_mm && !certain);
    let left_out = out.map(|(axis, (largest, _))| LeftOut {
        what: What::Table { input: *axis, output: *axis },
        largest,
        reason: UNCERTAIN,
    });
    let left_out = left_out.collect();
    let wanted = |place: [i64; 3]| {
        let values = remains.at(&remains.command(place))?;
        Ok([0, 1, 2].map(|i| match certain[i].1 {
            true => counts(rest, axes[i], values[i]),
            false => 0.0,
        }))
    };
    let bound = order.bound_mm * PER_UNIT;
    let placed = grid::place(&wanted, ends, rule, bound).map_err(|fault| match fault {
        GridFault::Machine(fault) => TablesError::Position(fault),
        GridFault::TooMany(loss) => TablesError::GridPoints {
            target: control.key(),
            loss: loss / PER_UNIT * 1e3,
            bound: order.bound_mm * 1e3,
        },
        GridFault::TooLarge(value) => TablesError::GridValue {
            target: control.key(),
            value: value as f64 / PER_UNIT * 1e3,
            most: rule.largest as f64 / PER_UNIT * 1e3,
        },
    })?;
    Ok((Some(placed), left_out))
}
