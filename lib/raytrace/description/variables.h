// The variables of a scene's values: <radius>$size</radius>, with a value that is given when the scene is read.
//
// A name starts with a letter or _, letters, digits and _ follow; in ${size} it ends at the brace. ${size:-2} has the
// default 2, for where the variable is not set or, as in the shell, is empty; ${size:04} has four digits, if it is a
// whole number. $$ is a dollar. A dollar in a value starts no variable. $frame is always set.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "raytrace/description/parse_value.h"

namespace raytrace {

/// What a texture is whose file cannot be used: an error, or a warning and magenta.
enum class MissingTexture { error, warn };
template <>
struct Choices<MissingTexture> {
  static constexpr std::array<std::string_view, 2> words = {"error", "warn"};
};

/// How textures are loaded.
struct TextureSettings {
  MissingTexture missing = MissingTexture::error;
  /// So many bytes of texels lie in memory; those of further images are in files (memory/file_mapping.h), from which
  /// the system reads what is used. None: half of the memory that is free.
  std::optional<std::uint64_t> memory{};
};

/// What the values of a scene may depend on.
struct SceneSettings {
  int frame = 1;                                 ///< the value of $frame, and the moment at which keys are evaluated
  std::map<std::string, std::string> variables;  ///< name -> value; none is called "frame" (see is_variable_name)
  TextureSettings textures{};
  double after_frame = 0;  ///< so many frames after it keys are evaluated
  bool still = false;      ///< nothing moves while the shutter is open: all is as it is at that moment
};

/// The variable that need not be set.
inline constexpr std::string_view frame_variable = "frame";

bool is_variable_name(std::string_view text);

/// The text as it must be written for reading to give it back: with $$ for each dollar.
std::string with_dollars_doubled(std::string_view text);

/// May be used by several threads at once.
class Variables {
 public:
  explicit Variables(const SceneSettings& settings);

  int frame() const { return frame_; }
  /// The moment at which keys are evaluated.
  double moment() const {
    moment_was_asked_ = true;
    return frame_ + after_frame_;
  }
  bool moment_was_asked() const { return moment_was_asked_; }

  /// In bytes, with the values put in: of a text, and of all texts together as of a scene's file (scene_text.h). A
  /// short text may have a long value many times.
  static constexpr std::size_t longest_text = std::size_t{1} << 20U, longest_scene = std::size_t{1} << 31U;

  /// replaced: receives the text with the variables' values in it, unless there is a message.
  OptionalMessage replace(std::string_view text, std::string& replaced) const;

  /// Whether a message is about a variable, or all of them, and so the same wherever it stands.
  static bool is_cause(std::string_view message);

  /// Those that no text had so far.
  std::vector<std::string_view> unused() const;

 private:
  struct Variable {
    std::string value;
    mutable std::atomic<bool> used = false;
  };

  // text: what follows the dollar; they take the variable off its beginning, and append its value.
  OptionalMessage replace_plain(std::string_view& text, std::string& result) const;
  OptionalMessage replace_braced(std::string_view& text, std::string& result) const;

  /// The value of a variable, which counts as used from here on; null if it is not set.
  const std::string* find(std::string_view name) const;
  std::string explain_unset(std::string_view name) const;

  int frame_;
  double after_frame_;
  mutable std::atomic<std::size_t> scene_length_ = 0;
  mutable std::atomic<bool> moment_was_asked_ = false;
  std::map<std::string, Variable, std::less<>> variables_;
};

}  // namespace raytrace
