"""Path tracing side by side with other renderers, at equal error: benchmarks/compare paths runs it."""
