//! The tables and pictures of a positioning test.

use super::evaluation::{Contents, cell};
use crate::Standard;
use crate::iso230_2::{
    Approached, Direction, Measurement, Position, Positioning, Quantity, Reading,
};
use trueaxis_geometry::AxisKind;
use trueaxis_report::{Band, Picture, Scatter, Table};

/// More points than this are a grey area, and a page of many megabytes.
const MOST_POINTS: usize = 4000;

/// What the deviations of an axis are shown in: unit and factor from mm or rad.
fn shown(kind: AxisKind) -> (&'static str, f64) {
    match kind {
        AxisKind::Linear => ("µm", 1e3),
        AxisKind::Rotary => ("arcsec", 1f64.to_degrees() * 3600.0),
    }
}

/// The same for positions.
pub(super) fn place(kind: AxisKind, position: f64) -> f64 {
    match kind {
        AxisKind::Linear => position,
        // 90, not 90.00000000000001.
        AxisKind::Rotary => (position.to_degrees() * 1e9).round() / 1e9,
    }
}

fn place_unit(kind: AxisKind) -> &'static str {
    match kind {
        AxisKind::Linear => "mm",
        AxisKind::Rotary => "deg",
    }
}

pub(super) fn contents(standard: Standard, m: &Measurement, r: &Positioning) -> Contents {
    let iso = vec![titled("Parameters of the axis", iso230_2(r))];
    let vdi3441 = titled("VDI/DGQ 3441", vdi3441(r));
    let b554 = titled("Form of ASME B5.54", b554(r));
    let (results, mut details) = match standard {
        Standard::Vdi3441 => (vec![vdi3441, b554], iso),
        Standard::B5_54 => (vec![b554, vdi3441], iso),
        _ => (iso, vec![vdi3441, b554]),
    };
    details.extend(budget(r));
    details.push((format!("Every target, {}", shown(r.kind).0), targets(r)));
    Contents { results, details, pictures: vec![scatter(m, r), reversal(r)] }
}

fn titled(title: &str, table: Table) -> (String, Table) {
    (title.to_owned(), table)
}

fn iso230_2(r: &Positioning) -> Table {
    let (unit, scale) = shown(r.kind);
    let rows = Quantity::ALL.map(|quantity| {
        [
            quantity.symbol().to_owned(),
            quantity.title().to_owned(),
            cell(r.value(quantity), scale),
            cell(r.expanded_of(quantity), scale),
        ]
    });
    Table::new(["ISO 230-2", "", unit, "U (k = 2)"])
        .rows(rows)
        .note("– : the readings do not allow it, or nothing is known of the instrument (U)")
}

fn named(r: &Positioning, rows: &[(&str, &str, Option<f64>)]) -> Table {
    let (unit, scale) = shown(r.kind);
    let row = |(symbol, name, value): &(&str, &str, Option<f64>)| {
        [(*symbol).to_owned(), (*name).to_owned(), cell(*value, scale)]
    };
    Table::new(["", "", unit]).rows(rows.iter().map(row))
}

fn vdi3441(r: &Positioning) -> Table {
    let v = &r.others.vdi3441;
    let rows = [
        ("P", "positional uncertainty", v.p),
        ("Pa", "positional deviation", v.pa),
        ("Ps max", "positional scatter", v.ps),
        ("U max", "reversal", v.u),
    ];
    named(r, &rows)
}

fn b554(r: &Positioning) -> Table {
    let b = &r.others.b554;
    let rows = [
        ("both", "range of all readings", b.accuracy),
        ("↑", "range of all readings, rising", b.accuracy_up),
        ("↓", "range of all readings, falling", b.accuracy_down),
        ("repeat", "largest range at one target from one side", b.repeatability),
        ("reversal", "largest reversal", b.reversal),
    ];
    named(r, &rows).note("The form was not compared with the text of the standard.")
}

fn budget(r: &Positioning) -> Option<(String, Table)> {
    let budget = r.budget.as_ref()?;
    let (unit, scale) = shown(r.kind);
    let shares = budget.shares.iter().map(|s| (s.name, Some(s.u)));
    let all = shares.chain([("drift, each reading", budget.drift_u)]);
    let table = Table::new(["over the measured length", unit])
        .rows(all.map(|(name, u)| [name.to_owned(), cell(u, scale)]));
    let title = "Measurement uncertainty (ISO/TR 230-9), standard uncertainty of each contribution";
    Some(titled(title, table))
}

fn targets(r: &Positioning) -> Table {
    let scale = shown(r.kind).1;
    let at = format!("target, {}", place_unit(r.kind));
    let headings = [&at[..], "n↑", "n↓", "x̄↑", "x̄↓", "x̄", "s↑", "s↓", "B", "R↑", "R↓", "R"];
    let mean = |a: Option<Approached>| cell(a.map(|a| a.mean), scale);
    let s = |a: Option<Approached>| cell(a.and_then(|a| a.s), scale);
    let count = |a: Option<Approached>| a.map_or(0, |a| a.count).to_string();
    Table::new(headings).rows(r.positions.iter().map(|p| {
        [
            place(r.kind, p.target).to_string(),
            count(p.up),
            count(p.down),
            mean(p.up),
            mean(p.down),
            cell(p.mean(), scale),
            s(p.up),
            s(p.down),
            cell(p.reversal(), scale),
            cell(p.repeatability_of(Direction::Up), scale),
            cell(p.repeatability_of(Direction::Down), scale),
            cell(p.repeatability(), scale),
        ]
    }))
}

pub(super) fn scatter(m: &Measurement, r: &Positioning) -> Picture {
    let (unit, scale) = shown(r.kind);
    let total: usize = m.targets.iter().map(|t| t.up.len() + t.down.len()).sum();
    let step = total.div_ceil(MOST_POINTS).max(1);
    let points = |direction| {
        let all = m.targets.iter().flat_map(move |t| {
            let point = move |r: &Reading| (place(m.kind, t.position), r.deviation * scale);
            t.of(direction).iter().map(point)
        });
        all.step_by(step).collect::<Vec<_>>()
    };
    let band = |direction, colour, label: &str| {
        let at = |p: &Position| {
            let a = p.of(direction)?;
            let wide = 2.0 * a.s.unwrap_or(0.0) * scale;
            Some((place(r.kind, p.target), a.mean * scale, wide))
        };
        Band {
            label: label.to_owned(),
            colour,
            line: r.positions.iter().filter_map(at).collect(),
            points: points(direction),
        }
    };
    let mean = r.positions.iter();
    let mean = mean.filter_map(|p| Some((place(r.kind, p.target), p.mean()? * scale)));
    let thinned = match step {
        1 => String::new(),
        n => format!(" One reading in {n} is drawn."),
    };
    Picture::Scatter(Scatter {
        title: "Deviations at the targets".to_owned(),
        note: format!(
            "Points: readings; lines: means; bands: x̄ ± 2s; dashed: bidirectional mean.{thinned}"
        ),
        x: format!("target, {}", place_unit(r.kind)),
        y: format!("deviation, {unit}"),
        from_zero: true,
        bands: vec![band(Direction::Up, 0, "rising ↑"), band(Direction::Down, 1, "falling ↓")],
        dashed: mean.collect(),
    })
}

fn reversal(r: &Positioning) -> Picture {
    let (unit, scale) = shown(r.kind);
    let of = |f: fn(&Position) -> Option<f64>, label: &str, colour| Band {
        label: label.to_owned(),
        colour,
        line: r
            .positions
            .iter()
            .filter_map(|p| Some((place(r.kind, p.target), f(p)? * scale, 0.0)))
            .collect(),
        points: Vec::new(),
    };
    Picture::Scatter(Scatter {
        title: "Reversal and repeatability".to_owned(),
        note: String::new(),
        x: format!("target, {}", place_unit(r.kind)),
        y: unit.to_owned(),
        from_zero: true,
        bands: vec![
            of(Position::reversal, "reversal B", 2),
            of(Position::repeatability, "repeatability R", 3),
        ],
        dashed: Vec::new(),
    })
}

/// Units of the deviations in JSON, with the factor from mm or rad.
pub(super) fn json_units(kind: AxisKind) -> &'static [(&'static str, f64)] {
    match kind {
        AxisKind::Linear => &[("um", 1e3)],
        AxisKind::Rotary => &[("urad", 1e6), ("arcsec", 648_000.0 / std::f64::consts::PI)],
    }
}
