"""The side-by-side benchmark of raytrace and other renderers: benchmarks/compare runs it."""
