//! The loop: read, decide, keep, write.

use crate::clock::{Clock, date_s};
use crate::control::{Control, LinkFault, Sent};
use crate::cycle::{Correction, CycleInput, CycleOutput};
use crate::datum::{DatumOrder, DatumOutcome};
use crate::file::Plan;
use crate::governor::{Earlier, Reason, State};
use crate::memory::HeatOfRun;
use crate::sensor::Sensor;
use crate::setups::SetupDatum;
use crate::store::{Event, Store};

/// What a person wants.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Wish {
    /// The correction shall run; without it, it goes to zero.
    pub run: bool,
    /// What was latched is confirmed.
    pub confirmed: bool,
}

/// A run with its control, sensors and store.
pub struct Run<'a> {
    correction: Correction,
    control: Box<dyn Control + 'a>,
    sensors: Vec<Box<dyn Sensor + 'a>>,
    store: Box<dyn Store + 'a>,
    beat: u8,
    write_fault: Option<LinkFault>,
    journal_fails: bool,
    last: (State, Reason),
    /// Nothing is written.
    dry: bool,
    counts: Counts,
    datum: Option<DatumOrder>,
    /// The zeros that the store has; none of a run that commissions an axis, which knows of no zeros and must not replace them.
    kept: Option<Vec<SetupDatum>>,
    memory: Option<HeatOfRun>,
}

/// What was counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Cycles.
    pub cycles: u64,
    /// Periods in which none began.
    pub missed: u64,
    /// Writes.
    pub writes: u64,
    /// Writes that failed.
    pub failed: u64,
}

/// One cycle as it went.
#[derive(Debug, Clone, PartialEq)]
pub struct Cycle {
    /// What was read.
    pub input: CycleInput,
    /// What it came to.
    pub output: CycleOutput,
}

impl<'a> Run<'a> {
    /// Of a plan, with what the journal knows.
    pub fn new(
        plan: &Plan,
        earlier: impl Into<Earlier>,
        control: Box<dyn Control + 'a>,
        sensors: Vec<Box<dyn Sensor + 'a>>,
        store: impl Store + 'a,
    ) -> Self {
        Self {
            correction: Correction::new(plan, earlier),
            control,
            sensors,
            store: Box::new(store),
            beat: 0,
            write_fault: None,
            journal_fails: false,
            last: (State::Off, Reason::NotAsked),
            dry: false,
            counts: Counts::default(),
            datum: None,
            kept: Some(Vec::new()),
            memory: None,
        }
    }

    /// The same with the heat that an earlier run has left in the scales, on the clock of this one.
    #[must_use]
    pub fn with_heat(mut self, memory: Option<HeatOfRun>) -> Self {
        self.memory = memory;
        self
    }

    /// Asks for something of the zero of the part, in the next cycle.
    pub fn ask_datum(&mut self, order: DatumOrder) {
        self.datum = Some(order);
    }

    /// The same, that computes and writes nothing, no heartbeat either.
    #[must_use]
    pub fn dry(mut self) -> Self {
        self.dry = true;
        self
    }

    /// The same with a constant in the place of the model's target: to commission an axis.
    #[must_use]
    pub fn with_target(mut self, offsets: Vec<f64>) -> Self {
        self.correction = self.correction.with_target(offsets);
        self.kept = None;
        self
    }

    /// Sensors, model and governor.
    pub fn correction(&self) -> &Correction {
        &self.correction
    }

    /// Whether nothing is written.
    pub fn is_dry(&self) -> bool {
        self.dry
    }

    /// What was counted.
    pub fn counts(&self) -> Counts {
        self.counts
    }

    /// The store.
    pub fn store(&mut self) -> &mut (dyn Store + 'a) {
        &mut *self.store
    }

    /// One cycle at a time.
    pub fn cycle(&mut self, clock: &dyn Clock, wish: Wish) -> Cycle {
        let now_s = clock.now_s();
        let samples = self.sensors.iter_mut().flat_map(|sensor| sensor.poll(now_s)).collect();
        let mut seen = self.control.read(now_s);
        if let (true, Ok(seen)) = (self.dry, &mut seen) {
            // It gets no heartbeat from a dry run.
            seen.tripped = false;
        }
        let input = CycleInput {
            now_s,
            samples,
            seen,
            write_fault: self.write_fault.take(),
            run: wish.run,
            confirmed: wish.confirmed,
            journal_fails: self.journal_fails,
            datum: self.datum.take(),
            memory: self.memory.take(),
        };
        let output = self.correction.step(&input);
        self.counts.cycles += 1;
        self.note(now_s, &input, &output);
        self.keep_datums(now_s, &input, &output);
        self.send(&input, &output, clock.now_s());
        // A record that is lost does not end a run.
        let _ = self.store.record(&input, &output.order);
        Cycle { input, output }
    }

    /// Changes of state go into the journal.
    fn note(&mut self, now_s: f64, input: &CycleInput, output: &CycleOutput) {
        let now = (output.order.state, output.order.reason.clone());
        let retry = std::mem::take(&mut self.journal_fails);
        let same = now.0 == self.last.0 && now.1.is_like(&self.last.1);
        if same && !retry {
            return;
        }
        let event = Event {
            at_s: now_s,
            date_s: date_s(),
            event: now.0.to_string(),
            what: now.1.to_string(),
            offsets: input.seen.as_ref().map_or_else(|_| Vec::new(), |seen| seen.offsets.clone()),
        };
        match self.store.event(&event) {
            Ok(()) => self.last = now,
            Err(_) => self.journal_fails = true,
        }
    }

    /// An event that changes nothing; one that cannot be kept does not end a run.
    pub fn say(&mut self, now_s: f64, event: &str, what: String) {
        let (event, offsets) = (event.to_owned(), Vec::new());
        let event = Event { at_s: now_s, date_s: date_s(), event, what, offsets };
        let _ = self.store.event(&event);
    }

    /// The zeros are kept whenever one of them is taken, cleared, or a setup is seen first.
    fn keep_datums(&mut self, now_s: f64, input: &CycleInput, output: &CycleOutput) {
        let now = self.correction.setups().known();
        // Not kept, so it would be lost at a restart: the offsets wait until the journal can be written.
        if self.kept.as_ref().is_some_and(|kept| now != kept.as_slice()) {
            match self.store.datums(now) {
                Ok(()) => self.kept = Some(now.to_vec()),
                Err(_) => self.journal_fails = true,
            }
        }
        let Some(outcome) = &output.datum else { return };
        let (event, what) = shown_outcome(outcome);
        let event = Event {
            at_s: now_s,
            date_s: date_s(),
            event: event.to_owned(),
            what,
            offsets: input.seen.as_ref().map_or_else(|_| Vec::new(), |seen| seen.offsets.clone()),
        };
        self.journal_fails |= self.store.event(&event).is_err();
    }

    fn send(&mut self, input: &CycleInput, output: &CycleOutput, now_s: f64) {
        if input.seen.is_err() || self.dry {
            return;
        }
        let mut offsets = output.order.write.clone();
        let keeps = offsets.is_some() && !self.control.is_volatile();
        if keeps && self.store.own(&self.correction.owned()).is_err() {
            // Not kept, so not written: the governor reads what stands there and takes it.
            self.journal_fails = true;
            let reason = "the journal took no entry".to_owned();
            self.write_fault = Some(LinkFault::Down { reason });
            offsets = None;
        }
        self.beat = self.beat.wrapping_add(1);
        let writes = offsets.is_some();
        let sent = Sent { offsets, beat: self.beat, ask_hold: output.order.ask_hold };
        self.counts.writes += u64::from(writes);
        if let Err(fault) = self.control.write(&sent, now_s) {
            self.counts.failed += 1;
            if writes {
                self.write_fault = Some(fault);
            }
        }
    }

    /// Cycles until `wish` gives none, each at its time; a cycle that took too long is not made up for.
    pub fn go(
        &mut self,
        clock: &dyn Clock,
        period_s: f64,
        mut wish: impl FnMut(f64) -> Option<Wish>,
        mut after: impl FnMut(&mut Self, &Cycle),
    ) {
        let mut next_s = clock.now_s();
        while let Some(wish) = wish(clock.now_s()) {
            let cycle = self.cycle(clock, wish);
            after(self, &cycle);
            next_s += period_s;
            let now_s = clock.now_s();
            while next_s < now_s {
                next_s += period_s;
                self.counts.missed += 1;
            }
            clock.wait_until(next_s);
        }
    }
}

/// The event of a datum, and what was missing: µm of lengths.
fn shown_outcome(outcome: &DatumOutcome) -> (&'static str, String) {
    match outcome {
        Err(why) => (DATUM_REFUSED, why.clone()),
        Ok(None) => (DATUM_CLEARED, "nothing is subtracted".to_owned()),
        Ok(Some(datum)) => {
            let each = datum.missing.iter().map(|mm| format!("{:.1}", mm * 1e3));
            let all = each.collect::<Vec<_>>().join(", ");
            (DATUM_SET, format!("missing when the zero of the part was touched: {all} (um, mrad)"))
        }
    }
}

/// The zero of the part was touched.
pub const DATUM_SET: &str = "datum";
/// Nothing is subtracted any more.
pub const DATUM_CLEARED: &str = "datum-cleared";
/// It was not taken.
pub const DATUM_REFUSED: &str = "datum-refused";
