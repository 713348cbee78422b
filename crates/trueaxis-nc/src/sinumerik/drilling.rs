//! Drilling cycles along the axis that stands on the plane.

use super::swivel::Parameters;
use super::values::Value;
use super::words::Words;
use super::{Run, fault};
use crate::execution::mistakes;
use crate::moves::{Axis, Event, MoveKind};
use crate::text::program::Fault;

/// Pecks of one hole: more than any program means.
const MOST_PECKS: f64 = 1e5;

/// The heights of a hole.
struct Hole {
    axis: Axis,
    /// RTP.
    retract: f64,
    /// RFP and SDIS.
    safe: f64,
    /// RFP.
    surface: f64,
    bottom: f64,
}

impl Run<'_> {
    /// A cycle of the control; `false` if it is not executed here.
    pub(super) fn cycle(
        &mut self,
        name: &str,
        values: &[Option<Value>],
        at: usize,
    ) -> Result<bool, Fault> {
        let parameters = Parameters { values, at };
        match name.to_ascii_uppercase().as_str() {
            "WORKPIECE" => self.core.emit(Event::Note("WORKPIECE blank of the simulation")),
            "CYCLE800" => self.cycle_800(&parameters)?,
            "CYCLE832" => self.cycle_832(&parameters)?,
            "CYCLE81" => self.drill(&parameters, None)?,
            "CYCLE82" => self.drill(&parameters, Some(5))?,
            "CYCLE83" => self.drill_deep(&parameters)?,
            "CYCLE84" => return self.tap(&parameters),
            "CYCLE85" => self.bore(&parameters)?,
            "CYCLE86" => self.bore_oriented(&parameters)?,
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// RTP, RFP, SDIS, DP, DPR and, as the last, _AMODE.
    ///
    /// # Source
    /// Programming Manual "Cycles", CYCLE81 to CYCLE89: DP is absolute, DPR counts from RFP without
    /// a sign. With units of _AMODE at 1, DP counts from RFP as well.
    fn hole(&self, parameters: &Parameters<'_>, mode: usize) -> Result<Hole, Fault> {
        let at = parameters.at;
        let unit = self.core.modes.unit_mm();
        let axis = self.core.modes.plane.axes()[2];
        let surface = parameters.or_zero(1)? * unit;
        let retract = parameters.number(0)?.map_or(self.chain.position[axis], |r| r * unit);
        let relative = parameters.or_zero(mode)?.abs() as u64 % 10 == 1;
        let deep = parameters.number(4)?.filter(|d| *d != 0.0);
        let bottom = match (parameters.number(3)?, deep) {
            (_, Some(deep)) => surface - deep.abs() * unit,
            (Some(depth), None) if relative => surface - depth.abs() * unit,
            (Some(depth), None) => depth * unit,
            (None, None) => {
                return Err(mistakes::missing_depth(at));
            }
        };
        let safe = surface + parameters.or_zero(2)?.abs() * unit;
        if bottom > safe || retract < surface {
            let message = "the bottom lies above the surface, or the retraction below it";
            return Err(fault("cycle-heights", at, message, "check RTP, RFP, DP and DPR"));
        }
        self.core.modes.check_feed(at)?;
        Ok(Hole { axis, retract, safe, surface, bottom })
    }

    fn along(&mut self, kind: MoveKind, axis: Axis, depth: f64) {
        let mut target = self.chain.position;
        if target[axis] == depth {
            return;
        }
        target[axis] = depth;
        let mut words = Words::default();
        words.axes = words.axes.with(axis);
        self.step(kind, target, &words);
    }

    /// A dwell of a cycle: seconds, or turns of the spindle where it is negative.
    fn wait(&mut self, time: f64) {
        let seconds = match time {
            t if t < 0.0 && self.core.modes.speed > 0.0 => -t * 60.0 / self.core.modes.speed,
            t => t.max(0.0),
        }
        .min(1e9);
        if seconds > 0.0 {
            let place = self.chain.position;
            self.step(MoveKind::Dwell { seconds }, place, &Words::default());
        }
    }

    /// CYCLE81, and CYCLE82 with a dwell at the bottom.
    fn drill(&mut self, parameters: &Parameters<'_>, dwell: Option<usize>) -> Result<(), Fault> {
        let hole = self.hole(parameters, 8)?;
        let dwell = parameters.or_zero(dwell.unwrap_or(5))?;
        self.along(MoveKind::Rapid, hole.axis, hole.safe);
        self.along(MoveKind::Linear, hole.axis, hole.bottom);
        self.wait(dwell);
        self.along(MoveKind::Rapid, hole.axis, hole.retract);
        self.modes.tangent = None;
        Ok(())
    }

    /// CYCLE83: RTP, RFP, SDIS, DP, DPR, FDEP, FDPR, DAM, DTB, DTS, FRF, VARI.
    ///
    /// FRF slows the first peck. All pecks are as deep as the first: the degression DAM is left out,
    /// which the user is told.
    fn drill_deep(&mut self, parameters: &Parameters<'_>) -> Result<(), Fault> {
        let at = parameters.at;
        let hole = self.hole(parameters, 19)?;
        let unit = self.core.modes.unit_mm();
        let first = match (parameters.number(5)?, parameters.number(6)?.filter(|d| *d != 0.0)) {
            (_, Some(deep)) => deep.abs() * unit,
            (Some(depth), None) => hole.surface - depth * unit,
            (None, None) => hole.surface - hole.bottom,
        };
        if first <= 0.0 || (hole.surface - hole.bottom) / first > MOST_PECKS {
            let message = format!("{first} mm is not the depth of a peck");
            return Err(fault("cycle-without-depth", at, message, "check FDEP and FDPR"));
        }
        let degression = parameters.or_zero(7)?;
        let percent = parameters.number(19)?.is_some();
        if degression != 0.0 && !(percent && degression == 100.0) {
            self.core.not_applied(
                "the degression DAM of CYCLE83",
                at,
                "all pecks are as deep as the first",
            );
        }
        let (bottom_time, top_time) = (parameters.or_zero(8)?, parameters.or_zero(9)?);
        let out = parameters.or_zero(11)? != 0.0;
        // The control keeps 0.6 mm from the last depth for holes up to 30 mm, else a fiftieth.
        let deep = hole.surface - hole.bottom;
        let distance = if deep <= 30.0 { 0.6 } else { (deep / 50.0).min(7.0) };
        self.along(MoveKind::Rapid, hole.axis, hole.safe);
        let feed = self.core.modes.feed.value;
        self.core.modes.feed.value = feed * first_feed(parameters.number(10)?);
        let mut depth = hole.surface;
        while depth > hole.bottom {
            depth = (depth - first).max(hole.bottom);
            self.along(MoveKind::Linear, hole.axis, depth);
            self.core.modes.feed.value = feed;
            self.wait(bottom_time);
            if depth > hole.bottom && out {
                self.along(MoveKind::Rapid, hole.axis, hole.safe);
                self.wait(top_time);
                self.along(MoveKind::Rapid, hole.axis, depth + distance);
            } else if depth > hole.bottom {
                self.along(MoveKind::Linear, hole.axis, depth + 1.0);
            }
        }
        self.along(MoveKind::Rapid, hole.axis, hole.retract);
        self.modes.tangent = None;
        Ok(())
    }

    /// CYCLE85: RTP, RFP, SDIS, DP, DPR, DTB, FFR, RFF: in and out with feeds of its own.
    fn bore(&mut self, parameters: &Parameters<'_>) -> Result<(), Fault> {
        let modal = self.core.modes.feed.value;
        let own = |value: Option<f64>| value.filter(|f| *f > 0.0);
        let (inwards, outwards) = (own(parameters.number(6)?), own(parameters.number(7)?));
        self.core.modes.feed.value = inwards.unwrap_or(modal);
        let result = self.hole(parameters, 10);
        let hole = match result {
            Ok(hole) => hole,
            Err(fault) => {
                self.core.modes.feed.value = modal;
                return Err(fault);
            }
        };
        self.along(MoveKind::Rapid, hole.axis, hole.safe);
        self.along(MoveKind::Linear, hole.axis, hole.bottom);
        let dwell = parameters.or_zero(5);
        self.wait(dwell.unwrap_or(0.0));
        self.core.modes.feed.value = outwards.unwrap_or(self.core.modes.feed.value);
        self.along(MoveKind::Linear, hole.axis, hole.safe);
        self.core.modes.feed.value = modal;
        self.along(MoveKind::Rapid, hole.axis, hole.retract);
        self.modes.tangent = None;
        Ok(())
    }

    /// CYCLE84: RTP, RFP, SDIS, DP, DPR, DTB, SDAC, MPIT, PIT, POSS: tapping in step with the spindle.
    fn tap(&mut self, parameters: &Parameters<'_>) -> Result<bool, Fault> {
        let at = parameters.at;
        let size = parameters.or_zero(7)?.abs();
        let pitch = parameters.number(8)?.filter(|p| *p != 0.0);
        let pitch =
            pitch.map(|p| p.abs() * self.core.modes.unit_mm()).or_else(|| coarse_pitch(size));
        let Some(pitch_mm) = pitch else {
            let message = "the cycle has no pitch";
            return Err(fault("cycle-without-pitch", at, message, "write PIT or MPIT"));
        };
        let feed = std::mem::replace(&mut self.core.modes.feed.value, 1.0);
        let hole = self.hole(parameters, 15);
        self.core.modes.feed.value = feed;
        let hole = hole?;
        self.along(MoveKind::Rapid, hole.axis, hole.safe);
        self.core.emit(Event::SpindleOrient { angle_deg: parameters.or_zero(9)? });
        self.along(MoveKind::RigidTap { pitch_mm }, hole.axis, hole.bottom);
        // The tap is back where it began.
        self.chain.position[hole.axis] = hole.safe;
        self.along(MoveKind::Rapid, hole.axis, hole.retract);
        self.modes.tangent = None;
        Ok(true)
    }

    /// CYCLE86: RTP, RFP, SDIS, DP, DPR, DTB, SDIR, RPA, RPO, RPAP, POSS.
    fn bore_oriented(&mut self, parameters: &Parameters<'_>) -> Result<(), Fault> {
        let at = parameters.at;
        let hole = self.hole(parameters, 13)?;
        let dwell = parameters.or_zero(5)?;
        let angle_deg = parameters.or_zero(10)?;
        self.along(MoveKind::Rapid, hole.axis, hole.safe);
        self.along(MoveKind::Linear, hole.axis, hole.bottom);
        self.wait(dwell);
        self.core.emit(Event::SpindleOrient { angle_deg });
        for place in [7, 8, 9] {
            if parameters.or_zero(place)? != 0.0 {
                self.core.not_applied(
                    "the lift-off of CYCLE86",
                    at,
                    "the tool goes straight out here",
                );
            }
        }
        self.along(MoveKind::Rapid, hole.axis, hole.retract);
        self.modes.tangent = None;
        Ok(())
    }
}

/// The factor of the feed of the first peck: FRF, from 1.001 on in percent.
fn first_feed(factor: Option<f64>) -> f64 {
    match factor {
        Some(f) if f > 0.0 && f <= 1.0 => f,
        Some(f) if f > 1.0 && f <= 100.0 => f / 100.0,
        _ => 1.0,
    }
}

/// The coarse pitch of a metric thread by its size, mm.
///
/// # Source
/// ISO 261, coarse pitches.
fn coarse_pitch(size_mm: f64) -> Option<f64> {
    const PITCHES: [(f64, f64); 20] = [
        (2.0, 0.4),
        (2.5, 0.45),
        (3.0, 0.5),
        (4.0, 0.7),
        (5.0, 0.8),
        (6.0, 1.0),
        (8.0, 1.25),
        (10.0, 1.5),
        (12.0, 1.75),
        (14.0, 2.0),
        (16.0, 2.0),
        (18.0, 2.5),
        (20.0, 2.5),
        (22.0, 2.5),
        (24.0, 3.0),
        (27.0, 3.0),
        (30.0, 3.5),
        (36.0, 4.0),
        (42.0, 4.5),
        (48.0, 5.0),
    ];
    PITCHES.iter().find(|(size, _)| *size == size_mm).map(|(_, pitch)| *pitch)
}
