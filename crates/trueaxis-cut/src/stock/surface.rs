//! The surface of what remains of a stock, as triangles for a picture.
//!
//! Surface nets (Gibson 1998): a corner in each cell that the surface goes through, in the middle of where it crosses the edges of the cell; a
//! face across each edge that it crosses. Corners of the part come out rounded by half a cell.

use super::{Grid, Stock};
use trueaxis_geometry::Vec3;

/// The lattice of the places where lines of all three directions meet, every so manyth of them, with a layer of air around.
struct Lattice<'s> {
    grids: &'s [Grid; 3],
    stride: usize,
    counts: [usize; 3],
    /// Whether each node is material.
    solid: Vec<bool>,
}

type Node = [usize; 3];

impl Stock {
    /// The surface of what remains, by no more than so many places of its lattice; triangles seen from outside counter-clockwise.
    pub fn surface(&self, most_places: usize) -> Vec<[Vec3; 3]> {
        let lattice = Lattice::of(&self.grids, most_places);
        let corners = lattice.corners();
        let mut triangles = Vec::new();
        for node in lattice.nodes() {
            for axis in 0..3 {
                lattice.face(node, axis, &corners, &mut triangles);
            }
        }
        triangles
    }
}

impl<'s> Lattice<'s> {
    fn of(grids: &'s [Grid; 3], most_places: usize) -> Self {
        // Along X go the columns of the grid of Y, and so on.
        let all = [grids[1].lines.counts[1], grids[2].lines.counts[1], grids[0].lines.counts[1]];
        let mut stride = 1;
        let counts = |stride: usize| all.map(|c| c.div_ceil(stride) + 2);
        while counts(stride).iter().product::<usize>() > most_places && stride < 1 << 12 {
            stride += 1;
        }
        let counts = counts(stride);
        let mut lattice = Self { grids, stride, counts, solid: Vec::new() };
        lattice.solid = lattice.nodes().map(|node| lattice.is_solid(node)).collect();
        lattice
    }

    fn nodes(&self) -> impl Iterator<Item = Node> + use<> {
        let [a, b, c] = self.counts;
        (0..c).flat_map(move |k| (0..b).flat_map(move |j| (0..a).map(move |i| [i, j, k])))
    }

    fn index(&self, [i, j, k]: Node) -> usize {
        (k * self.counts[1] + j) * self.counts[0] + i
    }

    /// The line of each direction through a node; none in the layer of air.
    fn line(&self, node: Node, along: usize) -> Option<&[[f64; 2]]> {
        let Grid { lines, material } = &self.grids[along];
        let mut cell = [0; 2];
        for (cell, (axis, count)) in cell.iter_mut().zip(lines.across.into_iter().zip(lines.counts))
        {
            *cell = node[axis].checked_sub(1)? * self.stride;
            if *cell >= count {
                return None;
            }
        }
        Some(&material[cell[1] * lines.counts[0] + cell[0]])
    }

    /// The coordinate of a node along an axis, mm.
    fn coordinate(&self, node: Node, axis: usize) -> f64 {
        let lines = &self.grids[(axis + 1) % 3].lines;
        let k = usize::from(lines.across[0] != axis);
        lines.first_mm[k] + (node[axis] as f64 - 1.0) * self.stride as f64 * lines.step_mm[k]
    }

    fn place(&self, node: Node) -> Vec3 {
        Vec3::from_fn(|axis, _| self.coordinate(node, axis))
    }

    fn is_solid(&self, node: Node) -> bool {
        let at = self.coordinate(node, 2);
        let line = self.line(node, 2).unwrap_or_default();
        node[2] > 0 && node[2] + 1 < self.counts[2] && line.iter().any(|s| s[0] <= at && at <= s[1])
    }

    /// Where the surface crosses the edge from a node to the next one along an axis.
    fn crossing(&self, node: Node, axis: usize) -> Option<Vec3> {
        let mut next = node;
        next[axis] += 1;
        let (here, there) = (self.solid[self.index(node)], self.solid[self.index(next)]);
        if here == there {
            return None;
        }
        let [from, to] = [self.coordinate(node, axis), self.coordinate(next, axis)];
        let solid = if here { from } else { to };
        let stretch = self
            .line(node, axis)
            .and_then(|line| line.iter().find(|s| s[0] <= solid && solid <= s[1]));
        let end = stretch.map_or(0.5 * (from + to), |s| if here { s[1] } else { s[0] });
        let mut at = self.place(node);
        at[axis] = end.clamp(from, to);
        Some(at)
    }

    /// The corner of each cell that the surface goes through, by the index of its first node.
    fn corners(&self) -> Vec<Option<Vec3>> {
        let corner = |node: Node| {
            if (0..3).any(|axis| node[axis] + 1 >= self.counts[axis]) {
                return None;
            }
            let (mut sum, mut count) = (Vec3::zeros(), 0.0);
            for axis in 0..3 {
                for (u, v) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                    let mut at = node;
                    at[(axis + 1) % 3] += u;
                    at[(axis + 2) % 3] += v;
                    if let Some(crossing) = self.crossing(at, axis) {
                        sum += crossing;
                        count += 1.0;
                    }
                }
            }
            (count > 0.0).then(|| sum / count)
        };
        self.nodes().map(corner).collect()
    }

    /// Two triangles across an edge that the surface crosses, through the corners of the four cells around it.
    fn face(&self, node: Node, axis: usize, corners: &[Option<Vec3>], out: &mut Vec<[Vec3; 3]>) {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        if node[axis] + 1 >= self.counts[axis] || node[u] == 0 || node[v] == 0 {
            return;
        }
        let mut next = node;
        next[axis] += 1;
        let here = self.solid[self.index(node)];
        if here == self.solid[self.index(next)] {
            return;
        }
        let cell = |du: usize, dv: usize| {
            let mut at = node;
            at[u] -= du;
            at[v] -= dv;
            corners[self.index(at)]
        };
        let [Some(a), Some(b), Some(c), Some(d)] = [cell(1, 1), cell(0, 1), cell(0, 0), cell(1, 0)]
        else {
            return;
        };
        match here {
            true => out.extend([[a, b, c], [a, c, d]]),
            false => out.extend([[a, c, b], [a, d, c]]),
        }
    }
}
