//! From statements to records: units, modal words and diagnostics.

mod along;
mod circle;
mod cycle;
mod end;
mod technology;
mod transformation;

pub use cycle::SAME_PITCH;

use super::numbers::{Fault, is_direction, is_near, norm, number};
use super::plain::{self, PlainPoint};
use super::scan::{Scanner, Statement};
use super::words::{Major, major};
use super::{ClCycle, ClPoint, Reading, Word};
use std::collections::HashSet;
use std::ops::Range;
use trueaxis_input::{Diagnostics, Place, in_order, usual_threads};
use trueaxis_nc::moves::Feed;

const INCH_MM: f64 = 25.4;

/// Largest number of listed problems.
const MAX_PROBLEMS: usize = 100;

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
    reader.check_end(&scanner, source);
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
    stated_axis: Option<[f64; 3]>,
    /// That of the last point with a vector, or of TLAXIS after it.
    axis: Option<[f64; 3]>,
    /// The last coordinate system that Creo stated.
    system: Option<Vec<f64>>,
    /// The last one that NX stated.
    frame: Option<Vec<f64>>,
    /// TLAXIS was declared a comment by SYN.
    no_tool_axis: bool,
    multi_axis: bool,
    points: usize,
    /// Those without any tool axis: their number and the first line.
    upright: (usize, u32),
    /// Those that keep a tilted axis of a point before: their number and the first line.
    kept: (usize, u32),
    rapid: bool,
    feed: Option<Feed>,
    tip_mm: Option<[f64; 3]>,
    /// TRANS: added to all points, mm.
    translation: [f64; 3],
    technology: technology::Technology,
    /// The last cycle, for CYCLE/ON.
    cycle: Option<ClCycle>,
    /// The line of FINI or END.
    ended: Option<u32>,
    /// Whether anything was a word of APT, and not a row of a table.
    has_words: bool,
    /// Whether the last statement ended one of several paths.
    path_ended: bool,
    /// Where the next circle begins to: INDIRV.
    direction: Option<[f64; 3]>,
    /// The line of the cycle that is on.
    cycle_on: Option<u32>,
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
            stated_axis: None,
            axis: None,
            system: None,
            frame: None,
            no_tool_axis: false,
            multi_axis: false,
            points: 0,
            upright: (0, 0),
            kept: (0, 0),
            rapid: false,
            feed: None,
            tip_mm: None,
            translation: [0.0; 3],
            technology: technology::Technology::default(),
            cycle: None,
            ended: None,
            has_words: false,
            path_ended: false,
            direction: None,
            cycle_on: None,
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
        let all = self.points;
        if all == 0 {
            let message = "the file has no point (GOTO)".to_owned();
            let hint = "expected a cutter-location file in APT, or a table x y z i j k";
            self.problems.error("no-points", Place::whole(self.name), message, hint);
        }
        let (count, first) = self.upright;
        if count > 0 {
            let message = format!(
                "{count} of {all} points have no tool axis (the first is here): 0 0 1 is assumed"
            );
            let hint = "for more than three axes write MULTAX/ON and GOTO/x,y,z,i,j,k";
            self.problems.warn("no-tool-axis", self.place(first), message, hint);
        }
        let (count, first) = self.kept;
        if count > 0 {
            let message = format!(
                "{count} of {all} points have no tool axis (the first is here): that of the point before is kept"
            );
            let hint = "write TLAXIS/0,0,1 or MULTAX/OFF where the tool stands upright again";
            self.problems.note("tool-axis-kept", self.place(first), message, hint);
        }
        self.warn_of_no_tool();
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
        self.path_ended &= s.word.is_empty() && s.text.trim().is_empty();
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
            if moves(s) {
                let message = format!("`{}` stands before a motion, which would be lost", s.word);
                self.error(s.line, ("unknown-motion", message, "begin the line with GOTO"));
                return Word::Unknown;
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
        self.has_words = true;
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
            Major::Direction => {
                self.direction = Some(self.numbers::<3>(s, 0)?);
                Word::Noted
            }
            Major::Along => self.along(s)?,
            Major::Rapid if s.argument(0).eq_ignore_ascii_case("OFF") => {
                self.rapid = false;
                Word::Noted
            }
            Major::Rapid => {
                self.rapid = true;
                Word::Rapid
            }
            Major::Feed => self.feed_word(s)?,
            Major::Spindle => self.spindle(s)?,
            Major::Coolant => self.coolant(s),
            Major::LoadTool => self.tool(s, 0)?,
            Major::Load if s.argument(0).eq_ignore_ascii_case("TOOL") => self.tool(s, 1)?,
            Major::Select => {
                self.technology.selected.get_or_insert(s.line);
                Word::Noted
            }
            Major::Frame => self.frame(s)?,
            Major::Cutter => Word::Cutter {
                diameter_mm: number(s.argument(0))? * self.unit_mm,
                corner_radius_mm: match s.argument(1) {
                    "" => None,
                    text => Some(number(text)? * self.unit_mm),
                },
            },
            Major::ToolAxis => self.tool_axis(s)?,
            Major::MultiAxis => {
                self.multi_axis = !s.argument(0).eq_ignore_ascii_case("OFF");
                if !self.multi_axis {
                    self.axis = self.stated_axis;
                }
                Word::MultiAxis(self.multi_axis)
            }
            Major::Units => self.units(s)?,
            Major::Cycle => self.cycle(s)?,
            Major::Delay => self.delay(s)?,
            Major::Stop(optional) => Word::Stop { optional },
            Major::Insert => {
                let message =
                    "INSERT is written as a comment: its text may be words or none".to_owned();
                let hint = "put words of the control into the program, or into a template";
                self.warn("not-applied", "INSERT", s.line, message, hint);
                Word::Insert(s.rest().to_owned())
            }
            Major::Comment => Word::Comment(s.rest().to_owned()),
            // END-OF-PATH of NX ends one of several.
            Major::End if s.text.trim_start()[s.word.len()..].starts_with('-') => {
                self.path_ended = true;
                Word::Noted
            }
            Major::End => {
                self.ended = Some(s.line);
                Word::End
            }
            Major::Synonym => self.synonym(s),
            Major::Noted if s.word.starts_with("TL") && s.count() > 0 => self.along(s)?,
            Major::Noted | Major::Load => Word::Noted,
            Major::NotApplied(what) => self.not_applied(what, s),
            Major::Translation => self.translate(s)?,
            Major::Replaced(what) => self.replaced(what, s),
            Major::Refused(what) => transformation::refused(what, s)?,
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

    fn numbers<const N: usize>(&self, s: &Statement, from: usize) -> Result<[f64; N], Fault> {
        let mut values = [0.0; N];
        for (i, value) in values.iter_mut().enumerate() {
            *value = number(s.argument(from + i))?;
        }
        Ok(values)
    }

    fn place_mm(&self, s: &Statement) -> Result<[f64; 3], Fault> {
        let place = self.numbers::<3>(s, 0)?.map(|v| v * self.unit_mm);
        near(place)
    }

    fn point(&mut self, s: &Statement) -> Result<ClPoint, Fault> {
        let tip_mm = near(self.displaced(self.place_mm(s)?))?;
        let axis = match s.count() {
            3 => None,
            6 => Some(self.vector(s, 3)?),
            count => {
                let message = format!("a point has 3 or 6 numbers, not {count}");
                return Err(("bad-point", message, "write GOTO/x,y,z or GOTO/x,y,z,i,j,k"));
            }
        };
        self.moved(tip_mm, axis, s)
    }

    /// The point that the tool goes to.
    fn moved(
        &mut self,
        tip_mm: [f64; 3],
        own: Option<[f64; 3]>,
        s: &Statement,
    ) -> Result<ClPoint, Fault> {
        let axis = self.axis_of_point(own, s)?;
        self.warn_after_end(s.line);
        (self.tip_mm, self.direction) = (Some(tip_mm), None);
        let rapid = std::mem::take(&mut self.rapid);
        Ok(ClPoint { tip_mm, axis, rapid, feed: self.feed })
    }

    fn warn_after_end(&mut self, line: u32) {
        if let Some(ended) = self.ended.take() {
            let message = format!("the file ended in line {ended}; what follows is machined, too");
            let hint = "cut the file there if it should not be";
            self.warn("goes-on-after-end", "", line, message, hint);
        }
    }

    /// A point in its plain form; none where it has to be read as any other statement.
    fn plain_point(&mut self, line: u32, plain: &PlainPoint) -> Option<ClPoint> {
        let [x, y, z, i, j, k] = plain.numbers;
        let (tip_mm, vector) = (self.displaced([x, y, z].map(|v| v * self.unit_mm)), [i, j, k]);
        let norm = norm(&vector);
        if !is_near(&tip_mm) || !is_direction(norm) {
            return None;
        }
        self.note_norm(norm, line);
        self.warn_after_end(line);
        (self.has_words, self.path_ended) = (true, false);
        self.points += 1;
        let axis = vector.map(|v| v / norm);
        (self.tip_mm, self.axis, self.direction) = (Some(tip_mm), Some(axis), None);
        let rapid = std::mem::take(&mut self.rapid);
        Some(ClPoint { tip_mm, axis, rapid, feed: self.feed })
    }

    /// The tool axis of a point: its own, or else that of TLAXIS or of the point before, whichever is the last;
    /// NX writes a vector where it changes.
    fn axis_of_point(&mut self, own: Option<[f64; 3]>, s: &Statement) -> Result<[f64; 3], Fault> {
        self.points += 1;
        let count =
            |(count, line): (usize, u32)| (count + 1, if count == 0 { s.line } else { line });
        match (own, self.axis) {
            (Some(axis), _) => {
                self.axis = Some(axis);
                Ok(axis)
            }
            (None, Some(axis)) => {
                if self.stated_axis != Some(axis) && axis[2] < 1.0 {
                    self.kept = count(self.kept);
                }
                Ok(axis)
            }
            (None, None) => {
                self.upright = count(self.upright);
                if self.multi_axis {
                    let message = "the point has no tool axis, but MULTAX is on".to_owned();
                    let hint = "write GOTO/x,y,z,i,j,k, or TLAXIS before it";
                    return Err(("no-tool-axis", message, hint));
                }
                Ok([0.0, 0.0, 1.0])
            }
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
        let (step, axis) = match s.count() {
            // Along the tool axis.
            1 => {
                let length = number(s.argument(0))? * self.unit_mm;
                (self.axis.unwrap_or([0.0, 0.0, 1.0]).map(|v| v * length), None)
            }
            3 => (self.place_mm(s)?, None),
            6 => (self.place_mm(s)?, Some(self.vector(s, 3)?)),
            count => {
                let message = format!("a step has 1, 3 or 6 numbers, not {count}");
                return Err(("bad-point", message, "write GODLTA/dx,dy,dz or GODLTA/length"));
            }
        };
        let Some(now) = self.tip_mm else {
            let message =
                "GODLTA is before the first point, or before the first after TRANS".to_owned();
            return Err(("no-place", message, "write GOTO or FROM before it"));
        };
        self.moved(std::array::from_fn(|i| now[i] + step[i]), axis, s)
    }

    /// MSYS of NX: points count in it.
    fn frame(&mut self, s: &Statement) -> Result<Word, Fault> {
        let frame: Vec<f64> = s.arguments().filter_map(|text| number(text).ok()).collect();
        let other = self.frame.as_ref().is_some_and(|before| *before != frame);
        self.frame = Some(frame);
        match other && self.points > 0 {
            false => Ok(Word::Noted),
            true => {
                let message = "points count in another coordinate system from here on".to_owned();
                let hint = "write a file for each coordinate system (MSYS)";
                Err(("other-coordinate-system", message, hint))
            }
        }
    }

    fn tool_axis(&mut self, s: &Statement) -> Result<Word, Fault> {
        if self.no_tool_axis {
            return Ok(Word::Noted);
        }
        let axis = self.vector(s, 0)?;
        (self.axis, self.stated_axis) = (Some(axis), Some(axis));
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
        let unit_mm = if inches { INCH_MM } else { 1.0 };
        let was_given = std::mem::replace(&mut self.units_given, true);
        let has_numbers = self.points > 0 || self.feed.is_some() || self.translation != [0.0; 3];
        if self.reading.inches.is_none() {
            if has_numbers && unit_mm != self.unit_mm {
                self.other_units(s, was_given)?;
            }
            self.unit_mm = unit_mm;
        }
        Ok(Word::Inches(self.unit_mm == INCH_MM))
    }

    /// The unit changes after numbers were read.
    fn other_units(&mut self, s: &Statement, was_given: bool) -> Result<(), Fault> {
        if !was_given {
            let message = "UNITS stands after points or feeds, which were read in mm".to_owned();
            let hint = "put UNITS before the first of them, or state the unit on the command line";
            return Err(("unit-changes", message, hint));
        }
        let message =
            "the unit of length changes here: numbers before it were read in the other".to_owned();
        let hint = "check that the file means it";
        self.warn("unit-changes", "", s.line, message, hint);
        Ok(())
    }
}

fn near(place_mm: [f64; 3]) -> Result<[f64; 3], Fault> {
    match is_near(&place_mm) {
        true => Ok(place_mm),
        false => {
            let message = "a coordinate of the point exceeds 10 km".to_owned();
            Err(("too-far", message, "check the units"))
        }
    }
}

/// Whether a line contains the headings of a table.
fn is_heading(s: &Statement) -> bool {
    s.word == "X" || s.word.starts_with("TIP_X")
}

/// Whether an unknown word is followed by one that moves the tool, as in `N10 GOTO/1,2,3`.
fn moves(s: &Statement) -> bool {
    let words = s.text.split(|c: char| !c.is_ascii_alphanumeric());
    let mut words = words.map(str::to_ascii_uppercase);
    words.any(|w| matches!(w.as_str(), "GOTO" | "GODLTA" | "CIRCLE" | "CYCLE"))
}
