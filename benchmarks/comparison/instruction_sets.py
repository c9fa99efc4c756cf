"""Each instruction set's variant of the wide code against a program that was built with -march=native, limited to the
same instruction set; and what the choice at start costs. Builds the native programs under build/native/ and writes
docs/instruction-sets.md. Run by benchmarks/instruction_sets."""

import argparse
import os
import re
import shutil
import statistics
import subprocess
import sys

from . import report, scenes
from .paths import PROGRAM, REPOSITORY, WORK
from .process import run
from .renderers import raytrace

# What -march=native is to leave out, so that it has what the instruction set has, and is tuned for this processor.
LEFT_OUT = {
    "x86-64-v2": ["-mno-avx", "-mno-bmi", "-mno-bmi2", "-mno-lzcnt", "-mno-movbe"],
    "x86-64-v3": ["-mno-avx512f"],
    "x86-64-v4": [],
}
SCENES = ["spheres-10", "spheres-1k", "spheres-100k", "cylinders-10k", "tori-1k", "triangles-100k", "mix-5k"]


def say(text):
    print(text, file=sys.stderr, flush=True)


def supported():
    """Those that this processor has, least first."""
    names, best = re.search(r"instruction sets: (.*) \(best here: (.*)\)", raytrace.version()).groups()
    names = names.split(", ")
    return names[: names.index(best) + 1]


def native_program(isa):
    """Builds it. The instruction set "generic" is what the compiler's flags say, all of the program included."""
    folder = os.path.join(REPOSITORY, "build", "native", isa)
    flags = " ".join(["-march=native", *LEFT_OUT[isa]])
    say(f"building with {flags}")
    settings = ["CMAKE_BUILD_TYPE=Release", "RAYTRACE_ISAS=generic", f"CMAKE_CXX_FLAGS={flags}", "RAYTRACE_WERROR=OFF"]
    settings += ["RAYTRACE_TESTS=OFF", "RAYTRACE_BENCHMARKS=OFF"]
    configure = ["cmake", "-S", REPOSITORY, "-B", folder, "-G", "Ninja", *(f"-D{setting}" for setting in settings)]
    subprocess.run(configure, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["ninja", "-C", folder, "--quiet", "raytrace_program"], check=True, stdout=sys.stderr)
    return os.path.join(folder, "bin", "raytrace")


def written(scene):
    folder = os.path.join(WORK, "scenes", f"instruction-sets-{scene.name}")
    os.makedirs(folder, exist_ok=True)
    raytrace.write(scene, folder)
    return folder


def in_turns(timed, rounds):
    """The times of each of `timed`, {name: function that returns seconds}: a round each, with every second one the
    other way round, so that what drifts favours none."""
    seconds = {name: [] for name in timed}
    for number in range(rounds):
        for name in list(timed) if number % 2 == 0 else reversed(timed):
            seconds[name].append(timed[name]())
    return seconds


def ratios(seconds, name, other):
    """Of each round."""
    return [a / b for a, b in zip(seconds[name], seconds[other])]


def processor_seconds(folder, *command):
    """How long the command keeps processors busy, as a function: other work on the machine counts for less than by the
    clock."""

    def measured():
        _, seconds, processors = run([*command, "scene.xml", "-q", "-t", 1, "-o", "picture.exr"], folder, 600)
        return seconds * processors

    return measured


def variants_table(programs, chosen):
    """How long each variant and each native program render each scene."""
    isas = list(programs)
    text = f"| scene | instruction set | variant | native | variant / native | least to most | to {isas[0]} |\n"
    text += "|---|---|---|---|---|---|---|\n"
    for name in chosen.scenes:
        scene = scenes.make(name)
        folder = written(scene)
        timed = {}
        for isa, native in programs.items():
            timed[isa] = processor_seconds(folder, PROGRAM, "--isa", isa)
            timed[isa, "native"] = processor_seconds(folder, native)
        seconds = in_turns(timed, chosen.rounds)
        for isa in isas:
            times = [f"{statistics.median(seconds[x]):.3f} s" for x in (isa, (isa, "native"))]
            to_native = ratios(seconds, isa, (isa, "native"))
            spread = f"{min(to_native):.3f} to {max(to_native):.3f}"
            gain = statistics.median(ratios(seconds, isas[0], isa))
            cells = [scene.title, isa, *times, f"{statistics.median(to_native):.3f}", spread, f"{gain:.2f} x as fast"]
            text += f"| {' | '.join(cells)} |\n"
            say(text.splitlines()[-1])
        shutil.rmtree(folder)
    return text


def start_table(best, native, starts):
    """How long the smallest job takes, where the program chooses, is given, and has no choice of instruction set."""
    scene = scenes.cloud("start", "one sphere", 1, ["sphere"], width=64, height=64, samples=1)
    folder = written(scene)
    ways = {
        "chooses": processor_seconds(folder, PROGRAM),
        f"is given: `--isa {best}`": processor_seconds(folder, PROGRAM, "--isa", best),
        "has one only: the native build": processor_seconds(folder, native),
    }
    seconds = in_turns(ways, starts)
    first = next(iter(ways))
    text = "| the program | whole process | to one that chooses |\n|---|---|---|\n"
    for way in ways:
        cell = "" if way == first else f"{statistics.median(ratios(seconds, way, first)):.3f}"
        text += f"| {way} | {statistics.median(seconds[way]) * 1000:.2f} ms | {cell} |\n"
    return text


def main():
    parser = argparse.ArgumentParser(prog="benchmarks/instruction_sets", description=__doc__)
    parser.add_argument("--scenes", nargs="+", choices=scenes.SCENES, default=SCENES, metavar="SCENE",
                        help=f"of {' '.join(scenes.SCENES)} ({' '.join(SCENES)})")
    parser.add_argument("--rounds", type=int, default=7, help="in which each program renders a scene once (7)")
    parser.add_argument("--starts", type=int, default=100, help="the same for the smallest job (100)")
    parser.add_argument("--output", default=os.path.join(REPOSITORY, "docs"), help="folder of instruction-sets.md (docs)")
    chosen = parser.parse_args()
    where = report.host()
    programs = {isa: native_program(isa) for isa in supported() if isa in LEFT_OUT}
    if not programs:
        sys.exit("The instruction sets are x86-64's; this processor has none of them.")
    best = list(programs)[-1]
    variants = variants_table(programs, chosen)
    start = start_table(best, programs[best], chosen.starts)
    flags = {isa: f"`{' '.join(LEFT_OUT[isa])}`" if LEFT_OUT[isa] else "nothing" for isa in programs}
    left_out = ", ".join(f"{isa} {text}" for isa, text in flags.items())
    with open(os.path.join(chosen.output, "instruction-sets.md"), "w", encoding="utf-8") as file:
        file.write(
            "# Instruction sets\n\n`benchmarks/instruction_sets` writes this page.\n\n"
            f"{report.machine_line(where)}; {raytrace.version()}. Load when it began: {where['load_at_start']}.\n\n"
            "## Each variant against a native build\n\n"
            "The program as it is built for everyone, given its variant by `--isa`, against a program built for this"
            " processor alone: all of it with `-march=native`, limited to the same instruction set. What is left out for"
            f" that: {left_out}. The scenes are those of [the comparison](comparison.md). Processor time of the whole"
            " process with one thread, from reading the scene to writing the picture."
            f" Medians of {chosen.rounds} rounds, in which the programs take turns; ratios are the medians of the rounds'"
            " own, beside their extremes. 1 and less: the variant is as fast as the native build.\n\n"
            f"{variants}\n"
            "## What the choice at start costs\n\n"
            "The smallest job, 64 x 64 pixels of one sphere: processor time from the start of the process to its end,"
            f" {chosen.starts} times in turns.\n\n"
            f"{start}"
        )


if __name__ == "__main__":
    main()
