//! Our side of stages.toml: what is handed on from stage to stage.

use crate::Ours;
use nalgebra::{DMatrix, DVector};
use trueaxis::identify::conflict::chi_square_tail;
use trueaxis::unknowns::fit::Observability;
use trueaxis::unknowns::known::Known;

pub const CLAIMS: &[(&str, Ours)] = &[
    ("stages-two-lengths", two_lengths),
    ("stages-two-correlated-values", two_correlated_values),
    ("stages-chi-square", || {
        let table = [
            (3.84146, 1),
            (11.0705, 5),
            (18.3070, 10),
            (21.6660, 9),
            (50.8922, 30),
            (124.342, 100),
        ];
        table.iter().map(|(x, n)| chi_square_tail(*x, *n)).collect()
    }),
];

fn two_lengths() -> Vec<f64> {
    let mut known = Known::nothing(vec!["length".to_owned()]);
    known.add_value(0, 10.0, 2.0);
    let mut next = Known::nothing(vec!["length".to_owned()]);
    next.add_value(0, 13.0, 1.0);
    known.add(&next, 1.0);
    let sight = Observability::of(&known.normal);
    vec![sight.solve(&known.gradient)[0], sight.covariance()[(0, 0)].sqrt()]
}

fn two_correlated_values() -> Vec<f64> {
    let names = vec!["a".to_owned(), "b".to_owned()];
    let covariance = DMatrix::from_row_slice(2, 2, &[1.0, 0.5, 0.5, 1.0]);
    let values = DVector::from_vec(vec![1.0, 0.0]);
    let known = Known::of_rows(names, &DMatrix::identity(2, 2), &values, &covariance, &[]);
    let known = known.expect("a covariance");
    let (n, g) = (&known.normal, &known.gradient);
    vec![n[(0, 0)], n[(0, 1)], g[0], g[1], known.square]
}
