//! Where every body of the machine is, nominal and actual, as a table written while it comes.

use super::{Batch, Observer};
use std::fmt::Write as _;
use std::io::{self, Write};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Bed, Body, Pose};
use trueaxis_machine::errors::ErrorValues;

/// The columns: one line for each body at each place of the path.
///
/// `xx … zz` is the rotation of the nominal body in the machine frame, row by row; the deviation is
/// actual minus nominal, of the origin in µm and as a small rotation vector in µrad.
pub const BODY_HEADINGS: &str = "time_s,program,line,body,x_mm,y_mm,z_mm,xx,xy,xz,yx,yy,yz,zx,zy,zz,\
                                 dev_x_um,dev_y_um,dev_z_um,dev_a_urad,dev_b_urad,dev_c_urad";

/// Writes the poses of all bodies in the machine frame (the simulation frame of Jiang et al.).
pub struct BodyTable<W: Write> {
    out: W,
    text: String,
    failed: Option<io::Error>,
}

impl<W: Write> BodyTable<W> {
    /// Writes the headings.
    pub fn new(mut out: W) -> Self {
        let failed = out.write_all(format!("{BODY_HEADINGS}\n").as_bytes()).err();
        Self { out, text: String::new(), failed }
    }

    /// Writes what is still in the buffer.
    ///
    /// # Errors
    /// The first error of the disk.
    pub fn finish(mut self) -> io::Result<W> {
        match self.failed.take() {
            Some(error) => Err(error),
            None => self.out.flush().map(|()| self.out),
        }
    }

    fn add(&mut self, nominal: &Pose<Bed, Body>, actual: &Pose<Bed, Body>) {
        let origin = nominal.shift_mm();
        let rows = nominal.linear().transpose();
        let off = (actual.shift_mm() - origin) * 1e3;
        // R_actual · R_nominalᵀ − 1 is the cross product with the small rotation vector.
        let turn = actual.linear() * nominal.linear().transpose();
        let vector = Vec3::new(
            turn[(2, 1)] - turn[(1, 2)],
            turn[(0, 2)] - turn[(2, 0)],
            turn[(1, 0)] - turn[(0, 1)],
        ) * 0.5e6;
        for value in origin.iter().chain(rows.iter()).chain(off.iter()).chain(vector.iter()) {
            // Writing into a text cannot fail; + 0: no minus before a zero.
            let _ = write!(self.text, ",{}", value + 0.0);
        }
        self.text.push('\n');
    }
}

impl<W: Write> Observer for BodyTable<W> {
    fn path(&mut self, batch: &Batch<'_>) {
        for (i, (node, stamp)) in batch.nodes.iter().zip(batch.stamps).enumerate() {
            if self.failed.is_some() {
                return;
            }
            // Where the machine file gives no errors, the simulation has already reported it.
            let errors = batch.machine.errors_at(&node.command, &batch.approach(i));
            let nominal = batch.machine.body_poses(&node.command, &ErrorValues::default());
            let actual = batch.machine.body_poses(&node.command, &errors.unwrap_or_default());
            self.text.clear();
            for body in 0..nominal.len() {
                let name = batch.machine.bodies()[body].name;
                let origin = node.origin;
                let _ =
                    write!(self.text, "{},{},{},{name}", stamp.time_s, origin.program, origin.line);
                self.add(&nominal[body], &actual[body]);
            }
            self.failed = self.out.write_all(self.text.as_bytes()).err();
        }
    }
}
