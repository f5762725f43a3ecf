"""Lines are at most 120 columns wide, and the page of a folder is one page."""
import os
import pathlib
import re
import subprocess
import unittest

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])

COLUMNS = 120
TEXT = {".md", ".cpp", ".hpp", ".py", ".js", ".css", ".html", ".sh", ".cmake", ".txt", ".toml", ".yml"}
VENDORED = "tools/rubatlas/report/vendor/"

WORDS = 700  # as `wc -w` counts them: a page that is read in one go
# Pages that may be longer, and why.
LONGER_PAGES = {
    "README.md": (1800, "the first page: what a newcomer needs before any other page, with blocks that tests run"),
    "analysis/README.md": (1200, "the one place where the rules of classes, regions and triggers are written"),
}

# A row of a Markdown table, a link or address alone, a picture alone: none of them can be broken.
TABLE_ROW = re.compile(r"\s*\|.*\|\s*")
UNBREAKABLE = re.compile(r"[\s#/*<>-]*(!?\[[^\]]*\]\([^)\s]+\)|<?https?://\S+)[.,;]?\s*")


def tracked_files():
    """Paths of the project, relative to its root; without git, all that lies there."""
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-z"], capture_output=True, text=True, check=False)
    if listed.returncode == 0 and listed.stdout:
        names = listed.stdout.rstrip("\0").split("\0")
        return [path for path in map(pathlib.Path, names) if (ROOT / path).is_file()]
    made = re.compile(r"(build|atlases|\.(?!ci\b))")
    return [path.relative_to(ROOT) for path in sorted(ROOT.rglob("*"))
            if path.is_file() and not any(made.match(part) for part in path.relative_to(ROOT).parts)]


def may_be_long(path, line):
    """Whether a line cannot be broken where it is too wide."""
    return (path.suffix == ".md" and TABLE_ROW.fullmatch(line)) or UNBREAKABLE.fullmatch(line)


class Lines(unittest.TestCase):
    def expect_none(self, departures, rule):
        if departures:
            self.fail(f"{rule}:\n  " + "\n  ".join(departures))

    def test_no_line_is_wider_than_120_columns(self):
        departures, seen = [], 0
        for path in tracked_files():
            if path.suffix not in TEXT or str(path).startswith(VENDORED):
                continue
            seen += 1
            for number, line in enumerate((ROOT / path).read_text(encoding="utf-8").splitlines(), start=1):
                if len(line) > COLUMNS and not may_be_long(path, line):
                    departures.append(f"{path}:{number}: {len(line)} columns")
        self.assertGreater(seen, 300)
        self.expect_none(departures, f"a line has at most {COLUMNS} columns")

    def test_every_readme_is_one_page(self):
        pages = [path for path in tracked_files() if path.name == "README.md"]
        self.assertGreater(len(pages), 20)
        departures = []
        for path in pages:
            limit, _ = LONGER_PAGES.get(str(path), (WORDS, ""))
            words = len((ROOT / path).read_text(encoding="utf-8").split())
            if words > limit:
                departures.append(f"{path}: {words} words of at most {limit}")
        self.expect_none(departures, "what a page has no room for goes to a page beside what it is about")

    def test_every_exception_is_needed(self):
        for name, (limit, reason) in LONGER_PAGES.items():
            with self.subTest(page=name):
                self.assertTrue(WORDS < len((ROOT / name).read_text(encoding="utf-8").split()) <= limit and reason)


if __name__ == "__main__":
    unittest.main()
