//! SINUMERIK 840D: vectors as A3 B3 C3, SUPA D0 for places from the machine zero.

use crate::number::Form;
use crate::{Target, WriteResult, Writer};
use trueaxis_nc::moves::{Coordinates, Feed};

pub(super) const DWELL: (&[u8], Form) = (b"G4 F", Form::Plain);

pub(super) fn straight(w: &mut Writer, target: &Target, feed: Option<&Feed>) -> WriteResult {
    let machine = target.coordinates == Coordinates::Machine;
    // SUPA leaves the tool length as it is: a place of the axes needs D0, until the tip counts again.
    let before: &[u8] = if machine { b"SUPA D0 " } else { b"" };
    w.without_length |= machine && !w.machine_coordinates;
    w.g_straight(target, feed, before, [b"A3=", b"B3=", b"C3="])
}
