//! One cycle without its sockets: what was read goes in, what is to be written comes out. A record is a list of what went
//! in; replayed it gives the same orders, to the last bit.

use crate::control::{LinkFault, Seen};
use crate::file::Plan;
use crate::governor::{Governor, Inputs, Order, Owned, Reason};
use crate::model::{LiveAxis, Model, Target};
use crate::pose::Frame;
use crate::sensor::{Judged, Sample, Watch};
use serde::{Deserialize, Serialize};
use trueaxis::machine::axis::Command;

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
}

/// A position that is read is so many periods old when what follows from it acts: one until the next cycle, one under way.
pub const AGE_PERIODS: f64 = 2.0;

/// Sensors, model and governor of a run.
#[derive(Debug, Clone)]
pub struct Correction {
    watch: Watch,
    model: Model,
    governor: Governor,
    last_s: Option<f64>,
    constant: Option<Vec<f64>>,
    /// The target of the last cycle, in increments, and the frame that it is of.
    before: Option<(Frame, Vec<f64>)>,
    period_s: f64,
}

impl Correction {
    /// Of a plan, with what the journal knows.
    pub fn new(plan: &Plan, owned: Option<Owned>) -> Self {
        let live = |axis: &crate::file::AxisPlan| LiveAxis {
            axis: axis.axis,
            increment: axis.increment,
            sign: axis.sign,
        };
        let axes = plan.axes.iter().map(live).collect();
        let model = Model::new(plan.machine.clone(), plan.of, plan.part, axes);
        let model = match plan.control.takes_pose() {
            // A plan of a machine that has no such form is refused when it is read.
            true => model.clone().with_pose().unwrap_or(model),
            false => model,
        };
        Self {
            watch: Watch::new(plan.sensors.iter().map(|s| s.settings.clone()).collect()),
            model,
            governor: Governor::new(plan.settings.clone(), owned),
            last_s: None,
            constant: None,
            before: None,
            period_s: plan.period_s,
        }
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
        let target = match &self.constant {
            Some(offsets) => Ok(Target { offsets: offsets.clone(), is_clamped: false }),
            None => known.and_then(|()| self.target(&sensors, (frame, programmed.as_ref()))),
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
        let lag = self.lag(dt_s, (frame, target.as_ref().ok()));
        CycleOutput { order, sensors, target: target.ok(), programmed, lag }
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

    fn target(
        &mut self,
        sensors: &[Judged],
        (frame, programmed): (Frame, Option<&Command>),
    ) -> Result<Target, Reason> {
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
        self.model.set_readings(&readings)?;
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
