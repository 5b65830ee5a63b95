"""A preprocessor of mdBook: links that lead out of the book lead to the project's repository."""
import json
import posixpath
import re
import sys


def led(path, repository):
    """The link of a page, with the address of what is outside."""

    def link(found):
        to = posixpath.normpath(posixpath.join("docs", posixpath.dirname(path), found[1]))
        return found[0] if to.startswith("docs/") else f"]({repository}/blob/HEAD/{to}{found[2] or ''})"

    return link


def lead(items, repository):
    for chapter in (item["Chapter"] for item in items if isinstance(item, dict) and "Chapter" in item):
        chapter["content"] = re.sub(r"\]\((?!\w+:|#)([^)#\s]+)(#[^)\s]*)?\)", led(chapter["path"] or "", repository), chapter["content"])
        lead(chapter["sub_items"], repository)


if sys.argv[1:2] == ["supports"]:
    sys.exit(sys.argv[2] != "html")
context, book = json.load(sys.stdin)
lead(book["items"], context["config"]["preprocessor"]["outside"]["repository"])
json.dump(book, sys.stdout)
