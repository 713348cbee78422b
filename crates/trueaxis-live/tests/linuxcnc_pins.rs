//! Which pin of LinuxCNC is which: every one holds a number of its own.

use trueaxis_live::control::{Block, Control};
use trueaxis_live::linuxcnc::{Joint, LinuxCnc, LinuxCncSettings, LiveJoint, Pins};

struct Still {
    numbers: Vec<f64>,
    bits: usize,
}

impl Pins for Still {
    fn number(&self, at: usize) -> f64 {
        self.numbers[at]
    }
    fn bit(&self, at: usize) -> bool {
        assert!(at < self.bits);
        false
    }
    fn set_number(&mut self, _: usize, _: f64) {}
    fn set_bit(&mut self, _: usize, _: bool) {}
}

/// The line of the program, the velocity, the tool length and the number of the setup come from the pins of these names, however many axes are
/// live; line 0 is none.
#[test]
fn what_is_seen_comes_from_the_pin_of_its_name() {
    for live in 1..4 {
        let joint = |name: &str| Joint { name: name.to_owned(), is_rotary: false };
        let settings = LinuxCncSettings {
            joints: ["X", "Y", "Z"].map(joint).to_vec(),
            live: (0..live).map(|joint| LiveJoint { joint, increment: 1.0 }).collect(),
            timeout_s: 0.1,
            has_setup: true,
        };
        let layout = settings.layout();
        let place = |name: &str| layout.numbers_in.iter().position(|n| n == name).expect("a pin");
        let numbers = |line: f64| {
            let mut all: Vec<f64> = (1..=layout.numbers_in.len()).map(|i| i as f64).collect();
            // No cycle of the servo thread lies between its first and its last function.
            all[place("end")] = all[place("begin")];
            all[place("program-line")] = line;
            all
        };
        let read = |line: f64| {
            let pins = Still { numbers: numbers(line), bits: layout.bits_in.len() };
            LinuxCnc::new(pins, settings.clone()).read(0.0).expect("a reading")
        };
        let seen = read(4711.0);
        assert_eq!(seen.block, Some(Block { program: 0, number: 4711 }));
        assert_eq!(seen.feed_mm_per_min, 60.0 * (place("velocity") + 1) as f64);
        assert_eq!(seen.tool_length_mm, Some((place("tool-length") + 1) as f64));
        assert_eq!(seen.setup, Some(place("setup") as i32 + 1));
        assert_eq!(read(0.0).block, None);
    }
}
