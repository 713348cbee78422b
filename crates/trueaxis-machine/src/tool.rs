//! Tools and their holders.

/// A tool with its holder, as the machine file lists it.
#[derive(Debug, Clone, PartialEq)]
pub struct ToolAssembly {
    /// Its name.
    pub name: String,
    /// From the gauge line of the spindle to the tip, mm.
    pub length_mm: f64,
    /// Cutting diameter, mm, if stated.
    pub diameter_mm: Option<f64>,
    /// Radius of the corner, mm; half the diameter for a ball, if stated.
    pub corner_radius_mm: Option<f64>,
    /// The holder, in words.
    pub holder: Option<String>,
    /// Its outline from the tip upwards, the cutting part first; empty if not stated.
    pub shape: Vec<crate::models::ToolSegment>,
}
