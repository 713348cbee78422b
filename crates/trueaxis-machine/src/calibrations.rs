//! Two calibrations of one machine: significant changes of its errors.
//!
//! ```text
//!     Δ(q) = E_new(q) − E_old(q)      u²(Δ) = u²_new + u²_old      E_n = |Δ| / (2 u(Δ))
//! ```
//!
//! docs/model.md eq. 161. The two calibrations count as independent: what both have in common (one
//! instrument, one reference) makes u(Δ) too large, so that a change may be missed, not invented. Tables of one scale that
//! hold at two temperatures are compared at that of the newer one (eq. 344).

mod temperature;
mod tip;

pub use temperature::TwoTemperatures;
pub use tip::{Share, TipChange};

use crate::Machine;
use crate::axis::Travel;
use crate::chain::ChainBody;
use crate::errors::{Component, ErrorKind, ErrorName, StatedError};
use crate::heat::ThermalTerm;
use temperature::at_temperatures_of;
use trueaxis_geometry::statistics::normal_quantile_above;

/// Places along an axis that curves are compared at.
const PLACES: usize = 101;
/// The probability of any false alarm among all errors.
const FALSE_ALARM: f64 = 0.05;
/// The expanded uncertainty of E_n.
const COVERAGE: f64 = 2.0;

/// The significance of the change of one error.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Significance {
    /// Beyond what chance does anywhere among all errors.
    Yes,
    /// E_n > 1, but one of so many errors may well be.
    Perhaps,
    /// Within the uncertainty of the two calibrations.
    No,
    /// No uncertainty is stated.
    Unknown,
    /// Only the new file states it.
    New,
    /// Only the old file states it.
    Gone,
}

impl Significance {
    /// A word for programs.
    pub fn key(self) -> &'static str {
        match self {
            Self::Yes => "yes",
            Self::Perhaps => "perhaps",
            Self::No => "no",
            Self::Unknown => "unknown",
            Self::New => "new",
            Self::Gone => "gone",
        }
    }
}

/// One error in both files, at the place where its change is clearest.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorChange {
    /// Which.
    pub error: ErrorName,
    /// The position of its axis there; none for location errors. Unit: mm or rad.
    pub at: Option<f64>,
    /// The side from which the axis comes there, if the curve knows sides: +1 or −1. Unit: 1.
    pub approach: f64,
    /// Its value in the old file, at the temperature of the new one. Unit: mm or rad.
    pub old: Option<f64>,
    /// Its value in the new file. Unit: mm or rad.
    pub new: Option<f64>,
    /// Root mean square of the change over the travel. Unit: mm or rad.
    pub rms: f64,
    /// Standard uncertainty of the change there; none if a file does not state it. Unit: mm or rad.
    pub u: Option<f64>,
    /// Its significance.
    pub moved: Significance,
}

impl ErrorChange {
    /// New less old, mm or rad.
    pub fn change(&self) -> Option<f64> {
        Some(self.new? - self.old?)
    }

    /// The change over its expanded uncertainty (k = 2); above 1 the two do not agree.
    pub fn e_n(&self) -> Option<f64> {
        Some(self.change()?.abs() / (COVERAGE * self.u.filter(|u| *u > 0.0)?))
    }
}

/// What is different between two calibrations.
#[derive(Debug, Clone, PartialEq)]
pub struct Calibrations {
    /// The older machine, its tables at the temperatures of the newer one.
    pub older: Machine,
    /// Every error that a file states, in the order of the chain.
    pub errors: Vec<ErrorChange>,
    /// |Δ| / u(Δ) above which a change is significant: 5 % of false alarms for all errors together. Unit: 1.
    pub limit: f64,
    /// What it does to the tool tip.
    pub tip: TipChange,
    /// Tables that hold at two temperatures.
    pub temperatures: Vec<TwoTemperatures>,
}

impl Calibrations {
    /// The errors that changed significantly.
    pub fn moved(&self) -> impl Iterator<Item = &ErrorChange> {
        self.errors.iter().filter(|e| e.moved == Significance::Yes)
    }
}

/// Compares two machine files of one machine.
///
/// # Errors
/// In words, why they are not of one machine.
///
/// # Example
/// ```
/// use trueaxis_machine::{Machine, file::NoTables};
/// use trueaxis_machine::calibrations::{Significance, calibrations};
/// let mill = |squareness: &str| {
///     let text = format!("[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n\
///                         [location]\nEC0Y = \"{squareness}\"");
///     Machine::check("m.toml", &text, &NoTables).0.unwrap()
/// };
/// // 10 µrad more, each known to 3 µrad: u(Δ) = 4.24 µrad, E_n = 10 / 8.49 = 1.18.
/// let found = calibrations(&mill("20 ± 3 urad"), &mill("30 ± 3 urad")).unwrap();
/// assert!((found.errors[0].e_n().unwrap() - 1.1785).abs() < 1e-4);
/// assert_eq!(found.errors[0].moved, Significance::Yes); // one error only: the limit is 1.96 u
/// ```
///
/// # Source
/// E_n: ISO/IEC 17043:2010, B.3.1.3; for many errors at a time the bound of Bonferroni.
pub fn calibrations(old: &Machine, new: &Machine) -> Result<Calibrations, String> {
    same_machine(old, new)?;
    let (older, temperatures) = at_temperatures_of(old, new);
    let (errors, limit) = changes(&older, new);
    let tip = tip::tip_change(&older, new);
    Ok(Calibrations { older, errors, limit, tip, temperatures })
}

/// The errors alone, and the limit of |Δ| / u(Δ).
///
/// # Errors
/// As [`calibrations`].
pub fn error_changes(old: &Machine, new: &Machine) -> Result<(Vec<ErrorChange>, f64), String> {
    same_machine(old, new)?;
    Ok(changes(&at_temperatures_of(old, new).0, new))
}

/// The same of machines that hold at one temperature.
fn changes(old: &Machine, new: &Machine) -> (Vec<ErrorChange>, f64) {
    let mut errors = Vec::new();
    for (body, in_old) in old.bodies().iter().enumerate() {
        let travel = in_old.axis.map(|axis| old.axes()[axis].travel);
        for kind in [ErrorKind::Location, ErrorKind::Motion] {
            for component in Component::ALL {
                let [a, b] = [old, new].map(|m| Stated::of(&m.bodies()[body], kind, component));
                let error = ErrorName { body: in_old.name, kind, component };
                let travel = travel.filter(|_| kind == ErrorKind::Motion);
                errors.extend(compared(error, a.as_ref(), b.as_ref(), travel));
            }
        }
    }
    let decided = errors.iter().filter(|e| e.u.is_some() && e.change().is_some()).count();
    let limit = normal_quantile_above(0.5 * FALSE_ALARM / decided.max(1) as f64);
    for error in &mut errors {
        error.moved = judged(error, limit);
    }
    (errors, limit)
}

/// What a file states of an error, with the growth of its scale to the temperature of the other file.
pub struct Stated<'a> {
    stated: &'a StatedError,
    growth: Vec<&'a ThermalTerm>,
}

impl<'a> Stated<'a> {
    /// Of one error of a body; none if it is not stated.
    pub fn of(body: &'a ChainBody, kind: ErrorKind, component: Component) -> Option<Self> {
        let stated = body.stated(kind, component)?;
        let growth = body.thermal.iter().filter(|t| (t.kind, t.component) == (kind, component));
        Some(Self { stated, growth: growth.collect() })
    }

    /// Its value at a position; none where its table ends. Unit: mm or rad.
    pub fn at(&self, q: f64, side: f64) -> Option<f64> {
        let growth: f64 = self.growth.iter().map(|term| term.at(q)).sum();
        self.stated.at(q, side).ok().map(|value| value + growth)
    }

    /// Its standard uncertainty; none if it is not stated. Unit: mm or rad.
    pub fn u_at(&self, q: f64) -> Option<f64> {
        let own = self.stated.u.is_some().then(|| self.stated.u_at(q))?;
        Some(self.growth.iter().fold(own, |u, term| u.hypot(term.u_at(q))))
    }
}

fn same_machine(old: &Machine, new: &Machine) -> Result<(), String> {
    let (a, b) = (old.chain_text(), new.chain_text());
    match a == b {
        true => Ok(()),
        false => {
            Err(format!("they are of two machines: the chain is `{a}` in one, `{b}` in the other"))
        }
    }
}

fn judged(error: &ErrorChange, limit: f64) -> Significance {
    match (error.change(), error.u) {
        (None, _) if error.old.is_none() => Significance::New,
        (None, _) => Significance::Gone,
        (Some(0.0), _) => Significance::No,
        (Some(_), None) => Significance::Unknown,
        (Some(change), Some(u)) if change.abs() > limit * u => Significance::Yes,
        (Some(change), Some(u)) if change.abs() > COVERAGE * u => Significance::Perhaps,
        _ => Significance::No,
    }
}

/// The change of one error where it is clearest; none if no file states it.
fn compared(
    error: ErrorName,
    old: Option<&Stated<'_>>,
    new: Option<&Stated<'_>>,
    travel: Option<Travel>,
) -> Option<ErrorChange> {
    let stated = old.or(new)?.stated;
    let sides: &[f64] = match [old, new].iter().flatten().any(|e| e.stated.reversal.is_some()) {
        true => &[1.0, -1.0],
        false => &[0.0],
    };
    let mut best: Option<(f64, ErrorChange)> = None;
    let (mut sum, mut count) = (0.0, 0_usize);
    for q in places(stated, travel) {
        for side in sides {
            let value = |e: Option<&Stated<'_>>| e.map_or(Some(None), |e| e.at(q, *side).map(Some));
            // Where a table of one file ends there is nothing to compare.
            let (Some(a), Some(b)) = (value(old), value(new)) else { continue };
            let u_of = |e: &Stated<'_>| e.u_at(q);
            let u = old.and_then(u_of).zip(new.and_then(u_of)).map(|(a, b)| a.hypot(b));
            let change = b.unwrap_or(0.0) - a.unwrap_or(0.0);
            sum += change * change;
            count += 1;
            let weight = change.abs() / u.filter(|u| *u > 0.0).unwrap_or(1.0);
            if best.as_ref().is_none_or(|(most, _)| weight > *most) {
                let at = travel.map(|_| q);
                let (rms, moved) = (0.0, Significance::Unknown);
                let here =
                    ErrorChange { error, at, approach: *side, old: a, new: b, rms, u, moved };
                best = Some((weight, here));
            }
        }
    }
    let (_, change) = best?;
    Some(ErrorChange { rms: (sum / count as f64).sqrt(), ..change })
}

/// The positions at which an error is compared.
fn places(error: &StatedError, travel: Option<Travel>) -> Vec<f64> {
    use crate::errors::Curve;
    let (from, to) = match (travel, &error.mean) {
        (None, _) => return vec![0.0],
        (Some(Travel::Between(from, to)), _) => (from, to),
        (_, Curve::Table { spline, .. }) => spline.range(),
        _ => (-std::f64::consts::PI, std::f64::consts::PI),
    };
    (0..PLACES).map(|i| from + (to - from) * i as f64 / (PLACES - 1) as f64).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::NoTables;
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    fn mill(rest: &str) -> Machine {
        let text = format!(
            "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n\
             [axis.X]\ntravel = [\"0 mm\", \"500 mm\"]\n[axis.Y]\ntravel = [\"0 mm\", \"400 mm\"]\n\
             [axis.Z]\ntravel = [\"0 mm\", \"300 mm\"]\n{rest}"
        );
        Machine::check("m.toml", &text, &NoTables).0.expect("a machine")
    }

    #[test]
    fn nothing_moved_between_a_machine_and_itself() {
        let same = mill("[location]\nEC0Y = \"20 ± 3 urad\"\nEB0Z = \"5 urad\"");
        let found = calibrations(&same, &same).expect("one machine");
        assert_eq!(found.moved().count(), 0);
        assert_eq!((found.tip.largest_mm, found.errors.len()), (0.0, 2));
        assert!(found.errors.iter().all(|e| e.moved == Significance::No));
    }

    /// One scale, its table written down at two temperatures: nothing has changed, whoever carries the axis and wherever the
    /// scale is fixed. By hand: 10 µm/(m K) · 0.5 m · 6.4 K = 32 µm, and 1 µm/(m K) of it 3.2 µm.
    #[test]
    fn law_a_table_at_another_temperature_is_no_change() {
        for (chain, sense) in [("w b X Y Z t", 1.0), ("w X' b Y Z t", -1.0)] {
            for (fixed, celsius) in [(0.0, 28.4), (-200.0, 20.0), (300.0, 35.0)] {
                let machine = |celsius: f64| {
                    // EXX = 9 µm per 100 mm at 22 °C.
                    let grown = sense * 10e-3 * (celsius - 22.0);
                    let text = format!(
                        "[machine]\nname = \"m\"\nchain = \"{chain}\"\n[axis.X]\n\
                         travel = [\"0 mm\", \"500 mm\"]\n[scale.X]\nexpansion = \"10 ± 1 um/(m K)\"\n\
                         fixed_point = \"{fixed} mm\"\nsensors = {{ x = \"0 mm\" }}\n[motion.X]\n\
                         EXX = {{ polynomial = [\"{} um\", \"{} um\"], scale = \"100 mm\", u = \"0.1 um\", \
                         measured = {{ temperature = \"{celsius} degC\" }} }}\n",
                        -grown * fixed,
                        9.0 + 100.0 * grown
                    );
                    Machine::check("m.toml", &text, &NoTables).0.expect("a machine")
                };
                let found = calibrations(&machine(celsius), &machine(22.0)).expect("one machine");
                let change = found.errors.first().expect("EXX");
                assert!(
                    change.rms < 1e-9 && found.tip.largest_mm < 1e-9,
                    "{chain} {fixed} {change:?}"
                );
                assert_eq!(found.moved().count(), 0);
                let [two] = &found.temperatures[..] else { panic!("{:?}", found.temperatures) };
                assert_eq!((two.old_celsius, two.new_celsius), (celsius, 22.0));
                let again = calibrations(&machine(celsius), &machine(celsius));
                assert!(again.expect("one machine").temperatures.is_empty());
            }
        }
        let of = |rest: &str, celsius: f64| {
            mill(&format!(
                "{rest}[motion.X]\nEXX = {{ constant = \"0 um\", u = \"0.1 um\", \
                 measured = {{ temperature = \"{celsius} degC\" }} }}\n"
            ))
        };
        let scale = "[scale.X]\nexpansion = \"10 ± 1 um/(m K)\"\nfixed_point = \"0 mm\"\nsensors = { x = \"0 mm\" }\n";
        let found = calibrations(&of(scale, 28.4), &of(scale, 22.0)).expect("one machine");
        let (old, u) = (found.errors[0].old.expect("stated"), found.errors[0].u.expect("stated"));
        let at = found.errors[0].at.expect("on the travel");
        assert!((old + 10e-6 * at * 6.4).abs() < 1e-12, "{old} at {at}");
        let due = (2.0 * 1e-4_f64.powi(2) + (1e-6 * at * 6.4).powi(2)).sqrt();
        assert!((u - due).abs() < 1e-12, "{u} {due}");
        assert!((found.tip.largest_mm - 32e-3).abs() < 1e-4, "{}", found.tip.largest_mm);
        // Without a coefficient they are compared as they are.
        let found = calibrations(&of("", 28.4), &of("", 22.0)).expect("one machine");
        assert_eq!(found.errors[0].change(), Some(0.0));
        assert!(found.temperatures[0].expansion_per_k.is_none());
    }

    #[test]
    fn a_squareness_moves_the_tip_by_its_length() {
        let old = mill("[location]\nEC0Y = \"20 ± 1 urad\"\nEB0Z = \"5 urad\"");
        let new = mill("[location]\nEC0Y = \"30 ± 1 urad\"\nEA0Z = \"1 ± 1 urad\"");
        let found = calibrations(&old, &new).expect("one machine");
        let moved: Vec<_> = found.errors.iter().map(|e| (e.error.to_string(), e.moved)).collect();
        let is = |name: &str, moved| (name.to_owned(), moved);
        let known = [
            is("EC0Y", Significance::Yes),
            is("EA0Z", Significance::New),
            is("EB0Z", Significance::Gone),
        ];
        assert_eq!(moved, known);
        // 10 µrad over Y = 400 mm, and what EB0Z and EA0Z do over Z: below 2 µm.
        assert!((0.003..0.006).contains(&found.tip.largest_mm), "{}", found.tip.largest_mm);
        assert_eq!(found.tip.shares[0].error.to_string(), "EC0Y");
        assert!((found.tip.shares[0].largest_mm - 0.004).abs() < 4e-5);
    }

    fn normal(random: &mut ChaCha8Rng) -> f64 {
        StandardNormal.sample(random)
    }

    /// The rate of false alarms is that which is promised, among many errors.
    #[test]
    fn law_chance_moves_no_more_than_five_in_a_hundred_machines() {
        let names = ["EA0Y", "EC0Y", "EA0Z", "EB0Z", "EB0X", "EC0X", "EX0t", "EY0t", "EZ0t"];
        let mut random = ChaCha8Rng::seed_from_u64(20_261_122);
        let mut machine = || {
            let line = |name: &&str| {
                let unit = if "ABC".contains(&name[1..2]) { "urad" } else { "um" };
                format!("{name} = \"{:.4} ± 1.5 {unit}\"\n", 1.5 * normal(&mut random))
            };
            mill(&format!("[location]\n{}", names.iter().map(line).collect::<String>()))
        };
        let alarms = (0..2000)
            .filter(|_| {
                let (errors, _) = error_changes(&machine(), &machine()).expect("one machine");
                errors.iter().any(|e| e.moved == Significance::Yes)
            })
            .count();
        // 1 − (1 − 0.05/9)⁹ = 4.89 %: 97.8 of 2000, standard deviation 9.6; three of them.
        assert!((69..=127).contains(&alarms), "{alarms}");
    }

    #[test]
    fn other_chains_are_other_machines() {
        let text = "[machine]\nname = \"m\"\nchain = \"w X b Y Z t\"";
        let other = Machine::check("m.toml", text, &NoTables).0.expect("a machine");
        assert!(calibrations(&mill(""), &other).is_err());
    }

    #[test]
    fn of_many_errors_one_that_chance_may_do_has_not_moved() {
        let all = |values: [f64; 6]| {
            let names = ["EA0Y", "EC0Y", "EA0Z", "EB0Z", "EB0X", "EC0X"];
            let lines = names.iter().zip(values).map(|(n, v)| format!("{n} = \"{v} ± 1 urad\"\n"));
            mill(&format!("[location]\n{}", lines.collect::<String>()))
        };
        let old = all([0.0; 6]);
        // u(Δ) = 1.41 µrad: 3 µrad are 2.1 u, and the limit for six errors is 2.64 u.
        let found = calibrations(&old, &all([3.0, 0.0, 0.0, 0.0, 0.0, 4.0])).expect("one machine");
        let of = |name: &str| {
            let mut all = found.errors.iter();
            all.find(|e| e.error.to_string() == name).map(|e| e.moved)
        };
        assert!((found.limit - 2.638).abs() < 1e-3, "{}", found.limit);
        assert_eq!(
            (of("EA0Y"), of("EC0X")),
            (Some(Significance::Perhaps), Some(Significance::Yes))
        );
    }
}
