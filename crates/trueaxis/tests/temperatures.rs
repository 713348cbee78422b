//! Conditions that change along a run: simulations, test pieces and holes over a log, and what the
//! uncertainty of an expansion does to a hole.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use trueaxis::files;
use trueaxis::files::disk;
use trueaxis::input::Diagnostics;
use trueaxis::machine::Machine;
use trueaxis::machine::heat::{Conditions, TemperatureLog, TemperatureRun};
use trueaxis::predict::holes::{predict_holes, read_hole_study};
use trueaxis::predict::{Cutting, Judge, predict, read_study};
use trueaxis::simulate::{
    Batch, BodyTable, Drift, Observer, Options, SetUp, read_program, simulate,
};

struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("trueaxis-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).expect("a folder");
        Self(path)
    }

    fn file(&self, name: &str, text: &str) -> PathBuf {
        let path = self.0.join(name);
        std::fs::write(&path, text).expect("written");
        path
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Scale of X, workpiece and a spindle that grows; no other error.
const MACHINE: &str = r#"
machine = { name = "warm", chain = "w b X Y Z t" }
[axis.X]
travel = ["0 mm", "4000 mm"]
[axis.Z]
placement = "0 0 100 mm"
[tool]
length = "100 mm"
[scale.X]
expansion = "10 um/(m K)"
table_temperature = "20 degC"
sensors = { scale_x = "0 mm" }
[workpiece]
expansion = "12 ± 0.5 um/(m K)"
[heat.EZ0t]
spindle = "2 um/K"
"#;

/// 20 °C at first, then 0.05 K/s up to 30 °C; the workpiece stays.
const LOG: &str = "time_s,scale_x_degC,spindle_degC,workpiece_degC\n\
                   0,20,20,20\n100,20,20,20\n300,30,30,20\n";

fn log(text: &str) -> Arc<TemperatureLog> {
    let mut problems = Diagnostics::new();
    let log = TemperatureLog::parse("log.csv", text, &mut problems);
    Arc::new(log.unwrap_or_else(|| panic!("{:?}", problems.sorted())))
}

fn machine(folder: &Folder) -> Machine {
    let (machine, problems) = files::machine(&folder.file("machine.toml", MACHINE));
    machine.unwrap_or_else(|| panic!("{:?}", problems.sorted()))
}

/// Time and deviation of the tip at every place.
#[derive(Default)]
struct Places(Vec<(f64, [f64; 6], trueaxis::geometry::Vec3)>);

impl Observer for Places {
    fn path(&mut self, batch: &Batch<'_>) {
        for (i, (node, stamp)) in batch.nodes.iter().zip(batch.stamps).enumerate() {
            self.0.push((stamp.time_s, node.command, batch.deviation(i).tip_mm));
        }
    }
}

fn walk(folder: &Folder, nc: &str, options: &Options) -> (Places, Vec<&'static str>) {
    let program = folder.file("part.nc", nc);
    let setup = SetUp::default();
    let program =
        read_program(&disk(), &program, None, &setup, &mut Diagnostics::new()).expect("read");
    let mut places = Places::default();
    let run = simulate(&machine(folder), &program, &setup, options, &mut [&mut places]);
    let errors = run.problems.iter().filter(|d| d.severity.to_string() == "error");
    (places, errors.map(|d| d.code).collect())
}

/// To X 2000 and back at 2 m/min, more than 2 min; then a dwell of 10 s.
const PROGRAM: &str = "G21 G90 G94\nG1 X2000 F2000\nG1 X1000\nG4 P10000\nG1 X1010\nM30\n";

#[test]
fn law_every_place_of_a_simulation_has_the_temperatures_of_its_time() {
    let folder = Folder::new("simulate-log");
    let run = TemperatureRun { log: log(LOG), start_s: 50.0 };
    let options = Options { temperatures: Some(run.clone()), ..Options::default() };
    let (places, errors) = walk(&folder, PROGRAM, &options);
    assert!(errors.is_empty() && places.0.len() > 200, "{errors:?}");
    let machine = machine(&folder);
    let mut warmest = 0.0_f64;
    for (time_s, command, tip_mm) in &places.0 {
        // Frozen at that very time: the actual machine at that time.
        let conditions = run.log.at(50.0 + time_s).expect("inside");
        let there = machine.at(&conditions, &mut Diagnostics::new()).expect("sound");
        let errors = there.errors_at(command, &[0.0; 6]).expect("everywhere");
        let exact = there.deviation(command, &errors).tip_mm;
        // 0.01 K · (10 µm/(m·K) · 2 m + 2 µm/K), and a little for the digits.
        assert!((exact - tip_mm).amax() <= 0.2001e-3, "{time_s} {exact} {tip_mm}");
        warmest = warmest.max(tip_mm.x);
    }
    // On the way back, some 2 K warmer than at the begin: the log was really followed.
    assert!(warmest > 0.02, "{warmest}");
}

#[test]
fn law_a_log_that_never_moves_is_constant_conditions() {
    let folder = Folder::new("simulate-still");
    let still = log("time_s,scale_x_degC,spindle_degC,workpiece_degC\n0,25,31,22\n1e4,25,31,22\n");
    let run = TemperatureRun { log: still, start_s: 0.0 };
    let options = Options { temperatures: Some(run), ..Options::default() };
    let (logged, _) = walk(&folder, PROGRAM, &options);
    let text = "scale_x=25 spindle=31 workpiece=22";
    let mut problems = Diagnostics::new();
    let conditions = Conditions::typed("t", text, &mut problems).expect("sound");
    let constant = machine(&folder).at(&conditions, &mut problems).expect("sound");
    let program = folder.0.join("part.nc");
    let program =
        read_program(&disk(), &program, None, &SetUp::default(), &mut problems).expect("read");
    let mut places = Places::default();
    simulate(&constant, &program, &SetUp::default(), &Options::default(), &mut [&mut places]);
    assert_eq!(places.0, logged.0);
}

#[test]
fn the_drift_is_told_with_its_temperatures() {
    let folder = Folder::new("simulate-drift");
    let run = TemperatureRun { log: log(LOG), start_s: 100.0 };
    let options = Options { temperatures: Some(run.clone()), ..Options::default() };
    let machine = machine(&folder);
    let setup = SetUp::default();
    let mut drift = Drift::of(&machine, &setup, &run).expect("sound");
    let mut bodies = BodyTable::new(Vec::new());
    let program = folder.file("part.nc", PROGRAM);
    let program =
        read_program(&disk(), &program, None, &setup, &mut Diagnostics::new()).expect("read");
    let mut observers: [&mut dyn Observer; 2] = [&mut drift, &mut bodies];
    simulate(&machine, &program, &setup, &options, &mut observers);
    let sensors = drift.sensors();
    assert_eq!((sensors[0].lowest_celsius, sensors[2].highest_celsius), (20.0, 20.0));
    let end_celsius = 20.0 + 0.05 * drift.time_s();
    assert!((sensors[0].highest_celsius - end_celsius).abs() < 1e-9);
    // At the end X = 1010 mm: 10 µm/(m·K) · 1.01 m · ΔT along x, 2 µm/K · ΔT along z.
    let rise = end_celsius - 20.0;
    let by_hand = (10.1e-3 * rise).hypot(2e-3 * rise);
    assert!((drift.last_mm - by_hand).abs() < 0.11e-3, "{} {by_hand}", drift.last_mm);
    assert!(drift.tip.value >= drift.last_mm && drift.unknown == 0);
    // The bodies' table knows the time too: the tool body has sunk by 2 µm/K.
    let table = String::from_utf8(bodies.finish().expect("in memory")).expect("UTF-8");
    let last = table.lines().rfind(|l| l.contains(",t,")).expect("the tool");
    let dz: f64 = last.split(',').nth(18).expect("dev_z_um").parse().expect("a number");
    assert!((dz - 2.0 * rise).abs() < 0.03, "{dz} {rise}");
}

#[test]
fn a_log_that_ends_too_early_is_refused_where_it_ends() {
    let folder = Folder::new("simulate-short");
    let at = |start_s: f64| {
        let run = TemperatureRun { log: log(LOG), start_s };
        walk(&folder, PROGRAM, &Options { temperatures: Some(run), ..Options::default() })
    };
    let (places, errors) = at(250.0);
    assert_eq!(errors, ["log-ends"]);
    assert!(places.0.iter().any(|(t, ..)| *t < 50.0));
    assert_eq!(at(301.0).1, ["outside-log"]);
    // A log at rest ends too.
    let still = log("time_s,scale_x_degC\n0,25\n60,25\n");
    let run = TemperatureRun { log: still, start_s: 0.0 };
    let options = Options { temperatures: Some(run), ..Options::default() };
    assert_eq!(walk(&folder, PROGRAM, &options).1, ["log-ends"]);
}

fn holes(folder: &Folder, temperature: &str) -> PathBuf {
    folder.file("machine.toml", MACHINE);
    folder.file("hall.csv", LOG);
    let text = format!(
        "name = \"h\"\nmachine = \"machine.toml\"\n[holes]\ncount = 4\ncircle = \"1000 mm\"\n\
         centre = \"1000 500 0 mm\"\ntolerance = \"0.1 mm\"\n[temperature]\n{temperature}\n"
    );
    folder.file("holes.toml", &text)
}

#[test]
fn law_u_of_a_hole_from_the_expansion_of_the_workpiece_alone() {
    let folder = Folder::new("holes-u");
    let (study, problems) = read_hole_study(&disk(), &holes(&folder, "workpiece = \"28 degC\""));
    let study = study.unwrap_or_else(|| panic!("{:?}", problems.sorted()));
    let found = predict_holes(&study).expect("reachable");
    for set in &found.sets {
        for (hole, place) in set.holes.iter().zip(&study.holes_mm) {
            // u = L · ΔT · u(α_w), with L = x and y from the fixed point at 0.
            let by_hand = place * (8.0 * 0.5e-6);
            // The command differs by the compensation, a fifth of a millimetre: below a nanometre.
            assert!((hole.u_mm - by_hand).amax() < 1e-6, "{} {by_hand}", hole.u_mm);
        }
    }
    let worst = &found.sets[0];
    // The hole at 1500, 500 mm: its distance goes straight away from the fixed point.
    let far = 1500_f64.hypot(500.0);
    assert!((worst.worst_mm - far * 8.0 * 12e-6).abs() < 1e-9);
    assert!((worst.u_worst_mm - far * 8.0 * 0.5e-6).abs() < 1e-9);
    assert!(found.held.is_none());
}

#[test]
fn holes_over_a_log_are_made_at_their_times() {
    let folder = Folder::new("holes-log");
    let path = holes(&folder, "log = \"hall.csv\"\nstart = \"100 s\"\nduration = \"200 s\"");
    let (study, problems) = read_hole_study(&disk(), &path);
    let study = study.unwrap_or_else(|| panic!("{:?}", problems.sorted()));
    let found = predict_holes(&study).expect("reachable");
    assert_eq!(found.times_s, [25.0, 75.0, 125.0, 175.0]);
    for (i, (hole, place)) in found.sets[0].holes.iter().zip(&study.holes_mm).enumerate() {
        // 0.05 K/s, at 25 + 50 i seconds; within 0.01 K.
        let by_hand = 10e-6 * place.x * 0.05 * found.times_s[i];
        assert!((hole.error_mm.x - by_hand).abs() <= 1.6e-4, "{i} {} {by_hand}", hole.error_mm.x);
    }
    let held = found.held.expect("for comparison");
    assert!(held[0].worst_mm < 1e-12 && found.sets[0].worst_mm > 0.03);
    // Longer than the log.
    let path = holes(&folder, "log = \"hall.csv\"\nstart = \"100 s\"\nduration = \"1 h\"");
    let study = read_hole_study(&disk(), &path).0.expect("read");
    let problems = predict_holes(&study).expect_err("the log ends").sorted();
    assert!(problems.iter().any(|d| d.message.contains("the log ends after 200.0 s")));
}

#[test]
fn bad_temperatures_of_a_study_are_named() {
    let folder = Folder::new("holes-bad");
    let codes = |temperature: &str| {
        let problems = read_hole_study(&disk(), &holes(&folder, temperature)).1;
        let errors = problems.iter().filter(|d| d.severity.to_string() == "error");
        errors.map(|d| d.code).collect::<Vec<_>>()
    };
    let log = "log = \"hall.csv\"\n";
    assert_eq!(codes(log), ["missing-key", "missing-key"]);
    assert_eq!(codes(&format!("{log}start = \"0 s\"")), ["missing-key"]);
    let timed = format!("{log}duration = \"1 min\"\n");
    assert_eq!(codes(&format!("{timed}start = \"9 h\"")), ["outside-log"]);
    assert_eq!(codes(&format!("{timed}start = \"0 s\"\nfeed = \"1 m/min\"")), ["unknown-key"]);
    assert_eq!(codes(&format!("{log}start = \"0 s\"\nduration = \"-1 s\"")), ["not-positive"]);
    assert_eq!(
        codes("log = \"none.csv\"\nstart = \"0 s\"\nduration = \"1 s\""),
        ["unreadable-file"]
    );
    assert!(codes(&format!("{timed}start = \"0 s\"")).is_empty());
    if cfg!(not(feature = "parquet")) {
        folder.file("hall.parquet", "PAR1");
        let parquet = "log = \"hall.parquet\"\nstart = \"0 s\"\nduration = \"1 s\"";
        assert_eq!(codes(parquet), ["parquet-not-built"]);
    }
}

#[test]
fn law_a_test_piece_over_a_log_lies_between_its_ends() {
    let folder = Folder::new("piece-log");
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let study = root.join("examples/03_predict/nas979-on-xkas2525.toml");
    let text = std::fs::read_to_string(&study).expect("an example");
    const HEAT: &str = "\n[heat.EX0t]\ncolumn = \"3 ± 1 um/K\"\n";
    let machine = root.join("machines/xkas2525");
    for entry in std::fs::read_dir(&machine).expect("a machine").flatten() {
        let text = std::fs::read_to_string(entry.path()).expect("a text");
        let name = entry.file_name().into_string().expect("a name");
        let heat = if name == "machine.toml" { HEAT } else { "" };
        folder.file(&name, &(text + heat));
    }
    folder.file("hall.csv", "time_s,column_degC\n0,20\n600,32\n");
    let text = text
        .replace("../../machines/xkas2525/", "")
        .replace("../../testpieces", &root.join("testpieces").display().to_string());
    let read = |temperature: &str| {
        let path = folder.file("study.toml", &format!("{text}\n[temperature]\n{temperature}\n"));
        let (study, problems) = read_study(&disk(), &path);
        let mut study = study.unwrap_or_else(|| panic!("{:?}", problems.sorted()));
        study.sampling = None;
        study
    };
    let logged = read("log = \"hall.csv\"\nstart = \"0 s\"\nduration = \"10 min\"");
    let (cold, hot) = (read("column = \"20 degC\""), read("column = \"32 degC\""));
    let cut = |study: &trueaxis::predict::Study| {
        let (machine, reference) = (&study.machine, &study.reference);
        let running = study.temperatures.as_ref();
        let cutting = Cutting::over(machine, study.piece(), reference, running).expect("reachable");
        let judge = Judge { cutting: &cutting, piece: study.piece() };
        judge.sections(&|errors, _| *errors).expect("evaluable").0
    };
    let (logged_mm, cold_mm, hot_mm) = (cut(&logged), cut(&cold), cut(&hot));
    // The first cut is the cold one; the zero was touched cold, so at the end it is the hot one
    // with a cold zero: the tool has moved by 3 µm/K · 12 K = 36 µm in all.
    let first = (logged_mm[0] - cold_mm[0]).norm();
    assert!(first < 1e-4, "{first}");
    let last = logged_mm.len() - 1;
    let gone = (logged_mm[last] - cold_mm[last]).norm();
    assert!((gone - 0.036).abs() < 0.002, "{gone}");
    // Held at 32 °C from the zero on only turns with the workpiece remain.
    assert!((hot_mm[0] - cold_mm[0]).norm() < 0.072);
    // The result of the start is shown for comparison, and u contains that of the coefficient.
    let prediction = predict(&logged, &|_| {}).expect("predicted");
    let plain = predict(&cold, &|_| {}).expect("predicted");
    let held = prediction.variants.last().expect("held");
    assert!(held.name.contains("held"));
    for (held, plain) in held.indices_mm.iter().zip(&plain.indices) {
        assert!((held - plain.value_mm).abs() < 1e-12);
    }
    let u = |p: &trueaxis::predict::Prediction| p.indices.iter().map(|i| i.u_mm).sum::<f64>();
    assert!(u(&prediction) > u(&plain));
}
