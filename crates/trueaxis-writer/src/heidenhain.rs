//! HEIDENHAIN Klartext: numbered blocks, a sign before every coordinate, FMAX for one block.

use crate::number::{Form, push};
use crate::{Target, WriteError, WriteResult, Writer};
use trueaxis_nc::moves::{Axis, Coordinates, Feed, FeedMode};

pub(super) const DWELL: (&[u8], Form) = (b"FUNCTION DWELL TIME", Form::Plain);

pub(super) fn straight(w: &mut Writer, target: &Target, feed: Option<&Feed>) -> WriteResult {
    if feed.is_some_and(|f| f.mode != FeedMode::PerMinute) {
        let what = "a feed other than in mm/min";
        let instead = "use feed per minute";
        return Err(WriteError::NotInDialect { control: "HEIDENHAIN", what, instead });
    }
    let place = w.place_of(target)?;
    let direction = w.direction_of(target)?;
    let value = feed.map(|f| w.feed_of(f)).transpose()?;
    let machine = target.coordinates == Coordinates::Machine;
    let known = if machine { [None; 9] } else { w.modal.place };
    let moves = place.iter().zip(&known).any(|(new, old)| new.is_some() && new != old);
    if !moves && (direction.is_none() || direction == w.modal.direction) {
        return Ok(());
    }
    w.begin();
    w.text.extend_from_slice(if direction.is_some() { b"LN" } else { b"L" });
    for (i, new) in place.iter().enumerate() {
        // A block with vectors has all coordinates.
        let Some(increments) = new.filter(|_| direction.is_some() || *new != known[i]) else {
            continue;
        };
        let axis = Axis::ALL[i];
        w.text.extend_from_slice(&[b' ', axis.letter()]);
        push(&mut w.text, increments, w.decimals.of(axis), Form::Signed);
    }
    if let Some(parts) = direction {
        for (letter, part) in b"XYZ".iter().zip(parts) {
            w.text.extend_from_slice(&[b' ', b'T', *letter]);
            push(&mut w.text, part, w.decimals.vector, Form::Signed);
        }
        w.modal.direction = Some(parts);
    } else if !std::mem::replace(&mut w.modal.side, true) {
        w.text.extend_from_slice(b" R0");
    }
    match value {
        None => w.text.extend_from_slice(b" FMAX"),
        Some(value) if w.modal.feed == Some(value) => {}
        Some(value) => {
            w.text.extend_from_slice(b" F");
            push(&mut w.text, value, w.decimals.feed, Form::Plain);
            w.modal.feed = Some(value);
        }
    }
    if machine {
        w.text.extend_from_slice(b" M91");
    }
    w.end();
    w.keep(&place, machine);
    Ok(())
}
