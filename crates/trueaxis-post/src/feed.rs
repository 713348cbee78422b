//! How fast each block goes.

use crate::cut::Node;
use crate::{FeedRule, PostOptions};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::AxisKind;
use trueaxis_nc::moves::{Feed, FeedMode};

/// Shorter than this a motion has no length that a feed could count along, mm.
const NO_LENGTH_MM: f64 = 1e-9;

/// No control reads larger numbers.
const GREATEST: f64 = 999_999.0;

/// The feed of a block from one place to the next, for a tip that shall go with
/// `tip_feed_mm_per_min`.
///
/// t = |Δtip|/F,  G93: 1/t,  G94 without tool-centre point: |(Δx, Δy, Δz)|/t      docs/model.md eq. 122
///
/// Where the tip stands, the feed counts degrees of the rotary axes, as controls do.
pub(crate) fn feed_of(
    machine: &Machine,
    options: &PostOptions,
    from: &Node,
    to: &Node,
    tip_feed_mm_per_min: f64,
) -> Feed {
    // The control itself keeps the feed of the tip: that of the file is written.
    if let (FeedRule::Tip, Some(_)) = (options.feed, options.tip_words) {
        let (mode, value) = (FeedMode::PerMinute, tip_feed_mm_per_min.min(GREATEST));
        return Feed { mode, value };
    }
    let file = (FeedMode::PerMinute, tip_feed_mm_per_min);
    let (mut linear, mut rotary, mut slowest) = (0.0_f64, 0.0_f64, 0.0_f64);
    for (i, axis) in machine.axes().iter().enumerate() {
        let way = (to.command[i] - from.command[i]).abs();
        match axis.kind {
            AxisKind::Linear => linear = linear.hypot(way),
            AxisKind::Rotary => rotary = rotary.hypot(way),
        }
        if let Some(velocity) = axis.limits.velocity {
            slowest = slowest.max(way / velocity / 60.0);
        }
    }
    let turned_deg = rotary.to_degrees();
    let tip = (to.stand.tip - from.stand.tip).norm();
    let along = if tip > NO_LENGTH_MM { tip } else { turned_deg };
    let wanted = along / tip_feed_mm_per_min;
    // Where the control follows the tip it slows down by itself; numbers for axes stay possible.
    let minutes = match (options.feed, options.tip_words) {
        (FeedRule::Tip, Some(_)) => wanted,
        _ => wanted.max(slowest),
    };
    let (mode, value) = match options.feed {
        FeedRule::InverseTime => (FeedMode::InverseTime, minutes.recip()),
        // The number of the file, not one that rounding has touched.
        _ if minutes == wanted && (options.tip_words.is_some() || rotary == 0.0) => file,
        // The same place again, with axis positions that differ by their rounding.
        _ if rotary == 0.0 && linear <= NO_LENGTH_MM => file,
        _ if moves_mm(machine, options, [from, to]) => {
            let length = if options.tip_words.is_some() { tip } else { linear };
            // Numbers that differ do so by an increment.
            (FeedMode::PerMinute, length.max(1.0 / increments_per_mm(options)) / minutes)
        }
        _ => (FeedMode::PerMinute, turned_deg / minutes),
    };
    Feed { mode, value: value.min(GREATEST) }
}

/// Whether the written places differ, of the tip or of the linear axes, as they are given: where they do not the control counts
/// degrees.
fn moves_mm(machine: &Machine, options: &PostOptions, [from, to]: [&Node; 2]) -> bool {
    let per_mm = increments_per_mm(options);
    let differ = |a: f64, b: f64| (a * per_mm).round_ties_even() != (b * per_mm).round_ties_even();
    match options.tip_words {
        Some(_) => (0..3).any(|i| differ(from.stand.tip[i], to.stand.tip[i])),
        None => machine.axes().iter().enumerate().any(|(i, axis)| {
            axis.kind == AxisKind::Linear && differ(from.command[i], to.command[i])
        }),
    }
}

fn increments_per_mm(options: &PostOptions) -> f64 {
    10_f64.powi(i32::from(options.decimals.linear))
}
