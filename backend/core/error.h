// The ways a call can end without a result.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "core/types.h"

namespace polycube {

/// The caller's fault: a bad file, shape or option. The message is one line. Exit status 1.
class InvalidInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A stage could not do its work on valid input. Exit status 2.
class StageFailed : public std::runtime_error {
 public:
  StageFailed(std::string stage, const std::string& reason, std::vector<CadRef> entities = {})
      : std::runtime_error(reason), stage_(std::move(stage)), entities_(std::move(entities)) {}
  const std::string& stage() const { return stage_; }
  /// CAD entities at fault, may be empty.
  const std::vector<CadRef>& entities() const { return entities_; }

 private:
  std::string stage_;
  std::vector<CadRef> entities_;
};

/// The user cancelled or the time limit passed. Exit status 3.
class Cancelled : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The time limit passed.
class OutOfTime : public Cancelled {
 public:
  using Cancelled::Cancelled;
};

/// "Face3", "Edge5", "Vertex2", "Solid1": FreeCAD's name of an entity.
std::string name(const CadRef& entity);

}  // namespace polycube
