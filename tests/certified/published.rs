//! A few problems of least squares typed in from their publications, with the values NIST certifies for them.

use super::curve::Problem;

struct Printed {
    name: &'static str,
    model: &'static str,
    y: &'static [f64],
    x: &'static [f64],
    starts: [&'static [f64]; 2],
    certified: &'static [f64],
    deviations: &'static [f64],
    squares: f64,
}

/// Daniel and Wood 1980, energy radiated by a filament; Box, Hunter and Hunter 1978, biochemical oxygen demand;
/// Meyer 1972, resistance of a thermistor; Ratkowsky 1983, weight of onions.
const PRINTED: [Printed; 4] = [
    Printed {
        name: "DanWood",
        model: "b1*exp(b2*ln(x))",
        y: &[2.138, 3.421, 3.597, 4.340, 4.882, 5.660],
        x: &[1.309, 1.471, 1.490, 1.565, 1.611, 1.680],
        starts: [&[1.0, 5.0], &[0.7, 4.0]],
        certified: &[7.6886226176E-01, 3.8604055871E+00],
        deviations: &[1.8281973860E-02, 5.1726610913E-02],
        squares: 4.3173084083E-03,
    },
    Printed {
        name: "BoxBOD",
        model: "b1*(1 - exp(-b2*x))",
        y: &[109.0, 149.0, 149.0, 191.0, 213.0, 224.0],
        x: &[1.0, 2.0, 3.0, 5.0, 7.0, 10.0],
        starts: [&[1.0, 1.0], &[100.0, 0.75]],
        certified: &[2.1380940889E+02, 5.4723748542E-01],
        deviations: &[1.2354515176E+01, 1.0455993237E-01],
        squares: 1.1680088766E+03,
    },
    Printed {
        name: "MGH10",
        model: "b1*exp(b2/(x + b3))",
        y: &[
            34780.0, 28610.0, 23650.0, 19630.0, 16370.0, 13720.0, 11540.0, 9744.0, 8261.0, 7030.0, 6005.0, 5147.0,
            4427.0, 3820.0, 3307.0, 2872.0,
        ],
        x: &[50.0, 55.0, 60.0, 65.0, 70.0, 75.0, 80.0, 85.0, 90.0, 95.0, 100.0, 105.0, 110.0, 115.0, 120.0, 125.0],
        starts: [&[2.0, 400_000.0, 25_000.0], &[0.02, 4000.0, 250.0]],
        certified: &[5.6096364710E-03, 6.1813463463E+03, 3.4522363462E+02],
        deviations: &[1.5687892471E-04, 2.3309021107E+01, 7.8486103508E-01],
        squares: 8.7945855171E+01,
    },
    Printed {
        name: "Rat43",
        model: "b1*exp(-ln(1 + exp(b2 - b3*x))/b4)",
        y: &[
            16.08, 33.83, 65.80, 97.20, 191.55, 326.20, 386.87, 520.53, 590.03, 651.92, 724.93, 699.56, 689.96, 637.56,
            717.41,
        ],
        x: &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.0, 14.0, 15.0],
        starts: [&[100.0, 10.0, 1.0, 1.0], &[700.0, 5.0, 0.75, 1.3]],
        certified: &[6.9964151270E+02, 5.2771253025E+00, 7.5962938329E-01, 1.2792483859E+00],
        deviations: &[1.6302297817E+01, 2.0828735829E+00, 1.9566123451E-01, 6.8761936385E-01],
        squares: 8.7864049080E+03,
    },
];

/// All of them.
pub fn problems() -> Vec<Problem> {
    let one = |p: &Printed| Problem {
        name: p.name.into(),
        model: p.model.into(),
        data: p.y.iter().zip(p.x).map(|(y, x)| vec![*y, *x]).collect(),
        starts: p.starts.map(<[f64]>::to_vec),
        certified: p.certified.to_vec(),
        deviations: p.deviations.to_vec(),
        squares: p.squares,
    };
    PRINTED.iter().map(one).collect()
}
