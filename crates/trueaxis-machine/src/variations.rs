//! One command under other errors: another value of one of them ([`Variations`]), or other values of all ([`FixedCommand`]). The chain is
//! walked once, whatever is asked for afterwards.
//!
//! ```text
//!     where the error (t, I + D) acts the tool stands at p; what follows carries it on by the linear part L
//!     with (t', I + D'):   δ = L·(t' − t + (D' − D)·p)                      docs/model.md eq. 335
//! ```
//!
//! No order of smallness is neglected: the steps of the chain are affine in what comes to them.

mod drawn;

pub use crate::batch::drawn::{DRAWN, Factors};
pub use drawn::DrawnCommand;

use crate::axis::Command;
use crate::chain::{Link, Machine, Step};
use crate::deviation::{Deviation, inverse_turn_minus_identity, renormalised};
use crate::errors::{
    BodyErrors, Effect, ErrorIndex, ErrorKind, ErrorValues, MAX_BODIES, Rotation, SixErrors,
    Uncertainties,
};
use trueaxis_geometry::frame::{Direction, Point};
use trueaxis_geometry::{Mat3, Vec3};

/// The tool at one command under some errors, of which one at a time may have another value.
#[derive(Debug, Clone)]
pub struct Variations<'m> {
    machine: &'m Machine,
    command: &'m Command,
    errors: &'m ErrorValues,
    stations: [Option<Station>; 2 * MAX_BODIES],
    /// The actual axis at the end of the chain, not made a unit vector again.
    axis: Vec3,
}

/// Where the errors of one body and kind act.
#[derive(Debug, Clone, Copy)]
struct Station {
    /// What comes to it: actual tip and axis.
    tip_mm: Vec3,
    axis: Vec3,
    /// Its error is passed in the inverse direction.
    is_back: bool,
    /// A squareness tilts only this motion, mm.
    tilted_mm: Option<Vec3>,
    /// The linear part of what follows: to the next station as the chain is walked, in [`Variations`] to the workpiece.
    onward: Mat3,
}

/// On the way through the chain.
struct Walk {
    tip_mm: Vec3,
    axis: Vec3,
    stations: [Option<Station>; 2 * MAX_BODIES],
    /// In the order in which they were met.
    met: [usize; 2 * MAX_BODIES],
    count: usize,
}

impl Walk {
    fn forward(&mut self, step: &Link) {
        self.tip_mm = step.linear() * self.tip_mm + step.shift_mm();
        self.turn(step.linear());
    }

    fn backward(&mut self, step: &Link) {
        let back = step.linear().transpose();
        self.tip_mm = back * (self.tip_mm - step.shift_mm());
        self.turn(&back);
    }

    fn turn(&mut self, linear: &Mat3) {
        self.axis = linear * self.axis;
        if let Some(station) = self.last() {
            station.onward = linear * station.onward;
        }
    }

    fn last(&mut self) -> Option<&mut Station> {
        let last = self.count.checked_sub(1)?;
        self.stations[self.met[last]].as_mut()
    }

    /// Through the error of a station.
    fn displace(&mut self, slot: usize, station: Station, acted: [Vec3; 2]) {
        self.stations[slot] = Some(station);
        self.met[self.count] = slot;
        self.count += 1;
        [self.tip_mm, self.axis] = acted;
    }
}

impl Station {
    /// Where tip and axis are after these errors.
    fn acted(&self, rotation: Rotation, six: &SixErrors) -> [Vec3; 2] {
        let (shift, turn) = self.displacement(rotation, six);
        let tip_mm = if self.is_back { self.tip_mm - shift } else { self.tip_mm };
        let moved = if self.is_back { tip_mm } else { tip_mm + shift };
        [moved + turn * tip_mm, self.axis + turn * self.axis]
    }

    /// By how much tip and axis change after it with other errors.
    fn changed(&self, rotation: Rotation, [six, other]: [&SixErrors; 2]) -> [Vec3; 2] {
        let (shift, turn) = self.displacement(rotation, six);
        let (other_shift, other_turn) = self.displacement(rotation, other);
        let (by, turned) = (other_shift - shift, other_turn - turn);
        let tip_mm = match self.is_back {
            false => by + turned * self.tip_mm,
            true => turned * (self.tip_mm - shift) - by - other_turn * by,
        };
        [tip_mm, turned * self.axis]
    }

    /// The shift of an error, and its turn less the identity.
    fn displacement(&self, rotation: Rotation, six: &SixErrors) -> (Vec3, Mat3) {
        match self.tilted_mm {
            None if self.is_back => (six.shift_mm(), inverse_turn_minus_identity(six, rotation)),
            None => (six.shift_mm(), six.rotation_minus_identity(rotation)),
            Some(motion) => {
                let turn = six.rotation_minus_identity(rotation);
                (turn * motion + six.shift_mm(), Mat3::zeros())
            }
        }
    }
}

impl Machine {
    /// The tool at a command under these errors, to vary one of them at a time.
    pub fn variations<'m>(
        &'m self,
        command: &'m Command,
        errors: &'m ErrorValues,
    ) -> Variations<'m> {
        let Walk { axis, mut stations, met, count, .. } = self.walked(command, errors);
        let mut onward = Mat3::identity();
        for slot in met[..count].iter().rev() {
            let Some(station) = &mut stations[*slot] else { continue };
            onward *= station.onward;
            station.onward = onward;
            let six = six_of(errors, *slot);
            onward += onward * station.displacement(self.model().rotation, six).1;
        }
        Variations { machine: self, command, errors, stations, axis }
    }

    /// A command, to put the tool there under many sets of errors.
    pub fn fixed_command(&self, command: &Command) -> FixedCommand {
        let walk = self.walked(command, &ErrorValues::default());
        let station = |slot: &usize| {
            let station = walk.stations[*slot]?;
            let onward = (station.onward != Mat3::identity()).then_some(station.onward);
            Some((*slot, station, onward))
        };
        FixedCommand {
            stations: walk.met[..walk.count].iter().filter_map(station).collect(),
            rotation: self.model().rotation,
            tip_mm: walk.tip_mm,
            axis: walk.axis,
        }
    }

    /// From the tool to the workpiece.
    fn walked(&self, command: &Command, errors: &ErrorValues) -> Walk {
        let mut walk = Walk {
            tip_mm: self.tip_mm(),
            axis: Vec3::z(),
            stations: [None; 2 * MAX_BODIES],
            met: [0; 2 * MAX_BODIES],
            count: 0,
        };
        for i in (self.workpiece_side..self.bodies().len()).rev() {
            self.vary_towards_bed(i, command, &errors.bodies[i], &mut walk);
        }
        for i in (0..self.workpiece_side).rev() {
            self.vary_away_from_bed(i, command, &errors.bodies[i], &mut walk);
        }
        walk
    }

    fn vary_towards_bed(&self, i: usize, command: &Command, errors: &BodyErrors, walk: &mut Walk) {
        let body = &self.bodies()[i];
        let joint = self.nominal_joint(i, command);
        walk.forward(&body.mounting);
        self.fold_steps_back(i, walk, |walk, step| {
            if matches!(step, Step::Joint | Step::TiltedJoint) {
                walk.forward(&joint);
            }
            self.meet((i, step, &joint), errors, walk, false);
            walk
        })
        .forward(&body.placement);
    }

    fn vary_away_from_bed(
        &self,
        i: usize,
        command: &Command,
        errors: &BodyErrors,
        walk: &mut Walk,
    ) {
        let body = &self.bodies()[i];
        let joint = self.nominal_joint(i, command);
        walk.backward(&body.placement);
        self.fold_steps(i, walk, |walk, step| {
            self.meet((i, step, &joint), errors, walk, true);
            if matches!(step, Step::Joint | Step::TiltedJoint) {
                walk.backward(&joint);
            }
            walk
        })
        .backward(&body.mounting);
    }

    /// Through the error of a step, if it has one.
    fn meet(
        &self,
        (i, step, joint): (usize, Step, &Link),
        errors: &BodyErrors,
        walk: &mut Walk,
        is_back: bool,
    ) {
        let (kind, six, tilted_mm) = match step {
            Step::Location => (ErrorKind::Location, &errors.location, None),
            Step::Motion => (ErrorKind::Motion, &errors.motion, None),
            Step::TiltedJoint => (ErrorKind::Location, &errors.location, Some(*joint.shift_mm())),
            Step::Joint => return,
        };
        let station = Station {
            tip_mm: walk.tip_mm,
            axis: walk.axis,
            is_back,
            tilted_mm,
            onward: Mat3::identity(),
        };
        walk.displace(2 * i + kind as usize, station, station.acted(self.model().rotation, six));
    }
}

/// One command of a machine: what of its chain no error changes is computed once.
#[derive(Debug, Clone)]
pub struct FixedCommand {
    /// In the order from the tool to the workpiece: the number, what comes to it without errors, and the linear part to the next one, if it
    /// is not the identity.
    stations: Vec<(usize, Station, Option<Mat3>)>,
    rotation: Rotation,
    /// The nominal tool.
    tip_mm: Vec3,
    axis: Vec3,
}

impl FixedCommand {
    /// The deviation of the tool under the given errors: that of [`Machine::deviation`], to rounding.
    pub fn deviation(&self, errors: &ErrorValues) -> Deviation {
        let (mut tip_mm, mut axis) = (Vec3::zeros(), Vec3::zeros());
        for (slot, station, onward) in &self.stations {
            let six = six_of(errors, *slot);
            if !six.is_zero() {
                let (shift, turn) = station.displacement(self.rotation, six);
                let actual = station.tip_mm + tip_mm;
                tip_mm += match station.is_back {
                    false => shift + turn * actual,
                    true => turn * (actual - shift) - shift,
                };
                axis += turn * (station.axis + axis);
            }
            if let Some(onward) = onward {
                (tip_mm, axis) = (onward * tip_mm, onward * axis);
            }
        }
        if self.rotation == Rotation::SmallAngle {
            axis = renormalised(&self.axis, &axis);
        }
        Deviation {
            nominal_tip: Point::from_vector(self.tip_mm),
            nominal_axis: Direction::of(self.axis).unwrap_or(Direction::Z),
            tip_mm: tip_mm - errors.workpiece_mm,
            axis,
        }
    }
}

/// The errors of a station by its number.
fn six_of(errors: &ErrorValues, slot: usize) -> &SixErrors {
    let body = &errors.bodies[slot / 2];
    if slot % 2 == ErrorKind::Location as usize { &body.location } else { &body.motion }
}

impl Variations<'_> {
    /// By how much the tip, mm, and the unit vector of the axis change if one error has another value, mm or rad.
    ///
    /// # Example
    /// ```
    /// use trueaxis_machine::errors::{ErrorIndex, ErrorName, ErrorValues};
    /// use trueaxis_machine::{Machine, file::NoTables};
    /// let text = "[machine]\nname = \"mill\"\nchain = \"w b Y X Z t\"\n[tool]\nlength = \"100 mm\"";
    /// let machine = Machine::check("mill.toml", text, &NoTables).0.expect("a machine");
    /// let name = ErrorName::parse("EC0Y").expect("a name");
    /// let index = ErrorIndex { body: 1, kind: name.kind, component: name.component };
    /// let mut errors = ErrorValues::default();
    /// errors.set(index, 10e-6);
    /// let command = [500.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    /// // At Y = 500 mm 10 µrad of EC0Y move the tip by −5 µm in X: without them it is back.
    /// let [tip_mm, _] = machine.variations(&command, &errors).by(index, 0.0);
    /// assert!((tip_mm.x - 0.005).abs() < 1e-9, "{tip_mm}");
    /// ```
    pub fn by(&self, index: ErrorIndex, value: f64) -> [Vec3; 2] {
        self.between(index, [self.errors.get(index), value])
    }

    /// The same from one value to another.
    fn between(&self, index: ErrorIndex, [from, to]: [f64; 2]) -> [Vec3; 2] {
        let six = six_of(self.errors, slot(index));
        let [from, to] = [from, to].map(|value| with(six, index, value));
        self.change(index, [&from, &to])
    }

    fn change(&self, index: ErrorIndex, [from, to]: [&SixErrors; 2]) -> [Vec3; 2] {
        let Some(station) = &self.stations[slot(index)] else { return [Vec3::zeros(); 2] };
        let [tip_mm, axis] = station.changed(self.machine.model().rotation, [from, to]);
        let (tip_mm, axis) = (station.onward * tip_mm, station.onward * axis);
        match self.machine.model().rotation {
            Rotation::Exact => [tip_mm, axis],
            Rotation::SmallAngle => {
                let stated = six_of(self.errors, slot(index));
                let [_, begin] = station.changed(self.machine.model().rotation, [stated, from]);
                let begin = self.axis + station.onward * begin;
                [tip_mm, (begin + axis).normalize() - begin.normalize()]
            }
        }
    }

    /// By how much they differ from one standard uncertainty of each quantity below its value to one above.
    pub fn by_uncertainties(&self, known: &Uncertainties, quantities: usize) -> Vec<[Vec3; 2]> {
        let mut found = vec![[Vec3::zeros(); 2]; quantities];
        let mut counts = vec![0_usize; quantities];
        for (quantity, _) in known.effects() {
            if let Some(count) = counts.get_mut(quantity) {
                *count += 1;
            }
        }
        for (quantity, effect) in known.effects() {
            if counts.get(quantity) != Some(&1) {
                continue;
            }
            found[quantity] = match effect {
                Effect::Error(index, u) => {
                    let value = self.errors.get(*index);
                    self.between(*index, [value - u, value + u])
                }
                Effect::Workpiece(u_mm) => [-2.0 * u_mm, Vec3::zeros()],
            };
        }
        for (quantity, _) in counts.iter().enumerate().filter(|(_, count)| **count > 1) {
            found[quantity] = self.together(known, quantity);
        }
        found
    }

    /// A quantity that moves several errors.
    fn together(&self, known: &Uncertainties, quantity: usize) -> [Vec3; 2] {
        let [high, low] = [1.0, -1.0].map(|z| {
            let errors = known.displaced_by(self.errors, quantity, z);
            self.machine.deviation(self.command, &errors)
        });
        [high.tip_mm - low.tip_mm, high.axis - low.axis]
    }
}

fn slot(index: ErrorIndex) -> usize {
    2 * index.body + index.kind as usize
}

fn with(six: &SixErrors, index: ErrorIndex, value: f64) -> SixErrors {
    let mut other = *six;
    other.0[index.component as usize] = value;
    other
}
