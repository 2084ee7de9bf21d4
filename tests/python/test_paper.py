"""The paper: its length, its references, its figure."""

import re
import subprocess
import sys
import unittest

from helpers import SOURCE, InFolder

try:
    import matplotlib
except ImportError:
    matplotlib = None

PAPER = SOURCE / "docs/paper"


class Paper(InFolder):
    def setUp(self):
        super().setUp()
        self.text = (PAPER / "paper.md").read_text().split("---\n", 2)[2]
        self.references = re.findall(r"@\w+\{(\w+),(.*?)\n\}", (PAPER / "paper.bib").read_text(), re.S)

    def test_it_has_the_length_and_the_parts_that_journals_ask_for(self):
        words = re.sub(r"[|#*`@\[\]]", " ", self.text).split()
        self.assertGreaterEqual(len(words), 250)
        self.assertLessEqual(len(words), 1000)
        headings = re.findall(r"^# (.+)$", self.text, re.M)
        for heading in ("Summary", "Statement of need", "State of the field", "Software design",
                        "Research impact statement", "Acknowledgements", "References"):
            self.assertIn(heading, headings)

    def test_every_reference_is_cited_and_has_its_doi(self):
        self.assertGreater(len(self.references), 5)
        self.assertEqual(sorted(set(re.findall(r"@([A-Za-z]+\d{4})", self.text))),
                         sorted(key for key, _ in self.references))
        for key, entry in self.references:
            self.assertRegex(entry, r"doi\s*=\s*\{10\.\d{4,}/\S+\}", key)

    @unittest.skipIf(matplotlib is None, "matplotlib (Debian package python3-matplotlib) is missing")
    def test_its_command_makes_its_figure(self):
        for picture in re.findall(r"\]\((\S+)\)", self.text):
            self.assertTrue((PAPER / picture).exists(), picture)
        script = re.search(r"python3 docs/paper/(\w+\.py)", self.text).group(1)
        picture = self.folder / "figure.svg"
        subprocess.run([sys.executable, PAPER / script, "--quick", picture], check=True, cwd=self.folder)
        self.assertIn("<svg", picture.read_text())


if __name__ == "__main__":
    unittest.main()
