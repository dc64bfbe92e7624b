#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "base/error.h"
#include "geometry/pose.h"

// The .ors file as a list of nodes, before anything is known about bodies and joints.
namespace rex::ors {

struct Node;
using Graph = std::vector<Node>;

/// A word of the file and where it stands.
struct Word {
  std::string text;
  SourceLocation where;
};

/// 'file.obj', in single quotes.
struct FileName {
  std::string path;
};

using Value = std::variant<bool, double, std::string, FileName, Eigen::MatrixXd, Pose, Graph>;

/// `keys (parents) value`; without a value it is the boolean true.
struct Node {
  std::vector<Word> keys;
  std::vector<Word> parents;
  Value value = true;
  SourceLocation where;       ///< first character of the node
  SourceLocation valueWhere;  ///< first character of the value; equal to `where` without one
};

/// What kind of value it is, for messages: "a number", "a pose <T ...>", ...
[[nodiscard]] std::string describe(const Value& value);

/// Parses a whole file. Throws Error with file, line and column for every breach of the grammar, and when
/// nesting goes deeper than 100 or there are more than 200 000 nodes.
[[nodiscard]] Graph parseGraph(std::string_view text, const std::string& fileName);

}  // namespace rex::ors
