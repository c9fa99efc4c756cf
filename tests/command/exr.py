"""Reads the EXR files that the program writes: one part, scanlines, zip or (checkpoints) no compression. Written from
the description of the format, so that what is tested is not read back by the library that wrote it."""

import array
import functools
import itertools
import struct
import sys
import zlib


class Exr:
    """attributes: name -> (type, bytes); channels: names; rows: y -> channel -> tuple of values; row_bytes: the same, as
    they stand in the file. Pixels, which take long to unpack, are read when they are asked for."""

    def __init__(self, data):
        self._data = data
        magic, version = struct.unpack_from("<iI", data, 0)
        assert magic == 20000630 and version == 2, "not a plain single-part scanline EXR"
        self.attributes = {}
        at = 8
        while data[at] != 0:
            name, at = _text(data, at)
            kind, at = _text(data, at)
            size, = struct.unpack_from("<i", data, at)
            self.attributes[name] = (kind, data[at + 4:at + 4 + size])
            at += 4 + size
        at += 1
        self.data_window = struct.unpack("<4i", self.attributes["dataWindow"][1])
        self.display_window = struct.unpack("<4i", self.attributes["displayWindow"][1])
        self.channels = _channels(self.attributes["channels"][1])
        left, top, right, bottom = self.data_window
        self.width, self.height = right - left + 1, bottom - top + 1
        none, zips = 0, 3
        compression, = self.attributes["compression"][1]
        assert compression in (none, zips)
        self._lines_of_chunk = 16 if compression == zips else 1
        self._offsets = at

    @functools.cached_property
    def row_bytes(self):
        rows = {}
        for chunk in range((self.height + self._lines_of_chunk - 1) // self._lines_of_chunk):
            offset, = struct.unpack_from("<Q", self._data, self._offsets + 8 * chunk)
            y, size = struct.unpack_from("<ii", self._data, offset)
            lines = min(self._lines_of_chunk, self.data_window[3] + 1 - y)
            rows.update(self._chunk_rows(y, lines, self._data[offset + 8:offset + 8 + size]))
        return rows

    def _chunk_rows(self, first, lines, packed):
        size = lines * self.width * sum(struct.calcsize(code) for code in self.channels.values())
        plain = packed if len(packed) == size else _unpack(packed)
        at = 0
        for y in range(first, first + lines):
            row = {}
            for name, code in self.channels.items():
                row[name] = plain[at:at + self.width * struct.calcsize(code)]
                at += len(row[name])
            yield y, row

    @functools.cached_property
    def rows(self):
        return {y: {name: struct.unpack(f"<{self.width}{code}", row[name]) for name, code in self.channels.items()}
                for y, row in self.row_bytes.items()}

    def bytes_of(self, left, top, right, bottom):
        """The pixels [left, right) x [top, bottom) as (y, channel) -> bytes: equal only where all bits are."""
        first, end = left - self.data_window[0], right - self.data_window[0]
        return {(y, name): self.row_bytes[y][name][struct.calcsize(code) * first:struct.calcsize(code) * end]
                for y in range(top, bottom) for name, code in self.channels.items()}

    def pixel(self, x, y):
        return tuple(self.rows[y][name][x - self.data_window[0]] for name in "RGBA")

    def pixels(self):
        left, top, right, bottom = self.data_window
        return {(x, y): self.pixel(x, y) for y in range(top, bottom + 1) for x in range(left, right + 1)}

    def text(self, name):
        kind, value = self.attributes[name]
        assert kind == "string", kind
        return value.decode()


def _text(data, at):
    end = data.index(0, at)
    return data[at:end].decode(), end + 1


def _channels(data):
    codes = {0: "I", 1: "e", 2: "f"}  # unsigned integer, half and float, as struct names them
    channels, at = {}, 0
    while data[at] != 0:
        name, at = _text(data, at)
        channels[name] = codes[struct.unpack_from("<i", data, at)[0]]
        at += 16
    return channels


_BY_128 = bytes((value + 128) & 255 for value in range(256))


def _unpack(packed):
    """zlib, then a running sum of which each but the first takes 128, then the two halves interleaved."""
    sums = array.array("Q", itertools.accumulate(zlib.decompress(packed)))
    low = sums.tobytes()[::8] if sys.byteorder == "little" else sums.tobytes()[7::8]
    summed = bytearray(low)
    summed[1::2] = low[1::2].translate(_BY_128)
    half = (len(summed) + 1) // 2
    plain = bytearray(len(summed))
    plain[0::2] = summed[:half]
    plain[1::2] = summed[half:]
    return bytes(plain)
