"""Brings files of the repository into the site, where pages link to them.

A page may link to anything in the repository, as `../scenarios/template.toml`, so that it reads well on its
own. On the site there is a page for each such file, with its text, and one for each such folder, with what
is in it; links are turned to these. Folders of those pages are those of the repository, below `files/`.
"""
import posixpath
import re
from pathlib import Path

from mkdocs.structure.files import File

ROOT = Path(__file__).resolve().parent.parent.parent
DOCS = ROOT / "docs"
FOLDER = "files"
# What is fenced is shown, not read.
FENCE = re.compile(r"^( *)(`{3,}|~{3,}).*?^ *\2[`~]* *$", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"(?<!!)(\]\()([^)\s#]+)(#[^)\s]*)?(\))")
LANGUAGES = {
    ".json": "json",
    ".py": "python",
    ".rs": "rust",
    ".toml": "toml",
    ".urdf": "xml",
}
# Where each page of a file of the repository came from, by its place in the site.
sources = {}


def on_files(files, config):
    """Adds pages for all that is linked, and for what these link to in turn."""
    sources.clear()
    waiting = [file.src_uri for file in files.documentation_pages()]
    while waiting:
        uri = waiting.pop()
        text = text_of(uri)
        for target in linked(uri, text):
            page = page_of(target)
            if page in sources or is_of_the_site(target):
                continue
            sources[page] = target
            waiting.append(page)
            files.append(File.generated(config, page, content=content_of(target)))
    return files


def on_page_markdown(markdown, page, config, files):
    """Turns links to files of the repository to their pages."""
    uri = page.file.src_uri
    if uri in sources:
        # Who searches looks for words about files, not for every line of them.
        page.meta["search"] = {"exclude": True}

    def turned(link):
        target = outside(uri, link[2])
        if target is None:
            return link[0]
        away = posixpath.relpath(page_of(target), posixpath.dirname(uri) or ".")
        # Only headings of a text have places on its page.
        place = link[3] or "" if target.suffix == ".md" else ""
        return f"{link[1]}{away}{place}{link[4]}"

    return "".join(LINK.sub(turned, part) if is_prose else part for is_prose, part in parts(markdown))


def parts(markdown):
    """The text in pieces: whether it is prose, and the piece."""
    at = 0
    for fence in FENCE.finditer(markdown):
        yield True, markdown[at : fence.start()]
        yield False, fence[0]
        at = fence.end()
    yield True, markdown[at:]


def text_of(uri):
    """The text of a page, whichever side it is from."""
    if uri in sources:
        target = sources[uri]
        return target.read_text(encoding="utf-8") if target.suffix == ".md" else content_of(target)
    return (DOCS / uri).read_text(encoding="utf-8")


def linked(uri, markdown):
    """What it links to that is not of the site."""
    for is_prose, part in parts(markdown):
        if is_prose:
            for link in LINK.finditer(part):
                target = outside(uri, link[2])
                if target is not None:
                    yield target


def outside(uri, address):
    """The file or folder of the repository that an address means, if it is outside of docs/."""
    if re.match(r"[a-z]+:", address):
        return None
    page = sources.get(uri, DOCS / uri)
    folder = page if page.is_dir() else page.parent
    target = Path(posixpath.normpath((folder / address).as_posix()))
    if not target.exists() or not target.is_relative_to(ROOT):
        return None
    if is_of_the_site(target) and uri not in sources:
        return None
    return target


def is_of_the_site(target):
    """Whether mkdocs brings it there by itself."""
    return target.is_relative_to(DOCS) and target.suffix != ".py"


def page_of(target):
    """The place in the site of a file or folder of the repository."""
    if is_of_the_site(target):
        return target.relative_to(DOCS).as_posix()
    name = target.relative_to(ROOT).as_posix()
    if target.is_dir():
        return f"{FOLDER}/{name}/index.md"
    return f"{FOLDER}/{name}" if target.suffix == ".md" else f"{FOLDER}/{name}.md"


def content_of(target):
    """The page of a file or folder."""
    name = target.relative_to(ROOT).as_posix()
    if target.is_dir():
        entries = sorted(entry for entry in target.iterdir() if not entry.name.startswith((".", "__")))
        return f"# {name}\n\n" + "".join(f"- [{entry.name}]({entry.name})\n" for entry in entries)
    text = target.read_text(encoding="utf-8")
    if target.suffix == ".md":
        return text
    fence = "`" * 4
    return f"# {target.name}\n\n`{name}`\n\n{fence}{LANGUAGES.get(target.suffix, 'text')}\n{text.rstrip()}\n{fence}\n"
