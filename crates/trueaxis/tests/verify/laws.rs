//! Laws of the evaluations: judged by mathematics.

use proptest::prelude::*;
use trueaxis::input::Diagnostics;
use trueaxis::verify::conditions::Conditions;
use trueaxis::verify::iso230_2::{Positioning, Quantity, evaluate, read};
use trueaxis::verify::{self, Request, Standard};

/// Target, run, rising, deviation in µm.
type Row = (usize, u32, bool, f64);

fn result(rows: &[Row]) -> Positioning {
    let mut text = "target_mm,run,direction,deviation_um\n".to_owned();
    for (target, run, up, deviation) in rows {
        let word = if *up { "up" } else { "down" };
        text += &format!("{},{run},{word},{deviation}\n", 37 * target);
    }
    let mut problems = Diagnostics::new();
    let measured = read("t.csv", &text, &mut problems).expect("a measurement");
    assert!(!problems.has_errors());
    evaluate(&measured, None)
}

fn um(result: &Positioning, quantity: Quantity) -> f64 {
    result.value(quantity).map_or(f64::NAN, |v| v * 1e3)
}

/// Three to eight targets, two to six runs, both directions.
fn tests() -> impl Strategy<Value = Vec<Row>> {
    (3..8_usize, 2..6_u32).prop_flat_map(|(targets, runs)| {
        let count = targets * runs as usize * 2;
        prop::collection::vec(-50.0..50.0_f64, count).prop_map(move |values| {
            let row = |(i, value): (usize, f64)| {
                let (target, rest) = (i % targets, i / targets);
                (target, rest as u32 / 2 + 1, rest % 2 == 0, value)
            };
            values.into_iter().enumerate().map(row).collect()
        })
    })
}

proptest! {
    #[test]
    fn law_a_constant_changes_nothing(rows in tests(), shift in -90.0..90.0_f64) {
        let moved: Vec<Row> = rows.iter().map(|r| (r.0, r.1, r.2, r.3 + shift)).collect();
        let (a, b) = (result(&rows), result(&moved));
        for quantity in Quantity::ALL {
            prop_assert!((um(&a, quantity) - um(&b, quantity)).abs() < 1e-9);
        }
    }

    #[test]
    fn law_the_order_of_the_rows_does_not_matter(rows in tests()) {
        let turned: Vec<Row> = rows.iter().rev().copied().collect();
        let (a, b) = (result(&rows), result(&turned));
        for quantity in Quantity::ALL {
            prop_assert!((um(&a, quantity) - um(&b, quantity)).abs() < 1e-9);
        }
    }

    #[test]
    fn law_the_other_way_round_swaps_the_arrows(rows in tests()) {
        let turned: Vec<Row> = rows.iter().map(|r| (r.0, r.1, !r.2, r.3)).collect();
        let (a, b) = (result(&rows), result(&turned));
        use Quantity as Q;
        for (one, other) in [
            (Q::A, Q::A), (Q::R, Q::R), (Q::E, Q::E), (Q::M, Q::M), (Q::B, Q::B),
            (Q::AUp, Q::ADown), (Q::RUp, Q::RDown), (Q::EUp, Q::EDown),
        ] {
            prop_assert!((um(&a, one) - um(&b, other)).abs() < 1e-9);
        }
        prop_assert!((um(&a, Q::BMean) + um(&b, Q::BMean)).abs() < 1e-9);
    }

    #[test]
    fn law_figures_bound_each_other(rows in tests()) {
        let r = result(&rows);
        use Quantity as Q;
        for (smaller, larger) in [
            (Q::E, Q::A), (Q::M, Q::E), (Q::B, Q::E), (Q::EUp, Q::E), (Q::AUp, Q::A),
            (Q::RUp, Q::R), (Q::B, Q::R), (Q::R, Q::A),
        ] {
            prop_assert!(um(&r, smaller) <= um(&r, larger) + 1e-9, "{smaller:?} {larger:?}");
        }
        prop_assert!(um(&r, Q::BMean).abs() <= um(&r, Q::B) + 1e-9);
    }

    #[test]
    fn law_no_text_makes_an_evaluation_panic(
        heads in prop::collection::vec(0..20_usize, 1..5),
        rows in prop::collection::vec(prop::collection::vec(0..16_usize, 1..5), 0..20),
    ) {
        let names = [
            "target_mm", "target_deg", "run", "direction", "deviation_um", "actual_mm", "up_1_um",
            "down_2_um", "x_mm", "y_mm", "angle_deg", "radius_mm", "time_s", "air_degC", "diagonal",
            "radial_um", "axial_um", "temperature_degF", "x_um", "",
        ];
        let cells = [
            "0", "-0", "1", "2", "360", "1e300", "-1e12", "nan", "inf", "", "up", "cw", "+++", "+X-Y",
            "1e-300", "µ",
        ];
        let line = |row: &[usize], words: &[&str]| -> String {
            row.iter().map(|i| words[*i]).collect::<Vec<_>>().join(",") + "\n"
        };
        let mut text = line(&heads, &names);
        for row in &rows {
            text += &line(row, &cells);
        }
        evaluate_by_all(&text);
    }

    #[test]
    fn law_no_reading_makes_a_figure_that_is_no_number(
        rows in prop::collection::vec((0..9_usize, 0..5_usize, 0..9_usize), 1..30),
    ) {
        let numbers = ["0", "-0", "1", "2", "5", "360", "1e300", "-1e12", "1e-300"];
        for heads in [
            "target_mm,direction,deviation_um", "x_mm,direction,y_mm", "angle_deg,note,radial_um",
            "time_s,note,x_um", "target_deg,direction,actual_deg",
        ] {
            let mut text = format!("{heads}\n");
            for (a, w, b) in &rows {
                let word = ["up", "down", "cw", "ccw", "+"][*w];
                text += &format!("{},{word},{}\n", numbers[*a], numbers[*b]);
            }
            evaluate_by_all(&text);
        }
    }
}

fn evaluate_by_all(text: &str) {
    let (conditions, _) = Conditions::read("c.toml", "[circle]\nradius = '10 mm'");
    for standard in Standard::ALL {
        let request = Request {
            standard,
            file: "t.csv",
            text,
            conditions: &conditions,
            conditions_file: "c.toml",
            window_s: 60.0,
        };
        let mut problems = Diagnostics::new();
        let found = verify::evaluate(&request, &mut problems);
        // Either figures or an error that says why.
        assert!(found.is_some() || problems.has_errors(), "{standard:?}\n{text}");
        if let Some(evaluated) = &found {
            let document = super::document(standard, evaluated, &conditions);
            let text_of = document.to_string();
            assert!(!text_of.contains("NaN") && !text_of.contains("inf"), "{text_of}");
            super::page(standard, evaluated, &conditions);
        }
    }
}
