//! Models in and out: files named in a machine file become meshes, shapes described there become STL.

use super::mesh::Mesh;
use super::scene::{BodyModel, Role};
use super::shape::triangles_of;
use super::stl::{read_stl, write_stl};
use super::triangle::Triangle;
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
    } else if signed_volume_mm3(&mesh) < 0.0 {
        let message = "its facets face into the body".to_owned();
        let hint = "collisions and stock are right all the same; export it again, normals outwards, before it is read elsewhere";
        problems.note("inward-facets", Place::whole(&file), message, hint);
    }
    Some(mesh)
}

/// Negative where the facets of a closed surface face inwards.
fn signed_volume_mm3(mesh: &Mesh) -> f64 {
    // About the middle, so that a body far from zero loses no digits.
    let centre = mesh.centre_mm();
    let volume = |t: &Triangle| {
        let [a, b, c] = t.map(|corner| corner - centre);
        a.dot(&b.cross(&c)) / 6.0
    };
    mesh.triangles().iter().map(volume).sum()
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collide::shape::cuboid;
    use trueaxis_geometry::Vec3;
    use trueaxis_input::Source;

    /// One file, whatever its name.
    struct One(Vec<u8>);

    impl Source for One {
        fn read(&self, _: &Path) -> std::io::Result<Vec<u8>> {
            Ok(self.0.clone())
        }

        fn is_file(&self, _: &Path) -> bool {
            true
        }
    }

    fn codes(triangles: &[Triangle]) -> Vec<&'static str> {
        let files = Files::new(One(write_stl("body", triangles)));
        let mut problems = Diagnostics::new();
        assert!(load_stl(&files, Path::new("body.stl"), 1.0, &mut problems).is_some());
        problems.iter().map(|d| d.code).collect()
    }

    #[test]
    fn a_surface_that_faces_inwards_is_said_wherever_it_lies() {
        for far in [0.0, 1e5] {
            let move_it = |t: Triangle| t.map(|c| c + Vec3::repeat(far));
            let outwards: Vec<Triangle> =
                cuboid(Vec3::new(20.0, 30.0, 40.0)).into_iter().map(move_it).collect();
            let inwards: Vec<Triangle> = outwards.iter().map(|[a, b, c]| [*a, *c, *b]).collect();
            assert!(codes(&outwards).is_empty());
            assert_eq!(codes(&inwards), ["inward-facets"]);
            assert_eq!(codes(&outwards[1..]), ["open-surface"]);
        }
    }
}
