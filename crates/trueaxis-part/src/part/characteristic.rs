//! What a drawing asks of features.

use super::Feature;

/// The kind of a characteristic, ISO 1101 and ISO 14405-1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Of a plane: the distance of two parallel planes around all points.
    Flatness,
    /// Of the axis of a cylinder or cone: the smallest cylinder around its median line.
    Straightness,
    /// Of the lines of a plane along its first edge, of a cylinder or cone along its axis: the worst of them, each in the plane of the normals.
    LineStraightness,
    /// Of a cylinder or cone: the largest of its sections.
    Roundness,
    /// Of a cylinder.
    Cylindricity,
    /// Of a cylinder by least squares, its deviation from the nominal one: size (GG).
    Diameter,
    /// Of a slot or a tongue by least squares, the same.
    Width,
    /// Of any surface: the width of the zone about the nominal surface that holds all of it.
    Profile,
    /// Of the lines of a surface, each by itself in its plane: of a cylinder or cone those around, of others those along the first edge.
    LineProfile,
    /// Of a plane or an axis to datums, at the angle of the nominal part.
    Angularity,
    /// Of a plane or an axis to a datum.
    Parallelism,
    /// Of a plane or an axis to a datum.
    Perpendicularity,
    /// Of an axis about its nominal place, as a diameter; of a plane the width of the zone about it.
    Position,
    /// Of the middle of a slot or a tongue about that of a datum: the width of the zone.
    Symmetry,
    /// Of an axis about that of a datum, as a diameter.
    Coaxiality,
    /// Of the sections of a cylinder or cone about a datum axis: the largest range.
    CircularRunOut,
    /// The same of all sections of a cylinder together; of a plane across the axis along it.
    TotalRunOut,
}

/// What is allowed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Limits {
    /// Width or diameter of a zone.
    Zone {
        /// The tolerance.
        tolerance_mm: f64,
    },
    /// Deviations of a size.
    Size {
        /// The lower limit deviation.
        low_mm: f64,
        /// The upper limit deviation.
        high_mm: f64,
    },
}

/// A datum: a feature, or several that are one together, a common datum (ISO 5459).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Datum {
    /// The numbers of its features.
    pub features: Vec<usize>,
}

impl Datum {
    /// Its letter or name; of a common datum all of them: `A-B`.
    pub fn label(&self, features: &[Feature]) -> String {
        let labels: Vec<&str> = self.features.iter().map(|f| features[*f].label()).collect();
        labels.join("-")
    }

    /// The names of its features: `front-back`.
    pub fn name(&self, features: &[Feature]) -> String {
        let names: Vec<&str> = self.features.iter().map(|f| features[*f].name.as_str()).collect();
        names.join("-")
    }

    /// The only feature of it, if it is no common datum.
    pub fn single(&self) -> Option<usize> {
        match self.features[..] {
            [one] => Some(one),
            _ => None,
        }
    }
}

/// One line of the drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct Characteristic {
    /// Its name.
    pub name: String,
    /// What is asked.
    pub kind: Kind,
    /// The feature or the pattern that is meant.
    pub of: String,
    /// Its number, or those of the members of the pattern.
    pub features: Vec<usize>,
    /// To which datums, the first of them first; none: to the zero that was set.
    pub datums: Vec<Datum>,
    /// Of a projected zone, how far it reaches beyond the end of the axis; negative: beyond its beginning.
    pub projected_mm: Option<f64>,
    /// What is allowed.
    pub limits: Limits,
}

impl Kind {
    /// All of them.
    pub const ALL: [Self; 17] = [
        Self::Flatness,
        Self::Straightness,
        Self::LineStraightness,
        Self::Roundness,
        Self::Cylindricity,
        Self::Diameter,
        Self::Width,
        Self::Profile,
        Self::LineProfile,
        Self::Angularity,
        Self::Parallelism,
        Self::Perpendicularity,
        Self::Position,
        Self::Symmetry,
        Self::Coaxiality,
        Self::CircularRunOut,
        Self::TotalRunOut,
    ];

    /// Its name in files, reports and JSON.
    pub fn key(self) -> &'static str {
        match self {
            Self::Flatness => "flatness",
            Self::Straightness => "straightness",
            Self::LineStraightness => "line_straightness",
            Self::Roundness => "roundness",
            Self::Cylindricity => "cylindricity",
            Self::Diameter => "diameter",
            Self::Width => "width",
            Self::Profile => "profile",
            Self::LineProfile => "line_profile",
            Self::Angularity => "angularity",
            Self::Parallelism => "parallelism",
            Self::Perpendicularity => "perpendicularity",
            Self::Position => "position",
            Self::Symmetry => "symmetry",
            Self::Coaxiality => "coaxiality",
            Self::CircularRunOut => "circular_run_out",
            Self::TotalRunOut => "total_run_out",
        }
    }

    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::CircularRunOut => "circular run-out",
            Self::TotalRunOut => "total run-out",
            Self::LineStraightness => "straightness of lines",
            Self::LineProfile => "line profile",
            _ => self.key(),
        }
    }

    /// Whether it needs a datum.
    pub fn needs_datum(self) -> bool {
        matches!(
            self,
            Self::Parallelism
                | Self::Perpendicularity
                | Self::Angularity
                | Self::Symmetry
                | Self::Coaxiality
                | Self::CircularRunOut
                | Self::TotalRunOut
        )
    }

    /// Whether it is of the form or the size of a feature alone.
    pub fn is_alone(self) -> bool {
        !self.needs_datum() && !self.is_located()
    }

    /// Whether it is a deviation of a size, with two limits.
    pub fn is_size(self) -> bool {
        matches!(self, Self::Diameter | Self::Width)
    }

    /// Whether its zone has a place: the datums, or the zero that was set, fix all that would move it.
    pub fn is_located(self) -> bool {
        matches!(self, Self::Profile | Self::LineProfile | Self::Position | Self::Symmetry)
    }

    /// Whether its zone has a direction only.
    pub fn is_oriented(self) -> bool {
        matches!(self, Self::Parallelism | Self::Perpendicularity | Self::Angularity)
    }
}

impl Limits {
    /// The least value allowed, which a zone does not have, and the largest.
    pub fn ends_mm(&self) -> (Option<f64>, f64) {
        match *self {
            Self::Zone { tolerance_mm } => (None, tolerance_mm),
            Self::Size { low_mm, high_mm } => (Some(low_mm), high_mm),
        }
    }

    /// Whether a value is allowed, and how far it is from the nearest limit; negative outside.
    pub fn room_mm(&self, value_mm: f64) -> f64 {
        match *self {
            Self::Zone { tolerance_mm } => tolerance_mm - value_mm,
            Self::Size { low_mm, high_mm } => (high_mm - value_mm).min(value_mm - low_mm),
        }
    }

    /// How much of the tolerance is used, 1 at a limit. Unit: 1.
    pub fn used(&self, value_mm: f64) -> f64 {
        match *self {
            Self::Zone { tolerance_mm } => value_mm / tolerance_mm,
            Self::Size { low_mm, high_mm } => {
                (value_mm - 0.5 * (low_mm + high_mm)).abs() / (0.5 * (high_mm - low_mm))
            }
        }
    }
}
