#!/usr/bin/env python3
"""Opens a report.html in headless Chromium and checks what a reader sees and does.

  check_report.py REPORT.html [--screenshots DIR]

Prints one line per check. Exit code 0: all passed; 1: a check failed; 2: a wrong request.
"""

import argparse
import pathlib
import re
import sys
import time

from chromium import WITH_WEBGL, WITHOUT_WEBGL, Chromium, ChromiumError

# Functions of the page under test. A chart's background and grid are not marks.
HELPERS = r"""
window.check = {
  frames: () => new Promise((done) =>
    requestAnimationFrame(() => requestAnimationFrame(() => done(true)))),
  // The number of pixels of a canvas that differ from its background, and a hash of them all.
  picture: (figure) => {
    const canvas = figure.querySelector('canvas');
    const gl = canvas.getContext('webgl');
    const w = gl.drawingBufferWidth, h = gl.drawingBufferHeight;
    const pixels = new Uint8Array(4 * w * h);
    gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    const words = new Uint32Array(pixels.buffer);
    const counts = new Map();
    let hash = 17;
    for (const word of words) {
      counts.set(word, (counts.get(word) || 0) + 1);
      hash = (Math.imul(hash, 31) + word) | 0;
    }
    return {drawn: words.length - Math.max(...counts.values()), colours: counts.size, hash};
  },
  figures: () => [...document.querySelectorAll('figure.cloud-view[data-view]')],
  controls: (view, name) =>
    [...check.figures()[view].querySelectorAll(`[data-control="${name}"]`)],
  // Sets a control as a user would, and returns the picture.
  set: async (view, name, index, value) => {
    const node = check.controls(view, name)[index];
    if (node.type === 'range') {
      node.value = value;
      node.dispatchEvent(new Event('input', {bubbles: true}));
    } else {
      node.click();
    }
    await check.frames();
    return check.picture(check.figures()[view]);
  },
  isShown: (node) => node.checkVisibility({visibilityProperty: true}) &&
    node.getBoundingClientRect().width > 0,
  marks: (svg) => [...svg.querySelectorAll('path,line,rect,circle,polyline,polygon')]
    .filter((node) => !node.getAttribute('class') ||
      !/(^|[-_ ])(page|grid)($| )/.test(node.getAttribute('class')))
    .filter((node) => { const b = node.getBBox(); return b.width > 0 || b.height > 0; }).length,
};
"""


class Checks:
    def __init__(self):
        self.failed = 0

    def __call__(self, name, is_right, detail=""):
        self.failed += not is_right
        print(f"{'ok  ' if is_right else 'FAIL'} {name}{': ' + str(detail) if detail else ''}",
              flush=True)

    def note(self, name, detail):
        print(f"note {name}: {detail}", flush=True)


class Watch:
    """Collects the errors, dialogs and requests of a browser."""

    def __init__(self, browser):
        self.errors = []
        self.requests = []
        self.browser = browser
        browser.on_event.append(self.see)

    def see(self, event):
        parameters = event.get("params", {})
        method = event["method"]
        if method == "Runtime.exceptionThrown":
            details = parameters["exceptionDetails"]
            self.errors.append(details.get("exception", {}).get("description", details["text"]))
        elif method == "Runtime.consoleAPICalled" and parameters["type"] in ("error", "warning"):
            self.errors.append(str([each.get("value") or each.get("description")
                                    for each in parameters["args"]]))
        elif method == "Log.entryAdded" and parameters["entry"]["level"] == "error":
            self.errors.append(parameters["entry"]["text"])
        elif method == "Page.javascriptDialogOpening":
            self.errors.append("a dialog opened: " + parameters["message"])
        elif method == "Network.requestWillBeSent":
            url = parameters["request"]["url"]
            if not url.startswith(("data:", "about:", "blob:")):
                self.requests.append(url)


def open_report(browser, url):
    browser.open(url)
    browser.run(HELPERS)
    browser.run("check.frames()")


def check_charts(check, browser):
    counts = browser.run("[...document.querySelectorAll('figure.chart svg')].map(check.marks)")
    charts = browser.run("document.querySelectorAll('figure.chart').length")
    check("charts have marks", len(counts) >= charts and all(counts), f"{charts} charts, {counts}")
    broken = browser.run("""[...document.images].filter((i) => !i.naturalWidth || !i.alt)
        .map((i) => i.alt || 'without alt')""")
    check("pictures are readable and have alternative text", not broken, broken)


def check_viewer(check, browser, view):
    name = browser.run(f"""(() => {{ const f = check.figures()[{view}];
        f.scrollIntoView({{block: 'center'}}); return f.dataset.view; }})()""")
    deadline = time.monotonic() + 20
    mark = f"performance.getEntriesByName('first picture of {name}').length"
    while not browser.run(mark) and time.monotonic() < deadline:
        time.sleep(0.05)
    browser.run("check.frames()")
    if not browser.run(mark):
        check(f"{name} draws", False, "no picture within 20 s")
        return
    picture = f"check.picture(check.figures()[{view}])"
    first = browser.run(picture)
    check(f"{name} draws points", first["drawn"] > 1000 and first["colours"] > 2, first)
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
    check_viewer_input(check, browser, view, name, picture, first)


def check_viewer_input(check, browser, view, name, picture, first):
    x, y = browser.run(f"""(() => {{ const c = check.figures()[{view}].querySelector('canvas');
        const b = c.getBoundingClientRect();
        return [b.left + b.width / 2, b.top + b.height / 2]; }})()""")
    browser.drag(x, y, 60, 20)
    browser.run("check.frames()")
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
    # Zooming in twice and out once returns to an earlier picture, up to rounding.
    changed = [a != b for a, b in zip(seen, seen[1:])]
    check(f"{name} mouse, keys and touch move the view", all(changed), changed)
    before = browser.run("scrollY")
    browser.run("document.activeElement.blur()")
    browser.call("Input.dispatchMouseEvent", type="mouseWheel", x=x, y=y, deltaX=0, deltaY=-60)
    time.sleep(0.3)
    check(f"{name} leaves the wheel to the page until clicked",
          browser.run("scrollY") != before or before == 0)
    browser.run(f"check.set({view}, 'view', 0)")


def check_copies(check, browser):
    buttons = browser.run("""[...document.querySelectorAll('button[data-copy]')].map((b) =>
        [b.dataset.copy, b.textContent, (document.getElementById(b.dataset.copy) || {}).textContent])""")
    missing = [name for name, _, text in buttons if text is None]
    wrong = []
    for i, (name, _, text) in enumerate(buttons):
        if text is None:
            continue
        copied = browser.run(f"""(async () => {{
            document.querySelectorAll('button[data-copy]')[{i}].click();
            await new Promise((done) => setTimeout(done, 30));
            const area = document.querySelector('textarea.by-hand');
            return area ? area.value : navigator.clipboard.readText(); }})()""")
        if copied != text.replace("<\\", "<"):
            wrong.append(name)
    check("copy buttons have their texts", not missing, missing or f"{len(buttons)} buttons")
    check("copy buttons copy", not wrong, wrong)
    if not buttons:
        return
    # Without the clipboard and without the old command the text is shown, selected.
    area = browser.run("""(async () => {
        const write = navigator.clipboard.writeText;
        navigator.clipboard.writeText = () => Promise.reject(new Error('refused'));
        document.execCommand = () => false;
        document.querySelector('button[data-copy]').click();
        await new Promise((done) => setTimeout(done, 50));
        const area = document.querySelector('textarea.by-hand');
        navigator.clipboard.writeText = write;
        delete document.execCommand;
        const found = area && [area.value, area.selectionEnd - area.selectionStart];
        if (area) area.remove();
        return found; })()""")
    text = buttons[0][2].replace("<\\", "<")
    check("copying by hand is offered when the clipboard refuses",
          area == [text, len(text.encode("utf-16-le")) // 2], "" if area else "no text shown")


def check_tables(check, browser):
    wrong = browser.run("""(() => {
      const wrong = [];
      document.querySelectorAll('table.sortable').forEach((table, t) => {
        const rows = () => [...table.tBodies[0].rows];
        const original = rows();
        [...table.tHead.rows[table.tHead.rows.length - 1].cells].forEach((head, c) => {
          const number = (row) => parseFloat(row.cells[c].dataset.value === undefined
            ? row.cells[c].textContent.replace('−', '-') : row.cells[c].dataset.value);
          const isNumber = head.matches('.number') || original.some((r) => r.cells[c].dataset.value);
          const isSorted = (sign) => {
            if (!isNumber) return true;
            const values = rows().map(number);
            const known = values.filter((v) => !Number.isNaN(v));
            return values.slice(0, known.length).every((v) => !Number.isNaN(v)) &&
              known.every((v, i) => i === 0 || sign * (v - known[i - 1]) >= 0);
          };
          const click = (state) => {
            head.querySelector('button').click();
            return head.getAttribute('aria-sort') === state;
          };
          const isRight = click('ascending') && isSorted(1) && click('descending') &&
            isSorted(-1) && click(null) && rows().every((row, i) => row === original[i]);
          if (!isRight) wrong.push(`table ${t} column ${c}`);
        });
      });
      return wrong; })()""")
    tables = browser.run("document.querySelectorAll('table.sortable').length")
    check("tables sort", not wrong, wrong or f"{tables} tables")


def check_keyboard(check, browser):
    count = browser.run("""(() => {
      document.querySelectorAll('details').forEach((d) => { d.open = true; });
      if (document.activeElement) document.activeElement.blur();
      window.scrollTo(0, 0);
      const seen = new Set(), unclear = new Set();
      window.reached = {seen, unclear};
      document.addEventListener('focusin', (event) => {
        seen.add(event.target);
        if (getComputedStyle(event.target).outlineStyle === 'none') unclear.add(event.target);
      });
      const wanted = [...document.querySelectorAll(
        'a[href],button,input,select,summary,canvas,[tabindex="0"]')].filter((node) =>
        check.isShown(node) && !node.disabled && !(node.type === 'radio' && !node.checked));
      window.reached.wanted = wanted;
      return wanted.length; })()""")
    for _ in range(count + 30):
        browser.press("Tab", 9)
    missed, unclear = browser.run("""[
      reached.wanted.filter((n) => !reached.seen.has(n)).map((n) => n.outerHTML.slice(0, 80)),
      [...reached.unclear].map((n) => n.outerHTML.slice(0, 80))]""")
    check("all controls are reached by keyboard", not missed, missed or f"{count} controls")
    check("the focus is visible", not unclear, unclear)
    links = browser.run("""[...document.querySelectorAll('nav a')].filter((a) =>
        !document.getElementById(decodeURIComponent(a.hash.slice(1)))).map((a) => a.hash)""")
    check("navigation leads to sections", not links, links)


def check_layout(check, browser, screenshots, stem):
    for scheme in ("light", "dark"):
        browser.emulate(prefers_color_scheme=scheme)
        for width, height in ((400, 800), (1600, 1000)):
            browser.resize(width, height, is_mobile=width < 500)
            browser.run("window.scrollTo(0, 0)")
            time.sleep(0.2)
            browser.run("check.frames()")
            wide = browser.run("""[document.documentElement.scrollWidth, innerWidth,
              [...document.querySelectorAll('main *')].filter((n) => !n.closest('.scroll,.viewer') &&
                n.getBoundingClientRect().right > document.documentElement.clientWidth + 1)
                .slice(0, 3).map((n) => n.outerHTML.slice(0, 80))]""")
            check(f"no sideways scrolling, {scheme}, {width} px", wide[0] <= width, wide)
            background = browser.run("getComputedStyle(document.body).backgroundColor")
            is_dark = sum(map(int, re.findall(r"\d+", background)[:3])) < 300
            check(f"page is {scheme}, {width} px", is_dark == (scheme == "dark"), background)
            if screenshots:
                browser.screenshot(screenshots / f"{stem}_{scheme}_{width}.png", whole_page=True)
    browser.emulate()
    browser.resize(1280, 900)


def check_paper(check, browser, screenshots, stem):
    browser.emulate(media="print")
    browser.run("check.frames()")
    hidden = browser.run("""[...document.images].filter((i) => !check.isShown(i)).map((i) => i.alt)""")
    check("all pictures are printed", not hidden, hidden)
    shown = browser.run("""[...document.querySelectorAll('canvas,nav,button[data-copy],.viewer')]
        .filter(check.isShown).length""")
    check("no controls are printed", shown == 0, shown or "")
    if screenshots:
        browser.resize(760, 1000)
        browser.screenshot(screenshots / f"{stem}_print.png", whole_page=True)
        browser.resize(1280, 900)
    browser.emulate()
    pdf = browser.pdf()
    distinct = browser.run("new Set([...document.images].map((i) => i.src)).size")
    images = len(re.findall(rb"/Subtype\s*/Image", pdf))
    pages = len(re.findall(rb"/Type\s*/Page\b", pdf))
    check("the PDF has its pictures", images >= distinct,
          f"{images} images for {distinct}, {pages} pages, {len(pdf) // 1024} KiB")
    if screenshots:
        (screenshots / f"{stem}.pdf").write_bytes(pdf)


def check_without_webgl(check, url, screenshots, stem):
    with Chromium(WITHOUT_WEBGL) as browser:
        watch = Watch(browser)
        browser.resize(1280, 900)
        open_report(browser, url)
        views = browser.run("check.figures().length")
        for view in range(views):
            browser.run(f"check.figures()[{view}].scrollIntoView()")
            browser.run("check.frames()")
        bad = browser.run("""check.figures().filter((f) => f.querySelector('canvas') ||
            !f.querySelector('.fallback img') ||
            ![...f.querySelectorAll('.fallback img')].every(check.isShown)).map((f) => f.dataset.view)""")
        check("without WebGL pictures take its place", not bad, bad or f"{views} views")
        check("without WebGL no errors", not watch.errors, watch.errors)
        if screenshots:
            browser.screenshot(screenshots / f"{stem}_without_webgl.png", whole_page=True)


def check_report(path, screenshots):
    check = Checks()
    url, stem = path.as_uri(), path.stem
    with Chromium(WITH_WEBGL) as browser:
        watch = Watch(browser)
        browser.call("Browser.grantPermissions",
                     permissions=["clipboardReadWrite", "clipboardSanitizedWrite"])
        browser.resize(1280, 900)
        open_report(browser, url)
        check_charts(check, browser)
        for view in range(browser.run("check.figures().length")):
            check_viewer(check, browser, view)
        first = browser.run("""performance.getEntriesByType('mark')
            .filter((m) => m.name.startsWith('first picture of ')).map((m) => Math.round(m.startTime))""")
        if first:
            check.note("first picture of the first viewer", f"{first[0]} ms after the navigation")
        check_tables(check, browser)
        check_copies(check, browser)
        check_layout(check, browser, screenshots, stem)
        check_paper(check, browser, screenshots, stem)
        check_keyboard(check, browser)
        others = [each for each in watch.requests if each != url]
        check("no network request", not others, others)
        check("no errors in the console", not watch.errors, watch.errors)
    check_without_webgl(check, url, screenshots, stem)
    return check.failed


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("report", type=pathlib.Path)
    parser.add_argument("--screenshots", type=pathlib.Path, metavar="DIR")
    options = parser.parse_args()
    if not options.report.is_file():
        parser.error(f"{options.report}: no such file")
    if options.screenshots:
        options.screenshots.mkdir(parents=True, exist_ok=True)
    try:
        failed = check_report(options.report.resolve(), options.screenshots)
    except ChromiumError as error:
        print(f"FAIL the browser: {error}")
        failed = 1
    print(f"{failed} checks failed" if failed else "all checks passed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
