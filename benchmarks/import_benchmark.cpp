// How fast meshes are read from the page cache, beside the bare reading of the same file as `cat FILE >/dev/null` does
// it.
#include <fcntl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <vector>

#include "raytrace/import/read_mesh.h"

namespace {

using namespace raytrace;

template <class Function>
double median_seconds(int runs, const Function& f) {
  std::vector<double> seconds;
  for (int run = 0; run < runs; ++run) {
    const auto start = std::chrono::steady_clock::now();
    f();
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::ranges::nth_element(seconds, seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2));
  return seconds[seconds.size() / 2];
}

void read_plainly(const std::string& name) {
  constexpr std::size_t block = std::size_t{1} << 17U;
  const auto bytes = std::make_unique_for_overwrite<char[]>(block);
  const int file = open(name.c_str(), O_RDONLY | O_CLOEXEC);
  while (read(file, bytes.get(), block) > 0) continue;
  close(file);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> files;
  int runs = 7;
  MeshReadSettings settings;
  CLI::App parser("Times the readers of mesh files.");
  parser.add_option("FILES", files, "PLY, OBJ, STL and glTF files")->required();
  parser.add_option("-t,--threads", settings.threads, "0: all processors")->capture_default_str();
  parser.add_option("--runs", runs, "Runs of which the median counts")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  CLI11_PARSE(parser, argc, argv);

  std::printf("%-40s %8s %10s %8s %8s %8s %6s\n", "", "MB", "faces", "seconds", "MB/s", "bare", "ratio");
  for (const std::string& file : files) {
    const double megabytes = static_cast<double>(std::filesystem::file_size(file)) / 1e6;
    const double bare = median_seconds(runs, [&] { read_plainly(file); });
    std::size_t faces = 0;
    const double seconds = median_seconds(runs, [&] {
      Diagnostics diagnostics(file);
      const std::optional<MeshData> mesh = read_mesh(file, settings, diagnostics);
      if (mesh)
        faces = mesh->face_count();
      else
        diagnostics.print(std::cerr);
    });
    std::printf("%-40s %8.1f %10zu %8.4f %8.0f %8.0f %6.2f\n", std::filesystem::path(file).filename().c_str(),
                megabytes, faces, seconds, megabytes / seconds, megabytes / bare, bare / seconds);
  }
}
