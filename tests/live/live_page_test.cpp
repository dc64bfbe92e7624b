#include "live/live_page.h"

#include <gmock/gmock.h>

#include "live/live_server.h"
#include "support/web_connection.h"

namespace rex::live_page_test {

TEST(LivePage, IsOffered) {
  LiveServer server({});
  offerLivePage(server);
  for (const char* name : {"", "style.css", "three.js", "stage.js", "controls.js", "program.js", "live.js"})
    EXPECT_THAT(fetched(server.url(), name, "\r\n\r\n"), testing::StartsWith("HTTP/1.1 200")) << name;
}

}  // namespace rex::live_page_test
