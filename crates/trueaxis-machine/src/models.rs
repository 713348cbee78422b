//! Solid models of the machine for pictures and collisions, placed on the bodies of the chain.
//!
//! Jiang et al.: each node of the topology carries models, and each model has a model coordinate
//! system of its own, placed in that of its node. Here a [`Model`] names its node and the placement
//! of its coordinate system there:
//!
//! ```text
//!     bed_from_model = bed_from_node · placement
//! ```
//!
//! This crate opens no file: an STL model is the text of its path.

use crate::chain::Link;
use trueaxis_geometry::Vec3;

/// One rigid model on a node of the chain.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// Its name, unique within the machine.
    pub name: String,
    /// Its node as an index of [`crate::Machine::bodies`]; `None` is the bed.
    pub body: Option<usize>,
    /// The model coordinate system in that of its node.
    pub placement: Link,
    /// Its shape in the model coordinate system.
    pub shape: Shape,
}

/// The shape of a model in its own coordinate system.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// An STL file.
    Stl {
        /// The path as the machine file writes it, relative to that file.
        path: String,
        /// Length of one unit of the file, mm.
        unit_mm: f64,
    },
    /// A cuboid centred at the origin.
    Box {
        /// Its edges along x, y and z, mm.
        size_mm: Vec3,
    },
    /// A frustum of a cone about z, from z = 0 upwards; a cylinder has two equal diameters.
    Cone {
        /// Diameter at z = 0, mm.
        base_diameter_mm: f64,
        /// Diameter at the other end, mm; 0 for a pointed cone.
        top_diameter_mm: f64,
        /// Length along z, mm.
        length_mm: f64,
    },
    /// A plane outline raised along z, from z = 0 upwards.
    Prism {
        /// Its corners x, y in order, mm; the outline does not cross itself.
        outline_mm: Vec<[f64; 2]>,
        /// Length along z, mm.
        length_mm: f64,
    },
}

/// A cylinder of a tool with its holder; a list of them goes from the tip upwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToolSegment {
    /// Diameter, mm.
    pub diameter_mm: f64,
    /// Length along the tool axis, mm.
    pub length_mm: f64,
}
