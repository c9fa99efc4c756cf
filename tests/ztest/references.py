"""Renders the scenes with Mitsuba's moment integrator, and writes what the Z-test needs of that: references/NAME.exr with
the mean of each pixel, and the standard deviation of its samples, both in the CIE's XYZ, as that integrator has them.

make_references runs it.
"""

import argparse
import glob
import os
import tempfile
import time

import drjit
import mitsuba
import numpy

HERE = os.path.dirname(os.path.abspath(__file__))
AT_ONCE = 512  # samples: what is in memory


def options():
    parser = argparse.ArgumentParser()
    parser.add_argument("--samples", type=int, default=16384)
    parser.add_argument("names", nargs="*")
    chosen = parser.parse_args()
    chosen.samples = max(1, chosen.samples // AT_ONCE) * AT_ONCE
    return chosen


def moments(scene, samples):
    """Means and variances of samples."""
    sums = 0
    passes = samples // AT_ONCE
    for seed in range(passes):
        picture = numpy.array(mitsuba.render(scene, spp=AT_ONCE, seed=seed + 1), dtype=numpy.float64)
        sums = sums + picture[:, :, -6:]
    sums = sums / passes
    means, squares = sums[:, :, :3], sums[:, :, 3:]
    return means, numpy.maximum(squares - means**2, 0) * samples / (samples - 1)


def write(name, means, variances, samples):
    import OpenEXR

    header = {"compression": OpenEXR.PXR24_COMPRESSION, "type": OpenEXR.scanlineimage, "samples": samples}
    channels = {}
    for i, channel in enumerate("XYZ"):
        channels[f"mean.{channel}"] = numpy.ascontiguousarray(means[:, :, i], numpy.float32)
        channels[f"deviation.{channel}"] = numpy.ascontiguousarray(numpy.sqrt(variances[:, :, i]), numpy.float16)
    with OpenEXR.File(header, channels) as file:
        file.write(os.path.join(HERE, "references", name + ".exr"))


def main():
    chosen = options()
    from comparison.renderers.mitsuba import llvm_library

    os.environ["DRJIT_LIBLLVM_PATH"] = llvm_library()
    mitsuba.set_variant("llvm_ad_rgb")
    mitsuba.set_log_level(mitsuba.LogLevel.Error)
    drjit.set_thread_count(max(os.cpu_count(), 2))
    from translation import Translation

    names = [os.path.basename(file)[:-4] for file in sorted(glob.glob(os.path.join(HERE, "scenes", "*.xml")))]
    for name in chosen.names or names:
        start = time.perf_counter()
        with tempfile.TemporaryDirectory() as folder:
            Translation(os.path.join(HERE, "scenes", name + ".xml"), folder)
            scene = mitsuba.load_file(os.path.join(folder, "scene.xml"))
            write(name, *moments(scene, chosen.samples), chosen.samples)
        print(f"{name}: {time.perf_counter() - start:.0f} s", flush=True)


if __name__ == "__main__":
    main()
