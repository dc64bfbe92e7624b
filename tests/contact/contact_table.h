#pragma once

#include <string>

namespace rex::contact {

/// The document of all scenes: what the formula says, and what ours, MuJoCo and Bullet measure. In Markdown.
[[nodiscard]] std::string contactTable();

}  // namespace rex::contact
