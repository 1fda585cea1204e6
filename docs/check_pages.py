"""Opens every page of the built site in a headless browser, without a server or a network, on a phone's screen.

    python docs/check_pages.py build/site

Nothing may go wrong in a page's programs, nothing be asked of another place, no page be wider than the screen; the search
finds something. Where there is no Chromium it says so, and that is all.
"""

import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "tests/dhkit"))

from browser import CHROMIUM, Tab  # noqa: E402

WIDTH, HEIGHT = 320, 640  # of a small phone
WORD = "singular"  # is in the site
HEARD = ("Runtime", "Log", "Network", "Page")
LIVE = "document.querySelector('.dhkit-scene')"  # the first one comes alive when it is seen


def said_wrong(event: dict) -> str:
    """What went wrong, of what a browser tells while it shows a page; empty if nothing did."""
    told = event["params"]
    match event["method"]:
        case "Runtime.exceptionThrown":
            details = told["exceptionDetails"]
            return details.get("exception", {}).get("description", details["text"]).partition("\n")[0]
        case "Runtime.consoleAPICalled" if told["type"] in ("error", "assert"):
            return " ".join(str(part.get("value", part.get("description"))) for part in told["args"])
        case "Log.entryAdded" if told["entry"]["level"] == "error":
            return f"{told['entry']['text']} {told['entry'].get('url', '')}".strip()
        case "Network.requestWillBeSent" if not told["request"]["url"].startswith(("file:", "data:", "blob:")):
            return f"it asks for {told['request']['url']}"
    return ""


def visit(tab: Tab, url: str) -> list[str]:
    """What is wrong with a page, in words."""
    tab.events.clear()
    tab.ask("window.left = true")  # the page before may still be there, and complete
    tab.tell("Page.navigate", url=url)
    tab.until("!window.left && document.readyState === 'complete' && location.protocol === 'file:'")
    if tab.ask(f"!!{LIVE}"):
        tab.ask(f"{LIVE}.scrollIntoView()")
        tab.until(f"!!{LIVE}.querySelector('.stage')?.shadowRoot?.querySelector('.label')")
    wide = tab.ask("document.documentElement.scrollWidth")
    found = [f"{wide} pixels wide on a screen of {WIDTH}"] if wide > WIDTH else []
    return list(dict.fromkeys([*filter(None, map(said_wrong, tab.events)), *found]))


def faults(site: Path, word: str = WORD) -> list[str]:
    """What is wrong with a site, a line each."""
    pages = [file for file in sorted(site.rglob("*.html")) if "_static" not in file.parts]
    found = []
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        tab = Tab(Path(profile), WIDTH, HEIGHT)
        try:
            for domain in HEARD:
                tab.tell(f"{domain}.enable")
            for file in pages:
                found += [f"{file.relative_to(site)}: {words}" for words in visit(tab, file.as_uri())]
            if (search := site / "search.html").exists():
                tab.tell("Page.navigate", url=f"{search.as_uri()}?q={word}")
                try:
                    tab.until("document.querySelectorAll('#search-results li').length > 0")
                except AssertionError:
                    found.append(f"search.html: nothing is found for {word!r}")
        finally:
            tab.close()
    return found


def main(folder: str) -> int:
    if CHROMIUM is None:
        print(f"{folder}: no Chromium is installed, the pages have not been opened")
        return 0
    wrong = faults(Path(folder).resolve())
    print(
        "\n".join(wrong) or f"{folder}: every page opens without a fault on a phone, and the search finds something",
        flush=True,
    )
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
