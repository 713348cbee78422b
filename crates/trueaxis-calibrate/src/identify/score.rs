//! How well a model does: in sample, held out, against the floor, against no model.

use super::adequacy::Scatter;
use trueaxis_measure::measure::Readings;
use trueaxis_measure::measure::repeats::places;
use trueaxis_measure::unknowns::design::Design;

/// Fewer repeats say little of the noise.
const LEAST_REPEATS: f64 = 10.0;

/// Root mean squares of residuals.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Rms {
    /// Of all numbers, in units of their stated noise. Unit: 1.
    pub noise: f64,
    /// Of lengths, mm; none if nothing read a length.
    pub length_mm: Option<f64>,
    /// Of angles, rad; none if nothing read an angle.
    pub angle_rad: Option<f64>,
}

impl Rms {
    /// Of these residuals.
    pub fn of(design: &Design, readings: &Readings, residuals: &[[f64; 3]]) -> Self {
        let (mut noise, mut length, mut angle) =
            (Mean::default(), Mean::default(), Mean::default());
        for (i, residual) in residuals.iter().enumerate() {
            let instrument = &design.instruments[readings.instruments[i] as usize];
            let kind = if instrument.sight.is_angle() { &mut angle } else { &mut length };
            for (r, u) in residual.iter().zip(instrument.noise).take(instrument.sight.channels()) {
                noise.add(r / u, 1.0);
                kind.add(*r, 1.0);
            }
        }
        Self {
            noise: noise.root().unwrap_or(0.0),
            length_mm: length.root(),
            angle_rad: angle.root(),
        }
    }
}

#[derive(Default)]
struct Mean {
    sum: f64,
    count: f64,
}

impl Mean {
    /// Adds a residual that counts as that many degrees of freedom.
    fn add(&mut self, r: f64, freedom: f64) {
        self.sum += r * r;
        self.count += freedom;
    }

    fn root(&self) -> Option<f64> {
        (self.count > 0.0).then(|| (self.sum / self.count).sqrt())
    }
}

/// The residuals, mm or rad.
#[derive(Debug, Clone, PartialEq)]
pub struct Residuals {
    /// Of the machine without the unknown errors; only the set-ups were fitted. Unit: mm or rad.
    pub before: Vec<[f64; 3]>,
    /// Of the model on the readings that it was found from. Unit: mm or rad.
    pub after: Vec<[f64; 3]>,
    /// Of models that were found without the place. Unit: mm or rad.
    pub held_out: Vec<[f64; 3]>,
}

/// The residuals side by side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Score {
    /// On the readings that the model was found from.
    pub in_sample: Rms,
    /// On places that were held out.
    pub held_out: Rms,
    /// What the instrument repeats to; the stated noise if nothing was repeated.
    pub floor: Rms,
    /// Whether the floor was measured.
    pub floor_is_measured: bool,
    /// Without the unknown errors; only the set-ups were fitted.
    pub before: Rms,
}

impl Score {
    /// Side by side.
    pub fn of(
        design: &Design,
        readings: &Readings,
        residuals: &Residuals,
        measured: Option<Rms>,
    ) -> Self {
        let rms = |r: &[[f64; 3]]| Rms::of(design, readings, r);
        let stated: Vec<[f64; 3]> = (0..readings.len())
            .map(|i| design.instruments[readings.instruments[i] as usize].noise)
            .collect();
        Self {
            in_sample: rms(&residuals.after),
            held_out: rms(&residuals.held_out),
            floor: measured.unwrap_or_else(|| rms(&stated)),
            floor_is_measured: measured.is_some(),
            before: rms(&residuals.before),
        }
    }
}

/// The scatter of readings that were repeated in the same place, if ten or more were, and all of it as squares. Of what
/// drifted in between only the residual counts: the rest of a reading is the same in the same place.
pub fn repeatability(
    design: &Design,
    readings: &Readings,
    weights: &[f64],
    residuals: &[[f64; 3]],
) -> (Option<Rms>, Option<Scatter>) {
    // Of a touch probe the axes are the reading: no two are the same.
    let triggers = |i: usize| design.instruments[readings.instruments[i] as usize].kind.triggers();
    let places = places(readings, |i| weights.get(i) != Some(&0.0) && !triggers(i));
    let (mut noise, mut length, mut angle) = (Mean::default(), Mean::default(), Mean::default());
    for rows in places.iter().filter(|rows| rows.len() > 1) {
        let instrument = &design.instruments[readings.instruments[rows[0]] as usize];
        let kind = if instrument.sight.is_angle() { &mut angle } else { &mut length };
        let freedom = (rows.len() - 1) as f64 / rows.len() as f64;
        let value = |i: usize, c: usize| match instrument.has_rate() {
            true => residuals[i][c],
            false => readings.values[i][c],
        };
        for c in 0..instrument.sight.channels() {
            let mean = rows.iter().map(|i| value(*i, c)).sum::<f64>() / rows.len() as f64;
            for i in rows {
                let r = value(*i, c) - mean;
                noise.add(r / instrument.noise[c], freedom);
                kind.add(r, freedom);
            }
        }
    }
    let enough = noise.count >= LEAST_REPEATS;
    let rms = || Rms {
        noise: noise.root().unwrap_or(0.0),
        length_mm: length.root(),
        angle_rad: angle.root(),
    };
    let scatter = || Scatter { square: noise.sum, freedom: noise.count };
    (enough.then(rms), enough.then(scatter))
}
