"""One module for each renderer. Each has

NAME            as the tables show it
available()     None, or why it cannot take part
version()       of the renderer, and of what its speed depends on
can(scene)      whether its language can express the scene
write(scene, folder)
                writes the scene into the folder as it is timed
render(folder, threads, limit)
                renders what write() left there once; returns a Times
picture(scene, folder, limit)
                renders the scene once more, untimed: one ray through the centre of each pixel; returns linear radiance,
                top row first, as an array of height x width x 3 with the scene's background where nothing is hit
shares_shading(scene)
                optional: False where its single samples cannot be held against ours, so that only coverage is
COMMAND         what is typed, and NOTE, what a reader of the table must know
"""

from . import mitsuba, povray, raytrace, tachyon

ALL = {"raytrace": raytrace, "mitsuba": mitsuba, "tachyon": tachyon, "povray": povray}
