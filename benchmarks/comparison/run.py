"""Compares raytrace with other renderers: writes each scene in each one's language, checks that the pictures agree,
renders in turns, and writes docs/comparison.md, .json and .svg."""

import argparse
import dataclasses
import os
import shutil
import statistics
import sys
import time

from . import pictures, renderers, report, scenes
from .paths import REPOSITORY, WORK
from .process import Failed, TooSlow

OURS = "raytrace"
QUICK_SCENES = ["spheres-10", "spheres-1k", "mix-5k", "mix-without-tori-5k"]
CHECK_HEIGHT = 512  # of the pictures that are compared
CHECK_LIMIT = 60  # seconds for one of them
OTHER_PICTURE = "other picture"  # in place of a time


def say(text):
    print(text, file=sys.stderr, flush=True)


def options():
    parser = argparse.ArgumentParser(prog="benchmarks/compare", description=__doc__)
    processors = len(os.sched_getaffinity(0))
    parser.add_argument("--quick", action="store_true", help="a few scenes, small, once: to try it out")
    parser.add_argument("--scenes", nargs="+", choices=scenes.SCENES, metavar="SCENE", help=" ".join(scenes.SCENES))
    parser.add_argument("--renderers", nargs="+", choices=renderers.ALL, default=list(renderers.ALL))
    parser.add_argument("--threads", nargs="+", type=int, default=sorted({1, processors}), help="numbers of threads")
    parser.add_argument("--repeats", type=int, help="rounds, in which each renderer renders once (5)")
    parser.add_argument("--budget", type=float, default=8, metavar="SECONDS",
                        help="a renderer that has taken this long with a scene sits out further rounds (8)")
    parser.add_argument("--limit", type=float, default=120, metavar="SECONDS", help="for one run (120)")
    parser.add_argument("--output", default=os.path.join(REPOSITORY, "docs"),
                        help="folder of comparison.md, .json and .svg (docs, whose README is brought up to date, too)")
    chosen = parser.parse_args()
    chosen.scenes = chosen.scenes or (QUICK_SCENES if chosen.quick else list(scenes.SCENES))
    chosen.repeats = chosen.repeats or (1 if chosen.quick else 5)
    return chosen


def taking_part(names):
    """raytrace first, then those that are installed."""
    chosen = [OURS] + [name for name in names if name != OURS]
    result = {}
    for name in chosen:
        renderer = renderers.ALL[name]
        reason = renderer.available()
        if reason is None:
            result[name] = renderer
        elif name == OURS:
            sys.exit(reason)
        else:
            say(f"{renderer.NAME} is left out: {reason}")
    return result


def written(scene, name, renderer):
    """The folder with the scene in the renderer's language."""
    folder = os.path.join(WORK, "scenes", scene.name, name)
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    renderer.write(scene, folder)
    return folder


def agreement(scene, participants):
    """What part of the pixels differs from our picture, for each peer: {name: (coverage, shading)}; and why peers must
    be left out: {name: reason}."""
    # A small copy of the scene of the same shape: one ray through each pixel's centre shows all there is to compare.
    width = scene.width * CHECK_HEIGHT // scene.height
    small = dataclasses.replace(scene, width=width, height=CHECK_HEIGHT)
    ours = None
    found, left_out = {}, {}
    for name, renderer in participants.items():
        try:
            picture = renderer.picture(small, written(small, name, renderer), CHECK_LIMIT)
        except TooSlow as slow:
            left_out[name] = str(slow)
            continue
        except Failed as failed:
            say(str(failed))
            left_out[name] = "failed"
            continue
        pictures.save_png(picture, os.path.join(WORK, "pictures", f"{scene.name}-{name}.png"))
        if name == OURS:
            ours = picture
            continue
        found[name] = pictures.difference(ours, picture)
        shares_shading = getattr(renderer, "shares_shading", lambda _: True)(scene)
        if not pictures.agree(found[name], shares_shading):
            say(f"{scene.title}: the picture of {renderer.NAME} is another one; see {WORK}/pictures/{scene.name}-*.png")
            left_out[name] = OTHER_PICTURE
    return found, left_out


def rounds(participants, folders, threads, chosen):
    """Renders in turns. Returns {name: {"render": [...], "whole": [...], "processors": [...]} or {"failure": text}}, a
    None in a list where the renderer sat out the round."""
    taken = {name: {"render": [], "whole": [], "processors": []} for name in participants}
    spent = dict.fromkeys(participants, 0.0)
    for _ in range(chosen.repeats):
        # Our own render goes on as long as there is another to be held against.
        waiting = [name for name in participants if spent[name] < chosen.budget and "failure" not in taken[name]]
        if not [name for name in waiting if name != OURS] and len(participants) > 1:
            break
        for name, renderer in participants.items():
            if "failure" in taken[name]:
                continue
            if name not in waiting and name != OURS:
                for clock in taken[name].values():
                    clock.append(None)
                continue
            start = time.perf_counter()
            try:
                times = renderer.render(folders[name], threads, chosen.limit)
            except TooSlow as slow:
                taken[name] = {"failure": str(slow)}
                continue
            except Failed as failed:
                say(str(failed))
                taken[name] = {"failure": "failed"}
                continue
            spent[name] += time.perf_counter() - start
            for clock, values in taken[name].items():
                values.append(getattr(times, clock))
    return taken


def summary(taken):
    """Medians, and ratios pair by pair: those of one round against each other, of which the median counts."""
    result = {}
    for name, times in taken.items():
        if "failure" in times:
            result[name] = {"failure": times["failure"]}
            continue
        entry = {"runs": len([x for x in times["whole"] if x is not None])}
        for clock in ("render", "whole"):
            entry[clock] = statistics.median(x for x in times[clock] if x is not None)
            if name != OURS:
                pairs = [peer / ours for peer, ours in zip(times[clock], taken[OURS][clock]) if peer is not None]
                entry[f"{clock}_ratio"] = statistics.median(pairs)
        entry["processors"] = statistics.median(x for x in times["processors"] if x is not None)
        entry["seconds"] = {clock: times[clock] for clock in ("render", "whole")}
        result[name] = entry
    return result


def main():
    chosen = options()
    all_participants = taking_part(chosen.renderers)
    os.makedirs(os.path.join(WORK, "pictures"), exist_ok=True)
    os.makedirs(chosen.output, exist_ok=True)
    machine = report.machine(all_participants, chosen)
    if machine["load_at_start"] > 0.3:
        say(f"Others are at work on this machine (load {machine['load_at_start']}): the times will not be worth much.")
    results = []
    disagreements = 0
    start = time.perf_counter()
    for scene_name in chosen.scenes:
        scene = scenes.make(scene_name)
        if chosen.quick:
            scene.width, scene.height, scene.samples = scene.width // 4, scene.height // 4, min(scene.samples, 16)
        participants = {name: renderer for name, renderer in all_participants.items() if renderer.can(scene)}
        agrees, left_out = agreement(scene, participants)
        disagreements += list(left_out.values()).count(OTHER_PICTURE)
        if OURS in left_out:
            sys.exit(f"{scene.title}: raytrace {left_out[OURS]}")
        participants = {name: renderer for name, renderer in participants.items() if name not in left_out}
        folders = {name: written(scene, name, renderer) for name, renderer in participants.items()}
        result = {"scene": scene.name, "title": scene.title, "differences": agrees, "threads": {}}
        for threads in chosen.threads:
            result["threads"][threads] = summary(rounds(participants, folders, threads, chosen))
            result["threads"][threads] |= {name: {"failure": reason} for name, reason in left_out.items()}
            say(f"{time.perf_counter() - start:6.0f} s  {report.line(result, threads)}")
        results.append(result)
        shutil.rmtree(os.path.join(WORK, "scenes", scene.name))
        report.write(machine, results, chosen)
    if disagreements:
        sys.exit("Not all pictures agree, so that not all times are there.")


if __name__ == "__main__":
    main()
