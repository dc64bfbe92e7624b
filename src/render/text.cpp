#include "render/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <type_traits>

#include <freetype/freetype.h>
#include <freetype/ftglyph.h>
#include <freetype/ftstroke.h>

#include "base/error.h"
#include "base/escape.h"
#include "render/text_internal.h"

namespace rex::internal {
namespace {

constexpr char32_t kInvalid = 0xFFFD;

// Length of the character that starts with `lead`; 0: no character starts with it.
int lengthOf(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead < 0xE0) return 2;
  if (lead >= 0xE0 && lead < 0xF0) return 3;
  return lead >= 0xF0 && lead < 0xF5 ? 4 : 0;
}

// The character at the start of `text` and its length; (kInvalid, 1) if there is none.
std::pair<char32_t, int> first(std::string_view text) {
  constexpr std::array<char32_t, 5> kSmallest = {0, 0, 0x80, 0x800, 0x10000};
  const auto lead = static_cast<unsigned char>(text[0]);
  const int length = lengthOf(lead);
  if (length == 1) return {lead, 1};
  if (length == 0 || text.size() < static_cast<std::size_t>(length)) return {kInvalid, 1};
  char32_t character = lead & (0x7Fu >> length);
  for (int k = 1; k < length; ++k) {
    const auto next = static_cast<unsigned char>(text[k]);
    if ((next & 0xC0) != 0x80) return {kInvalid, 1};
    character = character << 6 | (next & 0x3Fu);
  }
  const bool surrogate = character >= 0xD800 && character < 0xE000;
  if (character < kSmallest[length] || character > 0x10FFFF || surrogate) return {kInvalid, 1};
  return {character, length};
}

}  // namespace

std::u32string charactersOf(std::string_view text) {
  std::u32string characters;
  while (!text.empty()) {
    const auto [character, length] = first(text);
    characters.push_back(character);
    text.remove_prefix(static_cast<std::size_t>(length));
  }
  return characters;
}

std::string singleLine(std::string_view text) {
  std::string line;
  while (!text.empty()) {
    const auto [character, length] = first(text);
    if (isInvisible(character) || character >= 0xFFFE)
      line += ' ';
    else if (character == kInvalid)
      line += '?';
    else
      line += text.substr(0, static_cast<std::size_t>(length));
    text.remove_prefix(static_cast<std::size_t>(length));
  }
  return line;
}

std::vector<std::string_view> linesOf(std::string_view text) {
  std::vector<std::string_view> lines;
  for (;;) {
    const std::size_t end = text.find('\n');
    lines.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return lines;
    text.remove_prefix(end + 1);
  }
}

std::string singleLines(std::string_view text) {
  std::string lines;
  for (const std::string_view line : linesOf(text)) lines += singleLine(line) + '\n';
  lines.pop_back();
  return lines;
}

}  // namespace rex::internal

namespace rex {
namespace {

// Pixels at scale 1.
constexpr double kFontSize = 12.35;  // its capitals are 9 pixels high
constexpr int kLineHeight = 15, kBaseline = 11;
constexpr double kHalo = 1.6;
constexpr double kPart = 64;  // FreeType counts 64ths of a pixel

struct Release {
  void operator()(FT_Library library) const { FT_Done_FreeType(library); }
  void operator()(FT_Face face) const { FT_Done_Face(face); }
  void operator()(FT_Stroker stroker) const { FT_Stroker_Done(stroker); }
  void operator()(FT_Glyph glyph) const { FT_Done_Glyph(glyph); }
};
template <class T>
using Owned = std::unique_ptr<std::remove_pointer_t<T>, Release>;

void require(FT_Error error) {
  if (error != 0)
    throw Error({.what = "text in pictures",
                 .where = REX_FONT,
                 .found = "no font that can be read",
                 .wanted = "the package fonts-dejavu-core"});
}

// The font at one size. Neither hints nor kerning: the same text looks the same at each place and each scale.
class Font {
 public:
  Font() {
    FT_Library library = nullptr;
    require(FT_Init_FreeType(&library));
    library_.reset(library);
    FT_Face face = nullptr;
    require(FT_New_Face(library, REX_FONT, 0, &face));
    face_.reset(face);
    FT_Stroker stroker = nullptr;
    require(FT_Stroker_New(library, &stroker));
    stroker_.reset(stroker);
  }

  void setScale(double scale) {
    require(FT_Set_Char_Size(face_.get(), 0, std::lround(kFontSize * scale * kPart), 72, 72));
    FT_Stroker_Set(stroker_.get(), std::lround(kHalo * kPart), FT_STROKER_LINECAP_ROUND,
                   FT_STROKER_LINEJOIN_ROUND, 0);
  }

  // The outline of a character, or of U+FFFD if the font does not have it, and how far the next one is.
  Owned<FT_Glyph> glyph(char32_t character, double& advance) {
    const FT_UInt index = FT_Get_Char_Index(face_.get(), character);
    require(FT_Load_Glyph(face_.get(), index != 0 ? index : FT_Get_Char_Index(face_.get(), 0xFFFD),
                          FT_LOAD_NO_HINTING));
    advance = static_cast<double>(face_->glyph->linearHoriAdvance) / 65536;
    FT_Glyph glyph = nullptr;
    require(FT_Get_Glyph(face_->glyph, &glyph));
    return Owned<FT_Glyph>(glyph);
  }

  // Widens an outline by the halo.
  Owned<FT_Glyph> widen(Owned<FT_Glyph> outline) {
    FT_Glyph glyph = outline.release();
    const FT_Error error = FT_Glyph_StrokeBorder(&glyph, stroker_.get(), false, true);
    outline.reset(glyph);
    require(error);
    return outline;
  }

 private:
  Owned<FT_Library> library_;
  Owned<FT_Face> face_;
  Owned<FT_Stroker> stroker_;
};

// Opening it takes longer than drawing a label.
Font& font(double scale) {
  thread_local Font font;
  font.setScale(scale);
  return font;
}

// Blends the pixels that an outline covers, its origin at (x, y).
void paint(Image& image, Owned<FT_Glyph> outline, double x, double y, const Color& color) {
  FT_Vector origin{std::lround((x - std::floor(x)) * kPart), 0};
  FT_Glyph glyph = outline.release();
  const FT_Error error = FT_Glyph_To_Bitmap(&glyph, FT_RENDER_MODE_NORMAL, &origin, true);
  outline.reset(glyph);
  require(error);
  const auto* drawn = reinterpret_cast<FT_BitmapGlyph>(glyph);
  const int left = static_cast<int>(std::floor(x)) + drawn->left, top = static_cast<int>(y) - drawn->top;
  const float parts[3] = {color.r, color.g, color.b};
  for (int row = 0; row < static_cast<int>(drawn->bitmap.rows); ++row)
    for (int column = 0; column < static_cast<int>(drawn->bitmap.width); ++column) {
      if (left + column < 0 || left + column >= image.width || top + row < 0 || top + row >= image.height)
        continue;
      const double cover = drawn->bitmap.buffer[row * drawn->bitmap.pitch + column] / 255.0 * color.a;
      std::uint8_t* pixel = image.pixel(left + column, top + row);
      for (int c = 0; c < 3; ++c)
        pixel[c] = static_cast<std::uint8_t>(
            std::lround((1 - cover) * pixel[c] + cover * 255 * std::clamp(parts[c], 0.f, 1.f)));
    }
}

}  // namespace

TextSize textSize(std::string_view text, double scale) {
  Font& letters = font(scale);
  double width = 0, advance = 0;
  for (const char32_t character : internal::charactersOf(text)) {
    (void)letters.glyph(character, advance);
    width += advance;
  }
  return {static_cast<int>(std::ceil(width)), static_cast<int>(std::ceil(kLineHeight * scale))};
}

void drawText(Image& image, std::string_view text, int x, int y, const Color& color, double scale) {
  Font& letters = font(scale);
  const double brightness = 0.3 * color.r + 0.6 * color.g + 0.1 * color.b;
  const Color halo = brightness < 0.6 ? Color{1, 1, 1, 0.75f * color.a} : Color{0, 0, 0, 0.6f * color.a};
  const double baseline = std::round(y + kBaseline * scale);
  for (const bool isHalo : {true, false}) {
    double at = x, advance = 0;
    for (const char32_t character : internal::charactersOf(text)) {
      Owned<FT_Glyph> outline = letters.glyph(character, advance);
      if (isHalo) outline = letters.widen(std::move(outline));
      paint(image, std::move(outline), at, baseline, isHalo ? halo : color);
      at += advance;
    }
  }
}

}  // namespace rex
