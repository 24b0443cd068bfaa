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
from check_viewer import check_viewer

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
  // Whether a viewer draws within 20 s.
  hasDrawn: async (figure) => {
    const mark = 'first picture of ' + figure.dataset.view;
    for (let i = 0; i < 400 && !performance.getEntriesByName(mark).length; ++i) {
      await new Promise((done) => setTimeout(done, 50));
    }
    return check.frames().then(() => performance.getEntriesByName(mark).length > 0);
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


def note_first_picture(check, browser, when):
    """Reports when text was painted and the first viewer had drawn."""
    drawn = browser.run("""performance.getEntriesByType('mark')
        .filter((m) => m.name.startsWith('first picture of '))
        .map((m) => Math.round(m.startTime))""")
    text = browser.run("performance.getEntriesByType('paint').map((m) => Math.round(m.startTime))")
    if drawn and text:
        check.note(f"first picture {when}", f"viewer {drawn[0]} ms, text {text[-1]} ms")


def check_charts(check, browser):
    counts = browser.run("[...document.querySelectorAll('figure.chart svg')].map(check.marks)")
    charts = browser.run("document.querySelectorAll('figure.chart').length")
    check("charts have marks", len(counts) >= charts and all(counts), f"{charts} charts, {counts}")
    broken = browser.run("""[...document.images].filter((i) => !i.naturalWidth || !i.alt)
        .map((i) => i.alt || 'without alt')""")
    check("pictures are readable and have alternative text", not broken, broken)


def check_copies(check, browser):
    buttons = browser.run("""[...document.querySelectorAll('button[data-copy]')].map((b) =>
        [b.dataset.copy, (document.getElementById(b.dataset.copy) || {}).textContent])""")
    missing = [name for name, text in buttons if text is None]
    wrong = []
    for i, (name, text) in enumerate(buttons):
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
    text = buttons[0][1].replace("<\\", "<")
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
          const isNumber = head.matches('.number') ||
            original.some((row) => row.cells[c].dataset.value);
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
              [...document.querySelectorAll('main *')].filter((n) =>
                !n.closest('.scroll,.viewer') &&
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
    hidden = browser.run(
        "[...document.images].filter((i) => !check.isShown(i)).map((i) => i.alt)")
    check("all pictures are printed", not hidden, hidden)
    shown = browser.run("""[...document.querySelectorAll('canvas,nav,button[data-copy],.viewer')]
        .filter(check.isShown).length""")
    check("no controls are printed", shown == 0, shown or "")
    browser.resize(688, 1000)  # A4 within margins of 14 mm
    browser.run("check.frames()")
    width = browser.run("document.documentElement.scrollWidth")
    check("the printed page is not too wide", width <= 688, f"{width} px")
    if screenshots:
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
            ![...f.querySelectorAll('.fallback img')].every(check.isShown))
            .map((f) => f.dataset.view)""")
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
        note_first_picture(check, browser, "in a fresh browser")
        check_tables(check, browser)
        check_copies(check, browser)
        check_layout(check, browser, screenshots, stem)
        check_paper(check, browser, screenshots, stem)
        check_keyboard(check, browser)
        others = [each for each in watch.requests if each != url]
        check("no network request", not others, others)
        check("no errors in the console", not watch.errors, watch.errors)
        check("scripts of others do not run", browser.run("""(() => {
            const script = document.createElement('script');
            script.textContent = 'window.hasRun = true';
            document.body.append(script);
            return window.hasRun !== true; })()"""))
        open_report(browser, url)
        if browser.run("check.figures().length"):
            browser.run("check.hasDrawn(check.figures()[0])")
            note_first_picture(check, browser, "when loaded again")
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
