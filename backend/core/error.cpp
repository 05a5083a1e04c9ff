#include "core/error.h"

namespace polycube {

std::string name(const CadRef& entity) {
  static constexpr const char* kKinds[] = {"Vertex", "Edge", "Face", "Solid"};
  return kKinds[entity.dim] + std::to_string(entity.id);
}

}  // namespace polycube
