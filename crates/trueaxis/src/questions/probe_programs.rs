//! How are the hits of a touch probe made, and how does the control correct them?

use super::{Answer, NewFile, Question, Tell, in_folder, named_control, with_diagnostics};
use serde::Serialize;
use serde_json::Value;
use std::path::PathBuf;
use trueaxis_calibrate::identify::probe::program::{
    Correction, ProbeFile, ProgramOf, probe_programs, probe_stations,
};
use trueaxis_calibrate::identify::probe::{
    Calibration, Purpose, Study, datums, identify_probe, read_study,
};
use trueaxis_input::{Diagnostics, Dimension, Files, Place, parse_quantity};
use trueaxis_nc::Control;
use trueaxis_report::JsonSchema;
use trueaxis_report::{Report, Section, Table};

/// The programs of a study of a probe: the ring, four hits, the plane face.
#[derive(Debug, Clone)]
pub struct ProbePrograms {
    /// The study, with `[program]`.
    pub study: PathBuf,
    /// The control of the programs, by its name.
    pub control: String,
    /// The folder of the programs.
    pub output: PathBuf,
    /// Whether the control is to correct each hit, by what the hits of the study have shown.
    pub corrected: bool,
    /// The stylus; the first if none is named.
    pub stylus: Option<String>,
    /// How far the spindle is turned, as typed; `None`: as in `[program]`.
    pub orientation: Option<String>,
}

/// The programs with the table that they hold.
#[derive(Debug)]
pub struct ProbeProgramsAnswer {
    entries: Vec<ProbeProgramEntry>,
    table: Option<TableEntry>,
    files: Vec<NewFile>,
}

/// `trueaxis/identify-probe-programs/1`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ProbeProgramsDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/identify-probe-programs/1"))]
    pub schema: &'static str,
    /// Programs, subprograms and masks.
    pub files: &'a [ProbeProgramEntry],
    /// The table of corrections that the control applies; null: hits as they are.
    pub table: Option<&'a TableEntry>,
}

/// One file.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ProbeProgramEntry {
    /// Its name in the folder.
    pub file: String,
    /// What it is for.
    pub purpose: String,
    /// How many hits it makes; null: it is no program of its own.
    pub hits: Option<usize>,
    /// How far its stations, read back, lie from those that are wanted, µm; null: it is not run alone.
    pub off_stations_um: Option<f64>,
}

/// The table inside the control.
#[derive(Debug, Serialize, JsonSchema)]
pub struct TableEntry {
    /// Directions.
    pub directions: usize,
    /// Greatest less smallest correction, µm.
    pub range_um: f64,
    /// What the straight lines between the directions leave at most of the calibration, µm.
    pub interpolation_um: f64,
    /// The largest standard uncertainty of a correction, µm.
    pub u_um: f64,
    /// The length of the probe that is subtracted on the plane face, mm; null: it is not known.
    pub length_mm: Option<f64>,
}

/// Between the directions the table is compared at so many places.
const PLACES: usize = 16;

impl ProbePrograms {
    fn orientation_rad(&self, study: &Study, problems: &mut Diagnostics) -> Option<f64> {
        let Some(text) = &self.orientation else {
            return Some(study.program.as_ref().map_or(0.0, |p| p.orientation_rad));
        };
        let number = text.trim().parse::<f64>().is_ok();
        let text = if number { format!("{text} deg") } else { text.clone() };
        let place = Place::whole("--orientation");
        let found = parse_quantity(&text, Dimension::Angle);
        found.map_err(|e| problems.error(e.code(), place, e.to_string(), &e.hint())).ok()
    }

    fn stylus(&self, study: &Study, problems: &mut Diagnostics) -> Option<usize> {
        let Some(name) = &self.stylus else { return (!study.styli.is_empty()).then_some(0) };
        let index = study.styli.iter().position(|s| s.name == *name);
        if index.is_none() {
            let names: Vec<&str> = study.styli.iter().map(|s| s.name.as_str()).collect();
            let message = format!("there is no stylus `{name}`");
            let hint = format!("one of {}", names.join(", "));
            problems.error("unknown-stylus", Place::whole("--stylus"), message, &hint);
        }
        index
    }
}

/// The table of a calibration, with what it leaves between its directions.
fn correction(study: &Study, found: &Calibration) -> (Correction, TableEntry) {
    let turned = study.program.as_ref().map_or(0.0, |p| p.orientation_rad);
    let rows = found.table(study.table_steps, turned);
    let correction = Correction {
        dr_mm: rows.iter().map(|r| r.deviation_mm).collect(),
        length_mm: study.z_datum.as_ref().map(|steps| datums::z_datum(steps).length_mm),
        about: format!("stylus {}, {} directions", found.stylus, rows.len()),
    };
    let fine = found.table(PLACES * study.table_steps, turned);
    let off = fine.iter().map(|r| (r.deviation_mm - correction.dr_at(r.direction_rad)).abs());
    let most = |values: &mut dyn Iterator<Item = f64>| values.fold(f64::MIN, f64::max);
    let range = most(&mut correction.dr_mm.iter().copied())
        + most(&mut correction.dr_mm.iter().map(|v| -v));
    let entry = TableEntry {
        directions: rows.len(),
        range_um: 1e3 * range,
        interpolation_um: 1e3 * off.fold(0.0, f64::max),
        u_um: 1e3 * rows.iter().map(|r| r.u_mm).fold(0.0, f64::max),
        length_mm: correction.length_mm,
    };
    (correction, entry)
}

impl Question for ProbePrograms {
    type Input = (Study, Control);
    type Answer = ProbeProgramsAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Self::Input> {
        let purpose = if self.corrected { Purpose::Calibration } else { Purpose::Programs };
        let study = problems.keep(read_study(files, &self.study, purpose));
        let control = named_control(&self.control, problems);
        let (mut study, control) = study.zip(control)?;
        let turned = self.orientation_rad(&study, problems)?;
        if let Some(program) = &mut study.program {
            program.orientation_rad = turned;
        }
        Some((study, control))
    }

    fn answer(
        &self,
        (study, control): Self::Input,
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<ProbeProgramsAnswer> {
        let index = self.stylus(&study, problems)?;
        let stylus = study.styli.get(index)?;
        let known = match self.corrected {
            true => Some(correction(&study, identify_probe(&study, problems)?.get(index)?)),
            false => None,
        };
        let (correction, table) = known.unzip();
        let correction = correction.as_ref();
        let of = ProgramOf { study: &study, stylus, control, correction, is_stand_in: false };
        let made = probe_programs(&of).map_err(|reason| {
            let place = Place::whole(&study.file);
            problems.error("no-program", place, reason.to_string(), "see [program] of the study");
        });
        let made: Vec<ProbeFile> = made.ok()?;
        let mut entries = Vec::new();
        for file in &made {
            let off_mm = file.hits.map(|_| probe_stations(&of, &made, &file.name));
            if off_mm.is_some_and(|off| !off.is_finite()) {
                let message = "the program does not reach its stations".to_owned();
                problems.error(
                    "unsound-program",
                    Place::whole(&file.name),
                    message,
                    "another --control",
                );
            }
            entries.push(ProbeProgramEntry {
                file: file.name.clone(),
                purpose: file.purpose.clone(),
                hits: file.hits,
                off_stations_um: off_mm.map(|mm| 1e3 * mm),
            });
        }
        let files = made.into_iter().map(|f| (f.name, f.text));
        Some(ProbeProgramsAnswer { entries, table, files: in_folder(Some(&self.output), files) })
    }
}

impl Answer for ProbeProgramsAnswer {
    fn document(&self, problems: &Diagnostics) -> Value {
        let schema = "trueaxis/identify-probe-programs/1";
        let (files, table) = (&self.entries[..], self.table.as_ref());
        with_diagnostics(&ProbeProgramsDocument { schema, files, table }, problems)
    }

    fn report(&self) -> Report<'_> {
        let rows = self.entries.iter().map(|e| {
            let number = |v: Option<usize>| v.map_or(String::new(), |n| n.to_string());
            let off = e.off_stations_um.map_or(String::new(), |v| format!("{v:.2}"));
            [e.file.clone(), e.purpose.clone(), number(e.hits), off]
        });
        let heads = ["file", "what it is for", "hits", "off its stations, read back, µm"];
        let files = Section::new("").table(Table::new(heads).rows(rows));
        let report = Report::new("Programs of a touch probe").section(files);
        let Some(table) = &self.table else { return report };
        let mut pairs = vec![
            ("directions", table.directions.to_string()),
            ("range of the corrections", format!("{:.2} µm", table.range_um)),
            ("left between the directions, at most", format!("{:.2} µm", table.interpolation_um)),
            ("their standard uncertainty, at most", format!("{:.2} µm", table.u_um)),
        ];
        if let Some(length) = table.length_mm {
            pairs.push(("length of the probe", format!("{length:.4} mm")));
        }
        report.section(Section::new("Table inside the control").table(Table::pairs(pairs)))
    }

    fn files(&mut self) -> Vec<NewFile> {
        std::mem::take(&mut self.files)
    }
}
