#include <algorithm>
#include <iterator>
#include <set>

#include <fmt/format.h>

#include "formats/assets_internal.h"
#include "formats/ors_attributes_internal.h"
#include "formats/ors_node_list_internal.h"
#include "formats/scene_file.h"

namespace rex::ors {

namespace fs = std::filesystem;

Files::Files(const Assets* assets, const std::string& file, std::size_t bytes)
    : assets_(assets), bytes_(bytes) {
  if (bytes > kMostBytes) {
    throw Error({.what = "scene too large",
                 .where = {file},
                 .found = fmt::format("{} bytes", bytes),
                 .wanted = fmt::format("at most {} MiB", kMostBytes >> 20)});
  }
  if (assets) open_.push_back(fs::weakly_canonical(file));
}

Files::Opened Files::open(const FileName& file, const Place& where) {
  const std::string what = fmt::format("Include '{}'", file.path);
  const auto fail = [&](std::string found, std::string wanted) {
    throw Error({.what = what, .where = where, .found = std::move(found), .wanted = std::move(wanted)});
  };
  if (!assets_) fail("a scene that was given as text", "no Include: only scenes in files include others");
  const fs::path path = assets_->find(file.path, where, what);
  if (open_.size() > kDeepestIncludes)
    fail(fmt::format("level {}", open_.size()), fmt::format("at most {}", kDeepestIncludes));
  const fs::path real = fs::weakly_canonical(path);
  if (std::find(open_.begin(), open_.end(), real) != open_.end())
    fail("a file that includes itself", "another file");
  const fs::path folder =
      isAddress(file.path)
          ? internal::folderOf(path).lexically_relative(internal::realPath(assets_->folder()))
          : fs::path(file.path).parent_path();
  Opened opened{path.string(), readSceneText(path), folder};
  bytes_ += opened.text.size();
  if (bytes_ > kMostBytes)
    fail(fmt::format("{} bytes in all", bytes_), fmt::format("at most {} MiB", kMostBytes >> 20));
  open_.push_back(real);
  return opened;
}

bool Files::hasFolder(const std::string& folder) const {
  std::error_code problem;
  return !assets_ || isAddress(folder) || fs::is_directory(open_.front().parent_path() / folder, problem);
}

bool isAddress(const std::string& name) { return name.find("://") != std::string::npos; }

std::string inFolder(const std::string& folder, const std::string& name) {
  const bool isComplete = name.starts_with('/') || isAddress(name);
  return folder.empty() || isComplete ? name : folder + (folder.ends_with('/') ? "" : "/") + name;
}

namespace {

bool haveSameKeys(const Node& a, const Node& b) {
  return std::equal(a.keys.begin(), a.keys.end(), b.keys.begin(), b.keys.end(),
                    [](const Word& x, const Word& y) { return x.text == y.text; });
}

}  // namespace

void Merger::merge(Node& node, Node edit) {
  if (!edit.parents.empty()) node.parents = std::move(edit.parents);
  Graph* old = std::get_if<Graph>(&node.value);
  Graph* changes = std::get_if<Graph>(&edit.value);
  if (old && changes) {
    for (Node& change : *changes) mergeAttribute(*old, std::move(change));
    return;
  }
  if (old) {
    throw Error({.what = fmt::format("Edit of '{}'", joinedKeys(node)),
                 .where = edit.where,
                 .found = describe(edit.value),
                 .wanted = "{attributes}"});
  }
  node.value = std::move(edit.value);
  node.valueWhere = edit.valueWhere;
}

void Merger::mergeAttribute(Graph& attributes, Node edit) {
  for (; indexed_ < attributes.size(); ++indexed_)
    for (const Word& key : attributes[indexed_].keys) havingKey_[key.text].push_back(indexed_);
  const auto same = findSame(attributes, edit);
  takeKeys(attributes, edit, same);
  if (same) {
    std::unique_ptr<Merger>& inner = inner_[*same];
    if (!inner) inner = std::make_unique<Merger>();
    inner->merge(attributes[*same], std::move(edit));
    return;
  }
  if (attributes.size() >= kMostAttributes) {
    throw Error({.what = "too many attributes",
                 .where = edit.where,
                 .wanted = fmt::format("at most {} in one pair of braces", kMostAttributes)});
  }
  attributes.push_back(std::move(edit));
}

std::optional<std::size_t> Merger::findSame(const Graph& attributes, const Node& edit) {
  if (edit.keys.empty()) return std::nullopt;
  const std::vector<std::size_t>& having = havingKey_[edit.keys[0].text];
  const auto same = std::find_if(having.begin(), having.end(),
                                 [&](std::size_t i) { return haveSameKeys(attributes[i], edit); });
  return same == having.end() ? std::nullopt : std::optional(*same);
}

// Attributes are found by any of their keys, so an edited one takes its keys away from all others.
void Merger::takeKeys(Graph& attributes, const Node& edit, std::optional<std::size_t> same) {
  for (const Word& key : edit.keys) {
    std::vector<std::size_t>& having = havingKey_[key.text];
    for (const std::size_t i : having) {
      if (i != same) std::erase_if(attributes[i].keys, [&](const Word& k) { return k.text == key.text; });
    }
    having.clear();
    if (same) having.push_back(*same);
  }
}

void dropNameless(Node& node) {
  Graph* attributes = std::get_if<Graph>(&node.value);
  if (!attributes) return;
  std::erase_if(*attributes, [](const Node& attribute) { return attribute.keys.empty(); });
  for (Node& attribute : *attributes) dropNameless(attribute);
}

std::string joinedKeys(const Node& node) {
  std::string text;
  for (const Word& key : node.keys) text += (text.empty() ? "" : " ") + key.text;
  return text;
}

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

// The name of a parent, also of one given by counting back; names of nameless joints consist of such names.
std::string NodeList::nameOf(const Word& parent) const {
  if (!parent.node) return parent.text;
  const auto meant = std::lower_bound(nodes_.begin(), nodes_.end(), *parent.node,
                                      [](const Node& node, int id) { return node.id < id; });
  return meant == nodes_.end() || meant->keys.empty() ? parent.text : meant->keys.back().text;
}

// What messages call a joint without a name; empty for anything else.
std::string NodeList::nameOfJoint(const Node& node) const {
  if (node.keys.size() != 1 || node.keys[0].text != "joint" || node.parents.size() != 2) return "";
  return nameOf(node.parents[0]) + ">" + nameOf(node.parents[1]);
}

// "(arm hand)". A valid statement has at most two; the names of as many as a file may list would take much
// memory.
std::string NodeList::parentsOf(const Node& node) const {
  std::string text;
  for (const Word& parent : node.parents)
    text += (text.empty() ? "(" : " ") + (node.parents.size() > 2 ? parent.text : nameOf(parent));
  return text.empty() ? "" : text + ")";
}

std::string NodeList::textOf(const Node& node) const {
  const std::string keys = joinedKeys(node), parents = parentsOf(node);
  return keys + (keys.empty() || parents.empty() ? "" : " ") + parents;
}

// Parents count as keys in brackets, which occur in no other key.
void NodeList::indexKeys() {
  const auto add = [&](const std::string& key) {
    std::vector<std::size_t>& having = havingKey_[key];
    if (having.empty() || having.back() != indexed_) having.push_back(indexed_);
  };
  for (; indexed_ < nodes_.size(); ++indexed_) {
    const Node& node = nodes_[indexed_];
    for (const Word& key : node.keys) add(key.text);
    if (!node.parents.empty()) add(parentsOf(node));
    if (const std::string name = nameOfJoint(node); !name.empty()) add(name);
  }
}

std::size_t NodeList::erase(const Node& named) {
  indexKeys();
  std::set<const std::vector<std::size_t>*> lists;  // each once, however often its key is repeated
  for (const Word& key : named.keys) lists.insert(&havingKey_[key.text]);
  if (!named.parents.empty()) lists.insert(&havingKey_[parentsOf(named)]);
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
  if (std::any_of(live_.begin(), live_.end(), [&](std::size_t i) { return isEdit(nodes_[i]); })) mergeEdits();
  Graph graph;
  graph.reserve(live_.size());
  for (const std::size_t i : live_) graph.push_back(std::move(nodes_[i]));
  return graph;
}

void NodeList::mergeEdits() {
  Index firstOf;
  std::unordered_map<std::size_t, Merger> mergers;
  std::vector<std::size_t> kept;
  for (const std::size_t i : live_) {
    Node& node = nodes_[i];
    if (isEdit(node)) {
      node.keys.erase(node.keys.begin());
      const auto partner = partnerOf(node, firstOf);
      if (!partner) failWithoutPartner(node, kept);
      mergers[*partner].merge(nodes_[*partner], std::move(node));
    } else {
      addTexts(i, firstOf);
      kept.push_back(i);
    }
  }
  for (const auto& [edited, merger] : mergers) dropNameless(nodes_[edited]);
  live_ = std::move(kept);
}

void NodeList::addTexts(std::size_t i, Index& firstOf) const {
  firstOf.emplace(joinedKeys(nodes_[i]), i);
  if (!nodes_[i].parents.empty()) firstOf.emplace(textOf(nodes_[i]), i);
  if (const std::string name = nameOfJoint(nodes_[i]); !name.empty()) firstOf.emplace("joint " + name, i);
}

// Only statements with a name are recognised without their parents, so that parents can be replaced.
std::optional<std::size_t> NodeList::partnerOf(const Node& edit, const Index& firstOf) const {
  auto found = firstOf.find(textOf(edit));
  if (found == firstOf.end() && edit.keys.size() > 1) found = firstOf.find(joinedKeys(edit));
  return found == firstOf.end() ? std::nullopt : std::optional(found->second);
}

void NodeList::failWithoutPartner(const Node& edit, const std::vector<std::size_t>& earlier) const {
  const bool hasParents = !edit.parents.empty();
  std::vector<std::string> known;
  for (const std::size_t i : earlier) {
    const std::string joint = hasParents ? "" : nameOfJoint(nodes_[i]);
    known.push_back(hasParents      ? textOf(nodes_[i])
                    : joint.empty() ? joinedKeys(nodes_[i])
                                    : "joint " + joint);
  }
  throw Error({.what = "nothing to edit",
               .where = edit.where,
               .found = fmt::format("'{}'", textOf(edit)),
               .wanted = fmt::format("the words{} of an earlier statement", hasParents ? " and parents" : ""),
               .nearest = nearestOfMany(textOf(edit), std::move(known))});
}

}  // namespace rex::ors
