//! The roles of a model file matched with the columns of a log by their names.

use super::column_names::rank;

/// What a log offers for a role.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Match {
    /// The role.
    pub role: String,
    /// The column that most likely holds it.
    pub column: Option<String>,
    /// Other columns that may.
    pub others: Vec<String>,
}

/// Other columns that are mentioned.
const MENTIONED_COLUMNS: usize = 4;

/// A column for every role, each column once: the likeliest pair of all first.
///
/// Of two roles that stand for each other only one gets a column; `may_hold` says whether the values of a column can be those
/// of a role.
pub(crate) fn matched(
    roles: &[String],
    instead: &[(String, String)],
    header: &[String],
    may_hold: &dyn Fn(&str, usize) -> bool,
) -> Vec<Match> {
    let all = roles.iter().enumerate().flat_map(|(r, role)| {
        header.iter().enumerate().filter_map(move |(c, column)| rank(role, column).map(|rank| (rank, r, c)))
    });
    let mut all: Vec<(usize, usize, usize)> =
        all.filter(|(_, r, c)| only(header, *c) && may_hold(&roles[*r], *c)).collect();
    all.sort_unstable();
    let mut taken: Vec<Option<usize>> = vec![None; roles.len()];
    let rival = |r: usize| -> Option<usize> {
        let other = instead.iter().find_map(|(a, b)| match &roles[r] {
            role if role == a => Some(b),
            role if role == b => Some(a),
            _ => None,
        })?;
        roles.iter().position(|role| role == other)
    };
    for (_, r, c) in &all {
        let settled = taken[*r].is_some() || taken.contains(&Some(*c)) || rival(*r).is_some_and(|o| taken[o].is_some());
        if !settled {
            taken[*r] = Some(*c);
        }
    }
    let others = |r: usize| {
        let more = all.iter().filter(|(_, role, c)| *role == r && !taken.contains(&Some(*c)));
        more.map(|(_, _, c)| header[*c].clone()).take(MENTIONED_COLUMNS).collect()
    };
    let one = |(r, role): (usize, &String)| Match {
        role: role.clone(),
        column: taken[r].map(|c| header[c].clone()),
        others: others(r),
    };
    roles.iter().enumerate().map(one).collect()
}

/// Whether a column can be named in a model file: its name is not blank, of one line, and stands once.
fn only(header: &[String], c: usize) -> bool {
    let name = &header[c];
    !name.trim().is_empty() && !name.contains(char::is_control) && header.iter().filter(|n| *n == name).count() == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns(roles: &str, header: &str) -> Vec<Option<String>> {
        let split = |s: &str| s.split(',').map(str::to_string).collect::<Vec<_>>();
        let instead = [("wheel_rate".to_string(), "speed".to_string())];
        matched(&split(roles), &instead, &split(header), &|_, _| true).into_iter().map(|m| m.column).collect()
    }

    #[test]
    fn every_column_is_given_once_and_the_likeliest_first() {
        let found = columns("time,x,y,heading,wheel_rate,speed,yaw_rate", "t,x,y,theta,theta_dot,v,omega");
        let expect = [Some("t"), Some("x"), Some("y"), Some("theta"), Some("theta_dot"), None, Some("omega")];
        assert_eq!(found, expect.map(|c| c.map(str::to_string)), "one of wheel_rate and speed");
        let found = columns("x,y", "odom_x,odom_y,gt_x,gt_y");
        assert_eq!(found, [Some("gt_x".to_string()), Some("gt_y".to_string())]);
    }

    #[test]
    fn a_name_that_stands_twice_cannot_be_meant() {
        assert_eq!(columns("x", "x,x,pos_x"), [Some("pos_x".to_string())]);
        assert_eq!(columns("x", ""), [None]);
    }

    fn others(roles: &str, header: &str) -> Vec<Vec<String>> {
        let split = |s: &str| s.split(',').map(str::to_string).collect::<Vec<_>>();
        matched(&split(roles), &[], &split(header), &|_, _| true).into_iter().map(|m| m.others).collect()
    }

    #[test]
    fn other_columns_that_may_be_meant_are_mentioned_likeliest_first() {
        assert_eq!(
            others("x,y", "gt_x,y,odom_x,px,est_x,cmd_x,set_x"),
            [&["gt_x", "odom_x", "est_x", "cmd_x"][..], &[]]
        );
        // A column that another role has is not one of them.
        assert_eq!(others("wheel_rate_left,wheel_rate_right", "left,right,wl"), [&["left"][..], &[]]);
    }

    #[test]
    fn the_likelier_of_two_roles_that_stand_for_each_other_gets_its_column() {
        let one = |text: &str| Some(text.to_string());
        assert_eq!(columns("speed,wheel_rate", "v,theta_dot"), [one("v"), None], "equally likely: the first");
        assert_eq!(columns("speed,wheel_rate", "vx,theta_dot"), [None, one("theta_dot")]);
        assert_eq!(columns("wheel_rate,speed", "theta_dot,speed"), [None, one("speed")]);
        assert_eq!(columns("wheel_rate,yaw_rate", "theta_dot,omega"), [one("theta_dot"), one("omega")]);
    }

    #[test]
    fn a_name_that_cannot_be_written_is_not_meant() {
        assert!(!only(&[" ".into()], 0) && !only(&["x\n".into()], 0) && !only(&["x".into(), "x".into()], 1));
        assert!(only(&["x".into(), "y".into()], 1));
    }
}
