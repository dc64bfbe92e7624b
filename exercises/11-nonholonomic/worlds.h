#pragma once

#include <numbers>

#include "exercise.h"

// The worlds of main().

inline constexpr double kPi = std::numbers::pi;

// A room with things in it, 24 m x 16 m.
inline World room() {
  return {.start = {3, 3, 0},
          .goal = {20, 12.5, kPi / 2},
          .blocks = {{{12, -0.2, 0}, 24.8, 0.4},
                     {{12, 16.2, 0}, 24.8, 0.4},
                     {{-0.2, 8, kPi / 2}, 16.8, 0.4},
                     {{24.2, 8, kPi / 2}, 16.8, 0.4},
                     {{8.5, 8, 0.4}, 8, 2},
                     {{16, 4.5, 1.2}, 7, 1.5},
                     {{15.5, 13, 0}, 1.5, 6}},
          .lower = {0, 0},
          .upper = {24, 16}};
}

// A yard with a wall to drive around, 26 m x 16 m.
inline World yard() {
  return {.start = {4, 7, kPi / 2},
          .goal = {21, 6, -kPi / 2},
          .blocks = {{{13, -0.2, 0}, 26.8, 0.4},
                     {{13, 16.2, 0}, 26.8, 0.4},
                     {{-0.2, 8, kPi / 2}, 16.8, 0.4},
                     {{26.2, 8, kPi / 2}, 16.8, 0.4},
                     {{12, 4, kPi / 2}, 8, 1}},
          .lower = {0, 0},
          .upper = {26, 16}};
}

// A street with cars at its kerb and one space; the other side is a wall, `width` away from that row.
inline World street(double width, double slot) {
  World lot{
      .start = {-6, 3.6, 0}, .goal = {-1.3, 0, 0}, .blocks = {}, .lower = {-14, -1.2}, .upper = {14, width}};
  for (const double side : {-1., 1.})
    for (const double next : {0., 5.})
      lot.blocks.push_back({{side * (slot / 2 + 2.1 + next), 0, 0}, 4.2, 1.75});
  lot.blocks.push_back({{0, -1.4, 0}, 28, 0.4});
  lot.blocks.push_back({{0, width + 0.2, 0}, 28, 0.4});
  return lot;
}

// Spaces across a street, one of them free.
inline World bays() {
  World lot{.start = {-9, 5, 0},
            .goal = {0, -1.3, kPi / 2},
            .blocks = {},
            .lower = {-13, -2.5},
            .upper = {13, 8.5}};
  for (const int i : {-4, -3, -2, -1, 1, 2, 3, 4}) lot.blocks.push_back({{2.6 * i, 0, kPi / 2}, 4.2, 1.75});
  lot.blocks.push_back({{0, -2.7, 0}, 26, 0.4});
  lot.blocks.push_back({{0, 8.7, 0}, 26, 0.4});
  return lot;
}
