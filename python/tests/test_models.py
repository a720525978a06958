"""Models: what robots read of them, and many motions of one."""

import pickle
import subprocess
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import yaml
from conftest import RUNS
from urdf_parser_py.urdf import URDF

import creepage as cp

DRIVE = """
vehicle = "differential-drive"
[parameters]
wheel_radius = 0.1
track_width = 0.4
[[effects]]
id = "track-width"
scale = 0.03
"""


CAR = """
vehicle = "car"
[parameters]
wheel_radius = 0.3
wheelbase = 2.7
"""


def test_a_controller_of_ros_2_gets_what_was_found() -> None:
    node = yaml.safe_load(cp.Model.parse(DRIVE).to_ros2_yaml("base_controller"))["base_controller"]["ros__parameters"]
    assert node["wheel_separation"] == 0.4 and node["wheel_radius"] == 0.1
    assert node["wheel_separation_multiplier"] == pytest.approx(1.03, abs=1e-12)
    assert node["left_wheel_radius_multiplier"] == node["right_wheel_radius_multiplier"] == 1.0
    # The parameters of a node are floating-point numbers: ROS 2 refuses a whole one.
    assert all(isinstance(v, float) for v in node.values())
    assert list(yaml.safe_load(cp.Model.parse(DRIVE).to_ros2_yaml())) == ["diff_drive_controller"]
    car = CAR + '[[effects]]\nid = "wheelbase"\nscale = -0.02\n'
    node = yaml.safe_load(cp.Model.parse(car).to_ros2_yaml())["bicycle_steering_controller"]["ros__parameters"]
    assert node["wheelbase"] == pytest.approx(2.7 * 0.98, abs=1e-12)


def test_code_and_what_has_no_place(model: cp.Model, found: cp.Discovery) -> None:
    assert "def step(" in found.model.export("python")
    # A unicycle is driven by no controller; a sliding drive has an effect that a controller does not know.
    with pytest.raises(cp.InputError, match="drives differential-drive"):
        model.export("ros2-diff-drive")
    with pytest.raises(cp.InputError, match="is no target"):
        model.export("ros3")
    sliding = cp.Model.parse(DRIVE + '[[effects]]\nid = "traverse-creep"\ne_tc = 0.1\n')
    with pytest.warns(UserWarning, match="has no place for traverse-creep"):
        sliding.to_ros2_yaml()


def test_many_motions_are_each_the_one() -> None:
    n = 120
    rates = np.random.default_rng(3).uniform(2.0, 8.0, (2, n))
    table = {"time": 0.05 * np.arange(n), "x": np.full(n, 1.0), "y": np.full(n, -2.0), "heading": np.full(n, 0.3)}
    table |= {"wheel_rate_left": rates[0], "wheel_rate_right": rates[1]}
    model = cp.Model.parse(DRIVE)
    run = cp.Run.from_frame(table, model)
    tracks = np.linspace(0.35, 0.45, 7).tolist()
    many = cp.simulate_many(model, run, {"track_width": tracks, "track-width.scale": np.full(7, 0.03)}, threads=2)
    assert many.shape == (7, n, 3)
    for track, motion in zip(tracks, many, strict=True):
        one = cp.simulate(cp.Model.parse(DRIVE.replace("0.4\n", f"{track!r}\n")), run)
        assert np.abs(motion - one[["x", "y", "heading"]].to_numpy()).max() < 1e-7
    assert np.array_equal(many, cp.simulate_many(model, run, {"track_width": tracks}, threads=1))


@pytest.mark.parametrize(
    ("values", "says"),
    [
        ({}, "nothing varies"),
        ({"track_width": [0.4], "wheel_radius": [0.1, 0.2]}, "wheel_radius has 2 values where the first has 1"),
        ({"track_width": [-0.4]}, "track_width = -0.4 is out of range"),
        ({"trackwidth": [0.4]}, 'no quantity of the model is called "trackwidth"'),
    ],
)
def test_values_that_are_none(values: dict[str, list[float]], says: str) -> None:
    table = {"time": [0.0, 1.0], "x": [0.0, 0.0], "y": [0.0, 0.0], "heading": [0.0, 0.0]}
    table |= {"wheel_rate_left": [1.0, 1.0], "wheel_rate_right": [1.0, 1.0]}
    model = cp.Model.parse(DRIVE)
    run = cp.Run.from_frame({name: np.array(of) for name, of in table.items()}, model)
    with pytest.raises(cp.InputError, match=says):
        cp.simulate_many(model, run, values)


def test_poses_that_were_logged_apart(model: cp.Model, tmp_path: Path) -> None:
    whole = pd.read_csv(RUNS / "eights.csv", comment="#")
    pose = ["t", "x", "y", "phi"]
    inputs, poses = whole.drop(columns=pose[1:]), whole[pose].iloc[::2]
    files = [tmp_path / "inputs.csv", tmp_path / "poses.csv"]
    for file, table in zip(files, (inputs, poses), strict=True):
        table.to_csv(file, index=False)
    read = cp.Run.read(files[0], model, truth=files[1])
    by_tables = cp.Run.from_frame(inputs, model, truth=poses)
    for run in (
        by_tables,
        cp.Run.from_frame(inputs, model, truth=files[1]),
        cp.Run.read(RUNS / "eights.csv", model).with_truth(poses),
        pickle.loads(pickle.dumps(by_tables.with_truth(poses, name="camera"))),
    ):
        assert np.array_equal(run.time, read.time) and np.array_equal(run.x, read.x)
        assert len(run.input_time) == len(whole) and len(run) == len(poses)
        assert all(np.array_equal(a, b) for a, b in zip(run.inputs.values(), read.inputs.values(), strict=True))


ROBOT = """<robot name="r">
  <link name="base"/>
  <link name="marker"/>
  {wheels}
  <joint name="m" type="fixed"><parent link="base"/><child link="marker"/><origin xyz="0 0 0.3" rpy="0 0 0"/></joint>
</robot>
"""
WHEEL = """<link name="{side}_wheel"><collision><geometry><cylinder radius="0.1" length="0.02"/></geometry></collision></link>
  <joint name="{side}" type="continuous"><parent link="base"/><child link="{side}_wheel"/><origin xyz="0 {y} 0"/>
  <axis xyz="0 1 0"/></joint>"""


def test_a_robots_description_is_read_by_a_parser_of_such(tmp_path: Path) -> None:
    robot = tmp_path / "robot.urdf"
    wheels = "\n  ".join(WHEEL.format(side=side, y=y) for side, y in (("left", 0.2), ("right", -0.2)))
    robot.write_text(ROBOT.format(wheels=wheels))
    cp.Model.parse(DRIVE + '[[effects]]\nid = "lever-arm"\na = 0.07\nb = -0.01\n').save(tmp_path / "model.toml")
    command = [sys.executable, "-m", "creepage", "export", "model.toml", "--as", "urdf", "--urdf", "robot.urdf"]
    subprocess.run([*command, "--tracked", "marker", "--out", "new.urdf"], cwd=tmp_path, check=True, capture_output=True)
    found = URDF.from_xml_string((tmp_path / "new.urdf").read_text())
    origins = {joint.child: joint.origin.xyz for joint in found.joints}
    assert origins["left_wheel"] == pytest.approx([0.0, 0.206, 0.0])
    assert origins["right_wheel"] == pytest.approx([0.0, -0.206, 0.0])
    assert origins["marker"] == pytest.approx([0.07, -0.01, 0.3])
    assert [link.collision.geometry.radius for link in found.links if "wheel" in link.name] == [0.1, 0.1]
