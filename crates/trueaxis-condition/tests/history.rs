//! The uncertainty of a trend from the scatter of the points about it.

use trueaxis_condition::history::{
    Calibration, DAYS_PER_YEAR, Limits, Point, Trend, history, read_machine,
};
use trueaxis_input::{Date, Diagnostics};
use trueaxis_machine::Machine;
use trueaxis_machine::file::NoTables;

/// The trend of three calibrations, 365 days apart, without a stated uncertainty.
fn trend(values: [f64; 3]) -> Trend {
    let calibrations: Vec<Calibration> = ["2021-01-01", "2022-01-01", "2023-01-01"]
        .into_iter()
        .zip(values)
        .map(|(day, value)| {
            let date = Date::parse(day).expect("a day");
            let point = Point { date, value, u: None, file: day.to_owned() };
            Calibration {
                file: day.to_owned(),
                machine: "m".to_owned(),
                chain: None,
                figures: vec![("EC0Y".to_owned(), "urad".to_owned(), point)],
                tables_celsius: Vec::new(),
            }
        })
        .collect();
    let mut problems = Diagnostics::new();
    let found = history(&calibrations, &Limits::new(), &mut problems);
    let found = found.unwrap_or_else(|| panic!("{:?}", problems.sorted()));
    found.series[0].trend.expect("a trend")
}

/// 0, 3, 0: the line is level at 1, the rests are −1, 2, −1, s² = 6/(3 − 2), and u = s/√(2 · (365/365.25)²) =
/// √3 · 365.25/365 a year. Ten times the values have ten times the slope and ten times the u.
#[test]
fn law_the_uncertainty_of_a_slope_is_by_hand_and_in_the_unit_of_the_values() {
    let found = trend([0.0, 3.0, 0.0]);
    let by_hand = 3_f64.sqrt() * DAYS_PER_YEAR / 365.0;
    assert!(found.per_year.abs() < 1e-12 && (found.uncertainty.u - by_hand).abs() < 1e-12);
    assert_eq!(found.uncertainty.degrees_of_freedom, Some(1.0));
    let (one, ten) = (trend([1.0, 5.0, 4.0]), trend([10.0, 50.0, 40.0]));
    assert!((ten.per_year - 10.0 * one.per_year).abs() < 1e-12 * ten.per_year);
    assert!((ten.uncertainty.u - 10.0 * one.uncertainty.u).abs() < 1e-12 * ten.uncertainty.u);
}

/// The range of EXX grows with the temperature of its table: 10 µm/(m K) · 0.5 m · 6.4 K = 32 µm are no wear.
#[test]
fn tables_at_several_temperatures_are_named() {
    let read = |[cold, warm]: [f64; 2], scale: &str| {
        let calibration = |(year, celsius): (u16, f64)| {
            let text = format!(
                "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n{scale}[motion.X]\n\
                 measured = {{ date = {year}-03-14, temperature = \"{celsius} degC\" }}\n\
                 EXX = {{ polynomial = [\"0 um\", \"9 um\"], scale = \"100 mm\" }}\n\
                 EYX = {{ polynomial = [\"0 um\", \"1 um\"], scale = \"100 mm\" }}\n"
            );
            let machine = Machine::check("m.toml", &text, &NoTables).0.expect("a machine");
            let file = format!("{year}.toml");
            read_machine(&file, &machine, &mut Diagnostics::new()).expect("figures")
        };
        let calibrations = [(2024, cold), (2025, warm)].map(calibration);
        let mut problems = Diagnostics::new();
        history(&calibrations, &Limits::new(), &mut problems).expect("a history");
        let named = problems.iter().filter(|d| d.code == "two-temperatures");
        named.map(|d| d.message.clone()).collect::<Vec<_>>()
    };
    let scale = "[scale.X]\nexpansion = \"10 um/(m K)\"\nfixed_point = \"0 mm\"\nsensors = { x = \"0 mm\" }\n";
    for scale in ["", scale] {
        assert!(read([22.0, 22.0], scale).is_empty());
        for celsius in [[22.0, 28.4], [28.4, 22.0]] {
            let named = read(celsius, scale);
            assert_eq!(named.len(), 1, "{named:?}");
            assert!(
                named[0].contains("EXX")
                    && named[0].contains("22 °C")
                    && named[0].contains("28.4 °C")
            );
        }
    }
}

/// Three calibrations, a year apart, of one machine file with its year put in.
fn three(text: impl Fn(u16) -> String) -> trueaxis_condition::history::History {
    let calibrations = [2024, 2025, 2026].map(|year| {
        let machine = Machine::check("m.toml", &text(year), &NoTables).0.expect("a machine");
        read_machine(&format!("{year}.toml"), &machine, &mut Diagnostics::new()).expect("figures")
    });
    history(&calibrations, &Limits::new(), &mut Diagnostics::new()).expect("a history")
}

/// The mean of equal values is that value: the sum of three times 3.7, divided by 3, is another double, and the limits of
/// values that do not scatter have no width. The same of any value.
#[test]
fn law_equal_calibrations_are_steady() {
    for tenths in 1..200 {
        let found = three(|year| {
            format!(
                "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n[location]\nmeasured = {{ date = {year}-03-10 }}\n\
                 EC0Y = \"{}.{} ± 2 urad\"\n",
                tenths / 10,
                tenths % 10
            )
        });
        assert!(found.series.len() == 1 && found.series[0].is_quiet(), "{:?}", found.series);
    }
}

/// The range of EXX stays at 10 µm, its reversal grows from 4 to 24 and 44 µm with 0.5 µm of u: 20 µm a year, and two jumps
/// beyond 2·√(2·2)·0.5 µm = 2 µm.
#[test]
fn backlash_that_grows_is_no_steady_machine() {
    let found = three(|year| {
        format!(
            "[machine]\nname = \"m\"\nchain = \"w X' b Y Z t\"\n[axis.X]\ntravel = [\"0 mm\", \"300 mm\"]\n[motion.X]\n\
             measured = {{ date = {year}-03-10 }}\nEXX = {{ polynomial = [\"0 um\", \"10 um\"], scale = \"300 mm\", \
             u = \"0.5 um\", reversal = \"{} um\" }}\n",
            4 + 20 * (year - 2024)
        )
    });
    let figure = |name: &str| found.series.iter().find(|s| s.name == name).expect("the figure");
    let (range, reversal) = (figure("EXX range"), figure("EXX reversal"));
    assert!(range.is_quiet() && range.jumps.is_empty());
    let values: Vec<f64> = reversal.points.iter().map(|p| p.value).collect();
    assert!(
        values.iter().zip([4.0, 24.0, 44.0]).all(|(v, due)| (v - due).abs() < 1e-9),
        "{values:?}"
    );
    let per_year = reversal.trend.expect("a trend").per_year;
    assert!((per_year - 20.0).abs() < 0.1, "{per_year}");
    assert_eq!(reversal.jumps.len(), 2);
    assert!(
        reversal.jumps.iter().all(|jump| (jump.expanded - 2.0).abs() < 1e-9)
            && !reversal.is_quiet()
    );
}
