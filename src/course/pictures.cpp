#include "course/pictures.h"

#include <cstdlib>

#include "base/error.h"
#include "course/film.h"
#include "course/recording.h"
#include "course/simulator.h"
#include "render/contact_sheet.h"
#include "render/renderer.h"

namespace rex {

GlOptions glChoice() {
  const char* name = std::getenv("REX_GL");
  const bool isChosen = name != nullptr && *name != '\0';
  return {.backend = isChosen ? glBackendFromName(name) : GlBackend::kAuto};
}

namespace {

Shot shotOf(const Film& film, const PictureOptions& options) {
  requireValid(RendererOptions{.width = options.width, .height = options.height});
  return {cameraFor(film, options), options.width, options.height};
}

}  // namespace

void writePicture(const Simulator& simulator, const std::string& file, const PictureOptions& options) {
  writePicture(makeStill(simulator, options).front().picture, file,
               {.view = options.view, .width = options.width, .height = options.height});
}

void writeFrames(const Simulator& simulator, const std::string& folder, const PictureOptions& options,
                 std::optional<int> most) {
  const Film film = makeFilm(simulator, options, most);
  if (!film.empty()) writeFilmFrames(film, shotOf(film, options), folder);
}

void writeVideo(const Simulator& simulator, const std::string& name, const PictureOptions& options,
                std::optional<int> most) {
  const Film film = makeFilm(simulator, options, most);
  if (!film.empty()) writeFilmVideo(film, shotOf(film, options), name, videoRate(film));
}

void writeContactSheet(const Simulator& simulator, const std::string& name, const PictureOptions& options,
                       int pictures, std::optional<int> most) {
  requireValid(ContactSheetOptions{.pictures = pictures});
  const Film film = makeFilm(simulator, options, most);
  if (film.empty()) throw Error({.what = "no postures for a contact sheet", .where = {name + ".png"}});
  writeFilmSheet(film, shotOf(film, options), name + ".png", pictures);
}

}  // namespace rex
