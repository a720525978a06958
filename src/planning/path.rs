//! A path to be followed: points joined by straight pieces, and the foot of a place on it.

/// A path in the plane.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Path {
    points: Vec<[f64; 2]>,
    /// Length up to each point, m.
    lengths: Vec<f64>,
}

/// The nearest point of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foot {
    /// How far to the left of the path the place lies, m.
    pub off: f64,
    /// The direction to the left.
    pub normal: [f64; 2],
}

/// How far from the share of the time that has passed the share of the way may be: a path that meets itself is not cut short.
const AHEAD: f64 = 0.25;

impl Path {
    /// A path through points; points that repeat the one before are left out.
    pub fn through(points: &[[f64; 2]]) -> Self {
        let mut path = Self::default();
        for p in points {
            let step = path.points.last().map_or(f64::INFINITY, |q: &[f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]));
            if step > 0.0 {
                path.lengths.push(path.lengths.last().map_or(0.0, |l| l + step));
                path.points.push(*p);
            }
        }
        path
    }

    /// Its length, m.
    pub fn length(&self) -> f64 {
        self.lengths.last().copied().unwrap_or(0.0)
    }

    /// The point at a share of its length, and the direction there, rad.
    pub fn at(&self, share: f64) -> Option<([f64; 2], f64)> {
        let s = share.clamp(0.0, 1.0) * self.length();
        let i = self.lengths.partition_point(|l| *l < s).max(1);
        let (a, b) = (self.points.get(i - 1)?, self.points.get(i)?);
        let part = (s - self.lengths[i - 1]) / (self.lengths[i] - self.lengths[i - 1]);
        Some(([0, 1].map(|k| a[k] + part * (b[k] - a[k])), (b[1] - a[1]).atan2(b[0] - a[0])))
    }

    /// The foot of a place on what can have been reached after a share of the time.
    pub fn nearest(&self, place: [f64; 2], share: f64) -> Option<Foot> {
        let whole = self.length();
        let reach = [(share - AHEAD) * whole, (share + AHEAD) * whole];
        let pieces = self.points.windows(2).zip(self.lengths.windows(2));
        let near = pieces.filter(|(_, l)| l[1] >= reach[0] && l[0] <= reach[1]);
        let foot = |(w, l): (&[[f64; 2]], &[f64])| {
            let along = [0, 1].map(|k| (w[1][k] - w[0][k]) / (l[1] - l[0]));
            let from = [place[0] - w[0][0], place[1] - w[0][1]];
            let s = (from[0] * along[0] + from[1] * along[1]).clamp(0.0, l[1] - l[0]);
            let off = [0, 1].map(|k| from[k] - s * along[k]);
            let normal = [-along[1], along[0]];
            let distance = off[0].hypot(off[1]);
            (distance, Foot { off: off[0] * normal[0] + off[1] * normal[1], normal })
        };
        near.map(foot).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, foot)| foot)
    }

    /// How far a place is from the path, m.
    pub fn distance(&self, place: [f64; 2]) -> f64 {
        let to_piece = |w: &[[f64; 2]]| {
            let along = [w[1][0] - w[0][0], w[1][1] - w[0][1]];
            let square = along[0].powi(2) + along[1].powi(2);
            let from = [place[0] - w[0][0], place[1] - w[0][1]];
            let share = ((from[0] * along[0] + from[1] * along[1]) / square).clamp(0.0, 1.0);
            (from[0] - share * along[0]).hypot(from[1] - share * along[1])
        };
        self.points.windows(2).map(to_piece).fold(f64::INFINITY, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_foot_lies_across_the_path_and_not_on_the_way_back() {
        let path = Path::through(&[[0.0, 0.0], [0.0, 0.0], [4.0, 0.0], [4.0, 0.1], [0.0, 0.1]]);
        assert!((path.length() - 8.1).abs() < 1e-12);
        let out = path.nearest([1.0, 0.3], 0.1).unwrap();
        assert!((out.off - 0.3).abs() < 1e-12 && out.normal == [0.0, 1.0]);
        let back = path.nearest([1.0, 0.3], 0.9).unwrap();
        assert!((back.off + 0.2).abs() < 1e-12 && path.distance([1.0, 0.3]) < 0.2 + 1e-12);
        let (place, course) = path.at(0.5).unwrap();
        assert!((place[0] - 4.0).abs() < 0.06 && (course - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
        assert_eq!(Path::default().nearest([0.0, 0.0], 0.5), None);
    }
}
