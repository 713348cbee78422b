//! How is a surface probed?

use super::tool_setting::NOT_WRITTEN;
use super::{Answer, NewFile, Question, Tell, in_folder, named_control, with_diagnostics};
use crate::report;
use serde_json::Value;
use std::path::{Component, Path, PathBuf};
use trueaxis_calibrate::identify::probe::{Purpose, read_study};
use trueaxis_calibrate::plan::extension;
use trueaxis_calibrate::plan::program::ProgramCheck;
use trueaxis_calibrate::plan::surface::{
    HitsFiles, Pose, SurfacePoint, SurfaceStudy, check_surface, hits_study, nominal_table, poses,
    read_surface, spread, surface_files, surface_program, virtual_log,
};
use trueaxis_input::{Diagnostics, Files, Place};
use trueaxis_nc::Control;
use trueaxis_report::Report;

/// A probing path over a surface, from cutter locations or an STL file.
#[derive(Debug, Clone)]
pub struct PlanSurface {
    /// The study: machine, surface, spacing, probe.
    pub study: PathBuf,
    /// The control of the program, by its name.
    pub control: String,
    /// The folder for the program and the table of points.
    pub output: Option<PathBuf>,
    /// Whether a program that is not safe is written, too.
    pub write_unsafe: bool,
}

/// A probing path with its program.
#[derive(Debug)]
pub struct SurfaceAnswer {
    study: SurfaceStudy,
    poses: Vec<Pose>,
    /// How many points were spread over the surface.
    spread: usize,
    control: Control,
    program: Vec<u8>,
    check: ProgramCheck,
    /// What the virtual machine read, if the study has one.
    log: Option<String>,
    output: Option<PathBuf>,
    write_unsafe: bool,
}

/// Points over the surface that face the wanted way.
fn points(study: &SurfaceStudy, problems: &mut Diagnostics) -> Option<Vec<SurfacePoint>> {
    let place = || Place::whole(&study.file);
    let points = match spread(&study.candidates, study.spacing_mm, study.most_points) {
        Ok(points) => points,
        Err(reason) => {
            let hint = "a wider spacing, or a larger most_points";
            problems.error("too-many-points", place(), reason, hint);
            return None;
        }
    };
    let faces = |p: &SurfacePoint| {
        study.facing.is_none_or(|(direction, within)| {
            p.normal.dot(&direction).clamp(-1.0, 1.0).acos() <= within
        })
    };
    let points: Vec<SurfacePoint> = points.into_iter().filter(faces).collect();
    if points.is_empty() {
        let message = "no point is left".to_owned();
        problems.error("no-points", place(), message, "a wider `within`, or another `facing`");
        return None;
    }
    Some(points)
}

/// Says where the ball is not that of the calibration, if that exists by now: `identify surface` refuses it.
fn compare_ball(files: &Files, study: &SurfaceStudy, problems: &mut Diagnostics) {
    const SAME_MM: f64 = 1e-6;
    let Some((path, stylus)) = &study.calibration else { return };
    let Some(known) = read_study(files, path, Purpose::Programs).0 else { return };
    let only = known.styli.first().filter(|_| known.styli.len() == 1 && stylus.is_empty());
    let Some(stylus) = known.styli.iter().find(|s| s.name == *stylus).or(only) else { return };
    let [here, there] = [study.ball_radius_mm, stylus.ball_radius_mm].map(|radius| 2.0 * radius);
    if (here - there).abs() > SAME_MM {
        let message = format!(
            "the ball has {here} mm here, {there} mm in the calibration {}, stylus `{}`",
            path.display(),
            stylus.name
        );
        let hint = "calibrate this stylus, or name the right one";
        problems.warn("other-ball", Place::whole(&study.file), message, hint);
    }
}

/// The log of a virtual machine.
const VIRTUAL_LOG: &str = "virtual-hits.log";

/// A path as it is written in a file of a folder: relative, where both begin at the same place.
fn seen_from(folder: &Path, path: &Path) -> String {
    let absolute = |p: &Path| std::path::absolute(p).unwrap_or(p.to_owned());
    let (from, to) = match folder.is_relative() && path.is_relative() {
        true => (absolute(folder), absolute(path)),
        false => (folder.to_owned(), absolute(path)),
    };
    let plain = |p: &Path| {
        let mut parts: Vec<std::ffi::OsString> = Vec::new();
        for part in p.components() {
            match part {
                Component::ParentDir => drop(parts.pop()),
                Component::CurDir => {}
                part => parts.push(part.as_os_str().to_owned()),
            }
        }
        parts
    };
    let (from, to) = (plain(&from), plain(&to));
    let same = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    let up = from[same..].iter().map(|_| "..".into());
    let parts: Vec<std::ffi::OsString> = up.chain(to[same..].iter().cloned()).collect();
    parts.iter().map(|p| p.to_string_lossy().into_owned()).collect::<Vec<_>>().join("/")
}

impl Question for PlanSurface {
    type Input = (SurfaceStudy, Control);
    type Answer = SurfaceAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Self::Input> {
        let study = problems.keep(read_surface(files, &self.study));
        let control = named_control(&self.control, problems);
        if let Some(study) = &study {
            compare_ball(files, study, problems);
        }
        study.zip(control)
    }

    fn answer(
        &self,
        (study, control): Self::Input,
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<SurfaceAnswer> {
        let points = points(&study, problems)?;
        let poses = poses(&study, &points, problems);
        if poses.is_empty() {
            return None;
        }
        let program = match surface_program(&study, &poses, control) {
            Ok(program) => program,
            Err(error) => {
                let (place, hint) = (Place::whole("--control"), "choose another --control");
                problems.error("no-program", place, error.to_string(), hint);
                return None;
            }
        };
        let check = check_surface(&study, &poses, &program, control);
        let log = match &study.real {
            Some(real) => Some(virtual_log(&study, real, &poses, problems)?),
            None => None,
        };
        let (spread, output) = (points.len(), self.output.clone());
        let write_unsafe = self.write_unsafe;
        let answer = SurfaceAnswer {
            study,
            poses,
            spread,
            control,
            program,
            check,
            log,
            output,
            write_unsafe,
        };
        Some(answer)
    }
}

impl SurfaceAnswer {
    /// Whether there are files: the program is safe, or it is asked for all the same.
    fn is_written(&self) -> bool {
        self.write_unsafe || self.check.is_sound()
    }
}

impl Answer for SurfaceAnswer {
    fn document(&self, problems: &Diagnostics) -> Value {
        let Self { study, poses, spread, check, .. } = self;
        with_diagnostics(&report::SurfaceDocument::of(study, poses, *spread, check), problems)
    }

    fn report(&self) -> Report<'_> {
        report::surface_report(&self.study, &self.poses, self.spread, &self.check)
    }

    fn is_yes(&self) -> bool {
        self.check.is_sound()
    }

    fn files(&mut self) -> Vec<NewFile> {
        let points: Vec<SurfacePoint> = self.poses.iter().map(|p| p.point).collect();
        let program = format!("surface.{}", extension(self.control));
        let table = ("surface.csv".to_owned(), nominal_table(&points).into_bytes());
        let Some(folder) = self.output.as_deref().filter(|_| self.is_written()) else {
            return Vec::new();
        };
        let machine = seen_from(folder, &self.study.machine_path);
        let calibration = self.study.calibration.as_ref().map(|c| seen_from(folder, &c.0));
        let files = HitsFiles {
            machine: &machine,
            calibration: calibration.as_deref(),
            log: self.log.as_ref().map(|_| VIRTUAL_LOG),
        };
        let hits = hits_study(&self.study, self.poses.len(), &files);
        let hits = ("hits.toml".to_owned(), hits.into_bytes());
        let log = self.log.take().map(|log| (VIRTUAL_LOG.to_owned(), log.into_bytes()));
        let beside = surface_files(&self.study, self.control);
        let beside = beside.into_iter().map(|(name, text)| (name, text.into_bytes()));
        let files = [(program, self.program.clone()), table, hits].into_iter().chain(log);
        let files = files.chain(beside);
        in_folder(Some(folder), files)
    }

    fn notes(&self) -> Vec<String> {
        let Some(folder) = self.output.as_deref() else { return Vec::new() };
        if !self.is_written() {
            return vec![NOT_WRITTEN.to_owned()];
        }
        let hits = folder.join("hits.toml").display().to_string();
        let what = match self.study.real {
            Some(_) => "its log is virtual",
            None => "state the log of the control in it",
        };
        vec![format!("next: trueaxis identify surface {hits} ({what})")]
    }
}
