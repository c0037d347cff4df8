"""Opens pages of `abrade view` from disk in a headless Chromium and uses them as a person would.

    python3 crates/abrade-view/tests/browser/check.py

Needs Python 3 alone, `target/release/abrade` and a browser; without one it fails and says how to get
it. Leaves pictures of what it saw in target/view."""

import base64
import json
import re
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from devtools import FLAGS, Browser, NoBrowser
from vtp import arrays

ROOT = Path(__file__).resolve().parents[4]
ABRADE = ROOT / "target" / "release" / "abrade"
RUNS = ROOT / "target" / "view"
READY = "document.body && document.body.dataset.ready"
FRAME = ".frame"

SCENES = {
    "plate": ("first_impact.ron", ['surfaces.plate.geometry.pitch="0.1 mm"',
              'outputs=[Energy, Surface(every: "2 us"), Surface(at: End), Bodies, History(every: "1 us")]']),
    "cube": ("closed/tumbled_cube.ron", ['outputs=[Surface(every: "20 ms"), Bodies]']),
    "stream": ("closed/elbow.ron", ["streams.grit.count=3", "surfaces.elbow.geometry.pitch=\"0.5 mm\"",
               "outputs=[Surface(at: End), Bodies]"]),
    "mill": ("closed/ball_mill.ron", ['run.stop=Time(limit: "0.1 s")',
             'outputs=[Energy, Surface(every: "20 ms"), Bodies]']),
}


def view(name):
    """Runs a scene and makes its page."""
    scene, sets = SCENES[name]
    folder = RUNS / name
    changes = [word for change in sets for word in ("--set", change)]
    subprocess.run([ABRADE, "run", ROOT / "scenes" / scene, "--out", folder, *changes],
                   check=True, stdout=subprocess.DEVNULL)
    subprocess.run([ABRADE, "view", folder], check=True, stdout=subprocess.DEVNULL)
    return folder / "view.html"


def text(browser, selector):
    return browser.value(f"document.querySelector({json.dumps(selector)}).textContent")


def slide(browser, selector, value):
    """Moves a slider as a person does: the page hears of it by the same event."""
    browser.value(f"(() => {{ const s = document.querySelector({json.dumps(selector)}); s.value = {value};"
                  "s.dispatchEvent(new Event('input', {bubbles: true})); })()")
    settle(browser)


def settle(browser):
    browser.value("new Promise(go => setTimeout(() => requestAnimationFrame(() => requestAnimationFrame(go)), 60))")


def length(said):
    """The first length in a text [m]."""
    found = re.search(r"([−\d.]+)\u00a0(m|mm|µm|nm)\b", said)
    assert found, f"no length in `{said}`"
    number, unit = found.groups()
    return float(number.replace("−", "-")) * {"m": 1, "mm": 1e-3, "µm": 1e-6, "nm": 1e-9}[unit]


def pixels(browser, test, want="count"):
    """How many pixels of the view pass `test` on r, g, b; or the middle of them."""
    left, top, width, height = browser.box(FRAME)
    data = browser.picture([left, top, width, height - 70])
    code = base64.b64encode(data).decode()
    return browser.value(f"""(async () => {{
      const bytes = Uint8Array.from(atob("{code}"), (c) => c.charCodeAt(0));
      const image = await createImageBitmap(new Blob([bytes], {{type: "image/png"}}));
      const canvas = new OffscreenCanvas(image.width, image.height);
      const context = canvas.getContext("2d", {{willReadFrequently: true}});
      context.drawImage(image, 0, 0);
      const {{data}} = context.getImageData(0, 0, image.width, image.height);
      const found = [];
      for (let i = 0; i < data.length; i += 4) {{
        const [r, g, b] = data.subarray(i, i + 3);
        if ({test}) found.push([(i / 4) % image.width, Math.floor(i / 4 / image.width)]);
      }}
      if ("{want}" === "count") return found.length;
      // A place all around which the same holds: within a disc, not on a line.
      const near = new Set(found.map(([x, y]) => y * 65536 + x));
      const inside = found.filter(([x, y]) => [-3, 0, 3].every((dx) => [-3, 0, 3].every((dy) => near.has((y + dy) * 65536 + x + dx))));
      return inside.length ? [0, 1].map((k) => inside.reduce((sum, p) => sum + p[k], 0) / inside.length) : null;
    }})()""")


# Shallow and middling depths are yellow and green; nothing else in the view is.
WORN = "g > b + 25 && g >= r - 40"
# The knob of the plane is of the page's accent, #2f6fb2.
KNOB = "Math.abs(r - 0x2f) < 6 && Math.abs(g - 0x6f) < 6 && Math.abs(b - 0xb2) < 6"


def is_quiet_and_alone(browser, page):
    assert not browser.complaints, browser.complaints
    others = [url for url in browser.requests if url != page.as_uri() and not url.startswith("data:")]
    assert not others, f"the page asked for {others}"


def time_moves_the_depths(browser, page):
    for box in range(1, browser.value("document.querySelectorAll('#shown input').length")):
        if "body" in text(browser, f"#shown label:nth-child({box + 1})"):
            browser.click(f"#shown label:nth-child({box + 1}) input")
    last = int(browser.value("document.getElementById('time').max"))
    assert last >= 10, last
    slide(browser, "#time", 0)
    assert "no wear yet" in text(browser, "#wear-value"), text(browser, "#wear-value")
    before = pixels(browser, WORN)
    assert before == 0, before
    seen = []
    for instant in (last // 4, last):
        slide(browser, "#time", instant)
        depths = arrays(page.parent / f"surface_{instant:04}.vtp")["depth_m"]
        told = length(text(browser, "#wear-value"))
        assert abs(told / max(depths) - 1) < 1e-3, (instant, told, max(depths))
        assert f"instant {instant + 1} of {last + 1}" in text(browser, "#time-value")
        seen.append(pixels(browser, WORN))
    assert 200 < seen[0] < seen[1], seen
    for box in range(1, browser.value("document.querySelectorAll('#shown input').length")):
        if "body" in text(browser, f"#shown label:nth-child({box + 1})"):
            browser.click(f"#shown label:nth-child({box + 1}) input")


def the_section_is_that_of_its_plane(browser, page):
    last = int(browser.value("document.getElementById('time').max"))
    file = arrays(page.parent / f"surface_{last:04}.vtp")
    for axis, name in enumerate("xy"):
        browser.click(f"input[name=axis][value='{axis}']")
        settle(browser)
        for place in (300, 420, 500):
            slide(browser, "#at", place)
            at, told = length(text(browser, "#at-value")), text(browser, "#chart-note")
            pitch = 1e-4
            near = [depth for point, depth in zip(file["Points"], file["depth_m"]) if abs(point[axis] - at) < pitch]
            if max(near) == 0.0:
                assert "not worn here" in told, (name, at, told)
            else:
                assert max(near) / 2 <= length(told) <= max(near) * 1.001, (name, at, told, max(near))
    slide(browser, "#at", 0)
    assert "not worn here" in text(browser, "#chart-note"), text(browser, "#chart-note")
    browser.click("#deepest")
    settle(browser)
    assert abs(length(text(browser, "#chart-note")) / max(file["depth_m"]) - 1) < 0.05
    assert len(browser.value("document.querySelector('#chart .now').getAttribute('d')")) > 1000
    units = browser.value("[...document.querySelectorAll('#chart .axis')].map((label) => label.textContent)")
    assert all(re.fullmatch(r"[xyz], (mm|µm)", unit) for unit in units) and len(units) == 2, units


def a_profile_is_laid_straight(browser, _):
    before = text(browser, "#chart-note")
    browser.click("#straight")
    settle(browser)
    labels = browser.value("[...document.querySelectorAll('#chart .axis')].map((label) => label.textContent)")
    assert re.fullmatch("along the surface, (mm|µm)", labels[0]) and re.fullmatch("depth, (mm|µm)", labels[1]), labels
    assert length(text(browser, "#chart-note")) == length(before), (text(browser, "#chart-note"), before)
    # What was a curve before the wear is a line at no depth.
    heights = browser.value("document.querySelector('#chart .begun').getAttribute('d').match(/[^ ML]+(?=[L]|M|$)/g)")
    assert len(heights) > 10 and len(set(heights)) == 1, set(heights)
    browser.click("#straight")
    settle(browser)


def the_plane_follows_its_knob(browser, _):
    browser.click("input[name=axis][value='1']")
    settle(browser)
    x, y = pixels(browser, KNOB, "middle")
    left, top, _, _ = browser.box(FRAME)
    before, chart = text(browser, "#at-value"), browser.value("document.getElementById('chart').innerHTML")
    browser.mouse("mousePressed", left + x, top + y)
    for step in range(1, 9):
        browser.mouse("mouseMoved", left + x - 6 * step, top + y - 5 * step)
    browser.mouse("mouseReleased", left + x - 48, top + y - 40)
    settle(browser)
    assert text(browser, "#at-value") != before, "the plane stayed"
    assert browser.value("document.getElementById('chart').innerHTML") != chart, "the chart stayed"
    moved = pixels(browser, KNOB, "middle")
    assert abs(moved[0] - x) + abs(moved[1] - y) > 10, (x, y, moved)
    browser.click("#deepest")


def keys_do_what_the_pointer_does(browser, _):
    browser.value("document.getElementById('at').focus()")
    before = text(browser, "#at-value")
    browser.press("ArrowRight", count=3)
    assert text(browser, "#at-value") != before
    browser.value("document.getElementById('view').focus()")
    before = browser.picture(browser.box(FRAME))
    browser.press("ArrowLeft", count=3)
    settle(browser)
    assert browser.picture(browser.box(FRAME)) != before, "the view stayed"
    browser.value("document.activeElement.blur()")


def depth_is_exaggerated(browser, _):
    before = browser.picture(browser.box(FRAME))
    slide(browser, "#exaggeration", 100)
    assert re.fullmatch(r"[\d.]+ times", text(browser, "#exaggeration-value"))
    assert browser.picture(browser.box(FRAME)) != before
    slide(browser, "#exaggeration", 0)
    assert text(browser, "#exaggeration-value") == "true to scale"


def a_hidden_body_is_in_neither_view_nor_chart(browser, _):
    count = "document.querySelectorAll('#chart .body').length"
    before, picture = browser.value(count), browser.picture(browser.box(FRAME))
    ball = browser.value("[...document.querySelectorAll('#shown label')].findIndex((l) => l.textContent.includes('ball'))")
    browser.click(f"#shown label:nth-child({ball + 1}) input")
    settle(browser)
    assert browser.value(count) == before - 1
    assert browser.picture(browser.box(FRAME)) != picture
    browser.click(f"#shown label:nth-child({ball + 1}) input")


def playing_ends_at_the_end(browser, _):
    slide(browser, "#time", browser.value("document.getElementById('time').max"))
    browser.click("#play")
    assert text(browser, "#play") == "Pause"
    browser.wait("document.getElementById('play').textContent === 'Play'")
    assert browser.value("document.getElementById('time').value === document.getElementById('time').max")


def every_control_has_a_name(browser, _):
    tree = browser.call("Accessibility.getFullAXTree")["nodes"]
    roles = {"slider", "button", "checkbox", "radio", "image"}
    controls = [node for node in tree if node.get("role", {}).get("value") in roles and not node.get("ignored")]
    assert len(controls) > 15, len(controls)
    nameless = [node["role"]["value"] for node in controls if not node.get("name", {}).get("value")]
    assert not nameless, nameless


def colours_follow_the_system(browser, page):
    ground = "getComputedStyle(document.body).backgroundColor"
    light = browser.value(ground)
    browser.dark(True)
    settle(browser)
    assert browser.value(ground) != light
    (RUNS / f"{page.parent.name}-dark.png").write_bytes(browser.picture())
    browser.dark(False)


def a_phone_has_no_sideways_scroll(browser, page):
    browser.resize(390, 844, 2, mobile=True)
    browser.open(page, READY)
    width = browser.value("document.documentElement.scrollWidth")
    assert width <= 390, width
    height = browser.value("document.documentElement.scrollHeight")
    (RUNS / f"{page.parent.name}-phone.png").write_bytes(browser.picture([0, 0, 390, height], whole=True))


def the_end_alone_says_so(browser, _):
    assert browser.value("document.getElementById('time').disabled")
    assert browser.value("!document.getElementById('one-instant').hidden")


def a_drum_is_open_and_its_bodies_move(browser, _):
    assert browser.value("document.getElementById('open').checked")
    pictures = set()
    for instant in (0, 2, 4):
        slide(browser, "#time", instant)
        pictures.add(browser.picture(browser.box(FRAME)))
    assert len(pictures) == 3


CHECKS = {
    "plate": [time_moves_the_depths, the_section_is_that_of_its_plane, a_profile_is_laid_straight, the_plane_follows_its_knob,
              keys_do_what_the_pointer_does, depth_is_exaggerated,
              a_hidden_body_is_in_neither_view_nor_chart, playing_ends_at_the_end,
              every_control_has_a_name, colours_follow_the_system],
    "cube": [every_control_has_a_name],
    "stream": [the_end_alone_says_so, a_profile_is_laid_straight],
    "mill": [a_drum_is_open_and_its_bodies_move],
}


def attempt(check, browser, page):
    try:
        check(browser, page)
        said = None
    except (AssertionError, RuntimeError) as error:
        said = str(error) or "failed"
    name = f"{page.parent.name}: {check.__name__.replace('_', ' ')}"
    print(f"{name} .. {'ok' if said is None else 'FAILED: ' + said}", flush=True)
    return said is None


def without_webgl(browser, page):
    browser.open(page, READY)
    assert "needs WebGL" in text(browser, "#no-webgl")
    assert browser.value("document.querySelector('#chart .now').getAttribute('d').length") > 100


def main():
    if not ABRADE.exists():
        sys.exit(f"{ABRADE} is missing: cargo build --release --bin abrade")
    RUNS.mkdir(parents=True, exist_ok=True)
    done = []
    with Browser() as browser:
        for name, checks in CHECKS.items():
            page = view(name)
            browser.requests.clear()
            browser.complaints.clear()
            browser.resize(1440, 900)
            browser.open(page, READY)
            settle(browser)
            (RUNS / f"{name}.png").write_bytes(browser.picture())
            more = [a_phone_has_no_sideways_scroll, is_quiet_and_alone]
            done += [attempt(check, browser, page) for check in checks + more]
    with Browser([flag for flag in FLAGS if "swiftshader" not in flag] + ["--disable-3d-apis"]) as browser:
        done.append(attempt(without_webgl, browser, RUNS / "plate" / "view.html"))
    print(f"{sum(done)} passed, {len(done) - sum(done)} failed")
    return 0 if all(done) else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except NoBrowser as error:
        sys.exit(str(error))
