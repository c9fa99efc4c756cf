#!/usr/bin/env python3
"""What --denoise saves: benchmarks/denoising.py PROGRAM [SCENE.xml...]

Renders each scene with few samples, with --denoise and without, and with many for comparison; prints the relative mean
squared error of both, and how many samples would have as little without a denoiser: error falls as one over them."""
import os
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "tests", "command"))
from exr import Exr  # noqa: E402

SCENES = [os.path.join(ROOT, "scenes", "gallery", f"{name}.xml") for name in ("window", "room", "neon")]
SIZE, REFERENCE, FEW = "480x270", 1024, (4, 16, 64)


def relative_error(picture, reference, layer=""):
    """Mean of (a - b)^2 / (b^2 + 0.01) over pixels and colours, without the worst 0.1 %: the reference has fireflies."""
    errors = []
    for y, row in reference.rows.items():
        for color in "RGB":
            other = picture.rows[y][layer + color]
            errors += [(a - b) ** 2 / (b * b + 0.01) for a, b in zip(other, row[color])]
    errors.sort()
    kept = errors[: len(errors) * 999 // 1000]
    return sum(kept) / len(kept)


def main():
    program, scenes = sys.argv[1], sys.argv[2:] or SCENES
    print("| scene | samples | relMSE | with `--denoise` | as many samples without |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:

        def render(scene, *options):
            file = os.path.join(folder, "picture.exr")
            subprocess.run([program, scene, "-q", "--float", "-r", SIZE, "-o", file, *options], check=True)
            with open(file, "rb") as stream:
                return Exr(stream.read())

        for scene in scenes:
            # Of another seed: what both have in common would look like no error.
            reference = render(scene, "-s", str(REFERENCE), "--seed", "1")
            for samples in FEW:
                picture = render(scene, "-s", str(samples), "--denoise")
                noisy, clean = relative_error(picture, reference, "noisy."), relative_error(picture, reference)
                name = os.path.splitext(os.path.basename(scene))[0]
                print(f"| {name} | {samples} | {noisy:.4f} | {clean:.4f} | {samples * noisy / clean:.0f} |", flush=True)


if __name__ == "__main__":
    main()
