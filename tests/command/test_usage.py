"""Command lines that make no sense: exit code 2, and a message that says what to type. The messages themselves are
tested one by one, and faster, in parse_options.cpp; here is what only a whole run shows."""

import unittest

from support import CommandTest


class Usage(CommandTest):
    def refused(self, *arguments, **keywords):
        message = self.fail_with(2, *arguments, **keywords)
        self.assertTrue(message.startswith("raytrace: error: "), message)
        self.assertTrue(message.endswith("Try 'raytrace --help'.\n"), message)
        self.assertEqual(self.names(), ["scene.xml"])
        return message

    def test_command_line(self):
        self.assertIn("raytrace scene.xml -o picture.exr", self.refused())
        self.assertIn("'--thread'; did you mean '--threads'?", self.refused("scene.xml", "--thread", "4", "-o", "a.exr"))

    def test_help_in_other_words(self):
        self.assertEqual(self.succeed("help").stdout, self.succeed("--help").stdout)
        self.assertEqual(self.succeed("help", "merge").stdout, self.succeed("merge", "--help").stdout)
        self.assertIn("\nUsage: raytrace SCENE.xml", self.refused())
        self.assertIn("\nUsage: raytrace merge PIECES", self.refused("merge"))
        self.assertIn("one of shapes, textures, materials", self.refused("--list"))
        self.assertIn("did you mean 'raytrace merge'?", self.refused("mrege", "a.exr", "b.exr", "-o", "c.exr"))
        self.assertIn("the command comes first: raytrace merge",
                      self.refused("-t", "1", "merge", "a.exr", "b.exr", "-o", "c.exr"))
        self.assertIn("did you mean '--resolution'?", self.refused("scene.xml", "+W640", "+H480", "-o", "a.exr"))

    def test_outputs_that_are_no_files(self):
        for name in ("/dev/stdout", "/dev/stderr", "/dev/fd/1", "-"):
            message = self.fail_with(2, "scene.xml", "-o", name)
            self.assertIn("write to a file, and cat it", message)
            self.assertNotIn("extension", message)
        self.assertIn("it is a folder; name a file in it", self.fail_with(2, "scene.xml", "-o", "/"))

    def test_crops_outside_the_picture(self):
        for text in ["0,0,161,60", "0,0,80,121", "-81,0,5,5", "0,-61,5,5", "-2147483648,0,2147483647,1"]:
            self.assertIn("outside the picture of 80 x 60",
                          self.refused("scene.xml", "-q", "-o", "a.exr", "--crop", text))
        self.assertIn("outside the picture of 40 x 30",
                      self.refused("scene.xml", "-q", "-o", "a.exr", "--crop", "0,0,81,30", "--scale", "0.5"))
        self.assertIn("too many", self.refused("scene.xml", "-q", "-o", "a.exr", "-r", "16000x16000", "--crop",
                                               "-16000,0,32000,16000"))

    def test_too_large(self):
        for size in (["-r", "65537x1"], ["-r", "20000x20000"], ["--scale", "1e300"]):
            self.assertIn("too large", self.refused("scene.xml", "-q", "-o", "a.exr", *size))

    def test_float_where_nothing_can_hold_it(self):
        self.assertIn("--float", self.refused("scene.xml", "-o", "a.png", "--float"))

    def test_transparent_where_nothing_can_hold_alpha(self):
        self.assertIn("--transparent: none of the outputs can hold alpha; .exr, .png and .tif can",
                      self.refused("scene.xml", "-o", "a.jpg", "-o", "a.hdr", "--transparent"))

    def test_exposure_where_all_is_linear(self):
        for outputs in (["a.exr"], ["a.exr", "-o", "a.hdr"], ["a.tif", "--float"]):
            self.assertIn("--exposure: all outputs hold linear colour",
                          self.refused("scene.xml", "--exposure", "1", "-o", *outputs))
        self.assertIn("--exposure: all outputs hold linear colour",
                      self.refused("merge", "a.exr", "-o", "b.exr", "--exposure", "1"))


if __name__ == "__main__":
    unittest.main()
