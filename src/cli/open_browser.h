#pragma once

#include <string>

namespace rex::cli {

/// Whether this machine shows windows to the user: not over ssh, and not without a screen.
[[nodiscard]] bool hasScreen();

/// Opens a file in the user's browser, without waiting for it. Says so on standard error if there is none.
void openInBrowser(const std::string& file);

}  // namespace rex::cli
