//! A geometric test of ISO 230-1 in tables, a picture and a document.

use super::evaluation::{Contents, cell};
use crate::conditions::geometry::Kind;
use crate::iso230_1::{Geometric, Quantity};
use crate::judge::Decision;
use serde::Serialize;
use trueaxis_report::JsonSchema;
use trueaxis_report::{Band, Picture, Scatter, Table};

/// A geometric test.
#[derive(Debug, Serialize, JsonSchema)]
pub struct GeometricEntry<'a> {
    /// `straightness`, `flatness`, `squareness` or `parallelism`.
    pub kind: &'static str,
    /// The machine error that it is, such as `EYX`; null if none is stated.
    pub error: Option<&'a str>,
    /// All quantities; the first one is judged.
    pub quantities: Vec<GeometricQuantityEntry<'a>>,
    /// What is allowed of the first quantity, µm; null without tolerance or for an angle.
    pub tolerance_um: Option<f64>,
    /// What is allowed of the first quantity, µrad; null without tolerance or for a length.
    pub tolerance_urad: Option<f64>,
    /// `pass`, `fail` or `undecided` by ISO 14253-1; null without tolerance.
    pub outcome: Option<&'static str>,
    /// Standard deviation of a reading from runs or closure, µm; null if it is not known or an angle.
    pub reading_s_um: Option<f64>,
    /// Standard deviation of a reading from runs or closure, µrad; null if it is not known or a length.
    pub reading_s_urad: Option<f64>,
    /// Degrees of freedom of this standard deviation; null without it. Unit: 1.
    pub degrees_of_freedom: Option<f64>,
    /// The lines about their reference.
    pub lines: Vec<GeometricLineEntry<'a>>,
    /// The points of a surface.
    pub surface: Vec<SurfacePointEntry>,
    /// The closure errors of the lines of a surface.
    pub closures: Vec<ClosureEntry<'a>>,
}

/// A quantity of a geometric test: in µm or in µrad.
#[derive(Debug, Serialize, JsonSchema)]
pub struct GeometricQuantityEntry<'a> {
    /// Its name; of a squareness the machine error.
    pub name: &'a str,
    /// Its value, µm; null for an angle.
    pub value_um: Option<f64>,
    /// Its expanded uncertainty, 95 %, µm; null for an angle, or if it is not known.
    pub u_um: Option<f64>,
    /// Its value, µrad; null for a length.
    pub value_urad: Option<f64>,
    /// Its expanded uncertainty, 95 %, µrad; null for a length, or if it is not known.
    pub u_urad: Option<f64>,
}

/// A line about its reference.
#[derive(Debug, Serialize, JsonSchema)]
pub struct GeometricLineEntry<'a> {
    /// Which.
    pub name: &'a str,
    /// Positions, mm.
    pub positions_mm: Vec<f64>,
    /// Deviations, µm.
    pub deviations_um: Vec<f64>,
}

/// A point of a surface.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SurfacePointEntry {
    /// Place, mm.
    pub x_mm: f64,
    /// Place, mm.
    pub y_mm: f64,
    /// Deviation from the reference plane, µm.
    pub deviation_um: f64,
}

/// What the closure of a surface changed of a line.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ClosureEntry<'a> {
    /// The line.
    pub line: &'a str,
    /// How far its own profile is from the surface, at most, µm.
    pub largest_um: f64,
}

pub(super) fn word(outcome: Decision) -> &'static str {
    match outcome {
        Decision::Conforming => "pass",
        Decision::NotConforming => "fail",
        Decision::NotProved => "undecided",
    }
}

/// The value in µm or in µrad.
fn either(value: Option<f64>, angle: bool, wanted: bool) -> Option<f64> {
    value.filter(|_| angle == wanted).map(|v| v * if angle { 1e6 } else { 1e3 })
}

impl<'a> From<&'a Geometric> for GeometricEntry<'a> {
    fn from(g: &'a Geometric) -> Self {
        use crate::conditions::Extent;
        let tolerance = |wanted: bool| match (g.test.tolerance, wanted) {
            (Some(Extent::Length(mm)), false) => Some(mm * 1e3),
            (Some(Extent::Angle(rad)), true) => Some(rad * 1e6),
            _ => None,
        };
        let quantity = |q: &'a Quantity| GeometricQuantityEntry {
            name: &q.name,
            value_um: either(Some(q.value), q.is_angle, false),
            u_um: either(q.expanded, q.is_angle, false),
            value_urad: either(Some(q.value), q.is_angle, true),
            u_urad: either(q.expanded, q.is_angle, true),
        };
        let scatter = g.scatter.map(|(s, _)| s);
        Self {
            kind: g.test.kind.name(),
            error: g.test.error.as_deref(),
            quantities: g.quantities.iter().map(quantity).collect(),
            tolerance_um: tolerance(false),
            tolerance_urad: tolerance(true),
            outcome: g.outcome.map(word),
            reading_s_um: either(scatter, g.of_angles, false),
            reading_s_urad: either(scatter, g.of_angles, true),
            degrees_of_freedom: g.scatter.map(|(_, free)| free),
            lines: g
                .lines
                .iter()
                .map(|line| GeometricLineEntry {
                    name: &line.name,
                    positions_mm: line.points_mm.iter().map(|p| p[0]).collect(),
                    deviations_um: line.points_mm.iter().map(|p| p[1] * 1e3).collect(),
                })
                .collect(),
            surface: g
                .surface_mm
                .iter()
                .map(|[x, y, h]| SurfacePointEntry { x_mm: *x, y_mm: *y, deviation_um: h * 1e3 })
                .collect(),
            closures: g
                .closures
                .iter()
                .map(|c| ClosureEntry { line: &c.line, largest_um: c.largest_mm * 1e3 })
                .collect(),
        }
    }
}

pub(super) fn contents(g: &Geometric) -> Contents {
    let title = match &g.test.error {
        Some(error) => format!("{} ({error})", g.test.kind.name()),
        None => g.test.kind.name().to_owned(),
    };
    let mut results = vec![(title, quantities(g))];
    if !g.closures.is_empty() {
        let rows = g.closures.iter().map(|c| [c.line.clone(), cell(Some(c.largest_mm), 1e3)]);
        let table = Table::new(["measured line", "changed by the closure, at most, µm"]).rows(rows);
        results.push(("Closure errors, shared out by least squares".to_owned(), table));
    }
    let rows = g.lines.iter().flat_map(|line| {
        line.points_mm
            .iter()
            .map(|[x, h]| [line.name.clone(), format!("{x:.3}"), cell(Some(*h), 1e3)])
    });
    let lines = Table::new(["measured line", "position, mm", "deviation, µm"]).rows(rows);
    let rows = g
        .surface_mm
        .iter()
        .map(|[x, y, h]| [format!("{x:.3}"), format!("{y:.3}"), cell(Some(*h), 1e3)]);
    let surface = Table::new(["x, mm", "y, mm", "deviation, µm"]).rows(rows);
    let details = match g.surface_mm.is_empty() {
        true => ("The lines".to_owned(), lines),
        false => ("The surface".to_owned(), surface),
    };
    let pictures = if g.lines.is_empty() { Vec::new() } else { vec![picture(g)] };
    Contents { results, pictures, details: vec![details] }
}

fn quantities(g: &Geometric) -> Table {
    let rows = g.quantities.iter().enumerate().map(|(i, q)| {
        let (scale, unit) = if q.is_angle { (1e6, "µrad") } else { (1e3, "µm") };
        let verdict = match (i, g.outcome) {
            (0, Some(outcome)) => word(outcome).to_owned(),
            _ => String::new(),
        };
        [
            q.name.clone(),
            cell(Some(q.value), scale),
            cell(q.expanded, scale),
            unit.to_owned(),
            verdict,
        ]
    });
    let limit = match g.test.tolerance {
        Some(crate::conditions::Extent::Length(mm)) => Some(format!("{} µm", mm * 1e3)),
        Some(crate::conditions::Extent::Angle(rad)) => Some(format!("{} µrad", rad * 1e6)),
        None => None,
    };
    let rule = limit.map_or_else(String::new, |limit| {
        format!(
            "Tolerance {limit} by ISO 14253-1: pass if |value| + U is within it, fail if |value| − U is beyond \
             it. "
        )
    });
    let scatter = g.scatter.map(|(s, free)| {
        let (scale, unit) = if g.of_angles { (1e6, "µrad") } else { (1e3, "µm") };
        format!(
            "A reading scatters by {} {unit} ({free:.0} degrees of freedom).",
            cell(Some(s), scale)
        )
    });
    // The name of the first quantity of a squareness is that of the error.
    let line = (g.test.kind == Kind::Squareness).then(|| {
        let q = g.judged();
        let u = q.expanded.map_or_else(String::new, |u| format!(" ± {:.2}", 0.5e6 * u));
        format!(" For the machine file: [location] {} = \"{:.2}{u} urad\".", q.name, q.value * 1e6)
    });
    let line = line.unwrap_or_default();
    Table::new(["quantity", "value", "U, 95 %", "", "verdict"])
        .rows(rows)
        .note(format!("{rule}{}{line}", scatter.unwrap_or_default()))
}

fn picture(g: &Geometric) -> Picture {
    let band = |(i, line): (usize, &crate::iso230_1::Line)| {
        let points = || line.points_mm.iter().map(|[x, h]| (*x, h * 1e3));
        Band {
            label: if line.name.is_empty() {
                g.test.kind.name().to_owned()
            } else {
                line.name.clone()
            },
            colour: i,
            line: points().map(|(x, h)| (x, h, 0.0)).collect(),
            points: points().collect(),
        }
    };
    Picture::Scatter(Scatter {
        title: "Deviations".to_owned(),
        note: "About the reference of the verdict; of parallelism about the mean height."
            .to_owned(),
        x: "position, mm".to_owned(),
        y: "µm".to_owned(),
        from_zero: true,
        bands: g.lines.iter().enumerate().map(band).collect(),
        dashed: Vec::new(),
    })
}
