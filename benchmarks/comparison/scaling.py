"""How raytrace alone grows with the number of objects: time a ray, bytes a primitive, and each phase's time, from 10
spheres to ten millions. Writes docs/scaling.md and .svg. Run by benchmarks/scaling."""

import argparse
import json
import os
import statistics

from . import report, scenes
from .paths import PROGRAM, REPOSITORY, WORK
from .process import run
from .renderers import raytrace

COLUMNS = ["spheres", "load", "build", "render", "ns a ray", "BVH bytes a sphere", "peak: load", "peak: build",
           "peak: render", "peak: write", "peak bytes a sphere"]


def measured(count, threads, repeats):
    """The medians of one number of spheres."""
    scene = scenes.cloud(f"scaling-{count}", f"{count:,} spheres", count, ["sphere"])
    folder = os.path.join(WORK, "scenes", scene.name)
    os.makedirs(folder, exist_ok=True)
    raytrace.write(scene, folder)
    runs = []
    for _ in range(repeats):
        run([PROGRAM, "scene.xml", "-q", "-t", threads, "-o", "picture.exr", "--stats=stats.json"], folder, 600)
        with open(os.path.join(folder, "stats.json"), encoding="utf-8") as file:
            runs.append(json.load(file))
    os.remove(os.path.join(folder, "scene.xml"))

    def median(value):
        return statistics.median(value(one) for one in runs)

    return {
        "count": count,
        "load": median(lambda one: one["seconds"]["load"]),
        "build": median(lambda one: one["seconds"]["build"]),
        "render": median(lambda one: one["seconds"]["render"]),
        "ray": median(lambda one: one["seconds"]["render"] / one["rays"]["total"]),
        "bvh": median(lambda one: one["memory"]["bvh_bytes"]),
        "peak": median(lambda one: one["memory"]["peak_bytes"]),
        "peaks": [median(lambda one: one["memory"]["peak_bytes_by_phase"][phase])
                  for phase in ("load", "build", "render", "write")],
    }


def table(results):
    lines = [f"| {' | '.join(COLUMNS)} |", "|" + "---|" * len(COLUMNS)]
    for one in results:
        count = one["count"]
        cells = [f"{count:,}", *(f"{one[phase]:.3f} s" for phase in ("load", "build", "render"))]
        cells += [f"{one['ray'] * 1e9:.1f}", f"{one['bvh'] / count:,.0f}" if one["bvh"] else "none"]
        cells += [f"{peak / 1e6:,.0f} MB" for peak in one["peaks"]]
        cells.append(f"{one['peak'] / count:,.0f}" if count >= 100_000 else "")
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def plot(results, file):
    import matplotlib

    matplotlib.use("svg")
    matplotlib.rcParams.update({"svg.hashsalt": "raytrace", "svg.fonttype": "none", "font.size": 9})
    from matplotlib import pyplot

    counts = [one["count"] for one in results]
    figure, (time, memory) = pyplot.subplots(1, 2, figsize=(10, 3.4), layout="constrained")
    time.plot(counts, [one["ray"] * 1e9 for one in results], "o-", label="time a ray")
    time.set_ylabel("ns a ray")
    with_bvh = [one for one in results if one["bvh"]]
    memory.plot([one["count"] for one in with_bvh], [one["bvh"] / one["count"] for one in with_bvh], "o-", label="BVH")
    large = [one for one in results if one["count"] >= 1000]
    memory.plot([one["count"] for one in large], [one["peak"] / one["count"] for one in large], "s--", label="whole process")
    memory.set_ylabel("bytes a sphere")
    memory.set_yscale("log")
    memory.legend()
    for panel in (time, memory):
        panel.set_xscale("log")
        panel.set_xlabel("spheres")
        panel.grid(alpha=0.3)
    figure.savefig(file, metadata={"Date": None})
    pyplot.close(figure)


def affordable():
    """10,000,000 spheres are objects of Python's before they are a file."""
    available = os.sysconf("SC_AVPHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    return 10_000_000 if available > 12e9 else 1_000_000


def main():
    parser = argparse.ArgumentParser(prog="benchmarks/scaling", description=__doc__)
    parser.add_argument("--most", type=int, default=affordable(),
                        help="spheres (10000000; a tenth where there is less memory than the scene's making takes)")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--repeats", type=int, default=3, help="runs of which the median counts (3)")
    parser.add_argument("--output", default=os.path.join(REPOSITORY, "docs"), help="folder of scaling.md and .svg (docs)")
    chosen = parser.parse_args()
    where = report.host()
    counts = [10**power for power in range(1, len(str(chosen.most)))]
    results = [measured(count, chosen.threads, chosen.repeats) for count in counts]
    with open(os.path.join(chosen.output, "scaling.md"), "w", encoding="utf-8") as file:
        file.write(
            "# How it grows\n\nRandom spheres over a plane that fill the same share of the same box, 1024 x 1024 pixels, 16"
            " samples, one shadowing point light.\n\n"
            f"{report.machine_line(where)}; {raytrace.version()}; threads: {chosen.threads}; medians of {chosen.repeats}."
            f" Load when it began: {where['load_at_start']}.\n\n"
            f"{table(results)}\n![Time a ray and bytes a sphere over the number of spheres](scaling.svg)\n\n"
            "BVH: none where no ray asked for it, so that it was not built: [lists](design.md) of what is to be met in"
            " which direction from the eye and the light answered them all.\n\n"
            "Peaks: the most memory that the process had held by the end of the phase. With few spheres it is that of the"
            " program, its libraries and the picture. `benchmarks/scaling` measures it on your machine.\n"
        )
    plot(results, os.path.join(chosen.output, "scaling.svg"))


if __name__ == "__main__":
    main()
