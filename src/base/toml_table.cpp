#include "base/toml_table.h"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "base/instant.h"
#include "base/text.h"

namespace rex {

struct TomlTable::Node {
  std::shared_ptr<const toml::table> root;
  const toml::table* table;
  std::string file;

  SourceLocation at(const toml::source_region& region) const {
    return {file, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
  }

  const toml::node& require(std::string_view key, const std::string& name, const std::string& wanted) const {
    if (const toml::node* node = table->get(key)) return *node;
    throw Error(
        {.what = fmt::format("{}: no '{}'", name, key), .where = at(table->source()), .wanted = wanted});
  }

  [[noreturn]] void complain(std::string_view key, const std::string& name, const std::string& wanted) const {
    const toml::node& node = *table->get(key);
    std::ostringstream found;
    node.visit([&](const auto& value) { found << value; });
    throw Error({.what = fmt::format("{}: '{}'", name, key),
                 .where = at(node.source()),
                 .found = found.str(),
                 .wanted = wanted});
  }
};

TomlTable::TomlTable(Node node, std::string name)
    : node_(std::make_shared<const Node>(std::move(node))), name_(std::move(name)) {}

TomlTable TomlTable::read(const std::filesystem::path& file, std::string name, const std::string& wanted) {
  if (!std::filesystem::is_regular_file(file))
    throw Error({.what = "no such file", .where = {file.string()}, .wanted = wanted});
  try {
    const auto root = std::make_shared<const toml::table>(toml::parse_file(file.string()));
    return {Node{root, root.get(), file.string()}, std::move(name)};
  } catch (const toml::parse_error& error) {
    const auto& begin = error.source().begin;
    throw Error({.what = std::string(error.description()),
                 .where = {file.string(), static_cast<int>(begin.line), static_cast<int>(begin.column)}});
  }
}

void TomlTable::refuseKeysBut(const std::vector<std::string>& known) const {
  for (const auto& [key, node] : *node_->table) {
    const std::string found(key.str());
    if (std::find(known.begin(), known.end(), found) != known.end()) continue;
    throw Error({.what = fmt::format("unknown key '{}' in {}", found, name_),
                 .where = node_->at(key.source()),
                 .wanted = fmt::format("one of {}", join(known, ", ")),
                 .nearest = nearestNames(found, known)});
  }
}

std::vector<std::string> TomlTable::keys() const {
  std::vector<std::string> keys;
  for (const auto& [key, node] : *node_->table) keys.emplace_back(key.str());
  return keys;
}

bool TomlTable::has(std::string_view key) const { return node_->table->contains(key); }

SourceLocation TomlTable::where(std::string_view key) const {
  const toml::node* node = node_->table->get(key);
  return node_->at(node ? node->source() : node_->table->source());
}

std::string TomlTable::text(std::string_view key) const {
  const auto value = node_->require(key, name_, "a string").value_exact<std::string>();
  if (!value || value->empty()) node_->complain(key, name_, "a string that is not empty");
  return *value;
}

bool TomlTable::boolean(std::string_view key) const {
  const auto value = node_->require(key, name_, "true or false").value_exact<bool>();
  if (!value) node_->complain(key, name_, "true or false");
  return *value;
}

int TomlTable::integer(std::string_view key, int lowest, int highest) const {
  const std::string wanted = fmt::format("a whole number from {} to {}", lowest, highest);
  const auto value = node_->require(key, name_, wanted).value_exact<std::int64_t>();
  if (!value || *value < lowest || *value > highest) node_->complain(key, name_, wanted);
  return static_cast<int>(*value);
}

double TomlTable::number(std::string_view key, double above, double highest) const {
  const std::string wanted = fmt::format("a number above {} and at most {}", above, highest);
  const toml::node& node = node_->require(key, name_, wanted);
  const auto value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value || !(*value > above) || *value > highest) node_->complain(key, name_, wanted);
  return *value;
}

std::vector<std::string> TomlTable::texts(std::string_view key) const {
  std::vector<std::string> list;
  const toml::array* array = node_->require(key, name_, "a list of strings").as_array();
  if (!array) node_->complain(key, name_, "a list of strings");
  for (const toml::node& node : *array) {
    if (!node.is_string()) node_->complain(key, name_, "a list of strings");
    list.push_back(node.as_string()->get());
  }
  return list;
}

namespace {

// Instants count whole seconds.
std::string withoutFraction(std::string time) {
  if (const std::size_t point = time.find('.'); point != std::string::npos)
    time.erase(point, time.find_first_not_of("0123456789", point + 1) - point);
  return time;
}

}  // namespace

std::int64_t TomlTable::instant(std::string_view key) const {
  const std::string wanted = "a time with its zone, such as 2026-11-20T23:59:00+01:00";
  const auto value = node_->require(key, name_, wanted).value_exact<toml::date_time>();
  std::ostringstream text;
  if (value) text << *value;
  const auto seconds = parseInstant(withoutFraction(text.str()));
  if (!value || !value->offset || !seconds) node_->complain(key, name_, wanted);
  return *seconds;
}

std::string TomlTable::day(std::string_view key) const {
  const std::string wanted = "a date without a time, such as 2026-11-20";
  const auto value = node_->require(key, name_, wanted).value_exact<toml::date>();
  if (!value) node_->complain(key, name_, wanted);
  std::ostringstream text;
  text << *value;
  return text.str();
}

std::size_t TomlTable::indexOf(std::string_view key, const std::vector<std::string>& names) const {
  const std::string wanted = fmt::format("one of {}", join(names, ", "));
  const auto text = node_->require(key, name_, wanted).value_exact<std::string>();
  const auto found = text ? std::find(names.begin(), names.end(), *text) : names.end();
  if (found == names.end()) node_->complain(key, name_, wanted);
  return static_cast<std::size_t>(found - names.begin());
}

std::optional<TomlTable> TomlTable::table(std::string_view key, std::string name,
                                          const std::string& wanted) const {
  const toml::node* node = node_->table->get(key);
  if (node == nullptr) return {};
  if (!node->is_table())
    throw Error({.what = fmt::format("'{}'", key), .where = where(key), .wanted = wanted});
  return TomlTable({node_->root, node->as_table(), node_->file}, std::move(name));
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) const {
  const toml::node* node = node_->table->get(key);
  if (node == nullptr) return {};
  const toml::array* array = node->as_array();
  if (array == nullptr || !array->is_homogeneous<toml::table>())
    throw Error({.what = fmt::format("'{}'", key),
                 .where = node_->at(node->source()),
                 .wanted = fmt::format("tables headed [[{}]]", key)});
  std::vector<TomlTable> tables;
  for (const toml::node& element : *array)
    tables.push_back(TomlTable({node_->root, element.as_table(), node_->file}, fmt::format("[[{}]]", key)));
  return tables;
}

}  // namespace rex
