"""What the site shows beside docs/: files of the repository that pages link to, and help texts; the check of
all links.

Links that leave docs/ lead to a page of the site with the file or a list of the folder, so the site needs
nobody's server. MkDocs checks links and anchors between pages of Markdown; those of notebooks and docstrings
are checked in the finished site.
"""

from __future__ import annotations

import os
import posixpath
import re
import subprocess
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urldefrag

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.exceptions import PluginError
from mkdocs.plugins import get_plugin_logger
from mkdocs.structure.files import File, Files, InclusionLevel
from mkdocs.structure.pages import Page

ROOT = Path(__file__).parents[1]
LANGUAGES = {".rs": "rust", ".py": "python", ".toml": "toml", ".json": "json"}
LINK = re.compile(r"(\]\()([^)#\s]+)([^)]*\))")
HELP = "<!-- help of the program -->"
log = get_plugin_logger("site")


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Adds a page for each file and folder outside docs/ that a page links to."""
    wanted = [
        place
        for page in list(files.documentation_pages())
        if page.src_uri.endswith(".md")
        for _, target, _ in LINK.findall(page.content_string)
        if (place := _outside(page.src_uri, target))
    ]
    seen: set[str] = set()
    while wanted:
        place = wanted.pop()
        path = ROOT / place
        if place in seen or not path.exists():
            continue
        seen.add(place)
        if path.suffix in (".svg", ".png"):
            file = File.generated(config, _shown(place), abs_src_path=str(path))
        else:
            names = _names(path)
            wanted += [posixpath.join(place, name) for name in names]
            text = _page(place, path, names)
            file = File.generated(
                config, _shown(place), content=text, inclusion=InclusionLevel.NOT_IN_NAV
            )
        files.append(file)
    return files


def on_page_markdown(markdown: str, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Turns links that leave docs/ to those pages, and puts the help texts in."""
    here = page.file.src_uri

    def turned(link: re.Match[str]) -> str:
        place = _outside(here, link[2])
        if not place:
            return link[0]
        if not (ROOT / place).exists():
            log.warning(f"{here} links to {place}, which is not in the repository")
            return link[0]
        return link[1] + posixpath.relpath(_shown(place), posixpath.dirname(here)) + link[3]

    if here.endswith(".md") and not here.startswith("source/"):
        markdown = LINK.sub(turned, markdown)
    return markdown.replace(HELP, _help()) if HELP in markdown else markdown


class _Links(HTMLParser):
    """What a page of the site links to, and its anchors."""

    def __init__(self, page: Path) -> None:
        super().__init__()
        self.links: list[str] = []
        self.anchors = {""}
        self.feed(page.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        for name, value in attrs:
            if name in ("href", "src") and value:
                self.links.append(value)
            elif name == "id" and value:
                self.anchors.add(value)


def on_post_build(config: MkDocsConfig) -> None:
    """Fails where a link within the finished site is dead. Links to other sites are not followed."""
    site = Path(config.site_dir).resolve()
    pages = {page: _Links(page) for page in site.rglob("*.html")}
    dead = []
    for page, found in pages.items():
        # The page of errors is shown at any place.
        for link in found.links if page.name != "404.html" else []:
            target, anchor = urldefrag(unquote(link))
            if ":" in target:
                continue
            place = (page.parent / target).resolve() if target else page
            place = place / "index.html" if place.is_dir() else place
            known = pages[place].anchors if place in pages else {anchor}
            if not place.is_file() or anchor not in known:
                dead.append(f"{page.relative_to(site)} links to {link}")
    if dead:
        raise PluginError("dead links:\n" + "\n".join(dead))


def _outside(page: str, target: str) -> str | None:
    """The place in the repository that a link of a page leads to, where it leaves docs/."""
    if "://" in target or target.startswith("/"):
        return None
    place = posixpath.normpath(posixpath.join("docs", posixpath.dirname(page), target))
    return None if place == "docs" or place.startswith(("docs/", "..")) else place


def _shown(place: str) -> str:
    """The file of the site that shows it."""
    path = ROOT / place
    if path.is_dir():
        return f"source/{place}/index.md"
    return f"source/{place}" if path.suffix in (".svg", ".png") else f"source/{place}.md"


def _names(path: Path) -> list[str]:
    if not path.is_dir():
        return []
    return sorted(
        one.name for one in path.iterdir() if one.is_dir() or one.suffix in (".rs", ".adm", ".acf")
    )


def _page(place: str, path: Path, names: list[str]) -> str:
    head = f"---\nsearch:\n  exclude: true\n---\n\n# {place}\n\n"
    if path.is_dir():
        shown = (posixpath.relpath(_shown(f"{place}/{name}"), f"source/{place}") for name in names)
        return head + "".join(f"* [{name}]({link})\n" for name, link in zip(names, shown))
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".md":
        return head + text
    return f"{head}``````{LANGUAGES.get(path.suffix, 'text')}\n{text}\n``````\n"


def _help() -> str:
    """What the program and each of its commands says of itself."""
    program = os.environ["STICTION"]

    def said(*command: str) -> str:
        arguments = [program, *command, "--help"]
        return subprocess.run(arguments, check=True, capture_output=True, text=True).stdout

    whole = said()
    listed = whole.split("Commands:\n")[1].split("\n\n")[0]
    commands = [line.split()[0] for line in listed.splitlines() if line.startswith("  ")]
    parts = [f"```text\n{whole}```\n"]
    for command in commands:
        if command != "help":
            parts.append(f"## stiction {command}\n\n```text\n{said(command)}```\n")
    return "\n".join(parts)
