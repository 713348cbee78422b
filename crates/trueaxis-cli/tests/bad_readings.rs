//! Readings as users spoil them, for `evaluate` and `identify expansion`: what can be evaluated is,
//! and each slip is named. What is no evaluation at all is refused.

mod command;

use command::{Folder, trueaxis};

const TARGETS: [f64; 6] = [0.0, 101.3, 195.0, 305.7, 398.2, 500.0];

/// A whole test: six targets, five runs, both sides; `change` may spoil a row or leave it out.
fn table(change: impl Fn(usize, usize, &str, f64) -> Option<String>) -> String {
    let mut text = "target_mm,run,direction,deviation_um\n".to_owned();
    for i in 0..TARGETS.len() {
        for run in 1..=5 {
            for side in ["up", "down"] {
                let noise = ((i * 7 + run * 3) % 5) as f64 * 0.5 - 1.0;
                text.extend(change(i, run, side, noise).map(|row| row + "\n"));
            }
        }
    }
    text
}

fn row(i: usize, run: usize, side: &str, um: f64) -> Option<String> {
    Some(format!("{},{run},{side},{um}", TARGETS[i]))
}

/// The text tells `code` with the words; the command ends with `status`.
#[track_caller]
fn reported(arguments: &[&str], status: i32, code: &str, words: &str) {
    let ran = trueaxis(&[arguments, &["--format", "json"]].concat());
    assert_eq!(ran.status, status, "{arguments:?}\n{}", ran.err);
    match status {
        0 => assert!(ran.json()["schema"].is_string()),
        _ => assert!(ran.has_no_answer()),
    }
    let block = ran.err.split("\n\n").find(|b| b.contains(&format!("[{code}]")));
    let block = block.unwrap_or_else(|| panic!("{code} is not reported:\n{}", ran.err));
    assert!(block.contains(words), "`{words}` is not in\n{block}");
}

#[test]
fn positioning() {
    let folder = Folder::new("bad-positioning");
    let swapped = |heads: &str, row: &dyn Fn(usize, usize, f64) -> String| {
        let mut text = heads.to_owned() + "\n";
        for i in 0..6 {
            for run in 1..=5 {
                text += &row(i, run, ((i * 7 + run * 3) % 5) as f64 * 0.5 - 1.0);
            }
        }
        text
    };
    let long = "target_mm,run,direction,deviation_um";
    let few = table(|i, r, d, v| row(i, r, d, v).filter(|_| i < 3));
    let runs = table(|i, r, d, v| row(i, r, d, v).filter(|_| r < 3));
    let lone = table(|i, r, d, v| row(i, r, d, v).filter(|_| d == "up"));
    let near = table(row).replace("305.7,3,up", "305.71,3,up");
    let warm = table(|i, r, d, v| row(i, r, d, if (r, d) == (4, "up") { v + 20.0 } else { v }));
    let targets_for_deviations =
        swapped(long, &|i, r, v| format!("{},{r},up,{}\n", 0.05 * v, 100 * i));
    let targets_for_runs = swapped(long, &|i, r, v| format!("{r},{},up,{v}\n", 100 * i));
    let targets_for_actual = swapped("target_mm,run,direction,actual_mm", &|i, r, v| {
        format!("{},{r},up,{}\n", 100.0 * i as f64 + 1e-3 * v + 1e-5 * r as f64, 100 * i)
    });
    let clocks = swapped(&format!("{long},time_s"), &|i, r, v| {
        format!("{},{r},up,{v},{}\n", TARGETS[i], 1000 - 10 * i - r)
    });
    for (name, text, code, words) in [
        ("few", few, "few-positions", "clause 5.3.2 asks for 5"),
        ("runs", runs, "few-runs", "clause 5.3.2 asks for 5 in each direction"),
        ("lone", lone, "one-direction", "unidirectional"),
        ("near", near, "unequal-targets", "targets 305.7 mm and 305.71 mm"),
        ("warm", warm, "outlier-run", "run 4 ↑ stands out"),
        ("deviations", targets_for_deviations, "large-deviation", "columns swapped"),
        ("numbers", targets_for_runs, "strange-run", "runs and targets swapped"),
        ("actual", targets_for_actual, "clustered-targets", "actual positions swapped"),
        ("clocks", clocks, "time-backwards", "from 999 to 998"),
    ] {
        let file = folder.file(&format!("{name}.csv"), text);
        reported(&["evaluate", "iso230-2", &file], 0, code, words);
    }
    let hot = swapped(&format!("{long},temperature_degC"), &|i, r, v| {
        format!("{},{r},up,{v},{}\n", TARGETS[i], 70 + i)
    });
    let file = folder.file("hot.csv", hot);
    reported(&["evaluate", "iso230-2", &file], 2, "temperature-range", "that would be 21.1 °C");
    let file = folder.file("whole.csv", table(row));
    folder.file("whole.toml", "temperature = \"72 degF\"\n");
    reported(&["evaluate", "iso230-2", &file], 2, "unknown-unit", "(°F − 32)/1.8");
}

#[test]
fn other_standards() {
    let folder = Folder::new("bad-others");
    let air = folder.file("air.csv", "time_min,x_um,air_degC\n0,1,70\n10,2,71\n70,3,72\n");
    reported(&["evaluate", "iso230-3", &air], 0, "temperature-range", "Fahrenheit");
    let points = (0..=64).map(|i| f64::from(i) / 10.0);
    let circle: String =
        points.map(|a| format!("{},{}\n", 100.0 * a.cos(), 100.0 * a.sin())).collect();
    let circle = folder.file("circle.csv", format!("x_mm,y_mm\n{circle}"));
    reported(
        &["evaluate", "iso230-4", &circle, "--radius", "150"],
        0,
        "wrong-radius",
        "100.000 mm",
    );
}

#[test]
fn runs_at_temperatures() {
    let folder = Folder::new("bad-expansion");
    let rows = |change: &dyn Fn(f64) -> [f64; 3]| -> String {
        let rows = (0..5).map(|i| 500.0 * f64::from(i)).map(|p| {
            let [at, cold, warm] = change(p);
            format!("{at},{cold},{warm}\n")
        });
        "position_mm,cold_um,warm_um\n".to_owned() + &rows.collect::<String>()
    };
    let right = |p: f64| [p, 0.01 * p, 0.053 * p];
    let temperatures = |cold: &str, warm: &str| {
        format!(
            "name = \"y\"\ntable = \"t.csv\"\n[run.cold]\ntemperature = \"{cold}\"\n[run.warm]\n\
             temperature = \"{warm}\"\n"
        )
    };
    let (c20, c25) = ("20 ± 0.1 degC", "25 ± 0.1 degC");
    let one = "name = \"y\"\ntable = \"t.csv\"\n[run.cold]\ntemperature = \"20 degC\"\n".to_owned();
    let short = rows(&right).lines().take(3).map(|l| format!("{l}\n")).collect::<String>();
    for (study, text, status, code, words) in [
        (temperatures(c20, c25), short, 2, "too-few-positions", "three positions"),
        (one.clone(), rows(&right), 2, "too-few-runs", "two temperatures"),
        (one, rows(&right), 2, "unused-column", "`warm_um`"),
        (temperatures("68 degF", "77 degF"), rows(&right), 2, "unknown-unit", "1.8"),
        (temperatures("68 degC", "77 degC"), rows(&right), 0, "warm-scale", "20.0 °C"),
        (temperatures("200 degC", "210 degC"), rows(&right), 2, "impossible-temperature", "1.8"),
        (temperatures(c25, c20), rows(&right), 0, "identification", "swapped"),
        (temperatures(c20, "20.3 degC"), rows(&right), 0, "little-difference", "0.30 K"),
    ] {
        folder.file("t.csv", text);
        let file = folder.file("study.toml", study);
        reported(&["identify", "expansion", &file], status, code, words);
    }
    assert_eq!(folder.names(), ["study.toml", "t.csv"]);
    // What cannot be read is not reported a second time as missing.
    let file = folder.file("study.toml", temperatures("68 degF", "77 degF"));
    assert!(!trueaxis(&["identify", "expansion", &file]).err.contains("too-few-runs"));
    // Positions and errors swapped.
    folder.file("t.csv", rows(&|p| [0.01 * p + 0.1 * (p / 300.0).sin(), p, 0.053 * p]));
    let file = folder.file("study.toml", temperatures(c20, c25));
    reported(&["identify", "expansion", &file], 0, "identification", "swapped");
    // One run of five does not go with the others.
    let mut text = "position_mm,a_um,b_um,c_um,d_um,e_um\n".to_owned();
    let mut study = "name = \"y\"\ntable = \"t.csv\"\n".to_owned();
    for i in 0..5 {
        let p = 500.0 * f64::from(i);
        let at = |t: f64| 8.6e-3 * p * t;
        let strange = at(4.0) + 50.0 * f64::from(i % 2);
        text += &format!("{p},{},{},{strange},{},{}\n", at(0.0), at(2.0), at(6.0), at(8.0));
    }
    for (i, name) in ["a", "b", "c", "d", "e"].iter().enumerate() {
        study += &format!("[run.{name}]\ntemperature = \"{} ± 0.1 degC\"\n", 20 + 2 * i);
    }
    folder.file("t.csv", text);
    let file = folder.file("study.toml", study);
    reported(&["identify", "expansion", &file], 0, "identification", "run `c`");
}
