//! Why a move could not be made.

use super::Node;
use crate::densify::MOST_PIECES;
use crate::timing::TimingError;
use trueaxis_input::plausible::Quantity;
use trueaxis_machine::SolveError;
use trueaxis_nc::moves::{Move, Origin};

/// Why a move could not be made.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    /// The block.
    pub origin: Origin,
    /// The word of the block that it concerns, to find the column.
    pub word: Option<u8>,
    /// Short name.
    pub code: &'static str,
    /// The message.
    pub message: String,
    /// The hint.
    pub hint: &'static str,
}

impl Fault {
    /// A place of the path that no time can be given to.
    pub fn untimed(node: &Node, error: &TimingError) -> Self {
        Self {
            origin: node.origin,
            word: None,
            code: "untimed",
            message: error.to_string(),
            hint: "check feed and coordinates of the block",
        }
    }
}

impl Fault {
    /// A place of the path after the end of the log of temperatures.
    pub fn untempered(node: &Node, message: String) -> Self {
        Self {
            origin: node.origin,
            word: None,
            code: "log-ends",
            message,
            hint: "use a longer log or an earlier start, or hold one time of it (--log-time)",
        }
    }
}

pub(super) fn fault(
    m: &Move,
    word: Option<u8>,
    code: &'static str,
    message: String,
    hint: &'static str,
) -> Fault {
    Fault { origin: m.origin, word, code, message, hint }
}

pub(super) fn unreachable(m: &Move, error: &SolveError) -> Fault {
    let hint = "tilt the part or the tool, or use a machine whose rotary axes reach it";
    fault(m, None, "unreachable-orientation", error.to_string(), hint)
}

/// A move goes from one end of what is possible to the other at most: pieces of a way that no machine has are of no
/// use, and every one takes its time.
pub(super) fn no_farther_than_a_hall(m: &Move, span_mm: f64) -> Result<(), Fault> {
    let range = Quantity::Length.range();
    let farthest_mm = range.possible.1 - range.possible.0;
    if span_mm <= farthest_mm {
        return Ok(());
    }
    let message = format!(
        "the move spans {span_mm:.0} mm, and {farthest_mm} mm are the most that is possible: {}",
        range.reason
    );
    let hint = "check unit, decimal point, offsets and scale of the block";
    Err(fault(m, None, "impossible-value", message, hint))
}

/// No move needs so many pieces.
pub(super) fn too_many_pieces(m: &Move) -> Fault {
    let message = format!("the move would be cut into more than {MOST_PIECES} pieces");
    let hint = "is a unit or a turn wrong? or allow larger pieces: --spacing, --angle, --chord";
    fault(m, None, "too-many-pieces", message, hint)
}

pub(super) fn not_finite(m: &Move) -> Fault {
    let message = "the target of the move is not finite".to_owned();
    fault(m, None, "not-finite", message, "check offsets, scale and coordinates")
}
