//! CYCLE72: a contour that stands in a subprogram or between two labels, milled in layers.

use std::f64::consts::{FRAC_PI_2, PI};

use super::calls::Activation;
use super::flow::Direction;
use super::milling::{Cut, digit};
use super::swivel::Parameters;
use super::values::Value;
use super::{Language, Next, Run, fault};
use crate::execution::milling::Mill;
use crate::execution::mistakes;
use crate::moves::{CompensationSide, Event, Feed, Move, MoveKind, Step};
use crate::text::program::Fault;
use trueaxis_contour::Element;
use trueaxis_contour::lead::Lead;
use trueaxis_contour::plane::{length, minus};
use trueaxis_cycles::Point;
use trueaxis_cycles::contour::{CentrePath, centre_path, end_of, stroke};
use trueaxis_cycles::mill::{Heights, MOST_STROKES, Stroke};

/// Steps of one contour: more than any program means.
const MOST_STEPS: usize = 100_000;

/// Where a contour stands.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Contour {
    /// A subprogram; none: the running one.
    program: Option<String>,
    /// From a label to the block of another one; none: all of it.
    labels: Option<[String; 2]>,
}

/// The ways to the contour and away from it, and their feeds.
struct Ways {
    lead_in: Option<Lead>,
    lead_out: Option<Lead>,
    /// The way in goes down as well; the way out goes up.
    spatial: [bool; 2],
    /// Away from the contour and between the layers.
    feed: Feed,
}

fn bad_contour(message: impl Into<String>, at: usize) -> Fault {
    let hint = "write the contour as a start point, then lines and arcs of the plane (G1, G2, G3)";
    fault("bad-contour", at, message, hint)
}

fn text_of(parameters: &Parameters<'_>, index: usize) -> Option<String> {
    match parameters.values.get(index) {
        Some(Some(Value::Text(text))) => {
            let text: String = text.chars().filter(|c| !c.is_whitespace()).collect();
            (!text.is_empty()).then_some(text)
        }
        _ => None,
    }
}

impl Run<'_> {
    /// CYCLE62(KNAME, TYPE, LAB1, LAB2): TYPE 0 a subprogram, 1 a contour between the labels E_LAB_A_name and
    /// E_LAB_E_name, 2 two labels, 3 two labels of a subprogram.
    pub(super) fn name_contour(&mut self, parameters: &Parameters<'_>) -> Result<(), Fault> {
        let [name, first, last] = [0, 2, 3].map(|i| text_of(parameters, i));
        let labels = first.zip(last).map(|(a, b)| [a, b].map(|l| l.to_ascii_uppercase()));
        self.contour = match parameters.or_zero(1)? as i64 {
            0 => name.map(|name| Contour { program: Some(name), labels: None }),
            1 => name.map(|name| {
                let name = name.to_ascii_uppercase();
                let labels = Some([format!("E_LAB_A_{name}"), format!("E_LAB_E_{name}")]);
                Contour { program: None, labels }
            }),
            2 => labels.map(|labels| Contour { program: None, labels: Some(labels) }),
            _ => name
                .zip(labels)
                .map(|(name, labels)| Contour { program: Some(name), labels: Some(labels) }),
        };
        Ok(())
    }

    /// CYCLE72(KNAME, RTP, RFP, SDIS, DP, MID, FAL, FALD, FFP1, FFD, VARI, RL, AS1, LP1, FF3, AS2, LP2, UMODE, FS,
    /// ZFS, GMODE, DMODE, AMODE): KNAME is a subprogram or `BEGIN:END`, or empty after CYCLE62.
    ///
    /// Units of VARI: 1 roughing, 2 finishing; tens: between the layers 0 G0, 1 G1 with FF3; hundreds: up to 0
    /// RTP, 1 RFP + SDIS, 2 by SDIS, 3 not at all. RL: 40, 41, 42. Units of AS1 and AS2: 1 tangential line, 2 quarter
    /// circle, 3 half circle, 4 perpendicular line; tens: 1 in space. LP1 and LP2 are lengths, or radii of the path of
    /// the centre. What is not written for the way out is as for the way in.
    ///
    /// # Source
    /// See the table of sources in `docs/cycles.md`.
    pub(super) fn mill_contour(&mut self, parameters: &Parameters<'_>) -> Result<(), Fault> {
        let at = parameters.at;
        let kind = parameters.or_zero(10)?;
        let what = match (digit(kind, 0), digit(kind, 4)) {
            (1 | 2, 0) => None,
            (5, _) => Some("the chamfer of CYCLE72 (VARI)"),
            (1 | 2, _) => Some("CYCLE72 backwards along its contour (VARI)"),
            _ => Some("CYCLE72 with this VARI"),
        };
        if let Some(what) = what {
            self.missing(what, at);
            return Ok(());
        }
        if !self.in_plane("CYCLE72", parameters.or_zero(21)?, at) {
            return Ok(());
        }
        // Without the name the first parameters are those of all milling cycles.
        let others = Parameters { values: parameters.values.get(1..).unwrap_or_default(), at };
        let deep = parameters.number(4)?;
        let from_surface = digit(parameters.or_zero(22)?, 0) == 1;
        let depth = if from_surface { [deep, None] } else { [None, deep] };
        let layer = parameters.or_zero(5)?;
        let feeds = [Some(7), Some(8)];
        let Some(mut cut) = self.cut("CYCLE72", &others, depth, layer, feeds)? else {
            return Ok(());
        };
        let unit = self.core.modes.unit_mm();
        let mut distance = cut.tool_mm;
        if digit(kind, 0) == 1 {
            distance += parameters.or_zero(6)?.abs() * unit;
            let floor = parameters.or_zero(7)?.abs() * unit;
            cut.heights.bottom_mm = (cut.heights.bottom_mm + floor).min(cut.heights.top_mm);
        }
        let left_mm = match parameters.or_zero(11)? {
            41.0 => distance,
            42.0 => -distance,
            40.0 => 0.0,
            side => {
                let message = format!("expected 40, 41 or 42 for RL, found {side}");
                return Err(fault("missing-value", at, message, "write 41 for a tool to the left"));
            }
        };
        let ways = self.ways(parameters, cut.feeds[0])?;
        let elements = self.contour_of(text_of(parameters, 0), cut.feeds[0], at)?;
        let path = match centre_path(&elements, left_mm, self.modes.behaviour.rules) {
            Some(Ok(path)) => path,
            Some(Err(gouge)) => return Err(mistakes::gouge(gouge, left_mm.abs(), None, at)),
            None => return Err(bad_contour("the contour of CYCLE72 has no line and no arc", at)),
        };
        self.mill_along(&cut, &path, &ways, kind, at)
    }

    fn ways(&self, parameters: &Parameters<'_>, flat: Feed) -> Result<Ways, Fault> {
        let unit = self.core.modes.unit_mm();
        let or = |a: usize, b: usize| -> Result<f64, Fault> {
            Ok(parameters.number(a)?.filter(|v| *v != 0.0).map_or(parameters.or_zero(b)?, |v| v))
        };
        let lead = |kind: f64, size: f64| {
            let length_mm = size.abs() * unit;
            let lead = match digit(kind, 0) {
                1 => Lead::Tangent { length_mm },
                2 => Lead::Arc { radius_mm: length_mm, sweep_rad: FRAC_PI_2 },
                3 => Lead::Arc { radius_mm: length_mm, sweep_rad: PI },
                4 => Lead::Normal { length_mm },
                _ => return None,
            };
            (length_mm > 0.0).then_some(lead)
        };
        let [kind_in, size_in] = [parameters.or_zero(12)?, parameters.or_zero(13)?];
        let [kind_out, size_out] = [or(15, 12)?, or(16, 13)?];
        let feed_unit = if self.modes.feed_inches { 25.4 } else { 1.0 };
        let own = parameters.number(14)?.filter(|f| *f > 0.0).map(|f| f * feed_unit);
        // On the contour itself (RL 40) only straight ways are possible.
        let straight = |lead: Option<Lead>| {
            let on_contour = parameters.or_zero(11).is_ok_and(|rl| rl == 40.0);
            lead.filter(|l| !on_contour || matches!(l, Lead::Tangent { .. }))
        };
        Ok(Ways {
            lead_in: straight(lead(kind_in, size_in)),
            lead_out: straight(lead(kind_out, size_out)),
            spatial: [kind_in, kind_out].map(|kind| digit(kind, 1) == 1),
            feed: Feed { value: own.unwrap_or(flat.value), ..flat },
        })
    }

    /// All layers: to the begin of the way in, down, along the contour, away and up.
    fn mill_along(
        &mut self,
        cut: &Cut,
        path: &CentrePath,
        ways: &Ways,
        kind: f64,
        at: usize,
    ) -> Result<(), Fault> {
        let way_in = ways.lead_in.and_then(|lead| path.way_in(lead)).unwrap_or_default();
        let way_out = ways.lead_out.and_then(|lead| path.way_out(lead)).unwrap_or_default();
        let start = way_in.first().map_or(path.begin, end_of);
        let Heights { safe_mm, top_mm, .. } = cut.heights;
        let few = |layers: &Vec<f64>| layers.len() * path.links.len() <= MOST_STROKES;
        let Some(layers) = cut.heights.layers().filter(few) else {
            return self.carry_out(cut, start, None, at);
        };
        self.go_over(cut, start);
        let [flat, deep] = cut.feeds;
        let up = |height: f64| match digit(kind, 2) {
            0 => cut.retract,
            1 => safe_mm,
            2 => height + (safe_mm - top_mm),
            _ => height,
        };
        let at_start = |height| [start[0], start[1], height];
        let mut above = safe_mm;
        for height in layers {
            let mut strokes = vec![Stroke::Rapid(at_start(above.max(height)))];
            if !(ways.spatial[0] && way_in.len() > 1) {
                strokes.push(Stroke::Plunge(at_start(height)));
            }
            strokes.extend(way_in.iter().skip(1).map(|link| stroke(link, height)));
            strokes.extend(path.links.iter().map(|link| stroke(link, height)));
            self.mill(&strokes, [flat, deep], at)?;
            let high = up(height);
            let out = if ways.spatial[1] { high.min(safe_mm) } else { height };
            let away = way_out.last().map_or(path.end, end_of);
            let mut back: Vec<_> = way_out.iter().map(|link| stroke(link, out)).collect();
            back.push(Stroke::Rapid([away[0], away[1], high]));
            back.push(match digit(kind, 1) {
                0 if digit(kind, 2) != 3 => Stroke::Rapid(at_start(high)),
                _ => Stroke::Line(at_start(high)),
            });
            self.mill(&back, [ways.feed, deep], at)?;
            above = high.min(safe_mm);
        }
        let [_, _, third] = self.core.modes.plane.axes();
        self.rapid_to(|to| to[third] = cut.retract);
        self.modes.tangent = None;
        Ok(())
    }

    /// The lines and arcs of a contour.
    fn contour_of(
        &mut self,
        name: Option<String>,
        feed: Feed,
        at: usize,
    ) -> Result<Vec<Element>, Fault> {
        let contour = match name {
            Some(name) => match name.split_once(':') {
                Some((first, last)) => {
                    let labels = [first, last].map(str::to_ascii_uppercase);
                    Contour { program: None, labels: Some(labels) }
                }
                None => Contour { program: Some(name), labels: None },
            },
            None => self.contour.clone().ok_or_else(|| {
                bad_contour("CYCLE72 has no contour: neither a name nor CYCLE62", at)
            })?,
        };
        let steps = self.steps_of(&contour, feed, at)?;
        self.elements(&steps, at)
    }

    fn elements(&self, steps: &[Step], at: usize) -> Result<Vec<Element>, Fault> {
        let plane = self.core.modes.plane;
        let [a, b, _] = plane.axes();
        let mut place: Option<Point> = None;
        let mut elements = Vec::new();
        for step in steps {
            let m: &Move = match step {
                Step::Move(m) if !matches!(m.kind, MoveKind::Dwell { .. }) => m,
                Step::Event(
                    Event::Frame(_)
                    | Event::ToolChange(_)
                    | Event::ToolLength(_)
                    | Event::ToolCentre(_)
                    | Event::TiltedPlane(_)
                    | Event::Plane(_),
                    _,
                ) => {
                    let message = "the contour of CYCLE72 changes the frame, the plane or the tool";
                    return Err(bad_contour(message, at));
                }
                _ => continue,
            };
            let to = [m.target[a], m.target[b]];
            let straight = matches!(m.kind, MoveKind::Linear | MoveKind::Rapid);
            match (place, m.kind) {
                (None, _) if straight => {}
                (Some(from), _) if straight => {
                    if length(minus(to, from)) > 1e-9 {
                        elements.push(Element::line(from, to));
                    }
                }
                (Some(from), MoveKind::Arc(arc)) if arc.plane == plane => {
                    elements.push(Element::arc(from, to, arc.center_mm, arc.ccw, arc.turns));
                }
                _ => {
                    let message = format!(
                        "line {} of the contour is no line or arc of the plane, or an arc before the start point",
                        m.origin.line
                    );
                    return Err(bad_contour(message, at));
                }
            }
            place = Some(to);
        }
        Ok(elements)
    }

    /// Executes the blocks of a contour without moving; afterwards everything but variables is as before.
    fn steps_of(&mut self, contour: &Contour, feed: Feed, at: usize) -> Result<Vec<Step>, Fault> {
        self.settle();
        let activation = self.activation(contour, at)?;
        self.core.check_depth(self.stack.len(), at)?;
        self.core.count(at)?;
        let modes = (self.core.modes.clone(), self.modes.clone(), self.chain.clone());
        let (frame, modal) = (self.core.frame_now(), self.modal_call.take());
        let place = (self.core.origin, self.core.start, self.end);
        let depth = self.stack.len();
        let mut room = Vec::new();
        self.core.modes.feed = feed;
        self.core.collect();
        self.stack.push(activation);
        let mut failed = None;
        while self.stack.len() > depth && failed.is_none() {
            let next = self.advance(&mut room);
            let side = self.modes.side != CompensationSide::Off;
            failed = match next {
                Err(fault) => Some(fault),
                Ok(_) if side => Some(bad_contour(
                    "the contour of CYCLE72 has radius compensation of its own",
                    self.core.start,
                )),
                Ok(_) if self.core.collected() > MOST_STEPS => Some(bad_contour(
                    format!("the contour of CYCLE72 has more than {MOST_STEPS} steps"),
                    self.core.start,
                )),
                Ok(Next::Finished) => break,
                Ok(_) => None,
            };
        }
        let steps = self.core.collected_since(frame);
        if let Some(fault) = &failed {
            // It is reported where it is, then the cycle fails.
            self.core.report(fault.clone());
        }
        while self.stack.len() > depth {
            let Some(done) = self.stack.pop() else { break };
            self.forget(&done.variables);
        }
        (self.core.modes, self.modes, self.chain) = modes;
        self.modal_call = modal;
        (self.core.origin, self.core.start, self.end) = place;
        match failed {
            Some(_) => Err(bad_contour("the contour of CYCLE72 has a mistake", at)),
            None => Ok(steps),
        }
    }

    fn activation(&mut self, contour: &Contour, at: usize) -> Result<Activation, Fault> {
        let (number, span, line) = match &contour.program {
            Some(name) => self.find_program(name, at)?,
            None => {
                let top = self.stack.last().map(|t| (t.program, t.span.clone(), t.first_line));
                top.unwrap_or((0, 0..0, 1))
            }
        };
        let Some(labels) = &contour.labels else { return Ok(Activation::new(number, span, line)) };
        // Labels are found in the program that is running.
        let here = self.core.origin.program;
        self.core.origin.program = number as u32;
        let own = contour.program.is_some();
        if own {
            self.stack.push(Activation::new(number, span.clone(), line));
        }
        let found = [0, 1].map(|i| self.find(&labels[i], Direction::Both));
        let end = found[1].map(|(start, _)| self.block_end(start));
        if own {
            self.stack.pop();
        }
        self.core.origin.program = here;
        for (label, place) in labels.iter().zip(found) {
            if place.is_none() {
                return Err(mistakes::missing_label(label, at));
            }
        }
        let ((start, line), end) = found[0].zip(end).unwrap_or(((0, 1), 0));
        let mut activation = Activation::new(number, start..end.max(start), line);
        if !own && let Some(top) = self.stack.last() {
            // The blocks see the variables of the program they stand in.
            activation.variables = top.variables.clone();
        }
        Ok(activation)
    }
}
