//! The curves over time that a simulation shows.

use super::simulation::{Simulation, travel};
use super::simulation_plots::{Mark, Strip, strips};
use crate::{Quantity, Series, shown, unit};
use trueaxis_machine::axis::Travel;
use trueaxis_report::{DrawingError, Figure};

fn marks(s: &Simulation<'_>) -> Vec<Mark> {
    let all = s.issues.list.iter();
    all.map(|t| Mark { from_s: t.from_s, to_s: t.to_s, critical: t.critical }).collect()
}

/// The meaning of the coloured stretches, if there are any.
pub(super) fn marks_note(s: &Simulation<'_>) -> String {
    let any = |critical: bool| s.issues.list.iter().any(|t| t.critical == critical);
    let note = |shown: bool, words: &'static str| if shown { words } else { "" };
    note(any(true), " Red stretches: part or machine are in danger.").to_owned()
        + note(any(false), " Yellow stretches: other issues.")
}

/// Deviation and speed over time.
pub(super) fn curves(s: &Simulation<'_>, series: &Series) -> Result<String, DrawingError> {
    let rows = [
        (Quantity::Tip, "deviation of the tip, µm", 0.1),
        (Quantity::Feed, "along the feed, µm", 0.1),
        (Quantity::Normal, "along the normal, µm", 0.1),
        (Quantity::Binormal, "along the binormal, µm", 0.1),
        (Quantity::ToolAxis, "deviation of the tool axis, µrad", 0.1),
        (Quantity::PathSpeed, "speed along the path, mm/min", 1.0),
    ];
    let strip = |(of, title, least_span): (Quantity, &str, f64)| Strip {
        title: title.to_owned(),
        note: String::new(),
        band: series.curve(of).collect(),
        limits: Vec::new(),
        least_span,
    };
    strips(&rows.map(strip), s.summary.time_s, &marks(s))
}

/// Positions and speeds of the axes over time.
pub(super) fn axis_pictures<'a>(
    s: Simulation<'a>,
    series: &'a Series,
) -> impl Iterator<Item = Figure<'a>> {
    let axes: Vec<usize> = (0..s.machine.axes().len()).collect();
    // Two axes to a picture, so that a page break does not tear a strip.
    let pairs: Vec<Vec<usize>> = axes.chunks(2).map(<[usize]>::to_vec).collect();
    pairs.into_iter().map(move |pair| {
        Figure::new("", move || {
            let all: Vec<Strip> = pair.iter().flat_map(|i| axis_strips(&s, series, *i)).collect();
            strips(&all, s.summary.time_s, &marks(&s))
        })
    })
}

fn axis_strips(s: &Simulation<'_>, series: &Series, index: usize) -> [Strip; 2] {
    let (axis, unit) = (&s.machine.axes()[index], unit(s.machine, index));
    let ends = match axis.travel {
        Travel::Between(a, b) => vec![shown(s.machine, index, a), shown(s.machine, index, b)],
        Travel::Unlimited | Travel::Unknown => Vec::new(),
    };
    let (speed, speeds) = match axis.limits.velocity.map(|v| shown(s.machine, index, v)) {
        Some(v) => (format!("at most {v:.0} {unit}/s"), vec![-v, v]),
        None => ("limit not stated".to_owned(), Vec::new()),
    };
    let position = Strip {
        title: format!("{}, {unit}", axis.name),
        note: format!("travel {}", travel(s, index)),
        band: series.curve(Quantity::Position(index)).collect(),
        limits: ends,
        least_span: 0.01,
    };
    let speed = Strip {
        title: format!("speed of {}, {unit}/s", axis.name),
        note: speed,
        band: series.curve(Quantity::AxisSpeed(index)).collect(),
        limits: speeds,
        least_span: 0.1,
    };
    [position, speed]
}
