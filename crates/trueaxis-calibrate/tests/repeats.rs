//! Readings that were taken again: what is a repeat of what, and what is said where two differ.

mod library;

use library::{bare, poses, probe_campaign, read};
use trueaxis_calibrate::identify::errors::identify;
use trueaxis_calibrate::identify::records::{Options, Records};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::statistics::SplitMix64;
use trueaxis_input::Diagnostics;
use trueaxis_measure::instruments::Reading;
use trueaxis_measure::measure::instrument::Instrument;
use trueaxis_measure::measure::{Campaign, Kind, Readings};

/// More than the ten repeats that a comparison of feeds needs.
const PLACES: usize = 12;

/// The codes of all that is said of these readings.
fn codes(campaign: &Campaign, readings: Readings) -> Vec<&'static str> {
    let mut problems = Diagnostics::new();
    identify(campaign, &Options::default(), &Records::bare(readings), &mut problems);
    problems.iter().map(|d| d.code).collect()
}

/// The rows, then all of them again, each changed by a function of its number.
fn again(first: &Readings, change: impl Fn(usize, Reading) -> Reading) -> Readings {
    let mut both = first.clone();
    for i in 0..first.len() {
        both.push(change(i, first.row(i)));
    }
    both
}

/// A laser along another direction reads another length at the same pose, which is no repeat; along the same one it is,
/// and 50 µm to either side are two feeds.
#[test]
fn another_direction_at_a_pose_is_no_repeat() {
    let mut campaign = probe_campaign(bare("three-axis-mill"));
    campaign.instruments = vec![Instrument::usual(Kind::LaserLine, &campaign.machine)];
    let design = campaign.design();
    let mut random = SplitMix64::new(31);
    let along_x = poses(&mut random, &campaign.machine, PLACES as u32);
    let both = again(&along_x, |_, row| Reading { direction: Vec3::y(), ..row });
    let both = read(&mut random, &design, &both, &vec![0.0; design.unknowns()]);
    let said = codes(&campaign, both.clone());
    assert!(!said.contains(&"mixed-feeds"), "{said:?}");
    let side = |i: usize| if i.is_multiple_of(2) { 0.05 } else { -0.05 };
    let moved =
        |i: usize, row: Reading| Reading { value: [row.value[0] + side(i), 0.0, 0.0], ..row };
    let said = codes(&campaign, again(&both.filtered(|i| i < PLACES), moved));
    assert!(said.contains(&"mixed-feeds"), "{said:?}");
}

/// 60 µm in an hour and a half are 42 times the noise of a difference: at one rate they are a drift, up at one place
/// and down at the next they are two feeds.
#[test]
fn what_a_steady_rate_explains_is_no_second_feed() {
    let campaign = probe_campaign(bare("lei-hsu-mill"));
    let design = campaign.design();
    let mut random = SplitMix64::new(22);
    let at = poses(&mut random, &campaign.machine, PLACES as u32);
    let twice = again(&at, |_, row| Reading { time_s: row.time_s + 5400.0, ..row });
    let readings = read(&mut random, &design, &twice, &vec![0.0; design.unknowns()]);
    let with = |change: &dyn Fn(usize) -> f64| {
        let mut changed = readings.clone();
        for (i, value) in changed.values.iter_mut().enumerate() {
            value[2] += change(i);
        }
        codes(&campaign, changed)
    };
    let drifts = with(&|i| 0.06 * readings.times_s[i] / 5400.0);
    assert!(!drifts.contains(&"mixed-feeds"), "{drifts:?}");
    let jumps = with(&|i| if i < PLACES { 0.0 } else { [0.06, -0.06][i % 2] });
    assert!(jumps.contains(&"mixed-feeds"), "{jumps:?}");
}

/// Places that were read once cannot fail to close, however far apart they lie; one that reads 20 µm more two hours
/// later does.
#[test]
fn only_the_same_place_can_fail_to_close() {
    let campaign = probe_campaign(bare("lei-hsu-mill"));
    let design = campaign.design();
    let mut random = SplitMix64::new(41);
    let at = poses(&mut random, &campaign.machine, 20);
    let mut readings = read(&mut random, &design, &at, &vec![0.0; design.unknowns()]);
    let said = codes(&campaign, readings.clone());
    assert!(!said.contains(&"closure"), "{said:?}");
    let first = readings.row(0);
    let [x, y, z] = first.value;
    readings.push(Reading { value: [x + 0.02, y, z], time_s: 7200.0, ..first });
    let said = codes(&campaign, readings);
    assert!(said.contains(&"closure"), "{said:?}");
}
