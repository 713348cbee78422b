//! The expansion of a scale from runs at several temperatures.

use std::path::Path;
use trueaxis_input::{Diagnostics, Files, MeasuredValue, Source};
use trueaxis_machine::Machine;
use trueaxis_machine::describe::axis_index;
use trueaxis_machine::file::{NoTables, Tables};
use trueaxis_machine::heat::Conditions;
use trueaxis_thermal::expansion::{
    GeometricTable, LaserKeys, Run, Runs, ScaleKeys, geometric_table, identify_expansion,
    parse_runs, scale_files,
};

fn made(alpha: f64, celsius: &[f64], noise: impl Fn(usize, usize) -> f64) -> Runs {
    let positions_mm: Vec<f64> = (0..=10).map(|i| 230.0 * f64::from(i)).collect();
    let geometry = |p: f64| 0.1 * (p / 700.0).sin() + 8e-5 * p;
    let run = |(j, c): (usize, &f64)| Run {
        name: format!("run {j}"),
        celsius: MeasuredValue { value: *c, u: Some(0.0) },
        errors_mm: positions_mm
            .iter()
            .enumerate()
            .map(|(i, p)| geometry(*p) + alpha * p * (c - 20.0) + 0.002 * j as f64 + noise(i, j))
            .collect(),
    };
    let runs = celsius.iter().enumerate().map(run).collect();
    Runs {
        name: String::new(),
        positions_mm,
        runs,
        scale: ScaleKeys::default(),
        laser: LaserKeys::default(),
    }
}

/// Between −1 and 1 µm, without any pattern.
fn scatter(i: usize, j: usize) -> f64 {
    let seed = (i as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15)
        ^ (j as u64 + 1).wrapping_mul(0xD1B5_4A32_D192_ED03);
    let mixed = (seed ^ (seed >> 29)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    ((mixed >> 32) as f64 / f64::from(u32::MAX) - 0.5) * 2e-3
}

#[test]
fn law_the_coefficient_comes_back_whatever_the_geometry() {
    for celsius in [&[29.3, 33.8][..], &[20.0, 24.0, 31.0, 22.0]] {
        let found = identify_expansion(&made(8.6e-6, celsius, |_, _| 0.0));
        assert!((found.per_k - 8.6e-6).abs() < 1e-16);
        assert!((found.slope_difference_per_k - 8.6e-6).abs() < 1e-16);
        assert!(found.u_per_k < 1e-15 && found.warnings.is_empty());
        assert_eq!(found.materials, ["glass"]);
    }
}

#[test]
fn noise_of_a_micrometre_moves_it_by_less_than_three_u() {
    let noise = scatter;
    let found = identify_expansion(&made(10.8e-6, &[20.0, 25.0, 30.0], noise));
    assert!((found.per_k - 10.8e-6).abs() < 3.0 * found.u_per_k, "{found:?}");
    // s ≈ 1/√3 µm; Σp² = 110·230²; Σt² = 50: s/√(…) ≈ 0.034e-6
    assert!((0.02e-6..0.08e-6).contains(&found.u_per_k), "{found:?}");
    assert_eq!(found.materials, ["steel tape"]);
}

#[test]
fn a_run_of_another_machine_is_named() {
    let noise = |i: usize, j: usize| match j {
        2 => 0.05 * (i as f64).sin(),
        _ => 0.1 * scatter(i, j),
    };
    let found = identify_expansion(&made(8e-6, &[20.0, 22.0, 24.0, 26.0, 28.0], noise));
    assert_eq!(found.warnings.len(), 1, "{:?}", found.warnings);
}

fn table_at(data: &Runs, celsius: f64) -> GeometricTable {
    let mut data = data.clone();
    data.scale.reference_celsius = Some(celsius);
    geometric_table(&data, &identify_expansion(&data)).expect("positions that rise")
}

/// Without noise the table is the geometry and the expansion to its temperature.
#[test]
fn law_a_table_holds_at_its_temperature_whatever_the_order() {
    let data = made(8.6e-6, &[29.3, 33.8], |_, _| 0.0);
    for celsius in [20.0, 29.3, 31.0] {
        let table = table_at(&data, celsius);
        let zero = table.errors_mm[0];
        for (p, e) in table.positions_mm.iter().zip(&table.errors_mm) {
            let geometry = 0.1 * (p / 700.0).sin() + 8e-5 * p;
            let expected = geometry + 8.6e-6 * p * (celsius - 20.0);
            assert!((e - zero - expected).abs() < 1e-14, "{celsius} °C, {p} mm: {e}");
        }
        let mut turned = data.clone();
        turned.positions_mm.reverse();
        turned.runs.iter_mut().for_each(|run| run.errors_mm.reverse());
        turned.runs.reverse();
        let other = table_at(&turned, celsius);
        for (a, b) in table.errors_mm.iter().zip(&other.errors_mm) {
            assert!((a - b).abs() < 1e-14, "{celsius} °C: {a}, reversed {b}");
        }
    }
}

/// The end at which the laser was set to zero is a place, not a row: table and u are the same in every order of the rows.
#[test]
fn law_neither_the_table_nor_its_u_follow_the_order_of_rows() {
    let mut data = made(8.6e-6, &[29.3, 33.8], scatter);
    data.laser.u_mm = Some(5e-4);
    let rows = data.positions_mm.len();
    for zero_mm in [0.0, 2300.0] {
        // The laser was set to zero there in every run.
        let at = if zero_mm == 0.0 { 0 } else { rows - 1 };
        for run in &mut data.runs {
            let read = run.errors_mm[at];
            run.errors_mm.iter_mut().for_each(|e| *e -= read);
        }
        let first = table_at(&data, 20.0);
        // k steps on, 7 rows at a time: 11 rows have no common divisor with 7.
        for k in 0..rows {
            let order: Vec<usize> = (0..rows).map(|i| (k + 7 * i) % rows).collect();
            let mut other = data.clone();
            other.positions_mm = order.iter().map(|i| data.positions_mm[*i]).collect();
            for (run, own) in other.runs.iter_mut().zip(&data.runs) {
                run.errors_mm = order.iter().map(|i| own.errors_mm[*i]).collect();
            }
            assert_eq!(other.zero_mm(), zero_mm, "{order:?}");
            let other = table_at(&other, 20.0);
            let equal = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-13);
            assert!(equal(&first.errors_mm, &other.errors_mm), "{order:?}");
            assert!(equal(&first.u_mm, &other.u_mm), "{order:?}");
        }
    }
}

/// u of a table far from the temperatures of the runs grows as p (T - T_mean) u_alpha.
#[test]
fn a_table_far_from_its_runs_is_less_certain() {
    let mut data = made(8.6e-6, &[29.0, 33.0], |_, _| 0.0);
    for run in &mut data.runs {
        run.celsius.u = Some(0.1);
    }
    data.laser.u_mm = Some(3e-4);
    // Mean of two sensors: u = 0.1/√2 K, 0.0707·8.6e-6·2300 = 1.399 µm; with the laser 1.431 µm.
    let near = table_at(&data, 31.0);
    assert!((near.u_mm[10] - 1.431e-3).abs() < 1e-6, "{}", near.u_mm[10]);
    assert!((near.u_mm[0] - 3e-4).abs() < 1e-12);
    // u_α = 8.6e-6·√(2·(2·0.1)²)/8 = 0.30406e-6; 11 K away 0.30406e-6·11·2300 = 7.693 µm, with 1.431: 7.825.
    let far = table_at(&data, 20.0);
    assert!((far.u_mm[10] - 7.825e-3).abs() < 2e-6, "{}", far.u_mm[10]);
}

/// Numbers as a control computes them, from the text that was written.
#[test]
fn law_the_written_coefficients_are_the_spline() {
    let data = made(8.6e-6, &[29.3, 33.8], scatter);
    let table = table_at(&data, 29.3);
    let csv = table.pieces_csv("Y");
    let rows: Vec<Vec<f64>> = csv
        .lines()
        .filter(|line| line.starts_with(|c: char| c.is_ascii_digit()))
        .map(|line| line.split(',').map(|cell| cell.parse().expect("a number")).collect())
        .collect();
    assert_eq!(rows.len(), 10);
    for row in &rows {
        for part in 0..=4 {
            let h = (row[1] - row[0]) * f64::from(part) / 4.0;
            let um = ((row[2] * h + row[3]) * h + row[4]) * h + row[5];
            assert!((um - 1e3 * table.spline.at(row[0] + h)).abs() < 1e-6, "{row:?} {h}");
        }
    }
    // Not-a-knot: the first two and the last two pieces are one cubic each (Zhang et al. 2019, 1.3).
    assert!((rows[0][2] - rows[1][2]).abs() <= 1e-9 * rows[0][2].abs());
    assert!((rows[8][2] - rows[9][2]).abs() <= 1e-9 * rows[8][2].abs());
}

/// A laser that was given 8.6 µm/(m·K) of the material has subtracted the expansion, and it is added again.
#[test]
fn material_compensation_of_the_laser_is_undone() {
    struct Memory(String);
    impl Source for Memory {
        fn read(&self, _: &Path) -> std::io::Result<Vec<u8>> {
            Ok(self.0.clone().into_bytes())
        }
        fn is_file(&self, _: &Path) -> bool {
            true
        }
    }
    let table = |per_m_k: f64, begin: f64| {
        let row = |p: f64| {
            let reading = |t: f64| (8.6 - per_m_k) * (p - begin) / 1e3 * (t - 20.0);
            format!("{p},{},{}\n", reading(29.3), reading(33.8))
        };
        let rows = (0..11).map(|i| row(begin + 230.0 * f64::from(i)));
        "position_mm,cold_um,warm_um\n".to_owned() + &rows.collect::<String>()
    };
    for (per_m_k, begin) in [(0.0, 0.0), (11.5, 0.0), (8.6, -1150.0), (-3.0, 400.0)] {
        let study = format!(
            "name = \"y\"\ntable = \"t.csv\"\n[laser]\nmaterial_expansion = \"{per_m_k} um/(m K)\"\n\
             [run.cold]\ntemperature = \"29.3 ± 0.1 degC\"\n[run.warm]\ntemperature = \"33.8 ± 0.1 degC\"\n"
        );
        let files = Files::new(Memory(table(per_m_k, begin)));
        let (runs, problems) = parse_runs(&files, Path::new("y.toml"), &study);
        let found = identify_expansion(&runs.unwrap_or_else(|| panic!("{problems:?}")));
        assert!((found.per_k - 8.6e-6).abs() < 1e-15, "{per_m_k}: {}", found.per_k);
    }
}

/// The machine file is judged by the whole chain: what the tool does against the workpiece along the axis at the
/// temperature of each run is what the laser read, for axes of tool and workpiece.
#[test]
fn law_the_machine_file_shows_the_runs() {
    for chain in ["w b X Y Z t", "w X b Y Z t", "w Y X b Z t"] {
        for letter in ["X", "Y", "Z"] {
            for known in [
                "",
                "\n[scale.L]\nexpansion = \"11 um/(m K)\"\nsensors = { l = \"0 mm\" }\ntable_temperature = \"20 degC\"\n",
            ] {
                let known = known.replace('L', letter);
                let old = format!("# mine\n[machine]\nname = \"m\"\nchain = \"{chain}\"\n{known}");
                shows_the_runs(&old, letter);
            }
        }
    }
}

fn shows_the_runs(old: &str, letter: &str) {
    let mut data = made(8.6e-6, &[22.0, 29.3, 33.8], |_, _| 0.0);
    data.scale.axis = Some(letter.to_owned());
    data.scale.reference_celsius = Some(24.0);
    let found = identify_expansion(&data);
    let table = geometric_table(&data, &found).expect("positions that rise");
    let new = scale_files(&data, &found, &table, old, &NoTables).expect(old);
    assert!(new.text.starts_with("# mine\n"), "{}", new.text);
    let tables = Written(new.tables);
    let (machine, problems) = Machine::check("new", &new.text, &tables);
    let machine = machine.unwrap_or_else(|| panic!("{problems:?}"));
    let axis = axis_index(&machine, letter).expect("the axis");
    let sensor = if old.contains("scale") {
        "l".to_owned()
    } else {
        format!("scale_{}", letter.to_lowercase())
    };
    for run in &data.runs {
        let conditions = Conditions::default().with_reading(&sensor, run.celsius.value);
        let warm = machine.at(&conditions, &mut Diagnostics::new()).expect("its sensor is known");
        let read = |p: f64| {
            let mut command = [0.0; 6];
            command[axis] = p;
            let errors = warm.errors_at(&command, &[0.0; 6]).expect("in the table");
            warm.deviation(&command, &errors).tip_mm.dot(&machine.axes()[axis].direction)
        };
        let zero = read(0.0) - run.errors_mm[0];
        for (p, e) in data.positions_mm.iter().zip(&run.errors_mm) {
            assert!((read(*p) - e - zero).abs() < 1e-8, "{old} {letter}: {p} mm, {} {e}", read(*p));
        }
    }
}

struct Written(Vec<(String, String)>);

impl Tables for Written {
    fn text(&self, name: &str) -> Result<String, String> {
        let found = self.0.iter().find(|(n, _)| n == name);
        found.map(|(_, text)| text.clone()).ok_or_else(|| format!("no table `{name}`"))
    }

    fn display(&self, name: &str) -> String {
        name.to_owned()
    }
}

#[test]
fn a_scale_that_does_not_belong_there_is_refused() {
    let data = made(8.6e-6, &[29.3, 33.8], |_, _| 0.0);
    let found = identify_expansion(&data);
    let table = geometric_table(&data, &found).expect("positions that rise");
    let old = "[machine]\nname = \"m\"\nchain = \"w b X Y Z C t\"\n[axis.X]\ntravel = [\"0 mm\", \"1000 mm\"]\n";
    for (letter, words) in [("U", "no axis `U`"), ("C", "no linear axis"), ("X", "another unit")] {
        let mut data = data.clone();
        data.scale.axis = Some(letter.to_owned());
        let refused = scale_files(&data, &found, &table, old, &NoTables).expect_err(letter);
        assert!(refused.contains(words), "{refused}");
    }
}
