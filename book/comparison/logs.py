"""Logs, the kinematic prediction that every method corrects, and the gap it is judged by."""
import csv
import tomllib
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.signal import savgol_filter

HORIZON = 5.0  # s
MARGIN = 0.5  # s: how far windows stay from the ends, as `creepage discover` does
HALF_WIDTH = 0.4  # s, of the local quartic that smooths the pose


@dataclass
class Log:
    name: str
    step: float
    pose: np.ndarray  # x, y, unwrapped heading
    wheels: np.ndarray  # unicycle: speed, yaw rate; differential drive: right and left wheel speeds, m/s
    track: float | None  # nominal track width of a differential drive

    def part(self, first, last):
        """A share of the rows."""
        rows = slice(round(first * len(self.pose)), round(last * len(self.pose)))
        return Log(self.name, self.step, self.pose[rows], self.wheels[rows], self.track)

    def inputs(self):
        """Nominal speed and yaw rate of each row."""
        return self.wheels if self.track is None else body(self.wheels, self.track)

    def smoothed(self, derivative=0):
        width = 2 * round(HALF_WIDTH / self.step) + 1
        return savgol_filter(self.pose, width, 4, deriv=derivative, delta=self.step, axis=0)

    def velocities(self):
        """Measured speed ahead, speed to the left and yaw rate in the body's axes."""
        rate, heading = self.smoothed(1), self.smoothed()[:, 2]
        cos, sin = np.cos(heading), np.sin(heading)
        return np.column_stack([cos * rate[:, 0] + sin * rate[:, 1], cos * rate[:, 1] - sin * rate[:, 0], rate[:, 2]])


def body(wheels, track):
    right, left = wheels.T
    return np.column_stack([(right + left) / 2, (right - left) / track])


def read(path, model):
    """A log and the model file that names its columns."""
    model = tomllib.loads(Path(model).read_text())
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    column = {role: np.array([float(r[name]) for r in rows]) for role, name in model["columns"].items()}
    radius, track = model["parameters"]["wheel_radius"], model["parameters"].get("track_width")
    if model["vehicle"] == "unicycle":
        wheels = np.column_stack([radius * column["wheel_rate"], column["yaw_rate"]])
    else:
        wheels = radius * np.column_stack([column["wheel_rate_right"], column["wheel_rate_left"]])
    pose = np.column_stack([column["x"], column["y"], np.unwrap(column["heading"])])
    if model.get("input_timing") == "interval-mean":
        # What holds at a row lies between the mean before it and the mean behind it.
        wheels[:-1] = (wheels[:-1] + wheels[1:]) / 2
    return Log(Path(path).stem, float(np.median(np.diff(column["time"]))), pose, wheels, track)


def windows(log, every, horizon):
    """Rows at which the windows begin, and how many rows they last."""
    margin, length = round(MARGIN / log.step), round(horizon / log.step)
    return np.arange(margin, len(log.pose) - margin - length, round(every / log.step)), length


def predicted(log, velocities, every=HORIZON, horizon=HORIZON):
    """Poses at the ends of all windows from velocities (ahead, left, yaw) of every row, and those measured."""
    starts, length = windows(log, every, horizon)
    mean = (velocities[1:] + velocities[:-1]) / 2
    pose = log.smoothed()[starts].copy()
    for k in range(length):
        ahead, left, yaw = mean[starts + k].T * log.step
        middle = pose[:, 2] + yaw / 2
        pose[:, 0] += ahead * np.cos(middle) - left * np.sin(middle)
        pose[:, 1] += ahead * np.sin(middle) + left * np.cos(middle)
        pose[:, 2] += yaw
    return pose, log.pose[starts + length]


def gap(logs, velocities_of):
    """RMS position error after the horizon, m, over the windows of some logs."""
    errors = []
    for log in logs:
        end, measured = predicted(log, velocities_of(log))
        errors.extend(np.sum((end - measured)[:, :2] ** 2, axis=1))
    return float(np.sqrt(np.mean(errors)))


def nominal(log):
    """The model as given: no lateral velocity."""
    speed, yaw = log.inputs().T
    return np.column_stack([speed, 0 * speed, yaw])
