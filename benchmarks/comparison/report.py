"""Writes what was measured: a page with tables, the same as JSON, a plot, and the README's table."""

import json
import os
import platform
import re
import subprocess

from . import pictures
from .paths import REPOSITORY

OURS = "raytrace"
CLOCKS = {"render": "Render only", "whole": "Whole process"}
MARKS = ("<!-- benchmarks/compare writes from here -->", "<!-- to here -->")
COLORS = ("#3b6fb5", "#d1662f", "#4f9a57", "#8a5fb0")


def host():
    """What is measured, and where."""
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        model = re.search(r"model name\s*: (.*)", file.read())
    system = platform.freedesktop_os_release().get("PRETTY_NAME", platform.system())
    git = ["git", "rev-parse", "--short", "HEAD"]
    commit = subprocess.run(git, cwd=REPOSITORY, capture_output=True, text=True, check=False)
    return {
        "processor": model.group(1) if model else platform.machine(),
        "processors": len(os.sched_getaffinity(0)),
        "system": system,
        "commit": commit.stdout.strip(),
        "load_at_start": round(os.getloadavg()[0], 2),
    }


def machine(participants, chosen):
    return host() | {
        "limit": chosen.limit,
        "repeats": chosen.repeats,
        "versions": {name: renderer.version() for name, renderer in participants.items()},
        "names": {name: renderer.NAME for name, renderer in participants.items()},
        "commands": {name: renderer.COMMAND for name, renderer in participants.items()},
        "notes": {name: renderer.NOTE for name, renderer in participants.items()},
    }


def seconds(value):
    return f"{value:.3f} s" if value < 1 else f"{value:.2f} s" if value < 10 else f"{value:.1f} s"


def times(value):
    return f"{value:.1f} x" if value < 100 else f"{value:.0f} x"


def cell(entry, clock):
    if entry is None:
        return "-"
    if "failure" in entry:
        return entry["failure"]
    ratio = entry.get(f"{clock}_ratio")
    return seconds(entry[clock]) if ratio is None else f"{seconds(entry[clock])}, {times(ratio)}"


def line(result, threads):
    entries = result["threads"][threads]
    cells = [f"{name} {cell(entry, 'render')} / {cell(entry, 'whole')}" for name, entry in entries.items()]
    return f"{result['title']}, {threads} thread{'s' if threads > 1 else ''}: " + "; ".join(cells)


def table(names, results, threads, clock):
    rows = [["scene", *names.values()]]
    rows.append(["---"] * len(rows[0]))
    for result in results:
        entries = result["threads"][threads]
        rows.append([result["title"], *(cell(entries.get(name), clock) for name in names)])
    return "".join(f"| {' | '.join(row)} |\n" for row in rows)


def ratios_table(names, results, threads):
    """Both clocks in one: how many times as long as raytrace."""
    peers = [name for name in names if name != OURS]
    rows = [["scene", "raytrace", *(names[name] for name in peers)]]
    rows.append(["---"] * len(rows[0]))
    for result in results:
        entries = result["threads"][threads]
        row = [result["title"], f"{seconds(entries[OURS]['render'])} / {seconds(entries[OURS]['whole'])}"]
        for name in peers:
            entry = entries.get(name)
            if entry is None or "failure" in entry:
                row.append(cell(entry, "render"))
            else:
                row.append(f"{times(entry['render_ratio'])} / {times(entry['whole_ratio'])}")
        rows.append(row)
    return "".join(f"| {' | '.join(row)} |\n" for row in rows)


def machine_line(facts):
    where = f"{facts['processor']}, {facts['processors']} processors, {facts['system']}"
    return f"{where}; raytrace at commit {facts['commit']}"


def threads_text(count):
    return "1 thread" if count == 1 else f"{count} threads"


def page(facts, results, all_threads):
    names = facts["names"]
    text = [
        "# Comparison with other renderers\n",
        "`benchmarks/compare` writes this page. It installs the other renderers, writes each scene in each one's"
        " language, checks that the pictures agree, and renders in turns.\n",
        f"{machine_line(facts)}. Load when it began: {facts['load_at_start']}.\n",
        "![How many times as long as raytrace each renderer takes](comparison.svg)\n",
        "Each cell: the median, and how many times as long as raytrace it is, the median of the ratios of each round."
        f" Up to {facts['repeats']} rounds; a run is stopped after {facts['limit']:g} s."
        " A dash: the renderer cannot express the scene.\n",
    ]
    for threads in reversed(all_threads):
        for clock, title in CLOCKS.items():
            text.append(f"## {title}, {threads_text(threads)}\n")
            text.append(table(names, results, threads, clock))
    text.append("## What is rendered\n")
    text.append(
        "Objects at random places over an endless floor, in 9 matte colours, under one point light with shadows,"
        " 1024 x 1024 pixels, 16 samples per pixel, unless the name says otherwise. No ambient light and no"
        " highlights, since the renderers have different ideas of them; the background is blue where nothing is hit, so"
        " that coverage can be compared. [scenes.py](../benchmarks/comparison/scenes.py) makes the scenes. Each run"
        " reads its scene from a file and writes what it is at home in: raytrace and Mitsuba an EXR, the others an 8-bit"
        " PNG.\n"
    )
    text.append(
        "**Render only** is each renderer's own clock, without reading the scene, building its tree, or writing the"
        " picture. **Whole process** is from its start to its end, with the file closed.\n"
    )
    text.append("| renderer | version | command | |\n| --- | --- | --- | --- |\n" + "".join(
        f"| {name} | {facts['versions'][key]} | `{facts['commands'][key]}` | {facts['notes'][key]} |\n"
        for key, name in names.items()))
    text.append("## Do the pictures agree?\n")
    text.append(
        "One ray through the centre of each pixel of a picture 512 pixels high, against raytrace's: the share of the"
        " pixels that one hits and the other misses, and the share of those that both hit whose colours are more than"
        f" {pictures.COLOR_TOLERANCE} of the range apart. More than {pictures.COVERAGE_TOLERANCE:.1%} or"
        f" {pictures.SHADING_TOLERANCE:.0%}, and there is no time but `other picture`.\n"
    )
    peers = [name for name in names if name != OURS]
    rows = [["scene", *(names[name] for name in peers)], ["---"] * (len(peers) + 1)]
    for result in results:
        found = result["differences"]
        cells = [" / ".join(f"{x:.3%}" for x in found[name]) if name in found else "-" for name in peers]
        rows.append([result["title"], *cells])
    text.append("".join(f"| {' | '.join(row)} |\n" for row in rows))
    return "\n".join(text)


def readme_section(facts, results, threads):
    return (
        f"How many times as long as raytrace, {threads_text(threads)}, render only / whole process:\n\n"
        + ratios_table(facts["names"], results, threads)
        + "\n"
        + f"{machine_line(facts)}; "
        + "; ".join(version for name, version in facts["versions"].items() if name != OURS)
        + ".\n1 thread, seconds, how it was measured, and whether the pictures agree:"
        " [docs/comparison.md](docs/comparison.md); `benchmarks/compare` measures it on your machine.\n\n"
        "![How many times as long as raytrace each renderer takes](docs/comparison.svg)\n"
    )


def refresh_readme(section):
    path = os.path.join(REPOSITORY, "README.md")
    with open(path, encoding="utf-8") as file:
        text = file.read()
    before, _, rest = text.partition(MARKS[0])
    _, found, after = rest.partition(MARKS[1])
    if found:
        with open(path, "w", encoding="utf-8") as file:
            file.write(f"{before}{MARKS[0]}\n{section}{MARKS[1]}{after}")


def plot(facts, results, threads, file):
    import matplotlib

    matplotlib.use("svg")
    matplotlib.rcParams.update({"svg.hashsalt": "raytrace", "svg.fonttype": "none", "font.size": 9})
    from matplotlib import pyplot

    peers = [name for name in facts["names"] if name != OURS]
    size = (11, 1.5 + 0.38 * len(results))
    figure, panels = pyplot.subplots(1, 2, sharex=True, sharey=True, figsize=size, layout="constrained")
    for panel, (clock, title) in zip(panels, CLOCKS.items()):
        for row, result in enumerate(results):
            for index, name in enumerate(peers):
                entry = result["threads"][threads].get(name)
                if entry and "failure" not in entry:
                    label = facts["names"][name]
                    place = row + 0.24 * (index - (len(peers) - 1) / 2)
                    panel.barh(place, entry[f"{clock}_ratio"] - 1, 0.22, left=1, color=COLORS[index], label=label)
        panel.set_xscale("log")
        panel.axvline(1, color="black", linewidth=1)
        panel.set_xlabel("times as long as raytrace")
        panel.set_title(f"{title}, {threads_text(threads)}")
        panel.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
        panel.xaxis.set_minor_formatter("")
        panel.grid(axis="x", alpha=0.3)
    panels[0].set_yticks(range(len(results)), [result["title"] for result in results])
    panels[0].invert_yaxis()
    labelled = {}
    for handle, label in zip(*panels[0].get_legend_handles_labels()):
        labelled.setdefault(label, handle)
    figure.legend(labelled.values(), labelled.keys(), loc="outside lower center", ncols=len(peers))
    figure.savefig(file, metadata={"Date": None})
    pyplot.close(figure)


def write(facts, results, chosen):
    most = max(chosen.threads)

    def path(extension):
        return os.path.join(chosen.output, f"comparison.{extension}")

    with open(path("json"), "w", encoding="utf-8") as file:
        json.dump({"machine": facts, "results": results}, file, indent=1)
        file.write("\n")
    with open(path("md"), "w", encoding="utf-8") as file:
        file.write(page(facts, results, sorted(chosen.threads)))
    plot(facts, results, most, path("svg"))
    if os.path.realpath(chosen.output) == os.path.join(os.path.realpath(REPOSITORY), "docs"):
        refresh_readme(readme_section(facts, results, most))
