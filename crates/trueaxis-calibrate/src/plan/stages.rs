//! What each stage of a campaign will determine with what the stages before it hand on.

use trueaxis_measure::measure::calibration::planned_calibrations;
use trueaxis_measure::measure::{Campaign, Readings};
use trueaxis_measure::unknowns::design::Design;
use trueaxis_measure::unknowns::fit::{LEAST_SINGULAR_VALUE, normal_matrix, sight_of};
use trueaxis_measure::unknowns::known::Known;

/// What to expect after a stage.
#[derive(Debug, Clone)]
pub struct StageExpectation {
    /// Its name.
    pub name: String,
    /// The standard uncertainty of each unknown; none if it is not known then. Unit: mm, rad, s or 1.
    pub u: Vec<Option<f64>>,
}

/// The unknowns of a campaign with what its stages will know without the axes of the machine.
pub fn planned_design(campaign: &Campaign) -> Design {
    let design = campaign.design();
    if campaign.stages.list.is_empty() {
        return design;
    }
    let mut known = design.known().cloned().unwrap_or_else(|| Known::nothing(design.names()));
    planned_calibrations(campaign).iter().for_each(|own| known.add(own, 1.0));
    design.with_known(Some(&known))
}

/// The stages one after the other with these stations.
pub fn expect_stages(campaign: &Campaign, stations: &Readings) -> Vec<StageExpectation> {
    let design = campaign.design();
    let priors = normal_matrix(&design, &Readings::default(), &[]);
    let mut normal = priors.clone();
    let stages = campaign.stages.list.iter().zip(planned_calibrations(campaign));
    let expected = stages.map(|(stage, own)| {
        let of = |i: usize| stage.instruments.contains(&(stations.instruments[i] as usize));
        let readings = stations.filtered(of);
        normal += own.normal;
        normal += normal_matrix(&design, &readings, &[]) - &priors;
        let sight = sight_of(&design, &normal, LEAST_SINGULAR_VALUE);
        let covariance = sight.covariance();
        let u = |k: usize| sight.is_seen[k].then(|| covariance[(k, k)].max(0.0).sqrt());
        StageExpectation { name: stage.name.clone(), u: (0..design.unknowns()).map(u).collect() }
    });
    expected.collect()
}
