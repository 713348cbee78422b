//! The pictures of a prediction.

use super::{decisive, ranked, relief};
use crate::predict::{Prediction, SectionResult, Share, Study};
use trueaxis_machine::describe::{shown, unit};
use trueaxis_machine::errors::ErrorName;
use trueaxis_part::Shape;
use trueaxis_part::fit::circle::Zone;
use trueaxis_report::plots::{
    Bar, COLOURS, ConeMap, Curve, FittedCircle, Labels, Profile, bars, cone_map, curves, polar,
};
use trueaxis_report::{DrawingError, Figure};

/// Bars per index.
const BARS: usize = 10;

fn um(mm: f64) -> String {
    format!("{:.2}", mm * 1e3)
}

/// The error along the azimuth, one line for each position.
pub(super) fn along_azimuth(prediction: &Prediction) -> Figure<'_> {
    Figure::new("", || {
        let line = |(i, result): (usize, &SectionResult)| {
            let section = &result.section;
            let points = section.azimuth_rad.iter().zip(&section.deviation_mm);
            Curve {
                label: format!("position {}, z = {:.0} mm", i + 1, section.z_mm),
                points: points.map(|(a, e)| (a.to_degrees(), e * 1e3)).collect(),
            }
        };
        let lines: Vec<Curve> = prediction.sections.iter().enumerate().map(line).collect();
        let labels = Labels { x: "azimuth, deg", y: "E, µm (positive: material left)" };
        curves((1000, 340), &labels, &lines)
    })
}

/// Each section with its fitted circles, magnified.
pub(super) fn sections(prediction: &Prediction) -> impl Iterator<Item = Figure<'_>> {
    prediction.sections.iter().enumerate().map(|(i, result)| {
        let caption = format!(
            "Position {}, z = {:.0} mm; nominal radius {:.3} mm",
            i + 1,
            result.section.z_mm,
            result.section.radius_mm
        );
        Figure::new(caption, || section(result))
    })
}

fn section(result: &SectionResult) -> Result<String, DrawingError> {
    let section = &result.section;
    let points: Vec<(f64, f64)> = section
        .azimuth_rad
        .iter()
        .zip(&section.profile_mm)
        .map(|(azimuth, p)| (*azimuth, p[0].hypot(p[1]) - section.radius_mm))
        .collect();
    let c = &section.circles;
    let zone = |label: &str, zone: &Zone, radius: f64, dashed| FittedCircle {
        label: label.to_owned(),
        centre_mm: zone.center_mm,
        excess_mm: radius - section.radius_mm,
        dashed,
        colour: if dashed { COLOURS[1] } else { COLOURS[2] },
    };
    let width = um(c.mzc.width_mm());
    let thin = |name: &str, zone: &Zone, radius, colour| FittedCircle {
        label: format!("{name}, {} µm", um(zone.width_mm())),
        centre_mm: zone.center_mm,
        excess_mm: radius - section.radius_mm,
        dashed: true,
        colour,
    };
    let circles = [
        thin("maximum inscribed", &c.mic, c.mic.inner_mm, COLOURS[3]),
        thin("minimum circumscribed", &c.mcc, c.mcc.outer_mm, COLOURS[5]),
        zone(&format!("least squares, {} µm", um(c.lsc.width_mm())), &c.lsc, c.lsc.radius_mm, true),
        zone("", &c.mzc, c.mzc.inner_mm, false),
        zone(&format!("minimum zone, {width} µm"), &c.mzc, c.mzc.outer_mm, false),
    ];
    polar(460, &Profile { points: &points, circles: &circles })
}

/// The error on the unrolled cone.
pub(super) fn cone<'a>(study: &'a Study, prediction: &'a Prediction) -> Option<Figure<'a>> {
    let Shape::Cone(cone) = &study.test_piece.shape;
    let first = prediction.sections.first()?;
    Some(Figure::new("", move || {
        let heights: Vec<f64> = prediction.sections.iter().map(|s| s.section.height_mm).collect();
        let errors: Vec<Vec<f64>> =
            prediction.sections.iter().map(|s| s.section.deviation_mm.clone()).collect();
        let map = ConeMap {
            half_angle_rad: cone.size().half_angle_rad,
            base_radius_mm: 0.5 * cone.size().base_diameter_mm,
            azimuths_rad: &first.section.azimuth_rad,
            heights_mm: &heights,
            error_mm: &errors,
        };
        cone_map((1000, 430), &map)
    }))
}

/// The motion of each axis along the azimuth.
pub(super) fn motions<'a>(
    study: &'a Study,
    prediction: &'a Prediction,
) -> impl Iterator<Item = Figure<'a>> {
    study.machine.axes().iter().enumerate().map(move |(i, axis)| {
        Figure::new("", move || {
            let azimuths = prediction.sections.first().map_or(&[][..], |s| &s.section.azimuth_rad);
            let commands = azimuths.iter().zip(&prediction.commands);
            let points = commands.map(|(a, c)| (a.to_degrees(), shown(axis, c[i]))).collect();
            let y = format!("{}, {}", axis.name, unit(axis));
            let line = Curve { label: axis.name.to_string(), points };
            curves((480, 260), &Labels { x: "azimuth, deg", y: &y }, &[line])
        })
    })
}

/// The errors that contribute most to each decisive index.
pub(super) fn contributions(prediction: &Prediction) -> impl Iterator<Item = Figure<'_>> {
    decisive(prediction).map(move |(i, index)| {
        Figure::new(index.name.title(), move || {
            let bar = |share: &Share<ErrorName>| Bar {
                label: share.of.to_string(),
                alone_mm: share.alone_mm[i],
                relief_mm: relief(prediction, i, share),
            };
            let shares = ranked(prediction, i, &prediction.budget.errors, BARS);
            bars(500, &shares.into_iter().map(bar).collect::<Vec<_>>())
        })
    })
}
