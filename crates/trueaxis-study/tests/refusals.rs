//! What a study refuses, with the place of it.

mod common;

use common::read;
use trueaxis::input::Severity;

const STUDY: &str = "name = \"x\"\nstudy = \"ROOT/examples/03_predict/nas979-on-xkas2525.toml\"\n";
const HOLES: &str = "name = \"x\"\nstudy = \"ROOT/examples/03_predict/torque-arm.toml\"\n";
const DESIGN: &str = "[design]\nmachines = 10\n";
const INPUT: &str = "[[input]]\nerror = \"EC0Y\"\nvalue = \"0 ± 20 urad\"\n";

/// The codes of the errors, each once.
fn codes(name: &str, text: &str) -> Vec<&'static str> {
    let (study, problems) = read(name, text);
    let errors = problems.iter().filter(|d| d.severity == Severity::Error);
    let mut codes: Vec<&'static str> = errors.map(|d| d.code).collect();
    codes.dedup();
    assert_eq!(study.is_none(), !codes.is_empty());
    codes
}

#[test]
fn each_mistake_has_its_code() {
    let input = |text: &str| format!("{STUDY}{DESIGN}[[input]]\n{text}\n");
    let cases = [
        ("sound", format!("{STUDY}{DESIGN}{INPUT}"), ""),
        ("no input", format!("{STUDY}{DESIGN}"), "no-input"),
        ("no design", format!("{STUDY}{INPUT}"), "missing-key"),
        ("no machines", format!("{STUDY}[design]\nkind = \"sobol\"\n{INPUT}"), "missing-key"),
        ("none", format!("{STUDY}[design]\nmachines = 0\n{INPUT}"), "bad-count"),
        ("too many", format!("{STUDY}[design]\nmachines = 90000000\n{INPUT}"), "bad-design"),
        (
            "kind",
            format!("{STUDY}[design]\nkind = \"halton\"\nmachines = 10\n{INPUT}"),
            "unknown-word",
        ),
        ("no study", format!("name = \"x\"\n{DESIGN}{INPUT}"), "one-study"),
        ("two studies", format!("{STUDY}{DESIGN}{INPUT}[case]\na = \"b.toml\"\n"), "one-study"),
        (
            "no file",
            format!("name = \"x\"\nstudy = \"none.toml\"\n{DESIGN}{INPUT}"),
            "unreadable-file",
        ),
        ("nothing varied", input("value = \"0 ± 1 um\""), "one-input"),
        (
            "two things",
            input("error = \"EC0Y\"\nlog = \"x.csv\"\nvalue = \"0 ± 1 urad\""),
            "one-input",
        ),
        (
            "two ways",
            input("error = \"EC0Y\"\nvalue = \"0 ± 1 urad\"\nscale = \"1 ± 0.1\""),
            "one-input",
        ),
        ("no error", input("error = \"QQQ\"\nvalue = \"0 ± 1 um\""), "unknown-error-name"),
        ("wrong unit", input("error = \"EC0Y\"\nvalue = \"0 ± 1 um\""), "wrong-unit"),
        ("no unit", input("error = \"EC0Y\"\nvalue = 0.001"), "missing-unit"),
        ("no spread", input("error = \"EC0Y\"\nvalue = \"20 urad\""), "no-uncertainty"),
        ("impossible", input("error = \"EC0Y\"\nvalue = \"0 ± 2 rad\""), "impossible-value"),
        ("motion", input("error = \"EYX\"\nvalue = \"0 ± 1 um\""), "not-a-location"),
        ("location", input("error = \"EC0Y\"\ncurve = { u = \"1 urad\" }"), "no-curve"),
        ("mixed", input("error = [\"EYX\", \"EAX\"]\ncurve = { u = \"1 um\" }"), "no-common-unit"),
        ("not positive", input("error = \"EYX\"\ncurve = { u = \"0 um\" }"), "not-positive"),
        ("twice", input("error = [\"EYX\", \"EYX\"]\nscale = \"1 ± 0.1\""), "duplicate-input"),
        ("no such body", input("error = \"EA0B\"\nvalue = \"0 ± 1 urad\""), "no-such-error"),
        (
            "limits",
            input("error = \"EC0Y\"\nvalue = { uniform = [\"5 urad\", \"-5 urad\"] }"),
            "bad-range",
        ),
        ("one limit", input("error = \"EC0Y\"\nvalue = { uniform = [\"5 urad\"] }"), "bad-count"),
        (
            "two of them",
            input("error = \"EC0Y\"\nvalue = { normal = \"0 ± 5 urad\", uniform = [] }"),
            "one-distribution",
        ),
        ("cauchy", input("error = \"EC0Y\"\nvalue = { cauchy = \"0 urad\" }"), "unknown-word"),
        (
            "level",
            input("error = \"EC0Y\"\nvalue = \"0 ± 5 urad\"\nper = \"hour\""),
            "unknown-word",
        ),
        (
            "unknown key",
            input("error = \"EC0Y\"\nvalue = \"0 ± 5 urad\"\nvlaue = 3"),
            "unknown-key",
        ),
        ("same name", format!("{STUDY}{DESIGN}{INPUT}{INPUT}"), "duplicate-input"),
        (
            "not there",
            format!("{STUDY}outputs = [\"roundnes_mm\"]\n{DESIGN}{INPUT}"),
            "unknown-output",
        ),
        ("share", format!("{STUDY}{DESIGN}{INPUT}[requirement]\nmachines = 95\n"), "bad-range"),
        ("factorial", format!("{STUDY}[design]\nkind = \"factorial\"\n{INPUT}"), "bad-design"),
        ("rows", format!("{STUDY}[design]\nmachines = 10\nsensitivity = 3\n{INPUT}"), "bad-count"),
        (
            "no such axis",
            format!("{STUDY}{DESIGN}[[input]]\nsetting = \"X\"\nvalue = \"0 ± 1 deg\"\n"),
            "cannot-vary",
        ),
        (
            "holes",
            format!("{HOLES}{DESIGN}[[input]]\nsetting = \"C\"\nvalue = \"0 ± 1 deg\"\n"),
            "cannot-vary",
        ),
    ];
    let wrong = |(name, text, code): (&str, String, &str)| {
        let found = codes("refused", &text).join(" ");
        (found != code).then(|| format!("{name}: {found} instead of {code}"))
    };
    let wrong: Vec<String> = cases.into_iter().filter_map(wrong).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn correlations_are_checked() {
    let inputs = "[[input]]\nerror = \"EC0Y\"\nvalue = \"0 ± 20 urad\"\n[[input]]\nerror = \"EA0A\"\nvalue = \"0 ± 20 urad\"\n\
                  [[input]]\nerror = \"EB0A\"\nvalue = \"0 ± 20 urad\"\nper = \"day\"\n";
    let pair = |a: &str, b: &str, r: &str| {
        format!("[[correlation]]\nof = [\"{a}\", \"{b}\"]\ncoefficient = {r}\n")
    };
    let with = |days: usize, rest: &str| {
        codes(
            "correlated",
            &format!("{STUDY}[design]\nmachines = 10\ndays = {days}\n{inputs}{rest}"),
        )
    };
    assert!(with(1, &pair("EC0Y", "EA0A", "0.9")).is_empty());
    let three =
        pair("EC0Y", "EA0A", "0.9") + &pair("EA0A", "EB0A", "0.9") + &pair("EC0Y", "EB0A", "-0.9");
    assert_eq!(with(1, &three), ["not-positive-definite"]);
    assert_eq!(with(1, &pair("EC0Y", "EA0C", "0.9")), ["unknown-input"]);
    assert_eq!(with(1, &pair("EC0Y", "EC0Y", "0.9")), ["bad-range"]);
    assert_eq!(with(1, &pair("EC0Y", "EA0A", "1")), ["bad-range"]);
    // Of a machine and of a day: they have no common number.
    assert_eq!(with(2, &pair("EC0Y", "EB0A", "0.5")), ["contradiction"]);
}

/// A sample that cannot be made is named, and stops the study.
#[test]
fn a_sample_out_of_the_travel_is_named() {
    let text = format!(
        "{STUDY}{DESIGN}[[input]]\nworkpiece = \"X\"\nvalue = {{ uniform = [\"0 mm\", \"9000 mm\"] }}\n"
    );
    let (study, _) = read("out-of-travel", &text);
    let fault = study.unwrap().evaluate(0..10, &|_| {}).unwrap_err();
    assert!(fault.message.starts_with("machine "), "{}", fault.message);
    assert!(fault.message.contains("workpiece X = "), "{}", fault.message);
}

/// Sensors are checked before anything is drawn.
#[test]
fn temperatures_are_those_of_sensors_of_the_machine() {
    let input =
        |sensor: &str| format!("[[input]]\ntemperature = \"{sensor}\"\nvalue = \"22 ± 1 degC\"\n");
    assert_eq!(
        codes("sensor", &format!("{STUDY}{DESIGN}{}", input("scale_x"))),
        ["unknown-sensor"]
    );
    // The arm grows: its temperature is varied, too.
    let scales = ["scale_x", "scale_y", "scale_z"].map(input).concat();
    assert_eq!(codes("growth", &format!("{HOLES}{DESIGN}{scales}")), ["no-workpiece-temperature"]);
    let all = scales + &input("workpiece");
    assert!(codes("all", &format!("{HOLES}{DESIGN}{all}")).is_empty());
}

/// Of a single part there is no spread, and of machines that are all alike no uncertainty of their share.
#[test]
fn one_part_has_no_uncertainty() {
    let (study, _) = read("single", &format!("{STUDY}[design]\nmachines = 1\n{INPUT}"));
    let study = study.unwrap();
    let found = study.findings(&study.evaluate(0..1, &|_| {}).unwrap());
    assert_eq!(found.combinations[0].outputs[0].spread.u_mm, None);
    let good = found.combinations[0].good.unwrap();
    assert_eq!((good.parts_ratio, good.u_parts_ratio), (1.0, None));
    assert!((good.interval_ratio[0] - 0.025).abs() < 1e-9);
}
