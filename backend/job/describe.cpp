#include "job/describe.h"

#include <cstdint>
#include <nlohmann/json.hpp>

#include "core/charts.h"
#include "core/options.h"
#include "fem/fem.h"
#include "pipeline/trial_tuning.h"

namespace polycube {
namespace {

using Json = nlohmann::ordered_json;

Json default_of(const OptionSpec& option) {
  const MeshOptions defaults;
  return std::visit(
      [&](auto member) -> Json {
        using Member = decltype(member);
        if constexpr (std::is_same_v<Member, FaceLabels MeshOptions::*>) {
          return Json::object();
        } else if constexpr (std::is_same_v<Member, FrameAxes MeshOptions::*>) {
          return Json::array();
        } else if constexpr (std::is_same_v<Member, Divisions MeshOptions::*> || std::is_same_v<Member, LocalSizes MeshOptions::*> ||
                             std::is_same_v<Member, EdgeBiases MeshOptions::*> || std::is_same_v<Member, FaceList MeshOptions::*> ||
                             std::is_same_v<Member, LocalRefinements MeshOptions::*>) {
          return "";
        } else {
          return defaults.*member;
        }
      },
      option.member);
}

}  // namespace

std::string describe_engine() {
  Json json;
  json["options"] = Json::array();
  for (const OptionSpec& option : option_table())
    json["options"].push_back({{"name", option.name},
                               {"unit", option.unit},
                               {"meaning", option.meaning},
                               {"type", option_type(option)},
                               {"default", default_of(option)},
                               {"min", option.min},
                               {"max", option.max},
                               {"choices", option.choices},
                               {"advanced", option.advanced}});
  json["label_names"] = Json::array();
  json["label_colours"] = Json::array();
  for (int label = 0; label < 6; ++label) {
    json["label_names"].push_back(label_name(label));
    json["label_colours"].push_back(label_colour(label));
  }
  json["smesh_hex20"] = kSmeshHex20;
  return json.dump(2) + "\n";
}

std::string describe_tuning() {
  Json json = Json::object();
  for (const TuningValue& value : tuning_values()) json[value.name] = value.whole ? Json(static_cast<std::int64_t>(value.value)) : Json(value.value);
  return json.dump(2) + "\n";
}

}  // namespace polycube
