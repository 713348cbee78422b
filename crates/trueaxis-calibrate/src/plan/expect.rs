//! What readings will determine: the uncertainty of every unknown, and what is not observable.

use super::remedy::remedies;
use nalgebra::DMatrix;
use serde::Serialize;
use trueaxis_measure::measure::{Campaign, Readings};
use trueaxis_measure::unknowns::confusion::Confusion;
use trueaxis_measure::unknowns::design::{Design, Unknown};
use trueaxis_measure::unknowns::determined::{Determined, members_that_matter};
use trueaxis_measure::unknowns::fit::{LEAST_SINGULAR_VALUE, normal_matrix, sight_of};
use trueaxis_measure::unknowns::stated::Stated;
use trueaxis_report::JsonSchema;

/// How large an error is taken to be where its effect is shown: 10 µm or 10 µrad, in mm and rad.
pub const USUAL_SIZE: f64 = 0.01;

/// What to expect of one unknown.
#[derive(Debug, Clone, PartialEq)]
pub struct Expected {
    /// Its number in the design.
    pub unknown: usize,
    /// Its name.
    pub name: String,
    /// Whether it is an angle (rad) and not a length (mm) or a plain number.
    pub is_angle: bool,
    /// The standard uncertainty to expect; `None` if it cannot be seen alone. Unit: mm, rad or 1.
    pub u: Option<f64>,
}

/// A combination of unknowns that changes no reading.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Unobservable {
    /// As a sum.
    pub combination: String,
    /// In words.
    pub words: String,
    /// A set-up that makes it observable; null if none of those tried does.
    pub resolve_with: Option<String>,
}

impl Unobservable {
    /// A combination with the set-up that resolves it.
    pub fn of(campaign: &Campaign, design: &Design, confusion: &Confusion) -> Self {
        let members = members_that_matter(design, &confusion.members);
        let short = Confusion { members };
        Self {
            combination: short.formula(design),
            words: short.words(design),
            resolve_with: remedies(campaign, design, confusion),
        }
    }
}

/// What to expect of a set of readings.
#[derive(Debug, Clone)]
pub struct Expectation {
    /// Every unknown, the machine's first.
    pub unknowns: Vec<Expected>,
    /// The combinations that are not observable.
    pub unobservable: Vec<Unobservable>,
    /// How many combinations are seen.
    pub rank: usize,
    /// The greatest over the smallest singular value that is seen. Unit: 1.
    pub condition: f64,
    /// The covariance of all unknowns over what is seen.
    pub covariance: DMatrix<f64>,
}

/// The uncertainties that these stations will give, by the stated noise of the instruments and what the machine file states with an
/// uncertainty.
pub fn expect(campaign: &Campaign, design: &Design, stations: &Readings) -> Expectation {
    let normal = normal_matrix(design, stations, &[]);
    let sight = sight_of(design, &normal, LEAST_SINGULAR_VALUE);
    let mut determined = Determined::expected(design, &sight);
    let moved = Stated::of(design, stations).moved((design, &sight), stations, &[]);
    determined.covariance += &moved * moved.transpose();
    let unknowns = (0..design.unknowns()).filter_map(|k| {
        let unknown = design.unknown(k)?;
        let u = determined.is_determined[k].then(|| determined.u(k));
        Some(Expected { unknown: k, name: unknown.name(), is_angle: unknown.is_angle(), u })
    });
    let unobservable = determined.confusions(design, &sight).into_iter();
    let unobservable = unobservable.map(|c| Unobservable::of(campaign, design, &c));
    Expectation {
        unknowns: unknowns.collect(),
        unobservable: unobservable.collect(),
        rank: sight.rank,
        condition: sight.condition(),
        covariance: determined.covariance,
    }
}

/// How a path sees one error of the machine.
#[derive(Debug, Clone, PartialEq)]
pub struct Seen {
    /// The name of the error.
    pub name: String,
    /// Whether the error is an angle.
    pub is_angle: bool,
    /// The largest |reading| of each channel along the path for an error of
    /// 10 µm or 10 µrad. Unit: mm or rad.
    pub largest: Vec<f64>,
}

/// What a path sees of each error of the machine, one at a time.
///
/// ```text
///     max over stations |∂reading/∂E| · 10 µm or 10 µrad                       docs/model.md eq. 111
/// ```
pub fn seen(design: &Design, stations: &Readings) -> Vec<Seen> {
    let n = design.unknowns();
    let mut rows = vec![0.0_f64; 3 * n];
    let mut largest = vec![[0.0_f64; 3]; n];
    let mut channels = 1;
    for i in 0..stations.len() {
        let count = design.slopes(stations, i, &mut rows);
        channels = channels.max(count);
        for (k, largest) in largest.iter_mut().enumerate() {
            for c in 0..count {
                largest[c] = largest[c].max(rows[c * n + k].abs());
            }
        }
    }
    let of = |(k, largest): (usize, [f64; 3])| {
        let unknown = design.unknown(k)?;
        if !matches!(unknown, Unknown::Term(_)) {
            return None;
        }
        // 10 µm in mm, 10 µrad in rad.
        let size = if unknown.is_angle() { USUAL_SIZE / 1e3 } else { USUAL_SIZE };
        let largest = largest.iter().take(channels).map(|v| v * size).collect();
        Some(Seen { name: unknown.name(), is_angle: unknown.is_angle(), largest })
    };
    largest.into_iter().enumerate().filter_map(of).collect()
}
