//! The four reference circles of ISO 12181-1 for a profile with three lobes, and the verdict for a
//! tolerance of 10 µm. `cargo run -p trueaxis-part --example roundness`.
#![allow(clippy::print_stdout)]

use trueaxis_part::fit::circle::Fitter;
use trueaxis_part::testpiece::cone::INDICES;
use trueaxis_part::tolerance::{Acceptance, Tolerance, Tolerances};

fn main() -> Result<(), trueaxis_part::Error> {
    // Radius 100 mm with three lobes of ±4 µm: by hand, the minimum zone is 2 · 0.004 = 0.008 mm wide.
    let profile: Vec<[f64; 2]> = (0..360_u16)
        .map(|degree| f64::from(degree).to_radians())
        .map(|phi| (phi, 100.0 + 0.004 * (3.0 * phi).cos()))
        .map(|(phi, radius)| [radius * phi.cos(), radius * phi.sin()])
        .collect();
    let circles = Fitter::default().all(&profile)?;
    for (name, circle) in
        [("LSCI", circles.lsc), ("MZCI", circles.mzc), ("MICI", circles.mic), ("MCCI", circles.mcc)]
    {
        println!("{name}: radius {:.4} mm, RONt {:.4} mm", circle.radius_mm, circle.width_mm());
    }

    // 0.008 mm of 0.010 mm: 80 % of the tolerance.
    let tolerances = Tolerances(vec![Tolerance {
        index: INDICES[5],
        limit_mm: 0.010,
        source: "drawing".into(),
    }]);
    let values_mm = [circles.mzc.width_mm(); INDICES.len()];
    let verdict = tolerances.judge(&INDICES, &values_mm, Acceptance::Simple)?;
    let used = 100.0 * verdict.judgements[0].used_ratio;
    println!("{:?}, {used:.1} % of the tolerance", verdict.outcome);
    Ok(())
}
