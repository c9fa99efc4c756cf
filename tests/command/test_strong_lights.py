"""Lights far beyond what is usual: what is beside them stays, and what files and sums cannot hold is reported."""

import unittest

import support
from exr import Exr
from support import CommandTest


class StrongLights(CommandTest):
    def render(self, radiance, *options):
        self.write("scene.xml", support.SCENE.replace("<scaleradiance>2<", f"<scaleradiance>{radiance}<"))
        return self.succeed("scene.xml", *options)

    def test_the_rest_stays(self):
        self.render(0, "-q", "--float", "-o", "a.exr")
        wanted = Exr(self.read("a.exr")).pixels()
        done = self.render(1e13, "--float", "-o", "b.exr", "--progress", "none")
        self.assertEqual(done.stderr, "")
        got = Exr(self.read("b.exr")).pixels()
        unlit = [place for place in wanted if max(got[place]) < 1e6]
        self.assertGreater(len(unlit), 100)
        for place in unlit:
            for value, same in zip(got[place], wanted[place]):
                self.assertAlmostEqual(value, same, delta=1e-7)
        bright = {place: pixel for place, pixel in got.items() if place not in unlit}
        self.assertGreater(len(bright), 1000)

    def test_what_half_cannot_hold_is_counted(self):
        self.render(1e13, "-q", "--float", "-o", "a.exr")
        large = sum(value > 65504 for pixel in Exr(self.read("a.exr")).pixels().values() for value in pixel)
        done = self.render(1e13, "-o", "b.exr")
        self.assertIn(f"b.exr: {large} values beyond what the format holds became its largest", done.stderr)
        self.succeed("scene.xml", "-q", "-o", "t0.exr", "--sample-offset", "0", "-s", "2")
        self.succeed("scene.xml", "-q", "-o", "t1.exr", "--sample-offset", "2", "-s", "2")
        done = self.succeed("merge", "t0.exr", "t1.exr", "-o", "m.exr")
        self.assertIn(f"m.exr: {large} values beyond what the format holds became its largest", done.stderr)

    def test_what_sums_cannot_hold_is_reported(self):
        self.write("scene.xml", support.SCENE.replace(
            "<scaleradiance>2<", "<color red='1e17' green='1e17' blue='1e17'/><scaleradiance>1e17<"))
        done = self.succeed("scene.xml", "--float", "-o", "a.exr")
        self.assertRegex(done.stderr, r"warning: radiance is rounded to multiples of [0-9.e+]+: the scene's brightest")
        self.assertNotIn("without a finite radiance", done.stderr)


if __name__ == "__main__":
    unittest.main()
