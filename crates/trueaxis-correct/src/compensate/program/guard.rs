//! What keeps a program from being compensated twice, or the wrong way.

use super::stand::Stand;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, Command};
use trueaxis_machine::tcp::TipControl;
use trueaxis_nc::Control;

/// What marks a compensated program in its heading.
pub const MARK: &str = "TRUEAXIS COMPENSATED";

/// Whether the heading of a program says that it is compensated.
pub fn is_compensated(source: &[u8]) -> bool {
    let head = &source[..source.len().min(1 << 14)];
    String::from_utf8_lossy(head).to_ascii_uppercase().contains(MARK)
}

/// The mark as a comment of a control.
pub(super) fn comment(mark: &str, control: Control) -> String {
    let plain = |c: char| match c {
        '(' => '[',
        ')' => ']',
        '%' | ';' | '~' | '"' => ' ',
        ' '..='~' => c,
        _ => '?',
    };
    let text: String = format!("{MARK} {mark}").chars().map(plain).take(200).collect();
    let text = text.trim_end();
    match control {
        Control::Fanuc | Control::Haas => format!("({})", text.to_ascii_uppercase()),
        // A comma would make some comments statements.
        Control::LinuxCnc => format!("({})", text.replace(',', " ")),
        Control::Sinumerik840d | Control::Heidenhain => format!("; {text}"),
    }
}

/// What could be wrong with a correction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wrong {
    /// There is none: what the others are to be compared with.
    NoCorrection,
    /// The signs of all axes.
    AllSigns,
    /// The sign of one axis, by its place in [`Machine::axes`].
    SignOf(usize),
}

/// What a correction would do with a wrong sign, and what the tool misses without any.
#[derive(Debug, Clone, PartialEq)]
pub struct Convention {
    /// What is wrong.
    pub what: Wrong,
    /// What the tip would miss, mm.
    pub tip_mm: f64,
    /// What the tool axis would miss, rad.
    pub axis_rad: f64,
}

/// At one block: without a correction, with every sign of it turned, and with that of each axis.
pub fn conventions(machine: &Machine, nominal: &Command, command: &Command) -> Vec<Convention> {
    let Some(control) = TipControl::of(machine) else { return Vec::new() };
    let wanted = Stand::of(&control, nominal);
    let left = |what: Wrong, trial: &Command| {
        let errors = machine.errors_at(trial, &Approach::default()).unwrap_or_default();
        let there = machine.deviation(trial, &errors);
        let is = Stand {
            tip: there.nominal_tip.vector() + there.tip_mm,
            axis: there.nominal_axis.vector() + there.axis,
        };
        let [tip_mm, axis_rad] = is.from(&wanted);
        Convention { what, tip_mm, axis_rad }
    };
    let turned = |i: usize| 2.0 * nominal[i] - command[i];
    let all = std::array::from_fn(turned);
    let mut rows = vec![left(Wrong::NoCorrection, nominal), left(Wrong::AllSigns, &all)];
    for i in 0..machine.axes().len() {
        if command[i] != nominal[i] {
            let mut one = *command;
            one[i] = turned(i);
            rows.push(left(Wrong::SignOf(i), &one));
        }
    }
    rows
}

/// How well the corrections are known.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Confidence {
    /// Places that were examined.
    pub looked_at: usize,
    /// Where the correction of the tip is smaller than its standard uncertainty.
    pub weaker: usize,
    /// The largest standard uncertainty of the tip (root of the sum over the three directions), mm.
    pub largest_u_mm: f64,
}

/// The standard uncertainty of the deviation of the tip, by linear propagation of every stated one.
pub(super) fn confidence(machine: &Machine, places: &[Command]) -> Confidence {
    let quantities = machine.uncertain_quantities();
    let mut found = Confidence::default();
    for command in places {
        let Ok(errors) = machine.errors_at(command, &Approach::default()) else { continue };
        let u = machine.uncertainties_at(command, &quantities);
        let tip = machine.deviation(command, &errors).tip_mm;
        let shift = |k: usize| {
            let displaced = u.displaced_by(&errors, k, 1.0);
            (machine.deviation(command, &displaced).tip_mm - tip).norm_squared()
        };
        let u_mm = (0..quantities.len()).map(shift).sum::<f64>().sqrt();
        found.looked_at += 1;
        found.weaker += usize::from(tip.norm() < u_mm);
        found.largest_u_mm = found.largest_u_mm.max(u_mm);
    }
    found
}
