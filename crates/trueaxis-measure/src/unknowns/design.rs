//! The design of a measurement: how every reading follows every unknown, before anything is read.
//!
//! ```text
//!     J = ∂reading/∂unknown at the nominal machine;   row = (f·v + m·ω) φ      docs/model.md eq. 107
//! ```

use super::known::Known;
use super::term::{Basis, Term};
use crate::instruments::instrument::{SetupUnknown, Sight, View};
use crate::instruments::{Instrument, Moment, Readings};
use nalgebra::DMatrix;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, Command};
use trueaxis_machine::chain::CommandFault;
use trueaxis_machine::errors::{ErrorIndex, ErrorValues};

/// The unknowns, the instruments and the machine.
///
/// The unknowns are numbered: first the terms of the machine, then the unknowns of each set-up.
#[derive(Debug, Clone)]
pub struct Design {
    /// The machine; the unknown errors are zero in it.
    pub machine: Machine,
    /// The unknown errors.
    pub terms: Vec<Term>,
    /// The instruments as they are set up.
    pub instruments: Vec<Instrument>,
    /// Where the unknowns of each instrument begin.
    offsets: Vec<usize>,
    /// Terms of one error stand together: the error, and its terms.
    runs: Vec<(ErrorIndex, std::ops::Range<usize>)>,
    /// The functions that the terms share, each once.
    functions: Vec<(Option<usize>, Basis)>,
    /// Which of them each term is.
    function_of: Vec<usize>,
    /// What was known of several unknowns together.
    known: Option<Known>,
}

/// An unknown by its place in the list.
#[derive(Debug, Clone, Copy)]
pub enum Unknown<'a> {
    /// A factor of the machine.
    Term(&'a Term),
    /// Something of a set-up.
    Setup(&'a Instrument, &'a SetupUnknown),
}

impl Unknown<'_> {
    /// Its name: `EC0Y`, `probe.ball_x`.
    pub fn name(&self) -> String {
        match self {
            Self::Term(term) => term.name(),
            Self::Setup(instrument, unknown) => format!("{}.{}", instrument.name, unknown.name),
        }
    }

    /// What was known of it before: value and standard uncertainty.
    pub fn prior(&self) -> Option<(f64, f64)> {
        match self {
            Self::Term(term) => term.prior,
            Self::Setup(_, unknown) => unknown.prior_u.map(|u| (0.0, u)),
        }
    }

    /// Whether it is a time (s): the delay of an axis.
    pub fn is_time(&self) -> bool {
        matches!(self, Self::Term(term) if term.basis.is_lag())
    }

    /// Whether it is a share of a length, a plain number.
    pub fn is_share(&self) -> bool {
        matches!(self, Self::Setup(_, unknown) if unknown.error.is_share())
    }

    /// Whether it is a rate by the hour: the drift of a set-up.
    pub fn is_rate(&self) -> bool {
        matches!(self, Self::Setup(_, unknown) if unknown.error.is_rate())
    }

    /// Whether it is an angle (rad); the others are lengths (mm), times (s) or plain numbers.
    pub fn is_angle(&self) -> bool {
        use crate::instruments::instrument::SetupError;
        match self {
            Self::Term(term) if term.basis.is_lag() => false,
            Self::Term(term) => term.error.component.is_rotation(),
            Self::Setup(instrument, unknown) => match unknown.error {
                SetupError::ReferenceTurn(_) | SetupError::Tilt(_) => true,
                SetupError::Zero(_) | SetupError::Drift(_) => instrument.sight.is_angle(),
                _ => false,
            },
        }
    }

    /// The unit in which it is shown, and the factor to it from mm, rad, s or 1, rates by the hour.
    pub fn shown_unit(&self) -> (&'static str, f64) {
        match (self.is_rate(), self.is_angle()) {
            _ if self.is_time() => ("ms", 1e3),
            _ if self.is_share() => ("µm/m", 1e6),
            (true, true) => ("µrad/h", 1e6),
            (true, false) => ("µm/h", 1e3),
            (false, true) => ("µrad", 1e6),
            (false, false) => ("µm", 1e3),
        }
    }
}

impl Design {
    /// A design; what the machine states of the unknown errors is not used.
    pub fn new(machine: &Machine, terms: Vec<Term>, instruments: Vec<Instrument>) -> Self {
        let mut machine = machine.clone();
        // A lag is unknown in addition to what the machine file states, not in its place.
        for term in terms.iter().filter(|t| !t.basis.is_servo()) {
            machine = machine.with_error(term.index, None);
        }
        Self::in_addition(machine, terms, instruments)
    }

    /// A design whose unknowns come in addition to all that the machine states.
    fn in_addition(machine: Machine, terms: Vec<Term>, instruments: Vec<Instrument>) -> Self {
        let mut runs: Vec<(ErrorIndex, std::ops::Range<usize>)> = Vec::new();
        for (k, term) in terms.iter().enumerate() {
            match runs.last_mut().filter(|(index, _)| *index == term.index) {
                Some((_, range)) => range.end = k + 1,
                None => runs.push((term.index, k..k + 1)),
            }
        }
        let mut functions: Vec<(Option<usize>, Basis)> = Vec::new();
        let mut function_of = Vec::new();
        for term in &terms {
            let function = (term.axis, term.basis);
            let known = functions.iter().position(|f| *f == function);
            function_of.push(known.unwrap_or(functions.len()));
            if known.is_none() {
                functions.push(function);
            }
        }
        let mut next = terms.len();
        let mut offsets = Vec::new();
        for instrument in &instruments {
            offsets.push(next);
            next += instrument.unknowns.len();
        }
        offsets.push(next);
        Self { machine, terms, instruments, offsets, runs, functions, function_of, known: None }
    }

    /// The same with further terms after its own, in addition to what the machine states.
    pub fn with_more(&self, further: &[Term]) -> Self {
        let terms = [&self.terms, further].concat();
        let more = Self::in_addition(self.machine.clone(), terms, self.instruments.clone());
        more.with_known(self.known())
    }

    /// The same with drifts that count from the first reading of each instrument.
    pub fn from_first_readings(mut self, readings: &Readings) -> Self {
        for (of, instrument) in self.instruments.iter_mut().enumerate() {
            instrument.drift.from_s = readings.first_s(of).unwrap_or(instrument.drift.from_s);
        }
        self
    }

    /// The same with what was known before of several unknowns together; of other unknowns it says nothing.
    pub fn with_known(mut self, known: Option<&Known>) -> Self {
        self.known = known.map(|known| known.on(&self.names()));
        self
    }

    /// What was known before of several unknowns together.
    pub fn known(&self) -> Option<&Known> {
        self.known.as_ref()
    }

    /// All that was known before: of each unknown and of several together.
    pub fn prior(&self) -> Known {
        let names = self.names();
        let mut prior = self.known.clone().unwrap_or_else(|| Known::nothing(names));
        for k in 0..self.unknowns() {
            if let Some((value, u)) = self.unknown(k).and_then(|u| u.prior()) {
                prior.add_value(k, value, u);
            }
        }
        prior
    }

    /// How many unknowns.
    pub fn unknowns(&self) -> usize {
        self.offsets.last().copied().unwrap_or(0)
    }

    /// The unit in which an unknown is shown, and the factor to it.
    pub fn shown_unit(&self, k: usize) -> (&'static str, f64) {
        self.unknown(k).map_or(("µm", 1e3), |unknown| unknown.shown_unit())
    }

    /// One unknown.
    pub fn unknown(&self, k: usize) -> Option<Unknown<'_>> {
        if let Some(term) = self.terms.get(k) {
            return Some(Unknown::Term(term));
        }
        let of = self.offsets.windows(2).position(|w| (w[0]..w[1]).contains(&k))?;
        let instrument = self.instruments.get(of)?;
        Some(Unknown::Setup(instrument, instrument.unknowns.get(k - self.offsets[of])?))
    }

    /// The names of all unknowns.
    pub fn names(&self) -> Vec<String> {
        (0..self.unknowns()).filter_map(|k| self.unknown(k)).map(|u| u.name()).collect()
    }

    /// The unknowns of one set-up among these values.
    pub fn setup<'v>(&self, instrument: usize, values: &'v [f64]) -> &'v [f64] {
        &values[self.offsets[instrument]..self.offsets[instrument + 1]]
    }

    /// The errors of the machine at a command with these values of the unknowns.
    ///
    /// # Errors
    /// A command outside an error table of the machine file.
    pub fn errors_at(
        &self,
        command: &Command,
        approach: &Approach,
        values: &[f64],
    ) -> Result<ErrorValues, CommandFault> {
        let moment = Moment { approach: *approach, ..Moment::default() };
        self.errors_in(command, &moment, values)
    }

    /// The same while the axes move, at a time.
    fn errors_in(
        &self,
        command: &Command,
        moment: &Moment,
        values: &[f64],
    ) -> Result<ErrorValues, CommandFault> {
        let mut errors = self.machine.errors_at(command, &moment.approach)?;
        let phi = self.functions_at(command, moment);
        for ((term, f), c) in self.terms.iter().zip(&self.function_of).zip(values) {
            errors.add(term.index, c * phi[*f]);
        }
        Ok(errors)
    }

    /// φ of every function at a command.
    fn functions_at(&self, command: &Command, moment: &Moment) -> Vec<f64> {
        self.functions.iter().map(|(axis, basis)| basis.at(command, *axis, moment)).collect()
    }

    /// What the instrument of a row would read with these values of the unknowns, mm or rad.
    ///
    /// # Errors
    /// A command outside an error table of the machine file.
    pub fn read(
        &self,
        readings: &Readings,
        i: usize,
        values: &[f64],
    ) -> Result<[f64; 3], CommandFault> {
        self.read_with(readings, i, values, |_| {})
    }

    /// The same with errors that are changed before they are read.
    pub(super) fn read_with(
        &self,
        readings: &Readings,
        i: usize,
        values: &[f64],
        change: impl Fn(&mut ErrorValues),
    ) -> Result<[f64; 3], CommandFault> {
        let of = readings.instruments[i] as usize;
        let instrument = &self.instruments[of];
        let command = &readings.commands[i];
        let mut errors = self.errors_in(command, &readings.moment(i), values)?;
        change(&mut errors);
        let actual = instrument.tool_seen(&self.machine, command, &errors);
        let nominal = match instrument.sight {
            Sight::Along if instrument.material.is_none() => actual, // it does not ask for it
            Sight::Along | Sight::Turn => {
                instrument.tool_seen(&self.machine, command, &ErrorValues::default())
            }
            _ => actual, // no other reading asks for it
        };
        let drifted = instrument.drifted(&self.machine, command, readings.times_s[i]);
        let view = View { nominal, actual, direction: readings.directions[i], drifted };
        Ok(instrument.read(&view, self.setup(of, values)))
    }

    /// Writes how each channel of a reading follows every unknown: one channel after the other,
    /// each as long as there are unknowns. Returns how many channels there are.
    pub fn slopes(&self, readings: &Readings, i: usize, out: &mut [f64]) -> usize {
        let n = self.unknowns();
        let of = readings.instruments[i] as usize;
        let instrument = &self.instruments[of];
        let command = &readings.commands[i];
        let frames = self.machine.error_frames(command, instrument.reference);
        let nominal = *frames.reference_from_tool();
        let drifted = instrument.drifted(&self.machine, command, readings.times_s[i]);
        let view = View { nominal, actual: nominal, direction: readings.directions[i], drifted };
        let wrenches = instrument.wrenches(&view);
        let channels = instrument.sight.channels();
        out[..channels * n].fill(0.0);
        let phi = self.functions_at(command, &readings.moment(i));
        for (index, run) in &self.runs {
            let twist = frames.twist(*index);
            for (c, wrench) in wrenches.iter().take(channels).enumerate() {
                let on = wrench.on(&twist);
                for k in run.clone() {
                    out[c * n + k] = on * phi[self.function_of[k]];
                }
            }
        }
        for (j, unknown) in instrument.unknowns.iter().enumerate() {
            for (c, wrench) in wrenches.iter().take(channels).enumerate() {
                out[c * n + self.offsets[of] + j] =
                    instrument.setup_slope(unknown.error, c, wrench, &view);
            }
        }
        channels
    }

    /// The rows of these readings in units of their noise, one *column* each: Jᵀ/u.
    ///
    /// Row by row: a plan chooses between poses of equal worth by the last digits of these numbers.
    pub fn columns(&self, readings: &Readings, range: std::ops::Range<usize>) -> DMatrix<f64> {
        let n = self.unknowns();
        let channels =
            |i: usize| self.instruments[readings.instruments[i] as usize].sight.channels();
        let mut values = vec![0.0; n * range.clone().map(channels).sum::<usize>()];
        let mut next = 0;
        for i in range {
            let noise = self.instruments[readings.instruments[i] as usize].noise;
            let end = next + n * channels(i);
            self.slopes(readings, i, &mut values[next..end]);
            for (row, u) in values[next..end].chunks_exact_mut(n.max(1)).zip(noise) {
                row.iter_mut().for_each(|v| *v /= u);
            }
            next = end;
        }
        let m = values.len() / n.max(1);
        DMatrix::from_vec(n, m, values)
    }

    /// The errors of which terms are unknown, each with its terms.
    pub(super) fn runs(&self) -> &[(ErrorIndex, std::ops::Range<usize>)] {
        &self.runs
    }

    /// The functions that the terms share, each with the axis whose position counts.
    pub(super) fn functions(&self) -> &[(Option<usize>, Basis)] {
        &self.functions
    }

    /// Which of them a term is.
    pub(super) fn function_of(&self, term: usize) -> usize {
        self.function_of[term]
    }

    /// Where the unknowns of an instrument begin.
    pub(super) fn first_of(&self, instrument: usize) -> usize {
        self.offsets[instrument]
    }
}
