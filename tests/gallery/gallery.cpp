#include "gallery/gallery.h"

#include "gallery/figures.h"
#include "gallery/pictures.h"
#include "render/png.h"

namespace rex::gallery {
namespace {

constexpr const char* kIntroduction = R"(# Gallery

What rex draws, without a screen. `scripts/gallery` draws this page and its pictures again; a test compares them with
what the code draws today. The code of each is a function of its own: pictures in
[tests/gallery/pictures.cpp](../../tests/gallery/pictures.cpp), figures in
[tests/gallery/figures.cpp](../../tests/gallery/figures.cpp).

Pictures move, too: `scripts/rex render man.ors --q ... --q ... -o man.html` makes a page on which the robot plays, and
`-o man.mp4` a film.
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
