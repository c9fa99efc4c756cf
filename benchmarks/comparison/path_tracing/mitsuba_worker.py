"""Renders a scene with Mitsuba 3, once for each seed that a line of standard input gives:
python -m comparison.path_tracing.mitsuba_worker scene.xml SAMPLER THREADS

Writes picture.npy, and then a line with the seconds.
"""

import sys
import time

import drjit
import mitsuba
import numpy

from ..mitsuba_render import use_threads


def main():
    scene_file, sampler, threads = sys.argv[1:]
    mitsuba.set_variant("llvm_ad_rgb")
    use_threads(int(threads))
    mitsuba.set_log_level(mitsuba.LogLevel.Error)
    scene = mitsuba.load_file(scene_file, sampler=sampler)
    for line in sys.stdin:
        start = time.perf_counter()
        picture = mitsuba.render(scene, seed=int(line))
        drjit.eval(picture)
        drjit.sync_thread()
        seconds = time.perf_counter() - start
        numpy.save("picture.npy", numpy.array(picture)[:, :, :3])
        print(seconds, flush=True)


if __name__ == "__main__":
    main()
