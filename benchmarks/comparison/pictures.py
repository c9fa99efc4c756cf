"""Reads the renderers' pictures, and says whether two show the same scene."""

import numpy

from .scenes import BACKGROUND

# Rays that pass an edge within the rounding of their numbers may hit in one renderer and miss in the other.
COVERAGE_TOLERANCE = 0.005  # of the pixels: hit in one picture only
SHADING_TOLERANCE = 0.04  # of the pixels that both hit: colours further apart than
COLOR_TOLERANCE = 0.01  # this, of the range from 0 to 1


def read_exr(file):
    import OpenEXR

    with OpenEXR.File(file) as image:
        channels = image.channels()
        name = "RGBA" if "RGBA" in channels else "RGB"
        return channels[name].pixels[:, :, :3].astype(numpy.float32)


def read_ppm48(file):
    with open(file, "rb") as stream:
        fields = []
        while len(fields) < 4:
            fields += stream.readline().split(b"#")[0].split()
        width, height, largest = map(int, fields[1:])
        values = numpy.frombuffer(stream.read(), dtype=">u2").reshape(height, width, 3)
    return values.astype(numpy.float32) / largest


def hit_mask(picture):
    return numpy.abs(picture - numpy.array(BACKGROUND)).max(axis=2) > 1e-3


def difference(ours, theirs):
    """Shares of the pixels that differ: (in coverage, in shading)."""
    ours_hit, theirs_hit = hit_mask(ours), hit_mask(theirs)
    both = ours_hit & theirs_hit
    far = numpy.abs(ours - theirs).max(axis=2) > COLOR_TOLERANCE
    return float((ours_hit != theirs_hit).mean()), float(far[both].mean())


class Disagreement(Exception):
    """Two renderers do not show the same scene, so that their times say nothing about each other."""


def demand_agreement(scene, name, differences, shares_shading):
    coverage, shading = differences
    if coverage > COVERAGE_TOLERANCE:
        raise Disagreement(f"{name} hits and misses elsewhere in {coverage:.2%} of the pixels; see {scene.name}-*.png")
    if shares_shading and shading > SHADING_TOLERANCE:
        raise Disagreement(f"{name} shades {shading:.2%} of the pixels differently; see {scene.name}-*.png")


def save_png(picture, file):
    from matplotlib import image

    image.imsave(file, numpy.clip(picture, 0, 1) ** (1 / 2.2))
