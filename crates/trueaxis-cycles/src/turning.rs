//! Turning of a profile on a lathe: layer by layer, and along it.
//!
//! A tool comes from a start to the profile, the *way in*, and goes on along it. The plane has two directions:
//! *along*, in which the passes go and the profile never turns back, and *out*, away from the material. Passes lie
//! at equal steps from the height of the start inwards. Wherever the path to and along the profile falls below
//! such a height, a pass begins: straight on at this height until the profile is met, off it, back, and further
//! down. A *pocket* is where the profile falls again after it did not.
//!
//! The rules are those of G70 to G72.2 of LinuxCNC: its user manual 2.9, "G70 Lathe finishing cycle", "G71 G72 Lathe
//! roughing cycles"; what it leaves open was seen in the moves of its interpreter `rs274`
//! (`oracles/linuxcnc_lathe.py`).

mod parallel;
mod passes;
mod stretch;

use std::fmt;

use trueaxis_contour::Element;
use trueaxis_contour::corner::{Shape, transition};
use trueaxis_contour::plane::{Point, cross, dot, minus};

pub use stretch::Stretch;

/// Stretches of one profile: more than any program means.
const MOST_STRETCHES: usize = 1000;

/// Arcs about a corner shorter than so many times the tolerance are left out.
const SHORT: f64 = 10.0;

/// What is inserted at the end of a stretch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    /// The radius of the rounding, mm.
    pub radius_mm: f64,
    /// A line between the ends that the rounding would have.
    pub straight: bool,
}

/// In which direction the passes go.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Passes {
    /// Along the first axis of the plane (Z of a lathe).
    First,
    /// Along the second one (X).
    Second,
}

/// Which part of the material is removed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pockets {
    /// All of it.
    Cut,
    /// Up to the first pocket; pockets are passed over.
    Left,
    /// From the first pocket on.
    Only,
}

/// How a profile is roughed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Roughing {
    /// The direction of the passes.
    pub passes: Passes,
    /// What remains on the profile, mm.
    pub leave_mm: f64,
    /// From one pass to the next, mm.
    pub step_mm: f64,
    /// How far the tool goes off after a pass, mm; half of the pass if it is shorter than twice that.
    pub retract_mm: f64,
    /// What happens to pockets.
    pub pockets: Pockets,
}

/// One move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TurnMove {
    /// The end. Unit: mm.
    pub to: Point,
    /// Whether it cuts.
    pub rapid: bool,
    /// Centre and sense (counter-clockwise) of an arc. Unit: mm.
    pub arc: Option<(Point, bool)>,
}

/// The moves along a profile.
#[derive(Debug, Clone, PartialEq)]
pub struct Turned {
    /// In their order, from the start on.
    pub moves: Vec<TurnMove>,
    /// The distance to the profile was taken on the side of the material: the control takes the side from the
    /// turn between the way in and the direction of the last stretch.
    pub inside: bool,
}

/// Why a profile cannot be turned.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TurningError {
    /// It turns back in the direction of the passes.
    TurnsBack,
    /// A rounding or chamfer does not fit.
    Corner,
    /// There is no curve at the distance from it.
    Distance,
    /// Two lines along an axis continue each other, at a distance from them.
    Parallel,
    /// An arc leads to it, and the profile does not begin at its end.
    ArcIn,
    /// A pocket has no far side.
    Open,
    /// More passes or stretches than any part has.
    TooMany,
}

impl fmt::Display for TurningError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::TurnsBack => "the profile turns back in the direction of the passes",
            Self::Corner => "a rounding (A) or chamfer (C) does not fit between its neighbours",
            Self::Distance => {
                "the profile is too narrow for the distance, or its first or last element too short"
            }
            Self::Parallel => "two lines along X or Z continue each other, and the control shifts no such lines: make \
                one of them",
            Self::ArcIn => {
                "the way to the profile is an arc, and the cycle changes where it begins or ends"
            }
            Self::Open => "a pocket has no far side: the control goes on without end",
            Self::TooMany => {
                "the cycle has more passes or its profile more elements than are possible"
            }
        })
    }
}

impl std::error::Error for TurningError {}

/// A way in and a profile, in the plane of the machine.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    /// Connected; the first one is the way in. None is empty.
    stretches: Vec<Stretch>,
    /// By how much it may turn back, mm.
    tolerance_mm: f64,
}

impl Profile {
    /// From connected stretches, the first of which comes from where the tool is, with what is inserted at their
    /// ends. Those that lead nowhere are left out.
    ///
    /// # Errors
    /// Where something to be inserted does not fit.
    pub fn new(
        written: &[(Stretch, Option<Corner>)],
        tolerance_mm: f64,
    ) -> Result<Self, TurningError> {
        if written.len() > MOST_STRETCHES {
            return Err(TurningError::TooMany);
        }
        let mut stretches: Vec<Stretch> = Vec::new();
        let mut corner: Option<Corner> = None;
        for (stretch, next_corner) in written.iter().filter(|(s, _)| !s.is_empty()) {
            let mut stretch = *stretch;
            if let (Some(corner), Some(last)) = (corner, stretches.last_mut()) {
                let inserted = insert(last, &mut stretch, corner)?;
                stretches.push(inserted);
            }
            stretches.push(stretch);
            corner = *next_corner;
        }
        stretches.retain(|s| !s.is_empty());
        Ok(Self { stretches, tolerance_mm })
    }

    /// The moves that remove the material in layers, and then go along the profile.
    ///
    /// # Errors
    /// Where the profile does not allow it.
    pub fn rough(&self, how: &Roughing) -> Result<Turned, TurningError> {
        let Some((view, path)) = self.seen(how.passes)? else { return Ok(self.nothing()) };
        let (path, inside) = self.at_distance(path, how.leave_mm)?;
        let moves = passes::roughing(&path, how)?;
        Ok(Turned { moves: view.back(moves), inside })
    }

    /// The moves along the profile at a distance.
    ///
    /// # Errors
    /// Where the profile does not allow it.
    pub fn finish(&self, distance_mm: f64) -> Result<Turned, TurningError> {
        let first = self.seen(Passes::First);
        let seen =
            if first == Err(TurningError::TurnsBack) { self.seen(Passes::Second) } else { first };
        let Some((view, path)) = seen? else { return Ok(self.nothing()) };
        let start = path[0].from;
        let (path, inside) = self.at_distance(path, distance_mm)?;
        let rapid = |to| TurnMove { to, rapid: true, arc: None };
        let mut moves = vec![rapid(start), rapid(path[0].to)];
        moves.extend(path[1..].iter().map(|s| TurnMove { to: s.to, rapid: false, arc: s.arc }));
        Ok(Turned { moves: view.back(moves), inside })
    }

    /// A profile without any element after the way in: the tool stays at the start.
    fn nothing(&self) -> Turned {
        Turned { moves: Vec::new(), inside: false }
    }

    /// The path, seen with the first coordinate along and the second one out; the way in begins where the profile
    /// does, if the tool is farther along. `None` if there is no profile.
    fn seen(&self, passes: Passes) -> Result<Option<(View, Vec<Stretch>)>, TurningError> {
        let [way, .., last] = &self.stretches[..] else { return Ok(None) };
        let view = View::new(passes, way.to, last.to);
        let mut path: Vec<Stretch> = self.stretches.iter().map(|s| view.stretch(s)).collect();
        let begins = path[0].to[0];
        if path[0].from[0] > begins {
            if path[0].arc.is_some() {
                return Err(TurningError::ArcIn);
            }
            path[0].from[0] = begins;
        }
        if path[usize::from(path[0].arc.is_none())..].iter().any(|s| self.turns_back(s)) {
            return Err(TurningError::TurnsBack);
        }
        Ok(Some((view, path)))
    }

    /// The way in and the profile at a distance from the written one, and whether on the side of the material.
    fn at_distance(
        &self,
        path: Vec<Stretch>,
        distance: f64,
    ) -> Result<(Vec<Stretch>, bool), TurningError> {
        let (way, last) = (path[0], path[path.len() - 1]);
        // On the side of the start: it is the left one if the way in turns left to the start of the last stretch.
        let turn = cross(minus(way.to, way.from), minus(last.from, way.from));
        let left = if turn < 0.0 { -distance } else { distance };
        if distance == 0.0 {
            return Ok((path, false));
        }
        if way.arc.is_some() {
            return Err(TurningError::ArcIn);
        }
        let along = |s: &Stretch| s.arc.is_none().then(|| minus(s.to, s.from));
        let goes_on = |p: &[Stretch]| match (along(&p[0]), along(&p[1])) {
            (Some(a), Some(b)) => {
                [0, 1].iter().any(|n| a[*n] == 0.0 && b[*n] == 0.0) && dot(a, b) > 0.0
            }
            _ => false,
        };
        if path[1..].windows(2).any(goes_on) {
            return Err(TurningError::Parallel);
        }
        let mut profile = parallel::parallel(&path[1..], left, SHORT * self.tolerance_mm)
            .ok_or(TurningError::Distance)?;
        profile.insert(0, Stretch { to: profile[0].from, ..way });
        Ok((profile, left < 0.0))
    }

    fn turns_back(&self, s: &Stretch) -> bool {
        s.to[0] <= s.from[0] - self.tolerance_mm
            || [-1.0, 1.0].iter().any(|side| s.passes([*side, 0.0], self.tolerance_mm).is_some())
    }
}

/// Shortens two stretches, and what comes between them.
fn insert(last: &mut Stretch, next: &mut Stretch, corner: Corner) -> Result<Stretch, TurningError> {
    let element = |s: &Stretch| match s.arc {
        None => Element::line(s.from, s.to),
        Some((center, ccw)) => Element::arc(s.from, s.to, center, ccw, 1),
    };
    let shape = Shape::Round { radius_mm: corner.radius_mm };
    let found = transition(&element(last), &element(next), shape);
    let Ok(Some(found)) = found else { return Err(TurningError::Corner) };
    (last.to, next.from) = (found.from, found.to);
    let arc = found.arc.filter(|_| !corner.straight);
    Ok(Stretch { from: found.from, to: found.to, arc })
}

/// How a path is seen: along and out.
#[derive(Debug, Clone, Copy, PartialEq)]
struct View {
    /// The second axis of the plane is along.
    swapped: bool,
    /// The signs of along and out.
    signs: [f64; 2],
}

impl View {
    /// Along is from the first to the last point of the profile, backwards if they are equal. Out is where the
    /// last point is farther than the first, forwards if they are equal.
    fn new(passes: Passes, first: Point, last: Point) -> Self {
        let positive = |yes: bool| if yes { 1.0 } else { -1.0 };
        match passes {
            Passes::First => Self {
                swapped: false,
                signs: [positive(last[0] > first[0]), positive(last[1] >= first[1])],
            },
            Passes::Second => Self {
                swapped: true,
                signs: [positive(last[1] > first[1]), positive(last[0] >= first[0])],
            },
        }
    }

    fn point(&self, p: Point) -> Point {
        let [a, b] = if self.swapped { [p[1], p[0]] } else { p };
        [self.signs[0] * a, self.signs[1] * b]
    }

    fn real(&self, p: Point) -> Point {
        let [a, b] = [self.signs[0] * p[0], self.signs[1] * p[1]];
        if self.swapped { [b, a] } else { [a, b] }
    }

    /// Whether a circle is seen from the other side.
    fn mirrors(&self) -> bool {
        self.swapped != (self.signs[0] * self.signs[1] < 0.0)
    }

    fn stretch(&self, s: &Stretch) -> Stretch {
        let arc = s.arc.map(|(center, ccw)| (self.point(center), ccw != self.mirrors()));
        Stretch { from: self.point(s.from), to: self.point(s.to), arc }
    }

    fn back(&self, moves: Vec<TurnMove>) -> Vec<TurnMove> {
        let arc = |(center, ccw)| (self.real(center), ccw != self.mirrors());
        let back = |m: TurnMove| TurnMove { to: self.real(m.to), arc: m.arc.map(arc), ..m };
        moves.into_iter().map(back).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(points: &[Point]) -> Profile {
        let written: Vec<_> =
            points.windows(2).map(|p| (Stretch::line(p[0], p[1]), None)).collect();
        Profile::new(&written, 1e-3).unwrap()
    }

    const HOW: Roughing = Roughing {
        passes: Passes::First,
        leave_mm: 0.0,
        step_mm: 2.0,
        retract_mm: 0.5,
        pockets: Pockets::Cut,
    };

    fn points(turned: &Turned) -> Vec<Point> {
        turned.moves.iter().map(|m| m.to).collect()
    }

    #[test]
    fn passes_by_hand() {
        // From Z2 X10 to Z0 X6, along to Z-5 and out to X10: passes at 10 and 8, both to Z-5; at 8 the way in
        // is at Z1. The bottom at 6 belongs to the profile itself.
        let shaft = lines(&[[2.0, 10.0], [0.0, 6.0], [-5.0, 6.0], [-5.0, 10.0]]);
        let turned = shaft.rough(&HOW).unwrap();
        let wanted = [
            [2.0, 10.0],
            [-5.0, 10.0],
            [-4.5, 10.5],
            [1.5, 10.5],
            [2.0, 10.0],
            [1.0, 8.0],
            [-5.0, 8.0],
            [-4.5, 8.5],
            [0.5, 8.5],
            [1.0, 8.0],
            [0.0, 6.0],
            [-5.0, 6.0],
            [-5.0, 10.0],
        ];
        assert_eq!(points(&turned), wanted);
        let rapids: Vec<bool> = turned.moves.iter().map(|m| m.rapid).collect();
        let (cuts, all) = ([1, 6, 11, 12], 0..wanted.len());
        assert_eq!(rapids, all.map(|n| !cuts.contains(&n)).collect::<Vec<_>>());
    }

    #[test]
    fn a_distance_by_hand() {
        // 1 mm from the floor of the shaft and from its shoulder.
        let shaft = lines(&[[2.0, 10.0], [0.0, 6.0], [-5.0, 6.0], [-5.0, 10.0]]);
        let finish = shaft.finish(1.0).unwrap();
        assert_eq!(points(&finish), [[2.0, 10.0], [0.0, 7.0], [-4.0, 7.0], [-4.0, 10.0]]);
        // Round an outer corner goes an arc about it.
        let step =
            lines(&[[2.0, 10.0], [0.0, 6.0], [-5.0, 6.0], [-6.0, 8.0], [-9.0, 8.0], [-9.0, 9.0]]);
        let finish = step.finish(1.0).unwrap();
        assert!(finish.moves.iter().any(|m| m.arc == Some(([-6.0, 8.0], true))));
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let back = lines(&[[2.0, 10.0], [0.0, 6.0], [-5.0, 6.0], [-4.0, 8.0], [-9.0, 8.0]]);
        assert_eq!(back.rough(&HOW), Err(TurningError::TurnsBack));
        let shaft = lines(&[[2.0, 10.0], [0.0, 6.0], [-5.0, 6.0], [-5.0, 10.0]]);
        let fine = Roughing { step_mm: 1e-9, ..HOW };
        assert_eq!(shaft.rough(&fine), Err(TurningError::TooMany));
        let corner = Corner { radius_mm: 9.0, straight: false };
        let written = [
            (Stretch::line([2.0, 10.0], [0.0, 6.0]), None),
            (Stretch::line([0.0, 6.0], [-5.0, 6.0]), Some(corner)),
            (Stretch::line([-5.0, 6.0], [-5.0, 10.0]), None),
        ];
        assert_eq!(Profile::new(&written, 1e-3), Err(TurningError::Corner));
    }

    #[test]
    fn mirrored_profiles_have_mirrored_moves() {
        let points_of = |f: &dyn Fn(Point) -> Point, passes| {
            let path = [[2.0, 10.0], [0.0, 6.0], [-5.0, 6.5], [-6.0, 4.0], [-8.0, 9.0]];
            let seen = lines(&path.map(f));
            let how = Roughing { passes, leave_mm: 0.2, ..HOW };
            points(&seen.rough(&how).unwrap())
        };
        let plain = points_of(&|p| p, Passes::First);
        let mirrors: [(&dyn Fn(Point) -> Point, _); 3] = [
            (&|[z, x]| [-z, x], Passes::First),
            (&|[z, x]| [z, -x], Passes::First),
            (&|[z, x]| [x, z], Passes::Second),
        ];
        for (mirror, passes) in mirrors {
            let there: Vec<Point> = plain.iter().map(|p| mirror(*p)).collect();
            let seen = points_of(mirror, passes);
            assert_eq!(seen.len(), there.len());
            for (a, b) in seen.iter().zip(&there) {
                assert!((a[0] - b[0]).abs() + (a[1] - b[1]).abs() < 1e-12, "{a:?} {b:?}");
            }
        }
    }
}
