//! Geometric tests: Moody's surface plate, other software, and what must not matter.

use serde_json::Value;
use trueaxis_geometry::statistics::SplitMix64;
use trueaxis_input::Diagnostics;
use trueaxis_standards::conditions::Conditions;
use trueaxis_standards::iso230_1::{Geometric, evaluate};
use trueaxis_standards::judge::Decision;

const MOODY: &str = include_str!("../../../examples/07_verify/moody-1955.csv");
const LEVEL: &str = include_str!("../../../examples/07_verify/straightness-x-level.csv");
const REVERSAL: &str = include_str!("../../../examples/07_verify/straightness-x-reversal.csv");
const SQUARE: &str = include_str!("../../../examples/07_verify/squareness-xy.csv");

fn expected() -> Value {
    serde_json::from_str(include_str!("data/iso230-1.json")).expect("JSON")
}

fn tried(text: &str, test: &str) -> (Option<Geometric>, Diagnostics) {
    let (conditions, read) = Conditions::read("t.toml", &format!("[test]\n{test}"));
    assert!(!read.has_errors(), "{read:?}");
    let mut problems = Diagnostics::new();
    let found = evaluate("t.csv", text, &conditions, &mut problems);
    (found, problems)
}

#[track_caller]
fn found(text: &str, test: &str) -> Geometric {
    let (found, problems) = tried(text, test);
    assert!(!problems.has_errors(), "{problems:?}");
    found.expect("a result")
}

fn um(g: &Geometric, name: &str) -> f64 {
    let quantity = g.quantities.iter().find(|q| q.name == name);
    quantity.unwrap_or_else(|| panic!("no {name}: {:?}", g.quantities)).value * 1e3
}

#[track_caller]
fn near(ours: f64, theirs: f64, allowed: f64) {
    assert!((ours - theirs).abs() <= allowed, "{ours}, not {theirs}");
}

struct Draw(SplitMix64);

impl Draw {
    fn unit(&mut self) -> f64 {
        self.0.unit()
    }

    fn normal(&mut self) -> f64 {
        let (a, b) = (1.0 - self.unit(), self.unit());
        (-2.0 * a.ln()).sqrt() * (std::f64::consts::TAU * b).cos()
    }
}

const FLAT: &str = "kind = 'flatness'\nbase = '101.6 mm'";

/// Heights over the plane of least squares, as (x, y, µm).
fn levelled(mut points: Vec<[f64; 3]>) -> Vec<[f64; 3]> {
    let n = points.len() as f64;
    let mean = [0, 1, 2].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / n);
    points.iter_mut().for_each(|p| (0..3).for_each(|k| p[k] -= mean[k]));
    let sum = |i: usize, k: usize| points.iter().map(|p| p[i] * p[k]).sum::<f64>();
    let (xx, xy, yy, xz, yz) = (sum(0, 0), sum(0, 1), sum(1, 1), sum(0, 2), sum(1, 2));
    let area = xx * yy - xy * xy;
    let (a, b) = ((xz * yy - yz * xy) / area, (yz * xx - xz * xy) / area);
    points.iter_mut().for_each(|p| p[2] -= a * p[0] + b * p[1]);
    points
}

/// The heights that Moody's worksheets give: his six outer lines close exactly, so least squares changes nothing.
#[test]
fn paper_moody_1955_surface_plate() {
    let six: String = MOODY
        .lines()
        .filter(|l| !l.starts_with("E_W") && !l.starts_with("N_S"))
        .map(|l| format!("{l}\n"))
        .collect();
    let ours = found(&six, FLAT);
    assert!(ours.scatter.is_none() && ours.closures.iter().all(|c| c.largest_mm < 1e-12));
    let all = expected();
    let published: Vec<[f64; 3]> = all["moody_published_um"]
        .as_array()
        .expect("rows")
        .iter()
        .map(|row| [0, 1, 2].map(|k| row[k].as_f64().expect("a number")))
        .collect();
    // In his worksheets each node stands once for each line; the highest one is 17.8e-5 in over the lowest.
    let (low, high) =
        published.iter().fold((f64::MAX, f64::MIN), |(l, h), p| (l.min(p[2]), h.max(p[2])));
    near((high - low) / 25.4 * 100.0, 17.8, 0.05);
    let place = |p: &[f64; 3]| {
        let at = |q: &&[f64; 3]| (q[0] - p[0]).hypot(q[1] - p[1]) < 0.02;
        published.iter().find(at).unwrap_or_else(|| panic!("no {p:?}"))[2]
    };
    let theirs = levelled(ours.surface_mm.iter().map(|p| [p[0], p[1], place(p)]).collect());
    let ours = levelled(ours.surface_mm.iter().map(|p| [p[0], p[1], p[2] * 1e3]).collect());
    for (a, b) in ours.iter().zip(&theirs) {
        // His arcsecond is 2·3.141592/1296000 and his numbers have single precision.
        near(a[2], b[2], 2e-4);
    }
}

/// NumPy with dummy variables shares out the closure of the two centre lines to the same heights; HiGHS finds the
/// same minimum zone.
#[test]
fn oracle_numpy_and_highs_on_moodys_plate() {
    let all = expected();
    let theirs = &all["moody_eight_lines"];
    let number = |key: &str| theirs[key].as_f64().expect("a number");
    let ours = found(MOODY, &format!("{FLAT}\nreference = 'least squares'"));
    near(um(&ours, "flatness, least squares"), number("least_squares_um"), 1e-8);
    near(um(&ours, "flatness, minimum zone"), number("minimum_zone_um"), 1e-6);
    near(um(&ours, "flatness, three points"), number("three_points_um"), 1e-8);
    let (s, free) = ours.scatter.expect("a closure");
    near(s * 1e6, number("s_urad"), 1e-8);
    assert_eq!((free, theirs["redundant"].as_u64()), (2.0, Some(2)));
    for node in theirs["nodes"].as_array().expect("nodes") {
        let [x, y, h] = [0, 1, 2].map(|k| node[k].as_f64().expect("a number"));
        let at = |p: &&[f64; 3]| (p[0] - x).hypot(p[1] - y) < 0.02;
        near(ours.surface_mm.iter().find(at).expect("the node")[2] * 1e3, h, 1e-7);
    }
}

#[test]
fn oracle_highs_minimum_zones() {
    let all = expected();
    let list = |v: &Value| -> Vec<f64> {
        v.as_array().expect("a list").iter().map(|v| v.as_f64().expect("a number")).collect()
    };
    for case in all["lines"].as_array().expect("lines") {
        let (x, h) = (list(&case["x_mm"]), list(&case["h_um"]));
        let rows: String = x.iter().zip(&h).map(|(x, h)| format!("{x},{h}\n")).collect();
        let ours = found(&format!("position_mm,deviation_um\n{rows}"), "kind = 'straightness'");
        near(
            um(&ours, "straightness, minimum zone"),
            case["minimum_zone_um"].as_f64().expect("um"),
            1e-6,
        );
        near(
            um(&ours, "straightness, least squares"),
            case["least_squares_um"].as_f64().expect("um"),
            1e-8,
        );
    }
    for case in all["planes"].as_array().expect("planes") {
        let h = list(&case["h_um"]);
        let at = case["at_mm"].as_array().expect("points").iter().map(list);
        let rows: String = at.zip(&h).map(|(p, h)| format!("{},{},{h}\n", p[0], p[1])).collect();
        let ours = found(&format!("x_mm,y_mm,z_um\n{rows}"), "kind = 'flatness'");
        near(
            um(&ours, "flatness, minimum zone"),
            case["minimum_zone_um"].as_f64().expect("um"),
            1e-6,
        );
        near(
            um(&ours, "flatness, least squares"),
            case["least_squares_um"].as_f64().expect("um"),
            1e-8,
        );
    }
}

/// The example readings: what they were made of comes back within U.
#[test]
fn the_made_readings_come_back() {
    let level = found(
        LEVEL,
        "kind = 'straightness'\nreading_u = '1 urad'\nbase = '100 mm'\nreference = 'end points'",
    );
    // 6 sin(πx/L) + 1.5 sin(4πx/L): its range over the end points at the positions of the feet
    let shape = |x: f64| {
        6.0 * (x * std::f64::consts::PI).sin() + 1.5 * (x * 4.0 * std::f64::consts::PI).sin()
    };
    let highest = (0..=10).map(|i| shape(f64::from(i) / 10.0)).fold(0.0, f64::max);
    let judged = level.judged();
    near(judged.value * 1e3, highest, judged.expanded.expect("U") * 1e3);
    let square = found(
        SQUARE,
        "kind = 'squareness'\nerror = 'EC0Y'\nreading_u = '0.3 um'\ntolerance = '40 urad'",
    );
    assert_eq!(square.judged().name, "EC0Y");
    near(square.judged().value * 1e6, 30.0, square.judged().expanded.expect("U") * 1e6);
    near(square.quantities[1].value * 1e6, 12.0, square.quantities[1].expanded.expect("U") * 1e6);
    assert_eq!(square.outcome, Some(Decision::Conforming));
    let reversal =
        found(REVERSAL, "kind = 'straightness'\nreading_u = '0.3 um'\nreference = 'end points'");
    near(reversal.judged().value * 1e3, highest, reversal.judged().expanded.expect("U") * 1e3);
    assert!(um(&reversal, "straightedge") > 9.0);
}

/// Whatever the straightedge or the square is, the reversal takes it out.
#[test]
fn law_the_reversal_takes_out_the_artefact() {
    let mut draw = Draw(SplitMix64::new(3));
    for _ in 0..50 {
        let shape: Vec<f64> = (0..8).map(|_| 10.0 * draw.normal()).collect();
        let mut rows = [
            "position_mm,deviation_um\n".to_owned(),
            "position_mm,setup,deviation_um\n".to_owned(),
        ];
        for (i, s) in shape.iter().enumerate() {
            let edge = 50.0 * draw.normal();
            rows[0] += &format!("{},{s}\n", 50 * i);
            rows[1] +=
                &format!("{},normal,{}\n{},reversed,{}\n", 50 * i, s + edge, 50 * i, s - edge);
        }
        let [one, both] = rows.map(|r| found(&r, "kind = 'straightness'"));
        for k in 0..3 {
            near(one.quantities[k].value * 1e3, both.quantities[k].value * 1e3, 1e-9);
        }
        let square = draw.normal() * 1e-3;
        let mut rows = "axis,position_mm,setup,deviation_um\n".to_owned();
        for (setup, sign) in [("normal", 1.0), ("reversed", -1.0)] {
            let tilt = draw.normal() * 1e-3;
            for p in [0.0, 100.0, 200.0] {
                rows += &format!("Z,{p},{setup},{}\n", tilt * p * 1e3);
                rows += &format!("X,{p},{setup},{}\n", -(25e-6 + sign * square + tilt) * p * 1e3);
            }
        }
        let found = found(&rows, "kind = 'squareness'\nerror = 'EB0X'");
        near(found.judged().value * 1e6, 25.0, 1e-6);
        near(found.quantities[1].value * 1e6, square * 1e6, 1e-6);
    }
}

/// Signs by hand: Y turned by +C moves to −X, Z turned by +A to −Y, X turned by +B to −Z.
#[test]
fn signs_of_squareness() {
    for (first, second, error) in [("X", "Y", "EC0Y"), ("Y", "Z", "EA0Z"), ("Z", "X", "EB0X")] {
        let text = format!(
            "axis,position_mm,deviation_um\n{first},0,0\n{first},100,0\n{first},200,0\n\
             {second},0,0\n{second},100,-1\n{second},200,-2\n"
        );
        let one = found(&text, &format!("kind = 'squareness'\nerror = '{error}'"));
        near(one.judged().value * 1e6, 10.0, 1e-9);
        // The same from the other axis: it turns by −10 µrad to the second one.
        let text = text.replace(&format!("{first},0,0"), "").replace("\n\n", "\n");
        let (_, problems) = tried(&text, "kind = 'squareness'\nerror = 'EC0X'");
        assert!(problems.has_errors());
    }
    // An axis that carries the workpiece moves the other way.
    let text = "position_mm,deviation_um\n0,0\n50,3\n100,0\n";
    let [tool, table] = ["tool", "workpiece"].map(|w| {
        found(
            text,
            &format!("kind = 'straightness'\nreference = 'end points'\naxis_carries = '{w}'"),
        )
    });
    near(tool.lines[0].points_mm[1][1] * 1e3, 3.0, 1e-9);
    near(table.lines[0].points_mm[1][1] * 1e3, -3.0, 1e-9);
}

/// The order of rows, the unit, a shift of the frame, and the direction that a line is read in change nothing.
#[test]
fn law_what_must_not_matter_does_not() {
    let compare = |a: &Geometric, b: &Geometric, factor: f64| {
        for a in &a.closures {
            let b = b.closures.iter().find(|b| b.line == a.line).expect("the same lines");
            near(a.largest_mm * factor, b.largest_mm, 1e-9);
        }
        for a in &a.lines {
            let b = b.lines.iter().find(|b| b.name == a.name).expect("the same lines");
            for (p, q) in a.points_mm.iter().zip(&b.points_mm) {
                near(p[0], q[0], 1e-9);
                near(p[1] * factor, q[1], 1e-9);
            }
        }
        for (a, b) in a.quantities.iter().zip(&b.quantities) {
            near(a.value * factor, b.value, 1e-9 * a.value.abs() * factor + 1e-15);
            let (a, b) = (a.expanded.unwrap_or(0.0), b.expanded.unwrap_or(0.0));
            near(a * factor, b, 1e-7 * b + 1e-15);
        }
    };
    let turned = |text: &str| {
        let mut lines: Vec<&str> = text.lines().filter(|l| !l.starts_with('#')).collect();
        let rows = lines.len();
        lines[1..].reverse();
        lines[1..rows].join("\n").lines().fold(format!("{}\n", lines[0]), |t, l| t + l + "\n")
    };
    for (text, test) in [
        (MOODY, FLAT),
        (LEVEL, "kind = 'straightness'\nbase = '100 mm'"),
        (REVERSAL, "kind = 'straightness'\nreading_u = '0.3 um'"),
    ] {
        compare(&found(text, test), &found(&turned(text), test), 1.0);
    }
    let rows = |text: &str| -> Vec<Vec<String>> {
        let lines = text.lines().filter(|l| !l.starts_with('#')).skip(1);
        lines.map(|l| l.split(',').map(str::to_owned).collect()).collect()
    };
    let number = |s: &String| s.parse::<f64>().expect("a number");
    // Arcseconds to degrees, a shift by 1 m, each step read backwards with the opposite angle.
    let mut text = "line,from_x_mm,from_y_mm,to_x_mm,to_y_mm,angle_deg\n".to_owned();
    for row in rows(MOODY) {
        let [a, b, c, d] = [1, 2, 3, 4].map(|k| number(&row[k]) + 1000.0);
        text += &format!("{},{c},{d},{a},{b},{:e}\n", row[0], -number(&row[5]) / 3600.0);
    }
    compare(&found(MOODY, FLAT), &found(&text, FLAT), 1.0);
    // Three times the deviation is three times the result.
    let mut text = "position_mm,run,angle_urad\n".to_owned();
    for row in rows(LEVEL) {
        text += &format!("{},{},{}\n", row[0], row[1], 3.0 * number(&row[2]));
    }
    let test = "kind = 'straightness'\nbase = '100 mm'";
    compare(&found(LEVEL, test), &found(&text, test), 3.0);
}

/// U covers the truth in 93 to 98 % of draws: steps of a level, squareness, and a lattice of lines.
#[test]
fn law_u_covers_the_truth() {
    let mut draw = Draw(SplitMix64::new(11));
    let sets = 400;
    let mut inside = [0; 4];
    let covers = |g: &Geometric, name: &str, truth: f64| {
        let q = g.quantities.iter().find(|q| q.name == name).expect("a quantity");
        usize::from((q.value - truth).abs() <= q.expanded.expect("U"))
    };
    let truth = |x: f64| 20e-3 * (x / 1000.0 * std::f64::consts::PI).sin();
    let of_points: String =
        (0..=10).map(|i| format!("{},{}\n", 100 * i, truth(f64::from(100 * i)))).collect();
    let exact = found(&format!("position_mm,deviation_mm\n{of_points}"), "kind = 'straightness'");
    let by_name = |name: &str| um(&exact, name) * 1e-3;
    for _ in 0..sets {
        let mut text = "position_mm,run,angle_urad\n".to_owned();
        for run in 0..3 {
            for i in 0..10 {
                let x = f64::from(100 * i);
                let angle = (truth(x + 100.0) - truth(x)) / 100.0 * 1e6;
                text += &format!("{x},{run},{}\n", angle + 2.0 * draw.normal());
            }
        }
        let level = found(&text, "kind = 'straightness'\nbase = '100 mm'");
        for (k, name) in
            ["straightness, least squares", "straightness, end points"].iter().enumerate()
        {
            inside[k] += covers(&level, name, by_name(name));
        }
        let mut text = "axis,position_mm,deviation_um\n".to_owned();
        for axis in ["X", "Y"] {
            for i in 0..6 {
                text += &format!("{axis},{},{}\n", 50 * i, 0.5 * draw.normal());
            }
        }
        let square = found(&text, "kind = 'squareness'\nreading_u = '0.5 um'");
        inside[2] += covers(&square, "EC0Y", 0.0);
        let mut text = "line,from_x_mm,from_y_mm,to_x_mm,to_y_mm,angle_urad\n".to_owned();
        let height = |x: f64, y: f64| 1e-7 * (x - 200.0).powi(2) + 5e-8 * y * y;
        let mut step = |line: &str, a: [f64; 2], b: [f64; 2]| {
            let angle =
                (height(b[0], b[1]) - height(a[0], a[1])) / 100.0 * 1e6 + 1.5 * draw.normal();
            text += &format!("{line},{},{},{},{},{angle}\n", a[0], a[1], b[0], b[1]);
        };
        for i in 0..5 {
            for k in 0..4 {
                let (fixed, from) = (f64::from(100 * i), f64::from(100 * k));
                step(&format!("x{i}"), [from, fixed], [from + 100.0, fixed]);
                step(&format!("y{i}"), [fixed, from], [fixed, from + 100.0]);
            }
        }
        let flat =
            found(&text, "kind = 'flatness'\nreference = 'three points'\nangles_from = 'gravity'");
        let mut grid = "x_mm,y_mm,z_mm\n".to_owned();
        for (x, y) in
            (0..5).flat_map(|i| (0..5).map(move |k| (f64::from(100 * i), f64::from(100 * k))))
        {
            grid += &format!("{x},{y},{}\n", height(x, y));
        }
        let exact = found(&grid, "kind = 'flatness'");
        inside[3] +=
            covers(&flat, "flatness, three points", um(&exact, "flatness, three points") * 1e-3);
    }
    for covered in inside {
        let share = covered as f64 / f64::from(sets);
        assert!((0.93..0.985).contains(&share), "{inside:?} of {sets}");
    }
}

/// A level counts from gravity: one zero for all lines makes more of the same readings.
#[test]
fn a_level_has_one_zero() {
    let mut text = "line,from_x_mm,from_y_mm,to_x_mm,to_y_mm,angle_urad\n".to_owned();
    let height = |x: f64, y: f64| 1e-6 * x * y / 100.0;
    let mut step = |line: &str, a: [f64; 2], b: [f64; 2]| {
        let angle = (height(b[0], b[1]) - height(a[0], a[1])) / 100.0 * 1e6 + 40.0;
        text += &format!("{line},{},{},{},{},{angle}\n", a[0], a[1], b[0], b[1]);
    };
    // Two sides forward and two backward, so that the zero is separated from the tilt.
    step("a", [0.0, 0.0], [100.0, 0.0]);
    step("b", [100.0, 0.0], [100.0, 100.0]);
    step("c", [100.0, 100.0], [0.0, 100.0]);
    step("d", [0.0, 100.0], [0.0, 0.0]);
    let (none, problems) = tried(&text, "kind = 'flatness'");
    assert!(none.is_none());
    assert!(problems.iter().any(|d| d.code == "lines-not-connected"));
    let level = found(&text, "kind = 'flatness'\nangles_from = 'gravity'");
    near(um(&level, "flatness, minimum zone"), 0.05, 1e-9);
}

/// What is perfectly straight or flat is so within what the readings scatter by, not exactly.
#[test]
fn nothing_is_exactly_straight() {
    let rows: String = (0..6).map(|i| format!("{},5\n", 100 * i)).collect();
    let line = found(
        &format!("position_mm,deviation_um\n{rows}"),
        "kind = 'straightness'\nreading_u = '1 um'",
    );
    let rows: String = (0..9).map(|i| format!("{},{},2\n", i % 3, i / 3)).collect();
    let plane = found(&format!("x_mm,y_mm,z_um\n{rows}"), "kind = 'flatness'\nreading_u = '1 um'");
    for q in line.quantities.iter().chain(&plane.quantities) {
        assert!(q.value.abs() < 1e-12, "{q:?}");
        assert!(q.expanded.is_some_and(|u| u > 1e-3), "{q:?}");
    }
}

/// Any text as a table: diagnostics, never a panic, and no number that is not finite.
#[test]
fn law_hostile_tables_end_in_words() {
    let junk = ["nan", "1e999", "-", ",", "\n", "é", "1e300", "reversed", "0", "\u{0}", "1e-300,"];
    let mut random = SplitMix64::new(4);
    let kinds = ["straightness", "flatness", "squareness", "parallelism"];
    for (k, text) in [MOODY, LEVEL, REVERSAL, SQUARE].iter().cycle().take(800).enumerate() {
        let mut text = (*text).to_owned();
        for _ in 0..1 + k % 3 {
            let places: Vec<usize> = text.char_indices().map(|(i, _)| i).collect();
            let at = places[(random.unit() * places.len() as f64) as usize];
            text.insert_str(at, junk[(random.unit() * junk.len() as f64) as usize]);
        }
        let kind = kinds[(random.unit() * 4.0) as usize];
        let (found, problems) = tried(&text, &format!("kind = '{kind}'"));
        assert!(found.is_some() || problems.has_errors());
        for q in found.iter().flat_map(|f| &f.quantities) {
            assert!(q.value.is_finite() && q.expanded.is_none_or(f64::is_finite), "{text}: {q:?}");
        }
    }
}

#[test]
fn bad_tables_end_in_words() {
    let codes = |text: &str, test: &str| -> Vec<&'static str> {
        let (found, problems) = tried(text, test);
        assert!(found.is_none(), "{text}");
        problems.iter().map(|d| d.code).collect()
    };
    let straight = "kind = 'straightness'";
    assert_eq!(codes("position_mm\n1\n2\n3\n", straight), ["missing-column"]);
    assert_eq!(codes("position_mm,deviation_um\n1,2\n2,3\n", straight), ["few-positions"]);
    let gap = "position_mm,angle_urad\n0,1\n100,1\n300,1\n";
    assert_eq!(codes(gap, straight), ["base-gap"]);
    let setups = "position_mm,setup,deviation_um\n0,normal,1\n1,normal,2\n2,normal,1\n0,reversed,1\n1,reversed,2\n3,reversed,1\n";
    assert_eq!(codes(setups, straight), ["setups-differ"]);
    assert_eq!(codes(&setups.replace("reversed", "upside-down"), straight), ["unknown-word"]);
    let square = "axis,position_mm,deviation_um\nX,0,1\nX,1,2\nX,2,3\nY,0,1\nY,1,1\nY,2,1\n";
    assert_eq!(codes(square, "kind = 'squareness'\nerror = 'EC0X'"), ["wrong-error"]);
    assert_eq!(codes(square, straight), ["wrong-lines"]);
    let wrong = format!("{straight}\nreading_u = '1 um'\ntolerance = '3 urad'");
    assert_eq!(codes("position_mm,deviation_um\n0,0\n1,1\n2,0\n", &wrong), ["wrong-unit"]);
    let wrong = format!("{straight}\nreading_u = '1 urad'");
    assert_eq!(codes("position_mm,deviation_um\n0,0\n1,1\n2,0\n", &wrong), ["wrong-unit"]);
    let line = "x_mm,y_mm,z_um\n0,0,1\n1,1,2\n2,2,3\n3,3,1\n";
    assert_eq!(codes(line, "kind = 'flatness'"), ["no-plane"]);
    let mut problems = Diagnostics::new();
    assert!(evaluate("t.csv", square, &Conditions::default(), &mut problems).is_none());
    assert_eq!(problems.iter().next().expect("one").code, "missing-test");
}
