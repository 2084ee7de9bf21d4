"""Compares every link of the pages of a site with the files and anchors that are there: check_links.py SITE

Prints those that lead nowhere, and those that load something from a network; the exit code is 1 if there are any.
"""

import html.parser
import pathlib
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    """Anchors and links of one page."""

    def __init__(self, path: pathlib.Path):
        super().__init__()
        self.anchors: set = set()
        self.links: list = []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attributes: list) -> None:
        for name, value in attributes:
            if name in ("id", "name"):
                self.anchors.add(value)
            elif name in ("href", "src") and value:
                self.links.append((tag, value))


def main() -> int:
    site = pathlib.Path(sys.argv[1]).resolve()
    pages = {path: Page(path) for path in site.rglob("*.html")}
    n_wrong = 0
    for path, page in pages.items():
        # Links within the interfaces are those of doxygen, which names lists that it leaves out.
        if path.is_relative_to(site / "interfaces"):
            continue
        for tag, link in page.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                # Readers may follow links to a network; a page needs none.
                is_wrong = tag != "a" and parts.scheme not in ("data", "javascript")
            else:
                to = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
                anchors = pages[to].anchors if to in pages else None
                is_wrong = not to.exists() or bool(parts.fragment and anchors is not None and not anchors & {
                    parts.fragment, urllib.parse.unquote(parts.fragment)})
            if is_wrong:
                n_wrong += 1
                print(f"{path.relative_to(site)}: {link}")
    print(f"{len(pages)} pages, {n_wrong} links that lead nowhere")
    return 1 if n_wrong else 0


if __name__ == "__main__":
    sys.exit(main())
