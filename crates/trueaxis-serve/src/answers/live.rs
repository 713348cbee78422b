//! What a live run is doing. It is read from the journal of the run, never the other way round: nothing that is asked
//! here changes what is written into a control.

use crate::desk::{Desk, Job};
use crate::refusal::{Refusal, entries};
use crate::request::{Diagnosed, Reply, Request, ask};
use serde::{Deserialize, Serialize};
use trueaxis::JsonSchema;
use trueaxis_live::status::{LiveStatus, LiveStatusDocument};

/// The state of a live run.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct LiveRequest {
    /// The plan of the run.
    plan: String,
    /// The last hours, too. Unit: h.
    hours: Option<f64>,
}

/// The state of a live run.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct LiveAnswer<'a> {
    /// The document of `trueaxis live status`.
    document: Diagnosed<'a, LiveStatusDocument>,
    /// The date of this answer, seconds since 1970 (UTC): by it the page says how old a state is.
    now_s: u64,
}

/// More than a history can have.
const MOST_HOURS: f64 = 48.0;

impl Request for LiveRequest {
    type Answer<'a> = LiveAnswer<'a>;

    fn answer(self, desk: &Desk, job: &Job) -> Result<Reply<Self>, Refusal> {
        let hours = self.hours.filter(|hours| *hours > 0.0).map(|hours| hours.min(MOST_HOURS));
        let question = LiveStatus { plan: desk.project.path(&self.plan)?, hours };
        let (status, problems) = ask(&question, job)?;
        let document =
            Diagnosed { document: status.into_document(), diagnostics: entries(&problems) };
        Ok(Reply::json(&LiveAnswer { document, now_s: trueaxis_live::clock::date_s() }))
    }
}
