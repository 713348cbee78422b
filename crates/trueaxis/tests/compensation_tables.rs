//! Compensation tables: what is written is what is read, and what is added is what it should be.

use trueaxis::compensate::tables::content::Content;
use trueaxis::compensate::tables::control::{Control, File};
use trueaxis::compensate::tables::emulation::Emulation;
use trueaxis::compensate::tables::table::{Node, PER_UNIT, Table};
use trueaxis::compensate::tables::{Compiled, Order, TablesError, Target, compile};
use trueaxis::machine::Machine;
use trueaxis::machine::axis::Command;
use trueaxis::machine::errors::ErrorValues;
use trueaxis::machine::file::NoTables;

fn machine(axes: &str, errors: &str) -> Machine {
    let text = format!("[machine]\nname = \"m\"\n{axes}\n[tool]\nlength = \"100 mm\"\n{errors}");
    let (machine, problems) = Machine::check("m.toml", &text, &NoTables);
    machine.unwrap_or_else(|| panic!("{problems:?}"))
}

const THREE: &str = "chain = \"w b X Y Z t\"
[axis.X]\ntravel = [\"0 mm\", \"1000 mm\"]
[axis.Y]\ntravel = [\"-200 mm\", \"300 mm\"]
[axis.Z]\ntravel = [\"-400 mm\", \"0 mm\"]";

const TARGETS: [Target; 5] = [
    Target::Csv,
    Target::LinuxCnc { trims: false },
    Target::LinuxCnc { trims: true },
    Target::Sinumerik,
    Target::Heidenhain,
];

fn at(machine: &Machine, compiled: &Compiled, command: [f64; 6], side: f64) -> Command {
    let control = compiled.order.target.control();
    let content = control.read(machine, &compiled.files).unwrap();
    Emulation::new(machine, control.as_ref(), &content).added(&command, &[side; 6])
}

/// 10 µm/m: at X = 500 the machine is 5 µm too far, so −5 µm is added, by every control.
#[test]
fn law_ten_micrometres_per_metre_are_taken_back() {
    let errors = "[motion.X]\nEXX = { polynomial = [\"0 um\", \"10 um\"], scale = \"1000 mm\" }";
    let machine = machine(THREE, errors);
    for target in TARGETS {
        let compiled = compile(&machine, &Order::of(target)).unwrap();
        assert_eq!(compiled.tables.len(), 1, "{target:?}");
        assert_eq!(compiled.tables[0].table.nodes.len(), 2);
        for (x, um) in [(0.0, 0.0), (500.0, -5.0), (1000.0, -10.0), (1200.0, -10.0)] {
            let added = at(&machine, &compiled, [x, 50.0, -7.0, 0.0, 0.0, 0.0], 1.0);
            assert!((added[0] * 1e3 - um).abs() < 2e-4, "{target:?} {x}: {added:?}");
        }
        assert!(compiled.after.max_mm < 1e-6 && (compiled.before.max_mm - 0.010).abs() < 1e-9);
        assert!((compiled.wrong_sign.max_mm - 0.020).abs() < 1e-6);
    }
}

/// Both directions, and a travel on both sides of the reference position: FANUC's increments from point to point, which
/// `paper_incremental_pitch_data` reads by the manual.
#[test]
fn law_both_directions_are_taken_back_about_the_reference_position() {
    let errors = "[motion.Y]\nEYY = { polynomial = [\"0 um\", \"10 um\"], scale = \"1000 mm\", \
                  reversal = \"2 um\" }";
    let machine = machine(THREE, errors);
    let compiled = compile(&machine, &Order::of(Target::Fanuc)).unwrap();
    // Its points are even steps from the reference position, here 166.6666 mm; between two it adds one value.
    let places = [-166.6666, 0.0, 166.6666];
    for (y, side) in places.into_iter().flat_map(|y| [(y, 1.0), (y, -1.0)]) {
        let added = at(&machine, &compiled, [500.0, y, -7.0, 0.0, 0.0, 0.0], side);
        let by_hand_um = -(10.0 * y / 1000.0 + side);
        let off_um = added[1] * 1e3 - by_hand_um;
        assert!(off_um.abs() < 0.051, "{y} {side}: {added:?}, {by_hand_um} by hand");
    }
    // The lines themselves, in units of 0.1 µm: −1 µm at the reference position rising, 2 µm more falling. Five points,
    // the third is the reference position; from −200 mm, where the travel ends, to the second +1.0 to +0.667 µm, then
    // −1.667 µm twice, and from −2.667 to −4.0 µm at 300 mm.
    let text = |name: &str| {
        let file = compiled.files.iter().find(|f| f.name == name).unwrap();
        file.text.replace('\r', "")
    };
    let (parameters, pitch) = (text("PARAM.TXT"), text("PITCH.TXT"));
    for line in
        ["N01850Q1A2P-10", "N03620Q1A2P2", "N03622Q1A2P4", "N03624Q1A2P166.666600", "N03627Q1A2P20"]
    {
        assert!(parameters.lines().any(|l| l == line), "{line} in\n{parameters}");
    }
    for (number, grown) in [(1, -3), (2, -17), (3, -17), (4, -13)] {
        for from in [10_000, 13_000] {
            let line = format!("N{}Q0P{grown}", from + number);
            assert!(pitch.lines().any(|l| l == line), "{line} in\n{pitch}");
        }
    }
}

/// A table that stands too far in +X leaves the tool too short: the control adds a positive value.
#[test]
fn an_axis_that_carries_the_workpiece() {
    let axes = THREE.replace("w b X Y Z t", "w X' b Y Z t");
    let errors = "[motion.X]\nEXX = { polynomial = [\"0 um\", \"10 um\"], scale = \"1000 mm\" }";
    let machine = machine(&axes, errors);
    let compiled = compile(&machine, &Order::of(Target::Csv)).unwrap();
    let added = at(&machine, &compiled, [500.0, 0.0, 0.0, 0.0, 0.0, 0.0], 0.0);
    assert!((added[0] - 0.005).abs() < 1e-8, "{added:?}");
}

/// What a control writes: columns of actual positions or trims; Siemens' other sign.
#[test]
fn the_files_as_the_controls_want_them() {
    let errors = "[motion.X]\nEXX = { polynomial = [\"0 um\", \"10 um\"], scale = \"1000 mm\", \
                  reversal = \"2 um\" }";
    let machine = machine(THREE, errors);
    let text = |target, name: &str| {
        let compiled = compile(&machine, &Order::of(target)).unwrap();
        compiled.files.iter().find(|f| f.name == name).unwrap().text.clone()
    };
    // At X = 1000 the machine is at 1000.011 rising and 1000.009 falling.
    let actual = text(Target::LinuxCnc { trims: false }, "joint_0_X.comp");
    assert_eq!(actual, "0.000000 0.001000 -0.001000\n1000.000000 1000.011000 1000.009000\n");
    let trims = text(Target::LinuxCnc { trims: true }, "joint_0_X.comp");
    assert_eq!(trims, "0.000000 -0.001000 0.001000\n1000.000000 -0.011000 -0.009000\n");
    let ini = text(Target::LinuxCnc { trims: true }, "compensation.ini");
    assert!(ini.contains("[JOINT_0]\nCOMP_FILE = joint_0_X.comp\nCOMP_FILE_TYPE = 1\n"), "{ini}");
    let cross = text(Target::Sinumerik, "NC_CEC.INI");
    for line in [
        "$AN_CEC[0,1]=0.011000",
        "$AN_CEC_DIRECTION[0]=1",
        "$AN_CEC[1,1]=0.009000",
        "$AN_CEC_DIRECTION[1]=-1",
        "$AN_CEC_OUTPUT_AXIS[1]=(AX1)",
        "$AN_CEC_MAX[0]=1000.000000",
    ] {
        assert!(cross.lines().any(|l| l == line), "{line} in\n{cross}");
    }
}

/// Straightness, squareness and positioning of linear axes are functions of one axis each: cross tables
/// leave no more than the bound of each, and all that is left is what was rounded and interpolated.
#[test]
fn law_what_is_represented_is_gone() {
    let errors = "[location]\nEC0Y = \"30 urad\"\nEX0X = \"12 um\"\n
[motion.X]\nEXX = { polynomial = [\"1 um\", \"-20 um\", \"30 um\"], scale = \"1000 mm\" }
EYX = { polynomial = [\"0 um\", \"5 um\", \"9 um\"], scale = \"1000 mm\" }
[motion.Y]\nEZY = { polynomial = [\"2 um\", \"0 um\", \"7 um\"], scale = \"300 mm\" }";
    let machine = machine(THREE, errors);
    for target in [Target::Csv, Target::Sinumerik] {
        let order = Order { bound_mm: 0.2e-3, ..Order::of(target) };
        let compiled = compile(&machine, &order).unwrap();
        assert!(compiled.errors.iter().all(|e| e.represented), "{:?}", compiled.errors);
        let losses: f64 = compiled.tables.iter().map(|t| t.loss).sum();
        assert!(compiled.after.max_mm <= losses + 1e-6, "{:?}", compiled.after);
        assert!(compiled.after.max_mm < 0.05 * compiled.before.max_mm);
    }
    let order = Order::of(Target::LinuxCnc { trims: false });
    let compiled = compile(&machine, &order).unwrap();
    let cannot: Vec<String> =
        compiled.errors.iter().filter(|e| !e.represented).map(|e| e.error.to_string()).collect();
    assert_eq!(cannot, ["EYX", "EC0Y", "EZY"], "{:?}", compiled.errors);
    assert!(compiled.after.max_mm > 5e-3);
}

fn read(control: &dyn Control, machine: &Machine, files: &[File]) -> Content {
    control.read(machine, files).unwrap().sorted()
}

/// Every format: what is read is what was meant, to the last count; endless axes too.
#[test]
fn law_round_trips() {
    let axes = "chain = \"w C' b X Y Z t\"\n[axis.C]\ntravel = \"unlimited\"
[axis.X]\ntravel = [\"-500 mm\", \"500 mm\"]\n[axis.Y]\ntravel = [\"-300 mm\", \"300 mm\"]
[axis.Z]\ntravel = [\"0 mm\", \"600 mm\"]";
    let machine = machine(axes, "");
    let node = |at, up, down| Node { at, up, down };
    let table = |input, output, nodes: &[Node]| Table {
        input,
        output,
        modulo: false,
        nodes: nodes.to_vec(),
    };
    let (x, y) = (1, 2);
    let own = [
        table(0, 0, &[node(-90_000_000, 5, 5), node(0, -1, -1), node(90_000_000, 7, 7)]),
        table(x, x, &[node(-500_000_000, 1234, -99), node(0, 7, 8), node(500_000_000, -4321, 0)]),
        table(y, y, &[node(-300_000_000, 0, 0), node(300_000_000, -123_456, -123_456)]),
    ];
    let cross = [
        table(x, y, &[node(-500_000_000, 1, 1), node(500_000_000, -2, -2)]),
        table(y, x, &[node(-300_000_000, 10, -10), node(300_000_000, -20, 20)]),
    ];
    let around = Table {
        modulo: true,
        ..table(0, x, &[node(0, 4, 4), node(180_000_000, -9, -9), node(360_000_000, 4, 4)])
    };
    // A HEIDENHAIN table of an endless axis always repeats itself: tests/compensation_controls.rs.
    for target in TARGETS.into_iter().filter(|t| *t != Target::Heidenhain) {
        let control = target.control();
        let mut tables = own.to_vec();
        if control.has_cross_tables() {
            tables.extend(cross.iter().cloned().chain([around.clone()]));
        }
        let content = Content { tables, ..Content::default() }.sorted();
        let files = control.write(&machine, &content);
        assert_eq!(read(control.as_ref(), &machine, &files), content);
        // A spoiled file is refused by its name, not read as something else.
        for file in 0..files.len() {
            let mut spoiled = files.clone();
            spoiled[file].text = spoiled[file].text.replace(".", ",");
            let read = control.read(&machine, &spoiled);
            let name = &files[file].name;
            let untouched = spoiled[file].text == files[file].text || name.ends_with(".ini");
            assert!(untouched || read.is_err_and(|e| &e.file == name), "{name}");
        }
    }
}

#[test]
fn what_is_refused() {
    let steep = "[motion.X]\nEXX = { polynomial = [\"0 um\", \"1500 um\"], scale = \"1000 mm\" }";
    let error = compile(&machine(THREE, steep), &Order::of(Target::Csv)).unwrap_err();
    assert!(matches!(error, TablesError::TooLarge { .. }), "{error}");
    let free = THREE.replace("[axis.Z]\ntravel = [\"-400 mm\", \"0 mm\"]", "");
    let gentle = "[motion.X]\nEXX = { polynomial = [\"0 um\", \"10 um\"], scale = \"1000 mm\" }";
    let error = compile(&machine(&free, gentle), &Order::of(Target::LinuxCnc { trims: false }));
    assert!(matches!(error, Err(TablesError::UnknownTravel(_))), "{error:?}");
    // 0.9 mm·(x/m)² within 2 nm: pieces of 3 mm, 335 of them.
    let bow =
        "[motion.X]\nEXX = { polynomial = [\"0 um\", \"0 um\", \"900 um\"], scale = \"1000 mm\" }";
    let order = Order { bound_mm: 2e-6, ..Order::of(Target::LinuxCnc { trims: false }) };
    let error = compile(&machine(THREE, bow), &order).unwrap_err();
    assert!(matches!(error, TablesError::TooManyNodes { most: 256, .. }), "{error}");
    let order = Order { bound_mm: 1e-5, ..Order::of(Target::Sinumerik) };
    let error = compile(&machine(THREE, gentle), &order).unwrap_err();
    assert!(matches!(error, TablesError::Increment { .. }), "{error}");
}

#[test]
fn what_is_not_known_well_enough_stays_out() {
    let errors = "[motion.X]\nEXX = { polynomial = [\"0 um\", \"2 um\"], scale = \"1000 mm\", u = \"3 um\" }";
    let compiled = compile(&machine(THREE, errors), &Order::of(Target::Csv)).unwrap();
    assert!(compiled.tables.is_empty());
    assert!(compiled.left_out[0].reason.contains("uncertainty"), "{:?}", compiled.left_out);
}

fn by_name(mut files: Vec<File>) -> Vec<File> {
    files.sort_by(|a, b| a.name.cmp(&b.name));
    files
}

fn in_folder(folder: &str) -> Vec<File> {
    let entries = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap());
    let file = |e: std::fs::DirEntry| File {
        name: e.file_name().into_string().unwrap(),
        text: std::fs::read_to_string(e.path()).unwrap(),
    };
    by_name(entries.map(file).collect())
}

/// A whole LinuxCNC went through these very files (oracles/linuxcnc_comp.py): at every stop, reached from below or
/// from above, within a table and beyond its ends, it added what the emulation adds. It keeps what it added at its
/// last step, at most 0.1 µm before the stop; with slopes up to 50 µm/m that is 5 pm.
#[test]
fn oracle_linuxcnc_adds_what_the_emulation_adds() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/linuxcnc-comp");
    let text = std::fs::read_to_string(format!("{folder}/added.csv")).unwrap();
    let mut places = 0;
    for (name, letters, chain) in [
        ("mill-type-0", "XYZ", "w X' Y' b Z t"),
        ("mill-type-1", "XYZ", "w X' Y' b Z t"),
        ("xkas2525-type-0", "XYZAC", "w X' b Y Z C A t"),
    ] {
        let machine = machine(&format!("chain = \"{chain}\""), "");
        let files = in_folder(&format!("{folder}/{name}"));
        let control = Target::LinuxCnc { trims: name.ends_with('1') }.control();
        let content = read(control.as_ref(), &machine, &files);
        assert_eq!(
            by_name(control.write(&machine, &content)),
            files,
            "what LinuxCNC was given is what is written"
        );
        for row in text.lines().filter_map(|l| l.strip_prefix(name)?.strip_prefix(',')) {
            let [joint, way, position, added] = row.split(',').collect::<Vec<_>>()[..] else {
                panic!("{row}")
            };
            let letter = &letters[joint.parse().unwrap()..][..1];
            let is = |t: &&Table| machine.axes()[t.output].name.to_string() == letter;
            let table = content.tables.iter().find(is).unwrap();
            let position = position.parse::<f64>().unwrap() * PER_UNIT;
            let side = if way == "up" { 1.0 } else { -1.0 };
            let off =
                control.value(table, position, side) / PER_UNIT - added.parse::<f64>().unwrap();
            assert!(off.abs() < 5e-9, "{name} {row}: {off:e}");
            places += 1;
        }
    }
    assert_eq!(places, 960);
}

/// A whole LinuxCNC ran with these very pins and with those of the machine without errors (oracles/linuxcnc_kinematics.py):
/// its joints put the tip of the actual machine to the programmed point, and differ from the nominal ones by what the
/// emulation adds. Blocks and pins have six decimals; the part zero was set at zero angles.
#[test]
fn oracle_linuxcnc_kinematics_move_the_joints_as_the_emulation_does() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/linuxcnc-kinematics");
    let text = std::fs::read_to_string(format!("{folder}/joints.csv")).unwrap();
    let (mut places, mut worst) = (0, [0.0_f64; 3]);
    for (name, tilt) in [("xyzac", 'A'), ("xyzbc", 'B')] {
        let toml = std::fs::read_to_string(format!("{folder}/{name}.toml")).unwrap();
        let machine = Machine::check(name, &toml, &NoTables).0.unwrap();
        let target = Target::LinuxCnc { trims: false };
        let files = in_folder(&format!("{folder}/{name}"));
        let compiled = compile(&machine, &Order::of(target)).unwrap();
        assert_eq!(by_name(compiled.files), files, "what LinuxCNC was given is what is written");
        let control = target.control();
        let content = read(control.as_ref(), &machine, &files);
        let emulation = Emulation::new(&machine, control.as_ref(), &content);
        let axis = |l: char| machine.axes().iter().position(|a| a.name.letter() == l).unwrap();
        let [x, y, z, t, c] = ['X', 'Y', 'Z', tilt, 'C'].map(axis);
        for row in text.lines().filter_map(|l| l.strip_prefix(name)?.strip_prefix(',')) {
            let v: Vec<f64> = row.split(',').map(|n| n.parse().unwrap()).collect();
            let command = |joints: &[f64]| {
                let mut command = Command::default();
                (command[t], command[c]) = (v[3].to_radians(), v[4].to_radians());
                [x, y, z].iter().zip(joints).for_each(|(axis, q)| command[*axis] = *q);
                command
            };
            let (nominal, actual) = (command(&v[5..8]), command(&v[8..11]));
            let exact = machine.deviation(&nominal, &ErrorValues::default());
            let errors = machine.errors_at(&actual, &[0.0; 6]).unwrap();
            let there = machine.deviation(&actual, &errors);
            let tips = [exact.nominal_tip.vector(), there.nominal_tip.vector() + there.tip_mm];
            for (i, wanted) in v[..3].iter().enumerate() {
                worst[0] = worst[0].max((tips[0][i] - wanted).abs());
                worst[1] = worst[1].max((tips[1][i] - wanted).abs());
            }
            let added = emulation.added(&nominal, &[0.0; 6]);
            for axis in [x, y, z] {
                let off = added[axis] - (actual[axis] - nominal[axis]);
                worst[2] = worst[2].max(off.abs());
            }
            places += 1;
        }
    }
    assert!(places == 120 && worst.iter().all(|w| *w < 1e-9), "{places} {worst:?}");
}

/// Six errors of each rotary axis: LinuxCNC's pins hold the centres, tables of C and A their zeros, that of X what shifts A
/// along itself. What shifts C along itself belongs into the work offset; the tilts stay.
#[test]
fn law_pins_hold_centres_and_no_tilts() {
    let axes = "chain = \"w C' A' b X Y Z t\"\n[axis.C]\ntravel = \"unlimited\"
[axis.A]\ntravel = [\"-110 deg\", \"110 deg\"]\nplacement = \"0 20 -30 mm\"
[axis.X]\ntravel = [\"-200 mm\", \"200 mm\"]\n[axis.Y]\ntravel = [\"-200 mm\", \"200 mm\"]
[axis.Z]\ntravel = [\"-50 mm\", \"250 mm\"]";
    let mut errors = "[location]\n".to_owned();
    for (axis, component) in ["C", "A"].iter().flat_map(|a| "XYZABC".chars().map(move |c| (a, c))) {
        let value = if "XYZ".contains(component) { "20 um" } else { "50 urad" };
        errors += &format!("E{component}0{axis} = \"{value}\"\n");
    }
    let machine = machine(axes, &errors);
    let compiled = compile(&machine, &Order::of(Target::LinuxCnc { trims: true })).unwrap();
    let mut cannot: Vec<String> = Vec::new();
    for loss in compiled.errors.iter().filter(|e| !e.represented) {
        let place = if loss.error.to_string() == "EZ0C" { "work offset" } else { "NC program" };
        assert!(loss.instead.contains(place), "{loss:?}");
        cannot.push(loss.error.to_string());
    }
    cannot.sort();
    assert_eq!(cannot, ["EA0C", "EB0A", "EB0C", "EC0A", "EZ0C"], "{:?}", compiled.errors);
    let outputs: Vec<usize> = compiled.tables.iter().map(|t| t.table.output).collect();
    assert!([0, 1, 2].iter().all(|axis| outputs.contains(axis)), "C, A and X: {outputs:?}");
}
