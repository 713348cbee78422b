//! A machine file, checked: what the machine is and what is missing in its file.

use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Axis, AxisKind, AxisSide, Travel};
use trueaxis_machine::errors::{Component, Curve, ErrorKind, ErrorName};
use trueaxis_report::numbers::{fixed, rounded};
use trueaxis_report::{Report, Section, Table};

/// What the machine is and what is missing in its file, as text and page.
pub fn check_report(machine: &Machine) -> Report<'static> {
    let tools = machine.tools().iter();
    let tools: Vec<_> =
        tools.map(|t| format!("{} ({} mm)", t.name, rounded(t.length_mm))).collect();
    let mut about = Section::new("");
    if !machine.source().is_empty() {
        about = about.paragraph(format!("source: {}", machine.source()));
    }
    if !tools.is_empty() {
        about = about.paragraph(format!("tools: {}", tools.join(", ")));
    }
    if let Some(line) = equipment_line(machine) {
        about = about.paragraph(line);
    }
    let axes = Table::new(["axis", "carries", "direction", "travel", "fastest"])
        .rows(machine.axes().iter().map(axis_row));
    let lacks = match lacks(machine) {
        none if none.is_empty() => {
            Section::new("").paragraph("Nothing that a prediction needs is missing.")
        }
        lacks => Section::new("Missing").list(lacks),
    };
    Report::new(machine.name())
        .line(format!("chain   {}", machine.chain_text()))
        .section(about)
        .section(Section::new("Axes").table(axes))
        .section(errors(machine))
        .section(lacks)
}

/// `spindle: at most 40000 1/min, 2.5 kW (not checked: programs state no forces); magazine: 12 places`.
fn equipment_line(machine: &Machine) -> Option<String> {
    let equipment = machine.equipment();
    let per_minute = |rad_per_s: f64| rounded(rad_per_s * 30.0 / std::f64::consts::PI);
    let spindle: Vec<String> = [
        equipment.max_spindle_rad_per_s.map(|v| format!("at most {} 1/min", per_minute(v))),
        equipment.min_spindle_rad_per_s.map(|v| format!("at least {} 1/min", per_minute(v))),
        equipment
            .spindle_power_w
            .map(|v| format!("{} kW (not checked: programs state no forces)", rounded(v / 1e3))),
    ]
    .into_iter()
    .flatten()
    .collect();
    let spindle = (!spindle.is_empty()).then(|| format!("spindle: {}", spindle.join(", ")));
    let magazine = equipment.magazine_places.map(|n| format!("magazine: {n} places"));
    let parts: Vec<String> = [spindle, magazine].into_iter().flatten().collect();
    (!parts.is_empty()).then(|| parts.join("; "))
}

fn errors(machine: &Machine) -> Section<'static> {
    let stated = machine.stated_errors();
    let of = |kind| stated.iter().filter(|(_, n)| n.kind == kind).count();
    let (locations, motions) = (of(ErrorKind::Location), of(ErrorKind::Motion));
    let axes = machine.axes().iter();
    let measured = measurements(machine).into_iter();
    Section::new("Errors")
        .paragraph(format!("{locations} location errors, {motions} error motions"))
        .table(Table::pairs(axes.map(|a| (a.name.to_string(), motions_line(machine, a)))))
        .list(measured.map(|(by, names)| format!("measured {by}: {}", names.join(" "))))
}

/// Instrument, date and temperature, each with the errors that they hold for.
pub(super) fn measurements(machine: &Machine) -> Vec<(String, Vec<String>)> {
    let mut groups: Vec<(String, Vec<String>)> = Vec::new();
    for (index, name) in machine.stated_errors() {
        let body = &machine.bodies()[index.body];
        let Some(stated) = body.stated(name.kind, name.component) else { continue };
        let measured = &stated.measured;
        let temperature = measured.temperature_celsius.map(|t| format!("{} °C", rounded(t)));
        let parts = [measured.instrument.clone(), measured.date.clone(), temperature];
        let words = parts.into_iter().flatten().collect::<Vec<_>>().join(", ");
        if words.is_empty() {
            continue;
        }
        match groups.iter_mut().find(|(known, _)| *known == words) {
            Some((_, names)) => names.push(name.to_string()),
            None => groups.push((words, vec![name.to_string()])),
        }
    }
    groups
}

fn axis_row(axis: &Axis) -> [String; 5] {
    let carries = match axis.carries {
        AxisSide::Workpiece => "workpiece",
        AxisSide::Tool => "tool",
    };
    let d = axis.direction;
    let [x, y, z] = [d.x, d.y, d.z].map(|v| fixed(v, 4));
    let direction = format!("({x} {y} {z})");
    let (scale, unit) = shown_unit(axis.kind);
    let travel = match axis.travel {
        Travel::Between(from, to) => {
            format!("{} .. {} {unit}", rounded(from * scale), rounded(to * scale))
        }
        Travel::Unlimited => "unlimited".to_owned(),
        Travel::Unknown => "not stated".to_owned(),
    };
    let fastest = match axis.limits.velocity {
        Some(v) if axis.kind == AxisKind::Linear => format!("{} m/min", rounded(v * 0.06)),
        Some(v) => format!("{} deg/s", rounded(v.to_degrees())),
        None => "not stated".to_owned(),
    };
    [axis.name.to_string(), carries.to_owned(), direction, travel, fastest]
}

pub(super) fn shown_unit(kind: AxisKind) -> (f64, &'static str) {
    match kind {
        AxisKind::Linear => (1.0, "mm"),
        AxisKind::Rotary => (180.0 / std::f64::consts::PI, "deg"),
    }
}

/// `EXX EYX table, EAX constant`.
fn motions_line(machine: &Machine, axis: &Axis) -> String {
    let body = machine.bodies().iter().find(|b| b.name == axis.name);
    let mut groups: Vec<(&str, String)> = Vec::new();
    for component in Component::ALL {
        let Some(stated) = body.and_then(|b| b.stated(ErrorKind::Motion, component)) else {
            continue;
        };
        let shape = match &stated.mean {
            Curve::Constant(_) => "constant",
            Curve::Polynomial { .. } => "polynomial",
            Curve::Fourier { .. } => "Fourier",
            Curve::Table { .. } => "table",
        };
        let name = ErrorName { body: axis.name, kind: ErrorKind::Motion, component };
        match groups.last_mut().filter(|(last, _)| *last == shape) {
            Some((_, names)) => *names += &format!(" {name}"),
            None => groups.push((shape, name.to_string())),
        }
    }
    let parts: Vec<_> = groups.iter().map(|(shape, names)| format!("{names} {shape}")).collect();
    if parts.is_empty() { "none stated".to_owned() } else { parts.join(", ") }
}

/// Data that a prediction or a simulation needs.
pub(super) fn lacks(machine: &Machine) -> Vec<String> {
    let mut lacking = Vec::new();
    let list = |wanted: &dyn Fn(&Axis) -> bool| {
        let names: Vec<_> =
            machine.axes().iter().filter(|a| wanted(a)).map(|a| a.name.to_string()).collect();
        names.join(" ")
    };
    let travel = list(&|a| a.travel == Travel::Unknown);
    if !travel.is_empty() {
        lacking.push(format!("the travel of {travel}: a path that leaves it is not detected"));
    }
    let limits = list(&|a| {
        let l = a.limits;
        l.velocity.is_none() || l.acceleration.is_none() || l.jerk.is_none()
    });
    if !limits.is_empty() {
        lacking.push(format!(
            "maximum velocity, acceleration or jerk of {limits}: no realistic timing"
        ));
    }
    if machine.models().is_empty() {
        lacking.push("models of its bodies: collisions are not detected".to_owned());
    }
    if machine.tip_mm().norm() == 0.0 {
        lacking.push("the length of the tool, taken as 0".to_owned());
    }
    let stated = machine.stated_errors();
    if stated.is_empty() {
        lacking.push("errors: the actual machine is the nominal one".to_owned());
    }
    let unplaced: Vec<String> = machine
        .bodies()
        .iter()
        .filter(|b| b.axis.is_some() && b.location.iter().all(Option::is_none))
        .map(|b| b.name.to_string())
        .collect();
    if !stated.is_empty() && !unplaced.is_empty() {
        lacking.push(format!("location errors (squareness, offsets) of {}", unplaced.join(" ")));
    }
    let missing: Vec<String> = missing_motions(machine);
    if !stated.is_empty() && !missing.is_empty() {
        lacking.push(format!("error motions, taken as 0: {}", missing.join(" ")));
    }
    let without_u = stated.iter().filter(|(i, n)| {
        machine.bodies()[i.body].stated(n.kind, n.component).is_some_and(|s| s.u.is_none())
    });
    let without_u: Vec<String> = without_u.map(|(_, n)| n.to_string()).collect();
    if !without_u.is_empty() {
        lacking.push(format!("standard uncertainties, taken as 0: {}", without_u.join(" ")));
    }
    lacking
}

fn missing_motions(machine: &Machine) -> Vec<String> {
    let mut missing = Vec::new();
    for body in machine.bodies().iter().filter(|b| b.axis.is_some()) {
        for component in Component::ALL {
            if body.stated(ErrorKind::Motion, component).is_none() {
                let name = ErrorName { body: body.name, kind: ErrorKind::Motion, component };
                missing.push(name.to_string());
            }
        }
    }
    missing
}
