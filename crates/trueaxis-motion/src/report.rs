//! A simulation as text, JSON and a page.

mod simulation;
mod simulation_document;
mod simulation_pictures;
mod simulation_plots;
mod simulation_views;
mod stock;
mod tool_states;

pub use simulation::{Simulation, clock, issue_code, issue_text, simulation_report};
pub use simulation_document::SimulationDocument;
