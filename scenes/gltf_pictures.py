"""Pictures for glTF files: what generate_gltf_features.py has on its models. Python 3.8 or later, standard library only."""
import functools
import math
import struct
import zlib

from scene_xml import unit


@functools.lru_cache(None)
def png(color, size=256):
    """color(x, y), of places in [0, 1]: three or four numbers in [0, 1], as they are stored. 3 x 3 samples a pixel."""
    grid, rows = 3, []
    for j in range(size):
        row = bytearray(b"\0")
        for i in range(size):
            some = [color((i + (a + 0.5) / grid) / size, (j + (b + 0.5) / grid) / size)
                    for a in range(grid) for b in range(grid)]
            row += bytes(round(255 * min(max(sum(c) / len(some), 0), 1)) for c in zip(*some))
        rows.append(bytes(row))

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    channels = 6 if len(color(0.5, 0.5)) == 4 else 2
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", size, size, 8, channels, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(b"".join(rows), 9)) + chunk(b"IEND", b""))


def hexadecimal(text):
    return tuple(int(text[i : i + 2], 16) / 255 for i in (1, 3, 5))


def stripes(x, y):
    colors = ("#f2e9d8", "#2f6fa8", "#f2e9d8", "#d9593d")
    return hexadecimal(colors[int(x * 24) % 4])


def arrow(x, y):
    """In a frame, to the upper right, with a dot at the lower left."""
    if max(abs(x - 0.5), abs(y - 0.5)) > 0.46:
        return hexadecimal("#1d2430")
    if math.hypot(x - 0.27, y - 0.73) < 0.12:
        return hexadecimal("#d9593d")
    along, across = ((x - 0.5) + (0.5 - y)) / math.sqrt(2), ((x - 0.5) - (0.5 - y)) / math.sqrt(2)
    if (-0.15 < along < 0.1 and abs(across) < 0.06) or (0.1 <= along and abs(across) < 0.36 - along):
        return hexadecimal("#2f6fa8")
    return hexadecimal("#f2e9d8")


def dots(x, y):
    """Round holes, whose edges are soft."""
    columns, rows = 10, 6
    rank = int(y * rows)
    dx, dy = (x * columns + 0.5 * (rank % 2)) % 1 - 0.5, (y * rows) % 1 - 0.5
    return (*hexadecimal("#2f6fa8"), min(max((math.hypot(dx * 1.05, dy) - 0.22) / 0.26, 0), 1))


def studs(x, y):
    """The normals of round studs."""
    dx, dy = (x * 16) % 1 - 0.5, (y * 8) % 1 - 0.5
    height = 0.2 - dx * dx - dy * dy
    n = unit((2.2 * dx, -2.2 * dy, 1)) if 0 < height < 0.17 else (0, 0, 1)
    return tuple(0.5 + 0.5 * c for c in n)
