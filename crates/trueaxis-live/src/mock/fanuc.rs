//! A FANUC control: axes that move, work zero offsets, a PMC with its ladder, and faults on request.

use super::ladder::{Ladder, LadderSettings};
use super::path::MockPath;
use crate::control::Mode;
use crate::focas::{PmcAddress, PmcAreas, PmcBit};
use std::collections::BTreeMap;

/// A scan of the PMC takes so long, s.
const SCAN_S: f64 = 0.008;

/// What a mock is.
#[derive(Debug, Clone)]
pub struct MockPlan {
    /// The names of its axes.
    pub axes: Vec<String>,
    /// The live axes, by their places: those whose offsets stand in the PMC area.
    pub live: Vec<usize>,
    /// Digits of positions and offsets after the decimal point: 3 is 1 µm.
    pub decimals: u16,
    /// Where the axes go.
    pub path: MockPath,
    /// Where the ladder reads and writes.
    pub areas: PmcAreas,
    /// Bits of reference points.
    pub referenced: PmcAddress,
    /// The bit that forbids changes.
    pub inhibit: PmcBit,
    /// The watchdog.
    pub ladder: LadderSettings,
}

/// What is wrong with a mock; all of it can be switched at any time.
#[derive(Debug, Clone)]
pub struct Faults {
    /// It accepts connections and answers nothing.
    pub frozen: bool,
    /// Its cable is pulled.
    pub cut: bool,
    /// How long an answer takes.
    pub latency_s: f64,
    /// Status of every write.
    pub refuse_writes: i16,
    /// Status of a write to this axis of EXT, from 1.
    pub refuse_axis: Option<(u16, i16)>,
    /// A written value can be read only so much later.
    pub visible_after_s: f64,
    /// Every answer is changed by this before it is sent.
    pub garble: Option<fn(Vec<u8>) -> Vec<u8>>,
    /// Emergency stop.
    pub emergency: bool,
    /// The reference points are lost.
    pub unhomed: bool,
    /// The mode.
    pub mode: Mode,
    /// Probing or threading.
    pub inhibited: bool,
    /// It does not say which block runs.
    pub without_blocks: bool,
}

impl Default for Faults {
    fn default() -> Self {
        Self {
            frozen: false,
            cut: false,
            latency_s: 0.0,
            refuse_writes: 0,
            refuse_axis: None,
            visible_after_s: 0.0,
            garble: None,
            emergency: false,
            unhomed: false,
            mode: Mode::Automatic,
            inhibited: false,
            without_blocks: false,
        }
    }
}

/// A change that is not visible yet.
#[derive(Debug, Clone)]
pub(super) enum Change {
    Byte(PmcAddress, u8),
    Ext(usize, i32),
}

/// A mock of a FANUC control.
#[derive(Debug, Clone)]
pub struct FanucMock {
    pub(super) plan: MockPlan,
    /// What is wrong with it.
    pub faults: Faults,
    pub(super) bytes: BTreeMap<(char, u16), u8>,
    pub(super) ext: Vec<i32>,
    pub(super) macros: BTreeMap<i32, f64>,
    pub(super) later: Vec<(f64, Change)>,
    ladder: Ladder,
    now_s: f64,
    /// Writes of offsets that have come, for tests: time, increments of all live axes.
    written: Vec<(f64, Vec<i32>)>,
}

impl FanucMock {
    /// Homed, in automatic, nothing written.
    pub fn new(plan: MockPlan) -> Self {
        let ladder = Ladder::new(plan.ladder, plan.live.len());
        Self {
            faults: Faults::default(),
            bytes: BTreeMap::new(),
            ext: vec![0; plan.axes.len()],
            macros: BTreeMap::new(),
            later: Vec::new(),
            ladder,
            now_s: 0.0,
            written: Vec::new(),
            plan,
        }
    }

    /// A byte of the PMC that the ladder of its builder sets.
    pub fn set_byte(&mut self, at: PmcAddress, value: u8) {
        self.bytes.insert((at.letter, at.byte), value);
    }

    /// The time until which it has gone on, s.
    pub fn now_s(&self) -> f64 {
        self.now_s
    }

    /// Goes on to a time.
    pub fn advance(&mut self, to_s: f64) {
        while self.now_s < to_s {
            let dt_s = (to_s - self.now_s).min(SCAN_S);
            self.now_s += dt_s;
            self.show_changes();
            self.scan(dt_s);
            if self.moves() {
                self.plan.path.advance(dt_s);
            }
        }
    }

    fn show_changes(&mut self) {
        let now_s = self.now_s;
        let (due, later) =
            std::mem::take(&mut self.later).into_iter().partition(|(at, _)| *at <= now_s);
        self.later = later;
        let due: Vec<(f64, Change)> = due;
        due.into_iter().for_each(|(_, change)| self.apply(change));
    }

    pub(super) fn apply(&mut self, change: Change) {
        match change {
            Change::Byte(address, byte) => {
                self.bytes.insert((address.letter, address.byte), byte);
            }
            Change::Ext(axis, value) => self.ext[axis] = value,
        }
    }

    fn scan(&mut self, dt_s: f64) {
        let heartbeat = self.byte(self.plan.areas.heartbeat);
        let mut command = self.command();
        let before = command.clone();
        self.ladder.scan(dt_s, heartbeat, &mut command);
        if command != before {
            self.put_words(self.plan.areas.command, &command);
        }
        let acting = self.ladder.acting();
        self.put_words(self.plan.areas.acting, &acting);
        self.put_bit(self.plan.areas.tripped, self.ladder.tripped());
        self.put_bit(self.plan.inhibit, self.faults.inhibited);
        let homed = if self.faults.unhomed { 0 } else { 0xff };
        self.apply(Change::Byte(self.plan.referenced, homed));
    }

    /// Whether the program goes on.
    pub(super) fn moves(&self) -> bool {
        !self.faults.emergency && self.faults.mode == Mode::Automatic && !self.hold_is_asked()
    }

    /// Feed hold was asked for.
    pub fn hold_is_asked(&self) -> bool {
        let bit = self.plan.areas.ask_hold;
        bit.is_set(self.byte(bit.byte))
    }

    pub(super) fn byte(&self, at: PmcAddress) -> u8 {
        self.bytes.get(&(at.letter, at.byte)).copied().unwrap_or(0)
    }

    fn put_bit(&mut self, bit: PmcBit, set: bool) {
        let byte = self.byte(bit.byte) & !(1 << bit.bit) | u8::from(set) << bit.bit;
        self.apply(Change::Byte(bit.byte, byte));
    }

    fn put_words(&mut self, from: PmcAddress, words: &[i32]) {
        let bytes = words.iter().flat_map(|word| word.to_be_bytes());
        for (at, byte) in (from.byte..).zip(bytes) {
            self.apply(Change::Byte(PmcAddress { byte: at, ..from }, byte));
        }
    }

    /// The offsets that are commanded through the PMC.
    pub fn command(&self) -> Vec<i32> {
        let from = self.plan.areas.command;
        let byte = |at| self.byte(PmcAddress { byte: at, ..from });
        let word = |i: u16| {
            let at = from.byte + 4 * i;
            i32::from_be_bytes([byte(at), byte(at + 1), byte(at + 2), byte(at + 3)])
        };
        (0..).map(word).take(self.plan.live.len()).collect()
    }

    /// The offsets that act on the live axes now, from both levers, increments.
    pub fn acting(&self) -> Vec<i32> {
        let ladder = self.ladder.acting();
        self.plan.live.iter().zip(ladder).map(|(axis, acting)| acting + self.ext[*axis]).collect()
    }

    /// Whether the watchdog has tripped.
    pub fn tripped(&self) -> bool {
        self.ladder.tripped()
    }

    /// Where the program wants the axes, mm or deg.
    pub fn programmed(&self) -> Vec<f64> {
        self.plan.path.positions()
    }

    /// Machine positions: what acts is in them, mm or deg.
    pub fn machine_positions(&self) -> Vec<f64> {
        let mut positions = self.programmed();
        let increment = 10f64.powi(-i32::from(self.plan.decimals));
        for (axis, acting) in self.plan.live.iter().zip(self.acting()) {
            positions[*axis] += f64::from(acting) * increment;
        }
        positions
    }

    /// The sequence number: N10 goes to the first stop and stays there, N20 to the second one.
    pub(super) fn sequence(&self) -> i32 {
        i32::try_from(10 * (self.plan.path.block() + 1)).unwrap_or(i32::MAX)
    }

    pub(super) fn feed(&self) -> f64 {
        if self.moves() { self.plan.path.feed_mm_per_min() } else { 0.0 }
    }

    /// What was written, and when.
    pub fn written(&self) -> &[(f64, Vec<i32>)] {
        &self.written
    }

    pub(super) fn note_write(&mut self, offsets: Vec<i32>) {
        self.written.push((self.now_s, offsets));
        // A mock that runs for days keeps the last ones.
        let extra = self.written.len().saturating_sub(100_000);
        self.written.drain(..extra);
    }

    /// The axes have other names, as those of another machine.
    pub fn rename_axes(&mut self, names: &[&str]) {
        self.plan.axes = names.iter().map(|name| (*name).to_owned()).collect();
    }

    /// The operator types an external offset.
    pub fn edit_ext(&mut self, axis: usize, increments: i32) {
        self.ext[axis] = increments;
    }

    /// Another program writes into the PMC area.
    pub fn edit_command(&mut self, live: usize, increments: i32) {
        let mut command = self.command();
        command[live] = increments;
        self.put_words(self.plan.areas.command, &command);
    }

    /// Power off and on: the PMC area is empty, EXT stays or not.
    pub fn restart(&mut self, keeps_ext: bool) {
        self.bytes.clear();
        self.later.clear();
        self.ladder.restart();
        if !keeps_ext {
            self.ext.fill(0);
        }
    }
}
