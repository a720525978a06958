"""UMBmark (Borenstein and Feng, 1996) in its own experiment, and `creepage discover` on the same drives.

Five squares each way, driven by odometry that is wrong; only the ends are measured for UMBmark, the whole pose for
`creepage`. The corrections are linear in the errors and derived here anew for legs that begin along x:

    overturn of a corner      alpha = (x_cw + x_ccw)/(4 L) = (y_cw - y_ccw)/(4 L)
    turn of a straight leg    beta  = (x_ccw - x_cw)/(4 L) = -(y_cw + y_ccw)/(4 L)
    E_b = (pi/2)/(pi/2 + alpha),   R = (L/2)/sin(beta/2),   E_d = (R + b/2)/(R - b/2)
"""
import json
import subprocess

import numpy as np

SIDE, RADIUS, TRACK, SPEED, TURN, STEP = 4.0, 0.06, 0.32, 0.4, 1.0, 0.04
NOISE = 0.002  # m and rad
CASES = {  # what is hidden: left radius, track width, drift of the ground (m/s)
    "left wheel 0.5 % smaller, track 1 % wider": (-0.005, 0.01, (0.0, 0.0)),
    "the carpet pulls by 2 mm/s": (0.0, 0.0, (0.002, 0.0)),
    "nothing": (0.0, 0.0, (0.0, 0.0)),
}


def square(sense, hidden, rng):
    """One square: times, commanded wheel rates, and the pose that is measured."""
    left, track, drift = hidden
    leg, corner = round(SIDE / SPEED / STEP), round(np.pi / 2 / TURN / STEP)
    v = np.tile(np.r_[np.full(leg, SIDE / leg / STEP), np.zeros(corner)], 4)
    w = sense * np.tile(np.r_[np.zeros(leg), np.full(corner, np.pi / 2 / corner / STEP)], 4)
    right_rate, left_rate = (v + w * TRACK / 2) / RADIUS, (v - w * TRACK / 2) / RADIUS
    true = RADIUS * np.column_stack([right_rate, left_rate * (1 + left)])
    ahead, yaw = true.mean(axis=1), (true[:, 0] - true[:, 1]) / (TRACK * (1 + track))
    heading = np.r_[0, np.cumsum(yaw) * STEP]
    middle = heading[:-1] + yaw * STEP / 2
    x = np.r_[0, np.cumsum(ahead * np.cos(middle) + drift[0]) * STEP]
    y = np.r_[0, np.cumsum(ahead * np.sin(middle) + drift[1]) * STEP]
    pose = np.column_stack([x, y, heading]) + NOISE * rng.standard_normal((len(x), 3))
    rates = np.vstack([[right_rate[0], left_rate[0]], np.column_stack([right_rate, left_rate])])
    return np.arange(len(x)) * STEP, rates, pose


def corrections(cw, ccw):
    """(E_d, E_b) from the mean end of the squares each way."""
    alpha = (cw[0] + ccw[0] + cw[1] - ccw[1]) / (8 * SIDE)
    beta = (ccw[0] - cw[0] - cw[1] - ccw[1]) / (8 * SIDE)
    curve = np.inf if beta == 0 else SIDE / 2 / np.sin(beta / 2)
    ratio = 1.0 if np.isinf(curve) else (curve + TRACK / 2) / (curve - TRACK / 2)
    return ratio, np.pi / 2 / (np.pi / 2 + alpha)


def write(path, drive):
    times, rates, pose = drive
    columns = np.column_stack([times, pose, rates[:, 1], rates[:, 0]])
    np.savetxt(path, columns, delimiter=",", fmt="%.9g", header="t,x,y,phi,omega_left,omega_right", comments="")


MODEL = f"""vehicle = "differential-drive"
input_timing = "interval-mean"
[parameters]
wheel_radius = {RADIUS}
track_width = {TRACK}
[columns]
time = "t"
x = "x"
y = "y"
heading = "phi"
wheel_rate_left = "omega_left"
wheel_rate_right = "omega_right"
"""


def compare(binary, folder):
    """A line of Markdown for every case."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "model.toml").write_text(MODEL)
    for number, (story, hidden) in enumerate(CASES.items()):
        rng = np.random.default_rng(number)
        drives = {way: [square(sense, hidden, rng) for _ in range(5)] for way, sense in [("cw", -1), ("ccw", 1)]}
        ends = {way: np.mean([d[2][-1, :2] for d in five], axis=0) for way, five in drives.items()}
        ratio, base = corrections(ends["cw"], ends["ccw"])
        paths = []
        for way, five in drives.items():
            for k, drive in enumerate(five):
                paths.append(folder / f"{number}-{way}{k}.csv")
                write(paths[-1], drive)
        out = folder / f"report{number}"
        subprocess.run([binary, "discover", *paths, "--model", folder / "model.toml", "--out", out, "--quiet"],
                       check=True, capture_output=True)
        report = json.loads((out / "report.json").read_text())
        names = [f"`{e['id']}` " + ", ".join(f"{k} = {p['value']:.5f} ± {p['std'] or 0:.0e}"
                                             for k, p in e["parameters"].items()) for e in report["effects"]]
        yield (f"| {story} | {ratio:.5f} | {base:.5f} | {report['verdict']}"
               + (": " + "; ".join(names) if names else "") + " |")
