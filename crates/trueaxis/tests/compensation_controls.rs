//! Compensation by more than tables: chains that know errors, grids, kinematic parameters, temperatures.

mod library;

use trueaxis::compensate::tables::content::Content;
use trueaxis::compensate::tables::control::File;
use trueaxis::compensate::tables::emulation::Emulation;
use trueaxis::compensate::tables::{Compiled, Order, Target, compile};
use trueaxis::input::Diagnostics;
use trueaxis::machine::Machine;
use trueaxis::machine::file::NoTables;
use trueaxis::machine::heat::Conditions;

fn machine(text: &str) -> Machine {
    let (machine, problems) = Machine::check("m.toml", text, &NoTables);
    machine.unwrap_or_else(|| panic!("{problems:?}"))
}

const TRAVEL: &str = "[axis.X]\ntravel = [\"-400 mm\", \"600 mm\"]
[axis.Y]\ntravel = [\"-300 mm\", \"300 mm\"]
[axis.Z]\ntravel = [\"-350 mm\", \"50 mm\"]";

/// Five axes as they stand in workshops: head, table, one each.
const FIVE: [(&str, &str); 3] = [
    (
        "w b X Y Z C A t",
        "[axis.C]\ntravel = [\"-200 deg\", \"200 deg\"]\nplacement = \"0 0 80 mm\"",
    ),
    ("w C' A' b X Y Z t", "[axis.C]\ntravel = \"unlimited\"\nplacement = \"5 0 40 mm\""),
    ("w C' X' b Y Z A t", "[axis.C]\ntravel = \"unlimited\"\nplacement = \"100 20 0 mm\""),
];

/// Every error of every axis, smooth and of a size that workshops know.
fn all_errors(letters: &str) -> String {
    let mut text = String::new();
    for (n, axis) in letters.chars().enumerate() {
        let linear = "XYZ".contains(axis);
        text += &format!("[motion.{axis}]\n");
        for (m, kind) in "XYZABC".chars().enumerate() {
            let unit = if m < 3 { "um" } else { "urad" };
            let size = 3.0 + ((7 * n + 5 * m) % 11) as f64;
            let curve = match linear {
                true => format!(
                    "{{ polynomial = [\"1 {unit}\", \"{size} {unit}\", \"{} {unit}\"], scale = \"500 mm\" }}",
                    -0.7 * size
                ),
                false => format!(
                    "{{ fourier = {{ mean = \"1 {unit}\", terms = [[1, \"{size} {unit}\", \"-2 {unit}\"]] }} }}"
                ),
            };
            text += &format!("E{kind}{axis} = {curve}\n");
        }
    }
    text + &locations(letters, 5.0)
}

fn locations(letters: &str, size: f64) -> String {
    let mut text = "[location]\n".to_owned();
    for (n, axis) in letters.chars().enumerate() {
        for (m, kind) in "XYZABC".chars().enumerate() {
            let unit = if m < 3 { "um" } else { "urad" };
            let value =
                size * (1.0 + ((3 * n + 4 * m) % 7) as f64) * if m % 2 == 0 { 1.0 } else { -1.0 };
            text += &format!("E{kind}0{axis} = \"{value} {unit}\"\n");
        }
    }
    text
}

fn five(n: usize, errors: &str) -> Machine {
    let (chain, c) = FIVE[n];
    machine(&format!(
        "[machine]\nname = \"m\"\nchain = \"{chain}\"\n{TRAVEL}\n{c}\n[axis.A]\ntravel = [\"-100 deg\", \"100 deg\"]\n\
         placement = \"0 10 -30 mm\"\n[tool]\nplacement = \"0 0 -90 mm\"\nlength = \"120 mm\"\n{errors}"
    ))
}

fn fine(target: Target) -> Order {
    Order { bound_mm: 0.2e-3, bound_rad: 2e-6, ..Order::of(target) }
}

fn lost(compiled: &Compiled) -> f64 {
    let of_tables =
        compiled.tables.iter().map(|t| t.loss * if t.loss < 1e-5 { 400.0 } else { 1.0 });
    let of_links = compiled.known.len() as f64 * compiled.order.bound_mm;
    of_tables.sum::<f64>() + of_links + compiled.grid.as_ref().map_or(0.0, |g| 2e-6 * g.loss)
}

/// A control whose chain knows all links leaves nothing of the tip but what is interpolated and rounded, on every kind of
/// machine and whichever side of the joint its errors stand.
#[test]
fn law_a_chain_that_knows_its_links_brings_the_tip_back() {
    for n in 0..FIVE.len() {
        let machine = five(n, &all_errors("XYZCA"));
        for target in [Target::Isg, Target::Heidenhain] {
            let compiled = compile(&machine, &fine(target)).unwrap();
            let (before, after) = (compiled.before.max_mm, compiled.after.max_mm);
            assert!(before > 0.05, "{before}");
            assert!(after < lost(&compiled), "{n} {target:?}: {after} of {before}");
            assert!(after < 0.05 * before, "{n} {target:?}: {after} of {before}");
            let not: Vec<_> = compiled.errors.iter().filter(|e| !e.represented).collect();
            assert!(not.is_empty(), "{n} {target:?}: {not:?}");
        }
    }
}

/// Where only the places and directions of the rotary axes are wrong, kinematic parameters are enough; vectors that
/// close are not, and stay out where tables alone leave less.
#[test]
fn law_points_and_directions_of_the_rotary_axes_are_enough() {
    for n in 0..FIVE.len() {
        let machine = five(n, &locations("CA", 6.0));
        let [csv, without] = [true, false].map(|kinematics| {
            compile(&machine, &Order { kinematics, ..fine(Target::Csv) }).unwrap()
        });
        let (before, after) = (csv.before.max_mm, csv.after.max_mm);
        assert!(csv.joints.is_some() && before > 0.03);
        // Zeros of the axes are taken back by their own tables, in whole increments of 0.0001 deg.
        assert!(after < 1.5e-3, "{n}: {after} of {before}");
        let tables = without.after.max_mm;
        assert!(without.joints.is_none() && tables > 2.0 * after, "{n}: {tables}");
        let [vectors, without] = [true, false].map(|kinematics| {
            compile(&machine, &Order { kinematics, ..fine(Target::Sinumerik) }).unwrap()
        });
        let [left, tables] = [&vectors, &without].map(|c| c.after_zero_set.rms_mm);
        assert!(left <= tables, "{n}: {left} {tables}");
        let told = vectors.left_out.iter().any(|l| l.reason.contains("tables alone leave less"));
        assert_eq!(told, vectors.joints.is_none(), "{n}");
    }
}

/// Of a machine with three axes a grid knows everything.
#[test]
fn law_a_grid_knows_three_linear_axes() {
    let text = format!(
        "[machine]\nname = \"m\"\nchain = \"w X' b Y Z t\"\n{TRAVEL}\n[tool]\nlength = \"120 mm\"\n{}",
        all_errors("XYZ")
    );
    let machine = machine(&text);
    let order = Order { bound_mm: 2e-3, ..Order::of(Target::Fanuc) };
    let compiled = compile(&machine, &order).unwrap();
    assert!(compiled.before.max_mm > 0.05 && compiled.grid.is_some());
    // Of each axis: half a step of the pitch table, and the grid.
    assert!(compiled.after.max_mm < 3.0_f64.sqrt() * 4e-3, "{:?}", compiled.after);
    assert!(compiled.after.rms_mm < 0.04 * compiled.before.rms_mm, "{:?}", compiled.after);
}

/// A spoiled file is refused by its name, whatever it is.
#[test]
fn law_spoiled_files_are_refused() {
    for n in 0..FIVE.len() {
        let machine = five(n, &all_errors("XYZCA"));
        // A grid takes its time, and one machine is enough for its file; in the short test each control has one machine.
        let some = [
            &[Target::Isg, Target::Csv][..],
            &[Target::Fanuc, Target::Heidenhain],
            &[Target::Sinumerik],
        ];
        let all = [Target::Isg, Target::Heidenhain, Target::Sinumerik, Target::Csv];
        let targets = library::runs(all.len(), 0);
        for target in all[..targets].iter().chain(some[n]).copied() {
            let order = Order { bound_mm: 4e-3, bound_rad: 2e-5, ..Order::of(target) };
            let compiled = compile(&machine, &order).unwrap();
            let control = target.control();
            let meant = compiled.content().sorted();
            assert_eq!(control.read(&machine, &compiled.files).unwrap().sorted(), meant);
            for file in 0..compiled.files.len() {
                for spoil in [spoil_number, cut_short, without_last_line] {
                    let mut spoiled = compiled.files.clone();
                    spoiled[file].text = spoil(&spoiled[file]);
                    let read = control.read(&machine, &spoiled).map(Content::sorted);
                    let name = compiled.files[file].name.as_str();
                    // Notes for users are not read back.
                    let note = ["vol_comp_0.lis", "CONFIG.CMA", "COMPTAB.TXT"].contains(&name);
                    let unchanged = spoiled[file] == compiled.files[file];
                    match read {
                        // A missing value of PITCH.TXT is missed where PARAM.TXT asks for it.
                        Err(fault) => assert!(fault.file == name || name == "PARAM.TXT", "{fault}"),
                        Ok(read) => assert_eq!(read == meant, note || unchanged, "{name}"),
                    }
                }
            }
        }
    }
}

/// No file of any control makes its reader panic or hang: written ones with pieces cut out, doubled and exchanged, with
/// numbers that are none, and any text under the names that it knows.
#[test]
fn law_readers_survive_any_text() {
    const ODD: [&str; 12] = [
        "nan",
        "-1e308",
        "99999999999999999999",
        "0",
        "-0.0",
        "\u{b5}",
        "[",
        "=",
        "\n\n",
        "N0A0P",
        "1.0000001",
        "]",
    ];
    let mut random = library::Random(7);
    let machine = five(1, &all_errors("XYZCA"));
    let text = format!(
        "[machine]\nname = \"m\"\nchain = \"w X' b Y Z t\"\n{TRAVEL}\n{}",
        all_errors("XYZ")
    );
    let three = self::machine(&text);
    for target in [Target::Isg, Target::Heidenhain, Target::Fanuc, Target::Sinumerik, Target::Csv] {
        // FANUC's grid of five axes takes its time.
        let machine = if target == Target::Fanuc { &three } else { &machine };
        let order = Order { bound_mm: 8e-3, bound_rad: 4e-5, ..Order::of(target) };
        let compiled = compile(machine, &order).unwrap();
        let control = target.control();
        for _ in 0..400 {
            let mut files = compiled.files.clone();
            let which = random.between(0.0, files.len() as f64) as usize;
            let text = &mut files[which].text;
            for _ in 0..1 + random.between(0.0, 4.0) as usize {
                let places: Vec<usize> = text.char_indices().map(|(i, _)| i).collect();
                let mut at =
                    || places.get(random.between(0.0, places.len() as f64) as usize).copied();
                let (a, b) = (at().unwrap_or(0), at().unwrap_or(0));
                let (a, b) = (a.min(b), a.max(b).min(a.min(b) + 60));
                let b = (a..=b).rev().find(|i| text.is_char_boundary(*i)).unwrap_or(a);
                match random.between(0.0, 3.0) as usize {
                    0 => text.replace_range(a..b, ""),
                    1 => text.replace_range(a..b, ODD[random.between(0.0, 12.0) as usize]),
                    _ => {
                        let piece = text[a..b].to_owned();
                        text.insert_str(a, &piece);
                    }
                }
            }
            // What is read, if anything, is a content whose values are numbers.
            if let Ok(content) = control.read(machine, &files) {
                let emulation = Emulation::new(machine, control.as_ref(), &content);
                let added = emulation.added(&[10.0, -20.0, 5.0, 0.2, -0.3, 0.0], &[1.0; 6]);
                assert!(added.iter().all(|c| c.is_finite()), "{target:?} {added:?}");
            }
        }
    }
}

/// The first number that is no note.
fn spoil_number(file: &File) -> String {
    let mut done = false;
    let spoiled = file.text.split_inclusive('\n').map(|line| {
        let note = line.starts_with(['#', ';', '/']) || done || !line.contains('0');
        done |= !note;
        if note { line.to_owned() } else { line.replacen('0', "x", 1) }
    });
    spoiled.collect()
}

fn cut_short(file: &File) -> String {
    file.text.chars().take(file.text.chars().count() / 2).collect()
}

fn without_last_line(file: &File) -> String {
    let lines: Vec<&str> = file.text.trim_end().split('\n').collect();
    lines[..lines.len() - 1].join("\n")
}

/// 2 ± 10 µrad of squareness are up to 2 µm of straightness over 1 m, and those are not known either: the uncertainty of a
/// link is that of all it is made of. 20 ± 10 µrad go in.
#[test]
fn squareness_that_is_not_known_well_enough_is_no_straightness() {
    for (stated, known) in [("2 ± 10 urad", 0), ("20 ± 10 urad", 2)] {
        let text = format!(
            "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n{TRAVEL}\n[location]\nEC0Y = \"{stated}\""
        );
        let compiled = compile(&machine(&text), &Order::of(Target::Isg)).unwrap();
        assert_eq!((compiled.known.len(), compiled.left_out.len()), (known, 2 - known), "{stated}");
    }
}

/// A centre that is not known better than it is off stays where it was.
#[test]
fn a_centre_that_is_not_known_well_enough_stays_nominal() {
    let errors = "[location]\nEX0C = \"3 ± 4 um\"\nEY0A = \"9 ± 2 um\"";
    let compiled = compile(&five(1, errors), &Order::of(Target::Csv)).unwrap();
    let [c, a] = compiled.joints.as_ref().map_or([None; 2], |j| [j.0.first(), j.0.get(1)]);
    let (c, a) = (c.unwrap(), a.unwrap());
    assert!(c.point[0] == 5_000_000 && a.point[1] == 10_009_000, "{c:?} {a:?}");
    let out = &compiled.left_out[0];
    assert!(format!("{:?}", out.what).contains("Error") && out.reason.contains("uncertainty"));
}

#[test]
fn an_axis_that_the_control_does_not_know_is_named() {
    let travel = TRAVEL.replace("axis.X", "axis.U");
    let machine = machine(&format!("[machine]\nname = \"m\"\nchain = \"w b U Y Z t\"\n{travel}"));
    let error = compile(&machine, &Order::of(Target::Isg)).unwrap_err();
    assert_eq!(error.to_string(), "isg knows no axis U");
    assert!(compile(&machine, &Order::of(Target::Csv)).is_ok());
}

/// FANUC B-63980EN/01 p. 100: data no. 33 to 49 of an axis with its reference position at no. 40. From the reference
/// position the compensation is the sum of what stands between: +2 at no. 41, 3 at 42; −(−1) before no. 40.
#[test]
fn paper_incremental_pitch_data() {
    let growth = [2, 1, 1, -2, 0, -1, 0, -1, 2, 1, 0, -1, -1, -2, 0, 1, 2];
    let mut pitch = "%\n".to_owned();
    for (i, g) in growth.iter().enumerate() {
        pitch += &format!("N{}Q0P{g}\n", 10_033 + i);
    }
    let parameters = "%\nN01850Q1A1P0\nN03605Q1A1P00000000\nN03620Q1A1P40\nN03621Q1A1P33\nN03622Q1A1P49\n\
                      N03623Q1A1P1\nN03624Q1A1P50.\n%\n";
    let machine = machine(&format!("[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n{TRAVEL}"));
    let files = [
        File { name: "PITCH.TXT".to_owned(), text: pitch + "%\n" },
        File { name: "PARAM.TXT".to_owned(), text: parameters.to_owned() },
    ];
    let control = Target::Fanuc.control();
    let content = control.read(&machine, &files).unwrap();
    let emulation = Emulation::new(&machine, control.as_ref(), &content);
    // In units of 0.1 µm; at the points themselves and, half way on, already the next.
    let at = |x: f64| emulation.added(&[x, 0.0, 0.0, 0.0, 0.0, 0.0], &[0.0; 6])[0] * 1e4;
    for (x, units) in
        [(0.0, 0.0), (50.0, 2.0), (100.0, 3.0), (200.0, 2.0), (-50.0, 1.0), (-350.0, 2.0)]
    {
        assert!((at(x) - units).abs() < 1e-9, "{x}: {}", at(x));
    }
    assert!((at(24.9) - 0.0).abs() < 1e-9 && (at(25.1) - 2.0).abs() < 1e-9);
}

/// Beckhoff TF5200, axis compensation, the example of a leadscrew list: the list holds actual − setpoint. An axis that
/// stands 10.2 units too low rising and 8.0 too high falling is written so, and gets the opposite added.
#[test]
fn paper_leadscrew_lists_hold_the_error() {
    let errors = "[motion.A]\nEAA = { polynomial = [\"-0.00011 deg\"], scale = \"1 deg\", reversal = \"-0.00182 deg\" }";
    let machine = five(0, errors);
    let compiled = compile(&machine, &Order::of(Target::Isg)).unwrap();
    let list = compiled.files.iter().find(|f| f.name == "achskw_A.lis").unwrap();
    assert!(list.text.contains("kw.ssfk.table[0].pos -10\n"), "{}", list.text);
    assert!(list.text.contains("kw.ssfk.table[0].neg 8\n"), "{}", list.text);
    let content = Target::Isg.control().read(&machine, &compiled.files).unwrap();
    let control = Target::Isg.control();
    let emulation = Emulation::new(&machine, control.as_ref(), &content);
    let added = emulation.added(&[0.0; 6], &[1.0; 6])[4].to_degrees();
    assert!((added - 0.0010).abs() < 1e-9, "{added}");
}

/// Zhang et al. 2019: the scale of X, 10.8 µm/(m·K), measured at 28.4 °C and used at 30.5 °C makes the axis go too far by
/// 22.68 µm/m, and the line takes that back. The tables stay those of 28.4 °C.
#[test]
fn paper_a_warm_scale_is_a_line() {
    let cold = library::machine("gantry-001");
    let mut problems = Diagnostics::new();
    let conditions = Conditions::typed("t", "scale_x=30.5 scale_y=29.3", &mut problems).unwrap();
    let warm = cold.at(&conditions, &mut problems).unwrap();
    let order = Order::of(Target::Sinumerik);
    let [at_first, now] = [&cold, &warm].map(|m| compile(m, &order).unwrap());
    let [line] = now.lines[..] else { panic!("{:?}", now.lines) };
    // Solved at the corrected command, so smaller by twice the slope of the error, 10⁻⁴.
    assert!(line.axis == 0 && (line.slope + 22_680).abs() < 7, "{line:?}");
    // At 3500 mm: 431 µm of the paper, less what the cold table has.
    let grown = line.at(3.5e9) * 1e-3;
    assert!((grown + 431.0 - 351.62).abs() < 0.1, "{grown}");
    assert!(at_first.lines.is_empty() && at_first.tables == now.tables);
    assert!(now.after.max_mm < at_first.after.max_mm + 2e-4);
    let data = now.files.iter().find(|f| f.name == "TEMP_COMP.SPF").unwrap();
    assert!(data.text.contains("$SA_TEMP_COMP_SLOPE[AX1]=0.0000226"), "{}", data.text);
}

/// TOOLCARRIER.SPF of a head closes: at zero angles the control adds nothing by it, and the residual error is that of the
/// text.
#[test]
fn vectors_of_a_head_are_taken_as_they_are_written() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../machines/xkas2525/machine.toml");
    let machine = trueaxis::files::machine(&path).0.unwrap();
    let compiled = compile(&machine, &Order::of(Target::Sinumerik)).unwrap();
    // docs/compensation-tables.md states these, rms and largest, µm.
    let expected = [(98.1, 205.1), (47.3, 102.2), (38.1, 71.7)];
    let found = [&compiled.before, &compiled.after, &compiled.after_zero_set];
    for (left, (rms, most)) in found.into_iter().zip(expected) {
        let [left_rms, left_most] = [left.rms_mm * 1e3, left.max_mm * 1e3];
        assert!((left_rms - rms).abs() < 0.06, "{left_rms} µm rms, stated {rms}");
        assert!((left_most - most).abs() < 0.06, "{left_most} µm, stated {most}");
    }
    let control = Target::Sinumerik.control();
    let content = control.read(&machine, &compiled.files).unwrap();
    let only = Content { joints: content.joints.clone(), ..Content::default() };
    let emulation = Emulation::new(&machine, control.as_ref(), &only);
    let zero = emulation.added(&[0.0; 6], &[0.0; 6]);
    assert!(content.joints.is_some() && zero.iter().all(|q| q.abs() < 1e-8), "{zero:?}");
    assert!(compiled.after.rms_mm > compiled.after_zero_set.rms_mm);
    assert!(compiled.after.rms_mm < 0.5 * compiled.before.rms_mm);
}
