#!/usr/bin/env python3
"""Builds the site from docs/ and robots/ with mdBook, and checks its links.

    tools/site.py                      into target/site/book
    tools/site.py --page FILE          with the page that web/build made
    tools/site.py --source URL         links into the sources lead to URL/<path>; without it they are text
    tools/site.py --mdbook PROGRAM     this mdBook [default: the one on PATH, or MDBOOK from crates.io, built into target/tools]

docs/SUMMARY.md is the table of contents. A page for each effect is cut from docs/effects.md, which a test compares with the
catalogue; a page for each robot is its file in robots/arms with the row of robots/README.md. docs/ is not written to.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path, PurePosixPath

from links import FENCE, broken, html

ROOT = Path(__file__).resolve().parent.parent
TARGET = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")).resolve()
MDBOOK = "0.5.4"

# Pages that stand elsewhere in the repository, and what they are called on the site.
ELSEWHERE = {
    "robots/README.md": "robots.md",
    "CHANGELOG.md": "changes.md",
    "CONTRIBUTING.md": "contributing.md",
    "SECURITY.md": "security.md",
    "README.md": "index.md",
}
LINK = re.compile(r"(!?)\[([^\]]*)\]\(([^)\s]+)\)")


def on_site(path):
    """Where a file of the repository stands on the site, if it does."""
    if path in ELSEWHERE:
        return ELSEWHERE[path]
    return path.removeprefix("docs/") if path.startswith("docs/") and (ROOT / path).is_file() else None


def relinked(text, page, source):
    """The Markdown of the repository's file `page`, with links that hold on the site."""

    def link(found):
        mark, words, to = found.groups()
        if re.match(r"[a-z]+:|#", to):
            return found[0]
        path, _, fragment = to.partition("#")
        path = os.path.normpath(PurePosixPath(page).parent / path)
        if (there := on_site(path)) is not None:
            there = os.path.relpath(there, PurePosixPath(on_site(page)).parent)
            return f"{mark}[{words}]({there}{'#' + fragment if fragment else ''})"
        if source:
            return f"{mark}[{words}]({source.rstrip('/')}/{path})"
        return words if words.strip("`") == path else f"{words} (`{path}`)"

    # Links may break over lines; code keeps its brackets.
    pieces, prose, fenced = [], [], False
    for line in text.split("\n"):
        fence = bool(FENCE.match(line))
        if (fence and not fenced) or not (fence or fenced):
            prose.append(line)
        if fence and not fenced:
            pieces.append(LINK.sub(link, "\n".join(prose[:-1] + [""])) if prose[:-1] else "")
            prose = []
        if fence or fenced:
            pieces.append(line + "\n")
        fenced ^= fence
    return "".join(pieces) + LINK.sub(link, "\n".join(prose))


def effects(pages):
    """Cuts the page of all effects into one each; yields their titles and names."""
    text = pages["effects.md"]
    head, *sections = re.split(r"^## ", text, flags=re.M)
    named = [section.split("\n", 1) for section in sections]
    rows = []
    for name, body in named:
        # The first sentence that does not say where the effect is seen.
        said = next(line for line in body.splitlines() if line and not line.startswith(("|", "In the ")))
        rows.append(f"| [`{name}`](effects/{name}.md) | {said} |")
        for other, _ in named:
            if other != name:
                body = body.replace(f"`{other}`", f"[`{other}`]({other}.md)")
        pages[f"effects/{name}.md"] = f"# {name}\n{body.rstrip()}\n\n`stiffarm effects {name}` prints this page.\n"
        yield name, f"effects/{name}.md"
    pages["effects.md"] = head + "\n| effect | what the arm does |\n|---|---|\n" + "\n".join(rows) + "\n"


def robots(pages):
    """Writes a page for each robot file; yields their titles and names."""
    rows = [line for line in pages["robots.md"].splitlines() if line.startswith("|")]
    heads = [cell.strip() for cell in rows[0].strip("|").split("|")]
    table = {}
    for row in rows:
        cells = [cell.strip() for cell in row.strip("|").split("|")]
        table[cells[0].strip("`")] = cells
    for file in sorted((ROOT / "robots/arms").glob("*.toml")):
        name, text = file.stem, file.read_text(encoding="utf-8")
        if name not in table:
            sys.exit(f"error: robots/README.md has no row `{name}`, and robots/arms/{name}.toml is there")
        facts = "\n".join(f"| {head} | {cell} |" for head, cell in list(zip(heads, table[name]))[2:])
        use = f"stiffarm generate {name} --emit c\n"
        if "symbolic" not in table[name][1]:
            use = f"stiffarm diagnose {name} measurements.csv\n{use}"
        pages[f"robots/{name}.md"] = (
            f"# {tomllib.loads(text)['name']}\n\n| | |\n|---|---|\n| id | `{name}` |\n{facts}\n\n```sh\n{use}```\n\n"
            f"The robot file, with the source of every number:\n\n```toml\n{text.rstrip()}\n```\n"
        )
        pages["robots.md"] = pages["robots.md"].replace(f"| `{name}` |", f"| [`{name}`](robots/{name}.md) |")
        yield name, f"robots/{name}.md"


def lay_out(folder, source, page):
    """Writes mdBook's input; `page` is the one that web/build made, if it is to be there."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(ROOT / "docs", folder / "src", ignore=shutil.ignore_patterns("*.md", "book.toml"))
    shutil.copy(ROOT / "docs/book.toml", folder)
    files = [f"docs/{file.name}" for file in (ROOT / "docs").glob("*.md")]
    files += [file for file in ELSEWHERE if file != "README.md"]
    pages = {on_site(f): relinked((ROOT / f).read_text(encoding="utf-8"), f, source) for f in files}
    for parent, made in (("effects.md", effects(pages)), ("robots.md", robots(pages))):
        below = "".join(f"    - [{title}]({page})\n" for title, page in made)
        summary = re.sub(rf"(.*\({re.escape(parent)}\)\n)", lambda line: line[1] + below, pages["SUMMARY.md"])
        pages["SUMMARY.md"] = summary
    if page:
        shutil.copy(page, folder / "src/stiffarm.html")
        head, rest = pages["index.md"].split("\n\n| ", 1)
        pages["index.md"] = f"{head}\n\n**[Diagnose in your browser](stiffarm.html)**\n\n| {rest}"
    for name, text in pages.items():
        file = folder / "src" / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")


def mdbook(given):
    """The program, built at the pinned version where it is missing."""
    if program := given or shutil.which("mdbook"):
        return program
    tools = TARGET / "tools"
    if not (tools / "bin/mdbook").exists():
        command = ["cargo", "install", "--locked", "--version", MDBOOK, "--root", tools, "mdbook"]
        subprocess.run([*command, "--no-default-features", "--features", "search"], check=True)
    return tools / "bin/mdbook"


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--source", metavar="URL", help="where the sources can be read")
    arguments.add_argument("--page", metavar="FILE", help="what web/build made")
    arguments.add_argument("--mdbook", metavar="PROGRAM", help="the mdBook to run")
    given = arguments.parse_args()
    folder = TARGET / "site"
    lay_out(folder, given.source, given.page)
    subprocess.run([mdbook(given.mdbook), "build", folder], check=True)
    book = folder / "book"
    # Absolute links of the page for what is not found hold on a server alone.
    found = list(broken([page for page in book.rglob("*.html") if page.name != "404.html"], html))
    if found:
        sys.exit("\n".join(found))
    print(f"{sum(1 for _ in book.rglob('*.html'))} pages in {book}: every link leads somewhere")


if __name__ == "__main__":
    main()
