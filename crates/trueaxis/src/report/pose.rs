//! The tool at one position: nominal, actual, and what every error does to it.

use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Bed, Body, Pose};
use trueaxis_input::{Diagnostics, Place};
use trueaxis_machine::axis::{Approach, Command};
use trueaxis_machine::chain::CommandFault;
use trueaxis_machine::errors::ErrorValues;
use trueaxis_machine::heat::ErrorPart;
use trueaxis_machine::{Deviation, Machine};
use trueaxis_report::numbers::fixed;
use trueaxis_report::{Report, Section, Table};

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
    /// Whether the place of every body is reported, too.
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

/// The tool at one position, as text and page.
pub fn pose_report(report: &PoseReport<'_>) -> Report<'static> {
    let PoseReport { machine, deviation, .. } = report;
    let (tip, axis) = (deviation.nominal_tip.vector(), deviation.nominal_axis.vector());
    let mut table = Table::new(["", "x", "y", "z", "unit"]);
    let mut row = |name: &str, v: Vec3, digits: usize, unit: &str| {
        let [x, y, z] = texts(v, digits);
        table.push([name.to_owned(), x, y, z, unit.to_owned()]);
    };
    row("tip, nominal", tip, 4, "mm");
    row("tip, actual", tip + deviation.tip_mm, 4, "mm");
    row("  deviation", deviation.tip_mm * 1e3, 3, "µm");
    row("axis, nominal", axis, 7, "");
    row("axis, actual", axis + deviation.axis, 7, "");
    row("  deviation", deviation.axis * 1e6, 3, "µrad");
    let answer = Report::new(machine.name())
        .line(machine.chain_text())
        .section(Section::new("Tool in the workpiece frame").table(table))
        .section(budget_section(&report.budget()));
    let answer = match report.with_bodies {
        true => answer.section(bodies_section(&report.bodies())),
        false => answer,
    };
    match machine.is_at_temperatures() {
        true => answer.section(heat_section(report)),
        false => answer,
    }
}

/// Three numbers as texts.
fn texts(v: Vec3, digits: usize) -> [String; 3] {
    array(v).map(|x| fixed(x, digits))
}

/// Every error by its name, with the deviation under it alone.
pub type Budget = Vec<(String, Deviation)>;

/// The deviation under each error alone; thermal parts such as `EXX(scale)` and `workpiece` too.
pub fn budget(machine: &Machine, command: &Command, errors: &ErrorValues) -> Budget {
    let shares = machine.shares(command, errors).into_iter();
    shares.map(|share| (share.name, machine.deviation(command, &share.errors))).collect()
}

/// What each cause does to the tip, µm; that of the workpiece is its growth E_w.
pub(super) fn heat_shares(
    machine: &Machine,
    command: &Command,
    errors: &ErrorValues,
) -> [(ErrorPart, Vec3); 4] {
    ErrorPart::ALL.map(|part| {
        let errors = machine.part(command, errors, part);
        let tip_um = match part {
            ErrorPart::Workpiece => errors.workpiece_mm,
            _ => machine.deviation(command, &errors).tip_mm,
        };
        (part, tip_um * 1e3)
    })
}

fn heat_section(report: &PoseReport<'_>) -> Section<'static> {
    let PoseReport { machine, command, errors, .. } = report;
    let mut table = Table::new(["", "tip x", "y", "z"]);
    let mut row = |sign: char, name: &str, tip_um| {
        let name = format!("{sign} {name}");
        table.push(std::iter::once(name).chain(texts(tip_um, 3)));
    };
    for (part, um) in heat_shares(machine, command, errors) {
        row(if part == ErrorPart::Workpiece { '-' } else { '+' }, part.name(), um);
    }
    // Without the temperature of a workpiece that grows, the sum is not that of the part.
    let known = machine.heat().workpiece.is_none() || machine.growth().is_some();
    let sum = if known { "comprehensive" } else { "machine alone" };
    row('=', sum, machine.deviation(command, errors).tip_mm * 1e3);
    let section = Section::new("Machine − workpiece, µm").table(table);
    match machine.heat().workpiece.as_ref().and_then(|w| w.settling) {
        Some(settling) => section.paragraph(format!(
            "the workpiece needs {:.1} h until a tenth of its difference to the air remains",
            settling.time_to_s(1.0, 0.1) / 3600.0
        )),
        None => section,
    }
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
pub(super) fn budget_section(budget: &Budget) -> Section<'static> {
    let mut effective: Vec<_> =
        budget.iter().filter(|(_, d)| d.tip_mm.norm() + d.axis.norm() > 0.0).collect();
    effective.sort_by(|a, b| b.1.tip_mm.norm().total_cmp(&a.1.tip_mm.norm()));
    let rows = effective.into_iter().map(|(name, d)| {
        let numbers = [texts(d.tip_mm * 1e3, 3), texts(d.axis * 1e6, 3)];
        std::iter::once(name.clone()).chain(numbers.into_iter().flatten())
    });
    let headings = ["error", "tip x µm", "y µm", "z µm", "axis x µrad", "y µrad", "z µrad"];
    Section::new("Each error alone").table(Table::new(headings).rows(rows))
}

/// Where every body stands, and how far from there.
pub(super) fn bodies_section(bodies: &Bodies) -> Section<'static> {
    let rows = bodies.iter().map(|(name, [nominal, actual])| {
        let (n, d) = (*nominal.shift_mm(), (actual.shift_mm() - nominal.shift_mm()) * 1e3);
        let numbers = [texts(n, 4), texts(d, 3)];
        std::iter::once(name.clone()).chain(numbers.into_iter().flatten())
    });
    let headings = ["body", "x mm", "y mm", "z mm", "Δx µm", "Δy µm", "Δz µm"];
    let table = Table::new(headings).rows(rows).note("nominal origin; Δ: actual − nominal");
    Section::new("Bodies in the machine frame").table(table)
}
