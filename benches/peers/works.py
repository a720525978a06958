"""The work, written as a user of each library would."""

import ctypes
import importlib.metadata
import pathlib
import subprocess
import tempfile
import time

import numpy as np

R, A, B, J = 0.5, 0.5, 1.25, 1.0
WHEEL_END = 2 * np.pi
TRAIN_END = 10.0
TRAILERS = 10
MANY = 4096
TOLERANCES = {"rtol": 1e-10, "atol": 1e-12}


def version(package):
    return importlib.metadata.version(package)


def seconds(run, units=1, least=0.2):
    """Seconds of processor time a unit of work, over at least `least` seconds."""

    def timed():
        count, start = 0, time.process_time()
        while (spent := time.process_time() - start) < least:
            run()
            count += 1
        return spent / count / units

    return timed


def wheel_rates(np_, t, z, e_rc, e_tc):
    c = R * R * (1 - e_rc) ** 2 * (1 + e_tc**2) + J
    u = 2 - 0.05 * t
    scale = np_.sqrt((A + B * u * u) / (A + c * u * u))
    forward = R * (1 - e_rc) * scale * u
    left = e_tc * forward
    s, k = np_.sin(z[2]), np_.cos(z[2])
    return [forward * k - left * s, forward * s + left * k, scale]


def train_rates(np_, t, z, r):
    v = 2 * r
    rates = [v * np_.cos(z[2]), v * np_.sin(z[2]), 0.5 * np_.sin(t)]
    for i in range(3, 3 + TRAILERS):
        rates.append(v * np_.sin(z[i - 1] - z[i]))
        v = v * np_.cos(z[i - 1] - z[i])
    return rates


def scipy_runs():
    from scipy.integrate import solve_ivp

    def wheel():
        solve_ivp(lambda t, z: wheel_rates(np, t, z, 0.1, 0.2), (0, WHEEL_END), np.zeros(3), "DOP853", **TOLERANCES)

    def train():
        start = np.zeros(3 + TRAILERS)
        start[2] = 0.3
        solve_ivp(lambda t, z: train_rates(np, t, z, 0.5), (0, TRAIN_END), start, "DOP853", **TOLERANCES)

    return wheel, train


def scipy_fit():
    """e_rc and e_tc from 1000 samples of heading, wheel rate, x' and y', with exact derivatives."""
    from scipy.optimize import least_squares

    i = np.arange(1000)
    t = 0.02 * i
    phi, u = 0.3 * t + 0.4 * np.sin(0.7 * t), 2 + 0.5 * np.cos(t)
    noise = [0.01 * (((i * 7919 + k * 104729) % 1999) / 999 - 1) for k in range(2)]
    s, c = np.sin(phi), np.cos(phi)
    forward = 0.9 * R * u
    x, y = forward * c - 0.2 * forward * s + noise[0], forward * s + 0.2 * forward * c + noise[1]

    def residuals(e):
        s, c = np.sin(phi), np.cos(phi)
        forward = (1 - e[0]) * R * u
        return np.concatenate([forward * (c - e[1] * s) - x, forward * (s + e[1] * c) - y])

    def slopes(e):
        s, c = np.sin(phi), np.cos(phi)
        forward = (1 - e[0]) * R * u
        by_rc = -R * u * np.concatenate([c - e[1] * s, s + e[1] * c]).reshape(2, -1)
        return np.stack([by_rc.ravel(), np.concatenate([-forward * s, forward * c])], axis=1)

    def fit():
        return least_squares(residuals, [0.0, 0.0], slopes, method="lm", xtol=1e-12, ftol=1e-12, gtol=1e-12).x

    assert np.abs(fit() - [0.1, 0.2]).max() < 1e-3
    return fit


def creeps():
    i = np.arange(MANY)
    return -0.2 + 0.4 * i / MANY, 0.2 * (1 - 2 * ((i * 7919) % MANY) / MANY)


def train_cases():
    i = np.arange(MANY)
    return 0.4 + 0.2 * i / MANY, 0.5 * ((i * 7919) % MANY) / MANY


def diffrax_runs():
    import diffrax
    import jax
    import jax.numpy as jnp

    jax.config.update("jax_enable_x64", True)
    control = diffrax.PIDController(**TOLERANCES)

    def end_of(rates, end, start, parameters):
        term = diffrax.ODETerm(lambda t, z, p: jnp.stack([jnp.asarray(v) for v in rates(jnp, t, z, *p)]))
        solution = diffrax.diffeqsolve(
            term, diffrax.Dopri8(), 0.0, end, 0.01, start, parameters, stepsize_controller=control, max_steps=4096
        )
        return solution.ys[-1]

    wheels = jax.jit(jax.vmap(lambda a, b: end_of(wheel_rates, WHEEL_END, jnp.zeros(3), (a, b))))
    trains = jax.jit(
        jax.vmap(lambda r, phi: end_of(train_rates, TRAIN_END, jnp.zeros(3 + TRAILERS).at[2].set(phi), (r,)))
    )
    e, c = creeps(), train_cases()
    return lambda: wheels(*e).block_until_ready(), lambda: trains(*c).block_until_ready()


def rows_of(np_, q, v):
    """The 12 constraint rows over x, y, phi, theta, phi_1 ... and their rates."""
    x, y = v[0], v[1]
    rows = [np_.cos(q[2]) * x + np_.sin(q[2]) * y - R * v[3], np_.sin(q[2]) * x - np_.cos(q[2]) * y]
    for i in range(4, 4 + TRAILERS):
        x = x + np_.sin(q[i]) * v[i]
        y = y - np_.cos(q[i]) * v[i]
        rows.append(np_.sin(q[i]) * x - np_.cos(q[i]) * y)
    return rows


def jax_jacobian():
    import jax
    import jax.numpy as jnp

    jax.config.update("jax_enable_x64", True)
    n = 4 + TRAILERS
    rows = lambda qv: jnp.stack(rows_of(jnp, qv[:n], qv[n:]))
    batched = jax.jit(jax.vmap(jax.jacfwd(rows)))
    points = np.random.default_rng(1).uniform(0.1, 2.0, (MANY, 2 * n))
    return lambda: batched(points).block_until_ready()


def casadi_jacobian():
    """The code that CasADi generates for the sparse Jacobian, compiled by gcc, called from C alone."""
    import casadi as ca

    n = 4 + TRAILERS
    q, v = ca.SX.sym("q", n), ca.SX.sym("v", n)
    rows = ca.vertcat(*rows_of(ca, [q[i] for i in range(n)], [v[i] for i in range(n)]))
    f = ca.Function("jacobian", [q, v], [ca.jacobian(rows, ca.vertcat(q, v))])
    folder = pathlib.Path(tempfile.mkdtemp(prefix="creepage-casadi-"))
    generator = ca.CodeGenerator("jacobian.c", {"with_header": False})
    generator.add(f)
    generator.generate(f"{folder}/")
    entries = f.nnz_out(0)
    loop = f"""
#include "jacobian.c"
double repeat(long count) {{
  double q[{n}], v[{n}], out[{entries}], w[{max(f.sz_w(), 1)}], sum = 0;
  const double* arg[{f.sz_arg()}] = {{q, v}};
  double* res[{f.sz_res()}] = {{out}};
  for (int i = 0; i < {n}; i++) {{ q[i] = 0.1 + 0.07*i; v[i] = 1.0 + 0.05*i; }}
  for (long k = 0; k < count; k++) {{ q[2] += 1e-9; jacobian(arg, res, 0, w, 0); sum += out[k % {entries}]; }}
  return sum;
}}
"""
    (folder / "loop.c").write_text(loop)
    library = folder / "loop.so"
    flags = ["-O3", "-march=native", "-shared", "-fPIC"]
    subprocess.run(["gcc", *flags, "-o", library, folder / "loop.c", "-lm"], check=True, cwd=folder)
    repeat = ctypes.CDLL(str(library)).repeat
    repeat.restype, repeat.argtypes = ctypes.c_double, [ctypes.c_long]
    return lambda: repeat(100_000)


def all_of_them():
    """Title, the work's name in the benchmark, the peer, and what times it."""
    wheel, train = scipy_runs()
    yield "one wheel of Fig. 7, error 1e-10", "wheel", "SciPy `solve_ivp`, DOP853", seconds(wheel)
    yield "one wheel pulling ten trailers", "train", "SciPy `solve_ivp`, DOP853", seconds(train)
    wheels, trains = diffrax_runs()
    yield "wheels in a sweep, each", "wheels", f"diffrax, Dopri8, {MANY} sets at once", seconds(wheels, MANY)
    yield "ten trailers in a sweep, each", "trains", f"diffrax, Dopri8, {MANY} sets at once", seconds(trains, MANY)
    yield "Jacobian of ten trailers", "jacobian", "CasADi, generated C alone", seconds(casadi_jacobian(), 100_000)
    yield "fit of e_rc and e_tc to 1000 samples", "fit", "SciPy `least_squares`, exact derivatives", seconds(scipy_fit())
    yield "Jacobian of ten trailers", "jacobian", f"JAX, {MANY} at once", seconds(jax_jacobian(), MANY)
