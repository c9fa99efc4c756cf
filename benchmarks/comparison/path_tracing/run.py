"""Path tracing at equal error: renders each scene with each renderer, several times with different random numbers, and
prints what a render takes, how far it is from the mean, and the product, which does not depend on the number of samples."""

import argparse
import json
import os
import shutil
import statistics
import sys

import numpy

from .. import pictures, report
from ..paths import WORK
from . import cycles, luxcore, mitsuba, raytrace, scenes

RENDERERS = {"raytrace": raytrace, "mitsuba": mitsuba, "cycles": cycles, "luxcore": luxcore}
DARK = 0.01  # added to squares of radiance that errors are divided by (Rousselle et al. 2011)
BLOCK = 16  # edge of the blocks, in pixels, whose means are compared


def say(text):
    print(text, file=sys.stderr, flush=True)


def options():
    parser = argparse.ArgumentParser(prog="benchmarks/compare paths", description=__doc__)
    parser.add_argument("--scenes", nargs="+", choices=scenes.SCENES, default=list(scenes.SCENES), metavar="SCENE",
                        help=" ".join(scenes.SCENES))
    parser.add_argument("--renderers", nargs="+", choices=RENDERERS, default=list(RENDERERS))
    parser.add_argument("--renders", type=int, default=20, help="of each scene with each renderer, at least 2 (20)")
    parser.add_argument("--samples", type=int, default=64, help="a pixel (64)")
    parser.add_argument("--depth", type=int, default=12, help="the most segments of a path (12)")
    parser.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--json", default=os.path.join(WORK, "paths.json"), metavar="FILE", help="what is printed, as JSON")
    return parser.parse_args()


def block_means(renders):
    """Of each render: (render, block)."""
    count, height, width, _ = renders.shape
    blocks = renders.mean(axis=3).reshape(count, height // BLOCK, BLOCK, width // BLOCK, BLOCK)
    return blocks.mean(axis=(2, 4)).reshape(count, -1)


def figures(name, seconds, renders, reference, ours):
    """reference: the mean of all renderers' pictures, by which errors are made relative; ours: raytrace's renders."""
    error = float((renders.var(axis=0, ddof=1) / (reference**2 + DARK)).mean())
    time = statistics.median(seconds)
    result = {"renderer": name, "seconds": time, "relmse": error, "cost": time * error, "mean": float(renders.mean())}
    if ours is not None and ours is not renders:
        mine, other = block_means(ours), block_means(renders)
        deviation = numpy.sqrt(mine.var(axis=0, ddof=1) / len(mine) + other.var(axis=0, ddof=1) / len(other))
        apart = numpy.abs(mine.mean(axis=0) - other.mean(axis=0))
        result["difference"] = float(renders.mean() / ours.mean() - 1)
        totals = [part.mean(axis=1) for part in (mine, other)]
        result["difference_error"] = float(numpy.sqrt(sum(t.var(ddof=1) / len(t) for t in totals)) / ours.mean())
        result["blocks_apart"] = int((apart > 5 * deviation + 0.005 * mine.mean(axis=0)).sum())
    return result


def measured(scene, chosen):
    """The figures of every variant of every renderer. They take turns."""
    running = {}
    for name in chosen.renderers:
        if hasattr(RENDERERS[name], "can") and not RENDERERS[name].can(scene):
            continue
        folder = os.path.join(WORK, "scenes", f"paths-{scene.name}-{name}")
        shutil.rmtree(folder, ignore_errors=True)
        os.makedirs(folder)
        RENDERERS[name].write(scene, folder, chosen)
        renderer = RENDERERS[name]
        variants = renderer.variants(scene) if hasattr(renderer, "variants") else renderer.VARIANTS
        for variant, setting in variants.items():
            running[variant] = RENDERERS[name].renders(setting, folder, chosen)
    taken = {variant: [] for variant in running}
    for _ in range(chosen.renders):
        for variant, renders in running.items():
            taken[variant].append(next(renders))
    for renders in running.values():
        renders.close()
    all_renders = {variant: numpy.stack([picture for _, picture in values]) for variant, values in taken.items()}
    reference = sum(renders.mean(axis=0) for renders in all_renders.values()) / len(all_renders)
    os.makedirs(os.path.join(WORK, "pictures"), exist_ok=True)
    for variant, renders in all_renders.items():
        file = f"paths-{scene.name}-{variant.replace(', ', '-')}.png"
        pictures.save_png(renders.mean(axis=0), os.path.join(WORK, "pictures", file))
    ours = all_renders.get("raytrace")
    return [figures(variant, [seconds for seconds, _ in taken[variant]], renders, reference, ours)
            for variant, renders in all_renders.items()]


def row(scene, one):
    cells = [scene.title, one["renderer"], f"{one['seconds']:.2f} s", f"{one['relmse']:.5f}", f"{one['cost']:.4f}"]
    if "difference" in one:
        cells.append(f"{100 * one['difference']:+.2f} % ± {100 * one['difference_error']:.2f}; {one['blocks_apart']}")
    else:
        cells.append("")
    return f"| {' | '.join(cells)} |"


def main():
    chosen = options()
    for name in list(chosen.renderers):
        if reason := RENDERERS[name].available():
            say(f"{name} is left out: {reason}")
            chosen.renderers.remove(name)
    where = report.host()
    print(f"{report.machine_line(where)}. {scenes.WIDTH} x {scenes.WIDTH} pixels, {chosen.samples} samples, depth"
          f" {chosen.depth}, {chosen.threads} threads, {chosen.renders} renders of each; load {where['load_at_start']}.\n")
    print("| scene | renderer | render | relMSE | cost | mean, against raytrace's; blocks apart |\n|---|---|---|---|---|---|",
          flush=True)
    results = []
    for name in chosen.scenes:
        scene = scenes.make(name)
        found = measured(scene, chosen)
        results.append({"scene": name, "title": scene.title, "renderers": found})
        for one in found:
            print(row(scene, one), flush=True)
        with open(chosen.json, "w", encoding="utf-8") as file:
            settings = {key: value for key, value in vars(chosen).items() if key != "json"}
            json.dump({"machine": where, "settings": settings, "scenes": results}, file, indent=1)
            file.write("\n")


if __name__ == "__main__":
    main()
