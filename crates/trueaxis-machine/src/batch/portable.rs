//! The kernels without instructions of a particular processor.

use super::columns::DeviationColumns;
use super::compensated::{CommandColumns, CompensationError, CompensationJob, Effort, newton};
use super::{BatchError, Job, kernel};
use crate::lanes::Plain;

pub(super) fn run_portable(
    job: &Job<'_>,
    out: &mut DeviationColumns<'_>,
) -> Result<(), BatchError> {
    kernel::run::<8, Plain<8>>(job, out)
}

pub(super) fn compensate_portable(
    job: &CompensationJob<'_>,
    out: &mut CommandColumns<'_>,
) -> Result<Effort, CompensationError> {
    newton::run::<8, Plain<8>>(job, out)
}
