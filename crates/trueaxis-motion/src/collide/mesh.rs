//! A body as triangles with a tree of boxes over them.

use super::triangle::{Triangle, gap, is_degenerate};
use std::collections::HashMap;
use trueaxis_geometry::{Mat3, Vec3};

/// Triangles in one leaf of the tree: fewer cost memory, more cost pairs.
const LEAF: usize = 1;

/// What bounds the triangles below it, twice: a box along the axes of the model, and a disc, the
/// short cylinder about the mean normal. Boxes fit corners and rods; discs fit the patches of a
/// smooth surface, where a box along foreign axes is as thick as the patch is wide.
///
/// The left child follows in the list, the right one is at `next`.
#[derive(Debug, Clone, Copy)]
struct Node {
    disc: Disc,
    centre: [f64; 3],
    half: [f64; 3],
    /// First triangle of a leaf, or the right child.
    next: u32,
    /// Triangles of a leaf; 0 for an inner node.
    count: u32,
}

#[derive(Debug, Clone, Copy)]
struct Disc {
    centre: Vec3,
    normal: Vec3,
    /// Half of its thickness along the normal.
    half: f64,
    radius: f64,
}

impl Disc {
    fn around(triangles: &[Triangle]) -> Self {
        let sum: Vec3 = triangles.iter().map(|t| (t[1] - t[0]).cross(&(t[2] - t[0]))).sum();
        // A closed surface has no mean normal: any direction bounds it.
        let normal = sum.try_normalize(0.0).unwrap_or(Vec3::z());
        let across = normal.cross(&Vec3::ith(normal.iamin(), 1.0)).normalize();
        let frame = [across, normal.cross(&across), normal];
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for corner in triangles.iter().flatten() {
            for i in 0..3 {
                let along = corner.dot(&frame[i]);
                low[i] = low[i].min(along);
                high[i] = high[i].max(along);
            }
        }
        let middle = |i: usize| 0.5 * (low[i] + high[i]);
        let centre: Vec3 = (0..3).map(|i| frame[i] * middle(i)).sum();
        let (mut half, mut radius) = (0.0_f64, 0.0_f64);
        for corner in triangles.iter().flatten() {
            let from = corner - centre;
            let along = from.dot(&normal);
            half = half.max(along.abs());
            radius = radius.max((from - normal * along).norm());
        }
        // A little more, so that rounding never leaves a corner outside.
        let slack = 1e-14 * (centre.norm() + radius);
        Self { centre, normal, half: half + slack, radius: radius + slack }
    }

    /// How far it reaches along a unit vector whose cosine with the normal is known.
    #[inline]
    fn reach(&self, cosine: f64) -> f64 {
        self.half * cosine.abs() + self.radius * sine(cosine)
    }
}

/// Never too small.
#[inline]
fn sine(cosine: f64) -> f64 {
    ((1.0 - cosine * cosine).max(0.0) + 1e-15).sqrt()
}

/// A body of triangles in its own model coordinate system.
#[derive(Debug, Clone)]
pub struct Mesh {
    triangles: Vec<Triangle>,
    nodes: Vec<Node>,
    /// One corner of each connected piece.
    pieces: Vec<Vec3>,
    closed: bool,
    centre_mm: Vec3,
    radius_mm: f64,
}

/// Where the second of two bodies is in the frame of the first: rotation and shift.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placed {
    /// Columns of the rotation.
    pub turn: Mat3,
    /// Shift, mm.
    pub shift_mm: Vec3,
}

/// The result of a distance query of two meshes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest {
    /// 0 where they overlap, mm.
    pub distance_mm: f64,
    /// The nearest point of the first mesh, in its frame.
    pub on_first: Vec3,
    /// The nearest point of the second mesh, in the frame of the first.
    pub on_second: Vec3,
    /// Which two triangles: the seed of the next question.
    pub triangles: (u32, u32),
}

/// Reused memory of the questions, and how much work the last one was.
#[derive(Debug, Default)]
pub struct Scratch {
    open: Vec<(f64, u32, u32)>,
    /// Pairs of boxes that the last query checked.
    pub visits: usize,
}

impl Mesh {
    /// A mesh of the triangles that have an area; `None` if there is none.
    pub fn new(triangles: impl IntoIterator<Item = Triangle>) -> Option<Self> {
        let finite = |t: &Triangle| t.iter().all(|c| c.iter().all(|v| v.is_finite()));
        let mut triangles: Vec<Triangle> = triangles.into_iter().filter(finite).collect();
        // Before slivers go: they may be what closes the surface.
        let (pieces, closed) = connect(&triangles);
        triangles.retain(|t| !is_degenerate(t));
        if triangles.is_empty() || u32::try_from(2 * triangles.len()).is_err() {
            return None;
        }
        let mut nodes = Vec::with_capacity(2 * triangles.len() / LEAF + 1);
        build(&mut triangles, 0, &mut nodes);
        let centre_mm = Vec3::from(nodes[0].centre);
        let corners = triangles.iter().flatten();
        let radius_mm = corners.map(|c| (c - centre_mm).norm()).fold(0.0, f64::max);
        Some(Self { triangles, nodes, pieces, closed, centre_mm, radius_mm })
    }

    /// Its triangles, in the order of the tree.
    pub fn triangles(&self) -> &[Triangle] {
        &self.triangles
    }

    /// Whether every edge belongs to an even number of triangles: only then there is an inside.
    pub fn is_closed(&self) -> bool {
        self.closed
    }

    /// How many connected pieces it has.
    pub fn piece_count(&self) -> usize {
        self.pieces.len()
    }

    /// The centre of its bounding box, mm.
    pub fn centre_mm(&self) -> Vec3 {
        self.centre_mm
    }

    /// No point is further from [`Mesh::centre_mm`], mm.
    pub fn radius_mm(&self) -> f64 {
        self.radius_mm
    }

    /// Whether a point lies inside; an open mesh has no inside.
    ///
    /// A ray in a direction that no drawing has crosses the surface an odd number of times; the
    /// majority of three rays decides, so that an edge hit by chance does not.
    pub fn contains(&self, point: Vec3) -> bool {
        let root = &self.nodes[0];
        if !self.closed || (0..3).any(|i| (point[i] - root.centre[i]).abs() > root.half[i]) {
            return false;
        }
        const RAYS: [[f64; 3]; 3] = [
            [0.577_13, 0.211_71, 0.788_77],
            [-0.831_33, 0.370_19, 0.414_61],
            [0.141_59, -0.918_28, -0.369_67],
        ];
        let inside = RAYS.iter().filter(|ray| self.crossings(point, Vec3::from(**ray)) % 2 == 1);
        inside.count() >= 2
    }

    fn crossings(&self, from: Vec3, ray: Vec3) -> usize {
        let mut count = 0;
        let mut open = vec![0_u32];
        while let Some(i) = open.pop() {
            let node = &self.nodes[i as usize];
            if !ray_meets_box(node, from, ray) {
                continue;
            }
            if node.count == 0 {
                open.extend([i + 1, node.next]);
                continue;
            }
            let own = &self.triangles[node.next as usize..(node.next + node.count) as usize];
            count += own.iter().filter(|t| ray_meets_triangle(t, from, ray)).count();
        }
        count
    }

    /// The nearest points of this mesh and another if they are less than `below_mm` apart.
    ///
    /// With `None` the two are at least `below_mm` apart (surfaces only: see [`Mesh::swallows`]).
    /// `seed` is a pair of triangles that were near before.
    pub fn nearest(
        &self,
        other: &Self,
        placed: &Placed,
        below_mm: f64,
        seed: Option<(u32, u32)>,
        scratch: &mut Scratch,
    ) -> Option<Nearest> {
        let mut search = Search {
            first: self,
            second: other,
            placed,
            best_mm2: below_mm * below_mm,
            found: None,
        };
        scratch.visits = 0;
        if let Some((a, b)) = seed {
            search.try_triangles(a..a + 1, b..b + 1);
        }
        scratch.open.clear();
        scratch.open.push((search.lower_bound(0, 0), 0, 0));
        while let Some((bound, a, b)) = scratch.open.pop() {
            if bound >= search.best_mm2 {
                continue;
            }
            scratch.visits += 1;
            search.look_into(a, b, &mut scratch.open);
        }
        search.found
    }

    /// A lower bound of the distance from the outermost boxes alone, mm.
    pub fn box_distance_mm(&self, other: &Self, placed: &Placed) -> f64 {
        let search =
            Search { first: self, second: other, placed, best_mm2: f64::INFINITY, found: None };
        search.lower_bound(0, 0).sqrt()
    }

    /// A point of the other mesh that lies inside this one, in the frame of this one: where the
    /// surfaces do not meet, it is a piece that is completely inside.
    pub fn swallows(&self, other: &Self, placed: &Placed) -> Option<Vec3> {
        let moved = other.pieces.iter().map(|p| placed.turn * p + placed.shift_mm);
        moved.into_iter().find(|p| self.contains(*p))
    }
}

impl Placed {
    /// The other direction.
    pub fn inverse(&self) -> Self {
        let turn = self.turn.transpose();
        Self { turn, shift_mm: -(turn * self.shift_mm) }
    }
}

struct Search<'m> {
    first: &'m Mesh,
    second: &'m Mesh,
    placed: &'m Placed,
    best_mm2: f64,
    found: Option<Nearest>,
}

impl Search<'_> {
    /// Square of a distance that two nodes are not nearer than.
    #[inline]
    fn lower_bound(&self, a: u32, b: u32) -> f64 {
        let (a, b) = (&self.first.nodes[a as usize], &self.second.nodes[b as usize]);
        let discs = self.disc_bound(&a.disc, &b.disc).max(0.0);
        let squared = discs * discs;
        if squared >= self.best_mm2 { squared } else { squared.max(self.box_bound(a, b)) }
    }

    /// The gaps along both normals and along the line of centres.
    #[inline]
    fn disc_bound(&self, a: &Disc, b: &Disc) -> f64 {
        let turn = &self.placed.turn;
        let apart = turn * b.centre + self.placed.shift_mm - a.centre;
        let normal = turn * b.normal;
        let cosine = a.normal.dot(&normal);
        let (along_a, along_b) = (apart.dot(&a.normal).abs(), apart.dot(&normal).abs());
        let by_first = along_a - a.half - b.reach(cosine);
        let by_second = along_b - b.half - a.reach(cosine);
        let length = apart.norm() + f64::MIN_POSITIVE;
        let by_line = length - a.reach(along_a / length) - b.reach(along_b / length);
        by_first.max(by_second).max(by_line)
    }

    /// The gaps along the axes of each box, the other one wrapped into a box along them, squared.
    #[inline]
    fn box_bound(&self, a: &Node, b: &Node) -> f64 {
        let (turn, shift) = (&self.placed.turn, &self.placed.shift_mm);
        let mut apart = [0.0; 3];
        let mut squared = [0.0_f64; 2];
        for i in 0..3 {
            let mut centre = shift[i] - a.centre[i];
            let mut wide = a.half[i];
            for k in 0..3 {
                centre += turn[(i, k)] * b.centre[k];
                wide += turn[(i, k)].abs() * b.half[k];
            }
            apart[i] = centre;
            let gap = (centre.abs() - wide).max(0.0);
            squared[0] += gap * gap;
        }
        for k in 0..3 {
            let mut along = 0.0;
            let mut wide = b.half[k];
            for i in 0..3 {
                along += turn[(i, k)] * apart[i];
                wide += turn[(i, k)].abs() * a.half[i];
            }
            let gap = (along.abs() - wide).max(0.0);
            squared[1] += gap * gap;
        }
        squared[0].max(squared[1])
    }

    fn look_into(&mut self, a: u32, b: u32, open: &mut Vec<(f64, u32, u32)>) {
        let (of_a, of_b) = (&self.first.nodes[a as usize], &self.second.nodes[b as usize]);
        let split_first = match (of_a.count > 0, of_b.count > 0) {
            (true, true) => {
                let first = of_a.next..of_a.next + of_a.count;
                let second = of_b.next..of_b.next + of_b.count;
                return self.try_triangles(first, second);
            }
            (true, false) => false,
            (false, true) => true,
            (false, false) => of_a.disc.radius > of_b.disc.radius,
        };
        let children = match split_first {
            true => [(a + 1, b), (of_a.next, b)],
            false => [(a, b + 1), (a, of_b.next)],
        };
        let [near, far] = children.map(|(a, b)| (self.lower_bound(a, b), a, b));
        let (near, far) = if near.0 <= far.0 { (near, far) } else { (far, near) };
        for pair in [far, near] {
            if pair.0 < self.best_mm2 {
                open.push(pair);
            }
        }
    }

    fn try_triangles(&mut self, first: std::ops::Range<u32>, second: std::ops::Range<u32>) {
        for b in second {
            let Some(triangle) = self.second.triangles.get(b as usize) else { continue };
            let moved = triangle.map(|c| self.placed.turn * c + self.placed.shift_mm);
            for a in first.clone() {
                let Some(own) = self.first.triangles.get(a as usize) else { continue };
                let Some(gap) = gap(own, &moved, self.best_mm2) else { continue };
                self.best_mm2 = gap.squared_mm2;
                self.found = Some(Nearest {
                    distance_mm: gap.squared_mm2.sqrt(),
                    on_first: gap.on_first,
                    on_second: gap.on_second,
                    triangles: (a, b),
                });
            }
        }
    }
}

fn bounds(triangles: &[Triangle]) -> ([f64; 3], [f64; 3]) {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for corner in triangles.iter().flatten() {
        for i in 0..3 {
            low[i] = low[i].min(corner[i]);
            high[i] = high[i].max(corner[i]);
        }
    }
    (low, high)
}

/// Halves the triangles along the longest side of the box of their centres, down to the leaves.
/// The halves are equal, so the tree is no deeper than the logarithm of their number.
fn build(triangles: &mut [Triangle], first: u32, nodes: &mut Vec<Node>) {
    let (low, high) = bounds(triangles);
    let disc = Disc::around(triangles);
    let mut node = Node { disc, centre: [0.0; 3], half: [0.0; 3], next: first, count: 0 };
    for i in 0..3 {
        node.centre[i] = 0.5 * (low[i] + high[i]);
        // A little more, so that rounding never puts a corner outside.
        node.half[i] = (0.5 * (high[i] - low[i])) + 1e-15 * (low[i].abs() + high[i].abs());
    }
    let own = nodes.len();
    nodes.push(node);
    if triangles.len() <= LEAF {
        nodes[own].count = triangles.len() as u32;
        return;
    }
    let middle_of = |t: &Triangle, i: usize| t[0][i] + t[1][i] + t[2][i];
    let spread = |i: usize| {
        let ends = triangles.iter().map(|t| middle_of(t, i));
        let (low, high) =
            ends.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        high - low
    };
    let spreads = [spread(0), spread(1), spread(2)];
    let longest = (0..3).fold(0, |best, i| if spreads[i] > spreads[best] { i } else { best });
    let half = triangles.len() / 2;
    triangles.select_nth_unstable_by(half, |a, b| {
        middle_of(a, longest).total_cmp(&middle_of(b, longest))
    });
    let (left, right) = triangles.split_at_mut(half);
    build(left, first, nodes);
    nodes[own].next = nodes.len() as u32;
    build(right, first + half as u32, nodes);
}

/// A corner of each connected piece, and whether each edge belongs to an even number of triangles.
fn connect(triangles: &[Triangle]) -> (Vec<Vec3>, bool) {
    // `+ 0.0` makes −0 and 0 the same corner.
    let key = |c: &Vec3| [c.x, c.y, c.z].map(|v| (v + 0.0).to_bits());
    let mut corners: HashMap<[u64; 3], u32> = HashMap::with_capacity(triangles.len());
    let mut parent: Vec<u32> = Vec::new();
    let mut edges: HashMap<(u32, u32), bool> = HashMap::with_capacity(2 * triangles.len());
    let mut places: Vec<Vec3> = Vec::new();
    for triangle in triangles {
        let ids = triangle.map(|corner| {
            *corners.entry(key(&corner)).or_insert_with(|| {
                places.push(corner);
                parent.push(parent.len() as u32);
                parent.len() as u32 - 1
            })
        });
        for k in 0..3 {
            let (from, to) = (ids[k], ids[(k + 1) % 3]);
            if from == to {
                continue;
            }
            *edges.entry((from.min(to), from.max(to))).or_insert(false) ^= true;
            let (a, b) = (root_of(&mut parent, from), root_of(&mut parent, to));
            parent[a as usize] = b;
        }
    }
    let count = parent.len() as u32;
    let roots = (0..count).filter(|i| root_of(&mut parent, *i) == *i);
    let pieces = roots.map(|i| places[i as usize]).collect();
    (pieces, edges.values().all(|odd| !odd))
}

fn root_of(parent: &mut [u32], mut at: u32) -> u32 {
    while parent[at as usize] != at {
        // Makes the next one faster.
        parent[at as usize] = parent[parent[at as usize] as usize];
        at = parent[at as usize];
    }
    at
}

fn ray_meets_box(node: &Node, from: Vec3, ray: Vec3) -> bool {
    let (mut enter, mut leave) = (0.0_f64, f64::INFINITY);
    for i in 0..3 {
        let near = (node.centre[i] - node.half[i] - from[i]) / ray[i];
        let far = (node.centre[i] + node.half[i] - from[i]) / ray[i];
        enter = enter.max(near.min(far));
        leave = leave.min(near.max(far));
    }
    enter <= leave * (1.0 + 1e-12) + 1e-12
}

/// Möller and Trumbore, "Fast, minimum storage ray-triangle intersection", 1997.
fn ray_meets_triangle(t: &Triangle, from: Vec3, ray: Vec3) -> bool {
    let (u, v) = (t[1] - t[0], t[2] - t[0]);
    let p = ray.cross(&v);
    let determinant = u.dot(&p);
    if determinant == 0.0 {
        return false;
    }
    let s = from - t[0];
    let q = s.cross(&u);
    let (a, b) = (s.dot(&p) / determinant, ray.dot(&q) / determinant);
    a >= 0.0 && b >= 0.0 && a + b <= 1.0 && v.dot(&q) / determinant > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collide::shape::cuboid;
    use trueaxis_geometry::frame::rotation;

    fn at(x: f64, y: f64, z: f64) -> Placed {
        Placed { turn: Mat3::identity(), shift_mm: Vec3::new(x, y, z) }
    }

    fn distance(a: &Mesh, b: &Mesh, placed: &Placed) -> f64 {
        a.nearest(b, placed, 1e6, None, &mut Scratch::default()).unwrap().distance_mm
    }

    #[test]
    fn two_boxes_by_hand() {
        let a = Mesh::new(cuboid(Vec3::new(2.0, 2.0, 2.0))).unwrap();
        let b = Mesh::new(cuboid(Vec3::new(4.0, 4.0, 4.0))).unwrap();
        assert_eq!(distance(&a, &b, &at(10.0, 0.0, 0.0)), 7.0); // 10 − 1 − 2
        assert_eq!(distance(&a, &b, &at(6.0, 7.0, 0.0)), 5.0); // edges 3 and 4 apart
        assert_eq!(distance(&a, &b, &at(2.5, 0.0, 0.0)), 0.0);
        // Turned by 45° about z: the edge at 2√2 points towards a.
        let turn = rotation(Vec3::z(), std::f64::consts::FRAC_PI_4);
        let turned = Placed { turn, shift_mm: Vec3::new(10.0, 0.0, 0.0) };
        assert!((distance(&a, &b, &turned) - (9.0 - 8.0_f64.sqrt())).abs() < 1e-12);
    }

    /// A square of 2 mm at z = 5: no thickness, the centre in its middle, √2 to its corners. Whatever the triangles are, no corner
    /// is outside, along any direction.
    #[test]
    fn law_a_disc_holds_its_corners() {
        let [a, b, c, d] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        let [a, b, c, d] = [a, b, c, d].map(|[x, y]: [f64; 2]| Vec3::new(3.0 + x, y - 4.0, 5.0));
        let square = [[a, b, c], [a, c, d]];
        let disc = Disc::around(&square);
        assert!((disc.centre - Vec3::new(3.0, -4.0, 5.0)).norm() < 1e-12, "{disc:?}");
        assert!(disc.half.abs() < 1e-12 && (disc.radius - 2.0_f64.sqrt()).abs() < 1e-12);
        let turn = rotation(Vec3::new(1.0, 2.0, -0.5).normalize(), 0.7);
        let bow: Vec<Triangle> = cuboid(Vec3::new(2.0, 3.0, 0.4))
            .into_iter()
            .map(|t| t.map(|corner| turn * corner + Vec3::new(20.0, -7.0, 3.0)))
            .collect();
        for part in [&bow[..], &bow[..3], &square] {
            let disc = Disc::around(part);
            for direction in
                part.iter().flatten().map(|c| (c - Vec3::new(1.0, 2.0, 3.0)).normalize())
            {
                let reach = disc.reach(direction.dot(&disc.normal));
                let farthest = part
                    .iter()
                    .flatten()
                    .map(|c| (c - disc.centre).dot(&direction).abs())
                    .fold(0.0, f64::max);
                assert!(reach >= farthest && reach < 10.0, "{reach} {farthest}");
            }
        }
    }

    #[test]
    fn a_box_inside_another_touches_no_surface() {
        let inner = Mesh::new(cuboid(Vec3::new(2.0, 2.0, 2.0))).unwrap();
        let outer = Mesh::new(cuboid(Vec3::new(9.0, 9.0, 9.0))).unwrap();
        assert!(outer.is_closed() && outer.piece_count() == 1);
        assert_eq!(distance(&outer, &inner, &at(0.0, 0.0, 0.0)), 3.5);
        assert!(outer.swallows(&inner, &at(0.0, 0.0, 0.0)).is_some());
        assert!(outer.swallows(&inner, &at(20.0, 0.0, 0.0)).is_none());
        assert!(inner.swallows(&outer, &at(0.0, 0.0, 0.0)).is_none());
    }
}
