#include <algorithm>
#include <iterator>
#include <set>

#include <fmt/format.h>

#include "scene/ors_merger_internal.h"
#include "scene/ors_names_internal.h"
#include "scene/ors_node_list_internal.h"

namespace rex::ors {
namespace {

[[noreturn]] void failWithoutPartner(const Node& edit, const Graph& earlier) {
  std::vector<std::string> known;
  for (const Node& node : earlier) known.push_back(joinedKeys(node));
  throw Error({.what = "nothing to edit",
               .where = edit.where,
               .found = fmt::format("'{}'", joinedKeys(edit)),
               .wanted = "the words of an earlier statement",
               .nearest = nearestOfMany(joinedKeys(edit), std::move(known))});
}

}  // namespace

bool isEdit(const Node& node) {
  return !node.keys.empty() && (node.keys[0].text == "Edit" || node.keys[0].text == "Merge");
}

void NodeList::add(Node node) {
  live_.push_back(nodes_.size());
  nodes_.push_back(std::move(node));
}

std::optional<int> NodeList::previous(std::size_t k) const {
  if (k == 0 || k > live_.size()) return std::nullopt;
  return nodes_[live_[live_.size() - k]].id;
}

void NodeList::indexKeys() {
  for (; indexed_ < nodes_.size(); ++indexed_) {
    for (const Word& key : nodes_[indexed_].keys) {
      std::vector<std::size_t>& having = havingKey_[key.text];
      if (having.empty() || having.back() != indexed_) having.push_back(indexed_);
    }
  }
}

std::size_t NodeList::erase(std::span<const Word> keys) {
  indexKeys();
  std::set<const std::vector<std::size_t>*> lists;  // each once, however often its key is repeated
  for (const Word& key : keys) lists.insert(&havingKey_[key.text]);
  std::vector<const std::vector<std::size_t>*> rarestFirst(lists.begin(), lists.end());
  std::sort(rarestFirst.begin(), rarestFirst.end(), [](auto a, auto b) { return a->size() < b->size(); });
  std::vector<std::size_t> matching = *rarestFirst.front(), some;
  rarestFirst.push_back(&live_);
  for (const std::vector<std::size_t>* having : rarestFirst) {
    some.clear();
    if (matching.empty()) return 0;
    std::set_intersection(matching.begin(), matching.end(), having->begin(), having->end(),
                          std::back_inserter(some));
    std::swap(matching, some);
  }
  some.clear();
  std::set_difference(live_.begin(), live_.end(), matching.begin(), matching.end(), std::back_inserter(some));
  std::swap(live_, some);
  return matching.size();
}

Graph NodeList::finish() {
  const bool hasEdits =
      std::any_of(live_.begin(), live_.end(), [&](std::size_t i) { return isEdit(nodes_[i]); });
  std::unordered_map<std::string, std::size_t> firstOf;  // places in the graph
  std::unordered_map<std::size_t, Merger> mergers;
  Graph graph;
  graph.reserve(live_.size());
  for (const std::size_t i : live_) {
    Node& node = nodes_[i];
    if (isEdit(node)) {
      node.keys.erase(node.keys.begin());
      const auto found = firstOf.find(joinedKeys(node));
      if (found == firstOf.end()) failWithoutPartner(node, graph);
      mergers[found->second].merge(graph[found->second], std::move(node));
    } else {
      if (hasEdits) firstOf.emplace(joinedKeys(node), graph.size());
      graph.push_back(std::move(node));
    }
  }
  for (const auto& [edited, merger] : mergers) dropNameless(graph[edited]);
  return graph;
}

}  // namespace rex::ors
