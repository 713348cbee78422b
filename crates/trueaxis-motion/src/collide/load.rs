//! Models in and out: files named in a machine file become meshes, shapes described there become STL.

use super::mesh::Mesh;
use super::scene::{BodyModel, Role};
use super::shape::triangles_of;
use super::stl::{read_stl, write_stl};
use std::path::Path;
use trueaxis_input::{Diagnostics, Files, Place};
use trueaxis_machine::Machine;
use trueaxis_machine::models::Shape;

/// The models of a machine; STL paths are relative to the machine file.
///
/// Models that cannot be read are left out, with a diagnostic.
pub fn load_models(
    files: &Files,
    machine: &Machine,
    machine_file: &Path,
    problems: &mut Diagnostics,
) -> Vec<BodyModel> {
    let folder = machine_file.parent().unwrap_or(Path::new(""));
    let mut models = Vec::new();
    for model in machine.models() {
        let mesh = match &model.shape {
            Shape::Stl { path, unit_mm } => load_stl(files, &folder.join(path), *unit_mm, problems),
            shape => triangles_of(shape).and_then(|triangles| {
                let mesh = Mesh::new(triangles);
                if mesh.is_none() {
                    let message = format!("the model `{}` has no surface", model.name);
                    let place = Place::whole(&machine_file.display().to_string());
                    let hint = "its edges differ too much in length; check its dimensions";
                    problems.error("empty-model", place, message, hint);
                }
                mesh
            }),
        };
        let Some(mesh) = mesh else { continue };
        models.push(BodyModel {
            name: model.name.clone(),
            node: model.body,
            placement: model.placement,
            role: Role::Machine,
            mesh,
        });
    }
    models
}

/// The mesh of an STL file; `unit_mm` is how many mm one unit of it is.
pub fn load_stl(
    files: &Files,
    path: &Path,
    unit_mm: f64,
    problems: &mut Diagnostics,
) -> Option<Mesh> {
    let bytes = files.bytes(path, "an STL file", problems)?;
    let file = path.display().to_string();
    let mesh = Mesh::new(read_stl(&file, &bytes, unit_mm, problems)?)?;
    if !mesh.is_closed() {
        let message = "the surface has gaps: it has no inside".to_owned();
        let hint = "bodies that approach the surface are found; bodies that are completely inside from the start are not";
        problems.note("open-surface", Place::whole(&file), message, hint);
    }
    Some(mesh)
}

/// Every model that the machine file describes by numbers, as a name and the bytes of a binary STL
/// file in mm in the model coordinate system.
pub fn export(machine: &Machine) -> Vec<(String, Vec<u8>)> {
    let mut files = Vec::new();
    for (i, model) in machine.models().iter().enumerate() {
        let Some(triangles) = triangles_of(&model.shape) else { continue };
        let plain = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' };
        let name: String = model.name.chars().map(plain).collect();
        let heading = format!("{}, {}", machine.name(), model.name);
        // The number keeps apart what the plain letters make equal.
        files.push((format!("{:02}-{name}.stl", i + 1), write_stl(&heading, &triangles)));
    }
    files
}
