//! What is written the same way, or nearly so, for all controls.

use crate::number::{Form, increments, push};
use crate::template::Values;
use crate::{Heading, Modal, Target, TipWords, ToolCall, WriteError, Writer};
use crate::{fanuc, heidenhain, linuxcnc, sinumerik};
use trueaxis_nc::Control;
use trueaxis_nc::moves::{Axis, Coordinates, Feed, FeedMode, SpindleDirection};

/// Comments and messages are cut at this length: controls have short lines.
const LONGEST_TEXT: usize = 100;

impl Writer {
    /// A whole line.
    pub(super) fn line(&mut self, words: &[u8]) {
        self.begin();
        self.text.extend_from_slice(words);
        self.end();
    }

    /// The number of a block, where blocks have one.
    pub(super) fn begin(&mut self) {
        if self.control == Control::Heidenhain {
            push(&mut self.text, i64::from(self.number), 0, Form::Plain);
            self.text.push(b' ');
            self.number += 1;
        }
    }

    pub(super) fn end(&mut self) {
        self.text.push(b'\n');
    }

    /// Lines of a template or of the user, without the empty ones.
    pub(super) fn lines(&mut self, text: &str) {
        for line in text.lines().map(str::trim).filter(|l| !l.is_empty()) {
            self.line(line.as_bytes());
        }
    }

    pub(super) fn values(&self) -> Values {
        Values {
            name: self.name.clone(),
            tool: self.tool,
            offset: self.offset.unwrap_or(self.tool),
            edge: self.offset.unwrap_or(1),
            vectors: self.words == TipWords::Vectors,
            length: self.words == TipWords::Length,
            machine_coordinates: self.machine_coordinates,
            ..Values::default()
        }
    }

    /// Renders a block of the template; after it all modal words are written again.
    pub(super) fn by_template(&mut self, block: &str, values: &Values) -> Result<(), WriteError> {
        let text = self.templates.render(block, values)?;
        self.lines(&text);
        self.modal = Modal::default();
        Ok(())
    }

    pub(super) fn start(&mut self, heading: &Heading<'_>) -> Result<(), WriteError> {
        self.name = self.plain_name(heading.name);
        self.machine_coordinates = heading.machine_coordinates;
        let tolerance = increments(heading.tolerance_mm, 6, "tolerance")?;
        let mut shown = Vec::new();
        push(&mut shown, tolerance, 6, Form::Plain);
        let values = Values {
            number: format!("{:04}", heading.number),
            comments: heading.comments.iter().map(|line| self.plain_text(line)).collect(),
            tolerance: String::from_utf8_lossy(&shown).into_owned(),
            ..self.values()
        };
        self.by_template("start", &values)
    }

    pub(super) fn tool(&mut self, call: &ToolCall<'_>) -> Result<(), WriteError> {
        (self.tool, self.offset) = (call.number, call.offset);
        let mut speed = Vec::new();
        if let Some(value) = call.speed_per_minute {
            let decimals = self.decimals.feed;
            push(&mut speed, increments(value, decimals, "S")?, decimals, Form::Plain);
        }
        let values = Values {
            text: self.plain_text(call.text),
            speed: String::from_utf8_lossy(&speed).into_owned(),
            ..self.values()
        };
        self.by_template("tool", &values)
    }

    pub(super) fn tip_on(&mut self, words: TipWords) -> Result<(), WriteError> {
        let vectors = words == TipWords::Vectors;
        if vectors && matches!(self.control, Control::Haas | Control::LinuxCnc) {
            let control = if self.control == Control::Haas { "HAAS" } else { "LinuxCNC" };
            let what = "the tool axis as a vector";
            let instead = "write the rotary axes";
            return Err(WriteError::NotInDialect { control, what, instead });
        }
        self.words = words;
        if std::mem::take(&mut self.without_length) {
            let edge = format!("D{}", self.offset.unwrap_or(1));
            self.line(edge.as_bytes());
        }
        self.by_template("tip_on", &self.values())
    }

    pub(super) fn tip_off(&mut self) -> Result<(), WriteError> {
        self.by_template("tip_off", &self.values())
    }

    /// What remains of a name in all controls.
    fn plain_name(&self, name: &str) -> String {
        let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
        let name: String = name.chars().take(24).map(plain).collect();
        let upper = matches!(self.control, Control::Fanuc | Control::Haas | Control::Heidenhain);
        let name = if upper { name.to_ascii_uppercase() } else { name };
        if name.is_empty() { "PROGRAM".to_owned() } else { name }
    }

    /// What remains of a text between the marks of a comment.
    pub(super) fn plain_text(&self, text: &str) -> String {
        let plain = |c: char| match c {
            '(' => '[',
            ')' => ']',
            '"' => '\'',
            // Marks of tapes, skipped blocks and statements that go on in the next line.
            '%' | ';' | '~' => ' ',
            ' '..='~' => c,
            _ => '?',
        };
        let spaced = |c: char| if c.is_control() { ' ' } else { c };
        let text: String = text.chars().take(LONGEST_TEXT).map(spaced).map(plain).collect();
        let text = text.trim().to_owned();
        match self.control {
            Control::Fanuc | Control::Haas => text.to_ascii_uppercase(),
            _ => text,
        }
    }

    pub(super) fn comment(&mut self, text: &str) {
        let text = self.plain_text(text);
        let words = match self.control {
            Control::Fanuc | Control::Haas => format!("({text})"),
            // A comma would make some of them statements, such as (PRINT,…).
            Control::LinuxCnc => format!("({})", text.replacen(',', " ", 1)),
            Control::Sinumerik840d | Control::Heidenhain => format!("; {text}"),
        };
        self.line(words.as_bytes());
    }

    pub(super) fn message(&mut self, text: &str) {
        let text = self.plain_text(text);
        let words = match self.control {
            Control::Fanuc | Control::Haas => format!("({text})"),
            Control::LinuxCnc => format!("(MSG, {text})"),
            Control::Sinumerik840d => format!("MSG(\"{text}\")"),
            Control::Heidenhain => format!("; {text}"),
        };
        self.line(words.as_bytes());
    }

    pub(super) fn stop(&mut self, optional: bool, message: Option<&str>) {
        if let Some(text) = message {
            // FANUC and HEIDENHAIN show the comment of the block that they stop at.
            self.message(text);
        }
        self.line(if optional { b"M1" } else { b"M0" });
    }

    pub(super) fn spindle(
        &mut self,
        turning: SpindleDirection,
        speed: f64,
    ) -> Result<(), WriteError> {
        let decimals = self.decimals.feed;
        let speed = increments(speed, decimals, "S")?;
        let code: &[u8] = match turning {
            SpindleDirection::Stopped => {
                self.line(b"M5");
                return Ok(());
            }
            SpindleDirection::Clockwise => b"M3",
            SpindleDirection::CounterClockwise => b"M4",
        };
        if speed > 0 {
            self.begin();
            let word: &[u8] =
                if self.control == Control::Heidenhain { b"TOOL CALL S" } else { b"S" };
            self.text.extend_from_slice(word);
            push(&mut self.text, speed, decimals, Form::Plain);
            if self.control == Control::Heidenhain {
                self.end();
                self.begin();
            } else {
                self.text.push(b' ');
            }
        } else {
            self.begin();
        }
        self.text.extend_from_slice(code);
        self.end();
        Ok(())
    }

    pub(super) fn dwell(&mut self, seconds: f64) -> Result<(), WriteError> {
        let decimals = self.decimals.feed.max(3);
        let time = increments(seconds, decimals, "the time of a dwell")?;
        if time < 0 {
            return Err(WriteError::Number { word: "the time of a dwell", value: seconds });
        }
        let (word, form) = match self.control {
            Control::Heidenhain => heidenhain::DWELL,
            Control::Fanuc => fanuc::DWELL,
            Control::Haas => fanuc::DWELL_OF_HAAS,
            Control::LinuxCnc => linuxcnc::DWELL,
            Control::Sinumerik840d => sinumerik::DWELL,
        };
        self.begin();
        self.text.extend_from_slice(word);
        push(&mut self.text, time, decimals, form);
        self.end();
        // G4 may stand for the motion in the next block: it is written again.
        self.modal.rapid = None;
        Ok(())
    }

    /// The place of a target in least increments, for the named axes.
    pub(super) fn place_of(&self, target: &Target) -> Result<[Option<i64>; 9], WriteError> {
        const WORDS: [&str; 9] = ["X", "Y", "Z", "A", "B", "C", "U", "V", "W"];
        let mut place = [None; 9];
        for axis in Axis::ALL {
            let i = axis as usize;
            if target.named.contains(axis) {
                let decimals = self.decimals.of(axis);
                place[i] = Some(increments(target.place.0[i], decimals, WORDS[i])?);
            }
        }
        Ok(place)
    }

    /// A direction in least increments, if the target has one.
    pub(super) fn direction_of(&self, target: &Target) -> Result<Option<[i64; 3]>, WriteError> {
        let Some(direction) = target.direction else { return Ok(None) };
        let mut parts = [0; 3];
        for (part, value) in parts.iter_mut().zip(direction) {
            *part = increments(value, self.decimals.vector, "the tool axis")?;
        }
        match parts {
            [0, 0, 0] => Err(WriteError::Number { word: "the tool axis", value: 0.0 }),
            _ => Ok(Some(parts)),
        }
    }

    /// The feed in least increments.
    pub(super) fn feed_of(&self, feed: &Feed) -> Result<i64, WriteError> {
        let decimals = self.decimals.feed;
        match increments(feed.value, decimals, "F")? {
            value if value > 0 => Ok(value),
            _ => Err(WriteError::Feed { value: feed.value, decimals }),
        }
    }

    /// A straight block of the controls with G codes: `before` stands in front where it is not
    /// empty, `vector` before each part of the direction.
    pub(super) fn g_straight(
        &mut self,
        target: &Target,
        feed: Option<&Feed>,
        before: &[u8],
        vector: [&[u8]; 3],
    ) -> Result<(), WriteError> {
        let place = self.place_of(target)?;
        let direction = self.direction_of(target)?;
        let value = feed.map(|f| self.feed_of(f)).transpose()?;
        let machine = target.coordinates == Coordinates::Machine;
        let known = if machine { [None; 9] } else { self.modal.place };
        let moves = place.iter().zip(&known).any(|(new, old)| new.is_some() && new != old);
        if !moves && (direction.is_none() || direction == self.modal.direction) {
            return Ok(());
        }
        let start = self.text.len();
        self.feed_mode(feed);
        self.text.extend_from_slice(before);
        let rapid = feed.is_none();
        if self.modal.rapid != Some(rapid) || !before.is_empty() {
            self.text.extend_from_slice(if rapid { b"G0 " } else { b"G1 " });
            self.modal.rapid = Some(rapid);
        }
        let form = self.form();
        for (i, new) in place.iter().enumerate() {
            let Some(increments) = new.filter(|_| *new != known[i]) else { continue };
            let axis = Axis::ALL[i];
            self.text.push(axis.letter());
            push(&mut self.text, increments, self.decimals.of(axis), form);
            self.text.push(b' ');
        }
        if let Some(parts) = direction.filter(|d| Some(*d) != self.modal.direction) {
            for (word, part) in vector.iter().zip(parts) {
                self.text.extend_from_slice(word);
                push(&mut self.text, part, self.decimals.vector, form);
                self.text.push(b' ');
            }
            self.modal.direction = Some(parts);
        }
        if let (Some(feed), Some(value)) = (feed, value)
            && (feed.mode == FeedMode::InverseTime || self.modal.feed != Some(value))
        {
            self.text.push(b'F');
            let form = if form == Form::Point { Form::Point } else { Form::Plain };
            push(&mut self.text, value, self.decimals.feed, form);
            self.text.push(b' ');
            self.modal.feed = Some(value);
        }
        debug_assert!(self.text.len() > start);
        // The last word's space becomes the end of the line.
        if let Some(last) = self.text.last_mut() {
            *last = b'\n';
        }
        self.keep(&place, machine);
        Ok(())
    }

    /// G93, G94 or G95, where it is another one.
    pub(super) fn feed_mode(&mut self, feed: Option<&Feed>) {
        let mode = feed.map(|f| f.mode);
        if mode.is_none() || mode == self.modal.feed_mode {
            return;
        }
        self.text.extend_from_slice(match mode {
            Some(FeedMode::InverseTime) => b"G93 ",
            Some(FeedMode::PerRevolution) => b"G95 ",
            Some(FeedMode::PerMinute) | None => b"G94 ",
        });
        (self.modal.feed_mode, self.modal.feed) = (mode, None);
    }

    /// Keeps what the control now knows; a move from the machine zero leaves the program place
    /// unknown.
    pub(super) fn keep(&mut self, place: &[Option<i64>; 9], machine: bool) {
        if machine {
            self.modal.place = [None; 9];
            return;
        }
        for (known, new) in self.modal.place.iter_mut().zip(place) {
            if new.is_some() {
                *known = *new;
            }
        }
        let turns = Axis::ALL[3..6].iter().any(|a| place[*a as usize].is_some());
        if turns {
            self.modal.direction = None;
        }
    }
}
