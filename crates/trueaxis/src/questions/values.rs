//! What must the control add to its commands?

use super::words::{self, argument};
use super::workpiece::{self, Asked, accepted};
use super::{Answer, MachineChoice, NewFile, Question, Tell};
use crate::files::output::Output;
use crate::report;
use serde_json::Value;
use std::path::PathBuf;
use trueaxis_correct::compensate::not_twice;
use trueaxis_correct::compensate::values::{
    MOST_POSITIONS, Order, ValueTable, ValuesError, compensation_values, travel_positions,
};
use trueaxis_input::{Diagnostics, Dimension, Files};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_machine::describe::{axis_index, to_inner, to_shown};
use trueaxis_machine::heat::Conditions;
use trueaxis_predict::predict::holes::Compensation;
use trueaxis_report::{English, Language, Report};

/// Values per axis and position, in least increments. Texts are as typed.
#[derive(Debug, Clone)]
pub struct CompensateValues {
    /// The machine.
    pub machine: MachineChoice,
    /// The axis of a table over the travel.
    pub axis: Option<String>,
    /// Without an axis one position; with it that of the other axes: `X=10 C=30`.
    pub at: Option<String>,
    /// Distance of the positions.
    pub step: Option<String>,
    /// These positions instead.
    pub targets: Option<String>,
    /// The least increment of the control, with its unit.
    pub increment: Option<String>,
    /// Which error is compensated.
    pub of: Compensation,
    /// Whether values of the machine alone are wanted, though the temperature of the workpiece is unknown.
    pub machine_only: bool,
    /// How they are shown.
    pub form: ValuesForm,
    /// Where they go; without it they are shown.
    pub output: Option<PathBuf>,
}

/// How values are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ValuesForm {
    /// Text with tables.
    Text,
    /// One JSON document.
    Json,
    /// The table of one axis.
    Csv,
}

/// The values of each axis.
#[derive(Debug)]
pub struct ValuesAnswer {
    machine: Machine,
    tables: Vec<ValueTable>,
    /// What it can cost that the temperature of the workpiece is not known.
    price: Option<String>,
    form: ValuesForm,
    output: Option<PathBuf>,
}

/// What may be replaced: such a file.
impl CompensateValues {
    fn of(&self) -> Compensation {
        if self.machine_only { Compensation::Machine } else { self.of }
    }

    /// What the part would have at the very positions that are asked for, were it as warm as the scales.
    fn price_here(machine: &Machine, conditions: &Conditions, orders: &[Order]) -> Option<String> {
        let celsius = machine.unknown_growth(conditions)?.scales_celsius?;
        let warm = machine.with_workpiece_at(conditions, celsius);
        let warm = machine.at(&warm, &mut Diagnostics::new())?;
        let each = orders.iter().filter_map(|order| {
            let order = Order { of: Compensation::Machine, ..order.clone() };
            let table = compensation_values(&warm, &order).ok()?;
            let axis = &machine.axes()[order.axis];
            let shown = (axis.kind == AxisKind::Linear).then_some(table.worst)?;
            let [none, alone, _] = shown.map(|mm| mm * 1e3);
            let name = axis.name;
            Some(format!("{none:.1} µm in {name} uncompensated, {alone:.1} µm compensated so"))
        });
        let each: Vec<String> = each.collect();
        (!each.is_empty()).then(|| format!("the part would then have {}", each.join(", ")))
    }

    /// The axes that are asked for.
    fn axes(&self, machine: &Machine, problems: &mut Diagnostics) -> Option<Vec<usize>> {
        let Some(letter) = &self.axis else {
            // `X=1` and `X = 1` both name X; the text was read already.
            let names = machine.axes().iter().map(|axis| axis.name.letter());
            let named = |name| self.at.as_ref().is_some_and(|text| text.contains(name));
            let named = names.enumerate().filter(|(_, name)| named(*name));
            return Some(named.map(|(axis, _)| axis).collect());
        };
        let found = axis_index(machine, letter);
        if found.is_none() {
            let message = format!("the machine has no axis `{letter}`");
            let hint = format!("its chain: {}", machine.chain_text());
            problems.error("unknown-axis", argument("--axis"), message, &hint);
        }
        Some(vec![found?])
    }

    fn order(
        &self,
        machine: &Machine,
        axis: usize,
        command: Command,
        problems: &mut Diagnostics,
    ) -> Option<Order> {
        let positions = match self.axis {
            None => vec![command[axis]],
            Some(_) => self.positions(machine, axis, problems)?,
        };
        if let Some(q) = positions.iter().find(|q| !machine.axes()[axis].travel.contains(**q)) {
            let at = to_shown(machine, axis, *q);
            let message = format!("{} {at} lies outside the travel", machine.axes()[axis].name);
            let hint = "the machine cannot go there";
            problems.warn("outside-travel", argument("--at"), message, hint);
        }
        let (dimension, usual) = match machine.axes()[axis].kind {
            AxisKind::Linear => (Dimension::Length, "1 um"),
            AxisKind::Rotary => (Dimension::Angle, "0.0001 deg"),
        };
        let text = self.increment.as_deref().unwrap_or(usual);
        let hint = format!("above zero, with its unit, such as \"{usual}\"");
        let wanted = ("an increment", &hint[..]);
        let increment = words::above_zero("--increment", text, dimension, wanted, problems)?;
        Some(Order { axis, command, positions, increment, of: self.of() })
    }

    fn positions(
        &self,
        machine: &Machine,
        axis: usize,
        problems: &mut Diagnostics,
    ) -> Option<Vec<f64>> {
        if let Some(text) = &self.targets {
            let hint = "plain numbers, in mm or degrees: \"0 500 1000\"";
            let numbers = words::numbers("--targets", text, hint, problems)?;
            if !(1..=MOST_POSITIONS).contains(&numbers.len()) {
                let message = format!("{} positions", numbers.len());
                problems.error("bad-count", argument("--targets"), message, hint);
                return None;
            }
            return Some(numbers.into_iter().map(|n| to_inner(machine, axis, n)).collect());
        }
        let usual = match machine.axes()[axis].kind {
            AxisKind::Linear => "100",
            AxisKind::Rotary => "10",
        };
        let text = self.step.as_deref().unwrap_or(usual);
        let hint = "a positive number, in mm or degrees: --step 100";
        let step = match words::numbers("--step", text, hint, problems)?[..] {
            [step] if step > 0.0 => to_inner(machine, axis, step),
            _ => {
                let message = format!("`{text}` is not a step");
                problems.error("not-positive", argument("--step"), message, hint);
                return None;
            }
        };
        let found = travel_positions(&machine.axes()[axis], step);
        if found.is_none() {
            let name = machine.axes()[axis].name;
            let message = format!("no positions over the travel of {name} in steps of {text}");
            let hint = format!(
                "the machine file must state its travel, and {MOST_POSITIONS} positions are the most; \
                 or use --targets"
            );
            problems.error("no-positions", argument("--axis"), message, &hint);
        }
        found
    }

    fn table(
        &self,
        machine: &Machine,
        order: &Order,
        problems: &mut Diagnostics,
    ) -> Option<ValueTable> {
        let refuse = |e: ValuesError| {
            let (code, hint) = match &e {
                ValuesError::Position(_) => (
                    "outside-table",
                    "stay inside the table (--targets), or say outside = \"clamp\" or \"extend\" for it",
                ),
                ValuesError::Unbounded { .. } => {
                    ("not-finite", "is the increment too small, or does an error curve run away?")
                }
            };
            let place = argument(if self.axis.is_some() { "--axis" } else { "--at" });
            problems.error(code, place, e.to_string(), hint);
        };
        compensation_values(machine, order).map_err(refuse).ok()
    }
}

impl Question for CompensateValues {
    type Input = (Machine, Vec<Order>, Option<String>);
    type Answer = ValuesAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Self::Input> {
        let machine = self.machine.read(files, problems)?;
        let machine = not_twice(&machine, self.machine.place(), problems);
        let command = match &self.at {
            Some(text) => words::command(&machine, "--at", text, problems)?,
            None => Command::default(),
        };
        let axes = self.axes(&machine, problems)?;
        if axes.is_empty() {
            let message = "no axis is named".to_owned();
            problems.error("missing-axis", argument("--at"), message, "such as \"X=3500 Y=2300\"");
        }
        if self.form == ValuesForm::Csv && axes.len() > 1 {
            let message = format!("{} axes do not fit in one CSV table", axes.len());
            let hint = "name one axis, or use json";
            problems.error("one-axis", argument("--format"), message, hint);
            return None;
        }
        let order = |axis| self.order(&machine, axis, command, problems);
        let orders: Vec<Order> = axes.into_iter().map(order).collect::<Option<_>>()?;
        let conditions = self.machine.conditions(files, &mut Diagnostics::new()).flatten();
        let conditions = conditions.unwrap_or_default();
        let asked = Asked {
            machine_only: self.of() == Compensation::Machine,
            here: Self::price_here(&machine, &conditions, &orders),
        };
        let price = accepted(&machine, &conditions, &asked, problems)?;
        Some((machine, orders, price))
    }

    fn outputs(&self, _: Option<&Self::Input>) -> Vec<Output> {
        self.output.iter().map(|path| Output::file("--output", path)).collect()
    }

    fn answer(
        &self,
        (machine, orders, price): Self::Input,
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<ValuesAnswer> {
        let tables = orders.iter().map(|order| self.table(&machine, order, problems));
        let tables = tables.collect::<Option<Vec<_>>>()?;
        // A text that is shown says it itself, on top.
        if self.form != ValuesForm::Text || self.output.is_some() {
            let hint = match self.of() {
                Compensation::Comprehensive => "these values are of the comprehensive error",
                _ => "use --of comprehensive",
            };
            if let Some(price) = &price {
                workpiece::warn(price, problems);
            }
            for warning in report::compensation_warnings(&machine, &tables) {
                problems.warn("machine-alone-is-worse", argument("--of"), warning, hint);
            }
        }
        Some(ValuesAnswer { machine, tables, price, form: self.form, output: self.output.clone() })
    }
}

impl ValuesAnswer {
    /// In the form that was asked for.
    fn written(&self, language: &dyn Language) -> String {
        let Self { machine, tables, .. } = self;
        match self.form {
            ValuesForm::Text => self.report().in_language(language).text(),
            ValuesForm::Json => format!("{:#}\n", self.json()),
            ValuesForm::Csv => {
                let price = self.price.as_deref().map(workpiece::heading);
                let csv = |t| report::compensation_csv(machine, t, price.as_deref());
                tables.iter().map(csv).collect()
            }
        }
    }

    fn json(&self) -> Value {
        let price = self.price.as_deref().map(workpiece::heading);
        report::compensation_json(&self.machine, &self.tables, price)
    }
}

impl Answer for ValuesAnswer {
    fn document(&self, _: &Diagnostics) -> Value {
        self.json()
    }

    fn report(&self) -> Report<'_> {
        let report = report::compensation_report(&self.machine, &self.tables);
        workpiece::on_top(report, self.price.as_deref())
    }

    fn text(&self, language: &dyn Language) -> String {
        if self.output.is_some() { String::new() } else { self.written(language) }
    }

    fn files(&mut self) -> Vec<NewFile> {
        let file = |path| NewFile::of("values", path, self.written(&English));
        self.output.iter().map(file).collect()
    }
}
