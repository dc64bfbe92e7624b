#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "formats/ors_attributes_internal.h"

namespace rex::ors {
namespace {

const Graph kNone;

bool hasKey(const Node& node, std::string_view name) {
  return std::any_of(node.keys.begin(), node.keys.end(), [&](const Word& key) { return key.text == name; });
}

bool isNumber(std::string_view word) {
  const std::size_t first = word.find_first_not_of("+-.");
  return first != std::string_view::npos && word[first] >= '0' && word[first] <= '9';
}

// "a number or an array of 3 or 4 numbers".
std::string rowOf(std::initializer_list<int> counts) {
  if (counts.size() == 0) return "one row of numbers";
  std::string number, arrays;
  for (const int count : counts) {
    if (count == 1) {
      number = "a number";
    } else {
      arrays += (arrays.empty() ? "an array of " : " or ") + std::to_string(count);
    }
  }
  if (arrays.empty()) return number;
  return number + (number.empty() ? "" : " or ") + arrays + " numbers";
}

// A long list of notes helps nobody and takes a long time to make.
bool isFull(Diagnostics& notes, const Place& where) {
  if (notes.size() == kMostNotes) notes.push_back({where, "further notes are left out"});
  return notes.size() > kMostNotes;
}

}  // namespace

Attributes::Attributes(const Node& node, std::string owner)
    : node_(node), owner_(std::move(owner)), graph_(std::get_if<Graph>(&node.value)) {
  if (graph_) return;
  graph_ = &kNone;
  if (const bool* flag = std::get_if<bool>(&node.value); flag && *flag) return;
  throw Error({.what = owner_,
               .where = node.valueWhere,
               .found = describe(node.value),
               .wanted = "{attributes} on the line of its name"});
}

const Node* Attributes::find(std::string_view name) const {
  const auto found = std::find_if(graph_->begin(), graph_->end(),
                                  [&](const Node& attribute) { return hasKey(attribute, name); });
  return found == graph_->end() ? nullptr : &*found;
}

bool Attributes::flag(std::string_view name) const {
  if (const Node* attribute = find(name)) {
    if (const bool* value = std::get_if<bool>(&attribute->value)) return *value;
    const double* number = std::get_if<double>(&attribute->value);
    const std::string* word = std::get_if<std::string>(&attribute->value);
    if (word && (*word == "no" || *word == "off")) return attribute->keys.size() > 1;
    return !number || *number != 0 || attribute->keys.size() > 1;
  }
  for (std::size_t i = 1; i + 1 < node_.keys.size(); ++i)
    if (node_.keys[i].text == name) return true;
  return false;
}

void Attributes::noteWords(const std::vector<std::string>& flags, Diagnostics& notes) const {
  requireOneStatement();
  for (std::size_t i = 1; i + 1 < node_.keys.size(); ++i) {
    const Word& word = node_.keys[i];
    if (std::find(flags.begin(), flags.end(), word.text) != flags.end()) continue;
    if (isFull(notes, word.where)) return;
    const std::vector<std::string> nearest = nearestNames(word.text, flags);
    notes.push_back(
        {word.where,
         fmt::format("{}: unknown word '{}' is ignored{}", owner_, word.text,
                     nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest.front())),
         Severity::kWarning});
    return;
  }
}

void Attributes::requireOneStatement() const {
  for (std::size_t i = 1; i + 1 < node_.keys.size(); ++i) {
    const Word& word = node_.keys[i];
    if (word.text != "body" && word.text != "shape" && word.text != "joint") continue;
    throw Error({.what = fmt::format("{}: another statement among its words", owner_),
                 .where = word.where,
                 .found = fmt::format("'{}'", word.text),
                 .wanted = "{...} or the end of the line before it"});
  }
}

void Attributes::noteFlags(std::initializer_list<const char*> names, Diagnostics& notes) const {
  static const std::vector<std::string> kKnown = {"true", "false", "yes", "no", "on", "off"};
  for (const char* name : names) {
    const Node* attribute = find(name);
    const std::string* word = attribute ? std::get_if<std::string>(&attribute->value) : nullptr;
    if (!word || attribute->keys.size() > 1) continue;
    if (std::find(kKnown.begin(), kKnown.end(), *word) != kKnown.end()) continue;
    const std::vector<std::string> nearest = nearestNames(*word, kKnown);
    note(name,
         fmt::format("counts as true: '{}' is neither true nor false{}", *word,
                     nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest.front())),
         Severity::kWarning, notes);
  }
}

template <class T>
std::optional<T> Attributes::get(std::string_view name, const char* wanted) const {
  const Node* attribute = find(name);
  if (!attribute) return std::nullopt;
  if (const T* value = std::get_if<T>(&attribute->value)) return *value;
  fail(name, describe(attribute->value), wanted);
}

std::optional<double> Attributes::number(std::string_view name) const {
  return get<double>(name, "a number");
}

std::optional<double> Attributes::size(std::string_view name) const {
  const auto value = number(name);
  if (value && *value < 0) fail(name, fmt::format("{}", *value), "a number >= 0");
  return value;
}

std::optional<Pose> Attributes::pose(std::string_view name) const {
  return get<Pose>(name, "a pose <T ...>");
}

std::optional<std::string> Attributes::text(std::string_view name, const char* wanted) const {
  return get<std::string>(name, wanted);
}

std::optional<FileName> Attributes::file(std::string_view name) const {
  return get<FileName>(name, "a file name in single quotes");
}

std::optional<Eigen::VectorXd> Attributes::row(std::string_view name, std::initializer_list<int> counts,
                                               bool mayBeInfinite) const {
  const Node* attribute = find(name);
  if (!attribute) return std::nullopt;
  const auto isCount = [&](Eigen::Index n) {
    return counts.size() == 0 || std::find(counts.begin(), counts.end(), n) != counts.end();
  };
  if (const double* value = std::get_if<double>(&attribute->value); value && isCount(1))
    return Eigen::VectorXd::Constant(1, *value);
  const auto* array = std::get_if<Eigen::MatrixXd>(&attribute->value);
  if (!array || array->rows() > 1 || !isCount(array->size()))
    fail(name, describe(attribute->value), rowOf(counts));
  if (!mayBeInfinite && !array->allFinite()) fail(name, "an infinite number", "finite numbers");
  return Eigen::VectorXd(array->reshaped());
}

std::optional<std::size_t> Attributes::choice(std::string_view name, std::span<const Choice> choices,
                                              std::span<const Alias> aliases) const {
  const Node* attribute = find(name);
  if (!attribute) return std::nullopt;
  const double* number = std::get_if<double>(&attribute->value);
  const std::string* word = std::get_if<std::string>(&attribute->value);
  std::vector<std::string> known;
  int largest = 0;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const Choice& choice = choices[i];
    if (number && choice.number >= 0 && *number == choice.number) return i;
    if (word && !word->empty() && *word == choice.name) return i;
    largest = std::max(largest, choice.number);
    if (*choice.name) known.emplace_back(choice.name);
  }
  std::vector<std::string> nearest = nearestNames(word ? *word : "", known);
  for (const Alias& alias : aliases)
    if (word && *word == alias.name) nearest = {alias.meaning};
  throw Error({.what = fmt::format("{}: unknown {}", owner_, name),
               .where = attribute->valueWhere,
               .found = describe(attribute->value),
               .wanted = fmt::format("a number from 0 to {} or a name such as '{}'", largest, known.front()),
               .nearest = std::move(nearest)});
}

void Attributes::noteUnknown(const std::vector<std::string>& known, Diagnostics& notes) const {
  std::set<std::string_view> seen;
  for (const Node& attribute : *graph_) {
    for (const Word& key : attribute.keys) {
      if (isNumber(key.text)) failAtNumber(attribute, key);
      const bool isKnown = std::find(known.begin(), known.end(), key.text) != known.end();
      if (isKnown && seen.insert(key.text).second) continue;
      if (isFull(notes, key.where)) return;
      if (isKnown) {
        notes.push_back({key.where,
                         fmt::format("{}: attribute '{}' is given twice: the first counts", owner_, key.text),
                         Severity::kWarning});
        continue;
      }
      std::string text = fmt::format("{}: unknown attribute '{}' is ignored", owner_, key.text);
      const auto nearest = key.text.size() > 1 ? nearestNames(key.text, known) : std::vector<std::string>();
      if (!nearest.empty()) text += fmt::format(" (did you mean '{}'?)", nearest.front());
      notes.push_back({key.where, text, nearest.empty() ? Severity::kNote : Severity::kWarning});
    }
  }
}

void Attributes::failAtNumber(const Node& attribute, const Word& key) const {
  const std::string& first = attribute.keys.front().text;
  if (&key == &attribute.keys.front()) {
    throw Error({.what = fmt::format("{}: a number without a name", owner_),
                 .where = key.where,
                 .found = fmt::format("'{}'", key.text),
                 .wanted = "'.' as the decimal point, or an attribute NAME=VALUE"});
  }
  throw Error({.what = fmt::format("{}: attribute '{}': '=' is missing", owner_, first),
               .where = key.where,
               .found = fmt::format("'{}'", key.text),
               .wanted = fmt::format("{}={}", first, key.text)});
}

void Attributes::note(std::string_view name, std::string_view text, Severity severity,
                      Diagnostics& notes) const {
  if (isFull(notes, where(name))) return;
  notes.push_back({where(name), fmt::format("{}: attribute '{}' {}", owner_, name, text), severity});
}

Place Attributes::where(std::string_view name) const {
  const Node* attribute = find(name);
  return attribute ? attribute->valueWhere : node_.where;
}

void Attributes::fail(std::string_view name, std::string found, std::string wanted) const {
  throw Error({.what = fmt::format("{}: attribute '{}'", owner_, name),
               .where = where(name),
               .found = std::move(found),
               .wanted = std::move(wanted)});
}

}  // namespace rex::ors
