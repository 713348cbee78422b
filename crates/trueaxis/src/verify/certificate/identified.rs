//! Uncertainties from an identification: the campaign is evaluated again, which gives the covariance of all
//! results and not only one uncertainty for each error.

use super::UncertaintySource;
use super::inputs::Inputs;
use super::uncertainties::UncertaintyFactors;
use super::used::UsedPose;
use std::path::Path;
use trueaxis_calibrate::identify::errors::{Identification, identify};
use trueaxis_calibrate::identify::records::{read_options, read_records};
use trueaxis_input::{Diagnostics, Item, Section};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Approach;
use trueaxis_measure::measure::read_campaign;
use trueaxis_measure::unknowns::term::stated;

/// The machine file may be rounded: a difference below this part of an uncertainty is allowed.
const ROUNDING: f64 = 0.02;

/// The result of a campaign.
pub struct CampaignResult {
    /// The factors.
    pub known: UncertaintyFactors,
    /// Its description.
    pub determined: UncertaintySource,
    /// Its poses.
    pub used: Vec<UsedPose>,
}

/// Evaluates `campaign = "campaign.toml"` and compares it with the machine file.
pub fn read(
    section: &Section<'_>,
    item: &Item<'_>,
    machine: &Machine,
    (folder, inputs): (&Path, &mut Inputs),
) -> Option<CampaignResult> {
    let name = item.text()?;
    let path = folder.join(name);
    let mut problems = Diagnostics::new();
    inputs.text("campaign of the identification", name, &mut problems);
    let read =
        problems.keep(read_campaign(section.files(), &path, |root, _| Some(read_options(root))));
    let found = read.and_then(|(campaign, options)| {
        // Names of the campaign, as from the folder of the study.
        let beside = path.parent().unwrap_or(Path::new(""));
        let here = |file: &Path| {
            let file = file.strip_prefix(beside).unwrap_or(file);
            Path::new(name).with_file_name(file).display().to_string()
        };
        let machine = here(&campaign.machine_path);
        // Its problems were reported when the campaign was read.
        inputs.machine("machine file of the campaign", &machine, &mut Diagnostics::new());
        for table in campaign.tables.iter().flatten() {
            inputs.bytes("readings of the identification", &here(table), &mut problems);
        }
        let records = read_records(&campaign, &mut problems)?;
        let found = identify(&campaign, &options, &records, &mut problems)?;
        let commands = records.readings.commands.iter().enumerate();
        let used =
            commands.map(|(i, c)| UsedPose { command: *c, place: records.place(i) }).collect();
        Some((campaign, found, used))
    });
    let failed = problems.has_errors();
    section.take_over(problems);
    let (campaign, found, used): (_, Identification, Vec<UsedPose>) = found.filter(|_| !failed)?;
    if campaign.machine.chain_text() != machine.chain_text() {
        let message = "the campaign is of a machine with another chain".to_owned();
        item.error("other-machine", message, "name the campaign that this machine file came from");
        return None;
    }
    if let Some(first) = found.unobservable.first() {
        let all: Vec<&str> = found.unobservable.iter().map(|u| u.combination.as_str()).collect();
        let message = format!(
            "not observable in the campaign, so that its uncertainty is unknown: {}",
            all.join("; ")
        );
        let hint = first.resolve_with.as_ref().map_or_else(
            || "add a measurement that separates them; trueaxis plan shows it".to_owned(),
            |remedy| format!("resolved by: {remedy}"),
        );
        item.error("not-identified", message, &hint);
        return None;
    }
    if let Some(differs) = difference(machine, &found) {
        let hint = "write the machine file again: trueaxis identify CAMPAIGN.toml -o MACHINE.toml";
        item.error("other-identification", differs, hint);
        return None;
    }
    let determined = UncertaintySource::Campaign {
        name: campaign.name.clone(),
        readings: used.len(),
        terms: found.design.terms.len(),
        left_out: found.left_out.len(),
        verdict: found.verdict.words(),
    };
    Some(CampaignResult {
        known: UncertaintyFactors::identified(machine, &found),
        determined,
        used,
    })
}

/// The error of the machine file that differs from the campaign, in words.
fn difference(machine: &Machine, found: &Identification) -> Option<String> {
    let terms = &found.design.terms;
    let known = UncertaintyFactors::identified(machine, found);
    for (k, term) in terms.iter().enumerate() {
        if k > 0 && terms[k - 1].index == term.index {
            continue;
        }
        let mine = terms.iter().zip(&found.fit.values).filter(|(t, _)| t.index == term.index);
        let curve = stated(&mine.map(|(t, v)| (*t, *v)).collect::<Vec<_>>(), None);
        let body = &machine.bodies()[term.index.body];
        let own = body.stated(term.index.kind, term.index.component);
        for share in [0.0, 0.5, 1.0] {
            let mut command = [0.0; 6];
            if let Some(axis) = term.axis {
                let [low, high] = found.reach[axis];
                command[axis] = low + share * (high - low);
            }
            let q = term.axis.map_or(0.0, |axis| command[axis]);
            let [a, b] = [own, Some(&curve)].map(|e| e.map_or(Ok(0.0), |e| e.at(q, 0.0)));
            let (Ok(a), Ok(b)) = (a, b) else { continue };
            let u = known.at(machine, &command, &Approach::default()).u(term.index);
            if (a - b).abs() > ROUNDING * u.max(1e-7) {
                let (scale, unit) =
                    if term.error.component.is_rotation() { (1e6, "µrad") } else { (1e3, "µm") };
                return Some(format!(
                    "{} is {:.3} {unit} in the machine file, and the campaign finds {:.3} {unit}",
                    term.error,
                    a * scale,
                    b * scale
                ));
            }
        }
    }
    None
}
