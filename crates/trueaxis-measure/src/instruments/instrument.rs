//! What an instrument reads at a pose of the machine, and how the reading follows a small motion.
//!
//! Every instrument of the shop looks at one point of the tool (a socket, a stylus, a reflector)
//! from one point of the reference (a ball, a face, a station), and reads one of five things of it:
//! its [`Sight`]. How a reading grows with an error of the machine follows from one wrench:
//!
//! ```text
//!     δr = f · v + m · ω         (v, ω) the twist of the error            docs/model.md eq. 104
//! ```

use super::Kind;
use super::drift::{Drift, Drifted};
use super::element::{Element, across};
use super::material::MaterialCompensation;
use nalgebra::Rotation3;
use trueaxis_geometry::frame::Pose;
use trueaxis_geometry::{Mat3, Vec3};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Command;
use trueaxis_machine::chain::Link;
use trueaxis_machine::errors::{ErrorValues, Rotation, SixErrors};
use trueaxis_machine::twist::{Reference, Twist};

/// What is read of the tool point P as seen from the reference point Q; R the attitude of the tool.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sight {
    /// `Rᵀ(Q − P)`: ball minus socket in the frame of the probe, z towards the spindle.
    ProbeOffset,
    /// `P − Q`: where the tool point is, along x, y, z of the reference.
    Place,
    /// `|P − Q|`.
    Distance,
    /// `n · (P − Q)` along the direction n of the station.
    Along,
    /// How far the tool is turned about n against its nominal attitude.
    Turn,
    /// How far P is from an element through Q.
    Element(Element),
}

impl Sight {
    /// How many numbers a reading has.
    pub fn channels(self) -> usize {
        match self {
            Self::ProbeOffset | Self::Place => 3,
            Self::Distance | Self::Along | Self::Turn => 1,
            Self::Element(element) => element.channels().len(),
        }
    }

    /// Whether it reads an angle (rad) and not a length (mm).
    pub fn is_angle(self) -> bool {
        self == Self::Turn
    }
}

/// What of a set-up is not known exactly, and may be found with the errors of the machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SetupError {
    /// The tool point is displaced along x, y, z (0, 1, 2) of the tool, mm.
    ToolPoint(usize),
    /// The instrument is displaced along x, y, z of the reference, mm.
    ReferencePoint(usize),
    /// The instrument is turned about x, y, z of the reference, through its origin, rad.
    ReferenceTurn(usize),
    /// The element is displaced along e₁, e₂ across its direction or along it (0, 1, 2), mm.
    Shift(usize),
    /// The element is turned about e₁ or e₂ (0, 1) through its reference point, rad.
    Tilt(usize),
    /// The zero of a channel, mm or rad: dead path, length of a bar, radius of a stylus or an element.
    Zero(usize),
    /// Readings are too long by this share: wavelength, scale of a sensor.
    Scale,
    /// The material is longer by this share than its compensation assumes.
    Material,
    /// The instrument drifts along (an angle: about) X, Y, Z of the machine against the tool, mm/h or rad/h.
    Drift(usize),
    /// The zero of a distance drifts, mm/h: a bar that grows longer, a dead path.
    ZeroDrift,
    /// The tool point drifts along z of the tool, mm/h: a spindle that grows is negative.
    ToolDrift,
}

impl SetupError {
    /// Whether it is a share of a length, a plain number.
    pub fn is_share(self) -> bool {
        matches!(self, Self::Scale | Self::Material)
    }

    /// Whether it grows with time: a rate by the hour.
    pub fn is_rate(self) -> bool {
        matches!(self, Self::Drift(_) | Self::ZeroDrift | Self::ToolDrift)
    }
}

/// An unknown of a set-up.
#[derive(Debug, Clone, PartialEq)]
pub struct SetupUnknown {
    /// Its name, such as `ball_x`.
    pub name: String,
    /// What it displaces.
    pub error: SetupError,
    /// The standard uncertainty with which it is known to be 0; `None`: free. Unit: mm, rad, 1 or by the hour.
    pub prior_u: Option<f64>,
}

/// Which way the numbers of a file count.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Reads {
    /// As the instrument is defined: of a probe-ball ball − socket, of all others true − commanded.
    #[default]
    AsDefined,
    /// The other way round.
    Opposite,
}

impl Reads {
    /// 1 or −1.
    pub fn sign(self) -> f64 {
        if self == Self::Opposite { -1.0 } else { 1.0 }
    }
}

/// What a campaign did not state of an instrument, and what was assumed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Assumed {
    /// Which way its numbers count.
    pub reads: bool,
    /// How well the length of the tool is known.
    pub length: bool,
}

/// An instrument as it is set up on the machine.
#[derive(Debug, Clone, PartialEq)]
pub struct Instrument {
    /// Its name in the campaign.
    pub name: String,
    /// What it is, in the words of the shop.
    pub kind: Kind,
    /// What it reads.
    pub sight: Sight,
    /// What it stands on.
    pub reference: Reference,
    /// P, in the frame of the tool, mm.
    pub tool_point_mm: Vec3,
    /// Q, in the frame of the reference, mm.
    pub reference_point_mm: Vec3,
    /// n where a station says nothing else, a unit vector in the frame of the reference.
    pub direction: Vec3,
    /// What the reading is measured against: the length of a bar, the radius of a ball or element, mm; of a
    /// probe-ball the distance from ball to probe, where the feed of a path counts.
    pub length_mm: f64,
    /// The standard uncertainty of one reading of each channel. Unit: mm or rad.
    pub noise: [f64; 3],
    /// What is not known of its set-up.
    pub unknowns: Vec<SetupUnknown>,
    /// Lengths as a material of 20 °C has them, where it is set to that.
    pub material: Option<MaterialCompensation>,
    /// Which way the numbers of its files count.
    pub reads: Reads,
    /// What its section did not state.
    pub assumed: Assumed,
    /// How it drifts while it reads.
    pub drift: Drift,
}

/// The tool at a station as the reference sees it.
#[derive(Debug, Clone, Copy)]
pub struct View {
    /// reference_from_tool without errors.
    pub nominal: Link,
    /// reference_from_tool as it is.
    pub actual: Link,
    /// n, a unit vector in the frame of the reference.
    pub direction: Vec3,
    /// How far drifts of 1 by the hour have gone.
    pub drifted: Drifted,
}

/// How a reading follows a small motion of the tool: force and moment on the twist.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wrench {
    /// Per mm of a shift.
    pub force: Vec3,
    /// Per rad of a turn about the origin of the reference.
    pub moment: Vec3,
}

impl Wrench {
    /// The reading per unit of an error with this twist.
    pub fn on(&self, twist: &Twist) -> f64 {
        self.force.dot(&twist.shift_mm) + self.moment.dot(&twist.turn_rad)
    }
}

/// An actual set-up: its unknowns with their values.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Setup {
    tool_point_mm: Vec3,
    instrument_from_reference: Link,
    element_shift_mm: [f64; 3],
    tilt_rad: [f64; 2],
    zero: [f64; 3],
    scale: f64,
    material: f64,
    drift_per_h: Vec3,
    zero_per_h: f64,
    tool_per_h: f64,
}

impl Default for Setup {
    fn default() -> Self {
        Self {
            tool_point_mm: Vec3::zeros(),
            instrument_from_reference: Link::identity(),
            element_shift_mm: [0.0; 3],
            tilt_rad: [0.0; 2],
            zero: [0.0; 3],
            scale: 0.0,
            material: 0.0,
            drift_per_h: Vec3::zeros(),
            zero_per_h: 0.0,
            tool_per_h: 0.0,
        }
    }
}

impl Instrument {
    /// One as its kind is usually set up: on the workpiece, at the tip of the tool, with noise of 1 µm or 1 µrad.
    pub fn usual(kind: Kind, machine: &Machine) -> Self {
        let noise = if kind.sight().is_angle() { 1e-6 } else { 1e-3 };
        Self {
            name: kind.name().to_owned(),
            kind,
            sight: kind.sight(),
            reference: Reference::Workpiece,
            tool_point_mm: machine.tip_mm(),
            reference_point_mm: Vec3::zeros(),
            direction: Vec3::x(),
            length_mm: 0.0,
            noise: [noise; 3],
            unknowns: kind.usual_setup(),
            material: None,
            reads: Reads::default(),
            assumed: Assumed::default(),
            drift: Drift::default(),
        }
    }

    /// The tool at a command of a machine with these errors, as the instrument's reference sees it before it drifts.
    pub fn view(
        &self,
        machine: &Machine,
        command: &Command,
        errors: &ErrorValues,
        direction: Vec3,
    ) -> View {
        let nominal = self.tool_seen(machine, command, &ErrorValues::default());
        let actual = self.tool_seen(machine, command, errors);
        View { nominal, actual, direction, drifted: Drifted::default() }
    }

    /// reference_from_tool at a command of a machine with these errors.
    pub fn tool_seen(&self, machine: &Machine, command: &Command, errors: &ErrorValues) -> Link {
        let errors = &self.errors_seen(errors);
        match self.reference {
            Reference::Workpiece => machine.pose(command, errors).relabel(),
            Reference::Bed => machine.tool_on_bed(command, errors).relabel(),
        }
    }

    /// The errors that it reads: most instruments do not see the growth of the workpiece.
    pub fn errors_seen(&self, errors: &ErrorValues) -> ErrorValues {
        match self.kind.reads_the_workpiece() {
            true => *errors,
            false => ErrorValues { workpiece_mm: Vec3::zeros(), ..*errors },
        }
    }

    /// What it reads at a command of the nominal machine in the nominal set-up, without compensation
    /// of a material: the target.
    pub fn nominal_reading(
        &self,
        machine: &Machine,
        command: &Command,
        direction: Vec3,
    ) -> [f64; 3] {
        let view = self.view(machine, command, &ErrorValues::default(), direction);
        self.counted(&view, &Setup::default())
    }

    /// The reading at a station, with the unknowns of the set-up at these values.
    ///
    /// Lengths in mm, angles in rad; the channels that the sight does not have are 0.
    pub fn read(&self, view: &View, unknowns: &[f64]) -> [f64; 3] {
        self.read_in(view, &self.setup(unknowns))
    }

    /// The same in a set-up that many readings share.
    pub(crate) fn read_in(&self, view: &View, setup: &Setup) -> [f64; 3] {
        let mut reading = self.counted(view, setup);
        if let Some(material) = &self.material {
            reading[0] -= (material.share() + setup.material) * self.material_length(view);
        }
        reading
    }

    /// n · (P₀ − F): how long the material is from its datum to the nominal tool point, mm.
    fn material_length(&self, view: &View) -> f64 {
        let Some(material) = &self.material else { return 0.0 };
        let p = view.nominal.linear() * self.tool_point_mm + view.nominal.shift_mm();
        view.direction.dot(&(p - material.datum_mm))
    }

    /// The reading before any material is taken into account.
    fn counted(&self, view: &View, setup: &Setup) -> [f64; 3] {
        let seen_by_instrument = setup.instrument_from_reference * view.actual;
        let grown = Vec3::new(0.0, 0.0, setup.tool_per_h * view.drifted.hours);
        let p = seen_by_instrument.linear() * (self.tool_point_mm + setup.tool_point_mm + grown)
            + seen_by_instrument.shift_mm();
        let drifted = view.drifted.along_axes * setup.drift_per_h;
        let from_q = match self.sight.is_angle() {
            true => p - self.reference_point_mm,
            false => p - drifted - self.reference_point_mm,
        };
        let mut reading = match self.sight {
            Sight::Element(element) => {
                let d = self.seen_by_element(from_q, setup);
                element.distances_mm(d, self.direction, self.length_mm)
            }
            Sight::ProbeOffset => (seen_by_instrument.linear().transpose() * -from_q).into(),
            Sight::Place => from_q.into(),
            Sight::Distance => {
                let zero = setup.zero_per_h * view.drifted.hours;
                [from_q.norm() + zero, 0.0, 0.0]
            }
            Sight::Along => [view.direction.dot(&from_q), 0.0, 0.0],
            Sight::Turn => {
                let turn = seen_by_instrument.linear() * view.nominal.linear().transpose();
                // The axis times the sine of the angle: half of R − Rᵀ.
                let [x, y, z] =
                    [(2, 1), (0, 2), (1, 0)].map(|(i, j)| 0.5 * (turn[(i, j)] - turn[(j, i)]));
                [view.direction.dot(&(Vec3::new(x, y, z) - drifted)), 0.0, 0.0]
            }
        };
        for (value, zero) in reading.iter_mut().zip(setup.zero).take(self.sight.channels()) {
            *value = *value * (1.0 + setup.scale) + zero;
        }
        reading
    }

    /// d as a displaced element sees it.
    ///
    /// ```text
    ///     d → R(τ₁e₁ + τ₂e₂)ᵀ (d − σ₁e₁ − σ₂e₂ − σ₃n)                            docs/model.md eq. 317
    /// ```
    fn seen_by_element(&self, from_q: Vec3, setup: &Setup) -> Vec3 {
        let [first, second] = across(self.direction);
        let [along_first, along_second, along] = setup.element_shift_mm;
        let shift = first * along_first + second * along_second + self.direction * along;
        let [about_first, about_second] = setup.tilt_rad;
        let turn = Rotation3::new(first * about_first + second * about_second);
        turn.inverse() * (from_q - shift)
    }

    /// How each channel follows a small motion of the tool at its nominal pose.
    ///
    /// ```text
    ///     probe offset i   f = −R·eᵢ     m = −Q × R·eᵢ
    ///     place i          f = eᵢ        m = P × eᵢ
    ///     distance         f = d         m = P × d          d = (P − Q)/|P − Q|
    ///     along n          f = n         m = P × n
    ///     turn about n     f = 0         m = n                        docs/model.md eq. 105
    /// ```
    pub fn wrenches(&self, view: &View) -> [Wrench; 3] {
        let r = view.nominal.linear();
        let p = r * self.tool_point_mm + view.nominal.shift_mm();
        let through = |point: Vec3, force: Vec3| Wrench { force, moment: point.cross(&force) };
        let nothing = Wrench { force: Vec3::zeros(), moment: Vec3::zeros() };
        let q = self.reference_point_mm;
        match self.sight {
            Sight::Element(element) => {
                element.normals(p - q, self.direction).map(|normal| through(p, normal))
            }
            Sight::ProbeOffset => {
                let along = |i: usize| through(q, -Vec3::new(r[(0, i)], r[(1, i)], r[(2, i)]));
                [along(0), along(1), along(2)]
            }
            Sight::Place => [0, 1, 2].map(|i| through(p, Vec3::ith(i, 1.0))),
            Sight::Distance => {
                // At the reference point itself a distance has no direction; nothing is seen there.
                let d = (p - q).try_normalize(0.0).unwrap_or_else(Vec3::zeros);
                [through(p, d), nothing, nothing]
            }
            Sight::Along => [through(p, view.direction), nothing, nothing],
            Sight::Turn => {
                [Wrench { force: Vec3::zeros(), moment: view.direction }, nothing, nothing]
            }
        }
    }

    /// How a channel follows an unknown of the set-up; `wrench` is that of the channel.
    ///
    /// A displaced instrument sees the tool displaced the other way.
    pub fn setup_slope(
        &self,
        error: SetupError,
        channel: usize,
        wrench: &Wrench,
        view: &View,
    ) -> f64 {
        match error {
            SetupError::ToolPoint(i) if self.sight != Sight::Turn => {
                wrench.force.dot(&view.nominal.linear().column(i))
            }
            SetupError::ToolPoint(_) => 0.0,
            SetupError::ReferencePoint(i) => -wrench.force[i],
            SetupError::ReferenceTurn(i) => -wrench.moment[i],
            SetupError::Shift(2) => -wrench.force.dot(&self.direction),
            SetupError::Shift(i) => -wrench.force.dot(&across(self.direction)[i.min(1)]),
            SetupError::Tilt(i) => {
                let about_q = wrench.moment - self.reference_point_mm.cross(&wrench.force);
                -about_q.dot(&across(self.direction)[i.min(1)])
            }
            SetupError::Zero(i) if i == channel => self.zero_sign(),
            SetupError::Zero(_) => 0.0,
            SetupError::Scale => {
                let nominal = View { actual: view.nominal, ..*view };
                self.counted(&nominal, &Setup::default())[channel]
            }
            SetupError::Material => -self.material_length(view),
            SetupError::Drift(i) if self.sight == Sight::Turn => {
                -wrench.moment.dot(&view.drifted.along_axes.column(i))
            }
            SetupError::Drift(i) => -wrench.force.dot(&view.drifted.along_axes.column(i)),
            SetupError::ZeroDrift if self.sight == Sight::Distance => {
                self.zero_sign() * view.drifted.hours
            }
            SetupError::ZeroDrift => 0.0,
            SetupError::ToolDrift => {
                let along = SetupError::ToolPoint(2);
                self.setup_slope(along, channel, wrench, view) * view.drifted.hours
            }
        }
    }

    /// A larger radius of ball and stylus or of an element stands for a shorter reading, all other zeros for a longer.
    fn zero_sign(&self) -> f64 {
        let is_radius = self.kind.element().is_some_and(Element::is_round);
        if self.kind.triggers() || is_radius { -1.0 } else { 1.0 }
    }

    /// The set-up with its unknowns at these values.
    pub(crate) fn setup(&self, unknowns: &[f64]) -> Setup {
        let (mut setup, mut displaced) = (Setup::default(), SixErrors::default());
        for (unknown, value) in self.unknowns.iter().zip(unknowns) {
            match unknown.error {
                SetupError::ToolPoint(i) => setup.tool_point_mm[i] += value,
                SetupError::ReferencePoint(i) => displaced.0[i] += value,
                SetupError::ReferenceTurn(i) => displaced.0[3 + i] += value,
                SetupError::Shift(i) => setup.element_shift_mm[i] += value,
                SetupError::Tilt(i) => setup.tilt_rad[i] += value,
                SetupError::Zero(i) => setup.zero[i] += self.zero_sign() * value,
                SetupError::Scale => setup.scale += value,
                SetupError::Material => setup.material += value,
                SetupError::Drift(i) => setup.drift_per_h[i] += value,
                SetupError::ZeroDrift => setup.zero_per_h += self.zero_sign() * value,
                SetupError::ToolDrift => setup.tool_per_h += value,
            }
        }
        setup.instrument_from_reference = displaced_by(&displaced).inverse();
        setup
    }
}

/// reference_from_instrument.
fn displaced_by(six: &SixErrors) -> Link {
    let turn = Mat3::identity() + six.rotation_minus_identity(Rotation::Exact);
    Pose::new(turn, six.shift_mm())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn instrument(sight: Sight) -> Instrument {
        Instrument {
            name: "probe".into(),
            kind: Kind::ProbeBall,
            sight,
            reference: Reference::Workpiece,
            tool_point_mm: Vec3::new(0.0, 0.0, -100.0),
            reference_point_mm: Vec3::new(10.0, 0.0, 0.0),
            direction: Vec3::x(),
            length_mm: 0.0,
            noise: [1e-3; 3],
            unknowns: Vec::new(),
            material: None,
            reads: Default::default(),
            assumed: Default::default(),
            drift: Default::default(),
        }
    }

    #[test]
    fn a_probe_reads_the_ball_from_its_socket() {
        // The tool 100 mm above (10 0 0), tip 3 µm too far in X: the ball is 3 µm to the left.
        let nominal = Link::shift(Vec3::new(10.0, 0.0, 100.0));
        let actual = Link::shift(Vec3::new(10.003, 0.0, 100.0));
        let view = View { nominal, actual, direction: Vec3::x(), drifted: Drifted::default() };
        let [x, y, z] = instrument(Sight::ProbeOffset).read(&view, &[]);
        assert!((x + 0.003).abs() < 1e-12 && y == 0.0 && z.abs() < 1e-12);
        assert!((instrument(Sight::Along).read(&view, &[])[0] - 0.003).abs() < 1e-12);
        assert!((instrument(Sight::Distance).read(&view, &[])[0] - 0.003).abs() < 1e-12);
    }

    /// What an unknown of the set-up does to the exact reading is what its slope says, with its sign.
    #[test]
    fn law_the_slopes_of_the_set_up_are_those_of_the_reading() {
        let turned = Rotation3::from_euler_angles(0.3, -0.4, 0.7).into_inner();
        let nominal = Pose::new(turned, Vec3::new(160.0, -40.0, 95.0));
        let direction = Vec3::new(0.36, 0.48, 0.8);
        let drifted = Drifted { along_axes: Mat3::from_diagonal_element(0.7), hours: 0.7 };
        let view = View { nominal, actual: nominal, direction, drifted };
        let errors = (0..3)
            .flat_map(|i| {
                use SetupError::{Drift, ReferencePoint, ReferenceTurn, ToolPoint, Zero};
                [ToolPoint(i), ReferencePoint(i), ReferenceTurn(i), Zero(i), Drift(i)]
            })
            .chain([SetupError::Scale, SetupError::ZeroDrift, SetupError::ToolDrift]);
        let errors: Vec<SetupError> = errors.collect();
        for sight in [Sight::ProbeOffset, Sight::Place, Sight::Distance, Sight::Along, Sight::Turn]
        {
            for error in &errors {
                let mut probe = instrument(sight);
                let name = "unknown".to_owned();
                probe.unknowns = vec![SetupUnknown { name, error: *error, prior_u: None }];
                let wrenches = probe.wrenches(&view);
                for (channel, wrench) in wrenches.iter().enumerate().take(sight.channels()) {
                    let at = |value: f64| probe.read(&view, &[value])[channel];
                    let by_reading = (at(1e-4) - at(-1e-4)) / 2e-4;
                    let slope = probe.setup_slope(*error, channel, wrench, &view);
                    let apart = (by_reading - slope).abs();
                    assert!(
                        apart < 1e-4 * (1.0 + slope.abs()),
                        "{sight:?} {error:?} {channel}: {by_reading} {slope}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_longer_bar_reads_more_by_as_much() {
        let nominal = Link::shift(Vec3::new(160.0, 0.0, 100.0));
        let view =
            View { nominal, actual: nominal, direction: Vec3::x(), drifted: Drifted::default() };
        let mut bar = instrument(Sight::Distance);
        bar.unknowns =
            vec![SetupUnknown { name: "length".into(), error: SetupError::Zero(0), prior_u: None }];
        // |P − Q| = 150 mm and 0.02 mm of the bar.
        assert!((bar.read(&view, &[0.02])[0] - 150.02).abs() < 1e-12);
    }
}
