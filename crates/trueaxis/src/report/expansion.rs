//! The coefficient of expansion and the error table of a scale, as text and page.

use super::ScaleFound;
use trueaxis_report::plots::{Curve, Labels, curves};
use trueaxis_report::{DrawingError, Figure, Report, Section, Table};
use trueaxis_thermal::expansion::GeometricTable;

/// The coefficient and the error table of one scale, or of several.
pub fn expansion_report(scales: &[ScaleFound]) -> Report<'_> {
    let title = match scales {
        [scale] => scale.runs.name.clone(),
        _ => "Scales from laser runs".to_owned(),
    };
    let mut report = Report::new(&title);
    for scale in scales {
        let heading = |text: &str| match scales.len() {
            1 => text.to_owned(),
            _ if text.is_empty() => scale.runs.name.clone(),
            _ => {
                format!("{text}: {}", scale.runs.scale.axis.as_deref().unwrap_or(&scale.runs.name))
            }
        };
        report = report.section(Section::new(heading("")).table(figures(scale)));
        report =
            report.section(Section::new(heading("Runs")).table(runs(scale)).figure(picture(scale)));
        report = report.section(Section::new(heading("Error table")).table(error_table(scale)));
        report = report.section(Section::new(heading("Spline")).table(spline(&scale.table)));
        let line = expansion_line(scale);
        report = report.section(Section::new(heading("In the machine file")).code(line));
    }
    report
}

fn expansion_line(scale: &ScaleFound) -> String {
    let (alpha, u) = (scale.found.per_k * 1e6, scale.found.u_per_k * 1e6);
    format!("expansion = \"{alpha:.2} ± {u:.2} um/(m K)\"")
}

fn figures(scale: &ScaleFound) -> Table {
    let found = &scale.found;
    let (alpha, u) = (found.per_k * 1e6, found.u_per_k * 1e6);
    let material = match found.materials.is_empty() {
        true => "none of steel tape, glass, Zerodur".to_owned(),
        false => found.materials.join(" or "),
    };
    let difference = found.slope_difference_per_k * 1e6;
    Table::pairs([
        ("expansion", format!("{alpha:.3} ± {u:.3} µm/(m·K), standard uncertainty")),
        ("slope difference", format!("{difference:.3} µm/(m·K), coldest and warmest run")),
        ("material", material),
        ("residual", format!("{:.3} µm", found.residual_mm * 1e3)),
    ])
}

fn runs(scale: &ScaleFound) -> Table {
    let runs = scale.runs.runs.iter().zip(&scale.found.slopes).map(|(run, slope)| {
        let numbers = [format!("{:.1}", run.celsius.value), format!("{:.3}", slope * 1e6)];
        std::iter::once(run.name.clone()).chain(numbers)
    });
    Table::new(["run", "°C", "slope, µm/m"]).rows(runs)
}

fn error_table(scale: &ScaleFound) -> Table {
    let table = &scale.table;
    let rows = table.positions_mm.iter().zip(&table.errors_mm).zip(&table.u_mm);
    let rows = rows
        .map(|((p, e), u)| [format!("{p}"), format!("{:.2}", e * 1e3), format!("{:.2}", 2e3 * u)]);
    Table::new(["position, mm", "error, µm", "U (k = 2), µm"]).rows(rows).note(format!(
        "actual − nominal at {:.2} °C, 0 at the end where the laser was zeroed; all runs, each brought to this \
         temperature",
        table.reference_celsius
    ))
}

fn spline(table: &GeometricTable) -> Table {
    let rows = table.pieces().into_iter().map(|p| {
        let (a, b, c) = (p.a_um_per_mm3, p.b_um_per_mm2, p.c_um_per_mm);
        let numbers = [a, b, c, p.d_um].map(|v| format!("{v:.6e}"));
        [format!("{} to {}", p.from_mm, p.to_mm)].into_iter().chain(numbers)
    });
    Table::new(["piece, mm", "a, µm/mm³", "b, µm/mm²", "c, µm/mm", "d, µm"])
        .rows(rows)
        .note("error = ((a·h + b)·h + c)·h + d in µm, h = position − beginning of the piece in mm")
}

/// The runs, and the spline through the table.
fn picture(scale: &ScaleFound) -> Figure<'_> {
    Figure::new(
        "The runs, and the error table at its temperature as a spline: positioning error over position.",
        move || draw(scale),
    )
}

fn draw(scale: &ScaleFound) -> Result<String, DrawingError> {
    /// Of the spline, between the first and the last position.
    const STEPS: u32 = 200;
    let run_curve = |run: &trueaxis_thermal::expansion::Run| Curve {
        label: format!("{}, {:.1} °C", run.name, run.celsius.value),
        points: scale
            .runs
            .positions_mm
            .iter()
            .zip(&run.errors_mm)
            .map(|(p, e)| (*p, e * 1e3))
            .collect(),
    };
    let mut lines: Vec<Curve> = scale.runs.runs.iter().map(run_curve).collect();
    let (from, to) = scale.table.spline.range();
    let at = |i: u32| from + (to - from) * f64::from(i) / f64::from(STEPS);
    lines.push(Curve {
        label: format!("table, {:.1} °C", scale.table.reference_celsius),
        points: (0..=STEPS).map(|i| (at(i), scale.table.spline.at(at(i)) * 1e3)).collect(),
    });
    curves((1000, 320), &Labels { x: "position, mm", y: "µm" }, &lines)
}
