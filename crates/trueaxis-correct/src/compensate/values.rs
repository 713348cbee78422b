//! Compensation values per axis and position: minus the error of the axis in its own direction, in
//! whole increments, to be added to the command.
//!
//! ```text
//!     e(q) = δ(q) · d(q),   d = ∂(nominal)/∂q        c = −e, rounded            docs/model.md eq. 99
//! ```
//!
//! d is how a positive command moves the tool relative to the workpiece. So the sign is the control's
//! whatever the axis carries and whichever way it counts: a table that stands 5 µm too far in +X leaves
//! the tool 5 µm short, and its compensation is +5 µm.

use trueaxis_geometry::{Mat3, Vec3};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, Axis, AxisKind, Command, Travel};
use trueaxis_machine::chain::CommandFault;
use trueaxis_machine::errors::{ErrorIndex, ErrorKind, ErrorValues};
use trueaxis_machine::heat::ErrorPart;
use trueaxis_predict::predict::holes::{Compensation, compensation_increments};

/// More positions than this no control has a table for.
pub const MOST_POSITIONS: usize = 10_000;
/// A double counts no further one by one.
const MOST_INCREMENTS: f64 = 9e15;

/// What is to be compensated, and how finely.
#[derive(Debug, Clone, PartialEq)]
pub struct Order {
    /// The axis, by its place in [`Machine::axes`].
    pub axis: usize,
    /// Where the other axes stand.
    pub command: Command,
    /// The positions of the axis. Unit: mm or rad.
    pub positions: Vec<f64>,
    /// The least increment of a value. Unit: mm or rad.
    pub increment: f64,
    /// The machine alone, or the comprehensive error.
    pub of: Compensation,
}

/// One value: what is added to the command.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Value {
    /// In whole increments, halves away from zero.
    pub increments: i64,
    /// The same as an amount. Unit: mm or rad.
    pub added: f64,
    /// What the rounding leaves of the error that is compensated. Unit: mm or rad.
    pub remainder: f64,
}

/// The errors and the value at one position, mm or rad.
#[derive(Debug, Clone, PartialEq)]
pub struct Node {
    /// Of the axis. Unit: mm or rad.
    pub position: f64,
    /// Geometric, scale, structure: how they move the tool; workpiece: how it grows (E_w), which
    /// counts with a minus. Mean of both directions of approach. Unit: mm or rad.
    pub split: [f64; 4],
    /// The error of the machine: geometric + scale + structure. Unit: mm or rad.
    pub machine: f64,
    /// machine − workpiece: what the part has at 20 °C. Unit: mm or rad.
    pub comprehensive: f64,
    /// Standard uncertainty of the error that is compensated, where the machine file has one. Unit: mm or rad.
    pub u: Option<f64>,
    /// The value for the mean of both directions.
    pub value: Value,
    /// The values for rising and falling approach, where the error has reversal.
    pub by_direction: Option<[Value; 2]>,
    /// What the part has under no, machine-only and comprehensive compensation; of two directions
    /// of approach the worse. Unit: mm or rad.
    pub part: [f64; 3],
}

/// The values of one axis.
#[derive(Debug, Clone, PartialEq)]
pub struct ValueTable {
    /// What was asked.
    pub order: Order,
    /// In the order of the positions.
    pub nodes: Vec<Node>,
    /// Whether the temperature of the workpiece is known, or nothing of it grows; else the errors of the part
    /// are not known.
    pub part_is_known: bool,
    /// The largest error of the part under no, machine-only and comprehensive compensation. Unit: mm or rad.
    pub worst: [f64; 3],
}

impl ValueTable {
    /// Whether the part is better without any compensation than with that of the machine alone.
    pub fn machine_alone_is_worse(&self) -> bool {
        self.part_is_known && self.worst[1] > self.worst[0]
    }
}

/// Why there are no values.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ValuesError {
    /// A position that an error table does not cover.
    #[error(transparent)]
    Position(#[from] CommandFault),
    /// Errors or increments beyond all bounds.
    #[error("the value at position {at} is no number that a control has")]
    Unbounded {
        /// mm or rad.
        at: f64,
    },
}

/// The positions from one end of the travel to the other, both included; `None` where the travel is
/// not stated, or the steps are too many or none.
pub fn travel_positions(axis: &Axis, step: f64) -> Option<Vec<f64>> {
    let (from, to) = match axis.travel {
        Travel::Between(from, to) => (from, to),
        Travel::Unlimited => (0.0, std::f64::consts::TAU),
        Travel::Unknown => return None,
    };
    let steps = (to - from) / step;
    if !(0.0..=MOST_POSITIONS as f64 - 1.0).contains(&steps) {
        return None;
    }
    // A step that ends within a billionth of the travel ends there.
    let whole = (steps - 1e-9).ceil().max(0.0) as usize;
    let at = |i: usize| if i == whole { to } else { from + step * i as f64 };
    Some((0..=whole).map(at).collect())
}

/// The compensation values of an axis.
///
/// Of the errors of the machine those count that this axis can do something about: its own error
/// motions as they act on the tool, and what heat adds; squareness, mounting and the error motions of
/// other axes do not change with its position and stay out. With the compensation on, the error at
/// the position is the remainder; that the axis then stands a little elsewhere is of second order.
///
/// # Errors
/// A position outside an error table; errors too large for a number.
///
/// # Source
/// Zhang et al. 2019, sections 1.2, 2 and 3.1.
pub fn compensation_values(machine: &Machine, order: &Order) -> Result<ValueTable, ValuesError> {
    let nodes = order.positions.iter().map(|q| node(machine, order, *q));
    let nodes = nodes.collect::<Result<Vec<Node>, ValuesError>>()?;
    let worst = |i: usize| nodes.iter().map(|n: &Node| n.part[i].abs()).fold(0.0, f64::max);
    let part_is_known = machine.heat().workpiece.is_none() || machine.growth().is_some();
    let worst = [0, 1, 2].map(worst);
    Ok(ValueTable { order: order.clone(), worst, part_is_known, nodes })
}

fn node(machine: &Machine, order: &Order, position: f64) -> Result<Node, ValuesError> {
    let mut command = order.command;
    command[order.axis] = position;
    let sense = Sense::of(machine, order.axis, &command);
    let from = |side: f64| split_from(machine, order.axis, &command, (side, &sense));
    let (mean, up, down) = (from(0.0)?, from(1.0)?, from(-1.0)?);
    let unbounded = ValuesError::Unbounded { at: position };
    let of = |split: &[f64; 4]| value(error_of(order.of, split), order.increment);
    let value = of(&mean).ok_or(unbounded.clone())?;
    let by_direction = match up == down {
        true => None,
        false => Some([of(&up).ok_or(unbounded.clone())?, of(&down).ok_or(unbounded.clone())?]),
    };
    let left = |compensation: Compensation| {
        let after = |split: &[f64; 4]| {
            let error = error_of(Compensation::Comprehensive, split);
            let added = self::value(error_of(compensation, split), order.increment)?.added;
            Some(error + added)
        };
        let (up, down) = (after(&up)?, after(&down)?);
        Some(if up.abs() >= down.abs() { up } else { down })
    };
    let [Some(none), Some(alone), Some(whole)] = Compensation::ALL.map(left) else {
        return Err(unbounded);
    };
    let u = uncertainty(machine, order, &command, &sense);
    Ok(Node {
        position,
        split: mean,
        machine: error_of(Compensation::Machine, &mean),
        comprehensive: error_of(Compensation::Comprehensive, &mean),
        u: (u > 0.0 && u.is_finite()).then_some(u),
        value,
        by_direction,
        part: [none, alone, whole],
    })
}

/// Geometric, scale, structure and E_w of one axis in its own direction, as [`Node::split`] has them.
///
/// # Errors
/// A position outside an error table.
pub fn error_split(
    machine: &Machine,
    axis: usize,
    command: &Command,
) -> Result<[f64; 4], CommandFault> {
    split_from(machine, axis, command, (0.0, &Sense::of(machine, axis, command)))
}

fn split_from(
    machine: &Machine,
    axis: usize,
    command: &Command,
    (side, sense): (f64, &Sense),
) -> Result<[f64; 4], CommandFault> {
    let mut approach = Approach::default();
    approach[axis] = side;
    let errors = machine.errors_at(command, &approach)?;
    Ok(split(machine, axis, command, &errors, sense))
}

/// The error that a compensation takes away. Unit: that of the split.
pub fn error_of(
    compensation: Compensation,
    [geometric, scale, structure, workpiece]: &[f64; 4],
) -> f64 {
    match compensation {
        Compensation::None => 0.0,
        Compensation::Machine => geometric + scale + structure,
        Compensation::Comprehensive => geometric + scale + structure - workpiece,
    }
}

fn value(error: f64, increment: f64) -> Option<Value> {
    // Not a number is not smaller either.
    (error.abs() / increment < MOST_INCREMENTS).then(|| {
        let increments = compensation_increments(error, increment);
        let added = increments as f64 * increment;
        Value { increments, added, remainder: error + added }
    })
}

/// How a positive command moves the tool relative to the workpiece, in the workpiece frame.
pub(super) enum Sense {
    Along(Vec3),
    About(Vec3, AboutPose),
}

/// The nominal attitude of the tool.
pub(super) type AboutPose = Mat3;

impl Sense {
    pub(super) fn of(machine: &Machine, axis: usize, command: &Command) -> Self {
        let nominal = |step: f64| {
            let mut at = *command;
            at[axis] += step;
            machine.pose(&at, &ErrorValues::default())
        };
        match machine.axes()[axis].kind {
            // Straight: any step gives the same.
            AxisKind::Linear => {
                let step = nominal(1.0).shift_mm() - nominal(-1.0).shift_mm();
                Self::Along(step.try_normalize(0.0).unwrap_or_default())
            }
            AxisKind::Rotary => {
                let turn = nominal(0.5).linear() * nominal(-0.5).linear().transpose();
                let about = twice_sine(&turn).try_normalize(0.0).unwrap_or_default();
                Self::About(about, *nominal(0.0).linear())
            }
        }
    }

    /// How far the tool is off, mm or rad.
    pub(super) fn felt(&self, machine: &Machine, command: &Command, errors: &ErrorValues) -> f64 {
        match self {
            Self::Along(d) => machine.deviation(command, errors).tip_mm.dot(d),
            Self::About(d, nominal) => {
                let turn = machine.pose(command, errors).linear() * nominal.transpose();
                (0.5 * twice_sine(&turn).dot(d)).clamp(-1.0, 1.0).asin()
            }
        }
    }
}

/// 2 sin θ · axis of a rotation.
fn twice_sine(r: &Mat3) -> Vec3 {
    Vec3::new(r[(2, 1)] - r[(1, 2)], r[(0, 2)] - r[(2, 0)], r[(1, 0)] - r[(0, 1)])
}

/// Geometric, scale, structure and E_w in the direction of the axis.
fn split(
    machine: &Machine,
    axis: usize,
    command: &Command,
    errors: &ErrorValues,
    sense: &Sense,
) -> [f64; 4] {
    let mut parts = [ErrorValues::default(); 4];
    let own = body_of(machine, axis);
    for share in machine.shares(command, errors) {
        let [geometric, scale, structure, workpiece] = &mut parts;
        let sum = match share.part {
            ErrorPart::Geometric => geometric,
            ErrorPart::Scale => scale,
            ErrorPart::Structure => structure,
            ErrorPart::Workpiece => workpiece,
        };
        for index in ErrorIndex::all() {
            let own_motion = index.body == own && index.kind == ErrorKind::Motion;
            if share.part != ErrorPart::Geometric || own_motion {
                sum.set(index, sum.get(index) + share.errors.get(index));
            }
        }
        sum.workpiece_mm += share.errors.workpiece_mm;
    }
    let [geometric, scale, structure, workpiece] = parts;
    let felt = |errors: &ErrorValues| sense.felt(machine, command, errors) + 0.0;
    // The tool misses by minus the growth.
    [felt(&geometric), felt(&scale), felt(&structure), -felt(&workpiece) + 0.0]
}

pub(super) fn body_of(machine: &Machine, axis: usize) -> usize {
    // why: every axis moves a body of the chain.
    machine.bodies().iter().position(|b| b.axis == Some(axis)).expect("a body for each axis")
}

/// Of the errors that count, first order, each uncertain quantity by itself.
fn uncertainty(machine: &Machine, order: &Order, command: &Command, sense: &Sense) -> f64 {
    let own = body_of(machine, order.axis);
    let counts = |i: &ErrorIndex| i.kind == ErrorKind::Motion && i.body == own;
    let others = machine.stated_errors().into_iter().filter(|(index, _)| !counts(index));
    let counted = others.fold(machine.clone(), |m, (index, _)| m.with_error(index, None));
    let quantities = counted.uncertain_quantities();
    let at = counted.uncertainties_at(command, &quantities);
    let one = |quantity: usize| {
        let mut errors = at.displaced_by(&ErrorValues::default(), quantity, 1.0);
        if order.of == Compensation::Machine {
            errors.workpiece_mm = Vec3::zeros();
        }
        sense.felt(machine, command, &errors).powi(2)
    };
    (0..quantities.len()).map(one).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueaxis_input::Diagnostics;
    use trueaxis_machine::file::NoTables;
    use trueaxis_machine::heat::Conditions;

    fn table(
        text: &str,
        letter: char,
        at: f64,
        of: Compensation,
        temperatures: &str,
    ) -> ValueTable {
        let (machine, problems) = Machine::check("m.toml", text, &NoTables);
        let mut machine = machine.unwrap_or_else(|| panic!("{problems:?}"));
        if !temperatures.is_empty() {
            let mut problems = Diagnostics::new();
            let conditions = Conditions::typed("t", temperatures, &mut problems).unwrap();
            machine = machine.at(&conditions, &mut problems).unwrap();
        }
        let axis = machine.axes().iter().position(|a| a.name.letter() == letter).unwrap();
        let order = Order {
            axis,
            command: Command::default(),
            positions: vec![at],
            increment: if machine.axes()[axis].kind == AxisKind::Linear { 1e-3 } else { 1e-6 },
            of,
        };
        compensation_values(&machine, &order).unwrap()
    }

    #[test]
    fn the_sign_is_the_controls_whatever_the_axis_carries() {
        for (chain, error, increments) in [
            // A carriage 5 µm too far: take 5 µm away. A table 5 µm too far in +X: the tool is short.
            ("w b X Y Z t", "EXX = '5 um'", -5),
            ("w X' b Y Z t", "EXX = '5 um'", 5),
        ] {
            let text = format!(
                "machine = {{ name = 'm', chain = \"{chain}\" }}\n[motion.X]\n{error}\n[location]\nEC0Y = '9 urad'"
            );
            let found = table(&text, 'X', 100.0, Compensation::Machine, "");
            assert_eq!(found.nodes[0].value.increments, increments, "{chain}");
        }
        // A rotary table that turns 3 µrad too far about +z, against its command.
        for (chain, increments) in [("w C' b X Y Z t", 3), ("w b X Y Z C t", -3)] {
            let text = format!(
                "machine = {{ name = 'm', chain = \"{chain}\" }}\n[motion.C]\nECC = '3 urad'\nEXC = '7 um'"
            );
            let found = table(&text, 'C', 0.7, Compensation::Machine, "");
            assert_eq!(found.nodes[0].value.increments, increments, "{chain}");
            assert!((found.nodes[0].machine.abs() - 3e-6).abs() < 1e-15);
        }
    }

    #[test]
    fn both_directions_and_the_rounding_by_hand() {
        // Mean 4.4, B = E↑ − E↓ = 3: up 5.9, down 2.9.
        let text = "machine = { name = 'm', chain = 'w b X Y Z t' }\n[motion.X]\n\
                    EXX = { constant = '4.4 um', u = '0.5 um', reversal = '3 um' }";
        let found = table(text, 'X', 0.0, Compensation::Machine, "");
        let node = &found.nodes[0];
        assert_eq!(node.value.increments, -4);
        assert!((node.value.remainder - 0.4e-3).abs() < 1e-12);
        assert_eq!(node.by_direction.unwrap().map(|v| v.increments), [-6, -3]);
        assert!((node.u.unwrap() - 0.5e-3).abs() < 1e-12);
        assert!((found.worst[1] - 0.1e-3).abs() < 1e-12);
    }

    #[test]
    fn a_warm_hall_by_hand() {
        let text = "machine = { name = 'm', chain = 'w b X Y Z t' }\n[motion.X]\nEXX = '30 um'\n\
                    [scale.X]\nexpansion = '10 ± 1 um/(m K)'\ntable_temperature = '20 degC'\n\
                    sensors = { s = '0 mm' }\n[workpiece]\nexpansion = '13 um/(m K)'\n\
                    sensors = { w = '0 mm' }\n[heat.EX0t]\nspindle = '2 um/K'";
        // 30 + 10·1·10 + 2·1 − 13·1·10 = 2 µm; without the workpiece 132 µm.
        let found = table(text, 'X', 1000.0, Compensation::Comprehensive, "s=30 w=30 spindle=21");
        let node = &found.nodes[0];
        let um = node.split.map(|v| (v * 1e6).round() / 1e3);
        assert_eq!(um, [30.0, 100.0, 2.0, 130.0]);
        assert_eq!(node.value.increments, -2);
        assert_eq!(node.part.map(|v| (v * 1e6).round() / 1e3), [2.0, -130.0, 0.0]);
        assert!(found.machine_alone_is_worse());
        assert!((node.u.unwrap() - 0.01).abs() < 1e-9); // 1 µm/(m·K) · 1 m · 10 K
    }

    #[test]
    fn steps_end_at_the_end_of_the_travel() {
        let text = "machine = { name = 'm', chain = 'w b X Y Z t' }\n[axis.X]\n\
                    travel = ['-50 mm', '220 mm']";
        let machine = Machine::check("m.toml", text, &NoTables).0.unwrap();
        let axis = &machine.axes()[0];
        assert_eq!(travel_positions(axis, 100.0).unwrap(), [-50.0, 50.0, 150.0, 220.0]);
        assert_eq!(travel_positions(axis, 90.0).unwrap(), [-50.0, 40.0, 130.0, 220.0]);
        assert_eq!(travel_positions(axis, 1e9).unwrap(), [-50.0, 220.0]);
        assert!(travel_positions(axis, 1e-9).is_none());
        assert!(travel_positions(&machine.axes()[1], 1.0).is_none());
    }
}
