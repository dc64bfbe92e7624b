#pragma once

#include <span>
#include <unordered_map>

#include "scene/ors_graph_internal.h"

namespace rex::ors {

/// The nodes between two braces, or of the whole scene, while they are read: nodes come and are deleted, and
/// edits wait for the end.
class NodeList {
 public:
  std::size_t size() const { return live_.size(); }
  void add(Node node);
  /// The id of the k-th node before the next one; none if there are fewer.
  std::optional<int> previous(std::size_t k) const;
  /// Deletes the nodes that have all these keys; how many.
  std::size_t erase(std::span<const Word> keys);
  /// All nodes, with each Edit merged into the first earlier node of the same keys. Throws Error naming the
  /// nearest if there is none.
  Graph finish();

 private:
  void indexKeys();

  std::vector<Node> nodes_;                                              // also the deleted ones
  std::vector<std::size_t> live_;                                        // indices of the others, ascending
  std::unordered_map<std::string, std::vector<std::size_t>> havingKey_;  // of the first indexed_ nodes
  std::size_t indexed_ = 0;
};

/// Whether the node is an Edit, or Merge, as it was called once.
[[nodiscard]] bool isEdit(const Node& node);

}  // namespace rex::ors
