//! Our side of oracles.toml: the README's first study against oracles/nas979.py.

use crate::Ours;
use crate::shop::PREDICTION;

pub const CLAIMS: &[(&str, Ours)] = &[
    ("oracle-nas979-roundness-eq18", || value_and_u("roundness_eq18_mm")),
    ("oracle-nas979-angularity-eq19", || value_and_u("angularity_eq19_mm")),
    ("oracle-nas979-coaxiality-eq20", || value_and_u("coaxiality_eq20_mm")),
    ("oracle-nas979-coaxiality-diameter", || value_and_u("coaxiality_diameter_mm")),
    ("oracle-nas979-roundness-lsc", || value_and_u("roundness_lsc_mm")),
    ("oracle-nas979-roundness-mzc", || value_and_u("roundness_mzc_mm")),
    ("oracle-nas979-roundness-mic", || value_and_u("roundness_mic_mm")),
    ("oracle-nas979-roundness-mcc", || value_and_u("roundness_mcc_mm")),
    ("oracle-nas979-coaxiality-lsc", || value_and_u("coaxiality_lsc_mm")),
    ("oracle-nas979-angularity-zone", || value_and_u("angularity_zone_mm")),
    ("oracle-nas979-volumetric", || value_and_u("volumetric_max_mm")),
];

fn value_and_u(key: &str) -> Vec<f64> {
    let index = PREDICTION.indices.iter().find(|i| i.name.key == key).expect("an index");
    vec![index.value_mm, index.u_mm]
}
