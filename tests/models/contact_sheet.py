"""contact_sheet.py PROGRAM OUTPUT: renders all models in build/models that can be, each 240 x 180, and puts them on one
picture, row by row in the order of their names, which it prints. oiiotool is in Debian's openimageio-tools."""

import math
import os
import subprocess
import sys
import tempfile

from models import MODELS, all_models, refusal


def main(program, output):
    names = [name for name in all_models() if refusal(name) is None]
    columns = math.ceil(math.sqrt(len(names)))
    with tempfile.TemporaryDirectory() as folder:
        pictures = []
        for number, name in enumerate(names):
            picture = os.path.join(folder, f"{number}.png")
            done = subprocess.run([program, os.path.join(MODELS, name), "-q", "-r", "240x180", "-s", "32", "-o", picture])
            if done.returncode == 0:
                print(f"row {len(pictures) // columns + 1}, column {len(pictures) % columns + 1}: {name}")
                pictures.append(picture)
        rows = math.ceil(len(pictures) / columns)
        subprocess.run(["oiiotool", *pictures, "--mosaic:pad=4", f"{columns}x{rows}", "--eraseattrib", ".*", "-o", output],
                       check=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
