//! What campaigns and comparisons say of unusable input.

use std::fs;
use std::path::PathBuf;
use trueaxis::files::disk;
use trueaxis::input::Diagnostics;
use trueaxis::measure::read_campaign;
use trueaxis::measure::virtual_campaign::{measure, read_virtual};
use trueaxis::verify::compare::{compare, read_comparison};

/// A folder of its own that goes when the test ends.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("trueaxis-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).expect("a folder");
        let folder = Self(path);
        folder.put("machine.toml", MACHINE);
        folder.put("other.toml", &MACHINE.replace("A' b", "B' b"));
        folder.put("poses.csv", "X,Y,Z,A,C\n0,0,0,0,0\n10,20,-30,15,40\n0,5,0,30,-50\n");
        folder
    }

    fn put(&self, name: &str, text: &str) -> PathBuf {
        let path = self.0.join(name);
        fs::write(&path, text).expect("written");
        path
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

const MACHINE: &str = "[machine]\nname = \"m\"\nchain = \"w C' A' b X Y Z t\"\nsource = \"test\"\n\
                       [tool]\nlength = \"100 mm\"\n";
const CAMPAIGN: &str = "name = \"c\"\nmachine = \"machine.toml\"\n[instrument.probe]\n\
                        kind = \"probe-ball\"\nball = \"50 20 30 mm\"\nnoise = \"1 um\"\n";
const PATH: &str = "[[path]]\nkind = \"table\"\ntable = \"poses.csv\"\n";

fn codes(problems: &Diagnostics) -> Vec<&'static str> {
    problems.iter().map(|d| d.code).collect()
}

/// The codes of all diagnostics of a campaign, and whether it can be measured.
fn read(folder: &Folder, text: &str) -> (Vec<&'static str>, bool) {
    let path = folder.put("campaign.toml", text);
    let (read, problems) =
        read_campaign(&disk(), &path, |root, campaign| read_virtual(root, campaign, None));
    assert!(problems.iter().all(|d| d.place.line > 0 || !d.place.file.is_empty()), "{problems:?}");
    assert_eq!(read.is_none(), problems.has_errors(), "{problems:?}");
    let measured = read.is_some_and(|(campaign, real)| measure(&campaign, &real).is_ok());
    (codes(&problems), measured)
}

#[test]
fn every_fault_of_a_campaign_is_told() {
    let folder = Folder::new("virtual-input");
    let sound = format!("{CAMPAIGN}{PATH}");
    assert!(read(&folder, &sound).1, "{:?}", read(&folder, &sound));
    let cases = [
        (CAMPAIGN.to_owned(), "no-path"),
        (format!("{sound}[truth]\nmachine = \"other.toml\""), "other-chain"),
        (format!("{sound}[truth]\nmachine = \"none.toml\""), "truth-machine"),
        (format!("{sound}[truth]\nerrors = {{ EX0Q = \"1 um\" }}"), "unknown-error-name"),
        (format!("{sound}[truth]\nerrors = {{ EX0C = \"nan um\" }}"), "not-finite"),
        (format!("{sound}[truth]\nsetup = {{ bell_x = \"1 um\" }}"), "unknown-key"),
        (format!("{sound}[truth]\nseed = -1"), "bad-count"),
        (format!("{sound}[disturb]\nnoise = nan"), "not-finite"),
        (format!("{sound}[disturb]\nnoise = -1"), "negative"),
        (format!("{sound}[disturb]\nlost = \"120 %\""), "bad-share"),
        (format!("{sound}[disturb]\naxis.Q.lag = \"1 ms\""), "unknown-axis"),
        (format!("{sound}[disturb]\naxis.A.spike = \"1 urad\""), "missing-key"),
        (format!("{sound}[disturb]\ndrift_per_hour = [\"1 um\"]"), "bad-list"),
    ];
    for (text, code) in cases {
        let (found, _) = read(&folder, &text);
        assert!(found.contains(&code), "{code}: {found:?}\n{text}");
    }
}

#[test]
fn a_feed_on_hits_is_an_error() {
    let folder = Folder::new("virtual-hits");
    let hits = CAMPAIGN.replace("probe-ball", "touch-probe-ball") + "length = \"15 mm\"\n";
    let (found, _) = read(&folder, &format!("{hits}{PATH}feed = \"100 mm/min\"\n"));
    assert!(found.contains(&"feed-of-hits"), "{found:?}");
    assert!(read(&folder, &format!("{hits}{PATH}")).1);
}

#[test]
fn what_sees_little_is_a_warning() {
    let folder = Folder::new("virtual-warn");
    let idle = format!(
        "{CAMPAIGN}[instrument.second]\nkind = \"probe-ball\"\nnoise = \"1 um\"\n{PATH}\
         instrument = \"probe\"\n"
    );
    let (found, measured) = read(&folder, &idle);
    assert!(found.contains(&"no-stations") && measured, "{found:?}");
    let centred = CAMPAIGN.replace("50 20 30 mm", "0 0 0 mm");
    let (found, measured) = read(&folder, &format!("{centred}{PATH}"));
    assert!(found.contains(&"ball-on-axis") && measured, "{found:?}");
    assert!(!read(&folder, &format!("{CAMPAIGN}{PATH}")).0.contains(&"ball-on-axis"));
}

#[test]
fn a_log_that_is_too_short_is_told() {
    let folder = Folder::new("virtual-log");
    folder.put("log.csv", "time_s,hall_degC\n0,20\n1,21\n");
    let text = format!("{CAMPAIGN}{PATH}[disturb]\ntemperature_log = \"log.csv\"\n");
    let (found, measured) = read(&folder, &text);
    assert!(!measured, "{found:?}");
}

fn compared(folder: &Folder, text: &str) -> Vec<&'static str> {
    let (task, problems) = read_comparison(&disk(), &folder.put("verify.toml", text));
    assert_eq!(task.is_none(), problems.has_errors());
    codes(&problems)
}

#[test]
fn every_fault_of_a_comparison_is_told() {
    let folder = Folder::new("virtual-verify");
    folder.put("campaign.toml", &format!("{CAMPAIGN}readings = \"r.csv\"\n"));
    folder.put("r.csv", "X,Y,Z,A,C,x_um,y_um,z_um\n0,0,0,0,0,1,2,3\n0,0,0,0,90,1,2,3\n");
    folder.put("short.csv", "X,Y,Z,A,C,x_um,y_um\n0,0,0,0,0,1,2\n");
    folder.put("far.csv", "X,Y,Z,A,C,x_um,y_um,z_um\n99,0,0,0,0,1,2,3\n");
    let head = "name = \"v\"\n[compare]\ncampaign = \"campaign.toml\"\n";
    assert_eq!(compared(&folder, head).iter().filter(|c| **c == "missing-column").count(), 0);
    let (task, _) = read_comparison(&disk(), &folder.put("verify.toml", head));
    assert!(compare(&task.expect("sound")).is_ok());
    let cases = [
        ("name = \"v\"\n".to_owned(), "missing-key"),
        (format!("{head}readings = \"short.csv\""), "missing-column"),
        (format!("{head}readings = \"none.csv\""), "unreadable-file"),
        (format!("{head}with = \"far.csv\""), "no-pairs"),
        (format!("{head}machine = \"other.toml\""), "other-chain"),
        (format!("{head}machine = \"machine.toml\"\nwith = \"r.csv\""), "two-comparisons"),
        (format!("{head}[decision]\nrule = \"simple\""), "missing-key"),
        (format!("{head}[decision]\nrule = \"perhaps\""), "unknown-rule"),
        (format!("{head}[decision]\ntolerance = \"0 um\""), "bad-tolerance"),
        (format!("{head}[decision]\ncoverage_factor = 1e9"), "bad-factor"),
    ];
    for (text, code) in cases {
        let found = compared(&folder, &text);
        assert!(found.contains(&code), "{code}: {found:?}\n{text}");
    }
}

/// Every key of both sections.
const WHOLE: &str = "[truth]\nmachine = \"machine.toml\"\nerrors = { EX0C = \"12 ± 1 um\", ECC = \
    \"3 urad\" }\nsetup = { probe = { ball_x = \"0.3 ± 0.1 mm\", scale = \"5 um/m\" } }\nseed = 3\n\
    draw = true\n[disturb]\nnoise = 1.5\ndrift_per_hour = [\"1 um\", \"0 um\", \"2 um\"]\n\
    resolution = { probe = \"0.1 um\" }\noutliers = { share = \"1 %\", size = 20 }\nlost = \"2 %\"\n\
    [disturb.axis.A]\nrepeatability = \"2 urad\"\nbacklash = \"10 urad\"\nlag = \"20 ms\"\n\
    spike = \"9 urad\"\nspike_time = \"30 ms\"\n[disturb.axis.X]\ngain = 50\n";

#[test]
fn law_a_damaged_campaign_is_measured_or_told_never_both_never_a_panic() {
    let folder = Folder::new("virtual-damage");
    let sound = format!("{CAMPAIGN}{PATH}feed = \"100 mm/min\"\n{WHOLE}");
    let (found, measured) = read(&folder, &sound);
    assert!(measured, "{found:?}");
    let mut state = 5u64;
    let mut draw = |below: usize| {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    let pieces =
        ["nan", "-1", "1e300", "\"", "[[", "inf um", "0", "= {", "µ", "", "100 %", "9999999999"];
    let mut both = [0, 0];
    for _ in 0..1500 {
        let mut text: Vec<char> = sound.chars().collect();
        for _ in 0..=draw(2) {
            let mut at = draw(text.len());
            if draw(3) > 0 {
                // Another digit where there is one: mostly still a campaign.
                let digit = text.iter().skip(at).position(char::is_ascii_digit);
                at += digit.unwrap_or(0);
                text[at] = char::from(b'0' + draw(10) as u8);
                continue;
            }
            let end = (at + draw(6)).min(text.len());
            text.splice(at..end, pieces[draw(pieces.len())].chars());
        }
        let text: String = text.into_iter().collect();
        let path = folder.put("campaign.toml", &text);
        let (read, problems) =
            read_campaign(&disk(), &path, |root, campaign| read_virtual(root, campaign, None));
        assert_eq!(read.is_none(), problems.has_errors(), "{text}");
        let Some((campaign, real)) = read else {
            both[0] += 1;
            continue;
        };
        both[1] += 1;
        if let Ok(found) = measure(&campaign, &real) {
            let values = found.readings.values.iter().flatten();
            assert!(values.chain(&found.readings.times_s).all(|v| v.is_finite()), "{text}");
        }
    }
    assert!(both[0] > 100 && both[1] > 50, "{both:?}");
}

#[test]
fn law_the_shipped_readings_come_from_their_seed() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../examples/07_verify");
    let path = folder.join("probe-ball-campaign.toml");
    let (read, problems) =
        read_campaign(&disk(), &path, |root, campaign| read_virtual(root, campaign, None));
    let (campaign, real) = read.unwrap_or_else(|| panic!("{problems:?}"));
    let measured = measure(&campaign, &real).expect("stations within the tables").readings;
    let shipped = campaign.readings(&mut Diagnostics::new()).expect("beside the campaign");
    assert_eq!(measured.len(), shipped.len());
    for (ours, theirs) in measured.values.iter().zip(&shipped.values) {
        assert!(ours.iter().zip(theirs).all(|(o, t)| (o - t).abs() < 1e-9), "{ours:?} {theirs:?}");
    }
    assert_eq!(measured.approaches, shipped.approaches);
}

/// What the control compensates by active tables is no error of the machine that is measured: readings are those of the machine
/// without it, a note says so, and a warning where just that error is to be found.
#[test]
fn law_readings_are_those_of_the_machine_as_it_runs() {
    let folder = Folder::new("running");
    let stated = |active: &str, value: &str| {
        format!(
            "{MACHINE}[compensation]\nactive = [{active}]\n[motion.X]\n\
             EXX = {{ polynomial = [\"0 um\", \"{value}\"], scale = \"100 mm\" }}\n"
        )
    };
    let measured = |active: &str, value: &str, unknown: &str| {
        folder.put("machine.toml", &stated(active, value));
        let path = folder.put("campaign.toml", &format!("{CAMPAIGN}{unknown}{PATH}"));
        let (read, problems) =
            read_campaign(&disk(), &path, |root, campaign| read_virtual(root, campaign, None));
        let (campaign, real) = read.unwrap_or_else(|| panic!("{problems:?}"));
        (measure(&campaign, &real).expect("readings").readings.values, codes(&problems))
    };
    let unknown = "[unknown.motion]\nEXX = \"polynomial 1\"\n";
    let (on, notes) = measured("\"EXX\"", "-20 um", "");
    let (none, quiet) = measured("", "0 um", "");
    let (off, _) = measured("", "-20 um", "");
    assert_eq!(on, none);
    assert_ne!(on, off);
    let said = |codes: &[&str]| codes.iter().filter(|code| **code == "already-active").count();
    let (_, listed) = measured("\"EXX\"", "-20 um", unknown);
    assert_eq!([said(&notes), said(&quiet), said(&listed)], [1, 0, 2]);
}

/// The machine file that readings are compared with is one as it runs, too, whether the campaign names it or the comparison.
#[test]
fn law_readings_are_compared_with_the_machine_as_it_runs() {
    let folder = Folder::new("compared-running");
    let errors = "[motion.X]\nEXX = { polynomial = [\"0 um\", \"-200 um\"], scale = \"100 mm\" }\n";
    let active = format!("{MACHINE}[compensation]\nactive = [\"EXX\"]\n{errors}");
    folder.put("active.toml", &active);
    folder.put("off.toml", &format!("{MACHINE}{errors}"));
    // What the machine without the error reads.
    let path = folder.put("campaign.toml", &format!("{CAMPAIGN}{PATH}[disturb]\nnoise = 0.0\n"));
    let (read, problems) =
        read_campaign(&disk(), &path, |root, campaign| read_virtual(root, campaign, None));
    let (campaign, real) = read.unwrap_or_else(|| panic!("{problems:?}"));
    let measured = measure(&campaign, &real).expect("readings").readings;
    folder.put("r.csv", "X,Y,Z,A,C,x_um,y_um,z_um\n0,0,0,0,0,1,2,3\n");
    for (machine, agrees) in [("machine.toml", true), ("active.toml", true), ("off.toml", false)] {
        let comparison = format!(
            "name = \"v\"\n[compare]\ncampaign = \"campaign.toml\"\nreadings = \"r.csv\"\nmachine = \"{machine}\"\n"
        );
        let path = folder.put("verify.toml", &comparison);
        let (task, problems) = read_comparison(&disk(), &path);
        let mut task = task.unwrap_or_else(|| panic!("{problems:?}"));
        task.measured = measured.clone();
        let found = compare(&task).expect("a fit");
        let largest = found.deviations.iter().map(|d| d.value.abs()).fold(0.0, f64::max);
        assert_eq!(largest < 1e-6, agrees, "{machine}: {largest} mm");
        assert_eq!(codes(&problems).contains(&"already-active"), machine == "active.toml");
    }
}
