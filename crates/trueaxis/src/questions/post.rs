//! How does a path become a program of one control?

mod set_up;
mod test_piece;

use super::words::{self, argument};
use super::{Answer, MachineChoice, NewFile, Question, Tell, named_control};
use crate::files::output::Output;
use crate::report::{self, PostReport};
use serde_json::Value;
use std::path::PathBuf;
use trueaxis_calibrate::plan::extension;
use trueaxis_cl::{ClFile, ClPath, Reading};
use trueaxis_input::{Content, Diagnostics, Files, Place};
use trueaxis_machine::Machine;
use trueaxis_part::TestPieceFile;
use trueaxis_post::{
    FeedRule, PostOptions, Posted, Verification, post, post_path, verify, verify_in_place,
};
use trueaxis_report::{Report, document};
use trueaxis_writer::{BUILT_IN, Decimals, MOST_DECIMALS, Templates, TipWords, WriteError};

/// An NC program from cutter locations. Numbers are as typed, in mm and degrees.
#[derive(Debug, Clone)]
pub struct Post {
    /// The machine.
    pub machine: MachineChoice,
    /// The cutter locations.
    pub file: PathBuf,
    /// The control, by its name.
    pub control: String,
    /// How tip and tool axis are written; none for axis positions.
    pub tip_words: Option<TipWords>,
    /// Whether arcs and cycles are written as lines, too.
    pub lines_only: bool,
    /// Largest distance between path and program.
    pub tolerance: String,
    /// Largest angle of the tool axis between blocks.
    pub axis_tolerance: String,
    /// A tool axis nearer to a pole passes through it.
    pub pole_tolerance: String,
    /// How feeds are written.
    pub feed_rule: FeedRule,
    /// Feed of the tip where the file has none, mm/min.
    pub feed: Option<String>,
    /// Retraction of the tool before a reorientation.
    pub retract: String,
    /// Whether the file is in inches, where that is not left to it.
    pub inches: Option<bool>,
    /// Decimals of mm and of degrees: `4,5`.
    pub decimals: String,
    /// A template of programs instead of that of the control.
    pub template: Option<PathBuf>,
    /// Number of the program.
    pub number: u32,
    /// Where the program goes.
    pub output: PathBuf,
    /// Whether it is read back and simulated.
    pub verify: bool,
    /// The folder for the programs of the set-up of a test piece and its readings.
    pub set_up: Option<PathBuf>,
}

/// A program with its proof.
pub struct PostAnswer {
    machine: Machine,
    /// The name of the file, and how many points it has.
    file: (String, usize),
    options: PostOptions,
    posted: Posted,
    verification: Option<Verification>,
    /// Words that are not applied.
    not_applied: usize,
    output: PathBuf,
    set_up: Vec<NewFile>,
    set_up_is_sound: bool,
}

/// The template of a control, to be edited.
pub fn template(control: &str, problems: &mut Diagnostics) -> Option<&'static str> {
    let control = named_control(control, problems)?;
    BUILT_IN.iter().find(|(c, _)| *c == control).map(|(_, text)| *text)
}

impl Post {
    fn read_file(&self, files: &Files, problems: &mut Diagnostics) -> Option<ClPath> {
        let text: Content =
            match self.file.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml")) {
                true => {
                    test_piece::read(&self.file, files, self.tolerance.parse().ok()?, problems)?
                        .into_bytes()
                        .into()
                }
                false => files.content(&self.file, "a cutter-location file", problems)?,
            };
        let reading = Reading { inches: self.inches };
        Some(problems.keep(ClPath::read(&self.file.display().to_string(), &text, &reading)))
    }

    fn options(&self, files: &Files, problems: &mut Diagnostics) -> Option<PostOptions> {
        let mut number = |name: &str, text: &str, low: f64| {
            let usual = ("a possible value", "such as 0.01");
            words::plain(name, text, |v| (low..1e6).contains(v), usual, problems)
        };
        let tolerance_mm = number("--tolerance", &self.tolerance, 1e-6);
        let axis_tolerance = number("--axis-tolerance", &self.axis_tolerance, 1e-6);
        let pole = number("--pole-tolerance", &self.pole_tolerance, 0.0);
        let retract_mm = number("--retract", &self.retract, 0.0);
        let feed = self.feed.as_ref().map(|text| number("--feed", text, 1e-3));
        let digits: Option<Vec<u8>> =
            self.decimals.split(',').map(|t| t.trim().parse().ok()).collect();
        let digits = digits.filter(|d| d.len() == 2 && d.iter().all(|d| *d <= MOST_DECIMALS));
        if digits.is_none() {
            let message = format!("`{}` are not two numbers of decimals", self.decimals);
            problems.error("bad-number", argument("--decimals"), message, "such as 3,4");
        }
        let templates = match &self.template {
            Some(_) => Some(self.templates(files, problems)?),
            None => None,
        };
        let digits = digits?;
        let name = self.output.file_stem();
        Some(PostOptions {
            tip_words: self.tip_words,
            lines_only: self.lines_only,
            tolerance_mm: tolerance_mm?,
            axis_tolerance_rad: axis_tolerance?.to_radians(),
            pole_rad: pole?.to_radians(),
            feed: self.feed_rule,
            usual_feed_mm_per_min: match feed {
                Some(value) => Some(value?),
                None => None,
            },
            retract_mm: retract_mm?,
            decimals: Decimals { linear: digits[0], angle: digits[1], ..Decimals::default() },
            templates,
            name: name.map_or_else(|| "PROGRAM".into(), |n| n.to_string_lossy().into_owned()),
            number: self.number,
            ..PostOptions::of(named_control(&self.control, problems)?)
        })
    }

    fn templates(&self, files: &Files, problems: &mut Diagnostics) -> Option<Templates> {
        let path = self.template.as_ref()?;
        let text = files.text(path, "a template of programs", problems)?;
        let refuse = |error: WriteError| {
            let place = Place::whole(&path.display().to_string());
            let hint = "--show-template prints one that works";
            problems.error("bad-template", place, error.to_string(), hint);
        };
        Templates::parse(&text).map_err(refuse).ok()
    }
}

/// Programs of the set-up, and its file of readings.
#[derive(Debug, Default)]
pub struct SetUpPaths {
    paths: Vec<(&'static str, ClFile)>,
    readings: String,
}

impl Post {
    /// The paths of the set-up, if they are asked for.
    fn set_up_paths(&self, files: &Files, problems: &mut Diagnostics) -> Option<SetUpPaths> {
        if self.set_up.is_none() {
            return Some(SetUpPaths::default());
        }
        let refuse = |message: &str, hint: &str, problems: &mut Diagnostics| {
            problems.error("no-set-up", argument("--set-up"), message.to_owned(), hint);
        };
        if !self.file.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml")) {
            refuse("a set-up is that of a test piece", "name a test piece (.toml)", problems);
            return None;
        }
        // What is wrong with the file was reported when it was read for its own path.
        let piece = TestPieceFile::of_file(files, &self.file, &mut Diagnostics::new())?;
        let Some(set_up) = &piece.set_up else {
            let hint =
                "[set_up] feed = \"15 mm/min\", spindle = \"600 rpm\", hole_depth = \"40 mm\"";
            refuse("the test piece states no set-up", hint, problems);
            return None;
        };
        let reading = Reading { inches: None };
        let paths = set_up::locations(&piece, set_up).map(|(name, text)| {
            (name, problems.keep(ClFile::read(name, text.into_bytes(), &reading)))
        });
        Some(SetUpPaths { paths: paths.into(), readings: set_up::readings(&piece) })
    }

    /// The programs of the set-up, each read back.
    fn set_up_files(
        &self,
        machine: &Machine,
        options: &PostOptions,
        set_up: &SetUpPaths,
        problems: &mut Diagnostics,
    ) -> Option<(Vec<NewFile>, bool)> {
        let Some(folder) = &self.set_up else { return Some((Vec::new(), true)) };
        let (mut files, mut is_sound) = (Vec::new(), true);
        for (name, path) in &set_up.paths {
            let options = PostOptions { name: (*name).to_owned(), ..options.clone() };
            let posted = problems.keep(post(machine, path, &options))?;
            is_sound &= verify(machine, &posted, &options).is_within(&options);
            let file = format!("{name}.{}", extension(options.control));
            files.push(NewFile::of("set-up", folder.join(file), posted.text));
        }
        let readings = folder.join(set_up::READINGS);
        files.push(NewFile::of("readings to fill in", readings, set_up.readings.clone()));
        Some((files, is_sound))
    }
}

impl Question for Post {
    type Input = (Machine, ClPath, PostOptions, SetUpPaths);
    type Answer = PostAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Self::Input> {
        let machine = self.machine.read(files, problems);
        let file = self.read_file(files, problems);
        let options = self.options(files, problems);
        if self.machine.has_temperatures() {
            let message = "a program is made for the nominal machine".to_owned();
            problems.error("no-temperature", argument("--temperature"), message, "leave it out");
        }
        let set_up = self.set_up_paths(files, problems);
        Some((machine?, file?, options?, set_up?))
    }

    fn outputs(&self, _: Option<&Self::Input>) -> Vec<Output> {
        let readings = |folder: &PathBuf| folder.join(set_up::READINGS);
        let set_up = self.set_up.iter().map(readings);
        let set_up = set_up.map(|path| Output::in_new_folder("--set-up", path));
        [Output::file("-o", &self.output)].into_iter().chain(set_up).collect()
    }

    fn answer(
        &self,
        (machine, path, options, set_up): Self::Input,
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<PostAnswer> {
        let file = (path.name().to_owned(), path.points());
        let posted = problems.keep(post_path(&machine, path, &options));
        let mut posted = posted.filter(|_| !problems.has_errors())?;
        let verification = self.verify.then(|| verify_in_place(&machine, &mut posted, &options));
        let output = self.output.clone();
        let (set_up, set_up_is_sound) = self.set_up_files(&machine, &options, &set_up, problems)?;
        let not_applied = words::not_applied(problems);
        Some(PostAnswer {
            machine,
            file,
            options,
            posted,
            verification,
            not_applied,
            output,
            set_up,
            set_up_is_sound,
        })
    }
}

impl PostAnswer {
    /// Whether the program is written: nothing is known against its path.
    fn is_proved(&self) -> bool {
        self.shown().is_sound() && self.set_up_is_sound
    }

    fn shown(&self) -> PostReport<'_> {
        PostReport {
            machine: &self.machine,
            file: &self.file.0,
            points: self.file.1,
            options: &self.options,
            posted: &self.posted,
            verification: self.verification.as_ref(),
            not_applied: self.not_applied,
            output: &self.output,
        }
    }
}

impl Answer for PostAnswer {
    fn document(&self, _: &Diagnostics) -> Value {
        document(&report::PostDocument::from(&self.shown()))
    }

    fn report(&self) -> Report<'_> {
        report::post_report(&self.shown())
    }

    fn is_yes(&self) -> bool {
        self.is_proved() && self.not_applied == 0
    }

    fn files(&mut self) -> Vec<NewFile> {
        if !self.is_proved() {
            return Vec::new();
        }
        let program = NewFile::of("", &self.output, std::mem::take(&mut self.posted.text));
        [program].into_iter().chain(std::mem::take(&mut self.set_up)).collect()
    }

    fn notes(&self) -> Vec<String> {
        let note = "the program is not within the tolerances; nothing was written";
        (!self.is_proved()).then(|| note.to_owned()).into_iter().collect()
    }
}
