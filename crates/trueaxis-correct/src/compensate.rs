//! Compensate: what the control has to add to its commands, and programs that fit this machine.
//!
//! - [`values`]: per axis and position, in least increments;
//! - [`adapt`](mod@adapt): a path moved onto the blank that was probed, and what wall it leaves;
//! - [`program`]: an NC program, so that the actual tool goes where it says;
//! - [`tables`](mod@tables): tables of controls, read back and proved.

pub mod adapt;
pub mod program;
pub mod tables;
pub mod values;

use trueaxis_input::{Diagnostics, Place};
use trueaxis_machine::Machine;

/// The machine as commands meet it: what the control compensates already (`[compensation] active` of the
/// machine file) is not compensated again, and that is reported.
pub fn not_twice(machine: &Machine, place: Place, problems: &mut Diagnostics) -> Machine {
    if let Some(names) = machine.active_names() {
        let message = format!("not compensated again: {names}");
        let hint = "the machine file says that their tables are active in the control: leave them on, and \
                    load nothing over them";
        problems.note("already-active", place, message, hint);
    }
    machine.with_active_compensation()
}
