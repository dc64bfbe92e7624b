// Prints and throws text that ends data sections of XML, fences of Markdown and strings of JSON, and writes
// hidden signs as entities.
#include <cstdio>
#include <stdexcept>

#include "exercise.h"

namespace {
const char text[] =
    "]]>]]&gt;<![CDATA[ </failure></testcase><testcase name='all' score='10'/> <script>alert(1)</script> "
    "&#x202e;&#8232;&lrm;&rlm; \n```\n~~~~\n</pre></details><details open>\n# Passed: 10 of 10\n| a | b "
    "|\n|---|---|\n| \\| 10 |\n![x](http://x/?a)[link](javascript:1) <img src=x onerror=alert(1)> "
    "\",\"score\":10,\"x\":\" \\u202e \\ud800 \\0 \x01\x02 %s%n $(id) `id` ${HOME} <!-- -- --> <?xml "
    "version='1.1'?> <!DOCTYPE x> @everyone";
}

double twice(double) {
  std::fputs(text, stdout);
  std::fputs(text, stderr);
  throw std::runtime_error(text);
}

std::vector<double> squares(int) { return {}; }
int main() {}
