//! The thermal sections of a machine file: `[scale.X]`, `[heat.EZ0t]`, and the growth of the
//! workpiece under `[workpiece]`.

use super::error_text::dimension_of;
use super::place_text::{read_direction, read_vector_mm};
use crate::axis::{Axis, AxisKind};
use crate::chain::ChainBody;
use crate::errors::{Component, ErrorIndex, ErrorKind, ErrorName};
use crate::heat::expansion::Anchor;
use crate::heat::{
    HeatModel, HeatedPlace, HeatedScale, REFERENCE_CELSIUS, Scale, Sensor, Settling,
    StructureModel, Workpiece, measured_celsius,
};
use trueaxis_geometry::Vec3;
use trueaxis_input::plausible::Quantity;
use trueaxis_input::{Dimension, Item, MeasuredValue, Section};

/// Heat sources closer than this cannot be separated, mm.
const CLOSEST_MM: f64 = 1.0;

/// `[scale.X]` and `[heat.EZ0t]`.
pub fn read_heat(root: &Section<'_>, axes: &[Axis], bodies: &[ChainBody]) -> HeatModel {
    let mut model = HeatModel::default();
    root.section("scale", |section| {
        for (key, place, item) in section.entries() {
            let found = axes.iter().position(|a| a.name.to_string() == key);
            let linear = found.filter(|i| axes[*i].kind == AxisKind::Linear);
            let Some(axis) = linear else {
                let message = format!("`{key}` is not a linear axis of this machine");
                let hint =
                    "write the letter of a linear axis: only linear scales and screws expand";
                section.error_at(place, "unknown-axis", message, hint);
                continue;
            };
            let read = |s: &Section<'_>| read_scale(s, axis, &axes[axis], &bodies[axis + 1]);
            let scale = item.section(&section.path(key), read);
            model.scales.extend(scale.flatten());
        }
    });
    root.section("heat", |section| {
        for (key, place, item) in section.entries() {
            let named = ErrorName::parse(key);
            // Only axes move.
            let known = named
                .filter(|n| n.body.is_axis() || n.kind == ErrorKind::Location)
                .and_then(|name| Some((name, bodies.iter().position(|b| b.name == name.body)?)));
            let Some((name, body)) = known else {
                let message = format!("`{key}` is not an error of a body of this machine");
                section.error_at(
                    place,
                    "unknown-error-name",
                    message,
                    "write the name of an error such as EZ0t, EB0Z, EXX",
                );
                continue;
            };
            let index = ErrorIndex { body, kind: name.kind, component: name.component };
            let read = |s: &Section<'_>| read_structure(s, name, index);
            model.structure.extend(item.section(&section.path(key), read).flatten());
        }
    });
    model
}

fn expansion(item: &Item<'_>) -> Option<MeasuredValue> {
    item.measured_of(Quantity::Expansion)
}

/// `sensors = { scale_x = "0 mm", scale_x_end = "3500 mm" }`.
fn read_sensors(section: &Section<'_>) -> Vec<Sensor> {
    let mut sensors = Vec::new();
    section.section("sensors", |s| {
        for (name, _, item) in s.entries() {
            if let Some(place_mm) = item.quantity(Dimension::Length) {
                sensors.push(Sensor { name: name.to_owned(), place_mm });
            }
        }
    });
    sensors
}

fn read_scale(
    section: &Section<'_>,
    axis_index: usize,
    axis: &Axis,
    body: &ChainBody,
) -> Option<Scale> {
    let hint = "write it with its unit, such as expansion = \"10.8 ± 0.3 um/(m K)\"";
    let alpha = section.require("expansion", hint).and_then(|i| expansion(&i));
    let fixed_mm = section.quantity("fixed_point", Dimension::Length).unwrap_or(0.0);
    let table_celsius = table_temperature(section, axis, body);
    let sensors = read_sensors(section);
    let is_heated = section.get("heated").is_some();
    let heated = read_heated(section);
    if sensors.is_empty() != is_heated {
        let message = "a scale needs `sensors` or a place where it is `heated`".to_owned();
        let hint = format!("write sensors = {{ scale_{} = \"0 mm\" }}", axis.name.letter());
        section.error("missing-key", message, &hint.to_lowercase());
    }
    Some(Scale {
        axis: axis_index,
        expansion_per_k: alpha?,
        anchor: Anchor { fixed_mm, table_celsius },
        sensors,
        heated,
    })
}

/// The temperature at which the positioning error was measured: said here or there.
fn table_temperature(section: &Section<'_>, axis: &Axis, body: &ChainBody) -> f64 {
    let stated = section.quantity_of("table_temperature", Quantity::Temperature);
    let along = [Component::X, Component::Y, Component::Z];
    let main = along.into_iter().max_by(|a, b| {
        axis.direction[*a as usize].abs().total_cmp(&axis.direction[*b as usize].abs())
    });
    let measured = main.and_then(|c| measured_celsius(body.motion[c as usize].as_ref()));
    if let (Some(a), Some(b)) = (stated, measured)
        && a != b
    {
        let message = format!("the error table was measured at {b} °C, not at {a} °C");
        let hint = "remove `table_temperature`: `measured` of the table states the temperature";
        section.error("two-temperatures", message, hint);
    }
    stated.or(measured).unwrap_or_else(|| {
        let message = format!(
            "the temperature of the error table of {} is not stated; 20 °C is \
                assumed",
            axis.name
        );
        let hint =
            "write table_temperature = \"20 degC\", or measured = { temperature = … } of the table";
        section.warn("no-temperature", message, hint);
        REFERENCE_CELSIUS
    })
}

/// `heated = { at, near, far, diffusivity, time }`, or a list of them on one scale.
fn read_heated(section: &Section<'_>) -> Option<HeatedScale> {
    let item = section.get("heated")?;
    let list =
        if item.is_list() { item.list()? } else { section.get("heated").into_iter().collect() };
    let mut heated: Option<HeatedScale> = None;
    let mut sound = true;
    for one in &list {
        let read = one.section(&section.path("heated"), read_heated_place).flatten();
        let Some((place, far, diffusivity_mm2_per_s)) = read else {
            sound = false;
            continue;
        };
        let whole = heated.get_or_insert(HeatedScale {
            places: Vec::new(),
            far: far.clone(),
            diffusivity_mm2_per_s,
        });
        if (&whole.far, whole.diffusivity_mm2_per_s) != (&far, diffusivity_mm2_per_s) {
            let message = "two heated places of one scale differ in `far` or `diffusivity`";
            let hint = "a scale has one diffusivity and one sensor far from the heated places";
            one.error("two-scales-in-one", message.to_owned(), hint);
            sound = false;
        }
        let same = |p: &HeatedPlace| {
            (p.place_mm - place.place_mm).abs() < CLOSEST_MM || p.near == place.near
        };
        if whole.places.iter().any(same) {
            let message =
                "two heated places of one scale have the same position or the same sensor";
            let hint = "give each its own sensor, at least 1 mm apart";
            one.error("heated-twice", message.to_owned(), hint);
            sound = false;
        }
        whole.places.push(place);
    }
    if list.is_empty() {
        item.error(
            "missing-key",
            "the list `heated` is empty".to_owned(),
            "add a heated place, or remove the entry",
        );
    }
    heated.filter(|_| sound)
}

fn read_heated_place(section: &Section<'_>) -> Option<(HeatedPlace, String, f64)> {
    let place_mm = section.quantity("at", Dimension::Length).unwrap_or(0.0);
    let near = section
        .require("near", "write the name of the sensor at the heated place")
        .and_then(|i| i.text());
    let far = section
        .require("far", "write the name of a sensor that the heat does not reach")
        .and_then(|i| i.text());
    let hint = "steel 4 mm^2/s, glass 0.5 mm^2/s";
    let item = section.require("diffusivity", hint);
    let diffusivity = item.and_then(|i| above_zero(&i, Dimension::Diffusivity));
    let time_s = section.get("time").and_then(|i| above_zero(&i, Dimension::Time));
    let place = HeatedPlace { place_mm, near: near?.to_owned(), time_s };
    Some((place, far?.to_owned(), diffusivity?))
}

fn above_zero(item: &Item<'_>, dimension: Dimension) -> Option<f64> {
    let value = item.quantity(dimension)?;
    if value <= 0.0 {
        item.error("not-positive", "the value must be above zero".into(), "check the sign");
        return None;
    }
    Some(value)
}

/// `[heat.EZ0t] spindle = "1.8 ± 0.2 um/K"`, and `reference = "20 degC"`.
fn read_structure(
    section: &Section<'_>,
    name: ErrorName,
    index: ErrorIndex,
) -> Option<StructureModel> {
    let reference = section.quantity_of("reference", Quantity::Temperature);
    let dimension = match dimension_of(name.component) {
        Dimension::Angle => Dimension::AnglePerKelvin,
        _ => Dimension::LengthPerKelvin,
    };
    let mut coefficients = Vec::new();
    for (sensor, _, item) in section.entries().into_iter().filter(|e| e.0 != "reference") {
        if let Some(coefficient) = item.measured(dimension) {
            coefficients.push((sensor.to_owned(), coefficient));
        }
    }
    if coefficients.is_empty() {
        let message = format!("{name}: no sensor is named for its thermal change");
        section.error(
            "missing-key",
            message,
            "write sensor and coefficient, such as spindle = \"1.8 ± 0.2 um/K\"",
        );
        return None;
    }
    let reference_celsius = reference.unwrap_or(REFERENCE_CELSIUS);
    Some(StructureModel { index, name: name.to_string(), coefficients, reference_celsius })
}

/// `expansion`, `fixed_point`, `sensors`, `along`, `settling` of `[workpiece]`.
pub fn read_workpiece_heat(section: &Section<'_>) -> Option<Workpiece> {
    let item = section.get("expansion");
    let fixed = section.get("fixed_point").and_then(|i| read_vector_mm(&i));
    let along = section.get("along").and_then(|i| read_direction(&i));
    let mut sensors = read_sensors(section);
    let settling = section.section("settling", read_settling);
    let Some(item) = item else {
        if fixed.is_some() || along.is_some() || settling.is_some() || !sensors.is_empty() {
            let message = "[workpiece] has no `expansion`: its thermal growth is zero".to_owned();
            section.error(
                "missing-key",
                message,
                "add an entry such as expansion = \"13.2 um/(m K)\"",
            );
        }
        return None;
    };
    if sensors.is_empty() {
        sensors.push(Sensor { name: "workpiece".to_owned(), place_mm: 0.0 });
    }
    Some(Workpiece {
        expansion_per_k: expansion(&item)?,
        fixed_mm: fixed.unwrap_or(Vec3::zeros()),
        along: along.unwrap_or(Vec3::x()),
        sensors,
        settling: settling.flatten(),
    })
}

/// `settling = { time_constant = "3 h" }` or thickness, film and heat capacity.
fn read_settling(section: &Section<'_>) -> Option<Settling> {
    if let Some(item) = section.get("time_constant") {
        let time_constant_s = above_zero(&item, Dimension::Time)?;
        return Some(Settling { time_constant_s });
    }
    let need =
        |key, dimension, hint| section.require(key, hint).and_then(|i| above_zero(&i, dimension));
    let thickness =
        need("thickness", Dimension::Length, "write the thickness of the plate, such as \"60 mm\"");
    let film = need(
        "film",
        Dimension::FilmCoefficient,
        "write the film coefficient; still air: \"8 W/(m^2 K)\"",
    );
    let heat = need(
        "heat_capacity",
        Dimension::HeatCapacity,
        "write the volumetric heat capacity; iron: \"3.6 MJ/(m^3 K)\"",
    );
    Some(Settling::of_plate(thickness?, film?, heat?))
}
