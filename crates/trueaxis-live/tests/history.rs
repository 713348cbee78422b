//! The history of a run on the mock: what it says of each axis before and after, over a restart, with a peak in it.

mod rig;

use rig::{Rig, standing};
use std::path::PathBuf;
use trueaxis_live::history::{Peaks, heading, history, line};
use trueaxis_live::status::{LiveState, live_state};

struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("trueaxis-{name}-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&path);
        std::fs::create_dir_all(&path).expect("a folder");
        Self(path)
    }

    fn write(&self, name: &str, heading: &str, lines: &[String]) {
        let text = format!("{heading}\n{}\n", lines.join("\n"));
        std::fs::write(self.0.join(name), text).expect("written");
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn state(rig: &Rig, date_s: u64) -> LiveState {
    let cycle = rig.last.as_ref().expect("a cycle");
    let correction = rig.run.correction();
    let mut state = live_state(&rig.plan, &rig.identity, cycle, correction, rig.run.counts());
    state.date_s = date_s;
    state
}

/// Before is minus the target, and after is what acts minus the target; each line has the largest of its time.
#[test]
fn law_before_is_the_target_and_after_what_is_not_yet_written() {
    follows_the_target(&[], 1.0);
}

/// With `sign = -1` the offset is against the axis, and what the tool is off by is the same as without.
#[test]
fn law_a_history_has_the_direction_of_the_axis() {
    follows_the_target(&[("increment = \"1 um\"", "increment = \"1 um\"\nsign = -1")], -1.0);
}

fn follows_the_target(changes: &[(&str, &str)], sign: f64) {
    let mut rig = Rig::new(standing(changes));
    let mut peaks = Peaks::default();
    // Of each axis the squares of all cycles, and how many they were.
    let (mut squares, mut cycles) = ([[0.0_f64; 2]; 2], 0.0);
    // By hand from what the mock holds: of each line and axis the largest before and after, µm.
    let (mut lines, mut expected) = (Vec::new(), Vec::new());
    for second in 0..30 {
        let mut worst = [[None::<f64>; 2]; 2];
        for _ in 0..20 {
            rig.cycle();
            let cycle = rig.last.as_ref().expect("a cycle");
            peaks.add(&rig.plan, cycle, rig.run.correction());
            let Some(target) = &cycle.output.target else { continue };
            cycles += 1.0;
            let acts = cycle
                .input
                .seen
                .as_ref()
                .expect("a link")
                .acting
                .clone()
                .expect("the mock reports it");
            for axis in 0..2 {
                // The mock began with nothing in it.
                let acting = f64::from(acts[axis]);
                let now = [-target.offsets[axis], acting - target.offsets[axis]];
                for ((worst, now), squares) in
                    worst[axis].iter_mut().zip(now.map(|n| sign * n)).zip(&mut squares[axis])
                {
                    *squares += now * now;
                    if worst.is_none_or(|w| now.abs() > w.abs()) {
                        *worst = Some(now);
                    }
                }
            }
        }
        let state = state(&rig, 1000 + second);
        lines.push(line(&state, &mut peaks));
        expected.push(worst);
    }
    let folder = Folder::new("law-history");
    folder.write("history.csv", &heading(&rig.plan), &lines);
    let shown = history(&folder.0, &rig.plan, (1.0, 1030));
    // At the end of X the tool is off by −54 µm by hand, whatever the sign of its offset.
    assert!(
        shown.axes[0].before[20].is_some_and(|um| (um + 54.1).abs() < 0.1),
        "{:?}",
        shown.axes[0]
    );
    assert_eq!(shown.date_s, (1000..1030).collect::<Vec<u64>>());
    for (i, axis) in shown.axes.iter().enumerate() {
        for (second, expected) in expected.iter().enumerate() {
            for (shown, known) in [axis.before[second], axis.left[second]].iter().zip(expected[i]) {
                match (shown, known) {
                    (Some(shown), Some(known)) => assert!((shown - known).abs() < 0.0051),
                    (shown, known) => assert_eq!(*shown, known),
                }
            }
        }
        // It begins with all of it and ends within the dead band of 1 µm.
        let known = |value: Option<f64>| value.expect("known");
        let [before, left] = [axis.before_max, axis.left_max].map(known);
        assert!(before > 5.0 && left > 0.5 * before, "{axis:?}");
        assert!(axis.left.last().expect("one").expect("known").abs() < 1.5, "{axis:?}");
        // Over all cycles, not over the largest of each line.
        for (rms, squares) in [axis.before_rms, axis.left_rms].iter().zip(squares[i]) {
            assert!((known(*rms) - (squares / cycles).sqrt()).abs() < 0.01, "{axis:?} {squares}");
        }
        assert!(known(axis.left_rms) < known(axis.before_rms), "{axis:?}");
    }
    let warm = |t: &Option<f64>| t.is_some_and(|t| t > 30.0);
    assert!(shown.sensors.iter().all(|s| s.celsius.last().is_some_and(warm)));
}

/// 8000 lines are shown as at most 1500 points, and the peak of one of them is among them; 2 h are 720 lines.
#[test]
fn a_peak_is_not_lost_by_thinning() {
    let plan = standing(&[]);
    let head = heading(&plan);
    assert_eq!(
        head,
        "date_s,time_s,state,cycles,X_before_um,X_left_um,X_before_rms_um,X_left_rms_um,Y_before_um,Y_left_um,Y_before_rms_um,Y_left_rms_um,scale_x_celsius,scale_y_celsius,workpiece_celsius"
    );
    let row = |i: usize| {
        let left = if i == 4321 { "-77" } else { "0.25" };
        format!("{},{}.0,Run,200,50,{left},40,0.125,,,,,30.5,,30.5", 100_000 + 10 * i, 10 * i)
    };
    let lines: Vec<String> = (0..8000).map(row).collect();
    // A day is kept in two files; a line that was cut is left out.
    let folder = Folder::new("peak-history");
    folder.write("history-before.csv", &head, &lines[..5000]);
    folder.write(
        "history.csv",
        &head,
        &[&["99,3.0,Run,200,1".to_owned()], &lines[5000..]].concat(),
    );
    let now_s = 100_000 + 79_990;
    let day = history(&folder.0, &plan, (48.0, now_s));
    assert!(day.date_s.len() <= 1500 && day.date_s.len() > 1000, "{}", day.date_s.len());
    let axis = &day.axes[0];
    assert!(axis.left.contains(&Some(-77.0)) && axis.left_max == Some(77.0));
    assert_eq!((axis.before_rms, axis.left_rms), (Some(40.0), Some(0.125)));
    // Nothing known is not nothing off.
    let silent = &day.axes[1];
    assert!(silent.left.iter().all(Option::is_none), "{silent:?}");
    assert_eq!((silent.before_max, silent.left_max, silent.left_rms), (None, None, None));
    let hours = history(&folder.0, &plan, (2.0, now_s));
    assert_eq!((hours.date_s.len(), hours.axes[0].left_max), (721, Some(0.25)));
    // Of a plan with other axes or sensors nothing is shown.
    let other = standing(&[("[sensor.workpiece]", "[sensor.part]\ninput = \"workpiece\"")]);
    assert!(history(&folder.0, &other, (48.0, now_s)).date_s.is_empty());
}

/// The last hour is the one before now: a run of a week ago, and lines of a clock that was ahead by years, are not in it. Of two lines
/// that count with 100 and 300 cycles the root mean square is √((100 · 3² + 300 · 5²) / 400) = 4.583.
#[test]
fn law_the_last_hour_ends_now() {
    let plan = standing(&[]);
    let row = |date_s: u64, cycles: u32, rms: f64| {
        format!("{date_s},10.0,Run,{cycles},9,9,{rms},{rms},9,9,9,9,30.5,30.5,30.5")
    };
    let now_s = 10_000_000;
    let folder = Folder::new("span-history");
    let write = |rows: &[String]| folder.write("history.csv", &heading(&plan), rows);
    write(&[
        row(now_s + 63_072_000, 1, 500.0),
        row(now_s - 20, 100, 3.0),
        row(now_s - 10, 300, 5.0),
    ]);
    for hours in [1.0 / 60.0, 1.0, 48.0] {
        let found = history(&folder.0, &plan, (hours, now_s));
        assert_eq!(found.date_s, [now_s - 20, now_s - 10], "{hours} h");
        let rms = found.axes[0].left_rms.expect("known");
        assert!((rms - 21.0_f64.sqrt()).abs() < 1e-9, "{rms}");
    }
    write(&[row(now_s - 604_800, 100, 400.0)]);
    let found = history(&folder.0, &plan, (1.0, now_s));
    assert_eq!(
        (found.date_s.len(), found.axes[0].left_max, found.axes[0].left_rms),
        (0, None, None)
    );
    assert_eq!(history(&folder.0, &plan, (200.0, now_s)).date_s.len(), 1);
}
