//! `[measured]` of a model file: what it may say, how its columns are read, and what is refused.

use creepage::effects;
use creepage::files::{ModelFile, Run};
use creepage::model::{Model, known};
use creepage::motion::{Integrator, Signals, Timing, simulate_model};

const VEHICLE: &str = "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0.5\n[measured]\n";

fn parse(entries: &str) -> creepage::Result<ModelFile> {
    ModelFile::parse(&format!("{VEHICLE}{entries}"), "model.toml", &known(effects::all()))
}

/// What is said of a bad entry, where it is read or where its formula is looked up.
fn complaint(entries: &str) -> String {
    match parse(entries).and_then(|file| Model::of_file(&file, effects::all())) {
        Ok(_) => panic!("{entries} is accepted"),
        Err(error) => {
            assert_eq!(error.exit_code(), 2);
            error.to_string()
        }
    }
}

#[test]
fn a_bad_entry_is_explained_at_its_place() {
    for (entry, place, says) in [
        ("foo = \"gyro\"", "5:1", "nothing says which motion foo is; give its formula"),
        ("speeed = \"v\"", "5:1", "did you mean \"speed\"?"),
        ("yaw_rate = \"gyro\"", "5:1", "yaw_rate is an input of this model"),
        ("speed = { column = \"v\", unit = \"rpm\" }", "5:32", "\"rpm\" is no unit of a speed"),
        ("speed = { column = \"v\", noise = 0.0 }", "5:33", "noise = 0.0 is out of range"),
        ("g = { column = \"gyro\", formula = \"phi'*\" }", "5:40", "found the end"),
        ("g = { column = \"gyro\", formula = \"phi2'\" }", "5:1", "the formula of g uses phi2'"),
        ("g = { column = \"gyro\", formula = \"phi'\", unit = \"kg\" }", "5:49", "unknown unit \"kg\""),
        ("g = { formula = \"phi'\" }", "5:5", "g names no column"),
        ("g = { column = \"gyro\", formula = \"phi'\", size = 1 }", "5:42", "unknown key \"size\""),
        ("speed = \"x\"", "5:1", "x and measured.speed are both read from column \"x\""),
    ] {
        let said = complaint(entry);
        assert!(said.starts_with(&format!("model.toml:{place}: ")) && said.contains(says), "{entry}: {said}");
    }
    let many: String = (0..13).map(|i| format!("g{i} = {{ column = \"g{i}\", formula = \"phi'\" }}\n")).collect();
    assert!(complaint(&many).contains("12 are the most"));
}

/// Every column is read in its unit; counts become rates by the rows on either side, and a blank cell drops its row.
#[test]
fn columns_are_read_in_their_units() {
    let file = parse(
        "speed = { column = \"v\", unit = \"km/h\" }\ngyro = { column = \"g\", formula = \"phi'\", unit = \"deg/s\" }\n\
         wheel = { ticks = \"n\", ticks_per_turn = 100, formula = \"theta'\" }\n",
    )
    .unwrap();
    let csv = "time,x,y,heading,wheel_rate,yaw_rate,v,g,n\n0,0,0,0,1,0,3.6,90,0\n1,1,0,0,1,0,7.2,,9\n\
               2,2,0,0,1,0,-3.6,-180,50\n4,4,0,0,1,0,-3.6,-180,250\n";
    let run = Run::parse("run.csv", csv, &file).unwrap();
    assert_eq!((run.time.as_slice(), run.rows_dropped), (&[0.0, 2.0, 4.0][..], 1));
    let near = |a: f64, b: f64| (a - b).abs() < 1e-12;
    let [speed, gyro, wheel] = [0, 1, 2].map(|k| &run.measured[k]);
    assert!(near(speed[0], 1.0) && near(speed[1], -1.0) && near(gyro[0], std::f64::consts::FRAC_PI_2), "{run:?}");
    // Half a turn in two seconds, then two turns in two: at the row between, two and a half in four.
    let turns = [0.25, 0.625, 1.0].map(|turns| turns * std::f64::consts::TAU);
    assert!(wheel.iter().zip(turns).all(|(a, b)| near(*a, b)), "{wheel:?}");
    let lacks = Run::parse("run.csv", "time,x,y,wheel_rate,yaw_rate,v\n0,0,0,1,0,1\n1,0,0,1,0,1\n", &file);
    let said = lacks.unwrap_err().to_string();
    assert!(said.contains("column \"g\" for measured.gyro is missing") && said.contains("under [measured]"), "{said}");
}

/// An effect of the file on a measured quantity; on one that is none it is refused.
#[test]
fn a_bias_stands_for_one_quantity() {
    let entry = |on: &str| format!("speed = \"v\"\n[[effects]]\nid = \"sensor-bias\"\n{on}bias = 0.1\n");
    let file = parse(&entry("measured = \"speed\"\n")).unwrap();
    let model = Model::of_file(&file, effects::all()).unwrap();
    let reads = model.definitions().unwrap().get(&model.measured[0].symbol()).unwrap().to_string();
    assert_eq!(reads, "v_l + sensor_bias_speed.bias");
    // A simulated log has the column as its sensor gives it.
    let time = [0.0, 1.0];
    let inputs = Signals::new(&time, &[vec![2.0; 2], vec![0.0; 2]], Timing::Sample);
    let table = simulate_model(&model, &inputs, &time, &[0.0; 3], &Integrator::default()).unwrap();
    assert!(table.column("speed").unwrap().iter().all(|v| (v - 1.1).abs() < 1e-12), "{table:?}");
    assert!(complaint(&entry("measured = \"sped\"\n")).contains("did you mean \"speed\""));
    assert!(complaint(&entry("")).contains("measured = \"speed\""));
    let none = ModelFile::parse(
        "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0.5\n[[effects]]\nid = \"sensor-bias\"\nbias = 0.1\n",
        "model.toml",
        &known(effects::all()),
    );
    assert!(none.unwrap_err().to_string().contains("[measured] names none"));
}
