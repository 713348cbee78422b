//! The tables and the picture of a circular test.

use super::evaluation::{Contents, cell};
use crate::iso230_4::{Causes, Circular, PathResult};
use trueaxis_report::{Picture, Polar, PolarLine, Table};

const UM: f64 = 1e3;

pub(super) fn contents(c: &Circular) -> Contents {
    let mut results = vec![("Results of the test".to_owned(), deviations(c))];
    let diagnosis = c.diagnosis.as_ref();
    let title = "Diagnosis: what makes the circle deviate, the largest share first";
    results.extend(diagnosis.map(|found| (title.to_owned(), super::diagnosis::table(c, found))));
    let causes = c.causes.as_ref();
    results
        .extend(causes.map(|found| ("Causes of the deviations".to_owned(), causes_of(c, found))));
    let spikes = causes.map(|found| ("Reversal spikes".to_owned(), spikes(c, found)));
    Contents { results, details: spikes.into_iter().collect(), pictures: vec![picture(c)] }
}

/// `G ccw`, `G cw`, … in µm.
fn deviations(c: &Circular) -> Table {
    let mut table = Table::new(["ISO 230-4", "", "µm"])
        .note("G about the least-squares centre, F about the nominal one, outward positive");
    let mut row = |symbol: String, name: &str, value: Option<f64>| {
        table.push([symbol, name.to_owned(), cell(value, UM)]);
    };
    for p in &c.paths {
        let sense = p.path.sense.word();
        row(format!("G {sense}"), "circular deviation", Some(p.g_mm));
        row(format!("F max {sense}"), "radial deviation", p.f_mm.map(|f| f[0]));
        row(format!("F min {sense}"), "radial deviation", p.f_mm.map(|f| f[1]));
    }
    row("G(b)".into(), "bidirectional circular deviation", c.g_both_mm);
    row("D".into(), "mean bidirectional radial deviation", c.d_mm);
    table
}

fn causes_of(c: &Circular, causes: &Causes) -> Table {
    let mut table = Table::new(["cause", "", ""])
        .note("Least squares over all paths; 10° after each reversal are left out for the spikes.");
    let mut row = |name: String, value: Option<f64>, scale: f64, unit: &str| {
        table.push([name, cell(value, scale), unit.to_owned()]);
    };
    let [a, b] = &c.axes;
    row(format!("reversal {a} (B = E↑ − E↓)"), Some(causes.backlash_mm[0]), UM, "µm");
    row(format!("reversal {b} (B = E↑ − E↓)"), Some(causes.backlash_mm[1]), UM, "µm");
    row(format!("scale {a} − {b}, over the diameter"), Some(causes.scale_mismatch_mm), UM, "µm");
    row(format!("squareness {a}{b}, closer than 90°"), causes.squareness_rad, 1e6, "µrad");
    row("servo mismatch, ccw along +45°".into(), causes.servo_mismatch_mm, UM, "µm");
    if causes.diagonal_ellipse_mm.is_some() {
        let name = "squareness and servo mismatch together".to_owned();
        row(name, causes.diagonal_ellipse_mm, UM, "µm");
    }
    row(format!("centre {a}"), Some(causes.centre_mm[0]), UM, "µm");
    row(format!("centre {b}"), Some(causes.centre_mm[1]), UM, "µm");
    row("residual, root mean square".into(), Some(causes.residual_rms_mm), UM, "µm");
    table
}

fn spikes(c: &Circular, causes: &Causes) -> Table {
    let rows = causes.spikes.iter().map(|spike| {
        [
            c.axes[spike.axis].clone(),
            format!("{:.0}°", spike.at_rad.to_degrees()),
            spike.sense.word().to_owned(),
            cell(Some(spike.height_mm), UM),
        ]
    });
    Table::new(["axis", "at", "direction", "µm"])
        .rows(rows)
        .note("Largest residual within 10° after the reversal, outward positive.")
}

fn base_radius(c: &Circular) -> f64 {
    c.radius_mm.or(c.paths.first().map(|p| p.circle.radius_mm)).unwrap_or(0.0)
}

fn picture(c: &Circular) -> Picture {
    /// Finer than the picture can show.
    const MOST_POINTS: usize = 3600;
    let radius = base_radius(c);
    let line = |(i, p): (usize, &PathResult)| {
        let step = p.path.points_mm.len().div_ceil(MOST_POINTS).max(1);
        let points = p.path.points_mm.iter().step_by(step).map(|p| {
            let (x, y) = (p[0] - c.centre_mm[0], p[1] - c.centre_mm[1]);
            (y.atan2(x), (x.hypot(y) - radius) * UM)
        });
        let label = format!("{}, G {} µm", p.path.sense.word(), cell(Some(p.g_mm), UM));
        PolarLine { label, colour: i, points: points.collect() }
    };
    let lines = c.paths.iter().enumerate().map(line).collect();
    Picture::Polar(Polar {
        title: "The paths, deviations magnified".to_owned(),
        note: format!(
            "Solid circle: nominal, radius {radius:.3} mm. {} to the right, {} upwards.",
            c.axes[0], c.axes[1]
        ),
        lines,
    })
}
