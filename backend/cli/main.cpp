// The command line: polycube mesh | label | hex | serve-job | describe. Exit status 0: done, 1: bad arguments or input, 2: no valid result, 3: cancelled.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <new>

#include "cad/cad.h"
#include "cli/console.h"
#include "cli/label_picture.h"
#include "core/draft.h"
#include "core/error.h"
#include "job/describe.h"
#include "job/job.h"
#include "pipeline/hex_map.h"
#include "pipeline/inspect.h"
#include "pipeline/label_part.h"
#include "pipeline/part_mesh.h"
#include "pipeline/trial_tuning.h"

namespace polycube {
namespace {

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// The options of option_table() as arguments of a command.
class OptionArguments {
 public:
  explicit OptionArguments(CLI::App& command) {
    for (const OptionSpec& option : option_table()) {
      std::string flag = "--" + option.name;
      std::replace(flag.begin(), flag.end(), '_', '-');
      const std::string type = option_type(option), group = option.advanced ? "Advanced" : "Mesh";
      Argument& argument = *arguments_.emplace_back(std::make_unique<Argument>(Argument{option.name, {}, nullptr}));
      if (type == "bool") {
        const bool on = MeshOptions().*std::get<bool MeshOptions::*>(option.member);
        argument.parsed = command.add_flag(on ? flag + ",!--no-" + flag.substr(2) : flag, option.meaning);
      } else {
        argument.parsed = command.add_option(type == "labels" ? "--label," + flag : flag, argument.texts, option.meaning)->expected(1);
        const bool list = type == "labels" || type == "divisions" || type == "sizes" || type == "bias" || type == "faces" || type == "refine";
        if (list) argument.parsed->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
        argument.parsed->type_name(type == "labels"      ? "Face3=+X"
                                   : type == "divisions" ? "Edge4=6"
                                   : type == "sizes"     ? "Face3=mm"
                                   : type == "bias"      ? "Edge4=ratio"
                                   : type == "faces"     ? "Face3"
                                   : type == "refine"    ? "Face7=levels"
                                                         : type_name(option));
      }
      argument.parsed->group(group);
    }
  }

  MeshOptions options() const {
    std::vector<std::pair<std::string, std::string>> given;
    for (const auto& argument : arguments_) {
      if (argument->parsed->count() == 0) continue;
      std::string text = argument->texts.empty() ? argument->parsed->as<std::string>() : argument->texts.front();
      for (std::size_t i = 1; i < argument->texts.size(); ++i) text += "," + argument->texts[i];
      given.emplace_back(argument->name, text);
    }
    return parse_options(given);
  }

 private:
  struct Argument {
    std::string name;
    std::vector<std::string> texts;
    CLI::Option* parsed;
  };

  static std::string type_name(const OptionSpec& option) {
    if (option.choices.empty()) return option.unit.empty() ? "NUMBER" : option.unit;
    std::string text;
    for (const std::string& choice : option.choices) text += (text.empty() ? "" : "|") + choice;
    return text;
  }

  std::vector<std::unique_ptr<Argument>> arguments_;
};

/// What is wrong with the name of a file, as CLI11 wants it.
std::string named_file(const std::string& name) { return name.empty() ? "the name of the file is empty" : ""; }

double seconds_since(Monitor::Clock::time_point start) { return std::chrono::duration<double>(Monitor::Clock::now() - start).count(); }

/// What the commands on a CAD part have in common.
struct PartCommand {
  PartCommand(CLI::App& app, const char* name, const char* meaning) : command(*app.add_subcommand(name, meaning)), arguments(command) {
    command.add_option("part", part, "CAD part: .step, .stp, .iges, .igs, .brep, .brp or .FCStd")->required()->check(named_file);
    command.add_option("--object", object, "Object of a .FCStd document, by name or label");
    command.add_option("--report", report, "Write a report as JSON")->check(named_file);
    command.add_flag("-v,--verbose", verbose, "Log what is done, with seconds, to standard error");
  }

  /// What can be said before any work: bad options and targets throw InvalidInput. `targets`: the files asked for.
  Supervision check(Monitor::Clock::time_point start, std::vector<std::string> targets) const {
    if (!report.empty()) {
      check_writable(report);
      targets.push_back(report);
    }
    check_apart(targets, {part});
    Supervision result{.outputs = std::move(targets)};
    if (const double limit = arguments.options().time_limit; limit > 0)
      result.deadline = start + std::chrono::duration_cast<Monitor::Clock::duration>(std::chrono::duration<double>(limit));
    return result;
  }

  /// The part, of as many solids as there are.
  Assembly read(const MeshOptions& options, const Monitor& monitor) const {
    monitor.progress("cad", 0);
    return Assembly::read(part, {.object = object, .sew = options.sew}, monitor);
  }

  CLI::App& command;
  OptionArguments arguments;
  std::string part, object, report;
  bool verbose = false;
};

struct MeshCommand : PartCommand {
  explicit MeshCommand(CLI::App& app) : PartCommand(app, "mesh", "Hexahedral mesh of a CAD solid, or of several") {
    command.add_option("-o,--output", output, "Mesh: .inp, .unv, .vtu, .med or .mesh (Medit, corners only)")->required()->check(named_file);
    command.footer(
        "Names in the .inp file, of Face3 for example: Face3 its nodes (*BOUNDARY, *CLOAD), Face3_Surface its surface (*DSLOAD, *DFLUX, *TIE,\n"
        "*CONTACT PAIR, *SECTION PRINT), Face3_Elements the elements at it, Face3_S4 those whose side S4 is on it (*FILM: Face3_S4, F4, ...). Edge5 and\n"
        "Vertex2 are nodes. Solid1 is the elements of the solid (*SOLID SECTION, *DLOAD), Solid1_Nodes its nodes. Of several solids Solid1_Solid2_Surface\n"
        "and Solid2_Solid1_Surface are the faces of each that touch the other (*TIE, *CONTACT PAIR).");
  }

  Supervision check(Monitor::Clock::time_point start) const {
    check_output(output);
    return PartCommand::check(start, {output});
  }

  void run(const Monitor& monitor, Monitor::Clock::time_point start) const {
    const MeshOptions options = arguments.options();
    PartMesh made = mesh_part([&] { return read(options, monitor); }, options, monitor);
    // A mesh that is there is handed out, late or not.
    const Monitor finishing(monitor, finishing_deadline(made.report, monitor));
    const auto write_start = Monitor::Clock::now();
    write(made.fem, output, effective_element_type(options), finishing);
    made.report.stages.push_back({"write", seconds_since(write_start)});
    if (!report.empty()) write_text(report, to_json(made.report));

    for (const StageRecord& stage : made.report.stages) monitor.log(stage.name + ": " + std::to_string(stage.seconds) + " s");
    for (const std::string& warning : made.report.warnings) std::cerr << "polycube: warning: " << one_line(warning) << "\n";
    const CadCapture& c = made.report.capture;
    std::printf("%s: %d hexahedra, %d nodes, scaled Jacobian min %.3f mean %.3f, CAD faces %d/%d edges %d/%d vertices %d/%d, %.1f s\n", output.c_str(),
                made.report.hexes, made.report.nodes, made.report.quality.min_scaled_jacobian, made.report.quality.mean_scaled_jacobian, c.faces_captured,
                c.faces, c.edges_captured, c.edges, c.vertices_captured, c.vertices, seconds_since(start));
  }

  std::string output;
};

struct LabelCommand : PartCommand {
  explicit LabelCommand(CLI::App& app)
      : PartCommand(app, "label", "Labels, charts and polycuboid map of a CAD solid, or labels of several that touch, to look at") {
    command.add_option("-o,--output", outputs, "Labelled boundary with charts, feature edges and map (.vtu), or its picture (.png); may be repeated")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command.add_flag("--numbers", picture.face_numbers, "Write the numbers of the CAD faces into the picture");
    command.add_option("--pixels", picture.size, "Width of the picture")->capture_default_str()->check(CLI::Range(100, 10000));
  }

  Supervision check(Monitor::Clock::time_point start) const {
    for (const std::string& output : outputs) {
      if (!output.ends_with(".vtu") && !output.ends_with(".png")) throw InvalidInput(output + ": the suffix must be .vtu or .png");
      check_writable(output);
    }
    return PartCommand::check(start, outputs);
  }

  void run(const Monitor& monitor, Monitor::Clock::time_point start) const {
    const MeshOptions options = arguments.options();
    const Assembly assembly = read(options, monitor);
    polycube::check(options, assembly.diagonal(), {assembly.faces(), assembly.edges(), assembly.vertices(), static_cast<int>(assembly.solids.size())});
    const LabelledPart labelled = label_part(assembly, options, monitor);
    const Inspection inspection = inspect(labelled);
    for (const std::string& output : outputs) {
      if (output.ends_with(".vtu")) write_vtu(output, labelled, inspection);
      if (output.ends_with(".png")) write_picture(output, labelled, inspection, picture);
    }
    if (!report.empty()) write_text(report, report_json(part, assembly, labelled, inspection));
    for (const std::string& warning : assembly.all_warnings()) std::cerr << "polycube: warning: " << one_line(warning) << "\n";
    if (labelled.failure) std::cerr << "polycube: warning: no map, stage " << labelled.failure->stage() << ": " << one_line(labelled.failure->what()) << "\n";
    const Violations& v = inspection.violations;
    const EdgeTable edges = edge_table(labelled);
    std::printf(
        "%s: %s, %d turning points, %d charts, %zu corners, CAD edges %d on boundaries %d with feature charts %d not captured, %d of %zu "
        "tets flipped, %.1f s\n",
        part.c_str(), v.valid() ? "valid" : "not valid", v.turning_points, inspection.charts, inspection.corners.size(), edges.boundary, edges.feature,
        edges.lost, labelled.flipped, labelled.tets.tets.size(), seconds_since(start));
  }

  std::vector<std::string> outputs;
  PictureOptions picture;
};

struct HexCommand {
  explicit HexCommand(CLI::App& app)
      : command(*app.add_subcommand("hex", "Hexahedra of a given polycuboid map (blocks, quantization, first geometry), without CAD")) {
    command.add_option("--tets", tets, "Tetrahedra, Medit .mesh")->required();
    command.add_option("--labels", labels, "Labels of the tets' facets")->required();
    command.add_option("--map", map, "Image of the tetrahedra, Medit .mesh")->required();
    command.add_option("-o,--output", output, "Hexahedra: .mesh (Medit), or .vtu with the block of every cell")->required();
    command.add_option("--scale", scale, "Edge length of the hexahedra over the mean tet edge in the map; 0: coarsest")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 1e6));
    command.add_option("--min-layers", min_layers, "Elements through every wall at least")->capture_default_str()->check(CLI::Range(1, 1000));
    command.add_flag("--subdivide", subdivide, "Subdivide the coarsest mesh to this scale: its cells are the blocks");
    command.add_option("--report", report, "Write a report as JSON")->check(named_file);
    command.add_option("--problem", problem, "Write the quantization problem as JSON, to compare solvers");
    command.add_flag("-v,--verbose", verbose, "Log what is done, with seconds, to standard error");
  }

  Supervision check(Monitor::Clock::time_point) const {
    if (!output.ends_with(".mesh") && !output.ends_with(".vtu")) throw InvalidInput(output + ": the suffix must be .mesh or .vtu");
    Supervision result;
    for (const std::string* path : {&output, &report, &problem}) {
      if (path->empty()) continue;
      check_writable(*path);
      result.outputs.push_back(*path);
    }
    check_apart(result.outputs, {tets, labels, map});
    return result;
  }

  void run(const Monitor& monitor, Monitor::Clock::time_point start) const {
    const PolycuboidInput input = read_polycuboid(tets, labels, map);
    HexMapOptions options;
    options.quantize.scale = scale;
    options.quantize.min_layers = min_layers;
    options.subdivide = subdivide;
    const HexMapResult result = hex_map(input, options, monitor);
    if (output.ends_with(".vtu")) {
      write_vtu(output, result.hexes, result.hex_cell);
    } else {
      write_medit(output, result.hexes);
    }
    if (!report.empty()) write_text(report, report_json(input, result));
    if (!problem.empty()) write_text(problem, problem_json(input, result));
    std::printf("%s: %zu blocks, %zu hexahedra, objective %g, bound %g, %.1f s\n", output.c_str(), result.blocks.blocks.size(), result.hexes.mesh.hexes.size(),
                result.quantization.objective, result.quantization.bound, seconds_since(start));
  }

  CLI::App& command;
  std::string tets, labels, map, output, report, problem;
  double scale = 1;
  int min_layers = 1;
  bool subdivide = false;
  bool verbose = false;
};

/// For FreeCAD, which watches over the process itself.
struct JobCommand {
  explicit JobCommand(CLI::App& app) : command(*app.add_subcommand("serve-job", "Mesh or labels of the part in a job's folder, for FreeCAD")) {
    command.set_version_flag("--version", POLYCUBE_VERSION);
    command.add_option("folder", folder, "Folder with shape.brep and options.json, where the result goes too")->required()->check(CLI::ExistingDirectory);
    command.add_option("kind", kind, "What to make of them")->capture_default_str()->check(CLI::IsMember({"mesh", "labels", "session"}));
  }

  CLI::App& command;
  std::string folder, kind = "mesh";
};

int complain(const std::string& message, Status status) {
  std::cerr << "polycube: " << one_line(message) << "\n";
  return status;
}

/// Runs the work; what it throws becomes one line on standard error and an exit status.
template <class Work>
int guarded(const Work& work) {
  try {
    return work();
  } catch (const InvalidInput& e) {
    return complain(e.what(), kBadInput);
  } catch (const StageFailed& e) {
    std::string entities;
    for (const CadRef& entity : e.entities()) entities += (entities.empty() ? " (" : ", ") + name(entity);
    return complain("stage " + e.stage() + ": " + e.what() + (entities.empty() ? "" : entities + ")"), kFailed);
  } catch (const Cancelled& e) {
    return complain(e.what(), kStopped);
  } catch (const std::filesystem::filesystem_error& e) {
    return complain((e.path1().empty() ? std::string("files") : e.path1().string()) + ": " + e.code().message(), kBadInput);
  } catch (const std::bad_alloc&) {
    return complain("out of memory", kFailed);
  } catch (const std::exception& e) {
    return complain(std::string("internal error: ") + e.what(), kFailed);
  } catch (...) {
    return complain("internal error", kFailed);
  }
}

/// Checks the command here and runs it in a process of its own.
template <class Command>
int supervised(const Command& command, Monitor::Clock::time_point start) {
  const Supervision supervision = command.check(start);
  const auto work = [&](StageNote& note) {
    return guarded([&] {
      Monitor monitor;
      monitor.set_deadline(supervision.deadline);
      const Console console(monitor, note, command.verbose);
      command.run(monitor, start);
      return static_cast<int>(kDone);
    });
  };
  return supervise(work, supervision);
}

/// Values of a trial come by the environment, which the engine's process and whatever runs this program hand on.
void take_tuning() {
  const char* text = std::getenv("POLYCUBE_TUNING");
  if (!text || !*text) return;
  set_tuning(text);
  std::cerr << "polycube: warning: other values than those of this program: " << text << "\n";
}

int run(int argc, char** argv) {
  const auto start = Monitor::Clock::now();
  CLI::App app{"Hexahedral meshes of CAD solids by polycube maps", "polycube"};
  app.set_version_flag("--version", POLYCUBE_VERSION);
  app.require_subcommand(1);
  const MeshCommand mesh_command(app);
  const LabelCommand label_command(app);
  const HexCommand hex_command(app);
  const JobCommand job_command(app);
  CLI::App* describe_command = app.add_subcommand("describe", "What this program offers, as JSON: options, names and colours of labels, order of nodes");
  bool tuning = false;
  describe_command->add_flag("--tuning", tuning,
                             "Instead the thresholds, weights and numbers of rounds in force, for developers; for a trial with others "
                             "set POLYCUBE_TUNING=pad.hopeless=1750,deform.outer=11");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    return complain(e.what(), kBadInput);
  }
  if (mesh_command.command.parsed()) return supervised(mesh_command, start);
  if (label_command.command.parsed()) return supervised(label_command, start);
  if (hex_command.command.parsed()) return supervised(hex_command, start);
  if (job_command.command.parsed()) return serve_job(job_command.folder, job_kind(job_command.kind));
  if (describe_command->parsed()) std::cout << (tuning ? describe_tuning() : describe_engine());
  return kDone;
}

}  // namespace
}  // namespace polycube

int main(int argc, char** argv) {
  return polycube::guarded([&] {
    polycube::take_tuning();
    return polycube::run(argc, argv);
  });
}
