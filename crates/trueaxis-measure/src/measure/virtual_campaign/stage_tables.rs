//! The tables of stages that measure without the axes of the machine: a probe's zero, points on a ball.

use super::{Chance, VirtualCampaign, chance, normal};
use crate::instruments::instrument::SetupError;
use crate::measure::Campaign;
use crate::measure::stages::{BallStage, ZeroStage};
use std::fmt::Write as _;
use std::path::PathBuf;
use trueaxis_geometry::Vec3;

/// A ball whose campaign states no diameter, mm.
const USUAL_DIAMETER_MM: f64 = 25.0;

/// The table of each such stage: its path in the campaign, and what would stand in it.
pub fn stage_tables(campaign: &Campaign, real: &VirtualCampaign) -> Vec<(PathBuf, String)> {
    let mut random = chance(real.truth.seed, Chance::Stages);
    let mut next = || normal(&mut random);
    let mut tables = Vec::new();
    for stage in &campaign.stages.list {
        if let Some(zero) = &stage.zero {
            tables.push((zero.table.clone(), zero_table(campaign, real, zero, &mut next)));
        }
        if let Some(ball) = &stage.ball {
            tables.push((ball.table.clone(), ball_table(campaign, real, ball, &mut next)));
        }
    }
    tables
}

/// The true value of an unknown of a set-up; 0 unless the truth states it.
fn truth(real: &VirtualCampaign, instrument: usize, error: SetupError) -> f64 {
    let (own, values) = (&real.truth.instruments[instrument], &real.truth.setups[instrument]);
    let of = own.unknowns.iter().zip(values).filter(|(u, _)| u.error == error);
    of.map(|(_, value)| value).sum()
}

fn zero_table(
    campaign: &Campaign,
    real: &VirtualCampaign,
    stage: &ZeroStage,
    normal: &mut impl FnMut() -> f64,
) -> String {
    let instrument = &campaign.instruments[stage.instrument];
    let channels = instrument.kind.channels();
    let (scale, unit) = if instrument.sight.is_angle() { (1e6, "urad") } else { (1e3, "um") };
    let noise = real.disturb.noise;
    // The joint is off the line of the taper by the same in all readings.
    let at: Vec<f64> = (0..channels.len())
        .map(|c| truth(real, stage.instrument, SetupError::Zero(c)) + noise * stage.u * normal())
        .collect();
    let heads: Vec<String> = channels.iter().map(|c| format!("{c}_{unit}")).collect();
    let mut text = heads.join(",") + "\n";
    for _ in 0..stage.count {
        let one = |(c, at): (usize, &f64)| (at + noise * instrument.noise[c] * normal()) * scale;
        let row: Vec<String> = at.iter().enumerate().map(one).map(|v| format!("{v:.4}")).collect();
        text += &(row.join(",") + "\n");
    }
    text
}

fn ball_table(
    campaign: &Campaign,
    real: &VirtualCampaign,
    stage: &BallStage,
    normal: &mut impl FnMut() -> f64,
) -> String {
    let noise = real.disturb.noise;
    let off = [0, 1, 2].map(|i| truth(real, stage.instrument, SetupError::ReferencePoint(i)));
    let seat = [0; 3].map(|_| noise * stage.seat_u_mm * normal());
    let centre = campaign.instruments[stage.instrument].reference_point_mm
        + Vec3::from(off)
        + Vec3::from(seat);
    let diameter = stage.diameter_mm.map_or(USUAL_DIAMETER_MM, |(d, u)| d + noise * u * normal());
    let mut text = "x_mm,y_mm,z_mm\n".to_owned();
    for n in stage.directions() {
        // A machine reads off the surface along its normal; across it the point slides.
        let p = centre + n * (0.5 * diameter + noise * stage.u_mm * normal());
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{:.6},{:.6},{:.6}", p.x, p.y, p.z);
    }
    text
}
