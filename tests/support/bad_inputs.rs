//! Bad inputs and what must be said about each; used on the library and on the command.

/// A model file and a log of which one is bad.
pub struct Case {
    pub name: &'static str,
    /// Text of `model.toml`.
    pub model: &'static str,
    /// Bytes of `run.csv`.
    pub csv: &'static [u8],
    /// Parts the message must have: the place, what is wrong, what to do.
    pub expect: &'static [&'static str],
}

/// A good model file.
pub const MODEL: &str = "\
vehicle = \"unicycle\"
[parameters]
wheel_radius = 0.5
[columns]
time = \"t\"
heading = \"phi\"
";

/// A log that goes with it.
pub const CSV: &[u8] = b"t,x,y,phi,wheel_rate,yaw_rate\n0,0,0,0,1,0\n1,0.5,0,0,1,0\n2,1,0,0,1,0\n";

const fn bad_csv(name: &'static str, csv: &'static [u8], expect: &'static [&'static str]) -> Case {
    Case { name, model: MODEL, csv, expect }
}

const fn bad_model(name: &'static str, model: &'static str, expect: &'static [&'static str]) -> Case {
    Case { name, model, csv: CSV, expect }
}

/// Logs that cannot be used.
pub const BAD_LOGS: &[Case] = &[
    bad_csv("empty log", b"", &["run.csv: is empty", "check that this is the file"]),
    bad_csv("blank log", b"\n \r\n\n", &["run.csv: is empty"]),
    bad_csv("mark only", b"\xef\xbb\xbf", &["run.csv: is empty"]),
    bad_csv("binary log", b"\x7fELF\x02\x00\x00\x01,\n1,2\n", &["run.csv: is a binary file", "text file in UTF-8"]),
    bad_csv("UTF-16 log", b"\xff\xfet\x00,\x00x\x00\n\x00", &["run.csv: is UTF-16", "save it again as UTF-8"]),
    bad_csv("header not UTF-8", b"t,x,y\xe9\n0,0,0\n", &["run.csv:1:5: is not UTF-8 text", "save it again as UTF-8"]),
    bad_csv(
        "missing column",
        b"t,x,y,phi,wheel_rate,yawrate\n0,0,0,0,1,0\n1,0,0,0,1,0\n",
        &["run.csv:1:1: column \"yaw_rate\" is missing", "did you mean \"yawrate\"?", "under [columns]"],
    ),
    bad_csv(
        "missing named heading",
        b"t,x,y,heading,wheel_rate,yaw_rate\n0,0,0,0,1,0\n1,0,0,0,1,0\n",
        &["run.csv:1:1: column \"phi\" for heading is missing", "the file has: t, x, y, heading"],
    ),
    bad_csv(
        "neither wheel rate nor speed",
        b"t,x,y,phi,yaw_rate\n0,0,0,0,1\n1,0,0,0,1\n",
        &["run.csv:1:1: column \"wheel_rate\" or \"speed\" is missing", "wheel_rate = "],
    ),
    bad_csv(
        "no header",
        b"0,0,0,0,1,0\n1,0,0,0,1,0\n",
        &["run.csv:1:1: ", "is missing", "the file has no names of columns: they are called 1 to 6"],
    ),
    bad_csv(
        "column twice",
        b"\nt,x,y,phi,wheel_rate,yaw_rate,x\n0,0,0,0,1,0,0\n",
        &["run.csv:2:1: column \"x\" stands twice", "cell 2 and cell 7", "rename or remove"],
    ),
    bad_csv(
        "semicolons in the header alone",
        b"t;x;y;phi;wheel_rate;yaw_rate\n0,0,0,0,1,0\n",
        &["run.csv:2:1: ", "the row has 1 cells, the header has 6"],
    ),
    bad_csv("SQLite", b"SQLite format 3\0", &["run.csv: is a ROS 2 bag in SQLite", "mcap convert"]),
    bad_csv("a bag of ROS 1", b"#ROSBAG V2.0\n", &["run.csv: is a ROS 1 bag", "mcap convert"]),
    bad_csv("a model as log", b"vehicle = 3\n", &["run.csv:1:1: the first line is not the header", "give a log"]),
    bad_csv(
        "carriage returns",
        b"t,x,y,phi,wheel_rate,yaw_rate\r0,0,0,0,1,0\r1,0,0,0,1,0\r",
        &["run.csv:1:1: ", "carriage returns", "line ends"],
    ),
    bad_csv(
        "word",
        b"t,x,y,phi,wheel_rate,yaw_rate\r\n0,0,0,0,1,0\r\n\r\n1,0.5, fast,0,1,0\r\n",
        &["run.csv:4:8: \"fast\" in column \"y\" is not a number", "leave the cell blank"],
    ),
    bad_csv(
        "decimal comma",
        b"t,x,y,phi,wheel_rate,yaw_rate\n0,\"0,5\",0,0,1,0\n",
        &["run.csv:2:3: \"0,5\" in column \"x\"", "with a point, not a comma"],
    ),
    bad_csv(
        "date",
        b"t,x,y,phi,wheel_rate,yaw_rate\n2026-01-31/10:00:00,0,0,0,1,0\n",
        &["run.csv:2:1: \"2026-01-31/10:00:00\" in column \"t\"", "time in seconds"],
    ),
    bad_csv(
        "row of units",
        b"t,x,y,phi,wheel_rate,yaw_rate\ns,m,m,rad,rad/s,rad/s\n0,0,0,0,1,0\n",
        &["run.csv:2:1: \"s\" in column \"t\"", "a row of units"],
    ),
    bad_csv(
        "short row",
        b"t,x,y,phi,wheel_rate,yaw_rate\n0,0,0,0,1,0\n1,0,0\n",
        &["run.csv:3:1: the row has 3 cells, the header has 6", "as many cells"],
    ),
    bad_csv(
        "long row",
        b"t,x,y,phi,wheel_rate,yaw_rate\n0,0,0,0,1,0,7\n",
        &["run.csv:2:1: the row has 7 cells, the header has 6"],
    ),
    bad_csv(
        "open quote",
        b"t,x,y,phi,wheel_rate,yaw_rate\n0,0,\"0,0,1,0\n1,0,0,0,1,0\n",
        &["run.csv:2:1: the row has 3 cells", "a quote that opens in this row"],
    ),
    bad_csv(
        "header only",
        b"t,x,y,phi,wheel_rate,yaw_rate\n",
        &["run.csv: usable rows: 0 of 0", "at least 2", "give a longer one"],
    ),
    bad_csv(
        "one row",
        b"t,x,y,phi,wheel_rate,yaw_rate\n0,0,0,0,1,0\n",
        &["run.csv: usable rows: 1 of 1", "at least 2 are needed"],
    ),
    bad_csv(
        "all rows but one unusable",
        b"t,x,y,phi,wheel_rate,yaw_rate\n0,0,0,0,1,0\n1,,0,0,1,0\n2,0,inf,0,1,0\n",
        &["usable rows: 1 of 3", "blank or NaN cell in column \"x\": 1", "infinite value in column \"y\": 1"],
    ),
    bad_csv(
        "clock that stands still",
        b"t,x,y,phi,wheel_rate,yaw_rate\n5,0,0,0,1,0\n5,1,0,0,1,0\n5,2,0,0,1,0\n",
        &["usable rows: 0 of 3", "repeated time with conflicting values: 3"],
    ),
];

/// Model files that cannot be used.
pub const BAD_MODELS: &[Case] = &[
    bad_model("empty model", "", &["model.toml: is empty"]),
    bad_model("binary model", "vehicle\0", &["model.toml: is a binary file"]),
    bad_model(
        "not TOML",
        "vehicle = \"unicycle\"\nwheel radius 0.5\n",
        &["model.toml:2:7: is not valid TOML", "lines like"],
    ),
    bad_model("a log as model", "t,x,y\n0,0,0\n", &["model.toml:1:2: is not valid TOML"]),
    bad_model(
        "key twice",
        "vehicle = \"car\"\nvehicle = \"car\"\n",
        &["model.toml:2:1: is not valid TOML: duplicate key"],
    ),
    bad_model(
        "no vehicle",
        "[parameters]\n",
        &["model.toml:1:1: key \"vehicle\" is missing", "known vehicles: unicycle"],
    ),
    bad_model(
        "unknown vehicle",
        "vehicle = \"unicicle\"\n",
        &["model.toml:1:11: unknown vehicle \"unicicle\"", "did you mean \"unicycle\"?"],
    ),
    bad_model("vehicle not a text", "vehicle = 3\n", &["model.toml:1:11: vehicle must be a text, not a number"]),
    bad_model(
        "unknown table",
        "vehicle = \"unicycle\"\n[paramters]\nwheel_radius = 1\n",
        &["model.toml:2:2: unknown key \"paramters\"", "did you mean \"parameters\"?"],
    ),
    bad_model(
        "no parameters",
        "vehicle = \"unicycle\"\n",
        &["model.toml:1:1: table [parameters] is missing", "write [parameters]", "wheel_radius"],
    ),
    bad_model(
        "missing parameter",
        "vehicle = \"car\"\n\n[parameters]\nwheelbase = 2\n",
        &["model.toml:3:1: key \"wheel_radius\" in [parameters] is missing", "write wheel_radius = "],
    ),
    bad_model(
        "unknown parameter",
        "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 1\n  wheel_radios = 2\n",
        &["model.toml:4:3: unknown key \"wheel_radios\" in [parameters]", "did you mean \"wheel_radius\"?"],
    ),
    bad_model(
        "parameter a text",
        "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = \"0.5 m\"\n",
        &["model.toml:3:16: wheel_radius must be a number, not a text", "write wheel_radius = 0.5"],
    ),
    bad_model(
        "parameter zero",
        "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0\n",
        &["model.toml:3:16: wheel_radius = 0.0 is out of range", "greater than zero"],
    ),
    bad_model(
        "parameter infinite",
        "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = inf\n",
        &["model.toml:3:16: wheel_radius must be a finite number"],
    ),
    bad_model(
        "parameters a number",
        "vehicle = \"unicycle\"\nparameters = 3\n",
        &["model.toml:2:14: parameters must be a table, not a number", "write [parameters]"],
    ),
    bad_model(
        "unknown timing",
        "vehicle = \"unicycle\"\ninput_timing = \"interval_mean\"\n[parameters]\nwheel_radius = 1\n",
        &["model.toml:2:16: unknown input_timing \"interval_mean\"", "did you mean \"interval-mean\"?"],
    ),
    bad_model(
        "unknown column role",
        "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 1\n[columns]\nyawrate = \"w\"\n",
        &["model.toml:5:1: unknown key \"yawrate\" in [columns]", "did you mean \"yaw_rate\"?"],
    ),
    bad_model(
        "unit of another quantity",
        "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 1\n[columns]\nx = { column = \"x\", unit = \"deg\" }\n",
        &["model.toml:5:28: \"deg\" is no unit of a length", "units of a length: m, mm, cm, km, ft"],
    ),
    bad_model(
        "no column",
        "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 1\n[columns]\nx = { unit = \"mm\" }\n",
        &["model.toml:5:5: x names no column", "write x = { column = "],
    ),
    bad_model(
        "ticks of a heading",
        "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 1\n[columns]\nheading = { ticks = \"a\" }\n",
        &["model.toml:5:13: unknown key \"ticks\" in heading", "known keys: column, unit, scale, offset, quaternion"],
    ),
    bad_model(
        "three columns of a time",
        "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 1\n[columns]\ntime = [\"a\", \"b\", \"c\"]\n",
        &["model.toml:5:8: time needs 2 columns, seconds and nanoseconds, not 3"],
    ),
    bad_model(
        "a turn that is none",
        "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 1\n[columns]\nheading = { column = \"a\", turn = \"left\" }\n",
        &["model.toml:5:34: unknown turn \"left\"", "it is one of: counter-clockwise, clockwise"],
    ),
    bad_model(
        "position twice",
        "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 1\n[columns]\nx = \"a\"\nposition = { latitude = \"b\", longitude = \"c\" }\n",
        &["model.toml:6:1: position stands in place of x and y", "remove x and y"],
    ),
    bad_model(
        "key over two lines",
        "vehicle = \"unicycle\"\n\"a\\nb\" = 1\n",
        &["model.toml:2:1: unknown key \"a b\""],
    ),
    bad_model(
        "column name with a control character",
        "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 1\n[columns]\ntime = \"t\\u001b\"\n",
        &["model.toml:5:8: time holds a control character", "remove it"],
    ),
    bad_model(
        "blank column name",
        "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 1\n[columns]\ntime = \" \"\n",
        &["model.toml:5:8: time is blank", "write time = "],
    ),
    bad_model(
        "two drives",
        "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 1\n[columns]\nwheel_rate = \"a\"\nspeed = \"b\"\n",
        &["model.toml:6:1: wheel_rate and speed are both named", "remove one"],
    ),
    bad_model(
        "one column for two roles",
        "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 1\n[columns]\nx = \"y\"\n",
        &["model.toml:5:5: x and y are both read from column \"y\"", "its own column"],
    ),
    bad_model(
        "lever arm of one number",
        "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 1\n[sensor]\nlever_arm = [1.0]\n",
        &["model.toml:5:13: lever_arm needs 2 numbers, not 1", "forward and left"],
    ),
    bad_model(
        "initial without heading",
        "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 1\n[initial]\nx = 0\ny = 0\n",
        &["model.toml:4:1: key \"heading\" in [initial] is missing", "write heading = 0.0"],
    ),
    bad_model(
        "noise of zero",
        "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 1\n[noise]\nposition = 0.0\nheading = 1.0\n",
        &["model.toml:5:12: position = 0.0 is out of range", "greater than zero"],
    ),
    bad_model(
        "unknown effect",
        "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 1\n[[effects]]\nid = \"rotation-crepe\"\ne_rc = 0.1\n",
        &["model.toml:5:6: unknown effect \"rotation-crepe\"", "did you mean \"rotation-creep\"?"],
    ),
    bad_model(
        "effect without id",
        "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 1\n[[effects]]\ne_rc = 0.1\n",
        &["model.toml:4:1: key \"id\" in [[effects]] is missing", "creepage effects"],
    ),
    bad_model(
        "effect in single brackets",
        "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 1\n[effects]\nid = \"rotation-creep\"\ne_rc = 0.1\n",
        &["model.toml:4:1: effects must be a list, not a table", "double brackets"],
    ),
    bad_model(
        "effect without parameter",
        "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 1\n[[effects]]\nid = \"lever-arm\"\na = 0.1\n",
        &["model.toml:4:1: key \"b\" in [[effects]] is missing", "below id = \"lever-arm\""],
    ),
    bad_model(
        "effect with unknown parameter",
        "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 1\n[[effects]]\nid = \"rotation-creep\"\ne_rcc = 0.1\n",
        &["model.toml:6:1: unknown key \"e_rcc\" in [[effects]]", "did you mean \"e_rc\"?"],
    ),
    bad_model(
        "effect out of range",
        "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 1\n[[effects]]\nid = \"rotation-creep\"\ne_rc = 70\n",
        &["model.toml:6:8: e_rc = 70.0 is out of range", "within -1.0 to 1.0"],
    ),
    bad_model(
        "effect twice",
        "vehicle = \"unicycle\"\neffects = [\n  { id = \"rotation-creep\", e_rc = 0.1 },\n  { id = \"rotation-creep\", e_rc = 0.2 },\n]\n[parameters]\nwheel_radius = 1\n",
        &["model.toml:4:3: effect \"rotation-creep\" is listed twice, first at line 3", "merge"],
    ),
    bad_model(
        "trailer effect without trailer",
        "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 1\n[[effects]]\nid = \"trailer-traverse-creep\"\ntrailer = 1\ne_tc = 0\n",
        &["model.toml:5:6: trailer-traverse-creep acts on a trailer, but this vehicle has none", "remove"],
    ),
    bad_model(
        "trailer out of range",
        "vehicle = \"n-trailer\"\n[parameters]\nwheel_radius = 1\nwheelbase = 2\ntrailer_lengths = [3]\n[[effects]]\nid = \"trailer-traverse-creep\"\ntrailer = 2\ne_tc = 0\n",
        &["model.toml:8:11: trailer = 2 is out of range", "within 1 to 1"],
    ),
    bad_model(
        "trailer zero",
        "vehicle = \"n-trailer\"\n[parameters]\nwheel_radius = 1\nwheelbase = 2\ntrailer_lengths = [3]\n[[effects]]\nid = \"trailer-traverse-creep\"\ntrailer = 0\ne_tc = 0\n",
        &["model.toml:8:11: trailer must be a whole number from 1", "write trailer = 1"],
    ),
    bad_model(
        "tractor that cannot pull",
        "vehicle = \"n-trailer\"\ntractor = \"sleigh\"\n[parameters]\ntrailer_lengths = [3]\n",
        &["model.toml:2:11: unknown tractor \"sleigh\"", "known tractors: unicycle, differential-drive, car"],
    ),
    bad_model(
        "disk that pulls",
        "vehicle = \"n-trailer\"\ntractor = \"disk\"\n[parameters]\nwheel_radius = 1\ntrailer_lengths = [3]\n",
        &["model.toml:2:11: unknown tractor \"disk\"", "known tractors: unicycle, differential-drive, car"],
    ),
    bad_model(
        "disk of no radius",
        "vehicle = \"disk\"\n[parameters]\nwheel_radius = 0\n",
        &["model.toml:3:16: wheel_radius = 0.0 is out of range", "greater than zero"],
    ),
    bad_model(
        "sleigh without mass",
        "vehicle = \"sleigh\"\n[parameters]\nmass = 0\ninertia = 1\nmass_offset = -0.1\n",
        &["model.toml:3:8: mass = 0.0 is out of range", "greater than zero"],
    ),
    bad_model(
        "castor without trail",
        "vehicle = \"differential-drive-castor\"\n[parameters]\nwheel_radius = 1\ntrack_width = 1\ncastor_offset = -1\ncastor_trail = 0\ncastor_wheel_radius = 1\n",
        &["model.toml:6:16: castor_trail = 0.0 is out of range", "greater than zero"],
    ),
    bad_model(
        "tractor twice",
        "vehicle = \"n-trailer\"\ntractor = \"car\"\n[parameters]\ntractor = \"car\"\ntrailer_lengths = [3]\n",
        &["model.toml:4:1: tractor is named twice", "remove one"],
    ),
    bad_model(
        "no trailer lengths",
        "vehicle = \"n-trailer\"\n[parameters]\nwheel_radius = 1\nwheelbase = 2\n",
        &["model.toml:2:1: key \"trailer_lengths\" in [parameters] is missing", "hitch to axle"],
    ),
    bad_model(
        "trailer of no length",
        "vehicle = \"n-trailer\"\n[parameters]\nwheel_radius = 1\nwheelbase = 2\ntrailer_lengths = [3, -1]\n",
        &["model.toml:5:23: trailer_lengths[2] = -1.0 is out of range", "greater than zero"],
    ),
    bad_model(
        "too few hitch offsets",
        "vehicle = \"n-trailer\"\n[parameters]\nwheel_radius = 1\nwheelbase = 2\ntrailer_lengths = [3, 3]\nhitch_offsets = [0]\n",
        &["model.toml:6:17: hitch_offsets has 1 elements, but 2 are needed", "one per trailer"],
    ),
    bad_model(
        "too many trailer headings",
        "vehicle = \"n-trailer\"\n[parameters]\nwheel_radius = 1\nwheelbase = 2\ntrailer_lengths = [3]\n[columns]\ntrailer_headings = [\"a\", \"b\"]\n",
        &["model.toml:7:20: trailer_headings has 2 elements, but 1 are needed"],
    ),
];
