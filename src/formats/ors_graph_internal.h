#pragma once

#include <list>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "base/error.h"
#include "formats/assets.h"
#include "geometry/pose.h"

// The .ors file as a list of nodes, before anything is known about bodies and joints.
namespace rex::ors {

struct Node;
using Graph = std::vector<Node>;

/// A place in one of the files; there may be a million, so the name of the file is kept elsewhere.
struct Place {
  const std::string* file = nullptr;
  int line = 0;
  int column = 0;
  operator SourceLocation() const { return {file ? *file : "", line, column}; }
};

/// A word of the file and where it stands.
struct Word {
  std::string text;
  Place where;
  std::optional<int> node{};  ///< of a parent given as -k: the id of the node it means
};

/// 'file.obj', in single quotes; relative to the folder of the scene, whichever file names it.
struct FileName {
  std::string path;
};

using Value = std::variant<bool, double, std::string, FileName, Eigen::MatrixXd, Pose, Graph>;

/// `keys (parents) value`; without a value it is the boolean true.
struct Node {
  std::vector<Word> keys;
  std::vector<Word> parents;
  Value value = true;
  Place where;       ///< first character of the node
  Place valueWhere;  ///< first character of the value; equal to `where` without one
  int id = 0;        ///< counts the nodes of all files as they are read
};

/// A scene as nodes: included files are in place, what was to be deleted is gone, edits are merged.
struct Document {
  Graph nodes;
  Diagnostics notes;
  std::list<std::string> files;  ///< the names that places point to
  bool isOneFile = true;         ///< nothing was included
};

/// What kind of value it is, for messages: "a number", "a pose <T ...>", ...
[[nodiscard]] std::string describe(const Value& value);

/// Parses a whole file. Throws Error with file, line and column for every breach of the grammar and of the
/// limits, and for an Include unless there are `assets` to find the file; what was noted before that goes to
/// `notesOfFailure`.
[[nodiscard]] Document parseGraph(std::string_view text, const std::string& fileName,
                                  const Assets* assets = nullptr, Diagnostics* notesOfFailure = nullptr);

}  // namespace rex::ors
