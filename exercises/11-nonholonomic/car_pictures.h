#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "worlds.h"

// How cars in their worlds are drawn and filmed.

using Poses = std::vector<Eigen::Vector3d>;

inline const rex::Color kGround{0.15f, 0.3f, 0.5f}, kAccent{0.8f, 0.25f, 0.1f}, kSoft{0.6f, 0.7f, 0.8f};

// A rectangle around p, from `back` behind it to `front` ahead of it.
inline rex::Series outline(const Eigen::Vector3d& p, double back, double front, double width,
                           const rex::Color& color) {
  rex::Series series{.size = 0.5, .color = color};
  const double c = std::cos(p[2]), s = std::sin(p[2]);
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}}) {
    const double ahead = x < 0 ? -back : front, left = y * width / 2;
    series.add(p[0] + c * ahead - s * left, p[1] + s * ahead + c * left);
  }
  return series;
}

inline rex::Series outline(const CarModel& car, const Eigen::Vector3d& q, const rex::Color& color) {
  return outline(q, car.back, car.front, car.width, color);
}

inline rex::Figure seenFromAbove(const std::string& title, const std::vector<Block>& blocks) {
  rex::Figure figure =
      rex::planeFigure({.title = title, .legend = rex::Legend::kNone, .width = 1000, .height = 560});
  for (const Block& obstacle : blocks) {
    const rex::Series edge =
        outline(obstacle.middle, obstacle.length / 2, obstacle.length / 2, obstacle.width, {});
    figure.regions.push_back({.x = edge.x, .y = edge.y});
  }
  return figure;
}

inline std::string text(const std::vector<double>& numbers) {
  std::string all;
  for (const double number : numbers) all += std::to_string(number) + ' ';
  return all;
}

inline std::string box(const std::string& head, const std::vector<double>& place, double heading,
                       const std::vector<double>& size, const std::string& look) {
  return head + "=<T t(" + text(place) + ") r(" + text({heading}) + " 0 0 1)> type=ST_ssBox size=[" +
         text(size) + " 0.05] " + look + " }\n";
}

// A scene with a car, its front wheels and a trailer: 6 joint angles, or 5 without the trailer.
inline rex::Simulator filmSet(const CarModel& car, const World& world, double hitchLength = 0) {
  const std::string paint = "color=[.90 .58 .18]", dark = "color=[.2 .22 .27]";
  const double low = -car.back, length = car.front + car.back, axle = car.width / 2 - 0.15;
  std::string scene =
      box("shape ground (world) { rel",
          {(world.lower.x() + world.upper.x()) / 2, (world.lower.y() + world.upper.y()) / 2, -0.1}, 0,
          {world.upper.x() - world.lower.x(), world.upper.y() - world.lower.y(), 0.1}, "color=[.62 .64 .66]");
  for (const Block& block : world.blocks) {
    const bool isCar = block.width > 1 && block.length > 4 && block.length < 5;
    const std::vector<double> middle{block.middle[0], block.middle[1]};
    scene += box("shape (world) { rel", {middle[0], middle[1], isCar ? 0.55 : 0.15}, block.middle[2],
                 {block.length, block.width, isCar ? 0.6 : 0.3},
                 isCar ? "color=[.35 .45 .6]" : "color=[.45 .47 .5]");
    if (isCar)
      scene += box("shape (world) { rel", {middle[0], middle[1], 1.05}, block.middle[2],
                   {block.length * 0.5, block.width * 0.9, 0.5}, "color=[.55 .63 .74]");
  }
  const auto wheel = [&](double x, double y) {
    return "rel=<T t(" + text({x, y, 0.3}) + ") d(90 1 0 0)> type=ST_cylinder size=[0 0 0.2 0.3] " + dark +
           " }\n";
  };
  scene += "body car { }\njoint (world car) { type=transXYPhi }\n";
  scene += box("shape (car) { rel", {low + length / 2, 0, 0.55}, 0, {length, car.width, 0.5}, paint);
  scene += box("shape (car) { rel", {low + 0.45 * length, 0, 1.05}, 0, {0.5 * length, 0.9 * car.width, 0.5},
               paint);
  for (const double y : {-axle, axle}) {
    const std::string name = y < 0 ? "right" : "left";
    scene += "shape (car) { " + wheel(0, y) + "body " + name + " { }\nshape (" + name + ") { " + wheel(0, 0);
    scene += "joint (car " + name + ") { type=hingeZ A=<T t(" + text({car.wheelbase, y, 0}) + ")> }\n";
  }
  if (hitchLength > 0) {
    scene += "body trailer { }\njoint (car trailer) { type=hingeZ }\n";
    scene += box("shape (trailer) { rel", {-hitchLength - 0.3, 0, 0.9}, 0, {hitchLength, car.width, 1.2},
                 "color=[.8 .8 .78]");
    scene += box("shape (trailer) { rel", {-hitchLength / 2, 0, 0.4}, 0, {hitchLength, 0.15, 0.15}, dark);
    for (const double y : {-axle, axle}) scene += "shape (trailer) { " + wheel(-hitchLength, y);
  }
  return rex::Simulator(rex::SimulatorDescription{.sceneName = "car", .sceneText = scene, .q = {}});
}
