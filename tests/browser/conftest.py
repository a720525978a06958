"""Reports of the bundled runs, and a browser that looks at them."""

import os
import pathlib
import shutil
import subprocess
from collections.abc import Callable, Iterator

import pytest
from playwright.sync_api import Browser, Page, sync_playwright

ROOT = pathlib.Path(__file__).resolve().parents[2]
CREEPAGE = pathlib.Path(os.environ.get("CREEPAGE", ROOT / "target/release/creepage"))
RUNS = ROOT / "examples/runs"


def discovered(folder: str, out: pathlib.Path, model: str | None = None) -> pathlib.Path:
    """The page of a folder's runs, by its model or by another text."""
    runs = sorted(RUNS.joinpath(folder).glob("*.csv"))
    held_out = [run for run in runs if "held_out" in run.name]
    fitted = [run for run in runs if run not in held_out]
    given = RUNS / folder / "model.toml"
    if model is not None:
        given = out / "given.toml"
        given.write_text(model)
    command = [CREEPAGE, "--quiet", "discover", *fitted, "--model", given, "--out", out]
    subprocess.run([*command, "--held-out", *held_out] if held_out else command, check=True)
    return out / "report.html"


@pytest.fixture(scope="session")
def reports(tmp_path_factory: pytest.TempPathFactory) -> dict[str, pathlib.Path]:
    """Pages: causes found, nothing missing, data that cannot be used, a check, a fleet."""
    text = (RUNS / "cornering/model.toml").read_text()
    # Wheels a thousand times as large, as if their radius were in millimetres.
    unusable = text.replace("wheel_radius = 0.1", "wheel_radius = 100.0")
    assert unusable != text
    made = {"found": ("cornering", None), "nothing": ("nothing", None), "unusable": ("cornering", unusable)}
    made["track"] = ("track", None)
    pages = {name: discovered(folder, tmp_path_factory.mktemp(name), model) for name, (folder, model) in made.items()}
    out = tmp_path_factory.mktemp("check")
    subprocess.run(
        [CREEPAGE, "-q", "check", RUNS / "cornering/eights.csv", "--model", RUNS / "cornering/model.toml", "--out", out], check=True
    )
    pages["check"] = out / "check.html"
    out = tmp_path_factory.mktemp("fleet")
    subprocess.run([CREEPAGE, "-q", "fleet", "map", ROOT / "examples/fleet/fleet.csv", "--out", out / "rows"], check=True)
    subprocess.run([CREEPAGE, "-q", "fleet", "join", out / "rows", "--out", out / "fleet"], check=True)
    pages["fleet"] = out / "fleet/fleet.html"
    return pages


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """Chromium, as the system has it."""
    executable = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    with sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=executable, args=["--no-sandbox"])
        yield started
        started.close()


Open = Callable[..., Page]


@pytest.fixture
def look(browser: Browser, reports: dict[str, pathlib.Path]) -> Iterator[Open]:
    """Opens a page; fails in the end where one asked for anything but itself, or said anything on the console."""
    said: list[str] = []
    contexts = []

    def open_page(name: str, **options: object) -> Page:
        context = browser.new_context(**options)  # type: ignore[arg-type]
        contexts.append(context)
        page = context.new_page()
        address = reports[name].as_uri()
        page.on("console", lambda message: said.append(f"console: {message.text}"))
        page.on("pageerror", lambda error: said.append(f"error: {error}"))
        page.on("request", lambda request: said.append(request.url) if request.url != address else None)
        page.goto(address)
        return page

    yield open_page
    for context in contexts:
        context.close()
    assert said == []
