//! Further set-ups that may make a combination observable.

use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, AxisKind, Command, Travel};
use trueaxis_machine::twist::Reference;
use trueaxis_measure::instruments::instrument::{SetupError, SetupUnknown};
use trueaxis_measure::measure::path::{FreeSide, Placing, hits, leaves_travel};
use trueaxis_measure::measure::{Campaign, Instrument, Kind, Reading, Readings};
use trueaxis_measure::unknowns::design::Design;

/// Steps of a rotary axis in a trial.
const STEPS: [f64; 5] = [-1.0, -0.5, 0.0, 0.5, 1.0];
/// How far a rotary axis is turned in a trial where it may, rad.
const TURN_RAD: f64 = 1.0;
/// How far a linear axis goes in a trial where its travel is not stated, mm.
const REACH_MM: f64 = 200.0;

/// A further set-up, and what it would look at.
pub(super) struct Trial {
    /// In words.
    pub words: String,
    /// About how long it takes, setting up included.
    pub minutes: u32,
    /// The same unknowns, and after them those of a further instrument.
    pub design: Design,
    /// Where it reads.
    pub stations: Readings,
    /// The unknowns that are other quantities in this set-up: a moved ball stands elsewhere.
    pub fresh: Vec<usize>,
    /// The unknowns that count otherwise here: −1 what is off in a spindle that was turned, 0 the
    /// length of a tool that is known.
    pub changed: Vec<(usize, f64)>,
}

/// What may be done, cheapest first; minutes are those of a practised hand.
pub(super) fn trials(campaign: &Campaign, design: &Design) -> Vec<Trial> {
    let mut trials = Vec::new();
    let rotary = axes_of(&design.machine, AxisKind::Rotary);
    for instrument in 0..design.instruments.len() {
        let name = &design.instruments[instrument].name;
        for axis in &rotary {
            let letter = design.machine.axes()[*axis].name;
            let words = format!("{name} at poses with {letter} turned as well");
            trials.push(same(design, instrument, words, 2, &[*axis]));
        }
        if rotary.len() > 1 {
            let words = format!("{name} at poses with all rotary axes turned");
            trials.push(same(design, instrument, words, 3, &rotary));
        }
        trials.extend(turned_spindle(design, instrument, &rotary));
        trials.extend(known_length(design, instrument, &rotary));
        trials.extend(longer_tool(design, instrument, &rotary));
        trials.extend(moved(design, instrument, &rotary));
    }
    trials.extend(others(campaign, design));
    trials.retain(|t| !t.stations.is_empty());
    trials.sort_by_key(|t| t.minutes);
    trials
}

fn axes_of(machine: &Machine, kind: AxisKind) -> Vec<usize> {
    (0..machine.axes().len()).filter(|i| machine.axes()[*i].kind == kind).collect()
}

fn same(design: &Design, instrument: usize, words: String, minutes: u32, axes: &[usize]) -> Trial {
    let stations = stations(design, instrument, axes);
    Trial {
        words,
        minutes,
        design: design.clone(),
        stations,
        fresh: Vec::new(),
        changed: Vec::new(),
    }
}

/// Unknowns of a set-up by what they displace.
fn fresh(design: &Design, instrument: usize, is_fresh: impl Fn(SetupError) -> bool) -> Vec<usize> {
    let before: usize = design.instruments[..instrument].iter().map(|i| i.unknowns.len()).sum();
    let first = design.terms.len() + before;
    let unknowns = design.instruments[instrument].unknowns.iter().enumerate();
    unknowns.filter(|(_, u)| is_fresh(u.error)).map(|(j, _)| first + j).collect()
}

fn replaced(design: &Design, instrument: usize, by: Instrument) -> Design {
    let mut instruments = design.instruments.clone();
    instruments[instrument] = by;
    Design::new(&design.machine, design.terms.clone(), instruments)
}

/// Half a turn of the spindle takes what sits off its axis to the other side (ISO 230-7: reversal).
fn turned_spindle(design: &Design, instrument: usize, rotary: &[usize]) -> Option<Trial> {
    let off = fresh(design, instrument, |e| matches!(e, SetupError::ToolPoint(0 | 1)));
    let words = "the same poses with the spindle turned by half a turn";
    otherwise(design, instrument, rotary, (words, 4), off.into_iter().map(|k| (k, -1.0)))
}

/// A gauge tool, or one that was measured on a presetter.
fn known_length(design: &Design, instrument: usize, rotary: &[usize]) -> Option<Trial> {
    let length = fresh(design, instrument, |e| matches!(e, SetupError::ToolPoint(2)));
    let words = "the same poses with a second tool whose length is known";
    otherwise(design, instrument, rotary, (words, 5), length.into_iter().map(|k| (k, 0.0)))
}

fn otherwise(
    design: &Design,
    instrument: usize,
    rotary: &[usize],
    (words, minutes): (&str, u32),
    changed: impl Iterator<Item = (usize, f64)>,
) -> Option<Trial> {
    let changed: Vec<(usize, f64)> = changed.collect();
    if changed.is_empty() {
        return None;
    }
    let words = format!("{}, {words}", design.instruments[instrument].name);
    let stations = stations(design, instrument, rotary);
    let design = design.clone();
    Some(Trial { words, minutes, design, stations, fresh: Vec::new(), changed })
}

/// What is at the tip is at the tip of a longer tool; how long that is, is known.
fn longer_tool(design: &Design, instrument: usize, rotary: &[usize]) -> Option<Trial> {
    let own = &design.instruments[instrument];
    if matches!(own.kind, Kind::LaserAngle | Kind::CutPiece) {
        return None;
    }
    let mut longer = own.clone();
    longer.tool_point_mm.z -= 60.0;
    let design = replaced(design, instrument, longer);
    let stations = stations(&design, instrument, rotary);
    let words = format!("{}, the same poses with a second tool, 60 mm longer", own.name);
    Some(Trial { words, minutes: 5, design, stations, fresh: Vec::new(), changed: Vec::new() })
}

/// The ball or the instrument at another place of the table.
fn moved(design: &Design, instrument: usize, rotary: &[usize]) -> Vec<Trial> {
    let own = &design.instruments[instrument];
    if !own.kind.holds_a_ball() {
        return Vec::new();
    }
    let what = own.kind.reference_point().replace('_', " ");
    let places = [
        (format!("{} with its {what} 60 mm higher", own.name), Vec3::new(0.0, 0.0, 60.0)),
        (format!("{} with its {what} 60 mm farther out", own.name), out_by(design, own)),
    ];
    let trial = |(words, by): (String, Vec3)| {
        let mut other = own.clone();
        other.reference_point_mm += by;
        let design = replaced(design, instrument, other);
        let stations = stations(&design, instrument, rotary);
        let elsewhere = |e: SetupError| {
            matches!(e, SetupError::ReferencePoint(_) | SetupError::ReferenceTurn(_))
        };
        let fresh = fresh(&design, instrument, elsewhere);
        Trial { words, minutes: 8, design, stations, fresh, changed: Vec::new() }
    };
    places.into_iter().map(trial).collect()
}

/// Away from the last axis that turns the table, else along x.
fn out_by(design: &Design, own: &Instrument) -> Vec3 {
    let axes = axes_of(&design.machine, AxisKind::Rotary);
    let moved = axes.first().map(|axis| {
        let at = Command::default();
        let (moved, about) = trueaxis_measure::measure::path::turns_about(
            &design.machine,
            *axis,
            &at,
            own.reference_point_mm,
        );
        moved.cross(&about)
    });
    moved.and_then(|v| v.try_normalize(1e-6)).unwrap_or_else(Vec3::x) * 60.0
}

/// Instruments that the campaign does not have.
fn others(campaign: &Campaign, design: &Design) -> Vec<Trial> {
    let has = |kind: Kind| campaign.instruments.iter().any(|i| i.kind == kind);
    let everywhere: Vec<usize> = (0..design.machine.axes().len()).collect();
    let mut trials = Vec::new();
    let further = |kind: Kind, name: &str, reference, direction, axes: &[usize], words, minutes| {
        let mut own = further_instrument(&design.machine, kind, name, reference, direction);
        own.unknowns.extend(unknown_tool_point(design, kind));
        let mut instruments = design.instruments.clone();
        instruments.push(own);
        let first = design.unknowns();
        let design = Design::new(&design.machine, design.terms.clone(), instruments);
        let stations = stations(&design, design.instruments.len() - 1, axes);
        let fresh = (first..design.unknowns()).collect();
        Trial { words, minutes, design, stations, fresh, changed: Vec::new() }
    };
    if !has(Kind::BallBar) {
        let words = "a ball-bar between table and spindle, all axes moved".to_owned();
        let table = Reference::Workpiece;
        trials.push(further(Kind::BallBar, "bar", table, Vec3::x(), &everywhere, words, 15));
    }
    if !has(Kind::LaserAngle) {
        for (letter, direction) in [('x', Vec3::x()), ('y', Vec3::y()), ('z', Vec3::z())] {
            for (reference, at) in [(Reference::Workpiece, "table"), (Reference::Bed, "floor")] {
                let words = format!(
                    "angles of the spindle about {letter} against the {at} (electronic level, \
                     autocollimator)"
                );
                let axes = &everywhere;
                trials.push(further(
                    Kind::LaserAngle,
                    "level",
                    reference,
                    direction,
                    axes,
                    words,
                    20,
                ));
            }
        }
    }
    if !has(Kind::LaserLine) {
        for axis in axes_of(&design.machine, AxisKind::Linear) {
            let name = design.machine.axes()[axis].name;
            let direction = design.machine.axes()[axis].direction;
            let words = format!("a laser along {name}");
            let table = Reference::Workpiece;
            trials.push(further(Kind::LaserLine, "laser", table, direction, &[axis], words, 30));
        }
    }
    if !has(Kind::LengthTracker) {
        let words = "a length tracker (multilateration) on the table".to_owned();
        let (kind, table) = (Kind::LengthTracker, Reference::Workpiece);
        trials.push(further(kind, "tracker", table, Vec3::x(), &everywhere, words, 60));
    }
    trials
}

/// Who does not know where one instrument sits in the spindle does not know it of another either.
fn unknown_tool_point(design: &Design, kind: Kind) -> Vec<SetupUnknown> {
    let mut unknown: Vec<SetupUnknown> = Vec::new();
    for own in design.instruments.iter().flat_map(|i| &i.unknowns) {
        let is_new = !unknown.iter().any(|u| u.error == own.error);
        if matches!(own.error, SetupError::ToolPoint(_)) && is_new && !kind.sight().is_angle() {
            unknown.push(SetupUnknown { name: kind.unknown_name(own.error), ..own.clone() });
        }
    }
    unknown
}

fn further_instrument(
    machine: &Machine,
    kind: Kind,
    name: &str,
    reference: Reference,
    direction: Vec3,
) -> Instrument {
    let reference_point_mm = match kind {
        Kind::LengthTracker => Vec3::new(40.0, -700.0, 90.0),
        _ => Vec3::zeros(),
    };
    Instrument {
        name: name.to_owned(),
        reference,
        reference_point_mm,
        direction,
        length_mm: if kind == Kind::BallBar { 150.0 } else { 0.0 },
        ..Instrument::usual(kind, machine)
    }
}

/// Where an instrument would read: every combination of some turned axes (and linear ones where it
/// does not follow a ball), inside the travel.
fn stations(design: &Design, instrument: usize, axes: &[usize]) -> Readings {
    let own = &design.instruments[instrument];
    let machine = &design.machine;
    let follows = own.kind.holds_a_ball() || own.kind.element().is_some();
    let placing = follows.then(|| Placing::of(machine, own).ok()).flatten();
    let turned: Vec<usize> = axes
        .iter()
        .copied()
        .filter(|i| placing.is_none() || machine.axes()[*i].kind == AxisKind::Rotary)
        .collect();
    let mut stations = Readings::default();
    let count = STEPS.len().pow(turned.len().min(2) as u32).max(1);
    // More than two axes are not combined but go at rates of their own (Kronecker).
    let count = if turned.len() > 2 { 60 } else { count };
    for k in 0..count {
        let mut command = Command::default();
        let mut rest = k;
        for (place, axis) in turned.iter().enumerate() {
            let share = if turned.len() > 2 {
                const RATES: [f64; 6] = [0.414_2, 0.732_1, 0.236_1, 0.645_8, 0.316_6, 0.605_6];
                2.0 * ((k + 1) as f64 * RATES[place.min(5)]).fract() - 1.0
            } else {
                let share = STEPS[rest % STEPS.len()];
                rest /= STEPS.len();
                share
            };
            command[*axis] = within(machine, *axis, share);
        }
        for (command, direction) in read_at(own, placing.as_ref(), machine, &command) {
            stations.push(Reading {
                command,
                approach: Approach::default(),
                instrument: u32::try_from(instrument).unwrap_or(u32::MAX),
                direction,
                value: [0.0; 3],
                group: u32::try_from(k).unwrap_or(u32::MAX),
                time_s: 0.0,
                motion: trueaxis_measure::measure::Motion::default(),
                line: 0,
            });
        }
    }
    stations
}

/// A share −1 … 1 of what an axis is moved in a trial.
fn within(machine: &Machine, axis: usize, share: f64) -> f64 {
    let axis = &machine.axes()[axis];
    let usual = if axis.kind == AxisKind::Rotary { TURN_RAD } else { REACH_MM };
    match axis.travel {
        Travel::Between(from, to) if axis.kind == AxisKind::Linear => {
            0.5 * (from + to) + 0.5 * (to - from) * share
        }
        Travel::Between(from, to) => (usual * share).clamp(from, to),
        _ => usual * share,
    }
}

/// What an instrument reads where the rotary axes stand like that.
fn read_at(
    own: &Instrument,
    placing: Option<&Placing>,
    machine: &Machine,
    rotary: &Command,
) -> Vec<(Command, Vec3)> {
    if let (Some(placing), Some(element)) = (placing, own.kind.element()) {
        let points = element.points_mm(6, own.direction, own.length_mm, [60.0; 2]);
        let placed =
            points.iter().filter_map(|d| placing.place(own.reference_point_mm + d, rotary));
        let inside = placed.filter(|c| leaves_travel(machine, c).is_none());
        return inside.map(|c| (c, own.direction)).collect();
    }
    let directions = match (placing, own.kind) {
        (Some(placing), Kind::TouchProbeBall) => {
            hits(FreeSide { stem: -Vec3::z() }, placing.tool_axis(rotary), 5)
        }
        (Some(_), Kind::BallBar) => {
            [Vec3::x(), Vec3::y(), Vec3::new(0.5, 0.5, 1.0).normalize()].to_vec()
        }
        _ => vec![own.direction],
    };
    let contact = |direction: Vec3| {
        let command = placing.map_or(Some(*rotary), |p| p.contact(direction, rotary));
        command.filter(|c| leaves_travel(machine, c).is_none()).map(|c| (c, direction))
    };
    directions.into_iter().filter_map(contact).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueaxis_machine::file::NoTables;

    /// Places of a trial are within the travel, wherever it lies, and reach both of its ends.
    #[test]
    fn law_a_share_of_the_travel_is_a_place_within_it() {
        let text = "[machine]\nname = \"m\"\nchain = \"w C A b X Y Z t\"\n[axis.X]\ntravel = [\"-700 mm\", \"-300 mm\"]\n[axis.A]\ntravel = [\"-10 deg\", \"95 deg\"]\n";
        let machine = Machine::check("m", text, &NoTables).0.expect("a machine");
        let axis = |name: &str| {
            machine.axes().iter().position(|a| a.name.to_string() == name).expect("an axis")
        };
        for (share, due) in [(-1.0, -700.0), (-0.5, -600.0), (0.0, -500.0), (1.0, -300.0)] {
            assert_eq!(within(&machine, axis("X"), share), due);
        }
        // A rotary axis turns about its zero; where its travel ends before, to that end.
        assert!((within(&machine, axis("A"), -1.0).to_degrees() + 10.0).abs() < 1e-9);
        assert_eq!(within(&machine, axis("A"), 0.0), 0.0);
        assert_eq!(within(&machine, axis("C"), 1.0), TURN_RAD);
    }
}
