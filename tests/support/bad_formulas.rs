//! Formulas of effects that are refused, and what must be said about each.

use super::bad_effects::{Case, GOOD, case};

/// Six effects that each write the definition four times.
const GROWING: &str = "\
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

/// Names, formulas and units that are refused.
pub const BAD_FORMULAS: &[Case] = &[
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
        "20:13: no function is called \"sinh\"; known are sin, cos, tan, cot, asin, acos, atan, tanh, exp, ln, sqrt, abs, sign, heaviside\n  it - sinh(u)\n       ^",
    ),
    case(
        "bracket left open",
        &[("\"it - u\"", "\"it - (u\"")],
        "20:15: expected \")\", found the end\n  it - (u\n         ^",
    ),
    case(
        "unknown name",
        &[("\"it - u\"", "\"it - u*v_f/v_l\"")],
        "20:15: no vehicle knows the name \"v_f\"; did you mean \"v_l\"? …",
    ),
    case(
        "unknown name in a rate",
        &[("phi'^2", "chi'^2")],
        "18:12: no vehicle knows the name \"chi'\"; did you mean \"phi'\"? …",
    ),
    case(
        "it in a rate",
        &[("- u)/tau", "- it)/tau")],
        "18:21: a rate has no `it`; `it` is a definition as it was, in a formula below [effect.changes]\n  (q*phi'^2 - it)/tau\n              ^",
    ),
    case(
        "unknown definition",
        &[("v_t = \"it", "v_q = \"it")],
        "20:1: no vehicle defines \"v_q\"; did you mean \"v_l\"? …",
    ),
    case(
        "trailer in a formula",
        &[("\"it - u\"", "\"it - u*v_{trailer}\"")],
        "20:17: unexpected character '{'; a formula holds numbers, names, + - * / ^ and parentheses\n  it - u*v_{trailer}\n           ^",
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
        "no vehicle",
        &[("v_t = \"it - u\"", "v_t = \"it - u\"\ndelta = \"it + q*phi'/v_l/tau\"")],
        "2:6: the effect \"my-slip\" applies to no vehicle: formulas that use each other in a circle on car, car logged by speed, four-wheel-car and 8 more; no input wheel_rate on differential-drive, sleigh, hopper and 8 more; no definition of delta on unicycle, unicycle logged by speed, disk and 2 more; change only names that one vehicle defines, in formulas of names it knows; see `creepage vehicles`",
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
        "name of a vehicle",
        &[("states.u]", "states.r]"), ("- u)", "- r)"), ("it - u", "it - r")],
        "16:16: r is also a name of the vehicle unicycle; give the parameter or state another name",
    ),
    case(
        "circle",
        &[("it - u\"", "it - u + q*x'/tau/v_l*phi'*tau\"")],
        "2:6: the effect \"my-slip\" applies to no vehicle: formulas that use each other in a circle on unicycle, unicycle logged by speed, car and 11 more; no input wheel_rate on differential-drive, sleigh, hopper and 8 more; v_t cannot change on disk, disk logged by speed, synchro-drive and 2 more; change only names that one vehicle defines, in formulas of names it knows; see `creepage vehicles`",
    ),
    case(
        "no influence",
        &[("[\"wheel_rate\"]", "[\"wheel_rate_left\"]"), ("v_t = \"it - u\"", "\"theta_c'\" = \"it + u/r_c\"")],
        "2:6: the effect \"my-slip\" applies to no vehicle: no input wheel_rate_left on unicycle, unicycle logged by speed, car and 21 more; no definition of theta_c' on differential-drive, tracked, n-trailer behind differential-drive and 1 more; no influence on motion and sensor on differential-drive-castor, n-trailer behind differential-drive-castor; change only names that one vehicle defines, in formulas of names it knows; see `creepage vehicles`",
    ),
    case(
        "no vehicle has both",
        &[("it - u", "it - u*a/L")],
        "2:6: the effect \"my-slip\" applies to no vehicle: no a on car, car logged by speed, four-wheel-car and 8 more; no input wheel_rate on differential-drive, sleigh, hopper and 8 more; v_t cannot change on disk, disk logged by speed, synchro-drive and 2 more; change only names that one vehicle defines, in formulas of names it knows; see `creepage vehicles`",
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
        "growth",
        &[(GOOD, GROWING)],
        "40:8: with all effects together the formula of v_t grows beyond all bounds on unicycle; write `it` once in a formula, use smaller powers, or put fewer effects on one name\n  it + c*(it + it - it + it)\n  ^",
    ),
];
