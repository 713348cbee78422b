//! The uncertainty of a trend from the scatter of the points about it.

use trueaxis_condition::date::Date;
use trueaxis_condition::history::{Calibration, DAYS_PER_YEAR, Limits, Point, Trend, history};
use trueaxis_input::Diagnostics;

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
                figures: vec![("EC0Y".to_owned(), "urad".to_owned(), point)],
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
