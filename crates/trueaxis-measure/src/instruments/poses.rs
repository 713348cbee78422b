//! Stations as a table that a person or a program follows.

use super::Readings;
use std::fmt::Write as _;
use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::AxisKind;

impl Readings {
    /// The stations as a table, as a path of kind `table` reads it: axes (mm, deg), with `sided` the side from which each
    /// comes, the direction where it is not the usual one of the instrument, group and time.
    pub fn poses(&self, machine: &Machine, usual: Vec3, sided: bool) -> String {
        let axes = machine.axes();
        let directed = self.directions.iter().any(|n| *n != usual);
        let mut heads: Vec<String> = axes.iter().map(|a| a.name.to_string()).collect();
        if sided {
            heads.extend(axes.iter().map(|a| format!("{}_approach", a.name)));
        }
        if directed {
            heads.extend(["n_x", "n_y", "n_z"].map(str::to_owned));
        }
        heads.extend(["group", "time_s"].map(str::to_owned));
        let mut text = heads.join(",") + "\n";
        for row in (0..self.len()).map(|i| self.row(i)) {
            let shown = axes.iter().zip(row.command).map(|(axis, q)| match axis.kind {
                AxisKind::Rotary => q.to_degrees(),
                AxisKind::Linear => q,
            });
            let mut numbers: Vec<f64> = shown.collect();
            if sided {
                numbers.extend(row.approach.iter().take(axes.len()));
            }
            if directed {
                numbers.extend(row.direction.iter());
            }
            for number in numbers {
                // Writing to a String cannot fail.
                let _ = write!(text, "{number},");
            }
            let _ = writeln!(text, "{},{:.1}", row.group, row.time_s);
        }
        text
    }
}
