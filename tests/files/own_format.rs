//! Entries of `[columns]` that say more than a name, and tables of text of every kind.

use creepage::files::{ModelFile, Run};
use creepage::{effects, model};
use std::f64::consts::{FRAC_PI_2, TAU};
use std::io::Write;
use std::path::Path;

fn model_of(vehicle: &str, columns: &str) -> ModelFile {
    let parameters = match vehicle {
        "differential-drive" => "wheel_radius = 1.0\ntrack_width = 1.0",
        "car" => "wheel_radius = 1.0\nwheelbase = 1.0",
        _ => "wheel_radius = 1.0",
    };
    let text = format!("vehicle = \"{vehicle}\"\n[parameters]\n{parameters}\n[columns]\n{columns}\n");
    ModelFile::parse(&text, "model.toml", &model::known(effects::all())).unwrap()
}

fn read(vehicle: &str, columns: &str, text: &str) -> Run {
    Run::parse("run.csv", text, &model_of(vehicle, columns)).unwrap()
}

fn near(found: &[f64], expect: &[f64]) {
    assert_eq!(found.len(), expect.len(), "{found:?}");
    assert!(found.iter().zip(expect).all(|(a, b)| (a - b).abs() < 1e-9), "{found:?} in place of {expect:?}");
}

#[test]
fn units_scales_and_compasses() {
    let columns = "time = { column = \"t\", unit = \"ms\" }\nx = { column = \"x\", unit = \"mm\" }\n\
                   heading = { column = \"h\", unit = \"deg\", zero = \"north\", turn = \"clockwise\" }\n\
                   speed = { column = \"v\", unit = \"km/h\", scale = 2.0, offset = 3.6 }\n\
                   yaw_rate = { column = \"w\", unit = \"rpm\" }\nsigma_x = { column = \"s\", unit = \"cm\" }";
    let run = read("unicycle", columns, "t,x,y,h,v,w,s\n0,1000,0,0,3.6,60,1\n20,2000,0,90,0,0,\n");
    near(&run.time, &[0.0, 0.02]);
    near(&run.x, &[1.0, 2.0]);
    near(run.heading.as_ref().unwrap(), &[FRAC_PI_2, 0.0]);
    near(&run.inputs[0], &[3.0, 1.0]);
    near(&run.inputs[1], &[TAU, 0.0]);
    let sigma = run.deviations.x.unwrap();
    assert!((sigma[0] - 0.01).abs() < 1e-12 && sigma[1].is_nan());
    assert_eq!(run.differences, [None, None]);
}

#[test]
fn times_of_every_kind() {
    let rows = |cells: [&str; 2]| cells.map(|t| format!("{t},0,0,1,0")).join("\n");
    let cases = [
        ("time = { column = \"t\", unit = \"ns\" }", "t", ["1700000000123456789", "1700000001123456790"]),
        ("time = [\"s\", \"n\"]", "s,n", ["1700000000,123456789", "1700000001,123456790"]),
        ("time = \"t\"", "t", ["2023-11-14T22:13:20.123456789Z", "2023-11-14T22:13:21.123456790Z"]),
    ];
    for (entry, names, cells) in cases {
        let run = read(
            "unicycle",
            &format!("{entry}\nspeed = \"v\"\nyaw_rate = \"w\""),
            &format!("{names},x,y,v,w\n{}\n", rows(cells)),
        );
        let step = run.time[1] - run.time[0];
        assert!(
            (run.time[0] - 0.123_456_789).abs() < 1e-15 && (step - 1.000_000_001).abs() < 1e-15,
            "{entry}: {:?}",
            run.time
        );
    }
}

#[test]
fn ticks_and_joint_positions_are_means() {
    let columns = "time = \"t\"\nwheel_rate_left = { ticks = \"l\", ticks_per_turn = 100, gear = 2.0 }\n\
                   wheel_rate_right = { angle = \"r\" }";
    let run =
        read("differential-drive", columns, "t,x,y,l,r\n0,0,0,65500,3\n0.5,0,0,64,-3\n1,,,164,-2.5\n1.5,0,0,264,-2\n");
    near(&run.inputs[0], &[TAU, TAU, TAU, TAU]);
    near(&run.inputs[1], &[2.0 * (TAU - 6.0), 2.0 * (TAU - 6.0), 1.0, 1.0]);
    assert_eq!(run.differences, [Some(TAU / 200.0), Some(0.0)]);
    assert_eq!((run.time.len(), run.input_time().len()), (3, 4), "a row without a pose keeps its counts");
}

#[test]
fn quaternions_and_places_on_the_globe() {
    let columns = "time = \"t\"\nheading = { quaternion = \"q\" }\nposition = { latitude = \"a\", longitude = \"b\" }\n\
                   speed = \"v\"\nyaw_rate = \"w\"";
    let half = 0.5f64.sqrt();
    let text =
        format!("t,a,b,q.x,q.y,q.z,q.w,v,w\n0,0,0,0,0,0,1,1,0\n1,0.001,0,0,0,{half},{half},1,0\n2,0,0,0,0,0,0,1,0\n");
    let run = read("unicycle", columns, &text);
    near(run.heading.as_ref().unwrap(), &[0.0, FRAC_PI_2]);
    assert!(run.x[1].abs() < 1e-9 && (run.y[1] - 110.574).abs() < 1e-2, "{:?}", run.y);
    assert_eq!(run.rows_dropped, 1, "a quaternion of zeros");
}

#[test]
fn every_vehicle_with_a_wheel_rate_takes_a_speed() {
    let run = read(
        "car",
        "time = \"t\"\nspeed = { column = \"v\", unit = \"mph\" }\nsteering_angle = \"d\"",
        "t,x,y,v,d\n0,0,0,10,0\n1,4,0,10,0\n",
    );
    let drive = run.roles.iter().position(|role| role == "speed").unwrap();
    near(&run.inputs[drive], &[4.4704, 4.4704]);
}

#[test]
fn tables_of_text_of_every_kind() {
    let columns = "time = \"t\"\nspeed = \"v\"\nyaw_rate = \"w\"";
    let plain = read("unicycle", columns, "t,x,y,v,w\n0,0,0,1.5,0.25\n1,1.5,0,1.5,0.25\n");
    for text in [
        "t;x;y;v;w\n0;0;0;1,5;0,25\n1;1,5;0;1,5;0,25\n",
        "t\tx\ty\tv\tw\n0\t0\t0\t1.5\t0.25\n1\t1.5\t0\t1.5\t0.25\n",
        "t x  y v w\n 0 0 0 1.5 0.25 \n1 1.5 0 1.5 0.25\n",
        "# a robot, \"mine\"\n# t x y v w\n0 0 0 1.5 0.25\n1 1.5 0 1.5 0.25\n",
        "#t,x,y,v,w\n0,0,0,1.5,0.25\n1,1.5,0,1.5,0.25\n",
    ] {
        let run = read("unicycle", columns, text);
        assert_eq!(
            (run.time, run.x, run.inputs),
            (plain.time.clone(), plain.x.clone(), plain.inputs.clone()),
            "{text}"
        );
    }
    let places = "time = 1\nx = 2\ny = 3\nspeed = 4\nyaw_rate = 5";
    assert_eq!(read("unicycle", places, "0,0,0,1.5,0.25\n1,1.5,0,1.5,0.25\n").x, plain.x);
}

#[test]
fn packed_logs_are_read_and_hashed_as_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.csv.gz");
    let mut packer = flate2::write::GzEncoder::new(vec![], flate2::Compression::fast());
    packer.write_all(b"t,x,y,v,w\n0,0,0,1,0\n1,1,0,1,0\n").unwrap();
    std::fs::write(&path, packer.finish().unwrap()).unwrap();
    let run = Run::read(&path, &model_of("unicycle", "time = \"t\"\nspeed = \"v\"\nyaw_rate = \"w\"")).unwrap();
    assert_eq!(run.x, [0.0, 1.0]);
    use sha2::Digest;
    assert_eq!(run.sha256, format!("{:x}", sha2::Sha256::digest(std::fs::read(&path).unwrap())));
}

/// Three signals of an outer merge: the two inputs are brought to one time, and the poses keep theirs.
#[test]
fn an_outer_merge_of_three_signals() {
    let mut text = "t,x,y,v,w\n".to_string();
    for i in 0..40 {
        let t = 0.1 * f64::from(i);
        text += &format!("{t},,,{},\n{},,,,{}\n{},{t},0,,\n", 1.0 + t, t + 0.03, 2.0 * (t + 0.03), t + 0.05);
    }
    text += "9,,,,\n";
    let run = read("unicycle", "time = \"t\"\nspeed = \"v\"\nyaw_rate = \"w\"", &text);
    assert!(run.time.len() >= 36 && run.apart.is_some(), "{}", run.time.len());
    let time = run.input_time().to_vec();
    near(&run.inputs[0], &time.iter().map(|t| 1.0 + t).collect::<Vec<_>>());
    near(&run.inputs[1], &time.iter().map(|t| 2.0 * t).collect::<Vec<_>>());
    assert!(
        run.why_dropped.keys().any(|why| why.contains("without a pose and without an input")),
        "{:?}",
        run.why_dropped
    );
}

/// A folder is a run: a file for each signal.
#[test]
fn a_folder_of_files_is_a_run() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: String| std::fs::write(folder.path().join(name), text).unwrap();
    let rows = |n: i32, step: f64, cells: &dyn Fn(f64) -> String| {
        (0..n).map(|i| step * f64::from(i)).map(|t| format!("{t},{}\n", cells(t))).collect::<String>()
    };
    write("wheel.csv", format!("t,v\n{}", rows(100, 0.05, &|t| (1.0 + t).to_string())));
    write("imu.csv", format!("t,w\n{}", rows(200, 0.025, &|t| (2.0 * t).to_string())));
    write("mocap.csv", format!("t,x,y\n{}", rows(50, 0.1, &|t| format!("{t},0"))));
    let columns =
        "time = \"t\"\nx = \"mocap.csv:x\"\ny = \"mocap.csv:y\"\nspeed = \"wheel.csv:v\"\nyaw_rate = \"imu.csv:w\"";
    let run = Run::read(folder.path(), &model_of("unicycle", columns)).unwrap();
    let time = run.input_time().to_vec();
    assert!(time.len() > 190 && run.time.len() > 45);
    near(&run.inputs[0], &time.iter().map(|t| 1.0 + t).collect::<Vec<_>>());
    near(&run.inputs[1], &time.iter().map(|t| 2.0 * t).collect::<Vec<_>>());
    near(&run.x, &run.time);
    std::fs::write(folder.path().join("imu.csv"), "stamp,w\n0,0\n1,0\n").unwrap();
    let error = Run::read(folder.path(), &model_of("unicycle", columns)).unwrap_err().to_string();
    assert!(error.contains("imu.csv: has no column \"t\" for the time"), "{error}");
}

/// Trajectories of the benchmarks under `--truth`, whatever the model file calls a pose.
#[test]
fn trajectories_of_benchmarks_are_poses() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let half = 0.5f64.sqrt();
    let write = |name: &str, text: String| std::fs::write(path(name), text).unwrap();
    write("in.csv", "t,v,w\n0,1,0\n1,1,0\n2,1,0\n".into());
    write("tum.txt", format!("# a trajectory\n0 1 2 0 0 0 {half} {half}\n1.5 3 4 0 0 0 0 1\n"));
    write(
        "euroc.csv",
        format!(
            "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z []\n\
                 0,1,2,0,{half},0,0,{half}\n1500000000,3,4,0,1,0,0,0\n"
        ),
    );
    // A camera that looks to the left, then ahead: rows of a rotation with the place behind each.
    write("kitti.txt", "0 0 -1 -2 0 1 0 0 1 0 0 1\n1 0 0 -4 0 1 0 0 0 0 1 3\n".into());
    write("times.txt", "0\n1.5\n".into());
    let model = model_of("unicycle", "time = \"t\"\nspeed = \"v\"\nyaw_rate = \"w\"");
    for name in ["tum.txt", "euroc.csv", "kitti.txt"] {
        let run = Run::read_apart(path("in.csv"), path(name), &model).unwrap();
        near(&run.time, &[0.0, 1.5]);
        near(&run.x, &[1.0, 3.0]);
        near(&run.y, &[2.0, 4.0]);
        near(run.heading.as_ref().unwrap(), &[FRAC_PI_2, 0.0]);
    }
    std::fs::remove_file(path("times.txt")).unwrap();
    let error = Run::read_apart(path("in.csv"), Path::new(&path("kitti.txt")), &model).unwrap_err().to_string();
    assert!(error.contains("put times.txt beside it"), "{error}");
}
