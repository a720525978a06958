//! Files of vehicles that are refused, models that are, and what must be said about each.

/// A good file of vehicles.
pub const GOOD: &str = "\
[[vehicle]]
id = \"my-cart\"
title = \"a cart with a rear section\"
[vehicle.parameters.wheel_radius]
unit = \"m\"
meaning = \"wheel radius\"
[vehicle.parameters.wheelbase]
unit = \"m\"
meaning = \"wheelbase\"
[vehicle.parameters.load]
unit = \"kg\"
meaning = \"load\"
optional = true
[vehicle.inputs.wheel_rate]
unit = \"rad/s\"
meaning = \"rate of the wheels\"
instead = { role = \"speed\", unit = \"m/s\", formula = \"speed/wheel_radius\" }
[vehicle.inputs.steering_angle]
unit = \"rad\"
meaning = \"steering angle\"
[vehicle.define]
r = { formula = \"wheel_radius\", unit = \"m\", meaning = \"rolling radius\" }
L = { formula = \"wheelbase\", unit = \"m\", meaning = \"wheelbase\" }
\"theta'\" = { formula = \"wheel_rate\", unit = \"rad/s\", meaning = \"rate\" }
delta = { formula = \"steering_angle\", unit = \"rad\", meaning = \"steering\" }
[[vehicle.wheels]]
name = \"rear axle\"
radius = \"r\"
rate = \"theta'\"
rotation_creep = \"e_rc\"
traverse_creep = \"e_tc\"
[[vehicle.wheels]]
name = \"front axle\"
forward = \"L\"
steering = \"delta\"
traverse_creep = \"e_f\"
[[vehicle.wheels]]
name = \"castor\"
on = \"rear section\"
left = \"L/4\"
steering = \"gamma\"
trail = \"L/8\"
radius = \"r\"
rate = \"theta_c'\"
rotation_creep = \"e_rc_c\"
traverse_creep = \"e_c\"
[[vehicle.trailers]]
name = \"rear section\"
length = \"2*L\"
hitch = \"L/2\"
";

/// What is done to the good file.
pub struct Case {
    pub name: &'static str,
    /// Pieces of the text and what stands in their place.
    pub edits: &'static [(&'static str, &'static str)],
    /// The message after the name of the file.
    pub expect: &'static str,
}

const fn case(name: &'static str, edits: &'static [(&'static str, &'static str)], expect: &'static str) -> Case {
    Case { name, edits, expect }
}

/// Keys, names, formulas, units and constraints that are refused.
pub const BAD_VEHICLES: &[Case] = &[
    case(
        "steered with a trail",
        &[("steering = \"delta\"\n", "steering = \"delta\"\ntrail = \"L/9\"\n")],
        "2:6: the motion cannot be computed: a formula uses delta', which nothing defines; steering swings the contact of the front axle, which has a trail: define \"delta'\" from a logged rate, or leave the trail out",
    ),
    case("no vehicle", &[(GOOD, "a = 1\n")], "1:1: unknown key \"a\"; known keys: vehicle"),
    case(
        "empty list",
        &[(GOOD, "vehicle = []\n")],
        "1:11: the file holds no vehicle; write [[vehicle]], with double brackets, before each vehicle",
    ),
    case(
        "comment only",
        &[(GOOD, "# nothing\n")],
        "1:1: key \"vehicle\" is missing; write [[vehicle]], with double brackets, before each vehicle",
    ),
    case(
        "single brackets",
        &[("[[vehicle]]", "[vehicle]")],
        "1:1: vehicle must be a list, not a table; write [[vehicle]], with double brackets, before each vehicle",
    ),
    case(
        "not TOML",
        &[("id = \"my-cart\"", "id = my-cart")],
        "2:6: is not valid TOML: string values must be quoted, expected literal string; a file of vehicles holds [[vehicle]], lines like id = \"my-robot\", and below [vehicle.define] lines like \"theta'\" = { formula = \"wheel_rate\", … }, where a name with ' stands in quotes",
    ),
    case(
        "unknown key",
        &[("title =", "tittle =")],
        "3:1: unknown key \"tittle\" in [[vehicle]]; did you mean \"title\"? known keys: id, title, parameters, inputs, define, wheels, followers, trailers, line, held, instead, coordinates, heading, constraints",
    ),
    case(
        "no title",
        &[("title = \"a cart with a rear section\"\n", "")],
        "1:1: key \"title\" in [[vehicle]] is missing; write title = \"what it is, in a line\"",
    ),
    case("no id", &[("id = \"my-cart\"\n", "")], "1:1: key \"id\" in [[vehicle]] is missing; write id = \"my-robot\""),
    case("blank id", &[("\"my-cart\"", "\"  \"")], "2:6: id is blank; write id = \"…\""),
    case(
        "bad id",
        &[("\"my-cart\"", "\"my cart\"")],
        "2:6: \"my cart\" cannot be the id of a vehicle; begin with a letter, go on with letters, digits and hyphens, at most 60",
    ),
    case(
        "id of the catalogue",
        &[("\"my-cart\"", "\"car\"")],
        "2:6: the catalogue has a vehicle \"car\"; give yours another id",
    ),
    case(
        "n-trailer",
        &[("\"my-cart\"", "\"n-trailer\"")],
        "2:6: the catalogue has a vehicle \"n-trailer\"; give yours another id",
    ),
    case(
        "two vehicles",
        &[(
            GOOD,
            "[[vehicle]]\nid = \"my-cart\"\ntitle = \"a cart with a rear section\"\n[vehicle.parameters.wheel_radius]\nunit = \"m\"\nmeaning = \"wheel radius\"\n[vehicle.parameters.wheelbase]\nunit = \"m\"\nmeaning = \"wheelbase\"\n[vehicle.parameters.load]\nunit = \"kg\"\nmeaning = \"load\"\noptional = true\n[vehicle.inputs.wheel_rate]\nunit = \"rad/s\"\nmeaning = \"rate of the wheels\"\ninstead = { role = \"speed\", unit = \"m/s\", formula = \"speed/wheel_radius\" }\n[vehicle.inputs.steering_angle]\nunit = \"rad\"\nmeaning = \"steering angle\"\n[vehicle.define]\nr = { formula = \"wheel_radius\", unit = \"m\", meaning = \"rolling radius\" }\nL = { formula = \"wheelbase\", unit = \"m\", meaning = \"wheelbase\" }\n\"theta'\" = { formula = \"wheel_rate\", unit = \"rad/s\", meaning = \"rate\" }\ndelta = { formula = \"steering_angle\", unit = \"rad\", meaning = \"steering\" }\n[[vehicle.wheels]]\nname = \"rear axle\"\nradius = \"r\"\nrate = \"theta'\"\nrotation_creep = \"e_rc\"\ntraverse_creep = \"e_tc\"\n[[vehicle.wheels]]\nname = \"front axle\"\nforward = \"L\"\nsteering = \"delta\"\ntraverse_creep = \"e_f\"\n[[vehicle.wheels]]\nname = \"castor\"\non = \"rear section\"\nleft = \"L/4\"\nsteering = \"gamma\"\ntrail = \"L/8\"\nradius = \"r\"\nrate = \"theta_c'\"\nrotation_creep = \"e_rc_c\"\ntraverse_creep = \"e_c\"\n[[vehicle.trailers]]\nname = \"rear section\"\nlength = \"2*L\"\nhitch = \"L/2\"\n[[vehicle]]\nid = \"my-cart\"\ntitle = \"a cart with a rear section\"\n[vehicle.parameters.wheel_radius]\nunit = \"m\"\nmeaning = \"wheel radius\"\n[vehicle.parameters.wheelbase]\nunit = \"m\"\nmeaning = \"wheelbase\"\n[vehicle.parameters.load]\nunit = \"kg\"\nmeaning = \"load\"\noptional = true\n[vehicle.inputs.wheel_rate]\nunit = \"rad/s\"\nmeaning = \"rate of the wheels\"\ninstead = { role = \"speed\", unit = \"m/s\", formula = \"speed/wheel_radius\" }\n[vehicle.inputs.steering_angle]\nunit = \"rad\"\nmeaning = \"steering angle\"\n[vehicle.define]\nr = { formula = \"wheel_radius\", unit = \"m\", meaning = \"rolling radius\" }\nL = { formula = \"wheelbase\", unit = \"m\", meaning = \"wheelbase\" }\n\"theta'\" = { formula = \"wheel_rate\", unit = \"rad/s\", meaning = \"rate\" }\ndelta = { formula = \"steering_angle\", unit = \"rad\", meaning = \"steering\" }\n[[vehicle.wheels]]\nname = \"rear axle\"\nradius = \"r\"\nrate = \"theta'\"\nrotation_creep = \"e_rc\"\ntraverse_creep = \"e_tc\"\n[[vehicle.wheels]]\nname = \"front axle\"\nforward = \"L\"\nsteering = \"delta\"\ntraverse_creep = \"e_f\"\n[[vehicle.wheels]]\nname = \"castor\"\non = \"rear section\"\nleft = \"L/4\"\nsteering = \"gamma\"\ntrail = \"L/8\"\nradius = \"r\"\nrate = \"theta_c'\"\nrotation_creep = \"e_rc_c\"\ntraverse_creep = \"e_c\"\n[[vehicle.trailers]]\nname = \"rear section\"\nlength = \"2*L\"\nhitch = \"L/2\"\n",
        )],
        "52:6: two vehicles are called \"my-cart\"; give one another id",
    ),
    case("id number", &[("\"my-cart\"", "3")], "2:6: id must be a text, not a number; write id = \"…\""),
    case(
        "no unit",
        &[("unit = \"kg\"\n", "")],
        "10:1: key \"unit\" in [vehicle.parameters.load] is missing; write unit = \"m/s\", or \"1\" for a number",
    ),
    case(
        "bad unit",
        &[("unit = \"kg\"", "unit = \"lb\"")],
        "11:8: \"lb\" is no unit; write m, s, kg, rad or 1 with * / ^, such as \"s^2/m\"",
    ),
    case(
        "no meaning",
        &[("meaning = \"load\"\n", "")],
        "10:1: key \"meaning\" in [vehicle.parameters.load] is missing; write meaning = \"what it is, in a line\"",
    ),
    case(
        "parameter key",
        &[("optional = true", "optionnal = true")],
        "13:1: unknown key \"optionnal\" in [vehicle.parameters.load]; did you mean \"optional\"? known keys: unit, meaning, optional",
    ),
    case(
        "optional word",
        &[("optional = true", "optional = \"yes\"")],
        "13:12: optional must be true or false, not a text; write optional = true",
    ),
    case(
        "reserved parameter",
        &[("parameters.load", "parameters.x")],
        "10:21: x is a name of every model: position of the reference point along x; give yours another name, such as one with a letter as its index",
    ),
    case(
        "taken parameter",
        &[("parameters.load", "parameters.tractor")],
        "10:21: \"tractor\" cannot name a parameter or an input; begin with a letter, go on with letters, digits and _; functions, it, and time, heading, tractor and other keys of model files are taken",
    ),
    case(
        "function parameter",
        &[("parameters.load", "parameters.sin")],
        "10:21: \"sin\" cannot name a parameter or an input; begin with a letter, go on with letters, digits and _; functions, it, and time, heading, tractor and other keys of model files are taken",
    ),
    case(
        "hyphen parameter",
        &[("parameters.load", "parameters.my-load")],
        "10:21: \"my-load\" cannot name a parameter or an input; begin with a letter, go on with letters, digits and _; functions, it, and time, heading, tractor and other keys of model files are taken",
    ),
    case(
        "digit parameter",
        &[("parameters.load", "parameters.2nd_load")],
        "10:21: \"2nd_load\" cannot name a parameter or an input; begin with a letter, go on with letters, digits and _; functions, it, and time, heading, tractor and other keys of model files are taken",
    ),
    case(
        "long parameter",
        &[("parameters.load", "parameters.lllllllllllllllllllllllllllllllllllllllllllllllllllllllllllll")],
        "10:21: \"llllllllllllllllllllllllllllllllllllllll…\" cannot name a parameter or an input; begin with a letter, go on with letters, digits and _; functions, it, and time, heading, tractor and other keys of model files are taken",
    ),
    case(
        "twice",
        &[("parameters.load", "parameters.steering_angle")],
        "18:17: steering_angle is declared twice, first at line 10; parameters, inputs and defined symbols share one set of names; give one of them another",
    ),
    case(
        "twice2",
        &[("parameters.load", "parameters.L")],
        "23:1: L is declared twice, first at line 10; parameters, inputs and defined symbols share one set of names; give one of them another",
    ),
    case(
        "trailer's name",
        &[("parameters.load", "parameters.trailer_length_2")],
        "10:21: trailer_length_2 is a name of every model: from the hitch to the axle of trailer 2; give yours another name, such as one with a letter as its index",
    ),
    case(
        "column input",
        &[("inputs.steering_angle", "inputs.heading")],
        "18:17: \"heading\" cannot name a parameter or an input; begin with a letter, go on with letters, digits and _; functions, it, and time, heading, tractor and other keys of model files are taken",
    ),
    case(
        "instead no formula",
        &[(", formula = \"speed/wheel_radius\"", "")],
        "17:11: key \"formula\" in instead is missing; write instead = { role = \"speed\", unit = \"m/s\", formula = \"speed/wheel_radius\" }",
    ),
    case(
        "instead key",
        &[("role = \"speed\"", "rolle = \"speed\"")],
        "17:13: unknown key \"rolle\" in instead; did you mean \"role\"? known keys: role, unit, formula, moves",
    ),
    case(
        "moves what",
        &[("meaning = \"steering angle\"", "meaning = \"steering angle\"\nmoves = \"sideways\"")],
        "21:9: moves: unknown variant `sideways`, expected one of `forward`, `wheel`, `left-wheel`, `right-wheel`, `omni-wheel`, `yaw`, `steering`, `rear-steering`, `shape`",
    ),
    case(
        "instead not table",
        &[("instead = { role = \"speed\", unit = \"m/s\", formula = \"speed/wheel_radius\" }", "instead = \"speed\"")],
        "17:11: instead must be a table, not a text; write instead = { role = \"speed\", unit = \"m/s\", formula = \"speed/wheel_radius\" }",
    ),
    case(
        "instead unit",
        &[("\"speed/wheel_radius\"", "\"speed*wheel_radius\"")],
        "17:54: the formula for wheel_rate is in m^2/s, but wheel_rate is in 1/s; correct the formula, or a unit\n  speed*wheel_radius\n  ^",
    ),
    case(
        "instead name",
        &[("\"speed/wheel_radius\"", "\"speeed/wheel_radius\"")],
        "17:54: nothing here is called \"speeed\"; did you mean \"speed\"? it has: load, speed, wheel_radius, wheelbase\n  speeed/wheel_radius\n  ^",
    ),
    case(
        "instead role taken",
        &[("role = \"speed\"", "role = \"load\"")],
        "17:13: load is declared twice, first at line 10; parameters, inputs and defined symbols share one set of names; give one of them another",
    ),
    case(
        "define text",
        &[("L = { formula = \"wheelbase\", unit = \"m\", meaning = \"wheelbase\" }", "L = \"wheelbase\"")],
        "23:5: L must be a table, not a text; write r = { formula = \"wheel_radius\", unit = \"m\", meaning = \"rolling radius\" }",
    ),
    case(
        "define key",
        &[("r = { formula", "r = { forumla")],
        "22:7: unknown key \"forumla\" in [vehicle.define.r]; did you mean \"formula\"? known keys: formula, unit, meaning",
    ),
    case(
        "formula",
        &[("formula = \"wheelbase\"", "formula = \"wheelbase +\"")],
        "23:29: expected a number, a name or \"(\", found the end\n  wheelbase +\n             ^",
    ),
    case(
        "formula name",
        &[("formula = \"wheelbase\"", "formula = \"2*wheelbasse\"")],
        "23:20: nothing here is called \"wheelbasse\"; did you mean \"wheelbase\"? it has: L, delta, load, r, steering_angle, theta', wheel_radius, wheel_rate, wheelbase\n  2*wheelbasse\n    ^",
    ),
    case(
        "formula role",
        &[("formula = \"wheelbase\"", "formula = \"speed\"")],
        "23:18: nothing here is called \"speed\"; it has: L, delta, load, r, steering_angle, theta', wheel_radius, wheel_rate, wheelbase\n  speed\n  ^",
    ),
    case(
        "function",
        &[("formula = \"wheelbase\"", "formula = \"sinh(wheelbase)\"")],
        "23:18: no function is called \"sinh\"; known are sin, cos, tan, cot, asin, acos, atan, tanh, exp, ln, sqrt, abs, sign, heaviside\n  sinh(wheelbase)\n  ^",
    ),
    case(
        "define unit",
        &[("formula = \"wheelbase\"", "formula = \"wheelbase^2\"")],
        "23:18: the formula for L is in m^2, but L is in m; correct the formula, or a unit\n  wheelbase^2\n  ^",
    ),
    case(
        "define mixed",
        &[("formula = \"wheelbase\"", "formula = \"wheelbase + load\"")],
        "23:18: wheelbase + load has no unit: wheelbase is in m, load is in kg; add only what has one unit; functions take and give numbers\n  wheelbase + load\n  ^",
    ),
    case(
        "define reserved",
        &[("delta = {", "v_t = {"), ("steering = \"delta\"", "steering = \"v_t\"")],
        "25:1: v_t is a name of every model: speed of the reference point to the left; give yours another name, such as one with a letter as its index",
    ),
    case(
        "define symbol",
        &[("delta = {", "\"del-ta\" = {")],
        "25:12: \"del-ta\" is no symbol; begin with a letter, go on with letters, digits and _, end with ' for a rate; functions and it are taken",
    ),
    case(
        "define function",
        &[("delta = {", "sin = {")],
        "25:7: \"sin\" is no symbol; begin with a letter, go on with letters, digits and _, end with ' for a rate; functions and it are taken",
    ),
    case(
        "define it",
        &[("delta = {", "it = {")],
        "25:6: \"it\" is no symbol; begin with a letter, go on with letters, digits and _, end with ' for a rate; functions and it are taken",
    ),
    case(
        "circle",
        &[("formula = \"wheelbase\"", "formula = \"r\""), ("formula = \"wheel_radius\"", "formula = \"L\"")],
        "22:18: the formulas of L, r use each other in a circle; define each from parameters, inputs and what needs none of the others\n  L\n  ^",
    ),
    case(
        "yaw unit",
        &[(
            "delta = { formula = \"steering_angle\", unit = \"rad\"",
            "\"phi'\" = { formula = \"steering_angle\", unit = \"rad\"",
        )],
        "25:1: the yaw rate phi' is in rad/s, not in rad; write unit = \"rad/s\"",
    ),
    case(
        "circle of one",
        &[("formula = \"wheelbase\"", "formula = \"L + wheelbase\"")],
        "23:18: the formulas of L use each other in a circle; define each from parameters, inputs and what needs none of the others\n  L + wheelbase\n  ^",
    ),
    case(
        "tower",
        &[("formula = \"wheelbase\"", "formula = \"((wheelbase^8)^8)^8/wheelbase^511\"")],
        "23:48: expected a whole exponent up to 64, found a number; write other powers with sqrt, exp and ln\n  ((wheelbase^8)^8)^8/wheelbase^511\n                                ^",
    ),
    case(
        "no wheels",
        &[(
            "[[vehicle.wheels]]\nname = \"rear axle\"\nradius = \"r\"\nrate = \"theta'\"\nrotation_creep = \"e_rc\"\ntraverse_creep = \"e_tc\"\n[[vehicle.wheels]]\nname = \"front axle\"\nforward = \"L\"\nsteering = \"delta\"\ntraverse_creep = \"e_f\"\n[[vehicle.wheels]]\nname = \"castor\"\non = \"rear section\"\nleft = \"L/4\"\nsteering = \"gamma\"\ntrail = \"L/8\"\nradius = \"r\"\nrate = \"theta_c'\"\nrotation_creep = \"e_rc_c\"\ntraverse_creep = \"e_c\"\n",
            "",
        )],
        "1:1: key \"wheels\" in [[vehicle]] is missing; write [[vehicle.wheels]], with double brackets, before each wheel",
    ),
    case(
        "wheels empty",
        &[
            ("title =", "wheels = []\ntitle ="),
            (
                "[[vehicle.wheels]]\nname = \"rear axle\"\nradius = \"r\"\nrate = \"theta'\"\nrotation_creep = \"e_rc\"\ntraverse_creep = \"e_tc\"\n[[vehicle.wheels]]\nname = \"front axle\"\nforward = \"L\"\nsteering = \"delta\"\ntraverse_creep = \"e_f\"\n[[vehicle.wheels]]\nname = \"castor\"\non = \"rear section\"\nleft = \"L/4\"\nsteering = \"gamma\"\ntrail = \"L/8\"\nradius = \"r\"\nrate = \"theta_c'\"\nrotation_creep = \"e_rc_c\"\ntraverse_creep = \"e_c\"\n",
                "",
            ),
        ],
        "3:10: the vehicle has no wheel; write [[vehicle.wheels]], with double brackets, before each wheel",
    ),
    case(
        "wheel key",
        &[("steering = \"delta\"", "stearing = \"delta\"")],
        "35:1: unknown key \"stearing\" in [[vehicle.wheels]]; did you mean \"steering\"? known keys: name, on, forward, left, steering, trail, roller, radius, rate, rotation_creep, traverse_creep",
    ),
    case(
        "wheel no name",
        &[("name = \"front axle\"\n", "")],
        "32:1: key \"name\" in [[vehicle.wheels]] is missing; write name = \"front axle\"",
    ),
    case(
        "wheel twice",
        &[("name = \"front axle\"", "name = \"rear axle\"")],
        "33:8: two wheels are called \"rear axle\"; give one another name",
    ),
    case(
        "wheel no radius",
        &[("radius = \"r\"\n", "")],
        "27:8: the wheel \"rear axle\" has a rate but no radius; a wheel that rolls has radius, rate and rotation_creep: write radius = \"r\"",
    ),
    case(
        "wheel no creep",
        &[("rotation_creep = \"e_rc\"\n", "")],
        "27:8: the wheel \"rear axle\" has a radius but no rotation_creep; a wheel that rolls has radius, rate and rotation_creep: write rotation_creep = \"e_rc\"",
    ),
    case(
        "wheel no rate",
        &[("rate = \"theta'\"\n", "")],
        "27:8: the wheel \"rear axle\" has a radius but no rate; a wheel that rolls has radius, rate and rotation_creep: write rate = \"theta'\"",
    ),
    case(
        "rollers and a direction",
        &[("radius = \"r\"\n", "radius = \"r\"\nroller = \"pi/4\"\n")],
        "27:8: the wheel \"rear axle\" has rollers, but it keeps a direction; a wheel with rollers has radius, rate and rotation_creep, and no traverse_creep",
    ),
    case(
        "rollers in no unit",
        &[("radius = \"r\"\n", "radius = \"r\"\nroller = 0.5\n")],
        "29:10: roller is a number without a unit; write a formula of an angle in rad: \"pi/4\"",
    ),
    case(
        "rollers across",
        &[("radius = \"r\"\n", "radius = \"r\"\nroller = \"pi/2\"\n")],
        "29:10: a wheel with its rollers across it drives nothing; roller is the angle from the wheel's heading to the axis of the roller on the ground",
    ),
    case(
        "wheel nothing",
        &[("steering = \"delta\"\ntraverse_creep = \"e_f\"\n", "")],
        "33:8: the wheel \"front axle\" constrains nothing; write radius, rate and rotation_creep for one that rolls, traverse_creep for one that keeps a direction",
    ),
    case(
        "wheel rate no prime",
        &[("rate = \"theta'\"", "rate = \"theta\"")],
        "29:8: rate = \"theta\" is no rate; write a symbol such as \"theta'\"",
    ),
    case(
        "steering prime",
        &[("steering = \"delta\"", "steering = \"delta'\"")],
        "35:12: steering = \"delta'\" is a rate; write a symbol such as \"delta\"",
    ),
    case(
        "steering input",
        &[("steering = \"delta\"", "steering = \"steering_angle\"")],
        "35:12: steering = \"steering_angle\" is a name of model files, not a symbol of formulas; below [vehicle.define] write delta = { formula = \"steering_angle\", unit = \"rad\", meaning = \"…\" }, and here delta",
    ),
    case(
        "rate input",
        &[("rate = \"theta'\"", "rate = \"wheel_rate\"")],
        "29:8: rate = \"wheel_rate\" is no rate; write a symbol such as \"theta'\"",
    ),
    case(
        "radius parameter",
        &[("radius = \"r\"", "radius = \"wheel_radius\"")],
        "28:10: radius = \"wheel_radius\" is a name of model files, not a symbol of formulas; below [vehicle.define] write r = { formula = \"wheel_radius\", unit = \"m\", meaning = \"…\" }, and here r",
    ),
    case(
        "radius undefined",
        &[("radius = \"r\"", "radius = \"R\"")],
        "28:10: the radius R has no definition; did you mean \"r\"? it has: L, delta, r, theta'",
    ),
    case(
        "steering reserved",
        &[("steering = \"gamma\"", "steering = \"phi_1\"")],
        "41:12: phi_1 is a name of every model: heading of trailer 1; give yours another name, such as one with a letter as its index",
    ),
    case(
        "creep reserved",
        &[("\"e_c\"", "\"e_tc_1\"")],
        "46:18: e_tc_1 is a name of every model: traverse creep of trailer 1; give yours another name, such as one with a letter as its index",
    ),
    case(
        "creep defined",
        &[("\"e_c\"", "\"L\"")],
        "46:18: L is also a defined symbol; give the coefficient a name of its own, such as e_b",
    ),
    case(
        "creep both",
        &[("\"e_c\"", "\"e_rc\"")],
        "30:18: e_rc is also the traverse creep of the wheel \"castor\"; give the coefficient a name of its own, such as e_b",
    ),
    case(
        "creep angle",
        &[("\"e_c\"", "\"gamma\"")],
        "46:18: gamma is also an angle or a radius of the wheel \"castor\"; give the coefficient a name of its own, such as e_b",
    ),
    case(
        "creep is a rate",
        &[("\"e_c\"", "\"e_c'\"")],
        "46:18: traverse_creep = \"e_c'\" is a rate; write a symbol such as \"e_c\"",
    ),
    case(
        "place name",
        &[("left = \"L/4\"", "left = \"l/4\"")],
        "40:9: nothing here is called \"l\"; did you mean \"L\"? it has: L, delta, load, r, steering_angle, theta', wheel_radius, wheel_rate, wheelbase\n  l/4\n  ^",
    ),
    case(
        "place number",
        &[("left = \"L/4\"", "left = 0.5")],
        "40:8: left is a number without a unit; declare a parameter in m, as in [vehicle.parameters.wheelbase], and write a formula of such",
    ),
    case(
        "place unit",
        &[("left = \"L/4\"", "left = \"1/4\"")],
        "40:9: the formula for left is in 1, but left is in m; a length is a formula of parameters and defined symbols in m\n  1/4\n  ^",
    ),
    case(
        "place input",
        &[("left = \"L/4\"", "left = \"L*cos(delta)\"")],
        "40:15: a place on the body would move with the input steering_angle; use parameters only, by themselves or through defined symbols\n  L*cos(delta)\n        ^",
    ),
    case(
        "on unknown",
        &[("on = \"rear section\"", "on = \"rear sektion\"")],
        "39:6: no trailer of the vehicle is called \"rear sektion\"; did you mean \"rear section\"? trailers: rear section",
    ),
    case(
        "on without trailers",
        &[("[[vehicle.trailers]]\nname = \"rear section\"\nlength = \"2*L\"\nhitch = \"L/2\"\n", "")],
        "39:6: no trailer of the vehicle is called \"rear section\"; trailers: none",
    ),
    case(
        "trailer no length",
        &[("length = \"2*L\"\n", "")],
        "47:1: key \"length\" in [[vehicle.trailers]] is missing; write length = \"d\", from the hitch back to the axle",
    ),
    case(
        "trailer unit",
        &[("length = \"2*L\"", "length = \"2\"")],
        "49:11: the formula for length is in 1, but length is in m; a length is a formula of parameters and defined symbols in m\n  2\n  ^",
    ),
    case(
        "trailer key",
        &[("hitch = \"L/2\"", "hitch_offset = \"L/2\"")],
        "50:1: unknown key \"hitch_offset\" in [[vehicle.trailers]]; did you mean \"hitch\"? known keys: name, length, hitch",
    ),
    case(
        "trailer twice",
        &[("hitch = \"L/2\"\n", "hitch = \"L/2\"\n[[vehicle.trailers]]\nname = \"rear section\"\nlength = \"L\"\n")],
        "52:8: two trailers are called \"rear section\"; give one another name",
    ),
    case(
        "trailer single bracket",
        &[("[[vehicle.trailers]]", "[vehicle.trailers]")],
        "47:1: trailers must be a list, not a table; write [[vehicle.trailers]], with double brackets, before each trailer",
    ),
    case(
        "line with trailer",
        &[("title =", "line = true\ntitle =")],
        "49:8: a vehicle on a line has no trailer; remove it, or line = true",
    ),
    case(
        "steering unit",
        &[("steering = \"delta\"", "steering = \"L\"")],
        "35:12: the steering L is in m, but a steering is in rad; name another symbol, or correct its definition",
    ),
    case(
        "radius unit",
        &[("radius = \"r\"", "radius = \"delta\"")],
        "28:10: the radius delta is in rad, but a radius is in m; name another symbol, or correct its definition",
    ),
    case(
        "rate unit",
        &[("formula = \"wheel_rate\", unit = \"rad/s\"", "formula = \"wheel_rate*wheel_radius\", unit = \"m/s\"")],
        "29:8: the rate theta' is in m/s, but a rate is in rad/s; name another symbol, or correct its definition",
    ),
    case(
        "held unknown",
        &[("title =", "held = [\"v_q\"]\ntitle =")],
        "3:9: nothing is called \"v_q\"; did you mean \"v_n\"? there are: L, delta, r, theta', e_rc, e_tc, e_f, e_rc_c, e_c, v_n, phi', v_d, v_l, v_t, x', y', … (31 in all)",
    ),
    case(
        "held word",
        &[("title =", "held = \"v_t\"\ntitle =")],
        "3:8: held must be a list, not a text; write held = [\"v_t\"]",
    ),
    case(
        "no yaw",
        &[
            ("steering = \"delta\"", "steering = \"beta\""),
            ("delta = { formula = \"steering_angle\", unit = \"rad\", meaning = \"steering\" }\n", ""),
            ("[vehicle.inputs.steering_angle]\nunit = \"rad\"\nmeaning = \"steering angle\"\n", ""),
        ],
        "2:6: the constraints of my-cart do not determine its motion by themselves: nothing gives its yaw rate; give a wheel a rate or a steering that an input defines, log the yaw rate and define \"phi'\" from it, or write instead = \"what to use\" to have the vehicle described only",
    ),
    case(
        "no speed",
        &[("\"theta'\" = { formula = \"wheel_rate\", unit = \"rad/s\", meaning = \"rate\" }\n", "")],
        "2:6: the constraints of my-cart do not determine its motion by themselves: nothing gives its forward speed; give a wheel a rate or a steering that an input defines, log the yaw rate and define \"phi'\" from it, or write instead = \"what to use\" to have the vehicle described only",
    ),
    case(
        "no speed nor yaw",
        &[
            ("\"theta'\" = { formula = \"wheel_rate\", unit = \"rad/s\", meaning = \"rate\" }\n", ""),
            ("steering = \"delta\"", "steering = \"beta\""),
        ],
        "2:6: the constraints of my-cart do not determine its motion by themselves: nothing gives its forward speed, its yaw rate; give a wheel a rate or a steering that an input defines, log the yaw rate and define \"phi'\" from it, or write instead = \"what to use\" to have the vehicle described only",
    ),
    case(
        "contradiction",
        &[("steering = \"gamma\"\n", "")],
        "38:8: the constraints of my-cart contradict each other for general inputs: what the others give breaks castor, direction; take a direction or a rate away, set a wheel where it can roll with the others, or let it turn freely by naming a steering without a definition",
    ),
    case(
        "contradiction on body",
        &[("on = \"rear section\"\n", ""), ("steering = \"gamma\"\n", ""), ("left = \"L/4\"", "forward = \"-L\"")],
        "38:8: the constraints of my-cart contradict each other for general inputs: what the others give breaks castor, direction; take a direction or a rate away, set a wheel where it can roll with the others, or let it turn freely by naming a steering without a definition",
    ),
    case(
        "instead moves",
        &[("title =", "instead = \"a car\"\ntitle =")],
        "3:1: `instead` is for a vehicle that can only be described, but the constraints determine this one's motion; remove it",
    ),
    case(
        "idle input",
        &[("formula = \"steering_angle\"", "formula = \"wheel_radius/wheelbase\"")],
        "18:17: the motion does not depend on the input steering_angle; use it in a formula, or remove it",
    ),
    case(
        "optional needed",
        &[("meaning = \"wheelbase\"\n", "meaning = \"wheelbase\"\noptional = true\n")],
        "7:21: the parameter wheelbase is optional, but the motion depends on it; remove optional = true",
    ),
    case(
        "division at rest",
        &[("formula = \"steering_angle\"", "formula = \"atan(tan(steering_angle)^2/tan(steering_angle))\"")],
        "25:22: delta is undefined where every input is 0 and every heading is along x; it is atan(tan(steering_angle)^2/tan(steering_…; avoid a division by what is 0 there, such as the tangent of a steering angle\n  atan(tan(steering_angle)^2/tan(steering_angle))\n  ^",
    ),
    case(
        "letter of the catalogue",
        &[
            (
                "L = { formula = \"wheelbase\", unit = \"m\", meaning = \"wheelbase\" }",
                "L = { formula = \"steering_angle/2\", unit = \"rad\", meaning = \"half the steering\" }\nl_w = { formula = \"wheelbase\", unit = \"m\", meaning = \"wheelbase\" }",
            ),
            ("forward = \"L\"", "forward = \"l_w\""),
            ("\"L/4\"", "\"l_w/4\""),
            ("\"L/8\"", "\"l_w/8\""),
            ("\"2*L\"", "\"2*l_w\""),
            ("\"L/2\"", "\"l_w/2\""),
        ],
        "23:1: the effects of the library take L for the wheelbase, in m, not in rad; give the symbol another letter",
    ),
    case(
        "name of the clock",
        &[("parameters.load", "parameters.delay")],
        "10:21: delay is a name of every model: how far back the logged inputs are looked up; give yours another name, such as one with a letter as its index",
    ),
    case(
        "growth",
        &[(
            "L = { formula = \"wheelbase\"",
            "k_0 = { formula = \"(wheel_radius/wheelbase)^30\", unit = \"1\", meaning = \"a number\" }\nk_1 = { formula = \"(1 + k_0)^60\", unit = \"1\", meaning = \"a number\" }\nL = { formula = \"wheelbase*k_1\"",
        )],
        "35:8: the constraints of my-cart contradict each other for general inputs: what the others give breaks front axle, direction; rear section, trailer 1, direction; take a direction or a rate away, set a wheel where it can roll with the others, or let it turn freely by naming a steering without a definition",
    ),
    case(
        "castor without trail",
        &[("trail = \"L/8\"\n", "")],
        "38:8: the constraints of my-cart do not say what the castor does; a wheel that turns freely follows by its trail: write trail = \"…\"",
    ),
    case(
        "long product",
        &[("left = \"L/4\"", "left = \"L^4*L^4/L^7\"")],
        "40:9: a length has a product of more than 6 factors; define a symbol for a part of it\n  L^4*L^4/L^7\n  ^",
    ),
    case(
        "free angle of a driven wheel",
        &[("steering = \"gamma\"", "steering = \"gamma\""), ("theta_c'", "theta'")],
        "38:8: the wheel \"castor\" turns freely, but its rate theta' is defined; give it a rate of its own without a definition, or define its steering",
    ),
    case(
        "quoted rate",
        &[("\"theta'\" = {", "theta' = {")],
        "24:6: is not valid TOML: invalid unquoted key, expected letters, numbers, `-`, `_`; a file of vehicles holds [[vehicle]], lines like id = \"my-robot\", and below [vehicle.define] lines like \"theta'\" = { formula = \"wheel_rate\", … }, where a name with ' stands in quotes",
    ),
    case(
        "define instead",
        &[("delta = {", "speed = {")],
        "25:1: speed is declared twice, first at line 17; parameters, inputs and defined symbols share one set of names; give one of them another",
    ),
    case(
        "wheels as a table",
        &[("[[vehicle.wheels]]\nname = \"rear axle\"", "[vehicle.wheels]\nname = \"rear axle\"")],
        "32:11: is not valid TOML: duplicate key; a file of vehicles holds [[vehicle]], lines like id = \"my-robot\", and below [vehicle.define] lines like \"theta'\" = { formula = \"wheel_rate\", … }, where a name with ' stands in quotes",
    ),
    case(
        "trailers number",
        &[("length = \"2*L\"", "length = 3.0")],
        "49:10: length is a number without a unit; declare a parameter in m, as in [vehicle.parameters.wheelbase], and write a formula of such",
    ),
    case(
        "too many trailers",
        &[(
            "[[vehicle.trailers]]",
            "[[vehicle.trailers]]\nname = \"a\"\nlength = \"L\"\n[[vehicle.trailers]]\nname = \"b\"\nlength = \"L\"\n[[vehicle.trailers]]\nname = \"c\"\nlength = \"L\"\n[[vehicle.trailers]]\nname = \"d\"\nlength = \"L\"\n[[vehicle.trailers]]\nname = \"e\"\nlength = \"L\"\n[[vehicle.trailers]]\nname = \"f\"\nlength = \"L\"\n[[vehicle.trailers]]",
        )],
        "47:1: trailers has 7 entries; give at most 6",
    ),
    case(
        "line that turns",
        &[
            ("title =", "line = true\ntitle ="),
            ("[[vehicle.trailers]]\nname = \"rear section\"\nlength = \"2*L\"\nhitch = \"L/2\"\n", ""),
            ("on = \"rear section\"\n", ""),
        ],
        "28:8: the constraints of my-cart contradict each other for general inputs: what the others give breaks rear axle, direction; front axle, direction; take a direction or a rate away, set a wheel where it can roll with the others, or let it turn freely by naming a steering without a definition",
    ),
    case(
        "unfinished table",
        &[("[[vehicle.trailers]]", "[[vehicle.trailers]")],
        "47:20: is not valid TOML: unclosed array table, expected `]`; a file of vehicles holds [[vehicle]], lines like id = \"my-robot\", and below [vehicle.define] lines like \"theta'\" = { formula = \"wheel_rate\", … }, where a name with ' stands in quotes",
    ),
];

/// A good file of a vehicle with a constraint type of its own.
pub const ROPE: &str = "\
[[vehicle]]
id = \"rope-cart\"
title = \"a cart that a drum pulls along a rope\"
heading = \"phi\"
[vehicle.parameters.drum_radius]
unit = \"m\"
meaning = \"radius of the drum\"
[vehicle.inputs.drum_rate]
unit = \"rad/s\"
meaning = \"rate of the drum\"
[vehicle.inputs.yaw_rate]
unit = \"rad/s\"
meaning = \"yaw rate\"
[vehicle.define]
b = { formula = \"drum_radius\", unit = \"m\", meaning = \"radius of the drum\" }
\"theta'\" = { formula = \"drum_rate\", unit = \"rad/s\", meaning = \"rate of the drum\" }
\"phi'\" = { formula = \"yaw_rate\", unit = \"rad/s\", meaning = \"yaw rate\" }
[[vehicle.coordinates]]
name = \"x\"
unit = \"m\"
meaning = \"position along x\"
[[vehicle.coordinates]]
name = \"y\"
unit = \"m\"
meaning = \"position along y\"
[[vehicle.coordinates]]
name = \"phi\"
unit = \"rad\"
meaning = \"heading\"
[[vehicle.coordinates]]
name = \"theta\"
unit = \"rad\"
meaning = \"angle of the drum\"
[[vehicle.wheels]]
name = \"axle\"
traverse_creep = \"e_tc\"
[[vehicle.constraints]]
name = \"rope\"
type = { id = \"cable\", letter = \"C\", form = \"pays' - (1 - e)*drum*turns'\", creep = \"slip of the rope\" }
creep = \"e_rc\"
slots = { \"pays'\" = \"cos(phi)*x' + sin(phi)*y'\", drum = \"b\", \"turns'\" = \"theta'\" }
";

/// Coordinates, constraints and their types that are refused.
pub const BAD_CONSTRAINTS: &[Case] = &[
    case(
        "type unknown",
        &[(
            "type = { id = \"cable\", letter = \"C\", form = \"pays' - (1 - e)*drum*turns'\", creep = \"slip of the rope\" }",
            "type = \"cabel\"",
        )],
        "39:8: no type of constraint is called \"cabel\"; types: rolling, direction, momentum; one of your own is { id = \"cable\", letter = \"C\", form = \"pays' - (1 - e)*drum*turns'\" }",
    ),
    case(
        "type near",
        &[(
            "type = { id = \"cable\", letter = \"C\", form = \"pays' - (1 - e)*drum*turns'\", creep = \"slip of the rope\" }",
            "type = \"roling\"",
        )],
        "39:8: no type of constraint is called \"roling\"; did you mean \"rolling\"? types: rolling, direction, momentum; one of your own is { id = \"cable\", letter = \"C\", form = \"pays' - (1 - e)*drum*turns'\" }",
    ),
    case(
        "type number",
        &[(
            "type = { id = \"cable\", letter = \"C\", form = \"pays' - (1 - e)*drum*turns'\", creep = \"slip of the rope\" }",
            "type = 3",
        )],
        "39:8: type must be a table, not a number; write type = { id = \"cable\", letter = \"C\", form = \"pays' - (1 - e)*drum*turns'\" }",
    ),
    case(
        "type key",
        &[("creep = \"slip of the rope\" }", "crep = \"slip of the rope\" }")],
        "39:76: unknown key \"crep\" in type; did you mean \"creep\"? known keys: id, letter, form, meaning, creep, source, latex, slots, gives, singular, printed, regimes",
    ),
    case(
        "type no form",
        &[("form = \"pays' - (1 - e)*drum*turns'\", ", "")],
        "39:8: key \"form\" in type is missing; write the form, as in { id = \"cable\", letter = \"C\", form = \"pays' - (1 - e)*drum*turns'\" }",
    ),
    case("type no id", &[("id = \"cable\", ", "")], "39:8: key \"id\" in type is missing; write id = \"cable\""),
    case(
        "type no letter",
        &[("letter = \"C\", ", "")],
        "39:8: key \"letter\" in type is missing; write letter = \"C\", for signatures",
    ),
    case(
        "letter taken",
        &[("letter = \"C\"", "letter = \"R\"")],
        "39:33: R is the letter of the type rolling; write another, or the type of the catalogue by its id",
    ),
    case(
        "letter long",
        &[("letter = \"C\"", "letter = \"cable\"")],
        "39:33: letter must be one capital letter; write letter = \"C\"",
    ),
    case(
        "form malformed",
        &[("form = \"pays' - (1 - e)", "form = \"pays' - (1 - e")],
        "39:72: expected \")\", found the end\n  pays' - (1 - e*drum*turns'\n                            ^",
    ),
    case(
        "form unknown slot",
        &[("creep = \"slip of the rope\" }", "creep = \"slip of the rope\", gives = \"turn'\" }")],
        "39:112: the form has no slot \"turn'\"; did you mean \"turns'\"? slots: drum, pays', turns'",
    ),
    case(
        "form printed",
        &[("creep = \"slip of the rope\" }", "creep = \"slip of the rope\", printed = \"rows\" }")],
        "39:114: printed cannot be \"rows\"; did you mean \"row\"? it is one of: form, row",
    ),
    case(
        "form slot twice",
        &[(
            "creep = \"slip of the rope\" }",
            "creep = \"slip of the rope\", slots = [{ name = \"drum\" }, { name = \"drum\" }] }",
        )],
        "39:141: the slot drum is named twice; remove one of the two",
    ),
    case(
        "form slot unknown",
        &[("creep = \"slip of the rope\" }", "creep = \"slip of the rope\", slots = [{ name = \"drun\" }] }")],
        "39:122: the form has no slot \"drun\"; did you mean \"drum\"? slots: drum, pays', turns'",
    ),
    case(
        "form powers",
        &[("*drum*", "*drum^9*")],
        "39:46: a constraint has a product of more than 8 factors; define a symbol for a part of it\n  pays' - (1 - e)*drum^9*turns'\n  ^",
    ),
    case(
        "no type",
        &[(
            "type = { id = \"cable\", letter = \"C\", form = \"pays' - (1 - e)*drum*turns'\", creep = \"slip of the rope\" }\n",
            "",
        )],
        "37:1: key \"type\" in [[vehicle.constraints]] is missing; write type = \"momentum\", or { id = …, letter = …, form = … }",
    ),
    case(
        "no creep",
        &[("creep = \"e_rc\"\n", "")],
        "37:1: key \"creep\" in [[vehicle.constraints]] is missing; write creep = \"e_c\", its coefficient",
    ),
    case(
        "creep rate",
        &[("creep = \"e_rc\"", "creep = \"e_rc'\"")],
        "40:9: \"e_rc'\" is a rate; write it without the '",
    ),
    case(
        "creep taken",
        &[("creep = \"e_rc\"", "creep = \"b\"")],
        "41:1: the form of type cable is not linear in its coefficient; write it with e as a factor, such as 1 - e",
    ),
    case(
        "creep declared",
        &[("creep = \"e_rc\"", "creep = \"drum_radius\"")],
        "40:9: the coefficient drum_radius is also a declared name; give it a name of its own, such as e_b",
    ),
    case(
        "creep coordinate",
        &[("creep = \"e_rc\"", "creep = \"theta\"")],
        "40:9: the coefficient theta is also a coordinate; give it a name of its own, such as e_b",
    ),
    case(
        "creep of a wheel",
        &[("creep = \"e_rc\"", "creep = \"e_tc\"")],
        "40:9: the coefficient e_tc is also a symbol of a wheel; give it a name of its own, such as e_b",
    ),
    case(
        "creep reserved",
        &[("creep = \"e_rc\"", "creep = \"e_tc_1\"")],
        "40:9: the coefficient e_tc_1 is also traverse creep of trailer 1; give it a name of its own, such as e_b",
    ),
    case(
        "no slots",
        &[("slots = { \"pays'\" = \"cos(phi)*x' + sin(phi)*y'\", drum = \"b\", \"turns'\" = \"theta'\" }\n", "")],
        "37:1: key \"slots\" in [[vehicle.constraints]] is missing; write slots = { … } with drum, pays', turns', such as \"q1'\" = \"cos(phi)*x'\"",
    ),
    case(
        "slots text",
        &[(
            "slots = { \"pays'\" = \"cos(phi)*x' + sin(phi)*y'\", drum = \"b\", \"turns'\" = \"theta'\" }\n",
            "slots = \"theta\"\n",
        )],
        "41:9: slots must be a table, not a text; write slots = { … } with drum, pays', turns', such as \"q1'\" = \"cos(phi)*x'\"",
    ),
    case(
        "slot missing",
        &[("drum = \"b\", ", "")],
        "41:1: the slot drum of type cable is missing; write drum = \"…\" in slots",
    ),
    case(
        "slot of the catalogue missing",
        &[
            (
                "type = { id = \"cable\", letter = \"C\", form = \"pays' - (1 - e)*drum*turns'\", creep = \"slip of the rope\" }",
                "type = \"rolling\"",
            ),
            (
                "slots = { \"pays'\" = \"cos(phi)*x' + sin(phi)*y'\", drum = \"b\", \"turns'\" = \"theta'\" }\n",
                "slots = { \"q'\" = \"theta'\", sigma = \"b\" }\n",
            ),
        ],
        "41:1: the slot pi' of type rolling is missing; write \"pi'\" = \"…\" in slots, quasi-velocity: speed of the contact along the wheel",
    ),
    case(
        "slot unknown",
        &[("drum = \"b\"", "drumm = \"b\"")],
        "41:50: type cable has no slot \"drumm\"; did you mean \"drum\"? slots: drum, pays', turns'",
    ),
    case(
        "slot malformed",
        &[("\"cos(phi)*x' + sin(phi)*y'\"", "\"cos(phi)*x' + sin(phi*y'\"")],
        "41:46: expected \")\", found the end\n  cos(phi)*x' + sin(phi*y'\n                          ^",
    ),
    case(
        "slot squared",
        &[("\"cos(phi)*x' + sin(phi)*y'\"", "\"x'^2\"")],
        "41:22: x'^2 is not linear in rates, without a constant term; names that end in ' are rates: write a sum of rates with factors, such as cos(phi)*x' + b*phi'",
    ),
    case(
        "slot constant",
        &[("\"cos(phi)*x' + sin(phi)*y'\"", "\"x' + b\"")],
        "41:22: x' + b is not linear in rates, without a constant term; names that end in ' are rates: write a sum of rates with factors, such as cos(phi)*x' + b*phi'",
    ),
    case(
        "slot no rate",
        &[("\"turns'\" = \"theta'\"", "\"turns'\" = \"theta\"")],
        "41:74: the slot turns' holds no rate; names that end in ' are rates: write a sum of rates with factors, such as cos(phi)*x' + b*phi'\n  theta\n  ^",
    ),
    case(
        "factor with rate",
        &[("drum = \"b\"", "drum = \"b*theta'\"")],
        "41:1: (1 - e)*drum*turns' is not linear in rates, without a constant term; each slot holds a factor or rates",
    ),
    case(
        "slot name",
        &[("drum = \"b\"", "drum = \"bb\"")],
        "41:58: nothing here is called \"bb\"; it has: b, drum_radius, drum_rate, phi, phi', theta, theta', x, x', y, y', yaw_rate\n  bb\n  ^",
    ),
    case(
        "slot rate of nothing",
        &[("\"turns'\" = \"theta'\"", "\"turns'\" = \"psi'\"")],
        "41:74: nothing here is called \"psi'\"; did you mean \"phi'\"? it has: b, drum_radius, drum_rate, phi, phi', theta, theta', x, x', y, y', yaw_rate\n  psi'\n  ^",
    ),
    case(
        "slot unit",
        &[("drum = \"b\"", "drum = \"b + theta\"")],
        "41:58: b + theta has no unit: b is in m, theta is in 1; add only what has one unit; functions take and give numbers\n  b + theta\n  ^",
    ),
    case(
        "form unit",
        &[("drum = \"b\"", "drum = \"b^2\"")],
        "38:8: with its slots put in, cos(phi)*x' + sin(phi)*y' - (1 - e_rc)*b… has no unit: cos(phi)*x' + sin(phi)*y' is in m/s, (1 - e_rc)*b^2*theta' is in m^2/s; every term of a constraint has one unit; correct a slot",
    ),
    case(
        "generator without energy",
        &[("creep = \"e_rc\"", "creep = \"e_rc\"\ngenerator = { phi = \"1\" }")],
        "41:1: a generator goes with an energy; remove it, or write energy = \"…\"",
    ),
    case(
        "energy of a cable",
        &[
            ("creep = \"e_rc\"", "creep = \"e_rc\"\nenergy = \"b*phi'^2\""),
            ("slots = { \"pays'\" = \"cos(phi)*x' + sin(phi)*y'\", drum = \"b\", \"turns'\" = \"theta'\" }\n", ""),
        ],
        "41:1: an energy gives a momentum; write type = \"momentum\"",
    ),
    case(
        "energy and slots",
        &[("creep = \"e_rc\"", "creep = \"e_rc\"\nenergy = \"b*phi'^2\"")],
        "42:1: the slots of a momentum with an energy are derived; remove them",
    ),
    case(
        "no generator",
        &[
            (
                "type = { id = \"cable\", letter = \"C\", form = \"pays' - (1 - e)*drum*turns'\", creep = \"slip of the rope\" }",
                "type = \"momentum\"\nenergy = \"b*phi'^2\"",
            ),
            ("slots = { \"pays'\" = \"cos(phi)*x' + sin(phi)*y'\", drum = \"b\", \"turns'\" = \"theta'\" }\n", ""),
        ],
        "37:1: key \"generator\" in [[vehicle.constraints]] is missing; write generator = { psi = \"1\" }, how the symmetry moves the coordinates",
    ),
    case(
        "not symmetric",
        &[
            (
                "type = { id = \"cable\", letter = \"C\", form = \"pays' - (1 - e)*drum*turns'\", creep = \"slip of the rope\" }",
                "type = \"momentum\"\nenergy = \"b*cos(theta)*theta'^2\"\ngenerator = { theta = \"1\" }",
            ),
            ("slots = { \"pays'\" = \"cos(phi)*x' + sin(phi)*y'\", drum = \"b\", \"turns'\" = \"theta'\" }\n", ""),
        ],
        "40:11: the symmetry changes the kinetic energy, so that it conserves no momentum; along it the energy changes by -sin(theta)*b*theta'^2",
    ),
    case(
        "not quadratic",
        &[
            (
                "type = { id = \"cable\", letter = \"C\", form = \"pays' - (1 - e)*drum*turns'\", creep = \"slip of the rope\" }",
                "type = \"momentum\"\nenergy = \"b*theta'\"\ngenerator = { theta = \"1\" }",
            ),
            ("slots = { \"pays'\" = \"cos(phi)*x' + sin(phi)*y'\", drum = \"b\", \"turns'\" = \"theta'\" }\n", ""),
        ],
        "40:11: the energy b*theta' is not known to be quadratic in the rates; write a kinetic energy, every term a product of two rates such as psi' and a factor",
    ),
    case(
        "constraint key",
        &[("creep = \"e_rc\"", "creeps = \"e_rc\"")],
        "40:1: unknown key \"creeps\" in [[vehicle.constraints]]; did you mean \"creep\"? known keys: name, type, creep, slots, energy, generator",
    ),
    case(
        "constraint twice",
        &[(
            "[[vehicle.constraints]]",
            "[[vehicle.constraints]]\nname = \"rope\"\ntype = \"rolling\"\ncreep = \"e_b\"\nslots = { \"pi'\" = \"x'\", sigma = \"b\", \"q'\" = \"theta'\" }\n[[vehicle.constraints]]",
        )],
        "43:8: two constraints are called \"rope\"; give one another name",
    ),
    case(
        "coordinate twice",
        &[("name = \"theta\"", "name = \"phi\"")],
        "31:8: two coordinates are called \"phi\"; remove one of them",
    ),
    case(
        "coordinate key",
        &[("meaning = \"heading\"", "means = \"heading\"")],
        "29:1: unknown key \"means\" in [[vehicle.coordinates]]; known keys: name, unit, meaning",
    ),
    case(
        "coordinate unit",
        &[("name = \"x\"\nunit = \"m\"", "name = \"x\"\nunit = \"rad\"")],
        "19:8: x is in m, not in rad; correct its unit",
    ),
    case(
        "coordinate reserved",
        &[("name = \"theta\"", "name = \"v_t\"")],
        "31:8: v_t is a name of every model: speed of the reference point to the left; give the coordinate another name",
    ),
    case(
        "coordinate input",
        &[("name = \"theta\"", "name = \"drum_rate\"")],
        "31:8: the coordinate drum_rate is also a parameter or an input; give the input another name, and define the coordinate from it",
    ),
    case(
        "coordinate rate",
        &[("name = \"theta\"", "name = \"theta'\"")],
        "31:8: \"theta'\" is a rate; write it without the '",
    ),
    case(
        "coordinate y missing",
        &[("[[vehicle.coordinates]]\nname = \"y\"\nunit = \"m\"\nmeaning = \"position along y\"\n", "")],
        "2:6: the place of a vehicle has two coordinates, x and y; give both, or none",
    ),
    case(
        "coordinate theta missing",
        &[("[[vehicle.coordinates]]\nname = \"theta\"\nunit = \"rad\"\nmeaning = \"angle of the drum\"\n", "")],
        "37:74: theta' is the rate of no coordinate; the coordinates are x, y, phi; give the vehicle coordinates of its own, all of them, below [[vehicle.coordinates]]\n  theta'\n  ^",
    ),
    case(
        "heading unknown",
        &[("heading = \"phi\"", "heading = \"phy\"")],
        "4:11: the heading phy is no coordinate of its own; did you mean \"phi\"? coordinates: x, y, phi, theta",
    ),
    case(
        "heading alone",
        &[(
            "[[vehicle.coordinates]]\nname = \"x\"\nunit = \"m\"\nmeaning = \"position along x\"\n[[vehicle.coordinates]]\nname = \"y\"\nunit = \"m\"\nmeaning = \"position along y\"\n[[vehicle.coordinates]]\nname = \"phi\"\nunit = \"rad\"\nmeaning = \"heading\"\n[[vehicle.coordinates]]\nname = \"theta\"\nunit = \"rad\"\nmeaning = \"angle of the drum\"\n",
            "",
        )],
        "4:11: the heading phi is no coordinate of its own; coordinates: none",
    ),
    case(
        "trailer of a rope",
        &[("[[vehicle.wheels]]", "[[vehicle.trailers]]\nname = \"a\"\nlength = \"b\"\n[[vehicle.wheels]]")],
        "35:8: a vehicle with coordinates of its own has no trailer; remove it, or write the constraint of its axle",
    ),
    case(
        "undetermined",
        &[(
            "[[vehicle.constraints]]\nname = \"rope\"\ntype = { id = \"cable\", letter = \"C\", form = \"pays' - (1 - e)*drum*turns'\", creep = \"slip of the rope\" }\ncreep = \"e_rc\"\nslots = { \"pays'\" = \"cos(phi)*x' + sin(phi)*y'\", drum = \"b\", \"turns'\" = \"theta'\" }\n",
            "",
        )],
        "2:6: the constraints of rope-cart do not determine its motion by themselves: nothing gives its rate y'; give a wheel a rate or a steering that an input defines, log the yaw rate and define \"phi'\" from it, or write instead = \"what to use\" to have the vehicle described only",
    ),
    case(
        "contradiction",
        &[(
            "[[vehicle.constraints]]",
            "[[vehicle.constraints]]\nname = \"chain\"\ntype = \"rolling\"\ncreep = \"e_b\"\nslots = { \"pi'\" = \"x'\", sigma = \"b\", \"q'\" = \"theta'\" }\n[[vehicle.constraints]]",
        )],
        "43:8: the constraints of rope-cart contradict each other for general inputs: what the others give breaks rope; take a direction or a rate away, set a wheel where it can roll with the others, or let it turn freely by naming a steering without a definition",
    ),
    case(
        "no wheel nor constraint",
        &[(
            "[[vehicle.wheels]]\nname = \"axle\"\ntraverse_creep = \"e_tc\"\n[[vehicle.constraints]]\nname = \"rope\"\ntype = { id = \"cable\", letter = \"C\", form = \"pays' - (1 - e)*drum*turns'\", creep = \"slip of the rope\" }\ncreep = \"e_rc\"\nslots = { \"pays'\" = \"cos(phi)*x' + sin(phi)*y'\", drum = \"b\", \"turns'\" = \"theta'\" }\n",
            "",
        )],
        "1:1: key \"wheels\" in [[vehicle]] is missing; write [[vehicle.wheels]], with double brackets, before each wheel",
    ),
];

/// Models of the bus of the examples that are refused, with the message.
pub const BAD_MODELS: &[Case] = &[
    case(
        "unknown vehicle",
        &[("\"articulated-bus\"", "\"articulated-buss\"")],
        "model.toml:1:11: unknown vehicle \"articulated-buss\"; if it is your own, give its file with --vehicles, or name it here: vehicles = \"FILE.toml\"; did you mean \"articulated-bus\"? known vehicles: unicycle, differential-drive, car, four-wheel-car, tricycle, disk, sleigh, hopper, differential-drive-castor, synchro-drive, skid-steer, four-wheel-steering, tracked, mecanum, articulated-bus, pusher-bus, … (17 in all)",
    ),
    case(
        "no file named",
        &[("vehicles = \"bus.toml\"               # where it is described, from the folder of this file\n", "")],
        "model.toml:1:11: unknown vehicle \"articulated-bus\"; if it is your own, give its file with --vehicles, or name it here: vehicles = \"FILE.toml\"; known vehicles: unicycle, differential-drive, car, four-wheel-car, tricycle, disk, sleigh, hopper, differential-drive-castor, synchro-drive, skid-steer, four-wheel-steering, tracked, mecanum, n-trailer",
    ),
    case(
        "no such file",
        &[("\"bus.toml\"", "\"buss.toml\"")],
        "model.toml:2:12: no file of vehicles is at \"buss.toml\"; give its path from the folder of the model file",
    ),
    case(
        "a folder",
        &[("\"bus.toml\"", "\"folder\"")],
        "model.toml:2:12: no file of vehicles is at \"folder\"; give its path from the folder of the model file",
    ),
    case(
        "a number",
        &[("vehicles = \"bus.toml\"", "vehicles = 3")],
        "model.toml:2:12: vehicles must be a text, not a number; write vehicles = \"…\"",
    ),
    case(
        "a broken file",
        &[("\"bus.toml\"", "\"broken.toml\"")],
        "broken.toml:1:1: key \"id\" in [[vehicle]] is missing; write id = \"my-robot\"",
    ),
    case(
        "parameter of another",
        &[("rear_length", "trailer_length")],
        "model.toml:7:1: unknown key \"trailer_length\" in [parameters]; known keys: joint_offset, rear_length, wheel_radius, wheelbase",
    ),
    case(
        "parameter left out",
        &[("rear_length = 5.1\n", "")],
        "model.toml:3:1: key \"rear_length\" in [parameters] is missing; write rear_length = … under [parameters], in SI units",
    ),
    case(
        "negative length",
        &[("rear_length = 5.1", "rear_length = -5.1")],
        "model.toml:7:15: rear_length = -5.1 is out of range; it must be greater than zero, in SI units",
    ),
    case(
        "towed trailers",
        &[("[columns]", "trailer_lengths = [3.0]\n[columns]")],
        "model.toml:8:1: unknown key \"trailer_lengths\" in [parameters]; known keys: joint_offset, rear_length, wheel_radius, wheelbase",
    ),
    case(
        "two headings",
        &[("[\"phi_rear\"]", "[\"phi_rear\", \"phi_last\"]")],
        "model.toml:11:20: trailer_headings has 2 elements, but 1 are needed; give one per trailer, the one nearest the tractor first",
    ),
    case(
        "initial heading",
        &[("[columns]", "[initial]\nx = 0\ny = 0\nheading = 0\ntrailer_headings = []\n[columns]")],
        "model.toml:12:20: trailer_headings has 0 elements, but 1 are needed; give one per trailer, the one nearest the tractor first",
    ),
    case(
        "trailer out of range",
        &[("[columns]", "[[effects]]\nid = \"trailer-length\"\ntrailer = 2\nscale = 0.1\n[columns]")],
        "model.toml:10:11: trailer = 2 is out of range; it must lie within 1 to 1",
    ),
    case(
        "key misspelt",
        &[("vehicles = ", "vehicle_file = ")],
        "model.toml:1:11: unknown vehicle \"articulated-bus\"; if it is your own, give its file with --vehicles, or name it here: vehicles = \"FILE.toml\"; known vehicles: unicycle, differential-drive, car, four-wheel-car, tricycle, disk, sleigh, hopper, differential-drive-castor, synchro-drive, skid-steer, four-wheel-steering, tracked, mecanum, n-trailer",
    ),
    case(
        "column of no input",
        &[("time = \"t\"", "yaw_rate = \"t\"")],
        "model.toml:9:1: unknown key \"yaw_rate\" in [columns]; known keys: time, truth_time, x, y, position, heading, sigma_x, sigma_y, sigma_heading, trailer_headings, steering_angle, wheel_rate, speed",
    ),
];
