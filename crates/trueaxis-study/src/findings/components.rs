//! What differs from machine to machine, and what from day to day.
//!
//! ```text
//! y(m, d) = μ + machine(m) + day(d) + rest(m, d)
//! u²(machine) = (MS_machines − MS_rest)/D,   u²(day) = (MS_days − MS_rest)/M,   u²(rest) = MS_rest     docs/model.md eq. 343
//! ```
//!
//! *Source:* the analysis of variance of two crossed random effects without repetition (Searle, Casella, McCulloch, Variance
//! Components, 1992, chapter 4); a component below 0 is 0.

/// Standard deviations of the parts of an output.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Components {
    /// From machine to machine, on the mean of all days, mm.
    pub machines_mm: f64,
    /// From day to day, the same for all machines, mm.
    pub days_mm: f64,
    /// What is of a machine on a day alone, mm.
    pub rest_mm: f64,
}

impl Components {
    /// Of values machine after machine, each with its days; none for one machine or one day.
    pub fn of(values: &[f64], days: usize) -> Option<Self> {
        let machines = values.len() / days.max(1);
        if machines < 2 || days < 2 {
            return None;
        }
        let (m, d) = (machines as f64, days as f64);
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let of_machine: Vec<f64> =
            values.chunks(days).map(|row| row.iter().sum::<f64>() / d - mean).collect();
        let mut of_day = vec![0.0; days];
        for row in values.chunks(days) {
            of_day.iter_mut().zip(row).for_each(|(sum, value)| *sum += (value - mean) / m);
        }
        let rest = values.chunks(days).zip(&of_machine).map(|(row, machine)| {
            let left = |(value, day): (&f64, &f64)| (value - mean - machine - day).powi(2);
            row.iter().zip(&of_day).map(left).sum::<f64>()
        });
        let rest = rest.sum::<f64>() / ((m - 1.0) * (d - 1.0));
        let square = |effects: &[f64]| effects.iter().map(|e| e * e).sum::<f64>();
        let machines = d * square(&of_machine) / (m - 1.0);
        let days = m * square(&of_day) / (d - 1.0);
        Some(Self {
            machines_mm: ((machines - rest) / d).max(0.0).sqrt(),
            days_mm: ((days - rest) / m).max(0.0).sqrt(),
            rest_mm: rest.sqrt(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Components;

    /// By hand: three machines 0, 3, 6 and two days 0, 2, added: the variance of the machines is 9, of the days 2.
    #[test]
    fn what_is_added_is_found_apart() {
        let values = [0.0, 2.0, 3.0, 5.0, 6.0, 8.0];
        let found = Components::of(&values, 2).unwrap();
        assert!((found.machines_mm - 3.0).abs() < 1e-12);
        assert!((found.days_mm - 2f64.sqrt()).abs() < 1e-12);
        assert!(found.rest_mm < 1e-12);
        assert_eq!(Components::of(&values, 6), None);
        assert_eq!(Components::of(&values, 1), None);
    }
}
