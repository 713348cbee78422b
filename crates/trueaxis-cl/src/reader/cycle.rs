//! CYCLE: the words of drilling and tapping in the forms of several systems.

use super::super::numbers::{Fault, number};
use super::super::scan::Statement;
use super::super::{ClCycle, ClTap, Word};
use super::technology::{feed, feed_unit};
use super::{INCH_MM, Reader};
use trueaxis_nc::moves::{Feed, FeedMode};

/// Pecks of one hole: more than any file means.
const MOST_PECKS: f64 = 1e5;

/// Heights of a cycle that differ by less are the same, mm.
const SAME_MM: f64 = 1e-6;

const HINT: &str = "write CYCLE/DRILL,FEDTO,10,MMPM,200,RAPTO,2";

const TAP_HINT: &str = "write CYCLE/TAP,FEDTO,10,MMPR,1.25,RAPTO,3";

/// Largest pitch of a tap, mm: one inch.
const MOST_PITCH_MM: f64 = INCH_MM;

/// Two statements of one pitch differ by no more than this share: feeds are often rounded to whole numbers.
pub const SAME_PITCH: f64 = 5e-3;

/// The words of one CYCLE; lengths in mm.
#[derive(Debug, Default)]
struct Words {
    depth: Option<f64>,
    clearance: Option<f64>,
    retract: Option<f64>,
    to_begin: bool,
    feed: Option<Feed>,
    /// The pitch by its own word, or by a feed per revolution, mm.
    pitches: Vec<f64>,
    /// The last feed per minute.
    per_minute: Option<Feed>,
    /// Words that only a thread has.
    of_thread: Vec<String>,
    dwell_s: f64,
    first: Option<f64>,
    step: Option<f64>,
    is_deep: bool,
    /// Numbers without a word.
    loose: Vec<f64>,
    /// Words that are not applied.
    others: Vec<String>,
}

impl Reader<'_> {
    /// CYCLE/DRILL,FEDTO,depth,MMPM,feed,RAPTO,clearance,RTRCTO,retract (SolidWorks, Creo, NX with the depth below
    /// zero), DEPTH … CLEAR … RETURN (CATIA), or depth, feed, unit, clearance without words. CYCLE/DEEP or DEEP with
    /// 1STPECK and SUBPECK, or STEP, pecks.
    pub(super) fn cycle(&mut self, s: &Statement) -> Result<Word, Fault> {
        let word = self.cycle_or_off(s)?;
        match word {
            Word::Cycle(_) => self.cycle_on = self.cycle_on.or(Some(s.line)),
            Word::CycleOff => self.cycle_on = None,
            _ => {}
        }
        Ok(word)
    }

    fn cycle_or_off(&mut self, s: &Statement) -> Result<Word, Fault> {
        let kind = s.argument(0).to_ascii_uppercase();
        match kind.as_str() {
            "OFF" | "NOMORE" => return Ok(Word::CycleOff),
            "INIT" => return Ok(Word::Noted),
            "ON" => return self.cycle_again(),
            "THREAD" | "MILL" => {
                let message = format!("CYCLE/{kind} is not read: a motion other than drilling");
                return Err((
                    "motion-not-read",
                    message,
                    "write these holes in a program of their own",
                ));
            }
            _ if number(&kind).is_ok() || kind.is_empty() => {
                return Err(("bad-cycle", "the cycle has no kind".to_owned(), HINT));
            }
            _ => {}
        }
        let words = self.cycle_words(s)?;
        if matches!(kind.as_str(), "TAP" | "RTAP" | "RIGID") {
            return self.tapping(&kind, &words, s.line);
        }
        self.warn_of_others(&kind, &words.others, s.line);
        self.warn_of_others(&kind, &words.of_thread, s.line);
        let is_deep = words.is_deep || kind.starts_with("DEEP");
        let cycle = words.cycle(is_deep, kind == "REAM")?;
        self.warn_of_clearance(&kind, &words, s.line);
        let is_drilling = matches!(kind.as_str(), "DRILL" | "FACE" | "REAM" | "CSINK");
        if !is_drilling && cycle.pecks_mm.is_none() {
            let message = format!("CYCLE/{kind} is read as drilling in one stroke");
            let hint = "pecks and the retraction of the cycle are omitted; check the hole";
            self.warn("cycle-not-applied", &kind, s.line, message, hint);
        }
        self.cycle = Some(cycle);
        Ok(Word::Cycle(cycle))
    }

    /// Without a clearance rapid traverse ends on the surface.
    fn warn_of_clearance(&mut self, kind: &str, words: &Words, line: u32) {
        if words.clearance.is_none() {
            let message = format!(
                "CYCLE/{kind} states no clearance: rapid traverse ends at the point, on the surface"
            );
            let hint = "write RAPTO (CLEAR) with the height above the point";
            self.warn("no-clearance", kind, line, message, hint);
        }
    }

    fn warn_of_others(&mut self, kind: &str, others: &[String], line: u32) {
        for word in others {
            let message = format!("{word} of CYCLE/{kind} is read, but not applied");
            let hint = "check the hole";
            self.warn("cycle-not-applied", &format!("{kind} {word}"), line, message, hint);
        }
    }

    /// CYCLE/TAP, RTAP or RIGID: the pitch after PITCH or TPI, or as a feed per revolution.
    fn tapping(&mut self, kind: &str, words: &Words, line: u32) -> Result<Word, Fault> {
        if words.is_deep || words.first.is_some() || words.step.is_some() {
            let message = format!("CYCLE/{kind} with pecks is not read: a tap cuts in one stroke");
            return Err(("bad-cycle", message, TAP_HINT));
        }
        let pitch_mm = words.pitch()?;
        self.warn_of_others(kind, &words.others, line);
        if words.dwell_s > 0.0 {
            self.warn_of_others(kind, &["DWELL".to_owned()], line);
        }
        let drilled = words.cycle(false, true)?;
        if drilled.depth_mm == 0.0 {
            return Err(("bad-cycle", format!("CYCLE/{kind} has no depth"), TAP_HINT));
        }
        self.warn_of_clearance(kind, words, line);
        let (feed, tap) = (words.per_minute.or(words.feed), Some(ClTap { pitch_mm }));
        let cycle = ClCycle { dwell_s: 0.0, feed, tap, ..drilled };
        self.cycle = Some(cycle);
        Ok(Word::Cycle(cycle))
    }

    fn cycle_again(&self) -> Result<Word, Fault> {
        let message = "CYCLE/ON, but no cycle is before it".to_owned();
        self.cycle.map(Word::Cycle).ok_or(("bad-cycle", message, HINT))
    }

    fn cycle_words(&self, s: &Statement) -> Result<Words, Fault> {
        let arguments: Vec<&str> = s.arguments().skip(1).filter(|a| !a.is_empty()).collect();
        let mut words = Words::default();
        let mut at = 0;
        while let Some(argument) = arguments.get(at) {
            at += 1;
            if let Ok(value) = number(argument) {
                match at {
                    1 => words.depth = Some(value * self.unit_mm),
                    _ => words.loose.push(value),
                }
                continue;
            }
            let word = argument.to_ascii_uppercase();
            let rest = &arguments[at..];
            at += self.cycle_word(&word, rest, &mut words)?;
        }
        if let Some(value) = words.loose.pop() {
            // After depth, feed and unit.
            if !words.loose.is_empty() || words.clearance.is_some() || words.feed.is_none() {
                let message =
                    format!("the cycle has the number {value}, and no word says what it is");
                return Err(("bad-cycle", message, HINT));
            }
            words.clearance = Some(value * self.unit_mm);
        }
        Ok(words)
    }

    /// Takes a word and what follows it; how many arguments that were.
    fn cycle_word(&self, word: &str, rest: &[&str], words: &mut Words) -> Result<usize, Fault> {
        let first = rest.first().copied().unwrap_or_default();
        let length = || Ok::<_, Fault>(Some(number(first)? * self.unit_mm));
        if let Some(unit) = feed_unit(word, self.unit_mm) {
            // Before its unit, or after it.
            let (value, taken) = match words.loose.pop() {
                Some(value) => (value, 0),
                None => (number(first)?, 1),
            };
            let feed = feed(value, unit)?;
            match feed.mode {
                FeedMode::PerRevolution => words.pitches.push(feed.value),
                // Beside a pitch it is to be that of the spindle.
                _ => words.per_minute = Some(feed),
            }
            words.feed = Some(feed);
            return Ok(taken);
        }
        match word {
            "FEDTO" | "DEPTH" => words.depth = length()?,
            "RAPTO" | "CLEAR" => words.clearance = length()?,
            "RTRCTO" | "RETURN" => match number(first).is_ok() {
                true => words.retract = length()?,
                false => return Ok(0),
            },
            // Back to where the tool came from.
            "AUTO" => {
                words.to_begin = true;
                return Ok(0);
            }
            "PITCH" | "TPI" => {
                let value = number(first)?;
                let mm = if word == "TPI" { INCH_MM / value } else { value * self.unit_mm };
                words.pitches.push(mm);
                words.of_thread.push(word.to_owned());
            }
            "DEEP" => {
                words.is_deep = true;
                return Ok(0);
            }
            "MANUAL" => return Ok(0),
            "1STPECK" => words.first = length()?,
            "SUBPECK" | "STEP" => words.step = length()?,
            "DWELL" => return self.cycle_dwell(rest, words),
            _ => {
                words.others.push(word.to_owned());
                return Ok(rest.iter().take_while(|a| number(a).is_ok()).count());
            }
        }
        Ok(1)
    }

    fn cycle_dwell(&self, rest: &[&str], words: &mut Words) -> Result<usize, Fault> {
        let is_rev = |text: Option<&&str>| text.is_some_and(|t| t.eq_ignore_ascii_case("REV"));
        if rest.first().is_some_and(|t| t.eq_ignore_ascii_case("OFF")) {
            return Ok(1);
        }
        let count = if is_rev(rest.first()) || is_rev(rest.get(1)) { 2 } else { 1 };
        words.dwell_s = self.dwell_s(rest.get(..count).unwrap_or_default())?;
        Ok(count)
    }
}

impl Words {
    /// The pitch of a thread, if it is stated; all statements of it are the same.
    fn pitch(&self) -> Result<Option<f64>, Fault> {
        let Some(pitch) = self.pitches.first().copied() else { return Ok(None) };
        if !self.pitches.iter().all(|p| *p > 0.0 && *p <= MOST_PITCH_MM) {
            let message = "the pitch of the thread is not above 0 and up to 25.4 mm".to_owned();
            return Err(("bad-cycle", message, TAP_HINT));
        }
        match self.pitches.iter().find(|p| (*p - pitch).abs() > SAME_PITCH * pitch) {
            None => Ok(Some(pitch)),
            Some(other) => {
                let message =
                    format!("the cycle states a pitch of {pitch} mm and one of {other} mm");
                Err(("contradicting-pitch", message, TAP_HINT))
            }
        }
    }

    fn cycle(&self, is_deep: bool, feeds_out: bool) -> Result<ClCycle, Fault> {
        // NX counts the depth along the tool axis, below zero.
        let Some(depth_mm) = self.depth.map(f64::abs) else {
            return Err(("bad-cycle", "the cycle has no depth".to_owned(), HINT));
        };
        let clearance_mm = self.clearance.unwrap_or(0.0);
        if clearance_mm < 0.0 {
            let message = format!("the clearance {clearance_mm} mm is below the point");
            return Err(("bad-cycle", message, HINT));
        }
        // RETURN,0 states none.
        if let Some(retract) = self.retract.filter(|mm| *mm != 0.0 && *mm < clearance_mm - SAME_MM)
        {
            let message =
                format!("the retract height {retract} mm is below the clearance {clearance_mm} mm");
            let hint =
                "the tool would cross to the next hole there: write RTRCTO above RAPTO, or none";
            return Err(("bad-cycle", message, hint));
        }
        let positive = |length: Option<f64>| length.filter(|v| *v > 0.0);
        let peck = positive(self.step);
        let first = positive(self.first).or(peck);
        let pecks_mm = first.filter(|_| is_deep).map(|first| [first, peck.unwrap_or(first)]);
        if pecks_mm.is_some_and(|[_, peck]| depth_mm / peck > MOST_PECKS) {
            let message = "the cycle has more than 100,000 pecks".to_owned();
            return Err(("bad-cycle", message, "check SUBPECK and the units"));
        }
        Ok(ClCycle {
            depth_mm,
            clearance_mm,
            retract_mm: self.retract.unwrap_or(clearance_mm).max(clearance_mm),
            to_begin: self.to_begin,
            pecks_mm,
            dwell_s: self.dwell_s,
            feeds_out,
            feed: self.feed,
            tap: None,
        })
    }
}
