//! NC programs on machines: laws, and files of others.

#![allow(clippy::print_stdout, reason = "tells what was found in files of others")]

use proptest::prelude::*;
use std::path::Path;
use trueaxis::files::disk;
use trueaxis::geometry::Vec3;
use trueaxis::machine::Machine;
use trueaxis::machine::file::NoTables;
use trueaxis::nc::{Control, Program};
use trueaxis::simulate::{Batch, Densify, Observer, Options, Run, SetUp, simulate};

/// Everything that the tests look at, node by node.
#[derive(Default)]
struct Nodes {
    tips: Vec<Vec3>,
    axes: Vec<Vec3>,
    commands: Vec<[f64; 6]>,
    lines: Vec<u32>,
    last: Vec<bool>,
    times_s: Vec<f64>,
}

impl Observer for Nodes {
    fn path(&mut self, batch: &Batch<'_>) {
        for (i, node) in batch.nodes.iter().enumerate() {
            let deviation = batch.deviation(i);
            self.tips.push(deviation.nominal_tip.vector());
            self.axes.push(deviation.nominal_axis.vector());
            self.commands.push(node.command);
            self.lines.push(node.origin.line);
            self.last.push(node.last);
            self.times_s.push(batch.stamps[i].time_s);
        }
    }
}

fn machine(text: &str) -> Machine {
    let (machine, problems) = Machine::check("machine.toml", text, &NoTables);
    machine.unwrap_or_else(|| panic!("{problems:?}"))
}

fn walk(machine: &Machine, control: Control, text: Vec<u8>, options: &Options) -> (Nodes, Run) {
    let program = Program::new("program", text, control);
    let mut nodes = Nodes::default();
    let run = simulate(machine, &program, &SetUp::default(), options, &mut [&mut nodes]);
    (nodes, run)
}

fn undivided() -> Options {
    Options { densify: Densify::Off, keep_going: true, ..Options::default() }
}

const GANTRY: &str = "[machine]\nname = \"gantry\"\nchain = \"w b X Y Z C A t\"\n\
                      [axis.C]\ntravel = \"unlimited\"\n[tool]\nlength = \"100 mm\"\n";

const TABLE: &str = "[machine]\nname = \"table\"\nchain = \"w C' A' b X Y Z t\"\n\
                     [axis.C]\ntravel = \"unlimited\"\n[tool]\nlength = \"100 mm\"\n";

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// With tool-centre point the tip stays on its programmed line and the rotary axes go evenly,
    /// whatever the machine.
    #[test]
    fn law_the_tip_goes_straight_with_tcp(
        to in prop::array::uniform3(-100.0..100.0_f64),
        a in -80.0..80.0_f64,
        c in -170.0..170.0_f64,
        table in any::<bool>(),
    ) {
        let machine = machine(if table { TABLE } else { GANTRY });
        let [x, y, z] = to;
        let text = format!(
            "G43.4 H1\nG1 F1000 X0 Y0 Z0 A0 C0\nG1 X{x:.4} Y{y:.4} Z{z:.4} A{a:.4} C{c:.4}\nM30\n"
        );
        let (nodes, run) = walk(&machine, Control::Fanuc, text.into_bytes(), &Options::default());
        prop_assert!(!run.problems.has_errors(), "{:?}", run.problems);
        let last = *nodes.tips.last().unwrap();
        let first = nodes.lines.iter().rposition(|l| *l == 2).unwrap();
        let along = (last - nodes.tips[first]).normalize();
        for (tip, command) in nodes.tips.iter().zip(&nodes.commands).skip(first) {
            let off = tip - nodes.tips[first];
            prop_assert!((off - along * off.dot(&along)).norm() < 1e-9);
            // A and C in the same ratio all along.
            let index = |letter| machine.axes().iter().position(|x| x.name.letter() == letter);
            let (qa, qc) = (command[index('A').unwrap()], command[index('C').unwrap()]);
            let (ra, rc) = (a.to_radians(), c.to_radians());
            prop_assert!((qa * rc - qc * ra).abs() < 1e-3);
        }
        prop_assert!((last - Vec3::new(x, y, z)).norm() < 1e-3);
    }

    /// Between its nodes the tip of a machine whose axes go straight leaves the line by no more
    /// than the chord tolerance.
    #[test]
    fn law_the_chord_tolerance_is_kept(
        to in prop::array::uniform3(-60.0..60.0_f64),
        a in -80.0..80.0_f64,
        c in -170.0..170.0_f64,
        chord_mm in 0.001..0.1_f64,
    ) {
        let machine = machine(TABLE);
        let control = trueaxis::machine::tcp::TipControl::of(&machine).unwrap();
        let [x, y, z] = to;
        let text = format!(
            "G43.4 H1\nG1 F1000 X40 Y30 Z20 A10 C20\nG1 X{x:.4} Y{y:.4} Z{z:.4} A{a:.4} C{c:.4}\nM30\n"
        );
        let densify =
            Densify::Tolerance { chord_mm, angle_rad: 0.2, spacing_mm: 1000.0 };
        let options = Options { densify, ..Options::default() };
        let (nodes, _) = walk(&machine, Control::Fanuc, text.into_bytes(), &options);
        let first = nodes.lines.iter().rposition(|l| *l == 2).unwrap();
        let (start, end) = (nodes.tips[first], *nodes.tips.last().unwrap());
        let along = (end - start).try_normalize(1e-9).unwrap_or(Vec3::x());
        for pair in nodes.commands[first..].windows(2) {
            for k in 1..8 {
                let u = f64::from(k) / 8.0;
                let between = std::array::from_fn(|i| pair[0][i] + (pair[1][i] - pair[0][i]) * u);
                let off = control.tip_and_axis(&between).0 - start;
                let across = (off - along * off.dot(&along)).norm();
                prop_assert!(across < 1.01 * chord_mm, "{across} {chord_mm}");
            }
        }
    }

    /// Circles stay circles: every node lies on the programmed arc, and chords keep the tolerance, scaled by the program or
    /// not.
    #[test]
    fn law_arcs_are_round(
        radius in 0.5..200.0_f64,
        sweep in 5.0..355.0_f64,
        ccw in any::<bool>(),
        scale in prop::sample::select(vec![0.05, 1.0, 4.0, 50.0]),
    ) {
        let machine = machine(GANTRY);
        let (sin, cos) = (if ccw { sweep } else { -sweep }).to_radians().sin_cos();
        let code = if ccw { 3 } else { 2 };
        let r = radius / scale;
        let text = format!(
            "G51 X0 Y0 Z0 P{scale:.3}\nG1 F500 X{r:.9} Y0\nG{code} X{:.9} Y{:.9} I{:.9} J0\nM30\n", r * cos, r * sin, -r
        );
        let (nodes, run) = walk(&machine, Control::Fanuc, text.into_bytes(), &Options::default());
        prop_assert!(!run.problems.has_errors(), "{:?}", run.problems);
        let first = nodes.lines.iter().rposition(|l| *l == 2).unwrap();
        let tips = &nodes.tips[first..];
        for tip in tips {
            prop_assert!((tip.xy().norm() - radius).abs() < 1e-5);
        }
        for pair in tips.windows(2) {
            let sagitta = radius - (0.5 * (pair[0] + pair[1])).xy().norm();
            prop_assert!(sagitta < 0.005 + 1e-5);
        }
    }
}

/// The bytes of an outside file, or `None` with a message where it is absent.
fn outside(path: &str) -> Option<Vec<u8>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/outside");
    let file = root.join(path);
    let bytes = std::fs::read(&file).ok();
    if bytes.is_none() {
        println!("skipped: {path} is not available");
    }
    bytes
}

/// A table with two rotary axes whose senses are given: +1 turns the table the positive way.
fn turning_table(tilting: char, senses: [i32; 2]) -> Machine {
    let [tilt, turn] = senses;
    machine(&format!(
        "[machine]\nname = \"table\"\nchain = \"w C' {tilting}' b X Y Z t\"\n\
         [axis.C]\nsense = {turn}\ntravel = \"unlimited\"\n[axis.{tilting}]\nsense = {tilt}\n"
    ))
}

/// LinuxCNC's two demo boats, for an AC and a BC table, cut the same boat.
///
/// Only where the senses of the four rotary axes fit do the tool axes agree: LinuxCNC turns its
/// tables the positive way, against ISO 841.
#[test]
fn oracle_the_two_boats_of_linuxcnc_have_their_tool_axes_in_common() {
    let folder = "nc/LinuxCNC__linuxcnc";
    let (Some(ac), Some(bc)) = (
        outside(&format!("{folder}/boat-xyzac.ngc")),
        outside(&format!("{folder}/boat-xyzbc.ngc")),
    ) else {
        return;
    };
    let common = |ac_senses: [i32; 2], bc_senses: [i32; 2]| {
        let (a, _) =
            walk(&turning_table('A', ac_senses), Control::LinuxCnc, ac.clone(), &undivided());
        let (b, _) =
            walk(&turning_table('B', bc_senses), Control::LinuxCnc, bc.clone(), &undivided());
        let tilted = (0..a.tips.len()).filter(|i| a.last[*i] && a.axes[*i].z < 0.999_999);
        tilted
            .filter(|i| {
                let same_tip = |j: &usize| (a.tips[*i] - b.tips[*j]).norm() < 1e-3;
                let same_axis = |j: usize| (a.axes[*i] - b.axes[j]).norm() < 5e-4;
                (0..b.tips.len()).filter(same_tip).any(same_axis)
            })
            .count()
    };
    let senses = [1, -1].map(|tilt| [1, -1].map(|turn| [tilt, turn])).concat();
    for ac_senses in &senses {
        for bc_senses in &senses {
            let count = common(*ac_senses, *bc_senses);
            println!("A C {ac_senses:?}, B C {bc_senses:?}: {count} tilted points in common");
            // Mirror images of LinuxCNC's own combination fit as well.
            let fits = ac_senses[1] == bc_senses[1] && ac_senses[0] * bc_senses[0] == ac_senses[1];
            if fits {
                assert!(count >= 1400, "{count}");
            } else {
                assert!(count < 100, "{ac_senses:?} {bc_senses:?} {count}");
            }
        }
    }
}

/// A program for a BC table, made by others from cutter locations that are available too.
///
/// The table stands 40.5 mm above the B axis and turns the positive way; with that all 41,494 tips
/// are met to the rounding of the program (three decimals). Its angles do not follow the normals of
/// the cutter locations: that is reported, not hidden.
#[test]
fn oracle_simple_curve_meets_its_cutter_locations() {
    let folder = "zhangty019__MultiAxis_3DP_MotionPlanning";
    let Some(program) = outside(&format!("nc/{folder}/simple_curve_Gcode.txt")) else { return };
    let mut locations = Vec::new();
    for i in 0..20 {
        let Some(text) = outside(&format!("cl/{folder}/simple_curve/{i}.txt")) else { return };
        for line in String::from_utf8(text).unwrap().lines() {
            let numbers = line.split_whitespace().map(|w| w.parse::<f64>().unwrap());
            locations.push(numbers.collect::<Vec<_>>());
        }
    }
    let text = "[machine]\nname = \"BC table\"\nchain = \"w C' B' b X Y Z t\"\n\
                [axis.C]\nsense = 1\ntravel = \"unlimited\"\n[axis.B]\nsense = 1\n\
                [workpiece]\nplacement = \"0 0 40.5 mm\"\n";
    let table = machine(text);
    // The moves that extrude are the cutter locations, in their order.
    let lines: Vec<bool> = program
        .split(|b| *b == b'\n')
        .map(|l| l.starts_with(b"G1 X") && l.contains(&b'E'))
        .collect();
    let (nodes, _) = walk(&table, Control::LinuxCnc, program, &undivided());
    let (mut met, mut worst_mm, mut sum_mm, mut off_deg) = (0, 0.0_f64, 0.0, Vec::new());
    for (i, line) in nodes.lines.iter().enumerate() {
        if !nodes.last[i] || !lines[*line as usize - 1] {
            continue;
        }
        let wanted = &locations[met];
        let distance = (nodes.tips[i] - Vec3::new(wanted[0], wanted[1], wanted[2])).norm();
        (worst_mm, sum_mm) = (worst_mm.max(distance), sum_mm + distance);
        let normal = Vec3::new(wanted[3], wanted[4], wanted[5]).normalize();
        off_deg.push(normal.dot(&nodes.axes[i]).clamp(-1.0, 1.0).acos().to_degrees());
        met += 1;
    }
    off_deg.sort_by(f64::total_cmp);
    println!(
        "{met} tips: mean {:.6} mm, worst {worst_mm:.6} mm; tool axis off the normals by {:.3} deg \
         (median), {:.3} deg (worst)",
        sum_mm / f64::from(met as u32),
        off_deg[met / 2],
        off_deg[met - 1]
    );
    assert_eq!(met, locations.len());
    // Three decimals of X, Y, Z, and of angles at 60 mm from the axes.
    assert!(worst_mm < 0.0013, "{worst_mm}");
    // DIFFERENCE: the program of others smooths or clips its angles; some normals point down.
    assert!(off_deg[met / 2] > 0.1 && off_deg[met - 1] > 90.0);
}

#[test]
fn the_way_begins_where_the_axes_stand() {
    let machine = machine(GANTRY);
    let text = b"G21 G90\nG1 X100. F1000.\nM30\n".to_vec();
    let program = Program::new("program", text, Control::Fanuc);
    let mut summary = trueaxis::simulate::Summary::of(&machine);
    simulate(&machine, &program, &SetUp::default(), &undivided(), &mut [&mut summary]);
    assert_eq!(summary.feed_mm, 100.0);
    let x = machine.axes().iter().position(|a| a.name.letter() == 'X').unwrap();
    assert_eq!((summary.axes[x].lowest, summary.axes[x].highest), (0.0, 100.0));
}

#[test]
fn a_move_of_a_million_turns_is_refused_not_stored() {
    let text = b"G43.4 H1\nG1 X10. C1000000000. F1000.\nM30\n".to_vec();
    let (nodes, run) = walk(&machine(TABLE), Control::Fanuc, text, &Options::default());
    assert_eq!(run.problems.iter().filter(|d| d.code == "too-many-pieces").count(), 1);
    assert!(nodes.tips.len() < 10);
}

/// A machine whose workpiece frame is turned, with a set-up.
fn turned_head() -> (Machine, SetUp) {
    let machine = machine(
        "[machine]\nname = \"turned\"\nchain = \"w C' b X Y Z B t\"\n\
         [axis.C]\ntravel = \"unlimited\"\n\
         [workpiece]\nplacement = \"20 -10 60 mm\"\nmounting = [\"turn Z 15 deg\"]\n",
    );
    let text = "[tool.1]\nlength = \"100 mm\"\n[tool.2]\nlength = \"150 mm\"\n\
                [work_offset.G54]\nX = \"12 mm\"\nY = \"-7 mm\"\nZ = \"-60 mm\"\n";
    let (setup, problems) =
        trueaxis::simulate::parse_setup(&disk(), "setup", text, Path::new(""), &machine);
    (machine, setup.unwrap_or_else(|| panic!("{problems:?}")))
}

#[test]
fn q_parameters_of_a_plane_count_from_the_set_up() {
    // A+20 tilts the normal to (0, −sin 20°, cos 20°): C = −90°, B = 20°, however the workpiece
    // frame is turned on the table.
    let (machine, setup) = turned_head();
    let text = b"BEGIN PGM Q MM\nCYCL DEF 19.0 WORKING PLANE\nCYCL DEF 19.1 A+20\n\
                 L C+Q122 B+Q121 F1000\nEND PGM Q MM\n";
    let program = Program::new("q.h", text.to_vec(), Control::Heidenhain);
    let mut nodes = Nodes::default();
    simulate(&machine, &program, &setup, &undivided(), &mut [&mut nodes]);
    let end = nodes.commands.last().unwrap();
    let angle = |letter: char| {
        let i = machine.axes().iter().position(|a| a.name.letter() == letter).unwrap();
        end[i].to_degrees()
    };
    assert!((angle('C') + 90.0).abs() < 1e-9 && (angle('B') - 20.0).abs() < 1e-9);
}

#[test]
fn a_tool_change_under_tcp_moves_no_axis() {
    let (machine, setup) = turned_head();
    let text = b"G54\nT1 M6\nD1\nTRAORI\nG1 X0 Y0 Z5 B30 C0 F1000\nT2 M6 D1\nG1 X20\nM30\n";
    let program = Program::new("t.mpf", text.to_vec(), Control::Sinumerik840d);
    let mut nodes = Nodes::default();
    simulate(&machine, &program, &setup, &undivided(), &mut [&mut nodes]);
    let z = machine.axes().iter().position(|a| a.name.letter() == 'Z').unwrap();
    let at = |line: u32| {
        let i = nodes.lines.iter().rposition(|l| *l == line).unwrap();
        nodes.commands[i][z]
    };
    assert!((at(7) - at(5)).abs() < 1e-9, "{} {}", at(5), at(7));
}

#[test]
fn over_travel_on_a_machine_with_tables_is_an_issue_not_an_error() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../machines/xkas2525/machine.toml");
    let machine = trueaxis::files::machine(path.as_ref()).0.unwrap();
    let text = b"G1 X100. Y100. Z-100. F1000\nG1 Y-20.\nM30\n".to_vec();
    let program = Program::new("program", text, Control::Fanuc);
    let mut watch = trueaxis::simulate::AxisWatch::on(&machine);
    let options = Options::default();
    let run = simulate(&machine, &program, &SetUp::default(), &options, &mut [&mut watch]);
    assert!(!run.problems.has_errors(), "{:?}", run.problems);
    assert!(trueaxis::simulate::IssueList::of([watch.log]).is_critical());
}

/// Axes that are not square: where TCP begins, an axis that is not named must stay.
#[test]
fn law_tcp_begins_where_the_tip_is_also_on_skew_axes() {
    let machine = machine(
        "[machine]\nname = \"skew\"\nchain = \"w b X Y Z C A t\"\n\
         [axis.Y]\ndirection = \"0.2 1 0\"\n[axis.C]\ntravel = \"unlimited\"\n",
    );
    let text = "[tool.1]\nlength = \"100 mm\"\n[work_offset.G54]\nX = \"5 mm\"\n";
    let setup =
        trueaxis::simulate::parse_setup(&disk(), "setup", text, Path::new(""), &machine).0.unwrap();
    let text = b"G54\nT1 M6\nD1\nG1 X10 Y50 Z5 F1000\nTRAORI\nG1 X20\nM30\n";
    let program = Program::new("t.mpf", text.to_vec(), Control::Sinumerik840d);
    let mut nodes = Nodes::default();
    let run = simulate(&machine, &program, &setup, &undivided(), &mut [&mut nodes]);
    assert!(!run.problems.has_errors(), "{:?}", run.problems);
    let y = machine.axes().iter().position(|a| a.name.letter() == 'Y').unwrap();
    let at = |line: u32| nodes.lines.iter().rposition(|l| *l == line).unwrap();
    assert!((nodes.commands[at(4)][y] - 50.0).abs() < 1e-9);
    assert!((nodes.commands[at(6)][y] - 50.0).abs() < 1e-9, "{}", nodes.commands[at(6)][y]);
}

/// The deviation along feed, normal and binormal is the deviation itself, seen in a frame whose
/// first axis is the way of the nominal tip and whose second stands towards the spindle.
#[test]
fn law_the_split_along_the_path_is_the_whole_deviation() {
    #[derive(Default)]
    struct Split(Option<Vec3>, usize);
    impl Observer for Split {
        fn path(&mut self, batch: &Batch<'_>) {
            for i in 0..batch.nodes.len() {
                let d = batch.deviation(i);
                let (tip, along) = (d.nominal_tip.vector(), batch.along_path_mm[i]);
                assert!((along.norm() - d.tip_mm.norm()).abs() < 1e-12);
                if let Some(way) = self.0.and_then(|b| (tip - b).try_normalize(1e-9)) {
                    let normal = d.nominal_axis.vector() - way * way.dot(&d.nominal_axis.vector());
                    assert!((along.x - d.tip_mm.dot(&way)).abs() < 1e-12);
                    if let Some(normal) = normal.try_normalize(1e-6) {
                        assert!((along.y - d.tip_mm.dot(&normal)).abs() < 1e-12);
                        let across = way.cross(&normal);
                        assert!((along.z - d.tip_mm.dot(&across)).abs() < 1e-12);
                        self.1 += 1;
                    }
                }
                self.0 = Some(tip);
            }
        }
    }
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../machines/i5-engraver/machine.toml");
    let machine = trueaxis::files::machine(path.as_ref()).0.unwrap();
    let text = b"G43.4 H1\nG1 F1000 X20 Y5 Z3 A20 C30\nG1 X-20 Y9 Z8 A-10 C80\nM30\n".to_vec();
    let program = Program::new("p", text, Control::Fanuc);
    let mut split = Split::default();
    simulate(&machine, &program, &SetUp::default(), &Options::default(), &mut [&mut split]);
    assert!(split.1 > 50, "{}", split.1);
}
