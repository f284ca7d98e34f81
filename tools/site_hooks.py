# SPDX-License-Identifier: MIT
"""Hooks of mkdocs for the site of the documentation (mkdocs.yml).

The order of pages is that of the links in docs/README.md of each shelf. A file of the tree that a page links, such as
an example, becomes a file of the site, below tree/.
"""
import os
import re
from pathlib import Path

from mkdocs.structure.files import File

TREE = Path(__file__).resolve().parents[1]
SHELVES = ("guide", "methods", "formats", "inside")
LINK = re.compile(r"\]\(([^)\s#]+)(#[^)\s]*)?\)")
STAGED = "tree"  # folder of the site for files from outside docs/


def on_config(config):
    """One tab for each shelf, pages in the order of its README.md."""
    docs = Path(config["docs_dir"])
    config["nav"] = [{"Home": "README.md"}]
    for shelf in SHELVES:
        pages = [f"{shelf}/README.md"]
        text = (docs / shelf / "README.md").read_text()
        for name, page in re.findall(r"\[([^]]+)\]\(([\w-]+\.md)\)", text):
            if f"{shelf}/{page}" not in [list(p.values())[0] for p in pages[1:]]:
                pages.append({name[0].upper() + name[1:]: f"{shelf}/{page}"})
        config["nav"].append({shelf.capitalize(): pages})
    return config


def outside(config, page, link):
    """Path in the tree of a file outside docs/ that a page links; None for other links."""
    if re.match(r"[a-z]+:|/", link):
        return None
    begin = TREE / page[len(STAGED) + 1:] if page.startswith(STAGED + "/") else Path(config["docs_dir"]) / page
    target = Path(os.path.normpath(begin.parent / link))
    docs = Path(config["docs_dir"])
    if docs in target.parents or TREE not in target.parents or not target.is_file():
        return None
    return target.relative_to(TREE)


def on_files(files, config):
    for file in [file for file in files if not Path(file.src_path).suffix]:
        files.remove(file)  # scripts, such as docs/draw
    found, pending = set(), [file for file in files if file.src_path.endswith(".md")]
    while pending:
        file = pending.pop()
        for link, _ in LINK.findall(Path(file.abs_src_path).read_text()):
            path = outside(config, file.src_path, link)
            if path is None or path in found:
                continue
            found.add(path)
            staged = File(f"{STAGED}/{path}", str(stage(config, path)), config["site_dir"], config["use_directory_urls"])
            files.append(staged)
            if path.suffix == ".md":
                pending.append(staged)
    return files


def stage(config, path):
    """A folder in which STAGED/path is the file of the tree."""
    folder = Path(config["site_dir"]).parent / "site-files"
    copy = folder / STAGED / path
    copy.parent.mkdir(parents=True, exist_ok=True)
    copy.write_bytes((TREE / path).read_bytes())
    return folder


def on_page_markdown(markdown, page, config, files):
    here = page.file.src_path

    def moved(found):
        link, anchor = found[1], found[2] or ""
        path = outside(config, here, link)
        if path is None:
            if not here.startswith(STAGED + "/") or re.match(r"[a-z]+:", link):
                return found[0]
            target = Path(os.path.normpath(TREE / here[len(STAGED) + 1:])).parent / link
            target = os.path.relpath(os.path.normpath(target), config["docs_dir"])
        else:
            target = f"{STAGED}/{path}"
        if target.startswith(".."):
            return "](" + "#" + ")"
        return f"]({os.path.relpath(target, os.path.dirname(here) or '.')}{anchor})"

    return LINK.sub(moved, markdown)
