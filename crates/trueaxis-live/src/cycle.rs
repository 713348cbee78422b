//! One cycle without its sockets: what was read goes in, what is to be written comes out. A record is a list of what went
//! in; replayed it gives the same orders, to the last bit.

use crate::control::{LinkFault, Seen};
use crate::datum::{Datum, DatumOrder, DatumOutcome, Touch, touched};
use crate::file::{Plan, PlannedDatum};
use crate::governor::{Earlier, Governor, Inputs, Order, Owned, Reason, State};
use crate::memory::HeatOfRun;
use crate::model::{LiveAxis, Model, Target};
use crate::pose::Frame;
use crate::sensor::{Judged, Sample, Watch};
use crate::setups::Setups;
use serde::{Deserialize, Serialize};
use trueaxis::machine::axis::Command;
use trueaxis::machine::heat::ThermalMemory;

/// What one cycle reads.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CycleInput {
    /// The clock of the run.
    pub now_s: f64,
    /// What sensors have sent since the last cycle.
    pub samples: Vec<Sample>,
    /// What the control reports.
    pub seen: Result<Seen, LinkFault>,
    /// How the write of the cycle before ended, if it failed.
    pub write_fault: Option<LinkFault>,
    /// Whether the correction is wanted.
    pub run: bool,
    /// A person has confirmed what was latched.
    pub confirmed: bool,
    /// The journal takes no entry.
    pub journal_fails: bool,
    /// What is asked of the zero of the part.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub datum: Option<DatumOrder>,
    /// The heat that an earlier run has left in the scales, on the clock of this one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub memory: Option<HeatOfRun>,
}

/// What one cycle comes to.
#[derive(Debug, Clone, PartialEq)]
pub struct CycleOutput {
    /// What is done.
    pub order: Order,
    /// The sensors.
    pub sensors: Vec<Judged>,
    /// Where the offsets shall go, if that is known.
    pub target: Option<Target>,
    /// The program's position, where there is a link. Unit: mm or rad.
    pub programmed: Option<Command>,
    /// How far each offset is late while the target moves: its rate × the age of the position, in increments; none without two
    /// targets. Unit: counts.
    pub lag: Option<Vec<f64>>,
    /// What has become of the zero of the part, where something was asked.
    pub datum: Option<DatumOutcome>,
}

/// A position that is read is so many periods old when what follows from it acts: one until the next cycle, one under way.
pub const AGE_PERIODS: f64 = 2.0;

/// An offset that has not changed for so long is not on its way, s.
const SETTLED_S: f64 = 0.5;

/// An axis that moves by less in one cycle stands. Unit: mm or rad.
pub(crate) const STANDS: f64 = 2e-3;

/// Sensors, model and governor of a run.
#[derive(Debug, Clone)]
pub struct Correction {
    watch: Watch,
    model: Model,
    governor: Governor,
    last_s: Option<f64>,
    constant: Option<Vec<f64>>,
    setups: Setups,
    /// Where the program stood in the last cycle.
    stood: Option<Command>,
    /// What acts, and since when, s.
    acts: Option<(Vec<i32>, f64)>,
    /// The target of the last cycle, in increments, and the frame that it is of.
    before: Option<(Frame, Vec<f64>)>,
    period_s: f64,
}

impl Correction {
    /// Of a plan, with what the journal knows.
    pub fn new(plan: &Plan, earlier: impl Into<Earlier>) -> Self {
        let axes = plan.axes.iter().map(LiveAxis::from).collect();
        let model = Model::new(plan.machine.clone(), plan.of, plan.part, axes);
        let model = match plan.control.takes_pose() {
            // A plan of a machine that has no such form is refused when it is read.
            true => model.clone().with_pose().unwrap_or(model),
            false => model,
        };
        let mut correction = Self {
            watch: Watch::new(plan.sensors.iter().map(|s| s.settings.clone()).collect()),
            model,
            governor: Governor::new(plan.settings.clone(), earlier),
            last_s: None,
            constant: None,
            setups: Setups::default(),
            stood: None,
            acts: None,
            before: None,
            period_s: plan.period_s,
        };
        // A session refuses a plan whose zero cannot be computed.
        let planned = plan.datum.as_ref().and_then(|p| correction.planned_datum(p).ok());
        correction.setups = Setups::new(planned, Vec::new());
        correction.count_from_zero();
        correction
    }

    /// The zero of the part that the plan knows of: what is missing there without any correction.
    ///
    /// # Errors
    /// [`Reason::Model`].
    pub fn planned_datum(&self, planned: &PlannedDatum) -> Result<Datum, Reason> {
        let mut model = self.model.clone();
        let readings: Vec<(&str, f64)> =
            planned.readings.iter().map(|(name, celsius)| (name.as_str(), *celsius)).collect();
        model.set_readings(&readings)?;
        let own = vec![0; model.axes().len()];
        let touch = Touch { frame: Frame::default(), at: &planned.at, own: &own };
        touched(&mut model, &touch)
    }

    /// The same with a constant in the place of the model's target, in increments.
    #[must_use]
    pub fn with_target(self, offsets: Vec<f64>) -> Self {
        Self { constant: Some(offsets), ..self }
    }

    /// What this program owns in the control, for the journal.
    pub fn owned(&self) -> Owned {
        self.governor.owned()
    }

    /// The governor.
    pub fn governor(&self) -> &Governor {
        &self.governor
    }

    /// The heat in the scales, for the next run; none of a machine without heated places.
    pub fn memory(&self) -> Option<&ThermalMemory> {
        self.model.memory()
    }

    /// What is subtracted from every target: it was missing when the zero of the part was touched.
    pub fn datum(&self) -> Option<&Datum> {
        self.model.datum()
    }

    /// The zeros of all setups.
    pub fn setups(&self) -> &Setups {
        &self.setups
    }

    /// The sensors.
    pub fn watch(&self) -> &Watch {
        &self.watch
    }

    /// One cycle.
    pub fn step(&mut self, input: &CycleInput) -> CycleOutput {
        let now_s = input.now_s;
        let dt_s = self.last_s.map_or(0.0, |last_s| now_s - last_s);
        self.last_s = Some(now_s);
        if let Some(fault) = &input.write_fault {
            self.governor.write_failed(matches!(fault, LinkFault::Refused { .. }));
        }
        input.samples.iter().for_each(|sample| self.watch.take(sample, now_s));
        let sensors = self.watch.judged(now_s);
        let seen = input.seen.as_ref().ok();
        let tool = seen.and_then(|seen| seen.tool_length_mm).map(|mm| self.model.set_tool(mm));
        let programmed = seen.map(|seen| self.programmed(seen));
        let known =
            tool.unwrap_or(Ok(())).and_then(|()| seen.map_or(Ok(()), |s| self.check_tip(s)));
        let frame = seen.map_or_else(Default::default, |seen| seen.frame);
        if let Some(memory) = &input.memory {
            self.model.remember(memory.clone().into());
        }
        let warm = known.and_then(|()| self.warm(now_s, &sensors));
        self.show_setup(seen.and_then(|seen| seen.setup));
        let asked = input.datum.as_ref();
        let datum = asked.map(|order| self.order_datum(order, &warm, (seen, programmed.as_ref())));
        let target = match &self.constant {
            Some(offsets) => Ok(self.model.constant(offsets, programmed.as_ref())),
            None => warm.and_then(|()| match self.setups.fault() {
                Some(reason) => Err(reason),
                None => self.target(frame, programmed.as_ref()),
            }),
        };
        let lost = |fault: &LinkFault| Reason::LinkLost { what: fault.to_string() };
        let order = self.governor.step(
            dt_s,
            &Inputs {
                seen: input.seen.as_ref().map_err(lost),
                target: target.as_ref().map(|t| t.offsets.as_slice()).map_err(Clone::clone),
                run: input.run,
                confirmed: input.confirmed,
                journal_fails: input.journal_fails,
            },
        );
        self.stood = programmed;
        let acts = seen.map(|seen| self.acting(seen));
        if acts.as_ref() != self.acts.as_ref().map(|(acts, _)| acts) {
            self.acts = acts.map(|acts| (acts, now_s));
        }
        let lag = self.lag(dt_s, (frame, target.as_ref().ok()));
        CycleOutput { order, sensors, target: target.ok(), programmed, lag, datum }
    }

    /// Sets, takes or clears the zero of the part; one that is refused leaves it as it was.
    fn order_datum(
        &mut self,
        order: &DatumOrder,
        warm: &Result<(), Reason>,
        (seen, programmed): (Option<&Seen>, Option<&Command>),
    ) -> DatumOutcome {
        let axes = self.model.axes().len();
        let fits = |datum: &Datum| datum.missing.len() == axes;
        let other = || -> DatumOutcome { Err("it is of other axes".to_owned()) };
        match order {
            DatumOrder::Clear => self.setups.clear(),
            DatumOrder::Set(datum) if !fits(datum) => return other(),
            DatumOrder::Set(datum) => self.setups.take(Some(datum.clone())),
            DatumOrder::Kept(all) if !all.iter().flat_map(|s| &s.datum).all(fits) => {
                return other();
            }
            DatumOrder::Kept(all) => {
                self.setups.keep(all.clone());
                self.show_setup(seen.and_then(|seen| seen.setup));
            }
            DatumOrder::Take => {
                let taken = self.take_datum(warm, (seen, programmed))?;
                self.setups.take(Some(taken));
            }
        }
        self.count_from_zero();
        Ok(self.model.datum().cloned())
    }

    /// Another setup in the machine has another zero.
    fn show_setup(&mut self, number: Option<i32>) {
        if self.setups.show(number) {
            self.count_from_zero();
        }
    }

    /// Another zero is no jump of the machine, and no speed of the target: the offsets go there by their slew.
    fn count_from_zero(&mut self) {
        self.model.set_datum(self.setups.datum().cloned());
        self.governor.forget_target();
        self.before = None;
    }

    fn take_datum(
        &mut self,
        warm: &Result<(), Reason>,
        (seen, programmed): (Option<&Seen>, Option<&Command>),
    ) -> Result<Datum, String> {
        warm.as_ref().map_err(ToString::to_string)?;
        let (Some(seen), Some(at)) = (seen, programmed) else {
            return Err("no connection to the control".to_owned());
        };
        let still = |(a, b): (&f64, &f64)| (a - b).abs() < STANDS;
        let stands = self.stood.as_ref().is_some_and(|before| at.iter().zip(before).all(still));
        if !stands {
            return Err("the axes move".to_owned());
        }
        if !matches!(self.governor.state(), State::Run | State::Hold) {
            return Err("the run neither follows nor holds".to_owned());
        }
        let own = self.acting(seen);
        let since_s = self.acts.as_ref().filter(|(acts, _)| *acts == own).map(|(_, since)| *since);
        let now_s = self.last_s.unwrap_or(0.0);
        if since_s.is_none_or(|since_s| now_s - since_s < SETTLED_S) {
            return Err("an offset is still on its way to its target".to_owned());
        }
        let before = self.model.datum().cloned();
        let touch = Touch { frame: seen.frame, at, own: &own };
        let taken = touched(&mut self.model, &touch);
        self.model.set_datum(before);
        taken.map_err(|reason| reason.to_string())
    }

    /// What acts of this program's offsets, as the control says: nothing in a dry run, whatever was ordered.
    pub fn acting(&self, seen: &Seen) -> Vec<i32> {
        let acting = seen.acting.as_ref().unwrap_or(&seen.offsets);
        let base = self.governor.owned().base;
        acting.iter().zip(base).map(|(acts, base)| acts.saturating_sub(base)).collect()
    }

    /// The same of each live axis at a position. Unit: counts.
    pub fn acting_at(&self, seen: &Seen, at: &Command) -> Vec<f64> {
        self.model.at_position(self.acting(seen).into_iter().map(f64::from), at).collect()
    }

    fn lag(&mut self, dt_s: f64, (frame, target): (Frame, Option<&Target>)) -> Option<Vec<f64>> {
        let now = target.map(|target| (frame, target.offsets.clone()));
        let before = std::mem::replace(&mut self.before, now);
        let (then, now) = (before?, self.before.as_ref()?);
        let age_s = AGE_PERIODS * self.period_s;
        let late = |(a, b): (&f64, &f64)| (b - a).abs() / dt_s * age_s;
        (then.0 == now.0 && dt_s > 0.0).then(|| then.1.iter().zip(&now.1).map(late).collect())
    }

    /// The position of the program: that of the machine without the offset that acts.
    fn programmed(&self, seen: &Seen) -> Command {
        let acting = seen.acting.as_ref().unwrap_or(&seen.offsets);
        self.model.programmed(seen.frame, &positions(seen), acting)
    }

    fn check_tip(&mut self, seen: &Seen) -> Result<(), Reason> {
        let Some(tip_mm) = seen.standing_tip_mm else { return Ok(()) };
        self.model.check_tip(tip_mm, &positions(seen))
    }

    /// Takes the readings of now.
    fn warm(&mut self, now_s: f64, sensors: &[Judged]) -> Result<(), Reason> {
        let settings = self.watch.settings();
        let mut readings = Vec::with_capacity(sensors.len());
        for (settings, judged) in settings.iter().zip(sensors) {
            match &judged.celsius {
                Ok(celsius) => readings.push((settings.input.as_str(), *celsius)),
                Err(fault) => {
                    let (sensor, what) = (settings.name.clone(), fault.to_string());
                    return Err(match settings.is_workpiece {
                        true => Reason::Workpiece { sensor, what },
                        false => Reason::Sensor { sensor, what },
                    });
                }
            }
        }
        self.model.follow(now_s, &readings)
    }

    fn target(&mut self, frame: Frame, programmed: Option<&Command>) -> Result<Target, Reason> {
        let programmed =
            programmed.ok_or_else(|| Reason::Model { what: "no position".to_owned() })?;
        self.model.target(frame, programmed)
    }
}

fn positions(seen: &Seen) -> Command {
    let mut command = Command::default();
    command.iter_mut().zip(&seen.positions).for_each(|(to, from)| *to = *from);
    command
}
