#include "listing.h"

#include "raytrace/aovs/aov_table.h"
#include "raytrace/cameras/registry.h"
#include "raytrace/integrators/registry.h"
#include "raytrace/lights/registry.h"
#include "raytrace/materials/registry.h"
#include "raytrace/math/type_list.h"
#include "raytrace/shapes/registry.h"

namespace raytrace {

namespace {

struct Kind {
  std::string name;
  std::string members;
};

template <class List>
Kind kind_of(const std::string& name, List list) {
  Kind kind{name, {}};
  for_each_type(list, [&](auto type) {
    using T = typename decltype(type)::type;
    if constexpr (requires { T::name; }) {
      kind.members += T::name;
    } else {
      kind.members += T::element;
    }
    kind.members += '\n';
  });
  return kind;
}

Kind kind_of_aovs() {
  Kind kind{"aovs", {}};
  for (const Aov& aov : aov_table) kind.members += std::string(aov.name) + '\n';
  return kind;
}

std::vector<Kind> kinds() {
  return {kind_of("shapes", Shapes()),   kind_of("materials", Materials()),     kind_of("lights", Lights()),
          kind_of("cameras", Cameras()), kind_of("integrators", Integrators()), kind_of_aovs()};
}

}  // namespace

std::vector<std::string> listing_kinds() {
  std::vector<std::string> names;
  for (const Kind& kind : kinds()) names.push_back(kind.name);
  return names;
}

std::string listing(const std::string& kind) {
  for (const Kind& candidate : kinds()) {
    if (candidate.name == kind) return candidate.members;
  }
  return {};
}

}  // namespace raytrace
