//! A feed per minute, per revolution and in inverse time: three notations of one speed.

use super::drawn::{ISSUE, ends, machine};
use trueaxis::machine::Machine;
use trueaxis::nc::Control;
use trueaxis::simulate::Densify;

fn mill() -> Machine {
    machine("w C' b X Y Z t", ISSUE)
}

/// How long the blocks of these lines last, s.
fn lasts_s(control: Control, text: &str, lines: &[u32]) -> Vec<f64> {
    let ends = ends(&mill(), control, text, Densify::default());
    let last = |line: u32| ends.iter().rposition(|e| e.0 == line).expect("a block");
    let before = |line: u32| last(line).checked_sub(1).map_or(0.0, |i| ends[i].1);
    lines.iter().map(|line| ends[last(*line)].1 - before(*line)).collect()
}

/// 100 mm at 600 mm/min, at 0.5 mm a revolution of 1200 1/min, and in 1/6 min.
#[test]
fn law_three_notations_of_a_feed_take_the_same_time() {
    // 10 s, and once the time of a ramp of 10 mm/s at 20 m/s³: 2·√(10/20000) = 0.045 s.
    let by_hand_s = 10.0 + 2.0 * (10.0_f64 / 20_000.0).sqrt();
    let codes = [Control::Fanuc, Control::LinuxCnc, Control::Sinumerik840d];
    for control in codes {
        let text = "G90 S1200 M3\nG0 X0 Y0 Z0\nG94 G1 X100 F600\nG95 G1 X0 F0.5\nG93 G1 X100 F6\n\
                    G94 G1 X0 F600\nM30\n";
        for (n, s) in lasts_s(control, text, &[3, 4, 5, 6]).iter().enumerate() {
            assert!(
                (s - by_hand_s).abs() < 1e-6,
                "{control:?} block {n}: {s} s, {by_hand_s} s by hand"
            );
        }
    }
    let text = "BEGIN PGM A MM\nTOOL CALL 1 Z S1200\nL X+0 Y+0 Z+0 R0 FMAX M3\nL X+100 F600\n\
                L X+0 FU0.5\nL X+100 F600\nEND PGM A MM\n";
    for s in lasts_s(Control::Heidenhain, text, &[4, 5, 6]) {
        assert!((s - by_hand_s).abs() < 1e-6, "{s} s, {by_hand_s} s by hand");
    }
}

/// The spindle's speed counts when the block is run, not when the feed was written.
#[test]
fn a_feed_per_revolution_follows_the_spindle() {
    let text = "G90 S600 M3\nG0 X0 Y0 Z0\nG95 G1 X100 F0.5\nS1200\nG1 X0\nG94\nG1 X100 F300\nM30\n";
    for control in [Control::Fanuc, Control::LinuxCnc, Control::Sinumerik840d] {
        let s = lasts_s(control, text, &[3, 5, 7]);
        for (found, by_hand) in s.iter().zip([20.0, 10.0, 20.0]) {
            assert!((found - by_hand).abs() < 0.1, "{control:?}: {s:?}");
        }
    }
}

/// In inverse time a block lasts 1/F minutes however far it goes, about a rotary axis too.
#[test]
fn in_inverse_time_the_length_does_not_matter() {
    let text = "G90 G0 X0 Y0 Z0 C0\nG93 G1 X10 F4\nG1 X300 F4\nG1 C180 F4\nG1 X0 C90 F2\nM30\n";
    for control in [Control::Fanuc, Control::LinuxCnc, Control::Sinumerik840d] {
        let s = lasts_s(control, text, &[2, 3, 4, 5]);
        for (found, by_hand) in s.iter().zip([15.0, 15.0, 15.0, 30.0]) {
            assert!((found - by_hand).abs() < 0.2, "{control:?}: {s:?}");
        }
    }
}

/// A block to the place where the tool is, or nearer to it than any control knows places, takes no time in inverse time
/// either, as in LinuxCNC; with the numbers of the axes and with those of the tip.
#[test]
fn law_in_inverse_time_a_block_without_motion_takes_no_time() {
    let head = "G90 G0 X0 Y0 Z0 C0\n";
    for (on, off) in [("", ""), ("G43.4 H0\n", "G49\n")] {
        let program = |between: &str| {
            format!(
                "{head}{on}G93 G1 X10 F4\n{between}G1 X20 C30 F4\n{between}G94\nG1 X0 F300\n{off}M30\n"
            )
        };
        let all_s = |between: &str| {
            let text = program(between);
            ends(&mill(), Control::Fanuc, &text, Densify::default()).last().expect("ends").1
        };
        let wanted = all_s("");
        assert!((wanted - 34.0).abs() < 0.1, "{wanted} s");
        for between in [
            "G1 F4\n",
            "G91 G1 X0 F4\nG90\n",
            "G91 G1 X0.0000001 F0.5\nG90\n",
            "G91 G1 X0 C0.0000003 F2\nG90\n",
        ] {
            let found = all_s(between);
            assert!((found - wanted).abs() < 0.05, "{on}{between}: {found} s, not {wanted} s");
        }
    }
}
