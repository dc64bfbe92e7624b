#pragma once

#include "systems/cart_pole.h"
