"""Models that others made: each is rendered, and shows in the picture, or refused with what is wrong and where."""

import os
import sys
import unittest

from exr import Exr
from models import FEW, MODELS, all_models, refusal
from support import LONG, CommandTest

SKIPPED = 77


class ModelsOfOthers(CommandTest):
    def check(self, name):
        done = self.run_program(os.path.join(MODELS, name), "-q", "-r", "160x90", "-s", "4", "--transparent", "-o", "a.exr")
        reason = refusal(name)
        if reason is not None:
            self.assertEqual(done.returncode, 1, done.stderr)
            errors = [line for line in done.stderr.splitlines() if "error: " in line]
            self.assertIn(reason, "\n".join(errors))
            for error in errors:
                self.assertTrue(error.startswith(os.path.join(MODELS, name)), error)
            self.assertFalse(os.path.exists(self.path("a.exr")))
            return
        self.assertEqual(done.returncode, 0, done.stderr)
        shown = [pixel for pixel in Exr(self.read("a.exr")).pixels().values() if pixel[3] > 0]
        self.assertGreater(len(shown), 50)
        self.assertGreater(sum(sum(pixel[:3]) for pixel in shown) / len(shown), 0.003)

    def test_models(self):
        there = set(all_models())
        for name in sorted(there) if LONG else FEW:
            if name not in there:
                continue
            with self.subTest(model=name):
                self.check(name)
                if os.path.exists(self.path("a.exr")):
                    os.remove(self.path("a.exr"))

    def test_all_that_is_asked_for_is_there(self):
        if "assimp/OBJ/spider.obj" in all_models():
            self.assertEqual([name for name in FEW if name not in all_models()], [])


if __name__ == "__main__":
    if not all_models():
        print("there are no models in build/models: tests/models/environment.sh brings them")
        sys.exit(SKIPPED)
    unittest.main()
