//! Blocks that cannot be corrected where they stand, and what to do.

use trueaxis_motion::axis_path::Fault;
use trueaxis_nc::moves::Origin;

pub(super) fn cone(origin: Origin) -> Fault {
    let message = "the tool axis turns on a cone, which corrected ends do not lie on".to_owned();
    let hint = "let the postprocessor write directions close to each other (ORIVECT) instead";
    refusal(origin, "on-cone", message, hint)
}

pub(super) fn again(origin: Origin) -> Fault {
    let message = "the block is executed again at other places, as in a loop: its words cannot be \
                   right for all of them"
        .to_owned();
    let hint = "write its rounds one after the other";
    refusal(origin, "executed-again", message, hint)
}

pub(super) fn refusal(
    origin: Origin,
    code: &'static str,
    message: String,
    hint: &'static str,
) -> Fault {
    Fault { origin, word: None, code, message, hint }
}
