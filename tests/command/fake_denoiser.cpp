// Stands in for Open Image Denoise's library, so that tests need not load it: the functions that the program uses, of
// the same names and meaning (https://www.openimagedenoise.org/documentation.html), and a filter that tells in each
// number what it was made of:
//
//   albedo alone: 2 albedo       normal alone: -normal       color, hdr: color / 2 + albedo + 4 normal
//   color from 0 to 1: color / 2 + albedo / 8
//
// $FAKE_DENOISER: "fails": each filter does; "memory": has none; "waits": until the program's progress monitor stops
// it.
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <string>
#include <thread>

namespace {

struct Device {
  int error = 0;
  std::string message;
  bool committed = false;
};

struct Filter {
  explicit Filter(Device* owner) : device(owner) {}
  Device* device;
  std::map<std::string, float*> images;
  std::map<std::string, bool> flags;
  std::size_t numbers = 0;
  bool (*monitor)(void*, double) = nullptr;
  void* monitor_data = nullptr;
  bool committed = false;
};

std::string mode() {
  const char* const text = std::getenv("FAKE_DENOISER");
  return text == nullptr ? "" : text;
}

}  // namespace

// NOLINTBEGIN(readability-identifier-naming): the library's
extern "C" {

void* oidnNewDevice(int type) { return type == 1 ? new Device : nullptr; }
void oidnSetDeviceInt(void*, const char*, int) {}
void oidnSetDeviceBool(void*, const char*, bool) {}
int oidnGetDeviceInt(void*, const char* name) { return std::string(name) == "version" ? 20304 : 0; }
void oidnCommitDevice(void* device) { static_cast<Device*>(device)->committed = true; }
void oidnReleaseDevice(void* device) { delete static_cast<Device*>(device); }

int oidnGetDeviceError(void* handle, const char** message) {
  auto* const device = static_cast<Device*>(handle);
  *message = device->message.c_str();
  const int error = device->error;
  device->error = 0;
  return error;
}

void* oidnNewFilter(void* handle, const char* type) {
  auto* const device = static_cast<Device*>(handle);
  return device->committed && std::string(type) == "RT" ? new Filter(device) : nullptr;
}

void oidnSetSharedFilterImage(void* handle, const char* name, void* data, int format, std::size_t width,
                              std::size_t height, std::size_t offset, std::size_t pixel_stride,
                              std::size_t row_stride) {
  auto* const filter = static_cast<Filter*>(handle);
  constexpr int three_floats = 3;
  if (format != three_floats || offset != 0 || pixel_stride != 0 || row_stride != 0) {
    filter->device->error = 2;
    filter->device->message = "unknown layout";
  }
  filter->images[name] = static_cast<float*>(data);
  filter->numbers = 3 * width * height;
}

void oidnSetFilterBool(void* filter, const char* name, bool value) {
  static_cast<Filter*>(filter)->flags[name] = value;
}

void oidnSetFilterProgressMonitorFunction(void* handle, bool (*monitor)(void*, double), void* data) {
  auto* const filter = static_cast<Filter*>(handle);
  filter->monitor = monitor;
  filter->monitor_data = data;
}

void oidnCommitFilter(void* filter) { static_cast<Filter*>(filter)->committed = true; }

void oidnExecuteFilter(void* handle) {
  auto* const filter = static_cast<Filter*>(handle);
  Device& device = *filter->device;
  if (mode() == "fails" || mode() == "memory") {
    device.error = mode() == "fails" ? 1 : 4;
    device.message = "it was asked to";
    return;
  }
  while (mode() == "waits" && filter->monitor(filter->monitor_data, 0.5))
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  if (!filter->monitor(filter->monitor_data, 1)) {
    device.error = 6;
    return;
  }
  auto& images = filter->images;
  float* const output = images["output"];
  if (images.count("color") != 0 && filter->committed && filter->flags["cleanAux"] &&
      filter->flags["hdr"] != filter->flags["srgb"]) {
    for (std::size_t i = 0; i < filter->numbers; ++i) {
      const float color = images["color"][i] / 2, albedo = images["albedo"][i], normal = images["normal"][i];
      output[i] = filter->flags["hdr"] ? color + albedo + 4 * normal : color + albedo / 8;
    }
  } else if (images.count("color") == 0 && filter->committed && filter->images.size() == 2) {
    for (std::size_t i = 0; i < filter->numbers; ++i)
      output[i] = images.count("albedo") != 0 ? 2 * images["albedo"][i] : -images["normal"][i];
  } else {
    device.error = 3;
    device.message = "not the images and flags that it needs";
  }
}

void oidnReleaseFilter(void* filter) { delete static_cast<Filter*>(filter); }

}  // extern "C"
// NOLINTEND(readability-identifier-naming)
