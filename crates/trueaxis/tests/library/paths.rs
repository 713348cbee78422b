//! Paths that every machine can follow, and every way to write a program of them.

use super::Random;
use std::f64::consts::TAU;
use std::fmt::Write;
use trueaxis::cl::{ClFile, Reading};
use trueaxis::machine::Machine;
use trueaxis::machine::axis::{AxisKind, Command, Travel};
use trueaxis::machine::tcp::TipControl;
use trueaxis::nc::Control;
use trueaxis::post::PostOptions;
use trueaxis::writer::TipWords;

pub const CONTROLS: [Control; 4] =
    [Control::Fanuc, Control::Sinumerik840d, Control::Heidenhain, Control::LinuxCnc];

pub fn cl(text: &str) -> ClFile {
    let (file, problems) = ClFile::read("a.cls", text.as_bytes().to_vec(), &Reading::default());
    assert!(!problems.has_errors(), "{problems:?}");
    file
}

/// A smooth path within the travel of a machine: every axis swings by two sines, so that tips and
/// tool axes are as free as any surface makes them; poles included.
pub fn free_form(machine: &Machine, seed: u64, points: usize) -> String {
    let mut dice = Random(seed);
    let control = TipControl::of(machine).unwrap();
    let mut swings = Vec::new();
    for axis in machine.axes() {
        let (room, most) = match axis.kind {
            AxisKind::Linear => (150.0, 40.0),
            AxisKind::Rotary => (50_f64.to_radians(), 25_f64.to_radians()),
        };
        let middle = match axis.travel {
            Travel::Between(low, high) => 0.5 * (low + high),
            _ => 0.0,
        };
        let room = match axis.travel {
            Travel::Between(low, high) => room.min(0.3 * (high - low)),
            _ => room,
        };
        let middle = middle + dice.between(-0.3, 0.3) * room;
        let sizes = [dice.between(0.1, 1.0), dice.between(0.0, 0.5)];
        let most = most.min(0.3 * room);
        let phases = [dice.between(0.0, TAU), dice.between(0.0, TAU)];
        swings.push((middle, sizes.map(|s| s * most), phases));
    }
    let mut text = "UNITS/MM\nMULTAX/ON\nRAPID\n".to_owned();
    for k in 0..points {
        let t = k as f64 / points as f64;
        let mut command = Command::default();
        for (q, (middle, sizes, phases)) in command.iter_mut().zip(&swings) {
            *q = middle
                + sizes[0] * (TAU * t + phases[0]).sin()
                + sizes[1] * (2.0 * TAU * t + phases[1]).sin();
        }
        let (tip, a) = control.tip_and_axis(&command);
        let _ = writeln!(
            text,
            "GOTO/{:.9},{:.9},{:.9},{:.14},{:.14},{:.14}",
            tip.x, tip.y, tip.z, a.x, a.y, a.z
        );
        if k == 0 {
            text.push_str("FEDRAT/1200,MMPM\n");
        }
    }
    text + "FINI\n"
}

/// Every way to write a program: dialect, with tool-centre point by angles or vectors, or without.
pub fn ways() -> Vec<PostOptions> {
    let mut all = Vec::new();
    for control in CONTROLS {
        for words in [None, Some(TipWords::Angles), Some(TipWords::Vectors)] {
            if control != Control::LinuxCnc || words != Some(TipWords::Vectors) {
                all.push(PostOptions { tip_words: words, ..PostOptions::of(control) });
            }
        }
    }
    all
}
