//! The factors of a certificate have the covariance that they were made of.

use nalgebra::DMatrix;
use trueaxis::machine::Machine;
use trueaxis::machine::errors::{ErrorName, ErrorValues};
use trueaxis::machine::file::NoTables;
use trueaxis::unknowns::term::Term;
use trueaxis::verify::certificate::uncertainties::UncertaintyFactors;

/// Σ e_j e_jᵀ over all factors is the covariance of an identification; an error of the machine file that it did not
/// determine keeps its own u, and one that it did determine loses that.
#[test]
fn law_the_factors_have_the_covariance_of_the_terms() {
    let text = "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n[location]\n\
                EX0X = \"0 ± 9 um\"\nEC0Y = \"0 ± 5 urad\"\n";
    let machine = Machine::check("m.toml", text, &NoTables).0.expect("a machine");
    let name = |text: &str| ErrorName::parse(text).expect("a name");
    let terms = ["EX0X", "EX0Y"].map(|n| Term::location(&machine, name(n)).expect("a term"));
    let covariance = DMatrix::from_row_slice(2, 2, &[4e-6, 1e-6, 1e-6, 9e-6]);
    let known = UncertaintyFactors::of_fit(&machine, &terms, &covariance);
    let here = known.at(&machine, &[0.0; 6], &[0.0; 6]);
    let mut sums = [[0.0; 2]; 2];
    for factor in 0..known.factors() {
        let moved = here.displaced(&ErrorValues::default(), factor, 1.0);
        let by = terms.map(|t| moved.get(t.index));
        for (i, row) in sums.iter_mut().enumerate() {
            row.iter_mut().enumerate().for_each(|(k, sum)| *sum += by[i] * by[k]);
        }
    }
    for (i, row) in sums.iter().enumerate() {
        for (k, sum) in row.iter().enumerate() {
            assert!((sum - covariance[(i, k)]).abs() < 1e-15, "{sums:?}");
        }
    }
    let u = here.u(machine.error_index(name("EC0Y")).expect("an error"));
    assert!((u - 5e-6).abs() < 1e-15, "{u}");
}
