//! Threads cut on a lathe in several passes: G76 of LinuxCNC.

/// Passes of one thread: more than any program means.
const MOST_PASSES: usize = 10_000;

/// A thread along Z; lengths in mm, X as a radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thread {
    /// Where the tool stands before, X and Z. Unit: mm.
    pub from: [f64; 2],
    /// The end along Z, mm.
    pub end_mm: f64,
    /// The travel along Z in a turn, mm.
    pub pitch_mm: f64,
    /// From the present X to the crest of the thread: below 0 an outer thread, mm.
    pub crest_mm: f64,
    /// The depth of the first pass, mm.
    pub first_mm: f64,
    /// The height of the thread, mm.
    pub height_mm: f64,
    /// The n-th pass is n^(1/degression) times as deep as the first. Unit: 1.
    pub degression: f64,
    /// The angle at which the passes go in along one flank, degrees.
    pub compound_deg: f64,
    /// Passes at full depth after the first one.
    pub spring_passes: u32,
    /// The length along Z in which the tool goes in or out, mm.
    pub taper_mm: f64,
    /// Whether it goes in and whether it goes out in this way.
    pub tapers: [bool; 2],
}

/// One move: in step with the spindle, with its travel in a turn along the path, or rapid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThreadMove {
    /// X, as a radius, and Z. Unit: mm.
    pub to: [f64; 2],
    /// The travel in a turn, mm; `None` is rapid.
    pub pitch_mm: Option<f64>,
}

impl Thread {
    /// The depth of each pass from the crest, the last ones the height; `None` if they are too many.
    fn depths(&self) -> Option<Vec<f64>> {
        let degression = self.degression.max(1.0);
        let mut depths = Vec::new();
        for n in 1..=MOST_PASSES {
            let depth = self.first_mm.abs() * (n as f64).powf(1.0 / degression);
            if depth >= self.height_mm.abs() {
                let last = 1 + self.spring_passes.min(1000) as usize;
                depths.extend(std::iter::repeat_n(self.height_mm.abs(), last));
                return Some(depths);
            }
            depths.push(depth);
        }
        None
    }

    /// The moves of all passes, without the last one to the end; `None` if they are too many.
    ///
    /// # Source
    /// LinuxCNC 2.9 user manual, "G76 Threading Cycle": the path around each pass and the meaning of its words.
    /// That the tool waits beside the pass at the height of crest and thread together was seen in the output of
    /// `rs274`.
    pub fn moves(&self) -> Option<Vec<ThreadMove>> {
        let depths = self.depths()?;
        let [x, z] = self.from;
        let (height, crest) = (self.height_mm.abs(), self.crest_mm.abs());
        let inwards = if self.crest_mm > 0.0 { 1.0 } else { -1.0 };
        let forwards = if self.end_mm > z { 1.0 } else { -1.0 };
        let slope = self.compound_deg.to_radians().tan();
        let taper = self.taper_mm.max(0.0);
        let [enters, leaves] = self.tapers.map(|t| t && taper > 0.0);
        let tapered = Some(self.pitch_mm * (1.0 + (height / taper).powi(2)).sqrt());
        let straight = Some(self.pitch_mm);
        let mut moves = Vec::new();
        for depth in depths {
            let cut = x + inwards * (crest + depth);
            let (away, out) = (cut - inwards * (crest + height), cut - inwards * height);
            let begin = z + forwards * depth * slope;
            let end = self.end_mm - forwards * (height - depth) * slope;
            let mut go = |to, pitch_mm| moves.push(ThreadMove { to, pitch_mm });
            go([away, begin], None);
            if enters {
                go([out, begin], tapered);
                go([cut, begin + forwards * taper], tapered);
            } else {
                go([cut, begin], None);
            }
            if leaves {
                go([cut, end - forwards * taper], straight);
                go([out, end], tapered);
            } else {
                go([cut, end], straight);
            }
            go([away, end], None);
        }
        Some(moves)
    }
}

/// The coarse pitch of a metric thread by its size, mm.
///
/// # Source
/// ISO 261, coarse pitches.
pub fn coarse_pitch_mm(size_mm: f64) -> Option<f64> {
    const PITCHES: [(f64, f64); 20] = [
        (2.0, 0.4),
        (2.5, 0.45),
        (3.0, 0.5),
        (4.0, 0.7),
        (5.0, 0.8),
        (6.0, 1.0),
        (8.0, 1.25),
        (10.0, 1.5),
        (12.0, 1.75),
        (14.0, 2.0),
        (16.0, 2.0),
        (18.0, 2.5),
        (20.0, 2.5),
        (22.0, 2.5),
        (24.0, 3.0),
        (27.0, 3.0),
        (30.0, 3.5),
        (36.0, 4.0),
        (42.0, 4.5),
        (48.0, 5.0),
    ];
    PITCHES.iter().find(|(size, _)| *size == size_mm).map(|(_, pitch)| *pitch)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn passes_by_hand() {
        // Depths 0.5 · √n below 1: 0.5, 0.7071 (√2/2), 0.8660, then 1.
        let thread = Thread {
            from: [10.0, 5.0],
            end_mm: -20.0,
            pitch_mm: 1.5,
            crest_mm: -2.0,
            first_mm: 0.5,
            height_mm: 1.0,
            degression: 2.0,
            compound_deg: 0.0,
            spring_passes: 1,
            taper_mm: 0.0,
            tapers: [false; 2],
        };
        let moves = thread.moves().unwrap();
        assert_eq!(moves.len(), 5 * 4);
        let first: Vec<_> = moves[..4].iter().map(|m| m.to).collect();
        assert_eq!(first, [[10.5, 5.0], [7.5, 5.0], [7.5, -20.0], [10.5, -20.0]]);
        assert_eq!(moves[2].pitch_mm, Some(1.5));
        assert!((moves[6].to[0] - (8.0 - 0.5_f64.sqrt())).abs() < 1e-12);
        assert_eq!(moves[18].to, [7.0, -20.0]);
        assert_eq!(Thread { first_mm: 0.0, ..thread }.moves(), None);
    }
}
