"""Fenced snippets of Markdown pages, and what the comment above each says of it.

    <!-- run -->                    Python, TOML, console: it is run; Python goes on in the page's namespace
    <!-- run: new -->               Python: in a namespace of its own, which later snippets share
    <!-- run: NAME.toml -->         TOML: saved under that name first
    <!-- run: NAME.toml above X --> TOML: put into that file, above the task X
    <!-- run: beside conik ... -->  Python: while this command runs, with `page`, the address that it prints
    <!-- prints -->                 text: all that the Python snippet before printed
    <!-- from PATH -->              its lines stand in this file of the repository, one after the other
    <!-- not run: REASON -->        it is not
"""
import re
import textwrap
from dataclasses import dataclass
from pathlib import Path

LANGUAGES = ("python", "toml", "rust", "console")
FENCE = re.compile(
    r"(?:^ *<!-- (?P<mark>[^\n]*?) -->\n)?^(?P<indent> *)```(?P<language>\w*)\n(?P<text>.*?)^(?P=indent)```$",
    re.MULTILINE | re.DOTALL,
)


@dataclass
class Snippet:
    """One fenced block."""

    page: Path
    #: Line of its first line of text, from 1.
    line: int
    language: str
    #: What the comment says: "run", "prints", "from", "not run", or nothing.
    mark: str
    #: What follows it.
    detail: str
    text: str

    @property
    def place(self):
        return f"{self.page.name}:{self.line}"


def read(page):
    """The snippets of a page, from top to bottom."""
    text = page.read_text(encoding="utf-8")
    found = []
    for match in FENCE.finditer(text):
        line = text.count("\n", 0, match.start("text")) + 1
        mark, detail = match["mark"] or "", ""
        if parts := re.fullmatch(r"(run|not run): (.*)|(from) (.*)", mark):
            mark, detail = parts[1] or parts[3], parts[2] or parts[4]
        found.append(Snippet(page, line, match["language"], mark, detail, textwrap.dedent(match["text"])))
    return found


def missing_marks(snippets):
    """What is wrong with the comments above snippets of a page that must have them all."""
    for snippet in snippets:
        if snippet.language in LANGUAGES and snippet.mark not in ("run", "from", "not run"):
            yield f"{snippet.place}: {snippet.language} that nobody runs; mark it, as tests/docs/snippets.py says"
        elif snippet.mark and not snippet.language:
            yield f"{snippet.place}: a marked snippet needs a language"


def stands_in(snippet, root):
    """What is wrong with a snippet that is said to stand in a file."""
    path = root / snippet.detail
    if not path.is_file():
        return f"{snippet.place}: there is no {snippet.detail}"
    wanted = plain(snippet.text.splitlines())
    lines = plain(path.read_text(encoding="utf-8").splitlines())
    if any(lines[at : at + len(wanted)] == wanted for at in range(len(lines))):
        return None
    return f"{snippet.place}: these lines do not stand in {snippet.detail}"


def plain(lines):
    """Lines as they are without indentation, marks of comments and what documentation hides."""
    shown = [re.sub(r"^\s*(//[/!]\s?)?", "", line).strip() for line in lines]
    return [line for line in shown if line and not line.startswith("# ")]


def scenario(snippet, folder):
    """The text of a TOML snippet, after saving it in the folder if its comment says so."""
    name, _, above = snippet.detail.partition(" above ")
    if not name:
        return snippet.text
    text = snippet.text
    if above:
        before = (folder / name).read_text(encoding="utf-8")
        at = before.index(f'[[task]]\nname = "{above}"\n')
        text = f"{before[:at]}{text}\n{before[at:]}"
    (folder / name).write_text(text, encoding="utf-8")
    return text
