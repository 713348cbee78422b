//! `[truth]` and `[disturb]` of a campaign file.

use super::{AxisDisturb, Chance, Disturb, Drawn, Truth, VirtualCampaign, chance, normal};
use crate::instruments::instrument::{Instrument, SetupError, SetupUnknown, Sight};
use crate::measure::path::{Path, read_paths};
use crate::measure::{Campaign, Kind};
use std::f64::consts::PI;
use std::sync::Arc;
use trueaxis_input::{Diagnostics, Dimension, Item, Section, Severity};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command, MAX_AXES};
use trueaxis_machine::errors::{ErrorName, ErrorValues, StatedError};
use trueaxis_machine::heat::TemperatureLog;
use trueaxis_machine::twist::Reference;

/// A ball nearer to an axis of rotation than this hardly moves when the axis turns, mm.
const ON_THE_AXIS_MM: f64 = 0.5;

/// Reads the paths, `[truth]` and `[disturb]`; `seed` stands for that of the file.
pub fn read_virtual(
    root: &Section<'_>,
    campaign: &Campaign,
    seed: Option<u64>,
) -> Option<VirtualCampaign> {
    let paths = read_paths(root, campaign)?;
    let log = root.get("disturb");
    let truth = match root.get("truth") {
        None => plain(campaign, seed.unwrap_or(1)),
        Some(item) => item.section("truth", |s| read_truth(s, campaign, seed)).flatten()?,
    };
    let read = match log {
        None => Some((Disturb::of_instruments(campaign.instruments.len()), None)),
        Some(item) => item.section("disturb", |s| read_disturb(s, campaign)),
    };
    let (disturb, log) = read?;
    check_paths(root, campaign, &paths);
    let real = VirtualCampaign { paths, truth: Truth { log, ..truth }, disturb };
    warn_of_balls_on_axes(root, campaign, &real.paths);
    Some(real)
}

impl Disturb {
    /// Only the noise of the instruments.
    pub fn of_instruments(count: usize) -> Self {
        Self {
            noise: 1.0,
            drift_per_hour: vec![[0.0; 3]; count],
            resolution: vec![0.0; count],
            outlier_share: 0.0,
            outlier_size: 0.0,
            lost_share: 0.0,
            axes: [AxisDisturb::default(); MAX_AXES],
        }
    }

    /// Nothing at all.
    pub fn none(count: usize) -> Self {
        Self { noise: 0.0, ..Self::of_instruments(count) }
    }
}

impl VirtualCampaign {
    /// Paths on the machine as its file states it, without disturbances.
    pub(super) fn nominal(campaign: &Campaign, paths: Vec<Path>) -> Self {
        let disturb = Disturb::none(campaign.instruments.len());
        Self { paths, truth: plain(campaign, 1), disturb }
    }
}

/// The machine of the campaign and the set-ups as they are stated.
pub(super) fn plain(campaign: &Campaign, seed: u64) -> Truth {
    let bare = |i: &Instrument| Instrument { unknowns: Vec::new(), ..i.clone() };
    Truth {
        machine: campaign.machine.clone(),
        machine_path: None,
        errors: Vec::new(),
        factors: None,
        instruments: campaign.instruments.iter().map(bare).collect(),
        setups: vec![Vec::new(); campaign.instruments.len()],
        log: None,
        added: Vec::new(),
        seed,
    }
}

fn read_truth(section: &Section<'_>, campaign: &Campaign, seed: Option<u64>) -> Option<Truth> {
    let stated = section.get("seed").and_then(|i| i.count()).map(|n| n as u64);
    let mut truth = plain(campaign, seed.or(stated).unwrap_or(1));
    let mut random = chance(truth.seed, Chance::Truth);
    if let Some(item) = section.get("machine") {
        read_machine(&item, campaign, &mut truth);
    }
    let draw = section.get("draw").and_then(|i| i.flag()) == Some(true);
    section.section("errors", |s| {
        for (key, _, item) in s.entries() {
            read_error(&item, key, &mut truth, &mut random);
        }
    });
    match section.get("setup") {
        None => {}
        Some(item) if item.is_table() => {
            item.section("truth.setup", |s| read_setups(s, campaign, &mut truth, &mut random));
        }
        Some(item) if item.as_text() == Some("drawn") => {
            draw_setups(campaign, &mut truth, &mut random);
        }
        Some(item) => {
            let hint = "{ ball_x = \"0.3 mm\" }, or \"drawn\": within what the campaign knows";
            item.error("bad-setup", "how do the instruments really stand?".to_owned(), hint);
        }
    }
    if draw {
        truth.factors = Some(Drawn::new(&truth.machine, || normal(&mut random)));
    }
    Some(truth)
}

fn read_machine(item: &Item<'_>, campaign: &Campaign, truth: &mut Truth) {
    let Some(name) = item.text() else { return };
    let path = campaign.path.parent().unwrap_or(std::path::Path::new("")).join(name);
    let (machine, problems) = Machine::read(item.files(), &path);
    let sound = !problems.has_errors();
    let mut found = Diagnostics::new();
    // What is only worth a warning was said of the machine of the campaign already.
    if !sound {
        found = problems;
    }
    for problem in found.iter() {
        item.error("truth-machine", problem.to_string(), &problem.hint);
    }
    let Some(machine) = machine.filter(|_| sound) else { return };
    if machine.chain_text() != campaign.machine.chain_text() {
        let message = format!(
            "the true machine is {}, that of the campaign {}",
            machine.chain_text(),
            campaign.machine.chain_text()
        );
        let hint = "the same machine with other errors: both chains must be alike";
        return item.error("other-chain", message, hint);
    }
    let here = Command::default();
    let none = ErrorValues::default();
    let apart =
        machine.pose(&here, &none).shift_mm() - campaign.machine.pose(&here, &none).shift_mm();
    if apart.norm() > 1e-6 {
        let message = format!(
            "with all axes at 0 the tools of both machine files stand {:.3} mm apart",
            apart.norm()
        );
        item.warn("other-place", message, "is the tool or the workpiece another one?");
    }
    let Some(machine) = at_temperatures(item, campaign, machine) else { return };
    truth.machine = machine.as_running();
    truth.machine_path = Some(path);
}

/// The true machine at the temperatures of the campaign; `None` if it cannot have them.
fn at_temperatures(item: &Item<'_>, campaign: &Campaign, machine: Machine) -> Option<Machine> {
    let Some(conditions) = &campaign.conditions else { return Some(machine) };
    // What the machine of the campaign says of them was said already.
    let mut said = Diagnostics::new();
    campaign.machine.at(conditions, &mut said);
    let mut problems = Diagnostics::new();
    let warm = machine.at(conditions, &mut problems);
    for problem in problems.iter().filter(|p| said.iter().all(|s| s.message != p.message)) {
        let message = format!("at the temperatures of the campaign: {}", problem.message);
        match problem.severity {
            Severity::Error => item.error("truth-machine", message, &problem.hint),
            Severity::Warning | Severity::Note => {
                item.warn("truth-machine", message, &problem.hint);
            }
        }
    }
    warm
}

/// `EX0C = "12 um"`, or drawn: `"0 ± 20 um"`.
fn read_error(item: &Item<'_>, key: &str, truth: &mut Truth, random: &mut rand_chacha::ChaCha8Rng) {
    let name = ErrorName::parse(key);
    let Some((name, index)) = name.and_then(|n| Some((n, truth.machine.error_index(n)?))) else {
        let message = format!("`{key}` is no error of {}", truth.machine.chain_text());
        return item.error("unknown-error-name", message, "such as EX0C, EC0Y, or EXX: a constant");
    };
    let angle = name.component.is_rotation();
    let dimension = if angle { Dimension::Angle } else { Dimension::Length };
    let Some(value) = drawn(item, dimension, random) else { return };
    truth.errors.push((name, value));
    let stated = StatedError::constant(value, None);
    truth.machine = truth.machine.clone().with_error(index, Some(stated));
}

fn drawn(
    item: &Item<'_>,
    dimension: Dimension,
    random: &mut rand_chacha::ChaCha8Rng,
) -> Option<f64> {
    let known = item.measured(dimension)?;
    Some(known.value + known.u.map_or(0.0, |u| u * normal(random)))
}

/// All that may be out of place at an instrument.
fn possible(instrument: &Instrument) -> Vec<(String, SetupError)> {
    let kind = instrument.kind;
    let three = [0, 1, 2];
    let zeros = (0..kind.zeros()).map(SetupError::Zero);
    let element = kind.element().is_some();
    let all = three.map(SetupError::ToolPoint).into_iter();
    let all = all.chain(three.map(SetupError::ReferencePoint));
    let all = all.chain(three.map(SetupError::ReferenceTurn));
    let all = all.chain(three.map(SetupError::Shift).into_iter().filter(|_| element));
    let all = all.chain([0, 1].map(SetupError::Tilt).into_iter().filter(|_| element));
    let all = all.chain(zeros).chain([SetupError::Scale]);
    let all = all.chain(instrument.material.is_some().then_some(SetupError::Material));
    let all = all.chain(three.map(SetupError::Drift));
    let zero = (instrument.sight == Sight::Distance).then_some(SetupError::ZeroDrift);
    let all =
        all.chain(zero).chain((!instrument.sight.is_angle()).then_some(SetupError::ToolDrift));
    all.map(|error| (kind.unknown_name(error), error)).collect()
}

fn set(truth: &mut Truth, of: usize, name: String, error: SetupError, value: f64) {
    truth.instruments[of].unknowns.push(SetupUnknown { name, error, prior_u: None });
    truth.setups[of].push(value);
}

/// `{ ball_x = "0.3 mm" }`, or by instrument: `{ probe = { ball_x = "0.3 mm" } }`.
fn read_setups(
    section: &Section<'_>,
    campaign: &Campaign,
    truth: &mut Truth,
    random: &mut rand_chacha::ChaCha8Rng,
) {
    for (key, _, item) in section.entries() {
        if item.is_table() {
            let Some(of) = campaign.instrument(key) else {
                let names: Vec<&str> =
                    campaign.instruments.iter().map(|i| i.name.as_str()).collect();
                let message = format!("no instrument is called `{key}`");
                item.error("unknown-instrument", message, &names.join(", "));
                continue;
            };
            item.section(&section.path(key), |s| {
                for (key, _, item) in s.entries() {
                    read_setup(&item, key, &[of], campaign, truth, random);
                }
            });
            continue;
        }
        let all: Vec<usize> = (0..campaign.instruments.len()).collect();
        read_setup(&item, key, &all, campaign, truth, random);
    }
}

fn read_setup(
    item: &Item<'_>,
    key: &str,
    among: &[usize],
    campaign: &Campaign,
    truth: &mut Truth,
    random: &mut rand_chacha::ChaCha8Rng,
) {
    let of = |i: &usize| {
        let (_, error) =
            possible(&campaign.instruments[*i]).into_iter().find(|(name, _)| name == key)?;
        Some((*i, error))
    };
    let found: Vec<(usize, SetupError)> = among.iter().filter_map(of).collect();
    let (of, error) = match found[..] {
        [one] => one,
        [] => {
            let known = among.first().map(|i| possible(&campaign.instruments[*i]));
            let names: Vec<String> =
                known.unwrap_or_default().into_iter().map(|(name, _)| name).collect();
            let message = format!("`{key}` is nothing of a set-up");
            return item.error("unknown-key", message, &names.join(", "));
        }
        _ => {
            let message = format!("`{key}` is part of more than one instrument");
            let hint = format!("setup = {{ NAME = {{ {key} = … }} }}");
            return item.error("which-instrument", message, &hint);
        }
    };
    let is_angle = campaign.instruments[of].sight.is_angle();
    let dimension = match error {
        SetupError::Drift(_) if is_angle => Dimension::AngularVelocity,
        error if error.is_rate() => Dimension::Velocity,
        SetupError::ReferenceTurn(_)
        | SetupError::Tilt(_)
        | SetupError::Scale
        | SetupError::Material => Dimension::Angle,
        SetupError::Zero(_) if is_angle => Dimension::Angle,
        _ => Dimension::Length,
    };
    if let Some(value) = drawn(item, dimension, random) {
        // Velocities are in mm/s and rad/s, drifts by the hour.
        let value = if error.is_rate() { value * 3600.0 } else { value };
        set(truth, of, key.to_owned(), error, value);
    }
}

/// Everything of a set-up that the campaign knows with an uncertainty.
fn draw_setups(campaign: &Campaign, truth: &mut Truth, random: &mut rand_chacha::ChaCha8Rng) {
    for (of, instrument) in campaign.instruments.iter().enumerate() {
        for unknown in &instrument.unknowns {
            if let Some(u) = unknown.prior_u {
                let value = u * normal(random);
                set(truth, of, unknown.name.clone(), unknown.error, value);
            }
        }
    }
}

fn read_disturb(
    section: &Section<'_>,
    campaign: &Campaign,
) -> (Disturb, Option<Arc<TemperatureLog>>) {
    let mut disturb = Disturb::of_instruments(campaign.instruments.len());
    if let Some(item) = section.get("noise")
        && let Some(noise) = item.number()
    {
        disturb.noise = not_negative(&item, noise);
    }
    if let Some(item) = section.get("drift_per_hour") {
        for_each(&item, section, campaign, |item, of| {
            if let Some(drift) = read_channels(item, &campaign.instruments[of]) {
                disturb.drift_per_hour[of] = drift;
            }
        });
    }
    if let Some(item) = section.get("resolution") {
        for_each(&item, section, campaign, |item, of| {
            if let Some(step) = item.quantity(dimension(&campaign.instruments[of])) {
                disturb.resolution[of] = not_negative(item, step);
            }
        });
    }
    section.section("outliers", |s| {
        let hint = "outliers = { share = \"1 %\", size = 20 }: size in times the noise";
        let share = s.require("share", hint).and_then(|i| read_share(&i));
        let size = s.require("size", hint).and_then(|i| Some(not_negative(&i, i.number()?)));
        if let (Some(share), Some(size)) = (share, size) {
            (disturb.outlier_share, disturb.outlier_size) = (share, size);
        }
    });
    if let Some(share) = section.get("lost").and_then(|i| read_share(&i)) {
        disturb.lost_share = share;
    }
    section.section("axis", |s| read_axes(s, campaign, &mut disturb));
    (disturb, read_log(section, campaign))
}

/// `[disturb.axis.A]`.
fn read_axes(section: &Section<'_>, campaign: &Campaign, disturb: &mut Disturb) {
    for (key, _, item) in section.entries() {
        let axes = campaign.machine.axes();
        let Some(i) = axes.iter().position(|a| a.name.to_string() == key) else {
            let message = format!("the machine has no axis `{key}`");
            item.error("unknown-axis", message, &campaign.machine.chain_text());
            continue;
        };
        let kind = axes[i].kind;
        let read = item.section(&section.path(key), |s| read_axis(s, kind));
        disturb.axes[i] = read.unwrap_or_default();
    }
}

fn read_log(section: &Section<'_>, campaign: &Campaign) -> Option<Arc<TemperatureLog>> {
    let item = section.get("temperature_log")?;
    let path = campaign.path.parent().unwrap_or(std::path::Path::new("")).join(item.text()?);
    let mut problems = Diagnostics::new();
    let text = section.files().text(&path, "a log of temperatures (CSV)", &mut problems);
    let log = text
        .and_then(|text| TemperatureLog::parse(&path.display().to_string(), &text, &mut problems));
    section.take_over(problems);
    log.map(Arc::new)
}

fn read_axis(section: &Section<'_>, kind: AxisKind) -> AxisDisturb {
    let own = match kind {
        AxisKind::Linear => Dimension::Length,
        AxisKind::Rotary => Dimension::Angle,
    };
    let value = |key: &str, dimension| {
        section.get(key).and_then(|i| Some(not_negative(&i, i.quantity(dimension)?))).unwrap_or(0.0)
    };
    let mut axis = AxisDisturb {
        repeatability: value("repeatability", own),
        backlash: value("backlash", own),
        lag_s: value("lag", Dimension::Time),
        spike: value("spike", own),
        spike_time_s: value("spike_time", Dimension::Time),
    };
    if let Some(item) = section.get("gain")
        && let Some(gain) = item.number()
    {
        if axis.lag_s > 0.0 || gain <= 0.0 {
            let message = "a gain is a positive number of 1/s, and stands for a lag".to_owned();
            item.error("bad-gain", message, "either lag = \"20 ms\" or gain = 50");
        }
        axis.lag_s = 1.0 / gain.max(1e-9);
    }
    if axis.spike > 0.0 && axis.spike_time_s == 0.0 {
        let message = "how fast does the axis come free?".to_owned();
        section.error("missing-key", message, "spike_time = \"30 ms\"");
    }
    axis
}

fn not_negative(item: &Item<'_>, value: f64) -> f64 {
    if value < 0.0 {
        let message = "this is a size: it cannot be negative".to_owned();
        item.error("negative", message, "write it without the minus");
    }
    value.max(0.0)
}

fn read_share(item: &Item<'_>) -> Option<f64> {
    let share = item.quantity(Dimension::Ratio)?;
    if !(0.0..1.0).contains(&share) {
        let message = "a share lies from 0 to below 1".to_owned();
        item.error("bad-share", message, "such as \"2 %\"");
        return None;
    }
    Some(share)
}

fn dimension(instrument: &Instrument) -> Dimension {
    if instrument.sight.is_angle() { Dimension::Angle } else { Dimension::Length }
}

/// One value for all channels, or a list with one each.
fn read_channels(item: &Item<'_>, instrument: &Instrument) -> Option<[f64; 3]> {
    let dimension = dimension(instrument);
    if !item.is_list() {
        return item.quantity(dimension).map(|v| [v; 3]);
    }
    let list = item.list()?;
    if list.len() != instrument.sight.channels() {
        let message = format!("the instrument has {} channels", instrument.sight.channels());
        item.error("bad-list", message, "one value for each channel");
        return None;
    }
    let mut values = [0.0; 3];
    for (value, item) in values.iter_mut().zip(list) {
        *value = item.quantity(dimension)?;
    }
    Some(values)
}

/// One value for all instruments, or a table by instrument.
fn for_each(
    item: &Item<'_>,
    section: &Section<'_>,
    campaign: &Campaign,
    mut read: impl FnMut(&Item<'_>, usize),
) {
    if !item.is_table() {
        return (0..campaign.instruments.len()).for_each(|of| read(item, of));
    }
    item.section(section.name(), |s| {
        for (key, _, item) in s.entries() {
            match campaign.instrument(key) {
                Some(of) => read(&item, of),
                None => {
                    let message = format!("no instrument is called `{key}`");
                    item.error("unknown-instrument", message, "name an [instrument.NAME]");
                }
            }
        }
    });
}

fn check_paths(root: &Section<'_>, campaign: &Campaign, paths: &[Path]) {
    if paths.iter().all(|p| p.stations.is_empty()) {
        let message = "the campaign has no stations: nothing can be read".to_owned();
        root.error("no-path", message, "[[path]] kind = \"table\", table = \"poses.csv\"");
        return;
    }
    let items = root.get("path").and_then(|i| i.list()).unwrap_or_default();
    for (path, item) in paths.iter().zip(&items) {
        let reads = |kind: fn(Kind) -> bool| {
            path.stations.instruments.iter().any(|i| kind(campaign.instruments[*i as usize].kind))
        };
        if path.feed_mm_per_s.is_some() && reads(Kind::triggers) {
            let message = format!("path `{}`: a touch probe stands still when it reads", path.name);
            item.error("feed-of-hits", message, "leave `feed` out; `dwell` is the time per hit");
        }
        if path.feed_mm_per_s.is_some_and(|f| f <= 0.0) {
            let message = format!("path `{}`: a feed is positive", path.name);
            item.error("bad-feed", message, "such as feed = \"150 mm/min\"");
        }
    }
    for (of, instrument) in campaign.instruments.iter().enumerate() {
        let of = u32::try_from(of).unwrap_or(u32::MAX);
        if !paths.iter().any(|p| p.stations.instruments.contains(&of)) {
            let message = format!("instrument `{}` reads nowhere", instrument.name);
            root.warn("no-stations", message, "name it in a [[path]]: instrument = …");
        }
    }
}

/// A ball on the axis of rotation stays where it is when the axis turns: nothing follows it.
fn warn_of_balls_on_axes(root: &Section<'_>, campaign: &Campaign, paths: &[Path]) {
    let machine = &campaign.machine;
    for (of, instrument) in campaign.instruments.iter().enumerate() {
        let ball =
            matches!(instrument.kind, Kind::ProbeBall | Kind::TouchProbeBall | Kind::BallBar);
        if !ball || instrument.reference == Reference::Bed {
            continue;
        }
        for i in 0..machine.axes().len() {
            if turns(paths, of, i) && distance_mm(machine, instrument, i) < ON_THE_AXIS_MM {
                let axis = machine.axes()[i].name;
                let message = format!(
                    "the ball of `{}` stands on axis {axis}: when {axis} turns no linear axis moves",
                    instrument.name
                );
                let hint = "put it as far from the axis as the linear axes can follow";
                root.warn("ball-on-axis", message, hint);
            }
        }
    }
}

/// Whether a rotary axis that carries the workpiece moves under an instrument.
fn turns(paths: &[Path], instrument: usize, axis: usize) -> bool {
    let mut ends = (f64::INFINITY, f64::NEG_INFINITY);
    for path in paths {
        let rows = path.stations.commands.iter().zip(&path.stations.instruments);
        for (command, _) in rows.filter(|(_, of)| **of as usize == instrument) {
            ends = (ends.0.min(command[axis]), ends.1.max(command[axis]));
        }
    }
    ends.1 - ends.0 > 1e-3
}

/// From the reference point to an axis that carries it; infinite for all others.
fn distance_mm(machine: &Machine, instrument: &Instrument, axis: usize) -> f64 {
    let carries = (0..machine.workpiece_side()).any(|b| machine.bodies()[b].axis == Some(axis));
    if !carries || machine.axes()[axis].kind != AxisKind::Rotary {
        return f64::INFINITY;
    }
    let place = |q: f64| {
        let mut command = Command::default();
        command[axis] = q;
        let poses = machine.body_poses(&command, &ErrorValues::default());
        poses.first().map(|pose| pose.linear() * instrument.reference_point_mm + pose.shift_mm())
    };
    match (place(0.0), place(PI)) {
        (Some(here), Some(there)) => 0.5 * (there - here).norm(),
        _ => f64::INFINITY,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::{read_campaign, virtual_campaign::measure};
    use std::collections::BTreeMap;
    use std::io;
    use std::path::{Path as FilePath, PathBuf};
    use trueaxis_input::{Files, Source};

    struct Memory(BTreeMap<PathBuf, String>);

    impl Source for Memory {
        fn read(&self, path: &FilePath) -> io::Result<Vec<u8>> {
            let text = self.0.get(path).ok_or(io::ErrorKind::NotFound)?;
            Ok(text.clone().into_bytes())
        }

        fn is_file(&self, path: &FilePath) -> bool {
            self.0.contains_key(path)
        }
    }

    const BARE: &str = "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\nsource = \"test\"\n\
        [axis.X]\ntravel = [\"0 mm\", \"4000 mm\"]\n";
    const SCALE: &str = "[scale.X]\nexpansion = \"10 um/(m K)\"\nfixed_point = \"0 mm\"\n\
        table_temperature = \"20 degC\"\nsensors = { scale_x = \"0 mm\" }\n";

    /// The error of the travel from X = 0 to 2000 mm that a laser reads, mm, and the codes.
    fn change(truth: &str, temperature: &str) -> (Option<f64>, Vec<&'static str>) {
        let campaign = format!(
            "name = \"c\"\nmachine = \"m.toml\"\n{temperature}\n[instrument.laser]\n\
             kind = \"laser-line\"\ndirection = \"1 0 0\"\nnoise = \"1 um\"\n[[path]]\n\
             kind = \"table\"\ntable = \"p.csv\"\n[truth]\n{truth}\n[disturb]\nnoise = 0\n"
        );
        let files = [
            ("c.toml", campaign),
            ("m.toml", format!("{BARE}{SCALE}")),
            ("same.toml", format!("{SCALE}{BARE}")),
            ("long.toml", format!("{BARE}{}", SCALE.replace("10 um", "20 um"))),
            ("bare.toml", BARE.to_owned()),
            ("p.csv", "X,Y,Z\n0,0,0\n2000,0,0\n".to_owned()),
        ];
        let files = files.map(|(name, text)| (PathBuf::from(name), text));
        let files = Files::new(Memory(BTreeMap::from(files)));
        let (read, problems) = read_campaign(&files, FilePath::new("c.toml"), |root, campaign| {
            read_virtual(root, campaign, None)
        });
        let codes = problems.iter().map(|d| d.code).collect();
        let change = read.map(|(campaign, real)| {
            let found = measure(&campaign, &real).expect("measured").readings;
            found.values[1][0] - found.values[0][0] - 2000.0
        });
        (change, codes)
    }

    /// 10 µm/(m·K) · 2 m · 5 K = 100 µm, whichever file the true machine stands in.
    #[test]
    fn the_temperatures_of_a_campaign_hold_for_the_machine_of_truth() {
        let warm = "temperature = { scale_x = \"25 degC\" }";
        let of_campaign = change("", warm).0.expect("sound");
        assert!((of_campaign.abs() - 0.1).abs() < 1e-9, "{of_campaign}");
        let cases = [("same.toml", 1.0), ("long.toml", 2.0)];
        for (file, times) in cases {
            let truth = format!("machine = \"{file}\"");
            let (there, codes) = change(&truth, warm);
            let there = there.unwrap_or_else(|| panic!("{file}: {codes:?}"));
            assert!((there - times * of_campaign).abs() < 1e-9, "{file}: {there}");
            let cold = change(&truth, "").0.expect("sound");
            assert!(cold.abs() < 1e-9, "{file}: {cold}");
        }
    }

    #[test]
    fn a_true_machine_without_the_sensor_is_refused() {
        let warm = "temperature = { scale_x = \"25 degC\" }";
        let (change, codes) = change("machine = \"bare.toml\"", warm);
        assert!(change.is_none() && codes.contains(&"truth-machine"), "{codes:?}");
    }
}
