//! Readings and their slopes for eight rows of one instrument at a time.
//!
//! The same as [`Design::read`] and [`Design::slopes`], which stay as the judge and compute the rows that the groups do not
//! cover. A row's numbers depend on nothing but the row: not on its neighbours, not on the number of threads.

use super::design::Design;
use super::stated_errors::StatedErrors;
use super::term::{Basis, legendre};
use crate::instruments::instrument::{Setup, View, Wrench};
use crate::instruments::{Instrument, Readings};
use std::ops::Range;
use trueaxis_machine::axis::MAX_AXES;
use trueaxis_machine::batch::{CompiledChain, Frames, GROUP, Group, Station, sines_and_cosines};
use trueaxis_machine::chain::{CommandFault, Link};
use trueaxis_machine::errors::{Component, ErrorKind, OutsideTable};
use trueaxis_machine::twist::Reference;

/// A design prepared for groups of rows.
#[derive(Debug)]
pub(super) struct Groups<'a> {
    design: &'a Design,
    readings: &'a Readings,
    /// The chain as the workpiece sees the tool, and as the bed does; `None` where only the scalar form covers it.
    chains: Option<[CompiledChain; 2]>,
    /// The station of each run of terms.
    station_of_run: Vec<usize>,
    stated: StatedErrors<'a>,
}

/// Rows of one instrument and what is computed of them, kept for the next rows.
#[derive(Debug, Default)]
pub(super) struct Room {
    commands: [Group; MAX_AXES],
    approaches: [Group; MAX_AXES],
    /// φ of every function.
    functions: Vec<Group>,
    sines: Vec<(usize, u32, [Group; 2])>,
    /// The errors of each station.
    errors: Vec<[Group; 6]>,
    frames: Vec<Frames>,
    /// The moments at the origins of the stations.
    moments: Vec<[Group; 3]>,
    /// The slopes of the channels, one after the other.
    slopes: Vec<Group>,
    slopes_of: Option<u32>,
    row: Vec<f64>,
    sums: Sums,
}

impl<'a> Groups<'a> {
    pub(super) fn new(design: &'a Design, readings: &'a Readings) -> Self {
        let machine = &design.machine;
        let mut stations: Vec<Station> = Vec::new();
        let mut station = |body, kind| {
            let wanted = Station { body, kind };
            stations.iter().position(|s| *s == wanted).unwrap_or_else(|| {
                stations.push(wanted);
                stations.len() - 1
            })
        };
        let station_of_run = design.runs().iter().map(|(i, _)| station(i.body, i.kind)).collect();
        for (i, body) in machine.bodies().iter().enumerate() {
            for kind in [ErrorKind::Location, ErrorKind::Motion] {
                if StatedErrors::has(body, kind) {
                    station(i, kind);
                }
            }
        }
        let chain = |reference| CompiledChain::new(machine, reference, &stations);
        let chains = chain(Reference::Workpiece).zip(chain(Reference::Bed)).map(<[_; 2]>::from);
        let stated = StatedErrors::new(machine, &stations);
        Self { design, readings, chains, station_of_run, stated }
    }

    /// The rows by instruments, at most eight of one together.
    fn groups(&self, rows: Range<usize>) -> Vec<Vec<usize>> {
        let of = |i: &usize| self.readings.instruments[*i];
        let mut order: Vec<usize> = rows.collect();
        order.sort_by_key(of);
        let same = order.chunk_by(|a, b| of(a) == of(b));
        same.flat_map(|rows| rows.chunks(GROUP)).map(<[usize]>::to_vec).collect()
    }

    /// A pass through the rows with these values of the unknowns: `row` gets each row and what its instrument would read, mm or
    /// rad, and says by how much the slopes of each of its channels count. Returns the sum of the slopes for each unknown.
    ///
    /// # Errors
    /// The first row outside an error table of the machine file, and why.
    pub(super) fn pass(
        &self,
        rows: Range<usize>,
        values: &[f64],
        mut row: impl FnMut(usize, [f64; 3]) -> [f64; 3],
    ) -> Result<Vec<f64>, (usize, CommandFault)> {
        let mut room = Room { sums: Sums::new(self.design), ..Room::default() };
        let mut is_whole = true;
        // The groups of an instrument follow each other.
        let mut last: Option<(u32, Setup)> = None;
        for group in self.groups(rows.clone()) {
            let of = self.readings.instruments[group[0]];
            let setup = match last {
                Some((known, setup)) if known == of => setup,
                _ => {
                    let values = self.design.setup(of as usize, values);
                    self.design.instruments[of as usize].setup(values)
                }
            };
            last = Some((of, setup));
            let done = self.pass_group(&mut room, &group, &setup, values, &mut row);
            is_whole &= done.is_ok();
        }
        if is_whole {
            return Ok(room.sums.all());
        }
        // Which row comes first does not depend on the instruments.
        let first = rows
            .into_iter()
            .find_map(|i| self.design.read(self.readings, i, values).err().map(|fault| (i, fault)));
        first.map_or_else(|| Ok(room.sums.all()), Err)
    }

    fn pass_group(
        &self,
        room: &mut Room,
        group: &[usize],
        setup: &Setup,
        values: &[f64],
        row: &mut impl FnMut(usize, [f64; 3]) -> [f64; 3],
    ) -> Result<(), CommandFault> {
        let instrument = self.instrument(group);
        let first = self.design.first_of(self.readings.instruments[group[0]] as usize);
        let Some(chain) = self.chain(instrument) else {
            return self.one_by_one(room, group, values, row);
        };
        room.load(self.readings, group);
        if self.put_errors(room, group, values).is_err() {
            return self.one_by_one(room, group, values, row);
        }
        let (mut nominal, mut actual) = (Frames::ZERO, Frames::ZERO);
        room.frames.resize(chain.stations().len(), Frames::ZERO);
        let undecided = chain.tools(&room.commands, &room.errors, &mut actual)
            | chain.frames(&room.commands, &mut room.frames, &mut nominal);
        let mut wrenches = WrenchLanes::ZERO;
        for (lane, i) in group.iter().enumerate() {
            if undecided >> lane & 1 == 1 {
                self.one_by_one(room, &group[lane..=lane], values, row)?;
                continue;
            }
            let nominal = nominal.at(lane);
            let tool = self.grown(instrument, *i, actual.at(lane));
            let view = self.view(instrument, *i, nominal, tool);
            let counts = row(*i, instrument.read_in(&view, setup));
            let own = instrument.wrenches(&view);
            let channels = instrument.sight.channels();
            for (c, (wrench, count)) in own.iter().zip(counts).enumerate().take(channels) {
                wrenches.add(lane, wrench, count);
                for (sum, unknown) in room.sums.single[first..].iter_mut().zip(&instrument.unknowns)
                {
                    *sum += count * instrument.setup_slope(unknown.error, c, wrench, &view);
                }
            }
        }
        room.moments.clear();
        room.moments.extend(room.frames.iter().map(|frames| wrenches.moment_at(frames)));
        for ((index, run), station) in self.design.runs().iter().zip(&self.station_of_run) {
            let frames = &room.frames[*station];
            let (moment, side) = (&room.moments[*station], chain.side(*station));
            let on = on(&wrenches.force, moment, frames, index.component, side);
            for k in run.clone() {
                let phi = &room.functions[self.design.function_of(k)];
                for ((sum, on), phi) in room.sums.terms[k].iter_mut().zip(&on).zip(phi) {
                    *sum += on * phi;
                }
            }
        }
        Ok(())
    }

    /// Rows that the groups do not cover.
    fn one_by_one(
        &self,
        room: &mut Room,
        rows: &[usize],
        values: &[f64],
        row: &mut impl FnMut(usize, [f64; 3]) -> [f64; 3],
    ) -> Result<(), CommandFault> {
        let n = self.design.unknowns();
        for i in rows {
            let counts = row(*i, self.design.read(self.readings, *i, values)?);
            room.row.resize(3 * n, 0.0);
            let channels = self.design.slopes(self.readings, *i, &mut room.row);
            for (slopes, count) in room.row.chunks_exact(n.max(1)).zip(counts).take(channels) {
                for (sum, slope) in room.sums.single.iter_mut().zip(slopes) {
                    *sum += count * slope;
                }
            }
        }
        Ok(())
    }

    /// How each channel of a reading follows every unknown: `row` gets each row and its slopes, one channel after the other.
    pub(super) fn slopes(&self, rows: Range<usize>, mut row: impl FnMut(usize, &[f64])) {
        let mut room = Room::default();
        for group in self.groups(rows) {
            self.slopes_group(&mut room, &group, &mut row);
        }
    }

    /// The rows in units of their noise, one *column* each, in order, as [`Design::columns`]: Jᵀ/u.
    pub(super) fn columns(&self, rows: Range<usize>, values: &mut Vec<f64>) {
        let n = self.design.unknowns();
        let starts = self.starts(rows.clone());
        values.resize(n * starts.last().copied().unwrap_or(0), 0.0);
        self.slopes(rows.clone(), |i, slopes| {
            let start = n * starts[i - rows.start];
            let noise = self.instrument(&[i]).noise;
            let columns = values[start..start + slopes.len()].chunks_exact_mut(n.max(1));
            for ((column, slopes), u) in columns.zip(slopes.chunks_exact(n.max(1))).zip(noise) {
                let per_u = 1.0 / u;
                for (to, slope) in column.iter_mut().zip(slopes) {
                    *to = slope * per_u;
                }
            }
        });
    }

    /// How many numbers the rows before each row have, and all of them.
    fn starts(&self, rows: Range<usize>) -> Vec<usize> {
        let mut next = 0;
        let before = |i: usize| {
            let start = next;
            next += self.instrument(&[i]).sight.channels();
            start
        };
        let mut starts: Vec<usize> = rows.map(before).collect();
        starts.push(next);
        starts
    }

    fn slopes_group(&self, room: &mut Room, group: &[usize], row: &mut impl FnMut(usize, &[f64])) {
        let instrument = self.instrument(group);
        let n = self.design.unknowns();
        let numbers = instrument.sight.channels() * n;
        room.row.resize(numbers, 0.0);
        let mut undecided = u32::MAX;
        let mut tool = Frames::ZERO;
        if let Some(chain) = self.chain(instrument) {
            room.load(self.readings, group);
            self.put_functions(room, group);
            room.frames.resize(chain.stations().len(), Frames::ZERO);
            undecided = chain.frames(&room.commands, &mut room.frames, &mut tool);
            self.put_slopes(room, chain, group, &tool);
        }
        for (lane, i) in group.iter().enumerate() {
            if undecided >> lane & 1 == 1 {
                self.design.slopes(self.readings, *i, &mut room.row);
            } else {
                for (to, from) in room.row.iter_mut().zip(&room.slopes) {
                    *to = from[lane];
                }
            }
            row(*i, &room.row);
        }
    }

    /// The slopes of a group, one after the other.
    fn put_slopes(&self, room: &mut Room, chain: &CompiledChain, group: &[usize], tool: &Frames) {
        let (design, instrument) = (self.design, self.instrument(group));
        let (n, channels) = (design.unknowns(), instrument.sight.channels());
        // Of one instrument the same slopes are zero everywhere.
        let of = Some(self.readings.instruments[group[0]]);
        if room.slopes_of != of {
            room.slopes.clear();
            room.slopes.resize(channels * n, [0.0; GROUP]);
            room.slopes_of = of;
        }
        let mut lanes = [WrenchLanes::ZERO; 3];
        let first = design.first_of(self.readings.instruments[group[0]] as usize);
        for (lane, i) in group.iter().enumerate() {
            let view = self.view(instrument, *i, tool.at(lane), tool.at(lane));
            let wrenches = instrument.wrenches(&view);
            for (c, wrench) in wrenches.iter().enumerate().take(channels) {
                lanes[c].add(lane, wrench, 1.0);
                for (j, unknown) in instrument.unknowns.iter().enumerate() {
                    room.slopes[c * n + first + j][lane] =
                        instrument.setup_slope(unknown.error, c, wrench, &view);
                }
            }
        }
        room.moments.clear();
        for frames in &room.frames {
            room.moments.extend(lanes[..channels].iter().map(|lanes| lanes.moment_at(frames)));
        }
        for ((index, run), station) in design.runs().iter().zip(&self.station_of_run) {
            let side = chain.side(*station);
            if side == 0.0 {
                continue;
            }
            let frames = &room.frames[*station];
            for (c, lanes) in lanes.iter().enumerate().take(channels) {
                let moment = &room.moments[station * channels + c];
                let on = on(&lanes.force, moment, frames, index.component, side);
                for k in run.clone() {
                    let phi = &room.functions[design.function_of(k)];
                    room.slopes[c * n + k] = product(&on, phi);
                }
            }
        }
    }

    /// The errors of each station.
    fn put_errors(
        &self,
        room: &mut Room,
        group: &[usize],
        values: &[f64],
    ) -> Result<(), OutsideTable> {
        self.stated.put(&room.commands, &room.approaches, &mut room.errors)?;
        self.put_functions(room, group);
        for ((index, run), station) in self.design.runs().iter().zip(&self.station_of_run) {
            let error = &mut room.errors[*station][index.component as usize];
            for k in run.clone() {
                let phi = &room.functions[self.design.function_of(k)];
                for (error, phi) in error.iter_mut().zip(phi) {
                    *error += values[k] * phi;
                }
            }
        }
        Ok(())
    }

    /// φ of every function at the commands of a group.
    fn put_functions(&self, room: &mut Room, group: &[usize]) {
        room.sines.clear();
        room.functions.clear();
        for (axis, basis) in self.design.functions() {
            let phi = match (*basis, *axis) {
                (Basis::Constant, _) => [1.0; GROUP],
                (Basis::Cosine(order), Some(axis)) => room.harmonic(axis, order)[1],
                (Basis::Sine(order), Some(axis)) => room.harmonic(axis, order)[0],
                (Basis::Legendre { degree, middle, half }, Some(axis)) => {
                    legendre(degree, room.commands[axis].map(|q| (q - middle) / half))
                }
                (Basis::Hat { .. }, Some(axis)) => room.commands[axis].map(|q| basis.value(q, 0.0)),
                (basis, axis) => {
                    let mut phi = [0.0; GROUP];
                    for (phi, i) in phi.iter_mut().zip(group) {
                        let moment = self.readings.moment(*i);
                        *phi = basis.at(&self.readings.commands[*i], axis, &moment);
                    }
                    phi
                }
            };
            room.functions.push(phi);
        }
    }

    /// The tool as a workpiece that is not at 20 °C sees it; the bed, and most instruments, do not see its growth.
    fn grown(&self, instrument: &Instrument, i: usize, tool: Link) -> Link {
        let sees_growth =
            instrument.reference == Reference::Workpiece && instrument.kind.reads_the_workpiece();
        match self.design.machine.growth() {
            Some(growth) if sees_growth => {
                let tip_mm = self.design.machine.nominal_tip_mm(&self.readings.commands[i]);
                Link::new(*tool.linear(), tool.shift_mm() - growth.at(tip_mm))
            }
            _ => tool,
        }
    }

    fn instrument(&self, group: &[usize]) -> &'a Instrument {
        &self.design.instruments[self.readings.instruments[group[0]] as usize]
    }

    fn chain(&self, instrument: &Instrument) -> Option<&CompiledChain> {
        let [workpiece, bed] = self.chains.as_ref()?;
        Some(if instrument.reference == Reference::Bed { bed } else { workpiece })
    }

    fn view(&self, instrument: &Instrument, i: usize, nominal: Link, actual: Link) -> View {
        let readings = self.readings;
        let machine = &self.design.machine;
        let drifted = instrument.drifted(machine, &readings.commands[i], readings.times_s[i]);
        View { nominal, actual, direction: readings.directions[i], drifted }
    }
}

impl Room {
    /// The commands of a group; the last row fills the lanes that have none.
    fn load(&mut self, readings: &Readings, group: &[usize]) {
        for lane in 0..GROUP {
            let i = group[lane.min(group.len() - 1)];
            for axis in 0..MAX_AXES {
                self.commands[axis][lane] = readings.commands[i][axis];
                self.approaches[axis][lane] = readings.approaches[i][axis];
            }
        }
    }

    /// Sine and cosine of an axis times a whole number.
    fn harmonic(&mut self, axis: usize, order: u32) -> [Group; 2] {
        if let Some((.., known)) = self.sines.iter().find(|s| (s.0, s.1) == (axis, order)) {
            return *known;
        }
        let both = sines_and_cosines(&self.commands[axis].map(|q| f64::from(order) * q));
        self.sines.push((axis, order, both));
        both
    }
}

/// Sums of slopes.
#[derive(Debug, Default)]
struct Sums {
    /// Of the terms, each lane for itself.
    terms: Vec<Group>,
    /// Of all unknowns, what does not come in lanes.
    single: Vec<f64>,
}

impl Sums {
    fn new(design: &Design) -> Self {
        let terms = vec![[0.0; GROUP]; design.terms.len()];
        Self { terms, single: vec![0.0; design.unknowns()] }
    }

    fn all(mut self) -> Vec<f64> {
        for (sum, lanes) in self.single.iter_mut().zip(&self.terms) {
            *sum += lanes.iter().sum::<f64>();
        }
        self.single
    }
}

/// Wrenches, one of each row.
#[derive(Debug, Clone, Copy)]
struct WrenchLanes {
    force: [Group; 3],
    moment: [Group; 3],
}

impl WrenchLanes {
    const ZERO: Self = Self { force: [[0.0; GROUP]; 3], moment: [[0.0; GROUP]; 3] };

    /// Adds a wrench as often as it counts.
    fn add(&mut self, lane: usize, wrench: &Wrench, count: f64) {
        for k in 0..3 {
            self.force[k][lane] += count * wrench.force[k];
            self.moment[k][lane] += count * wrench.moment[k];
        }
    }

    /// The moment about the origin of these frames, `m + f × o`.
    fn moment_at(&self, frames: &Frames) -> [Group; 3] {
        let (f, o) = (&self.force, &frames.shift_mm);
        let mut moment = self.moment;
        for (k, moment) in moment.iter_mut().enumerate() {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            for lane in 0..GROUP {
                moment[lane] += f[i][lane] * o[j][lane] - f[j][lane] * o[i][lane];
            }
        }
        moment
    }
}

/// The reading per unit of an error in these frames, from force and moment at their origin.
///
/// ```text
///     shift along e:    f · e                turn about e:    f · (o × e) + m · e = (f × o + m) · e
/// ```
fn on(
    force: &[Group; 3],
    moment: &[Group; 3],
    frames: &Frames,
    component: Component,
    side: f64,
) -> Group {
    let [x, y, z] = &frames.columns[component as usize % 3];
    let [a, b, c] = if component.is_rotation() { moment } else { force };
    let mut on = [0.0; GROUP];
    for lane in 0..GROUP {
        on[lane] = side * (a[lane] * x[lane] + b[lane] * y[lane] + c[lane] * z[lane]);
    }
    on
}

fn product(a: &Group, b: &Group) -> Group {
    let mut product = *a;
    for (product, b) in product.iter_mut().zip(b) {
        *product *= b;
    }
    product
}
