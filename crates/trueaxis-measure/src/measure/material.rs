//! `material_expansion`, `material_temperature` and `material_datum` of a laser.

use super::Kind;
use crate::instruments::MaterialCompensation;
use crate::instruments::instrument::{SetupError, SetupUnknown};
use trueaxis_geometry::Vec3;
use trueaxis_input::plausible::Quantity;
use trueaxis_input::{Diagnostics, Dimension, Item, MeasuredValue, Section, parse_quantity};
use trueaxis_machine::Machine;
use trueaxis_machine::file::read_vector_mm;
use trueaxis_machine::heat::{Conditions, check_range};

const EXPANSION: &str = "material_expansion";
const TEMPERATURE: &str = "material_temperature";
const DATUM: &str = "material_datum";

/// The settings of a laser for a material; `None` if there is a problem, `Some(None)` without one.
pub(super) fn read_material(
    section: &Section<'_>,
    kind: Kind,
    machine: &Machine,
    conditions: Option<&Conditions>,
) -> Option<Option<MaterialCompensation>> {
    let items = [EXPANSION, TEMPERATURE, DATUM].map(|key| section.get(key));
    let [expansion, temperature, datum] = &items;
    if items.iter().all(Option::is_none) {
        return Some(None);
    }
    if kind != Kind::LaserLine {
        for item in items.iter().flatten() {
            let message = format!("a {} has no compensation of a material", kind.name());
            item.error("unknown-key", message, "only a laser-line has one: remove it");
        }
        return None;
    }
    let workpiece = machine.heat().workpiece.as_ref();
    let expansion = match expansion {
        Some(item) => read_expansion(item, machine),
        None => {
            let message = "which material is the laser set to?".to_owned();
            let hint = "material_expansion = \"workpiece\" (of the machine file) or \"13.2 ± 0.3 um/(m K)\"";
            section.error("missing-key", message, hint);
            None
        }
    };
    let celsius = match temperature {
        Some(item) => read_temperature(section, item, machine, conditions),
        None => {
            let message = "which temperature does the laser take for the material?".to_owned();
            let hint = "material_temperature = \"workpiece\" (a sensor) or \"30.5 ± 0.1 degC\"";
            section.error("missing-key", message, hint);
            None
        }
    };
    let datum_mm = match datum {
        Some(item) => read_vector_mm(item),
        None => Some(workpiece.map_or_else(Vec3::zeros, |w| w.fixed_mm)),
    };
    let (celsius, sensor) = celsius?;
    Some(Some(MaterialCompensation {
        expansion_per_k: expansion?,
        celsius,
        sensor,
        datum_mm: datum_mm?,
    }))
}

/// What is uncertain of the material, as an unknown that is known to be 0 within u(κ).
pub(super) fn material_unknown(material: &MaterialCompensation) -> Option<SetupUnknown> {
    let u = material.u_share();
    let error = SetupError::Material;
    let name = Kind::LaserLine.unknown_name(error);
    (u > 0.0).then_some(SetupUnknown { name, error, prior_u: Some(u) })
}

fn read_expansion(item: &Item<'_>, machine: &Machine) -> Option<MeasuredValue> {
    if item.as_text() == Some("workpiece") {
        let workpiece = machine.heat().workpiece.as_ref();
        if workpiece.is_none() {
            let message = "the machine file does not say how its workpiece expands".to_owned();
            let hint = "write the coefficient, such as \"13.2 ± 0.3 um/(m K)\", or add [workpiece] expansion";
            item.error("no-workpiece", message, hint);
        }
        return workpiece.map(|w| w.expansion_per_k);
    }
    item.measured_of(Quantity::Expansion)
}

/// `"30.5 ± 0.1 degC"`, or a sensor of the machine, `"workpiece"` or `"workpiece ± 0.2 degC"`.
fn read_temperature(
    section: &Section<'_>,
    item: &Item<'_>,
    machine: &Machine,
    conditions: Option<&Conditions>,
) -> Option<(MeasuredValue, Option<String>)> {
    let is_number = item.as_text().is_none_or(|text| {
        text.trim_start().starts_with(|c: char| c.is_ascii_digit() || "+-.−".contains(c))
    });
    if is_number {
        let celsius = item.measured_unjudged(Dimension::Temperature)?;
        let mut problems = Diagnostics::new();
        let reading = (TEMPERATURE, celsius.value);
        check_range(reading, &item.place(), &item.limits(), &mut problems);
        let sound = !problems.has_errors();
        section.take_over(problems);
        return sound.then_some((celsius, None));
    }
    let text = item.text()?;
    let (name, u) = match text.split_once('±') {
        None => (text.trim(), None),
        Some((name, u)) => match parse_quantity(u, Dimension::Temperature) {
            Ok(u) if u >= 0.0 => (name.trim(), Some(u)),
            Ok(_) => {
                let message = "an uncertainty is not negative".to_owned();
                item.error("negative-uncertainty", message, "such as ± 0.1 degC");
                return None;
            }
            Err(e) => {
                item.error(e.code(), e.to_string(), &e.hint());
                return None;
            }
        },
    };
    let sensors = machine.heat().sensors();
    if !sensors.contains(&name) {
        let message = format!("the machine file has no sensor `{name}`");
        let hint = format!("its sensors: {}; or a temperature, \"30.5 degC\"", sensors.join(", "));
        item.error("unknown-sensor", message, &hint);
        return None;
    }
    let Some(value) = conditions.and_then(|c| c.celsius(name)) else {
        let message = format!("`{name}` has no temperature in this campaign");
        let hint =
            format!("[temperature] {name} = \"30.5 degC\", or a temperature instead of the sensor");
        item.error("missing-sensor", message, &hint);
        return None;
    };
    Some((MeasuredValue { value, u }, Some(name.to_owned())))
}
