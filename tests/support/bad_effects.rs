//! Files of effects that are refused, and what must be said about each.

/// A good file of effects.
pub const GOOD: &str = "\
[[effect]]
id = \"my-slip\"
where = \"traverse constraint\"
says = \"it slides\"
needs = [\"wheel_rate\"]
[effect.parameters.q]
unit = \"m*s\"
range = [-10.0, 10.0]
size = 0.03
[effect.parameters.tau]
unit = \"s\"
range = [1e-3, 100.0]
size = 1.0
start = [0.5]
positive = true
[effect.states.u]
unit = \"m/s\"
rate = \"(q*phi'^2 - u)/tau\"
[effect.changes]
v_t = \"it - u\"
";

/// What is done to the good file.
pub struct Case {
    pub name: &'static str,
    /// Pieces of the text and what stands in their place.
    pub edits: &'static [(&'static str, &'static str)],
    /// The message after the name of the file; up to "…" where a long list follows.
    pub expect: &'static str,
}

const fn case(name: &'static str, edits: &'static [(&'static str, &'static str)], expect: &'static str) -> Case {
    Case { name, edits, expect }
}

/// Six effects that each write the definition four times.
pub const GROWING: &str = "\
[[effect]]
id = \"grow-0\"
where = \"a\"
says = \"b\"
[effect.parameters.c]
unit = \"1\"
range = [-1, 1]
size = 0.1
[effect.changes]
v_t = \"it + c*(it + it - it + it)\"
[[effect]]
id = \"grow-1\"
where = \"a\"
says = \"b\"
[effect.parameters.c]
unit = \"1\"
range = [-1, 1]
size = 0.1
[effect.changes]
v_t = \"it + c*(it + it - it + it)\"
[[effect]]
id = \"grow-2\"
where = \"a\"
says = \"b\"
[effect.parameters.c]
unit = \"1\"
range = [-1, 1]
size = 0.1
[effect.changes]
v_t = \"it + c*(it + it - it + it)\"
[[effect]]
id = \"grow-3\"
where = \"a\"
says = \"b\"
[effect.parameters.c]
unit = \"1\"
range = [-1, 1]
size = 0.1
[effect.changes]
v_t = \"it + c*(it + it - it + it)\"
[[effect]]
id = \"grow-4\"
where = \"a\"
says = \"b\"
[effect.parameters.c]
unit = \"1\"
range = [-1, 1]
size = 0.1
[effect.changes]
v_t = \"it + c*(it + it - it + it)\"
[[effect]]
id = \"grow-5\"
where = \"a\"
says = \"b\"
[effect.parameters.c]
unit = \"1\"
range = [-1, 1]
size = 0.1
[effect.changes]
v_t = \"it + c*(it + it - it + it)\"
";

/// Every way to be refused.
pub const BAD: &[Case] = &[
    case(
        "not TOML",
        &[("[[effect]]\nid = \"my-slip\"", "[[effect]\nid = \"my-slip\"")],
        "1:10: is not valid TOML: unclosed array table, expected `]`; a file of effects holds [[effect]], lines like id = \"my-creep\", and below [effect.changes] lines like \"phi'\" = \"it + bias\", where a name with ' or * stands in quotes",
    ),
    case(
        "unquoted name",
        &[("v_t = \"it - u\"", "phi' = \"it - u\"")],
        "20:4: is not valid TOML: invalid unquoted key, expected letters, numbers, `-`, `_`; a file of effects holds [[effect]], lines like id = \"my-creep\", and below [effect.changes] lines like \"phi'\" = \"it + bias\", where a name with ' or * stands in quotes",
    ),
    case(
        "unknown key at the top",
        &[("[[effect]]\nid", "author = \"me\"\n[[effect]]\nid")],
        "1:1: unknown key \"author\"; known keys: effect",
    ),
    case(
        "single brackets",
        &[("[[effect]]", "[effect]")],
        "1:1: effect must be a list, not a table; write [[effect]], with double brackets, before each effect",
    ),
    case(
        "unknown key",
        &[("says = \"it", "say = \"it")],
        "4:1: unknown key \"say\" in [[effect]]; did you mean \"says\"? known keys: id, where, says, source, per_trailer, needs, parameters, states, changes",
    ),
    case(
        "missing key",
        &[("where = \"traverse constraint\"\n", "")],
        "1:1: key \"where\" in [[effect]] is missing; write where = \"traverse constraint\"",
    ),
    case(
        "missing parameters key",
        &[("size = 0.03\n", "")],
        "6:1: key \"size\" in [effect.parameters.q] is missing; write size = 0.03, a plausible magnitude",
    ),
    case(
        "unknown parameter key",
        &[("size = 0.03", "sizes = 0.03")],
        "9:1: unknown key \"sizes\" in [effect.parameters.q]; did you mean \"size\"? known keys: unit, range, size, start, positive, periodic",
    ),
    case(
        "id with underscore",
        &[("\"my-slip\"", "\"my_slip\"")],
        "2:6: \"my_slip\" cannot be the id of an effect; begin with a letter, go on with letters, digits and hyphens, at most 60",
    ),
    case(
        "id of the sensor",
        &[("\"my-slip\"", "\"sensor\"")],
        "2:6: \"sensor\" cannot be the id of an effect; begin with a letter, go on with letters, digits and hyphens, at most 60",
    ),
    case(
        "id of the library",
        &[("\"my-slip\"", "\"cornering-creep\"")],
        "2:6: the library has an effect \"cornering-creep\"; give yours another id",
    ),
    case(
        "id beside a trailer's",
        &[("\"my-slip\"", "\"trailer-length-2\"")],
        "2:6: \"trailer-length-2\" and \"trailer-length\" on a trailer would share the names of their parameters; give yours another id",
    ),
    case(
        "id twice",
        &[(
            "v_t = \"it - u\"\n",
            "v_t = \"it - u\"\n[[effect]]\nid = \"my-slip\"\nwhere = \"a\"\nsays = \"b\"\n[effect.parameters.c]\nunit = \"1\"\nrange = [-1, 1]\nsize = 0.1\n[effect.changes]\ne_tc = \"it + c\"\n",
        )],
        "22:6: two effects are called \"my-slip\"; give one another id",
    ),
    case(
        "malformed formula",
        &[("\"it - u\"", "\"it - * u\"")],
        "20:13: expected a number, a name or \"(\", found \"*\"\n  it - * u\n       ^",
    ),
    case(
        "malformed formula, escaped",
        &[("\"it - u\"", "\"it \\u002d * u\"")],
        "20:18: expected a number, a name or \"(\", found \"*\"\n  it - * u\n       ^",
    ),
    case(
        "malformed rate",
        &[("rate = \"(q*", "rate = \"(q**")],
        "18:12: expected a number, a name or \"(\", found \"*\"\n  (q**phi'^2 - u)/tau\n     ^",
    ),
    case(
        "unknown function",
        &[("\"it - u\"", "\"it - sinh(u)\"")],
        "20:13: no function is called \"sinh\"; known are sin, cos, tan, cot, asin, acos, atan, tanh, exp, ln, sqrt, abs, sign\n  it - sinh(u)\n       ^",
    ),
    case(
        "bracket left open",
        &[("\"it - u\"", "\"it - (u\"")],
        "20:15: expected \")\", found the end\n  it - (u\n         ^",
    ),
    case(
        "unknown name",
        &[("\"it - u\"", "\"it - u*v_f/v_l\"")],
        "20:15: no vehicle knows the name \"v_f\"; did you mean \"v_d\"? …",
    ),
    case(
        "unknown name in a rate",
        &[("phi'^2", "psi'^2")],
        "18:12: no vehicle knows the name \"psi'\"; did you mean \"phi'\"? …",
    ),
    case(
        "it in a rate",
        &[("- u)/tau", "- it)/tau")],
        "18:21: a rate has no `it`; `it` is a definition as it was, in a formula below [effect.changes]\n  (q*phi'^2 - it)/tau\n              ^",
    ),
    case(
        "unknown definition",
        &[("v_t = \"it", "v_q = \"it")],
        "20:1: no vehicle defines \"v_q\"; did you mean \"v_d\"? …",
    ),
    case(
        "no definition at all",
        &[("v_t = \"it", "\"2v\" = \"it")],
        "20:1: \"2v\" is no name of a definition; write a name such as v_t, \"phi'\", \"r*\" or, with per_trailer, \"d_{trailer}\"",
    ),
    case(
        "trailer without per_trailer",
        &[("v_t = \"it", "\"e_tc_{trailer}\" = \"it")],
        "20:1: \"e_tc_{trailer}\" speaks of a trailer; write per_trailer = true below the id",
    ),
    case(
        "per_trailer without trailer",
        &[("says = ", "per_trailer = true\nsays = ")],
        "20:1: the effect is per_trailer, but changes the same on every trailer; write {trailer} in a name, such as \"e_tc_{trailer}\", or remove per_trailer",
    ),
    case(
        "trailer in a formula",
        &[("\"it - u\"", "\"it - u*v_{trailer}\"")],
        "20:17: unexpected character '{'; a formula holds numbers, names, + - * / ^ and parentheses\n  it - u*v_{trailer}\n           ^",
    ),
    case(
        "unknown input",
        &[("[\"wheel_rate\"]", "[\"wheel_rat\"]")],
        "5:10: no vehicle has the input \"wheel_rat\"; did you mean \"wheel_rate\"? inputs: wheel_rate, steering_angle, wheel_rate_left, wheel_rate_right, yaw_rate, wheel_rate_front_left, wheel_rate_front_right, wheel_rate_rear_left, wheel_rate_rear_right",
    ),
    case(
        "unit of a change",
        &[("unit = \"m*s\"", "unit = \"m\"")],
        "18:9: q*phi'^2 - u has no unit on unicycle: q*phi'^2 is in m/s^2, u is in m/s; add only what has one unit; functions take and give numbers\n  (q*phi'^2 - u)/tau\n  ^",
    ),
    case(
        "unit of a formula",
        &[("\"it - u\"", "\"it - u*phi'\"")],
        "20:8: it - u*phi' has no unit on unicycle: it is in m/s, u*phi' is in m/s^2; add only what has one unit; functions take and give numbers\n  it - u*phi'\n  ^",
    ),
    case(
        "mixed units",
        &[("\"it - u\"", "\"it - u + tau\"")],
        "20:8: it - u + tau has no unit on unicycle: it - u is in m/s, tau is in s; add only what has one unit; functions take and give numbers\n  it - u + tau\n  ^",
    ),
    case(
        "sine of a length",
        &[("\"it - u\"", "\"it - u*sin(y)\"")],
        "20:8: sin(y) has no unit on unicycle: y is in m; add only what has one unit; functions take and give numbers\n  it - u*sin(y)\n  ^",
    ),
    case(
        "unit that is none",
        &[("unit = \"m*s\"", "unit = \"furlong\"")],
        "7:8: \"furlong\" is no unit; write m, s, kg, rad or 1 with * / ^, such as \"s^2/m\"",
    ),
    case(
        "unit of a state",
        &[("[effect.states.u]\nunit = \"m/s\"", "[effect.states.u]\nunit = \"\"")],
        "17:8: unit is blank; write unit = \"…\"",
    ),
    case(
        "range without 0",
        &[("[-10.0, 10.0]", "[1.0, 10.0]")],
        "8:9: range from 1.0 to 10.0 lacks 0, where the effect vanishes; widen it, or write positive = true if 0 has no meaning",
    ),
    case(
        "range upside down",
        &[("[-10.0, 10.0]", "[10.0, -10.0]")],
        "8:9: range from 10.0 to -10.0 is empty; write the smaller number first",
    ),
    case(
        "range of three",
        &[("[-10.0, 10.0]", "[-10.0, 0.0, 10.0]")],
        "8:9: range needs 2 numbers; write range = [-1.0, 1.0], what may stand in a model file",
    ),
    case(
        "infinite range",
        &[("[-10.0, 10.0]", "[-inf, 10.0]")],
        "8:10: range[1] must be a finite number; write range[1] = 0.5",
    ),
    case(
        "positive below 0",
        &[("[1e-3, 100.0]", "[-1.0, 100.0]")],
        "12:9: range of a positive parameter begins at -1.0; begin it at 0 or above",
    ),
    case(
        "size of 0",
        &[("size = 0.03", "size = 0")],
        "9:8: size = 0.0 is out of range; it must be greater than zero, in SI units",
    ),
    case(
        "size beyond",
        &[("size = 0.03", "size = 30.0")],
        "9:8: size = 30.0 lies outside of the range -10.0 to 10.0; give a plausible magnitude within the range",
    ),
    case(
        "start beyond",
        &[("size = 0.03", "size = 0.03\nstart = [20.0]")],
        "10:9: start 20.0 lies outside of the range -10.0 to 10.0; start within the range",
    ),
    case(
        "positive start left out",
        &[("start = [0.5]\n", "")],
        "10:1: a fit of a positive parameter cannot start at 0.0; write start = [0.1], a number above 0",
    ),
    case("no starts", &[("start = [0.5]", "start = []")], "14:9: start has 0 numbers; give 1 to 8"),
    case(
        "periodic length",
        &[("size = 0.03", "size = 0.03\nperiodic = true")],
        "7:8: a periodic parameter is an angle, not of unit m*s; write unit = \"rad\", or remove periodic",
    ),
    case(
        "periodic and positive",
        &[("positive = true", "positive = true\nperiodic = true")],
        "16:12: a parameter cannot be both positive and periodic; remove one of the two",
    ),
    case(
        "too short a turn",
        &[("unit = \"m*s\"\nrange = [-10.0, 10.0]", "periodic = true\nunit = \"rad\"\nrange = [-1.0, 1.0]")],
        "9:9: the range of a periodic parameter must hold a whole turn; write range = [-3.2, 3.2]",
    ),
    case(
        "word for a flag",
        &[("positive = true", "positive = \"yes\"")],
        "15:12: positive must be true or false, not a text; write positive = true",
    ),
    case(
        "name of a function",
        &[(".q]", ".sin]")],
        "6:20: \"sin\" cannot name a parameter or a state; begin with a letter, go on with letters, digits and _; functions, it, id and trailer are taken",
    ),
    case(
        "name that is taken",
        &[(".q]", ".it]")],
        "6:20: \"it\" cannot name a parameter or a state; begin with a letter, go on with letters, digits and _; functions, it, id and trailer are taken",
    ),
    case(
        "name with a hyphen",
        &[(".q]", ".q-2]")],
        "6:20: \"q-2\" cannot name a parameter or a state; begin with a letter, go on with letters, digits and _; functions, it, id and trailer are taken",
    ),
    case(
        "parameter and state",
        &[(".q]", ".u]")],
        "16:16: u is both a parameter and a state; give one of them another name",
    ),
    case(
        "idle parameter",
        &[("(q*phi'^2 - u)", "(v_t - u)")],
        "6:20: q has no say in what the effect changes; use it in a formula below [effect.changes], or remove it",
    ),
    case(
        "idle state",
        &[("\"it - u\"", "\"it - q*phi'^2/tau*tau\"")],
        "16:16: u has no say in what the effect changes; use it in a formula below [effect.changes], or remove it",
    ),
    case(
        "nothing changed",
        &[("v_t = \"it - u\"\n", "")],
        "19:1: the effect changes nothing; write [effect.changes] and below it lines like v_t = \"it + c*v_l\"",
    ),
    case(
        "no vehicle",
        &[("v_t = \"it - u\"", "v_t = \"it - u\"\ndelta = \"it + q*phi'/v_l/tau\"")],
        "2:6: the effect \"my-slip\" applies to no vehicle: formulas that use each other in a circle on car, four-wheel-car, tricycle and 3 more; no input wheel_rate on differential-drive, sleigh, differential-drive-castor and 3 more; no definition of delta on unicycle, unicycle logged by speed, disk and 1 more; change only names that one vehicle defines, in formulas of names it knows; see `creepage vehicles`",
    ),
    case(
        "not neutral",
        &[("\"it - u\"", "\"it - u + 0.1*v_l\"")],
        "20:8: the effect still changes v_t where the parameters are q = 0; write it so that 0 means no effect, such as it + c*v_l or it*(1 + scale)\n  it - u + 0.1*v_l\n  ^",
    ),
    case(
        "not neutral in part",
        &[("\"it - u\"", "\"it - u + (phi' + abs(phi'))*r\"")],
        "20:8: the effect still changes v_t where the parameters are q = 0; write it so that 0 means no effect, such as it + c*v_l or it*(1 + scale)\n  it - u + (phi' + abs(phi'))*r\n  ^",
    ),
    case(
        "rate not neutral",
        &[("(q*phi'^2 - u)", "(v_l + q*phi'^2 - u)")],
        "18:9: the state u leaves 0 where the parameters are q = 0; write its rate so that 0 means no effect, such as (c*v_l - u)/tau\n  (v_l + q*phi'^2 - u)/tau\n  ^",
    ),
    case(
        "undefined at neutral",
        &[("\"it - u\"", "\"it - u + q^2/q*phi'^2\"")],
        "20:8: the formula has no value where the parameters are q = 0 and speeds are of either sign; avoid a division by a parameter that may be 0, write abs(v_l) below a root, or use positive = true\n  it - u + q^2/q*phi'^2\n  ^",
    ),
    case(
        "root of a speed",
        &[("\"it - u\"", "\"it - u + q*phi'^2*sqrt(v_l)/sqrt(v_l)\"")],
        "20:8: the formula has no value where the parameters are q = 0 and speeds are of either sign; avoid a division by a parameter that may be 0, write abs(v_l) below a root, or use positive = true\n  it - u + q*phi'^2*sqrt(v_l)/sqrt(v_l)\n  ^",
    ),
    case(
        "sensor that sees inputs",
        &[("v_t = \"it - u\"", "v_t = \"it - u\"\nlever_a = \"it + q*phi'*0 + q*theta'\"")],
        "21:12: what the sensor measures would depend on wheel_rate on unicycle; it may depend on the pose and parameters only\n  it + q*phi'*0 + q*theta'\n  ^",
    ),
    case(
        "delay that moves",
        &[("v_t = \"it - u\"", "v_t = \"it - u\"\ndelay = \"it + q/r*cos(phi)\"")],
        "21:10: the delay of the inputs would depend on phi on unicycle; it may depend on parameters only\n  it + q/r*cos(phi)\n  ^",
    ),
    case(
        "towers",
        &[("\"it - u\"", "\"it - ((u^8)^8)^8\"")],
        "20:8: the formula has a product of more than 64 factors; write smaller powers\n  it - ((u^8)^8)^8\n  ^",
    ),
    case(
        "change that is a number",
        &[("v_t = \"it - u\"", "v_t = 3")],
        "20:7: v_t must be a text, not a number; write v_t = \"…\"",
    ),
    case(
        "dotted key",
        &[("v_t = \"it - u\"", "v.t = \"it - u\"")],
        "20:1: v must be a text, not a table; write v = \"…\"",
    ),
    case(
        "name of a vehicle",
        &[("states.u]", "states.r]"), ("- u)", "- r)"), ("it - u", "it - r")],
        "16:16: r is also a name of the vehicle unicycle; give the parameter or state another name",
    ),
    case(
        "circle",
        &[("it - u\"", "it - u + q*x'/tau/v_l*phi'*tau\"")],
        "2:6: the effect \"my-slip\" applies to no vehicle: formulas that use each other in a circle on unicycle, unicycle logged by speed, car and 6 more; no input wheel_rate on differential-drive, sleigh, differential-drive-castor and 3 more; v_t cannot change on disk, synchro-drive, n-trailer behind synchro-drive; change only names that one vehicle defines, in formulas of names it knows; see `creepage vehicles`",
    ),
    case(
        "no influence",
        &[("[\"wheel_rate\"]", "[\"wheel_rate_left\"]"), ("v_t = \"it - u\"", "\"theta_c'\" = \"it + u/r_c\"")],
        "2:6: the effect \"my-slip\" applies to no vehicle: no input wheel_rate_left on unicycle, unicycle logged by speed, car and 11 more; no definition of theta_c' on differential-drive, n-trailer behind differential-drive; no influence on motion and sensor on differential-drive-castor, n-trailer behind differential-drive-castor; change only names that one vehicle defines, in formulas of names it knows; see `creepage vehicles`",
    ),
    case(
        "no vehicle has both",
        &[("it - u", "it - u*a/L")],
        "2:6: the effect \"my-slip\" applies to no vehicle: no a on car, four-wheel-car, tricycle and 3 more; no input wheel_rate on differential-drive, sleigh, differential-drive-castor and 3 more; no L on unicycle, unicycle logged by speed, n-trailer behind unicycle; change only names that one vehicle defines, in formulas of names it knows; see `creepage vehicles`",
    ),
    case(
        "long formula",
        &[(
            "it - u",
            "it - u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u + 0*u",
        )],
        "20:7: v_t has 606 characters, and 400 are the most; write a shorter formula",
    ),
    case(
        "too many starts",
        &[("size = 0.03", "size = 0.03\nstart = [1, 2, 3, 4, 5, 6]"), ("[0.5]", "[1, 2, 3, 4, 5, 6]")],
        "6:9: the starts of the parameters have 36 combinations; leave at most 32; each costs a pass over the data",
    ),
    case(
        "growth",
        &[(GOOD, GROWING)],
        "40:8: with all effects together the formula of v_t grows beyond all bounds on unicycle; write `it` once in a formula, use smaller powers, or put fewer effects on one name\n  it + c*(it + it - it + it)\n  ^",
    ),
];
