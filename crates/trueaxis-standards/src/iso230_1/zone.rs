//! Reference lines and planes: least squares, through points, minimum zone.
//!
//! A deviation from straightness or flatness is w·h: the heights h with weights w that no line (plane) changes. The
//! weights carry the uncertainty of the heights. The general minimum zone stands in the crate of form
//! fits; here are a line and a plane with small slopes.

/// The range of the heights about a reference.
#[derive(Debug, Clone, PartialEq)]
pub struct Zone {
    /// The heights less the reference, mm.
    pub residuals_mm: Vec<f64>,
    /// Their range, mm.
    pub range_mm: f64,
    /// The range as a sum over the heights, for its uncertainty. Unit: 1.
    pub weights: Vec<f64>,
}

impl Zone {
    /// About a reference that is `weights · heights` at each point.
    fn about(heights: &[f64], reference: &dyn Fn(usize) -> Vec<f64>) -> Self {
        let at = |i: usize| -> f64 { reference(i).iter().zip(heights).map(|(w, h)| w * h).sum() };
        let residuals_mm: Vec<f64> = (0..heights.len()).map(|i| heights[i] - at(i)).collect();
        let (low, high) = extremes(&residuals_mm);
        let mut weights: Vec<f64> =
            reference(low).iter().zip(reference(high)).map(|(l, h)| l - h).collect();
        weights[high] += 1.0;
        weights[low] -= 1.0;
        let range_mm = residuals_mm[high] - residuals_mm[low];
        Self { residuals_mm, range_mm, weights }
    }
}

fn extremes(values: &[f64]) -> (usize, usize) {
    let (mut low, mut high) = (0, 0);
    for (i, v) in values.iter().enumerate() {
        low = if *v < values[low] { i } else { low };
        high = if *v > values[high] { i } else { high };
    }
    // All are the same: the first and one in the middle stand for them.
    if low == high { (low, values.len() / 2) } else { (low, high) }
}

/// Slope of the least-squares line as a sum over the heights, 1/mm.
pub fn slope_weights(x: &[f64]) -> Vec<f64> {
    let mean = x.iter().sum::<f64>() / x.len() as f64;
    let square: f64 = x.iter().map(|x| (x - mean).powi(2)).sum();
    x.iter().map(|x| (x - mean) / square).collect()
}

/// About the least-squares line.
pub fn line_least_squares(x: &[f64], heights: &[f64]) -> Zone {
    let (slope, count) = (slope_weights(x), x.len() as f64);
    let mean = x.iter().sum::<f64>() / count;
    Zone::about(heights, &|i| slope.iter().map(|s| 1.0 / count + s * (x[i] - mean)).collect())
}

/// About the line through the first and the last point.
pub fn line_end_points(x: &[f64], heights: &[f64]) -> Zone {
    let last = x.len() - 1;
    Zone::about(heights, &|i| {
        let share = (x[i] - x[0]) / (x[last] - x[0]);
        let mut weights = vec![0.0; x.len()];
        weights[0] = 1.0 - share;
        weights[last] += share;
        weights
    })
}

/// Between the closest parallels: one of them goes through two points of the hull, the other through one between.
pub fn line_minimum_zone(x: &[f64], heights: &[f64]) -> Zone {
    let plane: Vec<[f64; 2]> = x.iter().map(|x| [*x, 0.0]).collect();
    let mut best: Option<(f64, f64)> = None;
    for side in [1.0, -1.0] {
        let hull = hull(x, heights, side);
        for pair in hull.windows(2) {
            let slope = (heights[pair[1]] - heights[pair[0]]) / (x[pair[1]] - x[pair[0]]);
            let width = width(&plane, heights, [slope, 0.0]);
            if best.is_none_or(|(least, _)| width < least) {
                best = Some((width, slope));
            }
        }
    }
    let (_, slope) = best.unwrap_or((0.0, 0.0));
    of_slope(&plane, heights, [slope, 0.0])
}

/// The points of the upper (`side` 1) or lower hull, in the order of x.
fn hull(x: &[f64], heights: &[f64], side: f64) -> Vec<usize> {
    let mut hull: Vec<usize> = Vec::new();
    for i in 0..x.len() {
        while let [.., a, b] = hull[..] {
            let turn = (x[b] - x[a]) * (heights[i] - heights[a])
                - (heights[b] - heights[a]) * (x[i] - x[a]);
            if turn * side < 0.0 {
                break;
            }
            hull.pop();
        }
        hull.push(i);
    }
    hull
}

fn width(at: &[[f64; 2]], heights: &[f64], slope: [f64; 2]) -> f64 {
    let residuals = residuals(at, heights, slope);
    let (low, high) = extremes(&residuals);
    residuals[high] - residuals[low]
}

fn residuals(at: &[[f64; 2]], heights: &[f64], [a, b]: [f64; 2]) -> Vec<f64> {
    at.iter().zip(heights).map(|([x, y], h)| h - a * x - b * y).collect()
}

/// The zone of a slope that is the best: its weights are those of the points that touch its sides.
fn of_slope(at: &[[f64; 2]], heights: &[f64], slope: [f64; 2]) -> Zone {
    let mut residuals_mm = residuals(at, heights, slope);
    let (low, high) = extremes(&residuals_mm);
    let range_mm = residuals_mm[high] - residuals_mm[low];
    let middle = 0.5 * (residuals_mm[high] + residuals_mm[low]);
    residuals_mm.iter_mut().for_each(|r| *r -= middle);
    let weights = touching(at, &residuals_mm, range_mm);
    Zone { residuals_mm, range_mm, weights }
}

/// Σ w = 0, Σ w x = 0, Σ w y = 0, Σ w⁺ = 1 with w > 0 above and w < 0 below, over the points that touch.
///
/// Where rounding hides which points balance, the difference of the highest and the lowest point: no less uncertain.
fn touching(at: &[[f64; 2]], residuals: &[f64], range: f64) -> Vec<f64> {
    let mut weights = vec![0.0; at.len()];
    for share in [1e-9, 1e-7, 1e-5] {
        let near = (share * range).max(1e-13);
        let touches = |i: &usize| residuals[*i].abs() > 0.5 * range - near;
        let points: Vec<usize> = (0..at.len()).filter(touches).take(12).collect();
        for chosen in subsets(&points) {
            if let Some(found) = balance(at, residuals, &chosen) {
                for (i, w) in chosen.iter().zip(found) {
                    weights[*i] = w;
                }
                return weights;
            }
        }
    }
    let (low, high) = extremes(residuals);
    weights[low] -= 1.0;
    weights[high] += 1.0;
    weights
}

/// Two, three and four of the points, smallest sets first.
fn subsets(points: &[usize]) -> Vec<Vec<usize>> {
    let mut all: Vec<Vec<usize>> = (0_u32..1 << points.len())
        .filter(|bits| (2..=4).contains(&bits.count_ones()))
        .map(|bits| (0..points.len()).filter(|i| bits & (1 << i) != 0).map(|i| points[i]).collect())
        .collect();
    all.sort_by_key(Vec::len);
    all
}

/// The weights of some points, if they hold the zone.
fn balance(at: &[[f64; 2]], residuals: &[f64], chosen: &[usize]) -> Option<Vec<f64>> {
    // Least squares of the four conditions over signed unknowns that must come out positive.
    let sign: Vec<f64> = chosen.iter().map(|i| residuals[*i].signum()).collect();
    let scale = at.iter().flatten().fold(1e-9_f64, |m, v| m.max(v.abs()));
    let rows = nalgebra::DMatrix::from_fn(4, chosen.len(), |r, k| {
        let [x, y] = at[chosen[k]];
        match r {
            0 => f64::from(u8::from(sign[k] > 0.0)),
            1 => sign[k],
            2 => sign[k] * x / scale,
            _ => sign[k] * y / scale,
        }
    });
    let right = nalgebra::DVector::from_vec(vec![1.0, 0.0, 0.0, 0.0]);
    let found = rows.clone().svd(true, true).solve(&right, 1e-12).ok()?;
    let holds = (&rows * &found - right).amax() < 1e-7 && found.iter().all(|w| *w > -1e-9);
    holds.then(|| found.iter().zip(sign).map(|(w, s)| w * s).collect())
}

/// Weights of the least-squares plane at a point.
fn plane_weights(at: &[[f64; 2]]) -> Option<nalgebra::DMatrix<f64>> {
    let columns = nalgebra::DMatrix::from_fn(at.len(), 3, |i, k| match k {
        0 => 1.0,
        k => at[i][k - 1],
    });
    let inverse = (columns.transpose() * &columns).try_inverse()?;
    Some(&columns * inverse * columns.transpose())
}

/// About the least-squares plane.
pub fn plane_least_squares(at: &[[f64; 2]], heights: &[f64]) -> Option<Zone> {
    let hat = plane_weights(at)?;
    Some(Zone::about(heights, &|i| hat.row(i).iter().copied().collect()))
}

/// About the plane through three of the points.
pub fn plane_three_points(at: &[[f64; 2]], heights: &[f64], three: [usize; 3]) -> Option<Zone> {
    let corners = nalgebra::Matrix3::from_fn(|i, k| match k {
        0 => 1.0,
        k => at[three[i]][k - 1],
    });
    let inverse = corners.try_inverse()?;
    Some(Zone::about(heights, &|i| {
        let shares = nalgebra::RowVector3::new(1.0, at[i][0], at[i][1]) * inverse;
        let mut weights = vec![0.0; at.len()];
        for (k, point) in three.iter().enumerate() {
            weights[*point] += shares[k];
        }
        weights
    }))
}

/// Between the closest parallel planes.
///
/// Exact on a few points, to which those farthest outside are added until none is outside: the width over all is that of
/// the few. Of the few, two edges (or a face, which is two edges with a common point) give the slope.
pub fn plane_minimum_zone(at: &[[f64; 2]], heights: &[f64]) -> Option<Zone> {
    let start = plane_least_squares(at, heights)?;
    let (low, high) = extremes(&start.residuals_mm);
    let mut few: Vec<usize> = vec![low, high];
    // Four corners of the region, so that the first slopes are determined.
    for direction in [[1.0, 1.1], [-1.0, 1.2], [1.3, -1.0], [-1.4, -1.0]] {
        let along = |i: &usize| at[*i][0] * direction[0] + at[*i][1] * direction[1];
        few.extend((0..at.len()).max_by(|a, b| along(a).total_cmp(&along(b))));
    }
    few.sort_unstable();
    few.dedup();
    let mut last = 0.0;
    for _ in 0..200 {
        let (width, slope) = best_slope(at, heights, &few)?;
        let all = residuals(at, heights, slope);
        let (low, high) = extremes(&all);
        if all[high] - all[low] <= width * (1.0 + 1e-12) + 1e-15 {
            return Some(of_slope(at, heights, slope));
        }
        if width > last * (1.0 + 1e-12) {
            // Those that do not touch are not needed any more.
            let own = residuals(at, heights, slope);
            let (top, bottom) =
                few.iter().fold((f64::MIN, f64::MAX), |(t, b), i| (t.max(own[*i]), b.min(own[*i])));
            let near = 1e-9 * width;
            few.retain(|i| own[*i] > top - near || own[*i] < bottom + near);
        }
        last = width;
        few.extend([low, high]);
        few.sort_unstable();
        few.dedup();
    }
    None
}

/// The slope of the smallest width over a few points.
fn best_slope(at: &[[f64; 2]], heights: &[f64], few: &[usize]) -> Option<(f64, [f64; 2])> {
    let edges: Vec<(usize, usize)> =
        few.iter().flat_map(|a| few.iter().filter(move |b| a < b).map(move |b| (*a, *b))).collect();
    let step = |(a, b): (usize, usize)| {
        (at[b][0] - at[a][0], at[b][1] - at[a][1], heights[b] - heights[a])
    };
    let mut best: Option<(f64, [f64; 2])> = None;
    for (k, one) in edges.iter().enumerate() {
        for other in &edges[k + 1..] {
            let ((x, y, h), (p, q, g)) = (step(*one), step(*other));
            let area = x * q - y * p;
            if area.abs() <= 1e-12 * (x.hypot(y) * p.hypot(q)) {
                continue;
            }
            let slope = [(h * q - y * g) / area, (x * g - h * p) / area];
            let of = |i: &usize| heights[*i] - slope[0] * at[*i][0] - slope[1] * at[*i][1];
            let (low, high) = few
                .iter()
                .map(of)
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
            if best.is_none_or(|(least, _)| high - low < least) {
                best = Some((high - low, slope));
            }
        }
    }
    best
}
