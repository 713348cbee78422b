//! Circles of the file as arcs of the control.

use crate::axes::Leg;
use crate::cut::Node;
use crate::path::{Stroke, Way};
use crate::write::Post;
use crate::{BlockPlace, Fault, FeedRule};
use trueaxis_geometry::{Vec3, angle};
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_nc::Control;
use trueaxis_nc::moves::{Axis, Coordinates, Feed, FeedMode};
use trueaxis_writer::{Block, CircularArc, TipWords};

/// Angles nearer than this are the same, rad.
const SAME: f64 = 1e-9;

/// A direction nearer to Z than this is Z, rad: rotary axes are rounded to the digits of the program.
pub(crate) const UPRIGHT_RAD: f64 = 1e-6;

/// Controls calculate with radii up to here, mm.
const LARGEST_RADIUS_MM: f64 = 10_000.0;

/// The travel of the axes is checked at so many places of an arc.
const CHECKS: u32 = 24;

impl Post<'_> {
    /// X, Y and Z of the program for a place of the tip, with the rotary axes as they are.
    pub(crate) fn words_at(&self, tip: Vec3, rotary: &Command) -> Option<Vec3> {
        if self.options.tip_words.is_some() {
            return Some(tip);
        }
        let mut command = *rotary;
        if !self.control.place(tip, &mut command) {
            return None;
        }
        let of = |axis: Axis| self.names.iter().position(|n| *n == axis).map(|i| command[i]);
        Some(Vec3::new(of(Axis::X)?, of(Axis::Y)?, of(Axis::Z)?))
    }

    /// Which way a direction points in the words of the program, where these turn and do not distort.
    pub(crate) fn direction_of(&self, tip: Vec3, along: Vec3, rotary: &Command) -> Option<Vec3> {
        Some(self.words_at(tip + along, rotary)? - self.words_at(tip, rotary)?)
    }

    /// Whether the rotary axes are the same at two places.
    pub(crate) fn stands(&self, a: &Command, b: &Command) -> bool {
        let axes = self.machine.axes().iter().enumerate();
        axes.into_iter()
            .all(|(i, axis)| axis.kind == AxisKind::Linear || (a[i] - b[i]).abs() < SAME)
    }

    /// Whether arcs mean to the control what they mean here.
    fn has_arcs(&self, leg: &Leg<'_>, at: &Command) -> bool {
        let options = self.options;
        let plain = self.coordinates == Coordinates::Program;
        !options.lines_only
            && options.feed != FeedRule::InverseTime
            && match (options.tip_words, options.control) {
                (Some(TipWords::Length), _) => true,
                (None, _) => plain,
                // FANUC, A-79348E: table axes must stand where they were when G43.4 began.
                (Some(TipWords::Angles), Control::Fanuc) => {
                    self.stands(at, &self.end_of(leg, leg.first).command)
                }
                (Some(TipWords::Angles), Control::Haas) => false,
                (Some(TipWords::Angles), _) => true,
                (Some(TipWords::Vectors), _) => false,
            }
    }

    /// Writes a stroke as an arc; `false` where it has to be lines.
    pub(crate) fn write_circle(
        &mut self,
        stroke: &Stroke,
        [from, to]: [&Node; 2],
        leg: &Leg<'_>,
        index: usize,
    ) -> Result<bool, Fault> {
        if stroke.way == Way::Line || stroke.rapid || !self.has_arcs(leg, &from.command) {
            return Ok(false);
        }
        let Some(arc) = self.circle(stroke, from, to) else { return Ok(false) };
        for k in 1..CHECKS {
            let mut command = from.command;
            let stand = stroke.at(&from.stand, f64::from(k) / f64::from(CHECKS));
            if !self.control.place(stand.tip, &mut command) {
                return Ok(false);
            }
            self.cutter.inside(&command, stroke.line)?;
        }
        self.cutter.inside(&to.command, stroke.line)?;
        let feed = Feed { mode: FeedMode::PerMinute, value: stroke.feed };
        if self.try_block(&Block::Arc(self.target(to), arc, feed)).is_err() {
            return Ok(false);
        }
        let (line, stroke) = (self.line, index as u32);
        self.places.push(&BlockPlace { line, stroke, from: Some(0.0), until: 1.0 });
        self.blocks += 1;
        self.arcs += 1;
        Ok(true)
    }

    /// The arc of a stroke about Z of the program.
    fn circle(&self, stroke: &Stroke, from: &Node, to: &Node) -> Option<CircularArc> {
        let Way::Arc { center, normal, angle_rad } = stroke.way else { return None };
        let rotary = &from.command;
        let same_axis = angle(&from.stand.axis, &to.stand.axis) < SAME;
        if !same_axis || !self.stands(rotary, &to.command) || self.is_too_fast(stroke.feed) {
            return None;
        }
        let up = self.direction_of(center, normal, rotary)?;
        if up.x.hypot(up.y) > UPRIGHT_RAD {
            return None;
        }
        let [a, b] = [self.words_at(from.stand.tip, rotary)?, self.words_at(to.stand.tip, rotary)?];
        let c = self.words_at(center, rotary)?;
        let flat = |v: Vec3| v.x.hypot(v.y);
        let (chord, radii) = (flat(b - a), [flat(a - c), flat(b - c)]);
        let increment = 10_f64.powi(-i32::from(self.options.decimals.linear));
        if radii[0] < 10.0 * increment || radii[0] > LARGEST_RADIUS_MM {
            return None;
        }
        // A file rounds its ends: the centre moves along the chord to where both radii are the same. An arc whose
        // ends become one place would be a whole circle.
        let whole = chord < 0.1 * increment && angle_rad > std::f64::consts::PI;
        // No block has more than one turn.
        if angle_rad > std::f64::consts::TAU && !whole || angle_rad > 1.5 * std::f64::consts::TAU {
            return None;
        }
        let shift = if whole { 0.0 } else { (radii[1].powi(2) - radii[0].powi(2)) / (2.0 * chord) };
        if !whole && (chord < 10.0 * increment || shift.abs() > 0.25 * self.options.tolerance_mm) {
            return None;
        }
        let along = if whole { Vec3::zeros() } else { (b - a) / chord };
        let center_mm = [c.x + shift * along.x, c.y + shift * along.y];
        Some(CircularArc { center_mm, ccw: up.z > 0.0 })
    }

    /// Whether the feed is more than an axis can, where the program has to keep to that.
    fn is_too_fast(&self, feed: f64) -> bool {
        let kept = self.options.feed == FeedRule::Tip && self.options.tip_words.is_some();
        let mut linear = self.machine.axes().iter().filter(|axis| axis.kind == AxisKind::Linear);
        !kept && linear.any(|axis| axis.limits.velocity.is_some_and(|v| v * 60.0 < feed))
    }
}
