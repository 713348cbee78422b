//! From statements to records: units, modal words and diagnostics.

use super::numbers::{Fault, is_direction, is_near, norm, number, tool_number};
use super::plain::{self, PlainPoint};
use super::scan::{Scanner, Statement};
use super::words::{Major, major};
use super::{ClCircle, ClCycle, ClPoint, Reading, Word};
use std::collections::HashSet;
use std::ops::Range;
use trueaxis_input::{Diagnostics, Place, in_order, usual_threads};
use trueaxis_nc::moves::{Coolant, Feed, FeedMode, SpindleDirection};

const INCH_MM: f64 = 25.4;

/// Largest number of listed problems.
const MAX_PROBLEMS: usize = 100;

/// Pecks of one hole: more than any file means.
const MOST_PECKS: f64 = 1e5;

/// Deviation of the length of a tool axis from 1 above which a warning is given.
const NORM_TOLERANCE: f64 = 1e-4;

/// Receives the statements in order: line, bytes, content.
pub(super) type Take<'t> = dyn FnMut(u32, Range<usize>, Word) + 't;

/// Reads statement by statement. Points in their plain form are found ahead, on all processors.
pub(super) fn read(
    name: &str,
    source: &[u8],
    reading: &Reading,
    take: &mut Take<'_>,
) -> Diagnostics {
    let mut reader = Reader::new(name, *reading);
    let mut scanner = Scanner::new(source);
    let mut statement = Statement::default();
    let find = |block: usize, found: &mut Vec<PlainPoint>| plain::find(source, block, found);
    in_order(plain::blocks(source), usual_threads(), &find, &mut |found| {
        for plain in found.iter() {
            let [begin, end, next] = plain.span;
            // A line that another statement goes on in is no statement.
            while scanner.at() < begin && scanner.next(&mut statement) {
                let (line, span) = (statement.line, statement.span.clone());
                take(line, span, reader.word(&statement));
            }
            if scanner.at() == begin
                && let Some(point) = reader.plain_point(scanner.line(), plain)
            {
                take(scanner.line(), begin..end, Word::Goto(point));
                scanner.skip_line(next);
            }
        }
        true
    });
    while scanner.next(&mut statement) {
        let (line, span) = (statement.line, statement.span.clone());
        take(line, span, reader.word(&statement));
    }
    reader.finish()
}

struct Reader<'n> {
    name: &'n str,
    reading: Reading,
    problems: Diagnostics,
    reported: HashSet<String>,
    count: usize,
    unit_mm: f64,
    units_given: bool,
    /// The vector of TLAXIS.
    axis: Option<[f64; 3]>,
    /// The last coordinate system that Creo stated.
    system: Option<Vec<f64>>,
    /// TLAXIS was declared a comment by SYN.
    no_tool_axis: bool,
    multi_axis: bool,
    /// The numbers of points so far with and without a vector.
    points: [usize; 2],
    first_without: u32,
    rapid: bool,
    feed: Option<Feed>,
    tip_mm: Option<[f64; 3]>,
    /// Points whose vector is not of length 1: their number, the first line, the worst length.
    off: (usize, u32, f64),
}

impl<'n> Reader<'n> {
    fn new(name: &'n str, reading: Reading) -> Self {
        let unit_mm = if reading.inches == Some(true) { INCH_MM } else { 1.0 };
        Self {
            name,
            reading,
            problems: Diagnostics::new(),
            reported: HashSet::new(),
            count: 0,
            unit_mm,
            units_given: false,
            axis: None,
            system: None,
            no_tool_axis: false,
            multi_axis: false,
            points: [0; 2],
            first_without: 0,
            rapid: false,
            feed: None,
            tip_mm: None,
            off: (0, 0, 1.0),
        }
    }

    fn place(&self, line: u32) -> Place {
        Place { file: self.name.to_owned(), line: line as usize, column: 1 }
    }

    fn error(&mut self, line: u32, (code, message, hint): Fault) {
        self.count += 1;
        if self.count <= MAX_PROBLEMS {
            self.problems.error(code, self.place(line), message, hint);
        } else if self.count == MAX_PROBLEMS + 1 {
            let message =
                format!("more than {MAX_PROBLEMS} problems; the remaining ones are not listed");
            self.problems.note(
                "too-many-problems",
                self.place(line),
                message,
                "correct the first ones; the others may follow from them",
            );
        }
    }

    /// A warning, once for each subject.
    fn warn(&mut self, code: &'static str, subject: &str, line: u32, message: String, hint: &str) {
        if self.reported.len() < MAX_PROBLEMS && self.reported.insert(format!("{code} {subject}")) {
            self.problems.warn(code, self.place(line), message, hint);
        }
    }

    fn finish(mut self) -> Diagnostics {
        let all = self.points[0] + self.points[1];
        if all == 0 {
            let message = "the file has no point (GOTO)".to_owned();
            let hint = "expected a cutter-location file in APT, or a table x y z i j k";
            self.problems.error("no-points", Place::whole(self.name), message, hint);
        }
        if self.points[1] > 0 && self.axis.is_none() {
            let message = format!(
                "{} of {all} points have no tool axis (the first is here): 0 0 1 is assumed",
                self.points[1]
            );
            let hint = "for more than three axes write MULTAX/ON and GOTO/x,y,z,i,j,k";
            self.problems.warn("no-tool-axis", self.place(self.first_without), message, hint);
        }
        let (count, line, worst) = self.off;
        if count > 0 {
            let message = format!(
                "the tool axes of {count} points are not unit vectors (the first is here, the \
                 worst \
                 has length {worst:.6}): only their direction is used"
            );
            let hint = "let the CAM system write more digits";
            self.problems.warn("axis-not-unit", self.place(line), message, hint);
        }
        if all > 0 && !self.units_given && self.reading.inches.is_none() {
            let message = "the file states no unit: mm is assumed".to_owned();
            let hint = "write UNITS/MM or UNITS/INCHES, or state the unit on the command line";
            self.problems.note("no-units", Place::whole(self.name), message, hint);
        }
        self.problems
    }

    fn word(&mut self, s: &Statement) -> Word {
        if s.of_creo {
            return self.record_of_creo(s);
        }
        if s.word.is_empty() {
            return self.without_word(s);
        }
        let Some(major) = major(&s.word) else {
            if is_heading(s) {
                return Word::Noted;
            }
            let message = format!("unknown word `{}`: it is kept, but has no effect", s.word);
            self.warn("unknown-word", &s.word, s.line, message, "check whether it moves the tool");
            return Word::Unknown;
        };
        match self.known(major, s) {
            Ok(word) => word,
            Err(fault) => {
                self.error(s.line, fault);
                Word::Noted
            }
        }
    }

    /// The cutter counts; the coordinate system says where the zero of the points is on the part, and all others are
    /// for Creo alone.
    fn record_of_creo(&mut self, s: &Statement) -> Word {
        match s.word.as_str() {
            "CUTTER" => self.known(Major::Cutter, s).unwrap_or(Word::Noted),
            "CSYS" => {
                let system: Vec<f64> = s.arguments().filter_map(|text| number(text).ok()).collect();
                let other = self.system.as_ref().is_some_and(|before| *before != system);
                if other {
                    let message =
                        "the coordinate system changes here: the points are used unchanged";
                    let hint = "write a file for each set-up, or check that all points count from one zero";
                    self.warn("not-applied", "CSYS", s.line, message.to_owned(), hint);
                }
                self.system = Some(system);
                Word::Noted
            }
            _ => Word::Noted,
        }
    }

    /// A comment, or a row of a table.
    fn without_word(&mut self, s: &Statement) -> Word {
        if s.text.trim().is_empty() {
            return Word::Comment(s.comment.clone());
        }
        if s.text.trim_start().starts_with('#') {
            return Word::Comment(s.text.trim().trim_start_matches('#').trim().to_owned());
        }
        match self.point(s) {
            Ok(point) => Word::Goto(point),
            Err(fault) => {
                self.error(s.line, fault);
                Word::Unknown
            }
        }
    }

    fn known(&mut self, major: Major, s: &Statement) -> Result<Word, Fault> {
        Ok(match major {
            Major::Goto => Word::Goto(self.point(s)?),
            Major::GoDelta => Word::Goto(self.delta(s)?),
            Major::From => {
                let rapid = self.rapid;
                let point = self.point(s)?;
                self.rapid = rapid;
                Word::From(point)
            }
            Major::Circle => Word::Circle(self.circle(s)?),
            Major::Rapid => {
                self.rapid = true;
                Word::Rapid
            }
            Major::Feed => self.feed_word(s)?,
            Major::Spindle => self.spindle(s)?,
            Major::Coolant => Word::Coolant(match s.argument(0).to_ascii_uppercase().as_str() {
                "OFF" => Coolant::Off,
                "MIST" => Coolant::Mist,
                _ => Coolant::Flood,
            }),
            Major::LoadTool => Word::Tool(tool_number(s.argument(0))?),
            Major::Load if s.argument(0).eq_ignore_ascii_case("TOOL") => {
                Word::Tool(tool_number(s.argument(1))?)
            }
            Major::Cutter => Word::Cutter {
                diameter_mm: number(s.argument(0))? * self.unit_mm,
                corner_radius_mm: match s.argument(1) {
                    "" => 0.0,
                    text => number(text)? * self.unit_mm,
                },
            },
            Major::ToolAxis => self.tool_axis(s)?,
            Major::MultiAxis => {
                self.multi_axis = !s.argument(0).eq_ignore_ascii_case("OFF");
                Word::MultiAxis(self.multi_axis)
            }
            Major::Units => self.units(s)?,
            Major::Cycle => self.cycle(s)?,
            Major::Delay => self.delay(s)?,
            Major::Stop(optional) => Word::Stop { optional },
            Major::Insert => Word::Insert(s.rest().to_owned()),
            Major::Comment => Word::Comment(s.rest().to_owned()),
            Major::End => Word::End,
            Major::Synonym => self.synonym(s),
            Major::Noted | Major::Load => Word::Noted,
            Major::NotApplied(what) => self.not_applied(what, s),
            Major::Motion(what) => {
                let message = format!("{} is not read: {what}", s.word);
                let hint = "let the CAM system write points (GOTO)";
                return Err(("motion-not-read", message, hint));
            }
        })
    }

    /// SYN/'TLAXIS','$$…': what is written as TLAXIS is a comment.
    fn synonym(&mut self, s: &Statement) -> Word {
        let names = s.argument(0).eq_ignore_ascii_case("'TLAXIS'");
        self.no_tool_axis |= names && s.argument(1).starts_with("'$$");
        Word::Noted
    }

    fn not_applied(&mut self, what: &str, s: &Statement) -> Word {
        if !s.argument(0).eq_ignore_ascii_case("OFF") {
            let message = format!("{} is read, but not applied: {what}", s.word);
            let hint = "check the path of the tool";
            self.warn("not-applied", &s.word, s.line, message, hint);
        }
        Word::Noted
    }

    fn numbers<const N: usize>(&self, s: &Statement, from: usize) -> Result<[f64; N], Fault> {
        let mut values = [0.0; N];
        for (i, value) in values.iter_mut().enumerate() {
            *value = number(s.argument(from + i))?;
        }
        Ok(values)
    }

    fn place_mm(&self, s: &Statement) -> Result<[f64; 3], Fault> {
        let place = self.numbers::<3>(s, 0)?.map(|v| v * self.unit_mm);
        match is_near(&place) {
            true => Ok(place),
            false => {
                let message = "a coordinate of the point exceeds 10 km".to_owned();
                Err(("too-far", message, "check the units"))
            }
        }
    }

    fn point(&mut self, s: &Statement) -> Result<ClPoint, Fault> {
        let tip_mm = self.place_mm(s)?;
        let axis = match s.count() {
            3 => None,
            6 => Some(self.vector(s, 3)?),
            count => {
                let message = format!("a point has 3 or 6 numbers, not {count}");
                return Err(("bad-point", message, "write GOTO/x,y,z or GOTO/x,y,z,i,j,k"));
            }
        };
        let axis = self.axis_of_point(axis, s)?;
        self.tip_mm = Some(tip_mm);
        let rapid = std::mem::take(&mut self.rapid);
        Ok(ClPoint { tip_mm, axis, rapid, feed: self.feed })
    }

    /// A point in its plain form; none where it has to be read as any other statement.
    fn plain_point(&mut self, line: u32, plain: &PlainPoint) -> Option<ClPoint> {
        let [x, y, z, i, j, k] = plain.numbers;
        let (tip_mm, vector) = ([x, y, z].map(|v| v * self.unit_mm), [i, j, k]);
        let norm = norm(&vector);
        if !is_near(&tip_mm) || !is_direction(norm) {
            return None;
        }
        self.note_norm(norm, line);
        self.points[0] += 1;
        self.tip_mm = Some(tip_mm);
        let rapid = std::mem::take(&mut self.rapid);
        Some(ClPoint { tip_mm, axis: vector.map(|v| v / norm), rapid, feed: self.feed })
    }

    fn axis_of_point(&mut self, own: Option<[f64; 3]>, s: &Statement) -> Result<[f64; 3], Fault> {
        self.points[usize::from(own.is_none())] += 1;
        if own.is_none() && self.points[1] == 1 {
            self.first_without = s.line;
        }
        match own.or(self.axis) {
            Some(axis) => Ok(axis),
            None if self.multi_axis => {
                let message = "the point has no tool axis, but MULTAX is on".to_owned();
                Err(("no-tool-axis", message, "write GOTO/x,y,z,i,j,k, or TLAXIS before it"))
            }
            None => Ok([0.0, 0.0, 1.0]),
        }
    }

    /// A direction, brought to length 1.
    fn vector(&mut self, s: &Statement, from: usize) -> Result<[f64; 3], Fault> {
        let vector = self.numbers::<3>(s, from)?;
        let norm = norm(&vector);
        if !is_direction(norm) {
            let message = format!("the tool axis has the length {norm}");
            return Err(("zero-tool-axis", message, "write a vector of length 1"));
        }
        self.note_norm(norm, s.line);
        Ok(vector.map(|v| v / norm))
    }

    fn note_norm(&mut self, norm: f64, at: u32) {
        if (norm - 1.0).abs() > NORM_TOLERANCE {
            let (count, line, worst) = self.off;
            let worse = (norm - 1.0).abs() > (worst - 1.0).abs();
            let first = if count == 0 { at } else { line };
            self.off = (count + 1, first, if worse { norm } else { worst });
        }
    }

    fn delta(&mut self, s: &Statement) -> Result<ClPoint, Fault> {
        let step = match s.count() {
            // Along the tool axis.
            1 => {
                let length = number(s.argument(0))? * self.unit_mm;
                self.axis.unwrap_or([0.0, 0.0, 1.0]).map(|v| v * length)
            }
            _ => self.place_mm(s)?,
        };
        let Some(now) = self.tip_mm else {
            let message = "GODLTA is before the first point".to_owned();
            return Err(("no-place", message, "write GOTO or FROM before it"));
        };
        let tip_mm: [f64; 3] = std::array::from_fn(|i| now[i] + step[i]);
        let axis = self.axis_of_point(None, s)?;
        self.tip_mm = Some(tip_mm);
        let rapid = std::mem::take(&mut self.rapid);
        Ok(ClPoint { tip_mm, axis, rapid, feed: self.feed })
    }

    fn circle(&mut self, s: &Statement) -> Result<ClCircle, Fault> {
        let center_mm = self.place_mm(s)?;
        let normal = match s.count() {
            6 | 7 => self.numbers::<3>(s, 3)?,
            count => {
                let message = format!("a circle has 6 or 7 numbers, not {count}");
                return Err(("bad-circle", message, "write CIRCLE/x,y,z,i,j,k,radius"));
            }
        };
        let norm = norm(&normal);
        if !is_direction(norm) {
            let message = "the normal of the circle has length zero".to_owned();
            return Err(("bad-circle", message, "write CIRCLE/x,y,z,i,j,k,radius"));
        }
        Ok(ClCircle { center_mm, normal: normal.map(|v| v / norm) })
    }

    fn feed_word(&mut self, s: &Statement) -> Result<Word, Fault> {
        let (mut value, mut mode, mut unit) = (None, FeedMode::PerMinute, self.unit_mm);
        for argument in s.arguments() {
            match argument.to_ascii_uppercase().as_str() {
                "IPM" => (mode, unit) = (FeedMode::PerMinute, INCH_MM),
                "MMPM" => (mode, unit) = (FeedMode::PerMinute, 1.0),
                "IPR" => (mode, unit) = (FeedMode::PerRevolution, INCH_MM),
                "MMPR" => (mode, unit) = (FeedMode::PerRevolution, 1.0),
                "PERMIN" => mode = FeedMode::PerMinute,
                "PERREV" => mode = FeedMode::PerRevolution,
                "RAPID" => {
                    self.rapid = true;
                    return Ok(Word::Rapid);
                }
                text if value.is_none() && !text.is_empty() => value = Some(number(text)?),
                _ => {}
            }
        }
        let Some(value) = value.filter(|v| *v > 0.0 && *v < 1e9) else {
            let message = "FEDRAT has no positive number".to_owned();
            return Err(("bad-feed", message, "write FEDRAT/500,MMPM"));
        };
        let feed = Feed { mode, value: value * unit };
        self.feed = Some(feed);
        // A feed ends a rapid traverse without motion so far.
        self.rapid = false;
        Ok(Word::Feed(feed))
    }

    fn spindle(&mut self, s: &Statement) -> Result<Word, Fault> {
        let (mut speed, mut turning) = (None, SpindleDirection::Clockwise);
        for argument in s.arguments() {
            match argument.to_ascii_uppercase().as_str() {
                "OFF" => return Ok(Word::Spindle(SpindleDirection::Stopped, None)),
                "CLW" | "ON" | "RPM" | "" => {}
                "CCLW" => turning = SpindleDirection::CounterClockwise,
                "SFM" | "SMM" | "SURF" => {
                    let message =
                        "SPINDL states a surface speed: no spindle speed is written".to_owned();
                    let hint = "state the speed in rpm, such as SPINDL/RPM,3000,CLW";
                    self.warn("surface-speed", "", s.line, message, hint);
                    return Ok(Word::Spindle(turning, None));
                }
                text if speed.is_none() => speed = number(text).ok().filter(|v| *v >= 0.0),
                _ => {}
            }
        }
        Ok(Word::Spindle(turning, speed))
    }

    fn tool_axis(&mut self, s: &Statement) -> Result<Word, Fault> {
        if self.no_tool_axis {
            return Ok(Word::Noted);
        }
        let axis = self.vector(s, 0)?;
        self.axis = Some(axis);
        Ok(Word::ToolAxis(axis))
    }

    fn units(&mut self, s: &Statement) -> Result<Word, Fault> {
        let inches = match s.argument(0).to_ascii_uppercase().as_str() {
            "INCH" | "INCHES" | "IN" => true,
            "MM" | "MILLIMETERS" | "MILLIMETRES" => false,
            other => {
                let message = format!("unknown unit of length `{other}`");
                return Err(("unknown-unit", message, "write UNITS/MM or UNITS/INCHES"));
            }
        };
        self.units_given = true;
        if self.reading.inches.is_none() {
            self.unit_mm = if inches { INCH_MM } else { 1.0 };
        }
        Ok(Word::Inches(self.unit_mm == INCH_MM))
    }

    /// CYCLE/DRILL,FEDTO,depth,MMPM,feed,RAPTO,clearance,RTRCTO,retract (SolidWorks, Creo), or
    /// DEPTH … CLEAR … RETURN (CATIA). CYCLE/DEEP with 1STPECK and SUBPECK, or STEP, pecks.
    fn cycle(&mut self, s: &Statement) -> Result<Word, Fault> {
        let kind = s.argument(0).to_ascii_uppercase();
        if matches!(kind.as_str(), "OFF" | "NOMORE") {
            return Ok(Word::CycleOff);
        }
        if kind == "INIT" {
            return Ok(Word::Noted);
        }
        let is_drilling = matches!(kind.as_str(), "DRILL" | "FACE" | "REAM" | "CSINK");
        let named = |names: &[&str]| {
            let at = s.arguments().position(|a| names.iter().any(|n| a.eq_ignore_ascii_case(n)))?;
            number(s.argument(at + 1)).ok()
        };
        let length = |names: &[&str]| named(names).map(|v| v * self.unit_mm);
        let Some(depth_mm) = length(&["FEDTO", "DEPTH"]).or_else(|| {
            // CYCLE/TAP,depth,…
            number(s.argument(1)).ok().map(|v| v * self.unit_mm)
        }) else {
            let message = "the cycle has no depth".to_owned();
            return Err(("bad-cycle", message, "write CYCLE/DRILL,FEDTO,10,MMPM,200,RAPTO,2"));
        };
        let clearance_mm = length(&["RAPTO", "CLEAR"]).unwrap_or(0.0).max(0.0);
        let feeds = [("MMPM", FeedMode::PerMinute, 1.0), ("IPM", FeedMode::PerMinute, INCH_MM)];
        let turns =
            [("MMPR", FeedMode::PerRevolution, 1.0), ("IPR", FeedMode::PerRevolution, INCH_MM)];
        let feed = feeds.into_iter().chain(turns).find_map(|(name, mode, unit)| {
            let value = named(&[name]).filter(|v| *v > 0.0)?;
            Some(Feed { mode, value: value * unit })
        });
        let retract_mm = length(&["RTRCTO"]).unwrap_or(clearance_mm).max(clearance_mm);
        let peck = length(&["SUBPECK", "STEP"]).filter(|v| *v > 0.0);
        let first = length(&["1STPECK"]).filter(|v| *v > 0.0).or(peck);
        let deep = kind.starts_with("DEEP");
        let pecks_mm = first.filter(|_| deep).map(|first| [first, peck.unwrap_or(first)]);
        if pecks_mm.is_some_and(|[_, peck]| depth_mm / peck > MOST_PECKS) {
            let message = "the cycle has more than 100,000 pecks".to_owned();
            return Err(("bad-cycle", message, "check SUBPECK and the units"));
        }
        if !is_drilling && pecks_mm.is_none() {
            let message = format!("CYCLE/{kind} is read as drilling in one stroke");
            let hint = "pecks and the retraction of the cycle are omitted; check the hole";
            self.warn("cycle-not-applied", &kind, s.line, message, hint);
        }
        let dwell_s = named(&["DWELL"]).filter(|t| (0.0..1e6).contains(t)).unwrap_or(0.0);
        Ok(Word::Cycle(ClCycle { depth_mm, clearance_mm, retract_mm, pecks_mm, dwell_s, feed }))
    }

    fn delay(&mut self, s: &Statement) -> Result<Word, Fault> {
        let time = number(s.argument(0))?;
        if !(0.0..1e6).contains(&time) {
            let message = format!("{time} s is not an accepted dwell time");
            return Err(("bad-delay", message, "write DELAY/1.5, in seconds"));
        }
        if s.argument(1).eq_ignore_ascii_case("REV") {
            let message = "DELAY in revolutions is not applied".to_owned();
            self.warn("not-applied", "DELAY", s.line, message, "write the time in seconds");
            return Ok(Word::Noted);
        }
        Ok(Word::Delay(time))
    }
}

/// Whether a line contains the headings of a table.
fn is_heading(s: &Statement) -> bool {
    s.word == "X" || s.word.starts_with("TIP_X")
}
