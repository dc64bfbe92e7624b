#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "grading/check.h"
#include "interface.h"
#include "learning/dynamic_programming.h"
#include "learning/mazes.h"
#include "mistakes.h"

// Part 1: the T-maze, with any leaves and discount.

/// The T-maze with a value in each of its states, as a number and a colour from `range`, and a ring around
/// the states that are checked.
inline rex::Figure mazeFigure(const std::string& title, const Eigen::VectorXd& values,
                              const rex::AxisRange& range, Eigen::Index begin, Eigen::Index count) {
  const std::vector<Eigen::Vector2d> places{{0, 0}, {-1, 1}, {1, 1}, {-1.5, 2}, {-.5, 2}, {.5, 2}, {1.5, 2}};
  rex::Figure figure{.title = title,
                     .xLabel = "left and right",
                     .yLabel = "junctions",
                     .colorLabel = "value",
                     .xRange = rex::AxisRange(-2, 2),
                     .yRange = rex::AxisRange(-.4, 2.5),
                     .colorRange = range,
                     .legend = rex::Legend::kNone,
                     .width = 560,
                     .height = 460};
  for (std::size_t child = 1; child < places.size(); ++child)
    figure.series.push_back(rex::through({places[(child - 1) / 2], places[child]},
                                         {.size = 2, .color = rex::Color{.6f, .62f, .65f}}));
  figure.series.push_back(rex::dots(places, {.marker = rex::Marker::kSquare, .size = 4}));
  figure.series.back().values.assign(values.begin(), values.end());
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const Eigen::Vector2d& place = places[static_cast<std::size_t>(i)];
    figure.notes.push_back({fmt::format("s{}: {:.3g}", i + 1, values[i]), place.x() + .12, place.y() + .12});
    if (begin <= i && i < begin + count)
      figure.series.push_back(rex::grading::wrongPoint("", place.x(), place.y()));
  }
  return figure;
}

/// Values from the leaves to the root.
using Join = double (*)(double left, double right);
inline Eigen::VectorXd mazeBy(const Eigen::VectorXd& leaves, double discount, Join join) {
  Eigen::VectorXd V(7);
  V.tail(4) = leaves;
  for (Eigen::Index s = 2; s >= 0; --s) V[s] = discount * join(V[2 * s + 1], V[2 * s + 2]);
  return V;
}

inline std::vector<Mistake> mistakenMaze(const Eigen::VectorXd& leaves, double discount, bool isRandom) {
  const Join best = [](double a, double b) { return std::max(a, b); },
             mean = [](double a, double b) { return (a + b) / 2; },
             least = [](double a, double b) { return std::min(a, b); },
             sum = [](double a, double b) { return a + b; };
  const auto by = [&](const Eigen::VectorXd& ends, double factor, bool takesMean) {
    return mazeBy(ends, factor, takesMean ? mean : best);
  };
  Eigen::VectorXd early = by(leaves / discount, discount, isRandom), none = by(leaves, discount, isRandom);
  early.tail(4).setZero();
  none.tail(4).setZero();
  return {{isRandom && discount == .5 ? "Is the discount of .5 forgotten, or the probability of 1/2?"
                                      : "Is the discount forgotten?",
           by(leaves, 1, isRandom)},
          {"Is the reward of a leaf received on the way to it? It is received in the leaf.", early},
          {"Are the leaves worth nothing? Their rewards count.", none},
          {isRandom ? "Is the best action taken? The random policy goes left and right equally often."
                    : "Is the mean of both actions taken? Optimal is the best one.",
           by(leaves, discount, !isRandom)},
          {"Is the worst action taken?", mazeBy(leaves, discount, least)},
          {"Are both actions added up? Each has a probability of 1/2.", mazeBy(leaves, discount, sum)}};
}

inline void mazeFits(rex::grading::Check& check, Student& student, const Eigen::Vector4d& leaves,
                     double discount) {
  check.input("the T-maze", {{"leaves", leaves}, {"discount", discount}});
  rex::Mdp maze = rex::tMaze();
  maze.discount = discount;
  maze.rewards.bottomRows(4).colwise() = leaves;
  const MazeValues values = student.mazeValues(leaves, discount);
  const Eigen::VectorXd random = rex::policyValues(maze, rex::uniformPolicy(maze)).V,
                        optimal = rex::policyIteration(maze).V;
  check.shape("values of the random policy by mazeValues", values.random, 7, 1);
  check.shape("optimal values by mazeValues", values.optimal, 7, 1);
  for (const bool isRandom : {true, false}) {
    const Eigen::VectorXd &got = isRandom ? values.random : values.optimal,
                          &wanted = isRandom ? random : optimal;
    const std::string question = questionAbout(got, 1e-9, mistakenMaze(leaves, discount, isRandom));
    struct Row {
      const char* states;
      Eigen::Index begin, count;
    };
    for (const auto& [states, begin, count] : {Row{"s4 to s7", 3, 4}, {"s2 and s3", 1, 2}, {"s1", 0, 1}}) {
      const std::string property = fmt::format(
          "{} {} by mazeValues", isRandom ? "random policy: values of" : "optimal values of", states);
      const auto shown = check.show([&, first = begin, size = count]() -> rex::grading::Evidence {
        const rex::AxisRange range{std::min(got.minCoeff(), wanted.minCoeff()),
                                   std::max({got.maxCoeff(), wanted.maxCoeff(), got.minCoeff() + 1e-9})};
        const std::string policy = isRandom ? "Random policy, " : "Optimal policy, ";
        return {.figures = {mazeFigure(policy + "got", got, range, first, size),
                            mazeFigure(policy + "wanted", wanted, range, first, size)}};
      });
      const Eigen::VectorXd part = got.segment(begin, count);
      const auto mistake = check.suspect(question, question.empty() ? Eigen::VectorXd() : part);
      check.near(property, part, wanted.segment(begin, count), 1e-9);
    }
  }
}
