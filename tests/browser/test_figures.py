"""The figures in programs that are no browsers: every text of them is seen."""

import io
import pathlib
import re
import shutil
import subprocess
from collections.abc import Callable

import cairosvg
import pytest
from conftest import CREEPAGE
from PIL import Image, ImageChops

Renderer = Callable[[str], bytes]


def by_cairosvg(svg: str) -> bytes:
    return cairosvg.svg2png(bytestring=svg.encode(), background_color="white", scale=2.0)  # type: ignore[no-any-return]


def by_rsvg(svg: str) -> bytes:
    command = ["rsvg-convert", "--zoom", "2", "--background-color", "white"]
    return subprocess.run(command, input=svg.encode(), stdout=subprocess.PIPE, check=True).stdout


def by_inkscape(svg: str) -> bytes:
    command = ["inkscape", "--pipe", "--export-type=png", "--export-filename=-", "--export-dpi=192"]
    drawn = [*command, "--export-background=white", "--export-background-opacity=1"]
    return subprocess.run(drawn, input=svg.encode(), capture_output=True, check=True).stdout


NEEDED = {by_rsvg: "rsvg-convert", by_inkscape: "inkscape"}


@pytest.fixture(scope="session")
def figures(tmp_path_factory: pytest.TempPathFactory) -> list[pathlib.Path]:
    out = tmp_path_factory.mktemp("figures")
    subprocess.run([CREEPAGE, "--quiet", "figures", "--out", out], check=True)
    return sorted(out.glob("*.svg"))


@pytest.mark.parametrize("render", [by_cairosvg, by_rsvg, by_inkscape])
def test_every_text_of_every_figure_is_seen(figures: list[pathlib.Path], render: Renderer) -> None:
    if render in NEEDED and shutil.which(NEEDED[render]) is None:
        pytest.skip(f"{NEEDED[render]} is not installed")
    assert len(figures) == 16
    for figure in figures:
        svg = figure.read_text()
        texts = re.findall(r"<text (?![^>]*aria-hidden)[^>]*>.*?</text>", svg, re.S)
        # Without its letters, and without their halo, the picture is another one, and darker pixels are missing.
        bare = re.sub(r"<text .*?</text>", "", svg, flags=re.S)
        whole, without = (Image.open(io.BytesIO(render(s))).convert("L") for s in (svg, bare))
        letters = ImageChops.subtract(without, whole).point(lambda v: 255 if v > 60 else 0)
        seen = letters.histogram()[255]
        shown = sum(len(re.sub(r"<[^>]*>", "", text)) for text in texts)
        assert seen > 8 * shown, f"{figure.name}: {seen} dark pixels for {shown} letters"


def test_texts_of_several_pieces_are_laid_out_from_the_left(figures: list[pathlib.Path]) -> None:
    """CairoSVG anchors each piece of a text by itself: centred pieces would lie over one another."""
    several = 0
    for figure in figures:
        for anchor, inner in re.findall(r'<text [^>]*text-anchor="(\w+)"[^>]*>(.*?)</text>', figure.read_text(), re.S):
            pieces = inner.count("<tspan")
            several += pieces > 1
            assert pieces <= 1 or anchor == "start", f"{figure.name}: {inner}"
    assert several > 20
