"""Reads the EXR files that the program writes: one part, scanlines, zip or (checkpoints) no compression. Written from
the description of the format, so that what is tested is not read back by the library that wrote it."""

import itertools
import struct
import zlib


class Exr:
    """attributes: name -> (type, bytes); channels: names; rows: y -> channel -> tuple of values; row_bytes: the same, as
    they stand in the file."""

    def __init__(self, data):
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
        none, zips = 0, 3
        compression, = self.attributes["compression"][1]
        assert compression in (none, zips)
        left, top, right, bottom = self.data_window
        self.width, self.height = right - left + 1, bottom - top + 1
        lines = 16 if compression == zips else 1
        self.rows, self.row_bytes = {}, {}
        for chunk in range((self.height + lines - 1) // lines):
            offset, = struct.unpack_from("<Q", data, at + 8 * chunk)
            y, size = struct.unpack_from("<ii", data, offset)
            self._read_chunk(y, min(lines, bottom + 1 - y), data[offset + 8:offset + 8 + size])

    def _read_chunk(self, first, lines, packed):
        size = lines * self.width * sum(struct.calcsize(code) for code in self.channels.values())
        plain = packed if len(packed) == size else _unpack(packed)
        at = 0
        for y in range(first, first + lines):
            row, row_bytes = self.rows[y], self.row_bytes[y] = {}, {}
            for name, code in self.channels.items():
                row[name] = struct.unpack_from(f"<{self.width}{code}", plain, at)
                row_bytes[name] = plain[at:at + self.width * struct.calcsize(code)]
                at += len(row_bytes[name])

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


def _unpack(packed):
    """zlib, then a running sum, then the two halves interleaved."""
    summed = bytes(itertools.accumulate(zlib.decompress(packed), lambda a, b: (a + b - 128) & 255))
    half = (len(summed) + 1) // 2
    plain = bytearray(len(summed))
    plain[0::2] = summed[:half]
    plain[1::2] = summed[half:]
    return bytes(plain)
