//! Strokes of cutters in the plane: pockets, faces, threads by milling.

use super::drilling::Drill;
use crate::moves::{Arc, Feed, MoveKind};
use crate::text::program::Fault;
use trueaxis_cycles::mill::Stroke;

/// A language that mills.
pub(crate) trait Mill<'r>: Drill<'r> {
    /// Executes strokes with the feeds of the plane and of the depth; the feed before them is back afterwards.
    fn mill(
        &mut self,
        strokes: &[Stroke],
        [flat, deep]: [Feed; 2],
        at: usize,
    ) -> Result<(), Fault> {
        let plane = self.core().modes.plane;
        let modal = self.core().modes.feed;
        for stroke in strokes {
            let (kind, place, feed) = match *stroke {
                Stroke::Rapid(place) => (MoveKind::Rapid, place, flat),
                Stroke::Line(place) => (MoveKind::Linear, place, flat),
                Stroke::Plunge(place) => (MoveKind::Linear, place, deep),
                Stroke::Arc { to, center: center_mm, ccw, plunges } => {
                    let arc = Arc { plane, center_mm, turns: 1, ccw };
                    (MoveKind::Arc(arc), to, if plunges { deep } else { flat })
                }
            };
            let mut to = *self.place();
            for (axis, value) in plane.axes().into_iter().zip(place) {
                to[axis] = value;
            }
            self.core().modes.feed = feed;
            let done = self.move_drill(kind, to, at);
            self.core().modes.feed = modal;
            done?;
        }
        Ok(())
    }
}

impl<'r, T: Drill<'r>> Mill<'r> for T {}
