//! What is not known well enough stays out, whole; and what a control leaves of each error is what it really leaves.

use trueaxis_correct::compensate::tables::{Compiled, Order, Target, compile};
use trueaxis_machine::Machine;
use trueaxis_machine::file::NoTables;

fn compiled(chain: &str, errors: &str, target: Target) -> Compiled {
    let text = format!(
        "[machine]\nname = \"m\"\nchain = \"{chain}\"\n[axis.X]\ntravel = [\"0 mm\", \"1000 mm\"]\n\
         [axis.Y]\ntravel = [\"0 mm\", \"400 mm\"]\n[axis.Z]\ntravel = [\"-300 mm\", \"0 mm\"]\n\
         [tool]\nlength = \"100 mm\"\n{errors}"
    );
    let (machine, problems) = Machine::check("m.toml", &text, &NoTables);
    let machine = machine.unwrap_or_else(|| panic!("{problems:?}"));
    compile(&machine, &Order::of(target)).unwrap_or_else(|error| panic!("{error}"))
}

fn pairs(compiled: &Compiled) -> Vec<(usize, usize)> {
    compiled.tables.iter().map(|t| (t.table.input, t.table.output)).collect()
}

const EYX: &str = "[motion.X]\nEYX = { polynomial = [\"0 um\", \"20 um\"], scale = \"1000 mm\", u = \"0.5 um\" }\n";

/// A squareness of 20 ± 200 µrad moves X by a function of Y and by a constant; neither is known. Half of the pair would
/// displace the tip everywhere. The straightness of X that is known goes in.
#[test]
fn both_halves_of_a_pair_stay_out() {
    let errors = format!("[location]\nEC0Y = \"20 ± 200 urad\"\n{EYX}");
    for target in [Target::Csv, Target::Sinumerik] {
        let compiled = compiled("w b X Y Z t", &errors, target);
        let pairs = pairs(&compiled);
        assert!(
            pairs.contains(&(0, 1)) && pairs.iter().all(|(_, o)| *o != 0),
            "{target:?} {pairs:?}"
        );
        let out = compiled.left_out.iter().filter(|out| out.reason.contains("uncertainty")).count();
        assert_eq!(out, 2, "{:?}", compiled.left_out);
        // The squareness alone is left: 20 µrad over 400 mm.
        assert!((compiled.after.max_mm - 8e-3).abs() < 1e-3, "{:?}", compiled.after);
    }
}

/// The grid does not take up what stays out of the tables, nor an axis of which all is unknown.
#[test]
fn a_grid_holds_what_is_known() {
    let unknown = "[location]\nEC0Y = \"20 ± 30 urad\"\n[motion.X]\n\
                   EXX = { polynomial = [\"0 um\", \"20 um\"], scale = \"1000 mm\", u = \"30 um\" }\n";
    let straight =
        "EYX = { polynomial = [\"0 um\", \"20 um\"], scale = \"1000 mm\", u = \"0.5 um\" }\n";
    let first = compiled("w b X Y Z t", &format!("{unknown}{straight}"), Target::Fanuc);
    let grid = &first.grid.as_ref().expect("a grid").grid;
    assert!(grid.values.iter().all(|[x, _, _]| *x == 0), "X: EXX and EC0Y are not known");
    assert!(grid.values.iter().any(|[_, y, _]| *y != 0), "Y: EYX is");
    assert!(
        first.left_out.iter().any(|out| out.reason.starts_with("in the grid")),
        "{:?}",
        first.left_out
    );
    let lost = first.errors.iter().find(|e| e.error.to_string() == "EC0Y").expect("EC0Y");
    assert!(!lost.represented, "{lost:?}");
    // A straightness of Y in X that is known: the grid moves X by it alone, 40 µm from end to end of Y, whatever X is. The
    // constant of X, of which EXX is the larger part of u, stays out with the table of X.
    let known = format!(
        "{unknown}[motion.Y]\nEXY = {{ polynomial = [\"0 um\", \"40 um\"], scale = \"400 mm\", u = \"0.5 um\" }}\n"
    )
    .replace("EC0Y = \"20 ± 30 urad\"", "EB0Z = \"0 urad\"");
    let second = compiled("w b X Y Z t", &known, Target::Fanuc);
    let grid = &second.grid.as_ref().expect("a grid").grid;
    let x = |value: &[i64; 3]| value[0];
    let (low, high) = (grid.values.iter().map(x).min(), grid.values.iter().map(x).max());
    let span = high.zip(low).map(|(high, low)| high - low);
    assert!(span.is_some_and(|c| (39_000..=41_000).contains(&c)), "{span:?}");
}

/// Chains of ISG and HEIDENHAIN have one value for both directions: ±4.5 µm of EYX are left, and said to be.
#[test]
fn reversal_that_a_chain_leaves_is_not_represented() {
    let errors = "[motion.X]\nEYX = { polynomial = [\"0 um\", \"10 um\"], scale = \"500 mm\", reversal = \"9 um\" }\n\
                  EZX = { polynomial = [\"0 um\", \"10 um\"], scale = \"500 mm\" }\n";
    for target in [Target::Isg, Target::Heidenhain] {
        let compiled = compiled("w X' b Y Z t", errors, target);
        let find = |name: &str| compiled.errors.iter().find(|e| e.error.to_string() == name);
        let (directed, plain) = (find("EYX").expect("EYX"), find("EZX").expect("EZX"));
        assert!(!directed.represented && (directed.left_mm - 4.5e-3).abs() < 1e-5, "{directed:?}");
        assert!(plain.represented, "{plain:?}");
        assert!((compiled.after.max_mm - 4.5e-3).abs() < 0.6e-3, "{:?}", compiled.after);
    }
}
