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


def agree(differences, shares_shading):
    """If two renderers do not show the same scene, their times say nothing about each other."""
    coverage, shading = differences
    return coverage <= COVERAGE_TOLERANCE and (shading <= SHADING_TOLERANCE or not shares_shading)


def save_png(picture, file):
    from matplotlib import image

    image.imsave(file, numpy.clip(picture, 0, 1) ** (1 / 2.2))
