"""The page of a report in a browser: it asks for nothing, fits every screen, and its controls do what they say."""

import pathlib
import re

import pytest
from conftest import Open
from playwright.sync_api import Page

REPORTS = ["found", "nothing", "unusable", "track"]
NAMES = [*REPORTS, "check", "fleet"]
PHONE = {"viewport": {"width": 390, "height": 844}, "device_scale_factor": 2, "is_mobile": True, "has_touch": True}
SHOTS = pathlib.Path(__file__).resolve().parents[2] / "target/look"

# Text against what lies behind it, and lines against the paper, as WCAG 2.2 has the ratio.
CONTRAST = """() => {
  const channel = v => { v /= 255; return v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4; };
  const parse = c => (c.match(/[0-9.]+/g) || []).map(Number);
  const light = ([r, g, b]) => 0.2126 * channel(r) + 0.7152 * channel(g) + 0.0722 * channel(b);
  const ratio = (a, b) => { const [x, y] = [light(a), light(b)].sort((p, q) => q - p); return (x + 0.05) / (y + 0.05); };
  const behind = e => {
    for (; e; e = e.parentElement) {
      const c = parse(getComputedStyle(e).backgroundColor);
      if (c.length === 3 || c[3] === 1) return c;
    }
    return [255, 255, 255];
  };
  const bad = [];
  for (const e of document.querySelectorAll('body *')) {
    const own = Array.from(e.childNodes).some(n => n.nodeType === 3 && n.textContent.trim());
    const style = getComputedStyle(e);
    if (!e.checkVisibility() || ['SCRIPT', 'STYLE', 'OPTION', 'title', 'desc'].includes(e.tagName)) continue;
    const isSvg = e instanceof SVGElement;
    if (own) {
      const r = ratio(parse(isSvg ? style.fill : style.color), behind(e));
      if (r < 4.5) bad.push([e.tagName, e.className.baseVal || e.className, e.textContent.slice(0, 30), r]);
    }
    if (isSvg && e.classList.contains('line') && style.stroke !== 'none') {
      const r = ratio(parse(style.stroke), behind(e));
      if (r < 3) bad.push([e.tagName, e.className.baseVal, 'stroke', r]);
    }
  }
  return bad;
}"""


def unfolded(page: Page) -> None:
    page.evaluate("document.querySelectorAll('details').forEach(d => { d.open = true; })")


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_everything_can_be_read_in_both_themes(look: Open, name: str, scheme: str) -> None:
    page = look(name, color_scheme=scheme, viewport={"width": 1280, "height": 900})
    unfolded(page)
    assert page.evaluate(CONTRAST) == []
    ground = page.evaluate("getComputedStyle(document.body).backgroundColor")
    assert (ground == "rgb(255, 255, 255)") == (scheme == "light")
    SHOTS.mkdir(parents=True, exist_ok=True)
    page.screenshot(path=SHOTS / f"{name}-{scheme}.png", full_page=True)


@pytest.mark.parametrize("name", NAMES)
def test_a_phone_shows_all_of_it_without_moving_sideways(look: Open, name: str) -> None:
    page = look(name, **PHONE)
    unfolded(page)
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    beyond = """() => Array.from(document.querySelectorAll('body *')).filter(e => e.checkVisibility()
      && e.tagName !== 'SCRIPT' && e.getBoundingClientRect().right > 391
      && !e.closest('svg svg') && !e.closest('pre')).map(e => e.tagName + ' ' + e.textContent.slice(0, 40))"""
    assert page.evaluate(beyond) == []
    SHOTS.mkdir(parents=True, exist_ok=True)
    # A finger needs 24 px at least (WCAG 2.2, 2.5.8).
    small = """() => Array.from(document.querySelectorAll('button, select, input')).filter(e => e.checkVisibility()
      && Math.min(e.getBoundingClientRect().height, e.getBoundingClientRect().width) < 24).map(e => e.id)"""
    assert page.evaluate(small) == []
    # Letters within drawings shrink with them.
    letters = """() => Math.min(...Array.from(document.querySelectorAll('svg text')).filter(e => e.checkVisibility()).map(e =>
      parseFloat(getComputedStyle(e).fontSize) * e.ownerSVGElement.getScreenCTM().a))"""
    assert page.evaluate(letters) >= 9
    page.screenshot(path=SHOTS / f"{name}-phone.png", full_page=True)


def test_the_slider_moves_the_place_and_what_is_said_of_it(look: Open) -> None:
    page = look("found")
    before, ghosts = page.inner_text("#read"), page.inner_html("#ghosts")
    assert re.fullmatch(r"At [\d.]+ s: 5 s later the model as given is off by .+, the patched one by .+ mm\.", before)
    page.focus("#cursor")
    for _ in range(4):
        page.keyboard.press("ArrowLeft")
    assert page.inner_text("#read") != before and page.inner_html("#ghosts") != ghosts
    assert page.get_attribute("#cursor", "aria-valuetext") == page.inner_text("#read"), "aloud it says what stands there"
    # The strip under it has the same cursor.
    at = float(page.get_attribute("#now", "x1") or "nan")
    strip = page.locator("#strip")
    strip.scroll_into_view_if_needed()
    box = strip.bounding_box()
    assert box is not None
    strip.click(position={"x": 0.75 * box["width"], "y": 20})
    moved = float(page.get_attribute("#now", "x1") or "nan")
    assert abs(moved - 750) < 12 and moved != at


def test_the_map_can_be_moved_zoomed_coloured_and_played(look: Open) -> None:
    page = look("found")
    view = lambda: page.get_attribute("#map", "viewBox")  # noqa: E731
    whole, scale = view(), page.inner_text("#scale")
    page.click("#closer")
    page.click("#closer")
    assert view() != whole and page.inner_text("#scale") != scale
    page.locator("#map").scroll_into_view_if_needed()
    nearer, box = view(), page.locator("#map").bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + 300, box["y"] + 200)
    page.mouse.down()
    page.mouse.move(box["x"] + 380, box["y"] + 160)
    page.mouse.up()
    assert view() != nearer
    page.focus("#map")
    page.keyboard.press("0")
    assert view() == whole
    reds = lambda: page.locator("#path .e5").count()  # noqa: E731
    assert reds() == 1
    page.click("#by-after")
    assert reds() == 0, "the patched model errs nowhere as the given one does"
    assert page.get_attribute("#by-after", "aria-pressed") == "true"
    said = page.inner_text("#read")
    page.click("#play")
    page.wait_for_function("said => document.getElementById('read').textContent !== said", arg=said)
    page.click("#play")


def test_every_run_can_be_chosen_and_the_first_is_the_one_of_which_most_remains(look: Open) -> None:
    page = look("found")
    names = page.locator("#run option").all_inner_texts()
    assert sorted(n.split(",")[0] for n in names) == ["bay_held_out.csv", "eights.csv", "rosette.csv"]
    after = """() => JSON.parse(document.getElementById('forecasts').textContent).runs.map(run => {
      const [low, high, text] = run.after, bytes = atob(text);
      const e = Array.from({ length: bytes.length / 2 }, (_, i) =>
        low + (bytes.charCodeAt(2 * i) + 256 * bytes.charCodeAt(2 * i + 1)) / 65535 * (high - low)).filter(v => v > -0.01 * high);
      return Math.sqrt(e.reduce((s, v) => s + v * v, 0) / e.length); })"""
    remaining = page.evaluate(after)
    assert remaining == sorted(remaining, reverse=True) and len(remaining) == 3
    path = page.inner_html("#path")
    page.select_option("#run", "2")
    assert page.inner_html("#path") != path


def test_what_to_change_stands_in_tabs_to_copy_from(look: Open) -> None:
    page = look("track")
    tabs = page.locator("[role=tab]")
    assert tabs.all_inner_texts()[:2] == ["model.toml", "ROS 2"]
    shown = lambda: page.locator("#change pre:visible").all_inner_texts()  # noqa: E731
    assert len(shown()) == 1 and 'id = "track-width"' in shown()[0]
    tabs.nth(1).click()
    assert len(shown()) == 1 and "wheel_separation_multiplier" in shown()[0]
    page.keyboard.press("ArrowRight")
    assert len(shown()) == 1 and "<origin" in shown()[0]
    page.locator("#change .copy:visible").click()
    assert "<origin" in page.evaluate("getSelection().toString()")


def test_a_link_unfolds_the_part_it_leads_to(look: Open) -> None:
    page = look("found")
    assert not page.is_visible("#words dl")
    page.click("nav a[href='#words']")
    # The browser tells of a new place a moment after the click.
    page.locator("#words dl").wait_for(state="visible", timeout=2000)
    assert page.is_visible("#words dl") and page.is_visible("text=Kass and Raftery")


@pytest.mark.parametrize("name", REPORTS)
def test_without_its_script_the_page_says_the_same(look: Open, name: str) -> None:
    scripted, plain = look(name), look(name, java_script_enabled=False)
    for part in ["h1", ".lead", ".cards", "#read"]:
        if scripted.locator(part).count():
            assert plain.inner_text(part) == scripted.inner_text(part), part
    assert plain.locator(".tools").count() == 0 or not plain.is_visible(".tools")
    if name != "unusable":
        for group in ["#path", "#ghosts", "#strips"]:
            number = lambda page: page.locator(f"{group} > *").count()  # noqa: B023, E731
            assert number(plain) == number(scripted) > 0, group
    assert all(text.strip() for text in plain.locator("#change pre").all_inner_texts())


@pytest.mark.parametrize("name", NAMES)
def test_on_paper_it_is_a_few_full_pages(look: Open, name: str) -> None:
    page = look(name)
    SHOTS.mkdir(parents=True, exist_ok=True)
    page.pdf(path=SHOTS / f"{name}.pdf", format="A4")
    sheets = len(re.findall(rb"/Type\s*/Page\b", (SHOTS / f"{name}.pdf").read_bytes()))
    assert (1 if name in ("unusable", "fleet") else 2) <= sheets <= 4
