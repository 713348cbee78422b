//! Any bytes as an STL file: never a panic, corners are finite.
//!
//! `scripts/fuzz stl_file 120`

#![no_main]

use libfuzzer_sys::fuzz_target;
use trueaxis::input::Diagnostics;
use trueaxis::simulate::collide::{Mesh, read_stl};

fuzz_target!(|data: &[u8]| {
    let mut problems = Diagnostics::new();
    let Some(triangles) = read_stl("p.stl", data, 1.0, &mut problems) else {
        assert!(problems.has_errors());
        return;
    };
    assert!(triangles.iter().all(|t| t.iter().all(|corner| corner.iter().all(|x| x.is_finite()))));
    if let Some(mesh) = Mesh::new(triangles) {
        assert!(mesh.centre_mm().iter().all(|x| x.is_finite()));
    }
});
