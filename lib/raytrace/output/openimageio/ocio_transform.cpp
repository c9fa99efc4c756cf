// OpenColorIO's displays and views, through OpenImageIO.
#include <OpenImageIO/color.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "raytrace/output/atomic_file.h"
#include "raytrace/output/openimageio_module.h"
#include "raytrace/text/message.h"

namespace raytrace {
namespace {

using OcioNames = std::vector<std::string>;

[[noreturn]] void refuse(const OcioSettings& settings, const std::string& reason) {
  throw OutputError("--ocio: " + settings.config + ": " + reason);
}

bool has_name(const OcioNames& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Throws unless it is one of the names.
void require_name(const OcioSettings& settings, const std::string& what, const std::string& name,
                  const OcioNames& names) {
  if (has_name(names, name)) return;
  const std::vector<std::string_view> views(names.begin(), names.end());
  const std::string_view nearest = nearest_name(name, views);
  refuse(settings, "it has no " + what + " " + in_quotes(name) +
                       (nearest.empty() ? "; it has " + joined(names, ", ")
                                        : "; did you mean " + in_quotes(std::string(nearest)) + "?"));
}

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// All names that a colour space may be asked for by.
OcioNames color_space_names(const OIIO::ColorConfig& config) {
  OcioNames names = config.getColorSpaceNames();
  for (const std::string& space : config.getColorSpaceNames())
    for (const std::string& alias : config.getAliases(space)) names.push_back(alias);
  for (const std::string& role : config.getRoles()) names.push_back(role);
  return names;
}

/// Linear Rec. 709, by the names that configurations have for it; else what they render in.
std::string linear_color_space(const OcioSettings& settings, const OIIO::ColorConfig& config, const OcioNames& names) {
  constexpr std::array known = {"Linear Rec.709 (sRGB)",
                                "lin_rec709",
                                "lin_srgb",
                                "lin_rec709_srgb",
                                "Linear Rec.709",
                                "Linear BT.709",
                                "Utility - Linear - sRGB",
                                "Utility - Linear - Rec.709"};
  for (const char* const name : known)
    if (has_name(names, name)) return name;
  if (const char* const space = config.getColorSpaceNameByRole("scene_linear")) return space;
  refuse(settings,
         "it has neither a linear Rec. 709 nor the role scene_linear: say with --ocio-colorspace which "
         "colour space the picture is in");
}

class OcioTransform final : public ColorTransform {
 public:
  explicit OcioTransform(OIIO::ColorProcessorHandle processor) : processor_(std::move(processor)) {}

  void apply(float* values, int pixels, int channels) const override {
    const auto stride = static_cast<OIIO::stride_t>(sizeof(float)) * channels;
    processor_->apply(values, pixels, 1, 3, sizeof(float), stride, stride * pixels);
  }

 private:
  OIIO::ColorProcessorHandle processor_;
};

std::shared_ptr<const ColorTransform> made_transform(const OcioSettings& settings) {
  if (!OIIO::ColorConfig::supportsOpenColorIO()) refuse(settings, "this machine's OpenImageIO has no OpenColorIO");
  std::error_code unknown;
  if (!settings.config.starts_with("ocio://") && !std::filesystem::is_regular_file(settings.config, unknown))
    refuse(settings, "there is no such file");
  OIIO::ColorConfig config(settings.config);
  if (config.has_error()) refuse(settings, one_line(config.geterror()));
  const OcioNames spaces = color_space_names(config);
  std::string space = settings.colorspace, display = settings.display, view = settings.view;
  if (space.empty()) space = linear_color_space(settings, config, spaces);
  require_name(settings, "colour space", space, spaces);
  if (display.empty() && config.getDefaultDisplayName() != nullptr) display = config.getDefaultDisplayName();
  require_name(settings, "display", display, config.getDisplayNames());
  if (view.empty() && config.getDefaultViewName(display) != nullptr) view = config.getDefaultViewName(display);
  require_name(settings, "view", view, config.getViewNames(display));
  auto processor = config.createDisplayTransform(display, view, space);
  if (!processor || config.has_error())
    refuse(settings, "display " + in_quotes(display) + ", view " + in_quotes(view) + ": " +
                         one_line(config.has_error() ? config.geterror() : "there is no such transform"));
  return std::make_shared<OcioTransform>(std::move(processor));
}

}  // namespace

void raytrace_openimageio_color_transform(const OcioSettings& settings,
                                          std::shared_ptr<const ColorTransform>& transform) {
  // Each of a render's files asks for the same, and some configurations take long to read.
  static std::mutex mutex;
  static OcioSettings last_settings;
  static std::shared_ptr<const ColorTransform> last;
  const std::lock_guard lock(mutex);
  if (!last || last_settings != settings) {
    last = made_transform(settings);
    last_settings = settings;
  }
  transform = last;
}

}  // namespace raytrace
