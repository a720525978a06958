//! Decimation of curves: extremes of every pixel column, and the Douglas–Peucker algorithm for paths.

/// A time series in pixels as the smallest and largest value of every pixel column, in the order they came.
///
/// Points that are not finite are kept as one break.
pub fn columns(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut out = Vec::new();
    let same_column =
        |a: &[f64; 2], b: &[f64; 2]| is_finite(a) == is_finite(b) && (!is_finite(a) || a[0].floor() == b[0].floor());
    for chunk in points.chunk_by(same_column) {
        if is_finite(&chunk[0]) { out.extend(extremes(chunk)) } else { out.push([f64::NAN; 2]) }
    }
    out
}

/// First, lowest, highest and last point of a chunk without repeats, in order.
fn extremes(chunk: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let by_value = |a: &usize, b: &usize| chunk[*a][1].total_cmp(&chunk[*b][1]);
    let low = (0..chunk.len()).min_by(by_value).unwrap_or(0);
    let high = (0..chunk.len()).max_by(by_value).unwrap_or(0);
    let mut keep = vec![0, low, high, chunk.len() - 1];
    keep.sort_unstable();
    keep.dedup();
    keep.into_iter().map(|i| chunk[i]).collect()
}

fn is_finite(p: &[f64; 2]) -> bool {
    p[0].is_finite() && p[1].is_finite()
}

/// Paths in pixels with at most about `most` points together.
///
/// Points nearer than a tolerance to the one before go first, then those that lie on a straight line
/// (Douglas–Peucker). Where there are more paths than half of `most`, only every n-th path stays.
pub fn paths(pieces: &[Vec<[f64; 2]>], most: usize) -> Vec<Vec<[f64; 2]>> {
    let stride = (2 * pieces.len()).div_ceil(most.max(2)).max(1);
    let mut pieces: Vec<Vec<[f64; 2]>> = pieces.iter().step_by(stride).map(|p| spaced(p, 0.25)).collect();
    let mut tolerance = 0.5;
    while pieces.iter().map(Vec::len).sum::<usize>() > 4 * most && tolerance < 1e4 {
        pieces = pieces.iter().map(|p| spaced(p, tolerance)).collect();
        tolerance *= 2.0;
    }
    thinned(pieces, most)
}

fn thinned(pieces: Vec<Vec<[f64; 2]>>, most: usize) -> Vec<Vec<[f64; 2]>> {
    let mut tolerance = 0.1;
    loop {
        let out: Vec<_> = pieces.iter().map(|p| straightened(p, tolerance)).collect();
        if out.iter().map(Vec::len).sum::<usize>() <= most || tolerance > 1e4 {
            return out;
        }
        tolerance *= 2.0;
    }
}

/// Points no nearer than a distance to the one kept before; ends and breaks stay.
fn spaced(points: &[[f64; 2]], distance: f64) -> Vec<[f64; 2]> {
    let mut out: Vec<[f64; 2]> = Vec::new();
    for (i, p) in points.iter().enumerate() {
        let far = out.last().is_none_or(|q| match (is_finite(p), is_finite(q)) {
            (true, true) => (p[0] - q[0]).hypot(p[1] - q[1]) >= distance,
            (p_finite, q_finite) => p_finite != q_finite,
        });
        if far || (i + 1 == points.len() && is_finite(p)) {
            out.push(*p);
        }
    }
    out
}

/// Douglas–Peucker on every stretch without a break.
fn straightened(points: &[[f64; 2]], tolerance: f64) -> Vec<[f64; 2]> {
    let mut out = Vec::new();
    for stretch in points.chunk_by(|a, b| is_finite(a) == is_finite(b)) {
        if is_finite(&stretch[0]) { out.extend(douglas_peucker(stretch, tolerance)) } else { out.push([f64::NAN; 2]) }
    }
    out
}

fn douglas_peucker(points: &[[f64; 2]], tolerance: f64) -> Vec<[f64; 2]> {
    let mut keep = vec![false; points.len()];
    let last = points.len() - 1;
    (keep[0], keep[last]) = (true, true);
    let mut todo = vec![(0, last)];
    while let Some((from, to)) = todo.pop() {
        let distance = |i: &usize| from_chord(points[*i], points[from], points[to]);
        let farthest = (from + 1..to).max_by(|a, b| distance(a).total_cmp(&distance(b)));
        if let Some(middle) = farthest.filter(|i| distance(i) > tolerance) {
            keep[middle] = true;
            todo.extend([(from, middle), (middle, to)]);
        }
    }
    points.iter().zip(keep).filter_map(|(p, k)| k.then_some(*p)).collect()
}

/// Distance of a point from the segment between two others.
fn from_chord(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let length = dx * dx + dy * dy;
    let along = ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length;
    let t = if length > 0.0 { along.clamp(0.0, 1.0) } else { 0.0 };
    (p[0] - a[0] - t * dx).hypot(p[1] - a[1] - t * dy)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_column_keeps_its_extremes() {
        let mut points: Vec<[f64; 2]> = (0..1000).map(|i| [f64::from(i) / 100.0, 0.0]).collect();
        points[555][1] = 7.0;
        points[556][1] = -7.0;
        let kept = columns(&points);
        assert!(kept.len() <= 40 && kept.contains(&points[555]) && kept.contains(&points[556]));
    }

    #[test]
    fn a_hole_stays_a_hole() {
        let points = [[0.0, 0.0], [f64::NAN, 0.0], [f64::NAN, 1.0], [5.0, 0.0], [9.0, 0.0]];
        assert_eq!(columns(&points).len(), 4);
        assert_eq!(paths(&[points.to_vec()], 100)[0].len(), 4);
    }

    #[test]
    fn a_straight_path_keeps_its_ends_and_a_corner_its_tip() {
        let straight: Vec<_> = (0..100).map(|i| [f64::from(i), 0.0]).collect();
        assert_eq!(paths(&[straight], 100), [[[0.0, 0.0], [99.0, 0.0]]]);
        let corner: Vec<_> = (0..100).map(|i| [f64::from(i), f64::from((50_i32 - i).abs())]).collect();
        assert_eq!(paths(&[corner], 100), [[[0.0, 50.0], [50.0, 0.0], [99.0, 49.0]]]);
    }

    #[test]
    fn many_pieces_and_many_points_stay_within_the_bound() {
        let noisy: Vec<_> = (0..200_000u64).map(|i| [(i * 7919 % 500) as f64, (i * 104_729 % 400) as f64]).collect();
        assert!(paths(&[noisy], 1000)[0].len() <= 1000);
        let pieces = vec![vec![[0.0, 0.0], [5.0, 5.0]]; 50_000];
        assert!(paths(&pieces, 1000).len() <= 1000);
    }

    #[test]
    fn as_many_pieces_stay_as_two_points_each_allow() {
        let pieces = |n| vec![vec![[0.0, 0.0], [5.0, 5.0]]; n];
        assert_eq!([500, 501, 50_000].map(|n| paths(&pieces(n), 1000).len()), [500, 251, 500]);
    }

    #[test]
    fn the_tolerance_is_the_first_that_leaves_few_enough() {
        let spike = |h: f64| vec![[0.0, 0.0], [100.0, h], [200.0, 0.0]];
        let pieces = [0.15, 0.3, 0.6, 1.2].map(spike).to_vec();
        let kept = |most| thinned(pieces.clone(), most).iter().map(Vec::len).collect::<Vec<_>>();
        assert_eq!(kept(12), [3, 3, 3, 3]);
        assert_eq!(kept(11), [2, 3, 3, 3]);
        assert_eq!(kept(10), [2, 2, 3, 3]);
        assert_eq!(kept(9), [2, 2, 2, 3]);
    }

    #[test]
    fn what_cannot_be_thinned_is_left_as_it_is() {
        let broken: Vec<_> = (0..200).map(|i| if i % 2 == 0 { [f64::from(i), 0.0] } else { [f64::NAN; 2] }).collect();
        assert_eq!(paths(&[broken], 10)[0].len(), 200);
    }

    #[test]
    fn a_closed_path_keeps_its_corners() {
        let square = [[0.0, 0.0], [50.0, 0.0], [50.0, 50.0], [0.0, 50.0], [0.0, 0.0]];
        assert_eq!(paths(&[square.to_vec()], 100), [square]);
    }

    #[test]
    fn distances_are_from_the_segment_and_not_from_its_line() {
        let from = |p| from_chord(p, [1.0, 1.0], [4.0, 5.0]);
        // Beside its middle, before its beginning, behind its end, all 5 away.
        for p in [[-1.5, 6.0], [-2.0, -3.0], [7.0, 9.0]] {
            assert!((from(p) - 5.0).abs() < 1e-12, "{p:?}: {}", from(p));
        }
        assert_eq!(from_chord([4.0, 5.0], [1.0, 1.0], [1.0, 1.0]), 5.0);
    }

    #[test]
    fn points_nearer_than_the_distance_go_but_the_last() {
        let hole = [f64::NAN; 2];
        let points = [[0.0, 0.0], [3.0, 4.0], [3.0, 5.0], hole, hole, [9.0, 9.0], [9.0, 9.5], [9.0, 9.75]];
        let kept = spaced(&points, 5.0);
        assert_eq!([kept[0], kept[1], kept[3], kept[4]], [[0.0, 0.0], [3.0, 4.0], [9.0, 9.0], [9.0, 9.75]]);
        assert!(kept.len() == 5 && kept[2][0].is_nan());
    }
}
