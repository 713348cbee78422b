//! The tool at one position: nominal, actual, and what every error does to it.

use serde_json::{Value, json};
use std::fmt::Write;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Bed, Body, Pose};
use trueaxis_input::{Diagnostics, Place};
use trueaxis_machine::axis::{Approach, Command};
use trueaxis_machine::chain::CommandFault;
use trueaxis_machine::errors::ErrorValues;
use trueaxis_machine::heat::ErrorPart;
use trueaxis_machine::{Deviation, Machine};
use trueaxis_report::numbers::fixed;

/// A machine at one position.
#[derive(Debug, Clone)]
pub struct PoseReport<'m> {
    /// The machine, at its temperatures and with its tool.
    pub machine: &'m Machine,
    /// Where its axes stand, mm and rad.
    pub command: Command,
    /// Its errors there.
    pub errors: ErrorValues,
    /// What they do to the tool.
    pub deviation: Deviation,
    /// Whether the place of every body is told, too.
    pub with_bodies: bool,
}

impl<'m> PoseReport<'m> {
    /// The errors at a position and what they do to the tool; `place` is where a position that
    /// cannot be computed is shown.
    pub fn at(
        machine: &'m Machine,
        command: &Command,
        approach: &Approach,
        place: &Place,
        problems: &mut Diagnostics,
    ) -> Option<Self> {
        let refuse = |e: CommandFault| {
            let hint = "stay inside the table, or say outside = \"clamp\" or \"extend\" for it";
            problems.error("outside-table", place.clone(), e.to_string(), hint);
        };
        let errors = machine.errors_at(command, approach).map_err(refuse).ok()?;
        let deviation = machine.deviation(command, &errors);
        let vectors = [deviation.nominal_tip.vector(), deviation.tip_mm, deviation.axis];
        if !vectors.iter().all(|v| v.iter().all(|x| x.is_finite())) {
            let message = "the errors here are too large to be computed".to_owned();
            let hint = "an error curve runs away outside the travel: stay inside";
            problems.error("not-finite", place.clone(), message, hint);
            return None;
        }
        Some(Self { machine, command: *command, errors, deviation, with_bodies: false })
    }

    /// The share of every error.
    pub fn budget(&self) -> Budget {
        budget(self.machine, &self.command, &self.errors)
    }

    /// Where every body stands.
    pub fn bodies(&self) -> Bodies {
        bodies(self.machine, &self.command, &self.errors)
    }
}

/// The document `trueaxis/pose/1`.
pub fn pose_json(report: &PoseReport<'_>) -> Value {
    let mut document = json!({ "schema": "trueaxis/pose/1" });
    let values = deviation_json(&report.deviation);
    for key in ["nominal", "actual", "deviation"] {
        document[key] = values[key].clone();
    }
    document["budget"] = budget_json(&report.budget());
    if report.with_bodies {
        document["bodies"] = bodies_json(&report.bodies());
    }
    if report.machine.is_at_temperatures() {
        add_split(&mut document, report.machine, &report.command, &report.errors);
    }
    document
}

/// The same for people.
pub fn pose_text(report: &PoseReport<'_>) -> String {
    let (machine, deviation) = (report.machine, &report.deviation);
    let (tip, axis) = (deviation.nominal_tip.vector(), deviation.nominal_axis.vector());
    let mut text = format!("{}   {}\n\n", machine.name(), machine.chain_text());
    text += &format!("{:<22}{:>14} {:>14} {:>14}\n", "in the workpiece frame", "x", "y", "z");
    let mut row = |name: &str, v: Vec3, digits: usize, unit: &str| {
        let line = format!("{name:<22}{}  {unit}", columns(v, 14, digits));
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{}", line.trim_end());
    };
    row("tip, nominal", tip, 4, "mm");
    row("tip, actual", tip + deviation.tip_mm, 4, "mm");
    row("  deviation", deviation.tip_mm * 1e3, 3, "µm");
    row("axis, nominal", axis, 7, "");
    row("axis, actual", axis + deviation.axis, 7, "");
    row("  deviation", deviation.axis * 1e6, 3, "µrad");
    text += &budget_table(&report.budget());
    if report.with_bodies {
        text += &bodies_table(&report.bodies());
    }
    if machine.is_at_temperatures() {
        text += &split_table(machine, &report.command, &report.errors);
    }
    text
}

/// Nominal and actual tool, and the difference.
pub fn deviation_json(deviation: &Deviation) -> Value {
    let (tip, axis) = (deviation.nominal_tip.vector(), deviation.nominal_axis.vector());
    json!({
        "nominal": { "tip_mm": array(tip), "axis": array(axis) },
        "actual": {
            "tip_mm": array(tip + deviation.tip_mm),
            "axis": array(axis + deviation.axis),
        },
        "deviation": {
            "tip_um": array(deviation.tip_mm * 1e3),
            "axis_urad": array(deviation.axis * 1e6),
        },
    })
}

/// Each error alone.
pub fn budget_json(budget: &Budget) -> Value {
    let share = |(name, share): &(String, Deviation)| {
        json!({
            "error": name,
            "tip_um": array(share.tip_mm * 1e3),
            "axis_urad": array(share.axis * 1e6),
        })
    };
    budget.iter().map(share).collect()
}

/// Nominal and actual place of every body.
pub fn bodies_json(bodies: &Bodies) -> Value {
    bodies.iter().map(|(name, poses)| body_json(name, poses)).collect()
}

fn body_json(name: &str, [nominal, actual]: &[Pose<Bed, Body>; 2]) -> Value {
    let pose = |pose: &Pose<Bed, Body>| {
        let rows: Vec<[f64; 3]> = (0..3).map(|i| array(pose.linear().row(i).transpose())).collect();
        json!({ "origin_mm": array(*pose.shift_mm()), "rotation": rows })
    };
    json!({ "body": name, "nominal": pose(nominal), "actual": pose(actual) })
}

/// Three numbers in columns of equal width.
fn columns(v: Vec3, width: usize, digits: usize) -> String {
    let [x, y, z] = array(v).map(|x| fixed(x, digits));
    format!("{x:>width$} {y:>width$} {z:>width$}")
}

/// Every error by its name, with the deviation under it alone.
pub type Budget = Vec<(String, Deviation)>;

/// The deviation under each error alone; thermal parts such as `EXX(scale)` and `workpiece` too.
pub fn budget(machine: &Machine, command: &Command, errors: &ErrorValues) -> Budget {
    let shares = machine.shares(command, errors).into_iter();
    shares.map(|share| (share.name, machine.deviation(command, &share.errors))).collect()
}

/// What each part does to the tip, µm; that of the workpiece is its growth E_w.
fn split(machine: &Machine, command: &Command, errors: &ErrorValues) -> [(ErrorPart, Vec3); 4] {
    ErrorPart::ALL.map(|part| {
        let errors = machine.part(command, errors, part);
        let tip_um = match part {
            ErrorPart::Workpiece => errors.workpiece_mm,
            _ => machine.deviation(command, &errors).tip_mm,
        };
        (part, tip_um * 1e3)
    })
}

/// `comprehensive = machine - workpiece`, and its four parts.
fn add_split(document: &mut Value, machine: &Machine, command: &Command, errors: &ErrorValues) {
    let without = ErrorValues { workpiece_mm: Vec3::zeros(), ..*errors };
    let tip_um = |errors| array(machine.deviation(command, errors).tip_mm * 1e3);
    let parts = split(machine, command, errors).into_iter();
    let parts = parts.map(|(part, um)| (part.name().to_owned(), json!({ "tip_um": array(um) })));
    document["split"] = Value::Object(parts.collect());
    document["machine"] = json!({ "tip_um": tip_um(&without) });
    document["comprehensive"] = json!({
        "tip_um": tip_um(errors),
        "formula": "machine - workpiece = geometric + scale + structure - workpiece",
    });
    if let Some(settling) = machine.heat().workpiece.as_ref().and_then(|w| w.settling) {
        document["settling"] = json!({
            "time_constant_s": settling.time_constant_s,
            "time_to_a_tenth_s": settling.time_to_s(1.0, 0.1),
        });
    }
}

fn split_table(machine: &Machine, command: &Command, errors: &ErrorValues) -> String {
    let mut text = String::from("\nmachine - workpiece, tip, µm    x          y          z\n");
    for (part, um) in split(machine, command, errors) {
        let sign = if part == ErrorPart::Workpiece { '-' } else { '+' };
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{sign} {:<21} {}", part.name(), columns(um, 10, 3));
    }
    let whole = machine.deviation(command, errors).tip_mm * 1e3;
    let _ = writeln!(text, "= {:<21} {}", "comprehensive", columns(whole, 10, 3));
    if let Some(settling) = machine.heat().workpiece.as_ref().and_then(|w| w.settling) {
        let hours = settling.time_to_s(1.0, 0.1) / 3600.0;
        let _ = writeln!(
            text,
            "\nthe workpiece needs {hours:.1} h until a tenth of its difference to the air is left"
        );
    }
    text
}

/// Every body by its name, with its nominal and its actual place on the bed.
pub type Bodies = Vec<(String, [Pose<Bed, Body>; 2])>;

/// The nominal and the actual place of every body.
pub fn bodies(machine: &Machine, command: &Command, errors: &ErrorValues) -> Bodies {
    let nominal = machine.body_poses(command, &ErrorValues::default());
    let actual = machine.body_poses(command, errors);
    let names = machine.bodies().iter().map(|b| b.name.to_string());
    names.zip(nominal.into_iter().zip(actual).map(|(n, a)| [n, a])).collect()
}

/// The three numbers, without a minus before a zero.
pub fn array(v: Vec3) -> [f64; 3] {
    [v.x, v.y, v.z].map(|x| x + 0.0) // no minus before a zero
}

/// The errors that move the tip or turn the axis here, the greatest first.
pub fn budget_table(budget: &Budget) -> String {
    let mut felt: Vec<_> =
        budget.iter().filter(|(_, d)| d.tip_mm.norm() + d.axis.norm() > 0.0).collect();
    if felt.is_empty() {
        return String::new();
    }
    felt.sort_by(|a, b| b.1.tip_mm.norm().total_cmp(&a.1.tip_mm.norm()));
    let mut text = String::from(
        "\neach error alone            tip, µm                         axis, µrad\n\
         \u{20}                    x          y          z            x          y          z\n",
    );
    for (name, d) in felt {
        let (tip, axis) = (columns(d.tip_mm * 1e3, 10, 3), columns(d.axis * 1e6, 10, 3));
        let _ = writeln!(text, "{name:<11} {tip}   {axis}");
    }
    text
}

/// Where every body stands, and how far from there.
pub fn bodies_table(bodies: &Bodies) -> String {
    let mut text = String::from(
        "\nbody in the machine frame      nominal, mm                   actual - nominal, µm\n\
         \u{20}             x            y            z           x         y         z\n",
    );
    for (name, [nominal, actual]) in bodies {
        let (n, d) = (*nominal.shift_mm(), (actual.shift_mm() - nominal.shift_mm()) * 1e3);
        let _ = writeln!(text, "  {name} {}   {}", columns(n, 12, 4), columns(d, 9, 3));
    }
    text
}
