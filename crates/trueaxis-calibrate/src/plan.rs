//! Plan: what a measurement will determine, before it is made.
//!
//! ```text
//!     campaign.toml ──read_plan──> Plan {campaign, paths, candidates}
//!     [Path] + Design ──expect──> Expectation: u of every unknown, what is not observable, what helps
//!     candidates + limit ──choose──> Chosen: the most informative poses in the time
//!     Path ──program──> NC text ──check──> duration, issues
//!     all of it ──planned──> PlanReport ──ready_campaign──> campaign.toml for measure and identify
//! ```

mod choose;
mod expect;
mod file;
mod planned;
pub mod program;
mod ready;
mod remedy;
mod stages;
pub mod surface;
pub mod tool_setting;
pub(crate) mod touch;
mod trial;

pub use choose::{Chosen, choose};
pub use expect::{Expectation, Expected, Seen, Unobservable, expect, seen};
pub use file::{Candidates, Limit, Plan, Want, read_plan};
pub use planned::{PlanReport, PlannedPath, chosen, extension, file_name, planned, tools};
pub use ready::{READINGS_FOLDER, READY_CAMPAIGN};
pub use remedy::remedies;
pub use stages::{StageExpectation, expect_stages, planned_design};
pub use trueaxis_geometry::exchange::{Candidate, Criterion, Exchange, Selection};
