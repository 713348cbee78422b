//! SINUMERIK 840D: vectors as A3 B3 C3, SUPA for places from the machine zero.

use crate::number::Form;
use crate::{Target, WriteResult, Writer};
use trueaxis_nc::moves::{Coordinates, Feed};

pub(super) const DWELL: (&[u8], Form) = (b"G4 F", Form::Plain);

pub(super) fn straight(w: &mut Writer, target: &Target, feed: Option<&Feed>) -> WriteResult {
    let machine = target.coordinates == Coordinates::Machine;
    let before: &[u8] = if machine { b"SUPA " } else { b"" };
    w.g_straight(target, feed, before, [b"A3=", b"B3=", b"C3="])
}
