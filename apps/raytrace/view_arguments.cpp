#include "view_arguments.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "option_parser.h"
#include "option_values.h"

namespace raytrace {

namespace {

ViewTransform view_transform(const std::string& text) {
  constexpr const auto& words = Choices<ViewTransform>::words;
  one_of(text, Names(words.begin(), words.end()));
  return static_cast<ViewTransform>(std::find(words.begin(), words.end(), text) - words.begin());
}

}  // namespace

void define_view_options(OptionParser& parser, ViewOptions& view) {
  constexpr const auto& words = Choices<ViewTransform>::words;
  const auto text_of_option = [&parser](const std::string& name, const std::string& value_name, const std::string& help,
                                        std::string& target) {
    parser.add(name, value_name, help, [&target](const std::string& text) {
      if (text.empty()) throw UsageError("the name is empty");
      target = text;
    });
  };
  parser.add("--exposure", "EV",
             "Multiply the colour by 2^EV in PNG, JPEG and other sRGB-encoded files, whatever the scene says; 0 leaves "
             "it as it is. EXR and floats stay as they are",
             view.exposure, exposure);
  parser.add_switch("--auto-exposure", view.auto_exposure,
                    "Expose these files as the picture's own brightness asks for: its logarithmic mean becomes 0.18; "
                    "--exposure is added");
  parser.add("--white-balance", "K",
             "Show in these files as white what is lit by a lamp of K kelvin, e.g. 2700, whatever the scene says; 0 "
             "leaves colours as they are",
             view.white_balance, balanced_temperature);
  parser.add(
      "--view-transform", "NAME",
      "How these files show what is brighter than they can: srgb, clipped; agx; khronos-neutral (srgb for scenes, "
      "khronos-neutral for models)",
      view.transform, view_transform, Names(words.begin(), words.end()));
  parser.add_switch("--dither", view.dither,
                    "In these files, with 8 bits: round up or down by a fine pattern, so that dark gradients have no "
                    "steps");
  text_of_option("--ocio", "FILE.ocio", "Show these files through an OpenColorIO configuration instead",
                 view.ocio.config);
  text_of_option("--ocio-display", "NAME", "Its display (its default)", view.ocio.display);
  text_of_option("--ocio-view", "NAME", "The display's view (its default)", view.ocio.view);
  text_of_option("--ocio-colorspace", "NAME",
                 "What the configuration calls the picture's colour (its linear Rec. 709, or scene_linear)",
                 view.ocio.colorspace);
}

void refuse_two_views(const ViewOptions& view) {
  if (!view.ocio.empty()) {
    if (view.transform) throw UsageError("--ocio takes the place of a view transform: give one of the two");
    return;
  }
  const auto needs_configuration = [](const char* option) {
    throw UsageError(std::string(option) + " is of an OpenColorIO configuration: say which with --ocio");
  };
  if (!view.ocio.display.empty()) needs_configuration("--ocio-display");
  if (!view.ocio.view.empty()) needs_configuration("--ocio-view");
  if (!view.ocio.colorspace.empty()) needs_configuration("--ocio-colorspace");
}

}  // namespace raytrace
