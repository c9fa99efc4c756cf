// https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html, section 3.11 and appendix C.
#include "raytrace/import/gltf_animation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "raytrace/text/message.h"

namespace raytrace::gltf {
namespace {

/// Where a time is among a sampler's keys.
struct Span {
  std::size_t keys = 0, key = 0;
  double fraction = 0;  ///< of the way to the next key; 0: that key itself
  double length = 0;    ///< of the way, in seconds
};

enum class Way { linear, step, cubic };

std::array<double, 4> unit(const std::array<double, 4>& q) {
  const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(size > 0)) return {0, 0, 0, 1};
  return {q[0] / size, q[1] / size, q[2] / size, q[3] / size};
}

class PoseReader {
 public:
  PoseReader(Document& document, double time) : document_(document), time_(time) {}

  /// What it moves that others have moved is as it says.
  void add(const Item& animation) {
    const Item channels = animation["channels"], samplers = animation["samplers"];
    for (std::size_t i = 0; i < channels.size(); ++i) {
      const Item channel = channels[i], target = channel["target"], path = target["path"];
      const std::optional<Item> node = target.find("node");
      if (!node) continue;  // that of an extension
      document_.listed("nodes", *node);
      const Item number = channel["sampler"];
      if (number.whole() >= samplers.size()) number.fail("there is no such sampler");
      read_sampler(samplers[number.whole()], path, pose_.nodes[node->whole()]);
    }
  }

  const Pose& pose() const { return pose_; }

 private:
  void read_sampler(const Item& sampler, const Item& path, NodePose& node) {
    if (path.text() == "translation") {
      node.translation = values<3>(sampler, false);
    } else if (path.text() == "scale") {
      node.scale = values<3>(sampler, false);
    } else if (path.text() == "rotation") {
      node.rotation = values<4>(sampler, true);
    } else if (path.text() == "weights") {
      node.weights = weights(sampler);
    } else {
      document_.warn_once(path.place(), "is none of translation, rotation, scale and weights, and is left out");
    }
  }

  const Span& span(const Item& input) {
    const auto [known, is_new] = spans_.try_emplace(input.whole());
    if (is_new) known->second = found_span(input);
    return known->second;
  }

  Span found_span(const Item& input) {
    const Accessor accessor = document_.accessor(input);
    const std::size_t count = accessor.elements.count;
    if (accessor.elements.components != 1 || accessor.elements.type != ComponentType::number)
      input.fail(accessor.place + " is none of times, which are SCALAR and floats");
    if (count == 0) input.fail(accessor.place + " has no times");
    document_.spend(count, input);
    std::vector<double> times(count);
    for_each_element(accessor, 1, [&](std::size_t i, const auto& components) { times[i] = components[0]; });
    for (std::size_t i = 0; i < count; ++i)
      if (!std::isfinite(times[i]) || (i > 0 && !(times[i] > times[i - 1])))
        input.fail(accessor.place + " has times that do not grow: number " + std::to_string(i));
    pose_.end = std::max(pose_.end, times.back());
    const auto next = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), time_) - times.begin());
    if (next == 0) return {count, 0};
    if (next == count) return {count, count - 1};
    const double length = times[next] - times[next - 1];
    return {count, next - 1, (time_ - times[next - 1]) / length, length};
  }

  /// How the sampler goes from key to key, and its output, of which each key has `numbers` elements, or three times so
  /// many.
  struct Output {
    Span span;
    Way way = Way::linear;
    Accessor accessor;
    Item place;
  };
  Output output(const Item& sampler) {
    const Item place = sampler["output"];
    Output result{span(sampler["input"]), Way::linear, document_.accessor(place), place};
    if (const auto way = sampler.find("interpolation")) {
      if (way->text() == "STEP")
        result.way = Way::step;
      else if (way->text() == "CUBICSPLINE")
        result.way = Way::cubic;
      else if (way->text() != "LINEAR")
        way->fail("is none of LINEAR, STEP and CUBICSPLINE");
    }
    if (result.way == Way::step) result.span.fraction = 0;
    return result;
  }

  double checked(const Output& output, double value) {
    if (!std::isfinite(value)) output.place.fail(output.accessor.place + " has a number that is not finite");
    return value;
  }

  /// Of the key and the next one, read(key, which): at a cubic's key the tangent before it, the value and that behind.
  template <class Values, class Read>
  static Values between(const Output& output, const Read& read) {
    const Span& span = output.span;
    const std::size_t of_value = output.way == Way::cubic ? 1 : 0;
    Values from = read(span.key, of_value);
    if (span.fraction == 0) return from;
    const Values to = read(span.key + 1, of_value);
    const double t = span.fraction, left = 1 - t;
    if (output.way != Way::cubic) {
      for (std::size_t k = 0; k < from.size(); ++k) from[k] = left * from[k] + t * to[k];
      return from;
    }
    const Values start = read(span.key, 2), end = read(span.key + 1, 0);
    for (std::size_t k = 0; k < from.size(); ++k)
      from[k] = (1 + 2 * t) * left * left * from[k] + t * left * left * span.length * start[k] +
                t * t * (3 - 2 * t) * to[k] - t * t * left * span.length * end[k];
    return from;
  }

  template <std::size_t count>
  std::array<double, count> values(const Item& sampler, bool turns) {
    const Output of_sampler = output(sampler);
    const Elements& elements = of_sampler.accessor.elements;
    const std::size_t each = of_sampler.way == Way::cubic ? 3 : 1;
    if (elements.components != count) of_sampler.place.fail("its accessor has other than VEC" + std::to_string(count));
    check_count(of_sampler, each * of_sampler.span.keys);
    const auto read = [&](std::size_t key, std::size_t which) {
      document_.spend(1 + of_sampler.accessor.changed_indices.count, of_sampler.place);
      const auto element = element_at(of_sampler.accessor, each * key + which);
      std::array<double, count> some{};
      for (std::size_t k = 0; k < count; ++k) some[k] = checked(of_sampler, element[k]);
      return some;
    };
    if constexpr (count == 4) {
      const Span& place = of_sampler.span;
      if (turns && of_sampler.way != Way::cubic && place.fraction > 0)
        return slerp(unit(read(place.key, 0)), unit(read(place.key + 1, 0)), place.fraction);
    }
    return between<std::array<double, count>>(of_sampler, read);
  }

  std::vector<double> weights(const Item& sampler) {
    const Output of_sampler = output(sampler);
    const Elements& elements = of_sampler.accessor.elements;
    const std::size_t each = of_sampler.way == Way::cubic ? 3 : 1, parts = each * of_sampler.span.keys;
    if (elements.components != 1) of_sampler.place.fail("its accessor has other than SCALAR");
    const std::size_t count = elements.count / parts;
    check_count(of_sampler, parts * std::max(count, std::size_t{1}));
    return between<std::vector<double>>(of_sampler, [&](std::size_t key, std::size_t which) {
      document_.spend(count, of_sampler.place);
      std::vector<double> some(count);
      for (std::size_t k = 0; k < count; ++k) {
        document_.spend(of_sampler.accessor.changed_indices.count, of_sampler.place);
        some[k] = checked(of_sampler, element_at(of_sampler.accessor, (each * key + which) * count + k)[0]);
      }
      return some;
    });
  }

  static void check_count(const Output& output, std::size_t count) {
    if (output.accessor.elements.count != count)
      output.place.fail(output.accessor.place + " has " + std::to_string(output.accessor.elements.count) +
                        " elements, and " + std::to_string(output.span.keys) + " keys take " + std::to_string(count));
  }

  Document& document_;
  double time_;
  Pose pose_;
  std::map<std::uint64_t, Span> spans_;  ///< by the number of their times' accessor
};

constexpr const char* all_animations = "all";

bool has_name(const Item& animations, const std::string& name) {
  for (std::size_t i = 0; i < animations.size(); ++i)
    if (animations[i].name() == name) return true;
  return false;
}

/// Some programs write an animation for each object. One that moves some of what is moved is another movement of that.
void warn_of_others(Document& document, const Item& animations, std::uint64_t played, const Pose& pose) {
  const auto moves_others_alone = [&](const Item& animation) {
    const std::optional<Item> channels = animation.find("channels");
    bool moves = false;
    for (std::size_t i = 0; channels && i < channels->size(); ++i) {
      const std::optional<Item> target = (*channels)[i].find("target");
      const std::optional<Item> node = target ? target->find("node") : std::nullopt;
      if (node && pose.nodes.contains(node->whole())) return false;
      moves |= node.has_value();
    }
    return moves;
  };
  const auto name_of = [&](std::size_t i) {
    const std::string name = animations[i].name();
    return name.empty() ? std::to_string(i) : in_quotes(name);
  };
  std::vector<std::string> names;
  constexpr std::size_t most = 10;
  std::size_t others = 0;
  for (std::size_t i = 0; i < animations.size(); ++i)
    if (i != played && moves_others_alone(animations[i]) && ++others <= most) names.push_back(name_of(i));
  if (others == 0) return;
  document.warn(animations.place(), "the animation " + name_of(played) + " is played alone; other nodes are moved by " +
                                        joined(names, ", ") +
                                        (others > most ? " and " + std::to_string(others - most) + " more" : "") +
                                        "; the animation 'all' plays all of them");
}

}  // namespace

Pose read_pose(Document& document, const std::string& animation, double time) {
  if (animation.empty()) return {};
  const std::optional<Item> animations = document.root().find("animations");
  const std::size_t count = animations ? animations->size() : 0;
  if (count == 0 && (animation == "0" || animation == all_animations)) return {};
  if (!std::isfinite(time)) document.root().fail("has no time that is not finite");
  PoseReader reader(document, time);
  if (animation == all_animations && !has_name(*animations, animation)) {
    for (std::size_t i = 0; i < count; ++i) reader.add((*animations)[i]);
  } else {
    const std::uint64_t number = document.number_by_name(animations, animation, "animation");
    reader.add((*animations)[number]);
    warn_of_others(document, *animations, number, reader.pose());
  }
  return reader.pose();
}

std::array<double, 4> slerp(const std::array<double, 4>& a, std::array<double, 4> b, double t) {
  double cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  if (cosine < 0) {
    cosine = -cosine;
    for (double& component : b) component = -component;
  }
  // sin(t angle) / sin(angle) as a series in 1 - cos(angle), which is at most 1: each term is at most half of the one
  // before it. David Eberly, A Fast and Accurate Algorithm for Computing SLERP, 2011.
  const auto share = [&](double part) {
    constexpr int terms = 60;
    double term = part, sum = part;
    for (int i = 1; i <= terms; ++i) {
      term *= (part * part - double(i) * i) * (cosine - 1) / (double(i) * (2 * i + 1));
      sum += term;
    }
    return sum;
  };
  const double of_a = share(1 - t), of_b = share(t);
  return {of_a * a[0] + of_b * b[0], of_a * a[1] + of_b * b[1], of_a * a[2] + of_b * b[2], of_a * a[3] + of_b * b[3]};
}

}  // namespace raytrace::gltf
