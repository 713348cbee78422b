//! The error budget by groups: each group is what a machine file has that states nothing else.

use std::path::Path;
use trueaxis_input::Files;
use trueaxis_predict::predict::{Prediction, parse_study, predict};

const MACHINE: &str = "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n";
const SQUARENESS: &str = "[location]\nEC0Y = \"100 urad\"\n";
const OF_X: &str =
    "[motion.X]\nEXX = { polynomial = [\"0 um\", \"80 um\"], scale = \"1000 mm\" }\n";
const OF_Y: &str =
    "[motion.Y]\nEYY = { polynomial = [\"0 um\", \"30 um\"], scale = \"1000 mm\" }\n";

const PIECE: &str = "
name = \"cylinder\"
[cone]
half_angle = \"0 deg\"
base_diameter = \"80 mm\"
height = \"20 mm\"
positions = 72
sections = [\"0 mm\", \"10 mm\", \"20 mm\"]
roundness_at = \"10 mm\"
angularity_over = [\"0 mm\", \"20 mm\"]
[[condition]]
name = \"only\"
feed = \"1 m/min\"
[tool]
diameter = \"20 mm\"
[tolerance]
roundness_mzc = \"0.1 mm\"
";

fn predicted(errors: &[&str]) -> Prediction {
    let machine = MACHINE.to_owned() + &errors.concat();
    let texts = [("m.toml".into(), machine), ("p.toml".into(), PIECE.to_owned())];
    let files = Files::none().with_texts(texts);
    let text =
        "name = \"s\"\nmachine = \"m.toml\"\ntest_piece = \"p.toml\"\n[monte_carlo]\nsamples = 0\n";
    let (study, problems) = parse_study(&files, Path::new("s.toml"), text);
    let study = study.unwrap_or_else(|| panic!("{:?}", problems.iter().collect::<Vec<_>>()));
    predict(&study, &|_| ()).expect("a prediction")
}

fn indices(errors: &[&str]) -> Vec<f64> {
    predicted(errors).indices.iter().map(|i| i.value_mm).collect()
}

#[test]
fn law_a_group_alone_is_a_machine_with_nothing_else() {
    let whole = predicted(&[SQUARENESS, OF_X, OF_Y]);
    let same = |found: &[f64], expected: &[&str], of: &str| {
        let expected = indices(expected);
        assert!(expected.iter().any(|v| *v > 1e-3), "{of} does nothing");
        for (k, (a, b)) in found.iter().zip(&expected).enumerate() {
            assert!((a - b).abs() < 1e-9, "{of}, index {k}: {a}, {b}");
        }
    };
    let body = |name: &str| {
        let found = whole.budget.bodies.iter().find(|s| s.of.to_string() == name);
        found.unwrap_or_else(|| panic!("{name} is not in the budget"))
    };
    same(&body("X").alone_mm, &[OF_X], "X alone");
    same(&body("X").without_mm, &[SQUARENESS, OF_Y], "without X");
    same(&body("Y").alone_mm, &[SQUARENESS, OF_Y], "Y alone");
    same(&body("Y").without_mm, &[OF_X], "without Y");
    assert_eq!(whole.budget.bodies.len(), 2);
    let [location, motion] = &whole.budget.kinds[..] else { panic!("two kinds") };
    same(&location.alone_mm, &[SQUARENESS], "location errors alone");
    same(&location.without_mm, &[OF_X, OF_Y], "without location errors");
    same(&motion.alone_mm, &[OF_X, OF_Y], "error motions alone");
    same(&motion.without_mm, &[SQUARENESS], "without error motions");
}
