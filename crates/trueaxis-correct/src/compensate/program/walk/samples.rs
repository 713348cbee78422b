//! Places of a move: those that the program passes, and those where an axis reverses.

use super::super::correct::{Corrected, Place, reached};
use super::super::refuse::refusal;
use super::super::stand::{Sample, Stand};
use super::super::turns::{At, Stop, stops};
use super::{Held, Lead, Walk, Way};
use trueaxis_machine::axis::{Approach, Command};
use trueaxis_motion::axis_path::Fault;
use trueaxis_nc::moves::{Axis, AxisSet, Move};

/// A reversal error that is left counts from here on, mm.
const LEFT_MM: f64 = 1e-6;

/// Words nearer than this are the same, mm, deg or parts of a direction.
const SAME_WORD: f64 = 1e-9;

impl Walk<'_> {
    /// What the program says along the move, and what has to be commanded for it.
    pub(super) fn samples(
        &mut self,
        m: &Move,
        way: &Way<'_>,
        whole: bool,
    ) -> Result<Vec<Sample>, Fault> {
        if self.written.control().is_none() {
            let message = "the machine has fewer than three linear axes".to_owned();
            let hint = "the tip cannot be corrected; describe another machine";
            return Err(refusal(m.origin, "not-correctable", message, hint));
        }
        let begins = self.begins(m, way.begin);
        let mut samples = std::mem::take(&mut self.samples);
        samples.clear();
        samples.push(self.first(way.begin, begins));
        let (mut last, mut side) = (*self.written.command(), *self.corrector.approach());
        let mut stops = std::mem::take(&mut self.stops);
        self.find_stops(way, whole, &mut stops);
        for stop in &stops {
            let done = self.correct(m, way, stop, (&last, &side))?;
            let nowhere = stop.turns && done.command == last;
            side = self.corrector.side_behind(&side, &last, &done.command);
            last = done.command;
            self.found.correct((&stop.nominal, m.origin.line), &done);
            if !nowhere {
                let sample = self.sample(stop.u, (&stop.nominal, stop.prepared), done.command);
                samples.push(Sample { turns: stop.turns, side, ..sample });
            }
        }
        self.stops = stops;
        self.before = samples.last().zip(way.nodes.last()).map(|(s, node)| (node.command, *s));
        Ok(samples)
    }

    /// Where the move begins: mostly where the one before it ended.
    fn first(&self, nominal: &Command, command: Command) -> Sample {
        match &self.before {
            Some((at, last)) if at == nominal && last.command == command => {
                let side = *self.corrector.approach();
                Sample { u: 0.0, side, turns: false, ..*last }
            }
            _ => self.sample(0.0, (nominal, None), command),
        }
    }

    /// Where the axes would stand at the beginning: cuts are made as if the way began where it should.
    fn begins(&self, m: &Move, begin: &Command) -> Command {
        if !self.approaching {
            return self.exact;
        }
        let from = *self.written.command();
        let place = Place {
            nominal: begin,
            side: reached(self.corrector.approach(), &from, begin),
            from: &from,
            approach: self.corrector.approach(),
            only_position: self.written.is_only_tilted(),
            origin: m.origin,
        };
        self.corrector.at(&place, None).map_or(from, |c| c.command)
    }

    /// Of a rapid after which others follow before the cut: what its words are to be where the cut begins, since they hold there
    /// and the errors of the machine are others there.
    pub(super) fn held(&self, m: &Move, way: &Way<'_>, lead: &Lead) -> Result<Option<Held>, Fault> {
        let end = way.nodes.last().map_or(way.begin, |node| &node.command);
        if *end == lead.begin {
            return Ok(None);
        }
        let path = &self.written;
        let [here, there] = [end, &lead.begin].map(|q| path.words_of(q, m.coordinates));
        let holds = |axis: &Axis| (here[*axis] - there[*axis]).abs() < SAME_WORD;
        let axes = Axis::ALL.iter().filter(|axis| holds(axis));
        let axes = axes.fold(AxisSet::default(), |set, axis| set.with(*axis));
        let directions = path.direction_of(end).zip(path.direction_of(&lead.begin));
        let turns = directions.is_some_and(|(here, there)| {
            here.iter().zip(there).all(|(here, there)| (here - there).abs() < SAME_WORD)
        });
        let (from, approach) = (path.command(), self.corrector.approach());
        let place = Place {
            nominal: &lead.begin,
            side: reached(&reached(approach, way.begin, end), end, &lead.begin),
            from,
            approach,
            only_position: path.is_only_tilted(),
            origin: m.origin,
        };
        let command = self.corrector.at(&place, None)?.command;
        let tip = path.control().map(|control| Stand::of(control, &command).tip);
        Ok(tip.map(|tip| Held { command, tip, axes, turns }))
    }

    /// The places of a move, and those where an axis reverses.
    fn find_stops(&self, way: &Way<'_>, whole: bool, found: &mut Vec<Stop>) {
        found.clear();
        let total: f64 = way.nodes.iter().map(|n| n.length).sum();
        let (mut length, count) = (0.0, way.nodes.len());
        let places = way.nodes.iter().enumerate().filter_map(|(k, node)| {
            length += node.length;
            let is_last = k + 1 == count;
            let u = if is_last || total <= 0.0 { 1.0 } else { length / total };
            (is_last || !whole).then_some((u, &node.command, Some(way.first + k)))
        });
        let approach = self.corrector.approach();
        if self.corrector.reverses() && !whole {
            let only_position = self.written.is_only_tilted();
            let mean = |nominal: &Command| self.corrector.mean(nominal, only_position);
            let at = |(u, nominal, prepared): (f64, &Command, Option<usize>)| {
                let ahead = prepared.and_then(|k| self.ready.mean_at(k));
                let mean = ahead.unwrap_or_else(|| mean(nominal));
                At { u, nominal: *nominal, mean, prepared }
            };
            let begin = at((0.0, way.begin, None));
            let places: Vec<At> = places.map(at).collect();
            *found = stops(&begin, approach, &places, (self.corrector.least(), &mean));
            return;
        }
        let (mut side, mut last) = (*approach, *way.begin);
        found.extend(places.map(|(u, nominal, prepared)| {
            side = reached(&side, &last, nominal);
            last = *nominal;
            Stop { u, nominal: *nominal, side, prepared, turns: false }
        }));
    }

    /// The written numbers lead an axis to its place from another side than it was corrected for:
    /// rounding turns an axis round that hardly moves, and its reversal error is left.
    pub(super) fn comes_otherwise(&self, end: &Sample) -> bool {
        let (side, command) = (self.corrector.approach(), self.written.command());
        if !self.corrector.reverses() || *side == end.side {
            return false;
        }
        let machine = self.corrector.machine();
        let tip = |side: &Approach| {
            let errors = machine.errors_at(command, side).ok()?;
            Some(machine.deviation(command, &errors).tip_mm)
        };
        let by = tip(side).zip(tip(&end.side)).map_or(0.0, |(is, meant)| (is - meant).norm());
        by > LEFT_MM
    }

    fn correct(
        &self,
        m: &Move,
        way: &Way<'_>,
        stop: &Stop,
        (from, approach): (&Command, &Approach),
    ) -> Result<Corrected, Fault> {
        let place = Place {
            nominal: &stop.nominal,
            side: stop.side,
            from,
            approach,
            only_position: self.written.is_only_tilted(),
            origin: way.nodes.first().map_or(m.origin, |node| node.origin),
        };
        let prepared = stop.prepared.and_then(|k| self.ready.at(k));
        self.corrector.at(&place, prepared)
    }

    /// A place, with its number in the stretch if it has one, and what is commanded for it.
    fn sample(
        &self,
        u: f64,
        (nominal, prepared): (&Command, Option<usize>),
        command: Command,
    ) -> Sample {
        let stand = |c: &Command| match self.written.control() {
            Some(control) => Stand::of(control, c),
            None => Stand::default(),
        };
        let wanted = prepared.and_then(|k| self.ready.wanted_at(k));
        let believed = prepared.and_then(|k| self.ready.believed_at(k, &command));
        let side = *self.corrector.approach();
        let wanted = wanted.unwrap_or_else(|| stand(nominal));
        let believed = believed.unwrap_or_else(|| stand(&command));
        Sample { u, wanted, command, believed, side, turns: false }
    }
}
