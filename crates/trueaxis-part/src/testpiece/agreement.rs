//! A measured index against the predicted one.

/// What a prediction and the measurements of one index have to do with each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Agreement {
    /// Mean of the measured values, mm.
    pub mean_mm: f64,
    /// Its standard uncertainty, mm.
    pub u_mean_mm: f64,
    /// Predicted over measured mean, as in Fig 20 of Wu et al. 2022.
    pub ratio_percent: f64,
    /// |measured − predicted| over the expanded uncertainty of this difference. Unit: 1.
    pub normalised: f64,
}

impl Agreement {
    /// Compares the parts that were cut with what was predicted for them; `None` without a measured value.
    ///
    /// ```text
    /// m̄ = Σ mᵢ/n      u²(m̄) = s²/n + u²       s of the n parts, u of the measuring machine, common to all
    /// ratio = 100 p/m̄      E_n = |m̄ − p| / (k √(u²(m̄) + u_p²))
    /// ```
    ///
    /// The measuring machine's u is not divided by √n: the same machine, probe and datum measured all parts.
    /// From one part s is not known and counts as 0.
    ///
    /// # Example
    /// ```
    /// use trueaxis_part::testpiece::agreement::Agreement;
    /// // Four parts, 0.0356 mm in the mean, against 0.029 mm.
    /// let parts = [0.0380, 0.0366, 0.0362, 0.0316];
    /// let found = Agreement::of((0.029, 0.001), (&parts, 0.001), 2.0).unwrap();
    /// assert!((found.mean_mm - 0.0356).abs() < 1e-12 && (found.ratio_percent - 81.46).abs() < 0.005);
    /// // s = 2.78 µm: u of the mean √(1.39² + 1) = 1.71 µm; 6.6/(2 √(1.71² + 1)) = 1.665: they do not agree.
    /// assert!((found.normalised - 1.6654).abs() < 0.001 && !found.agrees());
    /// ```
    /// # Source
    /// Wu et al. 2022, Table 4, Fig 20; JCGM 100:2008, 4.2.3; ISO/IEC 17043:2010, B.3.1.3 (E_n).
    pub fn of(
        (predicted_mm, u_predicted_mm): (f64, f64),
        (measured_mm, u_measured_mm): (&[f64], f64),
        coverage_factor: f64,
    ) -> Option<Self> {
        let count = measured_mm.len() as f64;
        let mean_mm = measured_mm.iter().sum::<f64>() / count;
        let squares: f64 = measured_mm.iter().map(|m| (m - mean_mm).powi(2)).sum();
        let spread = if count > 1.0 { squares / (count - 1.0) / count } else { 0.0 };
        let u_mean_mm = (spread + u_measured_mm * u_measured_mm).sqrt();
        let expanded = coverage_factor * u_mean_mm.hypot(u_predicted_mm);
        let off = (mean_mm - predicted_mm).abs();
        let normalised = match off {
            0.0 => 0.0,
            _ => off / expanded,
        };
        (!measured_mm.is_empty()).then_some(Self {
            mean_mm,
            u_mean_mm,
            ratio_percent: 100.0 * predicted_mm / mean_mm,
            normalised,
        })
    }

    /// Whether the difference is within its expanded uncertainty.
    pub fn agrees(&self) -> bool {
        self.normalised <= 1.0
    }
}
