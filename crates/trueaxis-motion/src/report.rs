//! A simulation as text, JSON and a page.

mod simulation;
mod simulation_document;
mod simulation_pictures;
mod simulation_plots;
mod simulation_views;

<<<<<<< HEAD
pub use simulation::{Simulation, clock, simulation_report, trouble_code, trouble_text};
pub use simulation_document::SimulationDocument;
=======
pub use simulation::{
    Simulation, clock, issue_code, issue_text, simulation_html, simulation_report, simulation_text,
};
pub use simulation_document::{SimulationDocument, simulation_json};
>>>>>>> 73e1135 (Issues and the error budget carry the field's names in the code; keys of documents unchanged)
