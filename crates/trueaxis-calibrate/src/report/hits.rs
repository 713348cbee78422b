//! Deviations of a surface in text and on a page, and as the table that an adaptation reads.

use crate::identify::surface::{HitsStudy, PointDeviation, SurfaceDeviations, UncertaintyParts};
use std::fmt::Write;
use trueaxis_report::{Report, Section, Table};

/// Points of the table on the terminal.
const MOST_ROWS: usize = 12;

/// The table that `compensate adapt` reads; points without a hit are left out.
pub fn deviations_csv(study: &HitsStudy, found: &SurfaceDeviations) -> String {
    let mut text = format!(
        "# {}: deviation along the outward normal, positive where there is more material; U with k = 2\n",
        study.name.replace(['\n', '\r'], " ")
    );
    if study.log.is_virtual {
        text += "# virtual: no real probe made these hits\n";
    }
    text += "point,x_mm,y_mm,z_mm,i,j,k,deviation_um,U_um\n";
    for p in &found.points {
        let (x, n) = (p.point.point_mm, p.point.normal);
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "{},{:.6},{:.6},{:.6},{:.9},{:.9},{:.9},{:.3},{:.3}",
            p.number,
            x.x,
            x.y,
            x.z,
            n.x,
            n.y,
            n.z,
            p.deviation_mm * 1e3,
            p.u.expanded_mm() * 1e3
        );
    }
    text
}

/// Least, greatest and root mean square, µm.
pub(super) fn spread_um(values: impl Iterator<Item = f64> + Clone) -> [f64; 3] {
    let count = values.clone().count().max(1) as f64;
    let least = values.clone().fold(f64::INFINITY, f64::min);
    let most = values.clone().fold(f64::NEG_INFINITY, f64::max);
    let rms = (values.map(|v| v * v).sum::<f64>() / count).sqrt();
    [least, most, rms].map(|v| v * 1e3)
}

fn parts(u: &UncertaintyParts) -> [(&'static str, f64); 5] {
    [
        ("repeatability of one trigger", u.repeatability_mm),
        ("calibration of the probe", u.calibration_mm),
        ("length of the probe", u.length_mm),
        ("errors of the machine", u.machine_mm),
        ("drift", u.drift_mm),
    ]
}

/// What the hits say.
pub fn deviations_report<'a>(study: &'a HitsStudy, found: &'a SurfaceDeviations) -> Report<'a> {
    let us = found.points.iter().map(|p| p.u.expanded_mm());
    let [_, worst, _] = spread_um(us);
    let mut report = Report::new(&study.name)
        .line(format!(
            "{} of {} points of {}, {} hits of {}",
            found.points.len(),
            study.points.len(),
            study.points_file,
            study.log.hits.len(),
            study.log_file
        ))
        .line(format!(
            "probe: tool {}, stylus {} of {}, on {}",
            study.probe.tool,
            study.probe.calibration.stylus,
            study.probe.calibration_file,
            study.machine.name()
        ));
    if study.log.is_virtual {
        report = report.line("VIRTUAL: a simulated machine made these hits");
    }
    let row = |name: &str, of: &dyn Fn(&PointDeviation) -> f64| {
        let [least, most, rms] =
            spread_um(found.points.iter().map(of).collect::<Vec<_>>().into_iter());
        [name.to_owned(), format!("{least:.2}"), format!("{most:.2}"), format!("{rms:.2}")]
    };
    let table = Table::new(["µm", "least", "greatest", "RMS"])
        .row(row("as read (nominal machine, ball radius alone)", &|p| p.as_read_mm))
        .row(row("of it errors of the machine", &|p| p.by_machine_mm))
        .row(row("of it offset and pre-travel", &|p| p.by_probe_mm))
        .row(row("of it drift", &|p| p.by_drift_mm))
        .row(row("deviation of the surface", &|p| p.deviation_mm))
        .row(row("U (k = 2)", &|p| p.u.expanded_mm()));
    let drift = match &found.drift {
        Some(drift) => format!(
            "point {} again at the end: {:+.2} µm; taken to grow evenly",
            drift.number,
            drift.change_mm * 1e3
        ),
        None => "no point was touched again: no drift is subtracted".to_owned(),
    };
    report = report.section(
        Section::new("Deviations along the normals, positive where there is more material")
            .table(table)
            .paragraph(format!("{drift}; largest U {worst:.2} µm")),
    );
    let mut budget = Table::new(["standard uncertainty, µm", "RMS over the points"]);
    for k in 0..5 {
        let of = found.points.iter().map(|p| parts(&p.u)[k].1);
        let name = parts(&UncertaintyParts::default())[k].0;
        budget = budget.row([name.to_owned(), format!("{:.3}", spread_um(of)[2])]);
    }
    report = report.section(Section::new("Parts of U").table(budget));
    let rows = found.points.iter().map(|p| {
        let x = p.point.point_mm;
        [
            p.number.to_string(),
            format!("{:.3}", x.x),
            format!("{:.3}", x.y),
            format!("{:.3}", x.z),
            format!("{:+.2}", p.as_read_mm * 1e3),
            format!("{:+.2}", p.deviation_mm * 1e3),
            format!("{:.2}", p.u.expanded_mm() * 1e3),
        ]
    });
    let headings = ["point", "x, mm", "y, mm", "z, mm", "as read, µm", "deviation, µm", "U, µm"];
    let table = Table::new(headings).rows(rows).most_on_terminal(MOST_ROWS);
    let mut section = Section::new("Points").table(table);
    if !found.lost.is_empty() {
        let lost: Vec<String> = found.lost.iter().take(20).map(ToString::to_string).collect();
        section = section.paragraph(format!(
            "without a hit: {} points: {}",
            found.lost.len(),
            lost.join(", ")
        ));
    }
    report.section(section)
}
