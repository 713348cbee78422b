//! Collisions: models on the nodes of the chain, their clearances, their contacts.
//!
//! ```text
//!     machine file [[model]] ──load_models──> [BodyModel]
//!     [BodyModel] + ToolShape + stock, fixture, part ──Scene::new──> Scene
//!     Scene + poses of all bodies ──check──> [Contact]         at one moment
//!     Scene + two commands ──sweep──> [Contact]                at every moment between
//! ```
//!
//! Jiang et al. place models on the nodes of the topology, each with a coordinate system of its
//! own, and checks their surfaces against each other. Everything here is triangles with a tree of
//! boxes; docs/decisions/0006-collisions.md gives the reasons.

mod load;
mod mesh;
mod room;
mod scene;
mod shape;
mod stl;
mod sweep;
mod triangle;

pub use load::{export, load_models, load_stl};
pub use mesh::{Mesh, Nearest, Placed, Scratch};
pub use room::Room;
pub use scene::{Allowed, BodyModel, Contact, Excluded, Role, Scene, ToolShape};
pub use shape::{ROUNDNESS_MM, cuboid, raise, revolve, triangles_of};
pub use stl::{read_stl, write_stl};
pub use sweep::Sweep;
pub use triangle::{Gap, Triangle, gap};
