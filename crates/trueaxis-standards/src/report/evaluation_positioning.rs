//! The tables and pictures of a positioning test.

use super::evaluation::{Sheets, figure};
use crate::Standard;
use crate::iso230_2::{
    Approached, Direction, Measurement, Position, Positioning, Quantity, Reading,
};
use trueaxis_geometry::AxisKind;
use trueaxis_report::Block;
use trueaxis_report::{Band, Picture, Scatter};

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

pub(super) fn sheets(standard: Standard, m: &Measurement, r: &Positioning) -> Sheets {
    let iso = vec![figures(r)];
    let others = vec![vdi3441(r), b554(r)];
    let (mut first, second) = match standard {
        Standard::Vdi3441 | Standard::B5_54 => (others, iso),
        _ => (iso, others),
    };
    if standard == Standard::B5_54 {
        first.reverse();
    }
    let mut details = second;
    details.extend(budget(r));
    details.push(table(r));
    Sheets { figures: first, details, pictures: vec![scatter(m, r), reversal(r)] }
}

fn figures(r: &Positioning) -> Block {
    let (unit, scale) = shown(r.kind);
    let headings = ["ISO 230-2", "", unit, "U (k = 2)"];
    let note = "– : the readings do not allow it, or nothing is known of the instrument (U)";
    let mut block = Block::new("Figures of the axis", note, &headings);
    for quantity in Quantity::ALL {
        block.rows.push(vec![
            quantity.symbol().to_owned(),
            quantity.title().to_owned(),
            figure(r.value(quantity), scale),
            figure(r.expanded_of(quantity), scale),
        ]);
    }
    block
}

fn named(
    title: &str,
    note: &'static str,
    r: &Positioning,
    rows: &[(&str, &str, Option<f64>)],
) -> Block {
    let (unit, scale) = shown(r.kind);
    let mut block = Block::new(title, note, &["", "", unit]);
    for (symbol, name, value) in rows {
        block.rows.push(vec![(*symbol).to_owned(), (*name).to_owned(), figure(*value, scale)]);
    }
    block
}

fn vdi3441(r: &Positioning) -> Block {
    let v = &r.others.vdi3441;
    let rows = [
        ("P", "positional uncertainty", v.p),
        ("Pa", "positional deviation", v.pa),
        ("Ps max", "positional scatter", v.ps),
        ("U max", "reversal", v.u),
    ];
    named("VDI/DGQ 3441", "", r, &rows)
}

fn b554(r: &Positioning) -> Block {
    let b = &r.others.b554;
    let rows = [
        ("both", "range of all readings", b.accuracy),
        ("↑", "range of all readings, rising", b.accuracy_up),
        ("↓", "range of all readings, falling", b.accuracy_down),
        ("repeat", "largest range at one target from one side", b.repeatability),
        ("reversal", "largest reversal", b.reversal),
    ];
    let note = "The form was not compared with the text of the standard.";
    named("Form of ASME B5.54", note, r, &rows)
}

fn budget(r: &Positioning) -> Option<Block> {
    let budget = r.budget.as_ref()?;
    let (unit, scale) = shown(r.kind);
    let title = "Measuring uncertainty (ISO/TR 230-9), standard uncertainty of each contribution";
    let mut block = Block::new(title, "", &["over the measured length", unit]);
    for share in &budget.shares {
        block.rows.push(vec![share.name.to_owned(), figure(Some(share.u), scale)]);
    }
    let drift = "drift, each reading".to_owned();
    block.rows.push(vec![drift, figure(budget.drift_u, scale)]);
    Some(block)
}

fn table(r: &Positioning) -> Block {
    let (unit, scale) = shown(r.kind);
    let at = format!("target, {}", place_unit(r.kind));
    let headings = [&at[..], "n↑", "n↓", "x̄↑", "x̄↓", "x̄", "s↑", "s↓", "B", "R↑", "R↓", "R"];
    let mut block = Block::new(&format!("Every target, {unit}"), "", &headings);
    for p in &r.positions {
        let mean = |a: Option<Approached>| figure(a.map(|a| a.mean), scale);
        let s = |a: Option<Approached>| figure(a.and_then(|a| a.s), scale);
        let count = |a: Option<Approached>| a.map_or(0, |a| a.count).to_string();
        block.rows.push(vec![
            format!("{}", place(r.kind, p.target)),
            count(p.up),
            count(p.down),
            mean(p.up),
            mean(p.down),
            figure(p.mean(), scale),
            s(p.up),
            s(p.down),
            figure(p.reversal(), scale),
            figure(p.repeatability_of(Direction::Up), scale),
            figure(p.repeatability_of(Direction::Down), scale),
            figure(p.repeatability(), scale),
        ]);
    }
    block
}

fn scatter(m: &Measurement, r: &Positioning) -> Picture {
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
        n => format!(" Every {n}th reading is drawn."),
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
