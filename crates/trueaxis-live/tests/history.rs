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
    let mut rig = Rig::new(standing(&[]));
    let mut peaks = Peaks::default();
    // By hand from what the mock holds: of each line and axis the largest before and after, µm.
    let (mut lines, mut expected) = (Vec::new(), Vec::new());
    for second in 0..30 {
        let mut worst = [[None::<f64>; 2]; 2];
        for _ in 0..20 {
            rig.cycle();
            let cycle = rig.last.as_ref().expect("a cycle");
            peaks.add(&rig.plan, cycle, rig.run.correction());
            let Some(target) = &cycle.output.target else { continue };
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
                for (worst, now) in worst[axis]
                    .iter_mut()
                    .zip([-target.offsets[axis], acting - target.offsets[axis]])
                {
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
    let shown = history(&folder.0, &rig.plan, 1.0);
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
        "date_s,time_s,state,X_before_um,X_left_um,Y_before_um,Y_left_um,scale_x_celsius,scale_y_celsius,workpiece_celsius"
    );
    let row = |i: usize| {
        let left = if i == 4321 { "-77" } else { "0.25" };
        format!("{},{}.0,Run,50,{left},,,30.5,,30.5", 100_000 + 10 * i, 10 * i)
    };
    let lines: Vec<String> = (0..8000).map(row).collect();
    // A day is kept in two files; a line that was cut is left out.
    let folder = Folder::new("peak-history");
    folder.write("history-before.csv", &head, &lines[..5000]);
    folder.write("history.csv", &head, &[&["99,3.0,Run,1".to_owned()], &lines[5000..]].concat());
    let day = history(&folder.0, &plan, 48.0);
    assert!(day.date_s.len() <= 1500 && day.date_s.len() > 1000, "{}", day.date_s.len());
    let axis = &day.axes[0];
    assert!(axis.left.contains(&Some(-77.0)) && axis.left_max == Some(77.0));
    let rms = ((77.0_f64.powi(2) + 7999.0 * 0.25 * 0.25) / 8000.0).sqrt();
    assert!((axis.left_rms.expect("known") - rms).abs() < 1e-9, "{axis:?} {rms}");
    // Nothing known is not nothing off.
    let silent = &day.axes[1];
    assert!(silent.left.iter().all(Option::is_none), "{silent:?}");
    assert_eq!((silent.before_max, silent.left_max, silent.left_rms), (None, None, None));
    let hours = history(&folder.0, &plan, 2.0);
    assert_eq!((hours.date_s.len(), hours.axes[0].left_max), (721, Some(0.25)));
    // Of a plan with other axes or sensors nothing is shown.
    let other = standing(&[("[sensor.workpiece]", "[sensor.part]\ninput = \"workpiece\"")]);
    assert!(history(&folder.0, &other, 48.0).date_s.is_empty());
}
