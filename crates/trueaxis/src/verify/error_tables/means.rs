//! The averages of readings at their targets.

use crate::verify::iso230_2::{Direction, Target};
use trueaxis_input::{Diagnostics, Place};

/// The averages at the targets.
pub(super) struct Means {
    pub positions: Vec<f64>,
    pub up: Vec<f64>,
    pub down: Vec<f64>,
    pub both: bool,
    pub runs: usize,
    pub scatter: Option<f64>,
    pub u_arms: Vec<f64>,
}

impl Means {
    pub fn of(targets: &[Target], file: &str, problems: &mut Diagnostics) -> Option<Self> {
        let place = || Place::whole(file);
        if targets.len() < 3 {
            let message = format!("{} targets make no table", targets.len());
            problems.error("too-few-positions", place(), message, "three targets or more");
            return None;
        }
        if let Some(pair) = too_close(targets) {
            let message = format!(
                "the targets {} and {} are so close that a curve between them would be noise",
                pair[0].position, pair[1].position
            );
            let hint = "write each target as it was planned, the same in every run (mm, rad)";
            problems.error("targets-too-close", place(), message, hint);
            return None;
        }
        let has = |d: Direction| targets.iter().filter(|t| !t.of(d).is_empty()).count();
        let (up, down) = (has(Direction::Up), has(Direction::Down));
        let all = targets.len();
        if (up != all && up != 0) || (down != all && down != 0) {
            let message = "some targets were reached from one side only".to_owned();
            let hint = "a table holds both directions or one; measure or leave out those targets";
            problems.error("missing-side", place(), message, hint);
            return None;
        }
        let mean = |d: Direction| -> Vec<f64> {
            let of = |t: &Target| {
                t.of(d).iter().map(|r| r.deviation).sum::<f64>() / t.of(d).len() as f64
            };
            targets.iter().map(of).collect()
        };
        let sides: Vec<Direction> = [(Direction::Up, up), (Direction::Down, down)]
            .into_iter()
            .filter(|(_, n)| *n > 0)
            .map(|(d, _)| d)
            .collect();
        let means: Vec<Vec<f64>> = sides.iter().map(|d| mean(*d)).collect();
        let (first, last) = (means.first()?.clone(), means.last()?.clone());
        let counts = || targets.iter().flat_map(|t| sides.iter().map(|d| t.of(*d).len()));
        Some(Self {
            positions: targets.iter().map(|t| t.position).collect(),
            up: first,
            down: last,
            both: sides.len() == 2,
            runs: counts().min().unwrap_or(0),
            scatter: scatter(targets, &sides),
            u_arms: vec![0.0; targets.len()],
        })
    }

    /// Standard uncertainty of a mean by the scatter.
    pub fn u_mean(&self) -> f64 {
        self.scatter.map_or(0.0, |s| s / (self.runs.max(1) as f64).sqrt())
    }
}

/// Two targets nearer to each other than a thousandth of the widest gap.
fn too_close(targets: &[Target]) -> Option<&[Target]> {
    let gap = |pair: &[Target]| pair[1].position - pair[0].position;
    let widest = targets.windows(2).map(gap).fold(0.0, f64::max);
    targets.windows(2).find(|pair| gap(pair) < 1e-3 * widest)
}

/// The standard deviation of a reading, from all targets and both directions together.
fn scatter(targets: &[Target], sides: &[Direction]) -> Option<f64> {
    let (mut squares, mut freedom) = (0.0, 0_usize);
    for target in targets {
        for side in sides {
            let readings = target.of(*side);
            let mean = readings.iter().map(|r| r.deviation).sum::<f64>() / readings.len() as f64;
            squares += readings.iter().map(|r| (r.deviation - mean).powi(2)).sum::<f64>();
            freedom += readings.len().saturating_sub(1);
        }
    }
    (freedom > 0).then(|| (squares / freedom as f64).sqrt())
}
