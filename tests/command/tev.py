"""What the image viewer tev does with a connection, from the description of its protocol, so that what is tested is not
decoded by the code that wrote it; and viewers that behave badly."""

import array
import contextlib
import socket
import struct
import sys
import threading

CREATE_IMAGE, UPDATE_IMAGE_3 = 4, 6


class Image:
    """channels: name -> floats, row by row from the top; black at first."""

    def __init__(self, width, height, names):
        self.width, self.height = width, height
        self.channels = {name: array.array("f", bytes(4 * width * height)) for name in names}
        self.updates = []  # (x, y, width, height)

    def pixel(self, x, y):
        return tuple(self.channels[name][y * self.width + x] for name in "RGBA")


class Packet:
    """Takes fields from the front, and refuses to go beyond the end."""

    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, code):
        value, = struct.unpack_from("<" + code, self.data, self.at)
        self.at += struct.calcsize("<" + code)
        return value

    def text(self):
        end = self.data.index(0, self.at)
        value = self.data[self.at:end].decode()
        self.at = end + 1
        return value

    def floats(self):
        values = array.array("f", self.data[self.at:])
        if sys.byteorder == "big":
            values.byteswap()
        return values


class Viewer:
    """The pictures that a stream of packets makes, as tev keeps them."""

    def __init__(self):
        self.images = {}
        self.stream = b""

    def receive(self, data):
        self.stream += data
        while len(self.stream) >= 4:
            length, = struct.unpack_from("<I", self.stream)
            assert length >= 5, f"a packet of {length} bytes"
            if len(self.stream) < length:
                break
            self.handle(Packet(self.stream[4:length]))
            self.stream = self.stream[length:]

    def handle(self, packet):
        operation = packet.take("B")
        grab_focus = packet.take("B")
        assert grab_focus in (0, 1), grab_focus
        name = packet.text()
        if operation == CREATE_IMAGE:
            width, height, count = (packet.take("i") for _ in range(3))
            self.images[name] = Image(width, height, [packet.text() for _ in range(count)])
            assert packet.at == len(packet.data), "a packet longer than its fields"
        elif operation == UPDATE_IMAGE_3:
            self.update(self.images[name], packet)
        else:
            raise AssertionError(f"operation {operation}")

    @staticmethod
    def update(image, packet):
        names = [packet.text() for _ in range(packet.take("i"))]
        x, y, width, height = (packet.take("i") for _ in range(4))
        assert x >= 0 and y >= 0 and x + width <= image.width and y + height <= image.height, (x, y, width, height)
        offsets = [packet.take("q") for _ in names]
        strides = [packet.take("q") for _ in names]
        values = packet.floats()
        last = width * height - 1
        assert len(values) == max(o + last * s for o, s in zip(offsets, strides)) + 1, "more or fewer floats than pixels"
        for name, offset, stride in zip(names, offsets, strides):
            for row in range(height):
                start = offset + row * width * stride
                target = (y + row) * image.width + x
                image.channels[name][target:target + width] = values[start:start + width * stride:stride]
        image.updates.append((x, y, width, height))


def read_all(viewer):
    """How a server treats a connection: tev's way, which is to read until the other side ends."""
    def serve(connection):
        while data := connection.recv(1 << 20):
            viewer.receive(data)
    return serve


@contextlib.contextmanager
def server(serve, backlog=5):
    """Yields HOST:PORT of a server whose thread calls `serve` with each connection; what that raises is raised at the
    end. None: connections are never accepted."""
    errors = []
    ended = threading.Event()
    with socket.create_server(("127.0.0.1", 0), backlog=backlog) as listener:
        listener.settimeout(0.05)

        def accept():
            while not ended.is_set():
                try:
                    connection, _ = listener.accept()
                except TimeoutError:
                    continue
                connection.settimeout(300)
                try:
                    with connection:
                        serve(connection)
                except ConnectionError:
                    pass  # the other side gave up
                except Exception as error:  # pylint: disable=broad-except
                    errors.append(error)

        thread = threading.Thread(target=accept)
        if serve:
            thread.start()
        try:
            yield "127.0.0.1:%d" % listener.getsockname()[1]
        finally:
            ended.set()
            if serve:
                thread.join()
    if errors:
        raise errors[0]


def absent():
    """HOST:PORT where nobody listens."""
    with socket.create_server(("127.0.0.1", 0)) as listener:
        return "127.0.0.1:%d" % listener.getsockname()[1]
