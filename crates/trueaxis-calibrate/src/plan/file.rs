//! The sections of a campaign file that plan: `[candidates]`, `[limit]`, `[want]`, `[program]`.

use super::program::{ProgramSettings, read_program_settings};
use trueaxis_geometry::exchange::Criterion;
use trueaxis_input::{Diagnostics, Dimension, Files, Item, Section};
use trueaxis_measure::instruments::Instrument;
use trueaxis_measure::measure::path::Path;
use trueaxis_measure::measure::{Campaign, Kind, Readings, path, read_campaign};

/// A campaign with all that is planned of it.
#[derive(Debug, Clone)]
pub struct Plan {
    /// Machine, instruments, unknowns.
    pub campaign: Campaign,
    /// The paths that are measured in any case.
    pub paths: Vec<Path>,
    /// What is chosen from, if the campaign asks for a choice.
    pub candidates: Option<Candidates>,
    /// How programs are written and checked.
    pub program: ProgramSettings,
}

/// What a choice is made from.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidates {
    /// All that may be measured; stations of one group are one pose.
    pub stations: Readings,
    /// What the choice may cost.
    pub limit: Limit,
    /// What it shall determine.
    pub want: Want,
    /// How long the machine stands before a reading, s.
    pub dwell_s: f64,
    /// How far an axis goes beyond a station that it does not reach from the stated side. Unit: mm or rad.
    pub overrun: f64,
}

/// `[limit]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limit {
    /// At most so many poses.
    pub poses: Option<usize>,
    /// At most so long, s.
    pub time_s: Option<f64>,
    /// What a reading takes, s.
    pub per_hit_s: f64,
    /// What a change of pose takes, s.
    pub per_pose_s: f64,
}

/// `[want]`.
#[derive(Debug, Clone, PartialEq)]
pub struct Want {
    /// Numbers of the terms that shall be known.
    pub terms: Vec<usize>,
    /// What shall be small.
    pub criterion: Criterion,
    /// The standard uncertainty of a length that is as bad as `angle_rad` of an angle, mm.
    pub length_mm: f64,
    /// See there, rad.
    pub angle_rad: f64,
}

/// Reads a campaign with its paths and what is to be chosen.
pub fn read_plan(files: &Files, path: &std::path::Path) -> (Option<Plan>, Diagnostics) {
    let (read, problems) = read_campaign(files, path, |root, campaign| {
        let paths = path::read_paths(root, campaign);
        let candidates = match root.get("candidates") {
            None => Some(None),
            Some(item) => read_candidates(root, &item, campaign).map(Some),
        };
        let program = root.section("program", read_program_settings);
        let program = program.map_or(Some(ProgramSettings::default()), |p| p);
        let (paths, candidates, program) = (paths?, candidates?, program?);
        if !ball_fits(root, campaign, &program) {
            return None;
        }
        if paths.is_empty() && candidates.is_none() {
            let message = "there is nothing to measure".to_owned();
            root.error("missing-key", message, "[[path]] kind = \"A\" …, or [candidates]");
            return None;
        }
        if campaign.terms.is_empty() {
            let message = "no error of the machine is unknown".to_owned();
            root.error("missing-key", message, "[unknown] location = \"minimal\"");
            return None;
        }
        Some((paths, candidates, program))
    });
    let plan = read.map(|(campaign, (paths, candidates, program))| Plan {
        campaign,
        paths,
        candidates,
        program,
    });
    (plan, problems)
}

/// A touch probe triggers at the sum of both radii from the centre of the ball: a ball that is as large by itself would be
/// driven into.
fn ball_fits(root: &Section<'_>, campaign: &Campaign, program: &ProgramSettings) -> bool {
    let radius_mm = 0.5 * program.ball_diameter_mm;
    let touches = |i: &&Instrument| i.kind == Kind::TouchProbeBall && i.length_mm <= radius_mm;
    let Some(instrument) = campaign.instruments.iter().find(touches) else { return true };
    let message = format!(
        "`length` of {} is {} mm, the radii of ball and stylus, and the ball alone has {radius_mm} mm",
        instrument.name, instrument.length_mm
    );
    let hint = "[program] ball_diameter = \"25 mm\" and length = \"15.5 mm\" of the instrument belong together";
    root.error("contradiction", message, hint);
    false
}

fn read_candidates(root: &Section<'_>, item: &Item<'_>, campaign: &Campaign) -> Option<Candidates> {
    let path = item.section("candidates", |s| path::read_path(s, campaign)).flatten();
    let Some(limit) = root.section("limit", read_limit) else {
        let message = "how many of the candidates may be measured?".to_owned();
        root.error("missing-key", message, "[limit] minutes = 5, or poses = 40");
        return None;
    };
    let usual = Want {
        terms: (0..campaign.terms.len()).collect(),
        criterion: Criterion::A,
        length_mm: 1e-3,
        angle_rad: 5e-6,
    };
    let want = root.section("want", |s| read_want(s, campaign, usual.clone()));
    let want = want.map_or(Some(usual), |w| w);
    let paths = path?;
    let largest = |of: fn(&Path) -> f64| paths.iter().map(of).fold(0.0, f64::max);
    let (dwell_s, overrun) = (largest(|p| p.dwell_s), largest(|p| p.overrun));
    Some(Candidates { stations: joined(paths), limit: limit?, want: want?, dwell_s, overrun })
}

/// The stations of all paths; poses stay apart.
fn joined(paths: Vec<Path>) -> Readings {
    let mut stations = Readings::default();
    for path in paths {
        let first = stations.groups.iter().max().map_or(0, |last| last + 1);
        let mut next = path.stations;
        next.groups.iter_mut().for_each(|group| *group += first);
        stations.append(&next);
    }
    stations
}

fn read_limit(section: &Section<'_>) -> Option<Limit> {
    let poses = section.get("poses").map(|i| i.count());
    let minutes = section.get("minutes").map(|i| i.number());
    let per_hit = section.quantity("per_hit", Dimension::Time).unwrap_or(3.0);
    let per_pose = section.quantity("per_pose", Dimension::Time).unwrap_or(5.0);
    let poses = match poses {
        Some(poses) => Some(poses?),
        None => None,
    };
    let time_s = match minutes {
        Some(minutes) => Some(minutes? * 60.0),
        None => None,
    };
    if poses.is_none() && time_s.is_none() {
        section.error("missing-key", "a limit of what?".into(), "minutes = 5, or poses = 40");
        return None;
    }
    let costs_nothing = per_hit < 0.0 || per_pose < 0.0 || per_hit + per_pose <= 0.0;
    if poses == Some(0) || time_s.is_some_and(|t| t <= 0.0) || costs_nothing {
        let message = "within this limit nothing is measured".to_owned();
        section.error("bad-limit", message, "minutes = 5, per_hit = \"3 s\", per_pose = \"5 s\"");
        return None;
    }
    Some(Limit { poses, time_s, per_hit_s: per_hit, per_pose_s: per_pose })
}

fn read_want(section: &Section<'_>, campaign: &Campaign, usual: Want) -> Option<Want> {
    let mut want = usual;
    if let Some(item) = section.get("errors") {
        want.terms = read_wanted(&item, campaign)?;
    }
    match section.text("criterion") {
        None => {}
        Some("A" | "a") => want.criterion = Criterion::A,
        Some("D" | "d") => want.criterion = Criterion::D,
        Some(other) => {
            let message = format!("`{other}` is no criterion");
            section.error("bad-criterion", message, "\"A\" (sum of variances) or \"D\" (volume)");
            return None;
        }
    }
    let positive = |key: &str, dimension, usual: f64| match section.quantity(key, dimension) {
        None => Some(usual),
        Some(u) if u > 0.0 => Some(u),
        Some(_) => {
            section.error("bad-limit", format!("`{key}` must be more than 0"), "such as \"1 um\"");
            None
        }
    };
    want.length_mm = positive("length", Dimension::Length, want.length_mm)?;
    want.angle_rad = positive("angle", Dimension::Angle, want.angle_rad)?;
    Some(want)
}

/// `"all"`, `"rotary"` (those of the rotary axes), or names of unknowns or errors.
fn read_wanted(item: &Item<'_>, campaign: &Campaign) -> Option<Vec<usize>> {
    let all = || campaign.terms.iter().enumerate();
    if !item.is_list() {
        return match item.text()? {
            "all" => Some(all().map(|(k, _)| k).collect()),
            "rotary" => {
                Some(all().filter(|(_, t)| t.error.body.is_rotary()).map(|(k, _)| k).collect())
            }
            _ => {
                let hint = "\"all\", \"rotary\" or a list of names [\"EX0C\", \"EC0Y\"]";
                item.error("unknown-error-name", "which errors are wanted?".into(), hint);
                None
            }
        };
    }
    let mut wanted = Vec::new();
    for item in item.list()? {
        let name = item.text()?;
        let named = |t: &trueaxis_measure::unknowns::term::Term| {
            t.name() == name || t.error.to_string() == name
        };
        let before = wanted.len();
        wanted.extend(all().filter(|(_, t)| named(t)).map(|(k, _)| k));
        if wanted.len() == before {
            let message = format!("`{name}` is not among the unknowns");
            item.error("unknown-error-name", message, "name it in [unknown] too");
            return None;
        }
    }
    wanted.sort_unstable();
    wanted.dedup();
    Some(wanted)
}
