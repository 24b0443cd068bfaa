#!/usr/bin/env python3
"""Builds the documentation site, opens it from disk in headless Chromium, and searches it.

  check_site.py [--screenshots DIR]

Exit code 0: all passed; 1: a check failed; 2: a wrong request; 77: MkDocs or Chromium is not installed.
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile

from chromium import Chromium, ChromiumError

BUILD = pathlib.Path(__file__).resolve().parents[2] / "docs/site/build.py"
# Words of one page, and the page.
SEARCHES = {"jackknife": "docs/notebook/2026-11-26-covariance-of-one-pose.html",
            "coordinate_scan": "docs/stages/pose_search.html", "rosbag2": "docs/calibrate.html"}

# Types words into the search once it is ready, and returns the addresses of the results once there are some. The theme
# drops its index if words arrive before its worker has answered, within about 0.1 s of loading.
SEARCH = """(async () => {
  const meta = document.querySelector('.md-search-result__meta');
  for (let i = 0; i < 400 && /Initializing/.test(meta.innerText); ++i) {
    await new Promise((done) => setTimeout(done, 50));
  }
  const field = document.querySelector('[data-md-component="search-query"]');
  field.focus();
  field.value = %r;
  field.dispatchEvent(new Event('keyup', {bubbles: true}));
  for (let i = 0; i < 200; ++i) {
    const links = [...document.querySelectorAll('.md-search-result__link')].map((link) => link.href);
    if (links.length) return links;
    await new Promise((done) => setTimeout(done, 50));
  }
  return [];
})()"""


def check(site, browser, screenshots):
    """The faults of the site, one line each."""
    requested, faults = [], []

    def listen(event):
        if event["method"] == "Network.requestWillBeSent":
            requested.append(event["params"]["request"]["url"])
        elif event["method"] in ("Runtime.exceptionThrown", "Log.entryAdded"):
            faults.append(str(event["params"]))

    browser.on_event.append(listen)
    browser.resize(1600, 1000)
    for start in ("index.html", "docs/stages/step.html"):
        for words, page in SEARCHES.items():
            browser.open((site / start).as_uri())
            found = browser.run(SEARCH % words)
            if not any(page in address for address in found):
                faults.append(f"{start}: a search for {words} finds {found}, expected {page}")
    browser.open(found[0])
    if browser.run("document.querySelectorAll('main h1').length") != 1:
        faults.append(f"{found[0]}: expected a page with one heading")
    for page in ("index.html", "gallery.html"):
        for width, scheme in ((1600, "light"), (400, "dark")):
            browser.resize(width, 1000)
            browser.emulate(prefers_color_scheme=scheme)
            browser.run("localStorage.clear()")  # The scheme of the first visit.
            browser.open((site / page).as_uri())
            if not browser.run("[...document.images].every((image) => image.naturalWidth)"):
                faults.append(f"{page}: a picture is not shown")
            if browser.run("document.documentElement.scrollWidth > innerWidth"):
                faults.append(f"{page}: wider than {width} pixels")
            if screenshots:
                browser.screenshot(str(screenshots / f"{page}_{width}_{scheme}.png"))
    return faults + [f"{url}: not a file" for url in requested if not url.startswith(("file:", "data:"))]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--screenshots", type=pathlib.Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        site = pathlib.Path(folder, "site")
        built = subprocess.run([BUILD, site], check=False).returncode
        if built != 0:
            return built
        try:
            with Chromium() as browser:
                faults = check(site, browser, options.screenshots)
        except ChromiumError as error:
            print(error, file=sys.stderr)
            return 77 if "no chromium found" in str(error) else 1
    print(*faults, sep="\n")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
