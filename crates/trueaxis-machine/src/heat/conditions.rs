//! Conditions: the readings of the temperature sensors, typed or from a log.

use std::sync::Arc;
use trueaxis_input::plausible::{Limits, Quantity, Standing};
use trueaxis_input::{
    CsvTable, Diagnostic, Diagnostics, Dimension, Place, Section, Severity, Unit, parse_quantity,
};

/// Smaller steps between two rows of a log are noise, K.
const JUMP_K: f64 = 2.0;
/// No body of a machine warms or cools faster, K/s.
const FASTEST_K_PER_S: f64 = 0.2;
/// Limit for a step that is also many times the usual one of its sensor, K.
const LARGE_JUMP_K: f64 = 5.0;
/// Another must have moved by so much before a sensor that never moves is stuck, K.
const MOVING_K: f64 = 0.5;
/// The same before one that stops moving is stuck, K: bodies do not all feel the same heat.
const MOVING_ON_K: f64 = 2.0;
/// A log needs so many rows before its sensors are judged, and a sensor so many equal ones.
const ROWS_TO_JUDGE: usize = 10;
/// No log is longer, s (300 years); beyond, differences of times lose their digits.
const LONGEST_S: f64 = 1e10;

/// The reading of one sensor, and the place where it was written.
#[derive(Debug, Clone, PartialEq)]
struct Reading {
    sensor: String,
    celsius: f64,
    place: Place,
}

/// The temperatures of all sensors at one time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Conditions {
    readings: Vec<Reading>,
    /// What was before, and the time now, s.
    history: Option<(Arc<TemperatureLog>, f64)>,
    place: Place,
}

impl Conditions {
    /// Reads `scale_x=30.5 workpiece=31`: °C, or with a unit (`scale_x=30.5degC`); `argument` is
    /// where problems are shown.
    pub fn typed(argument: &str, text: &str, problems: &mut Diagnostics) -> Option<Self> {
        let place = Place::whole(argument);
        let mut found = Self { place: place.clone(), ..Self::default() };
        let separated = text.contains([',', ';']);
        let between = |c: char| if separated { matches!(c, ',' | ';') } else { c.is_whitespace() };
        let mut sound = true;
        for word in text.split(between).map(str::trim).filter(|w| !w.is_empty()) {
            let celsius = word.split_once('=').and_then(|(sensor, value)| {
                let celsius = value.trim().parse().ok().filter(|v: &f64| v.is_finite());
                let celsius = celsius
                    .or_else(|| parse_quantity(value.trim(), Dimension::Temperature).ok())?;
                Some((sensor.trim().to_owned(), celsius))
            });
            let Some((sensor, celsius)) = celsius.filter(|(sensor, _)| !sensor.is_empty()) else {
                let message = format!("expected sensor=temperature, found `{word}`");
                problems.error("bad-temperature", place.clone(), message, hint_for(word));
                sound = false;
                continue;
            };
            sound &= found.add(sensor, celsius, place.clone(), (&Limits::default(), problems));
        }
        sound.then_some(found)
    }

    /// Reads a section: `[temperature] scale_x = "30.5 degC"`.
    pub fn read(section: &Section<'_>) -> Self {
        let mut found = Self::default();
        let mut problems = Diagnostics::new();
        for (sensor, place, item) in section.entries() {
            if found.place.file.is_empty() {
                found.place = place.clone();
            }
            if let Some(celsius) = item.unjudged(Dimension::Temperature) {
                let limits = section.limits();
                found.add(sensor.to_owned(), celsius, place, (&limits, &mut problems));
            }
        }
        section.take_over(problems);
        found
    }

    fn add(
        &mut self,
        sensor: String,
        celsius: f64,
        place: Place,
        (limits, problems): (&Limits, &mut Diagnostics),
    ) -> bool {
        if self.celsius(&sensor).is_some() {
            let message = format!("sensor `{sensor}` is given twice");
            problems.error("duplicate-sensor", place, message, "keep one of them");
            return false;
        }
        let sound = check_range((&sensor, celsius), &place, limits, problems);
        self.readings.push(Reading { sensor, celsius, place });
        sound
    }

    /// The same with one more reading, °C; one that is there stays.
    #[must_use]
    pub fn with_reading(mut self, sensor: &str, celsius: f64) -> Self {
        if self.celsius(sensor).is_none() {
            let place = self.place.clone();
            self.readings.push(Reading { sensor: sensor.to_owned(), celsius, place });
        }
        self
    }

    /// The reading of a sensor, °C.
    pub fn celsius(&self, sensor: &str) -> Option<f64> {
        self.readings.iter().find(|r| r.sensor == sensor).map(|r| r.celsius)
    }

    /// The sensors with a reading, °C.
    pub fn readings(&self) -> impl Iterator<Item = (&str, f64)> {
        self.readings.iter().map(|r| (r.sensor.as_str(), r.celsius))
    }

    /// The log that these conditions were taken from, and at which time, s.
    pub fn history(&self) -> Option<(&TemperatureLog, f64)> {
        self.history.as_ref().map(|(log, time)| (&**log, *time))
    }

    /// Where they were written.
    pub fn place(&self) -> &Place {
        &self.place
    }

    /// Sensors that the machine does not have.
    pub(super) fn check_names(&self, known: &[&str], problems: &mut Diagnostics) {
        for reading in self.readings.iter().filter(|r| !known.contains(&r.sensor.as_str())) {
            let message = format!("the machine file has no sensor `{}`", reading.sensor);
            let hint = match known.is_empty() {
                true => "the machine file has no sensors: add them to [scale.X], [heat.EZ0t] or \
                     [workpiece]"
                    .to_owned(),
                false => format!("sensors of the machine file: {}", known.join(", ")),
            };
            // A log may have more columns than this machine has sensors.
            if self.history.is_some() {
                problems.warn("unknown-sensor", reading.place.clone(), message, &hint);
            } else {
                problems.error("unknown-sensor", reading.place.clone(), message, &hint);
            }
        }
    }

    /// The readings of the sensors of one body: of all of them or of none; an incomplete set is an error.
    pub(super) fn of<'s>(
        &self,
        body: &str,
        sensors: impl Iterator<Item = &'s str> + Clone,
        problems: &mut Diagnostics,
    ) -> Option<Vec<f64>> {
        let missing: Vec<&str> = sensors.clone().filter(|s| self.celsius(s).is_none()).collect();
        if missing.is_empty() {
            return Some(sensors.filter_map(|s| self.celsius(s)).collect());
        }
        let names = missing.join(", ");
        if missing.len() < sensors.count() {
            let message = format!("{body}: no temperature for {names}");
            let hint = "state the temperatures of all sensors of a body, or of none";
            problems.error("missing-sensor", self.place.clone(), message, hint);
        } else {
            let message =
                format!("{body}: no temperature for {names}; its thermal errors are not included");
            // Of a workpiece there is no table: its drawing holds at 20 °C.
            let hint = match body {
                "workpiece" => "20 °C, the temperature of its drawing, is assumed",
                _ => "the temperature of its error table is assumed",
            };
            problems.note("missing-sensor", self.place.clone(), message, hint);
        }
        None
    }
}

fn hint_for(word: &str) -> &'static str {
    match word.trim_end().ends_with(['F', 'f']) {
        true => "°C = (°F − 32)/1.8",
        false => "write \"scale_x=30.5 workpiece=31\", in °C",
    }
}

/// Above it a temperature is warm, below it cold (ISO 1).
const REFERENCE_CELSIUS: f64 = 20.0;

/// Whether a temperature is one of a workshop, °C; an impossible one is an error, a warm or a cold one a warning.
pub fn check_range(
    (sensor, celsius): (&str, f64),
    place: &Place,
    limits: &Limits,
    problems: &mut Diagnostics,
) -> bool {
    let standing = limits.standing(Quantity::Temperature, celsius);
    if standing == Standing::Impossible {
        let message = format!("`{sensor}` reads {celsius} °C, outside the range of machines");
        let hint = "check the unit and the column: °C = (°F − 32)/1.8 = K − 273.15";
        problems.error("impossible-temperature", place.clone(), message, hint);
        return false;
    }
    if standing == Standing::Odd && celsius < REFERENCE_CELSIUS {
        let message = format!("`{sensor}` reads {celsius} °C, colder than a workshop");
        let hint = "check the sign and the sensor; a cold hall: [plausible] temperature_celsius = [-20, 45]";
        problems.warn("implausible-value", place.clone(), message, hint);
    } else if standing == Standing::Odd {
        let message = format!("`{sensor}` reads {celsius} °C, warmer than a workshop");
        let hint = "if these are °F: °C = (°F − 32)/1.8";
        problems.warn("warm-temperature", place.clone(), message, hint);
    }
    true
}

/// Temperatures over time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TemperatureLog {
    file: String,
    times_s: Vec<f64>,
    columns: Vec<(String, Vec<f64>)>,
}

impl TemperatureLog {
    /// Reads a CSV table: `time_s` (or another unit of time), then one column for each sensor with
    /// its unit, such as `scale_x_degC`.
    ///
    /// Times that run backwards and impossible temperatures are errors; sensors that do not change
    /// while others move, or jump, are warnings.
    pub fn parse(file: &str, text: &str, problems: &mut Diagnostics) -> Option<Self> {
        let mut found = Diagnostics::new();
        let table = CsvTable::parse(file, text, &mut found);
        let sound = !found.has_errors();
        problems.append(found);
        if sound { Self::from_table(&table, problems) } else { None }
    }

    /// The same from a table that was read already, without errors.
    pub fn from_table(table: &CsvTable, problems: &mut Diagnostics) -> Option<Self> {
        let mut found = Diagnostics::new();
        let mut log = Self { file: table.file.clone(), ..Self::default() };
        log.read_columns(table, &mut found);
        log.check_times(table, &mut found);
        for (name, values) in &log.columns {
            log.check_sensor(name, values, table, &mut found);
        }
        let sound = !found.has_errors();
        problems.append(found);
        sound.then_some(log)
    }

    fn read_columns(&mut self, table: &CsvTable, problems: &mut Diagnostics) {
        for column in &table.columns {
            let (name, unit) = column.name.rsplit_once('_').unwrap_or((&column.name, ""));
            let dimension = if name == "time" { Dimension::Time } else { Dimension::Temperature };
            let unit = match Unit::find(unit, dimension) {
                Ok(unit) => unit,
                Err(error) => {
                    let hint = match unit.to_ascii_lowercase().ends_with('f') {
                        true => "convert it first: °C = (°F − 32)/1.8",
                        false => {
                            "write time_s first, then one column for each sensor, such as \
                             scale_x_degC"
                        }
                    };
                    let message = format!("column `{}`: {error}", column.name);
                    problems.error(error.code(), column.place.clone(), message, hint);
                    continue;
                }
            };
            let values: Vec<f64> = column.values.iter().map(|v| unit.to_inner(*v)).collect();
            let twice = match dimension {
                Dimension::Time => !self.times_s.is_empty(),
                _ => self.celsius(name).is_some(),
            };
            if twice {
                let message = format!("`{name}` has two columns");
                let hint = "keep the column with the right unit";
                problems.error("duplicate-column", column.place.clone(), message, hint);
            } else if dimension == Dimension::Time {
                self.times_s = values;
            } else {
                self.columns.push((name.to_owned(), values));
            }
        }
        let lacks = match (self.times_s.is_empty(), self.columns.is_empty()) {
            (true, _) => Some((
                "the log has no column of times or no row",
                "add a column `time_s` and at least one row",
            )),
            (_, true) => Some((
                "the log has no column of a sensor",
                "add one column for each sensor, such as scale_x_degC",
            )),
            _ => None,
        };
        if let (Some((message, hint)), false) = (lacks, problems.has_errors()) {
            let place = Place::whole(&self.file);
            problems.error("missing-column", place, message.to_owned(), hint);
        }
    }

    fn check_times(&self, table: &CsvTable, problems: &mut Diagnostics) {
        if let Some(row) = self.times_s.iter().position(|t| t.abs() > LONGEST_S) {
            let message = format!("the time is {:e} s, more than 300 years", self.times_s[row]);
            let hint = "state times from the start of the log, in s, min or h";
            problems.error("impossible-time", table.row_place(row), message, hint);
        }
        let back = self.times_s.windows(2).position(|w| w[1] <= w[0]);
        if let Some(i) = back {
            let (before, now) = (self.times_s[i], self.times_s[i + 1]);
            let message = format!("the time decreases or repeats: {now} s after {before} s");
            let hint =
                "times must increase from row to row: check for swapped columns and joined logs";
            problems.error("time-runs-backwards", table.row_place(i + 1), message, hint);
        }
    }

    /// The first row of each kind of problem is enough.
    fn check_sensor(
        &self,
        name: &str,
        values: &[f64],
        table: &CsvTable,
        problems: &mut Diagnostics,
    ) {
        let place = |row: usize| table.row_place(row);
        let limits = Limits::default();
        let first = |wanted: Standing| {
            let is = |v: &f64| limits.standing(Quantity::Temperature, *v) == wanted;
            values.iter().position(is)
        };
        if let Some(row) = first(Standing::Impossible).or_else(|| first(Standing::Odd)) {
            check_range((name, values[row]), &place(row), &limits, problems);
        }
        if let Some((from, to)) = self.stuck(values) {
            let message = match to - from == values.len() {
                true => format!("`{name}` stays at {} °C while other sensors change", values[0]),
                false => format!(
                    "`{name}` stays at {} °C for {} rows while other sensors change",
                    values[from],
                    to - from
                ),
            };
            problems.warn(
                "stuck-sensor",
                place(from),
                message,
                "check whether the sensor is connected",
            );
        }
        if let Some(row) = self.jump(values) {
            let (from, to) = (values[row - 1], values[row]);
            let seconds = self.times_s[row] - self.times_s[row - 1];
            let message = format!("`{name}` jumps from {from} to {to} °C within {seconds} s");
            let hint = "the temperature of a machine body changes by at most 12 K/min: check for \
                a loose sensor, swapped columns and joined logs";
            problems.warn("jumping-sensor", place(row), message, hint);
        }
    }

    /// The rows in which a sensor reads the same to the last digit while another one changes.
    fn stuck(&self, values: &[f64]) -> Option<(usize, usize)> {
        if values.len() < ROWS_TO_JUDGE || self.times_s.len() != values.len() {
            return None;
        }
        let mut from = 0;
        for run in values.chunk_by(|a, b| a == b) {
            let rows = from..from + run.len();
            from = rows.end;
            let whole = run.len() == values.len();
            if !whole && run.len() < ROWS_TO_JUDGE.max(values.len() / 4) {
                continue;
            }
            let least = if whole { MOVING_K } else { MOVING_ON_K };
            if self.columns.iter().any(|(_, other)| range(&other[rows.clone()]) >= least) {
                return Some((rows.start, rows.end));
            }
        }
        None
    }

    /// The first row whose step is no step of a body: too fast, or many times the usual one.
    fn jump(&self, values: &[f64]) -> Option<usize> {
        if self.times_s.len() != values.len() {
            return None;
        }
        let mut steps: Vec<f64> = values.windows(2).map(|w| (w[1] - w[0]).abs()).collect();
        let seconds = self.times_s.windows(2).map(|w| w[1] - w[0]);
        let is_fast = |(step, s): (&f64, f64)| *step > JUMP_K && *step > FASTEST_K_PER_S * s;
        let fast = steps.iter().zip(seconds).position(is_fast);
        let large = steps.iter().position(|s| *s > LARGE_JUMP_K);
        let large = large.filter(|_| values.len() >= ROWS_TO_JUDGE).filter(|&row| {
            let height = steps[row];
            steps.sort_by(f64::total_cmp);
            height > 10.0 * steps[steps.len() / 2]
        });
        [fast, large].into_iter().flatten().min().map(|row| row + 1)
    }

    /// The file that it was read from.
    pub fn file(&self) -> &str {
        &self.file
    }

    /// What is wrong with a time that it does not cover.
    pub fn outside(&self, time_s: f64) -> Diagnostic {
        let first = self.times_s.first().copied().unwrap_or(0.0);
        let last = self.times_s.last().copied().unwrap_or(0.0);
        Diagnostic {
            code: "outside-log",
            severity: Severity::Error,
            place: Place::whole(&self.file),
            message: format!("{time_s} s lies outside the log, which covers {first} s to {last} s"),
            hint: "choose a time within the log".to_owned(),
        }
    }

    /// The sensors that the log knows.
    pub fn sensors(&self) -> impl Iterator<Item = &str> {
        self.columns.iter().map(|c| c.0.as_str())
    }

    /// When it was written, s, rising.
    pub fn times_s(&self) -> &[f64] {
        &self.times_s
    }

    /// What a sensor said at each time, °C.
    pub fn celsius(&self, sensor: &str) -> Option<&[f64]> {
        self.columns.iter().find(|c| c.0 == sensor).map(|c| c.1.as_slice())
    }

    /// The conditions at a time, between two rows by straight lines; `None` outside the log.
    pub fn at(self: &Arc<Self>, time_s: f64) -> Option<Conditions> {
        let (first, last) = (*self.times_s.first()?, *self.times_s.last()?);
        if !(first..=last).contains(&time_s) {
            return None;
        }
        let right = self.times_s.partition_point(|t| *t < time_s).max(1);
        let place = Place::whole(&self.file);
        let between = |values: &[f64]| match self.times_s.get(right) {
            None => values[0],
            Some(t1) => {
                let t0 = self.times_s[right - 1];
                values[right - 1] + (values[right] - values[right - 1]) * (time_s - t0) / (t1 - t0)
            }
        };
        let readings = self.columns.iter().map(|(sensor, values)| Reading {
            sensor: sensor.clone(),
            celsius: between(values),
            place: place.clone(),
        });
        let readings = readings.collect();
        Some(Conditions { readings, history: Some((Arc::clone(self), time_s)), place })
    }
}

/// From the lowest to the highest.
fn range(values: &[f64]) -> f64 {
    let ends = (f64::INFINITY, f64::NEG_INFINITY);
    let (low, high) = values.iter().fold(ends, |(l, h), v| (l.min(*v), h.max(*v)));
    high - low
}

#[cfg(test)]
mod tests {
    use super::*;

    fn codes(text: &str) -> Vec<&'static str> {
        let mut problems = Diagnostics::new();
        TemperatureLog::parse("log.csv", text, &mut problems);
        problems.iter().map(|d| d.code).collect()
    }

    #[test]
    fn a_log_is_read_between_its_rows() {
        let mut problems = Diagnostics::new();
        let text = "time_min,scale_x_degC\n0,20\n10,30\n";
        let log = TemperatureLog::parse("log.csv", text, &mut problems).map(Arc::new).unwrap();
        assert_eq!(log.at(150.0).unwrap().celsius("scale_x"), Some(22.5));
        assert_eq!(log.at(600.0).unwrap().celsius("scale_x"), Some(30.0));
        assert!(log.at(601.0).is_none());
        assert!(problems.iter().next().is_none());
    }

    #[test]
    fn bad_logs_are_named() {
        assert_eq!(codes("time_s,a_degC\n0,20\n10,21\n5,22\n"), ["time-runs-backwards"]);
        assert_eq!(codes("time_s,a_degC\n0,20\n0,21\n"), ["time-runs-backwards"]);
        assert_eq!(codes("time_s,a_degC\n0,20\n1e300,21\n"), ["too-large"]);
        assert_eq!(codes("time_s,a_degF\n0,68\n"), ["unknown-unit"]);
        assert_eq!(
            codes("time_s,a_degC\n0,20\n10,3600\n"),
            ["impossible-temperature", "jumping-sensor"]
        );
        // °F in a column of °C.
        assert_eq!(codes("time_s,a_degC\n0,68\n10,70\n"), ["warm-temperature"]);
        assert_eq!(codes("a_degC\n20\n"), ["missing-column"]);
        assert_eq!(codes("time_s\n0\n"), ["missing-column"]);
        assert_eq!(codes("time_s,a_degC\n"), ["missing-column"]);
        assert_eq!(codes("time_s,a_degC\n0,nan\n"), ["not-a-number"]);
        assert_eq!(codes("time_s,a_degC\n0,inf\n"), ["not-a-number"]);
        assert_eq!(codes("time_s,a_degC\n0\n"), ["ragged-row"]);
        assert_eq!(codes("time_s,time_min,a_degC\n0,0,20\n"), ["duplicate-column"]);
        // The two columns swapped.
        let swapped = codes("time_s,a_degC\n20.0,0\n20.1,60\n20.1,120\n20.3,180\n");
        assert_eq!(swapped, ["time-runs-backwards", "impossible-temperature", "jumping-sensor"]);
    }

    #[test]
    fn stuck_and_jumping_sensors_are_named() {
        let rows = |f: fn(usize) -> String| (0..20).map(f).collect::<String>();
        let stuck = rows(|i| format!("{i},21,{}\n", 20.0 + 0.1 * i as f64));
        assert_eq!(codes(&format!("time_s,a_degC,b_degC\n{stuck}")), ["stuck-sensor"]);
        // It stops in row 8 of 20, while the other goes on by 0.3 K a row.
        let stops = rows(|i| format!("{i},{},{}\n", 0.3 * i.min(8) as f64, 20.0 + 0.3 * i as f64));
        assert_eq!(codes(&format!("time_min,a_degC,b_degC\n{stops}")), ["stuck-sensor"]);
        // A hall at rest: nothing moves.
        let rest = rows(|i| format!("{i},21,20\n"));
        assert!(codes(&format!("time_s,a_degC,b_degC\n{rest}")).is_empty());
        let jumps =
            rows(|i| format!("{i},{}\n", if i == 7 { 35.0 } else { 20.0 + 0.1 * i as f64 }));
        assert_eq!(codes(&format!("time_s,a_degC\n{jumps}")), ["jumping-sensor"]);
        // In slow rows too, where the other steps are small; day and night are no jumps.
        let slow =
            rows(|i| format!("{},{}\n", 10 * i, if i < 7 { 20.0 } else { 35.0 } + 0.1 * i as f64));
        assert_eq!(codes(&format!("time_min,a_degC\n{slow}")), ["jumping-sensor"]);
        let nights = rows(|i| format!("{},{}\n", 720 * i, 18 + 7 * (i % 2)));
        assert!(codes(&format!("time_min,a_degC\n{nights}")).is_empty());
        // 3 K are a jump in 1 s, not in 10 min.
        assert_eq!(codes("time_s,a_degC\n0,20\n1,23\n"), ["jumping-sensor"]);
        assert!(codes("time_min,a_degC\n0,20\n10,23\n").is_empty());
    }

    #[test]
    fn typed_temperatures() {
        let typed = |text: &str| {
            let mut problems = Diagnostics::new();
            let found = Conditions::typed("--temperature", text, &mut problems);
            (found.is_some(), problems.iter().map(|d| d.code).collect::<Vec<_>>())
        };
        assert_eq!(typed("a=30.5 b=31degC"), (true, vec![]));
        assert_eq!(typed("a=300"), (false, vec!["impossible-temperature"]));
        assert_eq!(typed("a=86"), (true, vec!["warm-temperature"]));
        // 30.8 with a sign too many; a freezing hall is as far outside the plausible range as a hot one.
        assert_eq!(typed("a=-30.8"), (true, vec!["implausible-value"]));
        assert_eq!(typed("a=0 b=-0.1 c=45"), (true, vec!["implausible-value"]));
        assert_eq!(typed("a=-41"), (false, vec!["impossible-temperature"]));
        assert_eq!(typed("a=86F"), (false, vec!["bad-temperature"]));
        assert_eq!(typed("a=1 a=2"), (false, vec!["duplicate-sensor"]));
        assert_eq!(typed("=3 a b=nan"), (false, vec!["bad-temperature"; 3]));
    }
}
