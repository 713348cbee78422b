//! Two calibrations at one temperature: what the scale grows between the temperatures of their tables is no change.
//!
//! ```text
//!     E_old(q; T_new) = E_old(q) + s α (q − f)(T_new − T_old)                 docs/model.md eq. 344
//! ```

use crate::Machine;
use crate::errors::{Component, ErrorKind, ErrorName};
use crate::heat::expansion::{Anchor, Profile, growth_curve};
use crate::heat::{ErrorPart, Scale, ThermalTerm, ThermalUncertainty, measured_celsius, reach_of};
use trueaxis_input::MeasuredValue;

/// Tables of one positioning error that hold at two temperatures.
#[derive(Debug, Clone, PartialEq)]
pub struct TwoTemperatures {
    /// The error.
    pub error: ErrorName,
    /// The temperature of the older table, °C.
    pub old_celsius: f64,
    /// That of the newer one, to which the older one is referred, °C.
    pub new_celsius: f64,
    /// The expansion by which it is; `None`: no file states one, and the tables are compared as they are. Unit: 1/K.
    pub expansion_per_k: Option<MeasuredValue>,
}

/// The older machine with the tables of its scales at the temperatures of the newer one, and which they are.
pub(super) fn at_temperatures_of(old: &Machine, new: &Machine) -> (Machine, Vec<TwoTemperatures>) {
    let (mut cold, mut found) = (old.without_heat(), Vec::new());
    for (axis, of) in old.axes().iter().enumerate() {
        let along = |c: &Component| of.sense * of.direction[*c as usize];
        let components = [Component::X, Component::Y, Component::Z];
        let main = components.into_iter().max_by(|a, b| along(a).abs().total_cmp(&along(b).abs()));
        let Some(main) = main.filter(|c| !of.name.is_rotary() && along(c) != 0.0) else { continue };
        let [a, b] = [old, new].map(|machine| table_celsius(machine, axis, main));
        let Some((old_celsius, new_celsius)) = a.zip(b).filter(|(a, b)| a != b) else { continue };
        // The newer file knows the scale better.
        let scale = scale_of(new, axis).or_else(|| scale_of(old, axis));
        let error = ErrorName { kind: ErrorKind::Motion, component: main, body: of.name };
        let expansion_per_k = scale.map(|scale| scale.expansion_per_k);
        found.push(TwoTemperatures { error, old_celsius, new_celsius, expansion_per_k });
        let Some(scale) = scale else { continue };
        let anchor = Anchor { table_celsius: old_celsius, ..scale.anchor };
        for component in components.into_iter().filter(|c| along(c) != 0.0) {
            let uniform = || Profile::new(vec![(0.0, new_celsius)]);
            let grown = |per_k: f64| {
                Some(growth_curve(
                    &uniform()?,
                    along(&component) * per_k,
                    anchor,
                    reach_of(of.travel),
                ))
            };
            let Some(curve) = grown(scale.expansion_per_k.value) else { continue };
            let u = scale.expansion_per_k.u.and_then(grown);
            let name = format!("expansion of scale {}", of.name);
            let u = u.map(|curve| ThermalUncertainty { of: name, curve });
            let (kind, part) = (ErrorKind::Motion, ErrorPart::Scale);
            let term = ThermalTerm { kind, component, part, curve, u: u.into_iter().collect() };
            cold.bodies[axis + 1].thermal.push(term);
        }
    }
    (cold, found)
}

fn scale_of(machine: &Machine, axis: usize) -> Option<&Scale> {
    machine.heat().scales.iter().find(|scale| scale.axis == axis)
}

/// At which temperature the table of a positioning error holds; none: it is not stated, or there is no table.
fn table_celsius(machine: &Machine, axis: usize, component: Component) -> Option<f64> {
    let stated = machine.bodies()[axis + 1].motion[component as usize].as_ref()?;
    let of_scale = scale_of(machine, axis).map(|scale| scale.anchor.table_celsius);
    of_scale.or_else(|| measured_celsius(Some(stated)))
}
