//! How is a surface probed?

use super::{Answer, NewFile, Question, Tell, in_folder, named_control, with_diagnostics};
use crate::report;
use serde_json::Value;
use std::path::PathBuf;
use trueaxis_calibrate::plan::extension;
use trueaxis_calibrate::plan::program::ProgramCheck;
use trueaxis_calibrate::plan::surface::{
    Pose, SurfacePoint, SurfaceStudy, check_surface, nominal_table, poses, read_surface, spread,
    surface_program,
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
    output: Option<PathBuf>,
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

impl Question for PlanSurface {
    type Input = (SurfaceStudy, Control);
    type Answer = SurfaceAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Self::Input> {
        let study = problems.keep(read_surface(files, &self.study));
        let control = named_control(&self.control, problems);
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
        let (spread, output) = (points.len(), self.output.clone());
        Some(SurfaceAnswer { study, poses, spread, control, program, check, output })
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
        in_folder(self.output.as_deref(), [(program, self.program.clone()), table])
    }
}
