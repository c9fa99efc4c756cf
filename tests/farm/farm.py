"""What the tests of the farms share: scenes to render, and the pictures that they must become."""

import os
import re
import resource
import sys

import support
from exr import Exr

SHARE = os.path.join(support.REPOSITORY, "share")

# ctest reports a test that ends with this code as skipped.
SKIPPED = 77


def skip_all(reason):
    """From setUpModule(): ends the process, so that ctest shows the test as skipped and not as passed."""
    print(f"skipped: {reason}", file=sys.stderr, flush=True)
    sys.exit(SKIPPED)


class FarmTest(support.CommandTest):
    """Each test has a folder of its own with scene.xml in it; one sphere of it is larger in each frame."""

    def setUp(self):
        super().setUp()
        self.write("scene.xml", support.SCENE.replace("<radius>1</radius>", "<radius>$frame</radius>"))
        versions = self.succeed("--version").stdout
        self.instruction_set = re.search(r"best here: ([\w-]+)", versions).group(1)

    def whole_picture(self, frame, *options):
        """The frame rendered at once."""
        self.succeed("scene.xml", "-q", *options, "--isa", self.instruction_set, "--frames", str(frame),
                     "-o", "whole.####.exr")
        return self.picture(f"whole.{frame:04}.exr")

    def picture(self, name):
        return Exr(self.read(name))

    def assert_same(self, picture, expected):
        self.assertEqual(picture.channels, expected.channels)
        self.assertEqual(picture.data_window, expected.data_window)
        self.assertEqual(picture.display_window, expected.display_window)
        different = sum(picture.rows[y] != expected.rows[y] for y in expected.rows)
        self.assertEqual(different, 0, f"rows of {expected.height} that differ from the whole render's")

    def samples_for(self, seconds):
        """Samples a pixel for which one processor works that long, or longer if it has other work, too."""
        tried = 2000
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.succeed("scene.xml", "-q", "--isa", self.instruction_set, "-t", "1", "-s", str(tried), "--frames", "1",
                     "-o", "tried.####.exr")
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return round(tried * seconds / (after.ru_utime - before.ru_utime))
