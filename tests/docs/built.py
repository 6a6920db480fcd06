"""What must hold of the built site: nothing comes from elsewhere, and every link leads somewhere."""
import re
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

#: Attributes that a browser follows by itself.
LOADED = {
    "audio": ["src"],
    "embed": ["src"],
    "iframe": ["src"],
    "img": ["src", "srcset"],
    "link": ["href"],
    "object": ["data"],
    "script": ["src"],
    "source": ["src", "srcset"],
    "video": ["src", "poster"],
}
#: Links of a head that name a page and load nothing.
ONLY_NAMED = {"canonical", "next", "prev", "author", "license"}
STYLE = re.compile(r"""url\(\s*["']?((?:https?:)?//[^)"']*)|@import\s+["']((?:https?:)?//[^"']*)""")


class Page(HTMLParser):
    """What a page loads, where it leads, and the places in it."""

    def __init__(self, text):
        super().__init__()
        self.loaded, self.links, self.places, self.styles = [], [], set(), []
        self._in_style = False
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self._in_style = tag == "style"
        self.places.update(given[name] for name in ("id", "name") if given.get(name))
        if given.get("style"):
            self.styles.append(given["style"])
        for name in LOADED.get(tag, []):
            if given.get(name) and not ONLY_NAMED & set((given.get("rel") or "").split()):
                self.loaded.append(given[name])
        if tag == "a" and given.get("href"):
            self.links.append(given["href"])

    def handle_data(self, data):
        if self._in_style:
            self.styles.append(data)

    def handle_endtag(self, tag):
        self._in_style = False


def mistakes(site):
    """A sentence for each mistake in the site."""
    site = Path(site).resolve()
    pages = {path: Page(path.read_text(encoding="utf-8")) for path in sorted(site.rglob("*.html"))}
    for path, page in pages.items():
        name = path.relative_to(site)
        for address in page.loaded:
            if is_elsewhere(address):
                yield f"{name}: loads {address} from elsewhere"
            elif wrong := leads_nowhere(path, address, pages, site):
                yield f"{name}: {wrong}"
        for address in page.links:
            if not urlsplit(address).scheme and (wrong := leads_nowhere(path, address, pages, site)):
                yield f"{name}: {wrong}"
        for style in page.styles:
            yield from (f"{name}: its style loads {address}" for address in from_elsewhere(style))
    for path in sorted(site.rglob("*.css")):
        for address in from_elsewhere(path.read_text(encoding="utf-8")):
            yield f"{path.relative_to(site)}: loads {address} from elsewhere"


def is_elsewhere(address):
    parts = urlsplit(address)
    return bool(parts.netloc) or parts.scheme not in ("", "data")


def from_elsewhere(style):
    return [first or second for first, second in STYLE.findall(style)]


def leads_nowhere(path, address, pages, site):
    """What is wrong with an address within the site, if anything is."""
    parts = urlsplit(address)
    if parts.scheme == "data":
        return None
    # The page that is shown where there is none knows no folder.
    if parts.path.startswith("/"):
        target = site / unquote(parts.path).lstrip("/")
    else:
        target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
    if target.is_dir():
        target = target / "index.html"
    if not target.is_file() or not target.is_relative_to(site):
        return f"there is no {address}"
    if parts.fragment and target in pages and unquote(parts.fragment) not in pages[target].places:
        return f"{address} names a place that is not there"
    return None
