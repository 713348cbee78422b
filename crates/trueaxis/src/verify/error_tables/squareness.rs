//! The squareness of two axes from a circle: what the machine with its new tables lacks of it.

use super::{CircleReadings, TableStudy};
use crate::verify::conditions::Circle;
use crate::verify::iso230_4::{self, Causes, Circular, Sense};
use std::f64::consts::TAU;
use std::fmt::Write as _;
use trueaxis_condition::ball_bar::location_error;
use trueaxis_condition::virtual_circle::VirtualCircle;
use trueaxis_input::{Diagnostics, Place};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Command;
use trueaxis_machine::errors::ErrorName;

/// Points of a virtual circle in each direction.
const POINTS: u32 = 360;
/// A squareness for the derivative, rad.
const STEP_RAD: f64 = 1e-5;
/// A centre or radius that differs by more than this share of the radius is that of another circle. Unit: 1.
const WRONG_SHARE: f64 = 0.02;
/// A circle with a wider gap does not determine the squareness well, rad.
const WIDEST_GAP_RAD: f64 = 0.5;
/// No two axes are so far out of square, rad.
const IMPOSSIBLE_RAD: f64 = 0.02;
/// Further apart than this many standard uncertainties two instruments do not agree.
const APART: f64 = 3.0;

/// A squareness as a location error.
#[derive(Debug, Clone)]
pub struct Squareness {
    /// The location error that states it.
    pub name: ErrorName,
    /// Its value, rad.
    pub value_rad: f64,
    /// Its standard uncertainty, rad.
    pub u_rad: f64,
    /// The angle by which the axes are closer than 90°, as ISO 230-4 reads it, rad.
    pub read_rad: f64,
    /// The same that the machine with its new tables would show before, rad.
    pub before_rad: f64,
    /// The names of the two axes.
    pub axes: [String; 2],
    /// The first axis longer than the second, over the diameter: read − what the tables say, mm.
    pub scale_difference_mm: f64,
}

/// The squarenesses of all circles; `machine` has the new tables.
///
/// ```text
///     E = E_old + (s_read − s(E_old)) / (∂s/∂E)        u = 2 √(2 u_r²/n + u_c²)/R     docs/model.md eq. 184
/// ```
///
/// s(E) is what ISO 230-4 reads on the virtual circle of the machine: slopes that the tables contain, and
/// every other location error, count in it. u_r the residual of the n points, u_c what does not average out.
pub fn squarenesses(
    study: &TableStudy,
    machine: &Machine,
    problems: &mut Diagnostics,
) -> Vec<Squareness> {
    let mut machine = machine.clone();
    let mut found: Vec<Squareness> = Vec::new();
    for circle in &study.circles {
        let Some(one) = squareness(&machine, circle, problems) else { continue };
        if found.iter().any(|other| other.name == one.name) {
            let message = format!("{} was determined from another circle already", one.name);
            let hint = "one circle for each plane";
            problems.error("circle-twice", Place::whole(&circle.file), message, hint);
            continue;
        }
        if let Some(changed) = machine.clone().with_location(one.name, one.value_rad) {
            machine = changed;
        }
        found.push(one);
    }
    found
}

fn squareness(
    machine: &Machine,
    circle: &CircleReadings,
    problems: &mut Diagnostics,
) -> Option<Squareness> {
    let place = || Place::whole(&circle.file);
    let nominal = nominal(circle);
    let read = iso230_4::evaluate(&circle.file, &circle.text, nominal, problems)?;
    if !is_as_stated(circle, &read, &place(), problems) {
        return None;
    }
    let Some(causes) = read.causes.clone() else {
        let message = "the causes of the deviations cannot be separated".to_owned();
        problems.error("no-squareness", place(), message, "points all around, in both directions");
        return None;
    };
    let Some(read_rad) = causes.squareness_rad else {
        let message =
            "squareness and servo mismatch cannot be separated in one direction".to_owned();
        problems.error("no-squareness", place(), message, "run the circle cw and ccw");
        return None;
    };
    let axes = axes_of(machine, &read, &place(), problems)?;
    let Some(name) = location_error(machine, axes) else {
        let message = "no location error of the machine states this squareness".to_owned();
        let hint = "two linear axes along X, Y, Z of the machine";
        problems.error("no-squareness", place(), message, hint);
        return None;
    };
    let virtual_circle = Virtual { circle, read: &read, axes };
    let before = virtual_circle.causes(machine, problems)?;
    let index = machine.error_index(name)?;
    let old = machine.errors_at(&virtual_circle.centre(), &Default::default()).ok()?.get(index);
    let moved = machine.clone().with_location(name, old + STEP_RAD)?;
    let after = virtual_circle.causes(&moved, problems)?;
    let (before_rad, after_rad) = (before.squareness_rad?, after.squareness_rad?);
    let slope = (after_rad - before_rad) / STEP_RAD;
    if slope.abs() < 0.5 {
        let message = format!("{name} does not change the squareness of this circle");
        problems.error("no-squareness", place(), message, "is the plane right?");
        return None;
    }
    let points: usize = read.paths.iter().map(|p| p.path.points_mm.len()).sum();
    let u_fit = causes.residual_rms_mm * (2.0 / points.max(1) as f64).sqrt();
    let u_rad = 2.0 * u_fit.hypot(circle.u_mm) / circle.radius_mm;
    if read_rad.abs() > IMPOSSIBLE_RAD {
        let message = format!("a squareness of {:.0} µrad cannot be", read_rad * 1e6);
        problems.error(
            "impossible-error",
            place(),
            message,
            "are columns, units, centre and radius right?",
        );
        return None;
    }
    let found = Squareness {
        name,
        value_rad: old + (read_rad - before_rad) / slope,
        u_rad,
        read_rad,
        before_rad,
        axes: read.axes.clone(),
        scale_difference_mm: causes.scale_mismatch_mm - before.scale_mismatch_mm,
    };
    compare_scales(&found, u_fit.hypot(circle.u_mm), &place(), problems);
    Some(found)
}

/// Whether the points lie about the stated circle, all around: otherwise the squareness is that of another circle.
fn is_as_stated(
    circle: &CircleReadings,
    read: &Circular,
    place: &Place,
    problems: &mut Diagnostics,
) -> bool {
    let mut fault = None;
    for path in &read.paths {
        let [x, y] = path.circle.center_mm;
        let [cx, cy] = circle.centre_mm;
        let radius_mm = path.circle.radius_mm;
        let gap = widest_gap_rad(&path.path.points_mm, [x, y]);
        if (radius_mm - circle.radius_mm).abs() > WRONG_SHARE * circle.radius_mm {
            fault = Some(format!(
                "the points have a radius of {radius_mm:.3} mm, stated are {} mm",
                circle.radius_mm
            ));
        } else if (x - cx).hypot(y - cy) > WRONG_SHARE * circle.radius_mm {
            fault = Some(format!(
                "the points lie about {x:.3}, {y:.3} mm, the stated centre is {cx}, {cy} mm"
            ));
        } else if gap > WIDEST_GAP_RAD {
            fault = Some(format!("{:.0} deg of the circle have no points", gap.to_degrees()));
        }
    }
    if let Some(message) = &fault {
        let hint =
            "centre and radius as commanded, the columns x, y, z in this order, points all around";
        problems.error("no-squareness", place.clone(), message.clone(), hint);
    }
    fault.is_none()
}

fn widest_gap_rad(points_mm: &[[f64; 2]], [x, y]: [f64; 2]) -> f64 {
    let mut angles: Vec<f64> = points_mm.iter().map(|p| (p[1] - y).atan2(p[0] - x)).collect();
    angles.sort_by(f64::total_cmp);
    let Some((first, last)) = angles.first().zip(angles.last()) else { return TAU };
    let around = first + TAU - last;
    angles.windows(2).map(|w| w[1] - w[0]).fold(around, f64::max)
}

/// A ball-bar and a laser see the same axes: where they differ, one of them was given a wrong temperature or material.
fn compare_scales(found: &Squareness, u_mm: f64, place: &Place, problems: &mut Diagnostics) {
    let limit_mm = APART * 4.0 * u_mm + 1e-3;
    if found.scale_difference_mm.abs() > limit_mm {
        let [first, second] = &found.axes;
        let message = format!(
            "{first} against {second} over the diameter: the circle shows {:+.1} µm more than the tables",
            found.scale_difference_mm * 1e3
        );
        let hint =
            "were temperature and material of the laser right, and was all read on the same day?";
        problems.warn("scales-differ", place.clone(), message, hint);
    }
}

fn axes_of(
    machine: &Machine,
    read: &Circular,
    place: &Place,
    problems: &mut Diagnostics,
) -> Option<[usize; 2]> {
    let find =
        |name: &String| trueaxis_machine::describe::axis_index(machine, &name.to_uppercase());
    let [first, second] = &read.axes;
    let found = find(first).zip(find(second));
    if found.is_none() {
        let message = format!("the machine has no axes `{first}` and `{second}`");
        problems.error(
            "unknown-axis",
            place.clone(),
            message,
            "head the columns by the axes: x_mm, y_mm",
        );
    }
    found.map(|(a, b)| [a, b])
}

fn nominal(circle: &CircleReadings) -> Circle {
    let (centre_mm, radius_mm) = (Some(circle.centre_mm), Some(circle.radius_mm));
    Circle { centre_mm, radius_mm, ..Circle::default() }
}

/// The circle on a virtual machine.
struct Virtual<'a> {
    circle: &'a CircleReadings,
    read: &'a Circular,
    axes: [usize; 2],
}

impl Virtual<'_> {
    fn centre(&self) -> Command {
        let mut command = self.circle.at;
        for (axis, c) in self.axes.iter().zip(self.circle.centre_mm) {
            command[*axis] = c;
        }
        command
    }

    /// What ISO 230-4 finds on a machine.
    fn causes(&self, machine: &Machine, problems: &mut Diagnostics) -> Option<Causes> {
        let text = match self.points(machine) {
            Ok(text) => text,
            Err(reason) => {
                let hint = "centre, radius, at: the circle lies within the error tables";
                problems.error("outside-table", Place::whole(&self.circle.file), reason, hint);
                return None;
            }
        };
        let nominal = nominal(self.circle);
        let read = iso230_4::evaluate("virtual circle", &text, nominal, &mut Diagnostics::new());
        let causes = read.and_then(|circle| circle.causes);
        if causes.is_none() {
            let message = "the virtual circle of this machine cannot be evaluated".to_owned();
            let hint = "centre and radius: a whole circle within the travel";
            problems.error("no-squareness", Place::whole(&self.circle.file), message, hint);
        }
        causes
    }

    fn points(&self, machine: &Machine) -> Result<String, String> {
        let [first, second] = self.read.axes.each_ref().map(|a| a.to_lowercase());
        let (centre_mm, radius_mm) = (self.circle.centre_mm, self.circle.radius_mm);
        let (centre, ball_mm) = (self.centre(), self.circle.ball_mm);
        let circle = VirtualCircle { axes: self.axes, centre, radius_mm, ball_mm };
        let mut points = Vec::new();
        for sense in [Sense::CounterClockwise, Sense::Clockwise] {
            // Half a step from the reversals, which are left out.
            let angle = |i: u32| sense.sign() * (f64::from(i) + 0.5) * TAU / f64::from(POINTS);
            points.extend((0..POINTS).map(|i| (angle(i), sense)));
        }
        let mut text = format!("{first}_mm,{second}_mm,direction\n");
        for ((angle, sense), more) in points.iter().zip(circle.read(machine, &points)?) {
            let r = radius_mm + more;
            let [x, y] = [centre_mm[0] + r * angle.cos(), centre_mm[1] + r * angle.sin()];
            // Writing into a text cannot fail.
            let _ = writeln!(text, "{x:.9},{y:.9},{}", sense.word());
        }
        Ok(text)
    }
}
