"""Checks of one 3D viewer of a report: its picture must answer to each control.

Uses the functions `check.…` that check_report.py adds to the page.
"""

import time


def check_viewer(check, browser, view):
    name = browser.run(f"""(() => {{ const f = check.figures()[{view}];
        f.scrollIntoView({{block: 'center'}}); return f.dataset.view; }})()""")
    if not browser.run(f"check.hasDrawn(check.figures()[{view}])"):
        check(f"{name} draws", False, "no picture within 20 s")
        return
    picture = f"check.picture(check.figures()[{view}])"
    first = browser.run(picture)
    check(f"{name} hides its fallback", not browser.run(
        f"check.isShown(check.figures()[{view}].querySelector('.fallback'))"))

    def put(control, index=0, value=""):
        return browser.run(f"check.set({view}, '{control}', {index}, '{value}')")

    def count(control):
        return browser.run(f"check.controls({view}, '{control}').length")

    def is_usable(control, index=0):
        return browser.run(f"""(() => {{ const n = check.controls({view}, '{control}')[{index}];
            return !n.disabled && check.isShown(n); }})()""")

    def toggles(control):
        """The switches of that name that do not change the picture, or do not restore it."""
        bad = []
        for i in range(count(control)):
            before = browser.run(picture)["hash"]
            if put(control, i)["hash"] == before or put(control, i)["hash"] != before:
                bad.append(i)
        return bad

    # Rings on the ground are drawn without any sensor.
    for i in range(count("sensor")):
        empty = put("sensor", i)
    for i in range(count("sensor")):
        put("sensor", i)
    check(f"{name} draws points", first["drawn"] > empty["drawn"] + 1000,
          f"{first['drawn']} pixels, {empty['drawn']} without sensors")
    bad = toggles("sensor")
    check(f"{name} switches sensors", not bad, bad or f"{count('sensor')} sensors")
    if count("rival"):
        check(f"{name} shows rivals", not toggles("rival"), f"{count('rival')} rivals")
    pictures = {first["hash"]}
    modes = [i for i in range(count("colour")) if is_usable("colour", i)]
    for i in modes[1:]:
        pictures.add(put("colour", i)["hash"])
    check(f"{name} colour modes differ", len(pictures) == len(modes) and len(modes) >= 2,
          f"{len(modes)} modes")
    check(f"{name} by sensor again", put("colour", 0)["hash"] == first["hash"])
    larger = put("size", 0, 5)
    check(f"{name} point size", larger["drawn"] > 1.3 * first["drawn"], larger["drawn"])
    put("size", 0, 2)
    low, high = browser.run(f"""(() => {{ const n = check.controls({view}, 'low')[0];
        return [Number(n.min), Number(n.max)]; }})()""")
    cut = put("low", 0, low + 0.4 * (high - low))
    check(f"{name} height slice, low end", cut["drawn"] < first["drawn"], cut["drawn"])
    put("low", 0, low)
    cut = put("high", 0, low + 0.4 * (high - low))
    check(f"{name} height slice, high end", cut["hash"] != first["hash"], cut["drawn"])
    check(f"{name} whole height again", put("high", 0, high)["hash"] == first["hash"])
    if is_usable("state"):
        last = int(browser.run(f"check.controls({view}, 'state')[0].max"))
        check(f"{name} steps", put("state", 0, 0)["hash"] != first["hash"] and
              put("state", 0, last)["hash"] == first["hash"], f"{last + 1} states")
        put("blink")
        hashes = set()
        for _ in range(8):
            hashes.add(browser.run(picture)["hash"])
            time.sleep(0.25)
        put("blink")
        check(f"{name} blinks", len(hashes) == 2, f"{len(hashes)} pictures")
        browser.emulate(prefers_reduced_motion="reduce")
        put("state", 0, last)
        put("blink")
        hashes = set()
        for _ in range(8):
            hashes.add(browser.run(picture)["hash"])
            time.sleep(0.25)
        check(f"{name} does not blink by itself with reduced motion",
              len(hashes) == 1 and hashes != {first["hash"]})
        browser.emulate()
        put("state", 0, last)
    hashes = [put("view", i)["hash"] for i in range(count("view"))]
    check(f"{name} views differ", len(set(hashes)) == len(hashes) >= 4, f"{len(hashes)} views")
    check(f"{name} default view again", put("view", 0)["hash"] == first["hash"])
    check_full_screen(check, browser, view, name)
    check_viewer_input(check, browser, view, name, picture, first)


def check_full_screen(check, browser, view, name):
    """Only where the browser offers it."""
    if not browser.run(f"check.isShown(check.controls({view}, 'full')[0])"):
        check.note(f"{name} full screen", "not offered by this browser")
        return
    sizes = browser.run(f"""(async () => {{
        const canvas = check.figures()[{view}].querySelector('canvas');
        const button = check.controls({view}, 'full')[0];
        const wait = () => new Promise((done) => setTimeout(done, 500));
        const sizes = [canvas.clientWidth];
        for (let i = 0; i < 2; ++i) {{
          button.click();
          await wait();
          sizes.push(canvas.clientWidth);
        }}
        return sizes; }})()""")
    check(f"{name} full screen", sizes[1] > sizes[0] == sizes[2], sizes)


def check_viewer_input(check, browser, view, name, picture, first):
    x, y = browser.run(f"""(() => {{ const c = check.figures()[{view}].querySelector('canvas');
        const b = c.getBoundingClientRect();
        return [b.left + b.width / 2, b.top + b.height / 2]; }})()""")
    browser.drag(x, y, 60, 20)
    browser.run("check.frames()")
    # Later keys never return to an earlier picture: each step is compared with the one before.
    seen = [first["hash"], browser.run(picture)["hash"]]
    for key, code, text, modifiers in (("ArrowLeft", 37, "", 0), ("ArrowUp", 38, "", 8),
                                       ("+", 187, "+", 0), ("+", 187, "+", 0), ("-", 189, "-", 0)):
        browser.press(key, code, text, modifiers)
        browser.run("check.frames()")
        seen.append(browser.run(picture)["hash"])
    for kind, points in (("touchStart", [(-40, 0), (40, 0)]), ("touchMove", [(-70, 5), (70, 5)]),
                         ("touchEnd", [])):
        browser.call("Input.dispatchTouchEvent", type=kind, touchPoints=[
            {"x": x + dx, "y": y + dy, "id": i} for i, (dx, dy) in enumerate(points)])
    browser.run("check.frames()")
    seen.append(browser.run(picture)["hash"])
    changed = [a != b for a, b in zip(seen, seen[1:])]
    check(f"{name} mouse, keys and touch move the view", all(changed), changed)
    before = browser.run("scrollY")
    browser.run("document.activeElement.blur()")
    browser.call("Input.dispatchMouseEvent", type="mouseWheel", x=x, y=y, deltaX=0, deltaY=-60)
    time.sleep(0.3)
    check(f"{name} leaves the wheel to the page until clicked",
          browser.run("scrollY") != before or before == 0)
    browser.run(f"check.set({view}, 'view', 0)")
