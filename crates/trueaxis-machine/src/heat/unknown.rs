//! A workpiece that grows with temperature, of which no temperature is known.

use super::{Conditions, Scale};
use crate::axis::{AxisKind, Travel};
use crate::chain::Machine;

/// What an unknown temperature of the workpiece can cost: a bound on what the part may be off by.
///
/// ```text
///     ΔE_w = α_w · L · 1 K per K of the workpiece                          docs/model.md eq. 86
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct UnknownGrowth {
    /// The linear axis with the longest travel, in [`Machine::axes`]; none where no travel is stated.
    pub axis: Option<usize>,
    /// That travel, or 1000 mm where none is stated, mm.
    pub over_mm: f64,
    /// How far the material at its end goes when the workpiece is warmer by 1 K. Unit: mm.
    pub per_k_mm: f64,
    /// The temperature of the scales: their readings, or where there are none that of their error tables, °C.
    pub scales_celsius: Option<f64>,
}

impl Machine {
    /// The cost of what is not known, where the machine file says how the workpiece grows and no
    /// temperature of it is given: compensating then cancels a growth that the workpiece shares.
    ///
    /// # Source
    /// Zhang et al. 2019, section 3.2.1.
    pub fn unknown_growth(&self, conditions: &Conditions) -> Option<UnknownGrowth> {
        let workpiece = self.heat.workpiece.as_ref().filter(|_| self.growth.is_none())?;
        let travels = self.axes.iter().enumerate().filter_map(|(i, axis)| match axis.travel {
            Travel::Between(from, to) if axis.kind == AxisKind::Linear => Some((i, to - from)),
            _ => None,
        });
        let longest = travels.max_by(|a, b| a.1.total_cmp(&b.1));
        let over_mm = longest.map_or(1000.0, |(_, travel_mm)| travel_mm);
        let scales = &self.heat.scales;
        let mut celsius: Vec<f64> = scales
            .iter()
            .flat_map(Scale::sensors)
            .filter_map(|sensor| conditions.celsius(sensor))
            .collect();
        if celsius.is_empty() {
            celsius.extend(scales.iter().map(|scale| scale.anchor.table_celsius));
        }
        let count = celsius.len() as f64;
        Some(UnknownGrowth {
            axis: longest.map(|(axis, _)| axis),
            over_mm,
            per_k_mm: workpiece.expansion_per_k.value * over_mm,
            scales_celsius: (count > 0.0).then(|| celsius.iter().sum::<f64>() / count),
        })
    }

    /// The conditions with every sensor of the workpiece at one temperature.
    pub fn with_workpiece_at(&self, conditions: &Conditions, celsius: f64) -> Conditions {
        let sensors = self.heat.workpiece.iter().flat_map(|w| &w.sensors);
        sensors.fold(conditions.clone(), |all, sensor| all.with_reading(&sensor.name, celsius))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::NoTables;
    use trueaxis_input::Diagnostics;

    const TEXT: &str = r#"
        machine = { name = "m", chain = "w b X Y Z t" }
        [axis.X]
        travel = ["-500 mm", "3000 mm"]
        [axis.Y]
        travel = ["0 mm", "2300 mm"]
        [scale.X]
        expansion = "10.8 um/(m K)"
        table_temperature = "28.4 degC"
        sensors = { scale_x = "0 mm" }
        [workpiece]
        expansion = "13.2 um/(m K)"
        sensors = { left = "0 mm", right = "3000 mm" }
    "#;

    /// 13.2 µm/(m·K) over 3.5 m: 46.2 µm per K, 485.1 µm at 30.5 °C.
    #[test]
    fn the_cost_by_hand() {
        let machine = Machine::check("m.toml", TEXT, &NoTables).0.unwrap();
        let mut problems = Diagnostics::new();
        let mut conditions = |text| Conditions::typed("t", text, &mut problems).unwrap();
        let (none, scale) = (conditions(""), conditions("scale_x=30.5"));
        let found = machine.unknown_growth(&scale).unwrap();
        assert_eq!(
            (found.axis, found.over_mm, found.scales_celsius),
            (Some(0), 3500.0, Some(30.5))
        );
        assert!((found.per_k_mm - 0.0462).abs() < 1e-12);
        // Without readings the scales are at the temperature of their tables.
        assert_eq!(machine.unknown_growth(&none).unwrap().scales_celsius, Some(28.4));
        // Known, it costs nothing.
        let known = machine.with_workpiece_at(&scale, 30.5);
        assert_eq!((known.celsius("left"), known.celsius("right")), (Some(30.5), Some(30.5)));
        let warm = machine.at(&known, &mut problems).unwrap();
        assert_eq!(warm.unknown_growth(&known), None);
        // A machine file without a growing workpiece has nothing to ask for.
        let text = TEXT.split("[workpiece]").next().unwrap();
        let machine = Machine::check("m.toml", text, &NoTables).0.unwrap();
        assert_eq!(machine.unknown_growth(&none), None);
    }
}
