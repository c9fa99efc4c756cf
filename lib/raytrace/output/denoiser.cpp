#include "raytrace/output/denoiser.h"

#include <dlfcn.h>

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <new>
#include <type_traits>

#include "raytrace/memory/out_of_memory.h"
#include "raytrace/output/file_handle.h"

namespace raytrace {

namespace {

// What we use of the library's interface, whose headers only its own packages have: names, types and numbers are those
// of https://www.openimagedenoise.org/documentation.html.

using DeviceHandle = void;
using FilterHandle = void;
using ProgressMonitor = bool(void* data, double done);

constexpr int cpu_device = 1;
constexpr int three_floats = 3;  // a pixel's format
constexpr int no_error = 0, error_out_of_memory = 4, error_cancelled = 6;

void* open_library() {
  constexpr const char* name = "libOpenImageDenoise.so.2";
  std::vector<std::string> candidates;
  if (const char* const folder = std::getenv("RAYTRACE_DENOISER"); folder != nullptr && *folder != '\0') {
    candidates.push_back(std::filesystem::path(folder) / name);
  } else {
    std::error_code error;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
    candidates = {program.parent_path() / "lib" / name, program.parent_path().parent_path() / "denoiser/lib" / name,
                  name};
  }
  std::string reasons;
  for (const std::string& candidate : candidates) {
    if (void* const library = dlopen(candidate.c_str(), RTLD_NOW | RTLD_LOCAL)) return library;
    const std::string reason = dlerror();
    if (says_out_of_memory(reason) || reason.find("failed to map segment") != std::string::npos) throw std::bad_alloc();
    if (candidates.size() == 1 || std::filesystem::exists(candidate)) reasons += ": " + reason;
  }
  throw OutputError("denoising needs Open Image Denoise 2, whose library libOpenImageDenoise.so.2 cannot be loaded" +
                    reasons +
                    "; with raytrace's sources, run cmake/denoiser; else install it, and say where its libraries are: "
                    "RAYTRACE_DENOISER=FOLDER");
}

class Library {
 public:
  /// The one of the process. Throws OutputError if there is none.
  static const Library& instance() {
    static const Library library;
    return library;
  }

  DeviceHandle* (*new_device)(int type);
  void (*set_device_int)(DeviceHandle*, const char* name, int value);
  void (*set_device_bool)(DeviceHandle*, const char* name, bool value);
  int (*get_device_int)(DeviceHandle*, const char* name);
  void (*commit_device)(DeviceHandle*);
  int (*get_device_error)(DeviceHandle*, const char** message);
  void (*release_device)(DeviceHandle*);
  FilterHandle* (*new_filter)(DeviceHandle*, const char* type);
  void (*set_filter_image)(FilterHandle*, const char* name, void* data, int format, std::size_t width,
                           std::size_t height, std::size_t offset, std::size_t pixel_stride, std::size_t row_stride);
  void (*set_filter_bool)(FilterHandle*, const char* name, bool value);
  void (*set_filter_progress_monitor)(FilterHandle*, ProgressMonitor*, void* data);
  void (*commit_filter)(FilterHandle*);
  void (*execute_filter)(FilterHandle*);
  void (*release_filter)(FilterHandle*);

 private:
  Library() : library_(open_library()) {
    find(new_device, "oidnNewDevice");
    find(set_device_int, "oidnSetDeviceInt");
    find(set_device_bool, "oidnSetDeviceBool");
    find(get_device_int, "oidnGetDeviceInt");
    find(commit_device, "oidnCommitDevice");
    find(get_device_error, "oidnGetDeviceError");
    find(release_device, "oidnReleaseDevice");
    find(new_filter, "oidnNewFilter");
    find(set_filter_image, "oidnSetSharedFilterImage");
    find(set_filter_bool, "oidnSetFilterBool");
    find(set_filter_progress_monitor, "oidnSetFilterProgressMonitorFunction");
    find(commit_filter, "oidnCommitFilter");
    find(execute_filter, "oidnExecuteFilter");
    find(release_filter, "oidnReleaseFilter");
  }

  template <class Function>
  void find(Function*& function, const char* name) {
    function = reinterpret_cast<Function*>(dlsym(library_, name));
    if (function == nullptr)
      throw OutputError(std::string("denoising needs Open Image Denoise 2; its library has no ") + name);
  }

  void* library_;  // stays loaded
};

class Device {
 public:
  explicit Device(int threads) : device_(library_.new_device(cpu_device), library_.release_device) {
    if (device_ == nullptr) refuse();
    if (threads > 0) library_.set_device_int(device_.get(), "numThreads", threads);
    library_.set_device_bool(device_.get(), "setAffinity", false);  // several programs may share the processors
    library_.commit_device(device_.get());
    is_good();
  }

  std::string version() const {
    const int version = library_.get_device_int(device_.get(), "version");
    return std::to_string(version / 10000) + "." + std::to_string(version / 100 % 100) + "." +
           std::to_string(version % 100);
  }

  enum class Guided { no, yes };

  /// Filters one of the picture's images where it lies, guided by albedo and normal, which have no noise, or by
  /// nothing. image: as the library calls it; a colour is radiance if `hdr`, else from 0 to 1. False if it was stopped.
  bool filter(DenoiserPicture& picture, std::vector<float>& pixels, const char* image, Guided guided, bool hdr,
              const std::function<bool()>& stop) const {
    const std::unique_ptr<FilterHandle, decltype(Library::release_filter)> filter(
        library_.new_filter(device_.get(), "RT"), library_.release_filter);
    if (filter == nullptr) refuse();
    const auto add = [&](const char* role, std::vector<float>& data) {
      library_.set_filter_image(filter.get(), role, data.data(), three_floats, static_cast<std::size_t>(picture.width),
                                static_cast<std::size_t>(picture.height), 0, 0, 0);
    };
    add(image, pixels);
    add("output", pixels);
    if (guided == Guided::yes) {
      add("albedo", picture.albedo);
      add("normal", picture.normal);
      library_.set_filter_bool(filter.get(), "hdr", hdr);
      library_.set_filter_bool(filter.get(), "srgb", !hdr);  // what is from 0 to 1 is filtered as it is
      library_.set_filter_bool(filter.get(), "cleanAux", true);
    }
    const auto goes_on = [](void* data, double) { return !(*static_cast<const std::function<bool()>*>(data))(); };
    library_.set_filter_progress_monitor(filter.get(), goes_on, const_cast<std::function<bool()>*>(&stop));
    library_.commit_filter(filter.get());
    library_.execute_filter(filter.get());
    return is_good();
  }

 private:
  /// False if what was done last was stopped.
  bool is_good() const {
    const char* message = nullptr;
    const int error = library_.get_device_error(device_.get(), &message);
    if (error == error_out_of_memory) throw std::bad_alloc();
    if (error != no_error && error != error_cancelled) refuse(message);
    return error == no_error;
  }

  [[noreturn]] static void refuse(const char* message = nullptr) {
    throw OutputError(std::string("Open Image Denoise fails") + (message == nullptr ? "" : ": ") +
                      (message == nullptr ? "" : message));
  }

  const Library& library_ = Library::instance();
  std::unique_ptr<DeviceHandle, decltype(Library::release_device)> device_;
};

}  // namespace

std::string denoiser_name() { return "Open Image Denoise " + Device(1).version(); }

std::optional<DenoiserPicture> denoised(DenoiserPicture picture, int threads, const std::function<bool()>& stop) {
  using enum Device::Guided;
  const Device device(threads);
  // First what guides the others, so that its own noise shows nowhere.
  if (!device.filter(picture, picture.albedo, "albedo", no, false, stop) ||
      !device.filter(picture, picture.normal, "normal", no, false, stop) ||
      !device.filter(picture, picture.color, "color", yes, true, stop))
    return std::nullopt;
  for (std::vector<float>& layer : picture.layers)
    if (!device.filter(picture, layer, "color", yes, true, stop)) return std::nullopt;
  if (!picture.alpha.empty() && !device.filter(picture, picture.alpha, "color", yes, false, stop)) return std::nullopt;
  return picture;
}

}  // namespace raytrace
