#pragma once
// The cart pole for exercises: all of systems/cart_pole.h.
#include "systems/cart_pole.h"
