//! Into how many pieces a move is cut.

/// How finely moves are cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Densify {
    /// One piece per move; circles are still cut by the chord tolerance.
    Off,
    /// Jiang et al.: as many pieces as the spacing of tips and the angle of tool axes ask for.
    Count {
        /// λ, mm.
        spacing_mm: f64,
        /// φ, rad.
        angle_rad: f64,
    },
    /// No piece leaves the programmed path by more than a tolerance, turns the tool by more than
    /// an angle, or is longer than a spacing.
    Tolerance {
        /// Between path and chord, mm.
        chord_mm: f64,
        /// Of the tool axis and of each rotary axis, rad.
        angle_rad: f64,
        /// The longest piece, mm: errors vary along straight lines too.
        spacing_mm: f64,
    },
    /// As [`Densify::Tolerance`], for uses that need the tool and not how the axes move from point
    /// to place: lines of the tip are not cut because straight axes would leave them.
    Places {
        /// Between circles and their chords, mm.
        chord_mm: f64,
        /// Of the tool axis and of each rotary axis, rad.
        angle_rad: f64,
        /// The longest piece, mm.
        spacing_mm: f64,
        /// Each move at least into this number of pieces.
        least: u32,
    },
    /// For what a tool passes through: from place to place its tip goes straight in the workpiece and its axis turns evenly. Lines of
    /// the tip are cut only where the axis would turn otherwise; moves of the axes also where the tip goes round.
    Tool {
        /// Between the way of the tool and that chord, at its tip and so far up its axis, mm.
        chord_mm: f64,
        /// How far up the axis, mm.
        reach_mm: f64,
        /// Of the tool axis and of each rotary axis, rad.
        angle_rad: f64,
        /// The longest piece, mm.
        spacing_mm: f64,
    },
}

impl Default for Densify {
    fn default() -> Self {
        Self::Tolerance { chord_mm: 0.005, angle_rad: 1_f64.to_radians(), spacing_mm: 10.0 }
    }
}

/// Largest number of pieces of a move; more means that a unit is wrong.
pub(super) const MOST_PIECES: f64 = 1e6;

/// ⌈ratio⌉, at least 1; a ratio within 1e-9 of a whole number counts as that number.
///
/// ```text
///     q = max(⌈d/λ⌉, ⌈angle/φ⌉)                                     docs/model.md eq. 37
/// ```
pub fn pieces(ratio: f64) -> f64 {
    let whole = ratio.round();
    let counted = if (ratio - whole).abs() <= 1e-9 { whole } else { ratio.ceil() };
    // A ratio that is not a number (0/0) needs no cut.
    if counted >= 1.0 { counted.min(MOST_PIECES) } else { 1.0 }
}

impl Densify {
    /// The pieces for a tip that travels `length_mm` and a tool axis (or rotary axis, whichever is
    /// more) that turns by `turned_rad`.
    pub(super) fn count(&self, length_mm: f64, turned_rad: f64) -> f64 {
        match *self {
            Self::Off => 1.0,
            Self::Count { spacing_mm, angle_rad }
            | Self::Tolerance { spacing_mm, angle_rad, .. }
            | Self::Tool { spacing_mm, angle_rad, .. } => {
                pieces(length_mm / spacing_mm).max(pieces(turned_rad / angle_rad))
            }
            Self::Places { spacing_mm, angle_rad, least, .. } => {
                let count = pieces(length_mm / spacing_mm).max(pieces(turned_rad / angle_rad));
                count.max(f64::from(least))
            }
        }
    }

    /// How far a rotary axis may turn in a piece, rad, and how far straight axes may lead the tip off
    /// its line, mm.
    pub(super) fn limits_of_pieces(&self) -> Option<(f64, f64)> {
        match *self {
            Self::Off | Self::Count { .. } => None,
            Self::Tolerance { chord_mm, angle_rad, .. } => Some((angle_rad, chord_mm)),
            Self::Places { angle_rad, .. } | Self::Tool { angle_rad, .. } => {
                Some((angle_rad, f64::INFINITY))
            }
        }
    }

    /// How far the tool may be from its chord, mm, and how far up its axis that counts, mm.
    pub(super) fn limits_of_tool(&self) -> Option<[f64; 2]> {
        match *self {
            Self::Tool { chord_mm, reach_mm, .. } => Some([chord_mm, reach_mm]),
            _ => None,
        }
    }

    /// The tolerance for circles.
    pub(super) fn circle_chord_mm(&self) -> Option<f64> {
        match *self {
            Self::Off => Some(0.005),
            Self::Count { .. } => None,
            Self::Tolerance { chord_mm, .. }
            | Self::Places { chord_mm, .. }
            | Self::Tool { chord_mm, .. } => Some(chord_mm),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_by_hand() {
        let counted = [0.0, 0.3, 1.0, 1.0 + 1e-10, 1.0 + 1e-8, 99.5, f64::NAN].map(pieces);
        assert_eq!(counted, [1.0, 1.0, 1.0, 1.0, 2.0, 100.0, 1.0]);
        let by = Densify::Count { spacing_mm: 0.5, angle_rad: 0.01 };
        assert_eq!(by.count(10.0, 0.1), 20.0);
        assert_eq!(by.count(1.0, 0.1), 10.0);
    }
}
