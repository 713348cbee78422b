//! Judges samples: which sensor can be used now, and why not.

use super::Sample;

/// A clock of a source may be ahead by so much, s.
const AHEAD_S: f64 = 1.0;
/// A step of one digit of a coarse reading is no rate, K.
pub(crate) const DIGIT_K: f64 = 0.1;
/// Another sensor must have moved by so much before one that does not move is stuck, K.
const MOVED_K: f64 = 0.5;

/// One sensor of the plan.
#[derive(Debug, Clone, PartialEq)]
pub struct SensorSettings {
    /// Its name.
    pub name: String,
    /// The sensor of the machine file that it is.
    pub input: String,
    /// The temperatures that it can have, °C. Unit: °C.
    pub range: [f64; 2],
    /// The fastest change that it can have. Unit: K.
    pub rate_k_per_s: f64,
    /// A sample older than this is not used.
    pub stale_s: f64,
    /// A value that stays the same to the last bit for so long while others move is stuck.
    pub stuck_s: f64,
    /// It is on the workpiece.
    pub is_workpiece: bool,
    /// The sensor that stands in for it, by its place in the plan.
    pub instead: Option<usize>,
}

/// Why a sensor cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SensorFault {
    /// Nothing has come.
    #[error("no sample yet")]
    NoSample,
    /// The last sample is too old.
    #[error("its last sample is older than {0} s")]
    Stale(f64),
    /// The last sample has no time.
    #[error("its last sample has no time of its own")]
    NoTime,
    /// The last sample is of a time that is not yet.
    #[error("its last sample is of a time that is not yet")]
    Ahead,
    /// The last sample is no number.
    #[error("its last sample is no number: `{0}`")]
    NoNumber(String),
    /// Out of range.
    #[error("{0} °C is outside its range")]
    OutOfRange(f64),
    /// Too fast.
    #[error("{from} to {to} °C is faster than its rate")]
    TooFast {
        /// The last value that was good, °C. Unit: °C.
        from: f64,
        /// The value that was sent, °C. Unit: °C.
        to: f64,
    },
    /// It does not move while others do.
    #[error("it stays at {0} °C while others move")]
    Stuck(f64),
}

/// What is known of one sensor.
#[derive(Debug, Clone, Default)]
struct Known {
    /// The last good value and its time.
    good: Option<(f64, f64)>,
    /// Why the last sample was not good.
    fault: Option<SensorFault>,
    /// Since when the value is the same, and what the others were then.
    same: Option<(f64, Vec<Option<f64>>)>,
}

/// One sensor as it stands now.
#[derive(Debug, Clone, PartialEq)]
pub struct Judged {
    /// Its temperature, °C, or why there is none.
    pub celsius: Result<f64, SensorFault>,
    /// The age of its last good sample, s.
    pub age_s: Option<f64>,
    /// The sensor that stands in for it, by its place.
    pub instead: Option<usize>,
}

/// All sensors of a run.
#[derive(Debug, Clone)]
pub struct Watch {
    settings: Vec<SensorSettings>,
    known: Vec<Known>,
}

impl Watch {
    /// Nothing is known yet.
    pub fn new(settings: Vec<SensorSettings>) -> Self {
        let known = settings.iter().map(|_| Known::default()).collect();
        Self { settings, known }
    }

    /// The sensors of the plan.
    pub fn settings(&self) -> &[SensorSettings] {
        &self.settings
    }

    /// Takes a sample.
    pub fn take(&mut self, sample: &Sample, now_s: f64) {
        let Some(settings) = self.settings.get(sample.sensor) else { return };
        let good = self.known[sample.sensor].good;
        // An older one that comes late changes nothing, whatever it says.
        if good.zip(sample.taken_s).is_some_and(|((_, last_s), taken_s)| taken_s < last_s) {
            return;
        }
        let judged = judge(settings, good, sample, now_s);
        let others: Vec<Option<f64>> = self.known.iter().map(|k| k.good.map(|g| g.0)).collect();
        let known = &mut self.known[sample.sensor];
        match judged {
            Ok((celsius, taken_s)) => {
                let same = known.good.is_some_and(|(last, _)| last == celsius);
                if !same || known.same.is_none() {
                    known.same = Some((taken_s, others));
                }
                (known.good, known.fault) = (Some((celsius, taken_s)), None);
                self.first_of(sample.sensor, celsius);
            }
            Err(fault) => known.fault = Some(fault),
        }
    }

    /// The first value of a sensor is that from which the others see it move.
    fn first_of(&mut self, sensor: usize, celsius: f64) {
        let same = self.known.iter_mut().filter_map(|known| known.same.as_mut());
        same.for_each(|(_, others)| {
            others[sensor].get_or_insert(celsius);
        });
    }

    /// How each sensor stands.
    pub fn judged(&self, now_s: f64) -> Vec<Judged> {
        let own: Vec<_> = (0..self.known.len()).map(|i| self.own(i, now_s)).collect();
        let with_instead = |(i, celsius): (usize, &Result<f64, SensorFault>)| {
            let instead =
                self.settings[i].instead.filter(|other| celsius.is_err() && own[*other].is_ok());
            let age_s = self.known[i].good.map(|(_, taken_s)| now_s - taken_s);
            let celsius = instead.map_or_else(|| celsius.clone(), |other| own[other].clone());
            Judged { celsius, age_s, instead }
        };
        own.iter().enumerate().map(with_instead).collect()
    }

    fn own(&self, i: usize, now_s: f64) -> Result<f64, SensorFault> {
        let (known, settings) = (&self.known[i], &self.settings[i]);
        if let Some(fault) = &known.fault {
            return Err(fault.clone());
        }
        let (celsius, taken_s) = known.good.ok_or(SensorFault::NoSample)?;
        let age_s = now_s - taken_s;
        if age_s.is_nan() || age_s > settings.stale_s {
            return Err(SensorFault::Stale(settings.stale_s));
        }
        if age_s < -AHEAD_S {
            return Err(SensorFault::Ahead);
        }
        let stuck = known.same.as_ref().is_some_and(|(since_s, others)| {
            let now = self.known.iter().map(|k| k.good.map(|g| g.0));
            let moved = |(then, now): (&Option<f64>, Option<f64>)| {
                then.zip(now).is_some_and(|(then, now)| (now - then).abs() >= MOVED_K)
            };
            taken_s - since_s > settings.stuck_s && others.iter().zip(now).any(moved)
        });
        if stuck { Err(SensorFault::Stuck(celsius)) } else { Ok(celsius) }
    }
}

/// A sample by itself, and against the last good one: °C and its time.
fn judge(
    settings: &SensorSettings,
    last: Option<(f64, f64)>,
    sample: &Sample,
    now_s: f64,
) -> Result<(f64, f64), SensorFault> {
    let number = sample.sent.celsius();
    let celsius = number.ok_or_else(|| SensorFault::NoNumber(sample.sent.shown()))?;
    let taken_s = sample.taken_s.filter(|t| t.is_finite()).ok_or(SensorFault::NoTime)?;
    if taken_s > now_s + AHEAD_S {
        return Err(SensorFault::Ahead);
    }
    let [low, high] = settings.range;
    if !(low..=high).contains(&celsius) {
        return Err(SensorFault::OutOfRange(celsius));
    }
    // A sensor that was silent for long may have gone anywhere within its range.
    let since = last.filter(|(_, last_s)| taken_s - last_s <= settings.stale_s);
    if let Some((from, last_s)) = since {
        let allowed = settings.rate_k_per_s * (taken_s - last_s).max(0.0) + DIGIT_K;
        if (celsius - from).abs() > allowed {
            return Err(SensorFault::TooFast { from, to: celsius });
        }
    }
    Ok((celsius, taken_s))
}
