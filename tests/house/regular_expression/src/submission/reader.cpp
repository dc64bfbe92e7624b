#include "base/text.h"
#include <regex>
