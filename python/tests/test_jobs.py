"""The jobs, against the command and against what is hidden in the examples."""

import json
import pickle
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
from conftest import ROOT, RUNS

import creepage as cp


def command(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "creepage", *arguments], cwd=ROOT, capture_output=True, text=True, check=False
    )


def test_the_missing_effect_is_named_with_its_value(found: cp.Discovery) -> None:
    assert found.summary.startswith("In turns the robot slides outwards: 8.")
    assert found.summary.endswith("(cornering-creep).")
    (effect,) = found.effects
    slide = effect.parameters["mass_over_bT"]
    assert effect.id == "cornering-creep" and slide.unit == "s" and slide.std is not None
    assert effect.plain.startswith("In turns the robot slides outwards: 8.")
    assert abs(slide.value - 0.11) < 4 * slide.std
    last = [gap for gap in found.gap if gap.held_out][1]
    assert last.horizon_s == 5.0 and last.position_after < 0.1 * last.position_before
    assert "cornering-creep" in found.model.text and "cornering-creep" not in found.given.text
    assert found.remains is None and found.unnamed == ()


def test_the_bytes_are_those_of_the_command(tmp_path) -> None:
    runs = [f"examples/runs/cornering/{name}.csv" for name in ("eights", "rosette")]
    held, file = "examples/runs/cornering/bay_held_out.csv", "examples/runs/cornering/model.toml"
    done = command("discover", *runs, "--held-out", held, "--model", file, "--out", str(tmp_path / "a"))
    assert done.returncode == 0 and "cornering-creep" in done.stdout
    script = (
        "import creepage as cp; m = cp.Model.load({0!r}); "
        "cp.discover(m, [cp.Run.read(r, m) for r in {1!r}], held_out=cp.Run.read({2!r}, m), threads=1).save({3!r})"
    ).format(file, runs, held, str(tmp_path / "b"))
    subprocess.run([sys.executable, "-c", script], cwd=ROOT, check=True)
    for name in ("report.json", "report.html", "model.patched.toml"):
        assert (tmp_path / "a" / name).read_bytes() == (tmp_path / "b" / name).read_bytes(), name


def test_the_command_ends_as_it_should() -> None:
    assert command("vehicles").returncode == 0
    wrong = command("discover", "nowhere.csv", "--model", "nowhere.toml")
    assert wrong.returncode == 2 and "nowhere.toml" in wrong.stderr
    assert command("--version").stdout.startswith("creepage ")


def test_errors_carry_their_place(tmp_path) -> None:
    path = tmp_path / "model.toml"
    path.write_text('vehicle = "unicycle"\n[parameters]\nwheel_radius = "wide"\n')
    with pytest.raises(cp.InputError) as raised:
        cp.Model.load(path)
    assert (raised.value.file, raised.value.line, raised.value.column) == (str(path), 3, 16)
    assert isinstance(raised.value, ValueError) and raised.value.help
    with pytest.raises(cp.InputError) as raised:
        cp.Model("unicycle", wheel_radius=-1.0)
    with pytest.raises(cp.InputError, match="no effect is called"):
        cp.discover(cp.Model("unicycle", wheel_radius=0.1), [], effects=["traverse-crep"])


def test_answers_models_and_runs_are_pickled(found: cp.Discovery, model: cp.Model) -> None:
    again = pickle.loads(pickle.dumps(found))
    assert again.json == found.json and again.effects == found.effects and again.model == found.model
    assert len(again.runs[0]) == len(found.runs[0])
    own = cp.Model.load(RUNS / "model.toml", effects=ROOT / "examples/effects/my_effects.toml")
    assert pickle.loads(pickle.dumps(own)) == own != model


def test_a_fit_has_its_covariance(model: cp.Model) -> None:
    fitted = cp.fit(model, cp.Run.read(RUNS / "eights.csv", model), ["cornering-creep", "lever-arm"])
    names, matrix = fitted.covariance
    assert names == ["cornering-creep mass_over_bT", "lever-arm a", "lever-arm b"]
    slide = fitted.effects[0].parameters["mass_over_bT"]
    assert np.isclose(np.sqrt(matrix[0][0]), slide.std, rtol=1e-6)
    assert list(fitted.frame()["effect"]) == ["cornering-creep", "lever-arm", "lever-arm"]


def test_check_tells_what_would_be_seen(model: cp.Model) -> None:
    told = cp.check(model, cp.Run.read(RUNS / "eights.csv", model), effects=["cornering-creep"])
    assert [effect["id"] for effect in told.effects] == ["cornering-creep"]


def test_the_patched_model_drives_as_the_robot_did(found: cp.Discovery) -> None:
    run = found.held_out[0]
    off = {}
    for name, model in (("given", found.given), ("patched", found.model)):
        motion = cp.simulate(model, run)
        off[name] = float(np.hypot(motion["x"] - run.x, motion["y"] - run.y).max())
    assert off["patched"] < 0.2 * off["given"]


def test_describe_effects_and_claims() -> None:
    told = cp.describe(cp.Model("car", wheel_radius=0.3, wheelbase=2.6))
    assert "growth" in told.text and "\\" in told.latex() and isinstance(told.report, dict)
    assert any(effect["id"] == "understeer" for effect in cp.effects("car")["effects"])
    ledger = cp.verify("eq-21")
    assert [claim["id"] for claim in ledger.claims] == ["eq-21"]


def test_a_sweep_writes_its_table(tmp_path) -> None:
    written = cp.sweep(ROOT / "examples/sweeps/wheels.toml", tmp_path / "table.csv")
    assert written["cases"] > 0 and written["undefined"] == 0 and (tmp_path / "table.csv").exists()


def test_progress_is_told_and_its_error_ends_the_work(model: cp.Model) -> None:
    run = cp.Run.read(RUNS / "eights.csv", model)
    heard: list[tuple[str, int, int]] = []
    cp.discover(model, run, progress=lambda *told: heard.append(told))
    assert any(of > 0 for _, _, of in heard) and any("fitting the model" in stage for stage, _, _ in heard)

    def stop(stage: str, done: int, of: int) -> None:
        raise StopIteration(stage)

    with pytest.raises(StopIteration):
        cp.discover(model, run, progress=stop)


def test_ctrl_c_stops_work_that_nobody_listens_to() -> None:
    # All claims take ten seconds and more; a piece of evidence takes less than one.
    script = (
        "import creepage as cp, threading, _thread, time\n"
        "asked = []\n"
        "def ask():\n"
        "    asked.append(time.monotonic())\n"
        "    _thread.interrupt_main()\n"
        "threading.Timer(0.5, ask).start()\n"
        "try: cp.verify()\n"
        "except KeyboardInterrupt: print('stopped', time.monotonic() - asked[0] < 5)\n"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=120, check=False)
    assert done.stdout == "stopped True\n", done.stdout + done.stderr


def test_other_threads_go_on(model: cp.Model) -> None:
    ticks: list[float] = []
    over = threading.Event()

    def tick() -> None:
        while not over.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.002)

    other = threading.Thread(target=tick)
    other.start()
    began = time.monotonic()
    cp.discover(model, cp.Run.read(RUNS / "eights.csv", model))
    lasted = time.monotonic() - began
    over.set()
    other.join()
    # Without the interpreter's lock released there would be none between the first and the last.
    within = [t for t in ticks if began + 0.25 * lasted < t < began + 0.75 * lasted]
    assert within


def test_json_is_what_the_properties_say(found: cp.Discovery) -> None:
    assert json.loads(found.json)["verdict"] == found.verdict == "missing-effect"
    assert list(found.frame()["parameter"]) == ["mass_over_bT"]
    assert len(found.gap_frame()) == len(found.gap)
    page = found._repr_html_()
    assert "missing-effect" in page and 'sandbox="allow-scripts"' in page
