//! Feed, spindle, coolant, tool and dwell: every word of them is applied, named as not applied, or an error.

use super::super::numbers::{Fault, number, whole_number};
use super::super::scan::Statement;
use super::super::{ClTool, Word};
use super::{INCH_MM, Reader};
use trueaxis_nc::moves::{Coolant, Feed, FeedMode, SpindleDirection};

/// No machine has a greater feed, mm/min.
const MOST_FEED: f64 = 1e6;

/// Longest dwell, s.
const MOST_DWELL_S: f64 = 1e6;

/// What is modal of spindle, coolant and tool.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Technology {
    /// 1/min.
    speed: Option<f64>,
    turning: Option<SpindleDirection>,
    coolant: Option<Coolant>,
    loaded: bool,
    /// The first line that chooses a tool without loading it.
    pub selected: Option<u32>,
}

/// The unit of a feed: what it counts by, and mm in it.
pub(super) fn feed_unit(word: &str, unit_mm: f64) -> Option<(FeedMode, f64)> {
    Some(match word {
        "IPM" => (FeedMode::PerMinute, INCH_MM),
        "MMPM" => (FeedMode::PerMinute, 1.0),
        "IPR" => (FeedMode::PerRevolution, INCH_MM),
        "MMPR" => (FeedMode::PerRevolution, 1.0),
        "PERMIN" => (FeedMode::PerMinute, unit_mm),
        "PERREV" => (FeedMode::PerRevolution, unit_mm),
        _ => return None,
    })
}

/// A feed that machines have.
pub(super) fn feed(value: f64, (mode, unit_mm): (FeedMode, f64)) -> Result<Feed, Fault> {
    let value = value * unit_mm;
    if value > 0.0 && value < MOST_FEED {
        return Ok(Feed { mode, value });
    }
    let message = format!("{value} is not a feed: it must be positive and below 1000 m/min");
    Err(("bad-feed", message, "write FEDRAT/500,MMPM"))
}

impl Reader<'_> {
    pub(super) fn feed_word(&mut self, s: &Statement) -> Result<Word, Fault> {
        let mut value = None;
        let mut unit = (FeedMode::PerMinute, self.unit_mm);
        for argument in s.arguments().filter(|a| !a.is_empty()) {
            let word = argument.to_ascii_uppercase();
            if word == "RAPID" {
                self.rapid = true;
                return Ok(Word::Rapid);
            }
            if let Some(known) = feed_unit(&word, self.unit_mm) {
                unit = known;
            } else if value.is_none() {
                value = Some(number(argument).map_err(|_| unknown_unit(argument))?);
            } else {
                return Err(unknown_unit(argument));
            }
        }
        let Some(value) = value.filter(|v| *v > 0.0) else {
            let message = "FEDRAT has no positive number".to_owned();
            return Err(("bad-feed", message, "write FEDRAT/500,MMPM"));
        };
        let feed = feed(value, unit)?;
        self.feed = Some(feed);
        // A feed ends a rapid traverse without motion so far.
        self.rapid = false;
        Ok(Word::Feed(feed))
    }

    /// SPINDL/RPM,1000,CLW. Without a direction the last one holds, ON has the last speed too.
    pub(super) fn spindle(&mut self, s: &Statement) -> Result<Word, Fault> {
        let (mut speed, mut turning, mut is_on, mut by_surface) = (None, None, false, false);
        let mut arguments = s.arguments().filter(|a| !a.is_empty());
        while let Some(argument) = arguments.next() {
            let word = argument.to_ascii_uppercase();
            match word.as_str() {
                "OFF" => return Ok(self.stopped()),
                "ORIENT" | "LOCK" | "NEUTRL" => {
                    self.not_used("SPINDL", &word, s.line);
                    return Ok(self.stopped());
                }
                "CLW" => turning = Some(SpindleDirection::Clockwise),
                "CCLW" => turning = Some(SpindleDirection::CounterClockwise),
                "ON" | "RPM" => is_on = true,
                "SFM" | "SMM" | "SURF" | "CSS" => by_surface = true,
                "MAXRPM" | "RADIUS" | "RANGE" => {
                    self.not_used("SPINDL", &word, s.line);
                    arguments.next();
                }
                "AUTO" | "HIGH" | "MEDIUM" | "LOW" => self.not_used("SPINDL", &word, s.line),
                _ if speed.is_none() => speed = Some(speed_of(argument)?),
                _ => return Err(bad_spindle(argument)),
            }
        }
        if speed == Some(0.0) {
            return Ok(self.stopped());
        }
        if by_surface {
            let message = "SPINDL states a surface speed: no spindle speed is written".to_owned();
            let hint = "state the speed in rpm, such as SPINDL/RPM,3000,CLW";
            self.warn("surface-speed", "", s.line, message, hint);
            // What turned before does not turn any more.
            speed = Some(0.0);
        } else if speed.is_none() && turning.is_none() && !is_on {
            // Limits and ranges alone turn nothing.
            return Ok(Word::Noted);
        }
        if turning.is_none() && self.technology.turning == Some(SpindleDirection::CounterClockwise)
        {
            let message = "SPINDL states no direction: it stays counter-clockwise".to_owned();
            self.warn("direction-kept", "", s.line, message, "write CLW or CCLW in each SPINDL");
        }
        let turning = turning.or(self.technology.turning).unwrap_or(SpindleDirection::Clockwise);
        self.technology.turning = Some(turning);
        self.technology.speed = speed.or(self.technology.speed).filter(|v| *v > 0.0);
        Ok(Word::Spindle(turning, speed))
    }

    fn stopped(&self) -> Word {
        Word::Spindle(SpindleDirection::Stopped, None)
    }

    pub(super) fn coolant(&mut self, s: &Statement) -> Word {
        let mut chosen = None;
        for argument in s.arguments().filter(|a| !a.is_empty()) {
            let word = argument.to_ascii_uppercase();
            match word.as_str() {
                "OFF" => return Word::Coolant(Coolant::Off),
                "ON" => chosen = chosen.or(self.technology.coolant).or(Some(Coolant::Flood)),
                "FLOOD" => chosen = Some(Coolant::Flood),
                "MIST" => chosen = Some(Coolant::Mist),
                _ => self.not_used("COOLNT", &word, s.line),
            }
        }
        let Some(chosen) = chosen else {
            if s.arguments().all(str::is_empty) {
                self.not_used("COOLNT", "without a word", s.line);
            }
            return Word::Noted;
        };
        self.technology.coolant = Some(chosen);
        Word::Coolant(chosen)
    }

    /// LOADTL/number and what may follow: LENGTH, and OSETNO, OFSTNO, OFFSET or ADJUST for the number of its length
    /// in the control.
    pub(super) fn tool(&mut self, s: &Statement, from: usize) -> Result<Word, Fault> {
        let number = whole_number(s.argument(from))?;
        let mut tool = ClTool { number, ..ClTool::default() };
        let mut arguments = s.arguments().skip(from + 1).filter(|a| !a.is_empty()).peekable();
        while let Some(argument) = arguments.next() {
            let word = argument.to_ascii_uppercase();
            match word.as_str() {
                "LENGTH" => {
                    let length = super::number(arguments.next().unwrap_or_default())?;
                    tool.length_mm = Some(length * self.unit_mm).filter(|l| *l != 0.0);
                }
                "OSETNO" | "OFSTNO" | "OFFSET" | "ADJUST" => {
                    let offset = whole_number(arguments.next().unwrap_or_default())?;
                    tool.offset = Some(offset).filter(|n| *n != 0);
                }
                "MILL" | "DRILL" | "TURN" | "AUTO" => {}
                _ if super::number(argument).is_ok_and(|n| n == f64::from(tool.number)) => {}
                _ => {
                    self.not_used("LOADTL", &word, s.line);
                    while arguments.next_if(|a| super::number(a).is_ok()).is_some() {}
                }
            }
        }
        self.technology.loaded = true;
        Ok(Word::Tool(tool))
    }

    /// A tool that the file chose and did not load is not named in the program.
    pub(super) fn warn_of_no_tool(&mut self) {
        if let Some(line) = self.technology.selected.filter(|_| !self.technology.loaded) {
            let message = "the file chooses a tool, but loads none (LOADTL)".to_owned();
            let hint = "write LOADTL/number where the tool is changed";
            self.warn("no-tool", "", line, message, hint);
        }
    }

    /// DELAY/time, or DELAY/turns,REV.
    pub(super) fn delay(&mut self, s: &Statement) -> Result<Word, Fault> {
        let arguments: Vec<&str> = s.arguments().filter(|a| !a.is_empty()).collect();
        Ok(Word::Delay(self.dwell_s(&arguments)?))
    }

    /// A time in s, or turns of the spindle with REV before or after them.
    pub(super) fn dwell_s(&self, arguments: &[&str]) -> Result<f64, Fault> {
        let is_rev = |text: &str| text.eq_ignore_ascii_case("REV");
        let (value, in_turns) = match *arguments {
            [value] => (value, false),
            [value, rev] if is_rev(rev) => (value, true),
            [rev, value] if is_rev(rev) => (value, true),
            [value, "SEC" | "SECOND" | "SECONDS"] => (value, false),
            _ => {
                let message = format!("`{}` is not a dwell time", arguments.join(","));
                return Err(("bad-delay", message, "write DELAY/1.5, in seconds"));
            }
        };
        let value = number(value)?;
        let seconds = match (in_turns, self.technology.speed) {
            (false, _) => value,
            (true, Some(speed)) => value * 60.0 / speed,
            (true, None) => {
                let message = "a dwell in revolutions, but the spindle has no speed".to_owned();
                return Err((
                    "bad-delay",
                    message,
                    "write the time in seconds, or SPINDL before it",
                ));
            }
        };
        match (0.0..MOST_DWELL_S).contains(&seconds) {
            true => Ok(seconds),
            false => {
                let message = format!("{seconds} s is not an accepted dwell time");
                Err(("bad-delay", message, "write DELAY/1.5, in seconds"))
            }
        }
    }

    /// A minor word that the program will not contain.
    pub(super) fn not_used(&mut self, major: &str, word: &str, line: u32) {
        let message = format!("{major} {word} is read, but not applied");
        let hint = "write what it means into the program, or into a template";
        self.warn("not-applied", &format!("{major} {word}"), line, message, hint);
    }
}

fn unknown_unit(word: &str) -> Fault {
    let message = format!("`{}` is no unit of a feed", shown(word));
    ("bad-feed", message, "write IPM, MMPM, IPR, MMPR, PERMIN or PERREV")
}

fn speed_of(text: &str) -> Result<f64, Fault> {
    number(text).ok().filter(|v| *v >= 0.0 && *v < 1e6).ok_or_else(|| bad_spindle(text))
}

fn bad_spindle(text: &str) -> Fault {
    let message = format!("SPINDL has no word or speed `{}`", shown(text));
    ("bad-spindle", message, "write SPINDL/RPM,3000,CLW")
}

fn shown(text: &str) -> String {
    text.chars().take(40).collect()
}
