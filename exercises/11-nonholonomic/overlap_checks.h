#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "car_checks.h"

// Part 2: whether the body of a car overlaps blocks.

/// A case of isFree.
struct Place {
  CarModel car;
  Eigen::Vector3d q;
  std::vector<Block> blocks;
  bool isTouched = false, isSaidFree = false;
};

/// Large and small blocks and long walls: some lie within the car, some across it with no corner of one
/// inside of the other. Whether the car is free is random, and never decided by less than a centimetre.
inline Place randomPlace(rex::Rng& rng) {
  Place place;
  place.isTouched = rng.index(2) == 0;
  const int count = !place.isTouched && rng.index(10) == 0 ? 0 : 1 + rng.index(2);
  const auto isSure = [&] {
    for (const double margin : {0., 0.01, -0.01})
      if (touches(grown(place.car, margin), place.q, place.blocks) != place.isTouched) return false;
    return true;
  };
  do {
    place.car = randomCar(rng);
    place.q = randomPose(rng, 3);
    place.blocks.clear();
    for (int k = 0; k < count; ++k)
      place.blocks.push_back(
          {randomPose(rng, 5), std::exp(rng.uniform(-1.6, 2)), std::exp(rng.uniform(-1.6, 1))});
  } while (!isSure());
  return place;
}

/// Whether `inner` has a corner, or with `middle` its middle, in `outer`.
inline bool hasCornerIn(const Block& outer, const Block& inner, bool middle) {
  for (const double x : {-.5, .5})
    for (const double y : {-.5, .5}) {
      const Eigen::Vector3d corner =
          moved(inner.middle, {middle ? 0 : x * inner.length, middle ? 0 : y * inner.width, 0});
      const double c = std::cos(outer.middle[2]), s = std::sin(outer.middle[2]);
      const double dx = corner[0] - outer.middle[0], dy = corner[1] - outer.middle[1];
      if (std::abs(dx * c + dy * s) < outer.length / 2 && std::abs(dy * c - dx * s) < outer.width / 2)
        return true;
    }
  return false;
}

/// Mistaken ideas of what a car touches, by number; false beyond the last.
inline bool touchesByMistake(int mistake, const Place& place) {
  CarModel car = place.car;
  Eigen::Vector3d q = place.q;
  std::vector<Block> blocks = place.blocks;
  const Block body{moved(q, {(car.front - car.back) / 2, 0, 0}), car.front + car.back, car.width};
  const auto any = [&](const auto& isHit) { return std::ranges::any_of(blocks, isHit); };
  switch (mistake) {
    case 0:
      return any([&](const Block& b) { return hasCornerIn(b, {q, 0, 0}, true); });
    case 1:
      return any([&](const Block& b) { return hasCornerIn(b, body, false); });
    case 2:
      return any([&](const Block& b) { return hasCornerIn(b, body, false) || hasCornerIn(body, b, false); });
    case 3:
      car.front = car.back = body.length / 2;
      break;
    case 4:
      q[2] = 0;
      break;
    case 5:
      for (Block& block : blocks) block.middle[2] = 0;
      break;
    case 6:
      for (Block& block : blocks) std::swap(block.length, block.width);
      break;
    default:
      if (blocks.size() > 1) blocks = {mistake == 7 ? blocks.front() : blocks.back()};
  }
  return touches(car, q, blocks);
}

/// The question about the mistake that explains all answers.
inline std::string whyMisjudged(const std::vector<Place>& places) {
  constexpr std::array kQuestions{
      "Is only the point between the rear wheels tested? The body is a rectangle around it.",
      "Are only the corners of the car tested? A block may lie across it, or inside.",
      "Are only corners tested? Two rectangles may cross with no corner of one in the other.",
      "Is the body centred at the rear axle? It reaches `front` ahead and `back` behind.",
      "Is the heading of the car left out?",
      "Are the headings of the blocks left out?",
      "Are length and width of the blocks exchanged?",
      "Does the first block decide?",
      "Does the last block decide?"};
  for (std::size_t i = 0; i < kQuestions.size(); ++i)
    if (std::ranges::all_of(places, [&](const Place& place) {
          return touchesByMistake(static_cast<int>(i), place) != place.isSaidFree;
        }))
      return kQuestions[i];
  return "";
}

inline void overlapsFit(rex::grading::Check& check, Student& student) {
  rex::Rng& rng = check.rng();
  std::vector<Place> places;
  for (int i = 0; i < 200; ++i) {
    places.push_back(randomPlace(rng));
    places.back().isSaidFree = student.isFree(places.back().car, places.back().q, places.back().blocks);
  }
  const bool isRight =
      std::ranges::all_of(places, [](const Place& p) { return p.isSaidFree != p.isTouched; });
  const auto asked = check.ask(isRight ? "" : whyMisjudged(places));
  for (const Place& place : places) {
    check.input("a car and blocks", {{"front", place.car.front},
                                     {"back", place.car.back},
                                     {"width", place.car.width},
                                     {"q", place.q},
                                     {"blocks: x, y, heading, length, width", numbersOf(place.blocks)}});
    const auto shown = check.show([&] {
      return placeSeen(place.isTouched ? "wanted: not free" : "wanted: free", place.car, place.q,
                       place.blocks);
    });
    check.that(place.isTouched ? "isFree returns false, since the car overlaps a block"
                               : "isFree returns true, since the car overlaps no block",
               place.isSaidFree != place.isTouched);
  }
}
