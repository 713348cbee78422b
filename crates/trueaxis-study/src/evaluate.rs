//! The outputs of any samples, on all cores.

use crate::cases::{Prepared, State};
use crate::design::Place;
use crate::draw::Drawer;
use crate::inputs::Varied;
use crate::study::Study;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};
use trueaxis::machine::Machine;
use trueaxis::machine::heat::Conditions;

/// Samples that one thread does in a row.
const CHUNK: usize = 512;

/// A sample that cannot be made.
#[derive(Debug, Clone, PartialEq)]
pub struct SampleFault {
    /// Which one.
    pub sample: usize,
    /// What it is, and why it cannot be made.
    pub message: String,
}

impl Study {
    /// Numbers of a sample.
    pub fn output_count(&self) -> usize {
        self.cases.iter().map(|c| c.outputs.len()).sum()
    }

    /// The outputs of some samples, sample after sample, mm. They depend on nothing but the study and the numbers of the
    /// samples: the same bits on any number of threads, and in any pieces.
    ///
    /// `progress` is called with the number of samples that are done, from any thread.
    ///
    /// # Errors
    /// The first sample that cannot be made.
    pub fn evaluate(
        &self,
        samples: Range<usize>,
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<Vec<f64>, SampleFault> {
        let width = self.output_count();
        let mut out = vec![0.0; samples.len() * width];
        let done = AtomicUsize::new(0);
        let first = samples.start;
        let chunk = |(c, rows): (usize, &mut [f64])| {
            let from = first + c * CHUNK;
            self.chunk(from..from + rows.len() / width, rows)?;
            let count = rows.len() / width;
            progress(done.fetch_add(count, Ordering::Relaxed) + count);
            Ok(())
        };
        let faults: Vec<SampleFault> = out
            .par_chunks_mut(CHUNK * width)
            .enumerate()
            .filter_map(|(c, rows)| chunk((c, rows)).err())
            .collect();
        match faults.into_iter().min_by_key(|fault| fault.sample) {
            Some(fault) => Err(fault),
            None => Ok(out),
        }
    }

    /// The values of all inputs of some samples, sample after sample, in their inner units.
    pub fn inputs_of(&self, samples: Range<usize>) -> Vec<f64> {
        let width = self.inputs.len();
        let mut out = vec![0.0; samples.len() * width];
        let mut drawer = self.drawer();
        for (row, sample) in out.chunks_mut(width.max(1)).zip(samples) {
            drawer.values(sample, row);
        }
        out
    }

    fn drawer(&self) -> Drawer<'_> {
        Drawer::new(&self.design, &self.inputs, self.correlation.as_ref(), &self.group_of)
    }

    fn chunk(&self, samples: Range<usize>, rows: &mut [f64]) -> Result<(), SampleFault> {
        let width = self.output_count();
        let mut drawer = self.drawer();
        let mut drawn = vec![0.0; self.inputs.len()];
        let changes = self.inputs.iter().any(|i| i.changes_state());
        let mut order: Vec<usize> = samples.clone().collect();
        if changes {
            // Samples of one day follow each other: what a state needs is prepared once for all of them.
            order.sort_by_key(|sample| match self.design.place(*sample) {
                Place::Main { combination, machine, day } => (combination, day, machine),
                Place::Row { row, .. } => (usize::MAX, row, *sample),
            });
        }
        let own: Vec<&Machine> = self.cases.iter().map(|c| c.machine()).collect();
        let mut rest = &order[..];
        while let Some(&sample) = rest.first() {
            drawer.values(sample, &mut drawn);
            let at = if changes { self.state(&drawn, sample)? } else { State::default() };
            let elsewhere: Vec<Machine>;
            let machines: Vec<&Machine> = match changes {
                false => own.clone(),
                true => {
                    let all: Result<Vec<Machine>, String> =
                        self.cases.iter().map(|c| c.machine_at(&at)).collect();
                    elsewhere = all.map_err(|why| self.fault(sample, &drawn, &why))?;
                    elsewhere.iter().collect()
                }
            };
            let each = self.cases.iter().zip(machines);
            let prepared = each.map(|(case, machine)| case.prepare(machine, &at));
            let mut prepared: Vec<Prepared<'_>> = prepared
                .collect::<Result<_, _>>()
                .map_err(|why| self.fault(sample, &drawn, &why))?;
            // As long as the state stays.
            while let Some(&sample) = rest.first() {
                drawer.values(sample, &mut drawn);
                if changes && self.state(&drawn, sample)? != at {
                    break;
                }
                let row = sample - samples.start;
                let mut row = &mut rows[row * width..(row + 1) * width];
                for (case, prepared) in self.cases.iter().zip(&mut prepared) {
                    let (own, others) = row.split_at_mut(case.outputs.len());
                    prepared
                        .outputs(&self.inputs, &drawn, own)
                        .map_err(|why| self.fault(sample, &drawn, &why))?;
                    row = others;
                }
                rest = &rest[1..];
            }
        }
        Ok(())
    }

    /// What holds while a sample is made.
    fn state(&self, drawn: &[f64], sample: usize) -> Result<State, SampleFault> {
        let mut state = State::default();
        let mut conditions: Option<Conditions> = None;
        for (input, value) in self.inputs.iter().zip(drawn) {
            match &input.varied {
                Varied::Log(log) => {
                    let there = log.at(*value);
                    let outside = || self.fault(sample, drawn, "a time outside the log");
                    conditions = Some(there.ok_or_else(outside)?);
                }
                Varied::Workpiece(axis) => state.workpiece_mm[*axis] = *value,
                Varied::Setting(axis) => state.setting_rad.push((*axis, *value)),
                Varied::ToolLength => state.tool_length_mm = Some(*value),
                _ => {}
            }
        }
        for (input, value) in self.inputs.iter().zip(drawn) {
            let Varied::Temperatures(sensors) = &input.varied else { continue };
            for sensor in sensors {
                conditions =
                    Some(conditions.take().unwrap_or_default().with_reading(sensor, *value));
            }
        }
        state.conditions = conditions;
        Ok(state)
    }

    /// A sample in words.
    fn fault(&self, sample: usize, drawn: &[f64], why: &str) -> SampleFault {
        let what = match self.design.place(sample) {
            Place::Main { combination, machine, day } => {
                let of = match self.design.combinations() {
                    1 => String::new(),
                    _ => format!("combination {}, ", combination + 1),
                };
                format!("{of}machine {}, day {}", machine + 1, day + 1)
            }
            Place::Row { row, .. } => format!("row {} of the sensitivity analysis", row + 1),
        };
        let far = self.inputs.iter().zip(drawn).filter(|(input, _)| input.changes_state());
        let far: Vec<String> =
            far.map(|(input, value)| format!(", {} = {value:.6}", input.name)).collect();
        SampleFault { sample, message: format!("{what}{}: {why}", far.concat()) }
    }
}
