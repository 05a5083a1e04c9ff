#include "job/job.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>

#include "core/draft.h"
#include "core/error.h"
#include "core/faults.h"
#include "core/status.h"
#include "job/npz.h"
#include "pipeline/inspect.h"
#include "pipeline/part_mesh.h"

namespace polycube {
namespace {

using Json = nlohmann::ordered_json;

// As often as a person sees a bar move; each report is a line that the watching program has to read.
constexpr auto kProgressInterval = std::chrono::milliseconds(50);

std::string dump(const Json& json) {
  // A file's name may be no UTF-8.
  return json.dump(-1, ' ', true, Json::error_handler_t::replace);
}

std::string read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file.is_open() || file.bad()) throw InvalidInput(path + " cannot be read");
  return text;
}

/// A value as parse_options() reads it.
std::string value_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  std::string text;
  if (value.is_object()) {
    for (const auto& [key, one] : value.items()) text += (text.empty() ? "" : ",") + key + "=" + value_text(one);
  } else if (value.is_array()) {
    for (const Json& one : value) text += (text.empty() ? "" : one.is_array() ? "/" : ",") + value_text(one);
  } else {
    text = dump(value);
  }
  return text;
}

/// The caller's wish for the best mesh so far: a file in the job's folder, looked for every tenth of a second once the first stage has
/// begun (OCCT's readers, before, would take the exception for a damaged file).
class Wish {
 public:
  explicit Wish(const std::string& folder) : path_(folder + "/enough") {}

  void begin() { begun_ = true; }
  /// True once, for what was found out is handed out then without more ado.
  bool granted() {
    const std::lock_guard lock(mutex_);
    const auto now = Monitor::Clock::now();
    if (!begun_ || granted_ || now < next_) return false;
    next_ = now + std::chrono::milliseconds(100);
    granted_ = access(path_.c_str(), F_OK) == 0;
    return granted_;
  }

 private:
  const std::string path_;
  std::mutex mutex_;
  Monitor::Clock::time_point next_{};
  std::atomic<bool> begun_{false};
  bool granted_ = false;
};

/// Speaks on standard output, and asks whether the parent is still there and still wants a better mesh.
class Voice {
 public:
  Voice(Monitor& monitor, const std::string& folder) : wish_(folder) {
    monitor.on_progress = [this](const std::string& stage, double fraction) { progress(stage, fraction); };
    monitor.on_log = [this](const std::string& line) { say({{"log", line}}); };
    monitor.cancel_requested = [this, parent = getppid()] {
      if (wish_.granted()) throw OutOfTime("stopped by the user");
      return getppid() != parent;
    };
  }
  Voice(const Voice&) = delete;
  Voice& operator=(const Voice&) = delete;

 private:
  void progress(const std::string& stage, double fraction) {
    wish_.begin();
    {
      const std::lock_guard lock(mutex_);
      const auto now = Monitor::Clock::now();
      // The start and the end of a stage always get through.
      if (fraction > 0 && fraction < 1 && now < next_) return;
      next_ = now + kProgressInterval;
    }
    say({{"progress", Json::array({stage, fraction})}});
  }
  void say(const Json& message) {
    const std::string line = dump(message) + "\n";
    const std::lock_guard lock(mutex_);
    std::fwrite(line.data(), 1, line.size(), stdout);
    std::fflush(stdout);
  }
  Wish wish_;
  std::mutex mutex_;
  Monitor::Clock::time_point next_{};
};

void save_mesh(const std::string& folder, const PartMesh& mesh) {
  const FemMesh& fem = mesh.fem;
  const bool second = fem.order == 2;
  Npz arrays;
  arrays.add_rows("nodes", fem.points, 3);
  arrays.add_rows("hexes", fem.hexes, second ? 20 : 8);
  arrays.add("hex_block", fem.hex_block);
  arrays.add("hex_solid", solid_numbers(fem));
  arrays.add_rows("quads", fem.quads, second ? 8 : 4);
  arrays.add("quad_face", fem.quad_face);
  arrays.add_rows("quad_hex", fem.quad_hex, 2);
  arrays.add_rows("segments", fem.segments, second ? 3 : 2);
  arrays.add("segment_edge", fem.segment_edge);
  arrays.add("scaled_jacobian", cell_values(fem, scaled_jacobian));
  arrays.add("edge_ratio", cell_values(fem, edge_ratio));
  arrays.add("skew", cell_values(fem, skew));
  arrays.add("warpage", cell_values(fem, warpage));
  for (const FemGroup& group : fem.groups) {
    const std::string start = "group/" + group_name(group) + "/";
    arrays.add(start + "nodes", group.nodes);
    if (group.entity.dim > 0) arrays.add(start + kGroupElements.at(static_cast<std::size_t>(group.entity.dim)), group.elements);
  }
  arrays.write(folder + "/result.npz");
  write_text(folder + "/report.json", to_json(mesh.report));
}

void save_labels(const std::string& folder, const LabelledPart& part, int face_count) {
  const Inspection inspection = inspect(part);
  Npz arrays;
  arrays.add_rows("points", part.tets.points, 3);
  arrays.add_rows("triangles", part.tets.triangles, 3);
  arrays.add("triangle_face", part.tets.triangle_face);
  arrays.add("label", part.labelling.label);
  if (!part.map.image.empty()) arrays.add_rows("image", part.map.image, 3);
  const Mat3& frame = part.labelling.frame;
  arrays.add_rows("frame", std::vector<Vec3>{frame.row(0), frame.row(1), frame.row(2)}, 3);
  arrays.add("chart", inspection.chart);
  arrays.add("corners", inspection.corners);
  arrays.add("turning_points", inspection.turning_points);
  arrays.write(folder + "/labels.npz");
  Json plain{{"valid", inspection.violations.valid()}, {"face_label", Json::object()}, {"edges", Json::object()}};
  const std::vector<int> labels = face_labels(part, face_count);
  for (int face = 1; face <= face_count; ++face) plain["face_label"][std::to_string(face)] = labels[static_cast<std::size_t>(face)];
  for (const FeatureEdge& edge : part.features.edges)
    plain["edges"][std::to_string(edge.edge)] = {kCaptureNames.at(static_cast<std::size_t>(edge.capture)), edge.reason};
  write_text(folder + "/labels.json", dump(plain) + "\n");
}

void limit_time(Monitor& monitor, const MeshOptions& options) {
  if (options.time_limit > 0)
    monitor.set_deadline(Monitor::Clock::now() + std::chrono::duration_cast<Monitor::Clock::duration>(std::chrono::duration<double>(options.time_limit)));
}

/// Of the solids, where the caller left some.
std::vector<std::string> read_labels(const std::string& folder) {
  const std::string path = folder + "/solids.json";
  if (!std::filesystem::exists(path)) return {};
  try {
    return Json::parse(read_text(path)).get<std::vector<std::string>>();
  } catch (const Json::exception&) {
    throw InvalidInput(path + " is no list of texts");
  }
}

Assembly read_shape(const std::string& folder, const MeshOptions& options, const Monitor& monitor) {
  return Assembly::from_brep(read_text(folder + "/shape.brep"), {.object = {}, .sew = options.sew, .labels = read_labels(folder)}, monitor);
}

void work(const std::string& folder, JobKind kind) {
  const MeshOptions options = options_from_json(read_text(folder + "/options.json"));
  Monitor monitor;
  const Voice voice(monitor, folder);
  limit_time(monitor, options);
  if (kind == JobKind::kMesh) return save_mesh(folder, mesh_part([&] { return read_shape(folder, options, monitor); }, options, monitor));
  const Assembly assembly = read_shape(folder, options, monitor);
  check(options, assembly.diagonal(), {assembly.faces(), assembly.edges(), assembly.vertices(), static_cast<int>(assembly.solids.size())});
  save_labels(folder, label_part(assembly, options, monitor, Until::kLabels), assembly.faces().back());
}

int leave_error(const std::string& folder, Status status, const char* kind, const std::exception& error, Json more = Json::object()) {
  more["kind"] = kind;
  more["message"] = error.what();
  write_text(folder + "/error.json", dump(more) + "\n");
  return status;
}

/// Does the work; the exit status, and the error in the folder.
int attempt(const std::string& folder, const std::function<void()>& do_work) {
  try {
    do_work();
    return kDone;
  } catch (const InvalidInput& error) {
    return leave_error(folder, kBadInput, "InvalidInput", error);
  } catch (const StageFailed& error) {
    Json entities = Json::array();
    for (const CadRef& entity : error.entities()) entities.push_back(name(entity));
    return leave_error(folder, kFailed, "StageFailed", error, {{"stage", error.stage()}, {"entities", entities}});
  } catch (const Cancelled& error) {
    return leave_error(folder, kStopped, "Cancelled", error);
  }
}

/// What a line of a session asks for, in `folder`.
void serve_request(AssemblySession& session, const std::string& kind, const std::string& folder, const MeshOptions& options, const Monitor& monitor) {
  if (kind == "count") return write_text(folder + "/count.json", dump({{"hexes", session.count(options, monitor)}}) + "\n");
  if (kind == "polycube") return save_labels(folder, session.labels(options, monitor, Until::kMap), session.face_count());
  if (job_kind(kind) == JobKind::kLabels) return save_labels(folder, session.labels(options, monitor), session.face_count());
  save_mesh(folder, session.mesh(options, monitor));
}

/// Does one request after the other, as lines on standard input ask for them, until it ends. The first has the shape read and brings the session's first
/// options.
void serve_session(const std::string& folder) {
  std::unique_ptr<AssemblySession> session;
  for (std::string line; std::getline(std::cin, line);) {
    std::istringstream words(line);
    std::string name, kind = "mesh";
    words >> name >> kind;
    const std::string own = std::string(folder).append("/").append(name);
    const int status = attempt(own, [&] {
      const MeshOptions options = options_from_json(read_text(own + "/options.json"));
      Monitor monitor;
      const Voice voice(monitor, own);
      limit_time(monitor, options);
      if (!session) session = std::make_unique<AssemblySession>(read_shape(folder, options, monitor), options);
      serve_request(*session, kind, own, options, monitor);
    });
    std::printf("%s\n", dump({{"done", status}}).c_str());
    std::fflush(stdout);
  }
}

}  // namespace

JobKind job_kind(const std::string& name) {
  if (name == "mesh") return JobKind::kMesh;
  if (name == "labels") return JobKind::kLabels;
  if (name == "session") return JobKind::kSession;
  throw InvalidInput("a job is mesh, labels or session, not '" + name + "'");
}

MeshOptions options_from_json(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) throw InvalidInput("the options are no JSON object");
  std::vector<std::pair<std::string, std::string>> given;
  for (const auto& [name, value] : json.items())
    // An empty object or list, as an empty text for them, stands for nothing set.
    if (!value.is_null() && !(value.is_structured() && value.empty())) given.emplace_back(name, value_text(value));
  return parse_options(given);
}

int serve_job(const std::string& folder, JobKind kind) {
  setsid();
  end_by_faults();
  std::signal(SIGPIPE, SIG_IGN);  // a parent that is gone is noticed, and tidied up after
  const pid_t parent = getppid();
  const int status = attempt(folder, [&] {
    if (kind == JobKind::kSession) return serve_session(folder);
    work(folder, kind);
  });
  // The parent was to remove it.
  std::error_code ignored;
  if (getppid() != parent) std::filesystem::remove_all(folder, ignored);
  return status;
}

}  // namespace polycube
