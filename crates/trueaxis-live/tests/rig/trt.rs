//! The kinematics of LinuxCNC's tilting rotary tables.

use trueaxis::geometry::{Mat3, Vec3};

/// A table of LinuxCNC: `man 9 kins`, xyzac-trt-kins and xyzbc-trt-kins with rot-point 0.
#[derive(Clone, Copy)]
pub struct Trt {
    pub tilts_about_x: bool,
    /// Of the file: y-offset or x-offset, z-offset, mm.
    pub offset: [f64; 2],
    pub tool: f64,
}

impl Trt {
    fn arm(&self) -> Vec3 {
        let [side, up] = self.offset;
        let up = up + self.tool;
        if self.tilts_about_x { Vec3::new(0.0, side, up) } else { Vec3::new(side, 0.0, up) }
    }

    fn turn(&self, tilt: f64, c: f64) -> (Mat3, Mat3) {
        let (s, k) = (-tilt).sin_cos();
        let tilt = match self.tilts_about_x {
            true => Mat3::new(1.0, 0.0, 0.0, 0.0, k, -s, 0.0, s, k),
            false => Mat3::new(k, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, k),
        };
        let (s, k) = (-c).sin_cos();
        (Mat3::new(k, -s, 0.0, s, k, 0.0, 0.0, 0.0, 1.0), tilt)
    }

    /// X Y Z of the program from joints X Y Z.
    pub fn forward(&self, joints: Vec3, tilt: f64, c: f64) -> Vec3 {
        let (table, cradle) = self.turn(tilt, c);
        table * (self.arm() + cradle * (joints - self.arm()))
    }

    pub fn inverse(&self, world: Vec3, tilt: f64, c: f64) -> Vec3 {
        let (table, cradle) = self.turn(tilt, c);
        self.arm() + cradle.transpose() * (table.transpose() * world - self.arm())
    }
}
