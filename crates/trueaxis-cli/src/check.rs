use crate::output::{Format, Outcome, diagnostic_json, report, show, show_json};
use clap::Args;
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::PathBuf;
use trueaxis::files;
use trueaxis::machine::Machine;
use trueaxis::machine::axis::{Axis, AxisKind, Carries, Travel};
use trueaxis::machine::errors::{Component, Curve, ErrorKind, ErrorName};

/// The machine file to check.
#[derive(Args)]
#[command(after_help = "Example:\n  trueaxis check machines/xkas2525/machine.toml")]
pub struct Arguments {
    /// The machine file
    #[arg(value_name = "MACHINE.toml")]
    machine: PathBuf,
    /// For people or for programs
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let (machine, problems) = files::machine(&arguments.machine);
    if arguments.format == Format::Json {
        let usable = machine.is_some();
        let diagnostics: Vec<Value> = problems.iter().map(diagnostic_json).collect();
        show_json(&document(machine.as_ref(), &diagnostics));
        return if usable { Outcome::Done } else { Outcome::Unusable };
    }
    let Some(machine) = machine else {
        report(problems);
        return Outcome::Unusable;
    };
    report(problems);
    show(&describe(&machine));
    Outcome::Done
}

fn describe(machine: &Machine) -> String {
    let mut text = String::new();
    // Writing to a String cannot fail.
    let _ = writeln!(text, "{}", machine.name());
    let _ = writeln!(text, "  chain   {}", machine.chain_text());
    if !machine.source().is_empty() {
        let _ = writeln!(text, "  source  {}", machine.source());
    }
    let _ = writeln!(
        text,
        "\n  axis  carries    direction               travel                  fastest"
    );
    for axis in machine.axes() {
        let _ = writeln!(text, "{}", axis_line(axis));
    }
    let stated = machine.stated_errors();
    let count = |kind| stated.iter().filter(|(_, n)| n.kind == kind).count();
    let _ = writeln!(
        text,
        "\n  errors  {} location errors, {} error motions",
        count(ErrorKind::Location),
        count(ErrorKind::Motion)
    );
    for axis in machine.axes() {
        let _ = writeln!(text, "    {}  {}", axis.name, motions_line(machine, axis));
    }
    let lacking = lacks(machine);
    if lacking.is_empty() {
        text += "\n  It lacks nothing that a prediction needs.\n";
    } else {
        text += "\n  It lacks\n";
        for line in lacking {
            let _ = writeln!(text, "    - {line}");
        }
    }
    text
}

fn axis_line(axis: &Axis) -> String {
    let carries = match axis.carries {
        Carries::Workpiece => "workpiece",
        Carries::Tool => "tool",
    };
    let d = axis.direction;
    let direction = format!("({:.4} {:.4} {:.4})", d.x, d.y, d.z);
    let (scale, unit) = shown_unit(axis.kind);
    let travel = match axis.travel {
        Travel::Between(from, to) => {
            format!("{} .. {} {unit}", round(from * scale), round(to * scale))
        }
        Travel::Unlimited => "unlimited".to_owned(),
        Travel::Unknown => "not stated".to_owned(),
    };
    let fastest = match axis.limits.velocity {
        Some(v) if axis.kind == AxisKind::Linear => format!("{} m/min", round(v * 0.06)),
        Some(v) => format!("{} deg/s", round(v.to_degrees())),
        None => "not stated".to_owned(),
    };
    format!("  {:<5} {carries:<10} {direction:<23} {travel:<23} {fastest}", axis.name)
}

/// Twelve significant digits: hides the rounding of degrees to radians and back.
fn round(value: f64) -> f64 {
    format!("{value:.11e}").parse().unwrap_or(value)
}

fn shown_unit(kind: AxisKind) -> (f64, &'static str) {
    match kind {
        AxisKind::Linear => (1.0, "mm"),
        AxisKind::Rotary => (180.0 / std::f64::consts::PI, "deg"),
    }
}

fn motions_line(machine: &Machine, axis: &Axis) -> String {
    let body = machine.bodies().iter().find(|b| b.name == axis.name);
    let parts: Vec<String> = Component::ALL
        .into_iter()
        .filter_map(|component| {
            let stated = body?.stated(ErrorKind::Motion, component)?;
            let shape = match &stated.mean {
                Curve::Constant(_) => "constant",
                Curve::Polynomial { .. } => "polynomial",
                Curve::Fourier { .. } => "Fourier",
                Curve::Table { .. } => "table",
            };
            let name = ErrorName { body: axis.name, kind: ErrorKind::Motion, component };
            Some(format!("{name} {shape}"))
        })
        .collect();
    if parts.is_empty() { "none stated".to_owned() } else { parts.join(", ") }
}

/// What a prediction or a simulation would miss.
fn lacks(machine: &Machine) -> Vec<String> {
    let mut lacking = Vec::new();
    let list = |wanted: &dyn Fn(&Axis) -> bool| {
        let names: Vec<_> =
            machine.axes().iter().filter(|a| wanted(a)).map(|a| a.name.to_string()).collect();
        names.join(" ")
    };
    let travel = list(&|a| a.travel == Travel::Unknown);
    if !travel.is_empty() {
        lacking.push(format!("the travel of {travel}: a path that leaves it will not be noticed"));
    }
    let limits = list(&|a| {
        let l = a.limits;
        l.velocity.is_none() || l.acceleration.is_none() || l.jerk.is_none()
    });
    if !limits.is_empty() {
        lacking.push(format!("maximum velocity, acceleration or jerk of {limits}: no true timing"));
    }
    let stated = machine.stated_errors();
    if stated.is_empty() {
        lacking.push("errors: the actual machine is the nominal one".to_owned());
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

fn document(machine: Option<&Machine>, diagnostics: &[Value]) -> Value {
    let Some(machine) = machine else {
        return json!({
            "schema": "trueaxis/check/1", "usable": false, "diagnostics": diagnostics,
        });
    };
    let axes: Vec<Value> = machine.axes().iter().map(axis_json).collect();
    let errors: Vec<String> = machine.stated_errors().iter().map(|(_, n)| n.to_string()).collect();
    json!({
        "schema": "trueaxis/check/1",
        "usable": true,
        "name": machine.name(),
        "chain": machine.chain_text(),
        "source": machine.source(),
        "axes": axes,
        "errors": errors,
        "lacks": lacks(machine),
        "diagnostics": diagnostics,
    })
}

fn axis_json(axis: &Axis) -> Value {
    let (scale, unit) = shown_unit(axis.kind);
    let travel = match axis.travel {
        Travel::Between(from, to) => json!([from * scale, to * scale]),
        Travel::Unlimited => json!("unlimited"),
        Travel::Unknown => Value::Null,
    };
    let carries = if axis.carries == Carries::Tool { "tool" } else { "workpiece" };
    json!({
        "name": axis.name.to_string(),
        "carries": carries,
        "direction": [axis.direction.x, axis.direction.y, axis.direction.z],
        "sense": axis.sense,
        format!("travel_{unit}"): travel,
    })
}
