//! The zero of the part, and what was missing of the correction when it was touched.
//!
//! ```text
//!     touched:    m₀ = target(q₀, T₀) − what acted then
//!     afterwards: target′(q, T) = target(q, T) − m₀
//! ```
//!
//! What was off at the touch is in the zero of the part already: it is subtracted, or it would be corrected twice. A zero that was
//! touched with the whole correction acting needs nothing (m₀ = 0). At the moment of the touch target′ is what acts, so that
//! nothing jumps. With tip and tool axis together m₀ is a vector in the workpiece and turns with it; a touch says nothing of the
//! tool axis. docs/model.md eq. 241, 242.

use crate::governor::Reason;
use crate::model::Model;
use crate::pose::Frame;
use crate::setups::SetupDatum;
use serde::{Deserialize, Serialize};
use trueaxis::machine::axis::Command;

/// What was missing at the touch.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Datum {
    /// Of each live axis, in its direction; of tip and tool axis together X, Y and Z of the tip in the workpiece in the
    /// places of those axes, nothing in others. Unit: mm or rad.
    pub missing: Vec<f64>,
}

/// What is asked of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DatumOrder {
    /// The zero is being touched now.
    Take,
    /// It was touched earlier.
    Set(Datum),
    /// Those that an earlier run has left, of all setups.
    Kept(Vec<SetupDatum>),
    /// What was touched in a run counts no more: that of the plan, or none.
    Clear,
}

/// What has become of it: a datum, none, or why not.
pub type DatumOutcome = Result<Option<Datum>, String>;

/// What the axes are doing when the zero is touched.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch<'a> {
    /// What the offsets are added to.
    pub frame: Frame,
    /// The position of the program.
    pub at: &'a Command,
    /// The correction that acts. Unit: counts.
    pub own: &'a [i32],
}

/// Of a touch: what the whole correction would be there, less what acts.
///
/// # Errors
/// [`Reason::Model`].
pub fn touched(model: &mut Model, touch: &Touch<'_>) -> Result<Datum, Reason> {
    model.set_datum(None);
    let whole = model.target(touch.frame, touch.at)?;
    let own = model.at_position(touch.own.iter().map(|n| f64::from(*n)), touch.at);
    let missing: Vec<f64> = whole.here.iter().zip(own).map(|(t, own)| t - own).collect();
    Ok(model.datum_of(touch.frame, touch.at, &missing))
}
