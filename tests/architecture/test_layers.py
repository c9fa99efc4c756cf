"""layers.py names what breaks its rules."""

import tempfile
import unittest
from pathlib import Path

import layers


class Layers(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)

    def write(self, name, *includes):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("".join(f'#include "{include}"\n' for include in includes))

    def test_a_folder_that_includes_one_above_it(self):
        self.write("lib/raytrace/film/film.h", "raytrace/render/renderer.h")
        self.write("lib/raytrace/render/renderer.h", "raytrace/film/film.h")
        self.assertEqual(
            layers.layer_faults(self.root),
            ["lib/raytrace/film/film.h: includes raytrace/render/renderer.h, and render/ is not below film/"])

    def test_folders_of_one_line(self):
        self.write("lib/raytrace/lights/light.h", "raytrace/shapes/disk.h")
        self.assertEqual(len(layers.layer_faults(self.root)), 1)

    def test_a_folder_without_a_layer(self):
        self.write("lib/raytrace/attic/trunk.h")
        self.assertEqual(layers.layer_faults(self.root),
                         ["lib/raytrace/attic/trunk.h: the list of layers has no folder attic"])

    def test_a_narrow_source_that_reaches_a_kernel_through_headers(self):
        self.write("lib/raytrace/shapes/disk_kernel.h")
        self.write("lib/raytrace/scene/scene.h", "raytrace/shapes/disk_kernel.h")
        self.write("lib/raytrace/scene/tables.cpp", "raytrace/scene/scene.h")  # wide: it may
        self.write("apps/raytrace/main.cpp", "raytrace/scene/scene.h")
        self.assertEqual(layers.narrow_faults(self.root),
                         ["apps/raytrace/main.cpp: raytrace/scene/scene.h -> raytrace/shapes/disk_kernel.h"])

    def test_a_narrow_source_that_reaches_the_simd_library(self):
        self.write("lib/raytrace/film/film.cpp", "film.h")
        self.write("lib/raytrace/film/film.h", "xsimd/xsimd.hpp")
        self.assertEqual(layers.narrow_faults(self.root), ["lib/raytrace/film/film.cpp: film.h -> xsimd/xsimd.hpp"])


if __name__ == "__main__":
    unittest.main()
