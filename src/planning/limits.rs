//! Limits of inputs and of their rates.

use crate::error::{Error, Result};
use crate::files::advice;
use crate::model::Model;
use crate::vehicles::Moves;

/// The limits of an input: least, most, and the most by which it changes in a second.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// Its role.
    pub role: String,
    /// Least and most.
    pub range: [f64; 2],
    /// The most change in a second.
    pub rate: f64,
    /// Whether it is zero at the beginning and at the end, as whatever moves the vehicle is.
    pub rests: bool,
}

/// Speed, m/s, yaw rate, rad/s, and steering angle, rad, of a vehicle of which nothing is said; a second from rest to full.
const USUAL: [f64; 3] = [1.0, 1.0, 0.6];

impl Limit {
    /// What is usual for each input of a model.
    pub fn usual(model: &Model) -> Vec<Self> {
        let radius = model.parameters.get("wheel_radius").copied().unwrap_or(1.0);
        let of = |role: &String| {
            let moves = model.vehicle.moved_by(role);
            let most = match moves {
                Some(m) if m.is_wheel() => USUAL[0] / radius,
                Some(Moves::Steering | Moves::RearSteering) => USUAL[2],
                Some(Moves::Yaw) => USUAL[1],
                _ => USUAL[0],
            };
            let rests = !matches!(moves, Some(Moves::Steering | Moves::RearSteering | Moves::Shape));
            Self { role: role.clone(), range: [-most, most], rate: if rests { most } else { 2.0 * most }, rests }
        };
        model.inputs.iter().map(of).collect()
    }

    /// The same input without limits worth the name: both ways, tenfold, at any rate; a steering angle up to where it locks.
    pub(super) fn without_limits(&self) -> Self {
        let most = if self.rests { 10.0 * self.scale() } else { self.scale().max(1.5) };
        Self { range: [-most, most], rate: 1e3 * most, ..self.clone() }
    }

    /// The size of the input.
    pub fn scale(&self) -> f64 {
        self.range[0].abs().max(self.range[1].abs()).max(1e-9)
    }
}

/// What a user says of an input: `ROLE=LEAST,MOST`, or `ROLE=MOST` of its rate.
#[derive(Clone, Debug, PartialEq)]
pub enum Said {
    /// Its range.
    Range(String, [f64; 2]),
    /// The most change in a second.
    Rate(String, f64),
}

/// Puts what a user says in the place of what is usual.
///
/// # Errors
/// When the model has no such input.
pub fn with_said(mut limits: Vec<Limit>, said: &[Said]) -> Result<Vec<Limit>> {
    for one in said {
        let (Said::Range(role, _) | Said::Rate(role, _)) = one;
        let names: Vec<String> = limits.iter().map(|l| l.role.clone()).collect();
        let Some(limit) = limits.iter_mut().find(|l| l.role == *role) else {
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            return Err(Error::input(format!("the model has no input \"{role}\"")).help(advice(
                role,
                "its inputs",
                &names,
            )));
        };
        match one {
            Said::Range(_, range) => limit.range = *range,
            Said::Rate(_, rate) => limit.rate = *rate,
        }
    }
    Ok(limits)
}

impl Said {
    /// Reads `ROLE=LEAST,MOST`, or `ROLE=MOST` for ±MOST.
    ///
    /// # Errors
    /// When it is none of the two.
    pub fn range(text: &str) -> std::result::Result<Self, String> {
        let wrong = || format!("{text:?} is no limit; write ROLE=LEAST,MOST, such as steering_angle=-0.5,0.5");
        let (role, numbers) = text.split_once('=').ok_or_else(wrong)?;
        let numbers: Option<Vec<f64>> = numbers.split(',').map(finite).collect();
        match numbers.ok_or_else(wrong)?[..] {
            [most] if most > 0.0 => Ok(Self::Range(role.trim().into(), [-most, most])),
            [least, most] if least < most && least <= 0.0 && most >= 0.0 => {
                Ok(Self::Range(role.trim().into(), [least, most]))
            }
            _ => Err(wrong()),
        }
    }

    /// Reads `ROLE=MOST`.
    ///
    /// # Errors
    /// When it is none.
    pub fn rate(text: &str) -> std::result::Result<Self, String> {
        let wrong = || format!("{text:?} is no limit of a rate; write ROLE=MOST, such as steering_angle=0.8");
        let (role, most) = text.split_once('=').ok_or_else(wrong)?;
        let most = finite(most).filter(|m| *m > 0.0).ok_or_else(wrong)?;
        Ok(Self::Rate(role.trim().into(), most))
    }
}

fn finite(text: &str) -> Option<f64> {
    text.trim().parse::<f64>().ok().filter(|v| v.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_read_and_take_the_place_of_the_usual() {
        let car = Model::new("car", &[("wheel_radius", 0.25), ("wheelbase", 2.0)]).unwrap();
        let usual = Limit::usual(&car);
        let of = |role: &str| usual.iter().find(|l| l.role == role).unwrap();
        assert_eq!((of("wheel_rate").range, of("wheel_rate").rests), ([-4.0, 4.0], true));
        assert_eq!((of("steering_angle").range, of("steering_angle").rests), ([-0.6, 0.6], false));
        let said = [Said::range("wheel_rate=0,2").unwrap(), Said::rate("steering_angle=0.3").unwrap()];
        let limits = with_said(usual, &said).unwrap();
        assert!(limits.iter().any(|l| l.range == [0.0, 2.0]) && limits.iter().any(|l| l.rate == 0.3));
        assert!(with_said(limits, &[Said::Rate("speed".into(), 1.0)]).unwrap_err().to_string().contains("wheel_rate"));
        for bad in ["", "a", "a=", "a=2,1", "a=1,2", "a=-1", "a=nan", "a=1,2,3"] {
            assert!(Said::range(bad).is_err(), "{bad}");
        }
    }
}
