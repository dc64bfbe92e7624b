#include "gallery/gallery.h"

#include "gallery/figures.h"
#include "gallery/pictures.h"
#include "render/png.h"

namespace rex::gallery {
namespace {

constexpr const char* kIntroduction = R"(# Gallery

What rex draws, without a screen.

- [tests/gallery/pictures.cpp](../../tests/gallery/pictures.cpp) has the code of each picture,
- [tests/gallery/figures.cpp](../../tests/gallery/figures.cpp) that of each figure;
- `scripts/gallery` draws them again, and a test in [tests/gallery](../../tests/gallery) compares.

Pictures move, too: `scripts/rex render man.ors -o man.mp4` walks around a robot, and `-o man.html` makes a page on which
you turn it and motions play. `scripts/rex render --help` tells more.
)";

}  // namespace

std::vector<std::string> drawAll(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const Drawing& drawing : pictures()) {
    writePng(drawing.draw(), folder / (drawing.name + ".png"));
    names.push_back(drawing.name);
  }
  for (const auto& [name, figure] : galleryFigures()) {
    writeFigure(figure, folder / (name + ".png"));
    names.push_back(name);
  }
  return names;
}

std::string page() {
  std::string text = kIntroduction;
  text += "\n## Pictures\n";
  for (const Drawing& drawing : pictures())
    text += "\n### " + drawing.title + "\n\n" + drawing.text + "\n\n![" + drawing.title + "](gallery/" +
            drawing.name + ".png)\n";
  text += "\n## Figures\n";
  for (const auto& [name, figure] : galleryFigures())
    text += "\n### " + figure.title + "\n\n![" + figure.title + "](gallery/" + name + ".png)\n";
  return text;
}

}  // namespace rex::gallery
