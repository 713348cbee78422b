//! Drilling cycles along the axis that stands on the plane.

use super::swivel::Parameters;
use super::values::Value;
use super::{Run, fault};
use crate::execution::check_feed;
use crate::execution::drilling::{Drill, Stroke, dwell, pecks, stop_above};
use crate::execution::mistakes;
use crate::moves::{Axis, AxisSet, Event, Feed, FeedMode, MoveKind, Position};
use crate::text::program::Fault;
use trueaxis_cycles::pattern::{peck_depths, pecks_less_by};
use trueaxis_cycles::thread::coarse_pitch_mm;

/// Pecks of one hole: more than any program means.
const MOST_PECKS: f64 = 1e5;

/// The heights of a hole.
struct Hole {
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
            "CYCLE81" => self.plain_hole(&parameters)?,
            "CYCLE82" => self.plain_hole(&parameters)?,
            "CYCLE83" => self.drill_deep(&parameters)?,
            "CYCLE84" => self.tap(&parameters, [7, 8, 9, 23], parameters.number(10)?)?,
            "CYCLE840" => self.tap(&parameters, [9, 10, usize::MAX, 19], None)?,
            "GROUP_BEGIN" | "GROUP_END" | "GROUP_ADDEND" => {
                self.core.emit(Event::Note("group of blocks"));
            }
            "CYCLE85" => self.bore(&parameters)?,
            "CYCLE86" => self.bore_oriented(&parameters)?,
            "CYCLE61" => self.face(&parameters)?,
            "CYCLE71" => self.old_face(&parameters)?,
            "CYCLE76" => self.spigot("CYCLE76", &parameters)?,
            "CYCLE77" => self.spigot("CYCLE77", &parameters)?,
            "CYCLE62" => self.name_contour(&parameters)?,
            "CYCLE72" => self.mill_contour(&parameters)?,
            "POCKET3" => self.pocket("POCKET3", &parameters)?,
            "POCKET4" => self.pocket("POCKET4", &parameters)?,
            pattern @ ("HOLES1" | "HOLES2" | "CYCLE801") => {
                return self.pattern(pattern, &parameters);
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// RTP, RFP, SDIS, DP, DPR and, as the last, _AMODE.
    ///
    /// # Source
    /// Programming Manual "Cycles", CYCLE81 to CYCLE89: DP is absolute, DPR counts from RFP without
    /// a sign. With units of _AMODE at 1, DP counts from RFP as well.
    fn hole(&mut self, parameters: &Parameters<'_>, mode: usize) -> Result<Hole, Fault> {
        self.hole_with_feed(parameters, mode, self.core.modes.feed)
    }

    /// The same for a cycle with a feed of its own.
    fn hole_with_feed(
        &self,
        parameters: &Parameters<'_>,
        mode: usize,
        feed: Feed,
    ) -> Result<Hole, Fault> {
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
            let message = "the bottom is above the surface, or the retraction plane below it";
            return Err(fault("cycle-heights", at, message, "check RTP, RFP, DP and DPR"));
        }
        check_feed(&feed, at)?;
        Ok(Hole { retract, safe, surface, bottom })
    }

    /// A dwell of a cycle: seconds, or turns of the spindle where it is negative.
    fn wait(&self, time: f64) -> Option<Stroke> {
        let speed = self.core.modes.speed;
        let seconds = if time < 0.0 && speed > 0.0 { -time * 60.0 / speed } else { time };
        dwell(seconds.min(1e9))
    }

    /// The drill makes its strokes; then the path begins again.
    fn done(&mut self, strokes: Vec<Stroke>, at: usize) -> Result<(), Fault> {
        self.drill(strokes, at)?;
        self.modes.tangent = None;
        Ok(())
    }

    /// CYCLE81 and, with a dwell at the bottom, CYCLE82.
    fn plain_hole(&mut self, parameters: &Parameters<'_>) -> Result<(), Fault> {
        let hole = self.hole(parameters, 8)?;
        let mut strokes = hole.down();
        strokes.extend(self.wait(parameters.or_zero(5)?));
        strokes.push(Stroke::Rapid(hole.retract));
        self.done(strokes, parameters.at)
    }

    /// CYCLE83: RTP, RFP, SDIS, DP, DPR, FDEP, FDPR, DAM, DTB, DTS, FRF, VARI.
    ///
    /// FRF slows the first peck. The degression DAM makes each stroke shorter than the one before: an amount,
    /// or (negative, or in percent in the calls with _AMODE) a factor down to MDEP. VRT is the way back that
    /// breaks a chip (1 mm where it is 0), DIS1 the distance before the next stroke, DTD the wait at the bottom.
    ///
    /// # Source
    /// Programming Manual "Cycles", CYCLE83; parameters 12 to 19 are _AXN, _MDEP, _VRT, _DTD, _DIS1, _GMODE,
    /// _DMODE, _AMODE.
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
            let message = format!("{first} mm is not a possible depth of peck");
            return Err(fault("cycle-without-depth", at, message, "check FDEP and FDPR"));
        }
        let (bottom_time, top_time) = (parameters.or_zero(8)?, parameters.or_zero(9)?);
        let out = parameters.or_zero(11)? != 0.0;
        let depth = hole.surface - hole.bottom;
        let own = parameters.or_zero(16)? * unit;
        let distance = if own > 0.0 { own } else { stop_above(depth) };
        let chip = parameters.number(14)?.filter(|v| *v > 0.0).map_or(1.0, |v| v * unit);
        let feed = self.core.modes.feed;
        let slow = Feed { value: feed.value * first_feed(parameters.number(10)?), ..feed };
        let depths = self.peck_depths(parameters, depth, first)?;
        let depths = depths.into_iter().map(|d| hole.surface - d);
        let (bottom_wait, top_wait) = (self.wait(bottom_time), self.wait(top_time));
        let mut down = pecks(depths, |depth, strokes| {
            strokes.extend(bottom_wait.clone());
            if out {
                strokes.push(Stroke::Rapid(hole.safe));
                strokes.extend(top_wait.clone());
                strokes.push(Stroke::Rapid(depth + distance));
            } else {
                strokes.push(Stroke::Linear(depth + chip));
            }
        });
        down.insert(1, Stroke::Feed(feed));
        let mut strokes = vec![Stroke::Rapid(hole.safe), Stroke::Feed(slow)];
        strokes.extend(down);
        let last = parameters.number(15)?.filter(|t| *t != 0.0);
        strokes.extend(last.map_or(bottom_wait, |t| self.wait(t)));
        strokes.push(Stroke::Rapid(hole.retract));
        self.done(strokes, at)
    }

    /// The depths of the pecks below the surface by the degression DAM.
    fn peck_depths(
        &self,
        parameters: &Parameters<'_>,
        depth: f64,
        first: f64,
    ) -> Result<Vec<f64>, Fault> {
        let (unit, most) = (self.core.modes.unit_mm(), MOST_PECKS as usize);
        let (degression, least) = (parameters.or_zero(7)?, parameters.or_zero(13)? * unit);
        let percent = parameters.number(19)?.is_some();
        let factor = match degression {
            d if d < 0.0 => -d,
            d if percent && d > 0.0 => d / 100.0,
            d if d > 0.0 => {
                let found = pecks_less_by(depth, first, d * unit, most);
                return found.ok_or_else(|| mistakes::too_many_pecks(MOST_PECKS, parameters.at));
            }
            _ => 1.0,
        };
        let least = if factor < 1.0 && least <= 0.0 { first * 1e-2 } else { least };
        let next = |stroke: f64| (stroke * factor.min(1.0)).max(least.min(first));
        peck_depths(depth, first, most, next)
            .ok_or_else(|| mistakes::too_many_pecks(MOST_PECKS, parameters.at))
    }

    /// CYCLE85: RTP, RFP, SDIS, DP, DPR, DTB, FFR, RFF: in and out with feeds of its own.
    fn bore(&mut self, parameters: &Parameters<'_>) -> Result<(), Fault> {
        let modal = self.core.modes.feed;
        let own = |value: Option<f64>| value.filter(|f| *f > 0.0);
        let (inwards, outwards) = (own(parameters.number(6)?), own(parameters.number(7)?));
        let inwards = Feed { value: inwards.unwrap_or(modal.value), ..modal };
        let outwards = Feed { value: outwards.unwrap_or(inwards.value), ..modal };
        let hole = self.hole_with_feed(parameters, 10, inwards)?;
        let mut strokes = vec![Stroke::Feed(inwards)];
        strokes.extend(hole.down());
        strokes.extend(self.wait(parameters.or_zero(5).unwrap_or(0.0)));
        strokes.extend([Stroke::Feed(outwards), Stroke::Linear(hole.safe)]);
        strokes.extend([Stroke::Feed(modal), Stroke::Rapid(hole.retract)]);
        self.done(strokes, parameters.at)
    }

    /// CYCLE84: RTP, RFP, SDIS, DP, DPR, DTB, SDAC, MPIT, PIT, POSS, SST: tapping in step with the spindle, at its
    /// own speed SST. CYCLE840, with a compensating chuck: RTP, RFP, SDIS, DP, DPR, DTB, SDR, SDAC, ENC, MPIT, PIT;
    /// without a pitch it is F / S.
    fn tap(
        &mut self,
        parameters: &Parameters<'_>,
        [size, pitch, angle, mode]: [usize; 4],
        speed: Option<f64>,
    ) -> Result<(), Fault> {
        let at = parameters.at;
        let size = parameters.or_zero(size)?;
        let pitch = parameters.number(pitch)?.filter(|p| *p != 0.0);
        // Below zero it is a left-hand thread.
        let coarse = || coarse_pitch_mm(size.abs()).map(|p| p.copysign(size));
        let pitch = pitch.map(|p| p * self.core.modes.unit_mm()).or_else(coarse);
        let modes = &self.core.modes;
        let by_feed = match modes.feed.mode {
            _ if angle != usize::MAX => None,
            FeedMode::PerMinute => Some(modes.feed.value / modes.speed),
            FeedMode::PerRevolution => Some(modes.feed.value),
            FeedMode::InverseTime => None,
        };
        let pitch = pitch.or(by_feed.filter(|p| p.is_finite() && *p > 0.0));
        let Some(pitch_mm) = pitch else {
            let message = "the cycle has no pitch";
            return Err(fault("cycle-without-pitch", at, message, "write PIT or MPIT"));
        };
        // No F is needed: the spindle sets the feed.
        let any = Feed { value: 1.0, ..self.core.modes.feed };
        let hole = self.hole_with_feed(parameters, mode, any)?;
        if angle != usize::MAX && parameters.or_zero(15)? != 0.0 {
            self.core.not_applied("_VARI of CYCLE84", at, "the thread is cut in one stroke");
        }
        let mut strokes = vec![Stroke::Rapid(hole.safe)];
        if angle != usize::MAX {
            let orient = Event::SpindleOrient { angle_deg: parameters.or_zero(angle)? };
            strokes.push(Stroke::Event(orient));
        }
        let before = self.core.modes.speed;
        let speed = speed.filter(|s| *s > 0.0);
        strokes.extend(speed.map(|speed| Stroke::Event(Event::SpindleSpeed(speed))));
        strokes.push(Stroke::Tap { pitch_mm, bottom: hole.bottom });
        strokes.extend(speed.map(|_| Stroke::Event(Event::SpindleSpeed(before))));
        strokes.push(Stroke::Rapid(hole.retract));
        self.done(strokes, at)
    }

    /// CYCLE86: RTP, RFP, SDIS, DP, DPR, DTB, SDIR, RPA, RPO, RPAP, POSS.
    fn bore_oriented(&mut self, parameters: &Parameters<'_>) -> Result<(), Fault> {
        let at = parameters.at;
        let hole = self.hole(parameters, 13)?;
        let mut strokes = hole.down();
        strokes.extend(self.wait(parameters.or_zero(5)?));
        let angle_deg = parameters.or_zero(10)?;
        strokes.push(Stroke::Event(Event::SpindleOrient { angle_deg }));
        strokes.push(Stroke::Rapid(hole.retract));
        for place in [7, 8, 9] {
            if parameters.or_zero(place)? != 0.0 {
                self.core.not_applied(
                    "the lift-off of CYCLE86",
                    at,
                    "the tool retracts along its axis",
                );
            }
        }
        self.done(strokes, at)
    }
}

impl Hole {
    /// To the safety distance, then to the bottom with feed.
    fn down(&self) -> Vec<Stroke> {
        vec![Stroke::Rapid(self.safe), Stroke::Linear(self.bottom)]
    }
}

impl<'r> Drill<'r> for Run<'r> {
    fn place(&mut self) -> &mut Position {
        &mut self.chain.position
    }

    fn move_drill(&mut self, kind: MoveKind, to: Position, _at: usize) -> Result<(), Fault> {
        let waits = matches!(kind, MoveKind::Dwell { .. } | MoveKind::Arc(_));
        let mut named = AxisSet::default();
        for axis in Axis::ALL.into_iter().filter(|a| to[*a] != self.chain.position[*a]) {
            named = named.with(axis);
        }
        if waits || named != AxisSet::default() {
            let step = self.core.plain_move(kind, to, named);
            self.core.emit_move(step);
            self.chain.position = to;
        }
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
