//! Tool setting: the programs of all controls, what they write and refuse, and what their logs say.

mod library;

use library::{Random, machine, machine_path, root};
use std::path::Path;
use std::process::Command;
use trueaxis::files::disk;
use trueaxis::identify::surface::parse_log;
use trueaxis::identify::tool_setting::{ToolReadings, measured_tools};
use trueaxis::input::Diagnostics;
use trueaxis::machine::Machine;
use trueaxis::nc::{Control, Program};
use trueaxis::plan::tool_setting::{
    ToolSetting, TouchOf, check_setting, setting_program, tool_setting,
};
use trueaxis::simulate::{Options, SetUp, parse_setup, simulate};

const CONTROLS: [Control; 5] =
    [Control::Fanuc, Control::Haas, Control::Sinumerik840d, Control::LinuxCnc, Control::Heidenhain];

fn example() -> String {
    std::fs::read_to_string(root().join("examples/04_plan/tool-setting.setup.toml")).unwrap()
}

fn setting_of(machine: Machine, text: &str, numbers: &[u32]) -> Result<ToolSetting, Diagnostics> {
    let (setup, mut problems) = parse_setup(&disk(), "s.toml", text, Path::new(""), &machine);
    let Some(setup) = setup else { return Err(problems) };
    let path = machine_path("i5-engraver");
    tool_setting((machine, &path), (setup, "s.toml"), numbers, &mut problems).ok_or(problems)
}

fn setting(text: &str) -> ToolSetting {
    setting_of(machine("i5-engraver"), text, &[]).unwrap_or_else(|p| panic!("{p:?}"))
}

fn text(setting: &ToolSetting, control: Control) -> String {
    String::from_utf8(setting_program(setting, control).unwrap()).unwrap()
}

/// The log that a machine with these lengths and diameters writes, by hand: Z = face + length + drift.
fn log_of(
    setting: &ToolSetting,
    sizes: &[(f64, f64)],
    drift: f64,
    noise: f64,
    dice: &mut Random,
) -> String {
    let mut text = "TRUEAXIS HITS MM MACHINE\n".to_owned();
    for (i, touch) in setting.touches.iter().enumerate() {
        let tool = &setting.tools[touch.tool];
        let (length, diameter) = sizes[touch.tool];
        let [mut x, y, mut z] = setting.axes.map(|axis| touch.before[axis]);
        let reach = 0.5 * (diameter + setting.setter.diameter_mm[0]);
        match touch.of {
            TouchOf::Length => z = setting.setter.at_mm.z + length + drift + noise * dice.normal(),
            TouchOf::Plus => x = setting.setter.at_mm.x + reach + noise * dice.normal(),
            TouchOf::Minus => x = setting.setter.at_mm.x - reach + noise * dice.normal(),
        }
        text += &format!("H{} K{n} T{n} X{x:.6} Y{y:.6} Z{z:.6} A0 C0\n", i + 1, n = tool.number);
    }
    text + &format!("END {}\n", setting.touches.len())
}

fn evaluated(setting: &ToolSetting, log: &str) -> Result<ToolReadings, Diagnostics> {
    let mut problems = Diagnostics::new();
    let log = parse_log("l.log", log, &setting.machine, &mut problems);
    let found = log.and_then(|log| measured_tools(setting, &log, "l.log", &mut problems));
    found.ok_or(problems)
}

/// In every control the program is interpreted without an error, leaves no travel and collides with nothing.
#[test]
fn law_programs_of_all_controls_are_sound() {
    let setting = setting(&example());
    assert_eq!(setting.touches.len(), 8, "gauge, two tools with three touches, one with one");
    for control in CONTROLS {
        let check = check_setting(&setting, control).unwrap();
        assert!(check.is_sound(), "{control:?}: {check:?}");
        // Of HEIDENHAIN the cycles are the control's own: only the way up is interpreted.
        let moves = control == Control::Heidenhain || check.duration_s > 5.0;
        assert!(moves, "{control:?}: {}", check.duration_s);
    }
}

#[test]
fn the_words_of_each_control() {
    let setting = setting(&example());
    for (control, words) in [
        (
            Control::Fanuc,
            [
                "G31 X-150.0000 Y85.0000 Z-22.0000 F50.0",
                "G10 L11 P1 R#102",
                "G10 L13 P1 R#104",
                "#3000=2(TOOL 1 IS BROKEN)",
            ],
        ),
        (
            Control::Haas,
            ["G31", "G10 L11 P1 R#102", "#3006=1(TOOL 1 IS WORN REPLACE IT)", "DPRNT[H1"],
        ),
        (
            Control::Sinumerik840d,
            [
                "MEAS=1",
                "$TC_DP12[1,1]=SET_OFF",
                "$TC_DP15[1,1]=SET_OFF",
                "SETAL(65002,\"TOOL 1 IS BROKEN\")",
            ],
        ),
        (
            Control::LinuxCnc,
            ["G38.2", "G10 L1 P1 Z[90.0000+#102]", "(ABORT, TOOL 1 IS BROKEN)", "(LOG,H1 K12"],
        ),
        (
            Control::Heidenhain,
            ["TCH PROBE 31.0", "TCH PROBE 32.0", "CHECK: 1 Q5", "A TOOL IS BROKEN"],
        ),
    ] {
        let text = text(&setting, control);
        for word in words {
            assert!(text.contains(word), "{control:?}: `{word}` is not in\n{text}");
        }
    }
    // The spindle turns against its cutting sense, but not with the gauge; without a speed not at all.
    let fanuc = text(&setting, Control::Fanuc);
    let (gauge, tools) = fanuc.split_once("T1 M6").unwrap();
    assert!(!gauge.contains("M4") && tools.contains("S600 M4"), "{fanuc}");
    let still = example().replace("speed = \"600 rpm\"", "");
    assert!(!text(&self::setting(&still), Control::Fanuc).contains("M4"));
}

/// Interpreters take a touch as made at the end of its way, 2 mm below the nominal one (but that of the gauge): by the
/// limit of 0.2 mm the tool is broken, and the alarm of each control ends the program. With limits of 3 and 4 mm it goes through.
#[test]
fn a_broken_tool_raises_the_alarm_of_its_control() {
    let mut setting = setting(&example());
    setting.touches[0].beyond = setting.touches[0].expected;
    let run = |setting: &ToolSetting, control: Control| {
        let program = Program::new("t", setting_program(setting, control).unwrap(), control);
        let setup =
            SetUp { work_offsets: Default::default(), workpiece_at: None, ..setting.setup.clone() };
        let run = simulate(&setting.machine, &program, &setup, &Options::default(), &mut []);
        let errors = run.problems.iter().filter(|d| d.severity.to_string() == "error");
        errors.map(|d| d.message.clone()).collect::<Vec<_>>()
    };
    for control in &CONTROLS[..4] {
        let errors = run(&setting, *control);
        let told = errors.iter().any(|e| e.contains("IS BROKEN"));
        assert!(told, "{control:?}: {errors:?}");
        let mut wide = setting.clone();
        for tool in &mut wide.tools {
            tool.state.breakage_mm = Some(4.0);
            tool.state.wear_length_mm = Some(3.0);
            tool.state.wear_radius_mm = Some(3.0);
        }
        assert_eq!(run(&wide, *control), Vec::<String>::new(), "{control:?}");
    }
}

/// The wear that the program of FANUC writes acts: a length that is 10 µm less than nominal (the signal comes 10 µm
/// before the end of the way, so that the way ends 20 µm below) stands in its wear register afterwards.
#[test]
fn the_wear_register_holds_the_deviation() {
    let mut exact = setting(&example());
    for touch in &mut exact.touches {
        touch.beyond = touch.expected;
        if touch.of == TouchOf::Length && exact.tools[touch.tool].number == 1 {
            touch.beyond[exact.axes[2]] -= 0.020;
        }
    }
    exact.setter.reference = None;
    let mut program = text(&exact, Control::Fanuc);
    // Afterwards the length is switched on: the axis stands at tip + length + wear.
    program = program.replace("M30", "G43 H1 G0 Z0.\nM30");
    let program = Program::new("t", program.into_bytes(), Control::Fanuc);
    let setup = SetUp { work_offsets: Default::default(), ..exact.setup.clone() };
    struct Last(f64, usize);
    impl trueaxis::simulate::Observer for Last {
        fn path(&mut self, batch: &trueaxis::simulate::Batch<'_>) {
            self.0 = batch.nodes.last().map_or(self.0, |n| n.command[self.1]);
        }
    }
    let mut last = Last(0.0, exact.axes[2]);
    let run = simulate(&exact.machine, &program, &setup, &Options::default(), &mut [&mut last]);
    assert!(!run.problems.has_errors(), "{:?}", run.problems);
    assert!((last.0 - (90.0 - 0.010)).abs() < 1e-6, "{}", last.0);
}

/// Lengths, diameters and drift that are put in come out, whatever the order of the tools, to the last digit of
/// the log; with noise they lie within U in 95 % of all cases.
#[test]
fn law_lengths_and_diameters_come_back() {
    let setting = setting(&example());
    let mut dice = Random(2);
    let (mut inside, mut all) = (0u32, 0u32);
    for noise in [0.0, 0.5e-3] {
        for _ in 0..400 {
            let drift = dice.within(0.02);
            let gauge = 100.0021 + if noise > 0.0 { 0.4e-3 * dice.normal() } else { 0.0 };
            let setter_off = if noise > 0.0 { 1e-3 * dice.normal() } else { 0.0 };
            let sizes: Vec<(f64, f64)> = setting
                .tools
                .iter()
                .map(|t| match t.is_reference {
                    true => (gauge, 0.0),
                    false => (t.length_mm + dice.within(0.015), 3.0 + dice.within(0.02)),
                })
                .collect();
            // A setter of another diameter than is stated looks like a wider tool.
            let seen: Vec<(f64, f64)> = sizes.iter().map(|(l, d)| (*l, d + setter_off)).collect();
            let log = log_of(&setting, &seen, drift, noise, &mut dice);
            let found = evaluated(&setting, &log).unwrap_or_else(|p| panic!("{p:?}"));
            let truth = setting.tools.iter().zip(&sizes).filter(|(t, _)| !t.is_reference);
            for (tool, (_, (length, diameter))) in found.tools.iter().zip(truth) {
                let values = [(Some(tool.length), *length), (tool.diameter, *diameter)];
                for (value, truth) in values.into_iter().filter_map(|(v, t)| Some((v?, t))) {
                    let off = (value.mm - truth).abs();
                    if noise == 0.0 {
                        assert!(off < 2e-6, "{}: {off}", tool.number);
                    } else {
                        all += 1;
                        inside += u32::from(off <= 1.96 * value.u_mm);
                    }
                }
            }
            if noise == 0.0 {
                assert!((found.drift.unwrap().mm - drift).abs() < 2e-6);
            }
        }
    }
    let share = f64::from(inside) / f64::from(all);
    assert!((0.93..0.97).contains(&share), "{share}");
}

#[test]
fn uncertainties_by_hand() {
    // s = 0.5 µm, u(gauge) = 0.4 µm: √(0.25 + 0.25 + 0.16) = 0.812 µm; u(D) = √(0.5 + 1) = 1.225 µm.
    let with = setting(&example());
    let sizes = [(100.0021, 0.0), (90.0, 3.0), (90.5, 3.0), (85.0, 1.0)];
    let log = log_of(&with, &sizes, 0.0, 0.0, &mut Random(1));
    let found = evaluated(&with, &log).unwrap();
    assert!((found.tools[0].length.u_mm - 0.812_404e-3).abs() < 1e-9);
    assert!((found.tools[0].diameter.unwrap().u_mm - 1.224_745e-3).abs() < 1e-9);
    assert!(found.missing.is_empty(), "{:?}", found.missing);
    // Without a gauge: √(0.25 + 1 + 9/3) = 2.062 µm; without a statement of growth it is named.
    let bare = example().replace("reference = 12 ", "growth_within = \"3 um\" ");
    let bare = setting_of(machine("i5-engraver"), &bare, &[1]).unwrap();
    let log = log_of(&bare, &[(90.0, 3.0)], 0.0, 0.0, &mut Random(1));
    let found = evaluated(&bare, &log).unwrap();
    assert!((found.tools[0].length.u_mm - 4.25_f64.sqrt() * 1e-3).abs() < 1e-9);
    let silent = example().replace("reference = 12 ", "");
    let silent = setting_of(machine("i5-engraver"), &silent, &[1]).unwrap();
    let found = evaluated(&silent, &log).unwrap();
    assert!(found.missing[0].contains("growth of spindle and setter"), "{:?}", found.missing);
}

/// The example: the log of oracles/tool_setting.py, whose truth stands in that script.
#[test]
fn oracle_the_log_of_python() {
    let setting = setting(&example());
    let log =
        std::fs::read_to_string(root().join("examples/05_identify/tool-setting.log")).unwrap();
    let found = evaluated(&setting, &log).unwrap_or_else(|p| panic!("{p:?}"));
    let drift = found.drift.unwrap();
    assert!((drift.mm - 0.0073).abs() < 4.0 * drift.u_mm);
    let truth = [
        (90.0 - 0.0124, Some(2.9864), "fit"),
        (90.5 - 0.0011, Some(2.9993), "fit"),
        (84.6, None, "broken"),
    ];
    for (tool, (length, diameter, word)) in found.tools.iter().zip(truth) {
        assert!((tool.length.mm - length).abs() < 3.0 * tool.length.u_mm, "{tool:?}");
        assert_eq!(tool.standing.word(), word, "{tool:?}");
        assert_eq!(tool.diameter.is_some(), diameter.is_some());
        if let (Some(d), Some(truth)) = (tool.diameter, diameter) {
            assert!((d.mm - truth).abs() < 3.0 * d.u_mm, "{tool:?}");
        }
    }
}

/// LinuxCNC's own interpreter reads the program of LinuxCNC, if it is installed: eight touches, and where they end at
/// the nominal places the tool table gets the nominal lengths (90 mm are 3.5433 inches) and no tool is worn; where
/// tool 3 alone ends 2 mm lower, the program is aborted.
#[test]
#[allow(clippy::print_stderr, reason = "a skipped comparison is reported")]
fn oracle_rs274_reads_the_program() {
    if Command::new("rs274").arg("-h").output().is_err() {
        eprintln!("skipped: rs274 is not installed");
        return;
    }
    let folder = std::env::temp_dir().join(format!("trueaxis-tools-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let table = "T12 P12 Z100\nT1 P1 Z90 D3\nT2 P2 Z90.5 D3\nT3 P3 Z85 D1\n";
    std::fs::write(folder.join("t.tbl"), table).unwrap();
    let run = |setting: &ToolSetting| {
        std::fs::write(folder.join("t.ngc"), text(setting, Control::LinuxCnc)).unwrap();
        let mut rs274 = Command::new("rs274");
        let ran = rs274.args(["-g", "-t", "t.tbl", "t.ngc"]).current_dir(&folder).output().unwrap();
        [ran.stdout, ran.stderr].map(|o| String::from_utf8_lossy(&o).into_owned()).concat()
    };
    let mut exact = setting(&example());
    for touch in &mut exact.touches {
        touch.beyond = touch.expected;
    }
    let said = run(&exact);
    assert_eq!(said.matches("STRAIGHT_PROBE(").count(), 8, "{said}");
    assert!(said.contains("3.5433") && said.contains("END 8") && !said.contains("WORN"), "{said}");
    let last = exact.touches.len() - 1;
    exact.touches[last].beyond[exact.axes[2]] -= 2.0;
    let said = run(&exact);
    assert!(said.contains("TOOL 3 IS BROKEN") && !said.contains("END 8"), "{said}");
    std::fs::remove_dir_all(&folder).unwrap();
}
