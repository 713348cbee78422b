//! Readings evaluated by the standards.

use crate::body::{needed, short};
use crate::desk::{Desk, Job};
use crate::frame::Array;
use crate::refusal::{Refusal, entries};
use crate::request::{Diagnosed, Reply, Request, ask_with};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use trueaxis::JsonSchema;
use trueaxis::files::disk;
use trueaxis::input::Files;
use trueaxis::questions::{Answer, Evaluate, ReadingsFile};
use trueaxis::report::{DiagnosticEntry, English, EvaluationDocument, Picture, Table};
use trueaxis::verify::Standard;
use trueaxis::verify::columns::Column;
use trueaxis::verify::import::Import;

/// The standards.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct StandardsRequest {}

/// A standard.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct StandardEntry {
    /// Its name in requests and on the command line.
    key: &'static str,
    /// Its title.
    title: &'static str,
    /// The columns that its table may have.
    columns: Vec<ColumnEntry>,
}

/// A column that a table of readings may have.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct ColumnEntry {
    /// Its name in a mapping file.
    name: &'static str,
    /// What it holds.
    title: &'static str,
    /// Its usual units; none where it has no unit.
    units: &'static [&'static str],
    /// Whether several of them are numbered: `up_1`, `up_2`.
    is_numbered: bool,
    /// What its words mean; none where it has numbers or any words.
    words: &'static [&'static str],
}

impl From<&Column> for ColumnEntry {
    fn from(column: &Column) -> Self {
        let Column { name, title, units, is_numbered, words } = *column;
        Self { name, title, units, is_numbered, words }
    }
}

impl Request for StandardsRequest {
    type Answer<'a> = [StandardEntry; Standard::ALL.len()];

    fn answer(self, _: &Desk, _: &Job) -> Result<Reply<Self>, Refusal> {
        let standards = Standard::ALL.map(|s| StandardEntry {
            key: s.key(),
            title: s.title(),
            columns: s.columns().iter().map(ColumnEntry::from).collect(),
        });
        Ok(Reply::json(&standards))
    }
}

/// Evaluates readings: `path` names their file, or `name` and `text` are a file that was dropped.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct EvaluateRequest {
    /// The standard, such as `iso230-2`.
    pub(super) standard: String,
    /// The file of the readings.
    pub(super) path: Option<String>,
    /// The name of a file that was dropped.
    pub(super) name: Option<String>,
    /// Its text.
    pub(super) text: Option<String>,
    /// The format of the file; by its ending if it is left out.
    pub(super) import: Option<String>,
    /// The feature of a QIF file.
    pub(super) feature: Option<String>,
    /// The file of the conditions; the one beside the readings if it is left out.
    pub(super) conditions: Option<String>,
    /// The radius of a circular test, a length with its unit.
    pub(super) radius: Option<String>,
    /// The window of a drift test, a time with its unit.
    pub(super) window: Option<String>,
    /// The text of a mapping file that counts instead of the one beside the readings.
    pub(super) mapping: Option<String>,
    /// The text of conditions that count instead of those of a file.
    pub(super) stated: Option<String>,
    /// Tolerances, such as `A=10 um`.
    pub(super) tolerances: Option<Vec<String>>,
    /// Whether a value alone decides, without its uncertainty.
    pub(super) is_simple: Option<bool>,
}

/// An evaluation. Arrays: `line` (f64: x, y and half the width of the band for each point of the bands), `points`
/// (f64: x and y of each point; in polar pictures angle, rad, and radial deviation, µm).
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct EvaluateAnswer<'a> {
    /// The document of `trueaxis evaluate`.
    document: Diagnosed<'a, EvaluationDocument<'a>>,
    /// The text of `trueaxis evaluate`.
    text: String,
    /// The file of the conditions below the project folder; null if there is none.
    conditions_file: Option<String>,
    /// The tables of the results.
    figures: Vec<TableEntry<'a>>,
    /// Further tables.
    details: Vec<TableEntry<'a>>,
    /// The pictures.
    pictures: Vec<PictureEntry<'a>>,
    /// Warnings and notes, each as one text.
    remarks: Vec<String>,
    /// The same with code and place.
    diagnostics: Vec<DiagnosticEntry<'a>>,
}

/// A table of a report.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct TableEntry<'a> {
    /// Its title.
    title: &'a str,
    /// The text below it; may be empty.
    note: &'a str,
    /// The headings with their units.
    headings: &'a [String],
    /// The cells, row by row.
    rows: Vec<&'a [String]>,
    /// For each column, whether it contains words.
    words: Vec<bool>,
}

/// A part of an array: its first point and the number of points.
type Part = [usize; 2];

/// A picture of a report.
#[derive(Debug, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub(super) enum PictureEntry<'a> {
    /// Curves, bands and points over a straight axis.
    Scatter {
        /// Its title.
        title: &'a str,
        /// The text below it.
        note: &'a str,
        /// The name of the x axis with its unit.
        x: &'a str,
        /// The name of the y axis with its unit.
        y: &'a str,
        /// Whether the y axis contains 0.
        from_zero: bool,
        /// The series.
        bands: Vec<BandEntry<'a>>,
        /// A dashed line, as a part of `points`.
        dashed: Part,
    },
    /// Radial deviations around a circle, magnified.
    Polar {
        /// Its title.
        title: &'a str,
        /// The text below it.
        note: &'a str,
        /// The curves.
        lines: Vec<PolarLineEntry<'a>>,
    },
}

/// A series of a picture.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct BandEntry<'a> {
    /// Its name in the legend.
    label: &'a str,
    /// Its colour, from 0.
    colour: usize,
    /// Its line, as a part of `line`.
    line: Part,
    /// Its points, as a part of `points`.
    points: Part,
}

/// A curve around a circle.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct PolarLineEntry<'a> {
    /// Its name in the legend.
    label: &'a str,
    /// Its colour, from 0.
    colour: usize,
    /// Its points, as a part of `points`.
    points: Part,
}

impl EvaluateRequest {
    /// The readings of a file.
    pub(super) fn of(standard: String, path: String) -> Self {
        Self { standard, path: Some(path), ..Self::default() }
    }

    /// As the library is asked, and the files that it reads: those of the disk, and what was typed on the page.
    pub(super) fn question(self, desk: &Desk) -> Result<(Evaluate, Files), Refusal> {
        let in_project = |name: String| desk.project.path(&name);
        let data = match self.path {
            Some(path) => ReadingsFile::Path(in_project(path)?),
            None => ReadingsFile::Text(needed(self.name, "name")?, needed(self.text, "text")?),
        };
        let place = match &data {
            ReadingsFile::Path(path) => path.clone(),
            ReadingsFile::Text(name, _) => PathBuf::from(name),
        };
        let typed = Typed { mapping: self.mapping, stated: self.stated };
        let (map, stated) = typed.places(&place);
        let conditions = self.conditions.map(in_project).transpose()?;
        let question = Evaluate {
            standard: standard(&self.standard)?,
            data,
            import: self.import.as_deref().map(import).transpose()?,
            map,
            feature: self.feature,
            conditions: stated.or(conditions),
            radius: self.radius,
            window: self.window,
            write_back: None,
            machine: None,
            output: None,
            tolerances: self.tolerances.unwrap_or_default(),
            tolerance_file: None,
            is_simple: self.is_simple.unwrap_or_default(),
        };
        Ok((question, typed.files(&place)))
    }
}

/// What was typed on the page instead of files beside the readings.
struct Typed {
    mapping: Option<String>,
    stated: Option<String>,
}

impl Typed {
    /// The names under which mapping and conditions stand.
    fn places(&self, readings: &Path) -> (Option<PathBuf>, Option<PathBuf>) {
        let named =
            |text: &Option<String>, ending| text.as_ref().map(|_| readings.with_extension(ending));
        (named(&self.mapping, "map.toml"), named(&self.stated, "toml"))
    }

    /// The files of the disk, and these before them.
    fn files(self, readings: &Path) -> Files {
        let places = self.places(readings);
        let both = [(places.0, self.mapping), (places.1, self.stated)];
        disk().with_texts(both.into_iter().filter_map(|(place, text)| place.zip(text)))
    }
}

fn standard(key: &str) -> Result<Standard, Refusal> {
    Standard::ALL.into_iter().find(|s| s.key() == key).ok_or_else(|| {
        let all = Standard::ALL.map(Standard::key).join(", ");
        Refusal::bad(format!("unknown standard `{}`", short(key)), &all)
    })
}

fn import(key: &str) -> Result<Import, Refusal> {
    Import::ALL.into_iter().find(|import| import.key() == key).ok_or_else(|| {
        let all = Import::ALL.map(Import::key).join(", ");
        Refusal::bad(format!("unknown format `{}`", short(key)), &all)
    })
}

impl Request for EvaluateRequest {
    type Answer<'a> = EvaluateAnswer<'a>;

    fn answer(self, desk: &Desk, job: &Job) -> Result<Reply<Self>, Refusal> {
        let (question, files) = self.question(desk)?;
        let (evaluated, problems) = ask_with(&question, &files, job)?;
        let evaluation = evaluated.shown();
        let contents = evaluation.contents();
        let mut drawn = Drawn::default();
        let file = evaluated.conditions_file.as_ref();
        let answer = EvaluateAnswer {
            document: Diagnosed {
                document: EvaluationDocument::of(&evaluation),
                diagnostics: entries(&problems),
            },
            text: evaluated.text(&English),
            conditions_file: file.and_then(|path| desk.project.name_of(path)),
            figures: contents.results.iter().map(TableEntry::from).collect(),
            details: contents.details.iter().map(TableEntry::from).collect(),
            pictures: contents.pictures.iter().map(|p| drawn.picture(p)).collect(),
            remarks: evaluated.remarks.clone(),
            diagnostics: entries(&problems),
        };
        let arrays = vec![("line", Array::F64(drawn.line)), ("points", Array::F64(drawn.points))];
        Ok(Reply::frame(&answer, arrays))
    }
}

impl<'a> From<&'a (String, Table)> for TableEntry<'a> {
    fn from((title, table): &'a (String, Table)) -> Self {
        Self {
            title,
            note: &table.note,
            headings: &table.headings,
            rows: table.rows.iter().map(|row| &*row.cells).collect(),
            words: (0..table.headings.len()).map(|i| table.has_words(i)).collect(),
        }
    }
}

/// The numbers of all pictures, one after the other.
#[derive(Default)]
struct Drawn {
    /// x, y and half the width of the band.
    line: Vec<f64>,
    /// x and y.
    points: Vec<f64>,
}

impl Drawn {
    fn line(&mut self, line: &[(f64, f64, f64)]) -> Part {
        let first = self.line.len() / 3;
        self.line.extend(line.iter().flat_map(|(x, y, half)| [x, y, half]));
        [first, line.len()]
    }

    fn points(&mut self, points: &[(f64, f64)]) -> Part {
        let first = self.points.len() / 2;
        self.points.extend(points.iter().flat_map(|(x, y)| [x, y]));
        [first, points.len()]
    }

    fn picture<'a>(&mut self, picture: &'a Picture) -> PictureEntry<'a> {
        match picture {
            Picture::Scatter(s) => {
                let bands = s.bands.iter().map(|band| BandEntry {
                    label: &band.label,
                    colour: band.colour,
                    line: self.line(&band.line),
                    points: self.points(&band.points),
                });
                let bands = bands.collect();
                PictureEntry::Scatter {
                    title: &s.title,
                    note: &s.note,
                    x: &s.x,
                    y: &s.y,
                    from_zero: s.from_zero,
                    bands,
                    dashed: self.points(&s.dashed),
                }
            }
            Picture::Polar(p) => {
                let lines = p.lines.iter().map(|line| PolarLineEntry {
                    label: &line.label,
                    colour: line.colour,
                    points: self.points(&line.points),
                });
                PictureEntry::Polar { title: &p.title, note: &p.note, lines: lines.collect() }
            }
        }
    }
}
