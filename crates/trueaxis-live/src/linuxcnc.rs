//! LinuxCNC as a control: signals of its HAL, once in a servo cycle.
//!
//! ```text
//!     joints, tip, state ──signals──> [`LinuxCnc`] ──offset of each axis, heartbeat──> trueaxis.hal ──> axis.L.eoffset
//! ```
//!
//! `examples/08_live/linuxcnc/trueaxis.hal` is the part in the control: it limits and ramps the offsets, watches the
//! heartbeat, takes the offsets to zero before the kinematics change, and starts again after the machine was off. Offsets
//! are external offsets of LinuxCNC, in mm and deg: with tool-centre-point kinematics they are added to the programmed
//! tip and angles, else to the joints.

mod hal;

pub use hal::{HalFault, HalPins};

use crate::control::{Block, Control, Identity, LinkFault, Mode, Seen, Sent};
use crate::pose::Frame;
use trueaxis::geometry::Vec3;

/// The pins of one run, each with the signal that it belongs to: `joint-x` has the signal `ta-joint-x`.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Layout {
    /// Numbers from the control.
    pub numbers_in: Vec<String>,
    /// Bits from the control.
    pub bits_in: Vec<String>,
    /// Numbers to the control.
    pub numbers_out: Vec<String>,
    /// Bits to the control.
    pub bits_out: Vec<String>,
}

/// What a control reads and writes, by the places in a [`Layout`].
pub trait Pins {
    /// A number from the control.
    fn number(&self, at: usize) -> f64;
    /// A bit from the control.
    fn bit(&self, at: usize) -> bool;
    /// A number to the control.
    fn set_number(&mut self, at: usize, value: f64);
    /// A bit to the control.
    fn set_bit(&mut self, at: usize, value: bool);
}

/// One axis of the machine file.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Its letter.
    pub name: String,
    /// Its positions are degrees.
    pub is_rotary: bool,
}

/// One live axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LiveJoint {
    /// Its place among the joints.
    pub joint: usize,
    /// The least increment of its offset. Unit: mm or rad.
    pub increment: f64,
}

/// One control.
#[derive(Debug, Clone, PartialEq)]
pub struct LinuxCncSettings {
    /// The axes of the machine file, in its order.
    pub joints: Vec<Joint>,
    /// Those that are corrected.
    pub live: Vec<LiveJoint>,
    /// A servo thread that does not go on for so long has ended.
    pub timeout_s: f64,
    /// The number of the setup stands in a signal.
    pub has_setup: bool,
}

const WORLD: [&str; 3] = ["x", "y", "z"];
const BITS_IN: [&str; 9] =
    ["enabled", "auto", "mdi", "manual", "running", "inhibit", "tripped", "switching", "tcp"];
const BITS_OUT: [&str; 3] = ["heartbeat", "enable", "ask-hold"];
/// How often a reading is made again while the servo thread writes.
const MOST_TRIES: u32 = 2000;
/// Axes and tool that have not changed in so many cycles stand: the interpolator of the control is empty then, and it has
/// counted its tip again after a change of the tool length.
const STANDING_CYCLES: u32 = 100;

/// Where each signal of the control is in the layout.
#[derive(Debug, Clone, Copy)]
struct Places {
    world: usize,
    acting: usize,
    request: usize,
    begin: usize,
    homed: usize,
}

impl LinuxCncSettings {
    /// The signals.
    pub fn layout(&self) -> Layout {
        let letter = |joint: &Joint| joint.name.to_lowercase();
        let live = |of: &str| {
            let names = self.live.iter().map(|l| format!("{of}-{}", letter(&self.joints[l.joint])));
            names.collect::<Vec<_>>()
        };
        let joints = |of: &str| self.joints.iter().map(|j| format!("{of}-{}", letter(j))).collect();
        let mut numbers_in: Vec<String> = joints("joint");
        numbers_in.extend(WORLD.map(|l| format!("tip-{l}")));
        numbers_in.extend(live("acting"));
        numbers_in.extend(live("request"));
        numbers_in
            .extend(["begin", "end", "velocity", "tool-length", "program-line"].map(str::to_owned));
        numbers_in.extend(self.has_setup.then(|| "setup".to_owned()));
        let mut bits_in = BITS_IN.map(str::to_owned).to_vec();
        bits_in.extend(joints("homed"));
        let mut numbers_out = live("offset");
        numbers_out.push("echo".to_owned());
        Layout { numbers_in, bits_in, numbers_out, bits_out: BITS_OUT.map(str::to_owned).to_vec() }
    }

    fn places(&self) -> Places {
        let (joints, live) = (self.joints.len(), self.live.len());
        let (world, acting) = (joints, joints + 3);
        Places {
            world,
            acting,
            request: acting + live,
            begin: acting + 2 * live,
            homed: BITS_IN.len(),
        }
    }
}

/// LinuxCNC as a [`Control`].
#[derive(Debug)]
pub struct LinuxCnc<P> {
    pins: P,
    settings: LinuxCncSettings,
    at: Places,
    /// What was written last, in increments.
    written: Vec<i32>,
    /// The clock of the servo thread, and when it last went on.
    clock: Option<(f64, f64)>,
    /// The joints of the last reading, for how many cycles they have not moved, the tool length.
    standing: (Vec<f64>, u32, f64),
    /// The watchdog starts again with the next write.
    is_rearming: bool,
}

impl<P: Pins> LinuxCnc<P> {
    /// Over pins that have the layout of the settings. It takes over what the control holds.
    pub fn new(pins: P, settings: LinuxCncSettings) -> Self {
        let at = settings.places();
        let live = settings.live.len();
        let mut control = Self {
            pins,
            settings,
            at,
            written: vec![0; live],
            clock: None,
            standing: (Vec::new(), 0, 0.0),
            is_rearming: false,
        };
        control.take_request();
        control
    }

    /// What the control holds, in increments: what this program owns in it at the start.
    pub fn held(&self) -> &[i32] {
        &self.written
    }

    /// The pins.
    pub fn pins(&mut self) -> &mut P {
        &mut self.pins
    }

    fn increment(&self, live: usize) -> f64 {
        let LiveJoint { joint, increment } = self.settings.live[live];
        // mm and deg in the control.
        if self.settings.joints[joint].is_rotary { increment.to_degrees() } else { increment }
    }

    #[expect(
        clippy::cast_possible_truncation,
        reason = "it saturates; a plan has limits far below"
    )]
    fn counted(&self, from: usize) -> Vec<i32> {
        let live = 0..self.settings.live.len();
        live.map(|i| (self.pins.number(from + i) / self.increment(i)).round() as i32).collect()
    }

    /// Our own pins hold from now on what the control holds.
    fn take_request(&mut self) {
        self.written = self.counted(self.at.request);
        self.set_offsets();
    }

    fn set_offsets(&mut self) {
        for i in 0..self.written.len() {
            let value = f64::from(self.written[i]) * self.increment(i);
            self.pins.set_number(i, value);
        }
    }

    /// A reading between two cycles of the servo thread: its first function counts `begin`, its last one `end`.
    fn snapshot(&self) -> (Vec<f64>, Seen) {
        let mut tries = 0;
        loop {
            let end = self.pins.number(self.at.begin + 1);
            let read = self.read_once();
            tries += 1;
            if self.pins.number(self.at.begin) == end || tries == MOST_TRIES {
                return read;
            }
            std::hint::spin_loop();
        }
    }

    /// Joints as the control has them, and what is seen.
    fn read_once(&self) -> (Vec<f64>, Seen) {
        let (pins, at) = (&self.pins, &self.at);
        let raw: Vec<f64> = (0..self.settings.joints.len()).map(|i| pins.number(i)).collect();
        let joints = raw.iter().zip(&self.settings.joints);
        let positions =
            joints.map(|(q, j)| if j.is_rotary { q.to_radians() } else { *q }).collect();
        let bit = |name: &str| BITS_IN.iter().position(|n| *n == name).is_some_and(|i| pins.bit(i));
        let (tripped, switching) = (bit("tripped"), bit("switching"));
        let mode = match (bit("auto"), bit("mdi"), bit("manual")) {
            (true, ..) => Mode::Automatic,
            (_, true, _) => Mode::Mdi,
            (.., true) => Mode::Manual,
            _ => Mode::Other,
        };
        let tool_length = pins.number(at.begin + 3);
        let seen = Seen {
            positions,
            offsets: self.written.clone(),
            acting: Some(self.counted(at.acting)),
            homed: (0..self.settings.joints.len()).all(|i| pins.bit(at.homed + i)),
            // Off, E-stop and a following error all take the machine off.
            emergency: !bit("enabled"),
            alarm: false,
            mode,
            cutting: bit("running"),
            inhibited: bit("inhibit"),
            tripped,
            released: tripped || switching,
            feed_mm_per_min: 60.0 * pins.number(at.begin + 2),
            frame: if bit("tcp") { Frame::Workpiece } else { Frame::Machine },
            tool_length_mm: Some(tool_length),
            standing_tip_mm: None,
            block: block(pins.number(at.begin + 4)),
            setup: self.setup(),
        };
        (raw, seen)
    }

    /// The number of the setup that is in the machine.
    #[expect(clippy::cast_possible_truncation, reason = "a small number; it saturates")]
    fn setup(&self) -> Option<i32> {
        let number = || self.pins.number(self.at.begin + 5).round() as i32;
        self.settings.has_setup.then(number)
    }

    /// The tip of the control, once its axes stand: while they move it is some cycles ahead of the joints.
    fn standing_tip(&mut self, raw: &[f64], tool_length: f64) -> Option<[f64; 3]> {
        let same = self.standing.0 == raw && self.standing.2 == tool_length;
        self.standing.1 = if same { self.standing.1.saturating_add(1) } else { 0 };
        if !same {
            raw.clone_into(&mut self.standing.0);
            self.standing.2 = tool_length;
        }
        if self.standing.1 < STANDING_CYCLES {
            return None;
        }
        // That of the program: its offsets come to it. LinuxCNC counts Z to the spindle: the tool is below it.
        let mut tip: [f64; 3] = std::array::from_fn(|i| self.pins.number(self.at.world + i));
        tip[2] -= tool_length;
        for (i, live) in self.settings.live.iter().enumerate() {
            let letter = self.settings.joints[live.joint].name.to_lowercase();
            if let Some(to) = WORLD.iter().position(|known| *known == letter) {
                tip[to] += self.pins.number(self.at.acting + i);
            }
        }
        Some(tip)
    }
}

impl<P: Pins> Control for LinuxCnc<P> {
    fn identity(&mut self, _: f64) -> Result<Identity, LinkFault> {
        let axes: Vec<String> = self.settings.joints.iter().map(|j| j.name.clone()).collect();
        let decimals = vec![0; axes.len()];
        let kind = "linuxcnc".to_owned();
        Ok(Identity { kind, series: axes.concat(), version: "HAL".to_owned(), axes, decimals })
    }

    fn read(&mut self, now_s: f64) -> Result<Seen, LinkFault> {
        let clock = self.pins.number(self.at.begin + 1);
        let since = match self.clock {
            Some((last, since)) if last == clock => since,
            _ => now_s,
        };
        self.clock = Some((clock, since));
        if now_s - since > self.settings.timeout_s {
            let reason = "the servo thread of LinuxCNC has stopped".to_owned();
            return Err(LinkFault::Down { reason });
        }
        let (raw, mut seen) = self.snapshot();
        if raw.iter().any(|q| !q.is_finite()) {
            let reason = "a joint position of LinuxCNC is no number".to_owned();
            return Err(LinkFault::Garbage { reason });
        }
        if seen.released {
            // The control goes to zero by itself, and starts from there when it lets us in again.
            if seen.tripped {
                self.take_request();
            } else {
                self.written.fill(0);
                self.set_offsets();
            }
            seen.offsets.clone_from(&self.written);
            self.is_rearming = seen.tripped && self.written.iter().all(|n| *n == 0);
        }
        let length = seen.tool_length_mm.unwrap_or(0.0);
        let tip = self.standing_tip(&raw, length);
        seen.standing_tip_mm = tip.filter(|_| seen.frame == Frame::Workpiece && !seen.released);
        self.pins.set_number(self.settings.live.len(), clock);
        Ok(seen)
    }

    fn write(&mut self, sent: &Sent, _: f64) -> Result<(), LinkFault> {
        if let Some(offsets) = &sent.offsets {
            self.written.clone_from(offsets);
            self.set_offsets();
        }
        let rearm = std::mem::take(&mut self.is_rearming);
        self.pins.set_bit(0, sent.beat & 1 == 1);
        self.pins.set_bit(1, !rearm);
        self.pins.set_bit(2, sent.ask_hold);
        Ok(())
    }

    fn is_volatile(&self) -> bool {
        true
    }
}

/// The line that is executed; LinuxCNC says 0 between programs.
#[expect(clippy::cast_possible_truncation, reason = "a line of a program; it saturates")]
fn block(line: f64) -> Option<Block> {
    Some(Block { program: 0, number: line as i32 }).filter(|block| block.number > 0)
}

/// The tip that the control counts, against the one of the machine file: they differ by the zero of the program only.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct KinematicsCheck {
    zero: Option<Vec3>,
}

/// Where control and machine file are apart by more, mm, one of them describes another machine.
pub const MOST_APART_MM: f64 = 0.005;

impl KinematicsCheck {
    /// One standing pose: the tip of the control and that of the nominal machine, both in X Y Z of the control, mm. How
    /// far they have come apart since the first one, if that is too far.
    pub fn apart(&mut self, control: &Vec3, nominal: &Vec3) -> Option<f64> {
        let by = control - nominal;
        let zero = *self.zero.get_or_insert(by);
        let apart = (by - zero).norm();
        (apart > MOST_APART_MM).then_some(apart)
    }
}
