//! A laser before and after compensation, as text and on a page.

use crate::verify::before_after::{AppliedValues, BeforeAfter, Curve};
use trueaxis_predict::predict::holes::Compensation;
use trueaxis_report::numbers::fixed;
use trueaxis_report::{Band, Picture, Report, Scatter, Section, Table};
use trueaxis_standards::iso230_2::Quantity;

/// What a report of lasers before and after compensation shows.
pub struct BeforeAfterReport<'a> {
    /// What was measured.
    pub study: &'a BeforeAfter,
    /// The readings, axis by axis.
    pub curves: &'a [Curve],
    /// The files that were written.
    pub files: &'a [String],
}

/// The figures of the standard that a table shows.
const SHOWN: [Quantity; 4] = [Quantity::E, Quantity::A, Quantity::R, Quantity::B];

impl BeforeAfterReport<'_> {
    /// The name of the axis of a curve.
    pub(super) fn axis(&self, curve: &Curve) -> String {
        self.study.campaign.machine.axes()[curve.axis].name.to_string()
    }

    /// The laser of a curve, and what it is set to.
    pub(super) fn laser(&self, curve: &Curve) -> &str {
        &self.study.campaign.instruments[curve.instrument].name
    }

    /// The path of a curve.
    pub(super) fn path(&self, curve: &Curve) -> &str {
        &self.study.real.paths[curve.path].name
    }

    /// The axes, in the order of the curves.
    fn axes(&self) -> Vec<usize> {
        let mut axes: Vec<usize> = self.curves.iter().map(|c| c.axis).collect();
        axes.dedup();
        axes
    }

    fn lines(&self) -> Vec<String> {
        let study = self.study;
        let truth = match &study.real.truth.machine_path {
            Some(_) => format!("measured on {} of [truth]", study.real.truth.machine.name()),
            None => format!("measured on {}", study.campaign.machine.name()),
        };
        let added = match &study.values {
            AppliedValues::Values => format!(
                "added to the commands: the values of the machine file in increments of {} µm",
                (study.increment_mm * 1e6).round() / 1e3
            ),
            AppliedValues::Tables(_) => {
                "added to the commands: the tables of the control, as it reads them".to_owned()
            }
        };
        let mut lines =
            vec![format!("{truth}, seed {}: virtual readings", study.real.truth.seed), added];
        for instrument in &study.campaign.instruments {
            let text = match &instrument.material {
                None => "reads the machine alone".to_owned(),
                Some(material) => format!(
                    "set to a material of {:.1} µm/(m·K) at {:.1} °C ({:.1} ± {:.1} µm/m, k = 2): reads \
                     machine − workpiece",
                    material.expansion_per_k.value * 1e6,
                    material.celsius.value,
                    material.share() * 1e6,
                    2.0 * material.u_share() * 1e6
                ),
            };
            lines.push(format!("{}: {text}", instrument.name));
        }
        lines
    }
}

/// What was compensated, in words.
pub(super) fn compensated(compensation: Compensation) -> &'static str {
    match compensation {
        Compensation::None => "none",
        Compensation::Machine => "machine",
        Compensation::Comprehensive => "machine − workpiece",
    }
}

/// The tables and pictures, axis by axis.
pub fn before_after_report<'a>(shown: &BeforeAfterReport<'_>) -> Report<'a> {
    let mut report = Report::new(&shown.study.campaign.name);
    report.lines = shown.lines();
    for axis in shown.axes() {
        report = report.section(axis_section(shown, axis));
    }
    report
        .section(Section::new("Written").on_terminal().list(shown.files.iter().cloned()))
        .sections(shown.axes().into_iter().map(|axis| Section::from(picture(shown, axis))))
}

fn axis_section<'a>(shown: &BeforeAfterReport<'_>, axis: usize) -> Section<'a> {
    let name = shown.study.campaign.machine.axes()[axis].name;
    let of_axis = || shown.curves.iter().filter(|c| c.axis == axis);
    let um = |mm: f64| fixed(mm * 1e3, 1);
    let rows = of_axis().map(|curve| {
        let mut row = vec![
            shown.laser(curve).to_owned(),
            compensated(curve.compensation).to_owned(),
            um(curve.largest.deviation_mm),
            um(2.0 * curve.largest.u_mm),
            fixed(curve.largest.target_mm, 0),
            curve.file_u_mm.map_or("–".to_owned(), |u| um(2.0 * u)),
        ];
        row.extend(SHOWN.map(|q| curve.result.value(q).map_or("–".to_owned(), um)));
        row
    });
    let headings =
        ["laser", "compensated", "largest", "U", "at, mm", "U of the file", "E", "A", "R", "B"];
    let note = "all in µm, U with k = 2; largest: the mean of the runs that is farthest from 0; U: of this \
                reading (scatter, expansion and temperature of the material); U of the file: of the error that the \
                machine file states there, which remains unknown after compensation; E A R B: ISO 230-2";
    let targets = of_axis().map(|c| c.measured.targets.len()).max().unwrap_or(0);
    Section::new(format!("Axis {name}: {targets} targets"))
        .table(Table::new(headings).rows(rows).note(note).most_on_terminal(usize::MAX))
}

/// All readings of an axis over its positions.
fn picture(shown: &BeforeAfterReport<'_>, axis: usize) -> Picture {
    let of_axis = shown.curves.iter().filter(|c| c.axis == axis);
    let bands = of_axis.enumerate().map(|(colour, curve)| {
        let at = |p: &trueaxis_standards::iso230_2::Position| {
            let mean = p.mean().or(p.up.or(p.down).map(|side| side.mean));
            mean.map(|mean| (p.target, mean * 1e3, 0.0))
        };
        Band {
            label: format!("{}, {}", shown.laser(curve), compensated(curve.compensation)),
            colour,
            line: curve.result.positions.iter().filter_map(at).collect(),
            points: Vec::new(),
        }
    });
    let name = shown.study.campaign.machine.axes()[axis].name;
    Picture::Scatter(Scatter {
        title: format!("{name}: readings before and after compensation"),
        note: "Laser, and what was compensated; mean of both directions.".to_owned(),
        x: format!("{name}, mm"),
        y: "deviation, µm".to_owned(),
        from_zero: true,
        bands: bands.collect(),
        dashed: Vec::new(),
    })
}
