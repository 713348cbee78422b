//! Whether points are those of a part that lay on the measuring machine turned about its axis, or mirrored.
//!
//! The piece itself does not show it: it is one of revolution. Its predicted form does.

use super::PartSections;
use std::f64::consts::{FRAC_PI_2, TAU};
use trueaxis_part::testpiece::PartSection;

/// A turned part agrees at least so much better; otherwise nothing is said.
const BETTER: f64 = 0.4;

/// Says so if the measured sections agree with the predicted ones much better after a quarter, half or three-quarter
/// turn, or with x and y swapped.
pub(super) fn remark(part: &PartSections, predicted: &[PartSection]) -> Option<String> {
    let as_is = difference_mm(part, predicted, &|a| a)?;
    let turned = (1..4).map(|k| (f64::from(k), false));
    let mirrored = (0..4).map(|k| (f64::from(k), true));
    let (best, quarters, mirror) = turned
        .chain(mirrored)
        .filter_map(|(k, mirror)| {
            let sign = if mirror { -1.0 } else { 1.0 };
            let found = difference_mm(part, predicted, &|a| sign * a + k * FRAC_PI_2)?;
            Some((found, k, mirror))
        })
        .min_by(|a, b| a.0.total_cmp(&b.0))?;
    (best < BETTER * as_is).then(|| {
        let how = match (mirror, quarters) {
            (true, 1.0) => "with x and y swapped".to_owned(),
            (true, 0.0) => "with the sign of y changed".to_owned(),
            (true, 2.0) => "with the sign of x changed".to_owned(),
            (true, _) => "mirrored about the line x = −y".to_owned(),
            (false, k) => format!("turned by {:.0}° about z", 90.0 * k),
        };
        format!(
            "{}: the sections differ from the prediction by {:.1} µm (root mean square), {how} by {:.1} µm: are x and \
             y of the measurement those of the workpiece?",
            part.name,
            as_is * 1e3,
            best * 1e3
        )
    })
}

/// Root mean square of measured less predicted E, mm, with measured azimuths changed.
fn difference_mm(
    part: &PartSections,
    predicted: &[PartSection],
    change: &dyn Fn(f64) -> f64,
) -> Option<f64> {
    let (mut sum, mut count) = (0.0, 0.0);
    for section in &part.sections {
        let Some(expected) = predicted.iter().find(|p| p.height_mm == section.height_mm) else {
            continue;
        };
        for (azimuth, e) in section.azimuth_rad.iter().zip(&section.deviation_mm) {
            sum += (e - at(expected, change(*azimuth))?).powi(2);
            count += 1.0;
        }
    }
    (count > 0.0).then(|| (sum / count).sqrt())
}

/// E of a section whose azimuths are evenly spaced from 0, linear between them.
fn at(section: &PartSection, azimuth: f64) -> Option<f64> {
    let n = section.deviation_mm.len();
    let place = azimuth.rem_euclid(TAU) / TAU * n as f64;
    // why: from 0 to n, and n is the first again.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to n")]
    let before = place.floor() as usize;
    let [a, b] = [before, before + 1].map(|i| section.deviation_mm.get(i % n.max(1)));
    Some(a? + (b? - a?) * (place - place.floor()))
}
