//! The expanded uncertainty of the parameters from the instrument's data: docs/model.md eq. 65, 66.
//!
//! Contributions and k = 2 as in ISO/TR 230-9 and ISO 230-2:2014 annex A; how they reach a parameter is
//! the law of propagation over its definition (GUM 5.1.2). With five runs it gives
//! U(R↑) = 2·U(EVE), as printed there; the other factors were not compared with the print.

use super::{Position, Quantity};
use crate::conditions::{Conditions, Extent};
use trueaxis_geometry::AxisKind;
use trueaxis_input::{Diagnostics, Place};

/// Coverage factor.
pub const COVERAGE: f64 = 2.0;
/// The temperature to which lengths refer (ISO 1), °C.
const REFERENCE_C: f64 = 20.0;

/// One contribution that grows with the measured length.
#[derive(Debug, Clone, PartialEq)]
pub struct Share {
    /// Its source.
    pub name: &'static str,
    /// Its standard uncertainty over the whole measured length. Unit: mm or rad.
    pub u: f64,
}

/// The uncertainty of a measurement.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Budget {
    /// From the first to the last target. Unit: mm or rad.
    pub length: f64,
    /// Contributions common to all runs.
    pub shares: Vec<Share>,
    /// Standard uncertainty of one reading from the drift (environmental variation). Unit: mm or rad.
    pub drift_u: Option<f64>,
}

/// Standard uncertainty of something that lies anywhere within a range.
fn rectangular(range: f64) -> f64 {
    range / 12.0_f64.sqrt()
}

impl Budget {
    /// The contributions of an instrument over a measured length (mm or rad).
    pub fn new(
        conditions: &Conditions,
        kind: AxisKind,
        length: f64,
        place: &Place,
        problems: &mut Diagnostics,
    ) -> Option<Self> {
        let instrument = conditions.instrument?;
        let mut budget = Self { length, ..Self::default() };
        let mut absolute = |extent: Extent, key: &str| match (kind, extent) {
            (AxisKind::Linear, Extent::Length(v)) | (AxisKind::Rotary, Extent::Angle(v)) => Some(v),
            // µm/m
            (AxisKind::Linear, Extent::Angle(ratio)) if key == "device_expanded" => {
                Some(ratio * length)
            }
            _ => {
                let message = format!("`{key}` has the unit of another kind of axis");
                let hint = "a length for a linear axis, an angle for a rotary one";
                problems.error("wrong-unit", place.clone(), message, hint);
                None
            }
        };
        if let Some(u) = instrument.device_expanded.and_then(|e| absolute(e, "device_expanded")) {
            budget.shares.push(Share { name: "device", u: u / COVERAGE });
        }
        budget.drift_u =
            instrument.eve_range.and_then(|e| absolute(e, "eve_range")).map(rectangular);
        if kind == AxisKind::Linear {
            budget.add_linear(conditions, problems, place);
        }
        if budget.drift_u.is_none() {
            let message = "no `eve_range`: the drift during the test is not known".to_owned();
            let hint = "observe the machine at rest for the duration of a test; without it U(R), U(B) \
                        and U(B̄) stay open, and the other U are too small";
            problems.warn("missing-drift", place.clone(), message, hint);
        }
        Some(budget)
    }

    fn add_linear(&mut self, conditions: &Conditions, problems: &mut Diagnostics, place: &Place) {
        let Some(instrument) = conditions.instrument else { return };
        if let Some(range) = instrument.misalignment_range_mm
            && self.length > 0.0
        {
            // L − √(L² − R²) ≈ R²/(2L), anywhere between 0 and that.
            let u = rectangular(range * range / (2.0 * self.length));
            self.shares.push(Share { name: "misalignment", u });
        }
        let (alpha, t) = match (instrument.expansion_per_k, conditions.temperature_c) {
            (Some(alpha), Some(t)) => (alpha, t),
            (None, None) => return,
            (alpha, _) => {
                let (code, message, hint) = match alpha {
                    Some(_) => (
                        "missing-temperature",
                        "a coefficient of expansion without a `temperature`",
                        "write temperature = \"22.3 ± 0.2 degC\"; its share is left out",
                    ),
                    None => (
                        "missing-uncertainty",
                        "a `temperature` without a coefficient of expansion: its share of U is left out",
                        "write [uncertainty] expansion = \"11.5 ± 1 um/(m·K)\", that of the scale; U is too small without it",
                    ),
                };
                problems.warn(code, place.clone(), message.to_owned(), hint);
                return;
            }
        };
        if t.u.is_none() {
            let message =
                "the temperature has no uncertainty: its share of U is left out".to_owned();
            let hint = "write temperature = \"22.3 ± 0.2 degC\"; without it the temperature counts as exact, and U is too small";
            problems.warn("missing-uncertainty", place.clone(), message, hint);
        }
        if let Some(u) = t.u {
            let u = self.length * alpha.value.abs() * u;
            self.shares.push(Share { name: "temperature measurement", u });
        }
        if let Some(u) = alpha.u {
            let u = self.length * (t.value - REFERENCE_C).abs() * u;
            self.shares.push(Share { name: "expansion coefficient", u });
        }
    }

    /// Standard uncertainty of a distance within the measured length, without the drift.
    pub fn scale_u(&self, distance: f64) -> f64 {
        let whole = self.shares.iter().map(|s| s.u * s.u).sum::<f64>().sqrt();
        if self.length > 0.0 { whole * (distance / self.length).abs() } else { 0.0 }
    }

    /// U (k = 2) of every available parameter, in the order of [`Quantity::ALL`].
    pub(super) fn expanded(
        &self,
        positions: &[Position],
        values: &[Option<f64>; 12],
    ) -> [Option<f64>; 12] {
        let scale = self.scale_u(self.length);
        let counts = positions.iter().flat_map(|p| [p.up, p.down]).flatten().map(|a| a.count);
        let n = counts.min().unwrap_or(1) as f64;
        let both = positions.iter().filter(|p| p.reversal().is_some()).count() as f64;
        let [r, r_up, r_down] =
            [Quantity::R, Quantity::RUp, Quantity::RDown].map(|q| values[q as usize]);
        // Which of the three rules of eq. 62 made R.
        let side = [r_up, r_down].into_iter().flatten().fold(0.0, f64::max);
        let of_one_side = r.is_some_and(|r| r <= side);
        Quantity::ALL.map(|quantity| {
            values[quantity as usize]?;
            // Parts of the variance of one reading's drift; docs/model.md eq. 66.
            let (with_scale, drift) = match quantity {
                Quantity::A | Quantity::AUp | Quantity::ADown => (true, 2.0 / n + 8.0 / (n - 1.0)),
                Quantity::E | Quantity::EUp | Quantity::EDown => (true, 2.0 / n),
                Quantity::M => (true, 1.0 / n),
                Quantity::RUp | Quantity::RDown => (false, 16.0 / (n - 1.0)),
                Quantity::R if of_one_side => (false, 16.0 / (n - 1.0)),
                Quantity::R => (false, 8.0 / (n - 1.0) + 2.0 / n),
                Quantity::B => (false, 2.0 / n),
                Quantity::BMean => (false, 2.0 / (n * both)),
            };
            let drift_u = match (self.drift_u, with_scale) {
                (Some(u), _) => u,
                (None, true) => 0.0,
                (None, false) => return None,
            };
            let scale = if with_scale { scale } else { 0.0 };
            let u = (scale * scale + drift * drift_u * drift_u).sqrt();
            Some(COVERAGE * u).filter(|u| u.is_finite())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::iso230_2::{evaluate, read};

    #[test]
    fn contributions_by_hand() {
        let text = "temperature = '22 ± 0.5 degC'\n[uncertainty]\ndevice_expanded = '1 um/m'\n\
                    misalignment_range = '1 mm'\nexpansion = '12 ± 1 um/(m·K)'\n\
                    eve_range = '1.2 um'";
        let (conditions, mut problems) = Conditions::read("x.toml", text);
        let place = Place::whole("x.toml");
        let budget =
            Budget::new(&conditions, AxisKind::Linear, 1000.0, &place, &mut problems).unwrap();
        assert!(!problems.has_errors());
        // Over 1 m: 1/2 µm; (1/2000 mm = 0.5 µm)/√12; 12 · 0.5 = 6 µm; 2 K · 1 = 2 µm
        let expected = [0.5, 0.5 / 12.0_f64.sqrt(), 6.0, 2.0];
        for (share, um) in budget.shares.iter().zip(expected) {
            assert!((share.u * 1e3 - um).abs() < 1e-9, "{share:?}");
        }
        assert!((budget.drift_u.unwrap() * 1e3 - 1.2 / 12.0_f64.sqrt()).abs() < 1e-9);
        assert!((budget.scale_u(500.0) - 0.5 * budget.scale_u(1000.0)).abs() < 1e-15);
    }

    #[test]
    fn five_runs_give_twice_the_drift_for_the_repeatability() {
        let rows: String = (0..2)
            .flat_map(|i| (1..=5).map(move |run| format!("{},{run},up,{}\n", 100 * i, run % 2)))
            .collect();
        let table = format!("target_mm,run,direction,deviation_um\n{rows}");
        let measured = read("t.csv", &table, &mut Diagnostics::new()).unwrap();
        let budget = Budget { length: 100.0, shares: Vec::new(), drift_u: Some(0.001) };
        let result = evaluate(&measured, Some(budget));
        let u = |q| result.expanded_of(q).map(|v| v * 1e3);
        assert!((u(Quantity::RUp).unwrap() - 4.0).abs() < 1e-12); // U(EVE) = 2 µm
        assert!((u(Quantity::EUp).unwrap() - 2.0 * (0.4_f64).sqrt()).abs() < 1e-12);
        assert_eq!(u(Quantity::R), None); // R itself is not defined for one direction
    }

    /// Both directions, five runs, 1 µm of drift in a reading, 3 µm of the scale; each by hand.
    #[test]
    fn every_parameter_has_its_own_share_of_drift_and_scale() {
        // Reversal 5 µm, scatter ±1 µm: R is that of both directions, wider than either.
        let reading = |run: i32, up: bool| f64::from(run % 2) + if up { 5.0 } else { 0.0 };
        let mut table = "target_mm,run,direction,deviation_um\n".to_owned();
        for target in [0, 50, 100] {
            for (run, up) in (1..=5).flat_map(|run| [(run, true), (run, false)]) {
                let side = if up { "up" } else { "down" };
                table += &format!("{target},{run},{side},{}\n", reading(run, up));
            }
        }
        let measured = read("t.csv", &table, &mut Diagnostics::new()).unwrap();
        let shares = vec![Share { name: "device", u: 0.003 }];
        let budget = Budget { length: 100.0, shares, drift_u: Some(0.001) };
        let result = evaluate(&measured, Some(budget));
        let two_sided = 2.0_f64 * (8.0_f64 / 4.0 + 2.0 / 5.0).sqrt();
        for (quantity, um) in [
            (Quantity::A, 2.0 * (9.0_f64 + 2.0 / 5.0 + 8.0 / 4.0).sqrt()),
            (Quantity::ADown, 2.0 * (9.0_f64 + 2.0 / 5.0 + 8.0 / 4.0).sqrt()),
            (Quantity::E, 2.0 * (9.0_f64 + 2.0 / 5.0).sqrt()),
            (Quantity::M, 2.0 * (9.0_f64 + 1.0 / 5.0).sqrt()),
            (Quantity::RUp, 2.0 * (16.0_f64 / 4.0).sqrt()),
            (Quantity::R, two_sided),
            (Quantity::B, 2.0 * (2.0_f64 / 5.0).sqrt()),
            (Quantity::BMean, 2.0 * (2.0_f64 / (5.0 * 3.0)).sqrt()),
        ] {
            let u_um = result.expanded_of(quantity).expect("known") * 1e3;
            assert!((u_um - um).abs() < 1e-9, "{quantity:?}: {u_um} µm, by hand {um}");
        }
    }
}
