//! The part at a feed: how fast the tip goes where an axis is slow, and a rotary axis that is late across the end of its turn.

use std::path::Path;
use trueaxis_input::Files;
use trueaxis_predict::predict::{Prediction, parse_study, predict};

/// A cone with its base of this diameter, mm, cut at 3 m/min with a tool of 20 mm.
fn piece(half_angle_deg: f64, base_mm: f64) -> String {
    format!(
        "name = \"piece\"\n[cone]\nhalf_angle = \"{half_angle_deg} deg\"\nbase_diameter = \"{base_mm} mm\"\n\
         height = \"20 mm\"\npositions = 72\nsections = [\"0 mm\", \"10 mm\", \"20 mm\"]\n\
         roundness_at = \"10 mm\"\nangularity_over = [\"0 mm\", \"20 mm\"]\n[[condition]]\n\
         name = \"finish\"\nfeed = \"3 m/min\"\n[tool]\ndiameter = \"20 mm\"\n\
         [tolerance]\nroundness_mzc = \"0.1 mm\"\n"
    )
}

fn predicted(machine: &str, piece: &str, servo: &str) -> Prediction {
    let texts = [("m.toml".into(), machine.to_owned()), ("p.toml".into(), piece.to_owned())];
    let files = Files::none().with_texts(texts);
    let text = format!(
        "name = \"s\"\nmachine = \"m.toml\"\ntest_piece = \"p.toml\"\n[monte_carlo]\n\
         samples = 0\n{servo}"
    );
    let (study, problems) = parse_study(&files, Path::new("s.toml"), &text);
    let study = study.unwrap_or_else(|| panic!("{:?}", problems.iter().collect::<Vec<_>>()));
    predict(&study, &|_| ()).expect("a prediction")
}

/// Round a circle of 50 mm at 50 mm/s with an X axis of 25 mm/s: 25 mm/s where X goes alone, and the whole feed where
/// its share is below a half; 1 m/s² are more than enough for the changes between (87 mm/s² by hand), and an axis that
/// stands still holds nothing back.
#[test]
fn law_a_slow_axis_holds_back_where_it_moves_and_nowhere_else() {
    let axis = |name: &str, velocity: &str| {
        let head = format!("[axis.{name}]\nmax_velocity = \"{velocity}\"\n");
        head + "max_acceleration = \"1 m/s^2\"\n"
    };
    let machine = "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n".to_owned()
        + &axis("X", "1.5 m/min")
        + &axis("Y", "20 m/min")
        + &axis("Z", "20 m/min");
    let found = predicted(&machine, &piece(0.0, 80.0), "[servo]\nX.lag = \"0 ms\"\n");
    let [low, high] = found.conditions[0].speed_mm_per_s;
    assert!((low - 25.0).abs() < 1e-3 && (high - 50.0).abs() < 1e-9, "{low} to {high} mm/s");
}

/// C goes round once, and its error grows by 80 µm over the turn. All axes are late by 120 ms, 8.7° of the circle: the
/// last position, 5° before the end of the turn, is passed when the next turn has begun, and is still cut with the
/// error of the end. So the part is as round as the one of exact axes, only smaller.
#[test]
fn law_a_position_that_is_passed_late_keeps_its_turn() {
    let machine = "[machine]\nname = \"m\"\nchain = \"w b X Y Z C A t\"\n\
                   [motion.C]\nEZC = { polynomial = [\"0 um\", \"80 um\"], scale = \"360 deg\" }\n";
    let late = ["X", "Y", "Z", "C", "A"].map(|axis| format!("{axis}.lag = \"120 ms\"\n")).concat();
    let found = predicted(machine, &piece(15.0, 60.0), &format!("[servo]\n{late}"));
    let index = found.indices.iter().position(|i| i.name.key == "roundness_mzc_mm");
    let index = index.expect("the index");
    let (still, at_feed) = (found.indices[index].value_mm, found.conditions[0].indices_mm[index]);
    assert!(still > 0.015, "{still}");
    assert!((at_feed - still).abs() < 1e-3, "{at_feed} mm, {still} mm with exact axes");
}
