//! The program on the actual machine: where a probe with lobes triggers on a surface that is not the
//! nominal one, as the log of the control says it.
//!
//! ```text
//!     c(s) = T(q(s), E)·(tip + o) + drift        (c(s₀) − p)·n − d = r        s = s₀ + t(u)
//!     t(u) = mean + axial·w² + lobes·ℓ³·cos(3α − phase) + tilt·ℓ·w·cos α
//! ```
//!
//! u = (ℓ cos α, ℓ sin α, w) is the direction of motion as the probe sees it.

use super::file::SurfaceStudy;
use super::points::points_of_table;
use super::program::{Pose, order};
use crate::plan::touch::LOG_HEADING;
use std::fmt::Write;
use std::path::Path;
use trueaxis_geometry::Vec3;
use trueaxis_input::sheet::{Cells, Sheet};
use trueaxis_input::{Diagnostics, Dimension, Place, Section};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, AxisKind, Command};
use trueaxis_machine::file::read_vector_mm;
use trueaxis_measure::measure::virtual_campaign::touch_noise;

/// A true point belongs to a planned one within this, mm.
const SAME_MM: f64 = 0.01;
/// The touch is found to this, mm.
const CLOSE_MM: f64 = 1e-10;
const MOST_STEPS: usize = 40;

/// The actual probe.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TrueProbe {
    /// Ball − stated tip, in the frame of the probe.
    pub offset_mm: Vec3,
    /// Mean pre-travel, mm.
    pub mean_mm: f64,
    /// More of it along the stylus, mm.
    pub axial_mm: f64,
    /// Amplitude of three lobes, mm.
    pub lobes_mm: f64,
    /// Three times the direction of the first lobe, rad.
    pub phase_rad: f64,
    /// Amplitude of the term that an inclined seat adds, mm.
    pub tilt_mm: f64,
    /// Standard deviation of one trigger, mm.
    pub noise_mm: f64,
}

impl TrueProbe {
    /// The pre-travel in a direction of motion as the probe sees it, mm.
    pub fn travel_mm(&self, direction: Vec3) -> f64 {
        let (level, rise) = (direction.x.hypot(direction.y), direction.z);
        let around = direction.y.atan2(direction.x);
        self.mean_mm
            + self.axial_mm * rise * rise
            + self.lobes_mm * level.powi(3) * (3.0 * around - self.phase_rad).cos()
            + self.tilt_mm * level * rise * around.cos()
    }
}

/// Everything that is true and that the control does not know.
#[derive(Debug, Clone)]
pub struct VirtualProbing {
    /// The machine with its true errors.
    pub machine: Machine,
    /// Whether the errors are drawn within the uncertainties of the machine file.
    pub drawn: bool,
    /// The probe.
    pub probe: TrueProbe,
    /// Points of the surface with the deviation along their normals, mm.
    pub surface: Vec<(Vec3, f64)>,
    /// By how much the tip rises from the first to the last hit, in the frame of the tool.
    pub drift_mm: Vec3,
    /// Of the random numbers.
    pub seed: u64,
}

/// Reads `[virtual]` of a study.
pub(super) fn read_virtual(
    section: &Section<'_>,
    folder: &Path,
    machine: &Machine,
) -> Option<VirtualProbing> {
    let mut found = Diagnostics::new();
    let own = section.text("machine").map(|name| {
        let (machine, problems) = Machine::read(section.files(), &folder.join(name));
        if problems.has_errors() {
            found.append(problems);
        }
        machine
    });
    let drawn = section.get("draw").map_or(Some(false), |i| i.flag());
    let seed = section.get("seed").map_or(Some(1), |i| i.count());
    let drift = section.get("drift").map(|i| read_vector_mm(&i));
    let surface = section.text("surface").map(|name| {
        let path = folder.join(name);
        let text = section.files().text(&path, "a table of the true surface (CSV)", &mut found)?;
        read_true(&path.display().to_string(), &text, &mut found)
    });
    let length = |key: &str| section.quantity(key, Dimension::Length).unwrap_or(0.0);
    let offset = section.get("offset").map(|i| read_vector_mm(&i));
    let mut probe = TrueProbe {
        mean_mm: length("pretravel"),
        axial_mm: length("axial"),
        lobes_mm: length("lobes"),
        tilt_mm: length("tilt"),
        noise_mm: noise(section),
        phase_rad: section.quantity("phase", Dimension::Angle).unwrap_or(0.0),
        ..TrueProbe::default()
    };
    section.take_over(found);
    let or_zero = |stated: Option<Option<Vec3>>| stated.unwrap_or(Some(Vec3::zeros()));
    probe.offset_mm = or_zero(offset)?;
    let machine = own.unwrap_or_else(|| Some(machine.clone()))?;
    let (drawn, seed) = (drawn?, seed? as u64);
    let (surface, drift_mm) = (surface.unwrap_or_else(|| Some(Vec::new()))?, or_zero(drift)?);
    Some(VirtualProbing { machine, drawn, probe, surface, drift_mm, seed })
}

/// The standard deviation of a hit, mm.
fn noise(section: &Section<'_>) -> f64 {
    let Some(item) = section.get("noise") else { return 0.0 };
    let mm = item.quantity(Dimension::Length).unwrap_or(0.0);
    if mm < 0.0 {
        let message = "`noise` is a standard deviation, which is not negative".to_owned();
        item.error("bad-size", message, "such as noise = \"0.5 um\"");
    }
    mm
}

fn read_true(file: &str, text: &str, problems: &mut Diagnostics) -> Option<Vec<(Vec3, f64)>> {
    let points = points_of_table(file, text, problems)?;
    let cells =
        |name: &str| if name.starts_with("deviation_") { Cells::Numbers } else { Cells::Unused };
    let sheet = Sheet::parse(file, text, cells, problems)?;
    let Some(column) = sheet.about("deviation") else {
        let message = "the table has no column `deviation_um`".to_owned();
        let hint = "the true surface along the normals, positive where there is more material";
        problems.error("missing-column", sheet.headings_place(), message, hint);
        return None;
    };
    let deviations = sheet.inner(column, Dimension::Length, problems)?;
    Some(points.iter().map(|p| p.point_mm).zip(deviations).collect())
}

/// The log of a program on the true machine; it ends where the probe touches nothing.
pub fn virtual_log(
    study: &SurfaceStudy,
    real: &VirtualProbing,
    poses: &[Pose],
    problems: &mut Diagnostics,
) -> Option<String> {
    let machine = real.machine.clone().with_tip(study.machine.tip_mm());
    let mut random = touch_noise(real.seed);
    let factors: Vec<f64> = match real.drawn {
        true => machine.uncertain_quantities().iter().map(|_| random()).collect(),
        false => Vec::new(),
    };
    let touch = Touch { study, real, machine: &machine, factors: &factors };
    let order = order(study, poses.len());
    let mut text = format!("# virtual: {} on {}\n{LOG_HEADING}\n", study.name, machine.name());
    for (i, point) in order.iter().enumerate() {
        let pose = &poses[*point];
        let deviation_mm = touch.deviation_mm(pose, problems)?;
        let part = i as f64 / (order.len() - 1).max(1) as f64;
        let Some(command) = touch.trigger(pose, deviation_mm, part, &mut random) else {
            let message =
                format!("hit {} touches nothing: the log ends there, as the program does", i + 1);
            let hint = "a larger `beyond`, or a smaller deviation of the true surface";
            problems.warn("lost-hits", Place::whole(&study.file), message, hint);
            return Some(text);
        };
        // Writing to a String cannot fail.
        let _ = write!(text, "H{} K{} T{}", i + 1, point + 1, study.tool);
        for (axis, q) in machine.axes().iter().zip(&command) {
            let _ = match axis.kind {
                AxisKind::Linear => write!(text, " {}{:.4}", axis.name, q + 0.0),
                AxisKind::Rotary => write!(text, " {}{:.5}", axis.name, q.to_degrees() + 0.0),
            };
        }
        text.push('\n');
    }
    let _ = writeln!(text, "END {}", order.len());
    Some(text)
}

struct Touch<'a> {
    study: &'a SurfaceStudy,
    real: &'a VirtualProbing,
    machine: &'a Machine,
    factors: &'a [f64],
}

impl Touch<'_> {
    /// Of the true surface at a planned point.
    fn deviation_mm(&self, pose: &Pose, problems: &mut Diagnostics) -> Option<f64> {
        let at = pose.point.point_mm;
        if self.real.surface.is_empty() {
            return Some(0.0);
        }
        let near = |p: &&(Vec3, f64)| (p.0 - at).norm() <= SAME_MM;
        let found = self.real.surface.iter().find(near).map(|p| p.1).filter(|d| d.is_finite());
        if found.is_none() {
            let message = format!(
                "the table of the true surface says nothing of ({:.3}, {:.3}, {:.3})",
                at.x, at.y, at.z
            );
            let hint = "one row for every planned point, within 10 µm of it";
            problems.error("missing-row", Place::whole(&self.study.file), message, hint);
        }
        found
    }

    /// Where the axes stand when the probe triggers; none: the end of the way comes first.
    fn trigger(
        &self,
        pose: &Pose,
        deviation_mm: f64,
        part: f64,
        random: &mut impl FnMut() -> f64,
    ) -> Option<Command> {
        let way_mm = self.study.stand_off_mm + self.study.beyond_mm;
        let mut approach = Approach::default();
        for (side, (to, from)) in approach.iter_mut().zip(pose.beyond.iter().zip(pose.before)) {
            *side = if (to - from).abs() < 1e-9 { 0.0 } else { (to - from).signum() };
        }
        let at = |s: f64| {
            let mut command = pose.before;
            for (i, q) in command.iter_mut().enumerate() {
                *q += (pose.beyond[i] - pose.before[i]) * s / way_mm;
            }
            command
        };
        let centre = |s: f64| {
            let command = at(s);
            let mut errors = self.machine.errors_at(&command, &approach).ok()?;
            if !self.factors.is_empty() {
                let quantities = self.machine.uncertain_quantities();
                let known = self.machine.uncertainties_at(&command, &quantities);
                errors = known.displaced(&errors, self.factors);
            }
            let tool = self.machine.pose(&command, &errors);
            let ball =
                self.machine.tip_mm() + self.real.probe.offset_mm + self.real.drift_mm * part;
            Some((tool.linear() * ball + tool.shift_mm(), *tool.linear()))
        };
        let gap = |s: f64| {
            let off = centre(s)?.0 - pose.point.point_mm;
            Some(off.dot(&pose.point.normal) - deviation_mm - self.study.ball_radius_mm)
        };
        let (mut s, mut slope) = (self.study.stand_off_mm, -1.0);
        let mut g = gap(s)?;
        for _ in 0..MOST_STEPS {
            if g.abs() < CLOSE_MM {
                break;
            }
            let next = s - g / slope;
            let there = gap(next)?;
            if next != s && there != g {
                slope = (there - g) / (next - s);
            }
            (s, g) = (next, there);
        }
        let tool = centre(s)?.1;
        let ahead = (centre(s + 0.01)?.0 - centre(s)?.0) / 0.01;
        let direction = (tool.transpose() * ahead).try_normalize(1e-9)?;
        s += (self.real.probe.travel_mm(direction) + self.real.probe.noise_mm * random())
            / ahead.norm();
        (g.abs() < 1e-6 && (0.0..way_mm).contains(&s)).then(|| at(s))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pre_travel_follows_the_direction() {
        let probe = TrueProbe {
            mean_mm: 0.015,
            axial_mm: 0.004,
            lobes_mm: 0.010,
            phase_rad: 60_f64.to_radians(),
            ..TrueProbe::default()
        };
        // Straight down there are no lobes; across, the first one is at 20°.
        assert!((probe.travel_mm(-Vec3::z()) - 0.019).abs() < 1e-15);
        let lobe = Vec3::new(20_f64.to_radians().cos(), 20_f64.to_radians().sin(), 0.0);
        assert!((probe.travel_mm(lobe) - 0.025).abs() < 1e-15);
        assert!((probe.travel_mm(-lobe) - 0.005).abs() < 1e-15);
    }
}
