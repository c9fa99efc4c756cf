"""--display-server: what a viewer gets, and that no viewer can harm the render."""

import os
import socket
import struct
import threading
import unittest

import support
import tev
from exr import Exr
from support import CommandTest

# A date, so that the same picture is the same file.
ENVIRONMENT = dict(os.environ, SOURCE_DATE_EPOCH="1000000000")

# Larger than all that the system keeps for a reader who does not read.
LARGE = ["-r", "1200x900", "-s", "1"]


class Shown(CommandTest):
    def shown(self, *arguments):
        """The viewer after the run, which had nothing to complain of."""
        viewer = tev.Viewer()
        with tev.server(tev.read_all(viewer)) as address:
            done = self.succeed("scene.xml", "-q", "--float", "-o", "a.exr", "--display-server", address, *arguments)
        self.assertEqual((done.stdout, done.stderr), ("", ""))
        self.assertEqual(viewer.stream, b"")
        self.assertEqual(list(viewer.images), ["a.exr"])
        return viewer.images["a.exr"]

    def check(self, image, size):
        self.assertEqual((image.width, image.height), size)
        self.assertEqual(list(image.channels), ["R", "G", "B", "A"])
        written = Exr(self.read("a.exr")).pixels()
        black = (0, 0, 0, 0)
        wrong = [(x, y) for y in range(image.height) for x in range(image.width)
                 if image.pixel(x, y) != written.get((x, y), black)]
        self.assertEqual(wrong, [])

    def test_the_picture_to_the_last_bit(self):
        self.check(self.shown(), (80, 60))

    def test_a_crop_in_its_place(self):
        image = self.shown("--crop", "13,7,50,41")
        self.check(image, (80, 60))
        for x, y, width, height in image.updates:
            self.assertTrue(x >= 13 and y >= 7 and x + width <= 50 and y + height <= 41)

    def test_pixels_beyond_the_picture(self):
        """The viewer's image is as large as both, from its own top left."""
        image = self.shown("--crop=-8,5,80,70")
        self.assertEqual((image.width, image.height), (88, 70))
        written = Exr(self.read("a.exr")).pixels()
        wrong = [(x, y) for y in range(70) for x in range(88)
                 if image.pixel(x, y) != written.get((x - 8, y), (0, 0, 0, 0))]
        self.assertEqual(wrong, [])

    def test_many_packets(self):
        image = self.shown("-r", "500x333", "-s", "1")
        self.check(image, (500, 333))
        self.assertGreater(len(image.updates), 1)


class BadViewers(CommandTest):
    """The run ends with exit code 0, the right file, and a warning: one, however often the viewer is tried."""

    # As the system puts it: that depends on what was under way.
    HUNG_UP = "it hung up|Connection reset by peer|Broken pipe"

    def check(self, address, reason, *arguments):
        self.succeed("scene.xml", "-q", "-o", "right.exr", *arguments, env=ENVIRONMENT)
        done = self.succeed("scene.xml", "-o", "a.exr", "--progress=none", "--display-server", address, *arguments,
                            env=ENVIRONMENT, timeout=300)
        self.assertEqual(done.stdout, "")
        self.assertRegex(done.stderr, rf"^raytrace: warning: the picture is not shown on {address}: ({reason}); "
                                      r"the render goes on\n$")
        self.assertEqual(self.read("a.exr"), self.read("right.exr"))

    def test_absent(self):
        self.check(tev.absent(), "Connection refused")

    def test_no_host_of_the_name(self):
        self.check("no-such-host.invalid:14158", ".*")

    def test_connects_to_nobody(self):
        with tev.server(None, backlog=0) as address:
            host, port = address.split(":")
            # With the queue of connections full, the system no longer answers.
            waiting = [socket.socket() for _ in range(3)]
            for one in waiting:
                one.setblocking(False)
                one.connect_ex((host, int(port)))
            self.check(address, "no answer in time")
            for one in waiting:
                one.close()

    def test_never_reads(self):
        ended = threading.Event()
        with tev.server(lambda connection: ended.wait(300)) as address:
            try:
                self.check(address, "no answer in time")
                self.check(address, "no answer in time", *LARGE)
            finally:
                ended.set()

    def test_hangs_up(self):
        def after(amount):
            def serve(connection):
                left = amount
                while left > 0:
                    left -= len(connection.recv(left))
            return serve

        for amount in (0, 3, 1000, 1000000):
            with tev.server(after(amount)) as address:
                self.check(address, self.HUNG_UP, *LARGE)

    def test_hangs_up_at_once_and_hard(self):
        def serve(connection):
            connection.recv(10)
            connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))

        with tev.server(serve) as address:
            self.check(address, self.HUNG_UP, *LARGE)

    def test_sends_garbage(self):
        def serve(connection):
            garbage = bytes(range(256)) * 4096
            while True:
                connection.sendall(garbage)

        with tev.server(serve) as address:
            self.check(address, "it answers, which tev never does")

    def test_quiet(self):
        done = self.succeed("scene.xml", "-q", "-o", "a.exr", "--display-server", tev.absent())
        self.assertEqual(done.stderr, "")


if __name__ == "__main__":
    unittest.main()
