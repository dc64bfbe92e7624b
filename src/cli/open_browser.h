#pragma once

#include <string>

#include "base/private_folder.h"

namespace rex::cli {

/// Whether this machine shows windows to the user: not over ssh, and not without a screen.
[[nodiscard]] bool hasScreen();

/// Opens a file in the user's browser, without waiting for it. Says so on standard error if there is none.
void openInBrowser(const std::string& file);

/// The same for an address with a secret in it, through a page in `folder` that leads on to it: as an
/// argument, everybody on this machine could read it. Throws Error if the page cannot be written.
void openAddress(const std::string& url, const PrivateFolder& folder);

/// Says how those who came over ssh bring a port of this machine to their own, which needs no screen here.
void sayForwarding(int port);

}  // namespace rex::cli
