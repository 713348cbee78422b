//! Laws of the compensation values: judged by mathematics.

use proptest::prelude::*;
use trueaxis::compensate::values::{Order, ValueTable, compensation_values};
use trueaxis::input::Diagnostics;
use trueaxis::machine::Machine;
use trueaxis::machine::axis::{AxisKind, Command};
use trueaxis::machine::errors::ErrorValues;
use trueaxis::machine::file::NoTables;
use trueaxis::machine::heat::Conditions;
use trueaxis::predict::holes::Compensation;

/// A machine whose axes carry either side, with errors of its own and heat.
fn machine(chain: usize, sense: bool, um: [f64; 3], celsius: [f64; 2]) -> Machine {
    let chain = ["w b X Y Z C t", "w X' b Y Z C t", "w C' X' b Z Y t", "w Y' C' b X Z t"][chain];
    let sense = if sense { "sense = 1" } else { "" };
    let [a, b, c] = um;
    let text = format!(
        "machine = {{ name = 'm', chain = \"{chain}\" }}\n[axis.X]\n{sense}\n[motion.X]\n\
         EXX = {{ polynomial = ['{a} um', '{b} um', '{c} um'], scale = '500 mm', reversal = '{c} um', \
         u = '1 um' }}\nEBX = '{b} urad'\n[motion.C]\nECC = {{ fourier = {{ mean = '{a} urad', terms = \
         [[1, '{b} urad', '{c} urad']] }} }}\n[location]\nEC0Y = '40 urad'\n[scale.X]\n\
         expansion = '11 um/(m K)'\ntable_temperature = '20 degC'\nsensors = {{ s = '0 mm' }}\n\
         [workpiece]\nexpansion = '13 um/(m K)'\nsensors = {{ w = '0 mm' }}\n\
         [tool]\nlength = '150 mm'\n"
    );
    let (machine, problems) = Machine::check("m.toml", &text, &NoTables);
    let machine = machine.unwrap_or_else(|| panic!("{problems:?}"));
    let mut problems = Diagnostics::new();
    let typed = format!("s={} w={}", celsius[0], celsius[1]);
    let conditions = Conditions::typed("t", &typed, &mut problems).expect("sound");
    machine.at(&conditions, &mut problems).expect("sensors")
}

fn table(machine: &Machine, axis: usize, increment: f64, of: Compensation) -> ValueTable {
    let positions = match machine.axes()[axis].kind {
        AxisKind::Linear => vec![-400.0, 0.0, 333.0, 900.0],
        AxisKind::Rotary => vec![-2.0, 0.0, 0.5, 3.0],
    };
    let order = Order { axis, command: Command::default(), positions, increment, of };
    compensation_values(machine, &order).expect("no table is left")
}

proptest! {
    #[test]
    fn law_what_is_left_is_half_an_increment(
        chain in 0..4_usize,
        sense in any::<bool>(),
        um in prop::array::uniform3(-60.0..60.0_f64),
        celsius in prop::array::uniform2(15.0..35.0_f64),
        increment in 1e-5..5e-3_f64,
    ) {
        let machine = machine(chain, sense, um, celsius);
        for axis in 0..machine.axes().len() {
            for of in [Compensation::Machine, Compensation::Comprehensive] {
                let table = table(&machine, axis, increment, of);
                for node in &table.nodes {
                    prop_assert!(node.value.remainder.abs() <= 0.5 * increment * (1.0 + 1e-6));
                    for value in node.by_direction.into_iter().flatten() {
                        prop_assert!(value.remainder.abs() <= 0.5 * increment * (1.0 + 1e-6));
                    }
                    let [geometric, scale, structure, workpiece] = node.split;
                    prop_assert!((geometric + scale + structure - node.machine).abs() < 1e-15);
                    prop_assert!((node.machine - workpiece - node.comprehensive).abs() < 1e-15);
                    prop_assert!((node.part[0].abs()) <= table.worst[0]);
                }
            }
        }
    }

    /// The command with the value on it brings the tool to its place on the nominal machine, in the
    /// direction of the axis; here with a fine increment and the errors of the machine itself.
    #[test]
    fn law_the_compensated_command_meets_the_nominal_tool(
        chain in 0..4_usize,
        sense in any::<bool>(),
        um in prop::array::uniform3(-60.0..60.0_f64),
        celsius in prop::array::uniform2(15.0..35.0_f64),
    ) {
        let machine = machine(chain, sense, um, celsius);
        let x = machine.axes().iter().position(|a| a.name.letter() == 'X').expect("X");
        let table = table(&machine, x, 1e-9, Compensation::Comprehensive);
        for node in &table.nodes {
            let mut command = Command::default();
            command[x] = node.position;
            let tip = |command: &Command| {
                machine.deviation(command, &ErrorValues::default()).nominal_tip.vector()
            };
            let wanted = tip(&command);
            let mut ahead = command;
            ahead[x] += 1.0;
            let direction = tip(&ahead) - wanted;
            command[x] += node.value.added;
            let errors = machine.errors_at(&command, &[0.0; 6]).expect("no table");
            let off = tip(&command) + machine.deviation(&command, &errors).tip_mm - wanted;
            // Second order: 0.4 mm of compensation times slopes of 1e-3.
            prop_assert!(off.dot(&direction).abs() < 4e-4, "{} mm at {}", off.dot(&direction), node.position);
        }
    }
}
