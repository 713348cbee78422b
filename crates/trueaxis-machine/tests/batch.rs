//! The batch against the scalar path, judged by the greatest difference over 10⁵ poses.

mod library;

use library::{FIVE_AXIS, Random, command_within_travel, machine, machine_of};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, AxisKind, Command};
use trueaxis_machine::batch::{
    BatchError, Commands, CompiledMachine, DeviationTable, InstructionSet,
};
use trueaxis_machine::chain::CommandFault;
use trueaxis_machine::file::Tables;

const POSES: usize = 100_003;

/// Commands and approaches, one row per pose.
struct Poses {
    commands: Vec<Command>,
    approaches: Vec<Approach>,
}

/// The same in columns.
struct Columns {
    positions: Vec<Vec<f64>>,
    approaches: Vec<Vec<f64>>,
}

impl Poses {
    fn within_travel(machine: &Machine, count: usize) -> Self {
        Self::new(count, |unit| command_within_travel(machine, unit))
    }

    fn new(count: usize, command: impl Fn([f64; 6]) -> Command) -> Self {
        let mut random = Random(7);
        let mut six = || std::array::from_fn(|_| random.unit());
        let commands = (0..count).map(|_| command(six())).collect();
        let side = |t: f64| (3.0 * t).floor() - 1.0;
        let approaches = (0..count).map(|_| six().map(side)).collect();
        Self { commands, approaches }
    }

    fn columns(&self, machine: &Machine) -> Columns {
        let column = |rows: &[[f64; 6]], k: usize| rows.iter().map(|row| row[k]).collect();
        let axes = 0..machine.axes().len();
        Columns {
            positions: axes.clone().map(|k| column(&self.commands, k)).collect(),
            approaches: axes.map(|k| column(&self.approaches, k)).collect(),
        }
    }
}

fn slices(columns: &[Vec<f64>]) -> Vec<&[f64]> {
    columns.iter().map(Vec::as_slice).collect()
}

/// All twelve numbers of a pose as bits.
fn bits(table: &DeviationTable, i: usize) -> [u64; 12] {
    let d = table.at(i);
    let vectors = [d.nominal_tip.vector(), d.nominal_axis.vector(), d.tip_mm, d.axis];
    std::array::from_fn(|k| vectors[k / 3][k % 3].to_bits())
}

fn sets() -> impl Iterator<Item = InstructionSet> {
    InstructionSet::ALL.into_iter().filter(|set| set.is_available())
}

/// Every instruction set gives what [`Machine::deviation`] gives: to 1e-9 mm on nominal tips, to
/// 1e-12 mm and 1e-15 on deviations.
fn agrees(what: &str, machine: &Machine, poses: &Poses) {
    let compiled = CompiledMachine::new(machine);
    let columns = poses.columns(machine);
    let (positions, approaches) = (slices(&columns.positions), slices(&columns.approaches));
    let batch = Commands::new(&positions).approached(&approaches);
    let scalar: Vec<_> = poses
        .commands
        .iter()
        .zip(&poses.approaches)
        .map(|(command, approach)| {
            let errors = machine.errors_at(command, approach).expect("inside the tables");
            machine.deviation(command, &errors)
        })
        .collect();
    for set in sets() {
        let mut table = DeviationTable::zeros(poses.commands.len());
        compiled.deviations_by(set, &batch, &mut table.columns()).expect("a batch");
        let mut worst = [0.0_f64; 4];
        for (i, expected) in scalar.iter().enumerate() {
            let found = table.at(i);
            let differences = [
                found.nominal_tip - expected.nominal_tip,
                found.nominal_axis.vector() - expected.nominal_axis.vector(),
                found.tip_mm - expected.tip_mm,
                found.axis - expected.axis,
            ];
            for (worst, difference) in worst.iter_mut().zip(differences) {
                assert!(difference.iter().all(|d| d.is_finite()), "{what}, {set:?}, pose {i}");
                *worst = worst.max(difference.amax());
            }
        }
        for (worst, allowed) in worst.into_iter().zip([1e-9, 2e-15, 1e-12, 1e-15]) {
            assert!(worst <= allowed, "{what}, {set:?}: {worst:e} > {allowed:e}");
        }
    }
}

/// In-memory tables: `even.csv`, `uneven.csv`, `sides.csv` and so on, for the axis letter before `-`.
struct Memory;

impl Tables for Memory {
    fn text(&self, name: &str) -> Result<String, String> {
        let (axis, kind) = name.split_once('-').ok_or("no axis")?;
        let is_rotary = "ABC".contains(axis);
        let (unit, half) = if is_rotary { ("deg", 180.0) } else { ("mm", 400.0) };
        let (side_heads, rows) = match kind {
            "even" => (vec![""], 41),
            "coarse" | "closed" => (vec![""], 9),
            "uneven" => (vec![""], 23),
            "sides" => (vec!["_up", "_down"], 17),
            _ => return Err("no such table".into()),
        };
        let heads = ["EX", "EY", "EZ", "EA", "EB", "EC"];
        let mut text = format!("position_{unit}");
        for (k, head) in heads.iter().enumerate() {
            let unit = if k < 3 { "um" } else { "urad" };
            for side in &side_heads {
                text += &format!(",{head}{axis}{side}_{unit}");
            }
        }
        text.push('\n');
        for row in 0..rows {
            let mut t = 2.0 * f64::from(row) / f64::from(rows - 1) - 1.0;
            if kind == "uneven" {
                t *= t.abs();
            }
            text += &format!("{}", half * t);
            for k in 0..heads.len() * side_heads.len() {
                let turns = if kind == "closed" { std::f64::consts::PI } else { 5.0 };
                text += &format!(",{:.3}", 40.0 * (turns * t + 1.7 * k as f64).sin());
            }
            text.push('\n');
        }
        Ok(text)
    }
}

/// Error motions of every shape on a table-table machine with everything misplaced.
fn everything(head: &str) -> Machine {
    let mut text = format!("[machine]\nname = \"all\"\nsource = \"invented\"\n{head}\n");
    text += "[location]\n";
    let bodies: Vec<char> = "wXYZACt".chars().collect();
    for (i, body) in bodies.iter().enumerate() {
        for (k, direction) in "XYZABC".chars().enumerate() {
            let unit = if k < 3 { "um" } else { "urad" };
            text +=
                &format!("E{direction}0{body} = \"{} {unit}\"\n", 37 - 9 * i as i32 + 4 * k as i32);
        }
    }
    text += r#"
        [motion.X]
        table = "X-even"
        outside = "clamp"
        [motion.Y]
        table = "Y-uneven"
        outside = "extend"
        [motion.Z]
        table = "Z-sides"
        interpolation = "linear"
        outside = "clamp"
        [motion.A]
        EXA = { table = "A-even", outside = "clamp" }
        EYA = { table = "A-coarse", interpolation = "linear", outside = "extend" }
        EZA = { fourier = { mean = "4 um", terms = [[1, "7 um", "-9 um"], [8, "2 um", "1 um"]] } }
        EAA = { table = "A-uneven", interpolation = "linear", outside = "clamp" }
        EBA = { polynomial = ["3 urad", "-8 urad", "5 urad", "2 urad"], scale = "90 deg" }
        ECA = { fourier = { mean = "-2 urad", terms = [[2, "9 urad", "4 urad"]] }, reversal = "6 urad" }
        [motion.C]
        EXC = { polynomial = ["0 um", "9 um", "-5 um", "3 um", "-2 um", "1 um"], scale = "120 deg" }
        EYC = { table = "C-sides", outside = "clamp" }
        EZC = "11 um"
        EAC = { table = "C-closed", interpolation = "periodic", outside = "clamp" }
        EBC = { polynomial = ["0 urad", "9 urad", "-5 urad"], origin = "30 deg", scale = "-60 deg" }
        ECC = "-21 urad"
    "#;
    let (machine, problems) = Machine::check("all.toml", &text, &Memory);
    let list: Vec<String> = problems.iter().map(ToString::to_string).collect();
    machine.unwrap_or_else(|| panic!("{}", list.join("\n")))
}

const TABLE_TABLE: &str = r#"
    chain = "w C' A' b X Y Z t"
    error_frame = "moving"
    [axis.A]
    placement = ["shift 10 -20 300 mm", "turn Z 20 deg"]
    [axis.C]
    error_frame = "fixed"
    placement = "0 5 70 mm"
    [axis.Z]
    direction = "0.1 0 1"
    [workpiece]
    placement = "3 4 50 mm"
    mounting = ["shift 10 20 30 mm", "turn X 15 deg", "turn Y -40 deg"]
    [tool]
    placement = ["shift 0 0 -90 mm", "turn Y 30 deg"]
    tip = "5 6 -120 mm"
"#;

const MIXED: &str = r#"
    chain = "w X' C' b Y Z A t"
    [axis.A]
    direction = "1 0.3 0.2"
    placement = "0 0 -300 mm"
    [axis.Y]
    direction = "0 -1 0"
    placement = ["shift 700 -200 900 mm", "turn X 3 deg"]
    [axis.C]
    error_frame = "moving"
    [tool]
    length = "150 mm"
"#;

/// Half as far again as the tables go.
fn beyond(machine: &Machine, unit: [f64; 6]) -> Command {
    let mut command = Command::default();
    for ((slot, axis), t) in command.iter_mut().zip(machine.axes()).zip(unit) {
        let half = if axis.kind == AxisKind::Linear { 600.0 } else { 5.0 };
        *slot = half * (2.0 * t - 1.0);
    }
    command
}

#[test]
fn law_batch_is_the_scalar_path_on_every_shipped_machine() {
    for name in FIVE_AXIS.into_iter().chain(["three-axis-mill"]) {
        let machine = machine(name);
        assert!(CompiledMachine::new(&machine).is_fast(), "{name}");
        agrees(name, &machine, &Poses::within_travel(&machine, POSES));
    }
}

#[test]
fn law_batch_is_the_scalar_path_with_errors_of_every_shape() {
    for head in [TABLE_TABLE, MIXED] {
        let machine = everything(head);
        assert!(CompiledMachine::new(&machine).is_fast());
        agrees(head, &machine, &Poses::new(POSES, |unit| beyond(&machine, unit)));
    }
}

#[test]
fn law_batch_is_the_scalar_path_where_it_takes_it() {
    let far = |unit: [f64; 6]| unit.map(|t| 3e4 * (t - 0.5));
    agrees("1e4 rad", &machine("nutating-head"), &Poses::new(1000, far));
    let engraver = machine("i5-engraver");
    let turned = |unit: [f64; 6]| {
        let mut command = command_within_travel(&engraver, unit);
        command[0] = 1.9e4 * (unit[0] - 0.5);
        command
    };
    agrees("1500 turns", &engraver, &Poses::new(1000, turned));
    for (word, other) in [("rotation", "small-angle"), ("squareness", "direction")] {
        let line = format!("[machine]\n{word} = \"{other}\"");
        let machine = machine_of("i5-engraver", |text| text.replace("[machine]", &line));
        assert!(!CompiledMachine::new(&machine).is_fast());
        agrees(other, &machine, &Poses::within_travel(&machine, 1000));
    }
    // 20 mrad: more than the series of the kernel allow.
    let accepted = "[plausible]\nangle_error_urad = 50_000\n";
    let large = |text: String| text.replace("6 urad", "20000 urad") + accepted;
    let large = machine_of("i5-engraver", large);
    agrees("large angles", &large, &Poses::within_travel(&large, 1000));
}

#[test]
fn law_a_pose_depends_on_its_own_command_only() {
    let machine = everything(TABLE_TABLE);
    let compiled = CompiledMachine::new(&machine);
    let poses = Poses::new(40_000, |unit| beyond(&machine, unit));
    let columns = poses.columns(&machine);
    let positions = slices(&columns.positions);
    let mut all = DeviationTable::zeros(40_000);
    compiled.deviations(&Commands::new(&positions), &mut all.columns()).unwrap();
    for length in (0..40).chain([63, 64, 65, 129]) {
        let some: Vec<&[f64]> = positions.iter().map(|c| &c[100..100 + length]).collect();
        let mut table = DeviationTable::zeros(length);
        compiled.deviations(&Commands::new(&some), &mut table.columns()).unwrap();
        assert!((0..length).all(|i| bits(&table, i) == bits(&all, 100 + i)), "{length} poses");
    }
    for threads in [1, 2, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let mut table = DeviationTable::zeros(40_000);
        let commands = Commands::new(&positions);
        pool.install(|| compiled.deviations_parallel(&commands, &mut table.columns())).unwrap();
        assert!((0..40_000).all(|i| bits(&table, i) == bits(&all, i)), "{threads} threads");
    }
}

#[test]
fn an_approach_between_the_sides_is_taken_as_it_is() {
    let machine = everything(MIXED);
    let mut poses = Poses::new(1000, |unit| beyond(&machine, unit));
    for approach in poses.approaches.iter_mut().step_by(7) {
        *approach = approach.map(|side| 0.3 * side);
    }
    agrees("part of a side", &machine, &poses);
}

#[test]
fn the_first_pose_outside_a_table_is_named() {
    let machine = machine("xkas2525");
    let compiled = CompiledMachine::new(&machine);
    let mut columns = Poses::within_travel(&machine, 40_000).columns(&machine);
    columns.positions[1][30_001] = 2501.0;
    columns.positions[0][30_002] = f64::NAN;
    let run = |columns: &Columns, set: Option<InstructionSet>| {
        let positions = slices(&columns.positions);
        let mut table = DeviationTable::zeros(40_000);
        let commands = Commands::new(&positions);
        match set {
            Some(set) => compiled.deviations_by(set, &commands, &mut table.columns()),
            None => compiled.deviations_parallel(&commands, &mut table.columns()),
        }
    };
    for set in sets().map(Some).chain([None]) {
        let error = run(&columns, set).unwrap_err();
        assert_eq!(error.index(), Some(30_001));
        let BatchError::Refused { source, .. } = error else { panic!("{error}") };
        let CommandFault::TableLeft { name, .. } = source else { panic!("{source}") };
        assert_eq!(name.to_string(), "EXY");
    }
    columns.positions[1][30_001] = 0.0;
    for set in sets().map(Some).chain([None]) {
        assert_eq!(run(&columns, set), Err(BatchError::NotFinite { index: 30_002 }));
    }
}

#[test]
fn columns_that_do_not_fit_are_refused() {
    let machine = machine("three-axis-mill");
    let compiled = CompiledMachine::new(&machine);
    let (three, two) = ([0.0; 3], [0.0; 2]);
    let mut table = DeviationTable::zeros(3);
    let mut run = |commands: Commands<'_>| compiled.deviations(&commands, &mut table.columns());
    let columns = |found| Err(BatchError::Columns { expected: 3, found });
    assert_eq!(run(Commands::new(&[&three, &three])), columns(2));
    assert_eq!(run(Commands::new(&[three.as_slice(); 9])), columns(9));
    let good = Commands::new(&[&three, &three, &three]);
    assert_eq!(run(good.approached(&[&three])), columns(1));
    let lengths = Err(BatchError::Lengths { expected: 3, found: 2 });
    assert_eq!(run(Commands::new(&[&three, &two, &three])), lengths);
    assert_eq!(run(good.approached(&[&[], &two, &[]])), lengths);
    assert_eq!(run(good.approached(&[&[], &three, &[]])), Ok(()));
    let lengths = Err(BatchError::Lengths { expected: 2, found: 3 });
    assert_eq!(run(Commands::new(&[&two, &two, &two])), lengths);
}
