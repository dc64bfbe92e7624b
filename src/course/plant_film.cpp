#include "course/plant_film.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/require.h"
#include "course/film.h"
#include "course/pictures.h"
#include "course/plant_film_internal.h"
#include "render/contact_sheet.h"
#include "render/image.h"
#include "render/renderer.h"

namespace rex {
namespace {

double aspectOf(const PlantFilmOptions& options) {
  requireValid(RendererOptions{.width = options.width, .height = options.height});
  return static_cast<double>(options.width) / options.height;
}

void requireFilm(int count, const PlantFilmOptions& options) {
  if (count < 1) throw Error({.what = "film of a plant", .found = "no views", .wanted = "at least one"});
  requireValid(ContactSheetOptions{.pictures = options.moments});
  requirePositive("film of a plant: step", options.step, kSeconds);
  requireCount("film of a plant: frames per second", options.rate, 1);
}

}  // namespace

void internal::writePlantPicture(const Picture& picture, const std::string& file,
                                 const PlantFilmOptions& options) {
  const Camera camera = framing(bounds(picture), options.view, aspectOf(options));
  Renderer renderer({.width = options.width, .height = options.height, .gl = glChoice()});
  writePng(renderer.draw(picture, camera), file);
}

internal::PlantFilmTiming internal::plantFilmTiming(int count, const PlantFilmOptions& options) {
  requireFilm(count, options);
  // If views are closer in time than a film can show, only the first of each frame is kept.
  const double perFrame = std::clamp(1 / (options.rate * options.step), 1., static_cast<double>(count));
  PlantFilmTiming timing;
  for (int i = 0; std::lround(i * perFrame) < count; ++i)
    timing.views.push_back(static_cast<int>(std::lround(i * perFrame)));
  const double rate = std::round(1 / (perFrame * options.step));
  timing.rate = static_cast<int>(std::clamp(rate, 1., static_cast<double>(options.rate)));
  return timing;
}

void internal::writePlantFilm(int count, const std::function<Picture(int)>& at, const std::string& name,
                              const PlantFilmOptions& options) {
  const PlantFilmTiming timing = plantFilmTiming(count, options);
  const double aspect = aspectOf(options);
  Film film;
  for (const int view : timing.views) film.push_back({view * options.step, at(view)});
  settleGround(film);
  const Shot shot{framing(film, options.view, aspect), options.width, options.height};
  writeFilmVideo(film, shot, name, timing.rate);
  writeFilmSheet(film, shot, name + "_sheet.png", options.moments);
}

}  // namespace rex
