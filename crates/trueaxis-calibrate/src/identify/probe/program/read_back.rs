//! A program of a probe, read back: does it go where it should?

use super::{ProbeFile, ProgramOf, probe_programs};
use std::f64::consts::TAU;
use trueaxis_nc::{Control, Library, Program, Settings, Step, interpret};

/// The files of one answer as a folder of the control.
struct Beside<'a>(&'a [ProbeFile]);

impl Library for Beside<'_> {
    fn text(&self, name: &str) -> Result<Vec<u8>, String> {
        let plain = |n: &str| n.to_ascii_lowercase().rsplit(['/', '\\']).next().map(str::to_owned);
        let stem = |n: &str| plain(n).map(|n| n.split('.').next().unwrap_or_default().to_owned());
        let found = self.0.iter().find(|f| plain(&f.name) == plain(name));
        let found = found.or_else(|| self.0.iter().find(|f| stem(&f.name) == stem(name)));
        found.map(|f| f.text.clone()).ok_or_else(|| format!("{name} is not among the files"))
    }
}

/// How far from its stations the spindle would stand with one of the programs, mm: what the decimals leave. Infinite
/// if the program has errors.
pub fn probe_stations(of: &ProgramOf<'_>, files: &[ProbeFile], name: &str) -> f64 {
    let stand_in = (of.control == Control::Heidenhain)
        .then(|| probe_programs(&ProgramOf { is_stand_in: true, ..*of }).ok())
        .flatten();
    let files = stand_in.as_deref().unwrap_or(files);
    let Some(file) = files.iter().find(|f| f.name == name) else { return f64::INFINITY };
    let program = Program::new(name, file.text.clone(), of.control);
    let mut places: Vec<[f64; 3]> = Vec::new();
    let outcome = interpret(&program, &Beside(files), &Settings::default(), &mut |step| {
        if let Step::Move(m) = step {
            places.push([m.target.0[0], m.target.0[1], m.target.0[2]]);
        }
    });
    if outcome.problems.has_errors() || !outcome.finished {
        return f64::INFINITY;
    }
    let off = |station: &[f64; 3]| {
        let from = |p: &[f64; 3]| (0..3).map(|i| (p[i] - station[i]).abs()).fold(0.0, f64::max);
        places.iter().map(from).fold(f64::INFINITY, f64::min)
    };
    stations(of, name).iter().map(off).fold(0.0, f64::max)
}

/// Where the spindle must come: before and at the end of every touch, and between.
fn stations(of: &ProgramOf<'_>, name: &str) -> Vec<[f64; 3]> {
    let (Some(s), gauge) = (&of.study.program, &of.study.gauge) else { return Vec::new() };
    let ball = of.stylus.ball_radius_mm;
    let gaps = [-s.stand_off_mm, s.beyond_of(ball)];
    if let (true, Some(face), Some(steps)) =
        (name.starts_with("z-datum"), &s.face, &of.study.z_datum)
    {
        let height = super::super::datums::z_datum(steps).top_mm + face.length_mm;
        let [x, y] = face.place_mm;
        return gaps.iter().map(|gap| [x, y, height - gap]).collect();
    }
    let count = if name.starts_with("four-hits") { 4 } else { s.directions };
    let centre = gauge.centre_mm.unwrap_or_default();
    let mut all = vec![[centre.x, centre.y, s.clear_z_mm], [centre.x, centre.y, s.z_mm]];
    for i in 0..count {
        let (sin, cos) = (TAU * i as f64 / count as f64).sin_cos();
        let contact = gauge.contact_mm(ball);
        let at = |gap: &f64| {
            let r = contact + gap;
            [centre.x + r * cos, centre.y + r * sin, s.z_mm]
        };
        all.extend(gaps.iter().map(at));
    }
    all
}
