//! FANUC: a point in every number, G53 in rapid only.

use crate::number::Form;
use crate::{Target, WriteError, WriteResult, Writer};
use trueaxis_nc::moves::{Coordinates, Feed};

/// X counts seconds.
pub(super) const DWELL: (&[u8], Form) = (b"G4 X", Form::Point);

/// With a decimal point P counts seconds on Haas.
pub(super) const DWELL_OF_HAAS: (&[u8], Form) = (b"G4 P", Form::Point);

pub(super) fn straight(w: &mut Writer, target: &Target, feed: Option<&Feed>) -> WriteResult {
    let machine = target.coordinates == Coordinates::Machine;
    if machine && feed.is_some() {
        let what = "a move with feed from the machine zero (G53)";
        let instead = "use a work offset of 0, or a rapid move";
        return Err(WriteError::NotInDialect { control: "FANUC", what, instead });
    }
    let before: &[u8] = if machine { b"G53 " } else { b"" };
    w.g_straight(target, feed, before, [b"I", b"J", b"K"])
}
