//! What holds for every plan: stations, choices, uncertainties, programs.

mod library;

use library::{Random, root};
use std::sync::atomic::{AtomicU32, Ordering};
use trueaxis::files::disk;
use trueaxis::geometry::Vec3;
use trueaxis::machine::axis::AxisKind;
use trueaxis::machine::tcp::TipControl;
use trueaxis::measure::Readings;
use trueaxis::measure::path::{FreeSide, Path, hits};
use trueaxis::nc::Control;
use trueaxis::plan::program::{check, program};
use trueaxis::plan::{Criterion, Plan, choose, expect, read_plan};
use trueaxis::unknowns::design::Design;
use trueaxis::unknowns::fit::fit;

/// A plan of an example of the project.
fn example(name: &str) -> Plan {
    let (plan, problems) = read_plan(&disk(), &root().join("examples/04_plan").join(name));
    plan.unwrap_or_else(|| panic!("{problems:?}"))
}

/// A campaign on a machine of the project, from the text after the first two lines.
fn campaign(machine: &str, rest: &str) -> (Option<Plan>, String) {
    static NEXT: AtomicU32 = AtomicU32::new(0);
    let number = NEXT.fetch_add(1, Ordering::Relaxed);
    let name = format!("trueaxis-plan-{}-{number}.toml", std::process::id());
    let file = std::env::temp_dir().join(name);
    let machine = root().join("machines").join(machine).join("machine.toml");
    let text = format!("name = \"law\"\nmachine = '{}'\n{rest}", machine.display());
    std::fs::write(&file, text).expect("a temporary file");
    let (plan, problems) = read_plan(&disk(), &file);
    std::fs::remove_file(&file).expect("it is there");
    let reported = problems.iter().map(|d| format!("{} {}", d.code, d.message)).collect::<Vec<_>>();
    (plan, reported.join("\n"))
}

/// Machines with two rotary axes: where the ball stands, and the letters.
const MACHINES: [(&str, &str, [&str; 2]); 6] = [
    ("i5-engraver", "50 20 20 mm", ["A", "C"]),
    ("lei-hsu-mill", "0 0 0 mm", ["A", "C"]),
    ("head-table", "30 40 50 mm", ["B", "C"]),
    ("nutating-head", "30 40 50 mm", ["B", "C"]),
    ("wyxzcat-gantry", "100 40 50 mm", ["A", "C"]),
    ("xkas2525", "30 40 50 mm", ["A", "C"]),
];

#[test]
fn law_the_nominal_machine_reads_zero_on_every_path_about_a_ball() {
    for (machine, ball, [first, second]) in MACHINES {
        let rest = format!(
            "[unknown]\nlocation = \"minimal\"\n\
             [instrument.probe]\nkind = \"probe-ball\"\nball = \"{ball}\"\nnoise = \"1 um\"\n\
             [[path]]\nkind = \"{first}\"\nfrom = \"-50 deg\"\nto = \"60 deg\"\nat = {{ {second} = \"30 deg\" }}\n\
             [[path]]\nkind = \"{second}\"\nfrom = \"-170 deg\"\nto = \"180 deg\"\nat = {{ {first} = \"40 deg\" }}\nback = true\n\
             [[path]]\nkind = \"F\"\nlowest = \"20 deg\"\nrise = \"60 deg\"\n\
             [[path]]\nkind = \"S\"\ntilt = \"30 deg\"\npole = \"-1 0 1\"\n\
             [[path]]\nkind = \"random\"\ncount = 40\n{first} = [\"-60 deg\", \"60 deg\"]\n"
        );
        let (plan, reported) = campaign(machine, &rest);
        let plan = plan.unwrap_or_else(|| panic!("{machine}: {reported}"));
        assert_eq!(plan.paths.len(), 5);
        let probe = &plan.campaign.instruments[0];
        for path in &plan.paths {
            for (command, direction) in path.stations.commands.iter().zip(&path.stations.directions)
            {
                let read = probe.nominal_reading(&plan.campaign.machine, command, *direction);
                let worst = read.iter().fold(0.0_f64, |w, v| w.max(v.abs()));
                assert!(worst < 1e-9, "{machine} {}: {read:?}", path.name);
            }
            let moved = path.stations.commands.windows(2).filter(|w| w[0] != w[1]).count();
            assert!(moved + 2 >= path.stations.len(), "{machine} {} stands still", path.name);
        }
    }
}

/// The tests in the manner of ISO 10791-6: what turns, how the bar lies, which machine a name is for.
#[test]
fn law_kinematic_tests_turn_what_they_say_and_keep_the_bar() {
    for ((machine, ball, axes), family) in
        MACHINES.into_iter().zip(["BK", "BK", "CK", "CK", "AK", "AK"])
    {
        // The engraver reaches no higher.
        let ball = if machine == "i5-engraver" { "50 20 -10 mm" } else { ball };
        let test = |name: &str, more: &str| {
            format!(
                "[unknown]\nlocation = \"minimal\"\n[instrument.bar]\nkind = \"ball-bar\"\n\
                 table_ball = \"{ball}\"\nlength = \"30 mm\"\nnoise = \"1 um\"\n\
                 [[path]]\nkind = \"{name}\"\n{more}"
            )
        };
        let turn = "from = \"-20 deg\"\nto = \"20 deg\"\ncount = 9\n";
        for (number, letter) in [("1", axes[0]), ("2", axes[1])] {
            let name = format!("{family}{number}");
            let (plan, reported) = campaign(machine, &test(&name, turn));
            let plan = plan.unwrap_or_else(|| panic!("{machine}: {reported}"));
            let names: Vec<_> = plan.paths.iter().map(|p| p.name.clone()).collect();
            assert_eq!(names, ["radial", "tangential", "axial"].map(|b| format!("{name} {b}")));
            let own = &plan.campaign.machine;
            for path in &plan.paths {
                keeps_its_length(&plan, path);
                for (i, axis) in own.axes().iter().enumerate() {
                    let turns = path.stations.commands.windows(2).any(|w| w[0][i] != w[1][i]);
                    let due = axis.name.to_string() == letter;
                    assert!(axis.kind == AxisKind::Linear || turns == due, "{machine} {name}");
                }
            }
        }
        let cone = test(&format!("{family}3"), "half_angle = \"15 deg\"\ncount = 25\n");
        let (plan, reported) = campaign(machine, &cone);
        let plan = plan.unwrap_or_else(|| panic!("{machine}: {reported}"));
        keeps_its_length(&plan, &plan.paths[0]);
        let control = TipControl::of(&plan.campaign.machine).expect("three linear axes");
        for command in &plan.paths[0].stations.commands {
            let (_, axis) = control.tip_and_axis(command);
            assert!((axis.z - 15f64.to_radians().cos()).abs() < 1e-9, "{machine}: {axis}");
        }
        let wrong = if family == "AK" { "BK1" } else { "AK1" };
        let (plan, reported) = campaign(machine, &test(wrong, turn));
        assert!(plan.is_none() && reported.contains("other-topology"), "{machine}: {reported}");
    }
}

fn keeps_its_length(plan: &Plan, path: &Path) {
    let bar = &plan.campaign.instruments[0];
    for (command, direction) in path.stations.commands.iter().zip(&path.stations.directions) {
        let read = bar.nominal_reading(&plan.campaign.machine, command, *direction)[0];
        assert!((read - bar.length_mm).abs() < 1e-9, "{}: {read}", path.name);
    }
}

/// What the probe of the mill of Lei and Hsu 2003 reads of one error alone, mm.
fn single(design: &Design, stations: &Readings, name: &str, size: f64, i: usize) -> [f64; 3] {
    let mut values = vec![0.0; design.unknowns()];
    let k = design.names().iter().position(|n| n == name).expect("an unknown");
    values[k] = size;
    design.read(stations, i, &values).expect("within the tables")
}

#[test]
fn law_single_errors_read_what_a_hand_calculation_says() {
    let rest = "[unknown]\nlocation = [\"EX0C\", \"EY0A\", \"EC0A\"]\n\
                [instrument.probe]\nkind = \"probe-ball\"\nsocket = \"0 0 -330 mm\"\nnoise = \"1 um\"\n\
                [[path]]\nkind = \"F\"\n";
    let (plan, reported) = campaign("lei-hsu-mill", rest);
    let plan = plan.unwrap_or_else(|| panic!("{reported}"));
    // Nothing but the unknown errors.
    let machine = plan
        .campaign
        .machine
        .stated_errors()
        .iter()
        .fold(plan.campaign.machine.clone(), |machine, (index, _)| {
            machine.with_error(*index, None)
        });
    let design =
        Design::new(&machine, plan.campaign.terms.clone(), plan.campaign.instruments.clone());
    let stations = &plan.paths[0].stations;
    let (e, gamma) = (0.01, 1e-5);
    for i in 0..stations.len() {
        let [c, a, ..] = stations.commands[i];
        let ((sc, cc), (sa, ca)) = (c.sin_cos(), a.sin_cos());
        // Lei and Hsu 2003, Eq 8 and 9: the ball from the centre of rotation, X0 = (60, 40, 120) mm.
        let x = 60.0 * cc - 40.0 * sc;
        let y = 60.0 * ca * sc + 40.0 * ca * cc - 120.0 * sa;
        let near = |read: [f64; 3], hand: [f64; 3]| {
            let off = read.iter().zip(hand).map(|(r, h)| (r - h).abs()).fold(0.0, f64::max);
            assert!(off < 1e-8, "station {i}: {read:?} {hand:?}");
        };
        // A tilts about x: an offset of C along x stays along x.
        near(single(&design, stations, "EX0C", e, i), [e, 0.0, 0.0]);
        near(single(&design, stations, "EY0A", e, i), [0.0, e, 0.0]);
        // γ ẑ × r of the ball.
        near(single(&design, stations, "EC0A", gamma, i), [-gamma * y, gamma * x, 0.0]);
    }
}

#[test]
fn law_five_minutes_are_enough_for_the_rotary_axes() {
    let plan = example("touch-probe-5-minutes.toml");
    let chosen = choose(&plan, plan.candidates.as_ref().expect("candidates")).expect("a choice");
    assert!(chosen.time_s <= 300.0 && chosen.poses * 20 <= 300);
    let design = plan.campaign.design();
    let mut truth: Vec<f64> = (0..design.unknowns())
        .map(|k| if design.unknown(k).is_some_and(|u| u.is_angle()) { 4e-5 } else { -0.015 })
        .collect();
    // What cannot be seen would come back in second order.
    let sight = trueaxis::unknowns::fit::Observability::of(
        &trueaxis::unknowns::fit::normal_matrix(&design, &chosen.stations, &[]),
    );
    truth = sight.seen_part(&truth);
    // What is known of the stylus is not its value: that is another one in each campaign.
    let known: Vec<(usize, f64)> =
        (0..design.unknowns()).filter_map(|k| Some((k, design.unknown(k)?.prior()?.1))).collect();
    let mut random = Random(5);
    let runs = 2000;
    let mut squares = vec![0.0; design.unknowns()];
    for _ in 0..runs {
        known.iter().for_each(|(k, u)| truth[*k] = u * random.normal());
        let mut readings = chosen.stations.clone();
        for (i, value) in readings.values.iter_mut().enumerate() {
            let clean = design.read(&chosen.stations, i, &truth).expect("within the tables");
            *value = [clean[0] + 1e-3 * random.normal(), 0.0, 0.0];
        }
        let found = fit(&design, &readings, &[]).expect("a fit");
        for ((s, v), t) in squares.iter_mut().zip(&found.values).zip(&truth) {
            *s += (v - t) * (v - t);
        }
    }
    let mut rotary = 0;
    for (expected, square) in chosen.expectation.unknowns.iter().zip(&squares) {
        let term = design.terms.get(expected.unknown);
        let is_rotary = term.is_some_and(|t| t.error.body.is_rotary());
        let scatter = (square / f64::from(runs)).sqrt();
        let Some(u) = expected.u else {
            assert!(!is_rotary, "{} is hidden", expected.name);
            continue;
        };
        assert!((scatter / u - 1.0).abs() < 0.1, "{}: {scatter:e}, {u:e}", expected.name);
        if is_rotary {
            rotary += 1;
            let allowed = if expected.is_angle { 10e-6 } else { 2e-3 };
            assert!(2.0 * scatter <= allowed, "{}: U = {:e}", expected.name, 2.0 * scatter);
        }
    }
    assert_eq!(rotary, 8);
}

#[test]
fn law_no_exchange_makes_a_choice_worse() {
    let mut plan = example("touch-probe-5-minutes.toml");
    for criterion in [Criterion::A, Criterion::D] {
        let candidates = plan.candidates.as_mut().expect("candidates");
        candidates.want.criterion = criterion;
        let design = plan.campaign.design();
        let candidates = plan.candidates.as_ref().expect("candidates");
        let exchange = candidates.exchange(&design, &Readings::default()).expect("a question");
        let selection = exchange.choose();
        assert!(selection.history.windows(2).all(|w| w[1] <= w[0]), "{:?}", selection.history);
        assert_eq!(selection, exchange.choose());
        // No single exchange that is left gains anything.
        let end = exchange.value_of(&selection.poses);
        for place in 0..selection.poses.len() {
            for k in (0..exchange.candidates.len()).step_by(7) {
                if selection.poses.contains(&k) {
                    continue;
                }
                let mut other = selection.poses.clone();
                other[place] = k;
                let slack = 1e-5 * end.abs().max(1.0);
                assert!(exchange.value_of(&other) > end - slack);
            }
        }
    }
}

#[test]
fn law_programs_lead_to_every_station_in_every_dialect() {
    let plan = example("probe-ball.toml");
    for control in [Control::Fanuc, Control::LinuxCnc, Control::Sinumerik840d, Control::Heidenhain]
    {
        for path in &plan.paths {
            let text = program(&plan.campaign, path, &plan.program, control).expect("a program");
            let check = check(&plan.campaign, path, &plan.program, &text, control);
            assert!(check.errors.is_empty(), "{control:?} {}: {:?}", path.name, check.errors);
            assert!(check.off_station < 1e-4, "{control:?} {}: {check:?}", path.name);
            let stood = path.stations.len() as f64 * path.dwell_s;
            assert!(path.feed_mm_per_s.is_some() || check.duration_s > stood);
        }
    }
}

#[test]
fn law_hits_keep_clear_of_both_stems() {
    let mut random = Random(3);
    let free = FreeSide { stem: -Vec3::z() };
    for _ in 0..500 {
        let axis = Vec3::from_fn(|_, _| random.unit() - 0.5).normalize();
        let sides = hits(free, axis, 5);
        assert_eq!(sides.is_empty(), axis.z < -0.5, "{axis:?}");
        for side in &sides {
            assert!((side.norm() - 1.0).abs() < 1e-12);
            assert!(side.z >= -0.5 - 1e-9 && side.dot(&axis) >= -1e-9, "{axis:?} {side:?}");
        }
    }
}

#[test]
fn law_what_is_hidden_is_told_with_what_would_tell() {
    // The place of the socket is as unknown as that of the ball.
    let rest = "[unknown]\nlocation = [\"EZ0A\", \"EY0C\"]\n\
                [instrument.probe]\nkind = \"probe-ball\"\nnoise = \"1 um\"\n\
                unknown = { socket = \"free\" }\n\
                [[path]]\nkind = \"C\"\nfrom = \"0 deg\"\nto = \"300 deg\"\n";
    let (plan, reported) = campaign("lei-hsu-mill", rest);
    let plan = plan.unwrap_or_else(|| panic!("{reported}"));
    let design = plan.campaign.design();
    let expectation = expect(&plan.campaign, &design, &plan.paths[0].stations);
    let hidden = expectation
        .unobservable
        .iter()
        .find(|h| h.words.contains("EZ0A") && h.words.contains("socket_z"))
        .unwrap_or_else(|| panic!("{:?}", expectation.unobservable));
    assert!(hidden.words.contains("10 µm of EZ0A"), "{}", hidden.words);
    // A table that is lifted and a tool that is shorter differ nowhere but in the zero of Z: with
    // any pose and any tool whose length is not known better.
    // A lifted table and a shorter tool differ nowhere: only a known length tells.
    let remedy = hidden.resolve_with.as_deref().expect("a remedy");
    assert!(remedy.contains("second tool whose length is known"), "{remedy}");
    // Two centres that differ only where A tilts: the remedy tells, and tells what it promises.
    let rest = "[unknown]\nlocation = [\"EY0A\", \"EY0C\"]\n\
                [instrument.probe]\nkind = \"probe-ball\"\nsocket = \"0 0 -330 mm\"\n\
                noise = \"1 um\"\n[[path]]\nkind = \"C\"\nfrom = \"0 deg\"\nto = \"300 deg\"\n";
    let hidden = |paths: &str| {
        let (plan, reported) = campaign("lei-hsu-mill", &format!("{rest}{paths}"));
        let plan = plan.unwrap_or_else(|| panic!("{reported}"));
        let mut stations = Readings::default();
        plan.paths.iter().for_each(|path| stations.append(&path.stations));
        expect(&plan.campaign, &plan.campaign.design(), &stations).unobservable
    };
    let [only] = hidden("").try_into().expect("one combination");
    assert!(only.words.contains("EY0A") && only.words.contains("EY0C"), "{}", only.words);
    let remedy = only.resolve_with.expect("a remedy");
    assert!(remedy.contains("min)") && remedy.contains('A'), "{remedy}");
    assert!(hidden("[[path]]\nkind = \"A\"\nfrom = \"90 deg\"\nto = \"0 deg\"\n").is_empty());
}

#[test]
fn law_stations_outside_the_travel_are_named() {
    let probe = "[unknown]\nlocation = \"minimal\"\n\
                 [instrument.probe]\nkind = \"probe-ball\"\nball = \"90 0 200 mm\"\nnoise = \"1 um\"\n";
    let path = "[[path]]\nkind = \"A\"\nfrom = \"-90 deg\"\nto = \"90 deg\"\n";
    let (plan, reported) = campaign("i5-engraver", &format!("{probe}{path}"));
    assert!(plan.is_none());
    assert!(
        reported.contains("outside-travel") && reported.contains("station 1 of 25"),
        "{reported}"
    );
    assert!(reported.contains("Y = ") || reported.contains("Z = "), "{reported}");
    for (path, code) in [
        ("[[path]]\nkind = \"B\"\nfrom = \"0 deg\"\nto = \"9 deg\"\n", "unknown-axis"),
        ("[[path]]\nkind = \"Q\"\n", "unknown-path"),
        ("[[path]]\nkind = \"S\"\ntilt = \"50 deg\"\n", "bad-tilt"),
        ("[[path]]\nkind = \"F\"\nrise = \"100 deg\"\n", "bad-rise"),
        ("[[path]]\nkind = \"diagonal\"\ndiagonal = \"+?+\"\n", "bad-diagonal"),
        ("[[path]]\nkind = \"targets\"\naxis = \"W\"\n", "unknown-axis"),
        ("[[path]]\nkind = \"touch\"\n", "unknown-instrument"),
        ("[candidates]\nkind = \"random\"\ncount = 5\n", "missing-key"),
        ("", "missing-key"),
    ] {
        let (plan, reported) = campaign("i5-engraver", &format!("{probe}{path}"));
        assert!(plan.is_none() && reported.contains(code), "{path}: {reported}");
    }
}

#[test]
fn law_linear_paths_are_what_their_names_say() {
    let rest = "[unknown]\nlocation = \"minimal\"\n\
         [instrument.bar]\nkind = \"ball-bar\"\ntable_ball = \"0 0 -20 mm\"\nlength = \"60 mm\"\nnoise = \"1 um\"\n\
         [instrument.laser]\nkind = \"laser-line\"\nnoise = \"1 um\"\n\
         [[path]]\ninstrument = \"bar\"\nkind = \"circle\"\nplane = \"YZ\"\ncount = 36\n\
         [[path]]\ninstrument = \"laser\"\nkind = \"diagonal\"\ndiagonal = \"+-+\"\ncount = 7\n\
         [[path]]\ninstrument = \"laser\"\nkind = \"targets\"\naxis = \"Y\"\nperiod = \"10 mm\"\n\
         [[path]]\ninstrument = \"bar\"\nkind = \"C\"\nfrom = \"0 deg\"\nto = \"360 deg\"\nbar = \"axial\"\n";
    let (plan, reported) = campaign("i5-engraver", rest);
    let plan = plan.unwrap_or_else(|| panic!("{reported}"));
    let machine = &plan.campaign.machine;
    let nominal = |path: usize, i: usize| {
        let stations = &plan.paths[path].stations;
        let own = &plan.campaign.instruments[stations.instruments[i] as usize];
        own.nominal_reading(machine, &stations.commands[i], stations.directions[i])[0]
    };
    // A bar of 60 mm all round, X at rest; both ways.
    let circle = &plan.paths[0].stations;
    assert_eq!(circle.len(), 74);
    assert!((0..74).all(|i| (nominal(0, i) - 60.0).abs() < 1e-9));
    assert!(circle.commands.iter().all(|c| (c[2] - circle.commands[0][2]).abs() < 1e-9));
    assert!(circle.approaches.iter().any(|a| a[3] > 0.0));
    // The laser sees the length of the diagonal of 360 × 220 × 210 mm.
    let length = nominal(1, 6) - nominal(1, 0);
    let body = (360.0_f64.powi(2) + 220.0_f64.powi(2) + 210.0_f64.powi(2)).sqrt();
    assert!((length - body).abs() < 1e-9, "{length}");
    // Five runs up and down to five targets; each comes from both sides.
    let targets = &plan.paths[2].stations;
    assert_eq!(targets.len(), 5 * 2 * 5);
    let y = |i: usize| targets.commands[i][3];
    assert!((0..5).all(|i| y(i) == y(9 - i)) && targets.approaches[9][3] == -1.0);
    let steps: Vec<f64> = (0..4).map(|i| y(i + 1) - y(i)).collect();
    assert!(steps.iter().any(|s| (s - steps[0]).abs() > 0.1), "{steps:?}");
    assert!((0..25).all(|i| (nominal(3, i) - 60.0).abs() < 1e-9));
}
