#!/usr/bin/env python3
"""Checks that links lead somewhere: files and headings of the repository's Markdown, or of a built site.

    tools/links.py              every tracked Markdown file
    tools/links.py FOLDER       every HTML page under FOLDER

Links to other hosts are not followed. A link that leads nowhere is printed with its file and line; the exit status is then 1.
"""

import re
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

ROOT = Path(__file__).resolve().parent.parent
LINK = re.compile(r"\]\(\s*<?([^)\s>]+)>?[^)]*\)")
HEADING = re.compile(r"^#{1,6}\s+(.*?)\s*#*$")
FENCE = re.compile(r"^\s*(```|~~~)")


def slug(heading):
    """The anchor that GitHub and mdBook give a heading."""
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    kept = (c for c in text.strip().lower() if c.isalnum() or c in " -_")
    return "".join(kept).replace(" ", "-")


def markdown(path):
    """The links of a Markdown file with their lines, and its anchors. Links may break over lines."""
    prose, fenced = [], False
    for line in path.read_text(encoding="utf-8").split("\n"):
        fence = FENCE.match(line)
        fenced ^= bool(fence)
        prose.append("" if fenced or fence else line)
    anchors, seen = set(), {}
    for line in prose:
        if heading := HEADING.match(line):
            anchor = slug(heading[1])
            count = seen[anchor] = seen.get(anchor, -1) + 1
            anchors.add(f"{anchor}-{count}" if count else anchor)
    text = re.sub(r"`[^`\n]+`", lambda code: " " * len(code[0]), "\n".join(prose))
    links = [(text.count("\n", 0, found.start(1)) + 1, found[1]) for found in LINK.finditer(text)]
    return links, anchors


class Page(HTMLParser):
    """The links of an HTML page with their lines, and its anchors."""

    def __init__(self, path):
        super().__init__()
        self.links, self.anchors = [], set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.anchors.update(name for name in (given.get("id"), given.get("name")) if name)
        for key in ("href", "src"):
            if given.get(key):
                self.links.append((self.getpos()[0], given[key]))


def html(path):
    page = Page(path)
    return page.links, page.anchors


def broken(files, read):
    """`file:line: link: why` for every link that leads nowhere."""
    pages = {path.resolve(): read(path) for path in files}
    for path, (links, _) in pages.items():
        for line, link in links:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            to = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            why = None
            if not to.exists():
                why = "there is no such file"
            elif parts.fragment and to in pages and unquote(parts.fragment) not in pages[to][1]:
                why = "the file has no such heading"
            if why:
                yield f"{path}:{line}: {link}: {why}"


def main():
    if len(sys.argv) > 2:
        sys.exit("error: found more than one argument, expected a folder or nothing")
    if len(sys.argv) == 2:
        files, read = sorted(Path(sys.argv[1]).rglob("*.html")), html
    else:
        tracked = subprocess.run(
            ["git", "ls-files", "-z", "*.md"], cwd=ROOT, check=True, capture_output=True, text=True
        ).stdout
        files = [ROOT / name for name in tracked.split("\0") if name]
        read = markdown
    if not files:
        sys.exit("error: found no page to check")
    found = list(broken(files, read))
    print("\n".join(found) if found else f"{len(files)} pages: every link leads somewhere")
    sys.exit(bool(found))


if __name__ == "__main__":
    main()
