//! M70 to M73 of LinuxCNC: the modal state is saved and restored.
//!
//! # Source
//! LinuxCNC 2.9 user manual, "M-Codes", sections "M70" to "M73".

use crate::execution;
use crate::moves::{CompensationSide, Event, PathControl, Position};
use crate::rs274::Run;
use crate::rs274::code::Saving;
use crate::text::program::{Fault, fault};

/// What a level of calls has saved.
#[derive(Debug, Clone, Default)]
pub(in crate::rs274) struct Saved {
    state: Option<Box<ModalState>>,
    /// The return from the subprogram restores it.
    until_return: bool,
}

/// The state that M70 saves; the motion code is no part of it.
#[derive(Debug, Clone)]
struct ModalState {
    modes: execution::Modes,
    arc_absolute: bool,
    retract_to_r: bool,
    path: (PathControl, f64),
    compensation: CompensationSide,
    offset: usize,
    tool_length: Position,
    length_code: f64,
}

impl Run<'_> {
    pub(in crate::rs274) fn save_or_restore(
        &mut self,
        saving: Saving,
        at: usize,
    ) -> Result<(), Fault> {
        let state = match saving {
            Saving::Save | Saving::SaveUntilReturn => Some(self.modal_state()),
            Saving::Forget => None,
            Saving::Restore => {
                let saved = self.frame().saved.state.clone();
                let Some(state) = saved else {
                    let message = "M72 without a state that was saved before".to_owned();
                    let hint = "write M70 before it, in the same program or subprogram";
                    return Err(fault("no-saved-state", at, message, hint));
                };
                self.restore(&state, at)?;
                return Ok(());
            }
        };
        let until_return = saving == Saving::SaveUntilReturn;
        self.frame().saved = Saved { state: state.map(Box::new), until_return };
        Ok(())
    }

    /// The end of a subprogram: what M73 has saved in it comes back.
    pub(in crate::rs274) fn restore_at_return(
        &mut self,
        saved: &Saved,
        at: usize,
    ) -> Result<(), Fault> {
        if let Some(state) = saved.state.as_ref().filter(|_| saved.until_return) {
            self.restore(state, at)?;
        }
        Ok(())
    }

    fn modal_state(&self) -> ModalState {
        let modes = &self.modes;
        ModalState {
            modes: self.core.modes.clone(),
            arc_absolute: modes.arc_absolute,
            retract_to_r: modes.retract_to_r,
            path: (modes.path, modes.path_tolerance_mm),
            compensation: modes.compensation,
            offset: self.frames.active,
            tool_length: self.frames.tool,
            length_code: modes.length_code,
        }
    }

    fn restore(&mut self, state: &ModalState, at: usize) -> Result<(), Fault> {
        let now = self.core.modes.clone();
        let saved = &state.modes;
        self.core.modes = execution::Modes {
            selected: now.selected,
            tool: now.tool,
            tool_centre: now.tool_centre,
            ..saved.clone()
        };
        if saved.plane != now.plane {
            self.core.select_plane(saved.plane);
        }
        if saved.speed != now.speed {
            self.core.set_speed(Some(saved.speed));
        }
        if saved.turning != now.turning {
            self.core.turn_spindle(saved.turning);
        }
        self.modes.arc_absolute = state.arc_absolute;
        self.modes.retract_to_r = state.retract_to_r;
        let (control, tolerance_mm) = state.path;
        if state.path != (self.modes.path, self.modes.path_tolerance_mm) {
            (self.modes.path, self.modes.path_tolerance_mm) = state.path;
            self.core.emit(Event::Path { control, tolerance_mm });
        }
        self.select_offset(state.offset, at);
        if state.tool_length != self.frames.tool {
            self.set_tool_length(state.tool_length);
        }
        self.modes.length_code = state.length_code;
        if state.compensation != self.modes.compensation {
            let before = CompensationSide::Off;
            self.compensation(before, false, at)?;
            if state.compensation != before {
                self.compensation(state.compensation, false, at)?;
            }
        }
        Ok(())
    }
}
