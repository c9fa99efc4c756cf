"""Where things are."""

import os

REPOSITORY = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PROGRAM = os.environ.get("RAYTRACE_PROGRAM", os.path.join(REPOSITORY, "build", "release", "bin", "raytrace"))
WORK = os.path.join(REPOSITORY, "build", "comparison")
