//! The coefficient of expansion of a scale, as text and page.

use trueaxis_calibrate::identify::expansion::{Expansion, Runs};
use trueaxis_report::{Report, Section, Table};

/// A coefficient of expansion as text and page.
pub fn expansion_report(data: &Runs, found: &Expansion) -> Report<'static> {
    let (alpha, u) = (found.per_k * 1e6, found.u_per_k * 1e6);
    let material = match found.materials.is_empty() {
        true => "none of steel tape, glass, Zerodur".to_owned(),
        false => found.materials.join(" or "),
    };
    let difference = found.slope_difference_per_k * 1e6;
    let figures = [
        ("expansion", format!("{alpha:.3} ± {u:.3} µm/(m·K), standard uncertainty")),
        ("slope difference", format!("{difference:.3} µm/(m·K), coldest and warmest run")),
        ("material", material),
        ("residual", format!("{:.3} µm", found.residual_mm * 1e3)),
    ];
    let runs = data.runs.iter().zip(&found.slopes).map(|(run, slope)| {
        let numbers = [format!("{:.1}", run.celsius.value), format!("{:.3}", slope * 1e6)];
        std::iter::once(run.name.clone()).chain(numbers)
    });
    let line = format!("expansion = \"{alpha:.2} ± {u:.2} um/(m K)\"");
    Report::new(&data.name)
        .section(Section::new("").table(Table::pairs(figures)))
        .section(Section::new("Runs").table(Table::new(["run", "°C", "slope, µm/m"]).rows(runs)))
        .section(Section::new("In the machine file").code(line))
}
