"""The examples of docs/python.md run, one after the other."""

import pathlib
import re
import unittest

from support import SOURCE, TestCase

BLOCK = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)


class Page(TestCase):
    def test_examples_run(self):
        page = (SOURCE / "docs" / "python.md").read_text()
        blocks = list(BLOCK.finditer(page))
        self.assertGreater(len(blocks), 8)
        scope = {"__name__": "page"}
        for block in blocks:
            line = page.count("\n", 0, block.start(1))
            exec(compile("\n" * line + block.group(1), "docs/python.md", "exec"), scope)
        self.assertLess(abs(scope["result"].pose - scope["scene"].truth["left"]).max(), 0.02)
        self.assertTrue(pathlib.Path("results/halving/trials.csv").exists())


if __name__ == "__main__":
    unittest.main()
