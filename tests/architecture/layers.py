"""layers.py ROOT: fails, and says where, unless

- each folder of lib/raytrace includes only itself and folders below it in the list of layers, so that none includes one
  that includes it;
- no narrow source, which is compiled once for all processors, reaches the SIMD library or a kernel through its
  includes: what is compiled for one instruction set must not leak into another's code.
"""

import re
import sys
from pathlib import Path

# From top to bottom. Folders in one line do not include each other.
LAYERS = [
    ["batch"],
    ["render"],
    ["variants"],
    ["tracing"],
    ["accel"],
    ["scene"],
    ["sampling", "aovs"],
    ["description"],
    ["shapes", "lights", "materials", "textures", "integrators"],
    ["bsdfs", "output", "display"],
    ["cameras"],
    ["film", "import"],
    ["parameters", "xml"],
    ["text"],
    ["math", "memory"],
    ["parallel"],
]

# Compiled for each instruction set, as lib/raytrace/CMakeLists.txt has it.
WIDE_SOURCES = re.compile(r"lib/raytrace/((accel|scene|tracing)/[^/]*|variants/variant)\.cpp$")
WIDE_HEADERS = re.compile(r"^xsimd/|raytrace/math/simd\.h$|_kernel\.h$|/kernels\.h$")
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*[<"]([^>"]+)[>"]', re.MULTILINE)


def includes_of(path):
    return INCLUDE.findall(path.read_text())


def layer_faults(root):
    layer = {folder: i for i, folders in enumerate(LAYERS) for folder in folders}
    faults = []
    for path in sorted((root / "lib/raytrace").glob("*/**/*.[hc]*")):
        folder = path.relative_to(root / "lib/raytrace").parts[0]
        if folder not in layer:
            faults.append(f"{path.relative_to(root)}: the list of layers has no folder {folder}")
            continue
        for name in includes_of(path):
            parts = name.split("/")
            if parts[0] != "raytrace" or len(parts) < 3 or parts[1] == folder:
                continue
            if layer.get(parts[1], -1) <= layer[folder]:
                faults.append(f"{path.relative_to(root)}: includes {name}, and {parts[1]}/ is not below {folder}/")
    return faults


def narrow_faults(root):
    """A source that reaches a wide header, with the chain of includes that leads there."""
    headers = {}

    def chain_from(name, path):
        """To a wide header; empty if there is none."""
        if WIDE_HEADERS.search(name):
            return [name]
        if path is None or not path.is_file():
            return []
        if path not in headers:
            headers[path] = []  # a header that includes itself leads nowhere
            headers[path] = chain_of(path)
        return [name, *headers[path]] if headers[path] else []

    def chain_of(path):
        for name in includes_of(path):
            inner = root / "lib" / name if name.startswith("raytrace/") else path.parent / name
            chain = chain_from(name, inner)
            if chain:
                return chain
        return []

    faults = []
    for folder in ("lib/raytrace", "apps"):
        for path in sorted((root / folder).glob("**/*.cpp")):
            name = path.relative_to(root).as_posix()
            if WIDE_SOURCES.search(name):
                continue
            chain = chain_of(path)
            if chain:
                faults.append(f"{name}: " + " -> ".join(chain))
    return faults


def main():
    root = Path(sys.argv[1])
    faults = layer_faults(root) + narrow_faults(root)
    for fault in faults:
        print(fault)
    return 1 if faults or not (root / "lib/raytrace").is_dir() else 0


if __name__ == "__main__":
    sys.exit(main())
