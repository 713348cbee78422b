//! Drilling by the cycles of the controls: G81 to G83, CYCLE81 to CYCLE83, cycle 200; tapping in `threads`.

mod threads;

use crate::number::{Form, increments, push};
use crate::{Modal, WriteError, WriteResult, Writer};
use std::fmt::Write as _;
use trueaxis_nc::Control;
use trueaxis_nc::moves::{Feed, FeedMode};

/// A hole along Z of the program; the tool stands over it at the retract height. Heights are Z of the program, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hole {
    /// X and Y, mm.
    pub place_mm: [f64; 2],
    /// The surface of the part.
    pub surface_mm: f64,
    /// Down to here the tool goes in rapid traverse.
    pub clearance_mm: f64,
    /// The bottom.
    pub bottom_mm: f64,
    /// Where the tool comes from and goes back to.
    pub retract_mm: f64,
    /// The depth of each peck, after which the tool leaves the hole, mm.
    pub peck_mm: Option<f64>,
    /// How long the tool waits at the bottom, s.
    pub dwell_s: f64,
    /// The feed of drilling; that of a tap is pitch times speed.
    pub feed: Feed,
    /// A thread is tapped.
    pub thread: Option<Thread>,
}

/// A thread that is tapped in step with the spindle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thread {
    /// The pitch, above 0, mm.
    pub pitch_mm: f64,
    /// Whether it is a left-hand one: the spindle turns counter-clockwise into it.
    pub left_hand: bool,
    /// The speed of the spindle. Unit: 1/min.
    pub speed_per_minute: f64,
}

impl Hole {
    /// Whether a control has one cycle for it.
    pub fn is_possible(&self, control: Control) -> bool {
        // Only cycle 200 waits at the bottom and leaves the hole after each peck.
        let both = self.peck_mm.is_some() && self.dwell_s > 0.0;
        if self.thread.is_some() && (self.peck_mm.is_some() || self.dwell_s > 0.0) {
            return false;
        }
        self.feed.mode == FeedMode::PerMinute && (control == Control::Heidenhain || !both)
    }

    /// Whether it differs from another one in its place alone.
    pub fn is_like(&self, other: &Self) -> bool {
        Self { place_mm: other.place_mm, ..*self } == *other
    }
}

/// The numbers of a cycle as a control reads them.
struct Numbers {
    form: Form,
    decimals: u8,
    feed_decimals: u8,
}

impl Numbers {
    fn text(
        value: f64,
        decimals: u8,
        form: Form,
        word: &'static str,
    ) -> Result<String, WriteError> {
        let mut text = Vec::new();
        push(&mut text, increments(value, decimals, word)?, decimals, form);
        Ok(String::from_utf8_lossy(&text).into_owned())
    }

    fn length(&self, mm: f64) -> Result<String, WriteError> {
        Self::text(mm, self.decimals, self.form, "a length of a drilling cycle")
    }

    fn time(&self, seconds: f64) -> Result<String, WriteError> {
        Self::text(seconds, 3, Form::Plain, "the dwell of a drilling cycle")
    }

    fn feed(&self, feed: &Feed) -> Result<String, WriteError> {
        let form = if self.form == Form::Point { Form::Point } else { Form::Plain };
        Self::text(feed.value, self.feed_decimals, form, "F")
    }
}

pub(super) fn first(w: &mut Writer, hole: &Hole) -> WriteResult {
    end(w);
    if !hole.is_possible(w.control) {
        let (what, instead) = ("this hole as a cycle", "write its moves");
        return Err(WriteError::NotInDialect { control: w.control_name(), what, instead });
    }
    w.feed_of(&hole.feed)?;
    let numbers =
        Numbers { form: w.form(), decimals: w.decimals.linear, feed_decimals: w.decimals.feed };
    match w.control {
        _ if hole.thread.is_some() => threads::first(w, hole, &numbers)?,
        Control::Fanuc | Control::Haas | Control::LinuxCnc => g_cycle(w, hole, &numbers)?,
        Control::Sinumerik840d => siemens_cycle(w, hole, &numbers)?,
        Control::Heidenhain => klartext_cycle(w, hole, &numbers)?,
    }
    w.modal = Modal::default();
    w.hole = Some(*hole);
    Ok(())
}

/// G98: back to where the tool was before.
fn g_cycle(w: &mut Writer, hole: &Hole, numbers: &Numbers) -> WriteResult {
    let [x, y] = hole.place_mm;
    let (code, more) = match (hole.peck_mm, hole.dwell_s > 0.0, w.control) {
        (Some(peck), ..) => ("G83", format!(" Q{}", numbers.length(peck)?)),
        (None, true, Control::LinuxCnc) => ("G82", format!(" P{}", numbers.time(hole.dwell_s)?)),
        // A number without a point counts milliseconds.
        (None, true, _) => ("G82", format!(" P{:.0}", hole.dwell_s * 1e3)),
        (None, false, _) => ("G81", String::new()),
    };
    let line = format!(
        "G94 G98 {code} X{} Y{} Z{} R{}{more} F{}",
        numbers.length(x)?,
        numbers.length(y)?,
        numbers.length(hole.bottom_mm)?,
        numbers.length(hole.clearance_mm)?,
        numbers.feed(&hole.feed)?
    );
    w.line(line.as_bytes());
    Ok(())
}

/// The cycle takes the feed that is on.
fn siemens_cycle(w: &mut Writer, hole: &Hole, numbers: &Numbers) -> WriteResult {
    let length = |mm: f64| numbers.length(mm);
    let feed = numbers.feed(&hole.feed)?;
    let heights = format!(
        "{},{},{},{}",
        length(hole.retract_mm)?,
        length(hole.surface_mm)?,
        length(hole.clearance_mm - hole.surface_mm)?,
        length(hole.bottom_mm)?
    );
    let call = match (hole.peck_mm, hole.dwell_s > 0.0) {
        // The first depth, no degression, the whole feed, out of the hole after each peck.
        (Some(peck), _) => {
            format!("CYCLE83({heights},,{},,0,0,0,1,1)", length(hole.surface_mm - peck)?)
        }
        (None, true) => format!("CYCLE82({heights},,{})", numbers.time(hole.dwell_s)?),
        (None, false) => format!("CYCLE81({heights})"),
    };
    w.line(format!("G94 F{feed}").as_bytes());
    w.line(call.as_bytes());
    Ok(())
}

/// Cycle 200; its heights count from the surface.
fn klartext_cycle(w: &mut Writer, hole: &Hole, numbers: &Numbers) -> WriteResult {
    let depth = hole.bottom_mm - hole.surface_mm;
    let time = |seconds: f64| Numbers::text(seconds, 3, Form::Signed, "a dwell");
    let parameters = [
        (200, numbers.length(hole.clearance_mm - hole.surface_mm)?, "SET-UP CLEARANCE"),
        (201, numbers.length(depth)?, "DEPTH"),
        (206, numbers.feed(&hole.feed)?, "FEED RATE FOR PLNGNG"),
        (202, numbers.length(hole.peck_mm.unwrap_or(-depth))?, "PLUNGING DEPTH"),
        (210, time(0.0)?, "DWELL TIME AT TOP"),
        (203, numbers.length(hole.surface_mm)?, "SURFACE COORDINATE"),
        (204, numbers.length(hole.retract_mm - hole.surface_mm)?, "2ND SET-UP CLEARANCE"),
        (211, time(hole.dwell_s)?, "DWELL TIME AT DEPTH"),
    ];
    let text = "CYCL DEF 200 DRILLING ~".to_owned();
    klartext_call(w, text, &parameters);
    Ok(())
}

/// The parameters of a cycle below its name, and its call.
fn klartext_call(w: &mut Writer, mut text: String, parameters: &[(u32, String, &str)]) {
    for (i, (number, value, name)) in parameters.iter().enumerate() {
        let more = if i + 1 == parameters.len() { "" } else { " ~" };
        let _ = write!(text, "\n    Q{number}={value} ;{name}{more}");
    }
    w.line(text.as_bytes());
    w.line(b"CYCL CALL");
}

pub(super) fn next(w: &mut Writer, place_mm: [f64; 2]) -> WriteResult {
    let Some(hole) = w.hole else {
        let (what, instead) = ("a further hole", "write the first one before");
        return Err(WriteError::NotInDialect { control: w.control_name(), what, instead });
    };
    let decimals = w.decimals.linear;
    let mut words = String::new();
    for (letter, value) in ["X", "Y"].into_iter().zip(place_mm) {
        let _ = write!(words, " {letter}{}", Numbers::text(value, decimals, w.form(), letter)?);
    }
    let line = match w.control {
        Control::Heidenhain => format!("L{words} R0 FMAX M99"),
        Control::Sinumerik840d => format!("G0{words}"),
        Control::LinuxCnc if hole.thread.is_some() => format!("G0{words}"),
        _ => words.trim_start().to_owned(),
    };
    w.line(line.as_bytes());
    let numbers = Numbers { form: w.form(), decimals, feed_decimals: w.decimals.feed };
    let hole = Hole { place_mm, ..hole };
    match (w.control, hole.thread.is_some()) {
        (Control::Sinumerik840d | Control::LinuxCnc, true) => threads::first(w, &hole, &numbers),
        (Control::Sinumerik840d, false) => siemens_cycle(w, &hole, &numbers),
        _ => Ok(()),
    }
}

/// After it all modal words are written again.
pub(super) fn end(w: &mut Writer) {
    let Some(hole) = w.hole.take() else { return };
    match w.control {
        // Its taps are moves.
        Control::LinuxCnc if hole.thread.is_some() => {}
        // They call their cycles hole by hole.
        Control::Heidenhain | Control::Sinumerik840d => {}
        _ => w.line(b"G80"),
    }
    w.modal = Modal::default();
}
