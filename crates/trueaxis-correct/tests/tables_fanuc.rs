//! Pitch data of FANUC's rotary axes: one turn, as in B-63980EN/01 p. 100, example 2.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use trueaxis_correct::compensate::tables::content::Content;
use trueaxis_correct::compensate::tables::control::File;
use trueaxis_correct::compensate::tables::emulation::Emulation;
use trueaxis_correct::compensate::tables::{Compiled, Order, TablesError, Target, compile};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Command;
use trueaxis_machine::file::NoTables;

fn machine(travel_of_c: &str, errors: &str) -> Machine {
    let text = format!(
        "[machine]\nname = \"m\"\nchain = \"w C' A' b X Y Z t\"\n[axis.X]\ntravel = [\"-100 mm\", \"100 mm\"]\n\
         [axis.Y]\ntravel = [\"-100 mm\", \"100 mm\"]\n[axis.Z]\ntravel = [\"-100 mm\", \"100 mm\"]\n\
         [axis.C]\ntravel = {travel_of_c}\n[axis.A]\ntravel = [\"-120 deg\", \"30 deg\"]\n\
         [tool]\nlength = \"100 mm\"\n{errors}"
    );
    let (machine, problems) = Machine::check("m.toml", &text, &NoTables);
    machine.unwrap_or_else(|| panic!("{problems:?}"))
}

fn order() -> Order {
    // A coarse grid is enough here.
    Order { bound_mm: 4e-3, bound_rad: 8e-6, ..Order::of(Target::Fanuc) }
}

/// Numbers of a file by axis (0: none).
fn numbers(compiled: &Compiled, name: &str) -> BTreeMap<(i64, i64), f64> {
    let file = compiled.files.iter().find(|f| f.name == name).expect("the file");
    let lines = file.text.lines().map(|line| line.trim_matches('\r'));
    let lines = lines.filter_map(|line| line.strip_prefix('N')?.split_once('P'));
    let number = |(key, value): (&str, &str)| {
        let (number, kind) = key.split_once('Q').expect("Q");
        let axis = kind.strip_prefix("1A").map_or(0, |axis| axis.parse().expect("an axis"));
        ((number.parse().expect("a number"), axis), value.parse().expect("a value"))
    };
    lines.map(number).collect()
}

const ROUND: &str = "[motion.C]\nECC = { fourier = { mean = \"0 urad\", terms = [[1, \"0 urad\", \"60 urad\"]] } }\n\
    [motion.A]\nEAA = { fourier = { mean = \"0 urad\", terms = [[1, \"0 urad\", \"60 urad\"]] }, reversal = \"20 urad\" }";

/// The page: 3621 is 3620, 3622 is 3620 + 3625/3624 where 3624 divides 3625, the first number has the value of the last,
/// and what follows the first has the sum 0, so that nothing is left after a turn.
#[test]
fn the_data_of_a_rotary_axis_are_those_of_a_turn() {
    for travel in ["\"unlimited\"", "[\"-360 deg\", \"360 deg\"]"] {
        let compiled = compile(&machine(travel, ROUND), &order()).expect("tables");
        let (parameters, pitch) =
            (numbers(&compiled, "PARAM.TXT"), numbers(&compiled, "PITCH.TXT"));
        // A and C are the axes 4 and 5.
        for (axis, directions) in [(4, 2), (5, 1)] {
            let get = |n: i64| parameters[&(n, axis)];
            let steps = get(3625) / get(3624);
            assert_eq!((get(3625), steps.fract()), (360.0, 0.0), "{travel} {axis}");
            assert_eq!((get(3621), get(3622)), (get(3620), get(3620) + steps), "{travel} {axis}");
            let firsts = [3620, 3626].map(|n| parameters.get(&(n, axis)).copied());
            assert_eq!(firsts.into_iter().flatten().count(), directions);
            for first in firsts.into_iter().flatten() {
                let grown = (0..=steps as i64).map(|n| pitch[&(10_000 + first as i64 + n, 0)]);
                let grown: Vec<f64> = grown.collect();
                assert_eq!(grown.first(), grown.last(), "{travel} {axis}");
                assert_eq!(grown[1..].iter().sum::<f64>(), 0.0, "{travel} {axis}");
            }
        }
    }
}

/// Wherever the axes stand, read back and applied a turn on: C by 60 µrad·sin C, A the same within its travel.
#[test]
fn what_is_read_back_holds_all_around() {
    let machine = machine("[\"-360 deg\", \"360 deg\"]", ROUND);
    let compiled = compile(&machine, &order()).expect("tables");
    let control = Target::Fanuc.control();
    let content = control.read(&machine, &compiled.files).expect("read");
    let content = Content { grid: None, ..content };
    let emulation = Emulation::new(&machine, control.as_ref(), &content);
    let (c, a) = (0, 1);
    for k in 0..=144 {
        let mut command = Command::default();
        command[c] = TAU * (f64::from(k) / 72.0 - 1.0);
        command[a] = (-120.0 + 150.0 * f64::from(k) / 144.0).to_radians();
        let added = emulation.added(&command, &[1.0; 6]);
        // Both carry the workpiece: a table that stands too far gets a positive value. A rising: half of its 20 µrad more.
        let due = [60e-6 * command[c].sin(), 60e-6 * command[a].sin() + 10e-6];
        for (axis, due) in [(c, due[0]), (a, due[1])] {
            assert!((added[axis] - due).abs() < 8e-6 + 1e-9, "{k} {axis}: {} {due}", added[axis]);
        }
    }
}

/// 100 µrad more after each turn no table of a turn holds: half of it is left in either.
#[test]
fn what_differs_from_turn_to_turn_is_refused_by_name() {
    let errors =
        "[motion.C]\nECC = { polynomial = [\"0 urad\", \"100 urad\"], scale = \"360 deg\" }";
    let refused = compile(&machine("[\"-360 deg\", \"360 deg\"]", errors), &order());
    let Err(TablesError::Turns { axis, loss, .. }) = refused else { panic!("{refused:?}") };
    assert_eq!((axis.to_string().as_str(), loss.as_str()), ("C", "50.00 µrad"));
}

fn example_2(change: &dyn Fn(&str) -> String) -> Result<Content, String> {
    let growth = [1, -2, 1, 3, -1, -1, -3, 2, 1];
    let lines = growth.iter().enumerate().map(|(i, g)| format!("N{}Q0P{g}\n", 10_060 + i));
    let pitch = format!("%\n{}%\n", lines.collect::<String>());
    let parameters = "%\nN01850Q1A5P0\nN03605Q1A5P00000000\nN03620Q1A5P60\nN03621Q1A5P60\nN03622Q1A5P68\n\
                      N03623Q1A5P1\nN03624Q1A5P45.\nN03625Q1A5P360.\n%\n";
    let file = |name: &str, text: &str| File { name: name.to_owned(), text: change(text) };
    let files = [file("PITCH.TXT", &pitch), file("PARAM.TXT", parameters)];
    Target::Fanuc.control().read(&machine("\"unlimited\"", ""), &files).map_err(|e| e.to_string())
}

/// The parameters of example 2: C every 45°, numbers 60 to 68. By hand in units of 0.0001°: the sums from number 61 on,
/// each from half an interval before its place; after a turn as before. What the page forbids is not read.
#[test]
fn example_2_of_the_page_is_read_as_a_turn() {
    let content = example_2(&str::to_owned).expect("read");
    let machine = machine("\"unlimited\"", "");
    let control = Target::Fanuc.control();
    let emulation = Emulation::new(&machine, control.as_ref(), &content);
    let sums = [0.0, -2.0, -1.0, 2.0, 1.0, 0.0, -3.0, -1.0, 0.0];
    for turn in [-360.0, 0.0, 360.0] {
        for (n, sum) in sums.iter().enumerate() {
            for aside in [-22.0, 0.0, 22.0] {
                let mut command = Command::default();
                command[0] = (turn + 45.0 * n as f64 + aside).to_radians();
                let added = emulation.added(&command, &[0.0; 6])[0].to_degrees() * 1e4;
                assert!((added - sum).abs() < 1e-6, "{turn} {n} {aside}: {added} {sum}");
            }
        }
    }
    for (from, to) in [
        ("N10060Q0P1", "N10060Q0P0"),
        ("N10063Q0P3", "N10063Q0P4"),
        ("N03621Q1A5P60", "N03621Q1A5P59"),
        ("N03625Q1A5P360.", "N03625Q1A5P180."),
        ("N03624Q1A5P45.", "N03624Q1A5P40."),
    ] {
        assert!(example_2(&|text| text.replace(from, to)).is_err(), "{to}");
    }
}
