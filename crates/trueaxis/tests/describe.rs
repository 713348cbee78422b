//! A machine as data, and one error put into its file: against the shipped machines.

mod library;

use library::{MACHINES, machine, machine_path};
use proptest::prelude::*;
use serde_json::Value;
use std::path::Path;
use std::sync::OnceLock;
use trueaxis::describe::{MOST_SAMPLES, describe, set_error};
use trueaxis::files;
use trueaxis::input::{Dimension, parse_measured};
use trueaxis::machine::Machine;
use trueaxis::machine::axis::AxisKind;
use trueaxis::machine::errors::{Curve, ErrorIndex, ErrorKind, ErrorValues};
use trueaxis::machine::file::Folder;
use trueaxis::report::{check_json, description_json, frames};

fn text_of(name: &str) -> String {
    std::fs::read_to_string(machine_path(name)).expect("a shipped machine file")
}

fn described(name: &str) -> Value {
    description_json(&describe(&machine(name), Some(&text_of(name))))
}

fn entry<'v>(list: &'v Value, name: &str) -> &'v Value {
    let all = list.as_array().expect("a list");
    all.iter().find(|e| e["name"] == name).unwrap_or_else(|| panic!("no {name}"))
}

/// The numbers of the file by hand.
#[test]
fn the_fork_head_gantry_is_described_as_its_file_says() {
    let page = described("xkas2525");
    let names: Vec<&str> =
        page["links"].as_array().unwrap().iter().map(|l| l["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["w", "X", "Y", "Z", "C", "A", "t"]);
    let parents: Vec<Option<u64>> =
        page["links"].as_array().unwrap().iter().map(|l| l["parent"].as_u64()).collect();
    assert_eq!(parents, [None, None, Some(1), Some(2), Some(3), Some(4), Some(5)]);
    let x = entry(&page["links"], "X");
    assert_eq!((&x["kind"], &x["carries"]), (&"linear".into(), &"tool".into()));
    assert_eq!(x["travel"], serde_json::json!([0.0, 6200.0]));
    assert_eq!(x["max_velocity_mm_per_s"], 250.0); // 15 m/min
    assert_eq!(x["max_jerk_mm_per_s3"], 10_000.0);
    let place = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1500.0, 300.0];
    assert_eq!(x["placement"], serde_json::json!(place));
    let a = entry(&page["links"], "A");
    assert_eq!(a["travel"], serde_json::json!([-105.0, 105.0]));
    assert_eq!(a["max_velocity_deg_per_s"], 60.0); // 10 rpm
    assert_eq!(a["direction"], serde_json::json!([1.0, 0.0, 0.0]));

    let errors = page["errors"].as_array().unwrap();
    assert_eq!(errors.len(), 72); // 7 bodies with 6 location errors, 5 axes with 6 error motions
    assert!(errors.iter().all(|e| e["stated"] == true));
    let square = entry(&page["errors"], "EC0Y");
    assert_eq!((&square["value"], &square["u"]), (&(-24.0).into(), &1.0.into()));
    assert_eq!((&square["unit"], &square["text"]), (&"urad".into(), &"-24 ± 1 urad".into()));
    let line = square["line"].as_u64().unwrap() as usize;
    assert!(text_of("xkas2525").lines().nth(line - 1).unwrap().starts_with("EC0Y = "));
    let exx = entry(&page["errors"], "EXX");
    assert_eq!((&exx["shape"], &exx["table"]), (&"table".into(), &"X.csv".into()));
    assert_eq!((&exx["value"], &exx["u"]), (&Value::Null, &0.5.into()));
    assert_eq!(exx["curve"]["at"].as_array().unwrap().len(), MOST_SAMPLES);
    assert_eq!((&exx["curve"]["at"][0], &exx["curve"]["at"][100]), (&0.0.into(), &6200.0.into()));
    // The first and the last row of the table.
    let table = std::fs::read_to_string(machine_path("xkas2525").with_file_name("X.csv")).unwrap();
    let rows: Vec<Vec<&str>> = table.lines().map(|l| l.split(',').collect()).collect();
    let head = rows.iter().position(|r| r[0] == "position_mm").unwrap();
    let column = rows[head].iter().position(|c| *c == "EXX_um").unwrap();
    for (row, sample) in [(&rows[head + 1], 0), (&rows[rows.len() - 1], 100)] {
        let value = exx["curve"]["values"][sample].as_f64().unwrap();
        assert!((value - row[column].parse::<f64>().unwrap()).abs() < 1e-9);
    }
    assert_eq!(page["tool"]["length_mm"], 100.0);
    assert_eq!(page["tools"][0]["name"], "endmill-20");
    assert_eq!(page["models"][0]["shape"]["box"], serde_json::json!([6600.0, 2600.0, 400.0]));
    assert_eq!(page["models"][0]["body"], Value::Null);
}

#[test]
fn sensors_say_what_they_drive() {
    let page = described("gantry-001");
    let sensor = |name| &entry(&page["sensors"], name)["drives"];
    assert_eq!(*sensor("scale_x"), serde_json::json!(["scale of X"]));
    assert_eq!(*sensor("workpiece"), serde_json::json!(["workpiece"]));
    let exx = entry(&page["errors"], "EXX");
    assert_eq!(exx["measured"]["temperature_celsius"], 28.4);
}

/// The links and their parents carry the bodies where the machine has them, with all axes at zero.
#[test]
fn law_links_make_the_chain() {
    for name in MACHINES {
        let machine = machine(name);
        let description = describe(&machine, None);
        let due = machine.body_poses(&Default::default(), &ErrorValues::default());
        for (i, due) in due.iter().enumerate() {
            let mut pose = description.links[i].parent_from_link;
            let mut at = description.links[i].parent;
            while let Some(parent) = at {
                pose = description.links[parent].parent_from_link * pose;
                at = description.links[parent].parent;
            }
            assert!((pose.linear() - due.linear()).norm() < 1e-12, "{name}");
            assert!((pose.shift_mm() - due.shift_mm()).norm() < 1e-9, "{name}");
        }
        for error in description.errors.iter().filter(|e| e.curve.is_some()) {
            let (curve, stated) = (error.curve.as_ref().unwrap(), error.stated.unwrap());
            assert!(!curve.at.is_empty() && curve.at.len() <= MOST_SAMPLES);
            for (at, value) in curve.at.iter().zip(&curve.values) {
                assert_eq!(stated.at(*at, 0.0).ok(), Some(*value), "{name} {}", error.name);
            }
        }
    }
}

/// A shipped machine and its text, as three people save it.
struct Shipped {
    folder: Folder,
    machine: Machine,
    texts: [String; 3],
}

fn shipped() -> &'static [Shipped] {
    static ALL: OnceLock<Vec<Shipped>> = OnceLock::new();
    ALL.get_or_init(|| {
        let one = |name: &&str| {
            let text = text_of(name);
            let mut entries = text.lines().map(|line| match line.contains("urad\"") {
                true => format!("{line}  # \"mine\" = [{{ 'ä'\n"),
                false => format!("{line}\n"),
            });
            let commented: String = entries.by_ref().collect();
            let windows = commented.replace('\n', "\r\n");
            let open = text.trim_end().to_owned();
            let folder = Folder::of(&files::disk(), &machine_path(name));
            Shipped { folder, machine: machine(name), texts: [commented, windows, open] }
        };
        MACHINES.iter().map(one).collect()
    })
}

fn read(text: &str, folder: &Folder) -> Machine {
    let (machine, problems) = Machine::check("machine.toml", text, folder);
    machine.unwrap_or_else(|| panic!("{problems:?}"))
}

fn without(machine: &Machine, index: ErrorIndex) -> Machine {
    machine.clone().with_error(index, None)
}

proptest! {
    /// Only the one error changes, only its characters change, and back is back.
    #[test]
    fn law_one_error_is_set_and_set_back(
        which in 0..8_usize,
        form in 0..3_usize,
        error in 0..1000_usize,
        number in -99.0..99.0_f64,
        u in 0.0..9.0_f64,
        shape in 0..4_usize,
    ) {
        let Shipped { folder, machine, texts } = &shipped()[which];
        let old = &texts[form];
        let description = describe(machine, Some(old));
        let error = &description.errors[error % description.errors.len()];
        let name = error.name.to_string();
        let unit = error.unit().0;
        let axis = description.links[error.index.body].axis.filter(|_| error.index.kind == ErrorKind::Motion);
        let quantity = format!("{number} ± {u} {unit}");
        let value = match (shape, axis) {
            (1, Some(_)) => format!("{{ constant = \"{number} {unit}\", u = \"{u} {unit}\" }}"),
            (2, Some(a)) if a.kind == AxisKind::Rotary => {
                format!("{{ fourier = {{ mean = \"{number} {unit}\", terms = [[1, \"0 {unit}\", \"0 {unit}\"]] }} }}")
            }
            (2, Some(_)) => format!("{{ polynomial = [\"{number} {unit}\"], scale = '1 m' }} "),
            _ => quantity.clone(),
        };
        let set = |text: &str, value: &str| set_error(text, "machine.toml", folder, &name, value);
        if let Some(table) = &error.table {
            let problems = set(old, &value).expect_err("it stands in a table");
            let found = problems.iter().next().expect("a problem");
            prop_assert_eq!(found.code, "error-in-table");
            prop_assert!(found.message.contains(table.as_str()));
            return Ok(());
        }
        let new = set(old, &value).unwrap_or_else(|p| panic!("{name} = {value}: {p:?}"));
        // Read back: this value, and every other number as before.
        let now = read(&new, folder);
        prop_assert!(without(&now, error.index) == without(machine, error.index));
        let stated = now.bodies()[error.index.body].stated(error.index.kind, error.index.component);
        let dimension = if unit == "um" { Dimension::Length } else { Dimension::Angle };
        let due = parse_measured(&quantity, dimension).expect("a quantity").value;
        prop_assert_eq!(stated.and_then(|s| s.at(0.0, 0.0).ok()), Some(due));
        prop_assert_eq!(matches!(stated.map(|s| &s.mean), Some(Curve::Constant(_))), axis.is_none() || shape != 2);
        // Everything before and after the value is unchanged.
        let written = match value.starts_with('{') {
            true => value.trim().to_owned(),
            false => format!("\"{value}\""),
        };
        let at = new.find(&format!("{name} = {written}")).expect("the entry") + name.len() + 3;
        prop_assert!(old.starts_with(&new[..at - name.len() - 3]) || error.text.is_none());
        prop_assert!(old.ends_with(&new[at + written.len()..]) || error.text.is_none());
        prop_assert_eq!(new.matches('#').count(), old.matches('#').count());
        prop_assert_eq!(new.matches('\n').count() == new.matches("\r\n").count(), form == 1);
        // And back.
        let back = set(&new, error.text.as_deref().unwrap_or("")).expect("it was so before");
        prop_assert_eq!(&back, old);
    }

    /// Whatever a user types is refused with a reason, or is one value of that error alone.
    #[test]
    fn law_no_value_changes_anything_else(
        value in "(\"|'|\\{ ?)?[-0-9 ±+a-z\"'{}=,#\\[\\]\\\\\n\r\u{0}]{0,30}(\"|'|\\})?",
        name in prop::sample::select(vec!["EC0Y", "EXX", "EX0t", "EQ1", "E\nX"]),
    ) {
        let Shipped { folder, machine, texts } = &shipped()[6]; // a plain machine with three axes
        match set_error(&texts[0], "machine.toml", folder, name, &value) {
            Err(problems) => prop_assert!(problems.has_errors()),
            Ok(new) => {
                let now = read(&new, folder);
                let index = now.stated_errors().into_iter().find(|(_, n)| n.to_string() == name);
                let index = index.map_or_else(|| {
                    let name = trueaxis::machine::errors::ErrorName::parse(name);
                    machine.error_index(name.expect("a name")).expect("a body")
                }, |(index, _)| index);
                prop_assert!(without(&now, index) == without(machine, index));
                prop_assert!(new.lines().count().abs_diff(texts[0].lines().count()) <= 3);
            }
        }
    }

    /// Any bytes as a machine file: an answer, never a panic.
    #[test]
    fn law_any_text_is_answered(text in "[\\[\\]{}=\"'#a-zE0-9 .\n\r]{0,200}", value in ".{0,20}") {
        let _ = set_error(&text, "m.toml", &Folder::of(&files::disk(), Path::new("nowhere/m.toml")), "EC0Y", &value);
        let machine = &shipped()[6].machine;
        let page = description_json(&describe(machine, Some(&text)));
        prop_assert_eq!(page["links"].as_array().map(Vec::len), Some(machine.bodies().len()));
    }
}

#[test]
fn a_machine_file_below_the_project_folder_is_edited_in_place() {
    let root = std::env::temp_dir().join(format!("trueaxis-describe-{}", std::process::id()));
    std::fs::create_dir_all(&root).unwrap();
    let path = root.join("machine.toml");
    files::within(&root, || {
        files::write(&path, text_of("three-axis-mill").as_bytes()).unwrap();
        let old = String::from_utf8(files::read_bytes(&path).unwrap()).unwrap();
        let folder = Folder::of(&files::disk(), &path);
        let new = set_error(&old, "machine.toml", &folder, "EC0Y", "7 urad").unwrap();
        files::write(&path, new.as_bytes()).unwrap();
    });
    let (machine, _) = files::machine(&path);
    let page = description_json(&describe(&machine.unwrap(), None));
    assert_eq!(entry(&page["errors"], "EC0Y")["value"], 7.0);
    std::fs::remove_dir_all(root).unwrap();
}

/// Jiang et al. Table 6: the frames of all nodes of the WYXZCAT gantry are parallel to that of simulation space.
/// The origins by hand: sums of the placements of the machine file.
#[test]
fn frames_of_the_nodes_are_those_of_the_machine_file() {
    let gantry = machine("wyxzcat-gantry");
    let found = frames(&gantry);
    let parallel = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    for frame in found.iter().filter(|f| f.frame != "UCS") {
        assert_eq!([frame.x, frame.y, frame.z], parallel, "{} {}", frame.frame, frame.body);
    }
    let origin = |frame: &str, body: &str| {
        found.iter().find(|f| f.frame == frame && f.body == body).map(|f| f.origin_mm).unwrap()
    };
    assert_eq!(origin("SCS", "b"), [0.0; 3]);
    assert_eq!(origin("PCS", "w"), [0.0; 3]);
    assert_eq!(origin("NCS", "Z"), [0.0, 100.0, 700.0]); // 500 + 200
    assert_eq!(origin("NCS", "t"), [30.0, 120.0, 430.0]); // 700 − 100 − 50 − 120
    let arm = found.iter().find(|f| f.model.as_deref() == Some("left fork arm")).unwrap();
    assert_eq!((arm.frame, arm.body.as_str()), ("UCS", "C"));
    assert_eq!(arm.origin_mm, [30.0 - 105.0, 120.0, 600.0 - 40.0]);
    assert_eq!(found.len(), 2 + gantry.bodies().len() + gantry.models().len());
    let json = check_json(Some(&gantry), []);
    assert_eq!(json["frames"].as_array().unwrap().len(), found.len());
    assert_eq!(json["frames"][5]["origin_mm"], serde_json::json!([0.0, 100.0, 700.0]));
}

/// Placements that turn a body turn its frame and those of its models.
#[test]
fn frames_of_models_turn_with_their_bodies() {
    let text = "[machine]\nname = \"m\"\nchain = \"w b X Z B t\"\n[axis.Z]\nplacement = \"0 0 10 mm\"\n\
                [axis.B]\nplacement = [\"shift 5 0 0 mm\", \"turn Y 90 deg\"]\n\
                [[model]]\nbody = \"B\"\nname = \"one\"\nbox = \"1 1 1 mm\"\nplacement = \"0 0 7 mm\"\n\
                [[model]]\nbody = \"B\"\nname = \"two\"\nbox = \"1 1 1 mm\"\n\
                placement = [\"turn Z 90 deg\"]\n";
    let (machine, problems) = Machine::check("m.toml", text, &trueaxis::machine::file::NoTables);
    let machine = machine.unwrap_or_else(|| panic!("{problems:?}"));
    let found = frames(&machine);
    let model = |name: &str| found.iter().find(|f| f.model.as_deref() == Some(name)).unwrap();
    let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
    // About Y by 90°: z goes to x, x to −z. The model 7 mm along the z axis of B lies 7 mm along X.
    assert!(near(model("one").origin_mm, [12.0, 0.0, 10.0]), "{:?}", model("one"));
    assert!(near(model("one").z, [1.0, 0.0, 0.0]));
    assert!(near(model("two").x, [0.0, 1.0, 0.0]));
    assert!(near(model("two").y, [0.0, 0.0, 1.0]));
}

/// Forms of models that are not read are named, whatever the case of the ending.
#[test]
fn models_of_other_forms_are_named() {
    for (file, form) in
        [("a.igs", "IGES"), ("b.IGES", "IGES"), ("c.Stp", "STEP"), ("d.e.obj", "OBJ")]
    {
        let text = format!(
            "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n[[model]]\nbody = \"Z\"\nname = \"n\"\nstl = \"{file}\"\n"
        );
        let (machine, problems) =
            Machine::check("m.toml", &text, &trueaxis::machine::file::NoTables);
        assert!(machine.is_none());
        let said = problems.iter().find(|d| d.code == "model-form").expect(file);
        assert!(said.message.starts_with(form), "{}", said.message);
        assert_eq!(said.place.line, 7);
    }
}
