//! Readings as arrows: where the linear axes stand, and how far the model is off there.

use super::identification::IdentificationReport;
use std::fmt::Write as _;
use trueaxis_geometry::{Mat3, Vec3};
use trueaxis_machine::axis::{AxisKind, iso_841_direction};
use trueaxis_machine::errors::ErrorValues;
use trueaxis_machine::twist::Reference;

/// Most arrows of a picture; of more readings every n-th is shown.
const MOST_ARROWS: usize = 400;

/// A reading as an arrow, mm, in the frame of the machine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arrow {
    /// Where the linear axes stand.
    pub at_mm: Vec3,
    /// The residual without the unknown errors, along what the instrument reads.
    pub before_mm: Vec3,
    /// The residual after identification.
    pub after_mm: Vec3,
}

impl IdentificationReport<'_> {
    /// The residuals along what the instruments see; readings of angles have no arrow.
    pub fn arrows(&self) -> Vec<Arrow> {
        let count = self.records.readings.len();
        let step = count.div_ceil(MOST_ARROWS).max(1);
        (0..count).step_by(step).filter_map(|i| self.arrow(i)).collect()
    }

    fn arrow(&self, i: usize) -> Option<Arrow> {
        let (design, readings) = (&self.found.design, &self.records.readings);
        let none = ErrorValues::default();
        let instrument = &design.instruments[readings.instruments[i] as usize];
        if instrument.sight.is_angle() {
            return None;
        }
        let (machine, command) = (&design.machine, &readings.commands[i]);
        let view = instrument.view(machine, command, &none, readings.directions[i]);
        let wrenches = instrument.wrenches(&view);
        let vector = |r: &[f64; 3]| {
            (0..instrument.sight.channels()).map(|c| wrenches[c].force * r[c]).sum::<Vec3>()
        };
        // What the machine's axes do: in the frame of the machine.
        let turn = match instrument.reference {
            Reference::Bed => Mat3::identity(),
            Reference::Workpiece => {
                machine.tool_on_bed(command, &none).linear() * view.nominal.linear().transpose()
            }
        };
        let axes = machine.axes().iter().zip(command);
        let linear = axes.filter(|(axis, _)| axis.kind == AxisKind::Linear);
        let residuals = &self.found.residuals;
        Some(Arrow {
            at_mm: linear.map(|(axis, q)| iso_841_direction(axis.name) * *q).sum(),
            before_mm: turn * vector(&residuals.before[i]),
            after_mm: turn * vector(&residuals.after[i]),
        })
    }
}

/// The longest arrow, mm.
pub(super) fn longest(arrows: &[Arrow], of: fn(&Arrow) -> Vec3) -> f64 {
    arrows.iter().map(of).map(|v| v.norm()).fold(0.0, f64::max)
}

/// How many times arrows of this length are enlarged.
pub(super) fn magnification(arrows: &[Arrow], longest_mm: f64) -> f64 {
    round_down(0.12 * span(arrows) / longest_mm.max(1e-9))
}

/// 1, 2 or 5 times a power of ten.
fn round_down(value: f64) -> f64 {
    let power = 10f64.powf(value.max(1e-12).log10().floor());
    [5.0, 2.0, 1.0].iter().map(|s| s * power).find(|v| *v <= value * 1.0001).unwrap_or(power)
}

/// The least and the greatest position in one direction.
fn range(arrows: &[Arrow], i: usize) -> (f64, f64) {
    let all = arrows.iter().map(|a| a.at_mm[i]);
    all.fold((f64::MAX, f64::MIN), |(l, h), v| (l.min(v), h.max(v)))
}

fn span(arrows: &[Arrow]) -> f64 {
    (0..3).map(|i| range(arrows, i)).map(|(low, high)| high - low).fold(1.0, f64::max)
}

/// One view of the arrows as SVG: two of the three directions with their labels.
pub(super) fn arrow_picture(
    arrows: &[Arrow],
    of: fn(&Arrow) -> Vec3,
    by: f64,
    (u, v, right, up): (usize, usize, &str, &str),
) -> String {
    let side = 330.0;
    let room = 54.0;
    let span = 1.35 * span(arrows);
    let middle = |i: usize| {
        let (low, high) = range(arrows, i);
        0.5 * (low + high)
    };
    let (u0, v0) = (middle(u), middle(v));
    let pixel = (side - room) / span;
    let x = |q: f64| room + 0.5 * (side - room) + (q - u0) * pixel;
    let y = |q: f64| 0.5 * (side - room) - (q - v0) * pixel;
    let mut svg = format!("<svg viewBox=\"0 0 {side} {side}\" role=\"img\">");
    let end = side - room;
    // Writing to a String cannot fail.
    let _ = write!(
        svg,
        "<rect x=\"{room}\" y=\"0\" width=\"{end}\" height=\"{end}\" fill=\"none\" stroke=\"#c8ced4\"/>\
         <text x=\"{:.0}\" y=\"{:.0}\" font-size=\"12\" text-anchor=\"middle\">{right}</text>\
         <text x=\"12\" y=\"{:.0}\" font-size=\"12\" text-anchor=\"middle\" \
         transform=\"rotate(-90 12 {:.0})\">{up}</text>",
        room + 0.5 * end,
        side - 8.0,
        0.5 * end,
        0.5 * end
    );
    for part in [-0.4, 0.0, 0.4] {
        let (a, b) = (u0 + part * span, v0 + part * span);
        let _ = write!(
            svg,
            "<text x=\"{:.1}\" y=\"{:.0}\" font-size=\"11\" text-anchor=\"middle\">{a:.0}</text>\
             <text x=\"{:.0}\" y=\"{:.1}\" font-size=\"11\" text-anchor=\"end\">{b:.0}</text>",
            x(a),
            end + 15.0,
            room - 4.0,
            y(b) + 4.0
        );
    }
    for arrow in arrows {
        let to = arrow.at_mm + of(arrow) * by;
        let _ = write!(
            svg,
            "<path d=\"M{:.1} {:.1}L{:.1} {:.1}\" stroke=\"#d55e00\" stroke-width=\"1.2\"/>\
             <circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"1.6\" fill=\"#0072b2\"/>",
            x(arrow.at_mm[u]),
            y(arrow.at_mm[v]),
            x(to[u]),
            y(to[v]),
            x(arrow.at_mm[u]),
            y(arrow.at_mm[v])
        );
    }
    svg + "</svg>"
}
