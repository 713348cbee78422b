//! Compensate, running: the correction of a machine goes into its control while it cuts.
//!
//! ```text
//!     sensors ──Watch──> temperatures ─┐
//!                                      ├─Model──> target ──Governor──> order ──Control──> offset
//!     control ──read───> pose, state ──┘                                  └──> journal, record
//! ```
//!
//! - [`focas`], [`mock`]: a FANUC control, and one that is not there; [`linuxcnc`]: LinuxCNC by its HAL;
//! - [`control`], [`sensor`], [`clock`]: what a control, a sensor and a clock are;
//! - [`governor`]: what may be written, a function of time and inputs;
//! - [`model`]: the target, from `compensate values`; [`pose`]: of tip and tool axis together.
//!
//! The only place of sockets to machines and of a clock. It computes no error: that is `trueaxis`.

pub mod clock;
pub mod commission;
pub mod control;
pub mod cycle;
pub mod datum;
pub mod expect;
pub mod file;
pub mod focas;
pub mod governor;
pub mod history;
pub mod line;
#[allow(unsafe_code, reason = "the library of LinuxCNC is C")]
pub mod linuxcnc;
pub mod memory;
pub mod metrics;
pub mod mock;
pub mod model;
pub mod opcua;
pub mod part;
pub mod parts;
pub mod pose;
pub mod run;
pub mod sensor;
pub mod setups;
pub mod start;
pub mod status;
pub mod store;

/// The JSON Schemas of the documents of this crate, by name.
#[cfg(feature = "schemas")]
pub fn schemas() -> Vec<trueaxis_report::NamedSchema> {
    use trueaxis_report::named_schema;
    let mut all = vec![
        named_schema::<expect::LiveExpectDocument>("live-expect"),
        named_schema::<parts::LivePartDocument>("live-part"),
        named_schema::<status::LiveStatusDocument>("live-status"),
    ];
    all.iter_mut().for_each(|(_, schema)| trueaxis::add_diagnostics(schema));
    all
}
pub mod session;
