//! LinuxCNC: G53 with and without feed, no vectors.

use crate::number::Form;
use crate::{Target, WriteError, WriteResult, Writer};
use trueaxis_nc::moves::{Coordinates, Feed};

pub(super) const DWELL: (&[u8], Form) = (b"G4 P", Form::Plain);

pub(super) fn straight(w: &mut Writer, target: &Target, feed: Option<&Feed>) -> WriteResult {
    if target.direction.is_some() {
        let what = "the tool axis as a vector";
        let instead = "write the rotary axes";
        return Err(WriteError::NotInDialect { control: "LinuxCNC", what, instead });
    }
    let machine = target.coordinates == Coordinates::Machine;
    w.g_straight(target, feed, if machine { b"G53 " } else { b"" }, [b"", b"", b""])
}
