#!/usr/bin/python3
"""Builds the documentation as a static site that opens from disk.

  build.py FOLDER

A missing or dead link is an error. Exit code 0: built; 1: an error in the pages; 2: a wrong request; 77: no MkDocs.
"""

import html
import html.parser
import pathlib
import re
import shutil
import sys
import tempfile
import urllib.parse

SITE = pathlib.Path(__file__).resolve().parent
TREE = SITE.parents[1]
PAGES = ["CONTRIBUTING.md", "CHANGELOG.md", "benchmarks/*.md", "experiments/**/*.md", "docs/*.md", "docs/stages/*.md",
         "docs/notebook/*.md", "docs/example_paper/*.md"]
OTHERS = ["docs/**/pictures/*", "docs/schema/*"]


def files(patterns):
    """The paths in the tree that match, relative to it, in the order of the patterns."""
    return [path.relative_to(TREE) for pattern in patterns for path in sorted(TREE.glob(pattern))]


def title(page):
    """The text of the first heading of a page."""
    return re.search(r"^# (.*)$", (TREE / page).read_text(), re.MULTILINE)[1].replace("`", "")


def pictures():
    """Every picture, as (path, caption, page); of several pages that show it, the first."""
    found = {}
    for page in files(["docs/*.md", "docs/notebook/*.md"]):
        for caption, link in re.findall(r"!\[([^\]]*)\]\(([^)]+)\)", (TREE / page).read_text()):
            path = (TREE / page.parent / link).resolve().relative_to(TREE)
            found.setdefault(path, (caption, page))
    for path in files(["docs/pictures/*"]):
        found.setdefault(path, (path.stem.replace("_", " "), None))
    return [(path, *rest) for path, rest in found.items()]


def gallery(shown):
    """Pictures with their captions and links to their pages, as HTML."""
    figures = []
    for path, caption, page in shown:
        link = f' (<a href="{page.with_suffix(".html")}">{html.escape(title(page))}</a>)' if page else ""
        figures.append(f'<figure><a href="{path}"><img src="{path}" alt=""></a>'
                       f"<figcaption>{html.escape(caption)}{link}</figcaption></figure>")
    return '<div class="gallery">\n' + "\n".join(figures) + "\n</div>\n"


def stage_sources(folder):
    """Copies what the site is made of, and writes its first page and its gallery."""
    for path in files(PAGES + OTHERS):
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(TREE / path, folder / path)
    for page in folder.glob("**/*.md"):
        # Marks for the tests of the pages: "sh setup", "sh samples".
        page.write_text(re.sub(r"^```sh \w+$", "```sh", page.read_text(), flags=re.MULTILINE))
    shown = pictures()
    of_reports = [entry for entry in shown if entry[0].name.startswith("report_")]
    first = of_reports or [entry for entry in shown if entry[0].name == "before_after.png"]
    (folder / "index.md").write_text((SITE / "index.md").read_text().replace("<!-- pictures -->", gallery(first)))
    (folder / "gallery.md").write_text("# Gallery\n\n" + gallery(shown))


def navigation(entries):
    """The navigation of mkdocs.yml, with the pages below the lists of stages and of the notebook."""
    extended = []
    for entry in entries:
        if isinstance(entry, dict):
            (name, target), = entry.items()
            if isinstance(target, list):
                entry = {name: navigation(target)}
            elif target == "docs/stages/README.md":
                pages = files(["docs/stages/[!R]*.md"])
                entry = {name: [target, *({title(page): str(page)} for page in pages)]}
            elif target == "docs/notebook/README.md":
                entry = {name: [target]}
                for line in (TREE / target).read_text().splitlines():
                    if line.startswith("## "):
                        entry[name].append({line[3:]: []})
                    elif link := re.match(r"- \[[-\d]+: (.*)\]\((.*)\)", line):
                        next(iter(entry[name][-1].values())).append({link[1]: f"docs/notebook/{link[2]}"})
        extended.append(entry)
    return extended


class Links(html.parser.HTMLParser):
    """The places of an HTML page and the addresses that it refers to."""

    def __init__(self, page):
        super().__init__()
        self.places, self.addresses = {""}, []
        self.feed(page.read_text())

    def handle_starttag(self, tag, attrs):
        for name, value in attrs:
            if name == "id":
                self.places.add(value)
            elif name in ("href", "src") and tag != "form":
                self.addresses.append(value or "")


def dead_links(site):
    """One line per address in the site that leads nowhere."""
    links = {page: Links(page) for page in sorted(site.glob("**/*.html"))}
    for page, parsed in links.items():
        for address in parsed.addresses:
            parts = urllib.parse.urlsplit(address)
            if parts.scheme or parts.netloc:
                continue
            target = (page.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else page
            if not target.is_file():
                yield f"{page.relative_to(site)}: {address}: no such file in the site"
            elif target in links and parts.fragment not in links[target].places:
                yield f"{page.relative_to(site)}: {address}: no such place in the page"


def main():
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    out = pathlib.Path(sys.argv[1])
    if out.exists() and not (out / "search/search_index.js").is_file():
        print(f"{out}: expected a new folder or a site to replace", file=sys.stderr)
        return 2
    try:
        from mkdocs.commands.build import build
        from mkdocs.config import load_config
        from mkdocs.exceptions import MkDocsException
    except ImportError:
        print("MkDocs is not installed; `make site` installs it (mkdocs-material)", file=sys.stderr)
        return 77
    with tempfile.TemporaryDirectory() as folder:
        pages, site = pathlib.Path(folder, "pages"), pathlib.Path(folder, "site")
        pages.mkdir()
        stage_sources(pages)
        config = load_config(str(SITE / "mkdocs.yml"), docs_dir=str(pages), site_dir=str(site), strict=True)
        config["nav"] = navigation(config["nav"])
        errors = [f"docs/site/mkdocs.yml: nav: expected also {page}"
                  for page in files(PAGES) if f"'{page}'" not in str(config["nav"])]
        try:
            build(config)
        except MkDocsException as error:
            errors.append(str(error))
        else:
            # A page on disk may load scripts, and no other files. Later versions of the theme read `__index`.
            index = (site / "search/search_index.json").read_text()
            (site / "search/search_index.js").write_text(
                f"var __index = {index};\nvar __search = {{index: Promise.resolve(__index)}};\n")
            # It has the addresses of a web server.
            (site / "404.html").unlink()
            errors += dead_links(site)
        if errors:
            print(*errors, sep="\n", file=sys.stderr)
            return 1
        if out.exists():
            shutil.rmtree(out)
        shutil.move(site, out)
    return 0


if __name__ == "__main__":
    sys.exit(main())
