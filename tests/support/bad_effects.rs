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

pub const fn case(name: &'static str, edits: &'static [(&'static str, &'static str)], expect: &'static str) -> Case {
    Case { name, edits, expect }
}

/// Keys and values that are refused.
pub const BAD_FILES: &[Case] = &[
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
        "4:1: unknown key \"say\" in [[effect]]; did you mean \"says\"? known keys: id, where, says, plain, source, per_trailer, per_contact, basic, walks, needs, limit, parameters, states, changes",
    ),
    case(
        "sentence with an unknown name",
        &[("says = \"it", "plain = \"It slides {abs(z) | m/s}.\"\nsays = \"it")],
        "4:9: the sentence has a z, which is no parameter of the effect; it knows q, tau, speed and turning",
    ),
    case(
        "sentence without a unit",
        &[("says = \"it", "plain = \"It slides {q}.\"\nsays = \"it")],
        "4:9: the sentence cannot be read: {q} has no unit; write {formula | unit} for a number, {formula ? words : words} for words that follow its sign",
    ),
    case(
        "unknown limit",
        &[("says = \"it", "limit = \"load-dependent-crep\"\nsays = \"it")],
        "4:9: unknown effect \"load-dependent-crep\"; did you mean \"load-dependent-creep\"? …",
    ),
    case(
        "limit with other parameters",
        &[("says = \"it", "limit = \"load-dependent-creep\"\nsays = \"it")],
        "4:9: \"load-dependent-creep\" has other parameters, or another place on trailers; an effect begins where its limit ends: give both the same parameters in the same order",
    ),
    case(
        "limit of a limit",
        &[("says = \"it", "limit = \"rocard-creep\"\nsays = \"it")],
        "4:9: \"rocard-creep\" has a limit of its own; name an effect without states that is asked for first",
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
        "unknown input",
        &[("[\"wheel_rate\"]", "[\"wheel_rat\"]")],
        "5:10: no vehicle has the input \"wheel_rat\"; did you mean \"wheel_rate\"? inputs: wheel_rate, steering_angle, wheel_rate_left, wheel_rate_right, wheel_rate_front_left, wheel_rate_front_right, wheel_rate_rear_left, wheel_rate_rear_right, yaw_rate, steering_angle_rear, leg_angle_rate, leg_length",
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
        "half a turn too short",
        &[("unit = \"m*s\"\nrange = [-10.0, 10.0]", "periodic = true\nunit = \"rad\"\nrange = [-3.2, 3.1]")],
        "9:9: the range of a periodic parameter must hold a whole turn; write range = [-3.2, 3.2]",
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
        "name with a letter of another alphabet",
        &[(".q]", ".\"qλ\"]")],
        "6:20: \"qλ\" cannot name a parameter or a state; begin with a letter, go on with letters, digits and _; functions, it, id and trailer are taken",
    ),
    case(
        "name of two words",
        &[(".q]", ".\"q r\"]")],
        "6:20: \"q r\" cannot name a parameter or a state; begin with a letter, go on with letters, digits and _; functions, it, id and trailer are taken",
    ),
    case(
        "name with two underscores",
        &[(".q]", ".q__r]")],
        "6:20: \"q__r\" cannot name a parameter or a state; begin with a letter, go on with letters, digits and _; functions, it, id and trailer are taken",
    ),
    case(
        "name with an underscore at its end",
        &[(".q]", ".q_]")],
        "6:20: \"q_\" cannot name a parameter or a state; begin with a letter, go on with letters, digits and _; functions, it, id and trailer are taken",
    ),
    case(
        "parameter and state",
        &[(".q]", ".u]")],
        "16:16: u is both a parameter and a state; give one of them another name",
    ),
    case(
        "nothing changed",
        &[("v_t = \"it - u\"\n", "")],
        "19:1: the effect changes nothing; write [effect.changes] and below it lines like v_t = \"it + c*v_l\"",
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
        "too many starts",
        &[("size = 0.03", "size = 0.03\nstart = [1, 2, 3, 4, 5, 6]"), ("[0.5]", "[1, 2, 3, 4, 5, 6]")],
        "6:9: the starts of the parameters have 36 combinations; leave at most 32; each costs a pass over the data",
    ),
];
