#include "gallery/gallery.h"

#include "gallery/contacts.h"
#include "gallery/figures.h"
#include "gallery/motion_figures.h"
#include "gallery/paths.h"
#include "gallery/pictures.h"
#include "gallery/robots.h"
#include "render/image.h"

namespace rex::gallery {
namespace {

constexpr const char* kIntroduction = R"(# Gallery

rex draws all these pictures without a screen: see [rex render](commands.md#rex-render) and [programs.md](programs.md#figures).
The code is in `tests/gallery`; `scripts/gallery` redraws the pictures, and a test compares them.
)";

std::string section(const std::string& title, const std::vector<Drawing>& drawings) {
  std::string text = "\n## " + title + "\n";
  for (const Drawing& drawing : drawings)
    text += "\n### " + drawing.title + "\n\n" + drawing.text + "\n\n![](gallery/" + drawing.name + ".png)\n";
  return text;
}

}  // namespace

std::vector<std::string> drawAll(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& drawings : {pictures(), robotPictures(), pathPictures(), contactPictures()}) {
    for (const Drawing& drawing : drawings) {
      writePng(drawing.draw(), folder / (drawing.name + ".png"));
      names.push_back(drawing.name);
    }
  }
  for (const auto& figures : {galleryFigures(), motionFigures()}) {
    for (const auto& [name, figure] : figures) {
      writeFigure(figure, folder / (name + ".png"));
      names.push_back(name);
    }
  }
  return names;
}

std::string page() {
  std::string text = kIntroduction;
  text += section("Pictures", pictures()) + section("Robots and scenes", robotPictures()) +
          section("Paths", pathPictures()) + section("Contacts", contactPictures());
  text += "\n## Figures\n";
  for (const auto& figures : {galleryFigures(), motionFigures()})
    for (const auto& [name, figure] : figures)
      text += "\n![" + figure.title + "](gallery/" + name + ".png)\n";
  return text;
}

}  // namespace rex::gallery
