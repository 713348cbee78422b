//! From errors to indices: cut, then evaluate. Every analysis is a question to this one function.

use super::Error;
use super::cutting::{Change, Cutting};
use trueaxis_geometry::Vec3;
use trueaxis_part::testpiece::{CutSurface, Datum, PartSection, Scratch, TestPiece};

/// A test piece on a machine, ready to be cut with any errors.
pub struct Judge<'a> {
    /// Commands and errors of the cut.
    pub cutting: &'a Cutting<'a>,
    /// What is cut.
    pub piece: &'a dyn TestPiece,
}

/// Memory that one thread uses again for every cut.
#[derive(Default)]
pub struct Bench {
    pub(super) deviations: Vec<Vec3>,
    scratch: Scratch,
}

impl Judge<'_> {
    /// How many indices the test piece has.
    pub fn index_count(&self) -> usize {
        self.piece.index_names().len()
    }

    /// The indices (mm) of the part that is cut with changed errors.
    ///
    /// # Errors
    /// Points that cannot be evaluated, which only absurd errors bring about.
    pub fn indices(
        &self,
        change: &Change<'_>,
        bench: &mut Bench,
        out: &mut [f64],
    ) -> Result<(), Error> {
        let datum = self.cutting.cut(change, &mut bench.deviations);
        self.judged(datum, bench, out)
    }

    /// The indices of a part with the deviations on the bench.
    pub(super) fn judged(
        &self,
        datum: Datum,
        bench: &mut Bench,
        out: &mut [f64],
    ) -> Result<(), Error> {
        let datum = self.datum(datum, &bench.deviations);
        let surface = CutSurface { deviation_mm: &bench.deviations, datum };
        self.piece.evaluate(&surface, &mut bench.scratch, out).map_err(Error::Evaluation)
    }

    /// The datum that the machine bored, or the frame of the best fit.
    fn datum(&self, bored: Datum, deviation_mm: &[Vec3]) -> Datum {
        if self.cutting.in_best_fit() { self.piece.best_fit(deviation_mm) } else { bored }
    }

    /// Every section in full, for the report.
    ///
    /// # Errors
    /// As [`Judge::indices`].
    pub fn sections(&self, change: &Change<'_>) -> Result<(Vec<Vec3>, Vec<PartSection>), Error> {
        let mut deviation_mm = Vec::new();
        let datum = self.cut(change, &mut deviation_mm);
        let surface = CutSurface { deviation_mm: &deviation_mm, datum };
        let sections = self.piece.sections(&surface).map_err(Error::Evaluation)?;
        Ok((deviation_mm, sections))
    }

    /// The deviations at every contact point, mm, and the datum against which they are judged.
    pub fn cut(&self, change: &Change<'_>, deviation_mm: &mut Vec<Vec3>) -> Datum {
        let datum = self.cutting.cut(change, deviation_mm);
        self.datum(datum, deviation_mm)
    }

    /// The same with memory of its own: for analyses that ask a few hundred times.
    ///
    /// # Errors
    /// As [`Judge::indices`].
    pub fn once(&self, change: &Change<'_>) -> Result<Vec<f64>, Error> {
        let mut out = vec![0.0; self.index_count()];
        self.indices(change, &mut Bench::default(), &mut out)?;
        Ok(out)
    }
}
