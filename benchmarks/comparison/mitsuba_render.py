"""Renders a scene with Mitsuba 3: python -m comparison.mitsuba_render scene.xml OUTPUT THREADS

OUTPUT is an EXR to write; or "steady", to print the median of the seconds of renders after the first; or an .npz for the
colours, coverage and positions seen through the pixels' centres.
"""

import os
import statistics
import sys
import time

import drjit
import mitsuba

STEADY_SECONDS = 2  # of renders, of which the median counts; at least one


def steady_seconds(scene):
    seconds = []
    seed = 0
    while sum(seconds[1:]) < STEADY_SECONDS and len(seconds) < 12:
        start = time.perf_counter()
        drjit.eval(mitsuba.render(scene, seed=seed))
        drjit.sync_thread()
        seconds.append(time.perf_counter() - start)
        seed += 1
    return statistics.median(seconds[1:])


def save_centres(scene, file):
    import numpy

    sampler = mitsuba.load_dict({"type": "stratified", "sample_count": 1, "jitter": False})
    sensor = scene.sensors()[0]
    width, height = sensor.film().size()
    sampler.seed(0, width * height)
    index = drjit.arange(mitsuba.UInt32, width * height)
    place = mitsuba.Point2f((index % width + 0.5) / width, (index // width + 0.5) / height)
    ray, _ = sensor.sample_ray(0, 0.5, place, 0.5)
    color, hit, _ = scene.integrator().sample(scene, sampler, ray)
    position = scene.ray_intersect(ray).p

    def array(values):
        return numpy.array(values).T.reshape(height, width, 3)

    numpy.savez(file, color=array(color), alpha=numpy.array(hit).reshape(height, width), position=array(position))


def use_threads(count):
    """Dr.Jit counts the main thread, and alone it waits for ever for somebody to write the picture: so one thread is two
    that share one processor."""
    if count == 1:
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    drjit.set_thread_count(max(count, 2))


def main():
    scene_file, output, threads = sys.argv[1:]
    mitsuba.set_variant("llvm_ad_rgb")
    use_threads(int(threads))
    mitsuba.set_log_level(mitsuba.LogLevel.Error)
    scene = mitsuba.load_file(scene_file)
    if output == "steady":
        print(steady_seconds(scene))
    elif output.endswith(".npz"):
        save_centres(scene, output)
    else:
        mitsuba.util.write_bitmap(output, mitsuba.render(scene), write_async=False)


if __name__ == "__main__":
    main()
