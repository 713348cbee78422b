//! A probing path over a surface in text and on a page.

use crate::plan::program::ProgramCheck;
use crate::plan::surface::{Pose, SurfaceStudy};
use trueaxis_report::{Report, Section, Standing};

/// What a check says of a program, the worst first.
pub(super) fn issues(check: &ProgramCheck) -> Vec<String> {
    let mut lines = Vec::new();
    let lists =
        [("ERROR", &check.errors), ("critical issue", &check.critical), ("note", &check.minor)];
    for (mark, list) in lists {
        let most = if mark == "note" { 2 } else { 10 };
        lines.extend(list.iter().take(most).map(|line| format!("{mark}: {line}")));
        if list.len() > most {
            lines.push(format!("{mark}: and {} more", list.len() - most));
        }
    }
    lines
}

/// The path with what the check of its program says.
pub fn surface_report<'a>(
    study: &SurfaceStudy,
    poses: &[Pose],
    asked: usize,
    check: &ProgramCheck,
) -> Report<'a> {
    let part =
        if study.part.is_some() { "machine and part" } else { "machine (no part is stated)" };
    let report = Report::new(&study.name)
        .line(format!(
            "{} of {asked} points, {} mm apart at least, on {}",
            poses.len(),
            study.spacing_mm,
            study.machine.name()
        ))
        .line(format!(
            "probe: ball {} mm, {} mm to its centre; stands off {} mm, goes on to {:.3} mm below the surface",
            2.0 * study.ball_radius_mm,
            study.probe_length_mm,
            study.stand_off_mm,
            study.beyond_mm
        ))
        .line(format!(
            "{:.1} min; collisions of the probe with {part} were checked",
            check.duration_s / 60.0
        ));
    let report = match check.is_sound() {
        true => report.verdict(Standing::Good, "SAFE", "nothing is in its way"),
        false => report.verdict(Standing::Bad, "NOT SAFE", "not to be run"),
    };
    report.section(Section::new("Check of the program").list(issues(check)))
}
