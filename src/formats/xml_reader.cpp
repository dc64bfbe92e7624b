#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <optional>

#include <expat.h>
#include <fmt/format.h>

#include "base/text.h"
#include "formats/xml_reader_internal.h"

namespace rex::xml {
namespace {

constexpr std::size_t kLargestFile = 8u << 20;
constexpr std::size_t kDeepest = 100;
constexpr std::size_t kMostElements = 200'000;
constexpr std::size_t kMostAttributes = 64;
constexpr std::size_t kLongestName = 256;
constexpr std::string_view kBlank = " \t\r\n";

[[noreturn]] void fail(const SourceLocation& where, std::string what, std::string found, std::string wanted) {
  throw Error({std::move(what), where, std::move(found), std::move(wanted)});
}

bool isKnownEncoding(std::string_view name) {
  constexpr std::array<std::string_view, 3> kKnown = {"utf-8", "us-ascii", "iso-8859-1"};
  return std::find(kKnown.begin(), kKnown.end(), lowerCase(name)) != kKnown.end();
}

// The number of bytes before the declaration, if they are blanks and byte order marks.
std::size_t bytesBeforeDeclaration(std::string_view text) {
  constexpr std::string_view kMark = "\xef\xbb\xbf", kDeclaration = "<?xml";
  std::string_view rest = text;
  for (std::size_t skipped = 1; skipped > 0; rest.remove_prefix(skipped))
    skipped = rest.starts_with(kMark) ? kMark.size() : std::min(rest.find_first_not_of(kBlank), rest.size());
  const std::string_view after = rest.substr(std::min(kDeclaration.size(), rest.size()));
  const bool isDeclared = rest.starts_with(kDeclaration) && after.find_first_of(kBlank) == 0;
  return isDeclared ? text.size() - rest.size() : 0;
}

// Finds the positions of the attributes of the tag at `at`, which expat has found to be well-formed.
void findPlaces(std::string_view text, std::size_t at, std::vector<Attribute>& attributes) {
  at = text.find_first_of(" \t\r\n/>", at);
  for (Attribute& attribute : attributes) {
    at = text.find_first_not_of(kBlank, at);
    attribute.at = static_cast<std::uint32_t>(at);
    at = text.find_first_of("\"'", at);
    attribute.valueAt = static_cast<std::uint32_t>(at + 1);
    at = text.find(text[at], at + 1) + 1;
  }
}

// Builds the tree from what expat reports, and stops it at the first breach of a limit.
class Builder {
 public:
  Builder(std::string_view text, const std::string& file, std::size_t skipped, const std::string& root)
      : text_(text),
        skipped_(skipped),
        root_(root),
        document_(text, file),
        parser_(XML_ParserCreate(nullptr)) {
    document_.declarationAt = static_cast<std::uint32_t>(skipped);
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(
        parser_.get(),
        [](void* self, const char* name, const char** attributes) { of(self).start(name, attributes); },
        [](void* self, const char*) { of(self).end(); });
    XML_SetCharacterDataHandler(parser_.get(), [](void* self, const char* part, int size) {
      of(self).characters({part, static_cast<std::size_t>(size)});
    });
    XML_SetXmlDeclHandler(parser_.get(), [](void* self, const char*, const char* encoding, int) {
      if (encoding && !isKnownEncoding(encoding)) of(self).refuseEncoding(quoted(encoding));
    });
    XML_SetStartDoctypeDeclHandler(parser_.get(), [](void* self, const char*, const char*, const char*, int) {
      of(self).refuseDocumentType();
    });
  }

  Document build() {
    const std::string_view seen = text_.substr(skipped_);
    if (text_.starts_with("\xff\xfe") || text_.starts_with("\xfe\xff")) {
      refuseEncoding("UTF-16");
    } else if (XML_Parse(parser_.get(), seen.data(), static_cast<int>(seen.size()), 1) != XML_STATUS_OK &&
               breach_.what.empty()) {
      failAtSyntax();
    }
    if (!breach_.what.empty()) throw Error(breach_);
    return std::move(document_);
  }

 private:
  static Builder& of(void* self) { return *static_cast<Builder*>(self); }

  std::uint32_t here() const {
#if XML_MAJOR_VERSION == 2 && XML_MINOR_VERSION < 9
    const std::int64_t at = std::max<std::int64_t>(0, XML_GetCurrentByteIndex(parser_.get()));
#else
    const std::int64_t at = std::max<std::int64_t>(0, XML_GetCurrentByteIndex64(parser_.get()));
#endif
    return static_cast<std::uint32_t>(skipped_ + static_cast<std::size_t>(at));
  }

  // Exceptions must not cross expat: what is wrong waits until it has returned.
  void stop(std::string what, std::string found, std::string wanted) {
    stopAt(here(), std::move(what), std::move(found), std::move(wanted));
  }
  void stopAt(std::size_t at, std::string what, std::string found, std::string wanted) {
    const SourceLocation where = document_.where(static_cast<std::uint32_t>(at));
    breach_ = {std::move(what), where, std::move(found), std::move(wanted)};
    XML_StopParser(parser_.get(), XML_FALSE);
  }

  void refuseDocumentType() {  // expat has read more than its beginning
    stopAt(std::min<std::size_t>(text_.rfind("<!DOCTYPE", here()), here()), "a document type", "<!DOCTYPE",
           "none: custom entities are not read");
  }

  void refuseEncoding(const std::string& encoding) {
    stop("encoding of the file", encoding, "UTF-8, US-ASCII or ISO-8859-1");
  }

  [[noreturn]] void failAtSyntax() const {
    const std::size_t first = text_.find_first_not_of(kBlank, skipped_);
    if (first != std::string_view::npos && text_[first] != '<') {
      fail(document_.where(static_cast<std::uint32_t>(first)), "not XML at all",
           quoted(text_.substr(first, std::min<std::size_t>(20, text_.find_first_of("\r\n", first) - first))),
           root_);
    }
    const XML_Error code = XML_GetErrorCode(parser_.get());
    if (code == XML_ERROR_INVALID_TOKEN) {
      const std::optional<std::size_t> bare = bareAnd();
      fail(document_.where(bare ? static_cast<std::uint32_t>(*bare) : here()),
           "not well-formed XML: invalid token", "", bare ? "&amp; where the text has a bare &" : "");
    }
    if (code == XML_ERROR_UNDEFINED_ENTITY) failAtEntity();
    const bool isOpen = code == XML_ERROR_TAG_MISMATCH || code == XML_ERROR_NO_ELEMENTS;
    fail(document_.where(here()), fmt::format("not well-formed XML: {}", XML_ErrorString(code)), "",
         isOpen && !open_.empty() ? fmt::format("</{}> first", open_.back()->name) : "");
  }

  // expat names the tag in whose attributes the entity stands.
  [[noreturn]] void failAtEntity() const {
    constexpr std::array<std::string_view, 6> kDefined = {"&amp;", "&lt;", "&gt;", "&quot;", "&apos;", "&#"};
    const auto isDefined = [&](std::size_t at) {
      return std::any_of(kDefined.begin(), kDefined.end(),
                         [&](std::string_view entity) { return text_.substr(at).starts_with(entity); });
    };
    const auto nextFrom = [&](std::size_t from) { return std::min(text_.find('&', from), text_.size()); };
    std::size_t at = nextFrom(here());
    while (isDefined(at)) at = nextFrom(at + 1);
    fail(document_.where(static_cast<std::uint32_t>(at)), "not well-formed XML: undefined entity",
         quoted(text_.substr(at, text_.find(';', at) + 1 - at)), "&amp; where the text has a bare &");
  }

  // The '&' after which expat stopped, because a reference needs a name and ';'.
  std::optional<std::size_t> bareAnd() const {
    const std::size_t before = std::min<std::size_t>(here(), text_.size() - 1);
    const std::size_t at = text_.find_last_of("&<>;\"'", before);
    if (at == std::string_view::npos || text_[at] != '&') return std::nullopt;
    return at;
  }

  bool isWithinLimits(std::string_view name, std::size_t attributes) {
    if (name.size() > kLongestName) {
      stop("name too long", fmt::format("{} bytes", name.size()), fmt::format("at most {}", kLongestName));
    } else if (open_.size() >= kDeepest) {
      stop("elements nested too deep", fmt::format("level {}", open_.size() + 1),
           fmt::format("at most {}", kDeepest));
    } else if (++elements_ > kMostElements) {
      stop("too many elements", fmt::format("number {}", elements_),
           fmt::format("at most {}", kMostElements));
    } else if (attributes > kMostAttributes) {
      stop(fmt::format("<{}>", name), fmt::format("{} attributes", attributes),
           fmt::format("at most {}", kMostAttributes));
    }
    return breach_.what.empty();
  }

  void start(const char* name, const char** attributes) {
    const auto count = static_cast<std::size_t>(XML_GetSpecifiedAttributeCount(parser_.get())) / 2;
    if (!breach_.what.empty() || !isWithinLimits(name, count)) return;
    Element element{.name = name, .attributes = {}, .children = {}, .at = here()};
    element.attributes.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      element.attributes.push_back({attributes[2 * i], attributes[2 * i + 1]});
      if (const std::size_t size = element.attributes.back().name.size(); size > kLongestName)
        return stop("attribute name too long", fmt::format("{} bytes", size),
                    fmt::format("at most {}", kLongestName));
    }
    findPlaces(text_, element.at, element.attributes);
    // Only the innermost open element grows, so that pointers to open ones stay valid.
    if (open_.empty()) {
      document_.root = std::move(element);
      open_.push_back(&document_.root);
    } else {
      open_.push_back(&open_.back()->children.emplace_back(std::move(element)));
    }
  }

  void end() {
    if (breach_.what.empty()) open_.pop_back();
  }

  void characters(std::string_view text) {
    if (!breach_.what.empty() || open_.back()->textAt) return;
    const std::size_t first = text.find_first_not_of(kBlank);
    if (first != std::string_view::npos) open_.back()->textAt = here() + static_cast<std::uint32_t>(first);
  }

  struct Free {
    void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
  };

  std::string_view text_;
  std::size_t skipped_;  // bytes before the text that expat sees
  const std::string& root_;
  Document document_;
  std::unique_ptr<std::remove_pointer_t<XML_Parser>, Free> parser_;
  std::vector<Element*> open_;
  std::size_t elements_ = 0;
  ErrorParts breach_;
};

}  // namespace

Document::Document(std::string_view text, std::string file) : text_(text), file_(std::move(file)), lines_{0} {
  for (std::size_t at = text.find('\n'); at != std::string_view::npos; at = text.find('\n', at + 1))
    lines_.push_back(static_cast<std::uint32_t>(at + 1));
}

SourceLocation Document::where(std::uint32_t offset) const {
  const auto after = std::upper_bound(lines_.begin(), lines_.end(), offset);
  return {file_, static_cast<int>(after - lines_.begin()), static_cast<int>(offset - after[-1]) + 1};
}

SourceLocation Document::where(const Attribute& attribute, std::size_t index) const {
  std::size_t at = attribute.valueAt;
  for (; index > 0 && at + 1 < text_.size(); --index) {
    if (text_[at] == '&') at = std::min(text_.find(';', at), text_.size() - 1);
    if (text_.substr(at, 2) == "\r\n") ++at;
    ++at;
  }
  return where(static_cast<std::uint32_t>(at));
}

Document parse(std::string_view text, const std::string& fileName, bool skipBlanks, const std::string& root) {
  if (text.size() > kLargestFile) {
    fail({fileName}, "scene file too large", fmt::format("{} bytes", text.size()),
         fmt::format("at most {} MiB", kLargestFile >> 20));
  }
  text = withoutByteOrderMark(text);
  return Builder(text, fileName, skipBlanks ? bytesBeforeDeclaration(text) : 0, root).build();
}

std::string quoted(std::string_view text) {
  std::size_t most = 60;
  const bool isLong = text.size() > most;
  while (isLong && most > 0 && (text[most] & 0xc0) == 0x80) --most;  // never half a letter of UTF-8
  std::string shown = "'";
  for (const char c : text.substr(0, most)) {
    const auto byte = static_cast<unsigned char>(c);
    shown += byte < 0x20 || byte == 0x7f ? fmt::format("\\x{:02x}", byte) : std::string(1, c);
  }
  return shown + (isLong ? "...'" : "'");
}

}  // namespace rex::xml
