#pragma once

#include <memory>
#include <unordered_map>

#include "scene/ors_graph_internal.h"

namespace rex::ors {

/// Merges edits into one node. It keeps an index of the attributes, so that many edits of many attributes
/// take no longer than reading them.
class Merger {
 public:
  /// Attributes are merged one by one, in braces within braces too; any other value is replaced. Throws
  /// Error for a value in place of attributes, and for too many attributes.
  void merge(Node& node, Node edit);

 private:
  void mergeAttribute(Graph& attributes, Node edit);
  std::optional<std::size_t> findSame(const Graph& attributes, const Node& edit);
  void takeKeys(Graph& attributes, const Node& edit, std::optional<std::size_t> same);

  std::unordered_map<std::string, std::vector<std::size_t>> havingKey_;  // of the first indexed_ attributes
  std::size_t indexed_ = 0;
  std::unordered_map<std::size_t, std::unique_ptr<Merger>> inner_;  // for braces within braces
};

/// Removes the attributes that edits left without any key.
void dropNameless(Node& node);

/// The keys, with blanks between them.
[[nodiscard]] std::string joinedKeys(const Node& node);

}  // namespace rex::ors
