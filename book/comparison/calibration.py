"""Plain least squares: the parameters an engineer would calibrate, all of them, by output error over 5 s windows.

This is what grey-box tools (the System Identification Toolbox, CasADi, SIPPY) minimise for this model; they differ in how
the minimum is found, not in where it lies.
"""
import numpy as np
from scipy.optimize import least_squares

from logs import body, predicted

NAMES = {"unicycle": ["speed scale", "yaw-rate scale", "yaw-rate bias"],
         "differential-drive": ["left radius", "right radius", "track width"]}


def kind(log):
    return "unicycle" if log.track is None else "differential-drive"


def corrected(log, p):
    if log.track is None:
        speed, yaw = log.wheels.T
        speed, yaw = speed * (1 + p[0]), yaw * (1 + p[1]) + p[2]
    else:
        speed, yaw = body(log.wheels * [1 + p[1], 1 + p[0]], log.track * (1 + p[2])).T
    return np.column_stack([speed, 0 * speed, yaw])


def fit(logs):
    """Values and standard deviations, positions and headings weighted by what is left of each."""
    def residuals(p):
        ends = [np.subtract(*predicted(log, corrected(log, p))) for log in logs]
        return np.concatenate(ends)

    def weighted(p, scale):
        return (residuals(p) / scale).ravel()

    scale = np.array([1.0, 1.0, 1.0])
    p = np.zeros(3)
    for _ in range(3):
        found = least_squares(weighted, p, args=(scale,))
        p, left = found.x, residuals(found.x)
        position, heading = np.sqrt(np.mean(left[:, :2] ** 2)), np.sqrt(np.mean(left[:, 2] ** 2))
        scale = np.array([position, position, heading])
    spread = np.mean(weighted(p, scale) ** 2)
    return p, np.sqrt(np.diag(np.linalg.inv(found.jac.T @ found.jac)) * spread)
