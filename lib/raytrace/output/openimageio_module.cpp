#include "raytrace/output/openimageio_module.h"

#include <dlfcn.h>
#include <sys/mman.h>

#include <filesystem>
#include <new>

#include "raytrace/memory/out_of_memory.h"
#include "raytrace/memory/process_status.h"

namespace raytrace {

namespace {

/// The module brings so much that some of its libraries crash where there is no room for it, instead of saying so.
void need_room() {
  constexpr std::size_t room = std::size_t{512} << 20U;
  void* const reserved = mmap(nullptr, room, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (reserved == MAP_FAILED) throw std::bad_alloc();
  munmap(reserved, room);
}

/// Where the module is beside this program's folder, in the build's tree and where the program is installed; where the
/// library was configured to be installed; wherever the system looks.
void* load_module() {
  constexpr const char* name = "raytrace_openimageio.so";
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::string candidates[] = {program.parent_path().parent_path() / RAYTRACE_MODULE_FOLDER / name,
                                    std::filesystem::path(RAYTRACE_INSTALLED_MODULE_FOLDER) / name, name};
  need_room();
  std::string reasons;
  for (const std::string& candidate : candidates) {
    if (void* const module = dlopen(candidate.c_str(), RTLD_NOW | RTLD_LOCAL)) return module;
    const std::string reason = dlerror();
    if (says_out_of_memory(reason) || reason.find("failed to map segment") != std::string::npos) throw std::bad_alloc();
    reasons += (reasons.empty() ? " " : "; ") + reason;
  }
  throw OutputError(
      "textures, formats other than EXR and PNG, and OpenColorIO need the module raytrace_openimageio.so, which cannot "
      "be loaded:" +
      reasons);
}

template <class Function>
Function* symbol(const char* name) {
  static void* const module = load_module();
  return reinterpret_cast<Function*>(dlsym(module, name));
}

}  // namespace

std::unique_ptr<ImageEncoder> make_openimageio_encoder(const std::string& file, const std::string& extension,
                                                       const ImageFileSettings& settings) {
  static auto* const make = symbol<MakeOpenImageIOEncoder>("raytrace_make_openimageio_encoder");
  return std::unique_ptr<ImageEncoder>(make(file, extension, settings));
}

std::shared_ptr<const ColorTransform> ocio_transform(const OcioSettings& settings) {
  if (settings.empty()) return nullptr;
  static auto* const transform = symbol<OpenImageIOColorTransform>("raytrace_openimageio_color_transform");
  std::shared_ptr<const ColorTransform> result;
  transform(settings, result);
  return result;
}

std::unique_ptr<PictureReader> make_openimageio_reader(const std::string& file, std::string_view bytes) {
  static auto* const make = symbol<MakeOpenImageIOReader>("raytrace_make_openimageio_reader");
  std::unique_ptr<PictureReader> reader;
  make(file, bytes, reader);
  return reader;
}

GridTiles read_vdb_tiles(const std::string& file, const std::string& name) {
  static auto* const read = symbol<ReadOpenImageIOGrid>("raytrace_read_grid");
  GridTiles grid;
  grid.most_bytes = available_memory() / 2;
  read(file, name, grid);
  return grid;
}

bool openimageio_reads_all_of(const std::string& file, int width, int height) {
  static auto* const reads_all_of = symbol<OpenImageIOReadsAllOf>("raytrace_openimageio_reads_all_of");
  return reads_all_of(file, width, height);
}

}  // namespace raytrace
