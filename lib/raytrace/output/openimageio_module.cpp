#include "raytrace/output/openimageio_module.h"

#include <dlfcn.h>

#include <filesystem>

namespace raytrace {

namespace {

/// Where the module is beside this program's folder, in the build's tree and where the program is installed; where the
/// library was configured to be installed; wherever the system looks.
void* load_module() {
  constexpr const char* name = "raytrace_openimageio.so";
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::string candidates[] = {program.parent_path().parent_path() / RAYTRACE_MODULE_FOLDER / name,
                                    std::filesystem::path(RAYTRACE_INSTALLED_MODULE_FOLDER) / name, name};
  std::string reasons;
  for (const std::string& candidate : candidates) {
    if (void* const module = dlopen(candidate.c_str(), RTLD_NOW | RTLD_LOCAL)) return module;
    reasons += std::string(reasons.empty() ? " " : "; ") + dlerror();
  }
  throw OutputError("formats other than EXR need the module raytrace_openimageio.so, which cannot be loaded:" +
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

bool openimageio_reads_all_of(const std::string& file, int width, int height) {
  static auto* const reads_all_of = symbol<OpenImageIOReadsAllOf>("raytrace_openimageio_reads_all_of");
  return reads_all_of(file, width, height);
}

}  // namespace raytrace
