//! Error tables from readings, as text and page.

use super::TablesFound;
use super::error_tables_document::{removed_words, scale_of};
use crate::verify::error_tables::ErrorTable;
use trueaxis_machine::describe::{to_shown, unit};
use trueaxis_report::plots::{Curve, Labels, curves};
use trueaxis_report::{DrawingError, Figure, Report, Section, Table};

/// The tables, axis by axis, and the squarenesses.
pub fn error_tables_report(found: &TablesFound) -> Report<'_> {
    let mut report = Report::new(&found.study.name);
    if !found.tables.is_empty() {
        report = report.section(Section::new("Error motions").table(overview(found)));
    }
    if !found.squarenesses.is_empty() {
        report = report.section(Section::new("Squareness").table(squarenesses(found)));
    }
    for (i, axis) in found.study.machine.axes().iter().enumerate() {
        let tables: Vec<&ErrorTable> = found.tables.iter().filter(|t| t.axis == i).collect();
        if tables.is_empty() {
            continue;
        }
        let mut section = Section::new(format!("Axis {}", axis.name));
        for (is_angle, what) in [(false, "Displacements"), (true, "Angles")] {
            let shown: Vec<&ErrorTable> = tables
                .iter()
                .filter(|t| t.name.component.is_rotation() == is_angle)
                .copied()
                .collect();
            if !shown.is_empty() {
                let caption = format!("{what} of {}: mean of both directions.", axis.name);
                section = section.figure(Figure::new(caption, move || draw(found, &shown)));
            }
        }
        for table in tables {
            section = section.table(rows(found, table));
        }
        report = report.section(section);
    }
    report
}

fn overview(found: &TablesFound) -> Table {
    let rows = found.tables.iter().map(|t| {
        let (scale, unit) = scale_of(t.name);
        let largest_u = t.u.iter().copied().fold(0.0, f64::max);
        let arms: Vec<String> =
            t.arms.iter().map(|(name, mm)| format!("{name} {:.2} µm", mm * 1e3)).collect();
        let scatter = t.scatter.map_or("–".to_owned(), |s| format!("{:.2}", s * scale));
        [
            t.name.to_string(),
            format!("{:.2}", t.range() * scale),
            format!("{:.2}", 2.0 * largest_u * scale),
            unit.replace('u', "µ"),
            format!("{} × {}", t.runs, if t.both { 2 } else { 1 }),
            scatter,
            removed_words(t.removed).to_owned(),
            arms.join(", "),
        ]
    });
    let headings =
        ["error", "range", "U (k = 2)", "unit", "runs", "scatter", "subtracted", "arm, at most"];
    let worst = |is_angle: bool| {
        let of_kind =
            found.read_back.iter().filter(|(name, _)| name.component.is_rotation() == is_angle);
        of_kind.map(|(name, worst)| worst * scale_of(*name).0).fold(0.0, f64::max)
    };
    Table::new(headings).rows(rows).note(format!(
        "range: largest − least of the mean; subtracted: what the set-up of the instrument hides; arm: what the angles \
         of the axis did between the optics and the axis, subtracted as well. Read back through the whole chain of \
         the new machine file the means differ by {:.3} µm and {:.3} µrad at most",
        worst(false),
        worst(true)
    ))
}

fn squarenesses(found: &TablesFound) -> Table {
    let rows = found.squarenesses.iter().map(|s| {
        let urad = |rad: f64| format!("{:.2}", rad * 1e6);
        [
            s.name.to_string(),
            s.axes.join(" "),
            urad(s.value_rad),
            urad(2.0 * s.u_rad),
            urad(s.read_rad),
            urad(s.before_rad),
            format!("{:.2}", s.scale_difference_mm * 1e3),
        ]
    });
    let headings = [
        "error",
        "axes",
        "µrad",
        "U (k = 2)",
        "read",
        "with the new tables, before",
        "scales, read − tables, µm",
    ];
    Table::new(headings).rows(rows).note("read: the angle by which the axes are closer than 90°")
}

fn rows(found: &TablesFound, table: &ErrorTable) -> Table {
    let (scale, of) = scale_of(table.name);
    let of = of.replace('u', "µ");
    let axis = &found.study.machine.axes()[table.axis];
    let rows = (0..table.positions.len()).map(|i| {
        [
            format!(
                "{}",
                (to_shown(&found.study.machine, table.axis, table.positions[i]) * 1e6).round()
                    / 1e6
            ),
            format!("{:.2}", table.up[i] * scale),
            if table.both { format!("{:.2}", table.down[i] * scale) } else { "–".to_owned() },
            format!("{:.2}", 2.0 * table.u[i] * scale),
        ]
    });
    let position = format!("{}, {}", axis.name, unit(axis));
    let name = table.name;
    let headings =
        [position, format!("{name} ↑, {of}"), format!("{name} ↓, {of}"), "U (k = 2)".to_owned()];
    Table::new(headings).rows(rows).most_on_terminal(4)
}

fn draw(found: &TablesFound, tables: &[&ErrorTable]) -> Result<String, DrawingError> {
    let curve = |t: &&ErrorTable| {
        let (scale, _) = scale_of(t.name);
        let at = |q: f64| to_shown(&found.study.machine, t.axis, q);
        let points = t.positions.iter().zip(t.mean()).map(|(q, e)| (at(*q), e * scale)).collect();
        Curve { label: t.name.to_string(), points }
    };
    let lines: Vec<Curve> = tables.iter().map(curve).collect();
    let first = tables.first();
    let y = first.map_or("", |t| if t.name.component.is_rotation() { "µrad" } else { "µm" });
    let axis = first.map(|t| &found.study.machine.axes()[t.axis]);
    let x = axis.map(|a| format!("{}, {}", a.name, unit(a))).unwrap_or_default();
    curves((1000, 320), &Labels { x: &x, y }, &lines)
}
