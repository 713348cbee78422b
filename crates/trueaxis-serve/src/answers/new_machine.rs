//! A machine file by a few answers.

use crate::desk::{Desk, Job};
use crate::refusal::Refusal;
use crate::request::{Reply, Request};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use trueaxis::JsonSchema;
use trueaxis_templates::{Answers, Kind, Travel, machine_file};

/// The text of a new machine file; nothing is saved.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct NewMachineRequest {
    /// What the rotary axes carry: `three-axis`, `table-table`, `head-head`, `head-table`.
    kind: String,
    /// The name of the machine.
    name: String,
    /// Linear axes that carry the workpiece; as in the template of the kind if it is left out.
    workpiece: Option<Vec<char>>,
    /// The rotary axis that tilts, `A` or `B`.
    tilting: Option<char>,
    /// Travels by axis, from and to, mm or deg; null: all around. As in the template if an axis is left out.
    travels: Option<BTreeMap<char, Option<[f64; 2]>>>,
    /// Axes whose plus is against ISO 841.
    reversed: Option<Vec<char>>,
    /// The reference line of Z at Z = 0 above the origin of the machine frame, mm.
    height_mm: Option<f64>,
}

/// A new machine file.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct NewMachineAnswer {
    /// Its text.
    text: String,
}

impl Request for NewMachineRequest {
    type Answer<'a> = NewMachineAnswer;

    fn answer(self, _: &Desk, _: &Job) -> Result<Reply<Self>, Refusal> {
        let Some(kind) = Kind::ALL.into_iter().find(|kind| kind.name() == self.kind) else {
            let all = Kind::ALL.map(Kind::name).join(", ");
            return Err(Refusal::bad("unknown kind of machine", &all));
        };
        let usual = Answers::of(kind, &self.name);
        let travel = |(axis, ends): (char, Option<[f64; 2]>)| {
            (axis, ends.map_or(Travel::Unlimited, |[from, to]| Travel::Between(from, to)))
        };
        let answers = Answers {
            workpiece: self.workpiece.unwrap_or(usual.workpiece),
            tilting: self.tilting,
            travels: self.travels.unwrap_or_default().into_iter().map(travel).collect(),
            reversed: self.reversed.unwrap_or_default(),
            height_mm: self.height_mm,
            ..Answers::of(kind, &self.name)
        };
        let text = machine_file(&answers)
            .map_err(|wrong| Refusal::new(422, "wrong-answer", wrong.to_string(), ""))?;
        Ok(Reply::json(&NewMachineAnswer { text }))
    }
}
