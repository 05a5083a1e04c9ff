// A job: a folder with a part and options, from which a process of its own makes a mesh or labels for a program that watches it.
#pragma once

#include <string>

#include "core/options.h"

namespace polycube {

enum class JobKind { kMesh, kLabels, kSession };

/// "mesh", "labels" or "session"; throws InvalidInput for another word.
JobKind job_kind(const std::string& name);

/// Does the job in `folder` and returns the exit status: 0 done, 1 invalid input, 2 a stage failed, 3 cancelled. It reads shape.brep and
/// options.json and leaves result.npz and report.json, or labels.npz and labels.json, or error.json. Standard output gets one JSON object a
/// line:
/// {"progress": [stage, fraction]} or {"log": line}. The process gets a group of its own, so that one kill reaches what it starts, and ends
/// the work when its parent is gone. A session reads lines from standard input, each the name of a folder inside `folder` with options.json, makes that mesh
/// there with what the meshes before it made (after the name may stand what else is wanted: labels, polycube or count), and says {"done": status}. Throws what
/// cannot be left in the folder.
int serve_job(const std::string& folder, JobKind kind);

/// Options from a JSON object of names and values: numbers, truth values and text, labels as {"Face3": "+X"}, sizes and divisions likewise,
/// a frame as
/// [[1, 0, 0], [0, 1, 0]], faces as ["Face3"]; null is the default. Throws InvalidInput.
MeshOptions options_from_json(const std::string& text);

}  // namespace polycube
