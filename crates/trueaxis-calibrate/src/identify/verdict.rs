//! What became of an identification: whether its result may be trusted, and if not, why.

use super::errors::Identification;
use super::score::Score;
use trueaxis_measure::unknowns::design::Design;
use trueaxis_measure::unknowns::determined::Determined;
use trueaxis_measure::unknowns::fit::Fit;
use trueaxis_measure::unknowns::set_up::{SetUpDeviation, deviations};

/// Readings that fit to a smaller part of the noise without any error of the machine have another unit, or another noise.
pub const BELOW_NOISE: f64 = 0.1;
/// Fewer degrees of freedom fit well by chance. Unit: 1.
pub const LEAST_FREEDOM: f64 = 5.0;

/// What became of it.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// The residual on places that were held out is what the instrument repeats to.
    Explained,
    /// It is better on its own readings than on others.
    OverFitted,
    /// The residual is a smooth function of X, Y, Z; the share of its squares.
    FollowsPlaces(f64),
    /// The residual turns with a rotary axis: its letter and the share of the squares.
    TurnsWith(String, f64),
    /// The residual looks like a location error that is not listed; the share of the squares.
    Arrangement(f64),
    /// The residual depends on the direction of approach; the share of the squares.
    Reverses(f64),
    /// The residual grows with time; the share of the squares.
    Drifts(f64),
    /// So many numbers do not belong to the others.
    GrossReadings(usize),
    /// The residual follows none of these.
    Unexplained,
    /// A stage contradicts the stages before it; its name.
    StagesContradict(String),
    /// An instrument contradicts the others; its name.
    InstrumentsContradict(String),
    /// Without any error of the machine the readings keep to this part of the noise.
    BelowNoise(f64),
    /// What is stated of the set-up contradicts the readings: of which unknown, and by how much.
    SetUpContradicted(String),
}

impl Verdict {
    /// Whether the model may be trusted.
    pub fn is_good(&self) -> bool {
        *self == Self::Explained
    }

    /// In words.
    pub fn words(&self) -> String {
        match self {
            Self::Explained => "this model explains what can be explained".to_owned(),
            Self::OverFitted => {
                "this model is over-fitted: measure at more places, or seek less".to_owned()
            }
            Self::FollowsPlaces(share) => format!(
                "more remains than noise, and it follows machine XYZ (volumetric): {:.0} % of it",
                share * 100.0
            ),
            Self::TurnsWith(axis, share) => {
                format!(
                    "more remains than noise, and it turns with {axis}: {:.0} % of it",
                    share * 100.0
                )
            }
            Self::Arrangement(share) => format!(
                "more remains than noise, and {:.0} % of it looks like a location error that is not \
                 listed: location = \"minimal\" lists all",
                share * 100.0
            ),
            Self::Reverses(share) => format!(
                "more remains than noise, and {:.0} % of it depends on the direction of approach",
                share * 100.0
            ),
            Self::Drifts(share) => format!(
                "more remains than noise, and {:.0} % of it drifts with time: return to the first \
                 station, warm the machine up",
                share * 100.0
            ),
            Self::GrossReadings(1) => {
                "one number does not belong to the others: see the outliers, \
                                       correct it or delete its row"
                    .to_owned()
            }
            Self::GrossReadings(count) => format!(
                "{count} numbers do not belong to the others: see the outliers, correct them or delete \
                 their rows"
            ),
            Self::Unexplained => {
                "more remains than noise, and it follows neither the axes nor the \
                                  time: look at the instrument, at its noise, at conventions"
                    .to_owned()
            }
            Self::StagesContradict(stage) => format!(
                "stage `{stage}` contradicts what was known before: the result is a mean of two set-ups"
            ),
            Self::InstrumentsContradict(name) => format!(
                "instrument `{name}` contradicts the others: the result is a mean of what both say"
            ),
            Self::BelowNoise(part) => format!(
                "without any error of the machine the readings already fit to {part:.3} of the noise: another \
                 unit than the heading says, or `noise` is stated far too large"
            ),
            Self::SetUpContradicted(which) => {
                format!("the readings contradict what is stated of the set-up: {which}")
            }
        }
    }

    /// A word for programs.
    pub fn key(&self) -> &'static str {
        match self {
            Self::Explained => "explained",
            Self::OverFitted => "over-fitted",
            Self::FollowsPlaces(_) => "follows-xyz",
            Self::TurnsWith(..) => "turns-with-axis",
            Self::Arrangement(_) => "arrangement",
            Self::Reverses(_) => "reverses",
            Self::Drifts(_) => "drifts",
            Self::GrossReadings(_) => "gross-readings",
            Self::Unexplained => "unexplained",
            Self::StagesContradict(_) => "stages-contradict",
            Self::InstrumentsContradict(_) => "instruments-contradict",
            Self::BelowNoise(_) => "below-noise",
            Self::SetUpContradicted(_) => "set-up-contradicted",
        }
    }
}

impl Identification {
    /// Readings that can't be right are not explained, however well a model fits them.
    pub(super) fn doubted(&self, contradicting: Option<String>) -> Verdict {
        match (below_noise(&self.design, &self.fit, &self.score), contradicting) {
            (Some(part), _) => Verdict::BelowNoise(part),
            (None, Some(instrument)) if self.verdict.is_good() => {
                Verdict::InstrumentsContradict(instrument)
            }
            _ if self.verdict.is_good() => self.contradicted().unwrap_or(Verdict::Explained),
            _ => self.verdict.clone(),
        }
    }

    /// The statement of the set-up that the readings contradict most.
    fn contradicted(&self) -> Option<Verdict> {
        let times = |d: &&SetUpDeviation| (d.value / d.u).abs();
        let wrong = self.set_up.iter().filter(|d| d.is_contradicted());
        let d = wrong.max_by(|a, b| times(a).total_cmp(&times(b)))?;
        let instrument = &self.design.instruments[d.instrument].name;
        Some(Verdict::SetUpContradicted(format!(
            "`{}` of `{instrument}` is {:.1} {unit} from its stated value, and {:.1} {unit} is stated as its standard uncertainty",
            d.unknown,
            d.value,
            d.stated,
            unit = d.unit
        )))
    }
}

/// What the set-up alone leaves, as a part of the noise, where it is far smaller: a machine without errors would leave
/// the whole noise.
pub(super) fn below_noise(design: &Design, fit: &Fit, score: &Score) -> Option<f64> {
    let numbers = (fit.degrees_of_freedom + fit.sight.rank) as f64;
    let freedom = numbers - (design.unknowns() - design.terms.len()) as f64;
    let part = score.before.noise * (numbers / freedom).sqrt();
    (freedom >= LEAST_FREEDOM && part < BELOW_NOISE).then_some(part)
}

/// What is stated of the set-up against what was found, with all that widens its uncertainty (docs/model.md eq. 345).
pub(super) fn set_up(design: &Design, fit: &Fit, found: &Determined) -> Vec<SetUpDeviation> {
    let (first, count) = (design.terms.len(), design.unknowns() - design.terms.len());
    let own = fit.covariance.view((first, first), (count, count)).into_owned();
    let further = |k: usize| (found.seen[(first + k, first + k)] - own[(k, k)]).max(0.0);
    deviations(&design.instruments, &found.values[first..], &own, further)
}
