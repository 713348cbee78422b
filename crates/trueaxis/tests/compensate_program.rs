//! Compensated programs on every machine, for every control: the actual tool goes where the
//! programmed one should.

#![allow(clippy::print_stdout, reason = "the whole set says what it found")]

mod library;

use library::paths::{cl, free_form, ways};
use library::{MACHINES, bare, machine, with_lost_motion};
use std::f64::consts::TAU;
use trueaxis::compensate::program::{
    Increments, MARK, ProgramOptions, Rewritten, compensate_program,
};
use trueaxis::geometry::Vec3;
use trueaxis::input::Diagnostics;
use trueaxis::machine::Machine;
use trueaxis::machine::file::NoTables;
use trueaxis::nc::{Control, Program};
use trueaxis::post::post;
use trueaxis::simulate::{Batch, Densify, Observer, Options, SetUp, SetUpTool, simulate};
use trueaxis::writer::TipWords;

fn name(control: Control) -> &'static str {
    match control {
        Control::Fanuc | Control::Haas => "a.nc",
        Control::Sinumerik840d => "a.mpf",
        Control::Heidenhain => "a.h",
        Control::LinuxCnc => "a.ngc",
    }
}

fn compensated(
    machine: &Machine,
    text: &[u8],
    control: Control,
    options: &ProgramOptions,
) -> (Option<Rewritten>, Diagnostics) {
    let program = Program::new(name(control), text.to_vec(), control);
    compensate_program(machine, &program, &SetUp::default(), options)
}

fn codes(problems: &Diagnostics) -> Vec<String> {
    let errors = problems.iter().filter(|d| d.code != "no-set-up" && d.code != "assumed-limits");
    errors.map(ToString::to_string).collect()
}

/// All machines and all ways to write a program; the largest residual errors, mm and rad.
fn prove_all(increments: Option<Increments>, points: usize) -> [f64; 4] {
    let options = ProgramOptions { increments, ..ProgramOptions::default() };
    let mut worst = [0.0_f64; 4];
    let (mut faults, mut poles) = (Vec::new(), 0);
    for name in MACHINES {
        let machine = machine(name);
        for (i, way) in ways().iter().enumerate() {
            let path = free_form(&machine, 7 * i as u64 + name.len() as u64, points);
            let (posted, problems) = post(&machine, &cl(&path), way);
            let posted = posted.unwrap_or_else(|| panic!("{problems:?}"));
            let (done, problems) = compensated(&machine, &posted.text, way.control, &options);
            // Vectors cannot say which way the rotary axes pass a pole: refused by name.
            let near_pole =
                problems.iter().any(|d| ["other-place", "not-proved"].contains(&d.code));
            let near_pole = near_pole || done.as_ref().is_some_and(|d| !d.is_proved());
            let done = done.filter(Rewritten::is_proved);
            if done.is_none() && near_pole && way.tip_words == Some(TipWords::Vectors) {
                poles += 1;
                continue;
            }
            let Some(done) = done else {
                faults.push(format!(
                    "{name} {:?} {:?}: {:?}",
                    way.control,
                    way.tip_words,
                    codes(&problems)
                ));
                continue;
            };
            let after = done.proof.after;
            let five = machine.axes().len() == 5 && done.found.axis_left.is_empty();
            let decided = done.found.undecided == 0;
            let found = [
                if decided { after.tip_end.value } else { 0.0 },
                if five && decided { after.axis_end.value } else { 0.0 },
                if decided { after.tip.value } else { 0.0 },
                if five && decided { after.axis.value } else { 0.0 },
            ];
            println!(
                "{name:15} {:?} {:?}: {} blocks {} pieces, {} undecided, {:?}: {found:?} before {:?}",
                way.control,
                way.tip_words,
                done.found.blocks,
                done.found.pieces,
                done.found.undecided,
                done.found.axis_left,
                done.proof.before.tip_end
            );
            worst = std::array::from_fn(|k| worst[k].max(found[k]));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    println!("{poles} vector programs refused at a pole");
    assert!(poles <= 4, "{poles} refused");
    worst
}

#[test]
fn law_without_rounding_every_block_end_is_met() {
    let worst = prove_all(None, 40);
    println!("without rounding: {worst:?}");
    assert!(worst[0] <= 1e-9 && worst[1] <= 1e-12, "{worst:?}");
    assert!(worst[2] <= 1e-3 && worst[3] <= 1e-5, "{worst:?}");
}

#[test]
fn law_with_rounding_every_block_end_is_met_within_an_increment() {
    let worst = prove_all(Some(Increments::default()), 40);
    println!("with increments: {worst:?}");
    assert!(worst[0] <= 1e-3, "{worst:?}");
    assert!(worst[2] <= 2e-3, "{worst:?}");
}

#[test]
fn law_the_batch_writes_what_pose_by_pose_writes() {
    let mut same = 0;
    for name in MACHINES {
        let machine = machine(name);
        for (i, way) in ways().iter().enumerate() {
            let path = free_form(&machine, 5 * i as u64 + name.len() as u64, 30);
            let (posted, _) = post(&machine, &cl(&path), way);
            let text = posted.unwrap().text;
            let by = |pose_by_pose| {
                let options = ProgramOptions { pose_by_pose, ..ProgramOptions::default() };
                let (done, problems) = compensated(&machine, &text, way.control, &options);
                let found = done
                    .map(|d| (String::from_utf8(d.text.into_vec()).unwrap(), d.found.axis_left));
                (found, codes(&problems))
            };
            let [batch, scalar] = [false, true].map(by);
            assert_eq!(batch, scalar, "{name} {:?} {:?}", way.control, way.tip_words);
            same += usize::from(batch.0.is_some());
        }
    }
    assert!(same > 80, "{same} compared");
}

/// The new text without its mark, or why there is none.
fn rewritten(machine: &Machine, text: &str, control: Control, options: &ProgramOptions) -> String {
    let (done, problems) = compensated(machine, text.as_bytes(), control, options);
    let Some(done) = done else { panic!("{:?}", codes(&problems)) };
    let text = String::from_utf8(done.text.into_vec()).unwrap();
    let marked = text.split_inclusive('\n').filter(|l| !l.contains(MARK));
    marked.collect()
}

#[test]
fn law_a_machine_without_errors_leaves_every_byte() {
    let texts = [
        (
            Control::Fanuc,
            "%\r\nO0001(X)\r\nG21G90G94F500\r\nG0X10.Y20.\r\n  G1 X15.  (a)\r\nG2X20.Y25.R5.\r\n\r\nM30\r\n%\r\n",
        ),
        (
            Control::Sinumerik840d,
            "N1 G90 G94 F500\nG0 X=10 Y=AC(20) ; c\nG2 X20 Y30 CR=10\nG1 X=IC(5)\nM30",
        ),
        (
            Control::Heidenhain,
            "0 BEGIN PGM A MM\n1 L X+10 Y+20 FMAX\n2 L IX+5 R0 F500\n3 CC X+20 Y+20\n4 C X+25 Y+20 DR+\n5 M30\n6 END PGM A MM\n",
        ),
        (Control::LinuxCnc, "G21 G90 G94 F500\nG0 X10 Y20\ng1 x[10+5]\nG91\nG1 X5\nM2\n"),
    ];
    let machine = bare("three-axis-mill");
    for increments in [None, Some(Increments::default())] {
        let options = ProgramOptions { increments, ..ProgramOptions::default() };
        for (control, text) in texts {
            assert_eq!(rewritten(&machine, text, control, &options), text, "{control:?}");
        }
    }
}

/// A quarter of a circle in every dialect.
fn quarters() -> [(Control, &'static str); 4] {
    [
        (
            Control::Fanuc,
            "G21 G90 G94 F500\nG0 X100. Y100. Z-50.\nG1 X110.\nG2 X150. Y140. I40. J0. M5\nG1 X110.\nM30\n",
        ),
        (
            Control::Sinumerik840d,
            "G90 G94 F500\nG0 X100 Y100 Z-50\nG1 X110\nG2 X150 Y140 CR=40 M5\nG1 X110\nM30\n",
        ),
        (
            Control::Heidenhain,
            "0 BEGIN PGM A MM\n1 L X+100 Y+100 Z-50 R0 FMAX\n2 L X+110 F500\n3 CC X+150 Y+100\n4 C X+150 Y+140 DR- M5\n5 L X+110\n6 M30\n7 END PGM A MM\n",
        ),
        (
            Control::LinuxCnc,
            "G21 G90 G94 F500\nG0 X100 Y100 Z-50\nG1 X110\nG2 X150 Y140 I40 J0 M5\nG1 X110\nM2\n",
        ),
    ]
}

fn circle(options: &ProgramOptions, control: Control, text: &str) -> Rewritten {
    let (done, problems) =
        compensated(&machine("three-axis-mill"), text.as_bytes(), control, options);
    let Some(done) = done else { panic!("{control:?} {:?}", codes(&problems)) };
    assert!(done.found.blocks == 4, "{control:?}");
    done
}

#[test]
fn circles_become_lines_where_none_keeps_the_residual() {
    let options =
        ProgramOptions { residual_mm: 1e-4, increments: None, ..ProgramOptions::default() };
    for (control, text) in quarters() {
        let done = circle(&options, control, text);
        assert_eq!(done.found.circles, 1, "{control:?}");
        let new = String::from_utf8(done.text.into_vec()).unwrap();
        assert!(!new.contains("G2 ") && !new.contains("CR=") && !new.contains("DR-"), "{new}");
        // M5 acts when the whole circle is cut.
        let at = new.lines().position(|l| l.contains("M5")).unwrap();
        let last = new.lines().nth(at).unwrap();
        let x: f64 = last.split(['X', ' ']).find_map(|w| w.parse().ok()).unwrap();
        assert!((x - 150.0).abs() < 0.1, "{last}");
    }
}

#[test]
fn circles_stay_circles_within_the_residual() {
    for (control, text) in quarters() {
        let done = circle(&ProgramOptions::default(), control, text);
        // Klartext has the centre in a block of its own.
        let stays = control != Control::Heidenhain;
        assert_eq!(done.found.circles == 0, stays, "{control:?}");
        assert!(done.is_proved(), "{control:?} {:?}", done.unproved);
        let after = done.proof.after;
        assert!(after.tip.value <= 2e-3 && done.proof.before.tip.value > 4e-3, "{after:?}");
    }
}

#[test]
fn a_block_that_only_turns_takes_the_same_time() {
    let machine = machine("i5-engraver");
    let text = "G21 G90 G94\nG0 X10 Y10 Z-30 A10 C0\nG1 X12 F500\nG1 C40 F1000\nG1 X14\nM2\n";
    let options = ProgramOptions::default();
    let new = rewritten(&machine, text, Control::LinuxCnc, &options);
    let feed = |line: &str| -> Option<f64> { line.split('F').nth(1)?.trim().parse().ok() };
    let turning = new.lines().find(|l| l.contains("C40.") || l.contains("C39.")).unwrap();
    assert!(feed(turning).unwrap() < 100.0, "{new}");
    let next = new.lines().find(|l| l.starts_with("G1 X14") || l.starts_with("G1 X13")).unwrap();
    assert_eq!(feed(next), Some(1000.0), "{new}");
}

#[test]
fn inverse_time_is_divided_among_the_pieces() {
    let machine = machine("three-axis-mill");
    let text = "G21 G90 G93\nG0 X10 Y100 Z-50\nG1 X20 F2\nG1 X280 Y190 F0.5\nM2\n";
    let options = ProgramOptions { residual_mm: 1e-4, ..ProgramOptions::default() };
    let new = rewritten(&machine, text, Control::LinuxCnc, &options);
    let feeds = new.lines().skip(2).filter_map(|l| l.split('F').nth(1));
    let minutes: f64 = feeds.map(|f| 1.0 / f.trim().parse::<f64>().unwrap()).sum();
    assert!(new.lines().count() > 6, "{new}");
    assert!((minutes - 2.5).abs() < 1e-4, "{minutes}: {new}");
}

/// Three axes: a circle in four quadrants, corners, and an axis that stands before it turns. Five:
/// X, Y and Z swing while the tip goes straight on.
const TURNS: [(&str, &str, &str); 2] = [
    (
        "three-axis-mill",
        "mill.ngc",
        "G21 G90 G94 F500\nG0 X100 Y100 Z-50\nG1 X110 Y110\nG3 X110 Y110 I20 J0\nG1 X120\nX115 Y112\n\
         Y100\nX118\nG2 X118 Y140 I0 J20 Z-55\nM2\n",
    ),
    (
        "xkas2525",
        "gantry.nc",
        "G21 G90 G94\nG43.4 H1\nG0 X100. Y10. Z20. A10. C-40.\nG1 X102. C-35. F600.\nX60. C40. A20.\n\
         X50. Y30. C-30. A-15.\nG2 X90. Y30. I20. J0. C10.\nX50.0 Y30. I-20. J0. C-20. A5.\nM30\n",
    ),
];

#[test]
fn law_at_turning_points_both_sides_are_met() {
    for (name, file, text) in TURNS {
        let control = if file.ends_with("ngc") { Control::LinuxCnc } else { Control::Fanuc };
        let machine = with_lost_motion(&machine(name), 4e-3);
        let five = machine.axes().len() == 5;
        for increments in [None, Some(Increments::default())] {
            let options = ProgramOptions { increments, ..ProgramOptions::default() };
            let (done, problems) = compensated(&machine, text.as_bytes(), control, &options);
            let Some(done) = done else { panic!("{name} {:?}", codes(&problems)) };
            let after = done.proof.after;
            let (rounding, exact) = if increments.is_some() { (1e-3, 1e-3) } else { (0.0, 1e-9) };
            println!("{name} {increments:?}: {} pieces {after:?}", done.found.pieces);
            if five && increments.is_some() {
                // Rounded angles move X, Y and Z under the tip: an axis that hardly moves may come from
                // the other side, which is counted, and no more than the lost motion is left.
                let left = 4.5e-3 + 1e-3;
                assert!(done.found.undecided > 0 && after.tip_end.value <= left, "{after:?}");
                continue;
            }
            assert_eq!(done.found.undecided, 0, "{name}");
            assert!(after.tip_end.value <= exact, "{name} {after:?}");
            // The lost motion of 4 µm would show anywhere near a turn.
            assert!(after.tip.value <= 1e-3 + rounding, "{name} {after:?}");
        }
    }
}

/// The actual tips of a program with feed, so densely that each of its blocks has 1000 places.
struct Tips(Vec<Vec3>);

impl Observer for Tips {
    fn path(&mut self, batch: &Batch<'_>) {
        for (i, node) in batch.nodes.iter().enumerate().filter(|(_, n)| !n.is_rapid()) {
            let pose = batch.deviation(i);
            if node.origin.line > 0 {
                self.0.push(pose.nominal_tip.vector() + pose.tip_mm);
            }
        }
    }
}

fn tips(machine: &Machine, file: &str, text: &[u8], control: Control, least: u32) -> Vec<Vec3> {
    let program = Program::new(file, text.to_vec(), control);
    let (chord_mm, angle_rad, spacing_mm) = (1e-6, 1.0, 1e9);
    let densify = Densify::Places { chord_mm, angle_rad, spacing_mm, least };
    let mut found = Tips(Vec::new());
    let options = Options { densify, ..Options::default() };
    simulate(machine, &program, &SetUp::default(), &options, &mut [&mut found]);
    found.0
}

/// The programmed way is lines between the ends of blocks: with tool-centre point, or with three axes.
const LINES: [(&str, &str, &str); 2] = [
    (
        "three-axis-mill",
        "lines.ngc",
        "G21 G90 G94 F500\nG0 X-280 Y-150 Z-50\nG1 X-270\nX280 Y150\nX0 Y-150 Z-200\nM2\n",
    ),
    (
        "xkas2525",
        "lines.nc",
        "G21 G90 G94\nG43.4 H1\nG0 X100. Y10. Z20. A10. C-40.\nG1 X102. F600.\nX-60. C40. A20.\n\
         X-50. Y130. Z80. C-30. A-15.\nX200. A5.\nM30\n",
    ),
];

#[test]
fn law_no_piece_leaves_the_residual_at_1000_places() {
    for (name, file, text) in LINES {
        let control = if file.ends_with("ngc") { Control::LinuxCnc } else { Control::Fanuc };
        let stated = with_lost_motion(&machine(name), 0.0);
        let ends = tips(&bare(name), file, text.as_bytes(), control, 1);
        assert!(ends.len() >= 3, "{name} {}", ends.len());
        for residual_mm in [1e-3, 2e-4] {
            let options =
                ProgramOptions { increments: None, residual_mm, ..ProgramOptions::default() };
            let (done, problems) = compensated(&stated, text.as_bytes(), control, &options);
            let Some(done) = done else { panic!("{name} {:?}", codes(&problems)) };
            // Lines of the proof do not hide the first block: it begins after a corrected rapid.
            let places = tips(&stated, file, &done.text, control, 1000);
            let off = |p: &Vec3| {
                let each = ends.windows(2).map(|w| {
                    let way = w[1] - w[0];
                    let u = (p - w[0]).dot(&way) / way.norm_squared();
                    (p - (w[0] + way * u.clamp(0.0, 1.0))).norm()
                });
                each.fold(f64::INFINITY, f64::min)
            };
            // The first block leads to the first of the ends.
            let from = places.iter().position(|p| (p - ends[0]).norm() < 1e-8).unwrap();
            let worst = places[from..].iter().map(off).fold(0.0, f64::max);
            let pieces = done.found.pieces;
            println!("{name} residual {residual_mm}: {pieces} pieces leave {worst:.2e} mm");
            assert!(worst <= residual_mm, "{name} {residual_mm}: {worst}");
            assert!(places.len() - from >= 1000 * (ends.len() - 1));
            assert!(pieces as usize > ends.len(), "{name}: nothing was cut");
        }
    }
}

/// Two turns of radius 50 mm as pieces whose sagitta is the residual: π/acos(1 − ε/r) of them for a
/// turn, 497 for 1 µm, and no place of the written program farther from the circle than 1 µm.
/// On a small ring the tool turns by 30 µrad in each µm of its path: what rounding shifts the tip along the path is no wrong axis, however long
/// the blocks are. Held to increments of 10 nm the axis keeps its residual at the nearest place, too.
#[test]
fn law_a_small_ring_is_proved_at_every_length_of_its_blocks() {
    let machine = machine("i5-engraver");
    let ring = |step_deg: f64| {
        let count = (360.0 / step_deg) as usize;
        let at = |k: usize| {
            let angle = (k as f64 * step_deg).to_radians();
            let (x, y, c) = (30.0 * angle.cos(), 30.0 * angle.sin(), angle.to_degrees() + 90.0);
            format!("G1 X{x:.4} Y{y:.4} Z14. A65. C{c:.4} F1500.\n")
        };
        let moves: String = (0..=count).map(at).collect();
        format!(
            "%\nO1\nG21 G17 G40 G80 G90 G94\nG43.4 H1 Z60.\nG0 X57. Y0. Z30. A65. C90.\n{moves}G0 Z60.\nG49\nM30\n%\n"
        )
    };
    let fine = Some(Increments { linear_mm: 1e-5, rotary_deg: 1e-6 });
    for (step_deg, increments) in
        [(0.5, ProgramOptions::default().increments), (2.0, None), (1.0, fine), (3.0, fine)]
    {
        let options = ProgramOptions { increments, ..ProgramOptions::default() };
        let (done, problems) =
            compensated(&machine, ring(step_deg).as_bytes(), Control::Fanuc, &options);
        let done = done.unwrap_or_else(|| panic!("{step_deg}: {:?}", codes(&problems)));
        assert!(done.is_proved(), "{step_deg} {increments:?}: {:?}", done.proof.after);
        assert!(done.proof.before.tip_end.value > 0.01, "{:?}", done.proof.before);
    }
}

#[test]
fn circles_are_cut_by_their_sagitta() {
    let text = "G21 G90 G94 F1000\nG0 X50 Y0 Z-50\nG3 X50 Y0 I-50 J0\nG3 X50 Y0 I-50 J0\nM2\n";
    // An ellipse that no circle keeps within the residual: squareness leaves 5 µm on this radius.
    let description = "[machine]\nname = \"m\"\nchain = \"w X' Y' b Z t\"\n\
                       [location]\nEC0X = \"200 urad\"\n";
    let machine = Machine::check("m.toml", description, &NoTables).0.unwrap();
    for (increments, places) in [(None, 1e-3), (Some(1e-4), 1e-3 - 0.5 * 3_f64.sqrt() * 1e-4)] {
        let increments =
            increments.map(|linear_mm| Increments { linear_mm, ..Increments::default() });
        let options = ProgramOptions { increments, ..ProgramOptions::default() };
        let (done, problems) = compensated(&machine, text.as_bytes(), Control::LinuxCnc, &options);
        let Some(done) = done else { panic!("{:?}", codes(&problems)) };
        assert_eq!(done.found.circles, 2);
        let least = TAU / (1.0 - places / 50.0_f64).acos();
        let pieces = done.found.pieces as f64;
        let radius = |p: &Vec3| p.x.hypot(p.y) - 50.0;
        let all = tips(&machine, "c.ngc", &done.text, Control::LinuxCnc, 100);
        let begin = all.iter().position(|p| radius(p).abs() < 2e-3).unwrap();
        let worst = all[begin..].iter().map(|p| radius(p).abs()).fold(0.0, f64::max);
        println!("{increments:?}: {pieces} pieces, {least:.1} at least, {worst:.3e} mm");
        assert!(pieces >= least && pieces <= 1.03 * least + 4.0, "{pieces} {least}");
        assert!(worst <= 1e-3 && worst > 0.85 * places, "{worst}");
    }
}

/// Lines and circles anywhere on machines with any squareness and straightness: no place is farther
/// from the programmed element than the residual, and circles get hardly more pieces than their
/// sagitta asks for.
#[test]
fn law_random_elements_keep_the_residual_with_few_pieces() {
    let mut random = library::Random(17);
    let (mut cut, mut most) = (0, 0.0_f64);
    for case in 0..24 {
        let mut between = |low: f64, high: f64| low + (high - low) * random.unit();
        let residual_mm = [3e-4, 1e-3, 3e-3][case % 3];
        let description = format!(
            "[machine]\nname = \"m\"\nchain = \"w X' Y' b Z t\"\n[location]\nEC0X = \"{} urad\"\n\
             [motion.X]\nEYX = {{ polynomial = [\"0 um\", \"1 um\", \"{} um\"], scale = \"100 mm\" }}\n",
            between(100.0, 400.0),
            between(-8.0, 8.0)
        );
        let machine = Machine::check("m.toml", &description, &NoTables).0.unwrap();
        let (radius, from) = (between(20.0, 120.0), between(0.0, TAU));
        let sweep = between(1.0, 6.0);
        let center = [between(-50.0, 50.0), between(-50.0, 50.0)];
        let at = |angle: f64| [center[0] + radius * angle.cos(), center[1] + radius * angle.sin()];
        let ([x0, y0], [x1, y1]) = (at(from), at(from + sweep));
        let (i, j) = (center[0] - x0, center[1] - y0);
        let far = [x1 + between(50.0, 200.0), y1 + between(-100.0, 100.0)];
        let text = format!(
            "G21 G90 G94 F1000\nG0 X{x0:.9} Y{y0:.9} Z-50\nG3 X{x1:.9} Y{y1:.9} I{i:.9} J{j:.9}\n\
             G1 X{:.9} Y{:.9}\nM2\n",
            far[0], far[1]
        );
        let options = ProgramOptions { increments: None, residual_mm, ..ProgramOptions::default() };
        let (done, problems) = compensated(&machine, text.as_bytes(), Control::LinuxCnc, &options);
        let Some(done) = done else { panic!("{:?}\n{text}", codes(&problems)) };
        let all = tips(&machine, "c.ngc", &done.text, Control::LinuxCnc, 50);
        let way = Vec3::new(far[0] - x1, far[1] - y1, 0.0);
        let off = |p: &Vec3| {
            let arm = [p.x - center[0], p.y - center[1]];
            let turned = (arm[1].atan2(arm[0]) - from).rem_euclid(TAU);
            let on_circle = turned < sweep + 1e-3 || turned > TAU - 1e-3;
            let circle = if on_circle { (arm[0].hypot(arm[1]) - radius).abs() } else { 1.0 };
            let begin = p - Vec3::new(x1, y1, p.z);
            let u = (begin.dot(&way) / way.norm_squared()).clamp(0.0, 1.0);
            circle.min((begin - way * u).norm())
        };
        let begin = all.iter().position(|p| off(p) < 1e-8).unwrap();
        let worst = all[begin..].iter().map(off).fold(0.0, f64::max);
        assert!(worst <= residual_mm, "case {case}: {worst} of {residual_mm}\n{text}");
        if done.found.circles > 0 {
            let least = sweep / 2.0 / (1.0 - residual_mm / radius).acos();
            // The rapid, and the line with what straightness asks of it.
            let pieces = done.found.pieces as f64 - 1.0 - 12.0;
            most = most.max(pieces / least);
            assert!(pieces <= 1.25 * least, "case {case}: {pieces} pieces, {least} at least");
            cut += 1;
        }
    }
    println!("{cut} circles cut, at most {most:.3} times the least number of pieces");
    assert!(cut >= 12, "{cut}");
}

/// A mill whose head turns, 100 µrad out of square about X; `tool` is its section, or nothing.
fn head_mill(tool: &str) -> Machine {
    let text = format!(
        "[machine]\nname = \"m\"\nchain = \"w X b Y Z B t\"\n[location]\nEA0Z = \"100 urad\"\n{tool}"
    );
    Machine::check("m.toml", &text, &NoTables).0.unwrap()
}

#[test]
fn a_tool_length_that_matters_is_stated_by_somebody() {
    let tcp = b"G21 G90 G17 G94\nT1 M6\nG43.4 H1\nG1 X0 Y0 Z0 B0 F1000\nX10 B10\nG49\nM30\n";
    let plain = b"G21 G90 G17 G94\nT1 M6\nG43 H1\nG1 X0 Y0 Z0 F1000\nX10\nG49\nM30\n";
    let length = "[tool]\nlength = \"0 mm\"\n";
    let refused = |machine: &Machine, text: &[u8], residual_mm: f64| {
        let options = ProgramOptions { residual_mm, ..ProgramOptions::default() };
        let problems = compensated(machine, text, Control::Fanuc, &options).1;
        let found = problems.iter().find(|d| d.code == "tool-length-needed");
        found.map(|d| (d.place.line, d.message.clone()))
    };
    let (line, _) = refused(&head_mill(""), tcp, 1e-3).expect("axes depend on the length");
    assert_eq!(line, 3);
    // 100 mm · 100 µrad = 10 µm.
    let (_, message) = refused(&head_mill(""), plain, 1e-3).expect("the errors depend on it");
    assert!(message.contains("10.0 µm"), "{message}");
    assert_eq!(refused(&head_mill(""), plain, 0.011), None);
    // A length of 0 that is stated is a length.
    assert_eq!(refused(&head_mill(length), tcp, 1e-3), None);
    assert_eq!(refused(&head_mill("").with_tip(Vec3::new(0.0, 0.0, -50.0)), tcp, 1e-3), None);
}

#[test]
fn a_length_that_is_not_on_is_named_where_the_proof_fails() {
    let mill = head_mill("[tool]\nlength = \"90 mm\"\n");
    let tool = |length: f64| SetUpTool {
        tip_mm: Vec3::new(0.0, 0.0, -length),
        diameter_mm: Some(10.0),
        ..SetUpTool::default()
    };
    let setup = SetUp {
        tools: [(1, tool(90.0)), (2, tool(60.0))].into_iter().collect(),
        ..SetUp::default()
    };
    let told = |text: &str, setup: &SetUp| {
        let program = Program::new("p.nc", text.as_bytes().to_vec(), Control::Fanuc);
        let done = compensate_program(&mill, &program, setup, &ProgramOptions::default());
        let Some(rewritten) = done.0 else { panic!("{text} {:?}", done.1) };
        let found = rewritten.unproved.iter().find(|d| d.code == "tool-length-differs");
        assert_eq!(found.is_none(), rewritten.is_proved(), "{text}");
        found.map(|d| (d.place.line, d.message.clone()))
    };
    let cut = "G21 G90 G17 G94\nT1 M6\nG0 X5 Y0\n(on)\nG0 Z5\nG1 Z0 F1000\nX10\nG0 Z50\nM30\n";
    // The rapids before it need no length.
    assert_eq!(told(&cut.replace("(on)", "G43 H1"), &setup), None);
    let (line, message) = told(cut, &setup).expect("no length is on");
    assert_eq!(line, 6);
    assert!(message.contains("90 mm long") && message.contains("no tool length"), "{message}");
    let (line, message) = told(&cut.replace("(on)", "G43 H2"), &setup).expect("that of another");
    assert_eq!(line, 6);
    assert!(message.contains("90 mm long") && message.contains("is 60 mm"), "{message}");
    // As the hint says.
    assert_eq!(told(cut, &SetUp::default()), None);
}
