//! A probing test in tables, pictures and a document.

use super::evaluation::{Contents, cell};
use super::evaluation_geometric::word;
use crate::iso230_10::{Deviations, Probing};
use serde::Serialize;
use trueaxis_report::JsonSchema;
use trueaxis_report::{Band, Picture, Polar, PolarLine, Scatter, Table};

/// A probing test.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ProbingEntry<'a> {
    /// The quantities.
    pub quantities: Vec<ProbingQuantityEntry<'a>>,
    /// Standard deviation of a hit at one point, µm; null without repeated hits.
    pub hit_s_um: Option<f64>,
    /// Degrees of freedom of it; null without repeated hits. Unit: 1.
    pub degrees_of_freedom: Option<f64>,
    /// The deviations of rings and spheres.
    pub deviations: Vec<ProbingDeviationsEntry<'a>>,
}

/// A quantity of a probing test.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ProbingQuantityEntry<'a> {
    /// Its name.
    pub name: &'a str,
    /// Its value, µm.
    pub value_um: f64,
    /// Its expanded uncertainty, 95 %, µm; null of a range of repeated readings, or if it is not known.
    pub u_um: Option<f64>,
    /// What is allowed, µm; null without tolerance.
    pub tolerance_um: Option<f64>,
    /// `pass`, `fail` or `undecided`; null without tolerance.
    pub outcome: Option<&'static str>,
}

/// The deviations of a ring or sphere from its least-squares element.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ProbingDeviationsEntry<'a> {
    /// Which.
    pub name: &'a str,
    /// Angles in the plane x y, degrees.
    pub angles_deg: Vec<f64>,
    /// Height angles over this plane, degrees; 0 of a ring.
    pub heights_deg: Vec<f64>,
    /// Deviations of the radius, µm.
    pub deviations_um: Vec<f64>,
}

impl<'a> From<&'a Probing> for ProbingEntry<'a> {
    fn from(p: &'a Probing) -> Self {
        let quantities = p.quantities.iter().map(|q| ProbingQuantityEntry {
            name: &q.name,
            value_um: q.value_mm * 1e3,
            u_um: q.expanded_mm.map(|u| u * 1e3),
            tolerance_um: q.limit_mm.map(|l| l * 1e3),
            outcome: q.outcome.map(word),
        });
        let deviations = p.deviations.iter().map(|d| {
            let column = |k: usize, scale: f64| d.points.iter().map(|p| p[k] * scale).collect();
            ProbingDeviationsEntry {
                name: &d.name,
                angles_deg: column(0, 1f64.to_degrees()),
                heights_deg: column(1, 1f64.to_degrees()),
                deviations_um: column(2, 1e3),
            }
        });
        Self {
            quantities: quantities.collect(),
            hit_s_um: p.scatter.map(|(s, _)| s * 1e3),
            degrees_of_freedom: p.scatter.map(|(_, free)| free),
            deviations: deviations.collect(),
        }
    }
}

pub(super) fn contents(p: &Probing) -> Contents {
    let rows = p.quantities.iter().map(|q| {
        [
            q.name.clone(),
            cell(Some(q.value_mm), 1e3),
            cell(q.expanded_mm, 1e3),
            cell(q.limit_mm, 1e3),
            q.outcome.map_or_else(String::new, |o| word(o).to_owned()),
        ]
    });
    let scatter = p.scatter.map_or_else(String::new, |(s, free)| {
        let s = cell(Some(s), 1e3);
        format!("A hit scatters by {s} µm ({free:.0} degrees of freedom). ")
    });
    let table = Table::new(["quantity, µm", "value", "U, 95 %", "allowed", "verdict"]).rows(rows).note(format!(
        "{scatter}P_FTU: range of the radii about the least-squares circle (sphere), which is the variation of the \
         pre-travel over all directions. The text of ISO 230-10 was not available: names and definitions \
         from other literature."
    ));
    let rings: Vec<&Deviations> = p.deviations.iter().filter(|d| !d.is_sphere).collect();
    let spheres: Vec<&Deviations> = p.deviations.iter().filter(|d| d.is_sphere).collect();
    let mut pictures = Vec::new();
    if !rings.is_empty() {
        let lines = rings.iter().enumerate().map(|(colour, d)| {
            let mut points: Vec<(f64, f64)> = d.points.iter().map(|p| (p[0], p[2] * 1e3)).collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            points.extend(points.first().copied());
            PolarLine { label: d.name.clone(), colour, points }
        });
        let note = "Deviations of the radius from the least-squares circle, magnified.".to_owned();
        pictures.push(Picture::Polar(Polar {
            title: "Ring".to_owned(),
            note,
            lines: lines.collect(),
        }));
    }
    if !spheres.is_empty() {
        let bands = spheres.iter().enumerate().map(|(colour, d)| Band {
            label: d.name.clone(),
            colour,
            line: Vec::new(),
            points: d.points.iter().map(|p| (p[1].to_degrees(), p[2] * 1e3)).collect(),
        });
        pictures.push(Picture::Scatter(Scatter {
            title: "Sphere".to_owned(),
            note: "Deviations of the radius from the least-squares sphere over the height above the equator."
                .to_owned(),
            x: "height angle, deg".to_owned(),
            y: "µm".to_owned(),
            from_zero: true,
            bands: bands.collect(),
            dashed: Vec::new(),
        }));
    }
    Contents { results: vec![("Probing".to_owned(), table)], pictures, details: Vec::new() }
}
