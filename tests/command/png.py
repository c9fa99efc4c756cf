"""Reads the PNG files that the program writes: RGB or RGBA, not interlaced. Written from the description of the format.
"""

import struct
import zlib


class Png:
    """text: keyword -> text; rows: lists of integers, `channels` a pixel."""

    def __init__(self, data):
        assert data[:8] == b"\x89PNG\r\n\x1a\n"
        self.text = {}
        packed, at = b"", 8
        while at < len(data):
            size, kind = struct.unpack_from(">I4s", data, at)
            body = data[at + 8:at + 8 + size]
            at += size + 12
            if kind == b"IHDR":
                self.width, self.height, self.bits, self.color, _, _, interlaced = struct.unpack(">IIBBBBB", body)
                self.channels = {2: 3, 6: 4}[self.color]
                assert not interlaced
            elif kind == b"IDAT":
                packed += body
            elif kind == b"tEXt":
                keyword, value = body.split(b"\0", 1)
                self.text[keyword.decode()] = value.decode("latin-1")
            elif kind == b"iTXt":
                keyword, value = body.split(b"\0", 1)
                self.text[keyword.decode()] = value.split(b"\0", 3)[3].decode()  # after two flags and two names
        self.rows = self._rows(zlib.decompress(packed))

    def pixel(self, x, y):
        return tuple(self.rows[y][self.channels * x:self.channels * (x + 1)])

    def _rows(self, plain):
        step = self.channels * self.bits // 8
        size = step * self.width
        rows, above = [], bytearray(size)
        for y in range(self.height):
            start = y * (size + 1)
            row = bytearray(plain[start + 1:start + 1 + size])
            _undo_filter(plain[start], row, above, step)
            rows.append(list(struct.unpack(f">{self.channels * self.width}{'B' if self.bits == 8 else 'H'}", row)))
            above = row
        return rows


def _undo_filter(kind, row, above, step):
    for i in range(len(row)):
        left = row[i - step] if i >= step else 0
        corner = above[i - step] if i >= step else 0
        if kind == 1:
            guess = left
        elif kind == 2:
            guess = above[i]
        elif kind == 3:
            guess = (left + above[i]) // 2
        elif kind == 4:
            guess = _paeth(left, above[i], corner)
        else:
            return
        row[i] = (row[i] + guess) & 255


def _paeth(left, up, corner):
    estimate = left + up - corner
    distances = [(abs(estimate - left), 0, left), (abs(estimate - up), 1, up), (abs(estimate - corner), 2, corner)]
    return min(distances)[2]
