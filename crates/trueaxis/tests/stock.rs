//! Stock along programs: volumes by hand, what must not touch it, and whatever should not matter.

mod library;

use std::f64::consts::PI;
use std::path::{Path, PathBuf};
use trueaxis::input::{Diagnostics, Files};
use trueaxis::machine::Machine;
use trueaxis::simulate::report::issue_code;
use trueaxis::simulate::{
    Collisions, Densify, Findings, Job, Machined, Machining, Options, ProgramFiles, Recorder, Stop,
    Timing,
};

const MILL: &str = "[machine]\nname = \"mill\"\nchain = \"w b X Y Z t\"\n\
    [axis.X]\nmax_velocity = \"30 m/min\"\nmax_acceleration = \"3 m/s^2\"\nmax_jerk = \"30 m/s^3\"\n\
    [axis.Y]\nmax_velocity = \"30 m/min\"\nmax_acceleration = \"3 m/s^2\"\nmax_jerk = \"30 m/s^3\"\n\
    [axis.Z]\nmax_velocity = \"30 m/min\"\nmax_acceleration = \"3 m/s^2\"\nmax_jerk = \"30 m/s^3\"\n";

/// A block of 80 × 50 × 20 mm under the zero, in the middle of it.
const SET_UP: &str = "control = \"fanuc\"\nworkpiece_at = \"G54\"\n[work_offset.G54]\nX = \"300 mm\"\nY = \"200 mm\"\nZ = \"-300 mm\"\n\
    [tool.1]\nname = \"end mill 10\"\nlength = \"90 mm\"\ndiameter = \"10 mm\"\n\
    [stock]\nbox = \"80 50 20 mm\"\nplacement = \"0 0 -10 mm\"\nresolution = \"0.5 mm\"\n";

fn program(blocks: &str) -> String {
    format!(
        "%\nO1\nG21 G17 G40 G80 G90 G94\nT1 M6\nG54 G0 X-60. Y0. S8000 M3\nG43 Z5. H1\n{blocks}M30\n%\n"
    )
}

fn job(machine: &str, set_up: &str, program: &str, options: Options) -> Job {
    let texts = [("m.toml", machine), ("p.nc", program), ("p.setup.toml", set_up)];
    let texts = texts.iter().map(|(name, text)| (PathBuf::from(name), (*text).to_owned()));
    let files = Files::none().with_texts(texts);
    let (machine, mut problems) = Machine::read(&files, Path::new("m.toml"));
    let path = Path::new("p.nc");
    let set_up = Path::new("p.setup.toml");
    let files = ProgramFiles {
        files: &files,
        program: path,
        text: None,
        setup: Some(set_up),
        control: None,
    };
    let job = machine.and_then(|m| Job::read(m, &files, options, &mut problems));
    let job = job.map(|job| job.with_models(Path::new("m.toml"), &mut problems));
    job.unwrap_or_else(|| panic!("{:?}", words(&problems)))
}

fn words(problems: &Diagnostics) -> Vec<String> {
    problems.iter().map(|p| format!("{}: {} ({})", p.code, p.message, p.hint)).collect()
}

fn run_by(set_up: &str, blocks: &str, options: Options) -> Findings {
    run_job(&job(MILL, set_up, &program(blocks), options))
}

fn run_job(job: &Job) -> Findings {
    let machining = Machining::watch(&job.setup).expect("a stock");
    let collisions = job.collisions().map(Collisions::beside_cut_stock);
    let found = job.run_on(collisions, Some(machining), &mut []);
    assert!(!found.run.problems.has_errors(), "{:?}", words(&found.run.problems));
    found
}

fn run(blocks: &str) -> Findings {
    run_by(SET_UP, blocks, Options::default())
}

fn machined(found: &Findings) -> &Machined {
    found.machined.as_ref().expect("a stock")
}

/// The critical issues by code and line.
fn critical(found: &Findings) -> Vec<(&'static str, u32)> {
    let list = found.issues.list.iter().filter(|i| i.critical);
    list.map(|i| (issue_code(&i.kind), i.first.line)).collect()
}

fn near(found: f64, due: f64, part: f64) {
    assert!((found / due - 1.0).abs() < part, "{found} {due}");
}

/// While the tool goes along a slot, a rectangle and half a disc of its width are gone, 4 mm deep; before it nothing is, and at the end
/// what the whole program took, to the last bit. Feed lasts as long as the time goes on.
#[test]
fn law_the_stock_at_a_time_is_cut_up_to_where_the_tool_is_then() {
    let incremental = "G1 Z-4. F2000\nG91 G1 X120. F1200\nG90 G0 Z5.\n";
    let in_pieces = "G1 Z-4. F2000\nX-31.7 F1200\nX-31.69\nX18.\nX60.\nG0 Z5.\n";
    for slot in [SLOT, incremental, in_pieces] {
        let back = format!("{slot}G0 X-60.\nG1 Z-4.\nG1 Y30. F900\n");
        the_stock_follows_the_tool(&job(MILL, SET_UP, &program(&back), Options::default()));
    }
}

fn the_stock_follows_the_tool(job: &Job) {
    let mut recorder = Recorder::of(&job.machine, &job.setup, &job.options);
    let machining = || Machining::watch(&job.setup).expect("a stock");
    let found = job.run_on(None, Some(machining()), &mut [&mut recorder]);
    let (whole, recording) = (machined(&found), recorder.finish());
    let until =
        |time_s| job.machined_until(machining(), time_s, &Stop::default()).expect("a stock");
    let end_s = recording.end_s();
    let mut in_slot = Vec::new();
    let mut last_mm3 = whole.before_mm3;
    for k in 0..=60 {
        let time_s = end_s * f64::from(k) / 60.0;
        let now = until(time_s);
        let left_mm3 = now.stock.volume_mm3();
        // Where a step ends early, its chords lie elsewhere: a wall moves by what a chord is off the circle.
        assert!(left_mm3 <= last_mm3 + 1e-6 * whole.before_mm3, "{time_s} {left_mm3} {last_mm3}");
        last_mm3 = left_mm3;
        let tip = recording.at(time_s).expect("a place").tip_mm;
        let is_along = tip.x > -34.0 && tip.x < 34.0 && tip.y.abs() < 1e-6;
        if is_along && (tip.z + 4.0).abs() < 1e-6 {
            let area_mm2 = 10.0 * (tip.x + 40.0) + 0.5 * PI * 25.0;
            near(whole.before_mm3 - left_mm3, 4.0 * area_mm2, 0.02);
            in_slot.push((time_s, now.total().cutting_s + now.total().air_s));
        }
    }
    assert!(in_slot.len() > 10, "{}", in_slot.len());
    let idle_s = |(time_s, feed_s): &(f64, f64)| time_s - feed_s;
    assert!(in_slot.iter().all(|at| (idle_s(at) - idle_s(&in_slot[0])).abs() < 1e-9));
    for time_s in [end_s, 1e9] {
        let at_end = until(time_s);
        assert_eq!(at_end.stock.volumes_mm3(), whole.stock.volumes_mm3());
        assert_eq!(at_end.blocks, whole.blocks);
    }
    assert_eq!(until(0.0).stock.volume_mm3(), whole.before_mm3);
    let given_up = Stop::default();
    given_up.request();
    assert!(job.machined_until(machining(), end_s, &given_up).is_none());
}

const SLOT: &str = "G1 Z-4. F2000\nG1 X60. F1200\nG0 Z5.\n";

/// A slot of 10 × 4 mm along the block: 3,200 mm³ by the block that goes along it; a second pass is air; the way in and out is air, too.
#[test]
fn law_a_slot_by_hand() {
    let found = run(SLOT);
    let (all, total) = (machined(&found), machined(&found).total());
    near(all.before_mm3, 80.0 * 50.0 * 20.0, 1e-9);
    near(total.removed_mm3, 80.0 * 10.0 * 4.0, 2e-3);
    near(all.before_mm3 - all.stock.volume_mm3(), total.removed_mm3, 1e-9);
    assert!(all.spread_mm3() < 2e-3 * 3200.0, "{}", all.spread_mm3());
    let slot = all.blocks.iter().find(|(at, _)| at.line == 8).expect("line 8").1;
    near(slot.removed_mm3, total.removed_mm3, 1e-9);
    // Of the 120 mm its front takes something from 45 mm before the middle to 40 mm after it; it is faster there than at the ends.
    near(slot.cutting_s / (slot.cutting_s + slot.air_s), 85.0 / 120.0, 0.02);
    assert!(critical(&found).is_empty(), "{:?}", critical(&found));
    let twice = run(&format!("{SLOT}G0 X-60.\nG1 Z-4.\nG1 X60.\nG0 Z5.\n"));
    let second = machined(&twice).blocks.iter().find(|(at, _)| at.line == 12).expect("line 12").1;
    assert!(second.removed_mm3 < 1.0 && second.cutting_s == 0.0, "{second:?}");
}

/// In rapid through what is there is an issue at its block; through what is cut away it is none.
#[test]
fn law_rapid_is_allowed_where_nothing_is_left() {
    let there = run("G1 Z-4. F2000\nG0 X60.\nG0 Z5.\n");
    assert_eq!(critical(&there), [("rapid-in-stock", 8)]);
    let gone = run(&format!("{SLOT}G0 X-60.\nG1 Z-4.\nG0 X60.\nG0 Z5.\n"));
    assert!(critical(&gone).is_empty(), "{:?}", critical(&gone));
    // 0.4 mm deeper than the slot; a retreat out of the slot.
    let deeper = run(&format!("{SLOT}G0 X-60.\nG1 Z-4.4\nG0 X60.\nG0 Z5.\n"));
    assert_eq!(critical(&deeper), [("rapid-in-stock", 12)]);
    let out = run("G1 Z-4. F2000\nG1 X0. F1200\nG0 Z5.\nG0 X60.\n");
    assert!(critical(&out).is_empty(), "{:?}", critical(&out));
}

/// A shank that is thicker than its cutter rubs in a slot that is deeper than the cutter is long.
#[test]
fn law_a_shank_rubs_in_a_deep_slot() {
    let set_up = SET_UP.replace(
        "diameter = \"10 mm\"\n",
        "diameter = \"10 mm\"\nshape = [[\"10 mm\", \"6 mm\"], [\"12 mm\", \"84 mm\"]]\n",
    );
    let down = |z: f64| format!("G1 Z{z:.1} F2000\nG1 X60. F1200\nG0 Z5.\nG0 X-60.\n");
    let shallow = run_by(&set_up, &down(-5.5), Options::default());
    assert!(critical(&shallow).is_empty(), "{:?}", critical(&shallow));
    let deep = run_by(&set_up, &format!("{}{}", down(-5.5), down(-7.0)), Options::default());
    assert_eq!(critical(&deep), [("collision", 12)]);
}

/// A part within the stock: 0.5 mm into its top is a gouge at its block; what stays around it is excess.
#[test]
fn law_a_gouge_by_hand() {
    let set_up = SET_UP.to_owned() + "[part]\nbox = \"80 50 16 mm\"\nplacement = \"0 0 -12 mm\"\n";
    let good = run_by(&set_up, SLOT, Options::default());
    assert!(critical(&good).is_empty(), "{:?}", critical(&good));
    near(machined(&good).excess_mm3.expect("a part"), 80.0 * 40.0 * 4.0, 1e-3);
    assert!(machined(&good).gouged_mm3.expect("a part") < 1e-6);
    let deep = run_by(&set_up, &SLOT.replace("Z-4.", "Z-4.5"), Options::default());
    assert_eq!(critical(&deep), [("gouged-part", 8)]);
    let depth = deep.issues.list.iter().find(|i| i.critical).expect("an issue").value;
    assert!((depth - 0.5).abs() < 1e-6, "{depth}");
    near(machined(&deep).gouged_mm3.expect("a part"), 80.0 * 10.0 * 0.5, 0.02);
}

/// Chord, spacing, timing, incremental or absolute, a move in two: nothing changes what is removed; a finer stock brings it nearer to a bore by hand.
#[test]
fn law_what_should_not_matter_to_a_program() {
    let bore = "G0 X8. Y0.\nG1 Z-6. F300\nG3 I-8. F900\nG1 X0.\nG0 Z5.\n";
    let volume = |blocks: &str, options: Options| {
        machined(&run_by(SET_UP, blocks, options)).total().removed_mm3
    };
    let due = PI * 13.0 * 13.0 * 6.0;
    let found = volume(bore, Options::default());
    near(found, due, 4e-3);
    let fine = Densify::Tolerance { chord_mm: 1e-4, angle_rad: 0.01, spacing_mm: 1.0 };
    near(volume(bore, Options { densify: fine, ..Options::default() }), found, 1e-3);
    let phases = Timing::ThreePhase { acceleration: 500.0, smooth: false };
    near(volume(bore, Options { timing: phases, ..Options::default() }), found, 1e-9);
    let incremental = "G91\nG0 X68. Y0.\nG1 Z-11. F300\nG3 I-8. F900\nG1 X-8.\nG0 Z11.\nG90\n";
    near(volume(incremental, Options::default()), found, 1e-9);
    let halves = bore.replace("G3 I-8. F900\n", "G3 X-8. I-8. F900\nG3 X8. I8.\n");
    near(volume(&halves, Options::default()), found, 1e-3);
    let fine = SET_UP.replace("0.5 mm", "0.2 mm");
    near(machined(&run_by(&fine, bore, Options::default())).total().removed_mm3, due, 1e-3);
}

/// A head that is wider than its short tool is long meets the stock: the bodies of the machine are watched, whatever the tool may cut.
#[test]
fn law_the_head_of_the_machine_is_watched_against_the_stock() {
    let machine = MILL.to_owned()
        + "[[model]]\nbody = \"Z\"\nname = \"head\"\nbox = \"60 60 20 mm\"\nplacement = \"0 0 10 mm\"\n";
    let by = |length: &str, blocks: &str| {
        let set_up = SET_UP.replace("90 mm", length);
        critical(&run_job(&job(&machine, &set_up, &program(blocks), Options::default())))
    };
    assert_eq!(by("90 mm", SLOT), []);
    // 3 mm of tool below the head, which reaches 10 mm over the block where it goes 4 mm down.
    assert_eq!(by("3 mm", SLOT), [("collision", 7)]);
}

/// A ball does not mind how it leans where only its lower half cuts: five axes at any direction remove what three do.
#[test]
fn law_a_leaning_ball_removes_what_an_upright_one_does() {
    let machine = "[machine]\nname = \"table\"\nchain = \"w C' A' b X Y Z t\"\n";
    let set_up = SET_UP
        .replace("diameter = \"10 mm\"\n", "diameter = \"10 mm\"\ncorner_radius = \"5 mm\"\n")
        .replace("0.5 mm", "0.2 mm");
    let removed = |lean: f64, turn: f64| {
        let text = |axis: [f64; 3]| {
            // The tip that keeps the centre of the ball on its line, 5 mm above it along the axis of the tool.
            let tip = |x: f64, z: f64| {
                let [x, y, z] = [x - 5.0 * axis[0], -5.0 * axis[1], z + 5.0 - 5.0 * axis[2]];
                format!("X{x:.4} Y{y:.4} Z{z:.4}")
            };
            let (above, near, far) = (tip(-60.0, 30.0), tip(-60.0, -4.0), tip(60.0, -4.0));
            format!(
                "%\nO1\nG21 G17 G40 G80 G90 G94\nT1 M6\nG54 S8000 M3\nG0 A{lean} C{turn}\nG43.4 H1\nG0 {above}\nG1 {near} F2000\nG1 {far} F1200\nG49\nM30\n%\n"
            )
        };
        let (a, c) = (lean.to_radians(), turn.to_radians());
        let axis = [a.sin() * c.sin(), a.sin() * c.cos(), a.cos()];
        let found = run_job(&job(machine, &set_up, &text(axis), Options::default()));
        machined(&found).total().removed_mm3
    };
    let upright = removed(0.0, 0.0);
    // A segment of a circle of radius 5, 4 mm high, along 80 mm.
    let due = 80.0 * (25.0 * 0.2_f64.acos() - 24.0_f64.sqrt());
    // Lines along the slot, 0.2 mm apart, count by themselves 0.6 % more than that.
    near(upright, due, 3e-3);
    for (lean, turn) in [(10.0, 0.0), (10.0, 70.0), (8.0, 200.0)] {
        near(removed(lean, turn), due, 3e-3);
    }
}

/// A path that is drawn too coarsely is not cut along.
#[test]
fn a_stock_asks_for_a_fine_path() {
    let job = job(MILL, SET_UP, &program(SLOT), Options::default());
    let machining = Machining::watch(&job.setup).expect("a stock");
    let by = |chord_mm| Densify::Tolerance { chord_mm, angle_rad: 0.01, spacing_mm: 10.0 };
    assert!(machining.follows(&Densify::default()) && machining.follows(&by(0.05)));
    assert!(!machining.follows(&by(0.051)) && !machining.follows(&Densify::Off));
}

#[test]
fn what_cannot_be_cut_is_refused() {
    let refused = |set_up: &str| {
        let job = job(MILL, set_up, &program(SLOT), Options::default());
        Machining::watch(&job.setup).err().map(|(message, _)| message).unwrap_or_default()
    };
    let without = SET_UP.split("[stock]").next().expect("a set-up");
    assert!(refused(without).contains("states no stock"));
    assert!(refused(&SET_UP.replace("0.5 mm", "0.00001 mm")).contains("lines"));
    // A tool without a diameter, one that is 10 m wide, and one that is 10 m long.
    let long = SET_UP.replace("\"90 mm\"", "\"10 m\"") + "[plausible]\ntool_length_mm = 20_000\n";
    for set_up in [
        SET_UP.replace("diameter = \"10 mm\"\n", ""),
        SET_UP.replace("diameter = \"10 mm\"\n", "diameter = \"10 m\"\n"),
        long,
    ] {
        let job = job(MILL, &set_up, &program(SLOT), Options::default());
        let machining = Machining::watch(&job.setup).expect("a stock");
        let found = job.run_on(None, Some(machining), &mut []);
        assert!(found.run.problems.iter().any(|p| p.code == "unknown-cutter"), "{set_up}");
    }
}

/// Wherever a thin drill plunges into a large plate, it is seen, or said to be thinner than the lines of the stock are apart.
#[test]
fn law_a_thin_tool_does_not_pass_between_the_lines_of_the_stock() {
    let plate =
        SET_UP.replace("80 50 20 mm", "500 300 20 mm").replace("resolution = \"0.5 mm\"\n", "");
    for (width, is_seen) in
        [("3", true), ("1", true), ("0.8", true), ("0.7", false), ("0.1", false)]
    {
        let set_up = plate.replace("\"10 mm\"", &format!("\"{width} mm\""));
        let stated = format!("{set_up}resolution = \"2.5 mm\"\n");
        for [x, y] in [[17.45, -31.82], [-40.0, 3.3], [0.25, 0.25], [10.1, 40.7]] {
            let plunge = |word: &str| format!("G0 X{x} Y{y}\n{word} Z-10.\nG0 Z5.\n");
            if is_seen {
                let found = run_by(&set_up, &plunge("G0"), Options::default());
                assert_eq!(critical(&found), [("rapid-in-stock", 8)], "{width} {x}");
                let found = run_by(&set_up, &plunge("G1 F100"), Options::default());
                let taken = machined(&found).total().removed_mm3;
                assert!(critical(&found).is_empty() && taken > 0.0, "{width} {x}");
            }
            for set_up in [Some(&stated), Some(&set_up).filter(|_| !is_seen)].into_iter().flatten()
            {
                let job = job(MILL, set_up, &program(&plunge("G0")), Options::default());
                let machining = Machining::watch(&job.setup).expect("a stock");
                let found = job.run_on(None, Some(machining), &mut []);
                let said = found.run.problems.iter().find(|p| p.code == "unknown-cutter");
                let said = said.unwrap_or_else(|| panic!("{width} {x}"));
                assert!(said.hint.contains("`resolution = "), "{}", said.hint);
            }
        }
    }
}
