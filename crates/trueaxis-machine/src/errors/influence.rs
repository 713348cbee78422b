//! Quantities that a study varies, beside those whose uncertainty the machine file states.

use super::{Curve, ErrorIndex, Uncertainties};

/// An influence quantity (VIM 2.52) of a study: what one unit of it adds to errors of the machine.
///
/// ```
/// use trueaxis_machine::{Machine, file::NoTables};
/// use trueaxis_machine::errors::{Curve, ErrorName, Influence};
/// let text = "machine = { name = \"m\", chain = \"w b X Y Z t\" }";
/// let machine = Machine::check("m.toml", text, &NoTables).0.unwrap();
/// let index = machine.error_index(ErrorName::parse("EXX").unwrap()).unwrap();
/// // The scale of X is long by 1 µm/m per unit.
/// let slope = Curve::Polynomial { coefficients: vec![0.0, 1e-6], origin: 0.0, scale: 1.0 };
/// let scale = Influence { name: "scale of X".into(), effects: vec![(index, slope)] };
/// let machine = machine.with_influences(vec![scale]);
///
/// let quantities = machine.uncertain_quantities();
/// assert_eq!(quantities, ["scale of X"]);
/// let known = machine.uncertainties_at(&[2000.0, 0.0, 0.0, 0.0, 0.0, 0.0], &quantities);
/// // Three units, at 2 m: 6 µm.
/// let errors = known.displaced(&Default::default(), &[3.0]);
/// assert!((errors.get(index) - 0.006).abs() < 1e-15);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Influence {
    /// Its name, not that of a quantity of the machine.
    pub name: String,
    /// What a unit of it adds to each error, along the axis of that error.
    pub effects: Vec<(ErrorIndex, Curve)>,
}

impl Influence {
    /// Adds what a unit does where the axis of each error stands. A table says nothing beyond its ends, as for the
    /// error itself.
    pub(crate) fn add_to(
        &self,
        found: &mut Uncertainties,
        quantity: usize,
        position: impl Fn(ErrorIndex) -> f64,
    ) {
        for (index, curve) in &self.effects {
            found.add(quantity, *index, curve.at(position(*index)).unwrap_or(0.0));
        }
    }
}
