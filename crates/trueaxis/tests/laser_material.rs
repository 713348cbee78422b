//! The virtual laser with its compensation of a material: Zhang et al. 2019, Fig 8 to 10.

mod library;

use std::fs;
use std::path::PathBuf;
use trueaxis::compensate::values::{Order, compensation_values};
use trueaxis::files::disk;
use trueaxis::input::Diagnostics;
use trueaxis::machine::Machine;
use trueaxis::machine::axis::{Approach, Command};
use trueaxis::measure::virtual_campaign::{Measurement, VirtualCampaign, measure, read_virtual};
use trueaxis::measure::{Campaign, read_campaign};
use trueaxis::nc::{Control, Program};
use trueaxis::plan::program::check;
use trueaxis::plan::{planned, read_plan};
use trueaxis::predict::holes::Compensation;
use trueaxis::predict::holes::Compensation::{
    Comprehensive, Machine as OfMachine, None as Nothing,
};
use trueaxis::simulate::{Batch, Observer, Options, SetUp, simulate};
use trueaxis::unknowns::fit::fit;
use trueaxis::verify::before_after::{Curve, before_after, read_before_after};

/// A folder of its own that goes when the test ends.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path =
            std::env::temp_dir().join(format!("trueaxis-laser-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).expect("a folder");
        Self(path)
    }

    fn put(&self, name: &str, text: &str) -> PathBuf {
        let path = self.0.join(name);
        fs::write(&path, text).expect("written");
        path
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// What a test varies.
#[derive(Clone)]
struct Asked {
    machine: String,
    temperature: String,
    laser: String,
    path: String,
    rest: String,
}

impl Asked {
    /// The gantry, X, at the temperatures of the paper, a laser without noise.
    fn of_gantry(axis: &str, to: f64) -> Self {
        let beam = ["X", "Y", "Z"].map(|letter| if letter == axis { "1" } else { "0" });
        Self {
            machine: library::machine_path("gantry-001").display().to_string(),
            temperature:
                "scale_x = \"30.5 degC\"\nscale_y = \"31.2 degC\"\nscale_z = \"29 degC\"\n\
                          workpiece = \"30.8 degC\""
                    .to_owned(),
            laser: format!("direction = \"{}\"\n{MATERIAL}", beam.join(" ")),
            path: format!(
                "axis = \"{axis}\"\nfrom = \"0 mm\"\nto = \"{to} mm\"\ncount = 11\nruns = 1"
            ),
            rest: "[disturb]\nnoise = 0".to_owned(),
        }
    }

    fn text(&self) -> String {
        let Self { machine, temperature, laser, path, rest } = self;
        format!(
            "name = \"c\"\nmachine = {machine:?}\n[temperature]\n{temperature}\n[instrument.laser]\n\
             kind = \"laser-line\"\nnoise = \"0.5 um\"\n{laser}\n[[path]]\nname = \"p\"\nkind = \"targets\"\n\
             {path}\n{rest}\n"
        )
    }

    fn read(&self, folder: &Folder) -> (Option<(Campaign, VirtualCampaign)>, Diagnostics) {
        let path = folder.put("campaign.toml", &self.text());
        read_campaign(&disk(), &path, |root, campaign| read_virtual(root, campaign, None))
    }

    #[track_caller]
    fn measured(&self, folder: &Folder) -> (Campaign, Measurement) {
        let (read, problems) = self.read(folder);
        let (campaign, real) = read.unwrap_or_else(|| panic!("{problems:?}"));
        let measurement = measure(&campaign, &real).unwrap_or_else(|e| panic!("{e}"));
        (campaign, measurement)
    }

    /// Command and deviation (mm) of every reading.
    fn deviations(&self, folder: &Folder) -> Vec<(Command, f64)> {
        let (campaign, found) = self.measured(folder);
        let r = &found.readings;
        let one = |i: usize| {
            let laser = &campaign.instruments[0];
            let nominal = laser.nominal_reading(&campaign.machine, &r.commands[i], r.directions[i]);
            (r.commands[i], r.values[i][0] - nominal[0])
        };
        (0..r.len()).map(one).collect()
    }

    fn curves(&self, folder: &Folder) -> Vec<Curve> {
        let path = folder.put("campaign.toml", &self.text());
        let (study, problems) = read_before_after(&disk(), &path, None);
        let study = study.unwrap_or_else(|| panic!("{problems:?}"));
        before_after(&study).unwrap_or_else(|e| panic!("{e}"))
    }
}

const MATERIAL: &str = "material_expansion = \"workpiece\"\nmaterial_temperature = \"workpiece\"";
const OUTSIDE: [(&str, usize, f64); 3] = [("X", 0, 3500.0), ("Y", 1, 2300.0), ("Z", 2, 800.0)];

/// The machine of a campaign at a command, as `compensate values` states it: machine and comprehensive error, mm.
fn by_values(machine: &Machine, axis: usize, command: &Command) -> [f64; 2] {
    let order = Order {
        axis,
        command: *command,
        positions: vec![command[axis]],
        increment: 1e-3,
        of: Compensation::Comprehensive,
    };
    let table = compensation_values(machine, &order).expect("inside the table");
    [table.nodes[0].machine, table.nodes[0].comprehensive]
}

/// The laser goes the whole way (poses, instruments, targets), `compensate values` the short one (errors of the
/// axis): both have the same error, with the material that of the part, without it that of the machine.
#[test]
fn law_a_laser_reads_what_the_values_compensate() {
    let folder = Folder::new("values");
    for (letter, axis, to) in OUTSIDE {
        let plain = Asked::of_gantry(letter, to);
        let (campaign, _) = plain.measured(&folder);
        let up = plain.clone();
        let down = Asked {
            path: format!(
                "axis = \"{letter}\"\nfrom = \"{to} mm\"\nto = \"0 mm\"\ncount = 7\nruns = 2"
            ),
            ..plain.clone()
        };
        let mut largest: f64 = 0.0;
        for (asked, sign) in [(up, 1.0), (down, -1.0)] {
            let alone = Asked { laser: asked.laser.replace(MATERIAL, ""), ..asked.clone() };
            for (command, read) in asked.deviations(&folder) {
                let whole = by_values(&campaign.machine, axis, &command)[1];
                largest = largest.max(whole.abs());
                assert!((sign * read - whole).abs() < 1e-9, "{letter} {command:?}: {read} {whole}");
            }
            for (command, read) in alone.deviations(&folder) {
                let machine = by_values(&campaign.machine, axis, &command)[0];
                assert!((sign * read - machine).abs() < 1e-9, "{letter}: {read} {machine}");
            }
        }
        assert!(largest > 0.02, "{letter}: nothing was compared");
    }
}

/// −54.1 = 431 − 13.2 · 3.5 · 10.5 and −86.9 = 253.1 − 13.2 · 2.3 · 11.2 µm (001-9); 54.6 and 88.9 are printed.
#[test]
fn paper_the_comprehensive_error_at_the_ends() {
    let folder = Folder::new("ends");
    for (letter, to, celsius, um) in [("X", 3500.0, 30.5, -54.1), ("Y", 2300.0, 31.2, -86.932)] {
        let mut asked = Asked::of_gantry(letter, to);
        asked.temperature = asked.temperature.replace("30.8", &celsius.to_string());
        for laser in [
            MATERIAL.to_owned(),
            format!("material_expansion = \"13.2 um/(m K)\"\nmaterial_temperature = \"{celsius} degC\""),
            "material_expansion = \"13.2 ± 0.3 um/(m K)\"\nmaterial_temperature = \"workpiece ± 0.1 degC\""
                .to_owned(),
        ] {
            let asked = Asked { laser: asked.laser.replace(MATERIAL, &laser), ..asked.clone() };
            let read = asked.deviations(&folder);
            let (_, last) = read.iter().find(|(c, _)| c[..2].contains(&to)).expect("the end");
            assert!((last * 1e3 - um).abs() < 1e-6, "{letter}: {last}");
        }
    }
}

/// The workpiece may be as warm as it likes: a laser that is not set to it does not see it, a touch probe on it does.
#[test]
fn law_light_does_not_see_the_workpiece() {
    let folder = Folder::new("light");
    let asked = Asked::of_gantry("X", 3500.0);
    let with = |celsius: &str, laser: &str| {
        let temperature = asked.temperature.replace("30.8", celsius);
        let laser = asked.laser.replace(MATERIAL, laser);
        Asked { temperature, laser, ..asked.clone() }.deviations(&folder)
    };
    assert_eq!(with("20", ""), with("40", ""));
    let (cold, warm) = (with("20", MATERIAL), with("40", MATERIAL));
    assert_eq!(cold, with("40", ""), "at 20 °C the material is as long as it is");
    // 13.2 · 3.5 · 20 = 924 µm.
    let grown = cold[10].1 - warm[10].1;
    assert!((grown - 0.924).abs() < 1e-12, "{grown}");
    // The datum only moves the zero: 13.2 · 0.5 · 20 = 132 µm at every target.
    let datum = with("40", &format!("{MATERIAL}\nmaterial_datum = \"500 0 0 mm\""));
    assert!(datum.iter().zip(&warm).all(|(a, b)| (a.1 - b.1 - 0.132).abs() < 1e-12));
}

/// A table that carries the workpiece: the sign is that of the tool against the workpiece.
#[test]
fn law_a_table_has_the_same_reading() {
    let folder = Folder::new("table");
    let text = |chain: &str, sign: &str| {
        format!(
            "[machine]\nname = \"m\"\nchain = \"{chain}\"\nsource = \"test\"\n[axis.X]\n\
             travel = [\"0 mm\", \"2000 mm\"]\n[workpiece]\nexpansion = \"12 um/(m K)\"\n[motion.X]\n\
             EXX = {{ polynomial = [\"0 um\", \"{sign}30 um\"], scale = \"1000 mm\" }}\n"
        )
    };
    let read = |chain: &str, sign: &str| {
        let machine = folder.put("machine.toml", &text(chain, sign)).display().to_string();
        let laser = format!("direction = \"1 0 0\"\n{MATERIAL}");
        let path =
            "axis = \"X\"\nfrom = \"0 mm\"\nto = \"2000 mm\"\ncount = 5\nruns = 1".to_owned();
        let temperature = "workpiece = \"25 degC\"".to_owned();
        let rest = "[disturb]\nnoise = 0".to_owned();
        Asked { machine, temperature, laser, path, rest }.deviations(&folder)
    };
    let (head, table) = (read("w b X Y Z t", ""), read("w X' b Y Z t", "-"));
    for (a, b) in head.iter().zip(&table) {
        assert!((a.1 - b.1).abs() < 1e-9, "{a:?} {b:?}");
    }
    // 30 · 2 − 12 · 2 · 5 = −60 µm
    assert!((head[4].1 + 0.06).abs() < 1e-6, "{}", head[4].1);
}

/// A laser follows its sensor while the hall warms up.
#[test]
fn a_sensor_is_followed_through_a_log() {
    let folder = Folder::new("log");
    folder.put(
        "hall.csv",
        "time_s,scale_x_degC,scale_y_degC,scale_z_degC,workpiece_degC\n0,28.4,29.3,20,20\n36000,28.4,29.3,20,30\n",
    );
    let mut asked = Asked::of_gantry("X", 3500.0);
    asked.rest = "[disturb]\nnoise = 0\ntemperature_log = \"hall.csv\"".to_owned();
    asked.path = format!("{}\ndwell = \"1000 s\"", asked.path);
    let (campaign, found) = asked.measured(&folder);
    let r = &found.readings;
    for i in 0..r.len() {
        let laser = &campaign.instruments[0];
        let nominal = laser.nominal_reading(&campaign.machine, &r.commands[i], r.directions[i])[0];
        let errors =
            campaign.machine.without_heat().errors_at(&r.commands[i], &Approach::default());
        let geometric =
            campaign.machine.deviation(&r.commands[i], &errors.expect("inside")).tip_mm.x;
        // 1 K an hour of workpiece, within the steps of the temperature.
        let growth = 13.2e-6 * r.commands[i][0] * r.times_s[i] / 3600.0;
        let off = r.values[i][0] - nominal - (geometric - growth);
        assert!(off.abs() < 13.2e-6 * 3500.0 * 50.0 / 3600.0, "{i}: {off}");
    }
    let grown = r.values[21][0] - r.values[0][0];
    assert!(r.times_s[21] > 20_000.0 && grown.abs() < 1e-3, "{grown}");
    folder.put(
        "hall.csv",
        "time_s,scale_x_degC,scale_y_degC,scale_z_degC\n0,28.4,29.3,20\n36000,28.4,29.3,20\n",
    );
    let (read, _) = asked.read(&folder);
    let (campaign, real) = read.expect("sound");
    let refused = measure(&campaign, &real).expect_err("no sensor").to_string();
    assert!(refused.contains("`workpiece`"), "{refused}");
}

const MILL: &str = "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\nsource = \"test\"\n[axis.X]\n\
    travel = [\"0 mm\", \"2000 mm\"]\n[workpiece]\nexpansion = \"12 um/(m K)\"\n[motion.X]\n\
    EXX = { polynomial = [\"0 um\", \"30 um\", \"8 um\"], scale = \"1000 mm\" }\n";

/// What identification finds of EXX P1 (half of the rise over the travel), µm, with u, from readings with a material.
fn identified(folder: &Folder, laser_read: &str, laser_known: &str) -> (f64, f64) {
    let machine = folder.put("machine.toml", MILL).display().to_string();
    let asked = |laser: &str| Asked {
        machine: machine.clone(),
        temperature: "workpiece = \"25 degC\"".to_owned(),
        laser: format!("direction = \"1 0 0\"\n{laser}"),
        path: "axis = \"X\"\nfrom = \"0 mm\"\nto = \"2000 mm\"\ncount = 11\nruns = 5".to_owned(),
        rest: "[unknown.motion]\nEXX = \"polynomial 1-2\"\n[disturb]\nnoise = 0".to_owned(),
    };
    let (_, measured) = asked(laser_read).measured(folder);
    let (campaign, _) = asked(laser_known).measured(folder);
    let design = campaign.design();
    let found = fit(&design, &measured.readings, &[]).expect("a fit");
    let k = design.names().iter().position(|n| n == "EXX P1").expect("named");
    (found.values[k] * 1e3, found.covariance[(k, k)].sqrt() * 1e3)
}

/// EXX = 30 t + 8 t² µm, t in m over 2 m: P1 = 30 + 16 = 46 µm (t = 1 + z: 30 z + 16 z + 8 z²).
/// The material subtracts 12 · 5 = 60 µm/m, over half of the travel 60 µm.
#[test]
fn law_identify_adds_what_the_laser_subtracts() {
    let folder = Folder::new("identify");
    let exact = "material_expansion = \"12 um/(m K)\"\nmaterial_temperature = \"25 degC\"";
    let plain = identified(&folder, "", "");
    let found = identified(&folder, exact, exact);
    assert!((plain.0 - 46.0).abs() < 1e-6 && (found.0 - 46.0).abs() < 1e-6, "{plain:?} {found:?}");
    assert!((plain.1 - found.1).abs() < 1e-9, "an exact material costs nothing");
    // Read with it, but not stated in the campaign: EXX is wrong by all of it.
    let unsaid = identified(&folder, exact, "");
    assert!((unsaid.0 - (46.0 - 60.0)).abs() < 1e-6, "{unsaid:?}");
    // u(κ)² = (5 · 0.3)² + (12 · 0.1)² of µm/m; over half of the travel as many µm.
    let uncertain =
        "material_expansion = \"12 ± 0.3 um/(m K)\"\nmaterial_temperature = \"25 ± 0.1 degC\"";
    let found = identified(&folder, uncertain, uncertain);
    let expected = plain.1.hypot(1.5f64.hypot(1.2));
    assert!((found.0 - 46.0).abs() < 1e-6, "{found:?}");
    assert!((found.1 - expected).abs() < 1e-6 * expected, "{found:?} {expected}");
    // A wrong sensor is as far off as it is wrong, which u covers.
    let wrong = "material_expansion = \"12 um/(m K)\"\nmaterial_temperature = \"25.1 degC\"";
    let found = identified(&folder, wrong, uncertain);
    assert!((found.0 - (46.0 - 1.2)).abs() < 1e-6, "{found:?}");
}

/// After compensation the laser reads the remainder of each value, whatever comes first, and with reversal too.
#[test]
fn law_after_compensation_the_remainders_remain() {
    let folder = Folder::new("after");
    let machine =
        MILL.replace("scale = \"1000 mm\" }", "scale = \"1000 mm\", reversal = \"7.2 um\" }");
    let machine = folder.put("machine.toml", &machine).display().to_string();
    for (increment, states) in
        [(1e-3, ""), (1e-2, "states = [\"comprehensive\", \"none\", \"machine\"]")]
    {
        let asked = Asked {
            machine: machine.clone(),
            temperature: "workpiece = \"25 degC\"".to_owned(),
            laser: format!("direction = \"1 0 0\"\n{MATERIAL}"),
            path: "axis = \"X\"\nfrom = \"0 mm\"\nto = \"2000 mm\"\ncount = 11\nruns = 2"
                .to_owned(),
            rest: format!(
                "[disturb]\nnoise = 0\n[compensation]\nincrement = \"{} um\"\n{states}",
                increment * 1e3
            ),
        };
        let (campaign, _) = asked.measured(&folder);
        let curves = asked.curves(&folder);
        assert_eq!(curves.len(), 3);
        for curve in &curves {
            for position in &curve.result.positions {
                let command = [position.target, 0.0, 0.0, 0.0, 0.0, 0.0];
                for (side, read) in [(1.0, position.up), (-1.0, position.down)] {
                    // By hand: half of the reversal on each side.
                    let machine = by_values(&campaign.machine, 0, &command)[0] + side * 3.6e-3;
                    let growth = 12e-6 * 5.0 * position.target;
                    let error = match curve.compensation {
                        Compensation::None => 0.0,
                        Compensation::Machine => machine,
                        Compensation::Comprehensive => machine - growth,
                    };
                    let added = (-error / increment).round() * increment;
                    let expected = machine - growth + added;
                    let read = read.expect("approached").mean;
                    assert!(
                        (read - expected).abs() < 2e-9,
                        "{:?} {read} {expected}",
                        curve.compensation
                    );
                    if curve.compensation == Compensation::Comprehensive {
                        assert!(read.abs() <= 0.5 * increment + 2e-9);
                    }
                }
            }
        }
    }
}

/// The tables of a control and the values agree within what the tables lose.
#[test]
fn law_tables_leave_what_the_values_leave() {
    let folder = Folder::new("tables");
    for (letter, _, to) in OUTSIDE {
        let mut asked = Asked::of_gantry(letter, to);
        asked.rest = format!("{}\n[compensation]\nincrement = \"0.001 um\"", asked.rest);
        let by_values = asked.curves(&folder);
        for control in ["csv", "linuxcnc", "sinumerik"] {
            let tables =
                Asked { rest: format!("{}\ntables = \"{control}\"", asked.rest), ..asked.clone() };
            for (a, b) in by_values.iter().zip(tables.curves(&folder)) {
                let off = (a.largest.deviation_mm - b.largest.deviation_mm).abs();
                assert!(off < 2e-3, "{letter} {control} {:?}: {off}", a.compensation);
                let left = b.largest.deviation_mm.abs();
                assert!(
                    b.compensation != Comprehensive || left < 2e-3,
                    "{letter} {control}: {left}"
                );
            }
        }
    }
}

/// The examples have the six curves of Fig 9 and 10: the machine before, after the composite one; the part before, after
/// the composite one (worse), after the comprehensive one.
#[test]
fn paper_the_curves_of_fig_9_and_10() {
    // Printed, µm: before, after; with the workpiece before, after the composite one, after the comprehensive one.
    let printed = [("x", [431.0, 16.2, 54.6, 484.4, 7.1]), ("y", [253.1, 13.3, 88.9, 349.1, 8.3])];
    for (axis, theirs) in printed {
        let path =
            library::root().join(format!("examples/07_verify/laser-before-after-{axis}.toml"));
        let (study, problems) = read_before_after(&disk(), &path, None);
        assert!(problems.iter().next().is_none(), "{problems:?}");
        let study = study.expect("sound");
        let curves = before_after(&study).unwrap_or_else(|e| panic!("{e}"));
        let um = |laser: usize, of: Compensation| {
            let curve = curves.iter().find(|c| c.instrument == laser && c.compensation == of);
            curve.expect("measured").largest.deviation_mm.abs() * 1e3
        };
        let ours = [
            um(0, Nothing),
            um(0, OfMachine),
            um(1, Nothing),
            um(1, OfMachine),
            um(1, Comprehensive),
        ];
        // What their composite model leaves of the machine in X.
        let left = 16.2;
        for (ours, theirs) in ours.iter().zip(theirs) {
            assert!((ours - theirs).abs() < left, "{axis}: {ours} {theirs}");
        }
        assert!(ours[3] > 3.0 * ours[2] && ours[4] < 0.3 * ours[2], "{axis}: {ours:?}");
    }
}

/// Where a program waits, and from which side it came there in X, Y, Z.
#[derive(Default)]
struct Waits {
    last: Option<Command>,
    side: [f64; 3],
    found: Vec<([f64; 3], [f64; 3])>,
}

impl Observer for Waits {
    fn path(&mut self, batch: &Batch<'_>) {
        for node in batch.nodes {
            let before = self.last.unwrap_or(node.command);
            for ((side, to), from) in self.side.iter_mut().zip(&node.command).zip(&before) {
                if (to - from).abs() > 1e-7 {
                    *side = (to - from).signum();
                }
            }
            self.last = Some(node.command);
            if node.dwell_s > 0.0 {
                assert!((node.dwell_s - 3.0).abs() < 1e-9);
                self.found.push(([node.command[0], node.command[1], node.command[2]], self.side));
            }
        }
    }
}

const CONTROLS: [Control; 5] =
    [Control::Sinumerik840d, Control::Fanuc, Control::Haas, Control::LinuxCnc, Control::Heidenhain];

/// Five times 11 targets forwards and 11 backwards, each from its own side: ISO 230-2, 4.3.2 and Fig 1.
#[test]
fn law_programs_stand_at_every_target() {
    let file = library::root().join("examples/04_plan/laser-gantry.toml");
    for control in CONTROLS {
        let (plan, problems) = read_plan(&disk(), &file);
        let report = planned(plan.unwrap_or_else(|| panic!("{problems:?}")), None, control);
        for (path, (axis, step)) in report.paths.iter().zip([(0, 348.0), (1, 228.0)]) {
            let sound = path.check.as_ref().unwrap_or_else(|e| panic!("{e}"));
            assert!(sound.is_sound(), "{control:?}: {sound:?}");
            let mut waits = Waits::default();
            let campaign = &report.plan.campaign;
            let program = Program::new("p", path.files[0].1.clone(), control);
            let setup = SetUp { given: true, ..SetUp::default() };
            let mut observers: Vec<&mut dyn Observer> = vec![&mut waits];
            simulate(&campaign.machine, &program, &setup, &Options::default(), &mut observers);
            assert_eq!(waits.found.len(), 110, "{control:?}");
            for (n, (place, side)) in waits.found.iter().enumerate() {
                let (up, k) = (n % 22 < 11, n % 11);
                let i = if up { k } else { 10 - k };
                assert!(
                    (place[axis] - (10.0 + step * i as f64)).abs() < 1e-3,
                    "{control:?} {n}: {place:?}"
                );
                assert_eq!(side[axis], if up { 1.0 } else { -1.0 }, "{control:?} stand {n}");
                assert!(place.iter().enumerate().all(|(j, q)| j == axis || q.abs() < 1e-9));
            }
        }
    }
}

/// Without room for an overrun the ends are named; a stand less, or elsewhere, is an error.
#[test]
fn a_program_that_does_not_stand_as_planned_is_found() {
    let file = library::root().join("examples/04_plan/laser-gantry.toml");
    let (plan, _) = read_plan(&disk(), &file);
    let plan = plan.expect("sound");
    let report = planned(plan.clone(), None, Control::Fanuc);
    let text = String::from_utf8(report.paths[0].files[0].1.clone()).expect("UTF-8");
    let judged = |text: &str| {
        let path = &plan.paths[0];
        check(&plan.campaign, path, &plan.program, text.as_bytes(), Control::Fanuc)
    };
    assert!(judged(&text).is_sound() && judged(&text).minor.iter().all(|m| !m.contains("side")));
    let less = text.replacen("G4 X3.\n", "", 1);
    assert!(
        judged(&less).errors.iter().any(|e| e.contains("stands 109 times")),
        "{:?}",
        judged(&less)
    );
    let elsewhere = text.replacen("G1 X706.", "G1 X707.", 1);
    assert!(judged(&elsewhere).errors.iter().any(|e| e.contains("109 of them")));
    let short = text.replacen("G1 X3495.\n", "", 1).replacen("G4 X3.\nX3490.\n", "G4 X3.\n", 1);
    assert!(judged(&short).minor.iter().any(|m| m.starts_with("1 of 110")), "{:?}", judged(&short));
    let folder = Folder::new("room");
    for (end, overrun, code) in [
        ("3500", "overrun = \"5 mm\"", Some("no-overrun")),
        ("3500", "overrun = \"0 mm\"", None),
        ("3500", "", None),
        ("3495", "overrun = \"5 mm\"", None),
        ("3495", "overrun = \"-5 mm\"", Some("negative")),
        ("3495", "overrun = \"5 deg\"", Some("wrong-unit")),
    ] {
        let mut asked = Asked::of_gantry("X", 3490.0);
        asked.path = asked.path.replace("3490", end).replace("from = \"0 mm\"", "from = \"5 mm\"");
        asked.path = format!("{}\n{overrun}", asked.path);
        let (read, problems) = asked.read(&folder);
        let codes: Vec<_> = problems.iter().map(|d| d.code).collect();
        assert_eq!(codes.first().copied(), code, "{overrun}: {problems:?}");
        assert_eq!(read.is_some(), code.is_none(), "{overrun}");
    }
}

#[test]
fn every_fault_of_a_material_is_reported() {
    let folder = Folder::new("faults");
    let plain = Asked::of_gantry("X", 3500.0);
    let (expansion, temperature) =
        ("material_expansion = \"workpiece\"", "material_temperature = \"workpiece\"");
    let cases = [
        (temperature.to_owned(), "missing-key"),
        (expansion.to_owned(), "missing-key"),
        (format!("material_expansion = \"13.2 um\"\n{temperature}"), "wrong-unit"),
        (format!("material_expansion = \"1320 um/(m K)\"\n{temperature}"), "impossible-value"),
        (
            format!("material_expansion = \"13.2 ± -1 um/(m K)\"\n{temperature}"),
            "negative-uncertainty",
        ),
        (format!("{expansion}\nmaterial_temperature = \"wrkpiece\""), "unknown-sensor"),
        (
            format!("{expansion}\nmaterial_temperature = \"workpiece ± -1 degC\""),
            "negative-uncertainty",
        ),
        (format!("{expansion}\nmaterial_temperature = \"workpiece ± 1 mm\""), "wrong-unit"),
        (format!("{expansion}\nmaterial_temperature = \"305 degC\""), "impossible-temperature"),
        (format!("{expansion}\nmaterial_temperature = \"30.5\""), "missing-unit"),
        (format!("{MATERIAL}\nmaterial_datum = \"5 mm\""), "bad-place"),
    ];
    for (laser, code) in cases {
        let asked = Asked { laser: plain.laser.replace(MATERIAL, &laser), ..plain.clone() };
        let (read, problems) = asked.read(&folder);
        let codes: Vec<_> = problems.iter().map(|d| d.code).collect();
        // An error makes no others: neither in the paths of the laser nor in what follows it.
        assert!(read.is_none() && codes == [code], "{laser}: {codes:?}");
        assert!(problems.iter().all(|d| d.place.line > 0), "{problems:?}");
    }
    let misspelt = plain.temperature.replace("workpiece = ", "werkstueck = ");
    let (_, problems) = Asked { temperature: misspelt, ..plain.clone() }.read(&folder);
    // The sensor itself has no temperature then.
    let codes: Vec<_> = problems.iter().map(|d| d.code).collect();
    assert_eq!(codes, ["unknown-sensor", "missing-sensor"]);
    // A sensor without a temperature, another instrument, a machine without a workpiece.
    let cold = plain.temperature.replace("workpiece = \"30.8 degC\"", "");
    let (_, problems) = Asked { temperature: cold, ..plain.clone() }.read(&folder);
    assert!(
        problems.iter().any(|d| d.code == "missing-sensor" && d.hint.contains("[temperature]"))
    );
    let text = plain.text().replace("laser-line", "laser-angle");
    let path = folder.put("campaign.toml", &text);
    let (_, problems) = read_campaign(&disk(), &path, |root, c| read_virtual(root, c, None));
    assert!(problems.iter().any(|d| d.code == "unknown-key" && d.message.contains("laser-angle")));
    let bare = MILL.replace("[workpiece]\nexpansion = \"12 um/(m K)\"\n", "");
    let machine = folder.put("machine.toml", &bare).display().to_string();
    let asked = Asked { machine, temperature: String::new(), ..plain };
    let (_, problems) = asked.read(&folder);
    assert!(problems.iter().any(|d| d.code == "no-workpiece"), "{problems:?}");
}

/// κ of the true laser is 10 µm/m too large: it reads 35 µm less at 3.5 m. A laser without a material has no such error.
#[test]
fn the_true_material_may_differ() {
    let folder = Folder::new("true-material");
    let plain = Asked::of_gantry("X", 3500.0);
    let rest = format!("{}\n[truth]\nsetup = {{ material = \"10 um/m\" }}", plain.rest);
    let wrong = Asked { rest, ..plain.clone() };
    let (right, read) = (plain.deviations(&folder), wrong.deviations(&folder));
    assert!((right[10].1 - read[10].1 - 0.035).abs() < 1e-12, "{:?} {:?}", right[10], read[10]);
    let without = Asked { laser: wrong.laser.replace(MATERIAL, ""), ..wrong };
    let (found, problems) = without.read(&folder);
    assert!(found.is_none() && problems.iter().any(|d| d.code == "unknown-key"), "{problems:?}");
}

#[test]
fn every_fault_of_a_compensation_is_reported() {
    let folder = Folder::new("compensation-faults");
    let plain = Asked::of_gantry("X", 3500.0);
    let codes = |asked: &Asked| {
        let path = folder.put("campaign.toml", &asked.text());
        let (study, problems) = read_before_after(&disk(), &path, None);
        assert_eq!(study.is_none(), problems.has_errors());
        problems.iter().map(|d| d.code).collect::<Vec<_>>()
    };
    assert!(codes(&plain).is_empty(), "{:?}", codes(&plain));
    for (keys, code) in [
        ("states = [\"all\"]", "unknown-word"),
        ("states = []", "bad-list"),
        ("states = \"none\"", "wrong-type"),
        ("increment = \"0 um\"", "not-positive"),
        ("tables = \"siemens\"", "unknown-target"),
        ("temperature = { scale_q = \"30 degC\" }", "unknown-sensor"),
        ("temperature = { scale_x = \"300 degC\" }", "impossible-temperature"),
        ("steps = 3", "unknown-key"),
    ] {
        let asked =
            Asked { rest: format!("{}\n[compensation]\n{keys}", plain.rest), ..plain.clone() };
        assert!(codes(&asked).contains(&code), "{keys}: {:?}", codes(&asked));
    }
    let comprehensive = format!("{}\n[compensation]\nstates = [\"comprehensive\"]", plain.rest);
    let cold = plain.temperature.replace("workpiece = \"30.8 degC\"", "");
    let laser = plain.laser.replace(MATERIAL, "");
    let asked = Asked { temperature: cold, laser, rest: comprehensive, ..plain.clone() };
    assert!(codes(&asked).contains(&"no-workpiece-temperature"), "{:?}", codes(&asked));
    let across = Asked { laser: plain.laser.replace("1 0 0", "0 1 0"), ..plain.clone() };
    let across = Asked { path: format!("{}\ndirection = \"0 1 0\"", across.path), ..across };
    assert!(codes(&across).contains(&"no-positioning"), "{:?}", codes(&across));
}
