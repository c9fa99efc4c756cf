"""Sizes that a picture's format cannot hold."""

import unittest

from support import CommandTest


class Sizes(CommandTest):
    def test_they_are_refused_before_the_render(self):
        for ending, least, most in (("jpg", 1, 65500), ("gif", 1, 65535), ("tga", 1, 65535), ("sgi", 1, 65535),
                                    ("webp", 1, 16383), ("ico", 1, 256), ("bmp", 1, 65535), ("ppm", 1, 65535),
                                    ("jp2", 32, None), ("JPG", 1, 65500)):
            sizes = [(f"{most + 1}x{least}", most)] if most else []
            sizes += [(f"{least}x{most + 1}", most)] if ending == "jpg" else []
            sizes += [(f"{least - 1}x64", least), (f"64x{least - 1}", least)] if least > 1 else []
            for size, limit in sizes:
                message = self.fail_with(2, "scene.xml", "-q", "-s", "1", "-r", size, "-o", "a.exr", "-o", f"b.{ending}",
                                         "--stats=s.json")
                self.assertIn(f"b.{ending}", message)
                self.assertIn(str(limit), message)
                self.assertEqual(self.names(), ["scene.xml"])

    def test_what_counts_is_what_is_written(self):
        options = ["scene.xml", "-q", "-s", "1", "-r", "65536x4"]
        self.succeed(*options, "--crop", "0,0,65500,1", "-o", "crop.jpg")
        self.succeed(*options, "--tile", "1/2", "-o", "tile.jpg")
        self.succeed(*options, "-o", "a.exr", "-o", "a.png")
        self.fail_with(2, *options, "-o", "a.jpg")
        self.assertEqual(self.names(), ["a.exr", "a.png", "crop.jpg", "scene.xml", "tile.jpg"])

    def test_of_a_merge(self):
        for tile in (0, 1):
            self.succeed("scene.xml", "-q", "-s", "1", "-r", "65536x4", "--tile", f"{tile}/2", "-o", f"{tile}.exr")
        self.assertIn("65500", self.fail_with(2, "merge", "0.exr", "1.exr", "-o", "whole.exr", "-o", "whole.jpg"))
        self.assertEqual(self.names(), ["0.exr", "1.exr", "scene.xml"])


if __name__ == "__main__":
    unittest.main()
