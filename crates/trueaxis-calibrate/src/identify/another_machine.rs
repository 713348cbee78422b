//! Readings that another machine gave, or the same one differently set up: poses beyond the travel, poses off the ball.

use super::checks::deviations;
use super::records::Records;
use trueaxis_input::Diagnostics;
use trueaxis_measure::measure::path::{Strayed, leaves_travel};
use trueaxis_measure::unknowns::design::Design;

/// Rows that are named one by one.
const MOST_NAMED: usize = 3;
/// No ball is placed so badly, no bar is so long or short, mm.
const FAR_MM: f64 = 10.0;
/// Farther outside than this share of the travel no other zero explains it. Unit: 1.
const FAR_OUTSIDE: f64 = 0.1;
/// Rows that are named in one message.
const MOST_LINES: usize = 12;

/// Looks at the poses; errors where most of them cannot be those of this machine.
pub(super) fn check_poses(design: &Design, records: &Records, problems: &mut Diagnostics) {
    check_travel(design, records, problems);
    if problems.has_errors() {
        return;
    }
    check_distance(design, records, problems);
}

/// A zero that is set elsewhere leaves the poses near the travel; another machine does not.
fn check_travel(design: &Design, records: &Records, problems: &mut Diagnostics) {
    let commands = &records.readings.commands;
    let strayed = commands.iter().enumerate();
    let strayed: Vec<(usize, Strayed)> =
        strayed.filter_map(|(i, c)| Some((i, leaves_travel(&design.machine, c)?))).collect();
    let is_far = |strayed: &Strayed| {
        let (from, to) = strayed.travel;
        (from - strayed.position).max(strayed.position - to) > FAR_OUTSIDE * (to - from)
    };
    let far: Vec<&(usize, Strayed)> = strayed.iter().filter(|(_, s)| is_far(s)).collect();
    if let Some((first, words)) = far.first().filter(|_| 2 * far.len() > commands.len()) {
        let message = format!(
            "{} of {} poses are far outside the travel, as this one: {words}",
            far.len(),
            commands.len()
        );
        let hint = "readings of another machine, exchanged columns, another unit or zero? or correct the travel in the \
                    machine file";
        problems.error("readings-of-another-machine", records.place(*first), message, hint);
        return;
    }
    for (row, words) in strayed.iter().take(MOST_NAMED) {
        let hint = "a wrong row? or correct the travel in the machine file";
        problems.warn("outside-travel", records.place(*row), words.to_string(), hint);
    }
    if let Some((row, _)) = strayed.get(MOST_NAMED) {
        let message = format!("{} more like these", strayed.len() - MOST_NAMED);
        problems.note("outside-travel", records.place(*row), message, "");
    }
}

/// The tool stays on a ball, or one length away from it, on the machine that was measured.
fn check_distance(design: &Design, records: &Records, problems: &mut Diagnostics) {
    let readings = &records.readings;
    let deviations = deviations(design, readings);
    for (k, instrument) in design.instruments.iter().enumerate() {
        let mine = (0..readings.len()).filter(|i| readings.instruments[*i] as usize == k);
        let off = mine.map(|i| (deviations[i].iter().map(|v| v * v).sum::<f64>().sqrt(), i));
        let mut off: Vec<(f64, usize)> = off.collect();
        let count = off.iter().filter(|(mm, _)| *mm > FAR_MM).count();
        if !instrument.kind.holds_a_ball() || 2 * count <= off.len() {
            continue;
        }
        off.sort_by(|a, b| b.0.total_cmp(&a.0));
        let Some((mm, row)) = off.first() else { continue };
        let message = format!(
            "{}: {count} of {} poses are more than {FAR_MM} mm off the ball on this machine, this one by {mm:.0} mm",
            instrument.name,
            off.len()
        );
        let hint = "readings of another machine or set-up, exchanged columns, another tool length? `identify \
                    --check-conventions` tries";
        problems.error("readings-of-another-machine", records.place(*row), message, hint);
    }
}

/// Names the rows that fit the others with the opposite sign.
pub(super) fn tell_mixed(rows: &[usize], records: &Records, problems: &mut Diagnostics) {
    let Some(first) = rows.first() else { return };
    let lines = rows.iter().take(MOST_LINES).map(|i| records.readings.lines[*i].to_string());
    let lines = lines.collect::<Vec<_>>().join(", ");
    let more = if rows.len() > MOST_LINES { " …" } else { "" };
    let message =
        format!("{} rows fit the others with the opposite sign: lines {lines}{more}", rows.len());
    let hint = "were they read from the other side, or by another program? one `reads` holds for all rows of an \
                instrument: write them apart, as another instrument, or turn their signs";
    problems.warn("mixed-signs", records.place(*first), message, hint);
}
