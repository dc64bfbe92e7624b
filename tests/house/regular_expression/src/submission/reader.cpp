#include <regex>

#include "base/text.h"
