//! The instruments of the shop by name: what each reads, and what its parts are called.

use super::element::Element;
use super::instrument::{SetupError, SetupUnknown, Sight};

/// An instrument of the shop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A 3-D probe in the spindle, its socket on a ball on the table (Lei and Hsu 2003), or an R-test.
    ProbeBall,
    /// A telescoping bar between two balls.
    BallBar,
    /// A touch-trigger probe that hits a ball: every row is a hit, the axes where it triggered.
    TouchProbeBall,
    /// The centre of a ball that a probing cycle found with the tool-centre-point control on: a row is a place in
    /// the workpiece frame.
    BallCentre,
    /// A touch-trigger probe that hits a face: every row is a hit, the axes where it triggered.
    TouchProbeFace,
    /// A laser along an axis: positioning, or straightness across it.
    LaserLine,
    /// Angles of a laser, an electronic level or an autocollimator.
    LaserAngle,
    /// A tracker or tracking interferometer that reads the distance to a reflector on the tool.
    LengthTracker,
    /// A straightedge or a face of a square under a dial gauge.
    Artefact,
    /// Features of a cut test piece, measured by a coordinate measuring machine.
    CutPiece,
    /// Points that lie on an element whose place is not known: hits, a gauge that is guided along it, or coordinates in
    /// any frame.
    Points(Element),
}

/// Every kind with its name in files.
const NAMES: [(Kind, &str); 15] = [
    (Kind::ProbeBall, "probe-ball"),
    (Kind::BallBar, "ball-bar"),
    (Kind::TouchProbeBall, "touch-probe-ball"),
    (Kind::BallCentre, "ball-centre"),
    (Kind::TouchProbeFace, "touch-probe-face"),
    (Kind::LaserLine, "laser-line"),
    (Kind::LaserAngle, "laser-angle"),
    (Kind::LengthTracker, "length-tracker"),
    (Kind::Artefact, "artefact"),
    (Kind::CutPiece, "cut-piece"),
    (Kind::Points(Element::Plane), "points-on-plane"),
    (Kind::Points(Element::Line), "points-on-line"),
    (Kind::Points(Element::Circle), "points-on-circle"),
    (Kind::Points(Element::Sphere), "points-on-sphere"),
    (Kind::Points(Element::Cylinder), "points-on-cylinder"),
];

impl Kind {
    /// All of them.
    pub fn all() -> impl Iterator<Item = Self> {
        NAMES.into_iter().map(|(kind, _)| kind)
    }

    /// By its name in files.
    pub fn find(name: &str) -> Option<Self> {
        NAMES.into_iter().find(|(_, n)| *n == name).map(|(kind, _)| kind)
    }

    /// Its name in files.
    pub fn name(self) -> &'static str {
        // why: every kind stands in the table, which the test below holds
        NAMES.into_iter().find(|(kind, _)| *kind == self).map_or("", |(_, name)| name)
    }

    /// What it reads.
    pub fn sight(self) -> Sight {
        match self {
            Self::ProbeBall => Sight::ProbeOffset,
            Self::BallBar | Self::TouchProbeBall | Self::LengthTracker => Sight::Distance,
            Self::TouchProbeFace | Self::LaserLine | Self::Artefact => Sight::Along,
            Self::LaserAngle => Sight::Turn,
            Self::BallCentre | Self::CutPiece => Sight::Place,
            Self::Points(element) => Sight::Element(element),
        }
    }

    /// The element on which its points lie.
    pub fn element(self) -> Option<Element> {
        match self {
            Self::Points(element) => Some(element),
            _ => None,
        }
    }

    /// Whether a row is a place where the probe triggered: the axes are the reading.
    pub fn triggers(self) -> bool {
        matches!(self, Self::TouchProbeBall | Self::TouchProbeFace)
    }

    /// Whether it reads surfaces of the workpiece, which grow with it. Light, and bodies of an instrument's own that stand on the
    /// table (balls, bars, straightedges), do not: they only stand elsewhere, which is their set-up.
    pub fn reads_the_workpiece(self) -> bool {
        matches!(self, Self::CutPiece | Self::TouchProbeFace | Self::Points(_))
    }

    /// Whether the tool stays on a ball, or one length away from it, while rotary axes turn.
    pub fn holds_a_ball(self) -> bool {
        matches!(self, Self::ProbeBall | Self::BallBar | Self::TouchProbeBall | Self::BallCentre)
    }

    /// Whether a row may be taken for the opposite: the numbers are the place of one thing seen from another.
    pub fn may_be_opposite(self) -> bool {
        matches!(self, Self::ProbeBall)
    }

    /// What `reads` may be: as it is defined, and the other way round.
    pub fn words_of_reads(self) -> [&'static str; 2] {
        match self {
            Self::ProbeBall | Self::BallCentre => ["ball", "tool"],
            _ => ["deviation", "correction"],
        }
    }

    /// What stands at the tool point.
    pub fn tool_point(self) -> &'static str {
        match self {
            Self::ProbeBall => "socket",
            Self::BallBar => "spindle_ball",
            Self::TouchProbeBall | Self::BallCentre | Self::TouchProbeFace | Self::Points(_) => {
                "stylus"
            }
            Self::LaserLine | Self::LaserAngle => "optics",
            Self::LengthTracker => "reflector",
            Self::Artefact => "gauge",
            Self::CutPiece => "tip",
        }
    }

    /// What stands at the reference point.
    pub fn reference_point(self) -> &'static str {
        match self {
            Self::ProbeBall | Self::TouchProbeBall | Self::BallCentre => "ball",
            Self::BallBar => "table_ball",
            Self::TouchProbeFace => "face",
            Self::LaserLine | Self::LaserAngle => "beam",
            Self::LengthTracker => "station",
            Self::Artefact => "artefact",
            Self::CutPiece => "datum",
            Self::Points(Element::Circle | Element::Sphere) => "centre",
            Self::Points(_) => "point",
        }
    }

    /// What its zero is called.
    pub fn zero(self) -> &'static str {
        match self {
            Self::BallBar => "length",
            Self::TouchProbeBall | Self::TouchProbeFace => "radius",
            Self::LengthTracker => "dead_path",
            Self::Points(element) if element.is_round() => "radius",
            _ => "zero",
        }
    }

    /// How many zeros it may have: one for each channel, of an element its radius alone.
    pub fn zeros(self) -> usize {
        match self {
            Self::Points(_) => 1,
            _ => self.sight().channels(),
        }
    }

    /// The headings of its readings without unit.
    pub fn channels(self) -> &'static [&'static str] {
        match self.sight() {
            Sight::ProbeOffset | Sight::Place => &["x", "y", "z"],
            Sight::Distance => &["length"],
            Sight::Along => &["deviation"],
            Sight::Turn => &["angle"],
            Sight::Element(element) => element.channels(),
        }
    }

    /// What is not known of its set-up unless a campaign says something else: all of it free.
    pub fn usual_setup(self) -> Vec<SetupUnknown> {
        let free = |error| SetupUnknown { name: self.unknown_name(error), error, prior_u: None };
        self.usual_unknowns().into_iter().map(free).collect()
    }

    /// What is unknown of its set-up unless the campaign states it.
    pub fn usual_unknowns(self) -> Vec<SetupError> {
        let point = [0, 1, 2].map(SetupError::ReferencePoint);
        let turn = [0, 1, 2].map(SetupError::ReferenceTurn);
        match self {
            Self::ProbeBall | Self::BallCentre => point.to_vec(),
            Self::BallBar | Self::TouchProbeBall | Self::LengthTracker => {
                [&point[..], &[SetupError::Zero(0)]].concat()
            }
            Self::TouchProbeFace | Self::LaserLine | Self::LaserAngle => vec![SetupError::Zero(0)],
            // How a straightedge lies is never known to the micrometre.
            Self::Artefact => [&turn[..], &[SetupError::Zero(0)]].concat(),
            Self::CutPiece => [point, turn].concat(),
            Self::Points(element) => {
                let shift = |of: &[usize]| of.iter().map(|i| SetupError::Shift(*i)).collect();
                let mut unknowns: Vec<SetupError> = match element {
                    Element::Plane => shift(&[2]),
                    Element::Line | Element::Cylinder => shift(&[0, 1]),
                    Element::Circle | Element::Sphere => point.to_vec(),
                };
                if element != Element::Sphere {
                    unknowns.extend([0, 1].map(SetupError::Tilt));
                }
                unknowns.extend(element.is_round().then_some(SetupError::Zero(0)));
                unknowns
            }
        }
    }

    /// The name of an unknown of its set-up, such as `ball_x`.
    pub fn unknown_name(self, error: SetupError) -> String {
        let axis = |i: usize| ["x", "y", "z"][i.min(2)];
        match error {
            SetupError::ToolPoint(i) => format!("{}_{}", self.tool_point(), axis(i)),
            SetupError::ReferencePoint(i) => format!("{}_{}", self.reference_point(), axis(i)),
            SetupError::ReferenceTurn(i) => {
                format!("{}_turn_{}", self.reference_point(), axis(i))
            }
            SetupError::Shift(i) => format!("shift_{}", ["1", "2", "n"][i.min(2)]),
            SetupError::Tilt(i) => format!("tilt_{}", i + 1),
            SetupError::Zero(i) if self.zeros() > 1 => {
                format!("{}_{}", self.zero(), axis(i))
            }
            SetupError::Zero(_) => self.zero().to_owned(),
            SetupError::Scale => "scale".to_owned(),
            SetupError::Material => "material".to_owned(),
            SetupError::Drift(i) => format!("drift_{}", axis(i)),
            SetupError::ZeroDrift => format!("{}_drift", self.zero()),
            SetupError::ToolDrift => format!("{}_drift_z", self.tool_point()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_is_found_by_its_name() {
        assert!(Kind::all().all(|kind| Kind::find(kind.name()) == Some(kind)));
        assert_eq!(Kind::find("ball-bar"), Some(Kind::BallBar));
    }
}
