#include "authoring/joined_variants.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "submission/file_pieces.h"

namespace rex::grading {
namespace {

std::string ownName(std::size_t variant, std::string_view function) {
  return fmt::format("variant_{}_{}", variant, function);
}

// Whether a piece is a function and `text` differs from it in the body only.
bool differsInBody(std::string_view reference, const FilePiece& piece, std::string_view text) {
  const std::string_view function = reference.substr(piece.start, piece.end - piece.start);
  const std::size_t head = function.find('{', piece.nameStart - piece.start);
  return !piece.function.empty() && !piece.isInternal &&
         text.substr(0, head + 1) == function.substr(0, head + 1);
}

// The texts of the pieces, by index, that differ from the reference; none if some cannot be swapped.
std::vector<std::pair<std::size_t, std::string>> differingBodies(std::string_view reference,
                                                                 const std::vector<FilePiece>& pieces,
                                                                 std::string_view variant) {
  const std::vector<FilePiece> its = filePieces(CppText(variant));
  if (its.size() != pieces.size()) return {};
  std::vector<std::pair<std::size_t, std::string>> differing;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const std::string_view text = variant.substr(its[i].start, its[i].end - its[i].start);
    if (text == reference.substr(pieces[i].start, pieces[i].end - pieces[i].start)) continue;
    if (!differsInBody(reference, pieces[i], text) || pieces[i].function == "main") return {};
    differing.emplace_back(i, text);
  }
  return differing;
}

int linesIn(std::string_view text) { return static_cast<int>(std::count(text.begin(), text.end(), '\n')); }

}  // namespace

JoinedVariants::JoinedVariants(std::string_view reference, const std::vector<std::string>& variants) {
  const std::vector<FilePiece> pieces = filePieces(CppText(reference));
  std::vector<std::vector<std::pair<std::size_t, std::string>>> versions(pieces.size());  // variant, text
  for (std::size_t k = 0; k < variants.size(); ++k) {
    const auto bodies = differingBodies(reference, pieces, variants[k]);
    functions_.push_back(bodies.size());
    for (const auto& [i, text] : bodies) versions[i].emplace_back(k, text);
  }
  std::size_t done = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const FilePiece& piece = pieces[i];
    source_ += reference.substr(done, piece.start - done);
    done = piece.end;
    // The compiler must not use anything that it knows about the body when it compiles the callers.
    if (!versions[i].empty()) source_ += "[[gnu::noipa]] ";
    // Nobody calls main(), and compiling what it shows would take a quarter of the time.
    source_ += piece.function == "main" ? "int main() {}" : reference.substr(piece.start, done - piece.start);
    for (auto& [k, text] : versions[i]) {
      text.replace(piece.nameStart - piece.start, piece.function.size(), ownName(k, piece.function));
      source_ += '\n';
      const int first = linesIn(source_) + 1;
      places_.push_back({first, first + linesIn(text), k});
      source_ += text;
    }
  }
  source_ += reference.substr(done);
}

std::size_t JoinedVariants::variantAt(int line) const {
  const auto place = std::find_if(places_.begin(), places_.end(),
                                  [&](const Place& p) { return p.first <= line && line <= p.last; });
  return place == places_.end() ? functions_.size() : place->variant;
}

std::vector<StandIn> standIns(const std::vector<std::string>& symbols, std::size_t variant) {
  constexpr std::string_view kMangled = "_Z";
  const std::string mark = ownName(variant, "");
  std::vector<StandIn> found;
  for (const std::string& symbol : symbols) {
    // "_Z16variant_2_turnedRKd": the length of the name, the name, the parameters.
    if (!symbol.starts_with(kMangled)) continue;
    std::string_view name = std::string_view(symbol).substr(kMangled.size());
    const std::size_t length = takeNumber<std::size_t>(name).value_or(0);
    if (!name.starts_with(mark) || length <= mark.size()) continue;
    std::string replaced = fmt::format("{}{}{}", kMangled, length - mark.size(), name.substr(mark.size()));
    if (std::find(symbols.begin(), symbols.end(), replaced) != symbols.end())
      found.push_back({symbol, std::move(replaced)});
  }
  return found;
}

}  // namespace rex::grading
