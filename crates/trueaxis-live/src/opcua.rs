//! A control with an OPC UA server, such as SINUMERIK: every value is a node that the plan names.
//!
//! ```text
//!     positions, state ──nodes──> [`OpcUa`] ──offset of each axis (mm, deg), heartbeat──> nodes ──PLC or NC──> axes
//! ```
//!
//! On SINUMERIK the offset is SD43900 `$SA_TEMP_COMP_ABS_VALUE`, the position-independent part of its temperature compensation,
//! which the NC moves to within MD32760 (Siemens 6FC5397, K3). With MD32750 bit 1 it adds SD43910 · (x − SD43920): then slope and
//! offset are written, and the NC follows the position by itself ([`crate::line`]). Which node is what, is a matter of the machine
//! and the version of its server: nothing is assumed. The connection needs the feature `opcua`; everything else is tested without it.

#[cfg(feature = "opcua")]
mod client;

#[cfg(feature = "opcua")]
pub use client::Client;

use crate::control::{Control, Identity, LinkFault, Mode, Seen, Sent};
use crate::governor::increments_of;
use crate::line::Line;
use crate::pose::Frame;

/// What a node holds.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A number of any type.
    Number(f64),
    /// A bit.
    Flag(bool),
}

impl Value {
    fn number(&self) -> f64 {
        match self {
            Self::Number(number) => *number,
            Self::Flag(flag) => f64::from(u8::from(*flag)),
        }
    }

    fn flag(&self) -> bool {
        self.number() != 0.0
    }
}

/// What a server says of one node: its value, or its status.
pub type Said<T> = Result<T, String>;

/// The nodes of a server.
pub trait Nodes {
    /// Values of nodes, in their order.
    ///
    /// # Errors
    /// [`LinkFault`] where the server was not reached; a node that it refuses has its own status.
    fn read(&mut self, nodes: &[&str], now_s: f64) -> Result<Vec<Said<Value>>, LinkFault>;

    /// Writes nodes, in their order, each in the type that it has.
    ///
    /// # Errors
    /// [`LinkFault`], as above.
    fn write(&mut self, nodes: &[(&str, Value)], now_s: f64) -> Result<Vec<Said<()>>, LinkFault>;

    /// Manufacturer, product and software version of the server.
    ///
    /// # Errors
    /// [`LinkFault`].
    fn server(&mut self, now_s: f64) -> Result<[String; 3], LinkFault>;
}

/// The nodes of a line: the control adds slope · (position − reference) to the offset of an axis.
#[derive(Debug, Clone, PartialEq)]
pub struct LineNodes {
    /// The slope, mm for each mm; written.
    pub slope: String,
    /// Where the line has the value of the offset, mm; read, never written.
    pub reference: String,
    /// The ends of the travel of the axis. Unit: mm.
    pub ends: [f64; 2],
}

/// Which node is what.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct NodeNames {
    /// The position of each axis of the machine file, mm or deg.
    pub positions: Vec<String>,
    /// The offset of each live axis, mm or deg.
    pub offsets: Vec<String>,
    /// What makes a line of it, for each live axis.
    pub lines: Vec<Option<LineNodes>>,
    /// What acts of it, where the control says so.
    pub acting: Option<Vec<String>>,
    /// True while all live axes have their reference points.
    pub referenced: String,
    /// True while offsets must not change.
    pub inhibit: String,
    /// True while a program moves the axes.
    pub running: String,
    /// The mode: a number, of [`OpcUaSettings::modes`].
    pub mode: String,
    /// True in emergency stop.
    pub emergency: String,
    /// True while an alarm is shown.
    pub alarm: Option<String>,
    /// The feed along the path, mm/min.
    pub feed: Option<String>,
    /// A number that changes with every cycle.
    pub heartbeat: Option<String>,
    /// Feed hold is asked for.
    pub ask_hold: Option<String>,
    /// True once the PLC has let the offsets go.
    pub tripped: Option<String>,
    /// The number of the setup: of a pallet, a work offset, a clamping.
    pub setup: Option<String>,
}

/// One control.
#[derive(Debug, Clone, PartialEq)]
pub struct OpcUaSettings {
    /// Its nodes.
    pub nodes: NodeNames,
    /// The axes of the machine file.
    pub axes: Vec<String>,
    /// Which of them are rotary: their numbers are degrees.
    pub rotary: Vec<bool>,
    /// The live axes, by their places.
    pub live: Vec<usize>,
    /// The least increment of each of their offsets. Unit: mm or deg.
    pub increments: Vec<f64>,
    /// Positions have the offset in them.
    pub positions_have_offset: bool,
    /// What the numbers of the mode mean; any other is [`Mode::Other`].
    pub modes: Vec<(i32, Mode)>,
}

/// A control as a [`Control`].
#[derive(Debug)]
pub struct OpcUa<N> {
    nodes: N,
    settings: OpcUaSettings,
    /// Where each line has the value of its offset, as it was read last. Unit: mm.
    references: Vec<f64>,
}

impl<N: Nodes> OpcUa<N> {
    /// Over the nodes of a server.
    pub fn new(nodes: N, settings: OpcUaSettings) -> Self {
        Self { nodes, settings, references: Vec::new() }
    }

    /// The nodes.
    pub fn nodes(&mut self) -> &mut N {
        &mut self.nodes
    }

    /// The line of each live axis that has one, by its values at the ends.
    fn lines(
        &mut self,
        taken: &mut Taken,
        offsets: &[f64],
    ) -> Result<Vec<Option<Line>>, LinkFault> {
        self.references.clear();
        let mut found = Vec::with_capacity(offsets.len());
        for (offset, nodes) in offsets.iter().zip(&self.settings.nodes.lines) {
            let Some(nodes) = nodes else {
                found.push(None);
                continue;
            };
            let [slope, reference] = [taken.next()?.number(), taken.next()?.number()];
            self.references.push(reference);
            let values = nodes.ends.map(|end| offset + slope * (end - reference));
            found.push(Some(Line { ends: nodes.ends, values }));
        }
        Ok(found)
    }

    fn counted(&self, live: usize, value: f64) -> Result<i32, LinkFault> {
        increments_of(value / self.settings.increments[live]).ok_or_else(|| LinkFault::Garbage {
            reason: format!("{} is no offset: {value}", self.settings.nodes.offsets[live]),
        })
    }
}

/// Values of one reading, taken in the order in which they were asked.
struct Taken {
    left: std::vec::IntoIter<(String, Said<Value>)>,
}

impl Taken {
    fn next(&mut self) -> Result<Value, LinkFault> {
        let Some((node, said)) = self.left.next() else {
            return Err(LinkFault::Garbage { reason: "too few values came".to_owned() });
        };
        let value = said.map_err(|reason| LinkFault::Refused { call: node.clone(), reason })?;
        if value.number().is_finite() {
            return Ok(value);
        }
        Err(LinkFault::Garbage { reason: format!("{node} is no number") })
    }

    fn numbers(&mut self, count: usize) -> Result<Vec<f64>, LinkFault> {
        (0..count).map(|_| self.next().map(|value| value.number())).collect()
    }

    #[expect(clippy::cast_possible_truncation, reason = "checked: whole, and of 32 bits")]
    fn whole(&mut self) -> Result<i32, LinkFault> {
        let (node, number) =
            (self.left.as_slice().first().map(|n| n.0.clone()), self.next()?.number());
        if number.fract() == 0.0 && number.abs() <= f64::from(i32::MAX) {
            return Ok(number as i32);
        }
        let node = node.unwrap_or_default();
        Err(LinkFault::Garbage { reason: format!("{node} is no whole number: {number}") })
    }

    fn flag_if(&mut self, asked: bool) -> Result<bool, LinkFault> {
        if asked { self.next().map(|value| value.flag()) } else { Ok(false) }
    }
}

impl NodeNames {
    /// All that are read, in the order in which [`Taken`] takes them.
    fn read(&self) -> Vec<&str> {
        let several = self.positions.iter().chain(&self.offsets);
        let lines = self.lines.iter().flatten().flat_map(|line| [&line.slope, &line.reference]);
        let several = several.chain(lines).chain(self.acting.iter().flatten());
        let always = [&self.referenced, &self.inhibit, &self.running, &self.mode, &self.emergency];
        let maybe = [&self.alarm, &self.tripped, &self.setup, &self.feed].into_iter().flatten();
        several.chain(always).chain(maybe).map(String::as_str).collect()
    }
}

impl<N: Nodes> Control for OpcUa<N> {
    fn identity(&mut self, now_s: f64) -> Result<Identity, LinkFault> {
        let [kind, series, version] = self.nodes.server(now_s)?;
        let axes = self.settings.axes.clone();
        // Offsets are numbers in mm and deg, not counts.
        let decimals = vec![0; axes.len()];
        Ok(Identity { kind, series, version, axes, decimals })
    }

    fn read(&mut self, now_s: f64) -> Result<Seen, LinkFault> {
        let settings = self.settings.clone();
        let (nodes, live) = (&settings.nodes, settings.live.len());
        let asked = nodes.read();
        let said = self.nodes.read(&asked, now_s)?;
        let named: Vec<_> = asked.iter().map(|node| (*node).to_owned()).zip(said).collect();
        let mut taken = Taken { left: named.into_iter() };
        let mut raw = taken.numbers(settings.axes.len())?;
        let offsets_raw = taken.numbers(live)?;
        let lines = self.lines(&mut taken, &offsets_raw)?;
        let acting_raw = nodes.acting.as_ref().map(|_| taken.numbers(live)).transpose()?;
        let [homed, inhibited, cutting] =
            [taken.next()?.flag(), taken.next()?.flag(), taken.next()?.flag()];
        let number = taken.next()?.number();
        let emergency = taken.next()?.flag();
        let alarm = taken.flag_if(nodes.alarm.is_some())?;
        let tripped = taken.flag_if(nodes.tripped.is_some())?;
        let setup = if nodes.setup.is_some() { Some(taken.whole()?) } else { None };
        let feed = if nodes.feed.is_some() { taken.next()?.number() } else { 0.0 };
        if !settings.positions_have_offset {
            let acts = acting_raw.as_ref().unwrap_or(&offsets_raw);
            for ((axis, acts), line) in settings.live.iter().zip(acts).zip(&lines) {
                raw[*axis] += line.map_or(*acts, |line| line.at(raw[*axis]));
            }
        }
        let counts = |values: &[f64]| -> Result<Vec<i32>, LinkFault> {
            values.iter().enumerate().map(|(i, value)| self.counted(i, *value)).collect()
        };
        let mut offsets = Vec::with_capacity(2 * live);
        for (i, (value, line)) in offsets_raw.iter().zip(&lines).enumerate() {
            let values = line.map_or(vec![*value], |line| line.values.to_vec());
            for value in values {
                offsets.push(self.counted(i, value)?);
            }
        }
        let mode = settings.modes.iter().find(|(known, _)| f64::from(*known) == number);
        let turned = raw.iter().zip(&settings.rotary);
        Ok(Seen {
            positions: turned
                .map(|(q, rotary)| if *rotary { q.to_radians() } else { *q })
                .collect(),
            offsets,
            acting: acting_raw.as_deref().map(counts).transpose()?,
            homed,
            emergency,
            alarm,
            mode: mode.map_or(Mode::Other, |(_, mode)| *mode),
            cutting,
            inhibited,
            tripped,
            released: false,
            feed_mm_per_min: feed,
            frame: Frame::Machine,
            tool_length_mm: None,
            standing_tip_mm: None,
            block: None,
            setup,
        })
    }

    fn write(&mut self, sent: &Sent, now_s: f64) -> Result<(), LinkFault> {
        let settings = self.settings.clone();
        let nodes = &settings.nodes;
        let mut all: Vec<(&str, Value)> = Vec::new();
        if let Some(node) = &nodes.heartbeat {
            // Within 7 bits: a signed byte takes it, too.
            all.push((node, Value::Number(f64::from(sent.beat & 0x7f))));
        }
        if let Some(node) = &nodes.ask_hold {
            all.push((node, Value::Flag(sent.ask_hold)));
        }
        let mut counts = sent.offsets.iter().flatten();
        let mut references = self.references.iter();
        for (i, increment) in settings.increments.iter().enumerate() {
            let Some(first) = counts.next() else { break };
            let first = f64::from(*first) * increment;
            let value = match &nodes.lines[i] {
                None => first,
                Some(LineNodes { slope, ends, .. }) => {
                    let (Some(second), Some(reference)) = (counts.next(), references.next()) else {
                        let reason = "a line is written before it was read".to_owned();
                        return Err(LinkFault::Garbage { reason });
                    };
                    let line =
                        Line { ends: *ends, values: [first, f64::from(*second) * increment] };
                    all.push((slope, Value::Number(line.slope())));
                    line.at(*reference)
                }
            };
            all.push((&nodes.offsets[i], Value::Number(value)));
        }
        if all.is_empty() {
            return Ok(());
        }
        let said = self.nodes.write(&all, now_s)?;
        if said.len() != all.len() {
            return Err(LinkFault::Garbage { reason: "too few results came".to_owned() });
        }
        // Which of them were taken is read back.
        let refused = all.iter().zip(said).find_map(|((node, _), said)| Some((*node, said.err()?)));
        refused.map_or(Ok(()), |(node, reason)| {
            Err(LinkFault::Refused { call: node.to_owned(), reason })
        })
    }
}
