//! Readings: at which commands of the machine which instrument read what.

use super::Kind;
use super::instrument::{Instrument, Sight};
use super::points::read_points;
use super::{Moment, Motion};
use std::fmt::Write as _;
use trueaxis_geometry::Vec3;
use trueaxis_input::{CsvColumn, CsvTable, Diagnostics, Dimension, Place, Unit};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, Axis, AxisKind, Command};
use trueaxis_machine::errors::ErrorValues;
use trueaxis_machine::tcp::TipControl;

/// Readings as columns: one entry a row.
///
/// A value is what the instrument reads in all, mm or rad; in files most are deviations from the
/// nominal reading, but not those of a probe-ball.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Readings {
    /// Programmed axis positions, mm and rad; of a touch probe: where it triggered.
    pub commands: Vec<Command>,
    /// From which side each axis came.
    pub approaches: Vec<Approach>,
    /// Which instrument of the campaign.
    pub instruments: Vec<u32>,
    /// The direction of the station, a unit vector in the frame of the instrument's reference.
    pub directions: Vec<Vec3>,
    /// The reading; channels that the instrument does not have are 0. Unit: mm or rad.
    pub values: Vec<[f64; 3]>,
    /// Readings of one group belong together (one place, one cycle): they are held out together.
    pub groups: Vec<u32>,
    /// When, s.
    pub times_s: Vec<f64>,
    /// How the axes moved.
    pub motions: Vec<Motion>,
    /// The line of the file; 0 if it did not come from one.
    pub lines: Vec<u32>,
}

/// One row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// Programmed axis positions, mm and rad.
    pub command: Command,
    /// From which side each axis came.
    pub approach: Approach,
    /// Which instrument.
    pub instrument: u32,
    /// The direction of the station.
    pub direction: Vec3,
    /// The reading. Unit: mm or rad.
    pub value: [f64; 3],
    /// Its group.
    pub group: u32,
    /// When, s.
    pub time_s: f64,
    /// How the axes moved.
    pub motion: Motion,
    /// The line of the file.
    pub line: u32,
}

impl Readings {
    /// How many rows.
    pub fn len(&self) -> usize {
        self.commands.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.commands.is_empty()
    }

    /// Adds a row.
    pub fn push(&mut self, row: Reading) {
        self.commands.push(row.command);
        self.approaches.push(row.approach);
        self.instruments.push(row.instrument);
        self.directions.push(row.direction);
        self.values.push(row.value);
        self.groups.push(row.group);
        self.times_s.push(row.time_s);
        self.motions.push(row.motion);
        self.lines.push(row.line);
    }

    /// One row.
    pub fn row(&self, i: usize) -> Reading {
        Reading {
            command: self.commands[i],
            approach: self.approaches[i],
            instrument: self.instruments[i],
            direction: self.directions[i],
            value: self.values[i],
            group: self.groups[i],
            time_s: self.times_s[i],
            motion: self.motions[i],
            line: self.lines[i],
        }
    }

    /// How and when a row was read.
    pub fn moment(&self, i: usize) -> Moment {
        Moment {
            approach: self.approaches[i],
            motion: self.motions[i],
            instrument: self.instruments[i],
            time_s: self.times_s[i],
        }
    }

    /// The rows that are wanted, in order.
    pub fn filtered(&self, wanted: impl Fn(usize) -> bool) -> Self {
        let mut some = Self::default();
        for i in (0..self.len()).filter(|i| wanted(*i)) {
            some.push(self.row(i));
        }
        some
    }

    /// Adds the rows of another set; its groups stay apart from ours.
    pub fn append(&mut self, other: &Self) {
        let first = self.groups.iter().max().map_or(0, |g| g + 1);
        for i in 0..other.len() {
            let row = other.row(i);
            self.push(Reading { group: row.group.saturating_add(first), ..row });
        }
    }

    /// Reads the table of one instrument.
    ///
    /// Columns: the axes by letter (mm, deg, or with a unit as `X_in`, `C_rad`; an axis that is not named stands at 0), the channels
    /// of the instrument with their unit (`x_um`, `y_um`, `z_um`; `length_mm`; `deviation_um`;
    /// `angle_urad`), and if wanted `group`, `time_s`, `feed_mm_per_min` (0: standing), the direction `n_x`, `n_y`, `n_z` and the
    /// side from which an axis came, `X_approach` (1, −1). All but `length` and those of a probe-ball
    /// (ball − socket) are deviations from the nominal reading. A touch probe that triggers has no channel: the axes are its reading.
    pub fn parse(
        table: &CsvTable,
        machine: &Machine,
        instrument: &Instrument,
        index: u32,
        problems: &mut Diagnostics,
    ) -> Option<Self> {
        let columns = Columns::find(table, machine, instrument, problems)?;
        let centres = Centres::of(machine, instrument, &columns, table, problems)?;
        let mut readings = Self::default();
        let mut group = 0;
        for row in 0..table.rows() {
            let mut command = Command::default();
            let mut approach = Approach::default();
            for (axis, scale, column) in &columns.axes {
                command[*axis] = column.values[row] * scale;
            }
            for (axis, column) in &columns.approaches {
                approach[*axis] = column.values[row].clamp(-1.0, 1.0);
            }
            let direction = columns.direction(row, instrument.direction);
            let value = match &centres {
                None => columns.value(row, machine, instrument, &command, direction),
                Some(centres) => {
                    let place = || table.row_place(row);
                    centres.put(columns.place(row), &mut command, place, problems)
                }
            };
            // Without a column of groups every place is a group: the same commands are one place.
            let same = row > 0 && readings.commands[row - 1] == command;
            group = match columns.group {
                Some(column) => column.values[row].clamp(0.0, 1e9) as u32,
                None if same || row == 0 => group,
                None => group + 1,
            };
            readings.push(Reading {
                command,
                approach,
                instrument: index,
                direction,
                value,
                group,
                time_s: columns.time_s(row),
                motion: columns.motion(row),
                line: u32::try_from(table.row_place(row).line).unwrap_or(u32::MAX),
            });
        }
        read_points(table, machine, instrument, &mut readings, problems).then_some(readings)
    }

    /// The table of one instrument, as [`Readings::parse`] reads it.
    pub fn table(&self, machine: &Machine, instrument: &Instrument, index: u32) -> String {
        let mine: Vec<usize> = (0..self.len()).filter(|i| self.instruments[*i] == index).collect();
        let directed = mine.iter().any(|i| self.directions[*i] != instrument.direction);
        let approached = mine.iter().any(|i| self.approaches[*i] != Approach::default());
        let fed = mine.iter().any(|i| self.motions[*i].is_moving());
        let mut text = headings(machine, instrument, [directed, approached, fed]);
        for i in mine {
            let row = self.row(i);
            // Writing to a String cannot fail.
            for (axis, q) in
                machine.axes().iter().zip(row.command).filter(|(a, _)| written(instrument, a))
            {
                let shown = if axis.kind == AxisKind::Rotary { q.to_degrees() } else { q };
                let _ = write!(text, "{shown},");
            }
            if approached {
                for side in row.approach.iter().take(machine.axes().len()) {
                    let _ = write!(text, "{side},");
                }
            }
            for shown in shown(instrument, machine, &row) {
                let _ = write!(text, "{shown},");
            }
            if directed {
                let n = row.direction;
                let _ = write!(text, "{},{},{},", n.x, n.y, n.z);
            }
            let _ = write!(text, "{},{}", row.group, row.time_s);
            if fed {
                let feed = row.motion.feed_mm_per_s.unwrap_or(0.0) * 60.0;
                // Nine digits: 2.5 mm/s are 150 mm/min.
                let _ = write!(text, ",{}", (feed * 1e6).round() / 1e6);
            }
            text.push('\n');
        }
        text
    }
}

/// Of a centre that was found only the rotary axes are written: the linear ones follow from where it is.
fn written(instrument: &Instrument, axis: &Axis) -> bool {
    instrument.kind != Kind::BallCentre || axis.kind == AxisKind::Rotary
}

/// The letters of axes by ISO 841.
fn is_axis_letter(name: &str) -> bool {
    name.len() == 1 && "XYZABCUVW".contains(name)
}

/// The channels of a row as they stand in a file.
fn shown(instrument: &Instrument, machine: &Machine, row: &Reading) -> Vec<f64> {
    let channels = channels(instrument);
    if instrument.kind == Kind::BallCentre {
        // The tip must be commanded so far the other way to meet the ball.
        let tool = machine.pose(&row.command, &ErrorValues::default());
        let tip = tool.linear() * instrument.tool_point_mm + tool.shift_mm();
        let from_ball = tip - instrument.reference_point_mm;
        let sign = instrument.reads.sign();
        return channels
            .map(|c| instrument.reference_point_mm[c] + sign * (from_ball[c] - row.value[c]))
            .collect();
    }
    if absolute(instrument) {
        return channels.map(|c| row.value[c]).collect();
    }
    let nominal = match whole(instrument) {
        true => [0.0; 3],
        false => instrument.nominal_reading(machine, &row.command, row.direction),
    };
    let scale = shown_scale(instrument) * instrument.reads.sign();
    channels.map(|c| (row.value[c] - nominal[c]) * scale).collect()
}

/// The column of the feed of the tool against the workpiece.
const FEED: &str = "feed_mm_per_min";

fn channels(instrument: &Instrument) -> std::ops::Range<usize> {
    0..if instrument.kind.triggers() { 0 } else { instrument.sight.channels() }
}

/// Distances are written whole, everything else against its nominal reading.
pub(super) fn absolute(instrument: &Instrument) -> bool {
    instrument.sight == Sight::Distance || instrument.kind == Kind::BallCentre
}

/// A probe-ball reads where the ball is, and points how far they are from their element, not deviations: at a command
/// with few decimals the socket is not quite at the ball, without any error of the machine, and the reading contains that.
fn whole(instrument: &Instrument) -> bool {
    instrument.kind == Kind::ProbeBall || instrument.kind.element().is_some()
}

/// From mm or rad to µm or µrad.
fn shown_scale(instrument: &Instrument) -> f64 {
    if instrument.sight.is_angle() { 1e6 } else { 1e3 }
}

fn headings(
    machine: &Machine,
    instrument: &Instrument,
    [directed, approached, fed]: [bool; 3],
) -> String {
    let axes = machine.axes().iter().filter(|a| written(instrument, a));
    let mut names: Vec<String> = axes.map(|a| a.name.to_string()).collect();
    if approached {
        names.extend(machine.axes().iter().map(|a| format!("{}_approach", a.name)));
    }
    let unit = match (absolute(instrument), instrument.sight.is_angle()) {
        (true, _) => "mm",
        (_, true) => "urad",
        _ => "um",
    };
    let named = &instrument.kind.channels()[channels(instrument)];
    names.extend(named.iter().map(|name| format!("{name}_{unit}")));
    if directed {
        names.extend(["n_x", "n_y", "n_z"].map(str::to_owned));
    }
    names.extend(["group".to_owned(), "time_s".to_owned()]);
    names.extend(fed.then(|| FEED.to_owned()));
    names.join(",") + "\n"
}

/// Farther from its ball than this no centre was found, mm.
const FAR_MM: f64 = 20.0;

/// From places where a ball was found to the axes that stood there.
struct Centres<'a> {
    control: TipControl,
    instrument: &'a Instrument,
}

impl<'a> Centres<'a> {
    /// `Some(None)` for an instrument that finds no centres.
    fn of(
        machine: &Machine,
        instrument: &'a Instrument,
        columns: &Columns<'_>,
        table: &CsvTable,
        problems: &mut Diagnostics,
    ) -> Option<Option<Self>> {
        if instrument.kind != Kind::BallCentre {
            return Some(None);
        }
        let control = TipControl::of(&machine.clone().with_tip(instrument.tool_point_mm));
        if control.is_none() || columns.channels.len() < 3 {
            let message =
                "the tool cannot follow the ball: fewer than three linear axes".to_owned();
            problems.error(
                "cannot-follow",
                Place::whole(&table.file),
                message,
                "kind = \"cut-piece\"",
            );
            return None;
        }
        Some(control.map(|control| Self { control, instrument }))
    }

    /// Sets the linear axes of a command to the ball as it is stated; what is read is how far the tool must have been
    /// off there. At the axes that stood at the place that was found, the answer would be part of the question: errors
    /// that grow with X, Y, Z could undo the motion of the axes themselves.
    fn put(
        &self,
        seen_mm: Vec3,
        command: &mut Command,
        place: impl Fn() -> Place,
        problems: &mut Diagnostics,
    ) -> [f64; 3] {
        let ball = self.instrument.reference_point_mm;
        let from_ball = (seen_mm - ball) * self.instrument.reads.sign();
        let off = from_ball.norm();
        if off.is_nan() || off > FAR_MM {
            let message =
                format!("the ball was found {off:.1} mm from where it is stated to stand");
            let hint = "a wrong row, a wrong unit, or `ball` of the instrument: the place in the workpiece frame";
            problems.error("far-from-ball", place(), message, hint);
        } else if !self.control.place(ball, command) {
            let message = "the linear axes cannot bring the tool to the ball".to_owned();
            problems.error(
                "cannot-follow",
                place(),
                message,
                "is it the place in the workpiece frame?",
            );
        }
        (-from_ball).into()
    }
}

/// Which column is what.
struct Columns<'t> {
    axes: Vec<(usize, f64, &'t CsvColumn)>,
    approaches: Vec<(usize, &'t CsvColumn)>,
    /// The channel, whether it is whole, its unit.
    channels: Vec<(usize, bool, Unit, &'t CsvColumn)>,
    normal: Option<[&'t CsvColumn; 3]>,
    group: Option<&'t CsvColumn>,
    time: Option<(Unit, &'t CsvColumn)>,
    feed: Option<&'t CsvColumn>,
}

impl<'t> Columns<'t> {
    fn find(
        table: &'t CsvTable,
        machine: &Machine,
        instrument: &Instrument,
        problems: &mut Diagnostics,
    ) -> Option<Self> {
        let before = problems.has_errors();
        let mut found = Self {
            axes: Vec::new(),
            approaches: Vec::new(),
            channels: Vec::new(),
            normal: None,
            group: None,
            time: None,
            feed: None,
        };
        for column in &table.columns {
            found.take(column, machine, instrument, problems);
        }
        let normal = ["n_x", "n_y", "n_z"].map(|name| table.column(name));
        if let [Some(x), Some(y), Some(z)] = normal {
            found.normal = Some([x, y, z]);
        }
        let missing = |name: &str| format!("the table has no column for {name}");
        if instrument.kind == Kind::BallCentre {
            found.refuse_linear(machine, problems);
        }
        if found.axes.is_empty() {
            let hint = "head the columns of positions by the letters of the axes: X,Y,Z (mm), A (deg), or X_in, A_rad";
            problems.error("missing-column", Place::whole(&table.file), missing("the axes"), hint);
        }
        // Points without a reading are on the element: the axes are the reading.
        let hits = instrument.kind.element().is_some() && found.channels.is_empty();
        for c in channels(instrument).filter(|_| !hits) {
            if !found.channels.iter().any(|(channel, ..)| *channel == c) {
                let name = instrument.kind.channels()[c];
                let unit = match instrument.sight.is_angle() {
                    true => "urad",
                    false if absolute(instrument) => "mm",
                    false => "um",
                };
                let hint = format!("a {} reads `{name}_{unit}`", instrument.kind.name());
                problems.error("missing-column", Place::whole(&table.file), missing(name), &hint);
            }
        }
        (before || !problems.has_errors()).then_some(found)
    }

    fn take(
        &mut self,
        column: &'t CsvColumn,
        machine: &Machine,
        instrument: &Instrument,
        problems: &mut Diagnostics,
    ) {
        let axis = |name: &str| machine.axes().iter().position(|a| a.name.to_string() == name);
        if let Some(index) = axis(&column.name) {
            let rotary = machine.axes()[index].kind == AxisKind::Rotary;
            let scale = if rotary { 1f64.to_radians() } else { 1.0 };
            return self.take_axis((index, scale), column, problems);
        }
        match column.name.as_str() {
            "n_x" | "n_y" | "n_z" => return,
            "group" => return self.group = Some(column),
            FEED => return self.take_feed(column, problems),
            _ => {}
        }
        let (name, unit) = column.name.rsplit_once('_').unwrap_or((&column.name, ""));
        if let ("time", Ok(unit)) = (name, Unit::find(unit, Dimension::Time)) {
            return self.time = Some((unit, column));
        }
        if let Some(index) = axis(name) {
            if unit == "approach" {
                return self.approaches.push((index, column));
            }
            let dimension = match machine.axes()[index].kind {
                AxisKind::Linear => Dimension::Length,
                AxisKind::Rotary => Dimension::Angle,
            };
            return match Unit::find(unit, dimension) {
                Ok(unit) => self.take_axis((index, unit.to_inner(1.0)), column, problems),
                Err(e) => problems.error(e.code(), column.place.clone(), e.to_string(), &e.hint()),
            };
        }
        if instrument.kind.element().is_some() && ["x", "y", "z"].contains(&name) {
            return; // coordinates in any frame
        }
        let names = instrument.kind.channels();
        let channel = names.iter().position(|n| *n == name);
        // A distance may also be given as its deviation.
        let channel = channel.or((absolute(instrument) && name == "deviation").then_some(0));
        let Some(channel) = channel.filter(|c| channels(instrument).contains(c)) else {
            if is_axis_letter(&column.name) && column.values.iter().any(|v| *v != 0.0) {
                let message = format!("the machine has no axis {}", column.name);
                let hint =
                    format!("readings of another machine? this one is {}", machine.chain_text());
                return problems.error("unknown-axis", column.place.clone(), message, &hint);
            }
            let hint = "known here: the axes, the channels of the instrument, group, time_s, \
                        feed_mm_per_min, n_x n_y n_z, X_approach";
            let message = format!("`{}` says nothing to a {}", column.name, instrument.kind.name());
            return problems.warn("unknown-column", column.place.clone(), message, hint);
        };
        let angle = instrument.sight.is_angle();
        let dimension = if angle { Dimension::Angle } else { Dimension::Length };
        match Unit::find(unit, dimension) {
            Ok(unit) => self.channels.push((channel, name == "length", unit, column)),
            Err(e) => problems.error(e.code(), column.place.clone(), e.to_string(), &e.hint()),
        }
    }

    /// Positions of an axis, with the scale to mm or rad.
    fn take_axis(
        &mut self,
        (index, scale): (usize, f64),
        column: &'t CsvColumn,
        problems: &mut Diagnostics,
    ) {
        if let Some((.., other)) = self.axes.iter().find(|(axis, ..)| *axis == index) {
            let message = format!("`{}` and `{}` are the same axis", other.name, column.name);
            let hint = "keep one of the two columns";
            return problems.error("duplicate-column", column.place.clone(), message, hint);
        }
        self.axes.push((index, scale, column));
    }

    /// The linear axes follow from where the centre was found.
    fn refuse_linear(&self, machine: &Machine, problems: &mut Diagnostics) {
        let linear =
            |(axis, ..): &&(usize, f64, &CsvColumn)| machine.axes()[*axis].kind == AxisKind::Linear;
        if let Some((axis, _, column)) = self.axes.iter().find(linear) {
            let message =
                format!("{} has a column, and so has the place", machine.axes()[*axis].name);
            let hint = "x_mm, y_mm, z_mm say where the centre was found: delete the linear axes, or use kind \
                        \"probe-ball\" with what was read there";
            problems.error("place-twice", column.place.clone(), message, hint);
        }
    }

    /// A feed is 0 (standing) or more.
    fn take_feed(&mut self, column: &'t CsvColumn, problems: &mut Diagnostics) {
        if let Some(row) = column.values.iter().position(|f| *f < 0.0) {
            let mut place = column.place.clone();
            place.line += row + 1;
            let message = format!("a feed of {} mm/min", column.values[row]);
            problems.error("bad-feed", place, message, "0 for standing still, else positive");
        }
        self.feed = Some(column);
    }

    fn motion(&self, row: usize) -> Motion {
        let at = |column: &CsvColumn| Motion::at_feed(column.values[row].max(0.0) / 60.0);
        self.feed.map_or_else(Motion::default, at)
    }

    fn direction(&self, row: usize, usual: Vec3) -> Vec3 {
        let Some(normal) = self.normal else { return usual };
        Vec3::from_iterator(normal.iter().map(|c| c.values[row]))
            .try_normalize(0.0)
            .unwrap_or(usual)
    }

    /// When a row was read; 0 if it is not stated. Unit: s.
    fn time_s(&self, row: usize) -> f64 {
        self.time.map_or(0.0, |(unit, column)| unit.to_inner(column.values[row]))
    }

    /// Where the centre of a ball was found, mm.
    fn place(&self, row: usize) -> Vec3 {
        let mut place = Vec3::zeros();
        for (channel, _, unit, column) in &self.channels {
            place[*channel] = unit.to_inner(column.values[row]);
        }
        place
    }

    fn value(
        &self,
        row: usize,
        machine: &Machine,
        instrument: &Instrument,
        command: &Command,
        direction: Vec3,
    ) -> [f64; 3] {
        if instrument.kind.triggers() {
            return [instrument.length_mm, 0.0, 0.0];
        }
        let nominal = match whole(instrument) {
            true => [0.0; 3],
            false => instrument.nominal_reading(machine, command, direction),
        };
        let mut value = [0.0; 3];
        for (channel, whole, unit, column) in &self.channels {
            let mut read = unit.to_inner(column.values[row]);
            if !*whole {
                read *= instrument.reads.sign();
            }
            let against = match (whole, instrument.length_mm > 0.0) {
                (true, _) => 0.0,
                (false, true) if absolute(instrument) => instrument.length_mm,
                _ => nominal[*channel],
            };
            value[*channel] = read + against;
        }
        value
    }
}
