"""Checks the built site: every link inside it ends somewhere, nothing is fetched from elsewhere, no page is too heavy.

    python docs/check_links.py build/site

Links to other sites are looked at by their form only.
"""

import re
import sys
from dataclasses import dataclass, field
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

PAGE_BYTES = 3_000_000
LINKED = {"a": "href", "area": "href"}
FETCHED = {
    "img": "src",
    "script": "src",
    "link": "href",
    "source": "src",
    "iframe": "src",
    "video": "src",
    "audio": "src",
}
_IN_STYLES = re.compile(r"""(?:url\(\s*["']?|@import\s+["'])((?:https?:)?//[^"')\s]+)""")
_IN_SCRIPTS = re.compile(r"""(?:\bimport\s*\(?|\bfrom|\bfetch\(|\.src\s*=)\s*["'`]((?:https?:)?//[^"'`]+)""")


@dataclass
class Page(HTMLParser):
    """What a page links to, what it fetches, and its anchors."""

    links: list[str] = field(default_factory=list)
    fetched: list[str] = field(default_factory=list)
    anchors: set[str] = field(default_factory=set)

    def __post_init__(self) -> None:
        super().__init__()

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        given = {name: value or "" for name, value in attributes}
        self.anchors |= {given[name] for name in ("id", "name") if name in given}
        if LINKED.get(tag) in given:
            self.links.append(given[LINKED[tag]])
        if FETCHED.get(tag) in given and given.get("rel") not in (
            "canonical",
            "search",
            "index",
            "next",
            "prev",
            "author",
        ):
            self.fetched.append(given[FETCHED[tag]])


def read(file: Path) -> Page:
    page = Page()
    page.feed(file.read_text(encoding="utf-8"))
    return page


def faults_of_form(link: str) -> str:
    """What is wrong with the form of a link to another site; empty if nothing is."""
    parts = urlsplit(link)
    if parts.scheme == "mailto":
        return "" if "@" in parts.path else "no address"
    if parts.scheme not in ("http", "https"):
        return "a scheme that browsers do not open"
    return "" if re.fullmatch(r"[\w.-]+\.\w{2,}(:\d+)?", parts.netloc) else "no host"


def faults(site: Path) -> list[str]:
    """What is wrong with a site, a line each."""
    pages = {file: read(file) for file in sorted(site.rglob("*.html")) if "_static" not in file.parts}
    found = []

    def say(file: Path, words: str) -> None:
        found.append(f"{file.relative_to(site)}: {words}")

    def follow(file: Path, link: str) -> None:
        parts = urlsplit(link)
        target = (file.parent / unquote(parts.path)).resolve() if parts.path else file
        target = target / "index.html" if target.is_dir() else target
        if not target.is_relative_to(site) or not target.is_file():
            say(file, f"{link} leads nowhere")
        elif parts.fragment and target in pages and unquote(parts.fragment) not in pages[target].anchors:
            say(file, f"{link}: the page has no such place")

    for file, page in pages.items():
        if (size := file.stat().st_size) > PAGE_BYTES:
            say(file, f"{size / 1e6:.1f} MB, more than {PAGE_BYTES / 1e6:.0f}")
        for link in filter(lambda link: link not in ("", "#"), page.links):
            if urlsplit(link).scheme or link.startswith("//"):
                if fault := faults_of_form(link):
                    say(file, f"{link}: {fault}")
            else:
                follow(file, link)
        for link in page.fetched:
            if link.startswith(("http:", "https:", "//")):
                say(file, f"{link} is fetched from another server")
            elif not link.startswith("data:"):
                follow(file, link)
    for pattern, kind in ((_IN_STYLES, "css"), (_IN_SCRIPTS, "js")):
        for file in sorted(site.rglob(f"*.{kind}")):
            for link in pattern.findall(file.read_text(encoding="utf-8")):
                say(file, f"{link} is fetched from another server")
    return found


def main(folder: str) -> int:
    site = Path(folder).resolve()
    if not (site / "index.html").is_file():
        print(f"{folder}: no site is there; run: make site", file=sys.stderr)
        return 1
    wrong = faults(site)
    print("\n".join(wrong) or f"{folder}: every link ends somewhere, nothing comes from elsewhere", flush=True)
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
