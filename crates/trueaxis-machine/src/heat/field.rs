//! The temperature of a scale that is heated at a point, and its integral.
//!
//! ```text
//!     ∂²T/∂l² = 1/a ∂T/∂τ,   T(l, 0) = T∞,   −λ ∂T/∂l |₀ = q
//!     T(l, τ) = T∞ + 2q/λ √(aτ) ierfc(l/√(4aτ))                            docs/model.md eq. 82
//! ```
//!
//! DIFFERENCE: (001-5) the source calls the body infinitely long; the formula is that of a
//! half-infinite body under constant flux. DIFFERENCE: (001-6) a source inside the scale heats both
//! sides alike; q is the flux into one side. DIFFERENCE: (001-7) with a changing flux the formula
//! of the source is not exact: [`Source`] superposes steps (Duhamel).

use nalgebra::{DMatrix, DVector};

/// 1/√π, the value of ierfc at 0.
const IERFC_0: f64 = 0.564_189_583_547_756_3;

/// ierfc x = ∫ₓ^∞ erfc = e^(−x²)/√π − x erfc x, with 12 digits and more everywhere.
///
/// ```
/// use trueaxis_machine::heat::field::ierfc;
/// assert!((ierfc(0.0) - 0.5641895835477563).abs() < 1e-16); // 1/√π
/// ```
///
/// # Source
/// Abramowitz and Stegun 7.2; judged by mpmath.
pub fn ierfc(x: f64) -> f64 {
    if x < 0.0 {
        return ierfc(-x) - 2.0 * x;
    }
    if x < NEAR {
        return gauss(x) * IERFC_0 - x * erfc_near(x);
    }
    let [r0, r1, _] = ratios(x);
    2.0 * IERFC_0 * gauss(x) * r0 * r1
}

/// i²erfc x = ∫ₓ^∞ ierfc = (erfc x − 2x ierfc x)/4, with 12 digits and more everywhere.
///
/// # Source
/// Abramowitz and Stegun 7.2.5; judged by mpmath.
pub fn i2erfc(x: f64) -> f64 {
    if x < 0.0 {
        return 0.5 + x * x - i2erfc(-x);
    }
    if x < NEAR {
        return 0.25 * (erfc_near(x) - 2.0 * x * ierfc(x));
    }
    let [r0, r1, r2] = ratios(x);
    2.0 * IERFC_0 * gauss(x) * r0 * r1 * r2
}

/// Below, the differences above lose less than two digits; beyond, the fraction converges fast.
const NEAR: f64 = 1.0;

/// e^(−x²), the square without its rounding error.
fn gauss(x: f64) -> f64 {
    if x > 40.0 {
        return 0.0;
    }
    // The leading half of the digits squares exactly.
    let leading = f64::from_bits(x.to_bits() & !0x7ff_ffff);
    (-leading * leading).exp() * ((leading - x) * (leading + x)).exp()
}

/// erfc for 0 ≤ x < 1 from `erf x = 2/√π e^(−x²) Σ 2ⁿ x^(2n+1)/(2n+1)!!`, all terms positive.
fn erfc_near(x: f64) -> f64 {
    let (mut term, mut sum, mut n) = (x, x, 1.0);
    while term > 1e-18 * sum {
        term *= 2.0 * x * x / (2.0 * n + 1.0);
        sum += term;
        n += 1.0;
    }
    1.0 - 2.0 * IERFC_0 * gauss(x) * sum
}

/// iⁿerfc / iⁿ⁻¹erfc for n = 0, 1, 2 (i⁻¹erfc = 2/√π e^(−x²)), backwards from far up:
/// `rₙ₋₁ = 1/(2x + 2n rₙ)`, all terms positive.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "positive and at most a few thousand terms"
)]
fn ratios(x: f64) -> [f64; 3] {
    let terms = (20.0 + 180.0 / (x * x)) as usize;
    // Half the limit for n → ∞ is closer than 0.
    let mut ratio = 0.0;
    let mut kept = [0.0; 3];
    for n in (1..=terms + 3).rev() {
        ratio = 1.0 / (2.0 * x + 2.0 * n as f64 * ratio);
        if n <= 3 {
            kept[n - 1] = ratio;
        }
    }
    kept
}

/// A uniform scale heated at one place since some time, known from two sensors: one at the place,
/// one that the heat has not reached.
///
/// ```text
///     T(p) = T₂ + (T₁ − T₂)/ierfc 0 · ierfc(|p − l|/√(4aτ))               docs/model.md eq. 83
/// ```
///
/// # Source
/// Zhang et al. 2019, eq. 6 and 7.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeatedPoint {
    /// l: where the heat comes in, mm.
    pub place_mm: f64,
    /// T₁: the temperature there, °C.
    pub near_celsius: f64,
    /// T₂: the temperature far from there, °C.
    pub far_celsius: f64,
    /// a: thermal diffusivity, mm²/s.
    pub diffusivity_mm2_per_s: f64,
    /// τ: since when the flux has been constant, the scale uniform before, s.
    pub time_s: f64,
}

impl HeatedPoint {
    /// √(4aτ): how far the heat has come, mm.
    pub fn depth_mm(&self) -> f64 {
        (4.0 * self.diffusivity_mm2_per_s * self.time_s).sqrt()
    }

    /// The temperature at a position, °C.
    pub fn celsius_at(&self, p_mm: f64) -> f64 {
        let u = (p_mm - self.place_mm).abs() / self.depth_mm();
        self.far_celsius + (self.near_celsius - self.far_celsius) / IERFC_0 * ierfc(u)
    }

    /// ∫ (T − T_ref) ds from one position to another, mm·K, exactly.
    pub fn integral(&self, from_mm: f64, to_mm: f64, reference_celsius: f64) -> f64 {
        let rise = (self.near_celsius - self.far_celsius) / IERFC_0;
        let bump = heat_content(self.place_mm, self.depth_mm(), from_mm, to_mm);
        (self.far_celsius - reference_celsius) * (to_mm - from_mm) + rise * bump
    }
}

/// ∫ ierfc(|s − l|/L) ds from one position to another: differences of i²erfc.
fn heat_content(place: f64, depth: f64, from: f64, to: f64) -> f64 {
    // The integral from the place outwards, with the sign of the side.
    let outwards = |s: f64| {
        let d = s - place;
        depth * (0.25 - i2erfc(d.abs() / depth)).copysign(d)
    };
    outwards(to) - outwards(from)
}

/// What a strength of 1 K/mm since some time makes of the temperature at a distance, mm.
pub(super) fn strength_to_rise(distance_mm: f64, diffusivity_mm2_per_s: f64, age_s: f64) -> f64 {
    let depth_mm = (4.0 * diffusivity_mm2_per_s * age_s).sqrt();
    // At the place itself, the commonest case, the series is known.
    let shape = if distance_mm == 0.0 { IERFC_0 } else { ierfc(distance_mm.abs() / depth_mm) };
    depth_mm * shape
}

/// Heat into a scale at one place, in steps of constant flux.
#[derive(Debug, Clone, PartialEq)]
pub struct Source {
    /// Where, mm.
    pub place_mm: f64,
    /// From when (s, rising), and the surface strength from then on: q/λ into one side, K/mm.
    pub steps: Vec<(f64, f64)>,
}

impl Source {
    /// The steps of the flux for which the temperature rise at the place itself is that of a log.
    ///
    /// ```text
    ///     ΔT(tₙ) = 2 √(a/π) Σ_{k<n} (gₖ − gₖ₋₁) √(tₙ − tₖ),  g = q/λ           docs/model.md eq. 85
    /// ```
    ///
    /// solved for one step after the other; the first row is the uniform state.
    ///
    /// `None` if the times do not rise.
    pub fn from_rise(
        place_mm: f64,
        diffusivity_mm2_per_s: f64,
        times_s: &[f64],
        rise_k: &[f64],
    ) -> Option<Self> {
        Self::from_rises(&[place_mm], diffusivity_mm2_per_s, times_s, &[rise_k.to_vec()])?.pop()
    }

    /// The same for several places, each of which is also subject to the heat of the others.
    ///
    /// ```text
    ///     Σⱼ 2 √(aδ) ierfc(|lᵢ − lⱼ|/√(4aδ)) Δgⱼ = ΔTᵢ(t) − what the earlier steps make of it
    /// ```
    ///
    /// with δ the length of the step, `rises_k` place by place; docs/model.md eq. 97.
    ///
    /// `None` if the times do not rise or two places are one.
    pub fn from_rises(
        places_mm: &[f64],
        diffusivity_mm2_per_s: f64,
        times_s: &[f64],
        rises_k: &[Vec<f64>],
    ) -> Option<Vec<Self>> {
        let count = places_mm.len();
        let shape = |i: usize, j: usize, age_s: f64| {
            strength_to_rise(places_mm[i] - places_mm[j], diffusivity_mm2_per_s, age_s)
        };
        let mut times: Vec<f64> = Vec::with_capacity(times_s.len());
        let mut changes: Vec<Vec<f64>> = vec![Vec::with_capacity(times_s.len()); count];
        for (n, window) in times_s.windows(2).enumerate() {
            let (from, now) = (window[0], window[1]);
            if from >= now {
                return None;
            }
            let missing = DVector::from_fn(count, |i, _| {
                let mut past = 0.0;
                for (j, changes) in changes.iter().enumerate() {
                    let earlier = times.iter().zip(changes);
                    past += earlier.map(|(t, g)| g * shape(i, j, now - t)).sum::<f64>();
                }
                rises_k.get(i).and_then(|r| r.get(n + 1)).map_or(f64::NAN, |rise| rise - past)
            });
            let coupling = DMatrix::from_fn(count, count, |i, j| shape(i, j, now - from));
            let found = coupling.lu().solve(&missing)?;
            if !found.iter().all(|g| g.is_finite()) {
                return None;
            }
            times.push(from);
            for (changes, g) in changes.iter_mut().zip(found.iter()) {
                changes.push(*g);
            }
        }
        let source = |(place_mm, changes): (&f64, &Vec<f64>)| {
            let mut strength = 0.0;
            let steps = times.iter().zip(changes).map(|(t, g)| {
                strength += g;
                (*t, strength)
            });
            Self { place_mm: *place_mm, steps: steps.collect() }
        };
        Some(places_mm.iter().zip(&changes).map(source).collect())
    }

    /// Constant fluxes, each since its own age before time 0, that make the rises at their places
    /// the present readings of the sensors there.
    ///
    /// ```text
    ///     Tᵢ − T∞ = Σⱼ 2 gⱼ √(aτⱼ) ierfc(|lᵢ − lⱼ|/√(4aτⱼ))                   docs/model.md eq. 96
    /// ```
    ///
    /// `None` if two places are one.
    pub fn constant(
        places_mm: &[f64],
        diffusivity_mm2_per_s: f64,
        ages_s: &[f64],
        rises_k: &[f64],
    ) -> Option<Vec<Self>> {
        let count = places_mm.len();
        let coupling = DMatrix::from_fn(count, count, |i, j| {
            let age_s = ages_s.get(j).copied().unwrap_or(f64::NAN);
            strength_to_rise(places_mm[i] - places_mm[j], diffusivity_mm2_per_s, age_s)
        });
        let rises = DVector::from_fn(count, |i, _| rises_k.get(i).copied().unwrap_or(f64::NAN));
        let found = coupling.lu().solve(&rises)?;
        let sound = found.iter().all(|g| g.is_finite());
        let source = |((place_mm, age_s), g): ((&f64, &f64), &f64)| Self {
            place_mm: *place_mm,
            steps: vec![(-age_s, *g)],
        };
        sound.then(|| places_mm.iter().zip(ages_s).zip(found.iter()).map(source).collect())
    }

    /// The strength at a time, K/mm.
    pub fn strength_at(&self, time_s: f64) -> f64 {
        let past = self.steps.partition_point(|(t, _)| *t <= time_s);
        past.checked_sub(1).map_or(0.0, |i| self.steps[i].1)
    }

    /// The changes of strength before a time: since when, and by how much.
    fn changes(&self, time_s: f64) -> impl Iterator<Item = (f64, f64)> {
        let before = std::iter::once(0.0).chain(self.steps.iter().map(|s| s.1));
        let past = self.steps.iter().zip(before).filter(move |((t, _), _)| *t < time_s);
        past.map(move |((t, g), before)| (time_s - t, g - before))
    }
}

/// A scale, uniform at first, with several sources: their fields add up (the equation is linear).
#[derive(Debug, Clone, PartialEq)]
pub struct ScaleField {
    /// The uniform temperature at first and far away, °C.
    pub initial_celsius: f64,
    /// a: thermal diffusivity, mm²/s.
    pub diffusivity_mm2_per_s: f64,
    /// The sources.
    pub sources: Vec<Source>,
}

impl ScaleField {
    /// The temperature at a position and time, °C.
    ///
    /// ```text
    ///     T = T∞ + Σ sources Σ steps 2 Δg √(aτ) ierfc(|p − l|/√(4aτ)),  τ = t − tₖ      docs/model.md eq. 84
    /// ```
    pub fn celsius_at(&self, p_mm: f64, time_s: f64) -> f64 {
        self.summed(time_s, |place, depth| ierfc((p_mm - place).abs() / depth))
            + self.initial_celsius
    }

    /// ∫ (T − T_ref) ds from one position to another at a time, mm·K, exactly.
    pub fn integral(&self, time_s: f64, [from_mm, to_mm]: [f64; 2], reference_celsius: f64) -> f64 {
        let uniform = (self.initial_celsius - reference_celsius) * (to_mm - from_mm);
        uniform + self.summed(time_s, |place, depth| heat_content(place, depth, from_mm, to_mm))
    }

    /// Distance that the heat of the oldest step has reached, mm.
    pub fn depth_mm(&self, time_s: f64) -> f64 {
        let ages = self.sources.iter().flat_map(|s| s.changes(time_s)).map(|c| c.0);
        (4.0 * self.diffusivity_mm2_per_s * ages.fold(0.0, f64::max)).sqrt()
    }

    fn summed(&self, time_s: f64, shape: impl Fn(f64, f64) -> f64) -> f64 {
        let mut sum = 0.0;
        for source in &self.sources {
            for (age, change) in source.changes(time_s) {
                let depth = (4.0 * self.diffusivity_mm2_per_s * age).sqrt();
                sum += change * depth * shape(source.place_mm, depth);
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn at_the_heated_end_the_near_sensor_is_right_and_far_away_the_far_one() {
        let field = HeatedPoint {
            place_mm: 100.0,
            near_celsius: 34.0,
            far_celsius: 26.0,
            diffusivity_mm2_per_s: 4.0,
            time_s: 900.0,
        };
        assert!((field.celsius_at(100.0) - 34.0).abs() < 1e-13);
        assert!((field.celsius_at(3000.0) - 26.0).abs() < 1e-13);
        // √(4·4·900) = 120 mm; the heat to one side: (8/ierfc 0)·120·i²erfc 0 = 240·√π mm K
        let extra = field.integral(100.0, 5000.0, 26.0);
        assert!((extra - 240.0 * PI.sqrt()).abs() < 1e-10);
    }

    #[test]
    fn a_scale_without_heat_is_as_warm_as_at_first() {
        let (initial_celsius, sources) = (25.0, Vec::new());
        let field = ScaleField { initial_celsius, diffusivity_mm2_per_s: 4.0, sources };
        assert_eq!(field.celsius_at(200.0, 60.0), 25.0);
        // 5 K over 200 mm
        assert_eq!(field.integral(60.0, [100.0, 300.0], 20.0), 1000.0);
        assert_eq!(field.integral(60.0, [300.0, 100.0], 20.0), -1000.0);
    }
}
