//! Arcs: G2 and G3 with the centre from the start, CC and C of HEIDENHAIN.

use crate::number::{Form, increments, push};
use crate::{Target, WriteError, WriteResult, Writer};
use trueaxis_nc::Control;
use trueaxis_nc::moves::{Coordinates, Feed, FeedMode};

/// An arc of at most one turn about Z of the program, from the present place to a target.
///
/// A target with another Z is the end of a helix. Where the target is the present place it is a whole circle.
/// Other planes are not written: with them the tool length of some controls acts along another axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CircularArc {
    /// The centre along X and Y, mm.
    pub center_mm: [f64; 2],
    /// Whether the tool turns to the left (G3, DR+).
    pub ccw: bool,
}

pub(super) fn write(
    w: &mut Writer,
    target: &Target,
    arc: &CircularArc,
    feed: &Feed,
) -> WriteResult {
    let place = w.place_of(target)?;
    let value = w.feed_of(feed)?;
    let word = "the centre of an arc";
    let [x, y] = arc.center_mm;
    let center = [increments(x, w.decimals.linear, word)?, increments(y, w.decimals.linear, word)?];
    let (from, to) = (&w.modal.place, &place);
    let plain = target.coordinates == Coordinates::Program && target.direction.is_none();
    let rises = to[2].is_some_and(|z| from[2] != Some(z));
    let klartext = w.control == Control::Heidenhain;
    let ends = [from[0], from[1], to[0], to[1]];
    let (true, false, [Some(a), Some(b), Some(x), Some(y)]) =
        (plain && feed.mode == FeedMode::PerMinute, klartext && rises, ends)
    else {
        let (what, instead) = ("this arc", "write lines");
        return Err(WriteError::NotInDialect { control: w.control_name(), what, instead });
    };
    match klartext {
        true => klartext_arc(w, [x, y], center, arc.ccw),
        false => g_arc(w, ([a, b], [x, y]), place[2].filter(|_| rises), center, (arc.ccw, feed)),
    }
    if w.modal.feed != Some(value) {
        w.text.extend_from_slice(b" F");
        let form = if w.form() == Form::Point { Form::Point } else { Form::Plain };
        push(&mut w.text, value, w.decimals.feed, form);
        w.modal.feed = Some(value);
    }
    w.end();
    w.keep(&place, false);
    w.modal.rapid = None;
    Ok(())
}

/// I and J count from the start.
fn g_arc(
    w: &mut Writer,
    (from, to): ([i64; 2], [i64; 2]),
    z: Option<i64>,
    center: [i64; 2],
    (ccw, feed): (bool, &Feed),
) {
    w.feed_mode(Some(feed));
    w.text.extend_from_slice(if ccw { b"G3" } else { b"G2" });
    let (form, decimals) = (w.form(), w.decimals.linear);
    let words = [
        (b'X', Some(to[0])),
        (b'Y', Some(to[1])),
        (b'Z', z),
        (b'I', Some(center[0] - from[0])),
        (b'J', Some(center[1] - from[1])),
    ];
    for (letter, value) in words {
        let Some(value) = value else { continue };
        w.text.extend_from_slice(&[b' ', letter]);
        push(&mut w.text, value, decimals, form);
    }
}

fn klartext_arc(w: &mut Writer, to: [i64; 2], center: [i64; 2], ccw: bool) {
    let decimals = w.decimals.linear;
    let coordinates = |w: &mut Writer, word: &[u8], at: [i64; 2]| {
        w.begin();
        w.text.extend_from_slice(word);
        for (letter, value) in b"XY".iter().zip(at) {
            w.text.extend_from_slice(&[b' ', *letter]);
            push(&mut w.text, value, decimals, Form::Signed);
        }
    };
    coordinates(w, b"CC", center);
    w.end();
    coordinates(w, b"C", to);
    w.text.extend_from_slice(if ccw { b" DR+" } else { b" DR-" });
}
