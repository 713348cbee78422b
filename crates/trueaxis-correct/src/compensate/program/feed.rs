//! The feed of a block whose way, or time, is another after the correction.

use super::block::{Block, Put, Written};
use super::number::Unit;
use super::refuse::refusal;
use super::words::Word;
use trueaxis_motion::axis_path::Fault;
use trueaxis_nc::Control;
use trueaxis_nc::moves::{FeedMode, Move, MoveKind, Position};

impl Block<'_> {
    /// The feed, where the same number would mean another time.
    pub(super) fn feed(
        &mut self,
        now: &Position,
        step: &Written,
        turns_deg: Option<f64>,
        m: &Move,
        puts: &mut Vec<Put>,
    ) -> Result<Option<f64>, Fault> {
        let word = self.words.feed.as_ref().filter(|_| step.piece == 0);
        if m.kind == MoveKind::Rapid {
            return Ok(self.feed_again.filter(|_| word.is_none()));
        }
        let feed = self.m.feed.value;
        let way: f64 = (0..3).map(|i| (m.target.0[i] - now.0[i]).powi(2)).sum::<f64>().sqrt();
        let (value, again) = match (self.m.feed.mode, turns_deg) {
            // A piece in which an axis takes up its play has no part of the way, but needs some time.
            (FeedMode::InverseTime, _) if self.pieces > 1 => (feed / step.share.max(1e-4), None),
            // The tip moves a little now, and the feed counts along that.
            (FeedMode::PerMinute, Some(turned)) if way > 1e-9 && step.share > 0.0 => {
                (feed * way / (turned * step.share), Some(feed))
            }
            (FeedMode::PerMinute, _) if word.is_none() && step.piece == 0 => {
                match self.feed_again.take() {
                    Some(feed) => (feed, None),
                    None => return Ok(None),
                }
            }
            _ => return Ok(None),
        };
        let unit = match (self.m.feed.mode, self.feed_unit, self.control) {
            (FeedMode::InverseTime, ..) | (_, Unit::Millimetre, _) => 1.0,
            // HEIDENHAIN counts in tenths of an inch.
            (.., Control::Heidenhain) => 2.54,
            _ => 25.4,
        };
        let text = feed_text(value / unit, self.control);
        match word {
            None if self.resting.feed => {
                let message =
                    "the feed is computed before, and would have to be changed".to_owned();
                Err(refusal(self.m.origin, "computed-feed", message, "write a number after F"))?;
            }
            Some(Word { value: None, .. }) => {
                let message = "the feed is computed, and would have to be changed".to_owned();
                let hint = "write a number after F";
                return Err(refusal(self.m.origin, "computed-feed", message, hint));
            }
            Some(word) => self.edits.put(word.number.clone(), &text),
            None => puts.push(Put { letters: "F", text }),
        }
        Ok(again)
    }
}

/// A feed to six digits.
fn feed_text(value: f64, control: Control) -> String {
    let digits = (5 - value.abs().log10().floor() as i32).clamp(0, 12) as usize;
    let mut text = format!("{value:.digits$}");
    if text.contains('.') {
        text.truncate(text.trim_end_matches('0').trim_end_matches('.').len());
    }
    if control == Control::Fanuc && !text.contains('.') {
        text.push('.');
    }
    text
}
