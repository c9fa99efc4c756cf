"""test_reader.py PROGRAM PYTHON: reads the program's Cryptomattes with cryptomatte-api, which PYTHON must have."""

import json
import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
GALLERY = os.path.join(HERE, "..", "..", "scenes", "gallery")
SKIPPED = 77


def check(program, folder):
    import cryptomatte_api
    import numpy
    sys.path.insert(0, os.path.join(HERE, "..", "command"))
    from exr import Exr

    # With one sample a pixel, a matte is where the id is.
    file = os.path.join(folder, "a.exr")
    scene = os.path.join(GALLERY, "still-life.xml")
    subprocess.run([program, scene, "-q", "-o", file, "-r", "240x180", "-s", "1", "--aov", "all"], check=True)
    with open(file, "rb") as opened:
        picture = Exr(opened.read())
    layers = {layer.metadata().name(): layer for layer in cryptomatte_api.Cryptomatte.load(file)}
    assert sorted(layers) == ["crypto_material", "crypto_object"], layers
    for kind in ("object", "material"):
        ids = numpy.array([picture.rows[y][f"id.{kind}"] for y in range(180)])
        names = json.loads(picture.text(f"raytrace:manifest/id.{kind}"))
        for place, name in enumerate(names):
            mask = layers[f"crypto_{kind}"].mask(name)
            assert (mask == (ids == place + 1)).all(), f"{kind} {name}"
        print(f"{kind}: {len(names)} mattes, {numpy.count_nonzero(numpy.unique(ids))} of them seen")

    # With more, mattes add up to the coverage, here of a scene before nothing.
    scene = os.path.join(GALLERY, "helix.xml")
    subprocess.run([program, scene, "-q", "-o", file, "-r", "240x180", "-s", "16", "--aov", "all", "--float",
                    "--transparent"], check=True)
    with open(file, "rb") as opened:
        picture = Exr(opened.read())
    alpha = numpy.array([picture.rows[y]["A"] for y in range(180)])
    for layer in cryptomatte_api.Cryptomatte.load(file):
        covered = sum(layer.masks().values())
        assert abs(covered - alpha).max() < 1e-6, layer.metadata().name()


def main():
    program, python = sys.argv[1:]
    # Written last: the folder may be there without what was to be installed in it.
    complete = os.path.join(os.path.dirname(os.path.dirname(python)), "installed")
    if not os.path.exists(complete):
        print(f"skipped: no {complete}; tests/cryptomatte/environment.sh makes it")
        return SKIPPED
    if sys.prefix == sys.base_prefix:
        return subprocess.run([python, "-B", __file__, *sys.argv[1:]], check=False).returncode
    with tempfile.TemporaryDirectory(prefix="raytrace-cryptomatte-") as folder:
        check(program, folder)
    return 0


if __name__ == "__main__":
    sys.exit(main())
