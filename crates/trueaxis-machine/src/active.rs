//! Errors that are already compensated in the control.

use crate::Machine;
use crate::errors::{Curve, ErrorName, StatedError};
use trueaxis_input::{Diagnostics, Place, Section};

/// `[compensation] active = ["EXX", "EYY"]`: tables that are switched on in the control.
pub(crate) fn read_active(section: &Section<'_>) -> Vec<ErrorName> {
    let mut names = Vec::new();
    let hint = "the errors that the control compensates: active = [\"EXX\", \"EYY\"]";
    let items = section.require("active", hint).and_then(|item| item.list());
    for item in items.unwrap_or_default() {
        let Some(text) = item.text() else { continue };
        match ErrorName::parse(text) {
            Some(name) if !names.contains(&name) => names.push(name),
            Some(name) => {
                let message = format!("{name} occurs twice in the list");
                item.error("duplicate-error", message, "keep one of them");
            }
            None => {
                let message = format!("`{text}` is not the name of an error of ISO 230-1");
                item.error("unknown-error-name", message, "write a name such as EXX, EAA or EC0Y");
            }
        }
    }
    names
}

impl Machine {
    /// The errors that are already compensated in the control, as stated in the machine file.
    pub fn active_compensation(&self) -> &[ErrorName] {
        &self.active
    }

    /// Their names in a row; none if there are none.
    pub fn active_names(&self) -> Option<String> {
        let names: Vec<String> = self.active.iter().map(ToString::to_string).collect();
        (!names.is_empty()).then(|| names.join(" "))
    }

    /// The machine while these compensations are switched on: without their errors.
    ///
    /// ```
    /// use trueaxis_machine::{Machine, file::NoTables};
    /// let text = "[machine]\nname = \"mill\"\nchain = \"w b X Y Z t\"\n\
    ///             [location]\nEC0Y = \"10 urad\"\nEB0Z = \"5 urad\"\n\
    ///             [compensation]\nactive = [\"EC0Y\"]";
    /// let machine = Machine::check("mill.toml", text, &NoTables).0.expect("a machine");
    /// assert_eq!(machine.stated_errors().len(), 2);
    /// assert_eq!(machine.with_active_compensation().stated_errors().len(), 1);
    /// ```
    #[must_use]
    pub fn with_active_compensation(&self) -> Self {
        let active = |name: &ErrorName| self.active.contains(name);
        let stated = self.stated_errors();
        let compensated = stated.into_iter().filter(|(_, name)| active(name));
        compensated.fold(self.clone(), |machine, (index, _)| machine.with_error(index, None))
    }

    /// [`Self::as_running`] with a note that names the errors: `done` (such as "simulated") without them.
    #[must_use]
    pub fn running(self, done: &str, place: Place, problems: &mut Diagnostics) -> Self {
        let Some(names) = self.active_names() else { return self };
        let message = format!("{done} without {names}: the control compensates them");
        let hint = "the machine file says under [compensation] that their tables are active; take out what is not";
        problems.note("already-active", place, message, hint);
        self.as_running()
    }

    /// The machine as it runs: the errors that the control compensates are zero, and as uncertain as before.
    ///
    /// ```
    /// use trueaxis_machine::{Machine, file::NoTables};
    /// let text = "[machine]\nname = \"mill\"\nchain = \"w b X Y Z t\"\n\
    ///             [location]\nEC0Y = \"10 ± 2 urad\"\n\
    ///             [compensation]\nactive = [\"EC0Y\"]";
    /// let machine = Machine::check("mill.toml", text, &NoTables).0.expect("a machine").as_running();
    /// let mut command = trueaxis_machine::axis::Command::default();
    /// command[1] = 100.0;
    /// let errors = machine.errors_at(&command, &Default::default())?;
    /// assert_eq!(machine.deviation(&command, &errors).tip_mm.norm(), 0.0);
    /// assert_eq!(machine.uncertain_quantities().len(), 1);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn as_running(&self) -> Self {
        let is_active = |name: &ErrorName| self.active.contains(name);
        let stated = self.stated_errors().into_iter().filter(|(_, name)| is_active(name));
        stated.fold(self.clone(), |machine, (index, _)| {
            let error = self.bodies()[index.body].stated(index.kind, index.component).cloned();
            let zero = |e| StatedError { mean: Curve::Constant(0.0), reversal: None, ..e };
            machine.with_error(index, error.map(zero))
        })
    }
}
