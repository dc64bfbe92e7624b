// rex_draw_gallery FOLDER: draws the gallery into FOLDER/gallery and writes its page FOLDER/gallery.md.
#include <cstdio>
#include <exception>
#include <fstream>

#include "gallery/gallery.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: rex_draw_gallery FOLDER\n", stderr);
    return 64;
  }
  try {
    const std::filesystem::path folder = argv[1];
    std::filesystem::remove_all(folder / "gallery");
    std::filesystem::create_directories(folder / "gallery");
    rex::gallery::drawAll(folder / "gallery");
    std::ofstream page(folder / "gallery.md");
    page << rex::gallery::page();
    page.close();
    if (!page) throw std::runtime_error("cannot write gallery.md");
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "rex_draw_gallery: %s\n", error.what());
    return 1;
  }
}
