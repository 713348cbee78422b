//! Controls that are not there: for demonstrations and tests.
//!
//! [`FanucMock`] is pure: it goes on where [`FanucMock::advance`] says so and answers frames. [`MockServer`] puts it on a
//! socket, `trueaxis live mock fanuc`; [`MockWire`] connects it in memory, on a virtual clock.

mod answer;
mod fanuc;
mod ladder;
mod path;
mod server;
mod wire;

pub use fanuc::{FanucMock, Faults, MockPlan};
pub use ladder::{Ladder, LadderSettings};
pub use path::{MockPath, Stop};
pub use server::MockServer;
pub use wire::MockWire;
