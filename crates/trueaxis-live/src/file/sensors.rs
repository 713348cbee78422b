//! `[sensor.…]` of a plan: where temperatures come from, and which of them can be used.

use super::axes::AxisPlan;
use super::{sources, time};
use crate::model::{at, remembered};
use crate::sensor::SensorSettings;
use crate::sensor::modbus::ModbusSource;
use crate::sensor::mqtt::MqttSource;
use crate::sensor::opcua::OpcUaSource;
use std::path::Path;
use std::sync::Arc;
use trueaxis::input::plausible::Quantity;
use trueaxis::input::{Diagnostics, Dimension, Item, Place, Section};
use trueaxis::machine::Machine;
use trueaxis::machine::heat::{HeatModel, TemperatureLog, ThermalMemory};
use trueaxis::predict::holes::Compensation;

/// A sensor of a plan.
#[derive(Debug, Clone)]
pub struct SensorPlan {
    /// What it may say.
    pub settings: SensorSettings,
    /// Where it comes from.
    pub source: Source,
}

/// Where samples come from.
#[derive(Debug, Clone)]
pub enum Source {
    /// A log that is replayed on the clock of the run.
    Log {
        /// The log.
        log: Arc<TemperatureLog>,
        /// Its column.
        column: String,
        /// The time in it at the start of the run, s. Unit: s.
        start_s: f64,
        /// Seconds of the log per second of the run. Unit: 1.
        speed: f64,
    },
    /// A topic of an MQTT broker.
    Mqtt(MqttSource),
    /// A register of a Modbus device.
    Modbus(ModbusSource),
    /// A node of an OPC UA server.
    OpcUa(Box<OpcUaSource>),
    /// One value, every second: for a mock.
    Constant {
        /// The value.
        celsius: f64,
    },
}

pub(super) fn read_sensors(
    root: &Section<'_>,
    folder: &Path,
    machine: &Machine,
    (axes, of, pose): (&[AxisPlan], Compensation, bool),
) -> Option<Vec<SensorPlan>> {
    let needed = needed(machine.heat(), (axes, pose), of);
    if needed.is_empty() && root.get("sensor").is_none() {
        return Some(Vec::new());
    }
    let found = root.section("sensor", |section| {
        let (mut sensors, mut instead) = (Vec::new(), Vec::new());
        let mut sound = true;
        for (name, place, item) in section.entries() {
            let read = item.section(&section.path(name), |s| {
                let stands_in =
                    s.get("instead").map(|item| (item.text().map(str::to_owned), item.place()));
                instead.push(stands_in);
                read_sensor(s, name, folder)
            });
            let Some(sensor) = read.flatten() else {
                sound = false;
                continue;
            };
            check_input(section, &place, machine, (&sensor, of));
            sensors.push(SensorPlan { settings: sensor_role(sensor.settings, machine), ..sensor });
        }
        // A sensor that could not be read is not missing: its own fault is named.
        if !sound {
            return None;
        }
        resolve_instead(section, &mut sensors, &instead);
        check_twice(section, &sensors);
        check_needed(section, &sensors, &needed);
        Some(sensors)
    });
    let Some(sensors) = found else {
        let hint =
            "[sensor.scale_x] source = { log = \"day.csv\" }, range, rate_k_per_min and stale";
        root.error("live-no-sensor", "no sensor is named".to_owned(), hint);
        return None;
    };
    let sensors = sensors?;
    check_model(root, machine, &sensors);
    Some(sensors)
}

/// The sensors without which the correction is not known: of the scales of live axes (of all for a pose), of the structure, of
/// the workpiece.
fn needed(heat: &HeatModel, (axes, pose): (&[AxisPlan], bool), of: Compensation) -> Vec<String> {
    let live = |axis: &usize| pose || axes.iter().any(|plan| plan.axis == *axis);
    let scales = heat.scales.iter().filter(|scale| live(&scale.axis));
    let scales = scales.flat_map(|scale| scale.sensors().map(str::to_owned));
    let structure = heat.structure.iter().flat_map(|s| s.coefficients.iter().map(|c| c.0.clone()));
    let workpiece = heat.workpiece.iter().filter(|_| of == Compensation::Comprehensive);
    let workpiece = workpiece.flat_map(|w| w.sensors.iter().map(|s| s.name.clone()));
    scales.chain(structure).chain(workpiece).collect()
}

fn sensor_role(mut settings: SensorSettings, machine: &Machine) -> SensorSettings {
    let workpiece = machine.heat().workpiece.iter().flat_map(|w| &w.sensors);
    settings.is_workpiece = workpiece.into_iter().any(|s| s.name == settings.input);
    settings
}

fn check_input(
    section: &Section<'_>,
    place: &Place,
    machine: &Machine,
    (sensor, of): (&SensorPlan, Compensation),
) {
    let (name, input) = (&sensor.settings.name, &sensor.settings.input);
    let known = machine.heat().sensors();
    let is_workpiece =
        machine.heat().workpiece.iter().flat_map(|w| &w.sensors).any(|s| s.name == *input);
    if !known.contains(&input.as_str()) {
        let message = format!("no error of the machine file uses the sensor `{input}`");
        let hint = match known.is_empty() {
            true => {
                "the machine file has no sensors: add them to [scale.X], [heat.EZ0t] or [workpiece]"
                    .to_owned()
            }
            false => format!("input = one of: {}", known.join(", ")),
        };
        section.error_at(place.clone(), "live-unused-sensor", message, &hint);
    } else if is_workpiece && of == Compensation::Machine {
        let message = format!(
            "sensor `{name}` is on the workpiece, which the correction of the machine alone does not use"
        );
        section.error_at(
            place.clone(),
            "live-unused-sensor",
            message,
            "leave it out, or correct comprehensively",
        );
    }
}

fn check_needed(section: &Section<'_>, sensors: &[SensorPlan], needed: &[String]) {
    for input in needed {
        if !sensors.iter().any(|sensor| sensor.settings.input == *input) {
            let message = format!("nothing measures `{input}`, which the correction needs");
            let hint = format!("[sensor.{input}] source = …");
            section.error("live-missing-sensor", message, &hint);
        }
    }
}

/// Two sensors of one input would contradict each other; one that only stands in for the other is none of its own.
fn check_twice(section: &Section<'_>, sensors: &[SensorPlan]) {
    for (i, sensor) in sensors.iter().enumerate() {
        let input = &sensor.settings.input;
        if sensors[..i].iter().any(|other| other.settings.input == *input) {
            let message = format!("`{input}` is measured twice");
            section.error(
                "live-twice",
                message,
                "name it as another input, or leave one sensor out",
            );
        }
    }
}

fn resolve_instead(
    section: &Section<'_>,
    sensors: &mut [SensorPlan],
    instead: &[Option<(Option<String>, Place)>],
) {
    let places: Vec<String> = sensors.iter().map(|s| s.settings.name.clone()).collect();
    for (i, stated) in instead.iter().enumerate().take(sensors.len()) {
        let Some((Some(name), place)) = stated else { continue };
        let found = places.iter().position(|known| known == name).filter(|other| *other != i);
        let fits = found.filter(|other| {
            sensors[*other].settings.is_workpiece == sensors[i].settings.is_workpiece
        });
        if fits.is_none() {
            let message = format!("`{name}` cannot stand in for `{}`", places[i]);
            let hint = "another sensor of this plan; only one on the workpiece stands in for one on the workpiece";
            section.error_at(place.clone(), "live-instead", message, hint);
        }
        sensors[i].settings.instead = fits;
    }
}

/// What the machine file says against such a set of sensors, before the first sample comes.
fn check_model(root: &Section<'_>, machine: &Machine, sensors: &[SensorPlan]) {
    let middle = |s: &SensorPlan| (s.settings.range[0] + s.settings.range[1]) / 2.0;
    let readings: Vec<(&str, f64)> =
        sensors.iter().map(|s| (s.settings.input.as_str(), middle(s))).collect();
    let known: Vec<(&str, f64)> = readings
        .iter()
        .filter(|(input, _)| machine.heat().sensors().contains(input))
        .copied()
        .collect();
    let first = |name: &str| known.iter().find(|(of, _)| *of == name).map(|(_, celsius)| *celsius);
    // All alike, as heat in a scale begins.
    let uniform = |name: &str| first(name).and(known.first()).map(|(_, celsius)| *celsius);
    let made = match ThermalMemory::is_needed(machine) {
        false => at(machine, &known),
        true => {
            let mut memory = ThermalMemory::default();
            let begun = memory.take(machine, 0.0, &uniform).map_err(|fault| fault.to_string());
            begun.and_then(|()| remembered(machine, &memory, 0.0, &known))
        }
    };
    if let Err(message) = made {
        root.error("live-missing-sensor", message, "all sensors of a body, or none of them");
    }
}

fn read_sensor(section: &Section<'_>, name: &str, folder: &Path) -> Option<SensorPlan> {
    let input = section.text("input").unwrap_or(name).to_owned();
    let range =
        section.require("range", "range = [\"10 degC\", \"45 degC\"]").and_then(|i| read_range(&i));
    let rate = section.require("rate_k_per_min", "rate_k_per_min = 2").and_then(|i| {
        let rate = i.number()?;
        if rate <= 0.0 {
            i.error("not-positive", "`rate_k_per_min` is above zero".to_owned(), "such as 2");
        }
        Some(rate / 60.0)
    });
    let stale = section.require("stale", "stale = \"30 s\"").is_some();
    let (stale_s, stuck_s) = (time(section, "stale", 30.0), time(section, "stuck", 600.0));
    let hint = "source = { mqtt = \"host:1883\", topic }, { modbus = \"host:502\", register }, { opc_ua = \"opc.tcp://host:4840\", node, security }, { log = \"day.csv\" }, or { constant = \"30.5 degC\" } for a mock";
    let source = section.require("source", hint).and_then(|item| {
        item.section(&section.path("source"), |s| read_source(s, &input, folder)).flatten()
    });
    let settings = SensorSettings {
        name: name.to_owned(),
        input,
        range: range?,
        rate_k_per_s: rate?,
        stale_s,
        stuck_s,
        is_workpiece: false,
        instead: None,
    };
    let source = source.filter(|_| stale)?;
    Some(SensorPlan { settings, source })
}

fn read_range(item: &Item<'_>) -> Option<[f64; 2]> {
    let ends = item.list()?;
    let ends = ends
        .iter()
        .map(|end| end.quantity_of(Quantity::Temperature))
        .collect::<Option<Vec<_>>>()?;
    match ends[..] {
        [low, high] if low < high => Some([low, high]),
        _ => {
            item.error(
                "bad-range",
                "expected two temperatures in rising order".to_owned(),
                "[\"10 degC\", \"45 degC\"]",
            );
            None
        }
    }
}

fn read_source(section: &Section<'_>, input: &str, folder: &Path) -> Option<Source> {
    if let Some(item) = section.get("constant") {
        return Some(Source::Constant { celsius: item.quantity_of(Quantity::Temperature)? });
    }
    if let Some(item) = section.get("mqtt") {
        return sources::read_mqtt(section, &item, folder).map(Source::Mqtt);
    }
    if let Some(item) = section.get("modbus") {
        return sources::read_modbus(section, &item).map(Source::Modbus);
    }
    if let Some(item) = section.get("opc_ua") {
        return sources::read_opcua(section, &item, folder)
            .map(|source| Source::OpcUa(Box::new(source)));
    }
    let hint = "mqtt = \"host:1883\", modbus = \"host:502\", opc_ua = \"opc.tcp://host:4840\", log = \"day.csv\", or constant = \"30.5 degC\"";
    let item = section.require("log", hint)?;
    let path = folder.join(item.text()?);
    let mut problems = Diagnostics::new();
    let log = read_log(section, &path, &mut problems);
    section.take_over(problems);
    let column = section.text("column").unwrap_or(input).to_owned();
    let start_s = section.get("start").and_then(|i| i.unjudged(Dimension::Time)).unwrap_or(0.0);
    let speed = section.get("speed").map_or(Some(1.0), |item| {
        let speed = item.number()?;
        if speed <= 0.0 {
            item.error(
                "not-positive",
                "`speed` is above zero".to_owned(),
                "1 is the speed of the log",
            );
        }
        (speed > 0.0).then_some(speed)
    })?;
    let log = log?;
    if log.celsius(&column).is_none() {
        let names: Vec<&str> = log.sensors().collect();
        let message = format!("the log has no column of `{column}`");
        item.error("live-no-column", message, &format!("column = one of: {}", names.join(", ")));
        return None;
    }
    Some(Source::Log { log: Arc::new(log), column, start_s, speed })
}

fn read_log(
    section: &Section<'_>,
    path: &Path,
    problems: &mut Diagnostics,
) -> Option<TemperatureLog> {
    let text = section.files().text(path, "a log of temperatures (CSV)", problems)?;
    TemperatureLog::parse(&path.display().to_string(), &text, problems)
}
