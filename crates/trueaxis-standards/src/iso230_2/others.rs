//! Results by other standards from the same readings, shown for comparison with ISO 230-2.

use super::{Position, largest, range};

/// VDI/DGQ 3441 (1977, withdrawn, still asked for); docs/model.md eq. 67. mm or rad.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Vdi3441 {
    /// P, positional uncertainty (Positionsunsicherheit). Unit: mm or rad.
    pub p: Option<f64>,
    /// Pa, positional deviation (Positionsabweichung). Unit: mm or rad.
    pub pa: Option<f64>,
    /// Ps, largest positional scatter (Positionsstreubreite). Unit: mm or rad.
    pub ps: Option<f64>,
    /// U, largest reversal (Umkehrspanne). Unit: mm or rad.
    pub u: Option<f64>,
}

/// In the form of ASME B5.54: ranges of what was read, nothing assumed of its distribution. The
/// standard's text was not available: the form is not verified. mm or rad.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct B554 {
    /// Range of all readings of both directions. Unit: mm or rad.
    pub accuracy: Option<f64>,
    /// Range of all readings, rising. Unit: mm or rad.
    pub accuracy_up: Option<f64>,
    /// Range of all readings, falling. Unit: mm or rad.
    pub accuracy_down: Option<f64>,
    /// Largest range of the readings at one target from one side. Unit: mm or rad.
    pub repeatability: Option<f64>,
    /// Largest reversal. Unit: mm or rad.
    pub reversal: Option<f64>,
}

/// Both.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Others {
    /// VDI/DGQ 3441.
    pub vdi3441: Vdi3441,
    /// ASME B5.54.
    pub b554: B554,
}

impl Others {
    pub(super) fn of(positions: &[Position]) -> Self {
        Self { vdi3441: vdi3441(positions), b554: b554(positions) }
    }
}

fn vdi3441(positions: &[Position]) -> Vdi3441 {
    // Mean of both sides, scatter 6 s̄ and reversal at each target.
    let whole = positions.iter().filter_map(|p| {
        let s = 0.5 * (p.up?.s? + p.down?.s?);
        Some((p.mean()?, 6.0 * s, p.reversal()?.abs()))
    });
    let whole: Vec<(f64, f64, f64)> = whole.collect();
    let bands = whole.iter().flat_map(|(mean, scatter, reversal)| {
        let half = 0.5 * (reversal + scatter);
        [mean + half, mean - half]
    });
    Vdi3441 {
        p: range(bands),
        pa: range(positions.iter().filter_map(Position::mean)),
        ps: largest(whole.iter().map(|w| w.1)),
        u: largest(positions.iter().filter_map(|p| p.reversal().map(f64::abs))),
    }
}

fn b554(positions: &[Position]) -> B554 {
    let up = || positions.iter().filter_map(|p| p.up);
    let down = || positions.iter().filter_map(|p| p.down);
    let one_sided = up().next().is_none() || down().next().is_none();
    let all = range(up().chain(down()).flat_map(|a| a.extremes));
    let ranges = up().chain(down()).filter(|a| a.count > 1);
    B554 {
        accuracy: all.filter(|_| !one_sided),
        accuracy_up: range(up().flat_map(|a| a.extremes)),
        accuracy_down: range(down().flat_map(|a| a.extremes)),
        repeatability: largest(ranges.map(|a| a.extremes[1] - a.extremes[0])),
        reversal: largest(positions.iter().filter_map(|p| p.reversal().map(f64::abs))),
    }
}

#[cfg(test)]
mod tests {
    use crate::iso230_2::{evaluate, read};
    use trueaxis_input::Diagnostics;

    #[test]
    fn vdi_and_b554_by_hand() {
        let table = "target_mm,direction,deviation_um\n0,up,1\n0,up,3\n0,down,-1\n0,down,-1\n\
                     9,up,6\n9,up,6\n9,down,4\n9,down,4\n";
        let m = read("t.csv", table, &mut Diagnostics::new()).unwrap();
        let others = evaluate(&m, None).others;
        let um = |v: Option<f64>| v.unwrap() * 1e3;
        // Means 0.5 and 5; s̄ = √2/2 and 0; U = 3 and 2; Ps = 6 s̄ = 3√2
        let scatter = 3.0 * 2.0_f64.sqrt();
        let bottom = 0.5 - 0.5 * (3.0 + scatter);
        assert!((um(others.vdi3441.ps) - scatter).abs() < 1e-9);
        assert!((um(others.vdi3441.pa) - 4.5).abs() < 1e-9);
        assert!((um(others.vdi3441.u) - 3.0).abs() < 1e-9);
        assert!((um(others.vdi3441.p) - (6.0 - bottom)).abs() < 1e-9);
        assert!((um(others.b554.accuracy) - 7.0).abs() < 1e-9);
        assert!((um(others.b554.repeatability) - 2.0).abs() < 1e-9);
    }
}
