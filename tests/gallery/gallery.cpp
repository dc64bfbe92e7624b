#include "gallery/gallery.h"

#include "gallery/contacts.h"
#include "gallery/figures.h"
#include "gallery/motion_figures.h"
#include "gallery/paths.h"
#include "gallery/pictures.h"
#include "gallery/robots.h"
#include "render/png.h"

namespace rex::gallery {
namespace {

constexpr const char* kIntroduction = R"(# Gallery

What rex draws, without a screen.

- [tests/gallery/pictures.cpp](../../tests/gallery/pictures.cpp) has the code of each picture,
- [tests/gallery/robots.cpp](../../tests/gallery/robots.cpp) that of robots and scenes,
- [tests/gallery/paths.cpp](../../tests/gallery/paths.cpp) that of paths,
- [tests/gallery/contacts.cpp](../../tests/gallery/contacts.cpp) that of scenes of contacts,
- [tests/gallery/figures.cpp](../../tests/gallery/figures.cpp) that of figures of each kind,
- [tests/gallery/motion_figures.cpp](../../tests/gallery/motion_figures.cpp) that of figures of motions;
- `scripts/gallery` draws them again, and a test in [tests/gallery](../../tests/gallery) compares.

Pictures move, too: `scripts/rex render man.ors -o man.mp4` walks around a robot, and `-o man.html` makes a page on which
you turn it and motions play. `scripts/rex render --help` says more.
)";

std::string section(const std::string& title, const std::vector<Drawing>& drawings) {
  std::string text = "\n## " + title + "\n";
  for (const Drawing& drawing : drawings)
    text += "\n### " + drawing.title + "\n\n" + drawing.text + "\n\n![" + drawing.title + "](gallery/" +
            drawing.name + ".png)\n";
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
      text += "\n### " + figure.title + "\n\n![" + figure.title + "](gallery/" + name + ".png)\n";
  return text;
}

}  // namespace rex::gallery
