#include "raytrace/description/check_scene.h"

#include <cstddef>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>

#include "raytrace/description/parse_value.h"
#include "raytrace/description/read_value.h"
#include "raytrace/text/quoted.h"
#include "raytrace/text/utf8.h"

namespace raytrace {

namespace {

DiagnosticText complaint_about(double value, Range range) { return check_number(value, range); }
DiagnosticText complaint_about(int value, Range range) { return check_integer(value, range); }
DiagnosticText complaint_about(bool, Range) { return std::nullopt; }

DiagnosticText complaint_about(const std::string& value, Range) {
  if (value.empty()) return "is empty";
  if (find_invalid_utf8(value, 1) != std::string_view::npos) return "is no text in UTF-8 without control characters";
  if (value.front() == ' ' || value.back() == ' ') return "has a space at an end";
  return check_label(value);
}

std::string text_of(double value) { return number_text(value); }
std::string text_of(int value) { return std::to_string(value); }
std::string text_of(bool value) { return value ? "true" : "false"; }
std::string text_of(const std::string& value) { return value; }

class SceneChecker {
 public:
  explicit SceneChecker(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  void check(const ViewPlane& viewplane) {
    begin_item(ViewPlane::element, 0);
    check_parameters<ViewPlane>(viewplane, false);
  }

  void check(const SceneDescription& scene) {
    check(scene.viewplane);
    for_each_type(Cameras{}, [&]<class Camera>(std::type_identity<Camera>) {
      const auto* const camera = std::get_if<typename Camera::Parameters>(&scene.camera);
      begin_item(Camera::element, 0);
      if (camera != nullptr) check_parameters<Camera>(*camera, false);
    });
    for_each_item(Lights{}, scene.lights, [&]<class T>(std::type_identity<T>, const auto& light) {
      if (T::group.empty() && index_ > 0) report("is a second one; a scene has one");
      check_parameters<T>(light.parameters, true);
    });
    for_each_item(Materials{}, scene.materials, [&]<class T>(std::type_identity<T>, const auto& material) {
      check_value("name", material.name, Range::any);
      check_taken("material", material.name, materials_);
      check_parameters<T>(material.parameters, false);
    });
    for_each_item(Shapes{}, scene.objects, [&]<class T>(std::type_identity<T>, const auto& object) {
      if (!object.name.empty()) {
        check_value("name", object.name, Range::any);
        check_taken("object", object.name, objects_);
      }
      check_material(scene, object.material);
      check_parameters<T>(object.parameters, true);
    });
  }

 private:
  template <class List, class Tuple, class Check>
  void for_each_item(List list, const Tuple& tuple, const Check& check_item) {
    for_each_type(list, [&]<class T>(std::type_identity<T> type) {
      std::size_t i = 0;
      for (const auto& item : std::get<index_of<T>(List{})>(tuple)) {
        begin_item(T::element, item.line, i++);
        check_item(type, item);
      }
    });
  }

  void begin_item(std::string_view element, std::uint32_t line, std::size_t index = no_index) {
    element_ = element;
    line_ = line;
    index_ = index;
  }

  /// "<sphere> [2]"
  std::string item_text() const {
    return tag(element_) + (index_ == no_index ? "" : " [" + std::to_string(index_) + "]");
  }

  void report(const std::string& message) { diagnostics_.error({line_, 0}, item_text() + " " + message); }

  /// may_skip: whether the item may be left out where its type says so, as the reader does.
  template <class T>
  void check_parameters(const typename T::Parameters& parameters, bool may_skip) {
    static const auto fields = T::fields();
    const std::size_t errors_before = diagnostics_.error_count();
    for (const auto& field : fields)
      std::visit([&](auto member) { check_value(field.name, parameters.*member, field.range); }, field.member);
    if constexpr (requires { T::check(parameters); }) {
      if (diagnostics_.error_count() > errors_before) return;
      const std::optional<ParameterDiagnostic> diagnostic = T::check(parameters);
      if (!diagnostic) return;
      const std::string message = item_text() + ": " + diagnostic->message;
      if (diagnostic->effect == ParameterDiagnostic::Effect::skip && may_skip)
        diagnostics_.warning({line_, 0}, message);
      else
        diagnostics_.error({line_, 0}, message);
    }
  }

  template <class Value>
  void check_value(std::string_view name, const Value& value, Range range) {
    if (const DiagnosticText diagnostic = complaint_about(value, range))
      report("has " + in_quotes(text_of(value)) + " as " + tag(name) + ", which " + *diagnostic);
  }

  void check_value(std::string_view name, const Vec3d& value, Range range) {
    for (const double component : {value.x, value.y, value.z}) check_value(name, component, range_of_components(range));
    if (range == Range::nonzero && !is_direction(value))
      report("has a " + tag(name) + " of length 0; it is a direction");
  }

  void check_value(std::string_view name, const Rgb<double>& value, Range range) {
    for (const double component : {value.red, value.green, value.blue}) check_value(name, component, range);
  }

  using Names = std::map<std::string_view, std::string>;  // each with its bearer

  void check_taken(const char* what, std::string_view name, Names& names) {
    const auto [bearer, added] = names.try_emplace(name, item_text());
    if (!added)
      report("has the " + std::string(what) + " name " + in_quotes(name) + " of " + bearer->second +
             "; choose another");
  }

  void check_material(const SceneDescription& scene, const MaterialReference& material) {
    std::size_t count = 0;
    if (material.kind < Materials::size)
      with_type(Materials{}, material.kind, [&]<class T>(std::type_identity<T>) {
        count = std::get<index_of<T>(Materials{})>(scene.materials).size();
      });
    if (material.index < count) return;
    report("refers to material " + std::to_string(material.index) + " of kind " + std::to_string(material.kind) +
           ", which is not there" + (material.kind < Materials::size ? "" : "; nor is that kind"));
  }

  static constexpr std::size_t no_index = static_cast<std::size_t>(-1);

  Diagnostics& diagnostics_;
  std::string_view element_;  // of the item at hand
  std::uint32_t line_ = 0;
  std::size_t index_ = no_index;
  Names materials_, objects_;
};

void throw_errors(const Diagnostics& diagnostics) {
  if (!diagnostics.has_errors()) return;
  std::ostringstream problems;
  diagnostics.print(problems);
  std::string text = problems.str();
  text.pop_back();  // the last line's end
  throw SceneError(text);
}

}  // namespace

void check_scene(const SceneDescription& scene, Diagnostics& diagnostics) { SceneChecker(diagnostics).check(scene); }

void require_good_scene(const SceneDescription& scene) {
  Diagnostics diagnostics(scene.file.empty() ? "scene" : scene.file);
  check_scene(scene, diagnostics);
  throw_errors(diagnostics);
}

void require_good_viewplane(const ViewPlane& viewplane) {
  Diagnostics diagnostics("scene");
  SceneChecker(diagnostics).check(viewplane);
  throw_errors(diagnostics);
}

}  // namespace raytrace
